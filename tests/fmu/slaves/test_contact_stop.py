"""The FMU ``contact-stop``: the numbers of its tables, and a memory that a host can roll back."""

from __future__ import annotations

import json
import math
import subprocess
import sys
import zipfile

import fmpy
import numpy as np
import pytest

import contactkit as ck
from contactkit import cli
from contactkit.analyses.load_displacement.curve import Branch, LoadDisplacementCurve
from contactkit.analyses.load_displacement.impact import in_series
from contactkit.app.scenes import open_scene
from contactkit.fmu.contents.end_stop import STOP_AREA, bake, default_curve
from contactkit.fmu.framework.instance import Instance
from contactkit.fmu.master.injector import cosimulate
from contactkit.fmu.python import build as building
from contactkit.fmu.slaves.contact_stop import ContactStop
from contactkit.fmu.slaves.valve_drive import drive_values

pytestmark = [
    pytest.mark.slow,
    pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning"),
]

OK, DISCARD = 0, 2
STEP = 1e-6
TOUCH = 25e-6


@pytest.fixture(scope="module")
def curve():
    """A rough face softer than steel, so that what it remembers counts."""
    soft = ck.Material(name="soft", young_modulus=70e9, poisson_ratio=0.33, hardness=0.9e9)
    rough = ck.SelfAffineRoughness(rms=0.3e-6, hurst=0.8, rolloff=30e-6, cutoff=6e-6, seed=2)
    scene = ck.ContactScene(
        interface=ck.Interface(lower=ck.Body(solid=soft), upper=ck.Body(surface=rough)),
        window=ck.Window(width=60e-6),
        loading=ck.Pressing(pressure=80e6),
        effects=(ck.HalfSpace(), ck.HardnessLimit(rule="material")),
    )
    found = ck.load_displacement(scene, points=24, n_unloadings=8, accuracy=ck.Accuracy(grid=64))
    return found.scaled(10e-6 / found.nominal_area)


@pytest.fixture(scope="module")
def stop_fmu(curve, tmp_path_factory):
    path = tmp_path_factory.mktemp("stop") / "contact-stop.fmu"
    return building.build("contact-stop", path, start={"curve": curve})


@pytest.fixture
def host(stop_fmu, open_fmu):
    return open_fmu(stop_fmu)


def press(host, depth, speed=0.0):
    host.set(h=TOUCH + depth, v=speed)
    return host.step(STEP)


def test_it_is_valid_carries_no_numpy_and_says_what_follows(stop_fmu):
    assert building.validate(stop_fmu) == []
    description = fmpy.read_model_description(str(stop_fmu))
    follows = {u.variable.name: {v.name for v in u.dependencies} for u in description.outputs}
    assert follows["F"] == {"h", "v"}
    assert follows["F_el"] == {"h"}
    assert follows["W"] == follows["d_max"] == set()
    names = zipfile.ZipFile(stop_fmu).namelist()
    assert not [n for n in names if "stop_curves" in n or "stop_bake" in n or "contact_plan" in n]
    code = "import sys; sys.modules['numpy'] = None; import contactkit.fmu.slaves.contact_stop"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


def test_it_gives_what_the_curve_gives(host, curve):
    host.start()
    assert host.get("state") == Branch.FREE
    largest = 0.0
    for fraction in (-1.0, 0.0, 1e-6, 0.3, 0.7, 0.5, 0.2, 0.6, 0.9, 1.0, 0.95, 0.4, -0.1):
        depth = fraction * curve.max_approach
        assert press(host, depth) == OK
        depth = host.get("d")  # after the rounding of h
        assert depth == pytest.approx(fraction * curve.max_approach, abs=1e-20)
        point = curve.at(depth, largest)
        largest = max(largest, depth)
        for name, value in zip(("F", "k", "contact_area", "plastic_area"), point, strict=False):
            assert host.get(name) == pytest.approx(value, rel=1e-12), (fraction, name)
        assert host.get("state") == point.branch
        assert host.get("d_max") == largest
        assert host.get("d_res") == curve.residual(largest)
        assert host.get("W") == pytest.approx(curve.dissipated_work(largest), rel=1e-9)
    assert host.get("n_beyond") == 0


