"""Stress below the surface of the lower body, on planes, with its maxima."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from functools import partial
from itertools import pairwise
from operator import attrgetter
from typing import TYPE_CHECKING, Any, ClassVar, Literal, NamedTuple

import numpy as np
from attrs import Attribute, field, frozen

from ...elasticity.depths import default_depths
from ...elasticity.stress.maxima import DepthSearch, Maximum, plane_maxima
from ...elasticity.stress.planes import Plane, StressField
from ...elasticity.stress.reading import READINGS, Reading
from ...elasticity.stress.tractions import Tractions
from ...units import si
from ...validators import choice, fraction, non_negative, positive, refuse
from .base import Array, Attraction, DisplacementTerm, Observer, Scalar, SolvedContact
from .elasticity import layers_of
from .friction import FrictionTraction

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ...scene.materials import Stack
    from ...scene.scenes import ContactScene

    Map = NDArray[np.float64]
    Place = tuple[float, str]

__all__ = ["FrictionStress", "StressPart", "SubsurfaceStress", "stress_field"]

_MOST = 64  # planes of one search
_FIRST = 6  # planes of a search to begin with, down to two radii of the sharpest spot
_HIGH = 0.5  # of the maximum pressure: where it is larger, a spot


def _tuple(value: Any) -> tuple[float, ...] | None:
    return tuple(value) if value is not None else None


def _floats(value: Any) -> tuple[float, ...]:
    return tuple(value)


def _depths(owner: object, attribute: Attribute[Any], value: Any) -> None:
    if value is None:
        return
    for depth in value:
        non_negative(owner, attribute, depth)
    if not value or any(b <= a for a, b in pairwise(value)):
        raise refuse(owner, attribute, value, "be depths that grow")


def _at_least_one(owner: object, attribute: Attribute[Any], value: Any) -> None:
    positive(owner, attribute, value)
    if value < 1.0:
        raise refuse(owner, attribute, value, "be at least 1: repetitions cannot overlap")


def _coefficients(owner: object, attribute: Attribute[Any], value: Any) -> None:
    for coefficient in value:
        fraction(owner, attribute, coefficient)
    if len(set(value)) < len(value):
        raise refuse(owner, attribute, value, "be different from each other")


class FrictionStress(NamedTuple):
    """Maxima of the stress for a coefficient of friction, by the names of the measures."""

    coefficient: float
    maxima: Mapping[str, Maximum]


class StressPart(NamedTuple):
    """Stress in the lower body: its maxima, a section, and all planes if they were kept.

    `depth` [m], `side` ("+" below a depth, "-" above) and `layer` (0: the topmost) name the
    planes, n of them; at an interface there are two. `maxima` holds value, place and error of the
    largest "von_mises", "sqrt_j2", "tension" (largest principal stress), "tresca" (largest shear
    stress) and "sigma_xz". `section` (6, n, nx) is the stress [Pa] under the row of pixels `row`
    with the largest pressure; `largest_von_mises` (n) [Pa] that of each plane. `planes` (6, n,
    ny, nx) is there with ``keep="planes"`` only; `by_friction` has the maxima for each of the
    further coefficients of friction.
    """

    depth: Map
    side: tuple[str, ...]
    layer: NDArray[np.int_]
    maxima: Mapping[str, Maximum]
    row: int
    section: Map
    largest_von_mises: Map
    planes: Map | None
    by_friction: tuple[FrictionStress, ...] = ()


_COMPONENTS = ("xx", "yy", "zz", "xy", "xz", "yz")
_MEASURES = ("von_mises", "tension", "tresca", "sigma_xz", "sqrt_j2")
_OF_A_MAXIMUM = (
    ("", "value", "Pa"),
    ("_depth", "z", "m"),
    ("_layer", "layer", "-"),
    ("_error", "error", "-"),
)


def _read(measure: str, field: str, part: StressPart) -> float | None:
    number: float = getattr(part.maxima[measure], field)
    return None if math.isnan(number) else number


@frozen(kw_only=True)
class SubsurfaceStress(Observer[StressPart]):
    """Stress in the lower body, on planes at depth and on both faces of each interface.

    In-plane stresses jump at interfaces, so a maximum may sit on either face. Where friction
    acts its traction is included: that of `FrictionTraction`, or that of `PartialSlip` at the end
    of its path. Maxima are those of the pixels of the planes; each comes with
    an estimate of how much larger the stress may be between the planes.

    Parameters
    ----------
    depths : tuple of float, optional
        Depths of the planes [m], growing. None: they follow the size of the contact spots, and
        planes are added until every maximum stands to `tolerance`.
    keep : {"section", "planes"}
        Whether to keep one section and the maxima, or all planes: six arrays for each depth.
    window : float
        Isolated contacts, and across windows that repeat along one axis: distance of the
        repetitions that the transforms leave over the size of the window [-]; stiff layers need a
        hundred contact radii for four digits.
    tolerance : float
        Of the maxima over depth, where `depths` are not given [-].
    reading : {"spline", "uniform", "trigonometric"}
        Pressure between the pixels. ``spline``: the cubic spline through them, for maxima. Half a
        pixel deep, off a contact, most of the stress is right from three pixels on, but that of
        single pixels is 0.2 to 4 times that of uniform ones up to three pixels away, 0.5 to 2.3
        times up to six, and within 15 % beyond. ``uniform``: on each pixel, as in Love's patch, for
        maps; maxima are off by several per cent where spots are a few pixels wide.
        ``trigonometric``: as in the contact problem of a periodic window; off the contact, ripples
        along rows and columns exceed the stress there many times.
    coefficients : tuple of float
        Further coefficients of friction for which to give the maxima [-], from the same
        transforms: the stress is linear in the coefficient.
    """

    takes_holes: ClassVar[bool] = True
    name: ClassVar[str] = "subsurface-stress"
    summary: ClassVar[str] = "stress below the surface of the lower body"
    figures: ClassVar[tuple[str, ...]] = ("stress", "stress_close_up", "stress_3d")
    records: ClassVar[tuple[type, ...]] = (StressPart, Maximum, FrictionStress)
    arrays: ClassVar[tuple[Array, ...]] = (
        Array("component", "-", lambda part: list(_COMPONENTS), ("component",)),
        Array("plane_depth", "m", attrgetter("depth"), ("plane",)),
        Array("plane_side", "-", lambda part: list(part.side), ("plane",)),
        Array("plane_layer", "-", attrgetter("layer"), ("plane",)),
        Array("largest_von_mises", "Pa", attrgetter("largest_von_mises"), ("plane",)),
        Array("section_stress", "Pa", attrgetter("section"), ("component", "plane", "x")),
        Array("stress", "Pa", attrgetter("planes"), ("component", "plane", "y", "x")),
    )
    scalars: ClassVar[tuple[Scalar, ...]] = tuple(
        Scalar(f"max_{measure}{suffix}", unit, partial(_read, measure, field))
        for measure in _MEASURES
        for suffix, field, unit in _OF_A_MAXIMUM
    )

    depths: tuple[float, ...] | None = field(
        default=None,
        converter=_tuple,
        validator=_depths,
        metadata=si("m"),
    )
    keep: Literal["section", "planes"] = field(
        default="section", validator=choice("section", "planes")
    )
    window: float = field(default=128.0, validator=_at_least_one, metadata=si("-"))
    tolerance: float = field(default=0.01, validator=positive, metadata=si("-"))
    reading: Reading = field(default="spline", validator=choice(*READINGS))
    coefficients: tuple[float, ...] = field(
        default=(), converter=_floats, validator=_coefficients, metadata=si("-")
    )

    @property
    def sources(self) -> tuple[str, ...]:
        """See `Effect.sources`."""
        return (
            "stress of the layered half-space, Eq. (2.20) of Cai 2008, by a sweep down the layers",
            "von Mises, principal and shear stress: Appendix A of Cai 2008, in 3-D",
        )

    def lacks(self, scene: ContactScene) -> tuple[str, ...]:
        """See `ContactEffect.lacks`."""
        missing = []
        if scene.interface.lower.solid is None:
            missing.append("interface.lower.solid: the stress of a rigid body is not defined")
        missing += _below_base(self.depths, scene.interface.lower.stack)
        if self.coefficients and scene.effect(FrictionTraction) is None:
            missing.append("FrictionTraction(coefficient=...) beside it for its coefficients [-]")
        if self.coefficients and scene.effect(Attraction) is not None:
            missing.append(
                "one scene for each of its coefficients [-] beside an attraction, with which "
                "friction is not proportional to the net pressure"
            )
        if self.coefficients and scene.effect(DisplacementTerm) is not None:
            missing.append(
                "one scene for each of its coefficients [-] (or no FrictionCoupling, with which "
                "the pressure depends on the coefficient)"
            )
        return tuple(missing)

    def observe(self, contact: SolvedContact) -> StressPart:
        """See `Observer.observe`."""
        stack = contact.scene.interface.lower.elastic_stack
        found = _Planes(self, contact, stack)
        places = self._first_places(contact, stack)
        while places:
            found.add(places)
            places = found.missing() if self.depths is None else []
        return found.part()

    def _first_places(self, contact: SolvedContact, stack: Stack) -> list[Place]:
        """Depth [m] and side of each plane to begin with, and both faces of interfaces."""
        if self.depths is not None:
            wanted, deepest = [(z, "+") for z in self.depths], self.depths[-1] * (1.0 + 1e-12)
        else:
            deepest = _deepest(contact, stack)
            first = default_depths((), min(2.0 * _sharpest(contact), deepest), _FIRST)
            wanted = [(z, "+") for z in first.depths]
        faces = [z for z in stack.depths if z <= deepest]
        inside = [one for one in wanted if not any(math.isclose(one[0], z) for z in faces)]
        both = [(z, side) for z in faces for side in "-+"]
        if stack.base:  # below which there is no stress
            both = [one for one in both if one != (stack.depths[-1], "+")]
        return _ordered(inside + both)


def _below_base(depths: tuple[float, ...] | None, stack: Stack | None) -> list[str]:
    """State that planes lie below the rigid base, if any does."""
    if depths is None or stack is None or not stack.base:
        return []
    lowest = stack.depths[-1]
    if depths[-1] <= lowest * (1.0 + 1e-12):
        return []
    return [f"depths of at most {lowest:g} m, where the rigid base begins, got {depths[-1]:g} m"]


def _ordered(places: Sequence[Place]) -> list[Place]:
    return sorted(places, key=lambda place: (place[0], place[1] == "+"))


def _deepest(contact: SolvedContact, stack: Stack) -> float:
    """Depth [m] below which no maximum is looked for.

    Half a period, or an isolated window, or its side across if it repeats along one axis; at most
    that of a rigid base.
    """
    (ny, nx), (dy, dx) = contact.grid.shape, contact.grid.pixel_size
    sides = {"x": ny * dy, "y": nx * dx}  # across the axis of their name
    deepest = min(sides.values()) * (0.5 if contact.grid.periodic else 1.0)
    if contact.grid.along:
        deepest = sides[contact.grid.along]
    return min(deepest, stack.depths[-1]) if stack.base else deepest


def _sharpest(contact: SolvedContact) -> float:
    """Radius [m] of the smallest spot of high pressure, that of a circle of its area."""
    from scipy.ndimage import label

    pressure = contact.pressure
    spots, n = label(pressure > _HIGH * pressure.max())
    pixels = np.bincount(spots.ravel())[1:].min() if n else 1
    area = float(pixels) * contact.grid.pixel_area
    radius = math.sqrt(area / math.pi)
    if contact.grid.along is None:
        return radius
    (ny, nx), (dy, dx) = contact.grid.shape, contact.grid.pixel_size
    # Or half the width of a strip, where that is what the spot may be.
    return max(radius, 0.5 * area / (nx * dx if contact.grid.along == "x" else ny * dy))


def stress_field(effect: SubsurfaceStress, contact: SolvedContact) -> StressField:
    """Stress in the lower body under the pressure and the tractions of a contact.

    With further coefficients of friction that of their traction is kept apart.
    """
    friction = contact.scene.effect(FrictionTraction)
    ratio = friction.components() if friction is not None else None
    x, y = None, None
    # In proportion to the pressure, tractions cost no transforms of their own; those of partial
    # slip are not, nor those beside an attraction: there is no friction across the gap.
    if contact.tractions is not None and (ratio is None or contact.attracted is not None):
        (x, y), ratio = contact.tractions, None
    return StressField(
        Tractions(contact.grid.pixel_size, contact.pressure, x, y),
        layers_of(contact.scene.interface.lower.elastic_stack),
        mean=contact.grid.along or ("periodic" if contact.grid.periodic else "free"),
        padding=effect.window,
        reading=effect.reading,
        friction=None if effect.coefficients else ratio,
        drag=friction.direction_cosines if friction and effect.coefficients else None,
        workers=contact.threads,
    )


class _Kept(NamedTuple):
    """What is kept of one plane."""

    depth: float
    side: str
    layer: int
    section: Map
    largest_von_mises: float
    stress: Map | None


class _Planes:
    """Planes of stress below a contact, added in any order, and what is kept of them."""

    def __init__(self, effect: SubsurfaceStress, contact: SolvedContact, stack: Stack) -> None:
        friction = contact.scene.effect(FrictionTraction)
        self._effect, self._contact = effect, contact
        # With further coefficients friction is kept apart: its stress is that of one of them.
        own = friction.coefficient if friction is not None and effect.coefficients else 0.0
        self._sliding = (own, *effect.coefficients)
        self._field = stress_field(effect, contact)
        self._search = DepthSearch(effect.tolerance, _deepest(contact, stack))
        peak = int(np.argmax(contact.pressure))
        self._row = int(np.unravel_index(peak, contact.pressure.shape)[0])
        self._kept: list[_Kept] = []

    def add(self, places: Sequence[Place]) -> None:
        """Compute planes, given in order of depth."""
        depths, sides = [z for z, _ in places], [side for _, side in places]
        pixel, keep = self._contact.grid.pixel_size, self._effect.keep == "planes"
        coefficients = self._effect.coefficients
        for plane in self._field.planes(depths, sides):
            found, *others = plane_maxima(plane, pixel, self._sliding)
            self._note(None, found)
            for mu, other in zip(coefficients, others, strict=True):
                self._note(mu, other)
            section, largest = self._own(plane, self._row).copy(), found["von_mises"].value
            stress = self._own(plane, slice(None)) if keep else None
            one = _Kept(plane.depth, plane.side, plane.layer, section, largest, stress)
            self._kept.append(one)

    def _own(self, plane: Plane, rows: int | slice) -> Map:
        """Stress with the friction of the scene, on some rows of a plane."""
        if plane.dragged is None:
            return plane.stress[:, rows]
        return np.asarray(plane.stress[:, rows] + self._sliding[0] * plane.dragged[:, rows])

    def _note(self, mu: float | None, found: Mapping[str, Maximum]) -> None:
        for measure, one in found.items():
            self._search.add((mu, measure), one)

    def missing(self) -> list[Place]:
        """Planes that the search wants; none once it has more than enough."""
        if len(self._kept) >= _MOST:
            return []
        known = [one.depth for one in self._kept]
        wanted = self._search.missing()
        return [(z, "+") for z in wanted if not any(math.isclose(z, one) for one in known)]

    def part(self) -> StressPart:
        """Put everything together, in order of depth."""
        kept = sorted(self._kept, key=lambda one: (one.depth, one.side == "+"))
        planes = [one.stress for one in kept if one.stress is not None]
        return StressPart(
            depth=np.array([one.depth for one in kept]),
            side=tuple(one.side for one in kept),
            layer=np.array([one.layer for one in kept], dtype=int),
            maxima=self._maxima(None),
            row=self._row,
            section=np.stack([one.section for one in kept], axis=1),
            largest_von_mises=np.array([one.largest_von_mises for one in kept]),
            planes=np.stack(planes, axis=1) if planes else None,
            by_friction=tuple(
                FrictionStress(mu, self._maxima(mu)) for mu in self._effect.coefficients
            ),
        )

    def _maxima(self, mu: float | None) -> dict[str, Maximum]:
        best = {name: self._search.best((mu, name)) for name in _MEASURES if name != "sqrt_j2"}
        mises = best["von_mises"]
        return best | {"sqrt_j2": mises._replace(value=mises.value / math.sqrt(3.0))}
