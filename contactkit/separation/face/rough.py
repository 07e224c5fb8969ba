"""Full film on an even face with fine roughness, by the flow factors of a patch at each gap."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np
from attrs import evolve

from ...lubrication.reynolds.rough_flow import patch_factors
from ...lubrication.reynolds.shape_factor import face_damping, unchecked_rough_damping
from ...lubrication.reynolds.validity import roughness_number
from ...validity import ValidityNumber
from .film import FARTHER, NEARER, FaceFilm, table_points

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ...scene.surfaces import FineRoughness
    from .shape import FaceShape

    Map = NDArray[np.floating[Any]]

__all__ = ["rough_film"]

# Rms heights down to which the table goes: below, a motion meets contacts, which block the flow.
_THINNEST = 3.0
_FINEST = 0.1  # of the face, that a patch may measure: the factors are those of an endless face


def rough_film(smooth: FaceFilm, shape: FaceShape, gaps: tuple[float, float]) -> FaceFilm:
    """Film on the face of a smooth one, over the gap between the mean planes.

    Parameters
    ----------
    smooth : FaceFilm
        The film without the roughness.
    shape : FaceShape
        Its shape, with the roughness.
    gaps : (float, float)
        Smallest and largest gap of the scene [m].

    Raises
    ------
    DescriptionError
        If the patch is not resolved, or contacts block it at the smallest gap.

    Examples
    --------
    >>> import contactkit as ck
    >>> from contactkit.scene.surfaces import FineRoughness
    >>> from contactkit.separation.face.film import face_film
    >>> from contactkit.separation.face.shape import shape_of
    >>> ridges = FineRoughness(surface=ck.Wave(amplitude=2e-6, wavelength=2e-5), width=2e-5)
    >>> rough = ck.Flat(radius=1e-3, roughness=ridges)
    >>> made = face_film(shape_of(ck.Interface(upper=rough)), (5e-6, 2e-5), 1e-2)
    >>> round(made.coefficient(5e-6) / (1.5 * math.pi * 1e-3**4 / 5e-6**3), 2)
    1.11
    """
    rough = shape.roughness
    assert rough is not None
    heights, pixel_size = rough.patch()
    grid = smooth.gridded(gaps[0])
    rms = float(heights.std())
    low = min(gaps[0], max(NEARER * gaps[0], _THINNEST * rms))
    high = FARTHER * gaps[1]
    law = unchecked_rough_damping(
        grid.face, (low, high), heights, pixel_size, points=table_points(low, high)
    )
    # The law of the grid, by what the smooth one misses of its exact form where that is known.
    gridded = face_damping(grid.face).coefficient(gaps[0])
    scale = 1.0 if smooth.cells else smooth.coefficient(gaps[0]) / gridded
    law = evolve(
        law,
        coefficients=tuple(scale * one for one in law.coefficients),
        onsets=tuple(scale * one for one in law.onsets),
    )
    numbers = _numbers(rough, shape, gaps[0], heights, pixel_size)
    cells = smooth.cells or max(grid.face.shape)
    return FaceFilm(shape, law, 0.0, smooth.error, cells, smooth.rtol, numbers)


def _numbers(
    rough: FineRoughness,
    shape: FaceShape,
    gap: float,
    heights: Map,
    pixel_size: tuple[float, float],
) -> tuple[ValidityNumber, ...]:
    """Whether flow factors say what the roughness does, at the smallest gap [m]."""
    tensor = patch_factors(gap - heights, pixel_size, 0.0, None).conductivity
    every_second = (2.0 * pixel_size[0], 2.0 * pixel_size[1])
    coarse = patch_factors(gap - heights[::2, ::2], every_second, 0.0, None).conductivity
    change = float(np.abs(np.diag(coarse) / np.diag(tensor) - 1.0).max())
    mean = math.sqrt(float(tensor[0, 0] * tensor[1, 1]))
    left, right, lowest, highest = shape.outline.bounds
    across = max(one * n for one, n in zip(pixel_size, heights.shape, strict=True))
    return (
        roughness_number(gap, float(heights.std())),
        ValidityNumber(
            name="patch of roughness over the face",
            value=across / min(right - left, highest - lowest),
            high=_FINEST,
            detail="flow factors are of roughness far finer than the face; take a smaller patch, "
            "or a relief",
            source="homogenisation: the first term left out is of this order",
        ),
        ValidityNumber(
            name="error of the flow factors",
            value=change,
            high=0.1,
            detail="relative, from every second pixel of the patch; a third of it is left, with "
            "more pixels less",
            source="finite volumes of second order",
        ),
        ValidityNumber(
            name="cross flow of the roughness",
            value=abs(float(tensor[0, 1])) / mean,
            high=0.1,
            detail="flow across the pressure gradient is left out; lay the axes along the grooves, "
            "or take a larger patch",
            source="off-diagonal over the mean entry of the conductivity",
        ),
    )
