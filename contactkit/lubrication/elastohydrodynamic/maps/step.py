r"""One implicit Euler stage of a wet map: semismooth Newton, GMRES without a matrix of the bodies.

Rows are gaps, so that all errors are: :math:`h - m_0 + \tau/A\,L(h) p = 0` in cells that are full,
:math:`h - h_c = 0` in contacts, whose film row has :math:`h = h_c`, and, where forces are imposed,
their balance over the force that one unit of the rigid gap causes. In cavities the pressure is
known and the content follows. The sets change with each iteration, all together: exchanging
pressures and gaps between a film and an elastic solver diverges from beta of 0.01 on.

The content at the end is that of the flow, in full cells too, where it is the gap up to the
tolerance: so liquid is conserved to round-off, and what a step leaves is mended by the next.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.sparse.linalg import LinearOperator, gcrotmk

from ....errors import ConvergenceError
from ..drive import Driven, Imposed
from ..step import StepFailedError
from ..wet_gap import Sets
from .flow import Flow, FlowSlopes
from .preconditioner import LocalCompliance, Preconditioner, inertia, preconditioner
from .wet_map import MapFields, WetMap

__all__ = ["MapStepped", "step"]

Array = NDArray[np.float64]

_SOLVED = 1e-8  # rows, over the gap that the step changes or a tenth of the smallest gap
_LEAST = 0.1  # of the smallest gap
# Round-off: rows this small that an iteration does not halve are solved.
_STALLED = 1e-5
_MOST = 60  # Newton iterations; 3 to 4 are usual, 7 the most where many cells change sets
# Iterations that change no fewer cells than before, after which one cell changes sets at a time,
# that of the lowest number: a few contacts at the edge of a cavity may otherwise open and close in
# turn without end (Murty's rule, which ends for matrices of positive principal minors).
_TOGETHER = 8
_DIVERGED = 1e3  # rows of an iterate whose sets are given up
# Rows at which they then do not: where a force is reversed all that touched has the cut-off but for
# what the rows leave.
_SLACK = 10.0
# Least and most of the accuracy of a linear system: three iterations of 1e-3 reach 1e-8; 1e-2 takes
# four, 1e-5 saves none.
_LINEAR, _ROUGH = 1e-3, 1e-1
_AT_ONCE = 2e-4  # what one iteration can be asked for
_MARGIN = 0.7
_MOST_LINEAR = 120
_POOR = 30  # iterations beyond which factors take the place of multigrid
# A gap may shrink to this part of itself in an iteration, where nothing can touch.
_LEAST_GAP = 0.1


class MapStepped(NamedTuple):
    """End of a stage, its film, and the iterations of GMRES in each of Newton's."""

    fields: MapFields
    sets: Sets
    flow: Flow
    linear: tuple[int, ...]


def step(
    wet: WetMap,
    local: LocalCompliance,
    start: MapFields,
    guess: tuple[MapFields, Sets],
    time: float,
    length: float,
) -> MapStepped:
    """Solve an implicit Euler stage.

    Parameters
    ----------
    wet : WetMap
        The bodies.
    local : LocalCompliance
        Of the same bodies.
    start : MapFields
        Content, rigid gap and speed that the stage starts from.
    guess : tuple of MapFields and Sets
        Where the iteration starts.
    time : float
        Time at the end [s].
    length : float
        Length of the stage [s].

    Raises
    ------
    StepFailedError
        If the iteration does not converge, or a gap closes where nothing can touch.
    """
    newton = _Newton(wet, local, start, guess, time, length)
    newton.solve()
    return MapStepped(newton.ended(), newton.sets, newton.flow, tuple(newton.linear))


