"""Theories of the real area of contact: limits, integrals, and solved contacts beside them."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import quad

import contactkit as ck
from contactkit.analyses.area_over_load import area_over_load
from contactkit.errors import DescriptionError
from contactkit.roughness import contact_theories as theories
from contactkit.roughness.random_surfaces import SelfAffineSpectrum, self_affine
from contactkit.roughness.statistics import Summits

SUMMITS = Summits(density=2e14, mean_height=1e-9, rms_height=1.5e-9, radius=4e-8, number=50)
SOLID = ck.Material(young_modulus=1e9, poisson_ratio=0.0)  # E* = 1e9 Pa


def test_the_values_of_the_notes():
    p = np.array([0.05, 0.2, 0.5])
    np.testing.assert_allclose(
        theories.persson_area(p * 1e8, 1e9, 0.1),
        [0.07965567455405798, 0.31084348322064836, 0.682689492137086],
        rtol=1e-13,
    )
    np.testing.assert_allclose(
        theories.interpolated_area(p * 1e8, 1e9, 0.1),
        [0.09973881631072792, 0.38385804725970746, 0.7899085945560627],
        rtol=1e-13,
    )
    tiny = 1e-7
    assert theories.bush_gibson_thomas(tiny, 1.0, 1.0) / tiny == pytest.approx(2.50662827463)
    assert theories.persson_area(tiny, 1.0, 1.0) / tiny == pytest.approx(1.5957691216057308)
    assert theories.interpolated_area(tiny, 1.0, 1.0) / tiny == pytest.approx(2.0)


@pytest.mark.parametrize("mean", [0.01, 0.3, 2.0])
def test_the_pressures_of_persson_carry_the_load(mean):
    density = [
        quad(lambda p, n=n: p**n * theories.persson_pressures(p, mean, 1.0, 0.7), 0.0, mean + 6.0)[
            0
        ]
        for n in (0, 1)
    ]
    assert density[0] == pytest.approx(float(theories.persson_area(mean, 1.0, 0.7)), rel=1e-9)
    assert density[1] == pytest.approx(mean, rel=1e-9)


@pytest.mark.parametrize("t", [-3.0, 0.0, 1.0, 3.0])
def test_summits_are_integrals_over_their_heights(t):
    found = theories.greenwood_williamson(t * SUMMITS.rms_height, 2e9, SUMMITS)

    def mean(n):
        density = 1.0 / math.sqrt(2.0 * math.pi)
        return quad(lambda s: s**n * density * math.exp(-0.5 * (s + t) ** 2), 0.0, 15.0)[0]

    sigma, radius, count = SUMMITS.rms_height, SUMMITS.radius, SUMMITS.density
    assert found.fraction == pytest.approx(math.pi * count * radius * sigma * mean(1.0), rel=1e-8)
    force = 4.0 / 3.0 * 2e9 * math.sqrt(radius) * sigma**1.5 * mean(1.5)
    assert found.pressure == pytest.approx(count * force, rel=1e-8)
    again = theories.greenwood_williamson_area(found.pressure, 2e9, SUMMITS)
    assert again == pytest.approx(float(found.fraction), rel=1e-9)


def test_impossible_loads_and_summits_are_refused():
    with pytest.raises(DescriptionError, match="pressure"):
        theories.greenwood_williamson_area(-1.0, 1e9, SUMMITS)
    with pytest.raises(DescriptionError, match="pressure"):
        theories.greenwood_williamson_area(1e30, 1e9, SUMMITS)
    with pytest.raises(DescriptionError, match="rms_height"):
        theories.greenwood_williamson_area(1.0, 1e9, SUMMITS._replace(rms_height=0.0))


# Solved contacts ----------------------------------------------------------------------------


def heights(n=64):
    spectrum = SelfAffineSpectrum(0.8, n / 4 * 1e-9, 8e-9)
    return self_affine((n, n), (1e-9, 1e-9), None, spectrum, 3, "sample", rms_slope=0.1)


@pytest.mark.slow  # 1 to 2 s
@pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning")
def test_solved_areas_lie_between_the_theories_and_meet_persson_at_full_contact():
    surface = heights()
    loads = [x * 1e8 for x in (1.4, 0.02, 0.2)]
    found = area_over_load([ck.press(surface, 1e-9, SOLID, p, rtol=1e-6) for p in loads])
    assert (np.diff(found.mean_pressure) > 0.0).all()
    np.testing.assert_allclose(found.reduced_pressure, [0.02, 0.2, 1.4], rtol=1e-9)
    assert (found.theories["Persson"][:2] < found.corrected[:2]).all()
    assert found.corrected[1] < found.theories["Bush, Gibson and Thomas"][1]
    assert (found.corrected[:2] < found.counted[:2]).all()
    assert found.corrected[2] == pytest.approx(found.theories["Persson"][2], rel=0.01)
    assert found.corrected[1:] == pytest.approx(found.theories["fit of slope 2"][1:], rel=0.1)
    for name, (low, high, error) in theories.RANGES.items():
        assert 0.0 <= low < high <= 1.0, name
        assert error


@pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning")
def test_a_theory_ends_where_it_holds(tmp_path):
    surface = heights(32)
    found = area_over_load([ck.press(surface, 1e-9, SOLID, x * 1e8) for x in (0.02, 0.2, 1.4)])
    assert found.ranges == {name: theories.RANGES[name] for name in found.theories}
    small = found.theories["Bush, Gibson and Thomas"]
    assert small[:2] == pytest.approx(math.sqrt(2.0 * math.pi) * np.array([0.02, 0.2]), rel=1e-9)
    assert math.isnan(small[2])  # 3.5 of the area
    for name, fractions in found.theories_in_range.items():
        low, high, _ = theories.RANGES[name]
        kept = ~np.isnan(fractions)
        assert ((low <= fractions[kept]) & (fractions[kept] <= high)).all()
        np.testing.assert_array_equal(fractions[kept], found.theories[name][kept])
    persson = found.theories_in_range["Persson"]
    assert np.isnan(persson).tolist() == [True, True, False]
    read = ck.read_curve(found.save(tmp_path / "area"))  # a curve like every other
    assert (read.axis, read.sources) == ("mean_pressure", found.sources)
    np.testing.assert_array_equal(read["persson"], found.theories["Persson"])
    assert read.scalars()["rms_slope"] == (found.statistics.rms_slope, "-")
    assert found.plot.available[-1] == "area"


@pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning")
def test_other_contacts_have_no_theory_beside_them():
    surface = heights(32)
    one = ck.press(surface, 1e-9, SOLID, 1e6)
    layered = ck.Stack(layers=(ck.Layer(material=SOLID, thickness=1e-8),), substrate=SOLID)
    for other, message in (
        ([], "one contact or more"),
        (one, r"be a sequence, .*area_over_load\(\[result\]\)"),
        (3, "be a sequence of ContactResult"),
        ([one, 3], "be contacts, ContactResult, got 3"),
        ([one, ck.press(2.0 * surface, 1e-9, SOLID, 1e6)], "one surface"),
        ([ck.press(surface, 1e-9, layered, 1e6)], "half-spaces"),
        ([ck.press(surface, 1e-9, SOLID, 0.0)], "load"),
    ):
        with pytest.raises(DescriptionError, match=message):
            area_over_load(other)
