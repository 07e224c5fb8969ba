"""``contactkit study``."""

from __future__ import annotations

from pathlib import Path

import click

from . import options
from .work import Job, run_job

__all__ = ["study"]


@click.command(cls=options.Command)
@options.scene
@options.settings
@options.folder
@click.option("--workers", type=int, default=1, help="Processes to run points in.")
@click.option(
    "--store",
    type=click.Path(path_type=Path),
    help="Folder of finished points, to continue from.",
)
@click.option(
    "--dimensionless",
    is_flag=True,
    help="In units of the reference scales, such as E* A, in place of SI units.",
)
@options.overwrite
@options.as_json
def study(
    scene: str,
    settings: tuple[str, ...],
    out: Path | None,
    workers: int,
    store: Path | None,
    dimensionless: bool,
    overwrite: bool,
    as_json: bool,
) -> None:
    """Run the study of a scene file, write its columns and a figure.

    SCENE is a scene file with a table [study], or the name of a scene of contactkit.
    """
    from ..app.run.study import StudyOptions

    choices = StudyOptions(workers, store, dimensionless)
    job = Job("study", scene, settings, out, overwrite, as_json)
    run_job(job, lambda opened, progress: opened.study(out, progress, choices))
