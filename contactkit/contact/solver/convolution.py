"""Displacement under a pressure map by fast Fourier transforms, on a map or on a patch of it.

The free pixels of an isolated contact often fill a small part of the map. Between them the operator
is that of a map as small, whose padded transforms cost less.

Sign convention: pressure and displacement are positive into the solid.

======  ==================================================================
symbol  meaning
======  ==================================================================
G       influence: displacement at one pixel per unit pressure on another
S       its symbol, the transform of a row of G [m/Pa]
K       displacement of a map under unit pressure on its first pixel
======  ==================================================================
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
import scipy.fft
from numpy.typing import NDArray

from ...errors import DescriptionError
from ...numerics.fft import Edges, make_transform, scale_spectrum, spectrum_shape
from ...numerics.fft_pieces import PiecewiseConvolution
from .idle_memory import IdleMemory

__all__ = [
    "Convolution",
    "Patch",
    "SymbolMaker",
    "Transforms",
    "continue_influence",
    "framed_places",
    "patch_symbol",
    "self_influence",
    "symbol_of",
    "symbol_width",
]

Floats = NDArray[np.float64]
Shape = tuple[int, int]
WORTH = 0.75  # fraction of the map up to which a patch is faster, with one final whole map
LEAST = 8  # pixels along the sides of a patch
ROOMY = 1.3  # pixels over those required, up to which the previous patch is kept
SymbolMaker = Callable[[tuple[int, int], tuple[float, float]], Floats]


class Transforms(NamedTuple):
    """Transforms of a convolution.

    Their number of `threads`, whether they are those of ducc0 (`fast`) instead of scipy's, and
    the in-place product of spectrum and symbol (`scale`).
    """

    threads: int = 1
    fast: bool = False
    scale: Callable[..., None] = scale_spectrum


BY_SCIPY = Transforms()


def symbol_of(
    make_symbol: SymbolMaker,
    shape: tuple[int, int],
    pixel_size: tuple[float, float],
    periodic: Edges,
) -> Floats:
    """Symbol of a grid, refused if its shape, sign or values cannot be those of a compliance.

    A periodic compliance is positive but at wavenumber 0, where it is zero if the mean plane of the
    surface is the datum, or the compliance under a uniform pressure if a base is. The transform of
    padded influence coefficients may have small negative entries: the operator restricted to the
    map is positive all the same.

    Raises
    ------
    DescriptionError
        If the symbol has another shape, is not finite, or is not positive where it must be.

    Examples
    --------
    >>> symbol_of(lambda shape, pixel: np.ones((4, 3)), (4, 4), (1.0, 1.0), True)[0]
    array([1., 1., 1.])
    """
    ny, nx = shape
    expected = (ny if periodic in (True, "y") else 2 * ny, symbol_width(nx, periodic) // 2 + 1)
    symbol = np.asarray(make_symbol(shape, pixel_size))
    if symbol.shape != expected:
        raise DescriptionError("symbol", symbol.shape, f"have the shape {expected}")
    if np.iscomplexobj(symbol) or not np.all(np.isfinite(symbol)):
        raise DescriptionError("symbol", symbol.dtype, "be real and finite")
    symbol = np.array(symbol, dtype=np.float64)
    if periodic is True and not (symbol[0, 0] >= 0.0 and np.all(symbol.ravel()[1:] > 0.0)):
        raise DescriptionError(
            "symbol", float(symbol.min()), "be positive at every wavenumber but 0", unit="m/Pa"
        )
    if not periodic:
        continue_influence(symbol)
    return symbol


def continue_influence(symbol: Floats) -> None:
    """Give influence coefficients that end in zeros a continuation, in place.

    No two pixels of a map of n lines are n lines apart: whatever the coefficient is there, the
    operator on the map is the same. But a zero, as padding leaves it, is an edge that lifts every
    other wavenumber of the symbol, which preconditioners are made from. The coefficient of n - 1
    lines takes its place.

    Parameters
    ----------
    symbol : ndarray (2 ny, nx + 1)
        Of the doubled map; left alone if it has no such edge.

    Examples
    --------
    >>> symbol = np.fft.rfft2(np.outer([3.0, 0.0], [3.0, 1.0, 0.0, 1.0])).real
    >>> continue_influence(symbol)
    >>> np.fft.irfft2(symbol)
    array([[9., 3., 3., 3.],
           [9., 3., 3., 3.]])
    """
    for lines, is_half in ((symbol, False), (symbol.T, True)):
        size = lines.shape[0]
        n = size - 1 if is_half else size // 2
        k = np.arange(size)
        weight = np.full(size, 0.5 / n)
        weight[1:-1] *= 2.0 if is_half else 1.0
        alternating = np.where(k % 2, -1.0, 1.0)
        near, far = weight * np.cos(np.pi * k * (n - 1) / n), weight * alternating
        if abs(far @ lines[:, 0]) < 0.5 * abs(near @ lines[:, 0]):
            lines += alternating[:, None] * ((near - far) @ lines)


def symbol_width(nx: int, periodic: Edges) -> int:
    """Columns of the map that a symbol belongs to, with those of its padding.

    Examples
    --------
    >>> symbol_width(8, "x"), symbol_width(8, "y")
    (8, 16)
    """
    return nx if periodic in (True, "x") else 2 * nx


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


def framed_places(at: NDArray[np.intp], width: int) -> NDArray[np.intp]:
    """Flat indices of pixels in a map with a frame one pixel wide.

    Examples
    --------
    >>> framed_places(np.array([0, 1, 2]), 2)
    array([5, 6, 9])
    """
    return np.asarray(at + 2 * (at // width) + (width + 3))


class Convolution:
    """``displacement = G pressure`` on one grid, with its own in- and output maps.

    Parameters
    ----------
    shape : tuple of int
        Pixels ``(ny, nx)`` of the map.
    symbol : ndarray
        Real symbol, of the map if periodic, of the doubled map otherwise; or `mirrored_half` of it.
    periodic : bool, "x" or "y"
        Whether the map repeats, or along which axis alone.
    transforms : Transforms
        Threads and backend.
    dtype : type
        Precision, ``np.float64`` or ``np.float32``.
    idle : IdleMemory, optional
        Where the spectrum is, which is idle between the runs; its own if not given.
    maps : tuple of ndarray, optional
        Memory of `source` and `target`, zeros; its own if not given. That of the source may have a
        frame one pixel wide, ``(ny + 2, nx + 2)``, for stencils.

    Notes
    -----
    `source` must hold the pressure; ``run()`` fills `target`. `memory` is that of the source, flat
    and with its frame, in which `places` are. `spectrum` is idle between runs. `count` is their
    number, each of them two transforms; `nbytes` its memory.

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
        periodic: Edges,
        transforms: Transforms = BY_SCIPY,
        dtype: Any = np.float64,
        idle: IdleMemory | None = None,
        maps: tuple[NDArray[Any], NDArray[Any]] | None = None,
    ) -> None:
        self.shape = shape
        self.count = 0
        source, target = maps or (np.zeros(shape, dtype), np.zeros(shape, dtype))
        self.memory: NDArray[Any] = source.ravel()
        self._is_framed = source.shape != shape
        self.source: NDArray[Any] = source[1:-1, 1:-1] if self._is_framed else source
        self.target: NDArray[Any] = target
        precise = np.dtype(dtype).itemsize
        kind = np.result_type(dtype, np.complex64)
        rows = shape[0] if periodic in (True, "y") else 2 * shape[0]
        room = spectrum_shape((rows, symbol.shape[1]), dtype, periodic, transforms.fast)
        self.spectrum = np.zeros(room, kind) if idle is None else idle.take(room, kind)
        own = (one for one in (source, target, self.spectrum) if one.base is None)
        self.nbytes = precise * symbol.size + sum(one.nbytes for one in own)
        self._transform = make_transform(symbol, shape, periodic, *transforms, self.spectrum)

    def symbol(self) -> NDArray[Any]:
        """Symbol of an isolated map, the rows that the others mirror, as a new array."""
        assert isinstance(self._transform, PiecewiseConvolution)
        return self._transform.symbol()

    def places(self, at: NDArray[np.intp]) -> NDArray[np.intp]:
        """Places of pixels in `memory`, by flat indices in the map."""
        return framed_places(at, self.shape[1]) if self._is_framed else at

    def run(self) -> NDArray[Any]:
        """Convolve `source` into `target` and return it; the next run overwrites it."""
        self.count += 1
        self._transform(self.source, self.target)
        return self.target

    def __call__(self, pressure: Floats) -> Floats:
        """Displacement of any pressure map, as a new array."""
        self.source[...] = pressure
        return np.array(self.run(), dtype=np.float64)


