"""Gradients against central differences of whole solves and whole motions."""

import attrs
import numpy as np
import pytest

import contactkit as ck
from contactkit.contact.functionals import FUNCTIONALS, functional
from contactkit.separation.motion.sensitivity import motion_slopes
from contactkit.separation.motion_curves import pull_law
from contactkit.studies.paths import changed, value_at

pytestmark = pytest.mark.filterwarnings("ignore::contactkit.ValidityWarning")

N = 16
EXACT = ck.Accuracy(rtol=1e-11)
SOLID = ck.Material(young_modulus=1e9, poisson_ratio=0.3, hardness=2e7)
COATED = ck.Stack(
    layers=(ck.Layer(material=ck.Material(young_modulus=3e9, poisson_ratio=0.25), thickness=5e-7),),
    substrate=ck.Material(young_modulus=1e9, poisson_ratio=0.3),
)
LAYER = "interface.lower.solid.layers.0"
LAYERS = (
    f"{LAYER}.thickness",
    f"{LAYER}.material.young_modulus",
    f"{LAYER}.material.poisson_ratio",
    "interface.lower.solid.substrate.young_modulus",
)
HEIGHTS = "interface.upper.surface.heights"


def rough(seed=0):
    rng = np.random.default_rng(seed)
    q = np.hypot(np.fft.fftfreq(N)[:, None], np.fft.rfftfreq(N))
    kept = np.where((q > 0.03) & (q < 0.3), (q + 1e-9) ** -1.8, 0.0)
    heights = np.fft.irfft2(kept * np.fft.rfft2(rng.normal(size=(N, N))), (N, N))
    return 1e-8 * heights / heights.std()


def pressed(loading, *more, solid=COATED, periodic=True, upper=None):
    surface = ck.Heights(heights=rough(), pixel_size=2e-7)
    elastic = ck.LayeredHalfSpace() if isinstance(solid, ck.Stack) else ck.HalfSpace()
    return ck.ContactScene(
        interface=ck.Interface(lower=ck.Body(solid=solid), upper=upper or ck.Body(surface=surface)),
        window=ck.Window(periodic=periodic) if upper is None else ck.Window(width=3e-6),
        loading=loading,
        effects=(elastic, *more),
    )


def of_contact(scene, accuracy, of, values):
    return functional(of).value(ck.solve(ck.plan(changed(scene, accuracy, values).scene, accuracy)))


def slope(value_of, value, relative=1e-5):
    """Central difference."""
    high, low = (value_of(value * (1.0 + sign * relative)) for sign in (1, -1))
    return (high - low) / (2.0 * relative * value)


def agree(found, wanted, size, rel=1e-6):
    """Right to `rel`, or to that of a thousandth of the number over the parameter."""
    assert abs(found - wanted) <= rel * max(abs(wanted), 1e-3 * abs(size))


def check_contact(scene, of, paths, accuracy=EXACT, rel=1e-6, step=1e-5):
    result = ck.solve(ck.plan(scene, accuracy))
    assert result.status == "converged"
    gradient = result.gradient(of, paths)
    assert gradient.value == functional(of).value(result)
    for path in paths:
        value = value_at(scene, accuracy, path)
        wanted = slope(lambda x, p=path: of_contact(scene, accuracy, of, {p: x}), value, step)
        agree(gradient[path], wanted, gradient.value / value, rel)
    return result, gradient


def check_heights(scene, result, of, rel=1e-6):
    """Along a random direction of heights."""
    along = 1e-8 * np.random.default_rng(1).normal(size=(N, N))
    base = rough()

    def at(step):
        heights = ck.Heights(heights=base + step * along, pixel_size=2e-7)
        return of_contact(scene, EXACT, of, {"interface.upper.surface": heights})

    wanted = (at(1e-5) - at(-1e-5)) / 2e-5
    found = float((result.gradient(of, "heights")["heights"] * along).sum())
    agree(found, wanted, functional(of).value(result), rel)


# Contacts -------------------------------------------------------------------------------------


def test_one_more_solve_gives_the_approach_over_load_modulus_and_heights():
    scene = pressed(ck.Pressing(pressure=3e6), solid=SOLID)
    paths = "loading.pressure", "interface.lower.solid.young_modulus"
    result, gradient = check_contact(scene, "approach", paths)
    check_heights(scene, result, "approach")
    alone = result.work.n_operator_applications
    assert gradient.n_operator_applications <= alone + 2  # two parameters of a body, one each
    assert not gradient.is_one_sided
    assert gradient.slope_unit("loading.pressure") == "m/Pa"
    assert "approach" in str(gradient)


