"""Tables of the kernel over a grid of geometry, angles and humidity, and their error between."""

from __future__ import annotations

import itertools
import math
import warnings
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import reduce
from typing import TYPE_CHECKING, Any

import numpy as np
from attrs import evolve, frozen

from ..accuracy import Accuracy
from ..errors import ContactkitError
from ..fmu.native.records import FilmTables, Table
from ..fmu.native.tables import Tabulate, quintics
from ..studies.paths import changed
from .fixed import SMALL, FixedTables
from .scene import KernelScene, film_of
from .sliders import Slider
from .validity import Rules, logs_of

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

__all__ = ["Family", "Nodes", "family_of", "tabulated", "with_values"]

# Nodes of Chebyshev along each of one, two, three or more quantities. Of volume and radius of a
# film between flats, and its contact angle: 1e-3 of the meniscus force, and 180 kB.
_NODES = {1: 9, 2: 7, 3: 5}
_FEWEST = 4
_TRIALS = 6  # places between the nodes at which the error is measured
_HALVINGS = 6  # of a range whose ends have no answer, such as a film that spans no gap
_PRIMES = (2, 3, 5, 7, 11)  # bases of Halton's sequence
_WORST = 0.02  # a family that is farther off is given up, and its quantities stay as they are

Progress = Callable[[float], None]


@frozen
class Family:
    """Numbers of the kernel, and of validity, over a grid of some quantities.

    Attributes
    ----------
    sliders : tuple of Slider
        The quantities.
    nodes : tuple of ndarray
        Their places on the grid, of the logarithm where that is what the slider moves.
    columns : ndarray of int
        Places in `base` of the numbers that change.
    logs : ndarray of bool
        Whether the logarithm of such a number is interpolated.
    changes : ndarray
        Difference of each such number, or of its logarithm, to that in `base`: [node, column].
    base : ndarray
        Numbers of the scene as it is.
    count : int
        How many of them are those of the kernel; the numbers of validity follow.
    error : float
        Largest relative error between the nodes [-], measured.
    """

    sliders: tuple[Slider, ...]
    nodes: tuple[Floats, ...]
    columns: NDArray[np.int64]
    logs: NDArray[np.bool_]
    changes: Floats
    base: Floats
    count: int
    error: float

    def at(self, values: Sequence[float]) -> Floats:
        """Numbers at values of the quantities; as ``template/tables.js``.

        Contact angles come last: forces are sums of their cosines, and products of all else.
        """
        weights = [
            _weights(nodes, slider.place(value))
            for slider, nodes, value in zip(self.sliders, self.nodes, values, strict=True)
        ]
        n_angles = sum(slider.scale == "angle" for slider in self.sliders)
        first, last = weights[: len(weights) - n_angles], weights[len(weights) - n_angles :]
        powers, angles = _products(first), _products(last)
        of = self.base[self.columns]
        changes = self.changes.reshape(len(powers), len(angles), -1)
        change = np.einsum("i,ijk->jk", powers, changes)
        found = self.base.copy()
        found[self.columns] = angles @ np.where(self.logs, of * np.exp(change), of + change)
        return found


def _products(weights: Sequence[Floats]) -> Floats:
    found: Floats = reduce(lambda a, b: np.multiply.outer(a, b).ravel(), weights, np.ones(1))
    return found


def _weights(nodes: Floats, place: float) -> Floats:
    """Lagrange's weights of the nodes at a place."""
    return np.array(
        [
            np.prod([(place - b) / (a - b) for j, b in enumerate(nodes) if j != i])
            for i, a in enumerate(nodes)
        ]
    )


def with_values(scene: Any, values: Mapping[Slider, float]) -> Any:
    """Scene with values of sliders."""
    given = {path: value for slider, value in values.items() for path in slider.paths}
    return changed(scene, None, given).scene


class Nodes:
    """Numbers of scenes that differ in what a family moves, all of one form.

    Parameters
    ----------
    scene : object
        The scene as it is.
    like : FilmTables
        Its tables, whose form all have.
    film : callable
        Tables of such a scene, made by a `Tabulate`.
    numbers : callable
        Numbers of the kernel of such a scene and its tables.
    more : callable
        Numbers of such a scene that are interpolated besides.
    """

    def __init__(
        self,
        scene: Any,
        like: FilmTables,
        film: Callable[[Any, Tabulate], FilmTables],
        numbers: Callable[[Any, FilmTables], list[float]],
        more: Callable[[Any], list[float]],
    ) -> None:
        self.scene, self.tables = scene, FixedTables(like)
        self._film, self._numbers, self._more = film, numbers, more

    def places(self) -> _Places:
        """Places of the columns of the tables."""
        film = self._film(self.scene, self.tables.begin())
        return _Places(lambda tables: self._numbers(self.scene, tables), film)

    def numbers(self, scene: Any) -> Floats:
        """Numbers of the kernel, then the others."""
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            film = self._film(scene, self.tables.begin())
            return np.array([*self._numbers(scene, film), *self._more(scene)])


