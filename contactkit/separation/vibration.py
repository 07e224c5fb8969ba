"""An opening at an imposed speed while the gap vibrates: forces over the cycles, and their mean.

A film without limits resists closing as it resists opening, so that a vibration changes its
impulse by nothing but the ends of the path. A liquid that cavitates resists only the closing
fully: the vibration is rectified, and pushes the bodies apart on the mean. A convex meniscus force
has a mean above that of the mean gap, by a quarter of its second derivative times the amplitude
squared.
"""

from __future__ import annotations

import math
import time as clock
from collections.abc import Iterable
from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from scipy.interpolate import CubicSpline

from ..errors import InfeasibleError
from ..numerics.quadrature import gauss_legendre
from ..numerics.roots import bracketed_root, first_true
from ..scene.loading import ImposedSpeed, Vibration
from ..units import quantity_text
from .curve_result import Work
from .effects.base import LIMIT, FilmStatus, LimitKind
from .effects.force_law import law_impulse
from .plan import Plan
from .prescribed import frozen, limited_name, simulated, torn_row
from .results import SeparationResult, extremes_of, with_late_curves
from .torn_cycles import TornCycles, torn_cycles
from .torn_path import TornPoint
from .validity import check

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

__all__ = ["NODES", "PANELS", "VibrationPath", "panels", "vibrating"]

PANELS, NODES = 40, 4
"""Panels of a cycle, and nodes of each."""

_MOST_TORN = 2000  # cycles of a film that tears: some minutes
_MOST_GRADED = 0.9  # amplitude over mean gap up to which panels follow the gap


class VibrationPath(NamedTuple):
    """Gap [m] over time [s]: a mean that rises at a speed, and a vibration."""

    begin: float
    rise: float
    vibration: Vibration

    def mean(self, time: float) -> float:
        """Gap [m] without the vibration."""
        return self.begin + self.rise * time

    def gap(self, time: float) -> float:
        """Gap [m] at a time [s]."""
        return self.mean(time) + self.vibration.offset(time)

    def speed(self, time: float) -> float:
        """Opening speed [m/s] at a time [s]."""
        return self.rise + self.vibration.speed(time)

    def first_above(self, level: float, end: float) -> float:
        """First time [s] at which the gap reaches a level; inf if not before the end."""
        shaken = self.vibration
        pace = math.tau * shaken.frequency
        if self.gap(0.0) >= level:
            return 0.0
        low, high = 0.0, end
        if self.rise < pace * shaken.amplitude:
            # The gap peaks once a cycle, a little more each time: the first peak that suffices.
            turn = math.acos(-self.rise / (pace * shaken.amplitude))
            peak = (turn - shaken.phase) / pace
            missing = level - self.begin - shaken.amplitude * math.sin(turn)
            cycle = math.ceil(
                max(missing / self.rise, 0.0) * shaken.frequency - peak * pace / math.tau
            )
            high = min(peak + cycle / shaken.frequency, end)
            low = max(peak + cycle / shaken.frequency - 2.0 * turn / pace, 0.0)
        if self.gap(low) >= level:
            return low
        if low >= end or self.gap(high) < level:
            return math.inf
        return bracketed_root(lambda time: self.gap(time) - level, low, high)

    def turns(self, start: float, end: float) -> list[float]:
        """Times [s] between two, with both, from one turn of the gap to the next."""
        pace = math.tau * self.vibration.frequency
        if self.rise >= pace * self.vibration.amplitude:
            return [start, end]
        turn = math.acos(-self.rise / (pace * self.vibration.amplitude))
        first = math.floor(self.vibration.angle(start) / math.tau)
        last = math.ceil(self.vibration.angle(end) / math.tau)
        found = [
            (math.tau * cycle + side * turn - self.vibration.phase) / pace
            for cycle in range(first, last + 1)
            for side in (-1.0, 1.0)
        ]
        return [start, *(time for time in found if start < time < end), end]

    def crossings(self, level: float, start: float, end: float) -> list[float]:
        """Times [s] between two at which the gap passes a level."""
        found = []
        for low, high in pairwise(self.turns(start, end)):
            if (self.gap(low) - level) * (self.gap(high) - level) < 0.0:
                found.append(bracketed_root(lambda time: self.gap(time) - level, low, high))
        return found


