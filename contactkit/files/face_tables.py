"""Faces that a scene file may give the viscous force: their damping laws in closed form."""

from __future__ import annotations

import abc
from typing import ClassVar

from attrs import field, frozen

from ..lubrication.reynolds.damping import (
    DampingLaw,
    disc_damping,
    dome_damping,
    ellipse_damping,
    recess_damping,
    rectangle_damping,
    ring_damping,
    triangle_damping,
)
from ..units import si
from ..validators import finite, positive

__all__ = ["FACE_TABLES", "FaceTable"]


@frozen(kw_only=True)
class FaceTable(abc.ABC):
    """Table of a face in a file; its kind is its name under ``face``."""

    kind: ClassVar[str]

    @abc.abstractmethod
    def law(self) -> DampingLaw:
        """Damping law of the face."""


@frozen(kw_only=True)
class _Disc(FaceTable):
    kind: ClassVar[str] = "disc"
    radius: float = field(validator=positive, metadata=si("m"))

    def law(self) -> DampingLaw:
        return disc_damping(self.radius)


@frozen(kw_only=True)
class _Ring(FaceTable):
    kind: ClassVar[str] = "ring"
    radius: float = field(validator=positive, metadata=si("m"))
    hole_radius: float = field(validator=positive, metadata=si("m"))
    is_sealed: bool = False

    def law(self) -> DampingLaw:
        return ring_damping(self.radius, self.hole_radius, is_sealed=self.is_sealed)


@frozen(kw_only=True)
class _Rectangle(FaceTable):
    kind: ClassVar[str] = "rectangle"
    length: float = field(validator=positive, metadata=si("m"))
    width: float = field(validator=positive, metadata=si("m"))

    def law(self) -> DampingLaw:
        return rectangle_damping(self.length, self.width)


@frozen(kw_only=True)
class _Ellipse(FaceTable):
    kind: ClassVar[str] = "ellipse"
    semi_major_axis: float = field(validator=positive, metadata=si("m"))
    semi_minor_axis: float = field(validator=positive, metadata=si("m"))

    def law(self) -> DampingLaw:
        return ellipse_damping((self.semi_major_axis, self.semi_minor_axis))


@frozen(kw_only=True)
class _Triangle(FaceTable):
    kind: ClassVar[str] = "triangle"
    side: float = field(validator=positive, metadata=si("m"))

    def law(self) -> DampingLaw:
        return triangle_damping(self.side)


@frozen(kw_only=True)
class _Recess(FaceTable):
    kind: ClassVar[str] = "recess"
    radius: float = field(validator=positive, metadata=si("m"))
    recess_radius: float = field(validator=positive, metadata=si("m"))
    depth: float = field(validator=positive, metadata=si("m"))

    def law(self) -> DampingLaw:
        return recess_damping(self.radius, self.recess_radius, self.depth)


@frozen(kw_only=True)
class _Dome(FaceTable):
    kind: ClassVar[str] = "dome"
    radius: float = field(validator=positive, metadata=si("m"))
    curvature_radius: float = field(validator=finite, metadata=si("m"))

    def law(self) -> DampingLaw:
        return dome_damping(self.radius, self.curvature_radius)


FACE_TABLES: dict[str, type[FaceTable]] = {
    table.kind: table for table in (_Disc, _Ring, _Rectangle, _Ellipse, _Triangle, _Recess, _Dome)
}
"""Faces by their names under ``face``."""
