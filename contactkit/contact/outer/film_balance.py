"""Load on a contact that a liquid film adds to: the balances of load, film and bodies."""

from __future__ import annotations

import math
from typing import Generic, NamedTuple, TypeVar

import numpy as np
from attrs import evolve

from ...accuracy import Accuracy
from ...errors import InfeasibleError
from ...numerics.roots import Bracket, Probe
from ..companion import coarser, largest_factor
from ..effects.base import (
    Balance,
    Compliance,
    FixedHardness,
    LoadTerm,
    PressureBound,
    SolvedContact,
)
from ..plan import ContactPlan
from ..solver.warm_start import MAX_SOLUTIONS
from ..work import WorkCounter
from .iteration import settle_balance, unsettled
from .step import Solved, Step
from .unknown import Target

__all__ = ["film_companion", "solve_under_load", "to_last_pixel"]

# Measured on a rough contact of 96 x 96 pixels whose film pulls as well, under five loads from
# 0.03 to 10 MPa: 1162 applications of the operator in all.
_MAX_IMBALANCE = 0.05  # of the load, at a step of the force: beyond, no contact is a balance
# Tolerance of contacts far from the balance, and of each over the imbalance of the one before: a
# force that is off by less has the right sign. Tighter by a hundred times either takes 15 to 17 %
# more applications; looser, 4 to 7 % fewer, and pixels at the edge of a meniscus may be wrong.
_LOOSE, _AHEAD = 1e-4, 1e-3
# Imbalance over tolerance of the contact above which its sign is certain: 1000 takes 7 % more, 10
# takes as many.
_OUTER = 100.0
# Ratio of loads between which the contact may be interpolated: 1.02 takes 3 % more, 1.5 as many.
_NARROW = 1.1
# Contacts of which the nearest are the initial guess of the next: 1 takes 17 % more, 20 takes 3 %
# fewer, each a map in memory.
_KEPT = 5
# Pixels along a side of the companion on which further equilibria are looked for: coarser, a step
# of one pixel is a step of the force that the map itself does not have.
_FEWEST = 96
_COMPANION = Accuracy(rtol=1e-3)
_PIXEL_RTOL = 1e-8  # to which single pixels of a film are known: at 1e-7 some differ, measured
# Of the load, to either side of a balance, where others are looked for. 0.01 takes 4 % fewer
# applications, 0.2 takes 1 % more.
_AROUND = 0.05
_SAMPLES = 64  # loads in that range, of interpolated contacts: none is solved


Part = TypeVar("Part")


class _Trial(NamedTuple, Generic[Part]):
    """A contact under a load [N], and its imbalance: imposed load + force - load on it [N].

    `rtol` is the tolerance that the contact was solved to, or what was reached.
    """

    load: float
    excess: float
    rtol: float
    solved: Solved
    part: Part


