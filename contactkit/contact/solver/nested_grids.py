"""Nested grids of the contact solver: operators and preconditioners, independent of the heights.

Sign convention: pressure and displacement positive into the solid.
"""

from __future__ import annotations

import importlib.util
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...numerics.fft import Edges, fast_transforms_installed, mirrored_half
from . import loops_numpy
from .cell_inverse import CellInverse
from .convolution import (
    Convolution,
    Patch,
    SymbolMaker,
    Transforms,
    self_influence,
    symbol_of,
    symbol_width,
)
from .idle_memory import IdleMemory
from .sparse_inverse import SparseInverse
from .transfer import block_shape, nested_shapes
from .two_level import CoarseBlocks, Stencil, TwoLevel, inverse_stencil
from .unit_response import UnitResponse, unit_response

__all__ = ["GridLevel", "NestedGrids", "bytes_of", "compiled_loops", "prepare"]

Floats = NDArray[np.float64]
Singles = NDArray[np.float32]
Shape = tuple[int, int]
# Measurements are those of the room (`contact.solver`), on 256 x 256 pixels.
LEAST_THREADED = 200  # pixels along the shorter side from which threads are faster
# Pixels along the longer side from which long waves are treated by blocks: without them 5 % more
# applications (49 in place of 34 under a coating of three times the modulus); from 64 on as many.
LEAST_BLOCKED = 128
# Decay of the symbol, over that of a half-space, that asks for smaller blocks, more neighbours and
# `FEW_STEEP`: 1.1 to 3 take the same, as few contacts are between.
STEEP = 1.4
# Decay from which stencil and blocks fail, as under a stiff plate: 3 takes 24 applications in place
# of 22 under a coating of thirty times the modulus, 20 as many.
PLATE = 8.0
# Stiffening from which the active set is projected, not truncated: at 10 films of ten times the
# modulus take 44 to 47 applications in place of 25. At 2.5 all take 5 % fewer, an isolated one of
# three times the modulus 21 in place of 41, but each of these comes with a projection.
STIFF = 6.0
LAYERED = 1.5  # stiffening from which only the metric, which knows the seam, suits a strip
# Stiffening from which more neighbours in double precision are worth their cost: without them 43
# and 60 applications in place of 32 and 37 at 3000 and 100 000 times the modulus; from 200 on
# alike.
STIFFEST = 2000.0
# Decay of a half-space under uniform pressure on each pixel, where it is not periodic: 0.847 on 128
# pixels along a side, 0.850 on 256.
PIXEL_DECAY = 0.84
# Free pixels up to which the better preconditioner is also the cheaper one: with 500 all take 2 %
# more applications, a light contact 31 in place of 26, on 128 x 128 pixels 7 %.
FEW = 4000
# The same as a fraction of all pixels if the symbol is steep, where the other preconditioner is
# poor: a hard film of a thousandth of the window took 52 applications with `FEW`, 32 with this, of
# 512 x 512 pixels with 5 % in contact. With 0.03 all take 4 % more on 128 x 128 pixels.
FEW_STEEP = 0.15


def compiled_loops(fast: bool | None, threads: int) -> Any:
    """Loops over the pixels: compiled by numba if installed and not refused, else in numpy.

    Raises
    ------
    ImportError
        If `fast` insists on numba and it is not installed.

    Examples
    --------
    >>> compiled_loops(False, 1).__name__.endswith("loops_numpy")
    True
    """
    if fast or (fast is None and importlib.util.find_spec("numba") is not None):
        from .loops_numba import compiled

        return compiled(threads > 1)
    return loops_numpy


