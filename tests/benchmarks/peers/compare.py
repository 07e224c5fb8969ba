# ruff: noqa: T201
"""Press against other contact solvers: same surfaces, same measure of the answer, one run.

    python tests/benchmarks/peers/compare.py --sizes 256 512 1024 --areas 1 5 20

Each solver runs in a process of its own, and each answer is graded by one independent operator:
largest violation of a contact condition over the rms roughness. A solver's tolerance is lowered
until that is 1e-8, or it can no more. What is missing, refused or out of budget is reported.
A program that is not among them takes part by ``--program FILE``, whose ``prepare(case, threads)``
gives ``solve(tolerance)`` as those in solvers.py do.
Tables go to out/bench/contact.md, numbers to out/bench/contact.json.
"""

from __future__ import annotations

import argparse
import importlib.util
import itertools
import json
import sys
import tempfile
from pathlib import Path

from cases import BOUNDARIES, START, STEP, SURFACES
from install import names
from processes import answer, interpreter
from report import conditions, line, table, verdict

HERE = Path(__file__).parent
SERIAL = {"ContactMechanics"}  # one thread whatever is asked
OF_FLOW = {"reynoldsflow"}  # by leakage.py


def asked_for():
    """Options of the command line."""
    ask = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    ask.add_argument("--sizes", type=int, nargs="+", default=[256, 512], help="pixels a side")
    ask.add_argument("--surfaces", nargs="+", default=["selfaffine"], choices=SURFACES)
    ask.add_argument("--areas", type=int, nargs="+", default=[5], choices=[1, 5, 20])
    ask.add_argument("--boundaries", nargs="+", default=BOUNDARIES, choices=BOUNDARIES)
    ask.add_argument("--threads", type=int, nargs="+", default=[1, 2])
    ask.add_argument("--budget", type=float, default=8.0, help="CPU seconds of a solver on a case")
    ask.add_argument("--repeats", type=int, default=5, help="at least, of a short solve")
    ask.add_argument("--only", nargs="+", help="solvers to run; plain and fast are ours")
    ask.add_argument(
        "--skip", nargs="+", default=[], metavar="NAME@SIZE", help="a peer to leave out at one size"
    )
    ask.add_argument("--program", type=Path, metavar="FILE", help="one more solver, in Python")
    ask.add_argument("--python", default=sys.executable, help="interpreter that runs it")
    ask.add_argument("--peers", type=Path, default=Path(".venv/peers"))
    ask.add_argument("--out", type=Path, default=Path("out/bench"))
    return ask.parse_args()


def solvers(given):
    """Interpreter of each solver, and why the others have none."""
    found, missing = {"plain": sys.executable}, {}
    has_fast = all(importlib.util.find_spec(name) for name in ("numba", "ducc0"))
    if has_fast:
        found["fast"] = sys.executable
    else:
        missing["fast"] = "numba or ducc0 is not installed"
    for name in (name for name in names() if name not in OF_FLOW):
        python, reason = interpreter(given.peers, name)
        if python:
            found[name] = python
        else:
            missing[name] = reason
    if given.program:
        found[given.program.stem] = given.python
    if given.only:
        found = {name: python for name, python in found.items() if name in given.only}
    return found, missing


def run(python, job, patience=1.0):
    """What the process prints, or ``{"failed": reason}``."""
    limit = patience * (4.0 * job["budget"] + 120.0)  # of wall time: the machine may be shared
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "job.json"
        path.write_text(json.dumps(job), encoding="utf-8")
        text, reason = answer([python, HERE / "run.py", path], job["threads"], limit)
    return {"failed": reason} if reason else json.loads(text.strip().splitlines()[-1])


def contest(given, found):
    """Yield a row for each solver on each case, smaller maps first."""
    used = {}
    cases = itertools.product(
        given.sizes, given.surfaces, given.boundaries, given.areas, given.threads
    )
    for n, surface, boundary, area, threads in cases:
        for name, python in found.items():
            key = (name, surface, boundary, area, threads)
            row = {"solver": name, "n": n, "surface": surface, "boundary": boundary}
            row |= {"area": area, "threads": threads}
            size, seconds, tolerance = used.get(key, (n, 0.0, START))
            if f"{name}@{n}" in given.skip:
                row["failed"] = "left out by --skip"
            elif name in SERIAL and threads > 1 and 1 in given.threads:
                row["failed"] = "runs on one thread only"
            elif seconds * (n / size) ** 2 > given.budget:
                row["failed"] = f"out of budget: {seconds:.0f} s at {size}"
            else:
                job = row | {"budget": given.budget, "repeats": given.repeats}
                if given.program and name == given.program.stem:
                    job["program"] = str(given.program)
                # A step looser than the smaller map took: no long solves in vain.
                row |= run(python, job | {"tolerance": min(START, tolerance / STEP)})
                if "failed" in row:
                    used[key] = (n, float("inf") if "not done" in row["failed"] else 0.0, START)
                else:
                    used[key] = (n, row["seconds"], row["tolerance"])
            yield row


def write(given, before, missing, rows):
    """Keep what is there so far, for a run may be stopped; return the tables."""
    left_out = [f"- {name}: left out: {reason}" for name, reason in missing.items()]
    text = "\n\n".join(
        part
        for part in (
            f"Before: {before}  \nAfter: {conditions()}",
            "\n".join(left_out),
            table(rows),
            verdict(rows),
        )
        if part
    )
    given.out.mkdir(parents=True, exist_ok=True)
    (given.out / "contact.md").write_text(text + "\n", encoding="utf-8")
    kept = {"conditions": before, "missing": missing, "contest": rows}
    (given.out / "contact.json").write_text(json.dumps(kept, indent=1) + "\n", encoding="utf-8")
    return text


def main():
    """Run, print, write."""
    given = asked_for()
    found, missing = solvers(given)
    before = conditions()
    print(before)
    for name, reason in missing.items():
        print(f"{name}: left out: {reason}")
    rows, text = [], ""
    for row in contest(given, found):
        rows.append(row)
        print(line(row), flush=True)
        text = write(given, before, missing, rows)
    print(f"\n{text}\n\nwritten to {given.out}")


if __name__ == "__main__":
    sys.exit(main())
