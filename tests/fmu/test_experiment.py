"""The experiment of a host: its clock, stop time and tolerance, in Python and native FMUs alike."""

from __future__ import annotations

import contextlib
import math

import fmpy
import pytest
from native_scenes import HAS_CC

from contactkit.errors import DescriptionError
from contactkit.fmu.framework.toolchain import local
from contactkit.fmu.native.build import build_native, native_scene
from contactkit.fmu.native.drive import build_native_drive
from contactkit.fmu.python.build import build

OK, DISCARD = 0, 2
ONE = {"platforms": [local()], "compiler": "cc"} if HAS_CC else {}
needs_compiler = pytest.mark.skipif(not HAS_CC, reason="there is no C compiler")
KINDS = ["python", pytest.param("native", marks=[needs_compiler, pytest.mark.slow])]
UNIX = 1.7e9  # [s], whose round-off is 0.24 us


@pytest.fixture(params=KINDS)
def mass(request, shelf, open_fmu):
    if request.param == "python":
        return open_fmu(shelf(build, "stiction-mass"))
    scene, start = native_scene("stiction-mass")
    return open_fmu(shelf(build_native, scene, start=dict(start), **ONE))


@pytest.fixture(params=KINDS)
def drive(request, shelf, open_fmu):
    if request.param == "python":
        return open_fmu(shelf(build, "valve-drive"))
    return open_fmu(shelf(build_native_drive, start={"h": 5e-6}, **ONE))  # a file of its own


def begin(host, start=0.0, stop=None, tolerance=None, **values):
    """Bring an instance to its first step; `host.time` is its clock."""
    host.slave.setupExperiment(tolerance=tolerance, startTime=start, stopTime=stop)
    host.set(**values)
    host.slave.enterInitializationMode()
    host.slave.exitInitializationMode()
    host.time = start
    return host


# Stop time ------------------------------------------------------------------------------------


def test_no_step_goes_beyond_the_stop_time(mass):
    begin(mass, 1.0, 1.001, F_ext=40.0)
    assert mass.step(9e-4) == OK
    before = mass.outputs()
    assert mass.step(2e-4) == DISCARD
    assert "beyond the stop time of the experiment" in mass.errors[0]
    assert mass.outputs() == before
    assert mass.step(1e-4 + 1e-16) == OK  # but for round-off
    assert mass.step(1e-9) == DISCARD


def test_a_stop_time_that_many_steps_sum_up_to_is_reached(mass):
    begin(mass, 0.0, 1e-3, F_ext=40.0)
    time = 0.0
    for _ in range(300):
        assert mass.step(1e-3 / 300, time) == OK
        time += 1e-3 / 300


@pytest.mark.parametrize("stop", [-1.0, math.nan])
def test_a_stop_time_must_follow_the_start(mass, stop):
    with contextlib.suppress(fmpy.fmi1.FMICallException):  # a native FMU returns it at once
        mass.slave.setupExperiment(startTime=0.0, stopTime=stop)
    assert "stop time must not come before the start time" in mass.errors[0]


# Tolerance ------------------------------------------------------------------------------------


def test_the_tolerance_stands_for_rtol_unless_that_is_set(mass):
    assert begin(mass, tolerance=1e-5).get("rtol") == 1e-5
    assert begin(mass.reset(), tolerance=1e-5, rtol=1e-9).get("rtol") == 1e-9
    mass.reset().set(rtol=1e-8)  # its own start value, and before the tolerance comes
    assert begin(mass, tolerance=1e-5).get("rtol") == 1e-8
    assert begin(mass.reset()).get("rtol") == 1e-8


def test_a_tolerance_out_of_range_is_not_taken_silently(mass):
    assert begin(mass, tolerance=1e-300).get("rtol") == 1e-11
    assert "the tolerance of the experiment, 1e-300," in mass.log[0].message
    assert begin(mass.reset(), tolerance=0.5).get("rtol") == 0.1


