"""Plan of a contact: checked, with heights, compliance, solver and hardness prepared once."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING, Any, ClassVar

from attrs import Factory, evolve, field, frozen

from ..accuracy import Accuracy
from ..errors import DescriptionError, InfeasibleError, PlanError
from ..kinds import CONTACT_EFFECTS
from ..liquids.liquid import LiquidState
from ..registry import Registry
from ..scene.effect import check_listed
from ..scene.figures import Drawn
from ..scene.loading import ContactLoading
from ..scene.materials import needs_time
from ..scene.plan import ScenePlan
from ..scene.scenes import ContactScene
from ..scene.surfaces import Flat
from ..scene.window import Grid
from .effects.base import (
    Attraction,
    Compliance,
    ContactEffect,
    DisplacementTerm,
    HardnessLaw,
    LoadHistory,
    LoadTerm,
    PressureBound,
    SurfaceTraction,
    effects_of,
)
from .effects.friction import FrictionTraction
from .grid import grid_of, holes_of
from .prepared import Once, PreparedInterface, interface_key

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Map = NDArray[np.float64]

__all__ = ["ContactPlan", "plan_contact", "unprepared_plan"]

_SINGLE_ROLES = (
    PressureBound,
    LoadHistory,
    LoadTerm,
    DisplacementTerm,
    Attraction,
    SurfaceTraction,
)  # one effect of each at most
_LARGEST = 1e3  # pressure over E*, or approach over window: beyond, round-off is all there is
_WIDEST = 1e6  # side of a window [m]


def _hardness(plan: ContactPlan) -> HardnessLaw | None:
    bound = plan.scene.effect(PressureBound)
    return bound.prepare(plan.scene, plan.grid) if bound is not None else None


def _interface(plan: ContactPlan) -> Once[PreparedInterface]:
    # Of bodies that relax, the instantaneous compliance.
    scene = evolve(plan.scene, interface=plan.scene.interface.at_rate(math.inf))
    return Once(partial(PreparedInterface, scene, plan.grid, plan.accuracy.threads))


def _coupling(plan: ContactPlan) -> Once[Callable[[Map], Map]] | None:
    term = plan.scene.effect(DisplacementTerm)
    return Once(partial(term.prepare, plan.scene, plan.grid)) if term is not None else None


def _liquid(plan: ContactPlan) -> LiquidState | None:
    scene = plan.scene
    if not any(effect.liquid_needs(scene) for effect in scene.effects):
        return None
    return scene.meniscus.liquid.at(scene.temperature)


_METHODS = {
    "active-set": "active set on nested grids; Hintermueller, Ito and Kunisch 2002, Bornemann and "
    "Deuflhard 1996",
    "conjugate-gradient": "projected conjugate gradients, own formulation",
    "quasi-newton": "L-BFGS-B under an augmented Lagrangian; Byrd et al. 1995, Nocedal and Wright "
    "2006",
}


@frozen(eq=False)
class ContactPlan(Drawn, ScenePlan):
    """A checked contact scene on its grid, with everything prepared that the load does not change.

    ``print(plan)`` says what will be simulated and what will not; `cite` gives the sources.
    `with_loading` is the same interface under another load: nothing is prepared again.

    Attributes
    ----------
    scene : ContactScene
        What is simulated.
    accuracy : Accuracy
        How well it is solved.
    grid : Grid
        Pixels of the window.
    hardness : FixedHardness, VaryingHardness or None
        Upper bound of the pressure; None where the scene lists none.
    liquid : LiquidState or None
        Properties of the liquid at the temperature of the scene; None where no effect needs them.
    """

    known_effects: ClassVar[Registry[Any]] = CONTACT_EFFECTS

    scene: ContactScene
    accuracy: Accuracy
    grid: Grid = field(repr=False)
    hardness: HardnessLaw | None = field(default=Factory(_hardness, takes_self=True), repr=False)
    liquid: LiquidState | None = field(default=Factory(_liquid, takes_self=True), repr=False)
    _interface: Once[PreparedInterface] = field(
        default=Factory(_interface, takes_self=True), repr=False
    )
    _coupling: Once[Callable[[Map], Map]] | None = field(
        default=Factory(_coupling, takes_self=True), repr=False
    )

    @property
    def title(self) -> str:
        """The scene, the load and the grid, in a line."""
        (ny, nx), (dy, dx) = self.grid.shape, self.grid.pixel_size
        edges = "periodic" if self.grid.edges else "not periodic"
        edges += f" along {self.grid.along}" if self.grid.along else ""
        return (
            f"{self.scene.name or 'contact'}: {self.scene.loading.summary}, window {nx * dx:g} m x "
            f"{ny * dy:g} m, {edges}, {nx} x {ny} pixels"
        )

    @property
    def methods(self) -> tuple[str, ...]:
        """See `ScenePlan.methods`."""
        return (_METHODS[self.accuracy.method],)

    @property
    def prepared(self) -> PreparedInterface:
        """Heights, compliance and solver of the interface."""
        return self._interface()

    @property
    def coupling(self) -> Callable[[Map], Map] | None:
        """Displacement [m] that the `DisplacementTerm` causes, as a function of the pressure."""
        return self._coupling() if self._coupling is not None else None

    @property
    def heights(self) -> Map:
        """Heights of both bodies together [m], (ny, nx), read-only."""
        return self.prepared.heights

    @property
    def notes(self) -> tuple[str, ...]:
        """See `ScenePlan.notes`: pixels that carry no load, and memory once it is prepared."""
        notes, holes = list[str](), holes_of(self.scene)
        if holes is not None:
            notes.append(f"holes: {int(holes.sum())} of {holes.size} pixels, which carry no load")
        if self._interface.is_made:
            notes.append(f"memory: {self.memory / 2**20:.3g} MiB, {self._maps()} without effects")
        return tuple(notes)

    def _maps(self) -> str:
        (ny, nx), grid = self.grid.shape, self.grid
        factor = 1 if grid.periodic else 2 if grid.along else 4
        of = "the map" if grid.periodic else "the padded map"
        return f"{self.memory / (8 * factor * ny * nx):.3g} arrays of {of},"

    @property
    def memory(self) -> int:
        """Memory that the solve holds at its peak, without effects [bytes]; see `print(plan)`."""
        return self.prepared.memory

    @property
    def mean_pressure(self) -> float | None:
        """Mean pressure over the window [Pa]; None if the approach is imposed."""
        return self.scene.loading.mean_pressure(self.grid.area)

    @property
    def rigid_approach(self) -> float | None:
        """Imposed approach of the zero plane of the heights [m]; None if a load is imposed."""
        approach = self.scene.loading.imposed_approach
        return None if approach is None else self.prepared.first_touch + approach

    def has_interface_of(self, other: ContactPlan) -> bool:
        """Whether another plan is of the same surfaces, compliance and grid."""
        mine, theirs = (
            interface_key(one.scene, one.grid, one.accuracy.threads) for one in (self, other)
        )
        return mine == theirs

    def with_loading(self, loading: ContactLoading) -> ContactPlan:
        """Return the plan of the same interface under another loading.

        Raises
        ------
        PlanError, InfeasibleError
            As `plan` does.
        """
        made = evolve(self, scene=evolve(self.scene, loading=loading))
        _check_size(made)
        _check_load(made)
        _check_approach(made)
        return made

    def prepare(self, like: ContactPlan | None = None) -> ContactPlan:
        """Return the plan with its interface prepared, or taken over from a plan of the same one.

        Raises
        ------
        DescriptionError, InfeasibleError
            If the surfaces do not fit the grid, or no load brings them to the approach.
        """
        made = self
        if like is not None and self.has_interface_of(like):
            made = evolve(self, interface=like._interface)
        made._interface()
        _check_approach(made)
        return made

    def without_preparation(self) -> ContactPlan:
        """Return the plan without its preparation, which is repeated if it is solved."""
        return ContactPlan(self.scene, self.accuracy, self.grid, self.hardness, self.liquid)

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickle the scene on its grid; what is prepared is prepared again where it is used."""
        return ContactPlan, (self.scene, self.accuracy, self.grid)


