"""Page of the effects: formula, source, validity and cost of each."""

from __future__ import annotations

import re
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import Any

from contactkit.benchmarks.timing import cost
from contactkit.kinds import CONTACT_EFFECTS, SEPARATION_EFFECTS, SLIDING_EFFECTS
from contactkit.plot.axis_units import in_prose

from .effect_scenes import ENTRIES
from .page import conditions, folded, machine, picture, table

__all__ = ["NAME", "draw", "lists", "measure", "page"]

NAME = "effects"
ROOT = Path(__file__).parents[3]
KINDS = {"Separation": SEPARATION_EFFECTS, "Sliding": SLIDING_EFFECTS, "Contact": CONTACT_EFFECTS}
# Scenes of several effects, by what the page calls them.
_SCENES = {
    "the oil film": "a disc of 3.175 mm pulled by 40 N off 0.16 mm3 of engine oil, from 5 to 25 um",
    "the drawn bridge": "1 mm3 of an oil of 1 Pa.s between spheres of 4 mm, drawn from 50 um to "
    "1.3 mm at 0.5 mm/s",
    "the rough contact": "steel under a rough flat, 2 um wide, 256 x 256 pixels, 200 MPa",
}
_WHERE = ("models", "examples", "contactkit/data/templates")


def measure() -> dict[str, Any]:
    """Cost of each effect, its sources and numbers of validity, and the scenes that list it."""
    return {"measured": machine(), "effects": {k.name: _measured(k) for k in ENTRIES}}


def _measured(kind: type) -> dict[str, Any]:
    entry = ENTRIES[kind]
    with_it, result = cost(entry.scene, entry.accuracy)
    found: dict[str, Any] = {"with": with_it._asdict(), "without": None}
    shared: set[str] = set()
    if entry.without is not None:
        without, other = cost(entry.without, entry.accuracy)
        found["without"] = without._asdict()
        shared = {number.name for number in other.validity}
    own = [one for one in result.validity if one.name not in shared]
    effect = next(e for e in entry.scene.effects if isinstance(e, kind))
    return found | {
        "validity": [f"{one.name} ({one.bounds})" for one in own],
        "sources": list(effect.cites(entry.scene)),
        "scenes": _uses(kind),
    }


def lists(path: Path, kind: Any) -> bool:
    """Whether a scene, an example or a page of the gallery lists an effect."""
    text = path.read_text(encoding="utf-8")
    return bool(re.search(rf'effect\s*=\s*"{kind.name}"|\b{kind.__name__}\(', text))


def _uses(kind: Any) -> list[str]:
    """Files that list an effect."""
    paths = (p for folder in _WHERE for p in sorted((ROOT / folder).rglob("*")))
    some = (p for p in paths if p.suffix in (".toml", ".py"))
    return [p.relative_to(ROOT).as_posix() for p in some if lists(p, kind)]


def page(data: Mapping[str, Any]) -> str:
    """The page as Markdown."""
    parts = [
        "# Effects",
        "A scene lists the effects it calls for; nothing else is prepared, computed, allocated or "
        "imported. Of each effect: what it is, with a link to its equations, its source, the "
        "[validity numbers](../physics.md#validity-numbers) it adds, and what leaving it out "
        "saves.",
        "![Seconds and memory of a scene with and without each effect](effects.png)",
        "Seconds of CPU of plan and run; memory is the peak of what Python and numpy allocate. "
        "Some scenes run longer without the effect: a film that cavitates or breaks early needs "
        "fewer steps.",
        f"Scenes: {'; '.join(f'*{name}* is {what}' for name, what in _SCENES.items())}.",
    ]
    for title, registry in KINDS.items():
        rows = [_row(kind, data["effects"][kind.name]) for kind in registry]
        head = ("effect", "with [s]", "without [s]", "memory saved")
        parts += [f"## {title}", folded("Seconds and memory", table(head, rows))]
        parts.append("\n".join(_section(kind, data["effects"][kind.name]) for kind in registry))
    parts += ["## Measured", conditions(data["measured"]) + " [Data](effects.json)."]
    return in_prose("\n\n".join(parts) + "\n")