def panels(
    path: VibrationPath,
    start: float,
    end: float,
    kinks: Iterable[float] = (),
    onsets: Iterable[float] = (),
) -> tuple[Floats, Floats, Floats]:
    """Edges of panels along a cycle, closer where the gap is small; nodes and weights [s] in each.

    Gaps [m] at which the slope of a force jumps, and times [s] at which one sets in, become edges.

    The phase is to the graded variable as the eccentric to the true anomaly of an orbit, so that
    powers of the gap are smooth in it.
    """
    shaken = path.vibration
    e = min(shaken.amplitude / path.mean(start), _MOST_GRADED)
    b = e / (1.0 + math.sqrt(1.0 - e * e))

    def graded(time: float) -> float:
        phase = shaken.angle(time) + 0.5 * math.pi
        return phase + 2.0 * math.atan(b * math.sin(phase) / (1.0 - b * math.cos(phase)))

    def phase_of(place: Floats) -> Floats:
        return place - 2.0 * np.arctan(b * np.sin(place) / (1.0 + b * np.cos(place)))

    def time_of(phase: Floats) -> Floats:
        return (phase - 0.5 * math.pi - shaken.phase) / (math.tau * shaken.frequency)

    first, last = graded(start), graded(end)
    found = [time for level in kinks for time in path.crossings(level, start, end)]
    jumps = [graded(time) for time in (*found, *onsets)]
    corners = np.unique([*np.linspace(first, last, PANELS + 1), *jumps])
    nodes, weights = (np.array(values) for values in gauss_legendre(NODES))
    inside = phase_of(corners[:-1, None] + np.diff(corners)[:, None] * nodes)
    edges = time_of(phase_of(corners))
    edges[0], edges[-1] = start, end
    # dt over the graded variable is as 1 - e cos(phase); a constant is integrated exactly.
    fractions = weights * (1.0 - e * np.cos(inside))
    fractions *= (np.diff(edges) / fractions.sum(axis=1))[:, None]
    return edges, time_of(inside), fractions


class _Cycle(NamedTuple):
    """Times [s] along a cycle, and the impulse [N.s] of each force up to each of them."""

    times: Floats
    running: dict[str, Floats]

    def total(self, name: str) -> float:
        return float(self.running[name][-1])


def vibrating(
    plan: Plan, loading: ImposedSpeed, vibration: Vibration, begun: float
) -> SeparationResult:
    """Forces of an opening at a speed with a vibration on it, and the means of its cycles.

    Raises
    ------
    InfeasibleError
        If the vibration takes the gap beyond the reach of the film at the start.
    """
    film = plan.film
    path = VibrationPath(loading.initial_gap, loading.speed, vibration)
    end = (loading.final_gap - loading.initial_gap) / loading.speed
    breaks = path.first_above(film.end, end) if math.isfinite(film.end) else math.inf
    if breaks <= 0.0:
        raise InfeasibleError(
            f"loading.vibration takes the gap to {path.gap(0.0):g} m at the start, but the film "
            f"reaches {film.end:g} m at most; shake less, or change Vibration.phase"
        )
    end = min(end, breaks)
    spans = _drawn(plan, path, end)
    torn = _torn(plan, path, spans)
    cycles = [_cycle(plan, path, *span, torn) for span in spans]
    starts, totals = _sums(path, cycles)
    columns = _curves(plan, path, cycles, starts, torn)
    impulses = {plan.columns[name].impulse.name: total for name, total in totals.items()}
    impulses["steady_pull_impulse"] = _steady_impulse(plan, path, end, torn)
    for kind, law in film.laws.items():
        if kind.newtonian is not None:
            newtonian = law_impulse(law, path.gap(0.0), path.gap(end))
            impulses[kind.newtonian.impulse.name] = newtonian
    n = len(columns["gap"]) + len(cycles) * PANELS * NODES
    return SeparationResult(
        plan,
        "curve",
        _message(path, end, _Break(breaks, film.end), len(cycles)),
        with_late_curves(plan, columns),
        impulses,
        None,
        check(plan, columns),
        Work(0, 0, n, clock.perf_counter() - begun),
        extremes_of(plan, columns),
    )


