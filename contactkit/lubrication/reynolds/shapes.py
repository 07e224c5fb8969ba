"""Planforms of a face: discs, rings, rectangles, ellipses, sectors, polygons, and their sums.

A shape has a `level`: its signed distance [m], positive inside. That of a sum or difference is a
bound of the distance and has the same zero line, which is all that the film asks of it. Shapes are
composed with ``|`` (union), ``&`` (intersection) and ``-`` (difference).
"""

from __future__ import annotations

import abc
import math
from typing import TYPE_CHECKING, Any

import numpy as np
from attrs import Attribute, field, frozen

from ...units import si
from ...validators import Described, finite, part, positive, refuse

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = [
    "Difference",
    "Disc",
    "Ellipse",
    "Intersection",
    "Polygon",
    "Rectangle",
    "Ring",
    "Sector",
    "Shape",
    "Union",
    "equilateral_triangle",
]

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
class Shape(Described, abc.ABC):
    """A region of the plane."""

    @abc.abstractmethod
    def level(self, x: Any, y: Any) -> NDArray[np.float64]:
        """Signed distance [m] of points to the edge, positive inside; x and y broadcast [m]."""

    @property
    @abc.abstractmethod
    def bounds(self) -> Bounds:
        """Smallest x, largest x, smallest y and largest y [m]."""

    def __or__(self, other: Shape) -> Union:
        """Union of two shapes."""
        return Union(first=self, second=other)

    def __and__(self, other: Shape) -> Intersection:
        """Intersection of two shapes."""
        return Intersection(first=self, second=other)

    def __sub__(self, other: Shape) -> Difference:
        """Difference of two shapes."""
        return Difference(first=self, second=other)


@frozen(kw_only=True)
class Disc(Shape):
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

    radius: float = field(validator=positive, metadata=si("m"))
    centre: Pair = field(default=(0.0, 0.0), validator=_pair(finite), metadata=si("m"))

    def level(self, x: Any, y: Any) -> NDArray[np.float64]:
        """See `Shape.level`."""
        return np.asarray(self.radius - np.hypot(x - self.centre[0], y - self.centre[1]))

    @property
    def bounds(self) -> Bounds:
        """See `Shape.bounds`."""
        (x, y), r = self.centre, self.radius
        return x - r, x + r, y - r, y + r


@frozen(kw_only=True)
class Ring(Shape):
    """A disc with a concentric hole.

    Parameters
    ----------
    radius, hole_radius : float
        Radii of the outer and inner edges [m].
    centre : tuple of float
        Centre (x, y) [m].

    Notes
    -----
    The hole is open to the surroundings; a hole with a pressure of its own, or a sealed one, is
    given to `rasterise` beside a `Disc`.

    Examples
    --------
    >>> float(Ring(radius=2.0, hole_radius=1.0).level(1.25, 0.0))
    0.25
    """

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
        """See `Shape.level`."""
        r = np.hypot(x - self.centre[0], y - self.centre[1])
        return np.asarray(np.minimum(self.radius - r, r - self.hole_radius))

    @property
    def bounds(self) -> Bounds:
        """See `Shape.bounds`."""
        (x, y), r = self.centre, self.radius
        return x - r, x + r, y - r, y + r


@frozen(kw_only=True)
class Rectangle(Shape):
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

    length: float = field(validator=positive, metadata=si("m"))
    width: float = field(validator=positive, metadata=si("m"))
    centre: Pair = field(default=(0.0, 0.0), validator=_pair(finite), metadata=si("m"))
    angle: float = field(default=0.0, validator=finite, metadata=si("rad"))

    def level(self, x: Any, y: Any) -> NDArray[np.float64]:
        """See `Shape.level`."""
        c, s = math.cos(self.angle), math.sin(self.angle)
        dx, dy = x - self.centre[0], y - self.centre[1]
        over_x = np.abs(c * dx + s * dy) - 0.5 * self.length
        over_y = np.abs(c * dy - s * dx) - 0.5 * self.width
        outside = np.hypot(np.maximum(over_x, 0.0), np.maximum(over_y, 0.0))
        return np.asarray(-outside - np.minimum(np.maximum(over_x, over_y), 0.0))

    @property
    def bounds(self) -> Bounds:
        """See `Shape.bounds`."""
        c, s = abs(math.cos(self.angle)), abs(math.sin(self.angle))
        half_x = 0.5 * (c * self.length + s * self.width)
        half_y = 0.5 * (s * self.length + c * self.width)
        x, y = self.centre
        return x - half_x, x + half_x, y - half_y, y + half_y


