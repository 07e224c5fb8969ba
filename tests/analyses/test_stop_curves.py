"""The load-approach curve of an end stop: Hertz, energy, fresh solves, and the hard cases."""

from __future__ import annotations

import json
import math

import numpy as np
import pytest
from attrs import evolve
from hypothesis import given
from hypothesis import strategies as st
from selection import quick

import contactkit as ck
from contactkit.analyses.load_displacement.curve import Branch, LoadDisplacementCurve
from contactkit.analyses.load_displacement.impact import impact, in_series
from contactkit.app.scenes import open_scene
from contactkit.models.micromirror.landing import land, tip_faces
from contactkit.numerics.monotone_cubic import monotone_curve, monotone_slopes, power_curve

pytestmark = pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning")

HARDNESS = 7.5e9
STEEL = ck.Material(name="steel", young_modulus=210e9, poisson_ratio=0.3, hardness=HARDNESS)
ROUGH = ck.SelfAffineRoughness(rms=0.2e-6, hurst=0.8, rolloff=30e-6, cutoff=6e-6, seed=1)
MODULUS, RADIUS = 210e9 / (1.0 - 0.3**2), 1e-3
GRID = ck.Accuracy(grid=64)


def scene(upper, loading, *effects, width=60e-6, periodic=True):
    interface = ck.Interface(lower=ck.Body(solid=STEEL), upper=ck.Body(surface=upper))
    return ck.ContactScene(
        interface=interface,
        window=ck.Window(width=width, periodic=periodic),
        loading=loading,
        effects=(ck.HalfSpace(), *effects),
    )


def hertz(approach):
    return 4.0 / 3.0 * MODULUS * math.sqrt(RADIUS) * approach**1.5


@pytest.fixture(scope="module")
def ball():
    smooth = scene(
        ck.Paraboloid(radius=RADIUS), ck.Pressing(force=0.2), width=30e-6, periodic=False
    )
    return ck.load_displacement(smooth, points=12, decades=2.0, accuracy=ck.Accuracy(grid=96))


@pytest.fixture(scope="module")
def rough_scene():
    limit = ck.HardnessLimit(rule="material")
    return scene(ROUGH, ck.Pressing(pressure=3e8), limit)


@pytest.fixture(scope="module")
def rough(rough_scene):
    return ck.load_displacement(rough_scene, points=24, n_unloadings=8, accuracy=GRID)


# The kernel -----------------------------------------------------------------------------------

RISES = st.lists(st.tuples(st.floats(1e-3, 1e3), st.floats(0.0, 1e6)), min_size=2, max_size=12).map(
    lambda steps: tuple(np.cumsum(column).tolist() for column in zip(*steps, strict=True))
)


@given(RISES)
def test_a_curve_through_rising_points_rises_and_has_no_kink(points):
    nodes, values = points
    curve = monotone_curve(nodes, values)
    xs = np.linspace(nodes[0], nodes[-1], 97)
    ys = np.array([curve(x)[0] for x in xs])
    assert np.diff(ys).min() >= -1e-12 * values[-1]
    for x, y, slope in zip(nodes, values, monotone_slopes(nodes, values), strict=True):
        assert curve(x) == (pytest.approx(y, rel=1e-12), pytest.approx(slope, rel=1e-6, abs=1e-9))


def test_a_smooth_curve_is_met_to_third_order():
    xs, errors = np.linspace(0.5, 2.5, 200), []
    for n in (13, 25, 49):
        nodes = np.linspace(0.0, 3.0, n)
        ours = monotone_curve(nodes.tolist(), np.exp(nodes).tolist())
        errors.append(max(abs(ours(x)[0] / math.exp(x) - 1.0) for x in xs.tolist()))
    assert errors[0] / errors[1] > 7.0 < errors[1] / errors[2]
    assert errors[2] < 1e-5


def test_a_power_law_is_met_and_starts_at_zero():
    curve = power_curve([1e-9, 3e-9, 1e-6], [x**1.5 for x in (1e-9, 3e-9, 1e-6)])
    for x in (1e-15, 1e-9, 7e-8, 1e-6):
        assert curve(x) == (pytest.approx(x**1.5), pytest.approx(1.5 * x**0.5))
    assert curve(0.0) == curve(-1.0) == (0.0, 0.0)
    assert curve(2e-6)[0] == pytest.approx(1e-9 + 1.5e-3 * 1e-6)  # the tangent


