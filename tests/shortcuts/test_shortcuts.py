"""Quantities from one call agree with limits and scenes; `plan.force` with `simulate`."""

import math

import numpy as np
import pytest

import contactkit as ck

OIL = ck.Liquid(name="oil", viscosity=0.1, surface_tension=0.03)
WATER = ck.load_liquid("water")
FACE = ck.Flat(radius=1e-3)


def separation(*effects, upper=FACE, meniscus, loading):
    interface = ck.Interface(lower=ck.Flat(), upper=upper, meniscus=meniscus)
    return ck.SeparationScene(interface=interface, loading=loading, effects=effects)


# Values ---------------------------------------------------------------------------------------


def test_a_large_sphere_in_humid_air_has_the_force_of_the_thin_film():
    """4 pi R gamma cos(theta), from below, with an error as the root of r_K/R."""
    radii = np.array([1e-5, 1e-3])
    found = ck.capillary_force(radii, 0.5, contact_angles=math.radians(40.0))
    tension = WATER.at(293.15).surface_tension
    missing = 1.0 - found / (4.0 * math.pi * radii * tension * math.cos(math.radians(40.0)))
    assert 0.0 < missing[1] < 0.005
    assert missing[0] / missing[1] == pytest.approx(10.0, rel=0.05)


@pytest.mark.parametrize("gap", [1e-10, 1e-9])
def test_humid_air_as_in_a_scene(gap):
    moist = ck.Meniscus(
        liquid=WATER, relative_humidity=0.8, contact_angle_lower=0.3, contact_angle_upper=0.6
    )
    opening = ck.ImposedSpeed(speed=1e-6, initial_gap=1e-10, final_gap=5e-9)
    scene = separation(
        ck.MeniscusForce(), upper=ck.Sphere(radius=1e-7), meniscus=moist, loading=opening
    )
    found = ck.capillary_force(1e-7, 0.8, gap=gap, contact_angles=(0.3, 0.6))
    assert isinstance(found, float)
    assert found == pytest.approx(ck.plan(scene).force(gap), rel=1e-6)


def test_a_bridge_as_in_a_scene():
    meniscus = ck.Meniscus(liquid=OIL, volume=1e-15, contact_angle_lower=0.2)
    opening = ck.ImposedSpeed(speed=1e-6, initial_gap=1e-7, final_gap=1e-5)
    scene = separation(
        ck.MeniscusForce(), upper=ck.Sphere(radius=1e-4), meniscus=meniscus, loading=opening
    )
    gaps = np.array([1e-7, 1e-6, 5e-6])
    found = ck.bridge_force(1e-4, 1e-15, gap=gaps, surface_tension=0.03, contact_angles=(0.2, 0.0))
    np.testing.assert_allclose(found, ck.plan(scene).force(gaps), rtol=1e-6)


def test_a_bridge_between_equal_spheres_is_that_of_a_sphere_of_half_the_curvature_on_a_flat():
    """Derjaguin: for small bridges, by the reduced radius R/2."""
    volume = (1e-6) ** 3
    two = ck.bridge_force(1e-3, volume, surface_tension=0.07, lower_radius=1e-3)
    one = ck.bridge_force(0.5e-3, volume, surface_tension=0.07)
    assert two == pytest.approx(one, rel=3e-3)
    assert two == pytest.approx(4.0 * math.pi * 0.5e-3 * 0.07, rel=0.1)


@pytest.mark.parametrize("closure", ["flooded", "volume-conserving"])
def test_squeeze_time_as_the_motion_without_mass(closure):
    volume = math.pi * 1e-6 * 2e-6  # a film of radius 1 mm at 2 um
    pull = ck.ImposedForce(force=5.0, initial_gap=2e-6, final_gap=8e-6)
    meniscus = ck.Meniscus(liquid=OIL, volume=None if closure == "flooded" else volume)
    face = FACE if closure == "flooded" else ck.Flat(radius=2e-3)
    scene = separation(
        ck.ViscousForce(closure=closure), upper=face, meniscus=meniscus, loading=pull
    )
    moved = ck.simulate(ck.plan(scene))
    found = ck.squeeze_time(5.0, 1e-3, 0.1, 2e-6, 8e-6, closure=closure)
    assert found == pytest.approx(moved.scalars()["release_time"][0], rel=1e-5)


