"""Materials of the library: sources, plausible numbers, and the rules they were taken from."""

from __future__ import annotations

import re

import pytest

import contactkit as ck
from contactkit.files.structure import library_names

MATERIALS = {name: ck.load_material(name) for name in library_names("materials.toml")}


@pytest.mark.parametrize("name", MATERIALS)
def test_a_material_has_its_source_and_numbers_that_can_be(name):
    one = MATERIALS[name]
    assert len(one.source) > 15
    assert 1e5 < one.young_modulus < 1e12
    assert 0.1 < one.poisson_ratio < 0.5
    # Hardness over modulus: from 1 % (metals) to 11 % (carbon).
    assert one.hardness is None or 0.005 < one.hardness / one.young_modulus < 0.15


@pytest.mark.parametrize("name", MATERIALS)
def test_a_stated_range_holds_the_number(name):
    """The first range of moduli in a source, `a to b GPa`."""
    one = MATERIALS[name]
    stated = re.search(r"([\d.]+) to ([\d.]+) ([GM])Pa", one.source.partition("ardness")[0])
    if stated is None:
        return
    low, high = (float(stated[i]) * {"G": 1e9, "M": 1e6}[stated[3]] for i in (1, 2))
    assert low <= one.young_modulus <= high


def test_silicon_is_the_mean_of_its_cubic_constants():
    c11, c12, c44 = 165.7, 63.9, 79.6
    bulk = (c11 + 2.0 * c12) / 3.0
    stiff = (c11 - c12 + 3.0 * c44) / 5.0
    soft = 5.0 * (c11 - c12) * c44 / (4.0 * c44 + 3.0 * (c11 - c12))
    shear = 0.5 * (stiff + soft)
    silicon = MATERIALS["silicon"]
    assert silicon.young_modulus == pytest.approx(
        9e9 * bulk * shear / (3.0 * bulk + shear), rel=3e-3
    )
    ratio = (3.0 * bulk - 2.0 * shear) / (2.0 * (3.0 * bulk + shear))
    assert silicon.poisson_ratio == pytest.approx(ratio, abs=1e-3)


@pytest.mark.parametrize(("name", "shore"), [("nitrile-rubber", 70.0), ("silicone-rubber", 50.0)])
def test_rubbers_follow_gent(name, shore):
    modulus = 0.0981 * (56.0 + 7.62336 * shore) / (0.137505 * (254.0 - 2.54 * shore))
    assert MATERIALS[name].young_modulus == pytest.approx(modulus * 1e6, rel=0.03)
