"""Figures of a separation of deforming bodies: loop, gaps, sections, energies, maps, animation."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from ..errors import DescriptionError
from ..scene.loading import PressAndPull
from ..separation.deforming.limits import rigid_limit, static_limit
from ..separation.deforming.result import MAPS, DeformingResult, Maps
from .axis_units import axis_label, readable
from .style import Axes, ListedColormap, Patch, figure, legend, save_animation

__all__ = [
    "animate",
    "draw_regions",
    "energies",
    "field",
    "gaps",
    "loop",
    "regions",
    "regions_of",
    "sections",
    "telling_time",
]

_INSTANTS = 5  # of a section
_TALLEST = 1.6  # axis of forces over the largest pull
_FULL = 0.9999  # part of the gap below which a cell is void
_REGIONS = ("film", "contact", "void")
_COLOURS = ("#a9cce3", "#1b2631", "#e59866")


def loop(result: DeformingResult, ax: Axes | None = None) -> Axes:
    """Draw pull, film and contact force over the gap of the undeformed bodies, the loop filled.

    With the limits between which they lie: rigid bodies at the same speed, and bodies at rest.
    """
    ax = ax if ax is not None else figure()[1]
    columns = result.plan.columns
    named = [columns[name] for name in ("pull", "film_force", "contact_force")]
    drawn = [one for one in named if one.name == "pull" or result["contact_force"].any()]
    meniscus = columns["meniscus_force"]
    if result[meniscus.name].any():
        drawn.append(meniscus)
    largest = [float(np.abs(result[one.name]).max()) for one in drawn]
    force, force_name = readable("N", largest)
    length, length_name = readable("m", np.abs(result["gap"]))
    x, pull = result["gap"] / length, result["pull"] / force
    # From the end straight down and back: the parts above and below zero are the work of either.
    loop = np.append(x, [x[-1], x[0]]), np.append(pull, [0.0, 0.0])
    ax.fill(*loop, color="0.92", zorder=0.0)
    for one in drawn:
        ax.plot(x, result[one.name] / force, one.style, color=one.color, label=one.label)
    ends = float(result["gap"].min()), float(result["gap"].max())
    found = {"rigid bodies": rigid_limit(result.plan, *ends), "at rest": None}
    if result["contact_force"].any() or result["meniscus_force"].any():
        found["at rest"] = static_limit(result.plan, *ends)
    low, high = (float(find(values)) for find in (np.min, np.max) for values in [loop[1]])
    for style, (label, limit) in zip(("--", ":"), found.items(), strict=True):
        if limit is not None:
            y = limit.force / force
            ax.plot(limit.gap / length, y, style, color="0.35", lw=1.0, label=label)
            low, high = min(low, float(y.min())), max(high, float(y.max()))
    # Rigid bodies may resist by a hundred times as much: what is simulated is to be seen.
    tallest = _TALLEST * float(np.abs(pull).max())
    room = 0.05 * (min(high, tallest) - max(low, -tallest))
    ax.set_ylim(max(low, -tallest) - room, min(high, tallest) + room)
    ax.axhline(0.0, color="0.7", lw=0.8)
    ax.set_xlabel(axis_label(columns["gap"].label, length_name))
    ax.set_ylabel(axis_label("force", force_name))
    legend(ax)
    return ax


def gaps(result: DeformingResult, ax: Axes | None = None) -> Axes:
    """Draw the gaps on the axis and of the undeformed bodies, and the smallest, over time."""
    ax = ax if ax is not None else figure()[1]
    columns = result.plan.columns
    drawn = [columns[name] for name in ("centre_gap", "smallest_gap", "gap")]
    length, length_name = readable("m", [float(result["centre_gap"].max())])
    time, time_name = readable("s", result["time"])
    for one in drawn:
        x, y = result["time"] / time, result[one.name] / length
        ax.plot(x, y, one.style, color=one.color, label=one.label)
    ax.set_xlabel(axis_label("time", time_name))
    ax.set_ylabel(axis_label("gap", length_name))
    legend(ax)
    return ax


def sections(result: DeformingResult, ax: Axes | None = None) -> Axes:
    """Draw the gap over the radius at five instants, from the start to where the bodies part.

    Of a map over x, through the axis.
    """
    ax = ax if ax is not None else figure()[1]
    time, loading = result["time"], result.plan.scene.loading
    end = result.numbers["snap_off_time"]
    end = end if np.isfinite(end) else result.numbers["pull_off_time"]
    # Of a rest start and end, and then the pull.
    begun = loading.rest if isinstance(loading, PressAndPull) else float(time[0])
    instants = sorted({float(time[0]), *np.linspace(begun, end, _INSTANTS - (begun > time[0]))})
    found = [result.section(t) for t in instants]
    reach = 3.0 * max(result.plan.film.width, float(np.sqrt(result["contact_area"].max() / np.pi)))
    shown = [one.gap[np.abs(one.radius) <= reach] for one in found]
    length, length_name = readable("m", [float(max(gap.max() for gap in shown))])
    radius, radius_name = readable("m", [reach])
    second, second_name = readable("s", time)
    for k, (one, gap) in enumerate(zip(found, shown, strict=True)):
        x = one.radius[np.abs(one.radius) <= reach] / radius
        label = f"{one.time / second:.3g} {second_name}"
        ax.plot(x, gap / length, color=str(0.75 * (1.0 - k / (_INSTANTS - 1))), label=label)
    ax.set_xlabel(axis_label("x through the axis" if result.fields else "radius", radius_name))
    ax.set_ylabel(axis_label("gap", length_name))
    ax.set_ylim(bottom=0.0)
    legend(ax)
    return ax


def energies(result: DeformingResult, ax: Axes | None = None) -> Axes:
    """Draw the work of the pull, the energy in the bodies and what the film has dissipated."""
    ax = ax if ax is not None else figure()[1]
    columns = result.plan.columns
    drawn = [columns[name] for name in ("work", "elastic_energy", "dissipated_energy")]
    joule, joule_name = readable("J", [float(np.abs(result[one.name]).max()) for one in drawn])
    time, time_name = readable("s", result["time"])
    for one in drawn:
        x, y = result["time"] / time, result[one.name] / joule
        ax.plot(x, y, one.style, color=one.color, label=one.label)
    ax.set_xlabel(axis_label("time", time_name))
    ax.set_ylabel(axis_label("energy", joule_name))
    legend(ax)
    return ax


def regions(result: DeformingResult, time: float | None = None, ax: Axes | None = None) -> Axes:
    """Draw where the bodies touch, where the film is full and where it is void, at a time.

    Parameters
    ----------
    result : DeformingResult
        Of a map.
    time : float, optional
        [s]; the kept one next to it is drawn. None: of the largest void, or of the largest contact,
        or of the largest pull.
    ax : Axes, optional
        Where to draw.
    """
    ax = ax if ax is not None else figure(size=(5.0, 4.4))[1]
    shown = result.maps(telling_time(result) if time is None else time)
    _draw(ax, shown)
    ax.set_title(_instant(result, shown.time), fontsize=9)
    return ax


def field(
    result: DeformingResult, name: str, time: float | None = None, ax: Axes | None = None
) -> Axes:
    """Draw a map with its colours: "gap", "film_pressure", "solid_pressure" or "liquid".

    Parameters
    ----------
    result : DeformingResult
        Of a map.
    name : str
        What to draw.
    time : float, optional
        As of `regions`.
    ax : Axes, optional
        Where to draw.

    Raises
    ------
    DescriptionError
        If there is no such map.
    """
    if name not in MAPS:
        raise DescriptionError("field.name", name, f"be one of {', '.join(MAPS)}")
    ax = ax if ax is not None else figure(size=(5.0, 4.2))[1]
    shown = result.maps(telling_time(result) if time is None else time)
    values = np.ma.masked_array(getattr(shown, name), ~shown.inside)
    factor, unit = readable(MAPS[name], values.compressed())
    around, length = _extent(shown)
    signed = bool(values.min() < 0.0 < values.max())
    top = float(np.abs(values).max()) / factor
    colours: dict[str, Any] = {"cmap": "viridis"}
    if signed:
        colours = {"cmap": "PuOr_r", "vmin": -top, "vmax": top}
    image = ax.imshow(
        values / factor, origin="lower", extent=around, interpolation="nearest", **colours
    )
    ax.figure.colorbar(image, ax=ax, shrink=0.85).set_label(
        axis_label(name.replace("_", " "), unit)
    )
    ax.set(xlabel=f"x [{length}]", ylabel=f"y [{length}]", aspect="equal")
    ax.set_title(_instant(result, shown.time), fontsize=9)
    ax.grid(visible=False)
    return ax


def animate(result: DeformingResult, path: str | Path, *, rate: int = 8) -> Path:
    """Write an animation as GIF: contact, film and void on the map, and the pull so far.

    Parameters
    ----------
    result : DeformingResult
        Of a map; there is a picture for each of the kept maps.
    path : str or Path
        File to write, ending in .gif.
    rate : int
        Pictures a second.

    Returns
    -------
    Path
        The file.

    Raises
    ------
    DescriptionError
        If the file is no GIF.
    """
    made, (left, right) = figure(1, 2, size=(8.2, 3.9))
    times = [float(time) for time in result.fields["time"]]
    force, force_name = readable("N", result["pull"])
    length, length_name = readable("m", result["gap"])
    gap, pull = result["gap"] / length, result["pull"] / force

    first = result.maps(times[0])
    image = _draw(left, first)
    right.axhline(0.0, color="0.8", lw=0.8)
    right.plot(gap, pull, color="0.85")
    (line,) = right.plot([], [], color="#6a4c93")
    (dot,) = right.plot([], [], "o", color="#6a4c93", ms=4)
    right.set_xlabel(axis_label("gap of the undeformed bodies", length_name))
    right.set_ylabel(axis_label("pull", force_name))

    def draw(index: int) -> list[Any]:
        shown = result.maps(times[index])
        so_far = result["time"] <= shown.time * (1.0 + 1e-9)
        image.set_data(regions_of(shown))
        left.set_title(_instant(result, shown.time), fontsize=9)
        line.set_data(gap[so_far], pull[so_far])
        dot.set_data(gap[so_far][-1:], pull[so_far][-1:])
        return [image, line, dot]

    return save_animation(made, path, draw, len(times), rate, first=[image, line, dot])


def telling_time(result: DeformingResult) -> float:
    """Time of the kept map that shows most: void beside contact, else either, else the pull."""
    void, contact = result["void_volume"], result["contact_area"]
    shown = next(one for one in (void * contact, void, contact, result["pull"] + 1.0) if one.any())
    kept = np.interp(result.fields["time"], result["time"], shown)
    return float(result.fields["time"][int(kept.argmax())])


def regions_of(shown: Maps) -> Any:
    """0 film, 1 contact, 2 void; masked outside."""
    found = np.where(shown.solid_pressure > 0.0, 1, 0)
    found = np.where(shown.liquid < _FULL, 2, found)
    return np.ma.masked_array(found, ~shown.inside)


def draw_regions(ax: Axes, kinds: Any, x: Any, y: Any) -> Any:
    """Draw what `regions_of` gives over the places of its cells, with a legend below.

    The image is returned.

    Parameters
    ----------
    ax : Axes
        Where to draw.
    kinds : ndarray, shape (ny, nx)
        0 film, 1 contact, 2 void; masked where there is nothing.
    x, y : ndarray, shape (nx,), (ny,)
        Places in the unit of the axes.
    """
    dx, dy = 0.5 * (x[1] - x[0]), 0.5 * (y[1] - y[0])
    image = ax.imshow(
        kinds,
        origin="lower",
        extent=(x[0] - dx, x[-1] + dx, y[0] - dy, y[-1] + dy),
        cmap=ListedColormap(_COLOURS),
        vmin=-0.5,
        vmax=2.5,
        interpolation="nearest",
    )
    handles = [Patch(color=c, label=name) for c, name in zip(_COLOURS, _REGIONS, strict=True)]
    ax.legend(handles=handles, loc="upper center", bbox_to_anchor=(0.5, -0.17), ncols=3)
    ax.set_aspect("equal")
    ax.grid(visible=False)
    return image


def _draw(ax: Axes, shown: Maps) -> Any:
    factor, unit = readable("m", [np.ptp(shown.x), np.ptp(shown.y)])
    image = draw_regions(ax, regions_of(shown), shown.x / factor, shown.y / factor)
    ax.set(xlabel=f"x [{unit}]", ylabel=f"y [{unit}]")
    return image


def _extent(shown: Maps) -> tuple[tuple[float, float, float, float], str]:
    """Ends of a map in the unit in which it reads best, and the name of that unit."""
    x, y = shown.x, shown.y
    dx, dy = 0.5 * (x[1] - x[0]), 0.5 * (y[1] - y[0])
    factor, unit = readable("m", [x[-1] - x[0], y[-1] - y[0]])
    ends = x[0] - dx, x[-1] + dx, y[0] - dy, y[-1] + dy
    left, right, low, high = (float(end) / factor for end in ends)
    return (left, right, low, high), unit


def _instant(result: DeformingResult, time: float) -> str:
    second, second_name = readable("s", result["time"])
    gap = float(np.interp(time, result["time"], result["gap"]))
    length, length_name = readable("m", [gap])
    return f"{time / second:.4g} {second_name}, gap {gap / length:.3g} {length_name}"
