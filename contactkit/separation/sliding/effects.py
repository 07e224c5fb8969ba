"""Effects of a sliding: viscous drag, and pinned contact lines."""

from __future__ import annotations

import abc
import math
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any, ClassVar, Literal, NamedTuple, Protocol

from attrs import Attribute, field, frozen

from ...as_published.printed.errata import ERRATA
from ...errors import DescriptionError
from ...scene.column import Column
from ...scene.scenes import SlidingScene
from ...units import si
from ...validators import angle, choice, optional, positive, refuse
from ..effects.base import SeparationEffect
from ..effects.film_shape import FilmShape
from ..effects.viscous import ShearLimit

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from ...as_published.arguments import PublishedValue
    from ...scene.scenes import SeparationScene
    from ..effects.prepared import PreparedScene

    Curve = NDArray[np.float64]

__all__ = [
    "ContactAngleHysteresis",
    "CouetteForce",
    "CouettePart",
    "HysteresisPart",
    "SlideLaw",
    "SlidePlanView",
    "SlideView",
    "SlidingForce",
    "SlidingPart",
]


class SlidePlanView(Protocol):
    """Plan of a sliding as an effect sees it."""

    @property
    def scene(self) -> SlidingScene:
        """The scene that is planned."""

    @property
    def prepared(self) -> PreparedScene[SlidingScene]:
        """Liquid, geometry and settings, computed once."""

    @property
    def film(self) -> FilmShape:
        """Geometry of the film."""

    @property
    def wetted_radius(self) -> float:
        """Radius of the wetted circles [m]."""


class SlideView(Protocol):
    """Run of a sliding as an effect sees it: its curves and totals."""

    @property
    def totals(self) -> Mapping[str, float]:
        """Impulses [N.s] and work [J] over the whole slide."""

    @property
    def duration(self) -> float:
        """Time that the slide takes [s]."""

    def total(self, column: Column) -> float:
        """Return the total of a column over the whole slide."""

    def __getitem__(self, name: str) -> NDArray[Any]:
        """Return a curve by its name."""


class SlideLaw(NamedTuple):
    """Prepared tangential force law of all menisci together; arrays of travel [m] go in.

    `force` is called with (travel [m], speed [m/s]) and gives [N]. Called with (travel [m]),
    `impulse` gives the time integral [N.s] of a force that is proportional to speed, and `work`
    the work [J] of one that does not depend on it: no path in time changes either. A force with
    neither is integrated along the travel.
    """

    force: Callable[[Any, float], Any]
    impulse: Callable[[Any], Any] | None = None
    work: Callable[[Any], Any] | None = None


@frozen(kw_only=True)
class SlidingForce(SeparationEffect):
    """A force along the bodies of a `SlidingScene`; any number may act.

    `column` names its curve and, by `Column.impulse`, its impulse.
    """

    family: ClassVar[str] = "sliding effect"
    column: ClassVar[Column]

    @classmethod
    def curves(cls) -> tuple[Column, ...]:
        """See `SeparationEffect.curves`."""
        return (cls.column, cls.column.impulse)

    def lacks(self, scene: SeparationScene | SlidingScene) -> tuple[str, ...]:
        """See `Effect.lacks`."""
        if isinstance(scene, SlidingScene):
            return self.lacks_in(scene)
        return ("a SlidingScene: it acts along the bodies, not across the gap",)

    def lacks_in(self, scene: SlidingScene) -> tuple[str, ...]:
        """Name what this effect needs and a sliding scene does not give, with units."""
        return ()

    @abc.abstractmethod
    def prepare(self, prepared: PreparedScene[SlidingScene]) -> SlideLaw:
        """Do the work that depends on neither travel nor speed."""

    def mean_errata(self, plan: SlidePlanView, duration: float) -> tuple[PublishedValue, ...]:
        """Printed equations of a run of a duration [s], each with the right value; see `errata`."""
        return ()

    def part(self, result: SlideView) -> SlidingPart:
        """Part of a result that `SlidingResult.of` returns."""
        return SlidingPart(result, self.column)


