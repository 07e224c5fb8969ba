"""Least squares in scaled parameters: residuals in units of the noise, derivatives, minimum."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from scipy.optimize import least_squares

from ..errors import ContactkitError, ConvergenceError
from .model import Model, Prediction, Slopes

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

__all__ = ["Found", "Problem", "minimum"]

# First step of a difference, of a range or of a factor e: the size of a parameter that the data
# decide to 1 %. Later steps change chi^2 by about one.
_FIRST_STEP = 0.01
# Largest step: curvature of a power of 3, such as gap^-3, costs 4 % of a forward difference there,
# and 0.5 % of a central one; smallest: round-off of a solver at 1e-10 is then 1e-4 of the slope.
_LONGEST_STEP, _SHORTEST_STEP = 0.03, 1e-6
# Change of the readings by a step over the stated error of the solver: ten times it leaves 10 % of
# error in a slope at worst; neighbouring runs share most of their error, so that far less was seen
# (0.3 % for bridges at curve_rtol = 1e-3).
_OVER_ERROR = 10.0
# Ends of the search: change of chi^2 and of the coordinates, relative. A minimum is wanted to a
# small part of an interval, which 1e-6 of the coordinates is for all that is known to 0.01 %.
_FTOL, _XTOL, _GTOL = 1e-8, 1e-8, 1e-10
_MOST_STEPS = 100  # of a search; those of the tests take 4 to 30
# The same on a profile: chi^2 to 1e-5 is 1e-3 of its rise where chi^2 is 100. A third of the runs
# of a fit with an open combination.
_ROUGH, _FEW_STEPS = 1e-5, 15


class Problem:
    """Residuals of a model, in units of the noise, over the coordinates of its parameters.

    Parameters
    ----------
    model : Model
        What predicts.
    noise : sequence of float
        Factor on the deviation of each curve: 1 where the noise is given.
    progress : callable, optional
        Called after each evaluation.
    """

    def __init__(
        self, model: Model, noise: Sequence[float], progress: Callable[[], None] | None = None
    ) -> None:
        self.model, self.noise = model, tuple(noise)
        self.ends = np.array([one.ends for one in model.parameters]).reshape(-1, 2).T
        self.width = self.ends[1] - self.ends[0]
        self.reason = ""  # of the last point without a result
        self._y = [curve.y for curve in model.curves]
        self._deviation = [
            deviation * factor
            for deviation, factor in zip(model.deviations, self.noise, strict=True)
        ]
        self._limits = model.limits()
        self._norms = np.full(len(self.width), np.nan)
        self.exact = (False,) * len(self.width)
        """Parameters whose last derivatives were exact."""
        self._progress = progress

    def values(self, place: Floats) -> tuple[float, ...]:
        """Values of the parameters at some coordinates."""
        pairs = zip(self.model.parameters, place.tolist(), strict=True)
        return tuple(one.value(at) for one, at in pairs)

    def residuals(self, place: Floats) -> Floats:
        """Residuals of readings, bounds and priors; nan where there is no result."""
        if self._progress is not None:
            self._progress()
        try:
            return self.strict_residuals(place)
        except ContactkitError as error:
            self.reason = str(error)
            return np.full(self.n_rows, np.nan)

    def strict_residuals(self, place: Floats) -> Floats:
        """The same; an error of a run is raised."""
        values = self.values(place)
        return self._rows(self.model.predict(values), values)

    @property
    def n_rows(self) -> int:
        """Number of residuals."""
        priors = sum(one.prior is not None for one in self.model.parameters)
        return sum(y.size for y in self._y) + len(self.model.bounds) + priors

    def _rows(self, found: Prediction, values: Sequence[float]) -> Floats:
        curves = [
            (y - readings) / deviation
            for y, readings, deviation in zip(self._y, found.readings, self._deviation, strict=True)
        ]
        bounds = [
            (max(low - number, 0.0) - max(number - high, 0.0)) / noise
            for number, (low, high, noise) in zip(found.numbers, self._limits, strict=True)
        ]
        priors = [
            (one.prior[0] - value) / one.prior[1]
            for one, value in zip(self.model.parameters, values, strict=True)
            if one.prior is not None
        ]
        return np.concatenate([*curves, np.array(bounds), np.array(priors)])

    def solver_error(self, place: Floats) -> float:
        """Stated error of the solver over the noise, root mean square over all readings."""
        squares = self._squared_errors(self.model.predict(self.values(place)))
        return math.sqrt(squares / sum(y.size for y in self._y))

    def _squared_errors(self, found: Prediction) -> float:
        """Squares of the stated errors over the noise, summed over the readings."""
        pairs = zip(found.errors, self._deviation, strict=True)
        return float(sum(np.sum((error / deviation) ** 2) for error, deviation in pairs))

    def slopes(self, place: Floats, *, is_central: bool = False) -> Floats:
        """Derivatives of the residuals to the coordinates: exact ones, else differences.

        Raises
        ------
        ContactkitError
            If there is no result on either side.
        """
        values = self.values(place)
        found = self.model.predict(values)
        base, error = self._rows(found, values), math.sqrt(self._squared_errors(found))
        known = self.model.slopes(values, found)
        self.exact = tuple(one is not None for one in known)
        unknown = [i for i, one in enumerate(known) if one is None]
        self.ahead(
            self._shifted(i, place, sign * self._side(i, place, error))
            for i in unknown
            for sign in ((1.0, -1.0) if is_central else (1.0,))
        )
        columns = [
            self._difference(i, place, base, error, is_central)
            if one is None
            else self._exact(i, place, found, one)
            for i, one in enumerate(known)
        ]
        slopes = np.column_stack(columns)
        self._norms = np.linalg.norm(slopes, axis=0)
        return slopes

    def ahead(self, places: Iterable[Floats]) -> None:
        """Have worker processes make the runs of some coordinates, if there are any."""
        inside = (
            place for place in places if np.all(np.abs(place - np.clip(place, *self.ends)) <= 0.0)
        )
        self.model.ahead([self.values(place) for place in inside])

    def _exact(self, i: int, place: Floats, found: Prediction, known: Slopes) -> Floats:
        factor = self.model.parameters[i].slope(float(place[i]))
        rows = [-factor * s / d for s, d in zip(known.readings, self._deviation, strict=True)]
        bounds = [
            -factor * slope / noise if number < low or number > high else 0.0
            for slope, number, (low, high, noise) in zip(
                known.numbers.tolist(), found.numbers, self._limits, strict=True
            )
        ]
        priors = [
            -factor / one.prior[1] if j == i else 0.0
            for j, one in enumerate(self.model.parameters)
            if one.prior is not None
        ]
        return np.concatenate([*rows, np.array(bounds), np.array(priors)])

    def _side(self, i: int, place: Floats, error: float) -> float:
        """Step of a difference, to the side with more room."""
        step = self._step(i, error)
        up = self.ends[1][i] - place[i] >= place[i] - self.ends[0][i]
        return step if up else -step

    def _difference(
        self, i: int, place: Floats, base: Floats, error: float, is_central: bool
    ) -> Floats:
        """Forward difference, or backward where that leaves the bounds or there is no result."""
        first = self._side(i, place, error)
        step, second = abs(first), -first
        room = place[i] - self.ends[0][i], self.ends[1][i] - place[i]
        if is_central and min(room) >= step:
            both = [self._moved(i, place, one) for one in (step, -step)]
            if all(np.isfinite(one).all() for one in both):
                return np.asarray((both[0] - both[1]) / (2.0 * step))
        for one in (first, second):
            moved = self._moved(i, place, one)
            if np.isfinite(moved).all():
                if is_central and not np.isfinite(again := self._moved(i, place, 2.0 * one)).all():
                    is_central = False
                if is_central:  # one-sided of second order, beside a bound
                    return np.asarray((4.0 * moved - again - 3.0 * base) / (2.0 * one))
                return np.asarray((moved - base) / one)
        name = self.model.parameters[i].name
        raise ConvergenceError(
            f"no result beside {name} = {self.values(place)[i]:g}: {self.reason}"
        )

    def _moved(self, i: int, place: Floats, step: float) -> Floats:
        moved = self._shifted(i, place, step)
        if not self.ends[0][i] <= moved[i] <= self.ends[1][i]:
            return np.full(self.n_rows, np.nan)
        return self.residuals(moved)

    def _shifted(self, i: int, place: Floats, step: float) -> Floats:
        moved = place.copy()
        moved[i] += step
        return moved

    def _step(self, i: int, error: float) -> float:
        """Step that changes chi^2 by about one, and the readings by more than their error."""
        norm = self._norms[i]
        scale = 1.0 if self.model.parameters[i].is_log else self.width[i]
        longest = min(_LONGEST_STEP * scale, 0.4 * self.width[i])
        if not (np.isfinite(norm) and norm > 0.0):
            return float(min(_FIRST_STEP * scale, longest))
        step = max(1.0, _OVER_ERROR * error) / norm
        return float(min(max(step, _SHORTEST_STEP * scale), longest))


class Found(NamedTuple):
    """Minimum of a search: coordinates, residuals, chi^2, and whether it converged."""

    place: Floats
    residuals: Floats
    chi2: float
    has_converged: bool


def minimum(
    problem: Problem, start: Floats, fixed: Sequence[int] = (), *, is_central: bool = False
) -> Found:
    """Least squares from a start; some coordinates may be held, as on a profile.

    Forward differences put the minimum to some 3 % of a standard deviation, central ones to less
    than 1 %.

    The method is the trust region of Branch, Coleman and Li (1999) in `scipy.optimize`, which keeps
    the bounds; a step to a point without a result is shortened.

    Raises
    ------
    ContactkitError
        If there is no result at the start.
    """
    free = np.array([i for i in range(start.size) if i not in fixed], dtype=int)
    base = problem.strict_residuals(start)
    if not free.size:
        return Found(start, base, float(base @ base), True)

    def whole(part: Floats) -> Floats:
        place = start.copy()
        place[free] = part
        return place

    def residuals_of(part: Floats) -> Floats:
        return problem.residuals(whole(part))

    def slopes_of(part: Floats) -> Floats:
        return problem.slopes(whole(part), is_central=is_central)[:, free]

    low, high = problem.ends[:, free]
    # Strictly inside, as the method needs: 1e-8 of the range changes no interval.
    margin = 1e-8 * (high - low)
    found = least_squares(
        residuals_of,
        np.clip(start[free], low + margin, high - margin),
        jac=slopes_of,
        bounds=(low, high),
        x_scale="jac",
        ftol=_ROUGH if fixed else _FTOL,
        xtol=_ROUGH if fixed else _XTOL,
        gtol=_GTOL,
        max_nfev=_FEW_STEPS if fixed else _MOST_STEPS,
    )
    residuals = np.asarray(found.fun)
    return Found(whole(found.x), residuals, float(residuals @ residuals), found.status > 0)
