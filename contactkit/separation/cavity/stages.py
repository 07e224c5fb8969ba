r"""Void of a cavity at the stages of a step of time, and the forces there.

The gaps and speeds of the stages are given, from Newton's method for the motion or from a path that
is imposed. The voids solve the equations of the same method, Radau IIA:

.. math:: W_i = W_0 + \Delta t \sum_j a_{ij} \, \dot W(h_j, v_j, W_j)

The slopes of the forces are those at an edge and a rim that stay. For an edge from which liquid
recedes these are the whole slopes; where it returns, and where the rim draws in, Newton's method
for the motion then converges linearly, by two digits or more an iteration.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

from ...lubrication.disc_cavity import film_ring, inflow, receding_edge
from ...lubrication.rupture_history import edge_of
from ...numerics.radau_tableau import ERROR, GAMMA, STAGES
from ...numerics.three import Three, solved_three
from .disc_film import DiscFilm
from .state import Cavity, Phase

__all__ = [
    "CavityForce",
    "CavityStages",
    "ShownCavity",
    "Spot",
    "force_at",
    "shown_cavity",
    "solved_stages",
    "spot_at",
]

_SMALLEST = 1e-14  # fraction of the disc within an edge that is taken for a point
# Newton takes four or five as a film is pulled apart: a cap of 5 changes no step of 18 releases. As
# it swings, and liquid comes back, that costs 3 % more steps, and a cap of 3 twice as many; 8 none.
_MOST_ITERATIONS = 30
_ENOUGH = 1e-15  # change of the void, over the volume of the film


class Spot(NamedTuple):
    """Edge of a cavity at a gap, a speed and a void; the growth of the void and its slope.

    `fraction` and `edge_square` [m2] say where the edge is; `growth` [m3/s], `by_void` [1/s], and
    `returns` what flows over the edge [m3/s].
    """

    fraction: float
    edge_square: float
    rim_square: float
    growth: float
    by_void: float
    returns: float


class CavityForce(NamedTuple):
    """Force of all films [N], and its slopes [N/m], [N.s/m] at an edge and a rim that stay."""

    force: float
    by_gap: float
    by_speed: float


class CavityStages(NamedTuple):
    """Voids [m3], edges and forces at the stages of a step, and the error of the last void [-].

    The error is over the volume of the film.
    """

    voids: tuple[float, float, float]
    spots: tuple[Spot, Spot, Spot]
    forces: tuple[CavityForce, CavityForce, CavityForce]
    error: float


def spot_at(law: DiscFilm, cavity: Cavity, gap: float, speed: float, void: float) -> Spot:
    """Edge of the cavity at a gap [m], a speed [m/s] and a void [m3], in the phase it is in."""
    rim, rim_by_void = law.rim(gap, void)
    k = law.conductance(gap)
    if cavity.phase is Phase.RECEDING:
        full = 4.0 * k * law.drop / (speed * rim) if speed > 0.0 else math.inf
        rho = receding_edge(1.0 / full) if full < 1.0 else 0.0
        edge = rho * rim
        by_rim = rho - full / math.log(rho) if rho > 0.0 else 0.0
        rate = math.pi * speed
        return Spot(rho, edge, rim, rate * edge, rate * by_rim * rim_by_void, 0.0)
    edge, rupture_gap = edge_of(cavity.history, gap, void)
    edge = min(max(edge, _SMALLEST * rim), (1.0 - 1e-15) * rim)
    flow = inflow(edge, rim, k, law.drop, speed)
    deeper = math.pi * max(gap - rupture_gap, 1e-12 * gap)
    by_void = flow.by_edge / deeper + flow.by_rim * rim_by_void
    return Spot(edge / rim, edge, rim, flow.growth, by_void, flow.returns)


def force_at(law: DiscFilm, spot: Spot, gap: float, speed: float) -> CavityForce:
    """Force of the films with a cavity at a gap [m] and a speed [m/s]."""
    ring = film_ring(spot.fraction, spot.rim_square, law.conductance(gap), law.drop, speed)
    n = law.menisci
    return CavityForce(n * ring.force, -3.0 * n * ring.by_speed * speed / gap, n * ring.by_speed)


class ShownCavity(NamedTuple):
    """Viscous force of all films [N], radius of the cavity in each [m], void in all [m3]."""

    force: float
    radius: float
    void: float


def shown_cavity(law: DiscFilm, cavity: Cavity, gap: float, speed: float) -> ShownCavity:
    """Force and cavity of the films at a gap [m] and a speed [m/s], with the void it has."""
    spot = spot_at(law, cavity, gap, speed, cavity.void)
    force = force_at(law, spot, gap, speed).force
    return ShownCavity(force, math.sqrt(spot.edge_square), law.menisci * cavity.void)


def solved_stages(
    law: DiscFilm,
    cavity: Cavity,
    begin: tuple[float, float],
    dt: float,
    places: Sequence[tuple[float, float]],
) -> CavityStages | None:
    """Voids at the stages of a step; None if they are not found: a shorter step may do.

    Parameters
    ----------
    law, cavity
        Film, and its cavity at the start of the step.
    begin : (float, float)
        Gap [m] and speed [m/s] at the start.
    dt : float
        Length of the step [s].
    places : sequence of 3 (float, float)
        Gap [m] and speed [m/s] at the stages.
    """
    start = spot_at(law, cavity, *begin, cavity.void)
    scale = math.pi * start.rim_square * begin[0]
    voids = [cavity.void + math.pi * start.edge_square * (gap - begin[0]) for gap, _ in places]
    if cavity.phase is Phase.RETURNING:
        voids = [max(void, 0.0) for void in voids]
    for _ in range(_MOST_ITERATIONS):
        spots = [
            spot_at(law, cavity, gap, speed, void)
            for (gap, speed), void in zip(places, voids, strict=True)
        ]
        change = _newton(cavity.void, dt, voids, spots)
        if change is None:
            return None
        voids = [void - step for void, step in zip(voids, change, strict=True)]
        if max(map(abs, change)) <= _ENOUGH * scale:
            break
    else:
        return None
    first, second, third = spots
    one, two, three = (
        force_at(law, spot, *place) for spot, place in zip(spots, places, strict=True)
    )
    a, b, c = voids
    error = _error(cavity.void, dt, voids, start) / scale
    return CavityStages((a, b, c), (first, second, third), (one, two, three), error)


def _newton(first: float, dt: float, voids: Sequence[float], spots: Sequence[Spot]) -> Three | None:
    """Change of the voids that the equations of the stages ask for."""
    x, y, z = (
        void - first - dt * sum(a * spot.growth for a, spot in zip(row, spots, strict=True))
        for void, row in zip(voids, STAGES, strict=True)
    )
    u, v, w = (dt * spot.by_void for spot in spots)
    (a0, a1, a2), (b0, b1, b2), (c0, c1, c2) = STAGES
    return solved_three(
        (1.0 - a0 * u, -a1 * v, -a2 * w),
        (-b0 * u, 1.0 - b1 * v, -b2 * w),
        (-c0 * u, -c1 * v, 1.0 - c2 * w),
        (x, y, z),
    )


def _error(first: float, dt: float, voids: Sequence[float], start: Spot) -> float:
    """Error of the void at the end of a step [m3], by the estimate of the method."""
    gone = sum(e * (void - first) for e, void in zip(ERROR, voids, strict=True)) / dt
    slope = min(start.by_void, 0.0) if math.isfinite(start.by_void) else 0.0
    return abs((start.growth + gone) / (GAMMA / dt - slope))
