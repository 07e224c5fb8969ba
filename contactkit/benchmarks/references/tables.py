"""Content of the files of reference solutions."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import Any

from ...reading.texts import from_json

__all__ = ["reference"]


@cache
def reference(name: str) -> Any:
    """Content of a file of reference solutions.

    Examples
    --------
    >>> sorted(reference("releases"))
    ['A', 'B', 'D', 'E']
    """
    path = Path(__file__).with_name(f"{name}.json")
    return from_json(path.read_text("utf-8"), path.name)
