r"""Static bridge between a sphere and a flat that deform: closed forms on half-spaces.

The liquid of the pressure -p_L on the disc of radius a draws both bodies in, as a uniform pressure
does (Johnson, Contact Mechanics, 1985, Eq. 3.29): by 2 p_L a/E* in the middle, 4 p_L a/(pi E*) at
the rim, 16 p_L a/(3 pi E*) in the mean. With z the gap of the undeformed bodies on the axis and
:math:`\gamma_c = \gamma (\cos\theta_1 + \cos\theta_2)`,

.. math::
    z + \frac{a^2}{2 R} - \frac{4 p_L a}{\pi E^*} &= \frac{\gamma_c}{p_L} \\
    V &= \pi a^2 \left( z + \frac{a^2}{4 R} \right) - \frac{16\,p_L a^3}{3 E^*}, \qquad
    F = \pi a^2 p_L

Left out are the pull of the rim itself, :math:`2 \pi a \gamma \sin\theta`, of the relative size
h/a, and contact of the solids: a bridge whose gap closes on the axis is none. Rigid bodies have
E* = inf. Arguments are floats and are not checked; `E*` is that of the pair.
"""

from __future__ import annotations

import math
from typing import Literal, NamedTuple

from ..numerics.roots import bracketed_root

__all__ = [
    "ElasticBridge",
    "SnapIn",
    "bridge_at_pressure",
    "bridge_of_volume",
    "snap_in_at_pressure",
    "snap_in_of_volume",
]

_SCAN = 1.02  # ratio of rims in the search of the first fold: a fold and its end lie a factor apart
_SMALLEST = 1e-6  # rim to begin with, over that of rigid bodies that touch: at 1e12 of its gaps


class ElasticBridge(NamedTuple):
    """A bridge: rigid gap, rim, Laplace pressure (of suction), gap on the axis, force, volume.

    In [m], [m], [Pa], [m], [N] and [m3]; the force attracts.
    """

    rigid_gap: float
    rim_radius: float
    laplace_pressure: float
    centre_gap: float
    force: float
    volume: float


class SnapIn(NamedTuple):
    """End of the bridges that come from large gaps: a `fold`, or the `touch` of the axis."""

    event: Literal["fold", "touch"]
    bridge: ElasticBridge


def _bridge(
    gap: float, rim: float, pressure: float, radius: float, modulus: float
) -> ElasticBridge:
    area = math.pi * rim * rim
    return ElasticBridge(
        gap,
        rim,
        pressure,
        gap - 2.0 * pressure * rim / modulus,
        area * pressure,
        area
        * (gap + rim * rim / (4.0 * radius) - 16.0 * pressure * rim / (3.0 * math.pi * modulus)),
    )


def _of_rim(
    rim: float, volume: float, radius: float, modulus: float, wetting: float
) -> tuple[ElasticBridge, float]:
    r"""Bridge of a volume with a rim, and the slope of its rigid gap over the rim.

    The two equations without z: :math:`(4 a/3 \pi E^*) p^2 + (V/\pi a^2 + a^2/4R) p = \gamma_c`.
    """
    square = 4.0 * rim / (3.0 * math.pi * modulus)
    linear = volume / (math.pi * rim * rim) + rim * rim / (4.0 * radius)
    p = 2.0 * wetting / (linear + math.sqrt(linear * linear + 4.0 * square * wetting))
    gap = wetting / p - rim * rim / (2.0 * radius) + 4.0 * p * rim / (math.pi * modulus)
    rises = -2.0 * volume / (math.pi * rim**3) + rim / (2.0 * radius)
    slope = -(square / rim * p * p + rises * p) / (2.0 * square * p + linear)
    drawn = 4.0 * (slope * rim + p) / (math.pi * modulus)
    return _bridge(gap, rim, p, radius, modulus), -wetting * slope / p**2 - rim / radius + drawn


