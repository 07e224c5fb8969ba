"""Communication steps of a coupled run: adaptive, or fixed with a coupling scheme."""

from __future__ import annotations

from typing import Any, Literal

from attrs import Attribute, field, frozen

from ...units import si
from ...validators import choice, count, positive, refuse

__all__ = ["AdaptiveSteps", "FixedSteps", "Scheme"]

Scheme = Literal["impulse", "implicit-force", "gauss-seidel", "jacobi"]


def _tolerance(owner: object, attribute: Attribute[Any], value: Any) -> None:
    positive(owner, attribute, value)
    if not 1e-8 <= value <= 0.1:
        hint = "tighter ones are not met" if value < 1e-8 else ""
        raise refuse(owner, attribute, value, "be between 1e-8 and 0.1", hint)


@frozen(kw_only=True)
class AdaptiveSteps:
    """Steps with error control, in which impulses are exchanged until mass and film agree.

    Parameters
    ----------
    tolerance : float
        Relative error [-] of the release time to aim at, between 1e-8 and 0.1.
    max_steps : int
        Steps after which to give up.
    """

    tolerance: float = field(default=1e-3, validator=_tolerance, metadata=si("-"))
    max_steps: int = field(default=100_000, validator=count)


@frozen(kw_only=True)
class FixedSteps:
    """Steps of one length, with the coupling scheme of most masters.

    Parameters
    ----------
    step : float
        Communication step [s]; shortened so that a whole number of them fits.
    scheme : {"impulse", "implicit-force", "gauss-seidel", "jacobi"}
        What is exchanged: impulses; the force at the end of the step, found by iteration; or the
        force of the last step, with the mass first or both at once.
    refuse_unstable : bool
        Refuse a step with which forces cannot be exchanged; False only to show the outcome.
    """

    step: float = field(validator=positive, metadata=si("s"))
    scheme: Scheme = field(
        default="impulse", validator=choice("impulse", "implicit-force", "gauss-seidel", "jacobi")
    )
    refuse_unstable: bool = True
