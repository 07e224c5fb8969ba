"""Load-displacement curve of the faces of an end stop: the contact is solved once, then kept."""

from __future__ import annotations

import json
from collections.abc import Mapping
from functools import lru_cache
from pathlib import Path

from ...analyses.load_displacement.curve import LoadDisplacementCurve
from ...analyses.load_displacement.solve import load_displacement
from ...errors import DescriptionError
from ...files.scenes import read_scene, read_tables, scene_kind
from ...scene.scenes import ContactScene
from ..library import bundled_scene, bundled_scenes
from .faces import StopFaces

__all__ = ["curve_of_scene", "solved"]


def solved(faces: StopFaces) -> LoadDisplacementCurve:
    """Solve the contact of faces, for their whole area.

    Raises
    ------
    DescriptionError
        If what they name is not a contact scene.
    """
    given = faces.contact
    if isinstance(given, Mapping):
        curve = _curve_of(json.dumps(given, default=str), "StopFaces.contact", given.get("name"))
    else:
        curve = curve_of_scene(given)
    return curve if faces.area is None else curve.scaled(faces.area / curve.nominal_area)


def curve_of_scene(name: str) -> LoadDisplacementCurve:
    """Solve a contact scene, for its window.

    Parameters
    ----------
    name : str
        Name of a scene of this package, or a file.

    Raises
    ------
    DescriptionError
        If it is not a contact scene.
    """
    path = Path(name)
    if not path.suffix and (name in bundled_scenes() or not path.exists()):
        path = bundled_scene(name)
    return _curve_of(json.dumps(read_tables(path), default=str), path.name, name)


@lru_cache(maxsize=8)
def _curve_of(text: str, origin: str, name: object) -> LoadDisplacementCurve:
    """Solve a contact scene of tables as JSON, once."""
    tables = json.loads(text)
    if "device" in tables or scene_kind(tables) is not ContactScene:
        raise DescriptionError(
            "StopFaces.contact",
            name,
            "name a contact scene, with a window and a pressing",
            hint="contact-stop and tip-landing are two of contactkit",
        )
    scene, accuracy, _ = read_scene(tables, ContactScene, origin)
    return load_displacement(scene, accuracy=accuracy)
