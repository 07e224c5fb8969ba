"""Live page of a scene that the command line opened."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from ..accuracy import Accuracy
from ..live_page.page import live_page

__all__ = ["page_text"]


def page_text(opened: Any, progress: Callable[[float], None], *, fmu: bool = False) -> str:
    """Return the text of the page of an opened scene, with the accuracy of its file.

    With `fmu` it holds the native FMU of the scene.

    Raises
    ------
    PlanError
        If a page cannot carry it, with the reason and the cure.
    """
    accuracy = getattr(opened, "accuracy", Accuracy.standard)
    return live_page(opened.scene, accuracy, progress, fmu=fmu)
