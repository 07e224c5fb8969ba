"""Scene files: TOML, read completely or refused with all errors."""

from __future__ import annotations

import os
import re
import tomllib
import uuid
import warnings
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any, Generic, NamedTuple, TypeVar, overload

import attrs

from ..accuracy import Accuracy
from ..errors import DescriptionError
from ..kinds import LOADINGS
from ..reading.limits import check_limit
from ..reading.references import references_from, resolved_references
from ..reading.texts import check_keys, check_plain, check_texts, read_text
from ..scene.loading import ContactLoading, Sliding
from ..scene.scenes import ContactScene, Scene, SeparationScene, SlidingScene
from .structure import (
    FileError,
    FileProblem,
    load_liquid,
    load_material,
    read_part,
    structure,
    telling_lines,
    unstructure,
)

__all__ = [
    "load_liquid",
    "load_material",
    "load_scene",
    "SceneFile",
    "read_scene",
    "read_tables",
    "save_scene",
    "scene_kind",
    "scene_text",
    "structure",
    "telling_lines",
    "unstructure",
    "write_text",
    "write_whole",
]


S = TypeVar("S", bound=Scene)


class SceneFile(NamedTuple, Generic[S]):
    """Content of a scene file: the scene, its accuracy, and the values of a study."""

    scene: S
    accuracy: Accuracy
    parameters: Mapping[str, list[Any]]


def read_scene(tables: Mapping[str, Any], kind: type[S], origin: str) -> SceneFile[S]:
    """Read a scene with the tables ``accuracy`` and ``study`` of its file, if it has them.

    Raises
    ------
    DescriptionError
        Listing every mistake and where it is.
    """
    rest = dict(tables)
    accuracy, problems = read_part(rest.pop("accuracy", {}), Accuracy, "accuracy")
    study = rest.pop("study", {})
    scene, mistakes = read_part(rest, kind)
    problems += mistakes
    if not isinstance(study, Mapping) or not all(isinstance(v, list) for v in study.values()):
        hint = '"loading.pressure" = [...]'
        error = DescriptionError("study", study, "be a table of lists", hint=hint)
        problems.append(FileProblem(str(error), "study"))
    if scene is None or accuracy is None or problems:
        raise FileError(origin, problems)
    return SceneFile(scene, accuracy, study)


def read_tables(path: str | Path) -> dict[str, Any]:
    """Read a TOML file; names of files in it become absolute, found from its folder.

    Raises
    ------
    DescriptionError
        If the file does not exist, is not TOML, exceeds a limit of `contactkit.reading`, or names
        files elsewhere.
    """
    path = Path(path)
    text = ""
    try:
        text = read_text(path, "SCENE_BYTES")
        # A text of another system has other ends of lines, which open() would have replaced.
        text = text.replace("\r\n", "\n").replace("\r", "\n")
        tables = _parsed(text, path.name)
    except FileNotFoundError:
        raise DescriptionError("file", str(path), "exist") from None
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        comma = re.search(r"= *-?\d+,\d+ *(?=[,}#]|$)", _line_of(text, str(error)))
        cure = "; a decimal comma? write a point" if comma else ""
        raise FileError(path.name, [FileProblem(f"not TOML: {str(error)[:200]}{cure}")]) from None
    except OSError as error:
        raise DescriptionError("file", str(path), "be readable", hint=str(error)) from None
    return resolved_references(tables, path)


def _parsed(text: str, name: str) -> dict[str, Any]:
    """Tables of a TOML text within the limits of what is read."""
    check_keys(text, name)
    try:
        tables = tomllib.loads(text)
    except RecursionError:
        check_limit("DEPTH", text.count("[") + text.count("{"), name)
        raise
    except tomllib.TOMLDecodeError:
        raise
    except ValueError as error:  # a number of thousands of digits
        raise FileError(name, [FileProblem(f"not TOML: {str(error)[:200]}")]) from None
    check_plain(tables, name)
    check_texts(tables, name)
    return tables


def _line_of(text: str, problem: str) -> str:
    """Line of a text that a parser's message names; empty if it names none."""
    at = re.search(r"at line (\d+)", problem)
    return text.split("\n")[int(at[1]) - 1] if at else ""


def scene_kind(
    tables: Mapping[str, Any],
) -> type[SeparationScene] | type[SlidingScene] | type[ContactScene]:
    """Kind of scene of some tables, by the kind of their loading."""
    loading = tables.get("loading")
    kind = LOADINGS.get(str(loading.get("kind"))) if isinstance(loading, Mapping) else None
    if kind is None:
        return ContactScene if "window" in tables else SeparationScene
    if issubclass(kind, ContactLoading):
        return ContactScene
    return SlidingScene if issubclass(kind, Sliding) else SeparationScene


@overload
def load_scene(path: str | Path) -> SeparationScene | SlidingScene | ContactScene: ...


