"""Maxima of stress measures on a plane and over depth, and the planes to insert.

z points into the solid; x and y count from the first pixel of the map.  A maximum is that of the
pixels of a plane: none is interpolated.  In-plane stresses jump at an interface, so that a maximum
often lies on one of its sides; layers are searched each on its own.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from itertools import pairwise
from operator import itemgetter
from typing import NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from .measures import max_principal_stress, tresca, von_mises

__all__ = ["DepthSearch", "Maximum", "maxima", "plane_maxima", "plane_maximum"]

Array = NDArray[np.float64]
Measure = Callable[[Array], Array]

# Points per block, so that intermediate results stay in the cache: 1024 take twice as long (calls),
# a million 1.2 times.
BLOCK = 16384
# Points of the highest bounds, evaluated before all that remain: they raise the bar so that few do.
# 64 to 65536 take the same time on a random stress.
FEW = 2048
# Of the maximum, on the deepest plane: a measure above it may have its maximum below. Under a
# sphere von Mises' stress falls to half of its maximum at 1.5 contact radii; less would add planes
# for nothing.
DECAYED = 0.5
_ROUND_OFF = 1e-12  # of a maximum: bounds that exceed it by less are it; 0 to 1e-6 find the same


class Maximum(NamedTuple):
    """Maximum of a measure and its location: lengths in [m], side and layer of the plane.

    `error` is by how much the measure may exceed it between the planes, over the maximum [-]; nan
    if it was not estimated.
    """

    value: float
    x: float
    y: float
    z: float
    side: str
    layer: int
    error: float = math.nan


class StressPlane(Protocol):
    """A plane with its stresses, such as `planes.Plane`."""

    @property
    def depth(self) -> float:
        """Depth [m]."""
        ...

    @property
    def side(self) -> str:
        """Side of an interface, "+" below or "-" above."""
        ...

    @property
    def layer(self) -> int:
        """Layer from the top, 0 first."""
        ...

    @property
    def stress(self) -> Array:
        """Stress (6, ny, nx) [Pa]."""
        ...

    @property
    def dragged(self) -> Array | None:
        """Stress (6, ny, nx) [Pa] of friction per unit of its coefficient."""
        ...


def plane_maximum(
    values: Array, pixel_size: tuple[float, float], depth: float, side: str, layer: int
) -> Maximum:
    """Maximum on one plane; x and y are those of the pixel, from the first one of the map.

    Parameters
    ----------
    values : ndarray, shape (ny, nx)
        Of any measure.
    pixel_size : (dy, dx)
        [m].
    depth, side, layer
        Of the plane.

    Returns
    -------
    Maximum

    Examples
    --------
    >>> plane_maximum(np.array([[1.0, 3.0]]), (1.0, 0.5), 2.0, "+", 0)[:4]
    (3.0, 0.5, 0.0, 2.0)
    """
    row, column = divmod(int(np.argmax(values)), values.shape[1])
    dy, dx = pixel_size
    return Maximum(float(values[row, column]), column * dx, row * dy, depth, side, layer)


def maxima(
    planes: Iterable[StressPlane],
    measures: Mapping[str, Measure],
    pixel_size: tuple[float, float],
) -> dict[str, Maximum]:
    """Maximum of each measure over all planes.

    Parameters
    ----------
    planes : iterable of planes
        Such as `planes.planes`, each with depth, side, layer and stress (6, ny, nx).
    measures : mapping of str to callable
        Stress (6, ny, nx) to values (ny, nx), such as those of `measures`.
    pixel_size : (dy, dx)
        [m].

    Returns
    -------
    dict of str to Maximum
        One for each measure; empty without planes.

    Examples
    --------
    >>> from ..layer_stack import Layers
    >>> from .measures import sqrt_j2
    >>> from .planes import planes
    >>> from .tractions import Tractions
    >>> wave = np.cos(2 * np.pi * np.arange(32) / 32)[None, :]
    >>> depths = list(np.linspace(0.05, 0.3, 41))
    >>> pixel = (1.0, 1 / 32)
    >>> below = planes(Tractions(pixel, wave), Layers([1e9], [0.5]), depths)
    >>> peak = maxima(below, {"sqrt_j2": sqrt_j2}, pixel)["sqrt_j2"]
    >>> round(peak.value * np.e, 3), round(peak.z * 2 * np.pi, 2)  # k exp(-k) at k = 1
    (1.0, 0.98)
    """
    best: dict[str, Maximum] = {}
    for plane in planes:
        for name, measure in measures.items():
            values = measure(plane.stress)
            one = plane_maximum(values, pixel_size, plane.depth, plane.side, plane.layer)
            if name not in best or one.value > best[name].value:
                best[name] = one
    return best


def plane_maxima(
    plane: StressPlane, pixel_size: tuple[float, float], more_friction: Sequence[float] = (0.0,)
) -> list[dict[str, Maximum]]:
    """Maxima of the measures "von_mises", "tension", "tresca" and "sigma_xz" on one plane.

    J2 is quadratic in the coefficient of friction, so that its parts are formed once for all. By it
    principal stresses are evaluated only where one may be the largest: (s1 - s3)/2 is at most
    sqrt(J2), and s1 at most 2/sqrt(3) sqrt(J2) above the mean.

    Parameters
    ----------
    plane : Plane
        With its stress, and that of friction if any of `more_friction` is not 0.
    pixel_size : (dy, dx)
        [m].
    more_friction : sequence of float
        Coefficients of friction to add to the stress of the plane [-].

    Returns
    -------
    list of dict of str to Maximum
        One for each coefficient.

    Examples
    --------
    >>> from .planes import Plane
    >>> stress = np.zeros((6, 1, 2))
    >>> stress[4, 0, 1] = -3.0
    >>> (found,) = plane_maxima(Plane(1.0, "+", 0, stress), (1.0, 0.5))
    >>> [round(found[name].value, 6) for name in ("von_mises", "tension", "tresca", "sigma_xz")]
    [5.196152, 3.0, 3.0, 3.0]
    """
    stress, dragged = plane.stress.reshape(6, -1), None
    if plane.dragged is not None and any(mu != 0.0 for mu in more_friction):
        dragged = plane.dragged.reshape(6, -1)
    bounds = [_Bounds(stress, dragged, mu) for mu in more_friction]
    for start in range(0, stress.shape[1], BLOCK):
        part = slice(start, start + BLOCK)
        own = _Block.of(stress[:, part])
        drag = None if dragged is None else _Block.of(dragged[:, part])
        twice = None if drag is None else _mixed(own, drag)
        for one in bounds:
            if drag is None or twice is None or one.mu == 0.0:
                one.look(start, own.j2, own.mean, own.shears[1])
                continue
            j2 = own.j2 + one.mu * (twice + one.mu * drag.j2)
            mean, shear = own.mean + one.mu * drag.mean, own.shears[1] + one.mu * drag.shears[1]
            one.look(start, j2, mean, shear)
    (dy, dx), nx = pixel_size, plane.stress.shape[2]
    at = plane.depth, plane.side, plane.layer
    return [
        {
            name: Maximum(value, place % nx * dx, place // nx * dy, *at)
            for name, (place, value) in one.found().items()
        }
        for one in bounds
    ]


class _Block(NamedTuple):
    """Some points: differences of the normal stresses, shears xy, xz, yz, their mean, and J2."""

    differences: tuple[Array, Array, Array]
    shears: Array
    mean: Array
    j2: Array

    @classmethod
    def of(cls, stress: Array) -> _Block:
        xx, yy, zz = stress[:3]
        differences = xx - yy, yy - zz, zz - xx
        made = cls(differences, stress[3:], (xx + yy + zz) / 3.0, xx)
        return made._replace(j2=0.5 * _mixed(made, made))


def _mixed(one: _Block, other: _Block) -> Array:
    """Twice the bilinear form of J2."""
    total: Array = one.shears[0] * other.shears[0]
    for a, b in zip(one.shears[1:], other.shears[1:], strict=True):
        total += a * b
    normal = one.differences[0] * other.differences[0]
    for a, b in zip(one.differences[1:], other.differences[1:], strict=True):
        normal += a * b
    normal /= 6.0
    total += normal
    total *= 2.0
    return total


class _Bounds:
    """Bounds of the measures at all points, for one coefficient of friction more than given."""

    def __init__(self, stress: Array, dragged: Array | None, mu: float) -> None:
        self._stress, self._dragged, self.mu = stress, dragged, mu
        self._root, self._highest = np.empty((2, stress.shape[1]))
        self._shear = (0, -1.0)

    def look(self, start: int, j2: Array, mean: Array, shear: Array) -> None:
        """Add a block of points."""
        part = slice(start, start + j2.size)
        np.sqrt(np.maximum(j2, 0.0), out=self._root[part])
        np.multiply(self._root[part], 2.0 / math.sqrt(3.0), out=self._highest[part])
        self._highest[part] += mean
        for place in (int(shear.argmax()), int(shear.argmin())):
            if abs(shear[place]) > self._shear[1]:
                self._shear = start + place, abs(float(shear[place]))

    def found(self) -> dict[str, tuple[int, float]]:
        """Place and value of each maximum."""
        place = int(self._root.argmax())
        mises = float(von_mises(self._at(np.array([place])))[0])
        lowest = self._highest - self._root / math.sqrt(3.0)  # of s1
        near = np.array([int(lowest.argmax()), int(self._highest.argmax())])
        return {
            "von_mises": (place, mises),
            "tension": self._largest(max_principal_stress, self._highest, near),
            "tresca": self._largest(tresca, self._root, np.array([place])),
            "sigma_xz": self._shear,
        }

    def _largest(self, measure: Measure, bound: Array, near: NDArray[np.intp]) -> tuple[int, float]:
        """Place and value of the maximum of a measure that nowhere exceeds a bound.

        It is evaluated at points where it is large, then at the highest bounds, then at all that
        exceed the largest value so far.
        """
        best, points = (0, -math.inf), near
        for most in (FEW, bound.size, bound.size):
            if points.size:
                values = measure(self._at(points))
                at = int(values.argmax())
                best = max(best, (int(points[at]), float(values[at])), key=itemgetter(1))
            points = np.flatnonzero(bound > best[1] + _ROUND_OFF * abs(best[1]))
            if points.size > most:
                points = points[np.argpartition(bound[points], -most)[-most:]]
        return best

    def _at(self, places: NDArray[np.intp]) -> Array:
        here = self._stress[:, places]
        if self._dragged is not None and self.mu != 0.0:
            here = here + self.mu * self._dragged[:, places]
        return here


# Over depth ---------------------------------------------------------------------------------


class _Interval(NamedTuple):
    """Two neighbouring planes of a layer, and what a measure may reach between them."""

    top: float
    bottom: float
    reaches: float


class DepthSearch:
    """Search for the maxima of some measures over depth: which planes are missing.

    Between two planes a measure is taken for a parabola through both, whose curvature is the
    largest of those seen at either plane. Beside the plane of the maximum, at a depth z, it may
    exceed that by (h/z)^2/8 at least, h apart: the curvature of a field at a depth is of the order
    of 1/z^2. A plane is missing where this exceeds the maximum so far by more than the tolerance,
    or below the deepest one if the measure has not decayed there.

    Parameters
    ----------
    tolerance : float
        Of each maximum [-].
    deepest : float
        Depth below which nothing is searched [m].

    Examples
    --------
    k exp(-k), whose maximum is 1/e at k = 1:

    >>> search, depths = DepthSearch(1e-4, 8.0), [0.0, 0.25, 0.5, 2.0]
    >>> while depths:
    ...     for z in depths:
    ...         search.add("shear", Maximum(z * math.exp(-z), 0.0, 0.0, z, "+", 0))
    ...     depths = search.missing()
    >>> best = search.best("shear")
    >>> round(best.value * math.e, 4), best.error < 1e-4
    (1.0, True)
    """

    def __init__(self, tolerance: float, deepest: float) -> None:
        self.tolerance, self.deepest = tolerance, deepest
        self._found: dict[object, list[Maximum]] = {}

    def add(self, measure: object, one: Maximum) -> None:
        """Add the maximum of a measure on a plane."""
        self._found.setdefault(measure, []).append(one)

    def best(self, measure: object) -> Maximum:
        """Return the maximum of a measure so far, with its error."""
        found = self._found[measure]
        best = max(found, key=lambda one: one.value)
        intervals = list(_intervals(found, best))
        if not intervals:
            return best
        above = max(max(one.reaches for one in intervals) - best.value, 0.0)
        return best._replace(error=above / abs(best.value) if above > 0.0 else 0.0)

    def missing(self) -> list[float]:
        """Depths of the planes to add, ascending; none once every maximum stands."""
        wanted: set[float] = set()
        for found in self._found.values():
            at = max(found, key=lambda one: one.value)
            best = at.value
            allowed = best + self.tolerance * abs(best)
            between = max(_intervals(found, at), key=lambda one: one.reaches, default=None)
            if between is not None and between.reaches > allowed:
                wanted.add(0.5 * (between.top + between.bottom))
            last = max(found, key=lambda one: (one.z, one.side == "+"))
            if last.value > DECAYED * best and 0.0 < last.z < self.deepest:
                wanted.add(min(2.0 * last.z, self.deepest))
        return sorted(wanted)


def _intervals(found: list[Maximum], best: Maximum) -> Iterator[_Interval]:
    """Pairs of neighbouring planes of each layer."""
    for layer in {one.layer for one in found}:
        here = sorted((one for one in found if one.layer == layer), key=lambda one: one.z)
        slopes = [(b.value - a.value) / (b.z - a.z) for a, b in pairwise(here)]
        bends = [
            max(2.0 * (before - after) / (c.z - a.z), 0.0)
            for a, c, (before, after) in zip(here, here[2:], pairwise(slopes), strict=False)
        ]
        around = zip([0.0, *bends], [*bends, 0.0], strict=True)
        for (top, bottom), bend in zip(pairwise(here), around, strict=False):
            reaches = _reaches(top, bottom, max(bend))
            if len(here) == 2:  # no curvature is known yet
                reaches = 2.0 * max(top.value, bottom.value, 0.0)
            if best in (top, bottom) and best.z > 0.0:
                unseen = min(((bottom.z - top.z) / best.z) ** 2 / 8.0, 1.0)
                reaches = max(reaches, best.value + unseen * abs(best.value))
            yield _Interval(top.z, bottom.z, reaches)


def _reaches(top: Maximum, bottom: Maximum, bend: float) -> float:
    """Maximum between two planes of a parabola of given curvature."""
    rise, sag = bottom.value - top.value, bend * (bottom.z - top.z) ** 2
    if 2.0 * abs(rise) >= sag:
        return max(top.value, bottom.value)
    return 0.5 * (top.value + bottom.value) + sag / 8.0 + rise * rise / (2.0 * sag)
