r"""Base classes of the effects of a contact: the roles that physics may play in the problem.

.. math:: \min_p \tfrac12 p^T C p - h^T p, \quad 0 \le p \le H, \quad \int p \, dA = W + F_m

An effect holds choices only. `prepare` does once whatever does not depend on the unknown
pressure; `observe` evaluates the effect in a solved contact, as its part of the result. The class
declares which numbers and arrays of that part are shown in tables and files.
"""

from __future__ import annotations

import abc
import math
from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, Any, ClassVar, Generic, NamedTuple, TypeVar, cast

from attrs import frozen

from ...errors import PlanError
from ...scene.effect import Effect

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from ...liquids.liquid import LiquidState
    from ...scene.loading import ContactLoading
    from ...scene.scenes import ContactScene
    from ...scene.window import Grid
    from ...validity import ValidityNumber
    from ..outer.unknown import Unknown
    from .attraction_laws import TensionLaw

    Map = NDArray[np.float64]
    SymbolMaker = Callable[[tuple[int, int], tuple[float, float]], Map]

__all__ = [
    "Array",
    "AttractedContact",
    "Attraction",
    "Balance",
    "BoundedContact",
    "Compliance",
    "SolvedContact",
    "ContactEffect",
    "DisplacementTerm",
    "FixedHardness",
    "FrictionalContact",
    "HardnessLaw",
    "InterfaceView",
    "LoadHistory",
    "LoadTerm",
    "Observer",
    "PressureBound",
    "Scalar",
    "SurfaceTraction",
    "VaryingHardness",
    "effects_of",
    "listed_loadings",
]

Part = TypeVar("Part")


class BoundedContact(NamedTuple):
    """Hardness [Pa], the bound of the pressure, and the overlap [m] of the elastic surfaces.

    The overlap (ny, nx) is the depth for which plastic flow makes room.
    """

    hardness: Map | float
    overlap: Map


class FrictionalContact(NamedTuple):
    """Normal displacement that friction causes [m], and the pressure [Pa] without it, (ny, nx)."""

    displacement: Map
    pressure_without: Map


class AttractedContact(NamedTuple):
    """Tension of the attraction [Pa] and pixels in contact, (ny, nx) each.

    In contact the tension is that of a closed gap. `self_influence` is the displacement of a pixel
    under unit pressure on itself [m/Pa], `n_contacts` the number of contacts solved for the state.
    """

    tension: Map
    touching: NDArray[np.bool_]
    self_influence: float
    n_contacts: int


class SolvedContact(NamedTuple):
    """A solved contact as the effects see it: maps (ny, nx) in SI units.

    `bounded` is there with a `PressureBound`, `frictional` with a `DisplacementTerm`, `attracted`
    with an `Attraction`, `tractions` on the lower body along x and y [Pa] with a `SurfaceTraction`,
    and the properties of the `liquid` at the temperature of the scene where an effect needs them.
    With an `Attraction` the pressure is negative where it pulls.
    """

    scene: ContactScene
    grid: Grid
    pressure: Map
    displacement: Map
    gap: Map
    threads: int = 1
    bounded: BoundedContact | None = None
    frictional: FrictionalContact | None = None
    liquid_state: LiquidState | None = None
    attracted: AttractedContact | None = None
    tractions: tuple[Map, Map] | None = None

    @property
    def touching(self) -> NDArray[np.bool_]:
        """Pixels in contact (ny, nx)."""
        if self.attracted is not None:
            return self.attracted.touching
        is_pressed: NDArray[np.bool_] = self.pressure > 0.0
        return is_pressed

    @property
    def contact_pressure(self) -> Map:
        """Pressure [Pa] that the bodies in contact exert on each other, (ny, nx).

        With an `Attraction` it carries the tension as well, which acts across the gap too: friction
        is that of this pressure (Derjaguin), and there is none where the bodies do not touch.
        """
        if self.attracted is None:
            return self.pressure
        import numpy as np

        pressed = self.pressure + self.attracted.tension
        return np.where(self.attracted.touching, np.maximum(pressed, 0.0), 0.0)

    @property
    def liquid(self) -> LiquidState:
        """Properties of the liquid; refused where no effect of the scene needs them."""
        if self.liquid_state is None:
            raise PlanError(
                "no effect of this contact needs a liquid: add the effect to ContactScene.effects"
            )
        return self.liquid_state


