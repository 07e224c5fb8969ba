"""Tables and sentences of the paper (docs/paper): what benchmarks measured, and what tests hold.

No number of the paper is written by hand: each block between marks is made here.
"""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from demands.accuracy import fastest, peer_ratio, peer_ratios
from validation_tables import grid

from contactkit.benchmarks.table import HARD_CASES, STUDIES

DOCS = Path(__file__).parents[1]


def _found(name: str) -> Any:
    return json.loads((DOCS / "demands" / f"{name}.json").read_text("utf-8"))


def feature_table() -> str:
    """Table of what the programs compute, from the page that compares them."""
    page = (DOCS / "compared.md").read_text("utf-8")
    part = page.partition("## Side by side\n\n")[2].partition("\n\n")[0]
    return re.sub(r"\[([^]]+)\]\([^)]+\)", r"\1", part)  # links of the site


def speed_table() -> str:
    """Seconds of contactkit and of the fastest accurate program, problem by problem."""
    largest: dict[str, tuple[str, ...]] = {}  # of each problem: the page of costs has the others
    for row in _found("peers")["rows"]:
        ratio = peer_ratio(row)
        if ratio is not None:
            other = re.sub(r" \(.*", "", fastest(row["peers"]))
            own = f"{row['seconds']:.2g}"
            largest[row["what"]] = f"{row['what']}, {row['n']}", own, other, f"{ratio:.1f}"
    head = "problem, pixels a side", "contactkit", "fastest other", "times"
    return grid(head, largest.values())


def speed_sentence() -> str:
    """Least, middle and largest ratio of all problems."""
    ratios = sorted(peer_ratios(_found("peers")))
    below = sum(ratio < 1.0 for ratio in ratios)
    middle = ratios[len(ratios) // 2]
    return (
        f"On {len(ratios)} problems that two programs solve, the fastest other takes "
        f"{ratios[0]:.1f} to {ratios[-1]:.0f} times as long, {middle:.1f} times in the middle; in "
        f"{below} of them it is faster."
    )


def hard_case_sentence() -> str:
    """Number of hard cases, and the largest error in them."""
    cases: Mapping[str, Any] = _found("hard-cases")["cases"]
    lost = sum(one["naive"] is None or one["naive"] >= 0.01 for one in cases.values())
    worst = max(one["ours"] for one in cases.values())
    return (
        f"{len(HARD_CASES)} hard cases stand in the tests beside a method from a textbook, which "
        f"has no answer or is more than 1 % off in {lost} of them; the largest error of "
        f"`contactkit` is {worst:.0e}."
    )


def check_sentence() -> str:
    """Number of studies of accuracy, and the errors of releases and of rough contacts."""
    studies = _found("accuracy-and-cost")["studies"]
    releases = [p for p in studies["releases"] if p["setting"] == "standard"]
    worst = max(p["error"] for p in releases)
    solved = [p for p in studies["rough-contact"] if p["error"]]
    pixels = max(p["error"] for p in solved)
    return (
        f"{len(STUDIES)} studies of accuracy and cost are run by one command each: release times "
        f"of films on which two other codes agree are met to {worst:.0e}, pressures of rough "
        f"contacts at the default tolerance to {pixels:.0e}."
    )


_SHARED = "% Of contactkit/data/references.bib, by docs/scripts/tables.py:\n"


def bibliography(own: str) -> str:
    """Bibliography of the paper: its own entries, then those of the package that it cites.

    One file beside the paper is all that its journal reads.
    """
    paper = (DOCS / "paper" / "paper.md").read_text("utf-8")
    shared = (DOCS.parent / "contactkit" / "data" / "references.bib").read_text("utf-8")
    cited = set(re.findall(r"@([a-z0-9]+)", paper))
    entries = re.split(r"^(?=@)", shared, flags=re.MULTILINE)[1:]
    kept = [one.strip() for one in entries if re.match(r"@\w+\{(\w+),", one)[1] in cited]  # type: ignore[index]
    return own.partition(_SHARED)[0] + _SHARED + "\n" + "\n\n".join(kept) + "\n"
