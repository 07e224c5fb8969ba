"""The native ``valve-drive``: as the Python FMU to round-off, in FMI 3.0, and with its film."""

from __future__ import annotations

import math
import random
import re
import subprocess
import sys
import zipfile
from itertools import pairwise

import numpy as np
import pytest
from drive_faces import rough
from native_scenes import HAS_CC, HERE, compile_c

pytest.importorskip("pythonfmu")
fmpy = pytest.importorskip("fmpy")
if not HAS_CC:
    pytest.skip("there is no C compiler", allow_module_level=True)

from contactkit import cli  # noqa: E402  # the packages must be there
from contactkit.analyses.load_displacement.curve import LoadDisplacementCurve  # noqa: E402
from contactkit.app.scenes import open_scene  # noqa: E402
from contactkit.errors import DescriptionError, PlanError  # noqa: E402
from contactkit.fmu.framework.toolchain import local  # noqa: E402
from contactkit.fmu.master.injector import Fmu, cosimulate  # noqa: E402
from contactkit.fmu.native import build as native_build  # noqa: E402
from contactkit.fmu.native.build import build_native, native_scene  # noqa: E402
from contactkit.fmu.native.drive import build_native_drive  # noqa: E402
from contactkit.fmu.native.faces import faces_of  # noqa: E402
from contactkit.fmu.python.build import build, validate  # noqa: E402
from contactkit.fmu.slaves.valve_drive import ValveDrive  # noqa: E402

pytestmark = pytest.mark.slow

ONE = {"platforms": [local()], "compiler": "cc"}
OK, DISCARD, ERROR = 0, 2, 3
RELEASE = 1.34218631e-3  # [s], of the injector at 20 degC, by models.monolithic
FORCES = ("F_ext", "F_mag", "F_spring", "F_stop", "i", "u", "flux")
linux_only = pytest.mark.skipif(not sys.platform.startswith("linux"), reason="dlopen and maps")


def slave(curve=None, **values):
    """The Python FMU, in this process."""
    made = ValveDrive(instance_name="direct")
    made.data = {"curve": curve.to_data()} if curve is not None else {}
    made.setup_experiment(0.0)
    made.values |= values
    made.enter_initialization_mode()
    made.exit_initialization_mode()
    assert not made.failure
    return made


def assert_same(found, slave, length=None):
    """All outputs of a host are those of the slave, to the rounding of what they are sums of."""
    expected = slave.values
    scale = expected["F_mag"] + abs(expected["F_spring"]) + abs(expected["F_stop"])
    for name in FORCES:
        assert found[name] == pytest.approx(
            expected[name], rel=1e-12, abs=1e-12 * scale if name == "F_ext" else 1e-300
        ), name
    if length:
        assert found["dF_ext"] == pytest.approx(expected["dF_ext"], abs=4e-12 * scale / length)


@pytest.fixture(scope="module", autouse=True)
def quick_compiler():
    """Half an optimisation takes half the time; other tests compile as users do."""

    def compile_one(sources, name, out, compiler):
        compile_c(sorted(sources.glob("*.c")), out, "-fPIC", "-shared", "-fvisibility=hidden")

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(native_build, "compile_kernel", compile_one)
        patch.setattr(native_build, "_COMPILED", {})
        yield


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("drive")


@pytest.fixture(scope="module")
def fmu(shelf):
    return shelf(build_native_drive, **ONE)


@pytest.fixture(scope="module")
def fmu3(shelf):
    return shelf(build_native_drive, fmi=3, **ONE)


@pytest.fixture(scope="module")
def python_fmu(shelf):
    return shelf(build, "valve-drive")


@pytest.fixture
def host(fmu, open_fmu):
    return open_fmu(fmu)


# Derivatives of its outputs ---------------------------------------------------------------------


