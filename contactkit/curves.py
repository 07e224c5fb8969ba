"""Separations of which the motion is given: forces at a speed, the impulse within a time."""

from __future__ import annotations

import math
import time as clock
from collections.abc import Callable
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from .effects import MeniscusForce, ViscousForce
from .errors import PlanError
from .motion_state import LIMITS, FilmStatus
from .plan import Plan
from .results import SeparationResult, Work
from .validity import check

__all__ = ["at_speed", "frozen", "newtonian_impulses", "simulated", "within_time"]


def frozen(values: object) -> NDArray[np.float64]:
    """Make a read-only array of a curve."""
    array = np.array(values, dtype=np.float64)
    array.flags.writeable = False
    return array


def _grid(plan: Plan) -> list[float]:
    """Gaps of a curve, closer where the film is thin, up to its end."""
    opening = plan.scene.opening
    low, high = opening.initial_gap, min(opening.final_gap, plan.film.end)
    # An offset keeps the first step finite where the curve begins at a touching sphere.
    offset = 0.0 if low > 0.0 else 1e-3 * high
    gaps = np.geomspace(low + offset, high + offset, max(plan.accuracy.points, 2)) - offset
    gaps[0], gaps[-1] = low, high
    return [float(gap) for gap in gaps]


def at_speed(plan: Plan, begun: float) -> SeparationResult:
    """Forces along the gap at an imposed speed."""
    opening = plan.scene.opening
    speed = opening.speed or 0.0
    gaps = _grid(plan)
    rows = [_forces(plan, gap, speed) for gap in gaps]
    columns = {
        "time": frozen([(gap - opening.initial_gap) / speed for gap in gaps]),
        "gap": frozen(gaps),
        "speed": frozen([speed] * len(gaps)),
        "pull": frozen([row["pull"] for row in rows]),
        "film_status": frozen([row["film_status"] for row in rows]),
    } | {name: frozen([row[name] for row in rows]) for name in simulated(plan)}
    impulses = {}
    if plan.has(MeniscusForce):
        running = _running(plan.film.laws[MeniscusForce].force, speed, gaps)
        impulses["meniscus_impulse"] = running[-1]
    if plan.has(ViscousForce):
        running = _running(lambda gap, v: plan.film.viscous_force(gap, v)[0], speed, gaps)
        columns["viscous_impulse"] = frozen(running)
        impulses |= newtonian_impulses(plan)
        if plan.film.limits:
            impulses["viscous_impulse"] = running[-1]
    validity = check(plan, [(gap, speed) for gap in gaps if gap > 0.0])
    work = Work(0, 0, len(gaps), clock.perf_counter() - begun)
    message = f"forces at {speed:g} m/s from {gaps[0]:g} m to {gaps[-1]:g} m"
    return SeparationResult(plan, "curve", message, columns, impulses, None, validity, work)


def simulated(plan: Plan) -> list[str]:
    """Names of the curves that the effects of a plan give."""
    names = ["meniscus_force"] if plan.has(MeniscusForce) else []
    if plan.has(ViscousForce):
        names += ["viscous_force", "newtonian_force"]
    if plan.film.limits:
        names.append("limit")
    return names


def _forces(plan: Plan, gap: float, speed: float) -> dict[str, float]:
    film = plan.film
    static = film.static_force(gap)
    viscous, acting = film.viscous_force(gap, speed)
    row: dict[str, float] = {"pull": static + viscous, "meniscus_force": static}
    row["viscous_force"] = viscous
    if plan.has(ViscousForce):
        row["newtonian_force"] = film.laws[ViscousForce].force(gap, speed)
    row["limit"] = float(LIMITS[acting])
    row["film_status"] = float(FilmStatus.FULL if gap <= film.full_gap else FilmStatus.BRIDGE)
    return row


def _running(
    force: Callable[[float, float], float], speed: float, gaps: list[float]
) -> list[float]:
    """Time integral of a force [N.s] up to each gap of a curve, at an imposed speed."""
    from scipy.integrate import quad

    total, found = 0.0, [0.0]
    for a, b in pairwise(gaps):
        # Relative to the largest value there could be, as a force may change its sign.
        floor = 1e-13 * b * max(abs(force(a, speed)), abs(force(b, speed)))
        total += quad(force, a, b, (speed,), epsabs=floor, epsrel=1e-10, limit=500)[0] / speed
        found.append(total)
    return found


def newtonian_impulses(plan: Plan) -> dict[str, float]:
    """Impulse [N.s] of the film without limits; no path in time changes it."""
    opening, impulse = plan.scene.opening, plan.film.laws[ViscousForce].impulse
    assert impulse is not None  # a viscous force always has one
    value = impulse(opening.initial_gap, min(opening.final_gap, plan.film.end))
    return {"viscous_impulse": value, "newtonian_impulse": value}


def within_time(plan: Plan, begun: float) -> SeparationResult:
    """Impulse and mean force of an opening of which only the duration is given."""
    limits = [kind.__name__ for kind, _ in plan.film.limits]
    if limits:
        raise PlanError(
            f"{', '.join(limits)} needs a speed or a force imposed: with only the time given, the "
            f"path on which the limit acts is not known"
        )
    gaps = _grid(plan)
    columns = {"gap": frozen(gaps)}
    if plan.has(MeniscusForce):
        columns["meniscus_force"] = frozen([plan.film.static_force(gap) for gap in gaps])
    impulses = {}
    if plan.has(ViscousForce):
        impulses = newtonian_impulses(plan)
        impulse = plan.film.laws[ViscousForce].impulse
        assert impulse is not None
        columns["viscous_impulse"] = frozen([impulse(gaps[0], gap) for gap in gaps])
    opening = plan.scene.opening
    mean_speed = (gaps[-1] - gaps[0]) / (opening.time or math.inf)
    validity = check(plan, [(gap, mean_speed) for gap in gaps if gap > 0.0])
    work = Work(0, 0, len(gaps), clock.perf_counter() - begun)
    message = f"opening from {gaps[0]:g} m to {gaps[-1]:g} m within {opening.time:g} s"
    return SeparationResult(plan, "curve", message, columns, impulses, None, validity, work)
