"""Impacts of spring tips on rough landing sites: numbers of a run for the report."""

from __future__ import annotations

from typing import Any

from ..scene import MicromirrorScene
from .cosimulation import FmuRun, MirrorRun

__all__ = ["landing_numbers"]

Numbers = tuple[list[str], dict[str, tuple[Any, str]]]


def landing_numbers(scene: MicromirrorScene, run: MirrorRun | FmuRun) -> Numbers:
    """Lines and scalars of the landings; none if the sites are rigid."""
    if scene.stop is None:
        return [], {}
    worst = {name: max(side[name] for side in run.sites) for name in ("d_max", "F_max")}
    sums = {name: sum(side[name] for side in run.sites) for name in ("W_land", "W_plastic")}
    impacts = sum(side["n_land"] for side in run.sites)
    per_impact = sums["W_land"] / (scene.mirror.tips.per_side * impacts) if impacts else 0.0
    lines = [
        f"landing sites: at most {worst['F_max'] * 1e9:.0f} nN and {worst['d_max'] * 1e9:.2f} nm "
        f"under a tip; {impacts:.0f} impacts, {per_impact * 1e18:.1f} aJ each on average, together "
        f"{sums['W_land'] * 1e15:.3f} fJ, of which plastic {sums['W_plastic'] * 1e15:.3f} fJ"
    ]
    return lines, {
        "landing_peak_force": (worst["F_max"], "N"),
        "landing_depth": (worst["d_max"], "m"),
        "landing_impacts": (impacts, "-"),
        "landing_energy_per_impact": (per_impact, "J"),
        "landing_energy_dissipated": (sums["W_land"], "J"),
        "landing_plastic_work": (sums["W_plastic"], "J"),
    }
