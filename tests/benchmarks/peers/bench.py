# ruff: noqa: T201
"""All comparisons with other programs in one run: ``python bench.py --peers FOLDER``, `make bench`.

Rough contacts, load curves, loading histories, partial slip, one-axis windows, sheets on a base,
adhesion and leakage, one thread: some minutes. One table sums them up, in
out/bench/summary.md; beside it are the tables of each comparison. What is left out is named with
the reason. `compare.py`, `features.py`, `adhesion.py` and `leakage.py` take larger cases.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
import time
from pathlib import Path

from report import conditions, goal, good, grouped, is_ours

HERE = Path(__file__).parent
RUNS = {  # a script and what it is asked in the short run
    "compare": ["--threads", "1", "--sizes", "256", "512", "--budget", "12"],
    "features": ["--sizes", "128", "256", "--budget", "15"],
    "adhesion": ["--sizes", "64", "128", "--budget", "10"],
    "leakage": ["--sizes", "128", "256"],
}
WRITTEN = {"compare": "contact"}  # names of their files, if others


def contacts(kept):
    """Rows of the contest as the other comparisons have them: our fastest, the best peer."""
    found = []
    for some in grouped(kept["contest"]).values():
        ours = [row for row in some if is_ours(row)]
        theirs = [row for row in some if row["solver"] not in ("plain", "fast")]
        there = [row for row in theirs if "failed" not in row]
        if not ours:
            continue
        mine = min(ours, key=lambda row: row["seconds"])
        row = {"what": f"rough contact, {mine['boundary']}, {mine['area']} %", "n": mine["n"]}
        row |= {"seconds": mine["seconds"], "count": mine["iterations"], "error": mine["kkt"]}
        if there:
            best = min([r for r in there if good(r)] or there, key=lambda row: row["seconds"])
            row |= {"peer": best["solver"], "peer_seconds": best["seconds"]}
            row |= {"peer_error": best["kkt"], "is_good": good(best)}
            row["goal"] = goal(mine["solver"], mine["n"])
        else:
            row |= {"peer": "all peers", "missing": "none has an answer"}
        found.append(row)
    return found


def summary(found):
    """One table: what it is, what it takes, and the peer's seconds over ours."""
    lines = [
        "| what | pixels a side | convolutions | CPU s | error | peer | its CPU s | its error "
        "| its seconds over ours | goal |",
        "|---|---|---|---|---|---|---|---|---|---|",
    ]
    for row in found:
        count = "-" if row["count"] is None else f"{row['count']}"
        cells = [row["what"], f"{row['n']}", count, f"{row['seconds']:.3f}"]
        cells += [_error(row["error"]), row["peer"]]
        if "missing" in row:
            cells += ["-", "-", f"left out: {row['missing']}", "-"]
        else:
            is_good = row.get("is_good", (row["peer_error"] or 0.0) <= row.get("target", 0.0))
            over = row["peer_seconds"] / row["seconds"]
            cells += [f"{row['peer_seconds']:.3f}", _error(row["peer_error"])]
            cells.append(f"{'' if is_good else '> '}{over:.1f}")
            aim = row.get("goal")
            missed = aim is not None and over < aim
            cells.append("-" if aim is None else f"{aim:g}{' missed' * missed}")
        lines.append("| " + " | ".join(cells) + " |")
    return "\n".join(lines)


def _error(value):
    return "-" if value is None else f"{value:.0e}"


def main():
    """Run each comparison, then sum up what they wrote."""
    ask = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    ask.add_argument("--peers", type=Path, default=Path(".venv/peers"))
    ask.add_argument("--out", type=Path, default=Path("out/bench"))
    ask.add_argument("--only", nargs="+", choices=list(RUNS), default=list(RUNS))
    given = ask.parse_args()
    before, begun, found, failed = conditions(), time.monotonic(), [], []
    for name in given.only:
        print(f"\n=== {name}", flush=True)
        path = given.out / f"{WRITTEN.get(name, name)}.json"
        path.unlink(missing_ok=True)  # that of an earlier run
        where = ["--peers", str(given.peers), "--out", str(given.out)]
        code = subprocess.call([sys.executable, str(HERE / f"{name}.py"), *RUNS[name], *where])
        failed += [name] if code else []
        if path.exists():
            kept = json.loads(path.read_text(encoding="utf-8"))
            found += contacts(kept) if name == "compare" else kept
    refused = sorted(given.peers.glob("*.refused"))
    named = [
        f"- {p.stem} is not installed: {p.read_text(encoding='utf-8').strip()}" for p in refused
    ]
    minutes = (time.monotonic() - begun) / 60.0
    head = f"{before}; {minutes:.0f} minutes"
    text = "\n\n".join(part for part in (head, "\n".join(named), summary(found)) if part)
    (given.out / "summary.md").write_text(text + "\n", encoding="utf-8")
    print(f"\n{text}")
    if failed:
        print(f"missed their own goal or failed: {', '.join(failed)}")
    return int(bool(failed))


if __name__ == "__main__":
    sys.exit(main())
