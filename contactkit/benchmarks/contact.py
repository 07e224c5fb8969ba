"""Work-precision of a contact over tolerance and grid, by solver and by effect."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from pathlib import Path
from time import process_time
from typing import TYPE_CHECKING, Any, Literal

from attrs import evolve

from ..accuracy import Accuracy
from ..contact.effects.base import Compliance, PressureBound
from ..contact.effects.hardness_rules import ConstantHardness, HardnessMap
from ..contact.effects.plasticity import HardnessLimit
from ..errors import ConvergenceError, DescriptionError, InfeasibleError
from ..export.report import Report
from ..planning import plan
from ..scene.scenes import ContactScene
from ..work_precision import Outcome, Setting, WorkPrecision, sweep
from .effects import EffectCost, effect_costs

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from ..contact.discretisation import DiscretisationError
    from ..contact.result import ContactResult

__all__ = ["contact_alone", "contact_cost", "grid_sweep", "solver_sweep"]

Progress = Callable[[float], None]
Method = Literal["active-set", "quasi-newton", "conjugate-gradient"]

_TOLERANCES: dict[Method, tuple[float, ...]] = {
    "active-set": (1e-2, 1e-3, 1e-4, 1e-6, 1e-8, 1e-10),
    "conjugate-gradient": (1e-2, 1e-3, 1e-4, 1e-6, 1e-8),
    "quasi-newton": (1e-2, 1e-3, 1e-4),
}
_PIXELS = (256, 384, 512)  # of the comparison of solvers: the slow ones take minutes beyond
_MOST_SECONDS = 10.0  # of one run, after which a solver is not asked for more
_AREAS = {
    "pixel count": "contact_area",
    "edge-corrected area": "corrected_contact_area",
}
_FRACTIONS = (0.25, 0.375, 0.5, 0.7, 0.85, 1.0, 1.4)  # of the grid asked for


def contact_cost(
    scene: ContactScene, accuracy: Accuracy, out: Path | None, progress: Progress, error: float
) -> Report:
    """Measure solvers, grids and effects of a scene: a table, numbers, and a picture."""
    solvers = solver_sweep(scene, accuracy, lambda done: progress(0.5 * done))
    grids = grid_sweep(scene, accuracy, lambda done: progress(0.5 + 0.3 * done))
    discretised = _discretised(scene, accuracy)
    effects = effect_costs(scene, accuracy, lambda done: progress(0.8 + 0.2 * done))
    text = [solvers.table(), _advice(solvers, error), ""]
    if grids is not None:
        text += [grids.table(), ""]
    text += [str(discretised or "discretisation error: needs even numbers of pixels"), ""]
    text.append(f"{'effects up to':24s} {'CPU [s]':>9s} {'adds':>9s}  operator applications")
    before = 0.0
    for one in effects:
        adds = one.seconds - before
        text.append(
            f"{one.name:24s} {one.seconds:9.4f} {adds:9.4f}  "
            f"{one.problem or one.n_operator_applications}"
        )
        before = one.seconds
    scalars: dict[str, tuple[Any, str]] = {}
    for found in (solvers, grids):
        for point in found.points if found is not None else ():
            key = f"{point.method} / {point.label}"
            scalars[f"{key} / error"] = (point.error, "-")
            scalars[f"{key} / seconds"] = (point.seconds, "s")
            scalars |= {f"{key} / {k}": (v, "-") for k, v in point.counts.items()}
    errors = discretised.errors if discretised is not None else {}
    scalars |= {f"discretisation error / {name}": (e, "-") for name, e in errors.items()}
    scalars |= {f"effects up to {e.name} / seconds": (e.seconds, "s") for e in effects}
    if out is None:
        return Report(scalars, "\n".join(text))
    write = partial(_write, solvers, grids, effects, out)
    draw = partial(_draw, solvers, grids, effects, out, scene.name or "contact")
    return Report(scalars, "\n".join(text), write, draw)


def _discretised(scene: ContactScene, accuracy: Accuracy) -> DiscretisationError | None:
    """Errors of the contact alone on its own grid; None where its pixels cannot be halved."""
    from ..contact.discretisation import discretisation_error

    try:
        return discretisation_error(_solved(contact_alone(scene), accuracy))
    except DescriptionError:
        return None


def _advice(found: WorkPrecision, error: float) -> str:
    try:
        best = found.cheapest(error)
    except InfeasibleError as problem:
        return str(problem)
    return (
        f"cheapest with an error of at most {error:g}: {best.method}, {best.label}, "
        f"{best.seconds:.4f} s"
    )


def contact_alone(scene: ContactScene) -> ContactScene:
    """The contact alone: compliance and hardness."""
    kept = tuple(e for e in scene.effects if isinstance(e, Compliance | PressureBound))
    return evolve(scene, effects=kept)


def _resolves(scene: ContactScene, accuracy: Accuracy) -> bool:
    """Whether the surfaces can be made on a grid: not if it is too coarse, or not their own."""
    from ..contact.grid import combined_heights, grid_of

    try:
        combined_heights(scene, grid_of(scene, accuracy))
    except DescriptionError:
        return False
    return True


def _smaller(scene: ContactScene, accuracy: Accuracy) -> Accuracy:
    """The same window on the fewest pixels that show the surfaces, of some to choose from."""
    fewer = (evolve(accuracy, grid=n) for n in _PIXELS)
    return next((a for a in fewer if a.shape < accuracy.shape and _resolves(scene, a)), accuracy)


def solver_sweep(scene: ContactScene, accuracy: Accuracy, progress: Progress) -> WorkPrecision:
    """Error of the pressure over the tolerance, for the three solvers.

    The error is that of the whole map, ``|p - p_ref|/|p_ref|`` in the 2-norm. The reference is
    the active-set method at its tightest; its own error is taken to be the distance to what the
    conjugate gradient finds at 1e-8.
    """
    import numpy as np

    bare, accuracy = _frozen(contact_alone(scene), _smaller(scene, accuracy))
    exact = _solved(bare, evolve(accuracy, rtol=1e-11)).pressure
    plain = evolve(accuracy, method="conjugate-gradient", rtol=1e-8)
    near = _solved(bare, plain).pressure
    size = float(np.linalg.norm(exact))
    floor = max(float(np.linalg.norm(near - exact)) / size, 1e-15)
    settings = []
    for method, tolerances in _TOLERANCES.items():
        patience = _Patience()
        settings += [
            Setting(
                method,
                f"rtol {rtol:.0e}",
                partial(patience.run, bare, evolve(accuracy, method=method, rtol=rtol), exact),
            )
            for rtol in tolerances
        ]
    return sweep(
        settings, size, quantity="pressure map", floor=floor, budget=0.5, progress=progress
    )


def _frozen(scene: ContactScene, accuracy: Accuracy) -> tuple[ContactScene, Accuracy]:
    """The same contact with its hardness as it comes out, so that each run is one solve."""
    limit = scene.effect(HardnessLimit)
    if limit is None or isinstance(limit.rule, ConstantHardness):
        return scene, accuracy
    found = _solved(scene, evolve(accuracy, rtol=1e-6)).of(HardnessLimit).hardness
    hardness = found if isinstance(found, float) else HardnessMap(found)
    constant = HardnessLimit(rule=ConstantHardness(hardness=hardness))
    kept = tuple(constant if e is limit else e for e in scene.effects)
    return evolve(scene, effects=kept), accuracy


class _Patience:
    """Runs of one solver, from loose to tight, until one takes too long."""

    def __init__(self) -> None:
        self.slowest = 0.0

    def run(self, scene: ContactScene, accuracy: Accuracy, exact: NDArray[np.float64]) -> Outcome:
        """Solve and judge, or say that a looser run took too long already."""
        if self.slowest > _MOST_SECONDS:
            raise ConvergenceError(f"not tried: a looser run took {self.slowest:.0f} s")
        begun = process_time()
        try:
            return _judged(scene, accuracy, exact)
        finally:
            self.slowest = max(self.slowest, process_time() - begun)


def _solved(scene: ContactScene, accuracy: Accuracy) -> ContactResult:
    from ..contact.solve import solve_unwarned

    return solve_unwarned(plan(scene, accuracy))


def _judged(scene: ContactScene, accuracy: Accuracy, exact: NDArray[np.float64]) -> Outcome:
    import numpy as np

    result = _solved(scene, accuracy)
    error = float(np.linalg.norm(result.pressure - exact) / np.linalg.norm(exact))
    return Outcome(error, _counts(result), error=error)


def _counts(result: ContactResult) -> dict[str, int]:
    return {
        "operator applications": result.work.n_operator_applications,
        "FFTs": result.work.n_ffts,
    }


def grid_sweep(scene: ContactScene, accuracy: Accuracy, progress: Progress) -> WorkPrecision | None:
    """Error of the real area of contact over the grid, against a grid of twice the pixels.

    The reference is the edge-corrected area on that grid; what it changes from the grid
    of the scene to that one is taken for its own error.

    None if the surfaces come with a grid of their own.
    """
    from scipy.fft import next_fast_len

    bare = contact_alone(scene)
    n = max(accuracy.shape)
    finest = evolve(accuracy, grid=2 * n)
    if not _resolves(bare, finest):
        return None
    exact = _solved(bare, finest).corrected_contact_area
    near = _solved(bare, evolve(accuracy, grid=n)).corrected_contact_area
    sizes = sorted({next_fast_len(round(n * fraction), real=True) for fraction in _FRACTIONS})
    grids = [evolve(accuracy, grid=size) for size in sizes]
    settings = [
        Setting(method, f"{one.grid} x {one.grid}", partial(_area, bare, one, name))
        for method, name in _AREAS.items()
        for one in grids
        if _resolves(bare, one)
    ]
    floor = max(abs(near / exact - 1.0), 1e-12)
    return sweep(
        settings, exact, quantity="contact area", floor=floor, repeats=0, progress=progress
    )


def _area(scene: ContactScene, accuracy: Accuracy, name: str) -> Outcome:
    result = _solved(scene, accuracy)
    return Outcome(getattr(result, name), _counts(result))


def _write(
    solvers: WorkPrecision,
    grids: WorkPrecision | None,
    effects: tuple[EffectCost, ...],
    out: Path,
) -> tuple[Path, ...]:
    from ..files.csv_rows import write_rows

    head = ("method", "setting", "error [-]", "seconds [s]")
    rows: list[tuple[str, str, float | str, float]] = []
    for found in (solvers, grids):
        points = found.points if found is not None else ()
        rows += [(p.method, p.label, p.error, p.seconds) for p in points]
    rows += [("effects up to", e.name, "", e.seconds) for e in effects]
    return (write_rows(out / "cost.csv", head, rows),)


def _draw(
    solvers: WorkPrecision,
    grids: WorkPrecision | None,
    effects: tuple[EffectCost, ...],
    out: Path,
    name: str,
) -> tuple[Path, ...]:
    from ..plot import cost as cost_plot
    from ..plot import style as plot

    made, axes = plot.figure(1, 2, size=(10.0, 4.8))
    if grids is not None:
        panels = [["solvers", "grids"], ["effects", "effects"]]
        ratios = {"height_ratios": (4.6, 0.8 + 0.35 * len(effects))}
        made, drawn = plot.mosaic(panels, size=(10.0, 5.6 + 0.4 * len(effects)), **ratios)
        axes = list(drawn.values())
    cost_plot.work_precision(solvers, axes[0], beside=False)
    plot.title(axes[0], f"{name}: tolerance")
    if grids is not None:
        cost_plot.work_precision(grids, axes[1], beside=False)
        plot.title(axes[1], "grid")
    plot.bars(
        [e.name for e in effects], [e.seconds for e in effects], axes[-1], "seconds of the solve"
    )
    plot.title(axes[-1], "effects, one after another")
    plot.letters(axes)
    return (plot.save(made, out / "cost"),)
