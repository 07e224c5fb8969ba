"""Slips of those who write their first scene: each works, or is answered with the cure."""

from __future__ import annotations

import math

import numpy as np
import pytest

import contactkit as ck
from contactkit.cli import main
from contactkit.units import deg, parse_quantity

pytestmark = [pytest.mark.errors, pytest.mark.filterwarnings("ignore::contactkit.ValidityWarning")]

OIL = ck.Liquid(name="oil", viscosity=0.1, surface_tension=0.03, density=870.0)
STEEL = ck.Material(name="steel", young_modulus=210e9, poisson_ratio=0.3)
FACES = ck.Interface(lower=ck.Flat(radius=1e-3), meniscus=ck.Meniscus(liquid=OIL, volume=1e-12))
OPENING = ck.ImposedSpeed(speed=1e-4, initial_gap=1e-6, final_gap=1e-5)
WAVE = 1e-9 * np.cos(np.linspace(0.0, 2.0 * math.pi, 16, endpoint=False))[None, :].repeat(16, 0)

FILM = """\
temperature = "20 degC"
[interface.lower]
shape = "flat"
radius = "3 mm"
[interface.meniscus]
volume = "0.1 uL"
contact_angle_lower = "60 deg"
[interface.meniscus.liquid]
name = "oil"
viscosity = "10 mPa.s"
surface_tension = "30 mN/m"
density = "870 kg/m3"
[loading]
kind = "imposed-force"
initial_gap = "5 um"
final_gap = "50 um"
force = "40 N"
mass = "20 g"
[[effects]]
effect = "viscous-force"
"""
TOUCH = """\
[interface.lower]
solid = "bearing-steel"
[interface.upper]
shape = "gaussian-roughness"
rms = "1 nm"
correlation_length = "500 nm"
cutoff = "200 nm"
[window]
width = "1 um"
[loading]
kind = "pressing"
pressure = "10 MPa"
[[effects]]
effect = "half-space"
[accuracy]
grid = 32
"""


def film(**changes):
    made = {"interface": FACES, "loading": OPENING, "effects": (ck.ViscousForce(),)}
    return ck.SeparationScene(**made | changes)


def touch():
    return ck.ContactScene(
        interface=ck.Interface(
            lower=ck.Body(solid=STEEL), upper=ck.Wave(amplitude=1e-9, wavelength=1e-6)
        ),
        window=ck.Window(width=1e-6),
        loading=ck.Pressing(pressure=1e7),
        effects=(ck.HalfSpace(),),
    )


def opened():
    return ck.simulate(ck.plan(film()))


def pushed():
    loading = ck.ImposedForce(force=-40.0, mass=0.02, initial_gap=1e-6, final_gap=1e-5)
    return ck.simulate(ck.plan(film(loading=loading)))


