"""Figures of contacts under adhesion: load and area over the approach, with jumps."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from ..analyses.pull_off import AdhesiveBranch, PullOffCurve
from .axis_units import axis_unit
from .style import Axes, figure

__all__ = ["contact_area", "pull_off_curve"]

_BRANCHES = (("approach", "#1f4e79"), ("separation", "#c1440e"))


def pull_off_curve(curve: PullOffCurve, ax: Axes | None = None) -> Axes:
    """Draw the load over the approach of both branches; jumps are dotted.

    Parameters
    ----------
    curve : PullOffCurve
        Of `contactkit.pull_off_curve`.
    ax : Axes, optional
        Where to draw; a new figure if not given.

    Examples
    --------
    ``plot.adhesion.pull_off_curve(curve).figure.savefig("curve.png")``
    """
    ax = ax if ax is not None else figure()[1]
    largest = max(float(np.abs(one.load).max()) for one in _branches(curve))
    factor, unit = axis_unit(largest, "N")
    return _draw(curve, ax, "load", 1.0 / factor, f"load [{unit}]")


def contact_area(curve: PullOffCurve, ax: Axes | None = None) -> Axes:
    """Draw the contact area over the approach of both branches; jumps are dotted."""
    ax = ax if ax is not None else figure()[1]
    area = curve.plan.grid.area
    return _draw(curve, ax, "contact_area", 100.0 / area, "contact area [% of the window]")


def _branches(curve: PullOffCurve) -> Sequence[AdhesiveBranch]:
    return curve.approaching, curve.separating


def _draw(curve: PullOffCurve, ax: Axes, column: str, factor: float, label: str) -> Axes:
    span = float(np.ptp(curve.approaching.approach))
    length, unit = axis_unit(span, "m")
    for one, (name, colour) in zip(_branches(curve), _BRANCHES, strict=True):
        x, y = one.approach / length, factor * getattr(one, column)
        ends = {(jump.before, jump.after) for jump in curve.jumps if jump.branch == name}
        jumps = [i for i in range(1, x.size) if (one.approach[i - 1], one.approach[i]) in ends]
        edges = [0, *jumps, x.size]
        for first, last in pairwise(edges):
            title = name if first == 0 else None
            ax.plot(x[first:last], y[first:last], "-", color=colour, lw=1.6, label=title)
        for i in jumps:
            ax.plot(x[i - 1 : i + 1], y[i - 1 : i + 1], ":", color=colour, lw=1.6)
    ax.axhline(0.0, color="0.6", lw=0.8)
    ax.set(xlabel=f"approach from first touch [{unit}]", ylabel=label)
    return ax
