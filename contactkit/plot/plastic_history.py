"""Figures of loading histories: force over approach, and the residual depth."""

from __future__ import annotations

import numpy as np

from ..contact.effects.plastic_history import PlasticHistory
from ..contact.result import ContactResult
from .axis_units import axis_unit
from .maps import extent, hide_holes, place
from .style import Axes, figure, legend

__all__ = ["force_approach", "residual_depth"]

_PLASTIC, _ELASTIC = "#c1440e", "#1f4e79"


def force_approach(result: ContactResult, ax: Axes | None = None) -> Axes:
    """Draw the load over the approach; steps with plastic flow, and those without, apart.

    The area between loading and unloading is the work dissipated by plastic flow.
    """
    ax = ax if ax is not None else figure()[1]
    part = result.of(PlasticHistory)
    factor, unit = axis_unit(float(part.approach.max()), "m")
    d, (force, newton) = part.approach / factor, axis_unit(float(part.load.max()), "N")
    load = part.load / force
    flows = np.diff(part.plastic_work) > 0.0
    ax.plot(d, load, color=_ELASTIC, label="elastic")
    joule, name = axis_unit(float(part.plastic_work[-1]), "J")
    label = f"with plastic flow, {part.plastic_work[-1] / joule:.3g} {name}"
    for i in np.flatnonzero(flows):
        ax.plot(d[i : i + 2], load[i : i + 2], color=_PLASTIC, label=label)
        label = ""
    ax.plot(d, load, ".", color="k", ms=3.0)
    ax.set(xlabel=f"approach [{unit}]", ylabel=f"load [{newton}]")
    ax.set(xlim=(0.0, None), ylim=(0.0, None))
    legend(ax, loc="upper left")
    return ax


def residual_depth(result: ContactResult, ax: Axes | None = None) -> Axes:
    """Draw the map of the depth by which the surfaces stay deformed; untouched pixels white."""
    ax = ax if ax is not None else figure()[1]
    part = result.of(PlasticHistory)
    around, unit = extent(result)
    factor, name = axis_unit(float(part.residual_depth.max()), "m")
    left = np.ma.masked_less_equal(part.residual_depth / factor, 0.0)
    image = ax.imshow(left, origin="lower", extent=around, cmap="magma_r", interpolation="nearest")
    hide_holes(ax, result)
    place(ax, unit)
    bar = ax.figure.colorbar(image, ax=ax, shrink=0.85)
    bar.set_label(f"residual depth [{name}]")
    return ax
