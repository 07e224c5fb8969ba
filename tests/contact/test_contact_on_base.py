"""Contacts of solids on rigid bases: thin films, the datum of the approach, scenes and refusals."""

from __future__ import annotations

import math
import pickle

import numpy as np
import pytest
from refusals import each_refused

import contactkit as ck
from contactkit.elasticity.layer_stack import uniform_compliance
from contactkit.files.results import from_bytes, to_bytes

E, R, WIDTH = 1e9, 1e-3, 100e-6
pytestmark = pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning")


def sheet(thickness, nu=0.3, bonded=True, above=()):
    rubber = ck.Material(name="rubber", young_modulus=E, poisson_ratio=nu)
    layers = (*above, ck.Layer(material=rubber, thickness=thickness))
    return ck.Stack(layers=layers, substrate=ck.RigidBase(bonded=bonded))


def scene(lower, loading, surface=None, upper=None, periodic=False, effects=()):
    body = ck.Body(surface=surface or ck.Paraboloid(radius=R), solid=upper)
    return ck.ContactScene(
        interface=ck.Interface(lower=ck.Body(solid=lower), upper=body),
        window=ck.Window(width=WIDTH, periodic=periodic),
        loading=loading,
        effects=(ck.LayeredHalfSpace(), *effects),
    )


def solved(*args, grid=128, **kwargs):
    return ck.solve(ck.plan(scene(*args, **kwargs), ck.Accuracy(grid=grid)))


WAVE = ck.Wave(amplitude=1e-8, wavelength=WIDTH / 2, wavelength_y=WIDTH)


@pytest.mark.parametrize("bonded", [True, False])
def test_a_thin_compressible_film_is_a_bed_of_springs(bonded):
    """p = M (delta - r^2/2R)/h, confined modulus M or E/(1 - nu^2): Johnson 1985, section 5.8."""
    thickness, radius = WIDTH / 64, 0.35 * WIDTH
    M = E * 0.7 / (1.3 * 0.4) if bonded else E / (1.0 - 0.3**2)
    depth = radius**2 / (2.0 * R)
    run = solved(
        sheet(thickness, 0.3, bonded),
        ck.Pressing(force=math.pi * M * radius**4 / (4.0 * R * thickness)),
    )
    assert run.max_pressure == pytest.approx(M * depth / thickness, rel=1e-3)
    assert run.approach == pytest.approx(depth, rel=1e-3)
    assert math.sqrt(run.contact_area / math.pi) == pytest.approx(radius, rel=0.01)


def test_a_thin_incompressible_film_is_squeezed_like_a_viscous_one():
    """u = -(h^3/E) laplace p with p = p' = 0 at the edge: p = E (a^2 - r^2)^2/(32 R h^3)."""
    radius = 0.35 * WIDTH
    errors = []
    for thickness in (WIDTH / 32, WIDTH / 64):
        run = solved(
            sheet(thickness, 0.5),
            ck.Pressing(force=math.pi * E * radius**6 / (96.0 * R * thickness**3)),
        )
        errors.append(run.max_pressure / (E * radius**4 / (32.0 * R * thickness**3)) - 1.0)
        assert run.approach == pytest.approx(radius**2 / (4.0 * R), rel=0.05)
    assert abs(errors[1]) < 0.02
    assert abs(errors[1]) < 0.5 * abs(errors[0])


def test_a_thick_solid_is_a_half_space():
    rubber = ck.Material(young_modulus=E, poisson_ratio=0.3)
    thick = solved(sheet(100.0), ck.Pressing(force=1e-3))
    half = solved(ck.Stack(substrate=rubber), ck.Pressing(force=1e-3))
    np.testing.assert_allclose(thick.pressure, half.pressure, atol=1e-6 * half.max_pressure)
    assert thick.approach == pytest.approx(half.approach, rel=1e-4)


@pytest.mark.parametrize("bonded", [True, False])
def test_the_base_is_the_datum_of_a_periodic_approach(bonded):
    """A mean pressure compresses the solid; the rest is the same as of any datum."""
    thickness, load = 0.2 * WIDTH, 1e6
    run = solved(
        sheet(thickness, 0.3, bonded), ck.Pressing(pressure=load), WAVE, periodic=True, grid=32
    )
    C = uniform_compliance([E], [0.3], [thickness], "bonded")
    assert run.displacement.mean() == pytest.approx(C * load, rel=1e-9)
    assert run.approach_datum == "the rigid base of the bodies"
    back = solved(
        sheet(thickness, 0.3, bonded), ck.Approach(approach=run.approach), WAVE,
        periodic=True, grid=32,
    )  # fmt: skip
    assert back.mean_pressure == pytest.approx(load, rel=1e-7)


def test_any_approach_is_reached_above_a_base_that_gives_way():
    run = solved(sheet(WIDTH), ck.Approach(approach=1e-7), WAVE, periodic=True, grid=32)
    assert run.contact_fraction == 1.0
    flat = solved(sheet(WIDTH), ck.Approach(approach=1e-7), ck.Flat(), periodic=True, grid=32)
    M = E * 0.7 / (1.3 * 0.4)
    assert flat.mean_pressure == pytest.approx(M * 1e-7 / WIDTH, rel=1e-9)


