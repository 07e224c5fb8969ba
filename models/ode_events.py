"""Events of scipy's solvers, and slopes by differences, for monolithic models."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

__all__ = ["crossing", "slopes_of", "watch"]

_Floats = NDArray[np.float64]
_Watch = Callable[[float, _Floats], float]


def slopes_of(
    rates: Callable[[float, _Floats], list[float]], sizes: Sequence[float]
) -> Callable[[float, _Floats], Any]:
    """Jacobian by differences along the unknowns that have a size; nothing depends on the others.

    The differences are a fraction of an unknown or, near zero, of its size; they go downwards
    where that is negative, and nothing depends on an unknown whose size is 0.
    """

    def jacobian(time: float, unknowns: _Floats) -> _Floats:
        n = len(unknowns)
        found, here = np.zeros((n, n)), np.array(rates(time, unknowns))
        for column, size in enumerate(sizes):
            if not size:
                continue
            moved = unknowns.copy()
            moved[column] += math.copysign(1e-7, size) * max(abs(moved[column]), abs(size))
            change = moved[column] - unknowns[column]
            found[:, column] = (np.array(rates(time, moved)) - here) / change
        return found

    return jacobian


def watch(function: _Watch, direction: int) -> Any:
    """Let scipy stop where a function passes zero in a direction."""
    made: Any = partial(function)
    made.terminal, made.direction = True, direction
    return made


def crossing(level: float, way: int) -> Any:
    """Let scipy stop where the first unknown passes a level."""
    return watch(lambda time, unknowns: float(unknowns[0]) - level, way)
