# ruff: noqa: T201
"""Rough contact with an exponential attraction against `tamaas`: same maps, same measure, seconds.

    python tests/benchmarks/peers/adhesion.py --sizes 64 128

Needs the peer's interpreter of install.py (`make peers`); each solver runs in a process of its own
on one thread. Periodic, self-affine, a given mean pressure. A solver's tolerance is lowered until
an independent operator finds the contact conditions met to 1e-6 of the rms roughness. Seconds are
those of the processor, the least of some, compilation left out.
The table goes to out/bench/adhesion.md, numbers to out/bench/adhesion.json.
"""

from __future__ import annotations

import argparse
import json
import sys
import time
from pathlib import Path

import numpy as np
from cases import LOADS, RMS_SLOPE, half_space, rough
from processes import interpreter, rows

PEER = "tamaas"
TARGET = 1e-6
WORKS = (2e-6, 2e-5)  # work of adhesion over modulus and window: hardly felt, and felt
RANGE = 0.04  # of the attraction, over the rms height: the grid resolves it
TOLERANCES = (1e-6, 1e-7, 1e-8, 1e-9, 1e-10)
LOAD = LOADS["selfaffine"][5] * RMS_SLOPE


def mixed(tension, pressure, heights):
    """Largest violation of the conditions of an adhesive contact over the rms roughness."""
    n = len(heights)
    symbol = half_space((n, n), (1.0 / n, 1.0 / n))
    gap = np.fft.irfft2(np.fft.rfft2(pressure) * symbol, s=(n, n)) - heights
    touching = np.maximum(pressure, 0.0)  # a pressure above zero is that of closed gaps
    gap -= np.sum(touching * gap) / np.sum(touching)
    own = float(np.fft.irfft2(symbol, s=(n, n))[0, 0])
    repulsion = pressure + tension(np.maximum(gap, 0.0))
    return float(np.abs(np.minimum(gap, own * repulsion)).max() / heights.std())


def ours(heights, work, length):
    """Function of the tolerance that gives pressure and iterations."""
    import contactkit as ck

    n, size, modulus = len(heights), 1e-6, 1e9
    law = ck.ExponentialAttraction(work_of_adhesion=work * modulus * size, range=length * size)
    solid = ck.Material(young_modulus=modulus, poisson_ratio=0.0)
    surface = ck.Heights(heights=heights * size, pixel_size=size / n)
    scene = ck.ContactScene(
        interface=ck.Interface(lower=ck.Body(solid=solid), upper=ck.Body(surface=surface)),
        window=ck.Window(periodic=True),
        loading=ck.Pressing(pressure=LOAD * modulus),
        effects=(ck.HalfSpace(), ck.Adhesion(law=law)),
    )

    def solve(tolerance):
        found = ck.solve(ck.plan(scene, ck.Accuracy(rtol=tolerance)))
        return found.pressure / modulus, found.work.n_operator_applications

    return solve


def theirs(heights, work, length):
    """The same by the peer: conjugate gradients in the gap."""
    import tamaas as tm

    tm.set_log_level(tm.LogLevel.error)
    n = len(heights)

    def solve(tolerance):
        model = tm.Model(tm.model_type.basic_2d, [1.0, 1.0], [n, n])
        model.E, model.nu = 1.0, 0.0
        law = tm.ExponentialAdhesionFunctional(heights)
        law.parameters = {"rho": length, "surface_energy": work}
        kind = tm.PolonskyKeerRey
        solver = kind(model, heights, tolerance, kind.gap, kind.pressure)
        solver.max_iter = 100_000
        solver.addFunctionalTerm(law)
        solver.solve(LOAD)
        return np.array(model.traction).reshape(n, n), 0

    return solve


