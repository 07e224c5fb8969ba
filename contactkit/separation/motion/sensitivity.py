r"""Sensitivities of a motion to parameters: the implicit step, differentiated.

The stages of an accepted step solve :math:`R(z; y_0, \Delta t, \theta) = 0`; their derivatives
solve the same three equations, linear, with the matrix of Newton's method:

.. math:: R_z z' = -R_{y_0} y_0' - R_\theta - R_{\Delta t} \Delta t'

Lengths of steps are those of the motion. One that ends at the gap of an event (release, rupture,
a kink of a force) ends there under every parameter, so that its length follows from the implicit
function theorem, :math:`\Delta t' = (h_e' - h') / v`, and a force that jumps there leaves the
right jump of the slopes behind. Forces at a gap and a speed are differentiated by differences
of their laws, never of a motion.

The slopes are those of the numbers that the motion has at its tolerance; as it falls, both tend to
those of the equation of motion. (Hairer, Norsett and Wanner, Solving Ordinary Differential
Equations I, section I.14; jumps: Rozenvasser 1967.)
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ...errors import ConvergenceError, NotSimulatedError
from ...numerics.events import step_to_event
from ...numerics.radau_tableau import NODES, STAGES, WEIGHTS
from ..integrator.dense_output import peak
from ..integrator.radau import Forces, MotionPoint, Step, StepProblem, coordinate, step
from .advance import Traced, moving_mass, traced_step
from .events import closed_gap
from .state import acting_film, start

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from numpy.typing import NDArray

    from ..film import Film
    from ..plan import Plan
    from .state import MotionState, PullLaw

    Array = NDArray[np.float64]

__all__ = ["MotionSlopes", "Variation", "motion_slopes"]

# Relative step of central differences of a law over gap, speed and time: what they leave out, 1e-10
# of the third derivative, and rounding, 1e-11, are of one size.
_STEP = 1e-5
# Step of the speed of a mass at rest, over that at which the film balances the other forces.
_REST = 1e-3


# Rate of the force at its maximum, over that at the start of the step: what is left of it changes
# the maximum by its square.
_FLAT = 1e-6


class Variation(NamedTuple):
    """Plans of values of one parameter around its own, and weights of their difference.

    The slope of whatever a plan says is the sum of its values times the weights.
    """

    plans: tuple[Plan, ...]
    weights: tuple[float, ...]

    def slope(self, of: Callable[[Plan], float]) -> float:
        """Slope of a number of the plan, which may be infinite in all of them."""
        values = [of(one) for one in self.plans]
        if all(math.isinf(value) for value in values):
            return 0.0
        return float(np.dot(self.weights, values))


class MotionSlopes(NamedTuple):
    """Numbers of a motion, and the slope of each over every parameter (p,)."""

    numbers: dict[str, float]
    slopes: dict[str, Array]
    n_steps: int


class _Stage(NamedTuple):
    """Forces at a stage (l,) [N], slopes over gap and speed (l,), and parameters (l, p)."""

    force: Array
    by_gap: Array
    by_speed: Array
    by_parameter: Array

    def along(self, gap: Array, speed: Array) -> Array:
        """Slopes of the forces (l, p) where gap and speed have those given (p,)."""
        return self.by_parameter + np.outer(self.by_gap, gap) + np.outer(self.by_speed, speed)

    def rate(self, solved: _Solved) -> float:
        """Rate of the sum of the forces at the end of a step over its length [N/s]."""
        by_gap, by_speed = solved.rates
        return float(self.by_gap.sum() * by_gap + self.by_speed.sum() * by_speed)


class _Tangent(NamedTuple):
    """Slopes of a point of the motion over every parameter (p,)."""

    time: Array
    gap: Array
    speed: Array


class _Solved(NamedTuple):
    """Slopes of the stages (3, p) and of the length of the step (p,).

    `rates` are those of gap and speed at the end over the length of the step.
    """

    gap: Array
    speed: Array
    length: Array
    rates: tuple[float, float]


def motion_slopes(
    plan: Plan,
    variations: Sequence[Variation],
    pull_of: Callable[[Plan], PullLaw],
) -> MotionSlopes:
    """Follow a motion to its release, with its slopes over some parameters.

    Parameters
    ----------
    plan : Plan
        Of a scene with an imposed force.
    variations : sequence of Variation
        Of each parameter.
    pull_of : callable
        Pull [N] over time [s] of a plan.

    Returns
    -------
    MotionSlopes
        ``release_time``, ``release_speed``, ``break_time``, ``peak_force``, ``final_gap`` and the
        impulse of each force, as far as the motion has them.

    Raises
    ------
    NotSimulatedError
        If the mass rests on asperities, the film cavitates with a memory or loses liquid, or breaks
        at a gap that depends on the speed.
    ConvergenceError
        If no step of time meets the tolerance, or the steps are used up.
    """
    motion = _Motion(plan, tuple(variations), pull_of)
    loading = plan.scene.imposed_force
    while motion.state.n_releases == 0 and motion.state.time < loading.time_limit:
        if motion.state.n_steps > plan.accuracy.max_steps:
            raise ConvergenceError(
                f"not released after {plan.accuracy.max_steps} steps; raise Accuracy.max_steps"
            )
        before = motion.state
        motion.step(loading.time_limit)
        if motion.state == before:  # nothing moves it any more
            break
    return motion.found()


class _Motion:
    """State of a motion with its slopes."""

    def __init__(
        self,
        plan: Plan,
        variations: tuple[Variation, ...],
        pull_of: Callable[[Plan], PullLaw],
    ) -> None:
        self.plan, self.variations = plan, variations
        self.pull = pull_of(plan)
        self.pulls = [[pull_of(one) for one in v.plans] for v in variations]
        self.state = start(plan)
        nothing = np.zeros(len(variations))
        loading = self.slopes(lambda one: one.scene.imposed_force.initial_gap)
        speed = self.slopes(lambda one: one.scene.imposed_force.initial_speed)
        self.tangent = _Tangent(nothing, loading, speed)
        self.mass = self.slopes(moving_mass)
        self.stiffness = self.slopes(lambda one: one.scene.imposed_force.stiffness)
        self.slack = loading
        self.impulses: dict[str, Array] = {}
        self.marks: dict[str, Array] = {}
        self.peak, self.peak_slopes = -math.inf, nothing
        self.end: tuple[Film | None, Array] | None = None  # slopes of all forces at the last point
        self._check()

    def slopes(self, of: Callable[[Plan], float]) -> Array:
        """Slopes of a number of the plan over every parameter."""
        return np.array([one.slope(of) for one in self.variations])

    def _check(self) -> None:
        if self.plan.volume_rate is not None:
            raise NotSimulatedError(
                "no gradient of a film that loses liquid (LandauLevichFilm), whose volume is a "
                "state of its own: take differences of whole motions (ck.sensitivity)"
            )
        if self.state.in_contact:
            raise NotSimulatedError(
                "no gradient of a motion that rests on asperities: it leaves them at a time of its "
                "own; take loading.rest_gap below loading.initial_gap, or ck.sensitivity"
            )
        if self.state.n_inceptions:
            raise NotSimulatedError(
                "no gradient of a film that cavitates and remembers it: take "
                'TensionLimit(strength=..., cavity="truncated"), or differences of whole motions '
                "(ck.sensitivity)"
            )

    def step(self, limit: float) -> None:
        """Take one internal step, and differentiate it."""
        before, film = self.state, acting_film(self.plan, self.state)
        traced = traced_step(self.plan, before, self.pull, limit)
        self.state = traced.state
        self._check_step(before, traced)
        problem, taken = traced.problem, traced.taken
        if problem is None or taken is None:
            self.tangent = self.tangent._replace(speed=np.zeros_like(self.tangent.speed))
            return
        marks = None if traced.event is None else self._marks(before, film, traced.event)
        stages = self._stages(film, before, (problem, taken), traced.event, marks)
        solved = self._solved((problem, taken, traced.length), stages, marks, traced)
        self._add_impulses(film, stages, solved, traced.length)
        self._look_for_peak(film, before, traced, stages, solved)
        time = self.tangent.time + solved.length
        gap = solved.gap[2] if marks is None else marks[0]
        self.tangent = _Tangent(time, gap, solved.speed[2])
        if self.state.n_breaks > before.n_breaks:
            self.marks["break_time"] = time

    def _check_step(self, before: MotionState, traced: Traced) -> None:
        self._check()
        if traced.event is None and traced.state.broken and not before.broken:
            raise NotSimulatedError(
                "no gradient of a film that breaks at a gap which depends on its speed "
                "(DynamicRupture, CoxVoinovAngle): take differences of whole motions "
                "(ck.sensitivity), or a loading.final_gap before it breaks"
            )
        if traced.state.cavity.phase is not before.cavity.phase:
            self.state = traced.state._replace(n_inceptions=1)
            self._check()

    def _marks(
        self, state: MotionState, film: Film | None, event: float
    ) -> tuple[Array, list[list[float]]]:
        """Slopes of the gap of an event, and what it is under each value of each parameter."""
        place = _events(self.plan, film).index(event)
        values = [
            [_events(one, acting_film(one, state))[place] for one in v.plans]
            for v in self.variations
        ]
        pairs = zip(self.variations, values, strict=True)
        return np.array([float(np.dot(v.weights, row)) for v, row in pairs]), values

    def _stages(
        self,
        film: Film | None,
        state: MotionState,
        step: tuple[StepProblem, Step],
        event: float | None,
        marks: tuple[Array, list[list[float]]] | None,
    ) -> list[_Stage]:
        """Forces and their slopes at the stages."""
        problem, taken = step
        found = []
        for i, point in enumerate(taken.stages):
            at_event = marks if i == 2 else None
            place = point if at_event is None or event is None else point._replace(gap=event)
            begin = problem.begin.gap if at_event is not None else None
            found.append(self._stage(film, state, place, problem.scale, begin, at_event))
        return found

    def _stage(
        self,
        film: Film | None,
        state: MotionState,
        point: MotionPoint,
        scale: float,
        begin: float | None,
        marks: tuple[Array, list[list[float]]] | None,
    ) -> _Stage:
        """Forces and their slopes at a point; at that of an event from the side it is reached.

        There the slope over a parameter is that along the gap of the event, which moves with it,
        less what the gap adds: a law is another one beyond.
        """
        gap, speed = point.gap, point.speed
        force = _forces(film, gap, speed)
        by_gap = _by_gap(film, gap, speed, begin)
        dv = _STEP * abs(speed) or _REST * scale
        by_speed = (_forces(film, gap, speed + dv) - _forces(film, gap, speed - dv)) / (2.0 * dv)
        columns = []
        for i, variation in enumerate(self.variations):
            gaps = [gap] * len(variation.plans) if marks is None else marks[1][i]
            rows = [
                weight * _forces(acting_film(one, state), at, speed)
                for one, weight, at in zip(variation.plans, variation.weights, gaps, strict=True)
            ]
            columns.append(sum(rows, np.zeros_like(force)))
        by_parameter = np.array(columns).T.reshape(force.size, len(columns))
        if marks is not None:
            by_parameter = by_parameter - np.outer(by_gap, marks[0])
        return _Stage(force, by_gap, by_speed, by_parameter)

    def _solved(
        self,
        step: tuple[StepProblem, Step, float],
        stages: list[_Stage],
        marks: tuple[Array, list[list[float]]] | None,
        traced: Traced,
    ) -> _Solved:
        """Slopes of the stages: three linear equations, with the length of the step as one more."""
        problem, taken, dt = step
        (t0, h0, v0), mass, k = problem.begin, problem.mass, problem.stiffness
        n, a, nodes = len(self.variations), np.array(STAGES), np.array(NODES)
        h = np.array([one.gap for one in taken.stages])
        v = np.array([one.speed for one in taken.stages])
        q = np.array(taken.coordinates)
        places = [coordinate(h0, taken.exponent, float(one)) for one in q]
        first = np.array([one[1] if one is not None else math.nan for one in places])
        second = np.array([one[2] if one is not None else math.nan for one in places])
        rate = v / first
        # Parameters in columns; the last one is the length of the step.
        of_gap = np.zeros((3, n + 1))
        of_gap[:, :n] = np.outer(h / h0, self.tangent.gap)
        of_gap[:, n] = first * q / dt
        of_speed = np.zeros((3, n + 1))
        of_speed[:, :n] = np.outer(rate * first / h0, self.tangent.gap)
        of_speed[:, n] = rate * second * q / dt
        by_gap = -k - np.array([one.by_gap.sum() for one in stages])
        by_speed = -np.array([one.by_speed.sum() for one in stages])
        net = by_gap[:, None] * of_gap + by_speed[:, None] * of_speed
        net[:, :n] += self._driven(problem, stages, (t0 + nodes * dt, h), dt)
        net[:, n] += nodes * self._pull_rates(t0 + nodes * dt, dt)
        gaps, speeds = dt * first[:, None] * a, dt * (rate * second)[:, None] * a + np.diag(first)
        right = dt * a @ net - mass * of_speed
        right[:, :n] += mass * self.tangent.speed - np.outer(v - v0, self.mass)
        right[:, n] += mass * (v - v0) / dt
        matrix = mass * speeds - dt * a @ (by_gap[:, None] * gaps + by_speed[:, None] * speeds)
        rates = np.linalg.solve(matrix, right)
        of_gap, of_speed = of_gap + gaps @ rates, of_speed + speeds @ rates
        length = np.zeros(n)
        if marks is not None:
            length = (marks[0] - of_gap[2, :n]) / of_gap[2, n]
        elif traced.is_last:
            length = -self.tangent.time
        return _Solved(
            of_gap[:, :n] + np.outer(of_gap[:, n], length),
            of_speed[:, :n] + np.outer(of_speed[:, n], length),
            length,
            (float(of_gap[2, n]), float(of_speed[2, n])),
        )

    def _driven(
        self, problem: StepProblem, stages: list[_Stage], at: tuple[Array, Array], dt: float
    ) -> Array:
        """Slopes (3, p) of the net force at a gap and a speed: pull, spring, film, its time."""
        times, gaps = at
        found = np.outer(self._pull_rates(times, dt), self.tangent.time)
        for i, (variation, pulls) in enumerate(zip(self.variations, self.pulls, strict=True)):
            pairs = list(zip(variation.weights, pulls, strict=True))
            found[:, i] += [sum(w * pull(float(t)) for w, pull in pairs) for t in times]
        found -= np.outer(gaps - problem.slack_gap, self.stiffness)
        found += problem.stiffness * self.slack
        return np.asarray(found - np.array([one.by_parameter.sum(axis=0) for one in stages]))

    def _pull_rates(self, times: Array, dt: float) -> Array:
        """Rate of the pull at some times [N/s]."""
        near, pull = _STEP * dt, self.pull
        rises = np.array([pull(t + near) - pull(t - near) for t in times.tolist()])
        return np.asarray(rises / (2.0 * near))

    def _add_impulses(
        self, film: Film | None, stages: list[_Stage], solved: _Solved, dt: float
    ) -> None:
        if film is None:
            return
        grown = np.zeros((len(film.impulse_names), len(self.variations)))
        for i, (weight, stage) in enumerate(zip(WEIGHTS, stages, strict=True)):
            grown += dt * weight * stage.along(solved.gap[i], solved.speed[i])
            grown += weight * np.outer(stage.force, solved.length)
        for name, row in zip(film.impulse_names, grown, strict=True):
            self.impulses[name] = self.impulses.get(name, np.zeros_like(row)) + row

    def _look_for_peak(
        self,
        film: Film | None,
        before: MotionState,
        traced: Traced,
        stages: list[_Stage],
        solved: _Solved,
    ) -> None:
        """Note the highest force and its slopes, which its time does not change."""
        problem, taken = traced.problem, traced.taken
        assert problem is not None
        assert taken is not None
        ends = [
            one.along(solved.gap[i], solved.speed[i]).sum(axis=0) for i, one in enumerate(stages)
        ]
        if self.end is None or self.end[0] is not film:
            stage = self._stage(film, before, problem.begin, problem.scale, None, None)
            begun = stage.along(self.tangent.gap, self.tangent.speed).sum(axis=0)
        else:
            begun = self.end[1]
        self.end = film, ends[2]
        inside = self._inside_peak(film, before, traced, stages[2].rate(solved))
        if inside is not None:
            self._note_peak(*inside)
            return
        first = problem.first.static + problem.first.viscous
        highest = peak(first, [one.static + one.viscous for one in taken.forces])
        weights = _lagrange(highest.where)
        rows = zip(weights, (begun, *ends), strict=True)
        slopes = sum((w * row for w, row in rows), np.zeros_like(begun))
        self._note_peak(highest.value, slopes)

    def _note_peak(self, value: float, slopes: Array) -> None:
        if value > self.peak:
            self.peak, self.peak_slopes = value, slopes

    def _inside_peak(
        self, film: Film | None, before: MotionState, traced: Traced, last: float
    ) -> tuple[float, Array] | None:
        """Maximum of the force inside a step, where its rate vanishes, and its slopes.

        At a part of the step that ends there; how the time of the maximum moves changes nothing.
        The rate is that of the end of a step over its length: that by the equation of motion gives
        the time to 1e-5 only, where a stiff film magnifies what the tolerance leaves. Without a
        mass the acceleration at the start is what rounding leaves, and the cubic is taken.
        """
        problem, taken = traced.problem, traced.taken
        assert problem is not None
        assert taken is not None
        if film is None or film.is_limited or self.plan.scene.imposed_force.mass is None:
            return None
        begin = _rate(problem, problem.begin, problem.first)
        if not begin > 0.0 > last:
            return None

        def ended(length: float, one: Step) -> tuple[_Stage, _Solved]:
            part = traced._replace(taken=one, length=length, is_last=False)
            stages = self._stages(film, before, (problem, one), None, None)
            return stages[2], self._solved((problem, one, length), stages, None, part)

        def beyond(one: Step) -> float:
            stage, solved = ended(one.stages[2].time - problem.begin.time, one)
            return -stage.rate(solved)

        found = step_to_event(
            lambda dt: step(problem, dt), beyond, -begin, taken, traced.length, _FLAT * begin
        )
        stage, solved = ended(found.length, found.taken)
        forces = found.taken.forces[2]
        slopes = stage.along(solved.gap[2], solved.speed[2]).sum(axis=0)
        return forces.static + forces.viscous, slopes

    def found(self) -> MotionSlopes:
        """Return the numbers of the motion and their slopes."""
        state = self.state
        numbers: dict[str, float] = {}
        slopes: dict[str, Array] = {}
        if state.n_releases:
            numbers |= {"release_time": state.release_time, "release_speed": state.release_speed}
            slopes |= {"release_time": self.tangent.time, "release_speed": self.tangent.speed}
        if "break_time" in self.marks:
            numbers["break_time"], slopes["break_time"] = state.break_time, self.marks["break_time"]
        if math.isfinite(self.peak):
            numbers["peak_force"], slopes["peak_force"] = self.peak, self.peak_slopes
        numbers["final_gap"], slopes["final_gap"] = state.gap, self.tangent.gap
        for name, row in self.impulses.items():
            numbers[name], slopes[name] = state.impulses[name], row
        return MotionSlopes(numbers, slopes, state.n_steps)


def _rate(problem: StepProblem, at: MotionPoint, forces: Forces) -> float:
    """Rate of the forces of film and solids along the motion [N/s]."""
    acceleration = problem.net(problem.pull(at.time), at.gap, forces) / problem.mass
    by_gap = forces.static_by_gap + forces.viscous_by_gap
    return by_gap * at.speed + forces.viscous_by_speed * acceleration


def _forces(film: Film | None, gap: float, speed: float) -> Array:
    """Each force [N] at a gap and a speed, in the order of the impulses of a film."""
    if film is None:
        return np.zeros(0)
    named = film.at(gap, speed).named
    return np.array([named[kind.column.name] for kind in film.laws])


def _by_gap(film: Film | None, gap: float, speed: float, begin: float | None) -> Array:
    """Slopes over the gap: central, or from the side of `begin` where a law may be another beyond.

    From one side with three values, which is of second order too.
    """
    step = _STEP * gap
    if begin is None:
        return (_forces(film, gap + step, speed) - _forces(film, gap - step, speed)) / (2.0 * step)
    step = math.copysign(step, begin - gap)
    here, near, far = (_forces(film, gap + i * step, speed) for i in range(3))
    return (-3.0 * here + 4.0 * near - far) / (2.0 * step)


def _events(plan: Plan, film: Film | None) -> list[float]:
    """Gaps of all events, in an order that does not depend on the parameters."""
    loading = plan.scene.imposed_force
    own = () if film is None else (*film.kinks, film.end, film.release)
    return [
        loading.final_gap,
        *own,
        loading.initial_gap,
        plan.film.recontact,
        closed_gap(plan),
        loading.rest_gap,
    ]


def _lagrange(where: float) -> list[float]:
    """Weights of start and stages in the cubic through them, at a place of the step."""
    nodes, weights = (0.0, *NODES), []
    for i, at in enumerate(nodes):
        others = [one for j, one in enumerate(nodes) if j != i]
        weights.append(math.prod((where - one) / (at - one) for one in others))
    return weights
