"""Cost of accuracy of a scene, by its kind: table, numbers, picture and CSV file."""

from __future__ import annotations

from collections.abc import Callable
from functools import singledispatch
from pathlib import Path

from ..accuracy import Accuracy
from ..errors import PlanError
from ..export.report import Report
from ..scene.scenes import ContactScene, Scene, SeparationScene

__all__ = ["scene_cost"]

Progress = Callable[[float], None]


@singledispatch
def scene_cost(
    scene: Scene, accuracy: Accuracy, out: Path | None, progress: Progress, error: float
) -> Report:
    """Measure the error of a scene over what it costs, and recommend a setting for an error.

    Raises
    ------
    PlanError
        If the error of such a scene does not depend on a setting.
    """
    kind = type(scene).__name__.removesuffix("Scene").lower()
    raise PlanError(f"cost has nothing to weigh: a {kind} is closed form or one quadrature")


@scene_cost.register
def _(
    scene: SeparationScene, accuracy: Accuracy, out: Path | None, progress: Progress, error: float
) -> Report:
    from .report import cost_report
    from .separation import separation_sweep

    title = scene.name or "separation"
    return cost_report(separation_sweep(scene, progress), out, error, title)


@scene_cost.register
def _(
    scene: ContactScene, accuracy: Accuracy, out: Path | None, progress: Progress, error: float
) -> Report:
    from .contact import contact_cost

    return contact_cost(scene, accuracy, out, progress, error)
