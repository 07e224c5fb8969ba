# ruff: noqa: T201
"""Press against other contact solvers: same surfaces, same measure of the answer, one run.

    python tests/benchmarks/contact_peers.py --sizes 256 512 --peer aspher=/path/to/python ...

Every peer runs in its own interpreter and is graded here, by one independent operator, to the
largest violation of a contact condition over the rms roughness. A peer's own tolerance is lowered
until that is 1e-8 or it can no more. Peers that are not given or not installed are named and
skipped. Times are CPU seconds of the solve alone, the best of several.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
import scipy.fft

PEERS = ("aspher", "tamaas")
RADIUS, HERTZ = 10.0, {1: 0.15, 5: 0.26, 20: 0.41}  # ball under a free map, contact radii
LOADS = {1: 4.0e-4, 5: 2.25e-3, 20: 1.05e-2}  # mean pressure over E* for about so many per cent

RUNNER = r"""
import json, sys, time, numpy as np
job = json.load(open(sys.argv[1])); h = np.load(job["heights"]); n = h.shape[0]
def aspher(tol):
    import aspher as a
    back = "periodic" if job["periodic"] else "fft"
    r = a.solve_nested(grid_size=n, gap=(h.max() - h).ravel(), p_nominal=job["load"], tol=tol,
                       backend=back)
    return np.asarray(r.pressure).reshape(n, n), int(r.iterations)
def tamaas(tol):
    import tamaas as tm
    m = tm.Model(tm.model_type.basic_2d, [1.0, 1.0], [n, n]); m.E, m.nu = 1.0, 0.0
    s = tm.PolonskyKeerRey(m, h, tol); s.max_iter = 20000
    if not job["periodic"]:
        tm.ModelFactory.registerNonPeriodic(m, "dcfft"); s.setIntegralOperator("dcfft")
    s.solve(job["load"])
    return np.asarray(m.traction).reshape(n, n), -1
best, out = 1e99, None
for _ in range(job["repeats"]):
    t = time.process_time(); p, count = globals()[job["peer"]](job["tol"])
    best = min(best, time.process_time() - t)
np.save(job["out"], p); print(json.dumps({"seconds": best, "iterations": count}))
"""


def half_space(shape, pixel_size):
    """Periodic symbol of a half-space of unit contact modulus."""
    qy = 2.0 * np.pi * np.fft.fftfreq(shape[0], pixel_size[0])[:, None]
    q = np.hypot(qy, 2.0 * np.pi * np.fft.rfftfreq(shape[1], pixel_size[1]))
    return np.divide(2.0, q, out=np.zeros_like(q), where=q > 0.0)


def free_half_space(shape, pixel_size):
    """Symbol of the doubled map, by Love's rectangle."""
    (ny, nx), (dy, dx) = shape, pixel_size
    y = ((np.arange(ny + 1) - 0.5) * dy)[:, None]
    x = (np.arange(nx + 1) - 0.5) * dx
    f = x * np.arcsinh(y / np.abs(x)) + y * np.arcsinh(x / np.abs(y))
    k = (f[1:, 1:] - f[:-1, 1:] - f[1:, :-1] + f[:-1, :-1]) / np.pi
    full = np.zeros((2 * ny, 2 * nx))
    full[:ny, :nx], full[ny + 1 :, :nx] = k, k[:0:-1]
    full[:ny, nx + 1 :], full[ny + 1 :, nx + 1 :] = k[:, :0:-1], k[:0:-1, :0:-1]
    return np.ascontiguousarray(scipy.fft.rfft2(full).real)


def surface(n, periodic, area):
    """Self-affine map of rms slope 0.1 resolved to 8 pixels, its load, and its rms height."""
    k = np.hypot(np.fft.fftfreq(n, 1.0 / n)[:, None], np.fft.rfftfreq(n, 1.0 / n))
    noise = np.fft.rfft2(np.random.default_rng(1).standard_normal((n, n)))
    spectrum = np.where(k <= n / 8.0, (np.maximum(k, 4.0) / 4.0) ** -1.8, 0.0) * noise
    spectrum[0, 0] = 0.0
    slope = np.fft.irfft2(2.0 * np.pi * k * spectrum, s=(n, n)).std()
    h = np.fft.irfft2(spectrum, s=(n, n)) * (0.1 / slope)
    scale = float(h.std())
    if periodic:
        return h, LOADS[area], scale
    x = (np.arange(n) + 0.5) / n - 0.5
    ball = -(x[:, None] ** 2 + x**2) / (2.0 * RADIUS)
    return h + ball, 4.0 * HERTZ[area] ** 3 / (3.0 * RADIUS), scale


