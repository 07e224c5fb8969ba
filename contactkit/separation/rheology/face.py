r"""Film of any flow law on a face of any shape, by Reynolds' equation on a grid.

The force is that of the Newtonian film, times the ratio that its flux estimates
(`contactkit.lubrication.flow_laws.unit_flow`), times what a solution of the law itself changes of
that: a correction of some per cent, from few solutions on a coarse grid. A Newtonian liquid needs
none, whatever its slip and its viscosity over pressure.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from attrs import evolve, field, frozen

from ...errors import DescriptionError, InfeasibleError
from ...lubrication.flow_laws.base import FlowLaw
from ...lubrication.flow_laws.closed_forms import slip_disc_factor
from ...lubrication.flow_laws.newtonian import Newtonian
from ...lubrication.flow_laws.unit_flow import UnitFlow, solution_ratio, tensions, unit_flow
from ..face.film import FaceFilm
from ..face.grid import FaceGrid, gridded
from .correction import Correction

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ..effects.film_shape import FilmShape

    Array = NDArray[np.floating[Any]]

__all__ = ["FaceRheology", "resolved"]

_Key = tuple[int, float, tuple[float, float]]  # cells, gap [m], slip lengths [m]

_FEWEST, _MOST = (64, 32), (256, 128)
"""Cells along the longer side for the flux, and for the correction, of which each solution is ten
of the flux: 0.05 s with 64 cells, 0.4 s with 128, Carreau's law twice as long."""
_LEFT = 0.5
"""What is left of the change from half the cells: a third of an error of second order; 0.42 around
a hole in a power law of n = 0.3, whose viscosity is infinite along a line."""
_SAME = 1e-3  # logarithm of the estimated ratio below which the flux is the Newtonian one
_STEP = 1.01  # of speeds, for the slope of a force


