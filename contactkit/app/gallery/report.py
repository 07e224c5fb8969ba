"""Files of a page and of the index: Markdown, pictures as PNG, PDF and SVG, data, table as csv."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any, NamedTuple

from ...files.csv_rows import write_rows
from ...files.scenes import write_text
from ...plot.axis_units import in_prose
from .page import Check, Data, Table
from .scripts import CHAPTERS, Script

__all__ = ["Made", "index", "write_page"]

_TITLES = {
    "chapter_2": "Chapter 2: contact of rough layered surfaces",
    "chapter_3": "Chapter 3: separation of wetted surfaces",
    "measured": "Against programs and measurements of others",
    "deforming": "Films between bodies that deform, by a second method",
    "future_work": "Future work of the source, as far as it is done",
}

_COLUMNS, _ROWS = 4, 30  # of a table that a telephone shows


class Made(NamedTuple):
    """Computed data of a page: how long it took [s of CPU], with which sizes, which warnings."""

    data: Data
    seconds: float
    draft: bool
    notes: Sequence[str]


def write_page(script: Script, made: Made, checks: list[Check], out: Path) -> None:
    """Draw a page, and write its files with the outcome of its checks."""
    from ...plot.gallery import save_all

    module, slug = script.module, script.slug
    drawn = module.draw(made.data)
    figures = list(drawn) if isinstance(drawn, Sequence) else [drawn]
    names = [slug if i == 0 else f"{slug}-{i + 1}" for i in range(len(figures))]
    for name, figure in zip(names, figures, strict=True):
        save_all(figure, out / name, for_print=not made.draft)
    table: Table | None = module.table(made.data) if hasattr(module, "table") else None
    if table is not None:
        write_rows(out / f"{slug}.csv", table.head, table.rows)
    write_text(out / f"{slug}.md", _page(script, made, checks, names, table))


def _page(
    script: Script, made: Made, checks: list[Check], names: list[str], table: Table | None
) -> str:
    page = script.page
    parts = [f"# {page.label}: {page.title}"]
    if made.draft:
        parts.append("**Draft sizes**: numbers and pictures are those of a coarse run.")
    parts += [f"![{page.label}]({name}.png)" for name in names]
    parts += [f"**Claim.** {page.claim}", f"**Verdict.** {page.verdict}"]
    if page.choices:
        parts.append(f"**Our choices.** {page.choices}")
    parts += _checked(checks)
    if table is not None:
        parts += _numbers(script, table)
    parts += [_made(script, made), *_ranges(made.notes)]
    return in_prose("\n\n".join(parts) + "\n")


def _checked(checks: Sequence[Check]) -> list[str]:
    """Statements with what decides them; open if one does not hold."""
    rows = [
        (c.statement if c.holds else f"**does not hold**: {c.statement}", c.measured)
        for c in checks
    ]
    n_held = sum(c.holds for c in checks)
    title = f"Checks: {n_held} of {len(checks)} hold"
    return _folded(title, _grid(("statement", "measured"), rows), is_open=n_held < len(checks))


def _numbers(script: Script, table: Table) -> list[str]:
    """The table, or a link to it where it is too wide for a page or too long."""
    if len(table.head) > _COLUMNS or len(table.rows) > _ROWS:
        return [f"Numbers: [{script.slug}.csv]({script.slug}.csv)."]
    rows = [[_cell(value) for value in row] for row in table.rows]
    return _folded("Numbers", _grid(table.head, rows))


def _folded(title: str, text: str, is_open: bool = False) -> list[str]:
    """Parts of a page that a reader unfolds."""
    begin = f'<details markdown="1"{" open" if is_open else ""}>\n<summary>{title}</summary>'
    return [begin, text, "</details>"]


def _made(script: Script, made: Made) -> str:
    page = script.page
    facts = (page.grid, page.seeds and f"seeds {page.seeds}", f"{made.seconds:.2g} s of CPU")
    return f'`contactkit gallery "{page.name}"`: {"; ".join(fact for fact in facts if fact)}.'


def _ranges(notes: Sequence[str]) -> list[str]:
    """What warned of its range, without the advice; numpy's own warnings have no number."""
    found = [note.partition(":")[0] for note in notes if " = " in note]
    return [f"Out of range in some of the runs: {'; '.join(found)}."] if found else []


def _cell(value: Any) -> str:
    return f"{value:.4g}" if isinstance(value, float) else str(value)


def _grid(head: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join("| " + " | ".join(c.replace("|", "\\|") for c in row) + " |" for row in lines)


def index(scripts: Sequence[Script], out: Path) -> str:
    """Index of the pages that are in a folder, by chapter, with the outcome of their checks."""
    parts = ["# Gallery", _LEAD]
    folders = [*CHAPTERS, *sorted({s.chapter for s in scripts} - set(CHAPTERS))]
    for chapter in folders:
        files = {s: out / f"{s.slug}.md" for s in scripts if s.chapter == chapter}
        rows = [
            (f"[{s.page.label}]({s.slug}.md)", s.page.title, _held(file.read_text("utf-8")))
            for s, file in files.items()
            if file.is_file()
        ]
        if rows:
            parts += [
                f"## {_TITLES.get(chapter, chapter)}",
                _grid(("page", "shows", "checks"), rows),
            ]
    return "\n\n".join(parts) + "\n"


def _held(page: str) -> str:
    """Outcome of the checks of a page that is written."""
    return page.partition("<summary>Checks: ")[2].partition("</summary>")[0]


_LEAD = """\
Every figure and table of the source that has data, computed again: what it states, what we find,
and the checks that decide it. A statement that is wrong stays as a check of the corrected one, and
the page names the reason. `contactkit gallery` makes all of them; each page names the command
that makes it. Left out are schematics, without anything to compute: Figs. 1.1, 2.1a, 2.4 to 2.7,
2.22, 2.26, 3.1 to 3.6, 3.17 and 3.22 to 3.24."""
