"""Figures of accuracy over cost: error against seconds."""

from __future__ import annotations

import re
from collections.abc import Sequence
from itertools import cycle

from ..work_precision import WorkPrecision
from .style import SERIES, Axes, figure, legend, plain_log

__all__ = ["closures", "work_precision"]

_COLORS = [colour for colour, *_ in SERIES]
_LEFT = "not tried"  # how a point begins that was left out


def closures(found: WorkPrecision, ax: Axes, bridges: Sequence[str]) -> Axes:
    """Draw seconds of each closure, a row for each bridge, with the error written beside it.

    Full signs stand for whole curves or whole answers, open ones for one gap at a time. Errors
    below that of the reference read "exact": they cannot be evaluated.
    """
    methods = list(dict.fromkeys(p.method for p in found.points))
    gap = 0.8 / len(methods)
    for p in found.points:
        if "first" in p.label:
            continue
        row = next(i for i, b in enumerate(bridges) if p.label.startswith(b))
        colour, _, mark = SERIES[methods.index(p.method)]
        y = row + gap * (methods.index(p.method) - 0.5 * (len(methods) - 1))
        fill = "none" if "one gap" in p.label else colour
        ax.plot(p.seconds, y, mark, ms=6.0, color=colour, mfc=fill, ls="none")
        ax.annotate(
            _error_text(p.error, found.floor),
            (p.seconds, y),
            (6.0, 0.0),
            textcoords="offset points",
            va="center",
            fontsize=8,
            color=colour,
        )
    for method, (colour, _, mark) in zip(methods, SERIES, strict=False):
        ax.plot([], [], mark, color=colour, ls="none", label=method)
    if any("one gap" in p.label for p in found.points):
        ax.plot([], [], "o", color="0.3", mfc="none", ls="none", label="open: one gap at a time")
    each = "gap" if any("gap" in p.label for p in found.points) else "bridge"
    ax.set(xscale="log", ylim=(len(bridges) - 0.5, -0.5))
    ax.set_xlabel(f"seconds per {each}; beside them: error of the {found.quantity}", fontsize=9)
    ax.set_yticks(range(len(bridges)), [_in_powers(one) for one in bridges])
    ax.margins(x=0.2)
    ax.grid(visible=False, axis="y")
    for i in range(1, len(bridges)):
        ax.axhline(i - 0.5, color="0.85", lw=0.8)
    return ax


def _error_text(error: float, floor: float) -> str:
    """An error in words that need no axis."""
    if error <= floor:
        return "exact"
    percent = 100.0 * error
    return f"{percent:.2g} %" if percent < 99.5 else f"{percent:.0f} %"


def _in_powers(text: str) -> str:
    """A name with its powers set, and degrees as a sign."""
    return re.sub(r"\b(\w)/(\w)\^(\d)", r"$\1/\2^\3$", text).replace(" deg", "°")


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
