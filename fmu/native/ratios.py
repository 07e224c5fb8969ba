r"""Ratios of forces over gap and speed as splines, for the C kernel of a native FMU.

The logarithm of a ratio is tabulated over :math:`\ln h` and :math:`x = \ln(v/u(h))`, with a unit u
of the speed at each gap along which it changes little. Where no film moves faster than u, it is
over :math:`x = \ln(r/(1 - r))` with :math:`r = v/u`: the logarithms that forces end with at such a
pole are smooth there. Splines of degree five through evenly spaced nodes are kept by their
coefficients; where a node next to an end is no knot, its coefficients say so.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from ...errors import ConvergenceError
from .records import Piece, Ratio, Table

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

__all__ = ["TOLERANCE", "Axes", "Units", "ratio"]

_DEGREE = 5  # of the splines: cubics would take three times the nodes for 1e-6
# Nodes in a decade of gap and speed to begin with, and how often they are doubled. Each doubling
# takes an error by 64 where the ratio is smooth; at the kink of a power law by 8.
_GAPS, _SPEEDS, _DOUBLINGS = 5, 8, 3
TOLERANCE = 1e-6
"""Error of a force over itself, between the nodes of a table."""
_ROUGH = 1e-3  # a ratio that is not known any better is refused
_FALLS = 0.5  # of an error, by a doubling that was worth it
_CHECKED = 6  # nodes across each axis at which the other one is checked


class Units(NamedTuple):
    """Unit of the speed at a gap: its logarithm, and whether no film moves faster."""

    logarithm: Callable[[Floats], Floats]
    is_pole: bool = False


class Axes(NamedTuple):
    """Smallest and largest gap [m] of a table, and its smallest and largest x."""

    gaps: tuple[float, float]
    speeds: tuple[float, float]
    fade: float
    """Power of the speed that the logarithm falls with below the smallest x."""


def ratio(
    function: Callable[[Floats, Floats], Floats],
    units: Units,
    axes: Axes,
    rtol: float = TOLERANCE,
) -> Ratio:
    """Tabulate the logarithm of a ratio of forces.

    Parameters
    ----------
    function : callable
        Logarithms at arrays of gaps [m] and speeds [m/s] of one shape, finite.
    units : Units
        What the speed is measured in.
    axes : Axes
        Where.
    rtol : float
        Error of the ratios [-].

    Raises
    ------
    ConvergenceError
        If the ratio is too rough for a table.

    Examples
    --------
    >>> made = ratio(
    ...     lambda h, v: -np.log1p(v / h), Units(np.log), Axes((1e-6, 1e-5), (-9.0, 9.0), 1.0)
    ... )
    >>> made.gaps, made.speeds
    (10, 68)
    """
    decades = math.log(10.0)
    counts = [
        max(_DEGREE + 1, math.ceil(per * (end - begin) / decades) + 1)
        for per, (begin, end) in ((_GAPS, _logs(axes.gaps)), (_SPEEDS, axes.speeds))
    ]
    errors = [math.inf, math.inf]
    for _ in range(_DOUBLINGS):
        table, before = _Spline.through(function, units, axes, counts), errors
        errors = [table.error(function, axis) for axis in (0, 1)]
        # An error that no longer falls is that of the function itself.
        finer = [e > rtol and e < _FALLS * was for e, was in zip(errors, before, strict=True)]
        if not any(finer):
            break
        counts = [2 * n - 1 if more else n for n, more in zip(counts, finer, strict=True)]
    if not max(errors) <= _ROUGH:
        raise ConvergenceError(
            f"a viscosity over pressure and shear is too rough for a table: its force is "
            f"{max(errors):.1e} off between gaps of {axes.gaps[0]:g} m and {axes.gaps[1]:g} m",
            errors,
        )
    return table.record(axes.fade)


def _logs(ends: tuple[float, float]) -> tuple[float, float]:
    return math.log(ends[0]), math.log(ends[1])


class _Spline(NamedTuple):
    """Splines through values at evenly spaced nodes."""

    rows: Floats  # ln h
    columns: Floats  # x
    coefficients: Floats
    unit: Any  # spline of minus the logarithm of the unit, over ln h
    is_pole: bool

    @classmethod
    def through(
        cls,
        function: Callable[[Floats, Floats], Floats],
        units: Units,
        axes: Axes,
        counts: list[int],
    ) -> _Spline:
        from scipy.interpolate import make_interp_spline

        rows = np.linspace(*_logs(axes.gaps), counts[0])
        columns = np.linspace(*axes.speeds, counts[1])
        unit = make_interp_spline(rows, -units.logarithm(np.exp(rows)), k=_DEGREE)
        empty = cls(rows, columns, np.empty((0, 0)), unit, units.is_pole)
        values = empty.ask(function, rows, columns)
        made = _solved(_solved(values).T).T
        return empty._replace(coefficients=made)

    def ask(
        self, function: Callable[[Floats, Floats], Floats], rows: Floats, columns: Floats
    ) -> Floats:
        """Values of a function at all pairs of ln h and x."""
        logs = columns - np.logaddexp(0.0, columns) if self.is_pole else columns
        speed = np.exp(logs - self.unit(rows)[:, None])
        gap = np.broadcast_to(np.exp(rows)[:, None], speed.shape)
        # By speeds: what one takes, its neighbours take.
        return np.asarray(function(gap.T, speed.T)).T

    def __call__(self, rows: Floats, columns: Floats) -> Floats:
        """Values of the splines at all pairs of ln h and x."""
        from scipy.interpolate import BSpline

        first = BSpline(_knots(self.rows), self.coefficients, _DEGREE)(rows)
        return np.asarray(BSpline(_knots(self.columns), first.T, _DEGREE)(columns).T)

    def error(self, function: Callable[[Floats, Floats], Floats], axis: int) -> float:
        """Largest difference from the function between nodes along an axis, of some across it."""
        along, across = (self.rows, self.columns)[:: 1 - 2 * axis]
        middle = 0.5 * (along[1:] + along[:-1])
        some = across[:: max(1, across.size // _CHECKED)]
        places = (middle, some) if axis == 0 else (some, middle)
        return float(np.abs(self(*places) - self.ask(function, *places)).max())

    def record(self, fade: float) -> Ratio:
        """Splines as the kernel reads them."""
        y, slope, curve = (tuple(self.unit(self.rows, i).tolist()) for i in range(3))
        piece = Piece(
            low=math.exp(self.rows[0]),
            high=math.exp(self.rows[-1]),
            folds=False,
            power=0,
            x=tuple(self.rows.tolist()),
            y=y,
            slope=slope,
            curve=curve,
        )
        gaps, speeds = self.coefficients.shape
        return Ratio(
            unit=Table(stays=True, pieces=(piece,)),
            has_pole=self.is_pole,
            fade=fade,
            end=float(self.columns[-1]),
            first_gap=float(self.rows[0]),
            per_gap=1.0 / float(self.rows[1] - self.rows[0]),
            gaps=gaps,
            first_speed=float(self.columns[0]),
            per_speed=1.0 / float(self.columns[1] - self.columns[0]),
            speeds=speeds,
            coefficient=tuple(self.coefficients.ravel().tolist()),
        )


def _knots(nodes: Floats) -> Floats:
    """Knots of the splines: the nodes, and five more at either end."""
    step = nodes[1] - nodes[0]
    return np.asarray(nodes[0] + step * np.arange(-_DEGREE, nodes.size + _DEGREE))


def _solved(values: Floats) -> Floats:
    """Coefficients of splines through values along the first axis.

    The two nodes next to an end are no knots: the fifth derivative does not jump there.
    """
    n = values.shape[0]
    matrix = np.zeros((n + 4, n + 4))
    for k, weight in enumerate((1.0, 26.0, 66.0, 26.0, 1.0)):
        matrix[np.arange(n), np.arange(n) + k] = weight / 120.0
    for row, node in enumerate((1, 2, n - 3, n - 2)):
        matrix[n + row, node - 1 : node + 6] = (1.0, -6.0, 15.0, -20.0, 15.0, -6.0, 1.0)
    right = np.vstack([values, np.zeros((4, values.shape[1]))])
    return np.asarray(np.linalg.solve(matrix, right))
