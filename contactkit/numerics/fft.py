"""Real two-dimensional transforms behind one small interface: scipy.fft always, ducc0 if installed.

`convolution_of` is the same for other array libraries.

A back end multiplies the spectrum of a map by a real symbol and transforms back. The free case
never stores the zero rows of the padded map: rows are padded and transformed first, then columns.
Signs do not matter here: the symbols are real and even.
"""

from __future__ import annotations

import importlib
import importlib.util
from collections.abc import Callable
from typing import Any, Literal

import numpy as np
import scipy.fft
from numpy.typing import NDArray

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

# These balance the calls of many small pieces against what spills from the cache; none changes a
# result. Times below: free maps of 1024 x 1024 on one thread of a shared server, to 10 %.

# Of rows transformed at a time by scipy: 2**16 take 1.15 times the time, all at once 1.7 times.
CHUNK_BYTES = 2**20
# Of a padded spectrum up to which ducc0 takes all columns at once: beyond the cache strips save 5
# to 20 % of the time, below it what they copy costs more.
CACHED_BYTES = 12 * 2**20
# Bytes between rows whose first elements share a cache set (32 KiB in 8 ways). On processors with
# such a cache their collisions cost half of the time; on others nothing is lost.
PITCH = 4096
LINE = 64  # bytes by which rows are made longer against that: a cache line; 256 do no better
# Of rows that each thread of ducc0 takes at a time, where they are copied: no trend from 2**14 to
# 2**20, 1.15 times the time at 2**22.
ROWS_BYTES = 2**18
MIRRORED = 1e-13  # over the largest of a symbol: round-off of the transform that made it
STRIP = 32  # columns that each thread of ducc0 takes at a time beyond CACHED_BYTES


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


