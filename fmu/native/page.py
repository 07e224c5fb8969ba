"""The page of documentation in a native FMU."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from attrs import evolve

from ...scene.scenes import SeparationScene
from ..contents.document import Page, index_page
from ..framework.ports import Port, Value
from .models import native_model

__all__ = ["native_page"]

_WITHOUT_FILM = (
    "A C library that needs nothing else. Its sources are in sources/; resources/film.bin holds "
    "what its variables are and, if its stop is rough, the faces as tables over their approach."
)


def native_page(
    scene: SeparationScene | None,
    ports: Sequence[Port],
    start: Mapping[str, Value],
    *,
    name: str = "stiction-mass",
    fmi: str = "2",
    summary: str = "",
) -> str:
    """HTML page: what the FMU was made from, and its variables.

    Parameters
    ----------
    scene : SeparationScene or None
        What the tables were made from; a drive has none.
    ports : sequence of Port
        Variables of the FMU.
    start : mapping
        Their start values.
    name : str
        Name of the FMU.
    fmi : {"2", "3"}
        Version of FMI.
    summary : str
        What it is, if there is more to say than of its model.
    """
    model = native_model(name)
    page = Page.of_native(
        name=name,
        title=model.slave.__name__,
        summary=summary or model.summary,
        ports=ports,
        start=start,
        fmi=fmi,
        scene=scene,
    )
    return index_page(page if scene is not None else evolve(page, needs=_WITHOUT_FILM))
