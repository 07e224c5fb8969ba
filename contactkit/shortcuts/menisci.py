"""Capillary force of one meniscus: in equilibrium with humid air, or of a given volume."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, overload

from ..arguments import (
    angles,
    check_shapes,
    non_negative,
    plain,
    positive,
    positive_or_inf,
    quantity,
    single,
)
from ..capillary.exact.at_pressure import bridge_at_pressure
from ..capillary.exact.bridge import bridge
from ..capillary.kelvin import laplace_pressure
from ..errors import DescriptionError
from ..files.structure import load_liquid
from ..liquids.liquid import Liquid

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    Angles = float | str | tuple[float | str, float | str]

__all__ = ["bridge_force", "capillary_force"]


@overload
def capillary_force(
    radius: float | str,
    relative_humidity: float | str,
    *,
    gap: float | str = ...,
    liquid: Liquid | str = ...,
    contact_angles: Angles = ...,
    temperature: float | str = ...,
) -> float: ...


@overload
def capillary_force(
    radius: ArrayLike | str,
    relative_humidity: ArrayLike | str,
    *,
    gap: ArrayLike | str = ...,
    liquid: Liquid | str = ...,
    contact_angles: Any = ...,
    temperature: float | str = ...,
) -> float | NDArray[np.float64]: ...


def capillary_force(
    radius: ArrayLike | str,
    relative_humidity: ArrayLike | str,
    *,
    gap: ArrayLike | str = 0.0,
    liquid: Liquid | str = "water",
    contact_angles: Any = 0.0,
    temperature: float | str = 293.15,
) -> float | NDArray[np.float64]:
    r"""Capillary force between a sphere and a flat in equilibrium with humid air [N].

    .. math:: F = \pi \gamma a (1 + e), \qquad p = \frac{R T}{v} \ln H

    The exact axisymmetric bridge of radius of neck a and shape e whose pressure p follows from
    Kelvin's equation: `capillary.exact.bridge_at_pressure`, the model of
    ``MeniscusForce(profile="exact")`` in a scene with ``Meniscus(relative_humidity=...)``. For a
    sphere that is large against the Kelvin radius it tends to
    :math:`4 \pi R \gamma \cos\theta` in contact.

    Parameters
    ----------
    radius : float or array_like
        Radius R of the sphere [m].
    relative_humidity : float or array_like
        Pressure of the vapour over that of saturation H [-], above 0 and below 1.
    gap : float or array_like
        Distance of sphere and flat [m].
    liquid : Liquid or str
        What condenses: a liquid, or a name of the library.
    contact_angles : float or (float, float)
        Contact angles [rad]: of both, or of flat and sphere.
    temperature : float
        Temperature [K].

    Returns
    -------
    float or ndarray
        Force [N], of the broadcast shape; positive attracts. Numbers may be texts with a unit.

    Raises
    ------
    DescriptionError
        If an argument is out of range, or the liquid lacks a property.
    InfeasibleError
        If no meniscus spans the gap, without vapour and at saturation.

    Notes
    -----
    For smooth, rigid bodies, without adsorbed films, gravity and hysteresis of the contact angle.
    The surface tension is that of a flat surface: the error is about the molecular size over the
    Kelvin radius, 20 % at 1 nm (water at 60 % humidity).

    Examples
    --------
    A sphere of radius 10 um on a flat in air of 70 %:

    >>> import contactkit as ck
    >>> print(f"{ck.capillary_force('10 um', 0.7):.3e} N")
    9.096e-06 N
    """
    where = "capillary_force"
    curvature = 1.0 / positive(f"{where}(radius)", radius, "m")
    gaps = non_negative(f"{where}(gap)", gap, "m")
    humidity = _humidity(f"{where}(relative_humidity)", relative_humidity)
    flat, sphere = angles(f"{where}(contact_angles)", contact_angles)
    kelvin = single(f"{where}(temperature)", temperature, "K")
    check_shapes(where, curvature, gaps, humidity, flat, sphere)
    found = _liquid(f"{where}(liquid)", liquid)
    tension = found.at(kelvin).surface_tension
    pressure = laplace_pressure(found.molar_volume(kelvin), kelvin, humidity)
    state = bridge_at_pressure(gaps, pressure / tension, flat, sphere, 0.0, curvature)
    return plain(tension * state.force)


@overload
def bridge_force(
    radius: float | str,
    volume: float | str,
    *,
    surface_tension: float | str,
    gap: float | str = ...,
    contact_angles: Angles = ...,
    lower_radius: float | str = ...,
) -> float: ...


@overload
def bridge_force(
    radius: ArrayLike | str,
    volume: ArrayLike | str,
    *,
    surface_tension: ArrayLike | str,
    gap: ArrayLike | str = ...,
    contact_angles: Any = ...,
    lower_radius: ArrayLike | str = ...,
) -> float | NDArray[np.float64]: ...


def bridge_force(
    radius: ArrayLike | str,
    volume: ArrayLike | str,
    *,
    surface_tension: ArrayLike | str,
    gap: ArrayLike | str = 0.0,
    contact_angles: Any = 0.0,
    lower_radius: ArrayLike | str = math.inf,
) -> float | NDArray[np.float64]:
    r"""Force of a liquid bridge of given volume between two spheres, or sphere and flat [N].

    .. math:: F = 2\pi r \gamma \sin\varphi - \pi r^2 p = \pi \gamma a (1 + e)

    The exact axisymmetric bridge, `capillary.exact.bridge`, which is the model of
    ``MeniscusForce(profile="exact")``.

    Parameters
    ----------
    radius : float or array_like
        Radius of the upper sphere [m]; inf for a flat.
    volume : float or array_like
        Volume of the liquid [m3].
    surface_tension : float or array_like
        Surface tension [N/m].
    gap : float or array_like
        Distance of the bodies [m].
    contact_angles : float or (float, float)
        Contact angles [rad]: of both bodies, or of the lower and the upper one.
    lower_radius : float or array_like
        Radius of the lower body [m]; inf: a flat.

    Returns
    -------
    float or ndarray
        Force [N], of the broadcast shape; positive attracts. Numbers may be texts with a unit.

    Raises
    ------
    DescriptionError
        If an argument is out of range.
    InfeasibleError
        If the gap is beyond the one at which the bridge breaks, which is named.

    Notes
    -----
    Without gravity (lengths below the capillary length, 2.7 mm for water) and hysteresis of the
    contact angle. Relative error near 1e-14, up to 1e-8 where the bridge breaks.

    Examples
    --------
    A microlitre of water between flats at a distance of half a millimetre:

    >>> import contactkit as ck
    >>> force = ck.bridge_force(float("inf"), "1 mm3", gap="0.5 mm", surface_tension=0.0728,
    ...     contact_angles="30 deg")
    >>> print(f"{force:.3e} N")
    6.533e-04 N
    """
    where = "bridge_force"
    above = 1.0 / positive_or_inf(f"{where}(radius)", radius, "m")
    below = 1.0 / positive_or_inf(f"{where}(lower_radius)", lower_radius, "m")
    tension = positive(f"{where}(surface_tension)", surface_tension, "N/m")
    volumes = positive(f"{where}(volume)", volume, "m3")
    gaps = non_negative(f"{where}(gap)", gap, "m")
    lower, upper = angles(f"{where}(contact_angles)", contact_angles)
    check_shapes(where, above, below, tension, volumes, gaps, lower, upper)
    return plain(tension * bridge(gaps, volumes, lower, upper, below, above).force)


def _humidity(name: str, given: Any) -> Any:
    found = quantity(name, given, "-")
    wrong = ~((found >= 0.0) & (found <= 1.0))
    if wrong.any():
        bad = float(found[wrong].flat[0])
        raise DescriptionError(name, bad, "lie between 0 and 1", hint="a fraction, not per cent")
    return found


def _liquid(name: str, given: Any) -> Liquid:
    if isinstance(given, str):
        return load_liquid(given)
    if not isinstance(given, Liquid):
        raise DescriptionError(name, given, "be a Liquid, or a name of the library such as 'water'")
    return given
