"""Plan of a separation of deforming bodies: its film on rings or on a map, and its numbers."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, ClassVar

from attrs import field, frozen

from ...accuracy import Accuracy
from ...capillary import elastic_bridge
from ...elasticity import rings
from ...elasticity.layer_stack import Layers
from ...errors import InfeasibleError, PlanError
from ...kinds import SEPARATION_EFFECTS
from ...lubrication.elastohydrodynamic.motion import SmoothGap
from ...registry import Registry
from ...scene.column import Column
from ...scene.effect import check_listed
from ...scene.loading import ImposedForce, ImposedSpeed, PressAndPull
from ...scene.plan import ScenePlan
from ...scene.scenes import SeparationScene
from ...units import quantity_text
from ..effects.base import SeparationEffect
from ..effects.viscous import TensionLimit
from .checks import check_deforming, is_on_rings
from .effects import SolidContact
from .numbers import DecidingNumbers, deciding_numbers, hertz_approach, rest_number

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from ...liquids.liquid import LiquidState
    from .maps.film import MapFilm

__all__ = ["COLUMNS", "DeformingPlan", "characteristic_speed", "plan_deforming"]

COLUMNS: Mapping[str, Column] = MappingProxyType(
    {
        column.name: column
        for column in (
            Column("time", "s", "time"),
            Column("gap", "m", "gap of the undeformed bodies", "#7f7f7f", "--"),
            Column("speed", "m/s", "opening speed", "#7f7f7f"),
            Column("centre_gap", "m", "gap on the axis", "#1f4e79"),
            Column("mean_gap", "m", "mean gap", "#1f4e79", ":"),
            Column("smallest_gap", "m", "smallest gap", "#00798c"),
            Column("pull", "N", "pull", "#6a4c93"),
            Column("film_force", "N", "force of the film", "#c1440e"),
            Column("contact_force", "N", "force of the contact", "#2a9d8f"),
            Column("meniscus_force", "N", "force of the meniscus at this rim", "#1f4e79", ":"),
            Column("largest_tension", "Pa", "largest tension in the film", "#c1440e"),
            Column("rim_radius", "m", "radius of the rim", "#1f4e79"),
            Column("contact_area", "m2", "area of contact", "#2a9d8f"),
            Column("wet_area", "m2", "area of the film", "#1f4e79"),
            Column("void_volume", "m3", "void in the film", "#00798c"),
            Column("liquid_volume", "m3", "liquid in the film", "#1f4e79"),
            Column("elastic_energy", "J", "energy in the bodies", "#e9c46a"),
            Column("work", "J", "work of the pull", "#6a4c93"),
            Column("dissipated_energy", "J", "energy dissipated by the film", "#c1440e"),
        )
    }
)
"""Curves of a separation of deforming bodies, by their names."""

# Widths of the pressure at the final gap up to which the film of a sphere without a rim is solved:
# its force lacks 2/60^2, 6e-4 of that at the final gap.
_WIDTHS = 60.0
_SMALL_STRAIN = 0.1  # pressure over E* of linear elasticity; what a meniscus has from the start
# Radius of Hertz' contact over the rim: beyond, the displacement at the rim is 0.22 of the approach
# and the film there is no longer that of a flooded edge at ambient pressure.
_INSIDE = 0.5
# Thickness of a layer over the width of the pressure below which its matrix takes more than 10 s.
_THINNEST = 0.02
# Elements are in proportion to the fourth root of the error; 48 of a smooth film have 3e-4 of
# `Accuracy.film_rtol` = 1e-3.
_ELEMENTS, _ERROR = 48, 1e-3
# Steps on a map are of second order in the change of a gap.
_CHANGE, _MOST_CHANGE = 0.1, 0.3
_FEWEST, _MOST = 24, 192  # that still show the pressure; that still take a minute
# Numbers above which an effect that is off would change the force by about 1 % (physics of each:
# first correction of a rigid sphere; tension in half of the strength; film that no rest drains).
_CAVITATES_FROM, _FLOATS_BELOW = 0.5, 10.0
_ATMOSPHERE = 101_325.0  # [Pa], tension at which a liquid without a strength of its own cavitates
_CONTINUUM = 2e-9  # [m], gap that no smooth film reaches without asperities that carry


@frozen(eq=False)
class DeformingPlan(ScenePlan):
    """A checked scene of deforming bodies with its film: on rings if smooth and round, else a map.

    ``print(plan)`` states the engine, the numbers that decide, and effects that are off and should
    be on.

    Attributes
    ----------
    film : SmoothGap or MapFilm
        The film at the start.
    modulus : float
        Contact modulus E* of the topmost materials [Pa].
    numbers : DecidingNumbers
        At the start.
    laplace_pressure : float
        Suction of the meniscus at the start [Pa]; 0 of a flooded film.
    volume : float
        Liquid of the meniscus at the start [m3]; 0 of a flooded film.
    """

    known_effects: ClassVar[Registry[Any]] = SEPARATION_EFFECTS
    columns: ClassVar[Mapping[str, Column]] = COLUMNS

    scene: SeparationScene
    accuracy: Accuracy
    film: SmoothGap | MapFilm = field(repr=False)
    modulus: float
    numbers: DecidingNumbers
    laplace_pressure: float
    volume: float

    @property
    def elements(self) -> int:
        """Rings of the finest mesh; 0: those of `lubrication.elastohydrodynamic.motion`."""
        if self.accuracy.film_rtol == _ERROR:
            return 0
        wanted = _ELEMENTS * math.pow(_ERROR / self.accuracy.film_rtol, 0.25)
        return 4 * round(min(max(wanted, _FEWEST), _MOST) / 4.0)

    @property
    def change(self) -> float:
        """Part of itself by which a gap on a map changes in a step."""
        return min(_CHANGE * math.sqrt(self.accuracy.film_rtol / _ERROR), _MOST_CHANGE)

    @property
    def methods(self) -> tuple[str, ...]:
        """See `ScenePlan.methods`."""
        if isinstance(self.film, SmoothGap):
            return ("Radau IIA with error control; Hairer and Wanner 1996, section IV.8",)
        return ("SDIRK of order 2 with error control; Hairer and Wanner 1996, section IV.6",)

    @property
    def title(self) -> str:
        """See `ScenePlan.title`."""
        return f"{self.scene.name or 'separation'}: {self.scene.loading.summary}"

    @property
    def engine(self) -> str:
        """Name of the solver."""
        if isinstance(self.film, SmoothGap):
            return "axisymmetric film on deforming bodies"
        return "film on a map of deforming bodies"

    @property
    def rigid_force(self) -> float:
        """Force of rigid bodies at the start of the pull, from the initial gap [N]."""
        return characteristic_speed(self.scene, self.film) * self.rigid_damping

    @property
    def rigid_damping(self) -> float:
        """Damping of rigid bodies at the initial gap, without their roughness [N.s/m]."""
        return _rigid_damping(self.film)

    @property
    def rest_number(self) -> float | None:
        """Rest over the time of drainage to the cut-off [-]; None without the three of them."""
        loading, film = self.scene.loading, self.film
        if not isinstance(loading, PressAndPull) or math.isinf(film.radius) or not film.cutoff:
            return None
        args = loading.press, loading.rest, film.radius, self.modulus, film.viscosity
        return rest_number(*args, film.cutoff)

    @property
    def notes(self) -> tuple[str, ...]:
        """See `ScenePlan.notes`."""
        return tuple(_notes(self))

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickle the scene, of which the same plan is made again."""
        return plan_deforming, (self.scene, self.accuracy)