def patch_symbol(K: Floats, shape: Shape) -> Floats:
    """Symbol of a patch, the mirrored half ``(ny + 1, nx + 1)`` of that of the doubled patch.

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
    corner = np.zeros((ny + 1, nx + 1))  # distances that no two pixels have do not matter
    there = K[: ny + 1, : nx + 1]
    corner[: there.shape[0], : there.shape[1]] = there
    made: Floats = scipy.fft.dctn(corner, type=1)
    return made


class Patch:
    """Operator on the smallest rectangle around any set of pixels, for isolated contacts.

    Parameters
    ----------
    response : callable
        Gives the displacement (ny, nx) under unit pressure on the pixel (0, 0).
    shape : tuple of int
        Pixels ``(ny, nx)`` of the map.
    transforms : Transforms
        Threads and backend.
    memory : ndarray, optional
        Where the spectrum may be, idle between runs.

    Examples
    --------
    >>> patch = Patch(lambda: 1.0 / (1.0 + np.hypot(*np.indices((16, 16)))), (16, 16))
    >>> patch.take(np.array([5, 22])).shape, patch.at
    ((8, 8), array([0, 9]))
    >>> patch.take(np.array([0, 255])) is None
    True
    """

    def __init__(
        self,
        response: Callable[[], Floats],
        shape: Shape,
        transforms: Transforms = BY_SCIPY,
        memory: NDArray[Any] | None = None,
    ) -> None:
        self.response, self.shape = response, shape
        self._transforms, self._memory = transforms, memory
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
        self.corner = top, left
        wanted = (int(row[-1]) - top + 1, int(column.max()) - left + 1)
        here = self.operator
        if here is None or not self._fits(here.shape, wanted):
            size = self._size(wanted)
            if size[0] * size[1] > WORTH * self.shape[0] * self.shape[1]:
                return None
            symbol = patch_symbol(self.response(), size)
            idle = None if self._memory is None else IdleMemory(self._memory)
            here = Convolution(size, symbol, False, self._transforms, np.float32, idle)
        self.operator = here
        self.at = (row - top) * here.shape[1] + (column - left)
        return here

    def add_scaled(self, change: NDArray[np.float32], length: float) -> None:
        """Add the displacement of the patch, times a length, to a flat map."""
        if self.operator is None:
            return
        (top, left), (ny, nx) = self.corner, self.operator.shape
        here = change.reshape(self.shape)[top : top + ny, left : left + nx]
        here += np.float32(length) * self.operator.target[: here.shape[0], : here.shape[1]]

    def _size(self, wanted: Shape) -> Shape:
        """Pixels of a patch with some room to grow, good for transforms."""
        good = [scipy.fft.next_fast_len(max(n + n // 40, LEAST)) for n in wanted]
        return min(good[0], self.shape[0]), min(good[1], self.shape[1])

    def _fits(self, shape: Shape, wanted: Shape) -> bool:
        """Whether a patch is large enough, and not much too large."""
        large_enough = shape[0] >= wanted[0] and shape[1] >= wanted[1]
        least = max(wanted[0], LEAST) * max(wanted[1], LEAST)
        return large_enough and shape[0] * shape[1] <= ROOMY * least
