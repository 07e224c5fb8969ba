"""FMUs that a page offers: those of its scene as it was built."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator
from pathlib import Path

from ..errors import PlanError
from ..fmu.native.build import build_native
from ..fmu.native.drive import build_native_drive
from ..fmu.native.tip import build_native_tip
from ..fmu.slaves.tip_contact import tip_values
from ..fmu.slaves.valve_drive import drive_values
from ..models.injector.scene import InjectorScene, end_stop_faces
from ..models.micromirror.scene import MicromirrorScene
from ..models.micromirror.tip_film import tip_scene
from ..scene.loading import ImposedForce
from ..scene.scenes import SeparationScene

__all__ = ["PageScene", "check_fmu", "fmu_files"]

PageScene = SeparationScene | InjectorScene | MicromirrorScene
"""What a live page can hold."""


def check_fmu(scene: PageScene) -> None:
    """Refuse a scene whose film no FMU holds.

    Raises
    ------
    PlanError
        If the scene imposes a speed.
    """
    is_device = isinstance(scene, InjectorScene | MicromirrorScene)
    if not is_device and not isinstance(scene.loading, ImposedForce):
        raise PlanError(
            "the scene imposes a speed, and the FMU of a film moves a mass: leave out the FMU, or "
            'write kind = "imposed-force" with a mass'
        )


def fmu_files(scene: PageScene, name: str) -> dict[str, bytes]:
    """Native FMUs of a scene by file name.

    Of an injector its valve and its film, of a micromirror the tips of a side.

    Raises
    ------
    ContactkitError
        If a force has no native form, or a compiler is missing.
    """
    with tempfile.TemporaryDirectory(prefix="contactkit-") as folder:
        return {path.name: path.read_bytes() for path in _built(scene, name, Path(folder))}


def _built(scene: PageScene, name: str, folder: Path) -> Iterator[Path]:
    if isinstance(scene, InjectorScene):
        valve, film = scene.valve, scene.separation(scene.temperature)
        curve = end_stop_faces(valve)
        yield build_native_drive(
            folder / f"{name}-valve.fmu", start=drive_values(valve), curve=curve
        )
        yield build_native(film, folder / f"{name}-film.fmu")
        return
    if isinstance(scene, MicromirrorScene):
        tips = scene.mirror.tips
        values = tip_values(tip_scene(scene.tip, scene.study.humidity))
        values |= {"N": tips.per_side, "c": tips.damping}
        yield build_native_tip(folder / f"{name}-tips.fmu", start=values)
        return
    yield build_native(scene, folder / f"{name}.fmu")
