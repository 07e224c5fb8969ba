r"""Squeezed axisymmetric film of any flow law: its pressure is one integral from the rim inwards.

Conservation of volume gives the flux at each radius, whatever the liquid:

.. math:: q = \tfrac12 r v, \qquad p(r) = p_{rim} - \int_r^a g(q, h, p) \, dr, \qquad
          F = \int_0^a \pi r^2 g \, dr

with g of `FlowLaw.gradient`. The variable is the logarithm of the radius, in which films of
gaps and rates of many scales are smooth, with Gauss-Legendre panels. Where the viscosity depends
on the pressure, the nodes of all panels are one collocation system, solved by Newton's method.
"""

from __future__ import annotations

import math
from functools import lru_cache
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from ...errors import ConvergenceError, DescriptionError
from ...numerics.quadrature import gauss_legendre
from .base import FlowLaw, plain
from .gap_flow import GapFlow
from .pressure_laws import PressureLaw
from .walls import Flats, Walls

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    Array = NDArray[np.floating[Any]]

__all__ = ["SqueezedFilm", "squeeze_film", "squeeze_force"]

# Outside the core the rate under a sphere falls as r^-3, so that the branch points of Carreau's law
# (a = 2) lie at a height of pi/6 over the logarithm of the radius. Panels of 0.8 with ten nodes
# leave 1e-9 there, and 1e-12 of the other laws.
_PANEL = 0.8
NODES = 10
# Within the core the force falls as exp(3 x): panels may grow, and exp(-34) is left out.
_INNER = (2.4, 2.4, 1.6, 1.6, 0.8, 0.8, 0.8)
_FAR = 25.0  # logarithms beyond the core, where a film without a rim ends
_TOGETHER = 256  # pairs solved at once, for memory
_MOST = 80  # iterations of Newton's method
_MOST_HALVINGS = 50
_OVERFLOW = 300.0  # of the logarithm of the viscosity ratio


class SqueezedFilm(NamedTuple):
    """A squeezed film at pairs of gap and speed, of shape (...)."""

    force: Any
    """Force that resists [N]: positive where the gap opens, inf where no film closes so fast."""
    centre_pressure: Any
    """Pressure on the axis, relative to ambient [Pa]."""
    radius: Array
    """Nodes from the axis to the rim, shape (..., n) [m]."""
    gap: Array
    """Gap there [m]."""
    pressure: Array
    """Pressure there, relative to ambient [Pa]."""
    gradient: Array
    """Magnitude of the pressure gradient there [Pa/m]."""
    wall_stress: Array
    """Larger wall stress there [Pa]."""
    wall_shear_rate: Array
    """Larger shear rate at a wall there [1/s]."""


def squeeze_force(
    law: FlowLaw,
    walls: Walls,
    gap: ArrayLike,
    speed: ArrayLike,
    rim_radius: ArrayLike,
    rim_pressure: ArrayLike = 0.0,
) -> Any:
    """Force [N] of a squeezed film; see `squeeze_film`.

    Examples
    --------
    >>> from contactkit.lubrication.flow_laws.newtonian import Newtonian
    >>> from contactkit.lubrication.flow_laws.walls import Flats
    >>> from contactkit.lubrication.squeeze_film import disc_force
    >>> force = squeeze_force(Newtonian(viscosity=0.1), Flats(), 1e-5, 1e-3, 3e-3)
    >>> round(force / disc_force(3e-3, 1e-5, 1e-3, 0.1), 12)
    1.0
    """
    return squeeze_film(law, walls, gap, speed, rim_radius, rim_pressure).force