def test_squeeze_time_without_end_and_backwards():
    """Stefan's limit 3 pi eta r^4/(4 F h^2); pressing takes as long as pulling."""
    stefan = 0.75 * math.pi * 0.1 * 1e-12 / (5.0 * 4e-12)
    assert ck.squeeze_time(5.0, "1 mm", 0.1, "2 um") == pytest.approx(stefan, rel=1e-14)
    opened, closed = (
        ck.squeeze_time(5.0, 1e-3, 0.1, *ends) for ends in ((2e-6, 9e-6), (9e-6, 2e-6))
    )
    assert opened == pytest.approx(closed, rel=1e-13)
    forces = np.array([1.0, 2.0, 4.0])
    times = ck.squeeze_time(forces, 1e-3, 0.1, 2e-6)
    np.testing.assert_allclose(times * forces, 5.0 * stefan, rtol=1e-13)


def test_the_contact_area_of_a_sphere_is_that_of_hertz():
    n, width, radius, modulus, force = 128, 2e-5, 1e-3, 1e11, 1e-3
    x = (np.arange(n) - 0.5 * (n - 1)) * width / n
    heights = -(x**2 + x[:, None] ** 2) / (2.0 * radius)
    area = ck.contact_area(heights, width / n, force / width**2, modulus, periodic=False)
    hertz = math.pi * (0.75 * force * radius / modulus) ** (2.0 / 3.0)
    assert area == pytest.approx(hertz, rel=0.02)


# plan.force -----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "effects",
    [
        (ck.MeniscusForce(), ck.ViscousForce()),
        (ck.ViscousForce(), ck.TensionLimit(strength=1e5, cavity="truncated")),
        (ck.ViscousForce(), ck.ShearLimit(strength=1e3), ck.Rupture()),
        (ck.MeniscusForce(), ck.VanDerWaalsForce(hamaker_constant=1e-19), ck.Rupture()),
    ],
    ids=["meniscus", "tension", "shear", "rupture"],
)
@pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning")
def test_force_of_a_plan_is_the_pull_along_its_curve(effects):
    opening = ck.ImposedSpeed(speed=1e-3, initial_gap=1e-6, final_gap=3e-4)
    meniscus = ck.Meniscus(liquid=OIL, volume=1e-13)
    made = ck.plan(separation(*effects, meniscus=meniscus, loading=opening))
    result = ck.simulate(made)
    np.testing.assert_allclose(made.force(result.gap, 1e-3), result.pull, rtol=1e-12, atol=1e-30)


def test_force_of_a_plan_is_a_float_or_has_the_broadcast_shape():
    opening = ck.ImposedSpeed(speed=1e-3, initial_gap=1e-6, final_gap=1e-5)
    made = ck.plan(
        separation(
            ck.ViscousForce(), meniscus=ck.Meniscus(liquid=OIL, volume=1e-12), loading=opening
        )
    )
    assert isinstance(made.force(1e-6), float)
    assert made.force(1e-6) == 0.0  # at rest
    forces = made.force(np.array([[1e-6], [2e-6]]), [1e-3, -1e-3, 2e-3])
    assert forces.shape == (2, 3)
    np.testing.assert_allclose(forces[:, 1:], forces[:, :1] * [-1.0, 2.0], rtol=1e-14)


