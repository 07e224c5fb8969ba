"""Gradient of a number of a separation over parameters: sensitivities of its motion."""

from __future__ import annotations

from itertools import chain
from typing import TYPE_CHECKING

from ...errors import DescriptionError, NotSimulatedError, nearest
from ...scene.gradient import Gradient
from ...scene.loading import ImposedForce
from ...separation.motion.sensitivity import Variation, motion_slopes
from ...separation.motion_curves import pull_law
from ...separation.plan import Plan, plan
from ...separation.prescribed import impulses_of_gaps
from ...separation.simulate import simulate
from .differences import Differences, differences, parameter

if TYPE_CHECKING:
    from collections.abc import Sequence

    from ...separation.results import SeparationResult

__all__ = ["separation_gradient"]

_RELEASED = ("release_time", "release_speed", "break_time", "peak_force", "final_gap")


def separation_gradient(result: SeparationResult, of: str, to: Sequence[str]) -> Gradient:
    """Gradient of a number of a separation.

    Parameters
    ----------
    result : SeparationResult
        The separation.
    of : str
        The number.
    to : sequence of str
        Parameters, see `gradient_of`.

    Raises
    ------
    NotSimulatedError
        If the separation does not have the number, or has no gradient.
    DescriptionError
        If the number or a parameter has no gradient.
    """
    scene, accuracy = result.plan.scene, result.plan.accuracy
    numbers = [parameter(scene, accuracy, path) for path in to]
    known = result.scalars()
    if not isinstance(of, str) or of not in known:
        names = ", ".join(known)
        raise DescriptionError("of", of, f"be one of {names}", hint=nearest(str(of), known))
    made = [differences(scene, accuracy, one, lambda s: plan(s, accuracy)) for one in numbers]
    n_steps = 0
    if not isinstance(scene.loading, ImposedForce):
        slopes = [_of_curve(of, one) for one in made]
    elif of in impulses_of_gaps(result.plan) and of not in result.plan.film.impulses():
        slopes = [float(one.weighted(lambda p: impulses_of_gaps(p)[of])) for one in made]
    else:
        slopes, n_steps = _of_motion(result, of, made)
    notes = [row.notes(one.path) for one, row in zip(numbers, made, strict=True)]
    return Gradient(
        of,
        known[of][1],
        known[of][0],
        dict(zip((one.path for one in numbers), slopes, strict=True)),
        {one.path: one.value for one in numbers},
        {one.path: one.unit for one in numbers},
        tuple(chain.from_iterable(notes)),
        n_steps=n_steps,
    )


def _of_motion(
    result: SeparationResult, of: str, made: list[Differences[Plan]]
) -> tuple[list[float], int]:
    if result.status not in ("released", "time limit"):
        raise NotSimulatedError(f"no gradient of a motion that does not end: {result.message}")
    variations = [Variation(one.prepared, one.weights) for one in made]
    found = motion_slopes(result.plan, variations, pull_law)
    if of not in found.slopes:
        if of in _RELEASED:
            raise NotSimulatedError(f"no gradient of {of}: the motion does not come to it")
        names = ", ".join(found.slopes)
        raise DescriptionError("of", of, f"be a number of the motion with a gradient: {names}")
    return found.slopes[of].tolist(), found.n_steps


def _of_curve(of: str, made: Differences[Plan]) -> float:
    """Slope of a number of an imposed motion: closed forms and quadratures, nothing is solved."""
    return float(made.weighted(lambda one: simulate(one).scalars()[of][0]))
