"""Page of the hard cases: what makes each hard, what a naive method gives, what we give."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from contactkit.benchmarks.hard.case import HardCase
from contactkit.benchmarks.table import HARD_CASES

from .page import conditions, machine, number, picture, slug, table

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
        "Cases in which a plain method loses all digits, never ends, or has no answer. For each: "
        "what makes it hard, what a naive method gives, what contactkit gives, and the errors of "
        "both against a third solution. Each naive method was run; its code, as one would write it "
        "from a textbook, is in `contactkit/benchmarks/hard/`; `contactkit cost NAME` runs a case.",
        "![Errors of the naive method and of contactkit for each case](hard-cases.png)",
        "Errors are relative to the answer unless the table says otherwise; 1e-16 is round-off.",
    ]
    for half, title in _ROOMS.items():
        some = [(case, data["cases"][key]) for key, case in HARD_CASES.items() if case.half == half]
        rows = [(f"[{c.title}](#{slug(c.title)})", _naive(one), _ours(one)) for c, one in some]
        parts += [f"## {title}", table(("case", "error, naive", "error, contactkit"), rows)]
        parts += [_section(case, one) for case, one in some]
    parts += [
        "## How it was made",
        "`make pages PAGES=demands` runs all cases; `python docs/scripts/demands hard-cases "
        "--draw` makes the page from the data, `docs/demands/hard-cases.json`, without running "
        "them. `tests/demand_pages` runs them again and holds both errors to bounds that are "
        "good on any machine.",
        conditions(data["measured"]),
    ]
    return "\n\n".join(parts) + "\n"


def _naive(found: Mapping[str, Any]) -> str:
    return "no answer" if found["naive"] is None else number(found["naive"])


def _ours(found: Mapping[str, Any]) -> str:
    return "round-off" if found["ours"] < 2e-16 else number(found["ours"])


def _section(case: HardCase, found: Mapping[str, Any]) -> str:
    lines = [
        f"### {case.title}",
        case.why,
        table(
            ("", "method", "gives", "error"),
            (
                ("naive", case.naive, found["naive_gives"], _naive(found)),
                ("contactkit", case.ours, found["ours_gives"], _ours(found)),
            ),
        ),
        f"Error against {case.judge}. Kept by `{case.tested}`; `contactkit cost {case.name}` "
        "computes both.",
    ]
    return "\n\n".join(lines)


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
