"""Temperature rise of a squeezed film: by its own work, or as far as the walls let it."""

from __future__ import annotations

import math
import warnings
from collections.abc import Sequence
from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple

from ...lubrication.flow_laws.heating import adiabatic_rise, conduction_rise
from ...validity import ValidityNumber
from ..effects.film_validity import apparent_viscosity

if TYPE_CHECKING:
    from ...liquids.liquid import Liquid
    from ...scene.scenes import SeparationScene
    from ..effects.film_shape import FilmShape
    from ..effects.force_law import ForceLaw
    from ..effects.prepared import PreparedScene

__all__ = ["HeatedFilm", "heating_number", "temperature_rise", "viscosity_slope"]

_MOST_POINTS = 33  # of a path
_MOST_HEATING = 0.05  # relative change of the viscosity, as that of other neglected effects
_STEP = 0.5  # [K] to each side, of the slope of the viscosity


def viscosity_slope(liquid: Liquid, temperature: float) -> float | None:
    """Slope of the logarithm of the viscosity over the temperature [1/K]; None for a constant."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # half a kelvin beyond the range of a law
        cold, warm = (liquid.at(temperature + step).viscosity for step in (-_STEP, _STEP))
    return math.log(warm / cold) / (2.0 * _STEP) if warm != cold else None


class HeatedFilm(NamedTuple):
    """A film that heats itself: its scene, its shape, its force and the strength of its liquid."""

    prepared: PreparedScene[SeparationScene]
    shape: FilmShape
    law: ForceLaw
    strength: float


def temperature_rise(heated: HeatedFilm, path: Sequence[tuple[float, float]]) -> float | None:
    r"""Bound on the temperature rise of the film along gaps [m] and speeds [m/s], in kelvins.

    Parameters
    ----------
    heated : HeatedFilm
        Of a liquid with a heat capacity and a density, or a thermal conductivity.
    path : sequence of (float, float)
        Gaps and speeds in the order of the run, while the film spans the gap.

    Returns
    -------
    float or None
        The smaller of two bounds [K]: all work of the film stays in its liquid, and walls of
        constant temperature take up all heat at once, where the film is hottest. None where the
        liquid gives the properties for neither.

    Notes
    -----
    The middle of the gap is hottest at the rim of a disc, and at :math:`\sqrt{2 R D}` under a
    sphere. The force of a film that cavitates is taken for its strength times its area at most.
    """
    prepared = heated.prepared
    liquid, state = prepared.scene.meniscus.liquid, prepared.liquid
    density, conductivity = state.given("density"), liquid.thermal_conductivity
    bounds = []
    if density is not None and liquid.heat_capacity is not None:
        capacity = density * liquid.heat_capacity
        bounds.append(_adiabatic(heated, path, capacity))
    if conductivity is not None:
        bounds.append(max((_conducted(heated, *one, conductivity) for one in path), default=0.0))
    return min(bounds, default=None)


def _adiabatic(heated: HeatedFilm, path: Sequence[tuple[float, float]], capacity: float) -> float:
    """Rise [K] of a film that keeps its work, of which the thinnest gap has the least liquid."""
    film = heated.shape

    def force(gap: float, speed: float) -> float:
        found = abs(heated.law.force(gap, speed))
        if speed < 0.0 or math.isinf(heated.strength):
            return found
        return min(found, film.menisci * math.pi * film.radius(gap) ** 2 * heated.strength)

    work = 0.0
    for (gap, speed), (after, later) in pairwise(path):
        work += abs(after - gap) * 0.5 * (force(gap, speed) + force(after, later))
    volume = film.menisci * min(film.volume_at(gap) for gap, _ in path)
    return float(adiabatic_rise(work, volume, capacity)) if volume > 0.0 else 0.0


def _conducted(heated: HeatedFilm, gap: float, speed: float, conductivity: float) -> float:
    """Rise [K] in the middle of the gap where most power is dissipated."""
    film, viscosity = heated.shape, apparent_viscosity(heated.prepared)(gap, speed)
    place, height = film.radius(gap), gap
    if math.isfinite(film.sphere_radius):
        place = min(place, math.sqrt(2.0 * film.sphere_radius * gap))
        height = gap + place * place / (2.0 * film.sphere_radius)
    flux = 0.5 * place * abs(speed)
    power = 12.0 * viscosity * flux * flux / height**3
    return float(conduction_rise(power, height, conductivity))


def heating_number(heated: HeatedFilm, path: Sequence[tuple[float, float]]) -> ValidityNumber:
    """Change of the viscosity by the heat of a film, along gaps [m] and speeds [m/s]."""
    scene = heated.prepared.scene
    step, liquid = max(1, math.ceil(len(path) / _MOST_POINTS)), scene.meniscus.liquid
    rise = temperature_rise(heated, [*path[::step], path[-1]])
    slope = viscosity_slope(liquid, scene.temperature)
    needs = [
        f"liquid.{name} [{unit}]"
        for name, unit in (("density", "kg/m3"), ("thermal_conductivity", "W/m/K"))
        if getattr(liquid, name) is None
    ]
    detail = f"{' and '.join(needs)} is not given" if needs else ""
    if rise is not None:
        detail = f"the film heats itself by {rise:.2g} K at most"
        if liquid.heat_capacity is None:
            detail += ", where walls take up all heat; liquid.heat_capacity adds a second bound"
        if slope is None:
            detail += "; the viscosity is a constant, which no temperature changes"
    return ValidityNumber(
        name="viscosity lost by heating",
        value=None if rise is None or slope is None else abs(slope) * rise,
        high=_MOST_HEATING,
        detail=detail,
        source="viscous work over heat capacity, or over conduction to the walls",
    )
