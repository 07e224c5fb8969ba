# ruff: noqa: T201
"""Steady flow through rough gaps against `reynoldsflow`: same maps, same fluxes, seconds.

    python tests/benchmarks/peers/leakage.py --sizes 128 256 512

Needs the peer's interpreter of install.py (`make peers`); each solver runs in a process of its own
on one thread. Seconds are those of the processor, the least of some, compilation left out.
The table goes to out/bench/leakage.md, numbers to out/bench/leakage.json.
"""

from __future__ import annotations

import argparse
import json
import sys
import time
from pathlib import Path

import numpy as np
from processes import interpreter, rows

PEER = "reynoldsflow"
DEVIATIONS = (0.2, 0.7)  # rms over mean gap: without contacts, and with 8 % of them
WORST = 1e-8  # of the flux; both solve to a residual of 1e-12


def rough_gap(n, deviation, seed=1):
    """Gap of unit mean plane: Hurst 0.8 below 4 waves over the window, nothing under 8 cells."""
    k = np.hypot(np.fft.fftfreq(n, 1.0 / n)[:, None], np.fft.rfftfreq(n, 1.0 / n))
    amplitude = np.where((k > 0.0) & (k <= n / 8.0), np.maximum(k, 4.0) ** -1.8, 0.0)
    noise = np.fft.rfft2(np.random.default_rng(seed).standard_normal((n, n)))
    heights = np.fft.irfft2(amplitude * noise, s=(n, n))
    return np.maximum(1.0 + deviation * heights / heights.std(), 0.0)


def ours(solver):
    """Function that gives the flux through a gap."""
    from contactkit.lubrication import reynolds

    def flux(gap):
        size = 1.0 / len(gap)
        found = reynolds.leakage(
            gap, size, viscosity=1.0 / 12.0, pressure_drop=1.0, axis=0, solver=solver
        )
        return found.flow

    return flux


def theirs(_):
    """The same by the peer."""
    from reynoldsflow.transport import compute_total_flux, solve_fluid_problem

    def flux(gap):
        filtered, _, field = solve_fluid_problem(gap, p_west=1.0, p_east=0.0)
        return compute_total_flux(filtered, field, len(gap))[0]

    return flux


def serve(name, sizes, repeats):
    """Print flux and seconds of one solver on all gaps."""
    flux = theirs(None) if name == PEER else ours(name)
    flux(rough_gap(64, 0.2))
    flux(rough_gap(64, 0.7))
    for n in sizes:
        for deviation in DEVIATIONS:
            gap, best, found = rough_gap(n, deviation), float("inf"), 0.0
            for _ in range(repeats):
                begin = time.process_time()
                found = float(flux(gap))
                best = min(best, time.process_time() - begin)
            print(json.dumps([n, deviation, found, best]), flush=True)


def run(python, name, given):
    """Rows of a solver by size and deviation, or why there are none."""
    options = ["--repeats", given.repeats, "--sizes", *given.sizes]
    found, reason = rows(python, __file__, name, options)
    return {(n, deviation): (flux, seconds) for n, deviation, flux, seconds in found}, reason


def compared(given, found, missing):
    """Rows as `features.compared` has them, of the faster of ours."""
    made = []
    for n in given.sizes:
        for deviation in DEVIATIONS:
            ours = {name: found[name][n, deviation] for name in ("superlu", "amg") if name in found}
            flux, seconds = min(ours.values(), key=lambda one: one[1])
            row = {"what": f"leakage, rms/mean = {deviation:g}", "n": n, "seconds": seconds}
            row |= {"count": None, "error": None, "target": WORST, "peer": PEER}
            if PEER in found:
                other, theirs = found[PEER][n, deviation]
                row |= {"peer_error": None, "peer_seconds": theirs, "error": abs(other / flux - 1)}
            else:
                row["missing"] = missing or "no answer"
            made.append(row)
    return made


def main():
    """Run all, compare, write."""
    ask = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    ask.add_argument("--sizes", type=int, nargs="+", default=[128, 256, 512])
    ask.add_argument("--repeats", type=int, default=3)
    ask.add_argument("--peers", type=Path, default=Path(".venv/peers"))
    ask.add_argument("--out", type=Path, default=Path("out/bench"))
    ask.add_argument("--serve", help=argparse.SUPPRESS)
    given = ask.parse_args()
    if given.serve:
        return serve(given.serve, given.sizes, given.repeats)
    solvers = {"superlu": (sys.executable, ""), "amg": (sys.executable, "")}
    solvers[PEER] = interpreter(given.peers, PEER)
    found = {}
    for name, (python, reason) in solvers.items():
        if python:
            answers, reason = run(python, name, given)
        if reason:
            print(f"{name} left out: {reason}")
        else:
            found[name] = answers
    lines = [
        f"| cells | rms/mean | {' | '.join(f'{name} [s]' for name in found)} | fluxes differ |"
    ]
    lines.append("|---" * (len(found) + 3) + "|")
    worst = 0.0
    for n in given.sizes:
        for deviation in DEVIATIONS:
            cells = [answers[n, deviation] for answers in found.values()]
            fluxes = [flux for flux, _ in cells]
            differ = (max(fluxes) - min(fluxes)) / max(fluxes)
            worst = max(worst, differ)
            seconds = " | ".join(f"{s:.3f}" for _, s in cells)
            lines.append(f"| {n} | {deviation} | {seconds} | {differ:.1e} |")
    text = "\n".join(lines)
    given.out.mkdir(parents=True, exist_ok=True)
    (given.out / "leakage.md").write_text(text + "\n", encoding="utf-8")
    rows_of = json.dumps(compared(given, found, solvers[PEER][1]), indent=1)
    (given.out / "leakage.json").write_text(rows_of + "\n", encoding="utf-8")
    print(text)
    return int(worst > WORST)


if __name__ == "__main__":
    sys.exit(main())
