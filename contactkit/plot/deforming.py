"""Figures of a separation of deforming bodies: loop, gaps, sections, energies."""

from __future__ import annotations

import numpy as np

from ..separation.deforming.result import DeformingResult
from .axis_units import axis_label, readable
from .style import Axes, figure, legend

__all__ = ["energies", "gaps", "loop", "sections"]

_INSTANTS = 5  # of a section


def loop(result: DeformingResult, ax: Axes | None = None) -> Axes:
    """Draw pull, film and contact force over the gap of the undeformed bodies, the loop filled."""
    ax = ax if ax is not None else figure()[1]
    columns = result.plan.columns
    named = [columns[name] for name in ("pull", "film_force", "contact_force")]
    drawn = [one for one in named if one.name == "pull" or result["contact_force"].any()]
    meniscus = columns["meniscus_force"]
    if result[meniscus.name].any():
        drawn.append(meniscus)
    largest = [float(np.abs(result[one.name]).max()) for one in drawn]
    force, force_name = readable("N", largest)
    length, length_name = readable("m", np.abs(result["gap"]))
    x, pull = result["gap"] / length, result["pull"] / force
    # From the end straight down and back: the parts above and below zero are the work of either.
    loop = np.append(x, [x[-1], x[0]]), np.append(pull, [0.0, 0.0])
    ax.fill(*loop, color="0.92", zorder=0.0)
    for one in drawn:
        ax.plot(x, result[one.name] / force, one.style, color=one.color, label=one.label)
    ax.axhline(0.0, color="0.7", lw=0.8)
    ax.set_xlabel(axis_label(columns["gap"].label, length_name))
    ax.set_ylabel(axis_label("force", force_name))
    legend(ax)
    return ax


def gaps(result: DeformingResult, ax: Axes | None = None) -> Axes:
    """Draw the gaps on the axis and of the undeformed bodies, and the smallest, over time."""
    ax = ax if ax is not None else figure()[1]
    columns = result.plan.columns
    drawn = [columns[name] for name in ("centre_gap", "smallest_gap", "gap")]
    length, length_name = readable("m", [float(result["centre_gap"].max())])
    time, time_name = readable("s", result["time"])
    for one in drawn:
        x, y = result["time"] / time, result[one.name] / length
        ax.plot(x, y, one.style, color=one.color, label=one.label)
    ax.set_xlabel(axis_label("time", time_name))
    ax.set_ylabel(axis_label("gap", length_name))
    legend(ax)
    return ax


def sections(result: DeformingResult, ax: Axes | None = None) -> Axes:
    """Draw the gap over the radius at five instants, from the start to where the bodies part."""
    ax = ax if ax is not None else figure()[1]
    time = result["time"]
    end = result.numbers["snap_off_time"]
    end = end if np.isfinite(end) else result.numbers["pull_off_time"]
    found = [result.section(t) for t in np.linspace(time[0], end, _INSTANTS)]
    reach = 3.0 * max(result.plan.film.width, float(np.sqrt(result["contact_area"].max() / np.pi)))
    shown = [one.gap[one.radius <= reach] for one in found]
    length, length_name = readable("m", [float(max(gap.max() for gap in shown))])
    radius, radius_name = readable("m", [reach])
    second, second_name = readable("s", time)
    for k, (one, gap) in enumerate(zip(found, shown, strict=True)):
        x = one.radius[one.radius <= reach] / radius
        label = f"{one.time / second:.3g} {second_name}"
        ax.plot(x, gap / length, color=str(0.75 * (1.0 - k / (_INSTANTS - 1))), label=label)
    ax.set_xlabel(axis_label("radius", radius_name))
    ax.set_ylabel(axis_label("gap", length_name))
    ax.set_ylim(bottom=0.0)
    legend(ax)
    return ax


def energies(result: DeformingResult, ax: Axes | None = None) -> Axes:
    """Draw the work of the pull, the energy in the bodies and what the film has dissipated."""
    ax = ax if ax is not None else figure()[1]
    columns = result.plan.columns
    drawn = [columns[name] for name in ("work", "elastic_energy", "dissipated_energy")]
    joule, joule_name = readable("J", [float(np.abs(result[one.name]).max()) for one in drawn])
    time, time_name = readable("s", result["time"])
    for one in drawn:
        x, y = result["time"] / time, result[one.name] / joule
        ax.plot(x, y, one.style, color=one.color, label=one.label)
    ax.set_xlabel(axis_label("time", time_name))
    ax.set_ylabel(axis_label("energy", joule_name))
    legend(ax)
    return ax
