"""The WebAssembly component of a native FMU in a runtime: what it asks for, gives and refuses."""

from __future__ import annotations

import importlib.util
import math

import fmpy
import numpy as np
import pytest
from component_host import OK, Host
from native_scenes import SCENES

from contactkit import cli
from contactkit.errors import DescriptionError
from contactkit.fmu.framework.toolchain import has_zig, local
from contactkit.fmu.native.build import build_native
from contactkit.fmu.native.component import WASM, component, component_text
from contactkit.fmu.native.drive import build_native_drive
from contactkit.reading.xml_elements import read_xml

HAS_WASMTIME = importlib.util.find_spec("wasmtime") is not None
pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(
        not (HAS_WASMTIME and has_zig()),
        reason="wasmtime and ziglang are not installed: pip install contactkit[wasm]",
    ),
]

KINDS = ("float32", "float64", *(f"{u}int{n}" for u in ("", "u") for n in (8, 16, 32, 64)))
KINDS += ("boolean", "string", "binary", "clock")
STEP = 1e-4


@pytest.fixture(scope="module")
def mass(shelf):
    """A mass that a drop holds, for this computer and as a component."""

    def make(folder):
        build_native(SCENES["drop"], folder / "mass.fmu", fmi=3, platforms=[local(), WASM])

    return shelf.folder("component mass", make) / "mass.fmu"


@pytest.fixture(scope="module")
def film(shelf):
    def make(folder):
        scene = SCENES["drop"]
        build_native(scene, folder / "film.fmu", model="stiction-force", fmi=3, platforms=[WASM])

    return shelf.folder("component film", make) / "film.fmu"


def pulled(instance, steps, names=("h", "v", "F", "J", "W", "t_break")):
    rows = []
    for k in range(steps):
        instance.set(F_ext=40.0)
        found = instance.step(k * STEP, STEP)
        rows.append([found["last-successful-time"], *instance.get(*names)])
    return np.array(rows)


def test_it_gives_what_the_library_of_this_computer_gives(mass):
    """The whole motion through the rupture; compilers and their functions differ in last bits."""
    found = pulled(Host(mass).instantiate().start(), 130)
    native = fmpy.simulate_fmu(
        str(mass),
        start_values={"F_ext": 40.0},
        output=["h", "v", "F", "J", "W", "t_break"],
        stop_time=130 * STEP,
        output_interval=STEP,
    )
    known = np.array([list(row) for row in native])[1:]
    assert known[-1, -1] > 0.0  # it broke
    np.testing.assert_allclose(found, known, rtol=1e-9, atol=1e-12)


def test_it_asks_for_its_tables_once_and_for_nothing_else(mass):
    host = Host(mass)
    first, second = host.instantiate("first"), host.instantiate("second")
    assert host.asked == ["film.bin"]
    assert (pulled(first.start(), 3) == pulled(second.start(), 3)).all()
    first.drop()
    assert second.get("h")[0] > 5e-6
    assert host.log == []


@pytest.mark.exhaustive
def test_without_its_tables_there_is_no_instance_and_the_host_hears_why(mass):
    host = Host(mass)
    tables = host.files.pop("film.bin")
    assert host.instantiate("bare") is None
    assert host.log[0][:3] == ("bare", "error", "logStatusError")
    assert "the host does not give it" in host.log[0][3]
    for spoilt in (tables[:-8], tables[:70], b"", tables[:200] + b"x" + tables[201:]):
        host.files["film.bin"] = spoilt
        assert host.instantiate() is None
    host.files["film.bin"] = tables
    assert host.instantiate(token="{another}") is None
    assert "another GUID" in host.log[-1][3]
    assert host.instantiate(name="") is None
    assert host.instantiate(wanted=[1]) is None
    assert host.instantiate("übrig").start().get("h") == [5e-6]


def test_a_state_is_bytes_that_lead_back_here_and_in_another_instance(mass):
    host = Host(mass)
    one, other = host.instantiate("one").start(), host.instantiate("other").start()
    pulled(one, 5)
    state = one.get_fmu_state()
    assert isinstance(state, bytes)
    ahead = one.step(5 * STEP, STEP), one.get("h", "v", "F")
    for again in (one, other):
        assert again.set_fmu_state(state) == OK
        assert (again.step(5 * STEP, STEP), again.get("h", "v", "F")) == ahead
    assert one.set_fmu_state(b"no state") == "error"
    assert one.set_fmu_state(b"") == "error"


def test_slopes_are_damping_and_stiffness(film):
    instance = Host(film).instantiate().start()
    assert instance.set(h=6e-6, v=1e-4) == OK
    force, gap, speed = instance.references("F", "h", "v")
    k, c = instance.get("k", "c")
    assert instance.get_directional_derivative([force], [gap, speed], [1.0, 0.0]) == [k]
    assert instance.get_directional_derivative([force], [gap, speed], [0.0, 2.0]) == [2.0 * c]
    assert instance.get_adjoint_derivative([force], [gap, speed], [3.0]) == [3.0 * k, 3.0 * c]
    assert instance.get_directional_derivative([force], [gap], [1.0, 2.0]) == "error"


