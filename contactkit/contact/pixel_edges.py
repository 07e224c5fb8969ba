"""Edges between the pixels in and out of contact: the perimeter of the spots on the grid."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ..scene.window import Edges

__all__ = ["EDGE_EXCESS", "PixelEdges", "pixel_edges"]

EDGE_EXCESS = (math.pi - 1.0 + math.log(2.0)) / 24.0
"""Mean excess of a pixel count for each edge, over the area of a pixel [-].

Over the directions of a smooth edge (Yastrebov, Anciaux and Molinari 2017).
"""


class PixelEdges(NamedTuple):
    """Numbers of edges crossed along x and along y."""

    along_x: int
    along_y: int

    @property
    def total(self) -> int:
        """Number of edges."""
        return self.along_x + self.along_y


def pixel_edges(touching: NDArray[np.bool_], periodic: Edges) -> PixelEdges:
    """Count the edges between pixels in and out of contact; outside an isolated one there is none.

    `periodic` may be "x" or "y": along that axis alone.

    Examples
    --------
    >>> pixel_edges(np.array([[True, False], [True, False]]), periodic=False)
    PixelEdges(along_x=4, along_y=2)
    """
    along_x, along_y = (periodic in (True, axis) for axis in ("x", "y"))
    return PixelEdges(_edges(touching, 1, along_x), _edges(touching, 0, along_y))


def _edges(touching: NDArray[np.bool_], axis: int, periodic: bool) -> int:
    """Number of edges between pixels in and out of contact that are neighbours along an axis."""
    if periodic:
        return int((touching ^ np.roll(touching, 1, axis)).sum())
    inner = int(np.diff(touching, axis=axis).sum())
    return inner + int(touching.take([0, -1], axis).sum())
