"""Points of a study, and the folder that stores them, one atomically written file each."""

from __future__ import annotations

import hashlib
import inspect
import json
import time
from collections.abc import Iterator, Mapping
from contextlib import suppress
from functools import lru_cache
from pathlib import Path
from types import CodeType
from typing import TYPE_CHECKING, Any

import attrs
from attrs import field, frozen

from ..accuracy import Accuracy
from ..errors import DescriptionError
from ..files.scenes import write_whole
from ..files.unstructure import unstructure
from ..reading.texts import from_json, read_text
from ..scene.planforms import ImageFile
from ..scene.rough_surfaces import Measured
from ..scene.scales import Scale

if TYPE_CHECKING:
    from .paths import Scene

__all__ = ["FAILED", "Store", "StudyPoint", "scene_key"]

_FORMAT = 3  # of the files: part of every key, so that older ones are never found
# Seconds after which incomplete files are taken for those of a killed run and removed: writing one
# takes less than a minute even on a slow network disk, and another run may be at it.
_OLD = 3600.0

FAILED = ("infeasible", "not converged", "refused", "failed")
"""Statuses of points without a solution."""


@frozen(eq=False)
class StudyPoint:
    """One point of a study.

    Attributes
    ----------
    values : mapping
        Varied parameters by path, in SI units.
    scalars : mapping of str to (float, str)
        Numbers of the result with their units; nan where the point has none.
    status, message : str
        Those of the result; or ``infeasible``, ``not converged``, ``refused`` or ``failed`` (a
        defect, or a worker that ended), and why.
    seconds : float
        Time of the solve [s].
    counts : mapping of str to int
        Operation counts, such as ``n_operator_applications``.
    notes : tuple of str
        Warnings of the run, and of its file.
    is_from_store : bool
        Whether it was read from the store, not solved.
    scales : mapping of str to Scale
        Reference scales of the result by unit, `Result.scales`; none without a solution.
    """

    values: Mapping[str, Any]
    scalars: Mapping[str, tuple[float, str]] = field(repr=False)
    status: str
    message: str = field(repr=False)
    seconds: float
    counts: Mapping[str, int] = field(factory=dict, repr=False)
    notes: tuple[str, ...] = ()
    is_from_store: bool = False
    scales: Mapping[str, Scale] = field(factory=dict, repr=False)

    @property
    def has_failed(self) -> bool:
        """Whether this point has no solution."""
        return self.status in FAILED

    @property
    def n_operator_applications(self) -> int:
        """Applications of the compliance operator in a contact; 0 for a separation."""
        return self.counts.get("n_operator_applications", 0)


def scene_key(scene: Scene, accuracy: Accuracy) -> str:
    """Key of a point: a hash of all that its results depend on.

    Of classes of your own it holds the content of the file that defines them.
    """
    from .._version import __version__

    tables = unstructure(scene, {}, for_key=True)
    tables.pop("name", None)  # a title does not change results
    _name_by_content(tables)
    what = [_FORMAT, __version__, tables, accuracy.values]
    if own := sorted(set(_own_code(scene))):
        what.append(own)
    return hashlib.sha256(json.dumps(what, sort_keys=True).encode()).hexdigest()[:40]


def _own_code(value: Any) -> Iterator[str]:
    """Content of the source files of classes in a scene that are not of contactkit."""
    if isinstance(value, tuple | list):
        for item in value:
            yield from _own_code(item)
    elif attrs.has(type(value)):
        kind = type(value)
        if kind.__module__.partition(".")[0] != __package__.partition(".")[0]:
            yield _content(_source_file(kind))
        for one in attrs.fields(kind):
            yield from _own_code(getattr(value, one.name))


def _source_file(kind: type) -> str:
    """File of a class; of one that was typed into a session what its functions compute."""
    try:
        return inspect.getfile(kind)
    except (TypeError, OSError):
        functions = [one for one in vars(kind).values() if inspect.isfunction(one)]
        made = [_computed(one.__code__) for one in functions]
        return f"{kind.__qualname__} {made}"


def _computed(code: CodeType) -> list[Any]:
    """Operations, names and constants of a function and of those inside it."""
    inner = [_computed(one) if isinstance(one, CodeType) else repr(one) for one in code.co_consts]
    return [code.co_code.hex(), code.co_names, inner]


