"""Shape of the film between two faces, and its damping law in closed form where there is one."""

from __future__ import annotations

import math
from functools import reduce
from typing import TYPE_CHECKING, NamedTuple, Protocol, runtime_checkable

from ...lubrication.reynolds import damping
from ...scene.faces import FaceHole, Recess, Vent
from ...scene.interface import Interface
from ...scene.planforms import Disc, Ellipse, Planform, Polygon, Rectangle
from ...scene.surfaces import FineRoughness, Surface

if TYPE_CHECKING:
    from ...scene.scenes import SeparationScene, SlidingScene

__all__ = ["ClosedForm", "FaceShape", "FollowsCavity", "closed_form", "on_face", "shape_of"]

_CONCENTRIC = 1e-9  # distance of centres over the radius, and sides of a triangle: rounding


class FaceShape(NamedTuple):
    """Film between two faces: its planform, and what its gap has beside the shortest distance."""

    outline: Planform
    """Where both faces are."""
    holes: tuple[FaceHole, ...]
    recesses: tuple[Recess, ...]
    tilt: tuple[float, float]
    """Slopes of the gap along x and y [-]."""
    curvature: float
    """Curvature of the gap [1/m]: of crowns, and of spheres."""
    reliefs: tuple[Surface, ...] = ()
    """Reliefs of both faces."""
    roughness: FineRoughness | None = None
    """Roughness that is known by its flow factors; that of one face stands for both."""

    @property
    def is_even(self) -> bool:
        """Whether the gap is the same everywhere."""
        is_level = self.tilt == (0.0, 0.0) and self.curvature == 0.0
        return is_level and not self.recesses and not self.reliefs


@runtime_checkable
class FollowsCavity(Protocol):
    """An effect that may follow a cavity in the film."""

    @property
    def follows_cavity(self) -> bool:
        """Whether it does."""


def on_face(scene: SeparationScene | SlidingScene) -> bool:
    """Whether the film of a scene is computed as one on a face, up to its rim.

    It is on a face that is no disc, and where a cavity is followed under a sphere, which is a
    crown of the face.
    """
    if not scene.interface.has_discs or scene.interface.is_flat:
        return not scene.interface.has_discs
    return any(isinstance(one, FollowsCavity) and one.follows_cavity for one in scene.effects)


class ClosedForm(NamedTuple):
    """Damping law, over the shortest distance of the faces plus `depth` [m]."""

    law: damping.DampingLaw
    depth: float = 0.0


def shape_of(interface: Interface) -> FaceShape:
    """Shape of the film between the faces of an interface, one of which has a rim.

    Examples
    --------
    >>> import contactkit as ck
    >>> ring = ck.Ring(radius=3e-3, hole_radius=1e-3)
    >>> shape_of(ck.Interface(upper=ck.Flat(planform=ring))).outline == ring
    True
    """
    faces = interface.faces
    outlines = [face.outline for face in faces if face.outline is not None]
    unlike = [one for i, one in enumerate(outlines) if one not in outlines[:i]]
    crowns = sum(1.0 / face.crown_radius for face in faces if face.crown_radius is not None)
    return FaceShape(
        outline=reduce(lambda a, b: a & b, unlike),
        holes=tuple(hole for face in faces for hole in face.holes),
        recesses=tuple(recess for face in faces for recess in face.recesses),
        tilt=(sum(face.tilt[0] for face in faces), sum(face.tilt[1] for face in faces)),
        curvature=interface.curvature + crowns,
        reliefs=tuple(face.relief for face in faces if face.relief is not None),
        roughness=next((face.roughness for face in faces if face.roughness is not None), None),
    )


def closed_form(shape: FaceShape) -> ClosedForm | None:
    """Damping law of a shape in closed form; None where there is none.

    Examples
    --------
    >>> import contactkit as ck
    >>> square = ck.Flat(planform=ck.Rectangle(length=1.0, width=1.0))
    >>> round(closed_form(shape_of(ck.Interface(upper=square))).law.shape_factor, 6)
    0.421731
    """
    body, inner = shape.outline.without_round_holes()
    holes = (*(Vent(shape=disc) for disc in inner), *shape.holes)
    if shape.tilt != (0.0, 0.0) or shape.reliefs or shape.roughness is not None:
        return None
    if shape.is_even and not holes:
        return _even(body)
    if not isinstance(body, Disc):
        return None
    if shape.curvature:
        return _crowned(body, shape) if not holes and not shape.recesses else None
    return _around_the_middle(body, holes, shape.recesses)


def _even(body: Planform) -> ClosedForm | None:
    if isinstance(body, Disc):
        return ClosedForm(damping.disc_damping(body.radius))
    if isinstance(body, Rectangle):
        return ClosedForm(damping.rectangle_damping(body.length, body.width))
    if isinstance(body, Ellipse):
        return ClosedForm(damping.ellipse_damping(body.semi_axes))
    if isinstance(body, Polygon) and len(body.corners) == 3:
        sides = [math.dist(a, b) for a, b in zip(body.corners, _turned(body), strict=True)]
        if max(sides) - min(sides) <= _CONCENTRIC * max(sides):
            return ClosedForm(damping.triangle_damping(sides[0]))
    return None


def _turned(body: Polygon) -> tuple[tuple[float, float], ...]:
    return body.corners[1:] + body.corners[:1]


def _crowned(body: Disc, shape: FaceShape) -> ClosedForm | None:
    """Dome or hollow about the middle of a disc; a hollow one is nearest at its rim."""
    if math.hypot(*body.centre) > _CONCENTRIC * body.radius:
        return None
    law = damping.dome_damping(body.radius, 1.0 / shape.curvature)
    return ClosedForm(law, max(-law.rise, 0.0))


def _around_the_middle(
    body: Disc, holes: tuple[FaceHole, ...], recesses: tuple[Recess, ...]
) -> ClosedForm | None:
    """Disc with one hole, or one recess, about its middle."""
    if len(holes) + len(recesses) != 1:
        return None
    one: FaceHole | Recess = holes[0] if holes else recesses[0]
    if one.shape.circle is None:
        return None
    x, y, radius = one.shape.circle
    if math.dist((x, y), body.centre) > _CONCENTRIC * body.radius or radius >= body.radius:
        return None
    if isinstance(one, Recess):
        return ClosedForm(damping.recess_damping(body.radius, radius, one.depth))
    is_sealed = not isinstance(one, Vent)
    return ClosedForm(damping.ring_damping(body.radius, radius, is_sealed=is_sealed))
