r"""An electromagnet with two poles and a moving armature: flux, current, force and energy.

.. math::
    \lambda' = u - R\,i, \qquad
    i = \frac{\lambda}{\mu_0 N^2 A}\left[2 (g - h) + g_i \left(1 + (B/B_s)^8\right)\right], \qquad
    F = \frac{\lambda^2}{\mu_0 N^2 A}, \qquad B = \frac{\lambda}{N A}

The gap h is that of the film the magnet opens: each of its two air gaps is ``air_gap - h``.

Left out: eddy currents (they delay the force by some 0.1 ms in solid iron, little in a laminated
core), hysteresis (some per cent of the force stay behind), fringing of the air gaps (the force is
right within about 5 % while an air gap is below a tenth of the width of a pole). Plain floats
only: this also runs inside an FMU.
"""

from __future__ import annotations

import math
from collections.abc import Callable

from attrs import field, frozen

from ...errors import ConvergenceError
from ...units import si
from ...validators import count, optional, positive

__all__ = [
    "Coil",
    "StepCount",
    "advance_flux",
    "current",
    "field_energy",
    "flux_rate",
    "inductance",
    "magnet_force",
]

_MU0 = 4e-7 * math.pi  # [N/A2]
# How sharply the iron saturates: at `saturation` its reluctance has doubled, 10 % below it has
# risen by 43 %, 10 % above to three times; with 4 the knee is rounder (66 % and 2.5 times). An
# assumption; an even power makes the law the same for both signs of the flux.
_KNEE = 8
MOST_STEPS = 100_000  # some seconds of steady voltage; then the motion given is no motion
_FLUX_RTOL = 1e-11  # far below what the extrapolated gap of a co-simulation is worth


@frozen(kw_only=True)
class Coil:
    """An electromagnet with two equal poles, whose armature is the spool.

    Parameters
    ----------
    resistance : float
        Resistance of the circuit [ohm].
    turns : int
        Number of turns [-].
    pole_area : float
        Area of each of the two poles [m2].
    air_gap : float
        Air gap at each pole while the spool touches the end cap, h = 0 [m].
    iron_gap : float
        Length of air that resists like the whole path through iron, plates and joints [m].
    saturation : float, optional
        Flux density at which the iron path resists twice as much [T]. None: it never does.
    """

    resistance: float = field(validator=positive, metadata=si("ohm"))
    turns: int = field(validator=count, metadata=si("-"))
    pole_area: float = field(validator=positive, metadata=si("m2"))
    air_gap: float = field(validator=positive, metadata=si("m"))
    iron_gap: float = field(validator=positive, metadata=si("m"))
    saturation: float | None = field(default=None, validator=optional(positive), metadata=si("T"))


def _reluctance(coil: Coil, gap: float) -> float:
    """Length of air [m] that resists the flux as the unsaturated circuit does."""
    # Never below the iron's: the armature cannot pass the poles, though an extrapolation may.
    return 2.0 * max(coil.air_gap - gap, 0.0) + coil.iron_gap


def _pole(coil: Coil) -> float:
    """Inductance times length of air [H.m]."""
    return _MU0 * coil.turns**2 * coil.pole_area


def _crowding(coil: Coil, flux: float) -> float:
    """Additional resistance of the saturated iron, over that of the iron [-]."""
    if coil.saturation is None:
        return 0.0
    return (flux / (coil.turns * coil.pole_area * coil.saturation)) ** _KNEE


def inductance(coil: Coil, gap: float) -> float:
    """Inductance [H] at a gap [m] while the iron is not saturated."""
    return _pole(coil) / _reluctance(coil, gap)


def current(coil: Coil, flux: float, gap: float) -> float:
    """Current [A] at a flux linkage [Wb] and a gap [m]."""
    return flux * (_reluctance(coil, gap) + coil.iron_gap * _crowding(coil, flux)) / _pole(coil)


def flux_rate(coil: Coil, flux: float, gap: float, applied: float) -> float:
    """Rate [V] of the flux linkage under an applied voltage [V], whatever the diode says."""
    return applied - coil.resistance * current(coil, flux, gap)


def field_energy(coil: Coil, flux: float, gap: float) -> float:
    """Energy [J] of the magnetic field, the integral of the current over the flux linkage."""
    iron = coil.iron_gap * _crowding(coil, flux) / (_KNEE + 2)
    return flux * flux * (0.5 * _reluctance(coil, gap) + iron) / _pole(coil)


