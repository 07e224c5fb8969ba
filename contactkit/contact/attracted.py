r"""Linear response of a contact with an attraction, whose tension follows the gap.

Pixels apart carry :math:`p = -\tau(g)`, so that with :math:`k = -\tau'(g)` a change of them is
:math:`dp = k\,(C\,dp - dh - d\delta)`: the same operator, less 1/k on their diagonal. It is
symmetric, as the tension has a potential, and so the same equations are the adjoint ones,

.. math:: (C \lambda)_F - \mu = g, \qquad \lambda_A = k\,(C \lambda - \mu - g)_A .

Pixels in contact are eliminated by the response of a contact without attraction; for those apart
the map on the right is a contraction as long as the state is stable, and GMRES takes it from there.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ..errors import ConvergenceError

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from .effects.attraction_laws import TensionLaw
    from .solver.contact_solver import ContactSolver

    Map = NDArray[np.float64]

__all__ = ["AttractedResponse", "attracted_response", "fall_of_tension"]

# Step of the gap over the reach, for the slope of a law: central differences leave 1e-12 of it out,
# and rounding 1e-10.
_STEP = 1e-6
_RTOL = 1e-10  # residual of GMRES over its right-hand side
_MOST = 200  # iterations; a stable state takes 5 to 30, one next to a jump more


class AttractedResponse(NamedTuple):
    """Pressure (ny, nx), the constant of the displacement, and what it took.

    `by_tension` (ny, nx) is what the displacement differs by; on the pixels apart, those on a
    plateau of the law among them, it is the slope over the tension at a held gap.
    """

    pressure: Map
    shift: float
    by_tension: Map
    n_applications: int


def fall_of_tension(law: TensionLaw, gap: Map) -> Map:
    """Fall of the tension with the gap, -dtau/dg [Pa/m]."""
    step = _STEP * law.reach
    found = (law.tension(gap - step) - law.tension(gap + step)) / (2.0 * step)
    return np.maximum(found, 0.0)


def attracted_response(
    solver: ContactSolver,
    free: NDArray[np.bool_],
    falls: Map,
    right: Map,
    total: float | None,
) -> AttractedResponse:
    """Solve the equations of the module.

    Parameters
    ----------
    solver : ContactSolver
        Of the compliance.
    free : ndarray (ny, nx) of bool
        Pixels in contact, below the hardness.
    falls : ndarray (ny, nx)
        k [Pa/m] of the pixels apart, 0 on others.
    right : ndarray (ny, nx)
        g.
    total : float, optional
        Sum of the pressures; None: mu is 0.

    Raises
    ------
    ConvergenceError
        If the equations are not solved: the state is next to a jump.
    """
    from scipy.sparse.linalg import LinearOperator, gmres

    at, shape, n = np.flatnonzero(falls), right.shape, 0

    def spread(values: Map) -> Map:
        found = np.zeros(right.size)
        found[at] = values
        return found.reshape(shape)

    def completed(values: Map, given: Map, sum_given: float | None) -> tuple[Map, float, Map]:
        """Pressure with that in contact, the constant, and ``C p - mu - g``."""
        nonlocal n
        apart = spread(values)
        wanted = given - solver.displacement(apart)
        rest = None if sum_given is None else sum_given - float(apart.sum())
        found = solver.response(free, wanted, rest)
        n += found.n_applications + 2
        pressure = apart + found.pressure
        return pressure, found.shift, solver.displacement(pressure) - found.shift - given

    weight = falls.ravel()[at]
    none, nothing = np.zeros(shape), None if total is None else 0.0

    def moved(values: Map) -> Map:
        return np.asarray(values - weight * completed(values, none, nothing)[2].ravel()[at])

    start = np.zeros(at.size)
    first = weight * completed(start, right, total)[2].ravel()[at]
    if first.any():
        # Scaled, as the sizes of right-hand sides differ by decades with their units.
        size = float(np.abs(first).max())
        operator = LinearOperator((at.size, at.size), matvec=moved, dtype=np.float64)
        found, failed = gmres(operator, first / size, rtol=_RTOL, restart=_MOST, maxiter=1)
        if failed:
            raise ConvergenceError(
                "the linear equations of a contact with an attraction are not solved: the state is "
                "next to a jump, where slopes are infinite"
            )
        start = size * found
    pressure, shift, by_tension = completed(start, right, total)
    return AttractedResponse(pressure, shift, by_tension, n)
