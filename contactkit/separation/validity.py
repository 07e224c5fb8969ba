"""Ranges of validity of the models along a run: numbers printed with every result."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from ..scene.loading import ImposedTime
from ..scene.validity import ValidityNumber
from .effects.base import FilmStatus
from .plan import Plan

__all__ = ["check"]


def check(plan: Plan, columns: Mapping[str, Any]) -> tuple[ValidityNumber, ...]:
    """Evaluate the numbers of a plan along the curves of a run."""
    return plan.validity(_path(plan, columns))


def _path(plan: Plan, columns: Mapping[str, Any]) -> list[tuple[float, float]]:
    """Pairs of gap [m] and speed [m/s] where the film spans an open gap.

    With only a time imposed the speed is the mean one.
    """
    gaps = columns["gap"]
    if "film_status" in columns:
        whole = columns["film_status"] != FilmStatus.BROKEN
    else:
        whole = gaps <= plan.film.end
    if "speed" in columns:
        speeds = columns["speed"]
    else:
        loading = plan.scene.loading
        time = loading.time if isinstance(loading, ImposedTime) else math.inf
        speeds = (gaps[-1] - gaps[0]) / time + 0.0 * gaps
    wet = whole & (gaps > 0.0)
    return list(zip(gaps[wet].tolist(), speeds[wet].tolist(), strict=True))