def test_event_mode_and_early_return(mass):
    """The step ends where the film breaks; what it was is gone after the event alone."""
    instance = Host(mass).instantiate(events=True, early=True)
    instance.start()
    info = vars(instance.update_discrete_states())
    assert not any(info.values())
    assert instance.enter_step_mode() == OK
    state = instance.references("n_break")
    time, ended = 0.0, None
    while ended is None and time < 0.02:
        instance.set(F_ext=40.0)
        found = instance.step(time, STEP)
        time = found["last-successful-time"]
        if found["early-return"]:
            ended = time
        elif found["event-handling-needed"]:
            assert instance.enter_event_mode() == OK
            instance.update_discrete_states()
            assert instance.enter_step_mode() == OK
    assert found["event-handling-needed"]
    assert instance.get_int32(state) == [0]
    assert instance.enter_event_mode() == OK
    instance.update_discrete_states()
    assert instance.get_int32(state) == [1]
    assert instance.get("t_break") == [ended]


def test_misuse_is_an_error_with_a_message(mass):
    host = Host(mass)
    instance = host.instantiate().start()
    assert instance.set(F_ext=math.nan) == "error"
    assert "F_ext must be a finite number" in host.log[-1][3]
    assert instance.step(0.0, STEP) == "error"
    assert instance.reset() == OK
    pulled(instance.start(), 2)
    assert instance.step(5.0, STEP) == "error"
    assert instance.get("h")[0] > 5e-6


def test_every_method_of_the_draft_answers(film):
    """Also those that an FMU without arrays and clocks can only refuse, with all their lists."""
    instance = Host(film).instantiate().start()
    for kind in KINDS:
        assert list(getattr(instance, f"get_{kind}")([])) == []
        nothing = b"" if kind == "uint8" else []
        assert getattr(instance, f"set_{kind}")([], nothing) == OK
    assert instance.set_debug_logging(True, ["logEvents", "logStatusError"]) == OK
    for name in ("enter_configuration_mode", "exit_configuration_mode", "evaluate_discrete_states"):
        assert getattr(instance, name)() == "error"
    for name in ("interval_decimal", "interval_fraction", "shift_decimal", "shift_fraction"):
        assert getattr(instance, f"get_{name}")([1, 2]) == "error"
        values = [1.0] if name.endswith("decimal") else []
        assert getattr(instance, f"set_{name}")([1], values) == "error"
    assert instance.get_number_of_variable_dependencies(1) == "error"
    assert instance.get_variable_dependencies(1) == "error"
    assert instance.set_input_derivatives([(1, 1)], [2.0]) == "error"
    assert instance.get_output_derivatives([]) == []
    assert instance.set_string([1], ["a", "bb"]) == "error"
    assert instance.reset() == OK
    assert instance.set_binary([1], [b"abc"]) == "error"
    assert instance.terminate() == OK


def test_output_derivatives(tmp_path):
    fmu = build_native_drive(
        tmp_path / "drive.fmu", fmi=3, platforms=[WASM], start={"t_delay": 0.0}
    )
    instance = Host(fmu).instantiate().start()
    instance.step(0.0, 1e-5)
    (pull,) = instance.references("F_ext")
    (rate,) = instance.get_output_derivatives([(pull, 1)])
    assert rate != 0.0
    assert rate == pytest.approx(instance.get("dF_ext")[0], rel=0.3)
    assert instance.get_output_derivatives([(pull, 2)]) == "discard"


@pytest.mark.exhaustive
def test_many_instances_leave_no_memory_behind(film):
    """2000 instances with states, one after the other: 1024 are possible at a time."""
    host = Host(film)
    for _ in range(2000):
        instance = host.instantiate().start()
        instance.set_fmu_state(instance.get_fmu_state())
        instance.drop()
    many = [host.instantiate() for _ in range(1025)]
    assert many[-1] is None
    assert "too many instances" in host.log[-1][3]


def test_the_manifest_names_the_layered_standard(mass):
    import zipfile

    with zipfile.ZipFile(mass) as packed:
        root = read_xml(packed.read("extra/org.modelica.fmi-ls-wasm/manifest.xml"), "manifest")
    space = "{http://fmi-standard.org/fmi-ls-manifest}"
    assert root.get(f"{space}fmi-ls-name") == "org.modelica.fmi-ls-wasm"
    assert root.get(f"{space}fmi-ls-version") == "0.1.0"


def test_a_kernel_without_its_functions_makes_no_component():
    from wasmtime import Engine, WasmtimeError
    from wasmtime.component import Component

    empty = b"\0asm\x01\0\0\0"
    with pytest.raises(WasmtimeError):
        Component(Engine(), component(empty))
    assert component_text().count("canon lift") == 58  # 56 methods in the draft


@pytest.mark.errors
def test_a_component_is_of_fmi_3(tmp_path, capsys):
    with pytest.raises(DescriptionError, match="be 3 for the platform wasm32-wasip2"):
        build_native(SCENES["drop"], tmp_path / "a.fmu", platforms=[WASM])
    out = ["--out", str(tmp_path / "a.fmu")]
    assert cli.main(["fmu", "build", "stiction-mass", "--native", "--wasm", *out]) == 2
    assert "add --native --fmi 3" in capsys.readouterr().err
