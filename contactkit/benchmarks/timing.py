"""CPU seconds and counts of a run, as studies of accuracy and pages of cost report them.

Seconds are those of the process, which other work on the machine does not lengthen.
"""

from __future__ import annotations

import math
import time
import tracemalloc
import warnings
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, NamedTuple, TypeVar

from ..accuracy import Accuracy
from ..errors import ValidityWarning
from ..planning import plan
from ..scene.scenes import ContactScene, SeparationScene, SlidingScene

if TYPE_CHECKING:
    AnyScene = ContactScene | SeparationScene | SlidingScene

__all__ = ["PRESETS", "Cost", "cost", "counts", "cpu_seconds", "run", "timed"]

_T = TypeVar("_T")

PRESETS = {
    "draft": Accuracy.draft,
    "standard": Accuracy.standard,
    "reference": Accuracy.reference,
}
"""Settings of `Accuracy` by name."""

# Long enough for the clock of the process, whose step is up to 10 ms on some systems.
_SHORTEST = 0.02  # [s]

REPEATS = 20
"""Most repetitions of a run that is timed; the least of so many is stable to some per cent."""


class Cost(NamedTuple):
    """CPU seconds, peak memory [MiB] that Python and numpy allocate, and counts."""

    seconds: float
    memory: float
    counts: dict[str, int]


def run(scene: AnyScene, accuracy: Accuracy) -> Any:
    """Plan and run a scene of any kind; models out of range do not warn."""
    from ..contact.solve import solve
    from ..separation.simulate import simulate

    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ValidityWarning)
        if isinstance(scene, ContactScene):
            return solve(plan(scene, accuracy))
        return simulate(plan(scene, accuracy))


def cost(scene: AnyScene, accuracy: Accuracy) -> tuple[Cost, Any]:
    """Cost of plan and run, and the result of the run."""
    result = run(scene, accuracy)
    seconds = cpu_seconds(lambda: run(scene, accuracy))
    tracemalloc.start()
    run(scene, accuracy)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    return Cost(seconds, peak / 2**20, counts(result)), result


def timed(work: Callable[[], _T], budget: float = 0.3) -> tuple[_T, float]:
    """Result of a run, and the least CPU time of it and of repetitions within a budget [s].

    A run longer than half the budget is not repeated: what it does once weighs little there.
    """
    begun = time.process_time()
    found = work()
    best = time.process_time() - begun
    for _ in range(min(REPEATS, int(budget / max(best, 1e-6)) - 1)):
        begun = time.process_time()
        found = work()
        best = min(best, time.process_time() - begun)
    return found, best


def cpu_seconds(work: Callable[[], Any], repeats: int = 3) -> float:
    """Least CPU time of the process over some runs [s]; short ones are repeated within a run."""
    begun = time.process_time()
    work()
    first = time.process_time() - begun
    if REPEATS == 0:
        return first
    inner = max(1, min(1000, math.ceil(_SHORTEST / max(first, 1e-6))))
    best = math.inf
    for _ in range(repeats):
        begun = time.process_time()
        for _ in range(inner):
            work()
        best = min(best, (time.process_time() - begun) / inner)
    return best


def counts(result: Any) -> dict[str, int]:
    """Counts of a run: convolutions and transforms, or steps and evaluations."""
    work: Any = getattr(result, "work", None)
    if hasattr(work, "n_ffts"):
        return {"convolutions": work.n_operator_applications, "FFTs": work.n_ffts}
    if hasattr(work, "n_steps"):
        return {"steps": work.n_steps, "right-hand sides": work.n_evaluations}
    return {}
