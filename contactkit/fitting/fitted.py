"""Parts of the result of a fit: parameters with intervals, curves with residuals, cost."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from attrs import field, frozen

from ..studies.columns import labels_of
from ..units import readable_unit
from .intervals import Linear
from .search import Found, Problem

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

__all__ = ["FitWork", "FittedCurve", "FittedParameter", "Searched", "short_names"]


@frozen
class FittedParameter:
    """A parameter with its interval, and what the data say of it.

    Attributes
    ----------
    name, unit : str
        Path in the scene, or name of the nuisance; SI unit.
    value, low, high : float
        Fitted value, and ends of its 68 % interval.
    bounds : (float, float)
        Bounds that it was sought between.
    verdict : str
        Whether the data decide it.
    decided_by : str
        Part of the data that does, with its fraction of the information.
    is_profile : bool
        Whether the interval is of a profile likelihood, not of the covariance.
    is_log : bool
        Whether the logarithm was fitted.
    reason : str
        Why its range is plausible, as given.
    """

    name: str
    unit: str
    value: float
    low: float
    high: float
    bounds: tuple[float, float]
    verdict: str
    decided_by: str
    is_profile: bool
    is_log: bool
    reason: str = ""

    @property
    def is_decided(self) -> bool:
        """Whether the data end its interval on both sides."""
        return self.verdict.startswith("decided")

    @property
    def text(self) -> str:
        """Value and interval with a unit that suits them.

        Examples
        --------
        >>> bounds = (1e-6, 3e-6)
        >>> one = FittedParameter("gap", "m", 2e-6, 1.9e-6, 2.1e-6, bounds, "", "", True, True)
        >>> one.text
        '2 um (1.9 to 2.1)'
        """
        size = max(abs(self.value), abs(self.high - self.low))
        factor, unit = readable_unit(size, self.unit)
        low, value, high = (f"{v / factor:.4g}" for v in (self.low, self.value, self.high))
        return f"{value}{'' if unit == '-' else f' {unit}'} ({low} to {high})"


@frozen(eq=False)
class FittedCurve:
    """A measured curve beside what the fitted scene gives.

    Attributes
    ----------
    name, over, quantity : str
        As of the `MeasuredCurve`.
    units : (str, str)
        SI units of axis and quantity.
    x, measured, model, noise : ndarray, shape (n,)
        Positions, readings, what the model gives, and the standard deviation of a reading.
    is_estimated : bool
        Whether the noise is estimated from the residuals.
    fractions : ndarray, shape (n, n_parameters)
        Part of each reading in what decides each parameter.
    """

    name: str
    over: str
    quantity: str
    units: tuple[str, str]
    x: Floats = field(repr=False)
    measured: Floats = field(repr=False)
    model: Floats = field(repr=False)
    noise: Floats = field(repr=False)
    is_estimated: bool
    fractions: Floats = field(repr=False)

    @property
    def residuals(self) -> Floats:
        """Readings less model, in units of the noise."""
        return np.asarray((self.measured - self.model) / self.noise)


class FitWork(NamedTuple):
    """Cost of a fit."""

    n_runs: int
    n_evaluations: int
    seconds: float


class Searched(NamedTuple):
    """The search of a fit that was made in this session, for profiles and posteriors."""

    problem: Problem
    best: Found
    linear: Linear
    factor: float


def short_names(names: Sequence[str]) -> list[str]:
    """Shortest ends of paths that are still different.

    Examples
    --------
    >>> short_names(["interface.lower.surface.radius", "interface.upper.surface.radius", "zero"])
    ['lower.surface.radius', 'upper.surface.radius', 'zero']
    """
    firsts = [name.partition(",")[0] for name in names]
    labels = labels_of(firsts, firsts)
    return [labels[one] for one in firsts]
