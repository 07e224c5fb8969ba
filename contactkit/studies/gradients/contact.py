"""Gradient of a number of a contact over heights and parameters: one adjoint solve."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ...contact.adjoint import Change, adjoint, check_differentiable
from ...contact.effects.base import Compliance, FixedHardness
from ...contact.functionals import Functional, functional
from ...contact.grid import combined_heights
from ...contact.plan import ContactPlan, unprepared_plan
from ...contact.prepared import summed_compliance
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

__all__ = ["contact_gradient"]


class _Prepared(NamedTuple):
    """What a contact is made from, as far as it differs from that of the scene."""

    symbol: Map | None
    heights: Map | None
    hardness: Map | float | None
    load: float
    approach: float


def contact_gradient(result: ContactResult, of: str | Functional, to: Sequence[str]) -> Gradient:
    """Gradient of a number of a solved contact.

    Parameters
    ----------
    result : ContactResult
        The contact.
    of : str or Functional
        The number.
    to : sequence of str
        Parameters, see `gradient_of`.

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
    check_differentiable(plan)
    if result.status == "not converged":
        raise NotSimulatedError(f"no gradient of a contact that is not solved: {result.message}")
    scene, accuracy = plan.scene, plan.accuracy
    numbers = [parameter(scene, accuracy, path) for path in to if path != HEIGHTS]
    prepared = plan.prepare()
    found = adjoint(prepared, result, asked.slopes(result))
    slopes: dict[str, float | Map] = {}
    notes, n_applications = _undecided(found.n_undecided), found.n_applications
    for one in numbers:
        made = differences(scene, accuracy, one, lambda other: _prepared(plan, other))
        change = _change(plan, result, made)
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


def _prepared(plan: ContactPlan, scene: ContactScene) -> _Prepared:
    """What a contact of a scene nearby is made from, on the same grid."""
    made = unprepared_plan(scene, plan.accuracy)
    if made.grid != plan.grid:
        raise NotSimulatedError(
            "no gradient over what changes the pixels of the window: differences of whole solves "
            "on grids of their own are left (ck.sensitivity)"
        )
    bodies, others = made.scene.interface, plan.scene.interface
    symbol, heights = None, None
    if (bodies.lower.stack, bodies.upper.stack) != (others.lower.stack, others.upper.stack):
        makers = made.scene.demand(Compliance).prepare(made.scene, made.grid)
        symbol = summed_compliance(makers)(plan.grid.shape, plan.grid.pixel_size)
    if (bodies.lower.surface, bodies.upper.surface) != (
        others.lower.surface,
        others.upper.surface,
    ):
        heights = combined_heights(made.scene, made.grid)
    hardness = made.hardness.value if isinstance(made.hardness, FixedHardness) else None
    load, approach = made.mean_pressure, made.scene.loading.imposed_approach
    return _Prepared(symbol, heights, hardness, load or 0.0, approach or 0.0)


def _change(plan: ContactPlan, result: ContactResult, made: Differences[_Prepared]) -> Change:
    """Differences over a parameter; those of the compliance applied to the pressure."""
    pairs, grid = list(zip(made.prepared, made.weights, strict=True)), plan.grid

    def summed(values: list[Map | None], own: Callable[[], Map]) -> Map | None:
        """Difference of maps, None where one is that of the scene itself."""
        if all(value is None for value in values):
            return None
        rows = zip(made.weights, values, strict=True)
        found = sum(weight * (own() if value is None else value) for weight, value in rows)
        return np.asarray(found)

    symbol = summed(
        [one.symbol for one in made.prepared],
        lambda: summed_compliance(plan.prepared.compliances)(grid.shape, grid.pixel_size),
    )
    pressed = None
    if symbol is not None and np.any(symbol):
        pressed = Convolution(grid.shape, symbol, grid.edges)(result.pressure)
    hardness = None
    if plan.hardness is not None:
        hardness = sum(weight * np.asarray(one.hardness) for one, weight in pairs)
    heights = [one.heights for one in made.prepared]
    return Change(
        heights=summed(heights, lambda: plan.heights),
        pressed=pressed,
        hardness=hardness,
        load=sum(weight * one.load for one, weight in pairs),
        approach=sum(weight * one.approach for one, weight in pairs),
    )
