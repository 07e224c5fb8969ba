"""Fit of a scene to measured curves: `fit`."""

from __future__ import annotations

import math
import time
import warnings
from collections.abc import Mapping, Sequence
from contextlib import suppress
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from attrs import evolve
from scipy.stats import qmc

from ..accuracy import Accuracy
from ..errors import ContactkitError, ConvergenceError, DescriptionError, ValidityWarning
from ..numerics.blas import one_thread
from ..planning import plan, run
from ..scene.scenes import Scene
from ..studies.paths import changed
from ..studies.study import check_whole
from ..validity import ValidityNumber, note_worst
from .data import MeasuredBound, MeasuredCurve, by_curve
from .fitted import FittedCurve, FittedParameter, FitWork, Searched, short_names
from .intervals import (
    BetterFitError,
    Interval,
    Linear,
    interval,
    level_factor,
    linearised,
    places_of_ends,
)
from .model import Model
from .outcomes import Solve, outcome_of, solver_of
from .parameters import scene_parameters
from .result import Fit
from .runs import Solver
from .search import Found, Problem, minimum
from .verdict import decided_by, goodness, undecided, verdict_of

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

__all__ = ["fit"]

Intervals = Literal["auto", "profile", "linear"]

# Curves of a separation ten times finer than the standard: its error then is below a noise of 1 %
# over two decades of a force, for 4 % more points (200 to 208 of a film).
_ACCURACY = Accuracy(curve_rtol=1e-4)
# Change of an estimated noise at which it is taken to be found: 1 % of it is 1 % of an interval.
_SAME_NOISE = 0.01
_MOST_NOISES = 12
_LEAST_NOISE = 1e-12  # over the readings: of data without noise
_MOST_RESTARTS = 3  # from a better fit that a profile came to
_STATISTICS = (
    "least squares: Branch, Coleman and Li 1999, as in scipy.optimize",
    "profile likelihood: Venzon and Moolgavkar 1988",
)


