"""FMUs for every platform, built once for all tests and workers."""

from __future__ import annotations

import fmpy
from drive_faces import ball
from native_scenes import DROP, scene

from contactkit.benchmarks.releases import release_scene
from contactkit.fmu.framework.toolchain import PLATFORMS
from contactkit.fmu.native.build import build_native
from contactkit.fmu.native.drive import build_native_drive
from contactkit.fmu.native.tip import build_native_tip

__all__ = ["LIBRARIES", "every_fmu", "library_of"]

EVERY = {"platforms": list(PLATFORMS), "compiler": "zig"}
LIBRARIES = [(name, fmi) for name in PLATFORMS for fmi in (2, 3)]


def build_all(folder):
    """FMUs of all platforms: cases A and B with the mass inside, a film alone, a drive, tips."""
    film = scene(gap=5e-6, volume=DROP)
    for fmi in (2, 3):
        for name in "AB":
            path = folder / f"mass-{name}-{fmi}.fmu"
            build_native(release_scene(name), path, fmi=fmi, **EVERY)
        build_native(film, folder / f"film-{fmi}.fmu", model="stiction-force", fmi=fmi, **EVERY)
        build_native_drive(folder / f"drive-{fmi}.fmu", fmi=fmi, **EVERY)
        tip = folder / f"tip-{fmi}.fmu"
        build_native_tip(tip, start={"V": 1.3e-24}, curve=ball(), fmi=fmi, **EVERY)
    for path in folder.glob("*.fmu"):
        fmpy.extract(str(path), str(path.with_suffix("")))


def every_fmu(shelf):
    """Folder of the FMUs for every platform, packed and unpacked."""
    return shelf.folder("platforms", build_all)


def library_of(fmus, name, fmi, fmu="mass-A"):
    place = PLATFORMS[name]
    folder = fmus / f"{fmu}-{fmi}" / "binaries" / (place.fmi3 if fmi == 3 else place.fmi2)
    (path,) = folder.glob(f"*{place.suffix}")
    return path
