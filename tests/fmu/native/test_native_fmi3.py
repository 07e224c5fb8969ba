"""Native FMUs in FMI 3.0: event mode, early return at a rupture, derivatives, misuse."""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
from native_scenes import HAS_CC, HERE, SCENES, compile_c

pytest.importorskip("pythonfmu")
fmpy = pytest.importorskip("fmpy")
if not HAS_CC:
    pytest.skip("there is no C compiler", allow_module_level=True)

from contactkit.errors import DescriptionError  # noqa: E402
from contactkit.fmu.framework.toolchain import PLATFORMS, local  # noqa: E402
from contactkit.fmu.native.build import build_native  # noqa: E402
from contactkit.fmu.python.build import validate  # noqa: E402

pytestmark = pytest.mark.slow

ONE = {"platforms": [local()], "compiler": "cc"}
OUTPUTS = ("h", "v", "F", "F_m", "F_v", "J", "J_m", "W", "F_peak", "t_break", "t_release")
linux_only = pytest.mark.skipif(not sys.platform.startswith("linux"), reason="dlopen and ASan")


@pytest.fixture(scope="module")
def fmus(release_scene, shelf):
    """Case A in both versions of FMI."""
    return {fmi: shelf(build_native, release_scene("A"), fmi=fmi, **ONE) for fmi in (2, 3)}


@pytest.fixture(scope="module")
def unpacked(fmus, tmp_path_factory):
    folder = tmp_path_factory.mktemp("unpacked")
    with zipfile.ZipFile(fmus[3]) as packed:
        packed.extractall(folder)
    return folder


def simulate(path, **more):
    """Case A for 0.5 ms, in rows by name."""
    pull = np.array(
        [(0.0, 40.0, 0.0), (1.0, 40.0, 0.0)],
        dtype=[("time", float), ("F_ext", float), ("dF_ext", float)],
    )
    options = {"stop_time": 5e-4, "output_interval": 5e-5, "input": pull} | more
    names = [*OUTPUTS, "state", "limit", "n_break", "n_release"]
    return fmpy.simulate_fmu(str(path), fmi_type="CoSimulation", output=names, **options)


class Slave:
    """An instance of the FMU, by the names of its variables."""

    def __init__(self, folder, events=False, early=True, **start):
        from fmpy.fmi3 import FMU3Slave

        description = fmpy.read_model_description(str(folder))
        self.references = {v.name: v.valueReference for v in description.modelVariables}
        self.types = {v.name: v.type for v in description.modelVariables}
        self.fmu = FMU3Slave(
            instanceName="one",
            guid=description.guid,
            unzipDirectory=str(folder),
            modelIdentifier=description.coSimulation.modelIdentifier,
        )
        self.log = []
        self.fmu.instantiate(
            loggingOn=True,
            eventModeUsed=events,
            earlyReturnAllowed=early,
            logMessage=lambda _, status, category, text: self.log.append((category, text)),
        )
        self.set(**start)
        self.fmu.enterInitializationMode(startTime=0.0)
        self.fmu.exitInitializationMode()
        if events:
            self.update()

    def set(self, **values):
        for name, value in values.items():
            self.fmu.setFloat64([self.references[name]], [value])

    def get(self, name):
        kind = {"Enumeration": "Int64"}.get(self.types[name], self.types[name])
        return getattr(self.fmu, f"get{kind}")([self.references[name]])[0]

    def outputs(self):
        return [self.get(name) for name in (*OUTPUTS, "state", "n_break")]

    def step(self, time, length):
        event, _, early, last = self.fmu.doStep(time, length)
        return event, early, last

    def update(self):
        found = self.fmu.updateDiscreteStates()
        assert found[:5] == (False, False, False, False, False)
        self.fmu.enterStepMode()

    def close(self):
        self.fmu.freeInstance()


@pytest.fixture
def start(unpacked):
    """Start instances of the FMU, which are freed after the test."""
    slaves = []

    def one(**given):
        slaves.append(Slave(unpacked, **given))
        return slaves[-1]

    yield one
    for slave in slaves:
        slave.close()


