"""Points of curves between which straight lines are right to a stated error."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

__all__ = ["with_middles"]

# Of the largest value of a curve: its round-off. A constant with noise of 1e-14 takes no point
# more; with 1e-15 it takes 385 000, as the noise is all of its range.
_SMALLEST = 1e-12
# Of the whole, in which a jump is drawn: each tenfold costs 6 points a jump, and 1e-6 is far below
# a pixel of any figure.
_JUMP = 1e-6


def with_middles(places: Floats, table: Callable[[Floats], Floats], rtol: float) -> Floats:
    """Add middles to the places of some curves until straight lines between them are right.

    Parameters
    ----------
    places : ndarray
        Ascending places to begin with.
    table : callable
        Curves at some ascending places, a column for each.
    rtol : float
        Error of the lines, relative to the range of each curve [-].

    Examples
    --------
    >>> found = with_middles(np.array([0.0, 1.0]), lambda x: x[:, None] ** 2, 1e-2)
    >>> found.tolist()
    [0.0, 0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875, 1.0]
    """
    shortest = _JUMP * (places[-1] - places[0])
    is_open = np.diff(places) > shortest
    while is_open.any():  # ends: every pass halves the open intervals, or closes them
        at = np.flatnonzero(is_open)
        middles = 0.5 * (places[at] + places[at + 1])
        values = table(np.insert(places, at + 1, middles))
        index = at + 1 + np.arange(len(at))  # of the middles among all
        miss = np.abs(values[index] - 0.5 * (values[index - 1] + values[index + 1]))
        allowed = np.maximum(rtol * np.ptp(values, axis=0), _SMALLEST * np.abs(values).max(axis=0))
        bad = (miss > allowed).any(axis=1)
        places = np.insert(places, at[bad] + 1, middles[bad])
        is_open = np.zeros(len(places) - 1, dtype=bool)
        halves = at[bad] + np.arange(int(bad.sum()))
        is_open[halves] = is_open[halves + 1] = True
        is_open &= np.diff(places) > shortest
    return places
