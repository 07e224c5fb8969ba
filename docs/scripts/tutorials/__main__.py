"""Tutorials as pages and notebooks: ``python docs/scripts/tutorials [NAME ...]``.

The source of each is a script of examples/tutorials/ in cells: its docstring is title and question,
``# %% [markdown]`` begins a cell of text, ``# %%`` one of code. Every cell is run, in order, and
docs/tutorials/ gets the page (text, code, what it printed, its figures) and the notebook, without
outputs. Editors that know such cells, and jupytext, open the source itself.
"""

from __future__ import annotations

import ast
import contextlib
import io
import os
import re
import sys
import tempfile
import warnings
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any
from unittest import mock

import matplotlib as mpl
import matplotlib.pyplot as plt
from matplotlib.figure import Figure
from PIL import Image

import contactkit as ck
from contactkit.plot.style import STYLE

ROOT = Path(__file__).parents[3]
SOURCES, SHOWN = ROOT / "examples" / "tutorials", ROOT / "docs" / "tutorials"
COLOURS, DPI = 256, 120
MARK = re.compile(r"^# %%( \[markdown\])?\n", re.MULTILINE)


@dataclass
class Cell:
    """A cell of a tutorial; what it printed and drew when it was run."""

    source: str
    is_code: bool
    printed: str = ""
    figures: list[Figure] = field(default_factory=list)


def names() -> list[str]:
    """Names of all tutorials, in reading order."""
    return sorted(path.stem for path in SOURCES.glob("*.py"))


def cells(name: str) -> list[Cell]:
    """Cells of a tutorial, the first one its title and question."""
    head, *pieces = MARK.split((SOURCES / f"{name}.py").read_text(encoding="utf-8"))
    title, _, question = (ast.get_docstring(ast.parse(head)) or "").partition("\n\n")
    found = [Cell(f"# {title.rstrip('.')}\n\n{question}".rstrip(), is_code=False)]
    for mark, body in zip(pieces[::2], pieces[1::2], strict=True):
        text = body.strip("\n")
        if mark:
            text = "\n".join(line.removeprefix("#").removeprefix(" ") for line in text.split("\n"))
        found.append(Cell(text, is_code=not mark))
    return found


@contextlib.contextmanager
def elsewhere() -> Iterator[None]:
    """Work in a new folder, which is removed."""
    before = Path.cwd()
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        try:
            yield
        finally:
            os.chdir(before)


def run(name: str) -> list[Cell]:
    """Run a tutorial from start to end in a folder of its own; a warning is an error."""
    found = cells(name)
    scope: dict[str, Any] = {"__name__": "__main__"}
    registered = ck.EFFECTS.including()  # for the length of the run
    with elsewhere(), warnings.catch_warnings(), mpl.rc_context(STYLE), registered:
        warnings.simplefilter("error")
        warnings.filterwarnings(
            "ignore", category=DeprecationWarning, module="matplotlib|pyparsing"
        )
        for number, cell in enumerate(found):
            if not cell.is_code:
                continue

            def show(cell: Cell = cell) -> None:
                cell.figures += [plt.figure(i) for i in plt.get_fignums()]
                plt.close("all")

            printed = io.StringIO()
            code = compile(cell.source, f"{name}.py, cell {number}", "exec", dont_inherit=True)
            with contextlib.redirect_stdout(printed), mock.patch.object(plt, "show", show):
                exec(code, scope)
            cell.printed = printed.getvalue()
    return found


def page(name: str, found: list[Cell]) -> str:
    """Return the page of a tutorial that was run, in Markdown."""
    parts, n_figures = [], 0
    for cell in found:
        parts.append(f"```python\n{cell.source}\n```" if cell.is_code else cell.source)
        if cell.printed:
            parts.append(f"```text\n{cell.printed.rstrip()}\n```")
        for figure in cell.figures:
            n_figures += 1
            titles = [ax.get_title(loc="left") or ax.get_title() for ax in figure.axes]
            parts.append(f"![{'; '.join(filter(None, titles))}]({name}-{n_figures}.png)")
    parts.append(f"Run it yourself: [this page as a notebook]({name}.ipynb).")
    return "\n\n".join(parts) + "\n"


def notebook(found: list[Cell]) -> str:
    """Return the notebook of a tutorial, without outputs, as JSON."""
    import nbformat
    from nbformat import v4

    kernel = {"display_name": "Python 3", "language": "python", "name": "python3"}
    made = v4.new_notebook(
        cells=[
            (v4.new_code_cell if cell.is_code else v4.new_markdown_cell)(
                cell.source, id=f"cell-{i}"
            )
            for i, cell in enumerate(found)
        ],
        metadata={"kernelspec": kernel},
    )
    nbformat.validate(made)
    return str(nbformat.writes(made)) + "\n"


def save_figure(figure: Figure, path: Path) -> None:
    """Write a figure as PNG with a palette, so that it stays small."""
    with io.BytesIO() as raw:
        figure.savefig(raw, format="png", dpi=DPI)
        with Image.open(raw) as image:
            image.convert("RGB").quantize(COLOURS, Image.Quantize.MAXCOVERAGE, 1).save(
                path, optimize=True
            )


def write(name: str) -> None:
    """Run a tutorial and write page, figures and notebook."""
    found = run(name)
    for old in SHOWN.glob(f"{name}-*.png"):
        old.unlink()
    figures = [figure for cell in found for figure in cell.figures]
    for i, figure in enumerate(figures, start=1):
        save_figure(figure, SHOWN / f"{name}-{i}.png")
    (SHOWN / f"{name}.md").write_text(page(name, found), encoding="utf-8")
    (SHOWN / f"{name}.ipynb").write_text(notebook(found), encoding="utf-8")


if __name__ == "__main__":
    mpl.use("Agg")
    for each in sys.argv[1:] or names():
        sys.stdout.write(f"{each}\n")
        write(each)
