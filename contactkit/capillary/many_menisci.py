r"""Division of a meniscus into many equal ones: stability, overlap, and printed optima.

A liquid volume V between two flats at a distance h is divided into N menisci of volume V/N. Without
gravity, shapes depend on V/h^3 alone. Arguments are floats or arrays and are not checked.

==============  ==================================================  =======
symbol          quantity                                            unit
==============  ==================================================  =======
N               number of equal menisci                             -
x               radius of the larger contact circle of one          m
h, h_lim        gap, and the maximum gap of a stable bridge         m
R, s, D         radius of a sphere, height of the film, gap         m
==============  ==================================================  =======
"""

from __future__ import annotations

import math
from typing import Any

__all__ = [
    "MAX_COVERAGE",
    "optimal_count_published",
    "coverage",
    "critical_radius_published",
    "max_stable_count",
    "max_separate_split",
]

MAX_COVERAGE = math.pi / math.sqrt(12.0)
"""Densest packing of equal circles in a plane [-]; beyond it they overlap."""


def coverage(count: Any, contact_radius: Any, area: Any) -> Any:
    r"""Area coverage [-]: contact circles over the area of the face, :math:`N \pi x^2/A`.

    Beyond `MAX_COVERAGE` neighbours overlap in any arrangement (unless there is only one).

    Examples
    --------
    >>> round(coverage(4, 0.5, math.pi), 12)
    1.0
    """
    return count * math.pi * contact_radius**2 / area


def max_stable_count(gap: float, limit_gap: float) -> int:
    r"""Maximum number of stable menisci into which a liquid can be divided between flats.

    .. math:: N_{max} = \lfloor (h_{lim}/h)^3 \rfloor

    Parameters
    ----------
    gap, limit_gap : float
        Gap [m], and the maximum gap of the undivided liquid [m].

    Returns
    -------
    int
        0 if even the undivided liquid does not span the gap.

    Notes
    -----
    Exact for free contact lines, because the limit grows as the cube root of the volume; a count
    that puts the menisci exactly at their limit is excluded.

    Examples
    --------
    >>> max_stable_count(6e-9, 258.11334458632575e-9)
    79611
    """
    ratio = (limit_gap / gap) ** 3
    return math.ceil(ratio * (1.0 - 1e-12)) - 1 if ratio > 1.0 else 0


def max_separate_split(radius: Any, film_height: Any, gap: Any) -> Any:
    r"""Maximum n for which n x n asperities of radius R/n have separate menisci.

    .. math:: n = \frac{R}{2 (s - D)}

    from a contact radius :math:`\sqrt{2 (R/n)(s-D)}` of at most half the spacing 2R/n.

    Notes
    -----
    Eq. (3.14) does not state this bound, and does not hold above it.

    Examples
    --------
    A radius of 50 um under a film of 500 nm: 2500 asperities at most.

    >>> round(max_separate_split(50e-6, 500e-9, 0.0) ** 2)
    2500
    """
    return radius / (2.0 * (film_height - gap))


def optimal_count_published(line_force: Any, viscous_force: Any) -> Any:
    r"""Number of menisci that minimises the sum of Eqs. (3.33) and (3.34), not rounded.

    .. math:: N = (2 F_v/F_l)^{2/3} \quad\text{minimises}\quad F_L + \sqrt{N} F_l + F_v/N

    Parameters
    ----------
    line_force : float or ndarray, shape (...)
        Line tension :math:`2\pi\gamma x\sin\theta` of the undivided meniscus [N].
    viscous_force : float or ndarray, shape (...)
        Mean viscous force of the undivided meniscus [N], far from its rupture.

    Notes
    -----
    Below 1 the undivided meniscus is optimal. The exact force grows slower than the square root.

    Examples
    --------
    >>> round(optimal_count_published(1.0, 500.0), 9)
    100.0
    """
    return (2.0 * viscous_force / line_force) ** (2.0 / 3.0)


def critical_radius_published(
    gap: Any, surface_tension: Any, wetting: Any, sine: Any, viscosity: Any, time: Any
) -> Any:
    r"""Radius [m] of a meniscus at which Eqs. (3.11) and (3.19), far from rupture, are equal.

    .. math::
        \frac{3\eta x^3}{4 t_s h^2} = \frac{\gamma c\, x}{h} + 2\gamma\sin\theta

    Parameters
    ----------
    gap : float or ndarray, shape (...)
        Gap h at the start [m].
    surface_tension, wetting, sine : float or ndarray, shape (...)
        Surface tension [N/m], sum of the cosines of both contact angles, and the sine of that on
        the pulled body [-].
    viscosity, time : float or ndarray, shape (...)
        Dynamic viscosity [Pa.s] and separation time t_s [s].

    Notes
    -----
    Above it the viscous force dominates. As printed, at constant radius; at constant volume the
    viscous force is half as large.

    Examples
    --------
    >>> x = critical_radius_published(2e-9, 0.072, 1.0, math.sqrt(0.75), 0.89e-3, 1e-7)
    >>> round(math.pi * x * x * 1e12, 9)
    0.069353809
    """
    # x^3 - 3 p x - 2 q = 0 has one positive root.
    viscous = 0.75 * viscosity / (time * gap * gap)
    p = surface_tension * wetting / (3.0 * viscous * gap)
    q = surface_tension * sine / viscous
    x = 2.0 * (abs(p) ** 0.5 + q ** (1.0 / 3.0))
    for _ in range(60):  # Newton's method from above: convex there, hence monotone
        x = x - (x * x * x - 3.0 * p * x - 2.0 * q) / (3.0 * (x * x - p))
    return x
