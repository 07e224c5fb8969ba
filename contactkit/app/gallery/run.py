"""Running pages on all cores, in processes of one thread each; finished data are kept."""

from __future__ import annotations

import json
import os
import sys
import threading
import time
import warnings
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from concurrent.futures.process import BrokenProcessPool
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from ...errors import ContactkitError
from ...files.scenes import write_text, write_whole
from ...reading.arrays import read_arrays
from ...reading.texts import from_json
from ...studies.run import end_with_parent, one_thread
from .page import Check
from .report import Made, index, write_page
from .scripts import Script, digest, load, scripts

__all__ = ["PageOutcome", "exit_status", "run_gallery", "run_page"]

_HEAD = "gallery_page"  # entry of the data that describes them


def exit_status(outcomes: Sequence[PageOutcome]) -> int:
    """Exit status: 2 if a page could not be made or written, 1 if a check does not hold."""
    if any(one.error for one in outcomes):
        return 2
    return 1 if any(one.failed for one in outcomes) else 0


class PageOutcome(NamedTuple):
    """PageOutcome of a page.

    `failed` are the statements that do not hold, `error` why there is no page, which may be that it
    could not be written; `seconds` of CPU, and whether the data had been kept.
    """

    path: Path
    label: str
    seconds: float
    is_kept: bool
    n_checks: int
    failed: tuple[str, ...]
    error: str = ""

    @property
    def is_good(self) -> bool:
        """Whether the page was made and every check holds."""
        return not self.failed and not self.error

    @property
    def summary(self) -> str:
        """PageOutcome of the checks, in a few words."""
        held = f"{self.n_checks - len(self.failed)} of {self.n_checks} hold"
        if not self.error:
            return held
        return f"{held}; {self.error}" if self.n_checks else f"failed: {self.error}"

    def __str__(self) -> str:
        """A line of the progress."""
        kept = "kept" if self.is_kept else f"{self.seconds:.1f} s CPU time"
        wrong = "".join(f"\n    does not hold: {statement}" for statement in self.failed)
        return f"{self.label}: {self.summary} ({kept}){wrong}"


def run_gallery(
    pages: Sequence[Script],
    out: Path,
    *,
    draft: bool = False,
    workers: int | None = None,
    report: Callable[[PageOutcome], None] | None = None,
) -> list[PageOutcome]:
    """Make pages and the index: computed on processes, drawn, checked, written.

    Parameters
    ----------
    pages : sequence of Script
        The pages.
    out : Path
        Folder to write to. Data of a page are kept there, and computed again only if the code that
        computes them, the version of contactkit or `draft` differ.
    draft : bool
        Whether to compute with small sizes.
    workers : int, optional
        Number of processes; as many as cores if not given.
    report : callable, optional
        Called with each page as it ends.

    Returns
    -------
    list of PageOutcome
        In the order of `pages`. A page that fails does not stop the others.

    Raises
    ------
    ContactkitError
        If a process dies.
    """
    out.mkdir(parents=True, exist_ok=True)
    found: dict[Path, PageOutcome] = {}
    for outcome in _outcomes([script.path for script in pages], out, draft, workers):
        found[outcome.path] = outcome
        if report is not None:
            report(outcome)
    made = [found[script.path] for script in pages]
    _write_index(pages, made, out)
    return made


def _outcomes(
    paths: Sequence[Path], out: Path, draft: bool, workers: int | None
) -> Iterator[PageOutcome]:
    from multiprocessing import get_context

    n = min(workers or _cores(), len(paths))
    if n <= 1:
        yield from (_made(path, out, draft) for path in paths)
        return
    context = get_context("spawn")
    with ProcessPoolExecutor(n, context, _begin) as pool:
        try:
            with one_thread():
                futures = [pool.submit(_made, path, out, draft) for path in paths]
                yield from (future.result() for future in as_completed(futures))
        except BrokenProcessPool:
            raise ContactkitError(
                "a process of the gallery died, for lack of memory perhaps; run it again, which "
                "continues where it stopped, with fewer pages at once"
            ) from None
        finally:
            pool.shutdown(cancel_futures=True)


