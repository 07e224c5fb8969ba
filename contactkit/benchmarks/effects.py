"""Cost of each effect of a contact."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING, NamedTuple

from attrs import evolve

from ..accuracy import Accuracy
from ..contact.effects.base import Compliance, DisplacementTerm, PressureBound
from ..contact.effects.friction import FrictionTraction
from ..errors import ConvergenceError
from ..planning import plan
from ..scene.scenes import ContactScene
from .timing import timed

if TYPE_CHECKING:
    from ..contact.result import ContactResult

__all__ = ["EffectCost", "effect_costs"]

Progress = Callable[[float], None]


class EffectCost(NamedTuple):
    """CPU seconds and operator applications of a scene with the effects up to this one."""

    name: str
    seconds: float
    n_operator_applications: int
    problem: str = ""


def effect_costs(
    scene: ContactScene, accuracy: Accuracy, progress: Progress
) -> tuple[EffectCost, ...]:
    """Seconds of the scene with its effects one after another, the compliance first."""
    order = sorted(scene.effects, key=_rank)
    found = []
    for i in range(1, len(order) + 1):
        some = evolve(scene, effects=tuple(order[:i]))
        name = ("" if i == 1 else "+ ") + order[i - 1].name
        try:
            result, best = timed(partial(_solved, some, accuracy))
        except ConvergenceError as error:
            found.append(EffectCost(name, float("nan"), 0, str(error).split(";")[0]))
        else:
            found.append(EffectCost(name, best, result.work.n_operator_applications))
        progress(i / len(order))
    return tuple(found)


def _rank(effect: object) -> int:
    ranks = (Compliance, PressureBound, FrictionTraction, DisplacementTerm)
    return next((i for i, kind in enumerate(ranks) if isinstance(effect, kind)), len(ranks))


def _solved(scene: ContactScene, accuracy: Accuracy) -> ContactResult:
    from ..contact.solve import solve_unwarned

    return solve_unwarned(plan(scene, accuracy))
