r"""Exact capillary bridge of given volume between two bodies: `bridge`, and lateral stability.

Conventions: body 1 lies below, body 2 above; contact angles run through the liquid; a force is
positive when it pulls the bodies together and is divided by the surface tension, so it is a
length; pressure is that of the liquid less that outside, over the surface tension; no gravity.

============================  ================================================================
:math:`D, V`                  shortest gap and liquid volume
:math:`\theta_i`              contact angle on body i, through the liquid
:math:`\kappa_i`              curvature 1/R of body i, 0 for a flat
:math:`a, e`                  neck radius of the meridian and its shape, 1 - aP
============================  ================================================================
"""

from __future__ import annotations

from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...errors import DescriptionError
from ..arc.bridge import checked_arguments
from ..arc.shape import SPREADING, refuse_spreading
from .at_pressure import bridge_at_pressure
from .result import KINDS, ExactBridge, assembled
from .solve import BeyondLimitError, columns_at
from .stability import no_bridge_error, stability_limit

__all__ = ["KINDS", "ExactBridge", "bridge", "bridge_at_pressure", "laterally_stable", "margin"]

Array = NDArray[np.float64]


def bridge(
    gap: ArrayLike,
    volume: ArrayLike,
    angle_lower: ArrayLike,
    angle_upper: ArrayLike,
    curvature_lower: ArrayLike = 0.0,
    curvature_upper: ArrayLike = 0.0,
    *,
    beyond: Literal["raise", "nan"] = "raise",
) -> ExactBridge:
    r"""Exact liquid bridge of given volume between two bodies.

    The force is the same for both bodies and at every horizontal section of radius r and tangent
    angle phi:

    .. math:: F/\gamma = 2\pi r \sin\varphi - \pi r^2 P = \pi a (1 + e)

    Parameters
    ----------
    gap : array_like, shape (...)
        Shortest distance of the bodies [m]; zero only if one of them is curved.
    volume : array_like, shape (...)
        Volume of the liquid [m^3], positive.
    angle_lower, angle_upper : array_like, shape (...)
        Contact angles [rad], from 0 (wets) to pi (repels); 0, pi/2 and pi are exact.
    curvature_lower, curvature_upper : array_like, shape (...)
        Curvature 1/R of the bodies [1/m], zero for a flat.
    beyond : {"raise", "nan"}
        Behaviour where no stable bridge exists.

    Returns
    -------
    ExactBridge
        Force, pressure, radii, shape and stiffness, of the broadcast shape.

    Raises
    ------
    InfeasibleError
        If a gap exceeds the stability limit, which is named, or one body is wetted fully and the
        other not at all. With ``beyond="nan"`` such entries are nan.
    DescriptionError
        If an argument is not finite, out of range, or does not broadcast.
    ConvergenceError
        If a bridge should exist and was not found.

    Notes
    -----
    Relative errors of the force are near 1e-14, growing to 1e-8 at the fold itself, where the
    force has a vertical tangent. Neglected: gravity (Bond number), contact-angle hysteresis, and
    lateral motion: a repelling bridge (F < 0) at a curved body is laterally unstable, see
    `laterally_stable`.

    References
    ----------
    .. [1] Orr, Scriven and Rivas (1975), J. Fluid Mech. 67.
    .. [2] Delaunay (1841), J. Math. Pures Appl. 6, for the shapes.

    Examples
    --------
    >>> import math
    >>> state = bridge([0.02, 1.0], 1.0, math.pi / 3, math.pi / 3)
    >>> [round(float(x), 9) for x in state.force]
    [2511.988952834, 2.635835786]
    >>> [KINDS[i] for i in state.kind]
    ['nodoid P<0', 'unduloid']
    >>> bridge(50e-9, 9.27e-25, math.pi / 3, math.pi / 3)
    Traceback (most recent call last):
        ...
    contactkit.errors.InfeasibleError: no bridge beyond 13.85 nm: there it breaks
    """
    if beyond not in ("raise", "nan"):
        raise DescriptionError("bridge.beyond", beyond, "be 'raise' or 'nan'")
    arrays = checked_arguments(
        {
            "gap": gap,
            "volume": volume,
            "angle_lower": angle_lower,
            "angle_upper": angle_upper,
            "curvature_lower": curvature_lower,
            "curvature_upper": curvature_upper,
        }
    )
    gaps, volumes, lower, upper, below, above = (np.ravel(value) for value in arrays.values())
    size = np.cbrt(volumes)
    points = [gaps / size, lower, upper, below * size, above * size]
    spreading = np.cos(0.5 * (lower - upper)) < SPREADING
    if beyond == "raise" and spreading.any():
        i = int(np.argmax(spreading))
        refuse_spreading(float(lower[i]), float(upper[i]))
    where = np.flatnonzero(~spreading)
    try:
        columns = columns_at([value[where] for value in points], beyond)
    except BeyondLimitError as error:
        raise no_bridge_error(error.limit * float(size[where[error.point]])) from None
    return assembled(columns, where, size, arrays["gap"].shape)


def margin(
    gap: ArrayLike,
    volume: ArrayLike,
    angle_lower: ArrayLike,
    angle_upper: ArrayLike,
    curvature_lower: ArrayLike = 0.0,
    curvature_upper: ArrayLike = 0.0,
) -> Array:
    """Margin to the stability limit, ``1 - gap / limit`` [-]; negative beyond it.

    Arguments and errors as in `stability_limit`, and the gap [m].

    Examples
    --------
    >>> import math
    >>> float(round(margin(0.5, 1.0, math.pi / 2, math.pi / 2)[()], 6))
    0.658608
    """
    limit = stability_limit(volume, angle_lower, angle_upper, curvature_lower, curvature_upper)
    return 1.0 - np.asarray(gap, dtype=np.float64) / limit.gap


def laterally_stable(
    force: ArrayLike, curvature_lower: ArrayLike = 0.0, curvature_upper: ArrayLike = 0.0
) -> NDArray[np.bool_]:
    r"""Whether a bridge is stable against lateral displacement along the bodies.

    Between flats it is neutral; with a curved body it is stable if it attracts: the lateral mode
    changes its stability only where the meniscus is a sphere and the force is zero, so that a
    repelling bridge is expelled from between the bodies.

    Parameters
    ----------
    force : array_like, shape (...)
        Force, over surface tension or not; positive attracts.
    curvature_lower, curvature_upper : array_like, shape (...)
        Curvatures 1/R of the bodies [1/m].

    Returns
    -------
    ndarray of bool, shape (...)

    Examples
    --------
    >>> laterally_stable([2.0, -0.1], 0.0, 1e5).tolist()
    [True, False]
    """
    bend = np.asarray(curvature_lower, np.float64) + np.asarray(curvature_upper, np.float64)
    result: NDArray[np.bool_] = (bend == 0.0) | (np.asarray(force, np.float64) >= 0.0)
    return result
