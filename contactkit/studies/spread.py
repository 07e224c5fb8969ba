"""Spreading of pieces: in this process, over worker processes, or on a client; with retries."""

from __future__ import annotations

import pickle
import queue
import time
import warnings
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures.process import BrokenProcessPool, ProcessPoolExecutor
from contextlib import contextmanager
from typing import Any

from attrs import evolve

from ..errors import ContactkitError
from .run import (
    BEGUN,
    Done,
    Piece,
    begin_worker,
    one_thread,
    run_in_worker,
    run_remotely,
)
from .store import StudyPoint

__all__ = ["Take", "processes", "run_here", "run_in_processes", "run_on_client"]

Take = Callable[[Done], None]
"""Takes a finished point; one whose maps arrive later is taken twice, first without them."""

# Pieces submitted for each that can run at once: with one a worker waits until its next is sent,
# with many an interrupted study has more to wait for, and more of them are in memory.
_AHEAD = 3
_TICK = 0.1  # seconds between looks at what the workers report: seen as at once, and no load
_DIED = (
    "a worker process ended before its points did, for lack of memory or because the script starts "
    "the study outside `if __name__ == '__main__':`"
)


def run_here(pieces: Iterable[Piece], take: Take) -> None:
    """Run pieces in sequence in this process."""
    for piece in pieces:
        for done in piece.run():
            take(done)


def run_in_processes(pieces: Iterable[Piece], workers: int, take: Take) -> None:
    """Run pieces in worker processes, each with one thread; points are taken as they are finished.

    If this process is interrupted, each worker finishes its current point, which is taken, too; if
    this process is killed, the workers end at once. If a worker dies, the points that were under
    way are solved again, one at a time; one at which workers die as often as it may be retried, and
    once more, has failed.

    Raises
    ------
    ContactkitError
        If workers die before they have begun.
    """
    with processes(workers, take) as run:
        run(pieces, take)


@contextmanager
def processes(
    workers: int, last: Take = lambda done: None
) -> Iterator[Callable[[Iterable[Piece], Take], None]]:
    """Worker processes that run pieces time and again, as `run_in_processes` does once.

    `last` takes the points that are finished when the processes end.
    """
    pool = _Processes(workers)
    try:
        yield lambda pieces, take: _Spread(pool, workers * _AHEAD, take).run(pieces)
    finally:
        pool.close(last)


def run_on_client(pieces: Iterable[Piece], client: Any, slots: int, take: Take) -> None:
    """Run pieces on a client with ``submit(function, argument)`` that returns a future.

    A piece that the client loses, with its workers for example, is submitted again point by point.
    """
    _Spread(_Client(client), slots * _AHEAD, take).run(pieces)


class _Client:
    """Submits pieces to a client, which replaces workers that end itself."""

    finds_culprit = True

    def __init__(self, client: Any) -> None:
        self._client = client

    def submit(self, piece: Piece) -> Any:
        with warnings.catch_warnings():
            # Height maps make a piece large; each is transferred once, so the warning is no use.
            warnings.simplefilter("ignore")
            return self._client.submit(run_remotely, pickle.dumps(piece))

    def watch(self, take: Take) -> None:
        """Nothing to do while waiting."""

    def renew(self, take: Take) -> None:
        """The client has done it."""


class _Processes:
    """Worker processes; all of them end when one dies, so that the culprit must be found."""

    finds_culprit = False

    def __init__(self, workers: int) -> None:
        from multiprocessing import get_context

        self._context = get_context("spawn")  # a fork would inherit the locks of threads
        self._workers, self._has_begun = workers, False
        self._begin()

    def _begin(self) -> None:
        # Anew each time: a process that was killed may have held a lock of the former ones.
        self._reports, self._stop = self._context.SimpleQueue(), self._context.Event()
        given = (self._reports, self._stop)
        self._pool = ProcessPoolExecutor(self._workers, self._context, begin_worker, given)
        self._submitted = list[Any]()

    def submit(self, piece: Piece) -> Any:
        with one_thread():
            future = self._pool.submit(run_in_worker, pickle.dumps(piece))
        self._submitted = [*(one for one in self._submitted if not one.done()), future]
        return future

    def watch(self, take: Take) -> None:
        """Take the points that the workers have reported."""
        while not self._reports.empty():
            report = self._reports.get()
            if report == BEGUN:
                self._has_begun = True
            else:
                take(report)

    def renew(self, take: Take) -> None:
        """Start other workers."""
        self.watch(take)
        if not self._has_begun:
            raise ContactkitError(f"{_DIED}; with a store, running it again continues")
        self._pool.shutdown()
        self._begin()

    def close(self, take: Take) -> None:
        """End the workers, and take the points that they finish before."""
        self._stop.set()
        for one in self._submitted:
            one.cancel()
        while not all(one.done() for one in self._submitted):
            self.watch(take)  # a worker waits where nobody reads
            time.sleep(0.1 * _TICK)
        self.watch(take)
        # Waits for workers that still begin, too: they would miss the queue of reports.
        self._pool.shutdown()


