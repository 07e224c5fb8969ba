"""What single effects did in a separation, as a result gives it by `of`."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeVar

from attrs import field, frozen

from ..errors import DescriptionError, NotSimulatedError
from ..scene.loading import ImposedForce, ImposedTime
from .constant_force import constant_force_time
from .plan import Plan

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from .effects.adhesion import AdhesionNumbers

    Curve = NDArray[np.float64]

__all__ = [
    "AdhesionPart",
    "AsperityPart",
    "ForcePart",
    "LimitPart",
    "MeniscusPart",
    "ViscousPart",
    "known",
]


@frozen(eq=False)
class ForcePart:
    """What a force that does not depend on speed did: its curve [N], and its impulse [N.s].

    The impulse is None where only the duration of the opening is given.
    """

    force: Curve
    impulse: float | None


@frozen(eq=False)
class MeniscusPart(ForcePart):
    """What the meniscus force did: its curve [N], and its impulse [N.s] where time is known."""


@frozen(eq=False)
class AdhesionPart(ForcePart):
    """What the adhesion of the solids did, and the numbers of the contact of one sphere."""

    numbers: AdhesionNumbers


@frozen(eq=False)
class AsperityPart(ForcePart):
    """What the menisci at asperities did, and by which `law`.

    `n_wet` is their number along the run, `coverage` their contact circles over the face [-], both
    of thin menisci: above 0.9 neighbours overlap, and their forces do not add up any more.
    """

    law: str
    n_wet: Curve
    coverage: Curve


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
        return known(self._force, "instantaneous viscous force", self.plan)

    @property
    def newtonian_force(self) -> Curve:
        """Instantaneous force [N] of the film without limits."""
        return known(self._newtonian, "instantaneous viscous force", self.plan)

    def mean_force(self, time: float | None = None) -> float:
        """Time average [N] of the force over an opening that takes `time` [s]: impulse/time.

        Raises
        ------
        DescriptionError
            If no time is given, neither here nor with the scene.
        """
        loading = self.plan.scene.loading
        if time is None and isinstance(loading, ImposedTime):
            time = loading.time
        if time is None or not time > 0.0:
            raise DescriptionError(
                "mean_force(time)",
                time,
                "be positive",
                unit="s",
                hint="give the duration of the opening here, or as ImposedTime(time=...)",
            )
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
        loading = self.plan.scene.loading
        if force is None and isinstance(loading, ImposedForce):
            force = loading.force
        if force is None or not force > 0.0:
            raise DescriptionError(
                "time_at_constant_force(force)",
                force,
                "be positive",
                unit="N",
                hint="give the pull here, or as ImposedForce(force=...)",
            )
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


_T = TypeVar("_T")


def known(value: _T | None, what: str, plan: Plan) -> _T:
    """Return a value; refuse one that what is imposed does not determine."""
    if value is None:
        raise NotSimulatedError(
            f"no {what}: with {plan.scene.loading.imposed} imposed it is not determined; impose "
            f"a speed or a force to get it"
        )
    return value
