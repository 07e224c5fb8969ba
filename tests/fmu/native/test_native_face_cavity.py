"""Cavities on faces that are no disc, in native FMUs: motion of Python, states, events."""

from __future__ import annotations

import attrs
import pytest
from native_scenes import HAS_CC, PAD, RING, scene

pytest.importorskip("pythonfmu")
pytest.importorskip("fmpy")
if not HAS_CC:
    pytest.skip("there is no C compiler", allow_module_level=True)

import contactkit as ck
from contactkit.fmu.framework.toolchain import local
from contactkit.fmu.native.build import build_native
from contactkit.fmu.native.film import FINE, moving
from contactkit.separation.cavity.path import along_path
from contactkit.separation.cavity.state import FULL, Phase
from contactkit.separation.motion.advance import advance
from contactkit.separation.motion.state import Pull, outputs, start
from contactkit.separation.plan import plan

pytestmark = pytest.mark.slow

OK, DISCARD = 0, 2
RTOL = 3e-2  # of the film: 32 cells across, in Python and in C the same
ONE = {"platforms": [local()], "compiler": "cc", "film_rtol": RTOL}
LIMIT = ck.TensionLimit(strength=2e5, cavity_pressure=1e5, ambient_pressure=2e5)


def cavitating(face, **given):
    given = {"gap": 5e-6, "final": 5.6e-6, "stiffness": 0.0} | given
    return scene(lower=ck.Flat(), upper=face, effects=(ck.ViscousForce(), LIMIT), **given)


@pytest.fixture
def native(shelf, open_fmu):
    """Host of a native FMU of a scene."""

    def of(given, **more):
        return open_fmu(shelf(build_native, given, **ONE, **more))

    return of


def events(host):
    return [entry.message.split(" at ")[0] for entry in host.log if entry.category == "logEvents"]


@pytest.mark.parametrize(
    "face",
    [
        pytest.param(RING, id="ring", marks=pytest.mark.slow),
        pytest.param(PAD, id="tilted", marks=pytest.mark.exhaustive),
    ],
)
def test_a_face_pulled_pressed_and_pulled_again_moves_as_in_python(face, native):
    """It cavitates, releases, is full again and cavitates anew.

    The cells and their equations are the same; between even faces Python takes the force of a
    cavity that grows from a table of speeds, 3e-4 off, and the steps differ, by what moves a gap
    that is pressed together by 1e-5.
    """
    given = cavitating(face)
    # The step of the kernel has the tolerance of its parameter rtol, and that of the film.
    prepared = plan(moving(given, None), attrs.evolve(ck.Accuracy(), film_rtol=RTOL))
    host, state, time, step = native(given).start(), start(prepared), 0.0, 2e-5
    largest = 0.0
    for force in (20.0, 20.0, -40.0, -40.0, -40.0, 20.0, 20.0):
        host.set(F_ext=force)
        assert host.step(step) == OK
        state = advance(prepared, state._replace(time=time), Pull(force), step)
        time += step
        shown = outputs(prepared, state, force)
        largest = max(largest, shown.void)
        assert host.get("h") == pytest.approx(state.gap, rel=5e-5)
        assert host.get("V_void") == pytest.approx(shown.void, rel=1e-3, abs=1e-3 * largest)
        assert host.get("F") == pytest.approx(shown.film, rel=1e-3)
        assert host.get("r_cav") == pytest.approx(shown.cavity_radius, rel=5e-3)
        assert host.get("t_release") == pytest.approx(state.release_time, rel=1e-4)
        assert host.get("limit") == shown.limit
    counts = state.n_inceptions, state.n_reformations, host.get("n_release")
    assert counts == (2, 1, state.n_releases)
    said = ["film cavitated", "released", "film reformed", "film cavitated", "released"]
    assert events(host) == said[: 3 + state.n_releases]


