"""Report of a run."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

__all__ = ["Report"]


class Report(NamedTuple):
    """Report of a run: numbers with their units, text to read, files written.

    `draw` writes the pictures, after the numbers are safe, and returns their files; None without
    a folder to write to.
    """

    scalars: Mapping[str, tuple[Any, str]]
    text: str
    files: tuple[Path, ...] = ()
    draw: Callable[[], Sequence[Path]] | None = None