def fit(
    scene: Any,
    data: MeasuredCurve | MeasuredBound | Sequence[MeasuredCurve | MeasuredBound],
    parameters: Mapping[Any, Any],
    accuracy: Accuracy | None = None,
    *,
    nuisance: Mapping[str, Any] | None = None,
    solve: Solve | None = None,
    intervals: Intervals = "auto",
    starts: int = 1,
    workers: int = 1,
) -> Fit:
    r"""Fit parameters of a scene to measured curves, and state what the data decide.

    The sum of the squares of all residuals over their noise,

    .. math:: \chi^2 = \sum_k (y_k - m_k(\theta))^2/\sigma_k^2,

    is least at the fitted values. Parameters whose range spans a decade or more are fitted by their
    logarithms. An interval is of the covariance where chi^2 rises to its ends as that has it, to
    20 %; else of the profile likelihood, the least chi^2 over the other parameters.

    Parameters
    ----------
    scene : ContactScene, SeparationScene or SlidingScene, or that of a device
        The scene; a value of it that lies in the range of its parameter is where the search starts.
    data : MeasuredCurve, MeasuredBound or a sequence of them
        What was measured; each curve may set fields of the scene.
    parameters : mapping of str or tuple of str to Range or Prior
        What is sought, by path as in `study`; several paths have one value.
    accuracy : Accuracy, optional
        Settings of the runs; the standard with ``curve_rtol=1e-4`` if not given.
    nuisance : mapping of str to Range or Prior, optional
        ``shift``, ``zero``, ``scale`` or ``stiffness`` that all curves have in common; numbers are
        in SI units. Those of one curve belong to the curve.
    solve : callable, optional
        Takes a scene and returns what is compared: a result, a curve of an analysis such as
        ``lambda scene: ck.pull_off_curve(ck.plan(scene), approaches)``, numbers by name with their
        units, or a number. If not given the scene is planned and run, a device reported.
    intervals : {"auto", "profile", "linear"}
        Where the intervals come from.
    starts : int
        Searches from so many starts, of a Latin hypercube but for the first; the best is kept.
    workers : int
        Number of processes, as in `study`: for readings that are runs of their own, several curves,
        and differences. The result is the same to the last bit for any number.

    Returns
    -------
    Fit
        Values with 68 % intervals, and the verdict on each.

    Raises
    ------
    DescriptionError
        If a path, a quantity or a unit does not fit, a curve reaches beyond the run, or there are
        fewer data than parameters.
    ContactkitError
        If the scene has no result where the search starts, or the search fails.

    Notes
    -----
    Left out: errors of the positions, correlated noise, and what the model lacks; the runs of signs
    of the residuals in `Fit.validity` state where neighbours agree more than noise would. Where a
    force jumps, as at a rupture, chi^2 has steps in the parameters that move the jump: cut the
    curve there and give the jump as a `MeasuredBound`.

    Examples
    --------
    The viscosity of an oil from the force on a sphere that is drawn off a flat, where the zero of
    the gap is not known:

    >>> import contactkit as ck
    >>> import numpy as np
    >>> oil = ck.Liquid(name="oil", viscosity=0.1)
    >>> scene = ck.SeparationScene(
    ...     interface=ck.Interface(upper=ck.Sphere(radius=1e-3), meniscus=ck.Meniscus(liquid=oil)),
    ...     loading=ck.ImposedSpeed(speed=1e-5, initial_gap=0.5e-6, final_gap=3e-5),
    ...     effects=(ck.ViscousForce(),),
    ... )
    >>> gap = np.linspace(2e-6, 2e-5, 40)
    >>> force = 6.0 * np.pi * 0.2 * 1e-3**2 * 1e-5 / gap
    >>> curve = ck.MeasuredCurve(over="gap", at=gap, quantity="viscous_force", values=force,
    ...     noise="1 %", shift=ck.Range("-1 um", "1 um"))
    >>> found = ck.fit(scene, curve,
    ...     {"interface.meniscus.liquid.viscosity": ck.Range("10 mPa.s", "10 Pa.s")})
    >>> found["viscosity"].text, found.status
    ('200 mPa.s (199.5 to 200.5)', 'decided')
    """
    begun = time.perf_counter()
    settings = accuracy if accuracy is not None else _settings(scene)
    check_whole("starts", starts, 1)
    check_whole("workers", workers, 1)
    if intervals not in ("auto", "profile", "linear"):
        raise DescriptionError("intervals", intervals, "be 'auto', 'profile' or 'linear'")
    solver = solver_of(scene, settings, solve)
    sought = scene_parameters(scene, settings, parameters)
    has_slopes = solve is None and isinstance(scene, Scene)
    model = Model(Solver(scene, settings, solver, has_slopes), sought, _data(data), nuisance or {})
    n_data, count = _checked(model, parameters), _Count()
    start = np.array([one.scaled(one.start) for one in model.parameters])
    with model.runs.workers(workers), one_thread():
        noise, best = _searched(model, start, n_data, starts, count)
        found = _intervals(model, noise, best, n_data, intervals, count)
    problem, best, linear, ends, factor = found
    work = FitWork(model.runs.n, count.n, time.perf_counter() - begun)
    return _result(problem, best, linear, ends, (factor, n_data, work))


def _checked(model: Model, given: Any) -> int:
    """Number of data, priors among them; fewer than parameters are refused."""
    sought = model.parameters
    if not sought:
        raise DescriptionError("parameters", given, "name at least one field and its range")
    n = sum(curve.y.size for curve in model.curves) + sum(p.prior is not None for p in sought)
    if n + len(model.bounds) < len(sought):
        hint = "hold some of them, or give a Prior of what is known"
        raise DescriptionError("data", n, f"be at least {len(sought)}, one a parameter", hint=hint)
    return n


class _Count:
    """Counter of evaluations."""

    def __init__(self) -> None:
        self.n = 0

    def __call__(self) -> None:
        self.n += 1


def _settings(scene: Any) -> Accuracy:
    is_curve = isinstance(scene, Scene) and "curve_rtol" in scene.reads
    return _ACCURACY if is_curve else Accuracy.standard


def _data(given: Any) -> tuple[tuple[MeasuredCurve, ...], tuple[MeasuredBound, ...]]:
    """Curves and bounds apart; curves without a name of their own are counted."""
    parts = list(given) if isinstance(given, Sequence) else [given]
    for one in parts:
        if not isinstance(one, MeasuredCurve | MeasuredBound):
            hint = "ck.MeasuredCurve(over=..., at=..., quantity=..., values=...)"
            raise DescriptionError("data", one, "be a MeasuredCurve or a MeasuredBound", hint=hint)
    curves = [one for one in parts if isinstance(one, MeasuredCurve)]
    if len(curves) > 1:
        curves = [
            evolve(one, name=f"data {i}") if one.name == "data" else one
            for i, one in enumerate(curves, 1)
        ]
    if not curves:
        raise DescriptionError("data", given, "have at least one MeasuredCurve")
    names = [one.name for one in curves]
    for name in names:
        if names.count(name) > 1:
            raise DescriptionError("MeasuredCurve.name", name, "be that of one curve")
    return tuple(curves), tuple(one for one in parts if isinstance(one, MeasuredBound))


