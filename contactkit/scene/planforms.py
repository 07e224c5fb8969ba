"""Planforms of a face: discs, rings, rectangles, ellipses, sectors, polygons, images, their sums.

A planform has a `level`: its signed distance [m], positive inside. That of a sum or difference is a
bound of the distance and has the same zero line, which is all that a film asks of it. Planforms are
composed with ``|`` (union), ``&`` (intersection) and ``-`` (difference).
"""

from __future__ import annotations

import abc
import math
from functools import cached_property
from typing import TYPE_CHECKING, Any, ClassVar

from attrs import Attribute, field, frozen

from ..errors import DescriptionError
from ..frozen import SAME_NUMBERS
from ..reading.named_files import Contents
from ..units import parse_quantity, si
from ..validators import (
    Described,
    as_pair,
    as_path,
    file_name,
    finite,
    part,
    positive,
    positive_or_pair,
    refuse,
)

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Map = NDArray[np.float64]

__all__ = [
    "Difference",
    "Disc",
    "Ellipse",
    "Image",
    "ImageFile",
    "Intersection",
    "Planform",
    "Polygon",
    "Rectangle",
    "Ring",
    "Sector",
    "Union",
    "equilateral_triangle",
]

_CELLS = 500  # across, for an area: the rim of a disc then leaves 2e-6 of it

Bounds = tuple[float, float, float, float]
Pair = tuple[float, float]


def _pair(check: Any) -> Any:
    """Validator of a tuple of two numbers that each pass a check."""

    def check_pair(owner: object, attribute: Attribute[Any], value: Any) -> None:
        if not isinstance(value, tuple) or len(value) != 2:
            raise refuse(owner, attribute, value, "be a pair (x, y)")
        for number in value:
            check(owner, attribute, number)

    return check_pair


@frozen(kw_only=True)
class Planform(Described, abc.ABC):
    """A region of the plane. Its kind is its name in files, under ``shape``."""

    family: ClassVar[str] = "planform"
    kind: ClassVar[str]

    @abc.abstractmethod
    def level(self, x: Any, y: Any) -> NDArray[np.float64]:
        """Signed distance [m] of points to the edge, positive inside; x and y broadcast [m]."""

    @property
    @abc.abstractmethod
    def bounds(self) -> Bounds:
        """Smallest x, largest x, smallest y and largest y [m]."""

    @property
    def circle(self) -> tuple[float, float, float] | None:
        """Centre (x, y) and radius [m] of a disc; None of all others."""
        return None

    @property
    def area(self) -> float:
        """Area [m2]; where there is no closed form within 1e-4, by cells of a 500th of its size."""
        import numpy as np

        left, right, low, high = self.bounds
        size = max(right - left, high - low) / _CELLS
        nx, ny = (max(1, round(length / size)) for length in (right - left, high - low))
        dx, dy = (right - left) / nx, (high - low) / ny
        x = left + dx * (np.arange(nx) + 0.5)
        y = low + dy * (np.arange(ny) + 0.5)
        level = np.broadcast_to(self.level(x[None, :], y[:, None]), (ny, nx))
        return float(np.clip(0.5 + level / math.sqrt(dx * dy), 0.0, 1.0).sum()) * dx * dy

    def without_round_holes(self) -> tuple[Planform, tuple[Disc, ...]]:
        """The planform without the round holes that lie in it, and these."""
        return self, ()

    def __or__(self, other: Planform) -> Union:
        """Union of two planforms."""
        return Union(first=self, second=other)

    def __and__(self, other: Planform) -> Intersection:
        """Intersection of two planforms."""
        return Intersection(first=self, second=other)

    def __sub__(self, other: Planform) -> Difference:
        """Difference of two planforms."""
        return Difference(first=self, second=other)


