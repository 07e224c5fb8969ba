"""Plan of any scene, `plan`, and its run, `run`: each kind of scene names who does it."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, NamedTuple, overload

from ._lazy import named
from .accuracy import Accuracy
from .errors import PlanError
from .scene.plan import ScenePlan, check_accuracy, check_scene
from .scene.result import Result
from .scene.scenes import ContactScene, Scene, SeparationScene, SlidingScene

if TYPE_CHECKING:
    from .contact.plan import ContactPlan
    from .separation.plan import Plan
    from .separation.sliding.plan import SlidingPlan

__all__ = ["plan", "register_scene", "run"]

Progress = Callable[[float], None]
_Function = Callable[..., Any] | str


class _Kind(NamedTuple):
    """Functions that plan a scene and run its plan, or ``module:function`` of contactkit."""

    plan: _Function
    run: _Function
    reports_progress: bool = False


_SIMULATE = "separation.simulate:simulate"
_KINDS: dict[type[Scene], _Kind] = {
    ContactScene: _Kind("contact.plan:plan_contact", "contact.solve:solve"),
    SeparationScene: _Kind("separation.any_plan:plan_any", _SIMULATE, True),
    SlidingScene: _Kind("separation.sliding.plan:plan_sliding", _SIMULATE, True),
}


def register_scene(
    kind: type[Scene],
    *,
    plan: Callable[[Any, Accuracy | None], ScenePlan],
    run: Callable[[Any], Result],
) -> None:
    """Register a kind of scene of one's own: `plan`, studies and the command line then take it.

    Parameters
    ----------
    kind : type
        Subclass of `Scene`.
    plan : callable
        Takes a scene and its accuracy, or None for the standard one; returns the plan.
    run : callable
        Takes the plan; returns the result.

    Raises
    ------
    PlanError
        If `kind` is no subclass of `Scene`, or another package registered it.
    """
    if not (isinstance(kind, type) and issubclass(kind, Scene)):
        raise PlanError(f"a kind of scene is a subclass of Scene, got {kind!r}")
    if kind in _KINDS:
        raise PlanError(f"{kind.__name__} is registered already")
    _KINDS[kind] = _Kind(plan, run)


@overload
def plan(scene: SeparationScene, accuracy: Accuracy | None = None) -> Plan: ...


@overload
def plan(scene: SlidingScene, accuracy: Accuracy | None = None) -> SlidingPlan: ...


@overload
def plan(scene: ContactScene, accuracy: Accuracy | None = None) -> ContactPlan: ...


def plan(scene: Scene, accuracy: Accuracy | None = None) -> ScenePlan:
    """Check the effects of a scene against it, and its feasibility, before any work.

    Parameters
    ----------
    scene : SeparationScene, SlidingScene or ContactScene
        What is there and which physics it calls for; or a scene of a registered kind.
    accuracy : Accuracy, optional
        How well to solve; `Accuracy.standard` if not given.

    Returns
    -------
    Plan, SlidingPlan or ContactPlan
        To be run by `simulate` or `solve`; printed, it says what it will do and what not.

    Raises
    ------
    PlanError
        If an effect is listed twice, lacks something, or does not fit the others.
    InfeasibleError
        If the scene has no answer.
    """
    check_scene(scene, tuple(_KINDS))
    check_accuracy(accuracy, scene)
    made: ScenePlan = _function(_kind(type(scene)).plan)(scene, accuracy)
    return made


def run(made: ScenePlan, progress: Progress | None = None) -> Result:
    """Run a plan of any kind of scene.

    Parameters
    ----------
    made : ScenePlan
        Of `plan`.
    progress : callable, optional
        Called with the completed fraction by what reports it.
    """
    kind = _kind(type(made.scene))
    more = {"progress": progress} if kind.reports_progress else {}
    result: Result = _function(kind.run)(made, **more)
    return result


def _kind(scene: type) -> _Kind:
    return next(_KINDS[one] for one in scene.__mro__ if one in _KINDS)


def _function(name: _Function) -> Callable[..., Any]:
    found: Callable[..., Any] = named(f"{__package__}.{name}") if isinstance(name, str) else name
    return found
