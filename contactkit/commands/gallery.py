"""``contactkit gallery``."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from . import options
from .terminal import say

if TYPE_CHECKING:
    from ..app.gallery.run import PageOutcome

__all__ = ["gallery"]


@click.command(cls=options.Command)
@click.argument("names", nargs=-1, metavar="[NAME]...")
@click.option(
    "--out",
    type=click.Path(path_type=Path),
    default=Path("out/gallery"),
    help="Folder to write to, and continue in.",
)
@click.option("--quick", is_flag=True, help="Small sizes: a draft.")
@click.option("--list", "only_list", is_flag=True, help="List the pages and exit.")
@options.overwrite
def gallery(
    names: tuple[str, ...], out: Path, quick: bool, only_list: bool, overwrite: bool
) -> int:
    """Compute figures and tables of the source, and judge them.

    NAME is a page such as 2.9, a chapter such as chapter_2, or the file of a script; all pages
    if none is given. The exit status is 1 if a check does not hold, 2 if a page cannot be made.
    """
    from ..app.gallery.run import exit_status, run_gallery
    from ..app.gallery.scripts import chosen
    from ..app.output import Command, written_to

    pages = chosen(list(names))
    if only_list:
        for one in pages:
            say(f"{one.page.name:<12} {one.chapter:<10} {one.page.title}")
        return 0
    ended: list[PageOutcome] = []

    def tell(outcome: PageOutcome) -> None:
        ended.append(outcome)
        say(f"[{len(ended)}/{len(pages)}] {outcome}")

    with written_to(out, Command("gallery", "the gallery"), overwrite=overwrite):
        made = run_gallery(pages, out, draft=quick, report=tell)
    counts = {
        "with a check that does not hold": sum(bool(one.failed) for one in made),
        "that could not be made": sum(bool(one.error) for one in made),
    }
    found = ", ".join(f"{n} {what}" for what, n in counts.items() if n)
    say(f"{out / 'index.md'}: {len(made)} pages, {found or 'all checks hold'}")
    return exit_status(made)
