"""Saved curves: columns with their units, numbers and sources in one npz file, and back."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from numbers import Real
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from attrs import asdict, field, frozen

from ..frozen import FrozenDict
from ..scene.curve import Curve, Shown
from ..validity import ValidityNumber
from .results import read_npz, save_npz

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Arrays = dict[str, NDArray[Any]]

__all__ = ["SavedCurve", "read_curve", "read_validity", "save_curve"]


@frozen(eq=False, kw_only=True)
class SavedCurve(Curve):
    """Curve as its file holds it; every `Curve` saves to one, and so does a `Study`.

    It offers what the curve offered by name: columns, scalars, units, sources, validity, figures
    of columns. What only its class knows, such as the plan that was solved, is not in the file.

    Attributes
    ----------
    axis : str
        Name of the column that the others are over, or of what counts the points.
    columns : mapping of str to ndarray (n,)
        Columns by name, read-only.
    units : mapping of str to str
        SI unit of each column.
    numbers : mapping of str to (float, str)
        Scalars of the whole curve, each with its unit.
    parts : mapping
        Events and branches: records as mappings by field, arrays as tuples.
    """

    axis: str
    title: str
    columns: Mapping[str, NDArray[Any]] = field(repr=False)
    units: Mapping[str, str] = field(repr=False)
    numbers: Mapping[str, tuple[float, str]] = field(factory=FrozenDict, repr=False)
    status: str = "complete"
    message: str = ""
    sources: tuple[str, ...] = field(default=(), repr=False)
    validity: tuple[ValidityNumber, ...] = field(default=(), repr=False)
    parts: Mapping[str, Any] = field(factory=FrozenDict, repr=False)
    shown: Shown = field(factory=FrozenDict, repr=False)

    def table(self) -> dict[str, tuple[Any, str]]:
        """Return the columns by name, each with its unit."""
        return {name: (values, self.units[name]) for name, values in self.columns.items()}

    def scalars(self) -> dict[str, tuple[float, str]]:
        """Return the numbers of the whole curve, each with its unit."""
        return dict(self.numbers)


def save_curve(curve: Curve, path: str | Path) -> Path:
    """Write a curve to an npz file without pickle, whole or not at all; `read_curve` reads it.

    Parameters
    ----------
    curve : Curve
        Its columns become arrays by their names; ``header`` is a JSON text with axis, units,
        scalars, status, message, sources, validity, parts and figures.
    path : str or Path
        The file; its suffix becomes ``.npz``.
    """
    known = curve.table()
    header = {
        "kind": "curve",
        "title": curve.title,
        "axis": curve.axis,
        "units": {name: unit for name, (_, unit) in known.items()},
        "scalars": curve.scalars(),
        "status": curve.status,
        "message": curve.message,
        "references": curve.cite(),
        "validity": [asdict(number) for number in curve.validity],
        "parts": _plain(curve.parts),
        "shown": _plain(curve.shown),
    }
    return save_npz(path, {name: np.asarray(values) for name, (values, _) in known.items()}, header)


def _plain(value: Any) -> Any:
    """Records, arrays and mappings as JSON holds them."""
    if hasattr(value, "_asdict"):
        value = value._asdict()
    if isinstance(value, Mapping):
        return {str(key): _plain(one) for key, one in value.items()}
    if isinstance(value, np.generic | np.ndarray):
        return value.tolist()
    return [_plain(one) for one in value] if isinstance(value, tuple | list) else value


def read_curve(path: str | Path) -> SavedCurve:
    """Read a curve that `Curve.save` or `Study.save` has written.

    Parameters
    ----------
    path : str or Path
        The file.

    Returns
    -------
    SavedCurve
        Columns and numbers to the last bit, with units, sources, validity and parts.

    Raises
    ------
    DescriptionError
        If the file is no saved curve, is cut short, or exceeds a limit of `contactkit.reading`.

    Examples
    --------
    >>> import contactkit as ck, pathlib, tempfile
    >>> film = ck.Meniscus(liquid=ck.Liquid(name="air"))
    >>> body = ck.Interface(upper=ck.Sphere(radius=1e-5), meniscus=film)
    >>> rubber = ck.AdhesiveContact(model="jkr", work_of_adhesion=0.05, reduced_modulus=1e9)
    >>> loading = ck.ImposedSpeed(initial_gap=1e-9, final_gap=1e-6, speed=1e-6)
    >>> scene = ck.SeparationScene(interface=body, loading=loading, effects=(rubber,))
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = ck.adhesion_curve(scene, [0.0, 1e-6]).save(pathlib.Path(folder) / "sphere")
    ...     curve = ck.read_curve(file)
    >>> (curve["contact_radius"] * 1e9).round(1), curve.unit("contact_radius")
    (array([413.5, 439.7]), 'm')
    """
    return read_npz(path, "curve", _unpacked)


def _unpacked(header: Any, columns: Arrays, _: str) -> SavedCurve:
    """The curve of a file; what is missing or of another type is refused by an error of Python."""
    if "axis" in header:  # a file of before version 0.2 has no kind, and less in it
        header = {"kind": "curve", "validity": [], "parts": {}, "shown": {}} | header
    if header.get("kind") != "curve":
        raise ValueError(f"it holds a {header.get('kind')!r:.40}; load_result reads results")
    units = _texts(header["units"])
    shapes = {column.shape for column in columns.values()}
    if units.keys() != columns.keys() or len(shapes) != 1 or len(*shapes) != 1:
        raise ValueError(f"its columns are none of one length with units: {sorted(columns)}"[:200])
    scalars = {name: (_number(value), unit) for name, (value, unit) in header["scalars"].items()}
    _texts({name: unit for name, (_, unit) in scalars.items()})
    texts = _texts({key: header[key] for key in ("title", "axis", "status", "message")})
    shown = {n: (tuple(names), over) for n, (names, over) in header["shown"].items()}
    if not {n for names, over in shown.values() for n in (*names, over) if n} <= columns.keys():
        raise ValueError("its figures are of columns that are not there")
    return SavedCurve(
        **texts,
        columns=FrozenDict(columns),
        units=FrozenDict(units),
        numbers=FrozenDict(scalars),
        sources=tuple(_texts({"references": header["references"]})["references"].splitlines()),
        validity=tuple(read_validity(one) for one in header["validity"]),
        parts=_frozen(dict(header["parts"])),
        shown=FrozenDict(shown),
    )


def _texts(found: Mapping[str, Any]) -> dict[str, str]:
    for name, text in found.items():
        if not isinstance(text, str):
            raise TypeError(f"{name} is a {type(text).__name__} and no text")
    return dict(found)


def _number(value: Any) -> float:
    if not isinstance(value, Real):
        raise TypeError(f"a {type(value).__name__} is no number")
    return value  # type: ignore[return-value]  # int and float are registered as Real


def read_validity(fields: Mapping[str, Any]) -> ValidityNumber:
    """Read a validity number of a file; another type is refused by an error of Python."""
    _texts({key: fields[key] for key in ("name", "detail", "source")})
    for key in ("value", "low", "high"):
        if key != "value" or fields[key] is not None:  # one that could not be evaluated
            _number(fields[key])
    return ValidityNumber(**fields)


def _frozen(value: Any) -> Any:
    if isinstance(value, Mapping):
        return FrozenDict({key: _frozen(one) for key, one in value.items()})
    if isinstance(value, Sequence) and not isinstance(value, str):
        return tuple(_frozen(one) for one in value)
    return value
