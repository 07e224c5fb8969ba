"""Model of measured curves: runs of a scene, read at the positions of the instrument."""

from __future__ import annotations

import math
import warnings
from collections import OrderedDict
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from scipy.interpolate import PchipInterpolator

from ..accuracy import Accuracy
from ..errors import ContactkitError, DescriptionError, ValidityWarning
from ..studies.paths import axes, changed, check_apart, paths_of, read_value
from ..units import parse_unit
from .data import NUISANCES, MeasuredBound, MeasuredCurve
from .outcomes import Outcome, Solve, branch_of, outcome_of, stated_error
from .parameters import Parameter, by_path, nuisance_parameter

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

__all__ = ["Model", "Prediction"]

# Outcomes that are kept: those of a Jacobian by differences share their base and the runs of which
# only a nuisance differs.
_KEPT = 512
# Part of the range of a run beyond its ends that counts as its end: round-off of units.
_ROUND_OFF = 1e-9


class Prediction(NamedTuple):
    """Readings that a model predicts, numbers of the bounds, and their errors as stated."""

    readings: tuple[Floats, ...]
    numbers: tuple[float, ...]
    errors: tuple[float, ...]


class _Place(NamedTuple):
    """Where the nuisances of a curve are among the parameters, or their values."""

    sought: Mapping[str, int]
    fixed: Mapping[str, float]

    def value(self, name: str, values: Sequence[float]) -> float:
        return values[self.sought[name]] if name in self.sought else self.fixed[name]


