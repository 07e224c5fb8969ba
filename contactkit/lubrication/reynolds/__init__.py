"""Reynolds' equation of a film on any face, in 2-D, with mass-conserving cavitation.

shapes           Planforms: discs, rings, rectangles, ellipses, sectors, polygons, their sums.
face             A face on a grid: cells of film, reservoirs, pockets, walls.
gaps             Gap maps: flat, tilted, domed, wavy, with recesses, measured.
film             A film and its states: forces, volumes, power.
solve            Pressure at an instant, steady sliding, a step in time.
motion           Films in time: a prescribed gap, a mass that is pulled.
discretisation   Finite volumes: conductances, transport by walls, volumes.
mesh             Unknowns and the sides of the cells.
complementarity  Full and torn cells: active set, Fischer-Burmeister.
linear_systems   Sparse linear systems by SuperLU, CHOLMOD or multigrid.

Examples
--------
>>> from contactkit.lubrication import reynolds
>>> face = reynolds.rasterise(reynolds.Ring(radius=3e-3, hole_radius=1e-3), 64)
>>> film = reynolds.Film(face=face, viscosity=0.1)
>>> pull = reynolds.solve_pressure(film, 1e-5, 1e-3).force
"""

from ..._lazy import lazy_names

_HOMES = {
    "Difference": "shapes",
    "Disc": "shapes",
    "Ellipse": "shapes",
    "Face": "face",
    "Film": "film",
    "FilmState": "film",
    "Hole": "face",
    "Intersection": "shapes",
    "Pocket": "face",
    "Polygon": "shapes",
    "PullState": "motion",
    "Recess": "gaps",
    "Rectangle": "shapes",
    "Ring": "shapes",
    "Sector": "shapes",
    "Union": "shapes",
    "Waviness": "gaps",
    "at_rest": "solve",
    "carried_rate": "solve",
    "equilateral_triangle": "shapes",
    "face_from_image": "face",
    "face_from_level": "face",
    "face_from_mask": "face",
    "follow_gap": "motion",
    "gap_map": "gaps",
    "pull_apart": "motion",
    "rasterise": "face",
    "solve_pressure": "solve",
    "steady_film": "solve",
    "step_film": "solve",
}

__all__ = sorted(_HOMES)

__getattr__ = lazy_names(__name__, _HOMES)


def __dir__() -> list[str]:
    return [*globals(), *_HOMES]
