"""Output folders: what contactkit wrote there, for which scene; files of others are left alone.

The record of a folder, ``contactkit.json``, lists each file with its SHA-256, and what each command
printed. A file may be replaced if the record of the same scene has it and it is unchanged.
"""

from __future__ import annotations

import hashlib
import json
import math
import os
import zlib
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

from attrs import asdict, define, field, frozen

from ..errors import DescriptionError
from ..files.scenes import write_text
from ..reading.archives import checked_archive
from ..reading.texts import from_json, read_text
from ..units import quantity_text

__all__ = [
    "RECORD",
    "Command",
    "FileEntry",
    "Folder",
    "Printed",
    "Record",
    "check_file",
    "check_folder",
    "enter",
    "read_record",
    "written_to",
]

RECORD = "contactkit.json"
"""Name of the record in an output folder."""

Stamps = dict[str, tuple[int, int, int]]

# Suffixes of all files that commands write.
_COMMON = (".csv", ".fmu", ".html", ".npz", ".png", ".ssp")
_SUFFIXES = {
    "gallery": (*_COMMON, ".md", ".pdf", ".svg"),
    "crosscheck": (*_COMMON, ".opt"),
}
_CONTINUED = ("gallery",)  # which finds out itself whether data that are kept can be used
# Member of an archive, or the file itself, that names the program, and how it does so.
_MARKS = {
    ".fmu": ("modelDescription.xml", b'generationTool="contactkit'),
    ".html": ("", b'<meta name="generator" content="contactkit'),
    ".ssp": ("SystemStructure.ssd", b'generationTool="contactkit'),
}
_HEAD = 4000  # bytes in which they do


@frozen
class FileEntry:
    """A file that a command wrote, and the SHA-256 of its content."""

    command: str
    sha256: str


@frozen
class Printed:
    """Text and numbers that a command printed, with the title of its scene and the values set.

    Of a device, whose result is no file, also its plan, its scene as the text of a file, and rows
    of its numbers of validity.
    """

    title: str
    settings: tuple[str, ...]
    text: str
    numbers: Mapping[str, str]
    plan: str = ""
    scene: str = ""
    validity: tuple[tuple[str, ...], ...] = ()


@frozen
class Command:
    """A command and the scene it runs, as typed, with the values that ``--set`` gives."""

    name: str
    scene: str
    settings: tuple[str, ...] = ()

    def outputs(self, folder: Path) -> list[Path]:
        """Files of a folder that the command might have written, by their suffixes."""
        suffixes = _SUFFIXES.get(self.name, _COMMON)
        present = sorted(folder.iterdir()) if folder.is_dir() else []
        return [path for path in present if path.suffix in suffixes and path.is_file()]

    def stamps(self, folder: Path) -> Stamps:
        """Time, size and inode of those files, which tell whether one was written again."""
        found = {path.name: path.stat() for path in self.outputs(folder)}
        return {name: (one.st_mtime_ns, one.st_size, one.st_ino) for name, one in found.items()}


@define
class Record:
    """Record of a folder: its scene, files by name, and what each command printed."""

    scene: str
    files: dict[str, FileEntry] = field(factory=dict)
    printed: dict[str, Printed] = field(factory=dict)


@define
class Folder:
    """An output folder in use by a command."""

    path: Path
    command: Command
    record: Record
    _stamps: Stamps

    def keep(
        self, title: str, text: str, numbers: Mapping[str, tuple[Any, str]], **more: Any
    ) -> None:
        """Keep what the command printed, for the record; columns are in files already.

        `more` are the fields of `Printed` that a device has.
        """
        shown = {
            name: value if isinstance(value, str) else _number_text(value, unit)
            for name, (value, unit) in numbers.items()
            if isinstance(value, str | int | float)
        }
        settings = self.command.settings
        self.record.printed[self.command.name] = Printed(title, settings, text, shown, **more)
        self.enter()

    def enter(self) -> None:
        """Enter the files that are new or changed, drop those that are gone, write the record."""
        files, after = self.record.files, self.command.stamps(self.path)
        for name, stamp in after.items():
            if self._stamps.get(name) != stamp:
                files[name] = FileEntry(self.command.name, _sha256(self.path / name))
        for name in files.keys() - after.keys():
            del files[name]
        self._stamps = after
        if files:
            _write_record(self.path, self.record)


def _number_text(value: float, unit: str) -> str:
    """A number with its unit; what did not occur, such as a release, is nan."""
    return "none" if math.isnan(value) else quantity_text(float(value), unit)


@contextmanager
def written_to(path: Path, command: Command, *, overwrite: bool = False) -> Iterator[Folder]:
    """Let a command write to a folder; at the end, also of a failure, record what it wrote.

    Parameters
    ----------
    path : Path
        The folder, made when the first file is written.
    command : Command
        Who writes.
    overwrite : bool
        Whether files of others may be replaced.

    Raises
    ------
    DescriptionError
        If the folder cannot be written to; without `overwrite` also if it holds files that
        contactkit did not write for this scene, or that were changed since.
    """
    check_folder(path)
    scene = _identity(command.scene, path)
    known = _known(path, overwrite)
    if not overwrite:
        _check_files(path, command, scene, known)
    record = known if known is not None and known.scene == scene else Record(scene)
    folder = Folder(path, command, record, command.stamps(path))
    try:
        yield folder
    except BaseException:
        with suppress(OSError):  # the error that ended the command is the one to report
            folder.enter()
        raise
    folder.enter()


def enter(path: Path, command: str) -> None:
    """Enter a file in the record of its folder, if it has one."""
    record = read_record(path.parent)
    if record is not None:
        record.files[path.name] = FileEntry(command, _sha256(path))
        _write_record(path.parent, record)


