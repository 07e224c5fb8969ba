"""Griffe extension: equations of the docstrings as plain text, as the pages need no scripts."""

from __future__ import annotations

import re
from typing import Any

from griffe import Docstring, Extension, Object

_BLOCK = re.compile(r"^\.\. math::[ ]*(.*(?:\n(?:[ ]+.*|[ ]*(?=\n[ ])))*)", re.MULTILINE)


def _block(match: re.Match[str]) -> str:
    lines = [line.strip() for line in match[1].splitlines()]
    return "```text\n" + "\n".join(line for line in lines if line) + "\n```"


def plain(text: str) -> str:
    """Docstring with its mathematics, and double backticks, in Markdown's words."""
    text = _BLOCK.sub(_block, text)
    text = re.sub(r":math:(`[^`]+`)", r"\1", text)
    return re.sub(r"(?<!`)``(?!`)", "`", text)


class PlainMath(Extension):
    """Turns the mathematics of every docstring that griffe collects."""

    def on_object(self, *, obj: Object, **_: Any) -> None:
        """Rewrite the docstring of an object, if it has one."""
        if isinstance(obj.docstring, Docstring):
            obj.docstring.value = plain(obj.docstring.value)
