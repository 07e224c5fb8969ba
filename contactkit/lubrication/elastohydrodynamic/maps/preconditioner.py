r"""Approximate inverse of a step: multigrid of the film with a local compliance of the bodies.

A thin film gives way to short waves only together with the bodies, a thick one does alone. At the
wavenumber

.. math:: \frac{q^2}{C(q)} = \frac{12 \eta}{h^3 \tau}

of a cell and a step :math:`\tau` the film is as stiff as the bodies; its compliance C(q) stands for
theirs, so that what is left of the matrix :math:`L + (A/\tau)\,C` has five points. On half-spaces
:math:`q = (24 \eta/(E^* h^3 \tau))^{1/3}`. One q for all cells needs up to four times the
iterations, the film alone ten times (rough sphere, beta from 1e-3 to 1e3). Of that matrix one cycle
of multigrid is as good an inverse as its factors but for one or two iterations, which it takes a
fifth of the time for on 512 x 512 cells, without their making.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from attrs import field, frozen
from numpy.typing import NDArray

from ....errors import ConvergenceError
from ...reynolds.linear_systems import factorised
from ..drive import Driven
from ..wet_gap import Sets
from .flow import Flow
from .multigrid import Multigrid
from .wet_map import WetMap

__all__ = ["LocalCompliance", "Preconditioner", "preconditioner"]

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]
_Solve = Callable[[Array], Array]

# Of the highest wavenumber pi/dx of a grid: what a single cell in contact gives way.
_SHORTEST = 0.8
_FEW = 3000  # cells up to which factors take no more time than multigrid
_SAMPLES = 64  # wavenumbers of the table, between which compliances are interpolated


@frozen(eq=False)
class LocalCompliance:
    """Compliance of the bodies at the wavenumber at which a film is as stiff as they are."""

    wet: WetMap
    _log_ratio: Array = field(init=False)
    _compliance: Array = field(init=False)

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
    of_cell: float
    rigid: Array
    pressed: float
    motion: float
    is_exact: bool

    def __call__(self, rows: Array) -> Array:
        """Changes of the unknowns that nearly cancel some rows."""
        n, k = len(self.rigid), int(self.sets.contact.sum())
        found = np.empty_like(rows)
        found[:n] = self.solve(rows[:n])
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


def preconditioner(
    wet: WetMap,
    local: LocalCompliance,
    flow: Flow,
    gap: Array,
    sets: Sets,
    length: float,
    *,
    is_exact: bool = False,
) -> Preconditioner:
    """Prepare multigrid for the film of a gap and a step of a length, or its factors.

    Raises
    ------
    ConvergenceError
        If bodies that are rigid touch, or enclose liquid that has no way to a reservoir.
    """
    if sets.contact.any() and not local.of_face:
        raise ConvergenceError("bodies that touch must deform: those here are rigid")
    alone = ~sets.contact
    springs = np.where(alone, wet.storage / length * local.at(gap, length), 0.0)
    is_exact |= wet.mesh.size <= _FEW
    solve = (
        _factors(wet, gap, springs, sets.void, length)
        if is_exact
        else _multigrid(wet, flow, springs, sets.void, length)
    )
    rigid: Array = np.zeros(len(alone))
    pressed = motion = 0.0
    if isinstance(wet.drive, Driven):
        rigid = np.where(sets.void, 0.0, solve(np.where(alone & ~sets.void, 1.0, 0.0)))
        if sets.contact.any():
            pressed = 1.0 / local.of_face
        force = float(rigid[alone].sum()) + int(sets.contact.sum()) * pressed
        motion = wet.cell_area / (inertia(wet.drive, length) + wet.cell_area * force)
    return Preconditioner(solve, sets, local.of_cell, rigid, pressed, motion, is_exact)


def _multigrid(wet: WetMap, flow: Flow, springs: Array, void: Mask, length: float) -> _Solve:
    """One cycle for the cells that are full; in cavities unknowns are rows."""
    window, (ny, nx) = wet.sides.window, wet.sides.window.shape
    weight, has_voids = wet.storage / length, bool(void.any())
    taken_in, outlets = window.spread(springs), np.array(window.spread(flow.rim[0]))
    between = [np.zeros(window.size), np.zeros(window.size)]
    empty = window.spread(void) if has_voids else void
    for found, (conductance, step) in zip(between, flow.each(), strict=True):
        found[:-step] = conductance
        if has_voids:
            # Cavities are outlets, and are left out themselves.
            lost = np.where(empty[:-step] | empty[step:], conductance, 0.0)
            found[:-step] -= lost
            outlets[:-step] += lost
            outlets[step:] += lost
    if has_voids:
        weight, taken_in, outlets = (
            np.where(out, 0.0, one)
            for out, one in ((void, weight), (empty, taken_in), (empty, outlets))
        )
    along_x, along_y, taken_in, outlets = (
        one.reshape(ny, nx) for one in (*between, taken_in, outlets)
    )
    cycle = Multigrid(along_x[:, :-1], along_y[:-1], taken_in, outlets)
    # Rows are of the size of 1 or less, and so are the weights: the range of single precision.
    unit = float(weight.max()) or 1.0
    weight, factor = weight / unit, unit / cycle.unit
    right = np.zeros((ny, nx), np.float32)

    def solve(rows: Array) -> Array:
        right.ravel()[window.place] = weight * rows
        found = np.multiply(cycle(right).ravel()[window.place], factor, dtype=np.float64)
        return np.where(void, rows, found) if has_voids else found

    return solve


def _factors(wet: WetMap, gap: Array, springs: Array, void: Mask, length: float) -> _Solve:
    """Factors in place of a cycle, where that is too poor an inverse."""
    from scipy.sparse import diags_array

    cells = np.flatnonzero(~void)
    if not cells.size:
        return np.copy
    weight = wet.storage[cells] / length
    inverse = factorised((wet.matrix(gap) + diags_array(springs)).tocsc()[cells][:, cells])

    def solve(rows: Array) -> Array:
        found = rows.copy()
        found[cells] = inverse(weight * rows[cells])
        return found

    return solve


def inertia(drive: Driven, length: float) -> float:
    """Force per change of the rigid gap in a step, of a mass and a spring [N/m]."""
    return drive.mass / length**2 + drive.stiffness
