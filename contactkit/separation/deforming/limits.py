"""Curves of the limits between which a pull of deforming bodies lies: rigid bodies, and no film."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ...capillary import elastic_bridge
from ...lubrication.elastohydrodynamic.motion import SmoothGap
from ...lubrication.reynolds.damping import disc_damping, dome_damping
from ...scene.loading import ImposedSpeed, PressAndPull

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from .maps.film import MapFilm
    from .plan import DeformingPlan

    Array = NDArray[np.float64]

__all__ = ["Limit", "rigid_limit", "static_limit"]

_POINTS = 16  # of a curve on a map, where each is solved
_CLOSED = 200  # points of a closed form
_NEAREST = 1.05  # gap over that at which rigid bodies touch


class Limit(NamedTuple):
    """A force [N] over the gap of the undeformed bodies [m]."""

    gap: Array
    force: Array


def rigid_limit(plan: DeformingPlan, start: float, end: float) -> Limit | None:
    """Force of rigid bodies at the speed of the pull; None without one, or with a meniscus.

    Parameters
    ----------
    plan : DeformingPlan
        The plan.
    start, end : float
        Gaps between which it is wanted [m]; from where rigid bodies do not touch.
    """
    loading, film = plan.scene.loading, plan.film
    speed = loading.speed if isinstance(loading, ImposedSpeed | PressAndPull) else None
    if speed is None or film.wetting is not None:
        return None
    if not isinstance(film, SmoothGap):
        return _rigid_on_map(film, speed, start, end)
    least = max(start, film.cutoff, 1e-3 * film.gap)
    if least >= end:
        return None
    is_flat = math.isinf(film.radius)
    law = disc_damping(film.rim) if is_flat else dome_damping(film.rim, film.radius)
    gaps = np.geomspace(least, end, _CLOSED)
    return Limit(gaps, np.array([law.force(gap, speed, film.viscosity) for gap in gaps.tolist()]))


def _rigid_on_map(film: MapFilm, speed: float, start: float, end: float) -> Limit | None:
    from ...lubrication.elastohydrodynamic.maps.limits import rigid_damping

    least = max(start, film.peak + film.cutoff + (_NEAREST - 1.0) * film.gap)
    if least >= end:
        return None
    wet = film.wet_map(film.cells)
    gaps = np.geomspace(least, end, _POINTS)
    return Limit(gaps, np.array([speed * rigid_damping(wet, gap) for gap in gaps]))


def static_limit(plan: DeformingPlan, start: float, end: float) -> Limit | None:
    """Pull at rest without end: contact at the cut-off, or the meniscus; None of a flooded film.

    Parameters
    ----------
    plan : DeformingPlan
        The plan.
    start, end : float
        Gaps between which it is wanted [m].
    """
    film = plan.film
    if isinstance(film, SmoothGap) and film.wetting is not None:
        return _of_meniscus(plan, film, start, end)
    if not film.cutoff:
        return None
    if isinstance(film, SmoothGap):
        if math.isinf(film.radius) or start >= film.cutoff:
            return None
        gap = np.linspace(start, min(end, film.cutoff), _CLOSED)
        stiffness = 4.0 / 3.0 * plan.modulus * math.sqrt(film.radius)
        return Limit(gap, -stiffness * (film.cutoff - gap) ** 1.5)
    from ...lubrication.elastohydrodynamic.maps.limits import dry_contact

    touch = film.peak + film.cutoff
    if start >= touch:
        return None
    gaps = np.linspace(min(end, touch), start, _POINTS)
    found = dry_contact(film.wet_map(film.cells), gaps.tolist())
    return Limit(gaps[::-1], -found[::-1])


def _of_meniscus(plan: DeformingPlan, film: SmoothGap, start: float, end: float) -> Limit | None:
    pair = film.radius, plan.modulus, float(film.wetting or 0.0)
    points = []
    for gap in np.linspace(max(start, 1e-3 * film.gap), end, _CLOSED):
        bridge = elastic_bridge.bridge_of_volume(float(gap), plan.volume, *pair)
        if bridge is not None:
            points.append((float(gap), bridge.force))
    return Limit(*map(np.array, zip(*points, strict=True))) if len(points) > 1 else None
