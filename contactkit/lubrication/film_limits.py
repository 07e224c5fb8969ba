"""Viscous force of a film with a cavitation pressure or a limiting shear strength.

Each function takes the state of an opening film and returns the force [N] when the pressure or
the wall shear of the Newtonian film is bounded. All are continuously differentiable where the
bound begins to act, and none exceeds the Newtonian force. Arguments are floats and are not checked.
"""

from __future__ import annotations

import math

from ..numerics.roots import bracketed_root

__all__ = [
    "disc_shear_limited",
    "disc_tension_truncated",
    "disc_tension_reynolds",
    "sphere_shear_limited",
    "sphere_tension_truncated",
]


def disc_tension_truncated(newtonian_force: float, area: float, tension: float) -> float:
    r"""Force [N] of a disc of film whose parabolic pressure is truncated at a tension.

    .. math:: F = M \left(1 - \frac{1}{2 s}\right), \qquad M = A \, \Delta p, \quad
              s = 2 F_N / M > 1

    Parameters
    ----------
    newtonian_force : float
        Force without the limit [N].
    area : float
        Area of the film [m2].
    tension : float
        Tensile strength of the liquid: maximum pressure drop below ambient [Pa].

    Notes
    -----
    Quasi-static cavitation (truncated, Gumbel): the film keeps its extent and reforms at once. At
    most 15 % above `disc_tension_reynolds`, and equal to it in both limits.

    Examples
    --------
    >>> disc_tension_truncated(1.0, 1e-5, 1e6), disc_tension_truncated(1e9, 1e-5, 1e6)
    (1.0, 9.999999975)
    """
    cap = area * tension
    return (
        newtonian_force
        if 2.0 * newtonian_force <= cap
        else cap - 0.25 * cap * cap / newtonian_force
    )


def disc_tension_reynolds(newtonian_force: float, area: float, tension: float) -> float:
    r"""Force [N] of a cavitating disc of film with the Swift-Stieber (Reynolds) condition.

    The cavity ends at :math:`r_c`, where the pressure slope vanishes, with
    :math:`\rho = (r_c/r)^2` from :math:`1/s = 1 - \rho + \rho \ln \rho`, and

    .. math:: F/M = \rho + s \left[\tfrac12 (1-\rho)^2 - \rho(1-\rho) - \rho^2 \ln\rho\right]

    Notes
    -----
    Symbols as in `disc_tension_truncated`. The dynamics of growth and collapse of the cavity are
    neglected (Resch and Scheidl 2014).

    Examples
    --------
    A 6.35 mm plate at 2 um in oil of 0.1 Pa.s, opening at 1 um/s, limit 1 bar:

    >>> import math
    >>> round(disc_tension_reynolds(5.985853220481109, math.pi * 3.175e-3**2, 1e5), 9)
    2.394020682
    """
    cap = area * tension
    s = 2.0 * newtonian_force / cap
    if s <= 1.0:
        return newtonian_force

    def excess(rho: float) -> float:
        return 1.0 - rho + rho * math.log(rho) - 1.0 / s

    x = math.sqrt(2.0 / s)
    if x < 1e-3:  # a narrow rim; the terms below would cancel
        return cap * (1.0 - x / 3.0 - x**3 / 360.0)
    rho = bracketed_root(excess, 1e-300, 1.0)
    log = math.log(rho)
    return cap * (rho + s * (0.5 * (1.0 - rho) ** 2 - rho * (1.0 - rho) - rho * rho * log))


def disc_shear_limited(newtonian_force: float, radius: float, gap: float, strength: float) -> float:
    r"""Force [N] of a disc of film with a limiting shear strength at the walls.

    .. math:: F = \frac{2\pi \tau r^3}{3 h} \left(1 - \frac{1}{4 q^3}\right), \qquad
              q = \frac{3 \eta |\dot h| r}{\tau h^2} > 1

    Parameters
    ----------
    newtonian_force : float
        Force without the limit [N], of either sign.
    radius, gap : float
        Radius of the film and distance of the flats [m].
    strength : float
        Limiting shear strength [Pa].

    Notes
    -----
    The wall shear grows linearly from the centre; beyond the radius r/q it stays at the limit.

    Examples
    --------
    >>> disc_shear_limited(1e-3, 1e-3, 1e-6, 1e6)
    0.001
    >>> round(disc_shear_limited(1e9, 1e-3, 1e-6, 1e6), 6)
    2094.395102
    """
    plastic = 2.0 * math.pi * strength * radius**3 / (3.0 * gap)
    q = 4.0 * abs(newtonian_force) / (3.0 * plastic)
    return (
        newtonian_force
        if q <= 1.0
        else math.copysign(plastic * (1.0 - 0.25 / q**3), newtonian_force)
    )


