"""Base class of studies: columns over the product of the parameters, in memory or in a file."""

from __future__ import annotations

import abc
import math
import textwrap
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from ..errors import DescriptionError, nearest
from ..export.contents import Contents, Quantity
from ..files.curves import SavedCurve, save_curve
from ..frozen import FrozenDict
from ..scene.answer import Answer
from .bands import BAND, RUNS

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = ["StudyColumns", "StudyLine", "as_text", "labels_of"]

_ROUND_OFF = 1e-6  # change over the largest value; a solve is right to its rtol of 1e-8 or better
# Ends of names that tables and figures leave out: measures of the solve, and the ends of bands.
_NOT_TELLING = ("residual", "energy", *(end for end in BAND if end))
_WIDEST = 40  # characters of a value without a name; two of them fit into a line of a terminal


class StudyLine(NamedTuple):
    """Points of a study along one parameter: the values of the others as text, and the columns."""

    label: str
    columns: Mapping[str, NDArray[Any]]


class StudyColumns(Answer):
    """A study as columns over its points: the product of the parameters, the last one fastest."""

    __slots__ = ()

    @property
    @abc.abstractmethod
    def shape(self) -> tuple[int, ...]:
        """Number of values of each parameter."""

    @property
    @abc.abstractmethod
    def paths(self) -> tuple[tuple[str, ...], ...]:
        """Paths of each parameter, several where they vary together."""

    @property
    @abc.abstractmethod
    def units(self) -> Mapping[str, str]:
        """Unit of each column."""

    @property
    @abc.abstractmethod
    def sources(self) -> tuple[str, ...]:
        """Sources of the equations of all points."""

    @property
    @abc.abstractmethod
    def number_names(self) -> tuple[str, ...]:
        """Names of the scalar results, without seconds and counts."""

    @abc.abstractmethod
    def column(self, name: str) -> NDArray[Any]:
        """Return one column over all points, in SI units; nan where a point has no value."""

    @property
    def n_points(self) -> int:
        """Number of points of the study."""
        return math.prod(self.shape)

    @property
    def scale_definitions(self) -> Mapping[str, str]:
        """Definition of each reference scale by its name; none of columns in SI units."""
        return {}

    @property
    def _varied(self) -> list[str]:
        return [path for axis in self.paths for path in axis]

    @property
    def _over(self) -> str:
        """Number of points, and short names of the parameters."""
        over = ", ".join(_ends(paths[0])[0] for paths in self.paths)
        return f"{self.n_points} points over {over}"

    def unit(self, name: str) -> str:
        """Return the unit of a column; ``-`` for none.

        Raises
        ------
        DescriptionError
            If there is no such column.
        """
        self._known(name)
        return self.units[name]

    def _known(self, name: str) -> None:
        if name not in self.units:
            raise DescriptionError(
                "column", name, "be one of the study", hint=nearest(name, list(self.units))
            )

    def __getitem__(self, name: str) -> NDArray[Any]:
        """Return a column by its name, as `column`."""
        return self.column(name)

    def cite(self) -> str:
        """Return the sources of the equations, one to a line."""
        return "\n".join(self.sources)

    def contents(self) -> Contents:
        """Return all columns over the parameters, each an axis with its shortest name.

        Values that are no numbers, such as liquids, are given by their names. An axis along which
        several parameters vary together has the name of the first if its values rise or fall all
        the way, so that they distinguish the points; else, as of a Latin hypercube, ``point``.
        """
        varied = self._varied
        names = labels_of([*varied, *self.units], varied)
        axes, found = tuple(self._axis_names(names)), dict[str, Quantity]()
        for i, paths in enumerate(self.paths):
            for path in paths:
                values = _as_array(self._along(i, path))
                found[names[path]] = Quantity((axes[i],), values, self.units[path], path)
        for name in [*self.units, "status"]:
            if name not in varied:
                values, unit = self.column(name).reshape(self.shape), self.units.get(name, "-")
                found[name] = Quantity(axes, values, unit, name.replace("_", " "))
        return Contents(axes, found, {"title": "study"})

    def _along(self, axis: int, path: str) -> NDArray[Any]:
        """Values of a parameter at the points of its axis."""
        at = np.moveaxis(np.arange(self.n_points).reshape(self.shape), axis, 0)
        values: NDArray[Any] = self.column(path)[at.reshape(self.shape[axis], -1)[:, 0]]
        return values

    def _axis_names(self, names: Mapping[str, str]) -> Iterator[str]:
        """Names of the axes, of which those without an own one are numbered from the second on."""
        unnamed = 0
        for i, paths in enumerate(self.paths):
            if len(paths) == 1 or _is_monotone(self._along(i, paths[0])):
                yield names[paths[0]]
                continue
            unnamed += 1
            yield "point" if unnamed == 1 else f"point_{unnamed}"

    def path_of(self, name: str) -> str:
        """Path of a parameter by its name in tables, its path, or the beginning of that.

        Raises
        ------
        DescriptionError
            If there is none.
        """
        varied = self._varied
        names = labels_of([*varied, *self.units], varied)
        found = [path for path in varied if name in (path, names[path])]
        found += [path for path in varied if path.startswith(name)]
        if not found:
            known = [names[path] for path in varied]
            raise DescriptionError("over", name, f"be one of {', '.join(known)}")
        return found[0]

    def lines(self, along: str | None = None) -> tuple[StudyLine, ...]:
        """Return the points as lines along one parameter, one for each combination of the others.

        Parameters
        ----------
        along : str, optional
            Path of that parameter, or its beginning, such as ``loading``; the last parameter if
            none is given or none fits.
        """
        wanted = along or self.paths[-1][0]
        fits = [i for i, paths in enumerate(self.paths) if any(p.startswith(wanted) for p in paths)]
        axis = fits[0] if fits else len(self.shape) - 1
        places = np.moveaxis(np.arange(self.n_points).reshape(self.shape), axis, -1)
        # A parameter of one value does not distinguish lines.
        others = [
            p for i, ps in enumerate(self.paths) if i != axis and self.shape[i] > 1 for p in ps
        ]
        columns = {name: self.column(name) for name in self.units}
        return tuple(
            StudyLine(
                ", ".join(self._named(p, columns[p][line[0]]) for p in others),
                {name: column[line] for name, column in columns.items()},
            )
            for line in places.reshape(-1, self.shape[axis])
        )

    def _named(self, path: str, value: Any) -> str:
        """A parameter in a legend: numbers with their name and unit, others as they are."""
        value = value.item() if isinstance(value, np.generic) else value
        name = _ends(path)[0].replace("_", " ")
        if isinstance(value, bool):
            return name if value else f"not {name}"
        if not isinstance(value, int | float):
            return as_text(value)
        unit = self.units[path]
        end = "" if unit == "-" else f" {unit}"
        return f"{name} {as_text(value)}{end}"

    def telling(self) -> tuple[str, ...]:
        """Names of the scalar results that change between the points, none that repeats another.

        What is in proportion to a number before it says nothing new, as the fraction of the window
        in contact beside the area. Changes at the level of rounding count as none; of a banded
        study only the medians are taken.
        """
        known: list[NDArray[np.float64]] = []
        found = list[str]()
        for name in self.number_names:
            if name == RUNS or name.endswith(_NOT_TELLING):
                continue
            column = self.column(name)
            if column.dtype.kind != "f" or not _changes(column):
                continue
            if not any(_in_proportion(column, one) for one in known):
                found.append(name)
                known.append(column)
        return tuple(found)

    def save(self, path: str | Path) -> Path:
        """Write all columns to an npz file, atomically; `read_curve` reads it.

        Parameters
        ----------
        path : str or Path
            The file; its suffix becomes ``.npz``. Each column is an array over the points by its
            name, materials and the like as text. ``parts`` of what is read are ``paths``,
            ``shape``, and ``scales``, the definitions of the units of dimensionless columns.
        """
        names = (*self.units, "status")
        parts = {"paths": self.paths, "shape": self.shape, "scales": self.scale_definitions}
        saved = SavedCurve(
            axis="point",
            title="study",
            columns=FrozenDict({name: _as_array(self.column(name)) for name in names}),
            units=FrozenDict({"status": "-"} | dict(self.units)),
            numbers=FrozenDict(self.scalars()),
            status=self.status,
            message=self.message,
            sources=self.sources,
            parts=FrozenDict(parts),
        )
        return save_curve(saved, path)