@pytest.mark.slow
def test_derivatives_of_its_outputs_are_mean_slopes_of_the_last_step(fmu, fmu3, host):
    for path in (fmu, fmu3):
        about = fmpy.read_model_description(str(path)).coSimulation
        assert about.maxOutputDerivativeOrder == 1
    references = {name: v.valueReference for name, v in host.variables.items()}
    host.start(t_delay=0.0, h=5e-6, v=0.02)
    assert host.step(1e-4) == OK
    host.set(h=7e-6)
    before = host.outputs()
    assert host.step(1e-4) == OK
    after = host.outputs()
    for name in FORCES:
        (found,) = host.slave.getRealOutputDerivatives([references[name]], [1])
        expected = 0.0 if name == "u" else (after[name] - before[name]) / 1e-4
        assert found == pytest.approx(expected, rel=1e-9, abs=1e-9), name
    assert after["dF_ext"] == pytest.approx((after["F_ext"] - before["F_ext"]) / 1e-4)
    for name, order in (("F_ext", 2), ("h", 1)):
        with pytest.raises(fmpy.fmi1.FMICallException):
            host.slave.getRealOutputDerivatives([references[name]], [order])
    assert host.step(1e-4) == OK  # nothing is remembered of what was refused


# What it says ---------------------------------------------------------------------------------


@pytest.mark.slow
def test_fmpy_finds_no_problems(fmu, fmu3):
    assert validate(fmu) == []
    assert validate(fmu3) == []


def test_its_description_is_that_of_the_python_fmu(fmu, fmu3, python_fmu):
    """So that a host may take either; dependencies too."""
    kinds = {"Real": "Float64", "Integer": "Int32"}
    two, three, python = (fmpy.read_model_description(str(f)) for f in (fmu, fmu3, python_fmu))
    same = (
        "name",
        "valueReference",
        "causality",
        "unit",
        "displayUnit",
        "min",
        "max",
        "start",
        "nominal",
        "description",
    )
    for a, b, c in zip(
        two.modelVariables, python.modelVariables, three.modelVariables[:-1], strict=True
    ):
        for field in same:
            assert getattr(a, field) == getattr(b, field) == getattr(c, field), (a.name, field)
        assert a.type == b.type
        assert kinds[a.type] == c.type
        held = c.name == "u" or c.type != "Float64"
        if c.causality != "parameter":
            assert (c.variability == "discrete") == held, c.name
    for a, b in zip(two.outputs, python.outputs, strict=True):
        assert [v.name for v in a.dependencies] == [v.name for v in b.dependencies]
    assert two.coSimulation.canGetAndSetFMUstate
    assert not two.coSimulation.canInterpolateInputs


def test_there_is_no_python_in_it_and_a_rebuild_is_the_same(fmu, tmp_path):
    names = zipfile.ZipFile(fmu).namelist()
    assert not [name for name in names if name.endswith(".py")]
    assert "sources/drive.c" in names
    page = zipfile.ZipFile(fmu).read("documentation/index.html").decode()
    assert "2 sqrt(m/k)" in page
    assert "Python interpreter" not in page
    again = build_native_drive(tmp_path / "again.fmu", **ONE)
    assert again.read_bytes() == fmu.read_bytes()


# What it computes -----------------------------------------------------------------------------

HARD = {
    "as it is": {},
    "without saturation": {"B_sat": 0.0},
    "saturated": {"B_sat": 0.3, "U_boost": 60.0},
    "fast coil": {"R_coil": 300.0, "U_boost": 900.0},
    "few turns": {"N_turns": 20, "A_pole": 5e-6},
    "no boost, free wheel": {"t_boost": 0.0, "U_off": 0.0, "t_delay": 0.0},
    "always on": {"t_on": 1e-2, "t_boost": 1e-2, "t_delay": 0.0},
    "chopped": {"T_period": 1.3e-5, "t_on": 6e-6, "t_boost": 2e-6, "n_cycles": 4000},
    "no damping": {"d_stop": 0.0, "k_spring": 0.0, "F_preload": 0.0, "k_stop": 1e12},
}
MOTIONS = [
    (5e-6, 0.0),
    (-1e-5, 0.3),
    (2.4e-5, 0.5),
    (2.6e-5, -0.15),
    (2.6e-5, -3.0),
    (2e-4, 0.0),
    (1.04e-4, 1.0),
    (2.5e-5, 1e-9),
]
LENGTHS = [1e-3, 0.0, 1e-9, 5e-6, 1e-3 / 3.0, 4e-5, 2.2e-2, 1e-4]


