"""Outcomes of runs: the columns and numbers that a fit compares, of any scene or device."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from contextlib import suppress
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from attrs import frozen, has

from ..accuracy import Accuracy
from ..errors import DescriptionError, nearest
from ..planning import plan, run
from ..scene.answer import Answer
from ..scene.curve import Curve
from ..scene.result import Result
from ..scene.scenes import ContactScene, Scene

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

__all__ = ["Outcome", "Solve", "branch_of", "outcome_of", "solver_of", "stated_error"]

Solve = Callable[[Any], Any]
"""Takes a scene; returns a result or a curve, numbers by name with their units, or a number."""

# Relative error of a number of a function or of a device, whose accuracy is not known here: that of
# a motion at the standard setting, times ten.
_UNKNOWN_ERROR = 1e-7
# Error of an extreme or a time of a motion over the tolerance of a time step (see Accuracy).
_OF_STEPS = 10.0


class Outcome(NamedTuple):
    """Columns and numbers by name, their units, and what the run states of its models."""

    found: Mapping[str, Any]
    units: Mapping[str, str]
    validity: tuple[Any, ...]
    sources: tuple[str, ...]


@frozen
class _PlanAndRun:
    """Runs the plan of a scene."""

    accuracy: Accuracy

    def __call__(self, scene: Any) -> Any:
        return run(plan(scene, self.accuracy))


def _reported(scene: Any) -> Any:
    """Numbers of the report of a device."""
    return scene.report.run(scene, None, lambda done: None).scalars


def solver_of(scene: Any, accuracy: Accuracy, solve: Solve | None) -> Solve:
    """Return the function that runs a scene: the given one, its plan, or the report of a device."""
    if not has(type(scene)):
        raise DescriptionError("scene", scene, "be a scene, or that of a device")
    if solve is not None:
        return solve
    if isinstance(scene, Scene):
        return _PlanAndRun(accuracy)
    if hasattr(scene, "report"):
        return _reported
    expected = "be a scene or a device; for anything else give solve=, a function of it"
    raise DescriptionError("scene", scene, expected)


def outcome_of(answer: Any, names: Iterable[str]) -> Outcome:
    """Columns and numbers of some names.

    Raises
    ------
    DescriptionError
        If one does not exist, or is no number.
    """
    found, units = dict[str, Any](), dict[str, str]()
    for name in names:
        found[name], units[name] = _one(answer, name)
    sources = answer.cite().splitlines() if isinstance(answer, Answer) else ()
    if isinstance(answer, Result):
        sources = answer.plan.cite().splitlines()
    return Outcome(found, units, getattr(answer, "validity", ()), tuple(sources))


def _one(answer: Any, name: str) -> tuple[Any, str]:
    """A column or a number, and its unit; a function that returns a number has one of any name."""
    if isinstance(answer, int | float | np.floating):
        return float(answer), "-"
    if isinstance(answer, Answer):
        numbers: Mapping[str, tuple[Any, str]] = answer.scalars()
        columns: Iterable[str] = ()
        if isinstance(answer, Result):
            columns = answer.columns
        elif isinstance(answer, Curve):
            columns = answer.table()
        if name in columns and isinstance(answer, Result | Curve):
            return np.array(answer[name], dtype=np.float64), answer.unit(name)
        if name not in numbers and isinstance(answer, Result):
            with suppress(DescriptionError):
                answer[name]  # refused with the effect to add, where one would give it
    elif isinstance(answer, Mapping):
        numbers, columns = answer, ()
    else:
        expected = "return a result, a curve, numbers by name with their units, or a number"
        raise DescriptionError("solve", answer, expected)
    if name not in numbers:
        hint = nearest(name, [*columns, *numbers])
        raise DescriptionError("quantity", name, "be a column or a number of the result", hint=hint)
    value, unit = numbers[name]
    if isinstance(value, str | bool):
        raise DescriptionError("quantity", name, "be a number", hint=f"it is {value!r}")
    found = np.array(value, dtype=np.float64)
    return (found if found.ndim else float(found)), unit


def branch_of(x: Floats, branch: str | None, name: str) -> slice:
    """Points of a curve whose axis only rises or only falls; the longest such part.

    Raises
    ------
    DescriptionError
        If the axis turns back and no branch is chosen, or never goes in the direction chosen.

    Examples
    --------
    >>> branch_of(np.array([3.0, 1.0, 2.0, 5.0]), "rising", "gap")
    slice(1, 4, None)
    """
    steps = np.sign(np.diff(x))
    moving = np.flatnonzero(steps)
    if branch is None:
        if moving.size and np.any(steps[moving] != steps[moving[0]]):
            hint = "choose the branch of the curve: branch='rising' or 'falling'"
            raise DescriptionError("over", name, "be an axis that does not turn back", hint=hint)
        return slice(0, x.size)
    wanted = 1.0 if branch == "rising" else -1.0
    ends, begun = list[tuple[float, int, int]](), None
    for i, step in enumerate([*steps, -wanted]):
        if step == wanted and begun is None:
            begun = i
        if step == -wanted and begun is not None:
            last = min(i, x.size - 1)
            ends.append((abs(float(x[last] - x[begun])), begun, last + 1))
            begun = None
    if not ends:
        raise DescriptionError(
            "branch", branch, f"be a part of the run, whose {name} never does so"
        )
    _, first, end = max(ends)
    return slice(first, end)


def stated_error(scene: Any, accuracy: Accuracy, values: Any, is_column: bool) -> float:
    """Error of a column or a number by the settings of its run, in its unit.

    Columns of a separation: `curve_rtol` of their range; numbers of it ten times `time_rtol`; those
    of a contact the tolerance of its outer iterations, without that of its grid, which is the same
    for all values of the parameters.
    """
    size = float(np.max(np.abs(values), initial=0.0))
    if isinstance(scene, ContactScene):
        return accuracy.outer_rtol * size
    if not isinstance(scene, Scene):
        return _UNKNOWN_ERROR * size
    if is_column:
        return accuracy.curve_rtol * float(np.ptp(values)) if np.size(values) else 0.0
    return _OF_STEPS * accuracy.time_rtol * size
