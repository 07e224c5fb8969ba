r"""Exact liquid bridge of given pressure between two bodies, as in equilibrium with a vapour.

Conventions: body 1 lies below, body 2 above; contact angles run through the liquid; a force is
positive when it pulls the bodies together and is divided by the surface tension, so it is a
length; pressure is that of the liquid less that outside, over the surface tension; no gravity.
Symbols are those of `bridge`.
"""

from __future__ import annotations

from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from ...errors import DescriptionError, InfeasibleError
from ..arc.bridge import checked_arguments
from ..arc.shape import SPREADING, refuse_spreading
from .pressure_branch import branch_at_pressure
from .result import ExactBridge, assembled
from .solve import BeyondLimitError, columns_at
from .stability import no_bridge_error

__all__ = ["branch_at_pressure", "bridge_at_pressure", "max_gap_at_pressure"]

# Of pressure over curvature. The ring of liquid has a contact radius of the inverse root of it:
# beyond, its height, the square of that, is lost in round-off beside the size of the body.
_VAST = 1e12
_FLATS = (
    "no bridge between flats is stable at fixed pressure: the slit fills to its rim, or dries up; "
    "give a volume, or curve one of the bodies"
)


def bridge_at_pressure(
    gap: ArrayLike,
    pressure: ArrayLike,
    angle_lower: ArrayLike,
    angle_upper: ArrayLike,
    curvature_lower: ArrayLike = 0.0,
    curvature_upper: ArrayLike = 0.0,
    *,
    beyond: Literal["raise", "nan"] = "raise",
) -> ExactBridge:
    r"""Exact liquid bridge of given pressure between two bodies.

    Parameters
    ----------
    gap : array_like, shape (...)
        Shortest distance of the bodies [m].
    pressure : array_like, shape (...)
        Pressure of the liquid less that outside, over the surface tension [1/m]: minus one over
        the Kelvin radius below saturation.
    angle_lower, angle_upper : array_like, shape (...)
        Contact angles [rad], from 0 to pi.
    curvature_lower, curvature_upper : array_like, shape (...)
        Curvature 1/R of the bodies [1/m]; one of them at least is positive.
    beyond : {"raise", "nan"}
        Behaviour where no stable bridge exists.

    Returns
    -------
    ExactBridge
        As from `bridge`; `volume` is a result, and `stiffness` is at fixed pressure.

    Raises
    ------
    InfeasibleError
        If a gap exceeds the maximum at that pressure, which is named, or no stable bridge exists.
    DescriptionError
        If an argument is not finite, out of range, or does not broadcast.

    Notes
    -----
    A bridge is stable at fixed pressure if its volume increases with pressure at fixed gap. The
    branch starts from a thin ring of liquid between touching bodies and ends at the fold of the gap
    at fixed pressure, long before the limit at fixed volume. The second bridge beyond that fold is
    the nucleus of condensation; it is unstable and not returned. Between two flats every bridge of
    fixed pressure is unstable: below a gap of
    ``(cos(angle_lower) + cos(angle_upper)) / -pressure`` the liquid fills the slit, beyond it
    evaporates; such input is refused.

    References
    ----------
    .. [1] Orr, Scriven and Rivas (1975), J. Fluid Mech. 67.

    Examples
    --------
    >>> import math
    >>> state = bridge_at_pressure([0.0, 0.005], -100.0, 0.0, 0.0, 0.0, 1.0)
    >>> [round(float(x) / (4.0 * math.pi), 5) for x in state.force]
    [0.96032, 0.70537]
    """
    if beyond not in ("raise", "nan"):
        raise DescriptionError("bridge.beyond", beyond, "be 'raise' or 'nan'")
    try:
        level = np.asarray(pressure, dtype=np.float64)
    except (TypeError, ValueError):
        raise DescriptionError("bridge.pressure", pressure, "be a number", unit="1/m") from None
    if not np.isfinite(level).all():
        bad = float(level[~np.isfinite(level)].flat[0])
        raise DescriptionError("bridge.pressure", bad, "be finite", unit="1/m")
    arrays = checked_arguments(
        {
            "gap": gap,
            "volume": np.ones_like(level),
            "angle_lower": angle_lower,
            "angle_upper": angle_upper,
            "curvature_lower": curvature_lower,
            "curvature_upper": curvature_upper,
        }
    )
    gaps, _, lower, upper, below, above = (np.ravel(value) for value in arrays.values())
    pressures = np.ravel(np.broadcast_to(level, arrays["gap"].shape))
    bend = below + above
    flat = bend == 0.0
    if beyond == "raise" and flat.any():
        raise InfeasibleError(_FLATS)
    size = 1.0 / np.where(flat, 1.0, bend)
    if (vast := abs(pressures) * size > _VAST).any():
        raise DescriptionError(
            "bridge.pressure",
            float(pressures[vast][0]),
            "be at most 1e12 times the curvature",
            unit="1/m",
            hint="so small a bridge is smaller than an atom; take its limit",
        )
    spreading = np.cos(0.5 * (lower - upper)) < SPREADING
    if beyond == "raise" and spreading.any():
        i = int(np.argmax(spreading))
        refuse_spreading(float(lower[i]), float(upper[i]))
    where = np.flatnonzero(~flat & ~spreading)
    points = [gaps / size, lower, upper, below * size, above * size]
    try:
        columns = columns_at([value[where] for value in points], beyond, (pressures * size)[where])
    except BeyondLimitError as error:
        raise no_bridge_error(error.limit * float(size[where[error.point]])) from None
    return assembled(columns, where, size, arrays["gap"].shape)


def max_gap_at_pressure(
    pressure: float,
    angle_lower: float,
    angle_upper: float,
    curvature_lower: float = 0.0,
    curvature_upper: float = 0.0,
) -> float:
    """Maximum gap [m] of a bridge of given pressure: the fold at fixed pressure.

    Arguments and errors as in `bridge_at_pressure`.

    Examples
    --------
    >>> round(max_gap_at_pressure(-1e3, 0.0, 0.0, 0.0, 1.0), 10)
    0.0017977471
    """
    # the bridge between touching bodies validates the arguments and raises if there is none
    bridge_at_pressure(0.0, pressure, angle_lower, angle_upper, curvature_lower, curvature_upper)
    bend = curvature_lower + curvature_upper
    curve = branch_at_pressure(
        pressure / bend, angle_lower, angle_upper, curvature_lower / bend, curvature_upper / bend
    )
    return float(curve.gap[-1]) / bend
