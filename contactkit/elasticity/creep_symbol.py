r"""Creep of a layered solid at every wavenumber, as a sum of exponentials of common times.

By the elastic-viscoelastic correspondence the compliance C(q, s) at a real rate s is that of an
elastic solid of the moduli E*(s). As a function of s it is

.. math:: C(q, s) = C(q, \infty) + \sum_k \frac{c_k(q)}{1 + s \lambda_k}, \qquad
          C(q, t) = C(q, \infty) + \sum_k c_k(q) \left(1 - e^{-t/\lambda_k}\right)

with retardation times between the shortest relaxation and the longest retardation time of the
materials. They differ from wavenumber to wavenumber; on a common set of times the c_k follow from C
at some rates by one matrix for all wavenumbers, also for transforms of influence coefficients.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

__all__ = ["CommonTimes", "common_times"]

Array = NDArray[np.float64]

# Terms to a decade of times. A single exponential between the times is met to 1e-3, 2e-4, 1e-4 and
# 5e-6 of itself with 4, 5, 6 and 8 of them (ranges of 0.3 to 8 decades, all times t); the smooth
# spectra of layers are met better.
PER_DECADE = 6.0
# Rates beyond both ends of the range, as powers of e.
_BEYOND = 2.0
# Singular values below this fraction of the largest are left out. An exponential among times of 3
# decades is then met to 3e-5 of the compliance at any time; of 6 decades, where the instantaneous
# compliance is a millionth, to 6e-3 of it (0.4 at 1e-7, and at 1e-12 round-off of C: 2).
_LEAST = 1e-9


class CommonTimes(NamedTuple):
    """Retardation times [s] (n,), rates [1/s] (m,), and the matrix (n, m + 2) that yields c_k.

    It applies to C at the rates infinity and 0 and at the others, in this order. The sum of the c_k
    is the difference of the first two: both limits are met.
    """

    times: Array
    rates: Array
    matrix: Array


def common_times(shortest: float, longest: float) -> CommonTimes:
    """Retardation times, equally spaced as Chebyshev points in their logarithm, and their matrix.

    Parameters
    ----------
    shortest, longest : float
        Range of the retardation times [s].

    Examples
    --------
    A standard linear solid, whose retardation time is none of these:

    >>> made = common_times(1.0, 50.0)
    >>> rates = np.concatenate([[np.inf, 0.0], made.rates])
    >>> terms = made.matrix @ (1.0 + 3.0 / (1.0 + rates * 7.0))
    >>> t = np.array([0.0, 7.0, 1e3])
    >>> (1.0 - np.expm1(-np.divide.outer(t, made.times)) @ terms).round(3).tolist()
    [1.0, 2.896, 4.0]
    """
    span = float(np.log(longest / shortest))
    n = 3 + round(PER_DECADE * span / np.log(10.0))
    place = 0.5 * (1.0 - np.cos(np.pi * np.arange(n) / (n - 1)))
    times = shortest * np.exp(span * place)
    rates = np.exp(np.linspace(-_BEYOND, span + _BEYOND, n + 4)) / longest
    kernel = 1.0 / (1.0 + np.outer(rates, times))
    # c = e (C_0 - C_inf)/n + B z, with B orthogonal to e = (1, ..., 1): the sum is exact.
    free = np.linalg.qr(np.ones((n, 1)), mode="complete")[0][:, 1:]
    inverse = free @ np.linalg.pinv(kernel @ free, rcond=_LEAST)
    mean = np.full(n, 1.0 / n) - inverse @ kernel.mean(axis=1)
    matrix = np.column_stack([-mean - inverse.sum(axis=1), mean, inverse])
    return CommonTimes(times, rates, matrix)
