"""Tornado figures: which assumption moves a quantity, and by how much."""

from __future__ import annotations

import math
import textwrap
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from ..scene.description import value_text
from .axis_units import axis_unit, in_print
from .style import Axes, Patch, figure

if TYPE_CHECKING:
    from ..studies.sensitivity import Influence, Sensitivity

__all__ = ["tornado"]

_LOW, _HIGH, _BETWEEN = "#0072b2", "#e69f00", "0.8"  # distinct to the colour-blind, and in grey
_LITTLE = 0.02  # of the axis: a shorter bar has no length to read, the assumption is only named
_MISSING = 0.12  # of the width of the axis, beyond the greatest result: room for the word


def tornado(
    found: Sensitivity,
    ax: Axes | None = None,
    *,
    most: int = 12,
    names: Mapping[str, str] | None = None,
    missing: str = "no result",
) -> Axes:
    """Draw the quantity over the range of each assumption, the most influential on top.

    A bar leads from the result of the scene as it is to that at each end of the range, with
    the value of the assumption beside it. A grey line spans the results in between, where they
    reach further. Assumptions that move the result by less than a fiftieth of the axis are only
    named, below.

    Parameters
    ----------
    found : Sensitivity
        From `contactkit.sensitivity`.
    ax : Axes, optional
        Where to draw; a new figure if none is given.
    most : int
        Most assumptions to draw.
    names : mapping, optional
        What to call the assumptions, by path; else the end of the path.
    missing : str
        What it means that there is no result, such as "never released".
    """
    known = [v for one in found.influences for v in one.extent(found.base) if math.isfinite(v)]
    low, high = min(known, default=0.0), max(known, default=1.0)
    factor, unit = axis_unit(max(abs(low), abs(high)), found.quantity_unit)
    width = (high - low) / factor or abs(high) / factor or 1.0
    drawn = [one for one in found.influences if not one.swing(found.base) < _LITTLE * (high - low)]
    rows = drawn[:most]
    if ax is None:
        _, ax = figure(1, 1, (7.5, 1.2 + 0.42 * max(len(rows), 2)))
    has_gaps = any(one.has_gaps for one in rows)
    end = high / factor + (_MISSING * width if has_gaps else 0.0)
    base = found.base / factor if math.isfinite(found.base) else end
    for i, one in enumerate(rows):
        _row(ax, i, one, (base, end, factor), (0.012 * width, missing))
    ax.axvline(base, color="k", lw=1.0)
    called = names or {}
    labels = [called.get(one.path) or _short(one.path) for one in rows]
    heads = [f"{n} ({_printed(o.base, o.unit)})" for n, o in zip(labels, rows, strict=True)]
    ax.set_yticks(range(len(rows)), heads)
    ax.set_ylim(max(len(rows), 1) - 0.4, -0.6)
    room = 0.035 * len(missing) * width if has_gaps else 0.0
    ax.set_xlim(low / factor - 0.2 * width, end + 0.16 * width + room)
    ax.set_xlabel(found.quantity + ("" if unit == "-" else f" [{unit}]"))
    rest = [
        called.get(one.path) or _short(one.path) for one in found.influences if one not in drawn
    ]
    if rest:
        text = f"less than {_LITTLE:.0%} of this axis: {', '.join(rest)}".replace("%", " %", 1)
        wrapped = textwrap.fill(text, 110)
        ax.annotate(
            wrapped,
            (1.0, 0.0),
            (0.0, -40.0),
            xycoords="axes fraction",
            textcoords="offset points",
            ha="right",
            va="top",
            fontsize="x-small",
            color="0.35",
        )
    _legend(ax)
    return ax


def _row(
    ax: Axes, i: int, one: Influence, scale: tuple[float, float, float], words: tuple[float, str]
) -> None:
    """Draw one assumption: both ends of its range, and what lies between."""
    (base, end, factor), (space, missing) = scale, words
    known = [v / factor for v in one.results if not math.isnan(v)]
    span = [base, *known, *([end] if one.has_gaps else [])]
    ax.plot([min(span), max(span)], [i, i], color=_BETWEEN, lw=1.5, zorder=1)
    for offset, value, result, color in (
        (-0.2, one.values[0], one.results[0], _LOW),
        (0.2, one.values[-1], one.results[-1], _HIGH),
    ):
        to, printed = result / factor, _printed(value, one.unit)
        style: dict[str, Any] = {}
        if math.isnan(result):
            to, printed = end, f"{printed}: {missing}" if missing else printed
            style = {"hatch": "////", "alpha": 0.5}
        ax.barh(i + offset, to - base, 0.36, left=base, color=color, zorder=2, **style)
        side = -1.0 if to < base else 1.0
        ax.annotate(
            printed,
            (to + side * space, i + offset),
            ha="left" if side > 0.0 else "right",
            va="center",
            fontsize="x-small",
            bbox={"color": "w", "pad": 0.3, "lw": 0.0},
        )


def _legend(ax: Axes) -> None:
    ends = [Patch(color=_LOW, label="low end"), Patch(color=_HIGH, label="high end")]
    ax.legend(handles=ends, loc="lower right", fontsize="small", framealpha=1.0)


def _printed(value: Any, unit: str) -> str:
    """A value with the letters of print."""
    number, space, name = value_text(value, unit).rpartition(" ")
    return f"{number}{space}{in_print(name)}" if space else name


def _short(path: str) -> str:
    """Last name of a path; the first of several that vary together."""
    return path.partition(",")[0].strip().rpartition(".")[2].replace("_", " ")
