"""What holds for every liquid: viscosity falls, defining points are met, nothing overflows."""

from __future__ import annotations

import math
import warnings

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from contactkit.errors import DescriptionError, ValidityWarning
from contactkit.kinds import TEMPERATURE_LAWS
from contactkit.liquids.liquid import Liquid
from contactkit.liquids.temperature_laws import LinearDensity, LinearSurfaceTension
from contactkit.liquids.viscosity import VogelViscosity, WaltherViscosity
from contactkit.liquids.water import IapwsSurfaceTension, KellWaterDensity
from contactkit.units import cSt

ANY = st.floats(min_value=0.0, allow_nan=False, exclude_min=True)


@st.composite
def oils(draw):
    """Walther laws of oils that occur, from gas oil to bitumen, and of some that do not."""
    cold = draw(st.floats(250.0, 380.0))
    apart = draw(st.floats(5.0, 120.0))
    thin = draw(st.floats(0.5, 1e3))
    ratio = draw(st.floats(1.05, 100.0))
    return WaltherViscosity(
        temperature_1=cold,
        kinematic_viscosity_1=thin * ratio * cSt,
        temperature_2=cold + apart,
        kinematic_viscosity_2=thin * cSt,
        temperature_min=cold,
        temperature_max=cold + apart,
    )


@st.composite
def vogels(draw):
    divergence = draw(st.floats(0.0, 200.0))
    activation = draw(st.floats(50.0, 600.0))
    return VogelViscosity(
        reference_viscosity=draw(st.floats(1e-6, 1e-3)),
        activation_temperature=activation,
        divergence_temperature=divergence,
        temperature_min=divergence + activation,
        temperature_max=divergence + activation + 100.0,
    )


@st.composite
def lines(draw):
    law, size = draw(st.sampled_from([(LinearSurfaceTension, 0.03), (LinearDensity, 880.0)]))
    return law(
        value=size * draw(st.floats(0.5, 2.0)),
        slope=size * draw(st.floats(-0.004, 0.004)),
        reference_temperature=290.0,
        temperature_min=280.0,
        temperature_max=320.0,
    )


laws = st.one_of(
    oils(), vogels(), lines(), st.just(IapwsSurfaceTension()), st.just(KellWaterDensity())
)
within = st.floats(0.0, 1.0)


def inside(law, fraction):
    temperature = law.temperature_min + fraction * (law.temperature_max - law.temperature_min)
    return min(max(temperature, law.temperature_min), law.temperature_max)


@given(oils())
def test_walther_meets_both_of_its_points(law):
    for temperature, viscosity in (
        (law.temperature_1, law.kinematic_viscosity_1),
        (law.temperature_2, law.kinematic_viscosity_2),
    ):
        # 0.7 cSt is added and taken away again, which costs digits where an oil is thin.
        assert math.isclose(law(temperature), viscosity, rel_tol=1e-12)


@given(st.one_of(oils(), vogels()), within, within)
def test_viscosity_falls_as_the_liquid_warms(law, one, other):
    cold, hot = sorted((inside(law, one), inside(law, other)))
    assume(hot - cold > 1e-3)
    assert law(cold) > law(hot)


@given(st.floats(250.0, 646.9), st.floats(250.0, 646.9))
def test_surface_tension_of_water_falls_as_it_warms(one, other):
    cold, hot = sorted((one, other))
    assume(hot - cold > 1e-6)
    assert IapwsSurfaceTension()(cold) > IapwsSurfaceTension()(hot)


@given(oils(), within, st.floats(0.1, 10.0))
def test_walther_knows_no_unit_of_temperature(law, fraction, scale):
    # A - B log T: counting temperature in other degrees moves A only. Stated on the law in use:
    # scaling all its temperatures scales where it takes its values.
    scaled = law.temperature_1 * scale
    assume(scaled > 160.0)
    other = WaltherViscosity(
        temperature_1=scaled,
        kinematic_viscosity_1=law.kinematic_viscosity_1,
        temperature_2=law.temperature_2 * scale,
        kinematic_viscosity_2=law.kinematic_viscosity_2,
        temperature_min=law.temperature_min * scale * 0.999,
        temperature_max=law.temperature_max * scale * 1.001,
    )
    temperature = inside(law, fraction)
    assert math.isclose(other(temperature * scale), law(temperature), rel_tol=1e-9)


@given(laws, within)
def test_laws_are_silent_and_positive_within_their_range(law, fraction):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert 0.0 < law(inside(law, fraction)) < math.inf


@given(laws, ANY)
def test_no_temperature_overflows(law, temperature):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ValidityWarning)
        try:
            value = law(temperature)
        except DescriptionError:
            return
    assert 0.0 < value < math.inf


@given(
    st.fixed_dictionaries(
        {
            "reference_viscosity": ANY,
            "activation_temperature": ANY,
            "divergence_temperature": ANY,
            "temperature_min": ANY,
            "temperature_max": ANY,
        }
    ),
    ANY,
)
def test_no_constants_make_vogel_overflow(constants, temperature):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ValidityWarning)
        try:
            value = VogelViscosity(**constants)(temperature)
        except DescriptionError:
            return
    assert 0.0 < value < math.inf


@given(
    st.floats(150.0, 1e3), st.floats(150.0, 1e3), st.floats(4e-7, 1.0), st.floats(4e-7, 1.0), ANY
)
def test_no_constants_make_walther_overflow(one, other, thick, thin, temperature):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ValidityWarning)
        try:
            value = WaltherViscosity(
                temperature_1=one,
                kinematic_viscosity_1=thick,
                temperature_2=other,
                kinematic_viscosity_2=thin,
            )(temperature)
        except DescriptionError:
            return
    assert 0.0 < value < math.inf


@given(oils(), st.floats(500.0, 2000.0), within)
def test_a_liquid_gives_what_its_laws_give(law, density, fraction):
    temperature = inside(law, fraction)
    state = Liquid(name="oil", kinematic_viscosity=law, density=density).at(temperature)
    assert state.viscosity == law(temperature) * density
    assert state.density == density
    assert state.given("surface_tension") is None
    with pytest.raises(DescriptionError, match=r"Liquid\.surface_tension must be given"):
        _ = state.surface_tension
    assert state.temperature == temperature


def test_every_law_has_a_name_and_a_unit_of_its_own_and_units_on_its_fields():
    from attrs import fields

    assert len({law.kind for law in TEMPERATURE_LAWS}) == len(TEMPERATURE_LAWS)
    assert {law.unit for law in TEMPERATURE_LAWS} == {"N/m", "Pa.s", "m2/s", "kg/m3"}
    for law in TEMPERATURE_LAWS:
        for attribute in fields(law):
            assert attribute.name == "source" or attribute.metadata["unit"], attribute.name
