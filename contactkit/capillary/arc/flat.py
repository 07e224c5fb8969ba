r"""Liquid bridge between two flats in the circular (toroidal) approximation.

Conventions: body 1 lies below, body 2 above; contact angles run through the liquid; a force is
positive when it pulls the bodies together and is divided by the surface tension, so it is a
length; pressure is that of the liquid less that outside, over the surface tension; no gravity.

============================  ================================================================
:math:`h, V`                  gap and liquid volume
:math:`x_1, x_2`              radii of the lower and upper contact circle
:math:`\varphi`               tangent angle of the meridian, from :math:`\pi-\theta_1` below to
                              :math:`\theta_2` above
:math:`\xi, \eta`             offset from the lower contact circle and height, over the gap
:math:`r_1`                   radius of the arc, positive for a hollow profile
============================  ================================================================

All that depends on the angles alone is computed once for unit gap by `shape` (module `shape`);
what remains is a quadratic. The module does without numpy, so that it runs in a bare interpreter;
gaps, volumes and radii are floats or numpy arrays, angles are floats.

The arc is not an equilibrium shape. Compared with the exact bridge, the error of its force is
below 0.7 % up to a tenth of the exact stability limit, 4 % up to 30 % and 7 % up to 90 % of it for
two wetted flats, and larger beyond; for a wetted flat against a repelling one it is 12 % already at
:math:`x/h = 2`. There is no stability limit: the neck closes at two to ten times the exact limit.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, TypeVar

from ...errors import InfeasibleError
from ...units import quantity_text
from .shape import ArcShape, shape, wetting

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

__all__ = [
    "ArcShape",
    "bulge",
    "closed_neck_error",
    "contact_radius",
    "force",
    "neck",
    "pressure",
    "rim_contact_radius",
    "shape",
    "upper_contact_radius",
    "volume",
    "wetting",
    "zero_neck_gap",
    "zero_neck_gap_at_rim",
]

_Number = TypeVar("_Number", float, "NDArray[np.float64]")


def closed_neck_error(limit: float) -> InfeasibleError:
    """Error that names the gap [m] beyond which there is no arc.

    Examples
    --------
    >>> print(closed_neck_error(1.28e-8))
    no arc bridge beyond 12.8 nm: there its neck has closed
    """
    return InfeasibleError(
        f"no arc bridge beyond {quantity_text(limit, 'm')}: there its neck has closed"
    )


def _smallest(value: Any) -> float:
    """Smallest entry of a float or an array."""
    return float(value.min(initial=math.inf)) if hasattr(value, "min") else float(value)


def contact_radius(shape: ArcShape, gap: _Number, volume: _Number | float) -> _Number:
    r"""Lower contact radius of a bridge of given volume.

    .. math:: x_1/h = \sqrt{V/(\pi h^3) - (b - a^2)} - a

    Parameters
    ----------
    shape : ArcShape
        From `shape`.
    gap, volume : float or ndarray, shape (...)
        Distance of the flats [m], positive, and liquid volume [m^3], positive.

    Returns
    -------
    float or ndarray, shape (...)
        Radius [m] of the lower contact circle: the larger root, which has an open neck.

    Raises
    ------
    InfeasibleError
        If the neck has closed (see `zero_neck_gap`); the message names that gap.

    Examples
    --------
    >>> import math
    >>> round(contact_radius(shape(math.pi / 3, math.pi / 3), 1.0, 1.0), 12)
    0.653390425487
    """
    filling = volume / (math.pi * gap**3)
    if not _smallest(filling) > shape.min_volume:
        raise closed_neck_error(zero_neck_gap(shape, _smallest(volume)))
    mean = shape.mean_offset
    root = (filling - shape.variance) ** 0.5
    # of two forms of the root the one without cancellation
    ratio: _Number = root - mean if mean <= 0.0 else (filling - shape.square_offset) / (root + mean)
    return gap * ratio


def rim_contact_radius(shape: ArcShape, gap: _Number, rim_radius: _Number | float) -> _Number:
    """Lower contact radius [m] at which the larger contact circle has `rim_radius` [m].

    The film is pinned at the rim of a flooded plate, at constant angles instead of constant volume.

    Raises
    ------
    InfeasibleError
        If the neck has closed: the gap is too wide for that rim.

    Examples
    --------
    >>> wide = shape(0.0, 1.0)
    >>> rim_contact_radius(wide, 1e-6, 1e-3)
    0.001
    >>> float(round(upper_contact_radius(shape(1.0, 0.0), 1e-6, rim_contact_radius(
    ...     shape(1.0, 0.0), 1e-6, 1e-3)), 15))
    0.001
    """
    lower = rim_radius - gap * max(0.0, shape.upper_offset)
    if not _smallest(lower + gap * shape.min_offset) > 0.0:
        raise closed_neck_error(zero_neck_gap_at_rim(shape, _smallest(rim_radius)))
    return lower


def zero_neck_gap_at_rim(shape: ArcShape, rim_radius: _Number) -> _Number:
    """Gap [m] at which the neck of a film pinned at a rim closes; inf for two right angles."""
    span = max(0.0, shape.upper_offset) - shape.min_offset
    return rim_radius / span if span > 0.0 else rim_radius * math.inf


def upper_contact_radius(shape: ArcShape, gap: _Number, contact_radius: _Number) -> _Number:
    """Radius [m] of the upper contact circle; arguments as in `force`."""
    return contact_radius + gap * shape.upper_offset


def neck(shape: ArcShape, gap: _Number, contact_radius: _Number) -> _Number:
    """Minimum radius [m] of the bridge, at any height; arguments as in `force`."""
    return contact_radius + gap * shape.min_offset


def bulge(shape: ArcShape, gap: _Number, contact_radius: _Number) -> _Number:
    """Maximum radius [m] of the bridge, at any height; arguments as in `force`."""
    return contact_radius + gap * shape.max_offset


def volume(shape: ArcShape, gap: _Number, contact_radius: _Number) -> _Number:
    r"""Volume [m^3] of the solid of revolution of the arc; arguments as in `force`.

    .. math:: V = \pi h (x_1^2 + 2 a h x_1 + b h^2)

    Examples
    --------
    >>> import math
    >>> round(volume(shape(math.pi / 2, math.pi / 2), 2.0, 1.0) / math.pi, 12)
    2.0
    """
    level = contact_radius + gap * shape.mean_offset
    return math.pi * gap * (level * level + gap * gap * shape.variance)


def force(shape: ArcShape, gap: _Number, contact_radius: _Number) -> _Number:
    r"""Attraction of the flats by the bridge, over the surface tension.

    .. math:: F/\gamma = \pi x_e \sin\varphi_e + \pi x_e^2 / r_1

    evaluated at the neck or bulge of the arc (:math:`\sin\varphi_e = 1`), or, if it has neither,
    at the smaller contact circle.

    Parameters
    ----------
    shape : ArcShape
        From `shape`.
    gap, contact_radius : float or ndarray, shape (...)
        Distance of the flats and radius of the lower contact circle [m], positive.

    Returns
    -------
    float or ndarray, shape (...)
        Force over surface tension [m], one value for both bodies; positive attracts.

    Notes
    -----
    For the error see the head of this module. Eq. (3.11) neglects the azimuthal curvature and
    yields different forces on the two bodies; this one does neither.

    References
    ----------
    .. [1] Orr, Scriven and Rivas (1975), J. Fluid Mech. 67, for the balance through the neck.

    Examples
    --------
    >>> import math
    >>> right = shape(math.pi / 2, math.pi / 2)
    >>> round(force(right, 0.5, 2.0) / math.pi, 12)
    2.0
    """
    plane = contact_radius + gap * shape.plane_offset
    return math.pi * plane * (shape.plane_sine + shape.inverse_radius * (plane / gap))


def pressure(shape: ArcShape, gap: _Number, contact_radius: _Number) -> _Number:
    r"""Pressure of the liquid less that outside, over the surface tension [1/m].

    .. math:: P = \sin\varphi_e / x_e - 1 / r_1

    in the same plane as `force`, so that :math:`F/\gamma = 2\pi x_e\sin\varphi_e - \pi x_e^2 P`.
    Arguments as in `force`; the variation of the pressure along the arc is neglected.
    """
    plane = contact_radius + gap * shape.plane_offset
    return shape.plane_sine / plane - shape.inverse_radius / gap


def zero_neck_gap(shape: ArcShape, volume: _Number) -> _Number:
    r"""Gap [m] at which the neck, or for a bulge the smaller contact circle, closes.

    .. math:: h = \bigl(V / (\pi \textstyle\int (\xi - \xi_{min})^2 d\eta)\bigr)^{1/3}

    Infinite for two right angles. This is the break distance of the dissertation, not the rupture
    of a bridge: the exact bridge becomes unstable at a gap 1.4 to 15 times smaller, unless an angle
    is 180 deg.

    Examples
    --------
    >>> import math
    >>> round(zero_neck_gap(shape(0.0, 0.0), 1.0), 12)
    2.36814678185
    >>> zero_neck_gap(shape(math.pi / 2, math.pi / 2), 1.0)
    inf
    """
    if shape.min_volume == 0.0:
        return volume * math.inf
    # float ** float is Any to type checkers, since negative bases turn complex
    gap: _Number = (volume / (math.pi * shape.min_volume)) ** (1.0 / 3.0)
    return gap
