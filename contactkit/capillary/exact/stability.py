r"""Stability limit of a liquid bridge of given volume: fold, pitchfork or detachment.

Conventions: body 1 lies below, body 2 above; contact angles run through the liquid; a force is
positive when it pulls the bodies together and is divided by the surface tension, so it is a
length; pressure is that of the liquid less that outside, over the surface tension; no gravity.

============================  ================================================================
:math:`D, V`                  shortest gap and liquid volume
:math:`\theta_i`              contact angle on body i, through the liquid
:math:`\kappa_i`              curvature 1/R of body i, 0 for a flat
============================  ================================================================

The limit has a cusp at equal bodies and is not interpolated there: 60/60 degrees gives 1.4205 cube
roots of the volume, 60/60.1 degrees 1.4095.
"""

from __future__ import annotations

import itertools
import math
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...errors import ConvergenceError, InfeasibleError
from ..arc.bridge import checked_arguments
from ..arc.shape import refuse_spreading, rounded_angle
from .chart import Pair, solids
from .continuation import FreeBranch, march_free, relax_curvature
from .newton import Solution, from_arc, problem, solve
from .volume_branch import DETACHMENT, PITCHFORK, Branch, flat_branch, march

__all__ = [
    "LIMITS",
    "Key",
    "Limit",
    "branch",
    "contact",
    "is_cylinder",
    "no_bridge_error",
    "stability_limit",
]

Array = NDArray[np.float64]

Key = tuple[float, float, float, float]  # two contact angles [rad], two curvatures
LIMITS = ("fold", "pitchfork", "detachment")
# Where to start with free ends: factors on the curvatures (flatter bodies are easier) and gaps
# [cube roots of the volume]. Of 32 random pairs of a wetting and a repelling body 29 need none of
# this and two succeeded at once; the last was given up after 24 s.
_FACTORS = (1.0, 0.5, 0.2, 0.1, 0.03, 0.01)
_FREE_STARTS = (0.05, 0.02, 0.01, 0.1, 0.2, 0.003)
_MAX_FAILED = 30  # of 36 at most: each lost attempt takes about half a second
# Gaps at which a first bridge is looked for: in the middle of the range of common ones, where the
# arc is good and the branch is short. Any one of them serves 24 random pairs, at the same cost.
_STARTS = (0.1, 0.03, 0.2, 0.01, 0.4, 0.003, 0.0)
_CYLINDER = math.pi ** (1.0 / 3.0)


_NOT_TOUCHING = (
    "no bridge was found between touching bodies; give less volume, or take the arc, arc_bridge"
)


class Limit(NamedTuple):
    """Bridges at the stability limit; all arrays of the broadcast shape of the arguments.

    Attributes
    ----------
    gap : ndarray
        Maximum gap [m] of a stable bridge of the volume.
    kind : ndarray of int
        0 fold, 1 pitchfork, 2 detachment; see `LIMITS`.
    force : ndarray
        Force over surface tension at the limit [m]; zero at a detachment.
    pressure : ndarray
        Pressure over surface tension at the limit [1/m].
    radius_lower, radius_upper : ndarray
        Contact radii at the limit [m].
    """

    gap: Array
    kind: NDArray[np.int64]
    force: Array
    pressure: Array
    radius_lower: Array
    radius_upper: Array


def contact(
    angle_lower: float, angle_upper: float, curvature_lower: float, curvature_upper: float
) -> Solution:
    """Bridge of unit volume between touching bodies, one of them curved at least."""
    angles = np.array([[angle_lower], [angle_upper]])
    curvatures = np.array([[curvature_lower], [curvature_upper]])
    zero, one = np.zeros(1), np.ones(1)
    given = problem(zero, one, (angles[0], angles[1]), (curvatures[0], curvatures[1]))
    found = from_arc(given, (angles[0], angles[1]), (curvatures[0], curvatures[1]))
    if found.good[0]:
        return found
    # for large volumes the circular approximation is a poor start: begin with more curvature
    factor = 1.0
    while not found.good[0]:
        factor *= 4.0
        if factor > 1e9:
            raise ConvergenceError(_NOT_TOUCHING)
        scaled_curvature = (factor * curvatures[0], factor * curvatures[1])
        given = problem(zero, one, (angles[0], angles[1]), scaled_curvature)
        found = from_arc(given, (angles[0], angles[1]), scaled_curvature)
    ratio = 0.5
    while factor > 1.0:
        trial = max(factor * ratio, 1.0)
        given = problem(
            zero, one, (angles[0], angles[1]), (trial * curvatures[0], trial * curvatures[1])
        )
        bodies = given.bodies.swapped(found.flipped)
        new = solve(given._replace(bodies=bodies), found.log_neck, found.chart, found.flipped)
        if new.good[0]:
            factor, found = trial, new
        elif ratio > 0.999:
            raise ConvergenceError(_NOT_TOUCHING)
        else:
            ratio = math.sqrt(ratio)
    return found


