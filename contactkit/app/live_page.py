"""Live page of a scene that the command line opened, or of a saved result."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from attrs import frozen

from ..accuracy import Accuracy
from ..contact.result import ContactResult
from ..errors import DescriptionError
from ..files.results import load_result
from ..live_page.page import live_page
from ..scene.scenes import ContactScene
from ..studies.paths import axes
from .scenes import open_scene
from .settings import with_settings

__all__ = ["PageSource", "open_page"]

_RESULT = "result.npz"


@frozen
class PageSource:
    """Source of a page: a scene or a solved contact, with accuracy, loads and FMU."""

    name: str
    shown: Any
    accuracy: Accuracy | None = None
    loads: int | Sequence[float] | None = None
    fmu: bool = False

    def text(self, progress: Callable[[float], None]) -> str:
        """Return the text of the page.

        Raises
        ------
        PlanError
            If a page cannot carry it, with the reason and the cure.
        """
        return live_page(self.shown, self.accuracy, progress, loads=self.loads, fmu=self.fmu)


def open_page(
    source: str, settings: Sequence[str] = (), loads: int | None = None, *, fmu: bool = False
) -> PageSource:
    """Open a scene by file or name, a result file, or the folder of one.

    Parameters
    ----------
    source : str
        A scene file or name, ``*.npz``, or a folder that holds ``result.npz``.
    settings : sequence of str
        Texts ``path=value`` for a scene.
    loads : int, optional
        How many loads of a contact; None: those that the study of its file varies, if it does.
    fmu : bool
        Whether the page holds the native FMU of the scene.

    Raises
    ------
    DescriptionError
        If there is no such file, or a saved result comes with settings.
    """
    path = Path(source)
    if path.is_dir() or path.suffix == ".npz":
        return _of_result(path / _RESULT if path.is_dir() else path, settings, loads, fmu)
    opened = with_settings(open_scene(source), settings)
    scene = opened.scene
    accuracy = getattr(opened, "accuracy", Accuracy.standard)
    wanted: int | Sequence[float] | None = loads
    if loads is None and isinstance(scene, ContactScene):
        wanted = _studied(scene, accuracy, getattr(opened, "parameters", {}))
    return PageSource(opened.name, scene, accuracy, wanted, fmu)


def _studied(scene: ContactScene, accuracy: Accuracy, parameters: Any) -> Sequence[float] | None:
    """Loads that the study of a scene file varies."""
    path = f"loading.{scene.loading.quantity.name}"
    if path not in parameters:
        return None
    (axis,) = axes(scene, accuracy, {path: parameters[path]})
    return [float(row[0]) for row in axis.values]


def _of_result(path: Path, settings: Sequence[str], loads: int | None, fmu: bool) -> PageSource:
    """A solved contact as it is; of a separation the scene, which the page computes again."""
    if settings:
        raise DescriptionError("--set", settings[0], f"be left out for the saved result {path}")
    result = load_result(path)
    name = result.plan.scene.name or result.plan.title
    if isinstance(result, ContactResult):
        return PageSource(name, result, loads=loads, fmu=fmu)
    return PageSource(name, result.plan.scene, result.plan.accuracy, loads, fmu)
