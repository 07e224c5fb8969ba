"""Branch of bridges of given pressure: initial guesses, and the curve up to its limit.

Symbols are those of `delaunay`; lengths are in the unit of the caller. At fixed pressure a bridge
is stable only if its volume increases with pressure: a smaller range than at fixed volume, and
empty between flats.
"""

from __future__ import annotations

import math
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...errors import ConvergenceError, InfeasibleError
from .chart import Pair
from .continuation import FreeBranch, march_free
from .newton import BridgeProblem, Solution, from_neck, problem, solve
from .volume_branch import Branch, march

__all__ = ["branch_at_pressure", "from_film", "holds"]

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]
Two = tuple[Array, Array]

# Of the contact circles, over the smaller radius of the bodies: wide enough for films of 1e12 times
# the curvature of pressure, and for the equator. The table only brackets a start of Newton's
# method.
_RADII = np.geomspace(1e-9, 0.98, 400)


def holds(found: Solution) -> Flags:
    """Whether the iteration converged to a bridge that is stable at fixed pressure."""
    at = found.found
    second_by_neck = -at.shape_by_neck - at.ends.pressure
    determinant = -at.gap_by_neck * at.shape_by_chart - at.gap_by_chart * second_by_neck
    result: Flags = found.good & (determinant > 0.0)
    return result


def _film(gap: Array, pressure: Array, angles: Two, curvatures: Two) -> tuple[Array, Flags]:
    """Largest contact radius at which a thin film has the pressure, and whether there is one."""
    sharp = np.maximum(curvatures[0], curvatures[1])
    x = _RADII[:, None] / sharp
    height, pull = gap + 0.0 * x, 0.0 * x
    for angle, curvature in zip(angles, curvatures, strict=True):
        slope = np.arcsin(curvature * x)
        height = height + x * np.tan(0.5 * slope)
        pull = pull + np.cos(angle + slope)
    excess = pull / height - 1.0 / x + pressure
    falls = (excess[:-1] > 0.0) & (excess[1:] <= 0.0)
    i = falls.shape[0] - 1 - np.argmax(falls[::-1], axis=0)
    column = np.arange(gap.size)
    high, low = excess[i, column], excess[i + 1, column]
    fraction = high / (high - low)
    radius: Array = x[i, column] ** (1.0 - fraction) * x[i + 1, column] ** fraction
    wet: Flags = np.any(falls, axis=0)
    return radius, wet


class FromFilm(NamedTuple):
    """Bridge at the end of the iteration from a thin film, and whether such a film exists."""

    found: Solution
    wet: Flags


def from_film(gap: Array, pressure: Array, angles: Two, curvatures: Two) -> FromFilm:
    """Newton iteration from a thin film of given pressure."""
    given = problem(gap, pressure, angles, curvatures, at_pressure=True)
    radius, wet = _film(gap, pressure, angles, curvatures)
    return FromFilm(from_neck(given, np.log(radius), 1.0 - radius * pressure), wet)


@lru_cache(maxsize=512)
def branch_at_pressure(
    pressure: float,
    angle_lower: float,
    angle_upper: float,
    curvature_lower: float,
    curvature_upper: float,
) -> Branch | FreeBranch:
    """Branch of bridges of one pressure from touching bodies to the limit."""
    angles = np.array([angle_lower]), np.array([angle_upper])
    curvatures = np.array([curvature_lower]), np.array([curvature_upper])

    def given(level: float) -> BridgeProblem:
        return problem(np.zeros(1), np.array([level]), angles, curvatures, at_pressure=True)

    with np.errstate(all="ignore"):
        # A film starts Newton's method well only at pressures far below zero: lower the pressure
        # until it does, then come back in steps of the drop, shorter ones where one fails.
        sharp = max(curvature_lower, curvature_upper)
        drop, level = 0.0, pressure
        found, _ = from_film(np.zeros(1), np.array([level]), angles, curvatures)
        while not holds(found)[0]:
            drop = max(4.0 * drop, sharp, abs(pressure))
            if drop > 1e9 * (sharp + abs(pressure)):
                raise InfeasibleError(_DRY)
            level = pressure - drop
            found, _ = from_film(np.zeros(1), np.array([level]), angles, curvatures)
        ratio = 0.5
        while drop > 0.0:
            trial = drop * ratio if drop > 1e-3 * (sharp + abs(pressure)) else 0.0
            part = given(pressure - trial)
            part = part._replace(bodies=part.bodies.swapped(found.flipped))
            new = solve(part, found.log_neck, found.chart, found.flipped)
            if holds(new)[0]:
                drop, found = trial, new
            elif ratio > 0.99:
                if found.found.ends.sine_second[0] < -0.99:
                    raise InfeasibleError(_DROWNED)
                raise InfeasibleError(_DRY)
            else:
                ratio = math.sqrt(ratio)
        return _followed(found, given(pressure).bodies, pressure)


def _followed(found: Solution, bodies: Pair, pressure: float) -> Branch | FreeBranch:
    try:
        return march(
            found.bodies,
            bool(found.flipped[0]),
            float(found.log_neck[0]),
            float(found.chart[0]),
            pressure,
        )
    except ConvergenceError:
        return march_free(bodies, found.unknowns[:, 0], 0.0, pressure)


_DROWNED = (
    "no bridge of this pressure was found between touching bodies: its liquid would immerse the "
    "smaller sphere; a more negative pressure (a lower humidity) may allow one"
)
_DRY = (
    "no bridge is stable at this pressure even between touching bodies: it would evaporate, or "
    "grow without bound; a more negative pressure (a lower humidity) or smaller contact angles "
    "may allow one"
)