def as_text(value: Any, digits: int = 6) -> str:
    """A value in a table: what is no number by its label or name."""
    if isinstance(value, float):
        return f"{value:.{digits}g}"
    for name in ("label", "name"):  # of a stack; of a material, a liquid or an effect
        if given := getattr(value, name, None):
            return str(given)
    text = str(value)
    if " " not in text and len(text) > _WIDEST:  # a path, known by its end
        return f"... {text[4 - _WIDEST :]}"
    return textwrap.shorten(text, _WIDEST, placeholder=" ...")


def _is_monotone(values: NDArray[Any]) -> bool:
    """Whether values are numbers that rise or fall all the way."""
    if values.dtype.kind not in "fiu":
        return False
    steps = np.diff(values)
    return bool((steps > 0.0).all() or (steps < 0.0).all())


def labels_of(shown: list[str], varied: list[str]) -> dict[str, str]:
    """Shortest ends of the paths that differ from each other and from the other columns."""
    labels: dict[str, str] = {}
    for name in shown:
        ends = _ends(name) if name in varied else [name]
        others = [end for other in shown if other != name for end in _ends(other)]
        labels[name] = next((end for end in ends if end not in others), name)
    return labels


def _ends(path: str) -> list[str]:
    """Ends of a dotted path, the shortest first."""
    parts = path.split(".")
    return [".".join(parts[i:]) for i in range(len(parts) - 1, -1, -1)]


def _changes(column: NDArray[np.float64]) -> bool:
    """Whether numbers differ by more than rounding."""
    known = column[np.isfinite(column)]
    return known.size > 0 and bool(np.ptp(known) > _ROUND_OFF * np.abs(known).max())


def _in_proportion(one: NDArray[np.float64], other: NDArray[np.float64]) -> bool:
    """Whether two columns have a constant ratio, within round-off, where both are numbers."""
    if not np.array_equal(np.isnan(one), np.isnan(other)):
        return False
    a, b = (values[np.isfinite(values)] for values in (one, other))
    if a.size != b.size or not a.size:
        return False
    a, b = (values / max(float(np.abs(values).max()), 1e-300) for values in (a, b))
    largest = int(np.abs(b).argmax())
    if b[largest] == 0.0:
        return False
    return bool(np.abs(a - a[largest] / b[largest] * b).max() <= _ROUND_OFF)


def _as_array(column: NDArray[Any]) -> NDArray[Any]:
    """A column as an array without objects: text for what is no number."""
    return column if column.dtype != object else np.array([as_text(value) for value in column])