class _Break(NamedTuple):
    """Time [s] and gap [m] at which a film breaks; inf for never."""

    time: float
    gap: float


def _message(path: VibrationPath, end: float, broke: _Break, drawn: int) -> str:
    count = end * path.vibration.frequency
    said = (
        f"opened from {path.begin:g} m to {path.mean(end):g} m on the mean, in {count:.6g} cycles "
        f"of {path.vibration.amplitude:g} m"
    )
    if math.ceil(count) > drawn:
        said += f", of which {drawn} were computed"
    if broke.time > end:
        return said
    return f"{said}; the film broke at {quantity_text(broke.gap, 'm')}, after {broke.time:.6g} s"


def _drawn(plan: Plan, path: VibrationPath, end: float) -> list[tuple[float, float]]:
    """Cycles that are computed, as spans of time: all, or as many as a curve has points."""
    frequency, most = path.vibration.frequency, max(plan.accuracy.points, 8)
    whole = math.floor(end * frequency * (1.0 + 1e-12))
    places = np.arange(whole)
    if plan.film.cavity is not None:  # each cycle begins with what the last one left
        if whole > _MOST_TORN:
            raise InfeasibleError(
                f"{whole} cycles are too many for a film that remembers where it was torn: at most "
                f'{_MOST_TORN}; open faster, or take TensionLimit(cavity="truncated")'
            )
    elif whole > most:
        means = np.geomspace(path.begin, path.mean((whole - 1) / frequency), most)
        places = np.unique(np.rint((means - path.begin) / path.rise * frequency).astype(int))
    spans = [(k / frequency, (k + 1) / frequency) for k in places.tolist()]
    rest = whole / frequency
    if end - rest > 1e-9 / frequency:
        spans.append((rest, end))
    return spans


def _torn(plan: Plan, path: VibrationPath, spans: list[tuple[float, float]]) -> TornCycles | None:
    """Film that tears, at the edges of the panels; None if it has no memory."""
    film, law = plan.film, plan.film.cavity
    if law is None:
        return None
    edges = [panels(path, *span, film.kinks)[0] for span in spans]
    times: list[float] = np.unique(np.concatenate(edges)).tolist()

    def shaken(time: float) -> tuple[float, float]:
        return path.gap(time), path.speed(time)

    def steady(time: float) -> tuple[float, float]:
        return path.mean(time), path.rise

    return torn_cycles(film, law, shaken, steady, times, plan.accuracy.time_rtol)


def _forces(
    plan: Plan, gap: float, speed: float, torn: TornPoint | None = None
) -> dict[str, float]:
    """Each force [N] at a gap and a speed by the name of its column, and the pull."""
    found = plan.film.at(gap, speed, torn.force if torn is not None else None).named
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


def _cycle(
    plan: Plan, path: VibrationPath, start: float, end: float, torn: TornCycles | None
) -> _Cycle:
    """Impulses over a cycle, by Gauss quadrature in the graded phase."""
    edges, times, weights = panels(path, start, end, plan.film.kinks)
    if onsets := _onsets(plan, path, edges.tolist()):
        edges, times, weights = panels(path, start, end, plan.film.kinks, onsets)
    rows = [_forces(plan, path.gap(t), path.speed(t)) for t in times.ravel().tolist()]
    running = {}
    for name in rows[0]:
        force = np.array([row[name] for row in rows]).reshape(times.shape)
        running[name] = np.concatenate([[0.0], np.cumsum((weights * force).sum(axis=1))])
    if torn is not None:
        viscous, name = torn.running(edges), limited_name(plan)
        running["pull"] += viscous - running[name]
        running[name] = viscous
    return _Cycle(edges, running)


def _sums(path: VibrationPath, cycles: list[_Cycle]) -> tuple[dict[str, Floats], dict[str, float]]:
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


