"""Rough end-stop faces, as the file of a device names them; solved by `end_stop.solve`."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from attrs import Attribute, field, frozen

from ...errors import DescriptionError
from ...units import si
from ...validators import optional, positive

__all__ = ["StopFaces"]


def _contact(owner: object, attribute: Attribute[Any], value: Any) -> None:
    if isinstance(value, Mapping | str) and value:
        return
    raise DescriptionError(
        f"StopFaces.{attribute.name}",
        value,
        "be a contact scene: its file, its name, or its tables",
        hint="for example contact = 'contact-stop', or a table [...faces.contact]",
    )


@frozen(kw_only=True)
class StopFaces:
    """Rough faces that meet at a stop.

    Parameters
    ----------
    contact : str or mapping
        The contact scene: a file (from the folder of the file that names it), the name of a scene
        of contactkit, or its tables. What it imposes is where its curve ends.
    area : float, optional
        Nominal area of the faces [m2]; the window of the contact scene if not given.
    """

    contact: Any = field(validator=_contact)
    area: float | None = field(default=None, validator=optional(positive), metadata=si("m2"))
