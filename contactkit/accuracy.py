"""How well to solve; never which physics, never part of a scene."""

from __future__ import annotations

from typing import Any, ClassVar

from attrs import Attribute, field, frozen

from .checks import count, refuse
from .units import si

__all__ = ["Accuracy"]


def _tolerance(owner: object, attribute: Attribute[Any], value: Any) -> None:
    if isinstance(value, bool) or not isinstance(value, int | float) or not 1e-11 <= value <= 0.1:
        raise refuse(owner, attribute, value, "lie between 1e-11 and 0.1")


@frozen(kw_only=True)
class Accuracy:
    """Numerical settings of a plan.

    Parameters
    ----------
    time_rtol : float
        Error allowed in a step of time, relative to the gap and to the momentum delivered so
        far [-]. The release time of the reference cases comes out about this well.
    points : int
        Points along a curve over gaps (imposed speed or time).
    max_steps : int
        Steps of time after which an integration gives up.

    Examples
    --------
    >>> Accuracy.standard.time_rtol
    1e-08
    """

    time_rtol: float = field(default=1e-8, validator=_tolerance, metadata=si("-"))
    points: int = field(default=200, validator=count, metadata=si("-"))
    max_steps: int = field(default=100_000, validator=count, metadata=si("-"))

    draft: ClassVar[Accuracy]
    standard: ClassVar[Accuracy]
    reference: ClassVar[Accuracy]


Accuracy.draft = Accuracy(time_rtol=1e-5, points=50)
Accuracy.standard = Accuracy()
Accuracy.reference = Accuracy(time_rtol=1e-11, points=1000)
