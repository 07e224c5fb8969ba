"""Scenes of deforming bodies: on rings or on a map, and what neither can have, refused by name."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

from ...errors import PlanError
from ...scene.faces import SealedHole
from ...scene.loading import ImposedForce, ImposedSpeed, PressAndPull
from ..effects.base import effects_of
from ..effects.meniscus import MeniscusForce
from ..effects.viscous import TensionLimit, ViscousForce
from .effects import ElasticBodies, SolidContact

if TYPE_CHECKING:
    from ...liquids.liquid import LiquidState
    from ...scene.scenes import SeparationScene

__all__ = ["check_deforming", "is_on_rings"]

_KNOWN = (ElasticBodies, SolidContact, ViscousForce, MeniscusForce, TensionLimit)
# Cut-off over the initial gap: beyond, the film before the contact is that of the asperities.
_CUTOFF_OVER_GAP = 0.5


def check_deforming(scene: SeparationScene, liquid: LiquidState) -> None:
    """Refuse what the film of deforming bodies would leave out.

    Raises
    ------
    PlanError
        Naming each field and effect, with the cure.
    """
    problems = [
        *_of_bodies(scene),
        *_of_effects(scene),
        *_of_liquid(scene, liquid),
        *_of_loading(scene),
    ]
    if problems:
        raise PlanError("ElasticBodies cannot act here: " + "; ".join(problems))


def is_on_rings(scene: SeparationScene) -> bool:
    """Whether both bodies are smooth and round, so that their film is axisymmetric."""
    interface = scene.interface
    is_round = all(body.surface.curvature is not None for body in interface.bodies)
    return is_round and interface.has_discs


def _of_bodies(scene: SeparationScene) -> Iterator[str]:
    interface = scene.interface
    if not interface.stacks:
        yield (
            "both bodies are rigid; give interface.lower.solid or interface.upper.solid, or leave "
            "ElasticBodies out"
        )
    if not is_on_rings(scene):
        yield from _of_maps(scene)
        return
    if interface.curvature < 0.0:
        yield "the bodies are hollow against each other; give 1/R of both of a positive sum"
    if interface.curvature == 0.0 and math.isinf(interface.rim_radius):
        yield "two flats without end; give a radius [m] to one of them"


def _of_maps(scene: SeparationScene) -> Iterator[str]:
    interface, meniscus = scene.interface, scene.interface.meniscus
    if any(isinstance(hole, SealedHole) for face in interface.faces for hole in face.holes):
        yield (
            "a SealedHole in a face that deforms is not known; give a Vent, or leave ElasticBodies "
            "out"
        )
    if any(face.roughness is not None for face in interface.faces):
        yield (
            "Flat.roughness acts by flow factors, which films between deforming bodies do not "
            "have; leave it out, or give heights: Flat(relief=...), CombinedSurface"
        )
    if meniscus is None or not (meniscus.has_pressure or meniscus.volume is not None):
        return
    for name in ("lower", "upper"):
        surface = getattr(interface, name).surface
        if surface.curvature is None or not getattr(surface, "is_disc", True):
            yield (
                f"interface.{name}.surface is a {type(surface).__name__} with heights or an "
                "outline, and menisci of a given amount between deforming bodies are solved on "
                "rings; give a Flat, a Sphere or a Paraboloid, or flood the film"
            )


def _of_effects(scene: SeparationScene) -> Iterator[str]:
    for effect in effects_of(scene):
        name = type(effect).__name__
        if not isinstance(effect, _KNOWN):
            known = ", ".join(kind.__name__ for kind in _KNOWN)
            yield f"{name} has no place in a film of deforming bodies yet; it knows {known}"
        if effect.takes_printed():
            yield f"{name} takes printed equations, which are those of rigid bodies"
    viscous, limit = scene.effect(ViscousForce), scene.effect(TensionLimit)
    if viscous is None:
        yield "ViscousForce() is missing: it is the film"
    elif viscous.closure != "volume-conserving":
        yield f'ViscousForce(closure="{viscous.closure}") keeps a radius that no rim has'
    if limit is not None and limit.cavity != "mass-conserving":
        yield f'TensionLimit(cavity="{limit.cavity}") is a law of rigid bodies; leave cavity out'
    contact, gap = scene.effect(SolidContact), scene.loading.initial_gap
    if contact is not None and contact.cutoff > _CUTOFF_OVER_GAP * gap:
        yield (
            f"SolidContact.cutoff is {contact.cutoff:g} m of loading.initial_gap = {gap:g} m; "
            "start from twice the cut-off at least"
        )


def _of_liquid(scene: SeparationScene, liquid: LiquidState) -> Iterator[str]:
    interface = scene.interface
    if interface.meniscus is None:
        yield "interface.meniscus is missing: the liquid and its amount"
        return
    meniscus, viscous = interface.meniscus, scene.effect(ViscousForce)
    if meniscus.slips:
        yield (
            "interface.meniscus.slip_length_lower and slip_length_upper [m] are not known between "
            "deforming bodies; leave them out"
        )
    rheology = viscous.rheology if viscous is not None else "newtonian"
    if rheology == "all" or not (rheology == "newtonian" or meniscus.liquid.is_newtonian):
        yield (
            "its film takes the viscosity at rest and ambient pressure, and the liquid has one "
            'over pressure or shear; leave that out with ViscousForce(rheology="newtonian")'
        )
    for effect in effects_of(scene):
        for item in liquid.missing(*effect.liquid_needs(scene)):
            yield f"{type(effect).__name__} needs {item}"
    has_amount = meniscus.has_pressure or meniscus.volume is not None
    has_force = scene.effect(MeniscusForce) is not None
    if has_amount and not has_force:
        yield "MeniscusForce() is missing: the rim of a given amount of liquid has its pressure"
    if has_force and not has_amount:
        yield (
            "MeniscusForce needs interface.meniscus.volume [m3] or relative_humidity [-]: the film "
            "is flooded"
        )
    if not has_amount:
        return
    if meniscus.count > 1:
        yield "interface.meniscus.count exceeds 1: the bodies deform under one meniscus"
    if interface.is_flat and is_on_rings(scene):
        yield "a meniscus between two flats that deform is not known; give a sphere, or flood it"
    if any(stack.layers for stack in interface.stacks):
        yield (
            "a rim that moves needs half-spaces: the displacement of layers does not scale with "
            "it; give solids of one material, or a flooded film"
        )
    if scene.effect(TensionLimit) is not None:
        yield "TensionLimit with a rim that moves is not known; leave it out, or flood the film"
    angles = meniscus.contact_angle_lower, meniscus.contact_angle_upper
    if sum(map(math.cos, angles)) <= 0.0:
        yield "the liquid repels: contact angles must add up to less than 180 deg"


def _of_loading(scene: SeparationScene) -> Iterator[str]:
    loading = scene.loading
    if loading.initial_gap <= 0.0:
        yield "loading.initial_gap is 0 m: give the gap at which the film is at rest [m]"
    if isinstance(loading, ImposedSpeed):
        if loading.vibration is not None:
            yield "loading.vibration: take modulus_curve for small vibrations, or leave it out"
    elif isinstance(loading, ImposedForce):
        if loading.rest_gap > 0.0:
            yield "loading.rest_gap holds rigid bodies: list SolidContact(cutoff=...) in its place"
        if loading.initial_speed != 0.0:
            yield "loading.initial_speed is that of a film at rest: leave it out"
        if loading.force <= 0.0:
            yield "loading.force never opens the gap: to press first, take PressAndPull"
    elif not isinstance(loading, PressAndPull):
        yield f"loading is a {type(loading).__name__}; impose a speed or a force, or PressAndPull"
