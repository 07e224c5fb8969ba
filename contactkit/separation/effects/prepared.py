"""Scene with its liquid at temperature and the shape of its film, given to every effect."""

from __future__ import annotations

import math
from functools import cached_property
from typing import TYPE_CHECKING, Generic, NamedTuple, TypeVar

from attrs import evolve, frozen

from ...accuracy import Accuracy
from ...errors import PlanError
from ...scene.loading import Sliding
from .film_shape import FilmShape, film_shape

if TYPE_CHECKING:
    from ...liquids.liquid import LiquidState
    from ...scene.scenes import SeparationScene, SlidingScene
    from ..face.film import FaceFilm
    from .rheology_view import FilmRheologyView

__all__ = [
    "Angles",
    "Curvatures",
    "PreparedScene",
    "checked_liquid",
    "prepare_scene",
    "with_fraction",
]

S_co = TypeVar("S_co", bound="SeparationScene | SlidingScene", covariant=True)


class Angles(NamedTuple):
    """Contact angles on the two bodies [rad]."""

    lower: float
    upper: float


class Curvatures(NamedTuple):
    """Curvatures of the two bodies [1/m]."""

    lower: float
    upper: float


@frozen(eq=False)
class PreparedScene(Generic[S_co]):
    """A scene whose liquid is evaluated at its temperature and whose film has its shape.

    `liquid` gives each property that the listed effects need; `film` is the shape of one film.
    `liquid_pressure` is that of the liquid [Pa], given or of its relative humidity; None for a
    volume.
    """

    scene: S_co
    accuracy: Accuracy
    liquid: LiquidState
    film: FilmShape
    liquid_pressure: float | None
    rheology: FilmRheologyView | None = None
    """Rheology of the film, which a plan adds; None for a Newtonian liquid that does not slip."""

    @property
    def angles(self) -> Angles:
        """Contact angles [rad]."""
        meniscus = self.scene.meniscus
        return Angles(meniscus.contact_angle_lower, meniscus.contact_angle_upper)

    @property
    def curvatures(self) -> Curvatures:
        """Curvatures of the bodies [1/m]."""
        return Curvatures(*self.scene.interface.curvatures)

    @cached_property
    def face_film(self) -> FaceFilm | None:
        """Full film on a face up to its rim (`on_face`); None between discs and under spheres."""
        from ..face.shape import on_face, shape_of

        loading = self.scene.loading
        if isinstance(loading, Sliding) or not on_face(self.scene):
            return None
        from ..face.film import face_film

        gaps = loading.smallest_gap, loading.final_gap
        return face_film(shape_of(self.scene.interface), gaps, self.accuracy.film_rtol)

    @property
    def wetting(self) -> float:
        """Sum of the cosines of both contact angles [-]."""
        return sum(map(math.cos, self.angles))


def with_fraction(
    prepared: PreparedScene[SeparationScene], fraction: float
) -> PreparedScene[SeparationScene]:
    """Scene with a fraction of its volume, such as what re-wets of it; a flooded one as it is."""
    scene = prepared.scene
    meniscus = scene.meniscus
    if fraction == 1.0 or meniscus.volume is None:
        return prepared
    less = evolve(meniscus, volume=fraction * meniscus.volume)
    scene = evolve(scene, interface=evolve(scene.interface, meniscus=less))
    made = prepare_scene(scene, prepared.accuracy, prepared.liquid)
    rheology = prepared.rheology
    return made if rheology is None else evolve(made, rheology=rheology.again(made))


S = TypeVar("S", bound="SeparationScene | SlidingScene")


def checked_liquid(scene: SeparationScene) -> LiquidState:
    """Liquid of a scene at its temperature, with all that the effects need of it.

    For analyses that do not run the scene, and so do not plan it.

    Raises
    ------
    PlanError
        Naming each effect and the property of the liquid that it needs.
    """
    liquid = scene.meniscus.liquid.at(scene.temperature)
    missing = [
        f"{type(effect).__name__} needs {item}"
        for effect in scene.effects
        for item in liquid.missing(*effect.liquid_needs(scene))
    ]
    if missing:
        raise PlanError("; ".join(missing))
    return liquid


def prepare_scene(
    scene: S, accuracy: Accuracy | None = None, liquid: LiquidState | None = None
) -> PreparedScene[S]:
    """Evaluate the liquid of a scene at its temperature, if not known, and the shape of its film.

    Raises
    ------
    DescriptionError
        If the liquid does not give what its pressure or the shape of the film depends on.
    """
    if liquid is None:
        liquid = scene.meniscus.liquid.at(scene.temperature)
    pressure = scene.meniscus.pressure_of(liquid)
    film = film_shape(scene, liquid, pressure)
    return PreparedScene(scene, accuracy or Accuracy.standard, liquid, film, pressure)
