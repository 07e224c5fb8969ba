"""Motion of deforming bodies, and its result."""

from __future__ import annotations

import math
import time as clock
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from ...lubrication.elastohydrodynamic.motion import Motion, Profile, SmoothGap, move
from ...lubrication.elastohydrodynamic.step import StepFailedError
from ...scene.loading import PressAndPull
from ..curve_result import Work
from .outcome import finished, not_followed, outcome_numbers
from .phases import phases, pressing_speed
from .plan import DeformingPlan, characteristic_speed
from .result import SECTIONS, DeformingResult
from .validity import ranges

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

__all__ = ["pull_apart"]

_SAME_GAP = 1e-9  # over the smallest: rings in contact differ by round-off


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
    speed = max(characteristic_speed(plan.scene, film), pressing_speed(plan))
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
    sections = {
        name: np.array([getattr(one, name) for one in motion.profiles]) for name in SECTIONS
    }
    work = Work(
        motion.n_steps, motion.n_rejected, motion.n_iterations, clock.perf_counter() - begun
    )
    validity = ranges(plan, columns, sections, numbers)
    return finished(plan, columns, sections, {}, numbers, validity, work)


def _columns(plan: DeformingPlan, film: SmoothGap, motion: Motion) -> dict[str, Array]:
    found = dict(motion.columns)
    found["wet_area"] = math.pi * found["rim_radius"] ** 2
    if film.wetting is None:
        found["meniscus_force"] = np.zeros(len(found["time"]))
    else:
        rims = np.array([one.gap[-1] for one in motion.profiles])
        found["meniscus_force"] = found["wet_area"] * film.wetting / rims
    return {name: found[name] for name in plan.columns}


def _trapped(section: Profile) -> float:
    """Liquid beyond the thickness of the thinnest ring within it [m3]: a dimple that pressing left.

    0 where the film is thinnest on the axis, and where the contact has drained.
    """
    gap, radius = section.gap, section.radius
    ring = int(np.flatnonzero(gap <= gap.min() * (1.0 + _SAME_GAP))[-1])
    inside = section.liquid[: ring + 1] * gap[: ring + 1] - gap[ring]
    areas = math.pi * np.diff(radius[: ring + 1] ** 2)
    return float(np.maximum(0.5 * (inside[1:] + inside[:-1]), 0.0) @ areas)
