r"""Forces of viscous films that textbooks and papers print: Stefan, Reynolds, Brenner, Goldman.

A force is positive and resists. The liquid is Newtonian, of viscosity eta; it floods the gap, and
inertia is left out. Stefan's and Reynolds' laws are those of lubrication theory. Brenner's series
solves the Stokes equations around a sphere near a wall, so that it judges lubrication theory;
Goldman's is their limit for a narrow gap.

References
----------
.. [1] J. Stefan, Sitzungsber. Akad. Wiss. Wien 69 (1874) 713; O. Reynolds, Phil. Trans. R. Soc. 177
   (1886) 157.
.. [2] H. Brenner, Chem. Eng. Sci. 16 (1961) 242, Eq. 2.19; as in stochasticHydroTools/
   RigidMultiblobsWall (commit ff965b0c), ``mobilities/selfMobilityBrenner.py``, and bishopgroup/
   CCEPdynamics (commit 6078efa3), ``CalcXA.m``.
.. [3] A. J. Goldman, R. G. Cox and H. Brenner, Chem. Eng. Sci. 22 (1967) 637, Eq. 2.65; as in
   RigidMultiblobsWall (commit 073c04ee), ``mobilities/selfMobilityGoldman.py``.
"""

from __future__ import annotations

import math

__all__ = [
    "brenner_factor",
    "goldman_factor",
    "reynolds_sphere_force",
    "stefan_force",
    "stefan_time",
]


def stefan_force(viscosity: float, radius: float, gap: float, speed: float) -> float:
    r"""Force [N] on a flooded disc, :math:`F = \tfrac{3\pi}{2} \eta R^4 \dot h/h^3` (Stefan).

    Parameters
    ----------
    viscosity : float
        eta [Pa.s].
    radius : float
        Radius R of the disc [m].
    gap : float
        Gap h [m], much smaller than R.
    speed : float
        Speed of opening [m/s]; of closing if negative.

    Returns
    -------
    float

    Raises
    ------
    ValueError
        For a viscosity, radius or gap that is not positive.

    Examples
    --------
    >>> round(stefan_force(viscosity=0.1, radius=1e-3, gap=1e-5, speed=1e-3), 6)
    0.471239
    """
    _positive(viscosity=viscosity, radius=radius, gap=gap)
    return 1.5 * math.pi * viscosity * radius**4 * speed / gap**3


def stefan_time(viscosity: float, radius: float, start: float, end: float, force: float) -> float:
    r"""Time [s] in which a constant force draws flooded discs apart, or presses them together.

    .. math:: t = \frac{3\pi \eta R^4}{4 F} \left( \frac{1}{h_1^2} - \frac{1}{h_2^2} \right)

    Parameters
    ----------
    viscosity, radius : float
        As in `stefan_force`.
    start, end : float
        Gaps h_1 and h_2 [m].
    force : float
        F [N], positive if it opens the gap.

    Returns
    -------
    float

    Raises
    ------
    ValueError
        For a viscosity, radius or gap that is not positive, or a force of the wrong sign.

    Examples
    --------
    >>> round(stefan_time(viscosity=0.1, radius=1e-3, start=1e-6, end=1e-3, force=1.0), 6)
    0.235619
    """
    _positive(viscosity=viscosity, radius=radius, start=start, end=end)
    if force == 0.0 or (force > 0.0) != (end > start):
        raise ValueError(
            f"force = {force} N: must open the gap (positive) where end > start, and close it "
            "(negative) where end < start"
        )
    change = 1.0 / start**2 - 1.0 / end**2
    return 0.75 * math.pi * viscosity * radius**4 / force * change


def reynolds_sphere_force(viscosity: float, radius: float, gap: float, speed: float) -> float:
    r"""Force [N] on a flooded sphere, :math:`F = 6\pi\eta R^2 \dot D/D`: Reynolds' equation.

    Parameters
    ----------
    viscosity, speed : float
        As in `stefan_force`.
    radius : float
        Radius R of the sphere [m].
    gap : float
        Gap D under the apex [m].

    Returns
    -------
    float

    Raises
    ------
    ValueError
        For a viscosity, radius or gap that is not positive.

    Notes
    -----
    Too small, compared with Brenner's series: by 0.2 % at D/R = 0.001, 2 % at 0.01 and 13 % at 0.1.

    Examples
    --------
    >>> round(reynolds_sphere_force(viscosity=0.1, radius=1e-3, gap=1e-5, speed=1e-3) * 1e6, 4)
    188.4956
    """
    _positive(viscosity=viscosity, radius=radius, gap=gap)
    return 6.0 * math.pi * viscosity * radius**2 * speed / gap


