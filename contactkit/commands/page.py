"""``contactkit page``."""

from __future__ import annotations

from pathlib import Path

import click

from . import options
from .terminal import progress, say, timed

__all__ = ["page"]


@click.command(cls=options.Command)
@options.scene
@options.settings
@click.option(
    "--loads",
    type=click.IntRange(1),
    metavar="N",
    help="Loads of a contact, each half of the next; else those of its study, or 6.",
)
@options.file(".html", "Page to write.", required=True)
@click.option("--fmu", is_flag=True, help="Put the FMU of the scene into the page, 0.8 MB.")
@options.overwrite
def page(
    scene: str,
    settings: tuple[str, ...],
    loads: int | None,
    out: Path,
    fmu: bool,
    overwrite: bool,
) -> None:
    """Write a live page that opens in a browser.

    It is one HTML file that needs no network. SCENE is the opening of a film or a bridge by a
    force on a mass, or at a speed, or a device (fuel-injector, micromirror): the page has sliders
    and runs the C kernel of the native FMUs as WebAssembly; building it needs the extra native. Or
    SCENE is a contact: the page has its maps over load and depth, with sections. Instead of a scene
    it may be a saved result, or the folder of one.
    """
    from ..app.live_page import open_page
    from ..app.output import check_file, enter
    from ..files.scenes import write_text

    check_file(out, ".html", overwrite=overwrite)
    with timed("imports and scene"):
        opened = open_page(scene, settings, loads, fmu=fmu)
    with progress(f"page of {opened.name}") as update:
        text = opened.text(update)
    write_text(out, text)
    enter(out, "page")
    say(f"{out}: {out.stat().st_size / 1024:.0f} KiB, opens in any browser")
