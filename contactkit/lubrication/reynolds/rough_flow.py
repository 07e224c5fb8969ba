r"""Steady flow through rough gaps: flow factors of a patch, and leakage between two pressures.

.. math:: \langle \mathbf q \rangle = -\frac{\mathsf K}{12 \eta} \nabla \bar p, \qquad
          \varphi_x = \frac{K_{xx}}{\langle h \rangle^3}

from two cell problems on a periodic patch. Where the faces touch nothing flows; liquid that
contacts enclose carries nothing. Limits: 1/<(h0/h)^3> across ridges, <(h/h0)^3> along them.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from ...errors import DescriptionError
from ...validity import warn
from .face import SOLID, face_from_level
from .film import GridFilm
from .linear_systems import choose_solver, solve_sparse
from .solve import solve_pressure
from .validity import roughness_number

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from ...validity import ValidityNumber
    from .film import GridFilmState

    Array = NDArray[np.floating[Any]]

__all__ = ["FlowFactors", "Leakage", "flow_factors", "leakage", "patch_factors"]


class FlowFactors(NamedTuple):
    """Conductivity of a rough gap for flow in its mean direction."""

    conductivity: Array
    """Tensor K in the order x, y, shape (2, 2) [m3]."""
    mean_gap: float
    """Mean gap [m]."""
    contact_fraction: float
    """Fraction of the patch where nothing flows because the faces touch [-]."""
    rms_roughness: float = 0.0
    """Standard deviation of the gap of the patch [m]."""

    @property
    def validity(self) -> tuple[ValidityNumber, ...]:
        """Whether the gap is wide enough against its roughness."""
        return (roughness_number(self.mean_gap, self.rms_roughness),)

    @property
    def factors(self) -> tuple[float, float]:
        """Flow factors along x and y, K over the cube of the mean gap [-]; 0 without a gap."""
        cube = self.mean_gap**3 or 1.0
        return float(self.conductivity[0, 0]) / cube, float(self.conductivity[1, 1]) / cube


class Leakage(NamedTuple):
    """Steady flow between two reservoirs."""

    flow: float
    """Volume flow [m3/s]."""
    pressure: Array
    """Pressure [Pa]; 0 where nothing flows."""
    carries: NDArray[np.bool_]
    """Cells on a path from one reservoir to the other."""
    state: GridFilmState | None
    """The solved film; None if no path leads through."""

    @property
    def validity(self) -> tuple[ValidityNumber, ...]:
        """See `GridFilmState.validity`; nothing without a path."""
        return () if self.state is None else self.state.validity


def flow_factors(
    gap: ArrayLike,
    pixel_size: float | tuple[float, float] = 1.0,
    *,
    floor: float = 0.0,
    solver: str | None = None,
) -> FlowFactors:
    """Flow factors of a periodic patch of rough gap.

    Parameters
    ----------
    gap : array_like, shape (ny, nx)
        Gap of the patch, which repeats [m].
    pixel_size : float or tuple of float
        Size of a cell, or its height and width [m].
    floor : float
        Gaps up to this count as contact [m].
    solver : str, optional
        See `solve_pressure`.

    Raises
    ------
    DescriptionError
        If the gap is no map or has values that are not finite.

    Notes
    -----
    Second order in the cells; a wave wants 8 of them. Patir and Cheng's fit,
    1 - 0.9 exp(-0.56 h/sigma), is for Gaussian, isotropic roughness above half its rms.
    Cavities inside the roughness are outside its scope.

    Examples
    --------
    >>> ridges = 1.0 + 0.5 * np.cos(2.0 * np.pi * (np.arange(64) + 0.5) / 64)[None, :]
    >>> across, along = flow_factors(np.repeat(ridges, 4, axis=0)).factors
    >>> round(across, 4), round(along, 4)
    (0.433, 1.375)
    """
    found = patch_factors(gap, pixel_size, floor, solver)
    warn(found.validity)
    return found


def patch_factors(
    gap: ArrayLike, pixel_size: float | tuple[float, float], floor: float, solver: str | None
) -> FlowFactors:
    """See `flow_factors`, without a warning."""
    height, (dy, dx) = _patch(gap), _size(pixel_size)
    open_cells, rms = height > floor, float(height.std())
    if not open_cells.any():
        return FlowFactors(np.zeros((2, 2)), float(height.clip(0.0).mean()), 1.0, rms)
    number = np.where(open_cells, np.cumsum(open_cells).reshape(height.shape) - 1, -1)
    sides = [_periodic_sides(height, number, axis, (dy, dx)) for axis in (1, 0)]
    pressures = _cell_problems(sides, int(open_cells.sum()), solver)
    tensor = np.empty((2, 2))
    for column, p in enumerate(pressures.T):
        for row, (low, high, g, step) in enumerate(sides):
            drop = p[high] - p[low] + (step if row == column else 0.0)
            tensor[row, column] = float(g @ drop) * step / (height.size * dx * dy)
    mean = float(np.where(open_cells, height, 0.0).mean())
    return FlowFactors(tensor, mean, 1.0 - float(open_cells.mean()), rms)


def leakage(
    gap: ArrayLike,
    pixel_size: float | tuple[float, float] = 1.0,
    *,
    viscosity: float,
    pressure_drop: float,
    axis: int = 1,
    is_periodic: bool = True,
    floor: float = 0.0,
    solver: str | None = None,
) -> Leakage:
    """Steady flow through a rough gap from its first to its last row or column.

    Parameters
    ----------
    gap : array_like, shape (ny, nx)
        Gap [m].
    pixel_size : float or tuple of float
        Size of a cell, or its height and width [m].
    viscosity : float
        Dynamic viscosity [Pa.s].
    pressure_drop : float
        Pressure at the first edge over that at the last [Pa].
    axis : int
        1: along x; 0: along y.
    is_periodic : bool
        Whether the gap repeats sideways; else there are walls.
    floor : float
        Gaps up to this count as contact [m].
    solver : str, optional
        See `solve_pressure`.

    Raises
    ------
    DescriptionError
        If the gap is no map, or the axis is neither 0 nor 1.

    Examples
    --------
    >>> found = leakage(np.ones((4, 8)), 50.0, viscosity=1.0 / 12.0, pressure_drop=1.0)
    >>> round(found.flow, 12)  # h^3/(12 eta) times width over length
    0.5
    """
    height, size = _patch(gap), _size(pixel_size)
    if axis not in (0, 1):
        raise DescriptionError("leakage.axis", axis, "be 0 or 1")
    carries = _percolating(height > floor, axis, is_periodic)
    if not carries.any():
        return Leakage(0.0, np.zeros(height.shape), carries, None)
    pad = [(1, 1) if k == axis else (0, 0) for k in (0, 1)]
    step = size[axis]
    level = np.pad(np.full(height.shape, 0.5 * step), pad, constant_values=-0.5 * step)
    pressure = np.zeros(level.shape)
    pressure[(slice(None), 0) if axis == 1 else (0, slice(None))] = pressure_drop
    face = face_from_level(
        level,
        size,
        pressure=pressure,
        periodic=(is_periodic and axis == 1, is_periodic and axis == 0),
        solid=np.pad(~carries, pad, constant_values=False),
    )
    wide = np.where(face.owner == SOLID, 0.0, np.pad(height, pad, mode="edge").clip(0.0))
    film = GridFilm(face=face, viscosity=viscosity)
    state = solve_pressure(film, np.where(face.inside, wide, 1.0), solver=solver)
    first = (0, slice(None)) if axis == 0 else (slice(None), 0)
    index = np.arange(level.size).reshape(level.shape)[first]
    rim = state.balance.mesh.rim  # type: ignore[union-attr]
    enters = np.isin(rim.beyond, index)
    p = state.pressure.ravel()
    driven = state.balance.outer * (p[rim.beyond] - p[rim.cell])  # type: ignore[union-attr]
    inner = tuple(slice(1, -1) if k == axis else slice(None) for k in (0, 1))
    shown = np.where(carries, state.pressure[inner], 0.0)
    return Leakage(float(driven[enters].sum()), shown, carries, state)


def _patch(gap: ArrayLike) -> Array:
    height = np.asarray(gap, dtype=float)
    if height.ndim != 2 or height.size == 0:
        raise DescriptionError("gap", height.shape, "be a map of two dimensions")
    if not np.isfinite(height).all():
        raise DescriptionError("gap", "nan or inf", "be finite", unit="m")
    return height


def _size(pixel_size: float | tuple[float, float]) -> tuple[float, float]:
    pair = (pixel_size, pixel_size) if isinstance(pixel_size, int | float) else pixel_size
    if len(pair) != 2 or not all(0.0 < d < np.inf for d in pair):
        raise DescriptionError("pixel_size", pixel_size, "be positive and finite", unit="m")
    return float(pair[0]), float(pair[1])


def _periodic_sides(
    height: Array, number: NDArray[np.int64], axis: int, size: tuple[float, float]
) -> tuple[NDArray[np.int64], NDArray[np.int64], Array, float]:
    """Open sides across an axis of a patch that repeats: unknowns, conductance, step."""
    after, cube = np.roll(number, -1, axis), height.clip(0.0) ** 3
    both = (number >= 0) & (after >= 0)
    a, b = cube[both], np.roll(cube, -1, axis)[both]
    g = 2.0 * a * b / (a + b) * size[1 - axis] / size[axis]
    return number[both], after[both], g, size[axis]


def _cell_problems(sides: list[Any], count: int, solver: str | None) -> Array:
    """Pressures of a patch under a unit mean gradient along x and along y, shape (n, 2)."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    low, high, g = (np.concatenate([s[k] for s in sides]) for k in range(3))
    distinct = low != high  # a patch of one cell is its own neighbour
    i, j, v = low[distinct], high[distinct], g[distinct]
    matrix = coo_array(
        (
            np.concatenate([v, v, -v, -v]),
            (np.concatenate([i, j, i, j]), np.concatenate([i, j, j, i])),
        ),
        shape=(count, count),
    ).tocsr()
    right = np.zeros((count, 2))
    for column, (first, second, conductance, step) in enumerate(sides):
        flow = conductance * step
        right[:, column] += np.bincount(first, weights=flow, minlength=count)
        right[:, column] -= np.bincount(second, weights=flow, minlength=count)
    # A pressure is known up to a constant in each connected part: its first cell is set to 0.
    _, part = connected_components(matrix, directed=False)
    free = np.ones(count, bool)
    free[np.unique(part, return_index=True)[1]] = False
    rows = np.flatnonzero(free)
    found = np.zeros((count, 2))
    if rows.size:
        inner = matrix[rows][:, rows]
        name = choose_solver(solver, rows.size)
        found[rows] = solve_sparse(inner, right[rows], name, is_symmetric=True)
    return found


def _percolating(is_open: NDArray[np.bool_], axis: int, is_periodic: bool) -> NDArray[np.bool_]:
    """Open cells that are connected with both edges."""
    from scipy.ndimage import label

    regions, _ = label(is_open)
    if is_periodic:
        first, last = (regions[:, 0], regions[:, -1]) if axis == 0 else (regions[0], regions[-1])
        from scipy.sparse import coo_array
        from scipy.sparse.csgraph import connected_components

        both = (first > 0) & (last > 0)
        size = int(regions.max()) + 1
        joined = coo_array(
            (np.ones(int(both.sum())), (first[both], last[both])), shape=(size, size)
        )
        _, merged = connected_components(joined, directed=False)
        regions = np.where(is_open, merged[regions] + 1, 0)
    edges = (regions[0], regions[-1]) if axis == 0 else (regions[:, 0], regions[:, -1])
    through = np.intersect1d(edges[0], edges[1])
    return np.isin(regions, through[through > 0])
