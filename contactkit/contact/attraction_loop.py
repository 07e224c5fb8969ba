r"""Contact with an attraction across the gap: fixed-point iterations on the tension.

.. math:: p = q - t, \qquad t = \tau(g), \qquad q \ge 0

For a given tension t the pressure q of contact is that of a contact without attraction, of the
heights :math:`h + G t` and, if there is one, the hardness :math:`H + t`; under a load it carries
the load and the tension. The energy of attraction is concave in the gap, so that every step
:math:`t \leftarrow \tau(g(t))` lowers the energy; it ends at a stable state for any grid.

Where a pressure lowers the surface everywhere (isolated contacts), more tension narrows every gap:
the steps only rise from no tension to the state of an approach, or only fall from the state of a
smaller gap to that of a separation. They are accelerated by momentum, which starts afresh whenever
the iterates turn round; a third to a half of the steps remain. In a periodic window with a mean
plane that is held, states are not ordered and momentum could choose among those after a jump:
there a state far from the start is that of the plain steps.

A load may pull: then the steps fall from the state of the bodies at rest under no load. Without
contact no state under a load is stable, as the tension falls when the gap opens; where tension and
pull leave no load to the contact, the bodies have been pulled off.
"""

from __future__ import annotations

import time
from copy import copy
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from ..errors import InfeasibleError
from .effects.base import AttractedContact, Attraction, Contact, FixedHardness
from .friction_loop import Target
from .hardness_loop import Solved, contact_of
from .plan import ContactPlan
from .solver.contact_solver import Solution
from .work import WorkCounter

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Map = NDArray[np.float64]

__all__ = ["solve_attracted"]

_MAX_ITERATIONS = 3000
_INNER = 0.1  # tolerance of a contact over the change of its gap that the tension last had
_LEAST_INNER = 1e-3
_TIGHTER = 0.3  # factor of that ratio where the change no longer falls
_PATIENCE = 5  # iterations without a smaller change after which contacts are solved more tightly
_LOOSEST = 1e-3
_FINEST = 1e-12  # below, the violation of the contact conditions is round-off
_SLOWEST = 1e-3  # 1 - rate of convergence that the estimate of the error assumes at least
_MEMORY = 5  # estimates of the rate of which the slowest counts
_SMOOTH = 0.1  # change of the tension over its maximum, from one state to the next without a jump
_PULL_OFF = 1e-2  # error of the pull-off force in a refusal
_MAX_HALVINGS = 20


class _Pulled(NamedTuple):
    """A contact under a given tension, and the tension of its gap.

    A change of the tension over its maximum below `floor` is that of contacts which are not solved
    any better.
    """

    solution: Solution
    touching: NDArray[np.bool_]
    displacement: Map
    tension: Map
    floor: float


class _Settled(NamedTuple):
    """A state, the tension that it was solved with, and what did not converge, if anything."""

    state: _Pulled
    tension: Map
    problem: str


class _ContactMap:
    """The contact under a given tension: one step of the fixed point."""

    def __init__(
        self, plan: ContactPlan, attraction: Attraction[Any], target: Target, counter: WorkCounter
    ) -> None:
        self.plan, self.target, self.counter = plan, target, counter
        self.solver = plan.prepared.solver
        self.law = attraction.prepare(self.solver.self_influence)
        hardness = plan.hardness
        self.hardness = hardness.value if isinstance(hardness, FixedHardness) else None
        self.n_contacts = 0

    def under(self, load: float) -> _ContactMap:
        """Return the same map under another mean pressure [Pa]; its contacts are counted here."""
        other = copy(self)
        other.target = self.target._replace(mean_pressure=load)
        return other

    def carries(self, tension: Map) -> bool:
        """Whether a load, if one is imposed, leaves the contact something to carry."""
        load = self.target.mean_pressure
        return load is None or load >= 0.0 or load + float(tension.mean()) > 0.0

    def is_reached(self, tension: Map, start: Map) -> bool:
        """Whether the state is that of the plain iterates, wherever momentum carried them.

        Where a mean plane is held, more tension here opens gaps there: after a jump, which changes
        the tension somewhere by more than a smooth step does, momentum may end in another state.
        """
        is_held = self.target.mean_pressure is None and self.plan.grid.periodic
        if not is_held or self.solver.uniform_compliance:
            return True
        return float(np.abs(tension - start).max()) <= _SMOOTH * self.law.strength

    def pulled(self, tension: Map) -> Map:
        """Displacement [m] that a tension causes against that of a pressure, (ny, nx)."""
        found = self.solver.displacement(tension)
        # Of a uniform tension on a periodic half-space round-off remains, which is no roughness.
        largest = max(float(found.max()), -float(found.min()))
        is_round_off = largest <= 1e-12 * self.solver.self_influence * self.law.strength
        return np.zeros_like(found) if is_round_off else found

    def at(self, tension: Map, start: Map | None, change: float) -> _Pulled:
        """Solve the contact, its tension to an accuracy of `change` times its maximum."""
        plan, target, accuracy = self.plan, self.target, self.plan.accuracy
        pulled = self.pulled(tension)
        load = target.mean_pressure
        heights = plan.heights + pulled
        # Change of the tension over its maximum at an error of the gap of the rms height. A slope
        # much narrower than the range, as the end of a Dugdale law on a stiff film, asks for more.
        unit = max(float(heights.std()) * self.law.steepest / self.law.strength, 1.0)
        finest = max(min(0.1 * accuracy.rtol, _INNER * accuracy.outer_rtol / unit), _FINEST)
        solution = self.solver.solve(
            heights,
            mean_pressure=None if load is None else load + float(tension.mean()),
            rigid_approach=target.rigid_approach,
            bound=None if self.hardness is None else self.hardness + tension,
            rtol=float(np.clip(change / unit, finest, _LOOSEST)),
            start=start if start is not None and start.any() else None,
            max_iterations=accuracy.max_iterations,
            method=accuracy.method,
        )
        self.counter.add(solution)
        self.n_contacts += 1
        touching = solution.pressure > 0.0
        displacement = solution.displacement - pulled
        gap = displacement - plan.heights - solution.rigid_approach
        gap[touching] = 0.0
        np.maximum(gap, 0.0, out=gap)
        return _Pulled(solution, touching, displacement, self.law.tension(gap), 3.0 * finest * unit)


