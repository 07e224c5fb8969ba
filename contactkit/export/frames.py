"""Contents of a result as a data frame of pandas."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ..extras import require
from .contents import Contents, Quantity

if TYPE_CHECKING:
    from numpy.typing import NDArray
    from pandas import DataFrame

__all__ = ["frame"]


def frame(contents: Contents) -> DataFrame:
    """Return the main table of a result: a column for each quantity along its axes.

    Raises
    ------
    MissingExtraError
        If pandas is not installed.

    Examples
    --------
    >>> import numpy as np
    >>> x = Quantity(("x",), np.array([0.0, 1.0]), "m", "position")
    >>> p = Quantity(("x",), np.array([2.0, 3.0]), "Pa", "pressure")
    >>> table = frame(Contents(("x",), {"x": x, "p": p}, {}))
    >>> table.columns.tolist(), table.attrs["units"]["p"]
    (['x', 'p'], 'Pa')
    """
    require("pandas", "a data frame")
    import numpy as np
    import pandas as pd

    rows, known = contents.rows, contents.quantities
    chosen = {n: q for n, q in known.items() if q.axes and set(q.axes) <= set(rows)}
    full = {n: np.asarray(q.values) for n, q in chosen.items() if q.axes == rows}
    shape = next(iter(full.values())).shape
    columns = {n: _spread(q, rows, shape) for n, q in chosen.items() if n not in full}
    columns |= {name: values.ravel() for name, values in full.items()}
    table = pd.DataFrame(columns)
    table.attrs = {"units": {name: known[name].unit for name in columns}, **contents.remarks}
    return table


def _spread(one: Quantity, rows: tuple[str, ...], shape: tuple[int, ...]) -> NDArray[Any]:
    """Values of a quantity over some of the axes, repeated along the others."""
    import numpy as np

    along = [size if axis in one.axes else 1 for axis, size in zip(rows, shape, strict=True)]
    return np.broadcast_to(np.reshape(one.values, along), shape).ravel()
