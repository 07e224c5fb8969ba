"""A micromirror's landing on a compliant site: energy, limits, FMUs against a monolithic model."""

from __future__ import annotations

import json
import math
from itertools import pairwise

import pytest
from attrs import evolve

from contactkit.analyses.load_displacement.curve import LoadDisplacementCurve, Unloading
from contactkit.app.scenes import open_scene
from contactkit.errors import DescriptionError, InfeasibleError
from contactkit.files.scenes import unstructure
from contactkit.fmu.python import build as building
from contactkit.fmu.slaves.tip_contact import TipStatus
from contactkit.models.end_stop.faces import StopFaces
from contactkit.models.end_stop.solve import _curve_of, solved
from contactkit.models.micromirror.coupling import couple
from contactkit.models.micromirror.flight import Root
from contactkit.models.micromirror.monolithic import simulate_monolithic
from contactkit.models.micromirror.report.cosimulation import couple_fmus, tip_start
from contactkit.models.micromirror.report.landing_sites import landing_numbers
from contactkit.models.micromirror.tip import advance_tip, free_start, landed_start, tip_force
from contactkit.models.micromirror.tip_film import tip_law
from contactkit.models.micromirror.tip_impact import TipStop, rebound_work
from contactkit.reading.references import resolved_references

# A summit that is plastic all over is meant.
pytestmark = [
    pytest.mark.slow,
    pytest.mark.filterwarnings("ignore::contactkit.ValidityWarning"),
]

MASS, STIFFNESS = 4e-16, 1.0


def hertz(factor=1.0, most=4e-9, yields=True):
    """A ball of aluminium on its like; unloading curves are a fifth short, as after yielding."""
    k = factor * 4.0 / 3.0 * 39.3e9 * math.sqrt(1e-7)
    depths = [most * 2.0 ** (-i / 2.0) for i in range(16, -1, -1)]
    force = [k * d**1.5 for d in depths]
    area = [math.pi * 1e-7 * d for d in depths]
    fractions = [0.1, 0.3, 0.6, 1.0]
    ways = [
        Unloading(
            d, 0.2 * d, tuple(fractions), tuple(s**1.5 for s in fractions), tuple(fractions), 0.0
        )
        for d in depths[4:]
    ]
    return LoadDisplacementCurve(
        approach=depths,
        force=force,
        contact_area=area,
        plastic_area=[0.0] * len(depths),
        unloading=tuple(ways) if yields else (),
        nominal_area=1e-13,
        elastic_limit=depths[3] if yields else most,
    )


@pytest.fixture(scope="module")
def curve():
    return hertz()


@pytest.fixture(scope="module")
def scene():
    return open_scene("micromirror").scene


@pytest.fixture(scope="module")
def dry(scene):
    return tip_law(scene.tip, 0.0, 1e-8)


def until_off(made, stop, speed, height=1e-12, most=200):
    """A free tip that strikes its site once: its state as it is off again, or at rest."""
    state = free_start(made, height, -speed)
    root = Root(height)
    for _ in range(most):
        before = state
        state = advance_tip(made, 0.0, state, root, 5e-11, stop)
        if state.n_landings and not state.touching:
            return before, state
    raise AssertionError("still striking")


# One tip ------------------------------------------------------------------------------------


def energy(made, state, height):
    """Kinetic, of the spring, and of the site at rest, over that of a tip at touch [J]."""
    bend = made.scene.loading.initial_gap + height - (state.motion.gap - state.depth)
    return 0.5 * MASS * state.motion.speed**2 + 0.5 * STIFFNESS * bend**2


@pytest.mark.parametrize("speed", [0.05, 0.5, 2.0])
def test_an_impact_dissipates_the_area_of_its_loop(curve, dry, speed):
    """Before and after an impact, both at touch: the loop is missing, but for the indentation."""
    stop, made = TipStop(curve), evolve_without_attraction(dry)
    state = free_start(made, 1e-15, -speed)
    root = Root(1e-15)
    first = energy(made, state, 1e-15)
    _, off = until_off(made, stop, speed, 1e-15)
    # Going on to a hop's top and back changes nothing: only spring and site act.
    assert off.landing_loss == pytest.approx(curve.dissipated_work(off.largest), rel=1e-9)
    assert first - energy(made, off, root.height) == pytest.approx(off.landing_loss, rel=2e-4)
    assert off.depth == off.residual == curve.residual(off.largest)
    assert off.peak == pytest.approx(curve.at(off.largest).force, rel=1e-5)