@pytest.mark.parametrize("name", HARD)
def test_it_gives_what_the_python_fmu_gives(host, name):
    """Each step from another gap at another speed: before, beyond the stop, beyond the poles."""
    rng = random.Random(name)
    values = HARD[name]
    host.start(**values)
    python = slave(**values)
    assert_same(host.outputs(), python)
    for n in range(24):
        gap, speed = rng.choice(MOTIONS)
        length = LENGTHS[n % len(LENGTHS)] * (0.1 if name == "chopped" else 1.0)
        host.set(h=gap, v=speed)
        python.set_real([1, 2], [gap, speed])
        python.get_real([3])
        assert_same(host.outputs(), python)
        assert host.step(length) == OK, host.errors
        assert python.do_step(python.time, length), python.failure
        assert_same(host.outputs(), python, length)
    assert python.values["flux"] >= 0.0


def test_a_coil_at_rest_is_an_exponential(host):
    """Without saturation, at one gap: u/R (1 - exp(-t R/L)), in one long step or in many."""
    values = {"B_sat": 0.0, "t_delay": 0.0, "t_boost": 4e-3, "U_boost": 5.0}
    inductance = 4e-7 * math.pi * 40**2 * 50e-6 / (2.0 * (105e-6 - 5e-6) + 20e-6)
    for count in (1, 40):
        host.reset().start(**values)
        for _ in range(count):
            assert host.step(2e-3 / count) == OK
        assert host.get("i") == pytest.approx(5.0 * -math.expm1(-2e-3 / inductance), rel=1e-10)
        assert host.get("flux") == pytest.approx(inductance * host.get("i"), rel=1e-12)


def test_work_of_the_stop_is_lost_by_its_damping_only(host):
    host.start(d_stop=0.0)
    for gap, force in ((2.5e-5, 0.0), (2.6e-5, 100.0), (2.5e-5 - 1e-12, 0.0)):
        host.set(h=gap, v=-5.0)
        assert host.get("F_stop") == pytest.approx(force, abs=1e-9)


def test_one_step_over_thousands_of_switches(host):
    """More than a list of Python would be made for: the flux of each cycle is that of the last."""
    host.start(t_delay=0.0, T_period=1e-3, t_on=5e-4, t_boost=1e-4, n_cycles=4_000)
    assert host.step(2.0 + 2e-4) == OK
    flux = host.get("flux")
    assert flux > 0.0
    assert host.step(1e-3) == OK
    assert host.get("flux") == pytest.approx(flux, rel=1e-12)


@pytest.mark.parametrize(
    ("given", "length"),
    [
        ({"h": -1e6, "v": 1e9}, 5e-3),
        ({"h": 5e-6, "v": -1e12}, 1e-2),
        ({"h": -1e150, "v": 0.0}, 1.0),
    ],
)
def test_a_flux_that_cannot_follow_is_an_error_with_a_cure(host, given, length):
    host.start(t_delay=0.0)
    good = host.outputs()
    host.set(**given)
    assert host.step(length) == DISCARD
    assert "give a smaller speed or shorter steps" in host.errors[0]
    assert all(math.isfinite(value) for value in host.outputs().values())
    host.reset().start(t_delay=0.0)
    assert host.outputs() == good
    assert host.step(1e-4) == OK


