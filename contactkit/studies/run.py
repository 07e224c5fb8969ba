"""Pieces of a study: points that are solved one after the other, and the worker that does it."""

from __future__ import annotations

import os
import pickle
import threading
import time
import warnings
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from typing import Any, NamedTuple

from attrs import evolve, frozen

from ..accuracy import Accuracy
from ..contact.chain import ContactChain
from ..contact.effects.base import Attraction
from ..contact.plan import ContactPlan, unprepared_plan
from ..errors import ContactkitError, ConvergenceError, InfeasibleError
from ..files.results import AnyResult, to_bytes
from ..planning import plan, run
from ..scene.scenes import ContactScene
from ..validity import warn
from .paths import Scene, changed
from .store import Store, StudyPoint

__all__ = [
    "Done",
    "Piece",
    "Task",
    "begin_worker",
    "end_with_parent",
    "one_thread",
    "put",
    "run_in_worker",
    "run_remotely",
    "unpacked",
]

_PINNED = (
    "OMP_NUM_THREADS",
    "OPENBLAS_NUM_THREADS",
    "MKL_NUM_THREADS",
    "BLIS_NUM_THREADS",
    "VECLIB_MAXIMUM_THREADS",
    "NUMBA_NUM_THREADS",
)


class Task(NamedTuple):
    """A point to solve: its index in the study, its parameters, its key in the store."""

    place: int
    values: Mapping[str, Any]
    key: str


@frozen(eq=False)
class Piece:
    """Points that are solved in sequence, each starting from the solutions before it."""

    scene: Scene
    accuracy: Accuracy
    tasks: tuple[Task, ...]
    store: Store | None
    keeps_maps: bool
    retries: int = 0

    def run(self) -> Iterator[Done]:
        """Solve the points, and write each to the store when it is finished."""
        chain = _Chain()
        for task in self.tasks:
            point, result = _solved(chain, self, task)
            maps = to_bytes(result) if self.keeps_maps and result is not None else None
            if self.store is not None:
                point = put(self.store, task.key, point, maps)
            yield Done(task.place, point, maps)


class Done(NamedTuple):
    """A finished point, and its result as bytes if maps are kept."""

    place: int
    point: StudyPoint
    maps: bytes | None


class _Chain:
    """State passed from one solve to the next: plan, and contacts for the initial guess."""

    def __init__(self) -> None:
        self._plan: ContactPlan | None = None
        self._contacts = ContactChain()

    def clear(self) -> None:
        """Start anew, after a solve that ended in the middle."""
        self._plan, self._contacts = None, ContactChain()

    def run(self, scene: Scene, accuracy: Accuracy) -> Any:
        if not isinstance(scene, ContactScene):
            return run(plan(scene, accuracy))
        made = unprepared_plan(scene, accuracy)
        if self._plan is not None and not made.has_interface_of(self._plan):
            self._plan = None  # before the next one, so that two solvers are never in memory
            self._contacts.change_interface()
        self._plan = made.prepare(like=self._plan)
        # With several states a start decides which is found: that of a point is its own.
        is_alone = scene.effect(Attraction) is not None
        chain = ContactChain() if is_alone else self._contacts
        result = chain.solve(self._plan)
        warn(result.validity)
        return result


def put(store: Store, key: str, point: StudyPoint, maps: bytes | None) -> StudyPoint:
    """Write a point, unless it was refused or failed: the cure may lie outside the scene.

    A point that cannot be written, to a full disk for example, is returned with a note of that.
    """
    if point.status in ("refused", "failed"):
        return point
    try:
        store.write(key, point, maps)
    except OSError as error:
        note = f"not stored: {error.strerror or error}"
        return evolve(point, notes=(*(n for n in point.notes if n != note), note))
    return point


def _solved(chain: _Chain, piece: Piece, task: Task) -> tuple[StudyPoint, AnyResult | None]:
    """Solve a point; what may pass, such as a full disk or memory, is tried again."""
    begun = time.perf_counter()
    result: AnyResult | None = None
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        for attempt in range(piece.retries + 1):
            if attempt:
                time.sleep(min(0.1 * 2**attempt, 10.0))
            try:
                answer = chain.run(*changed(piece.scene, piece.accuracy, task.values))
                scalars, result = answer.scalars(), answer
                break
            except InfeasibleError as error:
                status, message = "infeasible", str(error)
                break
            except ConvergenceError as error:
                status, message = "not converged", str(error)
                break
            except ContactkitError as error:
                status, message = "refused", str(error)
                break
            except Exception as error:  # noqa: BLE001 - a defect costs its point, not the others
                status, message = "failed", f"{type(error).__name__}: {error}"
                chain.clear()
                if not isinstance(error, OSError | MemoryError):
                    break
    seconds = time.perf_counter() - begun
    notes = tuple(dict.fromkeys(f"{w.category.__name__}: {w.message}" for w in caught))
    if result is None:
        return StudyPoint(task.values, {}, status, message, seconds, {}, notes), None
    work = result.work._asdict()
    counts = {name: int(n) for name, n in work.items() if name.startswith("n_")}
    said = (result.status, result.message)
    point = StudyPoint(
        task.values, scalars, *said, seconds, counts, notes, scales=dict(result.scales)
    )
    return point, result


# In a worker process -------------------------------------------------------------------------

BEGUN = "begun"
"""First report of a worker; those after it are finished points."""

# Seconds of a piece on a client, after which what is done is sent back and the rest submitted
# again: an interrupted study loses no more. Shorter ones would mean more traffic.
_LONG = 10.0
# Bytes of a report. A writer of more than a pipe holds (2**16 on Linux and macOS) waits for a
# reader, and one that dies meanwhile leaves half a report behind; larger results return with the
# piece.
_REPORT = 2**15

_worker: dict[str, Any] = {}


def unpacked(sent: bytes) -> Any:
    """Return what a piece in a worker process of this one has pickled."""
    return pickle.loads(sent)


def run_remotely(piece: bytes) -> list[Done]:
    """Solve a pickled piece, on a client of any kind; the rest of a long one is sent again."""
    begun, found = time.perf_counter(), list[Done]()
    for done in pickle.loads(piece).run():
        found.append(done)
        if time.perf_counter() - begun > _LONG:
            break
    return found


def begin_worker(reports: Any, stop: Any) -> None:
    """Set up a worker process: it ends with its parent, which decides when to stop."""
    import signal

    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the starting process decides when to stop
    _worker.update(reports=reports, stop=stop)
    reports.put(BEGUN)
    threading.Thread(target=end_with_parent, daemon=True).start()


def end_with_parent() -> None:
    """End this process when its parent has been killed."""
    from multiprocessing import parent_process

    parent = parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)


def run_in_worker(piece: bytes) -> list[Done]:
    """Solve a pickled piece in a worker process, and report each point as it is finished.

    Maps, and a point with long messages, are returned at the end: what is reported has to fit into
    a pipe, so that a worker that is killed leaves no half of it.
    """
    left = []
    for done in pickle.loads(piece).run():
        reported = done._replace(maps=None)
        is_small = len(pickle.dumps(reported)) < _REPORT
        if is_small:
            _worker["reports"].put(reported)
        if done.maps is not None or not is_small:
            left.append(done)
        if _worker["stop"].is_set():
            break
    return left


@contextmanager
def one_thread() -> Iterator[None]:
    """Environment in which started processes use one thread each."""
    before = {name: os.environ.get(name) for name in _PINNED}
    os.environ.update(dict.fromkeys(_PINNED, "1"))
    try:
        yield
    finally:
        for name, value in before.items():
            if value is None:
                del os.environ[name]
            else:
                os.environ[name] = value
