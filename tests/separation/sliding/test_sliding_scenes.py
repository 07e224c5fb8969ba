"""Sliding scenes from description to file: powers of N, energy, what limits do, round trips."""

from __future__ import annotations

import math

import attrs
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import contactkit as ck
from contactkit.capillary.arc import sphere as arc_sphere
from contactkit.cli import main

pytestmark = pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning")

WATER = ck.Liquid(name="water", viscosity=0.89e-3, surface_tension=0.072, density=997.0)
STICKS = ck.ContactAngleHysteresis(
    advancing_lower=1.0, receding_lower=0.8, advancing_upper=1.2, receding_upper=0.6
)


def approx(value, rel=1e-12):
    return pytest.approx(value, rel=rel, abs=0.0)


def flats(*effects, x=1e-7, count=1, **loading):
    gap = loading.setdefault("gap", 2e-9)
    film = ck.Meniscus(liquid=WATER, volume=math.pi * x * x * gap, count=count)
    interface = ck.Interface(meniscus=film)
    return ck.SlidingScene(
        interface=interface, loading=ck.Sliding(**loading), effects=effects or (ck.CouetteForce(),)
    )


def sphere(*effects, radius=1e-7, s=2e-9, **loading):
    """Film that is as high as s at its rim: upright, or the arc of the printed equations."""
    gap = loading.setdefault("gap", 1e-9)
    volume = math.pi * radius * (s - gap) * (s + gap)
    if CLOSURES[2] in effects:
        x = math.sqrt(2.0 * radius * (s - gap))
        volume = float(arc_sphere.volume(gap, x, 0.0, 0.0, 0.0, 1.0 / radius, "parabola"))
    film = ck.Meniscus(liquid=WATER, volume=volume)
    interface = ck.Interface(upper=ck.Sphere(radius=radius), meniscus=film)
    return ck.SlidingScene(
        interface=interface, loading=ck.Sliding(**loading), effects=effects or (ck.CouetteForce(),)
    )


def run(scene, accuracy=None):
    return ck.simulate(ck.plan(scene, accuracy))


CLOSURES = [ck.CouetteForce(closure=c) for c in ("local-film", "lubrication", "as-published")]


@pytest.mark.parametrize(("x", "gap"), [(1e-7, 2e-9), (5e-5, 2e-7)])
def test_the_mean_force_of_a_time_is_equation_3_53(x, gap):
    result = run(flats(x=x, gap=gap, time=1e-7))
    mean = result.of(ck.CouetteForce).mean_force()
    assert mean == approx(8.0 * 0.89e-3 * x**3 / (3.0 * 1e-7 * gap))
    assert result.status == "parted"
    assert result["overlap_area"][0] == approx(math.pi * x * x)
    assert result["overlap_area"][-1] == 0.0


@pytest.mark.parametrize("drag", CLOSURES, ids=lambda effect: effect.closure)
@pytest.mark.parametrize("make", [flats, sphere])
def test_a_time_and_its_speed_have_one_impulse(make, drag):
    at_time = run(make(drag, time=2e-7))
    at_speed = run(make(drag, speed=at_time.plan.end / 2e-7))
    impulse = at_time.of(ck.CouetteForce).impulse
    assert at_speed.of(ck.CouetteForce).impulse == approx(impulse)
    assert at_speed.duration == approx(2e-7)
    trapezoid = np.trapezoid(at_speed["tangential_force"], at_speed.time)
    assert trapezoid == approx(impulse, 2e-4)
    assert at_speed.scalars()["sliding_work"][0] == approx(impulse * at_speed.speed[0])


def test_the_drag_falls_with_the_travel_and_is_largest_at_the_start():
    result = run(sphere(speed=1.0))
    assert (np.diff(result["couette_force"]) < 0.0).all()
    assert result.scalars()["peak_tangential_force"][0] == result["couette_force"][0]


def test_a_sphere_drags_more_with_pressure_and_less_as_published():
    local, lubricated, published = (run(sphere(c, speed=1.0))["couette_force"][0] for c in CLOSURES)
    scale = 2.0 * math.pi * 0.89e-3 * 1e-7
    assert local == approx(scale * math.log(2.0))
    assert published == approx(scale * 0.5)
    assert lubricated == approx(scale * 0.7241679079256733)


