"""What layers, a hardness and a load curve cost contactkit, each over the plain half-space.

All on the self-affine surface; seconds are CPU seconds of prepared solves, the best of several.
"""

from __future__ import annotations

import time
from functools import partial

import numpy as np
from cases import (
    LOADS,
    RMS_SLOPE,
    START,
    STEP,
    TARGET,
    case,
    symbol_maker,
    violation,
)
from timing import goes_on

POISSON = 0.3
UNIT = 1.0 - POISSON**2  # Young's modulus of a unit contact modulus
STACKS = {  # moduli over the substrate's, Poisson's ratios, thicknesses over the window
    "half-space by layers": ((1.0,), (0.3,), ()),
    "coat 3x, 1/50": ((3.0, 1.0), (0.3, 0.3), (0.02,)),
    "soft coat 0.1x, 1/100": ((0.1, 1.0), (0.3, 0.3), (0.01,)),
    "head-disk stack": ((2.0, 2.7, 1.86, 1.0), (0.25, 0.3, 0.36, 0.33), (2.5e-4, 1.25e-3, 0.5)),
    "hard film 10x, 1/1000": ((10.0, 1.0), (0.3, 0.3), (1e-3,)),
    "stiff plate 1000x, 1/1000": ((1e3, 1.0), (0.3, 0.3), (1e-3,)),
}
CAP = 1.0 * RMS_SLOPE  # hardness over contact modulus: some tenth of the contact yields


def run(job):
    """Rows of name, seconds and applications of both sides, and their ratio."""
    given = case("selfaffine", job["n"], job["boundary"], job["area"])
    is_fast = job["path"] == "fast"
    rows = _single(job, given, is_fast)
    if given.periodic:
        rows += _curve(job, given, is_fast)
        rows += _study(job) if job["has_study"] else []
    return {"rows": rows}


def _press(job, maker, fast):
    from contactkit.contact.solver.contact_solver import ContactSolver

    n = job["n"]
    periodic = job["boundary"] == "periodic"
    return ContactSolver(
        (n, n), (1.0 / n, 1.0 / n), maker, periodic, threads=job["threads"], fast=fast
    )


def _layered_maker(stack, periodic):
    from contactkit.elasticity.influence import symbol
    from contactkit.elasticity.layered import normal_symbol

    moduli, poisson, thickness = stack
    make = normal_symbol if periodic else symbol
    return lambda shape, pixel: make(shape, pixel, UNIT * np.array(moduli), poisson, thickness)


def _good(press, given, symbol=None, bound=None):
    """A solve to repeat, its answer, and the violation by the independent operator."""
    rtol = START
    while True:
        solve = partial(
            press.solve, given.heights, mean_pressure=given.load, bound=bound, rtol=rtol
        )
        found = solve()
        kkt, _ = violation(found.pressure, given, symbol, np.inf if bound is None else bound)
        if kkt <= TARGET or rtol < 1e-3 * START:
            return solve, found, kkt
        rtol *= STEP


def _best(one, other, job):
    """Best CPU seconds of two solves, taken in turns: the machine may be shared."""
    best, count, used = [np.inf, np.inf], 0, 0.0
    while goes_on(count, used, job):
        for i, solve in enumerate((one, other)):
            begun = time.process_time()
            solve()
            seconds = time.process_time() - begun
            best[i], used = min(best[i], seconds), used + seconds
        count += 1
    return best


def _row(job, fast, name, seconds, reference, counts, kkt, goal, **more):
    path = fast if isinstance(fast, str) else ("fast" if fast else "plain")
    row = {"name": name, "path": path, "n": job["n"], "boundary": job["boundary"]}
    row |= {"threads": job["threads"], "seconds": seconds, "reference_seconds": reference}
    row |= {"applications": counts[0], "reference_applications": counts[1], "kkt": kkt}
    return row | {"ratio": seconds / reference, "goal": goal, **more}


def _single(job, given, fast):
    """Layers and a hardness against the elastic half-space."""
    n = job["n"]
    press = _press(job, symbol_maker(given.periodic), fast)
    plain, elastic, _ = _good(press, given)
    bounded, found, kkt = _good(press, given, bound=CAP)
    fraction = float((found.pressure >= CAP).sum() / (found.pressure > 0.0).sum())
    seconds, reference = _best(bounded, plain, job)
    counts = found.n_applications, elastic.n_applications
    rows = [_row(job, fast, "hardness", seconds, reference, counts, kkt, 2.0, plastic=fraction)]
    for name, stack in STACKS.items():
        maker = _layered_maker(stack, given.periodic)
        begun = time.process_time()
        other = _press(job, maker, fast)
        setup = time.process_time() - begun
        layered, found, kkt = _good(other, given, maker((n, n), (1.0 / n, 1.0 / n)))
        seconds, reference = _best(layered, plain, job)
        counts = found.n_applications, elastic.n_applications
        rows.append(_row(job, fast, name, seconds, reference, counts, kkt, 1.1, setup=setup))
    return rows


def _curve(job, given, fast):
    """Twenty loads, each from the answer before, against twenty solves from nothing."""
    press = _press(job, symbol_maker(True), fast)
    low, high = (LOADS["selfaffine"][area] * RMS_SLOPE for area in (1, 20))
    loads = np.geomspace(low, high, 20)

    def all_loads(warm):
        begun, before, count, worst = time.process_time(), [], 0, 0.0
        for load in loads:
            found = press.solve(given.heights, mean_pressure=load, start=before or None)
            before = [(load, found.pressure), *before[:2]] if warm else []
            count += found.n_applications
            worst = max(worst, found.kkt)
        return time.process_time() - begun, count, worst

    warm, warm_count, kkt = all_loads(warm=True)
    cold, cold_count, _ = all_loads(warm=False)
    counts = warm_count, cold_count / loads.size
    single = cold / loads.size
    return [_row(job, fast, "20 loads, warm starts", warm, single, counts, kkt, 6.0)]


def _study(job):
    """The same curve by `study`, plans and results and all, against single solves."""
    import contactkit as ck

    heights = case("selfaffine", job["n"], "periodic", job["area"]).heights
    low, high = (LOADS["selfaffine"][area] * RMS_SLOPE for area in (1, 20))
    loads = [float(load) for load in np.geomspace(low, high, 20) * 1e9]
    solid = ck.Material(young_modulus=UNIT * 1e9, poisson_ratio=POISSON)
    given = ck.Heights(heights=heights * 1e-6, pixel_size=1e-6 / job["n"])
    scene = ck.ContactScene(
        interface=ck.Interface(lower=ck.Body(solid=solid), upper=ck.Body(surface=given)),
        window=ck.Window(periodic=True),
        loading=ck.Pressing(pressure=loads[0]),
        effects=(ck.HalfSpace(),),
    )
    accuracy = ck.Accuracy(threads=job["threads"])

    def curve(some):
        begun = time.process_time()
        found = ck.study(scene, {"loading.pressure": some}, accuracy)
        return time.process_time() - begun, found

    singles = sum(curve([load])[0] for load in loads[::6]) / len(loads[::6])
    seconds, found = curve(loads)
    if {point.status for point in found.points} != {"converged"}:
        raise RuntimeError("a point of the study did not converge")
    counts = None, None
    return [_row(job, "as installed", "20 loads, study", seconds, singles, counts, None, 6.0)]
