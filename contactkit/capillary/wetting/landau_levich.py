r"""Thickness of the film that a receding meniscus leaves behind, by Landau, Levich and Derjaguin.

.. math:: e = \frac{1.34}{\kappa}\, Ca^{2/3}

with the curvature kappa of the static meridian where it meets the wall, which is the length of the
problem: sqrt(2) over the capillary length at a plate drawn from a pool (0.94 of that length, as
Landau and Levich have it), 1/r in a tube (Bretherton), and :math:`(c_1 + c_2)/H` in a bridge of
the height H at its rim. Floats or arrays.
"""

from __future__ import annotations

from typing import Any, Literal

__all__ = ["THICKNESS_LAWS", "ThicknessLaw", "film_fraction"]

ThicknessLaw = Literal["aussillous-quere", "landau-levich"]
THICKNESS_LAWS: tuple[ThicknessLaw, ...] = ("aussillous-quere", "landau-levich")

_COEFFICIENT = (
    1.3375  # curvature that the film meets the meniscus with: 0.643 * 3**(2/3), Bretherton
)
_SATURATES = 2.5  # fitted to Taylor's films in tubes, Aussillous and Quere 2000


def film_fraction(capillary_number: Any, law: ThicknessLaw = "landau-levich") -> Any:
    r"""Thickness of the deposited film times the curvature of the static meniscus [-].

    Parameters
    ----------
    capillary_number : float or array_like
        eta U/gamma of the receding line [-], not negative.
    law : {"landau-levich", "aussillous-quere"}
        ``"landau-levich"``: 1.34 Ca^(2/3), the limit of small Ca. ``"aussillous-quere"``: that over
        1 + 3.35 Ca^(2/3), since the film itself narrows the meniscus; it follows Taylor's films in
        tubes up to Ca of about 1. The first is 3.4 % more at Ca = 1e-3, 10 % at 5e-3, 16 % at 1e-2.

    References
    ----------
    .. [1] Landau and Levich (1942), Acta Physicochim. URSS 17, 42; Derjaguin (1943), ibid. 20, 349.
    .. [2] Bretherton (1961), J. Fluid Mech. 10, 166.
    .. [3] Aussillous and Quere (2000), Phys. Fluids 12, 2367.

    Examples
    --------
    A plate drawn from a pool, over the capillary length:

    >>> round(film_fraction(1e-3) / 2.0**0.5, 5)
    0.00946
    >>> round(film_fraction(5e-3) / film_fraction(5e-3, "aussillous-quere"), 3)
    1.098
    """
    thin = _COEFFICIENT * capillary_number ** (2.0 / 3.0)
    return thin if law == "landau-levich" else thin / (1.0 + _SATURATES * thin)
