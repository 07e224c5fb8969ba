"""Whether each model stayed inside its range: numbers printed with every result."""

from __future__ import annotations

import math
import warnings
from collections.abc import Iterable, Mapping
from typing import Any

from attrs import field, frozen

from ..capillary.many_menisci import MAX_COVERAGE
from ..errors import ValidityWarning
from ..lubrication import dimensionless as numbers
from ..scene.loading import ImposedTime
from ..units import nm
from .effects.film_shape import FilmShape, film_shape
from .effects.registry import AdhesiveContact, AsperityMenisci, MeniscusForce, ViscousForce
from .motion.state import FilmStatus
from .plan import Plan

__all__ = ["ValidityNumber", "check", "path_of", "warn"]

_NO_DENSITY = "liquid.density [kg/m3] is not given"


@frozen(kw_only=True)
class ValidityNumber:
    """The worst value of a number over a run, and the range it should be in.

    `value` is None where the scene does not say what the number needs; `detail` then names it.
    """

    name: str
    value: float | None
    low: float = -math.inf
    high: float = math.inf
    detail: str
    source: str = field(default="", repr=False)

    @property
    def is_valid(self) -> bool | None:
        """Whether the value is in its range; None if it is not known."""
        return None if self.value is None else self.low <= self.value <= self.high

    def __str__(self) -> str:
        bounds = f"at most {self.high:g}" if math.isfinite(self.high) else f"at least {self.low:g}"
        if self.value is None:
            return f"{self.name}: not evaluated, {self.detail}"
        verdict = "ok" if self.is_valid else "OUT OF RANGE"
        return f"{self.name} = {self.value:.3g} ({bounds}): {verdict}; {self.detail}"


def path_of(plan: Plan, columns: Mapping[str, Any]) -> list[tuple[float, float]]:
    """Pairs (gap [m], speed [m/s]) of a run for `check`: where the film spans an open gap.

    With only a time imposed the speed is the mean one.
    """
    gaps = columns["gap"]
    if "film_status" in columns:
        whole = columns["film_status"] != FilmStatus.BROKEN
    else:
        whole = gaps <= plan.film.end
    if "speed" in columns:
        speeds = columns["speed"]
    else:
        loading = plan.scene.loading
        time = loading.time if isinstance(loading, ImposedTime) else math.inf
        speeds = (gaps[-1] - gaps[0]) / time + 0.0 * gaps
    wet = whole & (gaps > 0.0)
    return list(zip(gaps[wet].tolist(), speeds[wet].tolist(), strict=True))


def check(plan: Plan, path: Iterable[tuple[float, float]]) -> tuple[ValidityNumber, ...]:
    """Evaluate the numbers of the effects of a plan along (gap [m], speed [m/s]) pairs."""
    pairs = list(path)
    gaps = [gap for gap, _ in pairs]
    film = film_shape(plan.scene)
    found = [
        ValidityNumber(
            name="thinnest gap over 2 nm",
            value=min(gaps) / (2.0 * nm),
            low=1.0,
            detail="below about 2 nm a liquid is not a continuum",
            source="Chan and Horn 1985",
        )
    ]
    if plan.has(ViscousForce):
        found += _viscous(plan, film, pairs)
    if plan.has(AsperityMenisci):
        found.append(_cover(plan, gaps))
    if plan.has(MeniscusForce):
        found += _capillary(plan, film, gaps)
        if plan.has(ViscousForce):
            found += _both(plan, film, pairs)
    if plan.has(AdhesiveContact):
        found += _adhesion(plan)
    return tuple(found)


def _adhesion(plan: Plan) -> list[ValidityNumber]:
    """Whether the adhesion is as sharp, or as far, as the model takes it for."""
    effect = plan.scene.effect(AdhesiveContact)
    if effect is None or effect.model == "maugis-dugdale":  # right for all
        return []
    tabor = effect.numbers(plan.scene).tabor_parameter
    is_sharp = effect.model == "jkr"
    cure = "take model='maugis-dugdale', right for all"
    return [
        ValidityNumber(
            name="Tabor parameter",
            value=tabor,
            low=5.0 if is_sharp else 0.0,
            high=math.inf if is_sharp else 0.1,
            detail=cure if tabor is not None else "AdhesiveContact.strength [Pa] is not given",
            source="Johnson and Greenwood 1997",
        )
    ]


def _cover(plan: Plan, gaps: list[float]) -> ValidityNumber:
    effect = plan.scene.effect(AsperityMenisci)
    assert effect is not None  # check() has asked
    return ValidityNumber(
        name="contact circles over the face",
        value=max(effect.coverage(plan.scene, gap) for gap in gaps),
        high=MAX_COVERAGE,
        detail="above it the menisci of neighbouring asperities overlap",
        source="densest order of equal circles, pi/sqrt(12)",
    )


