r"""Meniscus forces of chapter 3 as printed, by equation number, for reproduction only.

Conventions: body 1 lies below, body 2 above; contact angles run through the liquid; forces in N,
positive when they attract or resist separation, so that the minus signs printed in Eqs. (3.18),
(3.19) and (3.34) are dropped. Angles are floats; other arguments are floats or numpy arrays.
`ERRATA` lists the errors; the correct forms are in `capillary.arc` and `lubrication.squeeze_film`.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, Literal

from ...capillary.arc.shape import wetting
from ...errors import DescriptionError, InfeasibleError
from .errata import ERRATA
from .viscous import (
    viscous_divided_3_34,
    viscous_flat_3_18,
    viscous_flat_3_19,
    viscous_number_3_43,
    viscous_sphere_3_22,
    viscous_sphere_3_26,
    viscous_sphere_3_27,
)

if TYPE_CHECKING:
    from ...capillary.arc.sphere import ArcState

__all__ = [
    "ERRATA",
    "laplace_sphere_3_7",
    "laplace_sphere_3_8",
    "line_tension_3_9",
    "meniscus_divided_3_33",
    "meniscus_flat_3_11",
    "meniscus_number_3_42",
    "meniscus_of_circle_3_12",
    "meniscus_sphere_3_12",
    "neck_by_curvature_3_12",
    "viscous_divided_3_34",
    "viscous_flat_3_18",
    "viscous_flat_3_19",
    "viscous_number_3_43",
    "viscous_sphere_3_22",
    "viscous_sphere_3_26",
    "viscous_sphere_3_27",
]

_ROUND_OFF = 1e-14  # of a curvature over that of the radius: less is a cylinder, not an arc


def _pulled_angle(
    angle_lower: float, angle_upper: float, pulled: Literal["lower", "upper"]
) -> float:
    if pulled not in ("lower", "upper"):
        raise DescriptionError("pulled", pulled, "be 'lower' or 'upper'")
    return angle_lower if pulled == "lower" else angle_upper


def laplace_sphere_3_7(
    sphere_radius: Any,
    gap: Any,
    immersion: Any,
    surface_tension: Any,
    angle_lower: float,
    angle_upper: float,
) -> Any:
    r"""Laplace force [N] on a sphere at a gap D, wetted to a depth d0 [m], Eq. (3.7).

    .. math:: F_L = 2\pi R\gamma(\cos\theta_1 + \cos\theta_2) / (1 + D/d_0)

    Correct for thin films at a fixed film height; see `ERRATA` for constant volume.

    Examples
    --------
    >>> round(laplace_sphere_3_7(1.0, 0.5, 0.5, 1.0, 0.0, 0.0) / math.pi, 12)
    2.0
    """
    pull = 2.0 * math.pi * sphere_radius * surface_tension * wetting(angle_lower, angle_upper)
    return pull * (immersion / (immersion + gap))


def laplace_sphere_3_8(sphere_radius: Any, surface_tension: Any, angle: float) -> Any:
    r"""Laplace force [N] on a sphere above a continuous film, :math:`2\pi R\gamma(1+\cos\theta)`.

    Eq. (3.8), correct for thin films.

    Examples
    --------
    >>> round(laplace_sphere_3_8(1.0, 1.0, 0.0) / math.pi, 12)
    4.0
    """
    return 2.0 * math.pi * sphere_radius * surface_tension * (1.0 + math.cos(angle))


def line_tension_3_9(
    sphere_radius: Any, surface_tension: Any, filling_angle: float, angle_upper: float
) -> Any:
    r"""Surface-tension force [N] at the contact line of a sphere, Eq. (3.9), which is correct.

    .. math:: F_T = 2\pi R\gamma\sin\phi\sin(\phi+\theta_2)

    The filling angle [rad] is the slope of the sphere at the line.

    Examples
    --------
    >>> round(line_tension_3_9(1.0, 1.0, math.pi / 2, 0.0) / math.pi, 12)
    2.0
    """
    return (
        2.0
        * math.pi
        * sphere_radius
        * surface_tension
        * math.sin(filling_angle)
        * math.sin(filling_angle + angle_upper)
    )


def meniscus_flat_3_11(
    radius: Any,
    gap: Any,
    surface_tension: Any,
    angle_lower: float,
    angle_upper: float,
    pulled: Literal["lower", "upper"] = "lower",
) -> Any:
    r"""Meniscus force [N] between flats, Eqs. (3.5) and (3.11).

    .. math:: F_m = \pi x^2\gamma(\cos\theta_1+\cos\theta_2)/h + 2\pi\gamma x\sin\theta_{1,2}

    Parameters
    ----------
    radius, gap, surface_tension : float or ndarray, shape (...)
        Meniscus radius at the pulled body and distance of the flats [m], surface tension [N/m].
    angle_lower, angle_upper : float
        Contact angles [rad].
    pulled : {"lower", "upper"}
        Body whose contact angle enters the line tension.

    Examples
    --------
    >>> round(meniscus_flat_3_11(100e-9, 2e-9, 0.072, math.pi / 3, math.pi / 3) * 1e9, 6)
    1170.151422
    """
    return meniscus_divided_3_33(radius, gap, surface_tension, angle_lower, angle_upper, 1, pulled)


def meniscus_divided_3_33(
    radius: Any,
    gap: Any,
    surface_tension: Any,
    angle_lower: float,
    angle_upper: float,
    number: Any,
    pulled: Literal["lower", "upper"] = "lower",
) -> Any:
    r"""Meniscus force [N] of a film divided into equal menisci, Eq. (3.33).

    .. math:: \pi x^2\gamma(\cos\theta_1+\cos\theta_2)/h + 2\sqrt{N}\pi\gamma x\sin\theta_{1,2}

    Arguments as in `meniscus_flat_3_11`; `radius` is that of the undivided meniscus.

    Examples
    --------
    >>> one, four = (meniscus_divided_3_33(1.0, 1.0, 1.0, math.pi / 2, math.pi / 2, n)
    ...              for n in (1, 4))
    >>> round(four / one, 12)
    2.0
    """
    sine = math.sin(_pulled_angle(angle_lower, angle_upper, pulled))
    laplace = math.pi * radius**2 * surface_tension * wetting(angle_lower, angle_upper) / gap
    return laplace + 2.0 * number**0.5 * math.pi * surface_tension * radius * sine


def meniscus_sphere_3_12(state: ArcState, surface_tension: Any, angle_upper: Any) -> Any:
    r"""Meniscus force [N] on a sphere above a flat, Eq. (3.12), with the printed plus sign.

    .. math::
        F_m = \pi x_n^2\gamma\Bigl(\frac{1}{r_1} + \frac{1}{x_c - r_1}\Bigr)
              + 2\pi R\gamma\sin\phi\sin(\phi+\theta_2)

    Parameters
    ----------
    state : ArcState
        Arc from `arc_sphere.solve`, the sphere being the upper body; ``profile="parabola"`` is
        that of the source (Eq. 3.37).
    surface_tension, angle_upper : float or ndarray, shape (...)
        Surface tension [N/m] and contact angle on the sphere [rad].

    Raises
    ------
    DescriptionError
        If the lower body is curved.

    Notes
    -----
    The radius :math:`R\sin\phi` of the contact circle is that of the arc, :math:`x_n`, and
    :math:`\phi` the slope of the body there; on a paraboloid the two differ slightly.

    Examples
    --------
    >>> from contactkit.capillary.arc import sphere as arc_sphere
    >>> state = arc_sphere.solve(1e-9, 927.31633935e-27, math.pi / 3, math.pi / 3, 0.0, 1e7,
    ...                          profile="parabola")
    >>> round(float(meniscus_sphere_3_12(state, 0.072, math.pi / 3)) * 1e9, 6)
    28.935837
    """
    import numpy as np

    if np.any(abs(state.slope_lower) > 0.0):
        raise DescriptionError(
            "meniscus_sphere_3_12.state",
            "a curved lower body",
            "have its sphere above a flat",
            hint="swap the bodies and their angles",
        )
    force = meniscus_of_circle_3_12(
        state.radius_upper, state.slope_upper, state.inverse_arc_radius, angle_upper
    )
    return surface_tension * force


def meniscus_of_circle_3_12(x: Any, slope: Any, inverse: Any, angle_upper: Any) -> Any:
    r"""Meniscus force of Eq. (3.12) over the surface tension [m].

    Infinite, with a change of sign, where :math:`x_c = r_1`: the circle of the arc, drawn on beyond
    its contact lines, reaches the axis there, long before a neck closes if the angles are unlike.

    Parameters
    ----------
    x, slope : float or ndarray, shape (...)
        Radius [m] of the contact circle on the sphere and slope of the sphere there [rad].
    inverse : float or ndarray, shape (...)
        Curvature 1/r1 of the arc [1/m].
    angle_upper : float
        Contact angle on the sphere [rad].

    Examples
    --------
    >>> round(float(meniscus_of_circle_3_12(1.0, 0.0, 0.0, math.pi / 2)) / math.pi, 12)
    3.0
    """
    import numpy as np

    centre = neck_by_curvature_3_12(x, slope, inverse, angle_upper)
    # A cylinder, whose x_c - r1 is its radius; at a pole the arc is curved.
    straight = (abs(centre) <= _ROUND_OFF) & (abs(x * inverse) <= _ROUND_OFF)
    with np.errstate(divide="ignore"):
        second = np.where(straight, 1.0 / x, inverse / np.where(straight, 1.0, centre))
    return np.pi * x**2 * (inverse + second) + 2.0 * np.pi * x * np.sin(slope + angle_upper)


def neck_by_curvature_3_12(x: Any, slope: Any, inverse: Any, angle_upper: Any) -> Any:
    """Radius x_c - r1 of the neck in Eq. (3.12) times 1/r1 [-], finite for a straight arc.

    Arguments as in `meniscus_of_circle_3_12`.

    Examples
    --------
    >>> float(neck_by_curvature_3_12(2.0, 0.0, 1.0, 0.0))  # x_c = 2 and r1 = 1
    1.0
    """
    import numpy as np

    return x * inverse - (1.0 - np.sin(angle_upper + slope))


def meniscus_number_3_42(
    force: Any, radius: Any, surface_tension: Any, angle_lower: float, angle_upper: float
) -> Any:
    r"""Dimensionless meniscus force, :math:`F_m/(\pi x_{n0}\gamma(c_1+c_2))`, Eq. (3.42).

    Raises
    ------
    InfeasibleError
        For contact angles that add up to 180 deg, where it is infinite.

    Examples
    --------
    >>> round(meniscus_number_3_42(2.0 * math.pi, 1.0, 1.0, 0.0, 0.0), 12)
    1.0
    """
    sum_of_cosines = wetting(angle_lower, angle_upper)
    if abs(sum_of_cosines) < 1e-15:
        raise InfeasibleError("Eq. (3.42) is infinite: the contact angles add up to 180 deg")
    return force / (math.pi * radius * surface_tension * sum_of_cosines)
