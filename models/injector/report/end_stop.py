"""Impacts of the spool on rough faces of its end stop: numbers of a run for the report."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

from ....analyses.load_displacement.impact import in_series
from ..scene import InjectorScene, end_stop_faces
from .cosimulation import InjectorRun

__all__ = ["EndStopImpacts", "end_stop_impacts", "end_stop_numbers"]

Numbers = tuple[list[str], dict[str, tuple[Any, str]]]


class EndStopImpacts(NamedTuple):
    """Impacts of a spool on its end stop in one run."""

    peak: float
    """Largest force [N], at the communication points."""
    depth: float
    """Maximum approach of spool and end stop [m]."""
    approach: float
    """Maximum approach of the rough faces alone [m]."""
    dissipated: float
    """Energy dissipated by the first impact [J]."""
    restitution: float
    """Coefficient of restitution of the first impact [-]."""
    plastic: float
    """Work of plastic deformation, all impacts [J]."""


def end_stop_impacts(scene: InjectorScene, run: InjectorRun) -> EndStopImpacts | None:
    """Impacts of a run; None if the end stop is a spring, or was not met and left."""
    curve, stop = end_stop_faces(scene.valve), scene.valve.stop
    events = {
        what: [e for e in run.monolithic.events if e.what == f"{what} the stop"]
        for what in ("meets", "leaves")
    }
    if curve is None or not (events["meets"] and events["leaves"]):
        return None
    came, left = events["meets"][0].speed, events["leaves"][0].speed
    depth = float(run.monolithic["gap"].max()) - stop.gap
    approach = in_series(curve, depth, 0.0, stop.stiffness, beyond=True)[1]
    # Magnet and spring push as much out as in: the gap is the same.
    dissipated = 0.5 * (scene.loading.mass or 0.0) * (came * came - left * left)
    plastic = curve.dissipated_work(min(approach, curve.max_approach))
    peak = float(run.coupled["F_stop"].max())
    return EndStopImpacts(peak, depth, approach, dissipated, abs(left / came), plastic)


def end_stop_numbers(
    scene: InjectorScene, runs: Sequence[InjectorRun], keys: Sequence[str]
) -> Numbers:
    """Lines and scalars of all runs; none if the end stop is a spring."""
    lines, scalars = list[str](), dict[str, tuple[Any, str]]()
    curve = end_stop_faces(scene.valve)
    if curve is None:
        return lines, scalars
    for run, key in zip(runs, keys, strict=True):
        found = end_stop_impacts(scene, run)
        if found is None:
            lines.append(f"stop, {run.label}: never met")
            continue
        beyond = " BEYOND THE TABLES" if found.approach > curve.max_approach else ""
        lines.append(
            f"stop, {run.label}: at most {found.peak:.1f} N, {found.depth * 1e6:.3f} um deep, of "
            f"which the faces {found.approach * 1e9:.1f} nm{beyond}; the first impact dissipates "
            f"{found.dissipated * 1e6:.1f} uJ, coefficient of restitution "
            f"{found.restitution:.3f}; plastic work {found.plastic * 1e6:.2f} uJ"
        )
        scalars |= {
            f"stop_peak_force_{key}": (found.peak, "N"),
            f"stop_depth_{key}": (found.depth, "m"),
            f"stop_faces_approach_{key}": (found.approach, "m"),
            f"stop_energy_dissipated_{key}": (found.dissipated, "J"),
            f"stop_restitution_{key}": (found.restitution, "-"),
            f"stop_plastic_work_{key}": (found.plastic, "J"),
        }
    return ["", *lines], scalars
