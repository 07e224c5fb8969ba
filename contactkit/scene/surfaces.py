"""Smooth surfaces (flat, sphere, paraboloid, wave), and the base class of all surfaces.

A height [m] is measured out of its own body: a peak is positive.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable
from typing import TYPE_CHECKING, Any, ClassVar, NamedTuple

from attrs import Attribute, field, frozen

from ..errors import DescriptionError, PlanError
from ..units import si
from ..validators import (
    Described,
    as_pair,
    as_tuple,
    as_whole,
    count,
    finite,
    optional,
    part,
    positive,
    refuse,
)
from .faces import FaceHole, Recess, SealedHole, Vent
from .planforms import Disc, Planform
from .window import Grid

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Map = NDArray[np.float64]
    Mask = NDArray[np.bool_]

__all__ = [
    "FineRoughness",
    "Flat",
    "OwnGrid",
    "Paraboloid",
    "ShortWave",
    "Sphere",
    "Surface",
    "Wave",
    "one_grid",
    "realise",
    "union_of",
    "whole_heights",
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
    """Whether the film between such surfaces is known: that of flats and of round apexes is."""

    @property
    def curvature(self) -> float | None:
        """Curvature at the apex [1/m], positive towards the gap; None without one round apex."""
        return None

    @property
    def body_curvature(self) -> float:
        """Curvature of the round body under the roughness [1/m]; 0 without one."""
        return self.curvature or 0.0

    @property
    def own_grids(self) -> frozenset[OwnGrid]:
        """Grids of the height maps in it; a recipe takes any grid."""
        return frozenset()

    @property
    def isolated_maps(self) -> tuple[str, ...]:
        """Names of the height maps in it that state that they do not repeat beyond their edges."""
        return ()

    @property
    def periodic_maps(self) -> tuple[str, ...]:
        """Names of the height maps in it that state that they repeat beyond their edges."""
        return ()

    @property
    def void_pixels(self) -> Mask | None:
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

        A map that the surface keeps is returned read-only; callers do not write into any.

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


def _slopes(owner: object, attribute: Attribute[Any], value: Any) -> None:
    if not isinstance(value, tuple) or len(value) != 2:
        raise refuse(owner, attribute, value, "be a pair of slopes (x, y)")
    for slope in value:
        finite(owner, attribute, slope)


def _curved(owner: object, attribute: Attribute[Any], value: Any) -> None:
    finite(owner, attribute, value)
    if value == 0.0:
        raise refuse(owner, attribute, value, "not be zero", "leave it out for an even face")


def _relief(owner: object, attribute: Attribute[Any], value: Any) -> None:
    part(Surface)(owner, attribute, value)
    if isinstance(value, Flat):
        cure = "a face is flat without one; its rim, tilt and recesses are fields of its own"
        raise refuse(owner, attribute, value, "be a surface with heights", cure)


@frozen(kw_only=True)
class FineRoughness(Described):
    """Roughness of a face far finer than the face: a patch that repeats, known by its flow factors.

    The film then has the gap between the mean planes, and a conductivity along each axis, that of
    the patch at this gap (homogenisation). Coarser roughness is a `relief`.

    Parameters
    ----------
    surface : Surface
        Any surface with heights, those of both faces together.
    width : float, optional
        Side of the square patch that repeats [m]; some ten correlation lengths of it say what it
        does. None: a measured surface, which has its own.
    pixels : int
        Pixels along each side of a patch that is no measured one; 8 to its shortest wave.

    Examples
    --------
    >>> ridges = FineRoughness(surface=Wave(amplitude=1e-6, wavelength=2e-5), width=2e-5, pixels=8)
    >>> heights, pixel_size = ridges.patch()
    >>> heights.shape, pixel_size
    ((8, 8), (2.5e-06, 2.5e-06))
    """

    surface: Surface = field(validator=_relief)
    width: float | None = field(default=None, validator=optional(positive), metadata=si("m"))
    pixels: int = field(default=64, converter=as_whole, validator=count, metadata=si("-"))

    def patch(self) -> tuple[Map, tuple[float, float]]:
        """Heights of the patch [m] about their mean, (ny, nx), and its pixel (dy, dx) [m].

        Raises
        ------
        DescriptionError
            If the width is missing, is given beside that of a measured surface, or does not fit
            the surface; if the patch has holes.
        """
        own = self.surface.own_grids
        if own and self.width is not None:
            expected = "be left out: a measured surface has its own"
            raise DescriptionError("FineRoughness.width", self.width, expected, unit="m")
        if not own and self.width is None:
            expected = "be given where no surface is measured"
            raise DescriptionError("FineRoughness.width", None, expected, unit="m")
        brought = one_grid(own, "FineRoughness.surface")
        if brought is not None:
            grid = Grid(*brought, True)
        else:
            side = (self.width or 0.0) / self.pixels
            grid = Grid((self.pixels, self.pixels), (side, side), True)
        heights = whole_heights(self.surface, grid, "FineRoughness.pixels")
        return heights - heights.mean(), grid.pixel_size


def one_grid(
    own: Collection[OwnGrid], field: str, of: str = "height maps", cure: str = ""
) -> OwnGrid | None:
    """Grid that height maps share; None where there is no map, and any grid does.

    Parameters
    ----------
    own : collection of OwnGrid
        Grids of the maps.
    field : str
        What has the maps, for a message.
    of, cure : str
        What should be of one grid, and how it could be.

    Raises
    ------
    DescriptionError
        If the grids differ.
    """
    if len(own) > 1:
        expected = f"have {of} of one grid, (shape, pixel size [m])"
        raise DescriptionError(field, sorted(own), expected, hint=cure)
    return next(iter(own), None)


def whole_heights(surface: Surface, grid: Grid, finer: str) -> Map:
    """Heights of a surface of a face [m]; `finer` is the field that gives finer pixels.

    Raises
    ------
    DescriptionError
        If it has holes, or waves that the pixels do not resolve.
    """
    if surface.void_pixels is not None:
        raise DescriptionError(
            type(surface).__name__,
            surface,
            "have heights at every pixel, as a film has a gap there",
        )
    for wave in surface.shortest_waves(grid):
        if wave.length < 2.0 * wave.pixel * (1.0 - 1e-12):
            expected = f"be at least two pixels, {2.0 * wave.pixel:g} m"
            raise DescriptionError(wave.field, wave.length, expected, unit="m", hint=finer)
    return realise(surface, grid)


@frozen(kw_only=True)
class Flat(Surface):
    """A flat face with a rim, or without end: a disc, or any planform, tilted, crowned, recessed.

    Parameters
    ----------
    radius : float, optional
        Radius of a disc [m]; the film cannot spread beyond it. None: no rim within reach, or that
        of `planform`.
    planform : Planform, optional
        Outline of a face that is no disc: `Ring`, `Rectangle`, `Ellipse`, `Sector`, `Polygon`,
        `Image`, and their sums and differences.
    holes : tuple of Vent or SealedHole
        Holes in the face.
    recesses : tuple of Recess
        Regions that are deeper; where they overlap, the deepest counts.
    tilt : (float, float)
        Slopes along x and y by which the face recedes from the other one [rad].
    crown_radius : float, optional
        Radius of curvature of a face that is slightly domed [m]; negative: hollow.
    relief : Surface, optional
        Any surface with heights on top of all this, such as measured roughness, its middle at the
        origin. A height map is beyond its edge as high as there; other surfaces are made for the
        rectangle about the origin that holds the face, in whose lower left corner a wave has a
        crest.
    roughness : FineRoughness, optional
        Roughness far finer than the face, by its flow factors: of an even face, whose gap then
        counts from the mean plane.

    Notes
    -----
    The gap of two faces is the shortest distance between them within the film, recesses and reliefs
    apart: a peak of a relief is nearer by its height.

    Examples
    --------
    >>> Flat(radius=3.175e-3).curvature
    0.0
    >>> from contactkit.scene.planforms import Ring
    >>> Flat(planform=Ring(radius=2e-3, hole_radius=1e-3), tilt=(1e-4, 0.0)).is_disc
    False
    """

    kind: ClassVar[str] = "flat"
    bounds_film: ClassVar[bool] = True

    radius: float | None = field(default=None, validator=optional(positive), metadata=si("m"))
    planform: Planform | None = field(default=None, validator=optional(part(Planform)))
    holes: tuple[FaceHole, ...] = field(default=(), converter=as_tuple)
    recesses: tuple[Recess, ...] = field(default=(), converter=as_tuple)
    tilt: tuple[float, float] = field(
        default=(0.0, 0.0), converter=as_pair, validator=_slopes, metadata=si("rad")
    )
    crown_radius: float | None = field(default=None, validator=optional(_curved), metadata=si("m"))
    relief: Surface | None = field(default=None, validator=optional(_relief))
    roughness: FineRoughness | None = field(default=None, validator=optional(part(FineRoughness)))

    @holes.validator
    def _check_holes(self, attribute: Attribute[Any], value: tuple[Any, ...]) -> None:
        if not all(isinstance(hole, Vent | SealedHole) for hole in value):
            raise refuse(self, attribute, value, "hold a Vent or a SealedHole each")

    @recesses.validator
    def _check_recesses(self, attribute: Attribute[Any], value: tuple[Any, ...]) -> None:
        if not all(isinstance(recess, Recess) for recess in value):
            raise refuse(self, attribute, value, "hold a Recess each")

    def __attrs_post_init__(self) -> None:
        """Refuse two outlines, and what has a place on a bounded face only."""
        if self.radius is not None and self.planform is not None:
            hint = "a disc has a radius, any other face a planform"
            raise DescriptionError(
                "Flat.radius", self.radius, "stand alone, without planform", unit="m", hint=hint
            )
        if self.outline is None and not self.is_even:
            hint = "give its radius [m] or its planform"
            raise DescriptionError("Flat", "without end", "have a rim", hint=hint)

    @property
    def curvature(self) -> float:
        """See `Surface.curvature`."""
        return 0.0

    @property
    def outline(self) -> Planform | None:
        """Planform of the face; None if it has no rim within reach."""
        return self.planform if self.radius is None else Disc(radius=self.radius)

    @property
    def is_level(self) -> bool:
        """Whether it has one height everywhere, holes and fine roughness apart."""
        is_plane = self.tilt == (0.0, 0.0) and self.crown_radius is None
        return is_plane and self.relief is None and not self.recesses

    @property
    def is_even(self) -> bool:
        """Whether it has one height everywhere, no roughness, and no hole."""
        return self.is_level and self.roughness is None and not self.holes

    @property
    def is_disc(self) -> bool:
        """Whether it is an even disc, or an even face without end."""
        return self.is_even and isinstance(self.outline, Disc | None)

    @property
    def area(self) -> float:
        """Area without the vents [m2]; inf without a rim."""
        if self.outline is None:
            return math.inf
        vents = sum(hole.shape.area for hole in self.holes if isinstance(hole, Vent))
        return self.outline.area - vents

    @property
    def equal_radius(self) -> float:
        """Radius of the disc of the same area [m]; inf without a rim."""
        return (
            self.outline.radius
            if self.is_disc and isinstance(self.outline, Disc)
            else (math.sqrt(self.area / math.pi))
        )

    def heights_on(self, grid: Grid) -> Map:
        """See `Surface.heights_on`."""
        import numpy as np

        return np.broadcast_to(0.0, grid.shape)  # without memory of its own


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
