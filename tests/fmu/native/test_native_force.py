"""The native ``stiction-force``: forces of the plan, slopes, impulses, doubts, derivatives."""

from __future__ import annotations

import math

import numpy as np
import pytest
from master_cases import film_values, ramp
from native_scenes import HAS_CC, SCENES, scene
from selection import quick

pytest.importorskip("pythonfmu")
fmpy = pytest.importorskip("fmpy")
if not HAS_CC:
    pytest.skip("there is no C compiler", allow_module_level=True)

from contactkit.errors import DescriptionError  # noqa: E402
from contactkit.fmu.framework.toolchain import local  # noqa: E402
from contactkit.fmu.master.couple import Fmu, Mass, couple  # noqa: E402
from contactkit.fmu.native.build import build_native, native_scene  # noqa: E402
from contactkit.fmu.native.film import FINE, moving  # noqa: E402
from contactkit.fmu.python import build as building  # noqa: E402
from contactkit.fmu.slaves.rheology import RHEOLOGY  # noqa: E402
from contactkit.fmu.slaves.stiction_force import PORTS, Exchange  # noqa: E402
from contactkit.fmu.slaves.stiction_mass import PORTS as MASS_PORTS  # noqa: E402
from contactkit.fmu.slaves.stiction_mass import MeniscusLaw, scene_of  # noqa: E402
from contactkit.separation.effects.base import FilmStatus, LimitKind  # noqa: E402
from contactkit.separation.plan import plan  # noqa: E402

pytestmark = pytest.mark.slow

OK, DISCARD = 0, 2
ONE = {"platforms": [local()], "compiler": "cc", "model": "stiction-force"}


@pytest.fixture(scope="module")
def native(shelf):
    """FMUs of scenes."""
    return lambda name: shelf(build_native, SCENES[name], **ONE)


@pytest.fixture(scope="module")
def pair(shelf):
    """The Python FMU and a native one of the same film."""

    def of(**values):
        film = {port.name: port.start for port in MASS_PORTS} | values
        film |= {"h_rel": 20.0 * film["h0"], "m": 0.02}
        return shelf(building.build, "stiction-force"), shelf(build_native, scene_of(film), **ONE)

    return of


def test_it_is_valid_and_named_apart_from_the_mass(native):
    assert building.validate(native("drop")) == []
    read = fmpy.read_model_description(str(native("drop")))
    assert read.coSimulation.modelIdentifier == "stiction_force"
    assert {category.name for category in read.logCategories} >= {"logCoupling", "logEvents"}


def test_variables_are_those_of_the_python_fmu(native):
    ports = {port.name: port for port in PORTS}
    found = fmpy.read_model_description(str(native("drop"))).modelVariables
    fixed = {"R", "V", "N", "theta1", "theta2", "meniscus_law", "rewet"}
    wetting = {"slip", "slip_from", "film_law", "a_break", "n_Ca", "trouton", "weight", "rho"}
    assert set(ports) - {v.name for v in found} - {"V_left"} == {*fixed, *wetting, *RHEOLOGY}
    for variable in found:
        port = ports[variable.name]
        assert (variable.unit or "-", variable.causality) == (port.unit, port.causality)
        assert variable.type.lower() == port.kind


