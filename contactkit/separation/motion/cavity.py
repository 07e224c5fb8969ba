"""A film with a cavity in a step of the motion: its forces, and the events that end the step."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from attrs import field, frozen

from ...numerics.events import EventStep
from ..cavity.events import first_event, is_inception
from ..cavity.law import Cavitation
from ..cavity.stages import CavityForce
from ..cavity.state import Cavity, Phase
from ..effects.base import LimitKind
from ..film import Film
from ..integrator.radau import Forces, Memory, Step, StepProblem, step

__all__ = ["CavityFilm", "after", "cavity_film", "cut_at_event", "cut_before_step"]

_EVENT = 1e-11  # what an event of a cavity may be missed by, over its scale
_ONE = tuple[float, float]


@frozen(eq=False)
class CavityFilm:
    """A film, its cavity at the start of a step, and where its edge is."""

    film: Film
    law: Cavitation
    cavity: Cavity
    begin: _ONE
    _held: Callable[[float, float], CavityForce] = field(init=False, repr=False)

    @_held.default
    def _find_held(self) -> Callable[[float, float], CavityForce]:
        return self.law.held_force(self.cavity, self.begin)

    def forces(self, gap: float, speed: float) -> Forces:
        """Forces near the start, with an edge and a rim that stay."""
        return self._forces((gap, speed), self._held(gap, speed))

    def _forces(self, place: _ONE, held: CavityForce) -> Forces:
        static, static_by_gap, viscous, by_gap, by_speed = self.film.unbounded(*place)
        return Forces(
            static,
            static_by_gap,
            viscous + held.force,
            by_gap + held.by_gap,
            by_speed + held.by_speed,
            LimitKind.TENSION,
        )

    def remembered(self, dt: float, places: Sequence[_ONE]) -> Memory | None:
        """Forces at the stages of a step, with the voids that belong to them."""
        solved = self.law.stages(self.cavity, self.begin, dt, places)
        if solved is None:
            return None
        one, two, three = (
            self._forces(place, held) for place, held in zip(places, solved.forces, strict=True)
        )
        return Memory((one, two, three), solved.error, solved)


def after(law: Cavitation, cavity: Cavity, taken: Step, begin_gap: float) -> Cavity:
    """Cavity at the end of a step of a film that has one."""
    if taken.memory is None:
        return cavity
    gaps = [point.gap for point in taken.stages]
    return law.after_step(cavity, taken.memory.found, begin_gap, gaps)


def cavity_film(film: Film | None, cavity: Cavity, begin: _ONE) -> CavityFilm | None:
    """Film with its cavity at a gap [m] and a speed [m/s]; None where it has none."""
    if film is None or film.cavity is None or cavity.phase is Phase.FULL:
        return None
    return CavityFilm(film, film.cavity, cavity, begin)


def cut_before_step(film: Film | None, cavity: Cavity, place: _ONE) -> Cavity | None:
    """Cavity of a film that cavitates where it is; None if it does not."""
    if film is None or film.cavity is None or not is_inception(film.cavity, cavity, *place):
        return None
    return film.cavity.after_event(cavity, *place)


def cut_at_event(
    problem: StepProblem, law: Cavitation, cavity: Cavity, taken: Step, length: float
) -> EventStep[Step] | None:
    """Step that ends at the first event of a cavity; None if there is none in it.

    Of length 0 if the event is where the step starts.
    """
    begin = (problem.begin.gap, problem.begin.speed)

    def both(one: Step) -> tuple[float, float]:
        solved = one.memory.found if one.memory is not None else None
        places = [(point.gap, point.speed) for point in one.stages]
        return law.beyond_event(cavity, solved, begin, places)

    return first_event(lambda dt: step(problem, dt), both, taken, length, _EVENT)
