"""Reference scales of results: their definitions, and what they make of the laws of a film."""

import math

import loadings
import numpy as np
import pytest

import contactkit as ck

pytestmark = pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning")

DEG = math.pi / 180.0
STEEL = ck.Material(name="steel", young_modulus=210e9, poisson_ratio=0.3)
SILICA = ck.Material(name="silica", young_modulus=70e9, poisson_ratio=0.17)
WETTED = {"contact_angle_lower": 60 * DEG, "contact_angle_upper": 20 * DEG}
COSINES = math.cos(60 * DEG) + math.cos(20 * DEG)


def separated(film_scene, *effects, film=None, **given):
    scene = film_scene(*effects, film=WETTED | {"volume": 1e-12} | (film or {}), **given)
    return ck.simulate(ck.plan(scene, loadings.with_points(scene, 20)))


def test_a_film_between_flats_is_divided_by_its_capillary_force_and_viscous_impulse(film_scene):
    result = separated(film_scene)
    x2, h0 = 1e-12 / math.pi / 1e-6, 1e-6
    wanted = {
        "m": h0,
        "m2": math.pi * x2,
        "N": math.pi * x2 * 0.03 * COSINES / h0,
        "N.s": 3 * math.pi * 0.1 * x2**2 / (4 * h0**2),
    }
    wanted |= {"s": wanted["N.s"] / wanted["N"], "J": wanted["N"] * h0, "Pa": 0.03 * COSINES / h0}
    wanted |= {"m/s": h0 / wanted["s"]}
    assert {u: s.value for u, s in result.scales.items()} == pytest.approx(wanted, rel=1e-12)
    gap, unit = result.scaled("gap")
    assert (gap[0], unit) == (1.0, "h0")
    force = result.scaled("meniscus_force")
    assert force.value[0] == pytest.approx(1.0, rel=0.05)  # wide against its height
    # At constant volume the whole impulse, far apart, is half of the scale: Eq. (3.43), corrected.
    impulse = result.dimensionless()["viscous_impulse"]
    assert impulse == (pytest.approx(0.5, rel=1e-3), "I0")
    assert result.dimensionless()["peak_force"][1] == "F0"


def test_a_sphere_is_divided_by_2_pi_r_gamma(film_scene):
    """A small drop under a touching sphere pulls with 1 in this unit."""
    ball = ck.Sphere(radius=1e-2)
    film = {"volume": 1e-16, "contact_angle_upper": 60 * DEG}
    result = separated(
        film_scene, ck.MeniscusForce(), upper=ball, film=film, initial_gap=0.0, speed=1e-6
    )
    assert result.scales["N"].value == pytest.approx(4 * math.pi * 1e-2 * 0.03 * 0.5)
    assert result.scaled("meniscus_force").value[0] == pytest.approx(1.0, rel=2e-3)
    height = math.sqrt(1e-16 / (math.pi * 1e-2))
    assert result.scales["m"] == (
        pytest.approx(height),
        "h0",
        "initial height of the film at its rim",
    )
    assert "s" not in result.scales  # without viscosity no time
    assert "N.s" not in result.scales
    assert "meniscus_impulse" not in result.dimensionless()
    assert result.scaled("meniscus_impulse").unit == "N.s"  # as it is


def test_similar_films_are_one_in_units_of_their_scales(film_scene):
    """Twice as large, of another liquid and speed: the same curves over the same axes."""

    def run(size, viscosity, gamma, speed):
        face = ck.Flat(radius=size * 1e-3)
        return separated(
            film_scene,
            lower=face,
            upper=face,
            liquid={"viscosity": viscosity, "surface_tension": gamma},
            film={"volume": size**3 * 1e-12},
            initial_gap=size * 1e-6,
            final_gap=size * 1e-5,
            speed=speed,
        )

    one = run(1.0, 0.1, 0.03, 1e-6)
    # The viscous over the capillary pressure, eta x^2 v/(gamma h^2), is the same.
    other = run(2.0, 0.2, 0.06, 2e-6 / 2.0)
    for name in ("gap", "time", "meniscus_force", "viscous_force", "pull", "liquid_pressure"):
        first, second = one.scaled(name), other.scaled(name)
        assert first.unit == second.unit
        np.testing.assert_allclose(second.value, first.value, rtol=1e-9, err_msg=name)
    numbers = other.dimensionless()
    assert set(numbers) == set(one.dimensionless()) >= {"peak_force", "viscous_impulse"}
    for name, (value, unit) in one.dimensionless().items():
        assert numbers[name] == (pytest.approx(value, rel=1e-9), unit), name


@pytest.mark.parametrize("angles", [(90 * DEG, 90 * DEG), (60 * DEG, 120 * DEG)])
def test_a_neutral_meniscus_has_no_capillary_scale(film_scene, angles):
    film = {"contact_angle_lower": angles[0], "contact_angle_upper": angles[1]}
    scales = separated(film_scene, film=film).scales
    assert "N" not in scales
    assert "s" not in scales
    assert "N.s" in scales


def test_without_a_meniscus_the_pull_is_the_scale(film_scene):
    viscous = ck.ViscousForce()
    pulled = separated(film_scene, viscous, force=2.0)
    assert pulled.scales["N"] == (2.0, "F0", "pull")
    # Half of the impulse of a film of constant radius, over the pull.
    whole = 0.5 * (1.0 - 1e-4)
    assert pulled.dimensionless()["release_time"] == (pytest.approx(whole, rel=1e-6), "t0")
    assert "N" not in separated(film_scene, viscous, speed=1e-6).scales