def test_fmpy_finds_no_problems(fmus, unpacked):
    assert validate(fmus[3]) == []
    assert next((unpacked / "binaries").iterdir()).name == PLATFORMS[local()].fmi3
    can = ElementTree.parse(unpacked / "modelDescription.xml").find("CoSimulation").attrib
    assert {name for name, value in can.items() if value == "true"} == {
        "hasEventMode",
        "mightReturnEarlyFromDoStep",
        "canHandleVariableCommunicationStepSize",
        "canGetAndSetFMUState",
        "canSerializeFMUState",
        "providesDirectionalDerivatives",
        "providesAdjointDerivatives",
    }


def test_both_versions_describe_the_same_variables(fmus):
    kinds = {"Real": "Float64", "Integer": "Int32", "Enumeration": "Enumeration"}
    two, three = (fmpy.read_model_description(str(fmus[fmi])) for fmi in (2, 3))
    time = three.modelVariables[-1]
    assert (time.name, time.causality, time.unit) == ("time", "independent", "s")
    assert time.valueReference == len(two.modelVariables) + 1
    for a, b in zip(two.modelVariables, three.modelVariables[:-1], strict=True):
        for field in ("name", "valueReference", "causality", "unit", "displayUnit", "min", "start"):
            assert getattr(a, field) == getattr(b, field), (a.name, field)
        assert kinds[a.type] == b.type
        events_only = b.type != "Float64" or a.name in ("t_break", "t_release")
        expected = "discrete" if events_only else "continuous"
        assert b.variability == ("fixed" if b.causality == "parameter" else expected)
    known = {u.variable.name: u.dependencies for u in three.initialUnknowns}
    assert [v.name for v in known["h"]] == ["h0"]
    assert all(unknown.dependencies == [] for unknown in three.outputs)


@pytest.mark.parametrize("fmi", [2, 3])
def test_case_a_is_met(fmi, fmus, release_cases):
    """Against a value of codes that are not ours, in one process with the other version."""
    found = simulate(fmus[fmi], start_values={"rtol": 1e-9})[-1]
    values = release_cases["A"]["values"]
    assert found["t_release"] == pytest.approx(values["t_rel"], rel=1e-8)
    assert found["F_peak"] == pytest.approx(values["peak"], rel=1e-6)


def test_without_event_mode_both_versions_give_the_same_bits(fmus):
    given = {"h_break": 6e-5}
    two, three = (simulate(fmus[fmi], start_values=given) for fmi in (2, 3))
    assert three["n_break"][-1] == 1
    for name in two.dtype.names:
        assert two[name].tolist() == three[name].tolist(), name


def test_event_mode_shows_both_sides_of_the_rupture(fmus):
    given = {"h_break": 6e-5}
    plain = simulate(fmus[3], start_values=given)
    rows = simulate(fmus[3], start_values=given, use_event_mode=True, early_return_allowed=True)
    when = plain["t_break"][-1]
    before, after = rows[np.isclose(rows["time"], when, rtol=1e-12, atol=0.0)]
    assert before["h"] == after["h"] == 6e-5
    assert before["v"] == after["v"]
    assert before["F"] > 6.0
    assert after["F"] == after["F_m"] == after["F_v"] == 0.0
    assert (before["state"], before["n_break"], before["t_break"]) == (3, 0, -1.0)
    assert (after["state"], after["n_break"]) == (5, 1)
    assert after["t_break"] == pytest.approx(when, rel=1e-13)
    # Nothing else is changed by stopping there; what is discrete comes with an event of its own.
    same = {row["time"]: row for row in rows}
    for row in plain:
        for name in OUTPUTS:
            assert same[row["time"]][name] == pytest.approx(row[name], rel=1e-12, abs=1e-300)


def test_without_early_return_the_event_comes_at_the_end_of_the_step(fmus):
    given = {"h_break": 6e-5}
    plain = simulate(fmus[3], start_values=given)
    rows = simulate(fmus[3], start_values=given, use_event_mode=True)
    assert set(rows["time"]) == set(plain["time"])
    before, after = rows[np.isclose(rows["time"], 3e-4, rtol=1e-12, atol=0.0)]
    assert (before["n_break"], after["n_break"]) == (0, 1)
    assert (before["F"], before["state"], after["state"]) == (0.0, 3, 5)
    assert after["t_break"] == plain["t_break"][-1]


