r"""Couette film under a sphere that slides at constant gap: drag over the lens of wetted circles.

As in `couette_flat`, with the film thickness h = D + r^2/2R at the distance r from the axis of the
sphere, out to the rim, where it is s. A force is positive when it resists sliding. Arguments are
not checked.

=========  ==========================================  =======
symbol     quantity                                    unit
=========  ==========================================  =======
x          radius of the wetted circles                m
L          travel                                      m
D          gap under the apex of the sphere            m
s          height of the film at its rim               m
R          radius of the sphere                        m
eta        dynamic viscosity                           Pa.s
tau        shear stress on the walls                   Pa
=========  ==========================================  =======
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    Floats = NDArray[np.float64]
    Stress = Callable[[Any], Any]

__all__ = ["sphere_drag", "sphere_impulse", "wetted_radius"]


def wetted_radius(sphere_radius: ArrayLike, gap: ArrayLike, film_height: ArrayLike) -> Any:
    r"""Radius [m] of the wetted circle under a sphere, :math:`x = \sqrt{2R(s-D)}`, Eq. (3.55).

    Examples
    --------
    >>> round(float(wetted_radius(100e-9, 1e-9, 2e-9)) * 1e9, 6)
    14.142136
    """
    depth = np.subtract(film_height, gap)
    return np.sqrt(2.0 * np.asarray(sphere_radius) * np.maximum(depth, 0.0))


def sphere_drag(
    sphere_radius: float,
    gap: float,
    film_height: float,
    travel: ArrayLike,
    stress: Stress,
    kink: float = 0.0,
) -> Any:
    r"""Drag [N] of the film under a sphere after a travel: shear stress over the lens.

    .. math:: F = \int_{lens} \tau\bigl(h(r)\bigr)\,dA, \qquad h = D + \frac{r^2}{2R}

    with r from the axis of the sphere. For Couette flow, tau = eta v/h, and L = 0 this is
    :math:`2\pi\eta R v \ln(s/D)`.

    Parameters
    ----------
    sphere_radius, gap, film_height : float
        Radius R of the sphere, gap D under its apex, film height s at the rim [m].
    travel : float or ndarray, shape (...)
        Travel [m].
    stress : callable
        Shear stress [Pa] as a function of the film thickness [m], for arrays.
    kink : float
        Thickness [m] at which the slope of `stress` is discontinuous; 0: none.

    Returns
    -------
    ndarray, shape (...)
        Force [N]; 0 from L = 2x on; inf at D = 0 up to L = x if the stress has no bound. Relative
        error below 1e-12 for s/D from 1 + 1e-9 to 1e300.

    Notes
    -----
    Shear only. The sliding sphere also generates a pressure, high in front and low behind, which
    adds 4 % at s/D = 2, 23 % at 10 and 39 % at 100: see `lubrication_factor`.

    References
    ----------
    Eqs. (3.45)-(3.56) of Cai and Bhushan (2008b), with the local film thickness.

    Examples
    --------
    >>> force = sphere_drag(100e-9, 1e-9, 2e-9, 0.0, lambda h: 0.89e-3 / h)
    >>> round(float(force) * 1e9, 9)
    0.387610324
    """
    x = float(wetted_radius(sphere_radius, gap, film_height))
    moved = np.minimum(np.asarray(travel, dtype=np.float64), 2.0 * x)[..., None]
    near = np.abs(x - moved)
    inner = np.maximum(x - moved, 0.0)
    at_kink = min(max(2.0 * sphere_radius * (kink - gap), 0.0), x * x) ** 0.5
    touching = gap == 0.0
    if touching:
        gap = 1e-290 * film_height  # so thin a film has no area on which a bounded stress acts
    film = _Film(sphere_radius, gap, x)

    total = np.zeros(moved.shape[:-1])
    for low, high in _pieces(np.zeros_like(inner), inner, at_kink):
        rings = film.rings(low, high)
        flow = rings.height * stress(rings.height)
        total = total + 2.0 * math.pi * np.sum(rings.weight * flow, axis=-1)
    for low, high in _pieces(near, np.full_like(near, x), at_kink):
        rings = film.rings(low, high)
        r, past, left = rings.radius, rings.past + (low - near), rings.left + (x - high)
        half = _half_angle(x, moved, r, past, left)
        flow = rings.height * stress(rings.height)
        total = total + 2.0 * np.sum(half * rings.weight * flow, axis=-1)
    if touching:
        with np.errstate(divide="ignore"):
            is_bounded = bool(np.all(np.isfinite(stress(np.zeros(1)))))
        if not is_bounded:
            total = np.where(moved[..., 0] <= x, math.inf, total)
    return total


def sphere_impulse(
    sphere_radius: float,
    gap: float,
    film_height: float,
    viscosity: float,
    travel: ArrayLike = math.inf,
) -> Any:
    r"""Impulse [N.s] of the Newtonian drag of a sphere over a travel, for any motion in time.

    .. math:: I = 2\eta \int_0^x \frac{r}{h} \left[\phi L - r \sin\phi
              + 2 x E(m) - x E(\phi | m)\right] dr, \qquad m = \frac{r^2}{x^2}

    with phi the half-angle over which the other wetted circle overlaps the ring of radius r, and
    elliptic integrals E: the drag at a point lasts as long as the other circle overlaps it.

    Parameters
    ----------
    sphere_radius, gap, film_height : float
        Radius R of the sphere, gap D under its apex, film height s at the rim [m].
    viscosity : float
        Dynamic viscosity [Pa.s].
    travel : float or ndarray, shape (...)
        Travel L [m]; inf for the total impulse.

    Returns
    -------
    ndarray, shape (...)
        Impulse [N.s]; constant beyond L = 2x, inf at D = 0: it grows as ln(s/D).

    Notes
    -----
    The integral of `sphere_drag` over the travel with the order of integration exchanged; same
    error.

    Examples
    --------
    A film that is even has Eq. (3.52), 8/3:

    >>> x = float(wetted_radius(1e3, 1.0, 1.0 + 1e-9))
    >>> round(float(sphere_impulse(1e3, 1.0, 1.0 + 1e-9, 1.0)) / x**3, 7)
    2.6666667
    """
    from scipy.special import ellipe, ellipeinc

    film = _Film(sphere_radius, gap, float(wetted_radius(sphere_radius, gap, film_height)))
    x = film.rim
    moved = np.minimum(np.asarray(travel, dtype=np.float64), 2.0 * x)[..., None]
    if gap == 0.0:
        return np.where(moved[..., 0] > 0.0, math.inf, 0.0)
    near = np.abs(x - moved)

    # Rings not cut by the other circle: overlapped all the way, or by all of the other circle.
    rings = film.rings(np.zeros_like(near), near)
    whole = np.where(moved < x, math.pi * moved, 2.0 * x * ellipe((rings.radius / x) ** 2))
    total = np.sum(rings.weight * whole, axis=-1)
    rings = film.rings(near, np.full_like(near, x))
    r = rings.radius
    half, m = _half_angle(x, moved, r, rings.past, rings.left), (r / x) ** 2
    lasting = half * moved - r * np.sin(half) + x * (2.0 * ellipe(m) - ellipeinc(half, m))
    total = total + np.sum(rings.weight * lasting, axis=-1)
    return 2.0 * viscosity * total


class _Rings(NamedTuple):
    """Rings of a film: radius and height [m], weight of r dr/h [m], distances to both ends [m]."""

    radius: Any
    height: Any
    weight: Any
    past: Any
    left: Any


class _Film(NamedTuple):
    """Film under a sphere: its radius, the gap under the apex and the radius of the rim [m]."""

    sphere_radius: float
    gap: float
    rim: float

    def rings(self, low: Any, high: Any) -> _Rings:
        r"""Nodes between two radii, in which :math:`r\,dr/h` is even, however thin the film is.

        They are even in the logarithm of the film height, :math:`R\,d\ln h = r\,dr/h`, so that a
        gap of 1e-300 has nodes at all heights up to the rim.
        """
        t, weight, rest = _DOUBLE_EXPONENTIAL
        double = 2.0 * self.sphere_radius
        height = self.gap + low * low / double
        span = np.log1p((high - low) * (high + low) / (double * height))
        grown = double * height * np.expm1(span * t)  # r^2 less that of the inner end
        short = -double * (height * np.exp(span)) * np.expm1(-span * rest)
        radius = np.minimum(np.sqrt(low * low + grown), high)
        with np.errstate(invalid="ignore", divide="ignore"):
            past = np.where(radius > 0.0, grown / (radius + low), 0.0)
            left = np.where(high > 0.0, short / (high + radius), 0.0)
        heights = height * np.exp(span * t)
        return _Rings(radius, heights, self.sphere_radius * span * weight, past, left)


def _pieces(low: Any, high: Any, cut: float) -> list[tuple[Any, Any]]:
    """Split intervals at a point, where it lies inside; a piece may be empty."""
    if cut <= 0.0:
        return [(low, high)]
    middle = np.clip(cut, low, high)
    return [(low, middle), (middle, high)]


def _half_angle(x: float, moved: Any, r: Any, past: Any, left: Any) -> Any:
    """Half of the angle over which a circle of radius r lies inside the other wetted circle.

    Half-angle formula of the triangle of r, L and x; `past` is r less its smallest value, and
    `left` is x - r, which is one of the factors.
    """
    ahead = np.where(moved < x, past, r + (moved - x))  # r + L - x
    behind = np.where(moved < x, r + (x - moved), past)  # r + x - L
    above = moved + left  # L + x - r
    with np.errstate(divide="ignore", invalid="ignore"):
        tangent = np.sqrt(above * behind / (ahead * (r + moved + x)))
    return 2.0 * np.arctan(np.where(np.isnan(tangent), 0.0, tangent))


def _nodes(count: int, reach: float) -> tuple[Floats, Floats, Floats]:
    """Double-exponential rule on 0 to 1: nodes, weights, and 1 minus the nodes, to round-off."""
    u = np.linspace(-reach, reach, count)
    inner = 0.5 * math.pi * np.sinh(u)
    t, rest = 1.0 / (1.0 + np.exp(-2.0 * inner)), 1.0 / (1.0 + np.exp(2.0 * inner))
    weight = (u[1] - u[0]) * math.pi * np.cosh(u) * t * rest
    return t, weight, rest


# Impulses over s/D from 1 + 1e-9 to 1e12 are exact to 2e-14 from 91 nodes on; 45 leave 8e-11.
# Integrands have a square root at either end, for which Gauss' rule would take thousands.
_DOUBLE_EXPONENTIAL = _nodes(181, 4.0)
