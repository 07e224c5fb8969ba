r"""Reynolds' equation of an axisymmetric squeeze film, by finite volumes, with cavitation.

.. math:: \frac{1}{r} \frac{d}{dr}\left(r H^3 \frac{dp}{dr}\right) = 12 \eta \dot h,
          \qquad p(r_n) = 0

Finite volumes of second order. With a floor on the pressure the solution is that of the
complementarity problem p >= -tension (Reynolds' cavitation condition), by projected relaxation of
the active set.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import solve_banded

__all__ = ["film_force"]

Height = Callable[[NDArray[np.float64]], NDArray[np.float64]]


def film_force(
    height: Height,
    radius: float,
    speed: float,
    viscosity: float,
    cells: int = 400,
    tension: float = np.inf,
) -> float:
    """Viscous force [N] of an opening axisymmetric film.

    Parameters
    ----------
    height : callable
        Height of the film [m] at radii [m].
    radius : float
        Radius of the film [m].
    speed : float
        Opening speed [m/s].
    viscosity : float
        Dynamic viscosity [Pa.s].
    cells : int
        Rings of the grid; the error is of second order.
    tension : float
        Tensile strength of the liquid: maximum pressure drop below ambient [Pa].

    Returns
    -------
    float
        Force [N]; positive resists.

    Examples
    --------
    >>> flat = lambda r: np.full_like(r, 2e-6)
    >>> round(film_force(flat, 3.175e-3, 1e-6, 0.1, cells=2000), 4)
    5.9859
    """
    edge = np.linspace(0.0, radius, cells + 1)
    width = radius / cells
    conductance = edge * height(edge) ** 3 / width
    conductance[-1] *= 2.0  # half a cell lies between the last centre and the rim
    area = np.diff(edge**2) / 2.0
    source = 12.0 * viscosity * speed * area
    floor = np.zeros(cells, dtype=bool)
    pressure = np.zeros(cells)
    for _ in range(cells + 1):
        pressure = _solve(conductance, source, floor, tension)
        # Active set: a cell leaves the bound if its pressure would rise, joins if it would fall.
        flow = _flow(conductance, pressure) - source
        new = (pressure < -tension * (1.0 + 1e-12)) | (floor & (flow <= 0.0))
        if np.array_equal(new, floor):
            break
        floor = new
    return float(-2.0 * np.pi * pressure @ area)


def _solve(
    conductance: NDArray[np.float64],
    source: NDArray[np.float64],
    floor: NDArray[np.bool_],
    tension: float,
) -> NDArray[np.float64]:
    cells = source.size
    matrix = np.zeros((3, cells))
    matrix[0, 1:] = conductance[1:-1]
    matrix[1] = -(conductance[:-1] + conductance[1:])
    matrix[2, :-1] = conductance[1:-1]
    right = source.copy()
    matrix[1, floor] = 1.0
    matrix[0, 1:][floor[:-1]] = 0.0
    matrix[2, :-1][floor[1:]] = 0.0
    right[floor] = -tension
    solution: NDArray[np.float64] = solve_banded((1, 1), matrix, right)
    return solution


def _flow(conductance: NDArray[np.float64], pressure: NDArray[np.float64]) -> NDArray[np.float64]:
    """Net flux into each cell."""
    outside = np.concatenate([pressure, [0.0]])
    between = conductance[1:] * np.diff(outside)
    inward = np.concatenate([[0.0], between])
    return np.asarray(np.diff(inward))
