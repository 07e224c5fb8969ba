r"""Bridges followed with free ends, for the few whose phase no chart covers.

Symbols are those of `delaunay`. Where a body repels and the other one wets, and the bodies are
close or the liquid is much, the phase of an end passes minus a right angle, where the chart of
`delaunay.ends` turns back. Here the arc lengths of both ends are unknowns themselves, which is
regular everywhere short of the equator of a body, but needs a start nearby: such bridges are
followed from one at a larger gap, or from less liquid.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from .bridge_chart import Pair, integrals_between

__all__ = ["Free", "descend"]

Array = NDArray[np.float64]
Rows = NDArray[np.complex128]  # a number, and its steps in the directions of the unknowns

_STEP = 1e-30  # of the complex step
_STEPS = 400


class Free(NamedTuple):
    """One bridge: logarithm of the waist, shape, arc lengths; then gap, volume and slopes.

    `ends` holds radius, sine of the tangent angle, sag and cap of the two ends; `jacobian` the
    slopes of gap, volume (or p - aP) and the two contact conditions by the four unknowns.
    """

    unknowns: Array
    residual: Array
    jacobian: Array
    gap: float
    volume: float
    radii: tuple[float, float]


def _end(waist: Rows, shape: Rows, arc: Rows, angle: Array, curvature: float) -> tuple[Any, ...]:
    """Radius, sine of the tangent angle, sag, cap and the miss of the contact angle."""
    p = 1.0 - shape
    x = 0.5 * p * arc + 1e-300
    chord = arc * np.sin(x) / x
    w = chord * chord
    r = np.sqrt(1.0 + shape * w)
    sine = (1.0 + 0.5 * p * shape * w) / r
    cosine = shape * chord * np.cos(x) / r
    steep = curvature * np.exp(waist) * r
    level = np.sqrt(1.0 - steep * steep)
    sag = steep * r / (1.0 + level)
    cap = np.pi / 6.0 * sag * (3.0 * r * r + sag * sag)
    # sine of (phi - beta - theta)
    ahead = sine * level - cosine * steep
    along = cosine * level + sine * steep
    return r, sine, sag, cap, ahead * angle[0] - along * angle[1]


def _at(bodies: Pair, x: Array, gap: float, pressure: float | None) -> Free:
    steps = np.zeros((5, 4), dtype=complex)
    steps[1:] = 1j * _STEP * np.eye(4)
    waist, shape, *arcs = (x + steps).T
    ends = [
        _end(waist, shape, arc, np.array([body.cosine[0], body.sine[0]]), body.curvature[0])
        for body, arc in zip((bodies.binder, bodies.other), arcs, strict=True)
    ]
    size = np.exp(waist)
    height, content, height_e, content_e = integrals_between(x[1], -x[2], x[3])
    first, last = ([value[0].real for value in end] for end in ends)
    # the integrals carry their slopes in the imaginary parts, like all else
    z = height + 1j * (height_e * shape.imag + first[1] * arcs[0].imag + last[1] * arcs[1].imag)
    v = content + 1j * (
        content_e * shape.imag + first[0] ** 2 * first[1] * arcs[0].imag
        + last[0] ** 2 * last[1] * arcs[1].imag
    )  # fmt: skip
    gaps = size * (z - ends[0][2] - ends[1][2])
    volumes = size**3 * (np.pi * v - ends[0][3] - ends[1][3])
    second = volumes - 1.0 if pressure is None else (1.0 - shape) - size * pressure
    rows = np.stack((gaps - gap, second, ends[0][4], ends[1][4]))
    return Free(
        x, rows[:, 0].real, rows[:, 1:].imag / _STEP, float(gaps[0].real), float(volumes[0].real),
        (float(first[0]), float(last[0])),
    )  # fmt: skip


def _newton(bodies: Pair, x: Array, gap: float, pressure: float | None) -> Free | None:
    for _ in range(12):
        at = _at(bodies, x, gap, pressure)
        if not np.isfinite(at.jacobian).all():
            return None
        try:
            step = np.linalg.solve(at.jacobian, at.residual)
        except np.linalg.LinAlgError:
            return None
        x = x - step
        if not np.isfinite(x).all():
            return None
        size = float(np.max(abs(step) / np.maximum(abs(x), 1.0)))
        if size < 1e-9:
            at = _at(bodies, x, gap, pressure)
            return at if np.isfinite(at.residual).all() and abs(at.residual).max() < 1e-9 else None
        if not size < 2.0:
            return None
    return None


def descend(
    bodies: Pair, start: Array, start_gap: float, gaps: Array, pressure: float | None = None
) -> list[Free | None]:
    """Follow bridges of unit volume, or of a pressure, from a stable one to each of the gaps.

    `start` holds the logarithm of the waist, the shape and the two arc lengths; `gaps` are taken
    in falling order. None where the way is lost or stability ends.
    """
    here = _newton(bodies, start, start_gap, pressure)
    found: list[Free | None] = [None] * gaps.size
    if here is None:
        return found
    sign = np.sign(np.linalg.det(here.jacobian))
    left, share = _STEPS, 0.2
    for i in np.argsort(-gaps):
        target = float(gaps[i])
        while here.gap - target > 1e-14 and left > 0:
            left -= 1
            goal = max(target, here.gap - share * max(here.gap, 0.05))
            slope = np.linalg.solve(here.jacobian, np.array([1.0, 0.0, 0.0, 0.0]))
            new = _newton(bodies, here.unknowns + slope * (goal - here.gap), goal, pressure)
            if new is None or np.sign(np.linalg.det(new.jacobian)) != sign:
                share *= 0.5
                continue
            here, share = new._replace(gap=goal), min(1.5 * share, 0.5)
        if here.gap - target > 1e-14:
            break
        found[i] = _newton(bodies, here.unknowns, target, pressure)
    return found