GRID = ck.Accuracy(grid=16)
IN_PYTHON = {
    "a scene is simulated": (
        lambda: ck.simulate(film()),
        ck.PlanError,
        "got a SeparationScene; plan the scene first: ck.simulate(ck.plan(scene))",
    ),
    "a contact scene is simulated": (
        lambda: ck.simulate(touch()),
        ck.PlanError,
        "got a ContactScene; plan the scene first: ck.solve(ck.plan(scene))",
    ),
    "a scene is solved": (
        lambda: ck.solve(touch()),
        ck.PlanError,
        "plan the scene first: ck.solve(ck.plan(scene))",
    ),
    "a separation is solved": (
        lambda: ck.solve(ck.plan(film())),
        ck.PlanError,
        "a ContactPlan can be run here, got a Plan; its plan is run by ck.simulate(plan)",
    ),
    "a contact is simulated": (
        lambda: ck.simulate(ck.plan(touch(), GRID)),
        ck.PlanError,
        "got a ContactPlan; its plan is run by ck.solve(plan)",
    ),
    "a file is planned": (
        lambda: ck.plan("film.toml"),
        ck.PlanError,
        "got a str; a scene file is read by ck.load_scene(path)",
    ),
    "a plan is planned": (
        lambda: ck.plan(ck.plan(film())),
        ck.PlanError,
        "it is a plan already, whose scene is plan.scene",
    ),
    "a plan is analysed": (
        lambda: ck.divide_meniscus(ck.plan(film())),
        ck.PlanError,
        "a SeparationScene is needed here, got a Plan; it is a plan already",
    ),
    "a separation has no load curve": (
        lambda: ck.load_displacement(film()),
        ck.PlanError,
        "a ContactScene is needed here, got a SeparationScene",
    ),
    "a column is misspelt": (
        lambda: opened()["viscus_force"],
        ck.DescriptionError,
        "got 'viscus_force'; did you mean result['viscous_force']?",
    ),
    "a column is taken for an attribute": (
        lambda: opened().viscus_force,
        AttributeError,
        "SeparationResult has no attribute 'viscus_force'; did you mean result['viscous_force']?",
    ),
    "a number is taken for an attribute": (
        lambda: opened().peak_forse,
        AttributeError,
        "did you mean result.scalars()['peak_force']?",
    ),
    "an attribute is misspelt": (
        lambda: ck.solve(ck.plan(touch(), GRID)).contact_aera,
        AttributeError,
        "did you mean result.contact_area?",
    ),
    "nothing is near": (
        lambda: opened().colour,
        AttributeError,
        'a column is result["name"], a number result.scalars()',
    ),
    "a field is misspelt": (
        lambda: film(loadings=OPENING),
        TypeError,
        "SeparationScene() got an unexpected keyword argument 'loadings'; did you mean 'loading'?",
    ),
    "a field of another kind": (
        lambda: ck.GaussianRoughness(rms=1e-9, hurst=0.8),
        TypeError,
        "unexpected keyword argument 'hurst'; known: rms, correlation_length, cutoff, seed",
    ),
    "a field by its place": (
        lambda: ck.Sphere(1e-6),
        TypeError,
        "Sphere() takes its fields by name: radius=...",
    ),
    "a text with a unit that does not fit": (
        lambda: ck.Flat(radius="1 mN"),
        ck.DescriptionError,
        "Flat.radius must be in a unit that converts to m, got '1 mN'; for example '2.5 m'",
    ),
    "a text without its unit": (
        lambda: ck.Flat(radius="1"),
        ck.DescriptionError,
        "Flat.radius must carry a unit [m], got '1'; for example '2.5 m'",
    ),
    "a word for a number": (
        lambda: ck.Flat(radius="wide"),
        ck.DescriptionError,
        "Flat.radius must be positive and finite [m], got 'wide'",
    ),
    "a grid as a text": (
        lambda: ck.Accuracy(grid="64x64"),
        ck.DescriptionError,
        "Accuracy.grid must be a number and a unit [-], got '64x64'; two numbers? write [64, 64]",
    ),
    "an angle beyond 180 deg": (
        lambda: ck.Meniscus(liquid=OIL, contact_angle_lower=200.0 * deg),
        ck.DescriptionError,
        "in radians it is 200 deg, beyond 180 deg",
    ),
    "a force that closes": (
        pushed,
        ck.InfeasibleError,
        "loading.force is -40 N and never opens the gap: a force that opens is positive, "
        "force = 40 N",
    ),
    "a liquid by its name": (
        lambda: ck.Meniscus(liquid="water"),
        ck.DescriptionError,
        "Meniscus.liquid must be a Liquid, got 'water'; one of the library is "
        "ck.load_liquid('water')",
    ),
    "an effect without its brackets": (
        lambda: ck.plan(film(effects=(ck.ViscousForce,))),
        ck.PlanError,
        "it is a class: write ViscousForce()",
    ),
    "an effect by its name": (
        lambda: opened().of("viscous-force"),
        ck.PlanError,
        "the class of an effect is needed, such as ck.MeniscusForce, got 'viscous-force'",
    ),
    "an effect in place of its class": (
        lambda: opened().of(ck.ViscousForce()),
        ck.PlanError,
        "such as ck.ViscousForce",
    ),
    "a tolerance in place of an accuracy": (
        lambda: ck.plan(film(), 1e-6),
        ck.PlanError,
        "an Accuracy is needed beside the scene, got 1e-06; write ck.Accuracy(rtol=...)",
    ),
    "an accuracy by its name": (
        lambda: ck.plan(film(), "draft"),
        ck.PlanError,
        "write ck.Accuracy.draft",
    ),
    "a name of the package is misspelt": (
        lambda: ck.Simulate,
        AttributeError,
        "module 'contactkit' has no attribute 'Simulate'; did you mean 'simulate'?",
    ),
    "a number as a text": (
        lambda: ck.Accuracy(grid="64.5"),
        ck.DescriptionError,
        "Accuracy.grid must be a whole number of at least 2, or (ny, nx), got 64.5",
    ),
    "a pressure in another unit": (
        lambda: ck.press(WAVE, "60 nm", STEEL, "100 N"),
        ck.DescriptionError,
        "press(mean_pressure) must be in a unit that converts to Pa, got '100 N'",
    ),
}


@pytest.mark.parametrize("slip", IN_PYTHON)
def test_a_slip_in_python_is_answered_with_its_cure(slip):
    call, kind, answer = IN_PYTHON[slip]
    with pytest.raises(kind) as caught:
        call()
    assert answer in str(caught.value)


