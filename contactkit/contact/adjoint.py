r"""Gradient of a number of a solved contact: one more solve, with the same operator.

Where pixels in contact stay what they are, p and the rigid-body approach follow from

.. math:: (C p)_F - h_F - \delta = 0, \quad p_Z = 0, \quad p_B = H, \quad \sum p = W
          \text{ or } \delta = d - \max h

on the free pixels F, those apart Z and those at the hardness B. For a functional J with slopes
:math:`g = J_p + C J_u` the adjoint pressure :math:`\lambda` on F solves the same equations with g
on their right, and every derivative is a product with it:

.. math:: dJ = (\lambda + J_h)\cdot dh - (\lambda - J_u)\cdot dC\,p + (g - C\lambda)_B\cdot dH_B
          - \mu\, (dW - \sum dH_B)

with the constant :math:`\mu` of the adjoint displacement under a load; at an approach
:math:`(\sum\lambda + J_\delta)\, d\delta` takes the place of the last term. (Adjoint equations of
obstacle problems: Mignot 1976; the same with dh, dC, dH and dW known for a parameter.)

An attraction adds its tangent on the pixels apart (`attracted`), and the change of its law
at the gaps of the contact to dJ.
"""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from ..errors import NotSimulatedError
from .attracted import attracted_response, fall_of_tension
from .effects.base import (
    Attraction,
    DisplacementTerm,
    FixedHardness,
    LoadHistory,
    LoadTerm,
)
from .effects.partial_slip import PartialSlip
from .effects.plasticity import AT_HARDNESS

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from .attracted import AttractedResponse
    from .functionals import Slopes
    from .plan import ContactPlan
    from .result import ContactResult
    from .solver.contact_solver import Response

    Map = NDArray[np.float64]

__all__ = ["Adjoint", "Change", "adjoint", "check_differentiable"]

# Pressure over its maximum, and gap over the largest displacement, up to which a pixel is
# undecided: the tolerance of the contact conditions in `Accuracy.standard` is 1e-8 of the rms
# height. Wider bands count pixels that a change of a per mille does not reach.
_UNDECIDED = 1e-6


class Change(NamedTuple):
    """Change of what a contact is made from, per unit of a parameter; None where it has none.

    `heights` (ny, nx) [m], the displacement by the present pressure `pressed` (ny, nx) [m] as the
    compliance changes, `hardness` [Pa] a number or a map, `tension` (ny, nx) [Pa] that of
    an attraction at the present gaps, `load` the mean pressure [Pa] and
    `approach` that from first touch [m].
    """

    heights: Map | None = None
    pressed: Map | None = None
    hardness: Map | float | None = None
    tension: Map | None = None
    load: float = 0.0
    approach: float = 0.0


class Adjoint(NamedTuple):
    """Slopes of a number over all that a contact is made from.

    `heights` and `pressed` (ny, nx) [unit/m], `hardness` and `tension` (ny, nx) [unit/Pa], `load`
    over the mean pressure [unit/Pa], `approach` over that from first touch [unit/m]. `n_undecided`
    pixels carry no pressure and have no gap either: the slopes are one-sided. `n_applications` of
    the operator.
    """

    heights: Map
    pressed: Map
    hardness: Map
    tension: Map
    load: float
    approach: float
    n_undecided: int
    n_applications: int

    def along(self, change: Change) -> float:
        """Return the slope along a change."""
        found = self.load * change.load + self.approach * change.approach
        for slope, one in (
            (self.heights, change.heights),
            (self.pressed, change.pressed),
            (self.hardness, change.hardness),
            (self.tension, change.tension),
        ):
            if one is not None:
                found += float((slope * one).sum())
        return found


def check_differentiable(plan: ContactPlan, of: str) -> None:
    """Refuse a contact whose gradient is not that of its pressure alone.

    Under loads that only rise, plastic pixels carry the hardness as they do without a history.

    Raises
    ------
    NotSimulatedError
        Names the effect and the reason.
    """
    scene = plan.scene
    history, term = scene.effect(LoadHistory), scene.effect(DisplacementTerm)
    if history is not None and not history.has_gradient:
        raise _refused(type(history).__name__, "the contact depends on all pressures before it")
    if history is not None and not _only_rises(plan, history):
        reason = "the shape depends on a load before that was as large or larger"
        raise _refused(type(history).__name__, reason)
    if history is not None and of == "energy":
        raise _refused(type(history).__name__, "its energy is that of the shape that it left")
    if term is not None:
        reason = "friction displaces the surfaces, and the equations are not symmetric"
        raise _refused(type(term).__name__, reason)
    slip, film = scene.effect(PartialSlip), scene.effect(LoadTerm)
    if slip is not None and slip.couples(scene):
        raise _refused("PartialSlip(coupled=True)", "the tractions depend on the path of the load")
    if film is not None and film.self_consistent:
        reason = "its force adds to the load by whole pixels"
        raise _refused(f"{type(film).__name__}(self_consistent=True)", reason)
    if plan.hardness is not None and not isinstance(plan.hardness, FixedHardness):
        raise _refused("HardnessLimit", "its hardness depends on the displacement")


