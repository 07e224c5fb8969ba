r"""Menisci at the asperities of a rough surface near a flat: three statistical laws.

* `identical`: summits of equal height, one thin meniscus at each within reach.
* `greenwood_williamson`: summits of equal radius, their heights normal about a mean plane.
* `cross_cut`: no summits; the area on which the gap of a Gaussian surface is smaller than the film,
  Eq. (2.43).

On one surface they may differ by a factor of ten, because they use different statistics; a result
names its law. In all of them the menisci end at one height h_m, that of a film or that given by the
humidity. Positive forces attract. Arguments are floats; the module does without numpy.

==============  ================================================================  =======
symbol          quantity                                                          unit
==============  ================================================================  =======
d               flat above the mean plane of the summits (or of the surface)      m
sigma           standard deviation of the heights                                 m
R, n            radius of the summits, and their number per area                  m, 1/m2
A               nominal area                                                      m2
gamma, c        surface tension, sum of the cosines of both contact angles        N/m, -
h_m             height at which a meniscus ends                                   m
Q(t), phi(t)    upper tail and density of the standard normal distribution        -
==============  ================================================================  =======
"""

from __future__ import annotations

import math
from typing import NamedTuple

from ..numerics.quadrature import gauss_legendre
from .kelvin import thin_film_force

__all__ = [
    "AsperitySum",
    "CrossCut",
    "cross_cut",
    "gaussian_peaks",
    "greenwood_williamson",
    "identical",
    "mean_tail",
    "normal_density",
    "normal_tail",
]


class AsperitySum(NamedTuple):
    """Menisci at many asperities: force [N], numbers of wetted and touching summits, coverage.

    `coverage` is the sum of the contact circles over the nominal area [-].
    """

    force: float
    n_wet: float
    n_touching: float
    coverage: float


class CrossCut(NamedTuple):
    """Force [N] and wetted area [m2] of a surface within reach of a film, and contact area."""

    force: float
    area: float
    contact_area: float


def identical(
    separation: float,
    radius: float,
    density: float,
    area: float,
    surface_tension: float,
    wetting: float,
    height: float,
) -> AsperitySum:
    r"""Menisci at asperities of equal height, at a distance D from the flat.

    .. math:: F = n A \, 2\pi R\gamma c \, (1 - D/h_m)

    Parameters
    ----------
    separation : float
        Distance D of the summits from the flat [m], not negative.
    radius, density, area : float
        Radius of the summits [m], number per area [1/m2], nominal area [m2].
    surface_tension, wetting, height : float
        As at the head of the module.

    References
    ----------
    .. [1] Eqs. (3.13) and (3.14).

    Examples
    --------
    >>> found = identical(0.0, 1e-6, 1e12, 1e-8, 0.072, 1.0, 1e-9)
    >>> round(found.force * 1e3, 6), round(found.n_wet), round(found.coverage, 6)
    (4.523893, 10000, 0.006283)
    """
    number = density * area
    one = float(thin_film_force(radius, separation, surface_tension, wetting, height))
    immersed = max(1.0 - separation / height, 0.0)
    wet = number if immersed > 0.0 else 0.0
    coverage = 2.0 * math.pi * radius * density * height * immersed
    return AsperitySum(number * one, wet, number if separation <= 0.0 else 0.0, coverage)


def greenwood_williamson(
    separation: float,
    rms_height: float,
    radius: float,
    density: float,
    area: float,
    surface_tension: float,
    wetting: float,
    height: float,
) -> AsperitySum:
    r"""Menisci at summits with normally distributed heights (Greenwood and Williamson).

    .. math::
        F = 2\pi R\gamma c \, n A \, \frac{1}{b-a}\int_a^b Q(t)\,dt, \qquad
        a = \frac{d-h_m}{\sigma}, \quad b = \frac{d}{\sigma}

    Parameters
    ----------
    separation : float
        Distance of the flat from the mean plane of the summits [m], of either sign.
    rms_height : float
        Standard deviation of the heights of the summits [m].
    radius, density, area, surface_tension, wetting, height : float
        As at the head of the module.

    Notes
    -----
    Each summit within reach attracts with 2 pi R gamma c (1 - D/h_m), a summit in contact with the
    force of D = 0: its flattening is neglected, which has no effect in the limit of a thin
    meniscus. The mean of the tail equals
    ``Q(b) + ((h_m - d)(Q(a) - Q(b)) + sigma (phi(a) - phi(b)))/h_m``, without its cancellation.
    Neighbours do not interact; check `coverage`.

    References
    ----------
    .. [1] Greenwood and Williamson (1966), Proc. R. Soc. A 295, for the population.

    Examples
    --------
    >>> found = greenwood_williamson(3e-9, 1e-9, 1e-6, 5e13, 1e-8, 0.072, 1.0, 1e-9)
    >>> round(found.force * 1e3, 8), round(found.n_wet), round(found.n_touching)
    (1.83411042, 11375, 675)
    """
    a, b = (separation - height) / rms_height, separation / rms_height
    immersed = mean_tail(a, b)
    number = density * area
    force = 2.0 * math.pi * radius * surface_tension * wetting * number * immersed
    coverage = 2.0 * math.pi * radius * density * height * immersed
    return AsperitySum(force, number * normal_tail(a), number * normal_tail(b), coverage)


