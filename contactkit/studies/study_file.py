"""File of a study: a SQLite database with a row for each point, read column by column."""

from __future__ import annotations

import errno
import hashlib
import json
import math
import sqlite3
import time
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from ..accuracy import Accuracy
from ..errors import DescriptionError, ValidityWarning, nearest
from ..files.csv_rows import write_rows
from ..frozen import FrozenDict
from ..reading.limits import LIMITS, check_limit, check_size, limit_of
from ..reading.texts import from_json
from .columns import StudyColumns, as_text
from .paths import Axis, Scene
from .run import Done
from .store import FAILED, scene_key

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = ["FailedRow", "StudyFile", "StudyWriter"]

_FORMAT = 1  # of the tables; a file of another one is refused
_APPLICATION = 0x636B7374  # application_id in the head of a database: "ckst"
_TABLES = {
    "header": "key TEXT PRIMARY KEY, value TEXT",
    "units": "name TEXT PRIMARY KEY, unit TEXT",
    "points": "place INTEGER PRIMARY KEY, status TEXT, message TEXT, notes TEXT",
}
_STATUS = 16  # letters of a status; the longest in use has 13
_TEXT = 10_000  # letters of a message that are written: a file of failed points stays small
_LONGEST = 10**9  # bytes: SQLITE_MAX_LENGTH as SQLite is built by default
_OWN = ("place", "status", "message", "notes")
# Seconds between commits at least. Each takes some 5 ms (fsync), 2 % of the time; what is not
# committed is lost if the process is killed.
_PAUSE = 0.25


class FailedRow(NamedTuple):
    """A point without a solution: its place in the product, its parameters, status and message."""

    place: int
    values: Mapping[str, Any]
    status: str
    message: str


