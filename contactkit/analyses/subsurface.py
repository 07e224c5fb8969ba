"""Stress below a contact that is solved already: any friction, any planes, those of maxima."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Literal, NamedTuple

import numpy as np
from attrs import evolve

from ..contact.effects.base import SolvedContact
from ..contact.effects.friction import FrictionTraction
from ..contact.effects.stress import StressPart, SubsurfaceStress
from ..contact.result import ContactResult
from ..elasticity.stress.maxima import Maximum
from ..elasticity.stress.measures import max_principal_stress, sqrt_j2, tresca, von_mises
from ..errors import DescriptionError, PlanError, nearest

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Map = NDArray[np.float64]

__all__ = ["MEASURES", "MaximumPlane", "maximum_planes", "stress_below"]

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

    The pressure of a contact without `FrictionCoupling` does not depend on friction, so that one
    solve serves all coefficients.

    Parameters
    ----------
    result : ContactResult
        The solved contact.
    effect : SubsurfaceStress, optional
        Depths, what to keep, coefficients for further maxima; the default if not given.
    friction : FrictionTraction, optional
        Friction in place of that of the scene.

    Returns
    -------
    StressPart
        As ``result.of(SubsurfaceStress)`` of a scene with these effects.

    Raises
    ------
    PlanError
        If the lower body is rigid, or has no planes where they are wanted.

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
    >>> for mu in (0.0, 0.25, 0.5):  # Hamilton's: 0.620, 0.648, 0.957 of the maximum pressure
    ...     part = stress_below(ball, friction=ck.FrictionTraction(coefficient=mu))
    ...     print(round(part.maxima["von_mises"].value / ball.max_pressure, 2))
    0.62
    0.65
    0.96
    """
    effect = effect if effect is not None else SubsurfaceStress()
    plan, scene = result.plan, result.plan.scene
    replaced = (SubsurfaceStress, FrictionTraction) if friction is not None else SubsurfaceStress
    kept = tuple(one for one in scene.effects if not isinstance(one, replaced))
    new = (friction, effect) if friction is not None else (effect,)
    scene = evolve(scene, effects=(*kept, *new))
    if lacking := [item for one in new for item in one.lacks(scene)]:
        raise PlanError(f"stress_below needs {'; '.join(lacking)}")
    threads = plan.accuracy.threads
    contact = SolvedContact(
        scene, plan.grid, result.pressure, result.displacement, result.gap, threads
    )
    return effect.observe(contact)


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