class Model:
    """A scene with parameters, compared with curves and bounds.

    Parameters
    ----------
    scene, accuracy
        The scene or device, and the settings of its runs.
    solve : callable
        Runs a scene.
    sought : tuple of Parameter
        Fields of the scene that are sought; nuisances are added to them.
    data : (curves, bounds)
        What is compared.
    common : mapping
        Nuisances that all curves have in common.

    Raises
    ------
    DescriptionError
        If data and results do not fit together.
    ContactkitError
        If the scene has no result at the start.
    """

    def __init__(
        self,
        scene: Any,
        accuracy: Accuracy,
        solve: Solve,
        sought: tuple[Parameter, ...],
        data: tuple[tuple[MeasuredCurve, ...], tuple[MeasuredBound, ...]],
        common: Mapping[str, Any],
    ) -> None:
        self.scene, self.accuracy, self._solve = scene, accuracy, solve
        self.parameters, (self.curves, self.bounds) = sought, data
        curves, bounds = data
        self.n_runs = 0
        self._outcomes: OrderedDict[tuple[Any, ...], Outcome] = OrderedDict()
        self._known = set(paths_of(scene))
        self._data: list[MeasuredCurve | MeasuredBound] = [*curves, *bounds]
        self._sets = [self._read_sets(one) for one in self._data]
        self._paths = [self._path(curve) for curve in curves]
        self._names = self._grouped()
        self.units = self._units()
        self.deviations = [
            curve.deviation(unit) for curve, (_, unit) in zip(curves, self.units, strict=False)
        ]
        units = self.units[: len(curves)]
        self.parameters = sought + nuisance_parameters(curves, units, common)
        self._places = [self._place(*pair) for pair in zip(curves, units, strict=True)]
        self._check_springs()

    def _read_sets(self, one: MeasuredCurve | MeasuredBound) -> dict[str, Any]:
        """Fields that a curve was measured with, read as a scene file does."""
        origin = f"sets of {one.name!r}"
        own = [path for parameter in self.parameters for path in parameter.paths]
        if isinstance(one, MeasuredCurve) and one.over in self._known:
            own.append(one.over)
        check_apart([*one.sets, *own], origin)
        return {
            path: read_value(self.scene, self.accuracy, path, value, origin)
            for path, value in one.sets.items()
        }

    def _path(self, curve: MeasuredCurve) -> str:
        """Path of the scene that a curve is over; empty for a column."""
        return curve.over if curve.over in self._known else ""

    def _grouped(self) -> list[tuple[str, ...]]:
        """Names to read from the run of each curve and bound; those of one run together."""
        keys, names = [], dict[str, dict[str, None]]()
        for i, one in enumerate(self._data):
            path = self._paths[i] if i < len(self.curves) else ""
            keys.append(repr((path, sorted(self._sets[i].items()))))
            wanted = names.setdefault(keys[-1], {})
            wanted[one.quantity] = None
            if isinstance(one, MeasuredCurve) and not path:
                wanted[one.over] = None
        return [tuple(names[key]) for key in keys]

    def _units(self) -> list[tuple[str, str]]:
        """SI units of axis and quantity of each curve and bound, those of the data checked."""
        found, outcomes = [], self.outcomes([one.start for one in self.parameters])
        for one, outcome in zip(self._data, outcomes, strict=True):
            unit = outcome.units[one.quantity]
            if isinstance(one, MeasuredBound):
                found.append(("", unit))
                continue
            axis = outcome.units.get(one.over) or self._axis_unit(one)
            for i, known in enumerate((axis, unit)):
                _check_unit(f"MeasuredCurve({one.name}).units[{i}]", one.units[i], known)
            found.append((axis, unit))
        return found

    def _check_springs(self) -> None:
        """Refuse a spring between what is no force over a distance."""
        for place, curve, units in zip(self._places, self.curves, self.units, strict=False):
            has_spring = "stiffness" in place.sought or math.isfinite(place.fixed["stiffness"])
            if has_spring and (units != ("m", "N") or curve.over in self._known):
                hint = f"{curve.quantity} is in {units[1]}, {curve.over} in {units[0]}"
                expected = "belong to a column of a force [N] over one of a distance [m]"
                raise DescriptionError("stiffness", curve.stiffness, expected, hint=hint)

    def _place(self, curve: MeasuredCurve, units: tuple[str, str]) -> _Place:
        index = dict[str, int]()
        for i, one in enumerate(self.parameters):
            if not one.paths:
                owner, _, name = one.name.rpartition(".")
                if owner in ("", curve.name):
                    index[name] = i
        fixed = {n: curve.nuisance(n, units) for n in NUISANCES if n not in index}
        return _Place(index, fixed)

    def _axis_unit(self, curve: MeasuredCurve) -> str:
        """SI unit of the axis of a curve over a path."""
        return axes(self.scene, self.accuracy, {curve.over: [float(curve.x[0])]})[0].units[0]

    def changes(self, values: Sequence[float]) -> dict[str, Any]:
        """Values of the parameters that are fields of the scene, by path."""
        return dict(by_path(self.parameters, tuple(values)))

    def predict(self, values: Sequence[float]) -> Prediction:
        """Readings at the positions of the curves, and numbers of the bounds.

        Raises
        ------
        ContactkitError
            If a run is refused or has no solution, or ends before the data do.
        """
        base, readings, errors = self.changes(values), [], []
        for i, curve in enumerate(self.curves):
            found, error = self._curve(i, curve, base, values)
            readings.append(found)
            errors.append(error)
        numbers = []
        for j, bound in enumerate(self.bounds, len(self.curves)):
            numbers.append(self._number(base | self._sets[j], self._names[j], bound.quantity))
        return Prediction(tuple(readings), tuple(numbers), tuple(errors))

    def _curve(
        self, i: int, curve: MeasuredCurve, base: Mapping[str, Any], values: Sequence[float]
    ) -> tuple[Floats, float]:
        place, changes = self._places[i], {**base, **self._sets[i]}
        x = curve.x + place.value("shift", values)
        if self._paths[i]:
            ideal = np.array(
                [
                    self._number(changes | {self._paths[i]: at}, self._names[i], curve.quantity)
                    for at in x.tolist()
                ]
            )
            error = stated_error(self.scene, self.accuracy, ideal, False)
        else:
            outcome = self._outcome(changes, self._names[i])
            axis, column = _columns(outcome, curve)
            stiffness = place.value("stiffness", values)
            ideal = _read_off(axis, column, x, stiffness, curve)
            error = stated_error(self.scene, self.accuracy, column, True)
        scale = place.value("scale", values)
        return scale * ideal + place.value("zero", values), scale * error

    def slope(
        self, i: int, values: Sequence[float], predicted: Prediction
    ) -> tuple[Floats, ...] | None:
        """Exact derivative of the readings `predicted` to a parameter; None where it is not known.

        Known to zero and scale of a curve. A result that offers derivatives of its numbers to the
        fields of its scene is asked here, before differences are taken.
        """
        name = self.parameters[i].name.rpartition(".")[2]
        if self.parameters[i].paths or name not in ("zero", "scale"):
            return None
        found = []
        for place, readings in zip(self._places, predicted.readings, strict=True):
            if place.sought.get(name) != i:
                found.append(np.zeros_like(readings))
            elif name == "zero":
                found.append(np.ones_like(readings))
            else:
                zero, scale = place.value("zero", values), place.value("scale", values)
                found.append((readings - zero) / scale)
        return tuple(found)

    def _number(self, changes: Mapping[str, Any], names: tuple[str, ...], name: str) -> float:
        value = self._outcome(changes, names).found[name]
        if not isinstance(value, float):
            hint = "a column is compared over a column, such as over='gap'"
            raise DescriptionError("quantity", name, "be a number of the result", hint=hint)
        if math.isnan(value):
            at = ", ".join(f"{path} = {one!r:.40}" for path, one in changes.items())
            raise ContactkitError(f"the result has no {name} at {at}: the event did not occur")
        return value

    def _outcome(self, changes: Mapping[str, Any], names: tuple[str, ...]) -> Outcome:
        """Outcome of a run; those of before are kept."""
        key = (names, repr(sorted(changes.items())))
        if key not in self._outcomes:
            self.n_runs += 1
            self._outcomes[key] = self._run(changes, names)
            if len(self._outcomes) > _KEPT:
                self._outcomes.popitem(last=False)
        self._outcomes.move_to_end(key)
        return self._outcomes[key]

    def _run(self, changes: Mapping[str, Any], names: tuple[str, ...]) -> Outcome:
        scene = changed(self.scene, self.accuracy, changes).scene
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", ValidityWarning)  # the fit states the numbers itself
            return outcome_of(self._solve(scene), names)

    def limits(self) -> list[tuple[float, float, float]]:
        """Least, most and noise of each bound in the unit of its number."""
        units = self.units[len(self.curves) :]
        return [bound.ends(unit) for bound, (_, unit) in zip(self.bounds, units, strict=True)]

    def outcomes(self, values: Sequence[float]) -> list[Outcome]:
        """Outcome of the run of each curve and bound; over a path, of its first position."""
        base, found = self.changes(values), []
        for i, one in enumerate(self._data):
            changes = {**base, **self._sets[i]}
            if isinstance(one, MeasuredCurve) and self._paths[i]:
                changes[self._paths[i]] = float(one.x[0])
            found.append(self._outcome(changes, self._names[i]))
        return found


