"""Dynamic wetting called for by a scene: weight, dynamic angle, deposited film, column, rupture."""

from __future__ import annotations

import math

import numpy as np
import pytest
from attrs import evolve
from refusals import refuses
from scipy.integrate import solve_ivp

import contactkit as ck
from contactkit.capillary.exact.bridge import bridge
from contactkit.capillary.exact.stability import stability_limit
from contactkit.capillary.wetting.cox_voinov import dynamic_angle
from contactkit.files.scenes import load_scene, save_scene
from contactkit.lubrication.dimensionless import GRAVITY
from contactkit.separation.wetting.line import LEAST_LEFT
from contactkit.separation.wetting.losing_film import volume_nodes

pytestmark = pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning")

OIL = ck.Liquid(name="oil", viscosity=1.0, surface_tension=0.03, density=900.0)
RADIUS, VOLUME = 5e-3, 1e-11
FLAT, BALL = ck.Flat(), ck.Sphere(radius=RADIUS)
FEW = ck.Accuracy(points=12, curve_rtol=0.02)
MENISCUS, VISCOUS = ck.MeniscusForce(), ck.ViscousForce()


def drawn(*effects, upper=BALL, lower=FLAT, speed=1e-6, angles=(0.0, 0.0), first=5e-6, **film):
    meniscus = ck.Meniscus(
        liquid=OIL,
        volume=film.pop("volume", VOLUME),
        contact_angle_lower=angles[0],
        contact_angle_upper=angles[1],
        **film,
    )
    return ck.SeparationScene(
        interface=ck.Interface(lower=lower, upper=upper, meniscus=meniscus),
        loading=ck.ImposedSpeed(initial_gap=first, final_gap=3e-4, speed=speed),
        effects=effects,
    )


def run(*effects, **given):
    return ck.simulate(ck.plan(drawn(*effects, **given), FEW))


def number(result, name):
    return next(one for one in result.validity if one.name == name)


# Weight --------------------------------------------------------------------------------------


@pytest.mark.slow
def test_equal_spheres_share_the_weight_and_the_lower_one_is_pulled_less():
    weight = 900.0 * GRAVITY * VOLUME
    for body, share in (("upper", 0.5), ("lower", -0.5)):
        found = run(MENISCUS, ck.LiquidWeight(body=body), lower=BALL)
        force = found.of(ck.LiquidWeight).force[found.gap <= found.plan.film.end]
        assert force == pytest.approx(share * weight, rel=1e-12)


@pytest.mark.slow
def test_the_weight_of_a_bridge_on_a_flat_differs_between_its_bodies_by_itself():
    pulls = {body: run(MENISCUS, ck.LiquidWeight(body=body)).pull for body in ("upper", "lower")}
    assert pulls["upper"][0] - pulls["lower"][0] == pytest.approx(900.0 * GRAVITY * VOLUME)


def test_a_weight_that_is_taken_is_no_longer_warned_of_as_left_out():
    names = {one.name for one in run(MENISCUS, ck.LiquidWeight()).validity}
    assert "Bond number of the bridge" in names
    assert not names & {"Bond number", "weight of the meniscus over its force"}


@pytest.mark.slow
def test_a_bridge_that_its_weight_rules_is_refused():
    refuses(
        lambda: ck.plan(drawn(MENISCUS, ck.LiquidWeight(), volume=1e-8, upper=FLAT, first=1e-4)),
        "LiquidWeight", "Bond number", "1.37", "count",
        error=ck.InfeasibleError,
    )  # fmt: skip


# Trouton -------------------------------------------------------------------------------------


@pytest.mark.parametrize("count", [1, 4])
def test_a_column_between_flats_has_three_times_the_viscosity(count):
    found = run(VISCOUS, ck.TroutonForce(), upper=FLAT, count=count)
    gap = found.gap
    column = 3.0 * 1.0 * VOLUME / gap**2 * 1e-6
    assert found["trouton_force"] == pytest.approx(column, rel=1e-12)
    impulse = 3.0 * VOLUME * (1.0 / gap[0] - 1.0 / gap[-1])
    assert found.of(ck.TroutonForce).impulse == pytest.approx(impulse, rel=1e-9)
    # Spiegelberg, Ables and McKinley: 3 pi eta r^2 v/h (1 + r^2/(2 h^2)).
    square = VOLUME / count / (math.pi * gap)
    assert found.pull == pytest.approx(column * (1.0 + 0.5 * square / gap**2), rel=1e-9)


