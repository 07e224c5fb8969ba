"""Heights without a solve, stress after one, and loads at which a number is reached."""

from __future__ import annotations

import numpy as np
import pytest

import contactkit as ck
from contactkit.analyses.heights import surface_heights
from contactkit.analyses.load_for import load_for_contact_fraction, load_of_first_yield
from contactkit.analyses.subsurface import MEASURES, maximum_planes, stress_below
from contactkit.plot import style as plot
from contactkit.plot.roughness import height_map
from contactkit.plot.stress import Scale, stress_section

STEEL = ck.Material(young_modulus=210e9, poisson_ratio=0.3, hardness=5e9)


def ball(*effects):
    scene = ck.ContactScene(
        interface=ck.Interface(
            lower=ck.Body(solid=STEEL), upper=ck.Body(surface=ck.Paraboloid(radius=1e-3))
        ),
        window=ck.Window(width=60e-6, periodic=False),
        loading=ck.Pressing(force=0.2),
        effects=(ck.HalfSpace(), *effects),
    )
    return ck.plan(scene, ck.Accuracy(grid=32))


@pytest.fixture(scope="module")
def solved():
    return ck.solve(ball())


def test_heights_are_those_of_a_plan():
    surface = ck.GaussianRoughness(rms=1e-9, correlation_length=1e-7, cutoff=5e-8, seed=3)
    found = surface_heights(surface, ck.Window(width=1e-6), ck.Accuracy(grid=64))
    scene = ck.ContactScene(
        interface=ck.Interface(lower=ck.Body(solid=STEEL), upper=ck.Body(surface=surface)),
        window=ck.Window(width=1e-6),
        loading=ck.Pressing(pressure=1e6),
        effects=(ck.HalfSpace(),),
    )
    np.testing.assert_array_equal(found.heights, ck.plan(scene, ck.Accuracy(grid=64)).heights)
    ax = height_map(found)
    assert ax.get_xlabel() == "x [µm]"


@pytest.mark.parametrize("coefficient", [0.0, 0.3])
def test_stress_after_a_solve_is_that_of_the_scene(solved, coefficient):
    friction = ck.FrictionTraction(coefficient=coefficient)
    inside = ck.solve(ball(friction, ck.SubsurfaceStress())).of(ck.SubsurfaceStress)
    after = stress_below(solved, friction=friction)
    for name, one in inside.maxima.items():
        assert after.maxima[name].value == pytest.approx(one.value, rel=1e-9)


def test_friction_of_the_scene_stays_unless_replaced():
    run = ck.solve(ball(ck.FrictionTraction(coefficient=0.5)))
    own, none = (
        stress_below(run, friction=f).maxima["tension"].value
        for f in (None, ck.FrictionTraction(coefficient=0.0))
    )
    assert own > 3.0 * none


def slip(coefficient, *, displacement):
    step = ck.TangentialStep(displacement=displacement, steps=2)
    return ck.PartialSlip(coefficient=coefficient, path=(step,))


def test_stress_below_partial_slip_goes_from_no_friction_to_sliding(solved):
    """Sliding everywhere it is that of `FrictionTraction`, before that a part of it."""
    coefficient = 0.3
    effects = ck.SubsurfaceStress(depths=(0.0, 5e-6), keep="planes", reading="uniform")
    slid, held = (
        ck.solve(ball(slip(coefficient, displacement=far), effects)) for far in (1e-6, 5e-9)
    )
    sliding = stress_below(solved, effects, ck.FrictionTraction(coefficient=coefficient))
    part = slid.of(ck.SubsurfaceStress)
    np.testing.assert_allclose(part.planes, sliding.planes, atol=1e-4 * solved.max_pressure)
    tractions, between = held.of(ck.PartialSlip), held.of(ck.SubsurfaceStress)
    assert 0.2 < tractions.force[-1] / (coefficient * 0.2) < 0.8
    on_surface = between.planes[4, 0]
    np.testing.assert_allclose(on_surface, -tractions.traction_x[-1], atol=1e-9 * on_surface.max())
    again = stress_below(held, effects)
    np.testing.assert_allclose(again.planes, between.planes, rtol=1e-12, atol=1.0)


