"""Ranges of validity of a film between deforming bodies, along a run."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING

import numpy as np

from ...capillary import vapour
from ...validity import ValidityNumber
from .plan import DeformingPlan

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Arrays = Mapping[str, NDArray[np.float64]]

__all__ = ["ranges"]

_WIDE, _STEEP, _LARGE_STRAIN = 0.2, 0.1, 0.1  # validity of half-spaces, of films, of linear solids
_CONTINUUM = 2e-9  # [m], gap below which a liquid is no continuum
_ATMOSPHERE = 101_325.0  # [Pa]
# Error of three meshes over that of smooth films where an edge of a cavity or a contact moves by
# elements: what is measured against finer meshes is a tenth of it.
_AT_EDGES = 50.0
_RESTED = 1.0  # times of drainage, below which solids carry less than the film does
_KEPT = 0.1  # part of the meniscus that vapour may carry off
_WATER = 0.018015  # [kg/mol], by which water is known
_DECAYED = 4.0  # contact radii inside a rim, beyond which that does not change the contact


def ranges(
    plan: DeformingPlan, columns: Arrays, sections: Arrays, numbers: Mapping[str, float]
) -> tuple[ValidityNumber, ...]:
    """Numbers of validity of a run."""
    return (
        *_of_the_film(plan, sections, numbers),
        *_of_the_bodies(plan, columns, sections),
        _of_the_error(plan, numbers),
        *_of_the_rest(plan),
        *_of_the_amount(plan, float(columns["time"][-1])),
    )


def _of_the_film(
    plan: DeformingPlan, sections: Arrays, numbers: Mapping[str, float]
) -> Iterator[ValidityNumber]:
    yield ValidityNumber(
        name="thinnest gap over 2 nm",
        value=numbers["smallest_gap"] / _CONTINUUM,
        low=1.0,
        detail="below about 2 nm a liquid is not a continuum",
        source="Chan and Horn 1985",
    )
    slopes = np.abs(np.diff(sections["gap"], axis=1) / np.diff(sections["radius"], axis=1))
    inner = sections["radius"][:, 1:] <= 4.0 * plan.film.width
    yield ValidityNumber(
        name="slope of the gap",
        value=float((slopes * inner).max()),
        high=_STEEP,
        detail="the film is flat (Reynolds), within four widths of its pressure",
    )
    yield ValidityNumber(
        name="tension over an atmosphere",
        value=numbers["largest_tension"] / _ATMOSPHERE,
        high=math.inf if math.isfinite(plan.film.cavity) else 1.0,
        detail="beyond it most liquids rupture"
        + (": list TensionLimit()" if plan.film.wetting is None else ", which a rim cannot have"),
    )


def _of_the_bodies(
    plan: DeformingPlan, columns: Arrays, sections: Arrays
) -> Iterator[ValidityNumber]:
    film = plan.film
    pressure = np.abs(sections["film_pressure"] + sections["solid_pressure"]).max()
    contact = math.sqrt(float(columns["contact_area"].max()) / math.pi)
    yield ValidityNumber(
        name="pressure over E*",
        value=float(pressure) / plan.modulus,
        high=_LARGE_STRAIN,
        detail="small strains",
    )
    if math.isfinite(film.radius):
        yield ValidityNumber(
            name="contact or pressure radius over R",
            value=max(contact, film.width) / film.radius,
            high=_WIDE,
            detail="the bodies are half-spaces, and the sphere a paraboloid",
        )
    if contact > 0.0:
        yield ValidityNumber(
            name="rim over the contact radius",
            value=float(columns["rim_radius"].min()) / contact,
            low=_DECAYED if film.wetting is None else 0.0,
            detail="a flooded rim lies outside the deformed region",
        )


def _of_the_error(plan: DeformingPlan, numbers: Mapping[str, float]) -> ValidityNumber:
    is_smooth = not plan.film.cutoff and math.isinf(plan.film.cavity)
    return ValidityNumber(
        name="error of the force",
        value=numbers["force_error"],
        high=plan.accuracy.film_rtol * (1.0 if is_smooth else _AT_EDGES),
        detail="by three meshes, over the largest; near a rupture that of its time counts too",
    )


def _of_the_rest(plan: DeformingPlan) -> Iterator[ValidityNumber]:
    rested = plan.rest_number
    if rested is not None:
        yield ValidityNumber(
            name="rest over the time of drainage",
            value=rested,
            low=_RESTED,
            detail="below it the asperities carry only part of the load: stiction is that of this "
            "rest, and of the gap at its start",
        )


def _of_the_amount(plan: DeformingPlan, duration: float) -> Iterator[ValidityNumber]:
    if not plan.scene.meniscus.has_pressure:
        return
    dries = _drying(plan)
    detail = "the volume at the start is kept, as if the motion were faster than vapour"
    if dries is None:
        detail += "; that takes water and a relative_humidity"
    yield ValidityNumber(
        name="duration over the time in which vapour carries off the meniscus",
        value=None if dries is None else duration / dries,
        high=_KEPT,
        detail=detail,
        source="WMO-No. 8, 2008; Massman 1998",
    )


def _drying(plan: DeformingPlan) -> float | None:
    """Time in which vapour carries off the meniscus [s]; None of a liquid other than water."""
    meniscus, film, temperature = plan.scene.meniscus, plan.film, plan.scene.temperature
    mass, humidity = meniscus.liquid.molar_mass, meniscus.relative_humidity
    if mass is None or humidity is None or abs(mass - _WATER) > 1e-3 * _WATER:
        return None
    around = vapour.gap_conductance(film.rim, film.gap, film.radius)
    molar = meniscus.liquid.molar_volume(temperature)
    return vapour.drying_time(plan.volume, around, molar, temperature, humidity)
