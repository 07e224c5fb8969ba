r"""Force of a film on a grid whose voids stay, over gap and speed.

Cells with a void hold the pressure of the cavity; the others are full, or cavitate where their
tension would exceed that of the cavity. As long as none does, the tension is linear in the speed,

.. math:: t = \Delta p \, q_1 + \eta v \, q_2

and between even faces :math:`q_2 \propto h^{-3}`, so that two solutions give the force at every gap
and speed. Beyond, where the cavity grows, it is the obstacle problem of the same cells.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from scipy.interpolate import PchipInterpolator

from ...lubrication.reynolds.film import GridFilm, GridFilmState
from ...lubrication.reynolds.solve import unchecked_pressure
from .grid import FaceGrid

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Map = NDArray[np.floating[Any]]
    Mask = NDArray[np.bool_]

__all__ = ["FirstOpening", "HeldForce", "HeldVoids"]

_PINNED = 1e3  # growth of a void over the fastest inflow of a cell: it cannot fill
_NEAREST = 0.05  # distance of a rim over a cell, the least that the grid takes
_LADDER = (1e-2, 1e6, 49)  # speed over that of inception less 1: six solutions in a decade
_STALE = 0.05  # relative move of gap or speed within which slopes serve again
_NEAR = 1e-6  # relative difference of gap and speed for slopes; pressures are right to 1e-12


class HeldForce(NamedTuple):
    """Force [N], its slopes [N/m] and [N.s/m], and the area at the pressure of the cavity [m2]."""

    force: float
    by_gap: float
    by_speed: float
    cavity_area: float


class _Linear(NamedTuple):
    """Tensions over that of the cavity and, at a gap, over viscosity and speed; up to a speed."""

    force: float  # at rest [N]
    by_speed: float  # [N.s/m]
    most: float  # speed at which a full cell cavitates [m/s]


class Nearby:
    """Solution of the last place, from which the next begins: full cells, and slopes.

    Slopes only steer the iteration of a step: those of a place within a twentieth do.
    """

    def __init__(self) -> None:
        self.full: Mask | None = None
        self._place, self._slopes = (0.0, 0.0), (0.0, 0.0)

    def slopes(
        self, gap: float, speed: float, solved: Callable[[], tuple[float, float]]
    ) -> tuple[float, float]:
        """Slopes over gap and speed [N/m], [N.s/m]; `solved` finds them where none are near."""
        gap_was, speed_was = self._place
        if abs(gap - gap_was) > _STALE * gap or abs(speed - speed_was) > _STALE * abs(speed):
            self._place, self._slopes = (gap, speed), solved()
        return self._slopes


class HeldVoids:
    """Film on a grid with some of its cells full and voids in the others.

    Parameters
    ----------
    grid : FaceGrid
        The face.
    film : GridFilm
        Liquid, and pressure of its cavity.
    full : ndarray of bool, shape (ny, nx)
        Cells without a void.
    opening : FirstOpening, optional
        Force between even faces where the cavity of a full film has grown.
    nearby : Nearby, optional
        Solution of the last place.
    """

    def __init__(
        self,
        grid: FaceGrid,
        film: GridFilm,
        full: Mask,
        opening: FirstOpening | None = None,
        nearby: Nearby | None = None,
    ) -> None:
        self._grid, self._film, self._full, self._opening = grid, film, full, opening
        self._nearby = nearby or Nearby()
        self._area = float(grid.face.cell_area)
        self._held = float((grid.face.loaded & ~full).sum()) * self._area
        self._known: dict[float, _Linear] = {}

    def __call__(self, gap: float, speed: float) -> HeldForce:
        """Force at a gap [m] and a speed [m/s]."""
        if not self._grid.is_even:
            force, area = self._solution(gap, speed)
            slopes = self._nearby.slopes(gap, speed, lambda: self._slopes(gap, speed, force))
            return HeldForce(force, *slopes, area)
        linear = self._linear(gap)
        if speed <= linear.most:
            force, by_speed, area = (
                linear.force + linear.by_speed * speed,
                linear.by_speed,
                self._held,
            )
        else:
            opening = self._opening
            grown = None if opening is None else opening.beyond(gap, speed, self._full)
            if grown is not None:
                return grown
            force, area = self._solution(gap, speed)
            faster = self._solution(gap, speed * (1.0 + _NEAR))[0]
            by_speed = max(faster - force, 0.0) / (_NEAR * speed)
        return HeldForce(force, -3.0 * by_speed * speed / gap, by_speed, area)  # by v/h^3

    def _slopes(self, gap: float, speed: float, force: float) -> tuple[float, float]:
        """Slopes over gap and speed [N/m], [N.s/m], by differences."""
        wider = self._solution(gap * (1.0 + _NEAR), speed)[0]
        more = _NEAR * (abs(speed) or self._linear(gap).most)
        faster = self._solution(gap, speed + more)[0]
        return (wider - force) / (_NEAR * gap), max(faster - force, 0.0) / more

    def most(self, gap: float) -> float:
        """Speed [m/s] at which a full cell cavitates at a gap [m]."""
        return self._linear(gap).most

    def _linear(self, gap: float) -> _Linear:
        """Force over speed at a gap [m]; between even faces that of the first gap, scaled."""
        if self._grid.is_even and self._known:
            ((first, known),) = self._known.items()
            scale = (gap / first) ** 3
            return _Linear(known.force, known.by_speed / scale, known.most * scale)
        if gap not in self._known:
            self._known = {gap: self._solved(gap)}
        return self._known[gap]

    def _solved(self, gap: float) -> _Linear:
        drop, full = self._film.drop, self._full
        speed = inflow_of(self._grid, self._film, gap)
        rest = self._pressure(gap, 0.0, full)
        closing = self._pressure(gap, -speed, full)  # no cell cavitates
        by_speed = (closing.pressure - rest.pressure) / speed  # tension over speed
        left = np.where(full & self._grid.face.loaded, drop + rest.pressure, np.inf)
        with np.errstate(divide="ignore", invalid="ignore"):
            most = np.where(by_speed > 0.0, left / by_speed, np.inf)
        return _Linear(rest.force, (rest.force - closing.force) / speed, float(most.min()))

    def _solution(self, gap: float, speed: float) -> tuple[float, float]:
        """Force [N] and area of the cavity [m2], with the cells that cavitate besides."""
        last = self._nearby.full
        state = self._pressure(gap, speed, self._full if last is None else last & self._full)
        void = void_of(self._grid, state)
        self._nearby.full = ~void
        return state.force, float(void.sum()) * self._area

    def _pressure(self, gap: float, speed: float, guess: Mask) -> GridFilmState:
        pinned = _PINNED * (abs(speed) + inflow_of(self._grid, self._film, gap))
        rate = np.where(self._full, speed, pinned)
        return unchecked_pressure(self._film, self._grid.relief + gap, rate, full=guess)


class FirstOpening:
    """Cavity of a full film between even faces, while it grows: a function of v/h^3.

    Solved at some speeds over that of inception, with monotone cubics between them.
    """

    def __init__(self, grid: FaceGrid, film: GridFilm, gap: float) -> None:
        whole = HeldVoids(grid, film, np.ones(grid.face.shape, bool))
        self._gap, self._onset = gap, whole.most(gap)
        self._ratios = np.concatenate([[1.0], 1.0 + np.geomspace(*_LADDER)])
        forces, areas, self._full = [], [], []
        guess = np.ones(grid.face.shape, bool)
        for ratio in self._ratios:
            rate = np.full(grid.face.shape, ratio * self._onset)
            state = unchecked_pressure(film, grid.relief + gap, rate, full=guess)
            void = void_of(grid, state)
            guess = ~void
            forces.append(state.force)
            areas.append(float(void.sum()) * grid.face.cell_area)
            self._full.append(guess)
        places = np.log(self._ratios)
        self._force = PchipInterpolator(places, forces)
        self._slope = self._force.derivative()
        self._areas = PchipInterpolator(places, areas)

    def _place(self, gap: float, speed: float) -> tuple[float, int]:
        """Logarithm of the speed over that of inception, and the next solution from there."""
        ratio = speed / (self._onset * (gap / self._gap) ** 3)
        return math.log(ratio) if ratio > 0.0 else -math.inf, int(
            np.searchsorted(self._ratios, ratio)
        )

    def beyond(self, gap: float, speed: float, full: Mask) -> HeldForce | None:
        """Force where more cells than those with voids cavitate; None if voids lie outside."""
        place, following = self._place(gap, speed)
        if not place >= 0.0 or following >= len(self._full):
            return None
        if (self._full[following] & ~full).any():
            return None
        force, by_speed = float(self._force(place)), float(self._slope(place)) / speed
        area = float(self._areas(place))
        return HeldForce(force, -3.0 * by_speed * speed / gap, by_speed, area)

    def full_at(self, gap: float, speed: float) -> Mask:
        """Cells without a cavity, about, at a gap [m] and a speed [m/s]."""
        return self._full[min(self._place(gap, speed)[1], len(self._full) - 1)]


def void_of(grid: FaceGrid, state: GridFilmState) -> Mask:
    """Cells at the pressure of the cavity."""
    floor = state.film.floor
    found: Mask = grid.face.loaded & (state.pressure <= floor * (1.0 - 1e-12))
    return found


def inflow_of(grid: FaceGrid, film: GridFilm, gap: float) -> float:
    """Growth [m/s] that the fastest inflow of a cell could fill, at the widest gap."""
    face = grid.face
    highest = gap + float(grid.relief[face.loaded].max())
    conductance = highest**3 / (12.0 * film.viscosity)
    size = min(face.pixel_size)
    return conductance * film.drop / (_NEAREST * size * size)
