"""Gradient of a number of a contact over heights and parameters: one adjoint solve."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ...contact.adjoint import Change, adjoint, check_differentiable
from ...contact.effects.base import Attraction, Compliance, FixedHardness
from ...contact.functionals import Functional, functional
from ...contact.grid import combined_heights
from ...contact.plan import ContactPlan, unprepared_plan
from ...contact.prepared import interface_key, summed_compliance
from ...contact.solver.convolution import Convolution
from ...errors import NotSimulatedError
from ...scene.gradient import HEIGHTS, Gradient
from .differences import Differences, differences, parameter

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from numpy.typing import NDArray

    from ...contact.result import ContactResult
    from ...scene.scenes import ContactScene

    Map = NDArray[np.float64]

__all__ = ["SharedChanges", "contact_gradient"]


class _Loads(NamedTuple):
    """Hardness [Pa], mean pressure [Pa] and approach [m] of a contact."""

    hardness: Map | float
    load: float
    approach: float


class _OfInterface(NamedTuple):
    """Change of compliance and heights per unit of a parameter; None where it has none."""

    symbol: Map | None
    heights: Map | None


class SharedChanges:
    """Changes of the interface that contacts of one interface under several loads have in common.

    Those of the last interface are kept: influence of layers takes up to ten solves on small grids.
    """

    def __init__(self) -> None:
        self._key: tuple[object, ...] = ()
        self._known: dict[str, _OfInterface] = {}

    def of(self, plan: ContactPlan, path: str, make: Callable[[], _OfInterface]) -> _OfInterface:
        """Change over a parameter, made once for an interface."""
        key = interface_key(plan.scene, plan.grid, plan.accuracy.threads)
        if key != self._key:
            self._key, self._known = key, {}
        if path not in self._known:
            self._known[path] = make()
        return self._known[path]


def contact_gradient(
    result: ContactResult,
    of: str | Functional,
    to: Sequence[str],
    shared: SharedChanges | None = None,
) -> Gradient:
    """Gradient of a number of a solved contact.

    Parameters
    ----------
    result : ContactResult
        The contact.
    of : str or Functional
        The number.
    to : sequence of str
        Parameters, see `gradient_of`.
    shared : SharedChanges, optional
        What gradients of contacts of the same interface have found.

    Raises
    ------
    NotSimulatedError
        If the contact depends on more than its pressure.
    DescriptionError
        If the number or a parameter has no gradient.
    ConvergenceError
        If the contact was not solved, or the adjoint equations cannot be.
    """
    asked, plan = functional(of), result.plan
    check_differentiable(plan, asked.name)
    if result.status == "not converged":
        raise NotSimulatedError(f"no gradient of a contact that is not solved: {result.message}")
    scene, accuracy = plan.scene, plan.accuracy
    numbers = [parameter(scene, accuracy, path) for path in to if path != HEIGHTS]
    prepared = plan.prepare()
    found = adjoint(prepared, result, asked.slopes(result))
    slopes: dict[str, float | Map] = {}
    notes, n_applications = _undecided(found.n_undecided), found.n_applications
    for one in numbers:
        made = differences(scene, accuracy, one, lambda other: _nearby(plan, other))
        interface = partial(_of_interface, plan, made)
        common = interface() if shared is None else shared.of(plan, one.path, interface)
        change = _change(plan, result, made, common)
        n_applications += change.pressed is not None
        slopes[one.path] = found.along(change)
        notes += made.notes(one.path)
    if HEIGHTS in to:
        slopes[HEIGHTS] = found.heights
    return Gradient(
        asked.name,
        asked.unit,
        asked.value(result),
        {path: slopes[path] for path in to},
        {one.path: one.value for one in numbers},
        {HEIGHTS: "m"} | {one.path: one.unit for one in numbers},
        notes,
        n_operator_applications=n_applications,
        grid=plan.grid,
        result=result,
    )


def _undecided(n: int) -> tuple[str, ...]:
    if not n:
        return ()
    text = f"{n} pixels have neither pressure nor gap: slopes are one-sided, as these stay open"
    return (text,)


def _nearby(plan: ContactPlan, scene: ContactScene) -> ContactPlan:
    """Plan of a scene nearby, on the same grid; not prepared."""
    made = unprepared_plan(scene, plan.accuracy)
    if made.grid != plan.grid:
        raise NotSimulatedError(
            "no gradient over what changes the pixels of the window: differences of whole solves "
            "on grids of their own are left (ck.sensitivity)"
        )
    return made


def _of_interface(plan: ContactPlan, made: Differences[ContactPlan]) -> _OfInterface:
    """Differences of compliance and heights, where they differ from those of the scene."""
    mine, grid = plan.scene.interface, plan.grid
    bodies = [one.scene.interface for one in made.prepared]
    symbol = heights = None
    if any((b.lower.stack, b.upper.stack) != (mine.lower.stack, mine.upper.stack) for b in bodies):
        symbol = made.weighted(
            lambda one: summed_compliance(one.scene.demand(Compliance).prepare(one.scene, grid))(
                grid.shape, grid.pixel_size
            )
        )
    shapes = [(b.lower.surface, b.upper.surface) for b in bodies]
    if any(one != (mine.lower.surface, mine.upper.surface) for one in shapes):
        heights = made.weighted(lambda one: combined_heights(one.scene, grid))
    return _OfInterface(symbol, heights)


def _loads(plan: ContactPlan) -> _Loads:
    hardness = plan.hardness.value if isinstance(plan.hardness, FixedHardness) else 0.0
    approach = plan.scene.loading.imposed_approach
    return _Loads(hardness, plan.mean_pressure or 0.0, approach or 0.0)


def _of_attraction(
    plan: ContactPlan, result: ContactResult, made: Differences[ContactPlan]
) -> Map | None:
    """Differences of the tension at the gaps of the contact; None without an attraction."""
    mine = plan.scene.effect(Attraction)
    if mine is None or all(one.scene.effect(Attraction) == mine for one in made.prepared):
        return None
    own = plan.prepared.solver.self_influence

    def tension(one: ContactPlan) -> Map:
        return one.scene.demand(Attraction).prepare(own).tension(result.gap)

    return np.asarray(made.weighted(tension))


def _change(
    plan: ContactPlan,
    result: ContactResult,
    made: Differences[ContactPlan],
    interface: _OfInterface,
) -> Change:
    """Differences over a parameter; those of the compliance applied to the pressure."""
    grid, pressed = plan.grid, None
    if interface.symbol is not None and np.any(interface.symbol):
        pressed = Convolution(grid.shape, interface.symbol, grid.edges)(result.pressure)
    return Change(
        heights=interface.heights,
        pressed=pressed,
        hardness=(
            made.weighted(lambda one: np.asarray(_loads(one).hardness))
            if plan.hardness is not None
            else None
        ),
        tension=_of_attraction(plan, result, made),
        load=float(made.weighted(lambda one: _loads(one).load)),
        approach=float(made.weighted(lambda one: _loads(one).approach)),
    )
