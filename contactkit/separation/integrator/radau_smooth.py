"""The step of `stiff_step` through a liquid between flats, where next to nothing changes.

A master steps an FMU some thousand times through what a few hundred steps would follow. While the
gap changes by a hundredth at most, the forces can be told beforehand. The viscous force falls as
a power of the gap, so in the coordinate of the film it is proportional to the rate, with a factor
that does not change at all. The static force is a short Taylor series, corrected by value and
slope at the end, where they are needed anyway. So the stages are solved in one round of plain
arithmetic, and the forces are evaluated once; further rounds follow where one may leave more than
the caller allows. Only where a limit of the liquid acts is the viscous force asked for in each.

The answer is that of `stiff_step.step`, to the accuracy that is asked of the rounds; where it may
not be, there is none.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from .radau import NODES, WEIGHTS
from .radau_short import GAMMA0, INCREMENTS, MATRIX

__all__ = [
    "Even",
    "Here",
    "Matrix",
    "Problem",
    "Stages",
    "Three",
    "inverse",
    "moved",
    "moved_by_powers",
    "smooth_step",
    "still",
]

Three = tuple[float, float, float]
Matrix = tuple[float, float, float, float, float]
Stages = tuple[Three, Three, Three, Three]
"""Rates, coordinates, shares by which the gap grows, and speeds over the gap."""

Problem = tuple[
    float, float, float, float, float, float, float, float, float, float, float, float, Any
]
"""Numbers, by their place:

