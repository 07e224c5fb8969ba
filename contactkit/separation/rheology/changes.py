"""Parts of the rheology of a liquid, and what each of them alone changes the force of a film by."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from .film import RheologicalFilm, flow_law

if TYPE_CHECKING:
    from ...scene.scenes import SeparationScene
    from ..effects.prepared import PreparedScene
    from .face import FaceRheology

__all__ = ["PARTS", "WORTH", "Part", "film_of", "force_change"]

WORTH = 0.01
"""Change of the force that a part is computed for [-]. The neighbours of Reynolds' equation are of
that size: a film 170 times as wide as high loses 1 % at its rim, and 4 K change an oil by 20 %."""


class Part(NamedTuple):
    """A part of the rheology: the field of `Liquid` that has it, and what it is in words."""

    name: str
    words: str


PARTS = (
    Part("pressure_viscosity", "viscosity over pressure"),
    Part("shear_viscosity", "viscosity over shear"),
)


def film_of(
    prepared: PreparedScene[SeparationScene], parts: tuple[str, ...]
) -> RheologicalFilm | FaceRheology:
    """Film of a scene with some parts of the rheology of its liquid, and its slip."""
    if prepared.scene.interface.has_discs or prepared.face_film is None:
        return RheologicalFilm.of(prepared, parts)
    from ..effects.viscous import viscous_film
    from .face import FaceRheology

    law, strength = flow_law(prepared, parts)
    viscosity, shape = prepared.liquid.viscosity, viscous_film(prepared)
    return FaceRheology(prepared.face_film, shape, law, viscosity, strength)


def force_change(
    prepared: PreparedScene[SeparationScene], name: str, path: Sequence[tuple[float, float]]
) -> float:
    """Largest relative change of the force by one part alone, along gaps [m] and speeds [m/s].

    Where the liquid of a scene cavitates, that of the force of the cavitated film.
    """
    moving = [(gap, speed) for gap, speed in path if speed != 0.0]
    if not moving:
        return 0.0
    gaps, speeds = np.array(moving).T
    plain, changed = (film_of(prepared, parts) for parts in ((), (name,)))
    wet = plain.radii(gaps) > 0.0
    before, after = (one.bounded_forces(gaps[wet], speeds[wet]) for one in (plain, changed))
    return float(np.abs(after / before - 1.0).max(initial=0.0))
