"""A number of a result and its slopes."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from attrs import field, frozen

from ..errors import DescriptionError, nearest
from ..export.lines import aligned
from ..units import quantity_text
from .tabular import Contents, Quantity, Tabular, pixel_axes

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from .window import Grid

    Map = NDArray[np.float64]

__all__ = ["HEIGHTS", "Gradient"]

HEIGHTS = "heights"
"""Name of the heights of both bodies together, whose slopes are a map."""


@frozen(eq=False)
class Gradient(Tabular):
    """A number of a result, and its slope over each of some parameters.

    ``gradient["loading.pressure"]`` is a slope in SI units, and ``gradient["heights"]`` a map of
    them: of the number per height of each pixel.

    Attributes
    ----------
    quantity, unit : str
        Name of the number, and its unit.
    value : float
        The number.
    slopes : mapping of str to float or ndarray
        Slopes by the paths of the parameters.
    bases : mapping of str to float
        Values of the parameters.
    units : mapping of str to str
        Units of the parameters.
    notes : tuple of str
        Where slopes are one-sided, and why.
    n_operator_applications : int
        Applications of the operator of a contact that all slopes took together; 0 of a motion.
    n_steps : int
        Internal steps of a motion that were taken again; 0 of a contact.
    """

    quantity: str
    unit: str
    value: float
    slopes: Mapping[str, float | Map] = field(repr=False)
    bases: Mapping[str, float] = field(repr=False)
    units: Mapping[str, str] = field(repr=False)
    notes: tuple[str, ...] = ()
    n_operator_applications: int = 0
    n_steps: int = 0
    grid: Grid | None = field(default=None, repr=False)
    """Pixels of the window of a contact."""
    result: object | None = field(default=None, repr=False)
    """The contact, whose window `plot.heights` draws."""

    def __getitem__(self, path: str) -> Any:
        """Return the slope over a parameter.

        Raises
        ------
        DescriptionError
            If the gradient is not over it.
        """
        if path not in self.slopes:
            hint = nearest(path, self.slopes)
            raise DescriptionError("to", path, "be a parameter of the gradient", hint=hint)
        return self.slopes[path]

    @property
    def is_one_sided(self) -> bool:
        """Whether the slopes hold to one side only; `notes` says why."""
        return bool(self.notes)

    def slope_unit(self, path: str) -> str:
        """Unit of the slope over a parameter."""
        below = self.units[path]
        if below == "-":
            return self.unit
        return f"{self.unit}/{below}" if below.isalnum() else f"{self.unit}/({below})"

    def relative(self, path: str) -> float:
        """Relative change of the number per relative change of a parameter: d ln J/d ln theta [-].

        Raises
        ------
        DescriptionError
            For heights, whose relative change means nothing.
        """
        slope = self[path]
        if path not in self.bases:
            raise DescriptionError("to", path, "be a number: a relative change of a map is none")
        return float(slope) * self.bases[path] / self.value if self.value else 0.0

    def table(self) -> str:
        """Return the number, its slopes, and relative changes per relative change, as text."""
        rows = [("parameter", "value", "slope", "relative")]
        for path, slope in self.slopes.items():
            unit = self.slope_unit(path)
            if path in self.bases:
                value = quantity_text(self.bases[path], self.units[path])
                rows.append((path, value, f"{slope:.6g} {unit}", f"{self.relative(path):.4g}"))
            else:
                ends = f"{np.min(slope):.4g} to {np.max(slope):.4g} {unit}"
                rows.append((path, "map", ends, ""))
        head = f"{self.quantity} = {quantity_text(self.value, self.unit)}"
        return "\n".join([head, *aligned(rows), *self.notes])

    def __str__(self) -> str:
        """Return the table."""
        return self.table()

    def contents(self) -> Contents:
        """Return the slopes of the parameters that are numbers, and the map of the heights."""
        axis, paths = ("parameter",), list(self.bases)
        found = {
            "parameter": Quantity(axis, np.array(paths), "-"),
            "value": Quantity(axis, np.array([self.bases[p] for p in paths]), "", "value in SI"),
            "slope": Quantity(axis, np.array([self.slopes[p] for p in paths]), "", "slope in SI"),
            "slope_unit": Quantity(axis, np.array([self.slope_unit(p) for p in paths]), "-"),
            "relative": Quantity(axis, np.array([self.relative(p) for p in paths]), "-"),
            self.quantity: Quantity((), self.value, self.unit),
        }
        if HEIGHTS in self.slopes and self.grid is not None:
            found |= dict(pixel_axes(self.grid.shape, self.grid.pixel_size))
            unit = self.slope_unit(HEIGHTS)
            found["by_heights"] = Quantity(("y", "x"), self.slopes[HEIGHTS], unit)
        remarks = {"title": f"gradient of {self.quantity}", "notes": "\n".join(self.notes)}
        return Contents(axis, found, remarks)
