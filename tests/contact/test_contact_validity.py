"""Every contact states whether its grid and its models are inside their ranges."""

from __future__ import annotations

import warnings

import numpy as np
import pytest
from attrs import evolve

import contactkit as ck
from contactkit.contact.effects.base import SolvedContact
from contactkit.contact.validity import check_contact

STEEL = ck.Material(name="steel", young_modulus=210e9, poisson_ratio=0.3, hardness=7e9)
E_STAR = 210e9 / (1.0 - 0.3**2)


def rough(cutoff=0.25e-6, rms=1e-9):
    return ck.SelfAffineRoughness(rms=rms, hurst=0.8, rolloff=0.8e-6, cutoff=cutoff)


ELASTIC = (ck.HalfSpace(),)


def scene(surface=None, pressure=20e6, solid=STEEL, effects=ELASTIC, **window):
    liquid = ck.load_liquid("water")
    meniscus = ck.Meniscus(liquid=liquid, contact_angle_lower=1.0, contact_angle_upper=1.0)
    return ck.ContactScene(
        interface=ck.Interface(
            lower=ck.Body(solid=solid), upper=surface or rough(), meniscus=meniscus
        ),
        window=ck.Window(**({"width": 2e-6} | window)),
        loading=ck.Pressing(pressure=pressure),
        effects=effects,
    )


