"""Displacement of a map under unit pressure on its first pixel, from the symbol of the operator."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import scipy.fft
from numpy.typing import NDArray

from ...numerics.fft import Edges
from .convolution import symbol_width

__all__ = ["UnitResponse", "unit_response"]

Floats = NDArray[np.float64]


def unit_response(symbol: Floats, shape: tuple[int, int], edges: Edges) -> Floats:
    """Displacement ``(ny, nx)`` under unit pressure on the first pixel; to the middle if periodic.

    Parameters
    ----------
    symbol : ndarray
        Real symbol of the operator, as of `convolution.symbol_of`, or `mirrored_half` of it.
    shape : tuple of int
        Pixels ``(ny, nx)`` of the map.
    edges : bool, "x" or "y"
        Whether the map repeats, or along which axis alone.

    Examples
    --------
    >>> unit_response(np.full((3, 3), 2.0), (4, 4), True)
    array([[2., 0., 0.],
           [0., 0., 0.],
           [0., 0., 0.]])
    """
    height = shape[0] * (1 if edges in (True, "y") else 2)
    width = symbol_width(shape[1], edges)
    part = (shape[0] // 2 + 1, shape[1] // 2 + 1) if edges is True else shape
    is_half = symbol.shape[0] < height
    if is_half and isinstance(edges, bool) and height % 2 == width % 2 == 0:
        # The transform of an even map is a cosine transform of a quarter of it, which is enough.
        made = scipy.fft.idctn(symbol, type=1)
    else:
        whole = np.concatenate([symbol, symbol[(height - 1) // 2 : 0 : -1]]) if is_half else symbol
        made = scipy.fft.irfft2(whole, (height, width))
    return np.ascontiguousarray(made[: part[0], : part[1]])


class UnitResponse:
    """A response that is at hand, or made when it is first called for and then kept.

    A contact of scattered spots on a large isolated map never needs it.

    Parameters
    ----------
    given : ndarray or callable
        The response, or what makes it.

    Examples
    --------
    >>> response = UnitResponse(lambda: np.ones((2, 2)))
    >>> response.nbytes, response().shape, response.nbytes
    (0, (2, 2), 32)
    """

    def __init__(self, given: Floats | Callable[[], Floats]) -> None:
        self._given = given

    def __call__(self) -> Floats:
        """Return it."""
        if not isinstance(self._given, np.ndarray):
            self._given = self._given()
        return self._given

    @property
    def nbytes(self) -> int:
        """Memory held."""
        return self._given.nbytes if isinstance(self._given, np.ndarray) else 0