class GridLevel(NamedTuple):
    """One of the nested grids: its operators, preconditioners and work arrays.

    pressure, gap : maps in double precision
    exact : operator in double precision from `pressure` to `gap`; none on coarse grids
    quick : operator in single precision; its source is zero between uses, and has a frame that the
        stencil uses as well
    patch : the same around the free pixels of an isolated contact; none if periodic
    response : gives the displacement under unit pressure on the first pixel; to the middle if
        periodic
    change : displacement added since the last exact one, in single precision
    inverse : sparse approximate inverse of the operator between the free pixels
    metric : the inverse in whose metric pressures are projected onto their bounds
    is_stiff : whether they are from the start, under a stiff film; `inverse` is `metric` then
        and in strips of layers
    two_level : cheaper one for more than `few` of them; none where it is poor, under stiff plates
    steepest : largest eigenvalue of the operator
    uniform : displacement of a periodic map under uniform unit pressure
    loops : loops over the pixels, of numpy or compiled
    room, lent : memory that coarser grids share, and transforms in single precision
    """

    pressure: NDArray[np.float64]
    gap: NDArray[np.float64]
    exact: Convolution | None
    quick: Convolution
    patch: Patch | None
    response: UnitResponse
    change: Singles
    inverse: SparseInverse | CellInverse
    two_level: TwoLevel | None
    metric: CellInverse
    is_stiff: bool
    few: int
    periodic: bool
    steepest: float
    uniform: float
    loops: Any
    room: IdleMemory
    lent: NDArray[Any]

    def reset(self) -> None:
        """Reset the counters, and the maps that a coarse grid has in the memory of the finest."""
        self.quick.count = 0
        if self.exact is None:
            self.quick.memory[...] = 0.0
        if self.patch is not None:
            self.patch.count = 0
        if self.exact is not None:
            self.exact.count = 0
        if self.two_level is not None and self.two_level.blocks is not None:
            self.two_level.blocks.operator.count = 0

    def applications(self) -> int:
        """Applications of the operator, on the whole map or on a patch of it, since `reset`."""
        exact = self.exact.count if self.exact is not None else 0
        return self.quick.count + exact + (self.patch.count if self.patch is not None else 0)

    def preconditioner(self, n_free: int) -> SparseInverse | CellInverse | TwoLevel:
        """The cheaper preconditioner for a number of free pixels."""
        if self.two_level is None or n_free <= self.few:
            return self.inverse
        return self.two_level

    def displace(self, exactly: bool) -> None:
        """Displacement under `pressure`, into `gap`."""
        if exactly and self.exact is not None:
            self.exact.run()
            return
        # A uniform part displaces uniformly if periodic, but would drown the rest in round-off.
        uniform = float(self.pressure.mean()) if self.periodic else 0.0
        np.subtract(self.pressure, uniform, out=self.quick.source, casting="same_kind")
        self.gap[...] = self.quick.run()
        if self.uniform:
            np.add(self.gap, self.uniform * uniform, out=self.gap)
        self.quick.source[...] = 0.0


class NestedGrids(NamedTuple):
    """Grids from the finest to the coarsest, and the self influence of a finest pixel [m/Pa]."""

    grids: list[GridLevel]
    self_influence: float


class _Symbols:
    """Symbols of any grid on the same window, in units of the finest grid's self influence."""

    def __init__(
        self,
        shape: Shape,
        pixel_size: tuple[float, float],
        make_symbol: SymbolMaker,
        periodic: Edges,
    ) -> None:
        self.window = (shape[0] * pixel_size[0], shape[1] * pixel_size[1])
        self.make, self.periodic = make_symbol, periodic
        self.unit, self._made = 1.0, dict[Shape, Floats]()
        first = self(shape)
        self.unit = self.own(first, shape)
        first /= self.unit
        self._made[shape] = first  # kept for the grid that needs it

    def pixel(self, shape: Shape) -> tuple[float, float]:
        return self.window[0] / shape[0], self.window[1] / shape[1]

    def own(self, symbol: Floats, shape: Shape) -> float:
        return self_influence(symbol, symbol_width(shape[1], self.periodic))

    def __call__(self, shape: Shape) -> Floats:
        if shape in self._made:
            return self._made.pop(shape)
        symbol = symbol_of(self.make, shape, self.pixel(shape), self.periodic)
        symbol /= self.unit
        return symbol