@pytest.mark.parametrize(
    ("nodes", "values", "said"),
    [
        ([1.0], [1.0], "two or more"),
        ([1.0, 1.0], [1.0, 2.0], "ascend"),
        ([1.0, math.nan], [1.0, 2.0], "ascend"),
        ([1.0, 2.0], [2.0, 1.0], "nowhere fall"),
    ],
)
def test_points_out_of_order_are_refused(nodes, values, said):
    with pytest.raises(ck.DescriptionError, match=said):
        monotone_slopes(nodes, values)
    with pytest.raises(ck.DescriptionError, match="positive"):
        power_curve([0.0, 1.0], [1.0, 2.0])


# Elastic --------------------------------------------------------------------------------------


def test_a_smooth_sphere_is_hertz(ball):
    """Nodes are solves on pixels; the contact of the first has a radius of 8 of them."""
    for approach in np.geomspace(ball.approach[0], ball.max_approach, 30):
        point = ball.at(approach)
        assert point.force == pytest.approx(hertz(approach), rel=5e-3)
        assert point.stiffness == pytest.approx(1.5 * hertz(approach) / approach, rel=1e-2)
    assert ball.work(ball.max_approach) == pytest.approx(
        0.4 * hertz(ball.max_approach) * ball.max_approach, rel=1e-3
    )
    assert ball.contact_area[-1] == pytest.approx(math.pi * RADIUS * ball.max_approach, rel=0.05)
    assert "far from" in ball.datum


def test_an_elastic_contact_comes_back_as_it_went(ball):
    assert ball.unloading == ()
    assert ball.elastic_limit == ball.max_approach
    for approach in (1e-9, 3e-8, ball.max_approach):
        assert ball.at(approach, ball.max_approach) == ball.at(approach)
    assert ball.dissipated_work(ball.max_approach) == ball.residual(ball.max_approach) == 0.0
    assert ball.elastic_work(ball.max_approach) == ball.work(ball.max_approach)


def test_it_starts_without_a_kink(ball, rough):
    for curve in (ball, rough):
        assert curve.at(0.0)[:3] == curve.at(-1e-6)[:3] == (0.0, 0.0, 0.0)
        assert curve.at(0.0).branch is Branch.FREE
        first = curve.at(curve.approach[0]).stiffness
        assert curve.at(1e-6 * curve.approach[0]).stiffness < 2e-3 * first
        for node in curve.approach[:-1]:
            sides = [curve.at(node * (1.0 + d)).stiffness for d in (-1e-9, 1e-9)]
            assert sides[0] == pytest.approx(sides[1], rel=1e-6)


def test_beyond_the_tables_it_is_refused(ball):
    with pytest.raises(ck.InfeasibleError, match=r"beyond the tables.*larger loads"):
        ball.at(1.01 * ball.max_approach)
    point = ball.at(2.0 * ball.max_approach, beyond=True)
    assert point.branch is Branch.BEYOND
    expected = ball.force[-1] + ball.at(ball.max_approach).stiffness * ball.max_approach
    assert point.force == pytest.approx(expected)
    assert math.isfinite(ball.at(1e200, beyond=True).force)
    with pytest.raises(ck.DescriptionError, match="numbers"):
        ball.at(math.nan)


# Plastic --------------------------------------------------------------------------------------


def test_between_the_points_it_is_what_a_fresh_solve_gives(rough, rough_scene):
    """Solved by approaches, tables by pressures; unloading curves between those of the tables.

    The first way lies where the contact is a handful of pixels.
    """
    between = [math.sqrt(a * b) for a, b in zip(rough.approach, rough.approach[1:], strict=False)]
    fresh = ck.load_displacement(
        rough_scene, approaches=between[-8:], n_unloadings=3, accuracy=GRID
    )
    for approach, force in zip(fresh.approach, fresh.force, strict=True):
        assert rough.at(approach).force == pytest.approx(force, rel=min(rough.error, 0.03))
    for one, fraction in zip(fresh.unloading, (0.06, 0.01, 0.01), strict=True):
        whole, residual = rough.at(one.max_approach).force, one.residual_approach
        assert rough.residual(one.max_approach) == pytest.approx(residual, rel=0.1)
        for way, force in zip(one.fractions, one.forces, strict=True):
            approach = residual + way * (one.max_approach - residual)
            found = rough.at(approach, one.max_approach).force / whole
            assert found == pytest.approx(force, abs=fraction)


