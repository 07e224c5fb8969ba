"""Figures of the gallery: one style for print, series, bands over seeds, maps and sections."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ..files.scenes import write_whole
from .separation import STYLE, Axes, Figure, figure, mpl, plain_log

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

SERIES: tuple[tuple[str, Any, str], ...] = (
    ("#000000", "-", "o"),
    ("#0072b2", "--", "s"),
    ("#d55e00", "-.", "^"),
    ("#009e73", ":", "D"),
    ("#cc79a7", (0, (5, 1, 1, 1, 1, 1)), "v"),
    ("#e69f00", (0, (8, 3)), "P"),
    ("#56b4e9", (0, (1, 1)), "X"),
)
"""Colour, line and marker of each series: the colours of Okabe and Ito, told apart by all readers,
and in grey by line and marker."""


def series(i: int, **more: Any) -> dict[str, Any]:
    """Style of series `i`, as arguments of ``plot``.

    Examples
    --------
    >>> series(1, lw=1.0)
    {'color': '#0072b2', 'ls': '--', 'marker': 's', 'ms': 3.5, 'lw': 1.0}
    """
    colour, line, marker = SERIES[i % len(SERIES)]
    return {"color": colour, "ls": line, "marker": marker, "ms": 3.5} | more


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


def letters(axes: Sequence[Axes], titles: Sequence[str]) -> None:
    """Number panels (a), (b) ... and name them."""
    for i, (ax, text) in enumerate(zip(axes, titles, strict=True)):
        ax.set_title(f"({chr(97 + i)}) {text}", loc="left", fontsize=10)


def save_all(made: Figure, path: Path, *, for_print: bool = True) -> list[Path]:
    """Write a figure as PNG, each file whole or not at all, the same bytes every time.

    Also as PDF and SVG, for print.
    """
    undated: dict[str, dict[str, None]] = {
        "png": {"Software": None},
        "pdf": {"CreationDate": None},
        "svg": {"Date": None},
    }
    written = []
    for kind in undated if for_print else ("png",):
        metadata, file = undated[kind], path.with_suffix(f".{kind}")
        with (
            write_whole(file) as temporary,
            mpl.rc_context({**STYLE, "svg.hashsalt": "contactkit", "savefig.dpi": 120}),
        ):
            made.savefig(temporary, format=kind, metadata=metadata, bbox_inches="tight")
        written.append(file)
    return written


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
