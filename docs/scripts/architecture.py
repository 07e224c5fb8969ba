"""Draw the rooms of contactkit and their imports: ``python docs/scripts/architecture.py``."""

from __future__ import annotations

import itertools
import sys
from pathlib import Path

import matplotlib.pyplot as plt

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT / "tests" / "rules"))

import test_imports as rule  # noqa: E402

LEFT_OUT = {  # modules that any room imports
    *("_lazy", "_version", "__main__", "accuracy", "errors", "extras", "frozen", "installed"),
    *("registry", "units", "validators", "validity", "work_precision"),
}
# Place along the row, 0 to 1, where arrows would otherwise pass behind a room.
ACROSS = {
    **{
        "cli": 0.5,
        "gallery": 0.7,
        "app": 0.5,
        "fmu": 0.5,
        "models": 0.6,
        "benchmarks": 0.3,
        "models report": 0.6,
        "studies": 0.12,
        "plot": 0.97,
    },
    **{
        "analyses": 0.68,
        "shortcuts": 0.02,
        "files": 0.42,
        "citing": 0.12,
        "effects": 0.53,
        "planning": 0.85,
        "contact": 0.33,
    },
    **{"separation": 0.77, "scene": 0.55, "liquids": 0.65, "data": 0.38, "as_published": 0.78},
    **{
        "elasticity": 0.22,
        "roughness": 0.37,
        "capillary": 0.56,
        "lubrication": 0.82,
        "kinds": 0.635,
    },
    **{
        "adhesion": 0.98,
        "numerics": 0.82,
        "reference": 0.02,
        "export": 0.45,
        "reading": 0.3,
        "arguments": 0.69,
    },
}


def arrows() -> set[tuple[str, str]]:
    """Pairs of rooms of which the first imports from the second."""
    found = {
        (rule.room(name), rule.room(target))
        for name, targets in rule.all_imports().items()
        for target in targets
        if target.startswith("contactkit.") and name != "contactkit"
    }
    return {(a, b) for a, b in found if a != b and a and b and not {a, b} & LEFT_OUT}


def direct(pairs: set[tuple[str, str]]) -> set[tuple[str, str]]:
    """Arrows that do not follow from a chain of others (transitive reduction)."""

    def reaches(start: str, goal: str, skipped: tuple[str, str]) -> bool:
        steps = {b for a, b in pairs if a == start and (a, b) != skipped}
        return goal in steps or any(reaches(step, goal, skipped) for step in steps)

    return {(a, b) for a, b in pairs if not reaches(a, b, (a, b))}


def draw(path: Path) -> None:
    """Write the picture: one row per level, arrows from a room to those it imports from."""
    rows = [[room for room in rooms if room not in LEFT_OUT] for rooms in rule.FLOORS]
    rows = [row for row in rows if row]
    place = {room: (ACROSS.get(room, 0.5), level) for level, row in enumerate(rows) for room in row}
    figure, axes = plt.subplots(figsize=(8.0, 7.0), dpi=110)
    boxes = {}
    for room, (x, y) in place.items():
        style = {"boxstyle": "round,pad=0.4", "fc": "white", "ec": "0.2"}
        boxes[room] = axes.text(
            x, y, room, ha="center", va="center", fontsize=10, bbox=style, zorder=3
        )
    figure.canvas.draw()  # places the boxes
    frames = {room: box.get_bbox_patch().get_window_extent() for room, box in boxes.items()}
    for one, other in itertools.combinations(frames, 2):
        if frames[one].overlaps(frames[other]):
            raise ValueError(f"the boxes of {one} and {other} overlap: give them places in ACROSS")
    for above, below in sorted(direct(arrows())):
        ends = {"patchA": boxes[above].get_bbox_patch(), "patchB": boxes[below].get_bbox_patch()}
        style = {"arrowstyle": "-|>", "color": "0.45", "lw": 0.9, "shrinkA": 0, "shrinkB": 1}
        axes.annotate("", place[below], place[above], arrowprops=style | ends, zorder=1)
    axes.set(xlim=(-0.05, 1.07), ylim=(-0.6, len(rows) - 0.4))
    axes.axis("off")
    figure.subplots_adjust(left=0.01, right=0.99, bottom=0.0, top=1.0)
    figure.canvas.draw()  # places the boxes, at which the arrows end
    figure.savefig(path)


if __name__ == "__main__":
    draw(ROOT / "docs" / "img" / "architecture.png")
