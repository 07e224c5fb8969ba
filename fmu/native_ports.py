"""The variables of a native ``stiction-mass``: those of the Python FMU that a table leaves free.

Names, units and meanings are those of `stiction_mass.PORTS`. Faces, volume, angles and number of
menisci are in the tables, so they are no variables here.
"""

from __future__ import annotations

import math
from collections.abc import Mapping

from attrs import evolve

from ..effects import AdhesiveContact, Rupture, ShearLimit, TensionLimit
from ..effects.viscous import keeps_radius
from ..errors import DescriptionError
from ..scene import SeparationScene
from .native_data import IDENTIFIERS
from .native_film import free_liquid
from .ports import Port, Value, find_port
from .stiction_mass import PORTS

__all__ = ["native_ports", "start_of"]

_LABELS = {
    "F_m": "force of the meniscus and the solids, positive resists opening",
    "J_m": "impulse of the meniscus and the solids since the start",
    "h_break": "gap at which the film breaks; 0: where that of the scene does",
}


def native_ports(scene: SeparationScene, lowest: float) -> tuple[Port, ...]:
    """Variables of the FMU of a scene whose tables begin at a gap [m]."""
    names = [name for name in IDENTIFIERS if name not in _absent(scene)]
    start = start_of(scene)
    ports = []
    for name in names:
        port = find_port(PORTS, name)
        depends = port.depends_on
        if depends is not None:
            depends = tuple(n for n in depends if n in names)
        port = evolve(
            port, depends_on=depends, label=_LABELS.get(name, port.label),
            start=start.get(name, port.start),
        )  # fmt: skip
        if name == "h0":
            held = _start_is_held(scene)
            port = evolve(
                port, exclusive=False, minimum=port.start if held else lowest,
                maximum=port.start if held else None,
            )  # fmt: skip
        ports.append(port)
    return tuple(ports)


def _absent(scene: SeparationScene) -> set[str]:
    """Parameters that mean nothing for a scene, or that its tables have fixed."""
    viscosity, surface_tension = free_liquid(scene)
    absent = set()
    if not viscosity:
        absent |= {"eta", "dp_cav", "tau_lim"}
    if not surface_tension:
        absent.add("gamma")
    return absent


def _start_is_held(scene: SeparationScene) -> bool:
    """Whether the tables belong to one gap at the start."""
    adheres = scene.effect(AdhesiveContact) is not None
    return adheres or (keeps_radius(scene) and scene.interface.meniscus.volume is not None)


def start_of(scene: SeparationScene) -> dict[str, Value]:
    """Start values that a scene gives the variables."""
    opening = scene.opening
    viscosity, surface_tension = free_liquid(scene)
    tension, shear = scene.effect(TensionLimit), scene.effect(ShearLimit)
    rupture = scene.effect(Rupture)
    if opening.mass is None:
        raise DescriptionError("m", None, "be given", unit="kg")
    return {
        "m": opening.mass,
        "h0": opening.initial_gap,
        "v0": opening.initial_speed,
        "k_s": opening.stiffness,
        "h_rel": opening.final_gap,
        "h_min": opening.rest_gap,
        "h_break": (rupture.gap or 0.0) if rupture is not None else 0.0,
        "eta": viscosity,
        "gamma": surface_tension,
        "dp_cav": tension.pressure_drop if tension is not None else 0.0,
        "tau_lim": shear.strength if shear is not None else 0.0,
    }


def check_start(ports: tuple[Port, ...], values: Mapping[str, Value]) -> None:
    """Refuse start values that contradict each other, as the kernel would.

    Raises
    ------
    DescriptionError
        Naming the two.
    """
    gap = values["h0"]
    if values["h_rel"] <= gap:
        raise DescriptionError("h_rel", values["h_rel"], f"exceed h0 = {gap:g} m", unit="m")
    if values["h_min"] > gap:
        raise DescriptionError("h_min", values["h_min"], f"not exceed h0 = {gap:g} m", unit="m")
    if 0.0 < values["h_break"] <= gap or math.isinf(values["h_break"]):
        raise DescriptionError(
            "h_break", values["h_break"], f"be 0 or exceed h0 = {gap:g} m", unit="m"
        )
