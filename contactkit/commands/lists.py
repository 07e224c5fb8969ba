"""``contactkit list`` and ``contactkit new``, which help to write a scene file."""

from __future__ import annotations

from pathlib import Path

import click

from . import options
from .terminal import print_files, say

__all__ = ["list_names", "new"]


def _lists() -> tuple[str, ...]:
    return ("scenes", "liquids", "materials", "effects")


def _kinds() -> tuple[str, ...]:
    from ..app.templates import KINDS

    return KINDS


@click.command("list", cls=options.Command)
@click.argument("what", type=options.Names(_lists, files=False))
def list_names(what: str) -> None:
    """List scenes, liquids, materials or effects by their names."""
    from ..app.listing import listing

    say(listing(what))


@click.command(cls=options.Command)
@click.argument("kind", type=options.Names(_kinds, files=False))
@options.file(".toml", "File to write; else the text is printed.")
@click.option("--overwrite", is_flag=True, help="Replace the file if it exists.")
def new(kind: str, out: Path | None, overwrite: bool) -> None:
    """Write a commented scene file to begin with.

    KIND is contact, separation or sliding: contactkit new separation --out my.toml.
    """
    from ..app.templates import template
    from ..files.scenes import write_text

    text = template(kind)
    if out is None:
        click.echo(text, nl=False)
        return
    from ..app.output import check_file

    check_file(out, ".toml", overwrite=overwrite)
    write_text(out, text)
    print_files("written", [out])