# Forces --------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", quick(SCENES, 5, 8, 12))
def test_forces_are_those_of_the_plan_of_any_scene(name, native, open_fmu):
    """The kernel of every scene, to 1e-10, is in `test_native_kernel`."""
    film = plan(moving(SCENES[name], None), FINE).film
    host = open_fmu(native(name)).start()
    first = SCENES[name].loading.initial_gap
    last = min(0.97 * film.end, 0.97 * film.release, 2.0 * SCENES[name].loading.final_gap)
    speeds = (0.0, 1e-3, -1e-3, 1.0, 0.0, 1e-3, -1e-3)
    gaps = np.geomspace(1.001 * first, last, len(speeds)).tolist()
    for gap, speed in zip(gaps, speeds, strict=True):
        host.set(h=gap, v=speed)
        found = host.outputs()
        static, (viscous, limit) = film.static_force(gap), film.viscous_force(gap, speed)
        assert found["F_m"] == pytest.approx(static, rel=1e-9, abs=1e-30)  # 1e-134 N of summits
        assert found["F_v"] == pytest.approx(viscous, rel=1e-9)
        assert found["F"] == found["F_m"] + found["F_v"]
        if limit is LimitKind.NONE:
            assert found["c"] == pytest.approx(film.damping(gap), rel=1e-9)
        dh = 1e-5 * gap
        slope = (film.force(gap + dh, speed) - film.force(gap - dh, speed)) / (2.0 * dh)
        size = abs(slope) + abs(found["F"]) / gap
        if size > 1e-30:  # the tail of a bell curve is not followed further
            assert found["k"] == pytest.approx(slope, abs=1e-6 * size)
        marks = [m for m in (*film.kinks, film.end, film.release) if gap < m < math.inf]
        assert found["h_above"] == pytest.approx(min(marks, default=0.0), rel=1e-14)
        assert found["limit"] == limit
        assert found["state"] == (FilmStatus.FULL if gap <= film.full_gap else FilmStatus.BRIDGE)


FILMS = {
    "flooded": {},
    "volume": {"V": 2e-10},
    "10 nm": {"h0": 10e-9, "R": 0.5e-3, "V": 7.85e-15},
    "tension": {"V": 1.58e-10, "dp_cav": 1e6},
    "shear": {"tau_lim": 1e4},
    "rupture": {"V": 1.58e-10, "h_break": 12e-6, "rewet": 0.5, "N": 3},
}


@pytest.mark.parametrize("film", FILMS.values(), ids=FILMS)
def test_it_answers_as_the_python_fmu_step_by_step(film, pair, open_fmu):
    """There and back in short and long steps: every output and message."""
    hosts = [open_fmu(path) for path in pair(**film)]
    gap = film.get("h0", 5e-6)
    hosts[0].start(**film, h=gap)
    hosts[1].start()
    ratios = [1.0, 1.01, 1.02, 1.1, 1.3, 1.2, 1.5, 2.0, 3.0, 3.0, 1.1, 1.0, 0.999, 1.2, 1.4]
    now = 1.0
    for i, ratio in enumerate(ratios):
        length = (1e-9, 1e-3)[i % 2]
        speed = (ratio - now) * gap / length
        answers = []
        for host in hosts:
            host.set(h=ratio * gap, v=speed)
            assert host.step(length) == OK
            answers.append(host.outputs())
        python, own = answers
        ways = abs(ratio / now - 1.0) < 0.11  # what Simpson's rule of the Python FMU is good for
        now = ratio
        for name in ("F", "F_m", "F_v", "h_above", "h_below", "t_break"):
            assert own[name] == pytest.approx(python[name], rel=2e-8), name
        if own["limit"] == LimitKind.NONE:  # else those of the Python FMU are differences
            assert own["c"] == pytest.approx(python["c"], rel=2e-8)
            assert own["H_stable"] == pytest.approx(python["H_stable"], rel=2e-8)
        assert own["k"] == pytest.approx(python["k"], rel=1e-6)
        assert own["J"] == pytest.approx(python["J"], rel=2e-5, abs=1e-8 * abs(own["F"]) * 1e-3)
        for name in ("state", "limit", "n_break", "in_doubt", "n_doubt"):
            assert own[name] == python[name], name
        if ways:
            assert own["F_mean"] == pytest.approx(python["F_mean"], rel=1e-4)
            assert own["coupling_error"] == pytest.approx(python["coupling_error"], abs=1e-4)
    assert [e.category for e in hosts[0].log] == [e.category for e in hosts[1].log]
    assert hosts[1].log[0].message == hosts[0].log[0].message


def move(host, length, gap, speed=0.0):
    host.set(h=gap, v=speed)
    assert host.step(length) == OK