def test_a_state_in_the_middle_of_a_cavity_gives_the_same_again(native):
    """Of the same instance and of its clone, by bytes; and from a film that has closed since."""
    given = cavitating(RING)
    host, clone = native(given).start(), native(given).start()
    host.set(F_ext=20.0)
    assert host.step(4e-5) == OK
    saved = host.slave.getFMUState()
    data = host.slave.serializeFMUstate(saved)
    assert len(data) > 8 * 600  # the liquid of every cell
    assert host.get("V_void") > 0.0

    def go_on(one, state):
        one.slave.setFMUState(state)
        one.time = 4e-5
        assert one.get("V_void") > 0.0
        one.set(F_ext=-10.0)
        assert one.step(4e-5) == OK
        return one.outputs()

    after = go_on(host, saved)
    host.set(F_ext=-40.0)
    assert host.step(1e-4) == OK
    assert host.get("V_void") == 0.0
    assert go_on(host, saved) == after
    assert go_on(host, host.slave.deSerializeFMUstate(data)) == after
    assert go_on(clone, clone.slave.deSerializeFMUstate(data)) == after


def test_a_state_whose_liquid_was_changed_is_refused(native):
    from fmpy.fmi1 import FMICallException

    host = native(cavitating(RING)).start()
    host.set(F_ext=20.0)
    host.step(4e-5)
    data = bytearray(host.slave.serializeFMUstate(host.slave.getFMUState()))
    data[-9] ^= 1
    with pytest.raises(FMICallException):
        host.slave.deSerializeFMUstate(bytes(data))
    assert "the bytes were changed" in host.errors[-1]


def test_a_discarded_step_leaves_the_liquid_as_it_was(native):
    """One that takes too long; then the shorter one is that of a host that never tried."""
    given = cavitating(RING)
    host, other = native(given).start(max_steps=1200), native(given).start()
    for one in (host, other):
        one.set(F_ext=20.0)
        assert one.step(2e-6) == OK
    before = host.outputs()
    host.set(F_ext=-400.0)
    assert host.step(4e-5) == DISCARD
    assert "raise max_steps" in host.errors[-1]
    host.set(F_ext=20.0)
    assert host.outputs() == before
    assert host.step(1e-6) == other.step(1e-6) == OK
    assert host.outputs() == other.outputs()


def test_along_a_motion_impulse_and_void_are_those_of_the_path(native):
    given = cavitating(RING, final=2e-5)
    law = plan(moving(given, None), attrs.evolve(FINE, film_rtol=RTOL)).film.cavity
    host = native(given, model="stiction-force").start()
    cavity, gap, taken, seen = FULL, 5e-6, 0.0, set()
    for target, length in ((5.6e-6, 3e-5), (6e-6, 1e-4), (5.4e-6, 1e-4), (4.8e-6, 1e-4)):
        speed = (target - gap) / length
        host.set(h=target, v=speed)
        assert host.step(length) == OK
        place = lambda t, a=gap, v=speed: (a + v * t, v)  # noqa: E731
        time = 0.0
        for point in along_path(law, cavity, place, 0.0, length, 1e-9):
            impulse = point.impulse
            if impulse is None:
                here, there = place(time)[0], place(point.time)[0]
                impulse = law.viscosity * law.film.impulse(here, there)
            taken, time, cavity = taken + impulse, point.time, point.cavity
        seen.add(cavity.phase)
        gap = target
        assert host.get("V_void") == pytest.approx(cavity.void, rel=2e-3, abs=1e-15)
        assert host.get("J") == pytest.approx(taken, rel=2e-3)
    assert seen == {Phase.FULL, Phase.RECEDING}
    assert events(host) == ["film cavitated", "film reformed"]


def test_a_tension_that_is_set_is_that_at_which_it_cavitates(native):
    host = native(cavitating(RING)).start(dp_inception=0.0, dp_hold=0.0)
    host.set(F_ext=20.0)
    assert host.step(4e-5) == OK
    assert host.get("V_void") == 0.0
    assert host.get("F") == pytest.approx(20.0, rel=1e-2)


def test_a_scene_file_says_how_fine_its_grid_is(tmp_path, monkeypatch):
    from contactkit.app.fmu_files import Order, build_fmu
    from contactkit.fmu.native import build

    asked = {}
    monkeypatch.setattr(build, "build_native", lambda *given, **more: asked.update(more))
    place = tmp_path / "ring.toml"
    ck.save_scene(cavitating(RING), place)
    for settings, film_rtol in (
        (("accuracy.film_rtol=0.02",), 0.02),
        (("accuracy.film_rtol=0.001",), 0.001),  # the usual one, and asked for all the same
        (("accuracy.level=reference",), 1e-4),
        ((), None),
    ):
        build_fmu(Order(str(place), settings, tmp_path / "x.fmu", True, None, "2"))
        assert asked["film_rtol"] == film_rtol