def test_under_an_approach_the_load_follows_the_highest_summit_too():
    scene = pressed(ck.Approach(approach=1e-8), periodic=False, solid=SOLID)
    paths = ("loading.approach", "interface.lower.solid.young_modulus")
    result, gradient = check_contact(scene, "load", paths)
    check_heights(scene, result, "load")
    assert gradient.relative(paths[1]) == pytest.approx(1.0, rel=1e-8)  # linear in E
    summit = np.unravel_index(np.argmax(result.heights), result.heights.shape)
    assert gradient.result is result
    by_height = result.gradient("load", "heights")["heights"]
    assert by_height[summit] < 0.0 < np.delete(by_height.ravel(), np.argmax(result.heights)).max()


def test_pixels_at_the_hardness_carry_it_whatever_else_changes():
    scene = pressed(ck.Pressing(pressure=3e6), ck.HardnessLimit(), solid=SOLID)
    paths = ("interface.lower.solid.hardness", "loading.pressure")
    for of in ("mean_gap", "participation_area"):
        result, _ = check_contact(scene, of, paths)
    assert result.plastic_area > 0.0
    check_heights(scene, result, "mean_gap")


def test_a_history_whose_loads_only_rise_has_the_slopes_of_its_last_contact():
    history = ck.PlasticHistory(pressures=(1e6, 2e6), steps=2)
    scene = pressed(ck.Pressing(pressure=3e6), ck.HardnessLimit(), history, solid=SOLID)
    paths = ("interface.lower.solid.hardness", "loading.pressure")
    result, _ = check_contact(scene, "approach", paths)
    assert result.of(ck.PlasticHistory).plastic_work[-1] > 0.0
    with pytest.raises(ck.NotSimulatedError, match="its energy is that of the shape"):
        result.gradient("energy", "loading.pressure")


def test_the_derivative_of_the_work_is_the_load():
    """Castigliano: d(1/2 pCp)/d(approach) at constant shape is the load, for an energy of p, u."""
    scene = pressed(ck.Approach(approach=1e-8), periodic=False, solid=SOLID)
    result = ck.solve(ck.plan(scene, EXACT))
    found = result.gradient("elastic_energy", "loading.approach")["loading.approach"]
    assert found == pytest.approx(result.load, rel=1e-6)


def test_hertz_gives_exponents():
    """a^3 = 3 F R/4 E*, d^3 = 9 F^2/16 E*^2 R, p^3 = 6 F E*^2/pi^3 R^2."""
    ball = ck.Body(surface=ck.Paraboloid(radius=1e-4))
    scene = pressed(ck.Pressing(force=2e-5), solid=SOLID, upper=ball)
    scene = changed(scene, None, {"window.periodic": False}).scene
    result = ck.solve(ck.plan(scene, ck.Accuracy(grid=48, rtol=1e-10)))
    paths = "loading.force", "interface.upper.surface.radius", "interface.lower.solid.young_modulus"
    approach = result.gradient("approach", paths)
    area = result.gradient("participation_area", paths)
    for gradient, exponents in (
        (approach, (2 / 3, -1 / 3, -2 / 3)),
        (area, (2 / 3, 2 / 3, -2 / 3)),
    ):
        for path, exponent in zip(paths, exponents, strict=True):
            assert gradient.relative(path) == pytest.approx(exponent, abs=0.03)


@pytest.mark.slow
@pytest.mark.parametrize("of", sorted(FUNCTIONALS))
def test_every_functional_against_differences_of_solves(of):
    scene = pressed(ck.Pressing(pressure=3e6), periodic=False)
    result, _ = check_contact(scene, of, ("loading.pressure", LAYERS[0], LAYERS[2]), rel=3e-6)
    check_heights(scene, result, of, rel=3e-6)


def test_a_functional_of_ones_own():
    def value(result):
        return float((result.pressure**2).mean())

    def slopes(result):
        return ck.Slopes(pressure=2.0 * result.pressure / result.pressure.size)

    own = ck.Functional("mean_square_pressure", "Pa2", value, slopes)
    gradient = check_contact(
        pressed(ck.Pressing(pressure=3e6), solid=SOLID), own, ("loading.pressure",)
    )[1]
    assert gradient.unit == "Pa2"


