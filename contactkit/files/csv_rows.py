"""Rows of CSV files; no text in them is taken for a formula by a spreadsheet."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from ..reading.texts import is_number
from .scenes import write_whole

__all__ = ["csv_line", "text_cell", "write_rows"]

# Beginnings by which a spreadsheet knows a formula, wide forms included; and the mark itself, so
# that one mark is taken off whatever the text is.
_FORMULA = ("=", "+", "-", "@", "\uff1d", "\uff0b", "\uff0d", "\uff20", "'")


def text_cell(text: str) -> str:
    """A text for a cell: one that begins as a formula is marked by an apostrophe before it.

    Spreadsheets hide the mark and calculate nothing. Numbers stay as they are, and so do other
    texts; a reader takes off one leading apostrophe to have the text itself.

    Examples
    --------
    >>> text_cell("=HYPERLINK(0)"), text_cell("-1.5e-3"), text_cell("peak_force [N]")
    ("'=HYPERLINK(0)", '-1.5e-3', 'peak_force [N]')
    """
    if not text.lstrip().startswith(_FORMULA) and text[:1] not in ("\t", "\r", "\n"):
        return text
    return text if text == "-" or is_number(text) else f"'{text}"


def csv_line(cells: Iterable[Any]) -> str:
    """A line of a CSV file, without its end."""
    line = io.StringIO()
    shown = [text_cell(cell) if isinstance(cell, str) else cell for cell in cells]
    csv.writer(line, lineterminator="").writerow(shown)
    return line.getvalue()


def write_rows(path: Path, head: Iterable[str], rows: Iterable[Iterable[Any]]) -> Path:
    """Write a head and rows of numbers and texts to a CSV file, whole or not at all."""
    with (
        write_whole(path) as temporary,
        temporary.open("w", newline="", encoding="utf-8") as file,
    ):
        file.write(f"{csv_line(head)}\n")
        file.writelines(f"{csv_line(row)}\n" for row in rows)
    return path
