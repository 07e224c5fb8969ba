"""Events of scipy's solvers, and slopes by differences, for monolithic models."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

__all__ = ["crossing", "slopes_of", "watch"]

_Floats = NDArray[np.float64]
_Watch = Callable[[float, _Floats], float]


def slopes_of(rates: Callable[[float, _Floats], list[float]]) -> Callable[[float, _Floats], Any]:
    """Jacobian of a spool by differences; nothing depends on its two quadratures."""

    def jacobian(time: float, unknowns: _Floats) -> _Floats:
        found, here = np.zeros((5, 5)), np.array(rates(time, unknowns))
        for column, size in enumerate((1.0, 1e-6, 1e-3)):
            moved = unknowns.copy()
            moved[column] += 1e-7 * max(abs(moved[column]), size)
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