def nuisance_parameters(
    curves: Sequence[MeasuredCurve],
    units: Sequence[tuple[str, str]],
    common: Mapping[str, Any],
) -> tuple[Parameter, ...]:
    """Nuisances that all curves have in common, then those of each.

    Raises
    ------
    DescriptionError
        If one is not known, or is given twice.
    """
    found = []
    for name, given in common.items():
        if name not in NUISANCES:
            expected = f"be one of {', '.join(NUISANCES)}"
            hint = "fields of the scene belong into parameters"
            raise DescriptionError("nuisance", name, expected, hint=hint)
        for curve in curves:
            if name in curve.fitted:
                hint = f"leave it out of {curve.name!r}, or of nuisance="
                raise DescriptionError("nuisance", name, "be given once", hint=hint)
        known = {c.nuisance_unit(name, pair)[0] for c, pair in zip(curves, units, strict=True)}
        if len(known) > 1:
            hint = "their curves have other units: give it to each curve"
            raise DescriptionError("nuisance", name, "be of one unit", hint=hint)
        found.append(nuisance_parameter(name, known.pop(), given))
    for curve, pair in zip(curves, units, strict=True):
        prefix = f"{curve.name}." if len(curves) > 1 else ""
        for name, given in curve.fitted.items():
            unit, factor = curve.nuisance_unit(name, pair)
            found.append(nuisance_parameter(f"{prefix}{name}", unit, given, factor))
    return tuple(found)


