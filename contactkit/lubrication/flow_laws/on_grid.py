r"""Squeezed film of any flow law on any face, in 2-D: generalised Reynolds' equation.

.. math:: \nabla \cdot \left(K \nabla P\right) = \dot h, \qquad
          K = \frac{|q| \, M(p)}{g(|q|, h, p)}, \qquad P = \int_0^p \frac{dp}{M}

The conductivity K is taken as a function of the flux and not of the gradient. The flux follows from
the volume balance and changes little with the law, and K is regular where a power law has no
viscosity, or an infinite one: the iteration contracts by |1 - n| at most, and one solution settles
a film whose flux is given, as that of a disc. In the reduced pressure P a Newtonian liquid has one
K at all pressures.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from attrs import evolve

from ...errors import ConvergenceError, InfeasibleError
from ...numerics.fixed_point import Anderson
from ..reynolds.discretisation import checked_gap
from ..reynolds.face import RESERVOIR
from ..reynolds.film import GridFilm
from ..reynolds.solve import unchecked_pressure
from .base import FlowLaw

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from ..reynolds.face import Face
    from ..reynolds.film import GridFilmState

    Array = NDArray[np.floating[Any]]

__all__ = ["FilmOnGrid", "cell_flux", "solve_from_flux", "solve_on_grid"]

# Flux, over that which a cell takes up, below which a cell counts as stagnant: the mean over a cell
# around a stagnation point is a quarter.
_STAGNANT = 0.1
# Iterations in which a film may have no pressure: one that closes slowly enough finds it within 5.
_PATIENCE = 15
_LARGEST_STEP = 2.0  # of ln K in an iteration
_MOST = 200.0  # logarithm of the viscosity ratio in an iteration


class FilmOnGrid(NamedTuple):
    """Solved film of a flow law on a face."""

    pressure: Array
    """Pressure, relative to ambient, shape (ny, nx) [Pa]."""
    flux: Array
    """Magnitude of the flux per width in each cell [m2/s]."""
    gradient: Array
    """Magnitude of the pressure gradient in each cell [Pa/m]."""
    force: float
    """Force that resists opening [N]."""
    dissipation: float
    """Power that the flow dissipates [W]: flows through the sides of the cells times the falls of
    the pressure along them. With one rate and reservoirs at ambient it is force times rate."""
    reduced: GridFilmState
    """The film of the last conductivity, in the reduced pressure."""
    iterations: int
    change: float
    """Relative change of the force by the last iteration [-]."""


def solve_on_grid(
    face: Face,
    law: FlowLaw,
    gap: ArrayLike,
    rate: ArrayLike,
    *,
    drop: float = math.inf,
    rtol: float = 1e-8,
    max_iterations: int = 200,
    solver: str | None = None,
) -> FilmOnGrid:
    """Pressure of a full film of any flow law at an instant.

    Parameters
    ----------
    face : Face
        The face; pressures of its reservoirs are relative to ambient.
    law : FlowLaw
        Flow law of the liquid and slip at the walls.
    gap : array_like, shape () or (ny, nx)
        Gap [m].
    rate : array_like, shape () or (ny, nx)
        Rate of change of the gap [m/s].
    drop : float
        Pressure of a cavity, as a drop below ambient [Pa]; the floor of the pressure, without
        memory. By default the film never cavitates.
    rtol : float
        Change of the conductivity between iterations at which they end.
    max_iterations : int
        Maximum number of linear solutions.
    solver : str, optional
        See `reynolds.solve_pressure`.

    Raises
    ------
    DescriptionError
        If a gap is not positive or a map has the wrong shape.
    InfeasibleError
        If some liquid has no way to a reservoir, or no pressure closes the gap so fast.
    ConvergenceError
        If the iteration does not settle.

    Notes
    -----
    Second order in the cells. The Newtonian film is that of `reynolds.solve_pressure`.

    Examples
    --------
    >>> from contactkit.lubrication.flow_laws.closed_forms import power_law_disc_force
    >>> from contactkit.lubrication.flow_laws.power_law import PowerLaw
    >>> from contactkit.lubrication.reynolds.face import rasterise
    >>> from contactkit.scene.planforms import Disc
    >>> face = rasterise(Disc(radius=3e-3), 48)
    >>> film = solve_on_grid(face, PowerLaw(consistency=0.1, exponent=0.5), 1e-5, 1e-3)
    >>> abs(film.force / power_law_disc_force(3e-3, 1e-5, 1e-3, 0.1, 0.5) - 1.0) < 3e-3
    True
    """
    height = checked_gap(face, gap)
    flux = _first_flux(face, law, height, rate)
    limits = _Limits(drop, rtol, max_iterations, solver)
    return _settled(face, law, (height, flux), rate, limits)


def solve_from_flux(
    face: Face,
    law: FlowLaw,
    gap: ArrayLike,
    rate: ArrayLike,
    flux: Array,
    *,
    rtol: float = 1e-8,
) -> FilmOnGrid:
    """Pressure of a full film whose flux is nearly known, as that of a Newtonian liquid is.

    Parameters
    ----------
    face, law, gap, rate, rtol
        See `solve_on_grid`.
    flux : ndarray, shape (ny, nx)
        Magnitude of the flux per width to begin with [m2/s].

    Raises
    ------
    DescriptionError, InfeasibleError, ConvergenceError
        See `solve_on_grid`.

    Notes
    -----
    Beginning with the Newtonian flux saves a third of the linear solutions.

    Examples
    --------
    >>> from contactkit.lubrication.flow_laws.power_law import PowerLaw
    >>> from contactkit.lubrication.reynolds.face import rasterise
    >>> from contactkit.scene.planforms import Rectangle
    >>> face = rasterise(Rectangle(length=2e-3, width=1e-3), 16)
    >>> law = PowerLaw(consistency=0.1, exponent=0.5)
    >>> first = solve_on_grid(face, law, 1e-5, 1e-3)
    >>> again = solve_from_flux(face, law, 1e-5, 1e-3, first.flux)
    >>> again.iterations < first.iterations, round(again.force / first.force, 7)
    (True, 1.0)
    """
    limits = _Limits(math.inf, rtol, 200, None)
    return _settled(face, law, (checked_gap(face, gap), flux), rate, limits)


class _Limits(NamedTuple):
    """Drop of a cavity [Pa], tolerance and maximum number of iterations, linear solver."""

    drop: float
    rtol: float
    max_iterations: int
    solver: str | None


def _settled(
    face: Face, law: FlowLaw, begin: tuple[Array, Array], rate: ArrayLike, limits: _Limits
) -> FilmOnGrid:
    """Film whose conductivity agrees with its flux, from a gap [m] and a flux [m2/s]."""
    height, flux = begin
    film, rtol = _reduced_film(face, law, limits.drop), limits.rtol
    floor = np.abs(np.broadcast_to(np.asarray(rate, dtype=float), face.shape))
    floor = floor * (_STAGNANT * max(face.pixel_size))
    logs = _conductivity(face, law, np.maximum(flux, floor), height, None)
    mixing, before, n_blocked = Anderson(), math.inf, 0
    for iteration in range(1, limits.max_iterations + 1):
        state = unchecked_pressure(film, np.exp(logs / 3.0), rate, solver=limits.solver)
        pressure, flux = _pressure(law, state), np.maximum(cell_flux(state), floor)
        found = _conductivity(face, law, flux, height, pressure)
        missed, force = float(np.abs(found - logs).max()), _force(face, pressure)
        is_blocked = not math.isfinite(force)
        n_blocked += is_blocked
        if n_blocked > _PATIENCE or (is_blocked and missed <= rtol):
            raise InfeasibleError(
                "the film cannot close so fast: its viscosity grows with pressure without bound, "
                "and no pressure drives the liquid out; close more slowly, or take Roelands' law"
            )
        change = math.inf if is_blocked else abs(force - before) / max(abs(force), 1e-300)
        before = force
        if missed <= rtol:
            return _result(law, state, height, iteration, change)
        blocks = (np.asarray(one, dtype=np.float64) for one in (logs, found))
        (after,) = mixing.next((next(blocks),), (next(blocks),), (1.0,))
        logs = logs + np.clip(after - logs, -_LARGEST_STEP, _LARGEST_STEP)
    raise ConvergenceError(f"the film did not settle: the force still changes by {change:.2g}")


def _reduced_film(face: Face, law: FlowLaw, drop: float) -> GridFilm:
    """Film in the reduced pressure; its viscosity makes a conductivity the cube of the gap."""
    bound = law.pressure_law
    if bound is not None:
        face = evolve(face, pressure=bound.reduced(face.pressure))
        drop = drop if math.isinf(drop) else -float(bound.reduced(-drop))
    return GridFilm(face=face, viscosity=1.0 / 12.0, drop=drop)


def _first_flux(face: Face, law: FlowLaw, height: Array, rate: ArrayLike) -> Array:
    """Flux per width [m2/s] to begin with, of the right order."""
    around = face.pressure[face.owner == RESERVOIR]
    length = math.sqrt(face.cell_area * max(int(face.loaded.sum()), 1))
    driven = float(np.ptp(around)) / length if around.size else 0.0
    moved = 0.25 * length * float(np.abs(rate).max())
    return np.asarray(law.flux(driven, height)) + moved


def _conductivity(
    face: Face, law: FlowLaw, flux: Array, height: Array, pressure: Array | None
) -> Array:
    """Logarithm of K in each cell; 0 outside the film."""
    p = np.zeros_like(height) if pressure is None else pressure
    inside = face.loaded & (flux > 0.0)
    q, h = np.where(inside, flux, 1.0), np.where(face.loaded, height, 1.0)
    if law.pressure_law is not None:
        p = np.minimum(np.where(face.loaded, p, 0.0), _MOST / law.pressure_law.coefficient)
    found = np.log(q / law.gradient(q, h, p)) + np.log(law.multiplier(p))
    return np.asarray(np.where(inside, found, found[inside].min(initial=0.0)))


def _pressure(law: FlowLaw, state: GridFilmState) -> Array:
    """Pressure of a reduced one [Pa]."""
    reduced = state.pressure
    return reduced if law.pressure_law is None else law.pressure_law.pressure_of(reduced)


def _force(face: Face, pressure: Array) -> float:
    return -float(pressure[face.loaded].sum()) * face.cell_area


def cell_flux(state: GridFilmState) -> Array:
    """Magnitude of the flux per width in each cell [m2/s], from those through its sides."""
    balance: Any = state.balance
    mesh, p, face = balance.mesh, state.pressure.ravel(), state.film.face
    size = np.array(face.pixel_size)
    sides, rim = mesh.sides, mesh.rim
    width = size[::-1]
    inner = balance.inner * (p[sides.high] - p[sides.low]) / width[sides.axis]
    outer = balance.outer * (p[rim.beyond] - p[rim.cell]) / width[rim.axis] * rim.sign
    # At the low and the high side of each cell along y and x, with the distance from the centre;
    # where nothing passes, the flux is zero half a cell away.
    flux = np.zeros((2, 2, p.size))
    away = np.broadcast_to(0.5 * size[None, :, None], flux.shape).copy()
    flux[1, sides.axis, sides.low] = inner
    flux[0, sides.axis, sides.high] = inner
    at_high = (rim.sign > 0.0).astype(int)
    flux[at_high, rim.axis, rim.cell] = outer
    away[at_high, rim.axis, rim.cell] = 0.5 * rim.distance
    centre = (flux[0] * away[1] + flux[1] * away[0]) / (away[0] + away[1])
    return np.asarray(np.hypot(centre[0], centre[1])).reshape(state.pressure.shape)


def _result(
    law: FlowLaw, state: GridFilmState, height: Array, iterations: int, change: float
) -> FilmOnGrid:
    face, pressure, flux = state.film.face, _pressure(law, state), cell_flux(state)
    inside = face.loaded
    q, h = np.where(inside, flux, 0.0), np.where(inside, height, 1.0)
    gradient = np.asarray(law.gradient(q, h, np.where(inside, pressure, 0.0)))
    force, power = _force(face, pressure), _dissipation(state, pressure.ravel())
    return FilmOnGrid(pressure, q, gradient, force, power, state, iterations, change)


def _dissipation(state: GridFilmState, p: Array) -> float:
    """Flow through each side times the fall of the pressure along it [W]."""
    balance: Any = state.balance
    sides, rim, reduced = balance.mesh.sides, balance.mesh.rim, state.pressure.ravel()
    inner = balance.inner * (reduced[sides.high] - reduced[sides.low])
    outer = balance.outer * (reduced[rim.beyond] - reduced[rim.cell])
    if state.excess is not None:
        outer = outer + state.excess
    inside = float(inner @ (p[sides.high] - p[sides.low]))
    return inside + float(outer @ (p[rim.beyond] - p[rim.cell]))