IN_FILES = {
    "a key of former files, misspelt": (
        FILM + "[openning]\n",
        "SeparationScene.openning must be a known key",
        'opening is now [loading] with kind = "imposed-speed"',
    ),
    "an angle beyond 180 deg": (
        FILM.replace('"60 deg"', '"200 deg"'),
        "Meniscus.contact_angle_lower must lie between 0 and pi [rad]",
        "in radians it is 200 deg, beyond 180 deg",
    ),
    "a decimal comma": (
        FILM.replace('"5 um"', '"2,5 um"'),
        "ImposedForce.initial_gap must be a number and a unit [m], got '2,5 um'",
        "a decimal comma? write 2.5 um",
    ),
    "a decimal comma in a number": (
        FILM.replace('"5 um"', "0,5"),
        "not TOML",
        "a decimal comma? write a point",
    ),
    "a decimal comma in a table on one line": (
        'loading = { kind = "imposed-force", mass = 0,02, force = 40 }',
        "not TOML",
        "a decimal comma? write a point",
    ),
    "a unit with a capital": (
        FILM.replace('"20 g"', '"0.02 KG"'),
        "ImposedForce.mass must be made of known symbols ('KG' is not one)",
        "did you mean 'kg'?",
    ),
    "a unit in capitals, of which there are two": (
        FILM + '[[effects]]\neffect = "tension-limit"\nstrength = "1 MPA"\n',
        "('MPA' is not one)",
        "did you mean 'mPa' or 'MPa'?",
    ),
    "a pull that pushes": (
        FILM.replace('"40 N"', '"-40 N"'),
        "loading.force is -40 N and never opens the gap",
        "force = 40 N",
    ),
    "a negative load": (
        TOUCH.replace("pressure", "force").replace('"10 MPa"', '"-40 N"'),
        "Pressing.force must be zero or positive [N], got -40.0",
        "list Adhesion(law=...)",
    ),
    "a grid as a text": (
        TOUCH.replace("grid = 32", 'grid = "64x64"'),
        "Accuracy.grid must be a number and a unit",
        "two numbers? write [64, 64]",
    ),
    "a field of another surface": (
        TOUCH.replace("rms =", "hurst = 0.8\nrms ="),
        "GaussianRoughness.hurst must be a known key",
        "it belongs to self-affine-roughness; known: rms, correlation_length, cutoff, seed",
    ),
    "a field of another effect": (
        FILM + 'cavity_pressure = "1 bar"\n',
        "ViscousForce.cavity_pressure must be a known key",
        "it belongs to tension-limit",
    ),
}


@pytest.mark.parametrize("slip", IN_FILES)
def test_a_slip_in_a_file_is_answered_with_its_cure(tmp_path, capsys, slip):
    text, *answers = IN_FILES[slip]
    path = tmp_path / "scene.toml"
    path.write_text(text, encoding="utf-8")
    assert main(["run", str(path)]) == 2
    error = capsys.readouterr().err
    for answer in answers:
        assert answer in error
    assert "did you mean 'rms'" not in error


@pytest.mark.parametrize(
    ("text", "unit", "value"),
    [
        ("145.037737730 psi", "Pa", 1e6),
        ("60°", "rad", math.pi / 3.0),
        ("60 °", "rad", math.pi / 3.0),
        ("20 °C", "K", 293.15),
        ("20 degC", "K", 293.15),
        ("20 C", "K", 293.15),
        ("5 Nm", "N.m", 5.0),
        ("5 mNm", "J", 5e-3),
        ("0.1 uL", "m3", 1e-10),
        ("0.1 ul", "m3", 1e-10),
        ("0.1 µL", "m3", 1e-10),
        ("0.1 \u03bcL", "m3", 1e-10),  # the Greek letter
        ("10 mPas", "Pa.s", 0.01),
        ("10 mPa·s", "Pa.s", 0.01),
        ("2 Ns/m", "N.s/m", 2.0),
        ("1 cP", "Pa.s", 1e-3),
        ("5 Å", "m", 5e-10),
        ("5 nm", "m", 5e-9),  # and no newton metre
        ("5 ns", "s", 5e-9),
    ],
)
def test_units_as_they_are_commonly_written(text, unit, value):
    assert parse_quantity(text, unit) == pytest.approx(value, rel=1e-9)


def test_press_takes_texts_with_units():
    plain = ck.press(WAVE, 1e-6 / 16, STEEL, 1e7, 1e9)
    texts = ck.press(WAVE, ("62.5 nm", "62.5 nm"), STEEL, "10 MPa", "1 GPa")
    np.testing.assert_array_equal(texts.pressure, plain.pressure)


def test_a_file_of_another_kind_than_wanted_is_refused(tmp_path):
    path = ck.save_scene(film(), tmp_path / "film.toml")
    assert ck.load_scene(path, ck.SeparationScene) == film()
    with pytest.raises(ck.DescriptionError, match=r"hold a ContactScene.*it is a SeparationScene"):
        ck.load_scene(path, ck.ContactScene)
    saved = opened().save(tmp_path / "film")
    assert ck.load_result(saved, ck.SeparationResult).status == "curve"
    with pytest.raises(ck.DescriptionError, match=r"hold a ContactResult.*a SeparationResult"):
        ck.load_result(saved, ck.ContactResult)
