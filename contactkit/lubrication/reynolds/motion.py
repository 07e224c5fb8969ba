"""Films in time: states along a prescribed gap, and a mass that is pulled off a film."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from functools import partial
from itertools import pairwise
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from attrs import evolve

from ...errors import ConvergenceError, DescriptionError
from .discretisation import checked_gap
from .film import Film, FilmState
from .solve import at_rest, unchecked_step
from .validity import warn_new

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from ...validity import ValidityNumber

    Array = NDArray[np.floating[Any]]

__all__ = ["PullState", "follow_gap", "pull_apart"]

Velocity = tuple[float, float]


def follow_gap(
    film: Film,
    gap: Callable[[float], ArrayLike],
    times: Sequence[float],
    *,
    start: FilmState | None = None,
    lower_velocity: Velocity = (0.0, 0.0),
    upper_velocity: Velocity = (0.0, 0.0),
    solver: str | None = None,
) -> Iterator[FilmState]:
    """States of a film whose gap is prescribed in time.

    Parameters
    ----------
    film : Film
        The film.
    gap : callable
        Gap [m] at a time [s], one number or a map.
    times : sequence of float
        Ascending times [s]; the first is that of the start.
    start : FilmState, optional
        State at the first time; by default a full film.
    lower_velocity, upper_velocity, solver
        See `solve_pressure`.

    Yields
    ------
    FilmState
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
    >>> film = Film(face=face, viscosity=0.1, cavity_pressure=-1e5)
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


class PullState(NamedTuple):
    """A mass on a film at one instant."""

    time: float
    """Time [s]."""
    travel: float
    """How far the gap has opened [m]."""
    speed: float
    """Opening speed [m/s]."""
    force: float
    """Force of the film on the mass, positive against separation [N]."""
    state: FilmState
    """The film."""

    @property
    def validity(self) -> tuple[ValidityNumber, ...]:
        """See `FilmState.validity`."""
        return self.state.validity


def pull_apart(
    film: Film,
    gap: ArrayLike,
    *,
    mass: float,
    force: float,
    final: float,
    growth: float = 0.01,
    copies: int = 1,
    solver: str | None = None,
) -> Iterator[PullState]:
    r"""Motion of a mass that a constant force pulls off a film, :math:`m \ddot z = F - F_{film}`.

    Parameters
    ----------
    film : Film
        The film.
    gap : array_like, shape () or (ny, nx)
        Gap at the start [m]; the faces are rigid and stay parallel.
    mass : float
        Mass [kg].
    force : float
        Force [N] that opens the gap.
    final : float
        Travel at which to stop [m].
    growth : float
        Largest growth of the smallest gap in a step [-].
    copies : int
        How often the window stands for the face: 4 for a quarter.
    solver : str, optional
        See `solve_pressure`.

    Yields
    ------
    PullState
        State after each step, up to the first at or beyond `final`.

    Raises
    ------
    DescriptionError
        If a number is not positive.
    ConvergenceError
        If the speed of a step is not found.

    Notes
    -----
    The film by backward Euler, the place by the trapezoidal rule, the speed of a step by a
    bracketed secant, because the force of the film rises with it. Release time of the injector's
    disc: 6e-3, 1e-3 with 24, 48 cells in the radius and 1 % of growth.
    """
    for name, value, unit in (
        ("mass", mass, "kg"),
        ("force", force, "N"),
        ("final", final, "m"),
        ("growth", growth, "-"),
        ("copies", copies, "-"),
    ):
        if not 0.0 < value < math.inf:
            raise DescriptionError(f"pull_apart.{name}", value, "be positive and finite", unit=unit)
    shape = checked_gap(film.face, gap)
    smallest = float(shape[film.face.loaded].min())
    travel, speed, state = 0.0, 0.0, at_rest(film, shape)
    out = {number.name for number in state.validity if number.is_valid is False}
    acceleration = force / mass
    # A thousandth of the first step would do without a film: with one, it opens a cavity.
    dt = 1e-3 * math.sqrt(2.0 * growth * smallest / acceleration)
    while travel < final:
        room = growth * (smallest + travel)
        free = (math.hypot(speed, math.sqrt(2.0 * acceleration * room)) - speed) / acceleration
        dt = min(1.5 * dt, free)
        after = partial(_film_after, state, shape + travel, speed, dt, solver)
        old = speed
        speed, state = _speed(after, old, old + dt * acceleration, mass / dt, copies)
        travel += 0.5 * dt * (old + speed)
        warn_new(state.validity, out)
        yield PullState(state.time, travel, speed, copies * state.force, state)


def _film_after(
    state: FilmState, gap: Array, speed: float, dt: float, solver: str | None, trial: float
) -> FilmState:
    """Film at the end of a step that ends at a trial speed."""
    return unchecked_step(state, gap + 0.5 * dt * (speed + trial), dt, solver=solver)


def _speed(
    after: Callable[[float], FilmState], low: float, high: float, inertia: float, copies: int
) -> tuple[float, FilmState]:
    """Speed at which film and inertia take up the force; without a film it would be `high`."""
    top = inertia * (high - low)
    state = after(low)
    at_low = copies * state.force - top
    if at_low >= 0.0:  # the film alone holds more: the mass slows down
        high, at_high, speed = low, at_low, low
        span = (top / inertia) or 1e-300
        while True:
            low -= span
            state = after(low)
            at_low = copies * state.force - top + inertia * (low - speed)
            if at_low < 0.0:
                break
            high, at_high, span = low, at_low, 4.0 * span
        base = speed
    else:
        base = low
        at_high = copies * after(high).force
    for _ in range(60):
        trial = high - at_high * (high - low) / (at_high - at_low)
        state = after(trial)
        error = copies * state.force + inertia * (trial - base) - top
        if abs(error) <= 1e-9 * abs(top) or abs(high - low) <= 1e-14 * abs(high):
            return trial, state
        # The other end of the bracket, or the same with less weight, so that both ends move.
        if error * at_high < 0.0:
            low, at_low = high, at_high
        else:
            at_low = at_low * at_high / (at_high + error)
        high, at_high = trial, error
    raise ConvergenceError("the speed of a step was not found; take smaller steps (growth)", state)
