"""Contact of many height maps, or of maps of another array library: `press_maps`."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np
from attrs import evolve

from ...errors import ConvergenceError
from ...scene.interface import Body
from ...scene.materials import Solid
from ...scene.window import Edges, Grid
from ...validity import warn
from ..effects.elasticity import symbol_maker
from ..solver.contact_solver import ContactSolver
from .given import (
    GivenMaps,
    checked_axis,
    checked_maps,
    checked_pixel,
    checked_solid,
    checked_tolerance,
    refuse_closed_gap,
)
from .namespace import Space, space_of
from .nested import nested_operators, solve_nested
from .problem import pose_maps
from .result import MapsResult
from .validity import check_maps

if TYPE_CHECKING:
    from ..solver.convolution import SymbolMaker

__all__ = ["press_maps"]

MOST_ITERATIONS = 3000  # a film of 1e6 times the modulus of its ground takes 1400


def press_maps(
    heights: Any,
    pixel_size: float | str | tuple[float | str, float | str],
    stack: Solid,
    *,
    mean_pressure: Any = None,
    approach: Any = None,
    hardness: Any = None,
    periodic: Edges = True,
    rtol: float | None = None,
) -> MapsResult:
    """Press rigid rough bodies on a flat solid: many maps at once, of any array library.

    The results are arrays of the library of the heights and on their device, and in their
    precision. Maps share the compliance and its transforms; each has a load of its own.

    Parameters
    ----------
    heights : array (..., ny, nx)
        Heights [m] of rough bodies that face the flat, peaks up: of NumPy, or of PyTorch, CuPy or
        another library of the Python array API (extra ``arrays``), in float64 or float32.
    pixel_size : float or (float, float)
        Size of a pixel [m]; a pair is (dy, dx).
    stack : Material, Stack or another Solid
        Solid of the flat: layers on a substrate, or a half-space.
    mean_pressure : float, or array (...)
        Mean pressure over each map [Pa].
    approach : float, or array (...)
        In its place the rigid-body approach of each map from first touch [m], as of `Approach`.
    hardness : float, or array (ny, nx) or (..., ny, nx), optional
        Upper bound of the pressure [Pa], 0 in holes; None: elastic.
    periodic : bool, "x" or "y"
        Whether the maps repeat beyond their edges, or along which axis alone; False: isolated.
    rtol : float, optional
        Largest `MapsResult.kkt` to accept; 1e-8, in single precision 1e-4.

    Returns
    -------
    MapsResult
        Pressures, displacements, approaches, residuals.

    Raises
    ------
    DescriptionError
        If a map has one row, a height is not finite, or a number is impossible.
    InfeasibleError
        If the hardness cannot carry a load, or no load brings a periodic map to its approach.
    ConvergenceError
        If a map does not reach the tolerance; its `result` has those that do.
    MissingExtraError
        If the heights are of another library and array-api-compat is not installed.

    Notes
    -----
    Arrays of numpy go through `ContactSolver`, one map after the other: it takes fewer transforms.
    The solver of the other libraries has the same problem, conditions and tolerance; on rough
    half-spaces it takes 20 to 50 applications of the operator and as many of its near inverse,
    under a film of 100 times the modulus of its ground up to 300, of 1e6 times up to 1400.

    Slope, peak pressure and jump at the edges of the worst map are its validity; `press` and scenes
    state more of a contact, such as the pixels across a spot.

    Examples
    --------
    Two waves under half the pressure that flattens them, and one of them under none:

    >>> import numpy as np
    >>> import contactkit as ck
    >>> wave = 1e-9 * np.cos(2.0 * np.pi * (np.arange(64) + 0.5) / 64) * np.ones((2, 8, 1))
    >>> solid = ck.Material(young_modulus=1e9, poisson_ratio=0.0)
    >>> found = ck.press_maps(wave, 1e-9, solid, mean_pressure=[np.pi / 128 * 1e9, 0.0])
    >>> found.contact_fraction, found.converged
    (array([0.5, 0. ]), array([ True,  True]))
    """
    space = space_of(heights)
    rtol = checked_tolerance(space, rtol)
    flat = Body(solid=checked_solid(stack)).elastic_stack
    given = checked_maps(space, heights, mean_pressure, approach, hardness)
    pixel = checked_pixel(pixel_size)
    _, ny, nx = given.heights.shape
    along = checked_axis(periodic)
    make = symbol_maker(flat, Grid((ny, nx), pixel, periodic is True, along))
    if space.xp is np:
        found = _by_contact_solver(given, pixel, make, periodic, rtol)
    else:
        found = _by_masks(space, given, pixel, make, periodic, rtol)
    _check_all(space, found, rtol)
    modulus = flat.materials[0].plane_strain_modulus
    pressure = space.xp.reshape(found.pressure, tuple(given.heights.shape))
    numbers = check_maps(space, given.heights, pressure, modulus, (pixel, periodic))
    warn(numbers)
    return evolve(found, validity=numbers)


def _by_masks(
    space: Space,
    given: GivenMaps,
    pixel_size: tuple[float, float],
    make: SymbolMaker,
    periodic: Edges,
    rtol: float,
) -> MapsResult:
    """Solve all maps at once, on their device."""
    xp, h = space.xp, given.heights
    operators = nested_operators(space, make, h.shape[-2:], pixel_size, periodic)
    refuse_closed_gap(space, given, periodic, operators[0].uniform)
    loads = (given.mean_pressure, given.rigid_approach, given.bound)
    problem = pose_maps(space, h, operators[0].self_influence, *loads)
    done = solve_nested(space, operators, problem, rtol, MOST_ITERATIONS)
    maps, leading = (*given.leading, *h.shape[-2:]), given.leading
    return MapsResult(
        heights=xp.reshape(h, maps),
        pressure=xp.reshape(done.pressure * problem.pressure, maps),
        displacement=xp.reshape((done.gap + problem.heights) * problem.length, maps),
        rigid_approach=xp.reshape(done.approach * problem.length - problem.datum, leading),
        kkt=xp.reshape(done.relative, leading),
        converged=xp.reshape(~done.running & (done.relative <= rtol), leading),
        n_applications=xp.reshape(xp.astype(done.count, xp.int64), leading),
    )


def _by_contact_solver(
    given: GivenMaps,
    pixel_size: tuple[float, float],
    make: SymbolMaker,
    periodic: Edges,
    rtol: float,
) -> MapsResult:
    """Solve maps of numpy one after the other; one plan and one set of transforms."""
    n, ny, nx = given.heights.shape
    solver = ContactSolver((ny, nx), pixel_size, make, periodic)
    pressure, displacement = np.zeros((n, ny, nx)), np.zeros((n, ny, nx))
    numbers, dtype = np.zeros((4, n)), given.heights.dtype

    def one_of(values: Any, i: int) -> Any:
        return None if values is None else values[i if len(values) > 1 else 0].astype(np.float64)

    for i in range(n):
        load, approach = (one_of(x, i) for x in (given.mean_pressure, given.rigid_approach))
        bound = one_of(given.bound, i)
        s = solver.solve(
            given.heights[i].astype(np.float64),
            mean_pressure=None if load is None else float(load.item()),
            rigid_approach=None if approach is None else float(approach.item()),
            bound=bound.item() if bound is not None and bound.size == 1 else bound,
            rtol=rtol,
        )
        pressure[i], displacement[i] = s.pressure, s.displacement
        numbers[:, i] = s.rigid_approach, s.kkt, s.converged, s.n_applications
    approaches, kkt, converged, applications = (one.reshape(given.leading) for one in numbers)
    maps = (*given.leading, ny, nx)
    return MapsResult(
        heights=given.heights.reshape(maps),
        pressure=pressure.reshape(maps).astype(dtype),
        displacement=displacement.reshape(maps).astype(dtype),
        rigid_approach=approaches.astype(dtype),
        kkt=kkt.astype(dtype),
        converged=converged.astype(bool),
        n_applications=applications.astype(np.int64),
    )


def _check_all(space: Space, found: MapsResult, rtol: float) -> None:
    xp = space.xp
    if bool(xp.all(found.converged)):
        return
    missed = int(xp.sum(xp.astype(~found.converged, xp.int64)))
    worst = float(xp.max(xp.where(found.converged, 0.0 * found.kkt, found.kkt)))
    raise ConvergenceError(
        f"{missed} of {math.prod(found.converged.shape)} maps are solved to {worst:.2g} of the "
        f"height scale at worst, not to {rtol:g}; ask for less, or give arrays of numpy: "
        "their solver knows stiff films better",
        found,
    )
