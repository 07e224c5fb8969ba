"""Viscous force of a film that cavitates, along an imposed motion; its cavity is remembered."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import NamedTuple

from .cavity.events import is_inception
from .cavity.law import Cavitation
from .cavity.path import Place, along_path
from .cavity.state import FULL, Cavity, Phase
from .effects.base import LimitKind
from .film import Film

__all__ = ["Known", "CavityPoint", "cavity_points"]


class CavityPoint(NamedTuple):
    """Film at a time of its path.

    `force` is the viscous force [N], `impulse` its time integral so far [N.s]; `limit` says
    whether there is a cavity, of `radius` [m] in each film, and a `void` [m3] in all.
    """

    force: float
    impulse: float
    limit: LimitKind
    radius: float
    void: float


class Known(NamedTuple):
    """Film at a time of its path, with all that its way on from there depends on.

    `events` are the times [s], on the way there, of inception, of reformation and of turns of the
    edge.
    """

    point: CavityPoint
    cavity: Cavity
    step: float
    events: tuple[float, ...] = ()


def cavity_points(
    film: Film,
    law: Cavitation,
    place: Place,
    times: Sequence[float],
    rtol: float,
    known: dict[float, Known] | None = None,
) -> list[CavityPoint]:
    """Film at each of some ascending times [s], full at the first of them.

    Parameters
    ----------
    film, law
        Forces of the film while it is full, and how it cavitates.
    place : callable
        Gap [m] and opening speed [m/s] at a time [s], smooth.
    times : sequence of float
        Where the film is wanted [s].
    rtol : float
        Tolerance of the void of a step, over the volume of the film.
    known : dict, optional
        What other times gave, which is not computed again; what these give is added.
    """
    known = {} if known is None else known
    if times[0] not in known:
        first, cavity = place(times[0]), FULL
        if is_inception(law, cavity, *first):
            cavity = law.inception(*first)
        known[times[0]] = Known(_point(film, law, cavity, place, times[0], 0.0), cavity, 0.0)
    for begin, end in pairwise(times):
        if end not in known:
            known[end] = _after(film, law, place, (begin, known[begin]), end, rtol)
    return [known[time].point for time in times]


def _after(
    film: Film,
    law: Cavitation,
    place: Place,
    start: tuple[float, Known],
    end: float,
    rtol: float,
) -> Known:
    """Film at a later time [s]."""
    begin, ((_, total, *_), cavity, step, _) = start
    last, events = begin, []
    for point in along_path(law, cavity, place, begin, end, rtol, step):
        if point.impulse is None:
            total += film.newtonian_impulse(place(last)[0], place(point.time)[0])
        else:
            total += point.impulse
        if point.cavity.phase is not cavity.phase and begin < point.time < end:
            events.append(point.time)
        cavity, last, step = point.cavity, point.time, point.step
    return Known(_point(film, law, cavity, place, end, total), cavity, step, tuple(events))


def _point(
    film: Film, law: Cavitation, cavity: Cavity, place: Place, time: float, impulse: float
) -> CavityPoint:
    gap, speed = place(time)
    if cavity.phase is Phase.FULL:
        return CavityPoint(film.newtonian_force(gap, speed), impulse, LimitKind.NONE, 0.0, 0.0)
    shown = law.shown(cavity, gap, speed)
    return CavityPoint(shown.force, impulse, LimitKind.TENSION, shown.radius, shown.void)
