"""The valve and its film as a system structure: its text, and masters nobody here wrote."""

from __future__ import annotations

import importlib.util
import io
import json
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import numpy as np
import pytest
from native_scenes import HAS_CC

pytest.importorskip("pythonfmu")
fmpy = pytest.importorskip("fmpy")
etree = pytest.importorskip("lxml.etree")

from contactkit import cli  # noqa: E402  # the packages must be there
from contactkit.app.scenes import open_scene  # noqa: E402
from contactkit.app.system import write_system  # noqa: E402
from contactkit.errors import DescriptionError, InfeasibleError, PlanError  # noqa: E402
from contactkit.fmu.framework.toolchain import local  # noqa: E402
from contactkit.fmu.master.injector import Fmu, cosimulate  # noqa: E402
from contactkit.fmu.native import build as native_build  # noqa: E402
from contactkit.fmu.python.build import validate  # noqa: E402

pytestmark = pytest.mark.slow

SCHEMAS = Path(fmpy.__file__).parent / "ssp" / "schema"
SSP = "http://ssp-standard.org/SSP1/SystemStructure"
SSD, SSC, SSV = f"{{{SSP}Description}}", f"{{{SSP}Common}}", f"{{{SSP}ParameterValues}}"
STOP, STEP = 2e-3, 5e-6


@pytest.fixture(scope="module")
def archive(tmp_path_factory):
    return write_system("fuel-injector", tmp_path_factory.mktemp("system") / "valve.ssp")


@pytest.fixture(scope="module")
def native_archive(tmp_path_factory):
    if not HAS_CC:
        pytest.skip("there is no C compiler")
    place = tmp_path_factory.mktemp("native") / "valve.ssp"
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(native_build, "has_zig", lambda: False)
        assert cli.main(["fmu", "system", "--native", "--out", str(place)]) == 0
    return place


@pytest.fixture(scope="module")
def unpacked(archive, tmp_path_factory):
    folder = tmp_path_factory.mktemp("unpacked")
    with zipfile.ZipFile(archive) as packed:
        packed.extractall(folder)
    return folder


@pytest.fixture(scope="module")
def structure(unpacked):
    return etree.parse(str(unpacked / "SystemStructure.ssd")).getroot()


@pytest.fixture(scope="module")
def ours(unpacked):
    """The same FMUs by our own master."""
    fmus = [unpacked / "resources" / f"{name}.fmu" for name in ("valve_drive", "stiction_mass")]
    return cosimulate(*fmus, STOP, STEP)


def start_values(fmu):
    read = fmpy.read_model_description(str(fmu)).modelVariables
    return {v.name: v.start for v in read if v.causality == "parameter"}


# The archive --------------------------------------------------------------------------------


def test_it_follows_the_schemas(structure):
    def schema(name):
        return etree.XMLSchema(etree.parse(str(SCHEMAS / f"SystemStructure{name}.xsd")))

    schema("Description").assertValid(structure)
    inline = list(structure.iter(f"{SSV}ParameterSet"))
    assert len(inline) == 2
    for one in inline:  # the first schema takes anything in this place
        schema("ParameterValues").assertValid(etree.fromstring(etree.tostring(one)))


def test_connections_lead_from_outputs_to_inputs_of_one_unit(structure):
    kinds, units = {}, {}
    for element in structure.iter(f"{SSD}Component"):
        for connector in element.iter(f"{SSD}Connector"):
            name = element.get("name"), connector.get("name")
            kinds[name], units[name] = connector.get("kind"), connector[0].get("unit")
    joined = [
        tuple(
            (each.get(f"{side}Element"), each.get(f"{side}Connector")) for side in ("start", "end")
        )
        for each in structure.iter(f"{SSD}Connection")
    ]
    assert len(joined) == 4
    for begin, end in joined:
        assert (kinds[begin], kinds[end]) == ("output", "input")
        assert units[begin] == units[end]
    assert {end for _, end in joined} == {name for name, kind in kinds.items() if kind == "input"}
    known = {unit.get("name") for unit in structure.find(f"{SSD}Units")}
    assert {unit for unit in units.values() if unit} <= known


def test_values_are_those_of_the_scene_in_both_places(structure, unpacked):
    """fmpy and others take what is baked in, libcosim and OMSimulator what is bound."""
    scene = open_scene("fuel-injector").scene
    seen = 0
    for element in structure.iter(f"{SSD}Component"):
        baked = start_values(unpacked / element.get("source"))
        for one in element.iter(f"{SSV}Parameter"):
            assert float(one[0].get("value")) == float(baked[one.get("name")])
            seen += 1
    assert seen > 35
    assert float(baked["m"]) == scene.loading.mass
    assert float(baked["dp_inception"]) == 1e6


