"""Impulses over the cycles of a vibration, and their sum over a run."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from scipy.interpolate import CubicSpline

from ...numerics.quadrature import gauss_legendre
from ...numerics.roots import first_true
from ..cavity_points import CavityPoint
from ..effects.base import LimitKind
from ..plan import Plan
from ..prescribed import limited_name
from .cavity import CavityCycles
from .path import NODES, VibrationPath, panels

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

__all__ = ["Cycle", "cycle_over", "forces_at", "mean_pulls", "steady_impulse", "sums"]


class Cycle(NamedTuple):
    """Times [s] along a cycle, and the impulse [N.s] of each force up to each of them.

    `pulls` are the lowest and the highest pull [N] at the nodes of the quadrature.
    """

    times: Floats
    running: dict[str, Floats]
    pulls: tuple[float, float]

    def total(self, name: str) -> float:
        """Impulse [N.s] of a force over the cycle."""
        return float(self.running[name][-1])


def forces_at(
    plan: Plan, gap: float, speed: float, cavity: CavityPoint | None = None
) -> dict[str, float]:
    """Each force [N] at a gap and a speed by the name of its column, and the pull."""
    found = plan.film.at(gap, speed, cavity.force if cavity is not None else None).named
    return found | {"pull": sum(found.values())}


def _onsets(plan: Plan, path: VibrationPath, edges: list[float]) -> list[float]:
    """Times [s] at which a limit of the liquid sets in or ceases."""
    film = plan.film
    found: list[float] = []
    if not film.limits:
        return found

    def acting(time: float) -> LimitKind:
        return film.limited_force(path.gap(time), path.speed(time))[1]

    for low, high in pairwise(edges):
        first = acting(low)
        if first is acting(high):
            continue

        def changed(time: float, was: LimitKind = first) -> bool:
            return acting(time) is not was

        found.append(first_true(changed, low, high, atol=1e-9 * (high - low)))
    return found


def cycle_over(
    plan: Plan, path: VibrationPath, start: float, end: float, cavity: CavityCycles | None
) -> Cycle:
    """Impulses over a cycle, by Gauss quadrature in the graded phase."""
    edges, times, weights = panels(path, start, end, plan.film.kinks)
    if onsets := _onsets(plan, path, edges.tolist()):
        edges, times, weights = panels(path, start, end, plan.film.kinks, onsets)
    rows = [forces_at(plan, path.gap(t), path.speed(t)) for t in times.ravel().tolist()]
    pulls = [row["pull"] for row in rows]
    running = {}
    for name in rows[0]:
        force = np.array([row[name] for row in rows]).reshape(times.shape)
        running[name] = np.concatenate([[0.0], np.cumsum((weights * force).sum(axis=1))])
    if cavity is not None:
        viscous, name = cavity.running(edges), limited_name(plan)
        running["pull"] += viscous - running[name]
        running[name] = viscous
    return Cycle(edges, running, (min(pulls), max(pulls)))


def sums(path: VibrationPath, cycles: list[Cycle]) -> tuple[dict[str, Floats], dict[str, float]]:
    """Impulse [N.s] of each force up to the start of each cycle, and over the whole run.

    Between cycles that were not computed the sum is that of Euler and Maclaurin over a spline.
    """
    begins = np.array([cycle.times[0] for cycle in cycles]) * path.vibration.frequency
    places = np.rint(begins)
    starts: dict[str, Floats] = {}
    for name in cycles[0].running:
        each = np.array([cycle.total(name) for cycle in cycles])
        if places[-1] < len(cycles):  # none left out
            starts[name] = np.concatenate([[0.0], np.cumsum(each)[:-1]])
            continue
        whole = each.copy()
        last = cycles[-1]
        if (last.times[-1] - last.times[0]) * path.vibration.frequency < 1.0 - 1e-6:
            whole = whole[:-1]  # a part of a cycle is no point of the spline
        curve = CubicSpline(places[: len(whole)], whole)
        slope, sums = curve.derivative(), curve.antiderivative()
        known = sums(places) - 0.5 * (curve(places) - whole[0])
        starts[name] = known + (slope(places) - slope(0.0)) / 12.0
    totals = {name: float(begun[-1]) + cycles[-1].total(name) for name, begun in starts.items()}
    return starts, totals


def mean_pulls(
    plan: Plan, path: VibrationPath, cycles: list[Cycle], cavity: CavityCycles | None
) -> list[float]:
    """Pull [N], mean of each cycle; of a part at the end, mean of the last whole period."""
    period = 1.0 / path.vibration.frequency
    means = []
    for cycle in cycles:
        start, end = float(cycle.times[0]), float(cycle.times[-1])
        if end - start < period * (1.0 - 1e-6) and end > period:
            start = end - period
            cycle = cycle_over(plan, path, start, end, cavity)
        means.append(cycle.total("pull") / (end - start))
    return means


def steady_impulse(
    plan: Plan, path: VibrationPath, end: float, cavity: CavityCycles | None
) -> float:
    """Impulse [N.s] of the pull without the vibration over the same time."""
    last = min(end, (plan.film.end - path.begin) / path.rise)
    marks = [path.begin, *plan.film.kinks, path.mean(last)]
    total = 0.0
    for low, high in pairwise(sorted(mark for mark in marks if path.begin <= mark <= marks[-1])):
        edges = np.geomspace(low, high, 65)
        for a, b in pairwise(edges.tolist()):
            for node, weight in zip(*gauss_legendre(NODES), strict=True):
                found = forces_at(plan, a + node * (b - a), path.rise)
                pull = found["pull"] - (found[limited_name(plan)] if cavity is not None else 0.0)
                total += weight * (b - a) * pull / path.rise
    return total + (cavity.steady_impulse if cavity is not None else 0.0)
