"""Motion of deforming bodies: the phases of its loading, and its result."""

from __future__ import annotations

import math
import time as clock
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np

from ...errors import ConvergenceError, DescriptionError
from ...frozen import FrozenDict
from ...lubrication.elastohydrodynamic.drive import Driven, Imposed
from ...lubrication.elastohydrodynamic.motion import (
    Motion,
    Phase,
    Profile,
    SmoothGap,
    move,
    with_times,
)
from ...lubrication.elastohydrodynamic.step import StepFailedError
from ...scene.loading import ImposedForce, ImposedSpeed, PressAndPull
from ...units import quantity_text
from ...validity import warn
from ..curve_result import Work
from .numbers import hertz_approach
from .plan import DeformingPlan, characteristic_speed
from .result import SECTIONS, DeformingResult
from .validity import ranges

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ...lubrication.elastohydrodynamic.maps.motion import MapMotion

    Array = NDArray[np.float64]

__all__ = ["not_followed", "outcome", "outcome_numbers", "phases", "pull_apart"]

_POINTS = 40  # of the curve of an imposed speed, beside those that the steps add
_SAME_GAP = 1e-9  # over the smallest: rings in contact differ by round-off
_RAMP = 0.01  # of the time in which rigid bodies part
_SHALLOW = 2.0  # times Hertz' approach, within which a pressed pair starts its pull


def pull_apart(plan: DeformingPlan, fields_at: Sequence[float] = ()) -> DeformingResult:
    """Run the plan.

    Parameters
    ----------
    plan : DeformingPlan
        What to run.
    fields_at : sequence of float
        Times [s] at which sections, and maps, are wanted exactly.

    Raises
    ------
    ConvergenceError
        If a step cannot be solved: a gap closes where nothing can touch.
    DescriptionError
        If a time is not within the motion.
    """
    begun = clock.perf_counter()
    film, loading = plan.film, plan.scene.loading
    parts = phases(plan, fields_at)
    speed = max(characteristic_speed(plan.scene, film), _pressing_speed(plan))
    if not isinstance(film, SmoothGap):
        from .maps.run import pull_map_apart  # not of rings

        return pull_map_apart(plan, parts, speed, fields_at)
    try:
        motion = move(film, parts, speed=speed, elements=plan.elements)
    except StepFailedError as error:
        raise not_followed(error, f"units of {film.gap / speed:g} s") from None
    pulled = motion.end_times[0] if isinstance(loading, PressAndPull) else 0.0
    columns = _columns(plan, film, motion)
    numbers = outcome_numbers(plan, motion, columns, pulled) | {
        "trapped_volume": _trapped(motion.profiles[int(np.abs(columns["time"] - pulled).argmin())]),
        "force_error": motion.error,
    }
    status, message = outcome(columns, numbers)
    sections = {
        name: np.array([getattr(one, name) for one in motion.profiles]) for name in SECTIONS
    }
    for one in (*columns.values(), *sections.values()):
        one.flags.writeable = False
    work = Work(
        motion.n_steps, motion.n_rejected, motion.n_iterations, clock.perf_counter() - begun
    )
    validity = ranges(plan, columns, sections, numbers)
    warn(validity)
    return DeformingResult(
        plan,
        status,
        message,
        FrozenDict(columns),
        FrozenDict(sections),
        FrozenDict({}),
        FrozenDict(numbers),
        validity,
        work,
    )


def not_followed(error: StepFailedError, where: str) -> ConvergenceError:
    """Error of a motion of which no step can be solved."""
    return ConvergenceError(
        f"the film of deforming bodies could not be followed: {error} ({where}); where the bodies "
        "close, list SolidContact(cutoff=...)"
    )


def _pressing_speed(plan: DeformingPlan) -> float:
    """Speed of rigid bodies at the start under the load [m/s]; 0 of a loading without one."""
    loading = plan.scene.loading
    if not isinstance(loading, PressAndPull):
        return 0.0
    film = plan.film
    return loading.press * film.gap**3 / (6.0 * math.pi * film.viscosity * film.width**4)


