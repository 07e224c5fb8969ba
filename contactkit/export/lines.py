"""A description in lines: a name, a text, and its own parts."""

from __future__ import annotations

from typing import NamedTuple

__all__ = ["Line"]


class Line(NamedTuple):
    """A part of a scene: its name, what it is, and its own parts."""

    name: str
    text: str
    parts: tuple[Line, ...] = ()

    def indented(self, indent: int = 0) -> list[str]:
        """Lines of text, parts below what they belong to."""
        head = f"{'  ' * indent}{self.name}" + (f"  {self.text}" if self.text else "")
        return [head, *(line for part in self.parts for line in part.indented(indent + 1))]
