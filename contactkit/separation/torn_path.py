"""Viscous force of a film that tears, along an imposed motion, with the memory of its cavity."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import NamedTuple

from .cavity.events import born, is_torn_by
from .cavity.law import CavityLaw
from .cavity.path import Place, along_path
from .cavity.stages import ShownCavity, shown_cavity
from .cavity.state import FULL, Cavity, Phase
from .effects.base import LimitKind
from .film import Film

__all__ = ["TornPoint", "torn_points"]


class TornPoint(NamedTuple):
    """Film at a time of its path.

    `force` is the viscous force [N], `impulse` its time integral so far [N.s]; `limit` says
    whether there is a cavity, of `radius` [m] in each film, and a `void` [m3] in all.
    """

    force: float
    impulse: float
    limit: LimitKind
    radius: float
    void: float


def torn_points(
    film: Film, law: CavityLaw, place: Place, times: Sequence[float], rtol: float
) -> list[TornPoint]:
    """Film at each of some ascending times [s], full at the first of them.

    Parameters
    ----------
    film, law
        Forces of the film while it is whole, and how it tears.
    place : callable
        Gap [m] and opening speed [m/s] at a time [s], smooth.
    times : sequence of float
        Where the film is wanted [s].
    rtol : float
        Tolerance of the void of a step, over the volume of the film.
    """
    cavity, total = FULL, 0.0
    first = place(times[0])
    if is_torn_by(law, cavity, *first):
        cavity = born(law, *first)
    found = [_point(film, law, cavity, place, times[0], 0.0)]
    step = 0.0
    for begin, end in pairwise(times):
        last = begin
        for point in along_path(law, cavity, place, begin, end, rtol, step):
            if point.impulse is None:
                total += film.newtonian_impulse(place(last)[0], place(point.time)[0])
            else:
                total += point.impulse
            cavity, last, step = point.cavity, point.time, point.step
        found.append(_point(film, law, cavity, place, end, total))
    return found


def _point(
    film: Film, law: CavityLaw, cavity: Cavity, place: Place, time: float, impulse: float
) -> TornPoint:
    gap, speed = place(time)
    if cavity.phase is Phase.FULL:
        return TornPoint(film.newtonian_force(gap, speed), impulse, LimitKind.NONE, 0.0, 0.0)
    shown: ShownCavity = shown_cavity(law, cavity, gap, speed)
    return TornPoint(shown.force, impulse, LimitKind.TENSION, shown.radius, shown.void)
