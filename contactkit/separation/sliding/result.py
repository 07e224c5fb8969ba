"""What a sliding gives: forces over the travel, numbers, and how well they can be trusted."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any

from attrs import field, frozen

from ...errors import DescriptionError, NotSimulatedError
from ..columns import COLUMNS
from ..effects.base import SeparationEffect
from ..results import Work
from ..validity import ValidityNumber
from .effects import SLIDING_EFFECTS, ContactAngleHysteresis, CouetteForce
from .plan import SlidingPlan

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from ...as_published.arguments import PublishedValue

    Curve = NDArray[np.float64]

__all__ = ["CouettePart", "HysteresisPart", "SlidingResult"]

_BY_NAME = {column.name: column for column in COLUMNS}
_OWNERS: dict[str, type[SeparationEffect]] = {
    "couette_force": CouetteForce,
    "couette_impulse": CouetteForce,
    "hysteresis_force": ContactAngleHysteresis,
}
_NEEDS_SPEED = ("time", "speed", "couette_force", "tangential_force", "tangential_impulse")


@frozen(eq=False)
class SlidingResult:
    """Curves and numbers of one sliding.

    Attributes
    ----------
    plan : SlidingPlan
        What was run.
    status : str
        ``parted`` where the wetted circles no longer overlap at the end, else ``curve``.
    message : str
        The same as a sentence.
    columns : mapping of str to ndarray
        The curves, by the names of `COLUMNS`; read-only. Forces are those of all menisci.
    totals : mapping of str to float
        Impulses [N.s] and work [J] over the whole slide.
    validity : tuple of ValidityNumber
        Whether the models were inside their ranges.
    work : Work
        What it cost.
    """

    plan: SlidingPlan = field(repr=False)
    status: str
    message: str
    columns: Mapping[str, Curve] = field(repr=False)
    totals: Mapping[str, float] = field(repr=False)
    validity: tuple[ValidityNumber, ...] = field(repr=False)
    work: Work

    def __getattr__(self, name: str) -> Curve:
        if name not in _BY_NAME:
            raise AttributeError(f"SlidingResult has no {name!r}")
        return self.curve(name)

    def curve(self, name: str) -> Curve:
        """Return a curve by its name in `COLUMNS`.

        Raises
        ------
        NotSimulatedError
            If this run did not simulate it; the message says what to add.
        """
        if name in self.columns:
            return self.columns[name]
        if name not in _BY_NAME:
            raise DescriptionError("curve", name, f"be one of {', '.join(_BY_NAME)}")
        if name in _OWNERS:
            self._demand(_OWNERS[name])
        if name in _NEEDS_SPEED:
            raise NotSimulatedError(
                f"no {_BY_NAME[name].label}: with time imposed it is not determined; impose "
                f"Sliding.speed to get it"
            )
        raise NotSimulatedError(
            f"no {_BY_NAME[name].label} in a sliding: it belongs to a SeparationScene"
        )

    def _demand(self, kind: type[SeparationEffect]) -> None:
        if not self.plan.has(kind):
            raise NotSimulatedError(
                f"the scene does not call for {kind.name}: add {kind.__name__}() to its effects"
            )

    def of(self, kind: type[SeparationEffect]) -> Any:
        """Return what an effect did: a `CouettePart` or a `HysteresisPart`.

        Raises
        ------
        NotSimulatedError
            If the scene does not call for the effect.
        """
        self._demand(kind)
        if kind not in SLIDING_EFFECTS:
            raise NotSimulatedError(
                f"{kind.__name__} has no curve of its own; see of(CouetteForce)"
            )
        return _PARTS[kind](self)

    @property
    def errata(self) -> tuple[PublishedValue, ...]:
        """Printed equations that the run takes, each with the right value; forces are means.

        Empty where nothing is taken as printed.
        """
        from ...as_published.lookup import published

        drag = self.plan.scene.effect(CouetteForce)
        if drag is None or drag.closure != "as-published":
            return ()
        scene, film = self.plan.scene, self.plan.film
        gap = scene.loading.gap
        given = {
            "gap": gap,
            "separation_time": self.duration,
            "viscosity": scene.meniscus.liquid.at(scene.temperature).viscosity,
        }
        if scene.interface.is_flat:
            one = published("3.53", radius=self.plan.wetted_radius, **given)
        else:
            shape = {"sphere_radius": film.sphere_radius, "film_height": film.height(gap)}
            one = published("3.56", **shape, **given)
        return (one._replace(name=f"couette-force, {one.name}, of one meniscus"),)

    @property
    def duration(self) -> float:
        """Time [s] the slide takes."""
        loading = self.plan.scene.loading
        if loading.time is not None:
            return loading.time
        assert loading.speed is not None  # exactly one of them is given
        return self.plan.end / loading.speed

    def scalars(self) -> dict[str, tuple[float, str]]:
        """Return the numbers of the run, each with its unit."""
        units = {"couette_impulse": "N.s", "tangential_impulse": "N.s"}
        found = {name: (value, units.get(name, "J")) for name, value in self.totals.items()}
        for name in ("couette", "tangential"):
            if f"{name}_impulse" in self.totals:
                mean = self.totals[f"{name}_impulse"] / self.duration
                found[f"mean_{name}_force"] = (mean, "N")
        if "tangential_force" in self.columns:
            found["peak_tangential_force"] = (float(self.columns["tangential_force"].max()), "N")
        return found | {
            "wetted_radius": (self.plan.wetted_radius, "m"),
            "break_travel": (self.plan.break_travel, "m"),
        }


@frozen(eq=False)
class CouettePart:
    """What the drag of the film did. Three different things keep three names.

    `force` is the instantaneous force [N] along the travel, `impulse` its time integral over the
    whole slide [N.s], `mean_force` that over the time the slide takes [N].
    """

    result: SlidingResult = field(repr=False)

    @property
    def force(self) -> Curve:
        """Instantaneous force [N]."""
        return self.result.curve("couette_force")

    @property
    def impulse(self) -> float:
        """Time integral of the force over the whole slide [N.s]."""
        return self.result.totals["couette_impulse"]

    def mean_force(self, time: float | None = None) -> float:
        """Time average [N] of the force over a slide that takes `time` [s]: impulse/time.

        Raises
        ------
        DescriptionError
            If the time is not positive.
        """
        time = self.result.duration if time is None else time
        if not time > 0.0:
            raise DescriptionError("mean_force(time)", time, "be positive", unit="s")
        return self.impulse / time


@frozen(eq=False)
class HysteresisPart:
    """What contact lines that stick did: their force [N] along the travel, and its work [J]."""

    force: Curve
    work: float


def _hysteresis_part(result: SlidingResult) -> HysteresisPart:
    return HysteresisPart(result.hysteresis_force, result.totals["hysteresis_work"])


_PARTS: dict[type[SeparationEffect], Callable[[SlidingResult], CouettePart | HysteresisPart]] = {
    CouetteForce: CouettePart,
    ContactAngleHysteresis: _hysteresis_part,
}
