"""Damping law of an even face with fine roughness, by the flow factors of a patch at each gap."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np
from attrs import evolve

from ...lubrication.reynolds.damping import TabulatedDamping
from ...lubrication.reynolds.rough_flow import patch_factors
from ...lubrication.reynolds.shape_factor import face_damping, unchecked_rough_damping
from ...lubrication.reynolds.validity import roughness_number
from ...validity import ValidityNumber

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ...scene.planforms import Planform
    from .grid import FaceGrid

    Map = NDArray[np.floating[Any]]
    Patch = tuple[Map, tuple[float, float]]

__all__ = ["rough_law", "rough_numbers"]

_FINEST = 0.1  # of the face, that a patch may measure: the factors are those of an endless face


def rough_law(
    grid: FaceGrid, patch: Patch, reach: tuple[float, float], points: int, exact: float | None
) -> TabulatedDamping:
    """Damping over the gap between the mean planes.

    Parameters
    ----------
    grid : FaceGrid
        The even face on a grid.
    patch : (ndarray (ny, nx), (float, float))
        Heights of the patch [m], and its pixel [m].
    reach : (float, float)
        Smallest and largest gap of the table [m].
    points : int
        Gaps of the table.
    exact : float, optional
        Damping over viscosity [m] of the smooth face at the smallest gap, where it is known in
        closed form: the law has the ratio to the smooth one of the grid.

    Raises
    ------
    DescriptionError
        If contacts block the patch at a gap of the table.

    Examples
    --------
    >>> import contactkit as ck
    >>> from contactkit.separation.face.film import face_film
    >>> from contactkit.separation.face.shape import shape_of
    >>> wave = ck.Wave(amplitude=2e-6, wavelength=2e-5)
    >>> ridges = ck.FineRoughness(surface=wave, width=2e-5, pixels=16)
    >>> rough = ck.Flat(radius=1e-3, roughness=ridges)
    >>> made = face_film(shape_of(ck.Interface(upper=rough)), (5e-6, 2e-5), 1e-2)
    >>> round(made.coefficient(5e-6) / (1.5 * math.pi * 1e-3**4 / 5e-6**3), 2)
    1.09
    """
    heights, pixel_size = patch
    law = unchecked_rough_damping(grid.face, reach, heights, pixel_size, points=points)
    if exact is None:
        return law
    scale = exact / face_damping(grid.face).coefficient(reach[0])
    return evolve(
        law,
        coefficients=tuple(scale * one for one in law.coefficients),
        onsets=tuple(scale * one for one in law.onsets),
    )


def rough_numbers(outline: Planform, patch: Patch, gap: float) -> tuple[ValidityNumber, ...]:
    """Whether flow factors say what the roughness does, at the smallest gap [m]."""
    heights, pixel_size = patch
    tensor = patch_factors(gap - heights, pixel_size, 0.0, None).conductivity
    every_second = (2.0 * pixel_size[0], 2.0 * pixel_size[1])
    coarse = patch_factors(gap - heights[::2, ::2], every_second, 0.0, None).conductivity
    change = float(np.abs(np.diag(coarse) / np.diag(tensor) - 1.0).max())
    mean = math.sqrt(float(tensor[0, 0] * tensor[1, 1]))
    left, right, lowest, highest = outline.bounds
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
