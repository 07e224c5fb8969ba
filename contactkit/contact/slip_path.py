r"""Partial slip of dissimilar bodies: pressure and tractions displace each other's surfaces.

Pressing draws the surfaces along the contact, and friction holds some of that back; the tractions
in turn displace the surfaces along the normal. With the compliances C (normal), H (tangential) and
B (normal displacement by tractions), each sub-step from p_0, q_0 to p, q ends where

.. math:: C p + B q = h + \delta + g, \qquad H (q - q_0) + B^T (p - p_0) = D - s

with pressure where the gap g is zero, and Coulomb's law for q and the slip s of the step. B q is an
unknown of the contact: it lowers the heights under p, and follows from p by the q of the step, with
B^T (p - p_0) as a given displacement.
"""

from __future__ import annotations

import math
import time
from typing import TYPE_CHECKING, ClassVar, NamedTuple

import numpy as np
from attrs import evolve

from .effects.elasticity import bodies_of, layers_of
from .effects.partial_slip import PartialSlip
from .effects.plastic_history import PlasticHistory
from .outer.displacement import displacement_scale
from .outer.load import solve_loaded, target_at
from .outer.step import Solved, Step
from .outer.unknown import Held, HeldContact, Next, Target, Unknown
from .plan import ContactPlan
from .slip.coupling import coupling_of
from .slip.load_path import Friction, Imposed, Record, SlipState, Taken, sub_steps
from .slip.states import SlipCoupling
from .work import WorkCounter

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from .plastic_history import PlasticPath

    Map = NDArray[np.float64]

__all__ = ["SlipDisplacement", "follow_coupled"]

_LOOSEST = 1e-4  # tolerance of a first pass, and of all steps of pressing but the last: their error
# then changes the tractions by less than 1e-3 of their bound, a third of the passes is saved
_GROWTH = 2.0  # power of the loads: between areas of equal growth (1 rough, 3 a sphere)
_FEWEST = 4  # pressing steps that others are compared with
_REFINED = 4  # times as many, for a first estimate of their error
_MOST_STEPS = 256  # of pressing: a contact of as many pixels across gains one of them by each
_SPARE = 1.1  # on the number of steps that an error of first order asks for


class _State(NamedTuple):
    """A contact and its tractions after a sub-step."""

    step: Step
    solved: Solved
    taken: Taken


class _Pressed(NamedTuple):
    """A contact after pressing, in how many steps, and the error of its tractions by them [-]."""

    near: _State
    steps: int
    error: float | None


class _Run:
    """Everything that stays along the load path of one contact."""

    def __init__(self, plan: ContactPlan, effect: PartialSlip, counter: WorkCounter) -> None:
        interface = plan.scene.interface
        stacks = tuple(layers_of(stack) for stack in interface.stacks)
        self.plan, self.counter, self.law = plan, counter, effect.law
        self.friction = Friction(plan.grid, stacks, self.law, plan.accuracy.threads)
        self.coupling = coupling_of(plan.grid, *bodies_of(interface), plan.accuracy.threads)
        self.plastic: PlasticPath | None = None

    def target(self, fraction: float) -> Target:
        """Load or approach at a fraction of that of the scene."""
        plan = self.plan
        return target_at(plan, fraction * plan.scene.loading.imposed_over(plan.grid.area))

    def targets(self, steps: int) -> list[Target]:
        """Loads or approaches of a number of steps of pressing."""
        return [self.target((i / steps) ** _GROWTH) for i in range(1, steps + 1)]

    def normal(self, traction: Map) -> Map:
        """Normal displacement [m] by tractions along the load and across it, (2, ny, nx)."""
        c, s = np.cos(self.law.direction), np.sin(self.law.direction)
        along, across = traction
        return self.coupling(c * along - s * across, s * along + c * across)

    def tangential(self, pressure: Map) -> Map:
        """Displacement [m] along the load and across it by a pressure, (2, ny, nx)."""
        c, s = np.cos(self.law.direction), np.sin(self.law.direction)
        x, y = self.coupling.of_pressure(pressure)
        return np.array([c * x + s * y, c * y - s * x])


