"""Scenes that come with contactkit, and the kinds of devices, by name."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from .._lazy import named
from ..errors import DescriptionError, nearest

if TYPE_CHECKING:
    from .device import Device

__all__ = [
    "bundled_device",
    "bundled_scene",
    "bundled_scenes",
    "device_kind",
    "device_kinds",
    "register_device",
]

# Class of each device by the name that it has in files, ``device = "fuel-injector"``; imported when
# it is named.
_DEVICES = {
    "bridges": f"{__package__}.liquid_bridges.scene:Bridges",
    "fuel-injector": f"{__package__}.injector.scene:InjectorScene",
    "micromirror": f"{__package__}.micromirror.scene:MicromirrorScene",
}


def device_kind(name: object) -> type[Device]:
    """Return the class of a device by its name in files.

    Raises
    ------
    DescriptionError
        If there is none of that name.
    """
    if not isinstance(name, str) or name not in _DEVICES:
        hint = nearest(name, sorted(_DEVICES))
        raise DescriptionError("device", name, "be a known device", hint=hint)
    found: type[Device] = named(_DEVICES[name])
    return found


def device_kinds() -> dict[str, type[Device]]:
    """Classes of all devices by their names in files."""
    return {name: device_kind(name) for name in _DEVICES}


def register_device(name: str, kind: str) -> None:
    """Register a device of one's own: its name in files, and its class as ``module:class``.

    Raises
    ------
    DescriptionError
        If another device has the name.
    """
    if _DEVICES.get(name, kind) != kind:
        raise DescriptionError("register_device(name)", name, "be new", hint=_DEVICES[name])
    _DEVICES[name] = kind


def bundled_scenes() -> dict[str, Path]:
    """Scene files of this package by the names of their scenes."""
    files = Path(__file__).parent.glob("*/*.toml")
    return {path.stem.replace("_", "-"): path for path in sorted(files)}


def bundled_scene(name: str) -> Path:
    """Path of a scene file of this package, such as ``fuel-injector``.

    Raises
    ------
    DescriptionError
        If there is none of that name.
    """
    scenes = bundled_scenes()
    if name not in scenes:
        hint = nearest(name, sorted(scenes)) + "; or give the path of a .toml file"
        raise DescriptionError("scene", name, "be a file or the name of a scene", hint=hint)
    return scenes[name]


def bundled_device(name: str) -> Device:
    """Read a device of this package, such as ``fuel-injector``.

    Raises
    ------
    DescriptionError
        If there is none of that name.
    """
    from ..files.scenes import read_tables
    from ..files.structure import structure

    path = bundled_scene(name)
    tables = read_tables(path)
    return structure(tables, device_kind(tables.pop("device", None)), path.name)
