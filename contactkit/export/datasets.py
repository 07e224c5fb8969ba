"""Contents of a result as a dataset of xarray."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ..extras import require
from .contents import Contents, Quantity

if TYPE_CHECKING:
    from xarray import Dataset

__all__ = ["dataset"]


def dataset(contents: Contents) -> Dataset:
    """Return the contents of a result as a dataset: coordinates, variables, attributes.

    Raises
    ------
    MissingExtraError
        If xarray is not installed.

    Examples
    --------
    >>> import numpy as np
    >>> x = Quantity(("x",), np.array([0.0, 1.0]), "m", "position")
    >>> p = Quantity(("x",), np.array([2.0, 3.0]), "Pa", "pressure")
    >>> found = dataset(Contents(("x",), {"x": x, "p": p}, {"title": "a line"}))
    >>> found.p.attrs["units"], float(found.p.sel(x=1.0)), found.title
    ('Pa', 3.0, 'a line')
    """
    require("xarray", "a dataset")
    import xarray

    variables = {name: _variable(one) for name, one in contents.quantities.items()}
    return xarray.Dataset(variables, attrs=dict(contents.remarks))


def _variable(one: Quantity) -> tuple[tuple[str, ...], Any, dict[str, str]]:
    """Axes, values and attributes, with the unit 1 of a pure number as files name it."""
    import numpy as np

    attributes = {"units": "1" if one.unit == "-" else one.unit, "long_name": one.label}
    return one.axes, np.asarray(one.values), {k: v for k, v in attributes.items() if v}
