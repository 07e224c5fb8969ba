"""Figures of maps: values over the window of a contact with a colour bar, holes grey."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ..contact.result import ContactResult
from ..errors import DescriptionError, nearest
from .axis_units import axis_label, axis_unit, readable
from .style import Axes, ListedColormap, Patch, figure, legend

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Mask = NDArray[np.bool_]

__all__ = ["extent", "hide_holes", "map_names", "place", "value_map"]

_HOLES = "#b5b5ae"
_CONTACT = "#d55e00"


def extent(result: ContactResult) -> tuple[tuple[float, float, float, float], str]:
    """Ends of the window in the unit in which it reads best, and the name of that unit."""
    (ny, nx), (dy, dx) = result.plan.grid.shape, result.plan.grid.pixel_size
    factor, unit = axis_unit(max(nx * dx, ny * dy), "m")
    return (0.0, nx * dx / factor, 0.0, ny * dy / factor), unit


def hide_holes(ax: Axes, result: ContactResult) -> None:
    """Draw the pixels without a height in grey."""
    if result.holes is not None:
        _paint(ax, result, result.holes, _HOLES)


def _paint(ax: Axes, result: ContactResult, pixels: Mask, colour: str) -> None:
    """Draw some pixels in one colour."""
    ax.imshow(
        np.ma.masked_where(~pixels, np.zeros(pixels.shape)),
        origin="lower",
        extent=extent(result)[0],
        interpolation="nearest",
        cmap=ListedColormap([colour]),
    )


def place(ax: Axes, unit: str) -> None:
    """Label the axes of a map, to scale and without a grid."""
    ax.set(xlabel=f"x [{unit}]", ylabel=f"y [{unit}]", aspect="equal")
    ax.grid(visible=False)


def _mark_contact(ax: Axes, result: ContactResult) -> None:
    """Draw the pixels in contact in a colour of their own, named below the panel."""
    _paint(ax, result, result.contact, _CONTACT)
    names = [Patch(color=_CONTACT, label="contact")]
    legend(ax, handles=names, loc="upper center", bbox_to_anchor=(0.5, -0.14))


def map_names(result: ContactResult) -> tuple[str, ...]:
    """Names of the maps of a result, those of its effects among them."""
    known = result.contents().quantities.items()
    return tuple(name for name, one in known if one.axes[-2:] == ("y", "x"))


def value_map(
    result: ContactResult, name: str, ax: Axes | None = None, at: tuple[int, ...] = ()
) -> Axes:
    """Draw a map of a contact, or of one of its effects, with a colour bar.

    In that of the gap the contact has a colour of its own.

    Parameters
    ----------
    result : ContactResult
        The contact.
    name : str
        Name of the map, one of `map_names`.
    ax : Axes, optional
        Where to draw.
    at : tuple of int
        Which one of a stack of maps, such as ``(-1,)`` for the last step; the last if empty.

    Raises
    ------
    DescriptionError
        If there is no such map.
    """
    names = map_names(result)
    if name not in names:
        expected = f"be one of {', '.join(names)}"
        raise DescriptionError("map", name, expected, hint=nearest(name, list(names)))
    one = result.contents().quantities[name]
    values: NDArray[Any] = np.asarray(one.values)
    values = values[at or (-1,) * (values.ndim - 2)].astype(float)
    ax = ax if ax is not None else figure()[1]
    around, unit = extent(result)
    factor, shown = readable(one.unit, values)
    signed = bool(np.nanmin(values, initial=0.0) < 0.0 < np.nanmax(values, initial=0.0))
    top = float(np.nanmax(np.abs(values), initial=0.0)) / factor
    image = ax.imshow(
        values / factor,
        origin="lower",
        extent=around,
        interpolation="nearest",
        **({"cmap": "PuOr_r", "vmin": -top, "vmax": top} if signed else {"cmap": "viridis"}),
    )
    hide_holes(ax, result)
    place(ax, unit)
    if name == "gap" and result.contact.any():  # otherwise as dark as what nearly touches
        _mark_contact(ax, result)
    bar = ax.figure.colorbar(image, ax=ax, shrink=0.85)
    bar.set_label(axis_label(one.label or name.replace("_", " "), shown))
    return ax
