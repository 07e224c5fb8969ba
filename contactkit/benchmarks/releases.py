"""Release of a mass from a film: four cases that two other codes solve to 1e-9 (E: to 3e-8)."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ..liquids.liquid import Liquid
from ..scene.interface import Interface
from ..scene.loading import ImposedForce
from ..scene.meniscus import Meniscus
from ..scene.scenes import SeparationScene
from ..scene.surfaces import Flat
from ..separation.effects.meniscus import AsPublished, MeniscusForce
from ..separation.effects.viscous import TensionLimit, ViscousForce
from .references.tables import reference

__all__ = ["release_cases", "release_scene"]


def release_cases() -> Mapping[str, Mapping[str, Any]]:
    """Parameters of each case under ``case``, its reference under ``values``, in SI units.

    A: 20 um, warm oil, step pull. B: 5 um, volume kept, cold oil, pull rising as 1 - exp(-t/tau).
    D: 10 nm, step pull. E: as B, with a tension limit of 10 bar.

    Examples
    --------
    >>> round(release_cases()["D"]["values"]["t_rel"], 6)
    1.996312
    """
    cases: Mapping[str, Mapping[str, Any]] = reference("releases")
    return cases


def release_scene(name: str) -> SeparationScene:
    """Scene of a release case: a disc on a spring, pulled off an oil film.

    Examples
    --------
    >>> release_scene("D").loading.initial_gap
    1e-08
    """
    case = release_cases()[name]["case"]
    face, limit = Flat(radius=case["R"]), case["dp_cav"]
    film = Meniscus(
        liquid=Liquid(name="oil", viscosity=case["eta"], surface_tension=case["gamma"]),
        volume=case["V"] or None,
        contact_angle_lower=case["theta"],
        contact_angle_upper=case["theta"],
    )
    return SeparationScene(
        interface=Interface(lower=face, upper=face, meniscus=film),
        loading=ImposedForce(
            initial_gap=case["h0"],
            final_gap=case["h_rel"],
            force=case["F0"],
            mass=case["m"],
            stiffness=case["k_s"],
            rise_time=case["tau"],
        ),
        effects=(
            MeniscusForce(profile=AsPublished(radius="disc")),
            ViscousForce(),
            *((TensionLimit(strength=limit, cavity="truncated"),) if limit else ()),
        ),
    )