def test_a_ratio_at_its_end_is_varied_to_one_side():
    solid = ck.Material(young_modulus=1e9, poisson_ratio=0.5)
    scene = pressed(ck.Approach(approach=1e-8), periodic=False, solid=solid)
    path = "interface.lower.solid.poisson_ratio"
    gradient = ck.solve(ck.plan(scene, EXACT)).gradient("load", path)
    assert gradient.relative(path) == pytest.approx(2.0 / 3.0, rel=1e-6)  # E* = E/(1 - nu^2)
    assert gradient.is_one_sided
    assert "one side" in gradient.notes[0]


def test_pixels_that_are_undecided_are_counted():
    flat = ck.Heights(heights=np.zeros((N, N)), pixel_size=1e-7)
    scene = pressed(ck.Approach(approach=1e-9), periodic=False, solid=SOLID)
    scene = changed(scene, None, {"interface.upper.surface": flat}).scene
    result = ck.solve(ck.plan(scene))
    just = np.array(result.pressure)
    just[0, 0] = 0.0  # no pressure, and no gap
    gradient = attrs.evolve(result, pressure=just).gradient("load", "loading.approach")
    assert gradient.is_one_sided
    assert gradient.notes[0].startswith("1 pixels")


def test_without_contact_nothing_depends_on_anything():
    scene = pressed(ck.Approach(approach=-1e-8), periodic=False, solid=SOLID)
    gradient = ck.solve(ck.plan(scene)).gradient("load", ("heights", "loading.approach"))
    assert gradient["loading.approach"] == 0.0
    assert not gradient["heights"].any()


def attracted(law=None):
    return ck.Adhesion(law=law or ck.ExponentialAttraction(work_of_adhesion=3e-2, range=6e-9))


WORK, RANGE = "effects.adhesion.law.work_of_adhesion", "effects.adhesion.law.range"


def check_attracted(loading, of, paths, law=None, rel=1e-6):
    scene = pressed(loading, attracted(law), solid=SOLID, periodic=False)
    result, gradient = check_contact(scene, of, paths, rel=rel, step=2e-4)
    assert result.contact.any()
    assert not result.contact.all()
    assert not gradient.is_one_sided
    return result, gradient


def test_an_attraction_adds_its_tangent_on_the_pixels_apart():
    paths = (WORK, RANGE, "loading.approach", "interface.lower.solid.young_modulus")
    check_attracted(ck.Approach(approach=5e-9), "load", paths)


@pytest.mark.slow
@pytest.mark.parametrize("of", ["approach", "mean_gap", "max_pressure", "elastic_energy"])
def test_numbers_of_an_attracted_contact_under_a_load(of):
    paths = (WORK, "loading.pressure", "interface.lower.solid.young_modulus")
    result, _ = check_attracted(ck.Pressing(pressure=3e5), of, paths)
    check_heights(result.plan.scene, result, of)


@pytest.mark.slow
def test_lennard_jones_attracts_with_a_tangent_too():
    law = ck.LennardJonesAttraction(work_of_adhesion=3e-2, range=8e-9)
    check_attracted(ck.Approach(approach=5e-9), "load", (WORK, RANGE), law)


@pytest.mark.slow
def test_an_attraction_beside_a_hardness():
    effects = attracted(), ck.HardnessLimit()
    scene = pressed(ck.Pressing(pressure=3e6), *effects, solid=SOLID, periodic=False)
    paths = (WORK, "interface.lower.solid.hardness", "loading.pressure")
    result, _ = check_contact(scene, "approach", paths, step=1e-4)
    assert result.of(ck.HardnessLimit).area > 0.0


FRICTION = (ck.FrictionTraction(coefficient=0.3), ck.FrictionCoupling())


@pytest.mark.parametrize(
    ("effects", "message"),
    [
        (FRICTION, "FrictionCoupling: friction displaces"),
        ((ck.HardnessLimit(), ck.PlasticHistory(pressures=(4e6,))), "PlasticHistory: the shape"),
    ],
)
def test_what_has_no_gradient_is_refused_with_the_reason(effects, message):
    result = ck.solve(ck.plan(pressed(ck.Pressing(pressure=3e6), *effects, solid=SOLID)))
    with pytest.raises(ck.NotSimulatedError, match=message):
        result.gradient("approach", "loading.pressure")


