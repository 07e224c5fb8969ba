"""Quantities as texts with a unit: the same object as from numbers, in every class with a unit."""

import math

import attrs
import numpy as np
import pytest

import contactkit as ck
from contactkit.arguments import listed, positive_values
from contactkit.files.structure import structure
from contactkit.units import si
from contactkit.validators import positive


def test_a_scene_of_texts_equals_that_of_numbers():
    written = ck.ImposedForce(
        initial_gap="5 um", final_gap="25 um", force="40 N", mass="20 g", rise_time="1 ms"
    )
    given = ck.ImposedForce(
        initial_gap=5e-6, final_gap=25e-6, force=40.0, mass=0.02, rise_time=1e-3
    )
    assert written == given


@pytest.mark.parametrize(
    ("made", "value"),
    [
        (lambda: ck.Flat(radius="3.175 mm").radius, 3.175e-3),
        (lambda: ck.Flat(radius=1.0, tilt=("1 deg", 0.0)).tilt[0], math.pi / 180.0),
        (lambda: ck.Measured(path="a.csv", pixel_size=("50 nm", "60 nm")).pixel_size[1], 6e-8),
        (lambda: ck.Material(young_modulus="210 GPa", poisson_ratio="30 %").poisson_ratio, 0.3),
        (lambda: ck.TensionLimit(strength="10 bar").strength, 1e6),
        (lambda: ck.SubsurfaceStress(depths=("0 nm", "5 nm")).depths[1], 5e-9),
        (lambda: ck.Accuracy(grid="64").grid, 64),
        (lambda: attrs.evolve(ck.Sphere(radius=1.0), radius="2 um").radius, 2e-6),
        (lambda: ck.equilateral_triangle("2 mm").corners[1][0], 1e-3),
    ],
)
def test_texts_are_read_in_the_unit_of_their_field(made, value):
    assert made() == pytest.approx(value, rel=1e-15)


def test_words_in_place_of_a_number_stay_words():
    assert ck.TensionLimit(strength="vapour").strength == "vapour"
    with pytest.raises(ck.DescriptionError, match=r"strength must be positive .* got 'vapor'"):
        ck.TensionLimit(strength="vapor")


def test_a_field_of_an_own_class_reads_texts_after_its_own_converter():
    @attrs.frozen(kw_only=True)
    class Spring(ck.scene.surfaces.Surface):
        stiffness: float = attrs.field(validator=positive, metadata=si("N/m"))
        ends: tuple[float, ...] = attrs.field(
            converter=lambda pair: tuple(sorted(pair)), metadata=si("m")
        )

    spring = Spring(stiffness="2 mN/um", ends=["3 um", 1e-6])
    assert spring.stiffness == pytest.approx(2e3)
    assert spring.ends == pytest.approx((1e-6, 3e-6))


def test_functions_take_sequences_with_texts():
    assert listed("f(loads)", ["5 mN", 0.01], "N").tolist() == [0.005, 0.01]
    for wrong in ([], [[1.0]], ["1 nm"], [math.nan], "abc", [True, None]):
        with pytest.raises(ck.DescriptionError, match=r"f\(loads\) must"):
            listed("f(loads)", wrong, "N")
    heights = 1e-9 * np.cos(np.linspace(0.0, 2.0 * np.pi, 64, endpoint=False))
    surface = ck.Heights(heights=np.tile(heights, (64, 1)), pixel_size="10 nm")
    scene = ck.ContactScene(
        interface=ck.Interface(
            lower=ck.Body(solid=ck.Material(young_modulus="1 GPa", poisson_ratio=0.3)),
            upper=ck.Body(surface=surface),
        ),
        window=ck.Window(periodic=True),
        loading=ck.Pressing(pressure="100 MPa"),
        effects=(ck.HalfSpace(),),
    )
    curve = ck.load_curve(ck.plan(scene), pressures=["100 MPa", "200 MPa"])
    assert curve.columns["mean_pressure"] == pytest.approx([1e8, 2e8], rel=1e-6)


@pytest.mark.errors
@pytest.mark.parametrize("given", [7, True, 1.5, ("steel",)])
def test_a_number_is_no_text(given):
    """Not in Python, and not in a file, where it once became the text of the number."""
    elastic = {"young_modulus": "210 GPa", "poisson_ratio": 0.3}
    with pytest.raises(ck.DescriptionError, match=r"Material\.name must be a text"):
        ck.Material(name=given, **elastic)
    with pytest.raises(ck.DescriptionError, match=r"Material\.name must be a text"):
        structure({"name": given} | elastic, ck.Material, "steel.toml")
    with pytest.raises(ck.DescriptionError, match=r"Measured\.checksum must be a text"):
        ck.Measured(path="a.npy", checksum=given)
    assert ck.Measured(path="a.npy", checksum=None).checksum is None


@pytest.mark.errors
@pytest.mark.parametrize("given", [0.0, [1.0, -1.0], [], math.nan, [[1.0]], "-1 mm/s"])
def test_values_of_an_analysis_are_positive_along_one_axis(given):
    with pytest.raises(ck.DescriptionError, match=r"speeds must be"):
        positive_values("speeds", given, "m/s")
    assert positive_values("speeds", ["1 mm/s", 2.0], "m/s").tolist() == [1e-3, 2.0]