@frozen(kw_only=True)
class Disc(Planform):
    """A disc.

    Parameters
    ----------
    radius : float
        Radius [m].
    centre : tuple of float
        Centre (x, y) [m].

    Examples
    --------
    >>> float(Disc(radius=2.0).level(0.5, 0.0))
    1.5
    """

    kind: ClassVar[str] = "disc"

    radius: float = field(validator=positive, metadata=si("m"))
    centre: Pair = field(default=(0.0, 0.0), validator=_pair(finite), metadata=si("m"))

    def level(self, x: Any, y: Any) -> NDArray[np.float64]:
        """See `Planform.level`."""
        import numpy as np

        return np.asarray(self.radius - np.hypot(x - self.centre[0], y - self.centre[1]))

    @property
    def bounds(self) -> Bounds:
        """See `Planform.bounds`."""
        (x, y), r = self.centre, self.radius
        return x - r, x + r, y - r, y + r

    @property
    def circle(self) -> tuple[float, float, float] | None:
        """See `Planform.circle`."""
        return (*self.centre, self.radius)

    @property
    def area(self) -> float:
        """See `Planform.area`."""
        return math.pi * self.radius**2


@frozen(kw_only=True)
class Ring(Planform):
    """A disc with a concentric hole.

    Parameters
    ----------
    radius, hole_radius : float
        Radii of the outer and inner edges [m].
    centre : tuple of float
        Centre (x, y) [m].

    Notes
    -----
    The hole is open to the surroundings; a sealed one is a `SealedHole` of a
    `Flat` whose planform is a `Disc`.

    Examples
    --------
    >>> float(Ring(radius=2.0, hole_radius=1.0).level(1.25, 0.0))
    0.25
    """

    kind: ClassVar[str] = "ring"

    radius: float = field(validator=positive, metadata=si("m"))
    hole_radius: float = field(validator=positive, metadata=si("m"))
    centre: Pair = field(default=(0.0, 0.0), validator=_pair(finite), metadata=si("m"))

    @hole_radius.validator
    def _check_hole(self, attribute: Attribute[float], value: float) -> None:
        positive(self, attribute, value)
        if value >= self.radius:
            cure = f"the outer radius is {self.radius!r}"
            raise refuse(self, attribute, value, "be smaller than the radius", cure)

    def level(self, x: Any, y: Any) -> NDArray[np.float64]:
        """See `Planform.level`."""
        import numpy as np

        r = np.hypot(x - self.centre[0], y - self.centre[1])
        return np.asarray(np.minimum(self.radius - r, r - self.hole_radius))

    @property
    def bounds(self) -> Bounds:
        """See `Planform.bounds`."""
        (x, y), r = self.centre, self.radius
        return x - r, x + r, y - r, y + r

    @property
    def area(self) -> float:
        """See `Planform.area`."""
        return math.pi * (self.radius - self.hole_radius) * (self.radius + self.hole_radius)

    def without_round_holes(self) -> tuple[Planform, tuple[Disc, ...]]:
        """See `Planform.without_round_holes`."""
        hole = Disc(radius=self.hole_radius, centre=self.centre)
        return Disc(radius=self.radius, centre=self.centre), (hole,)


@frozen(kw_only=True)
class Rectangle(Planform):
    """A rectangle.

    Parameters
    ----------
    length, width : float
        Sides along and across [m].
    centre : tuple of float
        Centre (x, y) [m].
    angle : float
        Angle from x to the length [rad].

    Examples
    --------
    >>> float(Rectangle(length=4.0, width=2.0).level(1.5, 0.0))
    0.5
    """

    kind: ClassVar[str] = "rectangle"

    length: float = field(validator=positive, metadata=si("m"))
    width: float = field(validator=positive, metadata=si("m"))
    centre: Pair = field(default=(0.0, 0.0), validator=_pair(finite), metadata=si("m"))
    angle: float = field(default=0.0, validator=finite, metadata=si("rad"))

    def level(self, x: Any, y: Any) -> NDArray[np.float64]:
        """See `Planform.level`."""
        import numpy as np

        c, s = math.cos(self.angle), math.sin(self.angle)
        dx, dy = x - self.centre[0], y - self.centre[1]
        over_x = np.abs(c * dx + s * dy) - 0.5 * self.length
        over_y = np.abs(c * dy - s * dx) - 0.5 * self.width
        outside = np.hypot(np.maximum(over_x, 0.0), np.maximum(over_y, 0.0))
        return np.asarray(-outside - np.minimum(np.maximum(over_x, over_y), 0.0))

    @property
    def bounds(self) -> Bounds:
        """See `Planform.bounds`."""
        c, s = abs(math.cos(self.angle)), abs(math.sin(self.angle))
        half_x = 0.5 * (c * self.length + s * self.width)
        half_y = 0.5 * (s * self.length + c * self.width)
        x, y = self.centre
        return x - half_x, x + half_x, y - half_y, y + half_y

    @property
    def area(self) -> float:
        """See `Planform.area`."""
        return self.length * self.width