def solve_attracted(
    plan: ContactPlan,
    attraction: Attraction[Any],
    target: Target,
    before: AttractedContact | None,
    counter: WorkCounter,
) -> tuple[Solved, Contact]:
    """Solve a contact with an attraction, from no tension or from that of a state before.

    Parameters
    ----------
    plan : ContactPlan
        What to solve.
    attraction : Attraction
        The effect of the scene.
    target : Target
        Load or approach, and the pressure to start from.
    before : AttractedContact, optional
        State to start from, which decides on the branch; without one, the surfaces come together.
    counter : WorkCounter
        Counts the contacts.

    Raises
    ------
    InfeasibleError
        If the load pulls the bodies off; names the pull-off force.
    """
    begun = time.perf_counter()
    contacts = _ContactMap(plan, attraction, target, counter)
    first = _first(contacts, before)
    settled = _settled(contacts, *first)
    # Momentum may also carry the iterates past the last state before the pull-off.
    if settled is None or not contacts.is_reached(settled.tension, first[0]):
        settled = _settled(contacts, *first, has_momentum=False)
    if settled is None:
        raise _pulled_off(contacts, first, before)
    solved, contact = _described(plan, contacts, *settled)
    counter.clock(attraction.name, begun)
    return solved, contact


def _first(contacts: _ContactMap, before: AttractedContact | None) -> tuple[Map, Map | None]:
    """Tension and pressure of contact to start from."""
    tension: Map = np.zeros(contacts.plan.grid.shape)
    pressure, load = _newest(contacts.target), contacts.target.mean_pressure
    if before is not None and pressure is not None:
        return before.tension, np.where(before.touching, pressure + before.tension, 0.0)
    if load is None or load >= 0.0:
        return tension, pressure
    at_rest = _settled(contacts.under(0.0), tension, pressure)
    return (at_rest.tension, at_rest.state.solution.pressure) if at_rest else (tension, pressure)


def _pulled_off(
    contacts: _ContactMap, first: tuple[Map, Map | None], before: AttractedContact | None
) -> InfeasibleError:
    """Find the pull-off force, by halving, from the state to start from; say that it is exceeded.

    Every smaller pull is carried, as the tension only falls as the pull grows.
    """
    area, pull = contacts.plan.grid.area, -float(contacts.target.mean_pressure or 0.0)
    carried, too_much, (tension, pressure) = 0.0, min(pull, float(first[0].mean())), first
    for _ in range(_MAX_HALVINGS):
        if too_much - carried <= _PULL_OFF * too_much:
            break
        trial = 0.5 * (carried + too_much)
        settled = _settled(contacts.under(-trial), tension, pressure)
        if settled is None or settled.problem:
            too_much = trial
        else:
            carried, tension, pressure = trial, settled.tension, settled.state.solution.pressure
    where = "the state to start from" if before is not None else "a contact under no load"
    return InfeasibleError(
        f"a pull of {pull * area:.6g} N exceeds the pull-off force, about {carried * area:.3g} N "
        f"from {where}: the bodies separate; pull less, or impose an Approach"
        + ("" if before is not None else "; rough bodies pressed before, start=, may hold more")
    )


