"""Files that a scene file names: below its own folder or the working folder."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from ..errors import DescriptionError

__all__ = ["check_references"]

_BESIDE = "contact"  # looked for in the folder of the file first
_KEYS = ("path", _BESIDE)
_FOLDERS = "CONTACTKIT_READ_FROM"


def check_references(tables: Mapping[str, Any], file: Path) -> None:
    """Refuse a scene file that names a file elsewhere, which its author may not have meant to open.

    Links are followed: what counts is where a file is. The environment variable
    ``CONTACTKIT_READ_FROM`` lists more folders, separated as in ``PATH``.

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
    own = file.resolve().parent
    more = [one for one in os.environ.get(_FOLDERS, "").split(os.pathsep) if one]
    allowed = [own, Path.cwd().resolve(), *(Path(one).resolve() for one in more)]
    for key, name in _named(tables):
        if "\0" in name:
            raise DescriptionError(f"{file.name}, {key}", name[:80], "be the name of a file")
        _check(own, key, name, file, allowed)


def _check(own: Path, key: str, name: str, file: Path, allowed: list[Path]) -> None:
    try:
        is_beside = (own / name).is_file() and key.rpartition(".")[2] == _BESIDE
        found = Path(own if is_beside else Path.cwd(), name).resolve()
    except (OSError, RuntimeError) as error:  # a name of too many letters, a circle of links
        raise DescriptionError(
            f"{file.name}, {key}", name[:80], "be the name of a file", hint=str(error)[:200]
        ) from None
    at, folder = str(found)[:200], str(found.parent)[:200]
    if not any(found.is_relative_to(folder) for folder in allowed):
        raise DescriptionError(
            f"{file.name}, {key}",
            name[:200],
            "be a file below the folder of the scene file, or below the working folder",
            hint=f"it is {at}; if it is meant, set {_FOLDERS}={folder}",
        )


def _named(value: Any, key: str = "") -> Iterator[tuple[str, str]]:
    """Names of files in tables, with their keys; those of a study are lists by dotted path."""
    if isinstance(value, Mapping):
        for name, item in value.items():
            yield from _named(item, str(name))
    elif isinstance(value, list):
        for item in value:
            yield from _named(item, key)
    elif isinstance(value, str) and any(
        path.strip().rpartition(".")[2] in _KEYS for path in key.split(",")
    ):
        yield key, value
