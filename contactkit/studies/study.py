"""Parameter studies: one scene solved over a grid of parameter values."""

from __future__ import annotations

import itertools
import math
import warnings
from collections.abc import Callable, Iterable, Iterator
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any, overload

from attrs import evolve, fields, has

from ..accuracy import Accuracy
from ..contact.chain import downwards
from ..contact.plan import unprepared_plan
from ..errors import (
    ContactkitError,
    DescriptionError,
    InfeasibleError,
    PlanError,
    ValidityWarning,
)
from ..files.results import from_bytes
from ..planning import plan
from ..scene.plan import ScenePlan
from ..scene.scenes import ContactScene, SeparationScene, SlidingScene
from ..scene.scenes import Scene as AnyScene
from .paths import Axis, Changed, Parameters, Scene, axes, changed, combinations
from .run import Done, Piece, Task, put
from .spread import run_here, run_in_processes, run_on_client
from .store import Store, StudyPoint
from .table import Study

if TYPE_CHECKING:
    from ..contact.result import ContactResult
    from ..files.results import AnyResult
    from ..separation.results import SeparationResult
    from ..separation.sliding.result import SlidingResult

# A point that kills its worker does so again; two tries are for those beside it in the same
# process.
RETRIES = 2
"""How often a point is solved again whose worker died, or which lacked memory or disk."""

__all__ = [
    "RETRIES",
    "Study",
    "StudyPoint",
    "check_effects",
    "check_kind",
    "check_study",
    "check_whole",
    "slots",
    "spread",
    "study",
]


@overload
def study(
    scene: ContactScene,
    parameters: Parameters,
    accuracy: Accuracy | None = ...,
    *,
    store: str | Path | None = ...,
    workers: int = ...,
    client: Any = ...,
    progress: Callable[[float], None] | None = ...,
    keep_maps: bool = ...,
) -> Study[ContactResult]: ...


@overload
def study(
    scene: SeparationScene,
    parameters: Parameters,
    accuracy: Accuracy | None = ...,
    *,
    store: str | Path | None = ...,
    workers: int = ...,
    client: Any = ...,
    progress: Callable[[float], None] | None = ...,
    keep_maps: bool = ...,
) -> Study[SeparationResult]: ...


@overload
def study(
    scene: SlidingScene,
    parameters: Parameters,
    accuracy: Accuracy | None = ...,
    *,
    store: str | Path | None = ...,
    workers: int = ...,
    client: Any = ...,
    progress: Callable[[float], None] | None = ...,
    keep_maps: bool = ...,
) -> Study[SlidingResult]: ...