def _searched(
    model: Model, start: Floats, n_data: int, starts: int, count: _Count
) -> tuple[tuple[float, ...], Found]:
    """Noise of each curve and the minimum; where noise is estimated, in turn."""
    first = Problem(model, [1.0] * len(model.curves), count)
    first.strict_residuals(start)  # what is refused, or has no solution, is raised
    noise = tuple(
        0.05 * float(np.sqrt(np.mean((c.y / d) ** 2))) + 1e-300 if c.is_estimated else 1.0
        for c, d in zip(model.curves, model.deviations, strict=True)
    )
    best = _best_of(Problem(model, noise, count), start, starts)
    for _ in range(_MOST_NOISES):
        again = _noise(Problem(model, noise, count), best, n_data)
        if all(abs(a / b - 1.0) <= _SAME_NOISE for a, b in zip(again, noise, strict=True)):
            break
        noise = again
        best = minimum(Problem(model, noise, count), best.place)
    return noise, minimum(Problem(model, noise, count), best.place, is_central=True)


def _best_of(problem: Problem, start: Floats, starts: int) -> Found:
    """Best of some searches; those of others than the first may fail."""
    best = minimum(problem, start)
    if starts > 1:
        sampler = qmc.LatinHypercube(start.size, rng=np.random.default_rng(0))
        for point in sampler.random(starts - 1):
            try:
                found = minimum(problem, problem.ends[0] + point * problem.width)
            except ContactkitError:
                continue
            best = min(best, found, key=lambda one: one.chi2)
    return best


def _noise(problem: Problem, best: Found, n_data: int) -> tuple[float, ...]:
    """Noise of each curve from its residuals, each with its part of the degrees of freedom."""
    found = []
    free = max(1.0 - len(problem.width) / n_data, 1.0 / n_data)
    model = problem.model
    *parts, _ = by_curve(model.curves, best.residuals)
    rows = zip(model.curves, model.deviations, problem.noise, parts, strict=True)
    for curve, shape, factor, part in rows:
        size = float(np.sqrt(np.mean((curve.y / shape) ** 2)))
        estimate = math.sqrt(float(np.mean((part * factor) ** 2)) / free)
        found.append(max(estimate, _LEAST_NOISE * size) if curve.is_estimated else factor)
    return tuple(found)


def _intervals(
    model: Model,
    noise: tuple[float, ...],
    best: Found,
    n_data: int,
    method: Intervals,
    count: _Count,
) -> tuple[Problem, Found, Linear, tuple[Interval, ...], float]:
    """Intervals of all parameters; anew from a better fit, if a profile comes to one."""
    for _ in range(_MOST_RESTARTS):
        problem = Problem(model, noise, count)
        linear = linearised(problem, best.place)
        if not linear.singular[0] > 0.0:
            hint = "is the effect that they belong to among the effects of the scene?"
            names = ", ".join(one.name for one in model.parameters)
            raise DescriptionError("parameters", names, "change what was measured", hint=hint)
        factor = level_factor(problem, n_data)
        if method != "profile":
            problem.ahead(places_of_ends(problem, best, linear, factor))
        try:
            ends = tuple(
                interval(problem, best, linear, i, factor, method)
                for i in range(len(model.parameters))
            )
        except BetterFitError as error:
            best = minimum(problem, error.place, is_central=True)
            noise = _noise(problem, best, n_data)
            continue
        return problem, best, linear, ends, factor
    raise ConvergenceError(
        f"{_MOST_RESTARTS} times a profile came to a better fit: chi^2 has several minima; give "
        "starts=10, narrower ranges, or intervals='linear'"
    )