def test_the_column_between_spheres_is_the_mean_one_of_its_volume():
    found = run(VISCOUS, ck.TroutonForce(trouton_ratio=6.0), lower=BALL)
    reduced, gap = 0.5 * RADIUS, found.gap[0]
    height = math.sqrt(gap**2 + VOLUME / (math.pi * reduced))
    area = 2.0 * math.pi * reduced * (height - gap)
    expected = 6.0 * area**2 / VOLUME * 1e-6
    assert found["trouton_force"][0] == pytest.approx(expected, rel=1e-12)


@pytest.mark.slow
def test_weight_and_column_act_in_a_motion_too():
    pulled = ck.ImposedForce(force=5e-3, mass=1e-3, initial_gap=5e-6, final_gap=2e-4)
    scene = evolve(drawn(MENISCUS, VISCOUS, ck.LiquidWeight(), ck.TroutonForce()), loading=pulled)
    found = ck.simulate(ck.plan(scene))
    bare = evolve(scene, effects=scene.effects[:2])
    assert found.state.release_time > ck.simulate(ck.plan(bare)).state.release_time
    path = 3.0 * VOLUME  # of a sphere less than between flats, and of the size of it
    assert 0.0 < found.of(ck.TroutonForce).impulse < path / 5e-6


# Cox and Voinov ------------------------------------------------------------------------------


def test_at_rest_the_angle_is_that_at_rest_to_the_last_bit():
    scene = drawn(MENISCUS, ck.CoxVoinovAngle(), angles=(0.5, 0.8))
    still = ck.plan(drawn(MENISCUS, angles=(0.5, 0.8)))
    gaps = [5e-6, 5e-5, 2e-4]
    assert ck.plan(scene).force(gaps).tolist() == still.force(gaps).tolist()


@pytest.mark.slow
def test_the_force_is_that_of_the_bridge_with_the_angles_of_its_lines():
    """Lines by differences of solved bridges, angles by Cox, the bridge with these solved."""
    angles, gap, speed, slip = (0.5, 0.8), 4e-5, 2e-6, 1e-8
    plan = ck.plan(drawn(MENISCUS, ck.CoxVoinovAngle(slip_length=slip), angles=angles))
    fixed = (*angles, 0.0, 1.0 / RADIUS)
    near, far = (bridge(gap * x, VOLUME, *fixed) for x in (1.0 - 1e-4, 1.0 + 1e-4))
    height = math.sqrt(gap**2 + VOLUME / (math.pi * RADIUS))
    step = 2e-4 * gap
    arcs = [
        (far.radius_lower - near.radius_lower) / step,
        RADIUS
        * (np.arcsin(far.radius_upper / RADIUS) - np.arcsin(near.radius_upper / RADIUS))
        / step,
    ]
    assert max(arcs) < 0.0
    for way in (1.0, -1.0):
        drive = [way * speed / 0.03 * float(arc) * math.log(height / slip) for arc in arcs]
        moved = [dynamic_angle(*pair) for pair in zip(angles, drive, strict=True)]
        expected = 0.03 * bridge(gap, VOLUME, *moved, 0.0, 1.0 / RADIUS).force
        assert plan.force(gap, way * speed) == pytest.approx(float(expected), rel=1e-4)
    assert plan.force(gap, speed) > 1.005 * plan.force(gap) > 1.01 * plan.force(gap, -speed)


@pytest.mark.slow
def test_the_angles_are_curves_and_a_fast_line_wets():
    slow, fast = (
        run(MENISCUS, ck.CoxVoinovAngle(), angles=(0.5, 0.8), speed=v) for v in (1e-15, 1e-4)
    )
    assert slow["dynamic_angle_lower"][0] == pytest.approx(0.5, abs=1e-8)
    assert slow["dynamic_angle_upper"][-1] == pytest.approx(0.8, abs=1e-8)
    assert fast["dynamic_angle_lower"][0] == 0.0 == fast["dynamic_angle_upper"][0]
    wet = bridge(5e-6, VOLUME, 0.0, 0.0, 0.0, 1.0 / RADIUS)
    assert fast["meniscus_force"][0] == pytest.approx(0.03 * float(wet.force), rel=1e-4)
    assert fast["neck_radius"][0] == pytest.approx(float(wet.neck), rel=1e-4)


