r"""Force of a film of any flow law on any face, estimated from the flux of a Newtonian film.

A film whose volume balance is given minimises the complementary energy

.. math:: W(v) = \min_{\nabla \cdot \mathbf q = v}
          \int \int_0^{|\mathbf q|} g(q', h) \, dq' \, dA, \qquad F = \frac{dW}{dv}

so that a flux which is off by a little changes it to second order only. That of the Newtonian film,
v u(x, y), gives

.. math:: F \approx \int u \, g(v u, h) \, dA

which is exact where the volume alone fixes the flux (disc, sphere, slot), and else 0.3 to 3 % high:
square, 4:1 rectangle, vented ring, disc with four vents, power laws of n = 0.3 to 1.5, Eyring. A
viscosity over pressure beside a law of exponent n turns the pressure p_0 of that film, taken for a
multiple of the Newtonian one, into that whose integral of dp/M^n is p_0: exact for a Newtonian law.

A solution of the law itself (`on_grid`) over the same sum on the sides of its cells corrects it,
with little of the error of the grid: where the volume fixes the flux both are equal on any.

=======  ==============================================  =====
symbol   quantity                                        unit
=======  ==============================================  =====
u        flux per width over the speed v                 m
g        pressure gradient that drives a flux            Pa/m
h        gap                                             m
M        viscosity over that at ambient pressure         -
=======  ==============================================  =====
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from attrs import evolve

from ..reynolds.discretisation import conductances
from ..reynolds.film import GridFilm
from ..reynolds.solve import unchecked_pressure
from .base import FlowLaw
from .closed_forms import slip_disc_factor
from .newtonian import Newtonian
from .on_grid import cell_flux, solve_from_flux

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ..reynolds.face import Face
    from ..reynolds.film import GridFilmState

    Array = NDArray[np.floating[Any]]

__all__ = ["UnitFlow", "solution_ratio", "tensions", "unit_flow"]

_RATES, _DECADES = 40, 6
"""Groups of cells in a decade of the rate of shear, which leave 1e-4 of a power law of n =
1.5 and 3e-5 of n = 0.6, and decades below the fastest that have groups of their own."""
_GAPS = 20  # groups in a decade of the gap
_PRESSURES = 200  # groups of cells of nearly the same pressure: they leave 1e-5 of Barus' law


class UnitFlow(NamedTuple):
    """Newtonian film on a face at unit viscosity and opening speed, in groups of cells."""

    force: float
    """Force over viscosity and speed [m]."""
    flux: Array
    """Flux per width over speed of each group of cells of one rate of shear, shape (n,) [m]."""
    gap: Array
    """Gap there, shape (n,) [m]."""
    weight: Array
    """Integral of the flux over the speed there, shape (n,) [m3]."""
    pressure: Array
    """Tension over force of each group of cells of one pressure, shape (m,) [1/m2]."""
    area: Array
    """Area of these, shape (m,) [m2]."""
    state: GridFilmState | None
    """The film itself, of an even face at a gap of 1 m without slip; for `solution_ratio` alone."""

    def even(self, gap: float, slip_length: tuple[float, float]) -> UnitFlow:
        """Flow of an even face at a gap [m] and slip lengths [m], from that at 1 m without slip.

        Examples
        --------
        >>> from contactkit.lubrication.reynolds.face import rasterise
        >>> from contactkit.scene.planforms import Disc
        >>> face = rasterise(Disc(radius=1.0), 16)
        >>> flow = unit_flow(face, np.ones(face.shape)).even(0.5, (0.1, 0.1))
        >>> round(flow.force / unit_flow(face, np.full(face.shape, 0.5), (0.1, 0.1)).force, 12)
        1.0
        """
        force = self.force / gap**3 * float(slip_disc_factor(gap, *slip_length))
        return self._replace(force=force, gap=np.full_like(self.gap, gap))


def unit_flow(face: Face, gap: Array, slip_length: tuple[float, float] = (0.0, 0.0)) -> UnitFlow:
    """Flow of a Newtonian film at unit viscosity and speed, by one linear solution.

    Parameters
    ----------
    face : Face
        The face, with one pressure all around.
    gap : ndarray, shape (ny, nx)
        Gap [m].
    slip_length : (float, float)
        Slip lengths of both walls [m].

    Raises
    ------
    InfeasibleError
        If some liquid has no way to a reservoir.

    Examples
    --------
    >>> from contactkit.lubrication.reynolds.face import rasterise
    >>> from contactkit.scene.planforms import Disc
    >>> face = rasterise(Disc(radius=1.0), 48)
    >>> flow = unit_flow(face, np.ones(face.shape))
    >>> abs(flow.force / (1.5 * np.pi) - 1.0) < 3e-3
    True
    """
    # The gap of the same conductivity without slip.
    height = gap * np.cbrt(1.0 / slip_disc_factor(gap, *slip_length))
    # Multigrid stops short of round-off where the gap has a step.
    state = unchecked_pressure(GridFilm(face=face, viscosity=1.0), height, 1.0, solver="superlu")
    cells, inside = cell_flux(state), face.loaded
    flux, h = cells[inside], gap[inside]
    weight, rate = flux * face.cell_area, flux / (h * h)
    group = _groups(rate, h if max(slip_length) > 0.0 else np.ones_like(h))
    moment = np.bincount(group, weight / h)
    kept = moment > 0.0
    mean_rate = np.bincount(group, weight / h * rate)[kept] / moment[kept]
    mean_gap = np.bincount(group, weight)[kept] / moment[kept]
    tension = np.sort(-state.pressure[inside]) / state.force
    starts = np.unique(np.arange(_PRESSURES) * tension.size // _PRESSURES)
    count = np.diff(np.append(starts, tension.size))
    return UnitFlow(
        force=state.force,
        flux=mean_rate * mean_gap**2,
        gap=mean_gap,
        weight=moment[kept] * mean_gap,
        pressure=np.add.reduceat(tension, starts) / count,
        area=count * face.cell_area,
        state=state,
    )


def _groups(rate: Array, gap: Array) -> NDArray[np.intp]:
    """Number of the group of each cell of a rate [m-1], and of a gap [m] where the liquid slips."""
    with np.errstate(divide="ignore"):
        fall = np.minimum(np.log10(rate.max() / rate), _DECADES)
    rise = (_GAPS * np.log10(gap / gap.min())).astype(int)
    return np.asarray((_RATES * fall).astype(int) + (_RATES * _DECADES + 1) * rise)


def tensions(flow: UnitFlow, law: FlowLaw, viscosity: float, speed: Array) -> Array:
    """Tensions [Pa] of the groups of cells of a film of any flow law, estimated from the flux.

    Parameters
    ----------
    flow : UnitFlow
        Newtonian film at the gap, with the slip of the law.
    law : FlowLaw
        The law.
    viscosity : float
        Viscosity at rest and ambient pressure [Pa.s]: that of a law without such a limit is any
        number that gives the order of the pressure.
    speed : ndarray, shape (m,)
        Opening speeds [m/s], not 0; negative while the gap closes.

    Returns
    -------
    ndarray, shape (m, k)
        Tensions below ambient, of which the force is the product with ``flow.area``; -inf where no
        pressure closes the gap so fast.

    Examples
    --------
    >>> from contactkit.lubrication.flow_laws.closed_forms import power_law_disc_force
    >>> from contactkit.lubrication.flow_laws.power_law import PowerLaw
    >>> from contactkit.lubrication.reynolds.face import rasterise
    >>> from contactkit.scene.planforms import Disc
    >>> face = rasterise(Disc(radius=3e-3), 48)
    >>> flow = unit_flow(face, np.full(face.shape, 1e-5))
    >>> found = tensions(flow, PowerLaw(consistency=0.1, exponent=0.5), 0.1, np.array([1e-3]))
    >>> round(float(found[0] @ flow.area) / power_law_disc_force(3e-3, 1e-5, 1e-3, 0.1, 0.5), 2)
    1.0
    """
    flux, h = np.abs(speed)[:, None] * flow.flux, flow.gap
    linear = Newtonian(viscosity=viscosity, slip_length=law.slip_length)
    shear = evolve(law, pressure_law=None)
    moved = shear.flow(flux, h)
    gradient = 2.0 * moved.drive / h
    work = gradient @ flow.weight
    force = viscosity * speed * flow.force * work / (linear.gradient(flux, h) @ flow.weight)
    found = force[:, None] * flow.pressure
    if law.pressure_law is None:
        return np.asarray(found)
    exponents = (gradient * moved.exponent) @ flow.weight / work
    changed = [
        law.pressure_law.to_power(n).pressure_of(-one)
        for n, one in zip(exponents.tolist(), found, strict=True)
    ]
    return -np.array(changed)


def solution_ratio(
    flow: UnitFlow, law: FlowLaw, gap: Array, speed: float, rtol: float = 1e-5
) -> float:
    """Force of a film of any law over its estimate without pressure [-], both on one grid.

    Parameters
    ----------
    flow : UnitFlow
        The Newtonian film, with its state.
    law : FlowLaw
        The law.
    gap : ndarray, shape (ny, nx)
        Gap [m].
    speed : float
        Opening speed [m/s], not 0.
    rtol : float
        See `on_grid.solve_on_grid`.

    Raises
    ------
    InfeasibleError
        If no pressure closes the gap so fast.
    ConvergenceError
        If the iteration does not settle.

    Notes
    -----
    Its error is that of the difference to 1, by the grid: with 64 cells across the faces above
    4e-4 of a power law of n = 0.6, 1e-3 of n = 0.3; around a hole 5e-3 of the latter.

    Examples
    --------
    >>> from contactkit.lubrication.flow_laws.power_law import PowerLaw
    >>> from contactkit.lubrication.reynolds.face import rasterise
    >>> from contactkit.scene.planforms import Disc, Rectangle
    >>> law = PowerLaw(consistency=0.1, exponent=0.5)
    >>> for planform in (Disc(radius=1e-3), Rectangle(length=2e-3, width=2e-3)):
    ...     face = rasterise(planform, 32)
    ...     gap = np.full(face.shape, 1e-5)
    ...     print(round(solution_ratio(unit_flow(face, gap), law, gap, 1e-3), 3))
    1.0
    0.993
    """
    assert flow.state is not None
    face, cells = flow.state.film.face, cell_flux(flow.state)
    film = solve_from_flux(face, law, gap, speed, abs(speed) * cells, rtol=rtol)
    return film.force / _side_force(flow.state, evolve(law, pressure_law=None), cells, gap, speed)


def _side_force(
    state: GridFilmState, law: FlowLaw, cells: Array, gap: Array, speed: float
) -> float:
    """Force [N] by the power that the Newtonian flux through the sides of the cells dissipates."""
    balance: Any = state.balance
    sides, rim, p = balance.mesh.sides, balance.mesh.rim, state.pressure.ravel()
    inside = state.film.face.loaded & (cells > 0.0)
    flux, h = np.where(inside, abs(speed) * cells, 1.0), np.where(inside, gap, 1.0)
    conductivity = np.where(inside, flux / law.gradient(flux, h), 1.0)
    inner, outer = conductances(balance.mesh, conductivity.ravel())
    through = balance.inner * (p[sides.high] - p[sides.low])
    driven = balance.outer * (p[rim.beyond] - p[rim.cell])
    out = driven if state.excess is None else driven + state.excess
    return speed * float((through * through / inner).sum() + (out * driven / outer).sum())