def evolve_without_attraction(made):
    """The same tip where solids hardly attract: a hundred thousandth of it."""
    from contactkit import VanDerWaalsForce, plan

    weak = tuple(
        evolve(e, hamaker_constant=1e-24) if isinstance(e, VanDerWaalsForce) else e
        for e in made.scene.effects
    )
    return plan(evolve(made.scene, effects=weak), made.accuracy)


def test_an_elastic_site_gives_all_back(dry):
    stop, made = TipStop(hertz(yields=False)), evolve_without_attraction(dry)
    _, off = until_off(made, stop, 0.5, 1e-15)
    assert off.landing_loss == 0.0
    assert energy(made, off, 1e-15) == pytest.approx(0.5 * MASS * 0.25, rel=1e-5)
    assert off.residual == 0.0
    # Hertz: d_max = (5 m v^2/(4 k))^(2/5), but for the spring
    k = 4.0 / 3.0 * 39.3e9 * math.sqrt(1e-7)
    assert off.largest == pytest.approx((5 * MASS * 0.25 / (4 * k)) ** 0.4, rel=2e-3)


def test_damping_dissipates_its_part(dry):
    """Hunt and Crossley: the speeds solve an equation of their own, whatever the curve."""
    made, damping, came = evolve_without_attraction(dry), 1.0, 0.5
    _, off = until_off(made, TipStop(hertz(yields=False), damping), came, 1e-15)
    left = off.motion.speed

    def work(speed, sign):
        return sign * speed / damping - math.log1p(sign * damping * speed) / damping**2

    assert work(left, -1.0) == pytest.approx(work(came, 1.0), rel=5e-3)
    assert off.landing_loss == pytest.approx(0.5 * MASS * (came**2 - left**2), rel=5e-3)


@pytest.mark.slow
def test_a_stiff_dead_site_is_the_rigid_one(dry):
    """A site 10, 100, 1000 times as hard that gives nothing back: depths fall as factor^-2/5."""
    depths, rigid = [], advance_tip(dry, 0.0, free_start(dry, 1e-9, -0.1), Root(1e-9), 2e-8)
    assert rigid.motion.in_contact
    for factor in (10.0, 100.0, 1000.0):
        dead = dead_curve(factor)
        state = advance_tip(dry, 0.0, free_start(dry, 1e-9, -0.1), Root(1e-9), 2e-8, TipStop(dead))
        # What is left is the thousandth that this site does give back: hops of a picometre.
        assert abs(state.motion.speed) < 0.02 * math.sqrt(2.0 * rigid.landing_loss / MASS)
        assert state.gap == pytest.approx(rigid.gap, abs=3e-12)
        assert state.landing_loss == pytest.approx(rigid.landing_loss, rel=2.0 / factor**0.4)
        depths.append(state.largest)
    orders = [math.log10(a / b) for a, b in pairwise(depths)]
    assert orders == pytest.approx([0.4, 0.4], abs=0.05)


def dead_curve(factor):
    one = hertz(factor)
    dead = tuple(u._replace(residual_approach=0.999 * u.max_approach) for u in one.unloading)
    low = 1e-5 * one.approach[0]  # yields from the start
    return evolve(
        one,
        unloading=(
            dead[0]._replace(
                max_approach=one.approach[0], residual_approach=0.999 * one.approach[0]
            ),
            *dead,
        ),
        elastic_limit=low,
    )


def test_a_stiff_elastic_site_releases_as_the_rigid_one(dry):
    """From rest, to the first order of its compliance."""
    root, errors = Root(-5e-8, 0.2), []
    rigid = advance_tip(dry, 0.0, landed_start(dry), root, 6e-7).free_time
    for factor in (1.0, 30.0, 900.0):
        stop = TipStop(hertz(factor, yields=False))
        state = landed_start(dry, stop=stop, height=-5e-8)
        whole = advance_tip(dry, 0.0, state, root, 6e-7, stop)
        assert whole.largest < 1e-9 / factor**0.6
        errors.append(abs(whole.free_time / rigid - 1.0))
    assert errors[0] < 1e-4
    assert errors[2] <= errors[0]


