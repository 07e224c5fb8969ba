"""Dynamic wetting: the effects of a scene, and parameters of the films' FMUs.

Each effect is off where its parameter is 0 or NONE, as it is by default.
"""

from __future__ import annotations

from collections.abc import Mapping
from enum import IntEnum
from typing import TYPE_CHECKING, Any, Literal

from ...errors import DescriptionError
from ...separation.wetting.cox_voinov import CoxVoinovAngle
from ...separation.wetting.landau_levich import LandauLevichFilm
from ...separation.wetting.rupture import DynamicRupture
from ...separation.wetting.trouton import TroutonForce
from ...separation.wetting.weight import LiquidWeight
from ..framework.ports import choice_port, tabulated_size

if TYPE_CHECKING:
    from ...capillary.wetting.landau_levich import ThicknessLaw
    from ...scene.scenes import SeparationScene
    from ...separation.effects.base import SeparationEffect

__all__ = [
    "WETTING",
    "WETTING_PORTS",
    "FilmLaw",
    "WeightOn",
    "check_wetting",
    "wetting_effects",
    "wetting_values",
]


class FilmLaw(IntEnum):
    """Law of the film that a receding contact line leaves behind."""

    NONE = 1
    AUSSILLOUS_QUERE = 2
    LANDAU_LEVICH = 3


class WeightOn(IntEnum):
    """Body whose force has the weight of the liquid in it."""

    NONE = 1
    FIXED = 2
    MOVING = 3


_LAWS: Mapping[FilmLaw, ThicknessLaw] = {
    FilmLaw.AUSSILLOUS_QUERE: "aussillous-quere",
    FilmLaw.LANDAU_LEVICH: "landau-levich",
}
_BODIES: Mapping[WeightOn, Literal["lower", "upper"]] = {
    WeightOn.FIXED: "lower",
    WeightOn.MOVING: "upper",
}


WETTING_PORTS = (
    tabulated_size(
        "slip", "m", "slip length of a moving contact line; 0: its angle stays", shown="nm"
    ),
    tabulated_size(
        "slip_from",
        "m",
        "length that the moving angle is seen from; 0: height of the film at its rim",
        shown="um",
    ),
    choice_port(
        "film_law", "film that a receding contact line leaves behind", FilmLaw.NONE, tabulated=True
    ),
    tabulated_size(
        "a_break", "-", "factor of the break distance, 1 + a_break Ca^n_Ca; 0: as at rest"
    ),
    tabulated_size("n_Ca", "-", "exponent of the capillary number there", 0.5, exclusive=True),
    tabulated_size("trouton", "-", "extensional over shear viscosity of the column; 0: not there"),
    choice_port(
        "weight",
        "body whose force has the weight of the liquid in it",
        WeightOn.NONE,
        tabulated=True,
    ),
    tabulated_size("rho", "kg/m3", "density of the liquid; 0: not known"),
)
"""Parameters of dynamic wetting, which native FMUs do not have."""

WETTING = tuple(port.name for port in WETTING_PORTS)


def check_wetting(values: Mapping[str, Any]) -> None:
    """Refuse parameters that contradict each other, or mean nothing without another.

    Raises
    ------
    DescriptionError
        Naming the two.
    """
    if values["slip_from"] > 0.0 and values["slip"] == 0.0:
        hint = "set slip, the slip length of the line, or leave out slip_from"
        raise DescriptionError(
            "slip_from", values["slip_from"], "be 0 where slip is 0", unit="m", hint=hint
        )
    if values["a_break"] > 0.0 and values["h_break"] > 0.0:
        hint = "h_break is a distance that no speed changes; set one of them to 0"
        raise DescriptionError("a_break", values["a_break"], "be 0 where h_break is not", hint=hint)
    if values["weight"] != WeightOn.NONE and values["rho"] == 0.0:
        hint = "give the density of the liquid, or leave out weight"
        raise DescriptionError("rho", 0.0, "exceed 0 where weight is set", unit="kg/m3", hint=hint)


def wetting_effects(values: Mapping[str, Any]) -> tuple[SeparationEffect, ...]:
    """Effects that the parameters of an FMU describe; none by default."""
    found: list[SeparationEffect] = []
    if values["slip"] > 0.0:
        outer = values["slip_from"] or None
        found.append(CoxVoinovAngle(slip_length=values["slip"], outer_length=outer))
    law = FilmLaw(values["film_law"])
    if law is not FilmLaw.NONE:
        found.append(LandauLevichFilm(law=_LAWS[law]))
    if values["a_break"] > 0.0:
        found.append(DynamicRupture(factor=values["a_break"], exponent=values["n_Ca"]))
    if values["trouton"] > 0.0:
        found.append(TroutonForce(trouton_ratio=values["trouton"]))
    body = WeightOn(values["weight"])
    if body is not WeightOn.NONE:
        found.append(LiquidWeight(body=_BODIES[body]))
    return tuple(found)


def wetting_values(scene: SeparationScene) -> dict[str, Any]:
    """Parameters of an FMU for the effects of a scene; what it does not list is off.

    Examples
    --------
    >>> from contactkit import CoxVoinovAngle, Flat, ImposedForce, Interface, SeparationScene
    >>> bodies = Interface(lower=Flat(radius=1e-3), upper=Flat(radius=1e-3))
    >>> pull = ImposedForce(force=1.0, mass=1.0, initial_gap=1e-6, final_gap=1e-4)
    >>> made = SeparationScene(interface=bodies, loading=pull, effects=(CoxVoinovAngle(),))
    >>> wetting_values(made)
    {'slip': 1e-09, 'slip_from': 0.0}
    """
    found: dict[str, Any] = {}
    angle, film = scene.effect(CoxVoinovAngle), scene.effect(LandauLevichFilm)
    end, column = scene.effect(DynamicRupture), scene.effect(TroutonForce)
    weight = scene.effect(LiquidWeight)
    if angle is not None:
        found |= {"slip": angle.slip_length, "slip_from": angle.outer_length or 0.0}
    if film is not None:
        found["film_law"] = next(one.name for one, law in _LAWS.items() if law == film.law)
    if end is not None:
        found |= {"a_break": end.factor, "n_Ca": end.exponent}
    if column is not None:
        found["trouton"] = column.trouton_ratio
    if weight is not None:
        found["weight"] = next(one.name for one, body in _BODIES.items() if body == weight.body)
    return found
