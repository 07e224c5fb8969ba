r"""Roles of an effect in a separation, read off the equation of motion.

.. math:: m \ddot h = F_{ext}(t) - k_s (h - h_0) - \sum F(h, \dot h)

An effect holds choices only, and declares in its class whatever the rest has to know of it: its
curve, the state of the liquid it needs, what `result.of` gives, its range of validity. `prepare`
does once whatever does not depend on gap and speed; what it returns is called in the loop.
"""

from __future__ import annotations

import abc
from collections.abc import Callable, Mapping, Sequence
from enum import IntEnum
from typing import TYPE_CHECKING, Any, ClassVar, NamedTuple, Protocol, cast

from attrs import field, frozen

from ...errors import NotSimulatedError
from ...scene.column import Column
from ...scene.effect import Effect
from .force_law import ForceLaw

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from ...as_published.arguments import PublishedValue
    from ...scene.scenes import SeparationScene, SlidingScene
    from ...validity import ValidityNumber
    from ..cavity.law import Cavitation
    from .prepared import PreparedScene

    Curve = NDArray[np.float64]

__all__ = [
    "LIMIT",
    "Angles",
    "CoupledEffect",
    "FilmEnd",
    "FilmLimit",
    "FilmStatus",
    "FilmView",
    "ForceLaw",
    "ForcePart",
    "LimitKind",
    "LimitPart",
    "Limiter",
    "MovingAngle",
    "MovingEnd",
    "PlanView",
    "RunCurves",
    "RunView",
    "SeparationEffect",
    "SeparationForce",
    "VolumeLoss",
    "VolumeRate",
    "effects_of",
]

Limiter = Callable[[float, float, float], float]
"""Force [N] that is left of a Newtonian force [N]: called with (gap, speed, force)."""


Angles = Callable[[float, float], tuple[float, float]]
"""Contact angles on the lower and the upper body [rad] at a gap [m] and an opening speed [m/s]."""


class FilmStatus(IntEnum):
    """State of the film."""

    CONTACT = 1
    STUCK = 2
    FULL = 3
    BRIDGE = 4
    BROKEN = 5


class LimitKind(IntEnum):
    """Limit of the liquid that acts; the C kernel of the native FMUs has the same numbers."""

    NONE = 1
    TENSION = 2
    SHEAR = 3


LIMIT = Column("limit", "-", "limit that acts")
CAVITY = (
    Column("cavity_radius", "m", "radius of the cavity", "#00798c"),
    Column("void_volume", "m3", "void in the films", "#00798c", ":"),
)
"""Curves of a film that cavitates and remembers it."""


class FilmView(Protocol):
    """Forces of a film as they are prepared."""

    @property
    def laws(self) -> Mapping[type[SeparationForce], ForceLaw]:
        """Law of each force."""

    @property
    def end(self) -> float:
        """Gap at which the film ends [m]."""

    @property
    def cavity(self) -> Cavitation | None:
        """Cavity that is followed; None without one."""

    @property
    def volume_fraction(self) -> Callable[[float], float] | None:
        """Volume over that of the scene at a gap [m]; None for a film that keeps it."""

    @property
    def moving_ends(self) -> tuple[Callable[[float, float], float], ...]:
        """Gaps at which it breaks [m], at a gap and a speed; empty where that is its `end`."""


class PlanView(Protocol):
    """Plan of a separation as an effect sees it: its scene, what is prepared, and the forces."""

    @property
    def scene(self) -> SeparationScene:
        """The scene that is planned."""

    @property
    def prepared(self) -> PreparedScene[SeparationScene]:
        """Liquid, geometry and settings, computed once."""

    @property
    def film(self) -> FilmView:
        """Forces of the film."""

    @property
    def volume_rate(self) -> VolumeRate | None:
        """Rate of the volume in a motion; None for a film that keeps it."""

    def film_with(self, fraction: float) -> FilmView:
        """Return the forces with a fraction of the volume of the liquid."""

    def has(self, kind: type[Effect]) -> bool:
        """Whether the scene lists an effect."""


class RunView(Protocol):
    """Run of a plan as an effect sees it: its curves and impulses."""

    @property
    def plan(self) -> PlanView:
        """The plan of the run."""

    @property
    def impulses(self) -> Mapping[str, float]:
        """Impulses [N.s] by their names."""

    @property
    def gap(self) -> NDArray[np.float64]:
        """Gap along the run [m]."""

    @property
    def time(self) -> NDArray[np.float64]:
        """Time along the run [s]."""

    def __getitem__(self, name: str) -> NDArray[Any]:
        """Return a curve by its name."""


class MovingEnd(NamedTuple):
    """Gap [m] at which a film breaks, at a gap and a speed.

    `check` raises an InfeasibleError at a place that a motion has reached and where it is not
    known; `end_at` is also asked where a step only tries.
    """

    end_at: Callable[[float, float], float]
    check: Callable[[float, float], None]