def test_a_resting_tip_sinks_in_by_what_presses(curve, dry):
    stop = TipStop(curve)
    for height in (-1e-9, -5e-8):
        state = landed_start(dry, stop=stop, height=height)
        spring = tip_force(dry, 0.0, state, height, 0.0)
        pressed = dry.film.static_force(4e-10) - spring
        assert curve.at(state.depth, state.largest).force == pytest.approx(pressed, rel=1e-9)
        assert state.gap == pytest.approx(4e-10 - (state.depth - state.residual), rel=1e-12)
        later = advance_tip(dry, 0.0, state, Root(height), 1e-7, stop)
        assert later.impulse == pytest.approx(1e-7 * spring, rel=1e-9)
        assert later.motion.in_contact


def test_a_step_divides_as_one_likes(curve, dry):
    stop, root = TipStop(curve, 1.0), Root(5e-9, -0.3, 1e6)
    whole = advance_tip(dry, 2e-10, free_start(dry, 5e-9, -0.5), root, 1.5e-7, stop)
    parts = free_start(dry, 5e-9, -0.5)
    for i in range(50):
        parts = advance_tip(dry, 2e-10, parts, root.after(i * 3e-9), 3e-9, stop)
    assert parts.n_landings == whole.n_landings > 1
    assert parts.largest == pytest.approx(whole.largest, rel=1e-5)
    assert parts.impulse == pytest.approx(whole.impulse, rel=1e-4)


def test_beyond_its_curve_it_is_refused(dry):
    stop = TipStop(hertz(most=1e-9))
    with pytest.raises(InfeasibleError, match=r"beyond 1e-09 m .* a larger approach"):
        until_off(dry, stop, 20.0)


def test_rebound_work_is_that_of_the_curve(curve):
    deep = 2e-9
    assert rebound_work(curve, deep, deep) == pytest.approx(curve.elastic_work(deep), rel=0.02)
    assert rebound_work(curve, 0.2 * deep, deep) == 0.0


# Mirror -------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def soft(scene, curve, tmp_path_factory):
    """One flip onto compliant sites, dry; the curve is that of the test, not solved again."""
    _curve_of.cache_clear()
    wave = evolve(scene.mirror.waveform, start_delay=0.0, flips=1, period=4.5e-6)
    tips = evolve(scene.mirror.tips, faces=StopFaces(contact=hertz_scene()), landing_damping=1.0)
    mirror = evolve(scene.mirror, waveform=wave, tips=tips)
    study = evolve(scene.study, humidity=0.0, communication_step=20e-9)
    return evolve(scene, mirror=mirror, study=study)


def hertz_scene():
    """The contact of an apex, on a coarse grid."""
    film = {"name": "film", "young_modulus": 70e9, "poisson_ratio": 0.33, "hardness": 1.2e9}
    return {
        "interface": {
            "lower": {"solid": film},
            "upper": {"solid": film, "surface": {"shape": "paraboloid", "radius": 1e-7}},
        },
        "window": {"width": 9e-8, "periodic": False},
        "loading": {"kind": "approach", "approach": 4e-9},
        "effects": [{"effect": "half-space"}, {"effect": "hardness-limit", "rule": "material"}],
        "accuracy": {"grid": 32, "rtol": 1e-4},
    }


@pytest.mark.exhaustive
def test_a_pair_of_fmus_bounces_as_the_monolithic_model(soft, tmp_path):
    end = 3.72e-6
    plan = tip_law(soft.tip, 0.0, 1e-7)
    whole = simulate_monolithic(soft.mirror, plan, soft.start, end, rtol=1e-7, stop=soft.stop)
    lands = [e.time for e in whole.events if (e.what, e.side) == ("lands", -1.0)]
    assert [e.what for e in whole.events if e.side < 0.0][:3] == ["lands", "bounces", "lands"]
    path = building.build("tip-contact", tmp_path / "tip.fmu", start=tip_start(soft, 0.0))
    run = couple_fmus(soft, path, soft.mirror, end, 20e-9)
    tips = soft.tips(plan)
    couple(soft.mirror, tips, soft.loading.stiffness, soft.start, end, 20e-9)
    plus, minus = run.sites
    assert run.free_time == pytest.approx(whole.first("is free"), rel=3e-5)
    assert minus["n_land"] == tips[1].state.n_landings == len(lands) == 2
    assert tips[1].state.landing_time == pytest.approx(lands[-1], rel=1e-4)
    for name, mine in (("d_max", "largest"), ("F_max", "peak")):
        assert minus[name] == pytest.approx(getattr(tips[1].state, mine), rel=1e-4)
    assert minus["d_max"] == pytest.approx(1.16e-9, rel=0.02)
    lines, numbers = landing_numbers(soft, run)
    assert "landing sites: at most" in lines[0]
    assert numbers["landing_impacts"] == (2.0, "-")
    assert numbers["landing_energy_dissipated"][0] == plus["W_land"] + minus["W_land"] > 0.0