class _Search(Generic[Part]):
    """A step, the force that adds to its load, and the contacts solved so far, newest first."""

    def __init__(self, step: Step, term: LoadTerm[Part], imposed: float, target: Target) -> None:
        self.step, self.plan, self.term, self.imposed = step, step.plan, term, imposed
        self.target, accuracy = target, step.plan.accuracy
        self.rtol, self.tolerance = accuracy.rtol, max(accuracy.outer_rtol, 1e-9)
        hardness = step.plan.hardness
        varies = hardness is not None and not isinstance(hardness, FixedHardness)
        self.is_iterated = varies or step.has_unknowns
        self.trials: list[_Trial[Part]] = []

    def probe(self, load: float, excess: float) -> Probe[_Trial[Part]] | None:
        """Contact under a load, as a probe of the balance; `excess` is the least so far [N]."""
        trial = self.attempt(load, _AHEAD * excess)
        return None if trial is None else Probe(load, trial.excess, trial)

    def bracket(
        self, low: _Trial[Part], high: float, above: _Trial[Part] | None = None
    ) -> Bracket[_Trial[Part]]:
        """Bracket between a contact that carries too little and a load that is too much."""
        made: Bracket[_Trial[Part]] = Bracket(low.load, high)
        for one in (low, above):
            if one is not None:
                made.take(Probe(one.load, one.excess, one))
        return made

    def attempt(self, load: float, error: float) -> _Trial[Part] | None:
        """Contact under a load, its imbalance known to an error [N], and at least in its sign.

        None beyond what the hardness can carry.
        """
        loose = max(_LOOSE, self.rtol)
        rtol = min(max(error / load, self.rtol), loose) if load > 0.0 else self.rtol
        while True:
            trial = self._solved(load, rtol)
            if trial is None or trial.rtol <= self.rtol or trial.solved.problem:
                return trial
            imbalance = abs(trial.excess) / load
            if imbalance > _OUTER * trial.rtol:
                return trial
            rtol = max(self.rtol, min(imbalance / _OUTER, 0.1 * rtol))

    def finished(self, trial: _Trial[Part]) -> _Trial[Part]:
        """Solve a contact to the tolerance of the plan, if it is not yet."""
        if trial.rtol <= self.rtol or trial.solved.problem:
            return trial
        return self._solved(trial.load, self.rtol) or trial

    def _solved(self, load: float, rtol: float) -> _Trial[Part] | None:
        try:
            solved = self.step.to(rtol).solve(self._near(load))
        except InfeasibleError:
            return None
        part = self.term.observe(solved.contact)
        excess = self.imposed + self.term.force_of(part) - load
        reached = rtol if self.is_iterated else solved.solution.kkt
        trial = _Trial(load, excess, reached, solved, part)
        if load > 0.0:
            others = [one for one in self.trials if one.load != load]
            self.trials = [trial, *others][:_KEPT]
        return trial

    def between(self, low: _Trial[Part], high: _Trial[Part], at: float) -> Part:
        """Return the force in the contact interpolated between two."""
        influence = self.plan.prepared.solver.self_influence
        return self.term.observe(
            _interpolated(low.solved.contact, high.solved.contact, at, influence)
        )

    def _near(self, load: float) -> Target:
        """Where the solve under a load begins: from the contacts under the nearest loads."""
        area = self.plan.grid.area
        target = self.target._replace(mean_pressure=load / area)
        if not self.trials or load <= 0.0:
            return target
        nearest = sorted(self.trials, key=lambda one: abs(math.log(one.load / load)))
        pairs = [(one.load / area, one.solved.solution.pressure) for one in nearest]
        near = nearest[0].solved.near(target)
        known = near.hardness if near.hardness is not None else target.hardness
        return near._replace(start=pairs[:MAX_SOLUTIONS], hardness=known)


def solve_under_load(step: Step, term: LoadTerm[Part], target: Target) -> Solved:
    """Find the smallest load N on the contact with N = W + F(N), and look for further ones.

    Fixed-point steps N <- W + F(N) climb from the imposed load W, accelerated by secants where
    they are slow, inside a bracket that always exists: a film cannot pull harder than over the
    whole window, and where the bodies touch everywhere it does not pull at all. The force is a sum
    over pixels and has steps: if the two sides meet at one, N is there, and `Balance.imbalance` is
    its height. Contacts far from the balance are solved to a loose tolerance, the last one to that
    of the plan.

    Then loads above N are tried, by factors of four, on a companion of about a hundred pixels
    along a side: a change of sign is another equilibrium, and more than one means that the bodies
    snap in when pressed beyond the second. A film that repels carries part of W: it pushes the
    harder the closer the bodies are, so that one load below W balances, if the film does not carry
    all of W where the bodies first touch.
    """
    imposed = (target.mean_pressure or 0.0) * step.plan.grid.area
    plan = step.plan
    search = _Search(step, term, imposed, target)
    first = search.attempt(imposed, _LOOSE * imposed)
    if first is None:
        raise InfeasibleError(
            f"the bodies cannot carry the load of {imposed:.6g} N at the hardness that its "
            "displacement leads to; lower the load"
        )
    others: tuple[float, ...] = ()
    if first.excess < 0.0:
        found, is_settled = _pushed_apart(search, first)
    else:
        largest = imposed + term.largest_force(first.solved.contact)
        if plan.hardness is not None:
            largest = min(largest, plan.hardness.highest * plan.grid.area * (1.0 - 1e-6))
        found, is_settled = _smallest(search, first, largest)
        others = _further(search, found, largest)
    # At a step of the force the balance says how much of it acts.
    force = found.load - imposed if found.load != imposed else term.force_of(found.part)
    gap = abs(found.excess) / found.load if found.load > 0.0 else 0.0
    relative = force / imposed if imposed > 0.0 else math.inf
    error = max(gap, _farthest_balance(search, found))
    balance = Balance(force, relative, (found.load, *others), gap, error)
    part = term.balanced(found.part, balance)
    solved = found.solved
    if gap > _MAX_IMBALANCE and is_settled and not solved.problem:
        solved = solved._replace(problem=_step(found, gap))
    elif not is_settled and not solved.problem:
        solved = solved._replace(problem=_unsettled(gap, search.tolerance))
    return solved._replace(parts={**solved.parts, type(term): part})


