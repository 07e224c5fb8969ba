"""Interactive look at a contact: a map, sections that follow the mouse, a slider over depth."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ..analyses.subsurface import LABELS, MEASURES, MeasureName
from ..contact.effects.stress import SubsurfaceStress
from ..contact.result import ContactResult
from ..errors import DescriptionError, NotSimulatedError, nearest
from .axis_units import axis_label, axis_unit, readable
from .maps import extent, hide_holes, map_names, place
from .style import STYLE, mpl

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Map = NDArray[np.float64]

__all__ = ["Explorer", "explore"]


class Explorer:
    """A map with its sections along x and y through a point; planes of stress over depth.

    Moving the mouse over the map moves the point; a click holds it and the next one frees it.

    Attributes
    ----------
    figure : Figure
        The window.
    row, column : int
        Pixel of the point.
    plane : int
        Which plane of stress is shown; 0 for a map.
    slider : matplotlib.widgets.Slider or None
        Goes through the planes, and shows their depth; None for a map.
    """

    def __init__(
        self,
        result: ContactResult,
        maps: Map,
        label: tuple[str, str],
        depths: NDArray[np.float64] | None = None,
    ) -> None:
        import matplotlib.pyplot as plt
        from matplotlib.widgets import Slider

        self._maps, self._unit, self._depths, self.plane = maps, label[1], depths, 0
        (self._right, self._top), self._length = extent(result)[0][1::2], extent(result)[1]
        unit, length = axis_label(*label), self._length
        top = int(np.nanargmax(np.nan_to_num(maps[0])))
        self.row, self.column = (int(i) for i in np.unravel_index(top, maps[0].shape))
        self._is_held = False
        self.slider: Any = None
        with mpl.rc_context(STYLE | {"figure.constrained_layout.use": False}):
            self.figure = plt.figure(figsize=(11.0, 5.4))
            self._map = self.figure.add_axes((0.07, 0.2, 0.42, 0.7))
            self._across = self.figure.add_axes((0.6, 0.6, 0.37, 0.33))
            self._along = self.figure.add_axes((0.6, 0.14, 0.37, 0.33))
        low, high = float(np.nanmin(maps)), float(np.nanmax(maps))
        around = (0.0, self._right, 0.0, self._top)
        self._image = self._map.imshow(
            maps[0],
            origin="lower",
            extent=around,
            vmin=low,
            vmax=high,
            interpolation="nearest",
            cmap="YlGnBu",
        )
        hide_holes(self._map, result)
        _draw_edge(self._map, result, around)
        place(self._map, length)
        self._cross = (
            self._map.axhline(color="0.5", lw=0.8),
            self._map.axvline(color="0.5", lw=0.8),
        )
        self.figure.colorbar(self._image, ax=self._map, shrink=0.85).set_label(unit)
        ny, nx = maps[0].shape
        (self._x, self._y) = (np.arange(nx) + 0.5) / nx, (np.arange(ny) + 0.5) / ny
        (self._row_line,) = self._across.plot(self._x * self._right, maps[0][0])
        (self._column_line,) = self._along.plot(self._y * self._top, maps[0][:, 0])
        margin = 0.05 * (high - low) or 1.0
        for ax, name in ((self._across, "x"), (self._along, "y")):
            ax.set(xlabel=f"{name} [{length}]", ylabel=unit, ylim=(low - margin, high + margin))
        if len(maps) > 1:
            bar = self.figure.add_axes((0.12, 0.05, 0.28, 0.04))
            self.slider = Slider(bar, "depth", 0, len(maps) - 1, valinit=0, valstep=1)
            self.slider.on_changed(lambda chosen: self.show_plane(int(chosen)))
        self.figure.canvas.mpl_connect("motion_notify_event", self._moved)
        self.figure.canvas.mpl_connect("button_press_event", self._clicked)
        self._draw()

    def show_plane(self, plane: int) -> None:
        """Show another plane of stress."""
        self.plane = plane
        self._draw()

    def show_point(self, row: int, column: int) -> None:
        """Show the sections through another pixel."""
        ny, nx = self._maps[0].shape
        self.row, self.column = min(max(row, 0), ny - 1), min(max(column, 0), nx - 1)
        self._draw()

    def _moved(self, event: Any) -> None:
        if event.inaxes is self._map and not self._is_held:
            ny, nx = self._maps[0].shape
            row, column = event.ydata / self._top * ny, event.xdata / self._right * nx
            self.show_point(int(row), int(column))

    def _clicked(self, event: Any) -> None:
        if event.inaxes is self._map:
            self._is_held = not self._is_held
            self._moved(event)

    def _draw(self) -> None:
        values = self._maps[self.plane]
        self._image.set_data(values)
        x, y = self._x[self.column] * self._right, self._y[self.row] * self._top
        self._cross[0].set_ydata([y, y])
        self._cross[1].set_xdata([x, x])
        self._row_line.set_ydata(values[self.row])
        self._column_line.set_ydata(values[:, self.column])
        number = f"{values[self.row, self.column]:.4g}"
        here = number if self._unit in ("-", "") else f"{number} {self._unit}"
        at = f"x = {x:.3g}, y = {y:.3g} {self._length}"
        if self._depths is not None:
            factor, name = axis_unit(float(self._depths[self.plane]), "m")
            depth = f"{self._depths[self.plane] / factor:.3g} {name}"
            at += f", {depth} deep"
            if self.slider is not None:
                self.slider.valtext.set_text(depth)
        self._map.set_title(f"{here} at {at}", loc="left", fontsize=10)
        self.figure.canvas.draw_idle()


def _draw_edge(ax: Any, result: ContactResult, around: tuple[float, float, float, float]) -> None:
    """Draw the edge of the contact on a map, if it has one."""
    if result.contact.any() and not result.contact.all():
        look = {"colors": "#d55e00", "linewidths": 0.7}
        ax.contour(result.contact, [0.5], origin="lower", extent=around, **look)


def explore(
    result: ContactResult, name: str = "pressure", measure: MeasureName | None = None
) -> Explorer:
    """Look at a map of a contact, or at its planes of stress, with the mouse.

    ``matplotlib.pyplot.show()`` opens the window; in a notebook ``%matplotlib widget`` does.

    Parameters
    ----------
    result : ContactResult
        The contact.
    name : str
        Map to look at.
    measure : str, optional
        Measure of the stress to look at instead, on the planes that were kept.

    Raises
    ------
    NotSimulatedError
        If a measure is given and the scene lists no `SubsurfaceStress` that kept all planes.
    DescriptionError
        If there is no such map or measure.
    """
    if measure is None:
        known = map_names(result)
        if name not in known:
            expected = f"be one of {', '.join(known)}"
            raise DescriptionError("map", name, expected, hint=nearest(name, list(known)))
        one = result.contents().quantities[name]
        values = np.asarray(one.values, dtype=float)
        values = values[(-1,) * (values.ndim - 2)]
        factor, unit = readable(one.unit, values)
        label = one.label or name.replace("_", " ")
        return Explorer(result, values[None] / factor, (label, unit))
    part = result.of(SubsurfaceStress)
    if part.planes is None:
        raise NotSimulatedError('only a section was kept: SubsurfaceStress(keep="planes")')
    if measure not in MEASURES:
        raise DescriptionError("explore.measure", measure, f"be one of {', '.join(MEASURES)}")
    stress = np.asarray(MEASURES[measure](part.planes))
    factor, unit = axis_unit(float(stress.max()), "Pa")
    return Explorer(result, stress / factor, (LABELS[measure], unit), np.asarray(part.depth))
