"""Stiction of a landing bump over time of rest and humidity, and why the rough disk has none.

A drive parks its slider on smooth bumps that a laser melts into the disk (a landing zone), for
stiction. One of them under the flat slider is a sphere on a flat that deform, with water between:
the engine of smooth bodies has it. The rough disk itself it has not: `unanswered` says why.

Assumptions, by what they change: radius of the bump (the force is in proportion to it), cut-off of
the asperities (the force falls with its ratio to the height of the meniscus), the volume of water
(that of the vapour at `initial_gap`, kept: no liquid condenses or creeps in while it rests), load
of a bump, nickel-phosphorus below as a half-space.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from attrs import evolve

from ...accuracy import Accuracy
from ...analyses.deforming.stiction import StictionTable, stiction_table
from ...errors import PlanError
from ...scene.interface import Body
from ...scene.loading import PressAndPull
from ...scene.materials import Stack
from ...scene.meniscus import Meniscus
from ...scene.scenes import ContactScene, SeparationScene
from ...scene.surfaces import Flat, Sphere
from ...separation.deforming.effects import ElasticBodies, SolidContact
from ...separation.deforming.plan import plan_deforming
from ...separation.effects.meniscus import MeniscusForce
from ...separation.effects.viscous import ViscousForce
from ...units import nm, um

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

__all__ = ["bump_stiction", "landing_bump", "unanswered"]

_RADIUS = 10.0 * um  # assumption: crater rims of laser texture, 10 to 20 um
_LOAD = 2e-5  # [N], assumption: 20 mN of a slider on a thousand bumps
_CUTOFF = 1.0 * nm  # assumption: summits of a melted, smooth bump
_GAP = 4.0 * nm  # assumption: where water of 90 % humidity first spans the gap (5 nm high)
_APART = 20.0 * nm  # ours: beyond the neck of the meniscus
_SPEED = 1e-3  # [m/s], assumption: of the suspension at take-off; film forces stay below 1 %
_HUMIDITY, _REST = 0.9, 1e-6  # of the scene before `stiction_table` replaces them


def landing_bump(disk: ContactScene) -> SeparationScene:
    """Bump on the disk of a scene, under its slider, pressed and pulled off.

    Parameters
    ----------
    disk : ContactScene
        Head-disk interface: its slider, the thickest layer of its disk, liquid and angles.
    """
    below, slider = disk.interface.lower.stack, disk.interface.upper.stack
    water = disk.interface.meniscus
    if below is None or slider is None or water is None:
        raise PlanError("landing_bump needs two solids and interface.meniscus: the liquid")
    layers = below.layers
    solid = max(layers, key=lambda one: one.thickness).material if layers else below.materials[-1]
    meniscus = Meniscus(
        liquid=water.liquid,
        relative_humidity=_HUMIDITY,
        contact_angle_lower=water.contact_angle_lower,
        contact_angle_upper=water.contact_angle_upper,
    )
    return SeparationScene(
        name="landing bump",
        temperature=disk.temperature,
        interface=evolve(
            disk.interface,
            lower=Body(surface=Sphere(radius=_RADIUS), solid=solid),
            upper=Body(surface=Flat(), solid=Stack(substrate=slider.materials[-1])),
            meniscus=meniscus,
        ),
        loading=PressAndPull(
            press=_LOAD, rest=_REST, speed=_SPEED, initial_gap=_GAP, final_gap=_APART
        ),
        effects=(ElasticBodies(), SolidContact(cutoff=_CUTOFF), ViscousForce(), MeniscusForce()),
    )


def bump_stiction(
    disk: ContactScene,
    rests: Sequence[float] | NDArray[np.float64],
    humidities: Sequence[float] | NDArray[np.float64],
    accuracy: Accuracy | None = None,
) -> StictionTable:
    """Pull-off force of one landing bump over times of rest [s] and humidities [-].

    Between 85 % of humidity, below which no water spans the gap at the start, and 97 %.
    """
    return stiction_table(landing_bump(disk), rests, humidities, accuracy)


def unanswered(disk: ContactScene) -> str:
    """Refusal of the engine to have stiction of the rough disk itself, in words."""
    bump = landing_bump(disk)
    rough = evolve(
        bump,
        interface=evolve(disk.interface, meniscus=bump.interface.meniscus),
    )
    try:
        plan_deforming(rough)
    except PlanError as error:
        return str(error)
    return ""
