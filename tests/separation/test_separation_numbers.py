"""Numbers of a separation: peaks by one definition, what was not reached, where the film broke."""

import json
import math

import numpy as np
import pytest

import contactkit as ck
from contactkit.capillary.exact.stability import stability_limit
from contactkit.cli import main

pytestmark = pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning")

SIXTY, REPELS = math.pi / 3, 2 * math.pi / 3
NANO = {"initial_gap": 2e-9, "final_gap": 2e-7}
DROP = math.pi * (100e-9) ** 2 * 2e-9  # 100 nm wide, 2 nm high
FORCES = (ck.MeniscusForce(), ck.ViscousForce())


def drop(angle=SIXTY, **more):
    return {"volume": DROP, "contact_angle_lower": angle, "contact_angle_upper": angle} | more


def run(film_scene, *effects, angle=SIXTY, **imposed):
    water = {"viscosity": 0.89e-3, "surface_tension": 0.072}
    scene = film_scene(
        *effects,
        lower=ck.Flat(),
        upper=ck.Flat(),
        liquid=water,
        film=drop(angle),
        **(NANO | imposed),
    )
    return ck.simulate(ck.plan(scene))


def number(result, name):
    return result.scalars()[name][0]


def test_a_peak_is_of_all_forces_together(film_scene):
    result = run(film_scene, *FORCES, speed=1.0)
    total = result["meniscus_force"] + result["viscous_force"]
    assert number(result, "peak_force") == total.max()
    assert number(result, "peak_force") > 10.0 * result["meniscus_force"].max()
    assert number(result, "peak_repulsion") == 0.0


def test_an_imposed_time_names_the_forces_whose_peak_it_knows(film_scene):
    """Its viscous force is known as an impulse only; the same opening by speed has a peak."""
    result = run(film_scene, *FORCES, time=1e-7)
    scalars = result.scalars()
    assert "peak_force" not in scalars
    assert scalars["peak_static_force"] == (result["meniscus_force"].max(), "N")
    alone = run(film_scene, ck.MeniscusForce(), time=1e-7)
    assert number(alone, "peak_force") == scalars["peak_static_force"][0]


def test_a_repulsion_is_a_number_of_its_own(film_scene):
    result = run(film_scene, ck.MeniscusForce(), angle=REPELS, speed=1e-6)
    force = result["meniscus_force"]
    assert force[0] < 0.0 < force[-1]  # it attracts late in the opening
    assert number(result, "peak_repulsion") == -force.min()
    assert number(result, "peak_force") == force.max()
    early = run(film_scene, ck.MeniscusForce(), angle=REPELS, speed=1e-6, final_gap=4e-9)
    assert number(early, "peak_force") == 0.0
    assert number(early, "peak_repulsion") == -early["meniscus_force"].min() > 1e-6


def test_a_motion_has_the_peaks_of_its_curves(film_scene):
    result = run(film_scene, *FORCES, force=1e-4, mass=1e-12)
    total = result["meniscus_force"] + result["viscous_force"]
    assert number(result, "peak_force") == pytest.approx(total.max(), rel=1e-3)
    assert number(result, "peak_force") >= total.max()
    assert number(result, "peak_repulsion") == max(-total.min(), 0.0)


LIMIT = float(stability_limit(DROP, SIXTY, SIXTY).gap)


@pytest.mark.parametrize(
    "imposed", [{"speed": 1.0}, {"time": 1e-7}, {"force": 1e-4, "mass": 1e-12}], ids=str
)
def test_plan_and_result_say_where_the_film_breaks(film_scene, imposed):
    result = run(film_scene, *FORCES, **imposed)
    where = f"{LIMIT * 1e9:.4g} nm"
    assert f"the film breaks at {where}, before the final gap" in str(result.plan)
    assert f"the film broke at {where}" in result.message
    short = run(film_scene, *FORCES, **(imposed | {"final_gap": 0.9 * LIMIT}))
    assert "break" not in str(short.plan).replace("the film breaks at a gap", "")
    assert "broke" not in short.message


