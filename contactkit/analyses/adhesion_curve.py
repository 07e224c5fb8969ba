"""Contact radius and approach of an adhesive sphere as functions of the load."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, ClassVar

import numpy as np
from attrs import field, frozen

from ..arguments import listed
from ..errors import InfeasibleError, PlanError
from ..scene.curve import Curve, Shown
from ..scene.plan import check_scene
from ..scene.scenes import SeparationScene
from ..separation.effects.adhesion import AdhesiveContact
from ..separation.effects.prepared import checked_liquid, prepare_scene
from ..units import si

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ..separation.effects.adhesion import AdhesionNumbers

    Floats = NDArray[np.float64]

__all__ = ["AdhesionCurve", "adhesion_curve"]


@frozen(eq=False)
class AdhesionCurve(Curve):
    """Adhesive contact of one sphere over its load; all arrays of one shape, read-only.

    Attributes
    ----------
    load : ndarray, shape (n,)
        Load [N], negative if tensile.
    approach : ndarray, shape (n,)
        Approach from first contact [m], negative where a neck is formed.
    contact_radius, cohesive_radius : ndarray, shape (n,)
        Radii of the contact and of the cohesive zone [m]; equal in models without a cohesive zone
        (JKR, DMT).
    numbers : AdhesionNumbers
        Pull-off force, Tabor and Maugis parameters, and the gap at pull-off.
    effect : AdhesiveContact
        Model that was taken.
    """

    axis: ClassVar[str] = "load"
    shown: ClassVar[Shown] = {
        "radii": (("contact_radius", "cohesive_radius"), ""),
        "load": (("load",), "approach"),
    }
    title: ClassVar[str] = "adhesive contact of a sphere"

    load: Floats = field(repr=False, metadata=si("N"))
    approach: Floats = field(repr=False, metadata=si("m"))
    contact_radius: Floats = field(repr=False, metadata=si("m"))
    cohesive_radius: Floats = field(repr=False, metadata=si("m"))
    numbers: AdhesionNumbers
    effect: AdhesiveContact = field(repr=False)

    @property
    def sources(self) -> tuple[str, ...]:
        """See `Curve.sources`."""
        return self.effect.sources

    def scalars(self) -> dict[str, tuple[float, str]]:
        """Return forces and gap at pull-off."""
        names = {"pull_off_force": "N", "release_gap": "m", "release_force": "N"}
        return {name: (getattr(self.numbers, name), unit) for name, unit in names.items()}


def adhesion_curve(scene: SeparationScene, loads: Sequence[float | str] | Floats) -> AdhesionCurve:
    r"""Contact radius and approach of an adhesive sphere over its load.

    Parameters
    ----------
    scene : SeparationScene
        With a sphere and an `AdhesiveContact`; its opening is not looked at.
    loads : sequence of float
        Loads on one sphere [N]; at least minus the pull-off force.

    Raises
    ------
    PlanError
        If the scene has no `AdhesiveContact`, or its data are incomplete.
    InfeasibleError
        If a tensile load exceeds the pull-off force.

    Notes
    -----
    Of the states at a load it is the stable one. Hertz is the limit without adhesion; the sphere is
    a paraboloid, with a relative error of the radius of order (a/R)^2.

    Examples
    --------
    >>> import contactkit as ck
    >>> film = ck.Meniscus(liquid=ck.Liquid(name="air"))
    >>> body = ck.Interface(upper=ck.Sphere(radius=1e-5), meniscus=film)
    >>> rubber = ck.AdhesiveContact(model="jkr", work_of_adhesion=0.05, reduced_modulus=1e9)
    >>> loading = ck.ImposedSpeed(initial_gap=1e-9, final_gap=1e-6, speed=1e-6)
    >>> scene = ck.SeparationScene(interface=body, loading=loading, effects=(rubber,))
    >>> curve = ck.adhesion_curve(scene, [0.0, 1e-6])
    >>> (curve.contact_radius * 1e9).round(1), f"{curve.numbers.pull_off_force:.4g} N"
    (array([413.5, 439.7]), '2.356e-06 N')
    """
    check_scene(scene, SeparationScene)
    effect = scene.effect(AdhesiveContact)
    if effect is None:
        raise PlanError(
            "the scene does not call for adhesive-contact: add AdhesiveContact(...) to its effects"
        )
    liquid = checked_liquid(scene)
    if missing := effect.lacks(scene):
        raise PlanError("; ".join(f"AdhesiveContact needs {item}" for item in missing))
    from ..separation.effects.adhesion import states_at_loads

    given = listed("adhesion_curve(loads)", loads, "N")
    numbers = effect.numbers(prepare_scene(scene, liquid=liquid))
    if given.size and given.min() < -numbers.pull_off_force * (1.0 + 1e-12):
        raise InfeasibleError(
            f"a load of {given.min():.4g} N exceeds the pull-off force of "
            f"{numbers.pull_off_force:.4g} N; give a smaller tensile load"
        )
    states = states_at_loads(numbers, [float(load) for load in given])
    columns = np.array(states, dtype=np.float64).reshape(-1, 4).T.copy()
    columns.flags.writeable = False
    load, approach, contact, cohesive = columns
    return AdhesionCurve(load, approach, contact, cohesive, numbers, effect)