def test_steps_cut_at_the_rupture_sum_up_to_one_step(start):
    whole, cut = start(h_break=6e-5), start(h_break=6e-5, events=True)
    for slave in (whole, cut):
        slave.set(F_ext=40.0, dF_ext=-2e4)  # the ramp goes on, though nobody sets it again
    assert whole.step(0.0, 5e-4) == (False, False, 5e-4)
    event, early, last = cut.step(0.0, 5e-4)
    assert (event, early) == (True, True)
    assert cut.get("time") == last < 5e-4
    cut.fmu.enterEventMode()
    cut.update()
    event, early, end = cut.step(last, 5e-4 - last)
    assert (event, early) == (True, False)  # the release
    assert end == pytest.approx(5e-4, rel=1e-15)
    cut.fmu.enterEventMode()
    cut.update()
    np.testing.assert_allclose(cut.outputs(), whole.outputs(), rtol=1e-12)


def test_rewetting_is_an_event_too(tmp_path):
    path = build_native(SCENES["rewetting"], tmp_path / "x.fmu", fmi=3, **ONE)
    with zipfile.ZipFile(path) as packed:
        packed.extractall(tmp_path)
    slave = Slave(tmp_path, events=True, h_break=6e-6, k_s=0.0)
    time, seen = 0.0, []
    try:
        while time < 0.2 and len(seen) < 3:
            slave.set(F_ext=40.0 if not seen else -40.0)
            event, early, time = slave.step(time, 1e-3)
            before = slave.get("state"), slave.get("F_m"), slave.get("h")
            if event:
                slave.fmu.enterEventMode()
                slave.update()
            if early:
                seen.append((before, (slave.get("state"), slave.get("F_m"), slave.get("h"))))
    finally:
        slave.close()
    (rupture, broken), (landing, wet) = seen[:2]
    assert rupture[2] == broken[2] == 6e-6
    assert rupture[1] > 0.0 == broken[1]
    assert landing[2] == wet[2] == 5e-6
    assert (landing[0], landing[1]) == (5, 0.0)
    assert wet[0] != 5
    assert wet[1] > 0.0


def test_an_event_must_be_handled(start):
    from fmpy.fmi1 import FMICallException

    slave = start(h_break=6e-5, events=True)
    slave.set(F_ext=40.0)
    _, _, last = slave.step(0.0, 5e-4)
    with pytest.raises(FMICallException):
        slave.step(last, 1e-5)
    assert b"enter event mode" in slave.log[-1][1]


def test_state_is_restored_across_the_rupture(start):
    slave, other = start(h_break=6e-5, events=True), start(h_break=6e-5, events=True)
    slave.set(F_ext=40.0)
    _, _, last = slave.step(0.0, 5e-4)
    state = slave.fmu.getFMUState()
    before = slave.outputs()
    found = []
    for _ in range(2):
        slave.fmu.enterEventMode()
        slave.update()
        slave.step(last, 1e-4)
        found.append(slave.outputs())
        slave.fmu.setFMUState(state)
        assert slave.outputs() == before
    assert found[0] == found[1]
    moved = other.fmu.deserializeFMUState(slave.fmu.serializeFMUState(state))
    other.fmu.setFMUState(moved)
    assert other.outputs() == before
    other.fmu.enterEventMode()
    other.update()
    other.step(last, 1e-4)
    assert other.outputs() == found[0]
    slave.fmu.freeFMUState(state)
    other.fmu.freeFMUState(moved)


def test_outputs_follow_no_input_while_stepping(start):
    slave = start()
    slave.set(F_ext=40.0)
    slave.step(0.0, 1e-4)
    pull, force = slave.references["F_ext"], slave.references["F"]
    assert slave.fmu.getDirectionalDerivative([force], [pull], [1.0]) == [0.0]
    assert slave.fmu.getAdjointDerivative([force], [pull], [1.0]) == [0.0]


@pytest.fixture(scope="module")
def film(tmp_path_factory):
    """A film alone, unpacked."""
    folder = tmp_path_factory.mktemp("film")
    start = {"h": 6e-6, "v": 0.1, "h_break": 1e-5}
    path = build_native(
        SCENES["drop"], folder / "x.fmu", model="stiction-force", fmi=3, start=start, **ONE
    )
    assert validate(path) == []
    with zipfile.ZipFile(path) as packed:
        packed.extractall(folder)
    return folder


