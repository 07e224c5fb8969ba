"""``contactkit page``."""

from __future__ import annotations

from pathlib import Path

import click

from . import options
from .terminal import progress, say

__all__ = ["page"]


@click.command(cls=options.Command)
@options.scene
@options.settings
@options.file(".html", "Page to write.", required=True)
@options.overwrite
def page(scene: str, settings: tuple[str, ...], out: Path, overwrite: bool) -> None:
    """Write a live page that computes in a browser.

    It is one HTML file with sliders. SCENE is the opening of a film or a bridge by a force on a
    mass, or at a speed. The page runs the C kernel of the native FMUs as WebAssembly and needs no
    network; building it needs the extra native.
    """
    from ..app.live_page import page_text
    from ..app.output import check_file, enter
    from ..files.scenes import write_text
    from .work import load

    check_file(out, ".html", overwrite=overwrite)
    opened = load(scene, settings)
    with progress(f"page of {opened.name}") as update:
        text = page_text(opened, update)
    write_text(out, text)
    enter(out, "page")
    say(f"{out}: {out.stat().st_size / 1024:.0f} KiB, opens in any browser")
