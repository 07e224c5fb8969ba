"""Ranges of validity of pressed maps: slope, peak pressure and edges of the worst of them."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any, NamedTuple

from ...scene.window import Edges
from ...validity import ValidityNumber
from ..plausible import FLATTEST
from ..validity import jump_number, peak_number, slope_number
from .namespace import Space

__all__ = ["check_maps"]

_PIXELS = 2**22  # of maps that are looked at together: differences take as much room as they do


class _Extremes(NamedTuple):
    """Lowest and highest rms slope of maps, and the largest jump at their edges."""

    flattest: float
    steepest: float
    jump: float


def check_maps(
    space: Space, heights: Any, pressure: Any, modulus: float, window: tuple[Any, Edges]
) -> tuple[ValidityNumber, ...]:
    """Evaluate the worst of each number over all maps; those of one map are named as by `press`.

    Parameters
    ----------
    space : Space
        Space of the maps.
    heights, pressure : array (n, ny, nx)
        Heights [m] and pressures [Pa].
    modulus : float
        Contact modulus E* of the topmost material [Pa].
    window : (pixel size, edges)
        Size (dy, dx) of a pixel [m], and which edges repeat.
    """
    pixel_size, periodic = window
    found = list(_extremes(space, heights, pressure, pixel_size, periodic))
    flattest, steepest = min(one.flattest for one in found), max(one.steepest for one in found)
    peak = float(space.xp.max(pressure))
    slope = flattest if flattest < FLATTEST and flattest > 0.0 else steepest
    numbers = [
        slope_number(slope or None, max(pixel_size)),
        peak_number(peak, modulus, any_low=peak <= 0.0 or slope <= 0.0),
    ]
    if periodic:
        numbers.append(jump_number(max(one.jump for one in found)))
    return tuple(numbers)


def _extremes(
    space: Space, heights: Any, pressure: Any, pixel_size: tuple[float, float], periodic: Edges
) -> Iterator[_Extremes]:
    """Extremes of some maps at a time."""
    xp = space.xp
    n, ny, nx = heights.shape
    together = max(1, _PIXELS // (ny * nx))
    for i in range(0, n, together):
        end = min(i + together, n)
        h, p = heights[i:end, ...], pressure[i:end, ...]
        # Where an edge does not repeat what is in contact counts alone, as by `press`.
        touching = None if periodic is True else xp.astype(p > 0.0, space.dtype)
        squares, jump = 0.0, 0.0
        for axis, size, along in ((-2, pixel_size[0], "y"), (-1, pixel_size[1], "x")):
            first, last, upper, lower = _lines(h, axis)
            step = (upper - lower) ** 2
            line = xp.mean(step, axis=-1 if axis == -2 else -2)  # of each step from line to line
            square = xp.mean(line, axis=-1)
            if touching is not None:
                some = _lines(touching, axis)[3]
                total = xp.maximum(xp.sum(some, axis=(-2, -1)), 1.0)
                square = xp.sum(step * some, axis=(-2, -1)) / total
            squares = squares + square / size**2
            if periodic is True or periodic == along:
                inside = xp.max(line, axis=-1)
                across = xp.mean((first - last) ** 2, axis=-1)
                ratio = xp.where(inside > 0.0, across / xp.where(inside > 0.0, inside, 1.0), 0.0)
                jump = max(jump, math.sqrt(float(xp.max(ratio))))
        slope = xp.sqrt(squares)
        yield _Extremes(float(xp.min(slope)), float(xp.max(slope)), jump)


def _lines(maps: Any, axis: int) -> tuple[Any, Any, Any, Any]:
    """First and last line along an axis, and all but the first and all but the last."""
    if axis == -2:
        return maps[:, 0, :], maps[:, -1, :], maps[:, 1:, :], maps[:, :-1, :]
    return maps[:, :, 0], maps[:, :, -1], maps[:, :, 1:], maps[:, :, :-1]