def solved(given, grid=64):
    """Result of a scene, and the names of the numbers it warns of."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        result = ck.solve(ck.plan(given, ck.Accuracy(grid=grid)))
    assert {w.category for w in caught} <= {ck.ValidityWarning}
    texts = [str(w.message) for w in caught]
    out = [number for number in result.validity if number.is_valid is False]
    assert texts == [str(number) for number in out]
    return result, {number.name for number in out}


def numbers(result):
    return {number.name: number for number in result.validity}


GOOD = scene(pressure=200e6)


def test_a_contact_inside_all_ranges_warns_of_nothing():
    result, out = solved(GOOD)
    assert out == set()
    assert all(number.is_valid for number in result.validity)


@pytest.mark.parametrize(
    ("given", "grid", "name", "value"),
    [
        (scene(rough(0.1e-6)), 64, "pixels per shortest wave", 3.2),
        (scene(ck.Wave(amplitude=1e-8, wavelength=2e-6)), (4, 4), "pixels per shortest wave", 4.0),
        (
            scene(
                ck.Wave(amplitude=1e-8, wavelength=2e-6, wavelength_y=0.25e-6),
            ),
            (32, 64),
            "pixels per shortest wave",
            4.0,
        ),
        (scene(pressure=1e3), 64, "pixels across a contact spot", 16.0 / np.pi / 4.0),
        (scene(rough(rms=1e-6)), 64, "rms slope", None),
        (scene(rough(rms=1e-6)), 64, "peak pressure over E*", None),
        (
            scene(
                effects=(ck.HalfSpace(), ck.HardnessLimit(rule=ck.ConstantHardness(hardness=25e6)))
            ),
            64,
            "fraction of the contact at the hardness",
            None,
        ),
        (
            scene(
                solid=ck.Stack(layers=(ck.Layer(material=STEEL, thickness=5e-9),), substrate=STEEL),
                effects=(ck.LayeredHalfSpace(),),
            ),
            64,
            "layer thickness over pixel",
            5e-9 / (2e-6 / 64),
        ),
        (
            scene(effects=(ck.HalfSpace(), ck.FilmMeniscus(film_thickness=3e-9))),
            64,
            "film force over load",
            None,
        ),
        (
            scene(effects=(ck.HalfSpace(), ck.IslandBridges(film_thickness=8e-9))),
            64,
            "largest island over the window",
            None,
        ),
    ],
    ids=lambda one: one if isinstance(one, str) else "",
)
def test_each_number_has_a_case_that_is_out_of_its_range(given, grid, name, value):
    result, out = solved(given, grid)
    assert name in out
    number = numbers(result)[name]
    if value is not None:
        assert number.value == pytest.approx(value, rel=1e-12)
    bound = number.low if np.isinf(number.high) else number.high
    assert f"{bound:g}" in str(number)
    assert any(cure in number.detail for cure in ("use ", "check ", "lower "))


def test_the_peak_pressure_is_over_the_modulus_of_both_surfaces():
    soft = ck.Material(young_modulus=70e9, poisson_ratio=0.5)
    coated = ck.Stack(layers=(ck.Layer(material=soft, thickness=1e-6),), substrate=STEEL)
    both = ck.Interface(lower=ck.Body(solid=coated), upper=ck.Body(surface=rough(), solid=STEEL))
    result, _ = solved(evolve(GOOD, interface=both, effects=(ck.LayeredHalfSpace(),)))
    modulus = 1.0 / (1.0 / E_STAR + (1.0 - 0.25) / 70e9)
    found = numbers(result)["peak pressure over E*"].value
    assert found == pytest.approx(result.max_pressure / modulus, rel=1e-12)


def test_only_what_the_scene_calls_for_is_evaluated():
    names = set(numbers(solved(GOOD)[0]))
    assert names == {
        "pixels per shortest wave",
        "pixels across a contact spot",
        "peak pressure over E*",
        "rms slope",
        "Young's modulus [Pa]",
        "side of the window [m]",
        "mean pressure over E*",
        "jump at the edge of the periodic window",
    }
    isolated, _ = solved(evolve(GOOD, window=ck.Window(width=2e-6, periodic=False)))
    of_periods = {"jump at the edge of the periodic window", "mean pressure over E*"}
    assert set(numbers(isolated)) == names - of_periods


def test_without_contact_the_spots_are_not_evaluated():
    result, out = solved(evolve(GOOD, loading=ck.Pressing(pressure=0.0)))
    assert numbers(result)["pixels across a contact spot"].value is None
    assert out == set()


def test_full_contact_has_no_spots_to_resolve():
    result, _ = solved(scene(ck.Wave(amplitude=1e-12, wavelength=2e-6), pressure=1e9))
    assert result.contact_fraction == 1.0
    assert numbers(result)["pixels across a contact spot"].value == np.inf


def test_the_slope_is_that_of_the_heights():
    wave = ck.Wave(amplitude=2e-8, wavelength=2e-6)
    result, _ = solved(scene(wave), grid=256)
    slope = 2.0 * np.pi * 2e-8 / 2e-6 / np.sqrt(2.0)
    assert numbers(result)["rms slope"].value == pytest.approx(slope, rel=5e-3)


def test_the_slope_of_a_tip_is_that_of_where_it_touches():
    """Far from the contact of a paraboloid slopes are large and matter to nothing."""
    tip = ck.Paraboloid(radius=100e-9)
    given = scene(tip, pressure=5e6, width=200e-9, periodic=False)
    result, out = solved(given, grid=128)
    assert out == set()
    assert numbers(result)["rms slope"].value < 0.1


def press(heights, **more):
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        result = ck.press(heights, 2e-6 / 64, STEEL, 20e6, **more)
    assert {w.category for w in caught} <= {ck.ValidityWarning}
    return result, {str(w.message).partition(" = ")[0] for w in caught}


HEIGHTS = np.asarray(ck.plan(GOOD, ck.Accuracy(grid=64)).heights)


def test_heights_in_another_unit_are_noticed():
    assert press(HEIGHTS)[1] <= {"pixels across a contact spot"}
    assert {"rms slope", "peak pressure over E*"} <= press(HEIGHTS * 1e6)[1]


@pytest.mark.parametrize("axis", [0, 1])
def test_a_tilted_map_does_not_fit_a_periodic_window(axis):
    ramp = np.linspace(-5e-9, 5e-9, 64)
    tilted = HEIGHTS + (ramp[:, None] if axis == 0 else ramp)
    jump = "jump at the edge of the periodic window"
    assert jump in press(tilted)[1]
    assert jump not in press(tilted, periodic=False)[1]
    assert jump not in press(HEIGHTS)[1]


@pytest.mark.parametrize("seed", range(8))
@pytest.mark.parametrize("axis", [0, 1])
def test_the_edge_of_a_surface_that_repeats_is_like_any_line(seed, axis):
    surface = evolve(rough(), seed=seed)
    heights = np.asarray(ck.plan(scene(surface), ck.Accuracy(grid=64)).heights)
    for shift in (0, 7, 31):
        rolled = np.roll(heights, shift, axis)
        grid = ck.plan(GOOD, ck.Accuracy(grid=64)).grid
        contact = SolvedContact(
            GOOD, grid, np.ones((64, 64)), np.zeros((64, 64)), np.zeros((64, 64))
        )
        found = {n.name: n for n in check_contact(contact, rolled, {})}
        assert found["jump at the edge of the periodic window"].value < 1.5


def test_part_of_a_map_does_not_repeat():
    jump = "jump at the edge of the periodic window"
    assert jump in press(HEIGHTS[:33, :41])[1]


def test_a_saved_result_states_the_same(tmp_path):
    film = ck.FilmMeniscus(film_thickness=3e-9)
    limit = ck.HardnessLimit(rule=ck.ConstantHardness(hardness=2e9))
    result, _ = solved(evolve(GOOD, effects=(ck.HalfSpace(), limit, film)))
    again = ck.load_result(result.save(tmp_path / "contact"))
    assert again.validity == result.validity


# A film as published ------------------------------------------------------------------------


def filmed(pressure, self_consistent=False):
    film = ck.FilmMeniscus(film_thickness=2e-9, self_consistent=self_consistent)
    return solved(scene(pressure=pressure, effects=(ck.HalfSpace(), film)), grid=128)


def test_a_film_that_pulls_more_than_the_load_says_what_it_would_pull_in_balance():
    reported, out = filmed(1e5)
    part = reported.of(ck.FilmMeniscus)
    assert part.relative_force > 1.0
    assert "film force over load" in out
    number = numbers(reported)["film force over load"]
    assert f"{part.self_consistent_force:.2g} N" in number.detail
    balanced, out = filmed(1e5, self_consistent=True)
    assert "film force over load" not in out
    force = balanced.of(ck.FilmMeniscus).force
    assert force > 2.0 * part.force
    assert part.self_consistent_force == pytest.approx(force, rel=0.3)
    assert balanced.of(ck.FilmMeniscus).self_consistent_force is None


@pytest.mark.slow
def test_the_smoothest_surface_of_the_source_states_the_size_in_balance():
    """The lowest load of Fig. 2.25 on sigma = 1 nm, beta* = 0.5 um: 7 and 180 times the load."""
    surface = ck.GaussianRoughness(rms=1e-9, correlation_length=0.5e-6, cutoff=625e-9)
    solid = ck.Material(name="III", young_modulus=100e9, poisson_ratio=0.3, hardness=5e9)
    lubricant = ck.Meniscus(liquid=ck.Liquid(name="lubricant", surface_tension=0.025))

    def of(self_consistent):
        film = ck.FilmMeniscus(film_thickness=1e-9, self_consistent=self_consistent)
        given = scene(surface, 1e5, solid, (ck.HalfSpace(), film), width=20e-6)
        interface = evolve(given.interface, meniscus=lubricant)
        result, out = solved(evolve(given, interface=interface), grid=256)
        return result.of(ck.FilmMeniscus), numbers(result), out

    reported, stated, out = of(self_consistent=False)
    balanced, _, _ = of(self_consistent=True)
    assert 4.0 < reported.relative_force < 12.0
    assert 100.0 < balanced.relative_force < 300.0
    assert "film force over load" in out
    assert reported.self_consistent_force == pytest.approx(balanced.force, rel=0.1)
    text = f"{reported.self_consistent_force / 4e-5:.2g} times the load"
    assert text in stated["film force over load"].detail


def test_a_film_that_repels_is_out_of_range_as_well():
    film = ck.FilmMeniscus(film_thickness=2e-9)
    given = scene(pressure=3e7, effects=(ck.HalfSpace(), film))
    wet = evolve(given.interface.meniscus, contact_angle_lower=2.5, contact_angle_upper=2.5)
    given = evolve(given, interface=evolve(given.interface, meniscus=wet))
    reported, out = solved(given)
    part = reported.of(ck.FilmMeniscus)
    assert part.relative_force < -0.1
    assert "film force over load" in out
    assert part.self_consistent_force < 0.0


def test_a_weak_film_is_not_estimated():
    reported, out = filmed(3e9)
    part = reported.of(ck.FilmMeniscus)
    assert part.relative_force < 0.1
    assert part.self_consistent_force is None
    assert "film force over load" not in out


def test_an_imposed_approach_is_no_load_that_a_film_could_add_to():
    film = ck.FilmMeniscus(film_thickness=2e-9)
    given = scene(effects=(ck.HalfSpace(), film))
    given = evolve(given, loading=ck.Approach(approach=1e-10))
    result, _ = solved(given)
    assert "film force over load" not in numbers(result)


@pytest.mark.parametrize("axis", ["x", "y"])
@pytest.mark.parametrize("periodic", [True, False], ids=["both axes", "one axis"])
def test_a_nip_is_as_wide_as_its_pixels_across(axis, periodic):
    heights = np.zeros((24, 32))
    heights[:, 10:17] = 1e-9
    if axis == "x":
        heights = heights.T
    given = scene(
        ck.Heights(heights=heights, pixel_size=1e-8),
        pressure=1e5,
        width=None,
        periodic=periodic or axis,
    )
    result = ck.solve(ck.plan(given))
    assert np.array_equal(result.pressure > 0.0, heights > 0.0)
    value = next(v.value for v in result.validity if v.name == "pixels across a contact spot")
    assert value == 7.0


# Units --------------------------------------------------------------------------------------

SLIPS = {  # a mistaken unit as a factor of heights, pixel, pressure and modulus: what is named
    "pixel in um": ((1.0, 1e6, 1.0, 1.0), {"rms slope", "side of the window [m]"}),
    "pixel in nm": ((1.0, 1e9, 1.0, 1.0), {"rms slope", "side of the window [m]"}),
    "heights in km": ((1e-6, 1.0, 1.0, 1.0), {"rms slope"}),
    "heights and pixel in um": ((1e6, 1e6, 1.0, 1.0), {"side of the window [m]"}),
    "pressure in MPa": ((1.0, 1.0, 1e-6, 1.0), {"mean pressure over E*"}),
    "pressure in uPa": ((1.0, 1.0, 1e6, 1.0), {"peak pressure over E*"}),
    "modulus in GPa": ((1.0, 1.0, 1e-9, 1e-9), {"Young's modulus [Pa]"}),
    "modulus in MPa": ((1.0, 1.0, 1.0, 1e-6), {"peak pressure over E*"}),
    "modulus in nPa": ((1.0, 1.0, 1.0, 1e9), {"Young's modulus [Pa]", "peak pressure over E*"}),
}


@pytest.mark.parametrize("slip", SLIPS)
def test_a_mistaken_unit_is_named(slip):
    (height, length, load, stiff), expected = SLIPS[slip]
    solid = evolve(STEEL, young_modulus=stiff * 210e9)
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        ck.press(height * HEIGHTS, length * 2e-6 / 64, solid, load * 200e6)
    texts = {str(w.message).partition(" = ")[0]: str(w.message) for w in caught}
    assert expected <= texts.keys()
    assert all("unit" in texts[name] for name in expected)


@pytest.mark.parametrize("factor", [1e-6, 1.0, 1e6])
def test_a_mistaken_unit_of_thickness_or_hardness_is_named(factor):
    layer = ck.Layer(material=evolve(STEEL, hardness=3e9 * factor), thickness=50e-9 * factor)
    limit = ck.HardnessLimit(rule=ck.ConstantHardness(hardness=3e9 / factor))
    solid = ck.Stack(layers=(layer,), substrate=STEEL)
    given = scene(solid=solid, pressure=200e6, effects=(ck.LayeredHalfSpace(), limit))
    if factor == 1e6:
        with pytest.raises(ck.InfeasibleError, match="hardness of 3000 Pa"):
            solved(given)
        given = evolve(given, effects=(ck.LayeredHalfSpace(),))
    _, out = solved(given)
    of = {1e-6: {"hardness over E*", "layer thickness over pixel"}, 1.0: set()}
    assert out == of.get(factor, {"layer thickness over the window"})


@pytest.mark.parametrize("height", [0.0, 3.0])
@pytest.mark.parametrize("pressure", [1e-3, 1e6])
def test_flat_surfaces_have_no_slope_and_any_pressure(height, pressure):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        result = ck.press(np.full((16, 16), height), 1e-8, STEEL, pressure)
    found = numbers(result)
    assert found["rms slope"].value is None
    assert "mean pressure over E*" not in found
    assert found["peak pressure over E*"].low == -np.inf


@pytest.mark.parametrize(
    ("radius", "modulus", "force", "width"),
    [
        (1.0, 70e9, 1.0, 2e-3),
        (2e-6, 2e6, 1e-9, 1e-6),
        (10.0, 70e9, 0.1, 4e-3),
        (5e-9, 1e11, 1e-8, 4e-9),
    ],
)
def test_balls_from_a_lens_to_a_tip_are_plausible(radius, modulus, force, width):
    solid = ck.Material(young_modulus=modulus, poisson_ratio=0.3)
    given = scene(ck.Paraboloid(radius=radius), solid=solid, width=width, periodic=False)
    _, out = solved(evolve(given, loading=ck.Pressing(force=force)))
    assert out == set()


@pytest.mark.parametrize(
    ("sides", "periodic", "reached"),
    [
        ((2.6, 2.6), False, False),
        ((1.8, 1.8), False, True),
        ((1.8, 2.6), False, True),
        ((1.8, 2.6), "x", False),  # repeats along x, ends along y
        ((2.6, 1.8), "x", True),
        ((1.8, 2.6), "y", True),
        ((2.6, 1.8), "y", False),
        ((1.8, 1.8), True, False),
    ],
)
def test_a_ball_that_is_wider_than_its_window_is_noticed(sides, periodic, reached):
    """By the contact radius of Hertz, ``a^3 = 3 F R/(4 E*)``: the grid does not show it."""
    radius, force = 1e-3, 1e-4
    soft = ck.Material(young_modulus=1e9, poisson_ratio=0.3)
    a = (0.75 * force * radius / soft.plane_strain_modulus) ** (1.0 / 3.0)
    ball = scene(ck.Paraboloid(radius=radius), solid=soft, periodic=periodic,
                 width=sides[0] * a, height=sides[1] * a)  # fmt: skip
    with warnings.catch_warnings(action="ignore"):
        result = ck.solve(
            ck.plan(evolve(ball, loading=ck.Pressing(force=force)), ck.Accuracy(grid=(39, 27)))
        )
    number = numbers(result).get("load at the edge of the window over the load")
    assert (number is not None and number.is_valid is False) == reached
    assert (number is None) == (periodic is True)
    if sides == (1.8, 1.8) and reached:  # some percent of what the outermost pixels cover
        assert 0.02 < number.value < 0.13
        assert result.contact_area < 0.99 * np.pi * a**2 < 3.24 * a**2


def test_a_punch_ends_at_the_edge_of_its_window():
    _, out = solved(scene(ck.Flat(), periodic=False), 16)
    assert not any("edge of the window" in name for name in out)
