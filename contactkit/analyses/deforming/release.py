"""Time of release of a film between deforming bodies, over the pull or the time of rest."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, ClassVar

import numpy as np
from attrs import evolve, field, frozen

from ...accuracy import Accuracy
from ...arguments import positive_values
from ...errors import DescriptionError, PlanError
from ...scene.curve import Curve, Shown
from ...scene.loading import ImposedForce, PressAndPull
from ...scene.plan import check_scene
from ...scene.scenes import SeparationScene
from ...separation.deforming.plan import plan_deforming
from ...separation.deforming.run import pull_apart
from ...units import si

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

__all__ = ["ReleaseCurve", "release_over"]


@frozen(eq=False)
class ReleaseCurve(Curve):
    """Time from the start of the pull to the release; arrays of one shape.

    Attributes
    ----------
    force, rest : ndarray, shape (n,)
        Pull [N] and time of rest before it [s].
    release_time : ndarray, shape (n,)
        From the start of the pull [s]; nan where it exceeds the limit of time of the loading.
    largest_contact_force : ndarray, shape (n,)
        Largest force of the asperities [N].
    """

    shown: ClassVar[Shown] = {"release": (("release_time",), "")}
    title: ClassVar[str] = "time of release"

    axis: str
    force: Floats = field(repr=False, metadata=si("N"))
    rest: Floats = field(repr=False, metadata=si("s"))
    release_time: Floats = field(repr=False, metadata=si("s"))
    largest_contact_force: Floats = field(repr=False, metadata=si("N"))


def release_over(
    scene: SeparationScene,
    *,
    forces: Sequence[float | str] | Floats | None = None,
    rests: Sequence[float | str] | Floats | None = None,
    accuracy: Accuracy | None = None,
) -> ReleaseCurve:
    """Time of release over the pull, or over the time of rest before it.

    Parameters
    ----------
    scene : SeparationScene
        With `ElasticBodies`, and a pull by a force: `ImposedForce`, or `PressAndPull` with a force.
    forces, rests : sequence of float, optional
        Pulls [N], or times of rest [s]: exactly one of the two.
    accuracy : Accuracy, optional
        As of `ck.plan`.

    Raises
    ------
    PlanError
        If the scene imposes no pull, or has no rest to vary.
    DescriptionError
        If not exactly one is given, or a value is not positive.

    Examples
    --------
    Twice the pull releases in less than half of the time:

    >>> import contactkit as ck
    >>> gel = ck.Material(young_modulus=1e6, poisson_ratio=0.5)
    >>> oil = ck.Meniscus(liquid=ck.Liquid(name="oil", viscosity=0.1))
    >>> lower = ck.Body(surface=ck.Flat(radius=5e-4), solid=gel)
    >>> body = ck.Interface(lower=lower, upper=ck.Sphere(radius=5e-3), meniscus=oil)
    >>> loading = ck.ImposedForce(force=1e-4, initial_gap=1e-6, final_gap=3e-6)
    >>> effects = (ck.ElasticBodies(), ck.ViscousForce())
    >>> scene = ck.SeparationScene(interface=body, loading=loading, effects=effects)
    >>> rough = ck.Accuracy(film_rtol=1e-2)
    >>> slow, fast = release_over(scene, forces=[1e-4, 2e-4], accuracy=rough).release_time
    >>> bool(slow > 2.0 * fast)
    True
    """
    check_scene(scene, SeparationScene)
    loading = scene.loading
    if (forces is None) == (rests is None):
        given = [name for name, one in (("forces", forces), ("rests", rests)) if one is not None]
        raise DescriptionError("release_over", given, "be given exactly one of forces and rests")
    if not isinstance(loading, ImposedForce | PressAndPull) or loading.force is None:
        raise PlanError("release_over needs a pull by a force: ImposedForce(...)")
    if rests is not None and not isinstance(loading, PressAndPull):
        raise PlanError("release_over(rests=...) needs loading = PressAndPull(...), with a rest")
    name, values, unit = ("force", forces, "N") if rests is None else ("rest", rests, "s")
    rows = []
    for value in positive_values(f"release_over({name}s)", values or (), unit):
        imposed = _with(loading, name, float(value))
        result = pull_apart(plan_deforming(evolve(scene, loading=imposed), accuracy))
        rest = imposed.rest if isinstance(imposed, PressAndPull) else 0.0
        released = result.numbers["release_time"] - rest
        rows.append((imposed.force, rest, released, result.numbers["largest_contact_force"]))
    return ReleaseCurve(name, *np.array(rows, dtype=np.float64).T.copy())


def _with(
    loading: ImposedForce | PressAndPull, name: str, value: float
) -> ImposedForce | PressAndPull:
    """Loading with another pull, or another time of rest."""
    if isinstance(loading, PressAndPull):
        return evolve(loading, rest=value) if name == "rest" else evolve(loading, force=value)
    return evolve(loading, force=value)
