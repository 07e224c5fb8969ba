"""``contactkit cost``."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import click

from ..errors import DescriptionError, nearest
from . import options
from .work import Job, run_job

__all__ = ["cost"]


@click.command(cls=options.Command)
@options.costed
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
    study = _study(scene, settings)
    run_job(job, lambda opened, progress: opened.cost(out, progress, error), opened=study)


def _study(name: str, settings: Sequence[str]) -> Any:
    """A study or a hard case of that name, if there is one; a scene has the name otherwise."""
    from ..benchmarks.table import HARD_CASES, STUDIES

    known = {**STUDIES, **HARD_CASES}
    if name in known and settings:
        cure = "settings are of a scene; a study brings its own"
        raise DescriptionError("--set", settings[0], "be left out", hint=cure)
    if name not in (names := options.cost_names()) and not _is_path(name):
        expected = "be a file, or the name of a scene, an accuracy study or a hard case"
        raise DescriptionError("scene", name, expected, hint=nearest(name, names))
    return known.get(name)


def _is_path(name: str) -> bool:
    """Whether a file is meant, as `open_scene` takes it."""
    return bool(Path(name).suffix) or Path(name).exists()
