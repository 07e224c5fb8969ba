"""Damping laws of any face by the solver: flats by one solution, other gaps by a table of some.

A planform without a cavity costs nothing per step of an integrator: its law c(h) is made once.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from attrs import evolve

from ...errors import DescriptionError
from ...validity import warn
from .damping import PowerDamping, TabulatedDamping
from .face import Face
from .film import GridFilm, GridFilmState
from .rough_flow import patch_factors
from .solve import unchecked_pressure
from .validity import roughness_number

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    Array = NDArray[np.floating[Any]]

__all__ = [
    "UnitDamping",
    "face_damping",
    "rough_damping",
    "tabulate_damping",
    "unchecked_rough_damping",
    "unit_damping",
]

POINTS = 24
"""Gaps of a table, evenly spaced in their logarithms."""


class UnitDamping(NamedTuple):
    """Film of unit viscosity that opens at unit speed."""

    coefficient: float
    """Damping over viscosity [m]."""
    mean_inverse_gap: float
    """Mean of 3/h weighted by the dissipation, -d ln c/dh [1/m]."""
    onset: float
    """Largest pressure deficit over viscosity and speed [1/m]."""


def unit_damping(face: Face, gap: Array, solver: str | None = None) -> UnitDamping:
    """Damping of a film of one gap map, by one solution.

    Examples
    --------
    >>> from contactkit.lubrication.reynolds.face import rasterise
    >>> from contactkit.scene.planforms import Disc
    >>> face = rasterise(Disc(radius=1.0), 48)
    >>> abs(unit_damping(face, np.ones(face.shape)).coefficient / (1.5 * np.pi) - 1.0) < 3e-3
    True
    """
    state = _unit_state(face, gap, solver)
    onset = float(-state.pressure[face.loaded].min())
    return UnitDamping(state.force, _mean_inverse_gap(state), onset)


def face_damping(face: Face, *, copies: int = 1, solver: str | None = None) -> PowerDamping:
    """Damping law of a flat face, by one solution.

    Parameters
    ----------
    face : Face
        The face; its reservoirs must have one pressure.
    copies : int
        How often the grid stands for the face: 4 for a quarter.
    solver : str, optional
        See `solve_pressure`.

    Raises
    ------
    DescriptionError
        If the reservoirs have different pressures: the force is then not proportional to speed.
    InfeasibleError
        If some liquid has no way to a reservoir.

    Examples
    --------
    >>> from contactkit.lubrication.reynolds.face import rasterise
    >>> from contactkit.scene.planforms import Ring
    >>> law = face_damping(rasterise(Ring(radius=1.0, hole_radius=0.3), 64))
    >>> abs(law.shape_factor / 1.433008 - 1.0) < 3e-3
    True
    """
    found = unit_damping(face, np.ones(face.shape), solver)
    terms = ((copies * found.coefficient, found.onset, 0.0),)
    area = copies * float(face.loaded.sum()) * face.cell_area
    cells = "x".join(map(str, face.shape))
    return PowerDamping(area=area, terms=terms, source=f"Reynolds' equation, {cells} cells")


def tabulate_damping(
    face: Face,
    gaps: Sequence[float],
    shape: ArrayLike = 0.0,
    *,
    points: int = POINTS,
    copies: int = 1,
    solver: str | None = None,
) -> TabulatedDamping:
    """Damping law of a face whose gap has a shape: tilt, dome, waves, recesses, roughness.

    Parameters
    ----------
    face : Face
        The face; its reservoirs must have one pressure.
    gaps : sequence of float
        Smallest and largest gap [m], or all gaps of the table.
    shape : array_like, shape () or (ny, nx)
        What the map adds to the gap [m]; such as the rest gap of two rough faces.
    points : int
        Gaps of the table between two limits.
    copies : int
        How often the grid stands for the face: 4 for a quarter.
    solver : str, optional
        See `solve_pressure`.

    Returns
    -------
    TabulatedDamping
        Law over the gap without the shape. The slopes at the points are exact for the grid
        (a weighted mean of 3/h by the dissipation), so 24 points over two decades leave 1e-5 of
        interpolation.

    Raises
    ------
    DescriptionError
        If the gaps do not ascend, or leave no film; see also `face_damping`.

    Examples
    --------
    >>> from contactkit.lubrication.reynolds.face import rasterise
    >>> from contactkit.scene.planforms import Disc
    >>> face = rasterise(Disc(radius=1e-3), 24)
    >>> law = tabulate_damping(face, (1e-6, 1e-4), (face.x**2 + face.y**2) / 2.0, points=8)
    >>> 1.0 < law.exponent(1e-7) < law.exponent(1e-5) < law.exponent(1e-3) < 3.0
    True
    """
    added = np.broadcast_to(np.asarray(shape, dtype=float), face.shape)
    offset = float(added[face.owner > -2].min())
    nodes = _nodes(gaps, offset, points)
    coefficients, exponents, onsets = [], [], []
    for gap in nodes:
        found = unit_damping(face, added + gap, solver)
        coefficients.append(copies * found.coefficient)
        exponents.append((gap + offset) * found.mean_inverse_gap)
        onsets.append(found.onset)
    cells = "x".join(map(str, face.shape))
    return TabulatedDamping(
        area=copies * float(face.loaded.sum()) * face.cell_area,
        gaps=tuple(nodes),
        coefficients=tuple(coefficients),
        exponents=tuple(exponents),
        onsets=tuple(onsets),
        offset=offset,
        source=f"Reynolds' equation, {len(nodes)} gaps, {cells} cells",
    )


def rough_damping(
    face: Face,
    gaps: Sequence[float],
    roughness: ArrayLike,
    pixel_size: float | tuple[float, float],
    *,
    points: int = POINTS,
    copies: int = 1,
    solver: str | None = None,
) -> TabulatedDamping:
    """Damping law of a flat face with fine roughness, by flow factors of a patch.

    Parameters
    ----------
    face : Face
        The face; its reservoirs must have one pressure.
    gaps : sequence of float
        Smallest and largest gap between the mean planes [m], or all gaps of the table.
    roughness : array_like, shape (my, mx)
        Heights of a patch that repeats, of both faces towards each other [m].
    pixel_size : float or tuple of float
        Size of a cell of the patch, or its height and width [m].
    points, copies, solver
        See `tabulate_damping`.

    Returns
    -------
    TabulatedDamping
        Law over the gap between the mean planes.

    Raises
    ------
    DescriptionError
        If the faces touch everywhere, or no path leads through the contacts; see also
        `tabulate_damping`.

    Notes
    -----
    For roughness far finer than the planform, whose axes are those of the patch (the tensor's
    other entries are left out); what differs is of the order of the patch over the planform.
    Coarser roughness goes into the gap map of `tabulate_damping`.

    Examples
    --------
    >>> from contactkit.lubrication.reynolds.face import rasterise
    >>> from contactkit.scene.planforms import Disc
    >>> face = rasterise(Disc(radius=1e-3), 24)
    >>> ridges = 1e-6 * np.cos(2.0 * np.pi * np.arange(32) / 32) * np.ones((4, 1))
    >>> law = rough_damping(face, (2e-6, 1e-4), ridges, 1e-6, points=6)
    >>> law.coefficient(2e-6) > face_damping(face).coefficient(2e-6)
    True
    """
    heights = np.asarray(roughness, dtype=float)
    if heights.ndim != 2:
        raise DescriptionError("rough_damping.roughness", heights.shape, "be a map")
    found = unchecked_rough_damping(
        face, gaps, heights, pixel_size, points=points, copies=copies, solver=solver
    )
    warn([roughness_number(found.gaps[0], float(heights.std()))])
    return found


def unchecked_rough_damping(
    face: Face,
    gaps: Sequence[float],
    roughness: Array,
    pixel_size: float | tuple[float, float],
    *,
    points: int = POINTS,
    copies: int = 1,
    solver: str | None = None,
) -> TabulatedDamping:
    """See `rough_damping`, without a warning."""
    heights = roughness - roughness.mean()
    nodes = _nodes(gaps, 0.0, points)
    coefficients, onsets = [], []
    for gap in nodes:
        conductivity = patch_factors(gap - heights, pixel_size, 0.0, solver).conductivity
        along_x, along_y = float(conductivity[0, 0]), float(conductivity[1, 1])
        if not min(along_x, along_y) > 0.0:
            cure = "no path leads through the contacts: begin at a larger gap"
            raise DescriptionError("rough_damping.gaps", gap, "leave the film open", hint=cure)
        mean = math.sqrt(along_x * along_y)
        # Stretched so that the conductivity is the same along both axes; the area stays.
        stretched = _stretched(face, (along_x / along_y) ** 0.25)
        state = _unit_state(stretched, np.ones(face.shape), solver)
        coefficients.append(copies * state.force / mean)
        onsets.append(float(-state.pressure[face.loaded].min()) / mean)
    return TabulatedDamping(
        area=copies * float(face.loaded.sum()) * face.cell_area,
        gaps=tuple(nodes),
        coefficients=tuple(coefficients),
        exponents=_slopes(nodes, coefficients),
        onsets=tuple(onsets),
        source=f"Reynolds' equation with flow factors, {len(nodes)} gaps",
    )


def _unit_state(face: Face, gap: Array, solver: str | None) -> GridFilmState:
    """Film of unit viscosity whose gap grows at unit speed, from one pressure all around."""
    around = face.pressure[face.owner == -1]
    if around.size and around.min() < around.max():
        raise DescriptionError(
            "face.pressure",
            (float(around.min()), float(around.max())),
            "be the same in all reservoirs",
            unit="Pa",
            hint="with several, use `solve_pressure` at each speed",
        )
    level = float(around[0]) if around.size else 0.0
    film = GridFilm(face=face, viscosity=1.0, ambient=level)
    state = unchecked_pressure(film, gap, 1.0, solver=solver)
    return evolve(state, film=film, pressure=state.pressure - level) if level else state


def _mean_inverse_gap(state: GridFilmState) -> float:
    """Mean of 3/h weighted by the dissipation: -d ln c/dh, exact for the discrete film [1/m]."""
    balance: Any = state.balance
    mesh, p, h = balance.mesh, state.pressure.ravel(), state.gap.ravel()
    low, high = h[mesh.sides.low], h[mesh.sides.high]
    inside = balance.inner * (p[mesh.sides.high] - p[mesh.sides.low]) ** 2
    cubes = low**3 + high**3
    inverse = (high**3 / low + low**3 / high) / cubes
    rim = balance.outer * (p[mesh.rim.beyond] - p[mesh.rim.cell]) ** 2
    weighted = float(inside @ inverse) + float((rim / h[mesh.rim.cell]).sum())
    return 3.0 * weighted / (float(inside.sum()) + float(rim.sum()))


def _stretched(face: Face, ratio: float) -> Face:
    """A face drawn out along y and shortened along x, both by the same ratio."""
    if abs(ratio - 1.0) < 1e-9:
        return face
    dy, dx = face.pixel_size
    # Round holes become ellipses, around which the flow is no longer radial.
    plain = np.full(face.shape, -1)
    return evolve(face, pixel_size=(dy * ratio, dx / ratio), circles=(), circle=plain)


def _nodes(gaps: Sequence[float], offset: float, points: int) -> list[float]:
    given = [float(gap) for gap in gaps]
    if len(given) < 2 or not all(a < b for a, b in pairwise(given)):
        raise DescriptionError("gaps", tuple(given), "be two or more, and ascend", unit="m")
    if not given[0] + offset > 0.0:
        cure = f"the shape goes down to {offset:g} m"
        raise DescriptionError("gaps", given[0], "leave a film everywhere", unit="m", hint=cure)
    if len(given) > 2:
        return given
    if not isinstance(points, int) or points < 2:
        raise DescriptionError("points", points, "be a whole number of at least 2")
    clear = np.geomspace(given[0] + offset, given[1] + offset, points)
    return [given[0], *(float(h) - offset for h in clear[1:-1]), given[1]]


def _slopes(nodes: list[float], coefficients: list[float]) -> tuple[float, ...]:
    """Exponents at the points from the parabolas through three of them."""
    x, y = np.log(nodes), -np.log(coefficients)
    return tuple(np.gradient(y, x, edge_order=2 if len(nodes) > 2 else 1).tolist())