class FixedHardness(NamedTuple):
    """A hardness [Pa] that does not depend on the displacement: one number, or a map (ny, nx)."""

    value: Map | float

    @property
    def highest(self) -> float:
        """Largest mean pressure that it carries [Pa]."""
        return self.value if isinstance(self.value, float) else float(self.value.mean())


class VaryingHardness(NamedTuple):
    """A hardness [Pa] that depends on the displacement of the surface.

    `at` gives it for the displacements [m] of the deforming bodies, one map each: for every pixel
    if `is_local`, else for the largest ones. It lies between `lowest` and `highest`, and
    `has_jumps` where it is not continuous.
    """

    lowest: float
    highest: float
    at: Callable[[tuple[Map, ...]], Map | float]
    is_local: bool = False
    has_jumps: bool = False


HardnessLaw = FixedHardness | VaryingHardness
"""Upper bound of the pressure."""


class InterfaceView(NamedTuple):
    """Prepared contact, whatever its load: all that unknowns of effects are made from.

    `self_influence` is the displacement of a pixel under unit pressure on itself [m/Pa],
    `displacements` gives that of each body for a pressure [Pa] and the displacement of both [m],
    `coupling` the displacement [m] that a `DisplacementTerm` causes under a pressure [Pa], and
    `strength` its `DisplacementTerm.strength` [-]. Undeformed the bodies touch at the rigid-body
    approach `first_touch` [m].
    """

    grid: Grid
    self_influence: float
    displacements: Callable[[Map, Map], tuple[Map, ...]]
    hardness: HardnessLaw | None
    coupling: Callable[[Map], Map] | None
    strength: float = 0.0
    first_touch: float = -math.inf


class Balance(NamedTuple):
    """Balance of the imposed load, a force that adds to it, and the elastic bodies.

    `force` [N] adds to the load, `relative_force` is its ratio to the load [-]. `equilibria` are
    the loads [N] on the contact that balance, the smallest first; `imbalance` is what remains at
    the first of them, over the load [-], and `balance_error` the range of loads that balance up to
    steps of single pixels, over the load [-].
    """

    force: float
    relative_force: float
    equilibria: tuple[float, ...]
    imbalance: float
    balance_error: float


class Scalar(NamedTuple):
    """A number that an effect adds to a result.

    `read` takes it from the part of the effect; None if it does not apply.
    """

    name: str
    unit: str
    read: Callable[[Any], float | None]


class Array(NamedTuple):
    """A map or curve that an effect adds to a result, over named axes; maps are over y and x.

    `read` takes it from the part of the effect; None if it does not apply.
    """

    name: str
    unit: str
    read: Callable[[Any], Any]
    axes: tuple[str, ...] = ("y", "x")


@frozen(kw_only=True)
class ContactEffect(Effect, Generic[Part]):
    """An effect of a `ContactScene`; `Part` is what ``result.of`` gives for it."""

    family: ClassVar[str] = "contact effect"
    scalars: ClassVar[tuple[Scalar, ...]] = ()
    """Numbers of the part, for tables, studies and files."""
    arrays: ClassVar[tuple[Array, ...]] = ()
    """Maps and curves of the part, for datasets and tables."""
    records: ClassVar[tuple[type, ...]] = ()
    """Named tuples that the part is made of, so that it can be read back from a file."""

    def cites(self, scene: ContactScene) -> tuple[str, ...]:
        """Sources of what this choice computes for a scene; all of them, unless it depends."""
        return self.sources

    takes_tension: ClassVar[bool] = True
    """Whether it holds beside an `Attraction`, where solids pull on each other across the gap."""

    takes_holes: ClassVar[bool] = False
    """Whether it is right with pixels that carry no load and whose gap is not known."""
    takes_free_sheets: ClassVar[bool] = True
    """Whether it is right on an isolated sheet that slides on its base."""
    takes_relaxation: ClassVar[bool] = False
    """Whether it is right on bodies whose moduli depend on time."""
    takes_anisotropy: ClassVar[bool] = False
    """Whether it is right on bodies of transversely isotropic materials."""

    def lacks(self, scene: ContactScene) -> tuple[str, ...]:
        """Name what this effect needs and `scene` does not give, with units."""
        return ()

    def unknowns(self, view: InterfaceView) -> tuple[Unknown, ...]:
        """Return the maps that this effect adds to the unknowns of the contact."""
        return ()

    def observe(self, contact: SolvedContact) -> Part | None:
        """Return what this effect adds to the result; None if it has no part of its own."""
        return None

    def validity(self, contact: SolvedContact, part: Any) -> tuple[ValidityNumber, ...]:
        """Whether the model is in its range in a solved contact; `part` is that of the effect."""
        return ()