def _decay(symbol: Floats, periodic: Edges) -> float:
    """Decay of the symbol over the three shortest octaves, over that of a half-space, 1 / q."""
    column = symbol[:, 0] if periodic in (True, "y") else symbol[::2, 0]
    top = max(column.size // 2, 1)
    low = max(top // 8, 1)
    return float(column[low] / max(column[top], 1e-300)) * low / top


def _stiffening(symbol: Floats, periodic: Edges) -> float:
    """Stiffness ratio of the shortest wave to the most compliant one."""
    column = symbol[:, 0] if periodic in (True, "y") else symbol[::2, 0]
    compliance = column[: column.size // 2 + 1] * np.arange(column.size // 2 + 1)
    return float(compliance.max() / max(compliance[-1], 1e-300))


class _Operator(NamedTuple):
    """What a grid takes of its symbol, which is dropped: of a padded map it is two maps large.

    half : rows of the symbol that the others mirror
    response : see `unit_response`; own : self influence; steepest : largest eigenvalue
    decay, stiffening : of the symbol, over those of a half-space
    uniform : displacement of a periodic map under uniform unit pressure
    stencil, block : of `TwoLevel`, pixels along the sides of a block; none where that is poor
    """

    half: Floats
    response: Floats
    own: float
    steepest: float
    decay: float
    stiffening: float
    uniform: float
    stencil: Stencil | None
    block: float


def _operator(symbols: _Symbols, shape: Shape) -> _Operator:
    # A window that repeats along one axis is isolated to all preconditioners but the metric.
    symbol, edges = symbols(shape), symbols.periodic
    half, of_pixels = mirrored_half(symbol), 1.0 if edges is True else PIXEL_DECAY
    falls = _decay(symbol, edges)
    decay, stiffening = falls / of_pixels, _stiffening(symbol, edges) / of_pixels
    is_poor = decay > PLATE or stiffening > STIFF
    return _Operator(
        half=half if half is symbol else half.copy(),
        response=unit_response(half, shape, edges),
        own=symbols.own(symbol, shape),
        steepest=float(symbol.max()),
        decay=decay,
        stiffening=stiffening,
        uniform=float(symbol[0, 0]) if edges is True else 0.0,
        stencil=None if is_poor else inverse_stencil(symbol, symbol_width(shape[1], edges)),
        block=4.0 if falls > STEEP else 8.0,
    )


def _two_level(
    symbols: _Symbols,
    shape: Shape,
    of: _Operator,
    transforms: Transforms,
    loops: Any,
    framed: Singles,
) -> TwoLevel | None:
    if of.stencil is None:
        return None
    blocks, edges = None, symbols.periodic
    if max(shape) >= LEAST_BLOCKED:
        sides = block_shape(shape, symbols.pixel(shape), of.block)
        if min(sides) < LEAST_THREADED:
            transforms = transforms._replace(threads=1)
        blocks = CoarseBlocks(shape, sides, symbols(sides), edges, loops, transforms, of.own)
    return TwoLevel(shape, edges is True, of.stencil, blocks, loops, framed)


class _Maps(NamedTuple):
    """Maps of a grid, in the memory of others where these are idle.

    Coarser grids, which only provide the first guess, are in the gap of the finest (`room`).
    Transforms in single precision are in the spectrum of the exact one (`lent`), and so is the
    change of the displacement, beside them: all are done with once the exact one runs again.
    """

    pressure: Floats
    gap: Floats
    framed: Singles
    change: Singles
    room: IdleMemory
    lent: NDArray[Any]


def _maps(shape: Shape, exact: Convolution | None, finest: GridLevel | None) -> _Maps:
    single, with_frame, size = np.float32, (shape[0] + 2, shape[1] + 2), shape[0] * shape[1]
    if finest is not None:
        room, change = finest.room, finest.change[:size]
        pressure, gap = room.take(shape, np.float64), room.take(shape, np.float64)
        return _Maps(pressure, gap, room.take(with_frame, single), change, room, finest.lent)
    assert exact is not None
    idle = IdleMemory(exact.spectrum)
    change = idle.take((size,), single)
    framed, room = np.zeros(with_frame, single), IdleMemory(exact.target)
    return _Maps(exact.source, exact.target, framed, change, room, idle.left)


def _grid(
    symbols: _Symbols, shape: Shape, threads: int, fast: bool, loops: Any, finest: GridLevel | None
) -> GridLevel:
    of, edges, pixel = _operator(symbols, shape), symbols.periodic, symbols.pixel(shape)
    periodic = edges is True
    threads = threads if min(shape) >= LEAST_THREADED else 1
    transforms = Transforms(threads, fast, loops.scale_spectrum)
    exact = Convolution(shape, of.half, edges, transforms) if finest is None else None
    maps, response = _maps(shape, exact, finest), _kept(of.response, exact, edges)
    idle = IdleMemory(maps.lent)
    both = maps.framed, idle.take(shape, np.float32)
    reach, kind = (2, np.float64) if of.stiffening > STIFFEST else (1, np.float32)
    metric = CellInverse(response, shape, pixel, edges, loops, reach, kind)
    is_stiff, is_steep = of.stiffening > STIFF, of.decay > STEEP
    inverse: SparseInverse | CellInverse = metric
    if not is_stiff and (isinstance(edges, bool) or of.stiffening <= LAYERED):
        inverse = SparseInverse(of.response, shape, pixel, periodic, is_steep, loops, maps.framed)
    return GridLevel(
        pressure=maps.pressure,
        gap=maps.gap,
        exact=exact,
        quick=Convolution(shape, of.half, edges, transforms, np.float32, idle, both),
        patch=None if periodic else Patch(response, shape, transforms, maps.lent),
        response=response,
        change=maps.change,
        inverse=inverse,
        metric=metric,
        is_stiff=is_stiff,
        two_level=_two_level(symbols, shape, of, transforms, loops, maps.framed),
        few=int(FEW_STEEP * shape[0] * shape[1]) if is_steep else FEW,
        periodic=periodic,
        steepest=of.steepest,
        uniform=of.uniform,
        loops=loops,
        room=maps.room,
        lent=maps.lent,
    )


def _kept(response: Floats, exact: Convolution | None, edges: Edges) -> UnitResponse:
    """The response; of a large isolated map it is made again from the symbol when called for."""
    if exact is None or edges or len(exact.spectrum) > len(response):
        return UnitResponse(response)
    shape = response.shape
    return UnitResponse(lambda: unit_response(exact.symbol(), shape, False))


def prepare(
    shape: Shape,
    pixel_size: tuple[float, float],
    make_symbol: SymbolMaker,
    periodic: Edges,
    threads: int,
    fast: bool | None,
) -> NestedGrids:
    """Make the grids from the finest to the coarsest.

    Parameters
    ----------
    shape, pixel_size : tuple
        Pixels ``(ny, nx)`` and their sides ``(dy, dx)`` [m].
    make_symbol : callable
        ``make(shape, pixel_size)`` as in `convolution.symbol_of` [m/Pa].
    periodic : bool, "x" or "y"
        Whether the map repeats, or along which axis alone.
    threads : int
        Threads of transforms and loops; small grids take one.
    fast : bool or None
        Compiled loops and ducc0: required, refused, or used if installed (None).
    """
    symbols = _Symbols(shape, pixel_size, make_symbol, periodic)
    transforms = fast_transforms_installed() if fast is None else fast
    one, many = compiled_loops(fast, 1), compiled_loops(fast, threads)
    grids = list[GridLevel]()
    for s in nested_shapes(shape, pixel_size):
        loops = many if min(s) >= LEAST_THREADED else one
        grids.append(_grid(symbols, s, threads, transforms, loops, grids[0] if grids else None))
    return NestedGrids(grids, symbols.unit)


def bytes_of(grids: list[GridLevel]) -> int:
    """Memory that the grids hold."""
    total = 0
    for grid in grids:
        total += grid.quick.nbytes + (0 if grid.exact is None else grid.exact.nbytes)
        maps = () if grid.exact is not None else (grid.pressure, grid.gap)
        total += sum(one.nbytes for one in (*maps, grid.change) if one.base is None)
        total += 0 if grid.patch is None else grid.patch.nbytes
        total += grid.response.nbytes + grid.inverse.nbytes
        total += 0 if grid.inverse is grid.metric else grid.metric.nbytes
        total += 0 if grid.two_level is None else grid.two_level.nbytes
    return total
