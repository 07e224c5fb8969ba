"""Attraction of the solids: across a gap, and of a sphere that has touched (JKR, DMT, between)."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, ClassVar, Literal

from attrs import field, frozen

from ...errors import InfeasibleError
from ...units import si
from ...validators import choice, optional, positive
from .base import ForceLaw, SeparationForce
from .viscous import ViscousForce

if TYPE_CHECKING:
    from ...accuracy import Accuracy
    from ...scene.scenes import SeparationScene
    from .zz_adhesion_laws import AdhesionNumbers

__all__ = ["AdhesiveContact", "VanDerWaalsForce"]


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
        first is too much by the share D/R on a flat.

    Notes
    -----
    Flats attract by A/(6 pi D^3) on the smaller face, which needs a radius. Under a sphere each of
    `Meniscus.count` menisci has a sphere of its own. Rigid bodies, no retardation: right within a
    tenth below some 2 nm; at 10 nm half too much.
    """

    name: ClassVar[str] = "van-der-waals-force"
    summary: ClassVar[str] = "van der Waals attraction of the solids"
    column: ClassVar[str] = "van_der_waals_force"
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
        """See `SeparationEffect.lacks`."""
        if scene.interface.is_flat and math.isinf(scene.interface.rim_radius):
            return ("the radius [m] of a Flat face: two flats attract by their area",)
        return ()

    def prepare(self, scene: SeparationScene, accuracy: Accuracy) -> ForceLaw:
        """See `SeparationForce.prepare`."""
        from ...adhesion import van_der_waals

        interface, hamaker, cutoff = scene.interface, self.hamaker_constant, self.cutoff
        lower, upper = interface.lower.curvature, interface.upper.curvature
        n = interface.meniscus.count
        area = math.pi * interface.rim_radius**2 if interface.is_flat else 0.0

        def between_flats(gap: float, speed: float) -> float:
            pressure = van_der_waals.pressure_between_flats(max(gap, cutoff), hamaker)
            return float(area * pressure)

        def near_sphere(gap: float, speed: float) -> float:
            one = van_der_waals.sphere_force(max(gap, cutoff), hamaker, lower + upper)
            return float(n * one)

        def whole_sphere(gap: float, speed: float) -> float:
            one = van_der_waals.hamaker_sphere_force(max(gap, cutoff), hamaker, lower, upper)
            return float(n * one)

        of_spheres = whole_sphere if self.closure == "hamaker" else near_sphere
        return ForceLaw(between_flats if interface.is_flat else of_spheres, (cutoff,))


@frozen(kw_only=True)
class AdhesiveContact(SeparationForce):
    """Pull of a sphere that has touched a body and sticks to it, from touch until it lets go.

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
    reduced_modulus : float
        Contact modulus E* [Pa], 1/E* = (1 - nu_1^2)/E_1 + (1 - nu_2^2)/E_2.
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
    0.909 (pi^2 w^2 R/K^2)^(1/3) with K = 4 E*/3; DMT the reach w/strength) and lets go there at
    once. A scene that starts beyond has no contact, and is refused. In a motion the contact is
    there again when the gap has closed to its initial value, or to the reach of the attraction if
    that is more. Under a sphere each of `Meniscus.count` menisci has a sphere of its own.

    Left out: the rate at which polymers peel, plastic flow, roughness (which lowers the pull by
    orders of ten), and the elasticity of whatever holds the bodies.
    """

    name: ClassVar[str] = "adhesive-contact"
    summary: ClassVar[str] = "adhesion of a sphere that has touched"
    column: ClassVar[str] = "adhesion_force"
    needs_film: ClassVar[bool] = False
    takes_pressure: ClassVar[bool] = True

    model: Literal["maugis-dugdale", "jkr", "dmt"] = field(
        default="maugis-dugdale", validator=choice("maugis-dugdale", "jkr", "dmt")
    )
    work_of_adhesion: float | Literal["capillary"] = field(metadata=si("J/m2"))
    reduced_modulus: float = field(validator=positive, metadata=si("Pa"))
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

    def lacks(self, scene: SeparationScene) -> tuple[str, ...]:
        """See `SeparationEffect.lacks`."""
        missing: list[str] = []
        if scene.interface.is_flat:
            missing.append("a Sphere: two flats touch all over; take VanDerWaalsForce()")
        if scene.opening.vibration is not None:
            missing.append(
                "an opening without vibration: a cycle that lets go and catches is not followed"
            )
        if self.work_of_adhesion != "capillary":
            if scene.effect(VanDerWaalsForce) is not None:
                missing.append("VanDerWaalsForce() left out: the work of adhesion has it already")
            return tuple(missing)
        for other in scene.effects:
            if not isinstance(other, SeparationForce) or not other.needs_film:
                continue
            if other.column != ViscousForce.column:
                missing.append(
                    f"{type(other).__name__}() left out: the capillary work of adhesion is that "
                    "meniscus; give work_of_adhesion [J/m2] of the solids to have both"
                )
        meniscus = scene.interface.meniscus
        if meniscus.liquid.at(scene.temperature).surface_tension is None:
            missing.append("liquid.surface_tension [N/m]")
        elif _capillary_work(scene) <= 0.0:
            missing.append("contact angles that sum up to less than 180 deg: the liquid repels")
        if self.model != "jkr" and self._strength(scene, 0.0) is None:
            missing.append("AdhesiveContact.strength [Pa], the suction of the liquid")
        return tuple(missing)

    def numbers(self, scene: SeparationScene) -> AdhesionNumbers:
        """Return what the contact of one sphere of a scene comes to, without running it."""
        from .zz_adhesion_laws import numbers

        work = self._work(scene)
        strength = self._strength(scene, work)
        radius = scene.interface.sphere_radius
        return numbers(self.model, radius, work, self.reduced_modulus, strength)

    def prepare(self, scene: SeparationScene, accuracy: Accuracy) -> ForceLaw:
        """See `SeparationForce.prepare`."""
        from .zz_adhesion_laws import law

        found, start = self.numbers(scene), scene.opening.initial_gap
        if start >= found.release_gap:
            raise InfeasibleError(
                f"AdhesiveContact ({self.model}) lets go at a gap of {found.release_gap:.4g} m, "
                f"and Opening.initial_gap is {start:g} m: bodies that do not touch do not adhere; "
                f"start closer, or take VanDerWaalsForce(), which acts across a gap"
            )
        return law(found, scene.interface.meniscus.count, start)

    def _work(self, scene: SeparationScene) -> float:
        if self.work_of_adhesion == "capillary":
            return _capillary_work(scene)
        return float(self.work_of_adhesion)

    def _strength(self, scene: SeparationScene, work: float) -> float | None:
        """Stress of the attraction [Pa]; None if the liquid's suction is not known."""
        if self.strength is not None:
            return self.strength
        if self.work_of_adhesion != "capillary":
            from .zz_adhesion_laws import cohesive_stress

            return float(cohesive_stress(work, self.equilibrium_distance))
        pressure = scene.interface.meniscus.pressure
        return None if pressure is None else -pressure


def _capillary_work(scene: SeparationScene) -> float:
    """Work [J/m2] that the liquid does where it comes between two surfaces."""
    meniscus = scene.interface.meniscus
    tension = meniscus.liquid.at(scene.temperature).surface_tension
    assert tension is not None  # lacks() has asked first
    wetting = math.cos(meniscus.contact_angle_lower) + math.cos(meniscus.contact_angle_upper)
    return tension * wetting
