"""Stresses on planes in a layered solid under a map of pressure and of tangential tractions.

Conventions as in `layered`: z into the solid, tension positive, maps ordered [y, x], components
xx, yy, zz, xy, xz, yz.  A traction q_x > 0 pulls the surface of the solid towards +x, so that
sigma_xz = -q_x there: a slider moving in +x with friction mu has q_x = mu p, and the largest
tension is at the trailing edge, x < 0.

Planes are computed one at a time, so that the memory is that of one plane.  A map is either

periodic
    Its mean causes the uniform stresses of uniaxial strain,
    sigma_xx = sigma_yy = -nu/(1 - nu) p and sigma_zz = -p.
x, y
    It repeats along that axis alone, and no load acts beyond its ends across (`strips`).
free
    No load acts outside of the map (isolated contact).  It is transformed in a larger zero-padded
    window, wavenumber zero takes the mean over all directions of the limit of long waves, and
    images nearer than `padding` maps are removed (`isolated`).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...errors import DescriptionError
from ..depths import Side, locate
from ..layer_stack import Layers, Stack, stack_of
from ..layered_fields import PlaneStates, plane_states
from .isolated import Mean, WindowStep, add_correction, grids_of
from .periodic import (
    IMAGINARY,
    Grid,
    Modes,
    UnitFields,
    into_space,
    of_pressure,
    of_traction,
    on_modes,
    table_of,
    within,
)
from .reading import Reading, Shallow, ShortWaves
from .strips import LineStep
from .tractions import Tractions

__all__ = ["Plane", "StressField", "component", "planes"]

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
Pair = tuple[float, float]
Loads = list[Complex | None]

_AXES: tuple[Literal["x", "y"], ...] = ("x", "y")
_TURN = (1.0, -1j, -1j)  # of pressure and tractions: their symbols are real then
# Of alpha z: modes beyond carry (1 + 40) exp(-40) = 2e-16 of their load. A stress changes by 6e-14
# with 30 and by 1e-9 with 20, over the largest pressure; modes and time go with its square at a
# depth.
CUTOFF = 40.0
CUTOFF_READ = 24.0  # the same for a map that is read to 1e-5: 18 leave 5e-9, 12 leave 4e-6


class Plane(NamedTuple):
    """Fields on one plane: `stress` (6, ny, nx) [Pa], `displacement` (3, ny, nx) [m] or None.

    `dragged` (6, ny, nx) [Pa] is the stress of friction per unit of its coefficient, if wanted.
    """

    depth: float
    side: Side
    layer: int
    stress: Array
    displacement: Array | None = None
    dragged: Array | None = None


class StressField:
    """Stresses of one map of tractions on planes at any depth; the loads are transformed once.

    Parameters
    ----------
    load, layers, mean, padding, reading
        As in `planes`.
    friction : (float, float), optional
        Tractions along x and y over the pressure, in place of maps of them [-].
    drag : (float, float), optional
        Direction (x, y) in which friction drags the surface: planes then have the stress of a
        traction equal to the pressure in that direction as well. ``stress + mu*dragged`` is that
        of a coefficient of friction that is larger by mu.
    workers : int, optional
        Threads of the transforms; None: that of ``scipy.fft.set_workers``.

    Raises
    ------
    DescriptionError
        As `planes`.

    Examples
    --------
    >>> wave = np.cos(2 * np.pi * np.arange(8) / 8)[None, :]
    >>> field = StressField(
    ...     Tractions((1.0, 1 / 8), wave), Layers([1e9], [0.3]), drag=(1.0, 0.0))
    >>> plane = next(field.planes([0.0]))
    >>> plane.stress[2, 0, :2].round(3).tolist(), plane.dragged[4, 0, :2].round(3).tolist()
    ([-1.0, -0.707], [-1.0, -0.707])
    """

    def __init__(
        self,
        load: Tractions,
        layers: Layers,
        *,
        mean: Mean = "periodic",
        padding: float = 128.0,
        reading: Reading = "trigonometric",
        friction: Pair | None = None,
        drag: Pair | None = None,
        workers: int | None = None,
    ) -> None:
        maps = load.checked()
        self._layers, self._mean, self._workers = layers, mean, workers
        self._stack = stack_of(*layers)
        self._grids = grids_of(load.shape, load.pixel_size, mean, padding)
        self._short, kernel, self._cutoff = None, None, CUTOFF
        if reading != "trigonometric":
            self._short = ShortWaves(reading, self._grids.first.modes, load.pixel_size)
            kernel, self._cutoff = self._short.kernel, CUTOFF_READ
        loads = self._grids.spectra(maps, workers, kernel)
        if friction is not None:
            loads = [[one[0], *(_times(one[0], ratio) for ratio in friction)] for one in loads]
            maps = [maps[0], *_tractions(maps[0], friction)]
        cases, self._maps = [[one] for one in loads], [maps]
        if drag is not None:
            for one in cases:
                one.append([None, *(_times(one[0][0], along) for along in drag)])
            self._maps.append([None, *_tractions(maps[0], drag)])
        self._means = [np.array([_means(case) for case in one]) for one in cases]
        self._loads = [
            [[_times(q, turn) for q, turn in zip(case, _TURN, strict=True)] for case in one]
            for one in cases
        ]
        self._read = self._loads[0]
        if kernel is not None:
            self._read = [[_times(q, kernel) for q in case] for case in self._loads[0]]

    def planes(
        self,
        depths: Sequence[float],
        sides: Sequence[str] | str = "+",
        *,
        displacement: bool = False,
    ) -> Iterator[Plane]:
        """Stresses on planes, one at a time; arguments and errors as of the function `planes`."""
        if displacement and (self._mean != "periodic" or self._short is not None):
            raise DescriptionError(
                "planes.displacement", True, "be False for another mean or reading"
            )
        on_base = self._stack.base is not None
        places = locate(depths, sides, self._stack.h, on_base=on_base)
        lengths = [grid.modes.length for grid in self._grids.all]
        states = [self._states(length, depths, sides) for length in lengths]
        n_shallow = 0
        if self._short is not None:
            n_shallow = sum(place.depth < self._short.depth for place in places)
            faces = sides if isinstance(sides, str) else sides[:n_shallow]
            states.append(self._states(self._short.length, depths[:n_shallow], faces))
        return self._each(states, len(places), n_shallow, displacement)

    def _states(
        self, length: Array, depths: Sequence[float], sides: Sequence[str] | str
    ) -> Iterator[PlaneStates]:
        E, nu, h, base = self._layers
        return plane_states(length, E, nu, h, depths, sides, base=base, cutoff=self._cutoff)

    def _each(
        self, states: list[Iterator[PlaneStates]], n: int, n_shallow: int, displacement: bool
    ) -> Iterator[Plane]:
        """Planes, the first of which the short waves reach."""
        count, grids, n_grids = 9 if displacement else 6, self._grids, len(self._grids.all)
        steps: tuple[WindowStep | LineStep, ...] = grids.steps
        for i in range(n):
            of_grids = [next(one) for one in states[:n_grids]]
            short = next(states[-1]) if i < n_shallow else None
            uniform = _mean_stress(of_grids[0], self._stack, self._mean)
            fields = self._read_fields(of_grids[0], short, self._means[0] @ uniform, count)
            others = [
                self._fields(at, grid, loads, means @ uniform, count)
                for at, grid, loads, means in zip(
                    of_grids[1:], grids.all[1:], self._loads[1:], self._means[1:], strict=True
                )
            ]
            for step, wide, narrow in zip(steps, others[::2], others[1::2], strict=True):
                for field, far, near in zip(fields, wide, narrow, strict=True):
                    for k in range(count):
                        add_correction(field[k], far[k], near[k], step)
            at, first, dragged = of_grids[0], fields[0], fields[1:]
            if at.depth == 0.0 and short is not None:
                for field, maps in zip(fields, self._maps, strict=True):
                    _press(field, maps)
            moved = first[6:] if displacement else None
            yield Plane(
                at.depth, at.side, at.layer, first[:6], moved, dragged[0] if dragged else None
            )

    def _read_fields(
        self, states: PlaneStates, short: PlaneStates | None, means: Array, count: int
    ) -> list[Array]:
        """Fields on the grid of the map, as it is read."""
        grid = self._grids.first
        if self._short is None or short is None:
            return self._fields(states, grid, self._read, means, count)
        table = table_of(short, self._short.length, displacement=False)
        return self._fields(states, grid, self._loads[0], means, count, table)

    def _fields(
        self,
        states: PlaneStates,
        grid: Grid,
        cases: list[Loads],
        means: Array,
        count: int,
        short: UnitFields | None = None,
    ) -> list[Array]:
        """Fields (count, ny, nx) of each case of loads on one grid; `means` are of the stress."""
        reached = within(grid.modes, states.transverse.shape[1], grid.pixel_size)
        tables = table_of(states, grid.modes.length, displacement=count > 6)
        dragged = any(q is not None for loads in cases for q in loads[1:])
        unit = on_modes(tables, reached, tractions=dragged)
        shallow, found, across = None, [], reached.rank.shape[1]
        if self._short is not None and short is not None:
            shallow = self._short.on_plane(short, reached, tractions=dragged)
        for loads, mean in zip(cases, means, strict=True):
            is_whole = reached is grid.modes
            near = loads if is_whole else [_part(q, reached.rows, across) for q in loads]
            fields = np.empty((count, *grid.window))
            for k in range(count):
                values = component(k, near, unit, reached, shallow)
                if k < 6:
                    values[0, 0] = mean[k]
                fields[k] = into_space(values, reached, grid.window, self._workers)
            found.append(fields)
        return found


def _part(spectrum: Complex | None, rows: NDArray[np.intp], across: int) -> Complex | None:
    return None if spectrum is None else spectrum[rows, :across]


def planes(
    load: Tractions,
    layers: Layers,
    depths: Sequence[float],
    sides: Sequence[str] | str = "+",
    *,
    mean: Mean = "periodic",
    padding: float = 128.0,
    displacement: bool = False,
    reading: Reading = "trigonometric",
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
    mean : {"periodic", "free", "x", "y"}, optional
        Outside of the map: periodic images, no load, or periodic images along one axis alone.
    padding : float, optional
        But for "periodic": distance of the remaining images over the side of the map.  Up to 4 a
        map is padded to that size; beyond, coarse grids are used, at a cost that hardly grows.
    displacement : bool, optional
        Also return the displacements, without their mean; for "periodic" only, because those of an
        isolated load decay too slowly for any window.
    reading : {"trigonometric", "uniform", "spline"}, optional
        How the map is read between its pixels: see `reading`.

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
    "periodic" is exact to about 1e-14 of the maximum traction for the trigonometric polynomial
    through the points of the map, and to some 1e-4 for the other readings.  "free" leaves the
    images at a distance of `padding` times the map, whose effect decreases with the cube of the
    distance or faster: use 40 contact radii or more under stiff layers.

    Examples
    --------
    A wave of pressure, a sixth of its length deep:

    >>> wave = Tractions((1.0, 1 / 8), np.cos(2 * np.pi * np.arange(8) / 8)[None, :])
    >>> plane = next(planes(wave, Layers([1e9], [0.3]), [1 / (2 * np.pi)]))
    >>> print(np.round(plane.stress[:, 0, 0], 6), round(-2 * np.exp(-1), 6))
    [ 0.       -0.220728 -0.735759  0.        0.        0.      ] -0.735759
    """
    field = StressField(load, layers, mean=mean, padding=padding, reading=reading)
    return field.planes(depths, sides, displacement=displacement)


