"""The FMU ``stiction-mass``: right, stiff, restorable, and clear about misuse."""

from __future__ import annotations

import itertools
import math
import subprocess
import sys
import zipfile

import attrs
import pytest
from selection import quick

import contactkit as ck
from contactkit.capillary.exact.bridge import bridge
from contactkit.capillary.exact.stability import stability_limit
from contactkit.errors import ConvergenceError, DescriptionError, PlanError
from contactkit.fmu.python import build as building
from contactkit.fmu.slaves.stiction_mass import (
    PORTS,
    MeniscusLaw,
    StictionMass,
    mass_values,
    scene_of,
)
from contactkit.separation.effects.base import FilmStatus, LimitKind

OK, DISCARD = 0, 2
DISC = math.pi * 3.175e-3**2


@pytest.fixture(scope="session")
def mass_fmu(shelf):
    return shelf(building.build, "stiction-mass")


@pytest.fixture
def host(mass_fmu, open_fmu):
    return open_fmu(mass_fmu)


def start_values(case):
    names = {"m": "m", "h0": "h0", "k_s": "k_s", "h_rel": "h_rel", "R": "R", "eta": "eta"}
    names |= {"gamma": "gamma", "theta1": "theta", "theta2": "theta", "V": "V"}
    names |= {"dp_cav": "dp_cav", "tau_lim": "tau_lim"}
    return {port: case[key] for port, key in names.items()} | {
        "meniscus_law": MeniscusLaw.PUBLISHED
    }


def pull(case, time):
    return case["F0"] * (1.0 if case["tau"] == 0.0 else -math.expm1(-time / case["tau"]))


def release(host, case, n_steps, end):
    host.reset().start(**start_values(case))
    length = end / n_steps
    for i in range(n_steps):
        time = i * length
        first = pull(case, time)
        host.set(F_ext=first, dF_ext=(pull(case, time + length) - first) / length)
        assert host.step(length, time) == OK
    return host.get("t_release")


def test_it_is_valid(mass_fmu):
    assert building.validate(mass_fmu) == []


@pytest.mark.parametrize(
    ("name", "rtol"), quick([("A", 1e-6), ("B", 1e-6), ("D", 1e-6), ("E", 1e-5)], 0, 2, long=[3])
)
def test_the_release_cases_are_met(host, release_cases, name, rtol):
    """The tolerance is the one promised; the ramp of B and E is fed as 10 000 straight pieces."""
    case, values = release_cases[name]["case"], release_cases[name]["values"]
    n = 10_000 if case["tau"] else 10
    assert release(host, case, n, 1.02 * values["t_rel"]) == pytest.approx(
        values["t_rel"], rel=rtol
    )
    assert host.get("F_peak") == pytest.approx(values["peak"], rel=1e-6)


@pytest.mark.parametrize(
    "changes",
    quick(
        [
            {},
            {"h0": 10e-9, "R": 0.5e-3, "V": math.pi * 0.5e-3**2 * 10e-9},
            {"h0": 100e-6, "h_rel": 400e-6},
            {"eta": 1e-4},
            {"eta": 1e2, "h0": 20e-6, "dp_cav": 1e6},
            {"N": 100_000},
        ],
        0,
        4,
    ),
    ids=["5 um", "10 nm", "100 um", "thin oil", "pitch", "1e5 menisci"],
)
def test_the_release_time_does_not_depend_on_the_communication_step(host, changes):
    values = {"V": 0.0, "eta": 0.1} | changes
    times = []
    for n in (1, 7, 1000):
        host.reset().start(**values)
        host.set(F_ext=40.0)
        end = 2.5 if values.get("h0") == 10e-9 else 2.0
        length = end / n
        for i in range(n):
            assert host.step(length, i * length) == OK
            if host.get("t_release") > 0.0:
                break
        times.append(host.get("t_release"))
    assert times[0] > 0.0
    assert times == pytest.approx([times[0]] * 3, rel=1e-7)