def test_the_dissipated_work_is_the_hardness_times_the_plastic_volume(rough):
    """The tables know only forces over approaches; the plastic volume only depths."""
    for one in rough.unloading[1:]:
        lost = rough.dissipated_work(one.max_approach)
        plastic = HARDNESS * one.plastic_volume
        assert lost == pytest.approx(plastic, rel=0.05, abs=0.01 * rough.work(one.max_approach))
    assert rough.dissipated_work(rough.max_approach) > 0.02 * rough.work(rough.max_approach)


@given(st.floats(0.0, 1.0), st.floats(0.0, 1.0), st.floats(0.0, 1.0))
def test_every_way_rises_and_lies_below_the_first_loading(rough, fraction, one, other):
    largest = fraction * rough.max_approach
    low, high = sorted((one * largest, other * largest))
    below, above = rough.at(low, largest), rough.at(high, largest)
    assert below.force <= above.force * (1.0 + 1e-12)
    assert below.contact_area <= above.contact_area * (1.0 + 1e-12)
    assert above.force <= rough.at(high).force
    assert 0.0 <= rough.dissipated_work(largest) <= rough.work(largest)


@pytest.mark.parametrize("fraction", [0.3, 0.62, 0.9, 1.0])
def test_a_loop_is_closed_and_its_area_is_the_dissipated_work(rough, fraction):
    largest = fraction * rough.max_approach
    down = np.linspace(0.0, largest, 4001)
    out = np.array([rough.at(d, largest).force for d in down])
    there = np.array([rough.at(d).force for d in down])
    assert out[-1] == pytest.approx(there[-1], rel=1e-12)  # and on along the first loading
    area = float(np.trapezoid(there - out, down))
    assert area == pytest.approx(
        rough.dissipated_work(largest), rel=2e-3, abs=0.01 * rough.work(largest)
    )
    assert area >= 0.0
    assert rough.at(0.5 * rough.residual(largest), largest)[:3] == (0.0, 0.0, 0.0)


@pytest.mark.parametrize(
    "reach", quick([0.0, 1e-6, 1e-3, 0.03, 0.3, 0.5, 0.7, 0.9, 1.0], 0, 2, 5, 8)
)
def test_near_yield_too_the_dissipated_work_is_the_area_of_the_loop(rough, reach):
    """There the mixed unloading curve is cut off at the first curve, along much of its length."""
    limit, one = rough.elastic_limit, rough.unloading[1].max_approach
    largest = limit + reach * (one - limit)
    ends = {*rough.approach, rough.residual(largest), *np.linspace(0.0, largest, 8001)}
    at = np.array(sorted(float(x) for x in ends if x <= largest))
    loop = [rough.at(x).force - rough.at(x, largest).force for x in at.tolist()]
    assert min(loop) >= 0.0
    assert rough.dissipated_work(largest) == pytest.approx(
        float(np.trapezoid(loop, at)), rel=0.0, abs=1e-6 * rough.work(largest)
    )


def test_it_yields_where_the_hardness_is_met(rough):
    assert 0.0 < rough.elastic_limit < rough.max_approach
    for approach in rough.approach:
        elastic = approach <= rough.elastic_limit
        assert (rough.at(approach).plastic_area == 0.0) is elastic
        assert (rough.residual(approach) == 0.0) >= elastic
    flattened = rough.at(1e-9, rough.max_approach).plastic_area
    assert flattened == pytest.approx(rough.plastic_area[-1], rel=1e-12)


def test_it_scales_and_travels_as_data(rough):
    twice = rough.scaled(2.0)
    assert twice.at(1e-7).force == pytest.approx(2.0 * rough.at(1e-7).force)
    assert twice.dissipated_work(rough.max_approach) == pytest.approx(
        2.0 * rough.dissipated_work(rough.max_approach)
    )
    again = LoadDisplacementCurve.from_data(json.loads(json.dumps(rough.to_data())))
    assert again == rough
    assert again.at(1.3e-7, rough.max_approach) == rough.at(1.3e-7, rough.max_approach)


# Hard cases -----------------------------------------------------------------------------------


def test_one_pixel_carries_the_lightest_load():
    """Below the pixel the summit is taken to be round."""
    light = scene(ROUGH, ck.Pressing(pressure=1e-2))
    curve = ck.load_displacement(light, points=4, decades=2.0, accuracy=ck.Accuracy(grid=32))
    pixel = (60e-6 / 32) ** 2
    assert curve.contact_area == pytest.approx([pixel] * 4)
    assert (
        np.ptp(np.array(curve.force) / np.array(curve.approach))
        < 1e-3 * curve.at(curve.approach[-1]).stiffness
    )


