"""What a contact plan prepares once: heights, compliance and solver of an interface."""

from __future__ import annotations

import threading
import time
from typing import TYPE_CHECKING

import numpy as np

from ..numerics.fft import fast_transforms_installed
from ..scene.scenes import ContactScene
from ..scene.window import Grid
from .effects.base import Compliance
from .grid import combined_heights
from .solver.contact_solver import ContactSolver
from .solver.convolution import Convolution, SymbolMaker, symbol_of

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Map = NDArray[np.float64]

__all__ = ["Preparation", "PreparedInterface", "interface_key"]


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
    solver : ContactSolver
        For the compliance of both bodies together.
    seconds : float
        What the preparation took [s].
    """

    def __init__(self, scene: ContactScene, grid: Grid, threads: int) -> None:
        begun = time.perf_counter()
        self.grid, self._threads = grid, threads
        self.heights = combined_heights(scene, grid)
        self.heights.flags.writeable = False
        elastic = scene.effect(Compliance)  # type: ignore[type-abstract]
        assert elastic is not None  # plan_contact has checked the effects
        self.compliances = elastic.prepare(scene, grid)
        self.solver = ContactSolver(
            grid.shape, grid.pixel_size, _sum(self.compliances), grid.periodic, threads=threads
        )
        self._bodies: tuple[Convolution, ...] | None = None
        self._lock = threading.Lock()
        self.seconds = time.perf_counter() - begun

    @property
    def first_touch(self) -> float:
        """Rigid-body approach [m] at which the undeformed bodies touch."""
        return -float(self.heights.max())

    @property
    def nbytes(self) -> int:
        """Memory held [bytes]."""
        bodies = sum(one.nbytes for one in self._bodies or ())
        return int(self.heights.nbytes + self.solver.nbytes + bodies)

    def displacements(self, pressure: Map, total: Map) -> tuple[Map, ...]:
        """Displacement [m] of the surface of each deforming body; `total` is their sum."""
        if len(self.compliances) == 1:
            return (total,)
        with self._lock:
            if self._bodies is None:
                self._bodies = tuple(self._operator(make) for make in self.compliances)
            return tuple(body(pressure) for body in self._bodies)

    def _operator(self, make_symbol: SymbolMaker) -> Convolution:
        shape, periodic = self.grid.shape, self.grid.periodic
        symbol = symbol_of(make_symbol, shape, self.grid.pixel_size, periodic)
        return Convolution(shape, symbol, periodic, self._threads, fast_transforms_installed())


def _sum(makers: tuple[SymbolMaker, ...]) -> SymbolMaker:
    """Compliances of bodies in contact add up."""
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
    elastic = scene.effect(Compliance)  # type: ignore[type-abstract]
    return (scene.interface.lower, scene.interface.upper, elastic, grid, threads)


class Preparation:
    """The prepared interface of a plan, made when it is first needed and kept.

    Plans of one interface share it: those of a load curve prepare nothing twice.
    """

    def __init__(self) -> None:
        self._key: tuple[object, ...] = ()
        self._made: PreparedInterface | None = None

    def interface(self, scene: ContactScene, grid: Grid, threads: int) -> PreparedInterface:
        """Return what was prepared for the same interface, grid and compliance, or prepare it."""
        key = interface_key(scene, grid, threads)
        if self._made is None or self._key != key:
            self._made = None  # so that two of them are never in memory
            self._made, self._key = PreparedInterface(scene, grid, threads), key
        return self._made
