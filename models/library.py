"""Scenes that come with contactkit, by name."""

from __future__ import annotations

from pathlib import Path

from ..errors import DescriptionError, nearest

__all__ = ["bundled_scene", "bundled_scenes"]


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
