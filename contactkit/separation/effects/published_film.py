"""Film of the printed viscous forces: the contact circle or the height of the arc at the start.

The source has one film for both its forces: x_n0 between flats and s_0 under a sphere are those of
the arc of Eqs. (3.37) to (3.40), and its volume follows. From a volume they are found here again.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, TypeAlias

from ...errors import InfeasibleError
from .film_shape import FilmShape, between_flats, under_sphere
from .meniscus import MeniscusForce
from .meniscus_flat import printed_radius

if TYPE_CHECKING:
    from ...scene.scenes import SeparationScene, SlidingScene
    from .prepared import PreparedScene

    Prepared: TypeAlias = PreparedScene[SeparationScene] | PreparedScene[SlidingScene]

__all__ = ["published_film"]


def published_film(prepared: Prepared) -> FilmShape:
    """Film of the printed viscous forces, of the geometry that the printed meniscus force has.

    That is the film of Eqs. (3.19), (3.34) and (3.26), and of Eqs. (3.53) and (3.56) in sliding.

    Between flats it keeps the radius x_n0; under a sphere it begins at the height s_0 and keeps
    pi R (H^2 - D^2), Eqs. (3.23) and (3.24). A flooded film is full to the rim.

    Raises
    ------
    InfeasibleError
        If no arc spans the initial gap.
    """
    film, gap = prepared.film, prepared.scene.initial_gap
    if math.isinf(film.sphere_radius):
        return between_flats(film.menisci, math.inf, _circle(prepared, gap))
    if math.isinf(film.volume):
        return film
    height = _height(prepared, gap)
    volume = math.pi * film.sphere_radius * (height - gap) * (height + gap)
    return under_sphere(film.menisci, volume, film.rim, film.sphere_radius)


def _circle(prepared: Prepared, gap: float) -> float:
    """Radius x_n0 [m] between flats: that of Eq. (3.11) in the scene, or on the lower body."""
    effect = prepared.scene.effect(MeniscusForce)
    if effect is None and math.isinf(prepared.film.volume):
        return prepared.film.rim
    if effect is None:
        return printed_radius(prepared, "lower", "arc", gap).radius
    return printed_radius(prepared, effect.printed.pulled, effect.printed.radius, gap).radius


def _height(prepared: Prepared, gap: float) -> float:
    """Height s_0 of the arc [m] under a sphere, D + x^2/(2 R) by Eq. (3.37)."""
    from ...capillary.arc import sphere as arc_sphere

    bodies = (*prepared.angles, *prepared.curvatures)
    arc = arc_sphere.solve(gap, prepared.film.volume, *bodies, profile="parabola")
    height = float(arc.height)
    if math.isfinite(height):
        return height
    raise InfeasibleError(
        f"no arc of {prepared.film.volume:g} m3 spans the gap of {gap:g} m under the sphere: its "
        f"neck is closed there; give more liquid, a smaller gap, or another closure than "
        f'"as-published"'
    )
