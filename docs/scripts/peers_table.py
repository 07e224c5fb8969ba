"""Put what ``make bench`` measured against other programs into docs/accuracy.md.

``python docs/scripts/peers_table.py`` reads ``out/bench/contact.json``, which the benchmark leaves.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from measured_blocks import write_blocks
from validation_tables import grid

FOUND = Path(__file__).parents[2] / "out" / "bench" / "contact.json"
PEERS = ("aspher", "slippy", "tamaas", "ContactMechanics")
KEYS = ("surface", "n", "boundary", "area", "threads")
GOOD = 1.5e-8  # maximum violation, over the rms height, of an accepted solution


def times(row: Mapping[str, Any] | None, by: float) -> str:
    """Ratio of a peer's time to ours; a dash where it was not run or not accurate enough."""
    if row is None or not row.get("kkt", 1.0) <= GOOD:
        return "-"
    return f"{row['seconds'] / by:.1f}"


def main() -> int:
    """Read, and write the block."""
    found = json.loads(FOUND.read_text("utf-8"))
    cases: dict[tuple[Any, ...], dict[str, Any]] = {}
    for row in found["contest"]:
        cases.setdefault(tuple(row.get(key) for key in KEYS), {})[row["solver"]] = row
    rows = []
    for (surface, n, edges, area, threads), by in cases.items():
        if "plain" not in by or "fast" not in by:
            continue
        plain, fast = by["plain"], by["fast"]
        rows.append(
            [
                f"{surface}, {edges}",
                str(n),
                str(area),
                str(threads),
                str(fast["iterations"]),
                f"{plain['seconds']:.3f}",
                f"{fast['seconds']:.3f}",
                times(by.get("aspher"), plain["seconds"]),
                *(times(by.get(peer), fast["seconds"]) for peer in PEERS),
            ]
        )
    heads = [
        "surface, edges",
        "pixels a side",
        "contact [%]",
        "threads",
        "convolutions",
        "seconds, plain",
        "seconds, fast",
        "aspher / plain",
        *(f"{'SlipPY' if peer == 'slippy' else peer} / fast" for peer in PEERS),
    ]
    text = grid(heads, rows) + f"\n\n{found['conditions']}. CPU seconds of the solve alone."
    missing = write_blocks({"peers": text})
    sys.stdout.write(f"{len(rows)} cases; no page has: {', '.join(missing) or 'none missing'}\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
