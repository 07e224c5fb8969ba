"""Figures of the gallery: one style for print, series, bands over seeds, maps and sections."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from .style import SERIES, Axes, Figure, figure, letters, mpl, plain_log, save, series

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

__all__ = [
    "SERIES",
    "Axes",
    "Figure",
    "band",
    "colour_bar",
    "figure",
    "letters",
    "log_norm",
    "plain_log",
    "save_all",
    "series",
    "shared",
]


def band(ax: Axes, x: ArrayLike, runs: ArrayLike, i: int, label: str, **more: Any) -> None:
    """Draw the median of several runs as series `i`, and a band from the least to the greatest.

    Parameters
    ----------
    ax : Axes
        Where to draw.
    x : array_like (n,)
        Abscissa.
    runs : array_like (seeds, n)
        One row for each run.
    i : int
        Number of the series.
    label : str
        Its name in the legend.
    **more
        Further arguments of ``plot``.
    """
    values = np.asarray(runs, float)
    style = series(i, **more)
    ax.fill_between(x, values.min(0), values.max(0), color=style["color"], alpha=0.16, lw=0.0)
    ax.plot(x, np.median(values, axis=0), label=label, **style)


def log_above_zero(ax: Axes, values: ArrayLike) -> None:
    """Make the ordinate logarithmic, four decades at most below the largest of some values.

    Zeros are cut off; a panel of zeros alone reads "none".
    """
    known = np.asarray(values, float)
    top = float(np.nanmax(known))
    if not top > 0.0:
        ax.set(ylim=(0.0, 1.0), yticks=[])
        ax.text(0.5, 0.5, "none", transform=ax.transAxes, ha="center")
        return
    least = float(np.nanmin(known[known > 0.0]))
    ax.set_yscale("log", nonpositive="clip")
    ax.set_ylim(0.7 * max(least, 1e-4 * top), 1.5 * top)


def save_all(made: Figure, path: Path, *, for_print: bool = True) -> list[Path]:
    """Write a figure as PNG, each file whole or not at all, the same bytes every time.

    Also as PDF and SVG, for print.
    """
    kinds = ("png", "pdf", "svg") if for_print else ("png",)
    return [save(made, path.with_suffix(f".{k}"), dpi=120, bbox_inches="tight") for k in kinds]


def colour_bar(made: Figure, axes: Any, levels: Sequence[float], label: str, **more: Any) -> None:
    """Draw the colours of contours or maps between levels, beside several panels."""
    norm = mpl.colors.BoundaryNorm(list(levels), mpl.colormaps["cividis"].N, extend="max")
    shown = mpl.cm.ScalarMappable(norm, "cividis")
    bar = made.colorbar(shown, ax=axes, **({"shrink": 0.9, "aspect": 30} | more))
    bar.set_label(label)


def log_norm(top: float, decades: float = 2.0) -> Any:
    """Logarithmic colours over some decades below a value."""
    return mpl.colors.LogNorm(top * 10.0**-decades, top, clip=True)


def shared(made: Figure, ax: Axes, columns: int = 3) -> None:
    """Put the legend of one panel below the whole figure."""
    handles, labels = ax.get_legend_handles_labels()
    made.legend(handles, labels, loc="outside lower center", ncols=columns, fontsize=8)
