"""Figures of gradients and of Sobol' indices."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from ..contact.result import ContactResult
from ..errors import DescriptionError
from .maps import extent, hide_holes, place
from .style import Axes, figure, legend

if TYPE_CHECKING:
    from ..scene.gradient import Gradient
    from ..studies.sobol import SobolIndices

__all__ = ["gradient_map", "relative_bars", "sobol_bars"]

# Per cent of the slopes within the colours: edges of contacts, and the highest summit from which an
# approach counts, have some far larger.
_SHOWN = 98.0
_FIRST, _TOTAL = "#0072b2", "#e69f00"  # distinct to the colour-blind, and in grey


def gradient_map(gradient: Gradient, ax: Axes | None = None) -> Axes:
    """Draw the slope over the height of each pixel; white where there is none."""
    contact, slopes = gradient.result, gradient.slopes.get("heights")
    if not isinstance(contact, ContactResult) or slopes is None:
        raise DescriptionError("to", "heights", 'be given: result.gradient(of, "heights")')
    ax = ax if ax is not None else figure()[1]
    around, unit = extent(contact)
    values = np.asarray(slopes)
    size = float(np.percentile(np.abs(values[values != 0.0]), _SHOWN)) if values.any() else 1.0
    shown = np.ma.masked_where(values == 0.0, values)
    image = ax.imshow(
        shown,
        origin="lower",
        extent=around,
        cmap="RdBu_r",
        vmin=-size,
        vmax=size,
        interpolation="nearest",
    )
    hide_holes(ax, contact)
    place(ax, unit)
    bar = ax.figure.colorbar(image, ax=ax, shrink=0.85, extend="both")
    unit = gradient.slope_unit("heights")
    bar.set_label(f"slope of {_spoken(gradient.quantity)} over the height of a pixel [{unit}]")
    return ax


def relative_bars(
    gradient: Gradient, ax: Axes | None = None, names: Mapping[str, str] | None = None
) -> Axes:
    """Draw the relative change per relative change of each parameter, the largest on top."""
    rows = sorted(gradient.bases, key=lambda path: abs(gradient.relative(path)))
    if ax is None:
        _, ax = figure(1, 1, (6.0, 1.0 + 0.4 * len(rows)))
    values = [gradient.relative(path) for path in rows]
    ax.barh(range(len(rows)), values, color=_FIRST, height=0.6)
    ax.axvline(0.0, color="0.3", linewidth=0.8)
    ax.set_yticks(range(len(rows)), _labels(rows, names))
    ax.set_axisbelow(True)
    ax.set_xlabel(f"change of {_spoken(gradient.quantity)} per change of the parameter [%/%]")
    return ax


def sobol_bars(
    found: SobolIndices, ax: Axes | None = None, names: Mapping[str, str] | None = None
) -> Axes:
    """Draw first-order and total indices with their intervals, the largest on top."""
    if ax is None:
        _, ax = figure(1, 1, (6.0, 1.2 + 0.5 * len(found.paths)))
    at = np.arange(len(found.paths))[::-1]
    for shift, colour, label, values, ends in (
        (0.18, _FIRST, "first order: by itself", found.first, found.first_interval),
        (-0.18, _TOTAL, "total: with others", found.total, found.total_interval),
    ):
        off = np.abs(np.array(ends).T - np.array(values))
        ax.barh(at + shift, values, height=0.34, color=colour, label=label)
        ax.errorbar(values, at + shift, xerr=off, fmt="none", ecolor="0.2", capsize=2.0)
    ax.set_yticks(at, _labels(list(found.paths), names))
    ax.set_axisbelow(True)
    ax.set_xlabel(f"part of the variance of {_spoken(found.quantity)} [-]")
    legend(ax)
    return ax


def _labels(paths: list[str], names: Mapping[str, str] | None) -> list[str]:
    known = names or {}
    return [known.get(path, _spoken(path.rpartition(".")[2])) for path in paths]


def _spoken(name: str) -> str:
    return name.replace("_", " ")