class SlipDisplacement(Unknown):
    """Normal displacement [m] (ny, nx) by the tractions at the end of a sub-step.

    Parameters
    ----------
    run : _Run
        Friction and coupling of the bodies.
    before : SlipState
        At the begin of the sub-step.
    imposed : Imposed
        Tangential force or displacement at its end.
    start : Taken, optional
        Tractions nearby, to begin with.
    least : float
        Tolerance of the tractions, if that of the effect is smaller.
    """

    name: ClassVar[str] = "displacement by tractions"
    measure: ClassVar[str] = "that by pressure"
    effect = PartialSlip.name
    is_of_tractions: ClassVar[bool] = True
    first_rtol = _LOOSEST
    loosest = _LOOSEST
    cure = (
        "use more PartialSlip.pressing_steps, a smaller coefficient, a larger Accuracy.rtol, or "
        "leave coupled out"
    )

    def __init__(
        self,
        run: _Run,
        before: SlipState,
        imposed: Imposed,
        start: Taken | None = None,
        least: float = 0.0,
    ) -> None:
        self._run, self._before, self._imposed, self._taken = run, before, imposed, start
        self._rtol = max(run.law.rtol, least)
        self._drawn = run.tangential(before.pressure)

    def first(self, target: Target) -> Map:
        """See `Unknown.first`."""
        known = target.unknowns.get(self.name)
        return known if known is not None else np.zeros(self._run.plan.grid.shape)

    def hold(self, held: Held, value: Map) -> Held:
        """See `Unknown.hold`."""
        return held._replace(displacement=value)

    def renewed(self, contact: HeldContact, rtol: float) -> Next:
        """See `Unknown.renewed`: tractions under the pressure, no better than it is."""
        run, pressure = self._run, contact.solution.pressure
        is_exact = contact.solution.kkt <= run.plan.accuracy.rtol or rtol <= self._rtol
        wanted = self._rtol if is_exact else max(rtol, self._rtol)
        moved = run.tangential(pressure) - self._drawn
        taken = run.friction.take(self._before, pressure, self._imposed, moved, self._taken, wanted)
        self._taken = taken
        return Next(run.normal(taken.state.traction), taken)

    def scale(self, contact: HeldContact) -> float:
        """See `Unknown.scale`."""
        return displacement_scale(contact, self._run.plan.prepared.solver.self_influence)


def follow_coupled(plan: ContactPlan, effect: PartialSlip, counter: WorkCounter) -> Solved:
    """Press the bodies together in steps, then follow the tangential load path.

    Raises
    ------
    InfeasibleError
        If a force exceeds the friction of full sliding.
    """
    begun, run = time.perf_counter(), _Run(plan, effect, counter)
    pressed = _press(run, effect)
    # The path counts its displacement from here.
    near = pressed.near
    state = near.taken.state._replace(rigid=np.zeros(2))
    near = near._replace(taken=near.taken._replace(state=state))
    record = Record(run.friction, near.taken)
    target = run.target(1.0)
    for number, step in enumerate(effect.path):
        for imposed in sub_steps(run.friction, number, step, near.taken.state):
            if near.solved.problem:
                break
            if not run.friction.holds(near.taken.state, imposed):
                near = _sub_step(run, near.taken.state, target, imposed, near)
            record.add(number, near.taken)
        record.end_step(near.taken.state)
    return _finished(run, near, record, pressed, begun)


