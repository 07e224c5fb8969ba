"""Displacement of a surface under a pressure map, by fast Fourier transforms.

Sign convention: pressure and displacement are positive into the solid.

======  ==================================================================
symbol  meaning
======  ==================================================================
G       influence: displacement at one pixel per unit pressure on another
S       its symbol, the transform of a row of G [m/Pa]
======  ==================================================================
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...errors import DescriptionError
from ...numerics.fft import make_transform, scale_spectrum

__all__ = ["Convolution", "SymbolMaker", "self_influence", "symbol_of"]

Floats = NDArray[np.float64]
SymbolMaker = Callable[[tuple[int, int], tuple[float, float]], Floats]


def symbol_of(
    make_symbol: SymbolMaker,
    shape: tuple[int, int],
    pixel_size: tuple[float, float],
    periodic: bool,
) -> Floats:
    """Symbol of a grid, refused if its shape, sign or values cannot be those of a compliance.

    A periodic compliance is zero at wavenumber 0 and positive elsewhere. The transform of padded
    influence coefficients may have small negative entries: the operator restricted to the map is
    positive all the same.

    Raises
    ------
    DescriptionError
        If the symbol has another shape, is not finite, or is not positive where it must be.

    Examples
    --------
    >>> symbol_of(lambda shape, pixel: np.ones((4, 3)), (4, 4), (1.0, 1.0), True)[0]
    array([0., 1., 1.])
    """
    ny, nx = shape
    expected = (ny, nx // 2 + 1) if periodic else (2 * ny, nx + 1)
    symbol = np.asarray(make_symbol(shape, pixel_size))
    if symbol.shape != expected:
        raise DescriptionError("symbol", symbol.shape, f"have the shape {expected}")
    if np.iscomplexobj(symbol) or not np.all(np.isfinite(symbol)):
        raise DescriptionError("symbol", symbol.dtype, "be real and finite")
    symbol = np.array(symbol, dtype=np.float64)
    if periodic:
        symbol[0, 0] = 0.0
        if not np.all(symbol.ravel()[1:] > 0.0):
            raise DescriptionError(
                "symbol", float(symbol.min()), "be positive at every wavenumber but 0", unit="m/Pa"
            )
    return symbol


def self_influence(symbol: Floats, width: int) -> float:
    r"""Displacement of a pixel under unit pressure on itself [m/Pa].

    .. math:: G(0) = \frac{1}{N} \sum_q S(q)

    Parameters
    ----------
    symbol : ndarray (ny, width // 2 + 1)
        Half spectrum [m/Pa].
    width : int
        Number of columns of the map the symbol belongs to.

    Examples
    --------
    >>> self_influence(np.ones((4, 3)), 4)
    1.0
    """
    twice = float(2.0 * symbol.sum() - symbol[:, 0].sum())
    if width % 2 == 0:
        twice -= float(symbol[:, -1].sum())
    return float(twice / (symbol.shape[0] * width))


def _lent(lender: Convolution | None, shape: tuple[int, ...], kind: Any) -> NDArray[Any]:
    size = int(np.prod(shape))
    if lender is None or lender._spectrum.nbytes < size * np.dtype(kind).itemsize:
        return np.zeros(shape, kind)
    lent: NDArray[Any] = lender._spectrum.view(kind).ravel()[:size].reshape(shape)
    return lent


class Convolution:
    """``displacement = G pressure`` on one grid, with its own in- and output maps.

    Parameters
    ----------
    shape : tuple of int
        Pixels ``(ny, nx)`` of the map.
    symbol : ndarray
        Real symbol, of the map if periodic, of the doubled map otherwise.
    periodic : bool
        Whether the map repeats.
    threads : int
        Threads of the transforms.
    fast : bool
        Transforms by ducc0 instead of scipy.
    dtype : type
        Precision, ``np.float64`` or ``np.float32``.
    scale : callable
        In-place product of spectrum and symbol.
    lender : Convolution, optional
        One of the same map and no less precision, to share the memory of its spectrum.

    Notes
    -----
    `source` must hold the pressure; ``run()`` fills `target`. `count` is the number of runs, each
    of them two transforms; `nbytes` the memory held.

    Examples
    --------
    >>> symbol = np.ones((4, 3))
    >>> convolution = Convolution((4, 4), symbol, periodic=True)
    >>> bool(np.allclose(convolution(np.eye(4)), np.eye(4)))
    True
    """

    def __init__(
        self,
        shape: tuple[int, int],
        symbol: Floats,
        periodic: bool,
        threads: int = 1,
        fast: bool = False,
        dtype: Any = np.float64,
        scale: Callable[..., None] = scale_spectrum,
        lender: Convolution | None = None,
    ) -> None:
        self.shape = shape
        self.count = 0
        self.source: NDArray[Any] = np.zeros(shape, dtype)
        self.target: NDArray[Any] = np.zeros(shape, dtype)
        precise = np.dtype(dtype).itemsize
        kind = np.result_type(dtype, np.complex64)
        self._spectrum = _lent(lender, symbol.shape, kind)
        lent = lender is not None and np.shares_memory(self._spectrum, lender._spectrum)
        self.nbytes = precise * (2 * shape[0] * shape[1] + (1 if lent else 3) * symbol.size)
        if fast and not periodic:
            self.nbytes += precise * 2 * shape[0] * shape[1]  # the padded rows
        self._transform = make_transform(
            np.ascontiguousarray(symbol, dtype),
            shape,
            periodic,
            threads,
            fast,
            scale,
            self._spectrum,
        )

    def run(self) -> NDArray[Any]:
        """Convolve `source` into `target` and give back `target`, which the next run overwrites."""
        self.count += 1
        self._transform(self.source, self.target)
        return self.target

    def __call__(self, pressure: Floats) -> Floats:
        """Displacement of any pressure map, as a new array."""
        self.source[...] = pressure
        return np.array(self.run(), dtype=np.float64)