def test_stress_after_a_solve_has_friction_under_the_pressure_of_contact_only():
    attraction = ck.Adhesion(law=ck.DugdaleAttraction(work_of_adhesion=5.0, range=3e-8))
    friction = ck.FrictionTraction(coefficient=0.5)
    run = ck.solve(ball(attraction, friction, ck.SubsurfaceStress()))
    inside, after = run.of(ck.SubsurfaceStress).maxima, stress_below(run).maxima
    for name, one in inside.items():
        assert after[name].value == pytest.approx(one.value, rel=1e-9)


def test_friction_that_acts_back_on_the_pressure_is_not_replaced():
    run = ck.solve(ball(ck.FrictionTraction(coefficient=0.3), ck.FrictionCoupling()))
    with pytest.raises(ck.PlanError, match="acts back on the pressure"):
        stress_below(run, friction=ck.FrictionTraction(coefficient=0.1))


def test_the_plane_of_a_maximum_has_it(solved):
    friction = ck.FrictionTraction(coefficient=0.5)
    for plane in maximum_planes(solved, list(MEASURES), friction=friction).values():
        assert plane.values.shape == solved.pressure.shape
        assert plane.values.max() == pytest.approx(plane.maximum.value, rel=1e-9)


def test_an_unknown_measure_is_refused(solved):
    with pytest.raises(ck.DescriptionError, match="did you mean 'von_mises'"):
        maximum_planes(solved, ["mises"])


def test_planes_below_a_rigid_base_are_refused():
    base = ck.Stack(
        layers=(ck.Layer(material=STEEL, thickness=1e-5),), substrate=ck.RigidBase(bonded=True)
    )
    scene = ck.ContactScene(
        interface=ck.Interface(
            lower=ck.Body(solid=base), upper=ck.Body(surface=ck.Paraboloid(radius=1e-3))
        ),
        window=ck.Window(width=60e-6, periodic=False),
        loading=ck.Pressing(force=0.2),
        effects=(ck.LayeredHalfSpace(),),
    )
    run = ck.solve(ck.plan(scene, ck.Accuracy(grid=16)))
    with pytest.raises(ck.PlanError, match="rigid base"):
        stress_below(run, ck.SubsurfaceStress(depths=(2e-5,)))


def test_a_section_is_to_scale_with_its_maximum_marked(solved):
    part = stress_below(solved, ck.SubsurfaceStress(depths=tuple(np.linspace(0.0, 2e-5, 9))))
    _, ax = plot.figure()
    pixel = solved.plan.grid.pixel_size[1]
    stress_section(part, pixel, Scale(1e-6, 1e9, "[um]", "[GPa]"), ax=ax)
    assert ax.get_aspect() == 1.0
    (mark,) = (line for line in ax.lines if line.get_marker() == "o")
    best = MEASURES["von_mises"](part.section)
    row = np.unravel_index(best.argmax(), best.shape)[0]
    assert mark.get_ydata()[0] == pytest.approx(part.depth[row] * 1e6)


def test_first_yield_by_pressure_is_hertz():
    found = load_of_first_yield(ball(), 1.6e9)
    modulus = STEEL.plane_strain_modulus
    load = (np.pi * 1.6e9) ** 3 * 1e-6 / (6.0 * modulus**2)  # p0^3 pi^3 R^2/(6 E*^2)
    assert found.load == pytest.approx(load, rel=0.02)
    assert found.value >= 1.0
    assert found.result.max_pressure == pytest.approx(1.6e9, rel=1e-3)


def test_area_by_load_is_hertz():
    found = load_for_contact_fraction(ball(), 0.2)
    radius = np.sqrt(0.2 * 3.6e-9 / np.pi)
    load = 4.0 / 3.0 * STEEL.plane_strain_modulus * radius**3 / 1e-3
    assert found.load == pytest.approx(load, rel=0.08)  # an area counted in pixels


def test_what_cannot_be_looked_for_is_refused():
    with pytest.raises(ck.DescriptionError, match="above 0 and below 1"):
        load_for_contact_fraction(ball(), 1.0)
    with pytest.raises(ck.DescriptionError, match="positive"):
        load_of_first_yield(ball(), -1.0)
    with pytest.raises(ck.DescriptionError, match="pressure, von_mises or tresca"):
        load_of_first_yield(ball(), 1e9, "tension")
    with pytest.raises(ck.PlanError, match="without HardnessLimit"):
        load_of_first_yield(ball(ck.HardnessLimit()), 1e9)
    with pytest.raises(ck.InfeasibleError, match="reaches"):
        load_of_first_yield(ball(), 1e14)
