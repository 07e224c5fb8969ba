# ruff: noqa: T201
"""Large maps: seconds and memory of contactkit up to 8192 x 8192 pixels, and beside aspher.

    python tests/benchmarks/peers/large.py --minutes 10

On an idle machine with two cores and 24 GB, the extra `fast` and the peer of install.py. First
rough contacts of 256 to 2048 pixels a side by `compare.py`, one thread, set-up counted. Then what a
user does with a measured map: read the file, plan, solve, keep the result. Every run is a process
of its own, whose memory is the largest resident size over that of the imports. What there is no
time for is named. Partial results are kept in out/bench/large.json, which
`make pages PAGES=large-maps` shows.
"""

from __future__ import annotations

import argparse
import json
import sys
import tempfile
import time
import warnings
from pathlib import Path
from types import SimpleNamespace

import numpy as np
from cases import case, violation
from compare import contest
from processes import answer, interpreter
from report import conditions
from timing import forget_peak, peak_memory, timed

SIDE = 1e-6  # of the window [m]
GROWTH = 4.6  # of the seconds from a map to one of twice the side, to foresee them
VERIFIED = 2048  # largest map that the independent operator has room for


def solve(path, n, boundary, threads):
    """Seconds, memory and residual of one run on a file, after a smaller one that compiles.

    Of 1024 pixels a side, from which columns are transformed in strips.
    """
    import contactkit as ck

    solid = ck.Material(young_modulus=1e11, poisson_ratio=0.0)
    given = case("selfaffine", 1024, "periodic", 5)

    def run(heights):
        scene = ck.ContactScene(
            interface=ck.Interface(
                lower=ck.Body(solid=solid),
                upper=ck.Body(surface=heights),
            ),
            window=ck.Window(periodic=boundary == "periodic"),
            loading=ck.Pressing(pressure=given.load * 1e11),
            effects=(ck.HalfSpace(),),
        )
        return ck.solve(ck.plan(scene, ck.Accuracy(threads=threads)))

    warnings.simplefilter("ignore", ck.ValidityWarning)
    run(ck.Heights(heights=given.heights * SIDE, pixel_size=SIDE / 1024))
    map_file = ck.Measured(path=path, pixel_size=SIDE / n, unit="m", detrend="none")
    forget_peak()
    before = peak_memory()
    found, seconds, wall = timed(run, map_file)
    row = {"seconds": seconds, "wall": wall, "memory": peak_memory() - before}
    row |= {"applications": found.work.n_operator_applications, "residual": found.residual}
    if n <= VERIFIED and boundary == "periodic":
        row["kkt"], _ = violation(found.pressure / 1e11, case("selfaffine", n, "periodic", 5))
    return row


def small(given):
    """Rows of contactkit with and without its extra, and of aspher."""
    found = {"plain": sys.executable, "fast": sys.executable}
    python, reason = interpreter(given.peers, "aspher")
    if python:
        found["aspher"] = python
    else:
        print(f"aspher left out: {reason}")
    asked = SimpleNamespace(
        sizes=given.small,
        surfaces=["selfaffine"],
        boundaries=["periodic", "free"],
        areas=[5],
        program=None,
        threads=[1],
        skip=[],
        budget=given.budget,
        repeats=5,
    )
    return contest(asked, found)


def large(given, begun):
    """Rows of whole runs on files, smaller maps first."""
    last = {}
    for n in given.sizes:
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "map.npy"
            for boundary in ("periodic", "free"):
                for threads in given.threads:
                    row = {"n": n, "boundary": boundary, "threads": threads}
                    need = GROWTH * last.get((boundary, threads), 0.0)
                    left = 60.0 * given.minutes - (time.monotonic() - begun)
                    if need > left:
                        yield row | {"failed": f"left out: {need:.0f} s foreseen, {left:.0f} left"}
                        continue
                    if not path.exists():
                        command = [sys.executable, __file__, "--make", path, "--sizes", n]
                        answer(command)
                    options = ["--serve", path, "--sizes", n, "--threads", threads]
                    command = [sys.executable, __file__, *options, "--boundary", boundary]
                    text, reason = answer(command, threads, max(left, 60.0))
                    row |= {"failed": reason} if reason else json.loads(text.splitlines()[-1])
                    last[boundary, threads] = row.get("wall", float("inf"))
                    yield row


def main():
    """Run, print, keep."""
    ask = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    ask.add_argument("--minutes", type=float, default=10.0, help="of the whole run")
    ask.add_argument("--small", type=int, nargs="*", default=[256, 512, 1024, 2048])
    ask.add_argument("--sizes", type=int, nargs="*", default=[2048, 4096, 8192])
    ask.add_argument("--threads", type=int, nargs="+", default=[1, 2])
    ask.add_argument("--budget", type=float, default=30.0, help="CPU seconds of a small case")
    ask.add_argument("--peers", type=Path, default=Path(".venv/peers"))
    ask.add_argument("--out", type=Path, default=Path("out/bench"))
    ask.add_argument("--serve", help=argparse.SUPPRESS)
    ask.add_argument("--make", help=argparse.SUPPRESS)
    ask.add_argument("--boundary", help=argparse.SUPPRESS)
    given = ask.parse_args()
    if given.make:
        np.save(given.make, case("selfaffine", given.sizes[0], "periodic", 5).heights * SIDE)
        return
    if given.serve:
        print(json.dumps(solve(given.serve, given.sizes[0], given.boundary, given.threads[0])))
        return
    begun = time.monotonic()
    kept = {"conditions": conditions(), "small": [], "large": []}
    given.out.mkdir(parents=True, exist_ok=True)
    for name, found in (("small", small(given)), ("large", large(given, begun))):
        for row in found:
            kept[name].append(row)
            print(json.dumps(row), flush=True)
            text = json.dumps(kept, indent=1) + "\n"
            (given.out / "large.json").write_text(text, encoding="utf-8")
    print(f"{(time.monotonic() - begun) / 60.0:.1f} minutes")


if __name__ == "__main__":
    main()