def _times(spectrum: Complex | None, factor: complex | Array) -> Complex | None:
    if spectrum is None or (isinstance(factor, complex | float) and factor == 0.0):
        return None
    return spectrum * factor


def _tractions(pressure: Array | None, ratio: Pair) -> list[Array | None]:
    """Tractions along x and y that are a fraction of the pressure."""
    return [None if pressure is None or one == 0.0 else pressure * one for one in ratio]


def _press(field: Array, maps: list[Array | None]) -> None:
    """Put in the stresses of the surface that are the tractions themselves."""
    for k, traction in zip((2, 4, 5), maps, strict=True):
        field[k] = 0.0 if traction is None else -traction


def _means(loads: Loads) -> list[float]:
    """Sums over the map of pressure and tractions."""
    return [0.0 if q is None else float(q[0, 0].real) for q in loads]


def component(
    k: int, loads: Loads, unit: UnitFields, modes: Modes, shallow: Shallow | None = None
) -> Complex:
    """Spectrum of component k due to a pressure and tractions along x and y, but for its mean.

    Parameters
    ----------
    k : int
        0 to 5 for the stresses, 6 to 8 for the displacements.
    loads : list of (ndarray or None)
        Spectra of the pressure and, times -i, of both tractions on the modes.
    unit : UnitFields
        Fields per unit load on the modes, by `on_modes`.
    modes : Modes
        Those of the loads.
    shallow : Shallow, optional
        Where short waves of the reading reach the plane.

    Returns
    -------
    ndarray
        In the shape of the loads.

    Examples
    --------
    On the surface sigma_zz is the pressure, with the other sign:

    >>> from .periodic import grid_of_modes
    >>> modes = grid_of_modes((1, 4), (1.0, 1.0))
    >>> states = next(plane_states(modes.length, [1.0], [0.3], [], [0.0]))
    >>> tables = table_of(states, modes.length, displacement=False)
    >>> unit = on_modes(tables, modes, tractions=False)
    >>> component(2, [np.ones((1, 3), complex), None, None], unit, modes).real.round(3).tolist()
    [[0.0, -1.0, -1.0]]
    """
    total = np.zeros(modes.rank.shape, dtype=np.complex128)
    pressure, *tractions = loads
    if pressure is not None:
        symbol = of_pressure(k, unit.pressure, modes)
        total += pressure * (symbol if shallow is None else shallow.pressure(k, symbol))
    for along, traction in zip(_AXES, tractions, strict=True):
        if traction is not None:
            symbol = of_traction(k, unit.traction, modes, along)
            total += traction * (symbol if shallow is None else shallow.traction(k, symbol, along))
    if k in IMAGINARY:
        total *= 1j
    return total