def _result(
    problem: Problem,
    best: Found,
    linear: Linear,
    ends: Sequence[Interval],
    more: tuple[float, int, FitWork],
) -> Fit:
    factor, n_data, work = more
    model, values = problem.model, problem.values(best.place)
    fractions = linear.fractions()
    names = [one.name for one in model.parameters]
    units = model.units[: len(model.curves)]
    others = [one.name for one in model.bounds]
    others += [f"the prior of {one.name}" for one in model.parameters if one.prior is not None]
    has_slope = np.linalg.norm(linear.slopes, axis=0) > 0.0
    fitted = []
    for i, (one, end) in enumerate(zip(model.parameters, ends, strict=True)):
        low, high = one.value(end.low.place), one.value(end.high.place)
        verdict = verdict_of(end, one, names, bool(has_slope[i]))
        by = ""
        if verdict.startswith("decided"):
            by = decided_by(model.curves, [unit[0] for unit in units], others, fractions[:, i])
        found = FittedParameter(
            one.name, one.unit, values[i], low, high, (one.low, one.high), verdict, by,
            end.is_profile, one.is_log, one.reason,
        )  # fmt: skip
        fitted.append(found)
    curves = _curves(problem, best, values, units, fractions)
    dof = n_data - len(names)
    good = goodness(
        best.chi2,
        dof,
        [(c, f.residuals) for c, f in zip(model.curves, curves, strict=True)],
        problem.solver_error(best.place),
    )
    validity, sources = _stated(model, values)
    return Fit(
        changed(model.scene, model.accuracy, model.changes(values)).scene,
        model.accuracy,
        tuple(fitted),
        curves,
        linear.correlation(problem.width),
        best.chi2,
        dof,
        _aicc(problem, best, n_data),
        tuple(undecided(model.parameters, values, linear, factor)),
        (*good, *validity),
        (*sources, *_STATISTICS),
        work,
        best.has_converged,
        _slopes_text(problem),
        Searched(problem, best, linear, factor),
    )


def _slopes_text(problem: Problem) -> str:
    """Which derivatives were exact, and which were differences of whole runs."""
    names = short_names([one.name for one in problem.model.parameters])
    pairs = list(zip(names, problem.exact, strict=True))
    exact = ", ".join(name for name, is_exact in pairs if is_exact)
    others = ", ".join(name for name, is_exact in pairs if not is_exact)
    parts = (
        f"exact for {exact}" if exact else "",
        f"by differences for {others}" if others else "",
    )
    return ", ".join(filter(None, parts))


def _curves(
    problem: Problem,
    best: Found,
    values: Sequence[float],
    units: Sequence[tuple[str, str]],
    fractions: Floats,
) -> tuple[FittedCurve, ...]:
    predicted, found = problem.model.predict(values), []
    *parts, _ = by_curve(problem.model.curves, fractions)
    for i, curve in enumerate(problem.model.curves):
        deviation = problem.model.deviations[i] * problem.noise[i]
        found.append(
            FittedCurve(
                curve.name,
                curve.over,
                curve.quantity,
                units[i],
                curve.x,
                curve.y,
                predicted.readings[i],
                deviation,
                curve.is_estimated,
                parts[i],
            )
        )
    return tuple(found)


def _stated(
    model: Model, values: Sequence[float]
) -> tuple[tuple[ValidityNumber, ...], tuple[str, ...]]:
    """Worst validity numbers and all sources of the fitted runs.

    Where curves of an analysis state none, those of the fitted scene itself, which is run once.
    """
    worst, sources = dict[str, ValidityNumber](), dict[str, None]()
    outcomes = model.outcomes(values)
    if isinstance(model.scene, Scene) and not any(one.validity for one in outcomes):
        scene = changed(model.scene, model.accuracy, model.changes(values)).scene
        with suppress(ContactkitError), warnings.catch_warnings():
            warnings.simplefilter("ignore", ValidityWarning)
            outcomes.append(outcome_of(run(plan(scene, model.accuracy)), ()))
    for outcome in outcomes:
        note_worst(worst, outcome.validity)
        sources |= dict.fromkeys(outcome.sources)
    return tuple(worst.values()), tuple(sources)


def _aicc(problem: Problem, best: Found, n_data: int) -> float:
    """Akaike's criterion with the correction of Hurvich and Tsai (1989) for few data.

    Readings with an estimated noise have its most likely value, without degrees of freedom.
    """
    total, model = 0.0, problem.model
    *parts, rest = by_curve(model.curves, best.residuals)
    rows = zip(model.curves, model.deviations, problem.noise, parts, strict=True)
    for curve, shape, factor, part in rows:
        scale = factor
        if curve.is_estimated:
            scale *= max(math.sqrt(float(np.mean(part**2))), 1e-150)
            part = part * (factor / scale)
        deviation = shape * scale
        total += float(part @ part) + float(np.sum(np.log(2.0 * math.pi * deviation**2)))
    total += float(rest @ rest)
    k = len(problem.width) + sum(curve.is_estimated for curve in model.curves)
    left = n_data - k - 1
    return total + 2.0 * k + 2.0 * k * (k + 1) / left if left > 0 else math.inf
