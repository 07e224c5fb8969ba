"""The grid of a scene, and the heights and holes of both bodies on it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..accuracy import Accuracy
from ..errors import DescriptionError
from ..scene.interface import own_grid
from ..scene.scenes import ContactScene
from ..scene.surfaces import realise, union_of
from ..scene.window import Axis, Grid

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Map = NDArray[np.float64]

__all__ = ["combined_heights", "grid_of", "holes_of"]


def grid_of(scene: ContactScene, accuracy: Accuracy | None = None) -> Grid:
    """Grid of a scene: that of a measured surface, or `Accuracy.grid` over the window.

    Raises
    ------
    DescriptionError
        If no size is given, or two surfaces or a window bring different ones.
    """
    accuracy = accuracy or Accuracy.standard
    window = scene.window
    own = own_grid(scene.interface, accuracy)
    if own is not None:
        shape, pixel = own
        _agree(window.width, shape[1] * pixel[1], "Window.width")
        _agree(window.height, shape[0] * pixel[0], "Window.height")
        return Grid(shape, pixel, *_edges(scene))
    if window.width is None:
        raise DescriptionError(
            "Window.width", None, "be given where no surface is measured", unit="m"
        )
    ny, nx = accuracy.shape
    height = window.height if window.height is not None else window.width
    return Grid((ny, nx), (height / ny, window.width / nx), *_edges(scene))


def _edges(scene: ContactScene) -> tuple[bool, Axis | None]:
    """Whether the surfaces of a scene repeat, and the axis if along one alone.

    As the window says, else if all of them may.
    """
    periodic = scene.window.periodic
    if periodic is False:
        return False, None
    once = [one for body in scene.interface.bodies for one in body.surface.isolated_maps]
    if periodic and once:
        raise DescriptionError(
            "Window.periodic",
            periodic,
            f"be False or left out: {' and '.join(once)} states that it does not repeat",
            hint="if it does, say so there: is_periodic=True",
        )
    return (False, periodic) if isinstance(periodic, str) else (not once, None)


def _agree(given: float | None, own: float, field: str) -> None:
    if given is not None and abs(given / own - 1.0) > 1e-9:
        raise DescriptionError(
            field, given, f"be that of the height map, {own:g}, or left out", unit="m"
        )


def combined_heights(scene: ContactScene, grid: Grid) -> Map:
    """Sum of the heights of both bodies [m], (ny, nx), read-only.

    A given map beside a flat body is not copied: a large one is held once.
    """
    lower, upper = (realise(body.surface, grid) for body in scene.interface.bodies)
    for one, other in ((lower, upper), (upper, lower)):
        if not one.flags.writeable and not other.any():
            return one
    total = lower + upper
    total.flags.writeable = False
    return total


def holes_of(scene: ContactScene) -> NDArray[np.bool_] | None:
    """Pixels where a body has a hole, (ny, nx): they carry no load. None if there is none."""
    union = union_of(body.surface.void_pixels for body in scene.interface.bodies)
    if union is not None and union.all():
        raise DescriptionError(
            "Interface", "a hole in every pixel", "have pixels where both bodies are measured"
        )
    return union
