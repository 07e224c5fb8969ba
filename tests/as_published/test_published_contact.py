"""`ck.published` of chapter 2 and Appendix A: hardness, datum, autocorrelation, film, stress."""

import math

import numpy as np
import pytest
from published_case import NM, ask

import contactkit as ck


def hardness(number, u, *values, **more):
    """Eq. (2.41) of layers of 1 nm of equal moduli, of these hardnesses, over that of the last."""
    names = ["hardness", "hardness_below", "hardness_substrate"][: len(values)]
    given = dict(zip(names, [value * 1e9 for value in values], strict=True))
    found = ask(number, displacement=u * NM, **given, **{"datum": 0.0} | more)
    return found.value / 1e9, found.corrected / 1e9


def fit(u, ratio):
    """Eq. (2.41), written again."""
    m, p = (1.1, 0.1) if ratio > 1.0 else (1.8, 1.0)
    return 1.0 + (ratio - 1.0) * math.exp(-(u**m) * ratio**p)


@pytest.mark.parametrize(("ratio", "jump"), [(2.0, -0.12), (0.5, 0.06)])
def test_the_rule_of_one_layer_jumps_and_the_corrected_one_does_not(ratio, jump):
    (before, smooth), (after, same) = (hardness("2.41a", u, ratio, 1.0) for u in (0.2999, 0.3))
    assert before == pytest.approx(ratio)
    assert after == pytest.approx(fit(0.3, ratio))
    assert after / before - 1.0 == pytest.approx(jump, abs=0.006)
    assert same == pytest.approx(smooth, rel=1e-12)
    found = ask("2.41", displacement=0.3 * NM, hardness=ratio * 1e9, hardness_below=1e9)
    assert found.value == found.corrected == pytest.approx(1e9 * after)
    assert not found.erratum


@pytest.mark.parametrize(
    ("layers", "after"), [((2, 2, 1), 1.752), ((1, 0.5, 1), 0.528), ((1, 2, 1), 1.752)]
)
def test_two_layers_forget_the_top_one(layers, after):
    """As the errata state, in units of H3."""
    assert hardness("2.41b", 0.2999, *layers)[0] == pytest.approx(layers[0])
    assert hardness("2.41b", 0.3, *layers)[0] == pytest.approx(after, abs=5e-4)
    assert hardness("2.41b", 0.3, *layers)[1] == pytest.approx(layers[0])


def test_the_datum_of_the_source_decides_on_which_side_of_the_jump_a_displacement_is():
    datum = ask("zero wavenumber", mean_pressure=1e-5 * 1e11).value
    assert 0.1 * NM < datum < 0.3 * NM
    without, with_it = (hardness("2.41b", 0.2, 1, 0.5, 1, datum=d) for d in (0.0, datum))
    assert without[0] == pytest.approx(1.0)
    assert with_it[0] < 0.6
    assert without[1] == with_it[1]  # which counts from the mean of the surface


def test_mean_displacement_of_a_cell():
    """0.08 nm on 20 um at 4e-6 E3; the mean of 1/alpha over a square, by polar coordinates."""
    found = ask("zero wavenumber", mean_pressure=4e5)
    turn = np.linspace(0.0, math.pi / 4.0, 100_001)
    rays = 1.0 / np.cos(turn)
    integral = 8.0 * float(np.sum(0.5 * (rays[1:] + rays[:-1]) * np.diff(turn)))
    exact = 2.0 / (1e11 / 0.91) * integral * (math.pi / 20e-6) / (2.0 * math.pi / 20e-6) ** 2
    assert found.corrected == pytest.approx(4e5 * exact, rel=1e-9)
    assert found.corrected == pytest.approx(0.08 * NM, rel=0.03)
    assert found.relative_error == pytest.approx(-0.085, abs=5e-4)