def magnet_force(coil: Coil, flux: float) -> float:
    r"""Force [N] of the magnet, :math:`\lambda^2/(\mu_0 N^2 A)`; positive opens.

    Notes
    -----
    Minus the slope of `field_energy` along the air gap at constant flux; no gap enters, as the
    force follows the flux alone. Validity: see the head of this module.

    Examples
    --------
    One tesla across two poles of 50 mm2:

    >>> coil = Coil(resistance=1.0, turns=40, pole_area=50e-6, air_gap=0.1e-3, iron_gap=20e-6)
    >>> round(magnet_force(coil, 40 * 50e-6), 3)
    39.789
    """
    return flux * flux / _pole(coil)


def _rate(coil: Coil, applied: float) -> Callable[[float, float], float]:
    """`flux_rate` over flux and gap, with what stays the same worked out once."""
    fall = coil.resistance / _pole(coil)
    air, iron = 2.0 * coil.air_gap, coil.iron_gap
    knee = math.inf if coil.saturation is None else coil.turns * coil.pole_area * coil.saturation

    def rate(flux: float, gap: float) -> float:
        reluctance = max(air - 2.0 * gap, 0.0) + iron * (1.0 + (flux / knee) ** _KNEE)
        return applied - fall * flux * reluctance

    return rate


def _runge_kutta(
    rate: Callable[[float, float], float], flux: float, gap: float, speed: float, step: float
) -> float:
    half, middle = 0.5 * step, gap + 0.5 * speed * step
    k1 = rate(flux, gap)
    k2 = rate(flux + half * k1, middle)
    k3 = rate(flux + half * k2, middle)
    k4 = rate(flux + step * k3, gap + speed * step)
    return flux + step * (k1 + 2.0 * (k2 + k3) + k4) / 6.0


class StepCount:
    """Steps taken by several calls of `advance_flux`, with one limit for all."""

    def __init__(self, most: int = MOST_STEPS) -> None:
        self.left = most


def advance_flux(
    coil: Coil,
    flux: float,
    gap: float,
    speed: float,
    applied: float,
    duration: float,
    steps: StepCount | None = None,
) -> float:
    """Flux linkage [Wb] after a time under constant voltage, while the gap moves at a speed.

    Parameters
    ----------
    coil : Coil
    flux, gap, speed : float
        Flux linkage [Wb], gap [m] and its rate [m/s] at the start.
    applied : float
        Voltage [V].
    duration : float
        Length of the time [s].
    steps : StepCount, optional
        What it may take, shared with other calls; 100 000 without it.

    Notes
    -----
    Classical Runge-Kutta steps, halved and extrapolated, to about 1e-11 of the flux. Where the
    diode blocks, the flux is zero from there to the end, as nothing but a voltage can raise it.

    Raises
    ------
    ConvergenceError
        If the end is not reached in that many steps, as of a motion that leads out of all bounds.
    """
    if flux <= 0.0 and applied <= 0.0:
        return 0.0
    # No first try beyond what an explicit method can stand; a step grows at most fourfold.
    time, length = 0.0, 0.5 * inductance(coil, gap) / coil.resistance

    rate = _rate(coil, applied)

    def rk4(value: float, at: float, step: float) -> float:
        try:
            return _runge_kutta(rate, value, gap + speed * at, speed, step)
        except OverflowError:  # of a first try that is far too long
            return math.nan

    scale = _FLUX_RTOL * (flux + abs(applied) * duration)
    count = steps or StepCount()
    while count.left > 0:
        count.left -= 1
        if time >= duration:
            return flux
        length = min(length, duration - time)
        whole, half = rk4(flux, time, length), 0.5 * length
        halves = rk4(rk4(flux, time, half), time + half, half)
        error = abs(halves - whole) / (15.0 * scale)
        if error <= 1.0:
            flux, time = halves + (halves - whole) / 15.0, time + length
            if flux <= 0.0 and applied <= 0.0:
                return 0.0
        if not error < 1e300:
            error = 1e5
        length *= min(4.0, max(0.1, 0.9 * max(error, 1e-12) ** -0.2))
        if time + length == time:
            break
    raise ConvergenceError(
        f"the flux of the coil did not follow a gap of {gap:g} m that moves at {speed:g} m/s for "
        f"{duration:g} s: it got to {time:g} s; give a smaller speed or shorter steps"
    )