0 mass times gap; 1 rate of the start; 2 length of the step; 3 s; 4 slope of the viscous force
over the rate; 5 that over the coordinate; 6 viscous force and 7 net force without it, at the
start; 8 rate of the pull; 9 slope of spring and static force over the share of the gap; 10 half
the second derivative of that force; 11 n if the viscous force falls, as s is that of the gap;
12 limit that acts, with its force and the gap
"""

_C1, _C2, _ = NODES
(_A11, _A12, _A13), (_A21, _A22, _A23), (_A31, _A32, _A33) = MATRIX

# A has a real eigenvalue and a pair; each has a projection, a column times a row.
_REAL = 1.0 / GAMMA0
_PART = 0.5 * (0.6 - _REAL)
_PAIR = complex(_PART, (1.0 / (60.0 * _REAL) - _PART * _PART) ** 0.5)
_PAIR_X, _PAIR_Y = _PAIR.real, _PAIR.imag
_PAIR2_X, _PAIR2_Y = (_PAIR * _PAIR).real, (_PAIR * _PAIR).imag


def _projection(one: complex, a: complex, b: complex) -> tuple[list[complex], list[complex]]:
    """Column and row whose product projects on the eigenvector of `one` of three eigenvalues."""
    left, right = (
        [[MATRIX[i][j] - (other if i == j else 0.0) for j in range(3)] for i in range(3)]
        for other in (a, b)
    )
    scale = (one - a) * (one - b)
    found = [
        [sum(left[i][k] * right[k][j] for k in range(3)) / scale for j in range(3)]
        for i in range(3)
    ]
    return [line[2] / found[2][2] for line in found], found[2]


_column, _row = _projection(_REAL, _PAIR, _PAIR.conjugate())
_U1, _U2, _ = (part.real for part in _column)
_W1, _W2, _W3 = (part.real for part in _row)
_column, _row = _projection(_PAIR, _REAL, _PAIR.conjugate())
_P1, _P2, _ = (part.real for part in _column)
_Q1, _Q2, _ = (part.imag for part in _column)
_X1, _X2, _X3 = (2.0 * part.real for part in _row)  # twice: for the other one of the pair
_Y1, _Y2, _Y3 = (2.0 * part.imag for part in _row)


def _powers(row: Three) -> Three:
    """A row times the first three powers of the nodes."""
    one, two, three = (
        sum(part * node**n for part, node in zip(row, NODES, strict=True)) for n in (1, 2, 3)
    )
    return one, two, three


_W_1, _W_2, _W_3 = _powers((_W1, _W2, _W3))
_X_1, _X_2, _X_3 = _powers((_X1, _X2, _X3))
_Y_1, _Y_2, _Y_3 = _powers((_Y1, _Y2, _Y3))


def still(problem: Problem) -> Stages:
    """Stages at the rate of the start."""
    _, r, dt, s, *_ = problem
    q1, q2, q3, power = _C1 * dt * r, _C2 * dt * r, dt * r, -1.0 / s
    b1, b2, b3 = 1.0 - s * q1, 1.0 - s * q2, 1.0 - s * q3
    e1, e2, e3 = b1**power, b2**power, b3**power
    shares = e1 - 1.0, e2 - 1.0, e3 - 1.0
    return (r, r, r), (q1, q2, q3), shares, (r * e1 / b1, r * e2 / b2, r * e3 / b3)


def inverse(problem: Problem) -> Matrix:
    """Inverse of the matrix of the stages on the eigenvectors of A, its size, and its changes.

    The last is what a round leaves of what was left before it, over the change of the gap.
    """
    inertia, r0, dt, s, drag, swing, _, _, _, stiff, half, n, _ = problem
    g = (1.0 + s) * inertia
    y, z = dt * (g * r0 + drag), dt * dt * (stiff + swing)
    a = inertia + y * _PAIR_X + z * _PAIR2_X
    b = y * _PAIR_Y + z * _PAIR2_Y
    size, weight = a * a + b * b, inertia + _REAL * y
    change = dt * dt * ((1.0 + s) * abs(stiff) + 2.0 * abs(half))
    curved = 2.0 * (g + change + n * dt * drag * (1.0 + abs(r0 * dt))) / weight
    return 1.0 / (weight + z * _REAL * _REAL), a / size, b / size, weight, curved


def moved_by_powers(problem: Problem, matrix: Matrix, rate: float, left: Three) -> Stages | None:
    """Do as `moved` from one rate [1/s], where what is left [N.s] is a polynomial of the node.

    `left` has the coefficients of its first three powers.
    """
    a, b, c = left
    return _turned(
        problem,
        matrix,
        (rate, rate, rate),
        a * _W_1 + b * _W_2 + c * _W_3,
        a * _X_1 + b * _X_2 + c * _X_3,
        a * _Y_1 + b * _Y_2 + c * _Y_3,
    )


def moved(problem: Problem, matrix: Matrix, rates: Three, left: Three) -> Stages | None:
    """Stages after a round of Newton's from rates [1/s] with so much left of the momentum [N.s].

    None if the gap changes by more than the coordinate can say.
    """
    a, b, c = left
    return _turned(
        problem,
        matrix,
        rates,
        _W1 * a + _W2 * b + _W3 * c,
        _X1 * a + _X2 * b + _X3 * c,
        _Y1 * a + _Y2 * b + _Y3 * c,
    )


def _turned(
    problem: Problem, matrix: Matrix, rates: Three, w: float, x: float, y: float
) -> Stages | None:
    """Stages after a round whose momentum left over, on the eigenvectors, is w and x + iy."""
    dt, s = problem[2:4]
    (one, a, b, _, _), (r1, r2, r3) = matrix, rates
    w, x, y = one * w, a * x + b * y, a * y - b * x
    r1, r2, r3 = r1 - (_U1 * w + _P1 * x - _Q1 * y), r2 - (_U2 * w + _P2 * x - _Q2 * y), r3 - w - x
    q1 = dt * (_A11 * r1 + _A12 * r2 + _A13 * r3)
    q2 = dt * (_A21 * r1 + _A22 * r2 + _A23 * r3)
    q3 = dt * (_A31 * r1 + _A32 * r2 + _A33 * r3)
    if not (-0.9 < s * q1 < 0.9 and -0.9 < s * q2 < 0.9 and -0.9 < s * q3 < 0.9):
        return None
    if s == -1.0:  # the coordinate is the gap
        return (r1, r2, r3), (q1, q2, q3), (q1, q2, q3), (r1, r2, r3)
    b1, b2, b3, power = 1.0 - s * q1, 1.0 - s * q2, 1.0 - s * q3, -1.0 / s
    e1, e2, e3 = b1**power, b2**power, b3**power
    shares = e1 - 1.0, e2 - 1.0, e3 - 1.0
    return (r1, r2, r3), (q1, q2, q3), shares, (r1 * e1 / b1, r2 * e2 / b2, r3 * e3 / b3)


_Once = tuple[Stages, float, float, float]  # and change of the gap, momentum before, and after

Here = tuple[float, float, float, float, float, float, float, float]
"""What a film without limits does at a gap: plain, as one is made in every step.

