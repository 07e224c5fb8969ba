r"""Viscous heating of a squeezed film: how warm it gets by its own shear.

The film dissipates F v. Two bounds hold together, so that the smaller one does:

- *adiabatic*: all heat stays in the liquid, :math:`W/(\rho c V)` over a pull of work W;
- *conduction*: walls at constant temperature take up what the liquid gives off at once.

The Fourier number :math:`\kappa t/h^2` decides which of them is near. Arguments are floats or
arrays and are not checked.

=======  ==============================================  =======
symbol   quantity                                        unit
=======  ==============================================  =======
rho c    heat capacity per volume of the liquid          J/m3/K
k        thermal conductivity of the liquid              W/m/K
kappa    thermal diffusivity, k/(rho c)                  m2/s
beta     -d ln(eta)/dT                                   1/K
g q      power per area, gradient times flux per width   W/m2
=======  ==============================================  =======
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

__all__ = [
    "FilmHeating",
    "adiabatic_rise",
    "conduction_rise",
    "film_heating",
    "fourier_number",
    "nahme_number",
]


class FilmHeating(NamedTuple):
    """Temperature rise of a film and what bounds it."""

    rise: Any
    """Smaller of both bounds [K]."""
    adiabatic: Any
    """Rise if all heat stays in the liquid [K]."""
    conduction: Any
    """Rise in the middle of the gap if walls of constant temperature cool it [K]."""
    fourier: Any
    """Fourier number [-]; the conduction bound is near above some 0.3, the adiabatic below 0.03."""
    nahme: Any
    """Relative fall of the viscosity by that rise, to first order [-]."""


def adiabatic_rise(work: Any, volume: Any, heat_capacity: Any) -> Any:
    r"""Mean rise [K] of a liquid that keeps the work of a pull, :math:`W/(\rho c V)`.

    Parameters
    ----------
    work : float or ndarray
        Work of the viscous force [J].
    volume : float or ndarray
        Volume of the liquid [m3].
    heat_capacity : float or ndarray
        Heat capacity per volume, rho c [J/m3/K].

    Examples
    --------
    >>> adiabatic_rise(1e-6, 1e-12, 2e6)
    0.5
    """
    return work / (volume * heat_capacity)


def conduction_rise(power: Any, gap: Any, conductivity: Any, exponent: Any = 1.0) -> Any:
    r"""Steady rise [K] in the middle of the gap between walls of constant temperature.

    .. math:: \Delta T = \frac{g q \, h}{4 k \, (3 + 1/n)}

    Parameters
    ----------
    power : float or ndarray
        Power per area, gradient times flux per width [W/m2].
    gap : float or ndarray
        Gap h [m].
    conductivity : float or ndarray
        Thermal conductivity k of the liquid [W/m/K].
    exponent : float or ndarray
        n of the power law that the liquid follows at its shear rate [-]; 1 is Newtonian, where it
        is tau_w^2 h^2/(48 eta k).

    Notes
    -----
    Exact for a power law without slip at constant properties; heat of slip arises at the walls and
    is taken up there, so that the value is an upper bound with slip. For a law whose exponent
    varies between n and 1 it lies between the values of both, within a factor of 3.3 at n = 0.1.

    References
    ----------
    Bird, Stewart and Lightfoot, Transport Phenomena, section 10.4 and problem 10.B.

    Examples
    --------
    >>> eta, k, h, g = 0.1, 0.15, 1e-5, 1e9
    >>> tau, q = 0.5 * g * h, g * h**3 / (12.0 * eta)
    >>> round(conduction_rise(g * q, h, k) / (tau**2 * h**2 / (48.0 * eta * k)), 12)
    1.0
    """
    return power * gap / (4.0 * conductivity * (3.0 + 1.0 / exponent))


def fourier_number(diffusivity: Any, time: Any, gap: Any) -> Any:
    r"""Fourier number [-], :math:`\kappa t/h^2`, of a diffusivity [m2/s], a time [s], a gap [m].

    Examples
    --------
    >>> round(fourier_number(1e-7, 1e-3, 1e-5), 9)
    1.0
    """
    return diffusivity * time / (gap * gap)


def nahme_number(rise: Any, sensitivity: Any) -> Any:
    r"""Nahme number [-], :math:`\beta \, \Delta T`: relative fall of the viscosity by a rise [K].

    `sensitivity` is beta, minus the slope of ln(eta) over the temperature [1/K]; the definition
    takes the rise that a constant viscosity would give.

    Examples
    --------
    >>> round(nahme_number(2.0, 0.05), 9)
    0.1
    """
    return sensitivity * rise


def film_heating(
    work: Any,
    volume: Any,
    heat_capacity: Any,
    conduction: Any,
    fourier: Any,
    sensitivity: Any = 0.0,
) -> FilmHeating:
    """Temperature rise of a film over a pull, the smaller of both bounds.

    Parameters
    ----------
    work, volume, heat_capacity : float or ndarray
        See `adiabatic_rise`.
    conduction : float or ndarray
        Largest `conduction_rise` of the pull [K].
    fourier : float or ndarray
        See `fourier_number`, at the gap of that largest rise.
    sensitivity : float or ndarray
        See `nahme_number`.

    Examples
    --------
    >>> hot = film_heating(1e-6, 1e-12, 2e6, 0.02, 5.0, sensitivity=0.05)
    >>> hot.rise, round(hot.nahme, 6)
    (0.02, 0.001)
    """
    adiabatic = adiabatic_rise(work, volume, heat_capacity)
    least = np.minimum(adiabatic, conduction)
    rise = least.item() if np.ndim(least) == 0 else least
    return FilmHeating(rise, adiabatic, conduction, fourier, nahme_number(rise, sensitivity))
