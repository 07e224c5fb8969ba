"""Gradient of a number of any result that has one."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from ...contact.functionals import Functional
from ...contact.result import ContactResult
from ...errors import DescriptionError, NotSimulatedError
from ...scene.gradient import Gradient
from ...scene.loading import ImposedForce
from ...scene.result import Result
from ...scene.scenes import ContactScene, SeparationScene
from ...separation.effects.base import CoupledEffect
from ...separation.results import SeparationResult

if TYPE_CHECKING:
    from .contact import SharedChanges

__all__ = ["gradient_of", "runs_of_gradient"]

# A motion with its sensitivities over its own run: 5 to 6 over one parameter as over four, most of
# it the slopes of the forces at the stages of each step.
_OF_MOTION = 6.0
# Values of a parameter that a difference takes, each of them a run of an imposed motion.
_OF_CURVE = 4.0


def gradient_of(
    result: Result,
    of: str | Functional,
    to: str | Sequence[str],
    shared: SharedChanges | None = None,
) -> Gradient:
    """Return the gradient of a number of a result; see `Result.gradient`.

    Parameters
    ----------
    result : Result
        A solved contact, or a separation.
    of : str or Functional
        Name of the number, see `contact.functionals.FUNCTIONALS` and the scalars of a separation.
    to : str or sequence of str
        Parameters by their dotted paths in the scene, as in `study`; ``heights`` for the map of
        slopes over the heights of a contact.
    shared : SharedChanges, optional
        Of a contact, what its interface has in common with that of others.

    Raises
    ------
    NotSimulatedError
        If the result has no gradient; the message says why.
    DescriptionError
        If there is no such number or parameter.
    """
    paths = [to] if isinstance(to, str) else list(to)
    if not paths:
        raise DescriptionError("to", to, "name at least one parameter")
    for path in paths:
        if not isinstance(path, str) or paths.count(path) > 1:
            raise DescriptionError("to", path, "be the path of a parameter, once")
    if isinstance(result, ContactResult):
        from .contact import contact_gradient

        return contact_gradient(result, of, paths, shared)
    if isinstance(result, SeparationResult):
        from .motion import separation_gradient

        given: Any = of
        return separation_gradient(result, given, paths)
    raise NotSimulatedError(
        f"no gradient of a {type(result).__name__}: contacts and separations of rigid bodies have "
        "one; take differences of whole runs (ck.sensitivity)"
    )


def runs_of_gradient(scene: object, n: int) -> float:
    """Cost of a gradient over n parameters, in runs of the scene; infinite if it has none."""
    if isinstance(scene, ContactScene):
        return 1.0
    if isinstance(scene, SeparationScene) and scene.effect(CoupledEffect) is None:
        return _OF_MOTION if isinstance(scene.loading, ImposedForce) else _OF_CURVE * n
    return math.inf
