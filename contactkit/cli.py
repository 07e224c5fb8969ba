"""The command line: ``contactkit run | study | fit | plan | cost | report | fmu`` and helpers."""

from __future__ import annotations

import os
import signal
import sys
import threading
import traceback
import warnings
from collections.abc import Iterator, Sequence
from contextlib import contextmanager

import click
from click.shell_completion import shell_complete

from .commands.completion import VARIABLE
from .commands.group import contactkit
from .commands.options import TRACEBACK
from .commands.terminal import error_line, remark
from .errors import ContactkitError
from .extras import missing_extra

__all__ = ["main"]

# Exit statuses: 128 and the number of the signal, and 70 as in sysexits.h.
_NOT_OURS, _INTERRUPTED, _TERMINATED, _BUG = 2, 130, 143, 70


class _Terminated(KeyboardInterrupt):
    """Termination by the system, which ends a command as an interruption does."""


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line and return its exit status.

    Whatever goes wrong is reported in one line: 2 for what the user can mend, 70 for a defect of
    contactkit, whose traceback ``--traceback`` shows. Help, and a command line that cannot be
    understood, end by `SystemExit`.
    """
    if asked := os.environ.get(VARIABLE):
        return shell_complete(contactkit, {}, "contactkit", VARIABLE, asked)
    context: click.Context | None = None
    try:
        context = contactkit.make_context(
            "contactkit", list(sys.argv[1:] if arguments is None else arguments)
        )
        with context, warnings.catch_warnings(), _ended_by_signal():
            warnings.showwarning = _show_warning
            return int(contactkit.invoke(context) or 0)
    except click.exceptions.Exit as ended:
        raise SystemExit(ended.exit_code) from None
    except click.UsageError as error:
        where = error.ctx.command_path if error.ctx is not None else "contactkit"
        error_line(f"{error.format_message().rstrip('.')}; see {where} --help")
        raise SystemExit(_NOT_OURS) from None
    except BrokenPipeError:  # the reader of a pipe, such as head, has closed it
        sys.stderr.close()
        return 0
    except KeyboardInterrupt as error:
        error_line("interrupted; no incomplete files are left")
        return _TERMINATED if isinstance(error, _Terminated) else _INTERRUPTED
    except Exception as error:
        if context is not None and context.meta.get(TRACEBACK):
            raise
        return _reported(error)


@contextmanager
def _ended_by_signal() -> Iterator[None]:
    """Let SIGTERM, which batch systems send before they kill, end a command in good order."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return

    def end(*_: object) -> None:
        raise _Terminated

    before = signal.signal(signal.SIGTERM, end)
    try:
        yield
    finally:
        signal.signal(signal.SIGTERM, before)


def _reported(error: Exception) -> int:
    """Report an error in one line; return the exit status."""
    if isinstance(error, ImportError):
        error = missing_extra(error, "this command") or error
    if isinstance(error, ContactkitError):
        error_line(str(error))
        return _NOT_OURS
    if isinstance(error, OSError):  # no space, no permission, a folder in place of a file
        error_line(f"{error.strerror or error}: {error.filename or 'a file'}")
        return _NOT_OURS
    if isinstance(error, MemoryError):
        error_line("out of memory; take a coarser grid or fewer planes")
        return _NOT_OURS
    if where := _place_in_plugin(error):
        error_line(f"{where}: {type(error).__name__}: {error}; --traceback shows how it got there")
        return _NOT_OURS
    error_line(
        f"a defect of contactkit, {type(error).__name__}: {error}; please report it with what "
        "the same command prints with --traceback"
    )
    return _BUG


def _place_in_plugin(error: Exception) -> str:
    """File and line of a plugin that raised an error; empty for others."""
    loaded = sys.modules.get(f"{__package__}.app.plugin")
    files = loaded.LOADED if loaded is not None else ()
    frames = traceback.extract_tb(error.__traceback__)
    place = next((one for one in reversed(frames) if one.filename in files), None)
    return f"{place.filename}, line {place.lineno}" if place is not None else ""


def _show_warning(message: Warning | str, *_: object, **__: object) -> None:
    """A warning in one line, without the line of code that issued it."""
    remark(f"warning: {message}")


if __name__ == "__main__":
    sys.exit(main())