def cross_cut(
    separation: float,
    rms_height: float,
    area: float,
    surface_tension: float,
    wetting: float,
    height: float,
) -> CrossCut:
    r"""Film on a truncated Gaussian surface: Laplace pressure times the area within reach.

    .. math:: F = \gamma c A_m/h_m, \qquad A_m = A [Q((d-h_m)/\sigma) - Q(d/\sigma)]

    Parameters
    ----------
    separation : float
        Distance of the flat from the mean plane of the surface [m], of either sign.
    rms_height : float
        Standard deviation of the heights of the surface [m].
    area, surface_tension, wetting, height : float
        As at the head of the module.

    Notes
    -----
    The surface is not deformed, so that the contact area is that of bearing-area theory;
    `film_islands` has the same law on a deformed map. Overestimates menisci on narrow islands,
    where the pressure is not that of a slit.

    References
    ----------
    .. [1] Eq. (2.43).

    Examples
    --------
    >>> found = cross_cut(3e-9, 1e-9, 1e-8, 0.072, 1.0, 1e-9)
    >>> round(found.force * 1e3, 5), round(found.area * 1e12, 3)
    (15.40817, 214.002)
    """
    a, b = (separation - height) / rms_height, separation / rms_height
    between, touching = area * _between(a, b), normal_tail(b)
    return CrossCut(surface_tension * wetting * between / height, between, area * touching)


def gaussian_peaks(level: float, area: float, variance: float, slope_variance: float) -> float:
    r"""Number of islands of a Gaussian surface above a high threshold.

    .. math:: N = A (2\pi)^{-3/2} (m_2/m_0) \, t \, e^{-t^2/2}

    Parameters
    ----------
    level : float
        Height over the standard deviation, t [-]; from about 2 on.
    area : float
        Nominal area [m2].
    variance, slope_variance : float
        Variance m_0 of the heights [m2] and m_2 of the slope in one direction [-].

    Notes
    -----
    The mean Euler characteristic (islands less holes), negative below the mean plane. For an
    exponential autocorrelation m_2 diverges, so that the number depends on the grid.

    References
    ----------
    .. [1] Nayak (1971), J. Lubr. Technol. 93; Adler (1981), The Geometry of Random Fields.

    Examples
    --------
    >>> round(gaussian_peaks(3.0, 1e-8, 1e-18, 0.01), 1)
    211605.2
    """
    per_area = (2.0 * math.pi) ** -1.5 * slope_variance / variance
    return float(area * per_area * level * math.exp(-0.5 * level * level))


def normal_density(t: float) -> float:
    """Density of the standard normal distribution."""
    return math.exp(-0.5 * t * t) / math.sqrt(2.0 * math.pi)


def normal_tail(t: float) -> float:
    """Upper tail probability of the standard normal distribution.

    Examples
    --------
    >>> normal_tail(0.0)
    0.5
    """
    return 0.5 * math.erfc(t / math.sqrt(2.0))


def mean_tail(a: float, b: float) -> float:
    r"""Mean of the upper tail Q between a and b > a, accurate to round-off everywhere.

    Examples
    --------
    >>> round(mean_tail(-1.0, 1.0), 12), mean_tail(-60.0, -50.0)
    (0.5, 1.0)
    """
    # Q falls over 1/(1 + |a|). Within that Gauss' rule is exact to 6e-14, where the difference of
    # two excesses loses up to five digits; beyond, the difference is as good, and no rule is
    # needed.
    width = b - a
    if width * (1.0 + abs(a)) < 1.0:
        nodes, weights = gauss_legendre(10)
        return float(
            sum(w * normal_tail(a + width * x) for x, w in zip(nodes, weights, strict=True))
        )
    return (_excess(a) - _excess(b)) / width


def _excess(t: float) -> float:
    """Mean of (Z - t) where it is positive, Z standard normal: the integral of Q from t on."""
    # phi - t Q cancels to 1/t^2 of it: 2e-12 at 12, 1e-11 at 20. The asymptotic series has terms up
    # to (2k - 1)!!/t^2k: its twelve leave 1e-13 at 12, 6e-12 at 10.
    if t < 12.0:
        return normal_density(t) - t * normal_tail(t)
    term, total, inverse = 1.0, 0.0, 1.0 / (t * t)
    for k in range(12):
        term *= -(2.0 * k + 1.0) * inverse
        total -= term
    return normal_density(t) * total


def _between(a: float, b: float) -> float:
    """Q(a) - Q(b) without cancellation, for a < b."""
    if (b - a) * (1.0 + abs(a)) < 1.0:
        nodes, weights = gauss_legendre(10)
        points = [a + (b - a) * x for x in nodes]
        return (b - a) * sum(w * normal_density(t) for t, w in zip(points, weights, strict=True))
    return normal_tail(-b) - normal_tail(-a) if b < 0.0 else normal_tail(a) - normal_tail(b)
