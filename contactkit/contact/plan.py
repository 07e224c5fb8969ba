"""A contact made ready to solve: what will be simulated can be read before it is."""

from __future__ import annotations

from attrs import field, frozen

from ..accuracy import Accuracy
from ..errors import InfeasibleError, PlanError
from ..scene.effect import check_listed, choices
from ..scene.loading import Approach
from ..scene.scenes import ContactScene
from ..scene.surfaces import Flat
from ..scene.window import Grid
from .effects.base import Compliance, ContactEffect, DisplacementTerm, LoadTerm, PressureCap
from .effects.friction import FrictionTraction
from .effects.registry import CONTACT_EFFECTS
from .grid import grid_of

__all__ = ["ContactPlan", "plan_contact"]


@frozen(eq=False)
class ContactPlan:
    """A checked contact scene on its grid.

    ``print(plan)`` says what will be simulated and what will not; `cite` gives the sources.
    """

    scene: ContactScene
    accuracy: Accuracy
    grid: Grid = field(repr=False)

    def has(self, kind: type[ContactEffect]) -> bool:
        """Whether the scene calls for an effect."""
        return any(type(effect) is kind for effect in self.scene.effects)

    @property
    def mean_pressure(self) -> float | None:
        """Mean pressure over the window [Pa]; None if the approach is imposed."""
        return self.scene.loading.mean_pressure(self.grid.area)

    def cite(self) -> str:
        """Sources of the equations of this run, one to a line."""
        return "\n".join(
            f"{effect.name}: {source}"
            for effect in self.scene.effects
            for source in effect.cites(self.scene)
        )

    def __str__(self) -> str:
        (ny, nx), (dy, dx) = self.grid.shape, self.grid.pixel_size
        edges = "periodic" if self.grid.periodic else "free"
        title = (
            f"{self.scene.name or 'contact'}: {self.scene.loading.summary}, window {nx * dx:g} m x "
            f"{ny * dy:g} m, {edges}, {nx} x {ny} pixels"
        )
        on = [f"  on   {e.name:18s} {choices(e)}" for e in self.scene.effects]
        off = [
            f"  off  {kind.name:18s} {kind.summary}"
            for kind in CONTACT_EFFECTS
            if not self.has(kind)
        ]
        return "\n".join([title, *on, *off])


def plan_contact(scene: ContactScene, accuracy: Accuracy | None = None) -> ContactPlan:
    """Check the effects of a contact scene, and its load, before any work.

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
    InfeasibleError
        If the bodies cannot carry the load.
    """
    _check_bodies(scene)
    _check_effects(scene)
    made = ContactPlan(scene, accuracy or Accuracy.standard, grid_of(scene, accuracy))
    _check_load(made)
    return made


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
        if isinstance(surface, Flat) and surface.radius is not None:
            problems.append(
                f"interface.{name}.surface.radius = {surface.radius:g} m has no effect: a contact "
                "knows no rim of a face; leave it out, or give the face as Heights"
            )
    if problems:
        raise PlanError("; ".join(problems))


def _check_effects(scene: ContactScene) -> None:
    known = ", ".join(kind.__name__ for kind in CONTACT_EFFECTS)
    kinds = check_listed(scene.effects, ContactEffect, "contact", known)
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
    if FrictionTraction not in kinds:
        problems += [
            f"{type(e).__name__} needs FrictionTraction(coefficient=...) beside it"
            for e in scene.effects
            if isinstance(e, DisplacementTerm)
        ]
    if problems:
        raise PlanError("; ".join(problems))
    if isinstance(scene.loading, Approach):
        for effect in scene.effects:
            if isinstance(effect, LoadTerm) and getattr(effect, "self_consistent", False):
                raise PlanError(
                    f"{type(effect).__name__}(self_consistent=True) adds its force to a load, and "
                    "Approach(approach=...) imposes none; impose pressure or force, or leave it out"
                )


def _check_load(made: ContactPlan) -> None:
    """A load above hardness x area is refused before any work."""
    load, scene = made.mean_pressure, made.scene
    cap = scene.effect(PressureCap)  # type: ignore[type-abstract]
    if cap is None or load is None:
        return
    most = cap.prepare(scene, made.grid).most
    if load >= most and load > 0.0:
        area = made.grid.area
        raise InfeasibleError(
            f"load {load * area:.6g} N reaches H*A = {most * area:.6g} N, the hardness of "
            f"{most:.6g} Pa over the whole window of {area:.6g} m2: the bodies cannot carry it; "
            "lower the load, or leave HardnessLimit out"
        )
