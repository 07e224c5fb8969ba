r"""Kelvin's equation and capillary condensation: liquid in equilibrium with its vapour.

The relative humidity H is the vapour pressure over its saturation value; a pressure is that of the
liquid less that outside, hence negative for a concave meniscus. A positive force attracts.
Arguments are floats or arrays; only those without a solution are refused.

==============  ==========================================  =======
symbol          quantity                                    unit
==============  ==========================================  =======
gamma           surface tension                             N/m
v               molar volume of the liquid                  m3/mol
T               temperature                                 K
H               relative humidity                           -
r_K             Kelvin radius, positive below saturation    m
p               Laplace pressure                            Pa
R, D            radius and gap of a sphere above a flat     m
==============  ==========================================  =======
"""

from __future__ import annotations

import math
from typing import Any

from ..errors import InfeasibleError
from ..validity import ValidityNumber

__all__ = [
    "GAS_CONSTANT",
    "kelvin_radius",
    "laplace_pressure",
    "meniscus_height",
    "radius_number",
    "relative_humidity",
    "thin_film_force",
]

GAS_CONSTANT = 8.31446261815324
"""Molar gas constant [J/(mol.K)], exact since 2019."""


def kelvin_radius(
    surface_tension: Any, molar_volume: Any, temperature: Any, relative_humidity: Any
) -> Any:
    r"""Kelvin radius [m]: mean radius of curvature of a meniscus in equilibrium with its vapour.

    .. math:: r_K = -\frac{\gamma v}{R T \ln H}

    Parameters
    ----------
    surface_tension, molar_volume, temperature : float or ndarray, shape (...)
        Surface tension [N/m], molar volume of the liquid [m3/mol], temperature [K].
    relative_humidity : float or ndarray, shape (...)
        Above 0 and below 1 [-].

    Raises
    ------
    InfeasibleError
        Without vapour, and at or above saturation, as in `laplace_pressure`.

    Notes
    -----
    Ideal vapour, and a surface tension independent of curvature; the error of the latter is about
    the molecular size over the radius, 20 % at 1 nm. Eq. (3.3) has the opposite sign.

    References
    ----------
    .. [1] Thomson (1871), Phil. Mag. 42; Eq. (3.3).

    Examples
    --------
    Water at 25 degC, in air of 50 and 90 %:

    >>> [round(kelvin_radius(0.072, 18e-6, 298.15, h) * 1e9, 4) for h in (0.5, 0.9)]
    [0.7542, 4.962]
    """
    return -surface_tension / laplace_pressure(molar_volume, temperature, relative_humidity)


def laplace_pressure(molar_volume: Any, temperature: Any, relative_humidity: Any) -> Any:
    r"""Laplace pressure [Pa] of a liquid in equilibrium with its vapour; negative.

    .. math:: p = \frac{R T}{v} \ln H

    It is independent of the surface tension; the curvature of the meniscus is p/gamma.

    Raises
    ------
    InfeasibleError
        At H = 0, where nothing condenses, and at H >= 1, where the film is unbounded.

    Notes
    -----
    Arguments and assumptions as in `kelvin_radius`; the liquid is incompressible.

    Examples
    --------
    >>> round(laplace_pressure(18e-6, 298.15, 0.5) / 1e6, 2)
    -95.46
    """
    return GAS_CONSTANT * temperature / molar_volume * _log(relative_humidity)


def relative_humidity(pressure: Any, molar_volume: Any, temperature: Any) -> Any:
    r"""Relative humidity [-] in equilibrium with a liquid of given Laplace pressure [Pa].

    .. math:: H = \exp\frac{p v}{R T}

    Examples
    --------
    >>> round(relative_humidity(laplace_pressure(18e-6, 298.15, 0.5), 18e-6, 298.15), 12)
    0.5
    """
    exponent = pressure * molar_volume / (GAS_CONSTANT * temperature)
    if isinstance(exponent, float | int):
        return math.exp(exponent)
    import numpy as np

    return np.exp(exponent)


_FEW_MOLECULES = 1e-9  # [m]


