"""Numbers of validity of a viscous film: compression, soft faces, weight.

The pressures are those of Reynolds' equation, below ambient while the gap opens and above while
it closes. Where the liquid cavitates, no more than its strength is taken, and only the opening:
what a cavitated film does as it closes depends on its cavity.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING, NamedTuple

from ...lubrication import dimensionless as numbers
from ...validity import ValidityNumber

if TYPE_CHECKING:
    from ...scene.interface import Interface
    from ...scene.materials import Material, Stack
    from ...scene.scenes import SeparationScene
    from .film_shape import FilmShape
    from .prepared import PreparedScene

__all__ = ["apparent_viscosity", "film_numbers"]

_MOST = 0.05  # relative change of volume or of gap, and weight over pressure
_RIGID = "no body has a solid (a Material or a Stack): the faces are rigid"


class _Load(NamedTuple):
    """Load of a film on its faces at one instant.

    `pressure` is its largest difference from ambient [Pa], no more than the strength of the liquid
    while the gap opens; `deflection` that of the centre of a face times E* [Pa.m]; `radius` that of
    the circle which bears the load [m].
    """

    gap: float
    speed: float
    height: float
    radius: float
    pressure: float
    deflection: float
    is_cavitated: bool


def film_numbers(
    prepared: PreparedScene[SeparationScene],
    film: FilmShape,
    path: Sequence[tuple[float, float]],
    strength: float,
) -> tuple[ValidityNumber, ...]:
    """Evaluate the numbers along pairs of gap [m] and speed [m/s].

    Parameters
    ----------
    prepared : PreparedScene
        The scene.
    film : FilmShape
        Film as its viscous force takes it.
    path : sequence of (float, float)
        Gaps and speeds while the film spans the gap.
    strength : float
        Tension at which the liquid cavitates [Pa], below ambient pressure; inf if it never does.
    """
    loads = list(_loads(prepared, film, path, strength))
    return (
        _compression(prepared, loads),
        *_soft_faces(prepared, loads),
        _weight(prepared, loads),
    )


def _loads(
    prepared: PreparedScene[SeparationScene],
    film: FilmShape,
    path: Sequence[tuple[float, float]],
    strength: float,
) -> Iterator[_Load]:
    is_flat, face = math.isinf(film.sphere_radius), prepared.face_film
    viscosity = apparent_viscosity(prepared)
    for gap, speed in path:
        if speed < 0.0 and math.isfinite(strength):
            continue
        rate = viscosity(gap, speed) * abs(speed)
        radius, height = film.radius(gap), film.height(gap)
        if face is not None:
            pressure, spread = rate * face.onset(gap), radius
            deflection = 4.0 / 3.0 * pressure * radius
        elif is_flat:
            pressure, spread = _between_flats(rate, gap, radius), radius
            deflection = 4.0 / 3.0 * pressure * radius
        else:
            spread = min(radius, math.sqrt(2.0 * film.sphere_radius * gap))
            pressure = _under_sphere(rate, gap, film.sphere_radius, height)
            deflection = _deflection_under_sphere(rate, gap, film.sphere_radius, radius, height)
        if not math.isfinite(pressure):
            continue
        is_cavitated = speed > 0.0 and pressure > strength
        if is_cavitated:  # a cavity may reach close to the rim
            pressure, deflection = strength, min(deflection, 2.0 * strength * spread)
        yield _Load(gap, abs(speed), height, spread, pressure, deflection, is_cavitated)


def apparent_viscosity(
    prepared: PreparedScene[SeparationScene],
) -> Callable[[float, float], float]:
    """Viscosity [Pa.s] of a Newtonian film of the same force, over gap [m] and speed [m/s]."""
    viscosity, rheology = prepared.liquid.viscosity, prepared.rheology
    film = rheology.film if rheology is not None else None
    if film is None:
        return lambda gap, speed: viscosity
    return lambda gap, speed: viscosity * film.force_ratio(gap, speed)


def _between_flats(rate: float, gap: float, radius: float) -> float:
    """Pressure at the centre of a disc [Pa], of a rate eta |h'| [N/m]."""
    return 3.0 * rate * radius * radius / gap**3


def _under_sphere(rate: float, gap: float, sphere: float, height: float) -> float:
    """Pressure under the apex [Pa] of a film that is `height` thick at its rim."""
    return 3.0 * rate * sphere * (1.0 / gap**2 - 1.0 / height**2)