def test_asperities_give_the_length():
    rough = ck.AsperityPopulation(density=5e13, radius=1e-6, rms_height=1e-9)
    disk = ck.Flat(radius=50e-6)
    moist = ck.Meniscus(liquid=ck.load_liquid("water"), relative_humidity=0.7)
    scene = ck.SeparationScene(
        interface=ck.Interface(lower=disk, upper=disk, meniscus=moist),
        loading=ck.ImposedSpeed(initial_gap=2e-9, final_gap=2e-8, speed=1e-6),
        effects=(ck.AsperityMenisci(asperities=rough),),
    )
    result = ck.simulate(ck.plan(scene, ck.Accuracy.draft))
    assert result.scales["m"].name == "rms"
    assert result.scaled("gap").value[0] == pytest.approx(2.0)


@pytest.mark.parametrize(("over", "label"), [("gap", "gap [h0]"), ("time", "time [t0]")])
def test_curves_are_drawn_over_their_scales(film_scene, over, label):
    plot = pytest.importorskip("contactkit.plot.separation")
    result = separated(film_scene)
    ax = plot.over_scales(result, ["meniscus_force", "viscous_force", "gap"], over=over)
    assert ax.get_xlabel() == label
    assert ax.get_ylabel() == "in units of F0 = pi x^2 gamma |cos + cos|/h0, h0 = initial gap"
    assert [line.get_label() for line in ax.lines] == ["meniscus force", "viscous force", "gap"]
    np.testing.assert_array_equal(ax.lines[1].get_xdata(), result.scaled(over).value)
    np.testing.assert_array_equal(ax.lines[1].get_ydata(), result.scaled("viscous_force").value)
    assert ax.get_xscale() == ("log" if over == "gap" else "linear")
    with pytest.raises(ck.DescriptionError, match="column must be one of"):
        plot.over_scales(result, ["force"])


# Contacts and slidings ------------------------------------------------------------------------


def pressed(*bodies, window, **loading):
    lower, upper = bodies
    scene = ck.ContactScene(
        interface=ck.Interface(lower=lower, upper=upper),
        window=window,
        loading=ck.Pressing(**loading),
        effects=(ck.LayeredHalfSpace(),),
    )
    return ck.solve(ck.plan(scene, ck.Accuracy(grid=64)))


def test_a_rough_contact_is_divided_by_the_substrates_and_its_rms_height():
    coated = ck.Stack(layers=(ck.Layer(material=SILICA, thickness=2e-9),), substrate=STEEL)
    rough = ck.GaussianRoughness(rms=1e-9, correlation_length=2e-7, cutoff=1e-7)
    result = pressed(
        ck.Body(solid=coated),
        ck.Body(surface=rough, solid=SILICA),
        window=ck.Window(width=8e-7),
        pressure=1e7,
    )
    modulus = 1.0 / (0.91 / 210e9 + (1 - 0.17**2) / 70e9)
    load, unit = result.scaled("load")
    assert unit == "E* A"
    assert float(load) == pytest.approx(1e7 / modulus, rel=1e-6)
    assert result.dimensionless()["contact_area"][0] == pytest.approx(result.contact_fraction)
    gap = result.scaled("gap")
    assert gap.unit == "rms"
    np.testing.assert_allclose(gap.value * result.heights.std(), result.gap)
    assert result.scaled("contact_fraction") == (result.contact_fraction, "-")
    with pytest.raises(ck.DescriptionError, match=r"column must be one of pressure, gap"):
        result.scaled("loads")


@pytest.mark.parametrize("is_rough", [False, True])
def test_a_ball_is_divided_by_its_radius(is_rough):
    """Hertz in its dimensionless form, F/(E* R^2) = 4/3 (d/R)^(3/2); roughness keeps the scales."""
    ball = ck.Paraboloid(radius=1e-6)
    fuzz = ck.GaussianRoughness(rms=1e-12, correlation_length=5e-8, cutoff=2e-8)
    surface = ck.CombinedSurface(parts=(ball, fuzz)) if is_rough else ball
    result = pressed(
        ck.Body(solid=STEEL),
        ck.Body(surface=surface),
        window=ck.Window(width=4e-7, periodic=False),
        force=1e-4,
    )
    found = result.dimensionless()
    assert result.scales["m"].name == "R"
    assert found["load"] == (pytest.approx(1e-4 / (210e9 / 0.91 * 1e-12)), "E* R^2")
    hertz = 4.0 / 3.0 * found["approach"][0] ** 1.5
    assert found["load"][0] == pytest.approx(hertz, rel=0.03)


def test_flat_faces_have_no_length():
    block = ck.Body(solid=STEEL)
    result = pressed(block, ck.Body(), window=ck.Window(width=1e-6), pressure=1e6)
    assert "m" not in result.scales
    assert "J" not in result.scales
    assert result.scaled("gap").unit == "m"


@pytest.mark.parametrize("imposed", [{"speed": 1e-3}, {"time": 1e-3}])
def test_a_slide_is_divided_by_its_drag(imposed):
    """Between flats the drag begins with 1; at Eq. (3.53) the mean is 8/(3 pi) of a half travel."""
    water = ck.Liquid(name="water", viscosity=0.89e-3, surface_tension=0.072)
    film = ck.Meniscus(liquid=water, volume=math.pi * 1e-12 * 2e-9)
    scene = ck.SlidingScene(
        interface=ck.Interface(meniscus=film),
        loading=ck.Sliding(gap=2e-9, **imposed),
        effects=(ck.CouetteForce(),),
    )
    result = ck.simulate(ck.plan(scene))
    found = result.dimensionless()
    assert result.scales["m"].value == pytest.approx(1e-6)
    assert found["break_travel"] == (pytest.approx(2.0), "x")
    assert found["couette_impulse"] == (pytest.approx(8.0 / (3.0 * math.pi)), "F0 x/v")
    if "speed" in imposed:
        assert result.scaled("couette_force").value[0] == pytest.approx(1.0)
