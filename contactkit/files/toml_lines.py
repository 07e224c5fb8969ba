"""Lines of a TOML file on which its keys stand, for messages."""

from __future__ import annotations

import re

__all__ = ["line_of", "lines_of_keys"]

_KEY = re.compile(r"""\s*((?:[\w-]+|"[^"]*"|'[^']*')(?:\s*\.\s*(?:[\w-]+|"[^"]*"|'[^']*'))*)\s*=""")
_TABLE = re.compile(r"\s*(\[\[?)\s*([^\[\]]+?)\s*\]\]?\s*(?:#.*)?$")
_LONGEST = 1000  # of a line that is searched, with expressions that take time on long ones


def lines_of_keys(text: str) -> dict[str, int]:
    r"""Line, from 1, of each table and key of a TOML file by its path, such as ``effects[1]``.

    Keys inside of tables in braces and of lists of several lines are not found; `line_of` then
    gives the line of what they belong to.

    Examples
    --------
    >>> lines_of_keys("a = 1\n[b.c]\nd = 2\n[[e]]\nf = 3")
    {'a': 1, 'b.c': 2, 'b.c.d': 3, 'e': 4, 'e[0]': 4, 'e[0].f': 5}
    """
    found: dict[str, int] = {}
    table, counts = "", dict[str, int]()
    for number, line in enumerate(text.splitlines(), start=1):
        if len(line) > _LONGEST:
            continue
        if head := _TABLE.match(line):
            name = _plain(head[2])
            table = name
            if head[1] == "[[":
                index = counts[name] = counts.get(name, -1) + 1
                found.setdefault(name, number)
                table = f"{name}[{index}]"
            found.setdefault(table, number)
        elif key := _KEY.match(line):
            name = _plain(key[1])
            found.setdefault(f"{table}.{name}" if table else name, number)
    return found


def line_of(lines: dict[str, int], place: str) -> int | None:
    """Line of a path, or of the nearest table that holds it; None if there is none.

    Examples
    --------
    >>> line_of({"interface.lower": 3}, "interface.lower.solid.layers[0]")
    3
    """
    while place:
        if place in lines:
            return lines[place]
        place = re.sub(r"(\.[^.\[\]]*|\[[^\]]*\]|^[^.\[]*)$", "", place)
    return None


def _plain(name: str) -> str:
    """A dotted key without quotes and spaces."""
    return re.sub(r"""["'\s]""", "", name)
