"""``contactkit cite``."""

from __future__ import annotations

from pathlib import Path

import click

from . import options
from .terminal import print_files, say, timed

__all__ = ["cite"]


@click.command(cls=options.Command)
@click.argument("what", metavar="SCENE")
@options.settings
@click.option("--bibtex", is_flag=True, help="Print entries of BibTeX.")
@options.file(".bib", "File to write the entries of BibTeX to.")
@click.option("--overwrite", is_flag=True, help="Replace the file if it exists.")
def cite(
    what: str, settings: tuple[str, ...], bibtex: bool, out: Path | None, overwrite: bool
) -> None:
    """Print the works to cite for a scene or a result.

    SCENE is a scene file or the name of a scene of contactkit, a result file, or the folder of one.
    """
    with timed("sources"):
        from ..app.cite import cited

        found = cited(what, settings)
    if out is not None:
        from ..app.output import check_file
        from ..files.scenes import write_text

        check_file(out, ".bib", overwrite=overwrite)
        write_text(out, found.bibtex())
        print_files("written", [out])
    else:
        say(found.bibtex().rstrip() if bibtex else str(found))
