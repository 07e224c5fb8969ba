# ruff: noqa: T201
"""Contact problems for a program in any language, and marks for its answers.

    python tests/benchmarks/peers/exchange.py write problems
    python tests/benchmarks/peers/exchange.py grade problems answers

``write`` makes ``problems.json`` and a map of heights ``NAME.bin`` for each problem: doubles,
little end first, row by row. ``grade`` reads pressures ``NAME.bin`` of the same layout (or
``NAME.npy``) and marks them by an operator of its own, as contactkit and all others are marked.
Needs numpy alone.
"""

from __future__ import annotations

import argparse
import json
import sys
from pathlib import Path

import numpy as np
from cases import BOUNDARIES, TARGET, Case, case, violation

SIZES = (128, 256, 512)
AREA = 5  # per cent of the window in contact
BOUND = 0.06  # of one problem more, over the modulus: a third of the pixels in contact are at it
ABOUT = (
    "A rigid rough body on an elastic half-space, both without friction. Lengths over the side of "
    "the window, pressures over the contact modulus E/(1 - nu^2), heights positive towards the "
    "half-space. Mean pressure is the load over the area of the window."
)


def problems():
    """Name, case and bound of the pressure of each problem."""
    for n in SIZES:
        for boundary in BOUNDARIES:
            yield f"{boundary}-{n}", case("selfaffine", n, boundary, AREA), np.inf
    yield "periodic-bounded-256", case("selfaffine", 256, "periodic", AREA), BOUND


def write(folder):
    """Heights of every problem, and what is asked."""
    folder.mkdir(parents=True, exist_ok=True)
    asked = []
    for name, given, bound in problems():
        np.ascontiguousarray(given.heights, dtype="<f8").tofile(folder / f"{name}.bin")
        asked.append(
            {
                "name": name,
                "pixels": given.heights.shape[0],
                "periodic": given.periodic,
                "mean_pressure": given.load,
                "largest_pressure": None if np.isinf(bound) else bound,
                "rms_height": given.scale,
            }
        )
    text = json.dumps({"about": ABOUT, "problems": asked}, indent=1)
    (folder / "problems.json").write_text(text + "\n", encoding="utf-8")
    return f"{len(asked)} problems written to {folder}"


def pressure_of(folder, name, n):
    """Map of pressures that a program left, or what is wrong with it."""
    raw, packed = folder / f"{name}.bin", folder / f"{name}.npy"
    if not raw.exists() and not packed.exists():
        return "no answer"
    found = np.fromfile(raw, dtype="<f8") if raw.exists() else np.load(packed)
    if found.size != n * n:
        half = ", as of half the bytes of a double" if 2 * found.size == n * n else ""
        return f"{found.size} pressures{half}, expected {n} x {n}"
    if not np.isfinite(found).all():
        return "a pressure is not finite"
    return found.reshape(n, n)


def grade(folder, answers):
    """Table of marks."""
    if not (folder / "problems.json").is_file():
        sys.exit(f"{folder} has no problems.json: write it first, by exchange.py write {folder}")
    asked = json.loads((folder / "problems.json").read_text(encoding="utf-8"))["problems"]
    head = f"{'problem':22} {'violation':>10} {'load':>8} {'contact':>9}"
    lines = [head]
    for one in asked:
        n = one["pixels"]
        heights = np.fromfile(folder / f"{one['name']}.bin", dtype="<f8").reshape(n, n)
        given = Case(heights, one["mean_pressure"], one["periodic"], one["rms_height"])
        pressure = pressure_of(answers, one["name"], n)
        if isinstance(pressure, str):
            lines.append(f"{one['name']:22} {pressure}")
            continue
        bound = one["largest_pressure"] or np.inf
        worst, load = violation(pressure, given, cap=bound)
        excess = max(float(pressure.max()) / bound - 1.0, 0.0)
        mark = "good" if max(worst, load, excess) <= TARGET else ""
        area = np.count_nonzero(pressure > 0.0) / n**2
        lines.append(f"{one['name']:22} {worst:10.1e} {max(load, excess):8.0e} {area:9.3%} {mark}")
    lines.append(
        "violation: largest penetration or gap at a loaded pixel, over the rms height; load: error "
        f"of load, sign and bound; good: both at most {TARGET:.0e}"
    )
    return "\n".join(lines)


def main():
    """What the command line asks for."""
    ask = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    does = ask.add_subparsers(dest="does", required=True)
    does.add_parser("write").add_argument("folder", type=Path)
    marks = does.add_parser("grade")
    marks.add_argument("folder", type=Path)
    marks.add_argument("answers", type=Path)
    given = ask.parse_args()
    print(write(given.folder) if given.does == "write" else grade(given.folder, given.answers))


if __name__ == "__main__":
    main()