def sphere_tension_truncated(
    newtonian_force: float, radius: float, gap: float, film_height: float, tension: float
) -> float:
    r"""Force [N] of the film under a sphere whose pressure is truncated at a tension.

    .. math:: F = 2\pi R \left[(H_c - D)\,\Delta p + K \frac{(H - H_c)^2}{H_c H^2}\right],
              \qquad \frac{1}{H_c^2} = \frac{\Delta p}{K} + \frac{1}{H^2}

    with :math:`K = 3 \eta R \dot D`; the pressure is truncated where the film is thinner than
    :math:`H_c`.

    Parameters
    ----------
    newtonian_force : float
        Force without the limit [N].
    radius, gap, film_height : float
        Radius R of the sphere, gap D under its apex, film height H at the rim (may be inf) [m].
    tension : float
        Tensile strength of the liquid: maximum pressure drop below ambient [Pa].

    Examples
    --------
    >>> sphere_tension_truncated(1e-9, 1e-3, 1e-6, 2e-6, 1e5)
    1e-09
    >>> round(sphere_tension_truncated(1e9, 1e-3, 1e-6, 2e-6, 1e5) * 1e6, 6)
    628.318531
    """
    open_fraction = 1.0 - gap / film_height
    if newtonian_force <= 0.0 or open_fraction <= 0.0:
        return newtonian_force
    k = newtonian_force * gap / (2.0 * math.pi * radius * open_fraction**2)
    per_height = 1.0 / film_height
    if k * (1.0 / gap - per_height) * (1.0 / gap + per_height) <= tension:
        return newtonian_force
    cut = 1.0 / math.sqrt(tension / k + per_height * per_height)
    rest = k / cut * (1.0 - cut * per_height) ** 2
    return 2.0 * math.pi * radius * ((cut - gap) * tension + rest)


def sphere_shear_limited(
    newtonian_force: float, radius: float, gap: float, film_height: float, strength: float
) -> float:
    r"""Force [N] of the film under a sphere with a limiting shear strength at the walls.

    The Newtonian wall shear :math:`3 \eta \dot D r / H(r)^2` has a maximum at a finite radius;
    between the radii where it would exceed the limit, the pressure gradient is
    :math:`2 \tau/H` instead, and :math:`F = \int \pi r^2 |p'| dr` keeps its closed form.

    Parameters
    ----------
    newtonian_force : float
        Force without the limit [N], of either sign.
    radius, gap, film_height : float
        Radius R of the sphere, gap D under its apex, film height H at the rim (may be inf) [m].
    strength : float
        Limiting shear strength [Pa].

    Examples
    --------
    >>> sphere_shear_limited(1e-9, 1e-3, 1e-6, 2e-6, 1e6)
    1e-09
    """
    open_fraction = 1.0 - gap / film_height
    if newtonian_force == 0.0 or open_fraction <= 0.0:
        return newtonian_force
    # Wall shear is k*r/H^2 in the Newtonian film.
    k = abs(newtonian_force) * gap / (2.0 * math.pi * radius**2 * open_fraction**2)
    rim = math.sqrt(2.0 * radius * (film_height - gap))

    def excess(r: float) -> float:
        height = gap + r * r / (2.0 * radius)
        return k * r - strength * height * height

    # The excess is concave; it peaks where k = 2 tau r H/R.
    def slope(r: float) -> float:
        return k - 2.0 * strength * r * (gap + r * r / (2.0 * radius)) / radius

    reach = min(
        rim, (k * radius * radius / strength) ** (1.0 / 3.0) + k * radius / (2.0 * strength * gap)
    )
    peak = reach if slope(reach) >= 0.0 else bracketed_root(slope, 0.0, reach)
    if excess(peak) <= 0.0:
        return newtonian_force
    inner = bracketed_root(excess, 0.0, peak)
    far = peak
    while excess(far) > 0.0 and far < rim:
        far = min(2.0 * far, rim)
    outer = far if excess(far) >= 0.0 else bracketed_root(excess, peak, far)
    # Summed from its parts; subtracting the excess from the Newtonian force would cancel.
    left = (
        _sphere_force_between(k, radius, gap, 0.0, inner)
        + _plastic_force_between(strength, radius, gap, inner, outer)
        + _sphere_force_between(k, radius, gap, outer, rim)
    )
    return math.copysign(min(left, abs(newtonian_force)), newtonian_force)


def _sphere_force_between(k: float, radius: float, gap: float, inner: float, outer: float) -> float:
    r"""Newtonian part :math:`2\pi k \int r^3/H^3 dr` between two radii."""
    thin = 2.0 * radius * gap
    # Antiderivative of (H - D)/H^3 is (H - D)^2/(2 D H^2), and 1 - D/H = r^2/(r^2 + 2 R D).
    a, b = (1.0 if math.isinf(r) else r * r / (r * r + thin) for r in (outer, inner))
    return 2.0 * math.pi * k * radius**2 / gap * (a - b) * (a + b)


def _plastic_force_between(
    strength: float, radius: float, gap: float, inner: float, outer: float
) -> float:
    r"""Part at the limiting shear, :math:`2\pi\tau \int r^2/H dr`, between two radii."""
    width = math.sqrt(2.0 * radius * gap)
    # atan(b) - atan(a) as one angle, so that nothing cancels between close radii.
    angle = math.atan2((outer - inner) * width, width * width + outer * inner)
    return 4.0 * math.pi * strength * radius * ((outer - inner) - width * angle)
