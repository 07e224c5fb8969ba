"""What the app shows of a result, as HTML and pictures; nothing here knows a page."""

from __future__ import annotations

import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..app.report_page import validity_rows
from ..export.html import table
from ..plot import style
from ..plot.accessors.base import pictures
from ..plot.roughness import heights_map
from ..scene.curve import Curve
from ..scene.result import Result
from ..units import quantity_text

if TYPE_CHECKING:
    from ..analyses.heights import SurfaceHeights

__all__ = [
    "columns_html",
    "map_picture",
    "number_rows",
    "numbers_html",
    "picture_names",
    "picture_of",
    "remarks",
    "table_html",
]

_FIRST = ("pressure", "contact", "areas", "gap", "forces")
_DPI = 110
_HIDDEN = ("residual", "energy")  # of the solver, in the report and in the files


def picture_names(*owners: Any) -> tuple[list[str], list[str]]:
    """Names of the figures of some results, and those that are drawn first."""
    names = list(dict.fromkeys(name for owner in owners for name in pictures(owner)))
    first = [name for name in _FIRST if name in names][:2]
    return names, first or names[:2]


def picture_of(owner: Any, name: str) -> bytes:
    """PNG of a figure of a result."""
    return _png(pictures(owner)[name]())


def map_picture(found: SurfaceHeights) -> bytes:
    """PNG of heights as a map."""
    return _png(heights_map(found.heights, found.pixel_size))


def _png(ax: Any) -> bytes:
    with tempfile.TemporaryDirectory(prefix="contactkit-") as folder:
        return style.save(ax.figure, Path(folder) / "figure.png", dpi=_DPI).read_bytes()


def number_rows(
    numbers: Mapping[str, tuple[Any, str]], errors: Mapping[str, float] | None = None
) -> list[tuple[str, str, str]]:
    """Rows of numbers: name, value, and its error of the grid where that is known."""
    rows = []
    for name, (value, unit) in numbers.items():
        if name in _HIDDEN:
            continue
        shown = value if isinstance(value, str) else quantity_text(float(value), unit)
        rows.append((name.replace("_", " "), shown, _error((errors or {}).get(name))))
    return rows


def _error(error: float | None) -> str:
    if error is None:
        return ""
    return f"± {100.0 * error:.2g} %" if error < 1.0 else "not resolved by the grid"


def numbers_html(rows: Sequence[tuple[str, str, str]]) -> str:
    """The rows as a table."""
    return table([row if any(one[2] for one in rows) else row[:2] for row in rows])


def table_html(rows: Sequence[Sequence[str]]) -> str:
    """Rows of texts as a table."""
    return table(rows)


def columns_html(curve: Curve) -> str:
    """Columns of a curve as a table, with their units."""
    columns = curve.table()
    rows = [[name.replace("_", " ") for name in columns]]
    for values in zip(*(column for column, _ in columns.values()), strict=True):
        units = (unit for _, unit in columns.values())
        rows.append([quantity_text(float(v), u) for v, u in zip(values, units, strict=True)])
    return table(rows)


def remarks(result: Result) -> tuple[str, list[tuple[str, str, str]], list[tuple[str, str, str]]]:
    """Message of a result, and its rows of validity: those out of range, then all others."""
    numbers = result.validity
    wrong = validity_rows([one for one in numbers if one.is_valid is False])
    right = validity_rows([one for one in numbers if one.is_valid is not False])
    return f"{result.status}: {result.message}", wrong, right