def violation(p, h, periodic, scale):
    """Largest violation of a contact condition over the rms roughness."""
    n = p.shape[0]
    make = half_space if periodic else free_half_space
    size = (n, n) if periodic else (2 * n, 2 * n)
    symbol = make((n, n), (1.0 / n, 1.0 / n))
    u = scipy.fft.irfft2(scipy.fft.rfft2(p, s=size) * symbol, s=size)[:n, :n]
    gap = u - h
    gap -= np.sum(p * gap) / p.sum()
    return float(max(np.abs(gap[p > 0.0]).max(), -gap[p <= 0.0].min(initial=0.0))) / scale


def ours(h, load, periodic, scale, threads, fast, repeats):
    """Best seconds, applications, violation and memory of Press, asked until 1e-8 is reached."""
    from contactkit.kernels.active_set import Press

    n, rtol = h.shape[0], 1e-8
    make = half_space if periodic else free_half_space
    press = Press((n, n), (1.0 / n, 1.0 / n), make, periodic, threads=threads, fast=fast)
    while True:
        s = press.solve(h, mean_pressure=load, rtol=rtol)
        reached = violation(s.pressure, h, periodic, scale)
        if reached <= 1e-8 or rtol < 1e-10:
            break
        rtol *= 0.3
    best = np.inf
    for _ in range(repeats):
        begun = time.process_time()
        press.solve(h, mean_pressure=load, rtol=rtol)
        best = min(best, time.process_time() - begun)
    return best, s.n_applications, reached, s.memory_arrays


def theirs(peer, python, h, load, periodic, scale, threads, repeats):
    """The same of a peer in its own interpreter, or None."""
    with tempfile.TemporaryDirectory() as folder:
        paths = {k: str(Path(folder) / k) for k in ("heights.npy", "p.npy", "job", "run.py")}
        np.save(paths["heights.npy"], h)
        Path(paths["run.py"]).write_text(RUNNER, encoding="utf-8")
        for tol in (1e-8, 2e-9, 4e-10):
            job = {"peer": peer, "heights": paths["heights.npy"], "out": paths["p.npy"]}
            job |= {"load": load, "periodic": periodic, "tol": tol, "repeats": repeats}
            Path(paths["job"]).write_text(json.dumps(job), encoding="utf-8")
            done = subprocess.run(
                [python, paths["run.py"], paths["job"]], capture_output=True, text=True,
                check=False,
                env={"OMP_NUM_THREADS": str(threads), "PATH": ""}, timeout=1800,
            )  # fmt: skip
            if done.returncode:
                print(f"  {peer}: {done.stderr.strip().splitlines()[-1][:90]}")
                return None
            said = json.loads(done.stdout.strip().splitlines()[-1])
            reached = violation(np.load(paths["p.npy"]), h, periodic, scale)
            if reached <= 1e-8:
                break
        return said["seconds"], said["iterations"], reached


def main():
    """Print one row for each surface."""
    ask = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    ask.add_argument("--sizes", type=int, nargs="+", default=[256])
    ask.add_argument("--areas", type=int, nargs="+", default=[1, 5, 20], choices=[1, 5, 20])
    ask.add_argument("--threads", type=int, nargs="+", default=[1])
    ask.add_argument("--repeats", type=int, default=3)
    ask.add_argument("--peer", action="append", default=[], help="NAME=PYTHON")
    given = ask.parse_args()
    peers = dict(p.split("=", 1) for p in given.peer)
    for name in set(PEERS) - set(peers):
        print(f"{name}: not given, skipped")
    from contactkit.kernels.fft_backends import fast_transforms_installed

    paths = [False, True] if fast_transforms_installed() else [False]
    for n in given.sizes:
        for periodic in (True, False):
            for area in given.areas:
                h, load, scale = surface(n, periodic, area)
                for threads in given.threads:
                    label = f"{n} {'periodic' if periodic else 'free'} {area}% {threads}t"
                    rows = {
                        "fast" if fast else "plain": ours(
                            h, load, periodic, scale, threads, fast, given.repeats
                        )
                        for fast in paths
                    }
                    for name, (seconds, count, reached, arrays) in rows.items():
                        print(f"{label} {name}: {seconds:.3f} s, {count} applications, "
                              f"kkt {reached:.0e}, {arrays:.1f} arrays")  # fmt: skip
                    for peer, python in peers.items():
                        row = theirs(peer, python, h, load, periodic, scale, threads, given.repeats)
                        if row is None:
                            continue
                        ratios = ", ".join(f"{k} {row[0] / v[0]:.1f}x" for k, v in rows.items())
                        print(f"{label} {peer}: {row[0]:.3f} s, {row[1]} iterations, "
                              f"kkt {row[2]:.0e}: {ratios}", flush=True)  # fmt: skip


if __name__ == "__main__":
    sys.exit(main())
