"""Contact angle that depends on the speed of the line, by Cox and Voinov."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from functools import lru_cache
from typing import TYPE_CHECKING, ClassVar

from attrs import field, frozen

from ...capillary.wetting.cox_voinov import dynamic_angle
from ...errors import DescriptionError, InfeasibleError
from ...numerics.cubic_spline import cubic_spline
from ...numerics.roots import bracketed_root
from ...scene.column import Column
from ...scene.loading import ImposedSpeed
from ...units import si
from ...validators import optional, positive
from ...validity import ValidityNumber
from ..effects.base import Angles, ForceLaw, MovingAngle, RunCurves
from ..effects.meniscus import MeniscusForce
from .line import BridgeAxis, Lines, line_needs

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
_MOST_SPEEDS = 64  # whose curves are kept, each of _POINTS bridges
_POINTS = 161  # bridges of a curve: right to 1e-6 of what the angles change


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
    the direction of motion. A bridge ends where that with the angles of its gap loses stability, or
    that at rest, whichever is first.
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
        return self._angles_of(Lines(prepared), prepared)

    def _angles_of(self, lines: Lines, prepared: Prepared) -> Angles:
        lower, upper = prepared.angles

        def angles(gap: float, speed: float) -> tuple[float, float]:
            below, above = lines.at(gap)
            moved = self._moved(prepared, lower, gap, speed * below.speed)
            if upper == lower and above == below:
                return moved, moved
            return moved, self._moved(prepared, upper, gap, speed * above.speed)

        return angles

    def _moved(self, prepared: Prepared, angle: float, gap: float, velocity: float) -> float:
        """Dynamic angle [rad] of a line of a velocity [m/s]."""
        if velocity == 0.0:
            return angle
        ca = capillary_number(prepared, velocity)
        if abs(ca) > _FASTEST:
            raise InfeasibleError(
                f"CoxVoinovAngle: at a gap of {gap:.3g} m the capillary number eta U/gamma of the "
                f"contact line is {ca:.3g}, and the angle is known up to {_FASTEST:g}; give a "
                "lower speed or a larger initial_gap"
            )
        height = prepared.film.height(gap)
        outer = height if self.outer_length is None else self.outer_length
        if outer <= self.slip_length:
            raise InfeasibleError(
                f"CoxVoinovAngle.slip_length is {self.slip_length:g} m, no less than the "
                f"{outer:.3g} m from which the angle is seen at a gap of {gap:.3g} m; give a "
                "smaller one, or more liquid"
            )
        return dynamic_angle(angle, ca * math.log(outer / self.slip_length))

    def meniscus_law(self, prepared: Prepared, at_rest: ForceLaw) -> ForceLaw:
        """See `MovingAngle.meniscus_law`: a curve for each speed, and at rest the law at rest."""
        lines = Lines(prepared)
        angles = self._angles_of(lines, prepared)

        @lru_cache(maxsize=_MOST_SPEEDS)
        def added(speed: float) -> tuple[Callable[[float], float], float]:
            return _added(prepared, at_rest, lines.axis, angles, speed)

        def force(gap: float, speed: float) -> float:
            if speed == 0.0:
                return at_rest.force(gap, 0.0)
            if gap < lines.axis.first * _JUST_BELOW:
                expected = f"be {lines.axis.first:g}, the smallest of the motion, or more"
                raise DescriptionError("gap", gap, expected, unit="m")
            more, end = added(speed)
            return at_rest.force(min(gap, end), 0.0) + more(gap)

        loading = prepared.scene.loading
        end = added(loading.speed)[1] if isinstance(loading, ImposedSpeed) else at_rest.end
        return ForceLaw(force, end=end, known_to=end)

    def late_curves(self, run: RunCurves) -> Mapping[str, Curve]:
        """See `SeparationEffect.late_curves`: the angles along the run; nan where it broke."""
        import numpy as np

        found = np.full((2, run.gap.size), np.nan)
        loading, angles = run.plan.scene.loading, self.prepare_angles(run.plan.prepared)
        assert isinstance(loading, ImposedSpeed)
        for i in np.flatnonzero(run.whole).tolist():
            found[:, i] = angles(float(run.gap[i]), loading.speed)
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


def _added(
    prepared: Prepared, at_rest: ForceLaw, whole: BridgeAxis, angles: Angles, speed: float
) -> tuple[Callable[[float], float], float]:
    """Return what a speed adds to the force at rest [N], over the gap, and where that ends [m]."""
    from ...capillary.exact.bridge import bridge

    film, curvatures = prepared.film, prepared.curvatures
    axis = whole._replace(end=_end(prepared, whole, angles, speed))
    places, gaps = axis.gaps(_POINTS)
    pairs = [angles(gap, speed) for gap in gaps]
    if all(pair == tuple(prepared.angles) for pair in pairs):
        return (lambda gap: 0.0), at_rest.end
    lower, upper = zip(*pairs, strict=True)
    moving = bridge(gaps, film.volume, lower, upper, *curvatures, beyond="nan").force
    size = film.menisci * prepared.liquid.surface_tension
    more = [size * f - at_rest.force(h, 0.0) for f, h in zip(moving.tolist(), gaps, strict=True)]
    if not all(map(math.isfinite, more)):
        raise InfeasibleError(
            f"CoxVoinovAngle: no meniscus spans every gap up to {axis.end:.3g} m with the angles "
            f"at {speed:g} m/s; give a lower speed, or more volume"
        )
    curve = cubic_spline(places, more)
    return (lambda gap: curve(axis.at(gap))[0]), axis.end


def _end(prepared: Prepared, axis: BridgeAxis, angles: Angles, speed: float) -> float:
    """Gap [m] at which a bridge with the angles of that gap ends; that at rest at most."""
    from ...capillary.exact.stability import stability_limit

    def left(gap: float) -> float:
        limit = stability_limit(prepared.film.volume, *angles(gap, speed), *prepared.curvatures)
        return float(limit.gap) / gap - 1.0

    if angles(axis.last, speed) == tuple(prepared.angles) or left(axis.last) >= 0.0:
        return axis.end
    near = axis.first or 1e-3 * axis.end
    if left(near) <= 0.0:
        raise InfeasibleError(
            f"CoxVoinovAngle: no meniscus spans the initial gap of {axis.first:g} m with the "
            f"angles at {speed:g} m/s; give a lower speed, or more volume"
        )
    return bracketed_root(left, near, axis.last)