def test_what_ends_libcosim_is_left_out(structure):
    """It ends its process on an enumeration; their values are in the FMU."""
    text = etree.tostring(structure).decode()
    assert "Enumeration" not in text
    assert "meniscus_law" not in text


def test_the_experiment_names_the_step_as_tools_read_it(structure):
    experiment = structure.find(f"{SSD}DefaultExperiment")
    assert float(experiment.get("stopTime")) == pytest.approx(51e-3)
    steps = [
        float(node.get(name))
        for node in structure.iter()
        for name in ("stepSize", "baseStepSize")
        if node.get(name)
    ]
    assert steps == [STEP, STEP]


def test_its_fmus_are_valid_and_the_names_are_plain(unpacked, structure):
    for fmu in (unpacked / "resources").iterdir():
        assert validate(fmu) == []
    assert structure.get("name").isidentifier()
    assert structure.get("description") == open_scene("fuel-injector").name


def test_the_command_writes_the_same_bytes(archive, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert cli.main(["fmu", "system"]) == 0
    assert "fuel-injector.ssp: drive and mass, both in Python" in capsys.readouterr().out
    assert (tmp_path / "fuel-injector.ssp").read_bytes() == archive.read_bytes()


# Masters ------------------------------------------------------------------------------------


def test_fmpy_steps_it_to_the_same_release(archive, ours):
    """It steps both FMUs side by side, so the pull is half a step late."""
    from fmpy.ssp.simulation import simulate_ssp

    found = simulate_ssp(str(archive), stop_time=STOP, step_size=STEP)
    assert found["time"][-1] == pytest.approx(STOP, abs=2 * STEP)
    check(found["mass.t_release"][-1], found["mass.F_peak"][-1], found["mass.J"][-1], ours)


def check(release, peak, impulse, ours):
    assert ours["t_release"][-1] > 1e-3
    assert release == pytest.approx(ours["t_release"][-1], abs=0.2 * STEP)
    assert peak == pytest.approx(ours["F_peak"][-1], rel=1e-5)
    assert impulse == pytest.approx(ours["J"][-1], rel=5e-3)


_LIBCOSIM = """
import json, sys
from libcosimpy.CosimExecution import CosimExecution
from libcosimpy.CosimLogging import CosimLogLevel, log_output_level
from libcosimpy.CosimObserver import CosimObserver

log_output_level(CosimLogLevel.FATAL)
path, stop = sys.argv[1:]
run = CosimExecution.from_ssp_file(ssp_path=path)
observer = CosimObserver.create_last_value()
run.add_observer(observer)
assert run.simulate_until(int(stop))
place = run.slave_index_from_instance_name("mass")
names = {v.name.decode(): v.reference for v in run.slave_variables(place)}
wanted = ("t_release", "F_peak", "J", "m")
values = observer.last_real_values(place, [names[name] for name in wanted])
print(json.dumps({"time": run.status().current_time, **dict(zip(wanted, values))}))
"""


def libcosim(archive, stop=STOP):
    """In a process of its own, because it aborts on what it does not like."""
    done = subprocess.run(
        [sys.executable, "-c", _LIBCOSIM, str(archive), str(round(stop * 1e9))],
        capture_output=True,
        text=True,
        check=False,
        timeout=100,
    )
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout.splitlines()[-1])


needs_libcosim = pytest.mark.skipif(
    importlib.util.find_spec("libcosimpy") is None, reason="libcosimpy is not installed"
)


@pytest.mark.slow
@needs_libcosim
def test_libcosim_steps_it_to_the_same_release(archive, ours):
    found = libcosim(archive)
    assert found["time"] == round(STOP * 1e9)
    check(found["t_release"], found["F_peak"], found["J"], ours)


@pytest.mark.slow
@needs_libcosim
def test_libcosim_takes_the_values_that_are_bound(archive, tmp_path):
    """A mass changed in the structure alone reaches the FMU."""
    changed = tmp_path / "changed.ssp"
    with zipfile.ZipFile(archive) as old, zipfile.ZipFile(changed, "w") as new:
        for name in old.namelist():
            content = old.read(name)
            if name.endswith(".ssd"):
                before = b'<ssv:Real unit="kg" value="0.02" />'
                assert before in content
                content = content.replace(before, before.replace(b"0.02", b"0.04"))
            new.writestr(name, content)
    assert libcosim(changed, 2e-5)["m"] == 0.04


