"""Figures of separations and costs; axes, legends and colours of all figures."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import cycle
from pathlib import Path
from typing import Any

try:
    import matplotlib as mpl
except ModuleNotFoundError as error:
    from ..extras import missing_extra

    raise missing_extra(error, "contactkit.plot") or error from None
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure
from matplotlib.patches import Patch, Rectangle
from matplotlib.ticker import LogLocator, NullFormatter

from ..files.scenes import write_whole
from ..scene.column import Column
from ..separation.columns import COLUMNS
from ..separation.effects.base import LIMIT
from ..separation.effects.registry import MeniscusForce, VanDerWaalsForce, ViscousForce
from ..separation.results import SeparationResult
from ..separation.sliding.result import SlidingResult
from ..work_precision import WorkPrecision

__all__ = [
    "COLORS",
    "STYLE",
    "Axes",
    "Figure",
    "ListedColormap",
    "Patch",
    "Rectangle",
    "bars",
    "closures",
    "cycles",
    "figure",
    "forces",
    "label_axis",
    "legend",
    "motion",
    "mpl",
    "over_scales",
    "plain_log",
    "save",
    "shared_legend",
    "slide",
    "title",
    "work_precision",
]

COLORS = {
    "gap": COLUMNS["gap"].color or "",
    "speed": COLUMNS["speed"].color or "",
    "pull": COLUMNS["pull"].color or "",
    "meniscus": MeniscusForce.column.color or "",
    "viscous": ViscousForce.column.color or "",
    "solids": VanDerWaalsForce.column.color or "",
    "limit": "#e9c46a",
    "magnet": "#6a4c93",
    "spring": "#8d6b3d",
    "stop": "#444444",
}
"""One colour for each quantity, the same in every figure; effects declare theirs."""

STYLE: Any = {
    "font.size": 10.0,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "grid.alpha": 0.3,
    "grid.linewidth": 0.6,
    "legend.frameon": False,
    "lines.linewidth": 1.6,
    "figure.dpi": 110,
    "savefig.dpi": 160,
    "axes.titlelocation": "left",
    "axes.titlesize": 11.0,
    "figure.constrained_layout.use": True,
}

_THREE = ("#1f4e79", "#2a9d8f", "#c1440e")  # exact, arc, as published
_MANY = (  # as many methods as a figure compares
    "#1f4e79",
    "#c1440e",
    "#2a9d8f",
    "#e9a23b",
    "#6a4c93",
    "#8ab17d",
    "#d1495b",
    "#6c757d",
    "#8d6b3d",
    "#4aa3df",
    "#111111",
    "#b5179e",
)
_LEFT = "not tried"  # how a point begins that was left out


def figure(
    rows: int = 1, columns: int = 1, size: tuple[float, float] = (7.0, 4.5), **grid: Any
) -> tuple[Figure, Any]:
    """Make a figure in the house style, without a window: the figure and its axes."""
    with mpl.rc_context(STYLE):
        made = Figure(figsize=size)
        return made, made.subplots(rows, columns, **grid)


def save(made: Figure, path: str | Path) -> Path:
    """Write a figure as a PNG file, completely or not at all."""
    path = Path(path).with_suffix(".png")
    with write_whole(path) as temporary, mpl.rc_context(STYLE):
        made.savefig(temporary, format="png")
    return path


def title(ax: Axes, text: str) -> None:
    """Title of a panel, at its left."""
    ax.set_title(text, loc="left", fontsize=11)


def note(ax: Axes, text: str, height: float, *, below: bool = False) -> None:
    """Small note at the left of a panel, above or below a height of its data."""
    ax.annotate(
        text,
        (0.0, height),
        xycoords=("axes fraction", "data"),
        xytext=(4, -10 if below else 3),
        textcoords="offset points",
        color="0.4",
        fontsize=8,
    )


def legend(ax: Axes, **more: Any) -> None:
    """Legend without a frame."""
    ax.legend(**({"frameon": False, "fontsize": 9} | more))


def shared_legend(made: Figure, ax: Axes) -> None:
    """One legend below all panels, from the curves of one of them, in as many rows as needed."""
    handles, labels = ax.get_legend_handles_labels()
    widest = 0.6 + 0.085 * max(map(len, labels))  # [inch]
    columns = max(1, min(len(labels), int(made.get_figwidth() / widest)))
    made.legend(handles, labels, loc="outside lower center", ncols=columns, frameon=False)


def plain_log(axis: Axis) -> None:
    """Label a logarithmic axis at 1, 2 and 5, without powers of ten."""
    axis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
    axis.set_major_formatter("{x:g}")
    axis.set_minor_formatter(NullFormatter())


def label_axis(column: Column, display: str = "") -> str:
    """Label of a column of a result, with its unit or its display unit."""
    unit = display or column.unit
    return column.label if unit == "-" else f"{column.label} [{unit}]"


def _lines(
    ax: Axes, result: SeparationResult | SlidingResult, drawn: Sequence[Column], along: Any
) -> None:
    """Draw columns as they declare it."""
    for one in drawn:
        curve = result.columns[one.name]
        ax.plot(along, curve, one.style, color=one.color, label=one.label)


def motion(result: SeparationResult, ax: Axes | None = None) -> Axes:
    """Draw the gap over time."""
    ax = ax if ax is not None else figure()[1]
    ax.plot(result.time * 1e3, result.gap * 1e6, color=COLORS["gap"])
    ax.set(
        xlabel=label_axis(COLUMNS["time"], "ms"),
        ylabel=label_axis(COLUMNS["gap"], "um"),
        yscale="log",
    )
    plain_log(ax.yaxis)
    if result.state is not None and result.state.n_releases:
        ax.axvline(result.state.release_time * 1e3, color="0.5", lw=0.8, ls="--")
    return ax


def forces(result: SeparationResult, ax: Axes | None = None) -> Axes:
    """Draw the forces over the gap, and shade where a limit of the liquid acts.

    Raises
    ------
    NotSimulatedError
        If the run has no force: with only a time imposed a viscous film has but its impulse.
    """
    drawn = [
        column
        for effect in result.plan.scene.effects
        for column in effect.curves()
        if column.unit == "N" and column.name in result.columns
    ]
    if not drawn:
        result["pull"]  # raises, with the reason
    pull = [COLUMNS["pull"]] if "pull" in result.columns else []
    ax = ax if ax is not None else figure()[1]
    gap = result.gap * 1e6
    _lines(ax, result, drawn + pull, gap)
    if LIMIT.name in result.columns:
        acts = result[LIMIT.name] > 1.0
        ax.fill_between(
            gap,
            0,
            1,
            where=acts,
            transform=ax.get_xaxis_transform(),
            color=COLORS["limit"],
            alpha=0.3,
            label="limit of the liquid acts",
        )
    ax.set(xlabel=label_axis(COLUMNS["gap"], "um"), ylabel="force [N]", xscale="log")
    shown = [result[one.name] for one in drawn if one.name != "newtonian_force"]
    top = max([0.0, *(float(curve.max()) for curve in (*shown, *(result[p.name] for p in pull)))])
    bottom = min([0.0, *(float(curve.min()) for curve in shown)])
    if top > bottom:  # otherwise there is no force
        ax.set_ylim(1.1 * bottom, 1.15 * top)
    plain_log(ax.xaxis)
    legend(ax)
    return ax


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
    """Draw the pull over the cycles of a vibration, its mean, and the pull without vibration."""
    ax = ax if ax is not None else figure()[1]
    time = result.time * 1e3
    pull, *others = (COLUMNS[name] for name in ("pull", "mean_pull", "steady_pull"))
    ax.plot(time, result.pull, color=COLORS["speed"], lw=0.8, label=pull.label)
    _lines(ax, result, others, time)
    ax.set(xlabel=label_axis(COLUMNS["time"], "ms"), ylabel=label_axis(pull))
    legend(ax)
    return ax


def slide(result: SlidingResult, ax: Axes | None = None) -> Axes:
    """Draw the tangential forces over the travel, or the impulse if a time is imposed."""
    ax = ax if ax is not None else figure()[1]
    plan, travel = result.plan, result.travel * 1e6
    own = [column for kind in plan.laws for column in kind.curves()]
    known = [one for one in (*own, plan.columns["tangential_force"]) if one.name in result.columns]
    shown = [one for one in known if one.unit == "N"] or known
    for one in shown:
        label = label_axis(one)
        ax.plot(travel, result[one.name], one.style, color=one.color, label=label)
    ax.set(xlabel=label_axis(plan.columns["travel"], "um"), ylabel="force [N]", ylim=(0.0, None))
    if shown[0].unit != "N":
        ax.set_ylabel(label_axis(shown[0]))
    legend(ax)
    return ax


def bars(names: Sequence[str], values: Sequence[float], ax: Axes, label: str) -> Axes:
    """Draw a bar for each of some names, from the top down."""
    places = list(range(len(names)))
    ax.barh(places, values, color=COLORS["gap"], height=0.6)
    ax.set_yticks(places, names)
    ax.invert_yaxis()
    ax.set_xlabel(label)
    ax.grid(visible=False, axis="y")
    return ax


def closures(found: WorkPrecision, ax: Axes, bridges: Sequence[str]) -> Axes:
    """Draw error against seconds per gap: a colour for each closure, a marker for each bridge.

    Full signs stand for whole curves or whole answers, open ones for one gap at a time.
    """
    colors = dict(zip(dict.fromkeys(p.method for p in found.points), _THREE, strict=False))
    for p in found.points:
        name = next(b for b in bridges if p.label.startswith(b))
        full = "none" if "one gap" in p.label or "first" in p.label else colors[p.method]
        ax.plot(
            p.seconds,
            max(p.error, 1e-16),
            "osD^vP*X"[bridges.index(name)],
            ms=6.5,
            color=colors[p.method],
            mfc=full,
            ls="none",
        )
    for method, color in colors.items():
        ax.plot([], [], "-", lw=5, color=color, label=method)
    for name, marker in zip(bridges, "osD^vP*X", strict=False):
        ax.plot([], [], marker, color="0.3", ls="none", label=name)
    ax.plot([], [], "o", color="0.3", mfc="none", ls="none", label="open: one gap, or first time")
    low = 0.1 * min([found.floor, *(p.error for p in found.points if p.error > 0.0)])
    ax.axhspan(max(low, 1e-16), found.floor, color="0.9", label="error of the reference")
    each = "gap" if any("gap" in p.label for p in found.points) else "bridge"
    ax.set(xscale="log", yscale="log", xlabel=f"seconds per {each}")
    ax.set_ylabel(f"relative error of the {found.quantity}")
    return ax


def work_precision(
    found: WorkPrecision,
    ax: Axes | None = None,
    markers: Sequence[str] = "osD^vP*X",
    *,
    beside: bool = True,
) -> Axes:
    """Draw error against seconds, a line for each method; errors of models are horizontal.

    The legend names the settings that a method refuses or fails at, which have no place in the
    panel. `beside` puts it at the side of the panel, else below it.
    """
    ax = ax if ax is not None else figure()[1]
    methods = list(dict.fromkeys(p.method for p in found.points))
    looks = zip(cycle(_MANY), cycle(markers), strict=False)  # repeated as needed
    for method, (color, marker) in zip(methods, looks, strict=False):
        points = [p for p in found.points if p.method == method]
        good = [p for p in points if p.error == p.error]
        bad = [p.label for p in points if p.error != p.error and not p.problem.startswith(_LEFT)]
        style = "--" if any(p.is_model for p in points) else "-"
        drawn = [max(p.error, 1e-16) for p in good]
        settings = f": {', '.join(bad)}" if good else ""
        label = f"{method}\n  no answer{settings}" if bad else method
        seconds = [p.seconds for p in good]
        ax.plot(seconds, drawn, style, color=color, marker=marker, label=label)
    worst = [p.error for p in found.points if p.error == p.error]
    low = 0.1 * min(found.floor, *worst)
    ax.axhspan(low, found.floor, color="0.9", label="error of the reference")
    ax.set(xscale="log", yscale="log", xlabel="seconds", ylim=(max(low, 1e-16), None))
    ax.set_ylabel(f"relative error of the {found.quantity}")
    plain_log(ax.xaxis)
    if beside:
        legend(ax, fontsize=8, loc="center left", bbox_to_anchor=(1.0, 0.5))
    else:
        legend(ax, fontsize=8, loc="upper center", bbox_to_anchor=(0.5, -0.16), ncols=2)
    return ax
