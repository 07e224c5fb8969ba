"""Computations of the app: surfaces of a scene, its result, area over load with its error."""

from __future__ import annotations

import math
import warnings
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np
from attrs import evolve, field, frozen

from ..analyses.heights import SurfaceHeights, surface_heights
from ..app.scenes import OpenedScene
from ..contact.discretisation import discretisation_error
from ..contact.plan import ContactPlan
from ..contact.result import ContactResult
from ..contact.solve import solve_unwarned
from ..errors import ContactkitError
from ..planning import plan, run
from ..roughness.height_maps import detrended
from ..roughness.statistics import surface_statistics
from ..scene.curve import Curve, Shown
from ..scene.result import Result
from ..scene.scenes import ContactScene
from ..scene.surfaces import Flat
from ..units import si

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = [
    "Answer",
    "AreaWithError",
    "ShownSurface",
    "answer_of",
    "area_with_error",
    "curve_of",
    "errors_of",
    "statistics_of",
    "surfaces_of",
]

_LOADS = (0.125, 0.25, 0.5, 1.0)
"""Loads of a curve over the load of the scene."""


@frozen(eq=False, kw_only=True)
class Answer:
    """A result with the errors of its numbers, or the problem that kept it from being one.

    `errors` are over the number [-], by name, from `errors_of`.
    """

    result: Any = None
    errors: Mapping[str, float] = field(factory=dict)
    problem: ContactkitError | None = None


def answer_of(opened: OpenedScene) -> Answer:
    """Plan and run a scene; a problem of contactkit is returned and not raised."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # every number of validity is shown
        try:
            made = plan(opened.scene, opened.accuracy)  # type: ignore[call-overload]
            result = run(made)
        except ContactkitError as error:
            return Answer(result=getattr(error, "result", None), problem=error)
    return Answer(result=result, errors=errors_of(result))


def errors_of(result: Result) -> Mapping[str, float]:
    """Discretisation error of each number of a contact, over the number [-]; empty without one.

    By companions on wider pixels, `contact.discretisation_error`; a grid of an odd number of pixels
    has none.
    """
    if not isinstance(result, ContactResult) or any(n % 2 for n in result.plan.grid.shape):
        return {}
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            return discretisation_error(result).errors
        except ContactkitError:  # a coarser companion may not carry the load
            return {}


# The surface ----------------------------------------------------------------------------------


@frozen(eq=False)
class ShownSurface:
    """Heights of a body that is not flat, and its holes if it has some."""

    side: str
    found: SurfaceHeights
    holes: NDArray[np.bool_] | None


def surfaces_of(
    opened: OpenedScene | None,
) -> tuple[tuple[ShownSurface, ...], ContactkitError | None]:
    """Surfaces of a contact as it would have them, and what is wrong with one; none of others."""
    if opened is None or not isinstance(opened.scene, ContactScene):
        return (), None
    scene, found = opened.scene, []
    bodies = {"lower": scene.interface.lower, "upper": scene.interface.upper}
    try:
        for side, body in bodies.items():
            if not isinstance(body.surface, Flat):
                heights = surface_heights(body.surface, scene.window, opened.accuracy)
                found.append(ShownSurface(side, heights, body.surface.void_pixels))
    except ContactkitError as error:
        return (), error
    return tuple(found), None


def statistics_of(shown: ShownSurface) -> dict[str, tuple[float, str]]:
    """Statistics of a surface, each with its unit, and the number of its holes.

    With holes the numbers are of the heights with that of the nearest pixel in each: slope and
    curvature are then slightly too small, by about the fraction of holes.
    """
    found, holes = shown.found, shown.holes
    numbers = surface_statistics(found.heights, found.pixel_size, found.is_periodic)
    return {
        "rms_height": (numbers.rms, "m"),
        "lowest": (numbers.lowest, "m"),
        "highest": (numbers.highest, "m"),
        "rms_slope": (numbers.rms_slope, "-"),
        "rms_curvature": (numbers.rms_curvature, "1/m"),
        "skewness": (numbers.skewness, "-"),
        "kurtosis": (numbers.kurtosis, "-"),
        "pixels_along_x": (float(found.heights.shape[1]), "-"),
        "pixels_along_y": (float(found.heights.shape[0]), "-"),
        "width": (numbers.window[1], "m"),
        "rise_of_the_tilt": (_rise(found.heights), "m"),
        "fraction_of_holes": (0.0 if holes is None else float(holes.mean()), "-"),
    }


def _rise(heights: NDArray[np.float64]) -> float:
    """Rise over the window [m] of the plane that fits best."""
    return float(np.ptp(detrended(heights, "mean") - detrended(heights, "tilt")))


# Area over load -------------------------------------------------------------------------------


@frozen(eq=False, kw_only=True)
class AreaWithError(Curve):
    """Area of contact over the load, and the bounds of its discretisation error.

    Attributes
    ----------
    mean_pressure : ndarray (n,)
        Mean pressures [Pa], ascending.
    area : ndarray (n,)
        Edge-corrected fraction of the window in contact [-].
    at_least, at_most : ndarray (n,)
        The same less and more its error by `discretisation_error` [-]; nan where that is not known.
    """

    axis: ClassVar[str] = "mean_pressure"
    title: ClassVar[str] = "area of contact over the load, with the error of the grid"

    mean_pressure: NDArray[np.float64] = field(repr=False, metadata=si("Pa"))
    area: NDArray[np.float64] = field(repr=False, metadata=si("-"))
    at_least: NDArray[np.float64] = field(repr=False, metadata=si("-"))
    at_most: NDArray[np.float64] = field(repr=False, metadata=si("-"))

    @property
    def shown(self) -> Shown:
        """See `Curve.shown`."""
        return {"area": (("area", "at_least", "at_most"), "")}


def area_with_error(result: ContactResult) -> AreaWithError:
    """Solve a contact again at an eighth, a quarter and a half of its load.

    Each is solved with companions on wider pixels, which give its error. What the plan prepared is
    used again.

    Raises
    ------
    ContactkitError
        If a load cannot be solved.
    """
    plan_: ContactPlan = plan(result.plan.scene, result.plan.accuracy)
    rows = []
    for factor in _LOADS:
        one = result if factor == 1.0 else solve_unwarned(_loaded(plan_, factor))
        area = one.corrected_contact_area / one.plan.grid.area
        error = errors_of(one).get("corrected_contact_area", math.nan) * area
        rows.append((one.mean_pressure, area, max(area - error, 0.0), min(area + error, 1.0)))
    columns = np.array(rows).T
    return AreaWithError(
        mean_pressure=columns[0], area=columns[1], at_least=columns[2], at_most=columns[3]
    )


def curve_of(result: Result) -> Answer:
    """`area_with_error` of a contact, or the problem of it."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            return Answer(result=area_with_error(result))  # type: ignore[arg-type]
    except ContactkitError as error:
        return Answer(problem=error)


def _loaded(made: ContactPlan, factor: float) -> ContactPlan:
    """The same contact under a fraction of its load, or of its approach."""
    loading: Any = made.scene.loading
    names = ("pressure", "force", "approach")
    given = {n: factor * v for n in names if (v := getattr(loading, n, None)) is not None}
    return made.with_loading(evolve(loading, **given))
