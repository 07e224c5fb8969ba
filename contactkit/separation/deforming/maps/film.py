"""Film on a map between deforming bodies, at rest at the start."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np
from attrs import field, frozen

from ....elasticity.isolated_map import isolated_map
from ....elasticity.layer_stack import Layers
from ....errors import PlanError
from ....lubrication.elastohydrodynamic.drive import Imposed
from ....lubrication.elastohydrodynamic.maps.wet_map import WetMap
from ....units import quantity_text
from .cells import Cells

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Map = NDArray[np.float64]

__all__ = ["MapFilm", "check_initial_gap"]

# Of a run, per cell: directions of GMRES, padded transforms, grids of the film, maps that are kept.
# Measured with factors of the film, which took 260 of these: 0.18 GB more on 256 x 256 cells.
_BYTES = 3000.0
_SQUARE = 1e-6  # sides of a cell that differ by less
_STEPS = 3.0  # over those in which the rigid gap opens alone, of pulls of rough spheres


@frozen(eq=False)
class MapFilm:
    """Two bodies with a film on a map, at rest: what a plan and a run need of them.

    Parameters
    ----------
    cells : Cells
        Where the film is, and the gap of the undeformed bodies.
    radius : float
        Radius of curvature of the gap without roughness [m]; inf: flat.
    gap : float
        Rigid gap at the start [m].
    viscosity : float
        [Pa.s]
    solids : tuple of Layers
        The bodies that deform.
    cavity, strength : float
        Tensions of a cavity and of the rupture of the whole film [Pa]; inf: none opens.
    cutoff : float
        Gap at which asperities touch [m]; 0: none do.
    """

    cells: Cells = field(repr=False)
    radius: float
    gap: float
    viscosity: float
    solids: tuple[Layers, ...] = field(repr=False)
    cavity: float = math.inf
    strength: float = 0.0
    cutoff: float = 0.0
    wetting: None = field(default=None, init=False)

    @property
    def rim(self) -> float:
        """Radius of a disc of the same area [m]."""
        dy, dx = self.cells.pixel_size
        return math.sqrt(float(self.cells.inside.sum()) * dx * dy / math.pi)

    @property
    def width(self) -> float:
        """Width of the pressure [m]: of a round body sqrt(R h), of a flat its radius."""
        return min(math.sqrt(self.radius * self.gap), self.rim)

    @property
    def peak(self) -> float:
        """Height of the highest place within the film above the smooth bodies [m]."""
        return -float(self.cells.shape[self.cells.inside].min())

    @property
    def roughness(self) -> float:
        """Rms of the heights within the film, without a paraboloid [m]."""
        cells = self.cells
        rows, columns = np.nonzero(cells.inside)
        x, y, s = cells.x[columns], cells.y[rows], cells.shape[cells.inside]
        bases = np.stack([np.ones_like(x), x, y, x * x, x * y, y * y], axis=1)
        bases = bases / np.abs(bases).max(axis=0)
        left = s - bases @ np.linalg.lstsq(bases, s, rcond=None)[0]
        return float(np.sqrt(np.mean(left**2)))

    @property
    def places(self) -> tuple[Map, Map, NDArray[np.bool_]]:
        """Places x and y [m] of the cells of a result, and which of them are film."""
        inside = self.cells.inside
        rows, columns = (np.flatnonzero(inside.any(axis=k)) for k in (1, 0))
        row, column = (slice(one[0], one[-1] + 1) for one in (rows, columns))
        return self.cells.x[column], self.cells.y[row], inside[row, column]

    @property
    def cells_per_wave(self) -> float:
        """Cells per shortest wave that the surfaces state; inf if none does."""
        return self.cells.shortest / max(self.cells.pixel_size)

    @property
    def memory(self) -> float:
        """Estimate of the memory of a run [B]."""
        return _BYTES * self.cells.shape.size

    def notes(self, final_gap: float, change: float) -> Iterator[str]:
        """Grid, resolution and cost, for a plan."""
        cells = self.cells
        (ny, nx), (dy, dx) = cells.shape.shape, cells.pixel_size
        size = quantity_text(dx, "m")
        size += f" x {quantity_text(dy, 'm')}" if abs(dy / dx - 1.0) > _SQUARE else ""
        steps = _STEPS * math.log(max(final_gap / self.gap, 2.0)) / change
        yield (
            f"grid: {nx} x {ny} cells of {size}; some {steps:.0f} steps and "
            f"{self.memory / 1e9:.2g} GB, and a second run on half the cells for the error"
        )
        resolved = f"{self.width / max(dx, dy):.3g} cells in the width of the pressure"
        if math.isfinite(self.cells_per_wave):
            resolved += f", {self.cells_per_wave:.3g} in the shortest wave"
        yield f"resolution: {resolved}"
        yield (
            f"roughness within the film: rms {quantity_text(self.roughness, 'm')}, "
            f"{self.roughness / self.gap:.2g} of the initial gap; smallest gap at the start "
            f"{quantity_text(self.gap - self.peak, 'm')}"
        )
        if self.cutoff:
            yield f"cut-off over the initial gap, h_c/h = {self.cutoff / self.gap:.3g}"

    def wet_map(self, cells: Cells) -> WetMap:
        """The film on its cells, or on coarser ones."""
        bodies = isolated_map(cells.shape.shape, cells.pixel_size, *self.solids)
        at_start = Imposed(lambda _: self.gap)
        floor = -self.cavity
        return WetMap(
            cells.face, cells.padded, self.viscosity, bodies, at_start, floor, self.cutoff
        )


def check_initial_gap(film: MapFilm) -> None:
    """Refuse a start at which the bodies overlap, or touch.

    Raises
    ------
    PlanError
        With the place, and how deep.
    """
    cells = film.cells
    gaps = np.where(cells.inside, film.gap + cells.shape, math.inf)
    row, column = np.unravel_index(gaps.argmin(), gaps.shape)
    smallest = float(gaps[row, column])
    if smallest > film.cutoff:
        return
    place = f"at x = {cells.x[column]:g} m, y = {cells.y[row]:g} m (row {row}, column {column})"
    if smallest <= 0.0:
        found = f"closed {place}, where the bodies would overlap by {quantity_text(-smallest, 'm')}"
    else:
        found = f"{quantity_text(smallest, 'm')} {place}, below SolidContact.cutoff"
    least = film.gap - smallest + film.cutoff
    raise PlanError(
        f"at loading.initial_gap = {film.gap:g} m the gap is {found}: start from more than "
        f"{quantity_text(least, 'm')}, and press the bodies together by PressAndPull"
    )
