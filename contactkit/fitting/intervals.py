"""Intervals of fitted parameters: covariance where the problem is linear, profiles where not."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from scipy import stats

from ..errors import ContactkitError
from .search import Found, Problem, minimum

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

__all__ = [
    "LEVEL",
    "BetterFitError",
    "End",
    "Interval",
    "Linear",
    "interval",
    "level_factor",
    "linearised",
    "places_of_ends",
    "profiled",
]

LEVEL = 0.6827
"""Confidence of the intervals: one standard deviation of a normal distribution."""

# Slope that no other parameter takes up over the whole slope, below which nothing is left of it:
# differences are right to some 1e-6 where others do.
_ROUND_OFF = 1e-6
# Singular values over the largest that are left out of how others move: moves along them are
# arbitrary, and their slopes errors of differences.
_TAKEN = 1e-7
# Part of a range from its end that counts as the end.
_AT_END = 1e-3
# Departure of the rise of chi^2 from that of the linearised problem, at the ends of an interval, up
# to which the interval is taken from the covariance: 0.2 is 10 % of its length.
_LINEAR = 0.2
_FLAT = 0.01  # rise of chi^2 that no end of an interval is near: 10 % of a half interval
_CLOSE = 0.02  # of the root of the rise of chi^2, at an end: 2 % of a half interval
_MOST_TRIES = 12
# Fall of chi^2 below its minimum that is another minimum, and not the tolerance of the search.
_BETTER = 0.02


class BetterFitError(ContactkitError):
    """A profile came to a lower chi^2 than that of the fit; `place` is where."""

    def __init__(self, place: Floats) -> None:
        super().__init__("a profile came to a better fit")
        self.place = place


class Linear(NamedTuple):
    """Linearised problem at a minimum.

    Attributes
    ----------
    slopes : ndarray, shape (n_rows, n)
        Derivatives of the residuals to the coordinates.
    singular, directions : ndarray, shape (n,) and (n, n)
        Singular values and directions, of coordinates in units of their ranges.
    moves : ndarray, shape (n, n)
        Row i: how all coordinates move with coordinate i where chi^2 stays least.
    rests : ndarray, shape (n_rows, n)
        Column i: the slope to coordinate i that no other coordinate can take up. Its norm is the
        inverse of the standard deviation.
    """

    slopes: Floats
    singular: Floats
    directions: Floats
    moves: Floats
    rests: Floats

    @property
    def deviation(self) -> Floats:
        """Standard deviation of each coordinate; infinite where others take up its slope."""
        norms = np.linalg.norm(self.rests, axis=0)
        whole = np.linalg.norm(self.slopes, axis=0)
        known = norms > _ROUND_OFF * whole
        return np.asarray(np.where(known, 1.0 / np.where(known, norms, 1.0), np.inf))

    def correlation(self, width: Floats) -> Floats:
        """Correlations of the coordinates, with their ranges as what is known beside the data.

        The variance of a range is 1/12 of its square; without it what the data leave open would
        have none.
        """
        squares = self.singular**2 + 12.0
        covariance = (self.directions.T / squares) @ self.directions * np.outer(width, width)
        d = np.sqrt(np.diag(covariance))
        return np.asarray(np.clip(covariance / np.outer(d, d), -1.0, 1.0))

    def fractions(self) -> Floats:
        """Part of each residual in what decides each parameter, ``(n_rows, n)``; columns add to 1.

        The estimate of a parameter is the projection of the residuals on its column of `rests`, so
        that its variance is a sum over them.
        """
        total = np.sum(self.rests**2, axis=0)
        return np.asarray(self.rests**2 / np.where(total > 0.0, total, 1.0))


class End(NamedTuple):
    """End of an interval: its coordinate, and what ends it if the data do not."""

    place: float
    held_by: tuple[int, ...] = ()
    reason: str = ""

    @property
    def is_open(self) -> bool:
        """Whether a bound ends the interval, of the parameter or of another, or a run fails."""
        return bool(self.held_by or self.reason)


class Interval(NamedTuple):
    """Both ends, and whether they are of a profile."""

    low: End
    high: End
    is_profile: bool


def linearised(problem: Problem, place: Floats) -> Linear:
    """Slopes at a minimum by central differences, and what follows from them."""
    slopes = problem.slopes(place, is_central=True)
    width, n = problem.width, len(problem.width)
    scaled = slopes * width
    _, singular, directions = np.linalg.svd(scaled, full_matrices=True)
    singular = np.pad(singular, (0, n - singular.size))
    moves, rests = np.eye(n), np.empty_like(slopes)
    for i in range(n):
        others = [j for j in range(n) if j != i]
        taken = np.linalg.lstsq(scaled[:, others], scaled[:, i], rcond=_TAKEN)[0]
        moves[i, others] = -taken * width[others] / width[i]
        rests[:, i] = (scaled[:, i] - scaled[:, others] @ taken) / width[i]
    return Linear(slopes, singular, directions, moves, rests)


def level_factor(problem: Problem, n_data: int) -> float:
    """Half length of an interval over the standard deviation; Student's if noise is estimated."""
    dof = n_data - len(problem.width)
    if any(curve.is_estimated for curve in problem.model.curves) and dof > 0:
        return float(stats.t.ppf(0.5 + 0.5 * LEVEL, dof))
    return 1.0


