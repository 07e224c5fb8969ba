"""Heights of surfaces on a grid, and the grid of a scene."""

from __future__ import annotations

from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING

from ..accuracy import Accuracy
from ..errors import DescriptionError
from ..scene.rough_surfaces import (
    CombinedSurface,
    GaussianRoughness,
    Heights,
    Measured,
    SelfAffineRoughness,
)
from ..scene.scenes import ContactScene
from ..scene.surfaces import Flat, Paraboloid, Sphere, Surface, Wave
from ..scene.window import Grid

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Map = NDArray[np.float64]

__all__ = ["combined_heights", "grid_of", "realise"]


def grid_of(scene: ContactScene, accuracy: Accuracy | None = None) -> Grid:
    """Grid of a scene: that of a measured surface, or `Accuracy.grid` over the window.

    Raises
    ------
    DescriptionError
        If no size is given, or two surfaces or a window bring different ones.
    """
    accuracy = accuracy or Accuracy.standard
    window = scene.window
    brought = {
        grid
        for body in (scene.interface.lower, scene.interface.upper)
        for grid in _own_grids(body.surface)
    }
    if len(brought) > 1:
        raise DescriptionError(
            "Interface",
            sorted(brought),
            "have surfaces of one grid, (shape, pixel size [m])",
            hint="resample one of the maps",
        )
    if brought:
        shape, pixel = brought.pop()
        _agree(window.width, shape[1] * pixel[1], "Window.width")
        _agree(window.height, shape[0] * pixel[0], "Window.height")
        if accuracy.grid is not None and accuracy.shape != shape:
            raise DescriptionError(
                "Accuracy.grid",
                accuracy.grid,
                f"be that of the height map, {shape}, or left out",
            )
        return Grid(shape, pixel, window.periodic)
    if window.width is None:
        raise DescriptionError(
            "Window.width", None, "be given where no surface is measured", unit="m"
        )
    ny, nx = accuracy.shape
    height = window.height if window.height is not None else window.width
    return Grid((ny, nx), (height / ny, window.width / nx), window.periodic)


def _own_grids(surface: Surface) -> list[tuple[tuple[int, int], tuple[float, float]]]:
    if isinstance(surface, CombinedSurface):
        return [grid for part in surface.parts for grid in _own_grids(part)]
    if isinstance(surface, Measured):
        surface = _measured(surface)
    if isinstance(surface, Heights):
        size = surface.pixel_size
        ny, nx = surface.heights.shape
        return [((ny, nx), size if isinstance(size, tuple) else (size, size))]
    return []


def _agree(given: float | None, own: float, field: str) -> None:
    if given is not None and abs(given / own - 1.0) > 1e-9:
        raise DescriptionError(
            field, given, f"be that of the height map, {own:g}, or left out", unit="m"
        )


def _measured(surface: Measured) -> Heights:
    """Read a map once for as long as its file does not change."""
    path = Path(surface.path)
    return _read(surface, path.stat().st_mtime_ns if path.exists() else 0)


@lru_cache(maxsize=4)
def _read(surface: Measured, changed: int) -> Heights:
    from ..roughness.height_maps import detrended, read_height_map

    found = read_height_map(
        surface.path,
        pixel_size=surface.pixel_size,
        unit=surface.unit,
        checksum=surface.checksum,
    )
    heights = detrended(found.heights, surface.detrend)
    return Heights(heights=-heights if surface.flipped else heights, pixel_size=found.pixel_size)


def combined_heights(scene: ContactScene, grid: Grid) -> Map:
    """Sum of the heights of both bodies [m], (ny, nx)."""
    lower, upper = scene.interface.lower.surface, scene.interface.upper.surface
    return realise(lower, grid) + realise(upper, grid)


