"""Plan of a separation by the engine that its effects ask for: rigid or deforming bodies."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .effects.base import CoupledEffect

if TYPE_CHECKING:
    from ..accuracy import Accuracy
    from ..scene.scenes import SeparationScene
    from .deforming.plan import DeformingPlan
    from .plan import Plan

__all__ = ["plan_any"]


def plan_any(scene: SeparationScene, accuracy: Accuracy | None = None) -> Plan | DeformingPlan:
    """Plan a separation; one of bodies that deform if an effect couples film and bodies.

    Raises
    ------
    PlanError, InfeasibleError
        As the two plans do.
    """
    # Only a scene with such an effect imports what solves it.
    if any(isinstance(effect, CoupledEffect) for effect in scene.effects):
        from .deforming.effects import ElasticBodies

        if scene.effect(ElasticBodies) is not None:
            from .deforming.plan import plan_deforming

            return plan_deforming(scene, accuracy)
    from .plan import plan

    return plan(scene, accuracy)