@frozen(kw_only=True)
class Compliance(ContactEffect[None]):
    """The elastic compliance C of the bodies under pressure; exactly one."""

    @abc.abstractmethod
    def prepare(self, scene: ContactScene, grid: Grid) -> tuple[SymbolMaker, ...]:
        """Return for each deforming body a function that makes its symbol on a grid [m/Pa]."""


@frozen(kw_only=True)
class PressureBound(ContactEffect[Part]):
    """The upper bound of the pressure, the hardness H; none or one."""

    @abc.abstractmethod
    def prepare(self, scene: ContactScene, grid: Grid) -> HardnessLaw:
        """Precompute what does not depend on the pressure."""

    def unknowns(self, view: InterfaceView) -> tuple[Unknown, ...]:
        """See `ContactEffect.unknowns`: the hardness, if it is one for each pixel."""
        law, grid = view.hardness, view.grid
        if not isinstance(law, VaryingHardness) or not law.is_local:
            return ()
        from ..outer.local_hardness import LocalHardness

        return (LocalHardness(law, view.displacements, grid.shape, grid.area, self.name),)

    @abc.abstractmethod
    def observe_bounded(self, contact: SolvedContact, bounded: BoundedContact) -> Part:
        """Return where and how the bound acts in a solved contact."""

    def observe(self, contact: SolvedContact) -> Part | None:
        """See `ContactEffect.observe`."""
        return self.observe_bounded(contact, contact.bounded) if contact.bounded else None


@frozen(kw_only=True)
class LoadTerm(ContactEffect[Part]):
    """A force F_m that pulls the bodies together, on top of the load; none or one."""

    @property
    @abc.abstractmethod
    def self_consistent(self) -> bool:
        """Whether the force adds to the load that presses the bodies together."""

    @abc.abstractmethod
    def largest_force(self, contact: SolvedContact) -> float:
        """Return a bound of the force [N]: none of the contacts of the scene has more."""

    @abc.abstractmethod
    def force_of(self, part: Part) -> float:
        """Return the force [N] of a part."""

    @abc.abstractmethod
    def needs_balance(self, contact: SolvedContact, part: Part) -> bool:
        """Whether the force is left out of the load and too large for that."""

    @abc.abstractmethod
    def estimated(self, part: Part, force: float | None) -> Part:
        """Return the part with an estimate of the force [N] that balances."""

    @abc.abstractmethod
    def balanced(self, part: Part, balance: Balance) -> Part:
        """Return the part with the force that balances."""

    @abc.abstractmethod
    def observe(self, contact: SolvedContact) -> Part:
        """Return the force and where it acts, for a given contact."""


@frozen(kw_only=True)
class LoadHistory(ContactEffect[Part]):
    """Loads that the contact has carried before that of the scene; none or one."""

    has_gradient: ClassVar[bool] = False
    """Whether the contact is that of its last load alone while loads rise."""

    @abc.abstractmethod
    def loadings(self) -> tuple[ContactLoading, ...]:
        """Return the loadings before that of the scene, the first one first."""


