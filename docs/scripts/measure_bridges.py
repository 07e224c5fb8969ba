"""Measure the numbers of docs/bridges.md: errors of the closures of liquid bridges.

``python docs/scripts/measure_bridges.py`` prints them, ``--write`` puts them into the page. Names
select some: ``... flats spheres``.

Not a study of `contactkit.benchmarks.table`: a closure has no setting that refines it. Its error is
that of its physics, over bands of the gap, against the exact bridge, whose own error is a study.
"""

from __future__ import annotations

import math
import sys
from collections.abc import Callable, Mapping

from measured_blocks import measure
from validation_tables import grid

from contactkit.models.liquid_bridges.closure_errors import BandError, flat_errors, sphere_errors

DEG = math.pi / 180.0
FLATS = ((0, 0), (30, 30), (60, 60), (75, 75), (0, 60), (120, 120), (150, 150), (180, 120))
SPHERES = ((1e-8, 40), (1e-4, 0), (1e-4, 60), (1e-2, 60), (1e-1, 0), (1e-1, 60))


def _percent(value: float) -> str:
    digits = 1 if value < 0.0995 else 0
    return f"{100.0 * value:.{digits}f}"


def _bands(label: str, found: tuple[BandError, ...]) -> list[str]:
    """Largest errors of three parts of the way to the limit of stability."""
    cells = []
    for part in (found[:2], found[2:4], found[4:]):
        closures = [name for name in part[0].errors if name != "neck"]
        largest = [max(band.errors[name] for band in part) for name in closures]
        cells.append(" / ".join(map(_percent, largest)))
    return [label, *cells]


def _heading(first: str, found: tuple[BandError, ...]) -> list[str]:
    ends = [(found[0].low, found[1].high), (found[2].low, found[3].high), found[4][:2]]
    return [first, *(f"{100 * low:g} to {100 * high:g} %" for low, high in ends)]


def flats_table() -> str:
    """Errors of the arc and of Eq. (3.11) between flats."""
    errors = {pair: flat_errors(pair[0] * DEG, pair[1] * DEG) for pair in FLATS}
    rows = [_bands(f"{a}/{b}", found) for (a, b), found in errors.items()]
    return grid(_heading("angles [°]", errors[FLATS[0]]), rows)


def spheres_table() -> str:
    """Errors of the arc on the sphere and on its parabola, and of Eq. (3.12)."""
    errors = {case: sphere_errors(case[1] * DEG, case[1] * DEG, case[0]) for case in SPHERES}
    rows = [_bands(f"{v:g}, {t}/{t}", found) for (v, t), found in errors.items()]
    return grid(_heading("$V/R^3$, angles [°]", errors[SPHERES[0]]), rows)


TABLES: Mapping[str, Callable[[], str]] = {
    "flats": flats_table,
    "spheres": spheres_table,
}


if __name__ == "__main__":
    sys.exit(measure(TABLES, "bridges "))