@pytest.mark.parametrize("value", [1e-300, 9e-12, 0.2])
def test_an_rtol_out_of_range_is_refused(mass, value):
    with contextlib.suppress(fmpy.fmi1.FMICallException):
        mass.set(rtol=value)
    assert "rtol" in mass.errors[0]
    with pytest.raises(DescriptionError, match="rtol must be"):
        build("stiction-mass", "x.fmu", start={"rtol": value})


@pytest.mark.slow
def test_the_tolerance_it_suggests_is_its_own(shelf):
    for start, expected in (({}, 1e-8), ({"rtol": 1e-6}, 1e-6)):
        path = shelf(build, "stiction-mass", start=start)
        assert float(fmpy.read_model_description(str(path)).defaultExperiment.tolerance) == expected


# Clock ----------------------------------------------------------------------------------------


def test_steps_at_unix_time_do_what_they_say(mass):
    """Motion and times of events are those of a clock that starts at 0."""
    runs = []
    for start in (0.0, UNIX):
        begin(mass.reset(), start, F_ext=200.0, h_rel=5.2e-6)
        for _ in range(20):
            assert mass.step(1e-4) == OK
        runs.append(mass.outputs())
    near, late = runs
    assert near["n_release"] == late["n_release"] == 1
    for name in near:
        off = UNIX if name in ("t_break", "t_release") and near[name] >= 0.0 else 0.0
        assert late[name] - off == pytest.approx(near[name], rel=1e-12, abs=5e-7 * (off > 0)), name


def test_a_step_that_the_clock_cannot_tell_is_refused(mass):
    begin(mass, UNIX, F_ext=40.0)
    assert mass.step(1e-8) == DISCARD
    assert "vanishes in the round-off of the time" in mass.errors[0]
    assert mass.step(1e-3) == OK
    assert mass.step(1e-10) == OK  # what a master that sums up its steps ends with
    assert mass.step(1e-8) == DISCARD


def test_what_is_too_short_to_be_a_step_is_done_with_the_next(mass):
    begin(mass, F_ext=40.0)
    assert mass.step(1e-3) == OK
    before, done = mass.outputs(), mass.time
    for _ in range(3):
        assert mass.step(4e-13) == OK
    assert mass.outputs()["h"] > before["h"]
    assert mass.time == pytest.approx(done + 1.2e-12, abs=1e-18)


def test_a_drive_at_unix_time(drive):
    found = []
    for start in (0.0, UNIX):
        begin(drive.reset(), start, t_delay=start, h=5e-6, v=0.02, n_cycles=1)
        assert drive.step(1e-3) == OK
        found.append(drive.outputs())
    assert found[1] == pytest.approx(found[0], rel=1e-3)  # a switching time is off by 0.2 us
    assert found[0]["flux"] > 0.0


def test_more_switchings_than_can_be_followed_are_refused(drive):
    fast = {"T_period": 1e-9, "t_on": 5e-10, "t_boost": 1e-10, "n_cycles": 2_000_000_000}
    begin(drive, t_delay=0.0, **fast)
    assert drive.step(1.0) == DISCARD
    assert "3e+09 switchings of the voltage" in drive.errors[0]
    assert drive.step(1e-7) == OK


# Input derivatives ----------------------------------------------------------------------------


@needs_compiler
def test_a_rate_is_given_once(shelf, open_fmu):
    scene, start = native_scene("stiction-mass")
    host = open_fmu(shelf(build_native, scene, start=dict(start), **ONE))
    reference = [host.variables["F_ext"].valueReference]
    gaps = []
    for given in ("dF_ext", "derivative", "both"):
        begin(host.reset(), F_ext=40.0)
        if given != "derivative":
            host.set(dF_ext=1e5)
        if given != "dF_ext":
            host.slave.setRealInputDerivatives(reference, [1], [1e5])
        assert host.step(1e-3) == (DISCARD if given == "both" else OK)
        gaps.append(host.get("h"))
    assert gaps[0] == gaps[1] > gaps[2]
    assert "the rate of F_ext is given twice, as dF_ext = 100000 N/s" in host.errors[0]
