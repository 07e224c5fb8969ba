r"""Capillary bridge between two bodies in the circular (toroidal) approximation: `arc_bridge`.

Conventions: body 1 lies below, body 2 above; contact angles run through the liquid; a force is
positive when it pulls the bodies together and is divided by the surface tension, so it is a
length; pressure is that of the liquid less that outside, over the surface tension; no gravity.

The approximation is fast, and explicit between flats; it is not an equilibrium shape and has no
stability limit. For reliable numbers use the exact bridge.
"""

from __future__ import annotations

import math
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...errors import ConvergenceError, DescriptionError, InfeasibleError
from . import flat as arc_flat
from . import sphere as arc_sphere
from .shape import SPREADING, refuse_spreading

__all__ = ["Bridge", "arc_bridge"]

Array = NDArray[np.float64]
# Curvature times the size of the drop, below which it counts as zero: the sag of the body is then
# lost beside any gap, and squares of radii of curvature would overflow soon after (at 1e-154).
_FLAT = 1e-60


class Bridge(NamedTuple):
    """Bridges in the circular approximation; all arrays of the broadcast shape of the arguments.

    Attributes
    ----------
    force : ndarray
        Force over surface tension [m], the same on both bodies; positive attracts.
    pressure : ndarray
        Pressure of the liquid less that outside, over the surface tension [1/m].
    radius_lower, radius_upper : ndarray
        Radii of the contact circles [m].
    neck, bulge : ndarray
        Minimum and maximum radius of the bridge [m], at any height.
    """

    force: Array
    pressure: Array
    radius_lower: Array
    radius_upper: Array
    neck: Array
    bulge: Array


def _refuse(
    name: str, values: Array, bad: NDArray[np.bool_], expected: str, unit: str, hint: str = ""
) -> None:
    if bad.any():
        value = float(values[bad].flat[0])
        if name.startswith("angle") and math.pi < value <= 180.0:
            hint = "was it meant in degrees?"
        raise DescriptionError(f"bridge.{name}", value, expected, unit=unit, hint=hint)


def checked_arguments(given: dict[str, ArrayLike]) -> dict[str, Array]:
    """Arguments as arrays of one shape, validated."""
    try:
        loose = {name: np.asarray(value, dtype=np.float64) for name, value in given.items()}
        arrays = dict(zip(loose, np.broadcast_arrays(*loose.values()), strict=True))
    except (TypeError, ValueError) as error:
        shapes = {name: np.shape(value) for name, value in given.items() if np.ndim(value)}
        raise DescriptionError(
            "bridge", shapes, "be given numbers or arrays that broadcast"
        ) from error
    for name, value in arrays.items():
        finite = np.isfinite(value)
        if name.startswith("angle"):
            wrong = ~(finite & (value >= 0.0) & (value <= math.pi))
            _refuse(name, value, wrong, "lie between 0 and pi", "rad")
        elif name == "volume":
            _refuse(name, value, ~(finite & (value > 0.0)), "be positive and finite", "m^3")
        else:
            wrong, unit = ~(finite & (value >= 0.0)), "m" if name == "gap" else "1/m"
            _refuse(name, value, wrong, "be zero or positive, and finite", unit)
    for name in ("curvature_lower", "curvature_upper"):
        tiny = arrays[name] * np.cbrt(arrays["volume"]) < _FLAT
        arrays[name] = np.where(tiny, 0.0, arrays[name])
    flat = (arrays["curvature_lower"] == 0.0) & (arrays["curvature_upper"] == 0.0)
    _refuse(
        "gap",
        arrays["gap"],
        flat & (arrays["gap"] == 0.0),
        "be positive between flats",
        "m",
        hint="touching flats are a contact problem, not a bridge",
    )
    return arrays


def _between_flats(points: list[Array], beyond: str) -> list[Array]:
    """Six columns for points between flats, one pair of contact angles at a time."""
    gap, volume, lower, upper = points[:4]
    columns = [np.full(gap.shape, np.nan) for _ in Bridge._fields]
    pairs, which = np.unique(np.stack((lower, upper)), axis=1, return_inverse=True)
    which = which.reshape(-1)
    for i, angles in enumerate(pairs.T.tolist()):
        here = np.flatnonzero(which == i)
        shape = arc_flat.shape(*angles)
        # at the limit the neck has closed; round-off must not decide on which side it falls
        limit = arc_flat.zero_neck_gap(shape, volume[here])
        good = gap[here] < limit * (1.0 - 1e-12)
        if not good.all():
            if beyond == "raise":
                raise arc_flat.closed_neck_error(float(limit[~good][0]))
            here = here[good]
        h = gap[here]
        x = arc_flat.contact_radius(shape, h, volume[here])
        columns[0][here] = arc_flat.force(shape, h, x)
        columns[1][here] = arc_flat.pressure(shape, h, x)
        columns[2][here] = x
        columns[3][here] = arc_flat.upper_contact_radius(shape, h, x)
        columns[4][here] = arc_flat.neck(shape, h, x)
        columns[5][here] = arc_flat.bulge(shape, h, x)
    return columns


