"""Page of the hard cases: what makes each hard, what a naive method gives, what we give."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from contactkit.benchmarks.hard.case import HardCase
from contactkit.benchmarks.table import HARD_CASES
from contactkit.plot.axis_units import in_prose

from .page import conditions, machine, number, picture

__all__ = ["NAME", "draw", "measure", "page"]

NAME = "hard-cases"
_ROOMS = {"contact": "Contact", "separation": "Separation"}
_EXACT = 1e-19  # where an error of zero is drawn, apart from that of round-off
_NO_ANSWER = 1e2  # where the picture shows a method without an answer


def measure() -> dict[str, Any]:
    """Run every case with both methods."""
    return {"measured": machine(), "cases": {k: c.run()._asdict() for k, c in HARD_CASES.items()}}


def page(data: Mapping[str, Any]) -> str:
    """The page as Markdown."""
    parts = [
        "# Hard cases",
        "Cases in which a plain method loses all digits, never ends, or has no answer: what makes "
        "each hard, what a naive method gives, written as one would from a textbook and run, and "
        "what contactkit gives. Errors are relative to the answer, against a third solution; "
        "1e-16 is round-off. `contactkit cost NAME` runs a case.",
        "![Errors of the naive method and of contactkit for each case](hard-cases.png)",
    ]
    for half, title in _ROOMS.items():
        some = [(case, data["cases"][key]) for key, case in HARD_CASES.items() if case.half == half]
        parts += [f"## {title}", *(_case(case, one) for case, one in some)]
    parts += ["## Measured", conditions(data["measured"]) + " [Data](hard-cases.json)."]
    return in_prose("\n\n".join(parts) + "\n")


def _naive(found: Mapping[str, Any]) -> str:
    return "no answer" if found["naive"] is None else f"error {number(found['naive'])}"


def _ours(found: Mapping[str, Any]) -> str:
    return "round-off" if found["ours"] < 2e-16 else f"error {number(found['ours'])}"


def _case(case: HardCase, found: Mapping[str, Any]) -> str:
    """A case: why it is hard, and a line for each method."""
    lines = [
        f"**{case.title}** (`{case.name}`). {case.why}\n",
        f"- naive: {case.naive}; {found['naive_gives']}: {_naive(found)}",
        f"- contactkit: {case.ours}; {found['ours_gives']}: {_ours(found)} against {case.judge}",
    ]
    return "\n".join(lines)


def draw(data: Mapping[str, Any]) -> None:
    """Errors of both methods, a line for each case."""
    from contactkit.plot import style as plot

    made, ax = plot.figure(size=(8.6, 6.2))
    rows = list(HARD_CASES.items())[::-1]
    labels = []
    own, other = plot.SERIES[1][0], plot.SERIES[2][0]
    for y, (key, case) in enumerate(rows):
        one = data["cases"][key]
        ours = max(one["ours"], _EXACT)
        naive = _NO_ANSWER if one["naive"] is None else one["naive"]
        ax.plot([ours, naive], [y, y], color="0.8", lw=1.2, zorder=1)
        ax.plot(ours, y, "o", color=own, label="contactkit" if y == 0 else None)
        mark, name = ("x", "naive method: no answer") if one["naive"] is None else ("s", "")
        ax.plot(naive, y, mark, color=other, ms=7 if name else 5)
        labels.append(case.title)
    ax.plot([], [], "s", color=other, ms=5, label="naive method")
    ax.plot([], [], "x", color=other, ms=7, label="naive method: no answer")
    ax.set_yticks(range(len(labels)), labels, fontsize=8.5)
    ax.set(xscale="log", xlim=(0.2 * _EXACT, 1e3), xlabel="relative error")
    powers = range(-16, 1, 4)
    names = ["exact", *(f"$10^{{{e}}}$" for e in powers)]
    ax.set_xticks([_EXACT, *(10.0**e for e in powers)], names)
    ax.grid(False, axis="y")
    plot.shared_legend(made, ax)
    picture(made, NAME)
