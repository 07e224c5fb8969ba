"""Maxima of stress measures and their locations, in one pass over the planes.

z points into the solid; x and y count from the first pixel of the map.  In-plane stresses jump at
an interface, so that a maximum often lies on one of its sides; no fit crosses an interface.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

__all__ = ["Maximum", "maxima", "plane_maximum"]

Array = NDArray[np.float64]
Measure = Callable[[Array], Array]


class Maximum(NamedTuple):
    """Maximum of a measure and its location: lengths in [m], side and layer of the plane."""

    value: float
    x: float
    y: float
    z: float
    side: str
    layer: int


class StressPlane(Protocol):
    """A plane with its stresses, such as `planes.Plane`."""

    @property
    def depth(self) -> float:
        """Depth [m]."""
        ...

    @property
    def side(self) -> str:
        """Side of an interface, "+" below or "-" above."""
        ...

    @property
    def layer(self) -> int:
        """Layer from the top, 0 first."""
        ...

    @property
    def stress(self) -> Array:
        """Stress (6, ny, nx) [Pa]."""
        ...


def plane_maximum(
    values: Array, pixel_size: tuple[float, float], depth: float, side: str, layer: int
) -> Maximum:
    """Maximum on one plane; x and y are those of the pixel, from the first one of the map.

    Parameters
    ----------
    values : ndarray, shape (ny, nx)
        Of any measure.
    pixel_size : (dy, dx)
        [m].
    depth, side, layer
        Of the plane.

    Returns
    -------
    Maximum

    Examples
    --------
    >>> plane_maximum(np.array([[1.0, 3.0]]), (1.0, 0.5), 2.0, "+", 0)
    Maximum(value=3.0, x=0.5, y=0.0, z=2.0, side='+', layer=0)
    """
    row, column = divmod(int(np.argmax(values)), values.shape[1])
    dy, dx = pixel_size
    return Maximum(float(values[row, column]), column * dx, row * dy, depth, side, layer)


def maxima(
    planes: Iterable[StressPlane],
    measures: Mapping[str, Measure],
    pixel_size: tuple[float, float],
    *,
    refine: bool = False,
) -> dict[str, Maximum]:
    """Maximum of each measure over all planes.

    Parameters
    ----------
    planes : iterable of planes
        Such as `planes.planes`, each with depth, side, layer and stress (6, ny, nx).
    measures : mapping of str to callable
        Stress (6, ny, nx) to values (ny, nx), such as those of `measures`.
    pixel_size : (dy, dx)
        [m].
    refine : bool, optional
        Fit a parabola in depth to the maxima of three planes of one layer, the middle one of which
        has the largest.  A maximum at an interface or on the surface is not moved, and no fit
        crosses an interface.

    Returns
    -------
    dict of str to Maximum
        One for each measure; empty without planes.

    Examples
    --------
    >>> from ..depths import default_depths
    >>> from ..layer_stack import Layers
    >>> from .measures import sqrt_j2
    >>> from .planes import planes
    >>> from .tractions import Tractions
    >>> wave = np.cos(2 * np.pi * np.arange(32) / 32)[None, :]
    >>> depths = list(np.linspace(0.05, 0.3, 41))
    >>> pixel = (1.0, 1 / 32)
    >>> below = planes(Tractions(pixel, wave), Layers([1e9], [0.5]), depths)
    >>> peak = maxima(below, {"sqrt_j2": sqrt_j2}, pixel, refine=True)["sqrt_j2"]
    >>> round(peak.value * np.e, 4), round(peak.z * 2 * np.pi, 3)  # k exp(-k) at k = 1
    (1.0, 1.0)
    """
    found: dict[str, list[Maximum]] = {name: [] for name in measures}
    best: dict[str, Maximum] = {}
    for plane in planes:
        for name, measure in measures.items():
            values = measure(plane.stress)
            one = plane_maximum(values, pixel_size, plane.depth, plane.side, plane.layer)
            found[name].append(one)
            if name not in best or one.value > best[name].value:
                best[name] = one
    if refine:
        return {name: _refined(found[name], one) for name, one in best.items()}
    return best


def _refined(found: list[Maximum], best: Maximum) -> Maximum:
    same = sorted((one for one in found if one.layer == best.layer), key=lambda one: one.z)
    at = same.index(best)
    if not 0 < at < len(same) - 1:
        return best
    before, after = same[at - 1], same[at + 1]
    left, right = best.z - before.z, after.z - best.z
    if left <= 0.0 or right <= 0.0:
        return best
    down, up = (best.value - before.value) / left, (after.value - best.value) / right
    curvature = (up - down) / (left + right)
    if curvature >= 0.0:
        return best
    slope = (down * right + up * left) / (left + right)
    shift = -0.5 * slope / curvature
    return best._replace(value=best.value + 0.5 * slope * shift, z=best.z + shift)
