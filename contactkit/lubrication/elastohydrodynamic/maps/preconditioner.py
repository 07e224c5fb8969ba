r"""Approximate inverse of a step: sparse factors of the film with a local compliance of the bodies.

A thin film gives way to short waves only together with the bodies, a thick one does alone. At the
wavenumber

.. math:: \frac{q^2}{C(q)} = \frac{12 \eta}{h^3 \tau}

of a cell and a step :math:`\tau` the film is as stiff as the bodies; its compliance C(q) stands for
theirs, so that what is left of the matrix :math:`L + (A/\tau)\,C` is sparse. On half-spaces
:math:`q = (24 \eta/(E^* h^3 \tau))^{1/3}`. One q for all cells needs up to four times the
iterations, the film alone ten times (rough sphere, beta from 1e-3 to 1e3).
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from attrs import field, frozen
from numpy.typing import NDArray

from ....errors import ConvergenceError
from ...reynolds.discretisation import assembled
from ...reynolds.linear_systems import approximate_factors, minimum_degree
from ..drive import Driven
from ..wet_gap import Sets
from .wet_map import Flow, WetMap

__all__ = ["LocalCompliance", "Preconditioner", "preconditioner"]

Array = NDArray[np.float64]

# Of the highest wavenumber pi/dx of a grid: what a single cell in contact gives way.
_SHORTEST = 0.8
_SAMPLES = 64  # wavenumbers of the table, between which compliances are interpolated


@frozen(eq=False)
class LocalCompliance:
    """Compliance of the bodies at the wavenumber at which a film is as stiff as they are."""

    wet: WetMap
    order: NDArray[np.int64] = field(init=False)
    """Order in which the cells are eliminated."""
    _log_ratio: Array = field(init=False)
    _compliance: Array = field(init=False)

    @order.default
    def _order(self) -> NDArray[np.int64]:
        known, mesh = self.wet.face.__dict__, self.wet.mesh
        if "_order" not in known:  # of all phases of a motion
            inner, outer = mesh.sides.geometry, mesh.rim.geometry
            known["_order"] = minimum_degree(assembled(mesh, [inner, inner, -inner, -inner, outer]))
        return np.asarray(known["_order"])

    def __attrs_post_init__(self) -> None:
        (ny, nx), (dy, dx) = self.wet.face.shape, self.wet.face.pixel_size
        lowest, highest = 2.0 / max(ny * dy, nx * dx), _SHORTEST * np.pi / max(dy, dx)
        q = np.geomspace(lowest, max(highest, 1.01 * lowest), _SAMPLES)
        compliance = self.wet.deformation.at_wavenumber(q)
        with np.errstate(divide="ignore"):
            ratio = 2.0 * np.log(q) - np.log(compliance)
        object.__setattr__(self, "_compliance", compliance)
        # Constant for long waves of thin incompressible layers, which flow as films do.
        object.__setattr__(self, "_log_ratio", np.maximum.accumulate(ratio))

    @property
    def of_cell(self) -> float:
        """Of the shortest waves [m/Pa]."""
        return float(self._compliance[-1])

    @property
    def of_face(self) -> float:
        """Of the longest waves [m/Pa]."""
        return float(self._compliance[0])

    def at(self, gap: Array, length: float) -> Array:
        """Of cells with a gap [m], for a step of a length [s]; shape (n,) [m/Pa]."""
        if not self.of_face:
            return np.zeros_like(gap)
        asked = np.log(12.0 * self.wet.viscosity / (gap**3 * length))
        return np.interp(asked, self._log_ratio, self._compliance)


@frozen(eq=False)
class Preconditioner:
    """Approximate inverse for the cells that conduct and those in contact, and for the motion.

    Unknowns are changes of film pressures (n,), of the pressures of contacts (k,), and of the rigid
    gap if a force is imposed; rows are in [m].
    """

    solve: Callable[[Array], Array]
    sets: Sets
    length: float
    weight: Array
    of_cell: float
    rigid: Array
    pressed: float
    motion: float
    in_double: bool

    def __call__(self, rows: Array) -> Array:
        """Changes of the unknowns that nearly cancel some rows."""
        n, k = len(self.weight), int(self.sets.contact.sum())
        found = np.empty_like(rows)
        found[:n] = self._film(rows[:n])
        found[n : n + k] = rows[n : n + k] / self.of_cell
        if len(rows) == n + k:
            return found
        alone = ~self.sets.contact
        force = float(found[:n][alone].sum() + found[n : n + k].sum())
        moved = rows[-1] + self.motion * force
        found[:n] -= moved * self.rigid
        found[n : n + k] -= moved * self.pressed
        found[-1] = moved
        return found

    def _film(self, rows: Array) -> Array:
        return np.where(self.sets.void, rows, self.solve(self.weight * rows))


def preconditioner(
    wet: WetMap,
    local: LocalCompliance,
    flow: Flow,
    gap: Array,
    sets: Sets,
    length: float,
    *,
    in_double: bool = False,
) -> Preconditioner:
    """Factorise the film of a gap for a step of a length, in single precision or in double.

    Raises
    ------
    ConvergenceError
        If bodies that are rigid touch, or enclose liquid that has no way to a reservoir.
    """
    from scipy.sparse import diags_array

    if sets.contact.any() and not local.of_face:
        raise ConvergenceError("bodies that touch must deform: those here are rigid")
    full, alone = ~sets.void, ~sets.contact
    weight = wet.storage / length
    springs = np.where(alone, weight * local.at(gap, length), 0.0)
    kept = local.order[full[local.order]]
    solve = approximate_factors(flow.matrix + diags_array(springs), kept, in_double=in_double)
    rigid: Array = np.zeros(len(full))
    pressed = motion = 0.0
    if isinstance(wet.drive, Driven):
        rigid = solve(weight * alone)
        if sets.contact.any():
            pressed = 1.0 / local.of_face
        force = float(rigid[alone].sum()) + int(sets.contact.sum()) * pressed
        motion = wet.cell_area / (inertia(wet.drive, length) + wet.cell_area * force)
    return Preconditioner(
        solve, sets, length, weight, local.of_cell, rigid, pressed, motion, in_double
    )


def inertia(drive: Driven, length: float) -> float:
    """Force per change of the rigid gap in a step, of a mass and a spring [N/m]."""
    return drive.mass / length**2 + drive.stiffness
