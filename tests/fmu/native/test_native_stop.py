"""The native ``contact-stop``: as the Python FMU, over any loading and unloading."""

from __future__ import annotations

import random

import pytest
from drive_faces import rough
from native_scenes import HAS_CC

pytest.importorskip("pythonfmu")
pytest.importorskip("fmpy")
if not HAS_CC:
    pytest.skip("there is no C compiler", allow_module_level=True)

from fmpy.fmi1 import FMICallException

from contactkit.fmu.framework.toolchain import local
from contactkit.fmu.native.drive import build_native_stop
from contactkit.fmu.python.build import validate
from contactkit.fmu.slaves.contact_stop import ContactStop

ONE = {"platforms": [local()], "compiler": "cc"}
OK, DISCARD = 0, 2
MOST, TOUCH = 1e-6, 25e-6
EXACT = ("F", "F_el", "k", "c", "contact_area", "plastic_area", "d", "d_max", "d_res", "W_d")


@pytest.fixture(scope="module")
def fmu(shelf):
    return shelf(build_native_stop, curve=rough(), start={"scale": 2.0}, **ONE)


@pytest.fixture
def host(fmu, open_fmu):
    return open_fmu(fmu)


def slave(**values):
    """The Python FMU, in this process."""
    made = ContactStop(instance_name="direct")
    made.data = {"curve": rough().to_data()}
    made.setup_experiment(0.0)
    made.values |= {"scale": 2.0, **values}
    made.enter_initialization_mode()
    made.exit_initialization_mode()
    assert not made.failure
    return made


@pytest.mark.slow
@pytest.mark.parametrize("fmi", [2, 3])
def test_fmpy_finds_no_problems(shelf, fmi):
    path = shelf(build_native_stop, curve=rough(), start={"scale": 2.0}, fmi=fmi, **ONE)
    assert validate(path) == []


@pytest.mark.parametrize(
    "values",
    [
        {},
        {"k_body": 3e8, "d_stop": 5.0},
        {"side": 2, "d_stop": 5.0, "d_max0": 0.6 * MOST},
        {"d_max0": MOST},
    ],
)
def test_it_gives_what_the_slave_gives(host, values):
    """Up and down at random, from touch to beyond the tables."""
    slave_in_python, chance = slave(**values), random.Random(3)
    host.start(**values)
    sign = -1.0 if values.get("side") == 2 else 1.0
    fractions = [-0.1, 0.0, 1e-9, 0.2, *(chance.uniform(-0.05, 1.02) for _ in range(60)), 1.3, 0.5]
    for n, fraction in enumerate(fractions):
        given = {"h": TOUCH + sign * fraction * MOST, "v": chance.uniform(-0.3, 0.3)}
        host.set(**given)
        slave_in_python.values |= given
        assert host.step(1e-6) == OK
        assert slave_in_python.do_step(n * 1e-6, 1e-6), slave_in_python.failure
        found, expected = host.outputs(), slave_in_python.values
        for name in EXACT:
            assert found[name] == pytest.approx(expected[name], rel=1e-9, abs=1e-24), (n, name)
        assert found["state"] == expected["state"]
        assert found["n_beyond"] == expected["n_beyond"]
        # Tabulated, and made to rise where interpolation between the unloading curves falls.
        assert found["W"] == pytest.approx(expected["W"], rel=2e-3, abs=1e-3 * 2.0 * 1e-9)


def test_its_slopes_are_those_of_the_law(host):
    host.start(d_stop=5.0, k_body=3e8)
    references = {name: v.valueReference for name, v in host.variables.items()}
    host.set(h=TOUCH + 0.5 * MOST, v=0.1)
    assert host.step(1e-6) == OK
    of = [references["F"], references["F_el"]]
    by_gap = host.slave.getDirectionalDerivative(of, [references["h"]], [1.0])
    by_speed = host.slave.getDirectionalDerivative(of, [references["v"]], [1.0])
    assert by_gap == pytest.approx([1.5 * host.get("k"), host.get("k")])
    assert by_speed == pytest.approx([host.get("c"), 0.0])


def test_what_the_tables_do_not_hold_is_refused(host):
    host.slave.setupExperiment()
    host.set(d_max0=2.0 * MOST)
    host.slave.enterInitializationMode()
    with pytest.raises(FMICallException):
        host.slave.exitInitializationMode()
    assert "d_max0 must not exceed 1e-06 m, where the tables end" in host.errors[0]


def test_a_step_without_numbers_leaves_no_trace(host):
    host.start(d_stop=1e300)
    host.set(h=TOUCH + 0.5 * MOST, v=1e300)
    assert host.step(1e-6) == DISCARD
    host.set(v=0.0)
    assert host.step(1e-6) == OK
