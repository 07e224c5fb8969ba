"""Table of a force over the logarithms of gap and speed, for what calls it a thousand times."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np
from attrs import field, frozen

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[np.floating[Any]]

__all__ = ["LogTable", "log_table", "places"]

_DEGREE = 5  # of the splines
_GAPS, _SPEEDS = 5, 8
"""Points of a table in a decade of gap and of speed: quintics through them leave 2e-5 of Carreau's
law under a sphere and of Barus' law, 1e-5 of a sharp bend, 5e-4 at the kink of a power law."""
_ALONE = 10  # points in a decade of a table over the gap alone
_ONSET = 1e-4  # of the logarithm, below which it goes on as a power of the speed


@frozen(eq=False)
class LogTable:
    """A function of gap and speed that fades as a power of the speed towards rest.

    `unit` is a speed [m/s] at each gap, so that the function changes little along a fixed ratio of
    speed and unit. `reach` has the smallest and the largest gap [m], and ratio, of the table.
    """

    unit: Callable[[float], float]
    reach: tuple[tuple[float, float], tuple[float, float]]
    _spline: Any = field(repr=False)

    def __call__(self, gap: float, speed: float) -> float | None:
        """Value at a gap [m] and a speed [m/s], positive; None beyond the table."""
        (low, high), (least, most) = self.reach
        ratio = speed / self.unit(gap)
        if not (low <= gap <= high and ratio <= most):
            return None
        y, x = math.log(gap), math.log(max(ratio, least))
        value = float(self._spline(y, x, grid=False))
        if ratio >= least or value == 0.0:
            return value
        power = float(self._spline(y, x, dy=1, grid=False)) / value
        return float(value * (ratio / least) ** max(power, 0.0))


def log_table(
    function: Callable[[Array, Array], Array],
    unit: Callable[[float], float],
    gaps: tuple[float, float],
    ratios: tuple[float, float],
    *,
    fades: bool = True,
) -> LogTable:
    """Tabulate a function of gap and speed.

    Parameters
    ----------
    function : callable
        Values at arrays of gaps [m] and speeds [m/s] of one shape, finite.
    unit : callable
        Speed [m/s] at a gap, see `LogTable`.
    gaps : (float, float)
        Smallest and largest gap [m].
    ratios : (float, float)
        Smallest and largest ratio of speed and unit.
    fades : bool
        Whether the table may begin where the function begins to matter, at a larger ratio.

    Examples
    --------
    >>> made = log_table(lambda h, v: -np.log1p(v / h), lambda gap: gap, (1e-6, 1e-4), (1e-6, 1e4))
    >>> round(made(1e-5, 2e-5) / -math.log(3.0), 7), round(made(1e-5, 1e-14) / -1e-9, 2)
    (1.0, 1.0)
    """
    from scipy.interpolate import RectBivariateSpline

    rows, least = _points(gaps, _GAPS), ratios[0]
    if fades:
        middle, trial = float(rows[rows.size // 2]), _points(ratios, _SPEEDS)
        seen = np.abs(function(np.full_like(trial, middle), trial * unit(middle)))
        matters = int(np.argmax(seen > _ONSET)) if (seen > _ONSET).any() else trial.size
        least = float(trial[max(min(matters - _SPEEDS, trial.size - _DEGREE - 1), 0)])
    columns = _points((least, ratios[1]), _SPEEDS)
    units = np.array([unit(gap) for gap in rows.tolist()])
    h = np.repeat(rows[:, None], columns.size, axis=1)
    values = function(h, units[:, None] * columns)
    spline = RectBivariateSpline(np.log(rows), np.log(columns), values, kx=_DEGREE, ky=_DEGREE)
    reach = (float(rows[0]), float(rows[-1])), (float(columns[0]), float(columns[-1]))
    return LogTable(unit, reach, spline)


def _points(ends: tuple[float, float], per_decade: int) -> Array:
    """Points in equal ratios between two numbers, enough for a spline."""
    decades = math.log10(ends[1] / ends[0])
    count = max(_DEGREE + 1, math.ceil(per_decade * decades) + 1)
    return np.geomspace(ends[0], ends[1], count)


def places(gaps: tuple[float, float]) -> Array:
    """Gaps [m] of a table of one variable: quintics leave 1e-9 of Vinogradova's function."""
    count = max(_DEGREE + 3, math.ceil(_ALONE * math.log10(gaps[1] / gaps[0])) + 1)
    return np.geomspace(*gaps, count)
