"""Outer iteration of a contact: unknowns of its effects that agree with the contact they lead to.

All unknowns are one fixed point. Tensions are accelerated by momentum, as their iterates are
monotonic; all others together by Anderson's method.
"""

from __future__ import annotations

import math
import time
from typing import TYPE_CHECKING, Any, NamedTuple, TypeVar

import numpy as np

from ...numerics.fixed_point import Accelerator, Anderson, Evaluation, Momentum, Plain, settle
from ...numerics.roots import Bracket, Probe, balance
from .held_contact import solve_held
from .unknown import Held, HeldContact, Next, Target, Unknown

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from ..plan import ContactPlan
    from ..work import WorkCounter

    Map = NDArray[np.float64]

__all__ = [
    "MAX_ITERATIONS",
    "MAX_MONOTONIC",
    "Outer",
    "Separated",
    "Settled",
    "settle_balance",
    "settle_unknowns",
    "unsettled",
]

Value = TypeVar("Value")

# Where the map contracts, 5 to 15 iterations are enough; what has not settled after 60 swings.
MAX_ITERATIONS = 60
# Monotonic iterates do settle, but slowly next to a jump of the contact.
MAX_MONOTONIC = 3000


class Separated(Exception):
    """Tension and pull leave the contact no load to carry."""


class Settled(NamedTuple):
    """A contact and the unknowns it was solved with, by their names.

    `memories` are what their effects remember, `first` the contact under the first values, and
    `problem` states what did not settle; it is empty if all did.
    """

    contact: HeldContact
    values: dict[str, Map]
    memories: dict[str, Any]
    first: HeldContact
    problem: str = ""


class Outer(NamedTuple):
    """A plan, the unknowns of its contact, their tolerance [-], and the counter of its contacts."""

    plan: ContactPlan
    unknowns: tuple[Unknown, ...]
    tolerance: float
    counter: WorkCounter


class _Iteration:
    """Contacts under the unknowns of one target, as the map of a fixed point."""

    def __init__(self, outer: Outer, target: Target, bound: Map | float | None) -> None:
        self.plan, self.unknowns, self.counter = outer.plan, outer.unknowns, outer.counter
        self.target, self.bound = target, bound
        self.contact: HeldContact | None = None
        self.first: HeldContact | None = None
        self.found: tuple[Next, ...] = ()

    def evaluate(self, values: tuple[Map, ...], allowed: float) -> Evaluation:
        """Solve the contact under the unknowns and renew them."""
        held = Held(self.bound)
        for unknown, value in zip(self.unknowns, values, strict=True):
            if not unknown.carries(value, self.target):
                raise Separated
            held = unknown.hold(held, value)
        rtol = self._rtol(allowed)
        contact = solve_held(self.plan, self.target, held, rtol, self.counter)
        self.contact, self.first = contact, self.first or contact
        solution, accuracy = contact.solution, self.plan.accuracy
        self.target = self.target._replace(start=solution.pressure)
        is_exact = solution.kkt <= accuracy.rtol
        if not (solution.converged or is_exact):
            return Evaluation(values, (math.inf,), (1.0,) * len(values), is_failed=True)
        self.found = tuple(self._renewed(one, contact, rtol) for one in self.unknowns)
        pairs = list(zip(self.unknowns, values, self.found, strict=True))
        heights = self.plan.heights
        return Evaluation(
            tuple(one.value for one in self.found),
            tuple(unknown.change(value, one.value, contact) for unknown, value, one in pairs),
            tuple(unknown.scale(contact) for unknown in self.unknowns),
            max((unknown.floor(accuracy, heights) for unknown in self.unknowns), default=0.0),
            is_exact and all(one.is_exact for one in self.found),
        )

    def admit(self, values: tuple[Map, ...], found: tuple[Map, ...]) -> tuple[Map, ...]:
        """Move accelerated values to where a contact exists."""
        trios = zip(self.unknowns, values, found, strict=True)
        return tuple(one.admitted(value, image, self.target) for one, value, image in trios)

    def _rtol(self, allowed: float) -> float:
        """Tolerance of a contact whose error may change the unknowns by `allowed` of their size."""
        accuracy, heights = self.plan.accuracy, self.plan.heights
        return min(
            (
                max(
                    min(
                        allowed / one.sensitivity(heights),
                        one.loosest if self.first else one.first_rtol,
                    ),
                    one.finest(accuracy, heights),
                )
                for one in self.unknowns
            ),
            default=accuracy.rtol,
        )

    def _renewed(self, unknown: Unknown, contact: HeldContact, rtol: float) -> Next:
        begun = time.perf_counter()
        found = unknown.renewed(contact, rtol)
        self.counter.clock(unknown.effect, begun)
        return found


