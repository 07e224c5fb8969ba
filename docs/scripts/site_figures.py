"""Hook of mkdocs: indices with pictures, figures that open large and fit a phone.

A table of an index whose rows link to pages with figures becomes cards with thumbnails. Figures get
their size, open large (docs/assets/figures.js), and a phone shows their panels one a row.
"""

from __future__ import annotations

import posixpath
import re
from html import escape, unescape
from pathlib import Path
from typing import Any
from urllib.parse import unquote

from mkdocs.config.defaults import MkDocsConfig
from mkdocs.structure.files import File, Files
from mkdocs.structure.pages import Page
from PIL import Image
from site_panels import Box, opaque, panels

ROOT = Path(__file__).parents[2]
DOCS, KEPT = ROOT / "docs", ROOT / "build" / "thumbnails"
SIZE = (640, 400)  # pixels of a thumbnail, at most; shown half as large
FIGURE = re.compile(r"!\[[^\]]*\]\(([^)\s]+\.png)\)")
TABLE = re.compile(r"(?:^\|.*\|\n)+", re.MULTILINE)
ROW = re.compile(r"\| *\[([^\]]+)\]\(([\w/-]+\.md)\) *\|([^|\n]*)\|.*")
TEXT = re.compile(r">[^<]+<")
NUMBER = re.compile(r"(?:\b[ar]tol )?\b\d[\d.]*e-\d+\b")
IMAGE = re.compile(r'<img alt="([^"]*)" src="([^"]+\.png)" ?/?>')


def figure_of(page: Path) -> Path | None:
    """First figure of a page."""
    found = FIGURE.search(page.read_text("utf-8")) if page.exists() else None
    picture = page.parent / found[1] if found else None
    return picture if picture and picture.exists() else None


def thumbnail(picture: Path, kept: Path) -> None:
    """Write the first panel of a figure, small."""
    kept.parent.mkdir(parents=True, exist_ok=True)
    if kept.exists() and kept.stat().st_mtime >= picture.stat().st_mtime:
        return
    _, found = panels(picture)
    shown = opaque(picture)
    tall = [box for box in found if box.height > 0.4 * box.width]  # no strip with a legend
    if tall:
        shown = shown.crop((tall[0].left, tall[0].top, tall[0].right, tall[0].bottom))
    shown.thumbnail(SIZE, Image.Resampling.LANCZOS)
    shown.quantize(64).save(kept, optimize=True)


def rows_of(table: str) -> list[tuple[str, str, str]]:
    """Title, page and sentence of each row of a table that lists pages."""
    rows = table.strip().splitlines()[2:]
    found = [match for row in rows if (match := ROW.fullmatch(row.strip()))]
    return [(m[1], m[2], m[3].strip()) for m in found] if len(found) == len(rows) else []


def on_files(files: Files, config: MkDocsConfig) -> Files:
    """Add a thumbnail of each page that an index lists and that has a figure."""
    for index in DOCS.rglob("index.md"):
        for table in TABLE.findall(index.read_text("utf-8")):
            for _, page, _ in rows_of(table):
                picture = figure_of(index.parent / page)
                place = place_of(index.parent / page)
                if picture is None or place in files.src_uris:
                    continue
                thumbnail(picture, ROOT / "build" / place)
                files.append(
                    File.generated(config, place, abs_src_path=str(ROOT / "build" / place))
                )
    return files


def place_of(page: Path) -> str:
    """Address of the thumbnail of a page in the site."""
    return f"thumbnails/{page.relative_to(DOCS).with_suffix('.png').as_posix()}"


def cards(table: str, folder: Path) -> str:
    """A table of pages as cards; itself if fewer than half of the pages have a figure."""
    rows = rows_of(table)
    pages = [(folder / page).resolve() for _, page, _ in rows]
    if not rows or 2 * sum(figure_of(page) is not None for page in pages) < len(pages):
        return table
    lines = ['<div class="cards" markdown>', ""]
    for (title, link, sentence), page in zip(rows, pages, strict=True):
        picture = ""
        if figure_of(page) is not None:
            picture = f"![]({posixpath.relpath(place_of(page), folder.relative_to(DOCS))}) "
        lines.append(f"- [{picture}**{title}**]({link}) {sentence}")
    return "\n".join([*lines, "", "</div>", ""])


def on_page_markdown(markdown: str, page: Page, **_: Any) -> str:
    """Cards in place of the tables of an index."""
    path = DOCS / page.file.src_uri
    if path.name != "index.md":
        return markdown
    return TABLE.sub(lambda match: cards(match[0], path.parent), markdown)


def cropped(box: Box, size: tuple[int, int], image: str) -> str:
    """A panel: the whole picture, moved and cut off by the box around it."""
    width = 100 * size[0] / box.width
    left, top = 100 * box.left / box.width, 100 * box.top / box.height
    return (
        f'<span class="panel" style="aspect-ratio: {box.width} / {box.height}">'
        f'<img {image} style="width: {width:.3f}%; left: {-left:.3f}%; '
        f'top: {-top:.3f}%"></span>'
    )


def on_page_content(html: str, page: Page, **_: Any) -> str:
    """Figures with their size; those of several panels also one panel a row, for phones."""
    folder = posixpath.dirname(page.file.dest_uri)

    def figure(match: re.Match[str]) -> str:
        alt, source = match[1], match[2]
        place = posixpath.normpath(posixpath.join(folder, unquote(unescape(source))))
        if place.startswith("thumbnails/"):
            return f'<img alt="" src="{source}" loading="lazy">'
        path = DOCS / place
        if not path.exists():
            return match[0]
        size, found = panels(path)
        image = f'src="{source}" width="{size[0]}" height="{size[1]}" loading="lazy"'
        whole = f'<img class="whole" alt="{alt}" {image}>'
        cut = "".join(cropped(box, size, f'alt="" {image}') for box in found)
        label = escape(f"Enlarge: {unescape(alt)}" if alt else "Enlarge", quote=True)
        return (
            f'<a class="figure{" cut" * bool(cut)}" href="{source}" aria-label="{label}">'
            f"{whole}{cut}</a>"
        )

    html = IMAGE.sub(figure, html)
    # A browser breaks a line after the hyphen of 1e-04.
    return TEXT.sub(
        lambda text: NUMBER.sub(r'<span class="whole-number">\g<0></span>', text[0]), html
    )
