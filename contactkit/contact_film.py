"""The load that a film adds to the one imposed, and how many equilibria there are."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING, NamedTuple

from .contact_engine import Counts, Engine, Target
from .contact_outer import Solved, contact_of, solve_capped
from .contact_plan import ContactPlan
from .effects.film import FilmMeniscus, FilmPart
from .errors import InfeasibleError

if TYPE_CHECKING:
    from .effects.contact_base import Contact

__all__ = ["Pulled", "pulled_together"]

_MOST_ROUNDS = 60


class Pulled(NamedTuple):
    """A contact under its load and the pull of the film."""

    solved: Solved
    contact: Contact
    film: FilmPart


class _Trial(NamedTuple):
    load: float
    excess: float  # imposed load + film force - load on the contact [N]
    solved: Solved
    contact: Contact
    film: FilmPart


def pulled_together(
    plan: ContactPlan, engine: Engine, film: FilmMeniscus, counts: Counts
) -> Pulled:
    """Find the smallest load N on the contact with N = W + F(N), and look for further ones.

    F grows with N, so that steps N <- W + F(N) from W climb to the smallest equilibrium and
    cannot pass it; secants speed them up where they crawl. Then loads above it are tried, by
    factors of four up to W and the pull of a film over the whole window: a change of sign is
    another equilibrium, and more than one means that the bodies snap in when pressed beyond the
    second.

    Raises
    ------
    InfeasibleError
        If there is none: the film pulls the bodies together until they yield everywhere.
    """
    area = plan.grid.area
    assert plan.mean_pressure is not None
    imposed = plan.mean_pressure * area

    def attempt(load: float, start: _Trial | None) -> _Trial:
        at = start.solved.solution.pressure if start is not None else None
        hardness = start.solved.hardness if start is not None else None
        near = hardness if isinstance(hardness, float) else None
        solved = solve_capped(plan, engine, Target(load / area, None, at, near), counts)
        contact = contact_of(plan, engine, solved)
        part = film.observe(contact)
        return _Trial(load, imposed + part.force - load, solved, contact, part)

    found = _smallest(plan, attempt, imposed)
    others = _further(attempt, found, imposed + film.largest_force(plan.scene, plan.grid))
    relative = found.film.force / imposed if imposed > 0.0 else math.inf
    part = found.film._replace(relative_force=relative, equilibria=(found.load, *others))
    return Pulled(found.solved, found.contact, part)


def _smallest(
    plan: ContactPlan, attempt: Callable[[float, _Trial | None], _Trial], imposed: float
) -> _Trial:
    tolerance = max(plan.accuracy.outer_rtol, 1e-9)
    low: _Trial | None = None
    high: _Trial | None = None
    trial = _attempt(attempt, imposed, None, imposed)
    for _ in range(_MOST_ROUNDS):
        if abs(trial.excess) <= tolerance * trial.load:
            return trial
        if trial.excess > 0.0:
            last, low = low, trial
        else:
            last, high = low, trial
        # The force is a sum of pixels: a bracket narrower than the tolerance is a step of it.
        if low is not None and high is not None and high.load - low.load <= tolerance * high.load:
            return high
        load = trial.load + trial.excess
        if high is not None and low is not None and not low.load < load < high.load:
            load = 0.5 * (low.load + high.load)
        elif last is not None and last is not trial and trial.excess > 0.0:
            load = max(load, _secant(last, trial))
            load = min(load, 0.5 * (trial.load + high.load)) if high is not None else load
        trial = _attempt(attempt, load, trial, imposed)
    return trial


def _secant(before: _Trial, now: _Trial) -> float:
    slope = (now.excess - before.excess) / (now.load - before.load)
    return now.load - now.excess / slope if slope < -0.01 else 0.0


def _attempt(
    attempt: Callable[[float, _Trial | None], _Trial], load: float, start: _Trial | None,
    imposed: float,
) -> _Trial:  # fmt: skip
    try:
        return attempt(load, start)
    except InfeasibleError as error:
        raise InfeasibleError(
            f"the film snaps the bodies together: with a load of {imposed:.6g} N no equilibrium "
            f"exists below what they can carry ({error}); use a thinner film, a larger contact "
            "angle or rougher surfaces"
        ) from None


def _further(
    attempt: Callable[[float, _Trial | None], _Trial], found: _Trial, largest: float
) -> tuple[float, ...]:
    """Loads of further equilibria [N], each to the factor of four it was found in."""
    others: list[float] = []
    above, last = False, found
    load = max(4.0 * found.load, 1e-6 * largest)
    while load < largest:
        before = last
        try:
            last = attempt(load, before)
        except InfeasibleError:
            break
        if (last.excess > 0.0) != above:
            others.append((before.load * load) ** 0.5 if before.load > 0.0 else load)
            above = not above
        load *= 4.0
    return (*others, largest) if above and load >= largest else tuple(others)