class RunCurves(NamedTuple):
    """Curves of a run, from which others follow.

    `gap` [m], `speed` [m/s] (0 where none is known), whether the film is `whole` there, and the
    volume of the film over that of the scene.
    """

    plan: PlanView
    gap: Curve
    speed: Curve
    whole: NDArray[np.bool_]
    volume_fraction: Curve


@frozen(eq=False)
class ForcePart:
    """Force of an effect along a run, and its impulse."""

    result: RunView = field(repr=False)
    column: Column

    @property
    def force(self) -> Curve:
        """Force along the run [N]."""
        return self.result[self.column.name]

    @property
    def impulse(self) -> float | None:
        """Time integral of the force [N.s].

        None where only the duration of the run is given, or over a gap at which the force is
        infinite, as Eq. (3.12) as printed may be.
        """
        return self.result.impulses.get(self.column.impulse.name)


@frozen(eq=False)
class LimitPart:
    """Whether and when a limit of the liquid acted.

    `acts` says it at each point of the run; `first` and `last` are the times [s] between which
    it did, None if it never did.
    """

    acts: NDArray[np.bool_]
    first: float | None
    last: float | None


@frozen(kw_only=True)
class SeparationEffect(Effect):
    """An effect of a `SeparationScene`."""

    family: ClassVar[str] = "separation effect"
    takes_pressure: ClassVar[bool] = False
    """Whether it knows a meniscus of fixed pressure; otherwise the plan refuses that."""
    late: ClassVar[tuple[Column, ...]] = ()
    """Columns of the curves of `late_curves`."""
    supersedes: ClassVar[tuple[str, ...]] = ()
    """Names of numbers of validity that say what other effects leave out and this one has."""
    published_choice: ClassVar[str] = ""
    """Field that is ``"as-published"`` where the source's equations are taken as printed."""

    @classmethod
    def curves(cls) -> tuple[Column, ...]:
        """Curves that this effect adds to a result."""
        return ()

    def late_curves(self, run: RunCurves) -> Mapping[str, Curve]:
        """Curves that follow from those of a run, computed when one of them is asked for.

        `late` lists them.
        """
        return {}

    def notes(self, scene: SeparationScene) -> tuple[str, ...]:
        """Remarks on this effect in a scene, in sentences; part of a printed plan."""
        return ()

    @property
    def takes_solids(self) -> bool:
        """Whether it uses the solids of the bodies, if only to say whether they are rigid enough.

        Where no effect does, the plan refuses them.
        """
        return False

    def equations(self, scene: SeparationScene) -> str:
        """``as-published``, ``consistent``, or empty where this effect is the same in both."""
        return "as-published" if self.takes_printed() else ""

    def takes_printed(self) -> bool:
        """Whether a printed equation is asked for that is known to be wrong."""
        return getattr(self, self.published_choice, "") == "as-published"

    def errata(self, plan: PlanView) -> tuple[PublishedValue, ...]:
        """Printed equations that a plan takes: value at the start, what is wrong, the right one."""
        return ()

    def rimless_radius(self, prepared: PreparedScene[Any], gap: float) -> float:
        """Radius [m] of the contact line on a flat under a sphere if the rim is ignored.

        At a gap [m]; 0 for an effect that takes the rim into account.
        """
        return 0.0

    def validity(
        self, plan: PlanView, path: Sequence[tuple[float, float]]
    ) -> tuple[ValidityNumber, ...]:
        """Whether the models are in their range along pairs of gap [m] and speed [m/s]."""
        return ()

    def part(self, result: Any) -> object:
        """Part of a result that `SeparationResult.of` returns."""
        raise NotSimulatedError(f"{type(self).__name__} has no curve of its own; see result.state")

    def scalars(self, result: RunView) -> dict[str, tuple[float, str]]:
        """Numbers that this effect adds to those of a result, with their units."""
        return {}