@frozen(kw_only=True)
class Ellipse(Planform):
    """An ellipse with axes along x and y.

    Parameters
    ----------
    semi_axes : tuple of float
        Semi-axes along x and y [m].
    centre : tuple of float
        Centre (x, y) [m].

    Notes
    -----
    The level is (1 - rho)/abs(grad rho) with rho^2 = (x/a)^2 + (y/b)^2: the distance up to
    terms of second order in it, and exactly zero on the edge.

    Examples
    --------
    >>> float(Ellipse(semi_axes=(3.0, 1.0)).level(0.0, 0.75))
    0.25
    """

    kind: ClassVar[str] = "ellipse"

    semi_axes: Pair = field(validator=_pair(positive), metadata=si("m"))
    centre: Pair = field(default=(0.0, 0.0), validator=_pair(finite), metadata=si("m"))

    def level(self, x: Any, y: Any) -> NDArray[np.float64]:
        """See `Planform.level`."""
        import numpy as np

        a, b = self.semi_axes
        u, w = (x - self.centre[0]) / a, (y - self.centre[1]) / b
        rho, steep = np.hypot(u, w), np.hypot(u / a, w / b)
        at_centre = steep == 0.0
        distance = (1.0 - rho) * rho / np.where(at_centre, 1.0, steep)
        return np.asarray(np.where(at_centre, min(a, b), distance))

    @property
    def bounds(self) -> Bounds:
        """See `Planform.bounds`."""
        (x, y), (a, b) = self.centre, self.semi_axes
        return x - a, x + a, y - b, y + b

    @property
    def area(self) -> float:
        """See `Planform.area`."""
        return math.pi * self.semi_axes[0] * self.semi_axes[1]


@frozen(kw_only=True)
class Sector(Planform):
    """A sector of a ring, such as a pad of a thrust bearing or a groove along an arc.

    Parameters
    ----------
    radius, hole_radius : float
        Outer and inner radii [m]; an inner radius of 0 gives a sector of a disc.
    start, end : float
        Angles of its straight edges from x, counter-clockwise [rad].
    centre : tuple of float
        Centre (x, y) of the arcs [m].

    Examples
    --------
    >>> import math
    >>> pad = Sector(radius=2.0, hole_radius=1.0, start=0.0, end=math.pi / 2)
    >>> round(float(pad.level(1.0, 1.0)), 6), bool(pad.level(-1.0, 1.0) > 0.0)
    (0.414214, False)
    """

    kind: ClassVar[str] = "sector"

    radius: float = field(validator=positive, metadata=si("m"))
    hole_radius: float = field(default=0.0, metadata=si("m"))
    start: float = field(validator=finite, metadata=si("rad"))
    end: float = field(metadata=si("rad"))
    centre: Pair = field(default=(0.0, 0.0), validator=_pair(finite), metadata=si("m"))

    @hole_radius.validator
    def _check_hole(self, attribute: Attribute[float], value: float) -> None:
        finite(self, attribute, value)
        if not 0.0 <= value < self.radius:
            cure = f"the outer radius is {self.radius!r}"
            raise refuse(self, attribute, value, "lie between 0 and the radius", cure)

    @end.validator
    def _check_end(self, attribute: Attribute[float], value: float) -> None:
        finite(self, attribute, value)
        if not 0.0 < value - self.start < 2.0 * math.pi:
            expected = "be larger than the start, by less than a full turn"
            raise refuse(self, attribute, value, expected, f"start is {self.start!r}")

    def level(self, x: Any, y: Any) -> NDArray[np.float64]:
        """See `Planform.level`."""
        import numpy as np

        dx, dy = x - self.centre[0], y - self.centre[1]
        r = np.hypot(dx, dy)
        first = dy * math.cos(self.start) - dx * math.sin(self.start)
        second = dx * math.sin(self.end) - dy * math.cos(self.end)
        wedge = np.minimum if self.end - self.start <= math.pi else np.maximum
        between = wedge(first, second)
        inner = r - self.hole_radius if self.hole_radius > 0.0 else np.inf
        return np.asarray(np.minimum(np.minimum(self.radius - r, inner), between))

    @property
    def bounds(self) -> Bounds:
        """See `Planform.bounds`."""
        turns = [self.start, self.end]
        quarter = math.ceil(self.start / (0.5 * math.pi)) * 0.5 * math.pi
        while quarter < self.end:
            turns.append(quarter)
            quarter += 0.5 * math.pi
        x = [r * math.cos(t) for r in (self.radius, self.hole_radius) for t in turns]
        y = [r * math.sin(t) for r in (self.radius, self.hole_radius) for t in turns]
        (cx, cy) = self.centre
        return cx + min(x), cx + max(x), cy + min(y), cy + max(y)

    @property
    def area(self) -> float:
        """See `Planform.area`."""
        width = (self.radius - self.hole_radius) * (self.radius + self.hole_radius)
        return 0.5 * (self.end - self.start) * width


