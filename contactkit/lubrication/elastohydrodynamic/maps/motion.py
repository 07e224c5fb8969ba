"""Phases of the motion of a wet map: its curves, a section at each of their points, and maps."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from attrs import evolve
from numpy.typing import NDArray

from ..motion import Phase, end_time
from .follow import Counts, MapControl, MapState, begun, follow
from .wet_map import WetMap, at_rest

__all__ = ["FIELDS", "MapMotion", "move_map"]

Array = NDArray[np.float64]

FIELDS = ("gap", "film_pressure", "solid_pressure", "liquid")
"""Maps of a state: gap [m], pressures of film and solids [Pa], part of the gap that is full."""

# First step over that in which the bodies, at the given speed, move by as much as a step may:
# whatever begins at once, a speed or a force, makes the pressures jump.
_FIRST = 0.1
_LONGEST = 1e-2  # of the span
_MOST_MAPS = 40  # of a motion, without those that are asked for: 40 MB on 256 x 256 cells
_WIDE = 4.0  # widths of the pressure within which the slope of the gap is looked at
_SAME = 1e-12  # times over the last one that differ by round-off


class MapMotion(NamedTuple):
    """Curves of a motion, by their names.

    Attributes
    ----------
    columns : mapping of str to ndarray
        Over the times [s] of ``time``.
    sections : mapping of str to ndarray
        `FIELDS` along the row of cells through the axis, (n_times, n_cells), and the places
        ``radius`` [m] of the cells on it.
    maps : mapping of str to ndarray
        `FIELDS` at some of the times, (n_maps, ny, nx) in single precision, and these times
        ``time`` [s].
    end_times : list of float
        Times at which the phases ended [s].
    is_over : bool
        Whether the last phase ended at its gap, and not at its last time.
    rupture_time : float
        When the film first ruptured, or a cavity opened [s]; nan: it did not.
    slope, pressure : float
        Largest slope of the gap within four widths of the pressure [-], and largest pressure on
        the bodies [Pa], by its magnitude.
    inflow : float
        Liquid that came in through the rim [m3].
    counts : Counts
        Work.
    """

    columns: Mapping[str, Array]
    sections: Mapping[str, Array]
    maps: Mapping[str, NDArray[Any]]
    end_times: list[float]
    is_over: bool
    rupture_time: float
    slope: float
    pressure: float
    inflow: float
    counts: Counts


def move_map(
    wet: WetMap,
    gap: float,
    phases: Sequence[Phase],
    control: MapControl,
    *,
    speed: float,
    width: float,
    keep: Sequence[float] = (),
) -> MapMotion:
    """Follow the motion of bodies on a map from rest.

    Parameters
    ----------
    wet : WetMap
        The bodies; its drive is not used.
    gap : float
        Rigid gap at the start [m].
    phases : sequence of Phase
        One after the other.
    control : MapControl
        Steps; the first of a phase follows from `speed`.
    speed : float
        A speed that is characteristic [m/s].
    width : float
        Width of the pressure about the axis [m].
    keep : sequence of float
        Times [s] whose maps are kept in any case; a step ends at each.

    Raises
    ------
    StepFailedError
        If a step cannot be solved: a gap closes where nothing can touch.
    """
    state = begun(at_rest(wet, gap))
    record = _Record(wet, width, keep)
    record.add(state)
    ends, ruptures, works = list[float](), list[float](), list[Counts]()
    for phase in phases:
        drive = phase.drive(state.fields.rigid_gap, state.time)
        asked = sorted({*phase.times, *(t for t in keep if state.time < t < phase.times[-1])})
        times = [state.time, *(t for t in asked if t > state.time * (1.0 + _SAME))]
        least = max(float(wet.gap(state.fields).min()), wet.cutoff)
        first = _FIRST * control.change * least / speed
        span = times[-1] - times[0]
        track = follow(
            wet,
            state,
            times,
            evolve(control, first=min(first / span, _LONGEST)),
            drive=drive,
            every_step=True,
            until=phase.until,
            observe=record.add,
        )
        state = track.states[-1]
        ends.append(end_time(track.states, phase.until))
        ruptures += track.rupture_times
        works.append(track.counts)
    opened = ruptures[0] if ruptures else record.opened
    is_over = state.fields.rigid_gap >= phases[-1].until
    return MapMotion(
        record.columns(),
        record.sections(),
        record.kept_maps(),
        ends,
        is_over,
        opened,
        record.slope,
        record.pressure,
        state.inflow,
        _sum(works),
    )


class _Record:
    """Curves, sections and maps of the states of a motion."""

    def __init__(self, wet: WetMap, width: float, keep: Sequence[float]) -> None:
        self.wet, self.keep = wet, keep
        self.rows: list[dict[str, float]] = []
        self.cuts: list[list[Array]] = []
        self.maps: list[tuple[float, NDArray[Any]]] = []
        self.every = 1  # state whose maps are kept
        self.opened, self.slope, self.pressure = math.nan, 0.0, 0.0
        face, mesh = wet.face, wet.mesh
        row, column = np.divmod(mesh.loaded, face.shape[1])
        x, y = face.x[0, column], face.y[row, 0]
        self.axis = int(np.hypot(x, y).argmin())
        self.cut = np.flatnonzero(row == row[self.axis])
        self.places = x[self.cut]
        near = np.hypot(x, y) <= _WIDE * width
        low, high = mesh.number[mesh.sides.low], mesh.number[mesh.sides.high]
        within = near[low] & near[high]
        self.pairs = low[within], high[within]
        dy, dx = face.pixel_size
        self.steps = np.where(mesh.sides.axis == 0, dy, dx)[within]

    def add(self, state: MapState) -> None:
        """Record a state; the later one of two at the same time."""
        if self.rows and state.time <= self.rows[-1]["time"] * (1.0 + _SAME):
            self.rows.pop()
            self.cuts.pop()
            if self.maps and self.maps[-1][0] >= state.time * (1.0 - _SAME):
                self.maps.pop()
        wet, now, sets = self.wet, state.fields, state.sets
        gap = wet.gap(now)
        held = np.where(sets.contact, wet.cutoff, gap)
        # Contents of full cells are their gaps up to the tolerance of the iteration.
        filled = np.where(sets.void, np.clip(now.content / held, 0.0, 1.0), 1.0)
        values = [gap, now.pressure, now.total - now.pressure, filled]
        self.rows.append(_row(wet, state, gap, held, self.axis))
        self.cuts.append([one[self.cut] for one in values])
        self._note(state, gap)
        if (len(self.rows) - 1) % self.every == 0 or self._is_asked(state.time):
            self.maps.append((state.time, self._on_window(values)))
            self._thin_out()

    def _note(self, state: MapState, gap: Array) -> None:
        low, high = self.pairs
        slopes = np.abs(gap[high] - gap[low]) / self.steps
        self.slope = max(self.slope, float(slopes.max(initial=0.0)))
        self.pressure = max(self.pressure, float(np.abs(state.fields.total).max()))
        if math.isnan(self.opened) and (state.ruptured or bool(state.sets.void.any())):
            self.opened = state.time

    def _is_asked(self, time: float) -> bool:
        return any(abs(time - one) <= _SAME * one for one in self.keep)

    def _on_window(self, values: Sequence[Array]) -> NDArray[Any]:
        (ny, nx), place = self.wet.sides.window
        found = np.zeros((len(values), ny * nx), np.float32)
        found[:, place] = values
        return found.reshape(len(values), ny, nx)

    def _thin_out(self) -> None:
        """Keep every second of the maps that nobody asked for, if they are too many."""
        free = [k for k, (time, _) in enumerate(self.maps) if not self._is_asked(time)]
        if len(free) <= _MOST_MAPS:
            return
        self.every *= 2
        left_out = set(free[1::2])
        self.maps = [one for k, one in enumerate(self.maps) if k not in left_out]

    def columns(self) -> dict[str, Array]:
        """Curves by their names."""
        return {name: np.array([row[name] for row in self.rows]) for name in self.rows[0]}

    def sections(self) -> dict[str, Array]:
        """Sections through the axis, one for each point of the curves."""
        found = {
            name: np.array(one)
            for name, one in zip(FIELDS, zip(*self.cuts, strict=True), strict=True)
        }
        return {"radius": np.tile(self.places, (len(self.rows), 1)), **found}

    def kept_maps(self) -> dict[str, NDArray[Any]]:
        """Maps, and their times."""
        stacked = np.array([one for _, one in self.maps])
        found = {name: stacked[:, k] for k, name in enumerate(FIELDS)}
        return {"time": np.array([time for time, _ in self.maps]), **found}


def _row(wet: WetMap, state: MapState, gap: Array, held: Array, axis: int) -> dict[str, float]:
    now, sets = state.fields, state.sets
    area = float(wet.cell_area) * len(gap)
    bent = 0.5 * wet.thrust(now.total * (gap - now.rigid_gap - wet.of_map(wet.shape)))
    return {
        "time": state.time,
        "gap": now.rigid_gap,
        "speed": now.speed,
        "centre_gap": float(gap[axis]),
        "mean_gap": float(gap.mean()),
        "smallest_gap": float(gap.min()),
        "film_force": -wet.thrust(now.pressure),
        "contact_force": wet.thrust(now.total - now.pressure),
        "pull": -wet.thrust(now.total),
        "largest_tension": -float(now.pressure.min()),
        "rim_radius": math.sqrt(area / math.pi),
        "contact_area": float(sets.contact.sum()) * wet.cell_area,
        "void_volume": wet.volume(np.where(sets.void, held - now.content, 0.0)),
        "liquid_volume": wet.volume(now.content),
        "elastic_energy": bent,
        "work": state.work,
        "dissipated_energy": state.dissipated,
    }


def _sum(works: Sequence[Counts]) -> Counts:
    added = Counts(*(sum(values) for values in zip(*works, strict=True)))
    return added._replace(most_linear=max(work.most_linear for work in works))
