"""``contactkit cost``."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from . import options
from .work import Job, run_job

__all__ = ["cost"]


@click.command(cls=options.Command)
@options.scene
@options.settings
@options.folder
@click.option(
    "--error", type=float, default=1e-6, help="Relative error to recommend a setting for."
)
@options.overwrite
@options.as_json
def cost(
    scene: str,
    settings: tuple[str, ...],
    out: Path | None,
    error: float,
    overwrite: bool,
    as_json: bool,
) -> None:
    """Measure error against computing time for a scene.

    SCENE is a scene file, or the name of a scene, an accuracy study or a hard case of contactkit.
    """
    job = Job("cost", scene, settings, out, overwrite, as_json)
    study = None if settings else _study(scene)
    run_job(job, lambda opened, progress: opened.cost(out, progress, error), opened=study)


def _study(name: str) -> Any:
    """A study or a hard case of that name, if there is one; a scene has the name otherwise."""
    from ..benchmarks.table import HARD_CASES, STUDIES

    return STUDIES.get(name) or HARD_CASES.get(name)
