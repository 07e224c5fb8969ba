"""``contactkit study``."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from . import options
from .terminal import remark
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
@click.option(
    "--stream",
    type=click.Path(path_type=Path),
    metavar="FILE.sqlite",
    help="Write points to this file as they are solved, in bounded memory; continues it.",
)
@click.option(
    "--trials",
    type=click.IntRange(min=0),
    default=0,
    help="Solve this many points only, and estimate time, memory and disk of the study.",
)
@options.overwrite
@options.as_json
def study(
    scene: str,
    settings: tuple[str, ...],
    out: Path | None,
    overwrite: bool,
    as_json: bool,
    **choices: Any,
) -> None:
    """Run the study of a scene file, write its columns and a figure.

    SCENE is a scene file with a table [study], or the name of a scene of contactkit.
    """
    from ..app.study import StudyOptions

    chosen = StudyOptions(**choices)
    if (chosen.stream or chosen.trials) and (
        out or chosen.store or chosen.dimensionless or (chosen.stream and chosen.trials)
    ):
        raise click.UsageError(
            "--stream and --trials write no folder: give one of them alone, without --out, --store "
            "and --dimensionless"
        )
    job = Job("study", scene, settings, out, overwrite, as_json)
    try:
        run_job(job, lambda opened, progress: opened.study(out, progress, chosen))
    except KeyboardInterrupt:
        if not chosen.trials:
            remark(_continued(chosen.stream or chosen.store))
        raise


def _continued(kept: Path | None) -> str:
    """Say whether an interrupted study can go on."""
    if kept is None:
        return "nothing is kept: with --store DIR or --stream FILE.sqlite a study can be continued"
    return f"what is solved is kept in {kept}: the same command continues"
