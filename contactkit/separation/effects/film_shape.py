"""Shape of the film with an upright rim: its radius and its height there, over the gap."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING, NamedTuple

from ...lubrication import squeeze_film as squeeze

if TYPE_CHECKING:
    from ...liquids.liquid import LiquidState
    from ...scene.scenes import SeparationScene, SlidingScene

__all__ = ["FilmShape", "between_flats", "film_shape", "needs_extent", "under_sphere"]


class FilmShape(NamedTuple):
    """One of `menisci` equal films.

    `radius` is the distance from the axis to the rim of the film [m] at a gap, `height` the
    thickness of the film there [m]; the film is pinned at `rim` below `full_gap`. `level` is the
    height [m] that the rim of a film of fixed pressure keeps; inf for films of a given volume.
    """

    menisci: int
    volume: float
    rim: float
    full_gap: float
    sphere_radius: float
    radius: Callable[[float], float]
    height: Callable[[float], float]
    level: float = math.inf

    def volume_at(self, gap: float) -> float:
        """Volume of the liquid of one film between the bodies [m3] at a gap [m]."""
        if math.isinf(self.sphere_radius):
            return min(self.volume, math.pi * self.radius(gap) ** 2 * gap)
        height = self.height(gap)
        return min(self.volume, math.pi * self.sphere_radius * (height * height - gap * gap))


def needs_extent(scene: SeparationScene | SlidingScene) -> tuple[str, ...]:
    """Ask for a volume or a rim where the film between two flats would have no end."""
    interface, meniscus = scene.interface, scene.meniscus
    if meniscus.has_pressure:
        if interface.is_flat:
            return ("interface.meniscus.volume [m3] between flats",)
        wetting = math.cos(meniscus.contact_angle_lower) + math.cos(meniscus.contact_angle_upper)
        return () if wetting > 0.0 else ("contact angles that add up to less than 180 deg",)
    if interface.is_flat and meniscus.volume is None and math.isinf(interface.rim_radius):
        needed = "interface.meniscus.volume [m3], or the radius [m] of a Flat face, or its planform"
        return (needed,)
    return ()


def film_shape(
    scene: SeparationScene | SlidingScene,
    liquid: LiquidState,
    pressure: float | None,
    *,
    constant_radius: bool = False,
) -> FilmShape:
    """Shape of one film of the scene, at a pressure of the liquid [Pa] where that is its amount.

    With `constant_radius` it never draws in.
    """
    interface, meniscus = scene.interface, scene.meniscus
    n = meniscus.count
    volume = math.inf if meniscus.volume is None else meniscus.volume / n
    # The faces are shared out: n films, each with its part of the area.
    rim = scene.interface.rim_radius / math.sqrt(n)
    if pressure is not None:
        return _at_pressure(scene, liquid.surface_tension, pressure, rim)
    start, sphere = scene.initial_gap, interface.sphere_radius
    if interface.is_flat:
        if constant_radius:
            rim, volume = min(rim, squeeze.disc_radius(volume, start)), math.inf
        return between_flats(n, volume, rim)
    if constant_radius:
        height = float(squeeze.sphere_film_height(start, volume, sphere))
        rim, volume = min(rim, math.sqrt(2.0 * sphere * (height - start))), math.inf
    return under_sphere(n, volume, rim, sphere)


def between_flats(n: int, volume: float, rim: float) -> FilmShape:
    """Films between flats [m3] up to a rim [m]; of infinite volume full to it at every gap."""
    full_gap = volume / (math.pi * rim * rim) if math.isfinite(rim) else 0.0

    def radius(gap: float) -> float:
        return rim if gap <= full_gap else float(squeeze.disc_radius(volume, gap))

    return FilmShape(n, volume, rim, full_gap, math.inf, radius, lambda gap: gap)


def under_sphere(n: int, volume: float, rim: float, sphere: float) -> FilmShape:
    """Films under a sphere [m3, m]; of infinite volume full to the rim [m] at every gap."""
    sag = rim * rim / (2.0 * sphere)
    # Full to the rim while D^2 + V/(pi R) >= (D + sag)^2.
    full_gap = 0.5 * (volume / (math.pi * sphere * sag) - sag) if 0.0 < sag < math.inf else 0.0
    full_gap = max(full_gap, 0.0)

    def height(gap: float) -> float:
        if gap < full_gap or math.isinf(volume):
            return gap + sag
        return float(squeeze.sphere_film_height(gap, volume, sphere))

    def radius(gap: float) -> float:
        return math.sqrt(2.0 * sphere * max(height(gap) - gap, 0.0))

    return FilmShape(n, volume, rim, full_gap, sphere, radius, height)


def _at_pressure(
    scene: SeparationScene | SlidingScene, tension: float, pressure: float, rim: float
) -> FilmShape:
    """Film under a sphere whose rim keeps its height: that of the hollow arc of its pressure."""
    meniscus, sphere = scene.meniscus, scene.interface.sphere_radius
    wetting = math.cos(meniscus.contact_angle_lower) + math.cos(meniscus.contact_angle_upper)
    level = -tension * wetting / pressure
    sag = rim * rim / (2.0 * sphere)

    def height(gap: float) -> float:
        return max(min(level, gap + sag), gap)

    def radius(gap: float) -> float:
        return math.sqrt(2.0 * sphere * (height(gap) - gap))

    full_gap = max(level - sag, 0.0)
    return FilmShape(meniscus.count, math.inf, rim, full_gap, sphere, radius, height, level=level)
