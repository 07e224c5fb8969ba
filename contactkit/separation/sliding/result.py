"""Result of a sliding: forces over the travel, numbers, and ranges of validity."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, ClassVar, Protocol, TypeVar

from attrs import field, frozen

from ...errors import NotSimulatedError
from ...scene.column import Column
from ...scene.scales import Scales
from ...validity import ValidityNumber
from ..curve_result import CurveResult, Work
from .effects import SlidingForce
from .plan import SlidingPlan
from .scales import sliding_scales

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from ...as_published.arguments import PublishedValue

    Curve = NDArray[np.float64]

__all__ = ["SlidingResult"]

P_co = TypeVar("P_co", covariant=True)


class _HasPart(Protocol[P_co]):
    def part(self, result: SlidingResult) -> P_co: ...


@frozen(eq=False)
class SlidingResult(CurveResult):
    """Curves and numbers of one sliding.

    Attributes
    ----------
    plan : SlidingPlan
        What was run.
    status : str
        ``parted`` where the wetted circles no longer overlap at the end, else ``curve``.
    message : str
        The same as a sentence.
    columns : mapping of str to ndarray
        The curves by their names, read-only; ``result["couette_force"]`` is one of them. Forces
        are those of all menisci.
    totals : mapping of str to float
        Impulses [N.s] and work [J] over the whole slide.
    validity : tuple of ValidityNumber
        Whether the models were inside their ranges.
    work : Work
        What it cost.
    """

    cure: ClassVar[str] = "impose loading.speed to get it"

    plan: SlidingPlan = field(repr=False)
    status: str
    message: str
    columns: Mapping[str, Curve] = field(repr=False)
    totals: Mapping[str, float] = field(repr=False)
    validity: tuple[ValidityNumber, ...] = field(repr=False)
    work: Work

    @property
    def travel(self) -> Curve:
        """Travel [m]."""
        return self["travel"]

    @property
    def scales(self) -> Scales:
        """Wetted radius, speed, Couette drag, and what follows from them.

        See `separation.sliding.scales.sliding_scales`.
        """
        return sliding_scales(self.plan)

    def of(self, kind: type[_HasPart[P_co]]) -> P_co:
        """Return what a force did: its curve, its impulse, its work.

        Raises
        ------
        NotSimulatedError
            If the scene does not list the effect, or it has nothing of its own to show.
        """
        effect = self.plan.listed(kind)
        if not isinstance(effect, SlidingForce):
            raise NotSimulatedError(
                f"{type(effect).__name__} has no curve of its own; see of(CouetteForce)"
            )
        part: Any = effect.part(self)
        return part  # type: ignore[no-any-return]

    def total(self, column: Column) -> float:
        """Return a total; one that the run does not determine is refused."""
        if column.name not in self.totals:
            raise self._undetermined(column.label)
        return self.totals[column.name]

    @property
    def errata(self) -> tuple[PublishedValue, ...]:
        """Printed equations that the run takes, each with the right value; forces are means.

        Empty where nothing is taken as printed.
        """
        forces = [e for e in self.plan.scene.effects if isinstance(e, SlidingForce)]
        return tuple(one for e in forces for one in e.mean_errata(self.plan, self.duration))

    @property
    def duration(self) -> float:
        """Time [s] the slide takes."""
        loading = self.plan.scene.loading
        return loading.time or self.plan.end / (loading.speed or 1.0)

    def scalars(self) -> dict[str, tuple[float, str]]:
        """Return the numbers of the run, each with its unit."""
        found: dict[str, tuple[float, str]] = {}
        for name, value in self.totals.items():
            found[name] = (value, "J" if name.endswith("_work") else "N.s")
        for name in ("couette", "tangential"):
            if f"{name}_impulse" in self.totals:
                mean = self.totals[f"{name}_impulse"] / self.duration
                found[f"mean_{name}_force"] = (mean, "N")
        if "tangential_force" in self.columns:
            found["peak_tangential_force"] = (float(self["tangential_force"].max()), "N")
        return found | {
            "wetted_radius": (self.plan.wetted_radius, "m"),
            "break_travel": (self.plan.break_travel, "m"),
        }
