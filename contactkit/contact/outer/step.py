"""One contact under a load or at an approach, with its unknowns and its hardness.

Maps are a fixed point (`iteration`). A hardness that all pixels share is one number: the root of a
balance in a bracket, each trial of which settles the maps.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from attrs import evolve

from ..effects.base import (
    AttractedContact,
    BoundedContact,
    DisplacementTerm,
    FixedHardness,
    FrictionalContact,
    InterfaceView,
    SolvedContact,
    VaryingHardness,
    effects_of,
)
from ..plan import ContactPlan
from ..work import WorkCounter
from .branches import settle_attracted
from .hardness_balance import settle_hardness
from .iteration import Outer, Settled, settle_unknowns
from .tension import on_branch_of
from .unknown import HeldContact, Target, Unknown

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ..solver.contact_solver import Solution

    Map = NDArray[np.float64]

__all__ = ["Solved", "Step"]

_WITHOUT = 1e-6  # tolerance of the contact without tractions, which is only compared with


class Solved(NamedTuple):
    """A contact whose unknowns agree with it, as the solver and as the effects see it.

    `solution` is that of the pressure less the tension. `values` and `memories` of the unknowns are
    found by their names, `parts` of effects that were made with the solve by their classes. Without
    tractions, held else as it is, the pressure of contact is `without` [Pa], if that is known.
    `problem` states what did not settle, if anything.
    """

    solution: Solution
    contact: SolvedContact
    hardness: Map | float | None
    values: dict[str, Map]
    memories: dict[str, Any]
    parts: dict[type, Any]
    without: Map | None = None
    problem: str = ""

    @property
    def pressure(self) -> Map:
        """Pressure of contact alone [Pa], without the tension."""
        attracted = self.contact.attracted
        if attracted is None:
            return self.solution.pressure
        return np.where(attracted.touching, self.solution.pressure + attracted.tension, 0.0)

    def near(self, target: Target) -> Target:
        """Return a target that starts from here."""
        hardness = self.hardness if isinstance(self.hardness, float) else None
        return target._replace(start=self.pressure, hardness=hardness, unknowns=self.values)


class Step:
    """Contact of one shape and hardness law, ready for any load: a scene, or a step of a path.

    Parameters
    ----------
    plan : ContactPlan
        Heights, hardness law and accuracy of the step.
    counter : WorkCounter
        Counts its contacts.
    more : tuple of Unknown
        Unknowns of a path, beside those that the effects bring.
    tolerance : float, optional
        Tolerance of the unknowns [-]; None: that of the accuracy of the plan.
    """

    def __init__(
        self,
        plan: ContactPlan,
        counter: WorkCounter,
        more: tuple[Unknown, ...] = (),
        tolerance: float | None = None,
    ) -> None:
        self.plan, self.counter, self._more, self._tolerance = plan, counter, more, tolerance
        self._unknowns = (*_unknowns_of(plan), *more)
        self._has_branches = any(one.is_monotonic for one in self._unknowns)

    @property
    def has_unknowns(self) -> bool:
        """Whether any map is an unknown beside the pressure."""
        return bool(self._unknowns)

    def to(self, rtol: float) -> Step:
        """Return the step to another tolerance of the contact conditions."""
        plan = evolve(self.plan, accuracy=evolve(self.plan.accuracy, rtol=rtol))
        return Step(plan, self.counter, self._more, self._tolerance)

    def solve(self, target: Target) -> Solved:
        """Solve the contact under a load or at an approach.

        Raises
        ------
        InfeasibleError
            If the bodies cannot carry the load, or separate under it.
        """
        law, n_before = self.plan.hardness, self.counter.n_solves
        if isinstance(law, VaryingHardness) and not law.is_local:
            settled, bound = settle_hardness(self.plan, law, target, self._settled)
            return self._seen(settled, bound, self.counter.n_solves - n_before)
        fixed = law.value if isinstance(law, FixedHardness) else None
        settled = self._settled(target, fixed)
        return self._seen(settled, settled.contact.held.bound, self.counter.n_solves - n_before)

    def finished(self, solved: Solved, target: Target) -> Solved:
        """Compare the contact with the one without tractions, if any displace its surfaces."""
        displacement = next(
            (solved.values[one.name] for one in self._unknowns if one.is_of_tractions), None
        )
        if displacement is None:
            return solved
        without = solved.without
        if without is None:
            without = self._without_tractions(solved, target)
        displacement.flags.writeable = False
        frictional = FrictionalContact(displacement, without)
        return solved._replace(contact=solved.contact._replace(frictional=frictional))

    def _without_tractions(self, solved: Solved, target: Target) -> Map:
        """Pressure of contact [Pa] without tractions under the same load, film force included."""
        rtol = max(self.plan.accuracy.rtol, _WITHOUT)
        step = Step(self.plan, self.counter).to(rtol)
        step._unknowns = tuple(one for one in step._unknowns if not one.is_of_tractions)
        near = solved.near(target)._replace(unknowns=on_branch_of(target, solved.values))
        if target.mean_pressure is not None:
            near = near._replace(mean_pressure=float(solved.solution.pressure.mean()))
        return step.solve(near).pressure

    def _settled(self, target: Target, bound: Map | float | None) -> Settled:
        tolerance = self._tolerance or self.plan.accuracy.outer_rtol
        outer = Outer(self.plan, self._unknowns, tolerance, self.counter)
        settle = settle_attracted if self._has_branches else settle_unknowns
        return settle(outer, target, bound)

    def _seen(self, settled: Settled, hardness: Map | float | None, n_contacts: int) -> Solved:
        """Show a settled contact to the effects."""
        plan = self.plan
        contact = _contact_of(plan, settled.contact, hardness, n_contacts)
        return Solved(
            _solution_of(plan, settled.contact),
            contact,
            hardness,
            settled.values,
            settled.memories,
            {},
            _first_without(self._unknowns, settled),
            settled.problem,
        )


def _unknowns_of(plan: ContactPlan) -> tuple[Unknown, ...]:
    """Unknowns that the effects of a plan bring."""
    interface, term = plan.prepared, plan.scene.effect(DisplacementTerm)
    view = InterfaceView(
        plan.grid,
        interface.self_influence,
        interface.displacements,
        plan.hardness,
        plan.coupling,
        term.strength(plan.scene, plan.grid) if term is not None else 0.0,
        interface.first_touch,
    )
    return tuple(one for effect in effects_of(plan.scene) for one in effect.unknowns(view))


def _first_without(unknowns: tuple[Unknown, ...], settled: Settled) -> Map | None:
    """Pressure of the first contact [Pa], if it differs by the tractions alone."""
    is_alone = len(unknowns) == 1 and unknowns[0].is_of_tractions
    if not is_alone or unknowns[0].first_rtol > _WITHOUT:
        return None
    if not np.any(settled.contact.held.displacement):  # friction that causes nothing
        return settled.contact.solution.pressure
    return None if np.any(settled.first.held.displacement) else settled.first.solution.pressure


def _solution_of(plan: ContactPlan, found: HeldContact) -> Solution:
    """Solution of pressure less tension, in place of that of the pressure of contact."""
    if found.held.tension is None:
        return found.solution
    pressure = found.pressure
    work = np.einsum("ij,ij->", pressure, 0.5 * found.displacement - plan.heights)
    return found.solution._replace(
        pressure=pressure,
        displacement=found.displacement,
        energy=float(work) * plan.grid.pixel_area,
    )


def _contact_of(
    plan: ContactPlan, found: HeldContact, hardness: Map | float | None, n_contacts: int
) -> SolvedContact:
    held, displacement = found.held, found.displacement
    if held.displacement is not None:
        displacement = displacement + held.displacement
    bounded, attracted = None, None
    if hardness is not None:
        bounded = BoundedContact(hardness, np.maximum(-found.distance, 0.0))
    if held.tension is not None:
        touching, own = found.touching, plan.prepared.self_influence
        attracted = AttractedContact(held.tension, touching, own, n_contacts)
        for one in (held.tension, touching):
            one.flags.writeable = False
    return SolvedContact(
        plan.scene,
        plan.grid,
        found.pressure,
        displacement,
        found.into_gap(),  # the last use of the distance: a map less at the end of a solve
        plan.accuracy.threads,
        bounded,
        None,
        plan.liquid,
        attracted,
    )
