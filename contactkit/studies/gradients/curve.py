"""Slopes of the curves of an imposed motion over parameters, at gaps of one's own."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

import numpy as np

from ...errors import NotSimulatedError
from ...scene.loading import ImposedSpeed
from ...separation.plan import Plan, plan
from ...separation.results import SeparationResult
from .differences import differences, parameter

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Curve = NDArray[np.float64]

__all__ = ["curve_slopes"]


def curve_slopes(
    result: SeparationResult, of: str, gaps: Sequence[float], to: Sequence[str]
) -> dict[str, Curve]:
    """Slopes of a force over parameters, each at the same gaps [m] of an imposed speed.

    The laws of the forces are evaluated at these gaps alone, for values of a parameter nearby;
    no curve is run again. Right to 1e-6, for two plans a parameter.

    Parameters
    ----------
    result : SeparationResult
        Of an `ImposedSpeed`.
    of : str
        A force of the scene, or ``pull``, their sum.
    gaps : sequence of float
        Where [m].
    to : sequence of str
        Parameters by their paths.

    Returns
    -------
    dict of str to ndarray
        Slopes (n,) of each parameter.

    Raises
    ------
    NotSimulatedError
        If the curve is none of gap and speed alone, or a force ends at one of the gaps.
    DescriptionError
        If a parameter has no gradient.
    """
    scene, accuracy = result.plan.scene, result.plan.accuracy
    force = _force_of(result.plan, of)
    found = {}
    for path in to:
        one = parameter(scene, accuracy, path)
        made = differences(scene, accuracy, one, lambda s: plan(s, accuracy), is_coarse=True)
        _check_ends((result.plan, *made.prepared), gaps)
        found[path] = made.weighted(lambda near: np.array([force(near, gap) for gap in gaps]))
    return found


def _force_of(whole: Plan, of: str) -> Callable[[Plan, float], float]:
    """Force [N] of a plan at a gap [m] and the speed that it imposes."""
    loading, film = whole.scene.loading, whole.film
    names = {column.name for column in film.columns}
    if not isinstance(loading, ImposedSpeed) or loading.vibration is not None:
        raise NotSimulatedError("no slopes of curves of a motion that is solved in time")
    if film.cavity is not None or film.volume_fraction is not None:
        raise NotSimulatedError("no slopes of curves of a film that remembers its motion")
    if of != "pull" and of not in names:
        raise NotSimulatedError(f"no slopes of {of}: forces over the gap have them")

    def force(one: Plan, gap: float) -> float:
        assert isinstance(one.scene.loading, ImposedSpeed)
        acting, speed = one.acting_film(gap), one.scene.loading.speed
        if acting is None:
            return 0.0
        named = acting.at(gap, speed).named
        return sum(named.values()) if of == "pull" else named.get(of, 0.0)

    return force


def _check_ends(plans: Sequence[Plan], gaps: Sequence[float]) -> None:
    """Refuse a gap at which a film or a contact ends as a parameter varies: the force jumps."""
    for gap in gaps:
        states = {(gap > one.film.end, gap > one.film.release) for one in plans}
        if len(states) > 1:
            raise NotSimulatedError(
                f"no slope at a gap of {gap:g} m: a film ends there, and its force jumps"
            )
