"""Comparison of fits of several models to the same data: which one the data ask for."""

from __future__ import annotations

import math
from collections.abc import Mapping
from html import escape
from typing import TYPE_CHECKING

import numpy as np
from attrs import field, frozen

from ..errors import DescriptionError
from ..scene.tabular import Contents, Quantity, Tabular
from ..validity import ValidityNumber
from .result import Fit

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

__all__ = ["FitComparison", "compare_fits"]

# Difference of the criterion from which the worse model has essentially no support: a weight of
# 0.007 (Burnham and Anderson 2002, section 2.6).
_NONE = 10.0
_CLOSE = 2.0  # below it the data do not choose: weights within a factor of 2.7


@frozen(eq=False)
class FitComparison(Tabular):
    """Fits of several models to the same data, the one with the least criterion first.

    Attributes
    ----------
    names : tuple of str
        Of the models.
    aicc, difference, weight : ndarray, shape (n,)
        Corrected criterion of Akaike, less the least one, and the probability that follows.
    n_parameters, chi2 : ndarray, shape (n,)
        As of the fits.
    outside : tuple of tuple of ValidityNumber
        Numbers of each fitted scene that are out of the range of a model.
    """

    names: tuple[str, ...]
    aicc: Floats = field(repr=False)
    difference: Floats = field(repr=False)
    weight: Floats
    n_parameters: Floats = field(repr=False)
    chi2: Floats = field(repr=False)
    outside: tuple[tuple[ValidityNumber, ...], ...] = field(repr=False)

    @property
    def verdict(self) -> str:
        """The model that the data ask for, and whether it is in its own range."""
        first, second = self.names[:2]
        behind = float(self.difference[1])
        if behind < _CLOSE:
            text = f"the data do not choose between {first} and {second}"
        elif behind < _NONE:
            text = f"the data prefer {first} to {second}"
        else:
            text = f"the data ask for {first}; {second} has no support"
        text += f" (AICc behind by {behind:.3g})"
        for i, name in enumerate(self.names):
            if self.outside[i]:
                found = (f"{v.name} = {v.value:.3g}, {v.bounds}" for v in self.outside[i])
                text += f"; {name} is out of its range there: {', '.join(found)}"
        return text

    def table(self) -> str:
        """Return a line for each model as text."""
        width = max(map(len, self.names))
        lines = [f"{'model':{width}s}  parameters      chi^2       AICc  behind  weight"]
        columns = (self.n_parameters, self.chi2, self.aicc, self.difference, self.weight)
        for name, k, chi2, aicc, behind, weight in zip(self.names, *columns, strict=True):
            lines.append(
                f"{name:{width}s}  {k:10.0f} {chi2:10.4g} {aicc:10.5g} {behind:7.3g} {weight:7.3f}"
            )
        return "\n".join([*lines, self.verdict])

    def __str__(self) -> str:
        """Return the table."""
        return self.table()

    def _repr_html_(self) -> str:
        """The table in a notebook."""
        return f"<pre>{escape(self.table())}</pre>"

    def contents(self) -> Contents:
        """Return a row for each model."""
        rows = ("model",)
        found = {
            "model": Quantity(rows, np.array(self.names), "-"),
            "n_parameters": Quantity(rows, self.n_parameters, "-"),
            "chi2": Quantity(rows, self.chi2, "-", "chi^2"),
            "aicc": Quantity(rows, self.aicc, "-", "AICc"),
            "difference": Quantity(rows, self.difference, "-", "AICc less the least"),
            "weight": Quantity(rows, self.weight, "-", "Akaike weight"),
        }
        return Contents(rows, found, {"title": self.verdict})


def compare_fits(fits: Mapping[str, Fit]) -> FitComparison:
    r"""Compare fits of several models to the same data by their information criterion.

    .. math:: \mathrm{AICc} = -2\ln L + 2k + \frac{2k(k+1)}{n-k-1}

    with the likelihood L, n data and k parameters, an estimated noise among them. What each model
    states of its own range at the fitted values, such as the Tabor number of an adhesive contact or
    the weight of a meniscus, stands beside the verdict.

    Parameters
    ----------
    fits : mapping of str to Fit
        At least two, by the name of their model.

    Raises
    ------
    DescriptionError
        If there are fewer than two, or their data differ.

    Notes
    -----
    Burnham and Anderson (2002). The criterion compares models and does not state that one of them
    is right: `Fit.misfit` does.
    """
    if not isinstance(fits, Mapping) or len(fits) < 2:
        raise DescriptionError("fits", fits, "be at least two fits by the names of their models")
    for name, one in fits.items():
        if not isinstance(one, Fit):
            raise DescriptionError(f"fits[{name!r}]", one, "be a Fit")
    (first, other), *_ = fits.items()
    for name, one in fits.items():
        if not _same_data(other, one):
            raise DescriptionError("fits", name, f"be of the same data as {first!r}")
    infinite = [name for name, one in fits.items() if not math.isfinite(one.aicc)]
    if infinite:
        hint = "it takes two readings more than parameters, an estimated noise among these"
        raise DescriptionError("fits", ", ".join(infinite), "have a criterion", hint=hint)
    order = sorted(fits, key=lambda name: fits[name].aicc)
    aicc = np.array([fits[name].aicc for name in order])
    behind = aicc - aicc[0]
    weight = np.exp(-0.5 * behind)
    return FitComparison(
        tuple(order),
        aicc,
        behind,
        weight / weight.sum(),
        np.array([len(fits[name].parameters) for name in order], dtype=np.float64),
        np.array([fits[name].chi2 for name in order]),
        tuple(_outside(fits[name]) for name in order),
    )


def _same_data(one: Fit, other: Fit) -> bool:
    """Whether two fits are of the same readings."""
    if len(one.curves) != len(other.curves):
        return False
    return all(
        np.array_equal(a.x, b.x) and np.array_equal(a.measured, b.measured)
        for a, b in zip(one.curves, other.curves, strict=True)
    )


def _outside(fit: Fit) -> tuple[ValidityNumber, ...]:
    own = ("chi^2", "runs of signs", "error of the solver")
    return tuple(v for v in fit.validity if v.is_valid is False and not v.name.startswith(own))