@pytest.mark.parametrize(
    ("of", "to", "message"),
    [
        ("contact_area", "loading.pressure", "counts pixels.*participation_area"),
        ("aproach", "loading.pressure", "did you mean 'approach'"),
        ("approach", "loading.pressur", "did you mean 'loading.pressure'"),
        ("approach", "accuracy.rtol", "accuracy has no gradient"),
        ("approach", "name", "there is a str"),
        ("approach", (), "name at least one parameter"),
        ("approach", ("heights", "heights"), "once"),
    ],
)
def test_names_that_are_wrong_are_refused(of, to, message):
    result = ck.solve(ck.plan(pressed(ck.Pressing(pressure=3e6), solid=SOLID)))
    with pytest.raises(ck.DescriptionError, match=message):
        result.gradient(of, to)


# Separations ------------------------------------------------------------------------------------

OIL = ck.Liquid(name="oil", viscosity=0.1, surface_tension=0.03, density=870.0)
VISCOSITY = "interface.meniscus.liquid.viscosity"
PULL = {"force": 1.0, "mass": 1e-3, "initial_gap": 5e-6, "final_gap": 2e-5}
FINE = ck.Accuracy(time_rtol=1e-8)


def pulled(loading, *effects, upper=None, volume=1e-11):
    face = ck.Flat(radius=1e-3)
    film = ck.Meniscus(liquid=OIL, volume=volume)
    interface = ck.Interface(lower=face, upper=upper or face, meniscus=film)
    return ck.SeparationScene(interface=interface, loading=loading, effects=effects)


def check_motion(scene, of, paths, accuracy=FINE, rel=1e-6):
    gradient = ck.simulate(ck.plan(scene, accuracy)).gradient(of, paths)
    for path in paths:
        value = value_at(scene, accuracy, path)

        def at(x, path=path):
            made = changed(scene, accuracy, {path: x})
            return ck.simulate(ck.plan(made.scene, accuracy)).scalars()[of][0]

        # Fourth order: as an error of 1e-8 of each motion asks for steps of 1e-3.
        wanted = (4.0 * slope(at, value, 1e-3) - slope(at, value, 2e-3)) / 3.0
        agree(gradient[path], wanted, gradient.value / value, rel)
    return gradient


def test_release_by_the_implicit_function_theorem():
    scene = pulled(ck.ImposedForce(**PULL), ck.ViscousForce())
    paths = VISCOSITY, "loading.force", "loading.mass", "loading.initial_gap", "loading.final_gap"
    every = ck.simulate(ck.plan(scene)).gradient("release_time", paths)
    assert every.n_steps > 0
    # A change of a unit changes nothing else.
    viscosity, force, mass = (every.relative(path) for path in paths[:3])
    assert viscosity + 2.0 * mass == pytest.approx(1.0, abs=1e-6)  # the unit of time
    assert viscosity + force + mass == pytest.approx(0.0, abs=1e-6)  # that of mass


@pytest.mark.slow
@pytest.mark.parametrize("of", ["release_time", "release_speed"])
def test_release_against_differences_of_motions(of):
    scene = pulled(ck.ImposedForce(**PULL), ck.ViscousForce())
    check_motion(scene, of, (VISCOSITY, "loading.initial_gap"), rel=1e-4)


def test_without_mass_time_is_viscosity_over_force():
    scene = pulled(ck.ImposedForce(force=1.0, initial_gap=5e-6, final_gap=2e-5), ck.ViscousForce())
    gradient = ck.simulate(ck.plan(scene)).gradient("release_time", (VISCOSITY, "loading.force"))
    assert gradient.relative(VISCOSITY) == pytest.approx(1.0, rel=1e-6)
    assert gradient.relative("loading.force") == pytest.approx(-1.0, rel=1e-6)


@pytest.mark.slow
def test_a_film_that_breaks_leaves_a_jump_of_the_slopes():
    loading = ck.ImposedForce(**{**PULL, "final_gap": 1e-4})
    effects = ck.ViscousForce(), ck.MeniscusForce(), ck.Rupture(gap=3e-5)
    scene = pulled(loading, *effects)
    check_motion(scene, "release_speed", ("effects.rupture.gap",), rel=1e-4)


def rising():
    """A rising pull on a spring: the force has a maximum inside a step."""
    loading = ck.ImposedForce(**PULL, stiffness=2e3, rise_time=1e-4, initial_speed=0.0)
    return pulled(loading, ck.ViscousForce(), ck.MeniscusForce())