def interval(
    problem: Problem, best: Found, linear: Linear, i: int, factor: float, method: str
) -> Interval:
    """Interval of a parameter: of the covariance if that puts the ends right, else profiled.

    Raises
    ------
    BetterFitError
        If a lower chi^2 is found.
    """
    if method != "profile" and (method == "linear" or _is_linear(problem, best, linear, i, factor)):
        half = factor * float(linear.deviation[i])
        ends = []
        for sign, bound in ((-1.0, problem.ends[0][i]), (1.0, problem.ends[1][i])):
            place = float(best.place[i]) + sign * half
            beyond = sign * (place - bound) >= 0.0
            ends.append(End(float(bound), (i,)) if beyond else End(place))
        return Interval(ends[0], ends[1], False)
    low, high = (_end(problem, best, linear, i, side * factor) for side in (-1.0, 1.0))
    return Interval(low, high, True)


def places_of_ends(problem: Problem, best: Found, linear: Linear, factor: float) -> list[Floats]:
    """Ends of all intervals as linearised, where chi^2 will be compared with its parabola."""
    halves = factor * linear.deviation
    return [
        best.place + sign * half * move
        for half, move in zip(halves, linear.moves, strict=True)
        if math.isfinite(half)
        for sign in (-1.0, 1.0)
    ]


def _is_linear(problem: Problem, best: Found, linear: Linear, i: int, factor: float) -> bool:
    """Whether chi^2 rises as linearised at both ends of the interval, inside the bounds."""
    half = factor * float(linear.deviation[i])
    if not math.isfinite(half):
        return False
    for sign in (-1.0, 1.0):
        place = best.place + sign * half * linear.moves[i]
        if np.any(place < problem.ends[0]) or np.any(place > problem.ends[1]):
            return False
        residuals = problem.residuals(place)
        rise = (float(residuals @ residuals) - best.chi2) / factor**2
        if not abs(rise - 1.0) <= _LINEAR:
            return False
    return True


def profiled(problem: Problem, best: Found, linear: Linear, i: int, at: float) -> Found:
    """Minimum over the other parameters with one held, from where the linearised problem has it.

    Where chi^2 has not risen there, as along a combination that the data leave open, that is taken.
    """
    place = np.clip(best.place + (at - best.place[i]) * linear.moves[i], *problem.ends)
    place[i] = at
    residuals = problem.residuals(place)
    chi2 = float(residuals @ residuals)
    if best.chi2 <= chi2 <= best.chi2 + _FLAT:
        return Found(place, residuals, chi2, True)
    try:
        return minimum(problem, place, (i,))
    except ContactkitError:  # none there; the others as they were
        place = best.place.copy()
        place[i] = at
        return minimum(problem, place, (i,))


