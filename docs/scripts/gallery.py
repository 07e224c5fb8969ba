"""Pages of the gallery for the documentation: ``python docs/scripts/gallery.py [NAME ...]``.

Runs ``contactkit gallery`` at full size into out/gallery, where finished data are kept, copies
pages, the numbers that they link to and PNGs, these with a palette of 128 colours so that they stay
small, into docs/gallery, and writes the index of all pages that are there.
"""

from __future__ import annotations

import shutil
import subprocess
import sys
from pathlib import Path

from PIL import Image

from contactkit.app.gallery.report import index
from contactkit.app.gallery.scripts import scripts

ROOT = Path(__file__).parents[2]
MADE, SHOWN = ROOT / "out" / "gallery", ROOT / "docs" / "gallery"
COLOURS = 128


def copy_pages() -> None:
    """Copy the pages that are made and their pictures; write the index of all."""
    SHOWN.mkdir(exist_ok=True)
    for page in sorted(MADE.glob("*.md")):
        shutil.copyfile(page, SHOWN / page.name)
        if f"({page.stem}.csv)" in page.read_text(encoding="utf-8"):
            shutil.copyfile(page.with_suffix(".csv"), SHOWN / f"{page.stem}.csv")
    (SHOWN / "index.md").write_text(index(scripts(), SHOWN), encoding="utf-8")
    for picture in sorted(MADE.glob("*.png")):
        with Image.open(picture) as image:
            image.convert("RGB").quantize(COLOURS, Image.Quantize.MAXCOVERAGE, 1).save(
                SHOWN / picture.name, optimize=True
            )


if __name__ == "__main__":
    command = [sys.executable, "-m", "contactkit", "gallery", *sys.argv[1:]]
    command += ["--out", str(MADE), "--overwrite"]
    status = subprocess.run(command, check=False).returncode
    copy_pages()
    sys.exit(status)
