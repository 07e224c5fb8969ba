"""Figures of stress below a contact: sections to scale, with the maximum marked."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from ..analyses.subsurface import MEASURES, MeasureName
from ..contact.effects.stress import StressPart
from .separation import Axes, figure

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Map = NDArray[np.float64]

__all__ = ["Scale", "draw_section", "stress_section"]


class Scale(NamedTuple):
    """Length [m] and stress [Pa] to draw in units of, and their names on the axes."""

    length: float
    stress: float
    length_name: str
    stress_name: str


def stress_section(
    part: StressPart,
    pixel: float,
    scale: Scale,
    measure: MeasureName = "von_mises",
    ax: Axes | None = None,
    **more: Any,
) -> Axes:
    """Draw contours of a measure in the plane x-z under the row of maximum pressure, to scale.

    Parameters
    ----------
    part : StressPart
        Stress with its section.
    pixel : float
        Pixel along x [m].
    scale : Scale
        Units to draw in.
    measure : str
        Name of a measure of `analyses.subsurface.MEASURES`.
    ax : Axes, optional
        Where to draw.
    **more
        See `draw_section`.
    """
    values = MEASURES[measure](part.section) / scale.stress
    x = (np.arange(values.shape[1]) - 0.5 * (values.shape[1] - 1)) * pixel / scale.length
    ax = draw_section(x, part.depth / scale.length, part.layer, values, ax, **more)
    ax.set(xlabel=f"x {scale.length_name}", ylabel=f"z {scale.length_name}")
    return ax


def draw_section(
    x: Map,
    z: Map,
    layer: NDArray[np.int_],
    values: Map,
    ax: Axes | None = None,
    levels: int | Sequence[float] = 12,
    labelled: bool = False,
) -> Axes:
    """Draw contours of values (n, nx) on planes, each layer on its own, and mark the maximum.

    Parameters
    ----------
    x, z : ndarray (nx,), (n,)
        Places along the section and depths, in the units of the axes.
    layer : ndarray of int (n,)
        Layer of each plane: stress jumps between two of them.
    values : ndarray (n, nx)
        What to draw.
    ax : Axes, optional
        Where to draw.
    levels : int or sequence of float
        Levels of the contours.
    labelled : bool
        Whether lines carry their values.
    """
    ax = ax if ax is not None else figure()[1]
    steps = levels
    if isinstance(levels, int):
        steps = np.linspace(0.0, float(values.max()), levels + 1).tolist()
    for number in sorted(set(layer.tolist())):
        rows = np.flatnonzero(layer == number)
        if len(rows) < 2:
            continue
        at = (x, z[rows], values[rows])
        ax.contourf(*at, levels=steps, cmap="cividis", extend="max")
        lines = ax.contour(*at, levels=steps, colors="w", linewidths=0.5)
        if labelled:
            ax.clabel(lines, fontsize=7)
        if rows[0] > 0:
            ax.axhline(z[rows[0]], color="k", lw=0.9, ls="--")
    row, column = np.unravel_index(int(np.argmax(values)), values.shape)
    ax.plot(x[column], z[row], "o", ms=6, mfc="none", mec="#d55e00", mew=1.6, clip_on=False)
    ax.set(aspect="equal", ylim=(float(z.max()), float(z.min())))
    ax.grid(visible=False)
    return ax
