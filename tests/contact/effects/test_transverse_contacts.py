"""Contacts of transversely isotropic bodies: Hertz, layers, creep, and what refuses them."""

from __future__ import annotations

import numpy as np
import pytest
from attrs import evolve

import contactkit as ck
from contactkit.errors import DescriptionError, PlanError

GRAPHITE = ck.TransverselyIsotropicMaterial.from_stiffness(
    1060e9, 180e9, 15e9, 36.5e9, 4.5e9, name="graphite"
)
STEEL = ck.Material(name="steel", young_modulus=210e9, poisson_ratio=0.3)
HALF, LAYERED = ck.HalfSpace(), ck.LayeredHalfSpace()


def coated(material, thickness=1e-6, substrate=STEEL):
    return ck.Stack(layers=(ck.Layer(material=material, thickness=thickness),), substrate=substrate)


def ball(solid, *effects, periodic=False, force=1e-3):
    return ck.ContactScene(
        interface=ck.Interface(
            lower=ck.Body(solid=solid), upper=ck.Body(surface=ck.Paraboloid(radius=20e-6))
        ),
        window=ck.Window(width=3e-6, periodic=periodic),
        loading=ck.Pressing(force=force),
        effects=effects,
    )


def solved(scene, grid=24):
    return ck.solve(ck.plan(scene, ck.Accuracy(grid=grid)))


def test_stiffnesses_are_those_given():
    given = {"c11": 160.0, "c12": 30.0, "c13": 50.0, "c33": 60.0, "c44": 40.0}
    made = ck.TransverselyIsotropicMaterial.from_stiffness(**given)
    e1, e3, nu, along = made.young_modulus, made.axial_modulus, made.poisson_ratio, made.axial_ratio
    compliance = [
        [1.0 / e1, -nu / e1, -along / e3],
        [-nu / e1, 1.0 / e1, -along / e3],
        [-along / e3, -along / e3, 1.0 / e3],
    ]
    c11, c12, c13, c33, _ = given.values()
    stiffness = [[c11, c12, c13], [c12, c11, c13], [c13, c13, c33]]
    np.testing.assert_allclose(np.linalg.inv(compliance), stiffness, rtol=1e-12)
    assert made.shear_modulus == 40.0


@pytest.mark.parametrize("solid", [GRAPHITE, coated(GRAPHITE, 1e-3)], ids=["half-space", "thick"])
def test_a_ball_meets_the_indentation_modulus(solid):
    result = solved(ball(solid, LAYERED if isinstance(solid, ck.Stack) else HALF), grid=48)
    force, radius, modulus = 1e-3, 20e-6, GRAPHITE.plane_strain_modulus
    peak = (6.0 * force * modulus**2 / (np.pi**3 * radius**2)) ** (1 / 3)
    assert float(result.pressure.max()) == pytest.approx(peak, rel=0.01)
    approach = (9.0 * force**2 / (16.0 * radius * modulus**2)) ** (1 / 3)
    assert result.approach == pytest.approx(approach, rel=0.01)


@pytest.mark.parametrize("periodic", [True, False, "x"])
def test_isotropic_constants_are_an_isotropic_coating(periodic):
    same = ck.TransverselyIsotropicMaterial(
        young_modulus=400e9, axial_modulus=400e9, poisson_ratio=0.3, axial_ratio=0.3,
        shear_modulus=400e9 / 2.6,
    )  # fmt: skip
    found = solved(ball(coated(same, 3e-7), LAYERED, periodic=periodic))
    plain = ck.Material(young_modulus=400e9, poisson_ratio=0.3)
    expected = solved(ball(coated(plain, 3e-7), LAYERED, periodic=periodic))
    assert found.status == "converged"
    peak = float(expected.pressure.max())
    np.testing.assert_allclose(found.pressure, expected.pressure, rtol=0.0, atol=1e-6 * peak)


def test_a_soft_axis_gives_way_under_a_ball_and_is_cited():
    soft, stiff = (solved(ball(coated(one), LAYERED)) for one in (GRAPHITE, STEEL))
    assert soft.approach > 1.5 * stiff.approach
    assert "elliott1948" in ck.cite(soft).keys
    assert "elliott1948" not in ck.cite(stiff).keys