def plan_deforming(
    scene: SeparationScene,
    accuracy: Accuracy | None = None,
    heights: tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]] | None = None,
) -> DeformingPlan:
    """Check a scene with `ElasticBodies` and prepare its film.

    Parameters
    ----------
    scene : SeparationScene
        The scene.
    accuracy : Accuracy, optional
        Settings.
    heights : tuple of ndarray, optional
        Cells x and y [m] and the gap of the undeformed bodies on them [m], of a result that was
        saved: its surfaces are not read again.

    Raises
    ------
    PlanError
        If the film of deforming bodies would leave something of the scene out.
    InfeasibleError
        If the meniscus has drawn the bodies together before they start.
    """
    check_listed(scene.effects, SeparationEffect, "separation", SEPARATION_EFFECTS)
    meniscus = scene.interface.meniscus
    if meniscus is None:
        raise PlanError("a SeparationScene needs interface.meniscus: the liquid and its amount")
    liquid = meniscus.liquid.at(scene.temperature)
    check_deforming(scene, liquid)
    modulus = _modulus(scene)
    bridge, wetting = _bridge(scene, liquid, modulus)
    accuracy = accuracy or Accuracy.standard
    film: SmoothGap | MapFilm
    if is_on_rings(scene):
        if accuracy.grid is not None:
            raise PlanError(
                f"Accuracy.grid = {accuracy.grid!r} is not read: the film of smooth round bodies "
                "is solved on rings; leave it out"
            )
        film = _film(scene, liquid, bridge, wetting)
    else:
        film = _on_map(scene, liquid, accuracy, heights)
    suction = 0.0 if bridge is None else bridge.laplace_pressure
    _check_layers(scene, film)
    _check_load(scene, film, modulus)
    _check_rest(scene, film, modulus, 0.0 if bridge is None else bridge.force)
    if bridge is not None and isinstance(film, SmoothGap):
        _check_fold(scene, film, modulus, bridge)
    found = deciding_numbers(
        film.radius,
        film.width,
        film.gap,
        film.viscosity,
        characteristic_speed(scene, film),
        modulus,
    )
    if bridge is not None and suction > 0.0 and film.wetting is not None:
        height = film.wetting / suction
        found = found._replace(meniscus=film.wetting * film.rim / (modulus * height**2))
    volume = 0.0 if bridge is None else bridge.volume
    return DeformingPlan(scene, accuracy, film, modulus, found, suction, volume)


