"""The page of documentation in a native FMU."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from ..scene import SeparationScene
from .document import Page, index_page
from .ports import Port, Value

__all__ = ["native_page"]

_ABOUT = {
    "stiction-mass": ("StictionMass", "Mass held by a liquid film"),
    "stiction-force": ("StictionForce", "Liquid film between two bodies"),
}


def native_page(
    scene: SeparationScene,
    ports: Sequence[Port],
    start: Mapping[str, Value],
    *,
    name: str = "stiction-mass",
    fmi: str = "2",
) -> str:
    """HTML page: what the FMU was made from, and its variables.

    Parameters
    ----------
    scene : SeparationScene
        What the tables were made from.
    ports : sequence of Port
        Variables of the FMU.
    start : mapping
        Their start values.
    name : str
        Name of the FMU.
    fmi : {"2", "3"}
        Version of FMI.
    """
    title, summary = _ABOUT.get(name, (name, ""))
    return index_page(
        Page.of_native(
            name=name, title=title, summary=summary, ports=ports, start=start, fmi=fmi, scene=scene
        )
    )