def radius_number(radius: float) -> ValidityNumber:
    """Range of Kelvin's equation for a radius [m], as a number of validity.

    Examples
    --------
    >>> radius_number(1.1e-9).is_valid, radius_number(0.6e-9).is_valid
    (True, False)
    """
    return ValidityNumber(
        name="Kelvin radius [m]",
        value=radius,
        low=_FEW_MOLECULES,
        detail="below 1 nm, a few molecules, the tension of the bulk is some 20 % off",
        source="Fisher and Israelachvili 1981: Kelvin's equation holds down to radii of 4 nm",
    )


def meniscus_height(pressure: Any, surface_tension: Any, wetting: Any) -> Any:
    r"""Height [m] of a thin meniscus of given pressure [Pa] between nearly parallel walls.

    .. math:: h_m = -\frac{\gamma}{p} (\cos\theta_1 + \cos\theta_2)

    Parameters
    ----------
    pressure, surface_tension : float or ndarray, shape (...)
        Laplace pressure [Pa], negative, and surface tension [N/m].
    wetting : float or ndarray, shape (...)
        Sum of the cosines of the contact angles [-]. If it is not positive, neither is the height:
        nothing condenses.

    Notes
    -----
    Neglects the azimuthal curvature, of relative size height over radius.

    Examples
    --------
    Twice the Kelvin radius between walls that water wets:

    >>> round(meniscus_height(-95.46e6, 0.072, 2.0) * 1e9, 2)
    1.51
    """
    return -surface_tension / pressure * wetting


def thin_film_force(
    sphere_radius: Any, gap: Any, surface_tension: Any, wetting: Any, height: Any
) -> Any:
    r"""Capillary force [N] of a thin meniscus of given height on a sphere above a flat.

    .. math:: F = 2\pi R \gamma (\cos\theta_1 + \cos\theta_2) \, (1 - D/h_m), \qquad D < h_m

    Zero from D = h_m on.

    Parameters
    ----------
    sphere_radius, gap : float or ndarray, shape (...)
        Radius and gap of the sphere [m].
    surface_tension, wetting : float or ndarray, shape (...)
        Surface tension [N/m] and sum of the cosines of the contact angles [-].
    height : float or ndarray, shape (...)
        Height of the meniscus at its rim [m], from `meniscus_height` or that of a film.

    Notes
    -----
    The limit of a small filling angle. Compared with the exact bridge of the same pressure it is
    4 % too high at R = 100 r_K in contact, 6 % at a gap of a quarter of the height; the error
    falls as the square root of r_K/R.

    References
    ----------
    .. [1] Israelachvili, Intermolecular and Surface Forces; Eq. (3.7) is the same at fixed height.

    Examples
    --------
    >>> round(thin_film_force(1e-6, 0.0, 0.072, 2.0, 1.5e-9) * 1e9, 2)
    904.78
    >>> thin_film_force(1e-6, 2e-9, 0.072, 2.0, 1.5e-9)
    0.0
    """
    open_fraction = 1.0 - gap / height
    # positive part, of a float or an array
    open_fraction = 0.5 * (open_fraction + abs(open_fraction))
    return 2.0 * math.pi * sphere_radius * surface_tension * wetting * open_fraction


def _log(relative_humidity: Any) -> Any:
    """Logarithm of a humidity above zero and below saturation."""
    lowest, highest = _bounds(relative_humidity)
    if not lowest > 0.0:
        raise InfeasibleError(
            f"relative humidity {lowest:g}: without vapour nothing condenses and there is no "
            "meniscus; give a humidity above 0, or omit the meniscus"
        )
    if not highest < 1.0:
        raise InfeasibleError(
            f"relative humidity {highest:g}: at saturation the Kelvin radius is infinite, no "
            "meniscus of finite size exists and the film floods the gap; give a humidity below 1, "
            "or a volume"
        )
    if isinstance(relative_humidity, float | int):
        return math.log(relative_humidity)
    import numpy as np

    return np.log(relative_humidity)


def _bounds(value: Any) -> tuple[float, float]:
    if isinstance(value, float | int):
        return float(value), float(value)
    return float(value.min(initial=math.inf)), float(value.max(initial=-math.inf))
