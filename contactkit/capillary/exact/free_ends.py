r"""Bridges with free ends, for those whose phases no chart covers, and the curve through them.

Symbols are those of `delaunay`. Where a body repels and the other one wets, and the bodies are
curved, the phase of an end passes minus a right angle, where the chart of `delaunay.ends` turns
back. Here the arc lengths of both ends are unknowns themselves, which is regular everywhere short
of the equator of a body, but needs a start nearby: such bridges are followed from one that is
known, along the gap or along the curvature of the bodies.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from .chart import Pair, integrals_between

__all__ = ["Free", "at_gaps", "bent", "descend", "newton", "tangent"]

Array = NDArray[np.float64]
Rows = NDArray[np.complex128]  # a number, and its steps in the directions of the unknowns

_STEP = 1e-30  # of the complex step
_STEPS = 400
_DIRECTIONS = np.concatenate((np.zeros((1, 4)), np.eye(4)))[:, :, None]


class Free(NamedTuple):
    """Bridges of given volume or pressure, all arrays with the bridges last.

    Attributes
    ----------
    unknowns : ndarray, shape (4, n)
        Logarithm of the waist, shape e, and arc lengths over the waist of the two ends.
    residual : ndarray, shape (4, n)
        Miss of the gap, of the volume (or of p = aP) and of the two contact angles.
    jacobian : ndarray, shape (n, 4, 4)
        Slopes of these by the unknowns.
    volume, gap : ndarray, shape (n,)
        As found.
    radii : ndarray, shape (2, n)
        Contact radii over the waist.
    """

    unknowns: Array
    residual: Array
    jacobian: Array
    volume: Array
    gap: Array
    radii: Array


def _end(waist: Rows, shape: Rows, arc: Rows, solid: Any) -> tuple[Any, ...]:
    """Radius, sine of the tangent angle, sag, cap and the miss of the contact angle."""
    p = 1.0 - shape
    x = 0.5 * p * arc + 1e-300
    chord = arc * np.sin(x) / x
    w = chord * chord
    r = np.sqrt(1.0 + shape * w)
    sine = (1.0 + 0.5 * p * shape * w) / r
    cosine = shape * chord * np.cos(x) / r
    steep = solid.curvature * np.exp(waist) * r
    level = np.sqrt(1.0 - steep * steep)
    sag = steep * r / (1.0 + level)
    cap = np.pi / 6.0 * sag * (3.0 * r * r + sag * sag)
    # sine of (phi - beta - theta)
    ahead, along = sine * level - cosine * steep, cosine * level + sine * steep
    return r, sine, sag, cap, ahead * solid.cosine - along * solid.sine


def _at(bodies: Pair, x: Array, gap: Array, pressure: float | None) -> Free:
    waist, shape, *arcs = np.moveaxis(x + 1j * _STEP * _DIRECTIONS, 1, 0)
    ends = [
        _end(waist, shape, arc, solid)
        for arc, solid in zip(arcs, (bodies.binder, bodies.other), strict=True)
    ]
    size = np.exp(waist)
    height, content, height_e, content_e = integrals_between(x[1], -x[2], x[3])
    (r1, sine1), (r2, sine2) = ((end[0][0].real, end[1][0].real) for end in ends)
    # the integrals carry their slopes in the imaginary parts, like all else
    i1, i2, ie = arcs[0].imag, arcs[1].imag, shape.imag
    z = height + 1j * (height_e * ie + sine1 * i1 + sine2 * i2)
    v = content + 1j * (content_e * ie + r1 * r1 * sine1 * i1 + r2 * r2 * sine2 * i2)
    gaps = size * (z - ends[0][2] - ends[1][2])
    volumes = size**3 * (np.pi * v - ends[0][3] - ends[1][3])
    second = volumes - 1.0 if pressure is None else (1.0 - shape) - size * pressure
    rows = np.stack((gaps - gap, second, ends[0][4], ends[1][4]))
    jacobian = np.moveaxis(rows[:, 1:].imag / _STEP, 2, 0)
    return Free(x, rows[:, 0].real, jacobian, volumes[0].real, gaps[0].real, np.stack((r1, r2)))


def newton(
    bodies: Pair, x: Array, gap: Array, pressure: float | None
) -> tuple[Free, NDArray[np.bool_]]:
    """Newton on bridges near `x`, and which of them were found."""
    bodies = bodies.at(np.zeros(gap.size, dtype=np.intp))
    for _ in range(12):
        at = _at(bodies, x, gap, pressure)
        fine: NDArray[np.bool_] = np.isfinite(
            at.jacobian.sum(axis=(1, 2)) + at.residual.sum(axis=0)
        )
        square = np.where(fine[:, None, None], at.jacobian, np.eye(4))
        square[abs(np.linalg.det(square)) < 1e-280] = np.eye(4)
        step = np.linalg.solve(square, np.where(fine, at.residual, 0.0).T[..., None])[..., 0].T
        size = np.max(abs(step) / np.maximum(abs(x), 1.0), axis=0)
        x = x - step / np.maximum(size / 0.5, 1.0)
        if not (fine & (size > 1e-9)).any():
            break
    at = _at(bodies, x, gap, pressure)
    scale = np.maximum(abs(x[1]), 1.0)
    good = (abs(at.residual).max(axis=0) < 1e-9 * scale) & (size < 1e-6)
    found: NDArray[np.bool_] = np.logical_and(good, (at.radii > 0.0).all(axis=0))
    return at, found


def tangent(at: Free, i: int = 0) -> Array:
    """Direction of the curve in the unknowns and the gap, of unit length in `weights`."""
    rows = np.concatenate((at.jacobian[i], [[-1.0], [0.0], [0.0], [0.0]]), axis=1)
    weights = weights_of(at, i)
    direction = np.linalg.svd(rows / weights)[2][-1]
    result: Array = direction / weights
    return result


def weights_of(at: Free, i: int = 0) -> Array:
    """Weights that make steps in the unknowns and in the gap alike."""
    _, shape, first, last = at.unknowns[:, i]
    span = abs(first) + abs(last)
    return np.array(
        [1.0, 1.0 / (1.0 + abs(shape)), 1.0 / span, 1.0 / span, 1.0 / (at.gap[i] + 0.05)]
    )


def descend(
    bodies: Pair, start: Array, start_gap: float, gaps: Array, pressure: float | None = None
) -> list[Free | None]:
    """Follow bridges from a stable one, given by its unknowns, to each of the smaller gaps.

    None where the way is lost or stability ends.
    """
    found: list[Free | None] = [None] * gaps.size
    here, good = newton(bodies, start[:, None], np.array([start_gap]), pressure)
    if not good[0]:
        return found
    sign = np.sign(np.linalg.det(here.jacobian[0]))
    left, share = _STEPS, 0.2
    for i in np.argsort(-gaps):
        target = float(gaps[i])
        while here.gap[0] - target > 1e-14 and left > 0:
            left -= 1
            goal = max(target, here.gap[0] - share * max(here.gap[0], 0.05))
            slope = np.linalg.solve(here.jacobian[0], np.array([1.0, 0.0, 0.0, 0.0]))
            guess = here.unknowns + (slope * (goal - here.gap[0]))[:, None]
            new, good = newton(bodies, guess, np.array([goal]), pressure)
            if not good[0] or np.sign(np.linalg.det(new.jacobian[0])) != sign:
                share *= 0.5
                continue
            here, share = new, min(1.5 * share, 0.5)
        if here.gap[0] - target > 1e-13:
            break
        new, good = newton(bodies, here.unknowns, np.array([target]), pressure)
        found[i] = new if good[0] else None
    return found


def bent(bodies: Pair, factor: float) -> Pair:
    """The same bodies with their curvature multiplied."""
    binder, other = (
        body._replace(curvature=body.curvature * factor) for body in (bodies.binder, bodies.other)
    )
    return Pair(binder, other, bodies.twin)


def at_gaps(bodies: Pair, x: Array, gap: Array, pressure: float | None) -> Free | None:
    """Bridges at many gaps from good guesses, or None if any is not found."""
    found, good = newton(bodies, x, gap, pressure)
    return found if good.all() else None