def test_near_the_hardness_nothing_elastic_is_left_but_the_tables_stand():
    limit = ck.HardnessLimit(rule="material")
    heavy = scene(ROUGH, ck.Pressing(pressure=0.98 * HARDNESS), limit)
    curve = ck.load_displacement(
        heavy, points=8, decades=1.0, n_unloadings=2, accuracy=ck.Accuracy(grid=32)
    )
    assert curve.elastic_limit == 0.0
    assert curve.plastic_area[-1] > 0.9 * curve.nominal_area
    last = curve.unloading[-1]
    assert curve.dissipated_work(curve.max_approach) == pytest.approx(
        HARDNESS * last.plastic_volume, rel=0.1
    )
    small = curve.at(0.5 * curve.approach[0] * 0.9, 0.5 * curve.approach[0])
    assert small.branch is Branch.UNLOADING  # the first unloading curve serves all below it
    with pytest.raises(ck.InfeasibleError, match="hardness"):
        ck.load_displacement(scene(ROUGH, ck.Pressing(pressure=HARDNESS), limit), accuracy=GRID)


def test_faces_without_an_approach_of_their_own_are_refused():
    flat = scene(ck.Wave(amplitude=1e-12, wavelength=60e-6), ck.Pressing(pressure=1e8))
    with pytest.raises(ck.InfeasibleError, match="full contact"):
        ck.load_displacement(flat, points=4, accuracy=ck.Accuracy(grid=16))


def test_a_hardness_that_grows_with_the_load_and_forgets_its_residual_indentations_is_refused():
    soft = ck.Material(name="soft", young_modulus=70e9, poisson_ratio=0.33, hardness=0.9e9)
    hard = ck.Material(name="hard", young_modulus=140e9, poisson_ratio=0.25, hardness=15e9)
    stack = ck.Stack(substrate=hard, layers=(ck.Layer(material=soft, thickness=50e-9),))
    made = ck.ContactScene(
        interface=ck.Interface(lower=ck.Body(solid=stack), upper=ck.Body(surface=ROUGH)),
        window=ck.Window(width=60e-6),
        loading=ck.Pressing(pressure=1e8),
        effects=(ck.LayeredHalfSpace(), ck.HardnessLimit()),
    )
    with pytest.raises(
        ck.InfeasibleError, match=r"residual indentations of smaller loads are lost.*material"
    ):
        ck.load_displacement(
            made, points=12, n_unloadings=2, accuracy=ck.Accuracy(grid=32, rtol=1e-6)
        )


@pytest.mark.parametrize(
    ("choice", "said"),
    [
        ({"points": 3}, "points"),
        ({"n_unloadings": 0}, "n_unloadings"),
        ({"decades": 0.0}, "decades"),
        ({"loads": [1.0]}, "ascending"),
        ({"loads": [1.0, 1.0]}, "ascending"),
        ({"approaches": [0.0, 1e-9]}, r"ascending \[m\]"),
        ({"loads": [1.0, math.nan]}, "finite"),
        ({"loads": [1.0, math.inf]}, "finite"),
        ({"loads": [1.0, 2.0], "approaches": [1.0, 2.0]}, "or approaches"),
    ],
)
def test_impossible_questions_are_refused(rough_scene, choice, said):
    with pytest.raises(ck.DescriptionError, match=said):
        ck.load_displacement(rough_scene, **choice)


def test_what_acts_back_on_the_contact_is_refused_and_what_looks_at_it_is_not_run(rough_scene):
    rubbed = evolve(
        rough_scene,
        effects=(*rough_scene.effects, ck.FrictionTraction(coefficient=0.2), ck.FrictionCoupling()),
    )
    with pytest.raises(ck.PlanError, match="leave out friction-coupling"):
        ck.load_displacement(rubbed)
    watched = evolve(rough_scene, effects=(ck.HalfSpace(), ck.FrictionTraction(coefficient=0.2)))
    assert ck.load_displacement(watched, points=4, accuracy=ck.Accuracy(grid=32)).unloading == ()
    with pytest.raises(ck.DescriptionError, match="be positive for a load-displacement curve"):
        ck.load_displacement(evolve(rough_scene, loading=ck.Pressing(force=0.0)))


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"approach": [1e-9]}, "two or more"),
        ({"force": [1.0]}, "two or more"),
        ({"elastic_limit": 1.0}, "unloading"),
        ({"height": 1.0}, "tables of a curve"),
        ({"unloading": [3]}, "tables of a curve"),
        ({"approach": ["a", "b"]}, "tables of a curve"),
    ],
)
def test_data_that_is_no_curve_is_refused(rough, change, said):
    with pytest.raises(ck.DescriptionError, match=said):
        LoadDisplacementCurve.from_data(rough.to_data() | change)