def test_a_substrate_creeps_below_a_layer_with_an_axis():
    gel = ck.ViscoelasticMaterial(young_modulus=1e9, fractions=0.5, times=1.0, poisson_ratio=0.3)
    creep = ck.Viscoelasticity(times=1e4, steps=1)
    late = solved(ball(coated(GRAPHITE, 2e-7, gel), LAYERED, creep, force=3e-5))
    rested = solved(ball(coated(GRAPHITE, 2e-7, gel.equilibrium), LAYERED, force=3e-5))
    peak = float(rested.pressure.max())
    np.testing.assert_allclose(late.pressure, rested.pressure, rtol=0.0, atol=1e-3 * peak)


def test_a_bound_of_one_hardness_needs_no_modulus():
    elastic = float(solved(ball(coated(GRAPHITE), LAYERED)).pressure.max())
    hard = evolve(GRAPHITE, hardness=0.9 * elastic)
    limit = ck.HardnessLimit(rule="material")
    found = solved(ball(coated(hard), LAYERED, limit))
    assert float(found.pressure.max()) == pytest.approx(0.9 * elastic, rel=1e-9)


def test_a_mistaken_unit_of_the_axis_shows():
    slip = evolve(GRAPHITE, axial_modulus=36.0, axial_ratio=0.0)  # GPa
    with pytest.warns(ck.ValidityWarning, match=r"Young's modulus \[Pa\] = 36 .*graphite"):
        ck.solve(ck.plan(ball(slip, HALF, force=1e-9), ck.Accuracy(grid=16)))


SLIP = ck.PartialSlip(coefficient=0.2, path=(ck.TangentialStep(ratio=0.5),))
FRICTION = ck.FrictionTraction(coefficient=0.2)


@pytest.mark.errors
@pytest.mark.parametrize("solid", [GRAPHITE, coated(GRAPHITE)], ids=["half-space", "coating"])
@pytest.mark.parametrize(
    "effects",
    [(SLIP,), (FRICTION, ck.FrictionCoupling()), (ck.SubsurfaceStress(),)],
    ids=["slip", "coupling", "stress"],
)
def test_effects_of_isotropic_bodies_refuse_by_name(effects, solid):
    law = LAYERED if isinstance(solid, ck.Stack) else HALF
    name = type(effects[-1]).__name__
    expected = f"{name} needs isotropic bodies, and graphite is transversely isotropic; leave"
    with pytest.raises(PlanError, match=expected):
        ck.plan(ball(solid, law, *effects), ck.Accuracy(grid=16))


@pytest.mark.errors
def test_an_effective_hardness_of_layers_needs_isotropic_ones():
    hard = coated(evolve(GRAPHITE, hardness=5e8), substrate=evolve(STEEL, hardness=7e9))
    with pytest.raises(PlanError, match=r"isotropic layers with rule='continuous'.*ConstantHard"):
        ck.plan(ball(hard, LAYERED, ck.HardnessLimit()), ck.Accuracy(grid=16))


@pytest.mark.errors
def test_moduli_of_an_axis_are_no_young_moduli():
    with pytest.raises(PlanError, match=r"graphite is transversely isotropic.*poisson_ratio=0\.0"):
        _ = coated(GRAPHITE).young_moduli
    gel = ck.ViscoelasticMaterial(young_modulus=1e9, fractions=0.5, times=1.0, poisson_ratio=0.3)
    with pytest.raises(PlanError, match="viscoelastic"):
        _ = gel.plane_constants


FIELDS = {
    "young_modulus": 1e9,
    "axial_modulus": 2e9,
    "poisson_ratio": 0.3,
    "axial_ratio": 0.1,
    "shear_modulus": 4e8,
}


@pytest.mark.errors
@pytest.mark.parametrize(
    ("changed", "message"),
    [
        ({"axial_ratio": 1.4}, r"axial_ratio must be at most .* in size.*nu_31"),
        ({"poisson_ratio": 1.0}, r"poisson_ratio must lie above -1 and below 1"),
        ({"axial_modulus": 0.0}, r"axial_modulus must be positive"),
        ({"shear_modulus": -1.0}, r"shear_modulus must be positive"),
    ],
    ids=lambda one: next(iter(one)) if isinstance(one, dict) else "",
)
def test_a_solid_that_releases_energy_is_refused(changed, message):
    with pytest.raises(DescriptionError, match=message):
        ck.TransverselyIsotropicMaterial(**FIELDS | changed)


@pytest.mark.errors
def test_a_stiffness_that_releases_energy_is_refused():
    with pytest.raises(DescriptionError, match=r"from_stiffness.*2 c13\^2 below"):
        ck.TransverselyIsotropicMaterial.from_stiffness(1e9, 5e8, 9e8, 1e9, 4e8)
