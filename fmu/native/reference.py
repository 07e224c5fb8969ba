"""Reference results of a film: the motion of its scene by `ck.simulate`, put into its FMU.

The references are no run of the FMU. A native one has tables and a kernel of its own in C; what it
is held against are the laws and the steps of the scene in Python.
"""

from __future__ import annotations

import math
import warnings
from collections.abc import Mapping
from itertools import pairwise
from pathlib import Path
from typing import NamedTuple

from attrs import evolve

from ...accuracy import Accuracy
from ...errors import DescriptionError, PlanError
from ...reading.archives import checked_archive, member
from ...reading.xml_elements import read_xml
from ...scene.loading import ImposedForce
from ...scene.scenes import SeparationScene
from ...separation.deforming.effects import ElasticBodies
from ...separation.effects.prepared import prepare_scene
from ...separation.motion.advance import advance
from ...separation.motion.state import MotionState, Outputs, Pull, outputs, start
from ...separation.motion_curves import pull_law
from ...separation.plan import Plan, plan
from ...separation.simulate import simulate
from ..contents.packing import write_archive
from ..contents.references import ReferenceRun, reference_files
from ..slaves.rheology import is_rheological, with_rheology
from .film import moving
from .ports import Model, start_of

__all__ = ["add_reference", "reference_run"]

_EXACT = Accuracy(time_rtol=1e-10)
_STEPS = 100  # a table of 20 kB
_BEYOND = 1.001  # of the time of the release, which is part of the run; beyond, a spring swings
_SAME = 1e-9  # relative difference of start values that are one
# Relative; 30 and 80 times the largest differences measured: 3e-7 of tilted faces, 1.2e-5 of a film
# that cavitates on a grid, in which native and Python step differently. Of a rheology both have
# tables: 2e-5, 7e-4 at the kink of a power law.
_TOLERANCE = 1e-5
_ROUGH = 1e-3


def add_reference(fmu: Path, scene: SeparationScene, run: ReferenceRun) -> None:
    """Put reference results into the FMU of a scene, native or not, by FMI-LS-REF.

    Parameters
    ----------
    fmu : Path
        The FMU; it is written again.
    scene : SeparationScene
        Scene it was built from.
    run : ReferenceRun
        What `reference_run` makes of the scene.

    Raises
    ------
    DescriptionError
        If the FMU has other start values than the scene, or lacks a variable of the results.
    """
    with fmu.open("rb") as file, checked_archive(file, str(fmu)) as packed:
        files = {name: member(packed, name, "BYTES", str(fmu)) for name in packed.namelist()}
    described = _variables(files["modelDescription.xml"], str(fmu))
    _check_start(described, scene)
    missing = {*run.stimuli, *run.references} - {"time", *described}
    if missing:
        expected = f"have the variables {', '.join(sorted(missing))} of the reference results"
        raise DescriptionError("FMU", str(fmu), expected)
    write_archive(files | reference_files(run), fmu)


def reference_run(
    scene: SeparationScene, model: Model = "stiction-mass", *, film_rtol: float | None = None
) -> ReferenceRun:
    """Motion of a scene to its release in equal steps, as an experiment with an FMU.

    A ``stiction-mass`` is given the pull, a ``stiction-force`` gap and speed.

    Parameters
    ----------
    scene : SeparationScene
        With a mass, and the pull that moves it.
    model : {"stiction-mass", "stiction-force"}
        Model of the FMU.
    film_rtol : float, optional
        That of `build.build_native`.

    Raises
    ------
    PlanError
        If the scene does not move a mass by a pull, bodies deform, or a film whose cavity is
        remembered has no mass: its impulse follows the way within a step.
    """
    loading = scene.loading
    if not isinstance(loading, ImposedForce) or loading.force <= 0.0:
        raise PlanError(
            "reference results of a film need a pull that moves the mass: give the scene "
            'kind = "imposed-force" with a force above 0 N'
        )
    if scene.effect(ElasticBodies) is not None:
        raise PlanError(
            "there are no reference results of bodies that deform: their film in the FMU has rings "
            "of its own; leave out --reference"
        )
    accuracy = _EXACT if film_rtol is None else evolve(_EXACT, film_rtol=film_rtol)
    made = plan(with_rheology(scene), accuracy)
    remembers = made.film.cavity is not None
    if remembers and model == "stiction-force":
        raise PlanError(
            "there are no reference results of a stiction-force whose film remembers its cavity, "
            "as it moves at the mean speed of a step; take stiction-mass, or leave out --reference"
        )
    points = _motion(made)
    stimuli = _pulls if model == "stiction-mass" else _motions
    references = _of_mass if model == "stiction-mass" else _of_film
    return ReferenceRun(
        name="pull" if model == "stiction-mass" else "motion",
        description="Motion under the pull of the scene to its release, computed by the monolithic "
        "model of contactkit in Python",
        stop_time=points[-1].time,
        step=points[1].time,
        stimuli=stimuli(points),
        references=references(points),
        tolerance=_ROUGH if remembers or is_rheological(scene) else _TOLERANCE,
    )