Gap [m]; static force, its slope times the gap, its second derivative times the gap squared [N];
viscous force per speed [N.s/m], and n with which it falls as gap^-n, exactly; and the gaps between
which there is no kink [m].
"""

Limited = Callable[[float, float], tuple[float, Any]]

Even = tuple[float, float, Three, Three, float, float, float, float, float, int]
"""Where a step leads.

Gap [m] and speed [m/s]; static and viscous force at the stages [N]; the work of the viscous one
[J]; estimated errors of the logarithm of the gap [-] and of the speed [m/s]; and at the start the
viscous force [N], and its slope over the rate of the gap's logarithm [N.s]; evaluations.
"""

_LONGEST = 1e-2  # change of the gap within a step
_FLIGHT = 0.5  # the same where no film acts, so that all is linear
_TURNING = 1e-5  # the same where the stages turn back, so that the end tells nothing of them
_SEEN = 1e-12  # share of a force that counts
_ROUNDS = 4

_C1, _C2, _ = NODES
(_A11, _A12, _A13), (_A21, _A22, _A23), (_A31, _A32, _A33) = MATRIX
_B1, _B2, _B3 = WEIGHTS
_E1, _E2, _E3 = INCREMENTS
_E123 = _E1 + _E2 + _E3


def smooth_step(
    mass: float,
    begin: Here,
    speed: float,
    dt: float,
    drive: tuple[float, float, float, float],
    at: Callable[[float], Here | None],
    enough: tuple[float, float],
    limited: Limited | None = None,
) -> Even | None:
    """Advance by `dt`; None if it is too long for this, or a kink is on the way.

    Parameters
    ----------
    mass : float
        Mass [kg].
    begin : Here
        The film at the start.
    speed, dt : float
        Speed at the start [m/s] and length of the step [s].
    drive : tuple of 4 floats
        Pull at the start [N], its rate [N/s], stiffness of the spring [N/m] and the gap at which
        that is at rest [m].
    at : callable
        The film at a gap [m]; None where nothing of the kind can be said.
    enough : tuple of 2 floats
        What the rounds may leave, relative to rates [-]; and rate that does not count [1/s].
    limited : callable, optional
        The viscous force [N] at a gap [m] and a speed [m/s] under the limits of the liquid, and
        what limits it, if something does; the same all along the step.

    Examples
    --------
    A mass that nothing holds:

    >>> nothing = (1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, float("inf"))
    >>> drive = 4.0, 0.0, 0.0, 0.0
    >>> found = smooth_step(2.0, nothing, 0.0, 1e-2, drive, lambda gap: nothing, (1e-11, 0.0))
    >>> round(found[0], 12), round(found[1], 12)
    (1.0001, 0.02)
    """
    gap, static, slope, bend, drag, _, low, high = begin
    longest = _LONGEST if drag > 0.0 or static or slope else _FLIGHT
    if abs(speed) * dt > longest * gap:
        return None
    problem = _pose(mass, begin, speed, dt, drive, limited, enough[1])
    acts = problem[12] is not None
    matrix, series, before = inverse(problem), (0.0, 0.0), 0.0
    once = _round(problem, matrix, still(problem), series) if acts else _first(problem, matrix)
    for n in range(_ROUNDS):
        if once is None:
            return None
        found, far, size, left = once
        z3 = found[2][2]
        end = gap + gap * z3
        if not low <= end < high or far > longest or (before and not size < 0.1 * before):
            return None
        if acts:  # how fast the matrix changes is not known beforehand
            left = size * size / before if before else math.inf
        slack = _slack(problem, matrix[3], found, enough) - left
        if slack > 0.0:
            there, turns = at(end), abs(z3) < 0.5 * far
            if there is None or (turns and far > _TURNING):
                return None
            missed = there[1] - (static + z3 * (slope + 0.5 * z3 * bend))
            is_met = dt * abs(missed - z3 * z3 * z3 * (series[0] + z3 * series[1])) <= slack
            if abs(missed) > _SEEN * (abs(static) + abs(slope)) and not turns:
                series = _next_terms(z3, missed, there[2] / (1.0 + z3) - slope - z3 * bend)
                if dt * abs(series[1] * z3**5) > slack:
                    return None
            if is_met:
                if limited is not None and not acts and not _is_bare(limited, gap, found):
                    return None
                calls = 3 * n + 10 if acts else 1 if limited is None else 5
                return _end(problem, found, begin, series, there[1], calls)
            if turns:
                return None
        before = size
        once = _round(problem, matrix, found, series)
    return None


def _pose(
    mass: float,
    begin: Here,
    speed: float,
    dt: float,
    drive: tuple[float, float, float, float],
    limited: Limited | None,
    floor: float,
) -> Problem:
    """Work out the numbers of the step; see `Problem`."""
    gap, static, slope, bend, drag, n, _, _ = begin
    pull, rate, spring, rest = drive
    first, by_gap, bound = drag * speed, -n * drag * speed, None
    if limited is not None:
        first, acting = limited(gap, speed)
        if acting is not None:
            near, dv = 1e-7 * gap, 1e-7 * (abs(speed) + 1e-3 * floor * gap)
            by_gap = (limited(gap + near, speed)[0] - first) / 1e-7
            drag = (limited(gap, speed + dv)[0] - first) / dv
            bound = limited, acting, gap
    # In terms of the viscous impulse where the film rules, else of the gap; see `stiff_step`.
    rules = drag * dt > mass
    s = n - 1.0 if rules else -1.0
    return (
        mass * gap,
        speed / gap,
        dt,
        s,
        drag * gap,
        by_gap + (1.0 + s) * drag * speed,
        first,
        pull - spring * (gap - rest) - static,
        rate,
        spring * gap + slope,
        0.5 * bend,
        0.0 if rules else n,
        bound,
    )


def _next_terms(share: float, missed: float, slid: float) -> tuple[float, float]:
    """Third and fourth term of a series that misses so much of a force and of its slope."""
    return (4.0 * missed - slid * share) / share**3, (slid * share - 3.0 * missed) / share**4


def _is_bare(limited: Limited, gap: float, found: Stages) -> bool:
    """Whether no limit acts at any stage."""
    _, _, shares, speeds = found
    for z, v in zip(shares, speeds, strict=True):
        if limited(gap + gap * z, gap * v)[1] is not None:
            return False
    return True


def _slack(problem: Problem, weight: float, found: Stages, enough: tuple[float, float]) -> float:
    """What may be left of the momentum [N.s]: enough of the rates, and of the momentum itself."""
    (r1, _, r3), (share, floor) = found[0], enough
    by_rates = weight * (abs(r1) + abs(r3) + floor)
    forces = abs(problem[6]) + abs(problem[7])
    by_momentum = 10.0 * (problem[0] * abs(r3) + problem[2] * forces)
    return share * (by_rates if by_rates < by_momentum else by_momentum)


def _first(problem: Problem, matrix: Matrix) -> _Once | None:
    """First round, from a rate that stays: what it leaves is a polynomial of the node.

    Its first three powers are kept, which A integrates exactly but for the last.
    """
    inertia, r0, dt, s, _, swing, first, net, rate, stiff, half, n, _ = problem
    if n:  # the viscous force falls
        stiff, half = stiff + swing, half - 0.5 * (n + 1.0) * swing
    x, g = dt * r0, 1.0 + s
    one = inertia * r0 * g * x
    two = one * (0.5 + s) * x
    three = two * (1.0 + 3.0 * s) * x / 3.0
    net -= first
    bent = dt * x * x * (0.5 * g * stiff + half) / 3.0
    a1, a2, a3 = one - dt * net, two - 0.5 * dt * (rate * dt - stiff * x), three + bent
    found = moved_by_powers(problem, matrix, r0, (a1, a2, a3))
    if found is None:
        return None
    size = abs(a1) + abs(a2) + abs(a3)
    q1, q2, q3 = found[1]
    far = abs(q3)
    if not abs(q1) <= abs(q2) <= far:
        far = max(abs(q1), abs(q2), far)
    cut = abs(x) * ((0.25 + s) * abs(three) + (g + n) * (abs(bent) + abs(dt * x * x * stiff)))
    return found, far, size, far * matrix[4] * size + cut


def _round(
    problem: Problem, matrix: Matrix, found: Stages, series: tuple[float, float]
) -> _Once | None:
    """One more round of Newton's, with the matrix of the start."""
    inertia, r0, dt, _, _, _, _, net, rate, stiff, half, _, _ = problem
    _, _, (z1, z2, z3), (v1, v2, v3) = found
    viscous = _viscous(problem, found)
    if viscous is None:
        return None
    (w1, w2, w3), (cube, fourth) = viscous, series
    n1 = net + _C1 * dt * rate - z1 * (stiff + z1 * (half + z1 * (cube + z1 * fourth))) - w1
    n2 = net + _C2 * dt * rate - z2 * (stiff + z2 * (half + z2 * (cube + z2 * fourth))) - w2
    n3 = net + dt * rate - z3 * (stiff + z3 * (half + z3 * (cube + z3 * fourth))) - w3
    m1 = inertia * (v1 - r0) - dt * (_A11 * n1 + _A12 * n2 + _A13 * n3)
    m2 = inertia * (v2 - r0) - dt * (_A21 * n1 + _A22 * n2 + _A23 * n3)
    m3 = inertia * (v3 - r0) - dt * (_A31 * n1 + _A32 * n2 + _A33 * n3)
    again = moved(problem, matrix, found[0], (m1, m2, m3))
    if again is None:
        return None
    q1, q2, q3 = again[1]
    far, size = max(abs(q1), abs(q2), abs(q3)), max(abs(m1), abs(m2), abs(m3))
    return again, far, size, far * matrix[4] * size


