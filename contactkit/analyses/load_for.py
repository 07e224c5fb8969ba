"""Load at which a contact reaches a given number: area of contact, first yield."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Literal, NamedTuple

from ..contact.chain import ContactChain
from ..contact.effects.plasticity import HardnessLimit
from ..contact.plan import ContactPlan
from ..contact.result import ContactResult
from ..errors import DescriptionError, InfeasibleError, PlanError
from ..scene.loading import Pressing
from ..scene.plan import check_plan
from .subsurface import stress_below

__all__ = ["LoadFor", "load_for_contact_fraction", "load_of_first_yield"]

_FEWEST, _MOST = 1e-12, 1.0  # mean pressure over E*, between which loads are looked for
_SOLVES = 60  # contacts at most: a bracket takes 8, halving it to 1e-12 another 41


class LoadFor(NamedTuple):
    """Load at which a contact reaches a number.

    `mean_pressure` [Pa] and `load` [N]; `value` of the number that was reached there, and the
    solved contact.
    """

    mean_pressure: float
    load: float
    value: float
    result: ContactResult


def load_for_contact_fraction(plan: ContactPlan, fraction: float, rtol: float = 1e-2) -> LoadFor:
    """Load at which the real area of contact is a fraction of the window.

    Parameters
    ----------
    plan : ContactPlan
        The contact; its own loading is not used.
    fraction : float
        Fraction of the window [-], above 0 and below 1.
    rtol : float
        Tolerance of the load. The area is a count of pixels, and steps.

    Raises
    ------
    DescriptionError
        If the fraction is impossible.
    InfeasibleError
        If no load up to the plane-strain modulus reaches it.

    Examples
    --------
    >>> import contactkit as ck
    >>> steel = ck.Material(young_modulus=210e9, poisson_ratio=0.3)
    >>> wave = ck.Wave(amplitude=1e-8, wavelength=1e-6)
    >>> scene = ck.ContactScene(
    ...     interface=ck.Interface(lower=ck.Body(solid=steel), upper=ck.Body(surface=wave)),
    ...     window=ck.Window(width=1e-6),
    ...     loading=ck.Pressing(pressure=1e6),
    ...     effects=(ck.HalfSpace(),),
    ... )
    >>> found = load_for_contact_fraction(ck.plan(scene, ck.Accuracy(grid=64)), 0.5)
    >>> found.result.contact_fraction  # the first count of pixels at or above
    0.515625
    """
    check_plan(plan, ContactPlan)
    if not 0.0 < fraction < 1.0:
        raise DescriptionError("fraction", fraction, "lie above 0 and below 1", unit="-")
    return _found(plan, lambda result: result.contact_fraction / fraction, rtol)


def load_of_first_yield(
    plan: ContactPlan,
    limit: float,
    measure: Literal["pressure", "von_mises", "tresca"] = "pressure",
    rtol: float = 1e-3,
) -> LoadFor:
    """Load at which a contact yields first.

    Parameters
    ----------
    plan : ContactPlan
        The contact, without `HardnessLimit`; its own loading is not used.
    limit : float
        Hardness for the pressure, yield strength for the stress of von Mises, yield strength in
        shear for the largest shear stress [Pa].
    measure : {"pressure", "von_mises", "tresca"}
        What is compared: the maximum pressure, or the maximum of the stress below the surface with
        the friction of the scene.
    rtol : float
        Tolerance of the load.

    Raises
    ------
    DescriptionError
        If the limit is not positive, or there is no such measure.
    PlanError
        If the scene has a `HardnessLimit`, below which the pressure stays.
    InfeasibleError
        If no load up to the plane-strain modulus reaches the limit.

    Examples
    --------
    >>> import contactkit as ck
    >>> steel = ck.Material(young_modulus=210e9, poisson_ratio=0.3)
    >>> scene = ck.ContactScene(
    ...     interface=ck.Interface(
    ...         lower=ck.Body(solid=steel), upper=ck.Body(surface=ck.Paraboloid(radius=1e-3))
    ...     ),
    ...     window=ck.Window(width=60e-6, periodic=False),
    ...     loading=ck.Pressing(force=0.2),
    ...     effects=(ck.HalfSpace(),),
    ... )
    >>> found = load_of_first_yield(ck.plan(scene, ck.Accuracy(grid=32)), 1e9, "von_mises", 5e-3)
    >>> bool(abs(found.result.max_pressure / 1e9 - 1 / 0.62) < 0.01)  # 0.62 p0, Johnson
    True
    """
    check_plan(plan, ContactPlan)
    if not limit > 0.0:
        raise DescriptionError("limit", limit, "be positive", unit="Pa")
    if plan.has(HardnessLimit):
        raise PlanError("load_of_first_yield needs a scene without HardnessLimit: leave it out")
    if measure == "pressure":
        return _found(plan, lambda result: result.max_pressure / limit, rtol)
    if measure not in ("von_mises", "tresca"):
        raise DescriptionError("measure", measure, "be pressure, von_mises or tresca")
    return _found(plan, lambda result: stress_below(result).maxima[measure].value / limit, rtol)


def _found(plan: ContactPlan, of: Callable[[ContactResult], float], rtol: float) -> LoadFor:
    """Load at which a growing number is 1: secants in logarithms inside a bracket, or halving."""
    stacks = plan.scene.interface.stacks
    modulus = min(
        max(one.at_rate(math.inf).plane_strain_modulus for one in stack.materials)
        for stack in stacks
    )
    chain = ContactChain()

    def at(p: float) -> LoadFor:
        result = chain.solve(plan.with_loading(Pressing(pressure=p)))
        return LoadFor(p, p * plan.grid.area, of(result), result)

    low: LoadFor | None = None
    high: LoadFor | None = None
    p, last = 1e-5 * modulus, math.inf
    for _ in range(_SOLVES):
        tried = at(p)
        if tried.value == 1.0:
            return tried
        if tried.value < 1.0:
            low = tried
        else:
            high = tried
        if low is None or high is None:
            p *= 8.0 if high is None else 0.125
            if not _FEWEST * modulus < p < _MOST * modulus:
                break
            continue
        if high.mean_pressure <= low.mean_pressure * (1.0 + rtol):
            return high
        width = math.log(high.mean_pressure / low.mean_pressure)
        halves = width <= 0.5 * last
        last = width
        p = low.mean_pressure * math.exp(width * (_secant(low, high, rtol) if halves else 0.5))
    raise InfeasibleError(
        f"no mean pressure between {_FEWEST * modulus:.3g} and {_MOST * modulus:.3g} Pa reaches "
        "the number; check its unit"
    )


def _secant(low: LoadFor, high: LoadFor, rtol: float) -> float:
    """Zero of the secant in logarithms, as a fraction of the bracket; off its ends by a bit."""
    if low.value <= 0.0:
        return 0.5
    fraction = -math.log(low.value) / math.log(high.value / low.value)
    margin = min(0.5 * rtol / math.log(high.mean_pressure / low.mean_pressure), 0.5)
    fraction += margin if fraction < 0.5 else -margin  # so that the other end moves next
    return min(max(fraction, margin), 1.0 - margin)
