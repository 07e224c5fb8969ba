"""Sliding of which the motion is given: forces at a speed, the impulse within a time."""

from __future__ import annotations

import math
import time as clock
from typing import TYPE_CHECKING, Any

import numpy as np

from ...lubrication import dimensionless as numbers
from ...lubrication.couette_flat import lens_area
from ...numerics.quadrature import gauss_legendre
from ...units import nm
from ..results import Work
from ..validity import ValidityNumber
from .effects import ContactAngleHysteresis, CouetteForce, SlideLaw
from .plan import SlidingPlan
from .result import SlidingResult

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

__all__ = ["check_sliding", "slide"]

_COLUMN = {CouetteForce: "couette_force", ContactAngleHysteresis: "hysteresis_force"}
_NODES = 12  # of a panel between two points of a curve


def slide(plan: SlidingPlan, begun: float) -> SlidingResult:
    """Run a sliding: curves over the travel, and totals."""
    loading = plan.scene.loading
    travel = np.linspace(0.0, plan.end, max(plan.accuracy.points, 2))
    columns: dict[str, Any] = {
        "travel": travel,
        "overlap_area": plan.film.menisci * lens_area(plan.wetted_radius, travel),
    }
    drag, stick = plan.laws.get(CouetteForce), plan.laws.get(ContactAngleHysteresis)
    totals: dict[str, float] = {}
    if stick is not None:
        assert stick.work is not None
        columns["hysteresis_force"] = stick.force(travel, 0.0)
        totals["hysteresis_work"] = float(stick.work(plan.end))
    if loading.speed is not None:
        at_speed, more = _at_speed(plan, travel, loading.speed, drag, stick)
        columns |= at_speed
        totals |= more
    elif drag is not None:
        assert drag.impulse is not None  # without it a time alone is refused by the plan
        columns["couette_impulse"] = drag.impulse(travel)
        totals["couette_impulse"] = float(columns["couette_impulse"][-1])
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


def _frozen(values: Any) -> Floats:
    array = np.array(values, dtype=np.float64)
    array.flags.writeable = False
    return array


def _at_speed(
    plan: SlidingPlan,
    travel: Floats,
    speed: float,
    drag: SlideLaw | None,
    stick: SlideLaw | None,
) -> tuple[dict[str, Any], dict[str, float]]:
    """Curves and totals that need a speed."""
    total, impulse = np.zeros_like(travel), np.zeros_like(travel)
    columns: dict[str, Any] = {}
    if drag is not None:
        columns["couette_force"] = drag.force(travel, speed)
        columns["couette_impulse"] = _impulse(drag, travel, speed)
        total = total + columns["couette_force"]
        impulse = impulse + columns["couette_impulse"]
    if stick is not None:
        assert stick.work is not None
        total = total + stick.force(travel, speed)
        impulse = impulse + stick.work(travel) / speed
    columns |= {
        "time": travel / speed,
        "speed": np.full_like(travel, speed),
        "tangential_force": total,
        "tangential_impulse": impulse,
    }
    totals = {"tangential_impulse": float(impulse[-1]), "sliding_work": float(impulse[-1] * speed)}
    if drag is not None:
        totals["couette_impulse"] = float(columns["couette_impulse"][-1])
    return columns, totals


def _impulse(law: SlideLaw, travel: Floats, speed: float) -> Any:
    """Impulse [N.s] up to each travel at a speed: in closed form, or panel by panel."""
    if law.impulse is not None:
        return law.impulse(travel)
    nodes, weights = (np.array(values) for values in gauss_legendre(_NODES))
    panels = np.diff(travel)
    forces = law.force(travel[:-1, None] + panels[:, None] * nodes, speed)
    return np.concatenate([[0.0], np.cumsum(forces @ weights * panels)]) / speed


def check_sliding(plan: SlidingPlan) -> tuple[ValidityNumber, ...]:
    """Evaluate the numbers that say whether a sliding is inside the range of its models."""
    scene = plan.scene
    gap, time = scene.loading.gap, scene.loading.time
    speed = scene.loading.speed or plan.end / (time or math.inf)
    state = scene.meniscus.liquid.at(scene.temperature)
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
    viscosity, tension, density = state.viscosity, state.surface_tension, state.density
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
