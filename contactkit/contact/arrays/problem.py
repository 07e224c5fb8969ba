"""The dimensionless contact problem of many maps.

Minimise ``p'Gp/2 - h'p`` over ``0 <= p <= upper`` for each map, with the sum of its pressures or
its rigid-body approach prescribed. Each map has its own units: its rms height, and the pressure
that displaces a pixel by it.

Sign convention: pressure, heights and displacement positive into the solid; ``u - h - approach`` is
the gap.
"""

from __future__ import annotations

from typing import Any, NamedTuple

from ..solver.optimality import ROUNDED
from .namespace import Space

__all__ = ["MapsProblem", "balanced", "first_touch", "pose_maps", "restricted"]

DOUBLE = 2.220446049250313e-16  # round-off that `ROUNDED` is made of


class MapsProblem(NamedTuple):
    """Dimensionless problem of n maps; numbers of a map are arrays (n, 1, 1).

    heights : (n, ny, nx), of zero mean; load, approach : one of them, None for the other
    upper : (n or 1, ny or 1, nx or 1) bounds; None for none
    rms : 1, or 0 of flat heights
    flat : displacement of a pixel under the mean pressure, at least 1
    length, pressure, datum : units [m], [Pa] and the mean height [m] that was taken off
    """

    heights: Any
    load: Any
    approach: Any
    upper: Any
    rms: Any
    flat: Any
    length: Any
    pressure: Any
    datum: Any


def first_touch(space: Space, heights: Any) -> Any:
    """Rigid-body approach [m] at which each undeformed map touches, (n, 1, 1)."""
    return -space.highest(heights)


def pose_maps(
    space: Space,
    heights: Any,
    self_influence: float,
    mean_pressure: Any = None,
    rigid_approach: Any = None,
    bound: Any = None,
) -> MapsProblem:
    """Make problems dimensionless; `solver.problem.pose` of many maps, without its checks.

    Parameters
    ----------
    space : Space
        Of all arrays.
    heights : array (n, ny, nx)
        [m]
    self_influence : float
        [m/Pa]
    mean_pressure, rigid_approach : array (n, 1, 1), optional
        [Pa], [m]; exactly one of them.
    bound : array (n or 1, ny or 1, nx or 1), optional
        [Pa]

    Examples
    --------
    >>> import numpy as np
    >>> from .namespace import space_of
    >>> heights, pressed = np.array([[[1e-9, 3e-9], [1e-9, 3e-9]]]), np.array([[[1e9]]])
    >>> space = space_of(heights)
    >>> round(float(pose_maps(space, heights, 1e-19, mean_pressure=pressed).load[0, 0, 0]), 9)
    0.4
    """
    xp, (ny, nx) = space.xp, heights.shape[-2:]
    datum = xp.mean(heights, axis=(-2, -1), keepdims=True)
    h = heights - datum
    h = h - xp.mean(h, axis=(-2, -1), keepdims=True)
    largest = space.highest(xp.abs(h))
    zero = xp.zeros_like(largest)
    one = h / xp.where(largest > 0.0, largest, zero + 1.0)  # squares of nanometres underflow
    rms = largest * xp.sqrt(xp.mean(one * one, axis=(-2, -1), keepdims=True))
    pressed = zero if mean_pressure is None else self_influence * mean_pressure
    rounded = ROUNDED * space.epsilon / DOUBLE * xp.maximum(space.highest(xp.abs(heights)), pressed)
    is_flat = rms <= rounded
    only = pressed if rigid_approach is None else xp.abs(rigid_approach + datum)
    length = xp.where(is_flat, xp.where(only > 0.0, only, zero + 1.0), rms)
    unit = length / self_influence
    load = None if mean_pressure is None else mean_pressure / unit * (ny * nx)
    pressed_in_units = zero if load is None else load / (ny * nx)
    return MapsProblem(
        heights=xp.where(is_flat, xp.zeros_like(h), h / length),
        load=load,
        approach=None if rigid_approach is None else (rigid_approach + datum) / length,
        upper=None if bound is None else bound / unit,
        rms=xp.where(is_flat, zero, zero + 1.0),
        flat=xp.maximum(zero + 1.0, pressed_in_units),
        length=length,
        pressure=unit,
        datum=datum,
    )


def balanced(space: Space, p: Any, free: Any, problem: MapsProblem) -> Any:
    """Pressures within the bounds whose sum is the load, from any.

    Truncated, then those between the bounds scaled; where none is, what is missing is spread evenly
    over the `free` pixels. One that exceeds its bound by this is truncated the next time.
    """
    xp, load, upper = space.xp, problem.load, problem.upper
    zero = xp.zeros_like(p)
    p = xp.maximum(p, zero) if upper is None else xp.minimum(xp.maximum(p, zero), upper)
    if load is None:
        return p
    missing = load - space.total(p)
    between = p > 0.0 if upper is None else (p > 0.0) & (p < upper)
    carried = space.total(xp.where(between, p, zero))
    can_scale = carried > xp.maximum(-missing, xp.zeros_like(missing))
    factor = 1.0 + missing / xp.where(can_scale, carried, xp.ones_like(carried))
    even = missing / xp.maximum(space.count(free), xp.ones_like(missing))
    scaled = xp.where(between, p * factor, p)
    return xp.where(can_scale, scaled, xp.where(free, p + even, p))


def restricted(problem: MapsProblem, average: Any, pixels: int, coarse_pixels: int) -> MapsProblem:
    """The problem on a coarser grid: same mean pressure, same approach; `average` of maps."""
    upper, load = problem.upper, problem.load
    if upper is not None and upper.shape[-1] * upper.shape[-2] > 1:
        upper = average(upper)
    return problem._replace(
        heights=average(problem.heights),
        upper=upper,
        load=None if load is None else load * (coarse_pixels / pixels),
    )