def characteristic_speed(scene: SeparationScene, film: SmoothGap | MapFilm) -> float:
    """Speed of the pull [m/s]: imposed, or that of rigid bodies at the start under the force."""
    loading = scene.loading
    if isinstance(loading, ImposedSpeed):
        return loading.speed
    if isinstance(loading, PressAndPull) and loading.speed is not None:
        return loading.speed
    force = loading.force if isinstance(loading, ImposedForce | PressAndPull) else None
    return float(force or 0.0) / _rigid_damping(film)


def _rigid_damping(film: SmoothGap | MapFilm) -> float:
    """Damping of rigid bodies at the start [N.s/m]; without roughness."""
    # Of a flat 3 pi eta R^4/(2 h^3), of a sphere 6 pi eta R^2/h = 6 pi eta w^4/h^3.
    part = 1.5 if math.isinf(film.radius) else 6.0
    return part * math.pi * film.viscosity * film.width**4 / film.gap**3


def _modulus(scene: SeparationScene) -> float:
    tops = [stack.materials[0].plane_strain_modulus for stack in scene.interface.stacks]
    return 1.0 / sum(1.0 / top for top in tops)


def _solids(scene: SeparationScene) -> list[Layers]:
    return [
        Layers(stack.young_moduli, stack.poisson_ratios, stack.thicknesses, stack.base)
        for stack in scene.interface.stacks
    ]


def _compliance(scene: SeparationScene) -> Callable[[NDArray[np.float64]], NDArray[np.float64]]:
    solids = _solids(scene)
    return lambda nodes: rings.matrix(nodes, *solids)


def _on_map(
    scene: SeparationScene,
    liquid: LiquidState,
    accuracy: Accuracy,
    heights: tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]] | None,
) -> MapFilm:
    """The film at the start on a map, which rings do not import."""
    from .maps.cells import cells_of, restored_cells
    from .maps.film import MapFilm, check_initial_gap

    curvature = sum(body.surface.body_curvature for body in scene.interface.bodies)
    limit, contact = scene.effect(TensionLimit), scene.effect(SolidContact)
    film = MapFilm(
        cells_of(scene, accuracy) if heights is None else restored_cells(scene, *heights),
        1.0 / curvature if curvature > 0.0 else math.inf,
        scene.loading.initial_gap,
        liquid.viscosity,
        tuple(_solids(scene)),
        cavity=math.inf if limit is None else limit.cavity_drop,
        strength=0.0 if limit is None else limit.tension,
        cutoff=0.0 if contact is None else contact.cutoff,
    )
    check_initial_gap(film)
    return film


def _film(
    scene: SeparationScene,
    liquid: LiquidState,
    bridge: elastic_bridge.ElasticBridge | None,
    wetting: float,
) -> SmoothGap:
    """The film at the start."""
    radius, gap = scene.interface.sphere_radius, scene.loading.initial_gap
    limit, contact = scene.effect(TensionLimit), scene.effect(SolidContact)
    if bridge is not None:
        rim = bridge.rim_radius
    elif math.isfinite(scene.interface.rim_radius):
        rim = scene.interface.rim_radius
    else:
        rim = min(_WIDTHS * math.sqrt(radius * scene.loading.final_gap), radius)
    return SmoothGap(
        radius=radius,
        rim=rim,
        gap=gap,
        viscosity=liquid.viscosity,
        compliance=_compliance(scene),
        cavity=math.inf if limit is None else limit.cavity_drop,
        strength=0.0 if limit is None else limit.tension,
        cutoff=0.0 if contact is None else contact.cutoff,
        wetting=None if bridge is None else wetting,
    )