def plan_contact(scene: ContactScene, accuracy: Accuracy | None = None) -> ContactPlan:
    """Check a contact scene and prepare its solve.

    Parameters
    ----------
    scene : ContactScene
        What is there and which physics it calls for.
    accuracy : Accuracy, optional
        How well to solve; `Accuracy.standard` if not given.

    Raises
    ------
    PlanError
        If an effect is listed twice, lacks something, or does not fit the others.
    DescriptionError
        If the surfaces do not fit the grid.
    InfeasibleError
        If the bodies cannot carry the load, or no load brings them to the approach.
    """
    return unprepared_plan(scene, accuracy).prepare()


def unprepared_plan(scene: ContactScene, accuracy: Accuracy | None = None) -> ContactPlan:
    """Check effects and load of a contact scene; heights, compliance and solver are not made yet.

    Raises
    ------
    PlanError, DescriptionError, InfeasibleError
        As `plan_contact`, except for problems that only the heights show.
    """
    _check_bodies(scene)
    _check_effects(scene)
    accuracy = accuracy or Accuracy.standard
    grid = grid_of(scene, accuracy)
    _check_window(grid)
    if scene.window.periodic is None and not grid.edges:  # a measured surface knows its edges
        scene = evolve(scene, window=evolve(scene.window, periodic=False))
    made = ContactPlan(scene, accuracy, grid)
    _check_liquid(made)
    _check_holes(scene)
    _check_relaxation(scene)
    _check_anisotropy(scene)
    _check_free_sheets(scene, grid)
    for one in (*_before(made), made):
        _check_size(one)
        _check_load(one)
    return made