class StudyFile(StudyColumns):
    """A study in a file: columns over its points, read when they are asked for.

    Parameters
    ----------
    path : str or Path
        A file that `stream_study` has written, or is writing.

    Attributes
    ----------
    shape : tuple of int
        Number of values of each parameter.
    paths : tuple of tuple of str
        Paths of each parameter, several where they vary together.
    units : mapping of str to str
        Unit of each column.
    sources : tuple of str
        Sources of the equations of all points.
    number_names : tuple of str
        Names of the scalar results, without seconds and counts.

    Raises
    ------
    DescriptionError
        If it is no file of a study.

    Notes
    -----
    `column`, `scalars` and `save_csv` go through the file row by row; `save`, `contents`, `lines`
    and the figures hold all columns in memory.
    """

    shape: tuple[int, ...] = ()
    paths: tuple[tuple[str, ...], ...] = ()
    units: Mapping[str, str] = FrozenDict()
    sources: tuple[str, ...] = ()
    number_names: tuple[str, ...] = ()

    def __init__(self, path: str | Path) -> None:
        self.path = Path(path).with_suffix(".sqlite")
        if not self.path.is_file():
            raise DescriptionError("file", str(path), "exist")
        check_size(self.path)
        with _Closing(self.path, "TEXT_BYTES") as base:
            if problem := _foreign(base):
                raise _no_study(self.path, problem)
            header = dict(base.execute("SELECT key, value FROM header"))
        axes = _checked_axes(from_json(str(header.get("axes")), str(self.path)), self.path)
        # A file of before version 0.2 has neither.
        self.sources, self._counts = (
            _checked_texts(from_json(str(header.get(key, "[]")), str(self.path)), self.path)
            for key in ("sources", "counts")
        )
        with self._opened() as base:
            units = dict(base.execute("SELECT name, unit FROM units"))
        self.paths = tuple(tuple(axis["paths"]) for axis in axes)
        self._values = {
            p: [row[i] for row in a["values"]] for a in axes for i, p in enumerate(a["paths"])
        }
        self.shape = tuple(len(axis["values"]) for axis in axes)
        check_limit("POINTS", self.n_points, str(self.path))
        varied = {p: u for a in axes for p, u in zip(a["paths"], a["units"], strict=True)}
        self.units: dict[str, str] = varied | units
        if not all(isinstance(text, str) for pair in self.units.items() for text in pair):
            raise _no_study(self.path, "a unit is no text")
        own = {*varied, *self._counts, "seconds"}
        self.number_names = tuple(name for name in self.units if name not in own)

    def _opened(self) -> _Closing:
        return _Closing(self.path, "CELL_BYTES")

    @property
    def status(self) -> str:
        """``complete``, or ``incomplete`` if a point has no solution or is not solved yet."""
        return "complete" if self.n_done == self.n_points and not self.n_failed else "incomplete"

    @property
    def message(self) -> str:
        """Number of points and parameters, of those left and of those without a solution."""
        left, failed = self.n_points - self.n_done, self.n_failed
        return (
            self._over
            + (f"; {left} not solved yet" if left else "")
            + (f"; {failed} without a solution" if failed else "")
        )

    def scalars(self) -> dict[str, tuple[float, str]]:
        """Return numbers of the whole study: points, seconds and counts, added up."""
        summed = [name for name in ("seconds", *self._counts) if name in self.units]
        return {
            "n_points": (self.n_points, "-"),
            "n_done": (self.n_done, "-"),
            "n_failed": (self.n_failed, "-"),
            **{n: (float(np.nansum(self.column(n))), self.units[n]) for n in summed},
        }

    @property
    def n_done(self) -> int:
        """Number of points that are in the file."""
        with self._opened() as base:
            return int(base.execute("SELECT count(*) FROM points").fetchone()[0])

    @property
    def n_failed(self) -> int:
        """Number of points in the file without a solution."""
        marks = ", ".join("?" * len(FAILED))
        wanted = f"SELECT count(*) FROM points WHERE status IN ({marks})"
        with self._opened() as base:
            return int(base.execute(wanted, FAILED).fetchone()[0])

    def column(self, name: str) -> NDArray[Any]:
        """Return one column over all points, as `Study.column`; nan where there is no value.

        ``status`` is empty where a point is not solved yet.

        Raises
        ------
        DescriptionError
            If there is no such column.
        """
        if name in self._values:
            i = next(i for i, paths in enumerate(self.paths) if name in paths)
            given = np.array(self._values[name])
            places = np.arange(self.n_points) // math.prod(self.shape[i + 1 :]) % self.shape[i]
            column: NDArray[Any] = given[places]
            return column.astype(float) if column.dtype.kind in "iuf" else column
        if name not in self.units and name != "status":
            raise DescriptionError(
                "column", name, "be one of the study", hint=nearest(name, list(self.units))
            )
        is_text = name == "status"
        found = np.full(
            self.n_points, "" if is_text else np.nan, f"U{_STATUS}" if is_text else float
        )
        with self._opened() as base:
            for place, value in base.execute(f"SELECT place, {_quoted(name)} FROM points"):
                if not isinstance(value, str if is_text else float | int | None):
                    raise _no_study(self.path, f"{value!r:.40} in the column {name}")
                if isinstance(value, str) and len(value) > _STATUS:
                    raise _no_study(self.path, f"a status of {len(value):,} letters")
                found[self._checked(place)] = value if value is not None else np.nan
        return found

    def _checked(self, place: Any) -> int:
        """Return the number of a point, which the file may state wrongly."""
        if isinstance(place, int) and 0 <= place < self.n_points:
            return place
        raise _no_study(self.path, f"{place!r:.40} is the place of no point")

    def failed(self) -> Iterator[FailedRow]:
        """Yield the points without a solution."""
        marks = ", ".join("?" * len(FAILED))
        wanted = f"SELECT place, status, message FROM points WHERE status IN ({marks})"
        with self._opened() as base:
            for place, status, message in base.execute(f"{wanted} ORDER BY place", FAILED):
                yield FailedRow(place, self._values_at(place), status, message)

    def forget_failed(self) -> int:
        """Remove points that failed or were refused, so that they are solved again; how many."""
        base = sqlite3.connect(self.path)
        with base:
            gone = base.execute("DELETE FROM points WHERE status IN ('failed', 'refused')").rowcount
        base.close()
        return int(gone)

    def _values_at(self, place: int) -> dict[str, Any]:
        at = np.unravel_index(self._checked(place), self.shape)
        return {
            p: self._values[p][int(i)] for i, ps in zip(at, self.paths, strict=True) for p in ps
        }

    def save_csv(self, path: str | Path) -> Path:
        """Write all columns to a CSV file, row by row and atomically."""
        numbers = [name for name in self.units if name not in self._values]
        chosen = ", ".join(["place", *map(_quoted, numbers), "status", "message"])
        varied = list(self._values)
        heads = [f"{name} [{self.units[name]}]" for name in (*varied, *numbers)]
        with self._opened() as base:
            found = base.execute(f"SELECT {chosen} FROM points ORDER BY place")
            rows = (
                [*(_cell(self._values_at(place)[name]) for name in varied), *map(_cell, row)]
                for place, *row in found
            )
            return write_rows(Path(path).with_suffix(".csv"), [*heads, "status", "message"], rows)

    def __repr__(self) -> str:
        return f"StudyFile({self.path.name!r}, {self.n_done} of {self.n_points} points)"