def test_no_number_is_ever_infinite(host):
    host.start()
    host.set(h=1e308, v=1e308)
    host.get("F_ext")
    assert "no finite numbers" in host.errors[0]
    assert all(math.isfinite(value) for value in host.outputs().values())


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"t_on": 2e-2}, "t_on must not exceed T_period"),
        ({"t_boost": 5e-3}, "t_boost must not exceed t_on"),
        ({"h_stop": 2e-4}, "h_stop must be less than g_air"),
    ],
)
def test_a_drive_that_contradicts_itself_is_refused(host, tmp_path_factory, given, said):
    host.slave.setupExperiment(startTime=0.0)
    host.set(**given)
    host.slave.enterInitializationMode()
    with pytest.raises(Exception, match="xitInitializationMode"):
        host.slave.exitInitializationMode()
    assert said in host.errors[0]
    assert "reset the FMU" in host.errors[0]
    with pytest.raises(DescriptionError, match=said):
        build_native_drive(tmp_path_factory.mktemp("no") / "x.fmu", start=given, **ONE)


def test_what_cannot_be_built_is_refused(tmp_path):
    out = tmp_path / "x.fmu"
    with pytest.raises(DescriptionError, match=r"end in \.fmu"):
        build_native_drive(tmp_path / "x.zip", **ONE)
    with pytest.raises(DescriptionError, match="fmi must be 2 or 3"):
        build_native_drive(out, fmi=4, **ONE)
    with pytest.raises(DescriptionError, match="did you mean 'h_stop'"):
        build_native_drive(out, start={"h_stopp": 1.0}, **ONE)
    with pytest.raises(DescriptionError, match="is an output"):
        build_native_drive(out, start={"u": 1.0}, **ONE)
    with pytest.raises(DescriptionError, match="be a LoadDisplacementCurve"):
        build_native_drive(out, start={"curve": 3.0}, **ONE)
    with pytest.raises(DescriptionError, match="at least one of"):
        build_native_drive(out, platforms=[])
    with pytest.raises(PlanError, match="has no film"):
        native_scene("valve-drive")
    with pytest.raises(PlanError, match="65; make them with fewer"):
        build_native_drive(out, curve=rough(count=65), **ONE)
    assert not out.exists()


def test_only_the_pull_of_a_mass_has_a_rate(host):
    from fmpy.fmi1 import FMICallException

    host.start()
    with pytest.raises(FMICallException):
        host.slave.setRealInputDerivatives([3], [1], [1.0])
    assert host.errors


# States -------------------------------------------------------------------------------------------


def test_states_lead_back_here_and_elsewhere(fmu, open_fmu):
    host, other = open_fmu(fmu).start(), open_fmu(fmu).start()
    for _ in range(25):
        host.step(5e-5)
    host.set(h=2.6e-5, v=0.1)
    state, time, seen = host.slave.getFMUState(), host.time, host.outputs()
    host.step(5e-5)
    first = host.outputs()
    host.slave.setFMUState(state)
    assert host.outputs() == seen
    host.time = time
    host.step(5e-5)
    assert host.outputs() == first
    moved = other.slave.deserializeFMUState(host.slave.serializeFMUState(state))
    other.slave.setFMUState(moved)
    other.time = time
    other.step(5e-5)
    assert other.outputs() == first
    other.slave.freeFMUState(moved)
    host.slave.freeFMUState(state)


# Rough end-stop faces ---------------------------------------------------------------------------


