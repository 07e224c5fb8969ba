"""Stresses on planes in a layered solid under a map of pressure and of tangential tractions.

Conventions as in `layered`: z into the solid, tension positive, maps ordered [y, x], components
xx, yy, zz, xy, xz, yz.  A traction q_x > 0 pulls the surface of the solid towards +x, so that
sigma_xz = -q_x there: a slider moving in +x with friction mu has q_x = mu p, and the largest
tension is at the trailing edge, x < 0.

Planes are computed one at a time, so that the memory is that of one plane.  A map is either

periodic
    Its mean causes the uniform stresses of uniaxial strain,
    sigma_xx = sigma_yy = -nu/(1 - nu) p and sigma_zz = -p.
free
    No load acts outside of the map (isolated contact).  It is transformed in a larger zero-padded
    window, wavenumber zero takes the mean over all directions of the limit of long waves, and
    images nearer than `padding` maps are removed (`isolated`).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ...errors import DescriptionError
from ..depths import Side, default_depths, locate
from ..layer_stack import Stack, stack_of
from ..layered import compliance
from ..layered_fields import PlaneStates, plane_states
from .isolated import Grid, Step, added, single_load
from .periodic import component, grid_of_modes, into_space, spectrum, table_of, within

__all__ = ["Plane", "default_depths", "normal_displacement_of_traction", "planes"]

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
Mean = Literal["periodic", "free"]
Pair = tuple[float, float]

CUTOFF = 40.0  # of alpha z: modes beyond carry (1 + 40) exp(-40) = 2e-16 of their load


class Plane(NamedTuple):
    """Fields on one plane: `stress` (6, ny, nx) [Pa], `displacement` (3, ny, nx) [m] or None."""

    depth: float
    side: Side
    layer: int
    stress: Array
    displacement: Array | None


def planes(
    pressure: ArrayLike | None,
    traction_x: ArrayLike | None,
    traction_y: ArrayLike | None,
    pixel_size: Pair,
    young_modulus: ArrayLike,
    poisson_ratio: ArrayLike,
    thickness: ArrayLike,
    depths: Sequence[float],
    sides: Sequence[str] | str = "+",
    *,
    mean: Mean = "periodic",
    padding: float = 128.0,
    displacement: bool = False,
    workers: int | None = None,
) -> Iterator[Plane]:
    """Stresses on planes at depth, one plane at a time.

    Parameters
    ----------
    pressure, traction_x, traction_y : array_like, shape (ny, nx), or None
        Tractions on the surface [Pa]; None is skipped.
    pixel_size : (dy, dx)
        [m].
    young_modulus, poisson_ratio, thickness : array_like
        As in `layered.compliance`.
    depths, sides
        As in `depths.locate`, in order of layer and depth.
    mean : {"periodic", "free"}, optional
        Outside of the map: periodic images, or no load.
    padding : float, optional
        For "free": distance of the remaining images over the side of the map.  Up to 4 the map is
        padded to that size; beyond, coarse grids are used, at a cost that hardly grows.
    displacement : bool, optional
        Also return the displacements, without their mean; for "periodic" only, because those of an
        isolated load decay too slowly for any window.
    workers : int, optional
        Threads of the transforms; None: that of ``scipy.fft.set_workers``.

    Yields
    ------
    Plane
        In the order of `depths`.

    Raises
    ------
    DescriptionError
        For maps of different shapes or with non-finite values, no map, a padding below 1, and as
        `layered_fields.plane_states`.

    Notes
    -----
    Between its points the map is the trigonometric polynomial through them.  "periodic" is exact
    for it to about 1e-14 of the maximum traction.  "free" leaves the images at a distance of
    `padding` times the map, whose effect decreases with the cube of the distance or faster: use
    40 contact radii or more under stiff layers.

    Examples
    --------
    A wave of pressure, a sixth of its length deep:

    >>> wave = np.cos(2 * np.pi * np.arange(8) / 8)[None, :]
    >>> plane = next(planes(wave, None, None, (1.0, 1 / 8), [1e9], [0.3], [], [1 / (2 * np.pi)]))
    >>> print(np.round(plane.stress[:, 0, 0], 6), round(-2 * np.exp(-1), 6))
    [ 0.       -0.220728 -0.735759  0.        0.        0.      ] -0.735759
    """
    maps = _checked([pressure, traction_x, traction_y], pixel_size)
    stack = stack_of(young_modulus, poisson_ratio, thickness)
    if mean not in ("periodic", "free"):
        raise DescriptionError("planes.mean", mean, 'be "periodic" or "free"')
    if mean == "free" and (displacement or not 1.0 <= padding < np.inf):
        raise DescriptionError(
            "planes.padding",
            padding,
            "be 1 or more, and displacement False",
            hint='displacements are given for mean="periodic"',
        )
    locate(depths, sides, stack.h)
    grids, steps = _grids(maps, pixel_size, mean, padding, workers)
    every = [
        plane_states(
            grid.modes.length, young_modulus, poisson_ratio, thickness, depths, sides, cutoff=CUTOFF
        )
        for grid in grids
    ]
    count = 9 if displacement else 6
    return (
        _plane(states, grids, steps, _mean_stress(states[0], stack, mean), count, workers)
        for states in zip(*every, strict=True)
    )


def _grids(
    maps: list[Array | None], pixel_size: Pair, mean: Mean, padding: float, workers: int | None
) -> tuple[list[Grid], list[Step]]:
    """Grid of the map, then the wide and the narrow grid of each step."""
    window = next(m.shape for m in maps if m is not None)
    window = window[0], window[1]
    if mean == "free":
        first, steps = single_load(maps, window, pixel_size, padding, workers)
    else:
        loads = [None if m is None else spectrum(m, window, workers) for m in maps]
        first, steps = Grid(loads, grid_of_modes(window, pixel_size), pixel_size, window), []
    return [first, *(grid for step in steps for grid in step[:2])], steps


def _plane(
    states: tuple[PlaneStates, ...],
    grids: list[Grid],
    steps: list[Step],
    uniform: Array,
    count: int,
    workers: int | None,
) -> Plane:
    fields, *others = (
        _fields(s, grid, uniform, count, workers) for s, grid in zip(states, grids, strict=True)
    )
    for step, wide, narrow in zip(steps, others[::2], others[1::2], strict=True):
        for k in range(count):
            added(fields[k], wide[k], narrow[k], step)
    moved = fields[6:] if count > 6 else None
    return Plane(states[0].depth, states[0].side, states[0].layer, fields[:6], moved)


def _fields(
    states: PlaneStates, grid: Grid, uniform: Array, count: int, workers: int | None
) -> Array:
    reached = within(grid.modes, states.transverse.shape[1], grid.pixel_size)
    across = reached.rank.shape[1]
    near = [
        None if q is None else turn * q[reached.rows, :across]
        for turn, q in zip((1.0, -1j, -1j), grid.loads, strict=True)
    ]
    tables = table_of(states, grid.modes.length, displacement=count > 6)
    fields = np.empty((count, *grid.window))
    for k in range(count):
        values = component(k, near, tables, reached)
        if k < 6:
            values[0, 0] = sum(
                u * q[0, 0] for u, q in zip(uniform[:, k], grid.loads, strict=True) if q is not None
            )
        fields[k] = into_space(values, reached, grid.window, workers)
    return fields


def _mean_stress(states: PlaneStates, stack: Stack, mean: Mean) -> Array:
    """Stresses at wavenumber zero per unit of the three loads, shape (3, 6)."""
    nu = states.poisson_ratio
    share = nu / (1.0 - nu)
    lateral = -share
    if mean == "free":
        # All layers follow the long waves of the substrate; half of LL + TT remains.
        strain = states.shear_modulus * (1.0 - 2.0 * stack.nu[-1]) / stack.G[-1]
        lateral = -0.5 * strain * (1.0 + nu) / (1.0 - nu) - share
    uniform = np.zeros((3, 6))
    uniform[0, :3] = lateral, lateral, -1.0
    uniform[1, 4] = uniform[2, 5] = -1.0
    return uniform


def normal_displacement_of_traction(
    traction_x: ArrayLike | None,
    traction_y: ArrayLike | None,
    pixel_size: Pair,
    young_modulus: ArrayLike,
    poisson_ratio: ArrayLike,
    thickness: ArrayLike,
    *,
    mean: Mean = "periodic",
    padding: float = 128.0,
    workers: int | None = None,
) -> Array:
    """Normal displacement of the surface under tangential tractions.

    ``uz^ = -i F12 (xi qx^ + eta qy^)/alpha``: the coupling that Goodman's approximation neglects
    in the normal problem; zero for a homogeneous solid with nu = 1/2.

    Parameters
    ----------
    traction_x, traction_y : array_like, shape (ny, nx), or None
        On the solid [Pa].
    pixel_size, young_modulus, poisson_ratio, thickness, mean, padding, workers
        As in `planes`.

    Returns
    -------
    ndarray, shape (ny, nx)
        uz, positive into the solid, without its mean over the (padded) window [m].

    Raises
    ------
    DescriptionError
        As `planes`.

    Examples
    --------
    Dragged together, the surface bulges out; here it is pressed in a quarter of a wave later:

    >>> wave = np.cos(2 * np.pi * np.arange(8) / 8)[None, :]
    >>> uz = normal_displacement_of_traction(wave, None, (1.0, 0.125), [1.0], [0.0], [])
    >>> print(np.round(uz[0, [2, 6]] * 2 * np.pi, 6))
    [ 1. -1.]
    """
    maps = _checked([traction_x, traction_y], pixel_size)
    layers = young_modulus, poisson_ratio, thickness
    grids, steps = _grids(maps, pixel_size, mean, padding, workers)
    field, *others = (
        _pushed(grid, compliance(grid.modes.length, *layers).F12, workers) for grid in grids
    )
    for step, wide, narrow in zip(steps, others[::2], others[1::2], strict=True):
        added(field, wide, narrow, step)
    return field


def _pushed(grid: Grid, F12: Array, workers: int | None) -> Array:
    modes = grid.modes
    total = np.zeros(modes.rank.shape, dtype=np.complex128)
    for traction, direction in zip(grid.loads, (modes.x, modes.y), strict=True):
        if traction is not None:
            total += direction * traction
    weight = np.concatenate([[0.0], F12])[modes.rank]
    return into_space(-1j * (weight * total), modes, grid.window, workers)


def _checked(maps: Sequence[ArrayLike | None], pixel_size: Pair) -> list[Array | None]:
    checked = [None if m is None else np.asarray(m, dtype=np.float64) for m in maps]
    shapes = {m.shape for m in checked if m is not None}
    if len(shapes) != 1 or any(len(shape) != 2 or 0 in shape for shape in shapes):
        raise DescriptionError(
            "planes.maps", sorted(shapes), "be at least one map and share one shape (ny, nx)"
        )
    if not all(np.isfinite(m).all() for m in checked if m is not None):
        raise DescriptionError("planes.maps", "nan or inf", "be finite", unit="Pa")
    if not (len(pixel_size) == 2 and all(0.0 < d < np.inf for d in pixel_size)):
        raise DescriptionError(
            "planes.pixel_size", pixel_size, "be two positive lengths (dy, dx)", unit="m"
        )
    return checked
