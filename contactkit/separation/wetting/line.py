r"""Contact lines of an exact bridge as it is drawn out: where they are, how fast, how curved.

The lines are those of the bridge in equilibrium at the angles at rest, which the volume sets: they
recede as the gap opens, come to rest at some 0.6 of the limit of stability (of a liquid
that wets), and advance again while the neck closes. The upright rim of the viscous force recedes
5 % faster at a tenth of the limit, 35 % at three tenths, and never comes to rest.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cached_property, lru_cache
from typing import TYPE_CHECKING, NamedTuple

from ...numerics.cubic_spline import cubic_spline
from ...scene.loading import ImposedForce, ImposedSpeed
from ..effects.base import VolumeLoss
from ..effects.meniscus import MeniscusForce
from ..effects.meniscus_sphere import exact_end, thin_gap
from ..effects.viscous import keeps_radius

if TYPE_CHECKING:
    from ...scene.scenes import SeparationScene
    from ..effects.prepared import Angles, Curvatures, PreparedScene

    Curve = Callable[[float], tuple[float, float]]

__all__ = ["LEAST_LEFT", "BridgeAxis", "Line", "Lines", "line_needs", "rim_needs", "speed_needs"]

_POINTS = 161  # of a curve: radii and pressure right to 1e-6, their slopes to 1e-5
LEAST_LEFT = 0.3
"""Least volume over that of the scene: of five volumes from there on lines are right to 1e-4."""
_KEPT = 16  # bridges whose curves are kept: plan, ranges and late curves ask for five volumes each
_CLOSED = 1e-3  # of the first gap, to which a mass may close it
_JUST_BELOW = 1.0 - 1e-6  # of the end, at which a bridge has no slope
# Of the end, from where on the speed of a line stays: in equilibrium it is infinite at the fold,
# which no line follows.
_LAST_SPEED = 0.97


class Line(NamedTuple):
    """Contact line on one body.

    `radius` of its circle [m], `speed` [-]: arc length on the body over the gap at a fixed volume,
    positive where it advances; `curvature` [1/m] of the meridian there, positive if it is hollow.
    """

    radius: float
    speed: float
    curvature: float


class BridgeAxis(NamedTuple):
    """Coordinate in which curves of bridges are smooth, up to the fold at which they end.

    The root of the logarithm of the gap's distance to the `end` [m], with a gap `thin` [m] below
    which little depends on it, as of the curves of `meniscus_sphere`.
    """

    first: float
    end: float
    thin: float

    @property
    def last(self) -> float:
        """Largest gap [m]."""
        return self.end * _JUST_BELOW

    def at(self, gap: float) -> float:
        """Coordinate of a gap [m], which falls as that grows; within the axis."""
        gap = min(max(gap, self.first), self.last)
        return math.sqrt(math.log((self.end + self.thin) / (gap + self.thin)))

    def gaps(self, points: int) -> tuple[list[float], list[float]]:
        """Evenly spaced coordinates, rising, and their gaps [m]."""
        low, high = self.at(self.last), self.at(self.first)
        places = [low + (high - low) * i / (points - 1) for i in range(points)]
        whole = self.end + self.thin
        gaps = [whole * math.exp(-x * x) - self.thin for x in places]
        gaps[0], gaps[-1] = self.last, self.first
        return places, gaps


class Lines:
    """Contact lines of the exact bridge of a prepared scene, over the gap."""

    def __init__(self, prepared: PreparedScene[SeparationScene]) -> None:
        self._prepared = prepared

    @cached_property
    def axis(self) -> BridgeAxis:
        """Gaps that the bridge spans, from the first one of the motion."""
        prepared = self._prepared
        end = exact_end(prepared)
        first = min(_first_gap(prepared), 0.5 * end)
        return BridgeAxis(first, end, thin_gap(prepared.film))

    @cached_property
    def _curves(self) -> tuple[Curve, Curve, Curve]:
        """Radii of both circles [m] and pressure over tension [1/m], over the axis."""
        prepared = self._prepared
        return _curves(self.axis, prepared.film.volume, prepared.angles, prepared.curvatures)

    def at(self, gap: float) -> tuple[Line, Line]:
        """Line on the lower and on the upper body at a gap [m]."""
        axis, prepared = self.axis, self._prepared
        x, near = axis.at(gap), min(max(gap, axis.first), _LAST_SPEED * axis.end)
        y = axis.at(near)
        by_gap = -0.5 / (y * (near + axis.thin))
        lower, upper, pressure = self._curves
        outside = pressure(x)[0]
        found = []
        bodies = zip((lower, upper), prepared.angles, prepared.curvatures, strict=True)
        for curve, angle, bend in bodies:
            radius, slope = curve(x)[0], curve(y)[1]
            tilt = math.asin(min(bend * radius, 1.0))
            speed = slope * by_gap / math.cos(tilt)
            found.append(Line(radius, speed, math.sin(angle + tilt) / radius - outside))
        return found[0], found[1]


@lru_cache(maxsize=_KEPT)
def _curves(
    axis: BridgeAxis, volume: float, angles: Angles, curvatures: Curvatures
) -> tuple[Curve, Curve, Curve]:
    from ...capillary.exact.bridge import bridge

    places, gaps = axis.gaps(_POINTS)
    found = bridge(gaps, volume, *angles, *curvatures)
    columns = found.radius_lower, found.radius_upper, found.pressure
    lower, upper, pressure = (cubic_spline(places, column.tolist()) for column in columns)
    return lower, upper, pressure


def _first_gap(prepared: PreparedScene[SeparationScene]) -> float:
    """Smallest gap [m] that is asked for: films of less volume are taken at smaller gaps."""
    loading, loses = prepared.scene.loading, prepared.scene.effect(VolumeLoss) is not None
    first = loading.initial_gap
    if isinstance(loading, ImposedForce):  # a mass may close the gap before it opens it
        first = min(loading.rest_gap or _CLOSED * first, first)
    return first * (math.cbrt(LEAST_LEFT) if loses else 1.0)


def speed_needs(scene: SeparationScene) -> tuple[str, ...]:
    """Return the needs of an effect that depends on the speed of the line, or on its way."""
    loading = scene.loading
    if isinstance(loading, ImposedForce):
        return ()
    if isinstance(loading, ImposedSpeed) and loading.vibration is None:
        return ()
    return (
        "loading = ImposedSpeed(...) without vibration, or ImposedForce(...): within a time no "
        "speed is known, and a vibration turns the line twice a cycle",
    )


def rim_needs(scene: SeparationScene) -> tuple[str, ...]:
    """Return the needs of an effect of a bridge of a given volume with lines free to move."""
    interface, meniscus, missing = scene.interface, scene.meniscus, tuple[str, ...]()
    if meniscus.volume is None:
        return ("interface.meniscus.volume [m3]: its amount of liquid is that of a bridge",)
    if not interface.has_discs:
        return ("even discs or spheres: the rim of a film on other faces is not round",)
    rim, start, volume = interface.rim_radius, scene.loading.initial_gap, meniscus.volume
    if math.isfinite(rim):
        sag = 0.0 if interface.is_flat else rim * rim / (2.0 * interface.sphere_radius)
        least = volume / (math.pi * rim * rim) - 0.5 * sag  # the film fills the faces up to here
        if start < least:
            missing += (
                f"faces wider than the film, which fills them up to a gap of {least:.3g} m: a line "
                "pinned at their rim does not move",
            )
    if keeps_radius(scene):
        missing += ('ViscousForce(closure="volume-conserving"): a flooded rim does not move',)
    return missing


def line_needs(scene: SeparationScene) -> tuple[str, ...]:
    """Return the needs of an effect of a moving line: its speed, freedom, an exact meniscus."""
    meniscus = scene.effect(MeniscusForce)
    is_exact = meniscus is None or meniscus.form == "exact"
    exact = () if is_exact else ('MeniscusForce(profile="exact"): others have no moving line',)
    return speed_needs(scene) + rim_needs(scene) + exact