@pytest.mark.parametrize(
    "curve", [rough(), rough(limit=0.0, count=3), rough(count=1)], ids=["many", "all yields", "one"]
)
def test_a_rough_stop_remembers_as_the_python_fmu_does(curve, tmp_path, open_fmu):
    """In and out, beyond the tables, out again: to 1e-11, as both seek the faces to 1e-13."""
    values = {"t_delay": 0.0, "k_stop": 3e9}
    host = open_fmu(build_native_drive(tmp_path / "x.fmu", curve=curve, **ONE)).start(**values)
    python = slave(curve, **values)
    most, seen = curve.max_approach, set()
    for n, fraction in enumerate(
        [-1.0, 1e-9, 0.1, 0.5, 0.4, 0.2, 0.6, 1.1, 0.9, 0.3, 1.9, 1.2, 0.7]
    ):
        gap, speed = 2.5e-5 + 1.3 * fraction * most, 0.2 * (-1) ** n
        host.set(h=gap, v=speed)
        python.set_real([1, 2], [gap, speed])
        python.get_real([3])
        assert host.get("F_stop") == pytest.approx(python.values["F_stop"], rel=1e-11, abs=1e-12)
        assert host.step(1e-7) == OK
        assert python.do_step(n * 1e-7, 1e-7)
        assert host.get("F_stop") == pytest.approx(python.values["F_stop"], rel=1e-11, abs=1e-12)
        seen.add(python.values["F_stop"] > 0.0)
    assert python.largest > most
    assert seen == {True, False}
    warned = [one for one in host.log if "beyond" in str(one)]
    expected = [one.msg for one in python.log_queue if "beyond" in one.msg]
    assert len(warned) == len(expected) == 1  # once, though it is there three times
    assert expected[0] in str(warned[0])


def test_faces_without_yield_are_one_curve(tmp_path, open_fmu):
    curve = rough()
    curve = LoadDisplacementCurve.from_data(
        curve.to_data() | {"unloading": [], "elastic_limit": curve.max_approach}
    )
    assert faces_of(curve).unloading == ()
    host = open_fmu(build_native_drive(tmp_path / "x.fmu", curve=curve, **ONE)).start()
    for fraction in (0.3, 0.8, 0.3):  # as stiff bodies: the depth is that of the faces
        host.set(h=2.5e-5 + fraction * curve.max_approach)
        force = host.get("F_stop")
        approach = fraction * curve.max_approach - force / 1e8
        assert force == pytest.approx(curve.at(approach).force, rel=1e-10)
        assert host.step(1e-7) == OK


# Slopes -------------------------------------------------------------------------------------------


@pytest.mark.parametrize("curve", [None, rough()], ids=["spring", "faces"])
@pytest.mark.parametrize("gap", [5e-6, 2.53e-5, 1.5e-4])
def test_slopes_are_those_of_the_outputs(curve, gap, tmp_path, open_fmu):
    host = open_fmu(build_native_drive(tmp_path / "x.fmu", curve=curve, **ONE))
    host.start(t_delay=0.0)
    references = {name: v.valueReference for name, v in host.variables.items()}
    host.set(h=2.58e-5, v=0.1)
    host.step(5e-4)
    for known, at, step in (("h", gap, 1e-10), ("v", 0.1, 1e-4)):
        given, rows = {"h": gap, "v": 0.1}, []
        for side in (1, -1):
            host.set(**given | {known: at + side * step})
            rows.append(host.outputs())
        host.set(**given)
        for name in host.outputs():
            slope = host.slave.getDirectionalDerivative(
                [references[name]], [references[known]], [2.0]
            )[0]
            expected = (rows[0][name] - rows[1][name]) / step
            size = abs(rows[0][name]) / step
            assert slope == pytest.approx(expected, rel=1e-5, abs=1e-9 * size), (name, known)
    assert host.errors == []


def test_what_has_no_slope_is_refused_and_nothing_is_lost(host):
    from fmpy.fmi1 import FMICallException

    references = {name: v.valueReference for name, v in host.variables.items()}

    def slope(of, by):
        return host.slave.getDirectionalDerivative([references[of]], [references[by]], [1.0])[0]

    host.slave.setupExperiment(startTime=0.0)
    host.slave.enterInitializationMode()
    host.set(t_delay=0.0, h=2.6e-5, B_sat=0.0)
    assert slope("u", "U_boost") == pytest.approx(1.0, rel=1e-9)
    assert slope("F_stop", "k_stop") == pytest.approx(1e-6, rel=1e-6)
    assert slope("F_stop", "h") == 1e8
    for of, by, said in (
        ("u", "t_on", "the voltage jumps in time"),
        ("i", "B_sat", "0 stands for none"),
        ("i", "N_turns", "not that of a real variable"),
        ("i", "flux", "an output, too"),
    ):
        host.log.clear()
        with pytest.raises(FMICallException):
            slope(of, by)
        assert said in host.errors[0]
        if by == "N_turns":  # a wrong reference is an error to be mended by a reset
            host.reset().start()
            break
    with pytest.raises(FMICallException):
        slope("F_ext", "k_stop")
    assert "a parameter does not change any more" in host.errors[0]
    assert host.step(1e-3) == OK


