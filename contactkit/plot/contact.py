"""Figures of contacts, on given axes."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..contact.effects.film import FilmMeniscus
from ..contact.effects.plasticity import HardnessLimit
from ..contact.result import ContactResult
from ..errors import DescriptionError
from ..scene.materials import Stack
from .axis_units import axis_unit
from .maps import extent, hide_holes, place
from .style import Axes, ListedColormap, Patch, Rectangle, figure, legend

__all__ = [
    "contact_spots",
    "pressure",
    "pressure_close_up",
    "section",
    "stack_section",
]

SPOTS = {"open": "#f4f4f2", "meniscus": "#8ecae6", "elastic": "#1f4e79", "plastic": "#c1440e"}
"""Colours of the states of a pixel."""

_LAYER_COLOURS = ("#264653", "#2a9d8f", "#8ab17d", "#e9c46a", "#f4a261", "#e76f51")


def pressure(result: ContactResult, ax: Axes | None = None) -> Axes:
    """Draw the pressure map; white where there is neither contact nor attraction, holes grey."""
    ax = ax if ax is not None else figure()[1]
    around, unit = extent(result)
    factor, name = axis_unit(float(np.abs(result.pressure).max()), "Pa")
    acting = result.contact | (result.pressure != 0.0)
    shown = np.ma.masked_where(~acting, result.pressure / factor)
    image = ax.imshow(shown, origin="lower", extent=around, cmap="viridis", interpolation="nearest")
    hide_holes(ax, result)
    place(ax, unit)
    bar = ax.figure.colorbar(image, ax=ax, shrink=0.85)
    bar.set_label(f"pressure [{name}]")
    return ax


def pressure_close_up(result: ContactResult, ax: Axes | None = None) -> Axes:
    """Draw the pressure in a part of the window around its maximum, where spots can be seen.

    A quarter of each side, 9 pixels at least. A window that repeats is rolled.
    """
    ax = ax if ax is not None else figure()[1]
    acting = result.contact | (result.pressure != 0.0)
    values = np.where(acting, result.pressure, np.nan)
    ends: list[float] = []
    peak = np.unravel_index(int(np.argmax(result.pressure)), values.shape)
    for axis, (n, pixel) in enumerate(zip(values.shape, result.plan.grid.pixel_size, strict=True)):
        half, centre = min(max(n // 8, 4), (n - 1) // 2), int(peak[axis])
        if result.plan.grid.periodic:
            values, centre = np.roll(values, n // 2 - centre, axis=axis), n // 2
        first, last = max(centre - half, 0), min(centre + half + 1, n)
        values = values[first:last] if axis == 0 else values[:, first:last]
        ends = [(first - centre - 0.5) * pixel, (last - centre - 0.5) * pixel, *ends]
    length, unit = axis_unit(max(ends[1] - ends[0], ends[3] - ends[2]), "m")
    factor, name = axis_unit(float(np.abs(result.pressure).max()), "Pa")
    image = ax.imshow(
        np.ma.masked_invalid(values / factor),
        origin="lower",
        extent=(ends[0] / length, ends[1] / length, ends[2] / length, ends[3] / length),
        cmap="viridis",
        interpolation="nearest",
    )
    place(ax, unit)
    ax.set_xlabel(f"x from the maximum pressure [{unit}]")
    ax.figure.colorbar(image, ax=ax, shrink=0.85).set_label(f"pressure [{name}]")
    return ax


def contact_spots(result: ContactResult, ax: Axes | None = None) -> Axes:
    """Draw the contact, plastic and wetted areas; holes grey."""
    ax = ax if ax is not None else figure()[1]
    around, unit = extent(result)
    kinds = np.zeros(result.pressure.shape, dtype=int)
    if result.plan.has(FilmMeniscus):
        wet = result.of(FilmMeniscus).is_meniscus
        kinds[wet] = 1
    kinds[result.contact] = 2
    if result.plan.has(HardnessLimit):
        kinds[result.of(HardnessLimit).is_plastic] = 3
    ax.imshow(
        kinds,
        origin="lower",
        extent=around,
        interpolation="nearest",
        vmin=0,
        vmax=3,
        cmap=ListedColormap(list(SPOTS.values())),
    )
    hide_holes(ax, result)
    place(ax, unit)
    if 0 < (kinds == 3).sum() < 2e-3 * kinds.size:  # too few to be seen as pixels
        found = np.argwhere(kinds == 3)
        rows, columns = found[:, 0], found[:, 1]
        ny, nx = result.plan.grid.shape
        x, y = (columns + 0.5) * around[1] / nx, (rows + 0.5) * around[3] / ny
        ax.plot(x, y, "o", ms=4, mfc="none", mec=SPOTS["plastic"], mew=1.0)
    n = kinds.size
    names = {1: "meniscus", 2: "elastic", 3: "plastic"}
    shown = [k for k in names if k == 2 or (kinds == k).any()]
    handles = [
        Patch(
            color=SPOTS[names[k]],
            label=f"{names[k]} {100.0 * float((kinds == k).sum()) / n:.2g} % of the window",
        )
        for k in shown
    ]
    legend(ax, handles=handles, loc="upper center", bbox_to_anchor=(0.5, -0.14), ncols=1)
    return ax


def section(
    result: ContactResult, ax: Axes | None = None, *, row: int | None = None, deformed: bool = True
) -> Axes:
    """Draw a section through the interface along x, heights stretched, contact thick.

    The upper surface is drawn flat: below it lies the gap, deformed by the pressure and, dotted,
    without it.

    Parameters
    ----------
    result : ContactResult
        The contact.
    ax : Axes, optional
        Where to draw.
    row : int, optional
        Row of pixels; that of the maximum pressure if not given.
    deformed : bool
        Whether to draw the deformed surface too.

    Raises
    ------
    DescriptionError
        If there is no such row.
    """
    ny, nx = result.pressure.shape
    if row is None:
        row = int(np.unravel_index(int(np.argmax(result.pressure)), (ny, nx))[0])
    if not -ny <= row < ny:
        raise DescriptionError("section.row", row, f"be a row of the map, 0 to {ny - 1}")
    ax = ax if ax is not None else figure()[1]
    (_, right, _, _), unit = extent(result)
    x = (np.arange(nx) + 0.5) * right / nx
    undeformed, gap = result.heights[row] + result.rigid_approach, -result.gap[row]
    if result.holes is not None:
        undeformed, gap = (np.where(result.holes[row], np.nan, one) for one in (undeformed, gap))
    factor, name = axis_unit(float(np.nanmax(np.abs(np.stack([undeformed, gap])))), "m")
    ax.axhline(0.0, color="0.5", lw=1.0, label="upper surface, drawn flat")
    ax.plot(x, undeformed / factor, ":", color=SPOTS["plastic"], label="lower, undeformed")
    if deformed:
        ax.plot(x, gap / factor, color=SPOTS["elastic"], label="lower, deformed")
        touching = np.where(result.contact[row], 0.0, np.nan)
        ax.plot(x, touching, color=SPOTS["elastic"], lw=4.0, label="contact")
    ax.set(xlabel=f"x [{unit}]", ylabel=f"height [{name}]")
    legend(ax, loc="upper center", bbox_to_anchor=(0.5, -0.14), ncols=2)
    return ax


def stack_section(stack: Stack, ax: Axes | None = None, title: str = "") -> Axes:
    """Draw a stack as a cross-section, not to scale; thicknesses are labelled."""
    ax = ax if ax is not None else figure()[1]
    rows = len(stack.materials)
    for i, material in enumerate(stack.materials):
        colour = _LAYER_COLOURS[i % len(_LAYER_COLOURS)]
        ax.add_patch(_block(i, colour))
        if i < len(stack.thicknesses):
            factor, unit = axis_unit(stack.thicknesses[i], "m")
            thickness = f"{stack.thicknesses[i] / factor:.3g} {unit}"
        else:
            thickness = "half-space"
        hardness = f", H {material.hardness / 1e9:.3g} GPa" if material.hardness else ""
        light = i % len(_LAYER_COLOURS) < 2
        ax.text(
            0.5,
            i + 0.5,
            f"{material.name}, {thickness}\n{material.elastic_label}{hardness}",
            ha="center",
            va="center",
            color="w" if light else "k",
            fontsize=9,
        )
    ax.set(xlim=(0.0, 1.0), ylim=(float(rows), 0.0), xticks=[], yticks=[])
    if stack.base:
        ax.set_xlabel(f"rigid base, {stack.base}")
    ax.grid(visible=False)
    for spine in ax.spines.values():
        spine.set_visible(False)
    ax.set_title(title, loc="left", fontsize=11)
    return ax


def _block(row: int, colour: str) -> Any:
    return Rectangle((0.0, float(row)), 1.0, 1.0, facecolor=colour, edgecolor="w", lw=1.5)
