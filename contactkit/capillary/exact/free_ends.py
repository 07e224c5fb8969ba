r"""Bridges with the arc lengths of both ends as unknowns, outside the chart of `delaunay`.

Symbols are those of `delaunay`. Between curved bodies of which one repels and the other wets, the
phase of an end passes minus a right angle, where the chart of `delaunay.ends` has a fold. Here the
arc lengths of both ends are unknowns, which is regular up to the equator of a body but needs a good
initial guess: bridges are obtained by continuation from a known one, in the gap or in the curvature
of the bodies.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from .chart import Pair, integrals_between

__all__ = ["Free", "at_gaps", "scaled_curvature", "descend", "newton", "tangent"]

Array = NDArray[np.float64]
Rows = NDArray[np.complex128]  # a value and its complex steps in the directions of the unknowns

_STEP = 1e-30  # of the complex-step derivative, as in `chart`
_STEPS = 400  # to be given up after; each is at most a third of the gap, and failed ones halve it
_DIRECTIONS = np.concatenate((np.zeros((1, 4)), np.eye(4)))[:, :, None]


class Free(NamedTuple):
    """Bridges of given volume or pressure, all arrays with the bridges last.

    Attributes
    ----------
    unknowns : ndarray, shape (4, n)
        Logarithm of the neck radius, shape e, and arc lengths over the neck radius of the two ends.
    residual : ndarray, shape (4, n)
        Residuals of the gap, of the volume (or of p = aP) and of the two contact angles.
    jacobian : ndarray, shape (n, 4, 4)
        Derivatives of the residuals by the unknowns.
    volume, gap : ndarray, shape (n,)
        Volume and gap.
    radii : ndarray, shape (2, n)
        Contact radii over the neck radius.
    """

    unknowns: Array
    residual: Array
    jacobian: Array
    volume: Array
    gap: Array
    radii: Array


def _end(log_neck: Rows, shape: Rows, arc: Rows, solid: Any) -> tuple[Any, ...]:
    """Radius, sine of the tangent angle, sag, cap and the residual of the contact angle."""
    p = 1.0 - shape
    x = 0.5 * p * arc + 1e-300
    chord = arc * np.sin(x) / x
    w = chord * chord
    r = np.sqrt(1.0 + shape * w)
    sine = (1.0 + 0.5 * p * shape * w) / r
    cosine = shape * chord * np.cos(x) / r
    steep = solid.curvature * np.exp(log_neck) * r
    level = np.sqrt(1.0 - steep * steep)
    sag = steep * r / (1.0 + level)
    cap = np.pi / 6.0 * sag * (3.0 * r * r + sag * sag)
    # sine of (phi - beta - theta)
    ahead, along = sine * level - cosine * steep, cosine * level + sine * steep
    return r, sine, sag, cap, ahead * solid.cosine - along * solid.sine


def _at(bodies: Pair, x: Array, gap: Array, pressure: float | None) -> Free:
    log_neck, shape, *arcs = np.moveaxis(x + 1j * _STEP * _DIRECTIONS, 1, 0)
    ends = [
        _end(log_neck, shape, arc, solid)
        for arc, solid in zip(arcs, (bodies.limiting, bodies.second), strict=True)
    ]
    size = np.exp(log_neck)
    height, content, height_e, content_e = integrals_between(x[1], -x[2], x[3])
    (r1, sine1), (r2, sine2) = ((end[0][0].real, end[1][0].real) for end in ends)
    # the integrals carry their derivatives in the imaginary parts, like all other values
    i1, i2, ie = arcs[0].imag, arcs[1].imag, shape.imag
    z = height + 1j * (height_e * ie + sine1 * i1 + sine2 * i2)
    v = content + 1j * (content_e * ie + r1 * r1 * sine1 * i1 + r2 * r2 * sine2 * i2)
    gaps = size * (z - ends[0][2] - ends[1][2])
    volumes = size**3 * (np.pi * v - ends[0][3] - ends[1][3])
    second = volumes - 1.0 if pressure is None else (1.0 - shape) - size * pressure
    rows = np.stack((gaps - gap, second, ends[0][4], ends[1][4]))
    jacobian = np.moveaxis(rows[:, 1:].imag / _STEP, 2, 0)
    return Free(x, rows[:, 0].real, jacobian, volumes[0].real, gaps[0].real, np.stack((r1, r2)))


class FreeRoots(NamedTuple):
    """Bridges at the end of the iteration, and which of them converged."""

    at: Free
    settled: NDArray[np.bool_]


def newton(bodies: Pair, x: Array, gap: Array, pressure: float | None) -> FreeRoots:
    """Newton iteration from `x`."""
    bodies = bodies.at(np.zeros(gap.size, dtype=np.intp))
    for _ in range(12):
        at = _at(bodies, x, gap, pressure)
        fine: NDArray[np.bool_] = np.isfinite(
            at.jacobian.sum(axis=(1, 2)) + at.residual.sum(axis=0)
        )
        # Singular or infinite systems among many would stop the solution of all: they get a step of
        # no meaning, and fail by their residual.
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
    return FreeRoots(at, found)


def tangent(at: Free, i: int = 0) -> Array:
    """Direction of the curve in the unknowns and the gap, of unit length in `weights`."""
    # The null vector of four equations in five unknowns, by singular values: regular at a fold too.
    rows = np.concatenate((at.jacobian[i], [[-1.0], [0.0], [0.0], [0.0]]), axis=1)
    weights = weights_of(at, i)
    direction = np.linalg.svd(rows / weights)[2][-1]
    result: Array = direction / weights
    return result


def weights_of(at: Free, i: int = 0) -> Array:
    """Scaling weights of the unknowns and of the gap."""
    _, shape, first, last = at.unknowns[:, i]
    span = abs(first) + abs(last)
    return np.array(
        [1.0, 1.0 / (1.0 + abs(shape)), 1.0 / span, 1.0 / span, 1.0 / (at.gap[i] + 0.05)]
    )


def descend(
    bodies: Pair, start: Array, start_gap: float, gaps: Array, pressure: float | None = None
) -> list[Free | None]:
    """Continuation from a stable bridge, given by its unknowns, to each of the smaller gaps.

    None where the continuation fails or stability ends.
    """
    found: list[Free | None] = [None] * gaps.size
    here, good = newton(bodies, start[:, None], np.array([start_gap]), pressure)
    if not good[0]:
        return found
    # The determinant changes sign at a fold: a step to where it has the other sign has jumped over
    # one.
    sign = np.sign(np.linalg.det(here.jacobian[0]))
    left, fraction = _STEPS, 0.2
    for i in np.argsort(-gaps):
        target = float(gaps[i])
        while here.gap[0] - target > 1e-14 and left > 0:
            left -= 1
            goal = max(target, here.gap[0] - fraction * max(here.gap[0], 0.05))
            slope = np.linalg.solve(here.jacobian[0], np.array([1.0, 0.0, 0.0, 0.0]))
            guess = here.unknowns + (slope * (goal - here.gap[0]))[:, None]
            new, good = newton(bodies, guess, np.array([goal]), pressure)
            if not good[0] or np.sign(np.linalg.det(new.jacobian[0])) != sign:
                fraction *= 0.5
                continue
            here, fraction = new, min(1.5 * fraction, 0.5)
        if here.gap[0] - target > 1e-13:
            break
        new, good = newton(bodies, here.unknowns, np.array([target]), pressure)
        found[i] = new if good[0] else None
    return found


def scaled_curvature(bodies: Pair, factor: float) -> Pair:
    """Bodies with their curvature multiplied by a factor."""
    limiting, second = (
        body._replace(curvature=body.curvature * factor)
        for body in (bodies.limiting, bodies.second)
    )
    return Pair(limiting, second, bodies.symmetric)


def at_gaps(bodies: Pair, x: Array, gap: Array, pressure: float | None) -> Free | None:
    """Bridges at many gaps from initial guesses, or None if one does not converge."""
    found, good = newton(bodies, x, gap, pressure)
    return found if good.all() else None