@frozen(kw_only=True)
class Polygon(Planform):
    """A polygon without crossings, such as a triangle.

    Parameters
    ----------
    corners : tuple of pairs
        Corners (x, y) in order [m], three or more.

    Examples
    --------
    >>> unit = Polygon(corners=((0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)))
    >>> float(unit.level(0.5, 0.25)), float(unit.level(2.0, 0.5))
    (0.25, -1.0)
    """

    kind: ClassVar[str] = "polygon"

    corners: tuple[Pair, ...] = field(metadata=si("m"))

    @corners.validator
    def _check_corners(self, attribute: Attribute[Any], value: Any) -> None:
        if not isinstance(value, tuple) or len(value) < 3:
            raise refuse(self, attribute, value, "be three or more corners (x, y)")
        for corner in value:
            _pair(finite)(self, attribute, corner)

    def level(self, x: Any, y: Any) -> NDArray[np.float64]:
        """See `Planform.level`."""
        import numpy as np

        x, y = np.broadcast_arrays(np.asarray(x, float), np.asarray(y, float))
        nearest, inside = np.full(x.shape, np.inf), np.zeros(x.shape, bool)
        for (ax, ay), (bx, by) in zip(
            self.corners, self.corners[1:] + self.corners[:1], strict=True
        ):
            ex, ey = bx - ax, by - ay
            along = np.clip(((x - ax) * ex + (y - ay) * ey) / (ex * ex + ey * ey), 0.0, 1.0)
            nearest = np.minimum(nearest, np.hypot(x - ax - along * ex, y - ay - along * ey))
            if ay != by:
                crosses = (ay > y) != (by > y)
                inside ^= crosses & (x < ax + (y - ay) * ex / ey)
        return np.where(inside, nearest, -nearest)

    @property
    def bounds(self) -> Bounds:
        """See `Planform.bounds`."""
        x, y = zip(*self.corners, strict=True)
        return min(x), max(x), min(y), max(y)

    @property
    def area(self) -> float:
        """See `Planform.area`."""
        pairs = zip(self.corners, self.corners[1:] + self.corners[:1], strict=True)
        return 0.5 * abs(sum(ax * by - bx * ay for (ax, ay), (bx, by) in pairs))


def _as_coverage(value: Any) -> Map:
    import numpy as np

    made = np.array(value, dtype=float, order="C")
    made.flags.writeable = False
    return made


