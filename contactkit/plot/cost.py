"""Figures of accuracy over cost: error against seconds."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import cycle

from ..work_precision import WorkPrecision
from .style import SERIES, Axes, figure, legend, plain_log

__all__ = ["closures", "work_precision"]

_COLORS = [colour for colour, *_ in SERIES]
_LEFT = "not tried"  # how a point begins that was left out


def closures(found: WorkPrecision, ax: Axes, bridges: Sequence[str]) -> Axes:
    """Draw error against seconds per gap: a colour for each closure, a marker for each bridge.

    Full signs stand for whole curves or whole answers, open ones for one gap at a time.
    """
    colors = dict(zip(dict.fromkeys(p.method for p in found.points), _COLORS, strict=False))
    for p in found.points:
        name = next(b for b in bridges if p.label.startswith(b))
        full = "none" if "one gap" in p.label or "first" in p.label else colors[p.method]
        ax.plot(
            p.seconds,
            max(p.error, 1e-16),
            "osD^vP*X"[bridges.index(name)],
            ms=6.5,
            color=colors[p.method],
            mfc=full,
            ls="none",
        )
    for method, color in colors.items():
        ax.plot([], [], "-", lw=5, color=color, label=method)
    for name, marker in zip(bridges, "osD^vP*X", strict=False):
        ax.plot([], [], marker, color="0.3", ls="none", label=name)
    ax.plot([], [], "o", color="0.3", mfc="none", ls="none", label="open: one gap, or first time")
    low = 0.1 * min([found.floor, *(p.error for p in found.points if p.error > 0.0)])
    ax.axhspan(max(low, 1e-16), found.floor, color="0.9", label="error of the reference")
    each = "gap" if any("gap" in p.label for p in found.points) else "bridge"
    ax.set(xscale="log", yscale="log", xlabel=f"seconds per {each}")
    ax.set_ylabel(f"relative error of the {found.quantity}")
    return ax


def work_precision(
    found: WorkPrecision,
    ax: Axes | None = None,
    markers: Sequence[str] = "osD^vP*X",
    *,
    beside: bool = True,
) -> Axes:
    """Draw error against seconds, a line for each method; errors of models are horizontal.

    The legend names the settings that a method refuses or fails at, which have no place in the
    panel. `beside` puts it at the side of the panel, else below it.
    """
    ax = ax if ax is not None else figure()[1]
    methods = list(dict.fromkeys(p.method for p in found.points))
    looks = zip(
        cycle(one for one, _, _ in SERIES), cycle(markers), strict=False
    )  # repeated as needed
    for method, (color, marker) in zip(methods, looks, strict=False):
        points = [p for p in found.points if p.method == method]
        good = [p for p in points if p.error == p.error]
        bad = [p.label for p in points if p.error != p.error and not p.problem.startswith(_LEFT)]
        style = "--" if any(p.is_model for p in points) else "-"
        drawn = [max(p.error, 1e-16) for p in good]
        settings = f": {', '.join(bad)}" if good else ""
        label = f"{method}\n  no answer{settings}" if bad else method
        seconds = [p.seconds for p in good]
        ax.plot(seconds, drawn, style, color=color, marker=marker, label=label)
    worst = [p.error for p in found.points if p.error == p.error]
    low = 0.1 * min(found.floor, *worst)
    ax.axhspan(low, found.floor, color="0.9", label="error of the reference")
    ax.set(xscale="log", yscale="log", xlabel="seconds", ylim=(max(low, 1e-16), None))
    ax.set_ylabel(f"relative error of the {found.quantity}")
    plain_log(ax.xaxis)
    if beside:
        legend(ax, fontsize=8, loc="center left", bbox_to_anchor=(1.0, 0.5))
    else:
        legend(ax, fontsize=8, loc="upper center", bbox_to_anchor=(0.5, -0.16), ncols=2)
    return ax
