"""Time, memory and disk that a study will need, estimated from a few of its points."""

from __future__ import annotations

import math
import sys
import time
from collections.abc import Mapping
from typing import Any, NamedTuple

from attrs import fields, has

from ..accuracy import Accuracy
from ..errors import ContactkitError
from ..scene.scenes import ContactScene, SeparationScene, SlidingScene
from ..units import quantity_text
from .paths import Parameters, values_at
from .run import Done, Piece, Task
from .stream import check_axes
from .study import check_whole
from .study_file import StudyWriter

__all__ = ["StudyPlan", "plan_study"]

# Rows that the size of one is measured on: SQLite grows by pages of 4 KiB, of which a thousand rows
# of 100 bytes fill 25, so that the last one, partly empty, is an error of 4 % at most.
_COPIES = 1000


class StudyPlan(NamedTuple):
    """Estimate of what a study needs, from a few trial points; print it.

    Attributes
    ----------
    n_points, n_trials, n_failed : int
        Points of the study, those that were solved for the estimate, and how many of these failed.
    parameters : tuple of (str, int)
        Paths that vary, and the number of their values.
    seconds, least_seconds, most_seconds : float
        CPU time of a trial point: mean, least and greatest [s].
    point_memory : float
        Memory that `study` keeps for a point [bytes]; `stream_study` keeps one byte.
    process_memory : float or None
        Largest memory that this process has had so far [bytes]; each worker needs about that. None
        where the system does not report it.
    point_disk : float
        Disk for a point in the file of `stream_study` [bytes].
    workers : int
        Processes that share the work.
    """

    n_points: int
    n_trials: int
    n_failed: int
    parameters: tuple[tuple[str, int], ...]
    seconds: float
    least_seconds: float
    most_seconds: float
    point_memory: float
    process_memory: float | None
    point_disk: float
    workers: int

    @property
    def total_seconds(self) -> float:
        """CPU time of all points [s]."""
        return self.n_points * self.seconds

    @property
    def wall_seconds(self) -> float:
        """Time on `workers` cores that are free [s]."""
        return self.total_seconds / self.workers

    @property
    def memory(self) -> float:
        """Memory for the points of `study` [bytes], beside that of the processes."""
        return self.n_points * self.point_memory

    @property
    def disk(self) -> float:
        """Disk for the file of `stream_study` [bytes]."""
        return self.n_points * self.point_disk

    def __str__(self) -> str:
        along = " x ".join(f"{path} ({n})" for path, n in self.parameters)
        times = (self.seconds, self.least_seconds, self.most_seconds)
        each, least, most = (quantity_text(t, "s") for t in times)
        failed = f", of which {self.n_failed} have no solution" if self.n_failed else ""
        total, wall = _span(self.total_seconds), _span(self.wall_seconds)
        kept, streamed = _bytes(self.memory), _bytes(self.n_points)
        process = self.process_memory
        workers = "" if process is None else f"; each worker about {_bytes(process)}"
        return "\n".join(
            [
                f"study of {self.n_points} points: {along}",
                f"estimate from {self.n_trials} points{failed}; each was solved alone:",
                f"  time    {each} of CPU for a point ({least} to {most})",
                f"          {total} for all, {wall} on {self.workers} free cores",
                f"  memory  points: {kept} in study, {streamed} in stream_study{workers}",
                f"  disk    {self.point_disk:.0f} bytes for a point, {_bytes(self.disk)} for all",
            ]
        )


