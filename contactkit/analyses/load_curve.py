"""Load curve: one contact under a series of loads or approaches, and what each point costs."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, ClassVar, NamedTuple

import numpy as np
from attrs import evolve, field, frozen

from ..arguments import listed
from ..contact.chain import ContactChain, downwards, loading_of
from ..contact.plan import ContactPlan
from ..contact.result import ContactResult
from ..contact.work import ContactWork
from ..errors import DescriptionError, NotSimulatedError
from ..frozen import FrozenDict
from ..scene.curve import Curve, Shown
from ..scene.plan import check_plan
from ..validity import ValidityNumber, note_worst, warn

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]
    Counts = NDArray[np.int64]

__all__ = ["LoadCurve", "load_curve"]

_ARGUMENTS = {
    "force": ("loads", "N"),
    "pressure": ("pressures", "Pa"),
    "approach": ("approaches", "m"),
}


@frozen(eq=False)
class LoadCurve(Curve):
    """Numbers of a contact over its load, in the order in which they were given; arrays (n,).

    Attributes
    ----------
    columns : mapping of str to ndarray
        Every number of `ContactResult.scalars` at all points; nan where one lacks it.
    units : mapping of str to str
        Unit of each column.
    applications : ndarray of int
        Applications of the operator on the full grid that each point took.
    seconds : ndarray
        Wall time of each point [s].
    plan : ContactPlan
        What was solved, without its preparation.
    validity : tuple of ValidityNumber
        The worst of each number over all points.
    """

    axis: ClassVar[str] = "load"
    shown: ClassVar[Shown] = {
        "area": (("contact_area",), ""),
        "pressure": (("max_pressure",), ""),
        "load": (("load",), "approach"),
    }
    title: ClassVar[str] = "load curve"

    columns: Mapping[str, Floats] = field(repr=False)
    units: Mapping[str, str] = field(repr=False)
    applications: Counts = field(repr=False)
    seconds: Floats = field(repr=False)
    plan: ContactPlan = field(repr=False)
    validity: tuple[ValidityNumber, ...] = field(repr=False)
    _results: tuple[ContactResult, ...] | None = field(repr=False)

    @property
    def load(self) -> Floats:
        """Force that the contact carries [N]."""
        return self.columns["load"]

    @property
    def mean_pressure(self) -> Floats:
        """The same over the window [Pa]."""
        return self.columns["mean_pressure"]

    @property
    def approach(self) -> Floats:
        """Rigid-body approach from first touch [m]."""
        return self.columns["approach"]

    @property
    def contact_area(self) -> Floats:
        """Real area of contact [m2], as a count of pixels."""
        return self.columns["contact_area"]

    @property
    def max_pressure(self) -> Floats:
        """Maximum of the pressure [Pa]."""
        return self.columns["max_pressure"]

    @property
    def sources(self) -> tuple[str, ...]:
        """See `Curve.sources`."""
        return tuple(self.plan.cite().splitlines())

    def table(self) -> dict[str, tuple[Any, str]]:
        """Return all columns in the order given, with the cost of each point."""
        columns: dict[str, tuple[Any, str]]
        columns = {name: (values, self.units[name]) for name, values in self.columns.items()}
        return columns | {"applications": (self.applications, "-"), "seconds": (self.seconds, "s")}

    @property
    def results(self) -> tuple[ContactResult, ...]:
        """Complete results with their maps.

        Raises
        ------
        NotSimulatedError
            If the curve did not keep them.
        """
        if self._results is None:
            raise NotSimulatedError("the curve kept no maps: run load_curve(..., keep_maps=True)")
        return self._results


def load_curve(
    plan: ContactPlan,
    *,
    loads: Sequence[float | str] | Floats | None = None,
    pressures: Sequence[float | str] | Floats | None = None,
    approaches: Sequence[float | str] | Floats | None = None,
    rtol: float | None = None,
    keep_maps: bool = False,
    progress: Callable[[float], None] | None = None,
) -> LoadCurve:
    """Solve a contact under a series of loads or approaches, each from the solutions before it.

    Whatever their order, they are solved downwards: pixels then only leave the contact, and the
    pressures extrapolated from three larger loads show which. Only with adhesion, whose state
    depends on the one before, are they solved in the order given.

    Parameters
    ----------
    plan : ContactPlan
        The contact; its own loading is not used.
    loads, pressures, approaches : sequence of float
        Forces on the window [N], mean pressures over it [Pa], or rigid-body approaches from first
        touch [m], in any order: exactly one of them.
    rtol : float, optional
        Tolerance of each contact, in place of that of the plan: 1e-5 is enough for curves, and
        about half as expensive as the standard 1e-8.
    keep_maps : bool
        Whether to keep the complete results, with maps, in `LoadCurve.results`.
    progress : callable, optional
        Called with the completed fraction.

    Returns
    -------
    LoadCurve
        Arrays in the order given, with the cost of each point.

    Raises
    ------
    DescriptionError
        If no series or more than one is given, or a number is impossible; before any solve.
    PlanError, InfeasibleError, ConvergenceError
        As `plan` and `solve` do, for any point; loads that cannot be carried before any solve.

    Warns
    -----
    ValidityWarning
        For each number of `ContactResult.validity` that is out of its range, under the largest
        load at which it is.

    Notes
    -----
    Each point agrees with a single solve to the tolerance, not to the last digit. Steps of less
    than a third of the load help each other; from further away a point costs a single solve. The
    gain is limited: a digit of the residual takes two to three applications however good the
    initial guess is.

    Examples
    --------
    >>> import contactkit as ck
    >>> steel = ck.Material(name="steel", young_modulus=210e9, poisson_ratio=0.3)
    >>> scene = ck.ContactScene(
    ...     interface=ck.Interface(
    ...         lower=ck.Body(solid=steel), upper=ck.Body(surface=ck.Paraboloid(radius=1e-3))
    ...     ),
    ...     window=ck.Window(width=30e-6, periodic=False),
    ...     loading=ck.Pressing(force=0.2),
    ...     effects=(ck.HalfSpace(),),
    ... )
    >>> curve = load_curve(ck.plan(scene, ck.Accuracy(grid=96)), loads=[0.05, 0.1, 0.2])
    >>> (curve.max_pressure / 1e9).round(2), (curve.approach * 1e9).round(1)
    (array([0.8 , 1.01, 1.27]), array([29.8, 47.3, 75. ]))
    """
    check_plan(plan, ContactPlan)
    name, values = _series(loads, pressures, approaches)
    if rtol is not None:
        plan = evolve(plan, accuracy=evolve(plan.accuracy, rtol=rtol))
    plans = [plan.with_loading(loading_of(name, value)) for value in values]
    chain, points, warned = ContactChain(), dict[int, _Point](), set[str]()
    worst: dict[str, ValidityNumber] = {}
    for done, i in enumerate(downwards(values, plan.scene), start=1):
        result = chain.solve(plans[i])
        warn(one for one in result.validity if one.is_valid is False and one.name not in warned)
        note_worst(worst, result.validity)
        warned |= {one.name for one in result.validity if one.is_valid is False}
        points[i] = _Point(result.scalars(), result.work, result if keep_maps else None)
        if progress is not None:
            progress(done / len(values))
    return _curve(plan, [points[i] for i in range(len(values))], worst)


class _Point(NamedTuple):
    """Numbers of a point with their units, its cost, and its maps if they are kept."""

    scalars: dict[str, tuple[float, str]]
    work: ContactWork
    result: ContactResult | None


def _series(
    loads: Sequence[float | str] | Floats | None,
    pressures: Sequence[float | str] | Floats | None,
    approaches: Sequence[float | str] | Floats | None,
) -> tuple[str, list[float]]:
    """Name of the imposed quantity, and its values."""
    given = {"force": loads, "pressure": pressures, "approach": approaches}
    known = [(name, values) for name, values in given.items() if values is not None]
    if len(known) != 1:
        expected = "be given one of loads [N], pressures [Pa] or approaches [m]"
        names = [_ARGUMENTS[name][0] for name, _ in known]
        raise DescriptionError("load_curve", names or "none", expected)
    name, values = known[0]
    argument, unit = _ARGUMENTS[name]
    return name, listed(f"load_curve({argument})", values, unit).tolist()


def _curve(
    plan: ContactPlan, points: list[_Point], worst: Mapping[str, ValidityNumber]
) -> LoadCurve:
    units = {name: unit for point in points for name, (_, unit) in point.scalars.items()}

    def column(name: str) -> Floats:
        found = [point.scalars.get(name, (math.nan, ""))[0] for point in points]
        return np.array([math.nan if value is None else value for value in found])

    columns = FrozenDict({name: column(name) for name in units})
    results = tuple(point.result for point in points if point.result is not None)
    return LoadCurve(
        columns=columns,
        units=FrozenDict(units),
        applications=np.array([point.work.n_operator_applications for point in points]),
        seconds=np.array([point.work.seconds for point in points]),
        plan=plan.without_preparation(),
        validity=tuple(worst.values()),
        results=results or None,
    )
