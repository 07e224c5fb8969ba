"""Plan of any scene: `plan`."""

from __future__ import annotations

from typing import TYPE_CHECKING, overload

from .accuracy import Accuracy
from .scene.plan import check_accuracy, check_scene
from .scene.scenes import ContactScene, SeparationScene, SlidingScene

if TYPE_CHECKING:
    from .contact.plan import ContactPlan
    from .separation.plan import Plan
    from .separation.sliding.plan import SlidingPlan

__all__ = ["plan"]


@overload
def plan(scene: SeparationScene, accuracy: Accuracy | None = None) -> Plan: ...


@overload
def plan(scene: SlidingScene, accuracy: Accuracy | None = None) -> SlidingPlan: ...


@overload
def plan(scene: ContactScene, accuracy: Accuracy | None = None) -> ContactPlan: ...


def plan(
    scene: SeparationScene | SlidingScene | ContactScene, accuracy: Accuracy | None = None
) -> Plan | SlidingPlan | ContactPlan:
    """Check the effects of a scene against it, and its feasibility, before any work.

    Parameters
    ----------
    scene : SeparationScene, SlidingScene or ContactScene
        What is there and which physics it calls for.
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
    check_scene(scene, (ContactScene, SeparationScene, SlidingScene))
    check_accuracy(accuracy)
    if isinstance(scene, ContactScene):
        from .contact.plan import plan_contact

        return plan_contact(scene, accuracy)
    if isinstance(scene, SlidingScene):
        from .separation.sliding.plan import plan_sliding

        return plan_sliding(scene, accuracy)
    from .separation.plan import plan as plan_separation

    return plan_separation(scene, accuracy)
