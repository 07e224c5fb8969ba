"""Gap and volume of a bridge as explicit functions of two coordinates, with derivatives.

Symbols are those of `delaunay`; the coordinates are the logarithm of the neck radius and the chart
coordinate zeta. Functions take arrays of points.
"""

from __future__ import annotations

from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...numerics.quadrature import gauss_legendre
from .delaunay import Body, Elementary, End, Ends, body, ends, integrand, is_round, reach

__all__ = ["ARRAYS", "Pair", "ChartPoint", "integrals_between", "pair", "point", "solids"]

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]


def _stacked(first: Any, last: Any) -> Any:
    result = np.empty(
        (
            2,
            *np.broadcast_shapes(first.shape, last.shape),
        ),
        np.result_type(first, last),
    )
    result[0], result[1] = first, last
    return result[:, None] if first.ndim == 1 else result


ARRAYS = Elementary(
    np.sin,
    np.cos,
    np.sqrt,
    np.sinh,
    np.cosh,
    np.arcsinh,
    np.arctan,
    np.expm1,
    np.where,
    _stacked,
)
# Of the complex-step derivative, which has no difference to cancel: its error is the square of the
# step, so that any from 1e-8 down is exact. Far smaller than all numbers it meets, it drops out of
# sums.
_STEP = 1e-30
_DIRECTIONS = np.array([[0.0], [_STEP]])
# Numbers of Gauss-Legendre nodes to choose from, see `_stretched`. Few, so that their nodes stay in
# the cache of 16. With 16 nodes alone common bridges are off by 4e-10, from 24 on by round-off.
_COUNTS = (16, 24, 32, 40, 48, 64, 96, 128)


class Pair(NamedTuple):
    """Two bodies, that of the limiting end first; entries are arrays of one length."""

    limiting: Body
    second: Body
    symmetric: Flags

    def at(self, index: NDArray[np.intp] | Flags) -> Pair:
        """Select points."""
        return Pair(
            Body(*(value[index] for value in self.limiting)),
            Body(*(value[index] for value in self.second)),
            self.symmetric[index],
        )

    def swapped(self, flip: Flags) -> Pair:
        """Exchange the bodies of points."""
        first = Body(
            *(np.where(flip, o, b) for b, o in zip(self.limiting, self.second, strict=True))
        )
        last = Body(
            *(np.where(flip, b, o) for b, o in zip(self.limiting, self.second, strict=True))
        )
        return Pair(first, last, self.symmetric)


class ChartPoint(NamedTuple):
    """Bridges at points of the chart.

    Attributes
    ----------
    ends : Ends
        Shape and ends, lengths over the neck radius.
    gap, volume : ndarray
        Gap [m] and volume [m^3].
    gap_by_neck, gap_by_chart, volume_by_neck, volume_by_chart : ndarray
        Derivatives of gap and volume by the logarithm of the neck radius and by zeta.
    shape_by_neck, shape_by_chart : ndarray
        Derivatives of the shape e.
    """

    ends: Ends
    gap: Array
    volume: Array
    gap_by_neck: Array
    gap_by_chart: Array
    volume_by_neck: Array
    volume_by_chart: Array
    shape_by_neck: Array
    shape_by_chart: Array


def solids(angle: Array, curvature: Array) -> Body:
    """A body at each point, from its contact angle [rad] and curvature [1/m]."""
    return body(ARRAYS, angle, curvature)


def pair(lower: Body, upper: Body, symmetric: Flags) -> Pair:
    """Bodies in the order lower, upper."""
    return Pair(lower, upper, symmetric)


@lru_cache(maxsize=16)
def _nodes(count: int) -> tuple[Array, Array]:
    nodes, weights = gauss_legendre(count)
    return np.array(nodes), np.array(weights)


