"""The viscous force of the film, and the limits of what the film can carry."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, ClassVar, Literal

from attrs import field, frozen

from ...lubrication import film_limits
from ...lubrication import squeeze_film as squeeze
from ...scene.scenes import SlidingScene
from ...units import si
from ...validators import choice, positive
from .base import FilmLimit, ForceLaw, Limiter, SeparationForce
from .film_shape import FilmShape, film_shape, needs_extent

if TYPE_CHECKING:
    from ...accuracy import Accuracy
    from ...scene.scenes import SeparationScene

__all__ = ["ShearLimit", "TensionLimit", "ViscousForce", "keeps_radius"]


def _viscosity(scene: SeparationScene) -> float:
    viscosity = scene.meniscus.liquid.at(scene.temperature).viscosity
    assert viscosity is not None  # plan() has asked lacks() first
    return viscosity


@frozen(kw_only=True)
class ViscousForce(SeparationForce):
    """Resistance of a Newtonian film to being drawn out, by Reynolds' equation.

    Parameters
    ----------
    closure : {"volume-conserving", "flooded", "as-published"}
        Whether the film draws in as the gap opens, so that its volume stays (a film without a
        given volume stands in a bath and stays full to the rim); or keeps the radius it has at
        the start. ``"as-published"``: Eqs. (3.19) and (3.34) between flats, which keep the
        radius though the volume is given, and Eq. (3.26) under a sphere; for reproduction only,
        with what is wrong in ``result.errata``.

    Notes
    -----
    Valid for r/h > 5 and for a reduced Reynolds number below 1: both are printed with a result.
    """

    name: ClassVar[str] = "viscous-force"
    summary: ClassVar[str] = "viscous force of the film (Reynolds)"
    column: ClassVar[str] = "viscous_force"
    takes_pressure: ClassVar[bool] = True

    closure: Literal["volume-conserving", "flooded", "as-published"] = field(
        default="volume-conserving",
        validator=choice("volume-conserving", "flooded", "as-published"),
    )

    @property
    def sources(self) -> tuple[str, ...]:
        """See `Effect.sources`."""
        return (
            "Stefan 1874, flats: Eq. (3.18) of Cai and Bhushan 2007a",
            "Matthewson 1988, sphere: Eqs. (3.22)-(3.24) of Cai and Bhushan 2007a",
        )

    def cites(self, scene: SeparationScene) -> tuple[str, ...]:
        """See `SeparationEffect.cites`."""
        flats, sphere = self.sources
        return (flats,) if scene.interface.is_flat else (sphere,)

    def lacks(self, scene: SeparationScene) -> tuple[str, ...]:
        """See `SeparationEffect.lacks`."""
        state = scene.meniscus.liquid.at(scene.temperature)
        missing = () if state.viscosity is not None else ("liquid.viscosity [Pa.s]",)
        return missing + needs_extent(scene)

    def prepare(self, scene: SeparationScene, accuracy: Accuracy) -> ForceLaw:
        """See `SeparationForce.prepare`."""
        film = film_shape(scene, constant_radius=keeps_radius(scene))
        viscosity = _viscosity(scene)
        kinks = (film.full_gap,) if 0.0 < film.full_gap < math.inf else ()
        if math.isinf(film.sphere_radius):
            return _disc_law(film, viscosity, kinks)
        if math.isfinite(film.level):
            return _level_law(film, viscosity, kinks)
        return _sphere_law(film, viscosity, kinks)


def _disc_law(film: FilmShape, viscosity: float, kinks: tuple[float, ...]) -> ForceLaw:
    n, full = film.menisci, film.full_gap
    drop = film.volume if math.isfinite(full) else 0.0  # both forces are those at a gap of 1 m
    whole = n * float(squeeze.disc_force(film.rim if full else 0.0, 1.0, 1.0, viscosity))
    rest = n * float(squeeze.disc_force(squeeze.disc_radius(drop, 1.0), 1.0, 1.0, viscosity))

    def force(gap: float, speed: float) -> float:
        return whole * speed / gap**3 if gap <= full else rest * speed / gap**5

    def exponent(gap: float) -> float:
        return 3.0 if gap < full else 5.0

    def impulse(start: float, end: float) -> float:
        if end < start:
            return -impulse(end, start)
        if end <= full:
            return n * float(squeeze.disc_impulse_flooded(film.rim, start, end, viscosity))
        if start >= full:
            return n * float(squeeze.disc_impulse_conserved(film.volume, start, end, viscosity))
        return impulse(start, full) + impulse(full, end)

    return ForceLaw(force, kinks, exponent=exponent, impulse=impulse)


def _level_law(film: FilmShape, viscosity: float, kinks: tuple[float, ...]) -> ForceLaw:
    """Force of a film under a sphere whose rim keeps its height, until the sphere leaves it."""
    n, sphere, level, full = film.menisci, film.sphere_radius, film.level, film.full_gap

    def force(gap: float, speed: float) -> float:
        return n * float(squeeze.sphere_force(sphere, gap, film.height(gap), speed, viscosity))

    def impulse(start: float, end: float) -> float:
        if end < start:
            return -impulse(end, start)
        if start < full < end:
            return impulse(start, full) + impulse(full, end)
        if end <= full:
            return n * float(
                squeeze.sphere_impulse_flooded(sphere, film.rim, start, end, viscosity)
            )
        return n * squeeze.sphere_impulse_constant_rim(sphere, level, start, end, viscosity)

    def exponent(gap: float) -> float:
        # d ln c/d ln D of (1 - D/s)^2/D is 1 + 2 D/(s - D); it may not grow without bound.
        return 1.0 + 2.0 * gap / max(level - gap, 0.5 * gap)

    return ForceLaw(force, kinks, end=level, exponent=exponent, impulse=impulse)


def _sphere_law(film: FilmShape, viscosity: float, kinks: tuple[float, ...]) -> ForceLaw:
    n, height, full, sphere = film.menisci, film.height, film.full_gap, film.sphere_radius
    flooded = math.isinf(film.volume)

    def force(gap: float, speed: float) -> float:
        return n * float(squeeze.sphere_force(sphere, gap, height(gap), speed, viscosity))

    def impulse(start: float, end: float) -> float:
        if end < start:
            return -impulse(end, start)
        if flooded or end <= full:
            return n * float(
                squeeze.sphere_impulse_flooded(sphere, film.rim, start, end, viscosity)
            )
        if start >= full:
            return n * float(
                squeeze.sphere_impulse_conserved(sphere, height(start), start, end, viscosity)
            )
        return impulse(start, full) + impulse(full, end)

    def exponent(gap: float) -> float:
        # d ln c/d ln D of (1 - D/H)^2/D, with H free: 1 + 2 D/H at constant volume.
        return 1.0 + 2.0 * gap / height(gap)

    return ForceLaw(force, kinks, exponent=exponent, impulse=impulse)


@frozen(kw_only=True)
class TensionLimit(FilmLimit):
    """The liquid cannot be pulled below a given pressure.

    Parameters
    ----------
    tension : float or "vapour"
        Largest drop below ambient pressure that the liquid bears [Pa]; ``"vapour"``: down to
        (nearly) vacuum, that is `ambient_pressure`. Oils are known to hold 1 to 10 bar for
        milliseconds.
    ambient_pressure : float
        Pressure around the film [Pa].
    cavity : {"truncated", "reynolds"}
        Pressure profile cut off at the limit; or, between flats, a cavity whose edge has no
        pressure slope (Swift-Stieber). The second gives up to 15 % less force.

    Notes
    -----
    Acts while the gap opens. A cavity with a memory of its own is left out.
    """

    name: ClassVar[str] = "tension-limit"
    summary: ClassVar[str] = "the liquid cannot be pulled below a given pressure"
    takes_pressure: ClassVar[bool] = True

    tension: float | Literal["vapour"] = field(default="vapour", metadata=si("Pa"))
    ambient_pressure: float = field(default=101_325.0, validator=positive, metadata=si("Pa"))
    cavity: Literal["truncated", "reynolds"] = field(
        default="truncated", validator=choice("truncated", "reynolds")
    )

    @tension.validator
    def _check_tension(self, attribute: object, value: object) -> None:
        if value != "vapour":
            positive(self, attribute, value)  # type: ignore[arg-type]

    @property
    def pressure_drop(self) -> float:
        """Largest drop below ambient pressure [Pa]."""
        return self.ambient_pressure if self.tension == "vapour" else float(self.tension)

    @property
    def sources(self) -> tuple[str, ...]:
        """See `Effect.sources`."""
        if self.cavity == "reynolds":
            return ("Swift-Stieber condition at the cavity edge; Resch and Scheidl 2014",)
        return ("parabolic pressure truncated at the limit; Scheidl and Gradl 2016",)

    def lacks(self, scene: SeparationScene) -> tuple[str, ...]:
        """See `SeparationEffect.lacks`."""
        if self.cavity == "reynolds" and not scene.interface.is_flat:
            return ('two flats (or cavity="truncated")',)
        return ()

    def prepare(self, scene: SeparationScene, accuracy: Accuracy) -> Limiter:
        """See `FilmLimit.prepare`."""
        film, drop = film_shape(scene, constant_radius=keeps_radius(scene)), self.pressure_drop
        n, radius, height = film.menisci, film.radius, film.height
        disc = (
            film_limits.disc_tension_reynolds
            if self.cavity == "reynolds"
            else film_limits.disc_tension_truncated
        )

        def between_flats(gap: float, speed: float, force: float) -> float:
            return disc(force, n * math.pi * radius(gap) ** 2, drop) if speed > 0.0 else force

        def under_sphere(gap: float, speed: float, force: float) -> float:
            if speed <= 0.0:
                return force
            return n * film_limits.sphere_tension_truncated(
                force / n, film.sphere_radius, gap, height(gap), drop
            )

        return between_flats if math.isinf(film.sphere_radius) else under_sphere


@frozen(kw_only=True)
class ShearLimit(FilmLimit):
    """The shear stress on the walls cannot exceed the limiting shear strength of the liquid.

    Parameters
    ----------
    strength : float
        Limiting shear strength [Pa]; for oils about 1e6 to 1e8.
    law : {"truncated", "bair-winer", "eyring"}
        How the stress nears it. ``"truncated"``: Newtonian up to the strength. The others are for a
        `SlidingScene`: tau_L (1 - exp(-eta g/tau_L)) of Bair and Winer, with the shear rate g, and
        tau_E asinh(eta g/tau_E) of Eyring, for which `strength` is a scale and no bound.
    """

    name: ClassVar[str] = "shear-limit"
    summary: ClassVar[str] = "wall shear stress bounded by a limiting shear strength"
    takes_pressure: ClassVar[bool] = True

    strength: float = field(validator=positive, metadata=si("Pa"))
    law: Literal["truncated", "bair-winer", "eyring"] = field(
        default="truncated", validator=choice("truncated", "bair-winer", "eyring")
    )

    @property
    def sources(self) -> tuple[str, ...]:
        """See `Effect.sources`."""
        if self.law == "eyring":
            return ("shear stress as a process of rates, Eyring 1936",)
        return ("limiting shear strength, Bair and Winer 1979",)

    def lacks(self, scene: SeparationScene | SlidingScene) -> tuple[str, ...]:
        """See `SeparationEffect.lacks`."""
        if self.law != "truncated" and not isinstance(scene, SlidingScene):
            return ('law="truncated": the others are for a SlidingScene',)
        return ()

    def prepare(self, scene: SeparationScene, accuracy: Accuracy) -> Limiter:
        """See `FilmLimit.prepare`."""
        film, strength = film_shape(scene, constant_radius=keeps_radius(scene)), self.strength
        n, radius, height = film.menisci, film.radius, film.height

        def between_flats(gap: float, speed: float, force: float) -> float:
            return n * film_limits.disc_shear_limited(force / n, radius(gap), gap, strength)

        def under_sphere(gap: float, speed: float, force: float) -> float:
            return n * film_limits.sphere_shear_limited(
                force / n, film.sphere_radius, gap, height(gap), strength
            )

        return between_flats if math.isinf(film.sphere_radius) else under_sphere


def keeps_radius(scene: SeparationScene) -> bool:
    """Whether the viscous force of this scene keeps the radius of the film."""
    viscous = scene.effect(ViscousForce)
    if viscous is None:
        return False
    as_printed = viscous.closure == "as-published" and scene.interface.is_flat
    return viscous.closure == "flooded" or as_printed
