"""One constrained contact after another on one interface: what they share is made once."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from .effects.base import Cap, Compliance, DisplacementTerm, PressureCap
from .grid import combined_heights
from .plan import ContactPlan
from .solver.contact_solver import ContactSolver, Solution
from .solver.warm_start import Start

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Map = NDArray[np.float64]

__all__ = ["Counts", "Engine", "Friction", "Target", "cap_of", "interface_key"]

_MOST_ROUNDS = 60


class Target(NamedTuple):
    """What one solve is to reach: a mean pressure [Pa], or a level [m]; and from where.

    `start` is a pressure (ny, nx) [Pa], or pairs of mean pressure and pressure, the newest
    first; `hardness` [Pa] one that was right nearby.
    """

    mean_pressure: float | None
    level: float | None
    start: Start | None = None
    hardness: float | None = None


class Friction(NamedTuple):
    """What friction did to a contact.

    The normal displacement it causes [m], and the pressure [Pa] without it, (ny, nx) each;
    `problem` says whether the two do not agree yet.
    """

    displacement: Map
    pressure_without: Map
    problem: str = ""


class Counts:
    """What the solves of one result cost together."""

    def __init__(self) -> None:
        self.n_solves = 0
        self.n_operator_applications = 0
        self.n_ffts = 0
        self.n_coarse = 0
        self.n_iterations = 0
        self.has_fallen_back = False
        self.seconds: dict[str, float] = {}

    def add(self, solution: Solution) -> None:
        """Count one more solve."""
        self.n_solves += 1
        self.n_operator_applications += solution.n_applications
        self.n_ffts += solution.n_ffts
        self.n_coarse += solution.n_coarse
        self.n_iterations += solution.n_outer
        self.has_fallen_back |= solution.fallback

    def clock(self, stage: str, begun: float) -> None:
        """Add the time since `begun` to a stage."""
        self.seconds[stage] = self.seconds.get(stage, 0.0) + time.perf_counter() - begun


def interface_key(plan: ContactPlan) -> tuple[object, ...]:
    """Whatever an engine depends on: plans that agree in it may share one."""
    scene, accuracy = plan.scene, plan.accuracy
    elastic = scene.effect(Compliance)  # type: ignore[type-abstract]
    return (scene.interface, plan.grid, elastic, accuracy.threads)


class Engine:
    """Heights and compliance of one interface, ready for any load.

    Parameters
    ----------
    plan : ContactPlan
        The interface, its grid and its elastic law are taken from it.
    """

    def __init__(self, plan: ContactPlan) -> None:
        begun = time.perf_counter()
        self.key = interface_key(plan)
        self.grid = plan.grid
        self.heights = combined_heights(plan.scene, plan.grid)
        elastic = plan.scene.effect(Compliance)  # type: ignore[type-abstract]
        assert elastic is not None
        self.makers = elastic.prepare(plan.scene, plan.grid)
        self.solver = ContactSolver(
            plan.grid.shape,
            plan.grid.pixel_size,
            _added(self.makers),
            plan.grid.periodic,
            threads=plan.accuracy.threads,
        )
        self._bodies: tuple[ContactSolver, ...] | None = None
        self._threads = plan.accuracy.threads
        self.setup_seconds = time.perf_counter() - begun

    @property
    def first_touch(self) -> float:
        """Level [m] at which the undeformed bodies touch."""
        return -float(self.heights.max())

    def displacements(self, pressure: Map, total: Map) -> tuple[Map, ...]:
        """Displacement [m] of the surface of each deforming body."""
        if len(self.makers) == 1:
            return (total,)
        if self._bodies is None:
            grid = self.grid
            self._bodies = tuple(
                ContactSolver(
                    grid.shape, grid.pixel_size, maker, grid.periodic, threads=self._threads
                )
                for maker in self.makers
            )
        return tuple(body.displacement(pressure) for body in self._bodies)

    def solve(
        self, plan: ContactPlan, target: Target, cap: Map | float | None, counts: Counts
    ) -> tuple[Solution, Friction | None]:
        """Solve one contact under a given cap; with friction coupling, until that agrees too.

        Returns the solution, and what friction did to it if asked for.
        """
        begun = time.perf_counter()
        term = plan.scene.effect(DisplacementTerm)  # type: ignore[type-abstract]
        solution = self._once(plan, target, cap, self.heights, counts)
        friction: Friction | None = None
        if term is not None:
            without = solution.pressure
            solution, moved, problem = self._coupled(plan, target, cap, counts, solution, term)
            friction = Friction(moved, without, problem)
        counts.clock("contact", begun)
        return solution, friction

    def _coupled(
        self,
        plan: ContactPlan,
        target: Target,
        cap: Map | float | None,
        counts: Counts,
        solution: Solution,
        term: DisplacementTerm,
    ) -> tuple[Solution, Map, str]:
        """Repeat the contact with the displacement of its own traction until it stands still."""
        extra: Map = np.zeros(self.grid.shape)
        for _ in range(_MOST_ROUNDS):
            moved = term.displacement(plan.scene, self.grid, solution.pressure)
            scale = max(float(np.ptp(solution.displacement)), np.finfo(float).tiny)
            change = float(np.abs(moved - extra).max()) / scale
            extra = moved
            if change <= plan.accuracy.outer_rtol or not solution.converged:
                return solution, extra, ""
            again = target._replace(start=solution.pressure)
            solution = self._once(plan, again, cap, self.heights - extra, counts)
        problem = (
            f"the friction coupling still changes by {change:.2g} of the displacement after "
            f"{_MOST_ROUNDS} iterations, tolerance {plan.accuracy.outer_rtol:g}; lower "
            "FrictionTraction.coefficient or leave FrictionCoupling out"
        )
        return solution, extra, problem

    def _once(
        self,
        plan: ContactPlan,
        target: Target,
        cap: Map | float | None,
        heights: Map,
        counts: Counts,
    ) -> Solution:
        accuracy = plan.accuracy
        solution = self.solver.solve(
            heights,
            mean_pressure=target.mean_pressure,
            rigid_approach=target.level,
            bound=cap,
            rtol=accuracy.rtol,
            start=target.start,
            max_iterations=accuracy.max_iterations,
            method=accuracy.method,
        )
        counts.add(solution)
        return solution


def _added(
    makers: tuple[Callable[[tuple[int, int], tuple[float, float]], Map], ...],
) -> Callable[[tuple[int, int], tuple[float, float]], Map]:
    if len(makers) == 1:
        return makers[0]

    def total(shape: tuple[int, int], pixel_size: tuple[float, float]) -> Map:
        symbol = makers[0](shape, pixel_size).copy()
        for maker in makers[1:]:
            symbol += maker(shape, pixel_size)
        return symbol

    return total


def cap_of(plan: ContactPlan) -> Cap | None:
    """Bound on the pressure that a scene calls for; None without one."""
    effect = plan.scene.effect(PressureCap)  # type: ignore[type-abstract]
    return effect.prepare(plan.scene, plan.grid) if effect is not None else None
