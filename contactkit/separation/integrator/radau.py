r"""One implicit step of a mass held by a film whose resistance may be enormous or nothing.

.. math:: m \dot v = G(t, h, v), \qquad \dot h = v

is stepped by the three-stage Radau IIA method (order 5, L-stable), so that a film with
:math:`c/m` of 1e12 1/s sets no limit on the step. The gap is not the unknown. It is written

.. math:: h = h_n \, (1 - s q)^{-1/s}, \qquad q(t_n) = 0

and the stages are solved for the rate of q. With :math:`s = -1`, q is the travel. With
:math:`c \propto h^{-(s+1)}`, q is the viscous impulse, which grows linearly while the film
carries the pull: the gap may then multiply within one step, and the equations of a stage stay
monotone where those written in h have a fold and lose the physical root.

Plain floats only: this runs inside an FMU. ``m`` may be any positive number.

References
----------
Hairer and Wanner, Solving Ordinary Differential Equations II (1996), section IV.8, for the
method and its error estimate.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

__all__ = ["NODES", "WEIGHTS", "NetForce", "Stage", "Step", "coordinate", "slopes", "step"]

NetForce = Callable[[float, float, float], float]
"""Net force [N] on the mass at a time [s], a gap [m] and a speed [m/s]."""

_R6 = math.sqrt(6.0)
NODES = ((4.0 - _R6) / 10.0, (4.0 + _R6) / 10.0, 1.0)
_A = (
    ((88.0 - 7.0 * _R6) / 360.0, (296.0 - 169.0 * _R6) / 1800.0, (-2.0 + 3.0 * _R6) / 225.0),
    ((296.0 + 169.0 * _R6) / 1800.0, (88.0 + 7.0 * _R6) / 360.0, (-2.0 - 3.0 * _R6) / 225.0),
    ((16.0 - _R6) / 36.0, (16.0 + _R6) / 36.0, 1.0 / 9.0),
)
WEIGHTS = _A[2]
# Error estimate: gamma0 of the real eigenvalue of A^-1 and the weights of the stage increments.
_GAMMA0 = 3.0 + 3.0 ** (2.0 / 3.0) - 3.0 ** (1.0 / 3.0)
_E = ((-13.0 - 7.0 * _R6) / 3.0, (-13.0 + 7.0 * _R6) / 3.0, -1.0 / 3.0)
_MAX_ITERATIONS = 12


class Stage(NamedTuple):
    """A point inside a step: time [s], gap [m], speed [m/s]."""

    time: float
    gap: float
    speed: float


class Step(NamedTuple):
    """What one attempted step gives.

    `coordinates` are q at the stages and `exponent` is s. The errors are estimates: of the
    logarithm of the gap [-] and of the speed [m/s].
    """

    stages: tuple[Stage, Stage, Stage]
    coordinates: tuple[float, float, float]
    exponent: float
    gap_error: float
    speed_error: float
    evaluations: int


def coordinate(gap: float, s: float, q: float) -> tuple[float, float, float] | None:
    """Gap and its first two derivatives with respect to q; None outside the range of q."""
    base = 1.0 - s * q
    if base <= 0.0:
        return None
    try:
        h = gap * (math.exp(q) if s == 0.0 else base ** (-1.0 / s))
    except OverflowError:
        return None
    first = h / base
    return h, first, (1.0 + s) * first / base


def _solve3(a: list[list[float]], b: list[float]) -> list[float] | None:
    """Solve a 3 by 3 system by Cramer's rule; None if it is singular."""
    (a0, a1, a2), (b0, b1, b2), (c0, c1, c2) = a
    m0, m1, m2 = b1 * c2 - b2 * c1, b2 * c0 - b0 * c2, b0 * c1 - b1 * c0
    det = a0 * m0 + a1 * m1 + a2 * m2
    if det == 0.0 or not math.isfinite(det):
        return None
    x, y, z = b
    return [
        (x * m0 + a1 * (b2 * z - y * c2) + a2 * (y * c1 - b1 * z)) / det,
        (a0 * (y * c2 - b2 * z) + x * m1 + a2 * (b0 * z - y * c0)) / det,
        (a0 * (b1 * z - y * c1) + a1 * (y * c0 - b0 * z) + x * m2) / det,
    ]


