"""Figures of curves: quantities of a result along one axis, in units that read well."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from ..errors import DescriptionError, nearest
from ..export.contents import Contents, Quantity
from .axis_units import axis_label, readable, scaled
from .style import Axes, figure, legend, plain_log, series

__all__ = ["curve_names", "curves", "log_where_wide"]

# Ratio of the ends of an axis from which it is logarithmic: below, a linear one still shows the
# smallest value (2 % of the axis is the width of a line and its marker).
_WIDE = 50.0
_DECADES = 1e3  # ratio from which powers of ten are enough to label it: three labels at least


def curve_names(contents: Contents) -> tuple[str, ...]:
    """Names of the quantities along one axis that are numbers."""
    found = contents.quantities.items()
    return tuple(n for n, one in found if len(one.axes) == 1 and _is_number(one.values))


def curves(
    contents: Contents, names: Sequence[str], over: str = "", ax: Axes | None = None
) -> Axes:
    """Draw quantities of one unit over another one along the same axis.

    Parameters
    ----------
    contents : Contents
        Quantities of a result: ``result.contents()``.
    names : sequence of str
        What to draw.
    over : str
        What to draw it over; the coordinate of the axis if empty, else the points in order.
    ax : Axes, optional
        Where to draw; a new figure if not given.

    Raises
    ------
    DescriptionError
        If there is no such curve, or curves differ in their unit.
    """
    known = {name: contents.quantities[name] for name in curve_names(contents)}
    if not names:
        raise DescriptionError("curves.names", "nothing", f"be some of {', '.join(known)}")
    for name in (*names, *([over] if over else [])):
        if name not in known:
            expected = f"be one of {', '.join(known)}"
            raise DescriptionError("curve", name, expected, hint=nearest(name, list(known)))
    drawn = [known[name] for name in names]
    along = known.get(over or drawn[0].axes[0])
    for one in (*drawn[1:], *([along] if over and along else [])):
        if one.axes != drawn[0].axes:
            raise DescriptionError("curves", _named(names), "lie along one axis")
    if len({one.unit for one in drawn}) > 1:
        units = ", ".join(dict.fromkeys(one.unit for one in drawn))
        raise DescriptionError("curves", units, "have one unit", hint="draw a figure for each")
    return _draw(names, drawn, over or drawn[0].axes[0], along, ax)


def _draw(
    names: Sequence[str],
    drawn: Sequence[Quantity],
    over: str,
    along: Quantity | None,
    ax: Axes | None,
) -> Axes:
    ax = ax if ax is not None else figure()[1]
    factor, unit = readable(drawn[0].unit, np.concatenate([_numbers(one) for one in drawn]))
    if along is None:
        x, place = np.arange(float(len(_numbers(drawn[0])))), ""
    else:
        x, place = scaled(_numbers(along), along.unit)
    labels = [one.label or _spoken(name) for name, one in zip(names, drawn, strict=True)]
    ys = [_numbers(one) / factor for one in drawn]
    marker = "o" if x.size <= 40 else None
    for i, (y, label) in enumerate(zip(ys, labels, strict=True)):
        ax.plot(x, y, label=label, **(series(i) | {"marker": marker}))
    label = (along.label if along is not None else "") or _spoken(over)
    ax.set_xlabel(axis_label(label, place))
    ax.set_ylabel(axis_label(labels[0] if len(labels) == 1 else _common(labels), unit))
    log_where_wide(ax, x, np.concatenate(ys))
    if len(labels) > 1:
        legend(ax)
    return ax


def log_where_wide(ax: Axes, x: Any, y: Any) -> None:
    """Make an axis logarithmic where its values are positive and far apart."""
    for values, scale, axis in ((x, ax.set_xscale, ax.xaxis), (y, ax.set_yscale, ax.yaxis)):
        known = np.asarray(values)[np.isfinite(values)]
        if known.size and known.min() > 0.0 and known.max() >= _WIDE * known.min():
            scale("log")
            if known.max() < _DECADES * known.min():
                plain_log(axis)


def _is_number(values: Any) -> bool:
    return np.asarray(values).dtype.kind in "fiu"


def _numbers(one: Quantity) -> Any:
    return np.asarray(one.values, dtype=float)


def _spoken(name: str) -> str:
    return name.rpartition(".")[2].replace("_", " ")


def _named(names: Sequence[str]) -> str:
    return ", ".join(names)


def _common(labels: Sequence[str]) -> str:
    """Last word that all labels share, such as force; empty if there is none."""
    words = {label.split()[-1] for label in labels}
    return words.pop() if len(words) == 1 else ""
