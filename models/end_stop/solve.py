"""Curve of the faces of a stop that a device file names: the contact is solved once, then kept."""

from __future__ import annotations

import json
from collections.abc import Mapping
from functools import lru_cache
from typing import Any

from ...analyses.load_displacement.curve import StopCurve
from ...analyses.load_displacement.solve import stop_curve
from ...app.contact import PlainContact, open_contact
from ...app.scenes import open_scene
from ...errors import DescriptionError
from .faces import StopFaces

__all__ = ["solved"]


def solved(faces: StopFaces) -> StopCurve:
    """Solve the contact of faces, for their whole area.

    Raises
    ------
    DescriptionError
        If what they name is not a contact scene.
    """
    given = faces.contact
    curve = _curve(json.dumps(given) if isinstance(given, Mapping) else given)
    return curve if faces.area is None else curve.scaled(faces.area / curve.nominal_area)


@lru_cache(maxsize=8)
def _curve(given: str) -> StopCurve:
    opened: Any
    if given.startswith("{"):
        opened = open_contact(json.loads(given), "StopFaces.contact")
    else:
        opened = open_scene(given)
    if not isinstance(opened, PlainContact):
        raise DescriptionError(
            "StopFaces.contact", given, "name a contact scene, with a window and a pressing",
            hint="contact-stop and tip-landing are two of contactkit",
        )  # fmt: skip
    return stop_curve(opened.scene, accuracy=opened.accuracy)