@frozen(kw_only=True)
class Image(Planform):
    """A planform drawn as an image: the fraction of each pixel that it covers.

    Beyond the image there is nothing: a shape that it is covered with up to its edge ends there.

    Parameters
    ----------
    coverage : array_like (ny, nx)
        Fraction of a pixel [-], 0 to 1; a mask of true and false, or an anti-aliased drawing over
        its white, which is more exact: of a curved rim a mask leaves a staircase.
    pixel_size : float or (float, float)
        Size of a pixel [m]; a pair is (dy, dx).

    Examples
    --------
    >>> Image(coverage=[[0.0, 0.5, 1.0, 0.5, 0.0]], pixel_size=1e-3).bounds
    (-0.0025, 0.0025, -0.0005, 0.0005)
    """

    kind: ClassVar[str] = "image"

    coverage: Map = field(
        converter=_as_coverage,
        repr=False,
        eq=SAME_NUMBERS,
        hash=False,
        metadata=si("-")
        | {
            "in_file": "save the array as .npy and use ImageFile(path=..., pixel_size=...), in a "
            "file shape = 'image-file'"
        },
    )
    pixel_size: float | tuple[float, float] = field(
        converter=as_pair, validator=positive_or_pair, metadata=si("m")
    )

    @coverage.validator
    def _check_coverage(self, attribute: Attribute[Any], value: Map) -> None:
        if value.ndim != 2 or value.size == 0:
            raise DescriptionError("Image.coverage", value.shape, "have two dimensions (ny, nx)")
        if not ((value >= 0.0) & (value <= 1.0)).all():
            cure = "divide an image of 8 bits by 255"
            bad = float(value[~((value >= 0.0) & (value <= 1.0))][0])
            raise DescriptionError("Image.coverage", bad, "lie between 0 and 1", hint=cure)

    @property
    def pixel(self) -> tuple[float, float]:
        """Height and width of a pixel [m]."""
        size = self.pixel_size
        return size if isinstance(size, tuple) else (size, size)

    @cached_property
    def _distance(self) -> Map:
        """Signed distance of each pixel to the rim [m], and of an empty one all around the image.

        A plan asks for it on each of its grids.
        """
        import numpy as np

        from ..lubrication.reynolds.face import distance_of_image

        return np.asarray(distance_of_image(np.pad(self.coverage, 1), self.pixel), dtype=float)

    def level(self, x: Any, y: Any) -> NDArray[np.float64]:
        """See `Planform.level`: between the pixels by straight lines; beyond them is nothing."""
        import numpy as np
        from scipy.ndimage import map_coordinates

        (dy, dx), (left, _, low, _) = self.pixel, self.bounds
        rows, columns = np.broadcast_arrays((y - low) / dy + 0.5, (x - left) / dx + 0.5)
        places = np.stack([rows.ravel(), columns.ravel()])
        last = np.reshape(self._distance.shape, (2, 1)) - 1.0
        beyond = places - np.clip(places, 0.0, last)
        found = map_coordinates(self._distance, places, order=1, mode="nearest")
        away = np.hypot(dy * beyond[0], dx * beyond[1])
        return np.asarray(found - away, dtype=float).reshape(rows.shape)

    @property
    def bounds(self) -> Bounds:
        """See `Planform.bounds`."""
        (dy, dx), (ny, nx) = self.pixel, self.coverage.shape
        return -0.5 * nx * dx, 0.5 * nx * dx, -0.5 * ny * dy, 0.5 * ny * dy

    @property
    def area(self) -> float:
        """See `Planform.area`."""
        return float(self.coverage.sum()) * self.pixel[0] * self.pixel[1]


@frozen(kw_only=True)
class ImageFile(Planform):
    """A planform drawn in a file: a PNG image, white where the face is, or an npy array.

    Parameters
    ----------
    path : str
        The file; in Python from the working folder, in a scene file from the folder of that file,
        which `load_scene` makes an absolute path. An npy file holds fractions from 0 to 1, truth
        values or greys of 8 bits, the lowest row first; a PNG file needs the extra
        ``contactkit[plot]``, and its upper row is at the largest y.
    pixel_size : float or (float, float)
        Size of a pixel [m]; a pair is (dy, dx).
    inverted : bool
        Whether the face is drawn dark on light.
    checksum : str, optional
        SHA-256 of the file; a file that differs is refused.
    """

    kind: ClassVar[str] = "image-file"

    path: str = field(converter=as_path, validator=file_name)
    pixel_size: float | tuple[float, float] = field(
        converter=as_pair, validator=positive_or_pair, metadata=si("m")
    )
    inverted: bool = field(default=False, validator=part(bool))
    checksum: str | None = None

    @property
    def image(self) -> Image:
        """The image in the file, which is read once for as long as it does not change."""
        return _IMAGES.of(self)

    def level(self, x: Any, y: Any) -> NDArray[np.float64]:
        """See `Planform.level`; reads the file."""
        return self.image.level(x, y)

    @property
    def bounds(self) -> Bounds:
        """See `Planform.bounds`; reads the file."""
        return self.image.bounds

    @property
    def area(self) -> float:
        """See `Planform.area`; reads the file."""
        return self.image.area


