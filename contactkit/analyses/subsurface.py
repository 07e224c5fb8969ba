"""Stress below a contact that is solved already: any friction, any planes, those of maxima."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any, Literal, NamedTuple

import numpy as np
from attrs import evolve

from ..contact.effects.base import (
    Attraction,
    ContactEffect,
    DisplacementTerm,
    SolvedContact,
    SurfaceTraction,
    effects_of,
)
from ..contact.effects.friction import FrictionTraction
from ..contact.effects.partial_slip import PartialSlip
from ..contact.effects.stress import StressPart, SubsurfaceStress, stress_field
from ..contact.result import ContactResult
from ..elasticity.stress.maxima import Maximum
from ..elasticity.stress.measures import max_principal_stress, sqrt_j2, tresca, von_mises
from ..errors import DescriptionError, PlanError, nearest

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ..scene.scenes import ContactScene

    Map = NDArray[np.float64]

__all__ = ["LABELS", "MEASURES", "MaximumPlane", "maximum_planes", "planes_below", "stress_below"]

MeasureName = Literal["von_mises", "sqrt_j2", "tension", "tresca", "sigma_xz"]


def _sigma_xz(stress: Map) -> Map:
    size: Map = np.abs(stress[4])
    return size


MEASURES: Mapping[str, Callable[[Map], Map]] = {
    "von_mises": von_mises,
    "sqrt_j2": sqrt_j2,
    "tension": max_principal_stress,
    "tresca": tresca,
    "sigma_xz": _sigma_xz,
}
"""Measures of a stress (6, ...), by the names of `StressPart.maxima`."""

LABELS = {
    "von_mises": "von Mises stress",
    "sqrt_j2": "square root of J2",
    "tension": "largest principal stress",
    "tresca": "maximum shear stress",
    "sigma_xz": "shear stress |xz|",
}
"""Label of each measure."""


class MaximumPlane(NamedTuple):
    """Plane in which a measure is greatest: where, and the measure on it (ny, nx) [Pa]."""

    maximum: Maximum
    values: Map


def stress_below(
    result: ContactResult,
    effect: SubsurfaceStress | None = None,
    friction: FrictionTraction | None = None,
) -> StressPart:
    """Stress in the lower body of a contact that is solved already.

    The pressure of a contact without `FrictionCoupling` (or `PartialSlip` with `coupled`) does not
    depend on friction, so that one solve serves all coefficients.

    Parameters
    ----------
    result : ContactResult
        The solved contact.
    effect : SubsurfaceStress, optional
        Depths, what to keep, coefficients for further maxima; the default if not given.
    friction : FrictionTraction, optional
        Sliding friction in place of the tractions of the scene.

    Returns
    -------
    StressPart
        As ``result.of(SubsurfaceStress)`` of a scene with these effects.

    Raises
    ------
    PlanError
        If the lower body is rigid, has no planes where they are wanted, or if the pressure depends
        on the friction that is to be replaced.

    Examples
    --------
    >>> import contactkit as ck
    >>> steel = ck.Material(young_modulus=210e9, poisson_ratio=0.3)
    >>> scene = ck.ContactScene(
    ...     interface=ck.Interface(
    ...         lower=ck.Body(solid=steel), upper=ck.Body(surface=ck.Paraboloid(radius=1e-3))
    ...     ),
    ...     window=ck.Window(width=60e-6, periodic=False),
    ...     loading=ck.Pressing(force=0.2),
    ...     effects=(ck.HalfSpace(),),
    ... )
    >>> ball = ck.solve(ck.plan(scene, ck.Accuracy(grid=48)))
    >>> for mu in (0.0, 0.5):  # Hamilton's: 0.620 and 0.957 of the maximum pressure
    ...     part = stress_below(ball, friction=ck.FrictionTraction(coefficient=mu))
    ...     print(round(part.maxima["von_mises"].value / ball.max_pressure, 2))
    0.62
    0.96
    """
    effect = effect if effect is not None else SubsurfaceStress()
    return effect.observe(_contact_of(result, effect, friction))


def planes_below(
    result: ContactResult, places: Sequence[tuple[float, str]], effect: SubsurfaceStress
) -> Iterator[Map]:
    """Stress (6, ny, nx) [Pa] on planes of a solved contact, one after the other, none kept.

    Parameters
    ----------
    result : ContactResult
        The solved contact.
    places : sequence of (float, str)
        Depth [m] and side of each plane, growing: "+" below a depth, "-" above.
    effect : SubsurfaceStress
        Its reading and window; its depths are not used.

    Raises
    ------
    PlanError
        As `stress_below` does.
    """
    plain = evolve(effect, depths=None, coefficients=())
    field = stress_field(plain, _contact_of(result, plain, None))
    for plane in field.planes([z for z, _ in places], [side for _, side in places]):
        yield plane.stress


def _contact_of(
    result: ContactResult, effect: SubsurfaceStress, friction: FrictionTraction | None
) -> SolvedContact:
    """Contact of a result as effects see it, with another choice of stresses and friction."""
    scene = _scene_of(result, effect, friction)
    plan, attraction = result.plan, scene.effect(Attraction)
    contact = SolvedContact(
        scene,
        plan.grid,
        result.pressure,
        result.displacement,
        result.gap,
        plan.accuracy.threads,
        attracted=None
        if attraction is None
        else attraction.attracted_of(result.of(type(attraction))),
    )
    law = friction or scene.effect(SurfaceTraction)
    if law is not None:
        part = result.of(type(law)) if friction is None else friction.observe(contact)
        contact = contact._replace(tractions=law.tractions(part))
    return contact


def _scene_of(
    result: ContactResult, effect: SubsurfaceStress, friction: FrictionTraction | None
) -> ContactScene:
    """Scene of a result with another choice of stresses and, if given, of friction."""
    scene = result.plan.scene
    new: tuple[ContactEffect[Any], ...] = (effect,)
    kept = tuple(one for one in effects_of(scene) if not isinstance(one, SubsurfaceStress))
    if friction is not None:
        _check_replaced(scene)
        new = (friction, effect)
        kept = tuple(one for one in kept if not isinstance(one, SurfaceTraction))
    scene = evolve(scene, effects=(*kept, *new))
    if lacking := [item for one in new for item in one.lacks(scene)]:
        raise PlanError(f"stress_below needs {'; '.join(lacking)}")
    return scene


def _check_replaced(scene: ContactScene) -> None:
    """Refuse another friction where the pressure of the result depends on that of its scene."""
    slip = scene.effect(PartialSlip)
    if scene.effect(DisplacementTerm) is None and not (slip and slip.couples(scene)):
        return
    raise PlanError(
        "stress_below cannot replace friction that acts back on the pressure (FrictionCoupling, "
        "PartialSlip(coupled=True)): solve the scene with the other friction"
    )


def maximum_planes(
    result: ContactResult,
    measures: Sequence[MeasureName] = ("von_mises", "tension", "sigma_xz"),
    effect: SubsurfaceStress | None = None,
    friction: FrictionTraction | None = None,
) -> dict[str, MaximumPlane]:
    """Return each measure of the stress on the plane where it is greatest.

    The planes are found by a search over depth that keeps none; only those of the maxima are
    computed again.

    Parameters
    ----------
    result : ContactResult
        The solved contact.
    measures : sequence of str
        Names of `MEASURES`.
    effect, friction
        See `stress_below`.

    Raises
    ------
    DescriptionError
        If there is no such measure.
    PlanError
        As `stress_below` does.
    """
    for name in measures:
        if name not in MEASURES:
            hint = nearest(name, list(MEASURES))
            raise DescriptionError("measures", name, "be a measure of stress", hint=hint)
    effect = effect if effect is not None else SubsurfaceStress()
    maxima = stress_below(result, effect, friction).maxima
    depths = tuple(sorted({maxima[name].z for name in measures}))
    planes = evolve(effect, depths=depths, keep="planes", coefficients=())
    part = stress_below(result, planes, friction)
    found: dict[str, MaximumPlane] = {}
    for name in measures:
        best = maxima[name]
        at = [
            i
            for i, (z, side) in enumerate(zip(part.depth, part.side, strict=True))
            if abs(z - best.z) <= 1e-9 * best.z and side == best.side
        ]
        assert part.planes is not None
        found[name] = MaximumPlane(best, MEASURES[name](part.planes[:, at[0]]))
    return found