@pytest.mark.slow
def test_a_rising_pull_on_a_spring():
    check_motion(rising(), "release_time", ("loading.stiffness", "loading.rise_time"), rel=1e-5)


def highest(scene):
    return motion_slopes(ck.plan(scene, FINE), (), pull_law).numbers["peak_force"]


@pytest.mark.slow
def test_the_highest_force_is_where_its_rate_vanishes():
    """Against differences of the maximum itself; the curve reads it off a cubic, right to 1e-5."""
    loading = {"force": 1.0, "mass": 1e-2, "initial_gap": 2e-5, "final_gap": 2e-4}
    scene = pulled(ck.ImposedForce(**loading, rise_time=1e-3), ck.ViscousForce(), volume=3e-11)
    paths = (VISCOSITY, "loading.mass", "loading.rise_time", "loading.initial_gap")
    gradient = ck.simulate(ck.plan(scene, FINE)).gradient("peak_force", paths)
    assert gradient.value == pytest.approx(highest(scene), rel=1e-5)
    for path in paths:
        value = value_at(scene, FINE, path)

        def at(x, path=path):
            return highest(changed(scene, FINE, {path: x}).scene)

        wanted = (4.0 * slope(at, value, 1e-3) - slope(at, value, 2e-3)) / 3.0
        assert gradient[path] == pytest.approx(wanted, rel=1e-7)


def test_an_imposed_speed_has_closed_slopes():
    loading = ck.ImposedSpeed(speed=1e-3, initial_gap=5e-6, final_gap=2e-5)
    gradient = ck.simulate(ck.plan(pulled(loading, ck.ViscousForce()))).gradient(
        "viscous_impulse", (VISCOSITY, "loading.initial_gap")
    )
    assert gradient.relative(VISCOSITY) == pytest.approx(1.0, rel=1e-9)
    flow = 4.0 / (1.0 - 1.0 / 256.0)  # a given volume: the impulse is as a^-4 - b^-4
    assert gradient.relative("loading.initial_gap") == pytest.approx(-flow, rel=1e-6)


def test_motions_without_a_gradient_are_refused_with_the_reason():
    resting = ck.ImposedForce(**PULL, rest_gap=5e-6)
    scene = pulled(resting, ck.ViscousForce())
    with pytest.raises(ck.NotSimulatedError, match="rests on asperities"):
        ck.simulate(ck.plan(scene)).gradient("release_time", VISCOSITY)
    cavity = pulled(
        ck.ImposedForce(**{**PULL, "force": 5.0}),
        ck.ViscousForce(),
        ck.TensionLimit(strength=1e5),
    )
    with pytest.raises(ck.NotSimulatedError, match="cavitates and remembers"):
        ck.simulate(ck.plan(cavity)).gradient("release_time", VISCOSITY)
    sliding = ck.SlidingScene(
        interface=ck.Interface(meniscus=ck.Meniscus(liquid=OIL, volume=1e-20)),
        loading=ck.Sliding(gap=5e-9, speed=1e-3),
        effects=(ck.CouetteForce(),),
    )
    with pytest.raises(ck.NotSimulatedError, match="SlidingResult"):
        ck.simulate(ck.plan(sliding)).gradient("couette_force", "loading.speed")


@pytest.mark.slow
def test_slopes_as_figures():
    scene = pressed(ck.Pressing(pressure=3e6), solid=SOLID)
    gradient = ck.solve(ck.plan(scene)).gradient("approach", ("heights", "loading.pressure"))
    assert set(gradient.plot.available) == {"heights", "relative"}
    for draw in gradient.plot.pictures().values():
        assert draw().get_xlabel()


@pytest.mark.slow
def test_slopes_as_tables():
    scene = pressed(ck.Pressing(pressure=3e6), solid=SOLID)
    gradient = ck.solve(ck.plan(scene)).gradient("approach", ("heights", "loading.pressure"))
    frame = gradient.to_dataframe()
    assert frame["slope"].tolist() == [gradient["loading.pressure"]]
    assert gradient.to_xarray()["by_heights"].shape == (N, N)
    with pytest.raises(ck.DescriptionError, match="be a parameter of the gradient"):
        gradient["loading.force"]
    with pytest.raises(ck.DescriptionError, match="relative change of a map"):
        gradient.relative("heights")