class _Closing:
    """A connection that reads, closed at the end of a ``with`` block; its errors name the file."""

    def __init__(self, path: Path, limit: str) -> None:
        self._path, self._limit = path, limit
        self._base = sqlite3.connect(f"{path.resolve().as_uri()}?mode=ro", uri=True)
        _guard(self._base, limit)

    def __enter__(self) -> sqlite3.Connection:
        return self._base

    def __exit__(self, _: object, error: object, trace: object) -> None:
        self._base.close()
        if isinstance(error, DescriptionError):
            return
        if isinstance(error, sqlite3.Error | ValueError | OverflowError | MemoryError):
            raise _unread(self._path, error, self._limit) from None


def _unread(path: Path, error: Exception, limit: str) -> DescriptionError:
    """Refusal of a file that SQLite does not read, for a text beyond a limit perhaps."""
    if not (isinstance(error, sqlite3.DataError) and "too big" in str(error)):
        return _no_study(path, str(error)[:200])
    expected = f"have texts and rows of at most {LIMITS[limit].text(limit_of(limit))}"
    hint = f"if longer ones are meant, raise CONTACTKIT_MAX_{limit}"
    return DescriptionError("file", str(path), expected, hint=hint)


def _guard(base: sqlite3.Connection, limit: str) -> None:
    """Let a connection run no functions of a schema, and take no longer texts than a limit."""
    base.execute("PRAGMA trusted_schema = OFF")
    base.setlimit(sqlite3.SQLITE_LIMIT_LENGTH, min(limit_of(limit), _LONGEST))


def _foreign(base: sqlite3.Connection) -> str:
    """What a database has that no file of a study has, or lacks; empty if there is nothing."""
    missing = set(_TABLES)
    for kind, name, text in base.execute("SELECT type, name, sql FROM sqlite_master"):
        if kind == "index" and text is None:  # of a primary key
            continue
        if kind != "table" or name not in _TABLES:
            return f"it holds a {kind} {name!r:.40}: a study holds no views, triggers and the like"
        if not str(text).startswith("CREATE TABLE"):
            return f"its table {name} is none of its own"
        missing.discard(name)
        for _, column, _, _, default, _, hidden in base.execute(f"PRAGMA table_xinfo({name})"):
            if hidden or default is not None:
                return f"its column {column!r:.40} is computed"
    return f"it has no table {min(missing)}" if missing else ""


def _cell(value: Any) -> Any:
    """A number of a row as text; others as they are."""
    return f"{value:.10g}" if isinstance(value, float) else "nan" if value is None else value


def _no_study(path: Path, why: str) -> DescriptionError:
    return DescriptionError("file", str(path), "be a study", hint=why)


def _checked_axes(axes: Any, path: Path) -> list[dict[str, Any]]:
    """Return the axes of a file if they are lists of paths, units and rows of plain values."""
    is_sound = isinstance(axes, list) and all(
        isinstance(axis, dict)
        and all(
            isinstance(axis.get(key), list) and axis[key] for key in ("paths", "units", "values")
        )
        and all(isinstance(text, str) for text in (*axis["paths"], *axis["units"]))
        and len(axis["units"]) == len(axis["paths"])
        and all(_is_row(row, len(axis["paths"])) for row in axis["values"])
        for axis in axes
    )
    if not is_sound:
        raise _no_study(path, "its axes are no lists of paths, units and rows of values")
    return list(axes)


def _checked_texts(texts: Any, path: Path) -> tuple[str, ...]:
    """Return a list of texts of the header."""
    if not (isinstance(texts, list) and all(isinstance(text, str) for text in texts)):
        raise _no_study(path, "its sources or counts are no list of texts")
    return tuple(texts)


