"""Work-precision: error, operation counts and seconds over a set of settings."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from time import process_time

from attrs import field, frozen

from .errors import ContactkitError, InfeasibleError

__all__ = ["Outcome", "Point", "Setting", "WorkPrecision", "sweep"]


@frozen
class Outcome:
    """Value computed by one run, and its operation counts.

    `error` is the relative error where it is not that of a single number, such as the norm of
    the error of a map.
    """

    value: float
    counts: Mapping[str, int] = field(factory=dict)
    error: float | None = None


@frozen
class Setting:
    """One method (a line of the figure) with one setting, and the function that runs it."""

    method: str
    label: str
    run: Callable[[], Outcome]
    is_model: bool = False  # a modelling error, which does not fall with the setting


@frozen
class Point:
    """Error and cost of one setting; error and seconds are nan where it failed."""

    method: str
    label: str
    error: float
    seconds: float
    counts: Mapping[str, int]
    problem: str = ""
    is_model: bool = False


@frozen
class WorkPrecision:
    """Errors and costs of a sweep; errors are relative to a reference of known accuracy.

    `judge` names the reference where it is not one number.
    """

    quantity: str
    reference: float
    floor: float
    points: tuple[Point, ...]
    judge: str = ""

    def cheapest(self, error: float) -> Point:
        """Return the fastest setting with at most this relative error, models excluded.

        Raises
        ------
        InfeasibleError
            If no setting is that accurate; the message names the best one.
        """
        good = [p for p in self.points if p.error <= error and not p.is_model]
        if not good:
            sound = [p for p in self.points if p.error == p.error and not p.is_model]
            best = min(sound, key=lambda p: p.error)
            raise InfeasibleError(
                f"no setting reaches an error of {error:g}; the best is {best.error:.2g} by "
                f"{best.method}, {best.label}"
            )
        return min(good, key=lambda p: p.seconds)

    def table(self) -> str:
        """Return the points as text, one per line."""
        head = f"{'method':34s} {'setting':16s} {'error':>9s} {'seconds':>9s}  counts"
        rows = [head]
        for p in self.points:
            counts = ", ".join(f"{k} {v}" for k, v in p.counts.items())
            error = f"{p.error:9.1e}" if math.isfinite(p.error) else "   failed"
            if p.error > 1.0:
                counts += "  WRONG: plausible, and not a solution"
            rows.append(
                f"{p.method:34s} {p.label:16s} {error} {p.seconds:9.4f}  {p.problem or counts}"
            )
        rows.append("seconds: CPU time of the process, the least where a setting ran repeatedly")
        rows.append(
            f"relative error of the {self.quantity} against "
            f"{self.judge or f'{self.reference:.10g}'}, known to {self.floor:.0e}"
        )
        return "\n".join(rows)


def sweep(
    settings: Sequence[Setting],
    reference: float,
    *,
    quantity: str,
    floor: float,
    repeats: int = 5,
    budget: float = 2.0,
    progress: Callable[[float], None] | None = None,
) -> WorkPrecision:
    """Run and time every setting.

    Parameters
    ----------
    settings : sequence of Setting
        Settings to run. Each runs once untimed, then up to `repeats` times within `budget` [s];
        the least CPU time of the process counts. With no repeats, or where it takes
        longer than the budget, the first run counts.
    reference : float
        Reference value, from a closed form or a method other than those compared.
    quantity : str
        Name of the quantity.
    floor : float
        Relative error of the reference itself; errors below it are not significant.
    """
    points = []
    for i, setting in enumerate(settings):
        points.append(_measure(setting, reference, repeats, budget))
        if progress is not None:
            progress((i + 1) / len(settings))
    return WorkPrecision(quantity, reference, floor, tuple(points))


def _measure(setting: Setting, reference: float, repeats: int, budget: float) -> Point:
    begun = process_time()
    try:
        outcome = setting.run()
    except ContactkitError as problem:
        reason = str(problem).split(";")[0]
        return Point(
            setting.method, setting.label, math.nan, math.nan, {}, reason, setting.is_model
        )
    warm = process_time() - begun
    best = warm if repeats == 0 or warm > budget else math.inf
    for _ in range(repeats if warm <= budget else 0):
        start = process_time()
        if start - begun + min(best, warm) > budget and best < math.inf:
            break
        setting.run()
        best = min(best, process_time() - start)
    error = outcome.error
    if error is None:
        error = abs(outcome.value / reference - 1.0)
    return Point(
        setting.method, setting.label, error, best, dict(outcome.counts), is_model=setting.is_model
    )