def test_a_film_alone_gives_directional_and_adjoint_derivatives(film):
    """Directional and adjoint derivatives are one matrix, that of c and k."""
    slave = Slave(film)
    r = slave.references
    knowns, unknowns = [r["h"], r["v"]], [r["F"], r["F_v"], r["F_m"]]
    columns = [
        slave.fmu.getDirectionalDerivative(unknowns, knowns, seed) for seed in ([1, 0], [0, 1])
    ]
    rows = [
        slave.fmu.getAdjointDerivative(unknowns, knowns, seed, 2)
        for seed in ([1, 0, 0], [0, 1, 0], [0, 0, 1])
    ]
    np.testing.assert_allclose(np.transpose(columns), rows, rtol=1e-14)
    assert rows[0] == [slave.get("k"), slave.get("c")]
    assert rows[2][1] == 0.0
    slave.close()


def test_a_film_alone_stops_a_step_where_it_breaks(film):
    """The way from gap to gap is cut at the rupture, for the host to take its own step anew."""
    names = ("F", "J", "J_m", "state", "n_break", "t_break", "h_below")
    whole, cut = Slave(film), Slave(film, events=True)
    for slave in (whole, cut):
        slave.set(h=1.4e-5, v=0.8)
    assert whole.step(0.0, 1e-5) == (False, False, 1e-5)
    event, early, last = cut.step(0.0, 1e-5)
    assert (event, early) == (True, True)
    assert last == pytest.approx(1e-5 * (10.0 - 5.0) / (14.0 - 5.0), rel=1e-12)
    assert cut.get("F") > 1.0
    assert cut.get("F_mean") > cut.get("F")
    assert (cut.get("n_break"), cut.get("t_break"), whole.get("n_break")) == (0, -1.0, 1)
    in_doubt = cut.get("in_doubt"), cut.get("n_doubt")
    cut.set(h=1.4e-5)  # to look at the film again changes nothing of what waits
    assert cut.get("state") != 5
    cut.fmu.enterEventMode()
    cut.update()
    assert (cut.get("state"), cut.get("F"), cut.get("n_break")) == (5, 0.0, 1)
    assert cut.get("t_break") == last
    assert in_doubt == (False, 0)
    assert (cut.get("in_doubt"), cut.get("n_doubt")) == (True, 1)
    cut.step(last, 1e-5 - last)
    cut.fmu.enterEventMode()
    cut.update()
    expected = [whole.get(name) for name in names]
    assert [cut.get(name) for name in names] == pytest.approx(expected, rel=1e-12)
    whole.close()
    cut.close()


def test_looking_at_a_film_before_a_step_is_no_event(film):
    """A host may ask for the force at the gap it is about to step to."""
    slave = Slave(film, events=True)
    slave.set(h=5.5e-6, v=0.1)
    assert slave.get("F") > 0.0
    was = slave.get("state")
    slave.set(h=1.2e-5)
    assert slave.get("F") == 0.0
    assert slave.get("state") == was
    slave.set(h=5.5e-6)
    slave.step(0.0, 1e-6)
    slave.close()


@pytest.fixture(scope="module")
def host(unpacked, tmp_path_factory):
    """A host in C, called with the words that follow library, folder and token."""
    out = tmp_path_factory.mktemp("host") / "host"
    compile_c([HERE / "native_host3.c"], out, f"-I{unpacked / 'sources'}")
    text = (unpacked / "modelDescription.xml").read_text()
    token = re.search('instantiationToken="([^"]*)"', text)[1]
    own = next((unpacked / "binaries" / PLATFORMS[local()].fmi3).iterdir())

    def run(*words, library=own, program=out):
        command = [str(program), str(library), f"{unpacked / 'resources'}/", token, *words]
        found = subprocess.run(command, capture_output=True, text=True, check=False, timeout=100)
        assert found.returncode == 0, found.stderr
        return [[float(word) for word in line.split()] for line in found.stdout.splitlines()]

    return run


@linux_only
def test_a_host_in_c_handles_the_events(host, fmus):
    rows = host("events", "40", "5e-5", "5e-4")
    given = {"h_break": 6e-5}
    expected = simulate(
        fmus[3], start_values=given, use_event_mode=True, early_return_allowed=True
    )[1:]
    assert len(rows) == len(expected)
    for row, known in zip(rows, expected, strict=True):
        names = ("time", "h", "v", "F", "state", "n_break")
        assert row == pytest.approx([float(known[name]) for name in names], rel=1e-9)