@pytest.mark.hard
@pytest.mark.slow
@pytest.mark.parametrize("upper", [FLAT, BALL], ids=["flat", "ball"])
@pytest.mark.parametrize("angles", [(0.5 * math.pi,) * 2, (math.pi, 1.2), (0.0, 0.0)])
def test_slow_lines_of_any_angle_change_nothing(upper, angles):
    found = run(MENISCUS, ck.CoxVoinovAngle(), upper=upper, angles=angles, speed=1e-18)
    still = run(MENISCUS, upper=upper, angles=angles, speed=1e-18)
    force = np.interp(still.gap, found.gap, found["meniscus_force"])
    scale = float(np.max(np.abs(still["meniscus_force"])))
    # An angle of 0 grows as the cube root of the speed where the line advances, near the end.
    assert force == pytest.approx(still["meniscus_force"], abs=1e-7 * scale)


@pytest.mark.slow
def test_a_touching_sphere_has_its_angles():
    found = run(MENISCUS, ck.CoxVoinovAngle(), angles=(0.5, 0.5), first=0.0)
    assert np.isfinite(found.pull).all()
    assert 0.0 < found["dynamic_angle_lower"][0] < 0.5


@pytest.mark.slow
def test_a_line_too_fast_and_a_film_too_thin_are_refused():
    for effect, speed, words in (
        (ck.CoxVoinovAngle(), 1e-2, ("CoxVoinovAngle", "capillary number", "-2.94", "lower speed")),
        (ck.CoxVoinovAngle(slip_length=1e-3), 1e-6, ("slip_length", "0.001 m", "smaller one")),
    ):
        scene = drawn(MENISCUS, effect, angles=(0.5, 0.5), speed=speed)
        refuses(lambda scene=scene: ck.plan(scene), *words, error=ck.InfeasibleError)


# Landau and Levich ---------------------------------------------------------------------------


def lost_alone(speed, last, law):
    """Volume lost [m3] by Landau and Levich, from bridges solved one by one; flats that wet."""

    def slope(gap, volume):
        v = float(volume[0])

        def line(h, v):
            return float(bridge(h, v, 0.0, 0.0).radius_lower)

        r, pressure = line(gap, v), float(bridge(gap, v, 0.0, 0.0).pressure)
        by_gap = (line(gap * 1.0001, v) - line(gap * 0.9999, v)) / (2e-4 * gap)
        by_volume = (line(gap, v * 1.0001) - line(gap, v * 0.9999)) / (2e-4 * v)
        lost = 0.0
        for _ in range(40):
            u = -by_gap + by_volume * lost
            thin = 1.3375 * (speed * u / 0.03) ** (2.0 / 3.0)
            thin = thin if law == "landau-levich" else thin / (1.0 + 2.5 * thin)
            lost = 4.0 * math.pi * r * thin / -pressure * u  # both bodies; curvature -P at 0 deg
        return [-lost]

    solved = solve_ivp(slope, (5e-6, last), [VOLUME], rtol=1e-4, atol=1e-4 * VOLUME, method="RK23")
    return VOLUME - float(solved.y[0, -1])


@pytest.mark.slow
@pytest.mark.parametrize("law", ["landau-levich", "aussillous-quere"])
def test_the_volume_left_is_that_of_lines_followed_one_by_one(law):
    found = run(MENISCUS, ck.LandauLevichFilm(law=law), upper=FLAT, speed=5e-6)
    last = 1e-4
    lost = float(np.interp(last, found.gap, found["deposited_volume"]))
    assert lost == pytest.approx(lost_alone(5e-6, last, law), rel=5e-3)
    assert 0.02 * VOLUME < lost < 0.2 * VOLUME