@frozen(eq=False)
class FaceRheology:
    """Full film of any flow law on a face.

    Parameters
    ----------
    full : FaceFilm
        The Newtonian film without slip.
    shape : FilmShape
        A disc of the same area, as the viscous force takes it.
    law : FlowLaw
        Flow of the liquid, with slip and pressure.
    viscosity : float
        Viscosity of the liquid at rest and ambient pressure [Pa.s].
    strength : float
        Tension at which the liquid cavitates [Pa]; inf if it never does.
    cells : (int, int)
        Cells along the longer side of the grid for the flux, and of that for the correction.
    error : float
        Error of the force over the Newtonian one [-], half the change from half the cells.
    fastest : float
        Rate of shear [1/s] beyond which the correction stays, for searches that go to any speed.
    """

    full: FaceFilm
    shape: FilmShape
    law: FlowLaw
    viscosity: float
    strength: float = math.inf
    cells: tuple[int, int] = _FEWEST
    error: float = 0.0
    fastest: float = math.inf
    _flows: dict[_Key, UnitFlow] = field(factory=dict, init=False, repr=False)
    _last: dict[_Key, UnitFlow] = field(factory=dict, init=False, repr=False)
    _grids: dict[int, FaceGrid] = field(factory=dict, init=False, repr=False)

    @property
    def is_linear(self) -> bool:
        """Whether the force is proportional to the speed."""
        return isinstance(self.law, Newtonian) and self.law.pressure_law is None

    @property
    def is_even(self) -> bool:
        """Whether the gap is the same everywhere: what slip leaves is known in closed form then."""
        return self.full.shape.is_even

    @property
    def has_one_variable(self) -> bool:
        """Whether the force over that at the viscosity at rest follows from the rate of shear."""
        return self.is_even and not self.slips and self.law.pressure_law is None

    @property
    def slips(self) -> bool:
        """Whether the liquid slips at a wall."""
        return max(self.law.slip_length) > 0.0

    def radii(self, gap: Array) -> Array:
        """Radii [m] of a disc of the same area."""
        return np.full(gap.shape, self.shape.rim)

    def shear_per_speed(self, gap: float) -> float:
        """Fastest shear at a wall of a disc of the same area over the speed [1/m]."""
        return 3.0 * self.shape.rim / (gap * gap)

    def newtonian_force(self, gap: float, speed: float) -> float:
        """Force [N] of the same film without rheology and slip."""
        return self.viscosity * self.full.coefficient(gap) * speed

    def linear_force(self, gap: float, speed: float) -> float:
        """Force [N] at the viscosity at rest, with slip."""
        plain = self.newtonian_force(gap, speed)
        if self.is_even:
            return plain * float(slip_disc_factor(gap, *self.law.slip_length))
        return plain * self.slip_ratio(gap, self.cells[0]) if self.slips else plain

    def slip_ratio(self, gap: float, cells: int) -> float:
        """Force of a Newtonian film with slip over that without [-], on a grid."""
        with_slip = self._flow(cells, gap, self.law.slip_length)
        return with_slip.force / self._flow(cells, gap, (0.0, 0.0)).force

    def force(self, gap: float, speed: float) -> float:
        """Force of the film [N]; -inf where no pressure closes the gap so fast."""
        return float(self.forces(np.array([gap]), np.array([speed]))[0][0]) if speed else 0.0

    def forces(self, gap: Array, speed: Array) -> tuple[Array, Array]:
        """Forces [N] at gaps [m] and speeds [m/s] but 0, and those at the viscosity at rest.

        -inf where no pressure closes the gap so fast.
        """
        linear = self._linear_forces(gap, speed)
        if self.is_linear:
            return linear, linear
        return linear * self._ratios(gap, speed), linear

    def solved_force(self, gap: float, speed: float) -> float:
        """Force [N] with the correction of a solution at this very gap [m] and speed [m/s]."""
        shear = self.estimate(gap, speed, self.cells[0], self._shear)
        ratio = shear * math.exp(self.solved_correction(gap, speed, self.cells[1]))
        return self.linear_force(gap, speed) * ratio

    def bounded_force(self, gap: float, speed: float) -> float:
        """See `bounded_forces`."""
        return float(self.bounded_forces(np.array([gap]), np.array([speed]))[0]) if speed else 0.0

    def bounded_forces(self, gap: Array, speed: Array) -> Array:
        """Forces [N] of pressures truncated at the strength of the liquid, without a correction."""
        linear = self._linear_forces(gap, speed)
        if self.is_linear and math.isinf(self.strength):
            return linear
        return linear * self._estimates(gap, speed, self.law, self.cells[0], self.strength)[0]

    def peak_pressures(self, gap: Array, speed: Array) -> Array:
        """Largest pressure differences from ambient [Pa] of full films, without a correction."""
        return self._estimates(gap, speed, self.law, self.cells[0])[1]

    def linear_pressures(self, gap: Array) -> Array:
        """Largest pressure differences per speed [Pa.s/m] at the viscosity at rest."""
        flows = [self._flow(self.cells[0], one, self.law.slip_length) for one in gap.tolist()]
        return self.viscosity * np.array([one.force * one.pressure.max() for one in flows])

    @property
    def fastest_shear(self) -> float:
        """Fastest shear at a wall of an even face over that of a disc of the same area [-]."""
        flux = self._flow(self.cells[0], 1.0, (0.0, 0.0)).flux.max()
        return float(6.0 * flux / self.shear_per_speed(1.0))

    @cached_property
    def _shear(self) -> FlowLaw:
        """The law without its viscosity over pressure."""
        return evolve(self.law, pressure_law=None)

    def estimate(self, gap: float, speed: float, cells: int, law: FlowLaw | None = None) -> float:
        """Force over that at the viscosity at rest [-], from the flux on a grid.

        inf where no pressure closes the gap so fast.
        """
        found = self._estimates(np.array([gap]), np.array([speed]), law or self.law, cells)
        return float(found[0][0])

    def solved_correction(self, gap: float, speed: float, cells: int) -> float:
        """Logarithm of the force over its estimate without pressure; inf where there is none."""
        if isinstance(self.law, Newtonian):
            return math.log(self.estimate(gap, speed, cells))
        height = self._grid(cells).relief + gap
        flow = self._solved(cells, gap, self.law.slip_length)
        try:
            return math.log(solution_ratio(flow, self.law, height, speed))
        except InfeasibleError:
            return math.inf

    def _grid(self, cells: int) -> FaceGrid:
        if cells not in self._grids:
            self._grids[cells] = gridded(self.full.shape, cells)
        return self._grids[cells]

    def _flow(self, cells: int, gap: float, slip: tuple[float, float]) -> UnitFlow:
        """Newtonian film at a gap [m] and slip lengths [m], in groups of cells."""
        key = self._key(cells, gap, slip)
        if key not in self._flows:
            self._flows[key] = self._solved(cells, gap, slip)._replace(state=None)
        made = self._flows[key]
        return made.even(gap, slip) if self.is_even else made

    def _solved(self, cells: int, gap: float, slip: tuple[float, float]) -> UnitFlow:
        """The same with its pressure in each cell; the last one is kept."""
        key, grid = self._key(cells, gap, slip), self._grid(cells)
        if key not in self._last:
            self._last.clear()
            self._last[key] = unit_flow(grid.face, grid.relief + key[1], key[2])
        return self._last[key]

    def _key(self, cells: int, gap: float, slip: tuple[float, float]) -> _Key:
        """What decides a Newtonian film; an even face is solved once, at 1 m without slip."""
        return (cells, 1.0, (0.0, 0.0)) if self.is_even else (cells, gap, slip)

    def _linear_forces(self, gap: Array, speed: Array) -> Array:
        return np.asarray(np.vectorize(self.linear_force, otypes=[float])(gap, speed))

    def _estimates(
        self,
        gap: Array,
        speed: Array,
        law: FlowLaw,
        cells: int,
        strength: float = math.inf,
    ) -> tuple[Array, Array]:
        """Forces over those at the viscosity at rest [-], and largest pressures [Pa]."""
        ratios, peaks = np.empty(gap.shape), np.empty(gap.shape)
        for one in np.unique(gap).tolist():
            here, flow = gap == one, self._flow(cells, one, law.slip_length)
            found = tensions(flow, law, self.viscosity, speed[here])
            linear = self.viscosity * speed[here] * flow.force
            ratios[here] = (np.minimum(found, strength) @ flow.area) / linear
            peaks[here] = np.abs(found).max(axis=1)
        return ratios, peaks

    def _ratios(self, gap: Array, speed: Array) -> Array:
        """Forces over those at the viscosity at rest; inf where no pressure closes so fast."""
        whole = self._estimates(gap, speed, self.law, self.cells[0])[0]
        if isinstance(self.law, Newtonian):
            return whole
        shear = whole
        if self.law.pressure_law is not None:
            shear = self._estimates(gap, speed, self._shear, self.cells[0])[0]
        for place in zip(*np.nonzero(_differ(whole, shear)), strict=True):
            h, v = float(gap[place]), float(speed[place])
            # Without a viscosity over pressure opening and closing are alike.
            sign = 1.0 if self.law.pressure_law is None else math.copysign(1.0, v)
            rate = abs(v) * self.shear_per_speed(h)
            value = self._lattices[sign](h, min(rate, self.fastest))
            if math.isfinite(value) and math.isfinite(whole[place]):
                whole[place] *= math.exp(value)
            elif rate > self.fastest:
                whole[place] = math.inf
            else:  # it is near the fastest closing, or a point of the lattice beside it beyond
                solved = self.solved_correction(h, v, self.cells[1])
                whole[place] = shear[place] * math.exp(solved)
        return whole

    @cached_property
    def _lattices(self) -> dict[float, Correction]:
        """Corrections of the estimate of a film that opens (1) and that closes (-1)."""

        def made(sign: float) -> Correction:
            def exact(gap: float, rate: float) -> float:
                speed, cells = sign * rate / self.shear_per_speed(gap), self.cells[1]
                whole, shear = (
                    self.estimate(gap, speed, cells, law) for law in (self.law, self._shear)
                )
                if not _differ(np.array(whole), np.array(shear)):
                    return 0.0
                if math.isinf(whole):
                    return math.nan
                return self.solved_correction(gap, speed, cells) - math.log(whole / shear)

            return Correction(exact, self.shape.rim if self.has_one_variable else None)

        return {1.0: made(1.0), -1.0: made(-1.0)}


