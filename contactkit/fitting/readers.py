"""Readers of measured curves: CSV files, data frames, datasets, results."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

import numpy as np

from ..errors import DescriptionError, nearest
from ..reading.named_files import existing
from ..scene.curve import Curve
from ..scene.result import Result
from ..units import parse_scale
from .csv_columns import csv_columns
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
        A CSV file with a head such as ``gap [um], force [mN]`` (or ``gap / um``), whose cells are
        separated by commas, semicolons, tabs or blanks, with decimal commas unless these separate
        them; arrays by name, a data frame of pandas, a dataset of xarray, or a result or curve of
        contactkit.
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
        If there is no such column or there are two, it has no unit, or holds no numbers; a row
        without a number is named.

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
        scale, reading = parse_scale(noise_unit), parse_scale(pair[1])
        if scale.dimension != reading.dimension:
            expected = f"convert to {pair[1]}, the unit of the readings"
            raise DescriptionError("units['noise']", noise_unit, expected)
        more["noise"] = found["noise"][0] * (scale.factor / reading.factor)
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
        return _by_name(*csv_columns(existing(source, "file"))), Path(source).stem
    if isinstance(source, Curve):
        return source.table(), ""
    if isinstance(source, Result):
        return {n: (v, source.unit(n)) for n, v in source.columns.items()}, ""
    if hasattr(source, "data_vars"):  # a dataset of xarray
        known = {str(n): source[n] for n in (*source.coords, *source.data_vars)}
        return {n: (one.values, one.attrs.get("units", "")) for n, one in known.items()}, ""
    if hasattr(source, "columns") and hasattr(source, "attrs"):  # a data frame of pandas
        stated, heads = source.attrs.get("units", {}), list(source.columns)
        columns = [source.iloc[:, i].to_numpy() for i in range(len(heads))]
        return _by_name(map(str, heads), columns, stated), ""
    if isinstance(source, Mapping):
        return _by_name(map(str, source), source.values()), ""
    expected = "be a file, arrays by name, a data frame, a dataset, a result or a curve"
    raise DescriptionError("source", source, expected)


_TWICE = object()  # in place of a column whose name another one has


def _by_name(
    headings: Iterable[str],
    columns: Iterable[Any],
    stated: Mapping[Any, str] = MappingProxyType({}),
) -> dict[str, _Column]:
    """Columns by their names; `stated` are units in place of those in the headings."""
    found = dict[str, _Column]()
    for heading, column in zip(headings, columns, strict=True):
        name, unit = _split(heading)
        if name:
            unit = stated.get(heading, unit)
            found[name] = (_TWICE if name in found else column, unit)
    return found


def _split(heading: str) -> tuple[str, str]:
    """Name and unit of a heading such as ``gap [um]``, ``gap (um)`` or ``gap / um``."""
    name, slash, unit = heading.partition(" / ")
    if slash and _is_unit(unit.strip()):
        return name.strip(), unit.strip()
    match = _HEADING.fullmatch(heading)
    return (match["name"], match["unit"] or "") if match else (heading, "")


def _is_unit(text: str) -> bool:
    try:
        parse_scale(text)
    except DescriptionError:
        return False
    return True


def _picked(known: Mapping[str, _Column], column: str, key: str, name: str) -> tuple[Floats, str]:
    """A column as numbers, and its unit."""
    plain = _split(column)[0]
    if plain not in known:
        hint = f"{nearest(plain, list(known))}; give columns={{{key!r}: ...}}"
        raise DescriptionError("column", column, f"be a column of {name or 'the data'}", hint=hint)
    values, unit = known[plain]
    if values is _TWICE:
        hint = "two columns have it: rename one"
        raise DescriptionError(
            "column", column, f"be there once in {name or 'the data'}", hint=hint
        )
    if isinstance(values, list) and all(isinstance(cell, str) for cell in values):
        values = [_number(cell, plain, i) for i, cell in enumerate(values, 2)]
    try:
        found = np.ma.filled(np.ma.array(values, dtype=np.float64), np.nan)
    except (TypeError, ValueError) as error:
        raise DescriptionError("column", column, "hold numbers", hint=str(error)) from None
    if found.ndim != 1:
        raise DescriptionError("column", column, "be one of numbers along one axis")
    return found, unit


def _number(cell: str, column: str, row: int) -> float:
    try:
        return float(cell)
    except ValueError:
        hint, unit = "leave out the row", cell.strip("[]() ")
        if "," in cell:
            hint = "a decimal comma? write a point"
        elif row == 2 and unit and _is_unit(unit):
            hint = f"units stand in the head, as '{column} [{unit}]'"
        raise DescriptionError(f"{column}, row {row}", cell, "be a number", hint=hint) from None
