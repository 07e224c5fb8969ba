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
    "displacement": 2 * NM,
    "datum": 0.1 * NM,
    "thickness": 1 * NM,
    "thickness_below": 1 * NM,
    "young_modulus": 1e11,
    "young_modulus_below": 1e11,
    "young_modulus_substrate": 1e11,
    "hardness": 5e9,
    "hardness_below": 2.5e9,
    "hardness_substrate": 5e9,
    "mean_pressure": 1e6,
    "window": 20e-6,
    "reduced_modulus": 1e11 / 0.91,
    "rms": 1 * NM,
    "correlation_length_x": 5e-6,
    "correlation_length_y": 2e-6,
    "offset_x": 1e-6,
    "offset_y": 0.5e-6,
    "period": 20e-6,
    "meniscus_area": 1e-14,
    "meniscus_height": 1 * NM,
    "stress_xx": -2e8,
    "stress_yy": 1e8,
    "stress_zz": -5e8,
    "stress_xy": 3e7,
    "stress_xz": 2e8,
    "stress_yz": -4e7,
}


def ask(number, /, **changed):
    """Answer of a printed equation to one such film, with some of it changed."""
    names = ck.PUBLISHED[number].arguments
    return ck.published(number, **{n: _GIVEN[n] for n in names if n in _GIVEN} | changed)