@pytest.mark.parametrize("drag", CLOSURES[:2], ids=lambda effect: effect.closure)
def test_the_powers_of_the_number_of_menisci(drag):
    """Flats: 0 at a speed, -1/2 in a time; spheres: 1/2 and 1/4, not the printed -1/2."""
    numbers = (1, 4, 100)
    x, radius = 5e-5, 5e-5
    for make, size, speed_power, time_power in (
        (flats, {"x": x, "gap": 1e-7}, 0.0, -0.5),
        (sphere, {"radius": radius, "s": 2e-7, "gap": 1e-7}, 0.5, 0.25),
    ):
        at_speed = make(drag, **size, speed=1.0)
        in_time = attrs.evolve(at_speed, loading=ck.Sliding(gap=1e-7, time=1e-7))
        for number in numbers[1:]:
            start = run(ck.divide_sliding(at_speed, number))["couette_force"][0]
            assert start / run(at_speed)["couette_force"][0] == approx(number**speed_power, 1e-11)
            mean = run(ck.divide_sliding(in_time, number)).of(ck.CouetteForce).mean_force()
            whole = run(in_time).of(ck.CouetteForce).mean_force()
            assert mean / whole == approx(number**time_power, 1e-11)


def test_division_stops_where_the_menisci_of_the_source_touch():
    """s - D = 500 nm under R = 50 um: n = sqrt(N) up to 50, not the 1e4 of Fig. 3.21."""
    whole = sphere(radius=50e-6, s=1e-6, gap=0.5e-6, speed=1.0)
    assert ck.divide_sliding(whole, 2499).interface.meniscus.count == 2499
    with pytest.raises(ck.InfeasibleError, match=r"at most 2[45]"):
        ck.divide_sliding(whole, 2600)


def test_menisci_side_by_side_add_up():
    film = run(flats(STICKS, ck.CouetteForce(), x=1e-7, speed=1.0))
    four = run(flats(STICKS, ck.CouetteForce(), x=1e-7, count=4, speed=1.0))
    assert four["couette_force"][0] == approx(film["couette_force"][0])  # the same area in all
    assert four["hysteresis_force"][0] == approx(
        2.0 * film["hysteresis_force"][0]
    )  # twice the width
    assert four.plan.break_travel == approx(0.5 * film.plan.break_travel)


def test_the_line_moves_on_the_body_that_holds_it_less():
    both = run(flats(STICKS, speed=1.0))["hysteresis_force"]
    lower = attrs.evolve(STICKS, advancing_upper=None, receding_upper=None)
    upper = attrs.evolve(STICKS, advancing_lower=None, receding_lower=None)
    a, b = (run(flats(one, speed=1.0))["hysteresis_force"] for one in (lower, upper))
    np.testing.assert_array_equal(both, np.minimum(a, b))
    assert a[0] == approx(2.0 / math.pi * 0.072 * 2e-7 * (math.cos(0.8) - math.cos(1.0)))


def test_hysteresis_takes_its_work_at_any_speed():
    slow, fast = (run(flats(STICKS, speed=v)) for v in (1e-6, 1.0))
    timed = run(flats(STICKS, time=1.0))
    works = [r.of(ck.ContactAngleHysteresis).work for r in (slow, fast, timed)]
    assert works[0] == approx(works[1]) == approx(works[2])
    assert np.trapezoid(slow["hysteresis_force"], slow.travel) == approx(works[0], 2e-3)
    assert slow.scalars()["mean_tangential_force"][0] == approx(
        fast.scalars()["mean_tangential_force"][0]
    )


@pytest.mark.parametrize("law", ["truncated", "bair-winer", "eyring"])
@pytest.mark.parametrize("make", [flats, sphere])
def test_a_weak_liquid_drags_less(make, law):
    free = run(make(speed=10.0))
    limit = ck.ShearLimit(strength=1e6, law=law)
    held = run(make(ck.CouetteForce(), limit, speed=10.0))
    assert (held["couette_force"][:-1] < free["couette_force"][:-1]).all()
    assert held.of(ck.CouetteForce).impulse < free.of(ck.CouetteForce).impulse
    strong = run(make(ck.CouetteForce(), ck.ShearLimit(strength=1e13, law=law), speed=10.0))
    assert strong.of(ck.CouetteForce).impulse == approx(free.of(ck.CouetteForce).impulse, 1e-6)
    if law == "truncated" and make is flats:
        assert held["couette_force"][0] == approx(1e6 * math.pi * 1e-14)


