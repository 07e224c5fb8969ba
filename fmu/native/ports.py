"""The variables of a native FMU: those of the Python FMU of that name that a table leaves free.

Names, units and meanings are those of its ``PORTS``. Faces, volume, angles and number of
menisci are in the tables, so they are no variables here.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from typing import Literal

from attrs import evolve

from ...errors import DescriptionError
from ...scene.scenes import SeparationScene
from ...separation.effects.adhesion import AdhesiveContact
from ...separation.effects.prepared import PreparedScene
from ...separation.effects.viscous import TensionLimit, ViscousForce, keeps_radius
from ...separation.face.shape import on_face
from ..framework.places import read
from ..framework.ports import NATIVE_STEPS, STEP_LIMIT, Port, Value
from ..slaves.rheology import is_rheological
from ..slaves.stiction_mass import PLACES
from ..slaves.tension import TENSIONS, tension_values
from .film import can_cavitate, free_liquid
from .models import TEMPERATURE, native_model
from .records import LiquidTable

__all__ = ["Model", "check_free", "native_ports", "start_of", "with_temperature"]

Model = Literal["stiction-mass", "stiction-force"]
"""Models of the film of any scene."""

_OF_MASS = {
    name: name
    for name in ("h0", "h_break", *TENSIONS, "tau_lim", "m", "v0", "k_s", "h_rel", "h_min")
}
_OF_FILM = {name: name for name in ("h0", "h_break", *TENSIONS, "tau_lim")} | {
    "h": "h0",
    "v": "v0",
    "m_ref": "m",
}
"""Parameters of ``stiction-mass`` by variables of each model that a scene gives start values."""

_LABELS = {
    "F_m": "force of the meniscus and the solids, positive resists opening",
    "J_m": "impulse of the meniscus and the solids since the start",
    "h_break": "gap at which the film breaks; 0: where that of the scene does",
}


def native_ports(
    prepared: PreparedScene[SeparationScene],
    lowest: float,
    model: Model = "stiction-mass",
    force: float = 0.0,
    liquid: LiquidTable | None = None,
) -> tuple[Port, ...]:
    """Variables of the FMU of a scene whose tables begin at a gap [m], with a typical force [N].

    The temperature is one if the FMU has the laws of the liquid.
    """
    own = with_temperature(native_model(model).ports, liquid, prepared.scene)
    there = {port.name for port in own} - _absent(prepared, model)
    start = start_of(prepared, model) | {STEP_LIMIT: NATIVE_STEPS}
    sizes = _sizes(prepared.scene, abs(force))
    ports = []
    for port in own:
        if port.name not in there:
            continue
        depends = port.depends_on
        if depends is not None:
            depends = tuple(name for name in depends if name in there)
        port = evolve(
            port,
            depends_on=depends,
            label=_LABELS.get(port.name, port.label),
            start=start.get(port.name, port.start),
            nominal=sizes.get(port.name, port.nominal),
        )
        ports.append(_bounded(port, prepared.scene, lowest, model))
    return tuple(ports)


def with_temperature(
    ports: Iterable[Port], liquid: LiquidTable | None, scene: SeparationScene
) -> tuple[Port, ...]:
    """Variables with the temperature as the laws of the liquid bound it; without it if None."""
    rest = tuple(port for port in ports if port.name != TEMPERATURE.name)
    if liquid is None:
        return rest
    return *rest, evolve(
        TEMPERATURE,
        start=scene.temperature,
        minimum=liquid.low,
        maximum=liquid.high,
        exclusive=False,
    )


def _sizes(scene: SeparationScene, force: float) -> dict[str, float]:
    """Typical sizes of variables, for masters that scale their errors; powers of ten."""
    gap = scene.loading.initial_gap
    found = {"h": gap}
    if force > 0.0:
        found |= dict.fromkeys(("F_ext", "F", "F_m", "F_v", "F_mean", "F_peak"), force)
        found |= {"dF_ext": 1e4 * force, "J": 1e-3 * force, "J_m": 1e-3 * force, "W": force * gap}
    return {name: 10.0 ** math.floor(math.log10(size)) for name, size in found.items()}


def _bounded(port: Port, scene: SeparationScene, lowest: float, model: Model) -> Port:
    """Port within what the tables hold."""
    if port.name == "h0":
        held = _start_is_held(scene)
        low = port.start if held else lowest
        return evolve(port, exclusive=False, minimum=low, maximum=port.start if held else None)
    if model == "stiction-force" and port.name == "h":
        return evolve(port, exclusive=False, minimum=lowest)
    if port.name in {"dp_cav", "tau_lim"} - _limits(scene):
        return evolve(port, maximum=0.0)  # there is nothing to limit, but a master asks for them
    return port


def _limits(scene: SeparationScene) -> set[str]:
    """Limits of the film that are parameters; that of one which is in its tables is none."""
    if on_face(scene) or scene.effect(ViscousForce) is None or is_rheological(scene):
        return set()
    if not scene.meniscus.slips:
        return {"dp_cav", "tau_lim"}
    return {"dp_cav"} if scene.interface.is_flat else set()


def _absent(prepared: PreparedScene[SeparationScene], model: Model) -> set[str]:
    """Parameters that mean nothing for a scene, or that its tables have fixed."""
    viscosity, surface_tension = free_liquid(prepared)
    absent = set[str]()
    if is_rheological(prepared.scene) and model == "stiction-mass":
        absent |= {"dp_cav", "tau_lim"}
    if not viscosity:
        absent |= {"eta"} if model == "stiction-force" else {"eta", "dp_cav", "tau_lim"}
    if not surface_tension:
        absent.add("gamma")
    if not viscosity or not can_cavitate(prepared.scene):
        absent |= {"dp_inception", "dp_hold", "r_cav", "V_void"}
    return absent


def _start_is_held(scene: SeparationScene) -> bool:
    """Whether the tables belong to one gap at the start."""
    adheres = scene.effect(AdhesiveContact) is not None
    return adheres or (keeps_radius(scene) and scene.meniscus.volume is not None)


def start_of(
    prepared: PreparedScene[SeparationScene], model: Model = "stiction-mass"
) -> dict[str, Value]:
    """Start values that a scene gives the variables, by the places of the Python FMU."""
    if prepared.scene.imposed_force.mass is None:
        raise DescriptionError("m", None, "be given", unit="kg")
    named = _OF_MASS if model == "stiction-mass" else _OF_FILM
    scene = prepared.scene
    own = read(PLACES, scene, prepared.liquid) | tension_values(scene.effect(TensionLimit))
    values: dict[str, Value] = {name: own[of] for name, of in named.items()}
    viscosity, surface_tension = free_liquid(prepared)
    if is_rheological(scene):  # a limit is in the tables
        values |= dict.fromkeys((*TENSIONS, "tau_lim"), 0.0)
    return values | {"eta": viscosity, "gamma": surface_tension}


def check_free(ports: tuple[Port, ...], model: Model, given: Mapping[str, Value | str]) -> None:
    """Refuse start values of what the tables hold.

    Raises
    ------
    DescriptionError
        Naming the first.
    """
    free = {port.name for port in ports}
    for name, value in given.items():
        if name not in free and name in {port.name for port in native_model(model).slave.ports}:
            raise DescriptionError(
                name,
                value,
                f"be left out: in a native {model} of this scene it is no variable",
                hint="change the scene, whose geometry, liquid and laws are in the tables",
            )
        if name == TEMPERATURE.name and name not in free:
            raise DescriptionError(
                name,
                value,
                "be left out: the FMU has no laws of this liquid over the temperature",
                hint="take a liquid with laws, and effects that are proportional to its viscosity "
                "or its surface tension, without vapour, and a rheology that is one of stress or "
                "of the rate of shear alone; or build it at this temperature",
            )
