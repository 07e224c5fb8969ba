"""Only the effects a sliding calls for: every kernel they do not own raises, and the scene runs."""

from __future__ import annotations

import importlib
import math
import pkgutil
import subprocess
import sys

import pytest

import contactkit as ck
from contactkit.separation import simulate as separation
from contactkit.separation.sliding.effects import SLIDING_EFFECTS

pytestmark = pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning")

WATER = ck.Liquid(name="water", viscosity=1e-3, surface_tension=0.07, density=1e3)
BODIES = {"flats": ck.Flat(), "sphere": ck.Sphere(radius=1e-6)}
SHEAR, LOCAL = ck.ShearLimit(strength=1e5), {"lubrication.couette_sphere.sphere_drag"}
EVEN = {"lubrication.couette_flat.lens_area", "lubrication.couette_flat.flat_impulse"}
# What each effect may call, by the body above the flat.
OWNED = {
    ck.CouetteForce(): {"flats": EVEN, "sphere": LOCAL},
    ck.CouetteForce(closure="lubrication"): {
        "flats": EVEN,
        "sphere": LOCAL | {"lubrication.couette_reynolds.lubrication_factor"},
    },
    ck.CouetteForce(closure="as-published"): {"flats": EVEN, "sphere": EVEN},
    ck.ContactAngleHysteresis(advancing_lower=1.0, receding_lower=0.8): {
        body: {
            "lubrication.couette_flat.hysteresis_force",
            "lubrication.couette_flat.lens_width",
            "lubrication.couette_flat.lens_area",
        }
        for body in BODIES
    },
    SHEAR: {
        body: {"lubrication.couette_flat.limited_stress", "numerics.quadrature.gauss_legendre"}
        for body in BODIES
    },
}
SETS = [
    *(
        (effect, *more)
        for effect in OWNED
        if effect is not SHEAR
        for more in ((), tuple(e for e in OWNED if isinstance(e, ck.ContactAngleHysteresis)))
        if effect not in more
    ),
    (ck.CouetteForce(), SHEAR),
]
# What is no effect's: how far the film reaches, the overlap, the ranges of validity.
FRAME = {
    "lubrication.couette_flat.lens_area",
    "lubrication.couette_sphere.wetted_radius",
    "lubrication.squeeze_film.disc_radius",
    "lubrication.squeeze_film.sphere_film_height",
    "lubrication.dimensionless.reynolds_number",
    "lubrication.dimensionless.slenderness",
}


KERNEL_ROOMS = (
    "adhesion",
    "as_published.printed",
    "capillary",
    "contact.effects.hardness_rules",
    "contact.solver",
    "elasticity",
    "lubrication",
    "numerics",
    "roughness",
    "separation.integrator",
)


class PoisonError(Exception):
    """A kernel was called that no effect of the scene owns."""


def kernels():
    """Public functions of the physics and the numerics, by module and name."""
    found = {}
    for room in KERNEL_ROOMS:
        package = importlib.import_module(f"contactkit.{room}")
        paths = getattr(package, "__path__", None)
        inside = pkgutil.walk_packages(paths, f"contactkit.{room}.") if paths else ()
        for name in [package.__name__, *(info.name for info in inside)]:
            module = importlib.import_module(name)
            for public in getattr(module, "__all__", ()):
                value = getattr(module, public)
                is_own = getattr(value, "__module__", "") == name
                if callable(value) and not isinstance(value, type) and is_own:
                    found[f"{name.removeprefix('contactkit.')}.{public}"] = value
    return found


KERNELS = kernels()


def poison(monkeypatch, names):
    poisoned = {id(KERNELS[name]): name for name in names}

    def raising(name):
        def raises(*_args, **_kwargs):
            raise PoisonError(name)

        return raises

    for module in [m for name, m in sys.modules.items() if name.startswith("contactkit") and m]:
        for attribute, value in list(vars(module).items()):
            if id(value) in poisoned:
                monkeypatch.setattr(module, attribute, raising(poisoned[id(value)]))


def run(effects, body, imposed):
    film = ck.Meniscus(liquid=WATER, volume=math.pi * 1e-6 * 3e-16)
    scene = ck.SlidingScene(
        interface=ck.Interface(upper=BODIES[body], meniscus=film),
        sliding=ck.Sliding(gap=1e-8, **{imposed: 1e-3}),
        effects=effects,
    )
    return separation.simulate(ck.plan(scene))


@pytest.mark.parametrize("imposed", ["speed", "time"])
@pytest.mark.parametrize("body", BODIES)
@pytest.mark.parametrize("effects", SETS, ids=lambda es: "+".join(str(e)[:40] for e in es))
def test_a_sliding_runs_with_every_other_kernel_poisoned(monkeypatch, effects, body, imposed):
    if SHEAR in effects and imposed == "time":
        return
    mine = FRAME.union(*(OWNED[effect][body] for effect in effects))
    if body == "sphere" and any(isinstance(e, ck.CouetteForce) for e in effects):
        mine |= {"lubrication.couette_sphere.sphere_impulse"}
    poison(monkeypatch, KERNELS.keys() - mine)
    assert run(effects, body, imposed).status == "parted"


@pytest.mark.parametrize(
    ("effects", "body", "heart"),
    [
        ((ck.CouetteForce(),), "flats", "lubrication.couette_flat.flat_impulse"),
        ((ck.CouetteForce(),), "sphere", "lubrication.couette_sphere.sphere_drag"),
        (
            (ck.CouetteForce(closure="lubrication"),),
            "sphere",
            "lubrication.couette_reynolds.lubrication_factor",
        ),
        ((ck.CouetteForce(), SHEAR), "sphere", "lubrication.couette_flat.limited_stress"),
    ],
)
def test_the_poison_works_on_a_kernel_that_is_needed(monkeypatch, effects, body, heart):
    poison(monkeypatch, [heart])
    with pytest.raises(PoisonError, match=heart):
        run(effects, body, "speed")


def test_every_sliding_effect_and_closure_is_poisoned():
    assert {type(effect) for effect in OWNED} == {*SLIDING_EFFECTS, ck.ShearLimit}
    closures = {effect.closure for effect in OWNED if isinstance(effect, ck.CouetteForce)}
    assert closures == {"local-film", "lubrication", "as-published"}


def test_a_sliding_is_described_without_numpy():
    code = (
        "import sys; sys.modules['numpy'] = None\n"
        "import contactkit as ck\n"
        "ck.SlidingScene(interface=ck.Interface(meniscus=ck.Meniscus(liquid=ck.Liquid(name='x'))),"
        " sliding=ck.Sliding(gap=1e-9, speed=1.0), effects=(ck.CouetteForce(),))"
    )
    subprocess.run([sys.executable, "-c", code], check=True)
