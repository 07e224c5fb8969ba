"""Waves pressed on solids: Westergaard, Johnson-Greenwood-Higginson, layers, full contact."""

from __future__ import annotations

import math

import numpy as np
import pytest

import contactkit as ck
from contactkit.benchmarks.references.tables import reference
from contactkit.reference import layered_wave, product_wave, westergaard

pytestmark = pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning")

CASES = reference("contact")
WAVES, LAYERED = CASES["waves"]["homogeneous"], CASES["waves"]["layered"]
NU = 0.3
UNIT = ck.Material(young_modulus=1.0 - NU**2, poisson_ratio=NU)  # E* = 1 [Pa]
COATED = ck.Stack(
    layers=tuple(
        ck.Layer(material=ck.Material(young_modulus=e, poisson_ratio=NU), thickness=h)
        for e, h in LAYERED[0]["layers"]
    ),
    substrate=UNIT,
)
MODULI = ([m.young_modulus for m in COATED.materials], [NU, NU], list(COATED.thicknesses))


def wave_scene(pressure, *effects, solid=UNIT, upper=None, wavelength_y=None, **window):
    crest = ck.Wave(amplitude=1.0, wavelength=1.0, wavelength_y=wavelength_y)
    return ck.ContactScene(
        interface=ck.Interface(
            lower=ck.Body(solid=solid), upper=ck.Body(surface=crest, solid=upper)
        ),
        window=ck.Window(width=1.0, **window),
        loading=ck.Pressing(pressure=pressure),
        effects=(ck.LayeredHalfSpace(), *effects),
    )


def strip(pressure, n, rtol=1e-8, **given):
    """A wave along x, on n pixels to its length and two across."""
    scene = wave_scene(pressure, height=2.0 / n, **given)
    return ck.solve(ck.plan(scene, ck.Accuracy(grid=(2, n), rtol=rtol)))


ROOT_2_PI = math.sqrt(2.0) * math.pi  # full contact of the product wave of unit amplitude


def product(ratio, n, solid=UNIT, full=ROOT_2_PI, rtol=1e-8):
    scene = wave_scene(ratio * full, solid=solid, wavelength_y=1.0)
    return ck.solve(ck.plan(scene, ck.Accuracy(grid=n, rtol=rtol)))


def order(sizes, errors):
    """Slope of the line through the errors in a log-log plot."""
    return float(np.polyfit(np.log(sizes), np.log(np.abs(errors)), 1)[0])


def within_a_cell(run, half_width, n):
    assert 0.5 * run.contact_fraction == pytest.approx(half_width, abs=1.0 / n)


# One wave on a half-space -------------------------------------------------------------------


@pytest.mark.parametrize("case", WAVES, ids=lambda case: f"b={case['half_width']}")
def test_a_wave_on_a_half_space_is_that_of_westergaard(case):
    n = 512
    run = strip(case["mean_pressure"], n)
    within_a_cell(run, case["half_width"], n)
    assert run.max_pressure == pytest.approx(case["peak_pressure"], rel=1e-3)
    assert run.gap.mean() == pytest.approx(case["mean_gap"], abs=2e-4 * case["mean_gap"] + 1e-5)
    assert run.mean_pressure == pytest.approx(case["mean_pressure"], rel=1e-12)


def test_pressure_and_gap_have_the_form_that_westergaard_gives_them():
    n, ratio = 512, 0.5
    # The tolerance bounds gaps; at the shortest wave a gap is worth n/2 times its pressure.
    run = strip(ratio * math.pi, n, rtol=1e-11)
    x = np.arange(n) / n
    x = np.minimum(x, 1.0 - x)
    wanted = westergaard.pressure(x, ratio * math.pi, math.pi, 1.0)
    half_width = westergaard.half_width(ratio, 1.0)
    inside, outside = x < 0.95 * half_width, x > half_width + 2.0 / n
    np.testing.assert_allclose(run.pressure[0, inside], wanted[inside], rtol=2e-3)
    assert not run.pressure[:, outside].any()
    np.testing.assert_allclose(run.pressure[0], run.pressure[1], rtol=1e-8, atol=1e-8)
    assert run.gap[:, inside].max() <= 1e-7


@pytest.mark.parametrize("ratio", [0.2, 0.5, 0.8])
def test_a_wave_on_a_half_space_converges(ratio):
    """Each halving of the pixel moves the edges within their cells: the fit is over many."""
    cells = np.array([16, 24, 32, 48, 64, 96, 128, 192, 256])
    runs = [strip(ratio * math.pi, int(n)) for n in cells]
    gaps = [run.gap.mean() - westergaard.mean_gap(ratio, 1.0) for run in runs]
    peak = float(westergaard.pressure(0.0, ratio * math.pi, math.pi, 1.0))
    peaks = [run.max_pressure - peak for run in runs]
    assert order(1.0 / cells, gaps) > 1.0
    assert order(1.0 / cells, peaks) > 1.0


def test_the_crossover_to_full_contact_is_at_the_pressure_of_westergaard():
    assert strip(0.999 * math.pi, 256).contact_fraction < 1.0
    closed = strip(1.001 * math.pi, 256)
    assert closed.contact_fraction == 1.0
    assert closed.gap.max() < 1e-7


def test_a_wave_along_y_is_a_wave_along_x():
    n, pressure = 96, 0.4 * math.pi
    along_x = strip(pressure, n)
    crest = 1.0 * np.cos(2.0 * math.pi * np.arange(n) / n)
    turned = ck.press(np.repeat(crest[:, None], 2, axis=1), 1.0 / n, UNIT, pressure)
    np.testing.assert_allclose(turned.pressure, along_x.pressure.T, atol=1e-6)