def _step(found: _Trial[Part], gap: float) -> str:
    return (
        f"the force of the film steps over the balance at a load of {found.load:.6g} N, which "
        f"it misses by {100.0 * gap:.2g} %: its menisci are a few pixels wide; use a finer "
        "Accuracy.grid or a smaller window"
    )


def _unsettled(gap: float, tolerance: float) -> str:
    return unsettled(
        "load with the force of the film",
        f"{gap:.2g} of itself",
        tolerance,
        "use a larger Accuracy.rtol, or FilmMeniscus without self_consistent",
    )


def _smallest(
    search: _Search[Part], first: _Trial[Part], largest: float
) -> tuple[_Trial[Part], bool]:
    """The smallest load that balances, and whether the iterations settled on it."""
    bracket, narrow = search.bracket(first, largest), _Narrowing(search)

    def guess(now: Bracket[_Trial[Part]]) -> float:
        if now.above is not None and now.above.at < _NARROW * now.low:
            return narrow.guess(now)
        return _climbed(now)

    is_settled = settle_balance(search.probe, bracket, guess, search.tolerance)
    return search.finished(bracket.best.value), is_settled


def _climbed(bracket: Bracket[_Trial[Part]]) -> float:
    """A step of the fixed point from below, or a secant ahead of it."""
    low = bracket.below
    assert low is not None
    load = low.at + low.excess
    if bracket.before is not None:
        load = max(load, _secant(bracket.before, low))
    if bracket.above is not None or load >= bracket.high:
        load = min(load, 0.5 * (low.at + bracket.high))
    return load


def _secant(before: Probe[_Trial[Part]], now: Probe[_Trial[Part]]) -> float:
    """Zero of the line through two probes, at most four fixed-point steps ahead."""
    slope = (now.excess - before.excess) / (now.at - before.at)
    ahead = now.excess / max(-slope, 0.25)
    return now.at + ahead


def _pushed_apart(search: _Search[Part], first: _Trial[Part]) -> tuple[_Trial[Part], bool]:
    """The load between none and the imposed one that a film which repels leaves to the contact."""
    low = search.attempt(0.0, search.rtol)
    if low is None or low.excess <= 0.0:
        # Where the bodies touch without a load, the force is all that is out of balance.
        push = first.load - low.excess if low is not None else math.inf
        raise InfeasibleError(
            f"the film pushes the bodies apart with {push:.6g} N where they first touch, and the "
            f"load is {first.load:.6g} N: they float on it; raise the load, lower the contact "
            "angles or the film_thickness, or use FilmMeniscus without self_consistent"
        )
    bracket, narrow = search.bracket(low, first.load, first), _Narrowing(search)
    is_settled = settle_balance(search.probe, bracket, narrow.guess, search.tolerance)
    return search.finished(bracket.best.value), is_settled


class _Narrowing(Generic[Part]):
    """Guesses of a balance between two loads that are both known.

    The next load is where the contact interpolated between the two balances; every step of the
    force between them is seen there without a solve. Far apart it is the zero of the line
    through both; where neither halves the interval, it is the middle.
    """

    def __init__(self, search: _Search[Part]) -> None:
        self._search, self._width, self._halved = search, math.inf, False

    def guess(self, bracket: Bracket[_Trial[Part]]) -> float:
        """Load [N] to try next."""
        low, high = bracket.below, bracket.above
        if low is None or high is None:
            return math.nan  # the middle
        width = bracket.high - bracket.low
        self._halved = not self._halved and width > 0.5 * self._width
        self._width = width
        if self._halved:
            return bracket.low + 0.5 * width
        if high.at < _NARROW * low.at:
            return _interpolated_balance(self._search, low.value, high.value)
        return low.at + (high.at - low.at) * low.excess / (low.excess - high.excess)