@frozen(kw_only=True)
class Ellipse(Shape):
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

    semi_axes: Pair = field(validator=_pair(positive), metadata=si("m"))
    centre: Pair = field(default=(0.0, 0.0), validator=_pair(finite), metadata=si("m"))

    def level(self, x: Any, y: Any) -> NDArray[np.float64]:
        """See `Shape.level`."""
        a, b = self.semi_axes
        u, w = (x - self.centre[0]) / a, (y - self.centre[1]) / b
        rho, steep = np.hypot(u, w), np.hypot(u / a, w / b)
        at_centre = steep == 0.0
        distance = (1.0 - rho) * rho / np.where(at_centre, 1.0, steep)
        return np.asarray(np.where(at_centre, min(a, b), distance))

    @property
    def bounds(self) -> Bounds:
        """See `Shape.bounds`."""
        (x, y), (a, b) = self.centre, self.semi_axes
        return x - a, x + a, y - b, y + b


@frozen(kw_only=True)
class Sector(Shape):
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
        """See `Shape.level`."""
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
        """See `Shape.bounds`."""
        turns = [self.start, self.end]
        quarter = math.ceil(self.start / (0.5 * math.pi)) * 0.5 * math.pi
        while quarter < self.end:
            turns.append(quarter)
            quarter += 0.5 * math.pi
        x = [r * math.cos(t) for r in (self.radius, self.hole_radius) for t in turns]
        y = [r * math.sin(t) for r in (self.radius, self.hole_radius) for t in turns]
        (cx, cy) = self.centre
        return cx + min(x), cx + max(x), cy + min(y), cy + max(y)


@frozen(kw_only=True)
class Polygon(Shape):
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

    corners: tuple[Pair, ...] = field(metadata=si("m"))

    @corners.validator
    def _check_corners(self, attribute: Attribute[Any], value: Any) -> None:
        if not isinstance(value, tuple) or len(value) < 3:
            raise refuse(self, attribute, value, "be three or more corners (x, y)")
        for corner in value:
            _pair(finite)(self, attribute, corner)

    def level(self, x: Any, y: Any) -> NDArray[np.float64]:
        """See `Shape.level`."""
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
        """See `Shape.bounds`."""
        x, y = zip(*self.corners, strict=True)
        return min(x), max(x), min(y), max(y)


@frozen(kw_only=True)
class _Composed(Shape, abc.ABC):
    """What two shapes make."""

    first: Shape = field(validator=part(Shape))
    second: Shape = field(validator=part(Shape))


@frozen(kw_only=True)
class Union(_Composed):
    """All that lies in either of two shapes.

    Parameters
    ----------
    first, second : Shape
        The shapes.
    """

    def level(self, x: Any, y: Any) -> NDArray[np.float64]:
        """See `Shape.level`."""
        return np.maximum(self.first.level(x, y), self.second.level(x, y))

    @property
    def bounds(self) -> Bounds:
        """See `Shape.bounds`."""
        a, b = self.first.bounds, self.second.bounds
        return min(a[0], b[0]), max(a[1], b[1]), min(a[2], b[2]), max(a[3], b[3])


@frozen(kw_only=True)
class Intersection(_Composed):
    """All that lies in both of two shapes.

    Parameters
    ----------
    first, second : Shape
        The shapes.
    """

    def level(self, x: Any, y: Any) -> NDArray[np.float64]:
        """See `Shape.level`."""
        return np.minimum(self.first.level(x, y), self.second.level(x, y))

    @property
    def bounds(self) -> Bounds:
        """See `Shape.bounds`."""
        a, b = self.first.bounds, self.second.bounds
        return max(a[0], b[0]), min(a[1], b[1]), max(a[2], b[2]), min(a[3], b[3])


@frozen(kw_only=True)
class Difference(_Composed):
    """All that lies in the first of two shapes and not in the second.

    Parameters
    ----------
    first, second : Shape
        The shapes.
    """

    def level(self, x: Any, y: Any) -> NDArray[np.float64]:
        """See `Shape.level`."""
        return np.minimum(self.first.level(x, y), -self.second.level(x, y))

    @property
    def bounds(self) -> Bounds:
        """See `Shape.bounds`."""
        return self.first.bounds


def equilateral_triangle(side: float) -> Polygon:
    """Equilateral triangle of a side [m], its centroid at the origin.

    Examples
    --------
    >>> round(float(equilateral_triangle(1.0).level(0.0, 0.0)), 6)
    0.288675
    """
    if not side > 0.0:
        from ...errors import DescriptionError

        raise DescriptionError("equilateral_triangle.side", side, "be positive", unit="m")
    inner = side / math.sqrt(12.0)
    corners = ((-0.5 * side, -inner), (0.5 * side, -inner), (0.0, 2.0 * inner))
    return Polygon(corners=corners)
