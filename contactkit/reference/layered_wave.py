r"""Sinusoidal pressure on a layered half-space, by integration of the Riccati equation over depth.

z points into the solid, pressure is positive in compression. For one wave vector of length alpha
the displacements u = (U, W) and the stresses t = (T, S) obey

.. math:: u' = A u + B t, \qquad t' = M u - A^T t,

with coefficients of the layer (u_L = iU, u_z = W, sigma_Lz = iT, sigma_zz = S, L along the wave).
On u = -F t the compliance F of what lies below z obeys an equation of Riccati,

.. math:: F' = A F + F A^T - B + F M F,

which is stable in the upward direction: it is integrated from the substrate by a general-purpose
method, without a formula for a layer.

References
----------
.. [1] K. L. Johnson, Contact Mechanics (1985), Sec. 13.2: full contact of a wave.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

__all__ = ["compliance", "full_contact_pressure"]


def compliance(
    wavenumber: float,
    young_modulus: Sequence[float],
    poisson_ratio: Sequence[float],
    thickness: Sequence[float],
    tolerance: float = 1e-11,
) -> float:
    r"""Displacement amplitude per amplitude of a wave of pressure, C(alpha).

    Parameters
    ----------
    wavenumber : float
        alpha > 0 [1/m].
    young_modulus, poisson_ratio : sequence of float, length n_layers + 1
        Of the layers, top first, and of the substrate [Pa], [-].
    thickness : sequence of float, length n_layers
        Of the layers [m].
    tolerance : float
        Relative tolerance of a step of the integration.

    Returns
    -------
    float
        C [m/Pa], with an error of about ten times the tolerance; the cost grows with alpha times
        the thickness. Layers below alpha z = 40 are omitted.

    Examples
    --------
    >>> layered = compliance(1.0, [4.0, 1.0], [0.3, 0.3], [1.0])
    >>> round(layered, 9)
    1.021958301
    """
    depth = np.concatenate(([0.0], np.cumsum(thickness)))
    last = int(np.searchsorted(wavenumber * depth[1:], 40.0))
    shear = young_modulus[last] / (2.0 * (1.0 + poisson_ratio[last]))
    nu = poisson_ratio[last]
    # The unknown is alpha G F with G of the top layer, so that it has the size of one.
    top = young_modulus[0] / (2.0 * (1.0 + poisson_ratio[0]))
    f = top / shear * np.array([1.0 - nu, 0.5 - nu, 1.0 - nu])
    for j in reversed(range(last)):
        ratio = young_modulus[j] / (2.0 * (1.0 + poisson_ratio[j])) / top
        reach = wavenumber * thickness[j]
        scale = min(float(np.max(f)), 1.0 / ratio)  # the lesser of what lies below and the layer's
        rate = _climb(ratio, poisson_ratio[j])
        f = solve_ivp(
            rate, (0.0, reach), f, "DOP853", rtol=tolerance, atol=0.1 * tolerance * scale
        ).y[:, -1]
    return float(f[2] / (top * wavenumber))


def full_contact_pressure(
    amplitude: float,
    wavenumber: float,
    young_modulus: Sequence[float],
    poisson_ratio: Sequence[float],
    thickness: Sequence[float],
) -> float:
    r"""Mean pressure [Pa] of full contact of a rigid wave and a layered half-space.

    .. math:: p^* = D / C(\alpha)

    Parameters
    ----------
    amplitude : float
        Amplitude D of the wave [m].
    wavenumber : float
        alpha [1/m]: 2 pi / l for D cos(2 pi x / l), sqrt(2) times that for the product of two.
    young_modulus, poisson_ratio, thickness
        As of :func:`compliance`.

    Notes
    -----
    Above it the pressure is exactly p + p* cos, which is nowhere negative.

    Examples
    --------
    >>> round(full_contact_pressure(1.0, 2 * np.pi, [3.64, 0.91], [0.3, 0.3], [0.1]), 6)
    4.310691
    """
    return amplitude / compliance(wavenumber, young_modulus, poisson_ratio, thickness)


def _climb(shear: float, nu: float) -> Callable[[float, NDArray[np.float64]], list[float]]:
    """Derivative of the compliance (f11, f12, f22) by alpha times height."""
    side = nu / (1.0 - nu)
    stiff = 2.0 * shear / (1.0 - nu)

    def rate(_: float, f: NDArray[np.float64]) -> list[float]:
        f11, f12, f22 = (float(part) for part in f)
        return [
            2.0 * f12 + 1.0 / shear - stiff * f11 * f11,
            f22 - side * f11 - stiff * f11 * f12,
            (0.5 - nu) / (shear * (1.0 - nu)) - 2.0 * side * f12 - stiff * f12 * f12,
        ]

    return rate
