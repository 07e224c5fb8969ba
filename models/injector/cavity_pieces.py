"""Cavity of the film in a monolithic simulation: its equation, its events, its memory.

The void volume is one more unknown of the solver. The liquid at the edge recedes or returns
throughout a piece, and where the film ruptured is read off the dense output of the solver
afterwards. The laws of film and edge are those of `contactkit.separation.cavity`; the stages,
the search for events and the control of errors are not.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...errors import PlanError
from ...lubrication.disc_cavity import receding_edge
from ...lubrication.rupture_history import cut, liquid_within, outermost, piece_along, void_within
from ...numerics.radau_tableau import NODES
from ...separation.cavity.law import Cavitation, CavityLaw
from ...separation.cavity.stages import force_at, spot_at
from ...separation.cavity.state import FULL, Cavity, Phase

__all__ = [
    "round_cavity",
    "REFORMED",
    "CavitatedFilm",
    "grows_again",
    "liquid_returns",
    "remembered",
    "still_recedes",
    "cavitated_film",
    "turned",
    "void_scale",
]

# The edge runs into the centre like a logarithm as the void vanishes, which no step size follows to
# the end. Larger, the film would be full too early.
REFORMED = 1e-10
"""Void over the largest of a cavity, at which the film counts as full."""

_RECEDES = 1e-6  # flow over the edge, over that into the film, which is more than round-off


class CavitatedFilm(NamedTuple):
    """Force of a film with a cavity [N], and growth of the void in one film [m3/s]."""

    force: float
    growth: float


def round_cavity(law: Cavitation | None) -> CavityLaw | None:
    """Law of a film between discs; None of one that does not cavitate.

    Raises
    ------
    PlanError
        If the face is no disc: this reference integrates the edge of a round cavity.
    """
    if law is None or isinstance(law, CavityLaw):
        return law
    raise PlanError(
        "the reference of the injector needs an even disc for its TensionLimit: on another face "
        "run the film alone, by ck.simulate(plan)"
    )


def void_scale(law: CavityLaw | None, gap: float) -> float:
    """Volume of the full film at a gap [m3]; 1 where the film cannot cavitate."""
    return 1.0 if law is None else math.pi * law.rim(gap, 0.0)[0] * gap


def cavitated_film(
    law: CavityLaw, cavity: Cavity, gap: float, speed: float, void: float
) -> CavitatedFilm:
    """Force and growth of the void at a gap [m], a speed [m/s] and a void [m3]."""
    spot = spot_at(law, cavity, gap, speed, void)
    return CavitatedFilm(force_at(law, spot, gap, speed).force, spot.growth)


def still_recedes(
    law: CavityLaw, gap: float, speed: float, void: float, acceleration: float
) -> float:
    r"""Rate [1/s] that is positive while the edge from which liquid recedes moves outwards.

    With the fraction :math:`\rho(\sigma)` of the disc within the edge, the edge
    :math:`y = \rho R^2` grows at :math:`-R^2/(\sigma \ln\rho)` times

    .. math:: \frac{\sigma'}{\sigma} - \sigma \rho \ln\rho \, \frac{(R^2)'}{R^2}, \qquad
              \frac{\sigma'}{\sigma} = \frac{v'}{v} + \frac{(R^2)'}{R^2} - 3 \frac{v}{h}
    """
    if speed <= 0.0:
        return -1.0
    _, by_void = law.rim(gap, void)
    sigma = law.tension(gap, speed, void) / law.drop
    rho = receding_edge(sigma)
    drawn = 0.0  # relative rate of the square of the rim
    if by_void > 0.0:
        drawn = math.pi * speed * rho * by_void - speed / gap
    rising = acceleration / speed + drawn - 3.0 * speed / gap
    return rising - sigma * rho * math.log(rho) * drawn if rho > 0.0 else rising


def liquid_returns(law: CavityLaw, cavity: Cavity, gap: float, speed: float, void: float) -> float:
    """Fraction that is positive while liquid flows over the edge into the cavity [-]."""
    spot = spot_at(law, cavity, gap, speed, void)
    return spot.returns / (abs(spot.growth) + abs(spot.returns) + 1e-300) + _RECEDES


def remembered(
    law: CavityLaw,
    cavity: Cavity,
    times: NDArray[np.float64],
    at: Callable[[Any], NDArray[np.float64]],
) -> Cavity:
    """Cavity at the end of a piece in which liquid receded.

    `times` [s] are those of the steps of the solver, and `at` gives gap [m], speed [m/s] and void
    [m3] at times. Each step becomes a piece of the history, which is a cubic through four of its
    instants: what is remembered is as good as the dense output.
    """
    history = cavity.history
    for begin, end in zip(times[:-1].tolist(), times[1:].tolist(), strict=True):
        instants = [begin, *(begin + node * (end - begin) for node in NODES[:2]), end]
        gaps, speeds, voids = at(np.array(instants)).tolist()
        squares = [
            spot_at(law, cavity, *place).edge_square
            for place in zip(gaps, speeds, voids, strict=True)
        ]
        # One edge for both of two neighbours, though they come from two steps.
        squares[0] = outermost(history)
        history = (*history, piece_along(liquid_within(history), squares, gaps))
    return cavity._replace(history=history)


def turned(cavity: Cavity, gap: float) -> Cavity:
    """Cavity to which liquid returns from now on, at a gap [m]."""
    void = void_within(cavity.history, gap)
    return cavity._replace(phase=Phase.RETURNING, void=void, largest=void)


def grows_again(cavity: Cavity, gap: float, void: float) -> Cavity:
    """Cavity from whose edge liquid recedes again, at a gap [m] and a void [m3]."""
    if void <= 2.0 * REFORMED * cavity.largest:
        return FULL
    return cavity._replace(phase=Phase.RECEDING, void=void, history=cut(cavity.history, gap, void))
