"""First guesses of many maps from coarser grids of the same window (nested iteration).

Sign convention: pressure, heights and displacement positive into the solid.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Sequence
from typing import Any

from ...numerics.fft import Edges
from ..solver.convolution import SymbolMaker
from ..solver.transfer import averaging_weights, nested_shapes
from .iterations import MapsIteration
from .namespace import Space
from .operator import MapOperator, map_operator
from .problem import MapsProblem, restricted

__all__ = ["nested_operators", "solve_nested"]

COARSEST = 32  # pixels along a side that are not coarsened further
COARSE_RTOL = 2e-2  # as of `ContactSolver`
COARSE_ITERATIONS = 100  # rough half-spaces take 10 to 20; a stiff film gains nothing by more


def nested_operators(
    space: Space,
    make_symbol: SymbolMaker,
    shape: tuple[int, int],
    pixel_size: tuple[float, float],
    periodic: Edges,
) -> list[MapOperator]:
    """Operators of the nested grids, finest first, in units of the self influence of the finest."""
    operators: list[MapOperator] = []
    sides = [n * d for n, d in zip(shape, pixel_size, strict=True)]
    for one in nested_shapes(shape, pixel_size, COARSEST):
        pixel = (sides[0] / one[0], sides[1] / one[1])
        unit = operators[0].self_influence if operators else None
        operators.append(map_operator(space, make_symbol, one, pixel, periodic, unit))
    return operators


def solve_nested(
    space: Space,
    operators: Sequence[MapOperator],
    problem: MapsProblem,
    rtol: float,
    max_iterations: int,
) -> MapsIteration:
    """Solve roughly on ever finer grids, then to the tolerance on the finest."""
    problems, transfers = [problem], list[Transfer]()
    for fine, coarse in itertools.pairwise(operators):
        transfers.append(Transfer(space, fine.shape, coarse.shape))
        pixels = fine.shape[0] * fine.shape[1], coarse.shape[0] * coarse.shape[1]
        problems.append(restricted(problems[-1], transfers[-1].average, *pixels))
    start = _first_guess(space, operators[-1], problems[-1])
    for level in range(len(operators) - 1, 0, -1):
        found = MapsIteration(space, operators[level], problems[level], start, COARSE_RTOL)
        found.run(COARSE_ITERATIONS)
        start = transfers[level - 1].spread(found.pressure)
    done = MapsIteration(space, operators[0], problem, start, rtol)
    done.run(max_iterations)
    return done


def _first_guess(space: Space, operator: MapOperator, problem: MapsProblem) -> Any:
    """Uniform pressures under a load; under an approach a bed of springs of least energy."""
    xp, h = space.xp, problem.heights
    if problem.load is not None:
        pixels = operator.shape[0] * operator.shape[1]
        return xp.zeros_like(h) + problem.load / pixels
    depth = h + problem.approach
    p = xp.maximum(depth, xp.zeros_like(h))
    work = space.total(p * operator.displace(p))
    return p * (space.total(p * depth) / xp.where(work > 0.0, work, xp.ones_like(work)))


class Transfer:
    """Averages of maps over the pixels of a coarser grid, and back.

    Parameters
    ----------
    space : Space
        Of the maps.
    fine, coarse : tuple of int
        Pixels of both grids.

    Examples
    --------
    >>> import numpy as np
    >>> from .namespace import space_of
    >>> maps = np.array([[[1.0, 3.0, 5.0, 7.0]] * 2])
    >>> pair = Transfer(space_of(maps), (2, 4), (1, 2))
    >>> pair.average(maps), pair.spread(pair.average(maps))[0, 0]
    (array([[[2., 6.]]]), array([2., 2., 6., 6.]))
    """

    def __init__(self, space: Space, fine: tuple[int, int], coarse: tuple[int, int]) -> None:
        self.average: Callable[[Any], Any]
        self.spread: Callable[[Any], Any]
        xp, (ny, nx), (cy, cx) = space.xp, fine, coarse
        if (ny, nx) == (2 * cy, 2 * cx):

            def average(maps: Any) -> Any:
                blocks = xp.reshape(maps, (maps.shape[0], cy, 2, cx, 2))
                return xp.mean(blocks, axis=(-3, -1))

            def spread(maps: Any) -> Any:
                wide = xp.zeros((1, 1, 2, 1, 2), dtype=space.dtype, device=space.device)
                blocks = xp.reshape(maps, (maps.shape[0], cy, 1, cx, 1)) + wide
                return xp.reshape(blocks, (maps.shape[0], ny, nx))

            self.average, self.spread = average, spread
            return
        rows, columns = averaging_weights(ny, cy).toarray(), averaging_weights(nx, cx).toarray()
        down = space.take(rows), space.take(columns.T)
        up = space.take(rows.T * (ny / cy)), space.take(columns * (nx / cx))
        self.average = lambda maps: xp.matmul(xp.matmul(down[0], maps), down[1])
        self.spread = lambda maps: xp.matmul(xp.matmul(up[0], maps), up[1])
