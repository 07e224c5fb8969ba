r"""Film, solid contact and motion of two deforming bodies on a grid, in SI units.

With the film pressure p, the pressure of the solids p_c where they touch, their sum P, the gap h
and the liquid per area m, all above ambient:

.. math::
    h &= z + s(x, y) + C * P \\
    \dot m &= \nabla \cdot \left( \frac{h^3}{12 \eta} \nabla p \right) \\
    0 &\le p - p_f \perp h - m \ge 0, \qquad 0 \le P - p \perp h - h_c \ge 0

What lies below the cut-off h_c of a contact conducts liquid as a film of h_c does, so that film and
solids each have a pressure there: liquid under pressure lifts a contact, suction closes it. The rim
is flooded. Cells are the finite volumes of :mod:`...reynolds.discretisation`; a cell at the rim
stores liquid up to halfway to the rim, which makes the scheme second order.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, NamedTuple, Protocol

import numpy as np
from attrs import field, frozen
from numpy.typing import NDArray

from ....errors import DescriptionError
from ...reynolds.discretisation import untied_mesh
from ...reynolds.face import Face
from ...reynolds.mesh import Mesh
from ..drive import Drive
from ..wet_gap import Sets
from .flow import Flow, Sides

__all__ = ["Deformation", "MapFields", "Rigid", "WetMap", "at_rest"]

Array = NDArray[np.float64]


class Deformation(Protocol):
    """Elastic bodies, such as `contactkit.elasticity.isolated_map.IsolatedMap`."""

    def displacement(self, pressure: Array) -> Array:
        """Displacement [m] by a map of pressures [Pa], of the cells that hold film."""

    def rough_displacement(self, pressure: Array) -> Array:
        """Displacement right to some 1e-6 of its largest, for corrections."""

    def at_wavenumber(self, wavenumber: Array) -> Array:
        """Displacement per pressure [m/Pa] of waves [1/m]."""


class Rigid:
    """Bodies that do not deform."""

    def displacement(self, pressure: Array) -> Array:
        """Zero."""
        return np.zeros_like(pressure)

    rough_displacement = displacement

    def at_wavenumber(self, wavenumber: Array) -> Array:
        """Zero."""
        return np.zeros_like(wavenumber)


class MapFields(NamedTuple):
    """State of the cells of film, in the order of the map, and of the motion.

    Film pressure p [Pa], liquid per area m [m], pressure P on the bodies [Pa], shapes (n,); rigid
    gap z [m] and its rate [m/s].
    """

    pressure: Array
    content: Array
    total: Array
    rigid_gap: float
    speed: float


@frozen(eq=False)
class WetMap:
    """Two bodies with a film on a grid between them.

    Parameters
    ----------
    face : Face
        Cells of film and what is around them; a reservoir has its pressure above ambient. Without
        pockets.
    shape : ndarray, shape (ny, nx)
        Gap of the undeformed bodies less their rigid gap [m].
    viscosity : float
        [Pa.s]
    deformation : Deformation
        Displacement of both bodies by the pressures of the cells.
    drive : Imposed or Driven
        What moves the bodies.
    floor : float
        Pressure of a cavity above ambient [Pa]; -inf: none opens.
    cutoff : float
        Gap at which asperities touch [m]; 0: none do.

    Raises
    ------
    DescriptionError
        If the face has pockets, or is periodic.
    """

    face: Face
    shape: Array = field(repr=False)
    viscosity: float
    deformation: Deformation
    drive: Drive
    floor: float = -math.inf
    cutoff: float = 0.0
    mesh: Mesh = field(init=False, repr=False)
    storage: Array = field(init=False, repr=False)
    sides: Sides = field(init=False, repr=False)

    @mesh.default
    def _mesh(self) -> Mesh:
        if self.face.pockets:
            cure = "make them holes at a pressure, or take GridFilm with rigid bodies"
            raise DescriptionError(
                "WetMap.face", f"{len(self.face.pockets)} pockets", "have none", hint=cure
            )
        if any(self.face.periodic):
            raise DescriptionError("WetMap.face", "periodic", "have a rim on all sides")
        return untied_mesh(self.face)

    @sides.default
    def _sides(self) -> Sides:
        known = self.face.__dict__
        if "_film_sides" not in known:  # of all phases of a motion
            known["_film_sides"] = Sides(self.face, self.mesh)
        made: Sides = known["_film_sides"]
        return made

    @storage.default
    def _storage(self) -> Array:
        """Area of each cell that stores liquid [m2]: up to halfway to the rim."""
        mesh = self.mesh
        at_rim = mesh.number[mesh.rim.cell]
        excess = np.bincount(at_rim, weights=mesh.rim.excess, minlength=mesh.size)
        return np.asarray(mesh.area * (1.0 - excess))

    @property
    def cell_area(self) -> float:
        """Area on which the pressure of a cell acts [m2]."""
        return self.face.cell_area

    def on_map(self, values: Array, outside: float = 0.0) -> Array:
        """Map of values of the cells of film."""
        found = np.full(self.face.level.size, outside)
        found[self.mesh.loaded] = values
        return found.reshape(self.face.shape)

    def of_map(self, values: Array) -> Array:
        """Values of the cells of film."""
        return values.ravel()[self.mesh.loaded]

    def displacement(self, total: Array) -> Array:
        """Displacement of both bodies [m], shape (n,)."""
        return self._by(self.deformation.displacement, total)

    def rough_displacement(self, total: Array) -> Array:
        """Displacement right to some 1e-6 of its largest [m], shape (n,)."""
        return self._by(self.deformation.rough_displacement, total)

    def _by(self, deform: Callable[[Array], Array], total: Array) -> Array:
        window = self.sides.window
        found = deform(window.spread(total).reshape(window.shape))
        return window.gathered(found.ravel())

    def gap(self, now: MapFields) -> Array:
        """Gap of the deformed bodies [m], shape (n,)."""
        return now.rigid_gap + self.of_map(self.shape) + self.displacement(now.total)

    def thrust(self, pressure: Array) -> float:
        """Force of a pressure on the face [N]."""
        return float(pressure.sum()) * self.cell_area

    def volume(self, content: Array) -> float:
        """Volume of a liquid per area, or of a gap [m3]."""
        return float(self.storage @ content)

    def elastic_energy(self, now: MapFields) -> float:
        """Energy stored in the bodies [J]."""
        return 0.5 * self.thrust(now.total * self.displacement(now.total))

    def cavity_energy(self, now: MapFields, sets: Sets) -> float:
        """Work of opening the cavities against the ambient pressure [J]."""
        if not sets.void.any():
            return 0.0
        held = np.where(sets.contact, self.cutoff, self.gap(now))
        return -self.floor * self.volume(np.where(sets.void, held - now.content, 0.0))

    def conducting(self, gap: Array, sets: Sets) -> tuple[Array, NDArray[np.bool_]]:
        """Gap that conducts liquid [m], and where it follows that of the bodies."""
        if not self.cutoff:
            return gap, np.ones(len(gap), dtype=bool)
        above = (gap > self.cutoff) & ~sets.contact
        return np.where(above, gap, self.cutoff), above

    def flow(self, gap: Array) -> Flow:
        """Conductances of a gap."""
        return self.sides.flow(gap, self.viscosity)

    def matrix(self, gap: Array) -> Any:
        """Flow out of the cells by their pressures, sparse [m3/(Pa.s)]."""
        return self.sides.matrix(gap, self.viscosity)


def at_rest(wet: WetMap, rigid_gap: float) -> MapFields:
    """Fields of bodies at rest with a full film of ambient pressure.

    Raises
    ------
    DescriptionError
        If the gap is closed somewhere.
    """
    gap = rigid_gap + wet.of_map(wet.shape)
    if not gap.min() > 0.0:
        row, column = np.divmod(wet.mesh.loaded[gap.argmin()], wet.face.shape[1])
        place = f"{float(gap.min())!r} in row {row}, column {column}"
        cure = "start from a larger rigid gap, and press the bodies together from there"
        raise DescriptionError("gap", place, "be positive", unit="m", hint=cure)
    none = np.zeros(wet.mesh.size)
    return MapFields(none, gap, none, rigid_gap, 0.0)