def _no_arc(point: list[float], closed: bool) -> Exception:
    """Exception that states why a point between curved bodies has no arc."""
    gap, volume, lower, upper, below, above = point
    try:
        limit = arc_sphere.zero_neck_gap(volume, lower, upper, below, above)
    except InfeasibleError as nowhere:
        return nowhere
    if gap >= limit * (1.0 - 1e-12):
        return arc_flat.closed_neck_error(limit)
    if closed:
        return InfeasibleError(
            f"no arc bridge at a gap of {gap!r} m: its neck is closed there, though not up "
            f"to {limit!r} m"
        )
    return ConvergenceError(
        f"no arc was found at a gap of {gap!r} m, below {limit!r} m; take the exact bridge"
    )


def _between_curved(points: list[Array], beyond: str) -> list[Array]:
    """Six columns for points with a curved body, all at once."""
    gap, volume, lower, upper, below, above = points
    state = arc_sphere.solve(gap, volume, lower, upper, below, above)
    unsure = ~state.found if beyond == "raise" else ~state.found & ~state.closed
    for i in np.flatnonzero(unsure):
        error = _no_arc([float(column[i]) for column in points], bool(state.closed[i]))
        if beyond == "raise" or isinstance(error, ConvergenceError):
            raise error
    return [
        state.force,
        state.pressure,
        state.radius_lower,
        state.radius_upper,
        state.neck,
        state.bulge,
    ]


def arc_bridge(
    gap: ArrayLike,
    volume: ArrayLike,
    angle_lower: ArrayLike,
    angle_upper: ArrayLike,
    curvature_lower: ArrayLike = 0.0,
    curvature_upper: ArrayLike = 0.0,
    beyond: Literal["raise", "nan"] = "raise",
) -> Bridge:
    r"""Liquid bridge of given volume between two bodies, in the circular approximation.

    The force is evaluated at the neck or bulge of the arc and is the same for both bodies:

    .. math:: F/\gamma = \pi x_e \sin\varphi_e + \pi x_e^2 / r_1

    Parameters
    ----------
    gap : array_like, shape (...)
        Shortest distance of the bodies [m]; zero only if one of them is curved.
    volume : array_like, shape (...)
        Volume of the liquid [m^3], positive.
    angle_lower, angle_upper : array_like, shape (...)
        Contact angles [rad], from 0 (wets) to pi (repels); 0, pi/2 and pi are exact.
    curvature_lower, curvature_upper : array_like, shape (...)
        Curvature 1/R of the bodies [1/m], zero for a flat; less than 1e-60 over the size of the
        drop counts as zero.
    beyond : {"raise", "nan"}
        What to do where no arc exists.

    Returns
    -------
    Bridge
        Force, pressure, contact radii, neck and bulge, of the broadcast shape.

    Raises
    ------
    InfeasibleError
        If there is no arc: the neck has closed (the gap at which it does is named), or one body
        is wetted fully and the other not at all. With ``beyond="nan"`` such entries are nan.
    DescriptionError
        If an argument is not finite, out of range, or does not broadcast.
    ConvergenceError
        If an arc should exist and was not found.

    Notes
    -----
    The pressure of the profile is not uniform. For hydrophilic pairs the error of the force is
    below 0.7 % up to a tenth of the exact stability limit, 4 % up to 30 % and 7 % up to 90 % of
    it, and 5 to 19 % beyond; the neck of the arc closes at two to ten times the stability limit.
    Contact radii and neck are accurate to 0.25 % for equal angles and radii of five gaps or more.
    The lateral instability of a repelling bridge between curved bodies is not represented.

    References
    ----------
    .. [1] Cai and Bhushan (2007a); Eqs. (3.37)-(3.41) of the dissertation for the arc.
    .. [2] Orr, Scriven and Rivas (1975), J. Fluid Mech. 67, for the balance through the neck.

    Examples
    --------
    >>> import math
    >>> state = arc_bridge([0.02, 1.0], 1.0, math.pi / 3, math.pi / 3)
    >>> [round(float(x), 9) for x in state.force]
    [2511.442846189, 2.479372043]
    >>> arc_bridge(50e-9, 9.27e-25, math.pi / 3, math.pi / 3)
    Traceback (most recent call last):
        ...
    contactkit.errors.InfeasibleError: no arc bridge beyond 44.09 nm: there its neck has closed
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
    points = [np.ravel(value) for value in arrays.values()]
    columns = [np.full(points[0].shape, np.nan) for _ in Bridge._fields]
    spreading = np.cos(0.5 * (points[2] - points[3])) < SPREADING
    if beyond == "raise" and spreading.any():
        i = int(np.argmax(spreading))
        refuse_spreading(float(points[2][i]), float(points[3][i]))
    flat = (points[4] == 0.0) & (points[5] == 0.0)
    for where, solver in (
        (flat & ~spreading, _between_flats),
        (~flat & ~spreading, _between_curved),
    ):
        if where.any():
            found = solver([column[where] for column in points], beyond)
            for column, values in zip(columns, found, strict=True):
                column[where] = values
    return Bridge(*(column.reshape(arrays["gap"].shape) for column in columns))
