"""Gap over time of an opening that vibrates, and panels along a cycle."""

from __future__ import annotations

import math
from collections.abc import Iterable
from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ...numerics.quadrature import gauss_legendre
from ...numerics.roots import bracketed_root
from ...scene.loading import Vibration

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

__all__ = ["NODES", "PANELS", "VibrationPath", "panels"]

PANELS, NODES = 40, 4
"""Panels of a cycle, and nodes of each."""

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
