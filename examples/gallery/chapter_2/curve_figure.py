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
    ax: plot.Axes, loads: Sequence[float], column: str, values: np.ndarray, labels: Sequence[str]
) -> None:
    """Draw a column (structures, seeds, loads) over the load."""
    factor, name, is_log = PANELS[column]
    for i, (label, runs) in enumerate(zip(labels, values, strict=True)):
        plot.band(ax, loads, runs * factor, i, label)
    ax.set(xscale="log", xlabel="$p_n/E_3$", ylabel=name)
    if is_log:
        plot.log_above_zero(ax, values * factor)
    else:
        ax.set_ylim(0.0, None)


def labelled(meaning: Mapping[str, str], prime: str = "") -> list[str]:
    """Names of the structures for a legend."""
    return [f"{name}{prime}: {text}" for name, text in meaning.items()]
