"""Zip archives: names, sizes and compression ratio checked before a member is read."""

from __future__ import annotations

import stat
import struct
import tokenize
import zipfile
import zlib
from collections.abc import Iterator
from contextlib import contextmanager
from typing import IO

from ..errors import ContactkitError, DescriptionError
from .limits import check_limit

__all__ = ["UNREADABLE", "checked_archive", "member"]

UNREADABLE = (
    OSError,
    ValueError,
    LookupError,
    TypeError,
    AttributeError,
    ArithmeticError,
    RuntimeError,  # of an encrypted member, and of recursion
    MemoryError,
    EOFError,
    StopIteration,
    SyntaxError,
    struct.error,
    tokenize.TokenError,
    zipfile.BadZipFile,
    zlib.error,
)
"""What the libraries raise for files that are damaged or made to be; one error stands for all."""

_SMALL = 2**24  # [bytes] below which a ratio does no harm
_COMPRESSIONS = (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED)  # the others unpack without a bound


@contextmanager
def checked_archive(source: IO[bytes], where: str) -> Iterator[zipfile.ZipFile]:
    """Open a zip archive whose members are harmless to read and to unpack.

    Parameters
    ----------
    source : binary file
        The archive; it can be seeked.
    where : str
        Its name, for messages.

    Raises
    ------
    DescriptionError
        If it is no archive; if a member has a name that leads out of a folder, is a link, is there
        twice, is encrypted or compressed in an unusual form; if there are too many members, or too
        many bytes once unpacked, or too many of them for the size of the archive.
    """
    size = source.seek(0, 2)
    source.seek(0)
    check_limit("BYTES", size, where)
    try:
        packed = zipfile.ZipFile(source)
    except UNREADABLE as error:
        raise DescriptionError(
            "file", where, "be a zip archive", hint=f"{type(error).__name__}: {error}"
        ) from None
    with packed:
        _check_members(packed.infolist(), size, where)
        yield packed


def _check_members(members: list[zipfile.ZipInfo], size: int, where: str) -> None:
    check_limit("MEMBERS", len(members), where)
    unpacked = sum(one.file_size for one in members)
    check_limit("BYTES", unpacked, f"{where}, unpacked")
    if unpacked > _SMALL:
        check_limit("RATIO", unpacked / size, where)
    seen = set[str]()
    for one in members:
        if trouble := _trouble(one, seen):
            name = one.orig_filename[:80]
            raise DescriptionError(f"{where}, member", name, trouble)
        seen.add(one.filename)


def _trouble(one: zipfile.ZipInfo, seen: set[str]) -> str:
    """What a member of an archive must be and is not; empty if it is fine."""
    name = one.orig_filename  # as it is there: the other is cut at a zero byte
    parts = name.removesuffix("/").split("/")
    if not name.isprintable() or set(name) & set("\\:") or {"", ".", ".."} & set(parts):
        return "be a path inside the archive: relative, with forward slashes, without .."
    if name in seen:
        return "be there once"
    if stat.S_IFMT(one.external_attr >> 16) not in (0, stat.S_IFREG, stat.S_IFDIR):
        return "be a file or a folder, not a link or a device"
    if one.flag_bits & 0x1:
        return "not be encrypted"
    if one.compress_type not in _COMPRESSIONS:
        return "be stored or deflated"
    return ""


def member(packed: zipfile.ZipFile, name: str, limit: str, where: str) -> bytes:
    """Content of a member of limited size of a `checked_archive`.

    Raises
    ------
    DescriptionError
        If there is none of that name, it is larger than the limit of this name, or damaged.
    """
    try:
        info = packed.getinfo(name)
        check_limit(limit, info.file_size, f"{where}, {name}")
        return packed.read(info)
    except KeyError:
        raise DescriptionError("file", where, f"have a member {name}") from None
    except ContactkitError:
        raise
    except UNREADABLE as error:
        raise DescriptionError(
            "file", where, f"have a member {name} that is whole", hint=str(error)
        ) from None
