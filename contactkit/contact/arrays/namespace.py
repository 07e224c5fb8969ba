"""Array library, device and precision of what is given: taken once, at the entry of a solve."""

from __future__ import annotations

from typing import Any

import numpy as np
from attrs import field, frozen

from ...errors import DescriptionError
from ...extras import require

__all__ = ["Space", "space_of"]


@frozen(eq=False)
class Space:
    """Space of the maps: namespace of the array API, device, and precision.

    Parameters
    ----------
    xp : module
        Namespace, `numpy` itself for its arrays.
    device : object
        Device of the namespace.
    dtype : object
        float64 or float32 of the namespace.
    """

    xp: Any
    device: Any
    dtype: Any
    epsilon: float = field(init=False)

    @epsilon.default
    def _rounding(self) -> float:
        return float(self.xp.finfo(self.dtype).eps)

    def take(self, values: Any) -> Any:
        """Return numbers, or an array of numpy, or of the namespace, as an array of the space.

        Examples
        --------
        >>> space_of(np.ones((2, 2), np.float32)).take([1.0, 2.0])
        array([1., 2.], dtype=float32)
        """
        if isinstance(values, np.generic):
            values = values.item()
        return self.xp.asarray(values, dtype=self.dtype, device=self.device)

    def total(self, maps: Any) -> Any:
        """Sum of each map, (n, 1, 1)."""
        return self.xp.sum(maps, axis=(-2, -1), keepdims=True)

    def count(self, mask: Any) -> Any:
        """Number of pixels of a mask in each map, (n, 1, 1), as a number of the precision."""
        return self.total(self.xp.astype(mask, self.dtype))

    def highest(self, maps: Any) -> Any:
        """Maximum of each map, (n, 1, 1)."""
        return self.xp.max(maps, axis=(-2, -1), keepdims=True)


def space_of(heights: Any) -> Space:
    """Return the space of heights.

    Integers, lists and numpy's other precisions are taken as numpy's float64.

    Raises
    ------
    DescriptionError
        If an array of another library is neither of float64 nor of float32.
    MissingExtraError
        If it is one of another library and array-api-compat is not installed.

    Examples
    --------
    >>> space_of([[1, 2]]).dtype
    <class 'numpy.float64'>
    """
    if isinstance(heights, np.ndarray | np.generic | list | tuple | int | float):
        is_single = getattr(heights, "dtype", None) == np.float32
        return Space(np, "cpu", np.float32 if is_single else np.float64)
    require("array_api_compat", f"a contact of arrays of {type(heights).__module__}")
    import array_api_compat

    try:
        xp = array_api_compat.array_namespace(heights)
    except TypeError:
        raise DescriptionError(
            "press_maps(heights)", type(heights), "be an array of an array API library"
        ) from None
    if heights.dtype not in (xp.float64, xp.float32):
        raise DescriptionError(
            "press_maps(heights)", heights.dtype, "be of float64, or of float32", hint="convert it"
        )
    return Space(xp, array_api_compat.device(heights), heights.dtype)
