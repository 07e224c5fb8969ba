r"""Sobol' indices: which assumptions the variance of a quantity comes from, all varied at once.

With every assumption spread over its range, evenly or by ratios, the first-order index of one is
the part of the variance that it causes by itself, :math:`S_i = V(E(Y | x_i)) / V(Y)`, and the total
index that in which it has a part, alone or together with others (Sobol' 1993; Homma and Saltelli
1996). Estimated by scipy with the scheme of Saltelli et al. 2010 on a scrambled Sobol' sequence.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from attrs import field, frozen

from ..accuracy import Accuracy
from ..errors import DescriptionError, InfeasibleError
from ..export.lines import aligned
from ..scene.tabular import Contents, Quantity, Tabular
from .paths import axes
from .sensitivity import Range, answers, is_wide, ranges_of

__all__ = ["SobolIndices", "sobol_indices"]

_CONFIDENCE = 0.95  # of the intervals, the usual level
# Resamples of the bootstrap: ends of intervals repeat to a tenth of their width. Twice as many cost
# twice the 0.2 s. Those of scipy (BCa) are nan where an assumption has no part at all.
_RESAMPLES = 400
# Of the scrambled sequence and of the resamples: any is as good, and one gives the same every time.
_SEED = 0
_Interval = tuple[float, float]


@frozen(eq=False)
class SobolIndices(Tabular):
    """Sobol' indices of a quantity, the assumption with the largest total index first.

    Attributes
    ----------
    quantity, unit : str
        Name of the quantity, and its unit.
    paths : tuple of str
        Paths of the assumptions.
    first, total : tuple of float
        First-order and total index of each [-]. Estimates: a first-order index near zero may come
        out a little negative.
    first_interval, total_interval : tuple of (float, float)
        Their 95 % intervals, by bootstrap.
    mean, deviation : float
        Of the quantity over all samples.
    n : int
        Samples of each of the two matrices; ``n (d + 2)`` scenes were run.
    """

    quantity: str
    unit: str
    paths: tuple[str, ...]
    first: tuple[float, ...]
    total: tuple[float, ...]
    first_interval: tuple[_Interval, ...] = field(repr=False)
    total_interval: tuple[_Interval, ...] = field(repr=False)
    mean: float
    deviation: float
    n: int

    def table(self) -> str:
        """Return the indices with their intervals as text."""
        rows = [("assumption", "first order", "total")]
        firsts = map(_text, self.first, self.first_interval)
        totals = map(_text, self.total, self.total_interval)
        rows += zip(self.paths, firsts, totals, strict=True)
        head = f"{self.quantity} = {self.mean:.4g} +- {self.deviation:.3g} {self.unit}"
        return "\n".join([head, *aligned(rows)])

    def __str__(self) -> str:
        """Return the table."""
        return self.table()

    def contents(self) -> Contents:
        """Return the indices with the ends of their intervals."""
        axis = ("assumption",)
        found = {"assumption": Quantity(axis, np.array(self.paths), "-")}
        for name in ("first", "total"):
            ends = np.array(getattr(self, f"{name}_interval")).reshape(-1, 2)
            found[name] = Quantity(axis, np.array(getattr(self, name)), "-")
            found[f"{name}_low"] = Quantity(axis, ends[:, 0], "-")
            found[f"{name}_high"] = Quantity(axis, ends[:, 1], "-")
        found["mean"] = Quantity((), self.mean, self.unit, self.quantity)
        found["deviation"] = Quantity((), self.deviation, self.unit)
        return Contents(axis, found, {"title": f"Sobol indices of {self.quantity}"})


def _text(value: float, interval: _Interval) -> str:
    return f"{value:.3f} ({interval[0]:.3f} to {interval[1]:.3f})"


def sobol_indices(
    scene: Any,
    ranges: Mapping[Any, Range | tuple[Any, Any]],
    quantity: str | Callable[[Any], float],
    accuracy: Accuracy | None = None,
    *,
    n: int = 64,
    unit: str | None = None,
    workers: int = 1,
    progress: Callable[[float], None] | None = None,
) -> SobolIndices:
    """Vary all assumptions at once, and find out which of them the variance comes from.

    The tornado of `sensitivity` moves one at a time from the scene as it is, and does not see what
    two do together; this does, for ``n (d + 2)`` runs of d assumptions.

    Parameters
    ----------
    scene : ContactScene, SeparationScene or SlidingScene, or that of a device
        The scene as it is; values that are not varied are taken from it.
    ranges : mapping of str to Range
        Plausible range by the dotted path of the assumption, a number each; spread evenly, and by
        ratios in a range of more than a decade.
    quantity, accuracy, unit, workers, progress
        As of `sensitivity`.
    n : int
        Samples of each of the two matrices, a power of 2. The intervals state the error of the
        indices, which falls about as 1/n; 64 tell large from small. The scrambled sequence is the
        same every time.

    Returns
    -------
    SobolIndices
        The indices, the largest total one first.

    Raises
    ------
    DescriptionError
        If a path, a range or the quantity does not exist, or a range is none of numbers.
    InfeasibleError
        If some scenes of the ranges have no answer: a variance is not known then.

    Examples
    --------
    Release time, whose logarithm is a sum: viscosity and gap act together.

    >>> import contactkit as ck
    >>> oil = ck.Liquid(name="oil", viscosity=0.1, surface_tension=0.03)
    >>> face = ck.Flat(radius=1e-3)
    >>> scene = ck.SeparationScene(
    ...     interface=ck.Interface(lower=face, upper=face, meniscus=ck.Meniscus(liquid=oil)),
    ...     loading=ck.ImposedTime(time=1.0, initial_gap=5e-6, final_gap=2e-5),
    ...     effects=(ck.ViscousForce(),),
    ... )
    >>> found = ck.sobol_indices(
    ...     scene,
    ...     {"interface.meniscus.liquid.viscosity": (0.05, 0.15), "loading.initial_gap":
    ...      ("4.9 um", "5.1 um")},
    ...     "viscous_impulse",
    ...     n=32,
    ... )
    >>> found.paths[0], found.first[0] > 0.9
    ('interface.meniscus.liquid.viscosity', True)
    """
    from scipy import stats  # some 0.3 s to import, for this alone

    if isinstance(n, bool) or not isinstance(n, int) or n < 2 or n & (n - 1):
        raise DescriptionError("n", n, "be a power of 2, as 64: so is a balanced sample")
    spans = _spans(scene, accuracy or Accuracy.standard, ranges)
    d = len(spans)
    sobol: Any = stats.qmc.Sobol
    both = sobol(d=2 * d, seed=_SEED).random(n)
    a, b = both[:, :d], both[:, d:]
    samples = [a, b]
    for i in range(d):
        mixed = a.copy()
        mixed[:, i] = b[:, i]
        samples.append(mixed)
    rows = [_values(spans, row) for sample in samples for row in sample]
    found = answers(scene, rows, quantity, accuracy, unit=unit, workers=workers, progress=progress)
    results = np.array(found.results, dtype=np.float64)
    _check_known(results, found.messages)
    return _indices(tuple(spans), results.reshape(d + 2, n), (found.name, found.unit))


def _spans(
    scene: Any, accuracy: Accuracy, ranges: Mapping[Any, Range | tuple[Any, Any]]
) -> dict[str, _Interval]:
    """Ends of the ranges in SI units, by the path of a number."""
    spans: dict[str, _Interval] = {}
    for path, given in ranges_of(ranges).items():
        (axis,) = axes(scene, accuracy, {path: (given.low, given.high)})
        low, high = axis.values[0][0], axis.values[-1][0]
        if len(axis.paths) > 1 or not (isinstance(low, float) and isinstance(high, float)):
            raise DescriptionError(
                f"ranges[{path!r}]", given, "be a range of one number: others have no variance"
            )
        spans[path] = (low, high)
    return spans


def _values(spans: dict[str, _Interval], row: Any) -> dict[str, Any]:
    """Values at a place of the unit cube."""
    found: dict[str, Any] = {}
    for (path, (low, high)), x in zip(spans.items(), row.tolist(), strict=True):
        by_ratio = is_wide(low, high)
        found[path] = low * (high / low) ** x if by_ratio else low + (high - low) * x
    return found


def _check_known(results: Any, messages: list[str]) -> None:
    missing = [i for i, value in enumerate(results.tolist()) if not math.isfinite(value)]
    if not missing:
        return
    raise InfeasibleError(
        f"{len(missing)} of {len(messages)} scenes have no answer, so that the variance is not "
        f"known; narrow the ranges. The first: {messages[missing[0]] or 'no result'}"
    )


def _indices(paths: tuple[str, ...], results: Any, named: tuple[str, str]) -> SobolIndices:
    sampled = results[:2].ravel()
    mean, deviation = float(sampled.mean()), float(sampled.std())
    n = results.shape[1]
    if not deviation > 0.0:  # nothing varies, and nothing has a part in it
        nothing, none = (0.0,) * len(paths), ((0.0, 0.0),) * len(paths)
        return SobolIndices(*named, paths, nothing, nothing, none, none, mean, deviation, n)
    first, total = _estimated(results)
    draws = np.random.default_rng(_SEED).integers(n, size=(_RESAMPLES, n))
    again = np.array([_estimated(results[:, draw]) for draw in draws])
    tail = 0.5 * (1.0 - _CONFIDENCE)
    low, high = np.quantile(again, (tail, 1.0 - tail), axis=0)
    order = np.argsort(-total, kind="stable").tolist()

    def ends(kind: int) -> tuple[_Interval, ...]:
        return tuple((float(low[kind, i]), float(high[kind, i])) for i in order)

    return SobolIndices(
        *named,
        tuple(paths[i] for i in order),
        tuple(float(first[i]) for i in order),
        tuple(float(total[i]) for i in order),
        ends(0),
        ends(1),
        mean,
        deviation,
        n,
    )


def _estimated(results: Any) -> tuple[Any, Any]:
    """First-order and total indices of answers: of both matrices, and of each mixed one."""
    from scipy import stats

    if not results[:2].std() > 0.0:  # a resample of a single sample
        nothing = np.zeros(len(results) - 2)
        return nothing, nothing
    d = len(results) - 2
    mixed = results[2:] if d > 1 else results[[2, 0]]  # scipy takes two at least: one of no part
    given = {"f_A": results[:1], "f_B": results[1:2], "f_AB": mixed[:, None, :]}
    estimate: Any = stats.sobol_indices  # its stubs know functions alone, no answers
    found = estimate(func=given, n=results.shape[1])
    return np.ravel(found.first_order)[:d], np.ravel(found.total_order)[:d]
