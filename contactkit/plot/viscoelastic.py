"""Figures of viscoelastic contacts: load, approach and area over time; load over approach."""

from __future__ import annotations

import numpy as np

from ..contact.effects.viscoelasticity import Viscoelasticity
from ..contact.result import ContactResult
from .axis_units import axis_unit
from .style import Axes, figure, legend

__all__ = ["load_loop", "time_curves"]

# Colours of Okabe and Ito, and line styles, so that neither is needed alone.
_SHOWN = (
    ("load", "N", "#000000", ":"),
    ("approach", "m", "#0072b2", "-"),
    ("contact_area", "m2", "#d55e00", "--"),
)
_DECADES = 2.0  # between the times of a path from which on their axis is logarithmic


def time_curves(result: ContactResult, ax: Axes | None = None) -> Axes:
    """Draw load, approach and contact area over time, each over its maximum, which is stated."""
    ax = ax if ax is not None else figure()[1]
    part = result.of(Viscoelasticity)
    time = part.time
    after = time[time > 0.0]
    if after.size > 1 and np.log10(after[-1] / after[0]) > _DECADES:
        ax.set_xscale("log")
        factor, unit = 1.0, "s"
    else:
        factor, unit = axis_unit(float(time[-1]), "s") if after.size else (1.0, "s")
    for name, of, colour, line in _SHOWN:
        values = getattr(part, name)
        largest = float(np.abs(values).max())
        scale, symbol = axis_unit(largest, of) if largest else (1.0, of)
        label = f"{name.replace('_', ' ')}, max. {largest / scale:.3g} {symbol}"
        ax.plot(time / factor, values / (largest or 1.0), line, color=colour, label=label)
    ax.set(xlabel=f"time [{unit}]", ylabel="over the maximum [-]")
    legend(ax, loc="upper center", bbox_to_anchor=(0.5, -0.16), ncols=2)
    return ax


def load_loop(result: ContactResult, ax: Axes | None = None) -> Axes:
    """Draw the load over the approach, and state the energy that the bodies have dissipated."""
    ax = ax if ax is not None else figure()[1]
    part = result.of(Viscoelasticity)
    length, metre = axis_unit(float(np.abs(part.approach).max()), "m")
    force, newton = axis_unit(float(np.abs(part.load).max()), "N")
    lost = float(part.dissipated_energy[-1])
    joule, name = axis_unit(lost, "J") if lost else (1.0, "J")
    label = f"dissipated {lost / joule:.3g} {name}"
    ax.plot(part.approach / length, part.load / force, ".-", color=_SHOWN[1][2], label=label)
    ax.set(xlabel=f"approach [{metre}]", ylabel=f"load [{newton}]")
    legend(ax, loc="upper left")
    return ax
