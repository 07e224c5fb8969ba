"""One page of HTML about a result: figures, numbers, validity, plan, scene, sources."""

from __future__ import annotations

import tempfile
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from ..errors import DescriptionError
from ..export.html import numbers_table, table
from ..export.pages import bullets, figure, listing, page, section
from ..extras import missing_extra
from ..files.results import AnyResult, load_result
from ..scene.answer import headline
from .output import RECORD, Printed, Record, read_record
from .run import cost_text, draw_result

if TYPE_CHECKING:
    from ..validity import ValidityNumber

__all__ = ["PAGE", "folder_page", "report_page", "result_page", "validity_rows"]

PAGE = "report.html"
"""Name of the page in an output folder."""

_RESULT = "result.npz"
_PNG = b"\x89PNG\r\n\x1a\n"
_LARGEST = 20_000_000  # bytes of a picture


def report_page(source: Path) -> str:
    """Return the page of a saved result, or of an output folder of run, study or cost.

    Raises
    ------
    DescriptionError
        If it is neither.
    """
    if not source.is_dir():
        return result_page(source)
    record = read_record(source)
    if record is not None:
        return folder_page(source, record)
    if (source / _RESULT).is_file():
        return result_page(source / _RESULT)
    raise DescriptionError(
        "result",
        str(source),
        "be a result file, or a folder that contactkit run or study wrote to",
        hint=f"it has neither {RECORD} nor {_RESULT}",
    )


def result_page(path: Path) -> str:
    """Return the page of a saved result; its figures are drawn for the page."""
    result = load_result(path)
    with tempfile.TemporaryDirectory(prefix="contactkit-") as folder:
        try:
            shown = [
                figure(one.read_bytes(), _caption(one)) for one in draw_result(result, Path(folder))
            ]
        except ImportError as error:
            missing = missing_extra(error, "drawing the figures")
            if missing is None:
                raise
            shown = [bullets([str(missing)])]
    return _page(_title(result), [section("Figures", *shown), *_result_sections(result)], str(path))


def folder_page(folder: Path, record: Record) -> str:
    """Return the page of an output folder: what each command printed, with its pictures."""
    saved = folder / _RESULT
    result = load_result(saved) if _RESULT in record.files and saved.is_file() else None
    sections, titles = [], []
    for command, printed in record.printed.items():
        titles.append(printed.title)
        if command == "run" and result is not None:
            parts = [
                section("Figures", *_pictures(folder, record, command)),
                *_result_sections(result),
                section("Printed", listing(printed.text)),
            ]
        else:
            parts = _printed_sections(folder, record, command, printed)
        sections += [section("Values set", bullets(printed.settings)), *parts]
    return _page(titles[0] if titles else "contactkit", sections, record.scene)


def _page(title: str, sections: Sequence[str], source: str) -> str:
    from .._version import __version__

    made_by = f"contactkit {__version__}"
    return page(title, sections, generator=made_by, foot=f"{made_by}; {source}")


def _printed_sections(folder: Path, record: Record, command: str, printed: Printed) -> list[str]:
    """Sections of what a command printed: a study, a cost, or the run of a device."""
    numbers = [(name.replace("_", " "), text) for name, text in printed.numbers.items()]
    plan, _, sources = printed.plan.partition("\nsources:\n")
    return [
        section(f"Figures of {command}", *_pictures(folder, record, command)),
        section(f"Printed by {command}", listing(printed.text)),
        section(f"Numbers of {command}", table(numbers) if numbers else ""),
        section("Validity", table(printed.validity) if printed.validity else ""),
        section("Plan", listing(plan) if plan else ""),
        section("Scene", listing(printed.scene) if printed.scene else ""),
        section("Sources", bullets([line.strip() for line in sources.splitlines()])),
    ]


def _pictures(folder: Path, record: Record, command: str) -> Iterator[str]:
    """Pictures that a command wrote and that are still there."""
    for name, entry in record.files.items():
        path = folder / name
        if entry.command != command or path.suffix != ".png" or not path.is_file():
            continue
        inside = path.resolve().parent == folder.resolve()  # of a record that is not ours, say
        if inside and path.stat().st_size <= _LARGEST:
            data = path.read_bytes()
            if data.startswith(_PNG):
                yield figure(data, _caption(path))


def _caption(path: Path) -> str:
    return path.stem.replace("-", " ").replace("_", " ")


def _title(result: AnyResult) -> str:
    return result.plan.scene.name or result.plan.title


def _result_sections(result: AnyResult) -> list[str]:
    """Numbers, validity, plan, scene, sources and cost of a result."""
    return [
        section("Result", numbers_table(headline(result.status, result.message), result.scalars())),
        section("Validity", table(validity_rows(result.validity))),
        section("Errata of what is taken as printed", bullets([str(one) for one in result.errata])),
        section("Plan", result.plan._repr_html_()),
        section("Scene", result.plan.scene._repr_html_()),
        section("Sources", bullets(result.cite().splitlines())),
        section("Cost", bullets([*result.notes, cost_text(result)])),
    ]


def validity_rows(numbers: Iterable[ValidityNumber]) -> list[tuple[str, str, str]]:
    """Rows of a table of validity: name, value with its bound, detail; out of range first."""
    rows = []
    for one in sorted(numbers, key=lambda number: number.is_valid is not False):
        said = str(one).removeprefix(one.name).removesuffix(one.detail)
        rows.append((one.name, said.strip(" =:;,"), one.detail))
    return rows
