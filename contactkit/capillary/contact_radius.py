"""Volume of a liquid bridge between flats from the radius of one of its contact circles."""

from __future__ import annotations

import math
from typing import Literal

from ..errors import InfeasibleError
from ..numerics.roots import bracketed_root
from .arc import flat as arc_flat

__all__ = ["volume_of_radius"]

# By which a volume is changed in search of a bracket: the arc is a close guess. 1.1 to 4 take the
# same number of bridges, 37 to 41 for three radii.
_FACTOR = 1.3


def volume_of_radius(
    radius: float,
    gap: float,
    angle_lower: float,
    angle_upper: float,
    *,
    body: Literal["lower", "upper"] = "lower",
    profile: Literal["exact", "arc"] = "exact",
) -> float:
    """Volume [m3] of the bridge between flats with a contact circle of given radius at a gap.

    Parameters
    ----------
    radius, gap : float
        Radius of the contact circle and distance of the flats [m], positive.
    angle_lower, angle_upper : float
        Contact angles [rad], 0 to pi.
    body : {"lower", "upper"}
        Body on which the circle is.
    profile : {"exact", "arc"}
        Exact bridge, or circular approximation.

    Raises
    ------
    InfeasibleError
        If no stable bridge (or no arc with an open neck) has that circle at that gap.

    Examples
    --------
    >>> round(volume_of_radius(1.0, 0.5, math.pi / 2, math.pi / 2) / math.pi, 12)
    0.5
    """
    arc = arc_flat.shape(angle_lower, angle_upper)
    lower = radius if body == "lower" else radius - gap * arc.upper_offset
    is_open = lower > 0.0 and arc_flat.neck(arc, gap, lower) > 0.0
    if profile == "arc":
        if not is_open:
            raise _none(radius, gap, body, "its neck would be closed")
        return float(arc_flat.volume(arc, gap, lower))
    guess = arc_flat.volume(arc, gap, lower) if is_open else math.pi * radius**2 * gap
    return _exact(radius, gap, (angle_lower, angle_upper), body, guess)


def _exact(
    radius: float, gap: float, angles: tuple[float, float], body: str, guess: float
) -> float:
    """Volume of the exact bridge; its contact circle grows with its volume."""
    from .exact.bridge import bridge
    from .exact.stability import stability_limit

    # The least volume that spans the gap: the limit is as its cube root.
    least = (gap / float(stability_limit(1.0, *angles).gap)) ** 3 * (1.0 + 1e-9)

    def excess(log_volume: float) -> float:
        found = bridge(gap, math.exp(log_volume), *angles)
        return float(found.radius_lower if body == "lower" else found.radius_upper) / radius - 1.0

    low = high = math.log(max(guess, least))
    floor, step = math.log(least), math.log(_FACTOR)
    while excess(low) > 0.0:
        if low == floor:
            raise _none(radius, gap, body, "no bridge so narrow is stable")
        low = max(low - step, floor)
    while excess(high) < 0.0:
        high += step
    return math.exp(bracketed_root(excess, low, high, 1e-15)) if high > low else math.exp(low)


def _none(radius: float, gap: float, body: str, why: str) -> InfeasibleError:
    return InfeasibleError(
        f"no liquid bridge has a contact circle of {radius:g} m on the {body} body at a gap of "
        f"{gap:g} m: {why}; give a larger radius or a smaller gap"
    )
