"""What a refusal says, and every impossible number of a class that is not refused as it should."""

from __future__ import annotations

import math
import re
from functools import partial

import attrs
import pytest

from contactkit.errors import DescriptionError
from contactkit.validators import Described

# What no field takes for a number.
NEVER = (math.nan, math.inf, -math.inf, True, "wide", (1.0,))
ALIEN = "1 T.mol"  # a text in a unit that no field has
POSITIVE, NON_NEGATIVE = "be positive and finite", "be zero or positive, and finite"
FINITE, BETWEEN = "be a finite number", "lie between 0 and 1"
WHOLE, ANGLE = "be a whole number of at least 1", "lie between 0 and pi"


def says(*parts):
    """Match one message with all `parts` in this order."""
    return "(?s)" + ".*".join(map(re.escape, parts))


def refuses(call, *parts, error=DescriptionError):
    """Check that `call` raises one sentence with all `parts` in this order."""
    with pytest.raises(error, match=says(*parts)):
        call()


def each_refused(cases, error=DescriptionError):
    """Return the test that calls are refused, each with a message of its own.

    A case is a call, a pattern of its message and, where it is not `error`, the kind of the error.
    """
    rows = [(call, pattern, *(kind or [error])) for call, pattern, *kind in cases]

    @pytest.mark.parametrize(("call", "pattern", "kind"), rows)
    def test(call, pattern, kind):
        with pytest.raises(kind, match=pattern):
            call()

    return test


def each_change_refused(rows):
    """Return the test that objects refuse changes: each an object, its new fields, the message."""
    return each_refused(
        [(partial(attrs.evolve, thing, **change), re.escape(text)) for thing, change, text in rows]
    )


def refused_with(thing, field, value):
    """Return what an object says when it is to be rebuilt with a value: nothing if it takes it."""
    try:
        attrs.evolve(thing, **{field: value})
    except DescriptionError as error:
        return str(error)
    return ""


def misfits(rows):
    """Return the impossible values that are taken, or refused in other words, by field.

    A row is an object, one of its fields, the unit, what the message expects, and values that are
    impossible beside those of `NEVER`.
    """
    found = {}
    for thing, field, unit, expected, values in rows:
        name, bracket = f"{type(thing).__name__}.{field}", f" [{unit}]" if unit else ""
        for value in (*values, *NEVER):
            message = f"{name} must {expected}{bracket}, got {value!r}"
            if message not in refused_with(thing, field, value):
                found.setdefault(name, []).append((value, refused_with(thing, field, value)))
        message = f".{field} must be in a unit that converts to {unit or '-'}, got {ALIEN!r}"
        reads_texts = isinstance(thing, Described)
        if reads_texts and message not in refused_with(thing, field, ALIEN):
            found.setdefault(name, []).append((ALIEN, refused_with(thing, field, ALIEN)))
    return found


def numbers_of(kinds):
    """Fields of classes that carry a unit, by class and name."""
    return {(kind.__name__, a.name) for kind in kinds for a in attrs.fields(kind) if _has_unit(a)}


def _has_unit(field):
    return "unit" in field.metadata


def named(rows):
    """The same of the rows of a table."""
    return {(type(row[0]).__name__, row[1]) for row in rows}
