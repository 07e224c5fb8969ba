"""Stiction of deforming bodies with a meniscus: pull-off force over time of rest and humidity."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, ClassVar

import numpy as np
from attrs import evolve, field, frozen

from ...accuracy import Accuracy
from ...arguments import positive_values
from ...errors import PlanError
from ...scene.curve import Curve, Shown
from ...scene.loading import PressAndPull
from ...scene.plan import check_scene
from ...scene.scenes import SeparationScene
from ...separation.deforming.plan import plan_deforming
from ...separation.deforming.run import pull_apart
from ...units import si

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

__all__ = ["StictionTable", "stiction_table"]


@frozen(eq=False)
class StictionTable(Curve):
    """Stiction over time of rest and humidity: a row for each pair, humidities within rests.

    Attributes
    ----------
    rest, relative_humidity : ndarray, shape (n,)
        Time of rest [s] and relative humidity [-].
    pull_off_force, largest_contact_force : ndarray, shape (n,)
        Largest pull, and largest force of the asperities [N].
    force_error : ndarray, shape (n,)
        Error of the force over its largest [-].
    """

    axis: ClassVar[str] = "rest"
    shown: ClassVar[Shown] = {
        "over_rest": (("pull_off_force",), "rest"),
        "over_humidity": (("pull_off_force",), "relative_humidity"),
    }
    title: ClassVar[str] = "stiction over time of rest and humidity"

    rest: Floats = field(repr=False, metadata=si("s"))
    relative_humidity: Floats = field(repr=False, metadata=si("-"))
    pull_off_force: Floats = field(repr=False, metadata=si("N"))
    largest_contact_force: Floats = field(repr=False, metadata=si("N"))
    force_error: Floats = field(repr=False, metadata=si("-"))


def stiction_table(
    scene: SeparationScene,
    rests: Sequence[float | str] | Floats,
    humidities: Sequence[float | str] | Floats,
    accuracy: Accuracy | None = None,
) -> StictionTable:
    """Pull-off force after each time of rest at each humidity.

    Parameters
    ----------
    scene : SeparationScene
        With `ElasticBodies`, `SolidContact`, `MeniscusForce` and `PressAndPull`; its rest and the
        amount of its liquid are replaced.
    rests, humidities : sequence of float
        Times of rest [s] and relative humidities, below 1 [-].
    accuracy : Accuracy, optional
        As of `ck.plan`.

    Raises
    ------
    PlanError
        If the loading is no `PressAndPull`.
    DescriptionError
        If a value is not positive.

    Notes
    -----
    The liquid is that of the meniscus at `initial_gap` in equilibrium with the vapour, and stays
    that while the bodies are pressed and pulled: no liquid condenses during the rest. A pair takes
    2 to 6 s of CPU.
    """
    check_scene(scene, SeparationScene)
    loading = scene.loading
    if not isinstance(loading, PressAndPull):
        raise PlanError("stiction_table needs loading = PressAndPull(...), with a rest")
    rows = []
    for rest in positive_values("stiction_table(rests)", rests, "s"):
        for humidity in positive_values("stiction_table(humidities)", humidities, "-"):
            moist = evolve(
                scene.meniscus, volume=None, pressure=None, relative_humidity=float(humidity)
            )
            made = evolve(
                scene,
                interface=evolve(scene.interface, meniscus=moist),
                loading=evolve(loading, rest=float(rest)),
            )
            numbers = pull_apart(plan_deforming(made, accuracy)).numbers
            found = (numbers[n] for n in ("pull_off_force", "largest_contact_force", "force_error"))
            rows.append((rest, humidity, *found))
    return StictionTable(*np.array(rows, dtype=np.float64).T.copy())
