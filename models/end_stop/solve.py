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
from ..library import bundled_scene
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
    curve = curve_of_scene(json.dumps(given, default=str) if isinstance(given, Mapping) else given)
    return curve if faces.area is None else curve.scaled(faces.area / curve.nominal_area)


@lru_cache(maxsize=8)
def curve_of_scene(given: str) -> LoadDisplacementCurve:
    """Solve a contact scene, for its window.

    Parameters
    ----------
    given : str
        A file, the name of a scene of this package, or the tables of a scene as JSON.

    Raises
    ------
    DescriptionError
        If it is not a contact scene.
    """
    if given.startswith("{"):
        tables, origin = json.loads(given), "StopFaces.contact"
    else:
        path = Path(given)
        if not path.suffix and not path.exists():
            path = bundled_scene(given)
        tables, origin = read_tables(path), path.name
    if "device" in tables or scene_kind(tables) is not ContactScene:
        raise DescriptionError(
            "StopFaces.contact",
            given,
            "name a contact scene, with a window and a pressing",
            hint="contact-stop and tip-landing are two of contactkit",
        )
    scene, accuracy, _ = read_scene(tables, ContactScene, origin)
    return load_displacement(scene, accuracy=accuracy)
