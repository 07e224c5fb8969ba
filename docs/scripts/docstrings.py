"""Griffe extension: equations of docstrings for KaTeX, and signatures of the classes of attrs."""

from __future__ import annotations

import importlib
import inspect
import re
from typing import Any

import attrs
from griffe import (
    Class,
    Docstring,
    Extension,
    Function,
    Object,
    Parameter,
    ParameterKind,
    Parameters,
)

_BLOCK = re.compile(r"^( *)\.\. math::[ ]*(.*(?:\n(?:\1[ ]+.*|[ ]*(?=\n\1[ ])))*)", re.MULTILINE)
_TABLE = re.compile(r"^( *)(=+(?: +=+)+)\n((?:.*\n)+?)\1\2\n((?:.*\n)+?)\1\2$", re.MULTILINE)
KINDS = {
    inspect.Parameter.POSITIONAL_ONLY: ParameterKind.positional_only,
    inspect.Parameter.POSITIONAL_OR_KEYWORD: ParameterKind.positional_or_keyword,
    inspect.Parameter.KEYWORD_ONLY: ParameterKind.keyword_only,
}


def _block(match: re.Match[str]) -> str:
    """Paragraphs of a directive are equations of their own, as in Sphinx."""
    indent = match[1]
    equations = [" ".join(part.split()) for part in re.split(r"\n[ ]*\n", match[2])]
    equations = [  # aligned as Sphinx aligns them
        rf"\begin{{aligned}} {tex} \end{{aligned}}"
        if re.search(r"\\\\|&", tex) and "\\begin{" not in tex
        else tex
        for tex in equations
    ]
    return "\n\n".join(f"{indent}$$\n{indent}{tex}\n{indent}$$" for tex in equations if tex)


def _table(match: re.Match[str]) -> str:
    """A simple table of reStructuredText as one of Markdown."""
    indent, rule = match[1], match[2]
    starts = [column.start() for column in re.finditer(r"=+", rule)]
    rows: list[list[str]] = []
    for line in [*match[3].splitlines(), *match[4].splitlines()]:
        text = line[len(indent) :]
        cells = [text[a:b].strip() for a, b in zip(starts, [*starts[1:], None], strict=True)]
        if cells[0] or not rows:
            rows.append(cells)
        else:  # a line that continues the row above
            rows[-1] = [" ".join(both).strip() for both in zip(rows[-1], cells, strict=True)]
    rows.insert(1, ["---"] * len(starts))
    return "\n".join(f"{indent}| {' | '.join(row)} |" for row in rows)


def in_markdown(text: str) -> str:
    """Docstring with its mathematics, and double backticks, in Markdown's words."""
    text = _TABLE.sub(_table, _BLOCK.sub(_block, text))
    text = re.sub(r"^( *)\.\. \[(\d+)\] ", r"\1\2. ", text, flags=re.MULTILINE)
    text = re.sub(r":math:`([^`]+)`", lambda m: f"${' '.join(m[1].split())}$", text)
    return re.sub(r"(?<!`)``(?!`)", "`", text)


def _default(value: Any) -> str:
    """A default as one would write it."""
    if isinstance(value, attrs.Factory):  # type: ignore[arg-type]
        return f"{value.factory.__name__}()"
    return repr(value)


def _annotation(kind: type, name: str) -> str | None:
    """Type of a field as it is written in the class that has it."""
    for one in kind.__mro__:
        if name in vars(one).get("__annotations__", {}):
            written = vars(one)["__annotations__"][name]
            return written if isinstance(written, str) else getattr(written, "__name__", None)
    return None


def constructor(kind: type) -> Parameters:
    """Parameters of the ``__init__`` that attrs writes, with their defaults."""
    defaults = {field.alias: field.default for field in attrs.fields(kind) if field.init}
    fields = {field.alias: field.name for field in attrs.fields(kind)}
    parameters = [Parameter("self", kind=ParameterKind.positional_or_keyword)]
    for one in inspect.signature(kind).parameters.values():
        value = defaults[one.name]
        parameters.append(
            Parameter(
                one.name,
                annotation=_annotation(kind, fields[one.name]),
                kind=KINDS[one.kind],
                default=None if value is attrs.NOTHING else _default(value),
            )
        )
    return Parameters(*parameters)


class Docstrings(Extension):
    """Equations of docstrings, and the signatures that attrs writes, for griffe."""

    def on_object(self, *, obj: Object, **_: Any) -> None:
        """Rewrite the docstring of an object, if it has one."""
        if isinstance(obj.docstring, Docstring):
            obj.docstring.value = in_markdown(obj.docstring.value)

    def on_class(self, *, cls: Class, **_: Any) -> None:
        """Give a class of attrs the signature that it has."""
        if not any("frozen" in str(d.value) or "define" in str(d.value) for d in cls.decorators):
            return
        try:
            kind = getattr(importlib.import_module(cls.module.path), cls.name)
        except ModuleNotFoundError:  # of an extra
            return
        init = Function("__init__", parameters=constructor(kind), parent=cls)
        init.labels.add("generated")
        cls.set_member("__init__", init)
