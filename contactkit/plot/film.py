"""Figures of films on faces: pressure, liquid fraction, openings in time, animations."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from scipy.ndimage import distance_transform_edt

from ..errors import DescriptionError
from ..lubrication.reynolds.film import GridFilmState
from .axis_units import axis_unit, scaled
from .style import COLORS, Axes, ListedColormap, Patch, figure, legend, save_animation

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

__all__ = ["animate", "instants", "liquid_fraction", "opening", "pressure"]

BAR = 1e5  # [Pa], in which pressures are drawn
_CAVITY, _CAVITY_FILL = "#c1440e", "#f6c9ae"
_PRESSURES = "viridis"
Mirror = tuple[bool, bool]
Extent = tuple[float, float, float, float]


def pressure(
    state: GridFilmState,
    ax: Axes | None = None,
    *,
    mirror: Mirror = (False, False),
    limits: tuple[float, float] | None = None,
) -> Axes:
    """Draw the pressure above ambient; a cavity is light red, what is no film is white.

    Parameters
    ----------
    state : GridFilmState
        The film.
    ax : Axes, optional
        Where to draw.
    mirror : tuple of bool
        Whether the window is half of the face along y and along x, cut at its first row or column.
    limits : tuple of float, optional
        Ends of the colours [bar].
    """
    ax = ax if ax is not None else figure(size=(5.0, 4.2))[1]
    values = (state.pressure - state.film.ambient) / BAR
    image = _map(state, values, ax, mirror, _PRESSURES, limits)
    bar = ax.figure.colorbar(image, ax=ax, shrink=0.85)
    bar.set_label("pressure above ambient [bar]")
    _name_cavity(ax, [state], loc="upper center", bbox_to_anchor=(0.5, -0.12))
    return ax


def liquid_fraction(
    state: GridFilmState, ax: Axes | None = None, *, mirror: Mirror = (False, False)
) -> Axes:
    """Draw the fraction of the gap that is liquid, 1 where the film is full.

    Parameters
    ----------
    state, ax, mirror
        See `pressure`.
    """
    ax = ax if ax is not None else figure(size=(5.0, 4.2))[1]
    image = _map(state, state.liquid_fraction, ax, mirror, "Blues", (0.0, 1.0))
    bar = ax.figure.colorbar(image, ax=ax, shrink=0.85)
    bar.set_label("liquid fraction [-]")
    return ax


def instants(
    states: Sequence[GridFilmState], *, mirror: Mirror = (False, False), size: float = 2.6
) -> Figure:
    """Draw pressure and liquid fraction at some instants, with one scale for each.

    Parameters
    ----------
    states : sequence of GridFilmState
        The film at each instant; some four are well told apart.
    mirror
        See `pressure`.
    size : float
        Width of a panel [inch].

    Raises
    ------
    DescriptionError
        If there is no state.
    """
    if not states:
        raise DescriptionError("instants.states", 0, "be one or more states")
    made, axes = figure(2, len(states), size=(size * len(states) + 1.0, 2.0 * size), squeeze=False)
    limits = _pressure_limits(states)
    for column, state in enumerate(states):
        values = (state.pressure - state.film.ambient) / BAR
        above = _map(state, values, axes[0, column], mirror, _PRESSURES, limits)
        below = _map(state, state.liquid_fraction, axes[1, column], mirror, "Blues", (0.0, 1.0))
        gap = float(state.gap[state.film.face.loaded].min())
        axes[0, column].set_title(_instant(state.time, gap), fontsize=9)
        axes[0, column].set_xlabel("")
        if column:
            for row in (0, 1):
                axes[row, column].set_ylabel("")
    made.colorbar(above, ax=axes[0, :], shrink=0.9).set_label("pressure above ambient [bar]")
    made.colorbar(below, ax=axes[1, :], shrink=0.9).set_label("liquid fraction [-]")
    _name_cavity(axes[0, 0], states, loc="lower left", bbox_to_anchor=(-0.2, 1.1))
    return made


def opening(
    states: Sequence[GridFilmState],
    axes: Sequence[Axes] | None = None,
    *,
    copies: int = 1,
) -> Sequence[Axes]:
    """Draw gap, force and size of the cavity of a film over time.

    Parameters
    ----------
    states : sequence of GridFilmState
        Steps of `follow_gap`.
    axes : sequence of Axes, optional
        Three panels.
    copies : int
        How often the window stands for the face: 4 for a quarter.

    Raises
    ------
    DescriptionError
        If there are fewer than two steps.
    """
    if len(states) < 2:
        raise DescriptionError("opening.states", len(states), "be two or more steps")
    if axes is None:
        axes = figure(3, 1, size=(6.5, 6.5), sharex=True)[1]
    force = [copies * s.force for s in states]
    time = np.array([s.time for s in states]) * 1e3
    gap, length = scaled([s.gap[s.film.face.loaded].min() for s in states], "m")
    radius = np.sqrt([copies * s.cavity_area / np.pi for s in states]) * 1e3
    face = states[0].film.face
    film = float(np.sqrt(copies * face.loaded.sum() * face.cell_area / np.pi)) * 1e3
    axes[0].plot(time, gap, color=COLORS["gap"])
    axes[0].set(ylabel=f"smallest gap [{length}]", ylim=(0.0, None))
    axes[1].plot(time, force, color=COLORS["viscous"])
    axes[1].set(ylabel="force of the film [N]")
    axes[2].plot(time, radius, color=_CAVITY, label="cavity")
    axes[2].axhline(film, color="0.5", ls=":", label="film")
    axes[2].set(ylabel="radius of equal area [mm]", xlabel="time [ms]", ylim=(0.0, 1.15 * film))
    legend(axes[2], loc="lower right")
    return axes


def animate(
    states: Sequence[GridFilmState],
    path: str | Path,
    *,
    mirror: Mirror = (False, False),
    copies: int = 1,
    rate: int = 10,
) -> Path:
    """Write an animation of an opening as GIF: pressure, liquid fraction, and the force so far.

    Parameters
    ----------
    states : sequence of GridFilmState
        One for each picture.
    path : str or Path
        File to write, ending in .gif.
    mirror
        See `pressure`.
    copies : int
        How often the window stands for the face, for the force.
    rate : int
        Pictures a second.

    Returns
    -------
    Path
        The file.

    Raises
    ------
    DescriptionError
        If there are fewer than two states, or the file is no GIF.
    """
    if len(states) < 2:
        raise DescriptionError("animate.states", len(states), "be two or more states")
    made, axes = figure(1, 3, size=(10.8, 3.5))
    limits = _pressure_limits(states)
    time = [s.time * 1e3 for s in states]
    force = [copies * s.force for s in states]

    def draw(index: int) -> list[Any]:
        state = states[index]
        for ax in axes:
            ax.clear()
        values = (state.pressure - state.film.ambient) / BAR
        _map(state, values, axes[0], mirror, _PRESSURES, limits)
        _map(state, state.liquid_fraction, axes[1], mirror, "Blues", (0.0, 1.0))
        gap = float(state.gap[state.film.face.loaded].min())
        axes[0].set_title("pressure", fontsize=9)
        _name_cavity(axes[0], states, loc="upper center", bbox_to_anchor=(0.5, -0.16))
        axes[1].set_title(f"liquid, {_instant(state.time, gap)}", fontsize=9)
        axes[2].plot(time, force, color="0.85")
        axes[2].plot(time[: index + 1], force[: index + 1], color=COLORS["viscous"])
        axes[2].plot(time[index], force[index], "o", color=COLORS["viscous"], ms=4)
        axes[2].set(xlabel="time [ms]", ylabel="force of the film [N]")
        return list(axes)

    shown = draw(0)
    scales = [ax.images[0] for ax in axes[:2]]
    labels = ("pressure above ambient [bar]", "liquid fraction [-]")
    for ax, image, label in zip(axes, scales, labels, strict=False):
        made.colorbar(image, ax=ax, shrink=0.8).set_label(label, fontsize=9)
    return save_animation(made, path, draw, len(states), rate, first=shown)


def _instant(time: float, gap: float) -> str:
    factor, unit = next(
        ((f, u) for f, u in ((1.0, "s"), (1e-3, "ms"), (1e-6, "µs")) if time >= f), (1e-9, "ns")
    )
    size, length = axis_unit(gap, "m")
    return f"{time / factor:.3g} {unit}, {gap / size:.3g} {length}"


def _pressure_limits(states: Sequence[GridFilmState]) -> tuple[float, float]:
    """Smallest and largest pressure above ambient in all states [bar]."""
    values = [(s.pressure - s.film.ambient)[s.film.face.loaded] / BAR for s in states]
    low, high = min(float(v.min()) for v in values), max(float(v.max()) for v in values)
    return low, high if high > low else low + 1.0


def _map(
    state: GridFilmState,
    values: NDArray[np.floating[Any]],
    ax: Axes,
    mirror: Mirror,
    colours: str,
    limits: tuple[float, float] | None,
) -> Any:
    """Draw a map of the film on an axis, with the edge of its cavity."""
    face = state.film.face
    (dy, dx), (y0, x0) = face.pixel_size, face.origin
    ny, nx = face.shape
    right, top = x0 + (nx - 0.5) * dx, y0 + (ny - 0.5) * dy
    left = 2.0 * (x0 - 0.5 * dx) - right if mirror[1] else x0 - 0.5 * dx
    bottom = 2.0 * (y0 - 0.5 * dy) - top if mirror[0] else y0 - 0.5 * dy
    factor, unit = axis_unit(max(right - left, top - bottom), "m")
    extent = (left / factor, right / factor, bottom / factor, top / factor)
    low, high = limits if limits is not None else (None, None)
    look: dict[str, Any] = {"origin": "lower", "extent": extent, "interpolation": "nearest"}
    shown = _unfold(np.ma.masked_array(values, ~face.loaded), mirror)
    image = ax.imshow(shown, cmap=colours, vmin=low, vmax=high, **look)
    void = _unfold(face.loaded & (state.liquid_fraction < 1.0), mirror)
    if colours == _PRESSURES and void.any():
        flat = np.ma.masked_where(~void, np.zeros(void.shape))
        ax.imshow(flat, cmap=ListedColormap([_CAVITY_FILL]), **look)
    if 0.0 < void.mean() < 1.0 and min(void.shape) > 1:
        at_cells: dict[str, Any] = {"origin": "lower", "extent": extent}
        ax.contour(void * 1.0, levels=[0.5], colors=_CAVITY, linewidths=1.0, **at_cells)
    around = distance_transform_edt(~face.loaded, return_distances=False, return_indices=True)
    beyond = _unfold(np.where(face.level > -max(dx, dy), values[tuple(around)], np.nan), mirror)
    low, high = image.get_clim()
    ax.imshow(beyond, cmap=colours, vmin=low, vmax=high, zorder=-1.0, **look)
    _round_off(ax, state, mirror, extent)
    ax.set(xlabel=f"x [{unit}]", ylabel=f"y [{unit}]", aspect="equal")
    ax.grid(visible=False)
    return image


def _round_off(ax: Axes, state: GridFilmState, mirror: Mirror, extent: Extent) -> None:
    """Cover what lies beyond the edge of the film: the cells that it cuts are drawn cut."""
    face = state.film.face
    level = _unfold(np.where(face.loaded, np.abs(face.level), face.level), mirror)
    level = np.pad(np.asarray(level), 1, mode="edge")  # contours end at the centres of cells
    left, right, bottom, top = extent
    dx, dy = (right - left) / (level.shape[1] - 2), (top - bottom) / (level.shape[0] - 2)
    extent = (left - dx, right + dx, bottom - dy, top + dy)
    if min(level.shape) > 1 and level.min() < 0.0 < level.max():
        at_cells: dict[str, Any] = {"origin": "lower", "extent": extent}
        ax.contourf(level, levels=[float(level.min()) - 1.0, 0.0], colors="w", **at_cells)
        ax.contour(level, levels=[0.0], colors="0.4", linewidths=0.8, **at_cells)
        ax.set(xlim=(left, right), ylim=(bottom, top))


def _name_cavity(ax: Axes, states: Sequence[GridFilmState], **more: Any) -> None:
    """Legend with the colour of the cavity and its pressure, if any of the states has one."""
    if any(one.cavity_area > 0.0 for one in states):
        drop = states[0].film.drop / BAR
        named = [Patch(color=_CAVITY_FILL, label=f"cavity, at {-drop:.3g} bar")]
        legend(ax, **({"handles": named, "fontsize": 8} | more))


def _unfold(values: Any, mirror: Mirror) -> Any:
    """Map with its mirror images before the first row and column."""
    for axis in (0, 1):
        if mirror[axis]:
            values = np.ma.concatenate(  # type: ignore[no-untyped-call]
                [np.flip(values, axis), values], axis=axis
            )
    return values
