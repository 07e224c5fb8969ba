"""Force of a film of any flow law whose pressure is truncated at the strength of its liquid."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.polynomial.legendre import legval, legvander

from ...lubrication.flow_laws.squeeze import NODES
from ...numerics.quadrature import gauss_legendre
from ...numerics.roots import bracketed_root

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[np.floating[Any]]

__all__ = ["truncated_force"]


def truncated_force(radius: Array, gradient: Array, rim_radius: float, strength: float) -> float:
    r"""Force [N] of an opening film whose pressure is cut off at a tension (Gumbel).

    .. math:: F = \int_{r_c}^a \pi r^2 \left|\frac{dp}{dr}\right| dr, \qquad p(r_c) = -\Delta p

    Parameters
    ----------
    radius, gradient : ndarray, shape (n,)
        Nodes [m] and gradient of the pressure [Pa/m] of a `SqueezedFilm` at one gap and one speed.
    rim_radius : float
        Radius of its rim a [m], or inf.
    strength : float
        Tension :math:`\Delta p` at which the liquid cavitates [Pa].

    Notes
    -----
    By parts, the pressure inside :math:`r_c` needs no term of its own. In the panel of the edge the
    logarithm of the gradient, which is nearly a line, is a polynomial through its nodes: the error
    of the force is 1e-8.

    Examples
    --------
    >>> from contactkit.lubrication import film_limits, squeeze_film
    >>> from contactkit.lubrication.flow_laws.newtonian import Newtonian
    >>> from contactkit.lubrication.flow_laws.squeeze import squeeze_film as squeeze
    >>> from contactkit.lubrication.flow_laws.walls import Flats
    >>> film = squeeze(Newtonian(viscosity=0.1), Flats(), 1e-5, 1e-2, 3e-3)
    >>> exact = film_limits.disc_tension_truncated(film.force, math.pi * 9e-6, 1e6)
    >>> round(truncated_force(film.radius, film.gradient, 3e-3, 1e6) / exact, 9)
    1.0
    """
    rim = rim_radius if math.isfinite(rim_radius) else float(radius[-1])
    nodes, weights = (np.array(one) for one in gauss_legendre(NODES))
    # Over the logarithm of the radius, at the nodes of each panel.
    place = np.log(radius / rim).reshape(-1, NODES)
    slope = (radius * gradient).reshape(-1, NODES)
    area = math.pi * (radius * radius).reshape(-1, NODES)
    widths = (place[:, -1] - place[:, 0]) / (nodes[-1] - nodes[0])
    ends = place[:, -1] + widths * (1.0 - nodes[-1])
    falls, parts = widths * (slope @ weights), widths * ((area * slope) @ weights)
    outside = np.append(np.cumsum(falls[::-1])[::-1], 0.0)  # tension where each panel begins
    panel = int(np.count_nonzero(outside > strength)) - 1
    if panel < 0:
        return float(parts.sum())
    smooth = np.linalg.solve(legvander(2.0 * nodes - 1.0, NODES - 1), np.log(slope[panel]))
    width, end = float(widths[panel]), math.log(rim) + float(ends[panel])

    def beyond(reach: float) -> tuple[Array, Array]:
        """Integrand from a reach of 0 to 2 before the end of the panel, and squares of the radius.

        At nodes, with their weights.
        """
        back = reach * (1.0 - nodes)
        fall = 0.5 * reach * weights * np.exp(legval(1.0 - back, smooth))
        return fall, np.exp(2.0 * end - width * back)

    left = (strength - float(outside[panel + 1])) / width
    found = bracketed_root(lambda reach: float(beyond(reach)[0].sum()) - left, 0.0, 2.0)
    fall, square = beyond(found)
    return float(width * math.pi * (fall * square).sum() + parts[panel + 1 :].sum())
