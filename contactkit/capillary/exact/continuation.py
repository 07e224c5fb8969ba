"""The curve of bridges with free ends, followed by its arc length up to its limit.

Symbols are those of `delaunay` and `bridge_free`. It serves where `bridge_branch.march` loses its
way, for the phase of an end has passed minus a right angle.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...errors import ConvergenceError
from .chart import Pair
from .free_ends import Free, bent, newton, tangent, weights_of
from .volume_branch import DETACHMENT, FOLD, drop_left

__all__ = ["FreeBranch", "march_free", "unbend"]

Array = NDArray[np.float64]


class FreeBranch(NamedTuple):
    """Places along the curve, gap growing; the last gap is the limit.

    `unknowns` and `directions` hold four unknowns and the gap, and their slopes by the arc
    length `path`; `radii` are the last over the waist; bodies are in the order lower, upper.
    """

    bodies: Pair
    path: Array
    unknowns: Array
    directions: Array
    gap: Array
    radii: tuple[float, float]
    kind: int

    @property
    def last(self) -> tuple[float, float, float, float]:
        """Waist, shape and the two contact radii at the limit."""
        if self.kind == DETACHMENT:
            leaves = float(self.bodies.binder.cosine[0]) == -1.0
            a, _, left = drop_left(self.bodies.other if leaves else self.bodies.binder)
            return (a, -1.0, 0.0, left) if leaves else (a, -1.0, left, 0.0)
        a, (below, above) = math.exp(self.unknowns[0, -1]), self.radii
        return a, float(self.unknowns[1, -1]), a * below, a * above

    @property
    def first(self) -> Array:
        """Unknowns of the first place."""
        result: Array = self.unknowns[:4, 0]
        return result

    def place(self, gap: Array) -> Array:
        """Unknowns near which the bridges of gaps lie."""
        inside = self.unknowns[4]
        i = np.clip(np.searchsorted(inside, gap), 1, inside.size - 1) - 1
        width = self.path[i + 1] - self.path[i]
        low, high = np.zeros(gap.shape), np.ones(gap.shape)
        for _ in range(40):
            t = 0.5 * (low + high)
            under = self._cubic(i, t, width)[4] < gap
            low, high = np.where(under, t, low), np.where(under, high, t)
        return self._cubic(i, 0.5 * (low + high), width)[:4]

    def _cubic(self, i: NDArray[np.intp], t: Array, width: Array) -> Array:
        y, d, rest = self.unknowns, self.directions, 1.0 - t
        first = rest * rest * ((1.0 + 2.0 * t) * y[:, i] + t * width * d[:, i])
        last = t * t * ((3.0 - 2.0 * t) * y[:, i + 1] - rest * width * d[:, i + 1])
        return first + last


def unbend(bodies: Pair, factor: float, start: Array, gap: float) -> Array:
    """Unknowns of a bridge between bodies, from those between bodies `factor` times as curved."""
    here, far, ratio = start, math.log(factor), 0.6
    while far != 0.0:
        trial = far * ratio if abs(far * ratio) > 0.05 else 0.0
        found, good = newton(bent(bodies, math.exp(trial)), here[:, None], np.array([gap]), None)
        if good[0]:
            here, far = found.unknowns[:, 0], trial
            continue
        ratio = math.sqrt(ratio)
        if ratio > 0.9999:
            raise ConvergenceError("no bridge was found between bodies so strongly curved", here)
    return here


def _ahead(
    bodies: Pair, here: Free, way: Array, step: float, pressure: float | None
) -> Free | None:
    """The bridge a step along the curve, in the plane across its direction."""
    weights = weights_of(here)
    origin = np.append(here.unknowns[:, 0], here.gap[0])
    y = origin + step * way
    row = way * weights**2
    for _ in range(10):
        at, _ = _once(bodies, y, pressure)
        if not (np.isfinite(at.jacobian).all() and np.isfinite(at.residual).all()):
            return None
        rows = np.concatenate((at.jacobian[0], [[-1.0], [0.0], [0.0], [0.0]]), axis=1)
        miss = np.append(at.residual[:, 0], row @ (y - origin - step * way))
        try:
            move = np.linalg.solve(np.vstack((rows, row)), miss)
        except np.linalg.LinAlgError:
            return None
        y = y - move
        size = float(np.max(abs(move * weights)))
        if size < 1e-9:
            return _once(bodies, y, pressure)[0]
        if size > 1.0:
            return None
    return None


def _once(bodies: Pair, y: Array, pressure: float | None) -> tuple[Free, Array]:
    from .free_ends import _at

    return _at(bodies, y[:4, None], y[4:], pressure), y


def _turned(way: Array, before: Array, weights: Array) -> Array:
    return way if (way * before) @ weights**2 > 0.0 else -way


def march_free(bodies: Pair, start: Array, gap: float, pressure: float | None = None) -> FreeBranch:
    """Follow the curve from a stable bridge, given by its unknowns, to its limit."""
    here, good = newton(bodies, start[:, None], np.array([gap]), pressure)
    if not good[0]:
        raise ConvergenceError("no bridge was found to start from", start)
    leaves = [body.cosine[0] == -1.0 for body in (bodies.binder, bodies.other)]
    limit = np.inf
    if any(leaves) and pressure is None:
        limit = drop_left(bodies.other if leaves[0] else bodies.binder)[1]
    sign = np.sign(np.linalg.det(here.jacobian[0]))
    way = tangent(here)
    way = way if way[4] > 0.0 else -way
    path, places, ways, step = [0.0], [here], [way], 0.1
    for _ in range(400):
        new = _ahead(bodies, here, way, step, pressure)
        now = None if new is None else _turned(tangent(new), way, weights_of(new))
        if new is None or now is None or now @ (way * weights_of(new) ** 2) < 0.8:
            step *= 0.5
            if step < 1e-6 or (here.gap[0] > limit * (1.0 - 1e-5)):
                break
            continue
        if now[4] <= 0.0:
            if step > 1e-3:
                step *= 0.25
                continue
            return _with_fold(bodies, path, places, ways, step, pressure)
        if np.sign(np.linalg.det(new.jacobian[0])) != sign:  # jumped over two folds
            step *= 0.25
            if step < 1e-6:
                break
            continue
        path.append(path[-1] + step)
        here, way = new, now
        places.append(here)
        ways.append(way)
        step = min(1.4 * step, 0.5)
    if np.isfinite(limit) and here.gap[0] > 0.9 * limit:
        return _branch(bodies, path, places, ways, np.append(_gaps(places), limit), DETACHMENT)
    raise ConvergenceError("no limit of the bridge was found", places)


def _gaps(places: list[Free]) -> Array:
    return np.array([place.gap[0] for place in places])


def _branch(
    bodies: Pair, path: list[float], places: list[Free], ways: list[Array], gap: Array, kind: int
) -> FreeBranch:
    unknowns = np.array([np.append(place.unknowns[:, 0], place.gap[0]) for place in places]).T
    first, last = places[-1].radii[:, 0].tolist()
    return FreeBranch(bodies, np.array(path), unknowns, np.array(ways).T, gap, (first, last), kind)


def _with_fold(
    bodies: Pair,
    path: list[float],
    places: list[Free],
    ways: list[Array],
    step: float,
    pressure: float | None,
) -> FreeBranch:
    """Find the fold less than a step ahead of the last place: there the gap stands still."""
    here, way = places[-1], ways[-1]
    low, high = 0.0, step
    f_low, f_high = float(way[4]), -np.inf
    best, best_way = here, way
    for _ in range(60):
        middle = 0.5 * (low + high)
        if np.isfinite(f_high):
            middle = high - f_high * (high - low) / (f_high - f_low)
        new = _ahead(bodies, here, way, middle, pressure)
        if new is None:
            break
        best, best_way = new, _turned(tangent(new), way, weights_of(new))
        value = float(best_way[4])
        if abs(value) < 1e-10 or high - low < 1e-12:
            break
        if value > 0.0:
            low, f_low, f_high = middle, value, 0.5 * f_high
        else:
            high, f_high, f_low = middle, value, 0.5 * f_low
    best_way = best_way.copy()
    best_way[4] = 0.0
    path, places, ways = [*path, path[-1] + middle], [*places, best], [*ways, best_way]
    return _branch(bodies, path, places, ways, _gaps(places), FOLD)
