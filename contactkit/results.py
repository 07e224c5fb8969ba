"""What a separation gives: curves, numbers, and how well they can be trusted."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any, NamedTuple, TypeVar

from attrs import field, frozen

from .columns import COLUMNS, Column
from .constant_force import constant_force_time
from .effects import MeniscusForce, SeparationEffect, ShearLimit, TensionLimit, ViscousForce
from .errors import DescriptionError, NotSimulatedError
from .motion_state import LimitKind, MotionState
from .plan import Plan
from .validity import ValidityNumber

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Curve = NDArray[np.float64]

_BY_NAME = {column.name: column for column in COLUMNS}

__all__ = [
    "COLUMNS",
    "Column",
    "LimitPart",
    "MeniscusPart",
    "SeparationResult",
    "ViscousPart",
    "Work",
]


class Work(NamedTuple):
    """What a run cost."""

    n_steps: int
    n_rejected: int
    n_evaluations: int
    seconds: float


@frozen(eq=False)
class MeniscusPart:
    """What the meniscus force did: its curve [N], and its impulse [N.s] where time is known."""

    force: Curve
    impulse: float | None


@frozen(eq=False)
class ViscousPart:
    """What the viscous force did. Four different things keep four names.

    `force` is the instantaneous force [N] along the run, after the limits; `newtonian_force` what
    it would be without them; `impulse` the time integral of the force over the whole opening
    [N.s]; `newtonian_impulse` the same without limits, which no path in time changes.
    """

    plan: Plan = field(repr=False)
    _force: Curve | None
    _newtonian: Curve | None
    impulse: float
    newtonian_impulse: float

    @property
    def force(self) -> Curve:
        """Instantaneous force [N]."""
        return _known(self._force, "instantaneous viscous force", self.plan)

    @property
    def newtonian_force(self) -> Curve:
        """Instantaneous force [N] of the film without limits."""
        return _known(self._newtonian, "instantaneous viscous force", self.plan)

    def mean_force(self, time: float | None = None) -> float:
        """Time average [N] of the force over an opening that takes `time` [s]: impulse/time.

        Raises
        ------
        DescriptionError
            If no time is given, neither here nor with the scene.
        """
        time = time if time is not None else self.plan.scene.opening.time
        if time is None or not time > 0.0:
            raise DescriptionError(
                "mean_force(time)", time, "be positive", unit="s",
                hint="give the duration of the opening here, or as Opening(time=...)",
            )  # fmt: skip
        return self.impulse / time

    def time_at_constant_force(self, force: float | None = None) -> float:
        """Time [s] that a constant pull [N] takes to open the gap; inf if it never does.

        Closed form for a massless body; the meniscus, where the scene has one, pulls with the
        Laplace pressure of a thin film. Without the limits of the liquid.

        Raises
        ------
        DescriptionError
            If no force is given, neither here nor with the scene.
        """
        force = force if force is not None else self.plan.scene.opening.force
        if force is None or not force > 0.0:
            raise DescriptionError(
                "time_at_constant_force(force)", force, "be positive", unit="N",
                hint="give the pull here, or as Opening(force=...)",
            )  # fmt: skip
        return constant_force_time(self.plan, force)


@frozen(eq=False)
class LimitPart:
    """Whether and when a limit of the liquid acted.

    `acts` says it at each point of the run; `first` and `last` are the times [s] between which
    it did, None if it never did.
    """

    acts: NDArray[np.bool_]
    first: float | None
    last: float | None

    @property
    def has_acted(self) -> bool:
        """Whether the limit acted at all."""
        return bool(self.acts.any())


Part = MeniscusPart | ViscousPart | LimitPart
_T = TypeVar("_T")


def _known(value: _T | None, what: str, plan: Plan) -> _T:
    if value is None:
        raise NotSimulatedError(
            f"no {what}: with {plan.scene.opening.imposed} imposed it is not determined; impose "
            f"a speed or a force to get it"
        )
    return value


@frozen(eq=False)
class SeparationResult:
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
        The curves, by the names of `COLUMNS`; read-only.
    state : MotionState or None
        Last state of the motion.
    validity : tuple of ValidityNumber
        Whether the models were inside their ranges.
    work : Work
        What it cost.
    """

    plan: Plan = field(repr=False)
    status: str
    message: str
    columns: Mapping[str, Curve] = field(repr=False)
    impulses: Mapping[str, float] = field(repr=False)
    state: MotionState | None = field(repr=False)
    validity: tuple[ValidityNumber, ...] = field(repr=False)
    work: Work

    def __getattr__(self, name: str) -> Curve:
        if name not in _BY_NAME:
            raise AttributeError(f"SeparationResult has no {name!r}")
        return self.curve(name)

    def curve(self, name: str) -> Curve:
        """Return a curve by its name in `COLUMNS`.

        Raises
        ------
        NotSimulatedError
            If this run did not simulate it; the message says what to add.
        """
        if name in self.columns:
            return self.columns[name]
        if name not in _BY_NAME:
            raise DescriptionError("curve", name, f"be one of {', '.join(_BY_NAME)}")
        owner = _OWNERS.get(name)
        if owner is not None:
            self._demand(owner)
        if name == "limit":
            raise NotSimulatedError(
                "the scene does not call for a limit of the liquid: add TensionLimit() or "
                "ShearLimit() to its effects"
            )
        return _known(None, _BY_NAME[name].label, self.plan)

    def _demand(self, kind: type[SeparationEffect]) -> None:
        if not self.plan.has(kind):
            raise NotSimulatedError(
                f"the scene does not call for {kind.name}: add {kind.__name__}() to its effects"
            )

    def of(self, kind: type[SeparationEffect]) -> Any:
        """Return what an effect did: `MeniscusPart`, `ViscousPart` or `LimitPart`.

        Raises
        ------
        NotSimulatedError
            If the scene does not call for the effect.
        """
        self._demand(kind)
        if kind not in _PARTS:
            raise NotSimulatedError(f"{kind.__name__} has no curve of its own; see result.state")
        return _PARTS[kind](self)

    def scalars(self) -> dict[str, tuple[float, str]]:
        """Return the numbers of the run, each with its unit."""
        found = {name: (value, "N.s") for name, value in self.impulses.items()}
        if self.plan.has(ViscousForce) and self.plan.scene.opening.time is not None:
            found["mean_viscous_force"] = (self.of(ViscousForce).mean_force(), "N")
        state = self.state
        if state is None:
            total = [
                self.columns[n] for n in ("meniscus_force", "viscous_force") if n in self.columns
            ]
            if total:
                found["peak_force"] = (float(sum(total).max()), "N")  # type: ignore[union-attr]
            return found
        found |= {
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


def _meniscus_part(result: SeparationResult) -> MeniscusPart:
    return MeniscusPart(result.meniscus_force, result.impulses.get("meniscus_impulse"))


def _viscous_part(result: SeparationResult) -> ViscousPart:
    columns, impulses = result.columns, result.impulses
    return ViscousPart(
        result.plan,
        columns.get("viscous_force"),
        columns.get("newtonian_force"),
        impulses["viscous_impulse"],
        impulses["newtonian_impulse"],
    )


def _limit_part(kind: LimitKind) -> Callable[[SeparationResult], LimitPart]:
    def part(result: SeparationResult) -> LimitPart:
        acts = result.limit == kind
        when = result.time[acts]
        first, last = (float(when[0]), float(when[-1])) if acts.any() else (None, None)
        return LimitPart(acts, first, last)

    return part


_PARTS: dict[type[SeparationEffect], Callable[[SeparationResult], Part]] = {
    MeniscusForce: _meniscus_part,
    ViscousForce: _viscous_part,
    TensionLimit: _limit_part(LimitKind.TENSION),
    ShearLimit: _limit_part(LimitKind.SHEAR),
}
_OWNERS: dict[str, type[SeparationEffect]] = {
    "meniscus_force": MeniscusForce,
    "viscous_force": ViscousForce,
    "newtonian_force": ViscousForce,
    "viscous_impulse": ViscousForce,
}