def listed_loadings(
    pressures: Iterable[float], forces: Iterable[float], approaches: Iterable[float]
) -> tuple[ContactLoading, ...]:
    """Loadings of a list of mean pressures [Pa], of forces [N] or of approaches [m].

    Examples
    --------
    >>> listed_loadings((), (1.0, 2.0), ())
    (Pressing(pressure=None, force=1.0), Pressing(pressure=None, force=2.0))
    """
    from ...scene.loading import Approach, Pressing

    return (
        *(Pressing(pressure=one) for one in pressures),
        *(Pressing(force=one) for one in forces),
        *(Approach(approach=one) for one in approaches),
    )


@frozen(kw_only=True)
class DisplacementTerm(ContactEffect[Part]):
    """A normal displacement of the surface by another traction than pressure; none or one."""

    @abc.abstractmethod
    def prepare(self, scene: ContactScene, grid: Grid) -> Callable[[Map], Map]:
        """Return the displacement into the lower body [m] as a function of the pressure [Pa]."""

    def strength(self, scene: ContactScene, grid: Grid) -> float:
        """Bound of the displacement over that of the pressure itself [-], in the energy norm.

        Above 1 contacts under the last displacement swing; if the term is skew (no work in sum),
        steps that are relaxed by it converge all the same. Zero where nothing is known.
        """
        return 0.0

    def unknowns(self, view: InterfaceView) -> tuple[Unknown, ...]:
        """See `ContactEffect.unknowns`: the displacement."""
        from ..outer.displacement import TractionDisplacement

        caused_by = view.coupling
        if caused_by is None:
            return ()
        own = view.self_influence
        shape, known = view.grid.shape, (view.strength, view.first_touch)
        return (TractionDisplacement(caused_by, shape, own, self.name, *known),)

    @abc.abstractmethod
    def observe_frictional(self, contact: SolvedContact, frictional: FrictionalContact) -> Part:
        """Return what the displacement changes in a solved contact."""

    def observe(self, contact: SolvedContact) -> Part | None:
        """See `ContactEffect.observe`."""
        return self.observe_frictional(contact, contact.frictional) if contact.frictional else None


@frozen(kw_only=True)
class Attraction(ContactEffect[Part]):
    """A tension t(gap) between the surfaces, on top of the pressure of contact; none or one."""

    @abc.abstractmethod
    def prepare(self, self_influence: float) -> TensionLaw:
        """Return the law on a grid of a given self-influence coefficient [m/Pa]."""

    def unknowns(self, view: InterfaceView) -> tuple[Unknown, ...]:
        """See `ContactEffect.unknowns`: the tension."""
        from ..outer.tension import Tension

        return (Tension(self.prepare(view.self_influence), view.grid.shape, self.name),)

    @abc.abstractmethod
    def observe_attracted(self, contact: SolvedContact, attracted: AttractedContact) -> Part:
        """Return the tension and what follows from it in a solved contact."""

    @abc.abstractmethod
    def attracted_of(self, part: Part) -> AttractedContact:
        """Return the tension and the pixels in contact of a part."""

    def observe(self, contact: SolvedContact) -> Part | None:
        """See `ContactEffect.observe`."""
        return self.observe_attracted(contact, contact.attracted) if contact.attracted else None


@frozen(kw_only=True)
class Observer(ContactEffect[Part]):
    """A quantity computed from the solved contact, without effect on it."""

    @abc.abstractmethod
    def observe(self, contact: SolvedContact) -> Part:
        """Return what this effect adds to the result."""


@frozen(kw_only=True)
class SurfaceTraction(Observer[Part]):
    """Friction in a solved contact: tractions along its surfaces; none or one."""

    @abc.abstractmethod
    def tractions(self, part: Part) -> tuple[Map, Map]:
        """Return the tractions on the lower body along x and y [Pa], (ny, nx) each."""


def effects_of(scene: ContactScene) -> tuple[ContactEffect[Any], ...]:
    """Return the effects of a scene with their type here; a scene itself knows an `Effect` only."""
    return cast("tuple[ContactEffect[Any], ...]", scene.effects)
