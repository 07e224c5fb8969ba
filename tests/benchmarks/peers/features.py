# ruff: noqa: T201
"""Load curves, loading histories, partial slip, line contacts and sheets on a base against peers.

    python tests/benchmarks/peers/features.py --sizes 128 256

Each peer is compared on what it has: aspher with twenty loads one by one, SlipPY with tractions in
the friction bound under an imposed displacement, ContactMechanics with the plastic shape of a load
cycle, windows that repeat along one axis and sheets on a rigid base. A solver's tolerance is
lowered until an independent operator finds the conditions met to 1e-8, or it can no more. Seconds
are those of the processor for a prepared solve on one thread, the least of some.
The table goes to out/bench/features.md, numbers to out/bench/features.json.
"""

from __future__ import annotations

import argparse
import json
import sys
import time
from pathlib import Path
from typing import NamedTuple

import numpy as np
from cases import LOADS, RMS_SLOPE, Case, case, free_half_space, violation
from processes import interpreter, rows
from solvers import aspher

TARGET = 1e-8
TOLERANCES = tuple(10.0 ** (-0.5 * i) for i in range(14, 27))  # 1e-7 and lower
CURVE = np.geomspace(LOADS["selfaffine"][1], LOADS["selfaffine"][20], 20) * RMS_SLOPE
HARDNESS = 0.8 * RMS_SLOPE  # over the contact modulus
CYCLE = (0.25, 0.5, 0.75, 1.0, 0.75, 0.5, 0.25)  # of the load
FRICTION, PULLED = 0.3, 0.5  # coefficient; displacement over that of the pressure's range
SHEET, NU = 0.05, 0.3  # thickness over the window, Poisson's ratio
IMAGES = 10  # that ContactMechanics sums on either side
MODULUS, SIZE = 1e9, 1e-6  # units of the scenes [Pa], [m]


class Answer(NamedTuple):
    """Error by the independent operator, applications of the operator, and a number to compare."""

    error: float
    count: int | None
    value: float


# Twenty loads ---------------------------------------------------------------------------------


def curve_here(n):
    """Through the load curve, from plan to numbers."""
    import contactkit as ck

    given = case("selfaffine", n, "periodic", 5)
    made = scene(given.heights, CURVE[0])

    def solve(tolerance):
        found = ck.load_curve(
            ck.plan(made, ck.Accuracy(rtol=tolerance)), pressures=CURVE * MODULUS, keep_maps=True
        )
        pressures = [one.pressure / MODULUS for one in found.results]
        return graded_curve(given, pressures, int(found.applications.sum()))

    return solve


def curve_by_aspher(n):
    """One solve for each load."""
    given = case("selfaffine", n, "periodic", 5)
    each = [aspher(given._replace(load=load), 1) for load in CURVE]

    def solve(tolerance):
        return graded_curve(given, [one(tolerance)[0] for one in each], None)

    return solve


def graded_curve(given, pressures, count):
    """Worst error of the loads, and the area under the largest."""
    errors = [violation(p, given._replace(load=w)) for p, w in zip(pressures, CURVE, strict=True)]
    return Answer(max(max(e) for e in errors), count, float((pressures[-1] > 0.0).mean()))


# Plastic loading and unloading ----------------------------------------------------------------


def cycle_here(n):
    """By `PlasticHistory`."""
    import contactkit as ck

    given = case("selfaffine", n, "periodic", 20)
    effects = (
        ck.HardnessLimit(rule=ck.ConstantHardness(hardness=HARDNESS * MODULUS)),
        ck.PlasticHistory(pressures=(given.load * MODULUS,), steps=4),
    )
    made = scene(given.heights, CYCLE[-1] * given.load, *effects)

    def solve(tolerance):
        found = ck.solve(ck.plan(made, ck.Accuracy(rtol=tolerance)))
        depth = found.of(ck.PlasticHistory).residual_depth / SIZE
        return graded_cycle(given, found.pressure / MODULUS, depth, found.work)

    return solve