def squeeze_film(
    law: FlowLaw,
    walls: Walls,
    gap: ArrayLike,
    speed: ArrayLike,
    rim_radius: ArrayLike,
    rim_pressure: ArrayLike = 0.0,
) -> SqueezedFilm:
    """Pressure and force of a squeezed axisymmetric film.

    Parameters
    ----------
    law : FlowLaw
        Flow law of the liquid and slip at the walls.
    walls : Walls
        Shape of the gap.
    gap : float or ndarray, shape (...)
        Gap at the axis, positive [m].
    speed : float or ndarray, shape (...)
        Opening speed [m/s]; negative closes.
    rim_radius : float or ndarray, shape (...)
        Radius of the film [m]; that of a film of a given volume is ``walls.rim_radius``. It may be
        inf under a sphere, if the law is Newtonian at rest.
    rim_pressure : float or ndarray, shape (...)
        Pressure of the liquid at the rim, relative to ambient [Pa]. It sets the viscosity; its own
        pull on the walls is not part of the force.

    Returns
    -------
    SqueezedFilm
        Force, and the film at the nodes of the quadrature.

    Raises
    ------
    DescriptionError
        If a gap is not positive, or a film without a rim has no finite force.

    Notes
    -----
    The error of force and pressure at the axis is 1e-10 for smooth laws and gaps, 1e-7 at the kink
    of a power law with a plateau. Where a pressure law stiffens a closing film without bound, no
    pressure carries the flux: the force is -inf (also where the viscosity would grow by exp(300)).
    Valid for a film that is full, far thinner than wide, without inertia and compression.

    References
    ----------
    Scott (1931), for a power law between flats; Bird, Armstrong and Hassager (1987), Example 4.2-7.

    Examples
    --------
    A power law against Scott's closed form:

    >>> from contactkit.lubrication.flow_laws.power_law import PowerLaw
    >>> from contactkit.lubrication.flow_laws.walls import Flats
    >>> film = squeeze_film(PowerLaw(consistency=2.0, exponent=0.5), Flats(), 1e-4, 1e-3, 5e-3)
    >>> scott = 2 * math.pi * 2.0 / 1e-4 * (4.0 * 1e-3 / 1e-8) ** 0.5 * 5e-3**3.5 / 3.5
    >>> round(film.force / scott, 12)
    1.0
    """
    given = (gap, speed, rim_radius, rim_pressure)
    arrays = np.broadcast_arrays(*(np.asarray(one, dtype=float) for one in given))
    h, v, rim, outside = (one.ravel() for one in arrays)
    _check(law, walls, h, rim)
    rim = np.where(np.isfinite(rim), rim, walls.core(h, rim) * math.exp(_FAR))
    parts = []
    for start in range(0, max(h.size, 1), _TOGETHER):
        some = slice(start, start + _TOGETHER)
        parts.append(_solve(law, walls, h[some], v[some], rim[some], outside[some]))
    widest = max(part.radius.shape[1] for part in parts)
    joined = (_joined([part[i] for part in parts], widest) for i in range(len(parts[0])))
    shape = arrays[0].shape
    shaped = [one.reshape(shape + one.shape[1:]) for one in joined]
    return SqueezedFilm(plain(shaped[0]), plain(shaped[1]), *shaped[2:])


def _check(law: FlowLaw, walls: Walls, gap: Array, rim: Array) -> None:
    """Refuse what has no finite force."""
    if not ((gap > 0.0) & np.isfinite(gap)).all():
        wrong = float(gap[~((gap > 0.0) & np.isfinite(gap))][0])
        raise DescriptionError("gap", wrong, "be positive and finite", unit="m")
    if np.isinf(rim).any() and (isinstance(walls, Flats) or not law.is_newtonian_at_rest):
        cure = "give the radius at which the film ends: a power law goes on flowing far outside"
        cure = "flats have no force without a rim" if isinstance(walls, Flats) else cure
        raise DescriptionError("rim_radius", math.inf, "be finite", unit="m", hint=cure)


def _joined(parts: list[Array], widest: int) -> Array:
    """Blocks of pairs one after the other; blocks of fewer nodes repeat the one at the axis."""
    if parts[0].ndim == 1:
        return np.concatenate(parts)
    filled = [np.pad(one, ((0, 0), (widest - one.shape[1], 0)), mode="edge") for one in parts]
    return np.concatenate(filled)