def _begin() -> None:
    import signal

    signal.signal(signal.SIGINT, signal.SIG_DFL)
    threading.Thread(target=end_with_parent, daemon=True).start()


def _cores() -> int:
    affinity = getattr(os, "sched_getaffinity", None)
    return len(affinity(0)) if affinity is not None else (os.cpu_count() or 1)


def _made(path: Path, out: Path, draft: bool) -> PageOutcome:
    """Make one page."""
    label, started = path.stem, time.process_time()
    try:
        script = load(path)
        label = script.page.label
        kept = _read(script, out, draft)
        made = kept or _compute(script, draft)
        checks: list[Check] = list(script.module.check(made.data))
        problem = _written(script, made, checks, out, is_kept=kept is not None)
    except Exception as error:  # noqa: BLE001 a page that fails does not stop the others
        seconds = time.process_time() - started
        return PageOutcome(path, label, seconds, False, 0, (), f"{type(error).__name__}: {error}")
    failed = tuple(f"{one.statement} ({one.measured})" for one in checks if not one.holds)
    return PageOutcome(path, label, made.seconds, kept is not None, len(checks), failed, problem)


def _written(script: Script, made: Made, checks: list[Check], out: Path, *, is_kept: bool) -> str:
    """Write the data and the page; why that cannot be done, which takes no check away."""
    try:
        if not is_kept:
            _keep(script, made, out)
        write_page(script, made, checks, out)
    except OSError as error:
        return f"not written: {error.strerror or error}: {error.filename or out}"
    return ""


def _compute(script: Script, draft: bool) -> Made:
    started = time.process_time()
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        found = script.module.compute(draft)
    seconds = time.process_time() - started
    notes = {str(one.message).partition(" = ")[0]: str(one.message) for one in caught}
    return Made(dict(found), seconds, draft, list(notes.values()))


def _keep(script: Script, made: Made, out: Path) -> None:
    """Write the data of a page, from which it is made again."""
    code = digest(script, made.draft)
    head = {"digest": code, "seconds": made.seconds, "notes": list(made.notes)}
    with write_whole(out / f"{script.slug}.npz") as path:
        entries: Any = {**made.data, _HEAD: np.array(json.dumps(head))}
        np.savez_compressed(path, **entries)


def _read(script: Script, out: Path, draft: bool) -> Made | None:
    """Data of a page that are kept, if the same code made them."""
    path = out / f"{script.slug}.npz"
    try:
        with path.open("rb") as file:
            data: dict[str, Any] = read_arrays(file, path.name)
        head = from_json(str(data.pop(_HEAD)), path.name)
    except (OSError, ValueError, KeyError):
        return None
    if head["digest"] != digest(script, draft):
        return None
    return Made(data, float(head["seconds"]), draft, head["notes"])


def _write_index(pages: Sequence[Script], made: Sequence[PageOutcome], out: Path) -> None:
    """Write the index of all pages that are there; one that could not be made is there no more."""
    for script, outcome in zip(pages, made, strict=True):
        if outcome.error:
            (out / f"{script.slug}.md").unlink(missing_ok=True)
    listed = {script.path: script for script in (*scripts(), *pages)}
    write_text(out / "index.md", index(list(listed.values()), out))


def run_page(file: str, out: str = "out/gallery") -> None:
    """Make the page of a script that is run by itself; ``--quick`` with small sizes.

    Parameters
    ----------
    file : str
        ``__file__`` of the script.
    out : str
        Folder to write to.
    """
    (outcome,) = run_gallery([load(Path(file))], Path(out), draft="--quick" in sys.argv[1:])
    sys.stdout.write(f"{outcome}\n{Path(out) / load(Path(file)).slug}.md\n")
    sys.exit(exit_status([outcome]))