def test_a_loop_loses_what_it_says(host, curve):
    """By the work that a host sees at its interface."""
    host.start()
    depths = 0.95 * curve.max_approach * np.sin(np.linspace(0.0, math.pi, 1200))
    forces = []
    for depth in depths:
        press(host, depth)
        forces.append(host.get("F"))
    work = np.trapezoid(forces, depths)
    assert work == pytest.approx(host.get("W"), rel=0.01)
    assert work > 0.1 * curve.work(0.95 * curve.max_approach)
    again = []
    for depth in depths:  # to the same depth once more: along the unloading curve and back
        press(host, depth)
        again.append(host.get("F"))
    assert abs(np.trapezoid(again, depths)) < 1e-9 * work
    assert max(again) == pytest.approx(max(forces))


def test_a_little_beyond_yield_the_loss_is_that_of_the_forces_it_gives(host, curve):
    """Deeper each time, where the unloading curves end at the first curve."""
    host.start()
    limit, one = curve.elastic_limit, curve.unloading[1].max_approach
    work = 0.0
    for reach in (0.2, 0.6, 0.8):
        largest = limit + reach * (one - limit)
        depths = largest * np.sin(np.linspace(0.0, math.pi, 1201))
        faces, forces = [0.0], [0.0]
        for depth in depths.tolist():
            press(host, depth)
            faces.append(host.get("d"))
            forces.append(host.get("F"))
        work += np.trapezoid(forces, faces)
        assert host.get("W") == pytest.approx(work, rel=0.0, abs=1e-5 * curve.work(largest))


def test_what_is_only_looked_at_is_not_remembered(host, curve):
    host.start()
    host.set(h=TOUCH + 0.8 * curve.max_approach)
    deep = host.get("F")
    host.set(h=TOUCH + 0.4 * curve.max_approach)
    assert host.get("F") == pytest.approx(curve.at(0.4 * curve.max_approach).force)
    assert host.get("d_max") == 0.0
    host.set(h=TOUCH + 0.8 * curve.max_approach)
    assert host.get("F") == deep


def test_a_press_is_rolled_back_with_the_state(host, curve):
    host.start()
    press(host, 0.3 * curve.max_approach)
    state = host.slave.getFMUState()
    data = host.slave.serializeFMUState(state)
    press(host, 0.9 * curve.max_approach)
    press(host, 0.25 * curve.max_approach)
    plastic = host.outputs()
    assert plastic["state"] == Branch.UNLOADING or plastic["F"] == 0.0
    host.slave.setFMUState(state)
    host.time = STEP
    assert host.get("d_max") == pytest.approx(0.3 * curve.max_approach)
    press(host, 0.9 * curve.max_approach)
    press(host, 0.25 * curve.max_approach)
    assert host.outputs() == plastic
    host.slave.setFMUState(host.slave.deSerializeFMUstate(data))
    assert host.get("W") == pytest.approx(curve.dissipated_work(0.3 * curve.max_approach), rel=0.02)
    host.slave.freeFMUState(state)
    host.reset().start(d_max0=0.9 * curve.max_approach)
    assert host.get("W") == 0.0
    press(host, 0.25 * curve.max_approach)
    assert host.get("F") == pytest.approx(plastic["F"], rel=1e-12)


@pytest.mark.parametrize(("side", "sign"), [(1, 1.0), (2, -1.0)])
def test_it_pushes_out_from_either_side_and_damps(host, curve, side, sign):
    host.start(side=side, d_stop=2.0)
    depth = 0.5 * curve.max_approach
    host.set(h=TOUCH + sign * depth, v=sign * 0.1)
    static = curve.at(depth).force
    assert host.get("F") == pytest.approx(1.2 * static)
    assert host.get("F_el") == pytest.approx(static)
    assert host.get("c") == pytest.approx(2.0 * static)
    host.set(v=-sign * 0.6)
    assert host.get("F") == host.get("c") == 0.0  # it never pulls
    host.set(h=TOUCH - sign * depth)
    assert host.get("F_el") == 0.0
    assert host.get("d") == pytest.approx(-depth)


def test_bodies_behind_it_are_a_spring_in_series_and_damping_is_counted(host, curve):
    host.start(k_body=1e8, d_stop=1.0)
    depth, speed = 0.7 * curve.max_approach, 0.05
    for i in range(1, 201):
        press(host, depth * i / 200, speed)
    point, faces = in_series(curve, depth, faces_before := host.get("d"), 1e8)
    assert host.get("F_el") == pytest.approx(point.force, rel=1e-9)
    assert host.get("d") == pytest.approx(faces) == pytest.approx(faces_before)
    assert faces + host.get("F_el") / 1e8 == pytest.approx(depth)
    stored = curve.work(faces) + 0.5 * host.get("F_el") ** 2 / 1e8
    assert host.get("W_d") == pytest.approx(speed * stored, rel=1e-3)


