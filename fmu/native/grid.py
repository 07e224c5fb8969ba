"""The grid of a film that cavitates on a face that is no disc, as the record that C reads.

The kernel is given what the finite volumes of `contactkit.lubrication.reynolds` are made of: cells
with their relief, and the geometry of the sides between them and to the rim. Conductances are that
times h^3/(12 eta), which it forms at each gap.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ...errors import PlanError
from ...lubrication.reynolds.damping import TabulatedDamping
from ...lubrication.reynolds.discretisation import discretise, per_unknown
from ...lubrication.reynolds.mesh import Mesh, make_mesh
from ...separation.face.cavity import FaceCavity
from ...separation.face.film import FaceFilm
from ...separation.face.grid import FaceGrid
from .records import Cells, Grid, Onset, PocketSides, Sides

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[np.floating[Any]]
    Indices = NDArray[np.int64]

__all__ = ["MOST_CELLS", "MOST_FILL", "grid_record"]

MOST_CELLS = 16_384
"""Most cells of a native film, as in grid.c: a square of 128 across, whose factors take 20 ms each
and the file 1.5 MB."""
MOST_FILL = 1_000_000
"""Most entries of their factor, as there: 16 384 cells in order have 330 000."""
_LINES = 2048
"""Straight lines for a law in closed form between uneven faces: of 0.01 in ln h they leave 1e-5."""


def grid_record(cavity: FaceCavity, gaps: tuple[float, float]) -> Grid:
    """Grid of a film that cavitates, for the kernel.

    Parameters
    ----------
    cavity : FaceCavity
        The film.
    gaps : (float, float)
        Smallest and largest gap of the tables [m].

    Raises
    ------
    PlanError
        If it has more cells than the kernel holds.
    """
    mesh = make_mesh(cavity.grid.face)
    if mesh.size > MOST_CELLS:
        raise PlanError(
            f"a native film that cavitates holds {MOST_CELLS} cells, this face has {mesh.size} "
            f"with film_rtol = {cavity.film_rtol:g}; build it with a coarser one, such as "
            f"film_rtol = {3.0 * cavity.film_rtol:g} (accuracy.film_rtol of a scene file), or run "
            "the scene by ck.simulate"
        )
    place = _eliminated(cavity.grid)
    return Grid(
        rtol=cavity.film_rtol,
        onset=_onset(cavity.film, gaps),
        cells=_cells(cavity.grid, mesh, place),
        sides=_sides(mesh, place),
        pockets=_pocket_sides(mesh, place),
    )


def _onset(film: FaceFilm, gaps: tuple[float, float]) -> Onset:
    """Highest tension of the full film over its force, which every law has in common."""
    law, depth = film.law, 0.0
    if isinstance(law, TabulatedDamping):  # by straight lines, too
        depth = film.depth + law.offset
        places = np.array(law.gaps) - film.depth
    else:
        count = 2 if film.shape.is_even else _LINES
        places = np.geomspace(*gaps, count)
    ratios = [film.onset(gap) / film.coefficient(gap) for gap in places.tolist()]
    return Onset(
        depth=depth, place=_numbers(np.log(places + depth)), ratio=_numbers(np.log(ratios))
    )


def _eliminated(grid: FaceGrid) -> Indices:
    """Place of each unknown in an order of elimination in which little fills in: minimum degree."""
    from scipy.sparse.linalg import splu

    balance = discretise(grid.face, np.ones(grid.face.shape), 1.0)
    factor = splu(
        balance.conductances.tocsc(),
        permc_spec="MMD_AT_PLUS_A",
        diag_pivot_thresh=0.0,
        options={"SymmetricMode": True},
    )
    return np.asarray(factor.perm_c, dtype=np.int64)


def _ordered(place: Indices, values: NDArray[Any]) -> tuple[float, ...]:
    found = np.empty(len(place))
    found[place] = values
    return _numbers(found)


def _numbers(values: NDArray[Any]) -> tuple[float, ...]:
    return tuple(map(float, values))


def _cells(grid: FaceGrid, mesh: Mesh, place: Indices) -> Cells:
    rim, n, cell_area = mesh.rim, mesh.size, grid.face.cell_area
    at_rim = mesh.rim_number < 0
    where = mesh.number[rim.cell[at_rim]]
    extra = np.zeros(n)
    owner = grid.face.owner.ravel()
    for number, (volume, _) in enumerate(grid.face.pockets, start=1):
        cells = np.flatnonzero(owner == number)
        if cells.size:
            extra[mesh.number[cells[0]]] += volume
    return Cells(
        area=_ordered(place, mesh.area),
        relief=_ordered(place, per_unknown(mesh, grid.relief, cell_area) / mesh.area),
        extra=_ordered(place, extra),
        rim=_ordered(place, np.bincount(where, weights=rim.geometry[at_rim], minlength=n)),
        excess=_ordered(place, np.bincount(where, weights=rim.excess[at_rim], minlength=n)),
    )


def _sides(mesh: Mesh, place: Indices) -> Sides:
    low, high = mesh.number[mesh.sides.low], mesh.number[mesh.sides.high]
    return Sides(
        one=_numbers(place[low]),
        other=_numbers(place[high]),
        geometry=_numbers(mesh.sides.geometry),
    )


def _pocket_sides(mesh: Mesh, place: Indices) -> PocketSides | None:
    held = mesh.rim_number >= 0
    if not held.any():
        return None
    return PocketSides(
        cell=_numbers(place[mesh.number[mesh.rim.cell[held]]]),
        pocket=_numbers(place[mesh.rim_number[held]]),
        geometry=_numbers(mesh.rim.geometry[held]),
        excess=_numbers(mesh.rim.excess[held]),
    )
