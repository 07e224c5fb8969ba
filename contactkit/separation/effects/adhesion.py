"""Van der Waals attraction across a gap; adhesive contact by JKR, DMT or Maugis-Dugdale."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, ClassVar, Literal, NamedTuple

from attrs import field, frozen

from ...adhesion import parameters as adhesion_scales
from ...adhesion.contact_models import ContactModel, contact_model
from ...adhesion.parameters import cohesive_stress
from ...errors import InfeasibleError
from ...scene.column import Column
from ...scene.loading import ImposedSpeed
from ...units import si
from ...validators import choice, optional, positive
from ...validity import ValidityNumber
from .base import ForceLaw, ForcePart, SeparationForce

if TYPE_CHECKING:
    from ...scene.interface import Interface
    from ...scene.scenes import SeparationScene
    from .base import PlanView, RunView
    from .prepared import PreparedScene

__all__ = [
    "AdhesionNumbers",
    "AdhesionPart",
    "AdhesiveContact",
    "ContactState",
    "VanDerWaalsForce",
    "cohesive_radius",
    "cohesive_stress",
    "law",
    "numbers",
    "states_at_loads",
]


@frozen(kw_only=True)
class VanDerWaalsForce(SeparationForce):
    """Attraction of the solids across the gap, by Hamaker's sum over their matter.

    Parameters
    ----------
    hamaker_constant : float
        Hamaker constant A of the two solids through what lies between them [J]; 0.4e-20 to 40e-20
        in air or vacuum, some ten times less through a liquid.
    cutoff : float
        Distance below which the force grows no further [m]: that of touching atoms. With it
        the work of adhesion is w = A/(12 pi cutoff^2), and a touching sphere pulls with 2 pi R w.
    closure : {"derjaguin", "hamaker"}
        Spheres as near bodies of a curvature, F = A R/(6 D^2); or whole, at any distance. The
        first is too much by the fraction D/R on a flat.

    Notes
    -----
    Flats attract by A/(6 pi D^3) on the smaller face, which needs a radius. Under a sphere the
    first closure ends at the rim of a bounded flat, and the second wants one wide enough. Each of
    `Meniscus.count` menisci has a sphere of its own. Rigid bodies, no retardation: right within a
    tenth below some 2 nm; at 10 nm half too much.
    """

    name: ClassVar[str] = "van-der-waals-force"
    summary: ClassVar[str] = "van der Waals attraction of the solids"
    column: ClassVar[Column] = Column(
        "van_der_waals_force", "N", "van der Waals force", "#8d6e63", "-."
    )
    needs_film: ClassVar[bool] = False
    takes_pressure: ClassVar[bool] = True

    hamaker_constant: float = field(validator=positive, metadata=si("J"))
    cutoff: float = field(default=0.165e-9, validator=positive, metadata=si("m"))
    closure: Literal["derjaguin", "hamaker"] = field(
        default="derjaguin", validator=choice("derjaguin", "hamaker")
    )

    @property
    def sources(self) -> tuple[str, ...]:
        """See `Effect.sources`."""
        if self.closure == "hamaker":
            return ("Hamaker 1937, whole spheres; cut-off after Israelachvili 1992",)
        return ("Hamaker 1937, Derjaguin 1934; cut-off after Israelachvili 1992",)

    def lacks(self, scene: SeparationScene) -> tuple[str, ...]:
        """See `Effect.lacks`."""
        if scene.interface.is_flat and math.isinf(scene.interface.rim_radius):
            return ("the radius [m] of a Flat face: two flats attract by their area",)
        return ()

    def prepare(self, prepared: PreparedScene[SeparationScene]) -> ForceLaw:
        """See `SeparationForce.prepare`."""
        from ...adhesion import van_der_waals

        interface, hamaker, cutoff = prepared.scene.interface, self.hamaker_constant, self.cutoff
        lower, upper = prepared.curvatures
        n = prepared.scene.meniscus.count
        area = math.pi * interface.rim_radius**2 if interface.is_flat else 0.0
        rim = prepared.film.rim

        def between_flats(gap: float, speed: float) -> float:
            pressure = van_der_waals.pressure_between_flats(max(gap, cutoff), hamaker)
            return float(area * pressure)

        def near_sphere(gap: float, speed: float) -> float:
            one = van_der_waals.sphere_force(max(gap, cutoff), hamaker, lower + upper, rim)
            return float(n * one)

        def whole_sphere(gap: float, speed: float) -> float:
            one = van_der_waals.hamaker_sphere_force(max(gap, cutoff), hamaker, lower, upper)
            return float(n * one)

        of_spheres = whole_sphere if self.closure == "hamaker" else near_sphere
        law = between_flats if interface.is_flat else of_spheres
        return ForceLaw(law, (cutoff,), rate="none")

    def rimless_radius(self, prepared: PreparedScene[SeparationScene], gap: float) -> float:
        """See `SeparationEffect.rimless_radius`: the circle that has 99 % of the attraction."""
        if self.closure == "derjaguin":
            return 0.0
        return 3.0 * math.sqrt(2.0 * prepared.film.sphere_radius * max(gap, self.cutoff))


@frozen(kw_only=True)
class AdhesiveContact(SeparationForce):
    """Pull of a sphere that sticks to a body it has touched, until pull-off.

    Parameters
    ----------
    model : {"maugis-dugdale", "jkr", "dmt"}
        ``"maugis-dugdale"``: attraction of constant stress in a ring around the contact, right
        for any Tabor parameter. ``"jkr"``: within the contact only, above some 5. ``"dmt"``: around
        a contact of Hertz' shape, below some 0.1.
    work_of_adhesion : float or "capillary"
        Work that parting the surfaces takes [J/m2], through what lies between them; or that of the
        liquid that condenses around the contact, gamma (cos theta_1 + cos theta_2), which stands
        for the meniscus.
    reduced_modulus : float, optional
        Contact modulus E* [Pa], 1/E* = (1 - nu_1^2)/E_1 + (1 - nu_2^2)/E_2. None: that of the
        solids of the bodies.
    equilibrium_distance : float
        Distance of atoms that touch [m]; it gives the stress of the attraction, 1.03 w/z_0.
    strength : float, optional
        Stress of the attraction [Pa]. None: by `equilibrium_distance`; with ``"capillary"`` the
        pressure of the meniscus, where that is given.

    Notes
    -----
    The gap of a scene is that of the bodies as if they were rigid, the negative of the approach;
    liquid forces are taken at that gap. The bodies have touched before the scene begins: their
    contact, pulled out to a neck, holds on at gaps up to the release gap (JKR
    0.909 (pi^2 w^2 R/K^2)^(1/3) with K = 4 E*/3; DMT the reach w/strength) and pulls off there at
    once. A scene that starts beyond has no contact, and is refused. In a motion the contact is
    there again when the gap has closed to its initial value, or to the reach of the attraction if
    that is more. Under a sphere each of `Meniscus.count` menisci has a sphere of its own.

    Left out: the rate at which polymers peel, plastic flow, roughness (which lowers the pull by
    orders of ten), and the elasticity of whatever holds the bodies.
    """

    name: ClassVar[str] = "adhesive-contact"
    summary: ClassVar[str] = "adhesion of a sphere that has touched"
    column: ClassVar[Column] = Column("adhesion_force", "N", "adhesion of the solids", "#8d6e63")
    needs_film: ClassVar[bool] = False
    takes_pressure: ClassVar[bool] = True

    model: Literal["maugis-dugdale", "jkr", "dmt"] = field(
        default="maugis-dugdale", validator=choice("maugis-dugdale", "jkr", "dmt")
    )
    work_of_adhesion: float | Literal["capillary"] = field(metadata=si("J/m2"))
    reduced_modulus: float | None = field(
        default=None, validator=optional(positive), metadata=si("Pa")
    )
    equilibrium_distance: float = field(default=0.165e-9, validator=positive, metadata=si("m"))
    strength: float | None = field(default=None, validator=optional(positive), metadata=si("Pa"))

    @work_of_adhesion.validator
    def _check_work(self, attribute: object, value: object) -> None:
        if value != "capillary":
            positive(self, attribute, value)  # type: ignore[arg-type]

    @property
    def sources(self) -> tuple[str, ...]:
        """See `Effect.sources`."""
        model = {
            "jkr": "Johnson, Kendall and Roberts 1971",
            "dmt": "Derjaguin, Muller and Toporov 1975, before touch as Maugis 1992",
            "maugis-dugdale": "Maugis 1992; bodies apart as Johnson and Greenwood 1997",
        }[self.model]
        wet = ("capillary work of adhesion, Fogden and White 1990",)
        return (model, *wet) if self.work_of_adhesion == "capillary" else (model,)

    def liquid_needs(self, scene: SeparationScene) -> tuple[str, ...]:
        """See `Effect.liquid_needs`."""
        return ("surface_tension",) if self.work_of_adhesion == "capillary" else ()

    def lacks(self, scene: SeparationScene) -> tuple[str, ...]:
        """See `Effect.lacks`."""
        missing = self._lacks_of_solids(scene.interface)
        if scene.interface.is_flat:
            missing.append("a Sphere: two flats touch all over; take VanDerWaalsForce()")
        if isinstance(scene.loading, ImposedSpeed) and scene.loading.vibration is not None:
            missing.append(
                "a loading without vibration: cycles of pull-off and re-contact are not followed"
            )
        if self.work_of_adhesion != "capillary":
            if scene.effect(VanDerWaalsForce) is not None:
                missing.append("VanDerWaalsForce() left out: the work of adhesion has it already")
            return tuple(missing)
        for other in scene.effects:
            if not isinstance(other, SeparationForce) or not other.needs_film:
                continue
            if other.newtonian is None:  # not that of a flowing liquid
                missing.append(
                    f"{type(other).__name__}() left out: the capillary work of adhesion is that "
                    "meniscus; give work_of_adhesion [J/m2] of the solids to have both"
                )
        if _wetting(scene) <= 0.0:
            missing.append("contact angles that sum up to less than 180 deg: the liquid repels")
        if self.model != "jkr" and self.strength is None and not scene.meniscus.has_pressure:
            missing.append("AdhesiveContact.strength [Pa], the suction of the liquid")
        return tuple(missing)

    @property
    def takes_solids(self) -> bool:
        """See `SeparationEffect.takes_solids`."""
        return self.reduced_modulus is None

    def _lacks_of_solids(self, interface: Interface) -> list[str]:
        if self.reduced_modulus is not None:
            return []
        if not interface.stacks:
            return ["AdhesiveContact.reduced_modulus [Pa], or the solid of a body"]
        if any(stack.layers for stack in interface.stacks):
            return ["homogeneous solids, or AdhesiveContact.reduced_modulus [Pa] for layers"]
        return []

    def _modulus(self, interface: Interface) -> float:
        """Contact modulus [Pa], given or of the solids of the bodies."""
        if self.reduced_modulus is not None:
            return self.reduced_modulus
        return 1.0 / sum(1.0 / s.materials[0].plane_strain_modulus for s in interface.stacks)

    def numbers(self, prepared: PreparedScene[SeparationScene]) -> AdhesionNumbers:
        """Return the numbers of the contact of one sphere of a scene, without running it."""
        work = self._work(prepared)
        interface, strength = prepared.scene.interface, self._strength(prepared, work)
        modulus = self._modulus(interface)
        return numbers(self.model, interface.sphere_radius, work, modulus, strength)

    def prepare(self, prepared: PreparedScene[SeparationScene]) -> ForceLaw:
        """See `SeparationForce.prepare`."""
        found, start = self.numbers(prepared), prepared.scene.loading.initial_gap
        if start >= found.release_gap:
            raise InfeasibleError(
                f"AdhesiveContact ({self.model}) pulls off at a gap of {found.release_gap:.4g} m, "
                f"and loading.initial_gap is {start:g} m: bodies that do not touch do not adhere; "
                f"start closer, or take VanDerWaalsForce(), which acts across a gap"
            )
        return law(found, prepared.scene.meniscus.count, start)

    def rimless_radius(self, prepared: PreparedScene[SeparationScene], gap: float) -> float:
        """See `SeparationEffect.rimless_radius`: as far as the solids attract each other."""
        return cohesive_radius(self.numbers(prepared), gap)

    def validity(
        self, plan: PlanView, path: Sequence[tuple[float, float]]
    ) -> tuple[ValidityNumber, ...]:
        """See `SeparationEffect.validity`: the attraction is as sharp, or as far, as assumed."""
        if self.model == "maugis-dugdale":  # right for all
            return ()
        tabor = self.numbers(plan.prepared).tabor_parameter
        is_sharp = self.model == "jkr"
        cure = "take model='maugis-dugdale', right for all"
        number = ValidityNumber(
            name="Tabor parameter",
            value=tabor,
            low=5.0 if is_sharp else 0.0,
            high=math.inf if is_sharp else 0.1,
            detail=cure if tabor is not None else "AdhesiveContact.strength [Pa] is not given",
            source="Johnson and Greenwood 1997",
        )
        return (number,)

    def part(self, result: RunView) -> AdhesionPart:
        """See `SeparationEffect.part`."""
        return AdhesionPart(result, self.column, self.numbers(result.plan.prepared))

    def scalars(self, result: RunView) -> dict[str, tuple[float, str]]:
        """See `SeparationEffect.scalars`."""
        one = self.numbers(result.plan.prepared)
        found = {
            "pull_off_force": (one.pull_off_force, "N"),
            "contact_release_gap": (one.release_gap, "m"),
        }
        if one.tabor_parameter is not None and one.transition_parameter is not None:
            found["tabor_parameter"] = (one.tabor_parameter, "-")
            found["transition_parameter"] = (one.transition_parameter, "-")
        return found

    def _work(self, prepared: PreparedScene[SeparationScene]) -> float:
        """Work of adhesion [J/m2]; the liquid does its own where it comes between two surfaces."""
        if self.work_of_adhesion == "capillary":
            return prepared.liquid.surface_tension * prepared.wetting
        return float(self.work_of_adhesion)

    def _strength(self, prepared: PreparedScene[SeparationScene], work: float) -> float | None:
        """Stress of the attraction [Pa]; None if the liquid's suction is not known."""
        if self.strength is not None:
            return self.strength
        if self.work_of_adhesion != "capillary":
            return float(cohesive_stress(work, self.equilibrium_distance))
        pressure = prepared.liquid_pressure
        return None if pressure is None else -pressure


