"""``contactkit fit``."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from . import options
from .work import Job, run_job

__all__ = ["fit"]


@click.command(cls=options.Command)
@options.scene
@options.settings
@click.option(
    "--data",
    type=click.Path(path_type=Path),
    required=True,
    metavar="FILE.csv",
    help="Measured curve: columns with units in their heads, such as 'gap [um]'.",
)
@click.option(
    "--over",
    required=True,
    metavar="NAME[=COLUMN]",
    help="What it is over: a column of the result, such as gap, or a path, such as temperature.",
)
@click.option(
    "--quantity",
    required=True,
    metavar="NAME[=COLUMN]",
    help="What was measured: a column of the result, or over a path a number of it.",
)
@click.option(
    "--parameter",
    "parameters",
    multiple=True,
    required=True,
    metavar="PATH=LOW..HIGH",
    help="What is sought, such as loading.speed='1 um/s..10 um/s'; also shift, zero, scale and "
    "stiffness of the instrument. May be given again.",
)
@click.option("--noise", help="Standard deviation of a reading, such as '2 %'; else estimated.")
@click.option(
    "--branch",
    type=click.Choice(["rising", "falling"]),
    help="Part of a result whose axis turns back.",
)
@click.option("--workers", type=int, default=1, help="Processes to make runs in.")
@options.folder
@options.overwrite
@options.as_json
def fit(
    scene: str,
    settings: tuple[str, ...],
    out: Path | None,
    overwrite: bool,
    as_json: bool,
    **choices: Any,
) -> None:
    """Fit parameters of a scene to a measured curve.

    SCENE is a scene file, or the name of a scene of contactkit.
    """
    from ..app.fit import FitOptions

    chosen = FitOptions(**choices)
    job = Job("fit", scene, settings, out, overwrite, as_json)
    run_job(job, lambda opened, progress: opened.fit(out, progress, chosen))
