"""Seconds of `press_maps` by array library: a batch of small maps, and single maps of any size.

    python tests/benchmarks/maps_speed.py --libraries numpy torch --batch 1000 --sizes 256 512 1024
    python tests/benchmarks/maps_speed.py --libraries numpy torch:cuda cupy --precision float32

One thread on the CPU. Each is run once before it is timed; results are compared to those of numpy.
"""

from __future__ import annotations

import argparse
import os
import time

os.environ.setdefault("OMP_NUM_THREADS", "1")

import numpy as np

import contactkit as ck

SOLID = ck.Material(young_modulus=1e9, poisson_ratio=0.3)


def rough(n: int, seed: int) -> np.ndarray:
    """Self-affine map of unit side, rms slope 0.1, waves from a fourth of it to eight pixels."""
    rng = np.random.default_rng(seed)
    q = np.hypot(np.fft.fftfreq(n)[:, None] * n, np.fft.rfftfreq(n) * n)
    amplitude = np.where((q > 0.0) & (q <= n / 8), np.maximum(q, 4.0) ** -1.8, 0.0)
    spectrum = amplitude * np.exp(2j * np.pi * rng.random(q.shape))
    h = np.fft.irfft2(spectrum, s=(n, n))
    slope = np.fft.irfft2(2j * np.pi * np.fft.rfftfreq(n) * n * spectrum, s=(n, n))
    return 0.1 / np.sqrt(2.0) / slope.std() * h


def given_to(library: str, heights: np.ndarray, precision: str):
    """Heights as an array of a library, ``torch``, ``torch:cuda``, ``cupy`` or ``numpy``."""
    values = heights.astype(precision)
    name, _, device = library.partition(":")
    if name == "torch":
        import torch

        torch.set_num_threads(1)
        return torch.as_tensor(values, device=device or "cpu")
    if name == "cupy":
        import cupy

        return cupy.asarray(values)
    return values


def host(values) -> np.ndarray:
    """Array of any of the libraries as numpy's; waits for the device."""
    values = values.cpu() if hasattr(values, "cpu") else values
    return np.asarray(values.get() if hasattr(values, "get") else values)


def seconds(heights, load: float, periodic: bool) -> tuple[float, object]:
    """Seconds of one solve after another that is not counted."""
    given = {"mean_pressure": load, "periodic": periodic}
    pixel = 1.0 / heights.shape[-1]
    host(ck.press_maps(heights, pixel, SOLID, **given).kkt)
    on_cpu = str(getattr(heights, "device", "cpu")) == "cpu"
    clock = time.process_time if on_cpu else time.perf_counter  # whatever else a CPU does
    begun = clock()
    found = ck.press_maps(heights, pixel, SOLID, **given)
    host(found.kkt)
    return clock() - begun, found


def row(libraries: list[str], heights: np.ndarray, load: float, periodic: bool, precision: str):
    """Print the seconds of each library, on the same maps."""
    known = None
    count = heights.shape[0] if heights.ndim == 3 else 1
    for library in libraries:
        kind = "float64" if library == "numpy" else precision
        taken, found = seconds(given_to(library, heights, kind), load, periodic)
        p = host(found.pressure)
        known = p if known is None else known
        off = float(np.abs(p - known).max() / known.max())
        steps = host(found.n_applications)
        print(  # noqa: T201
            f"{count:5d} x {heights.shape[-1]:4d}^2  {'periodic' if periodic else 'isolated'}  "
            f"p = {load:.0e} Pa  area {float(host(found.contact_fraction).mean()):.3f}  "
            f"{library:10s} {kind}  {taken:8.3f} s  {taken / count * 1e3:9.3f} ms a map  "
            f"applications {steps.mean():.0f} (at most {steps.max()})  off {off:.0e}",
            flush=True,
        )


def main() -> None:
    """Read the options and print a row for each case."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--libraries", nargs="+", default=["numpy", "torch"])
    parser.add_argument("--batch", type=int, default=1000, help="maps of 64 x 64; 0 for none")
    parser.add_argument("--sizes", type=int, nargs="*", default=[256, 512, 1024])
    parser.add_argument("--loads", type=float, nargs="+", default=[1e7])
    parser.add_argument("--precision", choices=["float64", "float32"], default="float64")
    parser.add_argument("--edges", nargs="+", default=["periodic", "isolated"])
    given = parser.parse_args()
    cases = [np.stack([rough(64, seed) for seed in range(given.batch)])] if given.batch else []
    cases += [rough(n, 0) for n in given.sizes]
    for heights in cases:
        for load in given.loads:
            for edges in given.edges:
                row(given.libraries, heights, load, edges == "periodic", given.precision)


if __name__ == "__main__":
    main()