def check_file(path: Path, suffix: str, *, overwrite: bool = False) -> None:
    """Refuse to replace a file that contactkit did not write, or that was changed since.

    Pages, FMUs and system structures name the program that wrote them.

    Raises
    ------
    DescriptionError
        Unless `overwrite` is given; also if the file has another suffix.
    """
    if path.suffix != suffix:
        raise DescriptionError("--out", str(path), f"end in {suffix}")
    check_folder(path.parent)
    if path.exists() and not (overwrite or _is_entered(path) or _is_ours(path)):
        hint = "contactkit did not write it; give another file, or --overwrite"
        raise DescriptionError("--out", str(path), "be a new file", hint=hint)


def _is_entered(path: Path) -> bool:
    """Whether the record of its folder has a file, unchanged."""
    record = read_record(path.parent)
    entry = record.files.get(path.name) if record is not None else None
    return entry is not None and not _is_changed(path, entry)


def _is_ours(path: Path) -> bool:
    """Whether a file names contactkit as what wrote it."""
    member, mark = _MARKS.get(path.suffix, ("", b""))
    try:
        with path.open("rb") as file:
            if not member:
                return bool(mark) and mark in file.read(_HEAD)
            with checked_archive(file, path.name) as packed, packed.open(member) as text:
                return mark in text.read(_HEAD)
    except (OSError, ValueError, KeyError, RuntimeError, zlib.error):
        return False


def check_folder(folder: Path) -> None:
    """Refuse a folder that cannot be written to before the work, not after it.

    Raises
    ------
    DescriptionError
        Naming the file or folder that is in the way.
    """
    nearest = next(one for one in (folder, *folder.absolute().parents) if one.exists())
    if not nearest.is_dir():
        hint = f"{nearest} is a file"
    elif not os.access(nearest, os.W_OK):
        hint = f"{nearest} is not writable"
    else:
        return
    raise DescriptionError("--out", str(folder), "be a folder that can be written to", hint=hint)


def _identity(scene: str, folder: Path) -> str:
    """The name of a scene of contactkit, or the path of a file from the folder."""
    if not Path(scene).exists():
        return scene
    try:
        return Path(os.path.relpath(scene, folder)).as_posix()
    except ValueError:  # another drive
        return Path(scene).absolute().as_posix()


def _known(path: Path, overwrite: bool) -> Record | None:
    """Record of a folder, if it has one; one that cannot be read only counts if it must."""
    try:
        return read_record(path)
    except DescriptionError:
        if overwrite:
            return None
        raise


def _check_files(path: Path, command: Command, scene: str, known: Record | None) -> None:
    """Refuse files that the record does not have as written for this scene."""
    present = command.outputs(path)
    cure = "give another folder, or --overwrite"
    if known is not None and known.scene != scene and any(p.name in known.files for p in present):
        expected = "be a folder of this scene, or a new one"
        hint = f"its files are those of {known.scene}; {cure}"
        raise DescriptionError("--out", str(path), expected, hint=hint)
    files = known.files if known is not None else {}
    foreign = [p.name for p in present if p.name not in files]
    own = [] if command.name in _CONTINUED else [p for p in present if p.name in files]
    changed = [p.name for p in own if _is_changed(p, files[p.name])]
    found = [
        *([f"{_listed(foreign)}, which this scene did not write"] if foreign else []),
        *([f"{_listed(changed)}, changed since contactkit wrote it"] if changed else []),
    ]
    if found:
        expected = "hold nothing that might be overwritten"
        raise DescriptionError(
            "--out", str(path), expected, hint=f"it has {' and '.join(found)}; {cure}"
        )


def _listed(names: list[str]) -> str:
    more = f" and {len(names) - 3} more" if len(names) > 3 else ""
    return ", ".join(names[:3]) + more


def _is_changed(path: Path, entry: FileEntry) -> bool:
    return _sha256(path) != entry.sha256


def _sha256(path: Path) -> str:
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def read_record(path: Path) -> Record | None:
    """Read the record of a folder; None if it has none.

    Raises
    ------
    DescriptionError
        If the file is no such record.
    """
    file = path / RECORD
    try:
        table = from_json(read_text(file, "TEXT_BYTES"), str(file))
        return Record(
            _text(table["scene"]),
            {_text(n): FileEntry(*map(_text, one)) for n, one in table["files"].items()},
            {_text(name): _printed(one) for name, one in table["printed"].items()},
        )
    except FileNotFoundError:
        return None
    except (OSError, ValueError, KeyError, TypeError, AttributeError) as error:
        raise DescriptionError(
            "file", str(file), "be a record of contactkit", hint=f"{type(error).__name__}: {error}"
        ) from None


def _printed(table: Any) -> Printed:
    return Printed(
        _text(table["title"]),
        tuple(map(_text, table["settings"])),
        _text(table["text"]),
        {_text(name): _text(value) for name, value in table["numbers"].items()},
        _text(table.get("plan", "")),  # a record of an earlier version has none of these
        _text(table.get("scene", "")),
        tuple(tuple(map(_text, row)) for row in table.get("validity", ())),
    )


def _text(value: Any) -> str:
    if not isinstance(value, str):
        raise TypeError(f"a text is needed, got {value!r:.80}")
    return value


def _write_record(path: Path, record: Record) -> None:
    from .._version import __version__

    table = {
        "contactkit": __version__,
        "scene": record.scene,
        "files": {name: [one.command, one.sha256] for name, one in sorted(record.files.items())},
        "printed": {name: asdict(one) for name, one in record.printed.items()},
    }
    write_text(path / RECORD, json.dumps(table, indent=1) + "\n")
