"""Values that the command line sets over those of a scene: ``--set path=value``."""

from __future__ import annotations

import tomllib
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from typing import Any, TypeVar

from attrs import evolve

from ..errors import DescriptionError
from ..files.structure import FileError
from ..reading.texts import check_keys, check_plain
from ..studies.paths import changed, check_apart, paths_of, read_value, takes_text

__all__ = ["assignments", "known_paths", "with_settings"]

S = TypeVar("S")
_OPTION = "--set"


def assignments(given: Iterable[str]) -> dict[str, Any]:
    """Values by path of texts ``path=value``; each value is read as in a scene file.

    Quotes may be left out: what is no number, list, table, true or false is a text.

    Raises
    ------
    DescriptionError
        If a text is none of that form, or a path is given twice or lies inside another.

    Examples
    --------
    >>> assignments(["loading.force=60 N", "accuracy.rtol = 1e-9", "name=60"])
    {'loading.force': '60 N', 'accuracy.rtol': 1e-09, 'name': 60}
    """
    pairs = [text.partition("=") for text in given]
    for path, equals, value in pairs:
        if not (path.strip() and equals and value.strip()):
            hint = f"for example {_OPTION} loading.force='60 N'"
            raise DescriptionError(_OPTION, path + equals + value, "be path=value", hint=hint)
    check_apart([path.strip() for path, _, _ in pairs], _OPTION)
    return {path.strip(): _plain_value(value.strip()) for path, _, value in pairs}


def _plain_value(text: str) -> Any:
    """A value of TOML; the text itself if it is none."""
    check_keys(text, _OPTION)
    try:
        found = tomllib.loads(f"value = {text}")
    except tomllib.TOMLDecodeError:
        return text
    except RecursionError:
        expected = "hold tables and lists of fewer levels"
        raise DescriptionError(_OPTION, f"{text[:40]} ...", expected) from None
    check_plain(found, _OPTION)
    value = found.pop("value")
    is_plain = isinstance(value, bool | int | float | str | list | dict) and not found
    return value if is_plain else text


def with_settings(opened: S, given: Sequence[str]) -> S:
    """Return an opened scene with values set by paths, those that a study varies.

    Parameters
    ----------
    opened : OpenedScene
        The scene, with its accuracy if it has one.
    given : sequence of str
        Texts ``path=value``, such as ``effects.tension-limit.strength=5 bar``.

    Raises
    ------
    DescriptionError
        If a path does not exist or a value is not possible; the message names the option.
    """
    if not given:
        return opened
    described: Any = opened
    scene, accuracy = described.scene, getattr(described, "accuracy", None)
    values = {}
    raw = {path.strip(): text.strip() for path, _, text in (one.partition("=") for one in given)}
    for path, value in assignments(given).items():
        with _naming_option([path]):
            if isinstance(value, int | float) and takes_text(scene, accuracy, path, _OPTION):
                value = raw[path]  # a name of digits, which needs no quotes here
            values[path] = read_value(scene, accuracy, path, value, _OPTION)
    with _naming_option(values):
        made = changed(scene, accuracy, values)
    parts = {"scene": made.scene} | ({} if accuracy is None else {"accuracy": made.accuracy})
    found: S = evolve(described, **parts)
    return found


def known_paths(opened: object) -> list[str]:
    """Paths that can be set in an opened scene, sorted."""
    described: Any = opened
    accuracy = getattr(described, "accuracy", None)
    settings = [] if accuracy is None else [f"accuracy.{one}" for one in paths_of(accuracy)]
    return sorted([*paths_of(described.scene), *settings])


@contextmanager
def _naming_option(paths: Iterable[str] | Mapping[str, Any]) -> Iterator[None]:
    """Name the option, and the path that is meant if that is known, in an error."""
    try:
        yield
    except FileError as error:
        raise FileError(f"{_OPTION} {', '.join(paths)}", error.problems) from None
    except DescriptionError as error:
        if error.field == _OPTION:
            raise
        key = error.field.rpartition(".")[2]
        meant = [path for path in paths if path.rpartition(".")[2] == key] or list(paths)
        raise DescriptionError(
            f"{_OPTION} {', '.join(meant)}: {error.field}",
            error.value,
            error.expected,
            unit=error.unit,
            hint=error.hint,
        ) from None
