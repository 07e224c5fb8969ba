"""Cost of a scene: CPU seconds, peak memory and counts of plan and run."""

from __future__ import annotations

import math
import time
import tracemalloc
import warnings
from collections.abc import Callable
from typing import Any, NamedTuple

import contactkit as ck

__all__ = ["Cost", "cost", "cpu_seconds", "run"]

REPEATS = 3


class Cost(NamedTuple):
    """CPU seconds, peak memory [MiB] that Python and numpy allocate, and counts."""

    seconds: float
    memory: float
    counts: dict[str, int]


def run(scene: Any, accuracy: ck.Accuracy) -> Any:
    """Plan and run a scene of any kind; models out of range do not warn."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ck.ValidityWarning)
        made = ck.plan(scene, accuracy)
        return ck.solve(made) if isinstance(scene, ck.ContactScene) else ck.simulate(made)


def cpu_seconds(work: Callable[[], Any], repeats: int = REPEATS) -> float:
    """Least CPU time of the process over some runs [s]; short ones are repeated within a run."""
    begun = time.process_time()
    work()
    first = time.process_time() - begun
    inner = max(1, min(1000, math.ceil(0.02 / max(first, 1e-6))))
    best = math.inf
    for _ in range(repeats):
        begun = time.process_time()
        for _ in range(inner):
            work()
        best = min(best, (time.process_time() - begun) / inner)
    return best


def counts(result: Any) -> dict[str, int]:
    """Counts of a run: convolutions and transforms, or steps and evaluations."""
    work = getattr(result, "work", None)
    if hasattr(work, "n_ffts"):
        return {"convolutions": work.n_operator_applications, "FFTs": work.n_ffts}
    if hasattr(work, "n_steps"):
        return {"steps": work.n_steps, "right-hand sides": work.n_evaluations}
    return {}


def cost(scene: Any, accuracy: ck.Accuracy) -> tuple[Cost, Any]:
    """Cost of plan and run, and the result of the run."""
    result = run(scene, accuracy)
    seconds = cpu_seconds(lambda: run(scene, accuracy))
    tracemalloc.start()
    run(scene, accuracy)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    return Cost(seconds, peak / 2**20, counts(result)), result