def _read(planform: ImageFile) -> Image:
    from ..reading.images import read_coverage

    coverage = read_coverage(planform.path, planform.checksum)
    drawn = 1.0 - coverage if planform.inverted else coverage
    return Image(coverage=drawn, pixel_size=planform.pixel_size)


_IMAGES: Contents[ImageFile, Image] = Contents(_read)


@frozen(kw_only=True)
class _Composed(Planform, abc.ABC):
    """What two planforms make."""

    first: Planform = field(validator=part(Planform))
    second: Planform = field(validator=part(Planform))


@frozen(kw_only=True)
class Union(_Composed):
    """All that lies in either of two planforms.

    Parameters
    ----------
    first, second : Planform
        The shapes.
    """

    kind: ClassVar[str] = "union"

    def level(self, x: Any, y: Any) -> NDArray[np.float64]:
        """See `Planform.level`."""
        import numpy as np

        return np.maximum(self.first.level(x, y), self.second.level(x, y))

    @property
    def bounds(self) -> Bounds:
        """See `Planform.bounds`."""
        a, b = self.first.bounds, self.second.bounds
        return min(a[0], b[0]), max(a[1], b[1]), min(a[2], b[2]), max(a[3], b[3])


@frozen(kw_only=True)
class Intersection(_Composed):
    """All that lies in both of two planforms.

    Parameters
    ----------
    first, second : Planform
        The shapes.
    """

    kind: ClassVar[str] = "intersection"

    def level(self, x: Any, y: Any) -> NDArray[np.float64]:
        """See `Planform.level`."""
        import numpy as np

        return np.minimum(self.first.level(x, y), self.second.level(x, y))

    @property
    def bounds(self) -> Bounds:
        """See `Planform.bounds`."""
        a, b = self.first.bounds, self.second.bounds
        return max(a[0], b[0]), min(a[1], b[1]), max(a[2], b[2]), min(a[3], b[3])


@frozen(kw_only=True)
class Difference(_Composed):
    """All that lies in the first of two planforms and not in the second.

    Parameters
    ----------
    first, second : Planform
        The shapes.
    """

    kind: ClassVar[str] = "difference"

    def level(self, x: Any, y: Any) -> NDArray[np.float64]:
        """See `Planform.level`."""
        import numpy as np

        return np.minimum(self.first.level(x, y), -self.second.level(x, y))

    @property
    def bounds(self) -> Bounds:
        """See `Planform.bounds`."""
        return self.first.bounds

    def without_round_holes(self) -> tuple[Planform, tuple[Disc, ...]]:
        """See `Planform.without_round_holes`."""
        if not isinstance(self.second, Disc):
            return self, ()
        import numpy as np

        body, holes = self.first.without_round_holes()
        # One that cuts the rim is a notch, and none that the flow runs into from all around.
        (cx, cy), radius = self.second.centre, self.second.radius
        turn = np.linspace(0.0, 2.0 * np.pi, 64)
        if (body.level(cx + radius * np.cos(turn), cy + radius * np.sin(turn)) > 0.0).all():
            return body, (*holes, self.second)
        return self, ()


def equilateral_triangle(side: float | str) -> Polygon:
    """Equilateral triangle of a side [m], its centroid at the origin.

    Examples
    --------
    >>> round(float(equilateral_triangle(1.0).level(0.0, 0.0)), 6)
    0.288675
    """
    side = parse_quantity(side, "m", "equilateral_triangle(side)")
    if not side > 0.0:
        raise DescriptionError("equilateral_triangle(side)", side, "be positive", unit="m")
    inner = side / math.sqrt(12.0)
    corners = ((-0.5 * side, -inner), (0.5 * side, -inner), (0.0, 2.0 * inner))
    return Polygon(corners=corners)
