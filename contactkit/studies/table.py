"""Result of a study: points, columns, table and CSV file."""

from __future__ import annotations

import math
from collections.abc import Mapping
from html import escape
from pathlib import Path
from typing import TYPE_CHECKING, Any, Generic, TypeVar

import numpy as np
from attrs import evolve, field, frozen

from ..errors import DescriptionError, NotSimulatedError
from ..files.csv_rows import write_rows
from ..scene.result import Result
from ..scene.scales import Scale
from .bands import RUNS, banded_point, banded_units, seed_axes
from .columns import StudyColumns, as_text, labels_of
from .store import StudyPoint

if TYPE_CHECKING:
    from numpy.typing import NDArray


__all__ = ["Study"]

_MAX_COLUMNS = 6  # of a table without named columns; more do not fit beside the parameters

R_co = TypeVar("R_co", bound=Result, covariant=True)


@frozen(eq=False)
class Study(StudyColumns, Generic[R_co]):
    """Points of a study, in the order of the product of the parameters, the last one fastest.

    Attributes
    ----------
    points : tuple of StudyPoint
        One for each combination.
    shape : tuple of int
        Number of values of each parameter; ``column(name).reshape(study.shape)`` is the array over
        them.
    paths : tuple of tuple of str
        Paths of each parameter, several where they vary together.
    units : mapping of str to str
        Unit of each column: of the parameters, by path; of the scalar results; of ``seconds`` and
        the operation counts.
    sources : tuple of str
        Sources of the equations of all points.
    """

    points: tuple[StudyPoint, ...] = field(repr=False)
    shape: tuple[int, ...]
    paths: tuple[tuple[str, ...], ...]
    units: Mapping[str, str] = field(repr=False)
    _results: tuple[R_co | None, ...] | None = field(repr=False)
    _definitions: Mapping[str, str] = field(factory=dict, repr=False)
    sources: tuple[str, ...] = field(default=(), repr=False)

    @property
    def status(self) -> str:
        """``complete``, or ``incomplete`` if a point has no solution."""
        return "incomplete" if self.failed else "complete"

    @property
    def message(self) -> str:
        """Number of points and parameters, and what the points have to remark."""
        lacking = f"; {len(self.failed)} without a solution" if self.failed else ""
        noted = sum(1 for point in self.points if point.notes)
        return self._over + lacking + (f"; {noted} with notes" if noted else "")

    def scalars(self) -> dict[str, tuple[float, str]]:
        """Return numbers of the whole study: points, seconds and counts, added up."""
        counts = {name: None for point in self.points for name in point.counts}
        totals = {n: sum(point.counts.get(n, 0) for point in self.points) for n in counts}
        return {
            "n_points": (len(self.points), "-"),
            "n_failed": (len(self.failed), "-"),
            "n_solved": (self.n_solved, "-"),
            "seconds": (sum(point.seconds for point in self.points), "s"),
            **{name: (total, "-") for name, total in totals.items()},
        }

    @property
    def results(self) -> tuple[R_co | None, ...]:
        """Complete results with maps or curves; None where a point failed.

        Raises
        ------
        NotSimulatedError
            If the study did not keep them.
        """
        if self._results is None:
            raise NotSimulatedError("the study kept no maps: run study(..., keep_maps=True)")
        return self._results

    @property
    def n_solved(self) -> int:
        """Number of points that were solved, not read from the store."""
        return sum(not point.is_from_store for point in self.points)

    @property
    def failed(self) -> tuple[StudyPoint, ...]:
        """Points without a solution; status and message state why."""
        return tuple(point for point in self.points if point.has_failed)

    def column(self, name: str) -> NDArray[Any]:
        """Return one column over all points, in SI units; nan where a point has no value.

        Parameters
        ----------
        name : str
            A scalar result such as ``contact_area``, the path of a parameter, ``seconds``, a count
            such as ``n_operator_applications``, or ``status``.

        Raises
        ------
        DescriptionError
            If there is no such column.
        """
        if name == "status":
            return np.array([point.status for point in self.points])
        self._known(name)
        values = [_number(point, name) for point in self.points]
        if all(isinstance(v, int | float) and not isinstance(v, bool) for v in values):
            return np.array(values, dtype=float)
        column = np.empty(len(values), dtype=object)
        column[:] = values
        return column

    @property
    def number_names(self) -> tuple[str, ...]:
        """Names of the scalar results, without seconds and counts."""
        return tuple(name for name in self.points[0].scalars if name not in self._varied)

    def _repr_html_(self) -> str:
        """The table in a notebook."""
        return f"<pre>{escape(self.table())}</pre>"

    def bands(self, over: str | None = None) -> Study[R_co]:
        """Return the study over its other parameters, with a band over the seeds at each point.

        Parameters
        ----------
        over : str, optional
            Path of the parameter to aggregate over; every seed if not given.

        Returns
        -------
        Study
            A number ``name`` becomes the median of the runs, beside ``name_mean``, and the band
            from ``name_low`` to ``name_high``, the least and the greatest; ``runs`` counts those
            with a solution, and only they are taken. Seconds and counts are added up.

        Raises
        ------
        DescriptionError
            If no parameter is a seed, or there is no such parameter.

        Examples
        --------
        >>> import contactkit as ck
        >>> steel = ck.Material(young_modulus=210e9, poisson_ratio=0.3)
        >>> rough = ck.GaussianRoughness(rms=1e-9, correlation_length=2e-7, cutoff=1e-7)
        >>> scene = ck.ContactScene(
        ...     interface=ck.Interface(lower=ck.Body(solid=steel), upper=ck.Body(surface=rough)),
        ...     window=ck.Window(width=8e-7),
        ...     loading=ck.Pressing(pressure=1e8),
        ...     effects=(ck.HalfSpace(),),
        ... )
        >>> parameters = {"interface.upper.surface.seed": [1, 2, 3], "loading.pressure": [5e7, 1e8]}
        >>> found = ck.study(scene, parameters, ck.Accuracy(grid=64)).bands()
        >>> [found.column(f"contact_fraction{end}").shape for end in ("", "_low", "_high")]
        [(2,), (2,), (2,)]
        """
        gone = seed_axes(self.paths, over)
        left = [i for i in range(len(self.shape)) if i not in gone]
        places = np.arange(len(self.points)).reshape(self.shape)
        n = math.prod(self.shape[i] for i in gone)
        rows = np.moveaxis(places, gone, tuple(range(-len(gone), 0))).reshape(-1, n)
        paths = tuple(self.paths[i] for i in left)
        kept = [path for axis in paths for path in axis]
        points = []
        for row in rows:
            runs = [self.points[i] for i in row]
            points.append(banded_point({p: runs[0].values[p] for p in kept}, runs))
        units = self.units
        results = {name: units[name] for name in self.points[0].scalars}
        counts = [name for name in units if name not in results and name not in self._varied]
        banded = {p: units[p] for p in kept} | banded_units(results.items())
        if not left:  # one point, of all runs
            paths = ((RUNS,),)
            points = [evolve(points[0], values={RUNS: n})]
        return Study(
            tuple(points),
            tuple(self.shape[i] for i in left) or (1,),
            paths,
            banded | {name: units[name] for name in counts},
            None,
            self.scale_definitions,
            self.sources,
        )

    def dimensionless(self) -> Study[R_co]:
        """Return the study in units of the reference scales of each point.

        Parameters and numbers are divided by the scale of their unit, `Result.scales`, and have
        the name of the scale as unit: a load in newtons becomes one in units of ``E* A``. What
        has no scale stays in SI units, and so does a parameter that is its own scale, such as a
        varied initial gap. A point without a solution has no scales, and only nan.

        Raises
        ------
        DescriptionError
            If the scales are not defined in the same way at all points, or there are none.
        """
        scaled = [point.scales for point in self.points if point.scales]
        if not scaled:
            raise DescriptionError(
                "dimensionless",
                "no scales",
                "be of points that were solved",
                hint="make a study dimensionless before its bands",
            )
        common = set.intersection(*(set(scales) for scales in scaled))
        for unit in sorted(common):
            kinds = list(dict.fromkeys(scales[unit][1:] for scales in scaled))
            if len(kinds) > 1:
                raise DescriptionError(
                    f"scale of [{unit}]",
                    " and ".join(definition for _, definition in kinds),
                    "be the same at all points",
                )
        first = scaled[0]
        names = {n for n in self.units if n != "seconds" and self.units[n] in common}
        names -= {path for path in self._varied if path in names and self._is_own_scale(path)}
        return evolve(
            self,
            points=tuple(_over_scales(point, self.units, names) for point in self.points),
            units={n: first[u].name if n in names else u for n, u in self.units.items()},
        )

    @property
    def scales(self) -> Mapping[str, Scale]:
        """Scales of the first point that has any, by unit; their definitions hold for all."""
        return next((point.scales for point in self.points if point.scales), {})

    @property
    def scale_definitions(self) -> Mapping[str, str]:
        """Definition of each reference scale by its name, also of bands, whose points have none."""
        return self._definitions or {one.name: one.definition for one in self.scales.values()}

    def _is_own_scale(self, path: str) -> bool:
        """Whether a parameter is its scale at every point."""
        unit = self.units[path]
        known = [p for p in self.points if unit in p.scales]
        values = [p.values[path] for p in known]
        if not all(isinstance(v, int | float) for v in values):
            return False
        pairs = zip(values, known, strict=True)
        return all(math.isclose(v, p.scales[unit].value, rel_tol=1e-12) for v, p in pairs)

    def table(self, *names: str) -> str:
        """Return the points as text, one per line, with remarks below.

        Parameters
        ----------
        *names : str
            Columns to show beside the parameters; none: the first six of `telling`.
        """
        varied = list(self.points[0].values)
        shown = [*varied, *(names or (self.telling() or self.number_names)[:_MAX_COLUMNS])]
        labels = labels_of(shown, varied)
        heads = [f"{labels[n]} [{self.unit(n)}]" for n in shown]
        cells = [[as_text(_number(p, n)) for n in shown] for p in self.points]
        widths = [max(map(len, column)) for column in zip(heads, *cells, strict=True)]
        rows = [
            "  ".join(c.rjust(w) for c, w in zip(row, widths, strict=True)) + f"  {status}"
            for row, status in zip(
                [heads, *cells], ["status", *(p.status for p in self.points)], strict=True
            )
        ]
        return "\n".join([*rows, *self._remarks()])

    def _remarks(self) -> list[str]:
        failed = [f"point {i}: {p.message}" for i, p in enumerate(self.points) if p.has_failed]
        notes = self._notes()
        stored = len(self.points) - self.n_solved
        return [*failed, *notes, *([f"{stored} points from the store"] if stored else [])]

    def _notes(self) -> list[str]:
        """Notes of the points, those that differ in their number only once."""
        first: dict[str, str] = {}
        places: dict[str, list[int]] = {}
        for i, point in enumerate(self.points):
            for note in point.notes:
                kind = note.partition(" = ")[0]
                first.setdefault(kind, note)
                places.setdefault(kind, []).append(i)
        return [f"{_points(places[kind])}: {note}" for kind, note in first.items()]

    def save_csv(self, path: str | Path) -> Path:
        """Write all columns to a CSV file, headed by name and unit, atomically.

        Parameters
        ----------
        path : str or Path
            The file; its suffix becomes ``.csv``.
        """
        names = list(self.units)
        heads = [*(f"{n} [{self.units[n]}]" for n in names), "status", "message"]
        rows = (
            [*(as_text(_number(one, n), digits=10) for n in names), one.status, one.message]
            for one in self.points
        )
        return write_rows(Path(path).with_suffix(".csv"), heads, rows)


def _over_scales(point: StudyPoint, units: Mapping[str, str], names: set[str]) -> StudyPoint:
    """A point with some of its parameters and numbers divided by the scales of their units."""

    def over(name: str, value: Any) -> Any:
        if name not in names or isinstance(value, bool) or not isinstance(value, int | float):
            return value
        scale = point.scales.get(units[name])
        return value / scale.value if scale else math.nan

    return evolve(
        point,
        values={n: over(n, value) for n, value in point.values.items()},
        scalars={
            n: (over(n, value), point.scales[unit].name if n in names and point.scales else unit)
            for n, (value, unit) in point.scalars.items()
        },
    )


def _points(places: list[int]) -> str:
    more = len(places) - 1
    return f"point {places[0]}" + (f" and {more} more" if more else "")


def _number(point: StudyPoint, name: str) -> Any:
    if name in point.values:
        return point.values[name]
    if name in point.scalars:
        return point.scalars[name][0]
    if name == "seconds":
        return point.seconds
    return point.counts.get(name, math.nan)
