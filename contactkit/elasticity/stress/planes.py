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
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...errors import DescriptionError
from ..depths import Side, locate
from ..layer_stack import Layers, Stack, stack_of
from ..layered_fields import PlaneStates, plane_states
from .isolated import Grid, Mean, add_correction, grids_of
from .periodic import component, into_space, table_of, within
from .tractions import Tractions

__all__ = ["Plane", "planes"]

Array = NDArray[np.float64]
Loads = list[NDArray[np.complex128] | None]

CUTOFF = 40.0  # of alpha z: modes beyond carry (1 + 40) exp(-40) = 2e-16 of their load


class Plane(NamedTuple):
    """Fields on one plane: `stress` (6, ny, nx) [Pa], `displacement` (3, ny, nx) [m] or None."""

    depth: float
    side: Side
    layer: int
    stress: Array
    displacement: Array | None


def planes(
    load: Tractions,
    layers: Layers,
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
    load : Tractions
        Pressure and tangential tractions on the surface.
    layers : Layers
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

    >>> wave = Tractions((1.0, 1 / 8), np.cos(2 * np.pi * np.arange(8) / 8)[None, :])
    >>> plane = next(planes(wave, Layers([1e9], [0.3]), [1 / (2 * np.pi)]))
    >>> print(np.round(plane.stress[:, 0, 0], 6), round(-2 * np.exp(-1), 6))
    [ 0.       -0.220728 -0.735759  0.        0.        0.      ] -0.735759
    """
    maps, stack = load.checked(), stack_of(*layers)
    if mean == "free" and displacement:
        raise DescriptionError("planes.displacement", True, 'be False for mean="free"')
    locate(depths, sides, stack.h)
    grids = grids_of(load.shape, load.pixel_size, mean, padding)
    loads = grids.spectra(maps, workers)
    states = [
        plane_states(grid.modes.length, *layers, depths, sides, cutoff=CUTOFF) for grid in grids.all
    ]
    count = 9 if displacement else 6

    def plane(of_grids: tuple[PlaneStates, ...]) -> Plane:
        uniform = _mean_stress(of_grids[0], stack, mean)
        fields, *others = (
            _fields(state, grid, one, uniform, count, workers)
            for state, grid, one in zip(of_grids, grids.all, loads, strict=True)
        )
        for step, wide, narrow in zip(grids.steps, others[::2], others[1::2], strict=True):
            for k in range(count):
                add_correction(fields[k], wide[k], narrow[k], step)
        first, moved = of_grids[0], fields[6:] if displacement else None
        return Plane(first.depth, first.side, first.layer, fields[:6], moved)

    return (plane(of_grids) for of_grids in zip(*states, strict=True))


def _fields(
    states: PlaneStates,
    grid: Grid,
    loads: Loads,
    uniform: Array,
    count: int,
    workers: int | None,
) -> Array:
    reached = within(grid.modes, states.transverse.shape[1], grid.pixel_size)
    across = reached.rank.shape[1]
    near = [
        None if q is None else turn * q[reached.rows, :across]
        for turn, q in zip((1.0, -1j, -1j), loads, strict=True)
    ]
    tables = table_of(states, grid.modes.length, displacement=count > 6)
    fields = np.empty((count, *grid.window))
    for k in range(count):
        values = component(k, near, tables, reached)
        if k < 6:
            values[0, 0] = sum(
                u * q[0, 0] for u, q in zip(uniform[:, k], loads, strict=True) if q is not None
            )
        fields[k] = into_space(values, reached, grid.window, workers)
    return fields


def _mean_stress(states: PlaneStates, stack: Stack, mean: Mean) -> Array:
    """Stresses at wavenumber zero per unit of the three loads, shape (3, 6)."""
    nu = states.poisson_ratio
    ratio = nu / (1.0 - nu)
    lateral = -ratio
    if mean == "free":
        # All layers follow the long waves of the substrate; half of LL + TT remains.
        strain = states.shear_modulus * (1.0 - 2.0 * stack.nu[-1]) / stack.G[-1]
        lateral = -0.5 * strain * (1.0 + nu) / (1.0 - nu) - ratio
    uniform = np.zeros((3, 6))
    uniform[0, :3] = lateral, lateral, -1.0
    uniform[1, 4] = uniform[2, 5] = -1.0
    return uniform
