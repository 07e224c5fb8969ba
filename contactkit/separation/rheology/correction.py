"""Correction of an estimate by solutions on a grid, over gap and rate of shear."""

from __future__ import annotations

import math
from collections.abc import Callable

from attrs import field, frozen

from ...errors import ConvergenceError

__all__ = ["Correction"]

_GAPS, _RATES = 2, 3
"""Points in a decade of gap and of rate: cubics through them leave 5e-4 of the force of Eyring's
law with Barus' on a square and of the kink of a power law, 1e-4 of others. One gap in a decade
leaves 3e-3, two rates 8e-4."""


@frozen(eq=False)
class Correction:
    """A function of gap and rate of shear that changes slowly, known at points of a lattice.

    Points are evaluated when they are first needed, and cubics in the logarithms go through the
    four nearest of each direction.

    Parameters
    ----------
    exact : callable
        Value at a gap [m] and a rate [1/s], positive; nan where there is none. Where it does not
        settle, as at rates that no motion has, that of the next lower rate is taken.
    gap : float, optional
        Gap [m] that stands for all, of a function of the rate alone.

    Examples
    --------
    >>> made = Correction(lambda gap, rate: math.log(rate) ** 2)
    >>> round(made(1e-6, 300.0), 9) == round(math.log(300.0) ** 2, 9)
    True
    """

    exact: Callable[[float, float], float]
    gap: float | None = None
    _known: dict[tuple[int, int], float] = field(factory=dict, init=False, repr=False)

    def __call__(self, gap: float, rate: float) -> float:
        """Value at a gap [m] and a rate [1/s]."""
        along = _weights(rate, _RATES)
        across = {0: 1.0} if self.gap is not None else _weights(gap, _GAPS)
        return math.fsum(
            a * b * self._at(i, j) for i, a in across.items() for j, b in along.items()
        )

    def _at(self, i: int, j: int) -> float:
        """Value at a point of the lattice."""
        if (i, j) not in self._known:
            gap = 10.0 ** (i / _GAPS) if self.gap is None else self.gap
            try:
                self._known[i, j] = self.exact(gap, 10.0 ** (j / _RATES))
            except ConvergenceError:
                self._known[i, j] = self._at(i, j - 1)
        return self._known[i, j]


def _weights(place: float, per_decade: int) -> dict[int, float]:
    """Weights of the four nearest points: Lagrange's polynomials; of one where it lies there."""
    x = per_decade * math.log10(place)
    first = math.floor(x)
    t = x - first
    if t == 0.0:
        return {first: 1.0}
    return {
        first - 1: -t * (t - 1.0) * (t - 2.0) / 6.0,
        first: (t + 1.0) * (t - 1.0) * (t - 2.0) / 2.0,
        first + 1: -(t + 1.0) * t * (t - 2.0) / 2.0,
        first + 2: (t + 1.0) * t * (t - 1.0) / 6.0,
    }
