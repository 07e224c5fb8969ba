r"""Stress and displacement under uniform round loads on a layered half-space, by quadrature.

A pressure q on a circle of radius a has the Hankel transform :math:`q a J_1(\alpha a)/\alpha`; a
field that is f for a unit pressure of wavenumber alpha becomes
:math:`q a \int J_1(\alpha a) f(\alpha) J_k(\alpha r) \, d\alpha`: k = 0 for what is the same in all
directions, and for stresses along and across the surface the mean of both with k = 0 and half of
their difference with k = 2. f is that of `contactkit.elasticity`.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.polynomial.legendre import leggauss
from numpy.typing import NDArray
from scipy.special import j0, j1, jv

from contactkit.elasticity.layered_fields import plane_states, unit_stresses

__all__ = ["fields", "strains"]

Array = NDArray[np.float64]


def fields(
    case: dict[str, Any], depths: Sequence[float] | Array, sides: Sequence[str], x: float
) -> Array:
    """Fields at a point (x, 0) of planes at depth, of all loads of a case.

    Parameters
    ----------
    case : dict
        Layers, `load_radius_m`, `load_pressure_Pa` and `load_centres_m`.
    depths, sides
        Planes, ascending; "-" is the material above an interface.
    x : float
        Coordinate along x [m].

    Returns
    -------
    ndarray (len(depths), 4)
        sigma_xx, sigma_yy, sigma_zz [Pa] and u_z [m]; tension positive.
    """
    layers = (case["young_modulus_Pa"], case["poisson_ratio"], case["thickness_m"])
    a, q = case["load_radius_m"], case["load_pressure_Pa"]
    offsets = [(x - cx, -cy) for cx, cy in case["load_centres_m"]]
    farthest = max(np.hypot(*offset) for offset in offsets)
    found = []
    for depth, side in zip(depths, sides, strict=True):
        alpha, weight = _nodes(a + farthest, 40.0 / max(depth, 1e-3 * a), sum(layers[2]) + a)
        state = next(plane_states(alpha, *layers, [depth], [side]))
        m = state.pressure.shape[1]
        across, along = unit_stresses(state).pressure
        lowered = state.pressure[1] / (2.0 * state.shear_modulus * alpha[:m])
        load = q * a * (weight * j1(alpha * a))[:m]
        total = np.zeros(4)
        for dx, dy in offsets:
            r = np.hypot(dx, dy)
            mean, second = load * j0(alpha[:m] * r), load * jv(2, alpha[:m] * r)
            radial, hoop = (
                0.5 * (np.sum((across + along) * mean) - sign * np.sum((across - along) * second))
                for sign in (1.0, -1.0)
            )
            cos2 = (dx / r) ** 2 if r > 0.0 else 0.5
            total += (
                radial * cos2 + hoop * (1.0 - cos2),
                radial * (1.0 - cos2) + hoop * cos2,
                np.sum(state.pressure[3] * mean),
                np.sum(lowered * mean),
            )
        found.append(total)
    return np.array(found)


def strains(stress: Array, young_modulus: float, poisson_ratio: float) -> Array:
    """Strains along x, y and z of stresses along them (..., 3)."""
    total = stress.sum(axis=-1, keepdims=True)
    return np.asarray(((1.0 + poisson_ratio) * stress - poisson_ratio * total) / young_modulus)


def _nodes(length: float, last: float, size: float) -> tuple[Array, Array]:
    """Wavenumbers and weights: panels from far below 1/size to half a wave of `length`."""
    step = 2.0 / length
    start = np.geomspace(1e-5 / size, step, 60)
    edges = np.concatenate([[0.0], start, np.arange(2.0 * step, last + step, step)])
    t, w = leggauss(8)
    half = 0.5 * np.diff(edges)[:, None]
    nodes = half * (t + 1.0) + edges[:-1, None]
    return nodes.ravel(), (half * w).ravel()
