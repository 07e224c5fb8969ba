"""Draw the rooms of contactkit and their imports: ``python docs/architecture.py``."""

from __future__ import annotations

import sys
from pathlib import Path

import matplotlib.pyplot as plt

ROOT = Path(__file__).parents[1]
sys.path.insert(0, str(ROOT / "tests" / "rules"))

import test_imports as rule  # noqa: E402

LEFT_OUT = {"_lazy", "__main__", "errors", "units", "validators", "accuracy", "work_precision"}


def arrows() -> set[tuple[str, str]]:
    """Pairs of rooms of which the first imports from the second."""
    found = {
        (rule.room(name), rule.room(target))
        for name, targets in rule.IMPORTS.items()
        for target in targets
        if target.startswith("contactkit.") and name != "contactkit"
    }
    return {(a, b) for a, b in found if a != b and a and b and not {a, b} & LEFT_OUT}


def draw(path: Path) -> None:
    """Write the picture: one row per level, arrows from a room to those it imports from."""
    rows = [[room for room in rooms if room not in LEFT_OUT] for rooms in rule.FLOORS]
    rows = [row for row in rows if row]
    place = {
        room: ((i + 0.5) / len(row), level)
        for level, row in enumerate(rows)
        for i, room in enumerate(row)
    }
    figure, axes = plt.subplots(figsize=(9.0, 8.0))
    for above, below in sorted(arrows()):
        style = {"arrowstyle": "-|>", "color": "0.65", "lw": 0.7, "shrinkA": 12, "shrinkB": 12}
        axes.annotate("", place[below], place[above], arrowprops=style)
    for room, (x, y) in place.items():
        box = {"boxstyle": "round,pad=0.4", "fc": "white", "ec": "0.2"}
        axes.text(x, y, room, ha="center", va="center", fontsize=9, bbox=box)
    axes.set(xlim=(0.0, 1.0), ylim=(-0.6, len(rows) - 0.4))
    axes.axis("off")
    figure.savefig(path, dpi=110, bbox_inches="tight")


if __name__ == "__main__":
    draw(ROOT / "docs" / "img" / "architecture.png")
