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
from typing import NamedTuple

import numpy as np

from ...errors import InfeasibleError
from ...scene.loading import ImposedSpeed, Vibration
from ...units import quantity_text
from ..curve_result import LateColumns, Work
from ..effects.force_law import law_impulse
from ..plan import Plan
from ..results import SeparationResult, extremes_of, pulls_of_cycles, with_late_curves
from ..validity import check
from .cavity import CavityCycles
from .curves import CycleCurves, CycleLines, curve_names
from .cycles import cycle_over, steady_impulse, sums
from .path import NODES, PANELS, VibrationPath, panels

__all__ = ["vibrating"]

_MOST_CAVITATING = 2000  # cycles of a film that cavitates: some minutes


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
    cavity = _cavity(plan, path, spans)
    cycles = [cycle_over(plan, path, *span, cavity) for span in spans]
    starts, totals = sums(path, cycles)
    parts = []
    for i, cycle in enumerate(cycles):
        begun_at = {name: float(up_to[i]) for name, up_to in starts.items()}
        parts.append(CycleCurves(plan, path, cycle, begun_at, cavity))
    lines = CycleLines(plan, parts)
    along = lines.at_edges()
    impulses = {plan.columns[name].impulse.name: total for name, total in totals.items()}
    impulses["steady_pull_impulse"] = steady_impulse(plan, path, end, cavity)
    for kind, law in film.laws.items():
        if kind.newtonian is not None:
            newtonian = law_impulse(law, path.gap(0.0), path.gap(end))
            impulses[kind.newtonian.impulse.name] = newtonian
    pulls = along["pull"]
    if cavity is None:  # the nodes are of a film that is full
        pulls = np.concatenate([pulls, *(cycle.pulls for cycle in cycles)])
    extremes = extremes_of(plan, along)
    if extremes:
        extremes |= {"peak_repulsion": max(-pulls.min(), 0.0), "peak_force": max(pulls.max(), 0.0)}
    n = len(along["gap"]) + len(cycles) * PANELS * NODES
    return SeparationResult(
        plan,
        "curve",
        _message(path, end, _Break(breaks, film.end), len(cycles)),
        with_late_curves(plan, LateColumns({}, dict.fromkeys(curve_names(plan), lines))),
        impulses,
        None,
        check(plan, along),
        Work(0, 0, n, clock.perf_counter() - begun),
        extremes | pulls_of_cycles(impulses, end, pulls),
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
    if math.ceil(count * (1.0 - 1e-12)) > drawn:
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
        if whole > _MOST_CAVITATING:
            raise InfeasibleError(
                f"{whole} cycles are too many for a film that remembers its cavity: at most "
                f'{_MOST_CAVITATING}; open faster, or take TensionLimit(cavity="truncated")'
            )
    elif whole > most:
        means = np.geomspace(path.begin, path.mean((whole - 1) / frequency), most)
        places = np.unique(np.rint((means - path.begin) / path.rise * frequency).astype(int))
    spans = [(k / frequency, (k + 1) / frequency) for k in places.tolist()]
    rest = whole / frequency
    if end - rest > 1e-9 / frequency:
        spans.append((rest, end))
    return spans


def _cavity(
    plan: Plan, path: VibrationPath, spans: list[tuple[float, float]]
) -> CavityCycles | None:
    """Film that cavitates, at the edges of the panels; None if it has no memory."""
    film, law = plan.film, plan.film.cavity
    if law is None:
        return None
    edges = [panels(path, *span, film.kinks)[0] for span in spans]
    times: list[float] = np.unique(np.concatenate(edges)).tolist()

    def vibrating_place(time: float) -> tuple[float, float]:
        return path.gap(time), path.speed(time)

    def steady_place(time: float) -> tuple[float, float]:
        return path.mean(time), path.rise

    rtol = plan.accuracy.time_rtol
    return CavityCycles(film, law, vibrating_place, steady_place, times, rtol)
