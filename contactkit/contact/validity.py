"""Ranges of validity of a solved contact: resolution, small slopes, small strains."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from ..validity import ValidityNumber
from .effects.base import ContactEffect, SolvedContact, effects_of
from .effects.elasticity import contact_modulus
from .pixel_edges import pixel_edges
from .plausible import FLATTEST, LIGHTEST_PEAK, check_sizes, is_even

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ..scene.window import Edges

    Map = NDArray[np.float64]

__all__ = ["PIXELS_PER_SPOT", "check_contact", "jump_number", "peak_number", "slope_number"]

PIXELS_PER_SPOT = "pixels across a contact spot"
"""Name of the number that says how well the spots are resolved."""

# Maximum pressure and area are within 6 % from 8 on, and up to 18 % off at 4: the table of
# docs/accuracy.md, "Pixels per wave".
_FEWEST_PER_WAVE = 8.0
# Pressed balls, at five places between the pixels: at 4 the maximum pressure is up to 4 % off and
# the pixel count of the area 27 %; at 2 they are 48 and 91 %, at 8 they are 1.5 and 13 %.
_FEWEST_PER_SPOT = 4.0
# A ball is then pressed to a contact radius of 0.31 R, where a parabola is 2.5 % lower than it.
_HIGHEST_PRESSURE = 0.2
_STEEPEST = 0.3  # the surface is then 4.4 % longer than its projection, on which it is solved
# Of 200 maps that repeat the largest has 1.05; of 200 patches that were cut from larger maps the
# smallest has 4.2.
_HIGHEST_JUMP = 2.0
_FEW = 4  # pixels in contact
_LINES = 64  # of a map: 8 to 64 cost the same; all at once take three times as long, and its memory


def check_contact(
    contact: SolvedContact, heights: Map, parts: Mapping[type[ContactEffect[Any]], object]
) -> tuple[ValidityNumber, ...]:
    """Evaluate the numbers of a solved contact: its own, then those of its effects.

    Parameters
    ----------
    contact : SolvedContact
        The solved contact.
    heights : ndarray (ny, nx)
        Heights of both bodies together [m].
    parts : mapping of effect class to its part
        What the effects computed.
    """
    is_periodic = contact.grid.periodic
    # Of a window that is not periodic the rectangle around the contact matters alone.
    steps = _steps(heights if is_periodic else heights[_around(contact.touching)])
    even = is_even(heights)
    found = [
        _pixels_per_wave(contact),
        _pixels_per_spot(contact),
        _peak_pressure(contact, even),
        _slope(contact, steps, even),
        *check_sizes(contact, even=even),
    ]
    if contact.grid.edges:
        found.append(_jump(heights, contact.grid.edges))
    if (
        not is_periodic
        and sum(b.surface.body_curvature for b in contact.scene.interface.bodies) > 0
    ):
        found.append(_cut_off(contact))
    effects = effects_of(contact.scene)
    own = [one for e in effects for one in e.validity(contact, parts.get(type(e)))]
    return (*found, *own)


def _pixels_per_wave(contact: SolvedContact) -> ValidityNumber:
    bodies = contact.scene.interface.bodies
    waves = [wave for body in bodies for wave in body.surface.shortest_waves(contact.grid)]
    shortest = min(waves, key=lambda wave: wave.length / wave.pixel, default=None)
    return ValidityNumber(
        name="pixels per shortest wave",
        value=None if shortest is None else shortest.length / shortest.pixel,
        low=_FEWEST_PER_WAVE,
        detail="no surface states its shortest wave; see the pixels across a contact spot"
        if shortest is None
        else f"below, the maximum pressure is up to a quarter off (at 3 pixels) and stress more; "
        f"use a finer Accuracy.grid, or a longer {shortest.field}",
        source="measured: documentation, Accuracy",
    )


def _pixels_per_spot(contact: SolvedContact) -> ValidityNumber:
    """Diameter of discs with the same ratio of area to length of edge, or width, in pixels."""
    touching = contact.touching
    area, edges = int(touching.sum()), pixel_edges(touching, contact.grid.edges)
    diameter = _width(touching, contact.grid.edges) or (
        16.0 / math.pi * area / edges.total if edges.total else math.inf
    )
    return ValidityNumber(
        name=PIXELS_PER_SPOT,
        value=diameter if area else None,
        low=_FEWEST_PER_SPOT,
        detail="below, area and maximum pressure of the spots are those of the grid: more than a "
        f"tenth off{_light(area)}; use a finer Accuracy.grid, or a smaller window"
        if area
        else "there is no contact",
        source="16/pi x area/edges; measured: documentation, Accuracy",
    )


def _light(n_touching: int) -> str:
    """Remark on a contact of so few pixels that a mistaken load may be the reason."""
    if n_touching > _FEW:
        return ""
    carried = "one pixel carries" if n_touching == 1 else f"{n_touching} pixels carry"
    return f"; {carried} the load, is its unit right (1 MPa is 1e6 Pa)?"


def _width(touching: NDArray[np.bool_], edges: Edges) -> float | None:
    """Mean width [pixels] of a contact strip across the periodic axis, as of a nip.

    None where nothing does, or along both axes: spots that end inside the window are about as wide
    as they are long, and so are the holes of what leaves nothing but holes.
    """
    widths = [
        width
        for axis in ("x", "y")
        if edges in (True, axis) and (width := _through(touching, axis, edges)) is not None
    ]
    return widths[0] if len(widths) == 1 else None


def _through(touching: NDArray[np.bool_], axis: str, edges: Edges) -> float | None:
    """Mean width [pixels] of a contact strip along an axis of the window; None without one."""
    lines = touching.T if axis == "x" else touching  # along the axis, from first to last
    if not lines.any(axis=1).all():
        return None
    from scipy import ndimage

    names, _ = ndimage.label(lines)
    through = np.unique(names[0][(names[0] == names[-1]) & (names[0] > 0)])
    if not through.size:
        return None
    strip = np.isin(names, through)
    crossed = pixel_edges(strip, True if edges is True else "y").along_x
    return 2.0 * int(strip.sum()) / crossed if crossed else None


def _peak_pressure(contact: SolvedContact, even: bool) -> ValidityNumber:
    peak = float(contact.pressure.max())
    # Under attraction, or between even faces, the lightest pressures are possible.
    any_low = even or peak <= 0.0 or contact.attracted is not None
    return peak_number(peak, contact_modulus(contact.scene), any_low=any_low)


def peak_number(peak: float, modulus: float, *, any_low: bool) -> ValidityNumber:
    """Peak pressure [Pa] over the contact modulus E* [Pa]; `any_low`: it has no lower end."""
    is_low = not any_low and peak < LIGHTEST_PEAK * modulus
    return ValidityNumber(
        name="peak pressure over E*",
        value=peak / modulus,
        low=-math.inf if any_low else LIGHTEST_PEAK,
        high=_HIGHEST_PRESSURE,
        detail=f"{peak:.3g} Pa on E* = {modulus:.3g} Pa hardly deforms a ball or a rough surface; "
        "check the units of load, modulus, heights and pixel size: 1 MPa is 1e6 Pa"
        if is_low
        else f"linear elasticity takes strains to be small; E* = {modulus:.3g} Pa; check the "
        "units of heights and load, lower the load, or list HardnessLimit",
        source="Johnson 1985, sections 4.1 and 6.1",
    )


class _Steps(NamedTuple):
    """Rms step [m] of the heights from each line to the next, over the lines along y and x."""

    along_y: Map
    along_x: Map


def _steps(heights: Map) -> _Steps:
    ny, nx = heights.shape
    along_x, along_y = np.zeros(nx - 1), [np.zeros(0)]
    for i in range(0, ny, _LINES):  # some at a time: differences take as much room as heights
        some = heights[i : i + _LINES + 1]
        down, across = np.diff(some, axis=0), np.diff(some[:_LINES], axis=1)
        along_y.append(np.einsum("ij,ij->i", down, down))
        along_x += np.einsum("ij,ij->j", across, across)
    return _Steps(np.sqrt(np.concatenate(along_y) / nx), np.sqrt(along_x / ny))


def _slope(contact: SolvedContact, steps: _Steps, even: bool) -> ValidityNumber:
    pairs = zip(steps, contact.grid.pixel_size, strict=True)
    slope = math.hypot(*(math.sqrt(float(np.square(s).mean())) / size for s, size in pairs))
    return slope_number(None if even else slope, max(contact.grid.pixel_size))


def slope_number(slope: float | None, pixel: float) -> ValidityNumber:
    """Rms slope [-] of the heights, on pixels of a size [m]; None of flat surfaces."""
    return ValidityNumber(
        name="rms slope",
        value=slope,
        low=FLATTEST,
        high=_STEEPEST,
        detail="the surfaces are flat"
        if slope is None
        else f"flatter than an optical flat, on pixels of {pixel:.3g} m; check the units of "
        "heights and pixel size: 1 um is 1e-6 m"
        if slope < FLATTEST
        else "a half-space takes slopes to be small; check the units of heights and pixel size",
        source="Johnson 1985, section 4.1",
    )


def _around(touching: NDArray[np.bool_]) -> tuple[slice, slice]:
    """Rectangle of the contact with the pixels next to it; everything if nothing touches."""
    if not touching.any():
        return slice(None), slice(None)
    ranges = []
    for axis in (1, 0):
        lines = np.flatnonzero(touching.any(axis=axis))
        ranges.append(slice(max(int(lines[0]) - 1, 0), int(lines[-1]) + 2))
    return ranges[0], ranges[1]


def _cut_off(contact: SolvedContact) -> ValidityNumber:
    """Load on the lines at the edges that do not repeat, of a round body, which has no edge."""
    edges, pressure = contact.grid.edges, contact.pressure
    ends = np.zeros(contact.grid.shape, dtype=bool)
    if edges != "y":
        ends[[0, -1], :] = True
    if edges != "x":
        ends[:, [0, -1]] = True
    load = float(np.abs(pressure).sum())
    touching = ends & contact.touching  # attraction reaches farther, and has a number of its own
    return ValidityNumber(
        name="load at the edge of the window over the load",
        value=float(np.abs(pressure[touching]).sum()) / load if load else None,
        high=0.0,
        detail="the contact of the round body reaches the edge of the window, where the body ends; "
        "use a wider window"
        if load
        else "there is no load",
    )


def _jump(heights: Map, edges: Edges) -> ValidityNumber:
    """Step from the last line to the first over the largest step inside, rms along the line.

    Across the edges that repeat.
    """
    worst = 0.0
    for axis, each in enumerate(_steps(heights)):
        if edges == "yx"[1 - axis]:  # lines along the axis that repeats end at free edges
            continue
        inside = float(each.max())
        wrapped = heights.take(0, axis) - heights.take(-1, axis)
        step = math.sqrt(float(np.square(wrapped).mean()))
        worst = max(worst, step / inside if inside > 0.0 else (math.inf if step else 0.0))
    return jump_number(worst)


def jump_number(worst: float) -> ValidityNumber:
    """Rms step across an edge that repeats over the largest inside [-]."""
    return ValidityNumber(
        name="jump at the edge of the periodic window",
        value=worst,
        high=_HIGHEST_JUMP,
        detail="rms step of the heights across the edge over the largest inside: the edges do not "
        "fit together and make a ridge; use Window(periodic=False), or a map that repeats",
    )
