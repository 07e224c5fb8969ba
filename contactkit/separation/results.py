"""What a separation gives: curves, numbers, and how well they can be trusted."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any, NamedTuple

from attrs import field, frozen

from ..errors import DescriptionError, NotSimulatedError
from ..scene.loading import ImposedTime
from .columns import COLUMNS, Column
from .effects.base import SeparationForce
from .effects.registry import (
    SEPARATION_EFFECTS,
    AdhesiveContact,
    AsperityMenisci,
    MeniscusForce,
    SeparationEffect,
    ShearLimit,
    TensionLimit,
    VanDerWaalsForce,
    ViscousForce,
)
from .motion.state import LimitKind, MotionState
from .parts import (
    AdhesionPart,
    AsperityPart,
    ForcePart,
    LimitPart,
    MeniscusPart,
    ViscousPart,
    known,
)
from .plan import Plan
from .validity import ValidityNumber

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from ..as_published.arguments import PublishedValue

    Curve = NDArray[np.float64]

_BY_NAME = {column.name: column for column in COLUMNS}

__all__ = [
    "COLUMNS",
    "AdhesionPart",
    "AsperityPart",
    "Column",
    "ForcePart",
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
        return known(None, _BY_NAME[name].label, self.plan)

    def _demand(self, kind: type[SeparationEffect]) -> None:
        if not self.plan.has(kind):
            raise NotSimulatedError(
                f"the scene does not call for {kind.name}: add {kind.__name__}() to its effects"
            )

    def of(self, kind: type[SeparationEffect]) -> Any:
        """Return what an effect did: `ForcePart`, `ViscousPart` or `LimitPart`.

        Raises
        ------
        NotSimulatedError
            If the scene does not call for the effect.
        """
        self._demand(kind)
        if kind not in _PARTS:
            raise NotSimulatedError(f"{kind.__name__} has no curve of its own; see result.state")
        return _PARTS[kind](self)

    @property
    def errata(self) -> tuple[PublishedValue, ...]:
        """Printed equations this run took: value at the start, what is wrong, and the right one."""
        from .errata import scene_errata

        return scene_errata(self.plan)

    def _means_of_cycles(self) -> dict[str, tuple[float, str]]:
        """Pull over the whole of a vibration: its mean, that without vibration, its extremes."""
        if "pull_impulse" not in self.impulses:
            return {}
        duration, pull = float(self.columns["time"][-1]), self.columns["pull"]
        return {
            "mean_pull": (self.impulses["pull_impulse"] / duration, "N"),
            "mean_steady_pull": (self.impulses["steady_pull_impulse"] / duration, "N"),
            "highest_pull": (float(pull.max()), "N"),
            "lowest_pull": (float(pull.min()), "N"),
        }

    def scalars(self) -> dict[str, tuple[float, str]]:
        """Return the numbers of the run, each with its unit."""
        found = {name: (value, "N.s") for name, value in self.impulses.items()}
        if self.plan.has(ViscousForce) and isinstance(self.plan.scene.loading, ImposedTime):
            found["mean_viscous_force"] = (self.of(ViscousForce).mean_force(), "N")
        found |= _adhesion_numbers(self.plan)
        state = self.state
        if state is None:
            names = dict.fromkeys(kind.column for kind in _FORCES if self.plan.has(kind))
            total = [self.columns[name] for name in names if name in self.columns]
            if total:
                found["peak_force"] = (float(sum(total).max()), "N")  # type: ignore[union-attr]
            return found | self._means_of_cycles()
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


def _adhesion_numbers(plan: Plan) -> dict[str, tuple[float, str]]:
    """Numbers of an adhesive contact, of one sphere, where the scene has one."""
    effect = plan.scene.effect(AdhesiveContact)
    if effect is None:
        return {}
    numbers = effect.numbers(plan.scene)
    found = {
        "pull_off_force": (numbers.pull_off_force, "N"),
        "contact_release_gap": (numbers.release_gap, "m"),
    }
    if numbers.tabor_parameter is not None and numbers.transition_parameter is not None:
        found["tabor_parameter"] = (numbers.tabor_parameter, "-")
        found["transition_parameter"] = (numbers.transition_parameter, "-")
    return found


def _meniscus_part(result: SeparationResult) -> MeniscusPart:
    return MeniscusPart(result.meniscus_force, result.impulses.get("meniscus_impulse"))


def _van_der_waals_part(result: SeparationResult) -> ForcePart:
    impulse = result.impulses.get("van_der_waals_impulse")
    return ForcePart(result.van_der_waals_force, impulse)


def _adhesion_part(result: SeparationResult) -> AdhesionPart:
    scene = result.plan.scene
    effect = scene.effect(AdhesiveContact)
    assert effect is not None  # of() has asked first
    impulse = result.impulses.get("adhesion_impulse")
    return AdhesionPart(result.adhesion_force, impulse, effect.numbers(scene))


def _asperity_part(result: SeparationResult) -> AsperityPart:
    import numpy as np

    scene = result.plan.scene
    effect = scene.effect(AsperityMenisci)
    assert effect is not None  # of() has asked first
    sums = [effect.sums(scene, gap) for gap in result.gap.tolist()]
    columns = (np.array([s.n_wet for s in sums]), np.array([s.coverage for s in sums]))
    impulse = result.impulses.get("asperity_impulse")
    law = f"{effect.law}, {effect.profile} bridges"
    return AsperityPart(result.asperity_force, impulse, law, *columns)


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


_PARTS: dict[
    type[SeparationEffect], Callable[[SeparationResult], ForcePart | ViscousPart | LimitPart]
] = {
    MeniscusForce: _meniscus_part,
    VanDerWaalsForce: _van_der_waals_part,
    AdhesiveContact: _adhesion_part,
    AsperityMenisci: _asperity_part,
    ViscousForce: _viscous_part,
    TensionLimit: _limit_part(LimitKind.TENSION),
    ShearLimit: _limit_part(LimitKind.SHEAR),
}
_FORCES = [kind for kind in SEPARATION_EFFECTS if issubclass(kind, SeparationForce)]
_OWNERS: dict[str, type[SeparationEffect]] = {
    **{kind.column: kind for kind in _FORCES},
    "newtonian_force": ViscousForce,
    "viscous_impulse": ViscousForce,
}