def test_a_travel_may_end_before_the_film():
    whole, half = run(flats(speed=1.0)), run(flats(speed=1.0, travel=1e-7))
    assert half.status == "curve"
    at = np.interp(1e-7, whole.travel, whole["couette_impulse"])
    assert half.totals["couette_impulse"] == approx(at, 1e-4)


def test_a_film_full_to_the_rim_slides_with_the_faces():
    face = ck.Flat(radius=1e-3)
    film = ck.Meniscus(liquid=WATER)
    flooded = ck.SlidingScene(
        interface=ck.Interface(lower=face, upper=face, meniscus=film),
        loading=ck.Sliding(gap=1e-6, speed=1.0),
        effects=(ck.CouetteForce(),),
    )
    assert run(flooded).plan.wetted_radius == 1e-3


@given(
    scale=st.floats(1e-3, 1e3),
    speed=st.floats(1e-3, 1e3),
    q=st.floats(1.01, 1e4),
    closure=st.sampled_from(["local-film", "lubrication", "as-published"]),
)
def test_scaling_of_lengths_and_speeds(scale, speed, q, closure):
    """A drag is eta v times a length."""
    few, drag = ck.Accuracy(points=5), ck.CouetteForce(closure=closure)
    size = {"radius": 1e-6, "s": q * 1e-9, "gap": 1e-9}
    one = run(sphere(drag, **size, speed=1.0), few)["couette_force"]
    larger = {name: scale * value for name, value in size.items()}
    other = run(sphere(drag, **larger, speed=speed), few)["couette_force"]
    np.testing.assert_allclose(other, scale * speed * one, rtol=1e-9, atol=1e-12 * other[0])


@pytest.mark.parametrize("closure", ["as-published", "local-film"])
def test_a_closed_gap_has_a_published_value_and_no_other(closure):
    """R = 100 nm, s = 4 nm, D = 0, 0.1 us: the value behind Fig. 3.20b."""
    scene = sphere(ck.CouetteForce(closure=closure), s=4e-9, gap=0.0, time=1e-7)
    if closure == "local-film":
        with pytest.raises(ck.InfeasibleError, match="infinite"):
            ck.plan(scene)
        return
    assert run(scene).of(ck.CouetteForce).mean_force() == approx(1.3425600752128585e-10)


def test_what_is_taken_as_printed_has_its_erratum():
    result = run(sphere(CLOSURES[2], time=1e-7))
    (one,) = result.errata
    assert one.number == "3.56"
    assert one.value == approx(result.of(ck.CouetteForce).mean_force())
    right = run(sphere(time=1e-7)).of(ck.CouetteForce).mean_force()
    assert one.corrected == approx(right)
    assert run(sphere(time=1e-7)).errata == ()
    assert "as printed" in result.plan.cite()


def test_a_plan_says_what_is_on_and_off():
    made = ck.plan(flats(ck.CouetteForce(), speed=1.0))
    text = str(made)
    assert "speed imposed at a gap of 2e-09 m" in text
    assert "on   couette-force" in text
    assert "off  contact-angle-hysteresis" in text
    assert "off  shear-limit" in text
    assert made.cite().startswith("couette-force: Couette flow")


@pytest.mark.parametrize("imposed", [{"speed": 1.0}, {"time": 1e-7}])
def test_a_scene_and_its_result_survive_files(tmp_path, imposed):
    scene = sphere(CLOSURES[1], STICKS, **imposed)
    path = ck.save_scene(scene, tmp_path / "scene.toml")
    assert ck.load_scene(path) == scene
    result = run(scene)
    again = ck.load_result(ck.save_result(result, tmp_path / "result"))
    assert again.scalars() == result.scalars()
    assert again.columns.keys() == result.columns.keys()
    assert [str(v) for v in again.validity] == [str(v) for v in result.validity]


def test_the_command_line_runs_it(tmp_path, capsys):
    scene = attrs.evolve(flats(CLOSURES[2], STICKS, speed=1.0), name="a slider")
    path = ck.save_scene(scene, tmp_path / "scene.toml")
    assert main(["run", str(path), "--out", str(tmp_path / "out")]) == 0
    said = capsys.readouterr().out
    assert "the wetted circles have parted" in said
    assert "erratum" in said
    assert (tmp_path / "out" / "forces.png").stat().st_size > 1000
    assert main(["cost", str(path)]) != 0


def test_a_study_varies_it():
    found = ck.study(flats(speed=1.0), {"loading.speed": ["1 mm/s", 1.0]})
    table = found.table("peak_tangential_force")
    assert "peak_tangential_force" in str(table)
