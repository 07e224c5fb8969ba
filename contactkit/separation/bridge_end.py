"""Distance of a bridge to its end, a coordinate in which its shape is smooth."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from ..numerics.lines import errors_of_lines
from .effects.base import effects_of
from .plan import Plan

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

__all__ = ["distance_to_end", "errors_of_curves", "followed"]


def followed(plan: Plan, gap: float, volume_fraction: float = 1.0) -> tuple[float, float]:
    """Coordinates that lines follow beside the curves: distance to the end, and ln of the gap."""
    return distance_to_end(plan, gap, volume_fraction), math.log(gap)


def errors_of_curves(table: Floats, rtol: float) -> Floats:
    """Error that lines of each curve may have; the last two columns are those of `followed`."""
    errors = errors_of_lines(table, rtol) + 1e-300
    errors[-2:] = rtol
    return errors


def distance_to_end(plan: Plan, gap: float, volume_fraction: float = 1.0) -> float:
    r"""Root :math:`\sqrt{1 - h/h_e}` of the distance of a gap from the gap at which a film ends.

    Radii and pressure of a bridge end like it, at the fold of its solutions: lines that follow the
    root follow them, and none has to be computed. 0 where nothing of the shape can be asked for.

    Examples
    --------
    >>> import contactkit as ck
    >>> water = ck.Liquid(name="water", viscosity=1e-3, surface_tension=0.072)
    >>> film = ck.Meniscus(liquid=water, volume=1e-15)
    >>> scene = ck.SeparationScene(
    ...     interface=ck.Interface(lower=ck.Flat(), upper=ck.Sphere(radius=1e-3), meniscus=film),
    ...     loading=ck.ImposedSpeed(speed=1e-3, initial_gap=1e-9, final_gap=20e-6),
    ...     effects=(ck.MeniscusForce(), ck.Rupture()),
    ... )
    >>> plan = ck.plan(scene)
    >>> round(distance_to_end(plan, 0.75 * plan.film.end), 12)
    0.5
    """
    end = plan.film_with(volume_fraction).end
    if gap >= end or not math.isfinite(end) or not any(e.late for e in effects_of(plan.scene)):
        return 0.0
    return math.sqrt(1.0 - gap / end)
