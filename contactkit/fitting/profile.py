"""Profile likelihood of a parameter: least chi^2 over all others, along its values."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np
from attrs import field, frozen

from ..errors import ContactkitError
from ..scene.curve import Curve, Shown
from ..studies.study import check_whole
from .fitted import FittedParameter, Searched, short_names
from .intervals import profiled

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

__all__ = ["Profile", "profile_of"]


@frozen(eq=False)
class Profile(Curve):
    """Rise of the least chi^2 over the values of one parameter; arrays of one shape.

    Attributes
    ----------
    axis : str
        End of the path of the parameter.
    values : ndarray, shape (n,)
        Its values; those without a result are left out.
    rise : ndarray, shape (n,)
        Least chi^2 less that of the fit: 1 at the ends of a 68 % interval, 3.84 of 95 %.
    others : mapping of str to ndarray
        The other parameters there.
    """

    shown: ClassVar[Shown] = {"rise": (("rise",), "")}

    axis: str
    values: Floats = field(repr=False)
    unit_of_values: str
    rise: Floats = field(repr=False)
    others: dict[str, tuple[Floats, str]] = field(repr=False)

    @property
    def title(self) -> str:
        """See `Curve.title`."""
        return f"profile likelihood of {self.axis}"

    @property
    def sources(self) -> tuple[str, ...]:
        """See `Curve.sources`."""
        return ("profile likelihood: Venzon and Moolgavkar 1988",)

    def table(self) -> dict[str, tuple[Any, str]]:
        """Return the columns by name, each with its unit."""
        own = {self.axis: (self.values, self.unit_of_values), "rise": (self.rise, "-")}
        return own | self.others


def profile_of(
    searched: Searched,
    parameters: Sequence[FittedParameter],
    i: int,
    n: int,
    reach: float,
) -> Profile:
    """Profile of a parameter; see `Fit.profile`.

    Raises
    ------
    ContactkitError
        If no value has a result.
    """
    check_whole("n", n, 2)
    problem, best, linear, _ = searched
    model = problem.model.parameters
    here = float(best.place[i])
    half = max(abs(model[i].scaled(end) - here) for end in (parameters[i].low, parameters[i].high))
    low, high = (
        float(np.clip(here + sign * reach * half, *problem.ends[:, i])) for sign in (-1.0, 1.0)
    )
    rows = []
    for at in np.linspace(low, high, n).tolist():
        try:
            found = profiled(problem, best, linear, i, at)
        except ContactkitError:
            continue
        rows.append((*problem.values(found.place), max(found.chi2 - best.chi2, 0.0)))
    if not rows:
        raise ContactkitError(f"the profile of {parameters[i].name} has no result at any value")
    columns = np.array(rows).T
    names = short_names([one.name for one in parameters])
    others = {names[j]: (columns[j], one.unit) for j, one in enumerate(parameters) if j != i}
    return Profile(names[i], columns[i], parameters[i].unit, columns[-1], others)