def _viscous(problem: Problem, found: Stages) -> Three | None:
    """Viscous force at the stages [N]; None if another limit acts there."""
    drag, n, bound = problem[4], problem[11], problem[12]
    (r1, r2, r3), _, (z1, z2, z3), (v1, v2, v3) = found
    if bound is not None:
        limited, acting, gap = bound
        w1, one = limited(gap + gap * z1, gap * v1)
        w2, two = limited(gap + gap * z2, gap * v2)
        w3, three = limited(gap + gap * z3, gap * v3)
        return (w1, w2, w3) if one is acting and two is acting and three is acting else None
    if not n:
        return drag * r1, drag * r2, drag * r3
    return drag * r1 * (1.0 + z1) ** -n, drag * r2 * (1.0 + z2) ** -n, drag * r3 * (1.0 + z3) ** -n


def _end(
    problem: Problem,
    found: Stages,
    begin: Here,
    series: tuple[float, float],
    last: float,
    calls: int,
) -> Even | None:
    """Read the forces at the stages, and the errors."""
    inertia, r0, dt, s, drag, swing, first, net, _, stiff, half, _, _ = problem
    _, (q1, q2, q3), (z1, z2, z3), (v1, v2, v3) = found
    gap, static, slope, *_ = begin
    cube, fourth = series
    forces = (
        static + z1 * (slope + z1 * (half + z1 * (cube + z1 * fourth))),
        static + z2 * (slope + z2 * (half + z2 * (cube + z2 * fourth))),
        last,
    )
    viscous = _viscous(problem, found)
    if viscous is None:
        return None
    w1, w2, w3 = viscous
    work = dt * gap * (_B1 * w1 * v1 + _B2 * w2 * v2 + _B3 * w3 * v3)
    # The estimate of `stiff_step`, times dt, twice filtered; gap and speed are over the gap here.
    g, back = GAMMA0, dt * dt * ((1.0 + s) * drag * r0 - swing - stiff) / inertia
    j1, j2 = g + dt * (1.0 + s) * r0, g + dt * drag / inertia
    det = j1 * j2 - back
    a = dt * r0 + _E1 * q1 + _E2 * q2 + _E3 * q3
    b = dt * (dt * (net - first) / inertia + _E1 * v1 + _E2 * v2 + _E3 * v3 - _E123 * r0)
    a, b = (j2 * a + b) / det, (back * a + j1 * b) / det
    eq, ev = abs(g * (j2 * a + b) / det), abs(g * (back * a + j1 * b) / det)
    if not eq + ev < 1e-4:
        return None
    end, error = gap + gap * z3, gap * ev / dt
    return end, gap * v3, forces, viscous, work, eq, error, first, drag, calls
