"""The page of documentation in a native FMU."""

from __future__ import annotations

import html
from collections.abc import Mapping, Sequence

from ..plan import choices
from ..scene import SeparationScene
from .document import index_page
from .ports import Port, Value

__all__ = ["native_page"]


def native_page(scene: SeparationScene, ports: Sequence[Port], start: Mapping[str, Value]) -> str:
    """HTML page: what the FMU was made from, and its variables."""
    page = index_page("StictionMass", "Mass held by a liquid film", ports, start, ())
    begin, end = page.index("<p>FMI 2.0"), page.index("<p>Parameters")
    made = "".join(f"<li>{html.escape(choices(effect))}</li>" for effect in scene.effects)
    body = (
        "<p>FMI 2.0 for co-simulation, written by contactkit: a C library that needs nothing else. "
        "Its sources are in <code>sources/</code>; <code>resources/film.bin</code> holds the "
        "forces of the film as tables over the gap. All values are in SI units, angles in "
        "radians; the unit in the third column is only for showing.</p>\n"
        f"<p>Made from the scene {html.escape(scene.name or 'without a name')}, with</p>\n"
        f"<ul>{made}</ul>\n"
        f"<p>{html.escape(str(scene.interface))}</p>\n"
    )
    return page[:begin] + body + page[end:]