def slopes(
    net: NetForce, time: float, gap: float, speed: float, scale: float
) -> tuple[float, float, float]:
    """Net force and its derivatives with respect to gap and speed, by differences.

    `scale` is the speed at which the film balances the other forces. The difference at rest is
    far below it, so that a limit of the liquid that sets in at creeping speeds is not straddled.
    """
    force = net(time, gap, speed)
    dh = 1e-7 * gap
    dv = 1e-7 * (abs(speed) + 1e-3 * scale)
    by_gap = (net(time, gap + dh, speed) - force) / dh
    return force, by_gap, (net(time, gap, speed + dv) - force) / dv


def step(
    net: NetForce,
    mass: float,
    start: Stage,
    dt: float,
    s: float,
    rtol: float,
    at_start: tuple[float, float, float],
    scale: float | None = None,
) -> Step | None:
    """Advance by `dt`; None if the stages cannot be solved, and a smaller step is to be tried.

    Parameters
    ----------
    net : callable
        Net force [N] of (time, gap, speed).
    mass : float
        Mass [kg].
    start : Stage
        Where the step starts.
    dt : float
        Its length [s].
    s : float
        Exponent of the coordinate, see the head of this module; -1 is the gap itself.
    rtol : float
        Tolerance of the step, from which that of the iteration derives.
    at_start : tuple of 3 floats
        Net force and its slopes at the start, from `slopes`.
    scale : float, optional
        Speed [m/s] at which the film balances the other forces, for the differences of `slopes`;
        that which crosses the gap within the step if not given.
    """
    scale = start.gap / dt if scale is None else scale
    rates = [start.speed / start.gap] * 3
    # Rates below this do not count: nothing of the gap per step, or of the creep of the film.
    floor = min(1e-6 / dt, scale / start.gap)
    size, calls = math.inf, 0
    known: list[tuple[float, float]] | None = None
    for iteration in range(_MAX_ITERATIONS):
        points = _points(start, dt, s, rates)
        found = _forces(net, points, scale, known) if points is not None else None
        if points is None or found is None:
            return None
        forces, slopes_there = found
        calls += 3 if known is not None else 9
        residual, matrix = _system(mass, start, dt, points, forces, slopes_there)
        change = _solve3(matrix, residual)
        if change is None:
            return None
        rates = [r - d for r, d in zip(rates, change, strict=True)]
        previous, size = size, max(map(abs, change)) / (max(map(abs, rates)) + floor)
        is_met = size <= 0.03 * rtol and _is_small(residual, mass, dt, scale, points, found, rtol)
        is_stalled = iteration > 1 and size < 1e-6 and size >= previous  # at rounding
        if is_met or (is_stalled and _is_small(residual, mass, dt, scale, points, found, 1e-7)):
            return _finish(net, mass, start, dt, s, rates, at_start, calls)
        if iteration > 5 and size > previous:
            return None
        # The slopes are kept once the iteration contracts well with them.
        known = slopes_there if size < 0.05 * min(previous, 1.0) else None
    return None


def _points(
    start: Stage, dt: float, s: float, rates: list[float]
) -> list[tuple[float, Stage, float, float]] | None:
    """Coordinate, point, first derivative of the gap and curvature term of each stage."""
    found = []
    for node, row, rate in zip(NODES, _A, rates, strict=True):
        q = dt * (row[0] * rates[0] + row[1] * rates[1] + row[2] * rates[2])
        place = coordinate(start.gap, s, q)
        if place is None or not 1e-100 < place[0] < math.inf:
            return None
        gap, first, second = place
        point = Stage(start.time + node * dt, gap, rate * first)
        found.append((q, point, first, rate * second))
    return found


def _forces(
    net: NetForce,
    points: list[tuple[float, Stage, float, float]],
    scale: float,
    known: list[tuple[float, float]] | None,
) -> tuple[list[float], list[tuple[float, float]]] | None:
    """Net forces at the stages and their slopes, which are taken over where they are known."""
    if known is not None:
        forces = [net(*point) for _, point, _, _ in points]
        return (forces, known) if all(map(math.isfinite, forces)) else None
    found = [slopes(net, *point, scale) for _, point, _, _ in points]
    if not all(math.isfinite(force) for force, _, _ in found):
        return None
    return [force for force, _, _ in found], [(by_gap, by_speed) for _, by_gap, by_speed in found]


