"""Smooth surfaces (flat, sphere, paraboloid, wave), and the base class of all surfaces.

A height [m] is measured out of its own body: a peak is positive.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import TYPE_CHECKING, ClassVar, NamedTuple

from attrs import field, frozen

from ..errors import DescriptionError, PlanError
from ..units import si
from ..validators import Described, optional, positive
from .window import Grid

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Map = NDArray[np.float64]
    Mask = NDArray[np.bool_]

__all__ = [
    "Flat",
    "OwnGrid",
    "Paraboloid",
    "ShortWave",
    "Sphere",
    "Surface",
    "Wave",
    "realise",
    "union_of",
]


OwnGrid = tuple[tuple[int, int], tuple[float, float]]
"""Pixels (ny, nx) of a height map, and their size (dy, dx) [m]."""


class ShortWave(NamedTuple):
    """A wave that a surface states: the field with its length [m], and the pixel along it [m]."""

    field: str
    length: float
    pixel: float


@frozen(kw_only=True)
class Surface(Described):
    """The surface of a body, smooth or rough. Its kind is its name in files, under ``shape``.

    A surface of one's own needs `kind` and `heights_on`; what else it states, such as its shortest
    wave, is what plans and results then check.

    Examples
    --------
    >>> @frozen(kw_only=True)
    ... class Wedge(Surface):
    ...     kind = "wedge"
    ...     slope: float = field(validator=positive, metadata=si("-"))
    ...
    ...     def heights_on(self, grid):
    ...         y, x = grid.from_centre()
    ...         return -self.slope * abs(x) + 0.0 * y
    >>> realise(Wedge(slope=0.1), Grid((2, 4), (1e-8, 1e-8), False)).shape
    (2, 4)
    """

    family: ClassVar[str] = "surface"
    kind: ClassVar[str]
    bounds_film: ClassVar[bool] = False
    """Whether the film between two such surfaces is known: that between flats and spheres is."""

    @property
    def curvature(self) -> float | None:
        """Curvature at the apex [1/m], positive towards the gap; None without one round apex."""
        return None

    @property
    def body_curvature(self) -> float:
        """Curvature of the round body under the roughness [1/m]; 0 without one."""
        return self.curvature or 0.0

    @property
    def is_flat(self) -> bool:
        """Whether it is a plane, with or without a rim."""
        return False

    @property
    def rim_radius(self) -> float:
        """Radius of the rim that bounds it [m]; inf without one."""
        return math.inf

    @property
    def own_grids(self) -> frozenset[OwnGrid]:
        """Grids of the height maps in it; a recipe takes any grid."""
        return frozenset()

    @property
    def isolated_maps(self) -> tuple[str, ...]:
        """Names of the height maps in it that state that they do not repeat beyond their edges."""
        return ()

    @property
    def holes(self) -> Mask | None:
        """Pixels (ny, nx) that carry no load; None for a surface without holes."""
        return None

    def shortest_waves(self, grid: Grid) -> tuple[ShortWave, ...]:
        """Shortest waves that it states, each beside the pixel along it; none of a height map."""
        return ()

    def check_fit(self, grid: Grid) -> None:
        """Refuse a grid that it does not fit, before any heights are made.

        Raises
        ------
        DescriptionError
            Naming the field that does not fit.
        """

    def heights_on(self, grid: Grid) -> Map:
        """Heights [m] on a grid, (ny, nx), peaks positive; by `realise`, which checks them.

        Raises
        ------
        PlanError
            If the surface has none.
        """
        name = type(self).__name__
        raise PlanError(
            f"a contact needs the heights of its surfaces, and {name} has none: give the class a "
            f"method heights_on(grid) that returns them [m], (ny, nx), or use Measured or Heights"
        )


def realise(surface: Surface, grid: Grid) -> Map:
    """Heights [m] of a surface on a grid, (ny, nx), peaks positive.

    Raises
    ------
    DescriptionError
        If the grid is too coarse for the shortest wave of the surface, a wave does not fit a
        periodic window, a sphere does not reach over it, or a surface of one's own gives no
        heights on it.

    Examples
    --------
    >>> from contactkit.scene.rough_surfaces import GaussianRoughness
    >>> grid = Grid((64, 64), (1e-8, 1e-8), True)
    >>> heights = realise(GaussianRoughness(rms=1e-9, correlation_length=1e-7, cutoff=4e-8), grid)
    >>> heights.shape
    (64, 64)
    """
    import numpy as np

    for wave in surface.shortest_waves(grid):
        if wave.length < 2.0 * wave.pixel * (1.0 - 1e-12):
            raise DescriptionError(
                wave.field,
                wave.length,
                f"be at least two pixels, {2.0 * wave.pixel:g} m",
                unit="m",
                hint="a finer Accuracy.grid, or a longer wave",
            )
    surface.check_fit(grid)
    made: Map = np.asarray(surface.heights_on(grid))
    if made.shape != grid.shape or made.dtype.kind != "f" or not np.isfinite(made).all():
        raise DescriptionError(
            f"{type(surface).__name__}.heights_on(grid)",
            f"an array of shape {made.shape} and {made.dtype}",
            f"be finite heights as floats, (ny, nx) = {grid.shape}",
            unit="m",
        )
    return made


def union_of(holes: Iterable[Mask | None]) -> Mask | None:
    """Pixels of any of some masks; None if there is no mask."""
    found = [one for one in holes if one is not None]
    union: Mask | None = sum(found[1:], start=found[0]) if found else None  # of flags: or
    return union


@frozen(kw_only=True)
class Flat(Surface):
    """A flat face, round and bounded, or without end.

    Parameters
    ----------
    radius : float, optional
        Radius of the face [m]; the film cannot spread beyond it. None: no rim within reach.

    Examples
    --------
    >>> Flat(radius=3.175e-3).curvature
    0.0
    """

    kind: ClassVar[str] = "flat"
    bounds_film: ClassVar[bool] = True

    radius: float | None = field(default=None, validator=optional(positive), metadata=si("m"))

    @property
    def curvature(self) -> float:
        """See `Surface.curvature`."""
        return 0.0

    @property
    def is_flat(self) -> bool:
        """See `Surface.is_flat`."""
        return True

    @property
    def rim_radius(self) -> float:
        """See `Surface.rim_radius`."""
        return math.inf if self.radius is None else self.radius

    def heights_on(self, grid: Grid) -> Map:
        """See `Surface.heights_on`."""
        import numpy as np

        return np.zeros(grid.shape)


@frozen(kw_only=True)
class Sphere(Surface):
    """A sphere, or a body whose apex is round.

    Parameters
    ----------
    radius : float
        Radius of curvature at the apex [m].

    Examples
    --------
    >>> Sphere(radius=100e-9).curvature
    10000000.0
    """

    kind: ClassVar[str] = "sphere"
    bounds_film: ClassVar[bool] = True

    radius: float = field(validator=positive, metadata=si("m"))

    @property
    def curvature(self) -> float:
        """See `Surface.curvature`."""
        return 1.0 / self.radius

    def check_fit(self, grid: Grid) -> None:
        """See `Surface.check_fit`: it must reach over the window."""
        (ny, nx), (dy, dx) = grid.shape, grid.pixel_size
        reach = 0.5 * math.hypot(ny * dy, nx * dx)
        if reach >= self.radius:
            raise DescriptionError(
                "Sphere.radius",
                self.radius,
                f"exceed half the diagonal of the window, {reach:g} m",
                unit="m",
                hint="use a smaller window, or Paraboloid",
            )

    def heights_on(self, grid: Grid) -> Map:
        """See `Surface.heights_on`."""
        from ..roughness.elementary import sphere

        return sphere(grid.shape, grid.pixel_size, self.radius)


@frozen(kw_only=True)
class Paraboloid(Surface):
    """The body of Hertz's theory, ``-x^2/(2 R_x) - y^2/(2 R_y)``.

    Parameters
    ----------
    radius : float
        Radius of curvature at the apex along x [m].
    radius_y : float, optional
        The same along y [m]; None: as along x.
    """

    kind: ClassVar[str] = "paraboloid"

    radius: float = field(validator=positive, metadata=si("m"))
    radius_y: float | None = field(default=None, validator=optional(positive), metadata=si("m"))

    @property
    def curvature(self) -> float | None:
        """See `Surface.curvature`."""
        is_round = self.radius_y in (None, self.radius)
        return 1.0 / self.radius if is_round else None

    def heights_on(self, grid: Grid) -> Map:
        """See `Surface.heights_on`."""
        from ..roughness.elementary import paraboloid

        return paraboloid(grid.shape, grid.pixel_size, self.radius, self.radius_y)


@frozen(kw_only=True)
class Wave(Surface):
    """A wavy surface ``amplitude*cos(2 pi x/wavelength)``, or the product of two such waves.

    Parameters
    ----------
    amplitude : float
        Half of the height between trough and crest [m].
    wavelength : float
        Length of the wave along x [m].
    wavelength_y : float, optional
        Length of the wave along y [m]; the heights are then the product of both cosines.
    """

    kind: ClassVar[str] = "wave"

    amplitude: float = field(validator=positive, metadata=si("m"))
    wavelength: float = field(validator=positive, metadata=si("m"))
    wavelength_y: float | None = field(default=None, validator=optional(positive), metadata=si("m"))

    def shortest_waves(self, grid: Grid) -> tuple[ShortWave, ...]:
        """See `Surface.shortest_waves`."""
        dy, dx = grid.pixel_size
        along_x = ShortWave("Wave.wavelength", self.wavelength, dx)
        if self.wavelength_y is None:
            return (along_x,)
        return (along_x, ShortWave("Wave.wavelength_y", self.wavelength_y, dy))

    def check_fit(self, grid: Grid) -> None:
        """See `Surface.check_fit`: a periodic window holds whole waves."""
        if not grid.edges:
            return
        (ny, nx), (dy, dx) = grid.shape, grid.pixel_size
        lengths = (
            ("wavelength", self.wavelength, nx * dx, "x"),
            ("wavelength_y", self.wavelength_y, ny * dy, "y"),
        )
        for name, length, size, axis in lengths:
            if length is None or grid.along not in (None, axis):
                continue
            if abs(size / length - round(size / length)) > 1e-9 * size / length:
                raise DescriptionError(
                    f"Wave.{name}",
                    length,
                    f"fit a whole number of times into the periodic window of {size:g} m",
                    unit="m",
                )

    def heights_on(self, grid: Grid) -> Map:
        """See `Surface.heights_on`."""
        from ..roughness.elementary import wave

        lengths = (self.wavelength, self.wavelength_y)
        return wave(grid.shape, grid.pixel_size, self.amplitude, *lengths)