def _bridge(
    scene: SeparationScene, liquid: LiquidState, modulus: float
) -> tuple[elastic_bridge.ElasticBridge | None, float]:
    """Meniscus at rest at the start, and the surface tension times its cosines."""
    meniscus, gap = scene.meniscus, scene.loading.initial_gap
    pressure = meniscus.pressure_of(liquid)
    if pressure is None and meniscus.volume is None:
        return None, 0.0
    angles = meniscus.contact_angle_lower, meniscus.contact_angle_upper
    wetting = liquid.surface_tension * sum(map(math.cos, angles))
    pair = scene.interface.sphere_radius, modulus, wetting
    if meniscus.volume is not None:
        found = elastic_bridge.bridge_of_volume(gap, meniscus.volume, *pair)
        end = elastic_bridge.snap_in_of_volume(meniscus.volume, *pair).bridge
        if found is None:
            raise InfeasibleError(
                f"at loading.initial_gap = {gap:g} m the meniscus has drawn the bodies together: "
                f"they snap in at {quantity_text(end.rigid_gap, 'm')}, with a force of "
                f"{quantity_text(end.force, 'N')}; start from a larger gap, or give less liquid or "
                "stiffer bodies"
            )
    else:
        suction = -float(pressure or 0.0)
        found = elastic_bridge.bridge_at_pressure(gap, suction, *pair)
        end = elastic_bridge.snap_in_at_pressure(suction, *pair)
        if found is None:
            raise InfeasibleError(
                f"no meniscus spans loading.initial_gap = {gap:g} m: at this pressure of the "
                f"liquid one reaches {quantity_text(end.rigid_gap, 'm')}; start from a smaller gap"
            )
    if found.laplace_pressure > _SMALL_STRAIN * modulus:
        raise InfeasibleError(
            f"the suction of the meniscus, {quantity_text(found.laplace_pressure, 'Pa')}, is "
            f"{found.laplace_pressure / modulus:.3g} of E* = {quantity_text(modulus, 'Pa')}, and "
            f"linear elasticity holds up to {_SMALL_STRAIN:g}; give stiffer bodies, or a larger "
            "relative_humidity or volume"
        )
    if found.centre_gap <= 0.0:
        raise InfeasibleError(
            f"the meniscus draws the bodies into contact at loading.initial_gap = {gap:g} m: "
            f"the axis would overlap by {quantity_text(-found.centre_gap, 'm')}; start from a "
            "larger gap"
        )
    if found.rim_radius > scene.interface.rim_radius:
        raise PlanError(
            f"the meniscus of a radius of {found.rim_radius:g} m reaches beyond the face of "
            f"{scene.interface.rim_radius:g} m; give less liquid or a larger face"
        )
    return found, wetting


def _check_layers(scene: SeparationScene, film: SmoothGap | MapFilm) -> None:
    if not isinstance(film, SmoothGap):  # their displacement is exact for any thickness on a map
        return
    for name in ("lower", "upper"):
        stack = getattr(scene.interface, name).stack
        thin = min(stack.thicknesses, default=math.inf) if stack is not None else math.inf
        if thin < _THINNEST * film.width:
            raise PlanError(
                f"interface.{name}.solid has a layer of {thin:g} m, less than "
                f"{_THINNEST:g} of the width of the pressure, {film.width:g} m: rings do not "
                "resolve it; leave it out, or give a thicker one"
            )


def _check_load(scene: SeparationScene, film: SmoothGap | MapFilm, modulus: float) -> None:
    """Refuse a load whose contact reaches the rim of a flooded film."""
    loading = scene.loading
    if not isinstance(loading, PressAndPull) or math.isinf(film.radius) or film.wetting is not None:
        return
    contact = math.sqrt(film.radius * hertz_approach(loading.press, film.radius, modulus))
    if contact > _INSIDE * film.rim:
        raise PlanError(
            f"loading.press = {quantity_text(loading.press, 'N')} presses the bodies together over "
            f"a radius of {quantity_text(contact, 'm')}, more than {_INSIDE:g} of the film's, "
            f"{quantity_text(film.rim, 'm')}; press less, or give larger faces or stiffer bodies"
        )