def _deflection_under_sphere(
    rate: float, gap: float, sphere: float, radius: float, height: float
) -> float:
    """Deflection under the apex times E* [Pa.m]: twice the integral of the pressure over r."""
    width = math.sqrt(2.0 * sphere * gap)
    if math.isinf(radius):
        return 1.5 * math.pi * rate * sphere * width / gap**2
    ratio = radius / width
    inner = 0.5 * radius / (1.0 + ratio * ratio) + 0.5 * width * math.atan(ratio)
    return 6.0 * rate * sphere * (inner / gap**2 - radius / height**2)


def _compression(
    prepared: PreparedScene[SeparationScene], loads: Sequence[_Load]
) -> ValidityNumber:
    modulus = prepared.liquid.given("bulk_modulus")
    largest = max((load.pressure for load in loads), default=None)
    law = prepared.scene.meniscus.liquid.pressure_density
    if law is not None and largest is not None:
        return ValidityNumber(
            name="change of the density over pressure",
            value=abs(law.relative_change(-largest)),
            high=_MOST,
            detail="the film is taken for incompressible; its density would change by this "
            "fraction",
            source="Dowson and Higginson 1966",
        )
    known = modulus is not None and largest is not None
    return ValidityNumber(
        name="pressure over bulk modulus",
        value=numbers.compression(largest, modulus) if known else None,
        high=_MOST,
        detail="liquid.bulk_modulus [Pa] is not given"
        if modulus is None
        else "the film is taken for incompressible; its volume would change by this fraction",
        source="relative change of volume, p/K",
    )


def _soft_faces(
    prepared: PreparedScene[SeparationScene], loads: Sequence[_Load]
) -> tuple[ValidityNumber, ValidityNumber]:
    interface, viscosity = prepared.scene.interface, prepared.liquid.viscosity
    bending: float | None = None
    soft: float | None = None
    if interface.stacks and loads:
        moduli = [_modulus(interface, load.radius) for load in loads]
        pairs = list(zip(loads, moduli, strict=True))
        bending = max(numbers.face_bending(one.deflection, e, one.gap) for one, e in pairs)
        soft = max(
            (
                numbers.soft_face_number(viscosity, one.radius, e, one.gap, one.gap / one.speed)
                for one, e in pairs
                if one.speed > 0.0 and not one.is_cavitated
            ),
            default=0.0,
        )
    return (
        ValidityNumber(
            name="bending of the faces over the gap",
            value=bending,
            high=_MOST,
            detail="the force takes the faces for rigid; they would give by this fraction of the "
            "gap at their centre"
            if interface.stacks
            else _RIGID,
            source="half-space under the pressure of the film, 4 eta h' r^3/(E* h^4), at most "
            "2 p r/(E* h) where the liquid cavitates at p",
        ),
        ValidityNumber(
            name="soft-face number",
            value=soft,
            high=1.0,
            detail="above 1 the faces follow the film instead of the bodies; where the liquid "
            "does not cavitate"
            if interface.stacks
            else _RIGID,
            source="A = 3.1 eta r^3/(E* h^3 dt) in the time dt = h/h'",
        ),
    )


def _modulus(interface: Interface, depth: float) -> float:
    """Reduced modulus E* [Pa] of the materials at a depth [m] as wide as the load."""
    materials = (_material_at(stack, depth) for stack in interface.stacks)
    return 1.0 / sum(1.0 / material.plane_strain_modulus for material in materials)


def _material_at(stack: Stack, depth: float) -> Material:
    below = sum(interface < depth for interface in stack.depths)
    return stack.materials[min(below, len(stack.materials) - 1)]  # a rigid base bends even less


def _weight(prepared: PreparedScene[SeparationScene], loads: Sequence[_Load]) -> ValidityNumber:
    density, tension = prepared.liquid.given("density"), prepared.liquid.given("surface_tension")
    wetting = abs(prepared.wetting) * (tension or 0.0)
    pressure = max((load.pressure + wetting / load.height for load in loads), default=0.0)
    value: float | None = None
    if density is not None and pressure > 0.0:
        highest = max(load.height for load in loads)
        value = numbers.GRAVITY * density * highest / pressure
    return ValidityNumber(
        name="weight of the film over its pressure",
        value=value,
        high=_MOST,
        detail="liquid.density [kg/m3] is not given"
        if density is None
        else "the weight of the liquid is left out",
        source="rho g h over the largest viscous and Laplace pressure",
    )
