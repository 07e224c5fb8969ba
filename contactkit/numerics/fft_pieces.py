"""Convolution of a map piece by piece: a few rows, then a strip of columns, at a time.

Rows are padded and transformed, columns transformed forth and back while they are in the cache, and
the rows transformed back: the zero rows of a padded map are never stored, nor transformed along x.
Each thread takes whole pieces, copies of them included, so that the result is the same to the last
bit on any number of threads.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from contextlib import AbstractContextManager, contextmanager, nullcontext
from queue import SimpleQueue
from typing import Any, NamedTuple

import numpy as np
import scipy.fft
from numpy.typing import NDArray

__all__ = [
    "Lines",
    "PiecewiseConvolution",
    "by_ducc",
    "by_scipy",
    "collides",
    "in_threads",
    "scaled",
]

Array = NDArray[Any]
Scale = Callable[[Array, Array], None]
Each = Callable[[Callable[[Any], None], Iterable[Any]], None]

# These balance the calls of many small pieces against what spills from the cache; none changes a
# result. Times below: free maps of 1024 x 1024 on one thread of a shared server, to 10 %.

# Of rows that each thread takes at a time: no trend from 2**14 to 2**20, 1.15 times the time at
# 2**22.
ROWS_BYTES = 2**18
# Bytes between rows whose first elements share a cache set (32 KiB in 8 ways). On processors with
# such a cache the collisions of rows that a transform takes together cost half of the time: they
# are copied to rows that are a little longer. In double precision nothing is gained.
PITCH = 4096
LINE = 64  # bytes by which copied rows are made longer than a power of two: a cache line
STRIP = 32


class Lines(NamedTuple):
    """Transforms along the lines of an array by one library, with a number of threads.

    forth : half spectra of rows, into an array
    columns : of columns, forth or back, in place; returned
    back : rows of half spectra, into an array if the library can; returned
    """

    forth: Callable[[Array, Array, int], None]
    columns: Callable[[Array, bool, int], Array]
    back: Callable[[Array, Array, int], Array]


def by_scipy() -> Lines:
    """Transforms of scipy, which brings arrays of its own.

    Examples
    --------
    >>> by_scipy().columns(np.array([[1.0 + 0j], [1.0]]), True, 1).ravel()
    array([2.+0.j, 0.+0.j])
    """

    def forth(rows: Array, out: Array, threads: int) -> None:
        out[...] = scipy.fft.rfft(rows, axis=1, workers=threads)

    def columns(waves: Array, forward: bool, threads: int) -> Array:
        given: dict[str, Any] = {"axis": 0, "overwrite_x": True, "workers": threads}
        if forward:
            return np.asarray(scipy.fft.fft(waves, **given))
        return np.asarray(scipy.fft.ifft(waves, norm="forward", **given))

    def back(waves: Array, out: Array, threads: int) -> Array:
        made = scipy.fft.irfft(waves, out.shape[1], axis=1, norm="forward", workers=threads)
        return np.asarray(made)

    return Lines(forth, columns, back)


def by_ducc(fft: Any) -> Lines:
    """Transforms of ducc0, by its module ``fft``."""

    def forth(rows: Array, out: Array, threads: int) -> None:
        fft.r2c(rows, axes=(1,), out=out, nthreads=threads)

    def columns(waves: Array, forward: bool, threads: int) -> Array:
        made: Array = fft.c2c(waves, axes=(0,), forward=forward, out=waves, nthreads=threads)
        return made

    def back(waves: Array, out: Array, threads: int) -> Array:
        given = {"axes": (1,), "lastsize": out.shape[1], "forward": False, "nthreads": threads}
        made: Array = fft.c2r(waves, out=out, **given)
        return made

    return Lines(forth, columns, back)


def collides(width: int, kind: Any) -> bool:
    """Whether rows of so many numbers are copied to longer ones; see `PITCH`.

    Examples
    --------
    >>> collides(2048, np.float32), collides(2048, np.float64), collides(1000, np.float32)
    (True, False, False)
    """
    size = np.dtype(kind).itemsize
    return bool(size == 4 and width * size % PITCH == 0)


def scaled(symbol: Array, padded: tuple[int, int], kind: Any) -> Array:
    """A symbol over the number of padded pixels, once, instead of after every inverse transform.

    Examples
    --------
    >>> scaled(np.array([8.0]), (2, 2), np.float32)
    array([2.], dtype=float32)
    """
    return np.divide(symbol, padded[0] * padded[1], dtype=kind, casting="same_kind", order="C")


def in_threads(threads: int) -> AbstractContextManager[Each]:
    """Give ``each(function, pieces)`` within a ``with``: all pieces are done by some threads.

    These are started for each convolution, which takes a hundred times as long: threads that were
    kept would be missing in processes that are forked.

    Examples
    --------
    >>> with in_threads(2) as each:
    ...     each(print, ["piece"])
    piece
    """
    return _pool(threads) if threads > 1 else _ALONE


@contextmanager
def _pool(threads: int) -> Iterator[Each]:
    from concurrent.futures import ThreadPoolExecutor

    with ThreadPoolExecutor(threads) as pool:

        def each(work: Callable[[Any], None], pieces: Iterable[Any]) -> None:
            for _ in pool.map(work, pieces):  # which raises what a piece raised
                pass

        yield each


def _one_by_one(work: Callable[[Any], None], pieces: Iterable[Any]) -> None:
    for piece in pieces:
        work(piece)


_ALONE = nullcontext(_one_by_one)


def _parts(size: int, step: int) -> list[slice]:
    return [slice(i, min(i + step, size)) for i in range(0, size, step)]


class PiecewiseConvolution:
    """``convolve(source, target)`` of maps with a symbol, piece by piece.

    Parameters
    ----------
    symbol : ndarray
        Real symbol on the half spectrum of the padded map, or the half of it that the rest mirrors.
    shape, padded : tuple of int
        Pixels ``(ny, nx)`` of the map, and with the zeros that keep its images apart.
    spectrum : ndarray
        Where to work: complex rows of ``nx // 2 + 1`` waves of the padded map. With all of its rows
        the columns are transformed there, all at once; else in strips.
    lines : Lines
        Transforms.
    scale : callable
        In-place product of a spectrum and a symbol; run by several threads at once.
    threads : int
        Threads.
    in_strips : bool
        Whether columns are taken in strips, of a spectrum without the rows of zeros. Else it has
        them, and all columns are transformed there at once, by the threads of the library.

    Examples
    --------
    >>> def scale(waves, symbol):
    ...     waves *= symbol
    >>> symbol, spectrum = np.full((4, 3), 2.0), np.zeros((4, 3), complex)
    >>> convolve = PiecewiseConvolution(symbol, (4, 4), (4, 4), spectrum, by_scipy(), scale)
    >>> source, target = np.eye(4), np.zeros((4, 4))
    >>> convolve(source, target)
    >>> bool(np.allclose(target, 2.0 * source))
    True
    """

    def __init__(
        self,
        symbol: Array,
        shape: tuple[int, int],
        padded: tuple[int, int],
        spectrum: Array,
        lines: Lines,
        scale: Scale,
        threads: int = 1,
        in_strips: bool = True,
    ) -> None:
        (self.ny, self.nx), (height, self.width) = shape, padded
        self.spectrum, self.lines, self.scale = spectrum, lines, scale
        self.in_strips, self.crew = in_strips, threads if in_strips else 1
        self.threads = 1 if in_strips else threads  # of the library
        kind, size = spectrum.real.dtype, spectrum.real.dtype.itemsize
        self.is_direct = self.width == self.nx and not collides(self.width, kind)
        count = min(self.ny, max(8, ROWS_BYTES // (self.width * size)) * self.threads)
        self.rows = _parts(self.ny, count)
        self.n_padded = height * self.width
        self.is_bare = height == self.ny
        self.strips = _parts(symbol.shape[1], STRIP if in_strips else symbol.shape[1])
        self.numbers = range(len(self.strips))
        self.symbols = [scaled(symbol[:, strip], padded, kind) for strip in self.strips]
        # Room of each thread, for some rows and for a strip.
        self.some: SimpleQueue[Array] = SimpleQueue()
        self.strip: SimpleQueue[Array] = SimpleQueue()
        for _ in range(self.crew):
            if not self.is_direct:
                self.some.put(np.zeros((count, self.width + LINE // size), kind)[:, : self.width])
            if in_strips and not self.is_bare:
                self.strip.put(np.zeros(height * STRIP, spectrum.dtype))

    def symbol(self) -> Array:
        """The symbol as a new array, in the precision of the transforms."""
        return np.asarray(np.hstack(self.symbols) * self.n_padded)

    def __call__(self, source: Array, target: Array) -> None:
        """Convolve a map into another, which may be the same."""
        with in_threads(self.crew) as each:
            each(lambda piece: self._forth(source[piece], self.spectrum[piece]), self.rows)
            each(self._columns if self.is_bare or not self.in_strips else self._strip, self.numbers)
            each(lambda piece: self._back(self.spectrum[piece], target[piece]), self.rows)

    def _forth(self, source: Array, waves: Array) -> None:
        if self.is_direct:
            self.lines.forth(source, waves, self.threads)
            return
        some = self.some.get()
        rows = some[: len(source)]
        rows[:, : self.nx] = source
        rows[:, self.nx :] = 0.0
        self.lines.forth(rows, waves, self.threads)
        self.some.put(some)

    def _back(self, waves: Array, target: Array) -> None:
        if self.is_direct:
            made = self.lines.back(waves, target, self.threads)
            if made is not target:
                target[...] = made
            return
        some = self.some.get()
        target[...] = self.lines.back(waves, some[: len(target)], self.threads)[:, : self.nx]
        self.some.put(some)

    def _columns(self, i: int) -> None:
        """Some columns, or all of them, where they are."""
        waves = self.spectrum[:, self.strips[i]]
        waves[self.ny :] = 0.0
        made = self._convolve(waves, self.symbols[i])
        if not np.may_share_memory(made, waves):  # as scipy is free to do
            waves[...] = made

    def _strip(self, i: int) -> None:
        """Some columns, in a copy of them with the zeros below."""
        there, room = self.spectrum[:, self.strips[i]], self.strip.get()
        width = there.shape[1]
        waves = room[: room.size // STRIP * width].reshape(-1, width)  # contiguous
        waves[: self.ny] = there
        waves[self.ny :] = 0.0
        there[...] = self._convolve(waves, self.symbols[i])[: self.ny]
        self.strip.put(room)

    def _convolve(self, waves: Array, symbol: Array) -> Array:
        waves = self.lines.columns(waves, True, self.threads)
        self.scale(waves, symbol)
        return self.lines.columns(waves, False, self.threads)
