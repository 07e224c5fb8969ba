"""Loading history of a plastic contact: steps up and down, each on the shape left by the last."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from attrs import evolve

from ..errors import NotSimulatedError
from ..scene.rough_surfaces import Heights
from .effects.base import FixedHardness, HardnessLaw, SolvedContact
from .effects.plastic_history import PlasticHistory, PlasticHistoryPart
from .effects.plasticity import AT_HARDNESS, HardnessLimit
from .outer.load import solve_loaded, target_at
from .outer.step import Solved, Step
from .outer.unknown import Target
from .plan import ContactPlan
from .prepared import Once
from .result import ContactResult
from .solver.optimality import height_scale
from .work import WorkCounter

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Map = NDArray[np.float64]

__all__ = ["PlasticPath", "follow_history", "residual_surface"]


class _State(NamedTuple):
    """What is remembered from one step to the next.

    residual : plastic depth [m] (ny, nx)
    deepest : largest displacement of each body so far [m], numbers or maps
    hardness : hardness [Pa] that belongs to it
    last : contact of the last step, where the next one starts
    """

    residual: Map
    deepest: tuple[Map, ...] | None = None
    hardness: Map | float | None = None
    last: Solved | None = None


class _Row(NamedTuple):
    """Numbers of one state; see `PlasticHistoryPart`."""

    load: float
    approach: float
    contact_area: float
    plastic_area: float
    elastic_energy: float
    flow_work: float
    flow_volume: float
    hardness: float


class PlasticPath:
    """Shape of a plastic contact along its loads, and the numbers of its states.

    Parameters
    ----------
    plan : ContactPlan
        The contact before any load.
    history : PlasticHistory
        The loads.
    """

    def __init__(self, plan: ContactPlan, history: PlasticHistory) -> None:
        self.plan, self._history = plan, history
        self._state, self._rows = _State(np.zeros(plan.grid.shape)), list[_Row]()

    def targets(self) -> list[Target]:
        """Loads or approaches of the steps."""
        return _targets(self.plan, self._history)

    def shaped(self) -> ContactPlan:
        """Plan of the shape that the last step left, with a hardness that remembers."""
        plan, state = self.plan, self._state
        shape = plan.prepared.with_heights(plan.heights - state.residual)
        return evolve(plan, hardness=_remembering(plan, state), interface=Once(lambda: shape))

    def near(self, target: Target) -> Target:
        """Start from the last step, if there was contact."""
        last = self._state.last
        return target if last is None else last.near(target)

    def deform(self, heights: Map, solved: Solved) -> None:
        """Deform the heights [m] of a step for good where its contact is at the hardness."""
        plan, contact, residual = self.plan, solved.contact, self._state.residual
        hardness = np.asarray(solved.hardness)
        is_plastic = (contact.pressure >= hardness * AT_HARDNESS) & (contact.pressure > 0.0)
        overlap = contact.bounded.overlap if contact.bounded is not None else np.zeros_like(heights)
        # Less than this is the tolerance of the solver, not flow.
        least = 2.0 * plan.accuracy.rtol * height_scale(heights, contact.displacement)
        flow = np.where(is_plastic & (overlap > least), overlap, 0.0)
        self._rows.append(_row(plan, solved, contact, is_plastic, flow))
        self._state = _State(
            residual + flow,
            _deepest(plan, solved, self._state),
            solved.hardness,
            solved if solved.pressure.any() else None,
        )

    def finished(self, solved: Solved) -> Solved:
        """Show the last step with the depth of the whole path, as a part of the result."""
        bounded, residual = solved.contact.bounded, self._state.residual
        if bounded is not None:
            bounded = bounded._replace(overlap=residual)
        part = _part(self.plan, self._rows, residual)
        return solved._replace(
            contact=solved.contact._replace(bounded=bounded),
            parts={**solved.parts, PlasticHistory: part},
        )


def follow_history(plan: ContactPlan, history: PlasticHistory, counter: WorkCounter) -> Solved:
    """Solve the steps of a loading history; the last one is the contact of the plan.

    Raises
    ------
    InfeasibleError
        If the load of a step exceeds what the hardness there can carry.
    """
    path = PlasticPath(plan, history)
    for number, target in enumerate(path.targets(), 1):
        step = Step(path.shaped(), counter)
        solved = solve_loaded(step, path.near(target))
        path.deform(step.plan.heights, solved)
        if solved.problem:
            problem = f"step {number} of the loading history: {solved.problem}"
            solved = solved._replace(problem=problem)
            break
    return path.finished(step.finished(solved, target))


def residual_surface(result: ContactResult) -> Heights:
    """Surface that a plastic contact leaves after unloading, to be pressed again.

    Parameters
    ----------
    result : ContactResult
        A contact with `PlasticHistory`, or with `HardnessLimit` alone: then that of one loading.

    Returns
    -------
    Heights
        Heights of both bodies together, less the residual depth [m]; give it to one body and
        leave the other flat. It is free of stress in this model.

    Raises
    ------
    NotSimulatedError
        If the contact is elastic, so that its surfaces are what they were.

    Notes
    -----
    A hardness that depends on depth starts anew in the next contact.

    Examples
    --------
    >>> import contactkit as ck
    >>> x = 2.0 * np.pi * np.arange(32) / 32
    >>> heights = 1e-9 * (np.cos(x)[:, None] + np.cos(x)[None, :])
    >>> solid = ck.Material(young_modulus=1e10, poisson_ratio=0.3)
    >>> first = ck.press(heights, 1e-9, solid, 1e7, hardness=6e8)
    >>> again = ck.press(residual_surface(first).heights, 1e-9, solid, 1e7, hardness=6e8)
    >>> bool(abs(again.rigid_approach / first.rigid_approach - 1.0) < 1e-7)
    True
    """
    if result.has(PlasticHistory):
        depth = result.of(PlasticHistory).residual_depth
    elif result.has(HardnessLimit):
        depth = result.of(HardnessLimit).overlap
    else:
        raise NotSimulatedError(
            "residual_surface needs a contact with HardnessLimit: an elastic one leaves none"
        )
    grid, left = result.plan.grid, result.heights - depth
    if result.holes is not None:
        left = np.ma.MaskedArray(left, result.holes)
    repeats = grid.periodic if grid.along is None else None  # along one axis: the window says
    return Heights(heights=left, pixel_size=grid.pixel_size, is_periodic=repeats)


def _targets(plan: ContactPlan, history: PlasticHistory) -> list[Target]:
    """Loads or approaches of the steps."""
    values, before = list[float](), 0.0
    for loading in (*history.loadings(), plan.scene.loading):
        after = loading.imposed_over(plan.grid.area)
        values += [before + (after - before) * (i / history.steps) for i in range(1, history.steps)]
        values.append(after)
        before = after
    return [target_at(plan, one) for one in values]


def _remembering(plan: ContactPlan, state: _State) -> HardnessLaw | None:
    """The law of the hardness, at the largest displacement so far."""
    law, deepest, known = plan.hardness, state.deepest, state.hardness
    if law is None or isinstance(law, FixedHardness) or deepest is None or known is None:
        return law
    last, slack = np.asarray(known), 1.0 + plan.accuracy.outer_rtol

    def at(displacements: tuple[Map, ...]) -> Map | float:
        is_deeper = np.zeros(last.shape, dtype=bool)
        for u, most in zip(displacements, deepest, strict=True):
            is_deeper |= np.asarray(u > most * slack)
        if not is_deeper.any():
            return known
        pairs = zip(displacements, deepest, strict=True)
        found = np.asarray(law.at(tuple(np.maximum(u, most) for u, most in pairs)))
        found = np.where(is_deeper, found, last)
        return found if found.ndim else float(found)

    return law._replace(at=at)


def _deepest(plan: ContactPlan, solved: Solved, state: _State) -> tuple[Map, ...] | None:
    """Largest displacements so far, as the law of the hardness takes them; None if fixed."""
    law, solution = plan.hardness, solved.solution
    if law is None or isinstance(law, FixedHardness):
        return None
    touching = solved.contact.touching
    bodies = plan.prepared.displacements(solution.pressure, solution.displacement)
    now = tuple(
        np.maximum(u, 0.0) if law.is_local else np.asarray(u[touching].max(initial=0.0))
        for u in bodies
    )
    if state.deepest is None:
        return now
    return tuple(np.maximum(u, most) for u, most in zip(now, state.deepest, strict=True))


def _row(
    plan: ContactPlan,
    solved: Solved,
    contact: SolvedContact,
    is_plastic: NDArray[np.bool_],
    flow: Map,
) -> _Row:
    pixel, p = plan.grid.pixel_area, contact.pressure
    return _Row(
        load=float(p.sum()) * pixel,
        approach=solved.solution.rigid_approach - plan.prepared.first_touch,
        contact_area=float((p > 0.0).sum()) * pixel,
        plastic_area=float(is_plastic.sum()) * pixel,
        elastic_energy=0.5 * float((p * contact.displacement).sum()) * pixel,
        flow_work=float((np.asarray(solved.hardness) * flow).sum()) * pixel,
        flow_volume=float(flow.sum()) * pixel,
        hardness=float(np.mean(np.asarray(solved.hardness))),
    )


def _part(plan: ContactPlan, rows: list[_Row], residual: Map) -> PlasticHistoryPart:
    first = _Row(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, rows[0].hardness)
    table = np.array([first, *rows]).T
    load, approach, contact_area, plastic_area, elastic, work, volume, hardness = table
    trapezoids = 0.5 * (load[1:] + load[:-1]) * np.diff(approach)
    residual.flags.writeable = False
    return PlasticHistoryPart(
        load=load,
        approach=approach,
        contact_area=contact_area,
        plastic_area=plastic_area,
        elastic_energy=elastic,
        plastic_work=np.cumsum(work),
        external_work=np.concatenate([[0.0], np.cumsum(trapezoids)]),
        residual_volume=np.cumsum(volume),
        hardness=hardness,
        residual_depth=residual,
    )
