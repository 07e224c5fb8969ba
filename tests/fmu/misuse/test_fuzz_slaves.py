"""Python FMUs under random calls: `fuzz_slaves.Life` says what holds after each."""

from __future__ import annotations

import pytest

pytest.importorskip("pythonfmu")

from drive_faces import rough
from fuzz_slaves import Life, slave_class

from contactkit.fmu.contents.end_stop import bake
from contactkit.fmu.python.build import FMUS

pytestmark = [
    pytest.mark.slow,
    pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning"),
]

CALLS = 150
SEEDS = range(2)
# The film of a wet tip is prepared anew, for seconds, for each set of its parameters.
FEW = {"tip-contact": range(1)}


@pytest.fixture(scope="module")
def slaves():
    curve = {"curve": rough()}
    return {
        name: slave_class(
            name, bake(name, curve) if name in ("contact-stop", "valve-drive") else {}
        )
        for name in FMUS
    }


def lived(cls, seed, calls=CALLS):
    life = Life(cls, seed)
    try:
        life.play(calls)
    except AssertionError as error:
        raise AssertionError(f"seed {seed}: {error}; after {life.calls[-8:]}") from error
    return life


def all_lived(cls, seeds):
    return [lived(cls, seed) for seed in seeds]


@pytest.mark.parametrize("name", FMUS)
def test_whatever_a_host_calls_holds(slaves, name):
    lives = all_lived(slaves[name], FEW.get(name, SEEDS))
    assert sum(life.n_stepped for life in lives) > 10  # lives, not failures alone
    assert sum(life.n_refused for life in lives) > 0


@pytest.mark.exhaustive
@pytest.mark.parametrize("name", FMUS)
def test_many_lives(slaves, name):
    all_lived(slaves[name], range(1000, 1010 if name in FEW else 1200))


def test_a_slave_that_breaks_a_promise_is_caught(slaves):
    """An output that is no number, one out of range, a step that fails silently, a lost state."""

    class Odd(slaves["valve-drive"]):
        def advance(self, time, step):
            super().advance(time, step)
            self.values["F_spring"] = 1e400

        def _discard(self, reason):
            return False

    class Forgetful(slaves["contact-stop"]):
        def restore_hidden_state(self, hidden):
            super().restore_hidden_state(hidden)
            self.values["d_max"] *= 0.7

    for cls in (Odd, Forgetful):
        with pytest.raises(AssertionError, match="seed"):
            all_lived(cls, range(40))
