"""Result of a contact: maps, numbers, the parts of the effects, residual and cost."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, TypeVar, cast

import numpy as np
from attrs import field, frozen

from ..errors import NotSimulatedError
from ..export.contents import Contents, Quantity
from ..frozen import FrozenDict
from ..scene.result import Result
from ..scene.scales import Scales
from ..scene.tabular import pixel_axes
from ..validity import ValidityNumber
from .effects.base import Attraction, ContactEffect
from .effects.plasticity import HardnessLimit
from .grid import holes_of
from .pixel_edges import EDGE_EXCESS, pixel_edges
from .plan import ContactPlan
from .scales import contact_scales
from .work import ContactWork

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Map = NDArray[np.float64]

__all__ = ["ContactResult"]

_Part = TypeVar("_Part")


@frozen(eq=False)
class ContactResult(Result):
    """Maps and numbers of one contact; arrays are read-only.

    Attributes
    ----------
    plan : ContactPlan
        The plan that was run, without its preparation.
    status : str
        ``converged``, ``no contact``, or ``not converged``.
    message : str
        The same as a sentence, with its cure.
    pressure, gap, displacement, heights : ndarray (ny, nx)
        Pressure [Pa], gap [m], normal displacement of both surfaces together [m], and heights of
        both bodies together [m]. With `Adhesion` the pressure is the net one, negative where the
        surfaces attract each other.
    rigid_approach : float
        Rigid-body approach of the zero plane of the heights [m]: gap = displacement - heights -
        rigid_approach.
    residual : float
        Largest violation of the contact conditions over the rms height [-].
    energy : float
        Complementary energy ``1/2 p C p - p h`` [J]; the solution is its minimum.
    work : ContactWork
        Counts and seconds.
    parts : mapping of effect class to its part
        The parts of all effects; `of` gives one of them.
    validity : tuple of ValidityNumber
        Whether grid and models were inside their ranges.
    """

    plan: ContactPlan = field(repr=False)
    status: str
    message: str
    pressure: Map = field(repr=False)
    gap: Map = field(repr=False)
    displacement: Map = field(repr=False)
    heights: Map = field(repr=False)
    rigid_approach: float
    residual: float
    energy: float
    work: ContactWork
    parts: Mapping[type[ContactEffect[Any]], object] = field(repr=False)
    validity: tuple[ValidityNumber, ...] = field(repr=False)

    @property
    def columns(self) -> Mapping[str, Map]:
        """The maps by their names; ``result["gap"]`` is one of them."""
        names = ("pressure", "gap", "displacement", "heights")
        return FrozenDict({name: getattr(self, name) for name in names})

    @property
    def scales(self) -> Scales:
        """Reduced modulus E*; rms height and area of the window, or radius of a round body.

        See `contact.scales.contact_scales`.
        """
        return contact_scales(self.plan.scene, self.heights, self.plan.grid.area)

    def unit(self, name: str) -> str:
        """See `Result.unit`."""
        return "Pa" if name == "pressure" else "m"

    @property
    def contact(self) -> NDArray[np.bool_]:
        """Pixels in contact (ny, nx): where the pressure is not zero, or its `Adhesion` states."""
        attraction = self.plan.scene.effect(Attraction)
        if attraction is not None and type(attraction) in self.parts:
            return attraction.attracted_of(self.parts[type(attraction)]).touching
        touching: NDArray[np.bool_] = self.pressure > 0.0
        return touching

    @property
    def holes(self) -> NDArray[np.bool_] | None:
        """Pixels (ny, nx) that were masked in the heights; None if there are none.

        They carry no load. Heights and gap have a number there, which means nothing:
        ``np.ma.array(result.heights, mask=result.holes)`` masks them.
        """
        return holes_of(self.plan.scene)

    @property
    def contact_area(self) -> float:
        """Real area of contact [m2], as a count of pixels."""
        return float(self.contact.sum()) * self.plan.grid.pixel_area

    @property
    def corrected_contact_area(self) -> float:
        """Real area of contact [m2], edge-corrected: without the excess of pixels cut by its edge.

        The edges between pixels in and out of contact, of total length S, carry an excess of
        ``(pi - 1 + ln 2)/24 S dx`` on average over the directions of a smooth edge (Yastrebov,
        Anciaux and Molinari 2017). Spots should be several pixels wide; the result is at least 0.
        """
        touching, (dy, dx) = self.contact, self.plan.grid.pixel_size
        edges = pixel_edges(touching, self.plan.grid.edges).total
        return max(self.contact_area - EDGE_EXCESS * edges * dx * dy, 0.0)

    @property
    def contact_fraction(self) -> float:
        """Real area of contact over the window [-]."""
        return float(self.contact.mean())

    @property
    def load(self) -> float:
        """Normal force that the contact carries [N]; negative if `Adhesion` has to be pulled."""
        return float(self.pressure.sum()) * self.plan.grid.pixel_area

    @property
    def mean_pressure(self) -> float:
        """Load over the window [Pa]."""
        return float(self.pressure.mean())

    @property
    def max_pressure(self) -> float:
        """Maximum of the pressure [Pa]."""
        return float(self.pressure.max())

    @property
    def max_displacement(self) -> float:
        """Maximum displacement under contact [m], from the datum of `approach_datum`."""
        return float(self.displacement[self.contact].max(initial=0.0))

    @property
    def approach(self) -> float:
        """Rigid-body approach from first touch [m]."""
        return self.rigid_approach + float(self.heights.max())

    @property
    def approach_datum(self) -> str:
        """Datum of approach and displacement."""
        stacks = self.plan.scene.interface.stacks
        if all(stack.base for stack in stacks):
            return "the rigid base of the bodies"
        if self.plan.grid.along:
            return "points of the surface as far from a line load as the window is wide across"
        if self.plan.grid.periodic:
            mixed = any(stack.base for stack in stacks)
            also = " of the half-space, and the rigid base of the other body" if mixed else "s"
            return f"the mean plane of the deformed surface{also}"
        return "points of the bodies far from the contact"

    @property
    def notes(self) -> tuple[str, ...]:
        """See `Result.notes`."""
        return (f"approach and displacement from {self.approach_datum}",)

    @property
    def plastic_area(self) -> float:
        """Area at the hardness [m2]; raises without `HardnessLimit`."""
        return self.of(HardnessLimit).area

    def contents(self) -> Contents:
        """Return maps over y and x, what each effect adds, and the numbers; nan in holes."""
        grid, axes = self.plan.grid, ("y", "x")
        found = dict(pixel_axes(grid.shape, grid.pixel_size)) | {
            "pressure": Quantity(axes, self.pressure, "Pa", "pressure"),
            "gap": Quantity(axes, self._known(self.gap), "m", "gap"),
            "displacement": Quantity(axes, self.displacement, "m", "normal displacement"),
            "heights": Quantity(axes, self._known(self.heights), "m", "heights of both bodies"),
            "contact": Quantity(axes, self.contact, "-", "pixels in contact"),
        }
        for kind, part in self.parts.items():
            arrays = ((one, one.read(part)) for one in kind.arrays)
            found |= {
                one.name: Quantity(one.axes, values, one.unit, one.name.replace("_", " "))
                for one, values in arrays
                if values is not None
            }
        return Contents(axes, found | self._numbers(), self._remarks())

    def _known(self, values: Map) -> Map:
        """Heights or gaps, without those of holes."""
        return values if self.holes is None else np.where(self.holes, math.nan, values)

    def of(self, kind: type[ContactEffect[_Part]]) -> _Part:
        """Return the part of an effect: its maps and numbers.

        Raises
        ------
        NotSimulatedError
            If the scene does not call for the effect.
        """
        self.plan.listed(kind)
        if kind not in self.parts:
            raise NotSimulatedError(
                f"{kind.__name__} has no part of its own; see result.displacement"
            )
        return cast("_Part", self.parts[kind])

    def _refuse(self, name: str) -> None:
        """Every contact has the same maps."""

    def scalars(self) -> dict[str, tuple[float, str]]:
        """Return the numbers of the run, each with its unit."""
        found = {
            "load": (self.load, "N"),
            "mean_pressure": (self.mean_pressure, "Pa"),
            "max_pressure": (self.max_pressure, "Pa"),
            "contact_area": (self.contact_area, "m2"),
            "contact_fraction": (self.contact_fraction, "-"),
            "corrected_contact_area": (self.corrected_contact_area, "m2"),
            "max_displacement": (self.max_displacement, "m"),
            "approach": (self.approach, "m"),
        }
        for kind, part in self.parts.items():
            read = ((scalar, scalar.read(part)) for scalar in kind.scalars)
            found |= {one.name: (value, one.unit) for one, value in read if value is not None}
        return found | {"residual": (self.residual, "-"), "energy": (self.energy, "J")}
