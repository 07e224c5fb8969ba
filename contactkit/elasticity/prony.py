r"""Linear viscoelasticity: a modulus as a Prony series, its creep, complex modulus and fit.

Symbols:

========  =========================================================================
E(t)      relaxation modulus ``E_e + sum E_i exp(-t/tau_i)`` [Pa]
E_e, E_0  equilibrium modulus E(inf), instantaneous modulus E(0) [Pa]
J(t)      creep compliance ``J_0 + sum J_k (1 - exp(-t/lambda_k))`` [1/Pa]
E*(s)     s times the Laplace transform of E(t), at a rate s [1/s]; E*(i omega) is the
          complex modulus. E*(s) J*(s) = 1.
========  =========================================================================

Arguments are not checked: `scene.solids.viscoelastic` and `fit_prony` are the entry points.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..arguments import listed
from ..errors import DescriptionError

__all__ = [
    "CreepSeries",
    "PronyFit",
    "PronySeries",
    "creep_compliance",
    "creep_of",
    "fit_prony",
    "modulus_at_rate",
    "relaxation_modulus",
    "storage_and_loss",
]

Array = NDArray[np.float64]

# Halvings of a bracket: a root as close to its pole as 1e-60 of the bracket keeps its digits.
_HALVINGS = 200
# Fitted terms below this fraction of all are round-off of the fit.
_ZERO = 1e-12


class PronySeries(NamedTuple):
    """Relaxation modulus: that at equilibrium [Pa], moduli [Pa] and relaxation times [s], (n,)."""

    equilibrium: float
    moduli: ArrayLike
    times: ArrayLike


class CreepSeries(NamedTuple):
    """Creep compliance: the instantaneous one [1/Pa], terms [1/Pa], retardation times [s], (n,)."""

    instantaneous: float
    compliances: Array
    times: Array


class PronyFit(NamedTuple):
    """A fitted series, and what it misses: root mean square and largest, over |E*| [-]."""

    series: PronySeries
    error: float
    largest_error: float


def _terms(series: PronySeries) -> tuple[Array, Array]:
    moduli = np.asarray(series.moduli, dtype=np.float64)
    return moduli, np.asarray(series.times, dtype=np.float64)


def relaxation_modulus(series: PronySeries, time: ArrayLike) -> Array:
    """Relaxation modulus E(t) [Pa] at times [s] from a step of strain on.

    Examples
    --------
    >>> rubber = PronySeries(1e6, [3e6], [2.0])
    >>> relaxation_modulus(rubber, [0.0, 2.0, 1e3]).round(-4).tolist()
    [4000000.0, 2100000.0, 1000000.0]
    """
    moduli, times = _terms(series)
    t = np.asarray(time, dtype=np.float64)
    return np.asarray(series.equilibrium + np.exp(-t[..., None] / times) @ moduli)


def modulus_at_rate(series: PronySeries, rate: ArrayLike) -> Array:
    r"""Modulus ``E*(s) = E_e + sum E_i s tau_i/(1 + s tau_i)`` [Pa] at real rates s >= 0 [1/s].

    It takes the place of Young's modulus in the transform of a quasi-static problem at a constant
    Poisson's ratio (elastic-viscoelastic correspondence: Lee, Quart. Appl. Math. 13, 1955, 183).
    E_e at the rate 0, E_0 at infinity.

    Examples
    --------
    >>> modulus_at_rate(PronySeries(1e6, [3e6], [2.0]), [0.0, 0.5, np.inf]).tolist()
    [1000000.0, 2500000.0, 4000000.0]
    """
    moduli, times = _terms(series)
    with np.errstate(divide="ignore"):
        period = 1.0 / np.asarray(rate, dtype=np.float64)[..., None]
    return np.asarray(series.equilibrium + (times / (times + period)) @ moduli)


def storage_and_loss(series: PronySeries, frequency: ArrayLike) -> tuple[Array, Array]:
    """Storage and loss modulus [Pa] at angular frequencies [rad/s], the parts of E*(i omega).

    Examples
    --------
    >>> storage, loss = storage_and_loss(PronySeries(1e6, [3e6], [2.0]), [0.5])
    >>> float(storage[0]), float(loss[0])
    (2500000.0, 1500000.0)
    """
    storing, losing = _spectrum(np.asarray(frequency, dtype=np.float64), _terms(series)[1])
    moduli = _terms(series)[0]
    return np.asarray(series.equilibrium + storing @ moduli), np.asarray(losing @ moduli)


def _spectrum(frequency: Array, times: Array) -> tuple[Array, Array]:
    """Storage and loss per modulus of a term, (..., n) each."""
    x = frequency[..., None] * times
    return x * x / (1.0 + x * x), x / (1.0 + x * x)


def creep_of(series: PronySeries) -> CreepSeries:
    r"""Creep compliance of a relaxation modulus, exactly: ``1/E*(s)`` in partial fractions.

    .. math:: \sum_i \frac{E_i \tau_i}{\lambda_k - \tau_i} = E_e, \qquad
        J_k = \lambda_k \Big/ \sum_i \frac{E_i \tau_i}{(1 - \tau_i/\lambda_k)^2}

    Each retardation time lies above its relaxation time and below the next one, so that it is
    found by bisection of the distance to the former. E_e, moduli and times must be positive, the
    times ascending.

    Examples
    --------
    The standard linear solid, ``lambda = tau E_0/E_e`` and ``J_1 = 1/E_e - 1/E_0``:

    >>> creep = creep_of(PronySeries(1e6, [3e6], [2.0]))
    >>> round(float(creep.times[0]), 12), round(float(creep.compliances[0]) * 1e6, 12)
    (8.0, 0.75)
    """
    moduli, times = _terms(series)
    stiff = series.equilibrium
    weights = moduli * times
    upper = np.append(times[1:], times[-1] + weights.sum() / stiff) if times.size else times
    width = upper - times
    low, high = np.zeros(times.size), np.ones(times.size)
    between = times[:, None] - times  # of a root's own pole from the others
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        with np.errstate(divide="ignore", invalid="ignore"):
            beyond = (weights / (between + (width * middle)[:, None])).sum(axis=1) > stiff
        low, high = np.where(beyond, middle, low), np.where(beyond, high, middle)
    distance = width * high
    found = times + distance
    slope = (weights * (found[:, None] / (between + distance[:, None])) ** 2).sum(axis=1)
    return CreepSeries(1.0 / (stiff + float(moduli.sum())), found / slope, found)


def creep_compliance(creep: CreepSeries, time: ArrayLike) -> Array:
    """Creep compliance J(t) [1/Pa] at times [s] from a step of stress on.

    Examples
    --------
    >>> creep = creep_of(PronySeries(1e6, [3e6], [2.0]))
    >>> (creep_compliance(creep, [0.0, 1e9]) * 1e6).round(12).tolist()
    [0.25, 1.0]
    """
    t = np.asarray(time, dtype=np.float64)[..., None]
    return np.asarray(creep.instantaneous - np.expm1(-t / creep.times) @ creep.compliances)


def fit_prony(
    frequency: ArrayLike, storage: ArrayLike, loss: ArrayLike, terms_per_decade: float = 2.0
) -> PronyFit:
    r"""Fit a series of non-negative terms to tabulated storage and loss moduli.

    .. math:: \min_{E_e, E_i \ge 0} \sum_j \frac{|E^*(i \omega_j) - E'_j - i E''_j|^2}
              {E'^2_j + E''^2_j}

    Relaxation times are equally spaced in their logarithm over the reciprocal frequencies;
    terms that are fitted to zero are left out.

    Parameters
    ----------
    frequency : array_like, shape (m,)
        Angular frequencies [rad/s], positive: 2 pi times those in hertz.
    storage, loss : array_like, shape (m,)
        Storage and loss moduli [Pa], positive; numbers, or texts such as ``"1.2 MPa"``.
    terms_per_decade : float
        Relaxation times to a decade of frequency [-].

    Returns
    -------
    PronyFit
        The series, and what it misses.

    Raises
    ------
    DescriptionError
        For tables that do not fit each other, values that are not positive and finite, and a
        material whose modulus falls to nothing at low frequencies: a liquid has no equilibrium.

    Notes
    -----
    Outside the range of the table the series is a guess: it has a plateau on both sides. A single
    exponential between the times is missed by 5 % at most with two terms to a decade; the broad
    spectra of polymers are met better.

    Examples
    --------
    >>> omega = np.logspace(-2, 2, 9)
    >>> storage, loss = storage_and_loss(PronySeries(1e6, [3e6], [1.0]), omega)
    >>> fit = fit_prony(omega, storage, loss)
    >>> len(fit.series.moduli), round(fit.series.equilibrium), fit.largest_error < 1e-12
    (1, 1000000, True)
    """
    from scipy.optimize import nnls

    omega, elastic, viscous = (
        _column(name, values, unit)
        for name, values, unit in (
            ("frequency", frequency, "rad/s"),
            ("storage", storage, "Pa"),
            ("loss", loss, "Pa"),
        )
    )
    if not omega.size == elastic.size == viscous.size:
        sizes = (omega.size, elastic.size, viscous.size)
        raise DescriptionError("fit_prony(frequency, storage, loss)", sizes, "be of one length")
    if not (np.isfinite(terms_per_decade) and terms_per_decade > 0.0):
        raise DescriptionError("fit_prony(terms_per_decade)", terms_per_decade, "be positive")
    first, last = 1.0 / omega.max(), 1.0 / omega.min()
    n = 1 + round(terms_per_decade * float(np.log10(last / first)))
    times = np.geomspace(first, last, n)
    storing, losing = _spectrum(omega, times)
    size = np.hypot(elastic, viscous)
    rows = [np.column_stack([np.ones(omega.size), storing]), np.pad(losing, ((0, 0), (1, 0)))]
    matrix = np.concatenate([one / size[:, None] for one in rows])
    found, _ = nnls(matrix, np.concatenate([elastic / size, viscous / size]))
    if not found[0] > _ZERO * found.sum():
        raise DescriptionError(
            "fit_prony(storage)",
            float(elastic[np.argmin(omega)]),
            "have a plateau at low frequencies: the fit has no equilibrium modulus",
            unit="Pa",
            hint="the table is that of a liquid, or ends before the plateau: add lower frequencies;"
            " or storage and loss are swapped",
        )
    kept = found[1:] > _ZERO * found.sum()
    series = PronySeries(float(found[0]), found[1:][kept], times[kept])
    mine = storage_and_loss(series, omega)
    misses = np.hypot(mine[0] - elastic, mine[1] - viscous) / size
    return PronyFit(series, float(np.sqrt(np.mean(misses**2))), float(misses.max()))


def _column(name: str, values: ArrayLike, unit: str) -> Array:
    column = listed(f"fit_prony({name})", values, unit)
    wrong = np.flatnonzero(column <= 0.0)
    if wrong.size:
        hint = f"it is at index {wrong[0]}; leave out that row"
        value = float(column[wrong[0]])
        raise DescriptionError(f"fit_prony({name})", value, "be positive", unit=unit, hint=hint)
    return column
