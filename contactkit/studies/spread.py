"""Spreading of pieces: in this process, over worker processes, or on a client; with retries."""

from __future__ import annotations

import pickle
import queue
import warnings
from collections import deque
from collections.abc import Callable, Generator, Iterable, Iterator
from concurrent.futures.process import BrokenProcessPool, ProcessPoolExecutor
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
    run_piece,
    run_remotely,
)
from .store import StudyPoint

__all__ = ["run_here", "run_in_processes", "run_on_client"]

Report = Callable[[], None]
Found = Generator[list[Done], None, None]

_AHEAD = 3  # pieces under way for each that can run at once: nobody waits, and few are in memory
_DIED = (
    "a worker process ended before its points did, for lack of memory or because the script starts "
    "the study outside `if __name__ == '__main__':`"
)


def run_here(pieces: Iterable[Piece], report: Report) -> Found:
    """Run pieces in sequence in this process."""
    for piece in pieces:
        yield run_piece(piece, report)


def run_in_processes(pieces: Iterable[Piece], workers: int, report: Report) -> Found:
    """Run pieces in worker processes, each with one thread.

    If this process is interrupted, each worker finishes its current point and writes it; if this
    process is killed, the workers end at once. If a worker dies, the points that were under way
    are solved again, one at a time; one at which workers die as often as it may be retried, and
    once more, has failed.

    Raises
    ------
    ContactkitError
        If workers die before they have begun.
    """
    pool = _Processes(workers, report)
    try:
        yield from _Spread(pool, workers * _AHEAD).run(pieces)
    finally:
        pool.close()


def run_on_client(pieces: Iterable[Piece], client: Any, slots: int, report: Report) -> Found:
    """Run pieces on a client with ``submit(function, argument)`` that returns a future.

    A piece that the client loses, with its workers for example, is submitted again point by point.
    """
    spread = _Spread(_Client(client), slots * _AHEAD)
    for found in spread.run(pieces):
        for _ in found:
            report()
        yield found


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

    def watch(self) -> None:
        """Nothing to do while waiting."""

    def renew(self) -> None:
        """The client has done it."""


class _Processes:
    """Worker processes; all of them end when one dies, so that the culprit must be found."""

    finds_culprit = False

    def __init__(self, workers: int, report: Report) -> None:
        from multiprocessing import get_context

        self._context = get_context("spawn")  # a fork would inherit the locks of threads
        self._workers, self._report, self._has_begun = workers, report, False
        self._begin()

    def _begin(self) -> None:
        # Anew each time: a process that was killed may have held a lock of the former ones.
        self._reports, self._stop = self._context.SimpleQueue(), self._context.Event()
        given = (self._reports, self._stop)
        self._pool = ProcessPoolExecutor(self._workers, self._context, begin_worker, given)

    def submit(self, piece: Piece) -> Any:
        with one_thread():
            return self._pool.submit(run_in_worker, pickle.dumps(piece))

    def watch(self) -> None:
        """Pass on the reports of finished points."""
        while not self._reports.empty():
            if self._reports.get() == BEGUN:
                self._has_begun = True
            else:
                self._report()

    def renew(self) -> None:
        """Start other workers."""
        self.watch()
        if not self._has_begun:
            raise ContactkitError(f"{_DIED}; with a store, running it again continues")
        self._pool.shutdown()
        self._begin()

    def close(self) -> None:
        self._stop.set()
        self._pool.shutdown(cancel_futures=True)


class _Spread:
    """Pieces under way, those that wait, and those that were lost and are tried again."""

    def __init__(self, executor: _Client | _Processes, window: int) -> None:
        self._executor, self._window = executor, window
        self._running: dict[Any, tuple[Piece, bool]] = {}  # and whether it is at fault if lost
        self._ended: queue.SimpleQueue[Any] = queue.SimpleQueue()
        self._again: deque[Piece] = deque()
        self._losses: dict[int, int] = {}  # of a point, by its place

    def run(self, pieces: Iterable[Piece]) -> Found:
        """Yield the points of pieces as they end."""
        waiting = iter(pieces)
        try:
            while self._fill(waiting):
                future = self._next()
                piece, is_at_fault = self._running.pop(future)
                try:
                    found = future.result()
                except Exception as error:  # noqa: BLE001 - of the worker, not of a point
                    found = self._lost(piece, is_at_fault, error)
                self._executor.watch()
                if found:
                    yield found
        finally:
            for future in self._running:
                future.cancel()

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
                self._executor.renew()
                future = self._executor.submit(piece)
            self._running[future] = (piece, is_alone or self._executor.finds_culprit)
            future.add_done_callback(self._ended.put)
        return bool(self._running)

    def _next(self) -> Any:
        """Future that ends first."""
        while True:
            self._executor.watch()
            try:
                return self._ended.get(timeout=0.1)
            except queue.Empty:
                continue

    def _lost(self, piece: Piece, is_at_fault: bool, error: Exception) -> list[Done]:
        """Try the points of a lost piece again; those that were lost too often have failed."""
        if isinstance(error, BrokenProcessPool) and not self._running:
            self._executor.renew()
        done = []
        for task in piece.tasks:
            is_guilty = is_at_fault and len(piece.tasks) == 1
            losses = self._losses[task.place] = self._losses.get(task.place, 0) + is_guilty
            if losses > piece.retries:
                why = _DIED if isinstance(error, BrokenProcessPool) else f"its worker: {error!r}"
                point = StudyPoint(task.values, {}, "failed", f"lost {losses} times: {why}", 0.0)
                done.append(Done(task.place, point, None))
            else:
                self._again.append(evolve(piece, tasks=(task,)))
        return done
