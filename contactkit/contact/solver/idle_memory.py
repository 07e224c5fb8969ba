"""Memory of arrays that are idle, lent to others meanwhile."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

__all__ = ["IdleMemory"]

LINE = 64  # bytes: what is lent begins at a cache line, if the array does


class IdleMemory:
    """Memory of an array, lent piece after piece; what does not fit gets memory of its own.

    Parameters
    ----------
    array : ndarray
        Contiguous; whoever borrows from it overwrites it.

    Attributes
    ----------
    left : ndarray
        Bytes that are not lent.

    Examples
    --------
    >>> idle = IdleMemory(np.zeros(100))
    >>> first, second = idle.take((5, 10), np.float32), idle.take((90,), np.float64)
    >>> first.shape, first.base is None, second.base is None
    ((5, 10), False, True)
    """

    def __init__(self, array: NDArray[Any]) -> None:
        self.left = array.reshape(-1).view(np.uint8)

    def take(self, shape: tuple[int, ...], kind: Any) -> NDArray[Any]:
        """Give an array; zeros if the lending one holds zeros."""
        size = math.prod(shape) * np.dtype(kind).itemsize
        if size > self.left.size:
            return np.zeros(shape, kind)
        taken, self.left = self.left[:size], self.left[-(-size // LINE) * LINE :]
        made: NDArray[Any] = taken.view(kind).reshape(shape)
        return made
