"""Pages of HTML that hold all they show: no script, nothing fetched from a network."""

from __future__ import annotations

import base64
from collections.abc import Sequence
from html import escape

__all__ = ["bullets", "figure", "listing", "page", "section"]

# One column of text on a telephone; on paper no section begins at the foot of a page.
_STYLE = """
body { font: 16px/1.5 system-ui, sans-serif; max-width: 60rem; margin: 0 auto; padding: 1rem;
  color: #222; background: #fff; }
h1 { font-size: 1.5rem; line-height: 1.2; } h2 { font-size: 1.15rem; margin: 2rem 0 0.5rem; }
h1, p, li, td, figcaption { overflow-wrap: break-word; }
section > div { overflow-x: auto; } p { margin: 0.5rem 0; }
table { border-collapse: collapse; font-size: 0.9rem; font-variant-numeric: tabular-nums; }
td { border-bottom: 1px solid #ddd; padding: 0.2rem 0.8rem 0.2rem 0; vertical-align: top;
  min-width: 4rem; }
figure { margin: 1rem 0; } img { max-width: 100%; height: auto; }
figcaption, footer { color: #555; font-size: 0.85rem; }
pre { font: 0.75rem/1.35 ui-monospace, monospace; overflow-x: auto; }
footer { margin-top: 2rem; border-top: 1px solid #ddd; }
@media print { body { max-width: none; padding: 0; font-size: 10pt; }
  h2 { break-after: avoid; } figure, tr { break-inside: avoid; }
  pre { white-space: pre-wrap; font-size: 7pt; } section > div { overflow-x: visible; } }
""".strip()
# What a browser refuses even if it were in the page.
_POLICY = "default-src 'none'; img-src data:; style-src 'unsafe-inline'"


def page(title: str, sections: Sequence[str], *, generator: str, foot: str = "") -> str:
    """Return a whole page: a title, sections as `section` makes them, and a line at the foot.

    `generator` names the program that wrote it.
    """
    head = (
        '<meta charset="utf-8">',
        '<meta name="viewport" content="width=device-width, initial-scale=1">',
        f'<meta name="generator" content="{escape(generator)}">',
        f'<meta http-equiv="Content-Security-Policy" content="{_POLICY}">',
        f"<title>{escape(title)}</title>",
        f"<style>\n{_STYLE}\n</style>",
    )
    body = (f"<h1>{escape(title)}</h1>", *sections, f"<footer>{escape(foot)}</footer>")
    return "\n".join(
        [
            "<!doctype html>",
            '<html lang="en">',
            "<head>",
            *head,
            "</head>",
            "<body>",
            *body,
            "</body>",
            "</html>",
            "",
        ]
    )


def section(heading: str, *parts: str) -> str:
    """Return a section: a heading, and parts that are HTML already; empty without any."""
    shown = "\n".join(part for part in parts if part)
    return f"<section><h2>{escape(heading)}</h2><div>\n{shown}\n</div></section>" if shown else ""


def figure(png: bytes, caption: str) -> str:
    """Return a PNG picture within the page.

    Examples
    --------
    >>> figure(b"abc", "a < b")[:61]
    '<figure><img alt="a &lt; b" src="data:image/png;base64,YWJj">'
    """
    data, text = base64.b64encode(png).decode("ascii"), escape(caption)
    return (
        f'<figure><img alt="{text}" src="data:image/png;base64,{data}">'
        f"<figcaption>{text}</figcaption></figure>"
    )


def bullets(lines: Sequence[str]) -> str:
    """Return texts as a list; empty without any.

    Examples
    --------
    >>> bullets(["Stefan 1874"]), bullets([])
    ('<ul><li>Stefan 1874</li></ul>', '')
    """
    items = "".join(f"<li>{escape(line)}</li>" for line in lines)
    return f"<ul>{items}</ul>" if items else ""


def listing(text: str) -> str:
    """Return a text as it is printed, with its columns.

    Examples
    --------
    >>> listing("a < b")
    '<pre>a &lt; b</pre>'
    """
    return f"<pre>{escape(text)}</pre>"
