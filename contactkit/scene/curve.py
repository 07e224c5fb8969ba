"""Curves: columns over one axis, each with its unit, and the numbers that follow from them."""

from __future__ import annotations

import abc
from collections.abc import Mapping
from numbers import Real
from pathlib import Path
from typing import TYPE_CHECKING, Any

from attrs import fields

from .._lazy import above
from ..errors import DescriptionError, nearest
from ..export.contents import Contents
from ..validity import ValidityNumber
from .answer import Answer
from .tabular import curve_contents

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = ["Curve", "Shown"]

Shown = Mapping[str, tuple[tuple[str, ...], str]]


class Curve(Answer):
    """Answer of many solves along one axis: a load, a humidity, an approach, a number, a time.

    A subclass is an attrs class. Its fields with a unit in their metadata are columns where they
    hold a sequence, and scalars where they hold a number. ``curve["contact_area"]`` is a column by
    its name, ``print(curve)`` the message with all scalars.
    """

    __slots__ = ()

    @property
    @abc.abstractmethod
    def axis(self) -> str:
        """Name of the column that the others are over, or of what counts the points."""

    @property
    def shown(self) -> Shown:
        """Figures by name: the columns they draw, and what over; the axis if empty."""
        return {}

    @property
    @abc.abstractmethod
    def title(self) -> str:
        """The curve, in a line."""

    @property
    def status(self) -> str:
        """End of the computation, in a word; a curve with a point that failed is not returned."""
        return "complete"

    @property
    def message(self) -> str:
        """The same as a sentence."""
        return self.title

    @property
    def sources(self) -> tuple[str, ...]:
        """Sources of the equations."""
        return ()

    @property
    def validity(self) -> tuple[ValidityNumber, ...]:
        """Whether the models were inside their ranges, the worst of all points."""
        return ()

    @property
    def parts(self) -> Mapping[str, Any]:
        """Events and branches of the curve, by name."""
        return {}

    def table(self) -> dict[str, tuple[Any, str]]:
        """Return the columns by name, each with its unit."""
        return {n: (v, unit) for n, (v, unit) in self._fields().items() if _is_column(v)}

    def scalars(self) -> dict[str, tuple[float, str]]:
        """Return the numbers of the whole curve, each with its unit."""
        found = self._fields().items()
        return {n: (float(v), unit) for n, (v, unit) in found if _is_number(v)}

    def _fields(self) -> dict[str, tuple[Any, str]]:
        kind: Any = type(self)
        known = [one for one in fields(kind) if "unit" in one.metadata]
        return {one.name: (getattr(self, one.name), one.metadata["unit"]) for one in known}

    def unit(self, name: str) -> str:
        """Return the SI unit of a column."""
        return self._column(name)[1]

    def __getitem__(self, name: str) -> NDArray[Any]:
        """Return a column by its name.

        Raises
        ------
        DescriptionError
            If there is no such column.
        """
        import numpy as np

        return np.asarray(self._column(name)[0])

    def _column(self, name: str) -> tuple[Any, str]:
        known = self.table()
        if name not in known:
            expected = f"be one of {', '.join(known)}"
            raise DescriptionError("column", name, expected, hint=nearest(name, list(known)))
        return known[name]

    def contents(self) -> Contents:
        """Return the columns along the axis, and the numbers of the whole curve."""
        known = self.table()
        numbers = {n: one for n, one in self.scalars().items() if n not in known}
        remarks = {"status": self.status, "message": self.message, "references": self.cite()}
        return curve_contents(self.axis, known, self.title, numbers, remarks)

    def cite(self) -> str:
        """Sources of the equations, one to a line."""
        return "\n".join(self.sources)

    def save(self, path: str | Path) -> Path:
        """Write all columns to an npz file without pickle; `read_curve` reads it."""
        written: Path = above("save_curve")(self, path)
        return written

    @property
    def _headline(self) -> str:
        return self.message


def _is_number(value: Any) -> bool:
    return isinstance(value, Real) and not isinstance(value, bool)


def _is_column(value: Any) -> bool:
    return isinstance(value, tuple) or getattr(value, "ndim", 0) == 1