def _curves(
    plan: Plan,
    path: VibrationPath,
    cycles: list[_Cycle],
    starts: dict[str, Floats],
    torn: TornCycles | None,
) -> dict[str, Floats]:
    """Curves over the cycles that were computed."""
    times = [cycle.times[:-1] for cycle in cycles]
    times[-1] = cycles[-1].times
    sizes = [len(part) for part in times]
    moments = np.concatenate(times).tolist()
    points = [(path.gap(t), path.speed(t)) for t in moments]
    shaken = [torn.shaken[t] if torn is not None else None for t in moments]
    rows = [_row(plan, *point, film) for point, film in zip(points, shaken, strict=True)]
    steady = [_steady_pull(plan, path, t, torn) for t in moments]
    columns = {
        "time": frozen(moments),
        "gap": frozen([gap for gap, _ in points]),
        "speed": frozen([speed for _, speed in points]),
        "mean_gap": frozen([path.mean(t) for t in moments]),
        "pull": frozen([row["pull"] for row in rows]),
        "mean_pull": frozen(np.repeat(_cycle_means(plan, path, cycles, torn), sizes)),
        "steady_pull": frozen(steady),
        "film_status": frozen([row["film_status"] for row in rows]),
    } | {name: frozen([row[name] for row in rows]) for name in simulated(plan)}
    for kind in plan.film.laws:
        if kind.so_far is not None:
            name = kind.column.name
            parts = [
                begun + cycle.running[name][:size]
                for begun, cycle, size in zip(starts[name], cycles, sizes, strict=True)
            ]
            columns[kind.so_far.name] = frozen(np.concatenate(parts))
    return columns


def _cycle_means(
    plan: Plan, path: VibrationPath, cycles: list[_Cycle], torn: TornCycles | None
) -> list[float]:
    """Pull [N], mean of each cycle; of a part at the end, mean of the last whole period."""
    period = 1.0 / path.vibration.frequency
    means = []
    for cycle in cycles:
        start, end = float(cycle.times[0]), float(cycle.times[-1])
        if end - start < period * (1.0 - 1e-6) and end > period:
            start = end - period
            cycle = _cycle(plan, path, start, end, torn)
        means.append(cycle.total("pull") / (end - start))
    return means


def _row(plan: Plan, gap: float, speed: float, torn: TornPoint | None) -> dict[str, float]:
    """What the curves show at a gap and a speed."""
    film = plan.film
    found = film.at(gap, speed, torn.force if torn is not None else None)
    row = found.named | found.newtonian
    row["pull"], row[LIMIT.name] = sum(found.named.values()), float(found.limit)
    row |= torn_row(plan, torn) if torn is not None else {}
    row["film_status"] = float(FilmStatus.FULL if gap <= film.full_gap else FilmStatus.BRIDGE)
    return row


def _steady_pull(plan: Plan, path: VibrationPath, time: float, torn: TornCycles | None) -> float:
    """Pull [N] at a time without the vibration; 0 where the film would have broken."""
    gap = path.mean(time)
    if gap > plan.film.end:
        return 0.0
    return _forces(plan, gap, path.rise, torn.steady[time] if torn is not None else None)["pull"]


def _steady_impulse(plan: Plan, path: VibrationPath, end: float, torn: TornCycles | None) -> float:
    """Impulse [N.s] of the pull without the vibration over the same time."""
    last = min(end, (plan.film.end - path.begin) / path.rise)
    marks = [path.begin, *plan.film.kinks, path.mean(last)]
    total = 0.0
    for low, high in pairwise(sorted(mark for mark in marks if path.begin <= mark <= marks[-1])):
        edges = np.geomspace(low, high, 65)
        for a, b in pairwise(edges.tolist()):
            for node, weight in zip(*gauss_legendre(NODES), strict=True):
                found = _forces(plan, a + node * (b - a), path.rise)
                pull = found["pull"] - (found[limited_name(plan)] if torn is not None else 0.0)
                total += weight * (b - a) * pull / path.rise
    return total + (torn.steady_impulse if torn is not None else 0.0)
