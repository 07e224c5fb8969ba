"""Cost of a contact solve: counts on the finest grid, and seconds by stage."""

from __future__ import annotations

import time
from collections import Counter
from collections.abc import Mapping
from typing import NamedTuple

from ..frozen import FrozenDict
from .solver.contact_solver import Solution

__all__ = ["ContactWork", "WorkCounter"]


class ContactWork(NamedTuple):
    """Cost of a contact: counts on the full grid, and seconds [s] by stage."""

    n_solves: int
    n_operator_applications: int
    n_ffts: int
    n_coarse_iterations: int
    n_iterations: int
    has_fallen_back: bool
    seconds: float
    stages: Mapping[str, float]


class WorkCounter:
    """Sums over the solves of one result."""

    def __init__(self) -> None:
        self._begun = time.perf_counter()
        self._solutions = Counter[str]()
        self._has_fallen_back = False
        self._stages: dict[str, float] = {}

    @property
    def n_solves(self) -> int:
        """Contacts solved so far."""
        return self._solutions["n_solves"]

    def add(self, solution: Solution) -> None:
        """Count one more solve."""
        self._solutions.update(
            n_solves=1,
            n_operator_applications=solution.n_applications,
            n_ffts=solution.n_ffts,
            n_coarse_iterations=solution.n_coarse,
            n_iterations=solution.n_outer,
        )
        self._has_fallen_back |= solution.fallback

    def add_companion(self, other: WorkCounter, is_full_grid: bool) -> None:
        """Count the solves of a companion: as coarse iterations if its grid is coarser."""
        counts = other._solutions
        if not is_full_grid:
            done = counts["n_operator_applications"] + counts["n_coarse_iterations"]
            counts = Counter(n_coarse_iterations=done)
        self._solutions.update(counts)

    def clock(self, stage: str, begun: float) -> None:
        """Add the time since `begun` to a stage."""
        self._stages[stage] = self._stages.get(stage, 0.0) + time.perf_counter() - begun

    def work(self) -> ContactWork:
        """Return the sums, and the seconds since the counter was made."""
        return ContactWork(
            **self._solutions,
            has_fallen_back=self._has_fallen_back,
            seconds=time.perf_counter() - self._begun,
            stages=FrozenDict(dict(self._stages)),
        )
