r"""Motion of a wet map in time, with steps of the length in which gaps change by a given part.

Order 1 is implicit Euler. Order 2 is the SDIRK method with :math:`\gamma = 1 - 1/\sqrt 2`, two
implicit Euler stages of which the second starts from
:math:`y_0 + (1 - \gamma)/\gamma\,(Y_1 - y_0)`; both are L-stable. Where cavities and contacts come
and go the second order is lost, not the accuracy.

References
----------
Hairer and Wanner, Solving Ordinary Differential Equations II (1996), section IV.6.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import numpy as np
from attrs import evolve, frozen
from numpy.typing import NDArray

from ....numerics.blas import one_thread
from ..drive import Drive
from ..progress import Progress
from ..step import StepFailedError
from ..wet_gap import Sets
from .preconditioner import LocalCompliance
from .step import MapStepped, step
from .wet_map import MapFields, WetMap

__all__ = ["Counts", "MapControl", "MapState", "MapTrack", "begun", "follow"]

Array = NDArray[np.float64]

_GAMMA = 1.0 - math.sqrt(0.5)
_GROW, _SHRINK = 2.0, 0.25  # of a step from one to the next, at most
_TOO_MUCH = 2.0  # change over the one aimed at, with which a step is repeated
_BEND = 0.5  # with it a rough pull takes 1.4 times the steps, and the force is right to 1e-4
_SAFETY = 0.9  # of the length that would just meet it


@frozen
class MapControl:
    """Steps of a motion.

    Parameters
    ----------
    change : float
        Part of itself by which a gap may change in a step; the force may differ from the line
        through start and first stage by the square of half of it, of its largest so far.
    order : int
        1 or 2.
    strength : float
        Tension at which the whole film ruptures [Pa]; below that of a cavity it is the floor.
    first : float
        Length of the first step over the span.
    """

    change: float = 0.1
    order: int = 2
    strength: float = 0.0
    first: float = 1e-4


class MapState(NamedTuple):
    """State at an instant.

    `work` is that of the pull [J], `dissipated` that of the film and of jumps [J], `inflow` the
    volume that came in through the rim [m3].
    """

    time: float
    fields: MapFields
    sets: Sets
    ruptured: bool = False
    work: float = 0.0
    dissipated: float = 0.0
    inflow: float = 0.0


class Counts(NamedTuple):
    """Work of a motion: steps, stages, iterations of Newton and of GMRES."""

    steps: int = 0
    rejected: int = 0
    stages: int = 0
    newton: int = 0
    linear: int = 0
    most_linear: int = 0


class MapTrack(NamedTuple):
    """States at the times asked for, when a whole film ruptured, and the work."""

    states: list[MapState]
    rupture_times: list[float]
    counts: Counts


def begun(fields: MapFields, time: float = 0.0) -> MapState:
    """State of fields without cavities and contacts at a time [s]."""
    none = np.zeros(len(fields.pressure), dtype=bool)
    return MapState(time, fields, Sets(none, none))


@one_thread()
def follow(
    wet: WetMap,
    start: MapState,
    times: Sequence[float],
    control: MapControl | None = None,
    *,
    drive: Drive | None = None,
    every_step: bool = False,
    until: float = math.inf,
    observe: Callable[[MapState], None] | None = None,
) -> MapTrack:
    """Follow the motion from the first time to the last.

    Parameters
    ----------
    wet : WetMap
        With the floor of its cavities.
    start : MapState
        At the first of the times.
    times : sequence of float
        Ascending [s]; a step ends at each.
    control : MapControl, optional
        Default: `MapControl()`.
    drive : Imposed or Driven, optional
        In place of that of the map: the next part of a motion.
    every_step : bool
        Whether states are kept after each step, and not at the times alone.
    until : float
        Rigid gap at which the motion ends before the last time [m].
    observe : callable, optional
        Called with each state in place of keeping all: the track has the last two.

    Raises
    ------
    StepFailedError
        If no step, however short, can be solved.
    """
    if drive is not None:
        wet = evolve(wet, drive=drive)
    run = _Run(wet, start, times, control or MapControl())
    run.every_step, run.until, run.observe = every_step, until, observe
    run.go_through(times[1:])
    return MapTrack(run.kept, run.ruptures, run.counts)


class _Run(Progress[MapState, list[MapStepped]]):
    """Progress of a motion on a grid."""

    located = 1e-3
    after_rupture = 0.05

    def __init__(
        self, wet: WetMap, start: MapState, times: Sequence[float], control: MapControl
    ) -> None:
        super().__init__(start, times, control, wet.floor)
        self.cavitating, self.whole = wet, evolve(wet, floor=-math.inf)
        self.local = LocalCompliance(wet)
        self.before: MapState | None = None  # state a step ago, if nothing has jumped since
        self.counts = Counts()
        self.observe: Callable[[MapState], None] | None = None
        # What begins at once, a speed or a force, makes pressures jump, or bodies without mass.
        self.jumps = True
        self.highest = abs(wet.thrust(start.fields.total))

    def _keep(self) -> None:
        super()._keep()
        if self.observe is not None:
            self.observe(self.state)
            del self.kept[:-2]

    @property
    def wet(self) -> WetMap:
        """The map, without a floor as long as the film is whole."""
        return self.whole if self.waits else self.cavitating

    def _try(self, length: float, cut_from: float) -> bool:
        """See `Progress._try`."""
        try:
            stages = self._solve(length)
        except StepFailedError:
            return self._rejected(_SHRINK * length)
        change = self._change(stages[-1]) / self.control.change
        if not self.jumps:
            change = max(change, math.sqrt(self._bend(stages)) / (_BEND * self.control.change))
        if change > _TOO_MUCH:
            return self._rejected(length * max(_SHRINK, _SAFETY / change))
        if self._ruptures(stages):
            self._rupture(length)
            self.before = None
            self.jumps = True
            return True
        self._accept(stages, length)
        self.jumps = False
        self.length = max(cut_from, length * min(_GROW, _SAFETY / max(change, 1e-9)))
        return True

    def _rejected(self, length: float) -> bool:
        self.counts = self.counts._replace(rejected=self.counts.rejected + 1)
        self.length = length
        return False

    def _lowest(self, solved: list[MapStepped]) -> float:
        return float(solved[-1].fields.pressure.min())

    def _change(self, end: MapStepped) -> float:
        """Largest change of a gap over itself."""
        before: MapFields = self.state.fields
        old, new = before.content, self.wet.gap(end.fields)
        cutoff = self.wet.cutoff
        # Of cells that were in a cavity the content is no gap: there it is left out.
        full = ~(self.state.sets.void | end.sets.void)
        old, new = np.maximum(old[full], cutoff), np.maximum(new[full], cutoff)
        return float(np.abs(np.log(new / old)).max(initial=0.0))

    def _bend(self, stages: list[MapStepped]) -> float:
        """How far the force leaves the line through start and first stage, over its largest.

        Of one stage the square of its change.
        """
        forces = [self.wet.thrust(one.fields.total) for one in stages]
        start = self.wet.thrust(self.state.fields.total)
        highest = max(self.highest, abs(start), *map(abs, forces)) or 1.0
        if len(forces) == 1:
            return ((forces[0] - start) / highest) ** 2
        ahead = start + (forces[0] - start) / _GAMMA
        return abs(forces[-1] - ahead) / highest

    def _solve(self, length: float) -> list[MapStepped]:
        state, first = self.state, self.state.fields
        part = length if self.control.order == 1 else _GAMMA * length
        ahead = first
        if self.before is not None:
            elapsed = state.time - self.before.time
            if part <= elapsed:
                ahead = _extrapolated(self.before.fields, first, 1.0 + part / elapsed)
        guess = (ahead, state.sets)
        if self.control.order == 1:
            return [self._stage(first, guess, state.time + length, length)]
        one = self._stage(first, guess, state.time + part, part)
        carried = (1.0 - _GAMMA) / _GAMMA
        shifted = MapFields(
            one.fields.pressure,
            first.content + carried * (one.fields.content - first.content),
            one.fields.total,
            first.rigid_gap + carried * (one.fields.rigid_gap - first.rigid_gap),
            first.speed + carried * (one.fields.speed - first.speed),
        )
        end = state.time + length
        guess = (_extrapolated(first, one.fields, 1.0 / _GAMMA), one.sets)
        return [one, self._stage(shifted, guess, end, part)]

    def _stage(
        self, start: MapFields, guess: tuple[MapFields, Sets], time: float, length: float
    ) -> MapStepped:
        done = step(self.wet, self.local, start, guess, time, length)
        old = self.counts
        self.counts = old._replace(
            stages=old.stages + 1,
            newton=old.newton + len(done.linear),
            linear=old.linear + sum(done.linear),
            most_linear=max(old.most_linear, *done.linear),
        )
        return done

    def _accept(self, solved: list[MapStepped], length: float) -> None:
        before, end, wet = self.state, solved[-1], self.wet
        weights = [1.0] if len(solved) == 1 else [1.0 - _GAMMA, _GAMMA]

        def over_step(rates: list[float]) -> float:
            return length * sum(w * rate for w, rate in zip(weights, rates, strict=True))

        self.before = before
        self.highest = max(self.highest, abs(wet.thrust(end.fields.total)))
        power = [one.flow.power(one.fields.pressure) for one in solved]
        pulls = [-wet.thrust(one.fields.total) * one.fields.speed for one in solved]
        work, lost = over_step(pulls), over_step([one[0] for one in power])
        if self.jumps:
            # What neither film nor bodies keep is lost at once: a force begins, or a film ruptures.
            lost = work - self._stored(end.fields, end.sets) + self._stored(*before[1:3])
        self.state = MapState(
            before.time + length,
            end.fields,
            end.sets,
            before.ruptured and bool(end.sets.void.any()),
            before.work + work,
            before.dissipated + lost,
            before.inflow + over_step([one[1] for one in power]),
        )
        self.counts = self.counts._replace(steps=self.counts.steps + 1)

    def _stored(self, fields: MapFields, sets: Sets) -> float:
        """Energy in the bodies, and of cavities against the ambient pressure [J]."""
        return self.wet.elastic_energy(fields) + self.wet.cavity_energy(fields, sets)


def _extrapolated(before: MapFields, after: MapFields, at: float) -> MapFields:
    """Fields on the line through two states, at a time over that between them; for guesses."""

    def there(a: Any, b: Any) -> Any:
        return a + at * (b - a)

    return MapFields(*(there(a, b) for a, b in zip(before, after, strict=True)))