def phases(plan: DeformingPlan, fields_at: Sequence[float] = ()) -> list[Phase]:
    """Phases of the loading, with steps that end at some times [s].

    Raises
    ------
    DescriptionError
        If one of these times is not within the motion.
    """
    found = _phases(plan)
    last = found[-1].times[-1]
    for time in fields_at:
        if not 0.0 <= time <= last:
            raise DescriptionError(
                "simulate.fields_at", time, f"lie within the motion, 0 to {last:g} s", unit="s"
            )
    return with_times(found, np.array([time for time in fields_at if time > 0.0]))


def _phases(plan: DeformingPlan) -> list[Phase]:
    loading = plan.scene.loading
    if isinstance(loading, ImposedSpeed):
        length = (loading.final_gap - loading.initial_gap) / loading.speed
        return [Phase(_at_speed(loading.speed), _times(plan, 0.0, length))]
    if isinstance(loading, ImposedForce):
        return [Phase(_by_force(loading), [loading.time_limit], loading.final_gap)]
    assert isinstance(loading, PressAndPull)
    press = Driven(lambda _: -loading.press)
    pressing = Phase(lambda *_: press, [loading.rest])
    end = loading.rest + loading.time_limit
    if loading.force is not None:
        return [pressing, Phase(_reversed(plan, loading), [end], loading.final_gap)]
    speed = loading.speed or 0.0
    length = (loading.final_gap + _sunk(plan, loading.press)) / speed
    times = _times(plan, loading.rest, loading.rest + length)
    return [pressing, Phase(_at_speed(speed), times, loading.final_gap)]


def _reversed(plan: DeformingPlan, loading: PressAndPull) -> Callable[[float, float], Driven]:
    """Pull by a force after a load: at once, on a map within a hundredth of the time of the film.

    There a contact opens cell by cell, which takes a path.
    """
    film, force = plan.film, loading.force or 0.0
    if isinstance(film, SmoothGap):
        return lambda *_: Driven(lambda _: force)
    within = _RAMP * film.gap / characteristic_speed(plan.scene, film)

    def drive(_: float, start: float) -> Driven:
        def acting(time: float) -> float:
            share = min(max((time - start) / within, 0.0), 1.0)
            return share * force - (1.0 - share) * loading.press

        return Driven(acting)

    return drive


def _sunk(plan: DeformingPlan, press: float) -> float:
    """Bound of how far a load presses the bodies into each other [m]."""
    film = plan.film
    if math.isfinite(film.radius):
        return _SHALLOW * hertz_approach(press, film.radius, plan.modulus)
    # On a map a flat is pressed in as a punch, and its asperities by less than the initial gap.
    return 0.0 if isinstance(film, SmoothGap) else film.gap + press / (plan.modulus * film.rim)


def _times(plan: DeformingPlan, start: float, end: float) -> list[float]:
    """Points of the curve of an imposed speed; of a map those of the steps suffice."""
    points = _POINTS if isinstance(plan.film, SmoothGap) else 1
    found: list[float] = np.linspace(start, end, points + 1)[1:].tolist()
    return found


def _at_speed(speed: float) -> Callable[[float, float], Imposed]:
    return lambda gap, start: Imposed(lambda time: gap + speed * (time - start))


def _by_force(loading: ImposedForce) -> Callable[[float, float], Driven]:
    def pull(time: float) -> float:
        if loading.rise_time == 0.0:
            return loading.force
        return -loading.force * math.expm1(-time / loading.rise_time)

    driven = Driven(pull, loading.mass or 0.0, loading.stiffness, lambda _: loading.initial_gap)
    return lambda *_: driven


def _columns(plan: DeformingPlan, film: SmoothGap, motion: Motion) -> dict[str, Array]:
    found = dict(motion.columns)
    found["wet_area"] = math.pi * found["rim_radius"] ** 2
    if film.wetting is None:
        found["meniscus_force"] = np.zeros(len(found["time"]))
    else:
        rims = np.array([one.gap[-1] for one in motion.profiles])
        found["meniscus_force"] = found["wet_area"] * film.wetting / rims
    return {name: found[name] for name in plan.columns}


