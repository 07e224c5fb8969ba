r"""Partial slip of dissimilar bodies: pressure and tractions displace each other's surfaces.

Pressing draws the surfaces along the contact, and friction holds some of that back; the tractions
in turn displace the surfaces along the normal. With the compliances C (normal), H (tangential) and
B (normal displacement by tractions), each sub-step from p_0, q_0 to p, q ends where

.. math:: C p + B q = h + \delta + g, \qquad H (q - q_0) + B^T (p - p_0) = D - s

with pressure where the gap g is zero, and Coulomb's law for q and the slip s of the step. The loop
alternates between both: p with B q as a part of the heights, and q with B^T (p - p_0) as a given
displacement.
"""

from __future__ import annotations

import math
import time
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from attrs import evolve

from ..scene.loading import Approach
from .effects.base import Contact
from .effects.elasticity import bodies_of, layers_of
from .effects.partial_slip import PartialSlip
from .friction_loop import Friction as NormalFriction
from .friction_loop import Target
from .hardness_loop import Solved, contact_of, solve_with_hardness
from .plan import ContactPlan
from .prepared import Once
from .slip.coupling import coupling_of
from .slip.load_path import Friction, Imposed, Record, SlipState, Taken, sub_steps
from .slip.states import PartialSlipPart, SlipCoupling
from .work import WorkCounter

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Map = NDArray[np.float64]

__all__ = ["CoupledSlip", "follow_coupled"]

_MOST_PASSES = 60
_REMEMBERED = 4  # passes that are combined into the next one
_LOOSEST = 1e-4  # tolerance of a first pass, and of all steps of pressing but the last: their error
# then changes the tractions by less than 1e-3 of their bound, a third of the passes is saved
_AHEAD = 0.03  # tolerance of a pass over the change of the last one
_GROWTH = 2.0  # power of the loads: between areas of equal growth (1 rough, 3 a sphere)
_WITHOUT = 1e-6  # tolerance of the contact without tractions, which is only compared with
_FEWEST = 4  # pressing steps that others are compared with
_REFINED = 4  # times as many, for a first estimate of their error
_MOST_STEPS = 256  # of pressing: a contact of as many pixels across gains one of them by each
_SPARE = 1.1  # on the number of steps that an error of first order asks for


class CoupledSlip(NamedTuple):
    """The last contact of a load path, and the path as the part of its effect."""

    solved: Solved
    contact: Contact
    part: PartialSlipPart


class _Pass(NamedTuple):
    """Normal displacement [m] assumed in a contact, and the one that its tractions cause."""

    assumed: Map
    caused: Map


class _State(NamedTuple):
    """A contact with its tractions, the normal displacement by them [m], and what went wrong."""

    solved: Solved
    taken: Taken
    displacement: Map
    problem: str = ""


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
        self.n_contacts = 0

    def target(self, fraction: float) -> Target:
        """Load or approach at a fraction of that of the scene."""
        loading, load = self.plan.scene.loading, self.plan.mean_pressure
        if isinstance(loading, Approach):
            touch = self.plan.prepared.first_touch
            return Target(None, touch + fraction * loading.approach)
        return Target(fraction * (load or 0.0), None)

    def contact(self, target: Target, displacement: Map, rtol: float) -> Solved:
        """Solve the contact under a given normal displacement by tractions [m]."""
        plan = self.plan
        shape = plan.prepared.with_heights(plan.heights - displacement)
        accuracy = evolve(plan.accuracy, rtol=rtol)
        self.n_contacts += 1
        here = evolve(plan, accuracy=accuracy, interface=Once(lambda: shape))
        return solve_with_hardness(here, target, self.counter)

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

    def scale(self, solved: Solved) -> float:
        """Displacement that others are small against [m]."""
        solution = solved.solution
        own = float(solution.pressure.max()) * self.plan.prepared.solver.self_influence
        return max(float(np.ptp(solution.displacement)), own, np.finfo(float).tiny)


def follow_coupled(plan: ContactPlan, effect: PartialSlip, counter: WorkCounter) -> CoupledSlip:
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
            if near.problem:
                break
            if not run.friction.holds(near.taken.state, imposed):
                near = _sub_step(run, near.taken.state, target, imposed, near)
            record.add(number, near.taken)
        record.end_step(near.taken.state)
    return _finished(run, near, record, pressed, begun)


