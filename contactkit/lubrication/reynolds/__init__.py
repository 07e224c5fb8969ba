"""Reynolds' equation of a film on any face, in 2-D, with mass-conserving cavitation.

face             A face on a grid: cells of film, reservoirs, pockets, walls.
gaps             Gap maps: flat, tilted, domed, wavy, with recesses, measured.
film             A film and its states: forces, volumes, power.
validity         Ranges of validity of a solved film.
solve            Pressure at an instant, steady sliding, a step in time.
motion           Films in time, along a prescribed gap.
damping          Damping laws c(h) of full films: closed forms and tables, without numpy.
shape_factor     Damping laws of any face, rough ones too, by the solver.
rough_flow       Steady flow through rough gaps: flow factors, leakage.
discretisation   Finite volumes: conductances, transport by walls, volumes.
mesh             Unknowns and the sides of the cells.
complementarity  Full and cavitated cells: active set, Fischer-Burmeister.
linear_systems   Sparse linear systems by SuperLU, CHOLMOD or multigrid.

Examples
--------
>>> from contactkit.lubrication import reynolds
>>> from contactkit.scene.planforms import Ring
>>> face = reynolds.rasterise(Ring(radius=3e-3, hole_radius=1e-3), 64)
>>> film = reynolds.GridFilm(face=face, viscosity=0.1)
>>> pull = reynolds.solve_pressure(film, 1e-5, 1e-5).force
"""

from ..._lazy import lazy_names

_HOMES = {
    "DampingLaw": "damping",
    "DomeDamping": "damping",
    "Face": "face",
    "GridFilm": "film",
    "GridFilmState": "film",
    "FlowFactors": "rough_flow",
    "Hole": "face",
    "HoleState": "film",
    "Leakage": "rough_flow",
    "Pocket": "face",
    "PowerDamping": "damping",
    "TabulatedDamping": "damping",
    "Waviness": "gaps",
    "at_rest": "solve",
    "carried_rate": "solve",
    "disc_damping": "damping",
    "dome_damping": "damping",
    "ellipse_damping": "damping",
    "face_damping": "shape_factor",
    "face_from_image": "face",
    "face_from_level": "face",
    "face_from_mask": "face",
    "flow_factors": "rough_flow",
    "follow_gap": "motion",
    "gap_map": "gaps",
    "leakage": "rough_flow",
    "rasterise": "face",
    "recess_damping": "damping",
    "rectangle_damping": "damping",
    "ring_damping": "damping",
    "rough_damping": "shape_factor",
    "solve_pressure": "solve",
    "steady_film": "solve",
    "step_film": "solve",
    "tabulate_damping": "shape_factor",
    "triangle_damping": "damping",
}

__all__ = sorted(_HOMES)

__getattr__ = lazy_names(__name__, _HOMES)


def __dir__() -> list[str]:
    return [*globals(), *_HOMES]
