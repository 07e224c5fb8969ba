"""Table of accuracy studies: what is solved, over which settings, against which reference.

``contactkit cost NAME``, the pages of the documentation and the tests read it.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path

from attrs import frozen

from .._lazy import named
from ..errors import DescriptionError, nearest
from ..export.report import Report
from ..work_precision import Point, WorkPrecision

__all__ = ["STUDIES", "AccuracyStudy", "study_of"]

Progress = Callable[[float], None]


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
        Function of this room that measures the points, ``module:function``.
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

    def points(self) -> list[Point]:
        """Measure error, counts and seconds of every setting; a minute or less."""
        measure: Callable[[], list[Point]] = named(f"{__package__}.{self.measured_by}")
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
        name="slip",
        title="Partial slip of a sphere: displacement at 0.6 of full sliding",
        quantity="displacement",
        judge="Mindlin; over the tolerance against 1e-12",
        solvers=("partial-slip",),
        measured_by="contact_studies:slip",
    ),
    AccuracyStudy(
        name="coupled",
        title="Coupled slip of a pressed sphere, over the steps of pressing",
        quantity="tractions and stick radius",
        judge="64 steps",
        solvers=("partial-slip",),
        measured_by="contact_studies:coupled",
        floor=1e-4,
    ),
    AccuracyStudy(
        name="adhesion",
        title="Pull-off force of a sphere, over the grid",
        quantity="pull-off force",
        judge="Maugis and Dugdale",
        solvers=("pull_off_curve", "adhesion"),
        measured_by="contact_studies:adhesion",
    ),
    AccuracyStudy(
        name="history",
        title="Plastic load cycle of a sphere, over its steps",
        quantity="work of the load, and plastic work",
        judge="balance of work and energy; the loss in one step",
        solvers=("plastic-history", "hardness-limit"),
        measured_by="contact_studies:history",
    ),
    AccuracyStudy(
        name="curve",
        title="Load curve of twenty loads of a rough map",
        quantity="approach and maximum pressure",
        judge="the same at 1e-10",
        solvers=("load_curve", "study"),
        measured_by="contact_studies:curve",
        floor=1e-10,
    ),
    AccuracyStudy(
        name="lines",
        title="Line contact, and a sphere on a sheet: maximum pressure over the grid",
        quantity="maximum pressure",
        judge="Hertz; 384 x 384 pixels",
        solvers=("press",),
        measured_by="contact_studies:lines",
    ),
)
STUDIES: Mapping[str, AccuracyStudy] = {study.name: study for study in _ALL}
"""Accuracy studies by name."""


def study_of(name: str) -> AccuracyStudy:
    """Return a study by its name.

    Raises
    ------
    DescriptionError
        If there is none of that name.

    Examples
    --------
    >>> study_of("slip").judge
    'Mindlin; over the tolerance against 1e-12'
    """
    if name not in STUDIES:
        raise DescriptionError("study", name, "be one of the table", hint=nearest(name, STUDIES))
    return STUDIES[name]