# Refusals -------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("call", "kind", "message"),
    [
        (
            lambda: ck.capillary_force(-1e-6, 0.5),
            ck.DescriptionError,
            r"capillary_force\(radius\) must be positive and finite \[m\], got -1e-06",
        ),
        (
            lambda: ck.capillary_force(1e-6, 50.0),
            ck.DescriptionError,
            r"relative_humidity\) must lie between 0 and 1, got 50.0; a fraction, not per cent",
        ),
        (lambda: ck.capillary_force(1e-6, 1.0), ck.InfeasibleError, "at saturation"),
        (lambda: ck.capillary_force(1e-6, 0.0), ck.InfeasibleError, "without vapour"),
        (
            lambda: ck.capillary_force(1e-6, 0.5, gap=1e-6),
            ck.InfeasibleError,
            r"no bridge beyond 1\.\d+ nm",
        ),
        (
            lambda: ck.capillary_force(1e-6, 0.5, contact_angles=60.0),
            ck.DescriptionError,
            r"contact_angles\) must lie between 0 and pi \[rad\], got 60.0; .* '60 deg'",
        ),
        (
            lambda: ck.capillary_force(1e-6, 0.5, contact_angles=(0.1, 0.2, 0.3)),
            ck.DescriptionError,
            r"contact_angles\) must be one angle, or a pair",
        ),
        (lambda: ck.capillary_force(1e-6, 0.5, liquid=OIL), ck.DescriptionError, "Liquid.density"),
        (lambda: ck.capillary_force(1e-6, 0.5, liquid=3), ck.DescriptionError, "be a Liquid"),
        (
            lambda: ck.bridge_force(1e-6, 0.0, surface_tension=0.07),
            ck.DescriptionError,
            r"bridge_force\(volume\) must be positive and finite \[m3\], got 0.0",
        ),
        (
            lambda: ck.bridge_force("1 kg", 1e-18, surface_tension=0.07),
            ck.DescriptionError,
            r"bridge_force\(radius\)",
        ),
        (
            lambda: ck.bridge_force(math.inf, 1e-18, gap=1.0, surface_tension=0.07),
            ck.InfeasibleError,
            "there it breaks",
        ),
        (
            lambda: ck.squeeze_time(5.0, 1e-3, 0.1, 2e-6, 0.0),
            ck.DescriptionError,
            r"squeeze_time\(final_gap\) must be positive, or inf \[m\], got 0.0",
        ),
        (
            lambda: ck.squeeze_time(5.0, 1e-3, None, 2e-6),
            ck.DescriptionError,
            r"squeeze_time\(viscosity\) must be a number \[Pa.s\], got None",
        ),
        (
            lambda: ck.squeeze_time(5.0, 1e-3, 0.1, 2e-6, closure="full"),
            ck.DescriptionError,
            r"squeeze_time\(closure\) must be 'flooded' or 'volume-conserving'",
        ),
        (
            lambda: ck.squeeze_time([1.0, 2.0], [1.0, 2.0, 3.0], 0.1, 2e-6),
            ck.DescriptionError,
            r"squeeze_time must be given numbers, or arrays of shapes that broadcast",
        ),
        (
            lambda: ck.contact_area(np.eye(4), 1e-6, 1e6, -1e9),
            ck.DescriptionError,
            r"contact_area\(modulus\) must be positive and finite \[Pa\]",
        ),
        (
            lambda: ck.contact_area(np.eye(4), 1e-6, [1e6, 2e6], 1e9),
            ck.DescriptionError,
            r"contact_area\(pressure\) must be a single number \[Pa\]",
        ),
    ],
)
def test_what_is_out_of_range_is_refused_with_its_cure(call, kind, message):
    with pytest.raises(kind, match=message):
        call()


@pytest.mark.parametrize(
    ("effects", "gap", "kind", "message"),
    [
        (
            (ck.ViscousForce(),),
            0.0,
            ck.DescriptionError,
            r"gap\) must be positive and finite \[m\]",
        ),
        ((ck.ViscousForce(),), "1 um", ck.DescriptionError, "be numbers or arrays that broadcast"),
        (
            (ck.ViscousForce(), ck.TensionLimit(strength=1e6)),
            1e-6,
            ck.PlanError,
            r'depends on the motion before; .*cavity="truncated"',
        ),
    ],
)
def test_a_force_that_is_not_known_is_refused(effects, gap, kind, message):
    opening = ck.ImposedSpeed(speed=1e-3, initial_gap=1e-6, final_gap=1e-5)
    meniscus = ck.Meniscus(liquid=OIL, volume=1e-12)
    made = ck.plan(separation(*effects, meniscus=meniscus, loading=opening))
    with pytest.raises(kind, match=message):
        made.force(gap, 1e-3)
