"""Base class of the results of a separation and of a sliding: curves along the run, and cost."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import TYPE_CHECKING, Any, ClassVar, NamedTuple

from ..errors import NotSimulatedError
from ..export.contents import Contents, Quantity
from ..scene.column import Column
from ..scene.result import Result

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Curve = NDArray[np.float64]

__all__ = ["CurveResult", "LateColumns", "Work"]


class Work(NamedTuple):
    """Cost of a run."""

    n_steps: int
    n_rejected: int
    n_evaluations: int
    seconds: float


class LateColumns(Mapping[str, "Curve"]):
    """Curves by their names, of which some are computed when they are first asked for.

    `late` gives the function that computes a curve, together with others.
    """

    def __init__(
        self, known: Mapping[str, Curve], late: Mapping[str, Callable[[], Mapping[str, Curve]]]
    ) -> None:
        self._known, self._found = known, dict[str, "Curve"]()
        self._late = {name: compute for name, compute in late.items() if name not in known}
        self._names = (*known, *self._late)

    @property
    def computed(self) -> Mapping[str, Curve]:
        """Curves that are there already."""
        return {**getattr(self._known, "computed", self._known), **self._found}

    def __getitem__(self, name: str) -> Curve:
        if name in self._late:
            self._found |= self._late[name]()
            # What computed them is not needed any more, nor what it holds.
            self._late = {n: one for n, one in self._late.items() if n not in self._found}
        return self._found[name] if name in self._found else self._known[name]

    def __contains__(self, name: object) -> bool:
        return name in self._names

    def __iter__(self) -> Iterator[str]:
        return iter(self._names)

    def __len__(self) -> int:
        return len(self._names)


class CurveResult(Result):
    """Curves of the motion and of the effects that a scene lists, along a run."""

    __slots__ = ()

    cure: ClassVar[str]
    """What to impose for a curve that the imposed quantity does not determine."""

    def contents(self) -> Contents:
        """Return all curves, also those that are computed when asked for, and the numbers.

        The total of a curve is ``total_`` with its name. Along ``time`` where that rises from each
        point to the next; else along ``point``.
        """
        plan: Any = self.plan
        known: Mapping[str, Column] = plan.columns
        time = self.columns.get("time")
        rises = time is not None and bool((time[1:] > time[:-1]).all())
        axis = ("time" if rises else "point",)
        curves = {
            name: Quantity(axis, values, known[name].unit, known[name].label)
            for name, values in self.columns.items()
        }
        # The total of a curve that grows has its name, and would take its place.
        numbers = {
            f"total_{name}" if name in curves else name: one
            for name, one in self._numbers().items()
        }
        return Contents(axis, curves | numbers, self._remarks() | {"curves": self.lines})

    @property
    def lines(self) -> str:
        """Error of straight lines between the points of the curves, in a sentence."""
        plan: Any = self.plan
        return (
            "straight lines between neighbouring points are right to "
            f"{plan.accuracy.curve_rtol:g} of the gap, and of the range of each other curve"
        )

    @property
    def notes(self) -> tuple[str, ...]:
        """See `Result.notes`."""
        return (f"curves: {self.lines}",)

    @property
    def time(self) -> Curve:
        """Time [s]."""
        return self["time"]

    @property
    def speed(self) -> Curve:
        """Speed of opening or of sliding [m/s]."""
        return self["speed"]

    def unit(self, name: str) -> str:
        """See `Result.unit`."""
        plan: Any = self.plan
        unit: str = plan.columns[name].unit
        return unit

    def _refuse(self, name: str) -> None:
        plan: Any = self.plan
        owners = [k for k in plan.known_effects if name in {c.name for c in k.curves()}]
        if owners and not any(map(plan.has, owners)):
            if len(owners) == 1:
                plan.listed(owners[0])
            named = " or ".join(f"{kind.__name__}(...)" for kind in owners)
            raise NotSimulatedError(
                f"the scene does not call for {owners[0].name}: add {named} to its effects"
            )
        if name in plan.columns:
            raise self._undetermined(plan.columns[name].label)

    def _undetermined(self, label: str) -> NotSimulatedError:
        plan: Any = self.plan
        return NotSimulatedError(
            f"no {label}: with {plan.scene.loading.imposed} imposed it is not determined; "
            f"{self.cure}"
        )
