"""Each validator of a field, once: what it takes, what it refuses, and in which words."""

from __future__ import annotations

import math

import attrs
import pytest
from refusals import ANGLE, BETWEEN, FINITE, NON_NEGATIVE, POSITIVE, WHOLE, misfits, refuses

from contactkit import validators
from contactkit.validators import as_pair, as_tuple, choice, optional, part

pytestmark = pytest.mark.errors

# Validator, what it takes, what it refuses beside what is never a number, and its words.
NUMBERS = [
    (validators.finite, [0, -1.5, 1e60], [None], FINITE),
    (validators.positive, [1, 5e-324], [0, 0.0, -1.0, None], POSITIVE),
    (validators.non_negative, [0, 0.0, 1.0], [-5e-324, None], NON_NEGATIVE),
    (validators.fraction, [0.0, 0.5, 1], [-0.1, 1.0 + 1e-15, None], BETWEEN),
    (validators.angle, [0.0, math.pi], [-0.1, 181.0, None], ANGLE),
    (validators.count, [1, 10**20], [0, -1, 1.0, 2.5, None], WHOLE),
    (optional(validators.positive), [None, 1.0], [0.0, -1.0], POSITIVE),
]


def holder(check):
    """A class with one field, which a validator checks."""
    field = attrs.field(validator=check, metadata={"unit": "m"})
    return attrs.make_class("Holder", {"field": field}, frozen=True)


@pytest.mark.parametrize(("check", "taken", "refused", "expected"), NUMBERS)
def test_a_validator_takes_what_it_says_and_nothing_else(check, taken, refused, expected):
    kind = holder(check)
    assert [kind(value).field for value in taken] == taken
    assert misfits([(kind(taken[-1]), "field", "m", expected, refused)]) == {}


@pytest.mark.parametrize("check", [validators.finite, validators.positive, validators.non_negative])
@pytest.mark.parametrize("value", [1.1e60, 1e300])
def test_a_number_without_a_meaning_is_refused(check, value):
    words = f"Holder.field must be at most 1e+60 in size [m], got {value!r}; no quantity in SI"
    refuses(lambda: holder(check)(value), words)


def test_a_size_counts_without_its_sign():
    refuses(lambda: holder(validators.finite)(-1e300), "must be at most 1e+60 in size [m], got -1e")


def test_degrees_are_suspected():
    hint = "; was it meant in degrees? then write 60*deg, or '60 deg' in a file"
    refuses(lambda: holder(validators.angle)(60), f"{ANGLE} [m], got 60{hint}")


def test_a_choice_names_the_words_it_knows():
    kind = holder(choice("one", "two"))
    assert kind("two").field == "two"
    refuses(lambda: kind("three"), "Holder.field must be one of 'one', 'two'", "got 'three'")


def test_a_part_names_the_kinds_it_takes():
    kind = holder(part(int, str))
    assert kind(3).field == 3
    refuses(lambda: kind(3.0), "Holder.field must be a int or str", "got 3.0")


def test_collections_become_tuples_and_single_things_too():
    assert as_tuple([1, 2]) == (1, 2)
    assert as_tuple(3) == (3,)
    assert (as_pair([1, 2]), as_pair(3)) == ((1, 2), 3)