@frozen(eq=False)
class SlidingPart:
    """Force of an effect along the travel, and its impulse."""

    result: SlideView = field(repr=False)
    column: Column

    @property
    def force(self) -> Curve:
        """Force along the travel [N]."""
        return self.result[self.column.name]

    @property
    def impulse(self) -> float:
        """Time integral of the force over the whole slide [N.s]."""
        return self.result.total(self.column.impulse)


@frozen(eq=False)
class CouettePart(SlidingPart):
    """Viscous drag: its force, its impulse and its mean."""

    def mean_force(self, time: float | None = None) -> float:
        """Time average [N] of the force over a slide that takes `time` [s]: impulse/time.

        Raises
        ------
        DescriptionError
            If the time is not positive.
        """
        time = self.result.duration if time is None else time
        if not time > 0.0:
            raise DescriptionError("mean_force(time)", time, "be positive", unit="s")
        return self.impulse / time


@frozen(eq=False)
class HysteresisPart(SlidingPart):
    """Force of pinned contact lines along the travel, and its work."""

    @property
    def work(self) -> float:
        """Work of the force over the whole slide [J]."""
        return self.result.totals[self.column.work.name]


@frozen(kw_only=True)
class CouetteForce(SlidingForce):
    """Drag of a Newtonian film over the area in which the wetted circles still overlap.

    Parameters
    ----------
    closure : {"local-film", "lubrication", "as-published"}
        Under a sphere: ``"local-film"``, shear of the film as thick as it is at each place;
        ``"lubrication"``, with the pressure that the sphere makes as well, by the closed form of
        the round film, once the circles have moved apart in proportion to the shear (within 4 %
        up to half of the travel, 14 % at three quarters); ``"as-published"``, Eq. (3.56), a film
        as thick as its rim throughout: 28 % too low at a rim of twice the gap, for reproduction
        only. Between flats all three have one drag, but as published its radius is that of the
        contact circle of the arc, and under a sphere its height s_0 that of the arc, as
        `ViscousForce` as published has them: up to 3.5 % of the drag at a radius of 50 gaps.

    Notes
    -----
    The liquid stays where it wets the bodies; both circles have the radius of the film at the
    start. Left out: the shape of the meniscus, of relative size h/x, and inertia. A `ShearLimit`
    beside it bounds the shear stress.
    """

    name: ClassVar[str] = "couette-force"
    summary: ClassVar[str] = "viscous drag on sliding bodies"
    column: ClassVar[Column] = Column("couette_force", "N", "viscous drag", "#c1440e")
    published_choice: ClassVar[str] = "closure"

    closure: Literal["local-film", "lubrication", "as-published"] = field(
        default="local-film", validator=choice("local-film", "lubrication", "as-published")
    )

    @property
    def sources(self) -> tuple[str, ...]:
        """See `Effect.sources`."""
        flats = "Couette flow over a lens, Eqs. (3.44)-(3.52) of Cai and Bhushan 2008b"
        if self.closure == "as-published":
            return (
                f"Eq. (3.53) of Cai and Bhushan 2008b, as printed; {ERRATA['3.53']}",
                f"Eq. (3.56) of Cai and Bhushan 2008b, as printed; {ERRATA['3.56']}",
            )
        if self.closure == "lubrication":
            return flats, "Reynolds' equation in a round film; Goldman, Cox and Brenner 1967"
        return flats, "Couette flow in the film as thick as it is, Eq. (3.54) of Cai 2008"

    def cites(self, scene: SeparationScene | SlidingScene) -> tuple[str, ...]:
        """See `Effect.cites`."""
        flats, sphere = self.sources
        return (flats,) if scene.interface.is_flat else (sphere,)

    def liquid_needs(self, scene: SeparationScene | SlidingScene) -> tuple[str, ...]:
        """See `Effect.liquid_needs`."""
        return ("viscosity",)

    def lacks_in(self, scene: SlidingScene) -> tuple[str, ...]:
        """See `SlidingForce.lacks_in`."""
        missing: tuple[str, ...] = ()
        is_sphere = not scene.interface.is_flat
        if is_sphere and self.closure == "lubrication" and scene.effect(ShearLimit) is not None:
            missing += ('closure="local-film": with ShearLimit() the film has no closed form',)
        return missing + _needs_rim(scene)

    def prepare(self, prepared: PreparedScene[SlidingScene]) -> SlideLaw:
        """See `SlidingForce.prepare`."""
        scene, film, viscosity = prepared.scene, prepared.film, prepared.liquid.viscosity
        gap, limit = scene.loading.gap, scene.effect(ShearLimit)
        if math.isinf(film.sphere_radius):
            return _even_law(film, gap, gap, viscosity, limit)
        if self.closure == "as-published":
            return _even_law(film, gap, film.height(gap), viscosity, limit)
        return _sphere_law(film, gap, viscosity, limit, self.closure == "lubrication")

    def mean_errata(self, plan: SlidePlanView, duration: float) -> tuple[PublishedValue, ...]:
        """See `SlidingForce.mean_errata`: the mean force of one meniscus."""
        if not self.takes_printed():
            return ()
        from ...as_published.lookup import published

        film, gap = plan.film, plan.scene.loading.gap
        viscosity = plan.prepared.liquid.viscosity
        given = {"gap": gap, "separation_time": duration, "viscosity": viscosity}
        if plan.scene.interface.is_flat:
            one = published("3.53", radius=plan.wetted_radius, **given)
        else:
            shape = {"sphere_radius": film.sphere_radius, "film_height": film.height(gap)}
            one = published("3.56", **shape, **given)
        return (one._replace(name=f"{self.name}, {one.name}, of one meniscus"),)

    def part(self, result: SlideView) -> CouettePart:
        """See `SlidingForce.part`."""
        return CouettePart(result, self.column)


