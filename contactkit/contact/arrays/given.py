"""Input of `press_maps`, checked: maps, loads, bound, pixel, tolerance."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np

from ...errors import DescriptionError, InfeasibleError
from ...scene.materials import Solid
from ...scene.window import Axis, Edges
from ..press import number_of, pixel_size_of
from ..solver.problem import LARGEST
from .namespace import Space
from .problem import first_touch

__all__ = [
    "GivenMaps",
    "checked_axis",
    "checked_maps",
    "checked_pixel",
    "checked_solid",
    "checked_tolerance",
    "refuse_closed_gap",
]

# As of `ContactSolver`; in single precision what isolated rough maps of 45 to 256 pixels a side
# reach under any load: 5e-5 at worst, where displacements are 100 times the heights.
RTOL, RTOL_SINGLE = 1e-8, 1e-4
LARGEST_SINGLE = 1e18  # as `LARGEST` [m]


class GivenMaps(NamedTuple):
    """Checked input: heights (n, ny, nx), one of the loads (n, 1, 1), bound, leading axes."""

    heights: Any
    mean_pressure: Any
    rigid_approach: Any
    bound: Any
    leading: tuple[int, ...]


def checked_tolerance(space: Space, rtol: float | None) -> float:
    """Return the tolerance, that of the precision if none is given."""
    if rtol is None:
        return RTOL if space.epsilon < 1e-10 else RTOL_SINGLE
    least = 10.0 * space.epsilon
    if not (math.isfinite(rtol) and rtol >= least):
        raise DescriptionError(
            "press_maps(rtol)", rtol, f"be finite, and at least {least:.2g} in this precision"
        )
    return float(rtol)


def checked_solid(stack: Any) -> Solid:
    """Return the solid of the flat."""
    if not isinstance(stack, Solid):
        raise DescriptionError(
            "press_maps(stack)", stack, "be a Stack or a Material: the solid of the flat"
        )
    return stack


def checked_pixel(pixel_size: Any) -> tuple[float, float]:
    """Return the size (dy, dx) of a pixel [m]."""
    try:
        size = pixel_size_of(pixel_size, "press_maps")
    except TypeError:
        size = math.nan
    pair = size if isinstance(size, tuple) else (size, size)
    if len(pair) != 2 or not all(0.0 < one < math.inf for one in pair):
        raise DescriptionError(
            "press_maps(pixel_size)", pixel_size, "be positive, or two such (dy, dx)", unit="m"
        )
    return pair


def checked_axis(periodic: Any) -> Axis | None:
    """Return the axis along which alone maps repeat."""
    if periodic is True or periodic is False:
        return None
    if periodic == "x" or periodic == "y":
        axis: Axis = periodic
        return axis
    raise DescriptionError("press_maps(periodic)", periodic, 'be True, False, "x" or "y"')


def checked_maps(
    space: Space, heights: Any, mean_pressure: Any, approach: Any, hardness: Any
) -> GivenMaps:
    """Return maps with one leading axis, their loads or approaches, and their bound.

    Raises
    ------
    DescriptionError, InfeasibleError
        As `press_maps`.
    """
    if isinstance(heights, np.ma.MaskedArray):
        raise DescriptionError(
            "press_maps(heights)", "a masked array", "have no mask; holes: a hardness of 0 there"
        )
    xp, h = space.xp, _as_array(space, heights, "heights", "m")
    if h.ndim < 2 or min(h.shape[-2:]) < 2 or 0 in h.shape:
        raise DescriptionError(
            "press_maps(heights)", tuple(h.shape), "be maps of at least 2 x 2 pixels"
        )
    largest, most = float(xp.max(xp.abs(h))), LARGEST if space.epsilon < 1e-10 else LARGEST_SINGLE
    if not largest < most:
        raise DescriptionError(
            "press_maps(heights)",
            largest,
            f"be finite, and below {most:g}",
            unit="m",
            hint="holes: any height there, and a hardness of 0",
        )
    if (mean_pressure is None) == (approach is None):
        raise DescriptionError(
            "press_maps(mean_pressure, approach)",
            "both" if approach is not None else "none",
            "be given one without the other",
        )
    leading, maps = tuple(h.shape[:-2]), tuple(h.shape)
    h = xp.reshape(h, (-1, *maps[-2:]))
    bound = None if hardness is None else _bound(space, hardness, maps)
    if approach is not None:
        depth = _per_map(space, approach, leading, "approach", "m")
        return GivenMaps(h, None, first_touch(space, h) + depth, bound, leading)
    load = _per_map(space, mean_pressure, leading, "mean_pressure", "Pa")
    _check_loads(space, load, bound)
    return GivenMaps(h, load, None, bound, leading)


def refuse_closed_gap(space: Space, given: GivenMaps, periodic: Edges, uniform: float) -> None:
    """No load closes the whole gap of a periodic map whose mean displacement is zero."""
    if given.rigid_approach is None or given.bound is not None or periodic is not True or uniform:
        return
    mean = space.xp.mean(given.heights, axis=(-2, -1), keepdims=True)
    if bool(space.xp.any(given.rigid_approach + mean >= 0.0)):
        raise InfeasibleError(
            "an approach reaches the mean plane of its map, where the gap of a periodic map is "
            "closed under any load; prescribe the load instead"
        )


def _as_array(space: Space, values: Any, name: str, unit: str) -> Any:
    if getattr(values, "requires_grad", False):
        raise DescriptionError(
            f"press_maps({name})",
            "a tensor that requires a gradient",
            "be detached",
            hint="slopes are not recorded here: result.gradient of a contact scene has them",
        )
    if isinstance(values, str):
        values = number_of(values, unit, name, "press_maps")
    elif isinstance(values, list | tuple) and any(isinstance(one, str) for one in values):
        values = [number_of(one, unit, name, "press_maps") for one in values]
    try:
        return space.take(values)
    except (TypeError, ValueError):
        raise DescriptionError(
            f"press_maps({name})",
            f"a {type(values).__name__}",
            "be a number or an array of them, of one shape",
            unit=unit,
        ) from None


def _per_map(space: Space, values: Any, leading: tuple[int, ...], name: str, unit: str) -> Any:
    """One number for each map, (n, 1, 1)."""
    xp, found = space.xp, _as_array(space, values, name, unit)
    if not bool(xp.all(xp.isfinite(found))):
        raise DescriptionError(f"press_maps({name})", "nan or inf", "be finite", unit=unit)
    if tuple(found.shape) not in ((), leading):
        raise DescriptionError(
            f"press_maps({name})", tuple(found.shape), f"be a number, or an array {leading}"
        )
    return xp.reshape(xp.broadcast_to(found, leading), (-1, 1, 1))


def _bound(space: Space, hardness: Any, maps: tuple[int, ...]) -> Any:
    """Upper bound, (n or 1, ny or 1, nx or 1)."""
    xp, bound = space.xp, _as_array(space, hardness, "hardness", "Pa")
    if tuple(bound.shape) not in ((), maps, maps[-2:]):
        raise DescriptionError(
            "press_maps(hardness)",
            tuple(bound.shape),
            f"be a number, or an array {maps[-2:]} or {maps}",
            unit="Pa",
        )
    if not bool(xp.all(bound >= 0.0)):
        lowest = float(xp.min(bound))
        raise DescriptionError("press_maps(hardness)", lowest, "be 0 or positive", unit="Pa")
    return xp.reshape(bound, (-1, *maps[-2:]) if bound.ndim else (1, 1, 1))


def _check_loads(space: Space, load: Any, bound: Any) -> None:
    xp = space.xp
    if bool(xp.any(load < 0.0)):
        raise DescriptionError(
            "press_maps(mean_pressure)", float(xp.min(load)), "be 0 or positive", unit="Pa"
        )
    if bound is None:
        return
    carried = xp.mean(bound, axis=(-2, -1), keepdims=True)
    if bool(xp.any(load > carried * (1.0 + max(1e-12, 10.0 * space.epsilon)))):
        raise InfeasibleError(
            f"a mean pressure of {float(xp.max(load)):.6g} Pa exceeds what the hardness can carry, "
            f"{float(xp.min(carried)):.6g} Pa over a whole map"
        )