# FMI 3.0 ------------------------------------------------------------------------------------------


def steps3(fmu3, lengths, **options):
    """Rows of an instance in FMI 3.0, how often a step ended early, and an adjoint slope."""
    from fmpy.fmi3 import FMU3Slave

    description = fmpy.read_model_description(str(fmu3))
    numbers = {v.name: v.valueReference for v in description.modelVariables}
    one = FMU3Slave(
        instanceName="one",
        guid=description.guid,
        unzipDirectory=fmpy.extract(str(fmu3)),
        modelIdentifier=description.coSimulation.modelIdentifier,
    )
    one.instantiate(**options)
    one.enterInitializationMode(startTime=0.0)
    one.exitInitializationMode()
    events = options.get("eventModeUsed", False)
    if events:
        one.updateDiscreteStates()
        one.enterStepMode()
    time, target, rows, early = 0.0, 0.0, [], 0
    try:
        for length in lengths:
            target += length
            while time < target:
                event, _, returned, time = one.doStep(time, target - time)
                rows.append([time, *one.getFloat64([numbers[name] for name in FORCES])])
                early += returned
                if event:
                    one.enterEventMode()
                    one.updateDiscreteStates()
                    rows.append([time, *one.getFloat64([numbers[name] for name in FORCES])])
                    one.enterStepMode()
        adjoint = one.getAdjointDerivative(
            [numbers["F_ext"]], [numbers["h"], numbers["v"]], [2.0], 2
        )
    finally:
        one.freeInstance()
    return rows, early, adjoint


def test_without_event_mode_both_versions_give_the_same_bits(fmu3, host):
    rows, early, adjoint = steps3(fmu3, [7e-4] * 8)
    host.start()
    for row in rows:
        assert host.step(7e-4) == OK
        assert [host.get(name) for name in FORCES] == row[1:]
    assert early == 0
    assert adjoint == [-4e4, 0.0]


def test_a_step_ends_where_the_voltage_switches(fmu3):
    plain, _, _ = steps3(fmu3, [7e-4] * 8)
    rows, early, _ = steps3(fmu3, [7e-4] * 8, eventModeUsed=True, earlyReturnAllowed=True)
    assert early == 3
    switches = [(a[0], a[6], b[6]) for a, b in pairwise(rows) if a[6] != b[6]]
    assert switches == [
        (pytest.approx(1e-3), -12.0, 12.0),
        (pytest.approx(1.25e-3), 12.0, 5.2),
        (pytest.approx(5e-3), 5.2, -12.0),
    ]
    last = {round(row[0], 9): row for row in rows}
    for row in plain:
        np.testing.assert_allclose(last[round(row[0], 9)], row, rtol=1e-10, atol=1e-12)


def test_with_event_mode_alone_the_voltage_comes_at_the_end_of_a_step(fmu3):
    rows, early, _ = steps3(fmu3, [7e-4] * 8, eventModeUsed=True, earlyReturnAllowed=False)
    assert early == 0
    assert [row[6] for row in rows][:4] == [-12.0, -12.0, 5.2, 5.2]


# With its film ------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def film(shelf):
    scene, start = native_scene(open_scene("fuel-injector"))
    return shelf(build_native, scene, start=start, **ONE)


