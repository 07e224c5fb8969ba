"""The operator of a lone map on no more than the patch where pixels move.

Under a ball the pixels that may move fill a small part of the map. Between them the operator is
that of a map as small as they are, whose padded transforms cost accordingly less.

Sign convention: pressure and displacement positive into the solid.

======  ==========================================================
symbol  meaning
======  ==========================================================
K       displacement of a map under unit pressure on its first pixel
======  ==========================================================
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import scipy.fft
from numpy.typing import NDArray

from ...numerics.fft import scale_spectrum
from .convolution import Convolution

__all__ = ["Patch", "patch_symbol"]

Floats = NDArray[np.float64]
Shape = tuple[int, int]
WORTH = 0.6  # share of the map up to which a patch pays, with the whole map once at the end
LEAST = 8  # pixels along the sides of a patch
ROOMY = 1.3  # pixels, over those asked for, up to which the patch before is kept


def patch_symbol(K: Floats, shape: Shape) -> Floats:
    """Symbol of a patch, on the half spectrum ``(2 ny, nx + 1)`` of the doubled patch.

    Parameters
    ----------
    K : ndarray
        Response to the pixel (0, 0), even in both distances; at least as large as the patch.
    shape : tuple of int
        Pixels ``(ny, nx)`` of the patch.

    Examples
    --------
    >>> patch_symbol(np.array([[3.0, 1.0, 0.5]]), (1, 2))[0]
    array([5.5, 2.5, 1.5])
    """
    ny, nx = shape
    corner = np.zeros((ny + 1, nx + 1))  # what no two pixels are apart does not matter
    there = K[: ny + 1, : nx + 1]
    corner[: there.shape[0], : there.shape[1]] = there
    half = scipy.fft.dctn(corner, type=1)
    return np.concatenate([half, half[-2:0:-1]])


class Patch:
    """Operator on the smallest rectangle around any set of pixels of one lone map.

    Parameters
    ----------
    response : ndarray (ny, nx)
        Displacement under unit pressure on the pixel (0, 0).
    threads, fast, scale
        As those of `Convolution`.
    lender : Convolution
        Of the map, whose spectrum is borrowed.

    Examples
    --------
    >>> patch = Patch(1.0 / (1.0 + np.hypot(*np.indices((16, 16)))))
    >>> patch.take(np.array([5, 22])).shape, patch.at
    ((8, 8), array([0, 9]))
    >>> patch.take(np.array([5, 255])) is None
    True
    """

    def __init__(
        self,
        response: Floats,
        threads: int = 1,
        fast: bool = False,
        scale: Callable[..., None] = scale_spectrum,
        lender: Convolution | None = None,
    ) -> None:
        self.response = response
        self.shape = response.shape
        self._more: dict[str, Any] = {"threads": threads, "fast": fast}
        self._more |= {"scale": scale, "lender": lender}
        self.operator: Convolution | None = None
        self.count = 0

    @property
    def nbytes(self) -> int:
        """Memory held."""
        return 0 if self.operator is None else self.operator.nbytes

    def take(self, at: NDArray[np.intp]) -> Convolution | None:
        """Operator around pixels, by sorted flat indices; none if that is most of the map."""
        row, column = np.divmod(at, self.shape[1])
        top, left = int(row[0]), int(column.min())
        wanted = (int(row[-1]) - top + 1, int(column.max()) - left + 1)
        here = self.operator
        if here is None or not self._fits(here.shape, wanted):
            size = self._size(wanted)
            if size[0] * size[1] > WORTH * self.shape[0] * self.shape[1]:
                return None
            symbol = patch_symbol(self.response, size)
            here = Convolution(size, symbol, False, dtype=np.float32, **self._more)
        self.operator = here
        self.at = (row - top) * here.shape[1] + (column - left)
        return here

    def _size(self, wanted: Shape) -> Shape:
        """Pixels of a patch with some room to grow, good for transforms."""
        good = [scipy.fft.next_fast_len(max(n + n // 16, LEAST)) for n in wanted]
        return min(good[0], self.shape[0]), min(good[1], self.shape[1])

    def _fits(self, shape: Shape, wanted: Shape) -> bool:
        """Whether a patch is large enough, and not much too large."""
        large_enough = shape[0] >= wanted[0] and shape[1] >= wanted[1]
        least = max(wanted[0], LEAST) * max(wanted[1], LEAST)
        return large_enough and shape[0] * shape[1] <= ROOMY * least
