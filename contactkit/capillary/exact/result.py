"""Forces, radii, shape and stiffness of solved liquid bridges."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .free_ends import Free
from .newton import Solution

__all__ = ["KINDS", "ExactBridge", "assembled", "cylinders", "from_chart", "from_free"]

Array = NDArray[np.float64]
Columns = dict[str, Array]

KINDS = ("cylinder", "unduloid", "catenoid", "nodoid P<0", "sphere", "nodoid P>0")
# A shape this close to that of a cylinder, catenoid or sphere counts as one. It only names them: an
# error of e is some 1e-14, and angles typed with ten digits are to give the shape that is meant.
_SAME = 1e-9
_POWERS = {"pressure": -1, "volume": 3, "shape": 0, "stiffness": 0}  # of the unit of length


class ExactBridge(NamedTuple):
    """Bridges; all arrays of the broadcast shape of the arguments, nan where there is none.

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
    volume : ndarray
        Volume of the liquid [m^3].
    kind : ndarray of int
        Index into `KINDS`, -1 where there is no bridge.
    neck_radius, shape : ndarray
        Neck radius [m] of the Delaunay surface, where the meridian or its continuation is vertical,
        and ``1 - neck_radius * pressure`` [-], negative if it is a bulge instead.
    arc_lower, arc_upper : ndarray
        Arc lengths [m] of the meridian from the neck down to the lower and up to the upper contact
        circle; one is negative if the neck lies outside the bridge.
    stiffness : ndarray
        Derivative of `force` by the gap [-], at fixed volume (or pressure).
    """

    force: Array
    pressure: Array
    radius_lower: Array
    radius_upper: Array
    neck: Array
    bulge: Array
    volume: Array
    kind: NDArray[np.int64]
    neck_radius: Array
    shape: Array
    arc_lower: Array
    arc_upper: Array
    stiffness: Array


def _kind(shape: Array) -> NDArray[np.int64]:
    near = [abs(shape - value) < _SAME for value in (0.0, 1.0, -1.0)]
    names = np.select([*near, shape > 1.0, shape < -1.0], [0, 2, 4, 3, 5], 1)
    result: NDArray[np.int64] = np.where(np.isfinite(shape), names, -1).astype(np.int64)
    return result


def _columns(
    neck_radius: Array,
    shape: Array,
    pull: Array,
    radii: tuple[Array, Array],
    arcs: tuple[Array, Array],
    flip: NDArray[np.bool_],
) -> Columns:
    """Columns without derivatives; radii and arcs over the neck radius, limiting end first."""
    inside = (arcs[0] >= 0.0) & (arcs[1] >= 0.0)
    smallest, largest = np.minimum(*radii), np.maximum(*radii)
    return {
        "force": np.pi * neck_radius * pull,
        "pressure": (1.0 - shape) / neck_radius,
        "radius_lower": neck_radius * np.where(flip, radii[1], radii[0]),
        "radius_upper": neck_radius * np.where(flip, radii[0], radii[1]),
        "neck": neck_radius * np.where(inside & (shape > 0.0), np.minimum(smallest, 1.0), smallest),
        "bulge": neck_radius * np.where(inside & (shape < 0.0), np.maximum(largest, 1.0), largest),
        "neck_radius": neck_radius,
        "shape": shape,
        "arc_lower": neck_radius * np.where(flip, arcs[1], arcs[0]),
        "arc_upper": neck_radius * np.where(flip, arcs[0], arcs[1]),
    }


def from_chart(found: Solution, *, at_pressure: bool = False) -> Columns:
    """Columns of bridges found in the chart, in the unit of the solution."""
    at, ends, a = found.found, found.found.ends, np.exp(found.log_neck)
    first, last = ends.limiting, ends.second
    second_by_neck, second_by_chart = at.volume_by_neck, at.volume_by_chart
    if at_pressure:
        second_by_neck, second_by_chart = -at.shape_by_neck - ends.pressure, -at.shape_by_chart
    determinant = at.gap_by_neck * second_by_chart - at.gap_by_chart * second_by_neck
    d_force = (ends.force + at.shape_by_neck) * second_by_chart - at.shape_by_chart * second_by_neck
    radii, arcs = (first.radius, last.radius), (first.arc, last.arc)
    return _columns(a, ends.shape, ends.force, radii, arcs, found.flipped) | {
        "volume": at.volume,
        "stiffness": np.pi * a * d_force / determinant,
    }


def from_free(found: Free, flipped: bool) -> Columns:
    """Columns of bridges with free ends."""
    log_neck, shape, first, last = found.unknowns
    a = np.exp(log_neck)
    unit = np.array([[[1.0], [0.0], [0.0], [0.0]]])
    moved = np.linalg.solve(found.jacobian, unit)[..., 0]
    flip = np.full(a.shape, flipped)
    radii = (found.radii[0], found.radii[1])
    return _columns(a, shape, 1.0 + shape, radii, (first, last), flip) | {
        "volume": found.volume,
        "stiffness": np.pi * a * ((1.0 + shape) * moved[:, 0] + moved[:, 1]),
    }


def cylinders(gap: Array) -> Columns:
    """Cylindrical bridges of unit volume between flats at right contact angles."""
    r = 1.0 / np.sqrt(np.pi * gap)
    still = np.zeros_like(r)
    columns = _columns(
        r, still, still + 1.0, (still + 1.0, still + 1.0), (still, gap / r), still > 0.0
    )
    return columns | {"volume": still + 1.0, "stiffness": -0.5 * np.pi * r / gap}


def assembled(
    columns: Columns, where: NDArray[np.intp], size: Array, form: tuple[int, ...]
) -> ExactBridge:
    """Result from columns in units of `size`, scaled; nan for points without a bridge."""
    whole: dict[str, Array] = {}
    for name in ExactBridge._fields:
        if name != "kind":
            value = np.full(size.shape, np.nan)
            if where.size:
                value[where] = columns[name]
            whole[name] = value * size ** _POWERS.get(name, 1)
    kind = _kind(whole["shape"]).reshape(form)
    shaped = {name: value.reshape(form) for name, value in whole.items()}
    return ExactBridge(kind=kind, **shaped)
