r"""Stresses under a sliding sphere: Hertz pressure and proportional traction (Hamilton).

z points into the solid, tension is positive, components are ordered xx, yy, zz, xy, xz, yz. The
slider moves in +x and drags the solid with q_x = +mu p, so that the surface is in tension at the
trailing edge x = -a.

Hertz's pressure is that of point sources spread over the imaginary depths z = 0 .. i a:
its transform is :math:`(p_0 / a \alpha) \int_0^a t \sin(\alpha t) dt`. Every potential of the
half-space is then an elementary function of one complex length at the end of that line,

.. math:: \zeta = z - i a, \qquad \rho = \sqrt{r^2 + \zeta^2}, \qquad m = 1 / (\zeta + \rho),

the other end being real. With H the potential of transform
:math:`\hat p\, e^{-\alpha z} / \alpha^2`, P = H_zz the harmonic continuation of p and K_z = -H,

.. math:: \sigma_{ij} = -2 \nu P \delta_{ij} + (1 - 2 \nu) H_{,ij} + z H_{,zij}, \qquad
          \sigma_{iz} = z P_{,i}, \qquad \sigma_{zz} = -P + z P_{,z}

belong to the pressure (i, j = x, y), and to a traction of the same form in x

.. math:: \sigma_{xx} = -2 (1 + \nu) H_{,zx} + 2 \nu K_{,xxx} + z H_{,xxx}, \quad
          \sigma_{yy} = -2 \nu H_{,zx} + 2 \nu K_{,xyy} + z H_{,xyy}, \quad
          \sigma_{xy} = -H_{,zy} + 2 \nu K_{,xxy} + z H_{,xxy},

.. math:: \sigma_{zz} = z P_{,x}, \quad \sigma_{xz} = -P + z H_{,zxx}, \quad
          \sigma_{yz} = z H_{,zxy}.

Nothing cancels on the axis or at the edge of the contact.

References
----------
.. [1] G. M. Hamilton, Proc. Instn Mech. Engrs 197C (1983) 53-59: the field in real terms.
.. [2] G. M. Hamilton and L. E. Goodman, J. Appl. Mech. 33 (1966) 371-376: maxima on the surface.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

__all__ = ["stress", "trailing_edge_stress"]

Array = NDArray[np.float64]


def stress(
    x: ArrayLike,
    y: ArrayLike,
    z: ArrayLike,
    contact_radius: float,
    peak_pressure: float,
    poisson_ratio: float,
    friction_coefficient: float = 0.0,
) -> Array:
    """Stress [Pa] in the half-space under a sphere that slides in +x.

    Parameters
    ----------
    x, y, z : array_like, broadcast to one another
        Place [m]; z >= 0, and at z = 0 the limit from inside the solid.
    contact_radius, peak_pressure : float
        Of the Hertz contact [m], [Pa].
    poisson_ratio : float
        Of the half-space [-].
    friction_coefficient : float
        Ratio of traction to pressure [-]; negative if the slider moves in -x.

    Returns
    -------
    ndarray, shape (6, ...)
        xx, yy, zz, xy, xz, yz.

    Notes
    -----
    The pressure is Hertz's also where there is friction (Goodman's approximation, exact for two
    bodies of the same Poisson ratio and shear modulus, and for incompressible on rigid). At a large
    distance r the relative error is r/a squared times the round-off.

    Examples
    --------
    >>> stress(0.0, 0.0, [0.0, 0.5], 1.0, 1.0, 0.3).round(4)[[0, 2]]
    array([[-0.8   , -0.1804],
           [-1.    , -0.8   ]])
    """
    x, y, z = (np.asarray(v, dtype=float) for v in np.broadcast_arrays(x, y, z))
    q = _potentials(np.hypot(x, y), z, contact_radius, peak_pressure)
    out = _pressed(x, y, z, poisson_ratio, q)
    if friction_coefficient != 0.0:
        out += friction_coefficient * _dragged(x, y, z, poisson_ratio, q)
    return out


def trailing_edge_stress(
    peak_pressure: float, poisson_ratio: float, friction_coefficient: float
) -> float:
    r"""Largest tension [Pa], xx at the trailing edge of the contact.

    .. math:: \frac{\sigma_{xx}}{p_0} = \frac{1 - 2\nu}{3} + \frac{(4 + \nu) \pi \mu}{8}

    References
    ----------
    .. [1] G. M. Hamilton and L. E. Goodman, J. Appl. Mech. 33 (1966) 371-376.

    Examples
    --------
    >>> round(trailing_edge_stress(1.0, 0.3, 0.25), 4)
    0.5555
    """
    pressed = (1.0 - 2.0 * poisson_ratio) / 3.0
    return peak_pressure * (pressed + (4.0 + poisson_ratio) * math.pi * friction_coefficient / 8.0)


class _Potentials(NamedTuple):
    """Radial derivatives: a number k behind a letter is (1/r d/dr)^k; Z is d/dz; w times z."""

    P: Array
    wPZ: Array  # z P_z
    wP1: Array  # z P_r / r
    H1: Array
    H2: Array
    wH3: Array
    HZ1: Array
    wHZ2: Array
    K2: Array
    K3: Array


def _potentials(r: Array, z: Array, a: float, p0: float) -> _Potentials:
    """Derivatives of the potentials for the stresses."""
    zeta = np.empty(r.shape, dtype=complex)
    zeta.real, zeta.imag = z, -a
    square = np.empty_like(zeta)
    # On the surface the imaginary part is minus zero, which puts the root on the right side.
    square.real, square.imag = r**2 + (z - a) * (z + a), -2.0 * a * z
    rho = np.sqrt(square)
    m = 1.0 / (zeta + rho)
    log = -np.log(m)
    edge = rho == 0.0
    w = np.where(edge, 0.0, z / np.where(edge, 1.0, rho))  # z / rho, which vanishes at the edge
    r2m2 = r**2 * m**2
    values = (
        z * log - rho,
        z * log + 1j * a * w,
        m * (1j * a * w - z),
        m * (rho**2 + rho * zeta + zeta**2) / 3.0 - 0.5 * z * (m * zeta + log),
        m * (0.5 - r2m2 / 6.0 - 0.5 * z * m),
        m**3 * (1j * a * w - z / 3.0),
        m * (0.5 * zeta - z) - 0.5 * log,
        m**2 * (1j * a * w - 0.5 * z),
        -(log / 8.0 + r2m2**2 / 32.0 + z * m * (0.25 + r2m2 / 12.0)),
        -(m**3 * (0.5 * zeta - z / 3.0) + r2m2 * m**2 / 8.0),
    )
    return _Potentials(*(p0 / a * value.imag for value in values))


def _pressed(x: Array, y: Array, z: Array, nu: float, q: _Potentials) -> Array:
    """Stress of the pressure."""
    n = 1.0 - 2.0 * nu
    round_part = -2.0 * nu * q.P + n * q.H1 + z * q.HZ1
    pointed = n * q.H2 + q.wHZ2
    return np.array(
        [
            round_part + x * x * pointed,
            round_part + y * y * pointed,
            -q.P + q.wPZ,
            x * y * pointed,
            x * q.wP1,
            y * q.wP1,
        ]
    )


def _dragged(x: Array, y: Array, z: Array, nu: float, q: _Potentials) -> Array:
    """Stress of a traction in x of the same form as the pressure."""
    second = 2.0 * nu * q.K2 + z * q.H2
    third = 2.0 * nu * q.K3 + q.wH3
    return np.array(
        [
            x * (-2.0 * (1.0 + nu) * q.HZ1 + 3.0 * second + x * x * third),
            x * (-2.0 * nu * q.HZ1 + second + y * y * third),
            x * q.wP1,
            y * (-q.HZ1 + second + x * x * third),
            -q.P + z * q.HZ1 + x * x * q.wHZ2,
            x * y * q.wHZ2,
        ]
    )
