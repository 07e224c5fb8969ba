"""One hardness for all pixels, that of the largest displacement: a balance in a bracket."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ...numerics.roots import Bracket, Probe
from .iteration import Settled, settle_balance, unsettled
from .local_hardness import too_soft
from .tension import on_branch_of
from .unknown import HeldContact, Target

if TYPE_CHECKING:
    from collections.abc import Callable

    from ..effects.base import VaryingHardness
    from ..plan import ContactPlan

__all__ = ["settle_hardness"]


def settle_hardness(
    plan: ContactPlan,
    law: VaryingHardness,
    target: Target,
    settle: Callable[[Target, float], Settled],
) -> tuple[Settled, float]:
    """Find the hardness [Pa] that belongs to the largest displacement under it.

    Parameters
    ----------
    plan : ContactPlan
        Gives the displacement of each body.
    law : VaryingHardness
        Hardness over the largest displacements.
    target : Target
        Load or approach; its hardness, if known, is the first that is tried, else the highest.
    settle : callable
        Contact of a target under a hardness.

    Raises
    ------
    InfeasibleError
        If the load exceeds what the hardness at the displacement reached carries.

    Notes
    -----
    Steps H <- law(u(H)), and secants once two are known; the bracket keeps them from cycling. One
    that closes on no balance of a law that jumps is a jump, and is reported as one.
    """
    load, tolerance = target.mean_pressure, plan.accuracy.outer_rtol
    low = law.lowest if load is None else max(law.lowest, load * (1.0 + 1e-9))
    bracket: Bracket[Settled] = Bracket(low, law.highest)
    near = target

    def probe(hardness: float, excess: float = 0.0) -> Probe[Settled]:
        nonlocal near
        settled = settle(near, hardness)
        start, values = settled.contact.solution.pressure, on_branch_of(target, settled.values)
        near = target._replace(start=start, unknowns=values)
        found = _at_largest_displacement(plan, settled.contact, law)
        return Probe(hardness, found - hardness, settled, bool(settled.problem))

    known = target.hardness
    first = probe(known if known is not None and low < known < law.highest else law.highest)
    bracket.take(first)
    if first.is_final:
        return first.value, first.at
    is_settled = settle_balance(probe, bracket, _guess, tolerance)
    last = bracket.last[0]
    if last.is_final:
        return last.value, last.at
    best = bracket.best
    if abs(best.excess) <= tolerance * best.at:
        return best.value, best.at
    return last.value._replace(problem=_problem(plan, law, load, bracket, is_settled)), last.at


def _guess(bracket: Bracket[Settled]) -> float:
    """Zero of the line through the last two, else the hardness that the last one leads to."""
    now, *before = bracket.last
    step = now.at + now.excess
    for other in before:
        turned = other.excess - now.excess
        zero = now.at - now.excess * (other.at - now.at) / turned if turned else step
        if bracket.low < zero < bracket.high:
            return zero
    return step


def _at_largest_displacement(
    plan: ContactPlan, contact: HeldContact, law: VaryingHardness
) -> float:
    """Hardness [Pa] at the largest displacement of each body under contact."""
    bodies = plan.prepared.displacements(contact.pressure, contact.displacement)
    largest = tuple(np.asarray(u[contact.touching].max(initial=0.0)) for u in bodies)
    return float(law.at(largest))


def _problem(
    plan: ContactPlan,
    law: VaryingHardness,
    load: float | None,
    bracket: Bracket[Settled],
    is_settled: bool,
) -> str:
    """State why no hardness balances; empty where the bracket has closed on a steep law."""
    found = bracket.last[0].at + bracket.last[0].excess
    if not is_settled:
        width = f"{bracket.high / bracket.low - 1.0:.2g} of itself"
        cure = "use a larger Accuracy.rtol"
        return unsettled("hardness", width, plan.accuracy.outer_rtol, cure)
    if load is not None and found < load:
        raise too_soft(load, found, plan.grid.area)
    if not law.has_jumps:
        return ""
    return (
        f"the hardness rule jumps: no hardness between {bracket.low:.6g} and {bracket.high:.6g} Pa "
        f"agrees with the displacement it leads to (which gives {found:.6g} Pa); use "
        "HardnessLimit(rule='continuous'), or another load"
    )
