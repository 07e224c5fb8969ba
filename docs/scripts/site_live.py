"""Hook of mkdocs: a link to a scene file, alone in its paragraph, becomes its live page.

The scenes are those of docs/live/, and of models/. Each page is built once, by ``contactkit page``,
and kept in build/live_pages/ until the scene or the package changes. On GitHub the link leads to
the scene. With ``LIVE_PAGES=short`` in the environment pages with large tables have a line instead.
"""

from __future__ import annotations

import hashlib
import os
import re
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from functools import cache
from html import escape
from pathlib import Path
from typing import Any

from mkdocs.config.defaults import MkDocsConfig
from mkdocs.exceptions import PluginError
from mkdocs.plugins import get_plugin_logger
from mkdocs.structure.files import File, Files
from mkdocs.structure.pages import Page
from mkdocs.utils import get_relative_url

ROOT = Path(__file__).parents[2]
DOCS, KEPT = ROOT / "docs", ROOT / "build" / "live_pages"
LINK = re.compile(r"^\[([^\]\n]+)\]\(([\w./-]+\.toml)\)$", re.MULTILINE)
# Pages whose tables take 23 to 31 s of CPU each, as the rest of the site does; the others 4 to 7.
LONG = {"bridge", "humid-sphere", "micromirror"}
IS_SHORT = os.environ.get("LIVE_PAGES") == "short"
SOURCES = {".py", ".c", ".h", ".js", ".css", ".html", ".toml"}

log = get_plugin_logger(__name__)


@cache
def package() -> bytes:
    """Digest of all that a page is made by."""
    digest = hashlib.sha256()
    for room in ("contactkit", "fmu", "models"):
        for path in sorted((ROOT / room).rglob("*")):
            if path.suffix in SOURCES:
                digest.update(path.relative_to(ROOT).as_posix().encode() + path.read_bytes())
    return digest.digest()


def built(scene: Path) -> Path:
    """Return the page of a scene; build it unless it is kept."""
    if IS_SHORT and scene.stem in LONG:
        page = KEPT / "left_out.html"
        KEPT.mkdir(parents=True, exist_ok=True)
        page.write_text("<p>This page was left out.</p>\n", encoding="utf-8")
        return page
    digest = hashlib.sha256(package() + scene.read_bytes()).hexdigest()
    page = KEPT / f"{scene.stem}-{digest[:16]}.html"
    if not page.exists():
        KEPT.mkdir(parents=True, exist_ok=True)
        for old in KEPT.glob(f"{scene.stem}-????????????????.html"):
            old.unlink()
        command = [sys.executable, "-m", "contactkit", "page", str(scene), "--out", str(page)]
        # One thread: as many pages as there are cores are built at a time.
        alone = os.environ | {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
        done = subprocess.run(command, capture_output=True, text=True, check=False, env=alone)
        if done.returncode:
            said = done.stderr.strip().rpartition("\r")[2].strip()
            raise PluginError(f"no live page of {scene.name}: {said}")
    return page


def shown() -> list[Path]:
    """Scenes that the pages link to so."""
    found = {
        (page.parent / target).resolve()
        for page in DOCS.rglob("*.md")
        for _, target in LINK.findall(page.read_text("utf-8"))
    }
    return sorted(found)


def place_of(scene: Path, kind: str) -> str:
    """Address of a live page or of its scene in the site."""
    return f"live/{scene.stem.replace('_', '-')}.{kind}"


def on_files(files: Files, config: MkDocsConfig) -> Files:
    """Add the pages of all scenes, built side by side."""
    scenes = shown()
    with ThreadPoolExecutor(os.cpu_count()) as threads:
        for scene, page in zip(scenes, threads.map(built, scenes), strict=True):
            for path, kind in ((page, "html"), (scene, "toml")):
                place = place_of(scene, kind)
                if place not in files.src_uris:
                    files.append(File.generated(config, place, abs_src_path=str(path)))
    for scene in sorted(DOCS.glob("live/*.toml")):
        if scene not in scenes:
            log.warning(f"no page shows docs/live/{scene.name}")
    return files


def on_page_markdown(markdown: str, page: Page, **_: Any) -> str:
    """Put the live page in place of the link; CONTRIBUTING.md only shows how it is written."""
    if not (DOCS / page.file.src_uri).exists():
        return markdown

    def frame(match: re.Match[str]) -> str:
        title = escape(match[1])
        scene = (DOCS / page.file.src_uri).parent / match[2]
        alone, file = (
            get_relative_url(place_of(scene, kind), page.url) for kind in ("html", "toml")
        )
        return (
            f'<figure class="live"><iframe src="{alone}" title="{title}" loading="lazy"></iframe>'
            f'<figcaption><a class="alone" href="{alone}">Open alone</a>, with all '
            f'curves, numbers, validity and files · <a href="{file}" download>Scene</a>'
            "</figcaption></figure>"
        )

    return LINK.sub(frame, markdown)
