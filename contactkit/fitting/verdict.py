"""Verdicts of a fit in words: what the data decide, what they do not, what the model misses."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from scipy import stats

from ..units import quantity_text
from ..validity import ValidityNumber
from .data import MeasuredCurve, by_curve
from .intervals import Interval, Linear
from .parameters import Parameter

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

__all__ = ["decided_by", "goodness", "runs_of_signs", "undecided", "verdict_of"]

# Standard deviation of a value of which only its range is known, over the range: 1/sqrt(12). Data
# that leave more of a combination add nothing to the range.
_OF_RANGE = 1.0 / math.sqrt(12.0)
# Components of a direction that are named, over the largest.
_NAMED = 0.1
# Information of a curve that its deciding part holds, at least.
_MOST = 2.0 / 3.0
# Probability below which chi^2 or the runs of signs are taken for more than chance: once in a
# thousand fits of a right model.
_CHANCE = 1e-3


def verdict_of(
    interval: Interval, parameter: Parameter, names: Sequence[str], has_slope: bool
) -> str:
    """Verdict on one parameter: decided, decided on one side, or not identifiable, and by what."""
    if not has_slope:
        return "not identifiable from these data: it does not change what was measured"
    low, high = interval.low, interval.high
    if not low.is_open and not high.is_open:
        return "decided"
    reasons = dict.fromkeys(
        names[j] for end in (low, high) for j in end.held_by if names[j] != parameter.name
    )
    through = f"; with it moves {', '.join(reasons)}" if reasons else ""
    failed = next((end.reason for end in (low, high) if end.reason), "")
    through += f"; no result beyond: {failed}" if failed else ""
    if low.is_open and high.is_open:
        return f"not identifiable from these data within its bounds{through}"
    side = "below" if low.is_open else "above"
    return f"bounded by the data on one side only: {side} the interval ends at a bound{through}"


def undecided(
    parameters: Sequence[Parameter], values: Sequence[float], linear: Linear, factor: float
) -> list[str]:
    """Combinations of parameters that the data leave open, in words.

    A combination is left open if the data leave more of it than the ranges do; of two positive
    parameters it is a product of powers, and the one across it is decided.
    """
    found = []
    for singular, direction in zip(linear.singular, linear.directions, strict=True):
        if factor < _OF_RANGE * singular:
            continue
        largest = float(np.max(np.abs(direction)))
        named = [i for i in range(len(parameters)) if abs(direction[i]) >= _NAMED * largest]
        if len(named) > 1:
            found.append(_combination(parameters, values, linear, factor, (named, direction)))
    return found


def _combination(
    parameters: Sequence[Parameter],
    values: Sequence[float],
    linear: Linear,
    factor: float,
    which: tuple[Sequence[int], Floats],
) -> str:
    """Parameters that change together without effect; of two, also what of them is decided."""
    named, direction = which
    text = " and ".join(parameters[i].name for i in named)
    widths = np.array([one.ends[1] - one.ends[0] for one in parameters])
    # Changes of the logarithms, or of the values where one may be zero, with the coordinates.
    is_product = all(parameters[i].low > 0.0 for i in named)
    rates = np.array(
        [
            one.slope(one.scaled(value)) / (value if is_product else 1.0)
            for one, value in zip(parameters, values, strict=True)
        ]
    )
    moves = direction * widths * rates
    if len(named) != 2 or not is_product:
        parts = ", ".join(
            f"{parameters[i].short} {moves[i]:+.2g}{'' if is_product else ' ' + parameters[i].unit}"
            for i in named
        )
        how = " of their logarithms" if is_product else ""
        return (
            f"{text} are not identifiable each from these data: they do not decide where these "
            f"move together, by {parts}{how}"
        )
    i, j = named
    power = -moves[i] / moves[j]
    across = np.zeros(len(parameters))
    across[i], across[j] = rates[i], power * rates[j]
    spread = _deviation_across(linear, across * widths)
    known = f"{parameters[i].short} * {parameters[j].short}^{power:.3g}"
    percent = f"{100.0 * factor * spread:.2g} %"
    return (
        f"{text} are not identifiable each from these data; what the data decide is {known} "
        f"to {percent}"
    )


def _deviation_across(linear: Linear, across: Floats) -> float:
    """Standard deviation of a combination, from the directions that the data decide."""
    along = linear.directions @ across
    is_decided = linear.singular > 1.0 / _OF_RANGE
    parts = np.where(is_decided, along / np.where(is_decided, linear.singular, 1.0), 0.0)
    return float(np.linalg.norm(parts))


def decided_by(
    curves: Sequence[MeasuredCurve],
    axes: Sequence[str],
    others: Sequence[str],
    fractions: Floats,
) -> str:
    """Part of the data that decides a parameter: the curve that weighs most, and where along it."""
    *parts, rest = by_curve(curves, fractions)
    weights = [float(part.sum()) for part in parts]
    best = int(np.argmax(weights))
    weight, curve, unit = weights[best], curves[best], axes[best]
    largest, name = max(zip(rest.tolist(), others, strict=True), default=(0.0, ""))
    if largest > weight:
        return f"{name} ({100.0 * largest:.0f} % of the information)"
    order = np.argsort(curve.x, kind="stable")
    mine = parts[best][order]
    first, last = _shortest(curve.x[order], mine, _MOST * weight)
    inside = float(mine[first : last + 1].sum())
    ends = (quantity_text(float(curve.x[order][k]), unit) for k in (first, last))
    where = " to ".join(dict.fromkeys(ends))
    name = f"{curve.name}: " if len(curves) > 1 else ""
    return (
        f"{name}{curve.over.rpartition('.')[2]} {where} ({100.0 * inside:.0f} % of the information)"
    )


def _shortest(x: Floats, weights: Floats, wanted: float) -> tuple[int, int]:
    """Shortest part of an axis with at least some weight."""
    sums = np.concatenate([[0.0], np.cumsum(weights)])
    best, length = (0, x.size - 1), math.inf
    for first in range(x.size):
        last = int(np.searchsorted(sums, sums[first] + wanted * (1.0 - 1e-9), side="left")) - 1
        if last >= x.size:
            break
        last = max(last, first)
        if x[last] - x[first] < length:
            best, length = (first, last), float(x[last] - x[first])
    return best


def runs_of_signs(residuals: Floats) -> float:
    """Number of runs of one sign beside that of chance, in standard deviations of it.

    The test of Wald and Wolfowitz (1940).
    Far below zero neighbours agree: the model misses the data by more than noise.

    Examples
    --------
    >>> round(runs_of_signs(np.array([1.0] * 10 + [-1.0] * 10)), 2)
    -4.14
    """
    signs = residuals[residuals != 0.0] > 0.0
    n_up, n_down = int(signs.sum()), int((~signs).sum())
    if min(n_up, n_down) == 0:
        return -math.sqrt(signs.size)
    n = n_up + n_down
    mean = 2.0 * n_up * n_down / n + 1.0
    variance = (mean - 1.0) * (mean - 2.0) / max(n - 1.0, 1.0)
    runs = 1 + int(np.count_nonzero(signs[1:] != signs[:-1]))
    return (runs - mean) / math.sqrt(max(variance, 1e-12))


_FEW = 8  # readings below which the runs of signs say nothing: 2 of 8 have a chance of 1 %


def goodness(
    chi2: float,
    dof: int,
    residuals: Sequence[tuple[MeasuredCurve, Floats]],
    error: float,
) -> tuple[ValidityNumber, ...]:
    """Numbers that state whether model, noise and solver fit the data."""
    found = []
    if dof > 0 and not any(curve.is_estimated for curve, _ in residuals):
        high = float(stats.chi2.isf(_CHANCE, dof)) / dof
        found.append(
            ValidityNumber(
                name="chi^2 over degrees of freedom",
                value=chi2 / dof,
                high=high,
                detail="above it the model misses the data, or their noise is larger than given",
                source="chi^2 test at 0.001",
            )
        )
    low = float(stats.norm.ppf(_CHANCE))
    for curve, part in residuals:
        if part.size >= _FEW:
            found.append(
                ValidityNumber(
                    name=f"runs of signs of the residuals, {curve.name}",
                    value=runs_of_signs(part[np.argsort(curve.x, kind="stable")]),
                    low=low,
                    detail="below it neighbouring residuals agree: the model, not the noise, is "
                    "missed, and the intervals are too short",
                    source="Wald and Wolfowitz 1940",
                )
            )
    found.append(
        ValidityNumber(
            name="error of the solver over the noise",
            value=error,
            high=1.0,
            detail="as its settings state it; above 1 give a finer accuracy",
        )
    )
    return tuple(found)
