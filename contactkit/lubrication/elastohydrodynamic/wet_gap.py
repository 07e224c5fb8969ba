r"""Film, solid contact and motion of two deforming bodies as equations :math:`\dot Q + R = 0`.

In units in which the viscosity is 1, with the radius x, the film pressure p, the pressure of the
solids p_c where they touch, the gap h and the liquid per area m:

.. math::
    h &= z + s(x) + K (p + p_c) \\
    \dot m &= \frac{1}{12 x} \left( x\,h^3 p' \right)' \\
    0 &\le p - p_f \perp h - m \ge 0, \qquad 0 \le p_c \perp h - h_c \ge 0

The second line of conditions is the cavitation of Jakobsson, Floberg and Olsson, where p_f is the
pressure of a cavity, and the contact of asperities at a cut-off h_c: what lies below it still
conducts liquid as a film of h_c does, so that film and solids have a pressure of their own in a
contact. Which of each pair holds at a node is a set; Newton's method updates the sets with the
unknowns (a semismooth method).

The rim is flooded, or it is a meniscus that moves with the liquid, at :math:`p = -\gamma_c/h`,
where :math:`\gamma_c` is the surface tension times the sum of the cosines: the mesh then grows with
the radius a of the rim, and the volume of the liquid is constant.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from attrs import evolve, field, frozen
from numpy.typing import NDArray

from .drive import Drive, Imposed
from .mesh import RingMesh, Tridiagonal

__all__ = ["Fields", "Levels", "Sets", "WetGap", "at_rest"]

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

# Of the cut-off, below which an iterate's gap does not lower the conductance any more: solutions
# never lie there.
_LEAST_GAP = 0.25


class Fields(NamedTuple):
    """Unknowns at an instant.

    Film pressure, liquid per area and solid pressure at the nodes (n + 1,), rigid gap, its rate,
    radius of the rim over that of the mesh, its rate.
    """

    pressure: Array
    content: Array
    solid: Array
    rigid_gap: float
    speed: float
    rim: float = 1.0
    rim_speed: float = 0.0


class Sets(NamedTuple):
    """Nodes in a cavity, and nodes in contact."""

    void: Mask
    contact: Mask


class Levels(NamedTuple):
    """Values and slopes of one instant: Q, R, and their derivatives by the unknowns."""

    stored: Array
    rest: Array
    stored_slopes: Array
    rest_slopes: Array


@frozen(eq=False)
class WetGap:
    """Two bodies with a film between them, on rings.

    Parameters
    ----------
    mesh : RingMesh
        With a moving rim its last node is 1.
    shape : ndarray, shape (n + 1,)
        Gap of the undeformed bodies at the nodes, less that on the axis.
    compliance : ndarray, shape (n + 1, n + 1)
        Displacement at the nodes by the pressures there.
    drive : Imposed or Driven
        What moves the bodies.
    rim_pressure : float
        At a flooded rim.
    tension : float or None
        gamma_c of a moving rim; None: it is flooded.
    floor : float
        Pressure of a cavity; -inf: none opens.
    cutoff : float
        Gap at which asperities touch; 0: none do.
    """

    mesh: RingMesh
    shape: Array
    compliance: Array
    drive: Drive
    rim_pressure: float = 0.0
    tension: float | None = None
    floor: float = -math.inf
    cutoff: float = 0.0
    _carried: Tridiagonal = field(init=False)

    @_carried.default
    def _carried_slopes(self) -> Tridiagonal:
        return self.mesh.carried_slopes()

    def with_floor(self, floor: float) -> WetGap:
        """Return the same with another pressure of cavities."""
        return self if floor == self.floor else evolve(self, floor=floor)

    @property
    def moves(self) -> bool:
        """Whether the rim moves."""
        return self.tension is not None

    @property
    def stiffness(self) -> float:
        """Pressure over the displacement that it causes, of the softest mode."""
        softest = float(np.abs(self.compliance).sum(axis=1).max())
        return 1.0 / softest if softest > 0.0 else math.inf

    def displacement(self, now: Fields) -> Array:
        """Displacement of both bodies; that of half-spaces grows with the mesh."""
        return now.rim * (self.compliance @ (now.pressure + now.solid))

    def imposed(self, now: Fields, time: float) -> float:
        """Size of the forces on a mass from outside; 0 of an imposed gap.

        That of the film is negligible until a heavy mass moves, and until then no scale of errors.
        """
        drive = self.drive
        if isinstance(drive, Imposed):
            return 0.0
        spring = drive.stiffness * (drive.spring_end(time) - now.rigid_gap)
        return abs(drive.force(time)) + abs(spring)

    def gap(self, now: Fields) -> Array:
        """Gap of the deformed bodies."""
        return now.rigid_gap + now.rim**2 * self.shape + self.displacement(now)

    def thrust(self, pressure: Array, rim: float = 1.0) -> float:
        """Force of a pressure on the face."""
        return 2.0 * math.pi * rim**2 * float(self.mesh.areas @ pressure)

    def volume(self, content: Array, rim: float = 1.0) -> float:
        """Volume of a content, or of a gap."""
        return self.thrust(content, rim)

    def dissipation(self, now: Fields) -> float:
        """Power that the film dissipates."""
        flow, _, _ = self.mesh.conductance(self._conducting(self.gap(now)))
        return 2.0 * math.pi * float(flow @ np.diff(now.pressure) ** 2)

    def elastic_energy(self, now: Fields) -> float:
        """Energy stored in the bodies."""
        total = now.pressure + now.solid
        return 0.5 * self.thrust(total * self.displacement(now), now.rim)

    def _conducting(self, gap: Array) -> Array:
        return np.maximum(gap, _LEAST_GAP * self.cutoff) if self.cutoff else gap

    # Rows and columns: pressures (in cavities contents) of all nodes, solid pressures of those that
    # touch, rigid gap and speed, rim and its speed.

    def size(self, touching: NDArray[np.intp]) -> int:
        """Number of unknowns, of which the solid pressures at some nodes."""
        return len(self.shape) + len(touching) + 2 + 2 * self.moves

    def levels(
        self, now: Fields, sets: Sets, time: float, touching: NDArray[np.intp], *, slopes: bool
    ) -> Levels:
        """Q and R of an instant, and their slopes; those are empty where not asked for."""
        n, size = len(self.shape), self.size(touching)
        at = n + len(touching)
        h = self.gap(now)
        flow, by_left, by_right = self.mesh.conductance(self._conducting(h))
        stored, rest = np.zeros(size), np.zeros(size)
        stored[:n] = self.mesh.areas * now.rim**2 * now.content
        drop = now.pressure[:-1] - now.pressure[1:]
        rest[: n - 1] += flow * drop
        rest[1:n] -= flow * drop
        inside = sets.contact[touching]
        rest[n:at] = np.where(inside, h[touching] - self.cutoff, now.solid[touching])
        self._motion_rows(now, time, at, stored, rest)
        self._rim_rows(now, h, at, stored, rest)
        if not slopes:
            return Levels(stored, rest, stored[:0], rest[:0])
        film = (
            Tridiagonal.of_elements(flow, -flow, -flow, flow),
            Tridiagonal.of_elements(
                by_left * drop, by_right * drop, -by_left * drop, -by_right * drop
            ),
        )
        return Levels(stored, rest, *self._slopes(now, sets, touching, h, film))

    def _motion_rows(self, now: Fields, time: float, at: int, stored: Array, rest: Array) -> None:
        stored[at], rest[at] = now.rigid_gap, -now.speed
        if isinstance(self.drive, Imposed):
            rest[at + 1] = now.rigid_gap - self.drive.gap(time)
            return
        drive = self.drive
        spring = drive.stiffness * (drive.spring_end(time) - now.rigid_gap)
        stored[at + 1] = drive.mass * now.speed
        pressed = self.thrust(now.pressure + now.solid, now.rim)
        rest[at + 1] = -(pressed + drive.force(time) + spring)

    def _rim_rows(self, now: Fields, gap: Array, at: int, stored: Array, rest: Array) -> None:
        n = len(self.shape)
        if self.tension is None:
            stored[n - 1] = 0.0
            rest[n - 1] = now.pressure[-1] - self.rim_pressure
            return
        rest[:n] += now.rim * now.rim_speed * self.mesh.carried(now.content)
        rest[at + 2] = now.pressure[-1] * gap[-1] + self.tension
        stored[at + 3], rest[at + 3] = now.rim, -now.rim_speed

    def _slopes(
        self,
        now: Fields,
        sets: Sets,
        touching: NDArray[np.intp],
        gap: Array,
        film: tuple[Tridiagonal, Tridiagonal],
    ) -> tuple[Array, Array]:
        n, size = len(self.shape), self.size(touching)
        at = n + len(touching)
        pressed, widened = self._gap_slopes(now, sets, touching)
        full, void = ~sets.void, np.flatnonzero(sets.void)
        # Of the content: that of the gap where the film is full, itself in a cavity.
        content = widened * full[:, None]
        content[void, void] = 1.0
        by_pressure, by_gap = film
        if self.moves:
            carried = now.rim * now.rim_speed
            stored = self.mesh.areas[:, None] * now.rim**2 * content
            rest = by_gap.times(widened) + carried * self._carried.times(content)
        else:
            stored = self.mesh.areas[:, None] * content
            rest = by_gap.times(widened)
        rest[:, :n] += by_pressure.dense() * full
        Q, R = np.zeros((size, size)), np.zeros((size, size))
        Q[:n], R[:n] = stored, rest
        R[n:at] = np.where(sets.contact[touching, None], widened[touching], 0.0)
        free = n + np.flatnonzero(~sets.contact[touching])
        R[free, free] = 1.0
        self._motion_slopes(now, at, pressed, Q, R)
        self._rim_slopes(now, gap, at, widened, Q, R)
        return Q, R

    def _gap_slopes(
        self, now: Fields, sets: Sets, touching: NDArray[np.intp]
    ) -> tuple[Array, Array]:
        """Derivatives of the total pressure and of the gap by the unknowns, a row for each node."""
        n, size = len(self.shape), self.size(touching)
        at = n + len(touching)
        pressed = np.zeros((n, size))
        full = np.flatnonzero(~sets.void)
        pressed[full, full] = 1.0
        pressed[touching, n + np.arange(len(touching))] = 1.0
        widened = np.empty((n, size))
        widened[:, :n] = now.rim * self.compliance * ~sets.void
        widened[:, n:at] = now.rim * self.compliance[:, touching]
        widened[:, at:] = 0.0
        widened[:, at] = 1.0
        if self.moves:
            total = now.pressure + now.solid
            widened[:, at + 2] = 2.0 * now.rim * self.shape + self.compliance @ total
        return pressed, widened

    def _motion_slopes(self, now: Fields, at: int, pressed: Array, Q: Array, R: Array) -> None:
        Q[at, at], R[at, at + 1] = 1.0, -1.0
        if isinstance(self.drive, Imposed):
            R[at + 1, at] = 1.0
            return
        Q[at + 1, at + 1] = self.drive.mass
        R[at + 1] = -2.0 * math.pi * now.rim**2 * (self.mesh.areas @ pressed)
        R[at + 1, at] += self.drive.stiffness
        if self.moves:
            total = self.thrust(now.pressure + now.solid)
            R[at + 1, at + 2] -= 2.0 * now.rim * total

    def _rim_slopes(
        self, now: Fields, gap: Array, at: int, widened: Array, Q: Array, R: Array
    ) -> None:
        n = len(self.shape)
        if not self.moves:
            Q[n - 1], R[n - 1] = 0.0, 0.0
            R[n - 1, n - 1] = 1.0
            return
        Q[:n, at + 2] += 2.0 * now.rim * self.mesh.areas * now.content
        carried = self.mesh.carried(now.content)
        R[:n, at + 2] += now.rim_speed * carried
        R[:n, at + 3] += now.rim * carried
        R[at + 2] = now.pressure[-1] * widened[-1]
        R[at + 2, n - 1] += gap[-1]
        Q[at + 3, at + 2], R[at + 3, at + 3] = 1.0, -1.0


def at_rest(gap: WetGap, rigid_gap: float, pressure: Array | None = None) -> Fields:
    """Fields of bodies at rest with a full film, of no pressure or of a given one."""
    n = len(gap.shape)
    pressure = np.zeros(n) if pressure is None else pressure
    now = Fields(pressure, np.zeros(n), np.zeros(n), rigid_gap, 0.0)
    return now._replace(content=gap.gap(now))