def _press(run: _Run, effect: PartialSlip) -> _Pressed:
    """Press the bodies together in the steps asked for, or in as many as their error needs."""
    steps = effect.pressing_steps
    if steps is not None:
        near = _pressed(run, steps)
        half = steps // 2
        if not half or near.problem:
            return _Pressed(near, steps, None)
        coarse = _pressed(run, half, _LOOSEST)
        return _Pressed(near, steps, _step_error(near, steps, coarse, half))
    coarse = _pressed(run, _FEWEST, _LOOSEST)
    steps = _REFINED * _FEWEST
    while True:
        near = _pressed(run, steps)
        error = _step_error(near, steps, coarse, _FEWEST)
        if near.problem or error <= effect.pressing_rtol or steps >= _MOST_STEPS:
            return _Pressed(near, steps, error)
        wanted = math.ceil(_SPARE * steps * error / effect.pressing_rtol)
        steps = min(wanted, _MOST_STEPS)


def _pressed(run: _Run, steps: int, last: float = 0.0) -> _State:
    """Press the bodies together without a tangential force; `last` is the last step's tolerance."""
    free = Imposed("force", 0.0, np.array([1.0, 0.0]), True)
    state, near = run.friction.at_rest(np.zeros(run.plan.grid.shape)), None
    for i in range(1, steps + 1):
        least = _LOOSEST if i < steps else last
        near = _sub_step(run, state, run.target((i / steps) ** _GROWTH), free, near, least)
        state = near.taken.state
        if near.problem:
            return near._replace(problem=f"pressing step {i} of {steps}: {near.problem}")
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
    accuracy = run.plan.accuracy
    rtols = max(accuracy.rtol, least), max(run.law.rtol, least)
    outer, drawn = max(accuracy.outer_rtol, least), run.tangential(before.pressure)
    displacement: Map = np.zeros(run.plan.grid.shape)
    taken: Taken | None = None
    history = list[_Pass]()
    if near is not None:
        displacement, taken = near.displacement, near.taken
        target = target._replace(start=near.solved.solution.pressure)
    loose, last = _LOOSEST, np.inf
    for _ in range(_MOST_PASSES):
        solved = run.contact(target, displacement, max(loose, rtols[0]))
        pressure = solved.solution.pressure
        moved = run.tangential(pressure) - drawn
        taken = run.friction.take(before, pressure, imposed, moved, taken, max(loose, rtols[1]))
        caused = run.normal(taken.state.traction)
        if solved.problem:
            return _State(solved, taken, caused, solved.problem)
        change = float(np.abs(caused - displacement).max()) / run.scale(solved)
        if change <= outer and loose <= min(rtols):
            return _State(solved, taken, caused)
        loose = _AHEAD * change if change > outer else 0.0
        history = history[1 - _REMEMBERED :] if change < 2.0 * last else []
        history, last = [*history, _Pass(displacement, caused)], change
        displacement = _combined(history)
        target = target._replace(start=pressure)
    problem = (
        f"pressure and tractions still change each other by {change:.2g} of the displacement after "
        f"{_MOST_PASSES} iterations, tolerance {outer:g}; use more PartialSlip.pressing_steps, a "
        "smaller coefficient, a larger Accuracy.rtol, or leave coupled out"
    )
    assert taken is not None
    return _State(solved, taken, caused, problem)


def _combined(history: list[_Pass]) -> Map:
    """Displacement at which the passes, were they linear, would agree best (Anderson's method)."""
    now = history[-1]
    if len(history) == 1:
        return now.caused
    missed = (now.caused - now.assumed).ravel()
    turned = np.array([missed - (one.caused - one.assumed).ravel() for one in history[:-1]])
    shares = np.linalg.lstsq(turned @ turned.T, turned @ missed, rcond=1e-10)[0]
    found = now.caused.copy()
    for share, one in zip(shares, history[:-1], strict=True):
        found -= share * (now.caused - one.caused)
    return found


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


def _finished(
    run: _Run, near: _State, record: Record, pressed: _Pressed, begun: float
) -> CoupledSlip:
    """Contact and part of the last state."""
    plan, solution = run.plan, near.solved.solution
    start = run.target(1.0)._replace(start=solution.pressure)
    rtol = max(plan.accuracy.rtol, _WITHOUT)
    without = run.contact(start, np.zeros(plan.grid.shape), rtol).solution.pressure
    maximum = float(without.max(initial=0.0)) or 1.0
    area = np.count_nonzero(solution.pressure) / (np.count_nonzero(without) or 1)
    coupling = SlipCoupling(
        displacement=near.displacement,
        pressure_change=float(np.abs(solution.pressure - without).max()) / maximum,
        area_change=float(area - 1.0) if without.any() else 0.0,
        step_error=pressed.error,
        contacts=run.n_contacts,
        applications=run.coupling.count,
        pressing_steps=pressed.steps,
    )
    coupling.displacement.flags.writeable = False
    friction = NormalFriction(near.displacement, without)
    solved = near.solved._replace(friction=friction, problem=near.problem)
    run.counter.clock(PartialSlip.name, begun)
    return CoupledSlip(solved, contact_of(plan, solved), record.part(coupling))
