"""FMUs that a page offers: those of its scene as it was built."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator
from pathlib import Path

from ..errors import PlanError
from ..fmu.native.build import build_native
from ..fmu.native.drive import build_native_drive
from ..fmu.slaves.valve_drive import drive_values
from ..models.injector.scene import InjectorScene, end_stop_faces
from ..scene.loading import ImposedForce
from ..scene.scenes import SeparationScene

__all__ = ["fmu_files"]


def fmu_files(scene: SeparationScene | InjectorScene, name: str) -> dict[str, bytes]:
    """Native FMUs of a scene by file name: of an injector its valve and its film.

    Raises
    ------
    PlanError
        If the scene imposes a speed, which no FMU holds.
    ContactkitError
        If a force has no native form, or a compiler is missing.
    """
    with tempfile.TemporaryDirectory(prefix="contactkit-") as folder:
        return {path.name: path.read_bytes() for path in _built(scene, name, Path(folder))}


def _built(scene: SeparationScene | InjectorScene, name: str, folder: Path) -> Iterator[Path]:
    if isinstance(scene, InjectorScene):
        valve, film = scene.valve, scene.separation(scene.temperature)
        curve = end_stop_faces(valve)
        yield build_native_drive(
            folder / f"{name}-valve.fmu", start=drive_values(valve), curve=curve
        )
        yield build_native(film, folder / f"{name}-film.fmu")
        return
    if not isinstance(scene.loading, ImposedForce):
        raise PlanError(
            "the scene imposes a speed, and the FMU of a film moves a mass: leave out the FMU, or "
            'write kind = "imposed-force" with a mass'
        )
    yield build_native(scene, folder / f"{name}.fmu")