def test_what_was_not_reached_is_nan_and_null_in_json(film_scene, tmp_path, capsys):
    result = run(film_scene, *FORCES, force=1e-12, mass=1e-12)
    assert result.status == "stuck"
    for name in ("release_time", "release_speed", "break_time"):
        assert math.isnan(number(result, name)), name
    path = tmp_path / "stuck.toml"
    ck.save_scene(result.plan.scene, path)
    assert main(["run", str(path), "--json"]) in (0, None)

    def no_constant(name):
        raise AssertionError(f"{name} is not JSON")

    found = json.loads(capsys.readouterr().out, parse_constant=no_constant)
    assert found["release_time"] == {"value": None, "unit": "s"}


def test_without_a_mass_there_is_no_speed_of_release(film_scene):
    result = run(film_scene, ck.ViscousForce(), force=1e-4, final_gap=2e-8)
    assert result.status == "released"
    assert "m/s" not in result.message
    assert "loading.mass [kg]" in result.message
    assert math.isnan(number(result, "release_speed"))
    assert number(result, "release_time") > 0.0
    assert "no mass" in str(result.plan)
    heavy = run(film_scene, ck.ViscousForce(), force=1e-4, mass=1e-15, final_gap=2e-8)
    assert "m/s" in heavy.message
    assert np.isfinite(number(heavy, "release_speed"))


# The viscous impulse of a time ----------------------------------------------------------------

FILMS = {
    "flats": {},
    "sphere": {"upper": ck.Sphere(radius=1e-2)},
    "flooded flats": {"film": {}},
}


@pytest.mark.parametrize("kind", FILMS)
def test_the_viscous_impulse_of_a_time_is_the_integral_of_the_force_on_any_path(film_scene, kind):
    """At a constant speed by the trapezoidal rule of its curve; at a constant pull by its time."""
    given = {"film": {"volume": 1e-12}} | FILMS[kind]
    viscous, duration = ck.ViscousForce(), 2e-3
    in_time = ck.simulate(ck.plan(film_scene(viscous, time=duration, **given)))
    fine = ck.Accuracy(points=4000)
    at_speed = ck.simulate(ck.plan(film_scene(viscous, speed=9e-6 / duration, **given), fine))
    curve, time = at_speed["viscous_force"], at_speed.time
    integral = float((0.5 * (curve[1:] + curve[:-1])) @ np.diff(time))
    assert in_time.viscous_impulse == pytest.approx(integral, rel=1e-4)
    assert at_speed.viscous_impulse == pytest.approx(in_time.viscous_impulse, rel=1e-9)
    mean = in_time.mean_viscous_force
    assert in_time.scalars()["mean_viscous_force"] == (mean, "N")
    assert mean == pytest.approx(in_time.viscous_impulse / duration)
    assert curve[0] > 1.5 * mean  # at a constant speed it begins with more
    pulled = ck.simulate(ck.plan(film_scene(viscous, force=mean, **given)))
    assert pulled.state.release_time == pytest.approx(duration, rel=1e-6)


def test_a_mean_viscous_force_needs_a_film_that_resists_and_a_time(film_scene):
    at_speed = ck.simulate(ck.plan(film_scene(ck.ViscousForce(), speed=1e-3)))
    with pytest.raises(ck.NotSimulatedError, match=r"ImposedSpeed: impose .*ImposedTime\(time"):
        _ = at_speed.mean_viscous_force
    assert "mean_viscous_force" not in at_speed.scalars()
    film = {"volume": 1e-12}
    still = ck.simulate(ck.plan(film_scene(ck.MeniscusForce(), film=film, time=1.0)))
    for name in ("viscous_impulse", "mean_viscous_force"):
        with pytest.raises(ck.NotSimulatedError, match="add ViscousForce"):
            getattr(still, name)
    assert "mean_viscous_force" not in still.scalars()
