"""Refusals of fits: each names what is wrong, and the cure."""

from __future__ import annotations

import re

import numpy as np
import pytest
from refusals import each_refused, refuses
from spheres import GAP, SOUGHT, VISCOSITY, closed, curve, measured, readings, sphere

import contactkit as ck

pytestmark = pytest.mark.errors


def fitted(data=None, ranges=None, scene=None, **more):
    """Call of a fit, with what is not given as it should be."""
    chosen = SOUGHT if ranges is None else ranges
    return lambda: ck.fit(
        scene or sphere(),
        measured() if data is None else data,
        chosen,
        **({"solve": closed} | more),
    )


def with_nan():
    values = readings()
    values[[3, 7]] = np.nan
    return values


test_a_curve_is_refused = each_refused(
    [
        (lambda: measured(values=with_nan()), r"values must be finite.*2 of 40.*first at index 3"),
        (lambda: measured(at=GAP[:-1]), "as many positions as values"),
        (lambda: measured(at=["1 um"] * 40), r"hold numbers.*units go into units="),
        (lambda: measured(units=("um", "mNm2q")), "known symbols"),
        (lambda: measured(branch="down"), "branch must be 'rising' or 'falling'"),
        (lambda: measured(beyond="guess"), "beyond must be 'refuse' or 'hold'"),
        (lambda: measured(sets="fast"), "mapping of paths to values"),
        (lambda: ck.MeasuredBound(quantity="jump", noise=1.0), "have an end: least, most or both"),
        (lambda: ck.read_measured_curve(3, "gap", "force"), "be a file, arrays by name"),
    ]
)
test_a_fit_is_refused = each_refused(
    [
        (fitted(data=[]), "at least one MeasuredCurve"),
        (fitted(data=[1.0]), "be a MeasuredCurve or a MeasuredBound"),
        (fitted(data=[measured(name="a"), measured(name="a")]), "be that of one curve"),
        (fitted(ranges={}), "name at least one field and its range"),
        (fitted(ranges={VISCOSITY + "x": (0.1, 1.0)}), "did you mean '" + re.escape(VISCOSITY)),
        (fitted(ranges={VISCOSITY: (1.0, 0.1)}), r"must rise \[Pa.s\].*finite ends"),
        (fitted(ranges={VISCOSITY: ("1 um", "2 um")}), "converts to Pa.s"),
        (fitted(ranges={VISCOSITY: 0.3}), "be a Range, a pair .* or a Prior"),
        (fitted(ranges={VISCOSITY: ck.Prior(0.1, 0.0)}), r"deviation must be positive"),
        (
            fitted(ranges={"interface.meniscus.liquid": ("water", "diesel")}),
            "be a real number.*compare fits",
        ),
        (fitted(ranges={VISCOSITY: (0.1, 1.0), f"{VISCOSITY} ": (0.1, 1.0)}), "be given once"),
        (fitted(data=measured(units=("um", "mN"), at=GAP * 1e6, noise="1 um")), "converts to N"),
        (fitted(data=measured(noise=-1.0)), "noise must be positive"),
        (fitted(data=measured(weights=[1.0])), "weights must be positive, one a reading"),
        (fitted(data=measured(units=("um", "Pa"))), "convert to N, the unit of the result"),
        (fitted(data=measured(units=("s", "N"))), "convert to m, the unit of the result"),
        (fitted(data=measured(quantity="forc")), "did you mean 'force'"),
        (fitted(data=measured(over="gab")), "did you mean 'gap'"),
        (fitted(data=measured(sets={VISCOSITY: 0.1})), r"sets of 'data'.*be given once"),
        (fitted(data=measured(sets={"loading.sped": 1.0})), "did you mean 'loading.speed'"),
        (fitted(data=measured(at=GAP * 10.0)), "lie within the run.*beyond='hold'"),
        (fitted(nuisance={"offset": (0.0, 1.0)}), "be one of shift, zero, scale, stiffness"),
        (
            fitted(data=measured(shift=(-1e-7, 1e-7)), nuisance={"shift": (-1e-7, 1e-7)}),
            "be given once",
        ),
        (fitted(data=measured(shift="1 N")), "converts to m"),
        (fitted(data=measured(scale=-1.0)), "scale must be positive"),
        (
            fitted(
                data=measured(at=GAP[:1], values=readings()[:1]), nuisance={"shift": (-1e-7, 1e-7)}
            ),
            "be at least 2, one a parameter",
        ),
        (fitted(intervals="quick"), "be 'auto', 'profile' or 'linear'"),
        (fitted(starts=0), "starts must be a whole number of at least 1"),
        (fitted(scene=3), "scene"),
        (fitted(solve=lambda scene: "a"), "return a result, a curve, numbers by name"),
        (fitted(solve=lambda scene: {"force": (1.0, "N"), "gap": (1.0, "m")}), "be a column"),
        (
            fitted(ranges={"interface.meniscus.liquid.surface_tension": (0.01, 0.05)}),
            "change what was measured.*effect",
        ),
    ]
)


