"""Meniscus force against relative humidity: sphere, asperities, or a solved rough contact."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, ClassVar, Literal, NamedTuple, TypeVar

import numpy as np
from attrs import evolve, field, frozen

from ..accuracy import Accuracy
from ..arguments import listed, non_negative
from ..capillary import kelvin
from ..contact.effects.base import Attraction, SolvedContact
from ..contact.effects.island_bridges import IslandBridges
from ..contact.result import ContactResult
from ..errors import DescriptionError, InfeasibleError, NotSimulatedError, PlanError
from ..liquids.liquid import LiquidState
from ..scene.curve import Curve, Shown
from ..scene.meniscus import Meniscus
from ..scene.scenes import SeparationScene
from ..separation.effects.asperities import AsperityMenisci
from ..separation.effects.prepared import prepare_scene
from ..units import si

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

__all__ = ["HumidityCurve", "humidity_curve"]

Law = Literal["islands", "cross-cut"]
_T = TypeVar("_T")


class _Point(NamedTuple):
    """Menisci at one humidity: force [N], number, total volume [m3], total area [m2]."""

    force: float
    n_menisci: float
    volume: float | None
    circles: float | None
    largest: float | None = None


@frozen(eq=False)
class HumidityCurve(Curve):
    """Meniscus force against humidity; arrays (n,), read-only.

    Attributes
    ----------
    law : str
        Force law; do not compare different laws unawares.
    relative_humidity : ndarray
        As given [-].
    kelvin_radius, meniscus_height : ndarray
        Kelvin radius, and the height of a thin meniscus, ``r_K (cos + cos)`` [m].
    pressure : ndarray
        Laplace pressure [Pa].
    force : ndarray
        Force of all menisci [N]; 0 where the gap is too large.
    n_menisci : ndarray
        Number of menisci [-].
    """

    axis: ClassVar[str] = "relative_humidity"
    shown: ClassVar[Shown] = {"force": (("force",), "")}

    law: str
    relative_humidity: Floats = field(repr=False, metadata=si("-"))
    kelvin_radius: Floats = field(repr=False, metadata=si("m"))
    meniscus_height: Floats = field(repr=False, metadata=si("m"))
    pressure: Floats = field(repr=False, metadata=si("Pa"))
    force: Floats = field(repr=False, metadata=si("N"))
    n_menisci: Floats = field(repr=False, metadata=si("-"))
    _volume: Floats | None = field(repr=False)
    _circles: Floats | None = field(repr=False)
    _largest: Floats | None = field(repr=False)
    _area: float | None = field(repr=False)

    @property
    def title(self) -> str:
        """See `Curve.title`."""
        return f"humidity curve, law {self.law}"

    @property
    def sources(self) -> tuple[str, ...]:
        """See `Curve.sources`."""
        return ("Kelvin's equation; Thomson 1871", self.law)

    def table(self) -> dict[str, tuple[Any, str]]:
        """Return the arrays over the humidity, those that the law knows."""
        volume = {} if self._volume is None else {"volume": (self._volume, "m3")}
        return super().table() | volume

    @property
    def volume(self) -> Floats:
        """Liquid in all menisci [m3]."""
        return _known(self._volume, "volume", self.law)

    @property
    def coverage(self) -> Floats:
        """Area coverage: contact circles over nominal area [-]; above 0.9 neighbours overlap."""
        area = _known(self._area, "coverage", self.law)
        return np.asarray(_known(self._circles, "coverage", self.law) / area)

    @property
    def largest_fraction(self) -> Floats:
        """Area fraction of the largest island [-]: from about 0.25 on the menisci have merged."""
        return _known(self._largest, "islands", self.law)


def _known(value: _T | None, what: str, law: str) -> _T:
    if value is None:
        raise NotSimulatedError(f"the law {law!r} has no {what}")
    return value


def humidity_curve(
    wetted: SeparationScene | ContactResult,
    relative_humidity: Sequence[float | str] | Floats,
    *,
    gap: float | str | None = None,
    law: Law = "islands",
    accuracy: Accuracy | None = None,
) -> HumidityCurve:
    r"""Force of capillary condensation between two bodies against the relative humidity.

    Parameters
    ----------
    wetted : SeparationScene or ContactResult
        A scene with a sphere, whose bridge is exact; one with `AsperityMenisci` among its effects,
        whose law it follows; or a solved contact with a meniscus in its interface. The liquid
        needs surface tension, density and molar mass; volume and pressure of the scene's own
        meniscus are ignored.
    relative_humidity : sequence of float
        Above 0 and below 1 [-].
    gap : float, optional
        Gap of a scene [m]. None: its initial gap.
    law : {"islands", "cross-cut"}
        For a solved contact: an exact bridge on each island (`IslandBridges`, as listed in its
        scene), or Laplace pressure times area, Eq. (2.43). Every gap smaller than the meniscus
        height is wetted.
    accuracy : Accuracy, optional
        Accuracy of the force curves of `AsperityMenisci`.

    Raises
    ------
    InfeasibleError
        At a humidity of 0, or of 1 and above; between smooth flats.
    PlanError
        If the data of the liquid or the scene are incomplete.

    Notes
    -----
    The capillary force does not deform the bodies. Adsorbed films, which matter above about 90 %,
    and solutes are neglected.

    Examples
    --------
    >>> import contactkit as ck
    >>> scene = ck.SeparationScene(
    ...     interface=ck.Interface(
    ...         upper=ck.Sphere(radius=1e-6), meniscus=ck.Meniscus(liquid=ck.load_liquid("water"))),
    ...     loading=ck.ImposedSpeed(initial_gap=0.3e-9, final_gap=1e-7, speed=1e-6),
    ...     effects=(ck.MeniscusForce(),))
    >>> found = humidity_curve(scene, [0.3, 0.6, 0.9])
    >>> [round(1e9 * f) for f in found.force]
    [598, 771, 861]
    """
    humidity = listed("humidity_curve(relative_humidity)", relative_humidity, "-")
    meniscus, temperature = _meniscus(wetted)
    liquid = meniscus.liquid.at(temperature)
    if liquid.missing("surface_tension"):
        raise PlanError("a humidity curve needs interface.meniscus.liquid.surface_tension [N/m]")
    tension = liquid.surface_tension
    molar = meniscus.liquid.molar_volume(temperature)
    pressure = np.asarray(kelvin.laplace_pressure(molar, temperature, humidity))
    if isinstance(wetted, ContactResult):
        name, points, area = _contact(wetted, pressure, law, liquid)
    else:
        name, points, area = _scene(wetted, pressure, gap, accuracy, tension)
    wetting = math.cos(meniscus.contact_angle_lower) + math.cos(meniscus.contact_angle_upper)
    columns = (
        humidity,
        -tension / pressure,
        np.asarray(kelvin.meniscus_height(pressure, tension, wetting)),
        pressure,
        np.array([p.force for p in points]),
        np.array([p.n_menisci for p in points], dtype=np.float64),
        _column([p.volume for p in points]),
        _column([p.circles for p in points]),
        _column([p.largest for p in points]),
    )
    for column in columns:
        if column is not None:
            column.flags.writeable = False
    return HumidityCurve(name, *columns, area)


def _column(values: list[float | None]) -> Floats | None:
    known = [value for value in values if value is not None]
    return np.array(known) if len(known) == len(values) else None


def _meniscus(wetted: SeparationScene | ContactResult) -> tuple[Meniscus, float]:
    if isinstance(wetted, SeparationScene):
        return wetted.meniscus, wetted.temperature
    if not isinstance(wetted, ContactResult):
        raise PlanError(f"a humidity curve is of a SeparationScene or a ContactResult: {wetted!r}")
    scene = wetted.plan.scene
    return scene.meniscus, scene.temperature


def _scene(
    scene: SeparationScene,
    pressure: Floats,
    gap: float | str | None,
    accuracy: Accuracy | None,
    tension: float,
) -> tuple[str, list[_Point], float | None]:
    gap = scene.loading.initial_gap if gap is None else gap
    gap = float(non_negative("humidity_curve(gap)", gap, "m"))
    rough = scene.effect(AsperityMenisci)
    if rough is not None:
        area = rough.area(scene)
        points = [_asperities(rough, _at(scene, p), gap, accuracy) for p in pressure.tolist()]
        return f"{rough.law}, {rough.profile} bridges", points, area
    if scene.interface.is_flat:
        raise InfeasibleError(
            "between smooth flats no meniscus of a fixed pressure is stable: it evaporates, or "
            "fills the gap to the rim; give a sphere, or AsperityMenisci(...) among the effects"
        )
    return "exact bridge on a sphere", _sphere(scene, pressure, gap, tension), None


def _at(scene: SeparationScene, pressure: float) -> SeparationScene:
    meniscus = evolve(scene.meniscus, volume=None, pressure=pressure, relative_humidity=None)
    return evolve(scene, interface=evolve(scene.interface, meniscus=meniscus))


def _asperities(
    rough: AsperityMenisci, scene: SeparationScene, gap: float, accuracy: Accuracy | None
) -> _Point:
    rough = evolve(rough, meniscus_height=None)
    prepared = prepare_scene(scene, accuracy)
    if missing := rough.lacks(scene):
        raise PlanError(f"AsperityMenisci needs {'; '.join(missing)}")
    sums, law = rough.sums(prepared, gap), rough.prepare(prepared)
    force = law.force(gap, 0.0) if gap <= law.end else 0.0
    return _Point(force, sums.n_wet, None, sums.coverage * rough.area(scene))


def _sphere(scene: SeparationScene, pressure: Floats, gap: float, tension: float) -> list[_Point]:
    from ..capillary.exact.bridge import bridge_at_pressure

    interface, meniscus = scene.interface, scene.meniscus
    angles = (meniscus.contact_angle_lower, meniscus.contact_angle_upper)
    curvatures = interface.curvatures
    try:
        state = bridge_at_pressure(gap, pressure / tension, *angles, *curvatures, beyond="nan")
    except InfeasibleError as error:
        largest = -tension / float(pressure.max())
        raise InfeasibleError(
            f"at the highest humidity the Kelvin radius is {largest:.3g} m, and no ring of liquid "
            f"is stable around a sphere of {interface.sphere_radius:.3g} m: it would grow without "
            "bound; lower the humidity, or give the meniscus a volume"
        ) from error
    n, points = meniscus.count, []
    for i, force in enumerate(state.force.tolist()):
        if not math.isfinite(force):
            points.append(_Point(0.0, 0, 0.0, 0.0))
            continue
        circle = math.pi * max(float(state.radius_lower[i]), float(state.radius_upper[i])) ** 2
        points.append(_Point(n * tension * force, n, n * float(state.volume[i]), n * circle))
    return points


def _contact(
    result: ContactResult, pressure: Floats, law: Law, liquid: LiquidState
) -> tuple[str, list[_Point], float | None]:
    plan = result.plan
    if plan.scene.effect(Attraction) is not None:
        raise PlanError(
            "the menisci of a humidity curve take pressures to be positive: solve the contact "
            "without Adhesion"
        )
    contact = SolvedContact(
        plan.scene,
        plan.grid,
        result.pressure,
        result.displacement,
        result.gap,
        liquid_state=liquid,
    )
    effect = plan.scene.effect(IslandBridges) or IslandBridges()
    effect = evolve(effect, film_thickness=None, meniscus_height=None)
    if law == "cross-cut":
        found = [_cross_cut(effect, contact, p) for p in pressure.tolist()]
        return "cross-cut of the gap, Eq. (2.43)", found, None
    if law != "islands":
        raise DescriptionError("humidity_curve(law)", law, "be 'islands' or 'cross-cut'")
    parts = [effect.at_pressure(contact, p) for p in pressure.tolist()]
    area = plan.grid.area
    points = [
        _Point(p.force, p.n_menisci, float(p.volume.sum()), p.coverage * area, p.largest_fraction)
        for p in parts
    ]
    name = f"exact bridge on each island, {effect.curvature} curvature"
    return name, points, area


def _cross_cut(effect: IslandBridges, contact: SolvedContact, pressure: float) -> _Point:
    """Laplace pressure on every gap smaller than the meniscus height, Eq. (2.43)."""
    from ..capillary.film_islands import film_force, meniscus_area

    meniscus, tension = contact.scene.meniscus, contact.liquid.surface_tension
    angles = (meniscus.contact_angle_lower, meniscus.contact_angle_upper)
    wetting = sum(map(math.cos, angles))
    if wetting <= 0.0:
        return _Point(0.0, 0, None, None)
    height = float(kelvin.meniscus_height(pressure, tension, wetting))
    touching, grid = contact.pressure > 0.0, contact.grid
    found = meniscus_area(contact.gap, height, height, touching, grid.periodic, effect.connectivity)
    area = found.n_meniscus * grid.pixel_area
    return _Point(float(film_force(area, tension, *angles, height)), found.n_islands, None, None)
