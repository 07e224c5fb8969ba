"""Figures of partial slip and of stick-slip, on given axes."""

from __future__ import annotations

import numpy as np

from ..analyses.stick_slip import StickSlip
from ..contact.effects.partial_slip import PartialSlip
from ..contact.result import ContactResult
from ..contact.slip.states import Zone
from .axis_units import axis_unit
from .contact import _extent, _hide_holes, _place
from .separation import Axes, ListedColormap, Patch, figure, legend

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
    extent, unit = _extent(result)
    zones = result.of(PartialSlip).zones[step]
    ax.imshow(
        zones,
        origin="lower",
        extent=extent,
        interpolation="nearest",
        vmin=0,
        vmax=len(Zone) - 1,
        cmap=ListedColormap([colour for colour, _ in ZONES.values()]),
    )
    _hide_holes(ax, result)
    _place(ax, unit)
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
    extent, unit = _extent(result)
    x = (np.arange(result.pressure.shape[1]) + 0.5) * extent[1] / result.pressure.shape[1]
    bound = effect.coefficient * result.pressure[row] / 1e6
    ax.fill_between(x, -bound, bound, fc="#e8e8e4", ec="#a0a09a", label="within mu p")
    c, s = np.cos(effect.direction), np.sin(effect.direction)
    for number in range(len(part.traction_x)):
        q = (c * part.traction_x[number, row] + s * part.traction_y[number, row]) / 1e6
        force = part.force[part.end_of(number)]
        # A cycle ends where it began: dashes show the curve below.
        dash = ("-", "--", ":")[number % 3]
        ax.plot(x, q, dash, lw=1.4, label=f"step {number}, {force:.3g} N")
    ax.set(xlabel=f"x [{unit}]", ylabel="traction [MPa]")
    legend(ax, fontsize=7)
    return ax


def hysteresis(result: ContactResult, ax: Axes | None = None) -> Axes:
    """Draw the tangential force over the displacement along the load path."""
    ax = ax if ax is not None else figure()[1]
    part = result.of(PartialSlip)
    factor, unit = axis_unit(float(np.abs(part.displacement).max()), "m")
    ends = [part.end_of(number) for number in range(len(part.zones))]
    x = part.displacement / factor
    ax.plot(x, part.force, ".-", ms=3.0, color="#1f4e79")
    ax.plot(x[ends], part.force[ends], "o", ms=5.0, mfc="none", color="#c1440e")
    ax.set(xlabel=f"tangential displacement [{unit}]", ylabel="tangential force [N]")
    return ax


def stick_slip_force(motion: StickSlip, ax: Axes | None = None) -> Axes:
    """Draw the force of the spring over time, with the levels of friction."""
    ax = ax if ax is not None else figure()[1]
    ax.plot(motion.time, motion.force, color="#1f4e79")
    for name, level in (
        ("static", motion.slider.static_friction),
        ("kinetic", motion.slider.kinetic_friction),
    ):
        ax.axhline(level, ls=":", lw=1.0, color="#555555")
        ax.annotate(f"{name} friction", (0.0, level), va="bottom", fontsize=8)
    ax.set(xlabel="time [s]", ylabel="force of the spring [N]")
    return ax
