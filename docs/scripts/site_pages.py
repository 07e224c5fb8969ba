"""Hook of mkdocs: pages of folders in the navigation, pages of repository files and API, search.

An entry of ``nav`` that ends in ``/*.md`` stands for the pages of that folder: its ``index.md``,
then those that this links to, in their order, then the others by name. An empty folder is left
out.
"""

from __future__ import annotations

import posixpath
import re
import tomllib
from pathlib import Path
from typing import Any

from api_pages import TOPICS, folded, pages
from mkdocs.config.defaults import MkDocsConfig
from mkdocs.structure.files import File, Files
from mkdocs.structure.pages import Page

ROOT = Path(__file__).parents[2]
# Files of the repository that are pages, and their place in the site.
REPOSITORY = {
    "CHANGELOG.md": "about/changelog.md",
    "CONTRIBUTING.md": "about/contributing.md",
    "SECURITY.md": "about/security.md",
    "LICENSE": "about/licence.md",
    "CITATION.cff": "about/citation.md",
}
TITLES = {"LICENSE": "Licence", "CITATION.cff": "Citation"}
# How much a page counts in a search, by the beginning of its path; the first that fits. A word of a
# title counts as a thousand of the text: what is below 1e-3 comes after all prose.
BOOST = {
    "getting-started": 8.0,
    "tutorials/": 6.0,
    "how-to/": 4.0,
    "api/": 5e-4,
    "gallery/": 1e-3,
    "architecture": 5e-4,
    "about/": 5e-4,
}
# Words that lead to a page whatever else has them in its title.
WORDS = {
    "extras.md": "install installation pip conda wheel dependencies",
    "about/citation.md": "citation cite bibtex reference",
    "fmu.md": "fmu fmi simulink openmodelica amesim",
    "injector.md": "stiction valve spool diesel",
    "micromirror.md": "mems dmd",
    "physics/humidity.md": "humidity kelvin",
    "physics/roughness.md": "roughness psd",
    "physics/sliding.md": "hysteresis",
    "physics/viscous.md": "cavitation squeeze reynolds",
    "reference/materials.md": (
        "young modulus poisson hardness silicon glass steel rubber o-ring material liquid oil water"
    ),
    "reference/scene-files.md": "units unit toml",
    "tutorials/index.md": "tutorial example",
    "compared.md": "alternative tamaas contactmechanics slippy aspher comsol",
}


def in_order(folder: Path) -> list[str]:
    """Pages of a folder, the index first, then as the index links to them, then by name."""
    names = sorted(path.name for path in folder.glob("*.md"))
    if "index.md" in names:
        text = (folder / "index.md").read_text("utf-8")
        linked = ["index.md", *re.findall(r"\]\(([\w-]+\.md)[)#]", text)]
        names.sort(key=lambda name: linked.index(name) if name in linked else len(linked))
    return names


def expanded(entries: list[Any], docs: Path) -> list[Any]:
    """Navigation with the pages of each ``folder/*.md``."""
    found: list[Any] = []
    for entry in entries:
        if isinstance(entry, dict):
            ((title, below),) = entry.items()
            if isinstance(below, str) and not below.endswith("/*.md"):
                found.append(entry)
                continue
            pages = expanded(below if isinstance(below, list) else [below], docs)
            found += [{title: pages}] if pages else []
        elif entry.endswith("/*.md"):
            folder = entry.removesuffix("/*.md")
            found += [f"{folder}/{name}" for name in in_order(docs / folder)]
            if folder == "api":
                found += [f"api/{topic.page}.md" for topic in TOPICS]
        else:
            found.append(entry)
    return found


def repository_page(name: str) -> str:
    """A file of the repository as a page in ``about/``, with its links seen from there."""
    text = (ROOT / name).read_text("utf-8")
    if name in TITLES:
        return f"# {TITLES[name]}\n\n```text\n{text.strip()}\n```\n"

    def link(match: re.Match[str]) -> str:
        target, _, anchor = match[1].partition("#")
        if "://" in target or not target:
            return match[0]
        page = REPOSITORY.get(target, target.removeprefix("docs/"))
        return f"]({posixpath.relpath(page, 'about')}{'#' * bool(anchor)}{anchor})"

    return re.sub(r"\]\(([^)\s]+)\)", link, text)


def on_config(config: MkDocsConfig) -> MkDocsConfig:
    """Pages of folders, and the address of the repository below each page.

    As `repo_url` of the theme a page would fetch the stars of the repository when it is read.
    """
    about = {"About": [page for name, page in REPOSITORY.items() if (ROOT / name).exists()]}
    config.nav = [*expanded(config.nav or [], Path(config.docs_dir)), about]
    project = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
    urls = project["urls"]
    config.copyright = (
        f'<a href="{urls["Homepage"]}">Repository</a>, <a href="{urls["Issues"]}">issues</a>; '
        f"{project['license']}"
    )
    return config


def on_files(files: Files, config: MkDocsConfig) -> Files:
    """Add the pages that are files of the repository, and those of the API."""
    for place, content in pages().items():
        files.append(File.generated(config, place, content=content))
    for name, place in REPOSITORY.items():
        if (ROOT / name).exists():
            files.append(File.generated(config, place, content=repository_page(name)))
    return files


def on_page_markdown(markdown: str, page: Page, **_: Any) -> str:
    """Let a search find prose before functions."""
    if page.file.src_uri in WORDS:
        page.meta.setdefault("tags", WORDS[page.file.src_uri].split())
    for start, boost in BOOST.items():
        if page.file.src_uri.startswith(start):
            page.meta.setdefault("search", {"boost": boost})
            break
    if page.file.src_uri == "api/index.md":
        for topic in TOPICS:
            markdown = markdown.replace(
                f"| {topic.title} |", f"| [{topic.title}]({topic.page}.md) |"
            )
        return re.sub(r"`ck\.(\w+)`", r"[`\1`][contactkit.\1]", markdown)
    return markdown


def on_page_content(html: str, page: Page, **_: Any) -> str:
    """Fold the entries of the API."""
    return folded(html) if page.file.src_uri.startswith("api/") else html
