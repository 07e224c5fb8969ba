"""One possible value of each argument of the printed equations, for a film of nanometres."""

from __future__ import annotations

import math

import contactkit as ck

__all__ = ["FILM", "NM", "ask"]

NM = 1e-9
FILM = {"surface_tension": 0.072, "angle_lower": math.pi / 3, "angle_upper": math.pi / 3}
_GIVEN = {
    **FILM,
    "radius": 100 * NM,
    "gap": 1 * NM,
    "angle": 1.0,
    "number": 4,
    "kelvin_radius": 1 * NM,
    "molar_volume": 18e-6,
    "temperature": 298.15,
    "relative_humidity": 0.5,
    "sphere_radius": 100 * NM,
    "immersion": 1 * NM,
    "filling_angle": 0.2,
    "volume": 927.3e-27,
    "height": 2 * NM,
    "film_height": 3 * NM,
    "gap_start": 1 * NM,
    "gap_end": 39 * NM,
    "separation_time": 1e-7,
    "viscosity": 0.89e-3,
    "speed": 0.02,
    "position": 5 * NM,
    "travel": 30 * NM,
    "force": 1e-9,
}


def ask(number, /, **changed):
    """Answer of a printed equation to one such film, with some of it changed."""
    names = ck.PUBLISHED[number].arguments
    return ck.published(number, **{n: _GIVEN[n] for n in names if n in _GIVEN} | changed)
