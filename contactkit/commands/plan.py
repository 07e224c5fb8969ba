"""``contactkit plan`` and ``contactkit check``, which run nothing."""

from __future__ import annotations

import warnings
from pathlib import Path
from typing import TYPE_CHECKING

import click

from . import options
from .terminal import remark, say, timed
from .work import load

if TYPE_CHECKING:
    from ..app.scenes import Opened

__all__ = ["check", "plan"]


@click.command(cls=options.Command)
@options.scene
@options.settings
def plan(scene: str, settings: tuple[str, ...]) -> None:
    """Print the effects of a scene, on and off, and their sources.

    SCENE is a scene file, or the name of a scene of contactkit.
    """
    opened = load(scene, settings)
    with timed("plan"):
        text = opened.plan_text()
    say(text)


@click.command(cls=options.Command)
@options.scene
@options.settings
def check(scene: str, settings: tuple[str, ...]) -> None:
    """Report all mistakes of a scene file, with their lines."""
    opened = _checked(scene, settings)
    with warnings.catch_warnings(record=True) as remarks:
        warnings.simplefilter("always")
        title = opened.plan_text().splitlines()[0]
    for one in remarks:
        remark(f"warning: {one.message}")
    say(f"{scene}: no mistakes; {title}")


def _checked(scene: str, settings: tuple[str, ...]) -> Opened:
    """Open a scene; what its physics refuses is reported with the mistakes of its fields."""
    from ..files.structure import FileError

    try:
        return load(scene, settings)
    except FileError as error:
        path = Path(scene)
        if not path.is_file():  # a scene of contactkit, with settings that are wrong
            raise
        from ..app.check import with_physics

        raise with_physics(path, error) from None
