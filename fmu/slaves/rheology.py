"""Rheology of the liquid and its slip: laws of a scene, and parameters of the films' FMUs.

A law is off where its enumeration says NONE, as it is by default; a slip length is 0.
"""

from __future__ import annotations

from collections.abc import Mapping
from enum import IntEnum
from typing import TYPE_CHECKING, Any

from attrs import evolve

from ...errors import DescriptionError, PlanError
from ...liquids.rheology.pressure import BarusViscosity, RoelandsViscosity
from ...liquids.rheology.shear import CarreauViscosity, EyringViscosity, PowerLawViscosity
from ...separation.effects.viscous import ViscousForce
from ..framework.places import Place
from ..framework.ports import choice_port, tabulated_size

if TYPE_CHECKING:
    from ...liquids.liquid import Liquid
    from ...scene.scenes import SeparationScene

__all__ = [
    "RHEOLOGY",
    "RHEOLOGY_PORTS",
    "SLIP_PLACES",
    "PressureLaw",
    "ShearLaw",
    "check_rheology",
    "has_rheology",
    "is_rheological",
    "rheology_values",
    "with_laws",
    "with_rheology",
]


class PressureLaw(IntEnum):
    """Law of the viscosity over pressure."""

    NONE = 1
    BARUS = 2
    ROELANDS = 3


class ShearLaw(IntEnum):
    """Law of the viscosity over the rate of shear."""

    NONE = 1
    POWER_LAW = 2
    CARREAU = 3
    EYRING = 4


RHEOLOGY_PORTS = (
    tabulated_size("b1", "m", "slip length of the liquid on the fixed body", shown="nm"),
    tabulated_size("b2", "m", "slip length of the liquid on the moving body", shown="nm"),
    choice_port("pressure_law", "viscosity over pressure", PressureLaw.NONE, tabulated=True),
    tabulated_size(
        "alpha", "1/Pa", "slope of ln eta over pressure, at ambient pressure", maximum=1e-6
    ),
    choice_port("shear_law", "viscosity over the rate of shear", ShearLaw.NONE, tabulated=True),
    tabulated_size(
        "n_shear", "-", "exponent of POWER_LAW and CARREAU; 1: Newtonian", 1.0, maximum=1.5
    ),
    tabulated_size("rate_c", "1/s", "rate of shear beyond which a POWER_LAW thins"),
    tabulated_size("t_relax", "s", "relaxation time of CARREAU"),
    tabulated_size("eta_ratio", "-", "second plateau over eta, of CARREAU", maximum=1.0),
    tabulated_size("a_shear", "-", "sharpness of CARREAU: Yasuda's a", 2.0, exclusive=True),
    tabulated_size("tau_E", "Pa", "stress of EYRING", shown="MPa"),
)
"""Parameters of the rheology; a native FMU has it in its tables."""

RHEOLOGY = tuple(port.name for port in RHEOLOGY_PORTS)

SLIP_PLACES: Mapping[str, Place] = {
    "b1": Place("interface.meniscus.slip_length_lower"),
    "b2": Place("interface.meniscus.slip_length_upper"),
}

_PRESSURE: Mapping[PressureLaw, tuple[type, dict[str, str]]] = {
    PressureLaw.BARUS: (BarusViscosity, {"alpha": "pressure_coefficient"}),
    PressureLaw.ROELANDS: (RoelandsViscosity, {"alpha": "pressure_coefficient"}),
}
_SHEAR: Mapping[ShearLaw, tuple[type, dict[str, str]]] = {
    ShearLaw.POWER_LAW: (PowerLawViscosity, {"n_shear": "exponent", "rate_c": "critical_rate"}),
    ShearLaw.CARREAU: (
        CarreauViscosity,
        {
            "n_shear": "exponent",
            "t_relax": "relaxation_time",
            "eta_ratio": "second_plateau",
            "a_shear": "sharpness",
        },
    ),
    ShearLaw.EYRING: (EyringViscosity, {"tau_E": "stress"}),
}
_LAWS: Mapping[str, tuple[type[IntEnum], Mapping[Any, tuple[type, dict[str, str]]]]] = {
    "pressure_law": (PressureLaw, _PRESSURE),
    "shear_law": (ShearLaw, _SHEAR),
}
_FIELDS = {"pressure_law": "pressure_viscosity", "shear_law": "shear_viscosity"}


def _constants(name: str, values: Mapping[str, Any]) -> tuple[type | None, dict[str, str]]:
    """Law that a parameter names, and its fields by the parameters of its constants."""
    kind, laws = _LAWS[name]
    return laws.get(kind(values[name]), (None, {}))