def _wetting(scene: SeparationScene) -> float:
    meniscus = scene.meniscus
    return math.cos(meniscus.contact_angle_lower) + math.cos(meniscus.contact_angle_upper)


_NOTHING = 1e-8  # fraction of the pull-off force: a jump that no result shows


class AdhesionNumbers(NamedTuple):
    """Numbers of the adhesive contact of one sphere.

    `transition_parameter` is that of Maugis [-] and `tabor_parameter` that of Tabor [-], both
    None where no stress of attraction is known. `pull_off_force` is the largest pull [N], that of
    pull-off under load control; `release_gap` [m] and `release_force` [N] are those of pull-off
    under displacement control.
    """

    model: str
    radius: float
    work_of_adhesion: float
    reduced_modulus: float
    strength: float | None
    transition_parameter: float | None
    tabor_parameter: float | None
    pull_off_force: float
    release_gap: float
    release_force: float

    @property
    def contact(self) -> ContactModel:
        """The contact in dimensionless form."""
        return contact_model(self.model, self.transition_parameter)

    @property
    def units(self) -> adhesion_scales.AdhesionScales:
        """Units of the dimensionless kernels."""
        return adhesion_scales.scales(self.radius, self.work_of_adhesion, self.reduced_modulus)


@frozen(eq=False)
class AdhesionPart(ForcePart):
    """Force and impulse of the adhesion of the solids, and the numbers of one contact."""

    numbers: AdhesionNumbers


