"""Curves over the cycles of a vibration, at as many points as straight lines need."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np
from attrs import field, frozen

from ...numerics.lines import SHARE, needed, with_middles
from .. import prescribed
from ..bridge_end import errors_of_curves, followed
from ..cavity_points import CavityPoint
from ..effects.base import LIMIT, FilmStatus
from ..plan import Plan
from .cavity import CavityCycles
from .cycles import Cycle, forces_at, mean_pulls
from .path import VibrationPath

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

__all__ = ["CycleCurves", "CycleLines", "curve_names"]


def curve_names(plan: Plan) -> list[str]:
    """Names of the curves over the cycles of a vibration."""
    return ["time", *_names(plan), "mean_pull"]


def _names(plan: Plan) -> list[str]:
    """Names of the curves that are not constant over a cycle, the gap first."""
    known = ["gap", "speed", "mean_gap", "pull", "steady_pull", "film_status"]
    return [*known, *prescribed.simulated(plan), *prescribed.impulses_so_far(plan)]


@frozen(eq=False)
class CycleCurves:
    """Curves over one cycle, at any of its times.

    Parameters
    ----------
    plan, path
        The scene, and the gap over time.
    cycle : Cycle
        The cycle, and its impulses.
    begun : mapping of str to float
        Impulse [N.s] of each force up to its start, by the name of its column.
    cavity : CavityCycles or None
        Film that cavitates, where it remembers it.
    """

    plan: Plan
    path: VibrationPath
    cycle: Cycle
    begun: Mapping[str, float]
    cavity: CavityCycles | None
    _known: dict[float, list[float]] = field(factory=dict, init=False, repr=False)

    def table(self, times: Floats) -> Floats:
        """Curves at ascending times [s], among them the edges of the panels of the cycle.

        What lines follow beside the curves is last: the distance to the end of a bridge, and the
        logarithm of the gap. The impulse is exact at the edges, and that of the lines between them.
        """
        names = _names(self.plan)
        moments = times.tolist()
        films = self.cavity.at(moments) if self.cavity is not None else []
        steady = self.cavity.steady_at(moments) if self.cavity is not None else []
        for i, time in enumerate(moments):
            if time not in self._known:
                film = films[i] if films else None
                calm = steady[i] if i < len(steady) else None
                self._known[time] = self._row(names, time, film, calm)
        found = np.array([self._known[time] for time in moments])
        for kind in self.plan.film.laws:
            if kind.so_far is not None:
                name = kind.column.name
                impulse = self._impulse(name, times, found[:, names.index(name)])
                found[:, names.index(kind.so_far.name)] = self.begun[name] + impulse
        return found

    def lines(self, errors: Floats) -> tuple[Floats, Floats]:
        """Times [s] that lines need to be right to some errors, and the curves there."""
        rtol = self.plan.accuracy.curve_rtol

        def allowed(values: Floats) -> Floats:
            limits = np.broadcast_to(errors, values.shape).copy()
            limits[..., 0] = rtol * values[..., 0]  # of the gap
            return limits

        times = self.cycle.times
        if self.cavity is not None:
            times = np.unique([*times, *self.cavity.events(times[1:].tolist())])
        times = with_middles(times, self.table, rtol, lambda values: SHARE * allowed(values))
        table = self.table(times)
        rest = (1.0 - SHARE) * allowed(table)
        kept = needed(np.column_stack([times, table]), rest, np.array([0]))
        return times[kept], table[kept]

    def _impulse(self, name: str, times: Floats, force: Floats) -> Floats:
        """Impulse [N.s] of a force from the start of the cycle on."""
        edges, running = self.cycle.times, self.cycle.running[name]
        parts = 0.5 * (force[1:] + force[:-1]) * np.diff(times)
        found = np.concatenate([[0.0], np.cumsum(parts)])
        missing = running - found[np.searchsorted(times, edges)]
        return np.asarray(found + np.interp(times, edges, missing))

    def _row(
        self, names: Sequence[str], time: float, film: CavityPoint | None, calm: CavityPoint | None
    ) -> list[float]:
        """What the curves show at a time, and what lines follow beside them."""
        plan, path = self.plan, self.path
        gap, speed = path.gap(time), path.speed(time)
        found = plan.film.at(gap, speed, film.force if film is not None else None)
        known = dict.fromkeys(names, 0.0) | found.named | found.newtonian
        known |= {"pull": sum(found.named.values()), LIMIT.name: float(found.limit)}
        known |= prescribed.cavity_row(plan, film) if film is not None else {}
        is_full = gap <= plan.film.full_gap
        known |= {
            "gap": gap,
            "speed": speed,
            "mean_gap": path.mean(time),
            "steady_pull": self._steady_pull(time, calm),
            "film_status": float(FilmStatus.FULL if is_full else FilmStatus.BRIDGE),
        }
        return [*(known[name] for name in names), *followed(plan, gap)]

    def _steady_pull(self, time: float, calm: CavityPoint | None) -> float:
        """Pull [N] at a time without the vibration; 0 where the film would have broken."""
        gap = self.path.mean(time)
        if gap > self.plan.film.end:
            return 0.0
        return forces_at(self.plan, gap, self.path.rise, calm)["pull"]


@frozen(eq=False)
class CycleLines:
    """Curves over the cycles that were computed, with points where lines need them."""

    plan: Plan
    parts: Sequence[CycleCurves]

    def at_edges(self) -> dict[str, Floats]:
        """Curves at the edges of the panels, by their names."""
        return dict(zip(_names(self.plan), self._edges().T, strict=False))

    def _edges(self) -> Floats:
        return np.concatenate([part.table(part.cycle.times) for part in self.parts])

    def __call__(self) -> dict[str, Floats]:
        """Return the curves by their names; a jump is two points."""
        errors = errors_of_curves(self._edges(), self.plan.accuracy.curve_rtol)
        found = [part.lines(errors) for part in self.parts]
        for (times, _), (later, _) in pairwise(found):
            # The mean of a cycle changes at once.
            times[-1] = min(times[-1], math.nextafter(later[0], -math.inf))
        first = self.parts[0]
        cycles = [part.cycle for part in self.parts]
        means = mean_pulls(self.plan, first.path, cycles, first.cavity)
        whole = np.concatenate([table for _, table in found])
        columns = {"time": prescribed.frozen(np.concatenate([times for times, _ in found]))}
        for name, values in zip(_names(self.plan), whole.T, strict=False):
            columns[name] = prescribed.frozen(values)
        columns["mean_pull"] = prescribed.frozen(np.repeat(means, [len(t) for t, _ in found]))
        return columns