def cycle_by_ContactMechanics(n):
    """By a plastic topography that each step deforms."""
    from ContactMechanics import PeriodicFFTElasticHalfSpace
    from ContactMechanics.PlasticSystemSpecialisations import PlasticNonSmoothContactSystem
    from SurfaceTopography import PlasticTopography, Topography

    given = case("selfaffine", n, "periodic", 20)

    def solve(tolerance):
        surface = PlasticTopography(Topography(given.heights, (1.0, 1.0), periodic=True), HARDNESS)
        substrate = PeriodicFFTElasticHalfSpace((n, n), 1.0, (1.0, 1.0))
        system = PlasticNonSmoothContactSystem(substrate, surface)
        for fraction in CYCLE:
            asked = {"external_force": fraction * given.load, "maxiter": 10_000}
            found = system.minimize_proxy(pentol=tolerance * given.scale, **asked)
        pressure = np.asarray(found.jac)[:n, :n] * n**2
        return graded_cycle(given, pressure, -np.asarray(surface.plastic_displ), None)

    return solve


def graded_cycle(given, pressure, depth, work):
    """Error of the last state on the shape that is left, and the plastic volume."""
    left = given._replace(heights=given.heights - depth, load=CYCLE[-1] * given.load)
    count = None if work is None else work.n_operator_applications
    return Answer(max(violation(pressure, left, cap=HARDNESS)), count, float(depth.mean()))


# Partial slip ---------------------------------------------------------------------------------


class Slip(NamedTuple):
    """Pressure, bound of the tractions and displacement, of unit tangential modulus."""

    pressure: np.ndarray
    bound: np.ndarray
    displacement: float


def slip_case(n):
    """Hertz's pressure with holes by waves: alike for all, without a contact solver."""
    x = ((np.arange(n) + 0.5) / n - 0.5) * 2.2
    y = x[:, None]
    round_one = np.sqrt(np.maximum(1.0 - x**2 - y**2, 0.0))
    waves = np.cos(9.0 * x + 2.0) * np.cos(7.0 * y) + 0.5 * np.sin(23.0 * (x - 0.6 * y))
    pressure = np.maximum(round_one * (0.6 + waves), 0.0)
    under = through(pressure, n)
    return Slip(pressure, FRICTION * pressure, PULLED * FRICTION * float(under.max()))


def through(traction, n):
    """Displacement under tractions on an isolated contact."""
    symbol = free_half_space((n, n), (1.0 / n, 1.0 / n))
    return np.fft.irfft2(np.fft.rfft2(traction, s=(2 * n, 2 * n)) * symbol)[:n, :n]


def slip_here(n):
    """The step of a path."""
    from contactkit.contact.slip.load_path import FrictionLaw, follow
    from contactkit.elasticity.layer_stack import Layers
    from contactkit.scene.loading import TangentialStep
    from contactkit.scene.window import Grid

    given = slip_case(n)
    grid = Grid((n, n), (1.0 / n, 1.0 / n), False)
    path = (TangentialStep(displacement=given.displacement),)

    def solve(tolerance):
        law = FrictionLaw(FRICTION, 0.0, 1, True, tolerance)
        part = follow(given.pressure, grid, (Layers([1.0], [0.0]),), path, law)
        return graded_slip(given, part.traction_x[0], part.applications)

    return solve


def slip_by_slippy(n):
    """Its bound-constrained conjugate gradients, on its own influence coefficients."""
    import slippy as sp

    sp.CUDA, sp.CORES = False, 1
    from slippy.core import elastic_influence_matrix_spatial, plan_convolve
    from slippy.core.influence_matrix_utils import bccg

    given = slip_case(n)
    touching = given.pressure > 0.0
    influence = elastic_influence_matrix_spatial(
        "xx", (2 * n, 2 * n), (1.0 / n, 1.0 / n), shear_mod=0.5, v=0.0
    )
    applied = plan_convolve(given.pressure, influence, touching, (False, False), fft_im=False)
    calls = []

    def counted(*arguments):
        calls.append(1)
        return applied(*arguments)

    def solve(tolerance):
        calls.clear()
        wanted = np.full(int(touching.sum()), given.displacement)
        top = given.bound[touching]
        found, _ = bccg(counted, wanted, tolerance, 10_000, 0.5 * top, 0.0 * top, top)
        traction = np.zeros((n, n))
        traction[touching] = found
        return graded_slip(given, traction, len(calls))

    return solve