@frozen(kw_only=True)
class SeparationForce(SeparationEffect):
    """A force F(h, h') between the bodies; any number may act.

    `column` names its curve and, by `Column.impulse`, its impulse, in results, files, figures and
    FMUs. A force that does not need the film stays when that breaks.
    """

    column: ClassVar[Column]
    needs_film: ClassVar[bool] = True
    newtonian: ClassVar[Column | None] = None
    """Curve of the force without the limits of the liquid, which bound it; None: they do not."""
    so_far: ClassVar[Column | None] = None
    """Curve of its impulse up to each point of a run; None: that of the whole run alone. A force
    with a `newtonian` one has it."""
    touching: ClassVar[str] = ""
    """Why it has no value on bodies that touch, at a gap of 0, with the cure; empty: it has one."""

    @classmethod
    def curves(cls) -> tuple[Column, ...]:
        """See `SeparationEffect.curves`."""
        own = (cls.column, cls.newtonian, cls.so_far)
        return (*(column for column in own if column is not None), *cls.late)

    def proportional_to(self, scene: SeparationScene) -> str:
        """Property of the liquid that the force is proportional to and depends on in no other way.

        A native FMU has that as a parameter. Empty for none.
        """
        return ""

    @abc.abstractmethod
    def prepare(self, prepared: PreparedScene[SeparationScene]) -> ForceLaw:
        """Precompute what depends on neither gap nor speed."""

    def part(self, result: RunView) -> ForcePart:
        """See `SeparationEffect.part`."""
        return ForcePart(result, self.column)


@frozen(kw_only=True)
class FilmLimit(SeparationEffect):
    """A bound on what the liquid can carry; it lowers the viscous force."""

    limit: ClassVar[LimitKind]
    """Value of the curve and of the FMU output where it acts."""

    @classmethod
    def curves(cls) -> tuple[Column, ...]:
        """See `SeparationEffect.curves`."""
        return (LIMIT,)

    @abc.abstractmethod
    def prepare(self, prepared: PreparedScene[SeparationScene]) -> Limiter:
        """Precompute what depends on neither gap nor speed."""

    def cavity_law(self, prepared: PreparedScene[SeparationScene]) -> Cavitation | None:
        """Film that cavitates, for a limit with a memory; it then has no `Limiter`."""
        return None

    def part(self, result: RunView) -> LimitPart:
        """See `SeparationEffect.part`."""
        acts = result[LIMIT.name] == self.limit
        when = result.time[acts]
        first, last = (float(when[0]), float(when[-1])) if acts.any() else (None, None)
        return LimitPart(acts, first, last)


@frozen(kw_only=True)
class FilmEnd(SeparationEffect):
    """A rule for the gap at which the film breaks; none or one."""

    status: ClassVar[FilmStatus] = FilmStatus.BROKEN
    """State of the film beyond that gap, as curves and FMUs show it."""
    outlasts: ClassVar[bool] = False
    """Whether the film may last beyond the end of its forces, which then stay as they are there."""

    @abc.abstractmethod
    def prepare(self, prepared: PreparedScene[SeparationScene]) -> float:
        """Gap at which the film breaks [m]; inf for never."""

    def prepare_moving(self, prepared: PreparedScene[SeparationScene]) -> MovingEnd | None:
        """Gap at which the film breaks where that depends on the motion; None if it does not.

        `prepare` then gives the largest one.
        """
        return None


@frozen(kw_only=True)
class MovingAngle(SeparationEffect):
    """A contact angle that depends on the motion of the line; none or one."""

    @abc.abstractmethod
    def meniscus_law(self, prepared: PreparedScene[SeparationScene], at_rest: ForceLaw) -> ForceLaw:
        """Law of the meniscus force with that angle, from the law with the angle at rest."""

    @abc.abstractmethod
    def prepare_angles(self, prepared: PreparedScene[SeparationScene]) -> Angles:
        """Contact angles over gap and speed, for the volume of a prepared scene."""


class VolumeRate(Protocol):
    """Rate of the volume of a film over that of the scene."""

    def __call__(self, gap: float, speed: float, part: float) -> float:
        """Rate [1/s] at a gap [m], a speed [m/s] and a part of the volume [-]."""

    def check(self, gap: float, speed: float, part: float) -> None:
        """Raise an InfeasibleError where a motion has come to and the rate is not known."""


@frozen(kw_only=True)
class VolumeLoss(SeparationEffect):
    """Liquid that leaves the film along a motion; none or one."""

    least: ClassVar[float] = 0.0
    """Least part of the volume that its rate is known for."""

    @abc.abstractmethod
    def volume_fraction(self, prepared: PreparedScene[SeparationScene]) -> Callable[[float], float]:
        """Volume of the film over that of the scene [-], at a gap [m] of an imposed motion."""

    @abc.abstractmethod
    def volume_rate(self, prepared: PreparedScene[SeparationScene]) -> VolumeRate:
        """Rate of the volume in a motion that is not known before."""


@frozen(kw_only=True)
class CoupledEffect(SeparationEffect):
    """Physics that is solved together with the film and the motion, and has no law of its own.

    A scene that lists one is planned by `separation.deforming`.
    """

    takes_pressure: ClassVar[bool] = True
    solves_motion: ClassVar[bool] = True


def effects_of(scene: SeparationScene | SlidingScene) -> tuple[SeparationEffect, ...]:
    """Return the effects of a scene with their type here; a scene itself knows an `Effect` only."""
    return cast("tuple[SeparationEffect, ...]", scene.effects)
