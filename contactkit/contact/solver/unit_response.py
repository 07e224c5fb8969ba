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
        Real symbol of the operator, as of `convolution.symbol_of`; of an isolated map the rows that
        the others mirror are enough.
    shape : tuple of int
        Pixels ``(ny, nx)`` of the map.
    edges : bool, "x" or "y"
        Whether the map repeats, or along which axis alone.

    Examples
    --------
    >>> unit_response(np.full((4, 3), 2.0), (4, 4), True)
    array([[2., 0., 0.],
           [0., 0., 0.],
           [0., 0., 0.]])
    """
    ny, nx = shape
    if not edges:  # the transform of an even map is a cosine transform of a quarter of it
        made = scipy.fft.idctn(symbol[: ny + 1], type=1)[:ny, :nx]
    else:
        size = symbol.shape[0], symbol_width(nx, edges)
        part = (ny // 2 + 1, nx // 2 + 1) if edges is True else shape
        made = scipy.fft.irfft2(symbol, size)[: part[0], : part[1]]
    return np.ascontiguousarray(made)


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