def outcome_numbers(
    plan: DeformingPlan,
    motion: Motion | MapMotion,
    columns: Mapping[str, Array],
    pulled: float,
) -> dict[str, float]:
    """Numbers of a motion that follow from its curves, by their names.

    Parameters
    ----------
    plan : DeformingPlan
        The plan.
    motion : Motion or MapMotion
        How it ended.
    columns : mapping of str to ndarray
        Its curves.
    pulled : float
        When the pull began [s].
    """
    time, pull = columns["time"], columns["pull"]
    during = time >= pulled
    force, at = _peak(time[during], pull[during])
    end = motion.end_times[-1]
    is_at_end = isinstance(plan.scene.loading, ImposedSpeed)
    released = motion.is_over or is_at_end
    work = columns["work"]
    rigid = plan.rigid_force
    return {
        "pull_off_force": force,
        "pull_off_time": at,
        "snap_off_time": _snap_off(columns, pulled),
        "release_time": end if released else math.nan,
        "smallest_gap": float(columns["smallest_gap"].min()),
        "work_of_separation": float(work[-1] - work[during][0]),
        "hysteresis_loss": float(columns["dissipated_energy"][-1]),
        "largest_contact_force": float(columns["contact_force"].max()),
        "largest_tension": float(columns["largest_tension"].max()),
        "trapped_volume": 0.0,
        "rupture_time": motion.rupture_time,
        "force_over_rigid": force / rigid if rigid > 0.0 else math.nan,
        "beta": plan.numbers.beta,
    }


def _peak(time: Array, force: Array) -> tuple[float, float]:
    """Largest force and its time, on the parabola through the points around it."""
    k = int(force.argmax())
    if not 0 < k < len(force) - 1:
        return float(force[k]), float(time[k])
    t, f = time[k - 1 : k + 2] - time[k], force[k - 1 : k + 2]
    curve = np.polynomial.polynomial.polyfit(t, f, 2)
    at = float(np.clip(-curve[1] / (2.0 * curve[2]), t[0], t[2])) if curve[2] < 0.0 else 0.0
    peak = float(np.polynomial.polynomial.polyval(at, curve))
    # Where the film ruptures the force has a corner or a jump there, and no parabola.
    if peak > 1.02 * float(force[k]):
        return float(force[k]), float(time[k])
    return peak, float(time[k]) + at


def _trapped(section: Profile) -> float:
    """Liquid beyond the thickness of the thinnest ring within it [m3]: a dimple that pressing left.

    0 where the film is thinnest on the axis, and where the contact has drained.
    """
    gap, radius = section.gap, section.radius
    ring = int(np.flatnonzero(gap <= gap.min() * (1.0 + _SAME_GAP))[-1])
    inside = section.liquid[: ring + 1] * gap[: ring + 1] - gap[ring]
    areas = math.pi * np.diff(radius[: ring + 1] ** 2)
    return float(np.maximum(0.5 * (inside[1:] + inside[:-1]), 0.0) @ areas)


def _snap_off(columns: Mapping[str, Array], pulled: float) -> float:
    """When the gap on the axis opens fastest, if faster than the bodies move; else nan."""
    during = columns["time"] >= pulled
    time, centre = columns["time"][during], columns["centre_gap"][during]
    gap = columns["gap"][during]
    if len(time) < 3:
        return math.nan
    steps = np.diff(time)
    rate, moved = np.diff(centre) / steps, np.diff(gap) / steps
    k = int((rate - moved).argmax())
    return 0.5 * float(time[k] + time[k + 1]) if rate[k] > 1.2 * moved[k] else math.nan


def outcome(columns: Mapping[str, Array], numbers: Mapping[str, float]) -> tuple[str, str]:
    """Status of a motion, and the same as a sentence."""
    force = quantity_text(numbers["pull_off_force"], "N")
    more = f"; largest pull {force} after {numbers['pull_off_time']:.6g} s"
    if math.isfinite(numbers["rupture_time"]):
        more += f"; the film ruptured after {numbers['rupture_time']:.6g} s"
    if math.isfinite(numbers["release_time"]):
        return "released", f"released after {numbers['release_time']:.6g} s{more}"
    limit = float(columns["time"][-1])
    gap = float(columns["gap"][-1])
    return "time limit", f"not released within {limit:g} s, gap {gap:g} m{more}"
