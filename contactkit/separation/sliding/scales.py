"""Reference scales of a sliding: drag of a Couette film over the wetted circle."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from ...scene.scales import Scale, Scales, scales_of
from .effects import CouetteForce

if TYPE_CHECKING:
    from .plan import SlidingPlan

__all__ = ["sliding_scales"]


def sliding_scales(plan: SlidingPlan) -> Scales:
    r"""Scales of a sliding, by unit; forces have one where the scene lists `CouetteForce`.

    Notes
    -----
    With n menisci, each of the wetted radius x and the film height s at the rim (the gap between
    flats), at the imposed speed v, or over the whole travel L in the imposed time:

    ===== ====== ==========================================
    unit  name   definition
    ===== ====== ==========================================
    m     x      wetted radius
    m2    A0     :math:`n \pi x^2`
    m/s   v      speed; L over the time
    s     x/v
    N     F0     :math:`n \pi x^2 \eta v/s`
    N.s   F0 x/v
    J     F0 x
    Pa    F0/A0  :math:`\eta v/s`
    ===== ====== ==========================================
    """
    film, loading, x = plan.film, plan.scene.loading, plan.wetted_radius
    area = film.menisci * math.pi * x * x
    speed = loading.speed or plan.end / (loading.time or math.inf)
    given = plan.prepared.liquid.given("viscosity") if plan.has(CouetteForce) else None
    stress = (given or 0.0) * speed / (film.height(loading.gap) or math.inf)
    return scales_of(
        {
            "m": Scale(x, "x", "wetted radius"),
            "m2": Scale(area, "A0", "wetted area, pi x^2"),
            "m/s": Scale(speed, "v", "sliding speed"),
            "s": Scale(x / speed, "x/v", "wetted radius over speed"),
            "N": Scale(stress * area, "F0", "pi x^2 eta v/s"),
            "N.s": Scale(stress * area * x / speed, "F0 x/v", "force times time"),
            "J": Scale(stress * area * x, "F0 x", "force times wetted radius"),
            "Pa": Scale(stress, "F0/A0", "shear stress eta v/s"),
        }
    )
