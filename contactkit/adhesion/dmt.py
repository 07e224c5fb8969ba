r"""DMT adhesion: attraction outside a contact of Hertzian shape, for stiff, small bodies.

In the units of `parameters`, with contact radius a, load P (tensile if negative) and approach delta
(a gap h is its negative):

.. math:: P = a^3 - 2, \qquad \delta = a^2

Out of contact the surfaces are undeformed and attract with a constant stress across gaps up to
:math:`h_0 = 2 / (\pi \lambda)` (Dugdale); this is the limit of `maugis_dugdale` for
:math:`\lambda \to 0`:

.. math:: -P = 2 (1 - h / h_0)

Arguments are floats or arrays and are not checked.

References
----------
.. [1] B. V. Derjaguin, V. M. Muller and Y. P. Toporov, J. Colloid Interface Sci. 53 (1975) 314.
.. [2] D. Maugis, J. Colloid Interface Sci. 150 (1992) 243.
"""

from __future__ import annotations

import math
from typing import Any

__all__ = ["PULL_OFF_FORCE", "force_before_touch", "load", "radius_at_load", "reach"]

PULL_OFF_FORCE = 2.0  # in units of pi w R: the attraction of rigid spheres (Bradley 1932)


def load(contact_radius: Any) -> Any:
    """Load on a contact of given radius; the approach is the square of the radius."""
    return contact_radius**3 - PULL_OFF_FORCE


def radius_at_load(load: Any) -> Any:
    """Contact radius under a load of at least -2.

    Examples
    --------
    >>> radius_at_load(-2.0), radius_at_load(6.0)
    (0.0, 2.0)
    """
    return (load + PULL_OFF_FORCE) ** (1.0 / 3.0)


def reach(transition: Any) -> Any:
    r"""Range of the attraction: maximum gap, :math:`2 / (\pi \lambda)`."""
    return 2.0 / (math.pi * transition)


def force_before_touch(gap: Any, transition: Any) -> Any:
    """Attraction out of contact, at a gap within its range.

    Examples
    --------
    >>> force_before_touch(0.0, 0.1), round(force_before_touch(reach(0.1), 0.1), 15)
    (2.0, 0.0)
    """
    return PULL_OFF_FORCE * (1.0 - gap / reach(transition))
