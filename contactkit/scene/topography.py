"""Topography objects of other packages as surfaces, by what they offer: no package is imported.

A topography has ``heights()`` indexed [x, y], ``physical_sizes`` (along x, along y), the ``unit``
of both, and ``is_periodic``, as those of SurfaceTopography have.
"""

from __future__ import annotations

from typing import Any, Protocol

from ..errors import DescriptionError
from ..units import parse_unit
from .rough_surfaces import Heights

__all__ = ["Topography", "as_surface", "is_topography"]


class Topography(Protocol):
    """A map of heights of another package."""

    @property
    def physical_sizes(self) -> Any:
        """Sizes along x and along y, in its unit."""

    @property
    def unit(self) -> Any:
        """Unit of lengths and heights, such as "nm"."""

    @property
    def is_periodic(self) -> Any:
        """Whether the map repeats beyond its edges."""

    def heights(self) -> Any:
        """Heights [x, y], in its unit."""


def is_topography(value: object) -> bool:
    """Whether an object offers what a topography does."""
    return callable(getattr(value, "heights", None)) and hasattr(value, "physical_sizes")


def as_surface(value: Any) -> Any:
    """Convert a topography to `Heights`, with its flag of periodicity; leave all else alone.

    Points that were not measured are holes, which carry no load.

    Raises
    ------
    DescriptionError
        If it is a line scan, or has no size or unit.
    """
    if not is_topography(value):
        return value
    import numpy as np

    given = np.ma.asarray(value.heights())
    sizes = value.physical_sizes
    if given.ndim != 2 or sizes is None or len(sizes) != 2:
        raise DescriptionError(
            "topography.physical_sizes",
            sizes,
            f"be two lengths, of heights [x, y]; those have the shape {given.shape}",
            hint="a profile along a line is not a surface",
        )
    factor = _metres(getattr(value, "unit", None))
    (nx, ny), (width, height) = given.shape, sizes
    flag = getattr(value, "is_periodic", None)
    return Heights(
        heights=factor * given.astype(float).T,
        pixel_size=(factor * float(height) / ny, factor * float(width) / nx),
        is_periodic=None if flag is None else bool(flag),
    )


def _metres(unit: object) -> float:
    """Length of the unit of a topography [m]."""
    if isinstance(unit, str):
        found = parse_unit(unit.replace("\N{GREEK SMALL LETTER MU}", "\N{MICRO SIGN}"))
        if dict(found.dimension) == {"m": 1}:
            return found.factor
    raise DescriptionError(
        "topography.unit", unit, "be a unit of length", hint="give the topography one, such as 'nm'"
    )
