"""Partial slip: stick and slip of the contact along a tangential load path."""

from __future__ import annotations

import math
from operator import attrgetter
from typing import TYPE_CHECKING, Any, ClassVar, Literal

from attrs import Attribute, field, frozen

from ...errors import DescriptionError
from ...scene.loading import TangentialStep
from ...units import si
from ...validators import (
    as_tuple,
    as_whole,
    count,
    finite,
    friction_coefficient,
    optional,
    part,
    positive,
    refuse,
)
from ...validity import ValidityNumber
from ..slip.states import PartialSlipPart, SlipCoupling, Zone
from .base import Array, LoadHistory, Scalar, SolvedContact, SurfaceTraction
from .elasticity import bodies_of, contact_modulus, layers_of

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from ...scene.interface import Interface
    from ...scene.scenes import ContactScene
    from ..slip.load_path import FrictionLaw

_MAPS = ("step", "y", "x")
_CURVES = (
    ("force", "N"),
    ("displacement", "m"),
    ("transverse_force", "N"),
    ("transverse_displacement", "m"),
    ("dissipated_work", "J"),
    ("stiffness", "N/m"),
    ("stick_fraction", "-"),
)

__all__ = ["PartialSlip"]

_TRANSVERSE = 0.4  # q_y left out over nu/(2 - nu), measured on a sphere and a rough surface
# A tenth of the largest traction along the load, which is reached at nu = 0.4.
_MOST_TRANSVERSE = 0.1
# The pressure of a pixel changes by one to four times that: 10 to 40 %.
_MOST_COUPLING = 0.1
# Loosest error that steps may be chosen for: beyond, the number of steps says as much as it does.
_MOST_STEP_ERROR = 0.1
# A cycle of a sphere loses the right work to 2e-5 at this tolerance, to 0.4 % at four to ten times
# it; at 0.1 nothing slips in its last step, and two thirds of the loss are missing.
_LOOSEST = 1e-3
_PRESSING = 0.01  # error by the steps of pressing, unless another is asked for
_NARROWEST = 2.0  # pixels of slip around what sticks: the loss of a sphere is then right to 1 %
_HELD = 1e-3  # of full sliding, below which friction holds: slip takes 2e-4 of the work at most


def _steps(owner: object, attribute: Attribute[Any], value: Any) -> None:
    if not value or not all(isinstance(one, TangentialStep) for one in value):
        raise refuse(owner, attribute, value, "be at least one TangentialStep")


def _components(owner: object, attribute: Attribute[Any], value: Any) -> None:
    if isinstance(value, bool) or not isinstance(value, int) or value not in (1, 2):
        raise refuse(owner, attribute, value, "be 1 or 2")


def _tolerance(owner: object, attribute: Attribute[Any], value: Any) -> None:
    positive(owner, attribute, value)
    if value > _LOOSEST:
        raise refuse(owner, attribute, value, f"be at most {_LOOSEST:g}", "beyond, nothing slips")


def _step_error(owner: object, attribute: Attribute[Any], value: Any) -> None:
    positive(owner, attribute, value)
    if value > _MOST_STEP_ERROR:
        raise refuse(
            owner,
            attribute,
            value,
            f"be at most {_MOST_STEP_ERROR:g}",
            "for a rough answer give few pressing_steps",
        )


def _last(name: str) -> Any:
    return lambda part: float(getattr(part, name)[-1])