class _Newton:
    """State of the iteration."""

    def __init__(
        self,
        wet: WetMap,
        local: LocalCompliance,
        start: MapFields,
        guess: tuple[MapFields, Sets],
        time: float,
        length: float,
    ) -> None:
        self.wet, self.local, self.start = wet, local, start
        self.time, self.length = time, length
        now, self.sets = guess
        self.pressure, self.total, self.rigid_gap = now.pressure, now.total, now.rigid_gap
        self.moves = isinstance(wet.drive, Driven)
        if isinstance(wet.drive, Imposed):
            self.rigid_gap = wet.drive.gap(time)
        self.prepared: Preconditioner | None = None
        self.linear: list[int] = []
        self.slack = 0.0
        self.storing = length / wet.storage
        self._settle()

    def _settle(self) -> None:
        """Pressures that obey the sets, and all that follows from them."""
        wet, sets = self.wet, self.sets
        self.pressure = np.where(sets.void, wet.floor, self.pressure)
        self.total = np.where(sets.contact, self.total, self.pressure)
        shape = wet.of_map(wet.shape)
        self.gap = self.rigid_gap + shape + wet.displacement(self.total)
        if not wet.cutoff and not (self.gap > 0.0).all():
            raise StepFailedError("a gap closes")
        self.height, self.follows = wet.conducting(self.gap, sets)
        self.flow: Flow = wet.flow(self.height)
        self.stored = self.start.content - self.storing * self.flow.out(self.pressure)
        # Of the full film: the gap, or the cut-off in contacts.
        self.held = np.where(sets.contact, wet.cutoff, self.gap)

    def solve(self) -> None:
        before = np.inf
        moved = abs(self.rigid_gap - self.start.rigid_gap)
        is_solved, first, last_together, fewest = False, self._iterate, _TOGETHER, np.inf
        for count in range(_MOST):
            together = count <= last_together
            changed = 0
            if count > 0 and (together or is_solved):
                changed = self._update_sets(together)
            if together and 0 < changed < fewest:
                fewest, last_together = changed, count + _TOGETHER
            least = max(self.wet.cutoff, float(self.held.min()))
            rows = self._rows()
            scale = max(moved, _LEAST * least)
            size, self.slack = float(np.abs(rows).max()) / scale, _SLACK * _SOLVED * scale
            is_solved = size < _SOLVED or (size < _STALLED and size > 0.5 * before)
            settled = not changed and (together or not self._violated(strictly=False)[1])
            if count > 0 and settled and is_solved:
                return
            if self.moves and together and count > 1 and size > _DIVERGED:
                # Sets that changed too many cells at once: from the start again, one at a time.
                self._iterate, last_together, before = first, count, np.inf
                self._settle()
                continue
            before = np.inf if changed else size
            self._correct(rows, _SOLVED / max(size, _SOLVED))
        raise StepFailedError(f"not converged: rows of {size:.1e}")

    @property
    def _iterate(self) -> tuple[Array, Array, float, Sets]:
        """Unknowns and sets of now."""
        return self.pressure, self.total, self.rigid_gap, self.sets

    @_iterate.setter
    def _iterate(self, given: tuple[Array, Array, float, Sets]) -> None:
        self.pressure, self.total, self.rigid_gap, self.sets = given

    def _rows(self) -> Array:
        film = np.where(self.sets.void, 0.0, self.held - self.stored)
        contact = (self.gap - self.wet.cutoff)[self.sets.contact]
        return np.concatenate([film, contact, self._motion()])

    def _motion(self) -> Array:
        """Unbalanced force over the force per rigid gap [m]; nothing of an imposed gap."""
        drive = self.wet.drive
        if not isinstance(drive, Driven):
            return np.zeros(0)
        inverse = self._inverse()
        speed = (self.rigid_gap - self.start.rigid_gap) / self.length
        gained = drive.mass * (speed - self.start.speed) / self.length
        spring = drive.stiffness * (drive.spring_end(self.time) - self.rigid_gap)
        force = drive.force(self.time) + spring + self.wet.thrust(self.total)
        return np.array([(gained - force) * inverse.motion / self.wet.cell_area])

    def _inverse(self) -> Preconditioner:
        """Approximate inverse for the sets of now."""
        is_poor = bool(self.linear) and self.linear[-1] > _POOR
        known, is_exact = self.prepared, is_poor
        if known is not None:
            same = all(np.array_equal(a, b) for a, b in zip(known.sets, self.sets, strict=True))
            if same and (known.is_exact or not is_poor):
                return known
            is_exact |= known.is_exact
        try:
            self.prepared = preconditioner(
                self.wet,
                self.local,
                self.flow,
                self.height,
                self.sets,
                self.length,
                is_exact=is_exact,
            )
        except ConvergenceError as error:
            raise StepFailedError(str(error)) from error
        return self.prepared

    def _correct(self, rows: Array, wanted: float) -> None:
        inverse = self._inverse()
        found = self._solved(self._product(inverse), rows, inverse, _accuracy(wanted))
        if not np.isfinite(found).all():
            raise StepFailedError("singular")
        pressure, total, moved = self.changes(found)
        scale = 1.0
        if not self.wet.cutoff:
            change = moved + self.wet.rough_displacement(total)
            closing = change < 0.0
            room = (1.0 - _LEAST_GAP) * self.gap[closing] / -change[closing]
            scale = min(1.0, float(room.min(initial=1.0)))
        self.pressure = self.pressure + scale * pressure
        self.total = self.total + scale * total
        self.rigid_gap += scale * moved
        self._settle()

    def _solved(
        self, apply: _Product, rows: Array, inverse: Preconditioner, accuracy: float
    ) -> Array:
        """Correction by GMRES, preconditioned from the right: it minimises the rows themselves."""
        shape, count = (rows.size, rows.size), len(self.linear)
        self.linear.append(0)

        def product(x: Array) -> Array:
            self.linear[count] += 1
            return apply(x)

        # Without its recycling it is GMRES that keeps what the preconditioner gave: `gmres` would
        # take a product and an inverse more, a fifth of the time.
        found, _ = gcrotmk(
            LinearOperator(shape, product, dtype=np.float64),
            -rows,
            rtol=accuracy,
            atol=0.0,
            m=_MOST_LINEAR,
            k=0,
            maxiter=1,
            M=LinearOperator(shape, inverse, dtype=np.float64),
        )
        if not found.any() and rows.any():
            raise StepFailedError("singular")
        return found

    def changes(self, x: Array) -> tuple[Array, Array, float]:
        """Changes of film pressures, of the pressures on the bodies, and of the rigid gap."""
        n, (void, contact) = len(self.gap), self.sets
        pressure = x[:n]
        if void.any():
            pressure = np.where(void, 0.0, pressure)
        total = pressure
        if contact.any():
            total = pressure.copy()
            total[contact] = x[n : n + int(contact.sum())]
        return pressure, total, float(x[-1]) if self.moves else 0.0

    def _product(self, inverse: Preconditioner) -> _Product:
        slopes = FlowSlopes(self.flow, self.height, self.pressure)
        return _Product(self, slopes, inverse)

    def _violated(self, *, strictly: bool) -> tuple[Sets, list[int]]:
        """Sets that the fields ask for, and the cells that are in others.

        Gaps may be a slack off: contacts within a cavity hold what the cut-off holds and have its
        pressure, and would be filled and emptied by round-off in turn. Pressures may, unless
        strictly, by what moves one cell by as much.
        """
        wet, sets = self.wet, self.sets
        void, contact = sets
        less = 0.0 if strictly or not self.slack else self.slack / self.local.of_cell
        if wet.floor > -np.inf:
            is_full = self.stored >= self.held + self.slack
            void = np.where(sets.void, ~is_full, self.pressure < wet.floor - less)
        if wet.cutoff:
            is_pressed = self.total > self.pressure - less
            contact = np.where(sets.contact, is_pressed, self.gap < wet.cutoff - self.slack)
        differ = (void != sets.void) | (contact != sets.contact)
        return Sets(void, contact), np.flatnonzero(differ).tolist()

    def _update_sets(self, together: bool) -> int:
        """Change the sets where their conditions fail, or in one cell alone; how many did."""
        new, cells = self._violated(strictly=together)
        if not cells:
            return 0
        if not together:
            void, contact = self.sets.void.copy(), self.sets.contact.copy()
            void[cells[0]], contact[cells[0]] = new.void[cells[0]], new.contact[cells[0]]
            new = Sets(void, contact)
        self.sets = new
        self._settle()
        return len(cells)

    def ended(self) -> MapFields:
        speed = (self.rigid_gap - self.start.rigid_gap) / self.length
        return MapFields(self.pressure, self.stored, self.total, self.rigid_gap, speed)