def _scipy_transform(
    symbol: Array, periodic: bool, workers: int, scale: Scale, spectrum: Array
) -> Transform:
    """Rows in chunks, so that what scipy allocates stays in the cache; columns in place.

    `periodic` is along the rows; columns are padded to the length of the symbol.
    """

    def transform(source: Array, target: Array) -> None:
        ny, nx = source.shape
        width = nx if periodic else 2 * nx
        step = workers * max(8, CHUNK_BYTES // (width * source.itemsize))
        parts = [slice(i, min(i + step, ny)) for i in range(0, ny, step)]
        for part in parts:
            spectrum[part] = scipy.fft.rfft(source[part], width, axis=1, workers=workers)
        spectrum[ny:] = 0.0
        waves = scipy.fft.fft(spectrum, axis=0, overwrite_x=True, workers=workers)
        scale(waves, symbol)
        waves = scipy.fft.ifft(waves, axis=0, norm="forward", overwrite_x=True, workers=workers)
        for part in parts:
            back = scipy.fft.irfft(waves[part], width, axis=1, norm="forward", workers=workers)
            target[part] = back[:, :nx]

    return transform


class _Rows:
    """Transforms along the rows of a map by ducc0, zeros appended, a few padded rows at a time.

    Rows a power of two of bytes apart share the lines of a cache, and ducc0 takes several at once:
    from `PITCH` on they are copied to rows that are a little longer.
    """

    def __init__(self, shape: tuple[int, int], width: int, kind: Any, threads: int) -> None:
        self.fft: Any = importlib.import_module("ducc0").fft
        (ny, self.nx), self.width, self.threads = shape, width, threads
        size = np.dtype(kind).itemsize
        count = min(ny, max(8, ROWS_BYTES // (width * size)) * threads)
        self.parts = [slice(i, min(i + count, ny)) for i in range(0, ny, count)]
        self.some = np.zeros((count, width + LINE // size), kind)[:, :width]

    def forth(self, source: Array, spectrum: Array) -> None:
        """Half spectrum of every row."""
        for part in self.parts:
            rows = self.some[: part.stop - part.start]
            rows[:, : self.nx] = source[part]
            rows[:, self.nx :] = 0.0
            self.fft.r2c(rows, axes=(1,), out=spectrum[part], nthreads=self.threads)

    def back(self, spectrum: Array, target: Array) -> None:
        """Rows of half spectra."""
        given = {"axes": (1,), "lastsize": self.width, "forward": False, "nthreads": self.threads}
        for part in self.parts:
            rows = self.some[: part.stop - part.start]
            self.fft.c2r(spectrum[part], out=rows, **given)
            target[part] = rows[:, : self.nx]


def _ducc_periodic(
    symbol: Array, threads: int, scale: Scale, spectrum: Array, nx: int
) -> Transform:
    fft: Any = importlib.import_module("ducc0").fft
    forth = {"axes": (0, 1), "nthreads": threads}
    back = {**forth, "forward": False, "allow_overwriting_input": True}

    def transform(source: Array, target: Array) -> None:
        fft.r2c(source, out=spectrum, **forth)
        scale(spectrum, symbol)
        fft.c2r(spectrum, lastsize=nx, out=target, **back)

    return transform


def _ducc_pitched(symbol: Array, threads: int, scale: Scale, spectrum: Array, nx: int) -> Transform:
    """The same for maps whose rows collide in the cache."""
    rows = _Rows((spectrum.shape[0], nx), nx, symbol.dtype, threads)

    def transform(source: Array, target: Array) -> None:
        rows.forth(source, spectrum)
        rows.fft.c2c(spectrum, axes=(0,), out=spectrum, nthreads=threads)
        scale(spectrum, symbol)
        rows.fft.c2c(spectrum, axes=(0,), forward=False, out=spectrum, nthreads=threads)
        rows.back(spectrum, target)

    return transform


def _ducc_free(
    symbol: Array, threads: int, scale: Scale, spectrum: Array, shape: tuple[int, int]
) -> Transform:
    """Rows, then columns: all at once, or if they exceed the cache a strip of them forth and back.

    What a strip copies costs more than it saves on small maps.
    """
    fft: Any = importlib.import_module("ducc0").fft
    ny, nx = shape
    top, rows = spectrum[:ny], _Rows((ny, nx), 2 * nx, symbol.dtype, threads)
    is_small = spectrum.shape[0] > ny
    width = nx + 1 if is_small else STRIP * threads
    parts = [slice(i, min(i + width, nx + 1)) for i in range(0, nx + 1, width)]
    symbols = [np.ascontiguousarray(symbol[:, part]) for part in parts]
    strip = spectrum if is_small else np.zeros((2 * ny, width), spectrum.dtype)

    def columns(part: slice, strip: Array, symbol: Array) -> None:
        if not is_small:
            strip[:ny] = top[:, part]
        strip[ny:] = 0.0
        fft.c2c(strip, axes=(0,), out=strip, nthreads=threads)
        scale(strip, symbol)
        fft.c2c(strip, axes=(0,), forward=False, out=strip, nthreads=threads)
        if not is_small:
            top[:, part] = strip[:ny]

    def transform(source: Array, target: Array) -> None:
        rows.forth(source, top)
        for part, s in zip(parts, symbols, strict=True):
            last = part.stop - part.start
            columns(part, strip if last == strip.shape[1] else strip[:, :last], s)
        rows.back(top, target)

    return transform


def spectrum_shape(
    half: tuple[int, int], kind: Any, periodic: Edges, fast: bool
) -> tuple[int, int]:
    """Shape of the complex array that `make_transform` works in.

    For ducc0 its rows are an odd number of cache lines long, so that no columns collide. Large free
    maps transform their columns in strips: only the rows of the map are ever stored.

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
    if not fast:
        return half
    size = 2 * np.dtype(kind).itemsize
    lines = -(-half[1] * size // LINE) // 2 * 2 + 1
    is_large = half[0] * half[1] * size > CACHED_BYTES
    return (half[0] // 2 if is_large and not periodic else half[0]), lines * LINE // size


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
        doubled map, ``(2 ny, nx + 1)``; or `mirrored_half` of it. Its dtype is the precision of the
        transforms.
    shape : tuple of int
        Pixels ``(ny, nx)`` of the map.
    periodic : bool, "x" or "y"
        Whether the map repeats, or along which axis; across it is padded by zeros to twice its
        side. Along one axis scipy transforms, also if `fast`.
    threads : int
        Threads of the transforms.
    fast : bool
        Use ducc0, which must then be installed.
    scale : callable
        In-place product of spectrum and symbol.
    spectrum : ndarray, optional
        Where to work: complex, of the shape `spectrum_shape`.

    Examples
    --------
    >>> transform = make_transform(np.ones((4, 3)), (4, 4), periodic=True)
    >>> source, target = np.arange(16.0).reshape(4, 4), np.zeros((4, 4))
    >>> transform(source, target)
    >>> bool(np.allclose(source, target))
    True
    """
    padded = shape[0] * shape[1] * (1 if periodic is True else 2 if periodic else 4)
    symbol = symbol / padded  # once, instead of after every inverse transform
    if spectrum is None:
        kind = np.result_type(symbol.dtype, np.complex64)
        half = shape[0] * (1 if periodic in (True, "y") else 2), symbol.shape[1]
        spectrum = np.zeros(spectrum_shape(half, symbol.dtype, periodic, fast), kind)
    spectrum = spectrum[:, : symbol.shape[1]]
    if isinstance(periodic, str):
        return _scipy_transform(symbol, periodic == "x", threads, scale, spectrum)
    if fast and not periodic:
        return _ducc_free(symbol, threads, scale, spectrum, shape)
    if fast:
        collides = symbol.dtype.itemsize == 4 and shape[1] * 4 % PITCH == 0  # in double: no gain
        transform = _ducc_pitched if collides else _ducc_periodic
        return transform(symbol, threads, scale, spectrum, shape[1])
    return _scipy_transform(symbol, periodic, threads, scale, spectrum)


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
