"""Points of curves between which straight lines are right to a stated error."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

__all__ = ["SHARE", "errors_of_lines", "needed", "with_middles"]

SHARE = 0.9
"""Of an error, for what lines between the points leave out; the rest is for points left out."""

# Of the largest value of a curve: its round-off. A constant with noise of 1e-14 takes no point
# more; with 1e-15 it takes 385 000, as the noise is all of its range.
_SMALLEST = 1e-12
# Of the whole, in which a jump is drawn: each tenfold costs 6 points a jump, and 1e-6 is far below
# a pixel of any figure.
_JUMP = 1e-6


def errors_of_lines(values: Floats, rtol: float) -> Floats:
    """Error that lines of each curve may have: a part of its range, or the rounding of its values.

    Parameters
    ----------
    values : ndarray
        Curves, a column for each.
    rtol : float
        Error of the lines, relative to the range of each curve [-].
    """
    round_off = _SMALLEST * np.abs(values).max(axis=0)
    found: Floats = np.maximum(rtol * np.ptp(values, axis=0), round_off)
    return found


def with_middles(
    places: Floats,
    table: Callable[[Floats], Floats],
    rtol: float,
    allowed: Callable[[Floats], Floats] | None = None,
) -> Floats:
    """Add middles to the places of some curves until straight lines between them are right.

    Parameters
    ----------
    places : ndarray
        Ascending places to begin with; corners of the curves are among them, as a curve may meet
        its chord in the middle beside one.
    table : callable
        Curves at some ascending places, a column for each.
    rtol : float
        Error of the lines, relative to the range of each curve [-].
    allowed : callable, optional
        Error of the lines in place of that, at some rows of the table.

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
        limits = errors_of_lines(values, rtol) if allowed is None else allowed(values[index])
        bad = (miss > limits).any(axis=1)
        places = np.insert(places, at[bad] + 1, middles[bad])
        is_open = np.zeros(len(places) - 1, dtype=bool)
        halves = at[bad] + np.arange(int(bad.sum()))
        is_open[halves] = is_open[halves + 1] = True
        is_open &= np.diff(places) > shortest
    return places


def needed(table: Floats, allowed: Floats, marks: NDArray[np.intp]) -> NDArray[np.intp]:
    """Rows that lines cannot do without: each line is drawn as far as it goes.

    Parameters
    ----------
    table : ndarray
        Place and curves at each of some ascending places.
    allowed : ndarray
        Error of the lines at each place, a column for each curve.
    marks : ndarray
        Ascending indices of rows that stay.

    Examples
    --------
    >>> x = np.linspace(0.0, 1.0, 5)
    >>> corner = np.column_stack([x, np.abs(x - 0.5)])
    >>> needed(corner, np.full((5, 1), 1e-3), np.array([0])).tolist()
    [0, 2, 4]
    """
    last = len(table) - 1
    marks = np.append(marks, last)

    def fits(start: int, end: int) -> bool:
        if end <= start + 1:
            return True
        inside = slice(start + 1, end)
        part = (table[inside, 0] - table[start, 0]) / (table[end, 0] - table[start, 0])
        line = table[start, 1:] + part[:, None] * (table[end, 1:] - table[start, 1:])
        return bool((np.abs(table[inside, 1:] - line) <= allowed[inside]).all())

    chosen, here = [0], 0
    while here < last:
        end = int(marks[np.searchsorted(marks, here, side="right")])
        low, width = here + 1, 2
        while here + width <= end and fits(here, here + width):
            low, width = here + width, 2 * width
        high = min(here + width, end + 1)
        while high - low > 1:
            middle = (low + high) // 2
            low, high = (middle, high) if fits(here, middle) else (low, middle)
        chosen.append(low)
        here = low
    return np.array(chosen)
