"""Layout of the app: the form with its mistakes, surfaces, results, downloads."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from html import escape
from typing import Any, Literal

import marimo as mo

from ..errors import ContactkitError
from ..reading.limits import limit_of
from ..scene.scenes import ContactScene
from . import exports, shown
from .computed import Answer, ShownSurface, statistics_of
from .desk import Start
from .elements import BETWEEN
from .form import Made, Part

__all__ = [
    "answer",
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

_GROUPS = {
    "interface.lower": "lower body",
    "interface.upper": "upper body",
    "interface.meniscus": "liquid between them",
    "window": "window",
    "loading": "loading",
    "effects": "effects: nothing else is computed",
    "accuracy": "accuracy",
}
"""Sections of a form by the paths in them."""

_ERRORS = "± is the error of the grid, estimated on pixels two and four times as wide."


# What is opened and chosen --------------------------------------------------------------------


def drop_area() -> Any:
    """Area for a height map or a scene file; one that is larger than may be read is refused."""
    label = "drop a height map (csv, txt, npy, asc, xyz, sdf, an instrument's) or a scene file"
    return mo.ui.file(kind="area", max_size=limit_of("BYTES"), label=label)


def head(half: Any, drop: Any) -> Any:
    """Title, the half to begin with, and the area for a file."""
    title = mo.md("# contactkit\nThis page and what it computes stay on this machine.")
    return mo.vstack([title, _row([half, drop], gap="1rem 2rem")])


def form(
    start: Start,
    picks: Any,
    parts: Sequence[Part],
    fields: Any,
    problems: Mapping[str, Sequence[str]],
) -> Any:
    """The form: for each body, the liquid and so on what is chosen of it, then its fields.

    What is wrong stands under the element that it is about.
    """
    keys = {path: key for key in fields.elements for path in key.split(BETWEEN)}
    cells: dict[str, dict[str, Any]] = {group: {} for group in _GROUPS}
    for choice in start.choices:
        cells[_group(choice.path)][choice.path] = picks[choice.path]
    for part in parts:
        for widget in part.widgets:
            key = keys[widget.path]
            wrong = [text for path in key.split(BETWEEN) for text in problems.get(path, ())]
            shown = mo.vstack([fields[key], *map(_wrong, wrong)], gap=0.2) if wrong else fields[key]
            cells[_group(part.path)][key] = shown
    sections = [
        mo.vstack([mo.md(f"**{title}**"), _row([*cells[group].values()])], gap=0.3)
        for group, title in _GROUPS.items()
        if cells[group]
    ]
    whole = [_message(text, "danger") for text in (start.problem, *problems.get("", ())) if text]
    name = mo.md(f"## {escape(start.scene.name)}")
    return mo.vstack([name, *sections, *whole], gap=0.8)


def _group(path: str) -> str:
    """Group of the form that a path belongs to; the temperature is with the liquid."""
    return next((group for group in _GROUPS if path.startswith(group)), "interface.meniscus")


def _row(cells: Sequence[Any], gap: str = "0.5rem 1.2rem") -> Any:
    """Cells beside each other, below each other where there is no room."""
    style = f"display:flex;flex-wrap:wrap;gap:{gap};align-items:flex-start"
    inner = "".join(f"<div>{mo.as_html(cell).text}</div>" for cell in cells)
    return mo.Html(f'<div style="{style}">{inner}</div>')


def _wrong(text: str) -> Any:
    return mo.Html(f'<p style="color:#b00020;max-width:24rem;margin:0">{escape(text)}</p>')


def _message(text: str, kind: Literal["info", "success", "warn", "danger"]) -> Any:
    """A message in a frame."""
    lines = "<br>".join(escape(text).splitlines())
    return mo.callout(mo.Html(lines), kind=kind)


# What is computed -----------------------------------------------------------------------------


def working(title: str) -> Any:
    """Sign that something is being computed."""
    return mo.status.spinner(title=title, remove_on_exit=True)


def surfaces(found: Sequence[ShownSurface]) -> Any:
    """Each rough surface as a map, beside its statistics."""
    rows = []
    for one in found:
        numbers = [row[:2] for row in shown.number_rows(statistics_of(one))]
        picture = _picture(
            shown.map_picture(one.found, one.holes), f"heights of the {one.side} body"
        )
        table = mo.vstack([mo.md(f"**{one.side} surface**"), _table(numbers)])
        rows.append(_row([picture, table], gap="1rem"))
    return mo.vstack(rows) if rows else None


def _table(rows: Sequence[Sequence[str]]) -> Any:
    style = "<style>.numbers table{width:auto} .numbers td{padding:0.1rem 1.5rem 0.1rem 0}</style>"
    return mo.Html(f'{style}<div class="numbers">{shown.table_html(rows)}</div>')


def _picture(png: bytes, name: str) -> Any:
    width = int.from_bytes(png[16:20], "big") / shown.DENSITY  # of the head of a PNG
    return mo.image(png, alt=name, width=f"min({width:.0f}px, 88vw)")


def picture_choice(answer: Answer) -> Any:
    """Choice of the figures of a result that are drawn."""
    names, first = ([], []) if answer.result is None else shown.picture_names(answer.result)
    return mo.ui.multiselect(names, value=first, label="figures")


def answer(given: Answer, figures: Any) -> Any:
    """A result: message, what is out of range, figures, numbers with their errors, validity."""
    wrong = [] if given.problem is None else [_message(str(given.problem), "danger")]
    if given.result is None:
        return mo.vstack(wrong)
    said, outside, inside = shown.remarks(given.result)
    pictures = [_picture(shown.picture_of(given.result, name), name) for name in figures.value]
    rows = shown.number_rows(given.result.scalars(), given.errors)
    warned = ["{}: {}; {}".format(*row) for row in outside]
    parts = [
        mo.md("## Result"),
        *wrong,
        _message(said, "success" if not wrong else "warn"),
        *(_message(text, "warn") for text in warned),
        figures,
        _row(pictures, gap="1rem"),
        _table(rows if given.errors else [row[:2] for row in rows]),
    ]
    if given.errors:
        parts.append(mo.md(_ERRORS))
    checks = _table([*outside, *inside])
    return mo.vstack([*parts, mo.accordion({"Validity: every number and its range": checks})])


def curve(given: Answer) -> Any:
    """A curve: its figure and its columns."""
    if given.result is None:
        return _message(str(given.problem), "danger")
    names, _ = shown.picture_names(given.result)
    pictures = [_picture(shown.picture_of(given.result, name), name) for name in names]
    csv = mo.download(exports.csv_bytes(given.result), "area.csv", label="Columns (CSV)")
    table = _table(shown.column_rows(given.result))
    return _row([*pictures, mo.vstack([table, csv])], gap="1rem")


# What is handed over --------------------------------------------------------------------------


def downloads(made: Made, given: Answer) -> Any:
    """Scene file, report and columns, each made when it is asked for."""
    if made.opened is None:
        return None
    name, opened = made.opened.scene.name, made.opened
    stem = file_stem(name)
    toml = exports.toml_bytes(name, made.tables)
    found = [mo.download(toml, f"{stem}.toml", label="Scene (TOML)")]
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
    return _row(found)


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
