"""Put what the benchmark of large maps measured into docs/demands/large-maps.json.

``python docs/scripts/demands/large_data.py`` reads ``out/bench/large.json``, which
``tests/benchmarks/peers/large.py`` leaves. `make pages PAGES=large-maps` draws the page, too.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from peers_data import shown

ROOT = Path(__file__).parents[3]
FOUND = ROOT / "out" / "bench" / "large.json"
KEPT = ROOT / "docs" / "demands" / "large-maps.json"


def beside(rows: Iterable[Mapping[str, Any]]) -> list[dict[str, Any]]:
    """CPU seconds with set-up and memory of each solver, a row for each contact."""
    cases: dict[tuple[int, str], dict[str, Any]] = {}
    for row in rows:
        if "failed" not in row:
            made = cases.setdefault((row["n"], row["boundary"]), {})
            made[row["solver"]] = {
                "seconds": row["seconds"] + row["setup"],
                "maps": row["memory"] / (8 * row["n"] ** 2),
                "error": row["kkt"],
            }
    return [{"n": n, "boundary": edges, **by} for (n, edges), by in cases.items()]


def whole(rows: Iterable[Mapping[str, Any]]) -> list[dict[str, Any]]:
    """Wall and CPU seconds, memory in maps, and convolutions of whole runs on files."""
    found = []
    for row in rows:
        made = {name: row[name] for name in ("n", "boundary", "threads")}
        if "failed" in row:
            found.append(made | {"failed": row["failed"]})
            continue
        made |= {"wall": row["wall"], "seconds": row["seconds"], "error": row["residual"]}
        made |= {"maps": row["memory"] / (8 * row["n"] ** 2), "bytes": row["memory"]}
        found.append(made | {"convolutions": row["applications"]})
    return found


def main() -> int:
    """Read what the run left, and write the data."""
    found = json.loads(FOUND.read_text("utf-8"))
    data = {
        "about": "One run of tests/benchmarks/peers/large.py; a map is 8 bytes for each pixel.",
        "conditions": found["conditions"],
        "small": beside(found["small"]),
        "large": whole(found["large"]),
    }
    KEPT.write_text(json.dumps(shown(data), indent=1) + "\n", encoding="utf-8")
    sys.stdout.write(f"{len(data['small'])} contacts, {len(data['large'])} large maps\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
