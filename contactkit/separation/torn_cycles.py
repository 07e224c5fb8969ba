"""Film that tears over the cycles of a vibration: each begins with what the last one left."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

import numpy as np
from attrs import field, frozen
from scipy.interpolate import CubicHermiteSpline

from .cavity.law import Cavitation
from .film import Film
from .torn_path import TornPoint, torn_points

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = ["TornCycles", "torn_cycles"]


@frozen(eq=False)
class TornCycles:
    """Film at times of a vibration, and of the same opening without it."""

    shaken: dict[float, TornPoint]
    steady: dict[float, TornPoint]
    _impulse: CubicHermiteSpline = field(init=False, repr=False)

    @_impulse.default
    def _find_impulse(self) -> CubicHermiteSpline:
        points = self.shaken.values()
        return CubicHermiteSpline(
            list(self.shaken), [p.impulse for p in points], [p.force for p in points]
        )

    def running(self, times: NDArray[np.float64]) -> NDArray[np.float64]:
        """Viscous impulse [N.s] from the first of some times [s] to each of them."""
        known = [self.shaken[t].impulse if t in self.shaken else self._impulse(t) for t in times]
        return np.array(known) - float(known[0])

    @property
    def steady_impulse(self) -> float:
        """Viscous impulse [N.s] of the whole opening without the vibration."""
        return list(self.steady.values())[-1].impulse


def torn_cycles(
    film: Film,
    law: Cavitation,
    shaken: Callable[[float], tuple[float, float]],
    steady: Callable[[float], tuple[float, float]],
    times: Sequence[float],
    rtol: float,
) -> TornCycles:
    """Run a film that tears along a vibration, and along the same opening without it.

    Parameters
    ----------
    film, law
        Forces of the film while it is whole, and how it tears.
    shaken, steady : callable
        Gap [m] and speed [m/s] at a time [s], with and without the vibration.
    times : sequence of float
        Where the film is wanted [s], ascending.
    rtol : float
        As in `torn_points`.
    """
    inside = [time for time in times if steady(time)[0] <= film.end]
    return TornCycles(
        dict(zip(times, torn_points(film, law, shaken, times, rtol), strict=True)),
        dict(zip(inside, torn_points(film, law, steady, inside, rtol), strict=True)),
    )
