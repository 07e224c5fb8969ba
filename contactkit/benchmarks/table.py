"""Table of studies of accuracy and of hard cases: what is solved, over what, against what.

``contactkit cost NAME``, the pages of the documentation, the tests and the benchmarks read it. A
study has a scene, settings that refine its solution, and a reference. What compares models of
physics at one setting is none, as errors of closures of bridges (`models.liquid_bridges`).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import Literal

from attrs import field, frozen

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
    half : {"contact", "separation"}
        Half of the package that it belongs to.
    title : str
        What is solved.
    quantity : str
        What the error is of.
    judge : str
        What the error is measured against.
    solvers : tuple of str
        Public functions, effects, methods and shipped scenes that it judges.
    measured_by : str
        Function that measures the points, ``module:function``, below contactkit.
    holds : float
        Bound of the least error of every method, on any machine [-]; models are exempt.
    holds_of : mapping of str to float
        Other bounds, by method.
    floor : float
        Relative error of the reference itself [-].
    digits : str
        Method whose settings are tolerances, grids or steps: its slope is what a digit costs.
    note : str
        What a reader of the table has to know besides.
    """

    name: str
    half: Literal["contact", "separation"]
    title: str
    quantity: str
    judge: str
    solvers: tuple[str, ...]
    measured_by: str
    holds: float
    holds_of: Mapping[str, float] = field(factory=dict)
    floor: float = 1e-12
    digits: str = ""
    note: str = ""

    def points(self) -> list[Point]:
        """Measure error, counts and CPU seconds of every setting; a minute or less."""
        measure: Callable[[], list[Point]] = named(f"{_ROOT}.{self.measured_by}")
        return measure()

    def exceeded(self, points: Iterable[Point]) -> dict[str, float]:
        """Least errors that exceed their bound, by method: none if all is well."""
        least: dict[str, float] = {}
        for point in points:
            if not point.is_model and point.error == point.error:
                least[point.method] = min(point.error, least.get(point.method, math.inf))
        bounds = {method: self.holds_of.get(method, self.holds) for method in least}
        return {method: error for method, error in least.items() if error > bounds[method]}

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


