"""Contact angle that depends on the speed of the line, by Cox and Voinov."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, ClassVar

from attrs import field, frozen

from ...capillary.wetting.cox_voinov import dynamic_angle
from ...capillary.wetting.moving_bridge import BridgeTable, bridge_table
from ...errors import InfeasibleError
from ...numerics.cubic_spline import cubic_spline
from ...numerics.roots import bracketed_root
from ...scene.column import Column
from ...scene.loading import ImposedSpeed
from ...units import si
from ...validators import optional, positive
from ...validity import ValidityNumber
from ..effects.base import Angles, ForceLaw, MovingAngle, RunCurves
from ..effects.meniscus import MeniscusForce
from .line import Lines, line_needs

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from ...scene.scenes import SeparationScene
    from ..effects.base import PlanView
    from ..effects.prepared import PreparedScene

    Prepared = PreparedScene[SeparationScene]
    Curve = NDArray[np.float64]

__all__ = ["CoxVoinovAngle", "capillary_number"]

_FAST, _FASTEST = 0.1, 1.0  # |Ca| of the line: range of Cox' expansion in small Ca; refused beyond
_JUST_BELOW = 1.0 - 1e-9  # of the smallest gap of a motion
_POINTS = 161  # bridges of a curve at a speed: right to 1e-6 of what the angles change


@frozen(kw_only=True)
class CoxVoinovAngle(MovingAngle):
    r"""Advancing and receding contact angle over the speed of the line.

    .. math:: G(\theta_d) = G(\theta_0) + Ca \ln\frac{L}{\lambda}, \qquad
              G(\theta) \approx \frac{\theta^3}{9}, \quad Ca = \frac{\eta U}{\gamma}

    with the speed U of the line, positive where it advances, and Cox' full function G. The meniscus
    force is that of the exact bridge with the dynamic angles. A receding line of Ca beyond
    G(theta_0)/ln(L/lambda) has an angle of 0: it leaves a film behind, see `LandauLevichFilm`.

    Parameters
    ----------
    slip_length : float
        Slip length lambda [m], where the liquid next to the line slips; about 1e-9.
    outer_length : float, optional
        Length L [m] that the angle is seen from. None: the height of the film at its rim.

    Notes
    -----
    First order in Ca; refused where a line exceeds Ca = 1. The lines move as those of the bridge at
    rest do, which its volume sets: how the angle displaces them on its way is left out.
    Hysteresis and the pinning of lines are left out, too: give the angle at rest that belongs to
    the direction of motion. A bridge ends where that with the angles of its gap and speed loses
    stability, or that at rest, whichever is first. A film that fills its faces has a pinned line,
    whose angle stays.

    At an imposed speed bridges are solved for it. In a motion under a force they are interpolated
    over gap and both angles: right to 1e-4 up to 0.7 of the gap at which the bridge ends (to 0.97
    with equal angles between equal bodies), to 1 % at 0.9 and to some per cent in the last tenth.
    What the angle adds counts to the dissipated work.
    """

    name: ClassVar[str] = "cox-voinov-angle"
    summary: ClassVar[str] = "contact angle that depends on the speed of the line (Cox-Voinov)"
    late: ClassVar[tuple[Column, ...]] = (
        Column("dynamic_angle_lower", "rad", "dynamic contact angle, lower"),
        Column("dynamic_angle_upper", "rad", "dynamic contact angle, upper", None, "--"),
    )
    sources = ("Voinov 1976; Cox 1986, Eq. (8.3), against a gas",)

    slip_length: float = field(default=1e-9, validator=positive, metadata=si("m"))
    outer_length: float | None = field(default=None, validator=optional(positive), metadata=si("m"))

    @classmethod
    def curves(cls) -> tuple[Column, ...]:
        """See `SeparationEffect.curves`."""
        return cls.late

    def liquid_needs(self, scene: SeparationScene) -> tuple[str, ...]:
        """See `Effect.liquid_needs`."""
        return ("viscosity", "surface_tension")

    def lacks(self, scene: SeparationScene) -> tuple[str, ...]:
        """See `Effect.lacks`."""
        missing = line_needs(scene)
        if scene.effect(MeniscusForce) is None:
            missing += ("MeniscusForce() beside it, whose angle it is",)
        return missing

    def prepare_angles(self, prepared: Prepared) -> Angles:
        """See `MovingAngle.prepare_angles`."""
        return _MovedBridge(self, prepared).angles

    def meniscus_law(self, prepared: Prepared, at_rest: ForceLaw) -> ForceLaw:
        """See `MovingAngle.meniscus_law`: what the angles change is added to the law at rest."""
        moved, loading = _MovedBridge(self, prepared), prepared.scene.loading
        pinned_to = max(at_rest.kinks, default=0.0)  # a line at the rim of the faces does not move

        def force(gap: float, speed: float) -> float:
            still = at_rest.force(gap, 0.0)
            if speed == 0.0 or gap < pinned_to:
                return still
            return still + moved.added(min(gap, at_rest.end), speed)

        def end_at(gap: float, speed: float) -> float:
            return at_rest.end if gap < pinned_to else moved.end_at(gap, speed, at_rest.end)

        def check(gap: float, speed: float) -> None:
            if gap >= pinned_to:
                moved.check(gap, speed)

        if not isinstance(loading, ImposedSpeed):
            end = at_rest.end
            return ForceLaw(force, at_rest.kinks, end, known_to=end, end_at=end_at, check=check)
        constant = loading.speed
        end = moved.end_of(constant, at_rest.end)
        added = moved.curve(constant, end, at_rest)

        def at_speed(gap: float, speed: float) -> float:
            if speed != constant:
                return force(gap, speed)
            return at_rest.force(min(gap, end), 0.0) + added(gap)

        return ForceLaw(at_speed, at_rest.kinks, end, known_to=end, check=check)

    def late_curves(self, run: RunCurves) -> Mapping[str, Curve]:
        """See `SeparationEffect.late_curves`: the angles along the run; nan where it broke."""
        import numpy as np

        found = np.full((2, run.gap.size), np.nan)
        angles = self.prepare_angles(run.plan.prepared)
        for i in np.flatnonzero(run.whole).tolist():
            found[:, i] = angles(float(run.gap[i]), float(run.speed[i]))
        found.flags.writeable = False
        return {column.name: found[i] for i, column in enumerate(self.late)}

    def validity(
        self, plan: PlanView, path: Sequence[tuple[float, float]]
    ) -> tuple[ValidityNumber, ...]:
        """See `SeparationEffect.validity`."""
        lines, fastest = Lines(plan.prepared), 0.0
        for gap, speed in path:
            velocity = max(abs(line.speed) for line in lines.at(gap)) * abs(speed)
            fastest = max(fastest, capillary_number(plan.prepared, velocity))
        return (
            ValidityNumber(
                name="capillary number of the contact line",
                value=fastest,
                high=_FAST,
                detail="the dynamic angle is of first order in it",
                source="eta U/gamma; Cox 1986",
            ),
        )


def capillary_number(prepared: Prepared, velocity: float) -> float:
    """Capillary number eta U/gamma of a line of a velocity [m/s]."""
    return float(prepared.liquid.viscosity * velocity / prepared.liquid.surface_tension)


class _MovedBridge:
    """Bridge of a prepared scene whose angles follow the speed of its lines."""

    def __init__(self, effect: CoxVoinovAngle, prepared: Prepared) -> None:
        self._effect, self._prepared = effect, prepared
        self._lines = Lines(prepared)
        self._size = math.cbrt(prepared.film.volume)  # of one meniscus [m]

    @cached_property
    def _table(self) -> BridgeTable:
        size, prepared = self._size, self._prepared
        first = self._lines.axis.first / size
        if first > 0.0:  # one table for many scenes
            first = 2.0 ** math.floor(math.log2(first))
        lower, upper = (bend * size for bend in prepared.curvatures)
        is_even = lower == upper and prepared.angles.lower == prepared.angles.upper
        return bridge_table((lower, upper), first, is_even=is_even)

    def angles(self, gap: float, speed: float) -> tuple[float, float]:
        """Angles [rad] on both bodies; of a line beyond the range of the law, those at its end."""
        lower, upper = self._prepared.angles
        if speed == 0.0:
            return lower, upper
        below, above = self._lines.at(gap)
        ratio = max(self._outer(gap) / self._effect.slip_length, 1.0)
        moved = self._moved(lower, speed * below.speed, ratio)
        if upper == lower and above == below:
            return moved, moved
        return moved, self._moved(upper, speed * above.speed, ratio)

    def _moved(self, angle: float, velocity: float, ratio: float) -> float:
        ca = capillary_number(self._prepared, velocity)
        return dynamic_angle(angle, min(max(ca, -_FASTEST), _FASTEST) * math.log(ratio))

    def _outer(self, gap: float) -> float:
        outer = self._effect.outer_length
        return self._prepared.film.height(gap) if outer is None else outer

    def check(self, gap: float, speed: float) -> None:
        """Refuse what a motion has reached and the law does not know."""
        axis, effect = self._lines.axis, self._effect
        if gap < axis.first * _JUST_BELOW:
            raise InfeasibleError(
                f"CoxVoinovAngle: the gap closes to {gap:.3g} m, and the lines are known from "
                f"{axis.first:.3g} m on; give loading.rest_gap [m], where asperities carry, or "
                "start from a smaller gap"
            )
        velocity = max((line.speed * speed for line in self._lines.at(gap)), key=abs)
        ca = capillary_number(self._prepared, velocity)
        if abs(ca) > _FASTEST:
            raise InfeasibleError(
                f"CoxVoinovAngle: at a gap of {gap:.3g} m the capillary number eta U/gamma of the "
                f"contact line is {ca:.3g}, and the angle is known up to {_FASTEST:g}; give a "
                "lower speed or a larger initial_gap"
            )
        if self._outer(gap) <= effect.slip_length:
            raise InfeasibleError(
                f"CoxVoinovAngle.slip_length is {effect.slip_length:g} m, no less than the "
                f"{self._outer(gap):.3g} m from which the angle is seen at a gap of {gap:.3g} m; "
                "give a smaller one, or more liquid"
            )

    def added(self, gap: float, speed: float) -> float:
        """Force [N] of all menisci that the angles add to that at rest."""
        moved, still = self.angles(gap, speed), self._prepared.angles
        if moved == tuple(still):
            return 0.0
        size, table = self._size, self._table
        more = table.force(gap / size, *moved) - table.force(gap / size, *still)
        film, liquid = self._prepared.film, self._prepared.liquid
        return film.menisci * liquid.surface_tension * size * more

    def curve(self, speed: float, end: float, at_rest: ForceLaw) -> Callable[[float], float]:
        """Force [N] that a constant speed adds, over the gap up to its end: bridges solved for it.

        Right to 1e-6 up to the end, where the table of all angles is off by some per cent.
        """
        from ...capillary.exact.bridge import bridge

        prepared, axis = self._prepared, self._lines.axis._replace(end=end)
        places, gaps = axis.gaps(_POINTS)
        lower, upper = zip(*(self.angles(gap, speed) for gap in gaps), strict=True)
        film = prepared.film
        found = bridge(gaps, film.volume, lower, upper, *prepared.curvatures, beyond="nan").force
        size = film.menisci * prepared.liquid.surface_tension
        added = [
            size * f - at_rest.force(h, 0.0) for f, h in zip(found.tolist(), gaps, strict=True)
        ]
        if not all(map(math.isfinite, added)):
            raise InfeasibleError(
                f"CoxVoinovAngle: no meniscus spans every gap up to {end:.3g} m with the angles "
                f"at {speed:g} m/s; give a lower speed, or more volume"
            )
        line = cubic_spline(places, added)
        return lambda gap: line(axis.at(gap))[0]

    def end_at(self, gap: float, speed: float, end: float) -> float:
        """Gap [m] at which the bridge with the angles of a gap and a speed ends; `end` at most."""
        angles = self.angles(gap, speed)
        if self._table.surely_spans(gap / self._size, *angles):
            return end
        return self._end(angles, end)

    def _end(self, angles: tuple[float, float], end: float) -> float:
        """Gap [m] at which the bridge with these angles ends; `end` at most."""
        if angles == tuple(self._prepared.angles):
            return end
        return min(end, self._size * self._table.end(*angles))

    def end_of(self, speed: float, end: float) -> float:
        """Gap [m] at which the bridge ends at a speed that stays; `end` at most.

        Raises
        ------
        InfeasibleError
            If a line is too fast on the way, or no bridge spans the first gap.
        """
        axis = self._lines.axis
        for gap in reversed(axis.gaps(_POINTS)[1]):
            self.check(gap, speed)
        first, last = axis.first or 1e-3 * end, axis.last

        def left(gap: float) -> float:
            return self._end(self.angles(gap, speed), end) / gap - 1.0

        if left(last) >= 0.0:
            return end
        if left(first) <= 0.0:
            raise InfeasibleError(
                f"CoxVoinovAngle: no meniscus spans the initial gap of {axis.first:g} m with the "
                f"angles at {speed:g} m/s; give a lower speed, or more volume"
            )
        return bracketed_root(left, first, last)
