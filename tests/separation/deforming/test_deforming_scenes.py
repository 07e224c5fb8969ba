"""Separations of deforming bodies as scenes: numbers, limits, files, figures, refusals."""

import math
import pickle

import attrs
import numpy as np
import pytest
from scipy.integrate import solve_ivp

import contactkit as ck
from contactkit.separation.deforming.phases import pressing_speed

OIL = ck.Liquid(name="oil", viscosity=0.1, surface_tension=0.03)
GEL = ck.Material(name="gel", young_modulus=353553.39 * 0.75, poisson_ratio=0.5)
FLOODED = ck.Meniscus(liquid=OIL)
PULL = ck.ImposedSpeed(speed=1e-5, initial_gap=1e-6, final_gap=5e-6)
RIM = math.sqrt(5e-3 * 1e-6) * 8.0


def scene(loading=PULL, effects=(), meniscus=FLOODED, solid=GEL, surface=None):
    return ck.SeparationScene(
        interface=ck.Interface(
            lower=ck.Body(surface=surface or ck.Flat(radius=RIM), solid=solid),
            upper=ck.Sphere(radius=5e-3),
            meniscus=meniscus,
        ),
        loading=loading,
        effects=(ck.ElasticBodies(), ck.ViscousForce(), *effects),
    )


@pytest.fixture(scope="module")
def pulled():
    return ck.simulate(ck.plan(scene()))


def test_a_pull_is_that_of_the_reference(pulled):
    """Case pull_speed_beta1."""
    assert pulled.plan.numbers.beta == pytest.approx(1.0, rel=1e-6)
    times = [0.05, 0.1, 0.2, 0.4]
    reference = [7.36978e-05, 1.166827e-04, 1.656194e-04, 1.1599552e-04]
    found = np.interp(times, pulled["time"], pulled["pull"])
    assert found == pytest.approx(reference, rel=2e-4)
    assert pulled.scalars()["pull_off_force"][0] == pytest.approx(1.7387e-4, rel=3e-3)
    assert pulled.scalars()["force_over_rigid"][0] == pytest.approx(0.369, rel=3e-3)
    assert pulled.status == "released"
    assert pulled.error < 1e-3
    assert all(number.is_valid for number in pulled.validity)


def test_energies_balance(pulled):
    work, lost = pulled["work"], pulled["dissipated_energy"]
    assert work == pytest.approx(lost + pulled["elastic_energy"], abs=3e-3 * work[-1])


def test_stiff_bodies_give_the_rigid_engine():
    steel = ck.Material(young_modulus=2e11, poisson_ratio=0.3)
    made = scene(solid=steel, surface=ck.Flat(radius=200.0 * RIM / 8.0))
    rigid = attrs.evolve(
        made,
        interface=attrs.evolve(
            made.interface, lower=attrs.evolve(made.interface.lower, solid=None)
        ),
        effects=(ck.ViscousForce(),),
    )
    found, law = ck.simulate(ck.plan(made)), ck.plan(rigid)
    later = found["time"] > 1e-2
    expected = law.force(found["gap"][later], 1e-5)
    assert found["pull"][later] == pytest.approx(expected, rel=1e-3)


def test_a_heavy_mass_leaves_as_from_rigid_bodies():
    """Bodies that hardly deform; the film takes no force until the mass moves."""
    stiff = attrs.evolve(GEL, young_modulus=1e4 * GEL.young_modulus)
    force, mass = 1e-3, 0.4
    loading = ck.ImposedForce(force=force, mass=mass, initial_gap=1e-6, final_gap=4e-6)
    found = ck.simulate(ck.plan(scene(loading, solid=stiff)))

    def rates(_, state):
        gap, speed = state
        edge = gap + RIM**2 / (2.0 * 5e-3)
        inner = 1.0 / gap - 1.0 / edge - (edge - gap) / edge**2
        return speed, (force - 6.0 * math.pi * 0.1 * 5e-3**2 * inner * speed) / mass

    def leaves(_, state):
        return state[0] - 4e-6

    leaves.terminal = True
    law = solve_ivp(rates, (0.0, 1.0), [1e-6, 0.0], "LSODA", rtol=1e-8, atol=1e-14, events=leaves)
    assert found.numbers["release_time"] == pytest.approx(law.t_events[0][0], rel=1e-3)
    assert found.work.n_rejected < 5


def test_the_scale_of_a_press_is_the_damping_of_the_face():
    """Of a round flat 3 pi eta R^4/(2 h^3), by Stefan."""
    loading = ck.PressAndPull(press=1e-3, rest=1.0, speed=1e-6, initial_gap=1e-6, final_gap=2e-6)
    flat = attrs.evolve(scene(loading), interface=attrs.evolve(scene().interface, upper=ck.Flat()))
    damping = 1.5 * math.pi * 0.1 * RIM**4 / 1e-6**3
    assert pressing_speed(ck.plan(flat)) == pytest.approx(1e-3 / damping, rel=1e-9)


@pytest.mark.filterwarnings("ignore::contactkit.ValidityWarning")
def test_without_elastic_bodies_the_rigid_engine_answers():
    """To the last bit: a scene with solids and without the effect is planned as ever."""
    rigid = attrs.evolve(scene(), effects=(ck.ViscousForce(),))
    made = ck.plan(rigid)
    assert type(made) is ck.Plan
    from contactkit.separation.plan import plan

    assert ck.simulate(made)["pull"].tolist() == ck.simulate(plan(rigid))["pull"].tolist()


