"""Whatever a host does to an FMU, the host lives, hears why, and gets a good FMU by a reset.

`probe.py` does it, in a process for each FMU; here its findings are judged. The library of
pythonfmu alone does not outlive the hard cases, which is what the guard in our FMUs is for.
"""

from __future__ import annotations

import re
import shutil
import sys

import pytest
from selection import quick

pytest.importorskip("pythonfmu")
pytest.importorskip("fmpy")
if not sys.platform.startswith("linux"):
    pytest.skip("the probe knows the names of libraries on Linux only", allow_module_level=True)

import probe
from probe_fmus import (
    ALL,
    NATIVES,
    build_one,
    end_probe,
    specification,
    start_probe,
    unpack,
)

from contactkit.fmu.python.guard import can_guard

pytestmark = pytest.mark.slow

OK, DISCARD, ERROR = 0, 2, 3
SOFT = [one.__name__ for one in probe.CASES]
HARD = [one.__name__ for one in probe.HARD]
CURE = re.compile(r"reset|earlier|set |take |give |keep|free some|build it|must be|must not|needs")


def hard_cases(name):
    return HARD if name in NATIVES or can_guard() else []


@pytest.fixture(scope="session")
def place(shelf):
    """Specification of an FMU by its name."""

    def find(name):
        def make(folder):
            unpack(build_one(name, folder), folder / "fmu")
            shutil.copytree(folder / "fmu", folder / "odd ü#%41 folder")

        folder = shelf.folder(f"probe {name}", make)
        return specification(name, folder / "fmu") | {"odd folder": f"{folder}/odd ü#%41 folder"}

    return find


# Of Python, whose models share the guard, those with a mass, a coil and stops: `test_fuzz_slaves`
# has them all. Of C, whose models share a library, some of each version of FMI.
FEW = {
    "stiction-mass",
    "valve-drive",
    "contact-stop",
    "stiction-mass native 2",
    "valve-drive native 3",
    "tip-contact native 3",
    "deforming-force native 2",
}
SOME = [i for i, name in enumerate(ALL) if name in FEW]


@pytest.mark.parametrize("name", quick(ALL, long=SOME))
def test_its_host_outlives_every_misuse(place, tmp_path, name):
    code, said, found = end_probe(start_probe(place(name), tmp_path, *SOFT, *hard_cases(name)))
    assert code == 0, f"{name} ended its host with {code}:\n{said}"
    assert list(found) == [*SOFT, *hard_cases(name)]
    assert found["reference"]["fine"]
    assert found["reference"]["moves"]
    assert found["reference"]["breaks"] == name.startswith("stiction")
    for one in JUDGES:
        one(found)
    for one in HARD_JUDGES if hard_cases(name) else ():
        one(found)


JUDGES, HARD_JUDGES = [], []


def judge(function):
    JUDGES.append(function)
    return function


def hard_judge(function):
    HARD_JUDGES.append(function)
    return function


def troubles(found):
    return {
        f"{case}: {name}": one
        for case, of_case in found.items()
        for name, one in of_case.get("troubles", {}).items()
    }


@judge
def trouble_is_refused_explained_and_gone_after_a_reset(found):
    """One error with its cure, none of the fatal kind, no nan, and a reset that cures."""
    found = troubles(found)
    assert len(found) > 50
    assert {name: one["fatal"] for name, one in found.items() if one["fatal"]} == {}
    assert [name for name, one in found.items() if one["worst"] not in (DISCARD, ERROR)] == []
    assert [name for name, one in found.items() if not one["finite"]] == []
    assert [name for name, one in found.items() if not one["again"]] == []
    for name, one in found.items():
        messages = [message for _, _, message in one["errors"]]
        assert len(messages) == 1, (name, messages)
        assert one["errors"][0][1] == "logStatusError", name
        assert CURE.search(messages[0]), (name, messages)
        assert "%" not in messages[0].replace("%%", ""), "a host in C reads this as a format"


@judge
def what_is_odd_but_legal_is_outlived(found):
    """Huge numbers, endless steps, changed bytes: refused or not, but no nan and no crash."""
    for case in ("huge_inputs", "huge_steps", "spoilt_states"):
        for name, one in found[case]["survived"].items():
            assert one["fatal"] == [], (case, name)
            assert one["finite"], (case, name)
            assert one["again"], (case, name)
            if one["worst"] >= DISCARD:
                assert one["errors"], (case, name)


