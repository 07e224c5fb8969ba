"""Liquid that a receding line leaves behind: the volume of the bridge falls along the motion."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from functools import lru_cache
from typing import TYPE_CHECKING, Any, ClassVar, Literal

from attrs import field, frozen

from ...capillary.wetting.landau_levich import THICKNESS_LAWS, film_fraction
from ...errors import InfeasibleError
from ...scene.column import Column
from ...scene.loading import ImposedSpeed
from ...validators import choice
from ...validity import ValidityNumber
from ..effects.base import MovingAngle, RunCurves, VolumeLoss, VolumeRate
from ..effects.prepared import with_fraction
from .cox_voinov import capillary_number
from .line import LEAST_LEFT, Line, Lines, line_needs
from .losing_film import lagrange, volume_nodes

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from ...scene.scenes import SeparationScene
    from ..effects.base import PlanView
    from ..effects.prepared import PreparedScene

    Prepared = PreparedScene[SeparationScene]
    Curve = NDArray[np.float64]

__all__ = ["LandauLevichFilm"]

# Ca up to which a law is within 10 % (of Aussillous and Quere's), and up to which it is taken.
_RANGES: Mapping[str, tuple[float, float]] = {
    "aussillous-quere": (0.1, 1.0),
    "landau-levich": (5e-3, 0.1),
}
_RTOL = 1e-6  # of the volume; the lines are known to 1e-5
_STEPS = 120  # of the volume at least, in ln h: a curve through their ends is right to 1e-6
_TOUCH = 1e-4  # of the last gap, from which that of a touching sphere is counted
_KEPT = 4096  # gaps whose volume is kept: every law of the film asks for it
_ITERATIONS = 60  # of the speed of the lines, which their own loss raises; 4 to 20 are taken
_SAME = 1e-12  # of what is lost, at which that is known
_JUST_BELOW = 1.0 - 1e-9  # of the smallest gap of a motion
_STEP = 1e-4  # of the volume, for the slope of a radius over it: right to 1e-4


@frozen(kw_only=True)
class LandauLevichFilm(VolumeLoss):
    r"""Film that a receding contact line leaves on the bodies, by Landau, Levich and Derjaguin.

    .. math:: e_i = \frac{1.34}{\kappa_i} Ca_i^{2/3}, \qquad
              \frac{dV}{dt} = -\sum_i 2 \pi r_i\, e_i\, U_i

    with radius and speed of the receding lines, and the curvature of the meridian there, of the
    exact bridge; the sum is over the bodies whose angle is 0. The volume is a state along the gap,
    or of the motion under a force, and every force of the film is that of the volume left.

    Parameters
    ----------
    law : {"aussillous-quere", "landau-levich"}
        ``"landau-levich"``: the formula above, the limit of small Ca. ``"aussillous-quere"``: over
        1 + 3.35 Ca^(2/3), as the films narrow the meniscus they come from.

    Notes
    -----
    A film is left only at an angle of 0: of a liquid that wets, or where `CoxVoinovAngle` says that
    the receding angle is 0. The laws differ by 10 % of the film at Ca = 5e-3 and by 35 % at 0.03.
    A line leaves a film only while it recedes, and the films stay: they neither drain nor feed the
    bridge again, also where it comes back over them. After a rupture, what re-wets is
    `Meniscus.rewetting` of the volume of the scene, films or not. Of a liquid that wets the lines
    rest at some 0.6 of the limit of stability and advance beyond. Forces of the volume left are
    interpolated between five volumes. Refused above Ca = 1 (0.1 with ``"landau-levich"``), and
    where less than 0.3 of the liquid is left.
    """

    name: ClassVar[str] = "landau-levich-film"
    summary: ClassVar[str] = "liquid that a receding line leaves behind (Landau-Levich)"
    least: ClassVar[float] = LEAST_LEFT
    late: ClassVar[tuple[Column, ...]] = (
        Column("deposited_volume", "m3", "liquid left behind on the bodies"),
    )
    sources = (
        "Landau and Levich 1942, Derjaguin 1943; curvature of the meniscus: Bretherton 1961",
        "saturation: Aussillous and Quere 2000",
    )

    law: Literal["aussillous-quere", "landau-levich"] = field(
        default="aussillous-quere", validator=choice(*THICKNESS_LAWS)
    )

    @classmethod
    def curves(cls) -> tuple[Column, ...]:
        """See `SeparationEffect.curves`."""
        return cls.late

    def cites(self, scene: SeparationScene) -> tuple[str, ...]:
        """See `Effect.cites`."""
        return self.sources if self.law == "aussillous-quere" else self.sources[:1]

    def liquid_needs(self, scene: SeparationScene) -> tuple[str, ...]:
        """See `Effect.liquid_needs`."""
        return ("viscosity", "surface_tension")

    def lacks(self, scene: SeparationScene) -> tuple[str, ...]:
        """See `Effect.lacks`."""
        from ..effects.viscous import TensionLimit

        missing, meniscus = line_needs(scene), scene.meniscus
        angles = meniscus.contact_angle_lower, meniscus.contact_angle_upper
        if min(angles) > 0.0 and scene.effect(MovingAngle) is None:
            missing += (
                "a contact angle of 0 on one of the bodies, or CoxVoinovAngle() beside it: a line "
                "that recedes with an angle leaves no film",
            )
        if sum(map(math.cos, angles)) <= 0.0:
            missing += ("contact angles that add up to less than 180 deg",)
        limit = scene.effect(TensionLimit)
        if limit is not None and limit.cavity == "mass-conserving":
            missing += ('TensionLimit(cavity="truncated"): a cavity keeps the volume of its film',)
        return missing

    def volume_fraction(self, prepared: Prepared) -> Callable[[float], float]:
        """See `VolumeLoss.volume_fraction`."""
        import numpy as np
        from scipy.integrate import solve_ivp
        from scipy.interpolate import CubicHermiteSpline

        loading = prepared.scene.loading
        assert isinstance(loading, ImposedSpeed)
        first, speed, rate = loading.initial_gap, loading.speed, _Rate(self, prepared)
        last = min(loading.final_gap, rate.end(1.0))
        if first >= last:
            return lambda gap: 1.0
        begin = first or _TOUCH * last  # in ln h, as most is left behind while the gap is small

        def slope(place: float, left: Sequence[float] | NDArray[np.float64]) -> list[float]:
            gap = math.exp(place)
            return [gap * rate(gap, speed, float(left[0])) / speed]

        span = math.log(begin), math.log(last)
        longest = (span[1] - span[0]) / _STEPS
        solved = solve_ivp(slope, span, [1.0], rtol=_RTOL, atol=_RTOL, max_step=longest)
        places, parts = solved.t.tolist(), solved.y[0].tolist()
        for place, part in zip(places, parts, strict=True):
            rate.check(math.exp(place), speed, part)
        # Slopes of its own, as where a film sets in or ceases they jump and a spline would swing.
        slopes = [slope(place, [part])[0] for place, part in zip(places, parts, strict=True)]
        curve = CubicHermiteSpline(places, np.minimum.accumulate(parts), slopes)

        @lru_cache(maxsize=_KEPT)
        def fraction(gap: float) -> float:
            return float(curve(min(max(math.log(max(gap, begin)), span[0]), span[1])))

        return fraction

    def volume_rate(self, prepared: Prepared) -> VolumeRate:
        """See `VolumeLoss.volume_rate`."""
        return _Rate(self, prepared)

    def late_curves(self, run: RunCurves) -> Mapping[str, Curve]:
        """See `SeparationEffect.late_curves`: as left when the film broke, from there on."""
        import numpy as np

        scene = run.plan.scene
        assert scene.meniscus.volume is not None
        left = scene.meniscus.volume * (1.0 - run.volume_fraction)
        left = np.where(run.whole, left, np.max(left[run.whole], initial=0.0))
        left.flags.writeable = False
        return {self.late[0].name: left}

    def validity(
        self, plan: PlanView, path: Sequence[tuple[float, float]]
    ) -> tuple[ValidityNumber, ...]:
        """See `SeparationEffect.validity`."""
        rate, fraction = _Rate(self, plan.prepared), plan.film.volume_fraction
        # Lines of similar bridges are as fast: of a motion, those of the whole volume are taken.
        part = (lambda gap: 1.0) if fraction is None else fraction
        fastest = max(rate.capillary_number(*place, part(place[0])) for place in path)
        lost = "what stays behind is deposited_volume"
        if fraction is not None:
            lost = f"of the liquid {1.0 - fraction(path[-1][0]):.1%} stays behind"
        return (
            ValidityNumber(
                name="capillary number of the receding line",
                value=fastest,
                high=_RANGES[self.law][0],
                detail=f"{lost}; law={self.law!r}",
                source="eta U/gamma; Aussillous and Quere 2000",
            ),
        )


class _Rate:
    """Volume that the receding lines of the bridges of a scene lose over time."""

    def __init__(self, effect: LandauLevichFilm, prepared: Prepared) -> None:
        self._law, self._prepared = effect.law, prepared
        # Between flats bridges of all volumes have one shape.
        is_flat = prepared.scene.interface.is_flat
        self._nodes = (1.0,) if is_flat else volume_nodes(LEAST_LEFT)
        self._scenes = [with_fraction(prepared, node) for node in self._nodes]
        self._lines = [Lines(one) for one in self._scenes]
        moving = prepared.scene.effect(MovingAngle)
        # Of the whole volume, at the same gap over its end: lines of similar bridges are as fast.
        self._angles = None if moving is None else moving.prepare_angles(prepared)

    def end(self, part: float) -> float:
        """Gap at which the bridge of a part of the volume ends [m]."""
        weights = lagrange(self._nodes, part)
        each = zip(weights, self._lines, self._nodes, strict=True)
        return math.cbrt(part) * sum(w * one.axis.end / math.cbrt(x) for w, one, x in each)

    def __call__(self, gap: float, speed: float, part: float) -> float:
        """Rate [1/s] of the part of the volume that is left, at a gap [m] and a speed [m/s]."""
        found = self._receding(gap, speed, min(max(part, LEAST_LEFT), 1.0))
        lost = sum(2.0 * math.pi * line.radius * e * u for line, e, u in found)
        return -lost / self._prepared.film.volume

    def capillary_number(self, gap: float, speed: float, part: float) -> float:
        """Highest capillary number of a line that leaves a film [-]; 0 if none does."""
        velocity = max((u for _, _, u in self._receding(gap, speed, part)), default=0.0)
        return capillary_number(self._prepared, velocity)

    def check(self, gap: float, speed: float, part: float) -> None:
        """See `VolumeRate.check`."""
        first, full = self._lines[0].axis.first, self._prepared.film.full_gap
        if part <= LEAST_LEFT:
            raise InfeasibleError(
                f"LandauLevichFilm: of the liquid less than {LEAST_LEFT:.0%} is left at a gap of "
                f"{gap:.3g} m and {speed:g} m/s; give a smaller loading.final_gap"
            )
        if gap < first * _JUST_BELOW:
            raise InfeasibleError(
                f"LandauLevichFilm: the gap closes to {gap:.3g} m, and the lines are known from "
                f"{first:.3g} m on; give loading.rest_gap [m], where asperities carry, or start "
                "from a smaller gap"
            )
        if gap < full:
            raise InfeasibleError(
                f"LandauLevichFilm: at a gap of {gap:.3g} m the film fills its faces, as it does "
                f"up to {full:.3g} m, and a line pinned at their rim does not move; give wider "
                "faces, or loading.rest_gap [m] beyond"
            )
        ca, most = self.capillary_number(gap, speed, part), _RANGES[self._law][1]
        if ca > most:
            raise InfeasibleError(
                f"LandauLevichFilm: at a gap of {gap:.3g} m and {speed:g} m/s the capillary "
                f"number eta U/gamma of the receding line is {ca:.3g}, and law={self._law!r} is "
                f"known up to {most:g}; give a lower speed (loading.speed, or a lower "
                "loading.force)"
            )

    def _at(self, gap: float, speed: float, part: float) -> tuple[list[Line], Any]:
        """Lines on both bodies, and their angles, at the same gap over the end in each volume."""
        weights, end = lagrange(self._nodes, part), self.end(part)
        places = [gap * one.axis.end / end for one in self._lines]
        each = [one.at(place) for one, place in zip(self._lines, places, strict=True)]
        size = [math.cbrt(node / part) for node in self._nodes]
        lines = []
        for body in (0, 1):
            radius = pace = curvature = 0.0
            for w, length, pair in zip(weights, size, each, strict=True):
                radius += w * pair[body].radius / length
                pace += w * pair[body].speed
                curvature += w * pair[body].curvature * length
            lines.append(Line(radius, pace, curvature))
        if self._angles is None:
            return lines, self._prepared.angles
        angles = self._angles(places[0], speed)
        # The lines are those of the angles at rest: what the moved ones add to the curvature is
        # that of a thin film.
        heights = (one.film.height(place) for one, place in zip(self._scenes, places, strict=True))
        height = sum(w * h / x for w, h, x in zip(weights, heights, size, strict=True))
        more = (sum(map(math.cos, angles)) - self._prepared.wetting) / height
        return [one._replace(curvature=one.curvature + more) for one in lines], angles

    def _receding(self, gap: float, speed: float, part: float) -> list[tuple[Line, float, float]]:
        """Lines that leave a film, its thickness [m], and their speed [m/s]."""
        if speed == 0.0 or gap >= self.end(part):
            return []
        lines, angles = self._at(gap, speed, part)
        leaves = [
            angle == 0.0 and line.speed * speed < 0.0 and line.curvature > 0.0
            for line, angle in zip(lines, angles, strict=True)
        ]
        if not any(leaves):
            return []
        other = self._at(gap, speed, part * (1.0 - _STEP))[0]
        step = _STEP * part * self._prepared.film.volume
        chosen = [
            (line, (line.radius - less.radius) / step)
            for line, less, is_left in zip(lines, other, leaves, strict=True)
            if is_left
        ]
        # What is left behind draws a line in further, by its radius over the volume.
        lost = 0.0
        found: list[tuple[Line, float, float]] = []
        for _ in range(_ITERATIONS):
            found, before = [], lost
            for line, by_volume in chosen:
                u = by_volume * before - line.speed * speed
                found.append((line, self._thickness(line, u), u))
            lost = sum(2.0 * math.pi * line.radius * e * u for line, e, u in found)
            if abs(lost - before) <= _SAME * lost:
                break
        return found

    def _thickness(self, line: Line, u: float) -> float:
        """Thickness [m] of the film of a line; beyond the range of the law, that at its end."""
        ca = min(capillary_number(self._prepared, u), _RANGES[self._law][1])
        return float(film_fraction(ca, self._law)) / line.curvature
