"""The contact side of adhesion: radius and approach of a sphere over the load that presses it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from attrs import field, frozen

from ..errors import DescriptionError, InfeasibleError, PlanError
from ..scene.scenes import SeparationScene
from ..separation.effects.registry import AdhesiveContact

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ..separation.effects.adhesion import AdhesionNumbers

    Curve = NDArray[np.float64]

__all__ = ["AdhesionCurve", "adhesion_curve"]


@frozen(eq=False)
class AdhesionCurve:
    """Contact of one sphere over its load; all arrays of one shape, read-only.

    Attributes
    ----------
    load : ndarray, shape (n,)
        Load [N], negative where it pulls.
    approach : ndarray, shape (n,)
        How far the sphere has sunk below first touch [m], negative where a neck is drawn out.
    contact_radius, cohesive_radius : ndarray, shape (n,)
        Radii of the contact and of the attraction around it [m]; the same where the model gives
        that no edge of its own (JKR, DMT).
    numbers : AdhesionNumbers
        Pull-off force, Tabor's and Maugis' parameter and where the contact lets go.
    """

    load: Curve = field(repr=False)
    approach: Curve = field(repr=False)
    contact_radius: Curve = field(repr=False)
    cohesive_radius: Curve = field(repr=False)
    numbers: AdhesionNumbers


def adhesion_curve(scene: SeparationScene, loads: Sequence[float] | Curve) -> AdhesionCurve:
    r"""Contact radius and approach of a sphere that adheres, over its load.

    Parameters
    ----------
    scene : SeparationScene
        With a sphere and an `AdhesiveContact`; its opening is not looked at.
    loads : sequence of float
        Loads on one sphere [N]; at least minus the pull-off force.

    Raises
    ------
    PlanError
        If the scene has no `AdhesiveContact`, or that lacks something.
    InfeasibleError
        If a load pulls harder than the contact holds.

    Notes
    -----
    Of the states a load allows it is the stable one. Hertz' is the limit of no adhesion; the sphere
    is a paraboloid, which costs the radius a share of order (a/R)^2.

    Examples
    --------
    >>> import contactkit as ck
    >>> film = ck.Meniscus(liquid=ck.Liquid(name="air"))
    >>> body = ck.Interface(upper=ck.Sphere(radius=1e-5), meniscus=film)
    >>> rubber = ck.AdhesiveContact(model="jkr", work_of_adhesion=0.05, reduced_modulus=1e9)
    >>> opening = ck.Opening(initial_gap=1e-9, final_gap=1e-6, speed=1e-6)
    >>> scene = ck.SeparationScene(interface=body, opening=opening, effects=(rubber,))
    >>> curve = ck.adhesion_curve(scene, [0.0, 1e-6])
    >>> (curve.contact_radius * 1e9).round(1), f"{curve.numbers.pull_off_force:.4g} N"
    (array([413.5, 439.7]), '2.356e-06 N')
    """
    effect = scene.effect(AdhesiveContact)
    if effect is None:
        raise PlanError(
            "the scene does not call for adhesive-contact: add AdhesiveContact() to its effects"
        )
    if missing := effect.lacks(scene):
        raise PlanError("; ".join(f"AdhesiveContact needs {item}" for item in missing))
    from ..separation.effects.adhesion import states_at_loads

    given = np.atleast_1d(np.asarray(loads, dtype=np.float64))
    if given.ndim != 1 or not np.all(np.isfinite(given)):
        raise DescriptionError("adhesion_curve(loads)", loads, "be finite numbers", unit="N")
    numbers = effect.numbers(scene)
    if given.size and given.min() < -numbers.pull_off_force * (1.0 + 1e-12):
        raise InfeasibleError(
            f"a load of {given.min():.4g} N tears the contact off: it holds "
            f"{numbers.pull_off_force:.4g} N at most; pull less"
        )
    states = states_at_loads(numbers, [float(load) for load in given])
    columns = np.array(states, dtype=np.float64).reshape(-1, 4).T.copy()
    columns.flags.writeable = False
    load, approach, contact, cohesive = columns
    return AdhesionCurve(load, approach, contact, cohesive, numbers)
