"""Ranges of the rheology of a film along a run: what is left out, tension, memory."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from ...validity import ValidityNumber
from .changes import PARTS, WORTH, force_change
from .film import RheologicalFilm
from .prepared_film import PreparedFilm

if TYPE_CHECKING:
    from ...scene.scenes import SeparationScene
    from ..effects.prepared import PreparedScene
    from ..effects.rheology_view import FilmRheologyView

__all__ = ["rheology_numbers"]

_MOST_POINTS = 33  # of a path; what is stated of it is the largest, to some per cent
# Tension times the coefficient of pressure: pure oils were held at some 10 MPa, where 20 1/GPa
# change their viscosity by a fifth. Beyond, the slope at ambient pressure says nothing.
_MOST_IN_TENSION = 0.2
_COMPARED = 4  # points of a path at which a table is compared


def rheology_numbers(
    prepared: PreparedScene[SeparationScene],
    rheology: FilmRheologyView,
    path: Sequence[tuple[float, float]],
) -> tuple[ValidityNumber, ...]:
    """Evaluate the numbers along pairs of gap [m] and speed [m/s] while the film spans the gap."""
    step = max(1, math.ceil(len(path) / _MOST_POINTS))
    # The first point has the thinnest film of an opening.
    points = [*path[::step], path[-1]]
    found = [*_left_out(prepared, rheology, points)]
    if isinstance(rheology.film, PreparedFilm):
        found += _of_laws(prepared, rheology.computed, rheology.film, points)
        found += _of_table(prepared, rheology.film, points)
    return tuple(found)


def _without(
    prepared: PreparedScene[SeparationScene], rheology: FilmRheologyView
) -> tuple[str, ...]:
    """Parts that the liquid gives and the force leaves out."""
    liquid = prepared.scene.meniscus.liquid
    names = (part.name for part in PARTS if getattr(liquid, part.name) is not None)
    return tuple(name for name in names if name not in rheology.computed)


def _left_out(
    prepared: PreparedScene[SeparationScene],
    rheology: FilmRheologyView,
    points: Sequence[tuple[float, float]],
) -> Iterator[ValidityNumber]:
    words = dict(PARTS)
    for name in _without(prepared, rheology):
        yield ValidityNumber(
            name=f"{words[name]}, left out of the force",
            value=force_change(prepared, name, points),
            high=WORTH,
            detail='largest change of the force by it alone; ViscousForce(rheology="all") '
            "computes it",
            source="force of the film with and without it",
        )


def _of_laws(
    prepared: PreparedScene[SeparationScene],
    computed: tuple[str, ...],
    film: PreparedFilm,
    points: Sequence[tuple[float, float]],
) -> Iterator[ValidityNumber]:
    liquid = prepared.scene.meniscus.liquid
    pressure, shear = liquid.pressure_viscosity, liquid.shear_viscosity
    if pressure is not None and "pressure_viscosity" in computed:
        drops = [(film.peak_pressure(h, v), v) for h, v in points if v != 0.0]
        tension = max((p for p, v in drops if v > 0.0), default=0.0)
        compression = max((p for p, v in drops if v < 0.0), default=0.0)
        yield ValidityNumber(
            name="tension times pressure coefficient",
            value=tension * pressure.pressure_coefficient,
            high=_MOST_IN_TENSION,
            detail="no viscosity was measured in tension: that at ambient pressure and its slope "
            "go on as an exponential; TensionLimit bounds the tension",
            source="alpha p",
        )
        yield ValidityNumber(
            name="pressure over the range of its law",
            value=compression / pressure.highest_pressure,
            high=1.0,
            detail=f"{type(pressure).__name__} fits up to {pressure.highest_pressure:g} Pa",
            source=pressure.cite,
        )
    if shear is not None and "shear_viscosity" in computed:
        memory = shear.memory(prepared.liquid.viscosity)
        yield ValidityNumber(
            name="Deborah number",
            value=max((memory * abs(v) / h for h, v in points), default=0.0),
            high=1.0,
            detail="above 1 the gap opens before the liquid has forgotten its shear: it is "
            "elastic, which is left out",
            source="memory of the liquid times h'/h",
        )


def _of_table(
    prepared: PreparedScene[SeparationScene],
    film: PreparedFilm,
    points: Sequence[tuple[float, float]],
) -> Iterator[ValidityNumber]:
    """Error of the table that a motion reads, at some points of the run, and of a grid."""
    step, whole = max(1, len(points) // _COMPARED), film.film
    force = whole.force if isinstance(whole, RheologicalFilm) else whole.solved_force
    exact = [(force(h, v), film.force(h, v)) for h, v in points[::step] if v != 0.0]
    if not isinstance(whole, RheologicalFilm):
        yield ValidityNumber(
            name="error of the rheology on its grid",
            value=whole.error,
            high=2.0 * prepared.accuracy.film_rtol,
            detail=f"relative, of the force over the Newtonian one, on {whole.cells[0]} cells "
            f"across for the flux and {whole.cells[1]} for what the law changes of it",
            source="half the change from half the cells, where the liquid is farthest from "
            "Newtonian",
        )
    yield ValidityNumber(
        name="error of the film in its table",
        value=max((abs(b / a - 1.0) for a, b in exact if a != 0.0), default=0.0),
        high=2.0 * prepared.accuracy.film_rtol,
        detail="relative, of the force of a full film; at the kink of a power law 7e-4",
        source="the same without a table, along the run",
    )
