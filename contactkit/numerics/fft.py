"""Real two-dimensional transforms behind one small interface: scipy.fft always, ducc0 if installed.

A back end multiplies the spectrum of a map by a real symbol and transforms back. The free case
never stores the zero rows of the padded map: rows are padded and transformed first, then columns.
Signs do not matter here: the symbols are real and even.
"""

from __future__ import annotations

import importlib
import importlib.util
from collections.abc import Callable
from typing import Any

import numpy as np
import scipy.fft
from numpy.typing import NDArray

__all__ = ["Transform", "fast_transforms_installed", "make_transform", "scale_spectrum"]

Array = NDArray[Any]
Transform = Callable[[Array, Array], None]
Scale = Callable[[Array, Array], None]

CHUNK_BYTES = 2**20  # of rows transformed at a time by scipy
CACHED_BYTES = 12 * 2**20  # of a padded spectrum up to which ducc0 takes all columns at once
STRIP = 32  # columns that each thread of ducc0 takes at a time beyond it


def fast_transforms_installed() -> bool:
    """Whether ducc0 can be imported.

    Examples
    --------
    >>> fast_transforms_installed() in (True, False)
    True
    """
    return importlib.util.find_spec("ducc0") is not None


def scale_spectrum(spectrum: Array, symbol: Array) -> None:
    """Multiply a spectrum by a real symbol, in place.

    Examples
    --------
    >>> spectrum = np.array([1.0 + 2.0j])
    >>> scale_spectrum(spectrum, np.array([2.0]))
    >>> spectrum
    array([2.+4.j])
    """
    spectrum *= symbol


def _scipy_transform(
    symbol: Array, periodic: bool, workers: int, scale: Scale, spectrum: Array
) -> Transform:
    """Rows in chunks, so that what scipy allocates stays in the cache; columns in place."""

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


def _ducc_periodic(symbol: Array, threads: int, scale: Scale, spectrum: Array) -> Transform:
    fft: Any = importlib.import_module("ducc0").fft
    forth = {"axes": (0, 1), "nthreads": threads}
    back = {**forth, "forward": False, "allow_overwriting_input": True}

    def transform(source: Array, target: Array) -> None:
        fft.r2c(source, out=spectrum, **forth)
        scale(spectrum, symbol)
        fft.c2r(spectrum, lastsize=source.shape[1], out=target, **back)

    return transform


def _ducc_free(symbol: Array, threads: int, scale: Scale, spectrum: Array) -> Transform:
    """Rows, then columns: all at once, or if they exceed the cache a strip of them forth and back.

    What a strip copies costs more than it saves on small maps.
    """
    fft: Any = importlib.import_module("ducc0").fft
    ny, nx = symbol.shape[0] // 2, symbol.shape[1] - 1
    top, rows = spectrum[:ny], np.zeros((ny, 2 * nx), symbol.dtype)
    width = nx + 1 if spectrum.nbytes <= CACHED_BYTES else STRIP * threads
    parts = [slice(i, min(i + width, nx + 1)) for i in range(0, nx + 1, width)]
    symbols = [np.ascontiguousarray(symbol[:, part]) for part in parts]
    strip = spectrum if len(parts) == 1 else np.zeros((2 * ny, width), spectrum.dtype)

    def columns(part: slice, strip: Array, symbol: Array) -> None:
        if strip is not spectrum:
            strip[:ny] = top[:, part]
        strip[ny:] = 0.0
        fft.c2c(strip, axes=(0,), out=strip, nthreads=threads)
        scale(strip, symbol)
        fft.c2c(strip, axes=(0,), forward=False, out=strip, nthreads=threads)
        if strip is not spectrum:
            top[:, part] = strip[:ny]

    def transform(source: Array, target: Array) -> None:
        rows[:, :nx] = source
        rows[:, nx:] = 0.0
        fft.r2c(rows, axes=(1,), out=top, nthreads=threads)
        for part, s in zip(parts, symbols, strict=True):
            last = part.stop - part.start
            columns(part, strip if last == strip.shape[1] else strip[:, :last], s)
        fft.c2r(top, axes=(1,), lastsize=2 * nx, forward=False, out=rows, nthreads=threads)
        target[...] = rows[:, :nx]

    return transform


def make_transform(
    symbol: Array,
    shape: tuple[int, int],
    periodic: bool,
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
        doubled map, ``(2 ny, nx + 1)``. Its dtype is the precision of the transforms.
    shape : tuple of int
        Pixels ``(ny, nx)`` of the map.
    periodic : bool
        Whether the map repeats; otherwise it is padded by zeros to twice its sides.
    threads : int
        Threads of the transforms.
    fast : bool
        Use ducc0, which must then be installed.
    scale : callable
        In-place product of spectrum and symbol.
    spectrum : ndarray, optional
        Where to work, of the shape of the symbol and complex.

    Examples
    --------
    >>> transform = make_transform(np.ones((4, 3)), (4, 4), periodic=True)
    >>> source, target = np.arange(16.0).reshape(4, 4), np.zeros((4, 4))
    >>> transform(source, target)
    >>> bool(np.allclose(source, target))
    True
    """
    padded = shape[0] * shape[1] * (1 if periodic else 4)
    symbol = symbol / padded  # once, instead of after every inverse transform
    if spectrum is None:
        spectrum = np.zeros(symbol.shape, np.result_type(symbol.dtype, np.complex64))
    if fast:
        transform = _ducc_periodic if periodic else _ducc_free
        return transform(symbol, threads, scale, spectrum)
    return _scipy_transform(symbol, periodic, threads, scale, spectrum)
