"""Report of a run."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any, NamedTuple

__all__ = ["Report"]


class Report(NamedTuple):
    """Report of a run: numbers with their units, text to read, files written."""

    scalars: Mapping[str, tuple[Any, str]]
    text: str
    files: tuple[Path, ...] = ()
