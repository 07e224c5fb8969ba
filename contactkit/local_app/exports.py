"""Downloads of the app: scene, report, columns, FMU."""

from __future__ import annotations

import tempfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import tomli_w

from ..app.fmu_files import Order, build_opened
from ..app.report_page import result_page
from ..app.scenes import OpenedScene
from ..files.results import save_csv, save_result
from ..scene.result import Result
from ..scene.tabular import Tabular

__all__ = ["csv_bytes", "fmu_bytes", "report_bytes", "toml_bytes"]


def toml_bytes(name: str, tables: Mapping[str, Any]) -> bytes:
    """A form as a scene file, in the units that were typed; a map is named to lie beside it."""
    head = {"name": name} if name else {}
    return tomli_w.dumps(_beside(head | dict(tables))).encode()


def _beside(value: Any) -> Any:
    """Tables with the paths of height maps cut to the names of the files."""
    if isinstance(value, list):
        return [_beside(item) for item in value]
    if not isinstance(value, dict):
        return value
    cut = {"path": Path(value["path"]).name} if isinstance(value.get("path"), str) else {}
    return {key: _beside(item) for key, item in value.items()} | cut


def report_bytes(result: Result) -> bytes:
    """The page of a result: figures, numbers, validity, plan, scene, sources."""
    with tempfile.TemporaryDirectory(prefix="contactkit-") as folder:
        return result_page(save_result(result, Path(folder) / "result")).encode()


def csv_bytes(curve: Tabular) -> bytes:
    """Curves of a result, a column each, with units in the headings."""
    known = curve.contents().quantities
    columns = {name: one.values for name, one in known.items() if len(one.axes) == 1}
    headings = {name: f"{name} [{known[name].unit}]" for name in columns}
    with tempfile.TemporaryDirectory(prefix="contactkit-") as folder:
        return save_csv(Path(folder) / "curve", columns, headings).read_bytes()


def fmu_bytes(opened: OpenedScene, native: bool) -> tuple[bytes, str]:
    """An FMU of a scene, and what it is in words; `native` in C, which needs the extra native.

    Raises
    ------
    ContactkitError
        If no FMU holds the scene, or an extra is missing.
    """
    with tempfile.TemporaryDirectory(prefix="contactkit-") as folder:
        out = Path(folder) / "scene.fmu"
        name = build_opened(Order(opened.name, (), out, native, None, "2"), opened)
        return out.read_bytes(), name
