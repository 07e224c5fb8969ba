"""How each contact solver is asked: ``prepare(case, threads)`` gives ``solve(tolerance)``.

``solve`` returns the pressure map and how many iterations it took; of contactkit, how often it
applied the operator on the full grid. A solver's modules are imported by its own functions only.
"""

from __future__ import annotations

import importlib.util
import io
import os
import sys
import tempfile
from contextlib import contextmanager
from functools import partial

import numpy as np


def plain(given, threads):
    """Contactkit on numpy and scipy."""
    return _contactkit(given, threads, fast=False)


def fast(given, threads):
    """Contactkit with numba and ducc0."""
    return _contactkit(given, threads, fast=True)


def _contactkit(given, threads, fast):
    """With the compliance that `contactkit.press` takes, of unit modulus."""
    from contactkit.contact.solver.contact_solver import ContactSolver
    from contactkit.elasticity import influence, layered

    n = given.heights.shape[0]
    make = layered.normal_symbol if given.periodic else influence.symbol
    maker = partial(make, young_modulus=(1.0,), poisson_ratio=(0.0,), thickness=())
    press = ContactSolver(
        (n, n), (1.0 / n, 1.0 / n), maker, given.periodic, threads=threads, fast=fast
    )

    def solve(tolerance):
        found = press.solve(given.heights, mean_pressure=given.load, rtol=tolerance)
        return found.pressure, found.n_applications

    return solve


def aspher(given, threads):
    """C++, nested grids; builds its operators within the solve."""
    from aspher import solve_nested

    n = given.heights.shape[0]
    gap = (given.heights.max() - given.heights).ravel()

    def solve(tolerance):
        found = solve_nested(
            grid_size=n,
            gap=gap,
            p_nominal=given.load,
            tol=tolerance,
            backend="periodic" if given.periodic else "fft",
        )
        return np.asarray(found.pressure).reshape(n, n), int(found.iterations)

    return solve


def tamaas(given, threads):
    """C++, constrained conjugate gradients after Polonsky and Keer."""
    import tamaas as tm

    tm.set_log_level(tm.LogLevel.info)  # its iterations are only to be had from what it prints
    n = given.heights.shape[0]
    model = tm.Model(tm.model_type.basic_2d, [1.0, 1.0], [n, n])
    model.E, model.nu = 1.0, 0.0
    if not given.periodic:
        tm.ModelFactory.registerNonPeriodic(model, "dcfft")

    def solve(tolerance):
        model.traction[...] = 0.0
        solver = tm.PolonskyKeerRey(model, given.heights, tolerance)
        solver.max_iter = 100_000
        solver.setDumpFrequency(1)
        if not given.periodic:
            solver.setIntegralOperator("dcfft")
        with printed() as lines:
            solver.solve(given.load)
        return np.array(model.traction).reshape(n, n), last_number(lines)

    return solve


@contextmanager
def printed():
    """Lines that compiled code writes to the standard error meanwhile, once it is over."""
    lines = []
    sys.stderr.flush()
    kept = os.dup(2)
    with tempfile.TemporaryFile("w+") as caught:
        os.dup2(caught.fileno(), 2)
        try:
            yield lines
        finally:
            os.dup2(kept, 2)
            os.close(kept)
            caught.seek(0)
            lines += caught.read().splitlines()


def last_number(lines):
    """First whole number of the last line that begins with one."""
    for line in reversed(lines):
        first = line.split()[:1]
        if first and first[0].isdigit():
            return int(first[0])
    return None


def ContactMechanics(given, threads):
    """numpy and a C++ transform, constrained conjugate gradients; one thread whatever is asked."""
    from ContactMechanics import FreeFFTElasticHalfSpace, PeriodicFFTElasticHalfSpace
    from ContactMechanics.Optimization import constrained_conjugate_gradients
    from ContactMechanics.Tools.Logger import Logger

    n = given.heights.shape[0]
    kind = PeriodicFFTElasticHalfSpace if given.periodic else FreeFFTElasticHalfSpace
    substrate = kind((n, n), 1.0, (1.0, 1.0))
    quiet = Logger(logfile=io.StringIO(), outevery=1_000_000)

    def solve(tolerance):
        found = constrained_conjugate_gradients(
            substrate,
            given.heights,
            external_force=given.load,
            pentol=tolerance * given.scale,
            forcetol=np.inf,
            thermotol=1e-6,
            logger=quiet,
        )
        return np.asarray(found.jac)[:n, :n] * n**2, int(found.nit)

    return solve


def slippy(given, threads):
    """FFTW under numpy, constrained conjugate gradients; stops on the change of the pressure."""
    import slippy as sp

    sp.CUDA, sp.CORES = False, threads
    from slippy.core import elastic_influence_matrix_spatial, plan_convolve, polonsky_and_keer

    n = given.heights.shape[0]
    start, gap = np.ones((n, n)), given.heights.max() - given.heights
    if given.periodic:
        k = 2.0 * np.pi * np.fft.fftfreq(n, 1.0 / n)
        q = np.hypot(k[:, None], k)
        influence = np.divide(2.0, q, out=np.zeros_like(q), where=q > 0.0)
    else:
        influence = elastic_influence_matrix_spatial(
            "zz", (2 * n, 2 * n), (1.0 / n, 1.0 / n), shear_mod=0.5, v=0.0
        )
    apply = plan_convolve(start, influence, None, given.periodic, fft_im=given.periodic)
    calls = []

    def counted(pressure, *more):
        calls.append(1)
        return apply(pressure, *more)

    def solve(tolerance):
        calls.clear()
        _, pressure, _ = polonsky_and_keer(
            counted, start, gap, given.load, 1.0 / n, eps_0=tolerance, max_it=100_000
        )
        return pressure, len(calls) // 2

    return solve


def named(name, program=None):
    """The function above of that name, or `prepare` in the file of a program."""
    if program is None:
        return getattr(sys.modules[__name__], name)
    spec = importlib.util.spec_from_file_location(name, program)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module.prepare
