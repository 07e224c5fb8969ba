r"""The implicit step of a mass on a film of any stiffness: Radau IIA with three stages.

.. math:: m \dot v = F(t) - k (h - h_s) - F_s(h) - F_v(h, v), \qquad \dot h = v

The method is L-stable and of fifth order, so that a film with :math:`c/m` of 1e12 1/s sets no
limit on the step. The gap is not the unknown. It is written

.. math:: h = h_n \, (1 - s q)^{-1/s}, \qquad q(t_n) = 0

and the stages are solved for the rate of q. With :math:`s = -1`, q is the travel over the gap.
With :math:`c \propto h^{-(s+1)}`, q is proportional to the viscous impulse, which grows linearly
while the film carries the pull: the gap may then multiply within one step, and the equations of
a stage stay monotone where those written in h have a fold and lose the physical root.

The stages of the problem that is linear at the start are the first guess; Newton's method follows,
with the slopes of the forces at each stage. The kernel of the native FMUs is the same algorithm.
Plain floats only: this runs inside an FMU.

References
----------
Hairer and Wanner, Solving Ordinary Differential Equations II (1996), section IV.8, for the
method and its error estimate.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

from ...numerics.radau_tableau import BACK, BACK_SLOPE, END_SLOPE, ERROR, GAMMA, NODES, STAGES
from ...numerics.three import Three, solved_three

__all__ = [
    "Forces",
    "Memory",
    "MotionPoint",
    "StepProblem",
    "Step",
    "against_halves",
    "coordinate",
    "relative_error",
    "step",
]

_C1, _C2, _ = NODES
_E1, _E2, _E3 = ERROR

# Newton takes up to six in 84 releases, from 1e-4 to 100 Pa.s and 10 nm to 0.1 mm, with limits and
# cavities: 6 to 48 take the same steps. Beyond five a change that grows ends the try anyway.
_MOST_ITERATIONS = 12
_LINEAR = 1e-4  # relative change over which the slopes at the start are good enough
_FAR = 0.5  # change of the coordinate beyond which they give no useful guess
# By how much more the speed bends at the end of a step than where the estimate sees it. Speeds of
# 300 pulls were off by up to 5 tolerances with 1, by up to 2 with 3, which costs 5 % more steps.
_RISING = 3.0
_FAST = 2.0  # growth of the gap in a step above which the lag of its end is looked at by itself
_LEFT = 0.1 / _RISING  # fraction of what is left of a transient that counts
_TRAVEL = 1e-2  # fraction of the gap; the impulse of less is not known to the tolerance
_IMPULSE = 0.1  # of an estimate that is 20 to 2000 times the error of the viscous impulse
_ROUND_OFF = 1e-6  # change of the rates below which an iteration that stalls has converged


class MotionPoint(NamedTuple):
    """A point of the motion: time [s], gap [m], speed [m/s]."""

    time: float
    gap: float
    speed: float


class Forces(NamedTuple):
    """Forces that resist opening at a gap and a speed [N], and their slopes [N/m], [N.s/m].

    `static` is what they are at rest, `viscous` what the speed adds. That is known to be
    proportional to the speed where `limit` is None; otherwise `limit` names the law that bounds it,
    or says that none does, by any object.
    """

    static: float
    static_by_gap: float
    viscous: float
    viscous_by_gap: float
    viscous_by_speed: float
    limit: Any = None


class Memory(NamedTuple):
    """Forces with a memory at the stages of a step.

    `error` [-] is that of what is remembered at its end, and `found` what is to be kept of it.
    """

    forces: tuple[Forces, Forces, Forces]
    error: float
    found: Any


class StepProblem(NamedTuple):
    """Equation of motion of one step, its initial point, and the scales of its errors."""

    mass: float  # [kg]
    pull: Callable[[float], float]  # [N] at a time [s]
    stiffness: float  # of a spring [N/m]
    slack_gap: float  # at which the spring is slack [m]
    forces: Callable[[float, float], Forces]  # at a gap [m] and a speed [m/s]
    has_limits: bool  # whether slopes may jump with the speed, as where a limit sets in
    exponent: float  # n of the damping, which falls as gap^-n
    begin: MotionPoint
    first: Forces  # at the start
    rtol: float
    size: float  # sum of the forces that deliver momentum [N]; those that cancel count too
    delivered: float  # momentum delivered so far [N.s]
    scale: float  # speed at which the film balances the other forces [m/s]
    # Forces with a memory: of a length [s], and gap [m] and speed [m/s] at each stage.
    remembered: Callable[[float, Sequence[tuple[float, float]]], Memory | None] | None = None
    taken: float = math.inf  # viscous impulse so far [N.s]; infinite: not to be known

    def net(self, pull: float, gap: float, forces: Forces) -> float:
        """Net force on the mass [N]."""
        held = self.stiffness * (gap - self.slack_gap)
        return pull - held - (forces.viscous + forces.static)


class Step(NamedTuple):
    """A step that was solved.

    `coordinates` are q at the stages and `exponent` is s. The errors are estimates: of the
    logarithm of the gap [-] and of the speed [m/s].
    """

    stages: tuple[MotionPoint, MotionPoint, MotionPoint]
    forces: tuple[Forces, Forces, Forces]
    coordinates: tuple[float, float, float]
    exponent: float
    gap_error: float
    speed_error: float
    evaluations: int
    memory: Memory | None = None


# The innermost records are plain tuples: NamedTuples of Python cost a tenth of a doStep here.
_Stage = tuple[float, float, float, float, float]
"""A stage for some rate of q: q [-], gap [m], speed [m/s], slope of the gap over q [m], and
`swing`, the rate times the curvature of the gap over q [m/s]."""

_Line = tuple[float, float, float, float, float, float]
"""What the equation of a stage is made of: speed, slope and swing of the stage, and the net force
on the mass [N] with its slopes over the gap [N/m] and the speed [N.s/m]."""


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


def step(problem: StepProblem, dt: float, s: float | None = None) -> Step | None:
    """Try a step of length `dt` [s]; None if its stages are not found: a shorter one may do.

    Parameters
    ----------
    problem : StepProblem
        What is solved.
    dt : float
        Length of the step [s].
    s : float, optional
        Exponent of the coordinate, see the head of this module; if not given, that of the viscous
        impulse where the film rules the motion, else that of the gap.
    """
    mass, begin, scale, rtol = problem.mass, problem.begin, problem.scale, problem.rtol
    if s is None:
        rules = problem.exponent > 0.0 and problem.first.viscous_by_speed * dt > mass
        s = problem.exponent - 1.0 if rules else -1.0
    pull, t0 = problem.pull, begin.time
    pulls = pull(t0 + _C1 * dt), pull(t0 + _C2 * dt), pull(t0 + dt)
    # Rates below this do not count: nothing of the gap per step, or of the creep of the film.
    floor = min(1e-6 / dt, scale / begin.gap)
    rates, size = _first_guess(problem, dt, s, pulls, floor)
    for iteration in range(_MOST_ITERATIONS):
        stages = _stages(begin.gap, dt, s, rates)
        if stages is None:
            return None
        places = [(gap, speed) for _, gap, speed, _, _ in stages]
        memory = None
        if problem.remembered is None:
            found: Sequence[Forces] = [problem.forces(gap, speed) for gap, speed in places]
        else:
            memory = problem.remembered(dt, places)
            if memory is None:
                return None
            found = memory.forces
        lines = [_line(problem, *one) for one in zip(stages, found, pulls, strict=True)]
        solved = _newton(mass, dt, begin.speed, lines)
        if solved is None:
            return None
        residual, change = solved
        rates = rates[0] - change[0], rates[1] - change[1], rates[2] - change[2]
        previous, size = size, _largest(change) / (_largest(rates) + floor)
        contraction = 1.0  # by how much the next change would be smaller than this one
        if size < previous < math.inf:
            contraction = size / previous
            if contraction < 0.1 and not problem.has_limits:  # forces are smooth: quadratic
                contraction *= 10.0 * contraction
        left, momentum = _largest(residual), _momentum(mass, dt, scale, lines)
        is_met = contraction * size <= 0.03 * rtol and contraction * left <= rtol * momentum
        is_stalled = iteration > 1 and previous <= size < _ROUND_OFF
        if is_met or (is_stalled and left <= 1e-7 * momentum):
            done = _finished(problem, dt, s, rates, (stages, found), 3 * iteration + 3)
            return done if done is None or memory is None else done._replace(memory=memory)
        if iteration > 5 and size > previous:
            return None
    return None


def _largest(values: Sequence[float]) -> float:
    a, b, c = values
    return max(abs(a), abs(b), abs(c))


def _first_guess(
    problem: StepProblem, dt: float, s: float, pulls: Three, floor: float
) -> tuple[Three, float]:
    """Rates of the stages of the problem that is linear at the start, and how far they lead.

    The rate at the start, and infinity, where that is too far to be of any use.
    """
    _, gap, speed = problem.begin
    first, rate, swing = problem.first, speed / gap, (1.0 + s) * speed
    by_gap = -problem.stiffness - first.static_by_gap - first.viscous_by_gap
    by_speed = -first.viscous_by_speed
    lines = []
    for node, pull in zip(NODES, pulls, strict=True):
        dq = node * dt * rate
        dv = swing * dq
        net = problem.net(pull, gap, first) + by_gap * gap * dq + by_speed * dv
        lines.append((speed + dv, gap, swing, net, by_gap, by_speed))
    solved = _newton(problem.mass, dt, speed, lines)
    if solved is None:
        return (rate, rate, rate), math.inf
    a, b, c = change = solved[1]
    rates = rate - a, rate - b, rate - c
    reach = dt * _largest(rates)
    if not reach < _FAR:
        return (rate, rate, rate), math.inf
    return rates, _largest(change) / (_largest(rates) + floor) + reach


def _stages(gap: float, dt: float, s: float, rates: Three) -> list[_Stage] | None:
    """Stages for rates of the coordinate [1/s]; None where one is outside its range."""
    found = []
    for row, rate in zip(STAGES, rates, strict=True):
        q = dt * (row[0] * rates[0] + row[1] * rates[1] + row[2] * rates[2])
        place = coordinate(gap, s, q)
        if place is None or not 1e-100 < place[0] < math.inf:
            return None
        h, first, second = place
        found.append((q, h, rate * first, first, rate * second))
    return found


def _line(problem: StepProblem, stage: _Stage, forces: Forces, pull: float) -> _Line:
    """Net force on the mass at a stage, with its slopes."""
    _, gap, speed, by_q, swing = stage
    by_gap = -problem.stiffness - forces.static_by_gap - forces.viscous_by_gap
    net = problem.net(pull, gap, forces)
    return speed, by_q, swing, net, by_gap, -forces.viscous_by_speed


def _newton(
    mass: float, dt: float, speed: float, lines: Sequence[_Line]
) -> tuple[Three, Three] | None:
    """Residual m (v_i - v_0) - dt sum(a_ij F_j) of the stages, and the change of rates it asks for.

    None if the matrix is singular, or a force is not finite.
    """
    (v1, p1, w1, n1, g1, d1), (v2, p2, w2, n2, g2, d2), (v3, p3, w3, n3, g3, d3) = lines
    # d F_j / d rate_k is both_j a_jk, through the gap of the stage, and own_j on the diagonal.
    both1, both2, both3 = (
        dt * (g1 * p1 + d1 * w1),
        dt * (g2 * p2 + d2 * w2),
        dt * (g3 * p3 + d3 * w3),
    )
    own1, own2, own3 = d1 * p1, d2 * p2, d3 * p3
    (a11, a12, a13), (a21, a22, a23), (a31, a32, a33) = STAGES
    u, v, w, inertia = a11 * both1, a12 * both2, a13 * both3, mass * w1
    a0 = mass * p1 + dt * (a11 * (inertia - own1) - (u * a11 + v * a21 + w * a31))
    a1 = dt * (a12 * (inertia - own2) - (u * a12 + v * a22 + w * a32))
    a2 = dt * (a13 * (inertia - own3) - (u * a13 + v * a23 + w * a33))
    u, v, w, inertia = a21 * both1, a22 * both2, a23 * both3, mass * w2
    b0 = dt * (a21 * (inertia - own1) - (u * a11 + v * a21 + w * a31))
    b1 = mass * p2 + dt * (a22 * (inertia - own2) - (u * a12 + v * a22 + w * a32))
    b2 = dt * (a23 * (inertia - own3) - (u * a13 + v * a23 + w * a33))
    u, v, w, inertia = a31 * both1, a32 * both2, a33 * both3, mass * w3
    c0 = dt * (a31 * (inertia - own1) - (u * a11 + v * a21 + w * a31))
    c1 = dt * (a32 * (inertia - own2) - (u * a12 + v * a22 + w * a32))
    c2 = mass * p3 + dt * (a33 * (inertia - own3) - (u * a13 + v * a23 + w * a33))
    x = mass * (v1 - speed) - dt * (a11 * n1 + a12 * n2 + a13 * n3)
    y = mass * (v2 - speed) - dt * (a21 * n1 + a22 * n2 + a23 * n3)
    z = mass * (v3 - speed) - dt * (a31 * n1 + a32 * n2 + a33 * n3)
    change = solved_three((a0, a1, a2), (b0, b1, b2), (c0, c1, c2), (x, y, z))
    return None if change is None else ((x, y, z), change)


def _momentum(mass: float, dt: float, scale: float, lines: Sequence[_Line]) -> float:
    """Momentum that mass and film take within a step [N.s], against which a residual is small.

    The rates alone do not tell: a stiff film carries its force at next to no speed.
    """
    found = 0.0
    for speed, _, _, net, _, by_speed in lines:
        carried = abs(by_speed) * (abs(speed) + scale)  # by the film, moving or in balance
        found = max(found, mass * abs(speed) + dt * (abs(net) + carried))
    return found


def _finished(
    problem: StepProblem,
    dt: float,
    s: float,
    rates: Three,
    last: tuple[Sequence[_Stage], Sequence[Forces]],
    evaluations: int,
) -> Step | None:
    """Read the stages off the rates, forces moved along from the last iteration, and the errors."""
    (t0, h0, v0), mass, first = problem.begin, problem.mass, problem.first
    stages = _stages(h0, dt, s, rates)
    if stages is None:
        return None
    (q1, h1, v1, _, _), (q2, h2, v2, _, _), (q3, h3, v3, _, _) = stages
    points = (
        MotionPoint(t0 + _C1 * dt, h1, v1),
        MotionPoint(t0 + _C2 * dt, h2, v2),
        MotionPoint(t0 + dt, h3, v3),
    )
    f1, f2, f3 = (_moved(*move) for move in zip(last[1], last[0], stages, strict=True))
    # (gamma0/dt - J) err = f(start) + sum(e_i z_i)/dt in the unknowns (q, v); q = 0 at the start.
    by_gap = -problem.stiffness - first.static_by_gap - first.viscous_by_gap
    j11, j12 = -v0 * (1.0 + s) / h0, 1.0 / h0
    j21, j22 = by_gap * h0 / mass, -first.viscous_by_speed / mass
    g = GAMMA / dt
    det = (g - j11) * (g - j22) - j12 * j21
    zq = (_E1 * q1 + _E2 * q2 + _E3 * q3) / dt
    zv = (_E1 * (v1 - v0) + _E2 * (v2 - v0) + _E3 * (v3 - v0)) / dt

    def estimate(rate: float, acceleration: float) -> tuple[float, float]:
        a, b = rate + zq, acceleration + zv
        return ((g - j22) * a + j12 * b) / det, (j21 * a + (g - j11) * b) / det

    pulled = problem.pull(t0)
    eq, ev = estimate(v0 / h0, problem.net(pulled, h0, first) / mass)
    place = coordinate(h0, s, eq)
    if place is not None and place[0] > 0.0 and math.isfinite(place[0] + ev):
        # The second estimate, from where the first one leads, ignores what decays at once.
        net = _net_near(problem, pulled, place[0], v0 + ev)
        eq, ev = estimate((v0 + ev) / place[1], net / mass)
    eq *= stages[2][3] / h3  # of the gap: at the end it grows faster with q than at the start
    ev = _speed_error(problem, dt, h3, (v1, v2, v3), f3, problem.net(pulled, h0, first) / mass, zv)
    if not math.isfinite(eq + ev):
        return None
    return Step(points, (f1, f2, f3), (q1, q2, q3), s, abs(eq), ev, evaluations)


def _speed_error(
    problem: StepProblem, dt: float, gap: float, speeds: Three, end: Forces, a0: float, zv: float
) -> float:
    """Error of the speed at the end of a step [m/s]: the smaller of two estimates, each safe.

    Both say how far the start is from a parabola through the stages: the first one that of the
    accelerations (`a0` at the start), the other one that of the `speeds`. The film at the *end*
    holds the mass against it: where the gap multiplies within a step, it is softer there by orders
    of magnitude than at the start, and it is there that inertia comes back. The first estimate is
    sharper, but where a transient of length m/c was stepped over, that is all it sees. The second
    one starts where the transient ends: on the balance of film, other forces and inertia. What is
    left of the transient, 3 m/(c dt) of its change of speed, decays in the next step likewise; a
    tenth of it counts, or each change of a pull would be followed through its transient.
    """
    held = _held(problem, dt, end)
    first, damping = dt * abs(a0 + zv) / held, problem.first.viscous_by_speed
    if not damping * dt > problem.mass:
        return first
    off = problem.begin.speed - _parabola(BACK, speeds)
    led = off + problem.mass / damping * (a0 - _parabola(BACK_SLOPE, speeds) / dt)
    found = min(first, 3.0 * max(abs(led), _LEFT * abs(off)) / held)
    if gap < _FAST * problem.begin.gap:
        return found
    acceleration = (_parabola(END_SLOPE, speeds) - 3.0 * led) / dt
    return max(found, _lag_error(problem, dt, acceleration, speeds[2], end))


def _lag_error(
    problem: StepProblem, dt: float, acceleration: float, speed: float, end: Forces
) -> float:
    """Error of a speed [m/s] by that of the acceleration at the end of a step [m/s2].

    A film that leads a mass accelerates it as the balance of the other forces says: c v' = F' -
    (k + dF/dh) v. The mass lags behind by a fraction m v'/(c v), and its acceleration by some
    three times that, for which five are taken off.
    """
    damping, time = end.viscous_by_speed, problem.begin.time
    if not damping > 0.0 or end.limit is not None or not speed:
        return 0.0
    rate = (problem.pull(time + dt) - problem.pull(time + _C2 * dt)) / ((1.0 - _C2) * dt)
    by_gap = problem.stiffness + end.static_by_gap + end.viscous_by_gap
    led = (rate - by_gap * speed) / damping
    lag = problem.mass / damping * led
    return problem.mass / damping * abs(acceleration - led) - 5.0 * lag * lag / abs(speed)


def _held(problem: StepProblem, dt: float, end: Forces) -> float:
    """How much an error is reduced by the estimate and by the film at the end of a step [-]."""
    return GAMMA + dt * max(end.viscous_by_speed, 0.0) / (_RISING * problem.mass)


def _parabola(weights: Three, stages: Sequence[float]) -> float:
    """Value, or slope, at the start of a parabola through the stages."""
    return weights[0] * stages[0] + weights[1] * stages[1] + weights[2] * stages[2]


def _moved(forces: Forces, before: _Stage, after: _Stage) -> Forces:
    """Forces a little way off, by their slopes."""
    static, static_by_gap, viscous, by_gap, by_speed, limit = forces
    dh = after[1] - before[1]
    if limit is None:  # proportional to the speed
        viscous = by_speed * after[2] * (1.0 + (by_gap / viscous * dh if viscous else 0.0))
    else:
        viscous += by_gap * dh + by_speed * (after[2] - before[2])
    return Forces(static + static_by_gap * dh, static_by_gap, viscous, by_gap, by_speed, limit)


def _net_near(problem: StepProblem, pull: float, gap: float, speed: float) -> float:
    """Net force near the start [N]: by the slopes there, unless it is too far off for them."""
    (_, h0, v0), first = problem.begin, problem.first
    dh, dv = gap - h0, speed - v0
    is_near = abs(dh) <= _LINEAR * h0
    if is_near and problem.has_limits:
        is_near = abs(dv) <= _LINEAR * abs(speed)
    if not is_near:
        return problem.net(pull, gap, problem.forces(gap, speed))
    resists = (first.static_by_gap + first.viscous_by_gap) * dh + first.viscous_by_speed * dv
    return problem.net(pull, gap, first) - resists


def relative_error(problem: StepProblem, taken: Step, length: float, missed: float = 0.0) -> float:
    """Error of a step over its tolerance: of the gap, and of the momentum delivered so far.

    Measured against the momentum of the mass alone, a transient of length m/c would have to be
    resolved, 1e-12 s at 10 nm; it delivers nothing and is stepped over. What the film took counts
    too: an error of the gap, times the damping coefficient, is one of its impulse; and so does
    what the step has `missed` of the impulse of the pull [N.s].
    """
    speed = abs(taken.stages[2].speed)
    momentum = problem.mass * speed + problem.delivered + problem.size * length
    film = problem.first.viscous_by_speed * problem.begin.gap * taken.gap_error
    wrong = max(problem.mass * taken.speed_error, film, abs(missed))
    # A mass that the film leads has no momentum to speak of; its speed is an output all the same.
    of_speed = taken.speed_error / (speed + problem.scale)
    kept = taken.memory.error if taken.memory is not None else 0.0
    of_impulse = _IMPULSE * _impulse_error(problem, taken, length)
    return max(taken.gap_error, wrong / momentum, of_speed, of_impulse, kept) / problem.rtol


def _impulse_error(problem: StepProblem, taken: Step, length: float) -> float:
    """Error of the viscous impulse over what it is so far [-].

    A heavy mass crosses the film as if there were none: that impulse is no part of its momentum.
    """
    begin, damping = problem.begin, problem.first.viscous_by_speed
    if not damping > 0.0:
        return 0.0
    forces = [one.viscous for one in taken.forces]
    wrong = length * abs(problem.first.viscous - _parabola(BACK, forces))
    grown = length * (abs(forces[0]) + abs(forces[1]) + abs(forces[2])) / 3.0
    # It is zero again where a mass comes back to where it was.
    least = _TRAVEL * damping * begin.gap
    return wrong / (_held(problem, length, taken.forces[2]) * (problem.taken + grown + least))


def against_halves(problem: StepProblem, taken: Step, length: float) -> Step | None:
    """Step with its errors found from the same in two halves; None if a half cannot be solved.

    For a step in which a limit sets in or ceases: no estimate sees where the slope of the force
    jumps.
    """
    half = step(problem, 0.5 * length)
    if half is None:
        return None
    begin = half.stages[2]
    first = problem.forces(begin.gap, begin.speed)
    again = step(problem._replace(begin=begin, first=first), 0.5 * length)
    if again is None:
        return None
    end, other = taken.stages[2], again.stages[2]
    gap_error, speed_error = abs(math.log(other.gap / end.gap)), abs(other.speed - end.speed)
    return taken._replace(gap_error=gap_error, speed_error=speed_error)
