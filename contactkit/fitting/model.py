"""Model of measured curves: runs of a scene, read at the positions of the instrument."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from ..errors import ContactkitError, DescriptionError, nearest
from ..studies.paths import axes, check_apart, paths_of, read_value
from ..units import parse_scale, parse_unit
from .data import NUISANCES, MeasuredBound, MeasuredCurve
from .outcomes import Outcome, stated_error
from .parameters import Parameter, by_path, nuisance_parameter
from .read_off import ReadOff, read_off
from .runs import Asked, Run, Runs, Solver

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

__all__ = ["Model", "Prediction", "Slopes"]


class Prediction(NamedTuple):
    """Readings that a model predicts, numbers of the bounds, and their errors as stated."""

    readings: tuple[Floats, ...]
    numbers: tuple[float, ...]
    errors: tuple[float, ...]


class Slopes(NamedTuple):
    """Derivatives of a prediction to one parameter: of the readings, and of the bounds (n,)."""

    readings: tuple[Floats, ...]
    numbers: Floats

    @property
    def is_known(self) -> bool:
        """Whether all of them are known."""
        return all(np.isfinite(part).all() for part in (*self.readings, self.numbers))


class _Place(NamedTuple):
    """Where the nuisances of a curve are among the parameters, or their values."""

    sought: Mapping[str, int]
    fixed: Mapping[str, float]

    def value(self, name: str, values: Sequence[float]) -> float:
        return values[self.sought[name]] if name in self.sought else self.fixed[name]

    def with_gauge(self, rows: Floats, ideal: Floats) -> Floats:
        """Slopes with those to zero and scale, of the readings of an ideal instrument."""
        for name, slope in (("zero", 1.0), ("scale", ideal)):
            if name in self.sought:
                rows[self.sought[name]] = slope
        return rows


class Model:
    """A scene with parameters, compared with curves and bounds.

    Parameters
    ----------
    solver : Solver
        The scene or device, the settings of its runs, and how it is run.
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
        solver: Solver,
        sought: tuple[Parameter, ...],
        data: tuple[tuple[MeasuredCurve, ...], tuple[MeasuredBound, ...]],
        common: Mapping[str, Any],
    ) -> None:
        scene = solver.scene
        self.scene, self.accuracy, self.runs = scene, solver.accuracy, Runs(solver)
        self.parameters, (self.curves, self.bounds) = sought, data
        curves, bounds = data
        self._known = set(paths_of(scene))
        self._data: list[MeasuredCurve | MeasuredBound] = [*curves, *bounds]
        self._sets = [self._read_sets(one) for one in self._data]
        self._paths = [self._path(curve) for curve in curves]
        self._names = self._grouped()
        self.runs.n_together = sum(
            curve.x.size if path else 1 for curve, path in zip(curves, self._paths, strict=True)
        ) + len(bounds)
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
        if "." in curve.over and curve.over not in self._known:
            field = f"MeasuredCurve({curve.name}).over"
            cure = nearest(curve.over, sorted(self._known))
            raise DescriptionError(field, curve.over, "be a field of the scene", hint=cure)
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
        self.ahead([values])
        base, readings, errors = self.changes(values), [], []
        for i, curve in enumerate(self.curves):
            found, error = self._curve(i, curve, base, values)
            readings.append(found)
            errors.append(error)
        numbers = []
        for j, bound in enumerate(self.bounds, len(self.curves)):
            run = Run(base | self._sets[j], self._names[j])
            numbers.append(self._number(run, bound.quantity))
        return Prediction(tuple(readings), tuple(numbers), tuple(errors))

    def ahead(self, each: Iterable[Sequence[float]]) -> None:
        """Have the runs of some values of the parameters made together, by the worker processes.

        Slopes of contacts are asked for at once, as the contact is solved where they are found.
        """
        jobs = list[tuple[Run, Asked | None]]()
        for values in each:
            for run, asked in self._runs_of_numbers(values):
                jobs.append((run, asked if self.runs.solver.is_adjoint else None))
            base = self.changes(values)
            for i, path in enumerate(self._paths):
                if not path:
                    jobs.append((Run({**base, **self._sets[i]}, self._names[i]), None))
        self.runs.ahead(jobs)

    def _runs_of_numbers(self, values: Sequence[float]) -> Iterator[tuple[Run, Asked]]:
        """Runs of which numbers are read, of each position of curves over a path and each bound."""
        base = self.changes(values)
        for i, (curve, path) in enumerate(zip(self.curves, self._paths, strict=True)):
            if path:
                yield from self._runs_along(i, curve, base, values)
        for j, bound in enumerate(self.bounds, len(self.curves)):
            run = Run(base | self._sets[j], self._names[j])
            yield run, Asked(bound.quantity, self._fields)

    def _runs_along(
        self, i: int, curve: MeasuredCurve, base: Mapping[str, Any], values: Sequence[float]
    ) -> Iterator[tuple[Run, Asked]]:
        place, path = self._places[i], self._paths[i]
        paths = (*self._fields, path) if "shift" in place.sought else self._fields
        for at in (curve.x + place.value("shift", values)).tolist():
            run = Run({**base, **self._sets[i], path: at}, self._names[i])
            yield run, Asked(curve.quantity, paths)

    @property
    def _fields(self) -> tuple[str, ...]:
        """Paths of the parameters that are fields of the scene; those of one value together."""
        return tuple(", ".join(one.paths) for one in self.parameters if one.paths)

    def _curve(
        self, i: int, curve: MeasuredCurve, base: Mapping[str, Any], values: Sequence[float]
    ) -> tuple[Floats, float]:
        place = self._places[i]
        if self._paths[i]:
            runs = [run for run, _ in self._runs_along(i, curve, base, values)]
            ideal = np.array([self._number(run, curve.quantity) for run in runs])
            error = stated_error(self.scene, self.accuracy, ideal, False)
        else:
            outcome, found = self._read(i, curve, base, values)
            ideal = found.values
            error = stated_error(self.scene, self.accuracy, outcome.found[curve.quantity], True)
        scale = place.value("scale", values)
        return scale * ideal + place.value("zero", values), scale * error

    def _read(
        self, i: int, curve: MeasuredCurve, base: Mapping[str, Any], values: Sequence[float]
    ) -> tuple[Outcome, ReadOff]:
        """Run of a curve over a column, and the column at the positions."""
        outcome = self.runs.outcome(Run({**base, **self._sets[i]}, self._names[i]))
        x = curve.x + self._places[i].value("shift", values)
        stiffness = self._places[i].value("stiffness", values)
        return outcome, read_off(outcome, curve, x, stiffness)

    def slopes(self, values: Sequence[float], predicted: Prediction) -> list[Slopes | None]:
        """Exact derivatives of what is `predicted` to each parameter; None where one is not known.

        Those to nuisances follow from the curves, those to fields of the scene from its runs.
        """
        base = self.changes(values)
        if not self.runs.solver.is_adjoint:
            jobs = self._runs_of_numbers(values)
            self.runs.ahead(pair for pair in jobs if self.runs.solver.may_have(pair[1]))
        rows = [
            self._of_numbers(i, curve, base, values, predicted.readings[i])
            if self._paths[i]
            else self._of_column(i, curve, base, values)
            for i, curve in enumerate(self.curves)
        ]
        bounds = np.zeros((len(self.bounds), len(self.parameters)))
        for j, bound in enumerate(self.bounds, len(self.curves)):
            run = Run(base | self._sets[j], self._names[j])
            found = self.runs.slopes(run, Asked(bound.quantity, self._fields))
            bounds[j - len(self.curves)] = self._of_fields([found])[:, 0]
        all_of = [
            Slopes(tuple(part[k] for part in rows), bounds[:, k])
            for k in range(len(self.parameters))
        ]
        return [one if one.is_known else None for one in all_of]

    def _of_fields(self, found: Sequence[Mapping[str, Floats]]) -> Floats:
        """Slopes over the parameters that are fields, a row for each; nan where not known."""
        unknown = [np.full(next(iter(one.values())).size if one else 1, np.nan) for one in found]
        rows = np.zeros((len(self.parameters), sum(part.size for part in unknown)))
        for k, parameter in enumerate(self.parameters):
            if parameter.paths:
                path = ", ".join(parameter.paths)
                known = [one.get(path, nan) for one, nan in zip(found, unknown, strict=True)]
                rows[k] = np.concatenate(known)
        return rows

    def _of_numbers(
        self,
        i: int,
        curve: MeasuredCurve,
        base: Mapping[str, Any],
        values: Sequence[float],
        readings: Floats,
    ) -> Floats:
        """Slopes of the readings of a curve over a path, a row for each parameter."""
        place = self._places[i]
        scale, zero = place.value("scale", values), place.value("zero", values)
        found = [
            self.runs.slopes(run, asked) for run, asked in self._runs_along(i, curve, base, values)
        ]
        rows = scale * self._of_fields(found)
        if "shift" in place.sought:
            along = [one.get(self._paths[i], np.full(1, np.nan)) for one in found]
            rows[place.sought["shift"]] = scale * np.concatenate(along)
        return place.with_gauge(rows, (readings - zero) / scale)

    def _of_column(
        self, i: int, curve: MeasuredCurve, base: Mapping[str, Any], values: Sequence[float]
    ) -> Floats:
        """Slopes of the readings of a curve over a column, a row for each parameter.

        With the compliance c of the spring a column f is q = f(a) at a + c q = x, so that
        dq = (1 - c q') df and dq/dc = -q q'.
        """
        place, (_, found) = self._places[i], self._read(i, curve, base, values)
        scale, softness = place.value("scale", values), 1.0 / place.value("stiffness", values)
        at = curve.x + place.value("shift", values) - softness * found.values
        rows = np.zeros((len(self.parameters), at.size))
        if self._fields:
            run = Run({**base, **self._sets[i]}, self._names[i])
            asked = Asked(curve.quantity, self._fields, curve.over, tuple(at.tolist()))
            slopes = {} if found.is_held.any() else self.runs.slopes(run, asked)
            rows = rows + scale * self._of_fields([slopes]) * (1.0 - softness * found.slopes)
        if "shift" in place.sought:
            rows[place.sought["shift"]] = scale * found.slopes
        if "stiffness" in place.sought:
            rows[place.sought["stiffness"]] = scale * softness**2 * found.values * found.slopes
        return place.with_gauge(rows, found.values)

    def _number(self, run: Run, name: str) -> float:
        value = self.runs.outcome(run).found[name]
        if not isinstance(value, float):
            hint = "a column is compared over a column, such as over='gap'"
            raise DescriptionError("quantity", name, "be a number of the result", hint=hint)
        if math.isnan(value):
            at = ", ".join(f"{path} = {one!r:.40}" for path, one in run.changes.items())
            raise ContactkitError(f"the result has no {name} at {at}: the event did not occur")
        return value

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
            found.append(self.runs.outcome(Run(changes, self._names[i])))
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
    if given and parse_scale(given).dimension != parse_unit(unit).dimension:
        raise DescriptionError(field, given, f"convert to {unit}, the unit of the result")
