"""Work-precision of the closures of a liquid bridge: exact, arc, as published.

The reference is another method than those judged: Legendre's integrals for the force, and the
largest gap along them for the rupture.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ....as_published.printed import common as published
from ....capillary.arc import flat as arc_flat
from ....capillary.arc import sphere as arc_sphere
from ....capillary.exact import stability as bridge_limit
from ....capillary.exact.bridge import bridge
from ....errors import InfeasibleError
from ....export.report import Report
from ....reference import elliptic_bridge
from ....work_precision import Outcome, Point, Setting, WorkPrecision, sweep
from ...library import bundled_device
from ..closure_errors import relative_errors
from ..scene import BridgeCase, Bridges

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

__all__ = ["CLOSURES", "FLOOR", "bridge_cost", "force_study", "rupture_study"]

Progress = Callable[[float], None]

CLOSURES = ("exact", "arc", "as published")
FLOOR = 1e-12  # against 50 digits: tests/capillary/test_elliptic_bridge.py
_JUDGED = 9  # gaps at which the reference is asked


class _Curve(NamedTuple):
    """A bridge of unit volume on its way to rupture, with the reference at some of the gaps."""

    case: BridgeCase
    gaps: Array
    judged: NDArray[np.intp]
    forces: Array
    limit: float


def _curve(case: BridgeCase, n: int, reach: float) -> _Curve:
    shape = (case.contact_angle_lower, case.contact_angle_upper, case.curvature)
    limit = elliptic_bridge.longest(*shape).gap
    gaps = np.linspace(0.02, reach, n) * limit
    judged = np.unique(np.linspace(0, n - 1, _JUDGED).round().astype(np.intp))
    right = elliptic_bridge.at_gaps(gaps[judged].tolist(), *shape)
    return _Curve(case, gaps, judged, np.array([one.force for one in right]), limit)


def _force(case: BridgeCase, closure: str, gaps: Array) -> Array:
    """Force over surface tension of a bridge of unit volume, by a closure."""
    lower, upper, bend = case.contact_angle_lower, case.contact_angle_upper, case.curvature
    if closure == "exact":
        return bridge(gaps, 1.0, lower, upper, 0.0, bend).force
    if bend:
        profile = "sphere" if closure == "arc" else "parabola"
        state = arc_sphere.solve(gaps, 1.0, lower, upper, 0.0, bend, profile)
        if closure == "arc":
            return np.asarray(state.force)
        return np.asarray(published.meniscus_sphere_3_12(state, 1.0, upper))
    shape = arc_flat.shape(lower, upper)
    radius = arc_flat.contact_radius(shape, gaps, 1.0)
    if closure == "arc":
        return np.asarray(arc_flat.force(shape, gaps, radius))
    above = arc_flat.upper_contact_radius(shape, gaps, radius)
    return np.asarray(published.meniscus_flat_3_11(above, gaps, 1.0, lower, upper, "upper"))


def _run_forces(curve: _Curve, closure: str, is_first: bool) -> Outcome:
    if is_first:
        _clear_caches()
    found = _force(curve.case, closure, curve.gaps)
    errors = relative_errors(found[curve.judged], curve.forces)
    return Outcome(float(found[0]), {"gaps": found.size}, float(errors.max()))


def _run_one(curve: _Curve, closure: str) -> Outcome:
    i = curve.judged[len(curve.judged) // 2]
    found = _force(curve.case, closure, curve.gaps[i : i + 1])
    right = curve.forces[len(curve.judged) // 2]
    return Outcome(float(found[0]), {"gaps": 1}, float(relative_errors(found, right).max()))


def _run_rupture(curve: _Curve, closure: str) -> Outcome:
    case = curve.case
    shape = (case.contact_angle_lower, case.contact_angle_upper, 0.0, case.curvature)
    if closure == "exact":
        _clear_caches()
        gap = float(bridge_limit.stability_limit(1.0, *shape).gap)
    else:
        profile = "sphere" if closure == "arc" else "parabola"
        gap = float(arc_sphere.zero_neck_gap(1.0, *shape, profile=profile))
    return Outcome(gap, {"gaps": 1}, abs(gap / curve.limit - 1.0))


def _clear_caches() -> None:
    """Drop the curves of bridges that the exact kernel remembers, so that a first run is timed."""
    bridge_limit.branch.cache_clear()


def force_points(curves: Sequence[_Curve], progress: Progress) -> WorkPrecision:
    """Error of the force and seconds for each gap, by closure, bridge and number of gaps."""
    settings = []
    for curve in curves:
        n = curve.gaps.size
        for closure in CLOSURES:
            is_model, name = closure != "exact", curve.case.label
            many = partial(_run_forces, curve, closure, False)
            settings.append(Setting(closure, f"{name}, {n} gaps", many, is_model))
            if closure == "exact":
                first = partial(_run_forces, curve, closure, True)
                settings.append(Setting(closure, f"{name}, {n} gaps, first time", first))
            one = partial(_run_one, curve, closure)
            settings.append(Setting(closure, f"{name}, one gap", one, is_model))
    found = sweep(settings, 1.0, quantity="force", floor=FLOOR, budget=0.3, progress=progress)
    points = tuple(
        Point(
            p.method,
            p.label,
            p.error,
            p.seconds / p.counts["gaps"],
            p.counts,
            p.problem,
            p.is_model,
        )
        for p in found.points
    )
    return WorkPrecision(found.quantity, found.reference, found.floor, points)


def force_study() -> list[Point]:
    """Error of the force of the shipped bridges, and CPU seconds for each gap."""
    return list(force_points(_curves(_shipped()), lambda done: None).points)


def rupture_study() -> list[Point]:
    """Error of the rupture distance of the shipped bridges, and CPU seconds of each."""
    return list(rupture_points(_curves(_shipped()), lambda done: None).points)


def _shipped() -> Bridges:
    scene = bundled_device("bridges")
    assert isinstance(scene, Bridges)
    return scene


def _curves(scene: Bridges) -> list[_Curve]:
    return [_curve(case, scene.gaps, scene.reach) for case in scene.bridges]


def rupture_points(curves: Sequence[_Curve], progress: Progress) -> WorkPrecision:
    """Error of the rupture distance and its seconds, by closure and bridge."""
    settings = [
        Setting(
            closure, curve.case.label, partial(_run_rupture, curve, closure), closure != "exact"
        )
        for curve in curves
        for closure in CLOSURES
    ]
    return sweep(
        settings, 1.0, quantity="rupture distance", floor=FLOOR, budget=0.3, progress=progress
    )


def bridge_cost(scene: Bridges, out: Path | None, error: float, progress: Progress) -> Report:
    """Measure the closures of all bridges: a table, numbers, and a picture and a CSV file."""
    curves = _curves(scene)
    progress(0.3)
    forces = force_points(curves, lambda done: progress(0.3 + 0.5 * done))
    ruptures = rupture_points(curves, lambda done: progress(0.8 + 0.2 * done))
    lines: list[str] = []
    scalars: dict[str, tuple[float, str]] = {}
    for found in (forces, ruptures):
        each = "gap" if found is forces else "bridge"
        lines += [f"{found.quantity}: CPU time, for each {each}", *_rows(found)]
        for p in found.points:
            key = f"{found.quantity} / {p.method} / {p.label}"
            scalars |= {f"{key} / error": (p.error, "-"), f"{key} / seconds": (p.seconds, "s")}
        lines.append(_advice(found, error))
    text = "\n".join(lines)
    if out is None:
        return Report(scalars, text)
    both = (forces, ruptures)
    return Report(scalars, text, partial(_write, both, out), partial(_draw, both, scene, out))


def _rows(found: WorkPrecision) -> list[str]:
    wide = max(len(p.label) for p in found.points)
    return [
        f"  {p.method:13s} {p.label:{wide}s} {p.error:9.1e} {1e6 * p.seconds:12.2f} us"
        for p in found.points
    ]


def _advice(found: WorkPrecision, error: float) -> str:
    """The cheapest closure that is good enough for every bridge."""
    worst, seconds = {}, {}
    for closure in CLOSURES:
        points = [p for p in found.points if p.method == closure and "first" not in p.label]
        worst[closure] = max((p.error if math.isfinite(p.error) else math.inf) for p in points)
        seconds[closure] = max(p.seconds for p in points)
    good = [closure for closure in CLOSURES if worst[closure] <= error]
    if not good:
        best = min(CLOSURES, key=lambda closure: worst[closure])
        raise InfeasibleError(
            f"no closure gives the {found.quantity} to {error:g}; the best is {best}, with "
            f"{worst[best]:.2g}"
        )
    name = min(good, key=lambda closure: seconds[closure])
    return (
        f"  cheapest with an error of at most {error:g} of the {found.quantity} on every bridge: "
        f"{name} ({worst[name]:.1e})"
    )


def _write(found: Sequence[WorkPrecision], out: Path) -> tuple[Path, ...]:
    from ....files.csv_rows import write_rows

    head = ("quantity", "closure", "bridge", "error [-]", "seconds for each gap or bridge [s]")
    rows = [
        (one.quantity, p.method, p.label, p.error, p.seconds) for one in found for p in one.points
    ]
    return (write_rows(out / "cost.csv", head, rows),)


def _draw(found: Sequence[WorkPrecision], scene: Bridges, out: Path) -> tuple[Path, ...]:
    from ....plot import cost as cost_plot
    from ....plot import style as plot

    rows = len(scene.bridges)
    made, axes = plot.figure(1, 2, size=(10.0, 1.6 + 0.75 * rows), sharey=True)
    names = [case.label for case in scene.bridges]
    for one, ax in zip(found, axes, strict=True):
        cost_plot.closures(one, ax, names)
    plot.title(axes[0], f"{scene.name}: force, up to {scene.reach:g} of the limit")
    plot.title(axes[1], "rupture distance")
    axes[1].tick_params(labelleft=False)
    plot.letters(axes)
    plot.shared_legend(made, axes[0])
    return (plot.save(made, out / "cost"),)
