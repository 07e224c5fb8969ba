r"""Theories of the real area of contact of rough half-spaces, without adhesion or plasticity.

Each gives the fraction :math:`A/A_0` of the nominal area in contact for a mean pressure p, from
statistics of the undeformed heights: the rms slope h' (`surface_statistics`), or the summits
(`summits`). :math:`E^*` is the contact modulus of a half-space; of layers and bounded pressures
they know nothing.

========================== =================================== ===============================
theory                     fraction in contact                 holds
========================== =================================== ===============================
Persson                    :math:`erf(\sqrt2 p/E^* h')`        A above 85 % (within 5 %); 20 to 35 %
                                                               low at small loads
Bush, Gibson and Thomas    :math:`\sqrt{2\pi}\, p/E^* h'`      A below 1 %
fit of slope 2             :math:`erf(\sqrt\pi p/E^* h')`      A above 10 %, within a tenth
Greenwood and Williamson   sum over equal summits              A below 1 %
========================== =================================== ===============================

The stress in full contact has the variance :math:`(E^* h'/2)^2`, hence the factor of Persson; a
factor of 2 in its place also circulates, to which no derivation with this :math:`E^*` leads.

All need shortest waves of at least 8 pixels (16 for 2 % in slope and area) and a window of four
times the longest; otherwise maps scatter by 5 to 10 %.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy import special

from ..errors import DescriptionError
from .statistics import Summits

__all__ = [
    "RANGES",
    "Range",
    "SummitContact",
    "bush_gibson_thomas",
    "greenwood_williamson",
    "greenwood_williamson_area",
    "in_range",
    "interpolated_area",
    "persson_area",
    "persson_pressures",
]

Array = NDArray[np.float64]

_BGT = math.sqrt(2.0 * math.pi)
# Separations over rms summit height between which a pressure is looked for. At 38.5 the fraction of
# summits is zero in a double (6e-300 at 37); at -30 all summits touch, far outside the theory.
_DEEPEST, _HIGHEST = -30.0, 37.0


class Range(NamedTuple):
    """Fractions of area between which a theory holds [-], and how well."""

    low: float
    high: float
    error: str


RANGES = {
    "Persson": Range(0.85, 1.0, "exact at full contact, within 5 % above 85 % of area"),
    "Bush, Gibson and Thomas": Range(0.0, 0.01, "limit of small loads"),
    "Greenwood and Williamson": Range(0.0, 0.01, "independent summits; depends on the pixel"),
    "fit of slope 2": Range(0.1, 1.0, "within a tenth of solved self-affine contacts"),
}
"""Where each theory holds."""


def in_range(theory: str, fraction: ArrayLike) -> Array:
    """Fractions of area by a theory [-], nan outside its range.

    Parameters
    ----------
    theory : str
        A name of `RANGES`.
    fraction : array_like (...)
        What the theory gives [-].

    Examples
    --------
    >>> in_range("Bush, Gibson and Thomas", [0.005, 0.2, 2.9]).tolist()
    [0.005, nan, nan]
    """
    found, (low, high, _) = np.asarray(fraction, dtype=np.float64), RANGES[theory]
    return np.where((found >= low) & (found <= high), found, np.nan)


def persson_area(pressure: ArrayLike, contact_modulus: float, rms_slope: float) -> Array:
    r"""Fraction of area in contact after Persson [-].

    .. math:: \frac{A}{A_0} = \operatorname{erf}\frac{\sqrt2\,p}{E^* h'}

    Exact at full contact, 4 % low at 87 % of area and 15 % at 45 %; the slope at small loads,
    :math:`\sqrt{8/\pi}` = 1.596 in units of :math:`1/E^*h'`, is 20 to 35 % below that of solved
    contacts (self-affine, H = 0.8, shortest wave of 16 pixels).

    Parameters
    ----------
    pressure : array_like (...)
        Mean pressure p [Pa].
    contact_modulus : float
        :math:`E^*` [Pa].
    rms_slope : float
        Root of the mean square of the gradient h' [-].

    References
    ----------
    .. [1] Persson, J. Chem. Phys. 115 (2001) 3840.

    Examples
    --------
    >>> persson_area([0.05e9, 0.5e9], 1e9, 1.0).round(6).tolist()
    [0.079656, 0.682689]
    """
    return np.asarray(special.erf(math.sqrt(2.0) * _reduced(pressure, contact_modulus, rms_slope)))


def interpolated_area(pressure: ArrayLike, contact_modulus: float, rms_slope: float) -> Array:
    r"""Fraction of area in contact by the fit of slope 2 [-].

    .. math:: \frac{A}{A_0} = \operatorname{erf}\frac{\sqrt\pi\,p}{E^* h'}

    Persson's form with the slope that solved contacts have at 10 to 20 % of area: at most 7 % high
    from there to full contact, 10 to 20 % low at a hundredth of area.

    Parameters
    ----------
    pressure, contact_modulus, rms_slope
        As in `persson_area`.

    Examples
    --------
    >>> interpolated_area([0.05e9, 0.5e9], 1e9, 1.0).round(6).tolist()
    [0.099739, 0.789909]
    """
    return np.asarray(
        special.erf(math.sqrt(math.pi) * _reduced(pressure, contact_modulus, rms_slope))
    )


def bush_gibson_thomas(pressure: ArrayLike, contact_modulus: float, rms_slope: float) -> Array:
    r"""Fraction of area in contact after Bush, Gibson and Thomas at small loads [-].

    .. math:: \frac{A}{A_0} = \sqrt{2\pi}\, \frac{p}{E^* h'}

    The limit of small loads for elliptic summits of an isotropic Gaussian surface of a broad
    spectrum; solved contacts reach 2.3 to 2.6 in place of 2.507 at 1 to 2 % of area, and less
    above. Above 1 the fraction has no meaning; it is not bounded here.

    Parameters
    ----------
    pressure, contact_modulus, rms_slope
        As in `persson_area`.

    References
    ----------
    .. [1] Bush, Gibson and Thomas, Wear 35 (1975) 87.

    Examples
    --------
    >>> bush_gibson_thomas(1e6, 1e9, 0.1).round(6).item()
    0.025066
    """
    return np.asarray(_BGT * _reduced(pressure, contact_modulus, rms_slope))


def persson_pressures(
    pressure: ArrayLike, mean_pressure: float, contact_modulus: float, rms_slope: float
) -> Array:
    r"""Probability density of the pressure in contact after Persson [1/Pa].

    .. math:: P(p) = \frac{1}{\sqrt{2\pi} s} \left[e^{-(p - \bar p)^2/2s^2}
              - e^{-(p + \bar p)^2/2s^2}\right], \qquad s = \frac{E^* h'}{2}

    A Gaussian less its mirror image: zero and linear at p = 0. Its integral is `persson_area`, so
    compare it with the pressures of pixels in contact over the number of all pixels.

    Parameters
    ----------
    pressure : array_like (...)
        Pressures [Pa], zero or positive.
    mean_pressure : float
        Load over the nominal area [Pa].
    contact_modulus, rms_slope : float
        As in `persson_area`.

    Examples
    --------
    >>> p = np.linspace(0.0, 10.0, 2001)
    >>> found = persson_pressures(p, 0.5, 1.0, 1.0)
    >>> round(float(np.trapezoid(found, p)), 4), float(persson_area(0.5, 1.0, 1.0).round(4))
    (0.6827, 0.6827)
    """
    spread = 0.5 * contact_modulus * rms_slope
    p = np.asarray(pressure, dtype=np.float64)
    mirrored = np.exp(-0.5 * ((p - mean_pressure) / spread) ** 2)
    mirrored -= np.exp(-0.5 * ((p + mean_pressure) / spread) ** 2)
    return np.asarray(mirrored / (math.sqrt(2.0 * math.pi) * spread))


# Independent summits ------------------------------------------------------------------------


class SummitContact(NamedTuple):
    """Contact of independent summits at given separations."""

    pressure: Array
    """Mean pressure [Pa]."""
    fraction: Array
    """Fraction of area in contact [-]."""


def greenwood_williamson(
    separation: ArrayLike, contact_modulus: float, summits: Summits
) -> SummitContact:
    r"""Pressure and area of independent Hertzian summits of one radius and Gaussian heights.

    .. math:: \frac{A}{A_0} = \pi \eta R \sigma_s F_1(t), \quad
              p = \tfrac43 \eta E^* R^{1/2} \sigma_s^{3/2} F_{3/2}(t), \quad
              F_n = \int_t^\infty \frac{(s - t)^n e^{-s^2/2}}{\sqrt{2\pi}} ds, \quad
              t = d/\sigma_s

    by the parabolic cylinder function, :math:`F_n = \Gamma(n+1) e^{-t^2/4} D_{-n-1}(t)
    /\sqrt{2\pi}`. For areas below a hundredth, where summits do not join or feel each other.

    Parameters
    ----------
    separation : array_like (...)
        Distance d of the rigid plane from the mean height of the summits [m].
    contact_modulus : float
        :math:`E^*` [Pa].
    summits : Summits
        Density, radius and standard deviation of the heights of the summits.

    References
    ----------
    .. [1] Greenwood and Williamson, Proc. R. Soc. A 295 (1966) 300.

    Examples
    --------
    >>> tops = Summits(1e12, 0.0, 1e-9, 1e-6, 100)
    >>> found = greenwood_williamson(0.0, 1e9, tops)
    >>> round(float(found.fraction), 9), round(float(found.pressure) / 1e3, 3)
    (0.001253314, 18.131)
    """
    t = np.asarray(separation, dtype=np.float64) / summits.rms_height
    scale = summits.density * summits.radius * summits.rms_height
    stiff = summits.density * math.sqrt(summits.radius) * summits.rms_height**1.5
    return SummitContact(
        np.asarray(4.0 / 3.0 * contact_modulus * stiff * _moment(1.5, t)),
        np.asarray(math.pi * scale * _moment(1.0, t)),
    )


def greenwood_williamson_area(
    pressure: ArrayLike, contact_modulus: float, summits: Summits
) -> Array:
    """Fraction of area in contact after Greenwood and Williamson [-], over the pressure.

    Parameters
    ----------
    pressure : array_like (...)
        Mean pressure [Pa], zero or positive.
    contact_modulus, summits
        As in `greenwood_williamson`.

    Raises
    ------
    DescriptionError
        If all summits have one height, or a pressure exceeds what summits carry at a separation of
        -30 standard deviations, far outside the theory.

    Examples
    --------
    >>> tops = Summits(1e12, 0.0, 1e-9, 1e-6, 100)
    >>> greenwood_williamson_area([0.0, 18130.8], 1e9, tops).round(6).tolist()
    [0.0, 0.001253]
    """
    if not summits.rms_height > 0.0:
        raise DescriptionError(
            "summits.rms_height", summits.rms_height, "be positive: summits of one height", unit="m"
        )
    p = np.asarray(pressure, dtype=np.float64)
    low, high = np.full(p.shape, _DEEPEST), np.full(p.shape, _HIGHEST)
    most = greenwood_williamson(_DEEPEST * summits.rms_height, contact_modulus, summits).pressure
    if not ((p >= 0.0) & (p <= most)).all():
        raise DescriptionError(
            "pressure",
            float(p.max() if p.max() > most else p.min()),
            f"lie between 0 and {float(most):.3g} for these summits",
            unit="Pa",
        )
    for _ in range(64):  # the pressure falls with the separation
        middle = 0.5 * (low + high)
        at = greenwood_williamson(middle * summits.rms_height, contact_modulus, summits)
        is_above = at.pressure > p
        low, high = np.where(is_above, middle, low), np.where(is_above, high, middle)
    found = greenwood_williamson(low * summits.rms_height, contact_modulus, summits).fraction
    return np.where(p > 0.0, found, 0.0)


def _moment(n: float, t: Array) -> Array:
    """Mean of (s - t)^n over the part of a standard normal s that exceeds t."""
    cylinder = special.pbdv(-n - 1.0, t)[0]
    return np.asarray(
        special.gamma(n + 1.0) * np.exp(-0.25 * t * t) * cylinder / math.sqrt(2.0 * math.pi)
    )


def _reduced(pressure: ArrayLike, contact_modulus: float, rms_slope: float) -> Array:
    """Pressure over E* h' [-]."""
    return np.asarray(np.asarray(pressure, dtype=np.float64) / (contact_modulus * rms_slope))
