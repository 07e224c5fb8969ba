"""Figures of partial slip and of stick-slip, on given axes."""

from __future__ import annotations

import numpy as np

from ..analyses.stick_slip import StickSlip
from ..contact.effects.partial_slip import PartialSlip
from ..contact.result import ContactResult
from ..contact.slip.states import Zone
from .axis_units import axis_unit, scaled
from .maps import extent, hide_holes, place
from .style import Axes, ListedColormap, Patch, figure, legend, note

__all__ = ["hysteresis", "slip_zones", "stick_slip_force", "traction_profile"]

ZONES = {
    Zone.OPEN: ("#f4f4f2", "out of contact"),
    Zone.STICK: ("#1f4e79", "stick"),
    Zone.SLIP: ("#e76f51", "slip"),
    Zone.REVERSE_SLIP: ("#e9c46a", "reverse slip"),
}
"""Colour and label of each zone."""


def slip_zones(result: ContactResult, ax: Axes | None = None, step: int = -1) -> Axes:
    """Draw where the contact sticks and slips at the end of a step of its load path."""
    ax = ax if ax is not None else figure()[1]
    around, unit = extent(result)
    zones = result.of(PartialSlip).zones[step]
    ax.imshow(
        zones,
        origin="lower",
        extent=around,
        interpolation="nearest",
        vmin=0,
        vmax=len(Zone) - 1,
        cmap=ListedColormap([colour for colour, _ in ZONES.values()]),
    )
    hide_holes(ax, result)
    place(ax, unit)
    n = max(int((zones > Zone.OPEN).sum()), 1)
    shown = [zone for zone in Zone if zone is not Zone.OPEN and (zones == zone).any()]
    handles = [
        Patch(
            color=ZONES[zone][0],
            label=f"{ZONES[zone][1]} {100.0 * (zones == zone).sum() / n:.3g} % of the contact",
        )
        for zone in shown
    ]
    legend(ax, handles=handles, loc="upper center", bbox_to_anchor=(0.5, -0.14), ncols=1)
    return ax


def traction_profile(result: ContactResult, ax: Axes | None = None, row: int | None = None) -> Axes:
    """Draw the traction along a row of pixels at the end of each step, between the bounds.

    Parameters
    ----------
    result : ContactResult
        With `PartialSlip`.
    ax : Axes, optional
        Where to draw.
    row : int, optional
        Row of pixels; None: the one with the largest pressure.
    """
    ax = ax if ax is not None else figure()[1]
    part, effect = result.of(PartialSlip), result.plan.scene.demand(PartialSlip)
    if row is None:
        row = int(np.unravel_index(int(np.argmax(result.pressure)), result.pressure.shape)[0])
    around, unit = extent(result)
    x = (np.arange(result.pressure.shape[1]) + 0.5) * around[1] / result.pressure.shape[1]
    bound = effect.coefficient * result.pressure[row]
    stress, name = axis_unit(float(bound.max()), "Pa")
    newton, force_name = axis_unit(float(np.abs(part.force).max()), "N")
    bound = bound / stress
    ax.fill_between(x, -bound, bound, fc="#e8e8e4", ec="#a0a09a", label="within µ p")
    c, s = np.cos(effect.direction), np.sin(effect.direction)
    for number in range(len(part.traction_x)):
        q = (c * part.traction_x[number, row] + s * part.traction_y[number, row]) / stress
        force = part.force[part.end_of(number)] / newton
        # A cycle ends where it began: dashes show the curve below.
        dash = ("-", "--", ":")[number % 3]
        ax.plot(x, q, dash, lw=1.4, label=f"step {number}, {force:.3g} {force_name}")
    ax.set(xlabel=f"x [{unit}]", ylabel=f"traction [{name}]")
    legend(ax, loc="upper center", bbox_to_anchor=(0.5, -0.14), ncols=2)
    return ax


def hysteresis(result: ContactResult, ax: Axes | None = None) -> Axes:
    """Draw the tangential force over the displacement along the load path."""
    ax = ax if ax is not None else figure()[1]
    part = result.of(PartialSlip)
    factor, unit = axis_unit(float(np.abs(part.displacement).max()), "m")
    newton, name = axis_unit(float(np.abs(part.force).max()), "N")
    ends = [part.end_of(number) for number in range(len(part.zones))]
    x, y = part.displacement / factor, part.force / newton
    ax.plot(x, y, ".-", ms=3.0, color="#1f4e79")
    ax.plot(x[ends], y[ends], "o", ms=5.0, mfc="none", color="#c1440e")
    ax.set(xlabel=f"tangential displacement [{unit}]", ylabel=f"tangential force [{name}]")
    return ax


def stick_slip_force(motion: StickSlip, ax: Axes | None = None) -> Axes:
    """Draw the force of the spring over time, with the levels of friction."""
    ax = ax if ax is not None else figure()[1]
    (time, seconds), (newton, name) = scaled(motion.time, "s"), axis_unit(motion.largest_force, "N")
    ax.plot(time, motion.force / newton, color="#1f4e79")
    for label, level, below in (
        ("static friction", motion.slider.static_friction, False),
        ("kinetic friction", motion.slider.kinetic_friction, True),
    ):
        ax.axhline(level / newton, ls=":", lw=1.0, color="#555555")
        note(ax, label, level / newton, below=below)
    ax.set(xlabel=f"time [{seconds}]", ylabel=f"force of the spring [{name}]")
    ax.margins(y=0.15)
    return ax
