r"""Linear response of a film between deforming bodies: storage and loss moduli.

A gap that vibrates as :math:`z + z_1 e^{i \omega t}`, of small z_1, meets the force
:math:`F_1 = (G' + i G'') z_1` against its motion, where G' is that of the bodies and G'' that of
the film. With the flow matrix L of the gap at rest, areas A and compliance K,

.. math:: (L + i \omega A K)\,p_1 = -i \omega A\,z_1, \qquad F_1 = -2 \pi A \cdot p_1

Full film of constant viscosity, small amplitudes; no cavities, no inertia of the liquid.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...numerics.blas import one_thread
from .mesh import RingMesh, Tridiagonal

__all__ = [
    "FLAT_STORAGE",
    "SPHERE_STORAGE",
    "Modulus",
    "extrapolated",
    "flat_stiff_limit",
    "modulus",
    "sphere_crossover_gap",
    "sphere_stiff_limit",
]

Array = NDArray[np.float64]

SPHERE_STORAGE = 27.0 * math.pi**3 / 2.0**3.5
"""Storage modulus of a sphere, 73.99, in units of (eta omega)^2 R^3.5/(E* D^2.5), far from it."""
FLAT_STORAGE = 512.0 / 35.0
"""The same of a flat disc, 14.63, in units of (eta omega)^2 R^7/(E* h^6)."""


class Modulus(NamedTuple):
    """Storage and loss modulus [N/m] over the frequencies, (n,), and their error [N/m]."""

    storage: Array
    loss: Array
    error: Array


@one_thread()
def modulus(
    mesh: RingMesh, gap: Array, compliance: Array, viscosity: float, frequencies: Sequence[float]
) -> NDArray[np.complex128]:
    """G' + i G'' on a mesh, of second order in its elements.

    Parameters
    ----------
    mesh : RingMesh
        Nodes [m]; ambient pressure at the last.
    gap : ndarray, shape (n + 1,)
        At rest, at the nodes [m].
    compliance : ndarray, shape (n + 1, n + 1)
        Of both bodies [m/Pa].
    viscosity : float
        [Pa.s]
    frequencies : sequence of float
        Angular frequencies [rad/s].

    Returns
    -------
    ndarray of complex, shape (len(frequencies),)
        [N/m]
    """
    flow, _, _ = mesh.conductance(gap)
    matrix = Tridiagonal.of_elements(flow, -flow, -flow, flow).dense()[:-1, :-1] / viscosity
    areas = mesh.areas[:-1]
    pressed = areas[:, None] * compliance[:-1, :-1]
    found = np.empty(len(frequencies), dtype=complex)
    for k, omega in enumerate(frequencies):
        pressure = np.linalg.solve(matrix + 1j * omega * pressed, -1j * omega * areas)
        found[k] = -2.0 * math.pi * (areas @ pressure)
    return found


def extrapolated(*meshes: NDArray[np.complex128]) -> Modulus:
    """Richardson extrapolation of the moduli of three meshes, each of twice the elements.

    The error is a quarter of the difference of the two extrapolations; of fourth order, it would be
    a fifteenth.
    """
    coarse, middle, fine = meshes
    found = fine + (fine - middle) / 3.0
    before = middle + (middle - coarse) / 3.0
    return Modulus(found.real.copy(), found.imag.copy(), 0.25 * np.abs(found - before))


def sphere_crossover_gap(
    radius: float, modulus: float, viscosity: float, frequency: float
) -> float:
    r"""Gap [m] below which a sphere and a flat take up the motion of a film at a frequency.

    .. math:: D_c = 8 R \left( \frac{\eta \omega}{E^*} \right)^{2/3}

    Parameters
    ----------
    radius, modulus, viscosity, frequency : float
        R [m], E* [Pa], eta [Pa.s] and omega [rad/s].

    References
    ----------
    .. [1] S. Leroy and E. Charlaix, J. Fluid Mech. 674 (2011) 389.

    Examples
    --------
    >>> round(sphere_crossover_gap(5e-3, 8e6, 0.1, 10.0) * 1e6, 6)
    1.0
    """
    return 8.0 * radius * math.pow(viscosity * frequency / modulus, 2.0 / 3.0)


def sphere_stiff_limit(
    radius: float, gap: float, modulus: float, viscosity: float, frequency: float
) -> tuple[float, float]:
    r"""Storage and loss modulus [N/m] of a sphere at gaps far above the crossover.

    .. math:: G'' = \frac{6 \pi \eta \omega R^2}{D}, \qquad
              G' = \frac{27 \pi^3}{2^{7/2}} \frac{(\eta \omega)^2 R^{7/2}}{E^* D^{5/2}}

    Parameters
    ----------
    radius, gap, modulus, viscosity, frequency : float
        R [m], D [m], E* [Pa], eta [Pa.s] and omega [rad/s].

    Notes
    -----
    First order in the displacement, by Parseval's theorem of the rigid pressure
    :math:`3 \eta R v/h^2`; the error of both is below 4 % at three crossover gaps, and falls as
    the gap to the power -3/2.

    Examples
    --------
    >>> storage, loss = sphere_stiff_limit(5e-3, 1e-6, 8e9, 0.1, 10.0)
    >>> round(storage / loss, 7), round(loss, 2)
    (0.0001735, 471.24)
    """
    rate = viscosity * frequency
    storage = SPHERE_STORAGE * rate**2 * radius**3.5 / (modulus * gap**2.5)
    return storage, 6.0 * math.pi * rate * radius**2 / gap


def flat_stiff_limit(
    radius: float, gap: float, modulus: float, viscosity: float, frequency: float
) -> tuple[float, float]:
    r"""Storage and loss modulus [N/m] of a flat disc on a half-space that is hardly deformed.

    .. math:: G'' = \frac{3 \pi \eta \omega R^4}{2 h^3}, \qquad
              G' = \frac{512}{35} \frac{(\eta \omega)^2 R^7}{E^* h^6}

    Parameters
    ----------
    radius, gap, modulus, viscosity, frequency : float
        R [m], h [m], E* [Pa], eta [Pa.s] and omega [rad/s].

    Examples
    --------
    >>> storage, loss = flat_stiff_limit(5e-3, 1e-5, 1e13, 0.1, 10.0)
    >>> round(storage / loss * 1e5, 3)
    3.88
    """
    rate = viscosity * frequency
    storage = FLAT_STORAGE * rate**2 * radius**7 / (modulus * gap**6)
    return storage, 1.5 * math.pi * rate * radius**4 / gap**3
