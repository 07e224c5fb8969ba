"""Size of the normal displacement that partial slip leaves out, against F12 over C of a wave."""

from __future__ import annotations

import numpy as np
import pytest

import contactkit as ck
from contactkit.elasticity.layered import compliance
from contactkit.elasticity.stress import tractions

pytestmark = pytest.mark.filterwarnings("ignore::contactkit.ValidityWarning")

SIDE, COUNT, MU = 1e-6, 16, 0.3
SLIDING = (ck.TangentialStep(ratio=1.0),)
GLASS = ck.Material(young_modulus=1e9, poisson_ratio=0.3)
COMPACT = ck.Material(young_modulus=1e9, poisson_ratio=0.5)
SOFT = ck.Material(young_modulus=2e8, poisson_ratio=0.1)


def film(material):
    return ck.Stack(layers=(ck.Layer(material=material, thickness=8e-8),), substrate=GLASS)


def pressed_wave(lower, upper=None, mu=MU, path=SLIDING, amplitude=1e-9, direction=0.0):
    """A wave along x that is pressed flat: the pressure is a mean and one wave."""
    wave = np.cos(2.0 * np.pi * np.arange(COUNT) / COUNT)
    surface = ck.Heights(heights=np.tile(amplitude * wave, (8, 1)), pixel_size=SIDE / COUNT)
    scene = ck.ContactScene(
        interface=ck.Interface(
            lower=ck.Body(solid=lower), upper=ck.Body(solid=upper, surface=surface)
        ),
        window=ck.Window(periodic=True),
        loading=ck.Pressing(pressure=2e7),
        effects=(
            ck.LayeredHalfSpace(),
            ck.PartialSlip(coefficient=mu, path=path, direction=direction),
        ),
    )
    return ck.solve(ck.plan(scene, ck.Accuracy(rtol=1e-10)))


def neglected(result):
    (number,) = [one for one in result.validity if "coupling" in one.name]
    return number.value


def of_the_wave(lower, upper=None):
    """mu |F12 - F12'|/(C + C') of the wave [-]."""
    wave = np.array([2.0 * np.pi / SIDE])
    found = []
    for body in (lower, upper):
        if body is None:
            found.append((0.0, 0.0))
            continue
        stack = body if isinstance(body, ck.Stack) else ck.Stack(substrate=body)
        made = compliance(wave, stack.young_moduli, stack.poisson_ratios, stack.thicknesses)
        found.append((float(made.F12[0]), float(made.C[0])))
    (f12, f), (g12, g) = found
    return MU * abs(f12 - g12) / (f + g)


PAIRS = {
    "glass": (GLASS, None),
    "film": (film(SOFT), None),
    "compact film": (film(COMPACT), None),
    "two": (GLASS, film(SOFT)),
    "two turned over": (film(SOFT), GLASS),
}


@pytest.mark.parametrize("pair", PAIRS.values(), ids=PAIRS)
def test_the_wave_of_a_layered_body(pair):
    assert neglected(pressed_wave(*pair)) == pytest.approx(of_the_wave(*pair), rel=1e-8)


def test_on_a_half_space_it_is_the_coefficient_times_dundurs_beta():
    assert of_the_wave(GLASS) == pytest.approx(MU * 0.4 / 1.4, rel=1e-12)


def test_under_a_compact_film_the_substrate_is_felt():
    """The materials at the surface alone would promise none."""
    assert of_the_wave(film(COMPACT)) > 0.01


def test_equal_bodies_have_none_and_are_not_transformed(monkeypatch):
    def called(*_, **__):
        raise AssertionError

    monkeypatch.setattr(tractions, "compliance", called)
    assert neglected(pressed_wave(film(SOFT), film(SOFT))) == 0.0
    assert neglected(pressed_wave(GLASS, mu=0.0)) == 0.0


def test_incompressible_bodies_have_none():
    assert neglected(pressed_wave(COMPACT)) < 1e-12


def test_flat_surfaces_displace_nothing_but_round_off():
    assert neglected(pressed_wave(GLASS, amplitude=0.0)) < 1e-3


def test_across_the_wave_tractions_displace_nothing_along_the_normal():
    assert neglected(pressed_wave(GLASS, direction=0.5 * np.pi)) < 1e-10


def test_it_is_that_of_the_largest_tractions_of_the_path():
    there_and_back = (*SLIDING, ck.TangentialStep(ratio=0.0))
    once = neglected(pressed_wave(GLASS))
    assert neglected(pressed_wave(GLASS, path=there_and_back)) == pytest.approx(once, rel=1e-9)
    half = neglected(pressed_wave(GLASS, path=(ck.TangentialStep(ratio=0.5),)))
    assert half < 0.9 * once


def test_a_large_one_warns():
    (number,) = [one for one in pressed_wave(GLASS, mu=1.0).validity if "coupling" in one.name]
    assert number.is_valid is False