def _differ(whole: Array, shear: Array) -> Any:
    """Where the flux is not that of a Newtonian film; pressure and shear may make up for it."""
    logarithms = np.maximum(np.abs(np.log(whole)), np.abs(np.log(shear)))
    return logarithms >= _SAME


def resolved(
    film: FaceRheology, path: Sequence[tuple[float, float]], rtol: float, fastest: float
) -> FaceRheology:
    """Film on grids that are fine enough where the liquid is farthest from Newtonian.

    Parameters
    ----------
    film : FaceRheology
        The film.
    path : sequence of (float, float)
        Gaps [m] and speeds [m/s], not 0, that are expected.
    rtol : float
        Error of the force over the Newtonian one at which a grid is fine enough [-]; what is left
        on the finest grids is the `error` of the film.
    fastest : float
        Rate of shear [1/s] up to which the correction is solved for.
    """
    if film.is_linear and film.is_even:
        return film
    places = _tried(film, path)

    def of_flux(cells: int) -> Array:
        slips = film.slips and not film.is_even
        slip = [film.slip_ratio(gap, cells) if slips else 1.0 for gap, _ in places]
        return np.log([film.estimate(*one, cells) for one in places]) + np.log(slip)

    def of_correction(cells: int) -> Array:
        if isinstance(film.law, Newtonian):
            return np.zeros(1)
        return np.array([film.solved_correction(*one, cells) for one in places])

    cells, errors = [], []
    for value, few, most in zip((of_flux, of_correction), _FEWEST, _MOST, strict=True):
        count, error = _enough_cells(value, few, most, rtol)
        cells.append(count)
        errors.append(error)
    made = evolve(film, cells=(cells[0], cells[1]), error=sum(errors), fastest=fastest)
    made._flows.update(film._flows)
    return made


