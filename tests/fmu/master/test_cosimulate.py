"""The master: couples the two FMUs, converges, and refuses what would look like an answer."""

from __future__ import annotations

import math
import zipfile
from pathlib import Path

import numpy as np
import pytest

from contactkit.app.scenes import open_scene
from contactkit.errors import ContactkitError, ConvergenceError, DescriptionError, InfeasibleError
from contactkit.fmu.framework.instance import Instance
from contactkit.fmu.master.couple import Fmu, Mass, couple
from contactkit.fmu.master.injector import cosimulate
from contactkit.fmu.slaves.stiction_mass import StictionMass
from contactkit.fmu.slaves.valve_drive import ValveDrive
from contactkit.models.injector.monolithic import simulate
from contactkit.models.injector.report.cosimulation import build_fmus
from contactkit.separation.plan import plan

pytestmark = pytest.mark.slow

FMI3 = """<?xml version="1.0" encoding="UTF-8"?>
<fmiModelDescription fmiVersion="3.0" modelName="third" instantiationToken="{3}">
  <CoSimulation modelIdentifier="third"/>
  <ModelVariables>
    <Float64 name="time" valueReference="0" causality="independent" variability="continuous"/>
  </ModelVariables>
  <ModelStructure/>
</fmiModelDescription>
"""
MODEL = Path(__file__).parents[3] / "models" / "injector" / "fuel_injector.toml"


@pytest.fixture(scope="module")
def device():
    return open_scene(str(MODEL))


@pytest.fixture(scope="module")
def pair(device, tmp_path_factory):
    return build_fmus(device.scene, tmp_path_factory.mktemp("pair"))


@pytest.fixture(scope="module")
def first_release(device):
    """Release of the monolithic model; rtol 1e-8 and 1e-10 differ by 6e-10 of it, in a third."""
    scene = device.scene
    whole = simulate(plan(scene.separation(scene.temperature)), scene.valve, 2e-3, rtol=1e-8)
    return whole.cycles[0].release_time + scene.valve.profile.start_delay


def test_every_output_of_both_fmus_is_recorded_with_its_unit(pair):
    found = cosimulate(*pair, 1e-4, 1e-5)
    outputs = {p.name for p in (*StictionMass.ports, *ValveDrive.ports) if p.causality == "output"}
    assert set(found.columns) == outputs
    assert all(found.ports[name].name == name for name in outputs)
    assert found.ports["F_mag"].unit == "N"
    assert (found.n_steps, len(found.time), len(found["h"])) == (10, 11, 11)
    assert found.time[-1] == 1e-4
    with pytest.raises(ValueError, match="read-only"):
        found["h"][0] = 0.0


@pytest.mark.slow
def test_the_coupling_error_falls_with_the_square_of_the_step(pair, first_release):
    """Steps that meet the switching of the voltage; others err by the kink inside one step."""
    steps = (10e-6, 5e-6, 2e-6)
    errors = [abs(cosimulate(*pair, 2e-3, s)["t_release"][-1] / first_release - 1) for s in steps]
    order = np.polyfit(np.log(steps), np.log(errors), 1)[0]
    assert order == pytest.approx(2.0, abs=0.25)
    assert errors[-1] < 1e-6


@pytest.mark.slow
def test_a_pull_that_is_held_costs_an_order(pair, first_release):
    steps = (10e-6, 5e-6, 2e-6)
    errors = [
        abs(cosimulate(*pair, 2e-3, s, linear=False)["t_release"][-1] / first_release - 1)
        for s in steps
    ]
    assert np.polyfit(np.log(steps), np.log(errors), 1)[0] == pytest.approx(1.0, abs=0.1)


def test_a_step_too_long_for_the_stop_is_refused(pair):
    """2 sqrt(m/k_stop) is 28 us; beyond it the spool would leap, and look released."""
    with pytest.raises(InfeasibleError, match=r"5e-05 s exceeds 2\.83e-05 s.*tenth of that"):
        cosimulate(*pair, 1e-3, 5e-5)


@pytest.mark.parametrize("value", [0.0, -1.0, math.nan, math.inf])
@pytest.mark.parametrize("name", ["stop_time", "step"])
def test_bad_times_are_refused(pair, name, value):
    times = {"stop_time": 1e-3, "step": 1e-5} | {name: value}
    with pytest.raises(DescriptionError, match=rf"{name} must be positive and finite \[s\]"):
        cosimulate(*pair, **times)


@pytest.mark.parametrize("tolerance", [1e-2, 1e-3, 1e-4])
def test_adaptive_steps_meet_the_tolerance(pair, first_release, tolerance):
    found = cosimulate(*pair, 2e-3, tolerance=tolerance)
    assert found["t_release"][-1] == pytest.approx(first_release, rel=tolerance)
    assert found.time[-1] == 2e-3
    assert found.n_steps < 400
    assert 1e-3 in found.time  # a voltage that jumps ends a step


def test_a_step_or_a_tolerance_is_given(pair):
    with pytest.raises(DescriptionError, match="step must be given, or else a tolerance"):
        cosimulate(*pair, 1e-3)
    with pytest.raises(DescriptionError, match="tolerance must be between"):
        cosimulate(*pair, 1e-3, tolerance=1.0)


