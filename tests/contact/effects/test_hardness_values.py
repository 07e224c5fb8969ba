"""Hardness of a layered solid: reference values, the source's cases, and where its rule jumps."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from contactkit.elasticity.hardness_rules import (
    effective_hardness,
    effective_hardness_literal,
    layer_on_substrate,
)
from contactkit.errors import DescriptionError

CASES = json.loads((Path(__file__).parents[2] / "data" / "hardness.json").read_text("utf-8"))
U = np.array(CASES["depth_over_thickness"])
ROUNDED = 1e-14  # a dozen roundings

each_row = pytest.mark.parametrize(
    "row", CASES["rows"], ids=lambda r: f"H{r['hardness_ratio']}-E{r['modulus_ratio']}"
)


@each_row
def test_the_fit_takes_the_values_of_the_reference(row):
    h, e = row["hardness_ratio"], row["modulus_ratio"]
    found = layer_on_substrate(U * 3e-9, e * 2e11, 2e11, h * 5e9, 5e9, 3e-9)
    np.testing.assert_allclose(found / 5e9, row["hardness_over_substrate"], rtol=ROUNDED)


@each_row
def test_one_layer_without_shift_is_the_fit(row):
    h, e = row["hardness_ratio"], row["modulus_ratio"]
    found = effective_hardness(U, [e, 1.0], [h, 1.0], [1.0], shift=0.0)
    np.testing.assert_allclose(found, row["hardness_over_substrate"], rtol=ROUNDED)


@each_row
def test_the_shift_moves_the_fit_deeper(row):
    h, e = row["hardness_ratio"], row["modulus_ratio"]
    found = effective_hardness(U + 0.3, [e, 1.0], [h, 1.0], [1.0])
    np.testing.assert_allclose(found, row["hardness_over_substrate"], rtol=1e-13)
    assert (effective_hardness([0.0, 0.15, 0.3], [e, 1.0], [h, 1.0], [1.0]) == h).all()


@each_row
def test_the_rule_of_the_source_jumps_by_what_the_reference_says(row):
    h, e = row["hardness_ratio"], row["modulus_ratio"]
    edge = np.nextafter(0.3, 0.0), 0.3
    before, after = effective_hardness_literal(edge, [e, 1.0], [h, 1.0], [1.0])
    assert before == h
    assert after / before - 1.0 == pytest.approx(row["jump"], rel=1e-12)


# The source's layered cases of equal thickness and modulus, in units of H3; physics notes, 6.1
@pytest.mark.parametrize(
    ("hardness", "before", "after"),
    [
        ([1.0, 0.5, 1.0], 1.000, 0.528),
        ([1.0, 2.0, 1.0], 1.000, 1.752),
        ([2.0, 2.0, 1.0], 2.000, 1.752),
        ([0.5, 0.5, 1.0], 0.500, 0.528),
    ],
)
def test_two_layers_forget_the_top_one_at_once(hardness, before, after):
    found = effective_hardness_literal([0.2999, 0.3], [1.0] * 3, hardness, [1.0, 1.0])
    np.testing.assert_allclose(found, [before, after], atol=5e-4)


def test_a_thick_interlayer_makes_the_rule_of_the_source_rise_and_fall():
    u = np.array([0.29, 0.3, 2.99, 3.0, 1e3])
    found = effective_hardness_literal(u, [1.0] * 3, [1.0, 0.5, 1.0], [1.0, 10.0])
    np.testing.assert_allclose(found, [1.0, 0.876, 0.514, 0.528, 1.0], atol=1e-3)


def test_three_layers_are_beyond_the_rule_of_the_source():
    with pytest.raises(DescriptionError, match=r"two layers at most, got 3; effective_hardness"):
        effective_hardness_literal(1e-9, [1.0] * 4, [1.0] * 4, [1e-9] * 3)


def test_a_solid_without_layers_has_its_hardness():
    assert effective_hardness_literal([0.0, 1.0], [1e11], [7e9], []).tolist() == [7e9, 7e9]
    assert effective_hardness([0.0, 1.0], [1e11], [7e9], []).tolist() == [7e9, 7e9]


def test_three_layers_by_hand():
    """Interfaces at 1, 3 and 6; a depth of 2 just feels the last one, from 0.3*6 on."""
    found = effective_hardness(2.0, [4.0, 2.0, 1.0, 1.0], [8.0, 4.0, 6.0, 3.0], [1.0, 2.0, 3.0])
    first = np.exp(-(1.7**1.1) * 2.0**-0.5 * 2.0**0.1)
    second = np.exp(-((2.0 / 3.0 - 0.3) ** 1.8) * 2.0**-0.9 * (2.0 / 3.0))
    third = np.exp(-((1.0 / 3.0 - 0.3) ** 1.1) * 2.0**0.1)
    by_hand = 8.0 * first + 4.0 * (second - first) + 6.0 * (third - second) + 3.0 * (1.0 - third)
    assert float(found) == pytest.approx(by_hand, rel=1e-13)
