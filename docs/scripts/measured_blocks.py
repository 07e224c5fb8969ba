"""Blocks of the pages that hold measured numbers: seconds, errors, counts.

A page holds ``<!-- measured: NAME -->`` and ``<!-- end of measured -->``. Unlike the tables of
`tables.py` these are not checked by a test, as they differ from machine to machine; the scripts
`measure_contact.py`, `measure_bridges.py` and `pictures.py` write them.
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


def measure(tables: Mapping[str, Callable[[], str]], prefix: str = "") -> int:
    """Measure the tables named on the command line, or all; print, and write with ``--write``.

    A block is called as its table, behind `prefix`.
    """
    names = [a for a in sys.argv[1:] if a != "--write"] or list(tables)
    found = {}
    for name in names:
        text = found[prefix + name] = tables[name]()
        sys.stdout.write(f"{name}\n\n{text}\n\n")
    if "--write" in sys.argv[1:]:
        missing = write_blocks(found)
        sys.stdout.write(f"no page has: {', '.join(missing) or 'none missing'}\n")
    return 0
