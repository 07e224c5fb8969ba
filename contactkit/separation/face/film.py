"""Damping of a full film on a face over its gap, with the error of its grid and of its table."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from attrs import field, frozen

from ...errors import ConvergenceError
from ...lubrication.reynolds.damping import DampingLaw
from ...validity import ValidityNumber
from .shape import FaceShape, closed_form

if TYPE_CHECKING:
    from ...scene.surfaces import FineRoughness
    from .grid import FaceGrid

__all__ = ["FaceFilm", "face_film"]

_FEWEST, _MOST = 32, 512
"""Cells along the longer side: 16 leave 1 to 5 % of the force, 512 take seconds a solution."""
_CAVITY = 0.1
"""Cells across a face with a cavity times the tolerance. Its edge is known to a cell while liquid
returns: the release time of the injector is off by 2.6e-3, 1.1e-3, 4e-4 with 64, 96, 128 cells."""
_PER_DECADE = 8
"""Gaps of a table in a decade: cubics through them leave 1e-5 of a dome, a tilt, a recess."""
_NEARER, _FARTHER = 0.1, 4.0
"""Reach of a table below the smallest and beyond the largest gap of the scene; it is a power of the
gap from there, which meets the table without a kink."""

_THINNEST = 3.0
"""Rms heights of fine roughness down to which a table goes: below, contacts block the flow."""


@frozen(eq=False)
class FaceFilm:
    """Full film on a face of any shape.

    Parameters
    ----------
    shape : FaceShape
        Its shape.
    law : DampingLaw
        Damping over the shortest distance of the faces plus `depth`.
    depth : float
        How much deeper the law counts its gap from [m].
    error : float
        Error of the force [-], by the change from half the cells; 0 of a closed form.
    cells : int
        Cells along the longer side of the grid; 0 of a closed form.
    numbers : tuple of ValidityNumber
        Ranges of the flow factors of its roughness.
    """

    shape: FaceShape
    law: DampingLaw
    depth: float = 0.0
    error: float = 0.0
    cells: int = 0
    rtol: float = field(default=1e-3, repr=False)
    numbers: tuple[ValidityNumber, ...] = field(default=(), repr=False)

    def coefficient(self, gap: float) -> float:
        """Damping over viscosity [m] at a gap [m]."""
        return self.law.coefficient(gap + self.depth)

    def exponent(self, gap: float) -> float:
        """Exponent n of the damping, which falls as gap^-n, at a gap [m]."""
        return self.law.exponent(gap + self.depth) * gap / (gap + self.depth)

    def onset(self, gap: float) -> float:
        """Highest tension over viscosity and speed [1/m] at a gap [m]."""
        return self.law.onset(gap + self.depth)

    def impulse(self, start: float, end: float) -> float:
        """Integral of the damping over viscosity [m2] from one gap [m] to another."""
        return self.law.impulse(start + self.depth, end + self.depth)

    def gridded(self, gap: float) -> FaceGrid:
        """The film on a grid for its cavity, with the force of a full film at a gap [m]."""
        from .grid import gridded

        least = min(_MOST, math.ceil(_CAVITY / self.rtol))
        if self.cells:
            return gridded(self.shape, max(self.cells, least))
        exact, cells = self.coefficient(gap), max(_FEWEST, least)
        while True:
            grid = gridded(self.shape, cells)
            error = abs(_coefficient(grid, gap) / exact - 1.0)
            if error <= self.rtol:
                return grid
            cells = _finer(cells, error, self.rtol)


def face_film(shape: FaceShape, gaps: tuple[float, float], rtol: float) -> FaceFilm:
    """Damping of a film in closed form, or by Reynolds' equation on a grid.

    Parameters
    ----------
    shape : FaceShape
        The film.
    gaps : (float, float)
        Smallest and largest gap of the scene [m].
    rtol : float
        Error of the force that is accepted [-].

    Raises
    ------
    ConvergenceError
        If no grid meets the tolerance.

    Examples
    --------
    >>> import contactkit as ck
    >>> from contactkit.separation.face.shape import shape_of
    >>> ring = ck.Flat(planform=ck.Ring(radius=1.0, hole_radius=0.3))
    >>> round(face_film(shape_of(ck.Interface(upper=ring)), (0.1, 1.0), 1e-3).coefficient(1.0), 6)
    1.433008
    """
    known = closed_form(shape)
    if known is not None:
        return FaceFilm(shape, known.law, known.depth, rtol=rtol)
    if shape.roughness is not None:
        smooth = face_film(shape._replace(roughness=None), gaps, rtol)
        return _rough_film(smooth, shape.roughness, gaps)
    from .grid import gridded

    before, cells = _coefficient(gridded(shape, _FEWEST), gaps[0]), 2 * _FEWEST
    while True:
        grid = gridded(shape, cells)
        found = _coefficient(grid, gaps[0])
        error = abs(before / found - 1.0)
        if error <= rtol:
            break
        before, cells = found, _finer(cells, error, rtol)
    law, missed = _law(grid, gaps)
    return FaceFilm(shape, law, 0.0, error + missed, cells, rtol)


def _rough_film(smooth: FaceFilm, rough: FineRoughness, gaps: tuple[float, float]) -> FaceFilm:
    """Film on the face of a smooth one, over the gap between the mean planes."""
    from .rough import rough_law, rough_numbers

    patch, grid = rough.patch(), smooth.gridded(gaps[0])
    low = min(gaps[0], max(_NEARER * gaps[0], _THINNEST * float(patch[0].std())))
    high = _FARTHER * gaps[1]
    exact = None if smooth.cells else smooth.coefficient(low)
    law = rough_law(grid, patch, (low, high), _points(low, high), exact)
    numbers = rough_numbers(smooth.shape.outline, patch, gaps[0])
    cells, shape = max(grid.face.shape), smooth.shape._replace(roughness=rough)
    return FaceFilm(shape, law, 0.0, smooth.error, cells, smooth.rtol, numbers)


def _points(low: float, high: float) -> int:
    """Gaps of a table between two distances [m]."""
    return math.ceil(_PER_DECADE * math.log10(high / low)) + 1


def _finer(cells: int, error: float, rtol: float) -> int:
    if cells < _MOST:
        return 2 * cells
    raise ConvergenceError(
        f"Reynolds' equation on {cells} cells across the face leaves {error:.2g} of the force, "
        f"more than Accuracy.film_rtol = {rtol:g}; loosen it, or leave out details that are far "
        "smaller than the face",
        None,
    )


def _coefficient(grid: FaceGrid, gap: float) -> float:
    """Damping over viscosity [m] of the grid at a gap [m]."""
    from ...lubrication.reynolds.shape_factor import unit_damping

    return unit_damping(grid.face, grid.relief + gap).coefficient


def _law(grid: FaceGrid, gaps: tuple[float, float]) -> tuple[DampingLaw, float]:
    """Damping law of a grid, and the error of its table [-]."""
    from ...lubrication.reynolds.shape_factor import face_damping, tabulate_damping

    if grid.is_even:
        return face_damping(grid.face), 0.0
    # In the distance from the highest peak of a relief, which is 0 without any.
    peak = -float(grid.relief[grid.face.loaded].min())
    low, high = _NEARER * (gaps[0] - peak), _FARTHER * gaps[1]
    points = _points(low, high)
    law = tabulate_damping(grid.face, (peak + low, peak + high), grid.relief, points=points)
    # Midway between the points around the smallest gap of the scene.
    step = (high / low) ** (1.0 / (points - 1))
    place = math.floor(math.log((gaps[0] - peak) / low) / math.log(step)) + 0.5
    place = peak + low * step**place
    return law, abs(law.coefficient(place) / _coefficient(grid, place) - 1.0)