def variances(beta, kind, n=32):
    """Power spectrum on a window of 1 of the autocorrelation as printed or corrected."""
    x = np.arange(n) / n
    given = {"rms": 1.0, "correlation_length_x": beta, "correlation_length_y": beta, "period": 1.0}
    quarter = n // 2 + 1
    values = np.array(
        [
            [getattr(ask("2.42", offset_x=a, offset_y=b, **given), kind) for a in x[:quarter]]
            for b in x[:quarter]
        ]
    )
    even = np.minimum(np.arange(n), n - np.arange(n))
    return np.fft.fft2(values[even][:, even]).real / n**2


@pytest.mark.parametrize("beta", [0.1, 0.9])
def test_nearest_images_have_negative_variances_and_the_sum_over_all_has_none(beta):
    printed, corrected = (variances(beta, kind) for kind in ("value", "corrected"))
    assert (printed.min() < -1e-7) == (beta == 0.9)
    assert corrected.min() > -1e-12
    # Heights of zero mean; at the origin the aliases of the grid leave a little.
    assert abs(corrected[0, 0]) < 0.05 * printed[0, 0]


def test_the_autocorrelation_falls_to_a_tenth_over_its_length():
    plane = {"period": math.inf, "rms": 2.0, "offset_y": 0.0}
    found = ask("2.42", offset_x=5e-6, **plane)
    assert found.value == found.corrected == pytest.approx(4.0 * math.exp(-2.3))
    across = ask("2.42", offset_x=0.0, **plane | {"offset_y": 2e-6})
    assert across.value == pytest.approx(found.value)


def test_the_film_force_is_that_of_bridges_but_for_their_rims():
    """Classical limit of a ball; a cylinder of liquid pulls with pi x gamma, printed is nothing."""
    radius, height = 1e-3, 1 * NM
    ball = {"meniscus_area": 2 * math.pi * radius * height, "meniscus_height": height, "number": 1}
    found = ask("2.43", **ball)
    assert found.value == pytest.approx(2 * math.pi * radius * 0.072, rel=1e-12)
    assert found.corrected == pytest.approx(found.value, rel=1e-2)
    upright = dict.fromkeys(("angle_lower", "angle_upper"), math.pi / 2)
    found = ask("2.43", **upright, meniscus_area=1e-14, number=4)
    assert abs(found.value) < 1e-20
    x = math.sqrt(1e-14 / (4 * math.pi))
    assert found.corrected == pytest.approx(4 * math.pi * x * 0.072, rel=1e-9)


def test_many_small_menisci_of_an_area_pull_harder_by_their_rims():
    one, many = (ask("2.43", number=n, meniscus_area=1e-12) for n in (1, 400))
    assert one.value == many.value
    assert one.corrected < many.corrected


def test_stress_measures():
    tension = dict.fromkeys((f"stress_{ij}" for ij in ("yy", "zz", "xy", "xz", "yz")), 0.0)
    found = ck.published("A.1", stress_xx=3e8, **tension)
    assert found.value * math.sqrt(3.0) == pytest.approx(found.corrected) == pytest.approx(3e8)
    shear = tension | {"stress_xx": 0.0, "stress_xz": 2e8}
    found = ck.published("A.2", **shear)
    assert found.value == 0.0
    assert found.corrected == pytest.approx(2e8)
    assert found.erratum
    free = ask("A.2", stress_zz=-1e9, stress_xz=0.0, stress_yz=0.0)
    assert free.value == pytest.approx(free.corrected, rel=1e-12)


@pytest.mark.parametrize(
    ("number", "changed", "message"),
    [
        ("2.41b", {"datum": -1e-9}, r"datum must be zero or positive.*\[m\], got -1e-09"),
        ("2.42", {"period": 1e-6}, r"period must exceed correlation_length_x = 5e-06 \[m\]"),
        ("A.1", {"stress_xx": math.inf}, r"stress_xx must be a finite number \[Pa\], got inf"),
    ],
)
def test_refusals(number, changed, message):
    with pytest.raises(ck.DescriptionError, match=message):
        ask(number, **changed)
