"""Figures of studies: numbers over a parameter, with a band where they are of several seeds."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from ..studies.bands import RUNS, is_seed
from ..studies.columns import StudyColumns
from .axis_units import axis_label, readable
from .style import Axes, Figure, figure, letters, plain_log, series, shared_legend, title

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = ["Panel", "draw_line", "over_parameter", "overview", "study_curves"]

Panel = tuple[str, str, float]
"""Name of a column, label of its axis, and what its values are divided by."""

# As in `curves`, but earlier: points of a study are few, and the user has spaced wide ranges of a
# parameter by ratios.
_WIDE = 20.0
_MOST_PANELS = 12  # four rows of three: more are too small to read
_DECADES = 1e3  # ratio from which powers of ten are enough to label it


def over_parameter(values: Any, ax: Axes) -> NDArray[np.float64]:
    """Values of a parameter; places on the axis for those that are no numbers, with their names."""
    given = np.asarray(values)
    if given.dtype != object:
        return given
    places = np.arange(float(len(given)))
    ax.set_xticks(places, [_named(one) for one in given])
    return places


def _named(value: Any) -> str:
    """A value of a parameter as text: numbers short, objects by their names."""
    if isinstance(value, tuple):
        return ", ".join(map(_named, value))
    if isinstance(value, float):
        return f"{value:g}"
    return str(getattr(value, "name", None) or getattr(value, "label", None) or value)


def draw_line(
    ax: Axes, x: Any, columns: Mapping[str, Any], panel: Panel, i: int, label: str
) -> None:
    """Draw a column as series `i`, with its band from ``_low`` to ``_high`` if there is one."""
    name, _, factor = panel
    style = series(i)
    if f"{name}_low" in columns:
        low, high = (np.asarray(columns[name + end], float) / factor for end in ("_low", "_high"))
        ax.fill_between(x, low, high, color=style["color"], alpha=0.16, lw=0.0)
    ax.plot(x, np.asarray(columns[name], float) / factor, label=label, **style)


def study_curves(
    curves: Sequence[tuple[str, Mapping[str, Any]]],
    axes: Sequence[Axes],
    panels: Sequence[Panel],
    over: Panel,
) -> Sequence[Axes]:
    """Draw numbers of a study over one of its parameters, a panel for each.

    Parameters
    ----------
    curves : sequence of (label, columns)
        One for each line, such as `StudyLine` of ``study.bands().lines()``.
    axes : sequence of Axes
        One for each panel.
    panels : sequence of (column, label, factor)
        Quantities to draw, divided by their factors.
    over : (column, label, factor)
        The parameter. Axes are logarithmic where values are positive and far apart.
    """
    name, label, factor = over
    for ax, panel in zip(axes, panels, strict=False):
        for i, (name_of_line, columns) in enumerate(curves):
            if panel[0] not in columns:
                continue
            x = over_parameter(columns[name], ax)
            x = x / factor if x.dtype.kind == "f" and factor != 1.0 else x
            draw_line(ax, x, columns, panel, i, name_of_line)
        ax.set(xlabel=label, ylabel=panel[1])
        for column, scale, axis in (
            (name, ax.set_xscale, ax.xaxis),
            (panel[0], ax.set_yscale, ax.yaxis),
        ):
            ratio = _ratio([columns[column] for _, columns in curves if column in columns])
            if ratio >= _WIDE:
                scale("log")
                if ratio < _DECADES:
                    plain_log(axis)
    return axes


def _ratio(given: Sequence[Any]) -> float:
    """Greatest over least of positive numbers; 1 where others are among them."""
    columns = [np.asarray(one) for one in given]
    if any(one.dtype.kind != "f" for one in columns):
        return 1.0
    values = np.concatenate(columns)
    known = values[np.isfinite(values)]
    return float(known.max() / known.min()) if known.size and known.min() > 0.0 else 1.0


def overview(study: StudyColumns, heading: str = "") -> Figure:
    """Draw the numbers of a study that change, a panel for each, over one of its parameters.

    That is the load or what else is imposed, if it varies, else the last parameter; there is a line
    for each combination of the others.
    """
    path = _along(study)
    lines = study.lines(path)
    names = (study.telling() or study.number_names)[:_MOST_PANELS]
    columns = min(3, len(names))
    rows = -(-len(names) // columns)
    made, axes = figure(rows, columns, size=(4.0 * columns, 3.4 * rows), squeeze=False)
    flat = list(axes.flat)
    panels = [_panel(study, name) for name in names]
    over = _panel(study, path, " ".join(path.split(".")[-2:]))
    study_curves([(one.label, one.columns) for one in lines], flat, panels, over)
    for ax in flat[len(panels) :]:
        ax.set_visible(False)
    if heading:
        title(flat[0], heading)
    if len(panels) > 1:
        letters(flat[: len(panels)])
    if len(lines) > 1:
        shared_legend(made, flat[0])
    return made


def _along(study: StudyColumns) -> str:
    """Path that points are drawn over: what is imposed if it varies, else the last parameter."""
    paths = [axis[0] for axis in study.paths if not is_seed(axis)] or [RUNS]
    return ([path for path in paths if path.startswith("loading")] or paths)[-1]


def _panel(study: StudyColumns, name: str, label: str = "") -> Panel:
    """Panel of a column, in the unit in which it reads best."""
    column = study.column(name)
    numbers = column.dtype.kind == "f"
    factor, unit = readable(study.unit(name), column) if numbers else (1.0, "-")
    return name, axis_label((label or name).replace("_", " "), unit), factor
