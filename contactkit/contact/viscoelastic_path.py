"""Viscoelastic contact over time: steps of one elastic contact each, on what the history left."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from attrs import evolve

from .creep_response import CreepHistory, CreepResponse
from .effects.viscoelasticity import Viscoelasticity, ViscoelasticityPart
from .outer.load import solve_loaded, target_at
from .outer.step import Solved, Step
from .plan import ContactPlan
from .prepared import Once, PreparedInterface
from .work import WorkCounter

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Map = NDArray[np.float64]

__all__ = ["follow_loads"]


class _Instant(NamedTuple):
    """End of a step: its time and duration [s], and its mean pressure [Pa] or approach [m]."""

    time: float
    duration: float
    value: float


class _Row(NamedTuple):
    """Numbers of one state; see `ViscoelasticityPart`."""

    time: float
    load: float
    approach: float
    contact_area: float
    max_pressure: float
    elastic_energy: float
    dissipated_energy: float
    external_work: float


def follow_loads(plan: ContactPlan, effect: Viscoelasticity, counter: WorkCounter) -> Solved:
    """Solve the contacts of loads over time; the last one is the contact of the plan.

    Raises
    ------
    InfeasibleError
        If the bodies separate under the load of a step.
    """
    response = CreepResponse(plan.scene, plan.grid)
    history = CreepHistory(plan.prepared, response)
    rows = [_Row(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)]
    kept: dict[float, Map] = {}
    last: Solved | None = None
    for number, instant in enumerate(_instants(plan, effect), 1):
        interface = history.interface_after(instant.duration)
        step = Step(_on(plan, interface), counter)
        target = target_at(plan, instant.value)
        solved = solve_loaded(step, target if last is None else last.near(target))
        displaced = plan.heights - interface.heights
        history.advance(instant.duration, solved.contact.pressure)
        rows.append(_row(plan, instant, solved, history, rows[-1]))
        if instant.time in effect.maps_at:
            kept[instant.time] = solved.contact.pressure
        if solved.problem:
            problem = f"step {number} of the loads over time, at {instant.time:g} s: "
            solved = solved._replace(problem=problem + solved.problem)
            break
        last = solved if solved.pressure.any() else None
    return _finished(plan, solved, displaced, _part(plan, rows, [*kept.values()]))


def _on(plan: ContactPlan, interface: PreparedInterface) -> ContactPlan:
    """Plan of the elastic contact of one step."""
    return evolve(plan, interface=Once(lambda: interface))


def _instants(plan: ContactPlan, effect: Viscoelasticity) -> list[_Instant]:
    """Ends of the steps."""
    times, before = effect.times, effect.loadings()
    if not before:  # held from the start
        times = times if times[0] == 0.0 else (0.0, *times)
        before = (plan.scene.loading,) * (len(times) - 1)
    loads = [one.imposed_over(plan.grid.area) for one in (*before, plan.scene.loading)]
    found, last, value = list[_Instant](), 0.0, 0.0
    for time, load in zip(times, loads, strict=True):
        n, span = effect.steps if time > last else 1, time - last
        for i in range(1, n):
            found.append(_Instant(last + span * i / n, span / n, value + (load - value) * i / n))
        found.append(_Instant(time, span / n, load))
        last, value = time, load
    return found


def _row(
    plan: ContactPlan, instant: _Instant, solved: Solved, history: CreepHistory, before: _Row
) -> _Row:
    pixel, contact = plan.grid.pixel_area, solved.contact
    load = float(contact.pressure.sum()) * pixel
    approach = solved.solution.rigid_approach - plan.prepared.first_touch
    work = 0.5 * (load + before.load) * (approach - before.approach)
    if not instant.duration:
        work = history.stored - before.elastic_energy
    return _Row(
        time=instant.time,
        load=load,
        approach=approach,
        contact_area=float(contact.touching.sum()) * pixel,
        max_pressure=float(contact.pressure.max()),
        elastic_energy=history.stored,
        dissipated_energy=history.dissipated,
        external_work=before.external_work + work,
    )


def _part(plan: ContactPlan, rows: list[_Row], kept: list[Map]) -> ViscoelasticityPart:
    curves = np.array(rows).T
    maps = np.array(kept) if kept else np.zeros((0, *plan.grid.shape))
    for one in (curves, maps):
        one.flags.writeable = False
    time, load, approach, area, peak, elastic, dissipated, work = curves
    return ViscoelasticityPart(
        time=time,
        load=load,
        approach=approach,
        contact_area=area,
        max_pressure=peak,
        elastic_energy=elastic,
        dissipated_energy=dissipated,
        external_work=work,
        pressures=maps,
    )


def _finished(
    plan: ContactPlan, solved: Solved, displaced: Map, part: ViscoelasticityPart
) -> Solved:
    """Show the last step as a contact of the undeformed heights, with the whole displacement."""
    contact = solved.contact
    return solved._replace(
        contact=contact._replace(displacement=contact.displacement + displaced),
        parts={**solved.parts, Viscoelasticity: part},
    )