def _mean_stress(states: PlaneStates, stack: Stack, mean: Mean) -> Array:
    """Stresses at wavenumber zero per unit of the three loads, shape (3, 6)."""
    nu = states.poisson_ratio
    ratio = nu / (1.0 - nu)
    lateral = -ratio
    if mean == "free":
        # Half of LL + TT remains, of the strain that long waves have along the surface.
        lateral = states.shear_modulus * _long_wave_strain(stack) * (1.0 + nu) / (1.0 - nu) - ratio
    uniform = np.zeros((3, 6))
    uniform[0, :3] = lateral, lateral, -1.0
    if mean in ("x", "y"):  # LL across, and TT along
        extended = 2.0 * states.shear_modulus / (1.0 - nu) * _long_wave_strain(stack)
        across, along = extended - ratio, nu * extended - ratio
        uniform[0, :2] = (along, across) if mean == "x" else (across, along)
    uniform[1, 4] = uniform[2, 5] = -1.0
    return uniform


def _long_wave_strain(stack: Stack) -> float:
    """Strain along the wave vector per unit of the pressure of a long wave [1/Pa].

    All layers have that of the substrate; on a frictionless base their forces along it add up to
    zero, and on a bonded one there is none.
    """
    if stack.base is None:
        return float(-0.5 * (1.0 - 2.0 * stack.nu[-1]) / stack.G[-1])
    if stack.base == "bonded":
        return 0.0
    stiff = 2.0 * stack.G / (1.0 - stack.nu)
    return float(stack.h @ (stack.nu / (1.0 - stack.nu)) / (stack.h @ stiff))
