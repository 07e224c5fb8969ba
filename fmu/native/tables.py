r"""Functions of the gap as quintic Hermite tables, for the C kernel of a native FMU.

A table has pieces that end where the slope of the function jumps. Along a piece runs
:math:`x = \ln h`, or :math:`x = \sqrt{\ln(h_{end}/h)}` where the function ends: there it may
fold over with an infinite slope, and is smooth in that root. What is tabulated is
:math:`y = f h^p` with a whole p that takes the steepest fall away; y stays beyond the table.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from itertools import pairwise
from typing import TYPE_CHECKING, Any, Protocol

from ...errors import ConvergenceError
from .records import Piece, Table

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

__all__ = ["Tabulate", "quintics", "tabulate"]

# Measured on six tables (films, menisci with and without a fold, an exponential): 3850 nodes, 3210
# calls of the functions, 1e-12 of a value between the nodes.

# Of the polynomial on a stretch. 8 asks for five times the calls and twice the nodes; with 24 a
# noisy stretch swings between its points, 5e-11 off.
_DEGREE = 14
# A stretch of x that is not divided further: what is left is noise of round-off. 0.01 to 0.3 end
# with the same nodes within 4 %.
_NARROW = 0.05
# x below which a distance to an end counts as none: 1e-3 divides as if no finer stretches were
# needed, and takes a tenth more nodes; 1e-7 the same.
_CLOSE = 1e-5
# Error of a narrow stretch that is not divided in spite of it: 1e-13 to 1e-11 take the same nodes.
_FAIR = 1e-12
# Round-off of a stretch, in values that are sums of few terms. Smaller, noise is taken for the
# function and followed: 5500 nodes with 1e-15, 10 300 with 3e-16.
_ROUNDING = 3e-15
_NOISE = 1e-7  # largest that is taken for noise: a force that is rougher is refused
_NOTHING = 1e-10  # of the largest value of a piece; less than this may be noise altogether
_MOST_NODES = 60_000  # of a piece, 2 MB: a rougher force is refused, with the cure
# Power of the gap that is taken out: h^-5 (a film that narrows) to h^-7 (retarded van der Waals)
# become slowly varying. With 2 the tables have 7 % more nodes, with 4 and 16 the same; a bound is
# needed as noise at the lowest gap may have any slope.
_STEEPEST = 8


class Tabulate(Protocol):
    """A way to tabulate a function of the gap, as `tabulate` does."""

    def __call__(
        self,
        function: Callable[[float], float],
        edges: Sequence[float],
        *,
        folds: Sequence[float] = (),
        stays: bool = False,
    ) -> Table:
        """Tabulate a function between edges; see `tabulate`."""


def tabulate(
    function: Callable[[float], float],
    edges: Sequence[float],
    *,
    folds: Sequence[float] = (),
    stays: bool = False,
    rtol: float = 1e-12,
) -> Table:
    """Tabulate a function of the gap between edges, at which its slope may jump.

    Parameters
    ----------
    function : callable
        Value at a gap [m].
    edges : sequence of float
        Ascending gaps [m], the ends of the table among them.
    folds : sequence of float
        Those of the edges towards which the slope may grow without bound.
    stays : bool
        Whether the function keeps its value beyond the last edge; else it falls as before.
    rtol : float
        Error of the values [-], relative to the largest nearby; that of ``h f'`` is 10 times this.

    Raises
    ------
    ConvergenceError
        If the function is too rough for a table.

    Examples
    --------
    >>> table = tabulate(lambda gap: 2.0 * gap**-3, (1e-7, 1e-4))
    >>> [(piece.power, len(piece.x)) for piece in table.pieces]
    [(3, 2)]
    """
    pieces = []
    for low, high in pairwise(edges):
        power = _power(function, low, high)
        pieces.append(_piece(function, low, high, high in folds, power, rtol))
    return Table(stays=stays, pieces=tuple(pieces))


def _power(function: Callable[[float], float], low: float, high: float) -> int:
    """Whole power with which a function falls at the start of a stretch."""
    a = low * (1.0 + 1e-9)
    b = min(a * 1.01, 0.5 * (low + high))
    first, second = function(a), function(b)
    if first == 0.0 or not 0.0 < second / first < math.inf:  # nan is refused with the values
        return 0
    return min(max(round(-math.log(second / first) / math.log(b / a)), 0), _STEEPEST)


def _piece(
    function: Callable[[float], float],
    low: float,
    high: float,
    folds: bool,
    power: int,
    rtol: float,
) -> Piece:
    import numpy as np

    def scaled(places: Floats) -> Floats:
        gaps = high * np.exp(-places * places) if folds else np.exp(places)
        inside = np.clip(gaps, low * (1.0 + 1e-14), high * (1.0 - 1e-14))
        return np.array([function(float(gap)) * gap**power for gap in inside])

    first, last = (
        (0.0, math.sqrt(math.log(high / low))) if folds else (math.log(low), math.log(high))
    )
    x, y, slope, curve = [first], list[float](), list[float](), list[float]()
    whole = float(np.max(np.abs(scaled(np.linspace(first, last, 33)))))
    waiting = [(first, last)]
    while waiting:
        a, b = waiting.pop()
        series, is_good = _series(scaled, a, b, whole, folds)
        if not is_good:
            waiting += [(0.5 * (a + b), b), (a, 0.5 * (a + b))]
            continue
        places = _places(series, a, b, rtol)
        rate, bend = series.deriv(), series.deriv(2)
        begin = 1 if y else 0  # the end of the stretch before is the same node
        x += [float(place) for place in places[1:]]
        y += [float(value) for value in series(places[begin:])]
        slope += [float(value) for value in rate(places[begin:])]
        curve += [float(value) for value in bend(places[begin:])]
        if len(x) > _MOST_NODES:
            raise ConvergenceError(
                f"a force is too rough for a table between gaps of {low:g} m and {high:g} m; put "
                "edges where its slope jumps",
                x,
            )
    return Piece(
        low=low,
        high=high,
        folds=folds,
        power=power,
        x=tuple(x),
        y=tuple(y),
        slope=tuple(slope),
        curve=tuple(curve),
    )


def _series(
    scaled: Callable[[Floats], Floats], a: float, b: float, whole: float, folds: bool
) -> tuple[Any, bool]:
    """Polynomial through a stretch, and whether it is as good as it gets.

    `whole` is the largest value of the piece.
    """
    import numpy as np
    from numpy.polynomial import Chebyshev

    series = Chebyshev.interpolate(scaled, _DEGREE, [a, b])
    if not np.all(np.isfinite(series.coef)):
        raise ConvergenceError(
            "a force is no finite number somewhere along its table; end the table before", (a, b)
        )
    size, change = (float(np.max(np.abs(series.coef[i:]))) for i in (0, 1))
    # A force that vanishes like x^2 / ln x needs the finer stretches the nearer they are to x = 0.
    near = min(max(b, _CLOSE), 1.0) if folds else 1.0
    least = _NARROW * near
    noise = _ROUNDING * max(size, change / near**2)  # the gap holds few digits of what is left
    series = series.trim(noise)  # it would grow in the slopes
    tail = float(np.max(np.abs(series.coef[_DEGREE - 2 :]), initial=0.0))
    if b - a <= least and tail > max(_NOISE * size, _NOTHING * whole):
        raise ConvergenceError(
            f"a force is too rough for a table: {tail / size:.1e} off; put edges where its slope "
            "jumps",
            (a, b),
        )
    # Where the values fall by orders of ten, the small ones are to be as good as the large ones.
    first, last = np.abs(series(np.array([a, b])))
    is_even = min(first, last) > 0.2 * size or size < _NOTHING * whole
    enough = max((_FAIR if b - a <= _NARROW else 1e-13) * size, noise)
    return series, (tail <= enough and (is_even or b - a <= _NARROW)) or b - a <= least


def _places(series: Any, a: float, b: float, rtol: float) -> Floats:
    """Nodes between which quintics follow a polynomial and its slope."""
    import numpy as np

    rate, bend, count = series.deriv(), series.deriv(2), 1
    size = float(np.max(np.abs(series.coef))) or 1.0
    fractions = np.array([0.07, 0.25, 0.5, 0.75, 0.93])[:, None]
    while True:
        nodes = np.linspace(a, b, count + 1)
        width = (b - a) / count
        places = nodes[:-1] + fractions * width
        values, slopes = quintics(
            fractions, series(nodes), rate(nodes) * width, bend(nodes) * width**2
        )
        error = float(np.max(np.abs(values - series(places))))
        wrong = float(np.max(np.abs(slopes / width - rate(places))))
        if (error <= rtol * size and wrong <= 10.0 * rtol * size) or count >= 64:
            return nodes
        count *= 2


def quintics(t: Floats, y: Floats, m: Floats, w: Floats) -> tuple[Floats, Floats]:
    """Values and slopes at fractions t of the intervals between nodes; as ``kernel/data.c``."""
    rise, m0, m1, w0, w1 = y[1:] - y[:-1], m[:-1], m[1:], w[:-1], w[1:]
    c = 10.0 * rise - 6.0 * m0 - 4.0 * m1 - 1.5 * w0 + 0.5 * w1
    d = -15.0 * rise + 8.0 * m0 + 7.0 * m1 + 1.5 * w0 - w1
    e = 6.0 * rise - 3.0 * (m0 + m1) - 0.5 * (w0 - w1)
    values = y[:-1] + t * (m0 + t * (0.5 * w0 + t * (c + t * (d + t * e))))
    return values, m0 + t * (w0 + t * (3.0 * c + t * (4.0 * d + t * 5.0 * e)))