@pytest.mark.slow
def test_pulling_presses_the_asperities_harder():
    """The film's suction acts on the bodies: contact grows under a net pull."""
    solid = attrs.evolve(GEL, young_modulus=10.0 * GEL.young_modulus)
    loading = ck.PressAndPull(press=3e-4, rest=30.0, speed=1e-5, initial_gap=1e-6, final_gap=4e-6)
    made = scene(loading, (ck.SolidContact(cutoff=3e-7),), solid=solid)
    found = ck.simulate(ck.plan(made, ck.Accuracy(film_rtol=1e-2)))
    contact, pull, time = found["contact_force"], found["pull"], found["time"]
    rested = int(np.abs(time - 30.0).argmin())
    assert pull[rested] == pytest.approx(-3e-4, rel=1e-6)
    assert contact[rested] == pytest.approx(3e-4, rel=1e-2)
    assert contact.max() > 1.05 * contact[rested]
    assert pull[contact.argmax()] > pull[rested]
    assert found.scalars()["largest_contact_force"][0] == contact.max()
    assert found["smallest_gap"].min() == pytest.approx(3e-7, rel=1e-6)


@pytest.mark.slow
def test_a_meniscus_of_given_volume_is_kept():
    meniscus = ck.Meniscus(liquid=OIL, volume=1e-14)
    stiff = ck.Material(young_modulus=2e8, poisson_ratio=0.3)
    made = scene(effects=(ck.MeniscusForce(),), meniscus=meniscus, solid=stiff)
    found = ck.simulate(ck.plan(made))
    liquid = found["liquid_volume"]
    assert np.ptp(liquid) < 1e-10 * liquid[0]
    assert liquid[0] == pytest.approx(1e-14, rel=1e-4)
    assert found["pull"][0] == pytest.approx(found["meniscus_force"][0], rel=1e-6)
    assert found["rim_radius"][-1] < found["rim_radius"][0]


def test_a_force_releases_in_time():
    loading = ck.ImposedForce(force=1.5e-4, initial_gap=1e-6, final_gap=4e-6)
    found = ck.simulate(ck.plan(scene(loading)))
    assert found.status == "released"
    assert found["pull"][1:] == pytest.approx(1.5e-4, rel=1e-6)
    # Case pull_force_beta1.
    assert np.interp(0.2, found["time"], found["gap"]) == pytest.approx(3.35735e-6, rel=1e-3)


@pytest.mark.slow
def test_a_film_ruptures_and_says_when():
    limit = ck.TensionLimit(strength=3500.0, cavity_pressure=101325.0 - 1000.0)
    found = ck.simulate(ck.plan(scene(effects=(limit,)), ck.Accuracy(film_rtol=5e-3)))
    assert found.scalars()["rupture_time"][0] == pytest.approx(0.1879, rel=5e-3)
    assert found["void_volume"].max() > 1e-14
    assert "ruptured" in found.message


def test_files_and_copies(pulled, tmp_path):
    made = scene(
        ck.PressAndPull(press=1e-5, rest=2.0, force=1e-4, initial_gap=1e-6, final_gap=6e-6),
        (ck.SolidContact(cutoff=1e-7), ck.TensionLimit()),
    )
    path = tmp_path / "scene.toml"
    ck.save_scene(made, path)
    assert ck.load_scene(path) == made
    for copy in (ck.load_result(pulled.save(tmp_path / "r")), pickle.loads(pickle.dumps(pulled))):
        assert copy["pull"].tolist() == pulled["pull"].tolist()
        assert str(copy) == str(pulled)
        assert copy.section(0.1).gap.tolist() == pulled.section(0.1).gap.tolist()
        assert [str(one) for one in copy.validity] == [str(one) for one in pulled.validity]


@pytest.mark.slow
def test_a_study_varies_it():
    rough = ck.Accuracy(film_rtol=2e-2)
    study = ck.study(scene(), {"loading.speed": [5e-6, 1e-5]}, rough)
    slow, fast = study.column("pull_off_force")
    assert slow < fast


def test_figures_are_drawn(pulled):
    pytest.importorskip("matplotlib")
    assert {"loop", "gaps", "sections", "energies"} <= set(pulled.plot.available)
    for draw in pulled.plot.pictures().values():
        assert draw().get_xlabel()


def test_the_plan_states_what_decides():
    text = str(ck.plan(scene()))
    assert "beta = 1" in text
    assert "D/D_c = 0.125" in text
    fast = attrs.evolve(PULL, speed=1e-3)
    stiff = attrs.evolve(GEL, young_modulus=1e9)
    assert "list TensionLimit()" in str(ck.plan(scene(fast, solid=stiff)))


def test_columns_of_other_scenes_are_refused(pulled):
    with pytest.raises(ck.NotSimulatedError, match="van-der-waals"):
        pulled["van_der_waals_force"]
    with pytest.raises(ck.NotSimulatedError, match="solid-contact"):
        pulled.of(ck.SolidContact)
    with pytest.raises(ck.NotSimulatedError, match=r"no maps: .* on rings; see result\.section"):
        pulled.maps(0.0)
