"""Runs of a scene at values of its fields: outcomes and exact slopes, each made once."""

from __future__ import annotations

import math
import pickle
import time
import warnings
from collections import OrderedDict
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, NamedTuple, TypeVar

import numpy as np
from attrs import field, frozen

from ..accuracy import Accuracy
from ..errors import ContactkitError, DescriptionError, NotSimulatedError, ValidityWarning
from ..scene.loading import ImposedSpeed
from ..scene.scenes import ContactScene
from ..studies.gradients.contact import SharedChanges
from ..studies.gradients.curve import curve_slopes
from ..studies.gradients.of_result import gradient_of, runs_of_gradient
from ..studies.paths import changed
from ..studies.run import Done, Piece, Task, unpacked
from ..studies.spread import Take, processes
from ..studies.store import StudyPoint
from .outcomes import Outcome, Solve, outcome_of

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

__all__ = ["Asked", "Run", "Runs", "Solver"]

# Outcomes that are kept: those of a Jacobian by differences share their base and the runs of which
# only a nuisance differs.
_KEPT = 512
_SAME = 1e-9  # between a number and that of its gradient, which may be another one of that name
# Pieces for each worker: with one the last to end is waited for, and each takes the scene along.
_PIECES = 2

T = TypeVar("T")
Key = tuple[Any, ...]


class Run(NamedTuple):
    """Values of fields of the scene, by path, and names of what is read from the run."""

    changes: Mapping[str, Any]
    names: tuple[str, ...]

    @property
    def key(self) -> Key:
        """The same for equal runs."""
        return self.names, repr(sorted(self.changes.items()))


class Asked(NamedTuple):
    """Slopes that are asked of a run: of a number, or of a column at some positions of another."""

    quantity: str
    paths: tuple[str, ...]
    over: str = ""
    at: tuple[float, ...] = ()


