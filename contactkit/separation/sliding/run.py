"""Run of a sliding: forces at an imposed speed, or impulse within an imposed time."""

from __future__ import annotations

import math
import time as clock
from typing import TYPE_CHECKING, Any

import numpy as np

from ...lubrication import dimensionless as numbers
from ...lubrication.couette_flat import lens_area
from ...numerics.lines import with_middles
from ...numerics.quadrature import gauss_legendre
from ...units import nm
from ...validity import ValidityNumber
from ..curve_result import Work
from .effects import SlideLaw
from .plan import SlidingPlan
from .result import SlidingResult

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

__all__ = ["check_sliding", "slide"]

_NODES = 12  # of a panel between two points of a curve


def slide(plan: SlidingPlan, begun: float) -> SlidingResult:
    """Run a sliding: curves over the travel, and totals."""
    loading = plan.scene.loading
    travel = _travel(plan)
    columns: dict[str, Any] = {
        "travel": travel,
        "overlap_area": plan.film.menisci * lens_area(plan.wetted_radius, travel),
    }
    totals: dict[str, float] = {}
    for kind, law in plan.laws.items():
        if law.work is not None:
            totals[kind.column.work.name] = float(law.work(plan.end))
        if loading.speed is not None or law.work is not None:
            columns[kind.column.name] = law.force(travel, loading.speed or 0.0)
        if (running := _running_impulse(law, travel, loading.speed)) is not None:
            impulse = kind.column.impulse.name
            columns[impulse], totals[impulse] = running, float(running[-1])
    if loading.speed is not None:
        columns |= _sums(plan, columns, travel, loading.speed)
        totals["tangential_impulse"] = impulse_of_all = float(columns["tangential_impulse"][-1])
        totals["sliding_work"] = impulse_of_all * loading.speed
    parted = plan.end >= plan.break_travel
    how = f"at {loading.speed:g} m/s" if loading.speed else f"within {loading.time:g} s"
    end = "the wetted circles have parted" if parted else "the wetted circles still overlap"
    return SlidingResult(
        plan,
        "parted" if parted else "curve",
        f"slid by {plan.end:g} m {how} at a gap of {loading.gap:g} m; {end}",
        {name: _frozen(values) for name, values in columns.items()},
        totals,
        check_sliding(plan),
        Work(0, 0, len(travel), clock.perf_counter() - begun),
    )


def _travel(plan: SlidingPlan) -> Floats:
    """Travel [m] of the points of the curves, between which straight lines are right."""
    speed = plan.scene.loading.speed or 0.0

    def table(travel: Floats) -> Floats:
        forces = [law.force(travel, speed) + 0.0 * travel for law in plan.laws.values()]
        return np.column_stack([lens_area(plan.wetted_radius, travel), *forces])

    even = np.linspace(0.0, plan.end, max(plan.accuracy.points, 2))
    return with_middles(even, table, plan.accuracy.curve_rtol)


def _frozen(values: Any) -> Floats:
    array = np.array(values, dtype=np.float64)
    array.flags.writeable = False
    return array


def _sums(
    plan: SlidingPlan, columns: dict[str, Any], travel: Floats, speed: float
) -> dict[str, Any]:
    """Time and speed, and the sums of the forces and of their impulses."""
    forces = [kind.column for kind in plan.laws]
    return {
        "time": travel / speed,
        "speed": np.full_like(travel, speed),
        "tangential_force": sum(columns[force.name] for force in forces),
        "tangential_impulse": sum(columns[force.impulse.name] for force in forces),
    }


def _running_impulse(law: SlideLaw, travel: Floats, speed: float | None) -> Any:
    """Impulse [N.s] up to each travel: in closed form, or panel by panel; None if not known."""
    if law.impulse is not None:
        return law.impulse(travel)
    if speed is None:
        return None
    if law.work is not None:
        return law.work(travel) / speed
    nodes, weights = (np.array(values) for values in gauss_legendre(_NODES))
    panels = np.diff(travel)
    forces = law.force(travel[:-1, None] + panels[:, None] * nodes, speed)
    return np.concatenate([[0.0], np.cumsum(forces @ weights * panels)]) / speed


def check_sliding(plan: SlidingPlan) -> tuple[ValidityNumber, ...]:
    """Evaluate the numbers that say whether a sliding is inside the range of its models."""
    scene = plan.scene
    gap, time = scene.loading.gap, scene.loading.time
    speed = scene.loading.speed or plan.end / (time or math.inf)
    liquid = plan.prepared.liquid
    height, radius = plan.film.height(gap), plan.wetted_radius
    found = [
        ValidityNumber(
            name="thinnest gap over 2 nm",
            value=gap / (2.0 * nm),
            low=1.0,
            detail="below about 2 nm a liquid is not a continuum",
            source="Chan and Horn 1985",
        ),
        ValidityNumber(
            name="slenderness of the film",
            value=numbers.slenderness(radius, height),
            low=5.0,
            detail="lubrication wants a film much wider than high",
            source="Reynolds 1886",
        ),
    ]
    viscosity, tension, density = map(liquid.given, ("viscosity", "surface_tension", "density"))
    if viscosity is None:
        return tuple(found)
    found.append(
        ValidityNumber(
            name="reduced Reynolds number",
            value=None
            if density is None
            else numbers.reynolds_number(density, speed, height, viscosity) * height / radius,
            high=1.0,
            detail="liquid.density [kg/m3] is not given"
            if density is None
            else "inertia of the film is left out",
            source="rho v h^2/(eta x)",
        )
    )
    if tension is not None:
        found.append(
            ValidityNumber(
                name="capillary number",
                value=viscosity * speed / tension,
                high=0.1,
                detail="above, the meniscus does not keep its shape and leaves liquid behind",
                source="eta v/gamma",
            )
        )
    return tuple(found)
