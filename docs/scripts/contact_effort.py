"""Tables of the cost of rough contacts on this machine, for `measure_contact.py`."""

from __future__ import annotations

from typing import Any

from validation_tables import grid

import contactkit as ck
from contactkit.benchmarks.timing import best_of
from contactkit.contact.solver.contact_solver import ContactSolver
from contactkit.roughness.statistics import rms_slope

STEEL = ck.Material(young_modulus=210e9, poisson_ratio=0.3, hardness=7.5e9)


def rough_scene(
    n: int, area: float, solid: Any = STEEL, *effects: Any, periodic: bool = True
) -> tuple[ck.ContactScene, ck.Accuracy]:
    """A self-affine surface whose shortest wave has eight pixels, pressed to about an area."""
    width = n * 10e-9
    surface = ck.SelfAffineRoughness(rms=1e-9, hurst=0.8, rolloff=width / 4, cutoff=80e-9)
    from contactkit.contact.grid import realise
    from contactkit.scene.window import Grid

    heights = realise(surface, Grid((n, n), (10e-9, 10e-9), True))
    slope = float(rms_slope(heights, (10e-9, 10e-9), True))
    scene = ck.ContactScene(
        interface=ck.Interface(lower=ck.Body(solid=solid), upper=ck.Body(surface=surface)),
        window=ck.Window(width=width, periodic=periodic),
        loading=ck.Pressing(pressure=0.5 * area * slope * STEEL.plane_strain_modulus),
        effects=(ck.LayeredHalfSpace(), *effects),
    )
    return scene, ck.Accuracy(grid=n)


def timed(scene: ck.ContactScene, accuracy: ck.Accuracy) -> tuple[ck.ContactResult, float]:
    """A contact, and the best CPU seconds of its solve without the setup."""
    made = ck.plan(scene, accuracy)
    return best_of(lambda: ck.solve(made))


def solver_table() -> str:
    """Operator applications and CPU seconds over grid, load and edges."""
    rows = []
    for periodic, sizes in ((True, (256, 512, 1024)), (False, (256, 512))):
        for n in sizes:
            for area in (0.01, 0.05, 0.2):
                run, seconds = timed(*rough_scene(n, area, periodic=periodic))
                edges = "periodic" if periodic else "free"
                cells = f"{100 * run.contact_fraction:.1f}", f"{run.work.n_operator_applications}"
                rows.append((edges, f"{n}", *cells, f"{run.residual:.0e}", f"{seconds:.2f}"))
    head = (
        "edges",
        "pixels a side",
        "contact area [%]",
        "operator applications",
        "residual",
        "seconds",
    )
    return grid(head, rows)


def fast_table() -> str:
    """The solver with and without the extra `fast`, at 5 % contact."""
    rows = []
    for n in (256, 512, 1024):
        made = ck.plan(*rough_scene(n, 0.05))
        interface = made.prepared
        cells = []
        for fast in (True, False):
            solver = ContactSolver(
                made.grid.shape,
                made.grid.pixel_size,
                interface.compliances[0],
                periodic=True,
                fast=fast,
            )
            found, seconds = best_of(
                lambda solver=solver, interface=interface, made=made: solver.solve(
                    interface.heights, mean_pressure=made.mean_pressure
                )
            )
            cells += [f"{found.n_applications}", f"{seconds:.2f}"]
        rows.append((f"{n}", *cells))
    head = (
        "pixels a side",
        "applications, fast",
        "seconds, fast",
        "applications, without",
        "seconds, without",
    )
    return grid(head, rows)


def ratio_table() -> str:
    """Cost of layers and hardness, on 512 x 512 pixels and 5 % contact."""
    coated = ck.Stack(
        layers=tuple(
            ck.Layer(material=ck.load_material(m), thickness=h)
            for m, h in (("dlc", 5e-9), ("co-cr", 25e-9), ("ni-p", 1e-6))
        ),
        substrate=ck.load_material("al-mg"),
    )
    hard = ck.HardnessLimit(rule=ck.ConstantHardness(hardness=3e9))
    plain, base = timed(*rough_scene(512, 0.05))
    rows = [("half-space", f"{plain.work.n_operator_applications}", f"{base:.2f}", "1")]
    for label, run, seconds in (
        ("three layers", *timed(*rough_scene(512, 0.05, coated))),
        ("hardness of 3 GPa", *timed(*rough_scene(512, 0.05, STEEL, hard))),
    ):
        count = run.work.n_operator_applications
        rows.append((label, f"{count}", f"{seconds:.2f}", f"{seconds / base:.2f}"))
    scene, accuracy = rough_scene(512, 0.05)
    top = scene.loading.pressure or 0.0
    loads = {"loading.pressure": [top * 2.0 ** (-0.5 * i) for i in range(19, -1, -1)]}
    curve, seconds = best_of(lambda: ck.study(scene, loads, accuracy), repeats=1)
    count = int(sum(p.n_operator_applications for p in curve.points))
    label = "load curve of 20 points up to it, with setup"
    rows.append((label, f"{count}", f"{seconds:.2f}", f"{seconds / base:.1f}"))
    return grid(("what", "operator applications", "seconds", "over the half-space"), rows)