@frozen(kw_only=True)
class PartialSlip(SurfaceTraction[PartialSlipPart]):
    r"""Stick and slip of the contact under a tangential load that follows a path.

    The pressure is that of contact without friction, and stays: exact for two equal bodies and
    for incompressible ones. Otherwise pressure and tractions displace each other's surfaces, which
    `coupled` takes into account and the default leaves out; `validity` has its size. Each sub-step
    is implicit,

    .. math:: \min_q \tfrac12 (q - q_0)^T H (q - q_0) - D \sum (q - q_0), \quad |q| \le \mu p,

    from the tractions q_0 of the one before, with H the tangential compliance of the (layered)
    bodies. With one component a monotonic step is exact, whatever the number of sub-steps; they
    only add states to the result. With two it converges with them.

    Parameters
    ----------
    coefficient : float
        Coefficient of friction [-], 0 to 1000, which holds wherever there is pressure.
    path : tuple of TangentialStep
        Loading, unloading, reversal: forces or displacements, one after the other.
    components : {1, 2}
        Tractions along the load only, or along and across it. One is exact for nu = 0; for
        nu = 0.3 it leaves out a transverse traction of up to 7 % of the largest, and the
        displacement is right within 0.1 %.
    direction : float
        Direction of the load, from the x axis towards y [rad].
    guided : bool, optional
        With two components only: whether the transverse displacement is held, or the transverse
        force is zero. None: held.
    rtol : float
        Largest violation of a condition over the displacement of a sub-step [-], at most 1e-3.
    coupled : bool
        Whether pressure displaces the surfaces along the contact, and tractions along the normal,
        as they do for dissimilar bodies; needs `components` = 2. The bodies are then pressed
        together step by step and without a tangential force before the path begins, which gives
        tractions (and slip at the edge) already.
    pressing_steps : int, optional
        Steps in which coupled bodies are pressed together [-]; None: as many as `pressing_rtol`
        asks for. The error of the tractions falls as one over their number: 4 % rms for 8 on a
        sphere or a rough surface; `SlipCoupling.step_error` estimates it.
    pressing_rtol : float, optional
        Error of the tractions by the steps of pressing, rms over that of their bound [-], at most
        0.1; None: 0.01, which needs some 15 to 60 steps; a tenth of it needs ten times as many.

    Notes
    -----
    Coupled, the path begins where pressing ends: displacement counts from there, and the dissipated
    work of the first state is that of pressing. `stiffness` is that at the pressure as it is.
    Beside `PlasticHistory` its steps press the bodies together, and the path deforms them further.
    A minimum belongs to each step of the tractions, not to both loads together. Pressed in a single
    step, a sphere has been found for coefficients up to 3 (nu = 0), in two or more for 10; for 100
    and more only with some numbers of steps, as its outermost pixels come and go by turns. A step
    without a state ends in a `ConvergenceError`.

    Examples
    --------
    Cattaneo and Mindlin: a sphere under a tangential force of 0.6 times full sliding.

    >>> import contactkit as ck
    >>> glass = ck.Material(name="glass", young_modulus=70e9, poisson_ratio=0.3)
    >>> scene = ck.ContactScene(
    ...     interface=ck.Interface(
    ...         lower=ck.Body(solid=glass), upper=ck.Body(surface=ck.Paraboloid(radius=1e-3))
    ...     ),
    ...     window=ck.Window(width=51.3e-6, periodic=False),
    ...     loading=ck.Pressing(force=1.0),
    ...     effects=(
    ...         ck.HalfSpace(),
    ...         ck.PartialSlip(coefficient=0.3, path=(ck.TangentialStep(ratio=0.6),)),
    ...     ),
    ... )
    >>> part = ck.solve(ck.plan(scene, ck.Accuracy(grid=32))).of(ck.PartialSlip)
    >>> f"{part.force[-1]:.2f} N, {part.displacement[-1] * 1e9:.1f} nm"
    '0.18 N, 76.0 nm'

    Coupled, the rigid sphere is pressed on glass first, and slips near the edge as Spence has it:

    >>> from attrs import evolve
    >>> at_rest = ck.PartialSlip(
    ...     coefficient=0.2,
    ...     path=(ck.TangentialStep(force=0.0),),
    ...     components=2,
    ...     coupled=True,
    ...     pressing_rtol=0.1,
    ... )
    >>> pressed = evolve(scene, effects=(ck.HalfSpace(), at_rest))
    >>> part = ck.solve(ck.plan(pressed, ck.Accuracy(grid=24))).of(ck.PartialSlip)
    >>> f"{part.stick_fraction[0]:.2f} sticks, {part.coupling.pressure_change:.2f} more pressure"
    '0.48 sticks, 0.08 more pressure'
    """

    name: ClassVar[str] = "partial-slip"
    summary: ClassVar[str] = "stick and slip under a tangential load path"
    figures: ClassVar[tuple[str, ...]] = ("slip_zones", "traction", "hysteresis")
    takes_holes: ClassVar[bool] = True
    takes_free_sheets: ClassVar[bool] = False
    records: ClassVar[tuple[type, ...]] = (PartialSlipPart, SlipCoupling)
    arrays: ClassVar[tuple[Array, ...]] = (
        *(Array(f"slip_{name}", unit, attrgetter(name), ("state",)) for name, unit in _CURVES),
        Array("slip_traction_x", "Pa", attrgetter("traction_x"), _MAPS),
        Array("slip_traction_y", "Pa", attrgetter("traction_y"), _MAPS),
        Array("slip_zone", "-", attrgetter("zones"), _MAPS),
    )
    scalars: ClassVar[tuple[Scalar, ...]] = (
        Scalar("tangential_force", "N", _last("force")),
        Scalar("tangential_displacement", "m", _last("displacement")),
        Scalar("friction_work", "J", _last("dissipated_work")),
        Scalar("tangential_stiffness", "N/m", _last("stiffness")),
        Scalar("stick_fraction", "-", _last("stick_fraction")),
        Scalar("slip_residual", "-", attrgetter("residual")),
    )

    coefficient: float = field(validator=friction_coefficient, metadata=si("-"))
    path: tuple[TangentialStep, ...] = field(converter=as_tuple, validator=_steps)
    components: Literal[1, 2] = field(
        default=1, converter=as_whole, validator=_components, metadata=si("-")
    )
    direction: float = field(default=0.0, validator=finite, metadata=si("rad"))
    guided: bool | None = field(default=None, validator=optional(part(bool)))
    rtol: float = field(default=1e-8, validator=_tolerance, metadata=si("-"))
    coupled: bool = field(default=False, validator=part(bool))
    pressing_steps: int | None = field(
        default=None, converter=as_whole, validator=optional(count), metadata=si("-")
    )
    pressing_rtol: float | None = field(
        default=None, validator=optional(_step_error), metadata=si("-")
    )

    def __attrs_post_init__(self) -> None:
        """Refuse what would not be read."""
        if self.guided is not None and self.components == 1:
            raise DescriptionError(
                "PartialSlip.guided",
                self.guided,
                "be left out with components=1, which has no transverse displacement",
                hint="give components=2, or leave it out",
            )
        chosen = [n for n in ("pressing_steps", "pressing_rtol") if getattr(self, n) is not None]
        if chosen and not self.coupled:
            raise DescriptionError(
                f"PartialSlip.{chosen[0]}",
                getattr(self, chosen[0]),
                "be left out without coupled=True: pressing causes no tractions then",
            )
        if len(chosen) > 1:
            raise DescriptionError(
                "PartialSlip.pressing_steps",
                self.pressing_steps,
                "be left out beside pressing_rtol, which chooses them",
            )

    @property
    def sources(self) -> tuple[str, ...]:
        """See `Effect.sources`."""
        sources: tuple[str, ...] = (
            "Coulomb's law in increments: Cattaneo 1938, Mindlin and Deresiewicz 1953, "
            "Johnson 1985, sections 7.2 to 7.4",
            "tangential compliances F11 and Fs of the layered half-space",
        )
        if self.coupled:
            sources += ("coupling compliance F12; frictional pressing: Spence 1975, Johnson 5.4",)
        return sources

    @property
    def pressing_error(self) -> float:
        """Error of the tractions by the steps of pressing that is aimed at [-]."""
        return _PRESSING if self.pressing_rtol is None else self.pressing_rtol

    def couples(self, scene: ContactScene) -> bool:
        """Whether pressure and tractions of a scene displace each other's surfaces."""
        lower, upper = bodies_of(scene.interface)
        return self.coupled and self.coefficient > 0.0 and lower != upper

    @property
    def law(self) -> FrictionLaw:
        """Friction as the path is solved with."""
        from ..slip.load_path import FrictionLaw

        return FrictionLaw(
            self.coefficient, self.direction, self.components, self.guided is not False, self.rtol
        )

    def lacks(self, scene: ContactScene) -> tuple[str, ...]:
        """See `ContactEffect.lacks`."""
        missing = []
        turned = [s for s in self.path if s.direction is not None and s.direction != self.direction]
        if self.components == 1 and turned:
            missing.append(
                "components=2 for path steps of another direction [rad] than its own "
                "(or direction=... for all of them)"
            )
        if self.coupled:
            missing += self._lacks_for_coupling(scene)
        return tuple(missing)

    def _lacks_for_coupling(self, scene: ContactScene) -> list[str]:
        missing = []
        if self.components == 1:
            missing.append(
                "components=2 with coupled=True, as pressure draws the surfaces along both axes"
            )
        has_steps = self.pressing_steps is not None or self.pressing_rtol is not None
        if has_steps and scene.effect(LoadHistory) is not None:
            missing.append(
                "no pressing_steps or pressing_rtol beside PlasticHistory, whose steps press the "
                "bodies together"
            )
        return missing

    def observe(self, contact: SolvedContact) -> PartialSlipPart:
        """See `Observer.observe`."""
        from ..slip.load_path import follow

        stacks = tuple(layers_of(stack) for stack in contact.scene.interface.stacks)
        pressure = contact.contact_pressure
        return follow(pressure, contact.grid, stacks, self.path, self.law, contact.threads)

    def tractions(self, part: PartialSlipPart) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """See `SurfaceTraction.tractions`: those at the end of the path."""
        return part.traction_x[-1], part.traction_y[-1]

    def validity(
        self, contact: SolvedContact, part: PartialSlipPart | None
    ) -> tuple[ValidityNumber, ...]:
        """See `ContactEffect.validity`."""
        interface = contact.scene.interface
        coupling = None if part is None else part.coupling
        found = [self._left_out(contact, part)] if coupling is None else []
        if coupling is not None:
            chosen = self.pressing_steps is None
            found.append(
                ValidityNumber(
                    name="error of the tractions by the steps of pressing",
                    value=coupling.step_error,
                    high=self.pressing_error if chosen else _MOST_STEP_ERROR,
                    detail=f"rms over that of their bound, after {coupling.pressing_steps} steps; "
                    + ("raise pressing_rtol" if chosen else "leave pressing_steps to contactkit"),
                    source="first order in their number, measured on spheres and rough surfaces",
                )
            )
        if self.components == 1:
            found.append(
                ValidityNumber(
                    name="transverse traction left out",
                    value=_TRANSVERSE * _cross_compliance(interface),
                    high=_MOST_TRANSVERSE,
                    detail="largest traction across the load over the largest along it; "
                    "components=2 has it",
                    source="measured on a sphere and on a rough surface, nu = 0.3",
                )
            )
        if part is not None:
            found.append(
                ValidityNumber(
                    name="pixels across the slip around what sticks",
                    value=_slip_width(contact, part, self.coefficient),
                    low=_NARROWEST,
                    detail="at the end of the step of the path where it is narrowest; the loss of "
                    "a cycle is off by 5 % over its square; use a finer Accuracy.grid or a smaller "
                    "Window",
                    source="Mindlin and Deresiewicz's loss of a sphere, 48 to 128 pixels across",
                )
            )
            found.append(
                ValidityNumber(
                    name="residual of partial slip",
                    value=part.residual,
                    high=1.01 * self.rtol,
                    detail="violation of Coulomb's law over the displacement of a sub-step; use "
                    "fewer sub-steps, or a larger rtol",
                )
            )
        return tuple(found)

    def _left_out(self, contact: SolvedContact, part: PartialSlipPart | None) -> ValidityNumber:
        return ValidityNumber(
            name="normal and tangential coupling left out",
            value=None if part is None else _coupling(contact, part),
            high=_MOST_COUPLING,
            detail="range of the normal displacement by the largest tractions of the path over "
            "that by pressure; the pressure of a pixel changes by one to four times that. "
            "PartialSlip(coupled=True, components=2) has it",
            source="coupling compliance F12 of the layered half-space; Johnson 1985, section 5.4",
        )