# A stop in a machine --------------------------------------------------------------------------


@pytest.mark.parametrize("stiffness", [1e-3, 1e3, 1e6, 1e9, 1e15])
def test_springs_in_series_carry_one_force(rough, stiffness):
    for total in (1e-12, 1e-8, 1.5e-7, rough.max_approach):
        for largest in (0.0, 0.7 * rough.max_approach, rough.max_approach):
            point, faces = in_series(rough, total, largest, stiffness)
            assert 0.0 <= faces <= total
            assert faces + point.force / stiffness == pytest.approx(total, rel=1e-9)
    rigid, faces = in_series(rough, 1e-7, 0.0, 0.0)
    assert (rigid, faces) == (rough.at(1e-7), 1e-7)
    with pytest.raises(ck.DescriptionError, match="stiffness"):
        in_series(rough, 1e-7, 0.0, math.inf)


@pytest.mark.parametrize("stiffness", [0.0, 3e6])
def test_an_impact_is_what_a_motion_gives(rough, stiffness):
    """Energy, against stepping the equation of motion in and out."""
    mass, speed = 1e-6, math.sqrt(0.6 * rough.work(rough.max_approach) / 0.5e-6)
    struck = impact(rough, mass, speed, stiffness=stiffness)
    position, velocity, largest, dt = 0.0, speed, 0.0, 5e-4 * rough.max_approach / speed
    peak, force = 0.0, 0.0
    while velocity > 0.0 or force > 0.0:
        velocity -= 0.5 * dt * force / mass
        position += dt * velocity
        point, faces = in_series(rough, position, largest, stiffness, beyond=True)
        force, largest = point.force, max(largest, faces)
        velocity -= 0.5 * dt * force / mass
        peak = max(peak, force)
    assert struck.force == pytest.approx(peak, rel=1e-3)
    assert struck.approach == pytest.approx(largest, rel=1e-3)
    assert struck.restitution == pytest.approx(-velocity / speed, abs=2e-4)
    assert struck.dissipated_work == pytest.approx(rough.dissipated_work(largest), rel=1e-2)


def test_a_second_impact_of_the_same_speed_loses_nothing(rough):
    mass, speed = 1e-6, math.sqrt(0.6 * rough.work(rough.max_approach) / 0.5e-6)
    first = impact(rough, mass, speed)
    again = impact(rough, mass, 0.9 * first.restitution * speed, max_approach=first.approach)
    assert (again.restitution, again.dissipated_work) == (1.0, 0.0)
    assert again.force < first.force
    harder = impact(rough, mass, 1.2 * speed, max_approach=first.approach)
    assert harder.force > first.force
    with pytest.raises(ck.InfeasibleError, match="tables end"):
        impact(rough, mass, 10.0 * speed)
    with pytest.raises(ck.DescriptionError, match="speed"):
        impact(rough, mass, 0.0)


def test_the_apex_of_a_mirror_tip_gives_back_what_it_did_not_dissipate():
    tip = open_scene("micromirror").scene.tip
    faces = tip_faces(tip, 2e-9, accuracy=ck.Accuracy(grid=48))
    modulus, radius = 70e9 / (2.0 * (1.0 - 0.33**2)), 1e-7
    assert faces.at(1e-10).force == pytest.approx(
        4.0 / 3.0 * modulus * math.sqrt(radius) * 1e-10**1.5, rel=0.05
    )
    mass, works = 4e-16, 4e-18
    soft, hard = land(faces, mass, 0.05), land(faces, mass, 1.0)
    assert (soft.restitution, soft.dissipated_work) == (1.0, 0.0)
    assert 0.5 < hard.restitution < 0.95
    held = land(faces, mass, 1.0, works)
    assert held.force > hard.force
    assert held.restitution < hard.restitution
    with pytest.raises(ck.PlanError, match="sphere"):
        tip_faces(open_scene("fuel-injector").scene.separation(293.0), 1e-9)
    with pytest.raises(ck.InfeasibleError, match="a fifth of the radius"):
        tip_faces(tip, 5e-8)
    with pytest.raises(ck.DescriptionError, match="attraction"):
        land(faces, mass, 1.0, math.nan)
