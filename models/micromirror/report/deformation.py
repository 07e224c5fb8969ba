"""Whether tips and sites of the micromirror deform: by the meniscus at rest, and at lift-off.

Closed forms of half-spaces (`contactkit.capillary.elastic_bridge`): no contact, uniform suction.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Any, NamedTuple

from ....capillary import elastic_bridge
from ....errors import InfeasibleError
from ....scene.materials import Material
from ....scene.meniscus import Meniscus
from ....separation.deforming.numbers import deciding_numbers
from ..scene import MicromirrorScene
from ..tip_film import adhesion

__all__ = ["TipDeformation", "deformation_numbers", "tip_deformation"]

# Assumption: the scene names no material of the tips. Aluminium film, as in tip_landing.toml.
_ALUMINIUM = Material(name="aluminium film", young_modulus=70e9, poisson_ratio=0.33)
_MODULUS = 0.5 * _ALUMINIUM.plane_strain_modulus
_MATTERS = 0.05  # of the force; radius and gap of the tip change it by more


class TipDeformation(NamedTuple):
    """A meniscus of the pressure of the vapour under a landed tip that deforms.

    number: gc a/(E* h^2) with the gap h at the rim; change: of the force of the meniscus, against
    rigid bodies; adhesion: of the whole force of the tip, solids included; closes: by how much of
    the gap the meniscus draws the apex in.
    """

    humidity: float
    number: float
    change: float
    adhesion: float
    closes: float


def tip_deformation(scene: MicromirrorScene, humidity: float) -> TipDeformation | None:
    """Deformation under a landed tip at a humidity; None where it is dry."""
    tip = scene.tip
    state = tip.meniscus.liquid.at(tip.temperature)
    gap, radius = scene.loading.initial_gap, tip.interface.sphere_radius
    angles = tip.meniscus.contact_angle_lower, tip.meniscus.contact_angle_upper
    wetting = state.surface_tension * sum(map(math.cos, angles))
    suction = _suction(scene, humidity)
    if suction <= 0.0 or wetting <= 0.0 or wetting / suction <= gap:
        return None
    pair = gap, suction, radius
    rigid = elastic_bridge.bridge_at_pressure(*pair, math.inf, wetting)
    soft = elastic_bridge.bridge_at_pressure(*pair, _MODULUS, wetting)
    if rigid is None or soft is None:
        return None
    height, change = wetting / suction, soft.force / rigid.force - 1.0
    held = adhesion(tip, humidity)
    return TipDeformation(
        humidity,
        wetting * soft.rim_radius / (_MODULUS * height**2),
        change,
        change * held.meniscus_force / held.force,
        1.0 - soft.centre_gap / gap,
    )


def _suction(scene: MicromirrorScene, humidity: float) -> float:
    if humidity == 0.0:
        return 0.0
    tip = scene.tip
    moist = Meniscus(liquid=tip.meniscus.liquid, relative_humidity=humidity)
    try:
        return -float(moist.pressure_at(tip.temperature) or 0.0)
    except InfeasibleError:
        return 0.0


def deformation_numbers(
    scene: MicromirrorScene, states: Iterable[tuple[float, float]]
) -> tuple[list[str], dict[str, tuple[Any, str]]]:
    """Lines and scalars of the report; states are gaps [m] and speeds [m/s] of held tips."""
    tip = scene.tip
    found = [tip_deformation(scene, humidity) for humidity in scene.study.humidities]
    wet = [one for one in found if one is not None]
    lines, numbers = list[str](), dict[str, tuple[Any, str]]()
    if wet:
        worst = max(wet, key=lambda one: one.adhesion)
        verdict = "matters" if worst.adhesion > _MATTERS else "hardly matters"
        lines.append(
            f"deformation of tips and sites at rest {verdict}: gc a/(E* h^2) is at most "
            f"{max(one.number for one in wet):.2g} (snaps in at 0.4); the tips hold by up to "
            f"{worst.adhesion:+.1%} of their force ({100 * worst.humidity:g} %), where the apex is "
            f"drawn in by {worst.closes:.0%} of its gap; assumed: aluminium of 70 GPa, and that "
            "the layers in the gap do not touch"
        )
        numbers |= {
            "tip_deformation_number": (max(one.number for one in wet), "-"),
            "adhesion_change_by_deformation": (worst.adhesion, "-"),
        }
    viscosity = tip.meniscus.liquid.at(tip.temperature).given("viscosity")
    betas = [
        _beta(tip.interface.sphere_radius, gap, speed, viscosity)
        for gap, speed in states
        if viscosity is not None and speed > 0.0
    ]
    if betas:
        most = max(betas)
        verdict = "matters" if most > 0.1 else "corrects the film by per cents"
        lines.append(
            f"deformation at lift-off: the film displaces the tips by at most {most:.1e} of the "
            f"gap, which {verdict if most > 1e-3 else 'does not matter'}"
        )
        numbers["film_deformation_over_gap"] = (most, "-")
    return lines, numbers


def _beta(radius: float, gap: float, speed: float, viscosity: float) -> float:
    width = math.sqrt(radius * gap)
    return deciding_numbers(radius, width, gap, viscosity, speed, _MODULUS).beta