def test_beyond_its_tables_it_goes_on_with_a_warning(host, curve):
    host.start()
    assert press(host, 1.5 * curve.max_approach) == OK
    assert host.get("state") == Branch.BEYOND
    assert host.get("F") == pytest.approx(curve.at(1.5 * curve.max_approach, beyond=True).force)
    assert press(host, 2.0 * curve.max_approach) == OK
    said = [e.message for e in host.log if "beyond" in e.message]
    assert len(said) == 1
    assert "larger loads" in said[0]
    assert host.get("n_beyond") == 2
    press(host, 0.99 * curve.max_approach)
    assert host.get("state") == Branch.UNLOADING
    assert host.get("F") == pytest.approx(
        curve.at(0.99 * curve.max_approach, curve.max_approach).force
    )
    assert press(host, 1e300) == DISCARD or math.isfinite(host.get("F"))


@pytest.mark.parametrize(
    ("set_it", "said"),
    [
        ({"h": math.nan}, "h must be a finite number"),
        ({"v": math.inf}, "v must be"),
        ({"h": -math.inf}, "h must be"),
    ],
)
def test_inputs_that_are_no_numbers_are_refused(host, curve, set_it, said):
    host.start()
    press(host, 0.5 * curve.max_approach)
    before = host.outputs()
    host.set(**set_it)
    assert host.step(STEP) == DISCARD
    assert said in host.errors[0]
    assert host.outputs() == before
    host.reset().start()
    assert press(host, 0.5 * curve.max_approach) == OK


@pytest.mark.parametrize(
    ("values", "said"),
    [
        ({"scale": 0.0}, "scale must be"),
        ({"k_body": -1.0}, "k_body"),
        ({"d_max0": 1.0}, "d_max0"),
        ({"side": 3}, "side"),
    ],
)
def test_parameters_out_of_range_are_refused(host, values, said):
    host.slave.setupExperiment(startTime=0.0)
    host.set(**values)
    host.slave.enterInitializationMode()
    host.slave.exitInitializationMode()
    assert host.step(STEP) == DISCARD
    assert said in host.errors[0]


def test_a_build_is_repeatable_and_its_tables_are_under_the_hash(curve, stop_fmu, tmp_path):
    again = building.build("contact-stop", tmp_path / "again.fmu", start={"curve": curve.to_data()})
    assert again.read_bytes() == stop_fmu.read_bytes()
    other = building.build("contact-stop", tmp_path / "b.fmu", start={"curve": curve.scaled(2.0)})
    guids = [fmpy.read_model_description(str(path)).guid for path in (again, other)]
    assert guids[0] != guids[1]
    folder = fmpy.extract(str(again), str(tmp_path / "unpacked"))
    record = tmp_path / "unpacked" / "resources" / "build.json"
    data = json.loads(record.read_text())
    data["data"]["curve"]["force"][-1] *= 2.0
    record.write_text(json.dumps(data, sort_keys=True))
    with pytest.raises(Exception, match=r"instantiate|FMU"):
        fmpy.simulate_fmu(str(folder), stop_time=1e-3)


def test_the_default_is_the_stop_of_the_injector():
    start = {}
    data = bake("contact-stop", start)
    curve = LoadDisplacementCurve.from_data(data["curve"])
    assert curve == default_curve()
    assert start["scale"] * curve.force[-1] == pytest.approx(100e6 * STOP_AREA)
    assert 0.0 < curve.elastic_limit < curve.max_approach
    assert curve.error < 0.05
    assert bake("valve-drive", {}) == {}
    for wrong in (3.0, {"approach": []}):
        with pytest.raises(ck.DescriptionError, match="LoadDisplacementCurve"):
            bake("contact-stop", {"curve": wrong})


def test_a_slave_without_tables_says_what_it_needs():
    with pytest.raises(ck.DescriptionError, match="be built by"):
        ContactStop(instance_name="bare", resources="").prepare()