def _name_by_content(value: Any) -> None:
    """Name height maps and images in tables by what their files hold, wherever these are."""
    for item in value.values() if isinstance(value, dict) else value:
        if isinstance(item, dict | list):
            _name_by_content(item)
    if isinstance(value, dict) and value.get("shape") in (Measured.kind, ImageFile.kind):
        value["path"] = _content(value["path"])


@frozen
class Store:
    """A folder of finished points.

    The key of a point is made from all its results depend on: scene, accuracy, the content of
    measured surfaces and the version of contactkit. A folder may thus hold points of many studies,
    and concurrent studies may use the same one.

    Parameters
    ----------
    folder : Path
        Created when the first point is written.
    """

    folder: Path = field(converter=Path)

    def key(self, scene: Scene, accuracy: Accuracy) -> str:
        """Return the key of a point."""
        return scene_key(scene, accuracy)

    def read(self, key: str, values: Mapping[str, Any]) -> StudyPoint | None:
        """Return a point; None if there is none.

        Raises
        ------
        DescriptionError
            If the file exists and cannot be read.
        """
        path = self._point(key)
        try:
            table = from_json(read_text(path, "TEXT_BYTES"), path.name)
            scalars = {n: (float(v), str(unit)) for n, (v, unit) in table["scalars"].items()}
            counts = {str(n): int(v) for n, v in table["counts"].items()}
            notes = tuple(map(str, table["notes"]))
            scales = {
                unit: Scale(float(value), str(name), str(text))
                for unit, (value, name, text) in table["scales"].items()
            }
            said = (str(table["status"]), str(table["message"]), float(table["seconds"]))
        except FileNotFoundError:
            return None
        except (
            OSError,
            ValueError,
            LookupError,
            TypeError,
            AttributeError,
            ArithmeticError,
        ) as error:
            raise DescriptionError(
                "file", path.name, "be a point of a study", hint=f"{type(error).__name__}: {error}"
            ) from None
        return StudyPoint(values, scalars, *said, counts, notes, True, scales)

    def read_maps(self, key: str) -> bytes | None:
        """Return the result of a point as written; None if there is none."""
        path = self._maps(key)
        return path.read_bytes() if path.is_file() else None

    def write(self, key: str, point: StudyPoint, maps: bytes | None) -> None:
        """Write a point; its maps first, so that an existing point has them."""
        if maps is not None:
            with write_whole(self._maps(key)) as temporary:
                temporary.write_bytes(maps)
        table = {
            "values": {name: str(value) for name, value in point.values.items()},
            "status": point.status,
            "message": point.message,
            # as text, because JSON has no infinity
            "scalars": {n: [repr(float(v)), unit] for n, (v, unit) in point.scalars.items()},
            "scales": {unit: [repr(one.value), *one[1:]] for unit, one in point.scales.items()},
            "seconds": point.seconds,
            "counts": dict(point.counts),
            "notes": list(point.notes),
        }
        with write_whole(self._point(key)) as temporary:
            temporary.write_text(json.dumps(table, indent=1), encoding="utf-8")

    def has(self, key: str, with_maps: bool) -> bool:
        """Whether a point is stored, with its maps if required."""
        return self._point(key).is_file() and (not with_maps or self._maps(key).is_file())

    def sweep(self) -> None:
        """Remove incomplete files of killed runs, but not those of concurrent ones."""
        for path in self.folder.glob(".*-????????.*"):
            with suppress(OSError):  # another run may have finished the file
                if path.suffix in (".json", ".npz") and path.stat().st_mtime < time.time() - _OLD:
                    path.unlink()

    def _point(self, key: str) -> Path:
        return self.folder / f"{key}.json"

    def _maps(self, key: str) -> Path:
        return self.folder / f"{key}.npz"


def _content(path: str) -> str:
    """Checksum of a file, or its name if it does not exist: the run will report that."""
    try:
        found = Path(path).stat()
        return _checksum(path, found.st_mtime_ns, found.st_size)
    except OSError:
        return path


@lru_cache(maxsize=64)
def _checksum(path: str, changed: int, size: int) -> str:
    with open(path, "rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()