def test_the_host_in_c_knows_the_references(fmus):
    (known,) = re.findall(r"enum \{([^}]*H_BREAK[^}]*)\}", (HERE / "native_host3.c").read_text())
    references = {
        variable.name.upper(): variable.valueReference
        for variable in fmpy.read_model_description(str(fmus[3])).modelVariables
    }
    for name, reference in re.findall(r"(\w+) = (\d+)", known):
        assert references["M" if name == "MASS" else name] == int(reference), name


@linux_only
def test_no_misuse_ends_the_host(host):
    host("misuse")


@pytest.mark.slow
@linux_only
def test_sanitizers_find_nothing(host, unpacked, tmp_path):
    """In a library made of what the build description names, with nothing from elsewhere."""
    flags = ["-O0", "-g", "-fsanitize=address,undefined", "-fno-sanitize-recover=all"]
    folder = unpacked / "sources"
    root = ElementTree.parse(folder / "buildDescription.xml").getroot()
    names = [node.get("name") for node in root.iter("SourceFile")]
    assert sorted(names) == sorted(path.name for path in folder.glob("*.c"))
    try:
        library = compile_c(
            [folder / n for n in names], tmp_path / "checked.so", "-fPIC", "-shared", *flags
        )
    except subprocess.CalledProcessError as error:
        pytest.skip(f"the compiler has no sanitizers: {error.stderr[:200]}")
    program = compile_c([HERE / "native_host3.c"], tmp_path / "host", f"-I{folder}", *flags)
    host("misuse", library=library, program=program)
    host("events", "40", "5e-5", "5e-4", library=library, program=program)


def test_every_function_of_the_standard_is_there(unpacked):
    """Also those that mean nothing here: some hosts look for all of them."""
    import ctypes

    library = ctypes.CDLL(str(next((unpacked / "binaries").rglob("stiction_mass*"))))
    header = (unpacked / "sources" / "fmi3Functions.h").read_text()
    names = re.findall(r"FMI3_Export fmi3\w+TYPE\s+(fmi3\w+);", header)
    assert len(names) > 60
    for name in names:
        assert getattr(library, name)


def test_every_platform_has_its_folder(tmp_path, monkeypatch):
    """Also both kinds of Mac, which share a file in FMI 2.0."""
    from contactkit.fmu.native import build as native_build

    monkeypatch.setattr(native_build, "_COMPILED", {})
    monkeypatch.setattr(
        native_build, "compile_kernel", lambda _, name, out, *more: out.write_bytes(name.encode())
    )
    path = build_native(SCENES["drop"], tmp_path / "x.fmu", fmi=3, platforms=list(PLATFORMS))
    with zipfile.ZipFile(path) as packed:
        found = {name: packed.read(name) for name in packed.namelist() if "binaries/" in name}
    assert found == {
        f"binaries/{place.fmi3}/stiction_mass{place.suffix}": name.encode()
        for name, place in PLATFORMS.items()
    }


def test_rebuild_is_byte_identical(fmus, tmp_path):
    again = [
        build_native(SCENES["drop"], tmp_path / f"{i}.fmu", fmi=3, **ONE).read_bytes()
        for i in range(2)
    ]
    assert again[0] == again[1]


def test_what_cannot_be_built_is_refused(tmp_path):
    with pytest.raises(DescriptionError, match="fmi must be 2 or 3"):
        build_native(SCENES["drop"], tmp_path / "x.fmu", fmi=4, **ONE)
    assert not list(Path(tmp_path).iterdir())


def test_the_command_line_builds_one(fmus, tmp_path, monkeypatch, capsys):
    from contactkit import cli
    from contactkit.fmu.native import build as native_build

    asked = {}

    def build(_scene, out, **more):
        asked.update(more)
        return shutil.copy(fmus[3], out)

    monkeypatch.setattr(native_build, "build_native", build)
    words = ["fmu", "build", "fuel-injector", "--native", "--out", str(tmp_path / "x.fmu")]
    assert cli.main([*words, "--fmi", "3"]) == 0
    assert asked["fmi"] == 3
    assert "FMI 3.0" in capsys.readouterr().out
    assert cli.main(words) == 0
    assert asked["fmi"] == 2
