"""The sources of the kernel of a native FMU: its files, and those made of the description.

``description.h`` and ``description.c`` are made here and checked in nowhere, so that they cannot be
out of date: numbers and names of models, variables and enumerations (`models`), and the structs of
the records with the functions that read them (`data`, `records`).
``python -m contactkit.fmu.native.sources FOLDER`` writes all of them, to be read or compiled.
"""

from __future__ import annotations

import hashlib
import sys
from collections.abc import Iterable, Iterator
from enum import IntEnum
from functools import cache
from pathlib import Path

from ...errors import DescriptionError
from ..framework.toolchain import fmi_headers
from .data import CAUSALITIES, TYPES, Contents
from .models import DISCRETE, INDICATORS, MODELS, VARIABLES, enumerations
from .record import MOST_NODES, Column, Record, Several, Whole, c_name

__all__ = ["description_sources", "kernel_sources", "layout"]

_FACES = {"never": 0, "always": 1, "maybe": -1}


def kernel_sources(fmi: int = 2) -> dict[str, bytes]:
    """Sources of the kernel for a version of FMI by file name, without the headers of FMI."""
    folder = Path(__file__).with_name("kernel")
    other = f"fmi{5 - fmi}"
    files = (path for path in folder.rglob("*") if path.suffix in (".c", ".h"))
    found = {path.name: path.read_bytes() for path in files if not path.name.startswith(other)}
    return dict(sorted((found | description_sources()).items()))


@cache
def description_sources() -> dict[str, bytes]:
    """``description.h`` and ``description.c``."""
    return {"description.h": _header().encode(), "description.c": _readers().encode()}


@cache
def layout() -> str:
    """Eight letters that stand for the order and the ranges of the numbers of a file.

    They are the first of it: the kernel refuses a file that was written for another description.
    """
    text = "".join((*_declarations(), _readers()))
    return "CK" + hashlib.sha256(text.encode()).hexdigest()[:6]


def _header() -> str:
    parts = [
        "/* Models, variables and records; made by fmu/native/sources.py. */\n",
        "#ifndef CK_DESCRIPTION_H\n#define CK_DESCRIPTION_H\n",
        f'#define CK_LAYOUT "{layout()}" /* first letters of a file that is in this order */\n',
        *_declarations(),
        "#endif\n",
    ]
    return "\n".join(parts)


@cache
def _declarations() -> tuple[str, ...]:
    """Enumerations and structs."""
    kinds = [f"ck_{model.identifier}" for model in MODELS.values()]
    return (
        _enum("models", [*(model.identifier for model in MODELS.values()), "models"]),
        f"#define CK_KIND_NAMES {', '.join(kinds)} /* what each is made of */\n"
        f"#define CK_KINDS {', '.join(f'&{kind}' for kind in kinds)}\n",
        _enum("types of variables, as bits", TYPES),
        _enum("causalities of variables", CAUSALITIES),
        _enum("variables", _distinct([*VARIABLES, "variables"])),
        f"enum {{ CK_DISCRETE = {len(DISCRETE)} }}; /* outputs that change at events only */\n",
        _enum("event indicators of model exchange", [*INDICATORS, "indicators"]),
        *(_members(one) for one in (*enumerations(), *_own_enumerations())),
        _enum("most of several members", {f"most_{name}": n for name, n in _mosts().items()}),
        "typedef struct ck_reader ck_reader;\n",
        *map(_struct, _records()),
        "extern const char *const ck_names[CK_VARIABLES];\n"
        "extern const int ck_discrete[CK_DISCRETE];\n"
        "/* Whether a model has a film, and faces; -1: it may; whether its bodies deform. */\n"
        "extern const int ck_has_film[CK_MODELS], ck_has_faces[CK_MODELS];\n"
        "extern const int ck_deforms[CK_MODELS];\n\n"
        "/* Read the numbers of a file; whether all is in range says the reader. */\n"
        "void ck_read_contents(ck_reader *r, ck_contents *to);\n",
        "".join(_hooks()),
    )


def _readers() -> str:
    names = _wrapped(f'"{name}"' for name in VARIABLES)
    discrete = _wrapped(f"CK_{name.upper()}" for name in DISCRETE)
    films = ", ".join(str(int(model.has_film)) for model in MODELS.values())
    faces = ", ".join(str(_FACES[model.faces]) for model in MODELS.values())
    deform = ", ".join(str(int(model.deforms)) for model in MODELS.values())
    parts = [
        "/* Names of variables, and reading of records; made by fmu/native/sources.py. */\n",
        '#include "reader.h"\n\n#include <math.h>\n',
        f"const char *const ck_names[CK_VARIABLES] = {{\n{names}}};\n",
        f"const int ck_discrete[CK_DISCRETE] = {{\n{discrete}}};\n",
        f"const int ck_has_film[CK_MODELS] = {{{films}}};\n"
        f"const int ck_has_faces[CK_MODELS] = {{{faces}}};\n"
        f"const int ck_deforms[CK_MODELS] = {{{deform}}};\n",
        *map(_reader, _records()),
    ]
    return "\n".join(parts)


