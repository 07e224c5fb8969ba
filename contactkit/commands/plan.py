"""``contactkit plan`` and ``contactkit check``, which run nothing."""

from __future__ import annotations

import warnings

import click

from . import options
from .terminal import remark, say, timed
from .work import load

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
    opened = load(scene, settings)
    with warnings.catch_warnings(record=True) as remarks:
        warnings.simplefilter("always")
        title = opened.plan_text().splitlines()[0]
    for one in remarks:
        remark(f"warning: {one.message}")
    say(f"{scene}: no mistakes; {title}")
