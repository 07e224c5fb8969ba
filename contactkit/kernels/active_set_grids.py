"""Preparation of the nested grids: everything of a contact solve that the heights do not change.

Sign convention: pressure and displacement positive into the solid.
"""

from __future__ import annotations

import importlib.util
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import active_set_loops
from .active_set_inner import Grid
from .coarse_blocks import CoarseBlocks
from .convolve import Convolution, SymbolMaker, self_influence, symbol_of
from .fft_backends import fast_transforms_installed
from .grid_transfer import block_shape, nested_shapes
from .near_stencil import inverse_stencil

__all__ = ["bytes_of", "compiled_loops", "prepare"]

Floats = NDArray[np.float64]
Shape = tuple[int, int]
LEAST_BLOCKED = 128  # pixels along the longer side from which long waves are treated by blocks
LEAST_THREADED = 200  # pixels along the shorter side from which threads pay
STEEP = 1.4  # decay of the symbol, over that of a half-space, that asks for smaller blocks


def compiled_loops(fast: bool | None, threads: int) -> Any:
    """The passes over the pixels: compiled if numba is there and wanted, else those on numpy.

    Raises
    ------
    ImportError
        If `fast` insists on numba and it is not installed.

    Examples
    --------
    >>> compiled_loops(False, 1).__name__.endswith("active_set_loops")
    True
    """
    if fast or (fast is None and importlib.util.find_spec("numba") is not None):
        from .active_set_numba import compiled

        return compiled(threads > 1)
    return active_set_loops


class _Maker:
    """Symbols of any grid on the same window, in units of the finest grid's self influence."""

    def __init__(
        self, shape: Shape, pixel_size: tuple[float, float], make_symbol: SymbolMaker,
        periodic: bool,
    ) -> None:  # fmt: skip
        self.window = (shape[0] * pixel_size[0], shape[1] * pixel_size[1])
        self.make, self.periodic = make_symbol, periodic
        self.unit = 1.0
        self.unit = self.own(self(shape), shape)

    def pixel(self, shape: Shape) -> tuple[float, float]:
        return self.window[0] / shape[0], self.window[1] / shape[1]

    def own(self, symbol: Floats, shape: Shape) -> float:
        return self_influence(symbol, shape[1] if self.periodic else 2 * shape[1])

    def __call__(self, shape: Shape) -> Floats:
        symbol = symbol_of(self.make, shape, self.pixel(shape), self.periodic)
        symbol /= self.unit
        return symbol


def _block_pixels(symbol: Floats, periodic: bool) -> float:
    """Pixels along a block: fewer where the compliance falls faster than that of a half-space."""
    column = symbol[:, 0] if periodic else symbol[::2, 0]
    top = max(column.size // 2, 1)
    low = max(top // 8, 1)
    steep = float(column[low] / max(column[top], 1e-300)) > STEEP * top / low
    return 4.0 if steep else 8.0


def _blocks(maker: _Maker, shape: Shape, symbol: Floats, fast: bool) -> CoarseBlocks | None:
    if max(shape) < LEAST_BLOCKED:
        return None
    blocks = block_shape(shape, maker.pixel(shape), _block_pixels(symbol, maker.periodic))
    own = maker.own(symbol, shape)
    return CoarseBlocks(shape, blocks, maker(blocks), maker.periodic, fast, own)


def _response(operator: Convolution, periodic: bool) -> Floats:
    unit = np.zeros(operator.shape)
    unit[0, 0] = 1.0
    whole = operator(unit)
    if not periodic:
        return whole
    return whole[: operator.shape[0] // 2 + 1, : operator.shape[1] // 2 + 1].copy()


def _grid(maker: _Maker, shape: Shape, threads: int, fast: bool, loops: Any, finest: bool) -> Grid:
    symbol, periodic = maker(shape), maker.periodic
    threads = threads if min(shape) >= LEAST_THREADED else 1
    scale = loops.scale_spectrum
    exact = Convolution(shape, symbol, periodic, threads, fast, np.float64, scale)
    return Grid(
        pressure=exact.source if finest else np.zeros(shape),
        gap=exact.target if finest else np.zeros(shape),
        exact=exact if finest else None,
        quick=Convolution(shape, symbol, periodic, threads, fast, np.float32, scale),
        response=_response(exact, periodic),
        margin=np.zeros((shape[0] + 2, shape[1] + 2), np.float32),
        change=np.zeros(shape[0] * shape[1], np.float32),
        stencil=inverse_stencil(symbol, shape[1] if periodic else 2 * shape[1]),
        blocks=_blocks(maker, shape, symbol, fast),
        periodic=periodic,
        steepest=float(symbol.max()),
        loops=loops,
    )


def prepare(
    shape: Shape,
    pixel_size: tuple[float, float],
    make_symbol: SymbolMaker,
    periodic: bool,
    threads: int,
    fast: bool | None,
) -> tuple[list[Grid], float]:
    """Grids from the finest to the coarsest, and the self influence of a finest pixel [m/Pa].

    Parameters
    ----------
    shape, pixel_size : tuple
        Pixels ``(ny, nx)`` and their sides ``(dy, dx)`` [m].
    make_symbol : callable
        ``make(shape, pixel_size)`` as in `convolve.symbol_of` [m/Pa].
    periodic : bool
        Whether the map repeats.
    threads : int
        Threads of transforms and passes; small grids take one.
    fast : bool or None
        Compiled passes and ducc0: insist, refuse, or take what is installed.
    """
    maker = _Maker(shape, pixel_size, make_symbol, periodic)
    transforms = fast_transforms_installed() if fast is None else fast
    one, many = compiled_loops(fast, 1), compiled_loops(fast, threads)
    grids = [
        _grid(maker, s, threads, transforms, many if min(s) >= LEAST_THREADED else one, s == shape)
        for s in nested_shapes(shape, pixel_size)
    ]
    return grids, maker.unit


def bytes_of(grids: list[Grid]) -> int:
    """Memory that the grids hold."""
    total = 0
    for grid in grids:
        convolutions = [grid.quick]
        if grid.exact is not None:
            convolutions.append(grid.exact)
        else:
            total += 2 * grid.pressure.nbytes
        if grid.blocks is not None:
            convolutions.append(grid.blocks.operator)
        total += sum(c.nbytes for c in convolutions)
        total += grid.response.nbytes + grid.margin.nbytes + grid.change.nbytes
    return total