def realise(surface: Surface, grid: Grid) -> Map:
    """Heights [m] of a surface on a grid, (ny, nx), peaks positive.

    Raises
    ------
    DescriptionError
        If the grid is too coarse for the shortest wave of the surface, a wave does not fit a
        periodic window, or a sphere does not reach over it.

    Examples
    --------
    >>> grid = Grid((64, 64), (1e-8, 1e-8), True)
    >>> heights = realise(GaussianRoughness(rms=1e-9, correlation_length=1e-7, cutoff=4e-8), grid)
    >>> heights.shape
    (64, 64)
    """
    import numpy as np

    if isinstance(surface, CombinedSurface):
        total = np.zeros(grid.shape)
        for part in surface.parts:
            total += realise(part, grid)
        return total
    if isinstance(surface, Measured):
        surface = _measured(surface)
    if isinstance(surface, Heights):
        return np.array(surface.heights)
    if isinstance(surface, Flat):
        return np.zeros(grid.shape)
    if isinstance(surface, Paraboloid | Sphere):
        return _round(surface, grid)
    if isinstance(surface, Wave):
        return _wave(surface, grid)
    if isinstance(surface, GaussianRoughness | SelfAffineRoughness):
        return _rough(surface, grid)
    raise TypeError(f"{type(surface).__name__} has no heights on a grid")


def _round(surface: Paraboloid | Sphere, grid: Grid) -> Map:
    from ..roughness import elementary

    if isinstance(surface, Paraboloid):
        second = surface.radius_y if surface.radius_y is not None else surface.radius
        return elementary.paraboloid(grid.shape, grid.pixel_size, surface.radius, second)
    reach = (
        0.5
        * float(
            (grid.shape[0] * grid.pixel_size[0]) ** 2 + (grid.shape[1] * grid.pixel_size[1]) ** 2
        )
        ** 0.5
    )
    if reach >= surface.radius:
        raise DescriptionError(
            "Sphere.radius",
            surface.radius,
            f"exceed half the diagonal of the window, {reach:g} m",
            unit="m",
            hint="use a smaller window, or Paraboloid",
        )
    return elementary.sphere(grid.shape, grid.pixel_size, surface.radius)


def _wave(surface: Wave, grid: Grid) -> Map:
    from ..roughness import elementary

    sizes = (grid.shape[1] * grid.pixel_size[1], grid.shape[0] * grid.pixel_size[0])
    lengths = (surface.wavelength, surface.wavelength_y)
    names, pixels = ("wavelength", "wavelength_y"), grid.pixel_size[::-1]
    for name, size, length, pixel in zip(names, sizes, lengths, pixels, strict=True):
        if length is None:
            continue
        _resolved(f"Wave.{name}", length, pixel)
        if grid.periodic and abs(size / length - round(size / length)) > 1e-9 * size / length:
            raise DescriptionError(
                f"Wave.{name}",
                length,
                f"fit a whole number of times into the periodic window of {size:g} m",
                unit="m",
            )
    return elementary.wave(grid.shape, grid.pixel_size, surface.amplitude, *lengths)


def _rough(surface: GaussianRoughness | SelfAffineRoughness, grid: Grid) -> Map:
    from ..roughness import random_surfaces

    _resolved(f"{type(surface).__name__}.cutoff", surface.cutoff, max(grid.pixel_size))
    if isinstance(surface, GaussianRoughness):
        return random_surfaces.gaussian_exponential(
            grid.shape,
            grid.pixel_size,
            surface.rms,
            surface.correlation_length,
            surface.cutoff,
            surface.seed,
        )
    return random_surfaces.self_affine(
        grid.shape,
        grid.pixel_size,
        surface.rms,
        random_surfaces.SelfAffineSpectrum(surface.hurst, surface.rolloff, surface.cutoff),
        surface.seed,
    )


def _resolved(name: str, length: float, pixel: float) -> None:
    if length < 2.0 * pixel * (1.0 - 1e-12):
        raise DescriptionError(
            name,
            length,
            f"be at least two pixels, {2.0 * pixel:g} m",
            unit="m",
            hint="a finer Accuracy.grid, or a longer wave",
        )