@pytest.mark.slow
def test_the_command_builds_one_from_a_contact_scene(tmp_path, capsys):
    scene = tmp_path / "ball.toml"
    scene.write_text(
        """
        [interface.lower.solid]
        substrate = "bearing-steel"
        [interface.upper.surface]
        shape = "paraboloid"
        radius = "1 mm"
        [window]
        width = "30 um"
        periodic = false
        [loading]
        kind = "pressing"
        force = "0.2 N"
        [[effects]]
        effect = "half-space"
        [accuracy]
        grid = 48
        """
    )
    out = tmp_path / "ball.fmu"
    assert cli.main(["fmu", "build", str(scene), "--out", str(out)]) == 0
    assert "contact-stop" in capsys.readouterr().out
    result = fmpy.simulate_fmu(
        str(out), start_values={"h_touch": 0.0, "h": 50e-9}, stop_time=1e-3, output=["F", "W"]
    )
    assert result["F"][-1] == pytest.approx(0.1088, rel=0.02)  # Hertz
    assert result["W"][-1] == 0.0


def test_a_contact_scene_without_a_load_displacement_curve_is_refused(tmp_path, capsys):
    out = tmp_path / "head.fmu"
    assert cli.main(["fmu", "build", "head-disk", "--out", str(out)]) == 2
    said = capsys.readouterr().err
    assert "of a contact scene the FMU contact-stop is built" in said
    assert "leave out film-meniscus" in said
    assert not out.exists()


# In the injector ------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def valve(curve, tmp_path_factory):
    """The FMUs of the injector: mass, drive, drive with rough faces, and one that never stops."""
    folder, injector = tmp_path_factory.mktemp("valve"), open_scene("fuel-injector")
    name, start, _ = injector.fmu_start()
    values = drive_values(injector.scene.valve) | {"n_cycles": 1, "d_stop": 0.0}
    made = {"mass": building.build(name, folder / "mass.fmu", start=start)}
    for tag, more in {"plain": {}, "rough": {"curve": curve}}.items():
        path = folder / f"{tag}.fmu"
        made[tag] = building.build("valve-drive", path, start=values | more)
    return made


@pytest.mark.slow
def test_rough_faces_soften_the_stop_of_the_valve_and_take_energy(valve, curve):
    plain, rough = (
        cosimulate(valve[drive], valve["mass"], 1.55e-3, 5e-6) for drive in ("plain", "rough")
    )
    assert rough["t_release"][-1] == plain["t_release"][-1]  # before the stop is met
    met = plain["F_stop"].argmax()
    assert rough["F_stop"].max() < plain["F_stop"].max()
    assert rough["h"].max() > plain["h"].max()
    bounced = slice(met, None)
    assert rough["v"][bounced].min() > plain["v"][bounced].min()  # comes back slower


@pytest.mark.slow
def test_beside_the_drive_it_does_what_it_does_inside(valve, stop_fmu):
    """One impact, by three FMUs and by two."""
    step, n = 5e-6, 340
    inside = cosimulate(valve["rough"], valve["mass"], n * step, step)
    with (
        Instance(valve["plain"]) as drive,
        Instance(valve["mass"]) as mass,
        Instance(stop_fmu) as stop,
    ):
        for one, start in ((drive, {"h_stop": 100e-6}), (mass, {}), (stop, {"k_body": 1e8})):
            one.start(start, n * step)
        gaps, forces = [], []
        for i in range(n):
            motion = mass.get(mass.references("h", "v"))
            ahead = [motion[0] + motion[1] * step, motion[1]]
            for one in (drive, stop):
                one.set(one.references("h", "v"), motion)
            pull, held = drive.get(drive.references("F_ext"))[0], stop.get(stop.references("F"))[0]
            drive.step(i * step, step)
            stop.step(i * step, step)
            stop.set(stop.references("h", "v"), ahead)
            rate = (stop.get(stop.references("F"))[0] - held) / step
            slope = drive.get(drive.references("dF_ext"))[0]
            mass.set(mass.references("F_ext", "dF_ext"), [pull - held, slope - rate])
            mass.step(i * step, step)
            gaps.append(mass.get(mass.references("h"))[0])
            forces.append(held)
        lost, largest = stop.get(stop.references("W", "d_max"))
    assert gaps == pytest.approx(inside["h"][1:].tolist(), rel=1e-6)
    assert max(forces) > 100.0
    assert 0.0 < lost < 1e-3
    assert largest > 0.0