def _system(
    mass: float,
    start: Stage,
    dt: float,
    points: list[tuple[float, Stage, float, float]],
    forces: list[float],
    slopes_there: list[tuple[float, float]],
) -> tuple[list[float], list[list[float]]]:
    """Residual m (v_i - v_0) - dt sum(a_ij G_j) of the stages, and its matrix."""
    lines = []
    for j, ((_, _, first, second), (by_gap, by_speed)) in enumerate(
        zip(points, slopes_there, strict=True)
    ):
        # d G_j / d rate_k, through the gap of the stage and through its speed.
        both = (by_gap * first + by_speed * second) * dt
        line = [both * a for a in _A[j]]
        line[j] += by_speed * first
        lines.append(line)
    (x0, x1, x2), (y0, y1, y2), (z0, z1, z2) = lines
    residual, matrix = [], []
    for i, (_, point, first, second) in enumerate(points):
        a, b, c = _A[i]
        delivered = a * forces[0] + b * forces[1] + c * forces[2]
        residual.append(mass * (point.speed - start.speed) - dt * delivered)
        swing = mass * second
        row = [
            dt * (swing * a - (a * x0 + b * y0 + c * z0)),
            dt * (swing * b - (a * x1 + b * y1 + c * z1)),
            dt * (swing * c - (a * x2 + b * y2 + c * z2)),
        ]
        row[i] += mass * first
        matrix.append(row)
    return residual, matrix


def _is_small(
    residual: list[float],
    mass: float,
    dt: float,
    scale: float,
    points: list[tuple[float, Stage, float, float]],
    found: tuple[list[float], list[tuple[float, float]]],
    rtol: float,
) -> bool:
    """Whether the momentum left over is small against what the film and the mass take.

    The rates alone do not tell: a film that hardly yields carries its force at next to no speed.
    """
    momentum = 0.0
    for (_, point, _, _), force, (_, by_speed) in zip(points, *found, strict=True):
        speed = abs(point.speed)
        carried = abs(by_speed) * (speed + scale)  # by the film, moving or in balance
        momentum = max(momentum, mass * speed + dt * (abs(force) + carried))
    return max(map(abs, residual)) <= rtol * momentum


def _finish(
    net: NetForce,
    mass: float,
    start: Stage,
    dt: float,
    s: float,
    rates: list[float],
    at_start: tuple[float, float, float],
    calls: int,
) -> Step | None:
    """Read the stages off the rates and estimate the error of the step."""
    points = _points(start, dt, s, rates)
    if points is None:
        return None
    t0, h0, v0 = start
    # (gamma0/dt - J) err = f(start) + sum(e_i z_i)/dt in the unknowns (q, v); q = 0 at the start.
    force, by_gap, by_speed = at_start
    j11, j12 = -v0 * (1.0 + s) / h0, 1.0 / h0
    j21, j22 = by_gap * h0 / mass, by_speed / mass
    g = _GAMMA0 / dt
    det = (g - j11) * (g - j22) - j12 * j21
    zq = sum(e * point[0] for e, point in zip(_E, points, strict=True)) / dt
    zv = sum(e * (point[1].speed - v0) for e, point in zip(_E, points, strict=True)) / dt

    def estimate(rate: float, acceleration: float) -> tuple[float, float]:
        a, b = rate + zq, acceleration + zv
        return ((g - j22) * a + j12 * b) / det, (j21 * a + (g - j11) * b) / det

    eq, ev = estimate(v0 / h0, force / mass)
    place = coordinate(h0, s, eq)
    if place is not None and place[0] > 0.0 and math.isfinite(place[0] + ev):
        # The second estimate, from where the first one leads, ignores what decays at once.
        eq, ev = estimate((v0 + ev) / place[1], net(t0, place[0], v0 + ev) / mass)
    if not (math.isfinite(eq) and math.isfinite(ev)):
        return None
    (q1, p1, *_), (q2, p2, *_), (q3, p3, *_) = points
    return Step((p1, p2, p3), (q1, q2, q3), s, abs(eq), abs(ev), calls + 1)
