r"""Torque of a flat electrode on a tilting plate: closed forms that do not cancel.

.. math::
    C(\theta) = \varepsilon_0 b \int_{x_1}^{x_2} \frac{dx}{d - x s}, \qquad
    T = \tfrac12 V^2 \frac{dC}{d\theta}
      = \tfrac12 \varepsilon_0 b V^2 \cos\theta \int_{x_1}^{x_2} \frac{x\,dx}{(d - x s)^2}, \qquad
    s = \sin\theta

The plate turns about an axis at a height d over the electrode, which reaches from :math:`x_1` to
:math:`x_2` on the side that goes down; x runs along the plate. The textbook form of the integral,

.. math:: \frac{1}{s^2} \left[\ln\frac{d - x_2 s}{d - x_1 s} + \frac{d}{d - x_2 s}
          - \frac{d}{d - x_1 s}\right],

loses all digits for a level plate. With :math:`\tau = x_1/(d - x_1 s)`,
:math:`\rho = (x_2 - x_1)/(d - x_2 s)` and :math:`y = \rho s` the same integrals are

.. math::
    \int \frac{dx}{d - x s} = \rho\, S_1(y), \quad
    \int \frac{x\,dx}{(d - x s)^2} = \tau\rho + \rho^2 S_2(y), \quad
    \int \frac{x^2 dx}{(d - x s)^3} = \tau^2\rho\,(1 + \tfrac{y}{2}) + \tau\rho^2 + \rho^3 S_3(y)

with :math:`S_1 = \ln(1+y)/y`, :math:`S_2 = (y - \ln(1+y))/y^2`,
:math:`S_3 = (y^2/2 - y + \ln(1+y))/y^3`, which are 1, 1/2 and 1/3 at y = 0.

Left out: the field at the edges (more torque, by about the gap over the width, some 20 % for a
micromirror) and the curvature of the field lines between plates at an angle (:math:`\theta^2/3`,
1 % at 10 degrees). Plain floats only: this also runs inside an FMU.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from attrs import field, frozen

from ...errors import DescriptionError, InfeasibleError
from ...numerics.roots import bracketed_root
from ...units import si
from ...validators import non_negative, positive

__all__ = [
    "Electrode",
    "PullIn",
    "capacitance",
    "largest_tilt",
    "pull_in",
    "torque",
    "torque_slope",
]

_EPSILON0 = 8.8541878128e-12  # [F/m], CODATA 2018
# Below this the logarithms cancel, to the cube of y: 5e-15 at 0.2, 1e-13 at 0.05. The series
# converges as y^n: with its 26 terms it would do up to 0.3, and is off by 1e-10 at 0.5.
_NEAR = 0.2
_TERMS = 26  # 20 reach round-off, 18 leave 3e-15 and 13 leave 3e-11


@frozen(kw_only=True)
class Electrode:
    """A rectangular electrode under one side of a plate that turns.

    Parameters
    ----------
    width : float
        Extent along the axis [m].
    inner, outer : float
        Distances from the axis at which it begins and ends [m].
    gap : float
        Height of the level plate over it [m].

    Examples
    --------
    >>> pad = Electrode(width=8e-6, inner=1e-6, outer=5.5e-6, gap=1.5e-6)
    >>> round(math.degrees(largest_tilt(pad)), 3)
    15.827
    """

    width: float = field(validator=positive, metadata=si("m"))
    inner: float = field(default=0.0, validator=non_negative, metadata=si("m"))
    outer: float = field(validator=positive, metadata=si("m"))
    gap: float = field(validator=positive, metadata=si("m"))

    def __attrs_post_init__(self) -> None:
        if self.inner >= self.outer:
            raise DescriptionError(
                "Electrode.inner", self.inner, f"be less than outer = {self.outer:g} m", unit="m"
            )


class PullIn(NamedTuple):
    """Tilt and voltage at which the torque outgrows a torsional spring."""

    tilt: float
    """Tilt beyond which no voltage is stable [rad]."""
    voltage: float
    """Voltage that leads there [V]."""


def _series(first: int, y: float) -> float:
    total = 0.0
    for n in range(_TERMS + first - 1, first - 1, -1):
        total = 1.0 / n - y * total
    return total


def _s1(y: float) -> float:
    return math.log1p(y) / y if y else 1.0


def _s2(y: float) -> float:
    return (y - math.log1p(y)) / (y * y) if abs(y) > _NEAR else _series(2, y)


def _s3(y: float) -> float:
    if abs(y) <= _NEAR:
        return _series(3, y)
    return (0.5 * y * y - y + math.log1p(y)) / (y * y * y)


def largest_tilt(electrode: Electrode) -> float:
    """Tilt [rad] at which the plate touches the electrode; pi/2 if it never does."""
    return math.asin(min(electrode.gap / electrode.outer, 1.0))


def _parts(electrode: Electrode, tilt: float) -> tuple[float, float, float]:
    """tau, rho and y of the head of this module."""
    s, d = math.sin(tilt), electrode.gap
    left = d - electrode.outer * s
    if left <= 0.0:
        raise InfeasibleError(
            f"the plate meets the electrode at a tilt of {largest_tilt(electrode):g} rad, got "
            f"{tilt:g} rad; give a stop before that, stiffer tips, or a lower voltage"
        )
    rho = (electrode.outer - electrode.inner) / left
    return electrode.inner / (d - electrode.inner * s), rho, rho * s


def capacitance(electrode: Electrode, tilt: float) -> float:
    r"""Capacitance [F], :math:`\varepsilon_0 b \rho S_1`; the tilt [rad] is positive towards it.

    Raises
    ------
    InfeasibleError
        If the plate would pass the electrode.

    Examples
    --------
    >>> pad = Electrode(width=8e-6, outer=5e-6, gap=1e-6)
    >>> round(capacitance(pad, 0.0) / (8.8541878128e-12 * 8e-6 * 5e-6 / 1e-6), 14)
    1.0
    """
    _, rho, y = _parts(electrode, tilt)
    return _EPSILON0 * electrode.width * rho * _s1(y)


def torque(electrode: Electrode, tilt: float, voltage: float) -> float:
    r"""Torque [N.m] of a voltage [V] that turns the plate towards the electrode.

    Parameters
    ----------
    electrode : Electrode
    tilt : float
        Tilt [rad], positive towards the electrode; negative on the way up.
    voltage : float
        Voltage between plate and electrode [V]; its sign does not matter.

    Raises
    ------
    InfeasibleError
        If the plate would pass the electrode.

    Notes
    -----
    See the head of this module for the formula and what it leaves out.

    Examples
    --------
    A level plate is a plate condenser, and its torque the pressure times the first moment:

    >>> pad = Electrode(width=8e-6, outer=5e-6, gap=1e-6)
    >>> pressure = 0.5 * 8.8541878128e-12 * (20.0 / 1e-6) ** 2
    >>> round(torque(pad, 0.0, 20.0) / (pressure * 8e-6 * 0.5 * 5e-6**2), 14)
    1.0
    """
    tau, rho, y = _parts(electrode, tilt)
    integral = rho * (tau + rho * _s2(y))
    return 0.5 * _EPSILON0 * electrode.width * voltage * voltage * math.cos(tilt) * integral


def torque_slope(electrode: Electrode, tilt: float, voltage: float) -> float:
    """Derivative of `torque` with respect to the tilt [N.m/rad]."""
    tau, rho, y = _parts(electrode, tilt)
    second = rho * (tau + rho * _s2(y))
    third = rho * (tau * tau * (1.0 + 0.5 * y) + rho * (tau + rho * _s3(y)))
    c = math.cos(tilt)
    factor = 0.5 * _EPSILON0 * electrode.width * voltage * voltage
    return factor * (2.0 * c * c * third - math.sin(tilt) * second)


def pull_in(electrode: Electrode, stiffness: float) -> PullIn:
    r"""Find the largest tilt at which a spring [N.m/rad] holds the plate, and its voltage.

    Notes
    -----
    Where :math:`k\theta = T` and :math:`k = dT/d\theta` together, that is
    :math:`T = \theta\,dT/d\theta`: the tilt does not depend on the spring. For an electrode that
    begins at the axis and small tilts it is 0.44042 of the tilt at which the plate would touch.

    Examples
    --------
    >>> pad = Electrode(width=8e-6, outer=100e-6, gap=1e-6)
    >>> round(pull_in(pad, 1e-12).tilt / largest_tilt(pad), 4)
    0.4404
    """

    def excess(tilt: float) -> float:
        return torque(electrode, tilt, 1.0) - tilt * torque_slope(electrode, tilt, 1.0)

    high = largest_tilt(electrode)
    if electrode.gap >= electrode.outer and excess(0.999999 * high) > 0.0:
        raise InfeasibleError(
            "the plate never meets the electrode, and no voltage pulls it in: its gap of "
            f"{electrode.gap:g} m exceeds its reach of {electrode.outer:g} m; "
            "lower Electrode.gap, or raise Electrode.outer"
        )
    tilt = bracketed_root(excess, 0.0, 0.999999 * high)
    return PullIn(tilt, math.sqrt(stiffness * tilt / torque(electrode, tilt, 1.0)))
