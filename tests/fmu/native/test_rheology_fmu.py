"""FMUs of films with a rheology: refused by name, never Newtonian unasked; slip is tabulated."""

from __future__ import annotations

import math

import pytest
from refusals import refuses

import contactkit as ck
from contactkit.fmu.native.film import moving, prepared_film
from contactkit.fmu.native.tables import tabulate
from contactkit.fmu.slaves.stiction_mass import mass_values
from contactkit.liquids.rheology.pressure import BarusViscosity

BARUS = BarusViscosity(pressure_coefficient=2e-8)


def scene(*effects, pressure_viscosity=None, body=None, **more):
    oil = ck.Liquid(name="oil", viscosity=0.1, pressure_viscosity=pressure_viscosity)
    return ck.SeparationScene(
        interface=ck.Interface(
            lower=ck.Flat(radius=1e-3),
            upper=body or ck.Flat(radius=1e-3),
            meniscus=ck.Meniscus(liquid=oil, **more),
        ),
        loading=ck.ImposedForce(force=1.0, mass=0.1, initial_gap=2e-6, final_gap=1e-5),
        effects=effects or (ck.ViscousForce(),),
    )


def test_a_native_fmu_refuses_a_viscosity_over_pressure():
    """Also one that the pull of the scene does not call for: in a host it may be any."""
    given = scene(pressure_viscosity=BARUS)
    assert ck.plan(given).prepared.rheology.computed == ()
    refuses(
        lambda: prepared_film(moving(given, None)),
        "a native FMU has no form of a viscosity over pressure or shear",
        'ViscousForce(rheology="newtonian")',
        error=ck.PlanError,
    )
    prepared_film(moving(scene(ck.ViscousForce(rheology="newtonian")), None))


def test_the_python_fmu_refuses_it_too():
    refuses(
        lambda: mass_values(scene(pressure_viscosity=BARUS)),
        "the Python FMU stiction-mass has one viscosity",
        'ViscousForce(rheology="newtonian")',
        error=ck.PlanError,
    )
    newtonian = ck.ViscousForce(rheology="newtonian")
    assert mass_values(scene(newtonian, pressure_viscosity=BARUS)) == mass_values(scene())
    refuses(lambda: mass_values(scene(slip_length_lower=1e-7)), "slip", error=ck.PlanError)


@pytest.mark.slow
@pytest.mark.parametrize("body", [None, ck.Sphere(radius=1e-2)], ids=["flats", "sphere"])
def test_a_native_fmu_tabulates_slip(body):
    given = moving(scene(body=body, slip_length_lower=1e-7, slip_length_upper=1e-7), None)
    gap, x = 3e-6, 6.0 * 1e-7 / 3e-6
    found, plain = (tabulated(one, gap) for one in (given, moving(scene(body=body), None)))
    factor = 1.0 / (1.0 + x)
    if body is not None:  # of an immersed sphere; the rim changes less than 1 %
        factor = 2.0 / x * ((1.0 + 1.0 / x) * math.log1p(x) - 1.0)
    assert found / plain == pytest.approx(factor, rel=1e-9 if body is None else 1e-2)


def tabulated(given, gap):
    """Force per speed and viscosity [m] that the first table of a scene is made of, at a gap."""
    forces = []

    def make(force, edges, **more):
        forces.append(force)
        return tabulate(force, edges, **more)

    prepared_film(given, make=make)
    return forces[0](gap)


def test_a_cut_off_pressure_under_a_sphere_that_slips_is_refused():
    limit = ck.TensionLimit(strength=1e6, cavity="truncated")
    slips = scene(ck.ViscousForce(), limit, body=ck.Sphere(radius=1e-2), slip_length_lower=1e-7)
    refuses(
        lambda: prepared_film(moving(slips, None)),
        "a native FMU cuts off the pressure under a sphere",
        error=ck.PlanError,
    )
