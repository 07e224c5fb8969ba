"""``contactkit completion``."""

from __future__ import annotations

import click
from click.shell_completion import get_completion_class

from ..errors import DescriptionError, nearest
from . import options
from .terminal import say

__all__ = ["VARIABLE", "completion"]

VARIABLE = "_CONTACTKIT_COMPLETE"
"""Variable of the environment by which a shell asks for completions."""

_SHELLS = ("bash", "zsh", "fish")


@click.command(cls=options.Command)
@click.argument("shell", type=options.Names(lambda: _SHELLS, files=False))
def completion(shell: str) -> None:
    """Print the completion script of a shell.

    For bash: echo 'eval "$(contactkit completion bash)"' >> ~/.bashrc. SHELL is bash, zsh or fish.
    """
    kind = get_completion_class(shell) if shell in _SHELLS else None
    if kind is None:
        raise DescriptionError("shell", shell, "be a known shell", hint=nearest(shell, _SHELLS))
    root = click.get_current_context().find_root().command
    say(kind(root, {}, "contactkit", VARIABLE).source())