def _needs_rim(scene: SlidingScene) -> tuple[str, ...]:
    """Ask for a volume or a rim where the film would have no end."""
    interface = scene.interface
    if scene.meniscus.volume is None and math.isinf(interface.rim_radius):
        return ("interface.meniscus.volume [m3], or the radius [m] of a Flat face",)
    return ()


def _even_law(
    film: FilmShape, gap: float, height: float, viscosity: float, limit: ShearLimit | None
) -> SlideLaw:
    """Drag of films of one thickness: a stress over the overlap."""
    from ...lubrication import couette_flat as sliding

    n, x = film.menisci, film.radius(gap)

    def force(travel: Any, speed: float) -> Any:
        stress = viscosity * speed / height
        if limit is not None:
            stress = sliding.limited_stress(stress, limit.strength, limit.law)
        return n * stress * sliding.lens_area(x, travel)

    def impulse(travel: Any) -> Any:
        return n * sliding.flat_impulse(x, height, travel, viscosity)

    return SlideLaw(force, impulse if limit is None else None)


def _sphere_law(
    film: FilmShape, gap: float, viscosity: float, limit: ShearLimit | None, has_pressure: bool
) -> SlideLaw:
    """Drag of films that are as thick as the sphere leaves room."""
    from ...lubrication.couette_flat import limited_stress
    from ...lubrication.couette_reynolds import lubrication_factor
    from ...lubrication.couette_sphere import sphere_drag, sphere_impulse

    n, height = film.menisci, film.height(gap)
    shape = (film.sphere_radius, gap, height)
    scale = float(n)
    if has_pressure:
        scale *= float(lubrication_factor(gap, height)) / math.log1p((height - gap) / gap)

    def force(travel: Any, speed: float) -> Any:
        flow = viscosity * speed
        if limit is None:
            return scale * sphere_drag(*shape, travel, lambda h: flow / h)
        kink = flow / limit.strength if limit.law == "truncated" else 0.0
        return scale * sphere_drag(
            *shape,
            travel,
            lambda h: limited_stress(flow / h, limit.strength, limit.law),
            kink,
        )

    def impulse(travel: Any) -> Any:
        return scale * sphere_impulse(*shape, viscosity, travel)

    return SlideLaw(force, impulse if limit is None else None)