def _row(kind: Any, found: Mapping[str, Any]) -> tuple[str, ...]:
    name = f"`{kind.name}`"
    with_it, without = found["with"], found["without"]
    if without is None:
        return name, _seconds(with_it["seconds"]), "-", "-"
    saved = _memory(with_it["memory"] - without["memory"])
    return name, _seconds(with_it["seconds"]), _seconds(without["seconds"]), saved


def _seconds(value: float) -> str:
    return f"{value:.2g}" if value >= 1e-3 else f"{value:.1e}"


def _memory(value: float) -> str:
    """Memory [MiB], in the unit that suits it."""
    return f"{value:.1f} MiB" if abs(value) >= 0.95 else f"{round(1024.0 * value)} KiB"


@cache
def _explained() -> Mapping[str, str]:
    """Page of docs/physics that explains an effect, by its name in files."""
    found = {}
    for path in sorted((ROOT / "docs" / "physics").glob("*.md")):
        names = re.findall(r"effect `([\w-]+)`", path.read_text(encoding="utf-8"))
        found |= dict.fromkeys(names, f"../physics/{path.name}")
    return found


def _section(kind: Any, found: Mapping[str, Any]) -> str:
    entry = ENTRIES[kind]
    ranges = ", ".join(one.partition(" (")[0] for one in found["validity"])
    what = entry.what
    for name, scene in _SCENES.items():
        what = what.replace(scene, name)
    without = "" if entry.instead == "nothing" else f"; without it {entry.instead}"
    return (
        f"- [`{kind.__name__}`]({_explained()[kind.name]}), {kind.summary}: ${entry.formula}$. "
        f"Source: {'; '.join(found['sources'])}. {f'Validity: {ranges}. ' if ranges else ''}"
        f"Measured on {what}{without}."
    )


def _change(ratio: float) -> str:
    """What the effect adds, in per cent or as a factor."""
    if ratio >= 1.95:
        return f"{ratio:.0f} times" if ratio > 9.5 else f"{ratio:.2g} times"
    percent = round(100.0 * (ratio - 1.0))
    return f"{percent:+d} %" if percent else "the same"


def draw(data: Mapping[str, Any]) -> None:
    """Seconds and memory of each scene with the effect and without it."""
    from contactkit.plot import style as plot

    kinds = [kind for registry in KINDS.values() for kind in registry][::-1]
    made, axes = plot.figure(1, 2, size=(10.0, 8.4), sharey=True)
    first, second = (colour for colour, *_ in plot.SERIES[1:3])
    with_it = {"ls": "none", "marker": "o", "color": first, "ms": 5}
    without = {"ls": "none", "marker": "s", "color": second, "ms": 4.5, "mfc": "white"}
    across = plot.Axes.get_yaxis_transform
    shown = {"seconds": "CPU time [s]", "memory": "peak memory [MiB]"}
    for ax, (key, label) in zip(axes, shown.items(), strict=True):
        for y, kind in enumerate(kinds):
            found = data["effects"][kind.name]
            high = found["with"][key]
            if found["without"] is not None:
                low = found["without"][key]
                ax.plot([low, high], [y - 0.18, y + 0.18], color="0.75", lw=1.5, zorder=1)
                ax.plot(low, y - 0.18, zorder=2, **without)
                ax.text(1.01, y, _change(high / low), fontsize=8, va="center", transform=across(ax))
            ax.plot(high, y + 0.18, zorder=3, **with_it)
        ax.set(xscale="log", xlabel=label)
        ax.grid(False, axis="y")
    axes[0].plot([], [], label="with the effect", **with_it)
    axes[0].plot([], [], label="without it", **without)
    axes[0].set_yticks(range(len(kinds)), [kind.name for kind in kinds], fontsize=9)
    plot.shared_legend(made, axes[0])
    picture(made, NAME)
