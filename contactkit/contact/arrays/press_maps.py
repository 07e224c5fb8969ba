"""Contact of many height maps, or of maps of another array library: `press_maps`."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from ...errors import ConvergenceError, DescriptionError, InfeasibleError
from ...scene.interface import Body
from ...scene.materials import Solid
from ...scene.window import Edges, Grid
from ..effects.elasticity import symbol_maker
from ..press import number_of, pixel_size_of
from ..solver.contact_solver import ContactSolver
from .namespace import Space, space_of
from .nested import nested_operators, solve_nested
from .problem import first_touch, pose_maps
from .result import MapsResult

if TYPE_CHECKING:
    from ..solver.convolution import SymbolMaker

__all__ = ["press_maps"]

RTOL, RTOL_SINGLE = 1e-8, 1e-4
MOST_ITERATIONS = 3000


class _Given(NamedTuple):
    """Checked input: heights (n, ny, nx), one of the loads (n, 1, 1), bound, leading axes."""

    heights: Any
    mean_pressure: Any
    rigid_approach: Any
    bound: Any
    leading: tuple[int, ...]


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

    `press` states the validity of a contact (slopes, strains, pixels across a spot); this does not.

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
    rtol = _tolerance(space, rtol)
    flat = Body(solid=_checked_solid(stack)).elastic_stack
    given = _checked(space, heights, mean_pressure, approach, hardness)
    size = pixel_size_of(pixel_size, "press_maps")
    pixel = size if isinstance(size, tuple) else (size, size)
    _, ny, nx = given.heights.shape
    along = periodic if isinstance(periodic, str) else None
    make = symbol_maker(flat, Grid((ny, nx), pixel, periodic is True, along))
    if space.xp is np:
        found = _by_contact_solver(given, pixel, make, periodic, rtol)
    else:
        found = _by_masks(space, given, pixel, make, periodic, rtol)
    _check_all(space, found, rtol)
    return found


def _by_masks(
    space: Space,
    given: _Given,
    pixel_size: tuple[float, float],
    make: SymbolMaker,
    periodic: Edges,
    rtol: float,
) -> MapsResult:
    """Solve all maps at once, on their device."""
    xp, h = space.xp, given.heights
    operators = nested_operators(space, make, h.shape[-2:], pixel_size, periodic)
    _refuse_closed_gap(xp, given, periodic, operators[0].uniform)
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
    given: _Given,
    pixel_size: tuple[float, float],
    make: SymbolMaker,
    periodic: Edges,
    rtol: float,
) -> MapsResult:
    """Solve maps of numpy one after the other; one plan and one set of transforms."""
    n, ny, nx = given.heights.shape
    solver = ContactSolver((ny, nx), pixel_size, make, periodic)
    _refuse_closed_gap(np, given, periodic, solver.uniform_compliance)
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
            bound=None if bound is None else np.broadcast_to(bound, (ny, nx)),
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


# What is given ----------------------------------------------------------------------------------


def _tolerance(space: Space, rtol: float | None) -> float:
    if rtol is None:
        return RTOL if space.epsilon < 1e-10 else RTOL_SINGLE
    least = 10.0 * space.epsilon
    if not (math.isfinite(rtol) and rtol >= least):
        raise DescriptionError(
            "press_maps(rtol)", rtol, f"be finite, and at least {least:.2g} in this precision"
        )
    return float(rtol)


def _checked_solid(stack: Any) -> Solid:
    if not isinstance(stack, Solid):
        raise DescriptionError(
            "press_maps(stack)", stack, "be a Stack or a Material: the solid of the flat"
        )
    return stack


def _checked(
    space: Space, heights: Any, mean_pressure: Any, approach: Any, hardness: Any
) -> _Given:
    xp, h = space.xp, _as_array(space, heights, "heights", "m")
    if h.ndim < 2 or min(h.shape[-2:]) < 2 or 0 in h.shape:
        raise DescriptionError(
            "press_maps(heights)", tuple(h.shape), "be maps of at least 2 x 2 pixels"
        )
    if isinstance(heights, np.ma.MaskedArray):
        raise DescriptionError(
            "press_maps(heights)", "a masked array", "have no mask; holes: a hardness of 0 there"
        )
    if not bool(xp.all(xp.isfinite(h))):
        raise DescriptionError("press_maps(heights)", "nan or inf", "be finite", unit="m")
    if (mean_pressure is None) == (approach is None):
        raise DescriptionError(
            "press_maps(mean_pressure, approach)",
            (mean_pressure, approach),
            "be given one without the other",
        )
    leading, maps = tuple(h.shape[:-2]), tuple(h.shape)
    h = xp.reshape(h, (-1, *maps[-2:]))
    bound = None if hardness is None else _bound(space, hardness, maps)
    if approach is not None:
        depth = _per_map(space, approach, leading, "approach", "m")
        return _Given(h, None, first_touch(space, h) + depth, bound, leading)
    load = _per_map(space, mean_pressure, leading, "mean_pressure", "Pa")
    _check_loads(space, load, bound)
    return _Given(h, load, None, bound, leading)


def _as_array(space: Space, values: Any, name: str, unit: str) -> Any:
    try:
        if isinstance(values, str):
            values = number_of(values, unit, name, "press_maps")
        return space.take(values)
    except (TypeError, ValueError) as error:
        if isinstance(error, DescriptionError):
            raise
        raise DescriptionError(
            f"press_maps({name})", type(values), "be a number or an array of them", unit=unit
        ) from None


def _per_map(space: Space, values: Any, leading: tuple[int, ...], name: str, unit: str) -> Any:
    """One number for each map, (n, 1, 1)."""
    xp, found = space.xp, _as_array(space, values, name, unit)
    if not bool(xp.all(xp.isfinite(found))):
        raise DescriptionError(f"press_maps({name})", "nan or inf", "be finite", unit=unit)
    try:
        found = xp.broadcast_to(found, leading)
    except (ValueError, RuntimeError):
        raise DescriptionError(
            f"press_maps({name})", tuple(found.shape), f"be a number, or an array {leading}"
        ) from None
    return xp.reshape(found, (-1, 1, 1))


def _bound(space: Space, hardness: Any, maps: tuple[int, ...]) -> Any:
    """Upper bound, (n or 1, ny or 1, nx or 1)."""
    xp, bound = space.xp, _as_array(space, hardness, "hardness", "Pa")
    if bound.ndim and tuple(bound.shape) not in (maps, maps[-2:]):
        raise DescriptionError(
            "press_maps(hardness)",
            tuple(bound.shape),
            f"be a number, or an array {maps[-2:]} or {maps}",
            unit="Pa",
        )
    if not bool(xp.all(bound >= 0.0)):
        raise DescriptionError("press_maps(hardness)", "a value", "be 0 or positive", unit="Pa")
    return xp.reshape(bound, (-1, *maps[-2:]) if bound.ndim else (1, 1, 1))


def _check_loads(space: Space, load: Any, bound: Any) -> None:
    xp = space.xp
    if bool(xp.any(load < 0.0)):
        raise DescriptionError(
            "press_maps(mean_pressure)", float(xp.min(load)), "be 0 or positive", unit="Pa"
        )
    if bound is None:
        return
    carried = xp.mean(bound, axis=(-2, -1), keepdims=True)
    missing = load - carried * (1.0 + max(1e-12, 10.0 * space.epsilon))
    if bool(xp.any(missing > 0.0)):
        raise InfeasibleError(
            f"a mean pressure of {float(xp.max(load)):.6g} Pa exceeds what the hardness can carry, "
            f"{float(xp.min(carried)):.6g} Pa over a whole map"
        )


def _refuse_closed_gap(xp: Any, given: _Given, periodic: Edges, uniform: float) -> None:
    """No load closes the whole gap of a periodic map whose mean displacement is zero."""
    if given.rigid_approach is None or given.bound is not None or periodic is not True or uniform:
        return
    mean = xp.mean(given.heights, axis=(-2, -1), keepdims=True)
    if bool(xp.any(given.rigid_approach + mean >= 0.0)):
        raise InfeasibleError(
            "an approach reaches the mean plane of its map, where the gap of a periodic map is "
            "closed under any load; prescribe the load instead"
        )
