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

    from ...lubrication.elastohydrodynamic.maps.motion import MapMotion
    from .maps.film import MapFilm

    Arrays = Mapping[str, NDArray[np.float64]]

__all__ = ["map_ranges", "ranges"]

_WIDE, _STEEP, _LARGE_STRAIN = 0.2, 0.1, 0.1  # validity of half-spaces, of films, of linear solids
_CONTINUUM = 2e-9  # [m], gap below which a liquid is no continuum
_ATMOSPHERE = 101_325.0  # [Pa]
# Error of three meshes over that of smooth films where an edge of a cavity or a contact moves by
# elements: what is measured against finer meshes is a tenth of it.
_AT_EDGES = 50.0
_RESTED = 1.0  # times of drainage, below which solids carry less than the film does
_KEPT = 0.1  # part of the meniscus that vapour may carry off
_WATER = 0.018015  # [kg/mol], by which water is known
_CELLS = 8.0  # per wave or width: forces of a pull are then right to some 1 %
# Error of two runs over `Accuracy.film_rtol`: on 128 cells across, in eight of the width.
_ON_MAPS = 20.0
_IMBALANCE = 0.01
_DECAYED = 4.0  # contact radii inside a rim, beyond which that does not change the contact


def ranges(
    plan: DeformingPlan, columns: Arrays, sections: Arrays, numbers: Mapping[str, float]
) -> tuple[ValidityNumber, ...]:
    """Numbers of validity of a run."""
    slopes = np.abs(np.diff(sections["gap"], axis=1) / np.diff(sections["radius"], axis=1))
    inner = sections["radius"][:, 1:] <= 4.0 * plan.film.width
    pressure = np.abs(sections["film_pressure"] + sections["solid_pressure"]).max()
    is_smooth = not plan.film.cutoff and math.isinf(plan.film.cavity)
    return (
        *_of_the_film(plan, float((slopes * inner).max()), numbers),
        *_of_the_bodies(plan, columns, float(pressure)),
        ValidityNumber(
            name="error of the force",
            value=numbers["force_error"],
            high=plan.accuracy.film_rtol * (1.0 if is_smooth else _AT_EDGES),
            detail="by three meshes, over the largest; near a rupture that of its time counts too",
        ),
        *_of_the_rest(plan),
        *_of_the_amount(plan, float(columns["time"][-1])),
    )


def map_ranges(
    plan: DeformingPlan,
    film: MapFilm,
    motion: MapMotion,
    columns: Arrays,
    numbers: Mapping[str, float],
) -> tuple[ValidityNumber, ...]:
    """Numbers of validity of a run on a map."""
    pixel = max(film.cells.pixel_size)
    is_stated = math.isfinite(film.cells_per_wave)
    return (
        *_of_the_film(plan, motion.slope, numbers),
        *_of_the_bodies(plan, columns, motion.pressure),
        ValidityNumber(
            name="cells per shortest wave",
            value=film.cells_per_wave if is_stated else None,
            low=_CELLS,
            detail="below it peaks and the throats between them are not resolved"
            if is_stated
            else "the surfaces do not state their shortest wave",
        ),
        ValidityNumber(
            name="cells in the width of the pressure",
            value=film.width / pixel,
            low=_CELLS if math.isfinite(film.radius) else 2.0 * _CELLS,
            detail="sqrt(R h) at the start, or the radius of a flat",
        ),
        ValidityNumber(
            name="error of the force",
            value=numbers["force_error"],
            high=min(plan.accuracy.film_rtol * _ON_MAPS, 0.1),
            detail="by a second run on half the cells and with twice the steps, over the largest",
        ),
        ValidityNumber(
            name="imbalance of the energies",
            value=numbers["energy_error"],
            high=_IMBALANCE,
            detail="work less what is dissipated and stored, over the work",
        ),
        *_of_the_rest(plan),
    )


def _of_the_film(
    plan: DeformingPlan, slope: float, numbers: Mapping[str, float]
) -> Iterator[ValidityNumber]:
    yield ValidityNumber(
        name="thinnest gap over 2 nm",
        value=numbers["smallest_gap"] / _CONTINUUM,
        low=1.0,
        detail="below about 2 nm a liquid is not a continuum",
        source="Chan and Horn 1985",
    )
    yield ValidityNumber(
        name="slope of the gap",
        value=slope,
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
    plan: DeformingPlan, columns: Arrays, pressure: float
) -> Iterator[ValidityNumber]:
    film = plan.film
    contact = math.sqrt(float(columns["contact_area"].max()) / math.pi)
    yield ValidityNumber(
        name="pressure over E*",
        value=pressure / plan.modulus,
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
