"""Execution of the pieces of a study: in this process, in worker processes, or on a client."""

from __future__ import annotations

import os
import pickle
import queue
import threading
import time
import warnings
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures.process import BrokenProcessPool, ProcessPoolExecutor
from contextlib import contextmanager
from typing import Any, NamedTuple

from attrs import frozen

from ..accuracy import Accuracy
from ..contact.chain import ContactChain
from ..contact.effects.base import Attraction
from ..contact.plan import ContactPlan, unprepared_plan
from ..errors import ContactkitError, ConvergenceError, InfeasibleError
from ..files.results import AnyResult, to_bytes
from ..planning import plan
from ..scene.scenes import ContactScene
from ..scene.validity import warn
from ..separation.simulate import simulate
from .paths import Scene, changed
from .store import Store, StudyPoint

__all__ = [
    "Done",
    "Piece",
    "Task",
    "end_with_parent",
    "one_thread",
    "put",
    "run_here",
    "run_in_processes",
    "run_on_client",
    "run_piece",
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

    def run(self, scene: Scene, accuracy: Accuracy) -> AnyResult:
        if not isinstance(scene, ContactScene):
            return simulate(plan(scene, accuracy))
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


def run_piece(
    piece: Piece,
    report: Callable[[], None] | None = None,
    is_stopped: Callable[[], bool] | None = None,
) -> list[Done]:
    """Solve the points of a piece, and write each to the store when it is finished."""
    chain, found = _Chain(), []
    for task in piece.tasks:
        if is_stopped is not None and is_stopped():
            break
        point, result = _solved(chain, piece, task)
        maps = to_bytes(result) if piece.keeps_maps and result is not None else None
        if piece.store is not None:
            put(piece.store, task.key, point, maps)
        found.append(Done(task.place, point, maps))
        if report is not None:
            report()
    return found


def put(store: Store, key: str, point: StudyPoint, maps: bytes | None) -> None:
    """Write a point, unless it was refused: the cure may lie outside the scene."""
    if point.status != "refused":
        store.write(key, point, maps)


def _solved(chain: _Chain, piece: Piece, task: Task) -> tuple[StudyPoint, AnyResult | None]:
    scene, accuracy = changed(piece.scene, piece.accuracy, task.values)
    begun = time.perf_counter()
    result: AnyResult | None = None
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        try:
            answer = chain.run(scene, accuracy)
            scalars, result = answer.scalars(), answer
        except InfeasibleError as error:
            status, message = "infeasible", str(error)
        except ConvergenceError as error:
            status, message = "not converged", str(error)
        except ContactkitError as error:
            status, message = "refused", str(error)
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


def run_here(pieces: Sequence[Piece], report: Callable[[], None]) -> Iterator[list[Done]]:
    """Run pieces in sequence in this process."""
    for piece in pieces:
        yield run_piece(piece, report)


def run_in_processes(
    pieces: Sequence[Piece], workers: int, report: Callable[[], None]
) -> Iterator[list[Done]]:
    """Run pieces in worker processes, each with one thread.

    If this process is interrupted, each worker finishes its current point and writes it; if this
    process is killed, the workers end at once.

    Raises
    ------
    ContactkitError
        If a worker dies.
    """
    from multiprocessing import get_context

    context = get_context("spawn")  # a fork would inherit the locks of threads
    reports, stop = context.SimpleQueue(), context.Event()
    n = min(workers, len(pieces))
    with ProcessPoolExecutor(n, context, _begin_worker, (reports, stop)) as pool:
        try:
            with one_thread():
                futures = [pool.submit(_run_in_worker, pickle.dumps(piece)) for piece in pieces]
            for found in _as_they_end(futures, lambda: _drain(reports, report)):
                _drain(reports, report)
                yield found
        except BrokenProcessPool:
            raise ContactkitError(
                "a worker process ended before its points did, for lack of memory or because the "
                "script starts the study outside `if __name__ == '__main__':`; with a store, "
                "running it again continues where it stopped"
            ) from None
        finally:
            stop.set()
            pool.shutdown(cancel_futures=True)


def run_on_client(
    pieces: Sequence[Piece], client: Any, report: Callable[[], None]
) -> Iterator[list[Done]]:
    """Run pieces on a client with ``submit(function, argument)`` that returns a future."""
    futures = []
    try:
        with warnings.catch_warnings():
            # Height maps make a piece large; each is transferred once, so the warning is no use.
            warnings.simplefilter("ignore")
            futures += [client.submit(_run_remotely, pickle.dumps(piece)) for piece in pieces]
        for found in _as_they_end(futures, lambda: None):
            for _ in found:
                report()
            yield found
    finally:
        for future in futures:
            if not future.done():
                future.cancel()


def _as_they_end(futures: Sequence[Any], meanwhile: Callable[[], None]) -> Iterator[list[Done]]:
    """Results of futures of any kind, in the order in which they finish."""
    ended: queue.SimpleQueue[Any] = queue.SimpleQueue()
    for future in futures:
        future.add_done_callback(ended.put)
    for _ in futures:
        while True:
            meanwhile()
            try:
                future = ended.get(timeout=0.1)
                break
            except queue.Empty:
                continue
        yield future.result()


def _run_remotely(piece: bytes) -> list[Done]:
    return run_piece(pickle.loads(piece))


# In a worker process -------------------------------------------------------------------------

_worker: dict[str, Any] = {}


def _begin_worker(reports: Any, stop: Any) -> None:
    import signal

    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the starting process decides when to stop
    _worker.update(reports=reports, stop=stop)
    threading.Thread(target=end_with_parent, daemon=True).start()


def end_with_parent() -> None:
    """End this process when its parent has been killed."""
    from multiprocessing import parent_process

    parent = parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)


def _run_in_worker(piece: bytes) -> list[Done]:
    reports, stop = _worker["reports"], _worker["stop"]
    return run_piece(pickle.loads(piece), lambda: reports.put(None), stop.is_set)


def _drain(reports: Any, report: Callable[[], None]) -> None:
    while not reports.empty():
        reports.get()
        report()


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
