"""Pictures of the documentation, made by the commands: ``python docs/scripts/pictures.py``.

Runs the scenes and their costs, keeps the figures that the pages show, with a palette of 128
colours so that they stay small, and writes the numbers of the head-disk interface into the pages.
Some minutes; names select some of the runs: ``python docs/scripts/pictures.py head-disk``.
"""

from __future__ import annotations

import contextlib
import csv
import io
import json
import re
import subprocess
import sys
import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from measured_blocks import write_blocks
from PIL import Image, ImageChops
from validation_tables import grid

IMG = Path(__file__).parents[1] / "img"
MARGIN = 12  # pixels of white around a figure that is joined to another
EXAMPLES = Path(__file__).parents[2] / "examples"
SHOWN_EXAMPLES = (
    "area_and_theories",
    "loading_history",
    "rough_coating",
    "rubbed_sphere",
    "viscoelastic_sphere",
)  # their figures, by the names of their files
# (scene, command): figures by the name they have in the pages; with + beside each other, with /
# one below the other.
SHOWN: Mapping[tuple[str, str], Mapping[str, str]] = {
    ("fuel-injector", "run"): {
        name: name
        for name in (
            "release-zoom",
            "one-cycle",
            "delay-against-temperature",
            "delay-against-strength",
            "delay-against-pressure",
        )
    },
    ("fuel-injector", "cost"): {"cost": "cost", "coupling": "coupling"},
    ("bridges", "cost"): {"cost": "bridges-cost"},
    ("micromirror", "run"): {
        "side-view": "mirror-side-view",
        "lift-off": "mirror-lift-off",
        "release-against-humidity": "mirror-release",
        "force-gap": "mirror-force-gap",
    },
    ("head-disk", "run"): {
        "areas + pressure-close-up": "head-disk-contact",
        "stress / stress-close-up": "head-disk-stress",
        "upper-stack / stack": "head-disk-stack",
        "study": "head-disk-load-curve",
    },
    ("head-disk", "cost"): {"cost": "head-disk-cost"},
}
SELF_CONSISTENT = "effects.film-meniscus.self_consistent [-]"  # of two curves; the page has one
COLUMNS = {  # of a load curve: heading and factor
    "loading.pressure": ("load [MPa]", 1e-6),
    "contact_fraction": ("contact [%]", 100.0),
    "plastic_fraction": ("plastic [%]", 100.0),
    "relative_meniscus_force": ("meniscus / load", 1.0),
}
NUMBERS = {  # of the run: what it is, factor, unit
    "load": ("load", 1e3, "mN"),
    "max_pressure": ("maximum pressure", 1e-9, "GPa"),
    "hardness": ("effective hardness", 1e-9, "GPa"),
    "contact_fraction": ("real area of contact", 100.0, "% of the window"),
    "plastic_fraction": ("plastic area", 100.0, "% of the window"),
    "max_displacement": ("maximum displacement, from the mean plane", 1e9, "nm"),
    "approach": ("approach, from the mean plane", 1e9, "nm"),
    "friction_force": ("friction force", 1e3, "mN"),
    "meniscus_force": ("meniscus force", 1e3, "mN"),
    "n_menisci": ("menisci", 1.0, ""),
    "max_von_mises": ("maximum von Mises stress", 1e-9, "GPa"),
    "max_tension": ("maximum tension", 1e-9, "GPa"),
    "max_tresca": ("maximum shear stress (Tresca)", 1e-9, "GPa"),
    "max_sigma_xz": ("maximum sigma_xz", 1e-9, "GPa"),
}


def head_disk_numbers(scalars: Mapping[str, Mapping[str, float]]) -> str:
    """Numbers of the head-disk interface at the pressure of the scene."""
    rows = []
    for name, (label, factor, unit) in NUMBERS.items():
        value = f"{scalars[name]['value'] * factor:.4g} {unit}".strip()
        if f"{name}_depth" in scalars:
            depth, layer = (scalars[f"{name}_{what}"]["value"] for what in ("depth", "layer"))
            value += f", {depth * 1e9:.3g} nm deep, layer {int(layer) + 1}"
        rows.append((label, value))
    return grid(("what", "value"), rows)


def load_curve(text: str) -> str:
    """Load curve without the pull of the film, from the CSV file that the run wrote."""
    every = csv.DictReader(io.StringIO(text))
    rows = [row for row in every if row[SELF_CONSISTENT] == "False"]
    found = {name: next(k for k in rows[0] if k.startswith(f"{name} [")) for name in COLUMNS}
    cells = [
        [f"{float(row[found[name]]) * factor:.3g}" for name, (_, factor) in COLUMNS.items()]
        for row in rows
    ]
    return grid([heading for heading, _ in COLUMNS.values()], cells)


