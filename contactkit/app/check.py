"""All mistakes of a scene file at once: of its fields, then of its physics without those."""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from ..errors import ContactkitError
from ..files.scenes import read_tables
from ..files.structure import FileError, FileProblem
from .scenes import open_tables

__all__ = ["with_physics"]


def with_physics(path: Path, error: FileError) -> FileError:
    """Add what a plan refuses to the mistakes of the fields of a scene file.

    Effects, accuracy and study with a mistake are left out for that. Where another part has one,
    nothing can be planned and the error stays as it is.
    """
    rest = _without(read_tables(path), error.problems)
    if rest is None:
        return error
    try:
        open_tables(rest, path.name).plan_text()
    except FileError:
        return error
    except ContactkitError as found:
        more = FileProblem(f"without what is listed above: {found}")
        text = path.read_text(encoding="utf-8", errors="replace")
        return FileError(error.field, [*error.problems, more], text)
    return error


def _without(tables: dict[str, Any], problems: Sequence[FileProblem]) -> dict[str, Any] | None:
    """Tables without the effects and settings that have a mistake; None if others have one."""
    rest, effects = dict(tables), set[int]()
    for problem in problems:
        match = re.match(r"(accuracy|study|effects\[(\d+)\])", problem.place)
        if match is None:
            return None
        if match[2] is None:
            rest.pop(match[1], None)
        else:
            effects.add(int(match[2]))
    if effects:
        rest.pop("study", None)  # whose paths may lead to one of these
        rest["effects"] = [one for i, one in enumerate(rest["effects"]) if i not in effects]
    return rest