def brenner_factor(gap_ratio: float) -> float:
    r"""Force on a sphere that moves towards a wall or off it, over :math:`6\pi\eta R v` (Brenner).

    .. math:: \lambda = \tfrac43 \sinh\alpha \sum_{n=1}^{\infty} \frac{n(n+1)}{(2n-1)(2n+3)}
              \left[ \frac{2\sinh(2n+1)\alpha + (2n+1)\sinh 2\alpha}
              {4\sinh^2(n+\frac12)\alpha - (2n+1)^2\sinh^2\alpha} - 1 \right], \qquad
              \cosh\alpha = 1 + D/R

    Parameters
    ----------
    gap_ratio : float
        Gap over radius D/R [-], from 1e-8 on.

    Returns
    -------
    float
        Factor [-]; 1 far away, R/D - (1/5) ln(D/R) + 0.971 close by.

    Raises
    ------
    ValueError
        For a ratio below 1e-8, where the sum would take more than a million terms.

    Notes
    -----
    Exact for the Stokes equations; the sum is ended where its terms fall below 1e-17 of the total.

    Examples
    --------
    A sphere one radius and a hundred radii off the wall; Faxen's limit is 1 + (9/8) R/h.

    >>> round(brenner_factor(1.0), 4), round(brenner_factor(99.0), 4)
    (2.1255, 1.0114)
    """
    if not 1e-8 <= gap_ratio < math.inf:
        raise ValueError(f"gap_ratio = {gap_ratio}: must be finite and at least 1e-8")
    alpha = 2.0 * math.asinh(math.sqrt(0.5 * gap_ratio))
    total, sinh = 0.0, math.sinh(alpha)
    n = 0
    while True:
        n += 1
        m = 2.0 * n + 1.0
        term = n * (n + 1.0) / ((2.0 * n - 1.0) * (2.0 * n + 3.0)) * _bracket(m, alpha, sinh)
        total += term
        if term < 1e-17 * total:
            return 4.0 / 3.0 * sinh * total


def _bracket(m: float, alpha: float, sinh: float) -> float:
    """Bracket of Brenner's series for 2n + 1 = m, times e^(-m alpha) above and below."""
    # 4 sinh^2(m alpha/2) = 2 cosh(m alpha) - 2, and the -1 is put over the same denominator.
    decay = math.exp(-m * alpha)
    above = 2.0 * (1.0 - decay) * decay + decay * (m * math.sinh(2.0 * alpha) + (m * sinh) ** 2)
    below = (1.0 - decay) ** 2 - decay * (m * sinh) ** 2
    if m * alpha < 0.1:  # both cancel to the fourth power of m alpha: their series
        return _small_bracket(m, alpha)
    return above / below


def _small_bracket(m: float, alpha: float) -> float:
    """The same for a small m alpha, by the power series of the hyperbolic functions."""
    x, y = m * alpha, alpha
    sine_part = 2.0 * math.sinh(x) + m * math.sinh(2.0 * y)
    # 2 cosh x - 2 - m^2 sinh^2 y, with x = m y: the terms of second order cancel.
    cosine = sum(2.0 * x ** (2 * k) / math.factorial(2 * k) for k in range(2, 9))
    square = sum(0.5 * (2.0 * y) ** (2 * k) / math.factorial(2 * k) for k in range(2, 9))
    return sine_part / (cosine - m * m * square) - 1.0


def goldman_factor(gap_ratio: float) -> float:
    r"""Force on a sphere that slides along a wall, over :math:`6\pi\eta R v`, for a narrow gap.

    .. math:: -\tfrac{8}{15} \ln(D/R) + 0.9588

    Without rotation, in a flooded gap (Goldman, Cox and Brenner).

    Parameters
    ----------
    gap_ratio : float
        Gap over radius D/R [-], up to 1.

    Returns
    -------
    float
        Factor [-].

    Raises
    ------
    ValueError
        For a ratio that is not between 0 and 1.

    Notes
    -----
    A limit for D/R towards 0. Its slope -8/15 is that of lubrication theory, the constant is not:
    it comes from the liquid far away.

    Examples
    --------
    >>> round(goldman_factor(1e-3), 4)
    4.6429
    """
    if not 0.0 < gap_ratio <= 1.0:
        raise ValueError(f"gap_ratio = {gap_ratio}: must be above 0 and at most 1, a narrow gap")
    return 0.9588 - 8.0 / 15.0 * math.log(gap_ratio)


def _positive(**given: float) -> None:
    for name, value in given.items():
        if not 0.0 < value < math.inf:
            raise ValueError(f"{name} = {value} in SI units: must be positive and finite")
