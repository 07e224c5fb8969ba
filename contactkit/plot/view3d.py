"""Surface, pressure and stress of a contact in three dimensions, through pyvista."""

from __future__ import annotations

import textwrap
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from ..analyses.subsurface import LABELS, MEASURES, MeasureName
from ..contact.effects.stress import SubsurfaceStress
from ..contact.result import ContactResult
from ..errors import DescriptionError, NotSimulatedError, nearest
from ..extras import require
from ..files.scenes import write_whole
from .axis_units import axis_label, axis_unit, readable
from .maps import map_names
from .style import mpl

if TYPE_CHECKING:
    import pyvista as pv

__all__ = ["save_view", "stress_grid", "surface_mesh", "view_stress", "view_surface"]

Shape = Literal["gap", "heights"]
_PURPOSE = "a view in three dimensions"
# Heights are magnified to this fraction of the window: more hides valleys behind summits, less
# looks flat in the slanted view.
_RELIEF = 0.15
_ON_GREY = ("pressure",)
_FONT_OF_A_FILE = 4  # VTK_FONT_FILE
_MARGIN = 15  # pixels around what is drawn
_FAINT = 0.1  # of the maximum: as deep as the stress is larger, it is drawn; as in `stress`


def surface_mesh(
    result: ContactResult, colour: str = "pressure", shape: Shape = "gap", stretch: float = 1.0
) -> pv.StructuredGrid:
    """Surface of a contact as a mesh of pixels with its maps as data.

    Parameters
    ----------
    result : ContactResult
        The contact.
    colour : str
        Map that colours it: the active scalars of the mesh.
    shape : {"gap", "heights"}
        Height of its points [m]: minus the gap, the deformed surface under a flat one, or the
        heights of both bodies before contact.
    stretch : float
        Factor of the heights.

    Returns
    -------
    pyvista.StructuredGrid
        One point for each pixel, in metres; the data are in SI units, nan in holes.

    Raises
    ------
    DescriptionError
        If there is no such map, or the stretch is not above 0.
    MissingExtraError
        If pyvista is not installed: ``pip install contactkit[view3d]``.
    """
    require("pyvista", _PURPOSE)
    if not stretch > 0.0:
        raise DescriptionError("surface_mesh.stretch", stretch, "be above 0")
    known, names = result.contents().quantities, map_names(result)
    if colour not in names:
        expected = f"be one of {', '.join(names)}"
        raise DescriptionError("colour", colour, expected, hint=nearest(colour, list(names)))
    height = -result.gap if shape == "gap" else result.heights
    x, y = _centres(result)
    mesh: pv.StructuredGrid = _pyvista().StructuredGrid(
        *np.meshgrid(x, y), stretch * _without_holes(result, height)
    )
    values = np.asarray(known[colour].values)
    values = values[(-1,) * (values.ndim - 2)].astype(float)
    mesh.point_data[colour] = _without_holes(result, values).ravel(order="F")
    mesh.set_active_scalars(colour)
    return mesh


def stress_grid(result: ContactResult, measure: MeasureName = "von_mises") -> pv.RectilinearGrid:
    """Stress below a contact as a grid over x, y and -z, in metres and pascals.

    Both planes at an interface are there, a millionth of the depth apart.

    Parameters
    ----------
    result : ContactResult
        With `SubsurfaceStress` that kept all planes.
    measure : str
        As in `plot.stress.below`.

    Returns
    -------
    pyvista.RectilinearGrid
        One point for each pixel of each plane.

    Raises
    ------
    NotSimulatedError
        If the scene does not list `SubsurfaceStress`, or kept a section only.
    DescriptionError
        If there is no such measure, or only one plane.
    MissingExtraError
        If pyvista is not installed: ``pip install contactkit[view3d]``.
    """
    require("pyvista", _PURPOSE)
    part = result.of(SubsurfaceStress)
    if part.planes is None:
        raise NotSimulatedError('only a section was kept: SubsurfaceStress(keep="planes")')
    if measure not in MEASURES:
        raise DescriptionError("stress_grid.measure", measure, f"be one of {', '.join(MEASURES)}")
    if len(part.depth) < 2:
        raise DescriptionError("depths", len(part.depth), "be two or more, to fill a volume")
    x, y = _centres(result)
    return _block(x, y, part.depth, np.asarray(MEASURES[measure](part.planes)), measure)