def test_a_pull_below_the_meniscus_force_leaves_it_stuck(host):
    """10 nm of water under the whole disc pull with 186 N against 40 N."""
    host.start(h0=10e-9, h_rel=1e-4, V=DISC * 10e-9, gamma=0.03, theta1=0.2, theta2=0.2, eta=0.1)
    host.set(F_ext=40.0)
    assert host.get("F_m") == pytest.approx(186.0, rel=0.01)
    assert host.step(4.0) == OK
    assert host.get("state") == FilmStatus.STUCK
    assert host.get("t_release") == -1.0
    assert 9.9e-9 < host.get("h") < 10e-9


def test_rupture_is_found_inside_a_communication_step(host):
    found = []
    for n in (1, 1000):
        host.reset().start(h0=5e-6, h_rel=60e-6, h_break=30e-6, eta=0.01, dp_cav=1e6)
        host.set(F_ext=40.0)
        for i in range(n):
            assert host.step(2e-3 / n, i * 2e-3 / n) == OK
        found.append((host.get("t_break"), host.get("t_release")))
        assert host.get("state") == FilmStatus.BROKEN
        assert (host.get("F"), host.get("n_break")) == (0.0, 1)
    assert 0.0 < found[0][0] < found[0][1] < 2e-3
    assert found[0] == pytest.approx(found[1], rel=1e-7)


def test_a_state_saved_before_rupture_and_restored_after_gives_the_same_again(host):
    host.start(h0=5e-6, h_rel=60e-6, h_break=30e-6, eta=0.01, dp_cav=1e6)
    host.set(F_ext=40.0)
    host.step(1e-4)
    saved = host.slave.getFMUState()
    data = host.slave.serializeFMUstate(saved)
    host.step(2e-3)
    after = host.outputs()
    assert after["state"] == FilmStatus.BROKEN
    for state in (saved, host.slave.deSerializeFMUstate(data)):
        host.slave.setFMUState(state)
        host.time = 1e-4
        assert host.get("state") in (FilmStatus.BRIDGE, FilmStatus.FULL)
        assert host.get("t_break") == -1.0
        assert host.step(2e-3) == OK
        assert host.outputs() == after
        host.slave.freeFMUState(state)


def test_it_rests_on_its_asperities_and_the_film_is_full_again_when_it_returns(host):
    host.start(h0=5e-6, h_min=5e-6, h_rel=20e-6, h_break=18e-6, eta=0.01, dp_cav=1e6, k_s=0.0)
    assert host.get("state") == FilmStatus.CONTACT
    host.set(F_ext=-10.0)
    host.step(1e-3)
    assert (host.get("h"), host.get("v"), host.get("state")) == (5e-6, 0.0, FilmStatus.CONTACT)
    for turn in (1, 2):
        host.set(F_ext=40.0)
        host.step(1e-3)
        assert host.get("state") == FilmStatus.BROKEN
        host.set(F_ext=-400.0)
        host.step(2e-3)
        assert (host.get("h"), host.get("state")) == (5e-6, FilmStatus.CONTACT)
        assert (host.get("n_break"), host.get("n_release")) == (turn, turn)


@pytest.mark.parametrize(("rewet", "whole"), [(0.0, False), (0.5, True), (1.0, True)])
def test_rewetting_says_how_much_liquid_comes_back(host, rewet, whole):
    host.start(
        h0=5e-6, h_min=5e-6, h_rel=20e-6, h_break=18e-6, eta=0.01, V=DISC * 5e-6, rewet=rewet
    )
    host.set(F_ext=200.0)
    host.step(1e-3)
    assert host.get("state") == FilmStatus.BROKEN
    host.set(F_ext=-400.0)
    host.step(5e-3)
    assert (host.get("h"), host.get("v")) == (5e-6, 0.0)
    assert (host.get("state") == FilmStatus.CONTACT) == whole
    assert (host.get("F_m") > 0.0) == whole


def test_which_limit_acts_is_reported(host):
    host.start(h0=5e-6, eta=1.0, dp_cav=1e5)
    host.set(F_ext=40.0)
    host.step(1e-5)
    assert host.get("limit") == LimitKind.TENSION
    host.reset().start(h0=10e-9, R=0.5e-3, V=7.853981633974482e-15, eta=0.1, tau_lim=1e3)
    host.set(F_ext=40.0)
    host.step(1e-5)
    assert host.get("limit") == LimitKind.SHEAR


