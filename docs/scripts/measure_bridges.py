"""Measure the numbers of docs/bridges.md: errors of the closures of liquid bridges.

``python docs/scripts/measure_bridges.py`` prints them, ``--write`` puts them into the page. Names
select some: ``... flats spheres breaks printed``.

Not a study of `contactkit.benchmarks.table`: a closure has no setting that refines it. Its error is
that of its physics, over bands of the gap, against the exact bridge, whose own error is a study.
"""

from __future__ import annotations

import math
import sys
from collections.abc import Callable, Mapping

from measured_blocks import measure
from scipy.optimize import brentq
from validation_tables import grid

import contactkit as ck
from contactkit.as_published.lookup import TABLE_4_1
from contactkit.capillary.arc import sphere as arc_sphere
from contactkit.models.liquid_bridges.closure_errors import BandError, flat_errors, sphere_errors

DEG, NM = math.pi / 180.0, 1e-9
FLATS = ((0, 0), (30, 30), (60, 60), (75, 75), (0, 60), (120, 120), (150, 150), (180, 120))
SPHERES = ((1e-8, 40), (1e-4, 0), (1e-4, 60), (1e-2, 60), (1e-1, 0), (1e-1, 60))
WATER = {"surface_tension": 0.072, "angle_lower": 60 * DEG, "angle_upper": 60 * DEG}
# The films of section 3.2.3, one value for each argument.
FILM = {
    **WATER,
    "radius": 100 * NM,
    "gap": 2 * NM,
    "angle": 60 * DEG,
    "number": 100,
    "sphere_radius": 100 * NM,
    "immersion": 1 * NM,
    "filling_angle": 8 * DEG,
    "volume": 927.316e-27,
    "film_height": 2 * NM,
    "gap_start": 2 * NM,
    "gap_end": 180 * NM,
    "separation_time": 1e-7,
    "viscosity": 0.89e-3,
    "force": 1e-9,
}
ON_SPHERE = {"gap": 1 * NM, "gap_start": 1 * NM, "gap_end": 39 * NM}


def _percent(value: float) -> str:
    digits = 1 if value < 0.0995 else 0
    return f"{100.0 * value:.{digits}f}"


def _bands(label: str, found: tuple[BandError, ...]) -> list[str]:
    return [label, *(" / ".join(_percent(e) for e in band.errors.values()) for band in found)]


def _heading(first: str, found: tuple[BandError, ...]) -> list[str]:
    return [first, *(f"{100 * band.low:g} to {100 * band.high:g} %" for band in found)]


def flats_table() -> str:
    """Errors of the arc, of Eq. (3.11) and of the neck of the arc between flats."""
    errors = {pair: flat_errors(pair[0] * DEG, pair[1] * DEG) for pair in FLATS}
    rows = [_bands(f"{a}/{b}", found) for (a, b), found in errors.items()]
    return grid(_heading("angles [deg]", errors[FLATS[0]]), rows)


def spheres_table() -> str:
    """Errors of the arc on the sphere and on its parabola, and of Eq. (3.12)."""
    errors = {case: sphere_errors(case[1] * DEG, case[1] * DEG, case[0]) for case in SPHERES}
    rows = [_bands(f"{v:g}, {t}/{t}", found) for (v, t), found in errors.items()]
    return grid(_heading("V/R^3, angles [deg]", errors[SPHERES[0]]), rows)


def breaks_table() -> str:
    """Break distances of section 3.2.3: printed, of the arc, and of the exact bridge."""
    shape = (60 * DEG, 60 * DEG, 0.0, 1.0 / (100 * NM))
    rows = []
    for s0, far in zip((2, 3, 4, 5, 6), (39, 58, 73, 87, 99), strict=True):
        circle = math.sqrt(2.0 * 100 * NM * (s0 - 1) * NM)
        volume = arc_sphere.volume(1 * NM, circle, *shape, profile="parabola")
        found = ck.published(
            "zero neck",
            volume=volume,
            angle_lower=shape[0],
            angle_upper=shape[1],
            curvature_upper=shape[3],
        )
        assert found.corrected is not None

        def neck(gap: float, volume: float = volume) -> float:
            return float(arc_sphere.solve(gap, volume, *shape, profile="parabola").neck)

        thin = brentq(lambda gap, f=neck: f(gap) - 0.55 * NM, NM, found.value * (1.0 - 1e-9))
        rows.append(
            (
                f"{s0}",
                f"{volume / NM**3:.2f}",
                f"{far}",
                f"{found.value / NM:.3f}",
                f"{thin / NM:.2f}",
                f"{neck(far * NM) / NM:.3f}",
                f"{found.corrected / NM:.3f}",
                f"{far * NM / found.corrected:.1f}",
            )
        )
    head = (
        "s0 [nm]",
        "volume [nm3]",
        "printed [nm]",
        "arc, neck 0 [nm]",
        "arc, neck 0.55 nm [nm]",
        "neck at the printed [nm]",
        "exact limit [nm]",
        "printed over exact",
    )
    return grid(head, rows)


def printed_table() -> str:
    """Table 4.1 for the films of section 3.2.3, each equation with the right value beside."""
    rows = []
    for case, numbers in TABLE_4_1.items():
        for number in numbers:
            formula = ck.PUBLISHED[number]
            film = FILM | (ON_SPHERE if "sphere_radius" in formula.arguments else {})
            given = {name: film[name] for name in formula.arguments if name in film}
            found = ck.published(number, **given)
            right = "none" if found.corrected is None else f"{found.corrected:.4g}"
            error = found.relative_error
            off = "" if error is None else f"{100.0 * error:+.1f}"
            rows.append((case, f"({number})", f"{found.value:.4g}", right, found.unit, off))
    return grid(("case", "equation", "as printed", "right", "unit", "off by [%]"), rows)


TABLES: Mapping[str, Callable[[], str]] = {
    "flats": flats_table,
    "spheres": spheres_table,
    "breaks": breaks_table,
    "printed": printed_table,
}


if __name__ == "__main__":
    sys.exit(measure(TABLES, "bridges "))