def _accuracy(wanted: float) -> float:
    """Of a linear system, of rows that are to shrink to some part: at once, or in two iterations.

    More at once would be lost in what is not linear.
    """
    wanted *= _MARGIN
    if wanted > _AT_ONCE:
        return min(wanted, _ROUGH)
    return max(math.sqrt(wanted), _LINEAR)


class _Product:
    """Product of the whole slope matrix with changes of the unknowns."""

    def __init__(self, newton: _Newton, slopes: FlowSlopes, inverse: Preconditioner) -> None:
        self.newton, self.slopes, self.inverse = newton, slopes, inverse
        self.has_voids = bool(newton.sets.void.any())
        self.has_contacts = bool(newton.sets.contact.any())
        self.follow = bool(newton.follows.all())

    def __call__(self, x: Array) -> Array:
        newton, wet = self.newton, self.newton.wet
        pressure, total, moved = newton.changes(x)
        opened = wet.rough_displacement(total)
        if newton.moves:
            opened += moved
        n, sets = len(opened), newton.sets
        found = np.empty(len(x))
        widened = opened if self.follow else np.where(newton.follows, opened, 0.0)
        film = self.slopes(pressure, widened)
        film *= newton.storing
        film += np.where(sets.contact, 0.0, opened) if self.has_contacts else opened
        found[:n] = np.where(sets.void, x[:n], film) if self.has_voids else film
        if self.has_contacts:
            found[n : n + int(sets.contact.sum())] = opened[sets.contact]
        if newton.moves:
            drive = wet.drive
            assert isinstance(drive, Driven)
            force = inertia(drive, newton.length) * moved - wet.thrust(total)
            found[-1] = force * self.inverse.motion / wet.cell_area
        return found
