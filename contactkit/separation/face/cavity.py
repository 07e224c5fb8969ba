"""Cavity of a film on a face that is no disc, with the memory of its liquid on the grid.

Mass-conserving (Jakobsson, Floberg and Olsson): the thickness of the liquid in each cell is carried
from stage to stage by backward Euler; the force at a stage is that of the gap and the speed there,
with the voids that have formed until then. While a cavity grows, the force does not depend on the
memory, and has no error in time; while it fills, its error is of first order in the step, which the
same step without its inner stages measures.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from attrs import field, frozen

from ...lubrication.reynolds.film import GridFilm, GridFilmState
from ...lubrication.reynolds.solve import unchecked_step
from ...numerics.radau_tableau import NODES
from ..cavity.events import is_inception
from ..cavity.law import Place
from ..cavity.stages import CavityForce, ShownCavity
from ..cavity.state import FULL, Cavity, Phase
from .film import FaceFilm
from .grid import FaceGrid
from .held_voids import FirstOpening, HeldVoids, Nearby

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Map = NDArray[np.floating[Any]]

__all__ = ["FaceCavity", "FaceStages"]

_FILLED = 1e-9  # void over the film at which it counts as full
# Per step. A cavity that grows has kinks in its force, cell by cell, of about the error of the
# grid: below a tenth of that the steps would follow them.
_PER_STEP = 0.1
_SAME = 1e-3  # of the way of a step, within which the liquid that flows is the same
_INNER = 0.64  # error of three steps of backward Euler over their distance from a single one


class _Known(NamedTuple):
    """Voids at the stages of a step, which serve while an iteration moves its gaps little."""

    cavity: Cavity
    start: float
    dt: float
    gaps: tuple[float, ...]
    voids: tuple[HeldVoids, ...]
    last: GridFilmState
    error: float

    def serves(self, cavity: Cavity, start: float, dt: float, gaps: tuple[float, ...]) -> bool:
        """Whether it is of the same step, with gaps [m] nearly the same."""
        if cavity is not self.cavity or (start, dt) != (self.start, self.dt):
            return False
        moves = [abs(gap - known) for gap, known in zip(gaps, self.gaps, strict=True)]
        way = max(abs(gap - start) for gap in gaps)
        return max(moves) <= _SAME * way


class FaceStages(NamedTuple):
    """Liquid at the stages of a step, the forces there, and the error of the last void [-]."""

    state: GridFilmState
    """Film at the end of the step."""
    forces: tuple[CavityForce, CavityForce, CavityForce]
    error: float


@frozen(eq=False)
class FaceCavity:
    """Film on a face of any shape that cavitates.

    Parameters
    ----------
    film : FaceFilm
        The film while it is full.
    grid : FaceGrid
        The same on a grid.
    viscosity : float
        Viscosity of the liquid [Pa.s].
    strength : float
        Tension at which the full film cavitates [Pa], as a drop below ambient pressure.
    drop : float
        Ambient pressure less that in the cavity [Pa]; not above `strength`.
    film_rtol : float
        Error of the force that the grid leaves [-].
    """

    film: FaceFilm
    grid: FaceGrid
    viscosity: float
    strength: float
    drop: float
    film_rtol: float
    _liquid: GridFilm = field(init=False, repr=False)

    _opening: FirstOpening | None = field(init=False, repr=False)
    _last: list[_Known] = field(init=False, factory=list, repr=False)
    _nearby: Nearby = field(init=False, factory=Nearby, repr=False)

    @_liquid.default
    def _find_liquid(self) -> GridFilm:
        return GridFilm(face=self.grid.face, viscosity=self.viscosity, drop=self.drop)

    @_opening.default
    def _find_opening(self) -> FirstOpening | None:
        if not self.grid.is_even:
            return None
        return FirstOpening(self.grid, self._liquid, math.sqrt(self.grid.face.cell_area))

    def tension(self, gap: float, speed: float, void: float = 0.0) -> float:
        """See `Cavitation.tension`."""
        return self.viscosity * speed * self.film.onset(gap)

    def time_rtol(self, rtol: float) -> float:
        """See `Cavitation.time_rtol`."""
        return max(rtol, _PER_STEP * self.film_rtol)

    def inception(self, gap: float, speed: float) -> Cavity:
        """See `Cavitation.inception`: the first voids form in the step that follows."""
        return Cavity(Phase.RECEDING, liquid=_rows(self.grid.relief + gap))

    def held_force(self, cavity: Cavity, begin: Place) -> Callable[[float, float], CavityForce]:
        """See `Cavitation.held_force`."""
        return _as_forces(self._voids(np.array(cavity.liquid), begin[0]))

    def stages(
        self, cavity: Cavity, begin: Place, dt: float, places: Sequence[Place]
    ) -> FaceStages | None:
        """See `Cavitation.stages`."""
        gaps = tuple(gap for gap, _ in places)
        known = next((k for k in self._last if k.serves(cavity, begin[0], dt, gaps)), None)
        if known is None:
            known = self._stepped(cavity, begin[0], dt, gaps)
            self._last[:] = [known]
        one, two, three = (
            CavityForce(*voids(*place)[:3])
            for voids, place in zip(known.voids, places, strict=True)
        )
        return FaceStages(known.last, (one, two, three), known.error)

    def _stepped(self, cavity: Cavity, start: float, dt: float, gaps: tuple[float, ...]) -> _Known:
        """Liquid at the stages of a step of `dt` [s], from one gap [m] to others."""
        before = self._state(np.array(cavity.liquid), start)
        state, time, last, voids = before, 0.0, start, []
        for node, gap in zip(NODES, gaps, strict=True):
            state = self._after(state, last, gap, dt * (node - time))
            voids.append(self._voids(state.liquid_fraction * state.gap, gap))
            time, last = node, gap
        whole = self._after(before, start, gaps[2], dt).void_volume
        missed = _INNER * abs(state.void_volume - whole) / self._volume(gaps[2])
        error = self._as_of_the_method(missed)
        return _Known(cavity, start, dt, gaps, tuple(voids), state, error)

    def _after(self, state: GridFilmState, start: float, end: float, dt: float) -> GridFilmState:
        """Film after a step from one gap [m] to another in a time [s]."""
        guess = state.liquid_fraction >= 1.0
        if self._opening is not None:
            guess &= self._opening.full_at(end, (end - start) / dt)
        elif self._nearby.full is not None and end > start:
            guess &= self._nearby.full
        return unchecked_step(state, self.grid.relief + end, dt, full=guess)

    def _as_of_the_method(self, missed: float) -> float:
        """Error that shrinks with the step as that of Radau does: of second order in each step."""
        enough = _PER_STEP * self.film_rtol
        return enough * (missed / enough) ** 2

    def after_step(
        self, cavity: Cavity, solved: FaceStages, begin_gap: float, gaps: Sequence[float]
    ) -> Cavity:
        """See `Cavitation.after_step`: a film without voids is full, and has its strength again."""
        state, height = solved.state, self.grid.relief + gaps[2]
        # The last iteration of the motion may have moved the faces a little.
        liquid = np.where(state.liquid_fraction >= 1.0, height, state.liquid_fraction * state.gap)
        empty = (height - np.minimum(liquid, height))[self.grid.face.loaded]
        void, volume = float(empty.sum()) * self.grid.face.cell_area, self._volume(gaps[2])
        largest = max(cavity.largest, void)
        if void <= _FILLED * volume and largest > _FILLED * volume:
            return FULL
        return Cavity(Phase.RECEDING, void, void / volume, (), largest, _rows(liquid))

    def beyond_event(
        self,
        cavity: Cavity,
        solved: FaceStages | None,
        begin: Place,
        places: Sequence[Place],
    ) -> tuple[float, float]:
        """See `Cavitation.beyond_event`: that of a full film is its inception."""
        if solved is not None:
            return -1.0, -1.0
        highest = max(self.tension(*place) for place in places)
        return self.tension(*begin) / self.strength - 1.0, highest / self.strength - 1.0

    def after_event(self, cavity: Cavity, gap: float, speed: float) -> Cavity:
        """See `Cavitation.after_event`."""
        return self.inception(gap, speed) if cavity.phase is Phase.FULL else cavity

    def after_jump(self, cavity: Cavity, gap: float, speed: float) -> Cavity:
        """See `Cavitation.after_jump`."""
        return self.inception(gap, speed) if is_inception(self, cavity, gap, speed) else cavity

    def shown(self, cavity: Cavity, gap: float, speed: float) -> ShownCavity:
        """See `Cavitation.shown`: the radius is that of a disc of the area of the cavity."""
        found = self._voids(np.array(cavity.liquid), gap)(gap, speed)
        return ShownCavity(found.force, math.sqrt(found.cavity_area / math.pi), cavity.void)

    def _state(self, liquid: Map, gap: float) -> GridFilmState:
        """Film of a thickness of its liquid [m] at a gap [m]."""
        face, height = self.grid.face, self.grid.relief + gap
        return GridFilmState(
            film=self._liquid,
            gap=height,
            pressure=np.zeros(face.shape),
            liquid_fraction=np.where(face.loaded, np.minimum(liquid / height, 1.0), 1.0),
            beside_cavity=face.loaded,
        )

    def _voids(self, liquid: Map, gap: float) -> HeldVoids:
        """Film whose voids are those of a thickness of its liquid [m] at a gap [m]."""
        height = self.grid.relief + gap
        full = (liquid >= height * (1.0 - 1e-12)) | ~self.grid.face.loaded
        return HeldVoids(self.grid, self._liquid, full, self._opening, self._nearby)

    def _volume(self, gap: float) -> float:
        """Volume of the gap [m3]."""
        face = self.grid.face
        return float((self.grid.relief + gap)[face.loaded].sum()) * face.cell_area


def _as_forces(voids: HeldVoids) -> Callable[[float, float], CavityForce]:
    return lambda gap, speed: CavityForce(*voids(gap, speed)[:3])


def _rows(values: Map) -> tuple[tuple[float, ...], ...]:
    return tuple(map(tuple, values.tolist()))