def plan_study(
    scene: ContactScene | SeparationScene | SlidingScene,
    parameters: Parameters,
    accuracy: Accuracy | None = None,
    *,
    trials: int = 5,
    workers: int = 1,
) -> StudyPlan:
    """Estimate time, memory and disk of a study before it is run, from a few of its points.

    Parameters
    ----------
    scene, parameters, accuracy
        As in `study`, and checked in the same way.
    trials : int
        Points that are solved for the estimate, spread evenly over the study.
    workers : int
        Processes or cores that will share the work.

    Returns
    -------
    StudyPlan
        The estimate; ``print(plan_study(...))`` shows it.

    Raises
    ------
    DescriptionError, PlanError
        As `study` does; also if each trial point is refused.

    Notes
    -----
    Times are CPU seconds of this machine. The trial points are solved alone; contacts along a load
    start from their neighbours in the study, which takes less. A first solve of a process
    also loads and compiles what it needs, and is repeated so that this does not count.

    Examples
    --------
    >>> import contactkit as ck
    >>> oil = ck.Liquid(name="oil", viscosity=0.1, surface_tension=0.03)
    >>> face = ck.Flat(radius=1e-3)
    >>> film = ck.Meniscus(liquid=oil, volume=1e-11)
    >>> scene = ck.SeparationScene(
    ...     interface=ck.Interface(lower=face, upper=face, meniscus=film),
    ...     loading=ck.ImposedTime(time=1e-3, initial_gap=4e-6, final_gap=1e-5),
    ...     effects=(ck.ViscousForce(),),
    ... )
    >>> times = [1e-3 + 1e-6 * i for i in range(1000)]
    >>> found = ck.plan_study(scene, {"loading.time": times}, trials=2)
    >>> found.n_points, 0.0 < found.point_disk < 1000.0
    (1000, True)
    """
    check_whole("trials", trials, 1)
    check_whole("workers", workers, 1)
    accuracy = accuracy if accuracy is not None else Accuracy.standard
    varied, sources = check_axes(scene, parameters, accuracy)
    n_points = math.prod(len(axis.values) for axis in varied)
    n = min(trials, n_points)
    places = sorted({round(i * (n_points - 1) / max(n - 1, 1)) for i in range(n)})
    found: list[Done] = []
    seconds: list[float] = []
    for place in (places[0], *places):
        task = Task(place, values_at(varied, place), "")
        begun = time.process_time()
        found += Piece(scene, accuracy, (task,), None, False).run()
        seconds.append(time.process_time() - begun)
    found, seconds = found[1:], seconds[1:]
    points = [done.point for done in found]
    if all(point.status in ("refused", "failed") for point in points):
        raise ContactkitError(f"no trial point could be solved: {points[0].message}")
    with StudyWriter(":memory:", scene, accuracy, varied, sources) as writer:
        empty = writer.n_bytes
        rows = [found[i % len(found)] for i in range(min(_COPIES, n_points))]
        writer.write([one._replace(place=i) for i, one in enumerate(rows)])
        disk = (writer.n_bytes - empty) / len(rows)
    return StudyPlan(
        n_points,
        len(found),
        sum(point.has_failed for point in points),
        tuple((", ".join(axis.paths), len(axis.values)) for axis in varied),
        sum(seconds) / len(seconds),
        min(seconds),
        max(seconds),
        sum(_size(point, set()) for point in points) / len(points),
        _process_memory(),
        disk,
        workers,
    )


def _size(value: Any, seen: set[int]) -> int:
    """Memory of an object and of what it holds [bytes], each object once."""
    if id(value) in seen:
        return 0
    seen.add(id(value))
    total = sys.getsizeof(value)
    if isinstance(value, Mapping):
        total += sum(_size(one, seen) for pair in value.items() for one in pair)
    elif isinstance(value, tuple | list):
        total += sum(_size(one, seen) for one in value)
    elif has(type(value)):
        total += sum(_size(getattr(value, one.name), seen) for one in fields(type(value)))
    return total


def _process_memory() -> float | None:
    try:
        import resource
    except ImportError:  # Windows
        return None
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return float(peak if sys.platform == "darwin" else 1024 * peak)


def _bytes(n: float) -> str:
    for unit in ("bytes", "kB", "MB", "GB"):
        if n < 1000.0:
            return f"{n:.3g} {unit}"
        n /= 1000.0
    return f"{n:.3g} TB"


def _span(seconds: float) -> str:
    """A time as people say it."""
    for unit, size in (("days", 86400.0), ("h", 3600.0), ("min", 60.0)):
        if seconds >= 2.0 * size:
            return f"{seconds / size:.2g} {unit}"
    return f"{seconds:.2g} s"
