"""Blocks of the pages that hold measured numbers: seconds, errors, counts.

A page holds ``<!-- measured: NAME -->`` and ``<!-- end of measured -->``. Unlike the tables of
`tables.py` their numbers are not checked by a test, as they differ from machine to machine;
`pages.py` lists the scripts that write them.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Callable, Mapping
from pathlib import Path

DOCS = Path(__file__).parents[1]


def write_blocks(found: Mapping[str, str]) -> list[str]:
    """Put what was measured into the pages; names of the blocks that no page has."""
    left = set(found)
    for page in sorted(DOCS.rglob("*.md")):
        old = new = page.read_text(encoding="utf-8")
        for name, text in found.items():
            mark = rf"(<!-- measured: {re.escape(name)} -->\n).*?(<!-- end of measured -->)"
            new, n = re.subn(
                mark, lambda m, text=text: f"{m[1]}\n{text}\n\n{m[2]}", new, flags=re.DOTALL
            )
            left -= {name} if n else set()
        if new != old:
            page.write_text(new, encoding="utf-8")
    return sorted(left)


def measure(
    tables: Mapping[str, Callable[[], str]],
    prefix: str = "",
    pictures: Callable[[], None] | None = None,
) -> int:
    """Measure the tables named on the command line, or all; print, and write with ``--write``.

    A block is called as its table, behind `prefix`. What is written has the pictures of the page,
    too; ``pictures`` is a name among the tables.
    """
    known = [*tables, *(["pictures"] if pictures else [])]
    asked = [a for a in sys.argv[1:] if a != "--write"]
    if unknown := sorted(set(asked) - set(known)):
        raise SystemExit(f"there is no {', '.join(unknown)}; there are {', '.join(known)}")
    writes, names = "--write" in sys.argv[1:], asked or known
    found = {}
    for name in names:
        if name in tables:
            text = found[prefix + name] = tables[name]()
            sys.stdout.write(f"{name}\n\n{text}\n\n")
    if writes:
        if pictures and "pictures" in names:
            pictures()
        if missing := write_blocks(found):
            raise SystemExit(f"no page has a block {', '.join(missing)}")
    return 0
