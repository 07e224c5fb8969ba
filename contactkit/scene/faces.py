"""Holes and recesses of a face."""

from __future__ import annotations

from typing import ClassVar

from attrs import field, frozen

from ..units import si
from ..validators import Described, non_negative, part, positive
from .planforms import Planform

__all__ = ["FaceHole", "Recess", "SealedHole", "Vent"]


@frozen(kw_only=True)
class FaceHole(Described):
    """A hole in a face. Its kind is its name in files, under ``kind``."""

    family: ClassVar[str] = "face hole"
    kind: ClassVar[str]

    shape: Planform = field(validator=part(Planform))


@frozen(kw_only=True)
class Vent(FaceHole):
    """A hole that is open to the surroundings.

    Parameters
    ----------
    shape : Planform
        Its outline; a `Disc` may be as small as one likes.
    """

    kind: ClassVar[str] = "vent"


@frozen(kw_only=True)
class SealedHole(FaceHole):
    """A blind hole full of liquid: one pressure, which follows from the flow into it.

    Parameters
    ----------
    shape : Planform
        Its outline; a `Disc` may be as small as one likes.
    volume : float
        Volume of liquid in it beyond that of the gap [m3], which a cavity may empty.

    Notes
    -----
    Its pressure acts on its area, which counts to the force.
    """

    kind: ClassVar[str] = "sealed-hole"

    volume: float = field(default=0.0, validator=non_negative, metadata=si("m3"))


@frozen(kw_only=True)
class Recess(Described):
    """A region of a face that is deeper than the rest: a groove, a dimple, a pocket with a floor.

    Parameters
    ----------
    shape : Planform
        Its outline.
    depth : float
        Depth below the face [m].
    """

    shape: Planform = field(validator=part(Planform))
    depth: float = field(validator=positive, metadata=si("m"))