class _Spread:
    """Pieces under way, those that wait, and those that were lost and are tried again."""

    def __init__(self, executor: _Client | _Processes, window: int, take: Take) -> None:
        self._executor, self._window, self._give = executor, window, take
        self._taken = dict[int, bool]()  # points by their places, and whether they lack nothing
        self._running: dict[Any, tuple[Piece, bool]] = {}  # and whether it is at fault if lost
        self._ended: queue.SimpleQueue[Any] = queue.SimpleQueue()
        self._again: deque[Piece] = deque()
        self._losses: dict[int, int] = {}  # of a point, by its place

    def run(self, pieces: Iterable[Piece]) -> None:
        """Run pieces, and take their points as they arrive."""
        waiting = iter(pieces)
        try:
            while self._fill(waiting):
                future = self._next()
                piece, is_at_fault = self._running.pop(future)
                self._executor.watch(self._take)
                try:
                    found = future.result()
                except Exception as error:  # noqa: BLE001 - of the worker, not of a point
                    self._lose(self._left(piece), is_at_fault, error)
                    continue
                for done in found:
                    self._take(done)
                left = self._left(piece)
                if left.tasks:  # a client ends a long piece early
                    self._again.append(left)
                for task in piece.tasks:
                    self._taken.pop(task.place, None)
        finally:
            for future in self._running:
                future.cancel()

    def _take(self, done: Done) -> None:
        self._taken[done.place] = done.maps is not None or done.point.has_failed
        self._give(done)

    def _left(self, piece: Piece) -> Piece:
        """What is not solved of a piece."""
        is_missing = {t.place: not self._taken.get(t.place, False) for t in piece.tasks}
        if not piece.keeps_maps:
            is_missing = {place: place not in self._taken for place in is_missing}
        return evolve(piece, tasks=tuple(t for t in piece.tasks if is_missing[t.place]))

    def _fill(self, waiting: Iterator[Piece]) -> bool:
        """Submit pieces while there is room; whether any is under way."""
        # Where a death ends all workers, suspects run alone: the one at which they die is at fault.
        is_alone = bool(self._again) and not self._executor.finds_culprit
        window = 1 if is_alone else self._window
        while len(self._running) < window:
            piece = self._again.popleft() if self._again else next(waiting, None)
            if piece is None:
                break
            try:
                future = self._executor.submit(piece)
            except BrokenProcessPool:
                self._executor.renew(self._take)
                future = self._executor.submit(piece)
            self._running[future] = (piece, is_alone or self._executor.finds_culprit)
            future.add_done_callback(self._ended.put)
        return bool(self._running)

    def _next(self) -> Any:
        """Future that ends first."""
        while True:
            self._executor.watch(self._take)
            try:
                return self._ended.get(timeout=_TICK)
            except queue.Empty:
                continue

    def _lose(self, piece: Piece, is_at_fault: bool, error: Exception) -> None:
        """Try the points of a lost piece again; those that were lost too often have failed."""
        if isinstance(error, BrokenProcessPool) and not self._running:
            self._executor.renew(self._take)
        is_guilty = is_at_fault and len(piece.tasks) == 1
        for task in piece.tasks:
            losses = self._losses[task.place] = self._losses.get(task.place, 0) + is_guilty
            if losses > piece.retries:
                why = _DIED if isinstance(error, BrokenProcessPool) else f"its worker: {error!r}"
                point = StudyPoint(task.values, {}, "failed", f"lost {losses} times: {why}", 0.0)
                self._take(Done(task.place, point, None))
            else:
                self._again.append(evolve(piece, tasks=(task,)))
