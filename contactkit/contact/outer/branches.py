r"""States of a contact with an attraction: which of several the iteration ends at.

.. math:: p = q - t, \qquad t = \tau(g), \qquad q \ge 0

For a given tension t the pressure q of contact is that of a contact without attraction, of the
heights :math:`h + G t` and, if there is one, the hardness :math:`H + t`; under a load it carries
the load and the tension. The energy of attraction is concave in the gap, so that every step
:math:`t \leftarrow \tau(g(t))` lowers the energy; it ends at a stable state for any grid.

Where a pressure lowers the surface everywhere (isolated contacts), more tension narrows every gap:
the steps only rise from no tension to the state of an approach, or only fall from the state of a
smaller gap to that of a separation. They are accelerated by momentum, which starts afresh whenever
the iterates turn round; a third to a half of the steps remain. In a periodic window with a mean
plane that is held, states are not ordered and momentum could choose among those after a jump:
there a state far from the start is that of the plain steps.

A load may pull: then the steps fall from the state of the bodies at rest under no load. Without
contact no state under a load is stable, as the tension falls when the gap opens; where tension and
pull leave no load to the contact, the bodies have been pulled off.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ...errors import InfeasibleError
from .iteration import Outer, Separated, Settled, settle_unknowns
from .tension import Tension
from .unknown import Target

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Map = NDArray[np.float64]

__all__ = ["settle_attracted"]

_SMOOTH = 0.1  # change of the tension over its maximum, from one state to the next without a jump
_PULL_OFF = 1e-2  # error of the pull-off force in a refusal
_MAX_HALVINGS = 20  # of the pull; seven reach `_PULL_OFF`


def settle_attracted(outer: Outer, target: Target, bound: Map | float | None) -> Settled:
    """Solve a contact with an attraction, from no tension or from that of a state before.

    Parameters
    ----------
    outer : Outer
        The contact; one of its unknowns is a `Tension`.
    target : Target
        Load or approach; the tension of its `unknowns`, if any, decides on the branch: without one,
        the surfaces come together.
    bound : float or ndarray, optional
        Bound of the pressure [Pa] that is no unknown.

    Raises
    ------
    InfeasibleError
        If the load pulls the bodies off; names the pull-off force.
    """
    begun = _begun(outer, target, bound)
    settled = _settled(outer, begun, bound)
    # Momentum may also carry the iterates past the last state before the pull-off.
    if settled is None or not _is_reached(outer, settled, begun):
        settled = _settled(outer, begun, bound, has_momentum=False)
    if settled is None:
        raise _pulled_off(outer, begun, bound, target)
    return settled


def _settled(
    outer: Outer, target: Target, bound: Map | float | None, *, has_momentum: bool = True
) -> Settled | None:
    """State that the iterates from a start end at; None if the load pulls the bodies off."""
    try:
        return settle_unknowns(outer, target, bound, has_momentum=has_momentum)
    except Separated:
        return None


def _begun(outer: Outer, target: Target, bound: Map | float | None) -> Target:
    """Target with the tension and the pressure of contact to start from."""
    alone, load = target._replace(start=target.pressure), target.mean_pressure
    if Tension.name in target.unknowns:
        return alone
    if load is None or load >= 0.0:
        return alone
    at_rest = _settled(outer, alone._replace(mean_pressure=0.0), bound)
    return _from(alone, at_rest) if at_rest is not None else alone


def _from(target: Target, settled: Settled) -> Target:
    """Target that starts from a settled state."""
    start = settled.contact.solution.pressure
    return target._replace(start=start, unknowns=settled.values)


def _is_reached(outer: Outer, settled: Settled, begun: Target) -> bool:
    """Whether the state is that of the plain iterates, wherever momentum carried them.

    Where a mean plane is held, more tension here opens gaps there: after a jump, which changes the
    tension somewhere by more than a smooth step does, momentum may end in another state.
    """
    plan = outer.plan
    is_held = begun.mean_pressure is None and plan.grid.periodic
    if not is_held or plan.prepared.solver.uniform_compliance:
        return True
    tension = next(one for one in outer.unknowns if isinstance(one, Tension))
    change = np.abs(settled.values[Tension.name] - tension.first(begun))
    return float(change.max()) <= _SMOOTH * tension.law.strength


def _pulled_off(
    outer: Outer, begun: Target, bound: Map | float | None, target: Target
) -> InfeasibleError:
    """Find the pull-off force, by halving, from the state to start from; say that it is exceeded.

    Every smaller pull is carried, as the tension only falls as the pull grows.
    """
    area, pull = outer.plan.grid.area, -float(target.mean_pressure or 0.0)
    first = begun.unknowns.get(Tension.name)
    carried, too_much = 0.0, min(pull, 0.0 if first is None else float(first.mean()))
    for _ in range(_MAX_HALVINGS):
        if too_much - carried <= _PULL_OFF * too_much:
            break
        trial = 0.5 * (carried + too_much)
        settled = _settled(outer, begun._replace(mean_pressure=-trial), bound)
        if settled is None or settled.problem:
            too_much = trial
        else:
            carried, begun = trial, _from(begun, settled)
    has_start = Tension.name in target.unknowns
    where = "the state to start from" if has_start else "a contact under no load"
    return InfeasibleError(
        f"a pull of {pull * area:.6g} N exceeds the pull-off force, about {carried * area:.3g} N "
        f"from {where}: the bodies separate; pull less, or impose an Approach"
        + ("" if has_start else "; rough bodies pressed before, start=, may hold more")
    )