@lru_cache(maxsize=512)
def branch(
    angle_lower: float, angle_upper: float, curvature_lower: float, curvature_upper: float
) -> Branch | FreeBranch:
    """Branch of bridges of unit volume up to its limit; not for two flats at right angles."""
    refuse_spreading(angle_lower, angle_upper)
    angle_lower, angle_upper = rounded_angle(angle_lower), rounded_angle(angle_upper)
    with np.errstate(all="ignore"):
        if curvature_lower == curvature_upper == 0.0:
            angles = np.array([angle_lower]), np.array([angle_upper])
            lower, upper = (solids(angle, np.zeros(1)) for angle in angles)
            flip = bool(abs(upper.cosine[0]) > abs(lower.cosine[0]))
            symmetric = np.array([angle_lower == angle_upper])
            return flat_branch(
                Pair(upper, lower, symmetric) if flip else Pair(lower, upper, symmetric), flip
            )
        return _curved(angle_lower, angle_upper, curvature_lower, curvature_upper)


def _curved(lower: float, upper: float, below: float, above: float) -> Branch | FreeBranch:
    try:
        start = _start(lower, upper, below, above)
        return march(
            start.bodies, bool(start.flipped[0]), float(start.log_neck[0]), float(start.chart[0])
        )
    except ConvergenceError:
        return _free_branch(lower, upper, below, above)


def _free_branch(lower: float, upper: float, below: float, above: float) -> FreeBranch:
    """Branch of unit volume with free ends, by continuation from more curved bodies if needed."""
    angles = np.array([lower]), np.array([upper])
    one, curvatures = np.ones(1), (np.array([below]), np.array([above]))
    lost: list[ConvergenceError] = []
    for factor, gap in itertools.product(_FACTORS, _FREE_STARTS):
        if len(lost) == _MAX_FAILED:
            break
        more = (factor * curvatures[0], factor * curvatures[1])
        found = from_arc(problem(np.array([gap]), one, angles, more), angles, more)
        if found.good[0]:
            bodies = problem(np.array([gap]), one, angles, curvatures).bodies
            try:
                start = found.unknowns[:, 0]
                return march_free(bodies, relax_curvature(bodies, factor, start, gap), gap)
            except ConvergenceError as error:
                lost.append(error)
    raise ConvergenceError(
        "no stable bridge was found between bodies so strongly curved; give less volume",
        lost[-1] if lost else None,
    )


def _start(
    angle_lower: float, angle_upper: float, curvature_lower: float, curvature_upper: float
) -> Solution:
    """Stable bridge of unit volume from which the gap increases with decreasing zeta."""
    angles = np.array([angle_lower]), np.array([angle_upper])
    curvatures = np.array([curvature_lower]), np.array([curvature_upper])
    for gap in _STARTS:
        given = problem(np.array([gap]), np.ones(1), angles, curvatures)
        found = from_arc(given, angles, curvatures)
        if found.good[0] and found.found.volume_by_neck[0] > 0.0:
            return found
    return contact(angle_lower, angle_upper, curvature_lower, curvature_upper)


def _length(value: float) -> str:
    units = ((1.0, "m"), (1e-3, "mm"), (1e-6, "um"), (1e-9, "nm"))
    unit, name = next((pair for pair in units if value >= pair[0]), units[-1])
    return f"{value / unit:.4g} {name}"


def no_bridge_error(limit: float) -> InfeasibleError:
    """Error that names the stability limit [m]."""
    return InfeasibleError(f"no bridge beyond {_length(limit)}: there it breaks")


