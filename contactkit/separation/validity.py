"""Ranges of validity of the models along a run: numbers printed with every result."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from ..scene.loading import ImposedTime
from ..validity import ValidityNumber
from .effects.base import FilmStatus
from .plan import Plan

__all__ = ["check", "is_whole", "path_of"]


def check(plan: Plan, columns: Mapping[str, Any]) -> tuple[ValidityNumber, ...]:
    """Evaluate the numbers of a plan along the curves of a run."""
    return plan.validity(path_of(plan, columns))


def is_whole(plan: Plan, columns: Mapping[str, Any]) -> Any:
    """Whether the film spans the gap, at each point of a run."""
    if "film_status" in columns:
        return columns["film_status"] != FilmStatus.BROKEN
    return columns["gap"] <= plan.film.end


def path_of(plan: Plan, columns: Mapping[str, Any]) -> list[tuple[float, float]]:
    """Pairs of gap [m] and speed [m/s] where the film spans an open gap.

    With only a time imposed the speed is the mean one.
    """
    gaps, whole = columns["gap"], is_whole(plan, columns)
    if "speed" in columns:
        speeds = columns["speed"]
    else:
        loading = plan.scene.loading
        time = loading.time if isinstance(loading, ImposedTime) else math.inf
        speeds = (gaps[-1] - gaps[0]) / time + 0.0 * gaps
    wet = whole & (gaps > 0.0)
    return list(zip(gaps[wet].tolist(), speeds[wet].tolist(), strict=True))
