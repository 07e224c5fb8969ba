"""Faces for the stop of a drive, and for the site of a tip."""

from __future__ import annotations

import math

from contactkit.analyses.load_displacement.curve import LoadDisplacementCurve, Unloading


def rough(most=1e-6, limit=0.25, count=5):
    """Made-up elastic-plastic faces; elastic up to a fraction of the tables."""
    depths = [most * 2.0 ** (-i / 2.0) for i in range(16, -1, -1)]
    ends = [most * (limit + (1.0 - limit) * (k + 1) / count) for k in range(count)]
    fractions = (0.1, 0.3, 0.6, 1.0)
    ways = [
        Unloading(
            d, 0.4 * (d - limit * most), fractions, tuple(s**1.7 for s in fractions), fractions, 0.0
        )
        for d in ends
    ]
    return LoadDisplacementCurve(
        approach=depths,
        force=[3e11 * d**1.4 for d in depths],
        contact_area=depths,
        plastic_area=[0.0] * len(depths),
        unloading=tuple(ways),
        nominal_area=1e-5,
        elastic_limit=limit * most,
    )


def ball(most=4e-9):
    """A ball of aluminium on its like that yields early."""
    k = 4.0 / 3.0 * 39.3e9 * math.sqrt(1e-7)
    depths = [most * 2.0 ** (-i / 2.0) for i in range(16, -1, -1)]
    fractions = (0.1, 0.3, 0.6, 1.0)
    ways = [
        Unloading(d, 0.2 * d, fractions, tuple(s**1.5 for s in fractions), fractions, 0.0)
        for d in depths[4:]
    ]
    return LoadDisplacementCurve(
        approach=depths,
        force=[k * d**1.5 for d in depths],
        contact_area=[math.pi * 1e-7 * d for d in depths],
        plastic_area=[0.0] * len(depths),
        unloading=tuple(ways),
        nominal_area=1e-13,
        elastic_limit=depths[3],
    )
