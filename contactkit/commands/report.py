"""``contactkit report``."""

from __future__ import annotations

from pathlib import Path

import click

from . import options
from .terminal import say

__all__ = ["report"]


@click.command(cls=options.Command)
@click.argument("result", type=click.Path(path_type=Path))
@options.file(".html", "File to write; else report.html in the folder, or beside the result.")
@options.overwrite
def report(result: Path, out: Path | None, overwrite: bool) -> None:
    """Write a page of HTML about a result.

    It holds figures, numbers, validity, plan and sources, and needs no network and no script.
    RESULT is a result file, or a folder that contactkit run, study or cost wrote to.
    """
    from ..app.output import check_file, enter
    from ..app.report_page import PAGE, report_page
    from ..files.scenes import write_text

    path = out or (result / PAGE if result.is_dir() else result.with_suffix(".html"))
    check_file(path, ".html", overwrite=overwrite)
    say(str(write_text(path, report_page(result))))
    enter(path, "report")
