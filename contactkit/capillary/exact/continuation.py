"""Pseudo-arclength continuation of bridges with free ends, up to the stability limit.

Symbols are those of `delaunay` and `free_ends`. Used where `volume_branch.march` fails because the
phase of an end has passed minus a right angle.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...errors import ConvergenceError
from .chart import Pair
from .free_ends import Free, newton, scaled_curvature, tangent, weights_of
from .volume_branch import DETACHMENT, FOLD, sessile_drop

__all__ = ["FreeBranch", "march_free", "relax_curvature"]

Array = NDArray[np.float64]


class FreeBranch(NamedTuple):
    """Points along the curve with increasing gap; the last gap is the limit.

    `unknowns` and `directions` hold four unknowns and the gap, and their derivatives by the arc
    length `path`; `radii` are the last contact radii over the neck radius; bodies are in the order
    lower, upper.
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
        """Neck radius, shape and the two contact radii at the limit."""
        if self.kind == DETACHMENT:
            leaves = float(self.bodies.limiting.cosine[0]) == -1.0
            a, _, left = sessile_drop(self.bodies.second if leaves else self.bodies.limiting)
            return (a, -1.0, 0.0, left) if leaves else (a, -1.0, left, 0.0)
        a, (below, above) = math.exp(self.unknowns[0, -1]), self.radii
        return a, float(self.unknowns[1, -1]), a * below, a * above

    @property
    def first(self) -> Array:
        """Unknowns at the first point."""
        result: Array = self.unknowns[:4, 0]
        return result

    def place(self, gap: Array) -> Array:
        """Initial guess of the unknowns for given gaps."""
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


def relax_curvature(bodies: Pair, factor: float, start: Array, gap: float) -> Array:
    """Unknowns of a bridge, by continuation from bodies of `factor` times the curvature."""
    here, far, ratio = start, math.log(factor), 0.6
    while far != 0.0:
        trial = far * ratio if abs(far * ratio) > 0.05 else 0.0
        found, good = newton(
            scaled_curvature(bodies, math.exp(trial)), here[:, None], np.array([gap]), None
        )
        if good[0]:
            here, far = found.unknowns[:, 0], trial
            continue
        ratio = math.sqrt(ratio)
        if ratio > 0.9999:
            raise ConvergenceError(
                "no bridge was found between bodies so strongly curved; give less volume", here
            )
    return here


def _ahead(
    bodies: Pair, here: Free, direction: Array, step: float, pressure: float | None
) -> Free | None:
    """Bridge one step along the curve, in the plane normal to its direction."""
    # Pseudo-arclength (Keller): the gap is an unknown too and the step is along the tangent, so
    # that the system stays regular at a fold, where the Jacobian by the four unknowns alone is
    # singular.
    weights = weights_of(here)
    origin = np.append(here.unknowns[:, 0], here.gap[0])
    y = origin + step * direction
    row = direction * weights**2
    for _ in range(10):
        at, _ = _once(bodies, y, pressure)
        if not (np.isfinite(at.jacobian).all() and np.isfinite(at.residual).all()):
            return None
        rows = np.concatenate((at.jacobian[0], [[-1.0], [0.0], [0.0], [0.0]]), axis=1)
        miss = np.append(at.residual[:, 0], row @ (y - origin - step * direction))
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


def _turned(direction: Array, before: Array, weights: Array) -> Array:
    return direction if (direction * before) @ weights**2 > 0.0 else -direction


def march_free(bodies: Pair, start: Array, gap: float, pressure: float | None = None) -> FreeBranch:
    """Follow the curve from a stable bridge, given by its unknowns, to the limit."""
    here, good = newton(bodies, start[:, None], np.array([gap]), pressure)
    if not good[0]:
        raise ConvergenceError("no bridge was found to start from; give less volume", start)
    leaves = [body.cosine[0] == -1.0 for body in (bodies.limiting, bodies.second)]
    limit = np.inf
    if any(leaves) and pressure is None:
        limit = sessile_drop(bodies.second if leaves[0] else bodies.limiting).height
    sign = np.sign(np.linalg.det(here.jacobian[0]))
    direction = tangent(here)
    direction = direction if direction[4] > 0.0 else -direction
    path, places, tangents, step = [0.0], [here], [direction], 0.1
    for _ in range(400):
        new = _ahead(bodies, here, direction, step, pressure)
        now = None if new is None else _turned(tangent(new), direction, weights_of(new))
        # Tangents that differ by more than 37 degrees (cosine 0.8): the curve bends too much for
        # the step, or another curve was caught.
        if new is None or now is None or now @ (direction * weights_of(new) ** 2) < 0.8:
            step *= 0.5
            if step < 1e-6 or (here.gap[0] > limit * (1.0 - 1e-5)):
                break
            continue
        if now[4] <= 0.0:  # the gap falls: a fold lies in this step; approach it by short ones
            if step > 1e-3:
                step *= 0.25
                continue
            return _with_fold(bodies, path, places, tangents, step, pressure)
        if np.sign(np.linalg.det(new.jacobian[0])) != sign:  # stepped over two folds
            step *= 0.25
            if step < 1e-6:
                break
            continue
        path.append(path[-1] + step)
        here, direction = new, now
        places.append(here)
        tangents.append(direction)
        step = min(1.4 * step, 0.5)
    if np.isfinite(limit) and here.gap[0] > 0.9 * limit:
        return _branch(bodies, path, places, tangents, np.append(_gaps(places), limit), DETACHMENT)
    raise ConvergenceError(
        "no limit of the bridge was found; change volume or angles a little", places
    )


def _gaps(places: list[Free]) -> Array:
    return np.array([place.gap[0] for place in places])


def _branch(
    bodies: Pair,
    path: list[float],
    places: list[Free],
    tangents: list[Array],
    gap: Array,
    kind: int,
) -> FreeBranch:
    unknowns = np.array([np.append(place.unknowns[:, 0], place.gap[0]) for place in places]).T
    first, last = places[-1].radii[:, 0].tolist()
    return FreeBranch(
        bodies, np.array(path), unknowns, np.array(tangents).T, gap, (first, last), kind
    )


def _with_fold(
    bodies: Pair,
    path: list[float],
    places: list[Free],
    tangents: list[Array],
    step: float,
    pressure: float | None,
) -> FreeBranch:
    """Locate the fold, the maximum of the gap, within one step of the last point."""
    here, direction = places[-1], tangents[-1]
    low, high = 0.0, step
    f_low, f_high = float(direction[4]), -np.inf
    best, best_direction = here, direction
    # False position on the slope of the gap along the curve; halving the value at the end that
    # stays (Illinois) keeps it from creeping.
    for _ in range(60):
        middle = 0.5 * (low + high)
        if np.isfinite(f_high):
            middle = high - f_high * (high - low) / (f_high - f_low)
        new = _ahead(bodies, here, direction, middle, pressure)
        if new is None:
            break
        best, best_direction = new, _turned(tangent(new), direction, weights_of(new))
        value = float(best_direction[4])
        if abs(value) < 1e-10 or high - low < 1e-12:
            break
        if value > 0.0:
            low, f_low, f_high = middle, value, 0.5 * f_high
        else:
            high, f_high, f_low = middle, value, 0.5 * f_low
    best_direction = best_direction.copy()
    best_direction[4] = 0.0
    path, places, tangents = (
        [*path, path[-1] + middle],
        [*places, best],
        [*tangents, best_direction],
    )
    return _branch(bodies, path, places, tangents, _gaps(places), FOLD)