def _check_unit(field: str, given: str, unit: str) -> None:
    """Refuse a unit of another dimension; a curve without one is in SI units."""
    if given and parse_unit(given).dimension != parse_unit(unit).dimension:
        raise DescriptionError(field, given, f"convert to {unit}, the unit of the result")


def _columns(outcome: Outcome, curve: MeasuredCurve) -> tuple[Floats, Floats]:
    axis, column = outcome.found[curve.over], outcome.found[curve.quantity]
    if isinstance(axis, float) or isinstance(column, float) or axis.shape != column.shape:
        one = curve.over if isinstance(axis, float) else curve.quantity
        hint = "numbers of a result are compared over a field of the scene, by its path"
        raise DescriptionError("curve", one, "be a column of the result", hint=hint)
    part = branch_of(axis, curve.branch, curve.over)
    return axis[part], column[part]


def _read_off(
    axis: Floats, column: Floats, x: Floats, stiffness: float, curve: MeasuredCurve
) -> Floats:
    """Column at the positions of the drive, which a spring connects with the body."""
    at = axis + column / stiffness
    rises = axis[-1] >= axis[0]
    at = at if rises else -at
    wanted = x if rises else -x
    # States behind the furthest so far are not stable: the spring jumps over them.
    reached = np.maximum.accumulate(at)
    stays = np.concatenate([[True], at[1:] > reached[:-1]])
    before = np.concatenate([stays[1:] & ~stays[:-1], [False]]) & ~stays  # last one before a jump
    at, column = _jumped(at, column, stays, before)
    low, high = float(at[0]), float(at[-1])
    margin = _ROUND_OFF * max(high - low, abs(high), abs(low))
    outside = (wanted < low - margin) | (wanted > high + margin)
    if outside.any() and curve.beyond == "refuse":
        sign = 1.0 if rises else -1.0
        data = f"{x.min():.6g} to {x.max():.6g}"
        ends = sorted((sign * low, sign * high))
        raise DescriptionError(
            f"MeasuredCurve({curve.name}).at",
            data,
            f"lie within the run, whose {curve.over} goes from {ends[0]:.6g} to {ends[1]:.6g}",
            hint="let the loading go further on both sides, by the range of shift as well; or "
            "beyond='hold'",
        )
    return _interpolated(at, column, np.clip(wanted, low, high))


def _jumped(
    at: Floats, column: Floats, stays: NDArray[np.bool_], before: NDArray[np.bool_]
) -> tuple[Floats, Floats]:
    """Stable states, with a second point at the position of each jump."""
    if stays.all():
        return at, column
    landed = np.flatnonzero(stays[1:] & ~stays[:-1]) + 1
    left = [int(np.flatnonzero(stays[:i])[-1]) for i in landed]
    values = column.copy()
    position = at.copy()
    for i, j in zip(landed, left, strict=True):
        # The state where the branch beyond reaches the position of the jump.
        part = (at[j] - at[i - 1]) / (at[i] - at[i - 1])
        values[i - 1] = column[i - 1] + part * (column[i] - column[i - 1])
        position[i - 1] = at[j]
    kept = stays | before
    return position[kept], values[kept]


def _interpolated(at: Floats, column: Floats, wanted: Floats) -> Floats:
    """Monotone cubic through the points of each piece between jumps; no overshoot at a kink."""
    breaks = np.flatnonzero(np.diff(at) <= 0.0) + 1
    found = np.empty_like(wanted)
    starts, ends = [0, *breaks], [*breaks, at.size]
    piece = (
        np.searchsorted(at[breaks], wanted, side="right")
        if len(breaks)
        else np.zeros(wanted.size, dtype=int)
    )
    for k, (first, end) in enumerate(zip(starts, ends, strict=True)):
        mine = piece == k
        if not mine.any():
            continue
        xs, ys = at[first:end], column[first:end]
        inside = np.clip(wanted[mine], xs[0], xs[-1])
        found[mine] = ys[0] if xs.size == 1 else PchipInterpolator(xs, ys)(inside)
    return found