def _farthest_balance(search: _Search[Part], found: _Trial[Part]) -> float:
    """Distance of the farthest load nearby that balances as well, over the load of the balance.

    A film that pulls about as much harder as the load grows leaves a balance that is flat, and
    every pixel that is wetted or dries then makes one of its own. They are looked for in the
    contact interpolated between two loads around the balance. Zero where none is looked for.
    """
    if search.rtol > _PIXEL_RTOL or found.load <= 0.0 or found.solved.problem:
        return 0.0
    ends = [search.attempt(found.load * (1.0 + s * _AROUND), search.rtol) for s in (-1.0, 1.0)]
    low, high = ends
    if low is None or high is None:
        return 0.0
    farthest = 0.0
    for at in (2.0 * (i + 0.5) / _SAMPLES - 1.0 for i in range(_SAMPLES)):
        part = search.between(low, high, 0.5 * (1.0 + at))
        load = found.load * (1.0 + at * _AROUND)
        is_light = search.imposed + search.term.force_of(part) > load
        if is_light == (at > 0.0):  # beyond the balance the contact carries too little, before it
            farthest = max(farthest, abs(at) * _AROUND)  # too much: there is another one beyond
    return farthest


def _interpolated_balance(search: _Search[Part], low: _Trial[Part], high: _Trial[Part]) -> float:
    """Load [N] at which the contact interpolated between two loads balances.

    Taken to the side of the end that is farther away by less than half the tolerance, so that two
    contacts are enough to hold a step of the force between them.
    """
    a, b, width = 0.0, 1.0, high.load - low.load
    margin = 0.4 * search.tolerance * high.load / width
    while b - a > 0.5 * margin:
        middle = 0.5 * (a + b)
        load = low.load + middle * width
        part = search.between(low, high, middle)
        if search.imposed + search.term.force_of(part) > load:
            a = middle
        else:
            b = middle
    at = 0.5 * (a + b)
    at += margin if at < 0.5 else -margin
    return low.load + min(max(at, margin), 1.0 - margin) * width


def _interpolated(
    low: SolvedContact, high: SolvedContact, at: float, influence: float
) -> SolvedContact:
    """Contact between two of about the same load.

    A pixel that touches in one of them alone does so from where its gap, less the displacement of a
    pixel under its own pressure, `influence` [m/Pa], passes zero.
    """
    ends = [influence * one.pressure - one.gap for one in (low, high)]
    signed = ends[0] + at * (ends[1] - ends[0])
    return low._replace(
        pressure=np.maximum(signed, 0.0) / influence,
        displacement=low.displacement + at * (high.displacement - low.displacement),
        gap=np.maximum(-signed, 0.0),
    )


def _further(search: _Search[Part], found: _Trial[Part], largest: float) -> tuple[float, ...]:
    """Loads of further equilibria [N], each to the factor of four it was found in."""
    load = max(4.0 * found.load, 1e-6 * largest)
    if load >= largest:
        return ()
    counter = WorkCounter()
    coarse = film_companion(search.plan)
    rough = _Search(Step(coarse, counter), search.term, search.imposed, Target(load, None))
    others: list[float] = []
    above, last = False, found.load
    while load < largest:
        trial = rough.attempt(load, rough.rtol)
        if trial is None:
            break
        if (trial.excess > 0.0) != above:
            others.append((last * load) ** 0.5 if last > 0.0 else load)
            above = not above
        last, load = load, 4.0 * load
    is_full = coarse.grid.shape == search.plan.grid.shape
    search.step.counter.add_companion(counter, is_full)
    return (*others, largest) if above else tuple(others)


def to_last_pixel(accuracy: Accuracy) -> float:
    """Return the tolerance that a film which pulls needs, whatever that of the plan.

    An error of the gap that moves single pixels moves a balance that is flat by much more: at a
    tolerance of 1e-5, area and force were up to 1.4 % off.
    """
    return min(accuracy.rtol, _PIXEL_RTOL)


def film_companion(plan: ContactPlan) -> ContactPlan:
    """Return the plan without friction on about a hundred pixels along a side, to 1e-3."""
    factor = largest_factor(plan, _FEWEST)
    if factor == 1:
        made = evolve(plan, accuracy=evolve(plan.accuracy, rtol=_COMPANION.rtol))
    else:
        made = coarser(plan, plan.heights, factor, _COMPANION)
    kept = tuple(e for e in made.scene.effects if isinstance(e, Compliance | PressureBound))
    return evolve(made, scene=evolve(made.scene, effects=kept), coupling=None)
