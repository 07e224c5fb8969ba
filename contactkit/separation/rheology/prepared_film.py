"""Film of any flow law, prepared for a motion: its force as tables, and directly beyond them."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np
from attrs import field, frozen

from ...errors import InfeasibleError
from ..effects.force_law import ForceLaw
from .table import LogTable, log_table, places

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ..effects.base import Limiter
    from .face import FaceRheology
    from .film import RheologicalFilm

    Array = NDArray[np.floating[Any]]

__all__ = ["PreparedFilm"]

_SLOWEST = 1e-8  # rates of shear over the fastest, from which a table may begin
_STIFFEST = 2.0  # logarithm of a closing force over the linear one: beyond is its pole
_ITERATIONS = 12  # of Newton's method, which squares the error each time


@frozen(eq=False)
class PreparedFilm:
    """Force of a film over gap and speed.

    Parameters
    ----------
    film : RheologicalFilm or FaceRheology
        The film.
    gaps : (float, float)
        Smallest and largest gap of its tables [m].
    fastest : float
        Fastest shear at a wall in its tables [1/s].
    """

    film: RheologicalFilm | FaceRheology
    gaps: tuple[float, float]
    fastest: float
    _tables: dict[tuple[str, int], Any] = field(factory=dict, init=False, repr=False)

    # Films pinned at the rim and films that draw in have tables of their own: the force has a kink.
    @property
    def _pieces(self) -> list[tuple[float, float]]:
        shape = self.film.shape
        low, high = self.gaps[0], min(self.gaps[1], shape.level)
        marks = [low, *(one for one in (shape.full_gap,) if low < one < high), high]
        return list(itertools.pairwise(marks))

    def _piece(self, gap: float) -> int | None:
        """Number of the piece a gap lies in; None for none."""
        for i, (low, high) in enumerate(self._pieces):
            if low <= gap <= high:
                return i
        return None

    def _made(self, what: str, piece: int, make: Callable[[], Any]) -> Any:
        """Table of a piece, made when it is first asked for."""
        key = what, piece
        if key not in self._tables:
            self._tables[key] = make()
        return self._tables[key]

    def linear_force(self, gap: float, speed: float) -> float:
        """Force [N] at the viscosity at rest, with slip."""
        piece, film = self._piece(gap), self.film
        if piece is None or film.is_even or not film.slips:
            return film.linear_force(gap, speed)
        ratio = self._made("slip", piece, lambda: self._slip_table(self._pieces[piece]))
        return film.newtonian_force(gap, speed) * math.exp(float(ratio(math.log(gap))))

    def _slip_table(self, gaps: tuple[float, float]) -> Any:
        """Logarithm of what slip leaves of the force, over that of the gap."""
        from scipy.interpolate import make_interp_spline

        rows = places(gaps)
        ratios = [self.film.linear_force(h, 1.0) / self.film.newtonian_force(h, 1.0) for h in rows]
        return make_interp_spline(np.log(rows), np.log(ratios), k=5)

    def force_ratio(self, gap: float, speed: float) -> float:
        """Force over that without rheology and slip [-]; 1 at rest."""
        plain = self.film.newtonian_force(gap, speed)
        return self.force(gap, speed) / plain if plain else 1.0

    def peak_pressure(self, gap: float, speed: float) -> float:
        """Largest pressure difference from ambient [Pa]; the strength where it cavitates."""
        if speed == 0.0 or not self.film.shape.radius(gap) > 0.0:
            return 0.0
        peak = float(self.film.peak_pressures(np.array([gap]), np.array([speed]))[0])
        return min(peak, self.film.strength) if speed > 0.0 else peak

    def force(self, gap: float, speed: float) -> float:
        """Force of the films [N]; -inf where no pressure closes the gap so fast."""
        piece = self._piece(gap)
        if speed == 0.0:
            return 0.0
        if self.film.is_linear:
            return self.linear_force(gap, speed)
        if piece is None:
            return self.film.force(gap, speed)
        name = "opening" if speed > 0.0 else "closing"
        table = self._made(name, piece, lambda: self._force_table(piece, math.copysign(1.0, speed)))
        value = table(gap, abs(speed)) if table is not None else None
        if value is None:
            return self.film.force(gap, speed)
        return self.linear_force(gap, speed) * math.exp(value)

    def _force_table(self, piece: int, sign: float) -> LogTable | None:
        """Logarithm of the force over the linear one; None where it has a pole throughout."""

        def logarithm(gap: Array, speed: Array) -> Array:
            force, linear = self.film.forces(gap, sign * speed)
            with np.errstate(divide="ignore"):
                return np.log(np.abs(force / linear))

        def of_shear(gap: Array, speed: Array) -> Array:
            """The same between flats without slip and pressure: of the rate of shear alone."""
            if gap.ndim < 2:
                return logarithm(gap, speed)
            return np.broadcast_to(logarithm(gap[0], speed[0]), gap.shape)

        low, high = self._pieces[piece]
        function = of_shear if self.film.has_one_variable else logarithm
        ratios = np.geomspace(_SLOWEST * self.fastest, self.fastest, 49)
        if sign < 0.0 and self.film.law.pressure_law is not None:
            # The pole comes first where the film is widest.
            worst = np.array(
                [logarithm(np.full(49, h), ratios * self.unit(h)) for h in (low, high)]
            )
            fine = (worst < _STIFFEST).all(axis=0)
            last = int(np.argmin(fine)) - 1 if not fine.all() else fine.size - 1
            if last < 12:
                return None
            ratios = ratios[: last + 1]
        ends = float(ratios[0]), float(ratios[-1])
        return log_table(function, self.unit, (low, high), ends)

    def unit(self, gap: float) -> float:
        """Speed [m/s] at which a Newtonian film shears by 1 1/s at a wall."""
        return 1.0 / self.film.shear_per_speed(gap)

    def limited_force(self, gap: float, speed: float, force: float) -> float:
        """Force [N] that a pressure truncated at the strength of the liquid leaves."""
        piece = self._piece(gap)
        if speed <= 0.0:
            return force
        if piece is None:
            return self.film.bounded_force(gap, speed)
        table: LogTable = self._made("cavity", piece, lambda: self._cavity_table(piece))
        if speed <= table.unit(gap):
            return force
        value = table(gap, speed)
        return self.film.bounded_force(gap, speed) if value is None else force * math.exp(value)

    def _cavity_table(self, piece: int) -> LogTable:
        """Logarithm of the truncated force over that of the full film, from inception on."""
        onset = self.inception_speed(self._pieces[piece])
        fastest = max(self.fastest * self.unit(h) / onset(h) for h in self._pieces[piece])

        def logarithm(gap: Array, speed: Array) -> Array:
            return np.log(self.film.bounded_forces(gap, speed) / self.film.forces(gap, speed)[0])

        return log_table(
            logarithm, onset, self._pieces[piece], (1.0, max(fastest, 10.0)), fades=False
        )

    def inception_speed(self, gaps: tuple[float, float]) -> Callable[[float], float]:
        """Speed [m/s] at which the full film cavitates, over the gap [m]."""
        from scipy.interpolate import make_interp_spline

        rows = places(gaps)
        strength, film = self.film.strength, self.film
        speed = np.array([self.unit(h) for h in rows.tolist()])
        speed = speed * strength / film.peak_pressures(rows, speed)
        for _ in range(_ITERATIONS):  # Newton's method in logarithms
            here, there = (film.peak_pressures(rows, speed * one) for one in (1.0, 1.001))
            power = np.log(there / here) / math.log(1.001)
            speed = speed * np.exp(np.clip(np.log(strength / here) / power, -10.0, 10.0))
        spline = make_interp_spline(np.log(rows), np.log(speed), k=5)
        return lambda gap: math.exp(float(spline(math.log(gap))))

    def limiter(self) -> Limiter:
        """Force that is left at a gap, a speed and a force without limits."""
        return self.limited_force

    def force_law(self) -> ForceLaw:
        """Force as a motion takes it."""
        if self.film.is_linear:
            return self.linear_law()
        return ForceLaw(self.force, self._marks, self.film.shape.level, check=self._check)

    def linear_law(self) -> ForceLaw:
        """The same at the viscosity at rest, with slip."""
        level = self.film.shape.level
        return ForceLaw(self.linear_force, self._marks, level, rate="proportional")

    @property
    def _marks(self) -> tuple[float, ...]:
        full = self.film.shape.full_gap
        return (full,) if 0.0 < full < math.inf else ()

    def _check(self, gap: float, speed: float) -> None:
        """Refuse a motion at which no pressure carries the flux.

        Raises
        ------
        InfeasibleError
            With the speed and the cure.
        """
        if speed < 0.0 and not math.isfinite(self.force(gap, speed)):
            raise InfeasibleError(
                f"the film cannot close at {-speed:g} m/s at a gap of {gap:g} m: its viscosity "
                "grows with pressure without bound, and no pressure drives the liquid out; close "
                "more slowly, or take RoelandsViscosity, which grows less"
            )
