"""Capillarity: Kelvin's equation, liquid bridges, films on rough surfaces.

asperities      Menisci at the asperities of a rough surface near a flat: three laws, not to be conf
condensed       Many bridges of one pressure on spheres near a flat: which of them stand, and what t
film_islands    Menisci of a thin liquid film on a rough contact: which gaps they bridge, how hard t
island_bridges  A bridge of its own on each island of a rough contact that holds liquid.
kelvin          Liquid in equilibrium with its vapour: Kelvin's equation, and the meniscus that cond
many_menisci    Many equal menisci in place of one: how many are stable, and where they would overla
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
