"""Put what ``make bench`` measured against other programs into docs/demands/peers.json.

``python docs/scripts/demands/peers_data.py`` reads what one run of the benchmark leaves in
``out/bench``: contact.json, features.json, adhesion.json and leakage.json. `make pages PAGES=peers`
draws the page, too.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parents[3]
FOUND, KEPT = ROOT / "out" / "bench", ROOT / "docs" / "demands" / "peers.json"
NAMES = {"slippy": "SlipPY"}  # as their authors write them
GOOD = 1.5e-8  # maximum violation, over the rms height, of an accepted solution


def _peer(seconds: float, error: float | None, is_good: bool) -> dict[str, Any]:
    return {"seconds": seconds, "error": error, "is_good": is_good}


def contacts(found: Iterable[Mapping[str, Any]]) -> list[dict[str, Any]]:
    """A row for each contact that both paths of contactkit have solved; seconds with set-up."""
    cases: dict[tuple[Any, ...], dict[str, Any]] = {}
    for row in found:
        key = tuple(row[name] for name in ("n", "boundary", "area"))
        cases.setdefault(key, {})[row["solver"]] = row
    rows = []
    for (n, edges, area), by in cases.items():
        some = {k: v for k, v in by.items() if "failed" not in v}
        if not {"plain", "fast"} <= set(some):
            continue
        whole = {name: row["seconds"] + row["setup"] for name, row in some.items()}
        peers = {
            NAMES.get(name, name): _peer(whole[name], row["kkt"], row["kkt"] <= GOOD)
            for name, row in some.items()
            if name not in ("plain", "fast")
        }
        own = some["fast"]
        made = {"what": f"rough contact, {edges}, {area} % in contact", "n": n}
        made |= {"convolutions": own["iterations"], "seconds": whole["fast"], "error": own["kkt"]}
        rows.append(made | {"plain": whole["plain"], "peers": peers})
    return rows


def features(found: Iterable[Mapping[str, Any]]) -> list[dict[str, Any]]:
    """Rows of the other comparisons that have an answer of a peer; prepared solves."""
    rows = []
    for row in found:
        if "missing" in row:
            continue
        target, error = row.get("target", 0.0), row["peer_error"]
        is_good = not (error is not None and error > 1.5 * target > 0.0)
        made = {key: row[key] for key in ("what", "n", "seconds", "error")}
        made |= {"convolutions": row["count"], "plain": None}
        name = NAMES.get(row["peer"], row["peer"])
        rows.append(made | {"peers": {name: _peer(row["peer_seconds"], error, is_good)}})
    return rows


def shown(value: Any) -> Any:
    """Numbers to three digits."""
    if isinstance(value, dict):
        return {key: shown(one) for key, one in value.items()}
    if isinstance(value, list):
        return [shown(one) for one in value]
    return float(f"{value:.3g}") if isinstance(value, float) else value


def main() -> int:
    """Read what the run left, and write the data."""
    single = json.loads((FOUND / "contact.json").read_text("utf-8"))
    more = [
        row
        for name in ("features", "adhesion", "leakage")
        for row in json.loads((FOUND / f"{name}.json").read_text("utf-8"))
    ]
    absent = [f"{name} was left out: {why}." for name, why in single["missing"].items()]
    data = {
        "about": "One run of make bench (tests/benchmarks/peers): CPU seconds and errors.",
        "conditions": single["conditions"],
        "left_out": absent,
        "rows": contacts(single["contest"]) + features(more),
    }
    KEPT.write_text(json.dumps(shown(data), indent=1) + "\n", encoding="utf-8")
    sys.stdout.write(f"{len(data['rows'])} problems\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