def study(
    scene: ContactScene | SeparationScene | SlidingScene,
    parameters: Parameters,
    accuracy: Accuracy | None = None,
    *,
    store: str | Path | None = None,
    workers: int = 1,
    client: Any = None,
    progress: Callable[[float], None] | None = None,
    keep_maps: bool = False,
) -> Study[Any]:
    """Solve a scene for every combination of parameter values.

    Parameters
    ----------
    scene : ContactScene, SeparationScene or SlidingScene
        The scene, with its constant parameters.
    parameters : mapping of str or tuple of str to sequence
        Values by the dotted path of a field: ``loading.pressure``,
        ``interface.lower.solid.layers.0.thickness``, ``effects.friction-traction.coefficient``,
        ``accuracy.rtol``. Quantities may be texts with a unit, solids and liquids names of the
        library. Paths that vary together are one key, a tuple or one text with commas, with a row
        of values for each step: ``("loading.pressure", "accuracy.rtol"): [("1 MPa", 1e-8), ("2
        MPa", 1e-9)]``.
        Along the last key each contact starts from the solutions before it, and reuses heights and
        compliance where these are equal: choose the load, in steps of less than a half, because an
        initial guess from further away does not help. Loads are solved downwards, as in
        `load_curve`, which is simpler where nothing else varies.
    accuracy : Accuracy, optional
        Numerical settings; default `Accuracy.standard`.
    store : str or Path, optional
        Folder in which each finished point is stored. A study of the same points reads them, so
        that an interrupted study continues where it stopped.
    workers : int
        Number of processes. In a script the call then belongs under
        ``if __name__ == "__main__":``.
    client : optional
        A ``dask.distributed.Client``, or another object with ``submit(function, argument)`` that
        returns a future, to run the points on; contactkit must be installed there.
    progress : callable, optional
        Called with the completed fraction, 0 to 1.
    keep_maps : bool
        Whether to keep the complete results, with maps or curves, in `Study.results`.

    Returns
    -------
    Study
        Points in the order of the product, the last parameter fastest, for any number of workers.
        Results agree with those of a single solve to its tolerance, not to the last digit, because
        they depend on the initial guess.

    Raises
    ------
    DescriptionError
        If a path does not exist or a value is invalid; before any solve.
    PlanError
        If the effects do not fit the scene; before any solve. A point without a solution does not
        stop the study: its results are nan, its status and message state why. Nor does one that
        fails by a defect, or whose worker died three times: its status is ``failed``.

    Examples
    --------
    >>> import contactkit as ck
    >>> steel = ck.Material(name="steel", young_modulus=210e9, poisson_ratio=0.3)
    >>> scene = ck.ContactScene(
    ...     interface=ck.Interface(
    ...         lower=ck.Body(solid=steel),
    ...         upper=ck.Body(surface=ck.Wave(amplitude=1e-8, wavelength=1e-6)),
    ...     ),
    ...     window=ck.Window(width=1e-6),
    ...     loading=ck.Pressing(pressure=1e6),
    ...     effects=(ck.HalfSpace(),),
    ... )
    >>> loads = {"loading.pressure": ["1 GPa", "3 GPa"]}
    >>> print(ck.study(scene, loads, ck.Accuracy(grid=32)).table("contact_fraction"))
    pressure [Pa]  contact_fraction [-]  status
            1e+09               0.28125  converged
            3e+09               0.46875  converged
    """
    check_kind(scene)
    check_whole("workers", workers, 1)
    accuracy = accuracy if accuracy is not None else Accuracy.standard
    varied = axes(scene, accuracy, parameters)
    kept = Store(Path(store).resolve()) if store is not None else None
    run = _Run(scene, accuracy, varied, kept, keep_maps, progress, RETRIES)
    pieces = run.pieces(slots(client, workers))
    run.check(pieces)
    spread(pieces, workers, client, run.take)
    return run.finish()


def check_kind(scene: object) -> None:
    """Refuse what is no scene."""
    if not isinstance(scene, AnyScene):
        raise DescriptionError(
            "scene", scene, "be a ContactScene, a SeparationScene or a SlidingScene"
        )


def check_whole(name: str, value: object, least: int) -> None:
    """Refuse what is no whole number, or less than the least."""
    if isinstance(value, bool) or not isinstance(value, int) or value < least:
        raise DescriptionError(name, value, f"be a whole number of at least {least}")


def check_study(
    scene: ContactScene | SeparationScene | SlidingScene,
    parameters: Parameters,
    accuracy: Accuracy | None = None,
) -> tuple[Axis, ...]:
    """Refuse what `study` refuses before any solve, and return them parsed.

    Raises
    ------
    DescriptionError, PlanError
        As `study` does.
    """
    accuracy = accuracy if accuracy is not None else Accuracy.standard
    varied = axes(scene, accuracy, parameters)
    points = [changed(scene, accuracy, values) for values in combinations(varied)]
    check_effects(*points[0])
    return varied


def check_effects(scene: Scene, accuracy: Accuracy) -> tuple[str, ...]:
    """Refuse effects that do not fit the scene of a point, but no load: that is of this point.

    Returns the sources of the others; none where there is no plan.
    """
    with suppress(InfeasibleError):
        return tuple(_unprepared(scene, accuracy).cite().splitlines())
    return ()


def _unprepared(scene: Scene, accuracy: Accuracy) -> ScenePlan:
    """The plan of a point; of a contact without its heights and compliances."""
    if isinstance(scene, ContactScene):
        return unprepared_plan(scene, accuracy)
    return plan(scene, accuracy)