_CONTACT = (
    AccuracyStudy(
        name="contact-methods",
        half="contact",
        title="Rough contact, pressure map, three methods",
        quantity="pressure map",
        judge="the active-set method at 1e-11; steel under a rough flat, 256 x 256 pixels",
        solvers=("solve", "active-set", "conjugate-gradient", "quasi-newton"),
        measured_by="benchmarks.rough_studies:methods",
        digits="active-set",
        holds=1e-10,
        holds_of={"conjugate-gradient": 1e-7, "quasi-newton": 1e-2},
    ),
    AccuracyStudy(
        name="contact-presets",
        half="contact",
        title="Shipped contacts, by preset",
        quantity="pressure map",
        judge="the same at 1e-11, on the grid of the scene; compliance and hardness alone",
        solvers=("solve", "head-disk", "contact-stop", "tip-landing"),
        measured_by="benchmarks.rough_studies:presets",
        digits="head-disk",
        holds=1e-9,
        note="The pressures of `tip-landing` are the same to the last bit: 99 % of the pixels in "
        "contact are at the hardness.",
    ),
    AccuracyStudy(
        name="contact-grids",
        half="contact",
        title="Error that the grids of the shipped contacts leave",
        quantity="maximum pressure and contact area",
        judge="the estimate of `discretisation_error`, whose seconds these are",
        solvers=("discretisation_error",),
        measured_by="benchmarks.rough_studies:grids",
        holds=0.05,
        note="Where it is larger than the error of the tolerance, a finer grid helps and a tighter "
        "tolerance does not.",
    ),
    AccuracyStudy(
        name="rough-contact",
        half="contact",
        title="Rough contacts at the default tolerance, over pixels, fraction in contact and edges",
        quantity="pressure map",
        judge="the same at 1e-11; eight pixels to the shortest wave; seconds of the solve alone",
        solvers=("solve",),
        measured_by="benchmarks.rough_studies:sizes",
        holds=1e-8,
    ),
    AccuracyStudy(
        name="contact-layers",
        half="contact",
        title="Layers and hardness at the default tolerance",
        quantity="pressure map",
        judge="the same at 1e-11; the worst of six rough contacts of 256 x 256 pixels, the mean of "
        "their seconds, the most convolutions of one",
        solvers=("solve", "hardness-limit"),
        measured_by="benchmarks.rough_studies:stacks",
        holds=1e-7,
        note="Films: modulus over that of the ground, thickness over the width of the window.",
    ),
    AccuracyStudy(
        name="contact-area",
        half="contact",
        title="Real area of contact over the grid, counted and edge-corrected",
        quantity="contact area",
        judge="the edge-corrected area on 1024 x 1024 pixels",
        solvers=("solve",),
        measured_by="benchmarks.rough_studies:area",
        digits="pixel count",
        holds=5e-3,
        holds_of={"pixel count": 0.05},
        floor=1e-3,
    ),
    AccuracyStudy(
        name="contact-pixels",
        half="contact",
        title="True and stated error of rough contacts over the pixels of the shortest wave",
        quantity="maximum pressure, contact area and tension",
        judge="16 pixels to the shortest wave; stated by `discretisation_error`",
        solvers=("discretisation_error",),
        measured_by="benchmarks.rough_studies:pixels",
        holds=0.1,
        holds_of={"counted area, stated": 0.2, "tension, true": 0.15, "tension, stated": 0.9},
        note="No true error exceeds the stated one. Tension is singular at the edges of spots.",
    ),
    AccuracyStudy(
        name="curve",
        half="contact",
        title="Load curve of twenty loads of a rough map",
        quantity="approach and maximum pressure",
        judge="the same at 1e-10",
        solvers=("load_curve", "study"),
        measured_by="benchmarks.rough_studies:curve",
        digits="maximum pressure",
        holds=1e-8,
        floor=1e-10,
    ),
    AccuracyStudy(
        name="hertz",
        half="contact",
        title="Isolated sphere on a half-space, over the pixels to its contact radius",
        quantity="maximum pressure, approach and contact radius",
        judge="Hertz; the contact radius follows from the pixel count",
        solvers=("solve",),
        measured_by="benchmarks.contact_studies:hertzian",
        digits="maximum pressure",
        holds=1e-5,
        holds_of={"contact radius": 3e-3},
    ),
    AccuracyStudy(
        name="lines",
        half="contact",
        title="Line contact, and a sphere on a sheet: maximum pressure over the grid",
        quantity="maximum pressure",
        judge="Hertz; 384 x 384 pixels",
        solvers=("press",),
        measured_by="benchmarks.contact_studies:lines",
        digits="cylinder, one-axis window",
        holds=1e-4,
    ),
    AccuracyStudy(
        name="layered-spheres",
        half="contact",
        title="Spheres on layers, 32 pixels to the contact radius",
        quantity="maximum pressure, approach, radius and greatest sqrt(J2)",
        judge="an axisymmetric solution",
        solvers=("solve", "subsurface-stress", "friction-traction"),
        measured_by="benchmarks.layered_studies:spheres",
        holds=2e-4,
        holds_of={"contact radius": 1e-2},
        note="With mu = 0.5 and stiff layers the greatest stress is at the trailing edge, where "
        "its slope is singular: one to two per cent on pixels.",
    ),
    AccuracyStudy(
        name="waves",
        half="contact",
        title="Waves of one direction in partial contact, over the pixels to the wave",
        quantity="maximum pressure, mean gap over amplitude, half-width of contact",
        judge="Westergaard, and a series on layers",
        solvers=("solve",),
        measured_by="benchmarks.layered_studies:waves",
        holds=5e-5,
        holds_of={"half-width": 1e-2},
    ),
    AccuracyStudy(
        name="compliances",
        half="contact",
        title="Compliances of layers",
        quantity="compliance",
        judge="numbers of 60 digits; seconds of a map of 1024 x 1024 pixels",
        solvers=("solve",),
        measured_by="benchmarks.layered_studies:compliances",
        holds=1e-14,
        floor=1e-16,
    ),
    AccuracyStudy(
        name="stress-readings",
        half="contact",
        title="Greatest stress below a rough contact, by reading of the pressure between pixels",
        quantity="greatest von Mises stress",
        judge="pixels four times finer",
        solvers=("subsurface-stress",),
        measured_by="benchmarks.layered_studies:readings",
        holds=0.08,
    ),
    AccuracyStudy(
        name="stress-off-contact",
        half="contact",
        title="Stress of single pixels off the contact, by reading of the pressure",
        quantity="von Mises stress half a pixel deep, of 99 % of the pixels",
        judge="uniform pixels on a transform five times finer; seconds of a plane",
        solvers=("subsurface-stress",),
        measured_by="benchmarks.layered_studies:off_contact",
        holds=0.02,
        holds_of={"trigonometric": 2.0},
        note='For maps of the stress off the contact take `reading="uniform"`.',
    ),
    AccuracyStudy(
        name="stress-depths",
        half="contact",
        title="Search for the greatest stress over depth",
        quantity="greatest stress",
        judge="planes a nanometre apart; seconds with those of the contact",
        solvers=("subsurface-stress",),
        measured_by="benchmarks.layered_studies:depths",
        digits="von_mises",
        holds=5e-4,
    ),
    AccuracyStudy(
        name="slip",
        half="contact",
        title="Partial slip of a sphere: displacement at 0.6 of full sliding",
        quantity="displacement",
        judge="Mindlin; over the tolerance against 1e-12",
        solvers=("partial-slip",),
        measured_by="benchmarks.contact_studies:slip",
        digits="tolerance at 64 x 64",
        holds=1e-4,
        holds_of={"tolerance at 64 x 64": 1e-9},
    ),
    AccuracyStudy(
        name="coupled",
        half="contact",
        title="Coupled slip of a pressed sphere, over the steps of pressing",
        quantity="tractions and stick radius",
        judge="64 steps",
        solvers=("partial-slip",),
        measured_by="benchmarks.contact_studies:coupled",
        digits="tractions, rms",
        holds=0.02,
        floor=1e-4,
    ),
    AccuracyStudy(
        name="adhesion",
        half="contact",
        title="Pull-off force of a sphere, over the grid",
        quantity="pull-off force",
        judge="Maugis and Dugdale; seconds of the whole curve",
        solvers=("pull_off_curve", "adhesion"),
        measured_by="benchmarks.contact_studies:adhesion",
        digits="Maugis parameter 1",
        holds=1e-2,
        note="With a Maugis parameter of 5 the range of the attraction is resolved from 128 x 128 "
        "pixels on; the trapping number, which a result prints, states it.",
    ),
    AccuracyStudy(
        name="history",
        half="contact",
        title="Plastic load cycle of a sphere, over its steps",
        quantity="work of the load, and plastic work",
        judge="balance of work and energy; the loss in one step",
        solvers=("plastic-history", "hardness-limit"),
        measured_by="benchmarks.contact_studies:history",
        digits="work of the load, trapezoids",
        holds=3e-3,
        holds_of={"plastic work": 1e-8},
    ),
)
_SEPARATION = (
    AccuracyStudy(
        name="film",
        half="separation",
        title="Release time of a film: a disc of 3.175 mm pulled by 40 N off 0.16 mm3 of engine "
        "oil, from 5 to 25 um, tension limit of 10 bar",
        quantity="release time",
        judge="a monolithic solution by scipy at 1e-11",
        solvers=("simulate",),
        measured_by="benchmarks.separation_studies:film",
        digits="contactkit motion",
        holds=1e-9,
        floor=1e-10,
    ),
    AccuracyStudy(
        name="releases",
        half="separation",
        title="Release times of reference cases, by preset",
        quantity="release time",
        judge="two other codes that agree to 1e-9, E to 3e-8",
        solvers=("simulate", "advance"),
        measured_by="benchmarks.separation_studies:releases",
        digits="case B",
        holds=1e-9,
        floor=1e-9,
    ),
    AccuracyStudy(
        name="fmu-releases",
        half="separation",
        title="Release times of the same cases by an FMU, over the steps of its host",
        quantity="release time",
        judge="the same two codes; `stiction-mass` in fmpy, whole runs",
        solvers=("stiction-mass",),
        measured_by="benchmarks.separation_studies:fmu_releases",
        digits="case B",
        holds=3e-7,
        floor=1e-9,
        note="The pull of A and D is constant. That of B and E is a curve, which the host gives as "
        "a straight line in each step: the error is that of the lines, and one line releases "
        "nothing.",
    ),
    AccuracyStudy(
        name="meniscus-laws",
        half="separation",
        title="Force of the meniscus as a motion calls it, gap by gap",
        quantity="force at 200 gaps up to the limit",
        judge="bridges solved one by one",
        solvers=("simulate", "meniscus-force"),
        measured_by="benchmarks.separation_studies:laws",
        holds=1e-9,
    ),
    AccuracyStudy(
        name="bridge-force",
        half="separation",
        title="Force of liquid bridges: exact, as an arc, as published (seconds for one gap)",
        quantity="force",
        judge="Legendre's integrals",
        solvers=("bridges",),
        measured_by="models.liquid_bridges.report.cost:force_study",
        holds=1e-12,
    ),
    AccuracyStudy(
        name="bridge-rupture",
        half="separation",
        title="Gap at which a liquid bridge breaks: exact, and where the neck of an arc closes",
        quantity="gap at rupture",
        judge="the greatest gap along Legendre's integrals",
        solvers=("bridges",),
        measured_by="models.liquid_bridges.report.cost:rupture_study",
        holds=1e-12,
    ),
    AccuracyStudy(
        name="film-faces",
        half="separation",
        title="Force of full films on faces of any shape, over the cells along the longer side",
        quantity="force",
        judge="closed forms",
        solvers=("simulate", "viscous-force"),
        measured_by="benchmarks.film_studies:planforms",
        digits="disc under a dome",
        holds=5e-4,
    ),
    AccuracyStudy(
        name="film-cavities",
        half="separation",
        title="First opening of a disc that cavitates, over the cells",
        quantity="force",
        judge="the exact edge of the cavity",
        solvers=("simulate", "tension-limit"),
        measured_by="benchmarks.film_studies:cavities",
        digits="3 times the onset",
        holds=3e-4,
    ),
    AccuracyStudy(
        name="film-native",
        half="separation",
        title="Pull of a notched disc by a native FMU whose cavity is on a grid",
        quantity="release time",
        judge="the exact edge of a disc; steps of 10 us",
        solvers=("fmu-native",),
        measured_by="benchmarks.film_studies:native",
        digits="native FMU",
        holds=1e-3,
    ),
    AccuracyStudy(
        name="injector-release",
        half="separation",
        title="First release of the fuel injector, by solver, coupling and communication step",
        quantity="release time",
        judge="a monolithic solution by scipy at 1e-11; each setting is run once",
        solvers=("fuel-injector", "advance"),
        measured_by="models.injector.report.cost:release_study",
        digits="FMU pair, pull a straight line",
        holds=1e-6,
        holds_of={"FMU pair, pull held": 5e-3},
        floor=1e-10,
        note="A pull that is held in each step is of first order; held for 20 us it makes the "
        "impacts on the end stop gain energy, and the release is wrong. 50 us is more than the "
        "end stop allows.",
    ),
    AccuracyStudy(
        name="mirror-release",
        half="separation",
        title="Time at which the tips of the micromirror are free",
        quantity="time at which the tips are free",
        judge="a monolithic solution by scipy at 1e-10",
        solvers=("micromirror",),
        measured_by="models.micromirror.report.cost:release_study",
        digits="tips in this process",
        holds=1e-8,
        floor=1e-9,
    ),
)
STUDIES: Mapping[str, AccuracyStudy] = {study.name: study for study in _CONTACT + _SEPARATION}
"""Accuracy studies by name: of contacts, then of separations."""


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
