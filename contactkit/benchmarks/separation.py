"""Work and precision of a separation under an imposed force: error of the release time."""

from __future__ import annotations

import warnings
from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING

from attrs import evolve

from ..accuracy import Accuracy
from ..errors import PlanError, ValidityWarning
from ..scene.loading import ImposedForce
from ..scene.scenes import SeparationScene
from ..separation.effects.base import SeparationEffect
from ..separation.effects.meniscus import AsPublished, MeniscusForce
from ..separation.effects.rupture import Rupture
from ..separation.plan import plan
from ..work_precision import Outcome, Setting, WorkPrecision, sweep

if TYPE_CHECKING:
    from ..models.injector.monolithic import Drive

__all__ = [
    "TOLERANCES",
    "monolithic_release",
    "other_menisci",
    "separation_sweep",
    "with_effect",
]

Progress = Callable[[float], None]

TOLERANCES = (1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9)
"""Relative tolerances of time that are compared."""


def separation_sweep(scene: SeparationScene, progress: Progress) -> WorkPrecision:
    """Error of the release time of a pull over the tolerance of time, against another solver."""
    if not isinstance(scene.loading, ImposedForce) or scene.loading.mass is None:
        raise PlanError(
            "cost needs a scene with loading.force [N] and loading.mass [kg]: a curve at an "
            "imposed speed or time is closed form and costs microseconds"
        )
    from ..separation.motion_curves import pull_law

    made = plan(scene)
    end = 1.001 * _release(scene, 1e-8).value
    pull = pull_law(made)
    exact, near = (monolithic_release(scene, pull, end, rtol) for rtol in (1e-11, 1e-9))
    settings = [
        Setting("contactkit motion", f"rtol {rtol:.0e}", partial(_release, scene, rtol))
        for rtol in TOLERANCES
    ]
    settings += [
        Setting(
            "monolithic, scipy Radau",
            f"rtol {rtol:.0e}",
            partial(monolithic_release, scene, pull, end, rtol),
        )
        for rtol in TOLERANCES[1::2]
    ]
    settings += [
        Setting(name, f"rtol {rtol:.0e}", partial(_release, other, rtol), is_model=True)
        for name, other in other_menisci(scene).items()
        for rtol in TOLERANCES[::3]
    ]
    floor = max(abs(near.value / exact.value - 1.0), 1e-14)
    return sweep(settings, exact.value, quantity="release time", floor=floor, progress=progress)


def _release(scene: SeparationScene, rtol: float) -> Outcome:
    from ..separation.simulate import simulate

    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ValidityWarning)
        result = simulate(plan(scene, Accuracy(time_rtol=rtol)))
    if result.status != "released" or not result.has_motion:
        raise PlanError(f"cost needs a scene that is released; {result.message}")
    counts = {"steps": result.work.n_steps, "evaluations": result.work.n_evaluations}
    return Outcome(result.state.release_time, counts)


def monolithic_release(film: SeparationScene, pulled_by: Drive, end: float, rtol: float) -> Outcome:
    """First release of film and drive, solved monolithically."""
    from ..models.injector.monolithic import simulate

    found = simulate(plan(film), pulled_by, end, rtol=rtol)
    counts = {"steps": found.n_steps, "evaluations": found.n_evaluations}
    return Outcome(found.cycles[0].release_time, counts)


def with_effect(scene: SeparationScene, new: SeparationEffect) -> SeparationScene:
    """Scene with an effect in place of the one of its kind."""
    effects = tuple(new if type(e) is type(new) else e for e in scene.effects)
    return evolve(scene, effects=effects)


def other_menisci(scene: SeparationScene) -> dict[str, SeparationScene]:
    """Scenes with the models of the meniscus that are cheaper than the one of this scene."""
    profile = next((e.form for e in scene.effects if isinstance(e, MeniscusForce)), None)
    found = {}
    if profile == "exact":
        found["meniscus as an arc"] = with_effect(scene, MeniscusForce(profile="arc"))
    if profile in ("exact", "arc") and scene.interface.is_flat:
        # The disc is what the law of the FMUs has.
        printed = with_effect(scene, MeniscusForce(profile=AsPublished(radius="disc")))
        if any(isinstance(e, Rupture) and isinstance(e.gap, str) for e in scene.effects):
            printed = with_effect(printed, Rupture(gap="zero-neck"))  # its own, never mixed
        found["published meniscus, Eq. (3.11)"] = printed
    return found