@overload
def load_scene(path: str | Path, kind: type[S]) -> S: ...


def load_scene(path: str | Path, kind: type[Scene] = Scene) -> Scene:
    """Read a scene from a TOML file.

    Parameters
    ----------
    path : str or Path
        The file; its tables are the fields of the scene that the kind of its ``loading`` belongs
        to. Quantities may carry a unit. The tables ``accuracy`` and ``study`` are checked and
        left out.
    kind : type, optional
        Kind of scene that is wanted, such as `ContactScene`; others are refused, and a type
        checker knows what is returned.

    Raises
    ------
    DescriptionError
        Listing every mistake in the file and where it is.
    """
    tables = read_tables(path)
    with telling_lines(Path(path)):
        scene: Scene = read_scene(tables, scene_kind(tables), Path(path).name).scene
    if not isinstance(scene, kind):
        raise DescriptionError(
            "file", str(path), f"hold a {kind.__name__}", hint=f"it is a {type(scene).__name__}"
        )
    return scene


def save_scene(scene: SeparationScene | SlidingScene | ContactScene, path: str | Path) -> Path:
    """Write a scene to a TOML file, in SI units; `load_scene` gives the same scene back.

    The path of a height map is written as found from the folder of the file, so that the file holds
    wherever it is read.

    Raises
    ------
    DescriptionError
        If the file could not hold the scene whole, such as an array or a surface of one's own, or
        may not name a height map from where it is; nothing is written then.
    """
    import tomli_w

    tables = _whole_tables(scene, Path(path).name)
    text = tomli_w.dumps(references_from(tables, Path(path)))
    return write_text(path, text)


def scene_text(scene: SeparationScene | SlidingScene | ContactScene, name: str) -> str:
    """Return a scene as the text of a TOML file, with absolute paths of height maps.

    Parameters
    ----------
    scene : SeparationScene, SlidingScene or ContactScene
        The scene.
    name : str
        What messages call the text.

    Raises
    ------
    DescriptionError
        If a file could not hold the scene whole.
    """
    import tomli_w

    return tomli_w.dumps(_whole_tables(scene, name))


def _whole_tables(scene: Any, name: str) -> dict[str, Any]:
    """Tables of a scene, refused unless they give the same scene again."""
    kinds = (ContactScene, SeparationScene, SlidingScene)
    kind = next((one for one in kinds if isinstance(scene, one)), None)
    if kind is None:
        expected = f"be a {', '.join(one.__name__ for one in kinds[:-1])} or {kinds[-1].__name__}"
        raise DescriptionError("save_scene(scene)", scene, expected)
    tables: dict[str, Any] = unstructure(scene)
    check_texts(tables, name)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # they have been issued when the scene was made
        again = structure(tables, kind, name)
    if lost := _first_difference(scene, again, kind.__name__):
        place, given, found = lost
        raise DescriptionError(
            place,
            given,
            "be what a file can hold whole",
            hint=f"read again it would be {found!r:.200}; keep the scene in Python",
        )
    return tables


def _first_difference(given: Any, found: Any, place: str) -> tuple[str, Any, Any] | None:
    """Path and values of the first part in which two scenes differ; None if none does."""
    if attrs.has(type(given)) and type(given) is type(found):
        pairs = [
            (getattr(given, a.name), getattr(found, a.name), f"{place}.{a.name}")
            for a in attrs.fields(type(given))
        ]
    elif isinstance(given, tuple) and isinstance(found, tuple) and len(given) == len(found):
        pairs = [
            (one, other, f"{place}[{i}]")
            for i, (one, other) in enumerate(zip(given, found, strict=True))
        ]
    else:
        return None if given == found else (place, given, found)
    return next(filter(None, (_first_difference(*pair) for pair in pairs)), None)


def write_text(path: str | Path, text: str) -> Path:
    """Write a text in UTF-8, whole or not at all; the path is returned.

    Raises
    ------
    OSError
        As `write_whole`.
    """
    with write_whole(path) as temporary:
        temporary.write_text(text, encoding="utf-8")
    return Path(path)


@contextmanager
def write_whole(path: str | Path) -> Iterator[Path]:
    """Yield a temporary path beside `path`, moved there at the end: no incomplete files.

    Raises
    ------
    OSError
        Of `path` by its name, if it cannot be written.
    """
    path = Path(path)
    path.parent.mkdir(parents=True, exist_ok=True)
    # Not tempfile, whose files are readable by their owner only.
    temporary = path.with_name(f".{path.stem}-{uuid.uuid4().hex[:8]}{path.suffix}")
    try:
        yield temporary
        os.replace(temporary, path)
    except OSError as error:
        if error.errno is None or error.filename not in (None, str(temporary)):
            raise
        # Of a full disk there is no name at all.
        raise OSError(error.errno, error.strerror, str(path)) from error
    finally:
        with suppress(OSError):
            temporary.unlink(missing_ok=True)