def _before(made: ContactPlan) -> list[ContactPlan]:
    """Plans of the loads that the contact has carried before."""
    history = made.scene.effect(LoadHistory)
    loadings = history.loadings() if history is not None else ()
    return [evolve(made, scene=evolve(made.scene, loading=one)) for one in loadings]


def _check_bodies(scene: ContactScene) -> None:
    """Refuse bodies of which something would be left out, or none of which deforms."""
    interface, problems = scene.interface, list[str]()
    if not interface.stacks:
        problems.append(
            "interface.lower.solid must be a Material or a Stack where the upper body is rigid: "
            "two rigid bodies touch in points; give one of them a material"
        )
    for name in ("lower", "upper"):
        surface = getattr(interface, name).surface
        if isinstance(surface, Flat) and surface.outline is not None:
            given = "planform" if surface.radius is None else f"radius = {surface.radius:g} m"
            problems.append(
                f"interface.{name}.surface.{given} has no effect: the window of a contact has no "
                "rim; leave it out, or give the face as Heights"
            )
    if interface.meniscus is not None and interface.meniscus.slips:
        problems.append(
            "interface.meniscus.slip_length_lower and slip_length_upper have no effect: the liquid "
            "of a contact does not flow; leave them out"
        )
    if problems:
        raise PlanError("; ".join(problems))


def _check_effects(scene: ContactScene) -> None:
    kinds = check_listed(scene.effects, ContactEffect, "contact", CONTACT_EFFECTS)
    given = [k.__name__ for k in kinds if issubclass(k, Compliance)]
    if len(given) != 1:
        raise PlanError(
            "a contact scene needs exactly one of HalfSpace() and LayeredHalfSpace() among its "
            f"effects, got {' and '.join(given) or 'neither'}"
        )
    problems = [
        f"{type(effect).__name__} needs {item}"
        for effect in scene.effects
        for item in effect.lacks(scene)
    ]
    for role in _SINGLE_ROLES:
        names = [kind.__name__ for kind in kinds if issubclass(kind, role)]
        if len(names) > 1:
            problems.append(f"{' and '.join(names)} exclude each other: list one of them")
    if FrictionTraction not in kinds:
        problems += [
            f"{type(e).__name__} needs FrictionTraction(coefficient=...) beside it"
            for e in scene.effects
            if isinstance(e, DisplacementTerm)
        ]
    if problems:
        raise PlanError("; ".join(problems))


def _check_liquid(made: ContactPlan) -> None:
    """Refuse a liquid without the properties that the effects need."""
    problems = [
        f"{type(effect).__name__} needs interface.meniscus.{item}"
        for effect in made.scene.effects
        if made.liquid is not None
        for item in made.liquid.missing(*effect.liquid_needs(made.scene))
    ]
    if problems:
        raise PlanError("; ".join(problems))


def _check_holes(scene: ContactScene) -> None:
    """Refuse holes beside an effect that needs the gap everywhere."""
    if holes_of(scene) is None:
        return
    problems = [
        f"{type(effect).__name__} needs the gap at every pixel, and the surface has holes; fill "
        "them, or leave it out"
        for effect in effects_of(scene)
        if not effect.takes_holes
    ]
    if problems:
        raise PlanError("; ".join(problems))


def _check_relaxation(scene: ContactScene) -> None:
    """Refuse moduli that depend on time without a history, or beside effects of elastic bodies."""
    materials = [one for stack in scene.interface.stacks for one in stack.materials]
    relaxing = [one for one in materials if one.relaxation is not None]
    if not relaxing:
        return
    history = scene.effect(LoadHistory)
    if history is None or not history.takes_relaxation:
        raise PlanError(needs_time(relaxing[0]))
    problems = [
        f"{type(effect).__name__} needs elastic bodies, and {relaxing[0].name} is viscoelastic; "
        "leave it out, or give the elastic material solid.equilibrium or solid.instantaneous"
        for effect in effects_of(scene)
        if not effect.takes_relaxation
    ]
    if problems:
        raise PlanError("; ".join(problems))


def _check_anisotropy(scene: ContactScene) -> None:
    """Refuse effects that know isotropic bodies only beside one that is not."""
    materials = [one for stack in scene.interface.stacks for one in stack.materials]
    name = next((one.name for one in materials if not one.is_isotropic), None)
    problems = [
        f"{type(effect).__name__} needs isotropic bodies, and {name} is transversely isotropic; "
        "leave it out, or give a Material in its place"
        for effect in effects_of(scene)
        if name is not None and not effect.takes_anisotropy
    ]
    if problems:
        raise PlanError("; ".join(problems))


