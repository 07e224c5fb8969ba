"""Solution of bridges at many points: a direct Newton iteration, then the branch where it fails.

Lengths are in units of the cube root of the volume, or arbitrary for bridges of given pressure.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from ...errors import ConvergenceError
from .continuation import FreeBranch
from .free_ends import descend, newton
from .newton import BridgeProblem, Solution, from_arc, problem, solve
from .pressure_branch import branch_at_pressure, from_film, holds
from .result import Columns, cylinders, from_chart, from_free
from .stability import Key, branch, is_cylinder
from .volume_branch import DETACHMENT, Branch

__all__ = ["BeyondLimitError", "columns_at"]

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]

# Error of the gap, over its maximum, above which a solution is rejected: Newton's method ends at
# 1e-13 or on another branch, so that 1e-12 to 1e-3 reject the same.
_NEAR = 1e-9


class BeyondLimitError(Exception):
    """A point whose gap exceeds the stability limit, and that limit."""

    def __init__(self, point: int, limit: float) -> None:
        super().__init__(point, limit)
        self.point, self.limit = point, limit


def _given(key: Key, gap: Array, pressure: float | None) -> BridgeProblem:
    lower, upper, below, above = (np.full(gap.size, value) for value in key)
    given = np.full(gap.size, 1.0 if pressure is None else pressure)
    at_pressure = pressure is not None
    return problem(gap, given, (lower, upper), (below, above), at_pressure=at_pressure)


def _on_curve(curve: Branch, given: BridgeProblem, gap: Array) -> Solution:
    """Newton iteration from initial guesses on the branch."""
    chart, log_neck = curve.place(gap)
    flipped = np.full(gap.size, curve.flipped)
    given = given._replace(bodies=given.bodies.swapped(flipped))
    return solve(given, log_neck, chart, flipped)


def _close(
    key: Key,
    gap: Array,
    pressure: float | None,
    curve: Branch | FreeBranch,
    columns: Columns,
    lost: Flags,
) -> None:
    """Fill in bridges at gaps below the start of the branch, outside the chart, by continuation."""
    is_flipped = isinstance(curve, Branch) and curve.flipped
    bodies = _given(key, gap[:1], pressure).bodies.swapped(np.array([is_flipped]))
    where = np.flatnonzero(lost)
    first = curve.first
    followed = descend(bodies, first[:4], float(curve.gap[0]), gap[where], pressure)
    for i, found in zip(where, followed, strict=True):
        if found is None:
            raise ConvergenceError(
                f"no bridge was found at a gap of {gap[i]:.6g} lengths, between "
                f"contact angles of {key[0]:.6g} and {key[1]:.6g} rad; a larger gap may do"
            )
        for name, value in from_free(found, is_flipped).items():
            columns[name][i] = value[0]


def _free(
    key: Key, gap: Array, pressure: float | None, curve: FreeBranch, exists: Flags
) -> Columns:
    """Columns of bridges on a branch with free ends."""
    near = np.minimum(np.maximum(gap, curve.gap[0]), curve.gap[-1])
    found, good = newton(curve.bodies, curve.place(near), near, pressure)
    columns = from_free(found, flipped=False)
    if (exists & ~good).any():
        raise ConvergenceError(
            f"no bridge was found below its limit of {curve.gap[-1]:.6g} lengths; change the gap "
            f"a little, or take the arc, arc_bridge"
        )
    closer = gap < curve.gap[0]
    if closer.any():
        _close(key, gap, pressure, curve, columns, closer)
    return columns


def _of_kind(key: Key, gap: Array, pressure: float | None) -> tuple[Columns, Flags, float]:
    """Columns at gaps of one branch, which of them exist, and its limit."""
    if is_cylinder(*key):
        limit = math.pi ** (1.0 / 3.0)
        return cylinders(gap), gap <= limit, limit
    curve = branch(*key) if pressure is None else branch_at_pressure(pressure, *key)
    limit = float(curve.gap[-1])
    exists = gap < limit if curve.kind == DETACHMENT else gap <= limit
    if isinstance(curve, FreeBranch):
        return _free(key, gap, pressure, curve, exists), exists, limit
    found = _on_curve(curve, _given(key, gap, pressure), np.minimum(gap, limit))
    columns = from_chart(found, at_pressure=pressure is not None)
    miss = abs(found.found.gap - np.minimum(gap, limit)) > _NEAR * limit
    lost = exists & (miss | ~np.isfinite(found.found.gap))
    if key[2:] != (
        0.0,
        0.0,
    ):  # Newton's method may converge to another branch
        lost |= exists & (gap < curve.gap[0]) & ~found.good
    if lost.any():
        if (gap[lost] >= curve.gap[0]).any():
            raise ConvergenceError(
                f"no bridge was found below its limit of {limit:.6g} lengths; change the gap a "
                f"little, or take the arc, arc_bridge"
            )
        _close(key, gap, pressure, curve, columns, lost)
    return columns, exists, limit


def _first_try(points: list[Array], pressure: Array | None) -> tuple[Columns, Flags]:
    """Columns by Newton's method from an approximate solution, and which are stable bridges."""
    gap, lower, upper, below, above = points
    angles, curvatures = (lower, upper), (below, above)
    if pressure is None:
        given = problem(gap, np.ones(gap.size), angles, curvatures)
        found = from_arc(given, angles, curvatures)
        return from_chart(found), found.good
    found, wet = from_film(gap, pressure, angles, curvatures)
    return from_chart(found, at_pressure=True), holds(found) & wet


def columns_at(points: list[Array], beyond: str, pressure: Array | None = None) -> Columns:
    """Columns for gaps, two angles and two curvatures, at unit volume or at given pressures.

    Raises BeyondLimitError at the first point that has none, unless `beyond` is "nan".
    """
    n = points[0].size
    # Newton's method from the arc solves most points between curved bodies at once. The branch,
    # some ten milliseconds for each pair of bodies, is followed only for what is left.
    columns: Columns = {}
    rest = np.ones(n, dtype=np.bool_)

    def put(where: NDArray[np.intp], found: Columns) -> None:
        for name, value in found.items():
            columns.setdefault(name, np.full(n, np.nan))[where] = value

    with np.errstate(all="ignore"):  # failed points are detected
        where = np.flatnonzero((points[3] > 0.0) | (points[4] > 0.0))
        if where.size:
            part = None if pressure is None else pressure[where]
            found, good = _first_try([value[where] for value in points], part)
            put(where, found)
            rest[where[good]] = False
        left = np.flatnonzero(rest)
        level = np.zeros(n) if pressure is None else pressure
        keys = np.stack((*points[1:], level))[:, left]
        unique, which = np.unique(keys, axis=1, return_inverse=True)
        for i, (*key, value) in enumerate(unique.T.tolist()):
            here = left[which.reshape(-1) == i]
            kind = (key[0], key[1], key[2], key[3])
            some, exists, limit = _of_kind(
                kind, points[0][here], None if pressure is None else value
            )
            if not exists.all() and beyond == "raise":
                raise BeyondLimitError(int(here[~exists][0]), limit)
            put(here, {name: np.where(exists, value, np.nan) for name, value in some.items()})
    return columns