def _is_row(row: Any, width: int) -> bool:
    """Whether it is a row of as many numbers, texts or truth values as an axis has paths."""
    return (
        isinstance(row, list)
        and len(row) == width
        and all(isinstance(value, float | int | str | None) for value in row)
    )


class StudyWriter:
    """Writer of the file of a study; a context manager, which ends with all rows on the disk.

    Raises
    ------
    DescriptionError
        If the file is there and is not of the same study; it is left as it is.
    """

    def __init__(
        self,
        path: str | Path,
        scene: Scene,
        accuracy: Accuracy,
        varied: Sequence[Axis],
        sources: Sequence[str],
    ) -> None:
        self.path = Path(path).with_suffix(".sqlite") if str(path) != ":memory:" else Path(path)
        self.path.parent.mkdir(parents=True, exist_ok=True)
        axes = [
            {
                "paths": a.paths,
                "units": a.units,
                "values": [[_plain(v) for v in r] for r in a.values],
            }
            for a in varied
        ]
        text = json.dumps(axes)
        check_limit("TEXT_BYTES", len(text), f"values of {self.path.name}")
        digest = hashlib.sha256(text.encode()).hexdigest()
        header = {
            "format": str(_FORMAT),
            "key": f"{scene_key(scene, accuracy)} {digest}",
            "axes": text,
            "sources": json.dumps(sources),
        }
        self._done = np.zeros(math.prod(len(axis.values) for axis in varied), dtype=bool)
        is_new = not (self.path.is_file() and self.path.stat().st_size)
        self._base = sqlite3.connect(self.path)
        try:
            if is_new:
                self._make()
            else:
                self._check(header)
            self._begin(header)
        except sqlite3.Error as error:
            self._base.close()
            raise DescriptionError(
                "file", str(path), "be the file of a study", hint=str(error)
            ) from None
        except DescriptionError:
            self._base.close()
            raise
        _guard(self._base, "CELL_BYTES")
        self._columns = {row[1] for row in self._base.execute("PRAGMA table_info(points)")}
        found = self._base.execute("SELECT value FROM header WHERE key = 'counts'").fetchone()
        self._counts = tuple(from_json(found[0], self.path.name)) if found else ()
        self._written = time.monotonic()

    def _make(self) -> None:
        """Make the tables of a new file, and name it as ours."""
        for name, columns in _TABLES.items():
            self._base.execute(f"CREATE TABLE {name} ({columns})")
        self._base.execute(f"PRAGMA application_id = {_APPLICATION}")

    def _check(self, header: Mapping[str, str]) -> None:
        """Refuse a file of others, or of another study, before anything is written to it."""
        base = self._base
        _guard(base, "TEXT_BYTES")
        problem = _foreign(base)
        if base.execute("PRAGMA application_id").fetchone()[0] != _APPLICATION:
            problem = problem or "contactkit did not write it"
        elif dict(base.execute("SELECT key, value FROM header")).get("key") != header["key"]:
            problem = "it holds a study of another scene, accuracy, version or other values"
        if problem:
            expected = "be a new file, or that of the same study"
            hint = f"{problem}; give another file"
            raise DescriptionError("stream_study(path)", str(self.path), expected, hint=hint)

    def _begin(self, header: Mapping[str, str]) -> None:
        """Write what the study is, and look which of its points are there."""
        base = self._base
        base.executemany("INSERT OR REPLACE INTO header VALUES (?, ?)", header.items())
        base.commit()
        for (place,) in base.execute("SELECT place FROM points"):
            if not (isinstance(place, int) and 0 <= place < self._done.size):
                raise _no_study(self.path, f"{place!r:.40} is the place of no point")
            self._done[place] = True

    def is_done(self, place: int) -> bool:
        """Whether a point is in the file."""
        return bool(self._done[place])

    @property
    def n_done(self) -> int:
        """Number of points in the file."""
        return int(self._done.sum())

    @property
    def n_solved(self) -> int:
        """Number of points that are neither failed nor refused; counted in the file."""
        wanted = "SELECT count(*) FROM points WHERE status NOT IN ('failed', 'refused')"
        return int(self._base.execute(wanted).fetchone()[0])

    def outside(self) -> tuple[int, str]:
        """Number of points outside the range of a model, and the names of the models."""
        mark = f"{ValidityWarning.__name__}: "
        wanted = "SELECT notes, count(*) FROM points WHERE notes LIKE ? GROUP BY notes"
        rows = self._base.execute(wanted, (f"%{mark}%",)).fetchall()
        names = [one for notes, _ in rows for one in notes.split("; ") if one.startswith(mark)]
        return sum(n for _, n in rows), ", ".join(
            dict.fromkeys(n.removeprefix(mark) for n in names)
        )

    def first_message(self) -> str:
        """Message of the first point."""
        row = self._base.execute("SELECT message FROM points ORDER BY place LIMIT 1").fetchone()
        return str(row[0]) if row else ""

    def write(self, points: Sequence[Done]) -> None:
        """Write points; they are on the disk within a fraction of a second, or at the end.

        Raises
        ------
        OSError
            Naming the file, if the disk is full for example; what is on the disk stays there.
        """
        try:
            self._insert(points)
            if time.monotonic() - self._written > _PAUSE:
                self._base.commit()
                self._written = time.monotonic()
        except sqlite3.OperationalError as error:
            raise _unwritten(self.path, error) from None

    def _insert(self, points: Sequence[Done]) -> None:
        for place, point, _ in points:
            numbers = {n: (float(v), unit) for n, (v, unit) in point.scalars.items()}
            numbers |= {"seconds": (point.seconds, "s")}
            numbers |= {n: (float(v), "-") for n, v in point.counts.items()}
            for name, (_, unit) in numbers.items():
                if name not in self._columns:
                    self._add(name, unit)
            self._count(point.counts)
            # Of a solved point the numbers are kept; of its notes, which models are outside.
            message = point.message[:_TEXT] if point.has_failed else ""
            notes = "; ".join(dict.fromkeys(note.partition(" = ")[0] for note in point.notes))
            row = {"place": place, "status": point.status, "message": message}
            row["notes"] = notes[:_TEXT]
            row |= {n: v if math.isfinite(v) else _text_of(v) for n, (v, _) in numbers.items()}
            names, marks = ", ".join(map(_quoted, row)), ", ".join("?" * len(row))
            self._base.execute(
                f"INSERT OR REPLACE INTO points ({names}) VALUES ({marks})", tuple(row.values())
            )
            self._done[place] = True

    def _add(self, name: str, unit: str) -> None:
        self._base.execute(f"ALTER TABLE points ADD COLUMN {_quoted(name)} REAL")
        self._base.execute("INSERT OR REPLACE INTO units VALUES (?, ?)", (name, unit))
        self._columns.add(name)

    def _count(self, names: Iterable[str]) -> None:
        """Write which columns are counts, once they are new."""
        if any(name not in self._counts for name in names):
            self._counts = tuple(dict.fromkeys((*self._counts, *names)))
            row = ("counts", json.dumps(self._counts))
            self._base.execute("INSERT OR REPLACE INTO header VALUES (?, ?)", row)

    @property
    def n_bytes(self) -> int:
        """Size of the file [bytes]."""
        self._base.commit()
        pages, size = (
            self._base.execute(f"PRAGMA {name}").fetchone()[0]
            for name in ("page_count", "page_size")
        )
        return int(pages * size)

    def __enter__(self) -> StudyWriter:
        return self

    def __exit__(self, kind: object, error: object, *_: object) -> None:
        try:
            self._base.commit()
        except sqlite3.OperationalError as other:
            if kind is None:  # else the first error is raised
                raise _unwritten(self.path, other) from None
        finally:
            self._base.close()
        if isinstance(error, sqlite3.Error):
            raise _unread(self.path, error, "CELL_BYTES") from None


def _unwritten(path: Path, error: sqlite3.OperationalError) -> OSError:
    is_full = error.sqlite_errorcode == sqlite3.SQLITE_FULL
    return OSError(errno.ENOSPC if is_full else errno.EIO, str(error), str(path))


def _text_of(value: float) -> float | None:
    """An infinite number as it is; nan, which SQLite does not have, as none."""
    return None if math.isnan(value) else value


def _plain(value: Any) -> Any:
    """A value of a parameter as JSON has it: numbers, truth values and texts."""
    return value if isinstance(value, bool | int | float | str) else as_text(value)


def _quoted(name: str) -> str:
    return '"' + name.replace('"', '""') + '"'