@judge
def initialized_and_ended_twice(found):
    assert max(found["twice"]["ends"]) <= ERROR
    assert found["twice"]["finite"]
    assert found["twice"]["again"]


@judge
def steps_of_nothing_change_nothing(found):
    assert found["steps_of_nothing"] == {"statuses": [OK] * 4, "same": True}


@judge
def reset_and_values_in_every_phase(found):
    assert found["reset_in_every_phase"]["again"], found["reset_in_every_phase"]
    assert found["get_before_initialization"]["finite"], found["get_before_initialization"]


@judge
def instances_do_not_disturb_each_other(found):
    """Each gives the same bits as one alone, in turn and in threads."""
    assert found["twenty_instances"]["same"]
    assert found["threads"]["same"]


@judge
def states_lead_back_across_the_rupture(found):
    """Bit for bit: here, as bytes elsewhere, after the end, and of another instance."""
    found = found["states_across_the_run"]
    assert set(found["statuses"]) == {OK}
    assert found["same"]
    assert found["elsewhere"]
    assert found["after the end"]
    assert found["of another"]
    # Half of it is where the film has cavitated; rings have 24 bytes each besides.
    assert 0 < found["size"] < 13_000


@judge
def silence(found):
    said = found["silence"]["said"]
    assert {(status, category) for status, category, _ in said} <= {(ERROR, "logStatusError")}
    assert said or not can_guard()  # pythonfmu alone keeps even this to itself
    assert found["silence"]["worst"] in (DISCARD, ERROR)
    assert found["silence"]["again"]


@judge
def calls_in_no_order(found):
    assert found["anything"] == {"fatal": [], "finite": True, "again": True}


# what pythonfmu alone does not outlive -------------------------------------------------------


@hard_judge
def what_does_not_fit_is_not_instantiated(hard):
    found = hard["no_instance"]
    assert found.pop("again")
    for name, one in found.items():
        assert one["none"], name
        assert len(one["errors"]) == 1, (name, one)
    assert hard["nameless"]["none"] == [True] * 3


@hard_judge
def what_is_no_instance_is_an_error(hard):
    for case in ("used_after_free", "no_instance_at_all", "foreign_pointer"):
        assert set(hard[case]["statuses"]) == {ERROR}, case
    assert hard["freed_twice"] == {}


@hard_judge
def missing_arguments_are_errors(hard):
    for case in ("null_arguments", "null_states", "wrong_counts"):
        assert set(hard[case]["statuses"]) == {ERROR}, case
        assert hard[case]["again"], case


@hard_judge
def a_state_freed_twice_is_gone_once(hard):
    found = hard["state_freed_twice"]
    assert (found["first"], found["again"]) == (OK, True)
    assert found["statuses"][0] in (OK, ERROR)
    assert found["statuses"][1] == ERROR


@hard_judge
def a_state_in_place_of_its_address_is_recognised(hard):
    found = hard["state_in_place_of_its_address"]
    assert found == {"freed": [OK, OK], "statuses": [ERROR] * 3, "again": True}


@hard_judge
def odd_paths_and_deaf_hosts(hard):
    """A path with a blank, an umlaut, # and %; and no function to log with."""
    assert hard["odd_path"]["same"]
    assert hard["deaf"]["again"]


@pytest.mark.skipif(not can_guard(), reason="without a compiler there is no guard to take away")
@pytest.mark.parametrize("case", ["freed_twice", "odd_path", "null_arguments"])
def test_without_the_guard_the_host_is_gone(place, tmp_path, case):
    """What docs/hosts.md says of pythonfmu; once it is untrue the guard can go."""
    spec = place("stiction-mass")
    bare = spec | {"library": spec["folder"] + "/binaries/linux64/pythonfmu.so"}
    code, said, _ = end_probe(start_probe(bare, tmp_path, case))
    assert code < 0, said


# side by side --------------------------------------------------------------------------------


def test_different_fmus_in_one_process(place, tmp_path):
    """Two instances of each, a step each in turn: all do what they do alone."""
    together = {"together": [place(name) for name in ALL]}
    code, said, found = end_probe(start_probe(together, tmp_path))
    assert code == 0, said
    assert found["same"] == [True] * 2 * len(ALL)
    assert not any(found["discarded"])
