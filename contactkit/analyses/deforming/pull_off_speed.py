"""Pull-off force of a film between deforming bodies over the opening speed."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np
from attrs import evolve, field, frozen

from ...accuracy import Accuracy
from ...arguments import positive_values
from ...errors import PlanError
from ...scene.curve import Curve, Shown
from ...scene.loading import ImposedSpeed, PressAndPull
from ...scene.plan import check_scene
from ...scene.scenes import SeparationScene
from ...separation.deforming.plan import plan_deforming
from ...separation.deforming.run import pull_apart
from ...units import si

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

__all__ = ["PullOffSpeedCurve", "pull_off_over_speed"]


@frozen(eq=False)
class PullOffSpeedCurve(Curve):
    """Pull-off of a film between deforming bodies over the opening speed; arrays of one shape.

    Attributes
    ----------
    speed : ndarray, shape (n,)
        Opening speed [m/s].
    pull_off_force, rigid_force : ndarray, shape (n,)
        Largest force, and that of rigid bodies at the start [N].
    pull_off_time, smallest_gap, work_of_separation : ndarray, shape (n,)
        Of each pull [s], [m], [J].
    beta, force_error : ndarray, shape (n,)
        Displacement by the film over the gap, and the error of the force [-].
    """

    axis: ClassVar[str] = "speed"
    shown: ClassVar[Shown] = {
        "force": (("pull_off_force", "rigid_force"), ""),
        "work": (("work_of_separation",), ""),
    }
    title: ClassVar[str] = "pull-off force over the opening speed"

    speed: Floats = field(repr=False, metadata=si("m/s"))
    pull_off_force: Floats = field(repr=False, metadata=si("N"))
    rigid_force: Floats = field(repr=False, metadata=si("N"))
    pull_off_time: Floats = field(repr=False, metadata=si("s"))
    smallest_gap: Floats = field(repr=False, metadata=si("m"))
    work_of_separation: Floats = field(repr=False, metadata=si("J"))
    beta: Floats = field(repr=False, metadata=si("-"))
    force_error: Floats = field(repr=False, metadata=si("-"))

    @property
    def sources(self) -> tuple[str, ...]:
        """See `Curve.sources`."""
        return ("Davis, Serayssol and Hinch 1986: film and elastic sphere together",)


def pull_off_over_speed(
    scene: SeparationScene, speeds: Sequence[float | str] | Floats, accuracy: Accuracy | None = None
) -> PullOffSpeedCurve:
    """Pull-off force over the opening speed, of a scene with `ElasticBodies`.

    Parameters
    ----------
    scene : SeparationScene
        With `ImposedSpeed`, or `PressAndPull` at a speed; the speed is replaced.
    speeds : sequence of float
        [m/s]
    accuracy : Accuracy, optional
        As of `ck.plan`.

    Raises
    ------
    PlanError
        If the scene imposes no speed, or its bodies do not deform.
    DescriptionError
        If a speed is not positive.

    Notes
    -----
    A pull takes 0.4 to 4 s of CPU; the error of each is a column.

    Examples
    --------
    The faster, the softer the bodies answer:

    >>> import contactkit as ck
    >>> gel = ck.Material(young_modulus=1e6, poisson_ratio=0.5)
    >>> oil = ck.Meniscus(liquid=ck.Liquid(name="oil", viscosity=0.1))
    >>> lower = ck.Body(surface=ck.Flat(radius=5e-4), solid=gel)
    >>> body = ck.Interface(lower=lower, upper=ck.Sphere(radius=5e-3), meniscus=oil)
    >>> loading = ck.ImposedSpeed(speed=1e-6, initial_gap=1e-6, final_gap=3e-6)
    >>> effects = (ck.ElasticBodies(), ck.ViscousForce())
    >>> scene = ck.SeparationScene(interface=body, loading=loading, effects=effects)
    >>> curve = pull_off_over_speed(scene, [1e-8, 1e-6], ck.Accuracy(film_rtol=1e-2))
    >>> (curve.pull_off_force / curve.rigid_force).round(2).tolist()
    [0.92, 0.76]
    """
    check_scene(scene, SeparationScene)
    loading = scene.loading
    if not isinstance(loading, ImposedSpeed | PressAndPull) or loading.speed is None:
        raise PlanError("pull_off_over_speed needs a loading with a speed: ImposedSpeed(...)")
    found: list[dict[str, Any]] = []
    for speed in positive_values("pull_off_over_speed(speeds)", speeds, "m/s"):
        made = plan_deforming(evolve(scene, loading=evolve(loading, speed=float(speed))), accuracy)
        numbers = dict(pull_apart(made).numbers)
        rigid = numbers["pull_off_force"] / numbers["force_over_rigid"]
        found.append(numbers | {"speed": float(speed), "rigid_force": rigid})
    names = (
        "speed",
        "pull_off_force",
        "rigid_force",
        "pull_off_time",
        "smallest_gap",
        "work_of_separation",
        "beta",
        "force_error",
    )
    return PullOffSpeedCurve(*(np.array([one[name] for one in found]) for name in names))
