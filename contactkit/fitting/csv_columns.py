"""Columns of a CSV file, as spreadsheets, instruments and `numpy.savetxt` write them."""

from __future__ import annotations

import csv
import io
import re
from pathlib import Path

from ..errors import DescriptionError
from ..reading.limits import check_limit
from ..reading.texts import DECIMAL_COMMA, decoded, is_number, read_bytes

__all__ = ["csv_columns"]

_CELL = re.compile(
    r"[^\s\[(]+(?:\s*[\[(][^\])]*[\])])?"
)  # between blanks: a name and its unit are one
_DECIMAL_POINT = re.compile(r"[-+]?\d*\.\d")
_Row = list[str]


def csv_columns(path: Path) -> tuple[list[str], list[list[str]]]:
    """Headings and cells of the columns of a CSV file; lines that begin with # are left out.

    Cells are separated by commas, semicolons or tabs, or by blanks where the head has none of them.
    Decimal commas become points where no comma separates, and no number has a point. A head may
    stand in the last comment.

    Raises
    ------
    DescriptionError
        If it is no text, has no head or no row, or a row has another number of cells.
    """
    try:
        text = decoded(read_bytes(path, "TEXT_BYTES"), str(path))
    except OSError as error:
        raise DescriptionError("file", str(path), "be a CSV file", hint=str(error)) from None
    lines = [line for line in text.splitlines() if line.strip()]
    check_limit("POINTS", len(lines), str(path))
    comments = [line for line in lines if line.startswith("#")]
    body = [line for line in lines if not line.startswith("#")]
    separator = _separator(body[0]) if body else ","
    rows = _rows(body, separator)
    if rows and all(is_number(cell.replace(",", ".")) for cell in rows[0]):
        rows = [_head_of(comments, separator, len(rows[0]), path), *rows]
    if len(rows) < 2:
        raise DescriptionError("file", str(path), "have a head and at least one row")
    head, *rows = rows
    for i, row in enumerate(rows, 2):
        if len(row) != len(head):
            expected = f"have {len(head)} cells in each row"
            raise DescriptionError("file", str(path), expected, hint=f"row {i} has {len(row)}")
    if separator != "," and _has_decimal_commas(rows):
        rows = [[cell.replace(",", ".") for cell in row] for row in rows]
    return [cell.lstrip("'") for cell in head], [list(column) for column in zip(*rows, strict=True)]


def _head_of(comments: list[str], separator: str, width: int, path: Path) -> _Row:
    """Head in the last comment above rows of numbers."""
    head = _rows([comments[-1].lstrip("# ")], separator) if comments else []
    if not head or len(head[0]) != width:
        cure = "write a line such as 'gap [um],force [mN]' above the numbers"
        raise DescriptionError("file", str(path), "have a head", hint=cure)
    return head[0]


def _separator(line: str) -> str:
    """What separates the cells of a line: blanks where nothing else does."""
    found = max(",;\t", key=line.count)
    return found if found in line else " "


def _rows(lines: list[str], separator: str) -> list[_Row]:
    if separator == " ":
        return [_CELL.findall(line) for line in lines]
    return list(csv.reader(io.StringIO("\n".join(lines)), delimiter=separator))


def _has_decimal_commas(rows: list[_Row]) -> bool:
    """Whether numbers have decimal commas: some do, and none has a decimal point."""
    cells = [cell.strip() for row in rows for cell in row]
    return any(map(DECIMAL_COMMA.fullmatch, cells)) and not any(map(_DECIMAL_POINT.match, cells))
