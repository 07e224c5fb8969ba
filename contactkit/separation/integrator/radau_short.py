r"""The step of `stiff_step` where it is short: solved with the slopes at its start alone.

A master steps an FMU some thousand times through a motion that a few hundred steps would follow.
In each of these the gap changes by little, so that the equations of the three stages keep the
matrix they have at the start, which is inverted once, and two rounds of six evaluations do. The
answer is that of `stiff_step.step`, to rounding; where the rounds do not contract tenfold, or the
gap changes too much, there is none and the other one has to do it.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

from .radau import NODES, WEIGHTS, Stage, Step

__all__ = ["GAMMA0", "INCREMENTS", "MATRIX", "Holding", "Short", "short_step"]

_Three = tuple[float, float, float]
_Round = tuple[_Three, _Three, _Three, _Three, float, Any]

_LONGEST = 0.02  # change of the gap within a step, at the speed it starts with
_LINEAR = 1e-8  # change of the gap over which a static force is a straight line
_SMOOTH = 1e-3  # change of the gap up to which the rule of the stages does for the work
_ROUNDS = 4


def _integrals(upto: float) -> tuple[float, float, float]:
    """Integrals from 0 of the three parabolas that are 1 at one node and 0 at the others."""
    found = []
    for i, node in enumerate(NODES):
        a, b = (other for j, other in enumerate(NODES) if j != i)
        area = upto**3 / 3.0 - 0.5 * (a + b) * upto**2 + a * b * upto
        found.append(area / ((node - a) * (node - b)))
    return found[0], found[1], found[2]


_C1, _C2, _ = NODES
MATRIX = tuple(map(_integrals, NODES))  # A of the method
(_A11, _A12, _A13), (_A21, _A22, _A23), (_A31, _A32, _A33) = _A = MATRIX
_AA = tuple(tuple(sum(_A[i][k] * _A[k][j] for k in range(3)) for j in range(3)) for i in range(3))
_B1, _B2, _B3 = WEIGHTS
_R6 = 6.0**0.5
GAMMA0 = 3.0 + 3.0 ** (2.0 / 3.0) - 3.0 ** (1.0 / 3.0)
INCREMENTS = (-13.0 - 7.0 * _R6) / 3.0, (-13.0 + 7.0 * _R6) / 3.0, -1.0 / 3.0
_E1, _E2, _E3 = INCREMENTS


class Holding(NamedTuple):
    """What acts on a mass: the net force is pull - spring (h - rest) - static - viscous [N].

    `pull` is called with a time [s], `static` with a gap [m], `viscous` with a gap and a speed
    [m/s]; it gives the force, and what limits it, if something does: else it is proportional to
    the speed.
    """

    pull: Callable[[float], float]
    static: Callable[[float], float]
    viscous: Callable[[float, float], tuple[float, Any]]
    spring: float
    rest: float


class Short(NamedTuple):
    """A step, the forces at its stages [N], and the work of the viscous one, if it is known [J]."""

    step: Step
    static: _Three
    viscous: _Three
    work: float | None


def short_step(
    holding: Holding,
    mass: float,
    start: Stage,
    dt: float,
    s: float,
    rtol: float,
    at_start: _Three,
    scale: float,
) -> Short | None:
    """Advance by `dt`, as `stiff_step.step` does with the same arguments; None if it is too long.

    `holding` stands for the net force. What is left of the iteration is a thousandth of `rtol`.
    """
    _, h0, v0 = start
    if s == 0.0 or abs(v0) * dt > _LONGEST * h0:
        return None
    inverse = _inverse(mass, h0, v0, dt, s, at_start)
    floor = min(1e-6 / dt, scale / h0)
    found = inverse and _rounds(holding, mass, start, dt, s, (1e-3 * rtol, floor), inverse)
    if not found:
        return None
    rates, speeds, static, viscous, acting, calls = found
    q, (one, two, three) = _stages(start, dt, s, rates)
    # The last change was of the size of rounding: along it forces are straight lines.
    forces = []
    for point, was, force in zip((one, two, three), speeds, viscous, strict=True):
        gap, speed = point.gap, point.speed
        if speed != was:
            force = force * (speed / was) if was and not acting else holding.viscous(gap, speed)[0]
        forces.append(force)
    errors = _errors(holding, mass, start, dt, s, at_start, q, (one, two, three))
    if errors is None:
        return None
    step = Step((one, two, three), q, s, errors[0], errors[1], calls + 1)
    f1, f2, f3 = forces
    work = None
    if abs(q[2]) < _SMOOTH:
        work = dt * (_B1 * f1 * one.speed + _B2 * f2 * two.speed + _B3 * f3 * three.speed)
    return Short(step, static, (f1, f2, f3), work)


def _stages(
    start: Stage, dt: float, s: float, rates: _Three
) -> tuple[_Three, tuple[Stage, Stage, Stage]]:
    """Coordinates and points of the stages."""
    t0, h0, _ = start
    r1, r2, r3 = rates
    q1 = dt * (_A11 * r1 + _A12 * r2 + _A13 * r3)
    q2 = dt * (_A21 * r1 + _A22 * r2 + _A23 * r3)
    q3 = dt * (_A31 * r1 + _A32 * r2 + _A33 * r3)
    b1, b2, b3, power = 1.0 - s * q1, 1.0 - s * q2, 1.0 - s * q3, -1.0 / s
    h1, h2, h3 = h0 * b1**power, h0 * b2**power, h0 * b3**power
    points = (
        Stage(t0 + _C1 * dt, h1, r1 * h1 / b1),
        Stage(t0 + _C2 * dt, h2, r2 * h2 / b2),
        Stage(t0 + dt, h3, r3 * h3 / b3),
    )
    return (q1, q2, q3), points


def _inverse(
    mass: float, h0: float, v0: float, dt: float, s: float, at_start: _Three
) -> tuple[float, ...] | None:
    """Inverse of the matrix of the stages, with the slopes at the start."""
    _, by_gap, by_speed = at_start
    swing = (1.0 + s) * v0
    x = mass * h0
    y = dt * (mass * swing - by_speed * h0)
    z = -dt * dt * (by_gap * h0 + by_speed * swing)
    (a, b, c), (d, e, f), (g, h, i) = (
        (y * row[0] + z * twice[0], y * row[1] + z * twice[1], y * row[2] + z * twice[2])
        for row, twice in zip(_A, _AA, strict=True)
    )
    a, e, i = a + x, e + x, i + x
    m0, m1, m2 = e * i - f * h, f * g - d * i, d * h - e * g
    det = a * m0 + b * m1 + c * m2
    if not abs(det) > 0.0 or det - det != 0.0:
        return None
    return (
        m0 / det,
        (c * h - b * i) / det,
        (b * f - c * e) / det,
        m1 / det,
        (a * i - c * g) / det,
        (c * d - a * f) / det,
        m2 / det,
        (b * g - a * h) / det,
        (a * e - b * d) / det,
    )


def _rounds(
    holding: Holding,
    mass: float,
    start: Stage,
    dt: float,
    s: float,
    enough: tuple[float, float],
    inverse: tuple[float, ...],
) -> tuple[_Three, _Three, _Three, _Three, Any, int] | None:
    """Rates of the stages; speeds and forces of the last round, what limits, and calls."""
    pull, spring, rest = holding.pull, holding.spring, holding.rest
    t0, h0, v0 = start
    p1, p2, p3 = pull(t0 + _C1 * dt), pull(t0 + _C2 * dt), pull(t0 + dt)
    i11, i12, i13, i21, i22, i23, i31, i32, i33 = inverse
    r1 = r2 = r3 = v0 / h0
    size, share, known = 0.0, 0.0, None
    for n in range(_ROUNDS):
        known = _round(holding, h0, dt, s, (r1, r2, r3), known)
        if known is None:
            return None
        (h1, h2, h3), (v1, v2, v3), (f1, f2, f3), (w1, w2, w3), _, acting = known
        n1 = p1 - spring * (h1 - rest) - f1 - w1
        n2 = p2 - spring * (h2 - rest) - f2 - w2
        n3 = p3 - spring * (h3 - rest) - f3 - w3
        m1 = mass * (v1 - v0) - dt * (_A11 * n1 + _A12 * n2 + _A13 * n3)
        m2 = mass * (v2 - v0) - dt * (_A21 * n1 + _A22 * n2 + _A23 * n3)
        m3 = mass * (v3 - v0) - dt * (_A31 * n1 + _A32 * n2 + _A33 * n3)
        d1 = i11 * m1 + i12 * m2 + i13 * m3
        d2 = i21 * m1 + i22 * m2 + i23 * m3
        d3 = i31 * m1 + i32 * m2 + i33 * m3
        r1, r2, r3 = r1 - d1, r2 - d2, r3 - d3
        before, size = size, max(abs(d1), abs(d2), abs(d3))
        if n:
            share = size / before
            if not share < 0.1:
                return None
        # What the next round would change, of the rates and of the momentum.
        met = share * size <= enough[0] * (abs(r1) + abs(r3) + enough[1])
        momentum = mass * abs(v3) + dt * (abs(n3) + abs(f3) + abs(w3))
        left = share * max(abs(m1), abs(m2), abs(m3))
        if size == 0.0 or (n and met and left <= 10.0 * enough[0] * momentum):
            return (r1, r2, r3), known[1], known[2], known[3], acting, 3 * n + 3
    return None


def _round(
    holding: Holding, h0: float, dt: float, s: float, rates: _Three, known: _Round | None
) -> _Round | None:
    """Gaps and speeds of the stages, static and viscous forces, the slope of those, and limits."""
    r1, r2, r3 = rates
    b1 = 1.0 - s * dt * (_A11 * r1 + _A12 * r2 + _A13 * r3)
    b2 = 1.0 - s * dt * (_A21 * r1 + _A22 * r2 + _A23 * r3)
    b3 = 1.0 - s * dt * (_A31 * r1 + _A32 * r2 + _A33 * r3)
    if not (0.5 < b1 < 2.0 and 0.5 < b2 < 2.0 and 0.5 < b3 < 2.0):
        return None
    power = -1.0 / s
    h1, h2, h3 = h0 * b1**power, h0 * b2**power, h0 * b3**power
    v1, v2, v3 = r1 * h1 / b1, r2 * h2 / b2, r3 * h3 / b3
    near = False
    if known is not None:
        (g1, g2, g3), _, (f1, f2, f3), _, slope, _ = known
        near = abs(h1 - g1) + abs(h2 - g2) + abs(h3 - g3) <= _LINEAR * h0
    if near:
        f1, f2, f3 = f1 + slope * (h1 - g1), f2 + slope * (h2 - g2), f3 + slope * (h3 - g3)
    else:
        static = holding.static
        f1, f2, f3 = static(h1), static(h2), static(h3)
        slope = (f3 - f1) / (h3 - h1) if h3 != h1 else 0.0
    viscous = holding.viscous
    (w1, a1), (w2, a2), (w3, a3) = viscous(h1, v1), viscous(h2, v2), viscous(h3, v3)
    return (h1, h2, h3), (v1, v2, v3), (f1, f2, f3), (w1, w2, w3), slope, a1 or a2 or a3


def _errors(
    holding: Holding,
    mass: float,
    start: Stage,
    dt: float,
    s: float,
    at_start: _Three,
    q: _Three,
    points: tuple[Stage, Stage, Stage],
) -> tuple[float, float] | None:
    """Estimates of the error of the gap's logarithm and of the speed; see `stiff_step`."""
    t0, h0, v0 = start
    force, by_gap, by_speed = at_start
    one, two, three = points
    j11, j12 = -v0 * (1.0 + s) / h0, 1.0 / h0
    j21, j22 = by_gap * h0 / mass, by_speed / mass
    g = GAMMA0 / dt
    det = (g - j11) * (g - j22) - j12 * j21
    zq = (_E1 * q[0] + _E2 * q[1] + _E3 * q[2]) / dt
    zv = (_E1 * (one.speed - v0) + _E2 * (two.speed - v0) + _E3 * (three.speed - v0)) / dt
    a, b = v0 / h0 + zq, force / mass + zv
    eq, ev = ((g - j22) * a + j12 * b) / det, (j21 * a + (g - j11) * b) / det
    base = 1.0 - s * eq
    if not 0.5 < base < 2.0:
        return None
    gap, speed = h0 * base ** (-1.0 / s), v0 + ev
    pull, static, viscous, spring, rest = holding
    net = pull(t0) - spring * (gap - rest) - static(gap) - viscous(gap, speed)[0]
    a, b = speed * base / gap + zq, net / mass + zv
    eq, ev = abs(((g - j22) * a + j12 * b) / det), abs((j21 * a + (g - j11) * b) / det)
    return (eq, ev) if eq + ev < float("inf") else None
