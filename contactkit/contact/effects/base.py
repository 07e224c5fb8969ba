r"""The roles a piece of physics may play in a contact, read off the problem that is solved.

.. math:: \min_p \tfrac12 p^T C p - h^T p, \quad 0 \le p \le H, \quad \int p \, dA = W + F_m

An effect holds choices only. `prepare` does once whatever does not depend on the unknown
pressure; what it returns is used in the solve.
"""

from __future__ import annotations

import abc
from collections.abc import Callable
from typing import TYPE_CHECKING, NamedTuple

from attrs import frozen

from ...scene.effect import Effect

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from ...scene.scenes import ContactScene
    from ...scene.window import Grid

    Map = NDArray[np.float64]
    SymbolMaker = Callable[[tuple[int, int], tuple[float, float]], Map]

__all__ = [
    "Cap",
    "Compliance",
    "Contact",
    "ContactEffect",
    "DisplacementTerm",
    "LoadTerm",
    "Observer",
    "PressureCap",
]


class Contact(NamedTuple):
    """A solved contact, as the effects see it: maps (ny, nx) in SI units."""

    scene: ContactScene
    grid: Grid
    pressure: Map
    displacement: Map
    gap: Map
    threads: int = 1


class Cap(NamedTuple):
    """The largest pressure that the bodies bear [Pa].

    `least` and `most` bound its mean over the window; where they differ, `at` gives it for the
    displacements [m] of the deforming bodies, one map each; `has_jumps` if it jumps with them.
    `given` is one that does not depend on them and differs from pixel to pixel.
    """

    least: float
    most: float
    at: Callable[[tuple[Map, ...]], Map | float] | None = None
    is_local: bool = False
    given: Map | None = None
    has_jumps: bool = False


@frozen(kw_only=True)
class ContactEffect(Effect):
    """An effect of a `ContactScene`."""

    def cites(self, scene: ContactScene) -> tuple[str, ...]:
        """Sources of what this choice computes for a scene; all of them, unless it depends."""
        return self.sources

    def lacks(self, scene: ContactScene) -> tuple[str, ...]:
        """Name what this effect needs and `scene` does not give, with units."""
        return ()


@frozen(kw_only=True)
class Compliance(ContactEffect):
    """How the bodies yield to pressure, C; exactly one."""

    @abc.abstractmethod
    def prepare(self, scene: ContactScene, grid: Grid) -> tuple[SymbolMaker, ...]:
        """Return for each deforming body what makes its transformed compliance on a grid."""


@frozen(kw_only=True)
class PressureCap(ContactEffect):
    """The largest pressure the bodies bear, H; none or one."""

    @abc.abstractmethod
    def prepare(self, scene: ContactScene, grid: Grid) -> Cap:
        """Do the work that does not depend on the pressure."""


@frozen(kw_only=True)
class LoadTerm(ContactEffect):
    """A force F_m that pulls the bodies together, on top of the load."""

    @abc.abstractmethod
    def observe(self, contact: Contact) -> object:
        """Return the force and where it acts, for a given contact."""


@frozen(kw_only=True)
class DisplacementTerm(ContactEffect):
    """A normal displacement of the surface caused by something else than pressure."""

    @abc.abstractmethod
    def displacement(self, scene: ContactScene, grid: Grid, pressure: Map) -> Map:
        """Return the displacement into the lower body [m], for a pressure [Pa]."""


@frozen(kw_only=True)
class Observer(ContactEffect):
    """What is computed from the solved contact, and changes nothing in it."""

    @abc.abstractmethod
    def observe(self, contact: Contact) -> object:
        """Return what this effect adds to the result."""