@pytest.mark.parametrize("n", [1, 40])
@pytest.mark.parametrize("end", [20.2e-6, 1e-4, 3e-3])
def test_the_impulse_does_not_depend_on_the_way(n, end, native, open_fmu):
    """Stefan's law, integrated by hand; there, and back to nothing."""
    host = open_fmu(native("flooded")).start(gamma=0.0, exchange=int(Exchange.IMPULSE))
    whole = 0.75 * math.pi * 0.1 * 3.175e-3**4 * (20e-6**-2 - end**-2)
    for i in range(n):
        move(host, 1e-3 * (1 + i % 3), 20e-6 * (end / 20e-6) ** ((i + 1) / n))
    assert host.get("J") == pytest.approx(whole, rel=1e-12)
    move(host, 1e-3, 20e-6)
    assert host.get("J") == pytest.approx(0.0, abs=1e-12 * whole)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["sphere", "stieber", "shear", "rewetting"])
def test_impulses_are_integrals_of_the_forces(name, native, open_fmu):
    """Over kinks and limits, by 20 000 midpoints of the Python laws at the mean speed."""
    film = plan(moving(SCENES[name], None), FINE).film
    host = open_fmu(native(name)).start(exchange=int(Exchange.IMPULSE))
    begin = SCENES[name].loading.initial_gap
    for ratio, length in ((3.0, 1e-3), (1.5, 1e-2)):
        end, before = ratio * begin, host.outputs()
        gap = host.get("h") if ratio == 1.5 else begin
        speed = (end - gap) / length
        move(host, length, end, speed)
        points = gap + (np.arange(20_000) + 0.5) / 20_000 * (end - gap)
        viscous = np.mean([film.viscous_force(float(p), speed)[0] for p in points]) * length
        static = np.mean([film.static_force(float(p)) for p in points]) * length
        assert host.get("J") - before["J"] == pytest.approx(viscous, rel=1e-6)
        assert host.get("J_m") - before["J_m"] == pytest.approx(static, rel=1e-6)
        assert host.get("F_mean") == pytest.approx((viscous + static) / length, rel=1e-6)


def test_solids_hold_on_after_the_film_broke(native, open_fmu):
    """A tip that sticks: rupture and parting in one step, then joined and wet again."""
    film = plan(moving(SCENES["tip that sticks"], None), FINE).film
    host = open_fmu(native("tip that sticks")).start(exchange=int(Exchange.IMPULSE))
    gap = SCENES["tip that sticks"].loading.initial_gap
    alone = film.remaining(broken=True, detached=False)
    move(host, 1e-6, 1.5 * max(film.end, film.release))
    assert (host.get("n_break"), host.get("state"), host.get("F")) == (1, FilmStatus.BROKEN, 0.0)
    fraction = (film.end - gap) / (1.5 * max(film.end, film.release) - gap)
    assert host.get("t_break") == pytest.approx(fraction * 1e-6, rel=1e-6)
    assert host.get("h_below") == pytest.approx(max(gap, film.recontact))
    if alone is not None and film.recontact > gap:
        move(host, 1e-6, 0.5 * (gap + film.recontact))
        there = alone.static_force(0.5 * (gap + film.recontact))
        assert host.get("F_m") == pytest.approx(there, rel=1e-8)
    move(host, 1e-6, gap)
    assert host.get("F_m") == pytest.approx(film.static_force(gap), rel=1e-8)


# Master --------------------------------------------------------------------------------------


@pytest.mark.slow
@pytest.mark.parametrize("name", ["A", "B", "D", "E"])
def test_the_master_drives_it_as_the_python_one(name, release_cases, pair):
    case, values = release_cases[name]["case"], release_cases[name]["values"]
    film = film_values(case) | {"meniscus_law": MeniscusLaw.PUBLISHED}
    paths = pair(**film)
    free = {key: film[key] for key in ("h0", "eta", "gamma", "dp_cav", "tau_lim")}
    found = [
        couple(
            Fmu(path, start),
            Mass(mass=case["m"], stiffness=case["k_s"]),
            ramp(case["F0"], case["tau"]),
            2.0 * values["t_rel"],
            release_gap=case["h_rel"],
        )
        for path, start in zip(paths, (film_values(case), free), strict=True)
    ]
    for one in found:
        assert one.release_time == pytest.approx(values["t_rel"], rel=1e-3)
        assert one["v"][-1] == pytest.approx(values["v_rel"], rel=3e-3)
        assert one.log == ()
    assert found[1].n_steps == found[0].n_steps
    assert found[1].release_time == pytest.approx(found[0].release_time, rel=1e-6)