def snap_in_of_volume(volume: float, radius: float, modulus: float, wetting: float) -> SnapIn:
    r"""Last bridge of a volume as the bodies approach.

    Parameters
    ----------
    volume : float
        V [m3].
    radius, modulus : float
        R [m] and E* [Pa].
    wetting : float
        gamma_c [N/m].

    Returns
    -------
    SnapIn
        A fold, at which they jump together, or the touch of the axis where none comes before.

    Notes
    -----
    Exact but for what the module leaves out. Folds lie at :math:`\gamma_c a/(E^* h^2)` of 0.3 to
    0.4 with the gap h at the rim.

    Examples
    --------
    >>> end = snap_in_of_volume(1e-15, 1e-3, 1e6, 0.1)
    >>> end.event, round(end.bridge.rigid_gap * 1e6, 4), round(end.bridge.force * 1e6, 3)
    ('fold', 2.7571, 39.085)
    """

    def sinks(rim: float) -> float:
        return _of_rim(rim, volume, radius, modulus, wetting)[1]

    def room(rim: float) -> float:
        return _of_rim(rim, volume, radius, modulus, wetting)[0].centre_gap

    last = (4.0 * radius * volume / math.pi) ** 0.25
    low = _SMALLEST * last
    high = low
    while sinks(high) < 0.0 < room(high):
        low, high = high, _SCAN * high
    # The one that comes first of those two in the last interval.
    touch = bracketed_root(room, low, high) if room(high) <= 0.0 else math.inf
    fold = bracketed_root(sinks, low, high) if sinks(high) >= 0.0 else math.inf
    event: Literal["fold", "touch"] = "fold" if fold <= touch else "touch"
    return SnapIn(event, _of_rim(min(fold, touch), volume, radius, modulus, wetting)[0])


def bridge_of_volume(
    gap: float, volume: float, radius: float, modulus: float, wetting: float
) -> ElasticBridge | None:
    """Bridge of a volume at a rigid gap, on the branch that comes from large gaps.

    Parameters
    ----------
    gap : float
        z [m].
    volume, radius, modulus, wetting
        As of `snap_in_of_volume`.

    Returns
    -------
    ElasticBridge or None
        None below the gap of snap-in.

    Examples
    --------
    Between rigid bodies, and bodies of 1 MPa, that the bridge draws in:

    >>> stiff, soft = (bridge_of_volume(2.8e-6, 1e-15, 1e-3, E, 0.1) for E in (math.inf, 1e6))
    >>> round(stiff.force * 1e6, 2), round(soft.force * 1e6, 2)
    (12.38, 28.52)
    """
    end = snap_in_of_volume(volume, radius, modulus, wetting).bridge
    if gap < end.rigid_gap:
        return None

    def excess(rim: float) -> float:
        return _of_rim(rim, volume, radius, modulus, wetting)[0].rigid_gap - gap

    low = end.rim_radius
    while excess(low) < 0.0:
        low *= 0.5
    rim = bracketed_root(excess, low, end.rim_radius)
    return _of_rim(rim, volume, radius, modulus, wetting)[0]


def snap_in_at_pressure(
    pressure: float, radius: float, modulus: float, wetting: float
) -> ElasticBridge:
    r"""Largest bridge of a given Laplace pressure: as the bodies approach, it jumps in there.

    .. math:: z = \frac{\gamma_c}{p_L} + 8 R \left( \frac{p_L}{\pi E^*} \right)^2, \qquad
              a = \frac{4 R\,p_L}{\pi E^*}

    Parameters
    ----------
    pressure : float
        p_L [Pa], positive; of a humidity, that of Kelvin's equation.
    radius, modulus, wetting
        As of `snap_in_of_volume`.

    Notes
    -----
    Its gap on the axis is that without contact: where it is negative the solids touch before, and
    `adhesion.wet_contact` has the states.

    Examples
    --------
    >>> end = snap_in_at_pressure(1e6, 1e-3, 1e9, 0.1)
    >>> round(end.rigid_gap * 1e9, 4), round(end.force * 1e6, 4)
    (100.8106, 5.093)
    """
    share = pressure / (math.pi * modulus)
    gap = wetting / pressure + 8.0 * radius * share * share
    return _bridge(gap, 4.0 * radius * share, pressure, radius, modulus)


def bridge_at_pressure(
    gap: float, pressure: float, radius: float, modulus: float, wetting: float
) -> ElasticBridge | None:
    """Stable bridge of a given Laplace pressure at a rigid gap; None beyond `snap_in_at_pressure`.

    Parameters
    ----------
    gap, pressure : float
        z [m] and p_L [Pa].
    radius, modulus, wetting
        As of `snap_in_of_volume`.

    Examples
    --------
    Between rigid bodies the force is that of a rim of the height gamma_c/p_L, 2 pi R gamma_c at
    touch:

    >>> stiff = bridge_at_pressure(0.0, 1e6, 1e-3, math.inf, 0.1)
    >>> round(stiff.force / (2.0 * math.pi * 1e-3 * 0.1), 12)
    1.0
    """
    half = 4.0 * radius * pressure / (math.pi * modulus)
    root = half * half + 2.0 * radius * (wetting / pressure - gap)
    if root < 0.0:
        return None
    return _bridge(gap, half + math.sqrt(root), pressure, radius, modulus)
