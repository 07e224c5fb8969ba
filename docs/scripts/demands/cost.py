"""Cost of a scene: CPU seconds, peak memory and counts of plan and run."""

from __future__ import annotations

import tracemalloc
from typing import Any, NamedTuple

import contactkit as ck
from contactkit.benchmarks.timing import counts, cpu_seconds, run

__all__ = ["Cost", "cost"]


class Cost(NamedTuple):
    """CPU seconds, peak memory [MiB] that Python and numpy allocate, and counts."""

    seconds: float
    memory: float
    counts: dict[str, int]


def cost(scene: Any, accuracy: ck.Accuracy) -> tuple[Cost, Any]:
    """Cost of plan and run, and the result of the run."""
    result = run(scene, accuracy)
    seconds = cpu_seconds(lambda: run(scene, accuracy))
    tracemalloc.start()
    run(scene, accuracy)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    return Cost(seconds, peak / 2**20, counts(result)), result
