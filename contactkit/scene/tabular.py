"""Base class of what xarray and pandas can show: results, studies and curves."""

from __future__ import annotations

import abc
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from ..export.contents import Contents, Quantity
from .figures import Drawn

if TYPE_CHECKING:
    from numpy.typing import ArrayLike
    from pandas import DataFrame
    from xarray import Dataset

__all__ = ["Contents", "Quantity", "Tabular", "curve_contents", "pixel_axes"]


class Tabular(Drawn, abc.ABC):
    """A result that xarray, pandas and notebooks can show: `contents` states what it holds."""

    __slots__ = ()

    @abc.abstractmethod
    def contents(self) -> Contents:
        """Return quantities with their axes and units, and remarks."""

    def to_xarray(self) -> Dataset:
        """Return everything as a dataset of xarray, with coordinates and units.

        Units and labels are in the attributes ``units`` and ``long_name`` of each variable, as
        the conventions for netCDF name them; numbers of the whole are variables without axes.
        ``result.to_xarray().to_netcdf("result.nc")`` writes a file.

        Raises
        ------
        MissingExtraError
            If xarray is not installed: ``pip install contactkit[data]``.
        """
        from ..export.datasets import dataset

        return dataset(self.contents())

    def to_dataframe(self) -> DataFrame:
        """Return the main table as a data frame of pandas: a column for each quantity.

        A map has a row for each pixel, a curve for each of its points, a study for each of its
        scenes; what has other axes is left to `to_xarray`. Units by column are in
        ``frame.attrs["units"]``.

        Raises
        ------
        MissingExtraError
            If pandas is not installed: ``pip install contactkit[data]``.
        """
        from ..export.frames import frame

        return frame(self.contents())


def curve_contents(
    axis: str,
    columns: Mapping[str, tuple[ArrayLike, str]],
    title: str,
    numbers: Mapping[str, tuple[float, str]] | None = None,
    remarks: Mapping[str, str] | None = None,
) -> Contents:
    """Return the contents of a curve: columns along one axis and numbers, each with its unit.

    Examples
    --------
    >>> found = curve_contents("load", {"load": ([1.0, 2.0], "N"), "area": ([3.0, 4.0], "m2")}, "")
    >>> found.quantities["area"].axes, found.quantities["area"].unit
    (('load',), 'm2')
    """
    quantities = {
        name: Quantity((axis,), values, unit, name.replace("_", " "))
        for name, (values, unit) in columns.items()
    }
    quantities |= {
        name: Quantity((), value, unit, name.replace("_", " "))
        for name, (value, unit) in (numbers or {}).items()
    }
    return Contents((axis,), quantities, {"title": title, **(remarks or {})})


def pixel_axes(shape: tuple[int, int], pixel_size: tuple[float, float]) -> dict[str, Quantity]:
    """Return the coordinates of the centres of pixels along y and x [m].

    Examples
    --------
    >>> pixel_axes((1, 2), (1.0, 2.0))["x"].values.tolist()
    [1.0, 3.0]
    """
    import numpy as np

    (ny, nx), (dy, dx) = shape, pixel_size
    found: dict[str, Any] = {"y": (np.arange(ny) + 0.5) * dy, "x": (np.arange(nx) + 0.5) * dx}
    return {name: Quantity((name,), values, "m", name) for name, values in found.items()}
