"""Changed files give an object as it should be or a ContactkitError, nothing else."""

from __future__ import annotations

import contextlib
import functools

import pytest
from fuzz_readers import readers
from hypothesis import given
from hypothesis import strategies as st
from mutations import exchanged
from run import Finding, cases, one

import contactkit as ck
from contactkit.errors import ContactkitError
from contactkit.files.structure import structure
from contactkit.files.unstructure import unstructure
from contactkit.reading.texts import check_keys, check_plain, from_json

pytestmark = pytest.mark.filterwarnings("ignore::contactkit.ValidityWarning")

QUICK = {"scene": 30, "result": 30, "fmu": 30, "ssp": 30, "instrument": 1}
READERS = [name for name in readers() if name != "instrument"]  # which starts a process for each


@functools.cache
def reader(name):
    return readers()[name]()


def said(findings):
    return "\n\n".join(f"{one.reader} {one.name}: {one.what}" for one in findings)


@pytest.mark.parametrize("name", READERS)
def test_the_files_that_are_changed_are_valid(name):
    for file, content in reader(name).seeds.items():
        assert one(name, reader(name), file, content) == "read"


@pytest.mark.parametrize("name", READERS)
def test_a_changed_file_is_read_or_refused(name):
    found = cases(name, reader(name), 17, QUICK.get(name, 60))
    assert not found, said(found)


# Each file that is not ours, one of ours, and what starts a process for each.
MANY = ("scene", "map", "fmu", "instrument")


@pytest.mark.parametrize(
    ("name", "seed", "times"),
    [
        pytest.param(
            name,
            *more,
            marks=pytest.mark.slow if more[0] == 31 and name in MANY else pytest.mark.exhaustive,
        )
        for more in ((31, 5), (2027, 25))
        for name in readers()
    ],
)
def test_many_changed_files_are_read_or_refused(name, seed, times):
    found = cases(name, reader(name), seed, times * QUICK.get(name, 60))
    assert not found, said(found)


@given(st.binary(max_size=300))
def test_any_bytes_are_refused(content):
    for name in READERS:
        for file in list(reader(name).seeds)[:1]:
            outcome = one(name, reader(name), file, content)
            assert not isinstance(outcome, Finding), said([outcome])


# The alphabet of text(), which finds it out from the codec in two seconds.
LETTERS = st.characters(exclude_categories=("Cs",))
PLAIN = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(LETTERS, max_size=8),
    lambda inner: (
        st.lists(inner, max_size=3) | st.dictionaries(st.text(LETTERS, max_size=5), inner)
    ),
    max_leaves=12,
)


@pytest.mark.slow
@given(PLAIN, st.randoms(use_true_random=False))
def test_any_tables_become_a_scene_or_are_refused(value, dice):
    film = ck.Interface(
        lower=ck.Flat(radius=1e-3),
        upper=ck.Sphere(radius=1e-3),
        meniscus=ck.Meniscus(liquid=ck.load_liquid("water"), relative_humidity=0.5),
    )
    opening = ck.ImposedSpeed(speed=1e-3, initial_gap=1e-6, final_gap=1e-5)
    scene = ck.SeparationScene(interface=film, loading=opening, effects=(ck.MeniscusForce(),))
    for tables in (value, exchanged(unstructure(scene), dice)):
        try:
            made = structure(tables, ck.SeparationScene, "tables")
        except ContactkitError:
            continue
        assert isinstance(made, ck.SeparationScene)


@given(st.text("\"'#\\\n =.[]{},ab", max_size=60))
def test_keys_are_checked_whatever_the_quotes(text):
    check_keys(text, "scene.toml")


def test_the_time_of_a_check_of_keys_rises_with_the_length():
    for text in ('"' * 100_000, "'" * 100_000, '\\"' * 50_000, '"""' + '\\"' * 50_000, "a" * 10**6):
        check_keys(text, "scene.toml")


@given(PLAIN)
def test_plain_values_have_a_depth(value):
    with contextlib.suppress(ContactkitError):  # of an integer of more than 64 bits
        check_plain(value, "file")


@given(st.binary(max_size=100))
def test_bytes_that_are_no_json_are_refused(content):
    with contextlib.suppress(ContactkitError):
        from_json(content, "file")
