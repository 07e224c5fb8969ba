"""Tensile strength and cavity pressure: the limit of a scene, and parameters of the films' FMUs.

`dp_cav` truncates the pressure in the film and remembers nothing. `dp_inception` and `dp_hold` are
the two tensions of a cavity that conserves mass: that at which the full film cavitates, and that
which the cavity then holds.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from attrs import evolve

from ...errors import DescriptionError
from ...separation.effects.viscous import TensionLimit

__all__ = ["TENSIONS", "as_written", "tension_limit", "tension_values"]

TENSIONS = ("dp_cav", "dp_inception", "dp_hold")
"""Parameters that stand for the tension limit of a scene."""

_AMBIENT = 101_325.0  # [Pa]: only differences of pressure count
_SAME = 1e-12  # relative difference of two tensions that are one


def tension_limit(values: Mapping[str, Any]) -> TensionLimit | None:
    """Tension limit that the parameters of an FMU describe; None if there is none.

    Raises
    ------
    DescriptionError
        If two parameters contradict each other.

    Examples
    --------
    >>> none = {"dp_cav": 0.0, "tau_lim": 0.0, "dp_hold": 0.0}
    >>> tension_limit(none | {"dp_inception": 1e6}).cavity_pressure
    -898675.0
    """
    cut, inception, hold = (values[name] for name in TENSIONS)
    if hold > 0.0 and inception == 0.0:
        hint = "set dp_inception, the tension at which the liquid cavitates, or leave out dp_hold"
        raise DescriptionError(
            "dp_hold", hold, "be 0 where dp_inception is 0", unit="Pa", hint=hint
        )
    if hold > inception:
        hint = "a cavity holds no more tension than that of inception; lower dp_hold"
        expected = f"not exceed dp_inception = {inception:g} Pa"
        raise DescriptionError("dp_hold", hold, expected, unit="Pa", hint=hint)
    if inception == 0.0:
        return TensionLimit(strength=cut, cavity="truncated") if cut > 0.0 else None
    for name, what in (("dp_cav", "a truncated pressure"), ("tau_lim", "a limit of shear")):
        if values[name] > 0.0:
            hint = f"a cavity that conserves mass has no {what} beside it; set {name} to 0"
            expected = f"be 0 where {name} is not"
            raise DescriptionError("dp_inception", inception, expected, unit="Pa", hint=hint)
    return TensionLimit(
        strength=inception,
        cavity_pressure=_AMBIENT - (hold or inception),
        ambient_pressure=_AMBIENT,
    )


def as_written(limit: TensionLimit) -> TensionLimit | None:
    """Tension limit as the parameters of an FMU write it, but for its cavity."""
    settled = tension_limit(tension_values(limit) | {"tau_lim": 0.0})
    if settled is None or limit.cavity == "mass-conserving":
        return settled
    return evolve(settled, cavity=limit.cavity)


def tension_values(limit: TensionLimit | None) -> dict[str, float]:
    """Parameters of an FMU for the tension limit of a scene.

    Examples
    --------
    >>> tension_values(TensionLimit(strength=1e6))
    {'dp_cav': 0.0, 'dp_inception': 1000000.0, 'dp_hold': 101325.0}
    """
    found = dict.fromkeys(TENSIONS, 0.0)
    if limit is None:
        return found
    if limit.cavity != "mass-conserving":
        return found | {"dp_cav": limit.tension}
    hold = limit.cavity_drop
    is_one = hold >= limit.tension * (1.0 - _SAME)
    return found | {"dp_inception": limit.tension, "dp_hold": 0.0 if is_one else hold}