def graded_slip(given, traction, count):
    """Violation of stick or slip over the displacement, and the force over full sliding."""
    n = len(traction)
    symbol = free_half_space((n, n), (1.0 / n, 1.0 / n))
    own = float(np.fft.irfft2(symbol)[0, 0])
    ahead = given.displacement - through(traction, n)
    nearest = np.clip(traction + ahead / own, -given.bound, given.bound)
    error = own * np.abs(traction - nearest).max() / given.displacement
    return Answer(float(error), count, float(traction.sum() / given.bound.sum()))


# Windows that repeat along one axis, and sheets on a base --------------------------------------


def one_axis(shape, pixel_size, images=None):
    """Symbol of a square window that repeats along x, of the images on either side or all."""
    n, size = shape[0], pixel_size[0]
    corner = np.arange(-n, n + 1)[:, None], np.arange(n)
    y, x = corner[0] * size, np.minimum(corner[1], n - corner[1]) * size
    total = np.zeros((2 * n + 1, n))
    near = 4 if images is None else images
    for j in range(-near, near + 1):
        total += rectangle(x - j, y, size)
    if images is None:  # points, then their sum as an integral, without a constant
        last = 400
        for j in range(near + 1, last + 1):
            for sign in (-1.0, 1.0):
                total += size**2 * (1.0 / np.hypot(x - sign * j, y) - 1.0 / j) / np.pi
        total += size**2 * (2.0 * x**2 - y**2) / (2.0 * (last + 0.5) ** 2) / np.pi
    rows = np.concatenate([total[n:-1], total[-1:], total[1:n]])
    return np.fft.rfft2(rows).real


def rectangle(x, y, size):
    """Displacement at a distance from a uniformly loaded square (Love)."""
    total = 0.0
    for sy in (-0.5, 0.5):
        for sx in (-0.5, 0.5):
            X, Y = x + sx * size, y + sy * size
            total = total + 4.0 * sx * sy * (
                X * np.arcsinh(Y / np.abs(X)) + Y * np.arcsinh(X / np.abs(Y))
            )
    return total / np.pi


def sheet(shape, pixel_size):
    """Symbol of a sheet bonded to a rigid base (Johnson 1985, section 5.8), of unit E*."""
    n = shape[0]
    q = 2.0 * np.pi * np.hypot(np.fft.fftfreq(n, 1.0 / n)[:, None], np.fft.rfftfreq(n, 1.0 / n))
    h = np.minimum(q * SHEET, 300.0)
    k = 3.0 - 4.0 * NU
    top = k * np.sinh(2.0 * h) - 2.0 * h
    below = k * np.cosh(2.0 * h) + 2.0 * h**2 + 5.0 - 12.0 * NU + 8.0 * NU**2
    symbol = np.divide(2.0 * top, q * below, out=np.zeros_like(q), where=q > 0.0)
    symbol[0, 0] = SHEET * (1.0 + NU) * (1.0 - 2.0 * NU) / (1.0 - NU) * (1.0 - NU**2)
    return symbol


def line_here(n):
    """By the solver of contacts, on its own influence coefficients."""
    from contactkit.elasticity.layer_stack import Layers
    from contactkit.elasticity.one_axis import symbol

    def maker(shape, pixel_size):
        return symbol(shape, pixel_size, Layers([1.0], [0.0]), "x")

    return pressed_here(line_case(n), maker, "x", one_axis)


def line_by_ContactMechanics(n):
    """By the sum of its images."""
    from ContactMechanics import SemiPeriodicFFTElasticHalfSpace

    substrate = SemiPeriodicFFTElasticHalfSpace(
        (n, n), 1.0, (1.0, 1.0), periodicity=(False, True), n_images=IMAGES
    )
    return pressed_there(line_case(n), substrate, lambda *grid: one_axis(*grid, IMAGES))


def line_case(n):
    """A rough roller along x."""
    given = case("selfaffine", n, "periodic", 5)
    y = ((np.arange(n) + 0.5) / n - 0.5)[:, None]
    return Case(given.heights - y**2 / 20.0, 0.003, False, given.scale)


