"""What a run leaves behind."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any, NamedTuple

__all__ = ["Report"]


class Report(NamedTuple):
    """What a run leaves: numbers with their units, text to read, files written."""

    scalars: Mapping[str, tuple[Any, str]]
    text: str
    files: tuple[Path, ...] = ()