class ContactState(NamedTuple):
    """A contact at rest: load [N], approach, contact radius and radius of the attraction [m].

    The last is the contact radius where the model gives the attraction no edge of its own.
    """

    load: float
    approach: float
    contact_radius: float
    cohesive_radius: float


def numbers(
    model: str, radius: float, work: float, modulus: float, strength: float | None
) -> AdhesionNumbers:
    """Numbers of a contact of a relative radius [m], work [J/m2], modulus and strength [Pa]."""
    units = adhesion_scales.scales(radius, work, modulus)
    transition = tabor = None
    if strength is not None:
        transition = float(adhesion_scales.transition_parameter(radius, work, modulus, strength))
        tabor = transition / adhesion_scales.TRANSITION_OVER_TABOR
    contact = contact_model(model, transition)
    return AdhesionNumbers(
        model,
        radius,
        work,
        modulus,
        strength,
        transition,
        tabor,
        contact.pull_off_force * units.load,
        contact.last_gap * units.approach,
        contact.last_force * units.load,
    )


def law(found: AdhesionNumbers, count: int, start: float) -> ForceLaw:
    """Pull of `count` equal contacts that hold on from a gap `start` [m] on."""
    contact, units, end = found.contact, found.units, found.release_gap
    scale, length = count * float(units.load), float(units.approach)

    def force(gap: float, speed: float) -> float:
        return scale * contact.pull(gap / length)

    touch = contact.touch_gap * length
    kinks = (touch,) if touch < end else ()
    if found.release_force < _NOTHING * found.pull_off_force:  # ends without a jump, as with DMT
        return ForceLaw(
            lambda gap, v: force(gap, v) if gap < end else 0.0, (*kinks, end), rate="none"
        )
    again = max(start, contact.reach * length)
    return ForceLaw(force, kinks, release=end, recontact=again, rate="none")


def cohesive_radius(found: AdhesionNumbers, gap: float) -> float:
    """Radius [m] within which the bodies of one contact attract each other at a gap [m]."""
    units = found.units
    return float(units.radius * found.contact.cohesive_radius(gap / units.approach))


def states_at_loads(found: AdhesionNumbers, loads: Sequence[float]) -> list[ContactState]:
    """States of one contact that rests under loads [N] of at least minus the pull-off force."""
    contact, units = found.contact, found.units
    states = []
    for load in loads:
        a, c, _, approach = contact.at_load(load / units.load)
        state = load, approach * units.approach, a * units.radius, c * units.radius
        states.append(ContactState(*state))
    return states
