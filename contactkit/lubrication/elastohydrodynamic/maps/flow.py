r"""Flow of a film on a grid: out of its cells by pressures, and its slopes by pressures and gaps.

Finite volumes of :mod:`...reynolds.discretisation`: through the side between two cells flows
:math:`g\,\bar k\,(p_i - p_j)` with the harmonic mean of :math:`k = h^3/(12 \eta)`, to the rim
:math:`g\,k\,(p - p_r)`. Sides are arrays on the window of the film, cells one after the other in
memory: on 512 x 512 cells that takes no longer than the product of a sparse matrix, whose making
would take as long as ten of them.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np
from attrs import field, frozen
from numpy.typing import NDArray

from ...reynolds.discretisation import assembled, conductances
from ...reynolds.face import Face
from ...reynolds.mesh import Mesh

__all__ = ["Flow", "FlowSlopes", "Sides", "Window"]

Array = NDArray[np.float64]

_CACHED = 2**13  # sides at a time: what belongs to them stays in the cache, in 0.7 of the time


class Window(NamedTuple):
    """Smallest map that holds all cells of film, and the place (flat) of each in it.

    Of a film that fills it the place is a slice of all, which is not gathered.
    """

    shape: tuple[int, int]
    place: NDArray[np.int64] | slice

    @property
    def size(self) -> int:
        """Number of cells, of film or not."""
        return self.shape[0] * self.shape[1]

    def spread(self, values: NDArray[Any], outside: float = 0.0) -> NDArray[Any]:
        """Values of the cells of film, one after the other in the window; may be the same array."""
        if isinstance(self.place, slice):
            return values
        found = np.full(self.size, outside, dtype=values.dtype)
        found[self.place] = values
        return found

    def gathered(self, values: Array) -> Array:
        """Values of the cells of film in the window; may be the same array."""
        return np.asarray(values[self.place])


def window_of(face: Face, mesh: Mesh) -> Window:
    """Rows and columns that hold film: no others have a pressure."""
    rows, columns = np.divmod(mesh.loaded, face.shape[1])
    rows, columns = rows - rows.min(), columns - columns.min()
    shape = int(rows.max()) + 1, int(columns.max()) + 1
    if rows.size == shape[0] * shape[1]:
        return Window(shape, slice(None))
    return Window(shape, np.asarray(rows * shape[1] + columns))


@frozen(eq=False)
class Sides:
    """Sides of the cells of a film without pockets, for flows of any gap.

    Parameters
    ----------
    face : Face
        With the pressures of its reservoirs.
    mesh : Mesh
        Its unknowns, one for each cell.
    """

    face: Face = field(repr=False)
    mesh: Mesh = field(repr=False)
    window: Window = field(init=False, repr=False)
    steps: tuple[int, int] = field(init=False)
    """From a cell of the window to the next along x and along y."""
    geometry: tuple[Array, Array] = field(init=False, repr=False)
    """Conductance over h^3/(12 eta) of the sides along x and y, 0 where there is none [-]."""
    rim: Array = field(init=False, repr=False)
    """Sums over the sides of a cell at the rim of 1, p_r and p_r^2 times geometry, (3, n)."""

    @window.default
    def _window(self) -> Window:
        return window_of(self.face, self.mesh)

    @steps.default
    def _steps(self) -> tuple[int, int]:
        return 1, self.window.shape[1]

    @geometry.default
    def _geometry(self) -> tuple[Array, Array]:
        sides, found = self.mesh.sides, []
        place = np.arange(self.window.size)[self.window.place]
        for axis, step in zip((1, 0), self.steps, strict=True):
            along, values = sides.axis == axis, np.zeros(self.window.size - step)
            values[place[self.mesh.number[sides.low[along]]]] = sides.geometry[along]
            found.append(values)
        return found[0], found[1]

    @rim.default
    def _rim(self) -> Array:
        mesh, beyond = self.mesh, self.face.pressure.ravel()[self.mesh.rim.beyond]
        cell, geometry = mesh.number[mesh.rim.cell], mesh.rim.geometry
        return np.array(
            [
                np.bincount(cell, geometry * power, minlength=mesh.size)
                for power in (1.0, beyond, beyond * beyond)
            ]
        )

    def flow(self, gap: Array, viscosity: float) -> Flow:
        """Flow of a gap (n,) [m]."""
        conductivity = gap * gap * gap / (12.0 * viscosity)
        k = self.window.spread(conductivity, 1.0)
        between = []
        for geometry, step in zip(self.geometry, self.steps, strict=True):
            low, high = k[:-step], k[step:]
            between.append(geometry * (2.0 * low * high / (low + high)))
        rim = conductivity * self.rim
        return Flow(self, (between[0], between[1]), rim)

    def matrix(self, gap: Array, viscosity: float) -> Any:
        """Flow out of the cells by their pressures, sparse [m3/(Pa.s)]."""
        k = np.zeros(self.face.level.size)
        k[self.mesh.loaded] = gap * gap * gap / (12.0 * viscosity)
        inner, outer = conductances(self.mesh, k)
        return assembled(self.mesh, [inner, inner, -inner, -inner, outer])


@frozen(eq=False)
class Flow:
    """Film of one gap.

    Parameters
    ----------
    sides : Sides
        Of the cells.
    between : tuple of ndarray
        Conductances along x and y, on the window [m3/(Pa.s)].
    rim : ndarray, shape (3, n)
        Sums of conductances at the rim times 1, p_r and p_r^2.
    """

    sides: Sides = field(repr=False)
    between: tuple[Array, Array] = field(repr=False)
    rim: Array = field(repr=False)

    def each(self) -> Iterator[tuple[Array, int]]:
        """Conductances along x and y with the step from a cell of the window to the next."""
        return zip(self.between, self.sides.steps, strict=True)

    def out(self, pressure: Array) -> Array:
        """Flow out of each cell [m3/s]."""
        window = self.sides.window
        p, found = window.spread(pressure), np.zeros(window.size)
        for conductance, step in self.each():
            through = conductance * (p[:-step] - p[step:])
            found[:-step] += through
            found[step:] -= through
        at_rim = self.rim[0] * pressure - self.rim[1]
        return np.asarray(window.gathered(found) + at_rim)

    def power(self, pressure: Array) -> tuple[float, float]:
        """Power that the film dissipates [W], and flow of liquid in through the rim [m3/s]."""
        p = self.sides.window.spread(pressure)
        dissipated = sum(
            float(conductance @ (p[:-step] - p[step:]) ** 2) for conductance, step in self.each()
        )
        one, reservoir, square = self.rim
        at_rim = (one * pressure - 2.0 * reservoir) * pressure + square
        return dissipated + float(at_rim.sum()), float((reservoir - one * pressure).sum())


class FlowSlopes:
    """Slopes of the flow out of the cells by pressures and by gaps."""

    def __init__(self, flow: Flow, gap: Array, pressure: Array) -> None:
        self.flow = flow
        window = flow.sides.window
        h, p = window.spread(gap, 1.0), window.spread(pressure)
        cube = h * h * h
        self.by_gaps: list[tuple[Array, Array]] = []
        for conductance, step in flow.each():
            # Of the harmonic mean of the conductivities: that of the smaller gap counts more.
            low, high = cube[:-step], cube[step:]
            flowing = 3.0 * conductance * (p[:-step] - p[step:]) / (low + high)
            self.by_gaps.append((flowing * high / h[:-step], flowing * low / h[step:]))
        self.spare = np.empty((2, _CACHED))
        self.at_rim = 3.0 * (flow.rim[0] * pressure - flow.rim[1]) / gap

    def __call__(self, pressure: Array, gap: Array) -> Array:
        """Change of the flow out of each cell by changes of pressures and gaps [m3/s]."""
        flow, window = self.flow, self.flow.sides.window
        p, h, found = window.spread(pressure), window.spread(gap), np.zeros(window.size)
        for (conductance, step), (low, high) in zip(flow.each(), self.by_gaps, strict=True):
            for here, there in _pieces(window.size, step):
                through, part = self.spare[0][: here.stop - here.start], self.spare[1]
                part = part[: len(through)]
                np.subtract(p[here], p[there], out=through)
                through *= conductance[here]
                np.multiply(low[here], h[here], out=part)
                through += part
                np.multiply(high[here], h[there], out=part)
                through += part
                found[here] += through
                found[there] -= through
        at_rim = flow.rim[0] * pressure + self.at_rim * gap
        return np.asarray(window.gathered(found) + at_rim)


def _pieces(size: int, step: int) -> Iterator[tuple[slice, slice]]:
    """Cells that have one a step further, some at a time, and those."""
    for start in range(0, size - step, _CACHED):
        stop = min(start + _CACHED, size - step)
        yield slice(start, stop), slice(start + step, stop + step)