# State and refusals ----------------------------------------------------------------------------


def test_a_state_brings_back_film_and_doubts(native, open_fmu):
    host = open_fmu(native("rewetting")).start()
    move(host, 1e-4, 10e-6, 0.05)
    saved = host.slave.getFMUState()
    data = host.slave.serializeFMUstate(saved)
    film_end = host.get("h_above")
    move(host, 1e-3, 2.0 * film_end, 0.05)
    after = host.outputs()
    assert after["n_break"] == 1
    for state in (saved, host.slave.deSerializeFMUstate(data)):
        host.slave.setFMUState(state)
        host.time = 1e-4
        assert host.get("state") != FilmStatus.BROKEN
        move(host, 1e-3, 2.0 * film_end, 0.05)
        assert host.outputs() == after


def test_a_broken_film_rewets_with_its_fraction(native, open_fmu):
    host = open_fmu(native("rewetting")).start(exchange=int(Exchange.IMPULSE))
    gap = SCENES["rewetting"].loading.initial_gap
    half = plan(moving(SCENES["rewetting"], None), FINE).film_with(0.5)
    move(host, 1e-3, 1e-3)
    assert (host.get("state"), host.get("h_below")) == (FilmStatus.BROKEN, gap)
    move(host, 1e-3, 0.9 * gap)
    assert host.get("F") == pytest.approx(half.force(0.9 * gap, 0.0), rel=1e-9)


def test_what_is_refused_can_be_rolled_back(native, open_fmu):
    host = open_fmu(native("drop")).start()
    saved = host.slave.getFMUState()
    with pytest.raises(Exception, match="fmi2SetReal"):
        host.set(h=1e-12)  # below the tables
    assert host.step(1e-3) == DISCARD
    assert "h must be a finite number, at least" in host.errors[0]
    host.slave.setFMUState(saved)
    assert host.step(1e-3, 0.0) == OK


def test_both_models_live_in_one_process(native, open_fmu, tmp_path):
    force = open_fmu(native("drop")).start()
    mass = build_native(SCENES["drop"], tmp_path / "mass.fmu", **(ONE | {"model": "stiction-mass"}))
    mass = open_fmu(mass).start()
    mass.set(F_ext=40.0)
    assert mass.step(1e-3) == OK
    move(force, 1e-3, mass.get("h"), mass.get("v"))
    assert force.get("F") == pytest.approx(mass.get("F"), rel=1e-12)
    assert force.get("J") == pytest.approx(mass.get("J"), rel=1e-6)


def test_what_cannot_be_built_is_refused(tmp_path):
    with pytest.raises(DescriptionError, match="model must be 'stiction-mass' or"):
        build_native(SCENES["drop"], tmp_path / "x.fmu", **(ONE | {"model": "valve"}))
    with pytest.raises(DescriptionError, match="m must be given"):
        build_native(scene(mass=None), tmp_path / "x.fmu", **ONE)
    path = build_native(scene(mass=None), tmp_path / "x.fmu", start={"m_ref": "20 g"}, **ONE)
    read = {v.name: v.start for v in fmpy.read_model_description(str(path)).modelVariables}
    assert float(read["m_ref"]) == 0.02


def test_the_name_alone_gives_the_film_of_the_python_fmu():
    made, start = native_scene("stiction-force")
    assert made.loading.initial_gap == 5e-6
    assert start == {}


# Derivatives -----------------------------------------------------------------------------------