def is_cylinder(lower: float, upper: float, below: float, above: float) -> bool:
    """Whether both bodies are flats at right contact angles, so that all bridges are cylinders."""
    return below == above == 0.0 and lower == upper == 0.5 * math.pi


def _limit(lower: float, upper: float, below: float, above: float) -> tuple[float, ...]:
    """Columns of a `Limit` at unit volume."""
    if is_cylinder(lower, upper, below, above):
        r = _CYLINDER / math.pi
        return _CYLINDER, PITCHFORK, math.pi * r, 1.0 / r, r, r
    curve = branch(lower, upper, below, above)
    a, shape, first, last = curve.last
    force = 0.0 if curve.kind == DETACHMENT else math.pi * a * (1.0 + shape)
    return float(curve.gap[-1]), curve.kind, force, (1.0 - shape) / a, first, last


def stability_limit(
    volume: ArrayLike,
    angle_lower: ArrayLike,
    angle_upper: ArrayLike,
    curvature_lower: ArrayLike = 0.0,
    curvature_upper: ArrayLike = 0.0,
) -> Limit:
    r"""Maximum gap of a stable bridge of given volume, and the bridge at that gap.

    It is the smallest gap at which an axisymmetric neutral mode appears: the fold, where the gap
    has its maximum along the branch; between equal bodies and for angles above about 31.1 degrees
    (flats) the pitchfork before it, an antisymmetric mode of the profile,

    .. math:: (P/2 - f/r^2) \cos\beta = \kappa \cos(\theta + \beta), \quad f = F/(2\pi\gamma);

    on a body with a contact angle of 180 degrees detachment, where the contact circle has shrunk to
    a point and the gap is the height of the drop on the other body.

    Parameters
    ----------
    volume : array_like, shape (...)
        Volume of the liquid [m^3], positive.
    angle_lower, angle_upper : array_like, shape (...)
        Contact angles [rad], from 0 to pi, not 0 against pi.
    curvature_lower, curvature_upper : array_like, shape (...)
        Curvatures 1/R of the bodies [1/m], zero for a flat.

    Returns
    -------
    Limit
        Gap [m], kind, force, pressure and contact radii of the last stable bridge.

    Raises
    ------
    InfeasibleError
        For contact angles of 0 and 180 degrees, between which no bridge exists.
    DescriptionError
        If an argument is not finite, out of range, or does not broadcast.
    ConvergenceError
        If no limit was found.

    Notes
    -----
    Relative errors are near 1e-14. Each combination of angles and of curvatures over the cube
    root of the volume is followed once, in some ten milliseconds, and cached. Neglected: lateral
    motion (see `bridge.bridge`), pinned contact lines, and gravity.

    References
    ----------
    .. [1] Vogel (1987, 1989), SIAM J. Appl. Math. 47 and 49, for bridges between plates.
    .. [2] Lowry and Steen (1995), Proc. R. Soc. A 449, for folds and pitchforks.

    Examples
    --------
    >>> import math
    >>> float(round(stability_limit(1.0, 1.0, 1.1).gap[()], 9))
    1.262915934
    >>> limit = stability_limit(1.0, math.pi / 2, math.pi / 2)
    >>> float(round(limit.gap / limit.radius_lower - math.pi, 12)), LIMITS[int(limit.kind)]
    (0.0, 'pitchfork')
    """
    arrays = checked_arguments(
        {
            "gap": 1.0,
            "volume": volume,
            "angle_lower": angle_lower,
            "angle_upper": angle_upper,
            "curvature_lower": curvature_lower,
            "curvature_upper": curvature_upper,
        }
    )
    _, volumes, *rest = (np.ravel(value) for value in arrays.values())
    size = np.cbrt(volumes)
    keys = np.stack((rest[0], rest[1], rest[2] * size, rest[3] * size))
    unique, which = np.unique(keys, axis=1, return_inverse=True)
    with np.errstate(all="ignore"):  # failures are detected
        found = np.array([_limit(*key) for key in unique.T.tolist()]).reshape(-1, 6)
    columns = found[which.reshape(-1)].T
    shape = arrays["volume"].shape
    kind = columns[1].astype(np.int64)
    scaled = (
        columns[0] * size,
        kind,
        columns[2] * size,
        columns[3] / size,
        columns[4] * size,
        columns[5] * size,
    )
    return Limit(*(value.reshape(shape) for value in scaled))