class _Point(NamedTuple):
    """State at a communication point, its forces, and the pull of the step that begins there."""

    time: float
    state: MotionState
    shown: Outputs
    pull: Pull


def _motion(made: Plan) -> list[_Point]:
    """Motion in equal steps to just after its release, or to where it ends without one."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # the range of validity was stated when the FMU was built
        end = float(simulate(made, throw=False).time[-1])
    if not end > 0.0:
        raise PlanError(
            "the pull of the scene does not move the mass: raise loading.force [N], or leave out "
            "--reference"
        )
    times = [_rounded_up(_BEYOND * end) * k / _STEPS for k in range(_STEPS + 2)]
    pull = pull_law(made)
    state, found = start(made), list[_Point]()
    for time, after in pairwise(times):
        law = Pull(pull(time), (pull(after) - pull(time)) / (after - time), time)
        found.append(_Point(time, state, outputs(made, state, law(time)), law))
        if len(found) <= _STEPS:
            state = advance(made, state, law, after - state.time)
    return found


def _rounded_up(time: float) -> float:
    """Time with three digits that is not less.

    Examples
    --------
    >>> _rounded_up(0.03289), _rounded_up(7.0e-9)
    (0.0329, 7e-09)
    """
    power = math.floor(math.log10(time)) - 2
    return float(f"{math.ceil(round(time / 10.0**power, 9))}e{power}")


def _times(points: list[_Point]) -> list[float]:
    return [one.time for one in points]


def _pulls(points: list[_Point]) -> dict[str, list[float]]:
    return {
        "time": _times(points),
        "F_ext": [one.pull.force for one in points],
        "dF_ext": [one.pull.rate for one in points],
    }


def _motions(points: list[_Point]) -> dict[str, list[float]]:
    """Gap and speed at the end of the step that begins at a time."""
    ends = [*points[1:], points[-1]]
    return {
        "time": _times(points),
        "h": [one.state.gap for one in ends],
        "v": [one.state.speed for one in ends],
    }


def _forces(points: list[_Point]) -> dict[str, list[float]]:
    return {
        "F": [one.shown.film for one in points],
        "F_m": [one.shown.static for one in points],
        "F_v": [one.shown.viscous for one in points],
    }


def _of_mass(points: list[_Point]) -> dict[str, list[float]]:
    return {
        "time": _times(points),
        "h": [one.state.gap for one in points],
        "v": [one.state.speed for one in points],
        **_forces(points),
        "J": [one.state.impulses.get("viscous_impulse", 0.0) for one in points],
        "W": [one.state.dissipated_work for one in points],
    }


def _of_film(points: list[_Point]) -> dict[str, list[float]]:
    """Forces from the end of the first step on: before it hosts differ in what is set."""
    return {"time": _times(points)[1:], **_forces(points[1:])}


def _variables(text: bytes, where: str) -> Mapping[str, str | None]:
    """Start values of the variables of an FMU by name, of FMI 2.0 and 3.0."""
    variables = read_xml(text, f"{where}, modelDescription.xml").find("ModelVariables")
    found: dict[str, str | None] = {}
    for node in () if variables is None else variables:
        inner = next(iter(node), None)  # where FMI 2.0 has type and start
        start_text = node.get("start") or (None if inner is None else inner.get("start"))
        found[node.get("name", "")] = start_text
    return found


def _check_start(described: Mapping[str, str | None], scene: SeparationScene) -> None:
    """Refuse an FMU that starts from other values than the scene."""
    model: Model = "stiction-mass" if "h_rel" in described else "stiction-force"
    for name, value in start_of(prepare_scene(moving(scene, None)), model).items():
        text = described.get(name)
        if text is None:
            continue
        size = max(abs(float(text)), abs(float(value)))
        if abs(float(text) - float(value)) > _SAME * size:
            raise DescriptionError(
                f"{name} of the FMU",
                float(text),
                f"be that of the scene, {float(value):g}, of which the reference results are",
                hint="set it in the scene",
            )