def _surfaces(interface: Interface) -> list[tuple[float, float]]:
    """Shear modulus [Pa] and Poisson's ratio of the surfaces that deform."""
    tops = [stack.materials[0] for stack in interface.stacks]
    return [
        (0.5 * top.young_modulus / (1.0 + top.poisson_ratio), top.poisson_ratio) for top in tops
    ]


def _coupling(contact: SolvedContact, part: PartialSlipPart) -> float:
    """Range of the normal displacement by the largest tractions over that by pressure [-]."""
    import numpy as np

    from ..slip.coupling import coupling_of, relative_coupling

    lower, upper = bodies_of(contact.scene.interface)
    largest = int(np.argmax((part.traction_x**2 + part.traction_y**2).sum(axis=(1, 2))))
    x, y = part.traction_x[largest], part.traction_y[largest]
    if lower == upper or not (x.any() or y.any()):
        return 0.0
    caused_by = coupling_of(contact.grid, lower, upper, contact.threads)
    strain = float(contact.contact_pressure.max()) / contact_modulus(contact.scene)
    caused = caused_by(x if x.any() else None, y if y.any() else None)
    return relative_coupling(caused, contact.displacement, strain * contact.grid.area**0.5)


def _slip_width(contact: SolvedContact, part: PartialSlipPart, coefficient: float) -> float | None:
    """Least width of the slip between what sticks and the edges of contact, in pixels.

    Twice its pixels over those along its edges. None if nothing sticks, if the force is too small
    to count, and in a window without an edge of contact.
    """
    import numpy as np

    full = coefficient * float(contact.contact_pressure.sum()) * contact.grid.pixel_area
    ends = [part.end_of(step) for step in range(int(part.step[-1]) + 1)]
    widths = []
    for zones, end in zip(part.zones, ends, strict=False):  # a path may have failed before its end
        sticks, touches = zones == Zone.STICK, zones != Zone.OPEN
        force = float(np.hypot(part.force[end], part.transverse_force[end]))
        if force > _HELD * full and sticks.any() and not touches.all():
            edge = 0.5 * (_edge_length(sticks) + _edge_length(touches))
            widths.append(np.count_nonzero(touches & ~sticks) / edge)
    return min(widths, default=None)


def _edge_length(region: NDArray[np.bool_]) -> float:
    """Length of the edges of a region [pixels]: stairs are longer than a line, 4/pi on average."""
    sides = sum(int((one[1:] != one[:-1]).sum()) for one in (region, region.T))
    return 0.25 * math.pi * sides


def _cross_compliance(interface: Interface) -> float:
    """Part of the tangential compliance that depends on the direction [-]: nu/(2 - nu)."""
    bodies = _surfaces(interface)
    return sum(nu / shear for shear, nu in bodies) / sum((2.0 - nu) / shear for shear, nu in bodies)
