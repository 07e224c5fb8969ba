"""Packages in the folders of the repository, and README.md with links that hold on an index."""

import re
from pathlib import Path

from setuptools import find_packages, setup

HOME = "https://github.com/contactkit/contactkit/blob/main/"
FILES = "https://raw.githubusercontent.com/contactkit/contactkit/main/"


FOLDERS = {
    "contactkit": "contactkit",
    "contactkit.fmu": "fmu",
    "contactkit.gallery": "examples/gallery",
    "contactkit.models": "models",
}


def packages() -> list[str]:
    """Every package by its dotted name: a folder with an ``__init__.py``."""
    here = Path(__file__).parent
    return [
        name
        for top, folder in FOLDERS.items()
        for name in (top, *(f"{top}.{p}" for p in find_packages(str(here / folder))))
    ]


def absolute_links(text: str) -> str:
    """Markdown with absolute addresses in place of paths in the repository."""
    text = re.sub(r"(!\[[^]]*\]\()(?!https?:|#)", rf"\g<1>{FILES}", text)
    return re.sub(r"(?<!!)(\[[^]!]*\]\()(?!https?:|#)", rf"\g<1>{HOME}", text)


if __name__ == "__main__":
    readme = (Path(__file__).parent / "README.md").read_text(encoding="utf-8")
    setup(
        packages=packages(),
        package_dir=FOLDERS,
        long_description=absolute_links(readme),
        long_description_content_type="text/markdown",
    )
