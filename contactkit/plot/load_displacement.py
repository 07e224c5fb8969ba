"""Figures of load-displacement curves: first loading and unloading."""

from __future__ import annotations

import numpy as np

from ..analyses.load_displacement.curve import LoadDisplacementCurve
from .axis_units import axis_unit
from .style import Axes, figure, legend

__all__ = ["force"]


def force(curve: LoadDisplacementCurve, ax: Axes | None = None) -> Axes:
    """Draw the force over the approach: first loading, and unloading from some approaches."""
    ax = ax if ax is not None else figure()[1]
    length, unit = axis_unit(curve.max_approach, "m")
    newton, name = axis_unit(curve.force[-1], "N")
    approach = np.linspace(0.0, curve.max_approach, 200)
    loading = [curve.at(float(d)).force / newton for d in approach]
    ax.plot(approach / length, loading, color="#0072b2", label="first loading")
    label = "unloading"
    for one in curve.unloading:
        back = np.linspace(one.residual_approach, one.max_approach, 100)
        values = [curve.at(float(d), one.max_approach).force / newton for d in back]
        ax.plot(back / length, values, "--", color="#d55e00", lw=1.2, label=label)
        label = ""
    ax.set(xlabel=f"approach [{unit}]", ylabel=f"force [{name}]")
    ax.set(xlim=(0.0, None), ylim=(0.0, None))
    legend(ax)
    return ax