def _viscous(plan: Plan, film: FilmShape, pairs: list[tuple[float, float]]) -> list[ValidityNumber]:
    state = plan.scene.meniscus.liquid.at(plan.scene.temperature)
    density, viscosity = state.density, state.viscosity
    reynolds = None
    if density is not None and viscosity is not None:
        reynolds = (
            max(numbers.reynolds_number(density, v, film.height(h), viscosity) for h, v in pairs)
            if math.isfinite(film.height(pairs[0][0]))
            else None
        )
    return [
        ValidityNumber(
            name="Reynolds number",
            value=reynolds,
            high=1.0,
            detail=_NO_DENSITY if density is None else "inertia of the film is left out",
            source="rho h' h/eta",
        ),
        ValidityNumber(
            name="slenderness of the film",
            value=min(numbers.slenderness(film.radius(h), film.height(h)) for h, _ in pairs)
            if math.isfinite(film.height(pairs[0][0]))
            else None,
            low=5.0,
            detail="lubrication wants a film much wider than high",
            source="Reynolds 1886",
        ),
    ]


def _capillary(plan: Plan, film: FilmShape, gaps: list[float]) -> list[ValidityNumber]:
    state = plan.scene.meniscus.liquid.at(plan.scene.temperature)
    density, tension = state.density, state.surface_tension
    assert tension is not None  # plan() has asked lacks() first
    bond = None
    if density is not None:
        bond = max(
            numbers.bond_number(
                density, film.height(h), max(film.height(h), film.radius(h)), tension
            )
            for h in gaps
        )
    found = [
        ValidityNumber(
            name="Bond number",
            value=bond,
            high=0.1,
            detail="liquid.density [kg/m3] is not given"
            if density is None
            else "gravity is left out",
            source="rho g h max(h, r)/gamma",
        )
    ]
    if plan.scene.interface.is_flat and math.isfinite(film.volume):
        found.append(
            ValidityNumber(
                name="gap over cube root of volume",
                value=max(gaps) / film.volume ** (1.0 / 3.0),
                high=numbers.LONGEST_FLAT_BRIDGE,
                detail="no longer bridge between flats is stable, whatever the contact angles",
                source="stability of the cylinder at 90/90 degrees, pi^(1/3)",
            )
        )
    if not plan.scene.interface.is_flat:
        found.append(_lateral(plan, gaps, tension))
    return found


def _lateral(plan: Plan, gaps: list[float], tension: float) -> ValidityNumber:
    """Whether a bridge on a sphere stays in its middle: it does as long as it attracts."""
    law, radius = plan.film.laws[MeniscusForce], plan.scene.interface.sphere_radius
    least = min(law.force(gap, 0.0) for gap in gaps)
    return ValidityNumber(
        name="least meniscus force over 2 pi R gamma",
        value=least / (2.0 * math.pi * radius * tension),
        low=0.0,
        detail="a bridge that repels a sphere is expelled sideways: it is laterally unstable",
        source="an axisymmetric bridge is neutral sideways where its force is zero",
    )


def _both(plan: Plan, film: FilmShape, pairs: list[tuple[float, float]]) -> list[ValidityNumber]:
    meniscus = plan.scene.meniscus
    state = meniscus.liquid.at(plan.scene.temperature)
    tension, viscosity = state.surface_tension, state.viscosity
    assert tension is not None
    assert viscosity is not None  # plan() has asked lacks() first for both
    wetting = abs(math.cos(meniscus.contact_angle_lower) + math.cos(meniscus.contact_angle_upper))
    opening = [(h, v) for h, v in pairs if v > 0.0 and math.isfinite(film.radius(h))]
    ratio = fingering = 0.0
    for h, v in opening:
        r, height = film.radius(h), film.height(h)
        if wetting > 1e-12:
            ratio = max(
                ratio, numbers.viscous_to_capillary(viscosity, r, v, height, tension * wetting)
            )
        fingering = max(fingering, numbers.fingering_number(viscosity, v, r, height, tension))
    return [
        ValidityNumber(
            name="viscous over capillary pressure",
            value=ratio,
            high=1.0,
            detail="above 1 the meniscus is not in equilibrium while the gap opens",
            source="3 eta r^2 h'/(gamma (c1 + c2) h^2)",
        ),
        ValidityNumber(
            name="fingering number",
            value=fingering,
            high=1.0,
            detail="above 1 the receding rim of the film breaks up into fingers",
            source="lifted Hele-Shaw cell, eta h' r^3/(gamma h^3)",
        ),
    ]


def warn(found: Iterable[ValidityNumber], stacklevel: int = 3) -> None:
    """Issue a `ValidityWarning` for each number that is out of its range."""
    for number in found:
        if number.is_valid is False:
            warnings.warn(str(number), ValidityWarning, stacklevel=stacklevel)
