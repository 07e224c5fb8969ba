r"""Finite volumes of Reynolds' equation: conductances, transport by the walls, volume balance.

.. math:: \mathbf q = -\frac{h^3}{12 \eta} \nabla p + \frac{\mathbf U}{2} h \theta, \qquad
          \frac{\partial (\theta h)}{\partial t} + \nabla \cdot \mathbf q = 0

with U the sum of the tangential velocities of the walls. Per unknown, with q the pressure from
that of the reservoirs and s = 1 - theta the void fraction: ``L q - C s - source = -d(volume)/dt``.
The conductance between two cells is the harmonic mean of h^3/(12 eta), exact across a step of the
gap; transport is central where the film is full and upwind in the voids.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from ...errors import DescriptionError
from .mesh import Mesh, make_mesh, recesses

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from .face import Face

    Array = NDArray[np.floating[Any]]

__all__ = [
    "Balance",
    "assembled",
    "checked_gap",
    "conductances",
    "discretise",
    "mesh_of",
    "per_unknown",
    "untied_mesh",
]

Velocity = tuple[float, float]


class Balance(NamedTuple):
    """Volume balance of a film at one gap."""

    mesh: Mesh
    conductances: Any
    """L, sparse and symmetric, shape (n, n) [m3/(Pa.s)]."""
    transport: Any
    """C, sparse, of the voids; None without sliding [m3/s]."""
    source: Array
    """Inflow of a full film at q = 0, shape (n,) [m3/s]."""
    reference: float
    """Pressure that q is counted from [Pa]."""
    volume: Array
    """Volume that each unknown has for liquid, shape (n,) [m3]."""
    compliance: Array
    """Volume that each unknown takes in per pressure, shape (n,) [m3/Pa]."""
    inner: Array
    """Conductances of the sides between cells [m3/(Pa.s)]."""
    outer: Array
    """Conductances of the sides at the rim [m3/(Pa.s)]."""
    carried: tuple[Array, Array]
    """Flow that walls carry to higher coordinates through full sides, and at the rim [m3/s]."""


def checked_gap(face: Face, gap: ArrayLike) -> Array:
    """A gap as a map; refused unless it is positive in all cells that are not solid.

    Raises
    ------
    DescriptionError
        If the shape is not that of the grid, or a gap is not positive and finite.
    """
    given = np.asarray(gap, dtype=float)
    if given.shape not in ((), face.shape):
        expected = f"be one number or have the shape {face.shape} of the grid"
        raise DescriptionError("gap", given.shape, expected, unit="m")
    given = np.array(np.broadcast_to(given, face.shape))
    wrong = (face.owner > -2) & ~((given > 0.0) & (given < np.inf))
    if wrong.any():
        row, column = np.argwhere(wrong)[0]
        place = f"{float(given[row, column])!r} in row {row}, column {column}"
        cure = "outside the film it is the gap that liquid comes from; cells in contact are `solid`"
        raise DescriptionError("gap", place, "be positive and finite", unit="m", hint=cure)
    return given


def mesh_of(face: Face, gap: Array) -> Mesh:
    """Unknowns of a face under a gap; made once unless the gap has deep recesses."""
    tied = recesses(face, gap)
    if tied is not None:
        known = face.__dict__.get("_tied")
        if known is None or not np.array_equal(known[0], tied):
            known = face.__dict__["_tied"] = (tied, make_mesh(face, tied))
        with_recesses: Mesh = known[1]
        return with_recesses
    return untied_mesh(face)


def untied_mesh(face: Face) -> Mesh:
    """Unknowns of a face under a gap without deep recesses, one for each cell; made once."""
    if "_mesh" not in face.__dict__:
        face.__dict__["_mesh"] = make_mesh(face)
    made: Mesh = face.__dict__["_mesh"]
    return made


def per_unknown(mesh: Mesh, values: Array, area: float) -> Array:
    """Integral of a map over the cells of each unknown."""
    flat = values.ravel()[mesh.loaded]
    return np.bincount(mesh.number[mesh.loaded], weights=flat, minlength=mesh.size) * area


def discretise(
    face: Face,
    gap: Array,
    viscosity: float,
    velocity: Velocity = (0.0, 0.0),
    compressibility: float = 0.0,
) -> Balance:
    """Discretise Reynolds' equation.

    Parameters
    ----------
    face : Face
        The face.
    gap : ndarray, shape (ny, nx)
        Gap, positive [m].
    viscosity : float
        Dynamic viscosity [Pa.s].
    velocity : tuple of float
        Sum of the tangential velocities of the walls along x and y [m/s].
    compressibility : float
        Compressibility of the liquid in the gap [1/Pa].

    Examples
    --------
    >>> from contactkit.lubrication.reynolds.face import face_from_mask
    >>> face = face_from_mask(np.pad(np.ones((1, 3), bool), ((0, 0), (1, 1))), 1.0)
    >>> balance = discretise(face, np.ones(face.shape), 1.0 / 12.0)
    >>> balance.conductances.toarray()
    array([[ 3., -1.,  0.],
           [-1.,  2., -1.],
           [ 0., -1.,  3.]])
    """
    mesh = mesh_of(face, gap)
    height = gap.ravel()
    inner, outer = conductances(mesh, height**3 / (12.0 * viscosity))
    reference, beyond = _reservoirs(face, mesh)
    to_pocket = outer[mesh.rim_number >= 0]
    matrix = assembled(
        mesh, [inner, inner, -inner, -inner, outer, to_pocket, -to_pocket, -to_pocket]
    )
    to_reservoir = mesh.rim_number < 0
    inward = (outer * beyond)[to_reservoir]
    at_rim = mesh.number[mesh.rim.cell[to_reservoir]]
    source = np.bincount(at_rim, weights=inward, minlength=mesh.size).astype(float)
    carried = _carried(face, mesh, height, velocity)
    transport = None
    if any(velocity):
        transport, brought = _transport(mesh, carried)
        source = source + brought
    volume, compliance = _volumes(face, mesh, gap, compressibility)
    return Balance(
        mesh, matrix, transport, source, reference, volume, compliance, inner, outer, carried
    )


def _reservoirs(face: Face, mesh: Mesh) -> tuple[float, Array]:
    """Mean pressure of the reservoirs, and how much each side of the rim differs from it."""
    pressure = face.pressure.ravel()[mesh.rim.beyond]
    to_reservoir = mesh.rim_number < 0
    # Not counted from the cavity: a strong liquid would cost digits.
    reference = float(pressure[to_reservoir].mean()) if to_reservoir.any() else 0.0
    return reference, np.where(to_reservoir, pressure - reference, 0.0)


def conductances(mesh: Mesh, conductivity: Array) -> tuple[Array, Array]:
    """Conductances of the sides between cells, and at the rim [m3/(Pa.s)].

    Parameters
    ----------
    mesh : Mesh
        The mesh.
    conductivity : ndarray
        h^3/(12 eta) of every cell (flat) [m3/(Pa.s)].
    """
    a, b = conductivity[mesh.sides.low], conductivity[mesh.sides.high]
    # Halves of two cells in series: they carry one flow, also where the gap has a step between.
    # Up to the rim the gap is that of the cell alone.
    inner = mesh.sides.geometry * (2.0 * a * b / (a + b))
    return inner, mesh.rim.geometry * conductivity[mesh.rim.cell]


def assembled(mesh: Mesh, values: Sequence[Array]) -> Any:
    """Sparse matrix (CSR) of what the sides add to it.

    Parameters
    ----------
    mesh : Mesh
        The mesh.
    values : sequence of ndarray
        Of the sides between cells on the diagonals of their low and high cells, in the row of the
        low and of the high cell; of the rim on the diagonal; then likewise of pockets.
    """
    from scipy.sparse import csr_array

    entries = np.bincount(
        mesh.pattern.slot, weights=np.concatenate(values), minlength=len(mesh.pattern.columns)
    )
    size = (mesh.size, mesh.size)
    return csr_array((entries, mesh.pattern.columns, mesh.pattern.starts), shape=size)


def _carried(face: Face, mesh: Mesh, height: Array, velocity: Velocity) -> tuple[Array, Array]:
    """Flow (U/2) h through full sides, to the higher coordinate [m3/s]."""
    width = np.array([face.pixel_size[1], face.pixel_size[0]])
    speed = 0.25 * np.array([velocity[1], velocity[0]]) * width
    inside = speed[mesh.sides.axis] * (height[mesh.sides.low] + height[mesh.sides.high])
    rim = speed[mesh.rim.axis] * (height[mesh.rim.cell] + height[mesh.rim.beyond])
    return inside, rim


def _transport(mesh: Mesh, carried: tuple[Array, Array]) -> tuple[Any, Array]:
    """Upwind matrix of the voids that walls carry, and the net inflow of a full film."""
    from scipy.sparse import coo_array

    low, high = mesh.number[mesh.sides.low], mesh.number[mesh.sides.high]
    cell, beyond = mesh.number[mesh.rim.cell], mesh.rim_number
    along, at_rim = carried[0], carried[1] * mesh.rim.sign
    # Each flow from an unknown to another; -1 is a reservoir, which is full.
    start = np.concatenate([np.where(along > 0.0, low, high), np.where(at_rim > 0.0, cell, beyond)])
    end = np.concatenate([np.where(along > 0.0, high, low), np.where(at_rim > 0.0, beyond, cell)])
    flow = np.abs(np.concatenate([along, at_rim]))
    leaves, enters = start >= 0, end >= 0
    within = leaves & enters
    n = mesh.size
    brought = np.bincount(end[enters], weights=flow[enters], minlength=n).astype(float)
    brought -= np.bincount(start[leaves], weights=flow[leaves], minlength=n)
    rows = np.concatenate([start[leaves], end[within]])
    columns = np.concatenate([start[leaves], start[within]])
    values = np.concatenate([flow[leaves], -flow[within]])
    return coo_array((values, (rows, columns)), shape=(n, n)).tocsr(), brought


def _volumes(face: Face, mesh: Mesh, gap: Array, compressibility: float) -> tuple[Array, Array]:
    """Volume of each unknown, and what it takes in per pressure."""
    volume = per_unknown(mesh, gap, face.cell_area)
    compliance = compressibility * volume
    for number, (more, soft) in enumerate(face.pockets, start=1):
        cells = np.flatnonzero(face.owner.ravel() == number)
        if cells.size:  # a coarse grid may have none of it
            i = mesh.number[cells[0]]
            volume[i] += more
            compliance[i] += soft * more
    return volume, compliance