def base_here(n):
    """By the solver of contacts on the recursion of layers."""
    from contactkit.elasticity.layered import normal_symbol

    def maker(shape, pixel_size):
        return normal_symbol(shape, pixel_size, [1.0 - NU**2], [NU], [SHEET], "bonded")

    return pressed_here(case("selfaffine", n, "periodic", 5), maker, True, sheet)


def base_by_ContactMechanics(n):
    """By its correction for a finite thickness."""
    from ContactMechanics import PeriodicFFTElasticHalfSpace

    substrate = PeriodicFFTElasticHalfSpace(
        (n, n), 1.0 - NU**2, (1.0, 1.0), thickness=SHEET, poisson=NU
    )
    return pressed_there(case("selfaffine", n, "periodic", 5), substrate, sheet)


def pressed_here(given, maker, edges, symbol):
    """A prepared contact, and its grade."""
    from contactkit.contact.solver.contact_solver import ContactSolver

    n = len(given.heights)
    solver = ContactSolver((n, n), (1.0 / n, 1.0 / n), maker, edges, threads=1)
    exact = symbol((n, n), (1.0 / n, 1.0 / n))

    def solve(tolerance):
        found = solver.solve(given.heights, mean_pressure=given.load, rtol=tolerance)
        return graded(found.pressure, given, exact, found.n_applications)

    return solve


def pressed_there(given, substrate, symbol):
    """The same by the peer."""
    from ContactMechanics.Optimization import constrained_conjugate_gradients

    n = len(given.heights)
    exact = symbol((n, n), (1.0 / n, 1.0 / n))

    def solve(tolerance):
        found = constrained_conjugate_gradients(
            substrate,
            given.heights,
            external_force=given.load,
            pentol=tolerance * given.scale,
            forcetol=np.inf,
        )
        return graded(np.asarray(found.jac)[:n, :n] * n**2, given, exact, int(found.nit))

    return solve


def graded(pressure, given, symbol, count):
    """Error under a symbol of the window, or of the window doubled across."""
    n = len(pressure)
    size = (symbol.shape[0], n)
    gap = np.fft.irfft2(np.fft.rfft2(pressure, s=size) * symbol, s=size)[:n] - given.heights
    on = pressure > 0.0
    gap -= np.sum(pressure[on] * gap[on]) / np.sum(pressure[on])
    worst = max(np.abs(gap[on]).max(), -gap[~on].min(initial=0.0)) / given.scale
    error = max(worst, abs(pressure.mean() / given.load - 1.0))
    return Answer(float(error), count, float(on.mean()))


# One run --------------------------------------------------------------------------------------

CASES = {  # what it is, the number that is compared, ours, the peer, the peer's
    "curve of 20 loads": ("contact area", curve_here, "aspher", curve_by_aspher),
    "plastic load cycle of 7": (
        "plastic depth",
        cycle_here,
        "ContactMechanics",
        cycle_by_ContactMechanics,
    ),
    "partial slip": ("force over full sliding", slip_here, "slippy", slip_by_slippy),
    "window that repeats along one axis": (
        "contact area",
        line_here,
        "ContactMechanics",
        line_by_ContactMechanics,
    ),
    "sheet on a rigid base": (
        "contact area",
        base_here,
        "ContactMechanics",
        base_by_ContactMechanics,
    ),
}


def scene(heights, load, *effects):
    """A rigid map on a half-space of unit contact modulus."""
    import contactkit as ck

    n = len(heights)
    solid = ck.Material(young_modulus=MODULUS, poisson_ratio=0.0)
    surface = ck.Heights(heights=heights * SIZE, pixel_size=SIZE / n)
    return ck.ContactScene(
        interface=ck.Interface(lower=ck.Body(solid=solid), upper=ck.Body(surface=surface)),
        window=ck.Window(periodic=True),
        loading=ck.Pressing(pressure=load * MODULUS),
        effects=(ck.HalfSpace(), *effects),
    )


def serve(name, given):
    """Print what one solver needs on all cases that it has."""
    for what, (_, here, peer, there) in CASES.items():
        if name not in ("contactkit", peer):
            continue
        prepare = here if name == "contactkit" else there
        prepare(128)(1e-4)  # loads libraries and compiled code
        expected = 0.0
        for n in given.sizes:
            if expected > given.budget:
                break
            row = measured(prepare(n), given.budget)
            expected = 4.0 * row[1]
            print(json.dumps([what, n, *row]), flush=True)