def _only_rises(plan: ContactPlan, history: LoadHistory[Any]) -> bool:
    """Whether each load of a history exceeds those before it."""
    loadings = (*history.loadings(), plan.scene.loading)
    loads = [0.0, *(one.imposed_over(plan.grid.area) for one in loadings)]
    return all(before < after for before, after in pairwise(loads))


def _refused(what: str, reason: str) -> NotSimulatedError:
    return NotSimulatedError(
        f"no gradient of a contact with {what}: {reason}; leave it out, or take differences of "
        "whole solves (ck.sensitivity)"
    )


def adjoint(plan: ContactPlan, result: ContactResult, slopes: Slopes) -> Adjoint:
    """Solve the adjoint equations of a solved contact.

    Parameters
    ----------
    plan : ContactPlan
        Its plan, prepared.
    result : ContactResult
        The contact.
    slopes : Slopes
        Of the number that is asked for.

    Raises
    ------
    ConvergenceError
        If the linear equations are not solved to 1e-9 of their right-hand side.
    """
    solver, p, shape = plan.prepared.solver, result.pressure, plan.grid.shape
    zero, n_applications = np.zeros(shape), 0

    def displaced(values: Map) -> Map:
        nonlocal n_applications
        n_applications += 1
        return solver.displacement(values)

    by_u = zero if slopes.displacement is None else slopes.displacement
    by_h = zero if slopes.heights is None else slopes.heights
    g = zero if slopes.pressure is None else slopes.pressure
    if by_u.any():
        g = g + displaced(by_u)
    at_bound = _at_bound(plan, p)
    free = (p > 0.0) & ~at_bound
    is_loaded = plan.rigid_approach is None
    total = -slopes.approach if is_loaded else None
    of_hardness = of_tension = zero
    by_approach = 0.0
    attraction = plan.scene.effect(Attraction)
    found: Response | AttractedResponse
    if attraction is None:
        found = solver.response(free, g, total)
    else:
        free = result.contact & ~at_bound
        law = attraction.prepare(solver.self_influence)
        apart = ~(result.contact | at_bound)
        falls = np.where(apart, fall_of_tension(law, result.gap), 0.0)
        found = attracted = attracted_response(solver, free, falls, g, total)
        of_tension = np.where(apart, attracted.by_tension, 0.0)
    adjoint_pressure, n_applications = found.pressure, n_applications + found.n_applications
    if at_bound.any():
        left = g - displaced(adjoint_pressure)
        of_hardness = np.where(at_bound, left + (found.shift if is_loaded else 0.0), 0.0)
    heights = adjoint_pressure + by_h
    if not is_loaded:
        by_approach = float(adjoint_pressure.sum()) + slopes.approach
        heights[np.unravel_index(int(np.argmax(plan.heights)), shape)] -= by_approach
    by_load = -found.shift * p.size if is_loaded else 0.0
    undecided = _n_undecided(result, at_bound)
    return Adjoint(
        heights,
        by_u - adjoint_pressure,
        of_hardness,
        of_tension,
        by_load,
        by_approach,
        undecided,
        n_applications,
    )


def _at_bound(plan: ContactPlan, pressure: Map) -> NDArray[np.bool_]:
    law = plan.hardness
    if not isinstance(law, FixedHardness):
        return np.zeros(pressure.shape, dtype=bool)
    return np.asarray((pressure >= np.asarray(law.value) * AT_HARDNESS) & (pressure > 0.0))


def _n_undecided(result: ContactResult, at_bound: NDArray[np.bool_]) -> int:
    """Pixels that a change however small may bring into contact, or out of it."""
    p, gap = result.pressure, result.gap
    attraction = result.plan.scene.effect(Attraction)
    if attraction is not None:  # the pressure of contact, which may pull on the whole
        tension = attraction.attracted_of(result.parts[type(attraction)]).tension
        p = np.where(result.contact, p + tension, 0.0)
    if not p.any():
        return 0
    length = float(np.abs(result.displacement).max())
    little = p <= _UNDECIDED * float(p.max())
    close = gap <= _UNDECIDED * length
    holes = result.holes
    found = little & close & ~at_bound
    return int((found if holes is None else found & ~holes).sum())