def derivative(host, unknown, known):
    number = {name: v.valueReference for name, v in host.variables.items()}
    return host.slave.getDirectionalDerivative([number[unknown]], [number[known]], [1.0])[0]


@pytest.mark.parametrize("name", ["drop", "sphere", "stieber", "shear", "tip that sticks"])
def test_directional_derivatives_are_those_of_the_force(name, native, open_fmu):
    host = open_fmu(native(name)).start()
    gap, speed = 1.3 * SCENES[name].loading.initial_gap, 2e-2
    host.set(h=gap, v=speed)
    there = host.outputs()
    found = {(a, b): derivative(host, a, b) for a in ("F", "F_m", "F_v") for b in ("h", "v")}
    assert found["F", "h"] == there["k"]
    assert found["F", "v"] == found["F_v", "v"] == there["c"]
    assert found["F_m", "v"] == 0.0
    assert found["F_m", "h"] + found["F_v", "h"] == pytest.approx(there["k"], rel=1e-12)
    for a, b in found:
        at, fraction = {"h": gap, "v": speed}, 1e-4
        answers = []
        for k in (-2, -1, 1, 2):
            host.set(**(at | {b: at[b] * (1.0 + k * fraction)}))
            answers.append(host.get(a))
        weights = np.array([1.0, -8.0, 8.0, -1.0]) / (12.0 * fraction * at[b])
        size = abs(there["F"]) / at[b]
        assert found[a, b] == pytest.approx(weights @ answers, rel=1e-6, abs=1e-7 * size)
    host.set(h=gap, v=speed)
    near = []
    for k in (-1, 1):
        host.set(h=gap * (1.0 + 1e-4 * k))
        near.append(host.outputs())
    host.set(h=gap)
    for unknown in ("c", "k", "H_stable"):
        slope = (near[1][unknown] - near[0][unknown]) / (2e-4 * gap)
        size = abs(there[unknown]) / gap
        assert derivative(host, unknown, "h") == pytest.approx(slope, rel=1e-4, abs=1e-5 * size)
    assert derivative(host, "J", "h") == 0.0
    assert host.outputs() == there


def test_before_the_first_step_outputs_follow_the_parameters(native, open_fmu):
    host = open_fmu(native("drop"))
    host.slave.setupExperiment(startTime=0.0)
    host.slave.enterInitializationMode()
    host.set(v=1e-3)
    there = host.outputs()
    assert derivative(host, "F_v", "eta") == pytest.approx(there["F_v"] / 0.1, rel=1e-8)
    assert derivative(host, "F_m", "gamma") == pytest.approx(there["F_m"] / 0.03, rel=1e-8)
    assert derivative(host, "H_stable", "m_ref") == pytest.approx(1.0 / there["c"], rel=1e-8)
    assert derivative(host, "F", "h") == there["k"]
    assert host.outputs() == there
    with pytest.raises(Exception, match="DirectionalDerivative"):
        derivative(host, "F", "dp_cav")
    assert "0 stands for none" in host.errors[-1]
    host.slave.exitInitializationMode()
    assert host.step(1e-3) == OK


def test_of_the_mass_nothing_follows_at_once_but_the_start(open_fmu, tmp_path):
    path = build_native(SCENES["drop"], tmp_path / "x.fmu", **(ONE | {"model": "stiction-mass"}))
    host = open_fmu(path)
    host.slave.setupExperiment(startTime=0.0)
    host.slave.enterInitializationMode()
    assert derivative(host, "h", "h0") == pytest.approx(1.0, rel=1e-9)
    assert derivative(host, "F_m", "gamma") == pytest.approx(host.get("F_m") / 0.03, rel=1e-8)
    host.slave.exitInitializationMode()
    host.set(F_ext=40.0)
    assert host.step(1e-3) == OK
    assert derivative(host, "h", "F_ext") == 0.0
    with pytest.raises(Exception, match="DirectionalDerivative"):
        derivative(host, "F", "eta")
    assert "does not change any more" in host.errors[-1]
    assert host.step(1e-3) == OK