@pytest.mark.filterwarnings("ignore:fraction of the contact:contactkit.errors.ValidityWarning")
def test_it_starts_at_rest(soft):
    plan = tip_law(soft.tip, 0.0, 1e-7)
    still = evolve(soft.mirror, waveform=evolve(soft.mirror.waveform, start_delay=1.0))
    motion = couple(still, soft.tips(plan), soft.loading.stiffness, soft.start, 1e-6, 5e-8)
    assert abs(motion["tilt"] - soft.start[0]).max() < 1e-9


@pytest.mark.slow
def test_the_fmu_restores_an_impact(soft, open_fmu, tmp_path):
    path = building.build("tip-contact", tmp_path / "tip.fmu", start=tip_start(soft, 0.0))
    assert building.validate(path) == []
    host = open_fmu(path)
    host.start(z=1e-9)

    def fall(first, last):
        for i in range(first, last):
            host.set(z=1e-9 - 0.5 * i * 1e-10, vz=-0.5)
            assert host.step(1e-10, i * 1e-10) == 0
        return host.outputs()

    fall(0, 200)
    state, time = host.slave.getFMUState(), host.time
    once = fall(200, 500)
    host.slave.setFMUState(state)
    host.time = time
    assert fall(200, 500) == once
    host.slave.freeFMUState(state)
    assert once["d_max"] > 0.0
    assert once["n_land"] >= 1
    assert once["F_max"] > 1e-8
    assert once["W_land"] >= once["W_plastic"] >= 0.0
    assert once["state"] in (TipStatus.LANDED, TipStatus.HELD)


@pytest.mark.slow
def test_on_a_rigid_site_there_is_nothing_to_damp(scene, open_fmu, tmp_path):
    path = building.build("tip-contact", tmp_path / "r.fmu", start=tip_start(scene, 0.0))
    host = open_fmu(path)
    host.slave.setupExperiment(startTime=0.0)
    host.set(d_stop=1.0)
    host.slave.enterInitializationMode()
    host.slave.exitInitializationMode()
    assert host.step(1e-8) != 0
    assert "d_stop must be 0 on a rigid site" in host.errors[0]


# Scene files --------------------------------------------------------------------------------


@pytest.mark.filterwarnings("ignore:fraction of the contact:contactkit.errors.ValidityWarning")
def test_a_scene_names_its_faces(soft):
    table = unstructure(soft)["mirror"]["tips"]
    assert table["faces"]["contact"] == hertz_scene()
    assert table["landing_damping"] == 1.0
    assert soft.stop.curve == solved(StopFaces(contact=json.loads(json.dumps(hertz_scene()))))
    twice = StopFaces(contact=hertz_scene(), area=2.0 * soft.stop.curve.nominal_area)
    assert solved(twice).force[-1] == pytest.approx(2.0 * soft.stop.curve.force[-1])


def test_mistakes_in_faces_are_reported(soft):
    tips = soft.mirror.tips
    with pytest.raises(DescriptionError, match=r"SpringTips.landing_damping must be 0 on a rigid"):
        evolve(tips, faces=None)
    with pytest.raises(DescriptionError, match=r"StopFaces.contact must be a contact scene"):
        StopFaces(contact=3.0)
    with pytest.raises(DescriptionError, match=r"StopFaces.area must be positive and finite"):
        StopFaces(contact="contact-stop", area=0.0)
    with pytest.raises(DescriptionError, match="name a contact scene, with a window"):
        solved(StopFaces(contact="micromirror"))
    with pytest.raises(DescriptionError, match="be a file or the name of a scene"):
        solved(StopFaces(contact="contact-stopp"))


def test_a_file_is_looked_for_beside_the_one_that_names_it(tmp_path):
    (tmp_path / "mine.toml").write_text("")
    given = {"valve": {"stop": {"faces": {"contact": "mine.toml", "area": 1.0}}}, "name": "x"}
    found = resolved_references(given, tmp_path / "device.toml")
    assert found["valve"]["stop"]["faces"]["contact"] == str(tmp_path.resolve() / "mine.toml")
    given["valve"]["stop"]["faces"]["contact"] = "contact-stop"
    assert resolved_references(given, tmp_path / "device.toml") == given
