"""Runs of a scene: its output folder, its progress, its report."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from .terminal import print_files, progress, show, timed

if TYPE_CHECKING:
    from ..app.output import Folder
    from ..app.scenes import Opened
    from ..export.report import Report

__all__ = ["Job", "load", "run_job"]


class Job(NamedTuple):
    """A command to run on a scene, and where its results go."""

    command: str
    scene: str
    settings: Sequence[str]
    out: Path | None
    overwrite: bool
    as_json: bool


def load(scene: str, settings: Sequence[str]) -> Opened:
    """Open a scene; its modules are imported here, so that --help is fast."""
    with timed("imports and scene"):
        from ..app.scenes import open_scene
        from ..app.settings import with_settings

        return with_settings(open_scene(scene), settings)


def run_job(
    job: Job,
    call: Callable[[Opened, Callable[[float], None]], Report],
    *,
    page: bool = False,
    opened: Opened | None = None,
) -> None:
    """Run a command on a scene, print its report, and write a page about it if that is wanted."""
    with _output(job) as folder:
        opened = opened or load(job.scene, job.settings)
        with progress(f"{job.command} {opened.name}") as update:
            report = call(opened, update)
        show(report, job.as_json)
        if folder is None:
            return
        from ..app.scenes import described

        folder.keep(opened.name, report.text, report.scalars, **described(opened, report))
        if page:
            from ..app.report_page import PAGE, folder_page
            from ..files.scenes import write_text

            path = write_text(folder.path / PAGE, folder_page(folder.path, folder.record))
            if not job.as_json:
                print_files("written", [path])


@contextmanager
def _output(job: Job) -> Iterator[Folder | None]:
    """Folder that the command writes to, if one is given."""
    if job.out is None:
        yield None
        return
    from ..app.output import Command, written_to

    who = Command(job.command, job.scene, tuple(job.settings))
    with written_to(job.out, who, overwrite=job.overwrite) as folder:
        yield folder
