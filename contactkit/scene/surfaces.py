"""Smooth surfaces (flat, sphere, paraboloid, wave), and the base class of all surfaces."""

from __future__ import annotations

import abc
import math
from typing import Any, ClassVar

from attrs import Attribute, field, frozen

from ..errors import DescriptionError
from ..units import si
from ..validators import Described, as_pair, as_tuple, finite, optional, part, positive, refuse
from .faces import FaceHole, Recess, Vent
from .planforms import Disc, Planform

__all__ = ["Flat", "Paraboloid", "Sphere", "Surface", "Wave"]


@frozen(kw_only=True)
class Surface(Described, abc.ABC):
    """The surface of a body, smooth or rough. Its kind is its name in files, under ``shape``."""

    kind: ClassVar[str]

    @property
    @abc.abstractmethod
    def curvature(self) -> float | None:
        """Curvature at the apex [1/m], positive towards the gap; None without one round apex."""


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
    if not hasattr(value, "pixel_size") or not hasattr(value, "heights"):
        cure = "heights of any surface on a grid of one's own: Heights(heights=..., pixel_size=...)"
        raise refuse(owner, attribute, value, "be Heights", cure)


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
    relief : Heights, optional
        Height map on top of all this, such as measured roughness, its middle at the origin; beyond
        its edge it is as high as there.

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

    radius: float | None = field(default=None, validator=optional(positive), metadata=si("m"))
    planform: Planform | None = field(default=None, validator=optional(part(Planform)))
    holes: tuple[FaceHole, ...] = field(default=(), converter=as_tuple)
    recesses: tuple[Recess, ...] = field(default=(), converter=as_tuple)
    tilt: tuple[float, float] = field(
        default=(0.0, 0.0), converter=as_pair, validator=_slopes, metadata=si("rad")
    )
    crown_radius: float | None = field(default=None, validator=optional(_curved), metadata=si("m"))
    relief: Surface | None = field(default=None, validator=optional(_relief))

    @holes.validator
    def _check_holes(self, attribute: Attribute[Any], value: tuple[Any, ...]) -> None:
        if not all(isinstance(hole, FaceHole) for hole in value):
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
    def is_even(self) -> bool:
        """Whether it has one height everywhere, and no hole."""
        is_level = self.tilt == (0.0, 0.0) and self.crown_radius is None and self.relief is None
        return is_level and not self.holes and not self.recesses

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

    radius: float = field(validator=positive, metadata=si("m"))

    @property
    def curvature(self) -> float:
        """See `Surface.curvature`."""
        return 1.0 / self.radius


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

    @property
    def curvature(self) -> None:
        """See `Surface.curvature`."""
        return None
