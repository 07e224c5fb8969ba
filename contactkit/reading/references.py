"""Files that a scene file names: found from its folder, in it or in its project."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import Any

from ..errors import DescriptionError

__all__ = ["PROJECT_MARKS", "found_from", "references_from", "resolved_references"]

_SCENE = "contact"  # a file, or the name of a scene of contactkit
_KEYS = ("path", _SCENE)
_FOLDERS = "CONTACTKIT_READ_FROM"
PROJECT_MARKS = ("contactkit.toml", "pyproject.toml", ".git")
"""What the top folder of a project holds, one of them at least."""


def resolved_references(tables: Mapping[str, Any], file: Path) -> dict[str, Any]:
    """Tables of a scene file in which names of files are absolute, found from the folder of it.

    The files may lie below that folder, in the project it belongs to (below the nearest folder
    above it that holds one of `PROJECT_MARKS`), below the working folder, or in a folder that the
    environment variable ``CONTACTKIT_READ_FROM`` lists, separated as in ``PATH``. Others are
    refused, which the author of the file may not have meant to open. Links are followed: what
    counts is where a file is.

    Parameters
    ----------
    tables : mapping
        Content of the scene file.
    file : Path
        The scene file.

    Raises
    ------
    DescriptionError
        Naming the file and the folders.
    """
    allowed = _allowed(file.resolve().parent)

    def resolve(key: str, name: str) -> str:
        return _resolved(key, name, file, allowed)

    made: dict[str, Any] = _exchanged(tables, resolve)
    return made


def references_from(tables: Mapping[str, Any], file: Path) -> dict[str, Any]:
    """Tables whose names of files are found from the working folder, as a scene file has them.

    The inverse of `resolved_references`: what is written is found again from the folder of the
    file, whatever the working folder is then.

    Raises
    ------
    DescriptionError
        If a file lies where a scene file there may not name it.
    """
    own = file.resolve().parent
    allowed = _allowed(own)

    def relate(key: str, name: str) -> str:
        found = found_from(Path.cwd(), name)
        if key.rpartition(".")[2] == _SCENE and not found.is_file():
            return name
        _check(key, found, file, allowed)
        return _relative(found, own)

    made: dict[str, Any] = _exchanged(tables, relate)
    return made


def found_from(folder: Path, name: str) -> Path:
    """Absolute path of a name, whose own link is not followed: the format goes by its ending."""
    joined = Path(folder, name)
    return joined.parent.resolve() / joined.name


def _allowed(own: Path) -> list[Path]:
    """Folders from which a scene file in a folder may name files."""
    more = [one for one in os.environ.get(_FOLDERS, "").split(os.pathsep) if one]
    return [own, *_project(own), Path.cwd().resolve(), *(Path(one).resolve() for one in more)]


def _project(own: Path) -> Iterator[Path]:
    """Top folder of the project of a folder; neither a home folder nor the root is one."""
    for folder in (own, *own.parents):
        if any((folder / mark).exists() for mark in PROJECT_MARKS):
            if folder not in _no_projects(own):
                yield folder
            return


def _resolved(key: str, name: str, file: Path, allowed: list[Path]) -> str:
    own, origin = file.resolve().parent, file.name
    field = f"{origin}, {key}"
    if "\0" in name:
        raise DescriptionError(field, name[:80], "be the name of a file")
    is_scene = key.rpartition(".")[2] == _SCENE
    try:
        found = found_from(own, name)
        if is_scene and not Path(name).suffix and not found.is_file():
            return name  # of a scene of contactkit
        _check(key, found, file, allowed)
        elsewhere = found_from(Path.cwd(), name)
        is_elsewhere = not found.exists() and elsewhere.exists()
    except (OSError, RuntimeError) as error:  # a name of too many letters, a circle of links
        raise DescriptionError(
            field, name[:80], "be the name of a file", hint=str(error)[:200]
        ) from None
    if is_elsewhere:
        raise DescriptionError(
            field,
            name[:200],
            f"be the name of a file from the folder of {origin}",
            hint=f"there is one in the working folder: write {_relative(elsewhere, own)!r}",
        )
    return str(found)


def _relative(path: Path, folder: Path) -> str:
    try:
        return Path(os.path.relpath(path, folder)).as_posix()
    except ValueError:  # another drive
        return str(path)


def _check(key: str, found: Path, file: Path, allowed: list[Path]) -> None:
    """Refuse a file outside of the folders that are allowed."""
    target = found.resolve()
    if any(target.is_relative_to(folder) for folder in allowed):
        return
    cures = [f"set {_FOLDERS}={str(target.parent)[:200]}"]
    both = _common(file.resolve().parent, target)
    if both is not None:
        cures.insert(0, f"put an empty {PROJECT_MARKS[0]} into {str(both)[:200]}")
    raise DescriptionError(
        f"{file.name}, {key}",
        str(found)[:200],
        "be a file below the folder of the scene file, below the folder of its project (one with "
        f"{', '.join(PROJECT_MARKS[:-1])} or {PROJECT_MARKS[-1]} in it), or below the working "
        "folder",
        hint=f"if it is meant, {', or '.join(cures)}",
    )


def _common(own: Path, target: Path) -> Path | None:
    """Folder that holds both and may be that of a project; None if there is none."""
    both = next((one for one in (own, *own.parents) if target.is_relative_to(one)), None)
    return None if both is None or both in _no_projects(own) else both


def _no_projects(own: Path) -> set[Path]:
    """The root and the home folder, which hold what no scene file is to name."""
    return {Path(own.anchor), Path(os.path.expanduser("~")).resolve()}


def _exchanged(value: Any, change: Callable[[str, str], str], key: str = "") -> Any:
    """Tables with the names of files exchanged; those of a study are lists by dotted path."""
    if isinstance(value, Mapping):
        return {name: _exchanged(item, change, str(name)) for name, item in value.items()}
    if isinstance(value, list):
        paths = key.split(",")
        if len(paths) == 1:
            return [_exchanged(item, change, key) for item in value]
        return [_exchanged_row(row, change, paths) for row in value]
    if isinstance(value, str) and key.strip().rpartition(".")[2] in _KEYS:
        return change(key.strip(), value)
    return value


def _exchanged_row(row: Any, change: Callable[[str, str], str], paths: list[str]) -> Any:
    """A row of values of paths that vary together."""
    if not isinstance(row, list):
        return row
    named = [*paths, *[""] * (len(row) - len(paths))]
    return [
        _exchanged(item, change, path) for item, path in zip(row, named[: len(row)], strict=True)
    ]