def family_of(
    kernel: KernelScene,
    sliders: tuple[Slider, ...],
    accuracy: Accuracy,
    rules: Rules,
    span: tuple[float, float],
    progress: Progress | None = None,
) -> Family | str:
    """Tabulate over a grid of all sliders; the reason if a scene of the grid has no such tables."""
    made = Nodes(
        kernel.scene,
        kernel.film.tables,
        lambda scene, make: film_of(scene, accuracy, make).tables,
        lambda _, tables: kernel.numbers(tables),
        lambda scene: logs_of(scene, accuracy, rules, span),
    )
    return tabulated(made, sliders, span[1], progress)


def tabulated(
    made: Nodes, sliders: tuple[Slider, ...], highest: float, progress: Progress | None = None
) -> Family | str:
    """Tabulate over a grid; its error is that of forces up to the highest gap [m]."""
    scene = made.scene
    sliders = tuple(sorted(sliders, key=lambda slider: slider.scale == "angle"))  # see Family.at
    sliders = _with_answers(made, scene, sliders)
    if not sliders:
        return "no other geometry near it has an answer"
    most = _NODES.get(len(sliders), _FEWEST)
    nodes = tuple(_chebyshev(slider, most) for slider in sliders)
    grid = list(itertools.product(*nodes))
    found: list[Floats] = []
    try:
        base = made.numbers(scene)
        for i, place in enumerate(grid):
            found.append(made.numbers(_scene_at(scene, sliders, place)))
            if progress is not None:
                progress((i + 1) / (len(grid) + _TRIALS))
        trials = [_trial(sliders, i) for i in range(_TRIALS)]
        right = [made.numbers(_scene_at(scene, sliders, place)) for place in trials]
    except ContactkitError as reason:
        return str(reason)
    if any(len(one) != len(base) for one in (*found, *right)):
        return "the tables of its range are of several forms"
    places = made.places()
    count = len(places.other)
    family = _interpolated(sliders, nodes, base, np.array(found), count)
    error = made.tables.error + max(
        _difference(family, places, trial, exact, highest)
        for trial, exact in zip(trials, right, strict=True)
    )
    if not error <= _WORST:
        return f"its tables would be {error:.2g} off between the nodes of their grid"
    return evolve(family, error=error)


def _with_answers(made: Nodes, scene: Any, sliders: tuple[Slider, ...]) -> tuple[Slider, ...]:
    """Sliders whose ends, and the corners of whose ranges together, have the scene's tables."""
    size = len(made.numbers(scene))

    def is_fine(values: Mapping[Slider, float]) -> bool:
        try:
            return len(made.numbers(with_values(scene, values))) == size
        except ContactkitError:
            return False

    found = list[Slider]()
    for slider in sliders:
        low, high = (
            _nearer(slider, end, lambda value, of=slider: is_fine({of: value}))  # type: ignore[misc]
            for end in (slider.low, slider.high)
        )
        if low < high:
            found.append(evolve(slider, low=low, high=high))
    for _ in range(_HALVINGS):
        corners = itertools.product(*((s.low, s.high) for s in found))
        if all(is_fine(dict(zip(found, corner, strict=True))) for corner in corners):
            break
        found = [evolve(s, low=_half(s, s.low), high=_half(s, s.high)) for s in found]
    return tuple(found)


def _half(slider: Slider, end: float) -> float:
    """Half way from an end of the range to the value."""
    return slider.value_at(0.5 * (slider.place(end) + slider.place(slider.value)))


def _nearer(slider: Slider, end: float, is_fine: Callable[[float], bool]) -> float:
    """End of the range, or nearer to the value, where the scene has an answer."""
    for _ in range(_HALVINGS):
        if end == slider.value or is_fine(end):
            return end
        end = _half(slider, end)
    return slider.value


def _chebyshev(slider: Slider, count: int) -> Floats:
    """Extrema of Chebyshev's polynomial over the range of a slider."""
    low, high = slider.place(slider.low), slider.place(slider.high)
    places = np.cos(np.pi * np.arange(count) / (count - 1))
    return 0.5 * (low + high) - 0.5 * (high - low) * places


