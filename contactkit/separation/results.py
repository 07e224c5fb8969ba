"""Result of a separation: curves, numbers, ranges of validity, and cost."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, ClassVar, Protocol, TypeVar

from attrs import field, frozen

from ..scene.validity import ValidityNumber
from .curve_result import CurveResult, Work
from .motion.state import MotionState
from .plan import Plan

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from ..as_published.arguments import PublishedValue

    Curve = NDArray[np.float64]

__all__ = ["SeparationResult", "Work"]

P_co = TypeVar("P_co", covariant=True)


class _HasPart(Protocol[P_co]):
    def part(self, result: SeparationResult) -> P_co: ...


@frozen(eq=False)
class SeparationResult(CurveResult):
    """Curves and numbers of one separation.

    Attributes
    ----------
    plan : Plan
        What was run.
    status : str
        ``released``, ``stuck``, ``time limit``, or ``curve`` where no motion was solved.
    message : str
        The same as a sentence, with its cure.
    columns : mapping of str to ndarray
        The curves by their names, read-only; ``result["meniscus_force"]`` is one of them.
    impulses : mapping of str to float
        Time integral of each force over the whole opening [N.s].
    state : MotionState or None
        The end of the motion; None where no motion was solved.
    validity : tuple of ValidityNumber
        Whether the models were inside their ranges.
    work : Work
        What it cost.
    """

    cure: ClassVar[str] = "impose a speed or a force to get it"

    plan: Plan = field(repr=False)
    status: str
    message: str
    columns: Mapping[str, Curve] = field(repr=False)
    impulses: Mapping[str, float] = field(repr=False)
    state: MotionState | None = field(repr=False)
    validity: tuple[ValidityNumber, ...] = field(repr=False)
    work: Work

    @property
    def gap(self) -> Curve:
        """Gap [m]."""
        return self["gap"]

    @property
    def pull(self) -> Curve:
        """Pull [N]."""
        return self["pull"]

    def of(self, kind: type[_HasPart[P_co]]) -> P_co:
        """Return what an effect did: for a force its curve and impulse, for a limit when it acted.

        Raises
        ------
        NotSimulatedError
            If the scene does not list the effect, or it has nothing of its own to show.
        """
        part: P_co = self.plan.listed(kind).part(self)
        return part

    @property
    def errata(self) -> tuple[PublishedValue, ...]:
        """Printed equations this run took: value at the start, what is wrong, and the right one."""
        return tuple(one for e in self.plan.scene.effects for one in e.errata(self.plan))

    def scalars(self) -> dict[str, tuple[float, str]]:
        """Return the numbers of the run, each with its unit."""
        found = {name: (value, "N.s") for name, value in self.impulses.items()}
        for effect in self.plan.scene.effects:
            found |= effect.scalars(self)
        if self.state is not None:
            return found | _numbers_of_motion(self.state)
        forces = self.plan.forces
        total = [self.columns[force.name] for force in forces if force.name in self.columns]
        if total:
            found["peak_force"] = (float(sum(total[1:], total[0]).max()), "N")
        return found | self._means_of_cycles()

    def _means_of_cycles(self) -> dict[str, tuple[float, str]]:
        """Pull over the whole of a vibration: its mean, that without vibration, its extremes."""
        if "pull_impulse" not in self.impulses:
            return {}
        duration, pull = float(self.time[-1]), self.pull
        return {
            "mean_pull": (self.impulses["pull_impulse"] / duration, "N"),
            "mean_steady_pull": (self.impulses["steady_pull_impulse"] / duration, "N"),
            "highest_pull": (float(pull.max()), "N"),
            "lowest_pull": (float(pull.min()), "N"),
        }


def _numbers_of_motion(state: MotionState) -> dict[str, tuple[float, str]]:
    found = {
        "release_time": (state.release_time, "s"),
        "release_speed": (state.release_speed, "m/s"),
        "peak_force": (state.peak_force, "N"),
        "peak_time": (state.peak_time, "s"),
        "dissipated_work": (state.dissipated_work, "J"),
        "final_gap": (state.gap, "m"),
    }
    if state.n_breaks:
        found["break_time"] = (state.break_time, "s")
    return found
