"""Film of a liquid whose viscosity depends on pressure and shear, or which slips: force, pressure.

Between discs and under a sphere the flux at each radius follows from the motion, so that any flow
law gives the pressure by one integral (`contactkit.lubrication.flow_laws.squeeze`).
"""

from __future__ import annotations

import math
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from attrs import evolve, frozen

from ...lubrication import squeeze_film as newtonian
from ...lubrication.flow_laws.base import FlowLaw
from ...lubrication.flow_laws.closed_forms import slip_disc_factor
from ...lubrication.flow_laws.newtonian import Newtonian
from ...lubrication.flow_laws.squeeze import SqueezedFilm, squeeze_film
from ...lubrication.flow_laws.walls import Flats, Paraboloid, Walls
from .limits import truncated_force

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ...scene.scenes import SeparationScene
    from ..effects.film_shape import FilmShape
    from ..effects.prepared import PreparedScene

    Array = NDArray[np.floating[Any]]

__all__ = ["RheologicalFilm", "flow_law"]


def flow_law(
    prepared: PreparedScene[SeparationScene], parts: tuple[str, ...]
) -> tuple[FlowLaw, float]:
    """Flow law of a scene with some parts of the rheology of its liquid, and its slip.

    Also the tension [Pa] at which the liquid cavitates; inf if it never does.
    """
    from ..effects.viscous import TensionLimit

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
    return flow, math.inf if limit is None else limit.tension


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
        from ..effects.viscous import viscous_film

        law, strength = flow_law(prepared, parts)
        return cls(viscous_film(prepared), law, prepared.liquid.viscosity, strength)

    @property
    def is_linear(self) -> bool:
        """Whether the force is proportional to the speed."""
        return isinstance(self.law, Newtonian) and self.law.pressure_law is None

    @property
    def is_even(self) -> bool:
        """Whether the gap is the same everywhere: what slip leaves is known in closed form then."""
        return math.isinf(self.shape.sphere_radius)

    @property
    def has_one_variable(self) -> bool:
        """Whether the force over that at the viscosity at rest follows from the rate of shear."""
        return self.is_even and not self.slips and self.law.pressure_law is None

    @property
    def slips(self) -> bool:
        """Whether the liquid slips at a wall."""
        return max(self.law.slip_length) > 0.0

    @cached_property
    def _walls(self) -> Walls:
        sphere = self.shape.sphere_radius
        return Flats() if math.isinf(sphere) else Paraboloid(radius=sphere)

    @cached_property
    def _linear(self) -> Newtonian:
        """Law of the liquid at rest, with its slip."""
        return Newtonian(viscosity=self.viscosity, slip_length=self.law.slip_length)

    def _squeezed(self, gap: Array, speed: Array) -> SqueezedFilm:
        return squeeze_film(self.law, self._walls, gap, speed, self.radii(gap))

    def radii(self, gap: Array) -> Array:
        """Radii of the rim [m] at gaps [m]."""
        found = [self.shape.radius(one) for one in gap.ravel().tolist()]
        return np.reshape(found, gap.shape)

    def forces(self, gap: Array, speed: Array) -> tuple[Array, Array]:
        """Forces of all films [N] at gaps [m] and speeds [m/s], and those at the viscosity at rest.

        -inf where no pressure closes the gap so fast. The films have a radius.
        """
        linear = squeeze_film(self._linear, self._walls, gap, speed, self.radii(gap)).force
        force = linear if self.is_linear else self._squeezed(gap, speed).force
        n = self.shape.menisci
        return n * np.asarray(force), n * np.asarray(linear)

    def bounded_forces(self, gap: Array, speed: Array) -> Array:
        """Forces [N] of films whose pressure is truncated at the strength of the liquid."""
        return self.bounded_and_full(gap, speed)[0]

    def bounded_and_full(self, gap: Array, speed: Array) -> tuple[Array, Array]:
        """Forces [N] of films whose pressure is truncated, and of the same without that."""
        if gap.ndim > 1:  # one call has nodes of one number of panels
            pairs = [self.bounded_and_full(*one) for one in zip(gap, speed, strict=True)]
            bounded, full = (np.array(part) for part in zip(*pairs, strict=True))
            return bounded, full
        film, radii, n = self._squeezed(gap, speed), self.radii(gap), self.shape.menisci
        forces = np.array(film.force, dtype=float)
        over = (speed > 0.0) & (-np.asarray(film.centre_pressure) > self.strength)
        for place in zip(*np.nonzero(over), strict=True):
            one = (film.radius[place], film.gradient[place])
            forces[place] = truncated_force(*one, float(radii[place]), self.strength)
        return n * forces, n * np.asarray(film.force)

    def peak_pressures(self, gap: Array, speed: Array) -> Array:
        """Largest pressure differences from ambient [Pa] of full films."""
        return np.asarray(np.abs(self._squeezed(gap, speed).centre_pressure))

    def linear_pressures(self, gap: Array) -> Array:
        """Largest pressure differences per speed [Pa.s/m] at the viscosity at rest, with slip."""
        plain = evolve(self, law=evolve(self.law, pressure_law=None))
        return plain.peak_pressures(gap, np.ones_like(gap))

    def force(self, gap: float, speed: float) -> float:
        """Force of all films [N]; -inf where no pressure closes the gap so fast."""
        if speed == 0.0 or not self.shape.radius(gap) > 0.0:
            return 0.0
        return float(self.forces(np.array([gap]), np.array([speed]))[0][0])

    def bounded_force(self, gap: float, speed: float) -> float:
        """See `bounded_forces`."""
        if speed == 0.0 or not self.shape.radius(gap) > 0.0:
            return 0.0
        return float(self.bounded_forces(np.array([gap]), np.array([speed]))[0])

    def newtonian_force(self, gap: float, speed: float) -> float:
        """Force [N] of the same films without rheology and slip."""
        film = self.shape
        if math.isinf(film.sphere_radius):
            one = newtonian.disc_force(film.radius(gap), gap, speed, self.viscosity)
        else:
            height = film.height(gap)
            one = newtonian.sphere_force(film.sphere_radius, gap, height, speed, self.viscosity)
        return film.menisci * float(one)

    def linear_force(self, gap: float, speed: float) -> float:
        """Force [N] at the viscosity at rest, with slip: between flats in closed form."""
        plain = self.newtonian_force(gap, speed)
        if not self.slips or plain == 0.0:
            return plain
        if math.isinf(self.shape.sphere_radius):
            return plain * float(slip_disc_factor(gap, *self.law.slip_length))
        radius = self.shape.radius(gap)
        one = squeeze_film(self._linear, self._walls, gap, speed, radius).force
        return self.shape.menisci * float(one)

    def shear_per_speed(self, gap: float) -> float:
        """Fastest shear at a wall of a Newtonian film over the speed [1/m]."""
        film = self.shape
        if math.isinf(film.sphere_radius):
            return 3.0 * film.radius(gap) / (gap * gap)
        place = min(film.radius(gap), math.sqrt(2.0 / 3.0 * film.sphere_radius * gap))
        return 3.0 * place / (gap + place * place / (2.0 * film.sphere_radius)) ** 2