def _scene_at(scene: Any, sliders: Sequence[Slider], place: Sequence[float]) -> Any:
    values = {slider: slider.value_at(float(x)) for slider, x in zip(sliders, place, strict=True)}
    return with_values(scene, values)


def _trial(sliders: Sequence[Slider], number: int) -> list[float]:
    """Place between the nodes."""
    return [
        s.place(s.low) + (s.place(s.high) - s.place(s.low)) * _halton(number + 1, base)
        for s, base in zip(sliders, _PRIMES, strict=False)
    ]


def _halton(number: int, base: int) -> float:
    found, fraction = 0.0, 1.0
    while number:
        fraction /= base
        number, digit = divmod(number, base)
        found += fraction * digit
    return found


def _interpolated(
    sliders: tuple[Slider, ...],
    nodes: tuple[Floats, ...],
    base: Floats,
    found: Floats,
    count: int,
) -> Family:
    moves = np.any(found != base, axis=0)
    columns = np.flatnonzero(moves)
    of, every = base[columns], found[:, columns]
    logs = np.all(every * of > 0.0, axis=0)
    with np.errstate(divide="ignore", invalid="ignore"):
        changes = np.where(logs, np.log(np.where(logs, every / of, 1.0)), every - of)
    return Family(sliders, nodes, columns, logs, changes, base, count, math.inf)


class _Places:
    """Where in the numbers of the kernel the columns of its tables are."""

    def __init__(self, numbers: Callable[[FilmTables], list[float]], tables: FilmTables) -> None:
        marked, plain = numbers(_marked(tables)), numbers(tables)
        slopes = [a != b for a, b in zip(marked, plain, strict=True)]
        runs, at = list[tuple[int, int]](), 0
        for differs, run in itertools.groupby(slopes):
            length = len(list(run))
            if differs:
                runs.append((at, length // 2))
            at += length
        self.pieces = runs
        """First slope and number of nodes of each piece; x and y come before, curvatures after."""
        self.other = np.ones(at, dtype=bool)
        """Whether a number is no column of a table."""
        for first, count in runs:
            self.other[first - 2 * count : first + 2 * count] = False

    def values(self, numbers: Floats, highest: float) -> Iterator[tuple[Floats, Floats]]:
        """Values of each piece at its nodes and half way between; which are below a gap [m]."""
        half = np.full((1, 1), 0.5)
        for first, n in self.pieces:
            x, y, slope, curve = (
                numbers[start : start + n] for start in range(first - 2 * n, first + 2 * n, n)
            )
            high, folds = numbers[first - 2 * n - 4], numbers[first - 2 * n - 3]
            width = np.diff(x)[0]
            middle, _ = quintics(half, y, slope * width, curve * width * width)
            at = np.concatenate([x, 0.5 * (x[1:] + x[:-1])])
            gaps = high * np.exp(-at * at) if folds else np.exp(at)
            yield np.concatenate([y, middle[0]]), gaps <= highest


def _marked(tables: FilmTables) -> FilmTables:
    """Tables with other slopes and curvatures."""

    def other(table: Table) -> Table:
        pieces = (
            evolve(
                p,
                slope=tuple(v + 1.0 + abs(v) for v in p.slope),
                curve=tuple(v + 1.0 + abs(v) for v in p.curve),
            )
            for p in table.pieces
        )
        return evolve(table, pieces=tuple(pieces))

    films = (
        evolve(
            film,
            laws=tuple(evolve(law, table=other(law.table)) for law in film.laws),
            shape=other(film.shape),
        )
        for film in tables.films
    )
    return evolve(tables, films=tuple(films))


def _difference(
    family: Family, places: _Places, place: Sequence[float], exact: Floats, highest: float
) -> float:
    """Largest relative difference to the numbers of the scene itself, up to the highest gap [m]."""
    values = [slider.value_at(x) for slider, x in zip(family.sliders, place, strict=True)]
    found, n = family.at(values), len(places.other)
    worst = 0.0
    pairs = zip(places.values(found[:n], highest), places.values(exact[:n], highest), strict=True)
    for (mine, _), (right, below) in pairs:
        size = np.maximum(np.abs(right), SMALL * np.max(np.abs(right)))
        error = np.abs(mine - right) / size
        worst = max(worst, float(np.max(error[below], initial=0.0)))
    mine, right = found[:n][places.other], exact[:n][places.other]
    moved = (mine != right) & (right <= highest)  # bridges may end far beyond it
    return max(worst, float(np.max(np.abs(mine[moved] / right[moved] - 1.0), initial=0.0)))
