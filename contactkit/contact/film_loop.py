"""Contact whose load includes the force of a liquid film: its equilibria."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Generic, NamedTuple, TypeVar

from ..errors import InfeasibleError
from .effects.base import Balance, Contact, LoadTerm
from .friction_loop import Target
from .hardness_loop import Solved, contact_of, solve_with_hardness
from .plan import ContactPlan
from .work import WorkCounter

__all__ = ["Pulled", "pulled_together"]

_MAX_ITERATIONS = 60
_MAX_IMBALANCE = 0.05  # of the load, at a step of the force


Part = TypeVar("Part")


class Pulled(NamedTuple, Generic[Part]):
    """A contact under its load and the force that adds to it."""

    solved: Solved
    contact: Contact
    part: Part


class _Trial(NamedTuple, Generic[Part]):
    load: float
    excess: float  # imposed load + force - load on the contact [N]
    solved: Solved
    contact: Contact
    part: Part


_Attempt = Callable[[float, _Trial[Part] | None], _Trial[Part] | None]


def pulled_together(
    plan: ContactPlan,
    term: LoadTerm[Part],
    mean_pressure: float,
    target: Target,
    counter: WorkCounter,
) -> Pulled[Part]:
    """Find the smallest load N on the contact with N = W + F(N), and look for further ones.

    Fixed-point steps N <- W + F(N) climb from the imposed load W, accelerated by secants where
    they are slow, inside a bracket that always exists: a film cannot pull harder than over the
    whole window, and where the bodies touch everywhere it does not pull at all. The force is a sum
    over pixels and has steps: if the two sides meet at one, N is there, and `Balance.imbalance` is
    its height. Then loads above N are tried, by factors of four: a change of sign is another
    equilibrium, and more than one means that the bodies snap in when pressed beyond the second. A
    film that repels carries part of W: it pushes the harder the closer the bodies are, so that one
    load below W balances, if the film does not carry all of W where the bodies first touch.
    """
    area = plan.grid.area
    imposed = mean_pressure * area

    def attempt(load: float, start: _Trial[Part] | None) -> _Trial[Part] | None:
        near = target._replace(mean_pressure=load / area)
        if start is not None:
            hardness = start.solved.hardness if isinstance(start.solved.hardness, float) else None
            near = near._replace(start=start.solved.solution.pressure, hardness=hardness)
        try:
            solved = solve_with_hardness(plan, near, counter)
        except InfeasibleError:  # beyond what the hardness there can carry
            return None
        contact = contact_of(plan, solved)
        part = term.observe(contact)
        return _Trial(load, imposed + term.force_of(part) - load, solved, contact, part)

    first = attempt(imposed, None)
    if first is None:
        raise InfeasibleError(
            f"the bodies cannot carry the load of {imposed:.6g} N at the hardness that its "
            "displacement leads to; lower the load"
        )
    others: tuple[float, ...] = ()
    if first.excess < 0.0:
        found, is_settled = _pushed_apart(plan, attempt, first)
    else:
        largest = imposed + term.largest_force(first.contact)
        if plan.hardness is not None:
            largest = min(largest, plan.hardness.highest * area * (1.0 - 1e-6))
        found, is_settled = _smallest(plan, attempt, first, largest)
        others = _further(attempt, found, largest)
    # At a step of the force the balance says how much of it acts.
    force = found.load - imposed if found.load != imposed else term.force_of(found.part)
    gap = abs(found.excess) / found.load if found.load > 0.0 else 0.0
    relative = force / imposed if imposed > 0.0 else math.inf
    part = term.balanced(found.part, Balance(force, relative, (found.load, *others), gap))
    solved = found.solved
    if gap > _MAX_IMBALANCE and is_settled and not solved.problem:
        solved = solved._replace(problem=_step(found, gap))
    elif not is_settled and not solved.problem:
        solved = solved._replace(problem=_unsettled(gap))
    return Pulled(solved, found.contact, part)


def _step(found: _Trial[Part], gap: float) -> str:
    return (
        f"the force of the film steps over the balance at a load of {found.load:.6g} N, which "
        f"it misses by {100.0 * gap:.2g} %: its menisci are a few pixels wide; use a finer "
        "Accuracy.grid or a smaller window"
    )


def _unsettled(gap: float) -> str:
    return (
        f"the load and the force of the film still differ by {gap:.2g} of the load after "
        f"{_MAX_ITERATIONS} iterations; use a larger Accuracy.rtol, or FilmMeniscus without "
        "self_consistent"
    )


def _smallest(
    plan: ContactPlan, attempt: _Attempt[Part], first: _Trial[Part], largest: float
) -> tuple[_Trial[Part], bool]:
    """The smallest load that balances, and whether the iterations settled on it."""
    tolerance = max(plan.accuracy.outer_rtol, 1e-9)
    low, high, top = first, None, largest
    before = None
    for _ in range(_MAX_ITERATIONS):
        best = low if high is None or abs(low.excess) < abs(high.excess) else high
        if abs(best.excess) <= tolerance * best.load or top - low.load <= tolerance * top:
            return best, True
        load = low.load + low.excess
        if before is not None:
            load = max(load, _secant(before, low))
        if high is not None or load >= top:
            load = min(load, 0.5 * (low.load + top))
        trial = attempt(load, low)
        if trial is None or trial.excess < 0.0:
            high, top = trial or high, load
        else:
            before, low = low, trial
    return best, False


def _secant(before: _Trial[Part], now: _Trial[Part]) -> float:
    """Zero of the line through two trials, at most four fixed-point steps ahead."""
    slope = (now.excess - before.excess) / (now.load - before.load)
    ahead = now.excess / max(-slope, 0.25)
    return now.load + ahead


def _pushed_apart(
    plan: ContactPlan, attempt: _Attempt[Part], first: _Trial[Part]
) -> tuple[_Trial[Part], bool]:
    """The load between none and the imposed one that a film which repels leaves to the contact."""
    tolerance = max(plan.accuracy.outer_rtol, 1e-9)
    low, high = attempt(0.0, None), first
    if low is None or low.excess <= 0.0:
        # Where the bodies touch without a load, the force is all that is out of balance.
        push = first.load - low.excess if low is not None else math.inf
        raise InfeasibleError(
            f"the film pushes the bodies apart with {push:.6g} N where they first touch, and the "
            f"load is {first.load:.6g} N: they float on it; raise the load, lower the contact "
            "angles or the film_thickness, or use FilmMeniscus without self_consistent"
        )
    halves = False  # where secants do not, as at a step of the force
    for _ in range(_MAX_ITERATIONS):
        best = min(low, high, key=lambda trial: abs(trial.excess))
        width = high.load - low.load
        if abs(best.excess) <= tolerance * best.load or width <= tolerance * high.load:
            return best, True
        share = 0.5 if halves else low.excess / (low.excess - high.excess)
        trial = attempt(low.load + share * width, high)
        if trial is None:
            break
        low, high = (low, trial) if trial.excess < 0.0 else (trial, high)
        halves = not halves and high.load - low.load > 0.5 * width
    return best, False


def _further(attempt: _Attempt[Part], found: _Trial[Part], largest: float) -> tuple[float, ...]:
    """Loads of further equilibria [N], each to the factor of four it was found in."""
    others: list[float] = []
    above, last = False, found
    load = max(4.0 * found.load, 1e-6 * largest)
    while load < largest:
        trial = attempt(load, last)
        if trial is None:
            break
        if (trial.excess > 0.0) != above:
            others.append((last.load * load) ** 0.5 if last.load > 0.0 else load)
            above = not above
        last, load = trial, 4.0 * load
    return (*others, largest) if above else tuple(others)
