r"""Adhesion of a spring tip: the liquid that condenses under it, and the law of its separation.

While a tip rests on its site for a tenth of a millisecond, vapour condenses until the pressure of
the liquid is that of Kelvin, :math:`p = (R T/v) \ln H`. The tip then leaves within some ten
nanoseconds, in which nothing condenses or dries: the *volume* stays. So the meniscus is that of
the pressure while landed, and of its volume as it separates; a separation at the pressure itself,
`pressure_law`, is there to be compared. Below the humidity at which the liquid spans the gap that
roughness keeps open the tip is dry.

Left out: films adsorbed on the surfaces, and that Kelvin's law is used below 1 nm.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from functools import lru_cache
from typing import TYPE_CHECKING, Any, NamedTuple

from attrs import evolve

from ...accuracy import Accuracy
from ...capillary.kelvin import kelvin_radius, laplace_pressure, radius_number
from ...errors import InfeasibleError
from ...scene.scenes import SeparationScene
from ...separation.effects.meniscus import MeniscusForce
from ...separation.effects.viscous import ViscousForce
from ...separation.plan import Plan
from ...validity import ValidityNumber
from .tip import free_gap, tip_plan

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from ...capillary.exact.bridge import ExactBridge

__all__ = [
    "Adhesion",
    "adhesion",
    "condensate_validity",
    "condensed_volume",
    "pressure_law",
    "separation_energy",
    "tip_law",
    "tip_scene",
]


class Adhesion(NamedTuple):
    """Adhesion of one tip at a humidity; forces [N] while landed, positive where they hold."""

    humidity: float
    kelvin_radius: float
    """[m]; 0 where it is dry."""
    volume: float
    """Of the liquid under the tip [m3]; 0 where it is dry."""
    meniscus_force: float
    solid_force: float
    break_gap: float
    """Gap at which the meniscus breaks [m]; nan where it is dry."""
    energy: float
    """Work to separate the tip slowly from its site [J]."""

    @property
    def force(self) -> float:
        """Sum of the forces [N]."""
        return self.meniscus_force + self.solid_force


def condensate_validity(found: Iterable[Adhesion]) -> tuple[ValidityNumber, ...]:
    """Range of Kelvin's equation at the humidities at which liquid condenses; none if all is dry.

    Examples
    --------
    >>> dry = Adhesion(0.1, 0.0, 0.0, 0.0, 1e-8, math.nan, 1e-17)
    >>> wet = Adhesion(0.4, 0.58e-9, 1e-24, 1e-8, 1e-8, 2e-9, 2e-17)
    >>> [one.is_valid for one in condensate_validity([dry, wet])], condensate_validity([dry])
    ([False], ())
    """
    radii = [one.kelvin_radius for one in found if one.volume > 0.0]
    if not radii:
        return ()
    return (radius_number(min(radii)),)


def _kelvin(scene: SeparationScene, humidity: float) -> tuple[float, float]:
    """Pressure over surface tension [1/m], and surface tension [N/m]."""
    liquid = scene.meniscus.liquid
    state = liquid.at(scene.temperature)
    if state.missing("surface_tension"):
        raise InfeasibleError(
            f"{liquid.name} has no surface tension [N/m], and holds no meniscus; give "
            "Liquid.surface_tension, or another liquid"
        )
    tension = state.surface_tension
    volume = liquid.molar_volume(scene.temperature)
    return laplace_pressure(volume, scene.temperature, humidity) / tension, tension


def condensed_volume(scene: SeparationScene, humidity: float, gap: float | None = None) -> float:
    """Volume [m3] of liquid in equilibrium with its vapour under one tip; 0 if none spans the gap.

    Parameters
    ----------
    scene : SeparationScene
        Of one tip; only bodies, liquid and temperature count.
    humidity : float
        Relative humidity [-], from 0 up to but not including 1.
    gap : float, optional
        Gap [m]; the initial one if not given.
    """
    gap = scene.loading.initial_gap if gap is None else gap
    if humidity == 0.0:
        return 0.0
    pressure, _ = _kelvin(scene, humidity)
    return _volume_at(scene, gap, pressure)


def _volume_at(scene: SeparationScene, gap: float, pressure: float) -> float:
    """Volume [m3] of the bridge of a pressure over the tension [1/m]; 0 if there is none."""
    try:
        volume = float(_at_pressure(scene, gap, pressure).volume)
    except InfeasibleError:  # nor is there one between bodies that touch
        return 0.0
    return volume if volume > 0.0 else 0.0  # nan where no bridge spans the gap


def _at_pressure(scene: SeparationScene, gap: Any, pressure: float) -> ExactBridge:
    from ...capillary.exact.bridge import bridge_at_pressure

    meniscus = scene.meniscus
    return bridge_at_pressure(
        gap,
        pressure,
        meniscus.contact_angle_lower,
        meniscus.contact_angle_upper,
        *scene.interface.curvatures,
        beyond="nan",
    )


@lru_cache(maxsize=64)
def tip_scene(scene: SeparationScene, humidity: float) -> SeparationScene:
    """Scene of one tip with the liquid that condensed at a humidity; dry without its effects."""
    volume = condensed_volume(scene, humidity)
    if volume > 0.0:
        meniscus = evolve(scene.meniscus, volume=volume, relative_humidity=None)
        return evolve(scene, interface=evolve(scene.interface, meniscus=meniscus))
    dry = tuple(e for e in scene.effects if not isinstance(e, MeniscusForce | ViscousForce))
    if not dry:
        raise InfeasibleError(
            f"at a relative humidity of {humidity:g} no liquid spans the gap of "
            f"{scene.loading.initial_gap:g} m, and nothing else holds a tip; list "
            "van-der-waals-force, or give more humidity"
        )
    return evolve(scene, effects=dry)


@lru_cache(maxsize=64)
def tip_law(scene: SeparationScene, humidity: float, rtol: float = 1e-7) -> Plan:
    """Plan of one tip at a humidity: its `film` is the law the motion is stepped with."""
    return tip_plan(tip_scene(scene, humidity), Accuracy(time_rtol=rtol))


@lru_cache(maxsize=64)
def adhesion(scene: SeparationScene, humidity: float) -> Adhesion:
    """Adhesion of one tip at a humidity, while landed and until it is free."""
    made = tip_law(scene, humidity)
    gap, volume = scene.loading.initial_gap, made.scene.meniscus.volume
    law = made.film.laws.get(MeniscusForce)
    meniscus = law.force(gap, 0.0) if law is not None else 0.0
    radius = 0.0
    if law is not None:
        liquid = scene.meniscus.liquid
        _, tension = _kelvin(scene, humidity)
        molar = liquid.molar_volume(scene.temperature)
        radius = float(kelvin_radius(tension, molar, scene.temperature, humidity))
    return Adhesion(
        humidity=humidity,
        kelvin_radius=radius,
        volume=volume or 0.0,
        meniscus_force=meniscus,
        solid_force=made.film.static_force(gap) - meniscus,
        break_gap=law.end if law is not None else math.nan,
        energy=separation_energy(made),
    )


def separation_energy(made: Plan) -> float:
    """Work [J] of the forces that do not depend on speed, from landed until a tip is free."""
    from scipy.integrate import quad

    start, end = made.scene.loading.initial_gap, free_gap(made)
    broken = min(made.film.end, end)
    left = made.remaining_film(1.0, broken=True, detached=False) if broken < end else None

    def work(force: Callable[[float], float], low: float, high: float) -> float:
        # In the logarithm of the gap, over which the forces change evenly.
        def scaled(x: float) -> float:
            return force(math.exp(x)) * math.exp(x)

        value: float = quad(scaled, math.log(low), math.log(high), epsrel=1e-9, limit=200)[0]
        return value

    total = work(made.film.static_force, start, broken)
    return total + (work(left.static_force, broken, end) if left is not None else 0.0)


def pressure_law(
    scene: SeparationScene, humidity: float, gaps: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Capillary force [N] on one tip that separates at the pressure of the vapour, at gaps [m].

    0 where no bridge of that pressure spans the gap.
    """
    import numpy as np

    pressure, tension = _kelvin(scene, humidity)
    forces = tension * _at_pressure(scene, gaps, pressure).force
    return np.where(np.isfinite(forces), forces, 0.0)
