"""Put what ``make bench`` measured against other programs into docs/demands/peers.json.

``python docs/scripts/demands/peers_data.py`` reads what the benchmark leaves in ``out/bench``:
single contacts from contact.json, the other comparisons from features.json, adhesion.json and
leakage.json. What was not run keeps its old rows. `make pages PAGES=peers` draws the page, too.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parents[3]
FOUND, KEPT = ROOT / "out" / "bench", ROOT / "docs" / "demands" / "peers.json"
NAMES = {"aspher": "aspher", "slippy": "SlipPY", "tamaas": "tamaas"} | {
    "ContactMechanics": "ContactMechanics"
}
GOOD = 1.5e-8  # maximum violation, over the rms height, of an accepted solution
CASE = ("surface", "n", "boundary", "area", "threads")


def contacts(found: Mapping[str, Any]) -> list[dict[str, Any]]:
    """A row for each contact that both paths of contactkit have solved."""
    cases: dict[tuple[Any, ...], dict[str, Any]] = {}
    for row in found["contest"]:
        cases.setdefault(tuple(row.get(key) for key in CASE), {})[row["solver"]] = row
    rows = []
    for (surface, n, edges, area, threads), by in cases.items():
        if "plain" not in by or "fast" not in by:
            continue
        good = {name: by[name] for name in NAMES if by.get(name, {}).get("kkt", 1.0) <= GOOD}
        seconds = {path: by[path]["seconds"] for path in ("plain", "fast")}
        case = {"surface": surface, "edges": edges, "n": n, "area": area, "threads": threads}
        peers = {NAMES[name]: row["seconds"] for name, row in good.items()}
        rows.append(case | {"convolutions": by["fast"]["iterations"]} | seconds | {"peers": peers})
    return rows


def features(found: list[Mapping[str, Any]]) -> list[dict[str, Any]]:
    """Rows of the other comparisons that have an answer of a peer."""
    rows = []
    for row in found:
        if "missing" in row:
            continue
        target, error = row.get("target", 0.0), row["peer_error"] or 0.0
        same = ("what", "n", "seconds", "error", "peer", "peer_seconds", "peer_error")
        made = {key: row[key] for key in same}
        rows.append(made | {"convolutions": row["count"], "is_bound": error > target > 0.0})
    return rows


def main() -> int:
    """Read what is there, and write the data."""
    data = json.loads(KEPT.read_text("utf-8"))
    single = FOUND / "contact.json"
    if single.exists():
        found = json.loads(single.read_text("utf-8"))
        data["contacts"] = {"conditions": found["conditions"], "rows": contacts(found)}
    others = [FOUND / f"{name}.json" for name in ("features", "adhesion", "leakage")]
    more = [row for path in others if path.exists() for row in json.loads(path.read_text("utf-8"))]
    if more:
        data["features"]["rows"] = features(more)
    KEPT.write_text(json.dumps(data, indent=1) + "\n", encoding="utf-8")
    sys.stdout.write(f"{len(data['contacts']['rows'])} contacts, {len(more)} others measured\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