@pytest.mark.slow
@needs_libcosim
def test_libcosim_runs_a_system_that_holds_no_python(native_archive, ours):
    """Neither FMU has a line of it; the drive steps as the Python one does."""
    with zipfile.ZipFile(native_archive) as packed:
        fmus = [name for name in packed.namelist() if name.endswith(".fmu")]
        assert len(fmus) == 2
        for name in fmus:
            with zipfile.ZipFile(io.BytesIO(packed.read(name))) as inside:
                held = inside.namelist()
            assert not [one for one in held if ".py" in one or "python" in one.lower()]
    found = libcosim(native_archive)
    assert found["time"] == round(STOP * 1e9)
    check(found["t_release"], found["F_peak"], found["J"], ours)


@pytest.mark.slow
@pytest.mark.skipif(shutil.which("OMSimulator") is None, reason="OMSimulator is not installed")
def test_omsimulator_runs_it(native_archive, tmp_path):
    """The program without Python."""
    done = subprocess.run(
        ["OMSimulator", str(native_archive), f"--stopTime={STOP}", "--resultFile=none.csv"],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        check=False,
        timeout=100,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    assert "error" not in done.stdout + done.stderr


# Start values, native, refusals -------------------------------------------------------------


def test_start_values_go_to_both_places_and_native_ones_move_as_ours(unpacked, tmp_path):
    """Without a meniscus, whose tables take some seconds; native if there is a C compiler."""
    mass = {"h0": 6e-6, "m": 0.025, "meniscus_law": "NONE"}
    given = {f"mass.{name}": value for name, value in mass.items()} | {"mass.h0": "6 um"}
    path = write_system(
        "fuel-injector",
        tmp_path / "own.ssp",
        native=HAS_CC,
        step=STEP / 2,
        start=given | {"drive.n_cycles": 1},
        platforms=[local()],
        compiler="cc",
    )
    with zipfile.ZipFile(path) as packed:
        packed.extractall(tmp_path)
    text = (tmp_path / "SystemStructure.ssd").read_text()
    for word in ('value="0.025"', 'stopTime="0.011"', f'stepSize="{STEP / 2!r}"'):
        assert word in text
    drive, film = (tmp_path / f"resources/{name}.fmu" for name in ("valve_drive", "stiction_mass"))
    read = fmpy.read_model_description(str(drive)).modelVariables
    assert {v.name: v.start for v in read}["h"] == "6e-06"  # the drive sees where the mass begins
    for fmu in (drive, film):
        with zipfile.ZipFile(fmu) as packed:
            assert ("resources/film.bin" in packed.namelist()) == HAS_CC
    found = cosimulate(drive, film, STOP, STEP)
    whole = unpacked / "resources" / "stiction_mass.fmu"
    python = cosimulate(drive, Fmu(whole, mass), STOP, STEP)
    for name in ("t_release", "F_peak", "J"):
        assert found[name][-1] == pytest.approx(python[name][-1], rel=1e-6)
    assert np.max(np.abs(found["h"] - python["h"])) < 1e-6 * np.max(python["h"])


@pytest.mark.parametrize(
    ("arguments", "error", "message"),
    [
        ({"out": "x.zip"}, DescriptionError, r"out must end in \.ssp"),
        ({"scene": "micromirror"}, PlanError, "has no valve, which a system needs"),
        ({"scene": "injector"}, DescriptionError, "did you mean 'fuel-injector'"),
        ({"start": {"m": 1.0}}, DescriptionError, "variable of drive or mass.*write mass.m"),
        ({"start": {"spring.k": 1.0}}, DescriptionError, "be a variable of drive or mass"),
        ({"start": {"mass.h00": 1.0}}, DescriptionError, "did you mean 'h0'"),
        ({"start": {"mass.m": -1.0}}, DescriptionError, "m must be a finite number above 0"),
        ({"step": 1e-4}, InfeasibleError, r"2\.83e-05 s = 2 sqrt\(m/k_stop\)"),
        ({"step": 0.0}, DescriptionError, "libcosim counts in nanoseconds"),
        ({"step": float("nan")}, DescriptionError, "step must be finite"),
    ],
)
def test_what_cannot_be_is_refused_and_nothing_is_left(tmp_path, arguments, error, message):
    given = {"scene": "fuel-injector", "out": "x.ssp"} | arguments
    with pytest.raises(error, match=message):
        write_system(given.pop("scene"), tmp_path / given.pop("out"), **given)
    assert list(tmp_path.iterdir()) == []
