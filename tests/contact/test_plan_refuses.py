"""What a plan accepts is solved: only what no plan can know is refused by a solve."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from selection import quick

import contactkit as ck

pytestmark = [
    pytest.mark.errors,
    pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning"),
]

N = 8
HARD = ck.Material(name="hard", young_modulus=280e9, poisson_ratio=0.25, hardness=24e9)
SOFT = ck.Material(name="soft", young_modulus=100e9, poisson_ratio=0.3, hardness=2e9)
COATED = ck.Stack(layers=(ck.Layer(material=HARD, thickness=5e-9),), substrate=SOFT)
FILM = {"film_thickness": 1e-9}

SURFACES = {
    "rough": ck.SelfAffineRoughness(rms=1e-9, hurst=0.8, rolloff=4e-7, cutoff=2.6e-7),
    "too fine": ck.SelfAffineRoughness(rms=1e-9, hurst=0.8, rolloff=4e-7, cutoff=2e-7),
    "wave": ck.Wave(amplitude=1e-9, wavelength=1e-6),
    "wave that does not fit": ck.Wave(amplitude=1e-9, wavelength=0.7e-6),
    "small sphere": ck.Sphere(radius=0.8e-6),
}
EFFECTS = {
    "none": (),
    "hardness": (ck.HardnessLimit(),),
    "local hardness": (ck.HardnessLimit(rule=ck.ContinuousHardness(displacement="local")),),
    "literal hardness": (ck.HardnessLimit(rule="literal"),),
    "no hardness": (
        ck.HardnessLimit(rule=ck.ConstantHardness(hardness=ck.HardnessMap(np.zeros((N, N))))),
    ),
    "other map": (
        ck.HardnessLimit(rule=ck.ConstantHardness(hardness=ck.HardnessMap(np.ones((2, 3))))),
    ),
    "stress": (ck.SubsurfaceStress(),),
    "stress far below": (ck.SubsurfaceStress(depths=(0.0, 1.0), window=1.0),),
    "friction": (ck.FrictionTraction(coefficient=1.0), ck.FrictionCoupling()),
    "film": (ck.FilmMeniscus(**FILM),),
    "film that pulls": (ck.FilmMeniscus(self_consistent=True, **FILM),),
    "flooded": (ck.FilmMeniscus(film_thickness=1.0),),
    "islands": (ck.IslandBridges(**FILM),),
    "low islands": (ck.IslandBridges(meniscus_height=1e-12, **FILM),),
    "islands of nothing": (ck.IslandBridges(),),
}
LOADS = {
    "pressed": ck.Pressing(pressure=1e7),
    "crushed": ck.Pressing(pressure=1e10),
    "not pressed": ck.Pressing(force=0.0),
    "brought through": ck.Approach(approach=1e-6),
    "held off": ck.Approach(approach=-1e-9),
}


def scene(surface, effects, loading, periodic):
    meniscus = ck.Meniscus(
        liquid=ck.load_liquid("water"), contact_angle_lower=1.0, contact_angle_upper=1.0
    )
    return ck.ContactScene(
        interface=ck.Interface(lower=ck.Body(solid=COATED), upper=surface, meniscus=meniscus),
        window=ck.Window(width=1e-6, periodic=periodic),
        loading=loading,
        effects=(ck.LayeredHalfSpace(), *effects),
    )


def refused(plan):
    """Why a solve refuses its plan; how soft a load makes the solid, only a solve knows."""
    try:
        ck.solve(plan)
    except ck.ConvergenceError:
        return ""
    except ck.ContactkitError as error:
        return "" if "at the displacement" in str(error) else str(error)
    return ""


@pytest.mark.parametrize("surface", quick(SURFACES, long=[0, 1]))
def test_a_solve_refuses_nothing_that_its_plan_accepts(surface):
    solved, refusals = 0, {}
    for effects, loading, periodic in itertools.product(EFFECTS, LOADS, (True, False)):
        given = scene(SURFACES[surface], EFFECTS[effects], LOADS[loading], periodic)
        try:
            plan = ck.plan(given, ck.Accuracy(grid=N, rtol=1e-4))
        except (ck.DescriptionError, ck.PlanError, ck.InfeasibleError):
            continue
        if refusal := refused(plan):
            refusals[effects, loading, periodic] = refusal
        solved += 1
    assert refusals == {}
    assert (solved == 0) == (surface == "too fine")
