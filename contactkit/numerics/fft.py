"""Real two-dimensional transforms behind one small interface: scipy.fft always, ducc0 if installed.

`convolution_of` is the same for other array libraries.

A back end multiplies the spectrum of a map by a real symbol and transforms back; see `fft_pieces`
for maps that are padded or large. Signs do not matter here: the symbols are real and even.
"""

from __future__ import annotations

import importlib
import importlib.util
from collections.abc import Callable
from typing import Any, Literal

import numpy as np
import scipy.fft
from numpy.typing import NDArray

from .fft_pieces import LINE, PiecewiseConvolution, by_ducc, by_scipy, collides, in_threads, scaled

__all__ = [
    "Edges",
    "Transform",
    "convolution_of",
    "fast_transforms_installed",
    "make_transform",
    "mirrored_half",
    "scale_spectrum",
    "spectrum_shape",
]

Array = NDArray[Any]
Transform = Callable[[Array, Array], None]
Scale = Callable[[Array, Array], None]
Edges = bool | Literal["x", "y"]

# Of a spectrum up to which all columns are taken at once: beyond the cache strips save 5 to 20 % of
# the time, below it what they copy costs more.
CACHED_BYTES = 12 * 2**20
MIRRORED = 1e-13  # over the largest of a symbol: round-off of the transform that made it


def fast_transforms_installed() -> bool:
    """Whether ducc0 can be imported.

    Examples
    --------
    >>> fast_transforms_installed() in (True, False)
    True
    """
    return importlib.util.find_spec("ducc0") is not None


def scale_spectrum(spectrum: Array, symbol: Array) -> None:
    """Multiply a spectrum by a real symbol, in place; of a mirrored one the half is enough.

    Examples
    --------
    >>> spectrum = np.array([[1.0 + 2.0j], [1.0], [1.0], [1.0]])
    >>> scale_spectrum(spectrum, np.array([[2.0], [3.0], [4.0]]))
    >>> spectrum.ravel()
    array([2.+4.j, 3.+0.j, 4.+0.j, 3.+0.j])
    """
    half = symbol.shape[0]
    spectrum[:half] *= symbol
    spectrum[half:] *= symbol[spectrum.shape[0] - half : 0 : -1]