def _distinct(names: list[str]) -> list[str]:
    """Names whose capitals differ, as enumerators of C.

    Raises
    ------
    DescriptionError
        If two do not.
    """
    capitals = [name.upper() for name in names]
    twice = sorted(name for name in names if capitals.count(name.upper()) > 1)
    if twice:
        raise DescriptionError("names of variables", twice, "differ in more than capitals")
    return names


def _enum(what: str, values: Iterable[str] | dict[str, int]) -> str:
    numbered = values if isinstance(values, dict) else {n: i for i, n in enumerate(values)}
    entries = _wrapped(f"CK_{name.upper()} = {value}" for name, value in numbered.items())
    return f"/* {what[0].upper()}{what[1:]}. */\nenum {{\n{entries}}};\n"


def _members(enumeration: type[IntEnum]) -> str:
    prefix = c_name(enumeration)[3:]
    about = (enumeration.__doc__ or "").partition("\n")[0].rstrip(".")
    return _enum(about, {f"{prefix}_{one.name}": int(one) for one in enumeration})


def _wrapped(words: Iterable[str]) -> str:
    """Words with commas between them, in lines."""
    lines, line = list[str](), "   "
    for word in words:
        if len(line) + len(word) > 100:
            lines, line = [*lines, line], "   "
        line += f" {word},"
    return "\n".join([*lines, line.rstrip(",")]) + "\n"


@cache
def _records() -> tuple[type[Record], ...]:
    """Records of a file, each after those it is made of."""

    def below(record: type[Record]) -> Iterator[type[Record]]:
        for one in record.parts():
            yield from below(one)
        yield record

    return tuple(dict.fromkeys(below(Contents)))


def _own_enumerations() -> tuple[type[IntEnum], ...]:
    """Enumerations that members of the records are of, each once."""
    kinds = [one.kind for record in _records() for one in record.members()]
    types = [kind.type for kind in kinds if isinstance(kind, Whole)]
    return tuple(dict.fromkeys(one for one in types if issubclass(one, IntEnum)))


def _mosts() -> dict[str, int]:
    """Most of several members, by their name.

    Raises
    ------
    DescriptionError
        If two records have members of one name, but not as many of them.
    """
    found = {"nodes": MOST_NODES}
    for record in _records():
        for name, kind, _ in record.members():
            if isinstance(kind, Several) and found.setdefault(name, kind.most) != kind.most:
                raise DescriptionError(f"{record.__name__}.{name}", kind.most, "be as many")
    return found


def _struct(record: type[Record]) -> str:
    columns, lines = record.columns(), list[str]()
    for one in record.members():
        if columns and one == columns[0]:
            lines.append("int n_nodes;")
        lines.append(f"{one.kind.declaration(one.name)} /* {one.note} */")
    about = (record.__doc__ or "").partition("\n")[0]
    body = "".join(f"    {line}\n" for line in (*lines, *record.derived))
    return f"/* {about} */\ntypedef struct {{\n{body}}} {c_name(record)};\n"


def _hooks() -> Iterator[str]:
    yield "/* Of the kernel: look at what was read, and fill in what follows from it. */\n"
    for record in _records():
        if record.derived or record.checked:
            name = c_name(record)
            yield f"void ck_made_{name[3:]}(ck_reader *r, {name} *made);\n"


def _reader(record: type[Record]) -> str:
    name = c_name(record)
    members = record.members()
    lines = ["int i;"] if any(isinstance(one.kind, Several) for one in members) else []
    for one in members:
        if isinstance(one.kind, Column) and one == record.columns()[0]:
            lines.append("to->n_nodes = ck_read_nodes(r);")
        lines.append(one.kind.reading(one.name))
    if record.derived or record.checked:
        lines.append(f"if (r->fine) ck_made_{name[3:]}(r, to);")
    head = "void ck_read_contents" if record is Contents else f"static void read_{name[3:]}"
    body = "".join(f"    {line}\n" for line in lines)
    return f"{head}(ck_reader *r, {name} *to) {{\n{body}}}\n"


def write_sources(folder: Path, fmi: int = 2) -> None:
    """Write all sources of a native FMU to a folder."""
    folder.mkdir(parents=True, exist_ok=True)
    for name, content in (kernel_sources(fmi) | fmi_headers(fmi)).items():
        (folder / name).write_bytes(content)


if __name__ == "__main__":
    write_sources(Path(sys.argv[1]))
