"""One solver on one case, in its own interpreter: ``python run.py JOB.json``.

Prints one line of JSON. Times are the best of several; memory is the largest resident size of the
first solve and its preparation, less what was resident before, the heights included.
"""

from __future__ import annotations

import json
import sys
from importlib import metadata
from pathlib import Path

from cases import STEP, TARGET, case, violation
from solvers import named
from timing import forget_peak, goes_on, peak_memory, timed

WARM_UP = 128  # pixels a side, nested grids included: loads libraries and compiled code first


def run(job):
    """Lower the tolerance until the answer is good enough, then time that tolerance."""
    prepare = named(job["solver"], job.get("program"))
    small = case(job["surface"], WARM_UP, job["boundary"], job["area"])
    _, first_use, _ = timed(lambda: prepare(small, job["threads"])(1e-4))
    given = case(job["surface"], job["n"], job["boundary"], job["area"])
    forget_peak()
    before = peak_memory()
    solve, setup, setup_wall = timed(prepare, given, job["threads"])
    tolerance, used, memory = job["tolerance"], 0.0, None
    while True:
        (pressure, count), seconds, wall = timed(solve, tolerance)
        used += seconds
        memory = peak_memory() - before if memory is None else memory
        kkt, load_error = violation(pressure, given)
        if kkt <= TARGET or tolerance < 1e-4 * TARGET or used > job["budget"]:
            break
        tolerance *= STEP
    count_again, used_again = 0, 0.0
    while goes_on(count_again, used_again, job):
        _, again, again_wall = timed(solve, tolerance)
        count_again, used_again = count_again + 1, used_again + again
        seconds, wall = min(seconds, again), min(wall, again_wall)
    return {
        "seconds": seconds,
        "wall": wall,
        "setup": setup,
        "setup_wall": setup_wall,
        "first_use": first_use,
        "iterations": count,
        "kkt": kkt,
        "load_error": load_error,
        "tolerance": tolerance,
        "memory": memory,
        "used": used + used_again,
        "contact": float((pressure > 0.0).mean()),
        "checksum": float((given.heights**3).sum()),
        "version": None if job.get("program") else version(job["solver"]),
    }


def version(solver):
    """Release of the solver."""
    return metadata.version("contactkit" if solver in ("plain", "fast") else solver)


if __name__ == "__main__":
    asked = json.loads(Path(sys.argv[1]).read_text(encoding="utf-8"))
    print(json.dumps(run(asked)))  # noqa: T201