@pytest.mark.parametrize(
    ("lower", "upper"),
    quick([(0, 0), (90, 90), (180, 180), (60, 120), (15, 165), (0, 90)], long=[0, 2, 3]),
)
def test_every_pair_of_angles_runs(host, lower, upper):
    lower, upper = math.radians(lower), math.radians(upper)
    host.start(h0=5e-6, V=DISC * 5e-6, theta1=lower, theta2=upper, eta=0.01)
    host.set(F_ext=100.0)
    assert host.step(0.05) == OK
    assert host.get("t_release") > 0.0
    assert all(math.isfinite(value) for value in host.outputs().values())


def test_a_pair_of_angles_that_holds_no_bridge_is_refused(host):
    host.start(theta1=0.0, theta2=math.pi, V=DISC * 5e-6)
    assert host.step() == DISCARD
    assert "no bridge" in host.errors[0]
    host.reset().start()
    assert host.step(1e-5) == OK


PARAMETERS = [port for port in PORTS if port.causality == "parameter" and port.kind == "real"]
INPUTS = [port for port in PORTS if port.causality == "input"]


@pytest.mark.slow
def test_bad_parameters_are_refused_with_a_message_and_the_instance_lives_on(host):
    wrong = []
    for port in PARAMETERS:
        for value in (math.nan, math.inf, -1.0, 0.0):
            bad = {"v0": math.nan}.get(port.name, -1.0) if port.allows(value) else value
            host.start(**{port.name: bad})
            statuses, said = [host.step(), host.step()], host.errors[0]
            is_named = port.name in said and (port.unit == "-" or f"[{port.unit}]" in said)
            if statuses != [DISCARD, DISCARD] or not is_named:
                wrong.append((port.name, bad, statuses, said))
            host.reset()
        host.start()
        host.set(F_ext=40.0)
        if host.step(1e-5) != OK:
            wrong.append((port.name, "then refuses what is right"))
        host.reset()
    assert wrong == []


def test_bad_inputs_are_refused_and_the_outputs_stay_finite(host):
    for port, value in itertools.product(INPUTS, (math.nan, math.inf, -math.inf)):
        host.start()
        host.set(F_ext=40.0)
        assert host.step(1e-5) == OK
        good = host.outputs()
        host.set(**{port.name: value})
        assert host.step(1e-5) == DISCARD, (port.name, value)
        assert port.name in host.errors[0]
        assert host.outputs() == good
        host.reset().start()
        assert host.step(1e-5) == OK
        host.reset()


def test_contradicting_parameters_are_named(host):
    host.start(h0=1e-5, h_rel=1e-6)
    assert host.step() == DISCARD
    assert "h_rel must exceed h0" in host.errors[0]


def test_the_exact_bridge_is_the_default(host):
    """A drop that does not reach the rim, against the exact bridge of the kernel and the arc."""
    drop = {"R": 1e-3, "V": 1e-12, "h0": 2e-5, "gamma": 0.03, "theta1": 0.5, "theta2": 1.2}
    forces = {}
    for law in (None, MeniscusLaw.EXACT, MeniscusLaw.ARC):
        host.reset().start(**drop, **({} if law is None else {"meniscus_law": law}))
        assert host.step(1e-9) == OK
        forces[law] = host.get("F_m")
    exact = 0.03 * float(bridge(2e-5, 1e-12, 0.5, 1.2).force)
    assert forces[None] == forces[MeniscusLaw.EXACT] == pytest.approx(exact, rel=1e-8)
    assert 1e-3 < abs(forces[MeniscusLaw.ARC] / exact - 1.0) < 0.05


def test_the_film_breaks_at_the_limit_of_the_exact_bridge(host):
    drop = {"R": 1e-3, "V": 1e-12, "h0": 2e-5, "h_rel": 3e-4, "gamma": 0.03, "eta": 1e-3}
    host.start(**drop, theta1=0.5, theta2=1.2, F_ext=1e-3)
    limit = float(stability_limit(1e-12, 0.5, 1.2).gap)
    while host.get("t_break") < 0.0:
        before = host.get("h")
        assert host.step(2e-5) == OK
    assert before < limit < host.get("h") < 1.2 * limit


