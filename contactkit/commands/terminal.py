"""Printing of results, remarks, progress and times, as much as is asked for."""

from __future__ import annotations

import json
import math
import os
import sys
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import click

from ..extras import missing_extra
from ..reading.texts import printable

__all__ = [
    "QUIET",
    "VERBOSE",
    "error_line",
    "print_files",
    "progress",
    "remark",
    "say",
    "show",
    "timed",
]

QUIET, VERBOSE = "contactkit.quiet", "contactkit.verbose"
"""Entries of the context of a command, set by the options of these names."""


def _is(entry: str) -> bool:
    context = click.get_current_context(silent=True)
    return context is not None and bool(context.meta.get(entry))


def error_line(text: str) -> None:
    """Print an error."""
    click.echo(f"contactkit: {printable(text)}", err=True)


def remark(text: str) -> None:
    """Print a remark beside the results, unless the command is to be quiet."""
    if not _is(QUIET):
        error_line(text)


def say(text: str) -> None:
    """Print a result, unless the command is to be quiet."""
    if not _is(QUIET):
        click.echo(printable(text))


def print_files(what: str, files: Sequence[Path]) -> None:
    """Print names of files."""
    if files:
        say(f"{what}: " + ", ".join(map(str, files)))
        sys.stdout.flush()


@contextmanager
def progress(text: str) -> Iterator[Callable[[float], None]]:
    """Show progress on stderr for whatever takes longer than a second."""
    from tqdm import tqdm

    # A terminal shows a moving bar, a log file a line every ten seconds.
    pause = 0.1 if sys.stderr.isatty() else 10.0
    with (
        timed(text),
        tqdm(
            total=100,
            mininterval=pause,
            maxinterval=pause,
            desc=printable(text),
            delay=1.0,
            leave=False,
            disable=_is(QUIET),
            bar_format="{desc} {bar} {n:.0f} % {elapsed}",
        ) as bar,
    ):

        def update(fraction: float) -> None:
            bar.n = min(100.0 * fraction, 100.0)
            bar.update(0)

        yield update
        if (
            not bar.disable and bar.last_print_t > bar.start_t
        ):  # it was shown: a log file ends with 100 %, too
            bar.n = 100.0
            bar.refresh()


@contextmanager
def timed(what: str) -> Iterator[None]:
    """Print what a step took, wall and CPU time apart, if the command is to be verbose.

    CPU time is that of all threads, and of the processes that ended meanwhile.
    """
    wall, cpu = time.perf_counter(), sum(os.times()[:4])
    try:
        yield
    finally:
        if _is(VERBOSE):
            wall, cpu = time.perf_counter() - wall, sum(os.times()[:4]) - cpu
            remark(f"{what}: {wall:.2f} s wall time, {cpu:.2f} s CPU time")


def show(report: Any, as_json: bool) -> None:
    """Print the numbers, then write the files of them, then draw the pictures."""
    if as_json:
        click.echo(json.dumps(_scalars(report.scalars), indent=2))
    else:
        say(report.text)
    sys.stdout.flush()
    if report.write is not None:
        written = report.write()
        if not as_json:
            print_files("written", written)
    if report.draw is None:
        return
    try:
        with timed("figures"):
            drawn = report.draw()
    except ImportError as error:
        missing = missing_extra(error, "drawing the pictures")
        if missing is None:
            raise
        remark(str(missing))
        return
    if not as_json:
        print_files("drawn", drawn)


def _scalars(scalars: Mapping[str, tuple[Any, str]]) -> dict[str, dict[str, Any]]:
    """Numbers for JSON, which has no nan and no infinity: these become null."""
    return {
        name: {
            "value": None if isinstance(value, float) and not math.isfinite(value) else value,
            "unit": unit,
        }
        for name, (value, unit) in scalars.items()
    }
