"""Capillarity: Kelvin's equation, liquid bridges, menisci on rough surfaces.

kelvin            Kelvin's equation and capillary condensation.
vapour            Exchange of liquid between a meniscus and its vapour: time to dry up.
exact             Exact axisymmetric bridges (Delaunay surfaces), their stability limits.
arc               Bridges in the circular (toroidal) approximation.
wetting           Contact lines that move: dynamic angle, deposited film; weight of a bridge.
elastic_bridge    Bridge between a sphere and a flat that it draws in: closed forms, snap-in.
flats             Force law of the exact bridge between flats, tabulated.
contact_radius    Volume of a bridge between flats from its contact radius.
condensed         Capillary condensation on many spheres near a flat.
many_menisci      Division of a meniscus into many equal ones.
asperities        Menisci at the asperities of a rough surface: three statistical laws.
asperity_bridges  Exact bridges at asperities: force curve, average over the heights.
film_islands      Wetted islands of a rough contact under a thin film.
island_bridges    Equivalent spheres for the wetted islands, one bridge on each.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from .._lazy import lazy_names

if TYPE_CHECKING:
    from .arc.bridge import arc_bridge
    from .exact.bridge import bridge
    from .exact.stability import stability_limit

__all__ = ["arc_bridge", "bridge", "stability_limit"]

__getattr__ = lazy_names(
    __name__,
    {"arc_bridge": "arc.bridge", "bridge": "exact.bridge", "stability_limit": "exact.stability"},
)
