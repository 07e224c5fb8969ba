"""Hook of mkdocs: a link to a scene of docs/live/, alone in its paragraph, is its live page.

Each scene is built once, by ``contactkit page``, and kept in build/live_pages/ until the scene or
the package changes. On GitHub the link leads to the scene.
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
SCENES, KEPT = ROOT / "docs" / "live", ROOT / "build" / "live_pages"
LINK = re.compile(r"^\[([^\]\n]+)\]\((?:\.\./)*live/([\w-]+)\.toml\)$", re.MULTILINE)
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
            raise PluginError(f"no live page of docs/live/{scene.name}: {said}")
    return page


def on_files(files: Files, config: MkDocsConfig) -> Files:
    """Add the pages of all scenes, built side by side."""
    scenes = sorted(SCENES.glob("*.toml"))
    with ThreadPoolExecutor(os.cpu_count()) as threads:
        for scene, page in zip(scenes, threads.map(built, scenes), strict=True):
            place = f"live/{scene.stem}.html"
            files.append(File.generated(config, place, abs_src_path=str(page)))
    shown = {
        name
        for file in files.documentation_pages()
        for _, name in LINK.findall(file.content_string)
    }
    for scene in scenes:
        if scene.stem not in shown:
            log.warning(f"no page shows docs/live/{scene.name}")
    return files


def on_page_markdown(markdown: str, page: Page, **_: Any) -> str:
    """Put the live page in place of the link."""

    def frame(match: re.Match[str]) -> str:
        title = escape(match[1])
        alone, scene = (
            get_relative_url(f"live/{match[2]}.{kind}", page.url) for kind in ("html", "toml")
        )
        return (
            f'<figure class="live"><iframe src="{alone}" title="{title}" loading="lazy"></iframe>'
            f'<figcaption><a class="alone" href="{alone}">Open alone</a>, with all '
            f'curves, numbers, validity and files · <a href="{scene}" download>Scene</a>'
            "</figcaption></figure>"
        )

    return LINK.sub(frame, markdown)
