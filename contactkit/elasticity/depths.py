"""Planes at depth in a layered solid: layer, and side of an interface.

z points into the solid.  In-plane stresses jump at an interface: side "-" of a plane there is the
material above, side "+" the one below.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ..errors import DescriptionError

__all__ = ["Depths", "PlaneAt", "Side", "default_depths", "locate"]

Side = Literal["+", "-"]
SIDES: dict[str, Side] = {"+": "+", "-": "-"}


class PlaneAt(NamedTuple):
    """A plane: its depth [m], its side of an interface, and its layer, 0 at the top."""

    depth: float
    side: Side
    layer: int


class Depths(NamedTuple):
    """Depths of planes [m], ascending, and the side of each."""

    depths: list[float]
    sides: list[Side]


def locate(
    depths: Sequence[float],
    sides: Sequence[str] | str,
    thickness: ArrayLike,
    *,
    on_base: bool = False,
) -> list[PlaneAt]:
    """Depth, side and layer of each plane, in the order given.

    Parameters
    ----------
    depths : sequence of float
        Of the planes, >= 0 [m].
    sides : sequence of {"+", "-"} or one of them for all
        Material of a plane on an interface: "+" the lower, "-" the upper one.  The surface itself
        belongs to the top layer for either side.
    thickness : array_like, shape (n_layers,)
        [m].
    on_base : bool, optional
        Whether a rigid base takes the place of the substrate: a plane on it belongs to the lowest
        layer for either side.

    Returns
    -------
    list of PlaneAt
        Layers are counted from 0 at the top; n_layers is the substrate.

    Raises
    ------
    DescriptionError
        For a negative or non-finite depth, one below a rigid base, an unknown side, or unequal
        numbers of both.

    Notes
    -----
    A depth within a relative distance of 1e-12 of an interface is on the interface, because sums of
    thicknesses depend on their order at round-off.

    Examples
    --------
    >>> planes = locate([0.0, 0.75, 0.75, 1.0], ["+", "-", "+", "+"], [0.25, 0.5])
    >>> [plane.layer for plane in planes]
    [0, 1, 2, 2]
    """
    each = [sides] * len(depths) if sides in ("+", "-") else list(sides)
    if len(each) != len(depths):
        raise DescriptionError("planes.sides", len(each), f"be {len(depths)}, one for each depth")
    bottoms = np.cumsum(np.asarray(thickness, dtype=np.float64))
    found: list[PlaneAt] = []
    for z, side in zip(depths, each, strict=True):
        if not 0.0 <= z < np.inf:
            raise DescriptionError("planes.depths", z, "be zero or positive and finite", unit="m")
        if side not in SIDES:
            raise DescriptionError("planes.sides", side, 'be "+" (below) or "-" (above)')
        known = SIDES[side]
        on = np.flatnonzero(np.abs(bottoms - z) <= 1e-12 * bottoms)
        if on_base and not on.size and z > bottoms[-1]:
            raise DescriptionError(
                "planes.depths", z, f"be at most {bottoms[-1]:g}, that of the rigid base", unit="m"
            )
        if on_base and on.size and on[0] == bottoms.size - 1:
            found.append(PlaneAt(float(bottoms[-1]), known, bottoms.size - 1))
        elif on.size:
            found.append(PlaneAt(float(bottoms[on[0]]), known, int(on[0]) + (side == "+")))
        else:
            found.append(PlaneAt(float(z), known, int(np.searchsorted(bottoms, z))))
    return found


def default_depths(thickness: ArrayLike, deepest: float, count: int = 24) -> Depths:
    """Default planes: the surface, both sides of every interface, and a graded set.

    Parameters
    ----------
    thickness : array_like, shape (n_layers,)
        [m].
    deepest : float
        Depth of the last plane, typically two contact radii [m].
    count : int, optional
        Number of graded planes, at `deepest` times the squares of 1/count, 2/count ...

    Returns
    -------
    Depths
        Interfaces below `deepest` are omitted.

    Raises
    ------
    DescriptionError
        Unless `deepest` is positive and finite and `count` at least 1.

    Examples
    --------
    >>> default_depths([0.5], 1.0, count=2)
    Depths(depths=[0.0, 0.25, 0.5, 0.5, 1.0], sides=['+', '+', '-', '+', '+'])
    """
    if not (0.0 < deepest < np.inf and count >= 1):
        raise DescriptionError("default_depths.deepest", (deepest, count), "be positive", unit="m")
    bottoms = np.cumsum(np.asarray(thickness, dtype=np.float64))
    bottoms = bottoms[bottoms <= deepest]
    graded = deepest * (np.arange(count + 1.0) / count) ** 2
    apart = [float(z) for z in graded if not np.any(np.abs(bottoms - z) <= 1e-9 * bottoms)]
    planes: list[tuple[float, bool]] = [(z, True) for z in apart]
    planes += [(float(z), below) for z in bottoms for below in (False, True)]
    planes.sort()
    return Depths([z for z, _ in planes], ["+" if below else "-" for _, below in planes])