def test_the_master_takes_the_same_steps_with_either_drive(fmu, python_fmu, film):
    found = [cosimulate(drive, film, 3e-3, tolerance=1e-4) for drive in (fmu, python_fmu)]
    assert found[0].n_steps == found[1].n_steps
    assert found[0].n_rejected == found[1].n_rejected
    for name in ("t_release", "F_peak", "J"):
        assert found[0][name][-1] == pytest.approx(found[1][name][-1], rel=1e-12)
    assert found[0]["t_release"][-1] - 1e-3 == pytest.approx(RELEASE - 1e-3, rel=1e-4)


def test_an_impact_on_rough_faces_is_that_of_the_python_fmu(film, folder):
    """The stop is met, left and met again; what remembers is inside the drives."""
    start = {"curve": rough(most=4e-6), "k_stop": 3e8}
    native = build_native_drive(folder / "rough.fmu", start=start, **ONE)
    python = build("valve-drive", folder / "rough python.fmu", start=start)
    one, other = (
        cosimulate(Fmu(drive, {"n_cycles": 1, "d_stop": "0.1 s/m"}), film, 1.75e-3, 2e-6)
        for drive in (native, python)
    )
    presses = other["F_stop"] > 0.0
    assert np.max(other["F_stop"]) > 100.0
    assert np.sum(presses[1:] & ~presses[:-1]) >= 2
    for name in ("h", "v", "F_stop", "F_ext"):
        size = np.max(np.abs(other[name]))
        np.testing.assert_allclose(one[name], other[name], rtol=1e-9, atol=1e-9 * size)


@linux_only
def test_a_host_in_c_runs_the_pair_without_python(fmu, film, tmp_path):
    """Drive and film in one process that has no Python, to the release of the monolithic solver."""
    words = []
    for name, path in (("drive", fmu), ("film", film)):
        with zipfile.ZipFile(path) as packed:
            packed.extractall(tmp_path / name)
            assert not [n for n in packed.namelist() if n.endswith((".py", ".pyc"))]
        text = (tmp_path / name / "modelDescription.xml").read_text()
        library = next((tmp_path / name / "binaries").glob("*/*"))
        resources = (tmp_path / name / "resources").as_uri()
        words += [str(library), resources, re.search('guid="([^"]*)"', text)[1]]
    host = compile_c([HERE / "native_host_pair.c"], tmp_path / "host", f"-I{tmp_path}/film/sources")
    done = subprocess.run(
        [str(host), *words, "1e-6", "1.6e-3"],
        capture_output=True,
        text=True,
        check=False,
        timeout=100,
    )
    assert done.returncode == 0, done.stderr
    release, pythons = done.stdout.split()
    assert int(pythons) == 0
    assert float(release) - 1e-3 == pytest.approx(RELEASE - 1e-3, rel=1e-5)


def test_the_command_line_builds_one(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(native_build, "_COMPILED", {})
    monkeypatch.setattr(native_build, "has_zig", lambda: False)
    monkeypatch.setattr(
        native_build, "compile_kernel", lambda _, name, out, *more: out.write_bytes(name.encode())
    )
    for fmi in ("2", "3"):
        out = tmp_path / f"drive{fmi}.fmu"
        words = ["fmu", "build", "valve-drive", "--native", "--fmi", fmi, "--out", str(out)]
        assert cli.main(words) == 0
        assert f"valve-drive, native, FMI {fmi}.0, " in capsys.readouterr().out
        assert zipfile.ZipFile(out).testzip() is None
    out = tmp_path / "own.fmu"
    words = ["fmu", "build", "fuel-injector", "--native", "--model", "valve-drive"]
    assert cli.main([*words, "--out", str(out)]) == 0
    assert "valve-drive, native, FMI 2.0, " in capsys.readouterr().out
    words[2] = "micromirror"
    assert cli.main([*words, "--out", str(out)]) == 2
    assert "micromirror has no valve" in capsys.readouterr().err
    words[2], words[5] = "valve-drive", "stiction-mass"
    assert cli.main([*words, "--out", str(out)]) == 2
    assert "valve-drive has no film" in capsys.readouterr().err
