"""Every effect of a separation, alone and in pairs, under every imposed motion: run, save, read.

What a scene can not have is refused by the plan with the name of what is missing; what it has is
finite, is cited, and comes back from a file as it was.
"""

from __future__ import annotations

import itertools
import math

import attrs
import loadings
import numpy as np
import pytest
from matplotlib.figure import Figure

import contactkit as ck
from contactkit.capillary.exact.bridge import bridge, bridge_at_pressure
from contactkit.plot import separation as separation_plot
from contactkit.separation.validity import is_whole

pytestmark = pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning")

WATER = ck.Liquid(
    name="water", surface_tension=0.072, viscosity=0.89e-3, density=997.0, molar_mass=0.018015
)
FACE, BALL = ck.Flat(radius=1e-5), ck.Sphere(radius=1e-5)
SUMMITS = ck.AsperityPopulation(density=1e13, radius=1e-6, rms_height=2e-9)

EFFECTS = (
    ck.MeniscusForce(),
    ck.MeniscusForce(profile="arc"),
    ck.MeniscusForce(profile="as-published"),
    ck.ViscousForce(),
    ck.ViscousForce(closure="as-published"),
    ck.ViscousForce(closure="flooded"),
    ck.TensionLimit(strength=1e6, cavity="truncated"),
    ck.ShearLimit(strength=1e6),
    ck.Rupture(),
    ck.Rupture(gap="zero-neck"),
    ck.Rupture(gap=1.5e-8),
    ck.VanDerWaalsForce(hamaker_constant=1e-20),
    ck.AdhesiveContact(work_of_adhesion=0.05, reduced_modulus=70e9),
    ck.AdhesiveContact(work_of_adhesion="capillary", reduced_modulus=70e9, model="jkr"),
    ck.AsperityMenisci(asperities=SUMMITS),
    ck.AsperityMenisci(asperities=SUMMITS, law="identical", profile="thin-film"),
)
FILMS = {
    "volume": {"volume": 3e-19},
    "menisci": {"volume": 3e-19, "count": 7},
    "humidity": {"pressure": -1.5e7},
    "bath": {},
}
MOTIONS = {
    "speed": {"speed": 1e-6},
    "time": {"time": 1e-2},
    "force": {"force": 1e-2, "mass": 1e-9},
    "vibration": {"speed": 1e-6, "vibration": ck.Vibration(amplitude=1e-10, frequency=60.0)},
}
FEW = ck.Accuracy(points=12)


def scene(effects, body, film, motion):
    sticks = any(isinstance(effect, ck.AdhesiveContact) for effect in effects)
    meniscus = ck.Meniscus(
        liquid=WATER, contact_angle_lower=0.3, contact_angle_upper=0.5, **FILMS[film]
    )
    gap = 0.2e-9 if sticks else 5e-9
    return ck.SeparationScene(
        interface=ck.Interface(lower=FACE, upper=body, meniscus=meniscus),
        loading=loadings.imposed(initial_gap=gap, final_gap=4e-8, **MOTIONS[motion]),
        effects=effects,
    )


def combinations(motion):
    """Each effect alone on everything; pairs on one body and film each, in turn."""
    places = list(itertools.product((FACE, BALL), FILMS))
    for effect in EFFECTS:
        for body, film in places:
            yield scene((effect,), body, film, motion)
    pairs = (p for p in itertools.combinations(EFFECTS, 2) if type(p[0]) is not type(p[1]))
    shift = list(MOTIONS).index(motion)
    for i, pair in enumerate(pairs):
        if i % 3 == shift % 3:
            yield scene(pair, *places[(5 * i + 3 * shift) % 8], motion)


NOT_REACHED = {"release_time", "release_speed", "break_time", "peak_time"}
"""Numbers of a motion that are nan where it did not come to them."""


