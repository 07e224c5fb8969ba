"""Texts of limited size, and plain values of limited depth from TOML and JSON."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from contextlib import suppress
from pathlib import Path
from typing import Any

from ..errors import DescriptionError
from .limits import check_limit, limit_of

__all__ = [
    "DECIMAL_COMMA",
    "check_keys",
    "check_plain",
    "check_texts",
    "decoded",
    "from_json",
    "is_number",
    "printable",
    "read_bytes",
    "read_text",
]

# What is no key of TOML: strings, which end with their line unless they have three quotes, and
# comments. Possessive, so that the time rises with the length of a text and not with its square.
_NO_KEYS = re.compile(
    r'"""(?:[^\\"]|\\.|"(?!""))*+(?:"{3,5}|\Z)'
    r"|'''(?:[^']|'(?!''))*+(?:'{3,5}|\Z)"
    r'|"(?:[^"\\\n]|\\[^\n])*+["\n]?'
    r"|'[^'\n]*+['\n]?"
    r"|#[^\n]*+",
    re.DOTALL,
)
_BETWEEN_KEYS = re.compile(r"[=\[\]{},\n]")
DECIMAL_COMMA = re.compile(r"[-+]?\d+,\d+(?:[eE][-+]?\d+)?")
"""A number with a decimal comma, whole."""
_INT64 = 2**63


def read_text(path: Path, limit: str, encoding: str = "utf-8") -> str:
    """Text of a file of limited size.

    Raises
    ------
    DescriptionError
        If it is no file, or larger than the limit of this name.
    UnicodeDecodeError, OSError
        If it cannot be read.
    """
    return read_bytes(path, limit).decode(encoding)


def read_bytes(path: Path, limit: str) -> bytes:
    """Content of a file of limited size.

    Raises
    ------
    DescriptionError
        If it is no file, or larger than the limit of this name.
    OSError
        If it cannot be read.
    """
    if path.exists() and not path.is_file():
        raise DescriptionError("file", str(path), "be readable", hint="it is a folder or a device")
    with path.open("rb") as file:
        content = file.read(limit_of(limit) + 1)  # whatever size it states
    if len(content) > limit_of(limit):
        check_limit(limit, max(path.stat().st_size, len(content)), str(path))
    return content


def decoded(content: bytes, where: str) -> str:
    r"""Text of a table as spreadsheets and instruments write it.

    UTF-8, or UTF-16 where its mark stands at the beginning; else that of Windows in western Europe,
    whose digits are the same and which has letters such as the sign of micro.

    Raises
    ------
    DescriptionError
        If it is no text.

    Examples
    --------
    >>> decoded(b"gap [\xb5m]", "pull.csv"), decoded("gap".encode("utf-16"), "pull.csv")
    ('gap [µm]', 'gap')
    """
    is_marked = content.startswith((b"\xff\xfe", b"\xfe\xff"))
    for encoding in ["utf-16"] if is_marked else ["utf-8-sig", "cp1252"]:
        with suppress(UnicodeDecodeError):
            text = content.decode(encoding)
            if "\0" not in text:
                return text
    raise DescriptionError("file", where, "be a text", hint="export it as CSV, in UTF-8")


def is_number(text: str) -> bool:
    """Whether a cell of a table is a number, nan and infinity included.

    Examples
    --------
    >>> is_number(" 1e-3 "), is_number("1,5")
    (True, False)
    """
    try:
        float(text)
    except ValueError:
        return False
    return True


def check_keys(text: str, where: str) -> None:
    """Refuse a dotted key of TOML of too many parts, which a parser reads in quadratic time.

    Raises
    ------
    DescriptionError
        If a key has more parts than tables may have levels.

    Examples
    --------
    >>> check_keys("a.b.c = 1.5  # ...", "scene.toml")
    """
    plain = _NO_KEYS.sub(" ", text)
    depth = max(word.count(".") for word in _BETWEEN_KEYS.split(plain)) + 1
    check_limit("DEPTH", depth, where)


def check_plain(value: Any, where: str) -> None:
    """Refuse plain values that are nested too deeply, or integers of more than 64 bits.

    Raises
    ------
    DescriptionError
        Naming the file and what was found.

    Examples
    --------
    >>> check_plain({"a": [1, 2.0, "text"]}, "scene.toml")
    """
    level, depth = [value], 0
    while level:
        check_limit("DEPTH", depth, where)
        for item in level:
            if isinstance(item, int) and not -_INT64 <= item < _INT64:
                found = f"one has {item.bit_length()}"
                raise DescriptionError(
                    "file", where, "hold integers of at most 64 bits", hint=found
                )
        level = [inner for item in level for inner in _inside(item)]
        depth += 1


def _inside(value: Any) -> Any:
    if isinstance(value, Mapping):
        return value.values()
    return value if isinstance(value, list) else ()


# What a terminal obeys, and what reverses the order of letters; a line may end, and have tabs.
_UNPRINTABLE = re.compile("[\x00-\x08\x0b-\x1f\x7f-\x9f\u202a-\u202e\u2066-\u2069]")
_CONTROL = re.compile("[\x00-\x08\x0b\x0c\x0e-\x1f\x7f-\x9f]")


def printable(text: str) -> str:
    r"""A text for a terminal: what would command it is shown as Python writes it.

    Examples
    --------
    >>> printable("oil \x1b[31m")
    'oil \\x1b[31m'
    """
    return _UNPRINTABLE.sub(lambda found: ascii(found[0])[1:-1], text)


def check_texts(value: Any, where: str) -> None:
    """Refuse texts and keys with control characters, which a terminal would obey.

    Raises
    ------
    DescriptionError
        With the text as Python writes it.
    """
    level = [value]
    while level:
        texts = [one for one in level if isinstance(one, str)]
        texts += [key for one in level if isinstance(one, Mapping) for key in one]
        for text in texts:
            if _CONTROL.search(text):
                expected = "hold texts without control characters"
                raise DescriptionError("file", where, expected, hint=f"there is {text!r:.80}")
        level = [inner for item in level for inner in _inside(item)]


def from_json(text: str | bytes, where: str) -> Any:
    """Plain values of a JSON text.

    Raises
    ------
    DescriptionError
        If the text is too long, is not JSON, or holds what `check_plain` refuses.

    Examples
    --------
    >>> from_json('{"a": [1, 2]}', "header")
    {'a': [1, 2]}
    """
    check_limit("TEXT_BYTES", len(text), where)
    try:
        found = json.loads(text)
    except RecursionError:
        check_limit("DEPTH", _depth(text), where)
        raise DescriptionError("file", where, "be nested less deeply") from None
    except ValueError as error:  # also of a number of too many digits, and of no UTF-8
        raise DescriptionError("file", where, "hold JSON", hint=str(error)[:200]) from None
    check_plain(found, where)
    return found


def _depth(text: str | bytes) -> int:
    """Greatest depth that the brackets of a text may reach."""
    plain = text.decode("utf-8", "replace") if isinstance(text, bytes) else text
    return plain.count("[") + plain.count("{")
