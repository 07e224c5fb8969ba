"""What one internal step of the motion solves: the forces on the mass, and how they are scaled."""

from __future__ import annotations

import math
from typing import NamedTuple

from ..effects.registry import ViscousForce
from ..integrator.radau import NODES, WEIGHTS, NetForce, Stage, Step, slopes, step
from ..integrator.radau_short import Holding, Short, short_step
from ..plan import Film, Plan
from .state import Drive, MotionState, Pull

__all__ = ["StepProblem", "first_step", "step_problem"]


class StepProblem(NamedTuple):
    """What one internal step solves, from where, and the size its error is measured against."""

    holding: Holding
    net: NetForce
    mass: float
    begin: Stage
    rtol: float
    exponent: float  # with which the film falls
    size: float  # sum of the forces that deliver momentum [N]; those that cancel count too
    delivered: float  # momentum delivered so far [N.s]
    scale: float  # speed at which the film balances the other forces [m/s]
    at_start: tuple[float, float, float]
    static: float  # force at the start that does not depend on speed [N]
    viscous: float  # and that which does [N]

    def expecting(self, force: float) -> StepProblem:
        """Return the problem with its errors measured against a force [N] that is still to come.

        At the foot of a ramp nothing acts yet, and a stiff film would be followed through its
        transient, which late in a run is shorter than the time can tell.
        """
        resistance = -self.at_start[2]
        speed = force / resistance if resistance > 0.0 else 0.0
        return self._replace(size=self.size + force, scale=max(self.scale, speed))

    def _coordinate(self, length: float) -> float:
        """In terms of the viscous impulse where the film rules, else of the gap."""
        is_film_ruled = -self.at_start[2] * length > self.mass
        return self.exponent - 1.0 if is_film_ruled and self.exponent > 0.0 else -1.0

    def attempt(self, length: float) -> Step | None:
        """Try a step."""
        return step(
            self.net,
            self.mass,
            self.begin,
            length,
            self._coordinate(length),
            self.rtol,
            self.at_start,
            self.scale,
        )

    def attempt_short(self, length: float) -> Short | None:
        """Try a step that is expected to change little; if it does not, `attempt` has to."""
        s = self._coordinate(length)
        return short_step(
            self.holding, self.mass, self.begin, length, s, self.rtol, self.at_start, self.scale
        )

    def error(self, taken: Step, length: float) -> float:
        """Error of a step over its tolerance: of the gap, and of the momentum delivered so far.

        Measured against the momentum of the mass alone, a transient of length m/c would have to
        be resolved, 1e-12 s at 10 nm; it delivers nothing and is stepped over. What the film took
        counts too: an error of the gap, times the resistance, is one of its impulse.
        """
        momentum = self.mass * abs(taken.stages[2].speed) + self.delivered + self.size * length
        film = -self.at_start[2] * self.begin.gap * taken.gap_error
        wrong = max(self.mass * taken.speed_error, film, abs(self._missed_impulse(length)))
        # A mass that the film leads has no momentum to speak of; its speed is still asked for.
        speed = taken.speed_error / (abs(taken.stages[2].speed) + self.scale)
        return max(taken.gap_error, wrong / momentum, 0.1 * speed) / self.rtol

    def _missed_impulse(self, length: float) -> float:
        """What the nodes of a step miss of the impulse of the pull [N.s], against Simpson's rule.

        A stiff film hides a ramp of the pull from the estimates of gap and speed.
        """
        start, pull = self.begin.time, self.holding.pull
        if type(pull) is Pull:  # a straight line, which both rules integrate exactly
            return 0.0
        nodes = zip(WEIGHTS, NODES, strict=True)
        seen = sum(weight * pull(start + node * length) for weight, node in nodes)
        first, middle, last = (pull(start + x * length) for x in (0.0, 0.5, 1.0))
        return length * (seen - (first + 4.0 * middle + last) / 6.0)


def _no_static(gap: float) -> float:
    return 0.0


def _no_viscous(gap: float, speed: float) -> tuple[float, None]:
    return 0.0, None


def step_problem(plan: Plan, film: Film | None, state: MotionState, pull: Drive) -> StepProblem:
    """Pose the step from a state, with a film or, where it is broken, without one."""
    opening = plan.scene.opening
    mass, spring, rest = _mass(plan), opening.stiffness, opening.initial_gap
    time, gap, speed = begin = Stage(state.time, state.gap, state.speed)
    if film is None:
        holding = Holding(pull, _no_static, _no_viscous, spring, rest)
        static = viscous = resistance = exponent = 0.0
    else:
        holding = Holding(pull, film.static_force, film.viscous_force, spring, rest)
        static = film.static_force(gap)
        resistance, exponent = film.resistance(gap), film.exponent(gap)
        viscous = film.viscous_force(gap, speed)[0] if film.limits else resistance * speed
    pulled = pull(time)
    size = abs(pulled) + abs(static) + spring * abs(gap - rest) + 1e-300
    delivered = state.given_impulse + mass * abs(speed)
    crossing = gap / (state.step or 1e-6)
    # Where no force acts yet, a film still has a scale: the differences need not be zero.
    scale = max(size / resistance, 1e-15 * crossing) if resistance > 0.0 else crossing
    net = _net(holding)
    if film is not None and film.limits:
        at_start = slopes(net, time, gap, speed, scale)
    else:
        force, dh = pulled - spring * (gap - rest) - (viscous + static), 1e-7 * gap
        at_start = force, (net(time, gap + dh, speed) - force) / dh, -resistance
    return StepProblem(
        holding,
        net,
        mass,
        begin,
        plan.accuracy.time_rtol,
        exponent,
        size,
        delivered,
        scale,
        at_start,
        static,
        viscous,
    )


def _net(holding: Holding) -> NetForce:
    """Net force [N] on the mass at a time [s], a gap [m] and a speed [m/s]."""
    pull, static, viscous, spring, rest = holding

    def net(time: float, gap: float, speed: float) -> float:
        return pull(time) - spring * (gap - rest) - (viscous(gap, speed)[0] + static(gap))

    return net


def _mass(plan: Plan) -> float:
    """Moving mass [kg]; without one, so little that its momentum is 1e-14 of the impulse given."""
    opening = plan.scene.opening
    if opening.mass is not None:
        return opening.mass
    impulse = plan.film.laws[ViscousForce].impulse
    assert impulse is not None  # a viscous force always has one
    given = impulse(opening.initial_gap, opening.final_gap)
    pull = max(abs(opening.force or 0.0), 1e-300)
    return 1e-14 * given * (given / pull) / (opening.final_gap - opening.initial_gap)


def first_step(problem: StepProblem, left: float) -> float:
    """Time [s] in which inertia alone would open a thousandth of the gap; a first guess."""
    _, gap, speed = problem.begin
    acceleration = abs(problem.at_start[0]) / problem.mass
    still = math.sqrt(2e-3 * gap / acceleration) if acceleration > 0.0 else left
    moving = 1e-3 * gap / abs(speed) if speed else left
    return min(still, moving, left)
