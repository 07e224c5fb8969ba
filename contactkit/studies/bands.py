"""Aggregation of a study over its seeds: median, mean, and band of the runs of each point."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np

from ..errors import DescriptionError
from .store import StudyPoint

__all__ = ["BAND", "RUNS", "banded_point", "banded_units", "is_seed", "seed_axes"]

BAND: Mapping[str, str] = {"": "median", "_mean": "mean", "_low": "least", "_high": "greatest"}
"""What is added to the name of a number, and what that is of the runs."""

RUNS = "runs"


def is_seed(paths: Sequence[str]) -> bool:
    """Whether a parameter of a study is a seed, or several that vary together.

    Examples
    --------
    >>> is_seed(("interface.upper.surface.seed",)), is_seed(("loading.pressure",))
    (True, False)
    """
    return all(path.rpartition(".")[2] == "seed" for path in paths)


def seed_axes(paths: Sequence[tuple[str, ...]], over: str | None) -> tuple[int, ...]:
    """Places of the parameters to aggregate over: the seeds, or one by its path.

    Raises
    ------
    DescriptionError
        If there is none.
    """
    if over is None:
        found = tuple(i for i, axis in enumerate(paths) if is_seed(axis))
    else:
        found = tuple(i for i, axis in enumerate(paths) if over in axis)
    if found:
        return found
    known = ", ".join(path for axis in paths for path in axis)
    raise DescriptionError(
        "over",
        over,
        "be a parameter of the study",
        hint=f"it varies {known}; for bands vary a seed, such as 'interface.upper.surface.seed'",
    )


def banded_units(scalars: Iterable[tuple[str, str]]) -> dict[str, str]:
    """Units of the numbers of a banded point: medians first."""
    known = list(scalars)
    return {RUNS: "-"} | {f"{name}{end}": unit for end in BAND for name, unit in known}


def banded_point(values: Mapping[str, Any], runs: Sequence[StudyPoint]) -> StudyPoint:
    """One point of several runs; numbers that a run does not have are left out of the band."""
    names = {n: unit for p in runs for n, (_, unit) in p.scalars.items()}
    known = {n: [p.scalars.get(n, (math.nan, ""))[0] for p in runs] for n in names}
    bands = {n: _band([v for v in column if not math.isnan(v)]) for n, column in known.items()}
    good = [p for p in runs if not p.has_failed]
    scalars = {RUNS: (float(len(good)), "-")} | {
        f"{n}{end}": (bands[n][i], unit) for i, end in enumerate(BAND) for n, unit in names.items()
    }
    statuses = {p.status for p in runs}
    status = statuses.pop() if len(statuses) == 1 else f"{len(good)} of {len(runs)} solved"
    counts = {n: sum(p.counts.get(n, 0) for p in runs) for p in runs for n in p.counts}
    return StudyPoint(
        values,
        scalars,
        status,
        "; ".join(dict.fromkeys(p.message for p in runs if p.has_failed)),
        sum(p.seconds for p in runs),
        counts,
        tuple(dict.fromkeys(note for p in runs for note in p.notes)),
        all(p.is_from_store for p in runs),
    )


def _band(values: list[float]) -> tuple[float, float, float, float]:
    """Median, mean, least and greatest; nan of nothing."""
    if not values:
        return (math.nan,) * 4
    return float(np.median(values)), float(np.mean(values)), min(values), max(values)
