"""``contactkit run``."""

from __future__ import annotations

from pathlib import Path

import click

from ..errors import DescriptionError
from . import options
from .work import Job, run_job

__all__ = ["run"]


@click.command(cls=options.Command)
@options.scene
@options.settings
@options.folder
@click.option("--report", is_flag=True, help="Write report.html, a page about the result, too.")
@options.overwrite
@options.as_json
def run(
    scene: str,
    settings: tuple[str, ...],
    out: Path | None,
    report: bool,
    overwrite: bool,
    as_json: bool,
) -> None:
    """Run a scene, print its numbers, write its curves and figures.

    SCENE is a scene file, or the name of a scene of contactkit.
    """
    if report and out is None:
        raise DescriptionError("--report", "", "come with --out, the folder to write to")
    job = Job("run", scene, settings, out, overwrite, as_json)
    run_job(job, lambda opened, progress: opened.run(out, progress), page=report)
