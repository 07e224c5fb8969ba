"""Meniscus force between flats: free at constant volume, or pinned at the rim of the faces."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING, Literal, NamedTuple, TypeAlias

from ...as_published.printed import common as printed
from ...capillary.arc import flat as arc_flat
from ...capillary.flats import force_law as flat_law
from ...numerics.roots import bracketed_root
from .base import ForceLaw
from .film_shape import FilmShape

if TYPE_CHECKING:
    from ...scene.scenes import SeparationScene, SlidingScene
    from .prepared import PreparedScene

    Prepared: TypeAlias = PreparedScene[SeparationScene] | PreparedScene[SlidingScene]

__all__ = [
    "PrintedRadius",
    "arc_law",
    "exact_end",
    "exact_law",
    "printed_law",
    "printed_radius",
    "volume_of_one",
]

Body = Literal["lower", "upper"]
Curve = Callable[[float], float]


class _Film(NamedTuple):
    """Force over surface tension [m] of one film in both its states, over the gap [m].

    `pinned_volume` [m3] is that of the film which reaches the rim.
    """

    free: Curve
    pinned: Curve
    pinned_volume: Curve
    free_end: float
    pinned_end: float


def _nothing(gap: float) -> float:
    raise AssertionError("the film has no such state")


def exact_law(prepared: PreparedScene[SeparationScene]) -> ForceLaw:
    """Force of the exact bridge, which ends where it loses stability."""
    return _law(_exact(prepared), prepared.film, prepared.liquid.surface_tension)


def _exact(prepared: PreparedScene[SeparationScene]) -> _Film:
    film, angles = prepared.film, prepared.angles
    rtol = max(0.1 * prepared.accuracy.time_rtol, 1e-11)
    free: Curve = _nothing
    pinned: Curve = _nothing
    pinned_volume: Curve = _nothing
    free_end = pinned_end = math.inf
    if math.isfinite(film.volume):
        bridges = flat_law.flat_law(*angles, rtol=rtol)
        size = math.cbrt(film.volume)
        free, free_end = _sized(bridges.force, size, size), bridges.end * size
    if math.isfinite(film.rim):
        held = flat_law.flat_law(*angles, pinned=True, rtol=rtol)
        pinned = _sized(held.force, film.rim, film.rim)
        pinned_volume = _sized(held.volume, film.rim, film.rim**3)
        pinned_end = held.end * film.rim
    return _Film(free, pinned, pinned_volume, free_end, pinned_end)


def volume_of_one(prepared: PreparedScene[SeparationScene], profile: str) -> Curve:
    """Volume [m3] of one meniscus over the gap [m]: as given, or what fills it to the rim."""
    film = prepared.film
    both = _exact(prepared) if profile == "exact" else _arcs(prepared, lambda gap, circle: circle)
    pinned_to = _pinned_to(both, film)
    return lambda gap: both.pinned_volume(gap) if gap < pinned_to else film.volume


def _sized(curve: Curve, length: float, factor: float) -> Curve:
    """Curve of a pure number over a pure number, for a size."""
    return lambda gap: factor * curve(gap / length)


def exact_end(prepared: PreparedScene[SeparationScene]) -> float:
    """Gap [m] at which the exact bridge loses stability, without the forces on the way."""
    film, angles = prepared.film, prepared.angles
    if math.isinf(film.rim):
        return flat_law.flat_end(*angles).gap * math.cbrt(film.volume)
    longest, volume = flat_law.flat_end(*angles, pinned=True)
    if film.volume >= volume * film.rim**3:
        return longest * film.rim
    return flat_law.flat_end(*angles).gap * math.cbrt(film.volume)


def arc_law(prepared: PreparedScene[SeparationScene]) -> ForceLaw:
    """Force of the arc through its neck or belly, which ends where its neck closes."""
    arc = arc_flat.shape(*prepared.angles)
    both = _arcs(prepared, lambda gap, circle: arc_flat.force(arc, gap, circle))
    return _law(both, prepared.film, prepared.liquid.surface_tension)


def printed_law(
    prepared: PreparedScene[SeparationScene], pulled: Body, radius: Literal["arc", "disc"]
) -> ForceLaw:
    """Force of Eq. (3.11) with the contact circle of the arc on the pulled body, or of a disc."""
    film, angles, tension = prepared.film, prepared.angles, prepared.liquid.surface_tension
    if radius == "disc":

        def upright(gap: float, speed: float) -> float:
            found = printed.meniscus_flat_3_11(film.radius(gap), gap, tension, *angles, pulled)
            return film.menisci * float(found)

        kinks = (film.full_gap,) if 0.0 < film.full_gap < math.inf else ()
        return ForceLaw(upright, kinks, rate="none")

    def force(gap: float, circle: float) -> float:
        circle = _circle_on(pulled, prepared, gap, circle)
        return float(printed.meniscus_flat_3_11(circle, gap, 1.0, *angles, pulled))

    return _law(_arcs(prepared, force), film, tension)


class PrintedRadius(NamedTuple):
    """Radius in Eq. (3.11) at a gap [m], and whether the film is pinned at the rim there."""

    radius: float
    is_pinned: bool


def printed_radius(
    prepared: Prepared,
    pulled: Body,
    radius: Literal["arc", "disc"],
    gap: float,
) -> PrintedRadius:
    """Radius that `printed_law` takes at a gap [m]."""
    film = prepared.film
    if radius == "disc":
        return PrintedRadius(film.radius(gap), gap < film.full_gap)
    both = _arcs(prepared, lambda gap, circle: _circle_on(pulled, prepared, gap, circle))
    is_pinned = gap < _pinned_to(both, film)
    return PrintedRadius((both.pinned if is_pinned else both.free)(gap), is_pinned)


def _circle_on(pulled: Body, prepared: Prepared, gap: float, circle: float) -> float:
    """Radius of the contact circle [m] on a body, from that on the lower one."""
    if pulled == "lower":
        return circle
    return arc_flat.upper_contact_radius(arc_flat.shape(*prepared.angles), gap, circle)


def _arcs(prepared: Prepared, force: Callable[[float, float], float]) -> _Film:
    """Force over surface tension [m] of arcs, from the gap and the lower contact circle [m]."""
    film, arc = prepared.film, arc_flat.shape(*prepared.angles)
    volume, rim = film.volume, film.rim
    free, pinned = math.isfinite(volume), math.isfinite(rim)

    def free_force(gap: float) -> float:
        return force(gap, arc_flat.contact_radius(arc, gap, volume))

    def pinned_force(gap: float) -> float:
        return force(gap, arc_flat.rim_contact_radius(arc, gap, rim))

    def pinned_volume(gap: float) -> float:
        return float(arc_flat.volume(arc, gap, arc_flat.rim_contact_radius(arc, gap, rim)))

    return _Film(
        free_force,
        pinned_force,
        pinned_volume,
        float(arc_flat.zero_neck_gap(arc, volume)) if free else math.inf,
        arc_flat.zero_neck_gap_at_rim(arc, rim) if pinned else math.inf,
    )


def _law(both: _Film, film: FilmShape, tension: float) -> ForceLaw:
    """Join both states where the liquid just reaches the rim."""
    n, full_gap = film.menisci, _pinned_to(both, film)
    end = both.pinned_end if full_gap >= both.pinned_end else both.free_end
    last = end * (1.0 - 1e-12)  # a trial step may look beyond the end: the force stays as there

    def force(gap: float, speed: float) -> float:
        gap = min(gap, last)
        return n * tension * (both.pinned(gap) if gap < full_gap else both.free(gap))

    kinks = (full_gap,) if 0.0 < full_gap < end else ()
    return ForceLaw(force, kinks, end, rate="none")


def _pinned_to(both: _Film, film: FilmShape) -> float:
    """Gap [m] below which a film reaches the rim of the faces; 0 for never, inf for always."""
    if math.isinf(film.volume):
        return math.inf
    return _full_gap(both, film) if math.isfinite(film.rim) else 0.0


def _full_gap(both: _Film, film: FilmShape) -> float:
    """Gap [m] below which a film of this volume reaches the rim of the faces; inf for always."""

    def excess(gap: float) -> float:
        return both.pinned_volume(gap) / film.volume - 1.0

    last = min(both.free_end, both.pinned_end) * (1.0 - 1e-9)
    low = high = min(film.volume / (math.pi * film.rim * film.rim), last)
    while excess(low) > 0.0:
        low *= 0.5
    while excess(high) < 0.0:
        if high >= last:
            return math.inf
        high = min(2.0 * high, last)
    return bracketed_root(excess, low, high)