# Full contact -------------------------------------------------------------------------------


@pytest.mark.parametrize("solid", [UNIT, COATED], ids=["half-space", "layered"])
@pytest.mark.parametrize("both", [False, True], ids=["one wave", "product"])
def test_full_contact_is_the_closed_form_to_round_off(solid, both):
    wavenumber = 2.0 * math.pi * (math.sqrt(2.0) if both else 1.0)
    moduli = MODULI if solid is COATED else ([UNIT.young_modulus], [NU], [])
    full = layered_wave.full_contact_pressure(1.0, wavenumber, *moduli)
    n = 48
    if both:
        run = product(1.5, n, solid, full, rtol=1e-11)
    else:
        run = strip(1.5 * full, n, rtol=1e-11, solid=solid)
    x = np.cos(2.0 * math.pi * np.arange(n) / n)
    crest = x[:, None] * x[None, :] if both else np.broadcast_to(x, (2, n))
    # A gap of 1e-11 at the shortest of n/2 waves is n/2 times that in pressure.
    np.testing.assert_allclose(run.pressure, full * (1.5 + crest), rtol=0, atol=5e-10 * full)
    assert run.contact_fraction == 1.0


@pytest.mark.parametrize(
    ("both", "ratio"), [(False, 0.995), (True, 0.99), (False, 1.005), (True, 1.01)]
)
def test_layered_full_contact_begins_where_the_compliance_says(both, ratio):
    wavenumber = 2.0 * math.pi * (math.sqrt(2.0) if both else 1.0)
    full = layered_wave.full_contact_pressure(1.0, wavenumber, *MODULI)
    run = product(ratio, 96, COATED, full) if both else strip(ratio * full, 256, solid=COATED)
    assert (run.contact_fraction == 1.0) is (ratio > 1.0)


# Partial contact of layers ------------------------------------------------------------------

ROWS = [(case, row) for case in LAYERED for row in case["rows"]]


@pytest.mark.parametrize(("case", "row"), ROWS, ids=lambda v: str(v.get("half_width", "")))
def test_partial_contact_of_a_layered_solid_is_that_of_the_table(case, row):
    n = 512
    run = strip(row["mean_pressure"], n, solid=COATED)
    within_a_cell(run, row["half_width"], n)
    assert run.max_pressure == pytest.approx(row["peak_pressure"], rel=1e-3)
    assert run.gap.mean() == pytest.approx(row["mean_gap"], abs=2e-4 * row["mean_gap"] + 1e-5)


@pytest.mark.parametrize("row", [LAYERED[0]["rows"][k] for k in (1, 2, 4)])
def test_partial_contact_of_a_layered_solid_converges(row):
    cells = np.array([16, 24, 32, 48, 64, 96, 128, 192, 256])
    runs = [strip(row["mean_pressure"], int(n), solid=COATED) for n in cells]
    gaps = [run.gap.mean() - row["mean_gap"] for run in runs]
    peaks = [run.max_pressure - row["peak_pressure"] for run in runs]
    assert order(1.0 / cells, gaps) > 1.0
    assert order(1.0 / cells, peaks) > 1.0


def test_two_layered_bodies_are_one_of_twice_the_compliance():
    two = strip(0.5, 128, solid=COATED, upper=COATED)
    half = ck.Stack(
        layers=tuple(
            ck.Layer(
                material=ck.Material(
                    young_modulus=0.5 * layer.material.young_modulus, poisson_ratio=NU
                ),
                thickness=layer.thickness,
            )
            for layer in COATED.layers
        ),
        substrate=ck.Material(young_modulus=0.5 * UNIT.young_modulus, poisson_ratio=NU),
    )
    one = strip(0.5, 128, solid=half)
    np.testing.assert_allclose(two.pressure, one.pressure, atol=1e-6)
    assert two.approach == pytest.approx(one.approach, rel=1e-7)


# Two waves ----------------------------------------------------------------------------------


def test_light_load_on_a_product_of_waves_makes_hertz_contacts():
    """Correction of relative order q^(2/3), and pixels of the perimeter."""
    ratio = 2e-3
    run = product(ratio, 256)
    assert run.contact_fraction == pytest.approx(
        product_wave.area_under_light_load(ratio), rel=0.06
    )
    # Each crest is a sphere of radius l^2/(4 pi^2 D) under half of the load.
    load, radius = 0.5 * ratio * math.sqrt(2.0) * math.pi, 1.0 / (4.0 * math.pi**2)
    peak = (6.0 * load / (math.pi**3 * radius**2)) ** (1.0 / 3.0)
    assert run.max_pressure == pytest.approx(peak, rel=0.03)


@pytest.mark.parametrize("solid", [UNIT, COATED], ids=["half-space", "layered"])
def test_the_last_gaps_of_a_product_of_waves_close_as_the_theory_says(solid):
    moduli = MODULI if solid is COATED else ([UNIT.young_modulus], [NU], [])
    wavenumber = 2.0 * math.sqrt(2.0) * math.pi
    full = layered_wave.full_contact_pressure(1.0, wavenumber, *moduli)
    ratio = 0.99
    run = product(ratio, 256, solid, full)
    left = 1.0 - product_wave.area_near_full_contact(ratio)
    assert 1.0 - run.contact_fraction == pytest.approx(left, rel=0.08)


def test_the_load_grows_by_hertz_law_at_first():
    """Area and approach of light loads: A ~ q^(2/3) over two decades."""
    ratios = np.array([1e-3, 4e-3, 1.6e-2])
    areas = [product(r, 192).contact_fraction for r in ratios]
    slope = np.polyfit(np.log(ratios), np.log(areas), 1)[0]
    assert slope == pytest.approx(2.0 / 3.0, abs=0.03)
