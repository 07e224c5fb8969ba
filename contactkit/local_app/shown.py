"""Numbers, validity and figures of a result, as rows of texts and pictures."""

from __future__ import annotations

import math
import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..app.report_page import validity_rows
from ..export.html import table
from ..plot import style
from ..plot.accessors.base import pictures
from ..plot.axis_units import in_print
from ..plot.roughness import heights_map
from ..scene.curve import Curve
from ..scene.result import Result
from ..units import readable_unit

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from ..analyses.heights import SurfaceHeights

__all__ = [
    "DENSITY",
    "column_rows",
    "map_picture",
    "number_rows",
    "picture_names",
    "picture_of",
    "remarks",
    "table_html",
]

_FIRST = ("pressure", "contact", "areas", "gap", "forces")
_DPI = 130  # of pictures, see `DENSITY`
DENSITY = 1.3
"""Pixels of a picture to one of the page, which is sharp where those of a screen are small."""
_SIZE = (5.6, 4.2)  # [inch]: read on a phone, two beside each other on a screen
_ROUND_OFF = 1e-9  # the solver's own tolerance is above
_HIDDEN = ("residual", "energy")  # of the solver, in the report and in the files


def picture_names(*owners: Any) -> tuple[list[str], list[str]]:
    """Names of the figures of some results, and those that are drawn first."""
    names = list(dict.fromkeys(name for owner in owners for name in pictures(owner)))
    first = [name for name in _FIRST if name in names][:2]
    return names, first or names[:2]


def picture_of(owner: Any, name: str) -> bytes:
    """PNG of a figure of a result."""
    return _png(pictures(owner)[name]())


def map_picture(found: SurfaceHeights, holes: NDArray[np.bool_] | None) -> bytes:
    """PNG of heights as a map, holes in grey."""
    import numpy as np

    known: Any = found.heights if holes is None else np.ma.array(found.heights, mask=holes)
    ax = heights_map(known, found.pixel_size)
    ax.set_facecolor("0.6")
    return _png(ax)


def _png(ax: Any) -> bytes:
    with tempfile.TemporaryDirectory(prefix="contactkit-") as folder:
        ax.figure.set_size_inches(_SIZE)
        path = style.save(ax.figure, Path(folder) / "figure.png", dpi=_DPI, bbox_inches="tight")
        return path.read_bytes()


def number_rows(
    numbers: Mapping[str, tuple[Any, str]], errors: Mapping[str, float] | None = None
) -> list[tuple[str, str, str]]:
    """Rows of numbers: name, value, and its error of the grid where that is known."""
    rows = []
    for name, (value, unit) in numbers.items():
        if name in _HIDDEN:
            continue
        shown = value if isinstance(value, str) else _quantity(float(value), unit)
        rows.append((name.replace("_", " "), shown, _error((errors or {}).get(name))))
    return rows


def _quantity(value: float, unit: str) -> str:
    if math.isnan(value):
        return "none"  # of an event that did not occur
    factor, name = readable_unit(value, unit)
    number = f"{value / factor:.4g}"
    return number if name in ("-", "") else f"{number} {in_print(name)}"


def _error(error: float | None) -> str:
    if error is None or error < _ROUND_OFF:
        return ""  # of what does not depend on the grid
    return f"± {100.0 * error:.2g} %" if error < 1.0 else "not resolved by the grid"


def table_html(rows: Sequence[Sequence[str]]) -> str:
    """Rows of texts as a table."""
    return table(rows)


def column_rows(curve: Curve) -> list[list[str]]:
    """Columns of a curve as rows of texts with their units, under their names."""
    columns = curve.table()
    rows = [[name.replace("_", " ") for name in columns]]
    for values in zip(*(column for column, _ in columns.values()), strict=True):
        units = (unit for _, unit in columns.values())
        rows.append([_quantity(float(v), u) for v, u in zip(values, units, strict=True)])
    return rows


def remarks(result: Result) -> tuple[str, list[tuple[str, str, str]], list[tuple[str, str, str]]]:
    """Message of a result, and its rows of validity: those out of range, then all others."""
    numbers = result.validity
    wrong = validity_rows([one for one in numbers if one.is_valid is False])
    right = validity_rows([one for one in numbers if one.is_valid is not False])
    said = result.message
    return said if said.startswith(result.status) else f"{result.status}: {said}", wrong, right