def examine(result, made):
    shape = {column.name for column in ck.MeniscusForce.late}
    whole = is_whole(result.plan, result.columns)
    for name, column in result.columns.items():
        assert np.array_equal(np.isfinite(column), whole | (name not in shape)), name
    for name, (value, _) in result.scalars().items():
        assert math.isfinite(value) or name in NOT_REACHED, name
    listed = {type(effect) for effect in made.effects}
    for kind in {type(effect) for effect in EFFECTS} - listed:
        with pytest.raises(ck.NotSimulatedError, match=rf"add {kind.__name__}\("):
            result.of(kind)
    printed = any(
        "as-published" in (getattr(effect, "form", ""), getattr(effect, "closure", ""))
        or effect == EFFECTS[9]
        for effect in made.effects
    )
    assert bool(result.errata) == printed


def same(again, result):
    assert again.plan.scene == result.plan.scene
    assert again.scalars() == result.scalars()
    assert again.errata == result.errata
    assert [str(n) for n in again.validity] == [str(n) for n in result.validity]
    assert again.columns.keys() == result.columns.keys()
    for name, column in result.columns.items():
        np.testing.assert_array_equal(again.columns[name], column)


@pytest.mark.slow
@pytest.mark.parametrize("motion", MOTIONS)
def test_every_effect_alone_and_in_pairs(motion, tmp_path):
    refusals, done = [], 0
    for i, made in enumerate(combinations(motion)):
        try:
            plan = ck.plan(made, loadings.with_points(made, 12))
        except (ck.PlanError, ck.InfeasibleError) as error:
            refusals.append((str(error), made.effects))
            continue
        assert "  on   " in str(plan)
        assert plan.cite()
        result = ck.simulate(plan)
        examine(result, made)
        done += 1
        if i % 5 == 0:  # files are slow
            same(ck.load_result(ck.save_result(result, tmp_path / "r")), result)
            assert ck.load_scene(ck.save_scene(made, tmp_path / "s.toml")) == made
        if i % 11 == 0:
            draw(result)
    assert len(refusals) > 50
    assert done > 50
    for message, effects in refusals:
        names = [*(type(effect).__name__ for effect in effects), "no meniscus spans", "one force"]
        assert any(name in message for name in names), message


def draw(result):
    forces = {force.name for force in result.plan.forces} & result.columns.keys()
    ax = Figure().subplots()
    if forces:
        separation_plot.forces(result, ax)
    else:
        with pytest.raises(ck.NotSimulatedError, match="no pull: with time imposed"):
            separation_plot.forces(result, ax)
    if "mean_pull" in result.columns:
        separation_plot.cycles(result, ax)


# What was found by it -------------------------------------------------------------------------


def test_a_figure_of_no_force_is_refused_and_one_of_a_zero_force_is_drawn():
    viscous = ck.simulate(ck.plan(scene((EFFECTS[3],), BALL, "volume", "time"), FEW))
    with pytest.raises(ck.NotSimulatedError, match="impose a speed or a force"):
        separation_plot.forces(viscous)
    far = attrs.evolve(EFFECTS[-1], meniscus_height=1e-9)
    with pytest.raises(ck.InfeasibleError, match=r"this liquid reaches 1e-09 m at most; give a sm"):
        ck.plan(scene((far,), FACE, "bath", "speed"))
    dry = attrs.evolve(EFFECTS[-2], meniscus_height=1e-12, profile="thin-film")
    drawn = ck.simulate(ck.plan(scene((dry,), FACE, "bath", "speed"), FEW))
    ax = separation_plot.forces(drawn)
    assert "meniscus force at the asperities [N]" not in ax.get_ylabel()
    assert [line.get_label() for line in ax.get_lines()] == [
        "meniscus force at the asperities",
        "pull",
    ]


