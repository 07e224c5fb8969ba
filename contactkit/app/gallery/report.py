"""Files of a page and of the index: Markdown, pictures as PNG, PDF and SVG, data, table as csv."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

from ...files.csv_rows import write_rows
from ...files.scenes import write_text
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
    parts += [f"![{page.label}: {page.title}]({name}.png)" for name in names]
    parts += [f"**Claim of the source.** {page.claim}", f"**Verdict.** {page.verdict}"]
    if page.choices:
        parts.append(f"**Our choices.** {page.choices}")
    parts.append("## Checks")
    held = [("yes" if c.holds else "**no**", c.statement, c.measured) for c in checks]
    parts.append(_grid(("holds", "statement", "measured"), held))
    if table is not None:
        parts += ["## Numbers", _grid(table.head, [[_cell(v) for v in row] for row in table.rows])]
    parts += ["## How it was made", _grid(("", ""), list(_facts(script, made).items()))]
    if made.notes:
        notes = "\n".join(f"- {note}" for note in made.notes)
        parts.append(f"Warnings of the run, each once:\n\n{notes}")
    return "\n\n".join(parts) + "\n"


def _facts(script: Script, made: Made) -> Mapping[str, str]:
    page = script.page
    facts = {
        "code": f"`examples/gallery/{script.chapter}/{script.path.name}`",
        "command": f'`contactkit gallery "{page.name}"`',
        "grid": page.grid,
        "seeds": page.seeds,
        "time": f"{made.seconds:.2g} s of CPU, one thread",
    }
    return {name: text for name, text in facts.items() if text}


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
    held = sum(line.startswith("| yes |") for line in page.splitlines())
    failed = sum(line.startswith("| **no** |") for line in page.splitlines())
    return f"{held} of {held + failed} hold"


_LEAD = """\
Every figure and table of the source that has data, computed again: what it states, what we find,
and the checks that decide it. A statement that is wrong stays as a check of the corrected one, and
the page names the reason. `contactkit gallery` makes all of them; each page names the script that
makes it. Left out are schematics, without anything to compute: Figs. 1.1, 2.1a, 2.4 to 2.7, 2.22,
2.26, 3.1 to 3.6, 3.17 and 3.22 to 3.24."""