@pytest.mark.slow
def test_two_builds_in_one_process_keep_their_own_numbers(tmp_path, open_fmu):
    paths = [
        building.build("stiction-mass", tmp_path / f"{i}.fmu", start={"eta": eta, "h0": "20 um"})
        for i, eta in enumerate((0.01, 0.02))
    ]
    hosts = [open_fmu(path).start() for path in paths]
    for one in hosts:
        one.set(F_ext=40.0)
        assert one.step(2e-3) == OK
    thin, thick = (one.get("t_release") for one in hosts)
    assert 0.0 < thin < 0.9 * thick


def test_baked_values_are_checked(tmp_path):
    with pytest.raises(DescriptionError, match=r"eta.*Pa\.s"):
        building.build("stiction-mass", tmp_path / "x.fmu", start={"eta": -1.0})
    with pytest.raises(DescriptionError, match="eta"):
        building.build("stiction-mass", tmp_path / "x.fmu", start={"etta": 1.0})
    assert list(tmp_path.iterdir()) == []


def test_it_runs_where_there_is_neither_numpy_nor_scipy_nor_attrs(mass_fmu, tmp_path):
    """A host with an interpreter of its own has its own packages, often none."""
    with zipfile.ZipFile(mass_fmu) as archive:
        archive.extractall(tmp_path)
    resources = tmp_path / "resources"
    module = (resources / "slavemodule.txt").read_text().strip()
    script = f"""
import sys
blocked = ("numpy", "scipy", "attrs", "attr", "cattrs", "tqdm", "matplotlib")
class Block:
    def find_spec(self, name, path=None, target=None):
        if name.split(".")[0] in blocked and "vendor" not in " ".join(map(str, sys.path)):
            raise ImportError(name)
        if name.split(".")[0] in ("numpy", "scipy", "cattrs", "tqdm", "matplotlib"):
            raise ImportError(name)
sys.meta_path.insert(0, Block())
sys.path.insert(0, {str(resources)!r})
slave = __import__({module!r}).StictionMass(instance_name="bare", resources={str(resources)!r})
slave.setup_experiment(0.0)
slave.enter_initialization_mode()
slave.values["F_ext"] = 40.0
slave.exit_initialization_mode()
assert slave.do_step(0.0, 1e-3), slave.failure
print(slave.values["h"], "numpy" in sys.modules)
"""
    done = subprocess.run(
        [sys.executable, "-I", "-S", "-c", script], capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    gap, has_numpy = done.stdout.split()
    assert float(gap) > 5e-6
    assert has_numpy == "False"


def test_a_slave_in_python_gives_the_numbers_of_the_fmu(host):
    direct = StictionMass(instance_name="direct")
    direct.setup_experiment(0.0)
    direct.enter_initialization_mode()
    direct.exit_initialization_mode()
    host.start()
    host.set(F_ext=40.0)
    direct.values["F_ext"] = 40.0
    for i in range(5):
        assert host.step(1e-4, i * 1e-4) == OK
        assert direct.do_step(i * 1e-4, 1e-4)
        assert host.get("h") == direct.values["h"]


def test_a_scene_the_fmu_cannot_hold_is_refused(film_scene):
    with pytest.raises(PlanError, match=r"with a mass \[kg\]"):
        mass_values(film_scene())


# Scene and parameters --------------------------------------------------------------------------


def held_scene():
    """A scene whose numbers are all parameters of the FMU, but those of its pull."""
    flat = ck.Flat(radius=1.5e-3)
    return ck.SeparationScene(
        interface=ck.Interface(
            lower=flat,
            upper=flat,
            meniscus=ck.Meniscus(
                liquid=ck.Liquid(name="oil", viscosity=0.07, surface_tension=0.031),
                volume=1.1e-11,
                contact_angle_lower=0.21,
                contact_angle_upper=0.34,
                count=3,
                rewetting=0.6,
            ),
        ),
        loading=ck.ImposedForce(
            force=40.0,
            mass=0.017,
            stiffness=4e3,
            initial_speed=1e-4,
            initial_gap=6e-6,
            final_gap=2e-4,
            rest_gap=4e-6,
        ),
        effects=(
            ck.MeniscusForce(profile="arc"),
            ck.ViscousForce(),
            ck.TensionLimit(strength=2e5, cavity="truncated"),
            ck.ShearLimit(strength=3e6),
            ck.Rupture(gap=9e-5),
        ),
    )


def numbers_of(owner, path=()):
    """Paths of the numbers of a scene."""
    for part in attrs.fields(type(owner)):
        value, name = getattr(owner, part.name), (*path, part.name)
        if isinstance(value, tuple):
            for i, one in enumerate(value):
                if attrs.has(type(one)):
                    yield from numbers_of(one, (*name, i))
        elif attrs.has(type(value)):
            yield from numbers_of(value, name)
        elif isinstance(value, float | int):
            yield name


def changed(owner, path, change):
    """Scene with one of its numbers changed."""
    if not path:
        return change(owner)
    first, *rest = path
    if isinstance(first, int):
        return (*owner[:first], changed(owner[first], rest, change), *owner[first + 1 :])
    return attrs.evolve(owner, **{first: changed(getattr(owner, first), rest, change)})


PULL = {"force", "rise_time", "time_limit"}


SLIP = {"slip_length_lower", "slip_length_upper"}  # 0 in that scene


NUMBERS = [path for path in numbers_of(held_scene()) if path[-1] not in PULL | SLIP]


@pytest.mark.parametrize("path", NUMBERS, ids=str)
def test_every_number_of_a_scene_arrives(path):
    """In a parameter, and from there in the scene that the FMU plans."""
    scene = held_scene()
    other = changed(scene, path, lambda x: x + 1 if isinstance(x, int) else 0.99 * x)
    values = mass_values(other)
    if path[-1] in ("temperature", "ambient_pressure"):
        assert values == mass_values(scene)  # of a constant liquid with a tension of its own
        return
    assert values != mass_values(scene)
    again = scene_of({p.name: p.read(values.get(p.name, p.start)) for p in PORTS})
    assert mass_values(again) == values


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"pressure": -1e4, "volume": None}, "interface.meniscus.pressure = None, not -10000.0"),
        ({"effects": ck.VanDerWaalsForce(hamaker_constant=1e-19)}, "has no VanDerWaalsForce"),
        ({"drop": ck.ViscousForce}, "always ViscousForce"),
        ({"effects": ck.Rupture(gap="zero-neck")}, "Rupture"),
        ({"loading": ck.ImposedForce(force=1.0, initial_gap=6e-6, final_gap=2e-4)}, "a mass"),
        ({"effects": ck.TensionLimit(cavity="reynolds")}, "TensionLimit.cavity = 'truncated', not"),
        ({"effects": ck.MeniscusForce(profile=ck.AsPublished(pulled="upper"))}, "pulled = 'lower'"),
    ],
)
def test_what_the_parameters_do_not_hold_is_refused(changes, message):
    scene = held_scene()
    added = (changes["effects"],) if "effects" in changes else ()
    dropped = (changes.get("drop"), *map(type, added))
    kept = tuple(e for e in scene.effects if type(e) not in dropped)
    meniscus = {k: changes[k] for k in ("pressure", "volume") if k in changes}
    interface = attrs.evolve(scene.interface, meniscus=attrs.evolve(scene.meniscus, **meniscus))
    loading = changes.get("loading", scene.loading)
    scene = attrs.evolve(scene, interface=interface, loading=loading, effects=(*kept, *added))
    with pytest.raises(PlanError) as caught:
        mass_values(scene)
    assert message in str(caught.value)
    assert "--native" in str(caught.value)


def test_the_pressure_around_limits_a_liquid_that_boils():
    scene = held_scene()
    kept = tuple(e for e in scene.effects if not isinstance(e, ck.TensionLimit))
    boils = ck.TensionLimit(strength="vapour", ambient_pressure=5e4, cavity="truncated")
    assert mass_values(attrs.evolve(scene, effects=(*kept, boils)))["dp_cav"] == 5e4


def test_messages_name_the_parameters_of_the_fmu():
    slave = StictionMass(instance_name="direct")
    said = {
        "loosen Accuracy.time_rtol or raise Accuracy.max_steps": "loosen rtol or raise max_steps",
        "give loading.rest_gap [m], where they carry": "give h_min [m], where they carry",
        "ImposedForce.final_gap must exceed 1 m": "h_rel must exceed 1 m",
        "Liquid.viscosity must be positive": "eta must be positive",
    }
    for text, expected in said.items():
        assert slave._explain(ConvergenceError(text)) == expected