def serve(name, sizes, budget):
    """Print what one solver needs on all cases."""
    prepare = theirs if name == PEER else ours
    prepare(rough("selfaffine", 32), 1e-5, 1e-3)(1e-6)  # loads libraries and compiled code
    for n in sizes:
        heights = rough("selfaffine", n)
        length = RANGE * float(heights.std())
        for work in WORKS:
            solve = prepare(heights, work, length)

            def tension(gap, work=work, length=length):
                return work / length * np.exp(-gap / length)

            for tolerance in TOLERANCES:
                best, used = float("inf"), 0.0
                while used == 0.0 or (used < 0.1 * budget and used < 3.0):
                    begun = time.process_time()
                    pressure, count = solve(tolerance)
                    seconds = time.process_time() - begun
                    best, used = min(best, seconds), used + seconds
                error = mixed(tension, pressure, heights)
                if error <= TARGET or used > budget:
                    break
            print(json.dumps([n, work, error, best, count, float(pressure.min())]), flush=True)


def run(python, name, given):
    """Rows of a solver by size and work of adhesion, or why there are none."""
    options = ["--budget", given.budget, "--sizes", *given.sizes]
    found, reason = rows(python, __file__, name, options)
    return {(n, work): rest for n, work, *rest in found}, reason


def table(given, mine, peers):
    """Ratios of seconds, with what each reached."""
    lines = [
        "| pixels a side | w/(E* L) | ours [s] | convolutions | error | tamaas [s] | error "
        "| tamaas over ours |",
        "|---|---|---|---|---|---|---|---|",
    ]
    for n in given.sizes:
        for work in WORKS:
            error, seconds, count, _ = mine[n, work]
            cells = [f"{n}", f"{work:g}", f"{seconds:.3f}", f"{count}", f"{error:.0e}"]
            if (n, work) in peers:
                other, theirs_seconds, *_ = peers[n, work]
                over = "" if other <= TARGET else ">"
                cells += [f"{theirs_seconds:.2f}", f"{other:.0e}"]
                cells.append(f"{over}{theirs_seconds / seconds:.0f}")
            else:
                cells += ["-", "-", "-"]
            lines.append("| " + " | ".join(cells) + " |")
    return "\n".join(lines)


def compared(mine, peers, missing):
    """Rows as `features.compared` has them."""
    found = []
    for (n, work), (error, seconds, count, _) in mine.items():
        row = {"what": f"adhesion, w/(E* L) = {work:g}", "n": n, "seconds": seconds}
        row |= {"count": count, "error": error, "target": TARGET, "peer": PEER}
        if (n, work) in peers:
            row |= {"peer_error": peers[n, work][0], "peer_seconds": peers[n, work][1]}
        else:
            row["missing"] = missing or "no answer"
        found.append(row)
    return found


def main():
    """Run both, compare, write."""
    ask = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    ask.add_argument("--sizes", type=int, nargs="+", default=[64, 128])
    ask.add_argument("--budget", type=float, default=60.0, help="CPU seconds of a solver on a case")
    ask.add_argument("--peers", type=Path, default=Path(".venv/peers"))
    ask.add_argument("--out", type=Path, default=Path("out/bench"))
    ask.add_argument("--serve", help=argparse.SUPPRESS)
    given = ask.parse_args()
    if given.serve:
        return serve(given.serve, given.sizes, given.budget)
    peers, (python, reason) = {}, interpreter(given.peers, PEER)
    if python:
        peers, reason = run(python, PEER, given)
    missing = reason
    if reason:
        print(f"{PEER} left out: {reason}")
    mine, reason = run(sys.executable, "contactkit", given)
    if reason:
        print(f"contactkit failed: {reason}")
        return 1
    text = table(given, mine, peers)
    given.out.mkdir(parents=True, exist_ok=True)
    (given.out / "adhesion.md").write_text(text + "\n", encoding="utf-8")
    found = json.dumps(compared(mine, peers, missing), indent=1)
    (given.out / "adhesion.json").write_text(found + "\n", encoding="utf-8")
    print(text)
    return int(max(error for error, *_ in mine.values()) > TARGET)


if __name__ == "__main__":
    sys.exit(main())