def _check_rest(
    scene: SeparationScene, film: SmoothGap | MapFilm, modulus: float, attraction: float
) -> None:
    """Refuse a rest after which bodies would touch, without asperities that carry them.

    They are pressed by the load and by the attraction of the meniscus at the start [N].
    """
    loading = scene.loading
    if not isinstance(loading, PressAndPull) or film.cutoff:
        return
    load = loading.press + attraction
    thinnest = _CONTINUUM + (0.0 if isinstance(film, SmoothGap) else max(film.peak, 0.0))
    if math.isinf(film.radius):
        until = 0.75 * math.pi * film.viscosity * film.rim**4 / (load * thinnest**2)
        drained = loading.rest > until
    else:
        args = load, loading.rest, film.radius, modulus, film.viscosity
        drained = rest_number(*args, thinnest) > 1.0
    if drained:
        where = "2 nm" if thinnest == _CONTINUUM else "2 nm at the highest peaks"
        raise PlanError(
            f"loading.rest = {loading.rest:g} s drains the film to less than {where}, and nothing "
            "carries the bodies there: list SolidContact(cutoff=...), the gap at which their "
            "asperities touch [m]"
        )


def _check_fold(
    scene: SeparationScene,
    film: SmoothGap,
    modulus: float,
    bridge: elastic_bridge.ElasticBridge,
) -> None:
    """Refuse a pull weaker than the meniscus: the bodies snap in instead of parting.

    Its force grows as they come closer, so that no smaller gap holds them either.
    """
    loading, wetting = scene.loading, film.wetting or 0.0
    if not isinstance(loading, ImposedForce) or loading.stiffness:
        return
    if loading.force > bridge.force:
        return
    end = elastic_bridge.snap_in_of_volume(bridge.volume, film.radius, modulus, wetting)
    how = "snap in" if end.event == "fold" else "touch"
    raise InfeasibleError(
        f"loading.force = {quantity_text(loading.force, 'N')} never parts the bodies: the meniscus "
        f"pulls by {quantity_text(bridge.force, 'N')} at loading.initial_gap = {film.gap:g} m, and "
        f"they {how} at {quantity_text(end.bridge.rigid_gap, 'm')}, where it pulls by "
        f"{quantity_text(end.bridge.force, 'N')}; pull harder, or take PressAndPull"
    )


def _notes(plan: DeformingPlan) -> Iterator[str]:
    film, numbers, scene = plan.film, plan.numbers, plan.scene
    yield f"engine: {plan.engine}; E* = {quantity_text(plan.modulus, 'Pa')}"
    if not isinstance(film, SmoothGap):
        yield from film.notes(scene.loading.final_gap, plan.change)
    regime = next(
        text
        for least, text in (
            (1.0, "the gap follows the bodies, not the pull"),
            (0.1, "film and bodies move together"),
            (1e-3, "the bodies lower the force by some per cent"),
            (0.0, "the bodies are as good as rigid"),
        )
        if numbers.beta >= least
    )
    yield f"displacement by the film over the gap, beta = {numbers.beta:.3g}: {regime}"
    if math.isfinite(numbers.gap_over_crossover):
        yield f"gap over the elastohydrodynamic cut-off, D/D_c = {numbers.gap_over_crossover:.3g}"
    if numbers.meniscus:
        yield (
            f"displacement by the meniscus over its height, gc a/(E* h^2) = {numbers.meniscus:.3g} "
            "(it snaps in at about 0.4)"
        )
    if scene.effect(TensionLimit) is not None:
        share = 3.0 * film.strength / numbers.tension
        yield f"strength of the liquid over eta v w^2/h^3 = {share:.3g} (rigid: cavitates below 3)"
    yield from _on_rest(plan)
    yield from _should_be_on(plan)


def _on_rest(plan: DeformingPlan) -> Iterator[str]:
    rested = plan.rest_number
    if rested is None:
        return
    state = "the contact is drained" if rested > _FLOATS_BELOW else "the bodies still float in part"
    yield f"rest over the time of drainage to the cut-off = {rested:.3g}: {state}"


def _should_be_on(plan: DeformingPlan) -> Iterator[str]:
    """Effects that are off, and whose numbers ask for them."""
    film, scene, numbers = plan.film, plan.scene, plan.numbers
    softened = numbers.tension / (1.0 + numbers.beta)
    cavitates = softened > _CAVITATES_FROM * _ATMOSPHERE and film.wetting is None
    if cavitates and scene.effect(TensionLimit) is None:
        yield (
            f"tension-limit is off, and the film would bear some {quantity_text(softened, 'Pa')} "
            "of tension: list TensionLimit()"
        )
    loading = scene.loading
    if scene.effect(SolidContact) is not None or math.isinf(film.radius):
        return
    if isinstance(loading, PressAndPull):
        sunk = hertz_approach(loading.press, film.radius, plan.modulus)
        yield (
            f"solid-contact is off: the load presses the bodies together by "
            f"{quantity_text(sunk, 'm')} with liquid between them all the while"
        )