def measured(solve, budget):
    """Error, seconds, count and number at the first tolerance that is good enough, or the last."""
    used = 0.0
    for tolerance in TOLERANCES:
        begun = time.process_time()
        answer = solve(tolerance)
        best = time.process_time() - begun
        used += best
        if answer.error <= TARGET or used > budget:
            break
    while used < min(0.2 * budget, 2.0):
        begun = time.process_time()
        solve(tolerance)
        best = min(best, time.process_time() - begun)
        used += best
    return answer.error, best, answer.count, answer.value


def run(python, name, given):
    """Rows of a solver by case and size, or why there are none."""
    options = ["--budget", given.budget, "--sizes", *given.sizes]
    found, reason = rows(python, __file__, name, options)
    return {(what, n): rest for what, n, *rest in found}, reason


def compared(given, mine, peers, missing):
    """Rows of the table: ours, the peer's and the ratio of their seconds."""
    found = []
    for what, (number, _, peer, _) in CASES.items():
        for n in given.sizes:
            if (what, n) not in mine:
                continue
            error, seconds, count, value = mine[what, n]
            row = {"what": what, "n": n, "seconds": seconds, "count": count, "error": error}
            row |= {"target": TARGET, "number": number, "value": value, "peer": peer}
            if (what, n) in peers.get(peer, {}):
                theirs = peers[peer][what, n]
                row |= {"peer_error": theirs[0], "peer_seconds": theirs[1]}
                row |= {"peer_count": theirs[2], "peer_value": theirs[3]}
            else:
                row["missing"] = missing.get(peer, "out of budget at a smaller size")
            found.append(row)
    return found


def table(found):
    """Ratios of seconds, with what each reached."""
    lines = [
        "| what | pixels a side | convolutions | CPU s | error | peer | CPU s | error | over ours "
        "| compared number: ours, theirs |",
        "|---|---|---|---|---|---|---|---|---|---|",
    ]
    for row in found:
        cells = [row["what"], f"{row['n']}", f"{row['count']}", f"{row['seconds']:.3f}"]
        cells += [f"{row['error']:.0e}", row["peer"]]
        value = f"{row['number']} {row['value']:.6g}"
        if "missing" in row:
            cells += [row["missing"], "", "", value]
        else:
            over = "" if row["peer_error"] <= TARGET else ">"
            cells += [f"{row['peer_seconds']:.3f}", f"{row['peer_error']:.0e}"]
            ratio = row["peer_seconds"] / row["seconds"]
            cells += [f"{over}{ratio:.1f}", f"{value}, {row['peer_value']:.6g}"]
        lines.append("| " + " | ".join(cells) + " |")
    return "\n".join(lines)


def main():
    """Run all, compare, write."""
    ask = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    ask.add_argument("--sizes", type=int, nargs="+", default=[128, 256])
    ask.add_argument("--budget", type=float, default=20.0, help="CPU seconds of a solver on a case")
    ask.add_argument("--peers", type=Path, default=Path(".venv/peers"))
    ask.add_argument("--out", type=Path, default=Path("out/bench"))
    ask.add_argument("--serve", help=argparse.SUPPRESS)
    given = ask.parse_args()
    if given.serve:
        return serve(given.serve, given)
    peers, missing = {}, {}
    for name in dict.fromkeys(peer for _, _, peer, _ in CASES.values()):
        python, reason = interpreter(given.peers, name)
        if python:
            peers[name], reason = run(python, name, given)
        if reason:
            missing[name] = reason
            print(f"{name} left out: {reason}")
    mine, reason = run(sys.executable, "contactkit", given)
    if reason:
        print(f"contactkit failed: {reason}")
        return 1
    found = compared(given, mine, peers, missing)
    text = table(found)
    given.out.mkdir(parents=True, exist_ok=True)
    (given.out / "features.md").write_text(text + "\n", encoding="utf-8")
    (given.out / "features.json").write_text(json.dumps(found, indent=1) + "\n", encoding="utf-8")
    print(text)
    return int(max(row["error"] for row in found) > TARGET)


if __name__ == "__main__":
    sys.exit(main())