def _press(run: _Run, effect: PartialSlip) -> _Pressed:
    """Press the bodies together in the steps asked for, or in as many as their error needs."""
    if (history := run.plan.scene.effect(PlasticHistory)) is not None:
        from .plastic_history import PlasticPath

        run.plastic = PlasticPath(run.plan, history)
        targets = run.plastic.targets()
        return _Pressed(_pressed(run, targets), len(targets), None)
    steps = effect.pressing_steps
    if steps is not None:
        near = _pressed(run, run.targets(steps))
        half = steps // 2
        if not half or near.solved.problem:
            return _Pressed(near, steps, None)
        coarse = _pressed(run, run.targets(half), _LOOSEST)
        return _Pressed(near, steps, _step_error(near, steps, coarse, half))
    coarse = _pressed(run, run.targets(_FEWEST), _LOOSEST)
    steps = _REFINED * _FEWEST
    while True:
        near = _pressed(run, run.targets(steps))
        error = _step_error(near, steps, coarse, _FEWEST)
        if near.solved.problem or error <= effect.pressing_error or steps >= _MOST_STEPS:
            return _Pressed(near, steps, error)
        wanted = math.ceil(_SPARE * steps * error / effect.pressing_error)
        steps = min(wanted, _MOST_STEPS)


def _pressed(run: _Run, targets: list[Target], last: float = 0.0) -> _State:
    """Press the bodies together without a tangential force; `last` is the last step's tolerance."""
    free = Imposed("force", 0.0, np.array([1.0, 0.0]), True)
    state, near = run.friction.at_rest(np.zeros(run.plan.grid.shape)), None
    for i, target in enumerate(targets, 1):
        # Flow adds up: the shape that a loose step leaves would stay wrong.
        is_loose = i < len(targets) and run.plastic is None
        near = _sub_step(run, state, target, free, near, _LOOSEST if is_loose else last)
        state = near.taken.state
        if near.solved.problem:
            problem = f"pressing step {i} of {len(targets)}: {near.solved.problem}"
            return near._replace(solved=near.solved._replace(problem=problem))
    assert near is not None
    return near


def _sub_step(
    run: _Run,
    before: SlipState,
    target: Target,
    imposed: Imposed,
    near: _State | None,
    least: float = 0.0,
) -> _State:
    """Solve pressure and tractions at the end of a sub-step, from a solution nearby if any."""
    plan = run.plan if run.plastic is None else run.plastic.shaped()
    if least > plan.accuracy.rtol:
        plan = evolve(plan, accuracy=evolve(plan.accuracy, rtol=least))
    unknown = SlipDisplacement(run, before, imposed, near.taken if near else None, least)
    step = Step(plan, run.counter, (unknown,), max(run.plan.accuracy.outer_rtol, least))
    solved = solve_loaded(step, target if near is None else near.solved.near(target))
    if run.plastic is not None:
        run.plastic.deform(plan.heights, solved)
    return _State(step, solved, solved.memories[unknown.name])


def _step_error(fine: _State, steps: int, coarse: _State, fewer: int) -> float:
    """Error of the tractions, rms over that of their bound, from those with fewer steps [-].

    It is of first order in the steps. Measured on spheres and rough surfaces it is 0.5 to 1 of
    this, as tractions err by rings of a step each, in other places with other steps: they cannot be
    extrapolated.
    """
    bound = float(np.linalg.norm(fine.taken.bound))
    change = fine.taken.state.traction - coarse.taken.state.traction
    error = float(np.linalg.norm(change)) / (steps / fewer - 1.0)
    return error / bound if bound > 0.0 else 0.0


def _finished(run: _Run, near: _State, record: Record, pressed: _Pressed, begun: float) -> Solved:
    """Contact of the last state, with the path as the part of its effect."""
    solved = near.step.finished(near.solved, run.target(1.0))
    frictional, pressure = solved.contact.frictional, solved.contact.contact_pressure
    assert frictional is not None
    without = frictional.pressure_without
    maximum = float(without.max(initial=0.0)) or 1.0
    area = np.count_nonzero(pressure) / (np.count_nonzero(without) or 1)
    coupling = SlipCoupling(
        displacement=frictional.displacement,
        pressure_change=float(np.abs(pressure - without).max()) / maximum,
        area_change=float(area - 1.0) if without.any() else 0.0,
        step_error=pressed.error,
        contacts=run.counter.n_solves,
        applications=run.coupling.count,
        pressing_steps=pressed.steps,
    )
    run.counter.clock(PartialSlip.name, begun)
    made = solved._replace(parts={**solved.parts, PartialSlip: record.part(coupling)})
    return made if run.plastic is None else run.plastic.finished(made)