def _enough_cells(
    value: Callable[[int], Array], few: int, most: int, rtol: float
) -> tuple[int, float]:
    """Cells of which logarithms have errors below a tolerance, or the most; and the largest."""
    try:
        before = value(few // 2)
    except DescriptionError:  # a hole or a recess is smaller than such a cell
        before = np.full(1, math.nan)
    while True:
        after = value(few)
        error = _LEFT * float(np.abs(after - before).max())
        if error <= rtol or few >= most:
            return few, math.inf if math.isnan(error) else error
        before, few = after, 2 * few


def _tried(film: FaceRheology, path: Sequence[tuple[float, float]]) -> list[tuple[float, float]]:
    """Gaps [m] and speeds [m/s] at which a grid is tried.

    That at which the force is least proportional to the speed; on a face that is not even also
    those of the smallest and the largest gap, where the flux takes other ways.
    """
    ends = [] if film.is_even else [min(path), max(path)]
    if film.is_linear:
        return ends
    gap, speed = np.array(path).T
    near, far = (film.bounded_forces(gap, one * speed) for one in (1.0, _STEP))
    with np.errstate(invalid="ignore"):
        exponents = np.log(far / near) / math.log(_STEP)
    place = int(np.argmax(np.where(np.isfinite(exponents), np.abs(exponents - 1.0), -1.0)))
    return [path[place], *ends]
