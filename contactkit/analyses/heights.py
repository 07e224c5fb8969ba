"""Heights of a surface on a grid, without a contact."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from ..accuracy import Accuracy
from ..contact.grid import grid_of
from ..scene.interface import Body, Interface
from ..scene.loading import Pressing
from ..scene.scenes import ContactScene
from ..scene.surfaces import Surface, realise
from ..scene.window import Window

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

__all__ = ["SurfaceHeights", "surface_heights"]


class SurfaceHeights(NamedTuple):
    """Heights (ny, nx) of a surface [m], peaks positive, and its pixel (dy, dx) [m]."""

    heights: NDArray[np.float64]
    pixel_size: tuple[float, float]
    is_periodic: bool


def surface_heights(
    surface: Surface, window: Window | None = None, accuracy: Accuracy | None = None
) -> SurfaceHeights:
    """Return the heights that a contact would have, for statistics or a picture.

    Parameters
    ----------
    surface : Surface
        Any surface.
    window : Window, optional
        Size of the window; not needed for a measured surface.
    accuracy : Accuracy, optional
        Its `grid` is taken; `Accuracy.standard` if not given.

    Raises
    ------
    DescriptionError
        If the surface does not fit the grid, or no size is given.

    Examples
    --------
    >>> import contactkit as ck
    >>> rough = ck.GaussianRoughness(rms=1e-9, correlation_length=0.5e-6, cutoff=0.3e-6, seed=1)
    >>> found = surface_heights(rough, ck.Window(width=10e-6), ck.Accuracy(grid=256))
    >>> found.heights.shape, found.is_periodic
    ((256, 256), True)
    >>> bool(abs(found.heights.std() / 1e-9 - 1.0) < 0.1)
    True
    """
    import numpy as np

    scene = ContactScene(
        interface=Interface(lower=Body(surface=surface)),
        window=window if window is not None else Window(),
        loading=Pressing(pressure=1.0),
        effects=(),
    )
    grid = grid_of(scene, accuracy)
    return SurfaceHeights(np.array(realise(surface, grid)), grid.pixel_size, grid.periodic)
