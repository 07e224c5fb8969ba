"""Only the effects a sliding calls for: every kernel they do not own raises, and the scene runs."""

from __future__ import annotations

import math
import subprocess
import sys

import pytest
from poison import label, poison_all_but, survives, unknown

import contactkit as ck
from contactkit.kinds import SLIDING_EFFECTS
from contactkit.separation import simulate as separation

pytestmark = pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning")

WATER = ck.Liquid(name="water", viscosity=1e-3, surface_tension=0.07, density=1e3)
BODIES = {"flats": ck.Flat(), "sphere": ck.Sphere(radius=1e-6)}
SHEAR = ck.ShearLimit(strength=1e5)
HYSTERESIS = ck.ContactAngleHysteresis(advancing_lower=1.0, receding_lower=0.8)
LENS = {"lubrication.couette_flat.lens_*"}
EVEN = {"lubrication.couette_flat.flat_impulse", *LENS}
LOCAL = {"lubrication.couette_sphere.*"}
ARC = {"capillary.arc.flat.*", "capillary.arc.shape.*"}
ARC_UNDER_SPHERE = {f"capillary.arc.{part}.*" for part in ("contact_circles", "shape", "sphere")}
# What each effect may call, by the body above the flat.
OWNED = {
    ck.CouetteForce(): {"flats": EVEN, "sphere": LOCAL},
    ck.CouetteForce(closure="lubrication"): {
        "flats": EVEN,
        "sphere": LOCAL | {"lubrication.couette_reynolds.*"},
    },
    ck.CouetteForce(closure="as-published"): {
        "flats": EVEN | ARC,
        "sphere": EVEN | LOCAL | ARC_UNDER_SPHERE,
    },
    HYSTERESIS: {body: LENS | {"lubrication.couette_flat.hysteresis_force"} for body in BODIES},
    SHEAR: {body: {"lubrication.couette_flat.limited_stress"} for body in BODIES},
}
# What is no effect's: how far the film reaches, the overlap, the ranges of validity.
FRAME = {
    "lubrication.couette_flat.lens_area",
    "lubrication.couette_sphere.wetted_radius",
    "lubrication.squeeze_film.disc_radius",
    "lubrication.squeeze_film.sphere_film_height",
    "lubrication.dimensionless.reynolds_number",
    "lubrication.dimensionless.slenderness",
}


def cases():
    """Each effect alone and with the others it goes with, at a speed or in a time."""
    couette = [effect for effect in OWNED if isinstance(effect, ck.CouetteForce)]
    alone = [(effect,) for effect in (*couette, HYSTERESIS)]
    beside = [(effect, HYSTERESIS) for effect in couette]
    for effects in (*alone, *beside):
        for body in BODIES:
            for imposed in ("speed", "time"):
                yield effects, body, imposed
    for body in BODIES:  # a limited stress has no time that is known beforehand
        yield (ck.CouetteForce(), SHEAR), body, "speed"


def run(effects, body, imposed):
    film = ck.Meniscus(liquid=WATER, volume=math.pi * 1e-6 * 3e-16)
    scene = ck.SlidingScene(
        interface=ck.Interface(upper=BODIES[body], meniscus=film),
        loading=ck.Sliding(gap=1e-8, **{imposed: 1e-3}),
        effects=effects,
    )
    return separation.simulate(ck.plan(scene))


@pytest.mark.parametrize(("effects", "body", "imposed"), [*cases()], ids=label)
def test_a_sliding_runs_with_every_other_kernel_poisoned(monkeypatch, effects, body, imposed):
    poison_all_but(monkeypatch, FRAME.union(*(OWNED[effect][body] for effect in effects)))
    assert run(effects, body, imposed).status == "parted"


HEARTS = [
    ((ck.CouetteForce(),), "flats", "lubrication.couette_flat.flat_impulse"),
    ((ck.CouetteForce(),), "sphere", "lubrication.couette_sphere.sphere_drag"),
    (
        (ck.CouetteForce(closure="lubrication"),),
        "sphere",
        "lubrication.couette_reynolds.lubrication_factor",
    ),
    ((ck.CouetteForce(), SHEAR), "sphere", "lubrication.couette_flat.limited_stress"),
]


def test_without_its_own_kernel_nothing_slides(monkeypatch):
    """The negative control."""
    immune = [
        f"{body}: {heart}"
        for effects, body, heart in HEARTS
        if survives(monkeypatch, heart, lambda e=effects, b=body: run(e, b, "speed"))
    ]
    assert immune == []


def test_the_table_names_kernels_that_exist():
    patterns = {name for bodies in OWNED.values() for names in bodies.values() for name in names}
    assert unknown(patterns | FRAME) == []


def test_every_sliding_effect_and_closure_is_poisoned():
    assert {type(effect) for effect in OWNED} == {*SLIDING_EFFECTS, ck.ShearLimit}
    closures = {effect.closure for effect in OWNED if isinstance(effect, ck.CouetteForce)}
    assert closures == {"local-film", "lubrication", "as-published"}


def test_a_sliding_is_described_without_numpy():
    code = (
        "import sys; sys.modules['numpy'] = None\n"
        "import contactkit as ck\n"
        "ck.SlidingScene(interface=ck.Interface(meniscus=ck.Meniscus(liquid=ck.Liquid(name='x'))),"
        " loading=ck.Sliding(gap=1e-9, speed=1.0), effects=(ck.CouetteForce(),))"
    )
    subprocess.run([sys.executable, "-c", code], check=True)
