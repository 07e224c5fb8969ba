"""Files that a description names: there, with the checksum it states, and read once."""

from __future__ import annotations

import hashlib
import os
from collections.abc import Callable
from os import PathLike
from pathlib import Path
from typing import Generic, Protocol, TypeVar
from weakref import WeakKeyDictionary

from ..errors import DescriptionError

__all__ = ["Contents", "NamesFile", "check_digest", "digest_of", "existing"]


def existing(path: str | PathLike[str], field: str) -> Path:
    """A file; `field` is what the message begins with.

    Raises
    ------
    DescriptionError
        If there is no such file.
    """
    file = Path(path)
    try:
        is_there = file.is_file()
    except OSError:  # a name of too many letters
        is_there = False
    if not is_there:
        hint = "" if file.is_absolute() else f"it is looked for in the working folder, {Path.cwd()}"
        raise DescriptionError(field, str(path), "be a file that exists", hint=hint)
    return file


def digest_of(file: Path) -> str:
    """SHA-256 of a file, in hexadecimal digits."""
    with file.open("rb") as content:
        return hashlib.file_digest(content, "sha256").hexdigest()


def check_digest(file: Path, found: str, stated: str, field: str) -> None:
    """Refuse a file whose SHA-256 is not that stated, with or without ``sha256:`` before it.

    Raises
    ------
    DescriptionError
        If it is another one.
    """
    if stated.lower().removeprefix("sha256:") != found:
        hint = "the file has changed since, or is another one"
        raise DescriptionError(field, stated, f"be that of {file.name}, {found}", hint=hint)


class NamesFile(Protocol):
    """A description that names a file."""

    @property
    def path(self) -> str:
        """The file."""


K = TypeVar("K", bound=NamesFile)
V = TypeVar("V")


class Contents(Generic[K, V]):
    """Contents of files that descriptions name: read once for as long as they do not change.

    It goes with the last reference to the description, as a map may take 100 MB.

    Parameters
    ----------
    read : callable
        Reads the file of a description.
    """

    def __init__(self, read: Callable[[K], V]) -> None:
        self._read = read
        self._known: WeakKeyDictionary[K, tuple[int, V]] = WeakKeyDictionary()

    def __len__(self) -> int:
        return len(self._known)

    def of(self, owner: K) -> V:
        """Content of the file that a description names."""
        changed = os.stat(owner.path).st_mtime_ns if os.path.exists(owner.path) else 0
        known = self._known.get(owner)
        if known is None or known[0] != changed:
            self._known.pop(owner, None)  # so that the key is this description, not an equal one
            known = self._known[owner] = (changed, self._read(owner))
        return known[1]
