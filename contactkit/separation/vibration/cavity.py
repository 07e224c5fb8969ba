"""Film that cavitates over the cycles of a vibration: each begins with what the last one left."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from attrs import field, frozen
from scipy.interpolate import CubicHermiteSpline

from ..cavity.law import Cavitation
from ..cavity.path import Place
from ..cavity_points import CavityPoint, Known, cavity_points
from ..film import Film

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = ["CavityCycles"]


@frozen(eq=False)
class CavityCycles:
    """Film that cavitates along a vibration, and along the same opening without it.

    Parameters
    ----------
    film, law
        Forces of the film while it is full, and how it cavitates.
    vibrating, steady : callable
        Gap [m] and speed [m/s] at a time [s], with and without the vibration.
    times : sequence of float
        Where the film is computed [s], ascending; later others may be asked for.
    rtol : float
        As in `cavity_points`.
    """

    film: Film
    law: Cavitation
    vibrating: Place
    steady: Place
    times: Sequence[float]
    rtol: float
    _known: dict[float, Known] = field(factory=dict, init=False, repr=False)
    _known_steady: dict[float, Known] = field(factory=dict, init=False, repr=False)
    _impulse: CubicHermiteSpline = field(init=False, repr=False)

    @_impulse.default
    def _find_impulse(self) -> CubicHermiteSpline:
        points = self.at(self.times)
        self.steady_at(self.times)
        return CubicHermiteSpline(
            self.times, [p.impulse for p in points], [p.force for p in points]
        )

    def at(self, times: Sequence[float]) -> list[CavityPoint]:
        """Film at ascending times [s], of which the first is among `times`."""
        return cavity_points(self.film, self.law, self.vibrating, times, self.rtol, self._known)

    def steady_at(self, times: Sequence[float]) -> list[CavityPoint]:
        """Film without the vibration at ascending times [s], up to the end of the film."""
        inside = [time for time in times if self.steady(time)[0] <= self.film.end]
        if not inside:
            return []
        return cavity_points(
            self.film, self.law, self.steady, inside, self.rtol, self._known_steady
        )

    def events(self, times: Sequence[float]) -> list[float]:
        """Times [s] between known ones of rupture, of reformation, and at which the edge turns."""
        known = [*map(self._known.get, times), *map(self._known_steady.get, times)]
        return [event for one in known if one is not None for event in one.events]

    def running(self, times: NDArray[np.float64]) -> NDArray[np.float64]:
        """Viscous impulse [N.s] from the first of some times [s] to each of them."""
        known, spline = self._known, self._impulse
        found = [known[t].point.impulse if t in known else float(spline(t)) for t in times.tolist()]
        return np.array(found) - found[0]

    @property
    def steady_impulse(self) -> float:
        """Viscous impulse [N.s] of the whole opening without the vibration."""
        return self.steady_at(self.times)[-1].impulse