def test_a_quantity_of_an_effect_that_is_not_called_for_names_it():
    data = measured(quantity="meniscus_force")
    refuses(
        lambda: ck.fit(sphere(), data, SOUGHT),
        "the scene does not call for meniscus-force",
        error=ck.NotSimulatedError,
    )


def test_an_axis_that_turns_back_asks_for_a_branch():
    x = np.array([0.0, 2.0, 1.0])

    def solve(scene):
        return curve(x=(x, "m"), f=(x, "N"))

    data = measured(over="x", quantity="f")
    refuses(lambda: ck.fit(sphere(), data, SOUGHT, solve=solve), "does not turn back", "branch=")


def test_a_scene_without_a_result_at_the_start_says_why():
    def solve(scene):
        raise ck.InfeasibleError("no bridge is that long")

    with pytest.raises(ck.InfeasibleError, match="no bridge is that long"):
        ck.fit(sphere(), measured(), SOUGHT, solve=solve)


def test_an_event_that_did_not_occur_is_named():
    data = measured(
        over="temperature", at=[300.0], values=[1.0], quantity="release_time", noise=1.0
    )
    refuses(
        lambda: ck.fit(sphere(), data, SOUGHT, solve=lambda _: {"release_time": (np.nan, "s")}),
        "no release_time at",
        "temperature",
        error=ck.ContactkitError,
    )


def test_a_spring_belongs_to_a_force_over_a_distance():
    data = measured(over="temperature", at=[300.0], values=[1.0], noise=1.0, stiffness=1.0)
    refuses(
        lambda: ck.fit(sphere(), data, SOUGHT, solve=lambda _: {"force": (1.0, "N")}),
        "stiffness",
        "column of a force",
    )


def test_runs_without_a_result_end_an_interval():
    """Above 0.2001 Pa.s there is none: the step is shortened, and the interval ends there."""

    def solve(scene):
        if scene.interface.meniscus.liquid.viscosity > 0.2001:
            raise ck.InfeasibleError("too thick to flow")
        return closed(scene)

    found = ck.fit(sphere(), measured(), SOUGHT, solve=solve)
    one = found["viscosity"]
    assert one.value == pytest.approx(0.2, rel=0.01)
    assert "no result beyond: too thick to flow" in one.verdict
    assert one.high <= 0.2001


def test_comparisons_are_of_the_same_data():
    one = ck.fit(sphere(), measured(), SOUGHT, solve=closed)
    other = ck.fit(sphere(), measured(values=readings(seed=2)), SOUGHT, solve=closed)
    refuses(lambda: ck.compare_fits({"a": one, "b": other}), "of the same data as 'a'")
    refuses(lambda: ck.compare_fits({"a": one}), "at least two fits")
    refuses(lambda: ck.compare_fits({"a": one, "b": 3}), "be a Fit")


def test_names_of_parameters_are_helped_with():
    found = ck.fit(sphere(), measured(), SOUGHT, solve=closed)
    refuses(lambda: found["viscosty"], "be one of the parameters", "did you mean")
    refuses(lambda: found.unit("ga"), "be a column or a number")
    refuses(lambda: found.profile("viscosity", n=1), "n must be a whole number")
