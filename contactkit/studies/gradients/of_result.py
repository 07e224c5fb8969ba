"""Gradient of a number of any result that has one."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from ...contact.functionals import Functional
from ...contact.result import ContactResult
from ...errors import DescriptionError, NotSimulatedError
from ...scene.gradient import Gradient
from ...scene.result import Result
from ...separation.results import SeparationResult

__all__ = ["gradient_of"]


def gradient_of(result: Result, of: str | Functional, to: str | Sequence[str]) -> Gradient:
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

        return contact_gradient(result, of, paths)
    if isinstance(result, SeparationResult):
        from .motion import separation_gradient

        given: Any = of
        return separation_gradient(result, given, paths)
    raise NotSimulatedError(
        f"no gradient of a {type(result).__name__}: contacts and separations of rigid bodies have "
        "one; take differences of whole runs (ck.sensitivity)"
    )
