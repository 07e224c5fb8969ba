"""Outcome of a motion of deforming bodies: its numbers and its result, or why it has none."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from ...errors import ConvergenceError
from ...frozen import FrozenDict
from ...lubrication.elastohydrodynamic.motion import Motion
from ...lubrication.elastohydrodynamic.step import StepFailedError
from ...scene.loading import ImposedSpeed
from ...units import quantity_text
from ...validity import ValidityNumber, warn
from ..curve_result import Work
from .plan import DeformingPlan
from .result import DeformingResult

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ...lubrication.elastohydrodynamic.maps.motion import MapMotion

    Array = NDArray[np.float64]

__all__ = ["finished", "not_followed", "outcome_numbers"]


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


def finished(
    plan: DeformingPlan,
    columns: Mapping[str, Array],
    sections: Mapping[str, Array],
    maps: Mapping[str, NDArray[Any]],
    numbers: Mapping[str, float],
    validity: tuple[ValidityNumber, ...],
    work: Work,
) -> DeformingResult:
    """Result of a motion; its arrays cannot be written to any more, and its warnings are given.

    Parameters
    ----------
    plan : DeformingPlan
        The plan.
    columns, sections, maps, numbers, validity, work
        As in `DeformingResult`.
    """
    for one in (*columns.values(), *sections.values(), *maps.values()):
        one.flags.writeable = False
    warn(validity, stacklevel=4)  # beyond the run
    return DeformingResult(
        plan,
        *_status(columns, numbers),
        FrozenDict(columns),
        FrozenDict(sections),
        FrozenDict(maps),
        FrozenDict(numbers),
        validity,
        work,
    )


def _status(columns: Mapping[str, Array], numbers: Mapping[str, float]) -> tuple[str, str]:
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


def not_followed(error: StepFailedError, where: str) -> ConvergenceError:
    """Error of a motion of which no step can be solved."""
    return ConvergenceError(
        f"the film of deforming bodies could not be followed: {error} ({where}); where the bodies "
        "close, list SolidContact(cutoff=...)"
    )
