"""Make the pictures of the documentation with the program itself: ``python docs/pictures.py``.

Runs the fuel injector and its cost, and keeps the figures that the pages show, with a palette of
64 colours so that they stay small.
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
from pathlib import Path

from PIL import Image

IMG = Path(__file__).parent / "img"
SHOWN = {
    "run": ("tension-limit", "release-zoom", "delay-against-temperature"),
    "cost": ("cost",),
}


def main() -> int:
    """Run both commands and keep their figures."""
    IMG.mkdir(exist_ok=True)
    with tempfile.TemporaryDirectory(prefix="contactkit-") as folder:
        for command, names in SHOWN.items():
            arguments = ["-m", "contactkit.cli", command, "fuel-injector", "--out", folder]
            subprocess.run([sys.executable, *arguments], check=True)
            for name in names:
                with Image.open(Path(folder) / f"{name}.png") as figure:
                    small = figure.convert("RGB").quantize(64, dither=Image.Dither.NONE)
                    small.save(IMG / f"{name}.png", optimize=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
