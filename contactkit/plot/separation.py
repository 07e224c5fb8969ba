"""Figures of separations and slidings: gap and forces along a run, cycles, reference scales."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from ..errors import DescriptionError, NotSimulatedError
from ..scene.column import Column
from ..separation.columns import COLUMNS
from ..separation.effects.base import LIMIT, effects_of
from ..separation.results import SeparationResult
from ..separation.sliding.result import SlidingResult
from .axis_units import axis_label, readable, scaled
from .style import COLORS, Axes, figure, legend, plain_log, prefixed_log

__all__ = ["cycles", "forces", "motion", "over_scales", "slide"]

_INSTANT = 0.05  # of the run: an earlier peak is a line on the frame of a linear axis


def _lines(
    ax: Axes,
    result: SeparationResult | SlidingResult,
    drawn: Sequence[Column],
    along: str,
    shown: Sequence[Column] = (),
    what: str = "force",
) -> tuple[float, float]:
    """Draw columns of one unit over another as they declare it, label both axes.

    The unit is that of the largest of those `shown`, all if none; return it, and that along.
    """
    known, unit = result.plan.columns, drawn[0].unit
    largest = [float(np.abs(result[one.name]).max(initial=0.0)) for one in shown or drawn]
    factor, name = readable(unit, largest)
    length, length_name = readable(known[along].unit, result[along])
    for one in drawn:
        y = result[one.name] / factor
        ax.plot(result[along] / length, y, one.style, color=one.color, label=one.label)
    ax.set_xlabel(axis_label(known[along].label, length_name))
    ax.set_ylabel(axis_label(what if unit == "N" else drawn[0].label, name))
    return factor, length


def motion(result: SeparationResult, ax: Axes | None = None) -> Axes:
    """Draw the gap over time; a dashed line marks the release."""
    time, gap = result.time, result.gap
    ax = ax if ax is not None else figure()[1]
    x, seconds = scaled(time, "s")
    y, length = scaled(gap, "m")
    ax.plot(x, y, color=COLORS["gap"])
    ax.set(xlabel=axis_label("time", seconds), ylabel=axis_label("gap", length), yscale="log")
    plain_log(ax.yaxis)
    if result.has_motion and result.state.n_releases:
        release = result.state.release_time / readable("s", time)[0]
        ax.axvline(release, color="0.5", lw=0.8, ls="--")
    return ax


def forces(result: SeparationResult, ax: Axes | None = None, *, over: str = "") -> Axes:
    """Draw the forces, over time where a limit of the liquid acts on a body that is accelerated.

    Such a film yields before its gap has changed, which has no width over the gap. All else is
    drawn over the gap. A bar at the bottom lasts as long as the limit acts, and a dashed line
    marks the release.

    Parameters
    ----------
    result : SeparationResult
        What was run.
    ax : Axes, optional
        Where to draw.
    over : {"gap", "time"}, optional
        What to draw them over; as said above if not given.

    Raises
    ------
    NotSimulatedError
        If the run has no force: with only a time imposed a viscous film has but its impulse.
    DescriptionError
        If they are to be drawn over anything else.
    """
    drawn = [
        column
        for effect in effects_of(result.plan.scene)
        for column in effect.curves()
        if column.unit == "N" and column.name in result.columns
    ]
    if not drawn:
        result["pull"]  # raises, with the reason
    if over not in ("", "gap", "time"):
        raise DescriptionError("forces.over", over, "be gap or time")
    pull = [COLUMNS["pull"]] if "pull" in result.columns else []
    ax = ax if ax is not None else figure()[1]
    shown = [one for one in drawn if one.name != "newtonian_force"]
    acts = result[LIMIT.name] > 1.0 if LIMIT.name in result.columns else np.zeros(1, dtype=bool)
    if not acts.any():
        drawn = shown  # without a limit both are one line
    along = over or ("time" if acts.any() and _is_accelerated(result) else "gap")
    factor, unit = _lines(ax, result, drawn + pull, along, shown + pull)
    x = result[along] / unit
    curves = [result[one.name] / factor for one in shown + pull]
    top = max([0.0, *(float(curve.max()) for curve in curves)])
    bottom = min([0.0, *(float(curve.min()) for curve in curves[: len(shown)])])
    if top > bottom:  # otherwise there is no force
        ax.set_ylim(min(1.1 * bottom, -0.04 * top if acts.any() else 0.0), 1.15 * top)
    if along == "gap":
        ax.set_xscale("log")
        plain_log(ax.xaxis)
    else:
        _fit_time(ax, result, unit, curves[: len(shown)])
    if acts.any():
        _mark_limit(ax, x, acts)
    legend(ax, **({"frameon": True, "edgecolor": "none"} if along == "time" else {}))
    return ax


def _is_accelerated(result: SeparationResult) -> bool:
    """Whether the speed is an outcome of the run."""
    return "speed" in result.columns and float(np.ptp(result["speed"])) > 0.0


def _fit_time(ax: Axes, result: SeparationResult, unit: float, films: Sequence[Any]) -> None:
    """Fit the axis of time to the forces of the film: logarithmic if they peak in an instant."""
    time = result["time"]
    strongest = max((np.abs(curve) for curve in films), key=lambda size: float(size.max()))
    peak, end = float(time[int(strongest.argmax())]), float(time[-1])
    if 0.0 < peak < _INSTANT * end:
        ax.set_xscale("log")
        ax.set_xlim(0.01 * peak / unit, 1.5 * end / unit)
        prefixed_log(ax.xaxis, unit, "s")
        ax.set_xlabel("time")
    if result.has_motion and result.state.n_releases:
        release = result.state.release_time / unit
        ax.axvline(release, color="0.5", lw=0.9, ls="--", label="release", zorder=0.5)


def _mark_limit(ax: Axes, x: Any, acts: Any) -> None:
    """Mark where a limit of the liquid acts by a bar along the bottom."""
    ax.fill_between(
        x,
        0.0,
        0.025,
        where=acts,
        transform=ax.get_xaxis_transform(),
        color=COLORS["limit"],
        lw=0.0,
        zorder=0.0,
        label="limit of the liquid acts",
    )


def over_scales(
    result: SeparationResult | SlidingResult,
    names: Sequence[str],
    ax: Axes | None = None,
    over: str = "gap",
) -> Axes:
    """Draw curves over another one, each in units of its reference scale.

    Parameters
    ----------
    result : SeparationResult or SlidingResult
        What was run.
    names : sequence of str
        Curves to draw.
    ax : Axes, optional
        Where to draw.
    over : str
        Curve to draw them over, such as ``gap``, ``time`` or ``travel``.

    Raises
    ------
    DescriptionError
        If there is no such curve.
    """
    along, unit = result.scaled(over)
    ax = ax if ax is not None else figure()[1]
    known = result.plan.columns
    units = []
    for name in names:
        curve, of = result.scaled(name)
        ax.plot(along, curve, known[name].style, color=known[name].color, label=known[name].label)
        units.append(of)
    made = {one.name: f" = {one.definition}" for one in result.scales.values()}
    parts = [f"{name}{made.get(name, '')}" for name in dict.fromkeys(units)]
    ax.set(xlabel=f"{known[over].label} [{unit}]", ylabel=f"in units of {', '.join(parts)}")
    if along.size and along.min() > 0.0 and along.max() > 10.0 * along.min():
        ax.set_xscale("log")
        plain_log(ax.xaxis)
    legend(ax)
    return ax


def cycles(result: SeparationResult, ax: Axes | None = None) -> Axes:
    """Draw the pull over the cycles of a vibration, its mean, and the pull without vibration.

    Raises
    ------
    NotSimulatedError
        If nothing vibrates.
    """
    pull, *others = (COLUMNS[name] for name in ("pull", "mean_pull", "steady_pull"))
    if others[0].name not in result.columns:
        raise NotSimulatedError("no cycles: nothing vibrates; give loading=Vibration(...)")
    ax = ax if ax is not None else figure()[1]
    thin = pull._replace(color=COLORS["speed"], style="-")
    _lines(ax, result, [thin, *others], "time", what="pull")
    ax.lines[0].set_linewidth(0.8)
    legend(ax)
    return ax


def slide(result: SlidingResult, ax: Axes | None = None) -> Axes:
    """Draw the tangential forces over the travel, or the impulse if a time is imposed."""
    ax = ax if ax is not None else figure()[1]
    plan = result.plan
    own = [column for kind in plan.laws for column in kind.curves()]
    known = [one for one in (*own, plan.columns["tangential_force"]) if one.name in result.columns]
    shown = [one for one in known if one.unit == "N"] or known
    _lines(ax, result, shown, "travel")
    ax.set_ylim(0.0, None)
    legend(ax)
    return ax
