"""Displacements and tractions on planes at depth in a layered solid, in Fourier space.

Conventions, symbols and unknowns as in `layered`: z into the solid, tension positive; L along the
wave vector, T across it; ``u_L = iU, u_z = W, sigma_Lz = iT, sigma_zz = S, u_T = V, sigma_Tz = Q``.

In-plane stresses jump at an interface, so a plane there has two sides: "-" is the material above,
"+" the one below.  The compliance at the bottom of each layer is stored during the upward
recursion; the tractions then follow downward from the top of the layer to the plane, which is
treated as an interface within it.  Only decaying exponentials occur in both directions.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..errors import DescriptionError
from .depths import PlaneAt, Side, locate
from .layer_recursion import at_sliding_base, climb, climb_shear, cross, descend, products
from .layer_stack import Base, Stack, stack_of
from .layered import blocks, carried, lowest

__all__ = ["PlaneStates", "UnitStresses", "plane_states", "unit_stresses"]

Array = NDArray[np.float64]


class PlaneStates(NamedTuple):
    """States on one plane for unit loads on the surface, one column for each wavenumber.

    `pressure` and `traction` hold (2 G alpha U, 2 G alpha W, T, S) for S = -1 and T = -1 on the
    surface, `transverse` holds (G alpha V, Q) for Q = -1 there; G is that of the plane's material.
    """

    depth: float
    side: Side
    layer: int
    shear_modulus: float
    poisson_ratio: float
    pressure: Array
    traction: Array
    transverse: Array


def plane_states(
    wavenumber: ArrayLike,
    young_modulus: ArrayLike,
    poisson_ratio: ArrayLike,
    thickness: ArrayLike,
    depths: Sequence[float],
    sides: Sequence[str] | str = "+",
    *,
    base: Base | None = None,
    cutoff: float = np.inf,
) -> Iterator[PlaneStates]:
    """States on planes for unit pressure and unit tangential tractions, one plane at a time.

    Parameters
    ----------
    wavenumber : array_like, shape (n,)
        alpha > 0, ascending [1/m].
    young_modulus, poisson_ratio, thickness : array_like
        As in `layered.compliance`.
    depths, sides
        As in `locate`, the planes in order of layer and depth within it.
    base : {"bonded", "frictionless"}, optional
        As in `layered.compliance`.
    cutoff : float, optional
        Wavenumbers with alpha z above it are omitted on a plane; at 40 their contribution is below
        1e-15 of the load.

    Yields
    ------
    PlaneStates
        With the leading m <= n wavenumbers: arrays (4, m), (4, m) and (2, m).

    Raises
    ------
    DescriptionError
        As `layered.compliance` and `locate`; for wavenumbers or planes out of order.

    Notes
    -----
    Error below 1e-13 of the largest component on the plane for contrasts up to 1e3 and
    alpha z <= 40; it grows as alpha z times the unit round-off, like that of exp(-alpha z).

    Examples
    --------
    Under a pressure on a homogeneous solid S = -(1 + alpha z) exp(-alpha z):

    >>> states = next(plane_states([1.0], [1.0], [0.3], [], [2.0]))
    >>> print(np.round(states.pressure[3], 6), round(-3 * np.exp(-2.0), 6))
    [-0.406006] -0.406006
    """
    stack = stack_of(young_modulus, poisson_ratio, thickness, base)
    alpha = np.asarray(wavenumber, dtype=np.float64)
    if alpha.ndim != 1 or not np.all((alpha > 0.0) & (alpha < np.inf)):
        raise DescriptionError("plane_states.wavenumber", alpha.shape, "be positive, shape (n,)")
    if np.any(np.diff(alpha) < 0.0):
        raise DescriptionError("plane_states.wavenumber", alpha[0], "ascend", unit="1/m")
    planes = locate(depths, sides, stack.h, on_base=base is not None)
    if any(a[::2] > b[::2] for a, b in pairwise(planes)):
        raise DescriptionError("planes.depths", list(depths), "ascend", unit="m")
    return _descended(alpha, stack, planes, cutoff)


class UnitStresses(NamedTuple):
    """In-plane stresses per unit load [1].

    `pressure` and `traction` (2, m) hold sigma_LL and sigma_TT, `transverse` (m,) sigma_LT/i.
    """

    pressure: Array
    traction: Array
    transverse: Array


def unit_stresses(states: PlaneStates) -> UnitStresses:
    """In-plane stresses of the unit states, from U, V and S.

    ``sigma_LL = (nu S - 2 G alpha U)/(1 - nu)``, ``sigma_TT = nu (S - 2 G alpha U)/(1 - nu)`` and
    ``sigma_LT = i G alpha V``.

    Parameters
    ----------
    states : PlaneStates
        Of one plane.

    Returns
    -------
    UnitStresses
        Per unit load.

    Examples
    --------
    On the surface under a pressure: sigma_LL = -1, sigma_TT = -2 nu.

    >>> states = next(plane_states([1.0], [1.0], [0.3], [], [0.0]))
    >>> print(unit_stresses(states)[0].ravel())
    [-1.  -0.6]
    """
    nu = states.poisson_ratio
    ratio = nu / (1.0 - nu)

    def both(state: Array) -> Array:
        U, S = state[0], state[3]
        return np.stack([ratio * S - U / (1.0 - nu), ratio * (S - U)])

    return UnitStresses(both(states.pressure), both(states.traction), states.transverse[0])


# Downward -----------------------------------------------------------------------------------


def _descended(
    alpha: Array, stack: Stack, planes: list[PlaneAt], cutoff: float
) -> Iterator[PlaneStates]:
    # Upward once for all planes, downward from plane to plane: the cost is that of the layers plus
    # one part of a layer for each plane, not their product.
    tops = np.concatenate([[0.0], np.cumsum(stack.h)])
    bottoms = _bottoms(alpha, stack, [_reached(alpha, z, cutoff) for z in tops[1:]])
    # (-T, -S) for a unit pressure, the same for a unit traction, and -Q
    tau = np.zeros((5, alpha.size))
    tau[[1, 2, 4]] = 1.0
    layer = 0
    for z, side, j in planes:
        while layer < j:
            reached = _reached(alpha, tops[layer + 1], cutoff)
            tau = _led(alpha[:reached], stack, bottoms, layer, tau, stack.h[layer], 0.0)[1]
            layer += 1
        up = tops[j + 1] - z if j < stack.h.size else 0.0
        some = alpha[: _reached(alpha, z, cutoff)]
        if up == 0.0 and j == carried(stack) and stack.base == "frictionless":
            states = _on_sliding_base(some, stack, tau, z - tops[j])
        else:
            f, at = _led(some, stack, bottoms, j, tau, z - tops[j], up)
            pressure, traction = (_state(f, at[k], at[k + 1]) for k in (0, 2))
            states = [pressure, traction, np.stack([f[3] * at[4], -at[4]])]
        yield PlaneStates(z, side, j, float(stack.G[j]), float(stack.nu[j]), *states)


def _reached(alpha: Array, depth: float, cutoff: float) -> int:
    """Number of leading wavenumbers below the cut-off at a depth."""
    return int(np.searchsorted(alpha * depth, cutoff, side="right"))


def _bottoms(alpha: Array, stack: Stack, reached: list[int]) -> list[Array]:
    """f11, f12, f22, d, fs at the bottom of every layer but the lowest, in units of that layer.

    The recursion runs over all wavenumbers; a layer stores those that reach its top.
    """
    G, nu, h, _ = stack
    kept = [np.empty((5, size)) for size in [alpha.size, *reached][: carried(stack)]]
    for part in blocks(alpha.size):
        f, fs = lowest(alpha[part], stack)
        for j in reversed(range(carried(stack))):
            ratio, m, n = G[j] / G[j + 1], 1.0 / (1.0 - nu[j]), (1.0 - 2.0 * nu[j]) / (1.0 - nu[j])
            f, fs = cross(f, ratio), fs * ratio
            room = kept[j][:, part]
            for row, values in zip(room, (*f, fs), strict=True):
                row[:] = values[: row.size]
            if j:
                p = products(alpha[part] * h[j])
                f, fs = climb(p, f, m, n), climb_shear(p, fs)
    return kept


def _led(
    alpha: Array, stack: Stack, bottoms: list[Array], j: int, tau: Array, down: float, up: float
) -> tuple[Array, Array]:
    """Compliance (f11, f12, f22, fs) and tractions on a plane of layer j.

    `tau` holds the tractions at the top of the layer; the plane is `down` below its top and `up`
    above its bottom.
    """
    nu = float(stack.nu[j])
    m, n = 1.0 / (1.0 - nu), (1.0 - 2.0 * nu) / (1.0 - nu)
    f_out, out = np.empty((4, alpha.size)), np.empty((5, alpha.size))
    for part in blocks(alpha.size):
        a, above = alpha[part], tau[:, part][:, : part.stop - part.start]
        if j < carried(stack):
            f11, f12, f22, d, fs = bottoms[j][:, part][:, : a.size]
            f = f11, f12, f22, d
        else:
            f, fs = lowest(a, stack, up)
        if up > 0.0 and j < carried(stack):
            p = products(a * up)
            f, fs = climb(p, f, m, n), climb_shear(p, fs)
        f_out[:3, part], f_out[3, part] = f[:3], fs
        if down > 0.0:
            x = a * down
            t11, t12, t21, t22, ts = descend(x, products(x), f, fs, m, n)
            for k in (0, 2):
                out[k, part] = t11 * above[k] + t12 * above[k + 1]
                out[k + 1, part] = t21 * above[k] + t22 * above[k + 1]
            out[4, part] = ts * above[4]
        else:
            out[:, part] = above
    return f_out, out


def _on_sliding_base(alpha: Array, stack: Stack, tau: Array, down: float) -> list[Array]:
    """States on a frictionless base, `down` below the top of its layer: no W, T and Q there."""
    m, n = 1.0 / (1.0 - stack.nu[-1]), (1.0 - 2.0 * stack.nu[-1]) / (1.0 - stack.nu[-1])
    states = [np.zeros((rows, alpha.size)) for rows in (4, 4, 2)]
    for part in blocks(alpha.size):
        x, above = alpha[part] * down, tau[:, part]
        at = at_sliding_base(x, products(x), m, n)
        for k, state in zip((0, 2), states[:2], strict=True):
            first, second = above[k : k + 2, : x.size]
            state[0, part] = at.u1 * first + at.u2 * second
            state[3, part] = -(at.s1 * first + at.s2 * second)
        states[2][0, part] = at.v * above[4, : x.size]
    return states


def _state(f: Array, first: Array, second: Array) -> Array:
    return np.stack([f[0] * first + f[1] * second, f[1] * first + f[2] * second, -first, -second])
