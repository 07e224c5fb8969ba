"""``contactkit list``, ``new`` and ``schema``, which help to write a scene file."""

from __future__ import annotations

from pathlib import Path

import click

from . import options
from .terminal import print_files, say

__all__ = ["list_names", "new", "schema"]


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

    _write(template(kind), out, ".toml", overwrite)


@click.command(cls=options.Command)
@options.file(".json", "File to write; else the text is printed.")
@click.option("--overwrite", is_flag=True, help="Replace the file if it exists.")
def schema(out: Path | None, overwrite: bool) -> None:
    """Write the JSON Schema of scene files, for editors.

    With the line #:schema ./scene.schema.json at its head, a scene file is completed and checked
    by Taplo (Even Better TOML in VS Code) and others. Kinds of --plugin are in it.
    """
    import json

    from ..files.schema import scene_schema
    from ..models.library import device_kinds

    made = scene_schema(device_kinds())
    _write(json.dumps(made, indent=1, ensure_ascii=False) + "\n", out, ".json", overwrite)


def _write(text: str, out: Path | None, suffix: str, overwrite: bool) -> None:
    """Write a text to a file, or print it."""
    if out is None:
        click.echo(text, nl=False)
        return
    from ..app.output import check_file
    from ..files.scenes import write_text

    check_file(out, suffix, overwrite=overwrite)
    write_text(out, text)
    print_files("written", [out])