def _end(problem: Problem, best: Found, linear: Linear, i: int, signed: float) -> End:
    """End of a profile on one side: where the root of the rise of chi^2 is the factor."""
    side, factor = math.copysign(1.0, signed), abs(signed)
    bound = float(problem.ends[1 if side > 0.0 else 0][i])
    far = abs(bound - float(best.place[i]))
    if far <= _AT_END * problem.width[i]:
        return End(bound, (i,))
    # Distances from the minimum with the root of the rise of chi^2 less the factor, and what was
    # found there: before the end, and beyond it.
    near, beyond = _Try(0.0, -factor, best), None
    reach = min(
        factor * float(linear.deviation[i]), _room(problem, best, linear.moves[i], side), far
    )
    for _ in range(_MOST_TRIES):
        try:
            found = profiled(problem, best, linear, i, float(best.place[i]) + side * reach)
        except ContactkitError as error:
            if reach - near.reach <= _AT_END * problem.width[i]:
                return End(float(best.place[i]) + side * near.reach, reason=str(error))
            far = reach = 0.5 * (near.reach + reach)
            continue
        rise = found.chi2 - best.chi2
        if rise < -_BETTER * max(1.0, factor**2):
            raise BetterFitError(found.place)
        here = _Try(reach, math.sqrt(max(rise, 0.0)) - factor, found)
        if here.excess < 0.0:
            near = here
            if reach >= far * (1.0 - 1e-12):
                return End(float(best.place[i]) + side * reach, (i,))
        else:
            beyond = here
        if abs(here.excess) <= _CLOSE * factor:
            beyond = here
            break
        if beyond is not None and beyond.reach - near.reach <= _AT_END * problem.width[i]:
            break
        reach = _next(near, beyond, factor, far)
    last = near if beyond is None else beyond
    return End(float(best.place[i]) + side * last.reach, _held(problem, best, last.found, i))


class _Try(NamedTuple):
    """Distance from the minimum, root of the rise of chi^2 less the factor, and the minimum."""

    reach: float
    excess: float
    found: Found


def _room(problem: Problem, best: Found, move: Floats, side: float) -> float:
    """Distance until another parameter that moves along comes to its bound."""
    moves = side * move
    bound = np.where(moves > 0.0, problem.ends[1], problem.ends[0])
    with np.errstate(divide="ignore", invalid="ignore"):
        room = np.where(moves != 0.0, (bound - best.place) / moves, np.inf)
    room = room[room > _AT_END * problem.width.min()]
    return float(room.min(initial=np.inf))


def _next(near: _Try, beyond: _Try | None, factor: float, far: float) -> float:
    """Distance to try: between two by a secant, else as far as a root that rises linearly leads."""
    if beyond is not None:
        if near.excess < -0.9 * factor:  # flat before, as along a valley to a bound: halve
            return 0.5 * (near.reach + beyond.reach)
        part = -near.excess / (beyond.excess - near.excess)
        return near.reach + min(max(part, 0.1), 0.9) * (beyond.reach - near.reach)
    return min(1.05 * near.reach * factor / max(near.excess + factor, 0.25 * factor), far)


def _held(problem: Problem, best: Found, found: Found, i: int) -> tuple[int, ...]:
    """Other parameters that came to a bound on the way: they end the interval, not the data."""
    at = [_at_end(problem, one.place) for one in (best, found)]
    return tuple(j for j in np.flatnonzero(at[1] & ~at[0]).tolist() if j != i)


def _at_end(problem: Problem, place: Floats) -> NDArray[np.bool_]:
    near = np.minimum(place - problem.ends[0], problem.ends[1] - place)
    return np.asarray(near <= _AT_END * problem.width)
