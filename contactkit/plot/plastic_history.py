"""Figures of loading histories: force over approach, and the residual depth."""

from __future__ import annotations

import numpy as np

from ..contact.effects.plastic_history import PlasticHistory
from ..contact.result import ContactResult
from .axis_units import axis_unit
from .contact import _extent, _hide_holes, _place
from .separation import Axes, figure, legend

__all__ = ["force_approach", "residual_depth"]

_PLASTIC, _ELASTIC = "#c1440e", "#1f4e79"


def force_approach(result: ContactResult, ax: Axes | None = None) -> Axes:
    """Draw the load over the approach; steps with plastic flow, and those without, apart.

    The area between loading and unloading is the work dissipated by plastic flow.
    """
    ax = ax if ax is not None else figure()[1]
    part = result.of(PlasticHistory)
    factor, unit = axis_unit(float(part.approach.max()), "m")
    d, (force, newton) = part.approach / factor, _newtons(float(part.load.max()))
    load = part.load / force
    flows = np.diff(part.plastic_work) > 0.0
    ax.plot(d, load, color=_ELASTIC, label="elastic")
    label = f"with plastic flow, {part.plastic_work[-1]:.3g} J"
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
    around, unit = _extent(result)
    factor, name = axis_unit(float(part.residual_depth.max()), "m")
    left = np.ma.masked_less_equal(part.residual_depth / factor, 0.0)
    image = ax.imshow(left, origin="lower", extent=around, cmap="magma_r", interpolation="nearest")
    _hide_holes(ax, result)
    _place(ax, unit)
    bar = ax.figure.colorbar(image, ax=ax, shrink=0.85)
    bar.set_label(f"residual depth [{name}]")
    return ax


def _newtons(force: float) -> tuple[float, str]:
    """Factor and name of the unit in which a force [N] reads best."""
    for factor, name in ((1.0, "N"), (1e-3, "mN"), (1e-6, "uN"), (1e-9, "nN")):
        if force >= factor:
            return factor, name
    return 1e-9, "nN"
