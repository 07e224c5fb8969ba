"""Tables and lists as HTML, for notebooks and pages."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from html import escape

from ..units import quantity_text
from .lines import Line

__all__ = ["effects_table", "nested_list", "numbers_table", "table"]


def numbers_table(title: str, numbers: Mapping[str, tuple[float, str]]) -> str:
    """Numbers with their units, under a line of text.

    Examples
    --------
    >>> numbers_table("released", {"peak_force": (16.2, "N")})
    '<p>released</p><table><tr><td>peak force</td><td>16.2 N</td></tr></table>'
    """
    rows = [(name.replace("_", " "), quantity_text(v, unit)) for name, (v, unit) in numbers.items()]
    return f"<p>{escape(title)}</p>{table(rows)}"


def effects_table(
    title: str, on: Sequence[tuple[str, str]], off: Sequence[str], notes: Sequence[str]
) -> str:
    """Effects of a plan, those that are off in grey, with its notes."""
    remarks = "".join(f"<p>{escape(note)}</p>" for note in notes)
    left = f'<p style="color:gray">off: {escape(", ".join(off))}</p>' if off else ""
    return f"<p>{escape(title)}</p>{table(on)}{left}{remarks}"


def nested_list(line: Line) -> str:
    """A part of a scene and its own parts as nested lists."""
    text = f": {escape(line.text)}" if line.text else ""
    parts = "".join(f"<li>{nested_list(one)}</li>" for one in line.parts)
    return f"<b>{escape(line.name)}</b>{text}" + (f"<ul>{parts}</ul>" if parts else "")


def table(rows: Sequence[Sequence[str]]) -> str:
    """Rows of texts as a table.

    Examples
    --------
    >>> table([("gap", "< 5 nm")])
    '<table><tr><td>gap</td><td>&lt; 5 nm</td></tr></table>'
    """
    lines = ("".join(f"<td>{escape(cell)}</td>" for cell in row) for row in rows)
    return f"<table>{''.join(f'<tr>{line}</tr>' for line in lines)}</table>"
