r"""A film that loses liquid in a step of the motion: its volume at the stages, and its forces.

.. math:: x_i = x_0 + \Delta t \sum_j a_{ij} \, \dot x(h_j, v_j, x_j)

with the part x of the volume that is left. It changes by some per cent in a motion and by less in a
step, so that these equations contract by themselves, and Newton's method for the motion leaves out
how the stages change it: it then converges linearly, by two digits or more an iteration.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from attrs import frozen

from ...numerics.radau_tableau import ERROR, GAMMA, STAGES
from ..film import Film
from ..integrator.radau import Memory, Step
from ..plan import Plan
from .state import MotionState

__all__ = ["LosingStep", "VolumeStages", "film_at_end", "losing_step"]

# Two releases took one to five in each step: five where it loses a thousandth of the volume.
_MOST_ITERATIONS = 30
_ENOUGH = 1e-14  # change of the volume, over that of the scene


class VolumeStages(NamedTuple):
    """Parts of the volume at the stages of a step [-], and the films that have them."""

    parts: tuple[float, float, float]
    films: tuple[Film, Film, Film]


@frozen(eq=False)
class LosingStep:
    """Volume of a film from the start of a step on."""

    plan: Plan
    begin: MotionState

    def remembered(self, dt: float, places: Sequence[tuple[float, float]]) -> Memory | None:
        """Forces at the stages of a step, with the volumes that belong to them."""
        rate, begin = self.plan.volume_rate, self.begin
        assert rate is not None
        first = begin.volume_fraction
        start = rate(begin.gap, begin.speed, first)
        parts = [first] * 3
        for _ in range(_MOST_ITERATIONS):
            rates = [rate(*place, part) for place, part in zip(places, parts, strict=True)]
            before = parts
            parts = [
                first + dt * sum(a * one for a, one in zip(row, rates, strict=True))
                for row in STAGES
            ]
            if max(abs(a - b) for a, b in zip(parts, before, strict=True)) <= _ENOUGH:
                break
        else:
            return None
        detached = begin.detached
        one, two, three = (
            self.plan.remaining_film(part, broken=False, detached=detached) for part in parts
        )
        assert one is not None
        assert two is not None
        assert three is not None
        films = one, two, three
        a, b, c = (film.forces(*place) for film, place in zip(films, places, strict=True))
        gone = sum(e * (part - first) for e, part in zip(ERROR, parts, strict=True))
        error = abs(dt * start + gone) / GAMMA
        x, y, z = parts
        return Memory((a, b, c), error, VolumeStages((x, y, z), films))


def losing_step(plan: Plan, state: MotionState) -> LosingStep | None:
    """Step of a film that loses liquid; None for one that keeps it, or is broken."""
    if plan.volume_rate is None or state.broken:
        return None
    return LosingStep(plan, state)


def film_at_end(film: Film, taken: Step) -> Film:
    """Film at the end of a step, with the volume it has left there."""
    found = taken.memory.found if taken.memory is not None else None
    return found.films[2] if isinstance(found, VolumeStages) else film