@frozen(eq=False)
class Solver:
    """Scene and the function that runs it; with `has_slopes` its results are those of the scene."""

    scene: Any
    accuracy: Accuracy
    solve: Solve
    has_slopes: bool
    _shared: SharedChanges = field(factory=SharedChanges, init=False, repr=False)

    def may_have(self, asked: Asked) -> bool:
        """Whether slopes may be known, and cost less than differences: decided without a run."""
        if not (self.has_slopes and asked.paths):
            return False
        if asked.over:
            return asked.over == "gap" and isinstance(self.scene.loading, ImposedSpeed)
        return runs_of_gradient(self.scene, len(asked.paths)) <= len(asked.paths)

    @property
    def is_adjoint(self) -> bool:
        """Whether slopes cost less than a run: those of a contact."""
        return self.has_slopes and isinstance(self.scene, ContactScene)

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickle what it was made from."""
        return Solver, (self.scene, self.accuracy, self.solve, self.has_slopes)

    def result(self, run: Run) -> Any:
        """Return the result of a run; an error of it is raised."""
        scene = changed(self.scene, self.accuracy, run.changes).scene
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", ValidityWarning)  # the fit states the numbers itself
            return self.solve(scene)

    def slopes(self, result: Any, asked: Asked) -> dict[str, Floats]:
        """Exact slopes by path, as far as they are known."""
        if not self.may_have(asked):
            return {}
        found: dict[str, Floats] = {}
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", ValidityWarning)
            try:
                return self._slopes(result, asked)
            except ContactkitError:
                for path in asked.paths if len(asked.paths) > 1 else ():
                    try:
                        found |= self._slopes(result, asked._replace(paths=(path,)))
                    except ContactkitError:
                        continue
        return found

    def _slopes(self, result: Any, asked: Asked) -> dict[str, Floats]:
        if asked.over:
            return curve_slopes(result, asked.quantity, asked.at, asked.paths)
        gradient = gradient_of(result, asked.quantity, asked.paths, self._shared)
        value = result.scalars()[asked.quantity][0]
        if not abs(gradient.value - value) <= _SAME * abs(value):
            raise NotSimulatedError(f"{asked.quantity} is another number in gradients")
        return {path: np.array([gradient[path]]) for path in asked.paths}


class Runs:
    """Runs of a scene, of which outcomes and slopes are kept."""

    def __init__(self, solver: Solver) -> None:
        self.solver = solver
        self.n = 0
        self.n_together = 1
        """Runs of one prediction: of so many the results are kept, for their slopes."""
        self._outcomes: OrderedDict[Key, Outcome | ContactkitError] = OrderedDict()
        self._results: OrderedDict[Key, Any] = OrderedDict()
        self._slopes: OrderedDict[Key, dict[str, Floats]] = OrderedDict()
        self._spread: Callable[[Iterable[Piece], Take], None] | None = None
        self._n_workers = 1

    def outcome(self, run: Run) -> Outcome:
        """Outcome of a run; an error of it is raised."""
        key = run.key
        if key not in self._outcomes:
            _keep(self._outcomes, key, outcome_of(self._result(run), run.names), _KEPT)
        self._outcomes.move_to_end(key)
        found = self._outcomes[key]
        if isinstance(found, ContactkitError):
            raise found
        return found

    def slopes(self, run: Run, asked: Asked) -> dict[str, Floats]:
        """Exact slopes of what is asked, by path; those that are not known are left out."""
        key = (run.key, asked)
        if key not in self._slopes:
            found: dict[str, Floats] = {}
            if self.solver.may_have(asked):
                given = self._results.get(run.key)
                found = self.solver.slopes(self._result(run) if given is None else given, asked)
            _keep(self._slopes, key, found, _KEPT)
        self._slopes.move_to_end(key)
        return self._slopes[key]

    def _result(self, run: Run) -> Any:
        self.n += 1
        found = self.solver.result(run)
        if self.solver.has_slopes:
            _keep(self._results, run.key, found, self.n_together)
        return found

    @contextmanager
    def workers(self, n: int) -> Iterator[None]:
        """Have so many processes make the runs that `ahead` names.

        Raises
        ------
        DescriptionError
            If the function that runs the scene cannot be sent to them.
        """
        if n == 1:
            yield
            return
        try:
            pickle.dumps(self.solver)
        except (pickle.PicklingError, AttributeError, TypeError) as error:
            hint = f"{error}; write solve= as a function of a module, without lambda"
            raise DescriptionError("workers", n, "be 1 with this solve=", hint=hint) from None
        with processes(n) as self._spread:
            self._n_workers = n
            try:
                yield
            finally:
                self._spread = None

    def ahead(self, jobs: Iterable[tuple[Run, Asked | None]]) -> None:
        """Make runs in the worker processes, if there are any, before each is asked for.

        Raises
        ------
        ContactkitError
            If a worker died with a run.
        """
        if self._spread is None:
            return
        wanted = {(run.key, asked): (run, asked) for run, asked in jobs}
        missing = [pair for key, pair in wanted.items() if self._is_missing(*key)]
        if len(missing) < 2:
            return

        def take(done: Done) -> None:
            if done.point.status == "failed":
                raise ContactkitError(f"a run of the fit failed: {done.point.message}")
            if done.maps is not None:
                self._take(missing[done.place], unpacked(done.maps))

        size = math.ceil(len(missing) / (_PIECES * self._n_workers))
        tasks = [
            Task(i, {"run": run, "asked": asked}, "") for i, (run, asked) in enumerate(missing)
        ]
        parts = (tuple(tasks[i : i + size]) for i in range(0, len(tasks), size))
        solver = self.solver
        given = (solver.scene, solver.accuracy)
        self._spread((Batch(*given, part, None, True, solver=solver) for part in parts), take)

    def _is_missing(self, key: Key, asked: Asked | None) -> bool:
        if asked is not None:
            return self.solver.may_have(asked) and (key, asked) not in self._slopes
        return key not in self._outcomes

    def _take(self, pair: tuple[Run, Asked | None], found: Made) -> None:
        run, asked = pair
        self.n += 1
        _keep(self._outcomes, run.key, found.outcome, _KEPT)
        if asked is not None:
            _keep(self._slopes, (run.key, asked), found.slopes, _KEPT)


def _keep(kept: OrderedDict[Key, T], key: Key, value: T, most: int) -> None:
    kept[key] = value
    kept.move_to_end(key)
    while len(kept) > most:
        kept.popitem(last=False)


class Made(NamedTuple):
    """Outcome of a run in a worker, or its error, and slopes if they were asked for."""

    outcome: Outcome | ContactkitError
    slopes: dict[str, Floats]


@frozen(eq=False)
class Batch(Piece):
    """Runs of a fit that a worker makes."""

    solver: Solver = field(kw_only=True)

    def run(self) -> Iterator[Done]:
        """See `Piece.run`."""
        for task in self.tasks:
            begun = time.perf_counter()
            made = _made(self.solver, task.values["run"], task.values["asked"])
            point = StudyPoint({}, {}, "converged", "", time.perf_counter() - begun)
            yield Done(task.place, point, pickle.dumps(made))


def _made(solver: Solver, run: Run, asked: Asked | None) -> Made:
    try:
        result = solver.result(run)
        outcome = outcome_of(result, run.names)
    except ContactkitError as error:
        return Made(_light(error), {})
    return Made(outcome, {} if asked is None else solver.slopes(result, asked))


def _light(error: ContactkitError) -> ContactkitError:
    """An error without the result that it may carry, which may not be sent."""
    if isinstance(error, DescriptionError):
        return error
    return type(error)(str(error))