def _not_above(
    owner: ContactAngleHysteresis, attribute: Attribute[float | None], value: float | None
) -> None:
    """Refuse a receding angle that is alone, or above the advancing one."""
    optional(angle)(owner, attribute, value)
    other = getattr(owner, attribute.name.replace("receding", "advancing"))
    if (value is None) != (other is None):
        raise refuse(owner, attribute, value, "be given with the advancing angle of that body")
    if value is not None and other is not None and value > other:
        raise refuse(owner, attribute, value, f"not exceed the advancing angle, {other:g} rad")


@frozen(kw_only=True)
class ContactAngleHysteresis(SlidingForce):
    """Capillary force that drags a meniscus along a body on which its contact line sticks.

    Parameters
    ----------
    advancing_lower, receding_lower : float, optional
        Contact angles on the lower body [rad] in front of the meniscus and behind it. Not given:
        the meniscus is pinned there.
    advancing_upper, receding_upper : float, optional
        The same on the upper body.
    shape_factor : float
        Force over tension, width and difference of the cosines [-], how the angle changes around
        the line: 1 at once, pi/4 as its cosine is linear along the motion, 2/pi as it is linear
        along the line, 24/pi^3 for a cubic.

    Notes
    -----
    The line moves on the body that holds it less, and the force is what that one takes. Its width
    is that of the overlap. It does not depend on the speed; valid for eta v/gamma << 1. The source
    leaves contact angles out of its tangential separation.
    """

    name: ClassVar[str] = "contact-angle-hysteresis"
    column: ClassVar[Column] = Column(
        "hysteresis_force", "N", "force of contact lines that stick", "#2a9d8f"
    )
    summary: ClassVar[str] = "capillary force of a meniscus that is dragged along"

    advancing_lower: float | None = field(
        default=None, validator=optional(angle), metadata=si("rad")
    )
    receding_lower: float | None = field(default=None, validator=_not_above, metadata=si("rad"))
    advancing_upper: float | None = field(
        default=None, validator=optional(angle), metadata=si("rad")
    )
    receding_upper: float | None = field(default=None, validator=_not_above, metadata=si("rad"))
    shape_factor: float = field(default=2.0 / math.pi, validator=positive, metadata=si("-"))

    def __attrs_post_init__(self) -> None:
        if not self._pairs:
            raise DescriptionError(
                "ContactAngleHysteresis",
                "no angles",
                "be given the advancing and receding angle [rad] of a body at least",
            )

    @property
    def _pairs(self) -> tuple[tuple[float, float], ...]:
        """Advancing and receding angle of each body on which the line may move."""
        both = (
            (self.advancing_lower, self.receding_lower),
            (self.advancing_upper, self.receding_upper),
        )
        return tuple((a, r) for a, r in both if a is not None and r is not None)

    @property
    def sources(self) -> tuple[str, ...]:
        """See `Effect.sources`."""
        return ("Furmidge 1962; shape factor: Extrand and Gent 1990, ElSherbini and Jacobi 2006",)

    def lacks_in(self, scene: SlidingScene) -> tuple[str, ...]:
        """See `SlidingForce.lacks_in`."""
        return _needs_rim(scene)

    def liquid_needs(self, scene: SeparationScene | SlidingScene) -> tuple[str, ...]:
        """See `Effect.liquid_needs`."""
        return ("surface_tension",)

    def prepare(self, prepared: PreparedScene[SlidingScene]) -> SlideLaw:
        """See `SlidingForce.prepare`."""
        from ...lubrication import couette_flat as sliding

        film, tension = prepared.film, prepared.liquid.surface_tension
        n, x = film.menisci, film.radius(prepared.scene.loading.gap)
        per_width = n * min(
            float(sliding.hysteresis_force(tension, 1.0, *pair, self.shape_factor))
            for pair in self._pairs
        )

        def force(travel: Any, speed: float) -> Any:
            return per_width * sliding.lens_width(x, travel)

        def work(travel: Any) -> Any:
            # What the overlap loses in area is its width times the travel.
            return per_width * (sliding.lens_area(x, 0.0) - sliding.lens_area(x, travel))

        return SlideLaw(force, work=work)

    def part(self, result: SlideView) -> HysteresisPart:
        """See `SlidingForce.part`."""
        return HysteresisPart(result, self.column)
