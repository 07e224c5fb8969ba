"""Figures of fits: data and model, residuals, what decides a parameter, profiles, correlations."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ..fitting.fitted import FittedCurve, short_names
from ..fitting.result import Fit
from .axis_units import axis_label, readable
from .curves import log_where_wide
from .style import Axes, figure, legend, series

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = ["correlation", "data", "information", "residuals"]


def data(fit: Fit, ax: Axes | None = None) -> Axes:
    """Draw the readings with their noise, and the fitted model as lines."""
    ax = ax if ax is not None else figure()[1]
    x_factor, x_label = _along(fit)
    first = fit.curves[0]
    factor, unit = readable(first.units[1], np.concatenate([c.measured for c in fit.curves]))
    for i, curve in enumerate(fit.curves):
        style = series(i)
        order = np.argsort(curve.x, kind="stable")
        x = curve.x[order] / x_factor
        ax.errorbar(
            x,
            curve.measured[order] / factor,
            curve.noise[order] / factor,
            ls="",
            marker=style["marker"],
            ms=style["ms"],
            color=style["color"],
            elinewidth=0.8,
            label=_label(fit, curve, "measured"),
        )
        label = "fitted" if i == len(fit.curves) - 1 else None
        ax.plot(x, curve.model[order] / factor, color=style["color"], lw=1.4, label=label)
    ax.set_xlabel(x_label)
    ax.set_ylabel(axis_label(first.quantity.replace("_", " "), unit))
    every = [
        np.concatenate(parts)
        for parts in zip(*((c.x, c.measured) for c in fit.curves), strict=True)
    ]
    log_where_wide(ax, every[0] / x_factor, every[1] / factor)
    legend(ax)
    return ax


def residuals(fit: Fit, ax: Axes | None = None) -> Axes:
    """Draw the residuals in units of the noise over the axis of the data."""
    ax = ax if ax is not None else figure(size=(7.0, 3.0))[1]
    x_factor, x_label = _along(fit)
    ax.axhspan(-1.0, 1.0, color="0.92", zorder=0)
    ax.axhline(0.0, color="0.5", lw=0.8)
    for i, curve in enumerate(fit.curves):
        style = series(i) | {"ls": ""}
        ax.plot(curve.x / x_factor, curve.residuals, label=_label(fit, curve, "residual"), **style)
    ax.set_xlabel(x_label)
    ax.set_ylabel("residual / noise")
    if len(fit.curves) > 1:
        legend(ax)
    return ax


def information(fit: Fit, ax: Axes | None = None) -> Axes:
    """Draw which readings decide which parameter: their part of the information."""
    ax = ax if ax is not None else figure(size=(7.0, 3.2))[1]
    x_factor, x_label = _along(fit)
    names = short_names([one.name for one in fit.parameters])
    for i, name in enumerate(names):
        for k, curve in enumerate(fit.curves):
            order = np.argsort(curve.x, kind="stable")
            label = name.replace("_", " ") if k == 0 else None
            percent = 100.0 * curve.fractions[order, i]
            ax.plot(curve.x[order] / x_factor, percent, label=label, **series(i))
    ax.set_xlabel(x_label)
    ax.set_ylabel("information [%]")
    ax.set_ylim(0.0, None)
    legend(ax)
    return ax


def correlation(fit: Fit, ax: Axes | None = None) -> Axes:
    """Draw the correlations of the parameters."""
    names = [name.replace("_", " ") for name in short_names([p.name for p in fit.parameters])]
    n = len(names)
    if ax is None:
        ax = figure(size=(2.4 + 0.8 * n, 1.8 + 0.6 * n))[1]
    ax.grid(visible=False)
    ax.imshow(fit.correlation, vmin=-1.0, vmax=1.0, cmap="RdBu_r")
    for i in range(n):
        for j in range(n):
            value = float(fit.correlation[i, j])
            color = "w" if abs(value) > 0.6 else "k"
            ax.text(j, i, f"{value:+.2f}", ha="center", va="center", color=color, fontsize="small")
    ax.set_xticks(range(n), names, rotation=30, ha="right")
    ax.set_yticks(range(n), names)
    return ax


def _along(fit: Fit) -> tuple[float, str]:
    """Factor of the axis that curves of one unit have in common, and its label."""
    first = fit.curves[0]
    values: NDArray[np.float64] = np.concatenate([curve.x for curve in fit.curves])
    factor, unit = readable(first.units[0], values)
    return factor, axis_label(first.over.rpartition(".")[2].replace("_", " "), unit)


def _label(fit: Fit, curve: FittedCurve, word: str) -> str:
    return curve.name if len(fit.curves) > 1 else word
