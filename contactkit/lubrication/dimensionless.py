"""Dimensionless numbers for the range of validity of the film models.

Arguments are floats or arrays and are not checked.
"""

from __future__ import annotations

from typing import Any

__all__ = [
    "GRAVITY",
    "LONGEST_FLAT_BRIDGE",
    "bond_number",
    "fingering_number",
    "reynolds_number",
    "slenderness",
    "viscous_to_capillary",
]

GRAVITY = 9.80665
"""Standard acceleration of gravity [m/s2]."""

LONGEST_FLAT_BRIDGE = 1.4645918875615231
"""Maximum stable gap of a bridge between flats over the cube root of its volume: pi^(1/3)."""


def reynolds_number(density: Any, speed: Any, gap: Any, viscosity: Any) -> Any:
    r"""Reduced Reynolds number [-] of a squeeze film, :math:`\rho |\dot h| h/\eta`."""
    return density * abs(speed) * gap / viscosity


def slenderness(radius: Any, height: Any) -> Any:
    """Radius of the film over its height [-]; large for lubrication theory and the flat arc."""
    return radius / height


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