@pytest.mark.slow
def test_every_force_is_that_of_the_volume_left():
    effects = (MENISCUS, VISCOUS, ck.TroutonForce(), ck.LiquidWeight())
    found = run(*effects, ck.LandauLevichFilm(), speed=1e-4)
    for i in (0, len(found.gap) // 2):
        gap, lost = float(found.gap[i]), float(found["deposited_volume"][i])
        left = ck.plan(drawn(*effects, volume=VOLUME - lost, speed=1e-4))
        assert found.pull[i] == pytest.approx(left.force(gap, 1e-4), rel=2e-4)
        assert found["liquid_volume"][i] == pytest.approx(VOLUME - lost, rel=1e-9)
    assert lost > 0.05 * VOLUME
    end = float(found.plan.film.end)
    left = VOLUME - float(found["deposited_volume"][-1])
    limit = stability_limit(left, 0.0, 0.0, 0.0, 1.0 / RADIUS)
    assert end == pytest.approx(float(limit.gap), rel=1e-3)


@pytest.mark.slow
def test_a_line_at_rest_leaves_nothing_and_changes_no_bit():
    found = run(MENISCUS, VISCOUS, ck.LandauLevichFilm(), speed=1e-22)
    still = run(MENISCUS, VISCOUS, speed=1e-22)
    assert np.max(found["deposited_volume"]) < 1e-11 * VOLUME
    names = ("gap", "meniscus_force", "viscous_force")
    gaps = still.gap[:: len(still.gap) // 7]
    for name in names[1:]:
        one, other = (np.interp(gaps, r.gap, r[name]) for r in (found, still))
        assert one == pytest.approx(other, rel=1e-8)
    assert found.plan.film.end == pytest.approx(still.plan.film.end, rel=1e-11)


@pytest.mark.slow
@pytest.mark.parametrize("angle", [0.0, 0.8])
def test_contact_lines_of_equal_bridges_are_solved_once(monkeypatch, angle):
    """The plan, its ranges, the motion and the late curves ask for the lines of five volumes."""
    solved = []

    def counted(gaps, volume, lower, upper, *curvatures, **more):
        # Lines are tables at fixed angles; forces take fewer gaps, moving angles one for each gap.
        if np.size(gaps) > 100 and np.ndim(lower) == 0:
            solved.append(volume)
        return bridge(gaps, volume, lower, upper, *curvatures, **more)

    # A volume that no other test has: its lines are not known yet.
    volume = (1.0 + 0.03 * (1.0 + angle)) * VOLUME
    effects = [MENISCUS, *([ck.CoxVoinovAngle()] if angle else [])]
    monkeypatch.setattr("contactkit.capillary.exact.bridge.bridge", counted)
    for speed in (2e-5, 3e-5):
        film = run(*effects, ck.LandauLevichFilm(), volume=volume, angles=(angle,) * 2, speed=speed)
        assert np.max(film["deposited_volume"]) > 0.0
    assert len(solved) == len(set(solved))
    assert set(solved) >= {volume * node for node in volume_nodes(LEAST_LEFT)}


@pytest.mark.slow
def test_a_film_is_left_only_beyond_the_threshold_of_the_angle():
    both = MENISCUS, ck.CoxVoinovAngle(), ck.LandauLevichFilm()
    lost = []
    for speed in (1e-7, 1e-4):
        plan = ck.plan(drawn(*both, angles=(0.8, 0.8), speed=speed))
        left = np.array([plan.film.volume_fraction(gap) for gap in np.linspace(5e-6, 2e-4, 50)])
        assert (np.diff(left) <= 1e-9).all()
        lost.append(1.0 - left[-1])
    assert lost[0] == 0.0
    assert lost[1] > 0.01


@pytest.mark.slow
def test_a_film_of_landau_and_levich_is_refused_where_it_is_not_one():
    for effects, given, error, words in (
        ((ck.LandauLevichFilm(law="landau-levich"),), {"speed": 1e-2}, ck.InfeasibleError,
         ("capillary number", "law='landau-levich'", "0.1", "loading.speed")),
        ((ck.LandauLevichFilm(),), {"angles": (0.3, 0.3)}, ck.PlanError,
         ("angle of 0", "CoxVoinovAngle()")),
        ((ck.LandauLevichFilm(),), {"upper": ck.Flat(radius=1e-4), "angles": (0.0, 0.0)},
         ck.PlanError, ("faces wider than the film", "0.000318 m")),
        ((VISCOUS, ck.TensionLimit(strength=1e5), ck.LandauLevichFilm()), {"upper": FLAT},
         ck.PlanError, ('cavity="truncated"',)),
    ):  # fmt: skip
        scene = drawn(MENISCUS, *effects, **given)
        refuses(lambda scene=scene: ck.plan(scene), *words, error=error)
    plan = ck.plan(drawn(MENISCUS, ck.LandauLevichFilm()))
    refuses(lambda: plan.force(1e-5, 1e-6), "loses liquid", "ck.simulate", error=ck.PlanError)


# Rupture -------------------------------------------------------------------------------------


def test_a_bridge_drawn_out_fast_breaks_later_and_holds_until_then():
    at_rest = run(MENISCUS, VISCOUS).plan.film.end
    found = run(MENISCUS, VISCOUS, ck.DynamicRupture(), speed=3e-4)
    assert found.plan.film.end == pytest.approx(at_rest * 1.1, rel=1e-9)
    beyond = (found.gap > at_rest) & (found.gap <= found.plan.film.end)
    assert beyond.any()
    assert np.ptp(found["meniscus_force"][beyond]) == 0.0
    assert found["meniscus_force"][beyond][0] > 0.0
    assert (found.pull[found.gap > found.plan.film.end] == 0.0).all()
    linear = ck.DynamicRupture(factor=4.0, exponent=1.0)
    assert run(MENISCUS, linear, speed=3e-4).plan.film.end == pytest.approx(at_rest * 1.04)
    assert run(MENISCUS, ck.DynamicRupture(factor=0.0)).plan.film.end == pytest.approx(at_rest)


def test_a_rupture_of_a_fast_thread_is_refused():
    scene = drawn(MENISCUS, ck.DynamicRupture(), speed=0.04)
    refuses(lambda: ck.plan(scene), "DynamicRupture", "1.33", "0.04 m/s", error=ck.InfeasibleError)


# All of them ---------------------------------------------------------------------------------

ALL = (
    ck.LiquidWeight(),
    ck.LandauLevichFilm(),
    ck.CoxVoinovAngle(),
    ck.TroutonForce(),
    ck.DynamicRupture(),
)


@pytest.mark.slow
def test_all_of_them_together_come_back_from_a_file(tmp_path):
    scene = drawn(MENISCUS, VISCOUS, *ALL, speed=1e-5)
    save_scene(scene, tmp_path / "scene.toml")
    assert load_scene(tmp_path / "scene.toml") == scene
    found = ck.simulate(ck.plan(scene, FEW))
    assert np.isfinite(found.pull).all()
    text = str(found.plan) + str(found.plan.cite())
    for word in ("landau-levich-film", "Bretherton", "Cox 1986", "Trouton", "Pitois"):
        assert word in text


@pytest.mark.parametrize("effect", [ALL[1], ALL[2], ALL[4]], ids=lambda e: e.name)
@pytest.mark.parametrize(
    "loading",
    [
        ck.ImposedTime(time=1.0, initial_gap=5e-6, final_gap=1e-4),
        ck.ImposedSpeed(
            speed=1e-6, initial_gap=5e-6, final_gap=1e-4,
            vibration=ck.Vibration(amplitude=1e-7, frequency=50.0),
        ),
    ],
    ids=["time", "vibration"],
)  # fmt: skip
def test_what_depends_on_the_speed_of_the_line_asks_for_it(effect, loading):
    scene = evolve(drawn(MENISCUS, effect), loading=loading)
    name = type(effect).__name__
    refuses(
        lambda: ck.plan(scene),
        name,
        "ImposedSpeed",
        "vibration",
        "ImposedForce",
        error=ck.PlanError,
    )


def test_two_ends_of_a_film_are_refused():
    scene = drawn(MENISCUS, ck.Rupture(), ck.DynamicRupture())
    refuses(lambda: ck.plan(scene), "Rupture and DynamicRupture", "keep one", error=ck.PlanError)
