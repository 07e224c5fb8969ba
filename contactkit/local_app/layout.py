"""How the app shows things: the form with what is wrong in it, surfaces, results, downloads."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from html import escape
from typing import Any

import marimo as mo

from ..errors import ContactkitError
from ..reading.limits import limit_of
from ..scene.scenes import ContactScene
from . import exports, shown
from .computed import Answer, ShownSurface, statistics_of
from .desk import Start
from .elements import BETWEEN
from .form import EFFECTS, Made, Part

__all__ = [
    "answer",
    "choices",
    "curve",
    "downloads",
    "drop_area",
    "fmu",
    "form",
    "head",
    "picture_choice",
    "surfaces",
    "working",
]

_WIDTH = "min(620px, 90vw)"  # of a picture: two beside each other on a screen, one on a phone


# What is opened and chosen --------------------------------------------------------------------


def drop_area() -> Any:
    """Where a height map or a scene file is dropped; larger files than may be read are refused."""
    label = "drop a height map (csv, txt, npy, asc, xyz, sdf, an instrument's) or a scene file"
    return mo.ui.file(kind="area", max_size=limit_of("BYTES"), label=label)


def head(half: Any, drop: Any) -> Any:
    """Title, the half to begin with, and where a file is dropped."""
    title = mo.md("# contactkit\nThis page and what it computes stay on this machine.")
    return mo.vstack([title, mo.hstack([half, drop], wrap=True, justify="start", gap=2.0)])


def choices(start: Start, picks: Any) -> Any:
    """What is chosen: bodies, liquid and loading, then the effects."""
    kinds = [picks[one.path] for one in start.choices if one.path != EFFECTS]
    row = mo.hstack(kinds, wrap=True, justify="start", align="end", gap=1.0)
    wrong = [_message(start.problem, "danger")] if start.problem else []
    name = mo.md(f"## {escape(start.scene.name)}")
    only = mo.md("Effects that are computed, and no others:")
    return mo.vstack([*wrong, name, row, only, picks[EFFECTS]], gap=0.5)


def form(parts: Sequence[Part], elements: Any, problems: Mapping[str, Sequence[str]]) -> Any:
    """The form: a section for each part, what is wrong under the element that it is about."""
    sections = []
    keys = {path: key for key in elements.elements for path in key.split(BETWEEN)}
    for part in parts:
        cells = {}
        for widget in part.widgets:
            key = keys[widget.path]
            wrong = [text for path in key.split(BETWEEN) for text in problems.get(path, ())]
            cells[key] = mo.vstack([elements[key], *map(_wrong, wrong)], gap=0.2)
        if cells:
            row = mo.hstack(
                [*cells.values()], wrap=True, justify="start", align="start", gap=1.0
            )
            sections.append(mo.vstack([mo.md(f"**{escape(part.title)}**"), row], gap=0.3))
    whole = [_message(text, "danger") for text in problems.get("", ())]
    return mo.vstack([*sections, *whole], gap=0.8)


def _wrong(text: str) -> Any:
    return mo.Html(f'<p style="color:#b00020;max-width:24rem;margin:0">{escape(text)}</p>')


def _message(text: str, kind: str) -> Any:
    """A message in a frame: info, warn or danger."""
    lines = "<br>".join(escape(text).splitlines())
    return mo.callout(mo.Html(lines), kind=kind)  # type: ignore[arg-type]


# What is computed -----------------------------------------------------------------------------


def working(title: str) -> Any:
    """What turns while something is computed."""
    return mo.status.spinner(title=title, remove_on_exit=True)


def surfaces(found: Sequence[ShownSurface]) -> Any:
    """Each rough surface as a map, beside its statistics."""
    rows = []
    for one in found:
        numbers = shown.numbers_html(shown.number_rows(statistics_of(one)))
        picture = _picture(shown.map_picture(one.found), f"heights of the {one.side} body")
        table = mo.vstack([mo.md(f"**{one.side} surface**"), mo.Html(numbers)])
        rows.append(mo.hstack([picture, table], wrap=True, justify="start", gap=1.0))
    return mo.vstack(rows) if rows else None


def _picture(png: bytes, name: str) -> Any:
    return mo.image(png, alt=name, width=_WIDTH)


def picture_choice(answer: Answer) -> Any:
    """Which figures of a result are drawn."""
    names, first = ([], []) if answer.result is None else shown.picture_names(answer.result)
    return mo.ui.multiselect(names, value=first, label="figures")


def answer(given: Answer, figures: Any) -> Any:
    """A result: message, what is out of range, figures, numbers with their errors, validity."""
    wrong = [] if given.problem is None else [_message(str(given.problem), "danger")]
    if given.result is None:
        return mo.vstack(wrong)
    said, outside, inside = shown.remarks(given.result)
    pictures = [
        _picture(shown.picture_of(given.result, name), name) for name in figures.value
    ]
    rows = shown.number_rows(given.result.scalars(), given.errors)
    warned = ["{}: {}; {}".format(*row) for row in outside]
    parts = [
        mo.md("## Result"),
        *wrong,
        _message(said, "success" if not wrong else "warn"),
        *(_message(text, "warn") for text in warned),
        figures,
        mo.hstack(pictures, wrap=True, justify="start", gap=1.0),
        mo.Html(shown.numbers_html(rows)),
    ]
    if given.errors:
        parts.append(mo.md("± is the error of the grid, estimated on pixels two and four times as wide."))
    checks = mo.Html(shown.table_html([*outside, *inside]))
    return mo.vstack([*parts, mo.accordion({"Validity: every number and its range": checks})])


def curve(given: Answer) -> Any:
    """A curve: its figure and its columns."""
    if given.result is None:
        return _message(str(given.problem), "danger")
    names, _ = shown.picture_names(given.result)
    pictures = [_picture(shown.picture_of(given.result, name), name) for name in names]
    csv = mo.download(exports.csv_bytes(given.result), "area.csv", label="Columns (CSV)")
    table = mo.Html(shown.columns_html(given.result))
    return mo.hstack(
        [*pictures, mo.vstack([table, csv])], wrap=True, justify="start", gap=1.0
    )


# What is handed over --------------------------------------------------------------------------


def downloads(made: Made, given: Answer) -> Any:
    """Scene file, report and columns, each made when it is asked for."""
    if made.opened is None:
        return None
    name, opened = made.opened.scene.name, made.opened
    stem = file_stem(name)
    found = [mo.download(exports.toml_bytes(name, made.tables), f"{stem}.toml", label="Scene (TOML)")]
    if given.result is not None:
        result = given.result
        report = mo.download(
            lambda: exports.report_bytes(result), f"{stem}.html", label="Report (HTML)"
        )
        found.append(report)
        if not isinstance(opened.scene, ContactScene):
            found.append(
                mo.download(lambda: exports.csv_bytes(result), f"{stem}.csv", label="Curves (CSV)")
            )
    return mo.hstack(found, wrap=True, justify="start")


def fmu(made: Made, native: bool) -> Any:
    """A button that hands over the FMU of a scene, or why there is none."""
    if made.opened is None:
        return None
    try:
        with working("building the FMU"):
            content, name = exports.fmu_bytes(made.opened, native)
    except ContactkitError as error:
        return _message(str(error), "danger")
    stem = file_stem(made.opened.scene.name)
    return mo.download(content, f"{stem}.fmu", label=f"{name}, {len(content) // 1024} KiB")


def file_stem(title: str) -> str:
    """Plain name of a file for the title of a scene.

    Examples
    --------
    >>> file_stem("A film, 5 um"), file_stem("")
    ('a-film-5-um', 'scene')
    """
    return re.sub(r"[^a-z0-9]+", "-", title.lower()).strip("-")[:60] or "scene"
