"""Ranges of validity of a solved film: tension, slope of the gap, continuum, slenderness, grid.

Every state of a film has these numbers; one that leaves its range is a `ValidityWarning`.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np

from ...validity import ValidityNumber, warn
from .damping import film_tension, inertia, slenderness_of

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from .face import Face

    Array = NDArray[np.floating[Any]]

__all__ = ["SolvedFilm", "film_numbers", "roughness_number", "warn_new"]

_CONTINUUM = 2e-9  # [m], Chan and Horn 1985
# Stokes' flow between plates at an angle a needs a^2/15 less pressure than Reynolds' (Jeffery and
# Hamel, without inertia): 7e-4 at 0.1, 1 % at 0.4. Flow drawn round a step of the gap is not in it.
_STEEPEST = 0.1
_FEWEST_CELLS = 8.0  # a strip of 8 cells is off by 1.6 % of its force, a disc of 20 by 1 %
_THINNEST = 0.5  # gap over rms roughness


class SolvedFilm(Protocol):
    """State of a film as its numbers of validity see it; see `GridFilmState`."""

    @property
    def film(self) -> Any:
        """Face, liquid and pressures."""

    @property
    def gap(self) -> Array:
        """Gap [m], (ny, nx)."""

    @property
    def pressure(self) -> Array:
        """Pressure [Pa], (ny, nx)."""

    @property
    def pressure_gradient(self) -> tuple[Array, Array]:
        """Slope of the pressure along y and x [Pa/m]."""

    @property
    def lower_velocity(self) -> tuple[float, float]:
        """Velocity of the lower face along y and x [m/s]."""

    @property
    def upper_velocity(self) -> tuple[float, float]:
        """Velocity of the upper face along y and x [m/s]."""


def film_numbers(state: SolvedFilm) -> tuple[ValidityNumber, ...]:
    """Numbers of validity of a film at one instant.

    Slopes are those that two neighbouring sides of a cell have in common, so that the step of a
    recess, which the finite volumes take exactly, is none.
    """
    film, face = state.film, state.film.face
    inside, thickness = face.inside, state.gap[face.inside]
    tension = float((film.ambient - state.pressure[face.loaded]).max())
    found = [
        film_tension(tension, film.strength),
        ValidityNumber(
            name="slope of the gap",
            value=_slope(face, np.where(inside, state.gap, np.nan)),
            high=_STEEPEST,
            detail="Reynolds' equation wants a gap that changes slowly; give a flatter map, or "
            "smooth it",
            source="|grad h|, steps of recesses apart",
        ),
        ValidityNumber(
            name="thinnest gap over 2 nm",
            value=float(thickness.min()) / _CONTINUUM,
            low=1.0,
            detail="below about 2 nm a liquid is not a continuum; give a larger gap, or mark cells "
            "in contact as `solid`",
            source="Chan and Horn 1985",
        ),
        slenderness_of(0.5 * _extent(face), float(thickness.max())),
        inertia(film.density, _reynolds(state)),
    ]
    across = _cells_across(face)
    if across is not None:
        found.append(
            ValidityNumber(
                name="cells across the film",
                value=across,
                low=_FEWEST_CELLS,
                detail="the error of the force falls with its square; give more cells",
                source="twice the cells over the sides at the rim",
            )
        )
    return tuple(found)


def roughness_number(mean_gap: float, rms: float) -> ValidityNumber:
    """Whether a gap [m] is wide enough against its roughness [m] for flow factors of a patch."""
    return ValidityNumber(
        name="mean gap over rms roughness",
        value=mean_gap / rms if rms > 0.0 else None,
        low=_THINNEST,
        detail="below, contacts block most ways and one patch says little about another; take the "
        "whole map (`leakage`, `tabulate_damping`)"
        if rms > 0.0
        else "the gap is even",
        source="Patir and Cheng 1978; percolation below",
    )


def warn_new(found: Iterable[ValidityNumber], known: set[str], stacklevel: int = 3) -> None:
    """Warn of numbers that are out of range and were not before; `known` takes their names."""
    new = [one for one in found if one.is_valid is False and one.name not in known]
    known.update(one.name for one in new)
    warn(new, stacklevel=stacklevel + 1)


def _slope(face: Face, gap: Array) -> float:
    """Largest slope that two sides of a cell share, over both axes; nan outside the film."""
    largest = 0.0
    for axis in (0, 1):
        if face.shape[axis] < 3:
            continue
        steps = np.diff(gap, axis=axis) / face.pixel_size[axis]
        low, high = (steps[:-1], steps[1:]) if axis == 0 else (steps[:, :-1], steps[:, 1:])
        both = np.where(low * high > 0.0, np.minimum(abs(low), abs(high)), 0.0)
        largest = max(largest, float(both.max()))
    return largest


def _extent(face: Face) -> float:
    """Shorter side of the film's bounding box [m], of axes with more than one cell."""
    sides = [
        size * np.ptp(np.flatnonzero(face.inside.any(axis=1 - axis))) + size
        for axis, size in enumerate(face.pixel_size)
        if face.shape[axis] > 1
    ]
    return float(min(sides, default=max(face.pixel_size)))


def _cells_across(face: Face) -> float | None:
    """Cells of the film across it, twice their number over that of sides at a rim."""
    from .discretisation import mesh_of

    mesh = mesh_of(face, np.ones(face.shape))
    # Around a round hole the flow is radial in the discretisation.
    sides = int((face.circle.ravel()[mesh.rim.beyond] < 0).sum())
    return 2.0 * float(face.inside.sum()) / sides if sides else None


def _reynolds(state: SolvedFilm) -> float | None:
    """Reduced Reynolds number of the mean flow, rho u h^2/(eta L); None without a density."""
    film = state.film
    if film.density is None:
        return None
    slope_y, slope_x = state.pressure_gradient
    flow = state.gap**2 / (12.0 * film.viscosity)
    carried = [
        0.5 * abs(a + b) for a, b in zip(state.lower_velocity, state.upper_velocity, strict=True)
    ]
    speed = np.hypot(flow * abs(slope_x) + carried[0], flow * abs(slope_y) + carried[1])
    worst = float((speed * state.gap**2)[film.face.inside].max())
    return float(film.density * worst / (film.viscosity * _extent(film.face)))