def _check_free_sheets(scene: ContactScene, grid: Grid) -> None:
    """Refuse an effect under which a body slides off along its base."""
    is_free = any(stack.base == "frictionless" for stack in scene.interface.stacks)
    problems = [
        f"{type(effect).__name__} needs RigidBase(bonded=True) below a sheet in a window that does "
        "not repeat along both axes: nothing else holds it; bond it, or use Window(periodic=True)"
        for effect in effects_of(scene)
        if is_free and not grid.periodic and not effect.takes_free_sheets
    ]
    if problems:
        raise PlanError("; ".join(problems))


def _check_window(grid: Grid) -> None:
    """Refuse a window whose powers overflow double precision."""
    sides = [count * size for count, size in zip(grid.shape, grid.pixel_size, strict=True)]
    if not max(sides) <= _WIDEST:
        raise DescriptionError(
            "the window",
            max(sides),
            f"be at most {_WIDEST:g} along a side",
            unit="m",
            hint="check the unit of Window.width and height, or of the pixel_size of a map",
        )


def _check_size(made: ContactPlan) -> None:
    """Refuse a load or an approach far beyond linear elasticity."""
    loading, load = made.scene.loading, made.mean_pressure
    # Of the stiffest layer, as a soft one may be thin.
    modulus = min(
        max(one.at_rate(math.inf).plane_strain_modulus for one in stack.materials)
        for stack in made.scene.interface.stacks
    )
    if load is not None and not load <= _LARGEST * modulus:
        name, value, unit = loading.quantity
        factor = value / load  # from a mean pressure to what imposes it
        raise DescriptionError(
            f"loading.{name}",
            value,
            f"be at most {_LARGEST * modulus * factor:.3g}, {_LARGEST:g} times the E* of "
            f"{modulus:.3g} Pa of the softer body over the window",
            unit=unit,
            hint="linear elasticity ends far below; check the units of load, window and "
            "young_modulus",
        )
    side = max(n * size for n, size in zip(made.grid.shape, made.grid.pixel_size, strict=True))
    if (approach := loading.imposed_approach or 0.0) > _LARGEST * side:
        raise DescriptionError(
            "loading.approach",
            approach,
            f"be at most {_LARGEST * side:.3g}, {_LARGEST:g} times the window",
            unit="m",
            hint="linear elasticity ends far below; check the units of approach and window",
        )


def _check_load(made: ContactPlan) -> None:
    """Refuse a load above hardness x area, a film that adds to no load, a pull nothing carries."""
    load, scene = made.mean_pressure, made.scene
    if load is not None and load < 0.0 and scene.effect(Attraction) is None:
        name, value, unit = scene.loading.quantity
        raise DescriptionError(
            f"{type(scene.loading).__name__}.{name}",
            value,
            "be zero or positive",
            unit=unit,
            hint="only adhesion carries a pull on solids: list Adhesion(law=...); the pull on a "
            "liquid film between them is a matter of separation",
        )
    if load is None:
        for effect in scene.effects:
            if isinstance(effect, LoadTerm) and effect.self_consistent:
                raise PlanError(
                    f"{type(effect).__name__}(self_consistent=True) adds its force to a load, and "
                    "Approach(approach=...) imposes none; impose pressure or force, or leave it out"
                )
    elif made.hardness is not None and load >= made.hardness.highest and load > 0.0:
        highest, area = made.hardness.highest, made.grid.area
        raise InfeasibleError(
            f"load {load * area:.6g} N reaches H*A = {highest * area:.6g} N, the hardness of "
            f"{highest:.6g} Pa over the whole window of {area:.6g} m2: the bodies cannot carry it; "
            "lower the load, or leave HardnessLimit out"
        )


def _check_approach(made: ContactPlan) -> None:
    """Refuse an approach at which no load closes a periodic window further."""
    approach = made.scene.loading.imposed_approach
    if approach is None or made.hardness is not None or not made.grid.periodic:
        return
    interface = made.prepared
    if interface.holes is not None or interface.solver.uniform_compliance:
        return  # the surface can rise as far as it must, or a base lets its mean plane sink
    heights = made.heights
    limit = float(heights.max() - heights.mean())
    if approach >= limit:
        raise InfeasibleError(
            f"an approach of {approach:.6g} m reaches the mean plane of the heights, "
            f"{limit:.6g} m from first touch, where the gap of a periodic window is closed under "
            "any load; impose pressure or force, or use Window(periodic=False)"
        )
