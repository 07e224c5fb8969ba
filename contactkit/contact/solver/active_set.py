"""Active-set iterations (semismooth Newton) on one grid of the contact problem.

Every iteration convolves the pressure in double precision, finds the reduced gap and how far it is
from a solution, and corrects the pressures of the free pixels: cut off at their bounds, or, under
stiff films, projected onto them.

Sign convention: pressure, heights and displacement positive into the solid.
"""

from __future__ import annotations

from typing import NamedTuple

from .nested_grids import GridLevel
from .problem import ContactProblem
from .projected_set import ProjectedSet
from .state import SINGLE_LIMIT, ActiveSetState
from .truncated_set import TruncatedSet

__all__ = ["SetOutcome", "improve"]


class SetOutcome(NamedTuple):
    """End of the iterations; pressure and reduced gap are in the maps of the grid.

    approach : rigid-body approach; relative : largest violation over the height scale
    certificate : bound of the energy error over load times height scale
    steps : number of iterations; history : (applications, relative) after each
    is_stalled : whether round-off ended the iterations of the plain method that finished
    """

    approach: float
    relative: float
    certificate: float
    steps: int
    history: tuple[tuple[int, float], ...]
    is_stalled: bool = False


def improve(
    grid: GridLevel, problem: ContactProblem, rtol: float, is_extrapolated: bool = False
) -> SetOutcome:
    """Iterate on one grid until the relative residual is `rtol`, or no longer falls.

    Parameters
    ----------
    grid : GridLevel
        Its `pressure` is the initial guess, and the solution on return.
    problem : ContactProblem
        Dimensionless problem on this grid.
    rtol : float
        Largest violation to accept, over `height_scale`.
    is_extrapolated : bool
        See `TruncatedSet`.

    Returns
    -------
    SetOutcome
        With ``relative > rtol`` if the iterations stagnate: the fallback has to finish.
    """
    history: list[tuple[int, float]] = []
    state: ActiveSetState = ProjectedSet(grid, problem, rtol)
    # The truncated set costs least but may stall, as cut pressures can raise the energy. Then the
    # projected one, whose energy falls at every step, goes on from its pressures.
    if not grid.is_stiff:
        state = TruncatedSet(grid, problem, rtol, is_extrapolated)
        if not _iterate(state, history):
            state = ProjectedSet(grid, problem, rtol)
    is_done = state.done() or _iterate(state, history)
    # The caller looks at `relative` alone: a residual in single precision, or one of pressures that
    # miss the load, must not pass for a solution.
    relative = state.relative if is_done else max(state.relative, 2.0 * rtol)
    return SetOutcome(state.approach, relative, state.certificate, len(history), tuple(history))


def _iterate(state: ActiveSetState, history: list[tuple[int, float]]) -> bool:
    """Evaluate and correct until the conditions are met or the method stagnates; whether met."""
    for step in range(state.max_iterations):
        relative = state.evaluate()
        history.append((state.grid.applications(), relative))
        if state.done():
            return True
        if relative <= SINGLE_LIMIT and not state.exact:
            continue  # evaluate again before anything is corrected
        if state.stagnates(step):
            break
        if step < state.max_iterations - 1:  # the pressures that are left have been evaluated
            state.correct()
    return False
