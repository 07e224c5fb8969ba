r"""Elastic contact in a meniscus of given pressure: Maugis' cohesive zone is the liquid.

The liquid surrounds the contact of a sphere up to where the gap is the height of its meniscus,
:math:`h_m = \gamma_c/p_L`, and pulls with its Laplace pressure p_L. That is the model of Maugis and
Dugdale with :math:`\sigma_0 = p_L` and :math:`w = \gamma_c`: exact for half-spaces, as far as the
liquid follows, at a given humidity. The transition parameter then says what the liquid does: below
0.1 the pull-off force is :math:`2 \pi R \gamma_c` (DMT, stiff), above 3 it is
:math:`1.5 \pi R \gamma_c` (JKR, soft).

Arguments are floats and are not checked.

References
----------
.. [1] D. Maugis, J. Colloid Interface Sci. 150 (1992) 243.
.. [2] D. Maugis and B. Gauthier-Manuel, J. Adhesion Sci. Technol. 8 (1994) 1311: menisci.
"""

from __future__ import annotations

from typing import NamedTuple

from . import maugis_dugdale
from .maugis_dugdale import Cohesion
from .parameters import scales, transition_parameter

__all__ = ["WetContact", "WetLimits", "limits", "state_under_load"]


class WetContact(NamedTuple):
    """A contact in its meniscus: contact radius [m], rim [m], load [N], approach [m].

    A tensile load is negative, as is the approach of bodies that are apart.
    """

    contact_radius: float
    rim_radius: float
    load: float
    approach: float


class WetLimits(NamedTuple):
    """Transition parameter [-], pull-off under load control and under displacement control."""

    transition: float
    pull_off: WetContact
    release: WetContact


def _in_si(state: Cohesion, radius: float, wetting: float, modulus: float) -> WetContact:
    units = scales(radius, wetting, modulus)
    return WetContact(
        state.contact_radius * units.radius,
        state.cohesive_radius * units.radius,
        state.load * units.load,
        state.approach * units.approach,
    )


def limits(pressure: float, radius: float, modulus: float, wetting: float) -> WetLimits:
    """Pull-off of a wet contact.

    Parameters
    ----------
    pressure : float
        Laplace pressure p_L of the liquid [Pa], positive.
    radius, modulus : float
        R [m] and E* [Pa].
    wetting : float
        gamma_c [N/m].

    Examples
    --------
    >>> found = limits(1e6, 1e-3, 1e9, 0.1)
    >>> round(found.transition, 4), round(-found.pull_off.load * 1e3, 4)
    (0.2429, 0.5817)
    """
    transition = transition_parameter(radius, wetting, modulus, pressure)
    found = maugis_dugdale.limits(transition)
    ends = (_in_si(one, radius, wetting, modulus) for one in (found.pull_off, found.release))
    return WetLimits(float(transition), *ends)


def state_under_load(
    load: float, pressure: float, radius: float, modulus: float, wetting: float
) -> WetContact:
    """Contact under a load [N]; that of pull-off for any that is less.

    Parameters
    ----------
    load : float
        [N]; tensile loads are negative.
    pressure, radius, modulus, wetting
        As of `limits`.

    Examples
    --------
    >>> rests = state_under_load(0.0, 1e6, 1e-3, 1e9, 0.1)
    >>> round(rests.contact_radius * 1e6, 4), round(rests.rim_radius * 1e6, 4)
    (8.7428, 17.3609)
    """
    transition = float(transition_parameter(radius, wetting, modulus, pressure))
    units = scales(radius, wetting, modulus)
    bounds = maugis_dugdale.limits(transition)
    found = maugis_dugdale.at_load(load / units.load, transition, bounds)
    return _in_si(found, radius, wetting, modulus)
