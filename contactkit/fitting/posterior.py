"""Posterior of a fit, by the ensemble sampler of emcee."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from attrs import field, frozen

from ..extras import require
from ..scene.curve import Curve, Shown
from ..studies.study import check_whole
from ..validity import ValidityNumber
from .fitted import FittedParameter, Searched, short_names

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

__all__ = ["Posterior", "sampled"]

_BEGINNING = 0.2  # of the steps that are left out: while walkers spread from the fit
# Autocorrelation times in a chain from which its quantiles are right to about a tenth of the
# standard deviation (Foreman-Mackey et al. 2013, section 4).
_TIMES = 50.0
# Spread of the first walkers over the ranges: a part of the interval, so that all have a result.
_SPREAD, _WIDEST = 0.3, 0.05


@frozen(eq=False)
class Posterior(Curve):
    """Samples of the parameters of a fit, in no order; a column for each.

    Attributes
    ----------
    columns : mapping of str to (ndarray, str)
        Samples and unit by the end of the path of each parameter.
    acceptance : float
        Fraction of the steps that were taken [-].
    autocorrelation_time : float
        Steps after which a walker has forgotten where it was, the longest of all parameters [-].
    """

    axis: str
    samples: dict[str, tuple[Floats, str]] = field(repr=False)
    acceptance: float
    autocorrelation_time: float
    n_steps: int

    @property
    def title(self) -> str:
        """See `Curve.title`."""
        n = len(next(iter(self.samples.values()))[0])
        return f"posterior of {len(self.samples)} parameters, {n} samples"

    @property
    def sources(self) -> tuple[str, ...]:
        """See `Curve.sources`."""
        return ("ensemble sampler: Goodman and Weare 2010, as in emcee (Foreman-Mackey 2013)",)

    @property
    def shown(self) -> Shown:
        """See `Curve.shown`."""
        return {}

    @property
    def validity(self) -> tuple[ValidityNumber, ...]:
        """See `Curve.validity`."""
        return (
            ValidityNumber(
                name="steps over the autocorrelation time",
                value=self.n_steps / self.autocorrelation_time,
                low=_TIMES,
                detail="below it the quantiles are uncertain: sample more steps",
                source="Foreman-Mackey et al. 2013",
            ),
        )

    def table(self) -> dict[str, tuple[Any, str]]:
        """Return the samples by parameter, each with its unit."""
        return dict(self.samples)

    def scalars(self) -> dict[str, tuple[float, str]]:
        """Return medians and 68 % intervals of the parameters, and how good the chain is."""
        found = dict[str, tuple[float, str]]()
        for name, (values, unit) in self.samples.items():
            ends = np.quantile(values, [0.5, 0.15865, 0.84135]).tolist()
            pairs = zip(("", "_low", "_high"), ends, strict=True)
            found |= {f"{name}{end}": (value, unit) for end, value in pairs}
        return found | {
            "acceptance": (self.acceptance, "-"),
            "autocorrelation_time": (self.autocorrelation_time, "-"),
        }


def sampled(
    searched: Searched,
    parameters: Sequence[FittedParameter],
    n_steps: int,
    n_walkers: int,
    seed: int,
) -> Posterior:
    """Sample the posterior of a fit; see `Fit.sample`.

    Raises
    ------
    MissingExtraError
        If emcee is not installed.
    """
    check_whole("n_steps", n_steps, 10)
    check_whole("n_walkers", n_walkers, 0)
    check_whole("seed", seed, 0)
    require("emcee", "a posterior")
    import emcee

    problem, best, linear, _ = searched
    n = best.place.size
    walkers = n_walkers or max(8, 4 * n)
    check_whole("n_walkers", walkers, 2 * n)

    def log_probability(place: Floats) -> float:
        if np.any(place < problem.ends[0]) or np.any(place > problem.ends[1]):
            return -np.inf
        residuals = problem.residuals(place)
        chi2 = float(residuals @ residuals)
        return -0.5 * chi2 if np.isfinite(chi2) else -np.inf

    random = np.random.default_rng(seed)
    spread = np.minimum(_SPREAD * linear.deviation, _WIDEST * problem.width)
    first = best.place + spread * random.standard_normal((walkers, n))
    margin = 1e-6 * problem.width
    first = np.clip(first, problem.ends[0] + margin, problem.ends[1] - margin)
    sampler = emcee.EnsembleSampler(walkers, n, log_probability)
    sampler.random_state = np.random.RandomState(seed).get_state()
    sampler.run_mcmc(first, n_steps)
    times = sampler.get_autocorr_time(tol=0, quiet=True)
    chain = sampler.get_chain(discard=int(_BEGINNING * n_steps), flat=True)
    names = short_names([one.name for one in parameters])
    values = np.array([problem.values(place) for place in chain]).T
    columns = {
        name: (column, one.unit)
        for name, column, one in zip(names, values, parameters, strict=True)
    }
    time = float(np.nanmax(times)) if np.isfinite(times).any() else float(n_steps)
    return Posterior("sample", columns, float(np.mean(sampler.acceptance_fraction)), time, n_steps)
