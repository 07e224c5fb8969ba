"""Table of studies of accuracy and of hard cases: what is solved, over what, against what.

``contactkit cost NAME``, the pages of the documentation, the tests and the benchmarks read it.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path

from attrs import frozen

from .._lazy import named
from ..errors import DescriptionError, nearest
from ..export.report import Report
from ..work_precision import Point, WorkPrecision
from .hard.case import HardCase
from .hard.cases import HARD_CASES

__all__ = ["HARD_CASES", "STUDIES", "AccuracyStudy", "study_of"]

Progress = Callable[[float], None]
_ROOT = __package__.rpartition(".")[0]  # contactkit


@frozen(kw_only=True)
class AccuracyStudy:
    """Error of a solver over settings, against a reference, and what each setting costs.

    Parameters
    ----------
    name : str
        Name in the table.
    title : str
        What is solved.
    quantity : str
        What the error is of.
    judge : str
        What the error is measured against.
    solvers : tuple of str
        Public functions, effects or methods that it judges.
    measured_by : str
        Function that measures the points, ``module:function``, below contactkit.
    is_timed : bool
        Whether the seconds of its points are compared; otherwise their counts are.
    floor : float
        Relative error of the reference itself [-].
    """

    name: str
    title: str
    quantity: str
    judge: str
    solvers: tuple[str, ...]
    measured_by: str
    floor: float = 1e-12
    is_timed: bool = False

    def points(self) -> list[Point]:
        """Measure error, counts and seconds of every setting; a minute or less."""
        measure: Callable[[], list[Point]] = named(f"{_ROOT}.{self.measured_by}")
        return measure()

    def measured(self) -> WorkPrecision:
        """Measure the points, as `sweep` gives those of a scene."""
        points = tuple(self.points())
        return WorkPrecision(self.quantity, 1.0, self.floor, points, self.judge)

    def cost(self, out: Path | None, progress: Progress, error: float) -> Report:
        """Measure, recommend a setting for an error, and write table and picture to a folder."""
        from .report import cost_report

        found = self.measured()
        progress(1.0)
        return cost_report(found, out, error, self.title)


_ALL = (
    AccuracyStudy(
        name="contact-methods",
        title="Rough contact, pressure map, three methods",
        quantity="pressure map",
        judge="the active-set method at 1e-11; steel under a rough flat, 256 x 256 pixels",
        solvers=("solve", "active-set", "conjugate-gradient", "quasi-newton"),
        measured_by="benchmarks.contact_studies:methods",
        is_timed=True,
    ),
    AccuracyStudy(
        name="film",
        title="Release time of a film: a disc of 3.175 mm pulled by 40 N off 0.16 mm3 of engine "
        "oil, from 5 to 25 um, tension limit of 10 bar",
        quantity="release time",
        judge="a monolithic solution by scipy at 1e-11",
        solvers=("simulate",),
        measured_by="benchmarks.separation_studies:film",
        floor=1e-10,
        is_timed=True,
    ),
    AccuracyStudy(
        name="releases",
        title="Release times of reference cases, by preset",
        quantity="release time",
        judge="two other codes that agree to 1e-9 (`contactkit/benchmarks/releases.json`)",
        solvers=("simulate", "advance"),
        measured_by="benchmarks.separation_studies:releases",
        floor=1e-9,
        is_timed=True,
    ),
    AccuracyStudy(
        name="bridge-force",
        title="Force of liquid bridges: exact, as an arc, as published (seconds for one gap)",
        quantity="force",
        judge="Legendre's integrals",
        solvers=("bridges",),
        measured_by="models.liquid_bridges.report.cost:force_study",
        is_timed=True,
    ),
    AccuracyStudy(
        name="injector-release",
        title="First release of the fuel injector, by solver, coupling and communication step",
        quantity="release time",
        judge="a monolithic solution by scipy at 1e-11; each setting is run once",
        solvers=("fuel-injector", "advance"),
        measured_by="models.injector.report.cost:release_study",
        floor=1e-10,
        is_timed=True,
    ),
    AccuracyStudy(
        name="mirror-release",
        title="Time at which the tips of the micromirror are free",
        quantity="time at which the tips are free",
        judge="a monolithic solution by scipy at 1e-10",
        solvers=("micromirror",),
        measured_by="models.micromirror.report.cost:release_study",
        floor=1e-9,
        is_timed=True,
    ),
    AccuracyStudy(
        name="hertz",
        title="Isolated sphere on a half-space, over the pixels to its contact radius",
        quantity="maximum pressure, approach and contact radius",
        judge="Hertz; the contact radius follows from the pixel count",
        solvers=("solve",),
        measured_by="benchmarks.contact_studies:hertzian",
    ),
    AccuracyStudy(
        name="slip",
        title="Partial slip of a sphere: displacement at 0.6 of full sliding",
        quantity="displacement",
        judge="Mindlin; over the tolerance against 1e-12",
        solvers=("partial-slip",),
        measured_by="benchmarks.contact_studies:slip",
    ),
    AccuracyStudy(
        name="coupled",
        title="Coupled slip of a pressed sphere, over the steps of pressing",
        quantity="tractions and stick radius",
        judge="64 steps",
        solvers=("partial-slip",),
        measured_by="benchmarks.contact_studies:coupled",
        floor=1e-4,
    ),
    AccuracyStudy(
        name="adhesion",
        title="Pull-off force of a sphere, over the grid",
        quantity="pull-off force",
        judge="Maugis and Dugdale",
        solvers=("pull_off_curve", "adhesion"),
        measured_by="benchmarks.contact_studies:adhesion",
    ),
    AccuracyStudy(
        name="history",
        title="Plastic load cycle of a sphere, over its steps",
        quantity="work of the load, and plastic work",
        judge="balance of work and energy; the loss in one step",
        solvers=("plastic-history", "hardness-limit"),
        measured_by="benchmarks.contact_studies:history",
    ),
    AccuracyStudy(
        name="curve",
        title="Load curve of twenty loads of a rough map",
        quantity="approach and maximum pressure",
        judge="the same at 1e-10",
        solvers=("load_curve", "study"),
        measured_by="benchmarks.contact_studies:curve",
        floor=1e-10,
    ),
    AccuracyStudy(
        name="lines",
        title="Line contact, and a sphere on a sheet: maximum pressure over the grid",
        quantity="maximum pressure",
        judge="Hertz; 384 x 384 pixels",
        solvers=("press",),
        measured_by="benchmarks.contact_studies:lines",
    ),
)
STUDIES: Mapping[str, AccuracyStudy] = {study.name: study for study in _ALL}
"""Accuracy studies by name."""


def study_of(name: str) -> AccuracyStudy | HardCase:
    """Return an accuracy study or a hard case by its name.

    Raises
    ------
    DescriptionError
        If there is none of that name.

    Examples
    --------
    >>> study_of("slip").judge
    'Mindlin; over the tolerance against 1e-12'
    """
    known: Mapping[str, AccuracyStudy | HardCase] = {**STUDIES, **HARD_CASES}
    if name not in known:
        raise DescriptionError("study", name, "be one of the table", hint=nearest(name, known))
    return known[name]
