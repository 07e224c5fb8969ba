"""Figures of stress below a contact: sections to scale, with the maximum marked."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from ..analyses.subsurface import LABELS, MEASURES, MeasureName
from ..contact.effects.stress import StressPart, SubsurfaceStress
from ..contact.result import ContactResult
from ..errors import DescriptionError
from .axis_units import axis_unit
from .style import Axes, figure, legend, mpl

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ..scene.materials import Stack

    Map = NDArray[np.float64]

__all__ = ["Scale", "below", "depth_shown", "draw_section", "stress_section"]

# Of the maximum: a figure reaches as deep as the stress is larger. Below a
# sphere a tenth lies at four contact radii, a hundredth at thirteen: the contact would be a dot.
_FAINT = 0.1
_MARK = "#d55e00"
_EQUAL = 1.005  # of the largest stress drawn: what exceeds it by less reads the same
_NAMED = 0.07  # of the depth shown: a thinner layer has no room for a line of text


class Scale(NamedTuple):
    """Length [m] and stress [Pa] to draw in units of, and their names on the axes."""

    length: float
    stress: float
    length_name: str
    stress_name: str


def below(
    result: ContactResult,
    measure: MeasureName = "von_mises",
    ax: Axes | None = None,
    *,
    depth: float | None = None,
) -> Axes:
    """Draw contours of the stress in a section, to scale, with the maximum of it marked.

    The section goes through the maximum of the measure if the planes were kept, otherwise through
    the maximum pressure; then a larger stress elsewhere is named beside it.
    Stress jumps at interfaces (dashed); each layer is drawn on its own. Down to less than a few
    pixels the depth is stretched.

    Parameters
    ----------
    result : ContactResult
        With `SubsurfaceStress`.
    measure : str
        What to draw: ``von_mises``, ``sqrt_j2``, ``tension``, ``tresca`` or ``sigma_xz``.
    ax : Axes, optional
        Where to draw.
    depth : float, optional
        Depth shown [m]; as deep as the stress is a tenth of its maximum if not given.

    Raises
    ------
    NotSimulatedError
        If the scene does not list `SubsurfaceStress`.
    DescriptionError
        If there is no such measure, or nothing lies above the depth.
    """
    part = result.of(SubsurfaceStress)
    if measure not in MEASURES:
        raise DescriptionError("stress.measure", measure, f"be one of {', '.join(MEASURES)}")
    values, x, through = _section(result, part, measure)
    shown = depth_shown(result, measure) if depth is None else depth
    if not part.depth[0] < shown:
        expected = f"lie below the first plane, at {part.depth[0]:g} m"
        raise DescriptionError("stress.depth", shown, expected, unit="m")
    pixel = result.plan.grid.pixel_size[1]
    inside = np.abs(x) <= max(1.6 * shown, 4.5 * pixel)
    length, length_name = axis_unit(shown, "m")
    stress, stress_name = axis_unit(float(values.max()), "Pa")
    planes, picked = part.depth / length, values[:, inside] / stress
    ax = draw_section(x[inside] / length, planes, part.layer, picked, ax, _levels(picked))
    ax.set_ylim(shown / length, 0.0)
    if shown < 4.5 * pixel:  # a few pixels: stretched, as nothing of it could be seen to scale
        ax.set_aspect("auto")
    ax.set_xlabel(f"x from the {through} [{length_name}]")
    ax.set_ylabel(f"depth [{length_name}]")
    _name_maximum(ax, part, measure, float(values.max()))
    _name_layers(ax, result.plan.scene.interface.lower.elastic_stack, shown / length, length)
    bar = ax.figure.colorbar(ax.collections[0], ax=ax, location="bottom", aspect=35, shrink=0.8)
    bar.set_label(f"{LABELS[measure]} [{stress_name}]")
    return ax


def _section(result: ContactResult, part: StressPart, measure: MeasureName) -> tuple[Map, Map, str]:
    """A measure on a section through a maximum, places along it [m], and what has the maximum.

    A window that repeats is rolled, with the maximum in its middle.
    """
    (_, nx), (_, dx) = result.plan.grid.shape, result.plan.grid.pixel_size
    if part.planes is None:
        values = np.asarray(MEASURES[measure](part.section))
        centre, through = int(np.argmax(result.pressure[part.row])), "maximum pressure"
    else:
        planes = np.asarray(MEASURES[measure](part.planes))
        _, row, centre = (int(i) for i in np.unravel_index(int(planes.argmax()), planes.shape))
        values, through = planes[:, row], "maximum stress"
    if result.plan.grid.periodic:
        values, centre = np.roll(values, nx // 2 - centre, axis=-1), nx // 2
    return values, np.asarray((np.arange(nx) - centre) * dx, dtype=np.float64), through


def _name_maximum(ax: Axes, part: StressPart, measure: MeasureName, largest: float) -> None:
    """Say in the panel how large the marked stress is, and whether it is larger elsewhere."""
    size, unit = axis_unit(largest, "Pa")
    whole, where = part.maxima[measure], "window"
    elsewhere = []
    if whole.value > _EQUAL * largest:
        depth, name = axis_unit(whole.z, "m")
        place = f"{whole.z / depth:.3g} {name} deep" if whole.z > 0.0 else "at the surface"
        where, elsewhere = "section", [f"in the window {whole.value / size:.3g} {unit}, {place}"]
    text = "\n".join([f"maximum of the {where}: {largest / size:.3g} {unit}", *elsewhere])
    (mark,) = ax.plot([], [], "o", ms=6, mfc="none", mec=_MARK, mew=1.6, label=text)
    legend(
        ax,
        handles=[mark],
        fontsize=8,
        loc="lower right",
        labelcolor="w",
        frameon=True,
        facecolor="#00204d",
        framealpha=0.7,
        edgecolor="none",
    )


def depth_shown(result: ContactResult, measure: MeasureName = "von_mises") -> float:
    """Depth [m] down to which `below` draws: where the stress is a tenth of its maximum."""
    part = result.of(SubsurfaceStress)
    largest = _section(result, part, measure)[0].max(axis=1)
    last = int(np.flatnonzero(largest > _FAINT * largest.max())[-1])
    return float(part.depth[min(last + 1, len(part.depth) - 1)])


def _levels(values: Map) -> list[float]:
    """Round levels of contours from zero to the maximum."""
    ticks = mpl.ticker.MaxNLocator(10, steps=[1, 2, 2.5, 5, 10]).tick_values(0.0, values.max())
    return [float(one) for one in ticks]


def _name_layers(ax: Axes, stack: Stack, shown: float, length: float) -> None:
    """Write the names of the layers that are thick enough in a figure to bear them."""
    faces = [0.0, *(z / length for z in stack.depths), shown]
    for material, top, bottom in zip(stack.materials, faces, faces[1:], strict=False):
        bottom = min(bottom, shown)
        if bottom - top > _NAMED * shown and material.name:
            above = max(0.5 * (top + bottom), bottom - 0.2 * shown)  # the legend lies below
            middle = 0.5 * (top + bottom) if bottom < shown else above
            at = (0.02, middle)
            ax.text(*at, material.name, transform=ax.get_yaxis_transform(), color="w", fontsize=8)


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
    if isinstance(levels, int):
        steps = np.linspace(0.0, float(values.max()), levels + 1)
    else:
        steps = np.asarray(levels, dtype=float)
    for number in sorted(set(layer.tolist())):
        rows = np.flatnonzero(layer == number)
        if len(rows) < 2:
            continue
        at = (x, z[rows], values[rows])
        over = "max" if values.max() > steps[-1] else "neither"
        ax.contourf(*at, levels=steps, cmap="cividis", extend=over)
        lines = ax.contour(*at, levels=steps, colors="w", linewidths=0.5)
        if labelled:
            ax.clabel(lines, fontsize=7)
        if rows[0] > 0:
            ax.axhline(z[rows[0]], color="k", lw=0.9, ls="--")
    row, column = np.unravel_index(int(np.argmax(values)), values.shape)
    ax.plot(x[column], z[row], "o", ms=6, mfc="none", mec=_MARK, mew=1.6, clip_on=False, zorder=5)
    ax.set(aspect="equal", ylim=(float(z.max()), float(z.min())))
    ax.grid(visible=False)
    return ax
