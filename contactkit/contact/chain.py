"""Chain of contact solves: each starts from those before it, in the order in which that helps."""

from __future__ import annotations

from collections.abc import Iterable

from ..scene.loading import Approach, ContactLoading, Pressing
from ..scene.scenes import ContactScene
from .effects.base import Attraction
from .plan import ContactPlan
from .result import ContactResult
from .solve import solve_unwarned
from .solver.warm_start import MAX_SOLUTIONS

__all__ = ["ContactChain", "downwards", "loading_of"]


def loading_of(name: str, value: float) -> ContactLoading:
    """Return the loading that imposes a quantity, by its name.

    Examples
    --------
    >>> loading_of("force", 2.0).force
    2.0
    """
    return Approach(approach=value) if name == "approach" else Pressing(**{name: value})


def downwards(values: Iterable[float], scene: ContactScene) -> list[int]:
    """Order in which to solve loads or approaches: from the largest, equal ones as given.

    Under a smaller load pixels only leave the contact, which an extrapolated pressure shows; which
    ones enter it under a larger load, it does not. With an `Attraction`, whose state depends on the
    one before, the order is part of what is asked, and stays.

    Examples
    --------
    >>> import contactkit as ck
    >>> faces = ck.Interface(lower=ck.Flat(radius=1e-3), upper=ck.Flat(radius=1e-3))
    >>> scene = ck.ContactScene(interface=faces, loading=Pressing(force=1.0), effects=())
    >>> downwards([1.0, 3.0, 2.0, 3.0], scene)
    [1, 3, 2, 0]
    """
    given = list(values)
    order = list(range(len(given)))
    return order if scene.effect(Attraction) is not None else sorted(order, key=lambda i: -given[i])


class ContactChain:
    """Contacts solved one after the other, each from the solutions before it.

    It holds the last three results, whose pressures are extrapolated to the next load or approach.
    """

    def __init__(self) -> None:
        self._before: list[ContactResult] = []

    def solve(self, plan: ContactPlan) -> ContactResult:
        """Solve the next contact; the caller reports the validity of the result.

        Raises
        ------
        ConvergenceError, InfeasibleError
            As `solve` does.
        """
        before = [one for one in self._before if one.pressure.shape == plan.grid.shape]
        result = solve_unwarned(plan, start=before)
        if result.pressure.any() or plan.scene.effect(Attraction) is not None:
            self._before = [result, *before][:MAX_SOLUTIONS]
        return result

    def change_interface(self) -> None:
        """Keep the last pressure only: the next contact is of other bodies."""
        del self._before[1:]
