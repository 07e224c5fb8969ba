r"""Liquid bridge between two curved bodies in the circular (toroidal) approximation.

Conventions: body 1 lies below, body 2 above; contact angles run through the liquid; a force is
positive when it pulls the bodies together and is divided by the surface tension, so it is a
length; pressure is that of the liquid less that outside, over the surface tension; no gravity.

============================  ================================================================
:math:`D, V`                  shortest gap and liquid volume
:math:`\kappa_i`              curvature 1/R of body i, 0 for a flat
:math:`x_i, s_i, \beta_i`     radius of a contact circle, its height, slope of the body there
:math:`p_1, p_2`              tangent angles of the meridian, :math:`\pi-\theta_1-\beta_1` below
                              and :math:`\theta_2+\beta_2` above
:math:`Y, r_1`                height of the profile, :math:`D+s_1+s_2`, and radius of the arc,
                              positive for a hollow profile
============================  ================================================================

Compared with the exact bridge between wetted bodies, the error of the force is up to 1 % at contact
for V < 1e-2 R^3 and 3.5 % for 0.1 R^3, 7 % up to 90 % of the exact stability limit, and larger
beyond. There is no stability limit: the neck closes at two to ten times the exact limit.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...errors import ConvergenceError, DescriptionError, InfeasibleError
from ...numerics.roots import bracketed_root
from . import flat as arc_flat
from .contact_circles import ArcProblem, acceptable, circle, equations, follow, iterate, outline
from .shape import refuse_spreading

__all__ = ["ArcState", "solve", "volume", "zero_neck_gap"]

Array = NDArray[np.float64]


class ArcState(NamedTuple):
    """Solutions, all arrays of the broadcast shape; nan where no arc has an open neck.

    Attributes
    ----------
    radius_lower, radius_upper, slope_lower, slope_upper : ndarray
        Radii of the contact circles [m] and slopes of the bodies there [rad].
    neck, bulge : ndarray
        Minimum and maximum radius of the bridge [m], at any height.
    plane_radius, plane_sine : ndarray
        Radius [m] and sine of the tangent angle where the force is evaluated.
    height, inverse_arc_radius : ndarray
        Height of the profile [m] and curvature 1/r1 of the arc [1/m], positive if hollow.
    found, closed : ndarray of bool
        Whether an arc exists; if not, whether its neck closed along the continuation path.
    """

    radius_lower: Array
    radius_upper: Array
    slope_lower: Array
    slope_upper: Array
    neck: Array
    bulge: Array
    plane_radius: Array
    plane_sine: Array
    height: Array
    inverse_arc_radius: Array
    found: NDArray[np.bool_]
    closed: NDArray[np.bool_]

    @property
    def force(self) -> Array:
        r"""Force of the bridge on either body, over the surface tension [m]; positive attracts.

        .. math:: F/\gamma = \pi x_e \sin\varphi_e + \pi x_e^2 / r_1

        evaluated at the neck or bulge of the arc (:math:`\sin\varphi_e = 1`), or, if it has
        neither, at the smaller contact circle: one value for both bodies.
        """
        x = self.plane_radius
        return np.pi * x * (self.plane_sine + x * self.inverse_arc_radius)

    @property
    def pressure(self) -> Array:
        r"""Pressure of the liquid less that outside, over the surface tension [1/m].

        .. math:: P = \sin\varphi_e / x_e - 1 / r_1

        in the plane of `force`; the variation of the pressure along the arc is neglected.
        """
        return self.plane_sine / self.plane_radius - self.inverse_arc_radius


def _check_profile(profile: str) -> None:
    if profile not in ("sphere", "parabola"):
        raise DescriptionError("profile", profile, "be 'sphere' or 'parabola'")


def _problem(*given: ArrayLike) -> tuple[ArcProblem, tuple[int, ...]]:
    arrays = np.broadcast_arrays(*(np.asarray(value, dtype=np.float64) for value in given))
    return ArcProblem(*(np.ravel(value) for value in arrays)), arrays[0].shape


def solve(
    gap: ArrayLike,
    volume: ArrayLike,
    angle_lower: ArrayLike,
    angle_upper: ArrayLike,
    curvature_lower: ArrayLike = 0.0,
    curvature_upper: ArrayLike = 0.0,
    profile: str = "sphere",
) -> ArcState:
    r"""Circular bridges of given volume and contact angles, for all points at once.

    .. math::
        x_2 - x_1 = Y \cot\frac{p_1 + p_2}{2}, \qquad
        \pi \int x^2 \, dy - V_{cap,1} - V_{cap,2} = V, \qquad
        \frac{1}{r_1} = \frac{\cos(\theta_1+\beta_1) + \cos(\theta_2+\beta_2)}{Y}

    Parameters
    ----------
    gap, volume : array_like, shape (...)
        Shortest gap [m], zero for touching bodies, and liquid volume [m^3].
    angle_lower, angle_upper : array_like, shape (...)
        Contact angles [rad], from 0 to pi.
    curvature_lower, curvature_upper : array_like, shape (...)
        Curvatures 1/R [1/m] of the bodies, zero or positive; at least one is positive.
    profile : {"sphere", "parabola"}
        True spheres, or the paraboloids of Eq. (3.37), with an error of 3 to 14 % of the force at
        contact for V > 1e-2 R^3.

    Returns
    -------
    ArcState
        Geometry of the arcs; points without one are nan and not `found`.

    Notes
    -----
    Three Newton iterations as a rule (see `contact_circles`); relative errors are near 1e-15.

    References
    ----------
    .. [1] Cai and Bhushan (2007a); Eqs. (3.37)-(3.41) of the dissertation.

    Examples
    --------
    >>> state = solve([0.1], 0.01, np.pi / 3, np.pi / 3, 0.0, 1.0, profile="parabola")
    >>> round(float(state.radius_upper[0]), 12), round(float(state.force[0]), 12)
    (0.175746277401, 1.16903719525)
    """
    _check_profile(profile)
    bend = (curvature_lower, curvature_upper)
    problem, form = _problem(gap, volume, angle_lower, angle_upper, *bend)
    with np.errstate(all="ignore"):  # failed points are detected below
        one, two, found = iterate(problem, profile)
        found &= acceptable(problem, one, two, profile)
        closed = ~found & (problem.curvature_lower + problem.curvature_upper == 0.0)
        missed = np.flatnonzero(~found & ~closed)
        if missed.size:
            one[missed], two[missed], found[missed], closed[missed] = follow(
                problem.at(missed), profile
            )
        one[~found] = two[~found] = np.nan
        below = circle(one, problem.curvature_lower, profile)
        above = circle(two, problem.curvature_upper, profile)
        shape = outline(problem, below, above)

    def shaped(flat: Array) -> Array:
        return flat.reshape(form)

    return ArcState(
        shaped(below.radius),
        shaped(above.radius),
        shaped(below.slope),
        shaped(above.slope),
        shaped(shape.neck),
        shaped(shape.bulge),
        shaped(shape.plane_radius),
        shaped(shape.plane_sine),
        shaped(shape.height),
        shaped(shape.inverse_arc_radius),
        found.reshape(form),
        closed.reshape(form),
    )


def volume(
    gap: float,
    radius_upper: float,
    angle_lower: float,
    angle_upper: float,
    curvature_lower: float = 0.0,
    curvature_upper: float = 0.0,
    profile: str = "sphere",
) -> float:
    """Volume [m^3] of the circular bridge with a given upper contact radius [m].

    This converts the height of an initial film, ``D + x^2 / 2R``, to a volume, which Eq. (3.23)
    approximates by a film with a cylindrical rim.

    Raises ConvergenceError if there is no lower contact circle for the upper one.

    Examples
    --------
    >>> round(volume(1.0, 200.0**0.5, np.pi / 3, np.pi / 3, 0.0, 0.01, "parabola"), 9)
    927.31633935
    """
    _check_profile(profile)
    problem, _ = _problem([gap], 0.0, angle_lower, angle_upper, curvature_lower, curvature_upper)
    place = radius_upper
    if profile == "sphere" and curvature_upper > 0.0:
        place = float(np.arcsin(curvature_upper * radius_upper)) / curvature_upper
    one = two = np.array([place])
    for _ in range(60):
        e = equations(problem, one, two, profile)
        step = e.tilt / e.tilt_lower
        one = one - step
        if abs(step[0]) <= 4e-16 * (abs(one[0]) + e.height[0]):
            break
    e = equations(problem, one, two, profile)
    leans = abs(e.tilt[0]) <= 1e-12 * (radius_upper + e.height[0]) and abs(e.turn[0]) < np.pi
    if not (leans and one[0] > 0.0 and e.excess[0] > 0.0):
        raise ConvergenceError(
            f"no arc meets the upper body at a radius of {radius_upper!r} m; give a smaller "
            f"radius, or contact angles that differ less"
        )
    return float(e.excess[0])


def _widest(
    gaps: Array, fixed: tuple[float, ...], profile: str
) -> tuple[float, tuple[Array, Array]]:
    """Largest gap of the first interval of gaps with an arc, and its contact circles."""
    problem, _ = _problem(gaps, *fixed)
    with np.errstate(all="ignore"):
        one, two, found = iterate(problem, profile)
        found &= acceptable(problem, one, two, profile)
        if not found.any():
            one, two, found, _ = follow(problem, profile)
    if not found.any():
        raise InfeasibleError("no arc bridge at any gap between these bodies")
    after = np.flatnonzero(~found & (np.arange(gaps.size) > np.argmax(found)))
    last = int(after[0]) - 1 if after.size else gaps.size - 1
    return float(gaps[last]), (one[last : last + 1], two[last : last + 1])


def _track(
    gap: float, start: tuple[Array, Array], fixed: tuple[float, ...], profile: str
) -> tuple[float, tuple[Array, Array]]:
    """Neck at a gap near that of `start` (negative beyond the limit), and the contact circles."""
    problem, _ = _problem([gap], *fixed)
    with np.errstate(all="ignore"):
        one, two, settled = iterate(problem, profile, start)
        below = circle(one, problem.curvature_lower, profile)
        above = circle(two, problem.curvature_upper, profile)
        neck = float(outline(problem, below, above).neck[0])
    return neck if settled[0] else -float(fixed[0] ** (1.0 / 3.0)), (one, two)


def zero_neck_gap(
    volume: float,
    angle_lower: float,
    angle_upper: float,
    curvature_lower: float = 0.0,
    curvature_upper: float = 0.0,
    profile: str = "sphere",
) -> float:
    """Gap [m] at which the neck, or for a bulge the smaller contact circle, closes.

    The break distance of the dissertation, not the rupture of a bridge: see `flat`. Infinite if
    the neck stays open up to a hundred times the size of drop and bodies.

    Raises
    ------
    InfeasibleError
        If there is no arc at any gap, as between angles of 0 and 180 deg.

    Examples
    --------
    >>> round(zero_neck_gap(927.31633935, np.pi / 3, np.pi / 3, 0.0, 0.01, "parabola"), 6)
    45.204163
    """
    _check_profile(profile)
    fixed = (volume, angle_lower, angle_upper, curvature_lower, curvature_upper)
    if curvature_lower == curvature_upper == 0.0:
        return arc_flat.zero_neck_gap(arc_flat.shape(angle_lower, angle_upper), volume)
    refuse_spreading(angle_lower, angle_upper)
    size = volume ** (1.0 / 3.0)
    reach = 100.0 * (size + sum(1.0 / curvature for curvature in fixed[3:] if curvature > 0.0))
    gaps = np.append(0.0, np.geomspace(1e-4 * size, reach, 160))
    near, place = _widest(gaps, fixed, profile)
    far = near
    while far < reach:
        far = max(1.2 * near, float(gaps[1]))
        width, there = _track(far, place, fixed, profile)
        if width <= 0.0:
            break
        near, place = far, there
    else:
        return float("inf")

    def neck(gap: float) -> float:
        return _track(gap, place, fixed, profile)[0]

    limit = near
    if neck(near) > 0.0 > neck(far):
        limit = bracketed_root(neck, near, far, rtol=1e-14)
    if abs(neck(limit)) > 1e-9 * size:
        raise ConvergenceError(
            f"no closing neck between gaps of {near!r} and {far!r} m; take the limit of the exact "
            f"bridge, stability_limit"
        )
    return limit
