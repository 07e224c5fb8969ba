"""Dense output of a step: its highest force, and the work along its path."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

from ...numerics.quadrature import gauss_legendre
from ...numerics.radau_tableau import NODES, WEIGHTS
from .radau import MotionPoint, Step, coordinate

__all__ = ["peak", "work"]

_SHORT = 1e-2  # change of the coordinate up to which the weights of the method do for the work


def _cubic(first: float, stages: Sequence[float]) -> tuple[float, float, float, float]:
    """Coefficients a, b, c, d of a + b x + c x^2 + d x^3 through the start and the stages."""
    x, f = (0.0, *NODES), (first, *stages)
    d1 = [(f[i + 1] - f[i]) / (x[i + 1] - x[i]) for i in range(3)]
    d2 = [(d1[i + 1] - d1[i]) / (x[i + 2] - x[i]) for i in range(2)]
    d = (d2[1] - d2[0]) / x[3]
    c = d2[0] - d * (x[0] + x[1] + x[2])
    b = d1[0] - d2[0] * (x[0] + x[1]) + d * (x[0] * x[1] + x[0] * x[2] + x[1] * x[2])
    return f[0], b, c, d


def _jumps(first: float, stages: Sequence[float]) -> bool:
    """Whether a stiff film came up to its force at once, in a transient that was stepped over."""
    values = (first, *stages)
    return stages[0] - first > 0.9 * (max(values) - min(values))


class Peak(NamedTuple):
    """Highest value on a step, and where it is: 0 at the start, 1 at the end."""

    value: float
    where: float


def peak(first: float, stages: Sequence[float]) -> Peak:
    """Highest value on a step, from its start and its three stages.

    Examples
    --------
    >>> value, where = peak(0.0, [c * (1.0 - c) for c in NODES])
    >>> round(value, 12), round(where, 12)
    (0.25, 0.5)
    """
    if _jumps(first, stages) and 2.0 * (stages[2] - first) > stages[0] - first:
        return Peak(stages[2], 1.0)  # it stays up; on the way there the stages are not accurate
    nodes, values = (0.0, *NODES), (first, *stages)
    best = max(range(4), key=values.__getitem__)
    value, where = values[best], nodes[best]
    a, b, c, d = _cubic(first, stages)
    inside = c * c - 3.0 * b * d
    if inside < 0.0:
        return Peak(value, where)
    # Of the two extrema, the maximum is where the second derivative is negative.
    q = -(c + math.copysign(math.sqrt(inside), c))
    for root in (q / (3.0 * d) if d else math.nan, b / q if q else math.nan):
        if 0.0 < root < 1.0 and 2.0 * c + 6.0 * d * root < 0.0:
            at = a + root * (b + root * (c + root * d))
            # A cubic swings away from smooth stretches; trust only a small rise above the nodes.
            if value < at <= value + 0.25 * (value - min(values)):
                value, where = at, root
    return Peak(value, where)


def work(start: MotionPoint, taken: Step, first: float, values: Sequence[float]) -> float:
    r"""Integral of a force over the travel of a step, :math:`\int F \, dh` [J].

    Parameters
    ----------
    start : MotionPoint
        Where the step started.
    taken : Step
        The step.
    first, values : float, sequence of 3 floats
        Force at the start and at the stages [N].

    Notes
    -----
    Over a long step force and coordinate are taken as cubics in time and the gap follows from the
    coordinate exactly, so that a step in which the gap multiplies loses nothing.
    """
    if abs(taken.coordinates[2]) < _SHORT:
        return _by_weights(start, taken, values)
    if _jumps(first, values):
        # The jump takes no time: begin where the stages, as a parabola, say it ended.
        (a, b, c), (u, v, w) = NODES, values
        first = u * b * c / ((a - b) * (a - c)) + v * a * c / ((b - a) * (b - c))
        first += w * a * b / ((c - a) * (c - b))
    f0, f1, f2, f3 = _cubic(first, values)
    _, q1, q2, q3 = _cubic(0.0, taken.coordinates)
    total = 0.0
    for x, weight in zip(*gauss_legendre(6), strict=True):
        place = coordinate(start.gap, taken.exponent, ((q3 * x + q2) * x + q1) * x)
        if place is None:  # the cubic overshoots
            return _by_weights(start, taken, values)
        rate = (3.0 * q3 * x + 2.0 * q2) * x + q1
        total += weight * (((f3 * x + f2) * x + f1) * x + f0) * place[1] * rate
    return total


def _by_weights(start: MotionPoint, taken: Step, values: Sequence[float]) -> float:
    """Integral of a force over the travel by the quadrature of the method [J]."""
    dt = taken.stages[2].time - start.time
    stages = zip(WEIGHTS, values, taken.stages, strict=True)
    return dt * sum(w * f * stage.speed for w, f, stage in stages)
