"""Film of a liquid whose viscosity depends on pressure and shear, or which slips: force, pressure.

Between discs and under a sphere the flux at each radius follows from the motion, so that any flow
law gives the pressure by one integral (`contactkit.lubrication.flow_laws.squeeze`). A film whose
viscosity stays is proportional to the speed, slip or not; any other is F(h, v).
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np
from attrs import evolve, frozen

from ...errors import InfeasibleError
from ...lubrication import squeeze_film as newtonian
from ...lubrication.flow_laws.base import FlowLaw
from ...lubrication.flow_laws.newtonian import Newtonian
from ...lubrication.flow_laws.squeeze import SqueezedFilm, squeeze_film
from ...lubrication.flow_laws.walls import Flats, Paraboloid, Walls
from ..effects.force_law import ForceLaw
from .limits import truncated_force

if TYPE_CHECKING:
    from ...scene.scenes import SeparationScene
    from ..effects.base import Limiter
    from ..effects.film_shape import FilmShape
    from ..effects.prepared import PreparedScene

__all__ = ["RheologicalFilm"]

_STEP = 1e-6  # relative, of gap and speed, of the slopes: forces are right to 1e-12 of themselves


@frozen(eq=False)
class RheologicalFilm:
    """Equal films between discs or under a sphere, of any flow law.

    Parameters
    ----------
    shape : FilmShape
        One of the films, as the viscous force takes it.
    law : FlowLaw
        Flow of the liquid, with slip and pressure.
    viscosity : float
        Viscosity of the liquid at rest and ambient pressure [Pa.s].
    strength : float
        Tension at which the liquid cavitates [Pa]; inf if it never does.
    """

    shape: FilmShape
    law: FlowLaw
    viscosity: float
    strength: float

    @classmethod
    def of(
        cls, prepared: PreparedScene[SeparationScene], parts: tuple[str, ...]
    ) -> RheologicalFilm:
        """Film of a scene with some parts of the rheology of its liquid, and its slip."""
        from ..effects.viscous import TensionLimit, viscous_film

        scene, viscosity = prepared.scene, prepared.liquid.viscosity
        meniscus, limit = scene.meniscus, scene.effect(TensionLimit)
        liquid, law = meniscus.liquid, None
        if liquid.shear_viscosity is not None and "shear_viscosity" in parts:
            law = liquid.shear_viscosity.flow_law(viscosity)
        pressure = liquid.pressure_viscosity if "pressure_viscosity" in parts else None
        flow = evolve(
            law if law is not None else Newtonian(viscosity=viscosity),
            slip_length=(meniscus.slip_length_lower, meniscus.slip_length_upper),
            pressure_law=None if pressure is None else pressure.pressure_law(viscosity),
        )
        strength = math.inf if limit is None else limit.tension
        return cls(viscous_film(prepared), flow, viscosity, strength)

    @property
    def is_linear(self) -> bool:
        """Whether the force is proportional to the speed."""
        return isinstance(self.law, Newtonian) and self.law.pressure_law is None

    @property
    def _walls(self) -> Walls:
        sphere = self.shape.sphere_radius
        return Flats() if math.isinf(sphere) else Paraboloid(radius=sphere)

    def squeezed(self, gap: Any, speed: Any, radius: Any) -> SqueezedFilm:
        """One of the films at gaps [m], speeds [m/s] and radii of its rim [m]."""
        return squeeze_film(self.law, self._walls, gap, speed, radius)

    def force(self, gap: float, speed: float) -> float:
        """Force of all films [N]; -inf where no pressure closes the gap so fast."""
        radius = self.shape.radius(gap)
        if speed == 0.0 or not radius > 0.0:
            return 0.0
        return self.shape.menisci * float(self.squeezed(gap, speed, radius).force)

    def newtonian_force(self, gap: float, speed: float) -> float:
        """Force [N] of the same films without rheology and slip."""
        film = self.shape
        if math.isinf(film.sphere_radius):
            one = newtonian.disc_force(film.radius(gap), gap, speed, self.viscosity)
        else:
            height = film.height(gap)
            one = newtonian.sphere_force(film.sphere_radius, gap, height, speed, self.viscosity)
        return film.menisci * float(one)

    def force_ratio(self, gap: float, speed: float) -> float:
        """Force over that without rheology and slip [-]; 1 at rest."""
        plain = self.newtonian_force(gap, speed)
        return self.force(gap, speed) / plain if plain else 1.0

    def peak_pressure(self, gap: float, speed: float) -> float:
        """Largest pressure difference from ambient [Pa]; the strength where it cavitates."""
        radius = self.shape.radius(gap)
        if speed == 0.0 or not radius > 0.0:
            return 0.0
        peak = abs(float(self.squeezed(gap, speed, radius).centre_pressure))
        return min(peak, self.strength) if speed > 0.0 else peak

    def bounded_force(self, gap: float, speed: float) -> float:
        """Force [N] of films whose pressure is truncated at the strength of the liquid."""
        radius = self.shape.radius(gap)
        if speed == 0.0 or not radius > 0.0:
            return 0.0
        film = self.squeezed(gap, speed, radius)
        if speed < 0.0 or -float(film.centre_pressure) <= self.strength:
            return self.shape.menisci * float(film.force)
        return self.shape.menisci * truncated_force(film, radius, self.strength)

    def tension_limiter(self) -> Limiter:
        """Force that a truncated pressure leaves, at a gap, a speed and a force without limits."""

        def limiter(gap: float, speed: float, force: float) -> float:
            return self.bounded_force(gap, speed) if speed > 0.0 else force

        return limiter

    def force_law(self) -> ForceLaw:
        """Force as it is prepared for a motion."""
        film = self.shape
        marks = (film.full_gap,) if 0.0 < film.full_gap < math.inf else ()
        end = film.level
        if self.is_linear:
            return ForceLaw(self.force, marks, end, rate="proportional")
        return ForceLaw(self.force, marks, end, slopes=self._slopes, check=self._check)

    def _slopes(self, gap: float, speed: float) -> tuple[float, float]:
        """Slopes of the force [N/m], [N.s/m], by central differences of one call."""
        radius = self.shape.radius
        away = speed or self._slow(gap)
        gaps = np.array([gap * (1.0 - _STEP), gap * (1.0 + _STEP), gap, gap])
        speeds = np.array([speed, speed, away * (1.0 - _STEP), away * (1.0 + _STEP)])
        radii = np.array([radius(one) for one in gaps.tolist()])
        forces = self.shape.menisci * np.asarray(self.squeezed(gaps, speeds, radii).force)
        by_gap = (forces[1] - forces[0]) / (gaps[1] - gaps[0])
        return float(by_gap), float((forces[3] - forces[2]) / (speeds[3] - speeds[2]))

    def _slow(self, gap: float) -> float:
        """Speed [m/s] that is as good as none: at a millionth of the pressure of the atmosphere."""
        plain = self.newtonian_force(gap, 1.0)
        area = self.shape.menisci * math.pi * self.shape.radius(gap) ** 2
        return 0.1 * min(area, 1.0) / plain if plain > 0.0 else 1.0

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
