"""A coarser companion of a contact: the same heights on every second pixel, or fewer."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from attrs import evolve

from ..accuracy import Accuracy
from ..errors import DescriptionError
from ..scene.interface import Body, Interface
from ..scene.rough_surfaces import Heights
from ..scene.window import Window
from .effects.hardness_rules import ConstantHardness, HardnessMap
from .effects.plasticity import HardnessLimit
from .plan import ContactPlan, unprepared_plan

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Map = NDArray[np.float64]

__all__ = ["coarser", "largest_factor"]


def coarser(
    plan: ContactPlan,
    heights: Map,
    factor: int = 2,
    accuracy: Accuracy | None = None,
    first: int = 0,
) -> ContactPlan:
    """Return the plan of the same contact on pixels `factor` times as wide.

    Parameters
    ----------
    plan : ContactPlan
        The plan of the contact.
    heights : ndarray (ny, nx)
        Heights of both bodies together [m]; every pixel number `factor` is taken.
    factor : int
        Width of a pixel of the companion over that of the plan.
    accuracy : Accuracy, optional
        Tolerances of the companion; those of the plan if not given.
    first : int
        Row and column of the first pixel that is taken, below the factor.

    Raises
    ------
    DescriptionError
        If the pixels of the window are no multiple of the factor.
    """
    (ny, nx), (dy, dx) = plan.grid.shape, plan.grid.pixel_size
    if ny % factor or nx % factor or min(ny, nx) < 2 * factor:
        raise DescriptionError(
            "Accuracy.grid",
            plan.grid.shape,
            f"be multiples of {factor}, at least {2 * factor}, for a companion on pixels "
            f"{factor} times as wide",
        )
    lower, upper = plan.scene.interface.bodies
    taken = slice(first, None, factor)
    given = plan.prepared.open(heights)[taken, taken]
    surface = Heights(heights=given, pixel_size=(factor * dy, factor * dx))
    scene = evolve(
        plan.scene,
        interface=Interface(
            lower=Body(solid=lower.solid),
            upper=Body(surface=surface, solid=upper.solid),
            meniscus=plan.scene.interface.meniscus,
        ),
        window=Window(periodic=plan.grid.edges),
        effects=tuple(_thinned(effect, taken) for effect in plan.scene.effects),
    )
    return unprepared_plan(scene, evolve(accuracy or plan.accuracy, grid=None))


def largest_factor(plan: ContactPlan, fewest: int) -> int:
    """Largest power of two that leaves a companion of at least `fewest` pixels along each side."""
    factor, shape = 1, plan.grid.shape
    while all(n % (2 * factor) == 0 and n // (2 * factor) >= fewest for n in shape):
        factor *= 2
    return factor


def _thinned(effect: Any, taken: slice) -> Any:
    """Take an effect with the map that it may hold on the pixels of the companion."""
    if isinstance(effect, HardnessLimit) and isinstance(effect.rule, ConstantHardness):
        given = effect.rule.hardness
        if isinstance(given, HardnessMap):
            rule = ConstantHardness(hardness=HardnessMap(given.values[taken, taken]))
            return evolve(effect, rule=rule)
    return effect