def mirrored_half(symbol: Array) -> Array:
    """Rows of a symbol that the others mirror; all rows if they do not, as of a coupling of shear.

    Examples
    --------
    >>> mirrored_half(np.array([[2.0], [3.0], [4.0], [3.0]])).ravel()
    array([2., 3., 4.])
    >>> mirrored_half(np.array([[0.0], [3.0], [0.0], [-3.0]])).size
    4
    """
    n = symbol.shape[0]
    first, last = symbol[1 : (n + 1) // 2], symbol[: n // 2 : -1]
    off = float(np.abs(first - last).max(initial=0.0))
    return symbol[: n // 2 + 1] if off <= MIRRORED * float(np.abs(symbol).max()) else symbol


def _ducc() -> Any:
    return importlib.import_module("ducc0").fft


def _ducc_periodic(
    symbol: Array, threads: int, scale: Scale, spectrum: Array, nx: int
) -> Transform:
    """Both axes at once; columns in strips cost 10 % more."""
    fft = _ducc()
    forth = {"axes": (0, 1), "nthreads": threads}
    back = {**forth, "forward": False, "allow_overwriting_input": True}
    crew = threads if spectrum.nbytes > CACHED_BYTES else 1
    width = -(-spectrum.shape[1] // crew)
    parts = [
        (spectrum[:, i : i + width], symbol[:, i : i + width])
        for i in range(0, symbol.shape[1], width)
    ]

    def transform(source: Array, target: Array) -> None:
        fft.r2c(source, out=spectrum, **forth)
        if crew == 1:
            scale(spectrum, symbol)
        else:
            with in_threads(crew) as each:
                each(lambda part: scale(*part), parts)
        fft.c2r(spectrum, lastsize=nx, out=target, **back)

    return transform


def spectrum_shape(
    half: tuple[int, int], kind: Any, periodic: Edges, fast: bool
) -> tuple[int, int]:
    """Shape of the complex array that `make_transform` works in.

    For ducc0 its rows are an odd number of cache lines long, so that no columns collide. Columns of
    large maps are transformed in strips: only the rows of the map itself are ever stored.

    Parameters
    ----------
    half : tuple of int
        Shape of the symbol.
    kind : dtype
        Its precision.
    periodic, fast : bool
        As in `make_transform`.

    Examples
    --------
    >>> spectrum_shape((2048, 1025), np.float32, periodic=False, fast=True)
    (1024, 1032)
    """
    rows = half[0] // 2 if periodic in (False, "x") and _is_large(half, kind) else half[0]
    if not fast:
        return rows, half[1]
    size = 2 * np.dtype(kind).itemsize
    lines = -(-half[1] * size // LINE) // 2 * 2 + 1
    return rows, lines * LINE // size


def _is_large(half: tuple[int, int], kind: Any) -> bool:
    """Whether a spectrum of the padded map is beyond the cache."""
    size = 2 * int(np.dtype(kind).itemsize)
    return half[0] * half[1] * size > CACHED_BYTES


def make_transform(
    symbol: Array,
    shape: tuple[int, int],
    periodic: Edges,
    threads: int = 1,
    fast: bool = False,
    scale: Scale = scale_spectrum,
    spectrum: Array | None = None,
) -> Transform:
    """Give a function ``transform(source, target)`` that convolves one map into another.

    Parameters
    ----------
    symbol : ndarray
        Real symbol on the half spectrum: ``(ny, nx // 2 + 1)`` if periodic, else that of the
        doubled map, ``(2 ny, nx + 1)``; or `mirrored_half` of it.
    shape : tuple of int
        Pixels ``(ny, nx)`` of the map.
    periodic : bool, "x" or "y"
        Whether the map repeats, or along which axis; across it is padded by zeros to twice its
        side.
    threads : int
        Threads of the transforms.
    fast : bool
        Use ducc0, which must then be installed.
    scale : callable
        In-place product of spectrum and symbol; several threads may call it at once.
    spectrum : ndarray, optional
        Where to work: complex, of the shape `spectrum_shape`. Its precision is that of the
        transforms; without it that of the symbol is.

    Examples
    --------
    >>> transform = make_transform(np.ones((4, 3)), (4, 4), periodic=True)
    >>> source, target = np.arange(16.0).reshape(4, 4), np.zeros((4, 4))
    >>> transform(source, target)
    >>> bool(np.allclose(source, target))
    True
    """
    along_y, along_x = (periodic in (True, axis) for axis in ("y", "x"))
    padded = shape[0] * (1 if along_y else 2), shape[1] * (1 if along_x else 2)
    half = padded[0], symbol.shape[1]
    if spectrum is None:
        kind = np.result_type(symbol.dtype, np.complex64)
        spectrum = np.zeros(spectrum_shape(half, symbol.dtype, periodic, fast), kind)
    spectrum = spectrum[:, : symbol.shape[1]]
    kind = spectrum.real.dtype
    if fast and periodic is True and not collides(shape[1], kind):
        symbol = scaled(symbol, padded, kind)
        return _ducc_periodic(symbol, threads, scale, spectrum, shape[1])
    lines = by_ducc(_ducc()) if fast else by_scipy()
    # Strips of columns that are not padded cost 5 % on one thread.
    in_strips = _is_large(half, kind) and (threads > 1 or not along_y)
    return PiecewiseConvolution(symbol, shape, padded, spectrum, lines, scale, threads, in_strips)


def convolution_of(
    xp: Any, symbol: Any, shape: tuple[int, int], periodic: Edges
) -> Callable[[Any], Any]:
    """Give a function that convolves the last two axes of any array, as a new array.

    The seam for other array libraries, and for many maps at once: scipy transforms arrays of numpy,
    the namespace those of its own, on their device.

    Parameters
    ----------
    xp : module
        Namespace of the arrays, of the Python array API standard.
    symbol : array
        Real symbol on the half spectrum, as of `make_transform`; its dtype is the precision.
    shape : tuple of int
        Pixels ``(ny, nx)`` of each map.
    periodic : bool, "x" or "y"
        Whether the maps repeat, or along which axis; across it they are padded.

    Examples
    --------
    >>> convolve = convolution_of(np, np.full((4, 3), 2.0), (4, 4), periodic=True)
    >>> convolve(np.ones((2, 5, 4, 4))).max()
    np.float64(2.0)
    """
    (ny, nx), rows = shape, symbol.shape[0]
    width = nx if periodic in (True, "x") else 2 * nx
    fft: Any = scipy.fft if xp is np else xp.fft

    def convolve(maps: Any) -> Any:
        # Rows, then columns: the zero rows of padded maps are never transformed.
        waves = fft.fft(fft.rfft(maps, n=width, axis=-1), n=rows, axis=-2)
        waves = fft.ifft(waves * symbol, n=rows, axis=-2)[..., :ny, :]
        return fft.irfft(waves, n=width, axis=-1)[..., :nx]

    return convolve
