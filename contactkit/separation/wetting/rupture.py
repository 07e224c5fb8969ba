"""Rupture distance that grows with the speed at which a bridge is drawn out."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, ClassVar

from attrs import field, frozen

from ...errors import InfeasibleError
from ...scene.loading import ImposedSpeed
from ...units import si
from ...validators import non_negative, positive
from ...validity import ValidityNumber
from ..effects.base import FilmEnd, MovingEnd
from ..effects.meniscus_sphere import exact_end
from .cox_voinov import capillary_number
from .line import line_needs

if TYPE_CHECKING:
    from ...scene.scenes import SeparationScene
    from ..effects.base import PlanView
    from ..effects.prepared import PreparedScene

__all__ = ["DynamicRupture"]

_NEAR = 0.99  # of the gap at which a bridge at rest breaks
_FAST, _FASTEST = 0.1, 1.0  # capillary number: range of the law; beyond, threads are many gaps long


@frozen(kw_only=True)
class DynamicRupture(FilmEnd):
    r"""The film breaks beyond the limit of stability of the bridge, the farther the faster.

    .. math:: h_r = h_s \left(1 + a\, Ca^{n}\right), \qquad Ca = \frac{\eta \dot h}{\gamma}

    with the gap h_s at which the exact bridge at rest loses stability.

    Parameters
    ----------
    factor : float
        Factor a [-]; 0: as at rest.
    exponent : float
        Exponent n [-].

    Notes
    -----
    The form and a = 1, n = 1/2 are those that Pitois and others found between spheres with silicone
    oils of 0.01 to 100 Pa.s; they are quoted after others, the paper was not read: give your own
    where you have them. A computed viscous bridge between rods has a = 1.15, n = 2/3 up to Ca = 0.1
    (gallery page bridge-rupture): distances that are up to 6 % shorter. Between h_s and h_r the
    meniscus force keeps the value that it has at h_s, as no bridge in equilibrium is there: at most
    that much too large. Viscous and extensional force follow the film. Under a force it breaks
    where its gap exceeds h_r of the speed at that instant: at h_s where it closes. Refused above
    Ca = 1; under a force only beyond h_s.
    """

    name: ClassVar[str] = "dynamic-rupture"
    summary: ClassVar[str] = "rupture distance that grows with speed"
    outlasts: ClassVar[bool] = True
    sources = (
        "1 + Ca^(1/2): Pitois, Moucheront and Chateau 2000, quoted after others; limit at rest by "
        "the exact bridge",
    )

    factor: float = field(default=1.0, validator=non_negative, metadata=si("-"))
    exponent: float = field(default=0.5, validator=positive, metadata=si("-"))

    def liquid_needs(self, scene: SeparationScene) -> tuple[str, ...]:
        """See `Effect.liquid_needs`."""
        return ("viscosity", "surface_tension")

    def lacks(self, scene: SeparationScene) -> tuple[str, ...]:
        """See `Effect.lacks`."""
        return line_needs(scene)

    def prepare(self, prepared: PreparedScene[SeparationScene]) -> float:
        """See `FilmEnd.prepare`: at the speed that is imposed, or the fastest that is known."""
        loading, at_rest = prepared.scene.loading, exact_end(prepared)
        if not isinstance(loading, ImposedSpeed):
            return self._end(at_rest, _FASTEST)
        _refuse_fast(prepared, loading.speed)
        return self._end(at_rest, capillary_number(prepared, loading.speed))

    def prepare_moving(self, prepared: PreparedScene[SeparationScene]) -> MovingEnd | None:
        """See `FilmEnd.prepare_moving`: that of the speed at each instant.

        While the gap closes it is that at rest. A speed beyond the law is refused only where a film
        at rest would have broken.
        """
        if isinstance(prepared.scene.loading, ImposedSpeed):
            return None
        at_rest = exact_end(prepared)

        def end_at(gap: float, speed: float) -> float:
            return self._end(at_rest, capillary_number(prepared, speed))

        def check(gap: float, speed: float) -> None:
            if gap > at_rest:
                _refuse_fast(prepared, speed)

        return MovingEnd(end_at, check)

    def _end(self, at_rest: float, ca: float) -> float:
        """Gap [m] at which the film breaks at a capillary number of the opening [-]."""
        ca = min(max(ca, 0.0), _FASTEST)
        return at_rest * (1.0 + self.factor * math.pow(ca, self.exponent))

    def validity(
        self, plan: PlanView, path: Sequence[tuple[float, float]]
    ) -> tuple[ValidityNumber, ...]:
        """See `SeparationEffect.validity`."""
        # Of a motion, where it may break: the speed before decides nothing.
        least = 0.0
        if not isinstance(plan.scene.loading, ImposedSpeed):
            least = _NEAR * exact_end(plan.prepared)
        fastest = max((speed for gap, speed in path if gap >= least), default=0.0)
        return (
            ValidityNumber(
                name="capillary number of the opening",
                value=capillary_number(plan.prepared, max(fastest, 0.0)),
                high=_FAST,
                detail="the law of the rupture distance is an observation at slow openings",
                source="eta h'/gamma",
            ),
        )


def _refuse_fast(prepared: PreparedScene[SeparationScene], speed: float) -> None:
    ca = capillary_number(prepared, speed)
    if ca > _FASTEST:
        raise InfeasibleError(
            f"DynamicRupture: the capillary number eta h'/gamma is {ca:.3g} at {speed:g} m/s, and "
            f"the law is known up to {_FASTEST:g}; give a lower speed, or Rupture(gap=...) with a "
            "measured distance"
        )
