"""Quasi-static sliding: tangential traction of friction, and the normal displacement it causes."""

from __future__ import annotations

import math
import sys
from operator import attrgetter
from typing import TYPE_CHECKING, ClassVar, NamedTuple

from attrs import field, frozen

from ...units import si
from ...validators import finite, friction_coefficient
from .base import Array, DisplacementTerm, FrictionalContact, Scalar, SolvedContact, SurfaceTraction
from .elasticity import bodies_of

if TYPE_CHECKING:
    from collections.abc import Callable

    from ...scene.scenes import ContactScene
    from ...scene.window import Grid
    from .base import Map

__all__ = [
    "CouplingPart",
    "FrictionCoupling",
    "FrictionPart",
    "FrictionTraction",
    "TractionRatio",
]


class TractionRatio(NamedTuple):
    """Traction on the lower body along x and y per unit of pressure [-]."""

    x: float
    y: float


class FrictionPart(NamedTuple):
    """Traction on the lower body [Pa], (ny, nx) each, and its sum [N]."""

    traction_x: Map
    traction_y: Map
    force: float


class CouplingPart(NamedTuple):
    """Normal displacement that friction causes (ny, nx) [m], and the changes of the contact.

    `pressure_change` is the largest change of the pressure over its maximum [-], `area_change`
    the change of the contact area over that without coupling [-].
    """

    displacement: Map
    pressure_change: float
    area_change: float


@frozen(kw_only=True)
class FrictionTraction(SurfaceTraction[FrictionPart]):
    """Sliding contact: each pixel carries a traction of friction times pressure.

    The traction on the lower body points where the upper body slides, the one on the upper body
    against it: ``sigma_xz(0) = -mu p`` for sliding along +x. The pressure is that of the contact
    without friction (Goodman); `FrictionCoupling` takes the difference into account. Beside
    `Adhesion` it is the pressure of contact, which carries load and tension (Derjaguin 1934).

    Parameters
    ----------
    coefficient : float
        Coefficient of friction [-], 0 to 1000; rubber has above 1.
    direction : float
        Direction in which the upper body slides, from the x axis towards y [rad].
    """

    takes_holes: ClassVar[bool] = True
    name: ClassVar[str] = "friction-traction"
    summary: ClassVar[str] = "tangential traction of quasi-static sliding"
    records: ClassVar[tuple[type, ...]] = (FrictionPart,)
    arrays: ClassVar[tuple[Array, ...]] = (
        Array("traction_x", "Pa", attrgetter("traction_x")),
        Array("traction_y", "Pa", attrgetter("traction_y")),
    )
    scalars: ClassVar[tuple[Scalar, ...]] = (Scalar("friction_force", "N", attrgetter("force")),)

    coefficient: float = field(validator=friction_coefficient, metadata=si("-"))
    direction: float = field(default=0.0, validator=finite, metadata=si("rad"))

    @property
    def sources(self) -> tuple[str, ...]:
        """See `Effect.sources`."""
        return ("traction mu p on the pressure without friction: Goodman 1962, Eq. (2.24)",)

    @property
    def direction_cosines(self) -> TractionRatio:
        """Direction of the traction on the lower body: that for a coefficient of 1."""
        return TractionRatio(math.cos(self.direction), math.sin(self.direction))

    def components(self) -> TractionRatio:
        """Traction on the lower body per unit of pressure."""
        along = self.direction_cosines
        return TractionRatio(self.coefficient * along.x, self.coefficient * along.y)

    def lacks(self, scene: ContactScene) -> tuple[str, ...]:
        """See `ContactEffect.lacks`."""
        if any(stack.base == "frictionless" for stack in scene.interface.stacks):
            return ("RigidBase(bonded=True): nothing holds a body that slides on its base",)
        return ()

    def observe(self, contact: SolvedContact) -> FrictionPart:
        """See `Observer.observe`."""
        ratio, pressure = self.components(), contact.contact_pressure
        load = float(pressure.sum()) * contact.grid.pixel_area
        return FrictionPart(ratio.x * pressure, ratio.y * pressure, self.coefficient * load)

    def tractions(self, part: FrictionPart) -> tuple[Map, Map]:
        """See `SurfaceTraction.tractions`."""
        return part.traction_x, part.traction_y


@frozen(kw_only=True)
class FrictionCoupling(DisplacementTerm[CouplingPart]):
    """The normal displacement that friction causes, fed back into the contact.

    Traction presses the surface in ahead of a contact and lifts it behind; the effect vanishes for
    incompressible bodies and for two equal ones. The coupled problem is no minimisation: it is
    solved by fixed-point iterations on the displacement of the last traction, which contract by
    about mu (1 - 2 nu)/(2 (1 - nu)).
    """

    takes_holes: ClassVar[bool] = True
    name: ClassVar[str] = "friction-coupling"
    summary: ClassVar[str] = "normal displacement caused by the tangential traction"
    records: ClassVar[tuple[type, ...]] = (CouplingPart,)
    scalars: ClassVar[tuple[Scalar, ...]] = (
        Scalar("coupling_pressure_change", "-", attrgetter("pressure_change")),
        Scalar("coupling_area_change", "-", attrgetter("area_change")),
    )

    @property
    def sources(self) -> tuple[str, ...]:
        """See `Effect.sources`."""
        return ("coupling compliance F12 of the layered half-space, Eq. (2.34)",)

    def prepare(self, scene: ContactScene, grid: Grid) -> Callable[[Map], Map]:
        """See `DisplacementTerm.prepare`."""
        import numpy as np

        from ..slip.coupling import coupling_of

        ratio = scene.demand(FrictionTraction).components()
        caused_by = coupling_of(grid, *bodies_of(scene.interface))

        def displacement(pressure: Map) -> Map:
            if not (ratio.x or ratio.y):  # no friction displaces nothing
                return np.zeros(grid.shape)
            return caused_by(
                ratio.x * pressure if ratio.x else None, ratio.y * pressure if ratio.y else None
            )

        return displacement

    def observe_frictional(
        self, contact: SolvedContact, frictional: FrictionalContact
    ) -> CouplingPart:
        """See `DisplacementTerm.observe_frictional`: against the same load without coupling."""
        without = frictional.pressure_without
        maximum = max(float(without.max()), sys.float_info.min)
        pressure = contact.contact_pressure
        change = float(abs(pressure - without).max()) / maximum
        n_without = max(int((without > 0.0).sum()), 1)
        area = int((pressure > 0.0).sum()) / n_without - 1.0
        return CouplingPart(frictional.displacement, change, area)
