"""Films in time: states along a prescribed gap."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np
from attrs import evolve

from ...errors import DescriptionError
from .film import GridFilm, GridFilmState
from .solve import at_rest, unchecked_step
from .validity import warn_new

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    Array = NDArray[np.floating[Any]]

__all__ = ["follow_gap"]

Velocity = tuple[float, float]


def follow_gap(
    film: GridFilm,
    gap: Callable[[float], ArrayLike],
    times: Sequence[float],
    *,
    start: GridFilmState | None = None,
    lower_velocity: Velocity = (0.0, 0.0),
    upper_velocity: Velocity = (0.0, 0.0),
    solver: str | None = None,
) -> Iterator[GridFilmState]:
    """States of a film whose gap is prescribed in time.

    Parameters
    ----------
    film : GridFilm
        The film.
    gap : callable
        Gap [m] at a time [s], one number or a map.
    times : sequence of float
        Ascending times [s]; the first is that of the start.
    start : GridFilmState, optional
        State at the first time; by default a full film.
    lower_velocity, upper_velocity, solver
        See `solve_pressure`.

    Yields
    ------
    GridFilmState
        State at each time after the first.

    Raises
    ------
    DescriptionError
        If the times do not ascend or a gap is not positive.

    Notes
    -----
    The error is of first order in the steps (`step_film`): steps of a hundredth of a period leave
    4e-4 of the work.

    Examples
    --------
    >>> from contactkit.lubrication.reynolds.face import rasterise
    >>> from contactkit.scene.planforms import Disc
    >>> face = rasterise(Disc(radius=1e-3), 24)
    >>> film = GridFilm(face=face, viscosity=0.1, drop=1e5)
    >>> states = follow_gap(film, lambda t: 1e-5 + 1e-3 * t, [0.0, 1e-4, 2e-4])
    >>> [state.void_volume > 0.0 for state in states]
    [True, True]
    """
    if len(times) < 2 or not all(a < b for a, b in pairwise(times)):
        raise DescriptionError("times", "out of order or fewer than two", "ascend", unit="s")
    state = at_rest(film, gap(times[0])) if start is None else start
    state = evolve(state, time=times[0])
    out = {number.name for number in state.validity if number.is_valid is False}
    for earlier, later in pairwise(times):
        velocities = (lower_velocity, upper_velocity)
        state = unchecked_step(state, gap(later), later - earlier, velocities, solver)
        state = evolve(state, time=later)
        warn_new(state.validity, out)
        yield state
