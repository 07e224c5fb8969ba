r"""DMT: adhesion around a contact of Hertz' shape, for stiff, small, weakly sticky bodies.

In the units of `adhesion_scales`, with a contact radius a, a load P (a pull is negative) and an
approach delta (a gap h is its negative):

.. math:: P = a^3 - 2, \qquad \delta = a^2

Before touch the surfaces keep their shape and attract by a constant stress across gaps up to
:math:`h_0 = 2 / (\pi \lambda)`, which is Dugdale's picture and the limit of `maugis_dugdale` for
:math:`\lambda \to 0`:

.. math:: -P = 2 (1 - h / h_0)

Only ``+ - * / **`` touch the arguments: floats or arrays; nothing is checked.

References
----------
.. [1] B. V. Derjaguin, V. M. Muller and Y. P. Toporov, J. Colloid Interface Sci. 53 (1975) 314.
.. [2] D. Maugis, J. Colloid Interface Sci. 150 (1992) 243.
"""

from __future__ import annotations

import math
from typing import Any

__all__ = ["PULL_OFF_FORCE", "force_before_touch", "load", "radius_at_load", "reach"]

PULL_OFF_FORCE = 2.0


def load(contact_radius: Any) -> Any:
    """Load on a contact of a radius; its approach is the square of the radius."""
    return contact_radius**3 - PULL_OFF_FORCE


def radius_at_load(load: Any) -> Any:
    """Contact radius under a load of -2 or more.

    Examples
    --------
    >>> radius_at_load(-2.0), radius_at_load(6.0)
    (0.0, 2.0)
    """
    return (load + PULL_OFF_FORCE) ** (1.0 / 3.0)


def reach(transition: Any) -> Any:
    r"""Largest gap across which the surfaces attract, :math:`2 / (\pi \lambda)`."""
    return 2.0 / (math.pi * transition)


def force_before_touch(gap: Any, transition: Any) -> Any:
    """Attraction of surfaces that do not touch, at a gap within their reach.

    Examples
    --------
    >>> force_before_touch(0.0, 0.1), round(force_before_touch(reach(0.1), 0.1), 15)
    (2.0, 0.0)
    """
    return PULL_OFF_FORCE * (1.0 - gap / reach(transition))
