"""Division of a meniscus into many equal ones: forces over their number, and the optimum."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np
from attrs import astuple, field, frozen

from ..capillary import many_menisci as menisci
from ..errors import DescriptionError, InfeasibleError, NotSimulatedError, PlanError
from ..numerics.roots import bracketed_root
from ..scene.curve import Curve
from ..scene.plan import check_scene
from ..scene.scenes import SeparationScene
from ..separation.effects.meniscus import MeniscusForce
from ..separation.effects.viscous import ViscousForce
from ..units import si
from .division_laws import SOURCES, DivisionLaw, Name, law_of

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ..separation.effects.base import SeparationForce

    Floats = NDArray[np.float64]

__all__ = ["CriticalMeniscus", "DivisionResult", "critical_meniscus", "divide_meniscus"]

_AT_ONCE = 200  # numbers of menisci evaluated together


@frozen(eq=False)
class DivisionResult(Curve):
    """Forces of one film divided into N equal menisci.

    Curves are over `n_menisci`, read-only. The best number minimises the sum of the forces in the
    scene: the meniscus force at the start and the mean viscous force over the opening.

    Attributes
    ----------
    law : str
        ``exact``, ``arc`` or ``as-published``: one law for both forces.
    n_menisci : ndarray of int (n,)
        Requested numbers of menisci that are stable.
    unstable : tuple of int
        Requested numbers of menisci that do not span the gap.
    max_stable_count : int
        Maximum number of menisci that span the gap.
    best_count : int
        Number of menisci, up to that, with the minimum total force.
    best_force : float
        Minimum total force [N].
    limit_gap : ndarray (n,)
        Rupture gap of the menisci [m].
    contact_radius : ndarray (n,)
        Larger contact radius of one meniscus [m].
    """

    axis: ClassVar[str] = "n_menisci"

    scene: SeparationScene = field(repr=False)
    law: Name
    n_menisci: NDArray[np.int64] = field(metadata=si("-"))
    unstable: tuple[int, ...]
    max_stable_count: int = field(metadata=si("-"))
    best_count: int = field(metadata=si("-"))
    best_force: float = field(metadata=si("N"))
    limit_gap: Floats = field(repr=False, metadata=si("m"))
    contact_radius: Floats = field(repr=False, metadata=si("m"))
    _meniscus_force: Floats | None = field(repr=False)
    _viscous_force: Floats | None = field(repr=False)

    @property
    def title(self) -> str:
        """See `Curve.title`."""
        return f"one film divided, law {self.law}"

    @property
    def message(self) -> str:
        """See `Curve.message`."""
        return (
            f"division by the {self.law} law: best {self.best_count} menisci, {self.best_force:.4g}"
            f" N in total; at most {self.max_stable_count} are stable"
        )

    def table(self) -> dict[str, tuple[Any, str]]:
        """Return the curves over the number of menisci, of the forces that the scene lists."""
        forces = {"meniscus_force": self._meniscus_force, "viscous_force": self._viscous_force}
        known = {name: (one, "N") for name, one in forces.items() if one is not None}
        return super().table() | known

    @property
    def meniscus_force(self) -> Floats:
        """Force of all menisci together at the initial gap [N]; positive resists."""
        return _listed(MeniscusForce, self._meniscus_force)

    @property
    def viscous_force(self) -> Floats:
        """Mean viscous force of all over the opening [N]: impulse over its duration."""
        return _listed(ViscousForce, self._viscous_force)

    @property
    def total_force(self) -> Floats:
        """Sum of the forces in the scene [N]."""
        one, other = self._meniscus_force, self._viscous_force
        if one is None or other is None:
            return _listed(MeniscusForce, one if other is None else other)
        return one + other

    @property
    def coverage(self) -> Floats:
        """Area coverage: contact circles over the area of the face [-]; needs `Flat.radius`."""
        rim = self.scene.interface.rim_radius
        if math.isinf(rim):
            raise NotSimulatedError("the coverage needs the radius [m] of a Flat face")
        return np.asarray(menisci.coverage(self.n_menisci, self.contact_radius, math.pi * rim**2))

    @property
    def overlaps(self) -> NDArray[np.bool_]:
        """Whether the menisci overlap on the face in any arrangement."""
        max_count = np.where(self.n_menisci > 1, menisci.MAX_COVERAGE, 1.0)
        # One film that fills the face to the rim does not overlap.
        return np.asarray(self.coverage > max_count * (1.0 + 1e-9))

    @property
    def sources(self) -> tuple[str, ...]:
        """Sources of the equations of the law."""
        return (SOURCES[self.law],)

    def __str__(self) -> str:
        return self.message


def divide_meniscus(
    scene: SeparationScene, n_menisci: Sequence[int] | None = None, *, law: Name | None = None
) -> DivisionResult:
    r"""Divide the liquid between two flats into N equal menisci, at constant volume.

    Parameters
    ----------
    scene : SeparationScene
        Two flats, a meniscus with a volume (its own `count` is ignored), the initial gap, and
        either the time or the speed of the opening. The effects `MeniscusForce` and `ViscousForce`
        select the forces; the viscous force acts up to rupture of the menisci or the final gap,
        whichever is smaller.
    n_menisci : sequence of int, optional
        Numbers of menisci of the curves. None: up to 61 from 1 to the maximum stable number, in
        geometric progression.
    law : {"exact", "arc", "as-published"}, optional
        Law of both forces and of rupture. None: the profile of the scene's `MeniscusForce`. As
        published, x_n0 is the contact circle of the undivided film that the printed effects of the
        scene take; where the law is asked for by name and the effects are not printed, that of
        the area, volume over gap.

    Returns
    -------
    DivisionResult
        Curves, the maximum stable number, the optimum, and the law.

    Raises
    ------
    PlanError
        If the scene is not one of a film between flats, or is incomplete.
    InfeasibleError
        If not even one meniscus spans the gap.

    Notes
    -----
    Both forces are for free contact lines; a film that fills the faces is pinned at the rim, which
    `overlaps` shows. The viscous force falls as 1/N at fixed time, and nearly so at fixed speed,
    where the distance to rupture shrinks; the meniscus force of a hydrophilic film rises more
    slowly than the root of N of Eq. (3.33).

    Examples
    --------
    >>> import math
    >>> import contactkit as ck
    >>> water = ck.Liquid(name="water", surface_tension=0.072, viscosity=0.89e-3)
    >>> film = ck.Meniscus(
    ...     liquid=water, volume=2e-21,
    ...     contact_angle_lower=math.pi / 3, contact_angle_upper=math.pi / 3)
    >>> scene = ck.SeparationScene(
    ...     interface=ck.Interface(meniscus=film),
    ...     loading=ck.ImposedTime(initial_gap=2e-9, final_gap=1e-6, time=1e-7),
    ...     effects=(ck.MeniscusForce(), ck.ViscousForce()))
    >>> print(divide_meniscus(scene, law="as-published"))
    division by the as-published law: best 285 menisci, 4.159e-05 N in total; at most 23108052 are stable
    """  # noqa: E501
    check_scene(scene, SeparationScene)
    volume = _volume(scene)
    made = law_of(scene, law, volume)
    max_count = menisci.max_stable_count(made.gap, float(made.limit(np.asarray(volume))))
    if max_count < 1:
        raise InfeasibleError(
            f"no meniscus spans the initial gap of {made.gap:g} m: this volume reaches "
            f"{float(made.limit(np.asarray(volume))):g} m at most"
        )
    requested = _requested(n_menisci, max_count)
    stable = np.array([n for n in requested if n <= max_count], dtype=np.int64)
    best, force = _best(made, volume, max_count)
    volumes = volume / stable
    found = DivisionResult(
        scene,
        made.name,
        stable,
        tuple(n for n in requested if n > max_count),
        max_count,
        best,
        force,
        made.limit(volumes),
        made.radius(volumes, stable.astype(float)),
        None if made.meniscus is None else made.meniscus(volumes, stable.astype(float)),
        None if made.viscous is None else made.viscous(volumes, stable.astype(float)),
    )
    for array in astuple(found, recurse=False):
        if isinstance(array, np.ndarray):
            array.flags.writeable = False
    return found


def _listed(kind: type[SeparationForce], force: Floats | None) -> Floats:
    """Return a force, or refuse one that the scene does not list."""
    if force is None:
        raise NotSimulatedError(
            f"the scene does not call for it: add {kind.__name__}() to its effects"
        )
    return force


def _volume(scene: SeparationScene) -> float:
    volume = scene.meniscus.volume
    if volume is None:
        raise PlanError("a division needs interface.meniscus.volume [m3]: what is to be divided")
    return volume


def _requested(counts: Sequence[int] | None, max_count: int) -> list[int]:
    if counts is None:
        return sorted({round(x) for x in np.geomspace(1.0, max_count, 61)})
    for n in counts:
        if isinstance(n, bool) or int(n) != n or n < 1:
            raise DescriptionError(
                "divide_meniscus(n_menisci)", n, "hold whole numbers of at least 1"
            )
    return [int(n) for n in counts]


def _best(law: DivisionLaw, volume: float, max_count: int) -> tuple[int, float]:
    """Number with the minimum total force, by a coarse search refined near the minimum."""
    low, high = 1, max_count
    while True:
        count = high - low + 1
        if count <= _AT_ONCE:
            tried = np.arange(low, high + 1)
        else:
            tried = np.unique(np.round(np.geomspace(low, high, _AT_ONCE)).astype(np.int64))
        total = law.total(volume / tried, tried.astype(float))
        at = int(np.argmin(total))
        if count <= _AT_ONCE:
            return int(tried[at]), float(total[at])
        low, high = int(tried[max(at - 1, 0)]), int(tried[min(at + 1, len(tried) - 1)])


@frozen
class CriticalMeniscus:
    """Meniscus of equal meniscus and viscous force; above its area the viscous force dominates.

    `area` is volume over gap [m2], `force` either force [N], `law` the one they follow.
    """

    law: Name
    area: float
    volume: float
    force: float


def critical_meniscus(scene: SeparationScene, *, law: Name | None = None) -> CriticalMeniscus:
    """Size at which meniscus and mean viscous force of one film between flats are equal.

    Parameters
    ----------
    scene, law
        As in `divide_meniscus`; the volume of the scene is ignored.

    Raises
    ------
    InfeasibleError
        If the meniscus repels, or the viscous force dominates for every stable bridge.

    Examples
    --------
    >>> import math
    >>> import contactkit as ck
    >>> water = ck.Liquid(name="water", surface_tension=0.072, viscosity=0.89e-3)
    >>> film = ck.Meniscus(
    ...     liquid=water, contact_angle_lower=math.pi / 3, contact_angle_upper=math.pi / 3)
    >>> scene = ck.SeparationScene(
    ...     interface=ck.Interface(meniscus=film),
    ...     loading=ck.ImposedTime(initial_gap=2e-9, final_gap=1e-3, time=1e-7),
    ...     effects=(ck.MeniscusForce(), ck.ViscousForce()))
    >>> round(critical_meniscus(scene, law="as-published").area * 1e12, 4)
    0.0694
    """
    check_scene(scene, SeparationScene)
    gap = scene.loading.initial_gap
    made = law_of(scene, law, gap**3 if gap > 0.0 else 1.0)
    meniscus, viscous = made.demand(MeniscusForce), made.demand(ViscousForce)
    one = np.asarray(1.0)

    def excess(log: float) -> float:
        volume = np.asarray(math.exp(log))
        return float(viscous(volume, one) / meniscus(volume, one)) - 1.0

    least = math.log(gap**3) - 3.0 * math.log(float(made.limit(np.asarray(gap**3))) / gap)
    low = least + 1e-3
    high = max(low, math.log(gap**3)) + 1.0
    film = scene.meniscus
    if math.cos(film.contact_angle_lower) + math.cos(film.contact_angle_upper) < -1e-12:
        # Attractive only near rupture, which is not a size to compare at.
        raise InfeasibleError("the meniscus repels: there is no size at which it balances the film")
    if excess(low) > 0.0:
        raise InfeasibleError(
            "the viscous force is the larger one for every bridge that spans the initial gap; give "
            "a longer time or a larger gap"
        )
    while excess(high) < 0.0:
        low, high = high, high + 2.0
    volume = math.exp(bracketed_root(excess, low, high, 1e-13))
    force = float(meniscus(np.asarray(volume), one))
    return CriticalMeniscus(made.name, volume / gap, volume, force)
