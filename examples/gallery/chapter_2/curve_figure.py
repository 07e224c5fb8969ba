"""Panels of numbers over the load, a series with a band for each structure."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from contactkit.gallery.chapter_2 import rough_contact as rough
from contactkit.plot import gallery as plot

PANELS: Mapping[str, tuple[float, str, bool]] = {  # factor, label, whether logarithmic
    "max_pressure": (1.0 / rough.HARDNESS, "max. pressure / $H_3$", False),
    "contact_fraction": (100.0, "contact area [%]", True),
    "plastic_fraction": (100.0, "plastic area [%]", True),
    "max_displacement": (1e9, "max. displacement [nm]", False),
    "hardness": (1.0 / rough.HARDNESS, "effective hardness / $H_3$", False),
    "relative_meniscus_force": (1.0, "meniscus force / load [-]", True),
    "meniscus_force": (1e6, "meniscus force [uN]", True),
}


def draw_panel(
    ax: plot.Axes,
    loads: Sequence[float],
    column: str,
    values: np.ndarray,
    labels: Sequence[str],
    banded: Sequence[int] = (0,),
) -> None:
    """Draw a column (structures, seeds, loads) over the load."""
    factor, name, is_log = PANELS[column]
    draw_runs(ax, loads, values * factor, labels, banded)
    ax.set(xscale="log", xlabel="$p_n/E_3$", ylabel=name)
    if is_log:
        plot.log_above_zero(ax, values * factor)
    else:
        ax.set_ylim(0.0, None)


def draw_runs(
    ax: plot.Axes,
    x: Sequence[float],
    values: np.ndarray,
    labels: Sequence[str],
    banded: Sequence[int] = (0,),
) -> None:
    """Draw medians of values (structures, seeds, n), and the range of the seeds of a few.

    Bands of five structures on each other hide each other: `draw_over_first` separates them.
    """
    for i, (label, runs) in enumerate(zip(labels, values, strict=True)):
        if i in banded:
            plot.band(ax, x, runs, i, label)
        else:
            ax.plot(x, np.median(runs, axis=0), label=label, **plot.series(i))


def draw_over_first(
    ax: plot.Axes, x: Sequence[float], values: np.ndarray, labels: Sequence[str]
) -> None:
    """Draw values (structures, seeds, n) over those of the first structure on the same surface.

    Abscissae at which the first has none are left out.
    """
    known = (values[0] > 0.0).all(axis=0)
    over = values[..., known] / values[:1][..., known]
    for i, label in enumerate(labels[1:], start=1):
        plot.band(ax, np.asarray(x)[known], over[i], i, label)
    ax.axhline(1.0, color="k", lw=1.0)
    first = labels[0].partition(":")[0]
    ax.set(
        xscale="log",
        xlim=(0.7 * x[0], 1.4 * x[-1]),
        xlabel="$p_n/E_3$",
        ylabel=f"over that of {first}",
    )


def labelled(meaning: Mapping[str, str], prime: str = "") -> list[str]:
    """Names of the structures for a legend."""
    return [f"{name}{prime}: {text}" for name, text in meaning.items()]
