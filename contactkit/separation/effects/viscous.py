"""Viscous force of the film, and its limits: tension and shear."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, ClassVar, Literal

from attrs import field, frozen

from ...errors import DescriptionError, NotSimulatedError, PlanError
from ...lubrication import dimensionless as numbers
from ...lubrication import film_limits
from ...lubrication import squeeze_film as squeeze
from ...scene.column import Column
from ...scene.loading import ImposedForce, ImposedTime
from ...scene.scenes import SlidingScene
from ...units import si
from ...validators import choice, finite, optional, positive
from ...validity import ValidityNumber
from ..cavity.law import Cavitation, CavityLaw
from ..face.shape import closed_form, on_face, shape_of
from .base import CAVITY, FilmLimit, FilmStatus, ForcePart, Limiter, LimitKind, SeparationForce
from .constant_force import constant_force_time
from .film_shape import FilmShape, film_shape, needs_extent
from .film_validity import apparent_viscosity, film_numbers
from .force_law import ForceLaw, law_impulse
from .meniscus import MeniscusForce
from .published_film import published_film

if TYPE_CHECKING:
    from ...as_published.arguments import PublishedValue
    from ...scene.scenes import SeparationScene
    from ..face.film import FaceFilm
    from ..rheology.heating import HeatedFilm
    from .base import Curve, PlanView, RunView
    from .prepared import PreparedScene

__all__ = [
    "ShearLimit",
    "TensionLimit",
    "ViscousForce",
    "ViscousPart",
    "keeps_radius",
    "viscous_film",
    "viscous_law",
]


@frozen(eq=False)
class ViscousPart(ForcePart):
    """Force and impulse of the viscous force, with and without limits.

    `force` is the instantaneous force [N] along the run, after the limits; `newtonian_force` what
    it would be without them; `impulse` the time integral of the force over the whole opening
    [N.s]; `newtonian_impulse` the same without limits, which no path in time changes.
    """

    @property
    def newtonian_force(self) -> Curve:
        """Instantaneous force [N] of the film without limits."""
        return self.result["newtonian_force"]

    @property
    def impulse(self) -> float:
        """Time integral of the force over the whole opening [N.s]."""
        return self.result.impulses["viscous_impulse"]

    @property
    def newtonian_impulse(self) -> float:
        """Time integral of the force of the film without limits [N.s].

        Raises
        ------
        NotSimulatedError
            If the film loses liquid under limits, or its viscosity depends on shear or pressure:
            the way decides, and was not taken without them.
        """
        found = self.result.impulses.get("newtonian_impulse")
        rheology = self.result.plan.prepared.rheology
        if found is None and rheology is not None and not rheology.is_linear:
            raise NotSimulatedError(
                "no impulse without limits of a film whose viscosity depends on shear or pressure: "
                "it depends on the motion; simulate it without the limits"
            )
        if found is None:
            raise NotSimulatedError(
                "no impulse without limits of a film that loses liquid: it depends on the motion; "
                "simulate it without the limits"
            )
        return found

    def mean_force(self, time: float | None = None) -> float:
        """Time average [N] of the force over an opening that takes `time` [s]: impulse/time.

        Raises
        ------
        DescriptionError
            If no time is given, neither here nor with the scene.
        """
        loading = self.result.plan.scene.loading
        if time is None and isinstance(loading, ImposedTime):
            time = loading.time
        if time is None or not time > 0.0:
            raise DescriptionError(
                "mean_force(time)",
                time,
                "be positive",
                unit="s",
                hint="give the duration of the opening here, or as ImposedTime(time=...)",
            )
        return self.impulse / time

    @property
    def temperature_rise(self) -> float:
        """Bound on the temperature rise of the film over the run [K].

        The smaller of two: all work stays in the liquid, and walls of constant temperature take up
        all heat.

        Raises
        ------
        NotSimulatedError
            If the liquid has neither a `heat_capacity` with a density, nor a
            `thermal_conductivity`.
        """
        from ..rheology.heating import temperature_rise

        found = temperature_rise(_heated(self.result.plan.prepared), _wet_path(self.result))
        if found is None:
            raise NotSimulatedError(
                "no temperature rise of the film: give liquid.thermal_conductivity [W/m/K], or "
                "liquid.heat_capacity [J/kg/K] and density [kg/m3]"
            )
        return found

    def time_at_constant_force(self, force: float | None = None) -> float:
        """Time [s] that a constant pull [N] takes to open the gap; inf if it never does.

        Closed form for a massless body; the meniscus, where the scene has one, pulls with the
        Laplace pressure of a thin film. Without the limits of the liquid.

        Raises
        ------
        DescriptionError
            If no force is given, neither here nor with the scene.
        """
        plan = self.result.plan
        loading = plan.scene.loading
        if force is None and isinstance(loading, ImposedForce):
            force = loading.force
        if force is None or not force > 0.0:
            raise DescriptionError(
                "time_at_constant_force(force)",
                force,
                "be positive",
                unit="N",
                hint="give the pull here, or as ImposedForce(force=...)",
            )
        prepared = plan.prepared
        return constant_force_time(prepared, viscous_film(prepared), viscous_law(prepared), force)


def _wet_path(result: RunView) -> list[tuple[float, float]]:
    """Gaps [m] and speeds [m/s] of a run while its film spans the gap."""
    gaps, loading = result.gap, result.plan.scene.loading
    if isinstance(loading, ImposedTime):
        whole = gaps <= result.plan.film.end
        speeds = (gaps[-1] - gaps[0]) / loading.time + 0.0 * gaps
    else:
        whole, speeds = result["film_status"] != FilmStatus.BROKEN, result["speed"]
    whole = whole & (gaps > 0.0)
    return list(zip(gaps[whole].tolist(), speeds[whole].tolist(), strict=True))


@frozen(kw_only=True)
class ViscousForce(SeparationForce):
    """Viscous force of a film that is drawn out, by Reynolds' equation.

    Parameters
    ----------
    closure : {"volume-conserving", "flooded", "as-published"}
        Whether the film draws in as the gap opens, so that its volume stays (a film without a
        given volume is flooded and stays full to the rim); or keeps the radius it has at
        the start. ``"as-published"``: Eqs. (3.19) and (3.34) between flats, which keep the
        radius though the volume is given, and Eq. (3.26) under a sphere; for reproduction only,
        with what is wrong in ``result.errata``. Their radius x_n0 and their height s_0 are then
        those of the arc of the source, which ``MeniscusForce(profile="as-published")`` has as
        well, and not those of an upright rim: of ``Meniscus.from_radius(profile="arc")`` the
        radius that is given. That is up to 5 % of the force at a radius of 50 gaps.
    rheology : {"all", "newtonian"}, optional
        What is computed of a liquid whose viscosity depends on pressure or shear: all of it, or
        nothing. None: the parts that change the force by 1 % or more on the motion that the loading
        lets expect. The plan says what each part does, and a result how much is left out. Slip at
        the walls is always computed.

    Notes
    -----
    Between discs, and under a sphere, in closed form; so are rings, rectangles, ellipses,
    equilateral triangles, a round recess, a crown. Any other face is solved on a grid, within
    ``Accuracy(film_rtol=...)``, once in a plan. The film of a face that is no disc is flooded to
    its rims.

    Valid for r/h > 5 and for a reduced Reynolds number below 1: both are printed with a result.
    Compression of the liquid, deformation of the bodies and the weight of the film are left out;
    how large they are is printed too, where the liquid has a bulk modulus and a density, and a
    body a solid.
    """

    name: ClassVar[str] = "viscous-force"
    summary: ClassVar[str] = "viscous force of the film (Reynolds)"
    column: ClassVar[Column] = Column("viscous_force", "N", "viscous force", "#c1440e")
    newtonian: ClassVar[Column] = Column(
        "newtonian_force", "N", "viscous force without limits", "#c1440e", ":"
    )
    so_far: ClassVar[Column] = Column("viscous_impulse", "N.s", "viscous impulse so far", "#c1440e")
    touching: ClassVar[str] = (
        "the viscous impulse from a touching sphere is infinite, it grows as ln(1/gap); give a "
        "cut-off gap [m], such as the roughness or 0.2 to 0.3 nm"
    )
    takes_pressure: ClassVar[bool] = True
    published_choice: ClassVar[str] = "closure"

    closure: Literal["volume-conserving", "flooded", "as-published"] = field(
        default="volume-conserving",
        validator=choice("volume-conserving", "flooded", "as-published"),
    )
    rheology: Literal["all", "newtonian"] | None = field(
        default=None, validator=optional(choice("all", "newtonian"))
    )

    @property
    def sources(self) -> tuple[str, ...]:
        """See `Effect.sources`."""
        return (
            "Stefan 1874, flats: Eq. (3.18) of Cai and Bhushan 2007a",
            "Matthewson 1988, sphere: Eqs. (3.22)-(3.24) of Cai and Bhushan 2007a",
        )

    def cites(self, scene: SeparationScene) -> tuple[str, ...]:
        """See `Effect.cites`."""
        flats, sphere = self.sources
        if any(body.surface.curvature is None for body in scene.interface.bodies):
            return ("Reynolds 1886: finite volumes",)
        if not scene.interface.has_discs:
            shape = shape_of(scene.interface)
            known = closed_form(shape)
            by = "finite volumes" if known is None else known.law.source
            rough = "flow factors of a rough gap: homogenisation; Patir and Cheng 1978"
            more = (rough,) if shape.roughness is not None else ()
            return (f"Reynolds 1886: {by}", *more, *self._cites_of_liquid(scene))
        return (flats if scene.interface.is_flat else sphere, *self._cites_of_liquid(scene))

    def _cites_of_liquid(self, scene: SeparationScene) -> tuple[str, ...]:
        """Sources of the rheology that the liquid of a scene gives, and of its slip."""
        liquid = scene.meniscus.liquid
        laws = (liquid.pressure_viscosity, liquid.shear_viscosity)
        given = () if self.rheology == "newtonian" else tuple(law for law in laws if law)
        slip = ("slip of a squeezed film: Vinogradova 1995",) if scene.meniscus.slips else ()
        flow = ("flux of any flow law: Rabinowitsch 1929",) if given or slip else ()
        return (*(law.cite for law in given), *flow, *slip)

    @property
    def takes_solids(self) -> bool:
        """See `SeparationEffect.takes_solids`: they say whether the faces are stiff enough."""
        return True

    def reads(self, scene: SeparationScene) -> tuple[str, ...]:
        """See `Effect.reads`: the tolerance of its film, which a closed form meets by itself."""
        return ("film_rtol",)

    def liquid_needs(self, scene: SeparationScene) -> tuple[str, ...]:
        """See `Effect.liquid_needs`: a film of fixed pressure has a height as well."""
        at_pressure = scene.meniscus.has_pressure
        return ("viscosity", "surface_tension") if at_pressure else ("viscosity",)

    def proportional_to(self, scene: SeparationScene) -> str:
        """See `SeparationForce.proportional_to`: the viscosity at rest, of a computed rheology."""
        return "viscosity"

    def lacks(self, scene: SeparationScene) -> tuple[str, ...]:
        """See `Effect.lacks`."""
        if on_face(scene):
            return _needs_of_face(scene)
        missing: tuple[str, ...] = ()
        if scene.meniscus.has_pressure and self.closure != "volume-conserving":
            missing += (
                f"interface.meniscus.volume [m3] with closure={self.closure!r}: at a fixed "
                f'pressure the rim keeps its height (or closure="volume-conserving")',
            )
        if scene.meniscus.slips and self.takes_printed():
            missing += ("no slip of the liquid for the equations as published",)
        return missing + needs_extent(scene)

    def prepare(self, prepared: PreparedScene[SeparationScene]) -> ForceLaw:
        """See `SeparationForce.prepare`."""
        return viscous_law(prepared)

    def equations(self, scene: SeparationScene) -> str:
        """See `SeparationEffect.equations`.

        A film that keeps its volume is what Eqs. (3.18) and (3.22) print; only the mean force of a
        given time, Eq. (3.19), is another one in print.
        """
        if self.takes_printed():
            return "as-published"
        mean = self.closure == "volume-conserving" and isinstance(scene.loading, ImposedTime)
        return "consistent" if mean and scene.interface.is_flat else ""

    def errata(self, plan: PlanView) -> tuple[PublishedValue, ...]:
        """See `SeparationEffect.errata`: as an impulse [N.s], which no time changes."""
        return (_erratum(plan),) if self.takes_printed() else ()

    def validity(
        self, plan: PlanView, path: Sequence[tuple[float, float]]
    ) -> tuple[ValidityNumber, ...]:
        """See `SeparationEffect.validity`."""
        both = _against_meniscus(plan.prepared, path) if plan.has(MeniscusForce) else ()
        return _validity(plan.prepared, path) + both

    def part(self, result: RunView) -> ViscousPart:
        """See `SeparationEffect.part`."""
        return ViscousPart(result, self.column)

    def scalars(self, result: RunView) -> dict[str, tuple[float, str]]:
        """See `SeparationEffect.scalars`."""
        if not isinstance(result.plan.scene.loading, ImposedTime):
            return {}
        return {"mean_viscous_force": (self.part(result).mean_force(), "N")}


def _needs_of_face(scene: SeparationScene) -> tuple[str, ...]:
    """What a film on a face that is no disc does not go with."""
    meniscus, viscous = scene.meniscus, scene.effect(ViscousForce)
    faces = scene.interface.faces
    rough = [face for face in faces if face.roughness is not None]
    cure = ' (or cavity="truncated")' if scene.interface.has_discs else ""
    is_fine = not rough or (len(rough) == 1 and all(face.is_level for face in faces))
    needs = {
        f"a Flat with a radius [m] or a planform, up to whose rim a cavity is followed{cure}": any(
            face.outline is not None for face in faces
        ),
        "FineRoughness on one face, that of both together, and even faces; beside tilt, crown, "
        "sphere, recesses or a relief give the roughness as part of the relief": is_fine
        and (not rough or scene.interface.is_flat),
        f"a flooded film, without interface.meniscus.volume or a pressure: the rim of one that "
        f"draws in from a face that is no disc is not known{cure}": meniscus.volume is None
        and not meniscus.has_pressure,
        "interface.meniscus.count = 1: a face that is no disc is not shared out": meniscus.count
        == 1,
        "an even disc, of a given radius, for the equations as published": viscous is None
        or not viscous.takes_printed(),
    }
    return tuple(need for need, is_met in needs.items() if not is_met)


def _face_law(film: FaceFilm, viscosity: float) -> ForceLaw:
    def force(gap: float, speed: float) -> float:
        return viscosity * film.coefficient(gap) * speed

    def impulse(start: float, end: float) -> float:
        return viscosity * film.impulse(start, end)

    return ForceLaw(force, rate="proportional", exponent=film.exponent, impulse=impulse)


def viscous_law(prepared: PreparedScene[SeparationScene]) -> ForceLaw:
    """Viscous force of a scene, without limits of the liquid."""
    rheology, face = prepared.rheology, prepared.face_film
    if rheology is not None and rheology.film is not None:
        return rheology.film.force_law()
    if face is not None:
        return _face_law(face, prepared.liquid.viscosity)
    return _law_of(viscous_film(prepared), prepared.liquid.viscosity)


def _law_of(film: FilmShape, viscosity: float) -> ForceLaw:
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

    return ForceLaw(force, kinks, rate="proportional", exponent=exponent, impulse=impulse)


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

    return ForceLaw(force, kinks, level, rate="proportional", exponent=exponent, impulse=impulse)


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

    return ForceLaw(force, kinks, rate="proportional", exponent=exponent, impulse=impulse)


@frozen(kw_only=True)
class TensionLimit(FilmLimit):
    """The liquid cavitates where its tension exceeds its strength, and a cavity opens.

    A liquid has two numbers: the tension at which it cavitates while it is whole, and the
    pressure of the cavity it leaves. The second is a hole filled with vapour or air, whatever the
    first was.

    Parameters
    ----------
    strength : float or "vapour"
        Tensile strength of the whole liquid, as a drop below ambient pressure [Pa]; ``"vapour"``:
        down to (nearly) vacuum, that is `ambient_pressure`. Oils are known to bear 1 to 10 bar for
        milliseconds.
    cavity_pressure : float, optional
        Absolute pressure in the cavity [Pa], for ``cavity="mass-conserving"``. None: that of
        vapour, nearly 0, or that at which the liquid cavitates where this is above. A liquid that
        goes on to bear its strength at the edge of the cavity has `ambient_pressure` less
        `strength`, which may be below 0.
    ambient_pressure : float
        Pressure around the film [Pa].
    cavity : {"mass-conserving", "truncated", "reynolds"}
        ``"mass-conserving"`` (Jakobsson, Floberg and Olsson), between flats, and under a sphere
        on a flooded face with a rim: the cavity has an
        edge, and the film remembers its ruptures until liquid has come back to it. The others
        remember nothing, and have one pressure, that of inception too: ``"truncated"``,
        the pressure profile cut off (Gumbel); ``"reynolds"``, between flats, a cavity whose edge
        has no pressure slope (Swift-Stieber), right while the cavity of an opening film grows.

    Notes
    -----
    The film ruptures in its centre, where the tension is highest, and the cavity is round. When
    liquid has filled it (reformation), the film has its strength again at once. Meniscus forces are
    those of a film without a cavity.
    """

    name: ClassVar[str] = "tension-limit"
    limit: ClassVar[LimitKind] = LimitKind.TENSION
    summary: ClassVar[str] = "the liquid cavitates at a tension and leaves a cavity"
    takes_pressure: ClassVar[bool] = True

    strength: float | Literal["vapour"] = field(default="vapour", metadata=si("Pa"))
    cavity_pressure: float | None = field(
        default=None, validator=optional(finite), metadata=si("Pa")
    )
    ambient_pressure: float = field(default=101_325.0, validator=positive, metadata=si("Pa"))
    cavity: Literal["mass-conserving", "truncated", "reynolds"] = field(
        default="mass-conserving", validator=choice("mass-conserving", "truncated", "reynolds")
    )

    @strength.validator
    def _check_strength(self, attribute: object, value: object) -> None:
        if value != "vapour":
            positive(self, attribute, value)  # type: ignore[arg-type]

    def __attrs_post_init__(self) -> None:
        pressure, where = self.cavity_pressure, "TensionLimit.cavity_pressure"
        if pressure is None:
            return
        if self.cavity != "mass-conserving":
            hint = f'cavity="{self.cavity}" has one pressure; give strength alone'
            raise DescriptionError(where, pressure, "not be given", unit="Pa", hint=hint)
        lowest, ambient = self.ambient_pressure - self.tension, self.ambient_pressure
        if not lowest - 1e-12 * (abs(lowest) + ambient) <= pressure < ambient:
            expected = f"lie between {lowest:g}, at which the liquid cavitates, and {ambient:g}"
            hint = "it is absolute; the liquid cavitates at ambient_pressure less strength"
            raise DescriptionError(where, pressure, expected, unit="Pa", hint=hint)

    @classmethod
    def curves(cls) -> tuple[Column, ...]:
        """See `SeparationEffect.curves`."""
        return (*super().curves(), *CAVITY)

    @property
    def tension(self) -> float:
        """Tension at which the full film cavitates [Pa], as a drop below ambient pressure."""
        return self.ambient_pressure if self.strength == "vapour" else float(self.strength)

    @property
    def cavity_drop(self) -> float:
        """Ambient pressure less that of the cavity [Pa]."""
        if self.cavity != "mass-conserving":
            return self.tension
        if self.cavity_pressure is not None:
            return min(self.ambient_pressure - self.cavity_pressure, self.tension)
        return min(self.ambient_pressure, self.tension)

    @property
    def pressure_in_cavity(self) -> float:
        """Pressure in a cavity [Pa], absolute; below zero a tension."""
        return self.ambient_pressure - self.cavity_drop

    @property
    def sources(self) -> tuple[str, ...]:
        """See `Effect.sources`."""
        if self.cavity == "mass-conserving":
            return ("mass-conserving cavity; Jakobsson and Floberg 1957, Olsson 1965",)
        if self.cavity == "reynolds":
            return ("Swift-Stieber condition at the cavity edge; Resch and Scheidl 2014",)
        return ("parabolic pressure truncated at the limit; Scheidl and Gradl 2016",)

    def cites(self, scene: SeparationScene) -> tuple[str, ...]:
        """See `Effect.cites`; on a face the edge of the cavity is sought cell by cell."""
        if not (self.follows_cavity and on_face(scene)):
            return self.sources
        return (
            *self.sources,
            "complementarity of pressure and void; Giacopini et al. 2010, Hintermueller, Ito and "
            "Kunisch 2002, Woloszynski, Podsiadlo and Stachowiak 2015",
        )

    @property
    def follows_cavity(self) -> bool:
        """Whether the cavity has an edge, and is remembered."""
        return self.cavity == "mass-conserving"

    def reads(self, scene: SeparationScene) -> tuple[str, ...]:
        """See `Effect.reads`: a cavity that is remembered is followed in time."""
        return ("time_rtol",) if self.follows_cavity else ()

    def lacks(self, scene: SeparationScene) -> tuple[str, ...]:
        """See `Effect.lacks`."""
        if any(face.roughness is not None for face in scene.interface.faces):
            return (
                "smooth faces: cavities form inside the roughness first, which flow factors do not "
                "know; give it as a relief",
            )
        if not scene.interface.has_discs:
            return () if self.follows_cavity else ('cavity="mass-conserving" on such a face',)
        if self.cavity == "reynolds" and not scene.interface.is_flat:
            return ('two flats (or cavity="truncated", or "mass-conserving")',)
        if on_face(scene) and scene.effect(ViscousForce) is None:
            return ("ViscousForce beside it, under a sphere",)
        if self.follows_cavity and scene.effect(ShearLimit) is not None:
            return ('no ShearLimit beside it (or cavity="truncated")',)
        return ()

    def notes(self, scene: SeparationScene) -> tuple[str, ...]:
        """See `SeparationEffect.notes`."""
        if self.cavity != "mass-conserving":
            return ()
        strength, drop = self.tension / 1e5, self.cavity_drop / 1e5
        begins = f"the liquid cavitates {strength:g} bar below ambient"
        return (f"{begins}, a cavity is {drop:g} bar below it",)

    def cavity_law(self, prepared: PreparedScene[SeparationScene]) -> Cavitation | None:
        """See `FilmLimit.cavity_law`."""
        if not self.follows_cavity:
            return None
        _refuse_rheology(prepared, self.cavity)
        if prepared.face_film is not None:
            return self._face_cavity(prepared, prepared.face_film)
        film = viscous_film(prepared)
        viscosity, rim = prepared.liquid.viscosity, film.rim * film.rim
        return CavityLaw(film.menisci, rim, film.volume, viscosity, self.tension, self.cavity_drop)

    def _face_cavity(self, prepared: PreparedScene[SeparationScene], film: FaceFilm) -> Cavitation:
        from ..face.cavity import FaceCavity

        grid = film.gridded(prepared.scene.loading.smallest_gap)
        viscosity, rtol = prepared.liquid.viscosity, prepared.accuracy.film_rtol
        return FaceCavity(film, grid, viscosity, self.tension, self.cavity_drop, rtol)

    def validity(
        self, plan: PlanView, path: Sequence[tuple[float, float]]
    ) -> tuple[ValidityNumber, ...]:
        """See `SeparationEffect.validity`: whether the rim of the liquid is resolved on a face."""
        if not on_face(plan.scene):
            return ()
        from ..face.cavity import FaceCavity
        from ..face.rim import rim_numbers

        cavity = plan.film.cavity
        return rim_numbers(cavity, path) if isinstance(cavity, FaceCavity) else ()

    def prepare(self, prepared: PreparedScene[SeparationScene]) -> Limiter:
        """See `FilmLimit.prepare`."""
        if prepared.rheology is not None and prepared.rheology.film is not None:
            if self.cavity == "reynolds":
                _refuse_rheology(prepared, self.cavity)
            return prepared.rheology.film.limiter()
        film, drop = viscous_film(prepared), self.tension
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


def _refuse_rheology(prepared: PreparedScene[SeparationScene], cavity: str) -> None:
    """Refuse a cavity whose edge is known in a Newtonian film that does not slip alone."""
    if prepared.rheology is None or prepared.rheology.film is None:
        return
    cure = "leave the slip lengths of the meniscus out"
    if prepared.rheology.computed:
        cure = 'leave the rheology out with ViscousForce(rheology="newtonian")'
    raise PlanError(
        f'TensionLimit(cavity="{cavity}") knows the edge of a cavity in a Newtonian film that does '
        f'not slip; take cavity="truncated", or {cure}'
    )


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
    limit: ClassVar[LimitKind] = LimitKind.SHEAR
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
        """See `Effect.lacks`."""
        if not isinstance(scene, SlidingScene) and not scene.interface.has_discs:
            return ("an even disc: on other faces its limit is not known",)
        if self.law != "truncated" and not isinstance(scene, SlidingScene):
            return ('law="truncated": the others are for a SlidingScene',)
        return ()

    def prepare(self, prepared: PreparedScene[SeparationScene]) -> Limiter:
        """See `FilmLimit.prepare`.

        Raises
        ------
        PlanError
            If the film has a rheology of its own, or slips.
        """
        if prepared.rheology is not None and prepared.rheology.film is not None:
            raise PlanError(
                "ShearLimit bounds the stress of a Newtonian film that does not slip; leave it out "
                "and give liquid.shear_viscosity = EyringViscosity(stress=...), or leave the "
                'rheology out with ViscousForce(rheology="newtonian")'
            )
        film, strength = viscous_film(prepared), self.strength
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


def viscous_film(prepared: PreparedScene[SeparationScene]) -> FilmShape:
    """Shape of the film as the viscous force of a scene takes it."""
    scene = prepared.scene
    viscous = scene.effect(ViscousForce)
    if viscous is not None and viscous.takes_printed():
        return published_film(prepared)
    if not keeps_radius(scene):
        return prepared.film
    pressure = prepared.liquid_pressure
    return film_shape(scene, prepared.liquid, pressure, constant_radius=True)


def _erratum(plan: PlanView) -> PublishedValue:
    from ...as_published.lookup import published

    prepared, film, loading = plan.prepared, viscous_film(plan.prepared), plan.scene.loading
    start, count, is_flat = loading.initial_gap, film.menisci, plan.scene.interface.is_flat
    # Over a time of one second, so that the number is the impulse.
    given = {
        "gap_start": start,
        "gap_end": min(loading.final_gap, plan.film.end),
        "separation_time": 1.0,
        "viscosity": prepared.liquid.viscosity,
    }
    if is_flat:
        radius = film.radius(start) * math.sqrt(count)
        number, more = ("3.34", {"number": count}) if count > 1 else ("3.19", {})
        made = published(number, radius=radius, **given, **more)
    else:
        shape = {"sphere_radius": film.sphere_radius, "film_height": film.height(start)}
        made = published("3.26", **shape, **given).times(count)
    right, by = made.value, "as printed, right for a flooded film"
    if math.isfinite(prepared.film.volume):
        law = _law_of(prepared.film, prepared.liquid.viscosity)
        right = law_impulse(law, start, given["gap_end"])
        by = "film of constant volume, upright rim"
    name = f"{ViscousForce.name}, {made.name}, times the separation time"
    return made._replace(name=name, unit="N.s", corrected=right, corrected_by=by)


def _validity(
    prepared: PreparedScene[SeparationScene], path: Sequence[tuple[float, float]]
) -> tuple[ValidityNumber, ...]:
    film, density = prepared.film, prepared.liquid.given("density")
    viscosity = apparent_viscosity(prepared)
    has_end = math.isfinite(film.height(path[0][0]))
    reynolds = slenderness = None
    if has_end:
        slenderness = min(numbers.slenderness(film.radius(h), film.height(h)) for h, _ in path)
    if has_end and density is not None:
        reynolds = max(
            numbers.reynolds_number(density, v, film.height(h), viscosity(h, v)) for h, v in path
        )
    inertia = _size(film, reynolds, numbers.inertia_fraction)
    rim = _size(film, slenderness, numbers.rim_fraction)
    return (
        ValidityNumber(
            name="Reynolds number",
            value=reynolds,
            high=1.0,
            detail="liquid.density [kg/m3] is not given"
            if density is None
            else f"inertia of the film is left out{inertia}",
            source="rho h' h/eta; 5/28 of it between flats, Kuzma 1967",
        ),
        ValidityNumber(
            name="slenderness of the film",
            value=slenderness,
            low=5.0,
            detail=f"lubrication wants a film much wider than high{rim}",
            source="Reynolds 1886; at a flooded rim 16 h/(3 pi r), Hasimoto 1958",
        ),
        *film_numbers(prepared, viscous_film(prepared), path, _strength(prepared.scene)),
        *_grid_error(prepared),
        *_rheology_numbers(prepared, path),
    )


def _rheology_numbers(
    prepared: PreparedScene[SeparationScene], path: Sequence[tuple[float, float]]
) -> tuple[ValidityNumber, ...]:
    """Ranges of the rheology of the liquid, and the heat of the film."""
    rheology, liquid = prepared.rheology, prepared.scene.meniscus.liquid
    found = rheology.numbers(prepared, path) if rheology is not None else ()
    if liquid.heat_capacity is None and liquid.thermal_conductivity is None:
        return found
    from ..rheology.heating import heating_number

    return (*found, heating_number(_heated(prepared), path))


def _heated(prepared: PreparedScene[SeparationScene]) -> HeatedFilm:
    from ..rheology.heating import HeatedFilm

    law, strength = viscous_law(prepared), _strength(prepared.scene)
    return HeatedFilm(prepared, viscous_film(prepared), law, strength)


def _grid_error(prepared: PreparedScene[SeparationScene]) -> tuple[ValidityNumber, ...]:
    """Error of a film that is solved on a grid."""
    face = prepared.face_film
    if face is None or not face.cells:
        return ()
    return (
        *face.numbers,
        ValidityNumber(
            name="error of the film on its grid",
            value=face.error,
            high=2.0 * prepared.accuracy.film_rtol,
            detail=f"relative, of the force of a full film on {face.cells} cells across; ask for a "
            "smaller Accuracy.film_rtol",
            source="change from half the cells, and of the table between its gaps",
        ),
    )


def _strength(scene: SeparationScene) -> float:
    """Tension at which the liquid of a scene cavitates [Pa]; inf if it never does."""
    limit = scene.effect(TensionLimit)
    return limit.tension if limit is not None else math.inf


def _size(film: FilmShape, number: float | None, fraction: Callable[[float], float]) -> str:
    """What a number in its range leaves out between flats, as a fraction of the force."""
    if number is None or not math.isinf(film.sphere_radius):
        return ""
    size = fraction(number) if number > 0.0 else math.inf
    return f", about {size:.2g} of the force" if size < 1.0 else ""


def _against_meniscus(
    prepared: PreparedScene[SeparationScene], path: Sequence[tuple[float, float]]
) -> tuple[ValidityNumber, ...]:
    """Whether the meniscus follows while the film is drawn in: while the gap opens."""
    film, viscosity, tension = (
        prepared.film,
        prepared.liquid.viscosity,
        prepared.liquid.surface_tension,
    )
    wetting = abs(prepared.wetting)
    ratio = fingering = 0.0
    for h, v in path:
        r, height = film.radius(h), film.height(h)
        if not (v > 0.0 and math.isfinite(r)):
            continue
        if wetting > 1e-12:
            pressures = numbers.viscous_to_capillary(viscosity, r, v, height, tension * wetting)
            ratio = max(ratio, pressures)
        fingering = max(fingering, numbers.fingering_number(viscosity, v, r, height, tension))
    return (
        ValidityNumber(
            name="viscous over capillary pressure",
            value=ratio,
            high=1.0,
            detail="above 1 the meniscus is not in equilibrium while the gap opens",
            source="3 eta r^2 h'/(gamma (c1 + c2) h^2)",
        ),
        ValidityNumber(
            name="fingering number",
            value=fingering,
            high=1.0,
            detail="above 1 the receding rim of the film breaks up into fingers",
            source="lifted Hele-Shaw cell, eta h' r^3/(gamma h^3)",
        ),
    )
