"""What rough faces of a stop or a landing did in a run: words and numbers for the reports."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

from ..analyses.load_displacement.impact import in_series
from .injector.run import stop_curve_of

if TYPE_CHECKING:
    from ..models.micromirror.scene import MicromirrorScene
    from .injector.run import InjectorScene, Run
    from .micromirror.run import FmuRun, MirrorRun

__all__ = ["ValveBlows", "landing_numbers", "valve_blows", "valve_numbers"]

Numbers = tuple[list[str], dict[str, tuple[Any, str]]]


class ValveBlows(NamedTuple):
    """Blows of a spool on its stop in one run."""

    peak: float
    """Largest force [N], at the communication points."""
    depth: float
    """Largest way into the stop [m]."""
    approach: float
    """That of the faces alone [m]."""
    lost: float
    """Energy that the first blow loses [J]."""
    kept: float
    """Speed at which the spool leaves the stop over that at which it came, first blow [-]."""
    yielded: float
    """Work that yielding took in all [J]."""


def valve_blows(scene: InjectorScene, run: Run) -> ValveBlows | None:
    """Blows of a run on rough faces; None if the stop is a spring or was never met and left."""
    curve, stop = stop_curve_of(scene.valve), scene.valve.stop
    events = {
        what: [e for e in run.whole.events if e.what == f"{what} the stop"]
        for what in ("meets", "leaves")
    }
    if curve is None or not (events["meets"] and events["leaves"]):
        return None
    came, left = events["meets"][0].speed, events["leaves"][0].speed
    depth = float(run.whole.gap.max()) - stop.gap
    approach = in_series(curve, depth, 0.0, stop.stiffness, beyond=True)[1]
    # Magnet and spring push as much out as in: the gap is the same.
    lost = 0.5 * (scene.opening.mass or 0.0) * (came * came - left * left)
    taken = curve.lost(min(approach, curve.most))
    peak = float(run.coupled["F_stop"].max())
    return ValveBlows(peak, depth, approach, lost, abs(left / came), taken)


def valve_numbers(scene: InjectorScene, runs: Sequence[Run], keys: Sequence[str]) -> Numbers:
    """Lines and scalars of all runs; none if the stop is a spring."""
    lines, scalars = list[str](), dict[str, tuple[Any, str]]()
    curve = stop_curve_of(scene.valve)
    if curve is None:
        return lines, scalars
    for run, key in zip(runs, keys, strict=True):
        found = valve_blows(scene, run)
        if found is None:
            lines.append(f"stop, {run.label}: never met")
            continue
        beyond = " BEYOND THE TABLES" if found.approach > curve.most else ""
        lines.append(
            f"stop, {run.label}: at most {found.peak:.1f} N, {found.depth * 1e6:.3f} um deep, of "
            f"which the faces {found.approach * 1e9:.1f} nm{beyond}; the first blow loses "
            f"{found.lost * 1e6:.1f} uJ and leaves {found.kept:.3f} of the speed; yielding took "
            f"{found.yielded * 1e6:.2f} uJ"
        )
        scalars |= {
            f"stop_peak_force_{key}": (found.peak, "N"),
            f"stop_depth_{key}": (found.depth, "m"),
            f"stop_faces_approach_{key}": (found.approach, "m"),
            f"stop_energy_lost_{key}": (found.lost, "J"),
            f"stop_speed_kept_{key}": (found.kept, "-"),
            f"stop_yield_work_{key}": (found.yielded, "J"),
        }
    return ["", *lines], scalars


def landing_numbers(scene: MicromirrorScene, run: MirrorRun | FmuRun) -> Numbers:
    """Lines and scalars of the landings; none if the sites are rigid."""
    if scene.stop is None:
        return [], {}
    worst = {name: max(side[name] for side in run.sites) for name in ("d_max", "F_max")}
    sums = {name: sum(side[name] for side in run.sites) for name in ("W_land", "W_plastic")}
    blows = sum(side["n_land"] for side in run.sites)
    per_blow = sums["W_land"] / (scene.mirror.tips.per_side * blows) if blows else 0.0
    lines = [
        f"landing sites: at most {worst['F_max'] * 1e9:.0f} nN and {worst['d_max'] * 1e9:.2f} nm "
        f"under a tip; {blows:.0f} blows, in the mean {per_blow * 1e18:.1f} aJ each; all tips lost "
        f"{sums['W_land'] * 1e15:.3f} fJ there, of which yielding {sums['W_plastic'] * 1e15:.3f} fJ"
    ]
    return lines, {
        "landing_peak_force": (worst["F_max"], "N"),
        "landing_depth": (worst["d_max"], "m"),
        "landing_blows": (blows, "-"),
        "landing_energy_per_blow": (per_blow, "J"),
        "landing_energy_lost": (sums["W_land"], "J"),
        "landing_yield_work": (sums["W_plastic"], "J"),
    }
