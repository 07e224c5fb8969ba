"""Unknowns that effects add to a contact, and the contact while they are held.

For given unknowns a contact is one call of the solver. Each unknown is a map (ny, nx): it enters
the contact as a displacement, a tension or a bound, and follows from the contact by the law of its
effect. `iteration` looks for unknowns that agree with the contact they lead to.
"""

from __future__ import annotations

import abc
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, ClassVar, NamedTuple

import numpy as np

from ..solver.contact_solver import Solution
from ..solver.warm_start import Start

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import NDArray

    from ...accuracy import Accuracy

    Map = NDArray[np.float64]

__all__ = ["Held", "HeldContact", "Next", "Target", "Unknown"]


class Target(NamedTuple):
    """Load or approach of one solve, and where it starts.

    Either a mean pressure [Pa] or an approach of the zero plane of the heights [m]. `start` is a
    pressure (ny, nx) [Pa], or pairs of load or approach and pressure, the nearest first; `hardness`
    [Pa] and `unknowns`, by their names, are those of a solution nearby.
    """

    mean_pressure: float | None
    rigid_approach: float | None
    start: Start | None = None
    hardness: float | None = None
    unknowns: Mapping[str, Map] = MappingProxyType({})

    @property
    def pressure(self) -> Map | None:
        """Pressure of the nearest of the solutions to start from."""
        start = self.start
        return start if start is None or isinstance(start, np.ndarray) else start[0][1]


class Held(NamedTuple):
    """Unknowns as they enter one contact.

    `displacement` of the surface into the lower body by tractions [m], `tension` between the
    surfaces [Pa], `bound` of the pressure [Pa]; None of those that no effect adds. With a
    `relaxation` below 1 the displacement lacks ``(1 - relaxation)`` of the gap.
    """

    bound: Map | float | None = None
    displacement: Map | None = None
    tension: Map | None = None
    relaxation: float = 1.0


class HeldContact(NamedTuple):
    """A contact that was solved while its unknowns were held.

    `solution` is that of the solver, whose `pressure` acts in contact alone: it balances load and
    tension. `displacement` [m] is that by this pressure less the tension; `distance` [m] between
    the surfaces, negative where they would overlap.
    """

    target: Target
    held: Held
    solution: Solution
    displacement: Map
    distance: Map

    @property
    def touching(self) -> NDArray[np.bool_]:
        """Pixels in contact."""
        is_pressed: NDArray[np.bool_] = self.solution.pressure > 0.0
        return is_pressed

    @property
    def pressure(self) -> Map:
        """Pressure less tension [Pa]: the one that load and displacement belong to."""
        tension = self.held.tension
        return self.solution.pressure if tension is None else self.solution.pressure - tension

    @property
    def gap(self) -> Map:
        """Gap between the surfaces [m], zero where they would overlap."""
        return self._gap(np.empty_like(self.distance))

    def into_gap(self) -> Map:
        """The same in the memory of `distance`, which is lost."""
        return self._gap(self.distance)

    def _gap(self, out: Map) -> Map:
        gap = np.maximum(self.distance, 0.0, out=out)
        if self.held.tension is not None:  # which is steep: round-off in contact would change it
            gap[self.touching] = 0.0
        return gap


class Next(NamedTuple):
    """Value of an unknown that follows from a contact, and what its effect remembers of it."""

    value: Map
    memory: Any = None
    is_exact: bool = True


class Unknown(abc.ABC):
    """A map that an effect adds to the unknowns of a contact.

    Attributes
    ----------
    name, measure : str
        Of the unknown and of its scale, in the message of an iteration that does not settle.
    effect : str
        Name of the effect that it belongs to.
    cure : str
        Changes of the scene that help then.
    is_monotonic : bool
        Whether iterates from one side stay there, so that momentum accelerates them safely.
    is_of_tractions : bool
        Whether it is that of tractions along the surface, and zero without them.
    first_rtol, loosest : float
        Tolerance of the first contact, and of others far from the end, over the rms height [-].
    memory : int
        Evaluations that an acceleration by Anderson's method looks back on.
    slowness : float
        Evaluations that it may take over those of a map that contracts well [-].
    """

    name: ClassVar[str]
    measure: ClassVar[str]
    effect: str
    cure: str
    is_monotonic: ClassVar[bool] = False
    is_of_tractions: ClassVar[bool] = False
    first_rtol: float = 1e-4
    loosest: float = 1e-2
    memory: int = 4
    slowness: float = 1.0

    @abc.abstractmethod
    def first(self, target: Target) -> Map:
        """Return the value to start from."""

    @abc.abstractmethod
    def hold(self, held: Held, value: Map) -> Held:
        """Return what is held in a contact, with this unknown at a value."""

    @abc.abstractmethod
    def renewed(self, contact: HeldContact, rtol: float) -> Next:
        """Return the value that follows from a contact that was solved to a tolerance."""

    @abc.abstractmethod
    def scale(self, contact: HeldContact) -> float:
        """Return the size that changes are small against, in the unit of the unknown."""

    def change(self, value: Map, found: Map, contact: HeldContact) -> float:
        """Return the largest change over the scale [-]."""
        return float(np.abs(found - value).max(initial=0.0)) / self.scale(contact)

    def admitted(self, value: Map, found: Map, target: Target) -> Map:
        """Return an accelerated value, moved to where a contact exists."""
        return value

    def settled(self, value: Map, contact: HeldContact) -> Map:
        """Return the unknown [unit of its own] that a contact under an agreeing value has."""
        return value

    def carries(self, value: Map, target: Target) -> bool:
        """Whether a load, if one is imposed, leaves the contact something to carry."""
        return True

    def sensitivity(self, heights: Map) -> float:
        """Change over the scale that an error of the contact of the rms height causes [-]."""
        return 1.0

    def finest(self, accuracy: Accuracy, heights: Map) -> float:
        """Tolerance of contacts at the end, over the rms height [-]."""
        return accuracy.rtol

    def floor(self, accuracy: Accuracy, heights: Map) -> float:
        """Change over the scale below which contacts are not solved any better [-]."""
        return 0.0
