"""Result of a separation: curves, numbers, ranges of validity, and cost."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from functools import partial
from typing import TYPE_CHECKING, ClassVar, Protocol, TypeVar

from attrs import field, frozen

from ..errors import NotSimulatedError
from ..scene.loading import ImposedTime
from ..scene.scales import Scales
from ..validity import ValidityNumber
from .curve_result import CurveResult, LateColumns, Work
from .effects.base import RunCurves, SeparationEffect, effects_of
from .effects.viscous import ViscousForce
from .motion.state import MotionState
from .plan import Plan
from .scales import separation_scales
from .validity import is_whole

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from ..as_published.arguments import PublishedValue

    Curve = NDArray[np.float64]

__all__ = ["SeparationResult", "Work", "extremes_of", "pulls_of_cycles", "with_late_curves"]

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
    has_motion : bool
        Whether a motion was solved: a force was imposed.
    validity : tuple of ValidityNumber
        Whether the models were inside their ranges.
    work : Work
        What it cost.
    extremes : mapping of str to float
        Greatest force of all films and solids that resists opening, and that pushes the bodies
        apart [N], by the names they have in `scalars`; over the cycles of a vibration also the mean
        pull with and without it, and the highest and the lowest.
    """

    cure: ClassVar[str] = "impose a speed or a force to get it"

    plan: Plan = field(repr=False)
    status: str
    message: str
    columns: Mapping[str, Curve] = field(repr=False)
    impulses: Mapping[str, float] = field(repr=False)
    _state: MotionState | None = field(repr=False)
    validity: tuple[ValidityNumber, ...] = field(repr=False)
    work: Work
    extremes: Mapping[str, float] = field(repr=False)

    @property
    def has_motion(self) -> bool:
        """Whether a motion was solved."""
        return self._state is not None

    @property
    def state(self) -> MotionState:
        """The end of the motion: release time, peak force, dissipated work.

        Raises
        ------
        NotSimulatedError
            If the scene imposes no force, so that no motion was solved.
        """
        if self._state is None:
            loading = type(self.plan.scene.loading).__name__
            raise NotSimulatedError(
                f"no motion was solved under {loading}: result.scalars() has the numbers of its "
                "curves; impose a force with ImposedForce(...) for a motion"
            )
        return self._state

    @property
    def gap(self) -> Curve:
        """Gap [m]."""
        return self["gap"]

    @property
    def pull(self) -> Curve:
        """Pull [N]."""
        return self["pull"]

    @property
    def scales(self) -> Scales:
        """Initial gap, capillary force, viscous impulse, and what follows from them.

        See `separation.scales.separation_scales`.
        """
        return separation_scales(self.plan)

    @property
    def viscous_impulse(self) -> float:
        """Time integral of the viscous force over the whole opening [N.s].

        Without limits of the liquid no path in time changes it, so that it is known where only the
        duration is imposed.

        Raises
        ------
        NotSimulatedError
            If the scene does not list `ViscousForce`.
        """
        return self.of(ViscousForce).impulse

    @property
    def mean_viscous_force(self) -> float:
        """Viscous impulse over the imposed duration [N]: the force "at rupture" of the source.

        It is the constant pull that opens a film without meniscus and mass in that time; at a
        constant speed the force begins with much more.

        Raises
        ------
        NotSimulatedError
            If no time is imposed, or the scene does not list `ViscousForce`.
        """
        loading, impulse = self.plan.scene.loading, self.viscous_impulse
        if isinstance(loading, ImposedTime):
            return impulse / loading.time
        raise NotSimulatedError(
            f"no mean viscous force of a {type(loading).__name__}: impose the duration with "
            "ImposedTime(time=...), or divide result.viscous_impulse [N.s] by a time [s]"
        )

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
        return tuple(one for e in effects_of(self.plan.scene) for one in e.errata(self.plan))

    def scalars(self) -> dict[str, tuple[float, str]]:
        """Return the numbers of the run, each with its unit."""
        found = {name: (value, "N.s") for name, value in self.impulses.items()}
        for effect in effects_of(self.plan.scene):
            found |= effect.scalars(self)
        if self._state is not None:
            found |= _numbers_of_motion(self.plan, self._state)
        return found | {name: (value, "N") for name, value in self.extremes.items()}


def with_late_curves(
    plan: Plan,
    columns: Mapping[str, Curve],
    volume_fraction: Callable[[], Curve] | None = None,
) -> Mapping[str, Curve]:
    """Add the curves that effects compute when they are asked for.

    `volume_fraction` returns the volume of the film over that of the scene along the run; 1 if not
    given.
    """
    late = {
        column.name: partial(_late_curves, plan, effect, columns, volume_fraction)
        for effect in effects_of(plan.scene)
        for column in effect.late
    }
    return LateColumns(columns, late)


def _late_curves(
    plan: Plan,
    effect: SeparationEffect,
    columns: Mapping[str, Curve],
    volume_fraction: Callable[[], Curve] | None,
) -> Mapping[str, Curve]:
    import numpy as np

    gap = columns["gap"]
    left = plan.film.volume_fraction
    if left is not None:
        given = np.array([left(h) for h in gap.tolist()])
    else:
        given = np.ones(gap.shape) if volume_fraction is None else volume_fraction()
    speed = columns["speed"] if "speed" in columns else np.zeros(gap.shape)
    return effect.late_curves(RunCurves(plan, gap, speed, is_whole(plan, columns), given))


def extremes_of(plan: Plan, columns: Mapping[str, Curve]) -> dict[str, float]:
    """Greatest force that resists opening, and that pushes the bodies apart [N], by their names.

    All forces of film and solids together. Where only the duration is given, the path of the
    viscous force in time is not known: the others are then taken, under names that say so.
    """
    forces = plan.forces
    known = [columns[force.name] for force in forces if force.name in columns]
    if not known:
        return {}
    total = sum(known[1:], known[0])
    kind = "" if len(known) == len(forces) else "static_"
    return {
        f"peak_{kind}repulsion": max(-float(total.min()), 0.0),
        f"peak_{kind}force": max(float(total.max()), 0.0),
    }


def pulls_of_cycles(
    impulses: Mapping[str, float], duration: float, pull: Curve
) -> dict[str, float]:
    """Pull over the whole of a vibration [N]: its mean, that without vibration, its extremes."""
    return {
        "mean_pull": impulses["pull_impulse"] / duration,
        "mean_steady_pull": impulses["steady_pull_impulse"] / duration,
        "highest_pull": float(pull.max()),
        "lowest_pull": float(pull.min()),
    }


def _numbers_of_motion(plan: Plan, state: MotionState) -> dict[str, tuple[float, str]]:
    """Scalars of a motion; nan for events that did not occur."""
    released = state.n_releases > 0
    has_speed = released and plan.scene.imposed_force.mass is not None
    found = {
        "release_time": (state.release_time if released else math.nan, "s"),
        "release_speed": (state.release_speed if has_speed else math.nan, "m/s"),
        "peak_force": (state.peak_force, "N"),
        "peak_time": (state.peak_time if state.peak_time >= 0.0 else math.nan, "s"),
        "dissipated_work": (state.dissipated_work, "J"),
        "final_gap": (state.gap, "m"),
    }
    if math.isfinite(plan.film.end):
        found["break_time"] = (state.break_time if state.n_breaks else math.nan, "s")
    return found
