"""Assembly of a page: one HTML file of its parts, its scripts and what they read."""

from __future__ import annotations

import base64
import gzip
import json
import re
from collections.abc import Mapping, Sequence
from html import escape
from pathlib import Path
from typing import Any

from .._version import __version__

__all__ = ["assembled", "file_name", "packed", "readable"]

_TEMPLATE = Path(__file__).with_name("template")


def assembled(
    data: Mapping[str, Any],
    main: str,
    scripts: Sequence[str],
    remark: str,
    binaries: Mapping[str, bytes] | None = None,
) -> str:
    """Return the text of a page.

    Parameters
    ----------
    data : mapping
        What the scripts read, with a ``title``; plain values without nan.
    main : str
        Name of the template of its sections.
    scripts : sequence of str
        Names of its scripts, in their order; ``frame.js`` comes first.
    remark : str
        What the foot says after the program that made the page.
    binaries : mapping of str to bytes, optional
        What is too large for `data`, by the id of the element that holds it, `packed`.
    """
    made_by = f"contactkit {__version__}"
    held = [
        f'<script id="{name}" type="text/plain">{packed(content)}</script>\n'
        for name, content in (binaries or {}).items()
    ]
    run = [f"<script>\n{_text(name)}</script>\n" for name in ("frame.js", *scripts)]
    parts = {
        "title": escape(str(data["title"])),
        "generator": escape(made_by),
        "foot": escape(f"{made_by}; {remark}"),
        "page.css": _text("page.css"),
        "main": _text(main),
        # No text of a scene ends the script that holds it.
        "data": json.dumps(data, allow_nan=False, ensure_ascii=False).replace("<", "\\u003c"),
        "scripts": "".join([*held, *run]),
    }
    return re.sub(r"\{\{([\w.]+)\}\}", lambda match: parts[match[1]], _text("page.html"))


def _text(name: str) -> str:
    return (_TEMPLATE / name).read_text("utf-8")


def packed(content: bytes) -> str:
    """Bytes as text, compressed; the same every time."""
    return base64.b64encode(gzip.compress(content, 9, mtime=0)).decode("ascii")


def file_name(title: str, otherwise: str = "film") -> str:
    """Name of a file of a title, without its ending."""
    return re.sub(r"[^a-z0-9]+", "-", title.lower()).strip("-") or otherwise


def readable(unit: str) -> str:
    """A unit as it is printed: um is \u00b5m, m3 is m\u00b3."""
    text = (
        re.sub(r"\bu(?=[a-zA-Z])", "\u00b5", unit)
        .replace("ohm", "\u03a9")
        .replace("deg", "\u00b0")
        .replace(".", "\u00b7")
    )
    return "" if text == "-" else text.replace("2", "\u00b2").replace("3", "\u00b3")