def _block(x: Any, y: Any, depth: Any, values: Any, name: str) -> pv.RectilinearGrid:
    """Values (n, ny, nx) on planes as a grid; z points out of the body."""
    twice = np.concatenate([[False], np.diff(depth) <= 0.0])
    z = -depth * np.where(twice, 1.0 + 1e-6, 1.0)
    grid: pv.RectilinearGrid = _pyvista().RectilinearGrid(x, y, z[::-1])  # ascending
    grid.point_data[name] = values[::-1].ravel()  # x varies fastest, as in VTK
    grid.set_active_scalars(name)
    return grid


def view_surface(
    result: ContactResult,
    colour: str = "pressure",
    shape: Shape = "gap",
    *,
    stretch: float | None = None,
    off_screen: bool = False,
) -> pv.Plotter:
    """Draw the surface of a contact in three dimensions, coloured by a map.

    ``view.show()`` opens a window that turns with the mouse; `save_view` writes a file.

    Parameters
    ----------
    result, colour, shape
        See `surface_mesh`.
    stretch : float, optional
        Factor of the heights; so large that they are a sixth of the window if not given.
    off_screen : bool
        Whether to draw without a window, for a file.

    Raises
    ------
    DescriptionError
        See `surface_mesh`.
    MissingExtraError
        If pyvista is not installed.
    """
    mesh = surface_mesh(result, colour, shape)
    lengths = np.ptp(np.asarray(mesh.points), axis=0)
    if stretch is None:
        stretch = float(_RELIEF * lengths[:2].max() / lengths[2]) if lengths[2] > 0.0 else 1.0
    mesh = surface_mesh(result, colour, shape, stretch)
    one = result.contents().quantities[colour]
    values = np.asarray(mesh.point_data[colour])
    factor, unit = readable(one.unit, values)
    title = axis_label(one.label or colour.replace("_", " "), unit)
    remark = f"drawn {stretch:.3g} times as high" if stretch != 1.0 else "to scale"
    return _drawn(mesh, colour, (factor, title), remark, off_screen, stretch)


def view_stress(
    result: ContactResult, measure: MeasureName = "von_mises", *, off_screen: bool = False
) -> pv.Plotter:
    """Draw the stress below a contact in three dimensions: cut open at its maximum, to scale.

    Parameters
    ----------
    result, measure
        See `stress_grid`.
    off_screen : bool
        Whether to draw without a window, for a file.

    Raises
    ------
    NotSimulatedError
        See `stress_grid`.
    DescriptionError
        See `stress_grid`.
    MissingExtraError
        If pyvista is not installed.
    """
    grid = _around_maximum(result, stress_grid(result, measure), measure)
    values = np.asarray(grid.point_data[measure])
    place = np.asarray(grid.points)[int(values.argmax())]
    low, high = np.asarray(grid.bounds).reshape(3, 2).T
    # The quarter towards the viewer is taken away, so that both cut faces meet at the maximum.
    cut = grid.clip_box((place[0], high[0], place[1], high[1], low[2], high[2]), invert=True)
    factor, unit = axis_unit(float(values.max()), "Pa")
    title = axis_label(LABELS[measure], unit)
    return _drawn(cut, measure, (factor, title), "cut open at the maximum", off_screen)