def test_validity_is_judged_while_the_film_is_there():
    """A body that flies on after its film has broken is not one of a film of large Reynolds."""
    pull = {"force": 1.0, "mass": 1e-9}
    effects = (ck.ViscousForce(), ck.Rupture(gap=6e-9))
    made = scene(effects, FACE, "volume", "force")
    loading = loadings.imposed(initial_gap=5e-9, final_gap=1e-3, **pull)
    result = ck.simulate(ck.plan(attrs.evolve(made, loading=loading)))
    whole = result["film_status"] != ck.FilmStatus.BROKEN
    assert result.gap[~whole].max() == pytest.approx(1e-3)
    assert result.speed[~whole].max() > 10.0 * result.speed[whole].max()
    worst = 997.0 * (result.speed * result.gap)[whole].max() / 0.89e-3
    (found,) = [number for number in result.validity if number.name == "Reynolds number"]
    assert 0.9 * worst < found.value <= worst  # at the steps, which the curve has points between


@pytest.mark.parametrize("limit", [EFFECTS[6], EFFECTS[7]], ids=lambda effect: effect.name)
def test_a_limit_in_a_given_time_is_refused_before_any_work(limit):
    made = scene((ck.ViscousForce(), limit), FACE, "volume", "time")
    with pytest.raises(ck.PlanError, match="needs a speed or a force imposed"):
        ck.plan(made)
    with pytest.raises(ck.PlanError, match="needs a speed or a force imposed"):
        ck.study(made, {"loading.time": [1e-3, 1e-2]})


def test_a_gap_too_wide_for_a_vapour_names_its_pressure():
    loading = ck.ImposedSpeed(initial_gap=1e-7, final_gap=1e-6, speed=1e-6)
    made = attrs.evolve(scene((EFFECTS[0],), BALL, "humidity", "speed"), loading=loading)
    with pytest.raises(
        ck.InfeasibleError, match=r"this pressure of -1\.5e\+07 Pa reaches .*a higher humidity"
    ):
        ck.plan(made)


@pytest.mark.parametrize("value", ["150 %", 50, -0.1, math.nan, True])
def test_an_impossible_humidity_is_named(value):
    with pytest.raises(ck.DescriptionError, match=r"relative_humidity must lie between 0 and 1"):
        ck.Meniscus(liquid=WATER, relative_humidity=value)


@pytest.mark.parametrize("field", ["coverage", "area", "at_gap"])
def test_an_impossible_coverage_is_named(field):
    given = {"coverage": 0.5, "area": 1e-12, "at_gap": 1e-9} | {field: "2 nm"}
    with pytest.raises(ck.DescriptionError, match=rf"from_coverage\({field}\) must"):
        ck.Meniscus.from_coverage(liquid=WATER, **given)


# Humidity, many menisci, modes, studies --------------------------------------------------------


@pytest.mark.parametrize("motion", ["speed", "time", "force"])
@pytest.mark.parametrize("humidity", [0.3, 0.7, 0.95])
def test_a_humid_sphere_with_its_film(humidity, motion):
    """Meniscus by the exact bridge of its pressure; viscous film as high as that is at its rim."""
    moist = ck.Meniscus(liquid=WATER, relative_humidity=humidity)
    loading = loadings.imposed(initial_gap=0.3e-9, final_gap=4e-8, **MOTIONS[motion])
    effects = (ck.MeniscusForce(), ck.ViscousForce())
    made = ck.SeparationScene(
        interface=ck.Interface(upper=BALL, meniscus=moist), loading=loading, effects=effects
    )
    result = ck.simulate(ck.plan(made, loadings.with_points(made, 12)))
    over = made.liquid_pressure / 0.072
    gaps = np.array([0.3e-9, 0.5e-9])
    exact = 0.072 * bridge_at_pressure(gaps, over, 0.0, 0.0, 0.0, 1e5).force
    law = result.plan.film.laws[ck.MeniscusForce]
    assert [law.force(gap, 0.0) for gap in gaps] == pytest.approx(exact, rel=1e-6)
    impulse = result.of(ck.ViscousForce).impulse
    assert impulse > 0.0
    level, start = 2.0 / -over, 0.3e-9
    end = min(result.plan.film.end, level)
    other = 6.0 * math.pi * 0.89e-3 * 1e-10 * trapezoid_impulse(level, start, end)
    assert impulse == pytest.approx(other, rel=1e-4)


