"""Sensitivity of a quantity to the assumptions behind it, one at a time over its range."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from contextlib import suppress
from functools import partial
from html import escape
from itertools import chain
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from attrs import field, frozen

from ..accuracy import Accuracy
from ..errors import ContactkitError, DescriptionError, nearest
from ..files.csv_rows import write_rows
from ..scene.curve import Curve
from ..scene.description import value_text
from ..scene.scenes import ContactScene, SeparationScene, SlidingScene
from ..units import quantity_text
from .columns import as_text
from .paths import axes, changed, joined, value_at
from .study import Study, check_effects, study

__all__ = [
    "Answers",
    "Influence",
    "Range",
    "Sensitivity",
    "answers",
    "is_wide",
    "ranges_of",
    "sensitivity",
]

# Ratio of the ends of a range from which the values between are spaced by ratios: five equal steps
# over a decade or more leave its lower third, in logarithms more than half of it, without a value.
_WIDE = 10.0
_Row = tuple[Any, ...]


class Range(NamedTuple):
    """Plausible range of an assumption, and the reason for it.

    Parameters
    ----------
    low, high : float or str
        Ends of the range, in SI units or as texts with a unit. Names of the library for solids and
        liquids. Where several paths vary together, tuples with a value for each path.
    reason : str
        Why the range is plausible: a datasheet, a measurement, a guess.

    Examples
    --------
    >>> Range("10 g", "40 g", "2 to 5 cm3 of steel").high
    '40 g'
    """

    low: Any
    high: Any
    reason: str = ""


@frozen(eq=False)
class Influence:
    """Answers over the range of one assumption.

    Attributes
    ----------
    path : str
        Path of the assumption in the scene; several, separated by commas, that vary together.
    unit : str
        Unit of its values; that of the first path.
    base : object
        Value in the scene as it is; that of the first path.
    values : tuple
        Values from the low to the high end; those of the first path.
    results : tuple of float
        Answer at each value; nan where there is none.
    messages : tuple of str
        Why there is none; empty elsewhere.
    reason : str
        Why the range is plausible.
    """

    path: str
    unit: str
    base: Any
    values: tuple[Any, ...]
    results: tuple[float, ...]
    messages: tuple[str, ...] = field(repr=False)
    reason: str = ""

    @property
    def has_gaps(self) -> bool:
        """Whether there is no result somewhere in the range."""
        return any(map(math.isnan, self.results))

    def tried(self) -> dict[str, Any]:
        """Values, results and messages as floats and texts, with the unit of the values."""
        plain = [v if isinstance(v, bool | int | float | str) else as_text(v) for v in self.values]
        return {
            "unit": self.unit,
            "values": plain,
            "results": list(self.results),
            "messages": list(self.messages),
        }

    def extent(self, base: float) -> tuple[float, float]:
        """Least and greatest result over the range, that of the scene as it is among them."""
        known = [one for one in (base, *self.results) if not math.isnan(one)]
        return (min(known), max(known)) if known else (math.nan, math.nan)

    def swing(self, base: float) -> float:
        """Greatest less least result; infinite where there is none somewhere in the range."""
        low, high = self.extent(base)
        return math.inf if self.has_gaps else high - low


@frozen(eq=False)
class Sensitivity(Curve):
    """Answer of a scene, and what each assumption does to it, the most influential first.

    Its columns are over the assumptions; ``parts["influences"]`` holds every value that was tried
    with its result, by path, also in a file.

    Attributes
    ----------
    quantity : str
        Name of the quantity.
    quantity_unit : str
        Its unit.
    base : float
        Answer of the scene as it is.
    influences : tuple of Influence
        One for each assumption, sorted by the change of the quantity over its range; first those
        with a value for which there is no result.
    sources : tuple of str
        Sources of the equations; none of a device, whose answer is that of a function.
    """

    quantity: str
    quantity_unit: str
    base: float
    influences: tuple[Influence, ...] = field(repr=False)
    sources: tuple[str, ...] = field(default=(), repr=False)

    @property
    def axis(self) -> str:
        """See `Curve.axis`."""
        return "assumption"

    @property
    def title(self) -> str:
        """See `Curve.title`."""
        return f"sensitivity of {self.quantity}"

    @property
    def status(self) -> str:
        """``complete``, or ``incomplete`` if there is no result somewhere in a range."""
        gaps = math.isnan(self.base) or any(one.has_gaps for one in self.influences)
        return "incomplete" if gaps else "complete"

    @property
    def message(self) -> str:
        """The answer of the scene as it is, and ranges in which there is none."""
        gaps = [one.path for one in self.influences if one.has_gaps]
        lacking = f"; none somewhere in the range of {', '.join(gaps)}" if gaps else ""
        return f"{self.quantity} = {self._text(self.base)}{lacking}"

    @property
    def parts(self) -> Mapping[str, Any]:
        """See `Curve.parts`."""
        return {"influences": {one.path: one.tried() for one in self.influences}}

    def influence(self, path: str) -> Influence:
        """Return what the assumption of a path does.

        Raises
        ------
        DescriptionError
            If the path was not varied.
        """
        known = {one.path: one for one in self.influences}
        if path not in known:
            raise DescriptionError("path", path, "be one that varies", hint=nearest(path, known))
        return known[path]

    def table(self) -> dict[str, tuple[Any, str]]:
        """Return assumptions, their ranges as text and the results at the ends and extremes."""
        rows, unit = self.influences, self.quantity_unit
        extents = np.array([one.extent(self.base) for one in rows]).reshape(-1, 2)

        def texts(values: Iterable[Any]) -> tuple[Any, str]:
            cells = [value_text(v, one.unit) for v, one in zip(values, rows, strict=True)]
            return np.array(cells), "-"

        return {
            "assumption": (np.array([one.path for one in rows]), "-"),
            "low": texts(one.values[0] for one in rows),
            "as_it_is": texts(one.base for one in rows),
            "high": texts(one.values[-1] for one in rows),
            "result_low": (np.array([one.results[0] for one in rows]), unit),
            "result_high": (np.array([one.results[-1] for one in rows]), unit),
            "least": (extents[:, 0], unit),
            "greatest": (extents[:, 1], unit),
            "reason": (np.array([one.reason for one in rows]), "-"),
        }

    def scalars(self) -> dict[str, tuple[float, str]]:
        """Return the answer of the scene as it is."""
        return {"base": (self.base, self.quantity_unit)}

    def __str__(self) -> str:
        """Return the assumptions with their ranges and the results at both ends as a table."""
        heads = ("assumption", "low", "as it is", "high", "result low", "high", "change")
        rows = [heads, *(self._cells(one) for one in self.influences)]
        widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
        lines = [
            "  ".join(
                cell.ljust(w) if i == 0 else cell.rjust(w)
                for i, (cell, w) in enumerate(zip(row, widths, strict=True))
            )
            for row in rows
        ]
        missing = [f"{one.path}: {text}" for one in self.influences for text in _first(one)]
        return "\n".join([f"{self.quantity} = {self._text(self.base)}", *lines, *missing])

    def _cells(self, one: Influence) -> tuple[str, ...]:
        values = (one.values[0], one.base, one.values[-1])
        results = (one.results[0], one.results[-1], one.swing(self.base))
        return (one.path, *(value_text(v, one.unit) for v in values), *map(self._text, results))

    def _text(self, result: float) -> str:
        return quantity_text(result, self.quantity_unit) if math.isfinite(result) else "none"

    def _repr_html_(self) -> str:
        """The table in a notebook."""
        return f"<pre>{escape(str(self))}</pre>"

    def save_csv(self, path: str | Path) -> Path:
        """Write every result to a CSV file, a row for each value, atomically.

        Parameters
        ----------
        path : str or Path
            The file; its suffix becomes ``.csv``.
        """
        heads = ("assumption", "value", "value_unit", f"{self.quantity} [{self.quantity_unit}]")
        rows = [["as it is", "", "", f"{self.base:.6g}", "", ""]]
        for one in self.influences:
            for value, found, message in zip(one.values, one.results, one.messages, strict=True):
                shown = f"{value:.6g}" if isinstance(value, float) else value_text(value, "-")
                rows.append([one.path, shown, one.unit, f"{found:.6g}", message, one.reason])
        return write_rows(Path(path).with_suffix(".csv"), [*heads, "message", "reason"], rows)


def _first(one: Influence) -> list[str]:
    """First reason why there is no result."""
    return [text for text in one.messages if text][:1]


def sensitivity(
    scene: Any,
    ranges: Mapping[Any, Range | tuple[Any, Any]],
    quantity: str | Callable[[Any], float],
    accuracy: Accuracy | None = None,
    *,
    n: int = 2,
    unit: str | None = None,
    workers: int = 1,
    progress: Callable[[float], None] | None = None,
) -> Sensitivity:
    """Sweep each assumption over its plausible range, the others as in the scene.

    Parameters
    ----------
    scene : ContactScene, SeparationScene or SlidingScene, or that of a device
        The scene as it is.
    ranges : mapping of str or tuple of str to Range
        Plausible range by the dotted path of the assumption, as in `study`: ``loading.mass``,
        ``effects.tension-limit.strength``. Paths that vary together are one key, a tuple or one
        text with commas, with tuples as ends. A pair ``(low, high)`` is a range without a reason.
    quantity : str or callable
        The number that is asked for: the name of one of the result, such as ``peak_force``; or a
        function of a scene that returns it, nan where there is none, which also takes the scenes
        of devices.
    accuracy : Accuracy, optional
        Numerical settings, for a quantity by name.
    n : int
        Values from end to end, at least 2. More than the ends show a quantity that is not
        monotonic; they are spaced by ratios in a range of more than a decade, evenly in others.
        Whole numbers, names and paths that vary together have the ends alone.
    unit : str, optional
        Unit of the quantity of a function, whose name is that of the quantity; ``-`` if not given.
    workers : int
        Number of processes, for a quantity by name.
    progress : callable, optional
        Called with the completed fraction, 0 to 1.

    Returns
    -------
    Sensitivity
        Influences of the assumptions, the largest first. Effects of two assumptions at once are
        left out: repeat it from another scene to see whether the order changes.

    Raises
    ------
    DescriptionError
        If a path, a range or the quantity does not exist, or something is given that is not used.
    PlanError
        If the effects do not fit the scene, for a quantity by name.

    Examples
    --------
    >>> import contactkit as ck
    >>> oil = ck.Liquid(name="oil", viscosity=0.1, surface_tension=0.03, density=870.0)
    >>> face = ck.Flat(radius=1e-3)
    >>> scene = ck.SeparationScene(
    ...     interface=ck.Interface(lower=face, upper=face, meniscus=ck.Meniscus(liquid=oil)),
    ...     loading=ck.ImposedSpeed(speed=0.001, initial_gap=5e-6, final_gap=25e-6),
    ...     effects=(ck.ViscousForce(),),
    ... )
    >>> found = ck.sensitivity(
    ...     scene,
    ...     {
    ...         "interface.meniscus.liquid.viscosity": ck.Range("50 mPa.s", "0.2 Pa.s", "grades"),
    ...         "loading.initial_gap": ck.Range("4 um", "6 um", "waviness of the faces"),
    ...     },
    ...     "peak_force",
    ... )
    >>> [one.path for one in found.influences]
    ['interface.meniscus.liquid.viscosity', 'loading.initial_gap']
    """
    settings = accuracy if accuracy is not None else Accuracy.standard
    if isinstance(n, bool) or not isinstance(n, int) or n < 2:
        raise DescriptionError("n", n, "be a whole number of at least 2: the ends of a range")
    assumptions = [_Assumption(scene, settings, *one, n) for one in ranges_of(ranges).items()]
    paths = [path for one in assumptions for path in one.paths]
    base = dict(zip(paths, chain(*(one.base for one in assumptions)), strict=True))
    rows = [base]
    rows += [base | dict(zip(o.paths, row, strict=True)) for o in assumptions for row in o.rows]
    found = answers(scene, rows, quantity, accuracy, unit=unit, workers=workers, progress=progress)
    return _collected(assumptions, found)


class Answers(NamedTuple):
    """Answers of scenes, why some have none, the name and the unit of the quantity, its sources."""

    results: list[float]
    messages: list[str]
    name: str
    unit: str
    sources: tuple[str, ...]


def answers(
    scene: Any,
    rows: list[dict[str, Any]],
    quantity: str | Callable[[Any], float],
    accuracy: Accuracy | None = None,
    *,
    unit: str | None = None,
    workers: int = 1,
    progress: Callable[[float], None] | None = None,
) -> Answers:
    """Ask scenes for a quantity; parameters as of `sensitivity`, `rows` are values by path.

    Raises
    ------
    DescriptionError
        If the quantity does not exist, or something is given that is not used.
    PlanError
        If the effects do not fit the scene, for a quantity by name.
    """
    if isinstance(quantity, str):
        _unused(unit=unit)
        run = partial(study, workers=workers, progress=progress)
        made, found_unit = _studied(scene, rows, quantity, partial(run, accuracy=accuracy))
        results = made.column(quantity).tolist()
        messages = [point.message if point.has_failed else "" for point in made.points]
        return Answers(results, messages, quantity, found_unit, made.sources)
    _unused(accuracy=accuracy, workers=None if workers == 1 else workers)
    results, messages = _asked(scene, rows, quantity, progress)
    name = getattr(quantity, "__name__", "quantity").replace("_", " ")
    sources: tuple[str, ...] = ()
    if isinstance(scene, ContactScene | SeparationScene | SlidingScene):
        with suppress(ContactkitError):  # the answer need not be that of a plan
            sources = check_effects(scene, Accuracy.standard)
    return Answers(results, messages, name, unit or "-", sources)


def _studied(
    scene: Any, rows: list[dict[str, Any]], quantity: str, run: Callable[..., Study[Any]]
) -> tuple[Study[Any], str]:
    """One study of all rows, and the unit of the quantity."""
    if not isinstance(scene, ContactScene | SeparationScene | SlidingScene):
        expected = f"be a function for a {type(scene).__name__}, whose results have no names"
        raise DescriptionError("quantity", quantity, expected)
    paths = list(rows[0])
    values = [tuple(row.values()) if len(paths) > 1 else row[paths[0]] for row in rows]
    made = run(scene, {", ".join(paths): values})
    names = [name for name in made.units if name not in paths]
    if quantity not in names:
        expected = "be a number of the result"
        raise DescriptionError("quantity", quantity, expected, hint=nearest(quantity, names))
    return made, made.unit(quantity)


def _collected(assumptions: list[_Assumption], given: Answers) -> Sensitivity:
    """Answers in the order of the rows, as influences."""
    results, messages = given.results, given.messages
    found, at = [], 1
    for one in assumptions:
        end = at + len(one.rows)
        found.append(one.influence(tuple(results[at:end]), tuple(messages[at:end])))
        at = end
    base = results[0]
    found.sort(key=lambda one: -one.swing(base))
    return Sensitivity(given.name, given.unit, base, tuple(found), given.sources)


def ranges_of(ranges: Mapping[Any, Range | tuple[Any, Any]]) -> dict[str, Range]:
    """Return ranges by their paths as text.

    Raises
    ------
    DescriptionError
        If there is none, or one is no range.
    """
    if not isinstance(ranges, Mapping) or not ranges:
        raise DescriptionError("ranges", ranges, "name at least one assumption and its range")
    found = {}
    for path, given in ranges.items():
        if not isinstance(given, tuple | list) or not 2 <= len(given) <= 3:
            raise DescriptionError(f"ranges[{path!r}]", given, "be a Range, or a pair (low, high)")
        found[joined(path, "ranges")] = Range(*given)
    return found


def _unused(**given: object) -> None:
    """Refuse what the kind of quantity does not use."""
    cure = "accuracy and workers belong to a quantity by its name, unit to a function"
    for name, value in given.items():
        if value is not None:
            raise DescriptionError(name, value, "be left out", hint=cure)


class _Assumption:
    """An assumption with its paths, the rows of values to try, and the row of the scene."""

    def __init__(self, scene: Any, accuracy: Accuracy, path: str, given: Range, n: int) -> None:
        (axis,) = axes(scene, accuracy, {path: (given.low, given.high)})
        self.path, self.paths, self.unit = path, axis.paths, axis.units[0]
        self.base = tuple(value_at(scene, accuracy, one) for one in axis.paths)
        self.reason = given.reason
        self.rows: list[_Row] = list(axis.values)
        low, high = axis.values[0][0], axis.values[-1][0]
        if len(axis.paths) == 1 and isinstance(low, float) and isinstance(high, float):
            self.rows = [(value,) for value in _between(low, high, n)]

    def influence(self, results: tuple[float, ...], messages: tuple[str, ...]) -> Influence:
        values = tuple(row[0] for row in self.rows)
        return Influence(self.path, self.unit, self.base[0], values, results, messages, self.reason)


def is_wide(low: float, high: float) -> bool:
    """Whether the ends of a range are so far apart that the values between go by ratios."""
    return low * high > 0.0 and max(high / low, low / high) > _WIDE


def _between(low: float, high: float, n: int) -> list[float]:
    """Values from end to end, by ratios where these are far apart."""
    if is_wide(low, high):
        found = np.geomspace(low, high, n).tolist()
    else:
        found = np.linspace(low, high, n).tolist()
    return [low, *found[1:-1], high]


def _asked(
    scene: Any,
    rows: list[dict[str, Any]],
    quantity: Callable[[Any], float],
    progress: Callable[[float], None] | None,
) -> tuple[list[float], list[str]]:
    """Answers of a function, and why there are none."""
    if not callable(quantity):
        raise DescriptionError("quantity", quantity, "be the name of a number, or a function")
    scenes = [changed(scene, Accuracy.standard, row).scene for row in rows]
    results, messages = list[float](), list[str]()
    for i, one in enumerate(scenes):
        try:
            found, message = float(quantity(one)), ""
        except ContactkitError as error:
            found, message = math.nan, str(error)
        results.append(found)
        messages.append(message)
        if progress is not None:
            progress((i + 1) / len(scenes))
    return results, messages
