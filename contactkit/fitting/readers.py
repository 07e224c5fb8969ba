"""Readers of measured curves: CSV files, data frames, datasets, results."""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ..errors import DescriptionError, nearest
from ..reading.limits import check_limit
from ..reading.texts import read_text
from ..scene.curve import Curve
from ..scene.result import Result
from .data import MeasuredCurve

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

__all__ = ["read_measured_curve"]

_HEADING = re.compile(r"\s*(?P<name>.*?)\s*(?:[\[(](?P<unit>[^\])]*)[\])])?\s*")
_Column = tuple[Any, str]


def read_measured_curve(
    source: Any,
    over: str,
    quantity: str,
    *,
    columns: Mapping[str, str] | None = None,
    units: Mapping[str, str] | None = None,
    **more: Any,
) -> MeasuredCurve:
    r"""Read a measured curve from a file, a table or a result.

    Parameters
    ----------
    source : str, Path, mapping, DataFrame, Dataset, Result or Curve
        A CSV file with a head such as ``gap [um], force [mN]``, arrays by name, a data frame of
        pandas, a dataset of xarray, or a result or curve of contactkit.
    over, quantity : str
        As of `MeasuredCurve`: what the columns are compared with.
    columns : mapping of str to str, optional
        Name of the column of ``over``, of ``quantity``, and of ``noise`` if there is one: where the
        source calls them otherwise. Names are compared without the unit in their brackets.
    units : mapping of str to str, optional
        Units of the columns, by the same keys; else those of the head, or of the attributes
        ``units`` that `to_dataframe`, `to_xarray` and netCDF have.
    **more
        Further fields of the `MeasuredCurve`.

    Raises
    ------
    DescriptionError
        If there is no such column, it has no unit, or holds no numbers; a row without a number is
        named.

    Examples
    --------
    >>> import pathlib, tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = pathlib.Path(folder) / "pull.csv"
    ...     _ = file.write_text("gap [um],force [mN]\n1.0,30\n2.0,20\n")
    ...     curve = read_measured_curve(file, "gap", "pull", columns={"pull": "force"})
    >>> curve.y, curve.units, curve.name
    (array([0.03, 0.02]), ('um', 'mN'), 'pull')
    """
    known, name = _table(source)
    wanted = {over: over, quantity: quantity} | dict(columns or {})
    if extra := set(wanted) - {over, quantity, "noise"}:
        raise DescriptionError("columns", sorted(extra), f"be of {over}, {quantity} or noise")
    if extra := set(units or {}) - set(wanted):
        raise DescriptionError("units", sorted(extra), f"be of {', '.join(wanted)}")
    found = {key: _picked(known, column, key, name) for key, column in wanted.items()}
    given = units or {}
    pair = tuple(given.get(key) or found[key][1] or _no_unit(key, name) for key in (over, quantity))
    if "noise" in found:
        noise_unit = given.get("noise") or found["noise"][1] or pair[1]
        if noise_unit != pair[1]:
            raise DescriptionError("units['noise']", noise_unit, f"be {pair[1]}, as the readings")
        more["noise"] = found["noise"][0]
    label = {"name": name} if name else {}
    return MeasuredCurve(
        over=over,
        at=found[over][0],
        quantity=quantity,
        values=found[quantity][0],
        units=(pair[0], pair[1]),
        **(label | more),
    )


def _no_unit(key: str, name: str) -> str:
    hint = f"write it into the head, '{key} [um]', or give units={{{key!r}: 'um'}}; '-' for none"
    raise DescriptionError(f"units of {key!r}", name or "data", "be stated", hint=hint)


def _table(source: Any) -> tuple[dict[str, _Column], str]:
    """Columns of a source by name, each with its unit, and a name for the curve."""
    if isinstance(source, str | Path):
        return _csv(Path(source)), Path(source).stem
    if isinstance(source, Curve):
        return source.table(), ""
    if isinstance(source, Result):
        return {n: (v, source.unit(n)) for n, v in source.columns.items()}, ""
    if hasattr(source, "data_vars"):  # a dataset of xarray
        known = {str(n): source[n] for n in (*source.coords, *source.data_vars)}
        return {n: (one.values, one.attrs.get("units", "")) for n, one in known.items()}, ""
    if hasattr(source, "columns") and hasattr(source, "attrs"):  # a data frame of pandas
        stated = source.attrs.get("units", {})
        return {
            plain: (source[head].to_numpy(), stated.get(head, unit))
            for head in source.columns
            for plain, unit in [_split(str(head))]
        }, ""
    if isinstance(source, Mapping):
        return {
            plain: (v, unit) for head, v in source.items() for plain, unit in [_split(str(head))]
        }, ""
    expected = "be a file, arrays by name, a data frame, a dataset, a result or a curve"
    raise DescriptionError("source", source, expected)


def _split(heading: str) -> tuple[str, str]:
    """Name and unit of a heading such as ``gap [um]``."""
    match = _HEADING.fullmatch(heading)
    return (match["name"], match["unit"] or "") if match else (heading, "")


def _csv(path: Path) -> dict[str, _Column]:
    """Columns of a CSV file as texts; lines that begin with # are left out."""
    try:
        text = read_text(path, "TEXT_BYTES", "utf-8-sig")
    except (OSError, UnicodeDecodeError) as error:
        raise DescriptionError("file", str(path), "be a CSV file", hint=str(error)) from None
    lines = [line for line in text.splitlines() if line.strip() and not line.startswith("#")]
    check_limit("POINTS", len(lines), str(path))
    head = lines[0] if lines else ""
    separator = max(",;\t", key=head.count)
    rows = list(csv.reader(io.StringIO("\n".join(lines)), delimiter=separator))
    if len(rows) < 2:
        raise DescriptionError("file", str(path), "have a head and at least one row")
    width = len(rows[0])
    for i, row in enumerate(rows[1:], 2):
        if len(row) != width:
            expected = f"have {width} cells in each row"
            raise DescriptionError("file", str(path), expected, hint=f"row {i} has {len(row)}")
    names = [_split(cell.lstrip("'")) for cell in rows[0]]
    return {
        name: ([row[i] for row in rows[1:]], unit) for i, (name, unit) in enumerate(names) if name
    }


def _picked(known: Mapping[str, _Column], column: str, key: str, name: str) -> tuple[Floats, str]:
    """A column as numbers, and its unit."""
    plain = _split(column)[0]
    if plain not in known:
        hint = f"{nearest(plain, list(known))}; give columns={{{key!r}: ...}}"
        raise DescriptionError("column", column, f"be one of {name or 'the data'}", hint=hint)
    values, unit = known[plain]
    if isinstance(values, list):
        values = [_number(cell, plain, i) for i, cell in enumerate(values, 2)]
    found = np.array(values, dtype=np.float64)
    if found.ndim != 1:
        raise DescriptionError("column", column, "be one of numbers along one axis")
    return found, unit


def _number(cell: str, column: str, row: int) -> float:
    try:
        return float(cell)
    except ValueError:
        hint = "a decimal comma? write a point" if "," in cell else "leave out the row"
        raise DescriptionError(f"{column}, row {row}", cell, "be a number", hint=hint) from None
