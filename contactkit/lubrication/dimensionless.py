"""Dimensionless numbers for the range of validity of the film models.

Arguments are floats or arrays and are not checked.
"""

from __future__ import annotations

import math
from typing import Any

__all__ = [
    "GRAVITY",
    "LONGEST_FLAT_BRIDGE",
    "bond_number",
    "compression",
    "face_bending",
    "fingering_number",
    "inertia_fraction",
    "reynolds_number",
    "rim_fraction",
    "slenderness",
    "soft_face_number",
    "viscous_to_capillary",
]

GRAVITY = 9.80665  # CGPM 1901, exact
"""Standard acceleration of gravity [m/s2]."""

LONGEST_FLAT_BRIDGE = 1.4645918875615231  # of the cylinder, at two right contact angles
"""Maximum stable gap of a bridge between flats over the cube root of its volume: pi^(1/3)."""


def reynolds_number(density: Any, speed: Any, gap: Any, viscosity: Any) -> Any:
    r"""Reduced Reynolds number [-] of a squeeze film, :math:`\rho |\dot h| h/\eta`."""
    return density * abs(speed) * gap / viscosity


def inertia_fraction(reynolds: Any) -> Any:
    r"""Fraction of the force of a disc [-] that its inertia takes away as it opens.

    .. math:: \frac{5}{28} \frac{\rho \dot h h}{\eta}

    First order in the Reynolds number, between flats at constant speed; closing, it adds as much.
    An acceleration adds :math:`\rho h^2 \ddot h/(10 \eta \dot h)` of the force (Kuzma 1967; both
    follow from one iteration of Navier-Stokes on the parabolic profile).

    Examples
    --------
    >>> inertia_fraction(reynolds_number(880.0, 0.2, 5e-6, 0.1)) < 2e-3
    True
    """
    return 5.0 / 28.0 * reynolds


def slenderness(radius: Any, height: Any) -> Any:
    """Radius of the film over its height [-]; large for lubrication theory and the flat arc."""
    return radius / height


def rim_fraction(slender: Any) -> Any:
    r"""Fraction of the force of a disc [-] that Reynolds' equation leaves out at a flooded rim.

    Where liquid enters the gap at its rim, Stokes flow loses as much pressure as
    :math:`(4/3\pi) h = 0.42\,h` more of the gap would (half of the flow through a slit in a thin
    screen, Hasimoto 1958), and the force of a disc grows as :math:`R^4`:

    .. math:: \frac{16}{3 \pi} \frac{h}{R}

    Faces that end at the rim; an estimate, as the flow inside is not yet parabolic there.

    Examples
    --------
    >>> round(rim_fraction(slenderness(1e-3, 1e-5)), 4)
    0.017
    """
    return 16.0 / (3.0 * math.pi) / slender


def compression(pressure: Any, bulk_modulus: Any) -> Any:
    """Relative change of the volume of a liquid [-] under a pressure [Pa]."""
    return pressure / bulk_modulus


def face_bending(deflection_modulus: Any, modulus: Any, gap: Any) -> Any:
    r"""Deflection of elastic faces at the centre over the gap [-].

    Parameters
    ----------
    deflection_modulus : float
        Deflection times E* [Pa.m]: ``2 p R`` under a uniform pressure p on a disc of radius R,
        ``4/3 p R`` under a parabola of peak p, which of a squeezed film is
        :math:`4 \eta \dot h R^3/h^3` (integrals of Boussinesq's point load over the disc).
    modulus : float
        Reduced modulus E* of both faces [Pa].
    gap : float
        Gap [m].

    Examples
    --------
    The injector's film of 5 um at 10 bar, between two faces of steel:

    >>> f"{face_bending(2.0 * 1e6 * 3.175e-3, 115e9, 5e-6):.3f}"
    '0.011'
    """
    return deflection_modulus / (modulus * gap)


def soft_face_number(viscosity: Any, radius: Any, modulus: Any, gap: Any, time: Any) -> Any:
    r"""Gap that soft faces give while a film resists, over the gap that opens in a time [-].

    .. math:: A = \frac{3.1\,\eta R^3}{E^* h^3 \Delta t}

    Of the slowest wave of a disc, with an effective wave number of 1.97/R. Where it exceeds 1 in
    the time h/v of the motion, the faces follow the film and not the bodies; in the time of a step
    of a co-simulation, passing pressures to and fro between film and solid diverges.

    Examples
    --------
    The injector's film of 5 um and 0.1 Pa.s, in steps of 1 us:

    >>> round(soft_face_number(0.1, 3.175e-3, 115e9, 5e-6, 1e-6), -1)
    690.0
    """
    return 3.1 * viscosity * radius**3 / (modulus * gap**3 * time)


def bond_number(density: Any, length_1: Any, length_2: Any, surface_tension: Any) -> Any:
    r"""Bond number [-]: gravity over capillarity, :math:`\rho g \ell_1 \ell_2/\gamma`."""
    return density * GRAVITY * length_1 * length_2 / surface_tension


def viscous_to_capillary(
    viscosity: Any, radius: Any, speed: Any, gap: Any, tension_and_wetting: Any
) -> Any:
    r"""Viscous over Laplace pressure [-], :math:`3\eta r^2 |\dot h|/(\gamma |c_1 + c_2| h^2)`."""
    return 3.0 * viscosity * radius**2 * abs(speed) / (tension_and_wetting * gap**2)


def fingering_number(
    viscosity: Any, speed: Any, radius: Any, gap: Any, surface_tension: Any
) -> Any:
    r"""Lifted Hele-Shaw number [-] of a receding rim, :math:`\eta \dot h r^3/(\gamma h^3)`.

    Above 1 the rim breaks up into about :math:`\sqrt{(1 + 6 N)/3}` fingers.
    """
    return viscosity * speed * radius**3 / (surface_tension * gap**3)