def is_rheological(scene: SeparationScene) -> bool:
    """Whether a film follows the pressure and the shear of its liquid, in a host at any motion."""
    viscous, liquid = scene.effect(ViscousForce), scene.meniscus.liquid
    if viscous is None or liquid.is_newtonian or viscous.rheology == "newtonian":
        return False
    return not viscous.takes_printed()


def with_rheology(scene: SeparationScene) -> SeparationScene:
    """Scene whose viscous force computes all of the rheology of its liquid.

    Which parts of it a motion calls for is not known: in a host it may be any.
    """
    if not is_rheological(scene):
        return scene
    effects = (
        evolve(effect, rheology="all") if isinstance(effect, ViscousForce) else effect
        for effect in scene.effects
    )
    return evolve(scene, effects=tuple(effects))


def check_rheology(values: Mapping[str, Any]) -> None:
    """Refuse constants of a law that is not chosen, and a law without its constants.

    Raises
    ------
    DescriptionError
        Naming the constant and the law.
    """
    used = {name for law in _LAWS for name in _constants(law, values)[1]}
    for port in RHEOLOGY_PORTS:
        value = values[port.name]
        if port.name in used or port.name in _LAWS or port.name in SLIP_PLACES:
            continue
        if value != port.start:
            law = "pressure_law" if port.name == "alpha" else "shear_law"
            raise DescriptionError(
                port.name,
                value,
                f"be {port.start:g}, as {law} does not read it",
                unit="" if port.unit == "-" else port.unit,
                hint=f"choose the {law} that it is a constant of",
            )
    _laws(values)


def _laws(values: Mapping[str, Any]) -> dict[str, Any]:
    """Laws that are chosen, by their fields of `Liquid`."""
    found = {}
    for law in _LAWS:
        kind, fields = _constants(law, values)
        if kind is not None:
            constants = {field: (name, values[name]) for name, field in fields.items()}
            found[_FIELDS[law]] = _made(kind, constants)
    return found


def _made(kind: type, constants: Mapping[str, tuple[str, float]]) -> Any:
    """Law with its constants, each by the name of its field and of its parameter."""
    try:
        return kind(**{field: value for field, (_, value) in constants.items()})
    except DescriptionError as error:
        text = str(error)
        for field, (name, _) in constants.items():
            text = text.replace(f"{kind.__name__}.{field}", name)
        raise PlanError(text) from None


def has_rheology(values: Mapping[str, Any]) -> bool:
    """Whether a law is chosen."""
    return any(_constants(law, values)[0] is not None for law in _LAWS)


def with_laws(liquid: Liquid, values: Mapping[str, Any]) -> Liquid:
    """Liquid with the laws that the parameters of an FMU describe."""
    return evolve(liquid, **_laws(values))


def rheology_values(scene: SeparationScene) -> dict[str, Any]:
    """Parameters of an FMU for the laws of the liquid of a scene; without one they are off.

    Raises
    ------
    PlanError
        If a law is none of those that the parameters choose from.

    Examples
    --------
    >>> from contactkit import Flat, ImposedForce, Interface, Liquid, Meniscus, SeparationScene
    >>> from contactkit import ViscousForce
    >>> oil = Liquid(
    ...     name="oil", viscosity=0.1, pressure_viscosity=BarusViscosity(pressure_coefficient=2e-8)
    ... )
    >>> bodies = Interface(
    ...     lower=Flat(radius=1e-3), upper=Flat(radius=1e-3), meniscus=Meniscus(liquid=oil)
    ... )
    >>> pull = ImposedForce(force=1.0, mass=1.0, initial_gap=1e-6, final_gap=1e-4)
    >>> made = SeparationScene(interface=bodies, loading=pull, effects=(ViscousForce(),))
    >>> rheology_values(made)
    {'pressure_law': 'BARUS', 'alpha': 2e-08}
    """
    found: dict[str, Any] = {}
    for name, (_, laws) in _LAWS.items():
        given = getattr(scene.meniscus.liquid, _FIELDS[name])
        if given is None:
            continue
        alike = [one for one, (kind, _) in laws.items() if type(given) is kind]
        if not alike:
            raise PlanError(
                f"the Python FMU has no parameters of liquid.{_FIELDS[name]} = "
                f"{type(given).__name__}(...); add --native, which takes any law"
            )
        found[name] = alike[0].name
        found |= {own: getattr(given, field) for own, field in laws[alike[0]][1].items()}
    return found
