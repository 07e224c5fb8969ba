"""Bodies that their own attraction closes before a rising pull opens them."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import TYPE_CHECKING

from ..units import quantity_text

if TYPE_CHECKING:
    from ..scene.loading import ImposedForce
    from .film import Film

__all__ = ["closed_first", "closing_note"]

_LEAST = 1e-6  # of the initial gap; less is not worth a remark on a run
_SMALL = 1e-3  # ratio below which a series is within a part in a thousand


def closing_note(loading: ImposedForce, film: Film) -> str:
    """Say that a rising pull lets the bodies close first, and about how far; empty if not.

    The attraction is that at the start throughout; the film or the mass limits how far.
    """
    if loading.rise_time == 0.0 or loading.force <= 0.0 or loading.rest_gap == loading.initial_gap:
        return ""
    gap, pull = loading.initial_gap, loading.force
    attraction = film.static_force(gap)
    if attraction <= 0.0:
        return ""
    begins = (
        f"the bodies close first: they attract each other with {quantity_text(attraction, 'N')} at "
        f"the start, and the pull"
    )
    cure = _cure(loading)
    if attraction >= pull:
        return f"{begins} rises to {quantity_text(pull, 'N')} only; {cure}"
    time = -loading.rise_time * math.log1p(-attraction / pull)
    travel = min(_in_film(loading, film, attraction, time), _of_mass(loading, attraction, time))
    after = quantity_text(time, "s")
    return f"{begins} exceeds that only after {after}, {_when(travel, gap)}; {cure}"


def _when(travel: float, gap: float) -> str:
    if travel > 0.1 * gap:
        return "when they have closed by more than a tenth of the gap, or touch"
    return f"when they are about {quantity_text(travel, 'm')} closer"


def _in_film(loading: ImposedForce, film: Film, attraction: float, time: float) -> float:
    """Travel [m] of a body without mass: the film takes the impulse that is left."""
    start = loading.initial_gap
    if not film.sets_speed:
        return math.inf
    ratio, late = attraction / loading.force, time / loading.rise_time
    # Of both impulses; a series where they cancel.
    left = 0.5 * ratio**2 if ratio < _SMALL else ratio * (1.0 + late) - late
    impulse = loading.force * loading.rise_time * left
    low, high = math.log(1e-16), 0.0  # of the travel over the gap
    for _ in range(50):
        middle = 0.5 * (low + high)
        end, travel = start * -math.expm1(middle), start * math.exp(middle)
        if film.has_viscous_impulse:
            taken = film.viscous_impulse(end, start)
        else:
            taken = film.impulse_at(end, start, -travel / time)
        if taken > impulse:
            high = middle
        else:
            low = middle
    return start * math.exp(low)


def _of_mass(loading: ImposedForce, attraction: float, time: float) -> float:
    """Travel [m] of a mass without a film: as far again after the pull exceeds the attraction."""
    if loading.mass is None:
        return math.inf
    rise = loading.rise_time
    pulled = time**3 / (6.0 * rise)
    if time > _SMALL * rise:
        pulled = 0.5 * time**2 - rise * time - rise**2 * math.expm1(-time / rise)
    return 2.0 * (0.5 * attraction * time**2 - loading.force * pulled) / loading.mass


def closed_first(loading: ImposedForce, gaps: Iterable[float], film: Film) -> str:
    """Remark in the message of a run on how far it closed before it opened; empty if not."""
    start, least = loading.initial_gap, min(gaps)
    if not closing_note(loading, film) or least >= start * (1.0 - _LEAST):
        return ""
    return (
        f"; it closed by {quantity_text(start - least, 'm')} first, under its own attraction while "
        f"the pull rose: {_cure(loading)}"
    )


def _cure(loading: ImposedForce) -> str:
    return f"if asperities hold the bodies there, give loading.rest_gap = {loading.initial_gap:g} m"
