"""Preparation of a contact plan: heights, compliance and solver, each made once."""

from __future__ import annotations

import copy
import threading
from collections.abc import Callable
from typing import TYPE_CHECKING, Generic, TypeVar

import numpy as np

from ..numerics.fft import fast_transforms_installed
from ..scene.scenes import ContactScene
from ..scene.window import Grid
from .effects.base import Compliance
from .grid import combined_heights, holes_of
from .solver.contact_solver import ContactSolver
from .solver.convolution import Convolution, SymbolMaker, Transforms, symbol_of

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Map = NDArray[np.float64]

__all__ = ["Once", "PreparedInterface", "interface_key", "summed_compliance"]

T = TypeVar("T")


class Once(Generic[T]):
    """A value that is made when it is first called for, and then kept.

    Examples
    --------
    >>> numbers = iter(range(2))
    >>> first = Once(lambda: next(numbers))
    >>> first(), first()
    (0, 0)
    """

    def __init__(self, make: Callable[[], T]) -> None:
        self._make = make
        self._made: list[T] = []
        self._lock = threading.Lock()

    @property
    def is_made(self) -> bool:
        """Whether it has been called for."""
        return bool(self._made)

    def __call__(self) -> T:
        """Return the value; threads wait for the one that makes it."""
        with self._lock:
            if not self._made:
                self._made.append(self._make())
            return self._made[0]


class PreparedInterface:
    """Heights, compliance and solver of one interface on one grid, ready for any load.

    Parameters
    ----------
    scene : ContactScene
        Its interface and its compliance are taken.
    grid : Grid
        Pixels of the window.
    threads : int
        Threads of the solver.

    Attributes
    ----------
    heights : ndarray (ny, nx)
        Heights of both bodies together [m], read-only.
    holes : ndarray (ny, nx) of bool or None
        Pixels that carry no load; None if every pixel may.
    compliances : tuple of callable
        For each deforming body a function that makes its symbol.
    solver : ContactSolver
        For the compliance of both bodies together.
    self_influence : float
        Displacement of a pixel under unit pressure on itself [m/Pa], for the laws of effects.
    """

    def __init__(self, scene: ContactScene, grid: Grid, threads: int) -> None:
        self.grid, self._threads = grid, threads
        self.heights = combined_heights(scene, grid)
        self.holes = holes_of(scene)
        self._deform(scene.demand(Compliance).prepare(scene, grid))

    def _deform(self, compliances: tuple[SymbolMaker, ...]) -> None:
        """Make what deforms by functions that make the symbol of each body."""
        grid = self.grid
        self.compliances = compliances
        self.solver = ContactSolver(
            grid.shape,
            grid.pixel_size,
            summed_compliance(compliances),
            grid.edges,
            threads=self._threads,
        )
        self.self_influence = self.solver.self_influence
        # Made once called for; not by a `Once`, whose function would hold this object in a circle:
        # the maps of the solver would outlive the plan until the garbage collector runs.
        self._bodies = tuple[Convolution, ...]()
        self._lock = threading.Lock()

    @property
    def first_touch(self) -> float:
        """Rigid-body approach [m] at which the undeformed bodies touch."""
        return -float(self.heights.max())

    def with_heights(self, heights: Map) -> PreparedInterface:
        """Return the interface of the same bodies with another shape [m]; nothing is made again."""
        made = copy.copy(self)
        made.heights = heights
        made.heights.flags.writeable = False
        return made

    def with_compliances(self, compliances: tuple[SymbolMaker, ...]) -> PreparedInterface:
        """Return the interface of the same shape on bodies of another compliance."""
        made = copy.copy(self)
        made._deform(compliances)
        return made

    def with_self_influence(self, self_influence: float) -> PreparedInterface:
        """Return the interface with another self-influence [m/Pa] for the laws of effects.

        Laws that the grid softens must not change with the compliance of a time step.
        """
        made = copy.copy(self)
        made.self_influence = self_influence
        return made

    @property
    def memory(self) -> int:
        """Memory of a solve at its peak [bytes], with what is prepared.

        Grids of the solver; heights, if they are no map that the scene holds; their dimensionless
        copy, in whose place comes the displacement, pressure and gap; and the numbers of the pixels
        in contact, of an isolated one a patch as well: to 15 % up to a fifth of the map in contact.
        What effects add is left out.
        """
        maps = 5 if self.grid.periodic else 6
        return self.solver.nbytes + maps * self.heights.nbytes

    def open(self, heights: Map) -> Map:
        """Return heights with the holes of the interface masked, as the solver takes them."""
        return heights if self.holes is None else np.ma.MaskedArray(heights, self.holes)

    def displacements(self, pressure: Map, total: Map) -> tuple[Map, ...]:
        """Displacement [m] of the surface of each deforming body; `total` is their sum."""
        if len(self.compliances) == 1:
            return (total,)
        with self._lock:  # a convolution owns its maps
            self._bodies = self._bodies or tuple(self._operator(make) for make in self.compliances)
            return tuple(body(pressure) for body in self._bodies)

    def _operator(self, make_symbol: SymbolMaker) -> Convolution:
        shape, periodic = self.grid.shape, self.grid.edges
        symbol = symbol_of(make_symbol, shape, self.grid.pixel_size, periodic)
        transforms = Transforms(self._threads, fast_transforms_installed())
        return Convolution(shape, symbol, periodic, transforms)


def summed_compliance(makers: tuple[SymbolMaker, ...]) -> SymbolMaker:
    """Return what makes the symbol of bodies in contact: their compliances add up."""
    if len(makers) == 1:
        return makers[0]

    def total(shape: tuple[int, int], pixel_size: tuple[float, float]) -> Map:
        symbol = makers[0](shape, pixel_size).copy()
        for maker in makers[1:]:
            symbol += maker(shape, pixel_size)
        return symbol

    return total


def interface_key(scene: ContactScene, grid: Grid, threads: int) -> tuple[object, ...]:
    """Everything that a prepared interface depends on."""
    return (scene.interface.lower, scene.interface.upper, scene.effect(Compliance), grid, threads)
