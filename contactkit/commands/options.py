"""Arguments and options that several commands take, with their completion."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click
from click.shell_completion import CompletionItem

from ..errors import nearest
from .terminal import QUIET, VERBOSE

__all__ = [
    "TRACEBACK",
    "Command",
    "Group",
    "Names",
    "as_json",
    "cost_names",
    "costed",
    "file",
    "folder",
    "overwrite",
    "scene",
    "settings",
]

if TYPE_CHECKING:
    _Text = click.ParamType[str]
else:  # no generic type before click 8.4
    _Text = click.ParamType

TRACEBACK = "contactkit.traceback"
"""Entry of the context of a command, set by the option of this name."""


def _flag(entry: str, *names: str, help: str) -> click.Option:
    """An option that the context keeps, for what is printed."""

    def keep(context: click.Context, _: click.Parameter, value: bool) -> None:
        context.meta[entry] = value

    return click.Option(names, is_flag=True, expose_value=False, callback=keep, help=help)


def _plugin() -> click.Option:
    """The option that runs a file of own kinds before the command opens a scene."""

    def run(context: click.Context, _: click.Parameter, paths: tuple[Path, ...]) -> None:
        if paths and not context.resilient_parsing:
            from ..app.plugin import load_plugin

            for path in paths:
                load_plugin(path)

    return click.Option(
        ["--plugin"],
        type=click.Path(path_type=Path),
        metavar="FILE.py",
        multiple=True,
        expose_value=False,
        callback=run,
        help="Run a Python file that registers effects or other kinds of yours.",
    )


# Click keeps the help option of the first call, which need not come through the whole command line.
_HELP: dict[str, Any] = {"help_option_names": ["-h", "--help"]}


class Command(click.Command):
    """A command with the options that all commands have."""

    def __init__(self, *args: Any, **more: Any) -> None:
        super().__init__(*args, **more)
        self.context_settings = {**_HELP, **self.context_settings}
        self.params += [
            _plugin(),
            _flag(QUIET, "--quiet", "-q", help="Print errors only, and what --json asks for."),
            _flag(VERBOSE, "--verbose", "-v", help="Print wall and CPU time of each step, too."),
            _flag(TRACEBACK, "--traceback", help="Show the traceback of an error."),
        ]


class Group(click.Group):
    """Commands in the order in which they were added, with the nearest name for one unknown."""

    def __init__(self, *args: Any, **more: Any) -> None:
        super().__init__(*args, **more)
        self.context_settings = {**_HELP, **self.context_settings}

    def list_commands(self, ctx: click.Context) -> list[str]:
        """Names of the commands."""
        return list(self.commands)

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """Find the command that the first argument names."""
        if args and args[0] not in self.commands and not args[0].startswith("-"):
            ctx.fail(f"no command {args[0]!r}; {nearest(args[0], self.commands)}")
        return super().resolve_command(ctx, args)


class Names(_Text):
    """A name of a list, or the path of a file, which the command itself checks."""

    name = "name"

    def __init__(self, known: Callable[[], Iterable[str]], files: bool = True) -> None:
        self._known, self._files = known, files

    def shell_complete(
        self, ctx: click.Context, param: click.Parameter, incomplete: str
    ) -> list[CompletionItem]:
        """Names that begin so, and files."""
        found = [CompletionItem(name) for name in self._known() if name.startswith(incomplete)]
        return [*found, *([CompletionItem(incomplete, type="file")] if self._files else [])]


class _Setting(_Text):
    """A path into the scene of the command, and a value for it."""

    name = "setting"

    def shell_complete(
        self, ctx: click.Context, param: click.Parameter, incomplete: str
    ) -> list[CompletionItem]:
        """Paths that begin so."""
        from ..app.scenes import open_scene
        from ..app.settings import known_paths
        from ..errors import ContactkitError

        # The words before an option without its value are not parsed yet.
        given = [ctx.params.get("scene"), ctx.params.get("what"), *ctx.args]
        try:
            paths = known_paths(open_scene(next(filter(None, given), "")))
        except ContactkitError:  # no scene yet, or none that can be read
            return []
        return [CompletionItem(f"{path}=") for path in paths if path.startswith(incomplete)]


def _scene_names() -> Iterable[str]:
    from ..models.library import bundled_scenes

    return sorted(bundled_scenes())


def cost_names() -> list[str]:
    """Names that `contactkit cost` takes: scenes, accuracy studies, hard cases."""
    from ..benchmarks.table import HARD_CASES, STUDIES

    return sorted([*_scene_names(), *STUDIES, *HARD_CASES])


_PATH: Any = click.Path(path_type=Path)

scene = click.argument("scene", type=Names(_scene_names))
costed = click.argument("scene", type=Names(cost_names))
settings = click.option(
    "--set",
    "settings",
    multiple=True,
    type=_Setting(),
    metavar="PATH=VALUE",
    help="Set a value of the scene, such as loading.force='60 N'; may be given again.",
)
folder = click.option("--out", type=_PATH, help="Folder to write curves and figures to.")
overwrite = click.option(
    "--overwrite", is_flag=True, help="Replace files that contactkit did not write for this scene."
)
as_json = click.option("--json", "as_json", is_flag=True, help="Print only the numbers, as JSON.")


def file(suffix: str, text: str, *, required: bool = False) -> Callable[[Any], Any]:
    """Return the option for a file to write."""
    return click.option("--out", type=_PATH, required=required, metavar=f"FILE{suffix}", help=text)
