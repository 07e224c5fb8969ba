"""Scenes that a live page can carry, and the numbers that its kernel reads."""

from __future__ import annotations

from attrs import evolve, frozen

from ..accuracy import Accuracy
from ..errors import PlanError
from ..fmu.framework.ports import Port, Value
from ..fmu.native.data import contents_of
from ..fmu.native.film import FINE, PreparedFilm, moving, prepared_film
from ..fmu.native.ports import Model, native_ports
from ..fmu.native.records import FilmTables
from ..fmu.native.tables import Tabulate, tabulate
from ..scene.loading import ImposedForce, ImposedSpeed
from ..scene.scenes import SeparationScene
from ..separation.deforming.effects import ElasticBodies

__all__ = ["MODEL", "KernelScene", "check_scene", "film_of", "kernel_scene"]

MODEL: Model = "stiction-mass"
"""Model of the kernel that a page runs."""

_ANY_MASS = 1.0  # [kg], of a scene whose speed is imposed: nothing is moved


@frozen
class KernelScene:
    """A scene as the kernel of a page reads it."""

    scene: SeparationScene
    film: PreparedFilm
    ports: tuple[Port, ...]
    start: dict[str, Value]

    def numbers(self, tables: FilmTables | None = None) -> list[float]:
        """Numbers of the file of the kernel, with other tables if they are given."""
        made = contents_of(MODEL, self.ports, self.start, tables or self.film.tables)
        return made.numbers()

    def reference(self, name: str) -> int:
        """Value reference of a variable; 0 if the scene leaves it no variable."""
        names = [port.name for port in self.ports]
        return names.index(name) + 1 if name in names else 0


def check_scene(scene: object) -> SeparationScene:
    """Refuse a scene that a page cannot carry.

    Raises
    ------
    PlanError
        With the reason and the cure.
    """
    kind = type(scene).__name__
    if not isinstance(scene, SeparationScene):
        raise PlanError(
            f"a live page holds a separation or a contact, and this is a {kind}; its result as a "
            "page: contactkit run SCENE --out FOLDER, then contactkit report FOLDER"
        )
    loading = scene.loading
    if scene.effect(ElasticBodies) is not None:
        raise PlanError(
            "effects: a live page has films between rigid bodies, and this scene has "
            "elastic-bodies; leave it out, or run the scene by contactkit run"
        )
    if isinstance(loading, ImposedSpeed) and loading.vibration is not None:
        raise PlanError(
            "loading.vibration: a live page opens the gap at one speed; leave the vibration out, "
            "or run the scene by contactkit run"
        )
    if not isinstance(loading, ImposedForce | ImposedSpeed):
        raise PlanError(
            f'loading.kind = "{loading.kind}": a live page imposes a force on a mass, or a speed; '
            'write "imposed-force" or "imposed-speed"'
        )
    if isinstance(loading, ImposedForce) and loading.mass is None:
        raise PlanError(
            "loading.mass [kg] is not given, and the kernel of a live page moves a mass: give it, "
            'such as mass = "20 g"'
        )
    return scene


def film_of(
    scene: SeparationScene, accuracy: Accuracy = FINE, make: Tabulate = tabulate
) -> PreparedFilm:
    """Tables of a scene, moved or not."""
    mass = None if isinstance(scene.loading, ImposedForce) else _ANY_MASS
    return prepared_film(moving(scene, mass), accuracy, make)


def kernel_scene(scene: SeparationScene, accuracy: Accuracy) -> KernelScene:
    """Tables and variables of a scene for the kernel.

    Raises
    ------
    ContactkitError
        If the scene cannot be planned, or a force has no native form.
    """
    film = film_of(scene, evolve(FINE, film_rtol=accuracy.film_rtol))
    ports = native_ports(film.prepared, film.lowest, MODEL, film.force)
    start: dict[str, Value] = {port.name: port.read(port.start) for port in ports}
    start |= {"rtol": accuracy.time_rtol, "max_steps": accuracy.max_steps}
    return KernelScene(scene, film, ports, start)
