"""Lines of text: a description with its own parts, and rows of a table."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

__all__ = ["Line", "aligned"]


class Line(NamedTuple):
    """A part of a scene: its name, what it is, and its own parts."""

    name: str
    text: str
    parts: tuple[Line, ...] = ()

    def indented(self, indent: int = 0) -> list[str]:
        """Lines of text, parts below what they belong to."""
        head = f"{'  ' * indent}{self.name}" + (f"  {self.text}" if self.text else "")
        return [head, *(line for part in self.parts for line in part.indented(indent + 1))]


def aligned(rows: Sequence[Sequence[str]]) -> list[str]:
    """Rows of cells as lines whose columns begin below each other.

    Examples
    --------
    >>> aligned([("path", "value"), ("loading.force", "1 N")])
    ['path           value', 'loading.force  1 N']
    """
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    lines = ("  ".join(map(str.ljust, row, widths)) for row in rows)
    return [line.rstrip() for line in lines]
