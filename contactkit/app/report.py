"""Report of a run."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

__all__ = ["Report"]


class Report(NamedTuple):
    """Report of a run: numbers with their units, and text to read.

    `write` writes the files of numbers, then `draw` the pictures; each returns its files. They are
    called after the numbers have been printed, which a full disk then does not take away. None
    without a folder to write to.
    """

    scalars: Mapping[str, tuple[Any, str]]
    text: str
    write: Callable[[], Sequence[Path]] | None = None
    draw: Callable[[], Sequence[Path]] | None = None
