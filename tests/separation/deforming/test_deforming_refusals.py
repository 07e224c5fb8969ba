"""Scenes and numbers that the film of deforming bodies refuses: field, value, unit, cure."""

import math
from functools import partial

import attrs
import numpy as np
import pytest
from refusals import each_refused

import contactkit as ck
from contactkit.errors import DescriptionError, InfeasibleError, PlanError
from contactkit.fmu.native.deforming import exactness_of

pytestmark = pytest.mark.errors

OIL = ck.Liquid(name="oil", viscosity=0.1, surface_tension=0.03)
WATER = ck.Liquid(
    name="water", viscosity=1e-3, surface_tension=0.072, density=998.2, molar_mass=0.018015
)
GEL = ck.Material(name="gel", young_modulus=265e3, poisson_ratio=0.5)
STIFF = ck.Material(name="stiff", young_modulus=2e8, poisson_ratio=0.3)
FACE, BALL = ck.Flat(radius=5.66e-4), ck.Sphere(radius=5e-3)
FLOODED = ck.Meniscus(liquid=OIL)
VOLUME = ck.Meniscus(liquid=OIL, volume=1e-14)
PULL = ck.ImposedSpeed(speed=1e-5, initial_gap=1e-6, final_gap=5e-6)
PRESS = ck.PressAndPull(press=1e-4, rest=1e7, speed=1e-5, initial_gap=1e-6, final_gap=5e-6)
FORCE = ck.ImposedForce(force=2e-4, initial_gap=1e-6, final_gap=4e-6)
RIM, CUTOFF = ck.MeniscusForce(), ck.SolidContact(cutoff=2e-7)


def scene(*effects, loading=PULL, meniscus=FLOODED, solid=GEL, lower=FACE, upper=BALL):
    return ck.SeparationScene(
        interface=ck.Interface(
            lower=ck.Body(surface=lower, solid=solid), upper=upper, meniscus=meniscus
        ),
        loading=loading,
        effects=(ck.ElasticBodies(), ck.ViscousForce(), *effects),
    )


def planned(*effects, **given):
    return partial(lambda: ck.plan(scene(*effects, **given)))


def moist(humidity, **more):
    return ck.Meniscus(liquid=WATER, relative_humidity=humidity, **more)


def coated(thickness):
    layer = ck.Layer(material=GEL, thickness=thickness)
    return ck.Stack(layers=(layer,), substrate=ck.Material(young_modulus=1e9, poisson_ratio=0.3))


def without(kind):
    kept = tuple(one for one in scene().effects if not isinstance(one, kind))
    return partial(lambda: ck.plan(attrs.evolve(scene(), effects=kept)))


test_bodies = each_refused(
    [
        (planned(solid=None), r"both bodies are rigid; give interface\.lower\.solid"),
        (
            planned(lower=ck.Wave(amplitude=1e-8, wavelength=1e-5)),
            r"the film on a map has no rim: give a Flat\(radius=\.\.\.\) or Flat\(planform",
        ),
        (
            planned(RIM, meniscus=VOLUME, lower=ck.Wave(amplitude=1e-8, wavelength=1e-5)),
            r"interface\.lower\.surface is a Wave.* solved on rings; give a Flat, a Sphere",
        ),
        (
            planned(RIM, meniscus=VOLUME, upper=ck.Flat(radius=1e-4, tilt=(1e-4, 0.0))),
            r"interface\.upper\.surface is a Flat with heights.*; give a Flat, .* flood the film",
        ),
        (planned(lower=ck.Flat(), upper=ck.Flat()), r"give a radius \[m\]"),
        (
            planned(solid=coated(1e-7)),
            r"interface\.lower\.solid has a layer of 1e-07 m, less than 0\.02 of.* give a thicker",
        ),
        (
            partial(ck.Material, young_modulus=0.0, poisson_ratio=0.3),
            r"Material\.young_modulus must be positive and finite \[Pa\], got 0",
            DescriptionError,
        ),
        (
            partial(ck.Material, young_modulus=1e9, poisson_ratio=0.6),
            r"Material\.poisson_ratio must lie above -1 and not above 0\.5",
            DescriptionError,
        ),
    ],
    error=PlanError,
)