@lru_cache(maxsize=32)
def _rule(panels: int) -> tuple[Array, Array, Array]:
    """Nodes of panels of unit length, their weights, and integrals from each node to the end."""
    nodes, weights = (np.array(one) for one in gauss_legendre(NODES))
    # Within a panel: Lagrange polynomials of the nodes, integrated from a node to the end.
    inverse = np.linalg.inv(np.polynomial.legendre.legvander(2.0 * nodes - 1.0, NODES - 1))
    inner = np.empty((NODES, NODES))
    for i, node in enumerate(nodes):
        x = node + (1.0 - node) * nodes
        basis = np.polynomial.legendre.legvander(2.0 * x - 1.0, NODES - 1) @ inverse
        inner[i] = (1.0 - node) * weights @ basis
    later = np.kron(np.triu(np.ones((panels, panels)), 1), np.ones((NODES, 1)))
    matrix = np.kron(np.eye(panels), inner) + np.kron(later, weights)
    return np.tile(nodes, panels), np.tile(weights, panels), matrix


def _widths(spread: Array, halvings: int) -> Array:
    """Widths of the panels from the axis to the rim, shape (m, panels), in ln(radius).

    `spread` is ln(rim/core), shape (m,); the outermost panel is halved towards the rim. It begins
    within the core: one as narrow as a rim just beyond that would leave a layer there unresolved.
    """
    length = spread + _PANEL
    count = math.ceil(float(length.max(initial=_PANEL)) / _PANEL)
    outer = np.repeat(length[:, None] / count, count, axis=1)
    widths = np.hstack([np.broadcast_to(_INNER, (spread.size, len(_INNER))), outer])
    parts = 0.5 ** np.append(np.arange(1, halvings + 1), halvings)
    return np.hstack([widths[:, :-1], widths[:, -1:] * parts])


def _solve(
    law: FlowLaw, walls: Walls, gap: Array, speed: Array, rim: Array, outside: Array
) -> SqueezedFilm:
    """Films at pairs of gap and speed, shape (m,)."""
    core = walls.core(gap, rim)
    with np.errstate(divide="ignore", invalid="ignore"):
        spread = np.where(rim > core, np.log(rim / core), 0.0)
    halvings = _halvings(law, walls, gap, speed, rim)
    widths = _widths(spread, halvings)
    nodes, weights, matrix = _rule(widths.shape[1])
    wide = np.repeat(widths, NODES, axis=1)
    inside = np.repeat(np.cumsum(widths[:, ::-1], axis=1)[:, ::-1], NODES, axis=1)
    logarithm = wide * nodes - inside
    radius = rim[:, None] * np.exp(logarithm)
    height = gap[:, None] + walls.rise(radius)
    flux = 0.5 * radius * np.abs(speed)[:, None]
    sign = np.sign(speed)
    step = wide * radius  # dr over that of a panel of unit length
    pressure, flow = _pressures(law, flux, height, outside, (sign, step, matrix))
    gradient = 2.0 * flow.drive / height
    force = math.pi * sign * ((radius**2 * gradient * step) @ weights)
    # Within the first node the gradient is a power of the radius.
    moves = speed != 0.0
    rise = np.log(np.where(moves, gradient[:, 1], 1.0) / np.where(moves, gradient[:, 0], 1.0))
    power = 1.0 + rise / (logarithm[:, 1] - logarithm[:, 0])
    centre = pressure[:, 0] - sign * gradient[:, 0] * radius[:, 0] / power
    blocked: Any = ~np.isfinite(pressure).all(axis=1)
    rate = flow.wall_rate / law.multiplier(np.where(blocked[:, None], 0.0, pressure))
    force = np.where(blocked, -math.inf, force)
    centre = np.where(blocked, math.inf, centre)
    return SqueezedFilm(force, centre, radius, height, pressure, gradient, flow.wall_stress, rate)


def _halvings(law: FlowLaw, walls: Walls, gap: Array, speed: Array, rim: Array) -> int:
    """Halvings of the outermost panel: a viscosity that follows the pressure has a layer there.

    Between flats the pressure of Barus' law is a logarithm of r^2/a^2 - 1 - 1/(alpha A).
    """
    if law.pressure_law is None:
        return 0
    height = gap + walls.rise(rim)
    flow = law.flow(0.5 * rim * np.abs(speed), height, 0.0)
    fall = 2.0 * flow.drive / height * rim
    steep = float((law.pressure_law.coefficient * flow.exponent * fall).max(initial=0.0))
    return min(max(math.ceil(math.log2(max(steep, 1.0) * _PANEL)) + 1, 0), _MOST_HALVINGS)


