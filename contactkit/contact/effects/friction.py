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

    from ...scene.interface import Interface
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


# Strength of the coupling of half-spaces at most. Relaxed steps contract by c/sqrt(1 + c^2): a
# sphere takes 74 contacts at 2.6, 165 at 3.4, 333 at 4.9. At 10 active sets of the coupled
# equations do not settle either, not even from the solution at a coefficient 1 % below.
_STRONGEST = 5.0


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
    takes_anisotropy: ClassVar[bool] = True
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
        return ("traction mu p on the frictionless pressure: Goodman 1962; Eq. (2.24) of Cai 2008",)

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
    about c = mu (1 - 2 nu)/(2 (1 - nu)). Beyond c = 1 the steps are relaxed by 1/(1 + c^2) and
    converge as well. There is one solution for any coefficient, as the coupling is skew: along a
    direction of sliding it does no work in sum (Lions and Stampacchia 1967).

    Half-spaces with c > 5 are refused: the pressure at the trailing edge goes as the distance to it
    to the power ``1/2 - arctan(c)/pi``, 0.06 there, nearly a jump, whose place no grid resolves;
    pixels ring around it, by 30 % of the pressure at c = 2, not their sums.
    Sliding solids have coefficients of friction of 0.1 to 3.
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
        return ("coupling compliance F12 of the layered half-space, Eq. (2.34) of Cai 2008",)

    def lacks(self, scene: ContactScene) -> tuple[str, ...]:
        """See `ContactEffect.lacks`."""
        friction, interface = scene.effect(FrictionTraction), scene.interface
        if friction is None or any(
            s.layers or s.base or not s.is_isotropic for s in interface.stacks
        ):
            return ()
        constant = _dundurs(interface)
        if not abs(friction.coefficient) * constant > _STRONGEST:
            return ()
        return (
            f"FrictionTraction.coefficient of at most {_STRONGEST / constant:.3g}, not "
            f"{friction.coefficient:g}: times Dundurs' constant of {constant:.3g} it is "
            f"{friction.coefficient * constant:.3g}, and from {_STRONGEST:g} on the pressure jumps "
            "at the trailing edge of a contact, at a place that no grid resolves; lower it, or "
            "leave FrictionCoupling out",
        )

    def strength(self, scene: ContactScene, grid: Grid) -> float:
        """See `DisplacementTerm.strength`."""
        from ..slip.coupling import coupling_strength

        coefficient = scene.demand(FrictionTraction).coefficient
        if not coefficient:
            return 0.0
        return coefficient * coupling_strength(grid, *bodies_of(scene.interface))

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


def _dundurs(interface: Interface) -> float:
    """Dundurs' second constant of two half-spaces, or of one on a rigid body [-], its size."""
    coupled, pressed = 0.0, 0.0
    for body, sign in ((interface.lower, 1.0), (interface.upper, -1.0)):
        if body.stack is not None:
            (modulus,), (nu,) = body.stack.young_moduli, body.stack.poisson_ratios
            coupled += sign * (1.0 + nu) * (1.0 - 2.0 * nu) / modulus
            pressed += 2.0 * (1.0 - nu**2) / modulus
    return abs(coupled) / pressed