def test_an_incompressible_solid_keeps_its_mean_thickness():
    run = solved(sheet(WIDTH, 0.5), ck.Pressing(pressure=1e6), WAVE, periodic=True, grid=32)
    assert abs(run.displacement.mean()) < 1e-12 * np.ptp(run.displacement)
    with pytest.raises(ck.InfeasibleError, match="mean plane of the heights"):
        solved(sheet(WIDTH, 0.5), ck.Approach(approach=1e-6), WAVE, periodic=True, grid=32)


@pytest.mark.parametrize("periodic", [True, False])
def test_two_sheets_give_way_twice_as_much(periodic):
    """Two equal bodies on bases, against a rigid one of half the heights under half the moduli."""
    both = solved(
        sheet(3e-6), ck.Pressing(pressure=1e6), WAVE, upper=sheet(3e-6), periodic=periodic, grid=32
    )
    soft = ck.Material(young_modulus=E / 2, poisson_ratio=0.3)
    one = solved(
        ck.Stack(
            layers=(ck.Layer(material=soft, thickness=3e-6),), substrate=ck.RigidBase(bonded=True)
        ),
        ck.Pressing(pressure=1e6), WAVE, periodic=periodic, grid=32,
    )  # fmt: skip
    np.testing.assert_allclose(both.pressure, one.pressure, atol=1e-6 * one.max_pressure)
    assert both.rigid_approach == pytest.approx(one.rigid_approach, rel=1e-6)


def test_a_base_under_one_of_two_bodies_names_both_datums():
    half = ck.Material(young_modulus=E, poisson_ratio=0.3)
    run = solved(sheet(3e-6), ck.Pressing(pressure=1e6), WAVE, upper=half, periodic=True, grid=32)
    assert "half-space, and the rigid base of the other" in run.approach_datum


def test_stress_reaches_down_to_the_base():
    effects = (ck.SubsurfaceStress(keep="planes"),)
    run = solved(sheet(3e-6), ck.Pressing(force=1e-3), effects=effects, grid=48)
    part = run.of(ck.SubsurfaceStress)
    assert part.depth.max() == pytest.approx(3e-6)
    assert part.side.count("-") == 1
    load = -part.planes[2, -1].sum() * (WIDTH / 48) ** 2
    assert load == pytest.approx(1e-3, rel=1e-3)  # what is pressed on arrives at the base


def test_a_sheet_survives_files_and_pickles(tmp_path):
    made = scene(sheet(3e-6, 0.45, bonded=False), ck.Pressing(force=1e-3))
    file = ck.save_scene(made, tmp_path / "sheet.toml")
    assert "bonded = false" in file.read_text()
    assert ck.load_scene(file) == made
    assert pickle.loads(pickle.dumps(made)) == made
    run = ck.solve(ck.plan(made, ck.Accuracy(grid=16)))
    again = from_bytes(to_bytes(run))
    assert again.approach == run.approach
    assert again.approach_datum == run.approach_datum


def test_the_plan_cites_the_base():
    of_sheet = ck.plan(scene(sheet(3e-6), ck.Pressing(force=1e-3)), ck.Accuracy(grid=16))
    assert "rigid base" in of_sheet.cite()
    half = ck.Stack(substrate=ck.Material(young_modulus=E, poisson_ratio=0.3))
    assert (
        "Sneddon" not in ck.plan(scene(half, ck.Pressing(force=1e-3)), ck.Accuracy(grid=16)).cite()
    )


def test_a_film_pressed_to_a_large_part_of_its_thickness_is_reported():
    run = solved(sheet(1e-7), ck.Pressing(force=1.0), grid=32)
    (number,) = [one for one in run.validity if one.name.startswith("displacement over")]
    assert not number.is_valid
    assert number.value == pytest.approx(run.displacement.max() / 1e-7)


test_what_a_base_cannot_do_is_refused_with_its_cure = each_refused(
    [
        (lambda: ck.Stack(substrate=ck.RigidBase(bonded=True)), "layers=.*Layer"),
        (lambda: ck.RigidBase(bonded="yes"), "bonded must be a bool"),
        (
            lambda: ck.plan(
                scene(sheet(1e-6), ck.Pressing(force=1.0), effects=(ck.HardnessLimit(),))
            ),
            "rule='material'",
        ),
        (
            lambda: ck.plan(
                scene(
                    sheet(1e-6, bonded=False),
                    ck.Pressing(force=1.0),
                    effects=(ck.FrictionTraction(coefficient=0.1),),
                )
            ),
            r"RigidBase\(bonded=True\)",
        ),
        (
            lambda: ck.plan(
                scene(
                    sheet(1e-6),
                    ck.Pressing(force=1.0),
                    effects=(ck.SubsurfaceStress(depths=(5e-7, 2e-6)),),
                )
            ),
            "at most 1e-06 m, where the rigid base begins",
        ),
        (
            lambda: solved(sheet(1e-9, 0.5), ck.Pressing(force=1e-3), grid=32),
            "incompressible.*finer Accuracy.grid",
        ),
    ],
    error=ck.ContactkitError,
)


def test_the_hardness_of_the_material_bounds_the_pressure_of_a_sheet():
    rubber = ck.Material(young_modulus=E, poisson_ratio=0.3, hardness=2e7)
    film = ck.Stack(
        layers=(ck.Layer(material=rubber, thickness=3e-6),), substrate=ck.RigidBase(bonded=True)
    )
    effects = (ck.HardnessLimit(rule="material"),)
    run = solved(film, ck.Pressing(force=2e-2), effects=effects, grid=48)
    assert run.max_pressure == pytest.approx(2e7, rel=1e-12)
    assert run.plastic_area > 0.0
