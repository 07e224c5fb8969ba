"""Force of an exact bridge whose contact angles move: bridges solved where they are asked for.

A motion takes a bridge through few of all pairs of angles, at any gap: thousands of evaluations,
each of which would cost a millisecond if it were solved. So bridges of a lattice of angles are
solved along the gap when a motion first comes near, and the force is interpolated between them.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import lru_cache
from typing import NamedTuple

from ...numerics.cubic_spline import cubic_spline

__all__ = ["BridgeTable", "bridge_table"]

# Nodes of the lattice of angles, from 0 to 180 degrees: every 5 degrees where one angle moves, and
# every 7.5 where two do: a motion comes near some fifty pairs, of 6 ms between flats and 25 else.
_NODES, _PAIRS = 37, 25
_NEAR = math.radians(0.5)
_POINTS = 161  # bridges of a curve: right to 1e-6
_SAFE = 0.9  # of the least end of the corners of a cell: no bridge inside it ends before
_KEPT = 32  # tables: a film that loses liquid asks for five, each of some dozen curves

Weights = tuple[tuple[int, float], ...]


class _Curve(NamedTuple):
    """Bridges of two angles: the length that their gaps are over, and their curve."""

    length: float
    force: Callable[[float], float]


class BridgeTable:
    """Exact bridges of unit volume on bodies of given curvatures, over gap and both angles.

    Parameters
    ----------
    curvatures : tuple of float
        Of the lower and the upper body, times the cube root of the volume [-].
    first : float
        Smallest gap over the cube root of the volume [-]; below, the force stays.
    is_even : bool
        Both angles are the same at all times: half the dimensions.

    Notes
    -----
    Four nodes of each angle. Against bridges solved one by one the force is right to 1e-4 up to
    0.7 of the gap at which the bridge ends, and with equal angles up to 0.97. With unequal ones,
    whose end has a cusp near equal angles, it is off by 1 % at 0.9 and by some per cent in the
    last tenth, where it falls like a root. Beyond its end a bridge keeps its last force.

    Examples
    --------
    >>> table = BridgeTable((0.0, 0.0), 0.1, is_even=False)
    >>> from contactkit.capillary.exact.bridge import bridge
    >>> round(table.force(0.5, 0.5, 0.8) / float(bridge(0.5, 1.0, 0.5, 0.8).force), 3)
    1.0
    """

    def __init__(self, curvatures: tuple[float, float], first: float, *, is_even: bool) -> None:
        self._curvatures, self._first, self._is_even = curvatures, first, is_even
        self._last = (_NODES if is_even else _PAIRS) - 1
        self._step = math.pi / self._last
        self._is_symmetric = curvatures[0] == curvatures[1]
        self._curves: dict[tuple[int, int], _Curve] = {}
        self._ends: dict[tuple[int, int], float] = {}
        self._lengths: dict[int, float] = {}
        # As of the curves of `meniscus_sphere`: below, little depends on the gap.
        self._thin = 0.1 * math.sqrt(max(sum(curvatures), 0.0) / math.pi)

    def force(self, gap: float, lower: float, upper: float) -> float:
        """Force over surface tension and cube root of the volume [-], positive if it attracts."""
        gap = max(gap, self._first)
        nodes = [(self._curve(i, j), w) for i, j, w in self._stencil(lower, upper)]
        length = sum(w * one.length for one, w in nodes)
        part = gap / length
        thin = self._thin / length
        x = math.sqrt(max(math.log((1.0 + thin) / (part + thin)), 0.0))
        return sum(w * one.force(x) for one, w in nodes) / (part + thin) ** 2

    def end(self, lower: float, upper: float) -> float:
        """Gap over the cube root of the volume at which a bridge loses stability [-]."""
        from ..exact.stability import stability_limit

        return float(stability_limit(1.0, lower, upper, *self._curvatures).gap)

    def surely_spans(self, gap: float, lower: float, upper: float) -> bool:
        """Whether a gap is so small that a bridge of these angles spans it without a look."""
        i, j = (min(int(angle / self._step), self._last - 1) for angle in (lower, upper))
        corners = [(i, i), (i + 1, i + 1)]
        if not self._is_even:
            corners = [(a, b) for a in (i, i + 1) for b in (j, j + 1)]
        return gap < _SAFE * min(self._end_of(a, b) for a, b in corners)

    def _key(self, i: int, j: int) -> tuple[int, int]:
        return (j, i) if self._is_symmetric and j < i else (i, j)

    def _end_of(self, i: int, j: int) -> float:
        key = self._key(i, j)
        if key not in self._ends:
            self._ends[key] = self.end(*self._angles(*key))
        return self._ends[key]

    def _stencil(self, lower: float, upper: float) -> list[tuple[int, int, float]]:
        """Nodes around two angles [rad] with their weights."""
        below = _weights(lower / self._step, self._last)
        if self._is_even:
            return [(i, i, w) for i, w in below]
        above = _weights(upper / self._step, self._last)
        return [(i, j, w * v) for i, w in below for j, v in above]

    def _angles(self, i: int, j: int) -> tuple[float, float]:
        """Angles [rad] of a node; liquid spreads between 0 and 180 degrees, so near there."""
        lower, upper = i * self._step, j * self._step
        if abs(i - j) < self._last:
            return lower, upper
        return (_NEAR, upper - _NEAR) if i < j else (lower - _NEAR, _NEAR)

    def _curve(self, i: int, j: int) -> _Curve:
        key = self._key(i, j)
        if key not in self._curves:
            self._curves[key] = self._solved(*key)
        return self._curves[key]

    def _length(self, both: int) -> float:
        """End of the bridge with the mean angle on both bodies; smooth where that of two is not.

        Between equal bodies the end has a cusp at equal angles, which no lattice follows.
        """
        if both not in self._lengths:
            self._lengths[both] = self.end(0.5 * both * self._step, 0.5 * both * self._step)
        return self._lengths[both]

    def _solved(self, i: int, j: int) -> _Curve:
        import numpy as np

        from ..exact.bridge import bridge

        length = self._length(i + j)
        thin, least = self._thin / length, self._first / length
        # Stencils of other lengths look a little further down.
        far = math.sqrt(math.log((1.0 + thin) / (0.5 * least + thin)))
        x = np.linspace(0.0, far, _POINTS)
        part = (1.0 + thin) * np.exp(-x * x) - thin
        part[0] = 1.0 - 1e-6
        fixed = (*self._angles(i, j), *self._curvatures)
        found = bridge(part * length, 1.0, *fixed, beyond="nan").force
        # Beyond its end a bridge of unequal angles keeps the last force.
        last = int(np.flatnonzero(np.isfinite(found))[0])
        found[:last] = found[last]
        curve = cubic_spline(x.tolist(), (found * (part + thin) ** 2).tolist())
        return _Curve(length, lambda at: curve(at)[0])


def _weights(at: float, last: int) -> Weights:
    """Four of the nodes 0 to `last` around a place, and Lagrange's polynomials there."""
    first = min(max(int(at) - 1, 0), last - 3)
    a, b, c, d = (at - first - k for k in range(4))
    return (
        (first, -b * c * d / 6.0),
        (first + 1, a * c * d / 2.0),
        (first + 2, -a * b * d / 2.0),
        (first + 3, a * b * c / 6.0),
    )


@lru_cache(maxsize=_KEPT)
def bridge_table(curvatures: tuple[float, float], first: float, *, is_even: bool) -> BridgeTable:
    """Return the table of some bodies, the same for all films that ask for it."""
    return BridgeTable(curvatures, first, is_even=is_even)