def _real(found: Ends) -> Ends:
    """Real parts, from the first row of a complex step."""

    def first(end: End) -> End:
        return End(*(value[0].real for value in end))

    return Ends(
        found.shape[0].real,
        found.pressure[0].real,
        found.force[0].real,
        first(found.limiting),
        first(found.second),
        found.sine_limiting[0].real,
        found.sine_second[0].real,
    )


def integrals(e: Array, first: End, last: End) -> Array:
    """Height and volume over pi of the meridian between its ends, and their derivatives by e."""
    from_bulge = is_round(e)
    result = np.empty((4, e.size))
    for flag in (False, True):
        part = np.flatnonzero(from_bulge == flag)
        if part.size == e.size:
            return _stretched(e, first, last, flag)
        one, two = (End(*(value[part] for value in end)) for end in (first, last))
        result[:, part] = _stretched(e[part], one, two, flag)
    return result


def integrals_between(shape: Array, low: Array, high: Array) -> Array:
    """Integrals of meridians between two arc lengths, see `integrals`."""

    def end(arc: Array) -> End:
        return End(arc, np.tan(0.5 * (1.0 - shape) * arc), arc, arc, arc, arc)

    return integrals(shape, end(-low), end(high))


def _stretched(e: Array, first: End, last: End, from_bulge: bool) -> Array:
    low = -reach(ARRAYS, e, first, from_bulge=from_bulge)
    span = reach(ARRAYS, e, last, from_bulge=from_bulge) - low
    # The integrand is analytic up to a branch point at an imaginary distance of pi/2, see
    # `integrand`: Gauss' rule converges as rho^(-2n) with ln rho = asinh(pi/span). 20 is
    # ln(1e17)/2, and some more.
    longest = float(np.max(abs(span), initial=0.0, where=np.isfinite(span)))
    wanted = 6.0 + 20.0 / np.arcsinh(np.pi / max(longest, 1e-3))
    nodes, weights = _nodes(next((n for n in _COUNTS if n >= wanted), _COUNTS[-1]))
    # nodes along the first axis, so that all but the last operation run along contiguous rows
    values = integrand(ARRAYS, e, low + span * nodes[:, None], from_bulge=from_bulge)
    return np.stack([span * (weights @ value) for value in values])


def point(where: Pair, log_neck: Array, chart: Array) -> ChartPoint:
    """Bridges at points of the chart, lengths in the unit of the neck radius."""
    flat = not (where.limiting.curvature.any() or where.second.curvature.any())
    # between flats only the scale depends on the neck radius
    directions = _DIRECTIONS[1:] if flat else _DIRECTIONS
    coordinate = chart + 1j * directions
    a = np.exp(log_neck + 0.0 * directions if flat else log_neck + 1j * _DIRECTIONS[::-1])
    found = ends(ARRAYS, a, coordinate, where.limiting, where.second, where.symmetric)
    real = _real(found)
    height, content, height_e, content_e = integrals(real.shape, real.limiting, real.second)
    size = a[0].real

    def slope(value: NDArray[np.complex128]) -> Array:
        result: Array = value.imag / _STEP
        return result if len(result) == 2 else np.concatenate((0.0 * result, result))

    b, o = real.limiting, real.second
    shape = slope(found.shape)
    arc_b, arc_o = slope(found.limiting.arc), slope(found.second.arc)
    sags = slope(found.limiting.sag + found.second.sag)
    caps = slope(found.limiting.cap + found.second.cap)
    gap = size * (height - b.sag - o.sag)
    volume = size**3 * (np.pi * content - b.cap - o.cap)
    d_gap = size * (height_e * shape + b.sine * arc_b + o.sine * arc_o - sags)
    d_volume = size**3 * (
        np.pi * (content_e * shape + b.radius**2 * b.sine * arc_b + o.radius**2 * o.sine * arc_o)
        - caps
    )
    return ChartPoint(
        real,
        gap,
        volume,
        d_gap[0] + gap,
        d_gap[1],
        d_volume[0] + 3.0 * volume,
        d_volume[1],
        shape[0],
        shape[1],
    )