def trapezoid_impulse(level, start, end):
    """Integral of (1 - D/H)^2/D: Reynolds' force between rim height H and gap D, quadrature."""
    log = np.linspace(math.log(start), math.log(end), 20001)
    gap = np.exp(log)
    value = (1.0 - gap / level) ** 2
    return float(np.sum(0.5 * (value[1:] + value[:-1]) * np.diff(log)))


def test_menisci_add_up_and_too_many_name_the_limit():
    one = scene((EFFECTS[0],), FACE, "volume", "speed")
    for count in (1, 7, 100):
        film = attrs.evolve(one.interface.meniscus, count=count)
        made = attrs.evolve(one, interface=ck.Interface(meniscus=film))
        exact = 0.072 * count * float(bridge(5e-9, 3e-19 / count, 0.3, 0.5).force)
        assert ck.plan(made).film.static_force(5e-9) == pytest.approx(exact, rel=1e-7)
    most = ck.divide_meniscus(
        attrs.evolve(one, interface=ck.Interface(meniscus=one.interface.meniscus))
    ).max_stable_count
    film = attrs.evolve(one.interface.meniscus, count=10 * most)
    with pytest.raises(ck.InfeasibleError, match=rf"at most {most} menisci"):
        ck.plan(attrs.evolve(one, interface=ck.Interface(meniscus=film)))


def test_no_result_mixes_what_is_printed_with_what_is_right():
    """All pairs of choices, under all motions: either one mode, or refused by name."""
    right = (EFFECTS[0], ck.Rupture())
    for printed, consistent in itertools.product((EFFECTS[2], EFFECTS[4], EFFECTS[9]), right):
        if type(printed) is type(consistent):
            continue
        for motion in MOTIONS:
            made = scene((printed, consistent), FACE, "volume", motion)
            with pytest.raises(ck.PlanError, match="never both; choose one mode"):
                ck.plan(made)


def test_a_study_goes_on_where_a_point_has_no_answer():
    made = scene((EFFECTS[0],), FACE, "volume", "speed")
    made = attrs.evolve(
        made,
        interface=attrs.evolve(
            made.interface, meniscus=attrs.evolve(made.interface.meniscus, contact_angle_lower=0.0)
        ),
    )
    found = ck.study(
        made, {"interface.meniscus.contact_angle_upper": ["0 deg", "90 deg", "180 deg"]}, FEW
    )
    assert [point.status for point in found.points] == ["curve", "curve", "infeasible"]
    assert "spreads" in found.points[2].message
    profiles = ck.study(
        attrs.evolve(made, effects=(EFFECTS[0], ck.Rupture())),
        {"effects.meniscus-force.profile": ["exact", "as-published"]},
        FEW,
    )
    assert [point.status for point in profiles.points] == ["curve", "refused"]


@pytest.mark.parametrize("angle", [100.0, 150.0])
def test_a_drop_that_repels_a_sphere_warns(angle):
    film = ck.Meniscus(
        liquid=WATER,
        volume=1e-16,
        contact_angle_lower=math.radians(angle),
        contact_angle_upper=math.radians(angle),
    )
    made = ck.SeparationScene(
        interface=ck.Interface(upper=BALL, meniscus=film),
        loading=ck.ImposedSpeed(initial_gap=1e-7, final_gap=1e-6, speed=1e-6),
        effects=(EFFECTS[0],),
    )
    with pytest.warns(ck.ValidityWarning, match="laterally unstable"):
        result = ck.simulate(ck.plan(made, loadings.with_points(made, 12)))
    assert result["meniscus_force"][0] < 0.0
    flat = attrs.evolve(made, interface=ck.Interface(meniscus=film))
    names = [number.name for number in ck.simulate(ck.plan(flat, FEW)).validity]
    assert not any("2 pi R gamma" in name for name in names)