def settle_unknowns(
    outer: Outer, target: Target, bound: Map | float | None, *, has_momentum: bool = True
) -> Settled:
    """Solve a contact with its unknowns.

    Parameters
    ----------
    outer : Outer
        The contact; without any unknown it is solved once.
    target : Target
        Load or approach, and where to start.
    bound : float or ndarray, optional
        Bound of the pressure [Pa] that is no unknown.
    has_momentum : bool
        Whether monotonic unknowns are accelerated.

    Raises
    ------
    Separated
        If tension and pull leave the contact nothing to carry.
    """
    plan = outer.plan
    ordered = tuple(sorted(outer.unknowns, key=lambda one: not one.is_monotonic))
    n = sum(one.is_monotonic for one in ordered)
    groups: list[tuple[slice, Accelerator]] = []
    if n:
        groups.append((slice(0, n), Momentum() if has_momentum else Plain()))
    if n < len(ordered):
        memory = max(one.memory for one in ordered[n:])
        groups.append((slice(n, len(ordered)), Anderson(memory)))
    iteration = _Iteration(outer._replace(unknowns=ordered), target, bound)
    end = settle(
        iteration.evaluate,
        tuple(one.first(target) for one in ordered),
        tuple(groups),
        outer.tolerance,
        admit=iteration.admit,
        max_iterations=MAX_MONOTONIC if n else _most_of(ordered),
    )
    contact, first = iteration.contact, iteration.first
    assert contact is not None
    assert first is not None
    problem = ""
    if not end.is_settled or not contact.solution.kkt <= plan.accuracy.rtol:
        problem = _inner_problem(plan, contact)
    if not problem and not end.is_settled:
        problem = _unsettled(ordered, end.changes, end.n_evaluations, outer.tolerance)
    pairs = zip(ordered, end.values, strict=True)
    values = {one.name: one.settled(value, contact) for one, value in pairs}
    return Settled(
        contact,
        values,
        {one: found.memory for one, found in zip(values, iteration.found, strict=True)},
        first,
        problem,
    )


def _most_of(unknowns: tuple[Unknown, ...]) -> int:
    return math.ceil(MAX_ITERATIONS * max((one.slowness for one in unknowns), default=1.0))


def settle_balance(
    evaluate: Callable[[float, float], Probe[Value] | None],
    bracket: Bracket[Value],
    guess: Callable[[Bracket[Value]], float],
    tolerance: float,
) -> bool:
    """Search a balance within as many trials as unknowns have iterations; see `balance`."""
    return balance(evaluate, bracket, guess, tolerance, max_iterations=MAX_ITERATIONS)


def unsettled(name: str, change: str, tolerance: float, cure: str) -> str:
    """State what has not settled within `MAX_ITERATIONS`, how far it is, and the cure."""
    return f"the {name} still changes by {change}, tolerance {tolerance:g}; {cure}"


def _unsettled(
    unknowns: tuple[Unknown, ...], changes: tuple[float, ...], n: int, tolerance: float
) -> str:
    """Name the unknown that still changes most."""
    worst = max(range(len(unknowns)), key=changes.__getitem__)
    one, change = unknowns[worst], f"{changes[worst]:.2g}"
    return unsettled(
        one.name, f"{change} of {one.measure} after {n} iterations", tolerance, one.cure
    )


def _inner_problem(plan: ContactPlan, contact: HeldContact) -> str:
    """State the violation of the contact conditions, and the cure; empty if there is none."""
    solution, accuracy = contact.solution, plan.accuracy
    if solution.converged or solution.kkt <= accuracy.rtol:
        return ""
    if solution.is_stalled:
        cure = "round-off keeps it from falling further; raise Accuracy.rtol"
    elif accuracy.method == "active-set":
        cure = (
            "raise Accuracy.rtol, start from the result of a lower load, or use "
            "method='conjugate-gradient', which converges slowly but surely"
        )
    else:
        cure = "raise Accuracy.max_iterations or rtol, or use method='active-set'"
    return (
        f"the contact conditions are violated by {solution.kkt:.2g} of the rms height, tolerance "
        f"{accuracy.rtol:g}, after {solution.n_applications} operator applications; {cure}"
    )