def _pressures(
    law: FlowLaw,
    flux: Array,
    height: Array,
    outside: Array,
    rule: tuple[Array, Array, Array],
) -> tuple[Array, GapFlow]:
    """Pressure at the nodes, and the flow there."""
    sign, step, matrix = rule
    inward = -sign[:, None]
    at_ambient = law.flow(flux, height, 0.0)
    fall = (2.0 * at_ambient.drive / height * step) @ matrix.T
    rim = outside[:, None]
    pressure = rim + inward * fall
    if law.pressure_law is None:
        return pressure, at_ambient
    # Barus' transformation of a power law: exact for these. A closing film starts below.
    stiff = law.pressure_law.coefficient * at_ambient.exponent
    opens = inward < 0.0
    if law.pressure_law.thins_in_tension:
        thinned = np.where(
            stiff > 0.0, np.log1p(stiff * fall) / np.where(stiff > 0.0, stiff, 1.0), fall
        )
        pressure = np.where(opens, rim - thinned, pressure)
    return _newton(law, flux, height, pressure, (rim, inward, step, matrix))


def _newton(
    law: FlowLaw, flux: Array, height: Array, pressure: Array, rule: tuple[Array, ...]
) -> tuple[Array, GapFlow]:
    """Newton's method for the pressure at the nodes; inf where there is none."""
    rim, inward, step, matrix = rule
    assert law.pressure_law is not None
    blocked = _is_beyond(law.pressure_law, pressure)
    pressure = np.where(blocked[:, None], rim, pressure)
    for _ in range(_MOST):
        flow = law.flow(flux, height, pressure)
        slope = 2.0 * flow.drive / height * step
        residual = rim + inward * (slope @ matrix.T) - pressure
        stiff = slope * flow.exponent * law.pressure_law.logarithm(pressure)[1]
        change = _volterra(residual, inward * stiff, matrix)
        pressure = pressure + change
        size = np.abs(pressure).max(axis=1)
        blocked |= _is_beyond(law.pressure_law, pressure)
        pressure = np.where(blocked[:, None], rim, pressure)
        if (blocked | (np.abs(change).max(axis=1) <= 1e-13 * size)).all():
            break
    else:
        raise ConvergenceError("the pressure of the film did not settle", pressure)
    flow = law.flow(flux, height, pressure)
    return np.where(blocked[:, None], math.inf, pressure), flow


def _is_beyond(law: PressureLaw, pressure: Array) -> Any:
    """Whether the viscosity of a film is beyond all measure somewhere."""
    known = np.isfinite(pressure)
    logarithm = law.logarithm(np.where(known, pressure, 0.0))[0]
    return (~known | (logarithm > _OVERFLOW)).any(axis=1)


def _volterra(right: Array, kernel: Array, matrix: Array) -> Array:
    """Solve x = right + matrix (kernel x) for each pair; panels are blocks of a triangular matrix.

    What lies between a panel and the rim enters by one number, its integral: all blocks are solved
    at once, for the right-hand side and for that number, which then is a sum from the rim inwards.
    """
    pairs, panels = right.shape[0], right.shape[1] // NODES
    block, weights = matrix[-NODES:, -NODES:], _rule(1)[1]
    k = kernel.reshape(pairs, panels, NODES)
    system = np.eye(NODES) - block * k[:, :, None, :]
    both = np.ones((pairs, panels, NODES, 2))
    both[..., 0] = right.reshape(k.shape)
    found = np.linalg.solve(system, both)
    gained = np.einsum("mpn,mpnc->mpc", k * weights, found)
    outside = np.zeros((pairs, panels))
    for panel in range(panels - 1, 0, -1):
        beyond = outside[:, panel]
        outside[:, panel - 1] = beyond + gained[:, panel, 0] + beyond * gained[:, panel, 1]
    return np.asarray(found[..., 0] + outside[:, :, None] * found[..., 1]).reshape(right.shape)
