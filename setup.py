"""Long description of the package: README.md with links that hold on a package index."""

import re
from pathlib import Path

from setuptools import setup

HOME = "https://github.com/contactkit/contactkit/blob/main/"
FILES = "https://raw.githubusercontent.com/contactkit/contactkit/main/"


def absolute_links(text: str) -> str:
    """Markdown with absolute addresses in place of paths in the repository."""
    text = re.sub(r"(!\[[^]]*\]\()(?!https?:|#)", rf"\g<1>{FILES}", text)
    return re.sub(r"(?<!!)(\[[^]!]*\]\()(?!https?:|#)", rf"\g<1>{HOME}", text)


if __name__ == "__main__":
    readme = (Path(__file__).parent / "README.md").read_text(encoding="utf-8")
    setup(
        long_description=absolute_links(readme),
        long_description_content_type="text/markdown",
    )