def _newest(target: Target) -> Map | None:
    """Pressure of the newest of the results to start from."""
    start = target.start
    return start if start is None or isinstance(start, np.ndarray) else start[0][1]


def _settled(
    contacts: _ContactMap, tension: Map, pressure: Map | None, *, has_momentum: bool = True
) -> _Settled | None:
    """Iterate until the tension of the gap is the one that causes it.

    None if the load pulls the bodies off.
    """
    tolerance, strength = contacts.plan.accuracy.outer_rtol, contacts.law.strength
    before, age, change, forcing = tension, 0, 1.0, _Forcing()
    rates: list[float] = []
    last: tuple[Map, Map] | None = None
    for _ in range(_MAX_ITERATIONS):
        if not contacts.carries(tension):
            return None
        state = contacts.at(tension, pressure, forcing.ratio(change) * change)
        pressure = state.solution.pressure
        residual = state.tension - tension
        change = float(np.abs(residual).max()) / strength
        if last is not None:
            rates = [*rates[1 - _MEMORY :], _decay(tension - last[0], residual - last[1])]
        is_exact = state.solution.kkt <= contacts.plan.accuracy.rtol
        if not (state.solution.converged or is_exact):
            return _Settled(state, tension, _inner_problem(contacts, state.solution))
        if change <= max(tolerance * min(rates, default=1.0), min(state.floor, tolerance)):
            if is_exact:
                return _Settled(state, tension, "")
            change = 0.0  # the tension has settled in a contact that was solved loosely
        last = tension, residual
        step = state.tension - before
        turns = float(np.einsum("ij,ij->", residual, step)) <= 0.0
        age = 0 if turns else age + 1
        before = state.tension
        ahead = max(age - 1, 0) / (age + 2.0) if has_momentum else 0.0
        tension = np.clip(before + ahead * step, 0.0, strength)
    return _Settled(state, tension, _unsettled(contacts, change))


class _Forcing:
    """Tolerance of a contact over the last change of its tension, which must fall.

    Under a stiff film errors of a contact reach far beyond it and come back larger: the change then
    swings instead of falling, until contacts are solved more tightly.
    """

    def __init__(self) -> None:
        self.inner, self.least, self.age = _INNER, np.inf, 0

    def ratio(self, change: float) -> float:
        """Return the ratio after a change of the tension over its maximum."""
        self.age = 0 if change < self.least else self.age + 1
        self.least = min(change, self.least)
        if self.age >= _PATIENCE:
            self.inner, self.age = max(_TIGHTER * self.inner, _LEAST_INNER), 0
        return self.inner


def _decay(step: Map, change: Map) -> float:
    """Part of an error that an iteration removes, from two of them."""
    square = float(np.einsum("ij,ij->", step, step))
    found = -float(np.einsum("ij,ij->", step, change)) / square if square > 0.0 else 1.0
    return min(max(found, _SLOWEST), 1.0)


def _unsettled(contacts: _ContactMap, change: float) -> str:
    cure = f"{contacts.law.cure}, " if contacts.law.cure else ""
    return (
        f"the tension still changes by {change:.2g} of its maximum after {_MAX_ITERATIONS} "
        f"iterations, next to a jump of the contact; {cure}change the approach or load a little, "
        "or raise Accuracy.rtol"
    )


def _inner_problem(contacts: _ContactMap, solution: Solution) -> str:
    return (
        f"the contact conditions under the tension are violated by {solution.kkt:.2g} of the rms "
        f"height after {solution.n_applications} operator applications; raise "
        "Accuracy.max_iterations or rtol"
    )


def _described(
    plan: ContactPlan, contacts: _ContactMap, state: _Pulled, tension: Map, problem: str
) -> tuple[Solved, Contact]:
    """Show the net pressure as that of a solved contact."""
    pressure = state.solution.pressure - tension
    work = np.einsum("ij,ij->", pressure, 0.5 * state.displacement - plan.heights)
    solution = state.solution._replace(
        pressure=pressure,
        displacement=state.displacement,
        energy=float(work) * plan.grid.pixel_area,
    )
    solved = Solved(solution, contacts.hardness, None, problem)
    contact = contact_of(plan, solved)
    contact.gap[state.touching] = 0.0
    attracted = AttractedContact(
        tension, state.touching, contacts.solver.self_influence, contacts.n_contacts
    )
    for one in (tension, state.touching):
        one.flags.writeable = False
    return solved, contact._replace(attracted=attracted)