def test_an_fmu_that_stops_says_why(pair):
    with pytest.raises(ConvergenceError, match=r"stiction-mass stopped at t = 0 s.*eta"):
        cosimulate(pair[0], Fmu(pair[1], {"eta": -1.0}), 1e-3, 1e-5)


def test_an_unknown_start_value_is_named(pair):
    with pytest.raises(DescriptionError, match="etta must be a variable"):
        cosimulate(pair[0], Fmu(pair[1], {"etta": 1.0}), 1e-3, 1e-5)


def test_nothing_is_left_behind(pair, tmp_path, monkeypatch):
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    cosimulate(*pair, 1e-4, 1e-5)
    with pytest.raises(ConvergenceError):
        cosimulate(pair[0], Fmu(pair[1], {"eta": -1.0}), 1e-3, 1e-5)
    assert list(tmp_path.iterdir()) == []


def test_progress_is_reported(pair):
    fractions = []
    cosimulate(*pair, 5e-3, 1e-5, progress=fractions.append)
    assert fractions == sorted(fractions)
    assert 0.0 <= fractions[0] < fractions[-1] < 1.0


def test_events_reach_the_log(pair):
    found = cosimulate(pair.drive, Fmu(pair.mass, {"h_break": 20e-6}), 2e-3, 5e-6)
    assert any("released at" in line for line in found.log)
    assert any("film broke at" in line for line in found.log)


def test_an_instance_reads_and_sets_by_name(pair):
    with Instance(pair[1]) as mass:
        mass.start({"h0": 7e-6, "h_min": 0.0}, 1.0)
        assert mass.get(mass.references("h")) == [7e-6]
        assert dict(zip(mass.names, mass.outputs(), strict=True))["h"] == 7e-6


def test_an_enumeration_is_set_by_the_name_of_its_item(pair):
    with Instance(pair[1]) as mass:
        mass.start({"meniscus_law": "NONE", "h_min": 0.0}, 1.0)
        assert mass.get(mass.references("F_m")) == [0.0]
    with Instance(pair[1]) as mass, pytest.raises(DescriptionError, match="be one of NONE, EXACT"):
        mass.start({"meniscus_law": "ARCH"}, 1.0)


# Wrong files ---------------------------------------------------------------------------------


def rewritten(fmu, path, change):
    """Copy an FMU whose model description is changed."""
    with zipfile.ZipFile(fmu) as old, zipfile.ZipFile(path, "w") as new:
        for name in old.namelist():
            content = old.read(name)
            new.writestr(name, change(content) if name == "modelDescription.xml" else content)
    return path


@pytest.fixture
def temporary(tmp_path, monkeypatch):
    """Folder of temporary files, which must be empty in the end."""
    folder = tmp_path / "temporary"
    folder.mkdir()
    monkeypatch.setattr("tempfile.tempdir", str(folder))
    yield folder
    assert list(folder.iterdir()) == []


def test_an_fmu_of_another_model_is_refused(pair, temporary):
    drive, mass = pair
    with pytest.raises(DescriptionError, match=r"valve-drive: it lacks h \(input\), v \(input\)"):
        cosimulate(mass, mass, 1e-4, 1e-5)
    with pytest.raises(DescriptionError, match=r"of stiction-mass: it lacks .*m \(parameter\)"):
        cosimulate(drive, drive, 1e-4, 1e-5)
    with pytest.raises(DescriptionError, match=r"of stiction-force: it lacks .*c \(output\)"):
        couple(mass, Mass(mass=0.02), 40.0, 1e-3)


def test_what_is_no_fmu_of_fmi_2_is_named(pair, tmp_path, temporary):
    text = tmp_path / "text.fmu"
    text.write_text("text")
    third, cavitated = tmp_path / "third.fmu", tmp_path / "cavitated.fmu"
    with zipfile.ZipFile(third, "w") as archive:
        archive.writestr("modelDescription.xml", FMI3)
    rewritten(pair[0], cavitated, lambda xml: xml[: len(xml) // 2])
    for path, said in (
        (tmp_path / "none.fmu", "a file that is there"),
        (text, "a zip archive"),
        (third, "one of FMI 3.0: take the FMI 2 build"),
        (cavitated, "cavitated.fmu, modelDescription.xml'; there is"),
    ):
        with pytest.raises(DescriptionError, match=said) as caught:
            cosimulate(path, pair[1], 1e-4, 1e-5)
        assert caught.value.value.startswith(str(path))


def test_an_fmu_without_a_library_for_this_host_is_named(pair, tmp_path, temporary):
    bare = tmp_path / "bare.fmu"
    with zipfile.ZipFile(pair[0]) as old, zipfile.ZipFile(bare, "w") as new:
        for name in old.namelist():
            if not name.startswith("binaries/"):
                new.writestr(name, old.read(name))
    with pytest.raises(ContactkitError, match=r"bare\.fmu cannot be loaded here: .*library"):
        cosimulate(bare, pair[1], 1e-4, 1e-5)


def test_a_start_value_may_carry_its_unit(pair):
    with Instance(pair[1]) as mass:
        mass.start({"h0": "7 um", "h_min": 0, "eta": "10 mPa.s"}, 1.0)
        assert mass.get(mass.references("h", "eta")) == [7e-6, 0.01]
    with Instance(pair[1]) as mass, pytest.raises(DescriptionError, match=r"N must .*got 2\.5"):
        mass.start({"N": 2.5}, 1.0)