class _Run:
    """A running study: finished points, and points still to solve."""

    def __init__(
        self,
        scene: Scene,
        accuracy: Accuracy,
        varied: tuple[Axis, ...],
        store: Store | None,
        keeps_maps: bool,
        progress: Callable[[float], None] | None,
        retries: int = 0,
    ) -> None:
        self.scene, self.accuracy, self.varied = scene, accuracy, varied
        self.store, self.keeps_maps, self.progress = store, keeps_maps, progress
        self.retries = retries
        self.loads: dict[int, float] = {}  # or approaches, of contacts
        self.tasks = [self._task(i, values) for i, values in enumerate(combinations(varied))]
        self.points: dict[int, StudyPoint] = {}
        self.results: dict[int, AnyResult] = {}
        self.problems: dict[int, str] = {}  # with the files of points
        self.sources: dict[tuple[object, ...], tuple[str, ...]] = {}  # by choices
        if store is not None:
            store.sweep()
            for task in self.tasks:
                self._fetch(store, task)

    def _task(self, index: int, values: dict[str, Any]) -> Task:
        """Build the scene of a point, so that an invalid value is refused before any solve."""
        made = changed(self.scene, self.accuracy, values)
        if isinstance(made[0], ContactScene):
            self.loads[index] = made[0].loading.quantity.value
        return Task(index, values, self.store.key(*made) if self.store is not None else "")

    def _fetch(self, store: Store, task: Task) -> None:
        """Read a point from the store, if it is there with all that is required."""
        try:
            point = store.read(task.key, task.values)
            if point is None:
                return
            if self.keeps_maps and not point.has_failed:
                maps = store.read_maps(task.key)
                if maps is None:
                    return
                self.results[task.place] = from_bytes(maps)
            self.points[task.place] = point
        except DescriptionError as error:
            self.problems[task.place] = (
                f"solved again, because the stored point cannot be used: {error}"
            )

    def pieces(self, slots: int) -> list[Piece]:
        """Chains of points to solve, downwards, divided if there are more slots than chains."""
        length = len(self.varied[-1].values)
        left = [task for task in self.tasks if task.place not in self.points]
        chains = [
            list(chain) for _, chain in itertools.groupby(left, lambda task: task.place // length)
        ]
        if isinstance(self.scene, ContactScene):
            chains = [self._ordered(self.scene, chain) for chain in chains]
        parts = math.ceil(slots / max(len(chains), 1))
        return [
            Piece(self.scene, self.accuracy, tuple(cut), self.store, self.keeps_maps, self.retries)
            for chain in chains
            for cut in _cut(chain, parts)
        ]

    def _ordered(self, scene: ContactScene, chain: list[Task]) -> list[Task]:
        order = downwards([self.loads[task.place] for task in chain], scene)
        return [chain[i] for i in order]

    def check(self, pieces: list[Piece]) -> None:
        """Refuse effects that do not fit the scene before any solve, and report progress."""
        if pieces:
            scene, accuracy = changed(self.scene, self.accuracy, pieces[0].tasks[0].values)
            self.sources[_choices(scene)] = check_effects(scene, accuracy)
        if self.progress is not None and (self.points or not pieces):
            self.progress(len(self.points) / len(self.tasks))

    def take(self, done: Done) -> None:
        """Accept a finished point, and write it if the worker wrote to another disk."""
        place, point, maps = done
        key = self.tasks[place].key
        if self.store is not None and not self.store.has(key, maps is not None):
            point = put(self.store, key, point, maps)
        if place in self.problems:
            point = evolve(point, notes=(*point.notes, self.problems[place]))
        is_new = place not in self.points
        self.points[place] = point
        if maps is not None:
            self.results[place] = from_bytes(maps)
        if is_new and self.progress is not None:
            self.progress(len(self.points) / len(self.tasks))

    def finish(self) -> Study[Any]:
        """Assemble the points; each gets every column, nan where it has no value."""
        points = [self.points[i] for i in range(len(self.tasks))]
        if all(point.status == "refused" for point in points):
            raise PlanError(f"every point of the study is refused: {points[0].message}")
        if all(point.status == "failed" for point in points):
            raise ContactkitError(f"every point of the study failed: {points[0].message}")
        scalars = {n: unit for p in points for n, (_, unit) in p.scalars.items()}
        counts = dict.fromkeys((n for p in points for n in p.counts), "-")
        varied = {p: u for axis in self.varied for p, u in zip(axis.paths, axis.units, strict=True)}
        units = varied | scalars | {"seconds": "s"} | counts
        nothing = {name: (math.nan, unit) for name, unit in scalars.items()}
        _warn(points)
        return Study(
            tuple(evolve(p, scalars=nothing | dict(p.scalars)) for p in points),
            tuple(len(axis.values) for axis in self.varied),
            tuple(axis.paths for axis in self.varied),
            units,
            tuple(self.results.get(i) for i in range(len(points))) if self.keeps_maps else None,
            sources=self._sources(),
        )

    def _sources(self) -> tuple[str, ...]:
        """Sources of all points; those with the same choices have the same."""
        tasks = self.tasks if varies_effects(self.varied) else self.tasks[:1]
        points = (changed(self.scene, self.accuracy, task.values) for task in tasks)
        return sources_of(points, self.sources)


def varies_effects(varied: Iterable[Axis]) -> bool:
    """Whether a parameter is one of the effects, so that points may have sources of their own."""
    return any(path.startswith("effects") for axis in varied for path in axis.paths)


def sources_of(
    points: Iterable[Changed], known: dict[tuple[object, ...], tuple[str, ...]]
) -> tuple[str, ...]:
    """Sources of points, beside those known by their choices."""
    for scene, accuracy in points:
        if (choices := _choices(scene)) not in known:
            with suppress(ContactkitError):  # a point that is refused has no plan
                known[choices] = check_effects(scene, accuracy)
    return tuple(dict.fromkeys(line for one in known.values() for line in one))


def _choices(scene: Scene) -> tuple[object, ...]:
    """What decides the equations of a scene: the kinds of its effects and their choices."""
    return tuple(_choice(one) for one in (type(scene), *scene.effects))


def _choice(value: object) -> object:
    """A word as it is, a number for any other, an object by its kind and its own choices."""
    if value is None or isinstance(value, str | bool | type):
        return value
    kind = type(value)
    if not has(kind):
        return kind
    return (kind, *(_choice(getattr(value, one.name)) for one in fields(kind)))


def _warn(points: list[StudyPoint]) -> None:
    """One warning for all points outside the range of a model."""
    outside = [
        note for p in points for note in p.notes if note.startswith(ValidityWarning.__name__)
    ]
    if outside:
        n = sum(any(note in outside for note in p.notes) for p in points)
        texts = [note.partition(": ")[2] for note in outside]
        names = list(dict.fromkeys(text.partition(" = ")[0] for text in texts))
        also = f" (also: {', '.join(names[1:])})" if names[1:] else ""
        warnings.warn(
            f"{n} of {len(points)} points are outside the range of a model: {texts[0]}{also}",
            ValidityWarning,
            stacklevel=4,
        )


def _cut(chain: list[Task], parts: int) -> Iterator[list[Task]]:
    """Divide a chain into parts of nearly equal length."""
    parts = min(parts, len(chain))
    ends = [len(chain) * i // parts for i in range(parts + 1)]
    for first, last in itertools.pairwise(ends):
        yield chain[first:last]


def slots(client: Any, workers: int) -> int:
    """Number of pieces that can run at once."""
    threads = getattr(client, "nthreads", None)
    return max(workers, sum(threads().values()) if callable(threads) else 1)


def spread(
    pieces: Iterable[Piece], workers: int, client: Any, take: Callable[[Done], None]
) -> None:
    """Run pieces where they are to run: on a client, in processes, or here."""
    if client is not None:
        run_on_client(pieces, client, slots(client, workers), take)
    elif workers > 1 and not (isinstance(pieces, list) and len(pieces) < 2):
        run_in_processes(pieces, workers, take)
    else:
        run_here(pieces, take)