def keep(folder: Path, names: Mapping[str, str], colours: int = 128) -> None:
    """Keep some figures of a run, small by a palette of so many colours."""
    for name, kept in names.items():
        figure = joined(folder, name)
        small = figure.quantize(colours, Image.Quantize.MAXCOVERAGE, 1, dither=Image.Dither.NONE)
        small.save(IMG / f"{kept}.png", optimize=True)


def joined(folder: Path, name: str) -> Image.Image:
    """A figure of a folder, or two: beside each other by +, one below the other by /."""
    below = " / " in name
    parts = [
        trimmed(Image.open(folder / f"{one}.png").convert("RGB"))
        for one in name.split(" / " if below else " + ")
    ]
    widths, heights = zip(*(one.size for one in parts), strict=True)
    size = (max(widths), sum(heights)) if below else (sum(widths), max(heights))
    whole = Image.new("RGB", size, "white")
    place = 0
    for one in parts:
        whole.paste(one, (0, place) if below else (place, 0))
        place += one.height if below else one.width
    return whole


def trimmed(figure: Image.Image) -> Image.Image:
    """A figure without its white border but for a margin: maps of equal axes leave much of it."""
    white = Image.new("RGB", figure.size, "white")
    left, top, right, bottom = ImageChops.difference(figure, white).getbbox()
    width, height = figure.size
    return figure.crop(
        (
            max(left - MARGIN, 0),
            max(top - MARGIN, 0),
            min(right + MARGIN, width),
            min(bottom + MARGIN, height),
        )
    )


def run(scene: str, command: str, folder: Path) -> str:
    """Run a command on a scene; what it prints as JSON."""
    arguments = ["-m", "contactkit.cli", command, scene, "--out", str(folder), "--json"]
    done = subprocess.run([sys.executable, *arguments], check=True, stdout=subprocess.PIPE)
    return done.stdout.decode("utf-8")


def blocks(command: str, folder: Path, printed: str) -> Mapping[str, str]:
    """Blocks of measured numbers of the head-disk interface."""
    if command == "cost":
        return {}
    curve = load_curve((folder / "study.csv").read_text("utf-8"))
    numbers = head_disk_numbers(json.loads(printed))
    return {"head-disk numbers": numbers, "head-disk load curve": curve}


def run_example(name: str, folder: Path) -> None:
    """Run an example, which draws its figure into a folder."""
    code = f"from pathlib import Path; from {name} import main; main(Path({str(folder)!r}))"
    subprocess.run([sys.executable, "-c", code], check=True, cwd=EXAMPLES)


def views(folder: Path) -> None:
    """Draw the views in three dimensions of the contact that the page on figures solves."""
    from contactkit.plot.view3d import save_view

    page = (IMG.parent / "how-to" / "figures.md").read_text("utf-8")
    names: dict[str, Any] = {}
    with contextlib.chdir(folder):
        code = re.search(r"```python\n(.*?)```", page, re.DOTALL)[1]
        exec(code.replace("grid=64", "grid=256"), names)  # within its ranges of validity
    save_view(names["result"].plot.surface_3d(off_screen=True), folder / "surface.png")
    save_view(names["result"].plot.stress_3d(off_screen=True), folder / "stress.png")


def main(arguments: Sequence[str]) -> int:
    """Run the scenes and keep their figures."""
    IMG.mkdir(exist_ok=True)
    if not arguments or "views" in arguments:
        with tempfile.TemporaryDirectory(prefix="contactkit-") as name:
            views(Path(name))
            keep(Path(name), {"surface": "surface-3d", "stress": "stress-3d"}, colours=256)
    for example in SHOWN_EXAMPLES:
        if arguments and example not in arguments:
            continue
        with tempfile.TemporaryDirectory(prefix="contactkit-") as name:
            run_example(example, Path(name))
            keep(Path(name), {example: example.replace("_", "-")})
    for (scene, command), names in SHOWN.items():
        if arguments and scene not in arguments and f"{scene}/{command}" not in arguments:
            continue
        with tempfile.TemporaryDirectory(prefix="contactkit-") as name:
            folder = Path(name)
            printed = run(scene, command, folder)
            keep(folder, names)
            if scene == "head-disk":
                write_blocks(blocks(command, folder, printed))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