def _around_maximum(
    result: ContactResult, grid: pv.RectilinearGrid, name: str
) -> pv.RectilinearGrid:
    """The part of a block around its maximum, as deep and wide as the stress is not small.

    A window that repeats is rolled, with the maximum in its middle; x and y count from there.
    """
    nx, ny, nz = grid.dimensions
    values = np.asarray(grid.point_data[name]).reshape(nz, ny, nx)[::-1]
    depth = -np.asarray(grid.z)[::-1]
    _, row, column = np.unravel_index(int(values.argmax()), values.shape)
    x, y = np.asarray(grid.x) - grid.x[column], np.asarray(grid.y) - grid.y[row]
    if result.plan.grid.periodic:
        values = np.roll(values, (ny // 2 - row, nx // 2 - column), axis=(1, 2))
        (dy, dx) = result.plan.grid.pixel_size
        x, y = (np.arange(nx) - nx // 2) * dx, (np.arange(ny) - ny // 2) * dy
    deep = max(2, int(np.flatnonzero(values.max(axis=(1, 2)) > _FAINT * values.max())[-1]) + 1)
    reach = 1.2 * float(depth[:deep][-1])
    near_x, near_y = (_wide_enough(np.abs(one) <= reach) for one in (x, y))
    picked = values[:deep][:, near_y][:, :, near_x]
    return _block(x[near_x], y[near_y], depth[:deep], picked, name)


def _wide_enough(near: Any) -> Any:
    """The mask itself, or all where it leaves less than a line."""
    return near if near.sum() > 2 else np.ones_like(near)


def save_view(view: pv.Plotter, path: str | Path) -> Path:
    """Write a view as PNG without its empty margins, completely or not at all, and close it.

    Parameters
    ----------
    view : pyvista.Plotter
        Made with ``off_screen=True``.
    path : str or Path
        File ending in ``.png``.

    Raises
    ------
    DescriptionError
        If the suffix is another one.
    """
    path = Path(path)
    if path.suffix.lower() != ".png":
        raise DescriptionError("save_view.path", str(path), "end in .png")
    from PIL import Image

    picture: Any = view.screenshot(None, return_img=True)
    pixels = np.asarray(picture)[..., :3]
    view.close()
    drawn = np.any(pixels < 255, axis=2)
    rows, columns = np.flatnonzero(drawn.max(axis=1)), np.flatnonzero(drawn.max(axis=0))
    top, left = max(rows[0] - _MARGIN, 0), max(columns[0] - _MARGIN, 0)
    cut = Image.fromarray(pixels[top : rows[-1] + _MARGIN, left : columns[-1] + _MARGIN])
    with write_whole(path) as temporary:
        cut.save(temporary, format="png")
    return path


def _pyvista() -> Any:
    """The package, or the extra that installs it."""
    require("pyvista", _PURPOSE)
    import pyvista

    return pyvista


def _centres(result: ContactResult) -> Sequence[Any]:
    """Centres of the pixels along x and y [m]."""
    (ny, nx), (dy, dx) = result.plan.grid.shape, result.plan.grid.pixel_size
    return (np.arange(nx) + 0.5) * dx, (np.arange(ny) + 0.5) * dy


def _without_holes(result: ContactResult, values: Any) -> Any:
    return values if result.holes is None else np.where(result.holes, np.nan, values)


def _drawn(
    mesh: Any,
    name: str,
    scale: tuple[float, str],
    remark: str,
    off_screen: bool,
    stretch: float = 1.0,
) -> pv.Plotter:
    """A view of a mesh, in the unit of lengths that reads best; `scale` is that of the data."""
    low, high = np.asarray(mesh.bounds).reshape(3, 2).T
    length, unit = axis_unit(float((high - low).max()), "m")
    factor, title = scale
    shown = mesh.copy()
    values = np.asarray(shown.point_data[name]) / factor
    more: dict[str, Any] = {"nan_opacity": 0.0} if np.isnan(values).any() else {}
    bar: dict[str, Any] = {}
    least, top = float(np.nanmin(values)), float(np.nanmax(values))
    if name == "pressure" and least >= 0.0 < top:  # grey out of contact
        values = np.where(values > 0.0, values, -top)
        more |= {"below_color": "#c4c4be"}
        bar, least = {"below_label": "open"}, 0.0
    elif least > 0.0:
        least = 0.0
    shown.point_data[name] = values
    shown = shown.scale(1.0 / length, inplace=False)
    view: Any = _pyvista().Plotter(off_screen=off_screen, window_size=[1400, 900])
    view.set_background("white")
    colours = "viridis" if name in _ON_GREY else "YlOrRd"
    levels = round_steps(least, top)
    more |= {"clim": (levels[0], levels[-1]), "cmap": colours, "show_scalar_bar": False}
    view.add_mesh(shown, scalars=name, ambient=0.3, **more)
    _colour_bar(view, title, len(levels), bar)
    heights, name_of_heights = axis_unit(float((high - low)[2]) / stretch, "m")
    _axes(
        view,
        (low / length, high / length),
        (1.0, 1.0, stretch * heights / length),
        (unit, unit, name_of_heights),
    )
    view.add_text(remark, position="lower_left", font_size=11, color="black", font_file=_font())
    view.camera_position = "iso"
    view.reset_camera()
    made: pv.Plotter = view
    return made


def _colour_bar(view: Any, title: str, n: int, more: dict[str, Any]) -> None:
    """Colour bar at the right, with its title in lines that fit above it."""
    words, bracket, unit = title.partition(" [")
    lines = textwrap.wrap(words, 16) + ([bracket.strip() + unit] if bracket else [])
    bar = view.add_scalar_bar(
        "\n".join(lines) + "\n",
        color="black",
        vertical=True,
        position_x=0.84,
        position_y=0.1,
        height=0.6,
        width=0.08,
        title_font_size=20,
        label_font_size=20,
        n_labels=n,
        fmt="%.4g",
        **more,
    )
    for text in (bar.GetTitleTextProperty(), bar.GetLabelTextProperty()):
        text.SetFontFamily(_FONT_OF_A_FILE)
        text.SetFontFile(_font())


def _axes(view: Any, ends: Any, units: Sequence[float], names: Sequence[str]) -> None:
    """Draw three edges of the block as axes with round ticks, towards the viewer.

    `units` are the lengths of a unit of each axis in the drawing, and `names` those of the units.
    """
    low, high = ends
    size = float((high - low).max())
    corners = ((low[0], high[1], low[2]), (high[0], low[1], low[2]), (high[0], low[1], low[2]))
    outwards = ((0.0, 1.0, 0.0), (1.0, 0.0, 0.0), (0.7, -0.7, 0.0))
    for i, (corner, out, unit) in enumerate(zip(corners, outwards, units, strict=True)):
        start, away = np.array(corner), size * np.array(out)
        along = np.eye(3)[i]
        whole = np.array([start, start + (high - low)[i] * along])
        view.add_lines(whole, color="black", width=2)
        room = 0.12 * (high - low)[i]  # at the ends, where labels of two edges would meet
        ticks = [
            t
            for t in round_steps(low[i] / unit, high[i] / unit)
            if low[i] - 1e-9 * size + (i < 2) * room
            <= t * unit
            <= high[i] + 1e-9 * size - (i < 2) * room
        ]
        places = np.array([start + (t * unit - start[i]) * along for t in ticks])
        for place in places:
            view.add_lines(np.array([place, place + 0.02 * away]), color="black", width=2)
        _texts(view, places + 0.06 * away, [f"{t:g}" for t in ticks])
        _texts(view, [whole.mean(axis=0) + 0.17 * away], [f"{'xyz'[i]} [{names[i]}]"])


def _texts(view: Any, places: Any, texts: Sequence[str]) -> None:
    view.add_point_labels(
        np.asarray(places),
        list(texts),
        font_file=_font(),
        font_size=20,
        text_color="black",
        shape=None,
        show_points=False,
        always_visible=True,
        justification_horizontal="center",
        justification_vertical="center",
    )


def round_steps(low: float, high: float) -> list[float]:
    """Round numbers in equal steps from at most `low` to at least `high`."""
    high = high if high > low else low + 1.0
    ticks = mpl.ticker.MaxNLocator(5, steps=[1, 2, 2.5, 5, 10]).tick_values(low, high)
    return [float(one) for one in ticks]


def _font() -> str:
    """Font that has the letters of all units; those of VTK lack some."""
    return str(Path(mpl.get_data_path()) / "fonts" / "ttf" / "DejaVuSans.ttf")