N, SIDE = 16, 8e-4
PIXEL = SIDE / N


def heights(periodic=None, size=PIXEL, holes=None):
    bumps = 1e-7 * np.cos(np.arange(N) - N // 2)[:, None] * np.ones(N)
    return ck.Heights(heights=bumps, pixel_size=size, is_periodic=periodic, holes=holes)


def rough(surface=None, **given):
    return {"upper": ck.CombinedSurface(parts=(BALL, surface or heights(**given)))}


NOT_MEASURED = np.arange(N * N).reshape(N, N) == N * N // 2 + N // 2
HALF = ck.Flat(radius=0.4 * SIDE)

test_maps = each_refused(
    [
        (
            planned(**rough(periodic=True), lower=ck.Flat()),
            r"interface\.upper\.surface repeats beyond its edges \(is_periodic=True\).*no rim.*"
            r"its mean gap could not change; give a Flat",
        ),
        (
            planned(**rough(), lower=ck.Flat(radius=SIDE)),
            r"wider than the height map: it reaches from x = -0\.0008 .* give a smaller",
        ),
        (
            planned(**rough(holes=NOT_MEASURED), lower=HALF),
            r"1 pixels of a height map within the film were not measured.*row 8, column 8: fill",
        ),
        (
            planned(**rough(), lower=HALF, loading=attrs.evolve(PULL, initial_gap=5e-8)),
            r"loading\.initial_gap = 5e-08 m the gap is closed at x = .* m, y = .* m \(row \d+, "
            r"column \d+\), where the bodies would overlap by 50 nm: start from more than",
        ),
        (
            planned(
                ck.SolidContact(cutoff=9e-8),
                **rough(),
                lower=HALF,
                loading=attrs.evolve(PULL, initial_gap=1.85e-7),
            ),
            r"the gap is 85 nm at x = .*below SolidContact\.cutoff: start from more than 190 nm",
        ),
        (
            partial(lambda: ck.plan(scene(), ck.Accuracy(grid=64))),
            r"Accuracy\.grid = 64 is not read: .* solved on rings; leave it out",
        ),
        (
            partial(lambda: ck.plan(scene(**rough(), lower=HALF), ck.Accuracy(grid=20))),
            r"Accuracy\.grid must be that of the height map, \(16, 16\), or left out, got 20",
            DescriptionError,
        ),
        (
            planned(lower=ck.Body(surface=heights(size=PIXEL / 2.0), solid=GEL).surface, **rough()),
            r"have surfaces of one grid.*resample one of the maps",
            DescriptionError,
        ),
        (
            planned(
                lower=ck.Flat(
                    radius=5e-4, holes=(ck.SealedHole(shape=ck.Disc(radius=1e-4), volume=1e-12),)
                )
            ),
            r"a SealedHole in a face that deforms is not known; give a Vent",
        ),
        (
            planned(
                lower=ck.Flat(
                    radius=5e-4,
                    roughness=ck.FineRoughness(
                        surface=ck.GaussianRoughness(
                            rms=1e-8, correlation_length=1e-6, cutoff=2e-7
                        ),
                        width=1e-5,
                    ),
                )
            ),
            r"Flat\.roughness acts by flow factors, .*; leave it out, or give heights",
        ),
        (
            planned(**rough(), lower=HALF, loading=attrs.evolve(PRESS, rest=1e6)),
            r"rest = 1e\+06 s drains the film to less than 2 nm at the highest peaks.*SolidContact",
        ),
        (
            partial(lambda: ck.simulate(ck.plan(scene(**rough(), lower=HALF)), fields_at=(9.0,))),
            r"simulate\.fields_at must lie within the motion, 0 to 0\.4 s \[s\], got 9\.0",
            DescriptionError,
        ),
        (
            partial(
                lambda: ck.simulate(
                    ck.plan(attrs.evolve(scene(solid=None), effects=(ck.ViscousForce(),))),
                    fields_at=(0.1,),
                )
            ),
            r"fields_at = \(0\.1,\) is read by plans with ElasticBodies alone: leave it out",
        ),
        (
            partial(lambda: ck.modulus_curve(scene(**rough(), lower=HALF), [1.0])),
            r"modulus_curve takes smooth round bodies, .* give a Flat without outline",
        ),
        (
            partial(lambda: exactness_of(scene(lower=attrs.evolve(FACE, tilt=(1e-5, 0.0))))),
            r"no FMU holds ElasticBodies on a face that is no even disc: .* without planform",
        ),
        (
            partial(
                lambda: ck.plan(
                    attrs.evolve(scene(solid=None), effects=(ck.ViscousForce(),)),
                    ck.Accuracy(grid=64),
                )
            ),
            r"Accuracy\.grid = 64 is not read by a SeparationScene with ImposedSpeed",
        ),
    ],
    error=PlanError,
)

test_liquid = each_refused(
    [
        (planned(meniscus=None), r"needs interface\.meniscus: the liquid and its amount"),
        (planned(meniscus=ck.Meniscus(liquid=ck.Liquid(name="x"))), r"viscosity \[Pa\.s\]"),
        (planned(meniscus=VOLUME), r"MeniscusForce\(\) is missing"),
        (planned(RIM), r"MeniscusForce needs.*volume \[m3\].*the film is flooded"),
        (planned(RIM, meniscus=attrs.evolve(VOLUME, count=2)), r"count exceeds 1"),
        (planned(RIM, meniscus=VOLUME, upper=ck.Flat(radius=1e-4)), "between two flats"),
        (planned(RIM, meniscus=VOLUME, solid=coated(1e-3)), "a rim that moves needs half-spaces"),
        (planned(RIM, ck.TensionLimit(), meniscus=VOLUME), "TensionLimit with a rim that moves"),
        (
            planned(
                RIM,
                meniscus=attrs.evolve(VOLUME, contact_angle_lower=2.0, contact_angle_upper=2.0),
            ),
            "contact angles must add up to less than 180 deg",
        ),
        (
            planned(RIM, meniscus=attrs.evolve(VOLUME, volume=1e-10), solid=STIFF),
            r"the meniscus of a radius of .* m reaches beyond the face of 0\.000566 m; give less",
        ),
        (planned(RIM, meniscus=moist(1.0)), "give a humidity below 1", InfeasibleError),
        (
            planned(RIM, meniscus=moist(0.5)),
            r"suction of the meniscus, 93\.\d+ MPa, is 265 of E\* = 353\.\d+ kPa.*up to 0\.1; give",
            InfeasibleError,
        ),
        (
            planned(
                RIM, meniscus=moist(0.99), solid=ck.Material(young_modulus=1e12, poisson_ratio=0.3)
            ),
            r"no meniscus spans loading\.initial_gap = 1e-06 m: .* one reaches \d+.* smaller gap",
            InfeasibleError,
        ),
        (planned(RIM, meniscus=VOLUME), r"they snap in at [\d.]+ um, with.*N;", InfeasibleError),
    ],
    error=PlanError,
)

test_effects = each_refused(
    [
        (without(ck.ViscousForce), r"ViscousForce\(\) is missing: it is the film"),
        (planned(ck.ShearLimit(strength=1e6)), "ShearLimit has no place in a film of deforming"),
        (planned(ck.TensionLimit(cavity="truncated")), "is a law of rigid bodies; leave cavity"),
        (planned(ck.SolidContact(cutoff=6e-7)), "cutoff is 6e-07 m of.*1e-06 m; .*twice the cut"),
        (
            partial(ck.SolidContact, cutoff=1e-10),
            r"SolidContact\.cutoff must be 2e-10 m at least.*got 1e-10",
            DescriptionError,
        ),
        (
            partial(ck.TensionLimit, strength=1e3, cavity_pressure=1e3),
            r"cavity_pressure must lie between 100325.*\[Pa\], got 1000",
            DescriptionError,
        ),
        (
            partial(ck.TensionLimit, cavity_pressure=-1e5),
            r"\[Pa\], got -100000.*it is absolute; .* less strength",
            DescriptionError,
        ),
    ],
    error=PlanError,
)

test_loading = each_refused(
    [
        (planned(loading=attrs.evolve(PULL, initial_gap=0.0)), r"initial_gap is 0 m: give the gap"),
        (
            planned(loading=ck.ImposedTime(time=1.0, initial_gap=1e-6, final_gap=2e-6)),
            "loading is a ImposedTime; impose a speed or a force, or PressAndPull",
        ),
        (
            planned(loading=attrs.evolve(FORCE, rest_gap=1e-7)),
            r"list SolidContact\(cutoff=\.\.\.\)",
        ),
        (planned(loading=attrs.evolve(FORCE, force=-1e-4)), "never opens the gap: to press first"),
        (
            planned(loading=attrs.evolve(FORCE, mass=1e-3, initial_speed=1e-3)),
            "initial_speed is that of a film at rest: leave it out",
        ),
        (
            planned(loading=PRESS),
            r"loading\.rest = 1e\+07 s drains the film to less than 2 nm.*list SolidContact",
        ),
        (
            planned(loading=attrs.evolve(PRESS, press=1.0), upper=ck.Flat(radius=1e-4)),
            r"loading\.rest = 1e\+07 s drains the film to less than 2 nm.*list SolidContact",
        ),
        (
            planned(CUTOFF, loading=attrs.evolve(PRESS, press=1e-2)),
            r"press = 10 mN presses .* radius of .* um, more than 0\.5 .* 566 um; press",
        ),
        (
            planned(RIM, loading=FORCE, meniscus=VOLUME, solid=STIFF),
            r"force = 200 uN never parts .* 421\.\d uN at loading\.initial_gap = 1e-06 m.*"
            r"touch at 59\.\d+ nm, .* 1\.8\d+ mN; pull harder",
            InfeasibleError,
        ),
        (
            partial(
                ck.PressAndPull, press=math.nan, rest=1.0, speed=1.0, initial_gap=1.0, final_gap=2.0
            ),
            r"PressAndPull\.press must be positive and finite \[N\], got nan",
            DescriptionError,
        ),
        (
            partial(ck.PressAndPull, press=1.0, rest=1.0, initial_gap=1e-6, final_gap=2e-6),
            "exactly one of",
            DescriptionError,
        ),
        (
            partial(attrs.evolve, PRESS, final_gap=5e-7),
            r"final_gap must exceed initial_gap = 1e-06 m \[m\], got 5e-07",
            DescriptionError,
        ),
    ],
    error=PlanError,
)


def test_a_short_rest_between_flats_needs_no_cutoff():
    short = attrs.evolve(PRESS, press=1.0, rest=1.0)
    assert ck.plan(scene(loading=short, upper=ck.Flat(radius=1e-4)))


def test_rigid_bodies_refuse_what_deforms():
    with pytest.raises(PlanError, match=r"ElasticBodies\(\)"):
        ck.plan(attrs.evolve(scene(loading=PRESS), effects=(ck.ViscousForce(),)))
    with pytest.raises(PlanError, match=r"ElasticBodies\(\)"):
        ck.plan(attrs.evolve(scene(), effects=(ck.ViscousForce(), CUTOFF)))


def test_a_pull_above_the_meniscus_is_planned():
    """The refusal of weaker pulls ends at the force of the meniscus itself."""
    made = scene(RIM, loading=attrs.evolve(FORCE, force=4.3e-4), meniscus=VOLUME, solid=STIFF)
    assert ck.plan(made).laplace_pressure > 0.0
