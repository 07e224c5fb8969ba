"""Heights of surfaces on a grid, and the grid of a scene."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple
from weakref import WeakKeyDictionary

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
from ..scene.window import Axis, Grid

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Map = NDArray[np.float64]

__all__ = [
    "ShortWave",
    "combined_heights",
    "grid_of",
    "holes_of",
    "realise",
    "short_waves",
]


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
    once = [one for body in scene.interface.bodies for one in _isolated(body.surface)]
    if periodic and once:
        raise DescriptionError(
            "Window.periodic",
            periodic,
            f"be False or left out: {' and '.join(once)} states that it does not repeat",
            hint="if it does, say so there: is_periodic=True",
        )
    return (False, periodic) if isinstance(periodic, str) else (not once, None)


def _isolated(surface: Surface) -> list[str]:
    """Names of the maps in a surface that state that they do not repeat."""
    if isinstance(surface, CombinedSurface):
        return [name for part in surface.parts for name in _isolated(part)]
    if isinstance(surface, Measured):
        return [surface.path] if _measured(surface).is_periodic is False else []
    return ["Heights"] if isinstance(surface, Heights) and surface.is_periodic is False else []


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
    """Read a map once for as long as a scene has it and its file does not change."""
    path = Path(surface.path)
    changed = path.stat().st_mtime_ns if path.exists() else 0
    known = _MAPS.get(surface)
    if known is None or known[0] != changed:
        known = _MAPS[surface] = changed, _read(surface)
    return known[1]


# A map of 4096 x 4096 pixels takes 134 MB: it goes with the last scene that has the surface.
_MAPS: WeakKeyDictionary[Measured, tuple[int, Heights]] = WeakKeyDictionary()


def _read(surface: Measured) -> Heights:
    from ..roughness.height_maps import detrended, read_height_map

    found = read_height_map(
        surface.path,
        pixel_size=surface.pixel_size,
        unit=surface.unit,
        checksum=surface.checksum,
    )
    heights = detrended(found.heights, surface.detrend)
    return Heights(
        heights=-heights if surface.flipped else heights,
        pixel_size=found.pixel_size,
        is_periodic=found.is_periodic if surface.is_periodic is None else surface.is_periodic,
    )


class ShortWave(NamedTuple):
    """A wave that a surface states: the field with its length [m], and the pixel along it [m]."""

    field: str
    length: float
    pixel: float


def short_waves(surface: Surface, grid: Grid) -> tuple[ShortWave, ...]:
    """Shortest waves that a surface states, those of its parts each; none of a height map."""
    if isinstance(surface, CombinedSurface):
        return tuple(wave for part in surface.parts for wave in short_waves(part, grid))
    dy, dx = grid.pixel_size
    if isinstance(surface, GaussianRoughness | SelfAffineRoughness):
        name = f"{type(surface).__name__}.cutoff"
        return (ShortWave(name, surface.cutoff, max(dy, dx)),)
    if isinstance(surface, Wave):
        along_x = ShortWave("Wave.wavelength", surface.wavelength, dx)
        if surface.wavelength_y is None:
            return (along_x,)
        return (along_x, ShortWave("Wave.wavelength_y", surface.wavelength_y, dy))
    return ()


def _check_surface(surface: Surface, grid: Grid) -> None:
    """Refuse a surface that does not fit the grid, before any heights are made."""
    for wave in short_waves(surface, grid):
        if wave.length < 2.0 * wave.pixel * (1.0 - 1e-12):
            raise DescriptionError(
                wave.field,
                wave.length,
                f"be at least two pixels, {2.0 * wave.pixel:g} m",
                unit="m",
                hint="a finer Accuracy.grid, or a longer wave",
            )
    if isinstance(surface, Wave) and grid.edges:
        _check_period(surface, grid)
    if isinstance(surface, Sphere):
        _check_reach(surface, grid)


def _check_period(surface: Wave, grid: Grid) -> None:
    (ny, nx), (dy, dx) = grid.shape, grid.pixel_size
    lengths = (
        ("wavelength", surface.wavelength, nx * dx, "x"),
        ("wavelength_y", surface.wavelength_y, ny * dy, "y"),
    )
    for name, length, size, axis in lengths:
        if grid.along not in (None, axis):
            continue
        if length is not None and abs(size / length - round(size / length)) > 1e-9 * size / length:
            raise DescriptionError(
                f"Wave.{name}",
                length,
                f"fit a whole number of times into the periodic window of {size:g} m",
                unit="m",
            )


def _check_reach(surface: Sphere, grid: Grid) -> None:
    (ny, nx), (dy, dx) = grid.shape, grid.pixel_size
    reach = 0.5 * math.hypot(ny * dy, nx * dx)
    if reach >= surface.radius:
        raise DescriptionError(
            "Sphere.radius",
            surface.radius,
            f"exceed half the diagonal of the window, {reach:g} m",
            unit="m",
            hint="use a smaller window, or Paraboloid",
        )


def combined_heights(scene: ContactScene, grid: Grid) -> Map:
    """Sum of the heights of both bodies [m], (ny, nx)."""
    lower, upper = scene.interface.lower.surface, scene.interface.upper.surface
    return realise(lower, grid) + realise(upper, grid)


def holes_of(scene: ContactScene) -> NDArray[np.bool_] | None:
    """Pixels where a body has a hole, (ny, nx): they carry no load. None if there is none."""
    found = [
        holes
        for body in (scene.interface.lower, scene.interface.upper)
        for holes in _own_holes(body.surface)
    ]
    if not found:
        return None
    union: NDArray[np.bool_] = sum(found[1:], start=found[0])  # of flags: or
    if union.all():
        raise DescriptionError(
            "Interface", "a hole in every pixel", "have pixels where both bodies are measured"
        )
    return union


def _own_holes(surface: Surface) -> list[NDArray[np.bool_]]:
    if isinstance(surface, CombinedSurface):
        return [holes for part in surface.parts for holes in _own_holes(part)]
    return [surface.holes] if isinstance(surface, Heights) and surface.holes is not None else []


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

    _check_surface(surface, grid)
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
    return elementary.sphere(grid.shape, grid.pixel_size, surface.radius)


def _wave(surface: Wave, grid: Grid) -> Map:
    from ..roughness import elementary

    lengths = (surface.wavelength, surface.wavelength_y)
    return elementary.wave(grid.shape, grid.pixel_size, surface.amplitude, *lengths)


def _rough(surface: GaussianRoughness | SelfAffineRoughness, grid: Grid) -> Map:
    from ..roughness import random_surfaces

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
