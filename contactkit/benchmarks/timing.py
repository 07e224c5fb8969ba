"""CPU seconds and counts of a run, as studies of accuracy and pages of cost report them."""

from __future__ import annotations

import math
import time
import warnings
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, TypeVar

from ..accuracy import Accuracy
from ..errors import ValidityWarning
from ..planning import plan
from ..scene.scenes import ContactScene, SeparationScene, SlidingScene

if TYPE_CHECKING:
    AnyScene = ContactScene | SeparationScene | SlidingScene

__all__ = ["best_of", "counts", "cpu_seconds", "run"]

_T = TypeVar("_T")

# Long enough for the clock of the process, whose step is up to 10 ms on some systems.
_SHORTEST = 0.02  # [s]


def run(scene: AnyScene, accuracy: Accuracy) -> Any:
    """Plan and run a scene of any kind; models out of range do not warn."""
    from ..contact.solve import solve
    from ..separation.simulate import simulate

    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ValidityWarning)
        if isinstance(scene, ContactScene):
            return solve(plan(scene, accuracy))
        return simulate(plan(scene, accuracy))


def best_of(work: Callable[[], _T], repeats: int = 3) -> tuple[_T, float]:
    """Result of a run after one untimed, and the least CPU time of the process over some [s]."""
    found, seconds = work(), math.inf
    for _ in range(repeats):
        begun = time.process_time()
        found = work()
        seconds = min(seconds, time.process_time() - begun)
    return found, seconds


def cpu_seconds(work: Callable[[], Any], repeats: int = 3) -> float:
    """Least CPU time of the process over some runs [s]; short ones are repeated within a run."""
    begun = time.process_time()
    work()
    first = time.process_time() - begun
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
