"""Only the effects a scene calls for: every kernel they do not own raises, and the scene runs."""

from __future__ import annotations

import functools
import importlib
import importlib.resources
import itertools
import pkgutil
import sys
from pathlib import Path

import numpy as np
import pytest
import scipy.fft

import contactkit as ck
from contactkit.contact.effects.registry import CONTACT_EFFECTS
from contactkit.contact.solve import solve
from contactkit.separation import simulate as separation
from contactkit.separation.effects.as_published import mixed
from contactkit.separation.effects.registry import SEPARATION_EFFECTS

pytestmark = pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning")

FACE = ck.Flat(radius=1e-4)
BODIES = {"flats": FACE, "sphere": ck.Sphere(radius=1e-2)}
OIL = ck.Liquid(name="oil", viscosity=0.1, surface_tension=0.03, density=900.0)

# What each effect may call, by the body above the flat. `*` stands for the rest of a name.
ARC_FLAT = {
    "capillary.arc.flat.contact_radius",
    "capillary.arc.flat.force",
    "capillary.arc.flat.rim_contact_radius",
    "capillary.arc.flat.volume",
    "capillary.arc.flat.zero_neck_gap",
    "capillary.arc.flat.zero_neck_gap_at_rim",
    "capillary.arc.shape.*",
    "numerics.quadrature.gauss_legendre",
    "numerics.roots.bracketed_root",
}
ARC_SPHERE = {
    "capillary.arc.sphere.solve",
    "capillary.arc.sphere.zero_neck_gap",
    "capillary.arc.contact_circles.*",
    "capillary.arc.shape.refuse_spreading",
    "capillary.arc.shape.whole_angle",
    "numerics.cubic_spline.*",
}
EXACT_FLAT_END = {
    "capillary.flats.force_law.*",
    "capillary.flats.family.*",
    "capillary.exact.delaunay.*",
    "capillary.arc.shape.*",
    "numerics.quadrature.gauss_legendre",
    "numerics.roots.bracketed_root",
}
EXACT_FLAT = EXACT_FLAT_END | {"numerics.cubic_spline.*", "capillary.flats.sampling.*"}
EXACT_SPHERE = {
    "capillary.exact.*",
    "capillary.exact.volume_branch.drop_left",
    "capillary.exact.delaunay.*",
    "numerics.quadrature.gauss_legendre",
    "numerics.roots.*",
    *ARC_SPHERE,
}
OWNED = {
    ck.MeniscusForce(): {"flats": EXACT_FLAT, "sphere": EXACT_SPHERE},
    ck.MeniscusForce(profile="arc"): {"flats": ARC_FLAT, "sphere": ARC_SPHERE},
    ck.MeniscusForce(profile="as-published"): {
        "flats": {
            "as_published.printed.common.meniscus_flat_3_11",
            "as_published.printed.common.meniscus_divided_3_33",
            "capillary.arc.shape.wetting",
        },
        "sphere": {"as_published.printed.common.meniscus_sphere_3_12", *ARC_SPHERE},
    },
    ck.ViscousForce(): {
        "flats": {"lubrication.squeeze_film.disc_force", "lubrication.squeeze_film.disc_impulse_*"},
        "sphere": {
            "lubrication.squeeze_film.sphere_force",
            "lubrication.squeeze_film.sphere_impulse_*",
        },
    },
    ck.ViscousForce(closure="flooded"): {
        "flats": {
            "lubrication.squeeze_film.disc_force",
            "lubrication.squeeze_film.disc_impulse_flooded",
        },
        "sphere": {
            "lubrication.squeeze_film.sphere_force",
            "lubrication.squeeze_film.sphere_impulse_flooded",
        },
    },
    ck.ViscousForce(closure="as-published"): {
        "flats": {
            "lubrication.squeeze_film.disc_force",
            "lubrication.squeeze_film.disc_impulse_flooded",
        },
        "sphere": {
            "lubrication.squeeze_film.sphere_force",
            "lubrication.squeeze_film.sphere_impulse_*",
        },
    },
    ck.TensionLimit(tension=1e4): {
        "flats": {"lubrication.film_limits.disc_tension_truncated"},
        "sphere": {"lubrication.film_limits.sphere_tension_truncated"},
    },
    ck.TensionLimit(tension=1e4, cavity="reynolds"): {
        "flats": {"lubrication.film_limits.disc_tension_reynolds", "numerics.roots.bracketed_root"},
    },
    ck.ShearLimit(strength=1e3): {
        "flats": {"lubrication.film_limits.disc_shear_limited"},
        "sphere": {"lubrication.film_limits.sphere_shear_limited", "numerics.roots.bracketed_root"},
    },
    ck.Rupture(): {"flats": EXACT_FLAT_END, "sphere": EXACT_SPHERE},
    ck.Rupture(criterion="zero-neck"): {
        "flats": {
            "capillary.arc.flat.zero_neck_gap",
            "capillary.arc.shape.*",
            "numerics.quadrature.gauss_legendre",
        },
        "sphere": ARC_SPHERE - {"capillary.arc.sphere.solve"},
    },
    ck.Rupture(gap=5e-6): {"flats": set(), "sphere": set()},
}
# Forces of the solids stand beside those of the film: each is tried with a few of these.
RUBBER = {"work_of_adhesion": 0.05, "reduced_modulus": 1e6, "strength": 1e4}
ADHESION = {"adhesion.parameters.*"}
SOLIDS = {
    ck.VanDerWaalsForce(hamaker_constant=1e-19): {
        "flats": {"adhesion.van_der_waals.pressure_between_flats"},
        "sphere": {"adhesion.van_der_waals.sphere_force"},
    },
    ck.VanDerWaalsForce(hamaker_constant=1e-19, closure="hamaker"): {
        "flats": {"adhesion.van_der_waals.pressure_between_flats"},
        "sphere": {"adhesion.van_der_waals.hamaker_sphere_force"},
    },
    ck.AdhesiveContact(model="jkr", **RUBBER): {"sphere": {"adhesion.jkr.*", *ADHESION}},
    ck.AdhesiveContact(model="dmt", **RUBBER): {"sphere": {"adhesion.dmt.*", *ADHESION}},
    ck.AdhesiveContact(**RUBBER): {
        "sphere": {
            "adhesion.maugis_dugdale.*",
            "adhesion.dmt.reach",
            "numerics.roots.*",
            *ADHESION,
        },
    },
}
# Menisci at asperities stand alone, in a film of a height or in the air of a humidity.
SUMMITS = ck.AsperityPopulation(density=1e6, radius=1e-2, rms_height=1e-6)
THIN = {
    "capillary.asperities.*",
    "capillary.kelvin.*",
    "capillary.arc.shape.wetting",
    "numerics.quadrature.gauss_legendre",
}
CONDENSED = {
    "capillary.asperity_bridges.*",
    "capillary.condensed.reach_at_pressure",
    "capillary.exact.*",
    "capillary.exact.delaunay.*",
    "numerics.roots.bracketed_root",
    "capillary.arc.shape.*",
    "capillary.asperities.normal_tail",
    *THIN,
}
ROUGH = {
    ck.AsperityMenisci(asperities=SUMMITS, meniscus_height=5e-6, **choices): {
        "flats": THIN if choices["profile"] == "thin-film" else CONDENSED
    }
    for choices in (
        {"law": "greenwood-williamson", "profile": "thin-film"},
        {"law": "greenwood-williamson", "profile": "exact"},
        {"law": "identical", "profile": "thin-film"},
        {"law": "identical", "profile": "exact"},
    )
}
BESIDE = [(), (ck.MeniscusForce(),), (ck.ViscousForce(), ck.Rupture(gap=5e-6))]

# What is not an effect's: how far the film reaches, the motion, and the ranges of validity.
EXTENT = {
    "flats": {"lubrication.squeeze_film.disc_radius"},
    "sphere": {"lubrication.squeeze_film.sphere_film_height"},
}
MOTION = {
    "speed": {"numerics.quadrature.gauss_legendre"},
    "time": set(),
    "force": {
        "separation.integrator.*",
        "numerics.events.*",
        "numerics.quadrature.gauss_legendre",
    },
}
VALIDITY = {
    ck.ViscousForce: {
        "lubrication.dimensionless.reynolds_number",
        "lubrication.dimensionless.slenderness",
    },
    ck.MeniscusForce: {"lubrication.dimensionless.bond_number"},
}
VALIDITY_OF_BOTH = {
    "lubrication.dimensionless.viscous_to_capillary",
    "lubrication.dimensionless.fingering_number",
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


def matches(name, patterns):
    return any(
        name.startswith(p.removesuffix("*")) if p.endswith("*") else name == p for p in patterns
    )


def poison(monkeypatch, names):
    """Replace kernels by ones that raise, wherever they have been imported to."""
    loaded = [m for name, m in sys.modules.items() if name.startswith("contactkit") and m]
    poisoned = {id(KERNELS[name]): _raising(name) for name in names}
    for module in loaded:
        for attribute, value in list(vars(module).items()):
            if id(value) in poisoned:
                monkeypatch.setattr(module, attribute, poisoned[id(value)])


def _raising(name):
    @functools.wraps(KERNELS[name])
    def raises(*_args, **_kwargs):
        raise PoisonError(name)

    return raises


def scene_of(effects, body, imposed):
    motion = {
        "speed": {"speed": 1e-3},
        "time": {"time": 1.0},
        "force": {"force": 1.0, "mass": 1e-3},
    }[imposed]
    volume = None if ROUGH.keys() & set(effects) else 6e-14
    film = ck.Meniscus(liquid=OIL, volume=volume, contact_angle_lower=0.3, contact_angle_upper=0.4)
    return ck.SeparationScene(
        interface=ck.Interface(lower=FACE, upper=BODIES[body], meniscus=film),
        opening=ck.Opening(initial_gap=1e-6, final_gap=1e-5, **motion),
        effects=effects,
    )


def run(effects, body, imposed):
    return separation.simulate(ck.plan(scene_of(effects, body, imposed)))


def allowed(effects, body, imposed):
    kinds = {type(effect) for effect in effects}
    owned = OWNED | SOLIDS | ROUGH
    names = set().union(EXTENT[body], *(owned[effect][body] for effect in effects))
    names |= set().union(*(VALIDITY.get(kind, set()) for kind in kinds))
    names |= VALIDITY_OF_BOTH if VALIDITY.keys() <= kinds else set()
    return names | MOTION[imposed]


def cases():
    """Every set of effects that fits together, one choice of each kind, with every drive."""
    kinds = itertools.groupby(OWNED, type)
    for chosen in itertools.product(*([None, *choices] for _, choices in kinds)):
        effects = tuple(effect for effect in chosen if effect is not None)
        has = {type(effect) for effect in effects}
        limited = bool(has & {ck.TensionLimit, ck.ShearLimit})
        if not has & {ck.MeniscusForce, ck.ViscousForce}:
            continue
        if limited and ck.ViscousForce not in has:
            continue
        for body, imposed in itertools.product(BODIES, ("speed", "time", "force")):
            if not all(body in OWNED[e] for e in effects) or (limited and imposed == "time"):
                continue
            if not mixed(scene_of(effects, body, imposed)):  # as published, and consistent
                yield effects, body, imposed
    for solid, film in itertools.product(SOLIDS, BESIDE):
        for body, imposed in itertools.product(SOLIDS[solid], ("speed", "time", "force")):
            yield (*film, solid), body, imposed
    for rough, imposed in itertools.product(ROUGH, ("speed", "time", "force")):
        yield (rough,), "flats", imposed


def label(value):
    if isinstance(value, str):
        return value
    return "+".join(
        "-".join(str(part) for part in (effect.name, *_choices(effect))) for effect in value
    )


def _choices(effect):
    for attribute in type(effect).__attrs_attrs__:
        value = getattr(effect, attribute.name)
        if value != attribute.default:
            yield value


CASES = list(cases())


@pytest.mark.parametrize(("effects", "body", "imposed"), CASES, ids=label)
def test_a_scene_runs_with_every_other_kernel_poisoned(monkeypatch, effects, body, imposed):
    mine = allowed(effects, body, imposed)
    poison(monkeypatch, [name for name in KERNELS if not matches(name, mine)])
    result = run(effects, body, imposed)
    assert result.status in ("curve", "released")


HEARTS = [
    ((ck.MeniscusForce(),), "flats", "speed", "capillary.flats.force_law.flat_law"),
    ((ck.MeniscusForce(),), "sphere", "speed", "capillary.exact.bridge.bridge"),
    ((ck.MeniscusForce(profile="arc"),), "flats", "speed", "capillary.arc.flat.force"),
    ((ck.MeniscusForce(profile="arc"),), "sphere", "speed", "capillary.arc.sphere.solve"),
    (
        (ck.MeniscusForce(profile="as-published"),),
        "flats",
        "time",
        "as_published.printed.common.meniscus_flat_3_11",
    ),
    (
        (ck.MeniscusForce(profile="as-published"),),
        "sphere",
        "speed",
        "as_published.printed.common.meniscus_sphere_3_12",
    ),
    ((ck.ViscousForce(),), "flats", "speed", "lubrication.squeeze_film.disc_force"),
    ((ck.ViscousForce(),), "flats", "time", "lubrication.squeeze_film.disc_impulse_conserved"),
    (
        (ck.ViscousForce(closure="flooded"),),
        "flats",
        "time",
        "lubrication.squeeze_film.disc_impulse_flooded",
    ),
    ((ck.ViscousForce(),), "sphere", "speed", "lubrication.squeeze_film.sphere_force"),
    ((ck.ViscousForce(),), "sphere", "time", "lubrication.squeeze_film.sphere_impulse_conserved"),
    (
        (ck.ViscousForce(closure="flooded"),),
        "sphere",
        "time",
        "lubrication.squeeze_film.sphere_impulse_flooded",
    ),
    (
        (ck.ViscousForce(), ck.TensionLimit(tension=1e4)),
        "flats",
        "force",
        "lubrication.film_limits.disc_tension_truncated",
    ),
    (
        (ck.ViscousForce(), ck.TensionLimit(tension=1e4, cavity="reynolds")),
        "flats",
        "force",
        "lubrication.film_limits.disc_tension_reynolds",
    ),
    (
        (ck.ViscousForce(), ck.TensionLimit(tension=1e4)),
        "sphere",
        "force",
        "lubrication.film_limits.sphere_tension_truncated",
    ),
    (
        (ck.ViscousForce(), ck.ShearLimit(strength=1e3)),
        "flats",
        "speed",
        "lubrication.film_limits.disc_shear_limited",
    ),
    (
        (ck.ViscousForce(), ck.ShearLimit(strength=1e3)),
        "sphere",
        "speed",
        "lubrication.film_limits.sphere_shear_limited",
    ),
    ((ck.ViscousForce(), ck.Rupture()), "flats", "time", "capillary.flats.force_law.flat_end"),
    (
        (ck.ViscousForce(), ck.Rupture()),
        "sphere",
        "time",
        "capillary.exact.stability.stability_limit",
    ),
    (
        (ck.ViscousForce(), ck.Rupture(criterion="zero-neck")),
        "flats",
        "time",
        "capillary.arc.flat.zero_neck_gap",
    ),
    (
        (ck.ViscousForce(), ck.Rupture(criterion="zero-neck")),
        "sphere",
        "time",
        "capillary.arc.sphere.zero_neck_gap",
    ),
    ((ck.ViscousForce(),), "flats", "force", "separation.integrator.radau.step"),
    *(
        ((rough,), "flats", "speed", heart)
        for rough, heart in zip(
            ROUGH,
            (
                "capillary.asperities.greenwood_williamson",
                "capillary.condensed.reach_at_pressure",
                "capillary.asperities.identical",
                "capillary.condensed.reach_at_pressure",
            ),
            strict=True,
        )
    ),
    *(
        ((solid,), "sphere", "speed", heart)
        for solid, heart in zip(
            SOLIDS,
            (
                "adhesion.van_der_waals.sphere_force",
                "adhesion.van_der_waals.hamaker_sphere_force",
                "adhesion.jkr.radius_at_gap",
                "adhesion.dmt.reach",
                "adhesion.maugis_dugdale.at_gap",
            ),
            strict=True,
        )
    ),
]


@pytest.mark.parametrize(("effects", "body", "imposed", "heart"), HEARTS, ids=label)
def test_the_poison_works_on_a_kernel_that_is_needed(monkeypatch, effects, body, imposed, heart):
    """The negative control: without its own kernel a scene does not run."""
    poison(monkeypatch, [heart])
    with pytest.raises(PoisonError, match=heart):
        run(effects, body, imposed)


# Contacts -----------------------------------------------------------------------------------

FIELDS = {
    "elasticity.stress.periodic.*",
    "elasticity.stress.isolated.*",
    "elasticity.layer_recursion.*",
    "elasticity.layer_stack.stack_of",
}
CONTACT_OWNED = {
    ck.HalfSpace(): set(),  # by the edges of the window, below
    ck.LayeredHalfSpace(): set(),
    ck.HardnessLimit(): {"contact.effects.hardness_rules.effective_hardness"},
    ck.HardnessLimit(rule="literal"): {
        "contact.effects.hardness_rules.effective_hardness_literal",
        "contact.effects.hardness_rules.layer_on_substrate",
    },
    ck.HardnessLimit(rule="material"): set(),
    ck.HardnessLimit(rule="constant", hardness=1e9): set(),
    ck.FrictionTraction(coefficient=0.2): set(),
    ck.FrictionCoupling(): {
        "elasticity.stress.planes.normal_displacement_of_traction",
        "elasticity.layered.compliance",
        *FIELDS,
    },
    ck.SubsurfaceStress(depths=(0.0, 1e-8)): {
        "elasticity.stress.planes.planes",
        "elasticity.layered_fields.*",
        "elasticity.depths.locate",
        "elasticity.stress.maxima.*",
        "elasticity.stress.measures.*",
        *FIELDS,
    },
    ck.FilmMeniscus(film_thickness=1e-9): {"capillary.film_islands.*"},
    ck.FilmMeniscus(film_thickness=1e-9, self_consistent=True): {"capillary.film_islands.*"},
    ck.IslandBridges(film_thickness=1e-9): {
        "capillary.film_islands.*",
        "capillary.island_bridges.*",
        "capillary.exact.*",
        "capillary.exact.delaunay.*",
        "numerics.roots.bracketed_root",
        "capillary.arc.*",
        "numerics.quadrature.gauss_legendre",
    },
}

# What is not an effect's: the compliance by the edges of the window, the heights, the solver.
EDGES = {
    True: {
        "elasticity.layered.normal_symbol",
        "elasticity.layer_recursion.*",
        "elasticity.layer_stack.stack_of",
    },
    False: {
        "elasticity.influence.*",
        "elasticity.love.*",
        "elasticity.point_load.*",
        "elasticity.layered.compliance",
        "elasticity.layer_recursion.*",
        "elasticity.layer_stack.stack_of",
    },
}
SHAPES = {
    "heights": set(),
    "paraboloid": {"roughness.elementary.paraboloid"},
    "sphere": {"roughness.elementary.sphere"},
    "wave": {"roughness.elementary.wave"},
    "gaussian": {"roughness.roughness.gaussian_exponential", "roughness.random_fields.*"},
    "self-affine": {"roughness.roughness.self_affine", "roughness.random_fields.*"},
}
SOLVER = {
    "contact.solver.*",
    "contact.solver.convolution.*",
    "numerics.fft.*",
    "contact.solver.transfer.*",
    "contact.solver.optimality.*",
    "contact.solver.stencil.*",
    "contact.solver.problem.*",
}
WATER = ck.Liquid(name="water", viscosity=1e-3, surface_tension=0.07)
HARD = ck.Material(young_modulus=3e9, poisson_ratio=0.2, hardness=1e8)
SOFT = ck.Material(young_modulus=1e9, poisson_ratio=0.3, hardness=5e7)
LAYERED = ck.Stack(layers=(ck.Layer(material=HARD, thickness=5e-9),), substrate=SOFT)
SURFACES = {
    "heights": ck.Heights(
        heights=1e-9 * np.random.default_rng(0).normal(size=(16, 12)), pixel_size=2e-8
    ),
    "paraboloid": ck.Paraboloid(radius=1e-5),
    "sphere": ck.Sphere(radius=1e-5),
    "wave": ck.Wave(amplitude=1e-9, wavelength=2e-7),
    "gaussian": ck.GaussianRoughness(rms=1e-9, correlation_length=1e-7, cutoff=6e-8),
    "self-affine": ck.SelfAffineRoughness(rms=1e-9, hurst=0.8, rolloff=2e-7, cutoff=6e-8),
}


def press(effects, periodic, shape="heights"):
    is_layered = any(isinstance(effect, ck.LayeredHalfSpace) for effect in effects)
    known = shape == "heights"
    scene = ck.ContactScene(
        interface=ck.ContactInterface(
            lower=ck.Body(solid=LAYERED if is_layered else SOFT),
            upper=ck.Body(surface=SURFACES[shape]),
            meniscus=ck.Meniscus(liquid=WATER),
        ),
        window=ck.Window(width=None if known else 4e-7, periodic=periodic),
        pressing=ck.Pressing(pressure=1e6),
        effects=effects,
    )
    return solve(ck.plan(scene, ck.Accuracy(grid=None if known else 16)))


def contact_cases():
    """Each effect alone, each pair of kinds that fits together, and all of them at once."""
    elastic = [e for e in CONTACT_OWNED if isinstance(e, ck.HalfSpace | ck.LayeredHalfSpace)]
    others = [effect for effect in CONTACT_OWNED if effect not in elastic]
    sets = [(), *((e,) for e in others), *itertools.combinations(others, 2)]
    everything = {type(effect): effect for effect in others}
    for chosen in (*sets, tuple(everything.values())):
        kinds = [type(effect) for effect in chosen]
        if len(set(kinds)) < len(kinds):
            continue
        if ck.FrictionCoupling in kinds and ck.FrictionTraction not in kinds:
            continue
        laws = elastic if len(chosen) != 2 else elastic[1:]
        for law, periodic in itertools.product(laws, EDGES):
            yield (law, *chosen), periodic


def contact_label(value):
    return ("periodic" if value else "free") if isinstance(value, bool) else label(value)


CONTACT_CASES = list(contact_cases())


def allowed_in_contact(effects, periodic, shape="heights"):
    owned = set().union(*(CONTACT_OWNED[effect] for effect in effects))
    return owned | SOLVER | EDGES[periodic] | SHAPES[shape]


@pytest.mark.parametrize(("effects", "periodic"), CONTACT_CASES, ids=contact_label)
def test_a_contact_runs_with_every_other_kernel_poisoned(monkeypatch, effects, periodic):
    mine = allowed_in_contact(effects, periodic)
    poison(monkeypatch, [name for name in KERNELS if not matches(name, mine)])
    assert press(effects, periodic).status == "converged"


@pytest.mark.parametrize("shape", SHAPES)
def test_a_surface_calls_its_own_recipe_only(monkeypatch, shape):
    effects = (ck.LayeredHalfSpace(),)
    mine = allowed_in_contact(effects, True, shape)
    poison(monkeypatch, [name for name in KERNELS if not matches(name, mine)])
    assert press(effects, True, shape).status == "converged"


CONTACT_HEARTS = [
    ((), True, "elasticity.layered.normal_symbol"),
    ((), False, "elasticity.influence.symbol"),
    ((ck.HardnessLimit(),), True, "contact.effects.hardness_rules.effective_hardness"),
    (
        (ck.HardnessLimit(rule="literal"),),
        True,
        "contact.effects.hardness_rules.effective_hardness_literal",
    ),
    (
        (ck.FrictionTraction(coefficient=0.2), ck.FrictionCoupling()),
        True,
        "elasticity.stress.planes.normal_displacement_of_traction",
    ),
    ((ck.SubsurfaceStress(),), False, "elasticity.stress.planes.planes"),
    ((ck.FilmMeniscus(film_thickness=1e-9),), True, "capillary.film_islands.meniscus_area"),
]


@pytest.mark.parametrize(("effects", "periodic", "heart"), CONTACT_HEARTS, ids=str)
def test_the_poison_works_on_a_kernel_that_a_contact_needs(monkeypatch, effects, periodic, heart):
    poison(monkeypatch, [heart])
    with pytest.raises(PoisonError, match=heart):
        press((ck.LayeredHalfSpace(), *effects), periodic)


def _counted(original, calls):
    def counted(*args, **kwargs):
        calls.append(original)
        return original(*args, **kwargs)

    return counted


def transforms(monkeypatch, effects, periodic=True):
    """Transforms of scipy that a contact takes; those by another library are never more."""
    made = []
    with monkeypatch.context() as patched:
        for name in ("rfft", "fft", "ifft", "irfft", "rfft2", "irfft2", "rfftn", "irfftn"):
            patched.setattr(scipy.fft, name, _counted(getattr(scipy.fft, name), made))
        result = press((ck.LayeredHalfSpace(), *effects), periodic)
    return len(made), result.work.n_ffts


@pytest.mark.parametrize("periodic", [True, False], ids=contact_label)
def test_what_a_scene_does_not_call_for_is_not_transformed(monkeypatch, periodic):
    friction, none = ck.FrictionTraction(coefficient=0.2), ck.FrictionTraction(coefficient=0.0)
    alone = transforms(monkeypatch, (), periodic)
    assert transforms(monkeypatch, (friction,), periodic) == alone
    assert transforms(monkeypatch, (ck.FilmMeniscus(film_thickness=1e-9),), periodic) == alone
    counts = [
        transforms(monkeypatch, effects, periodic)[0]
        for effects in (
            (ck.SubsurfaceStress(depths=(1e-8,)),),
            (ck.SubsurfaceStress(depths=(1e-8,)), none),
            (ck.SubsurfaceStress(depths=(1e-8,)), friction),
            (ck.SubsurfaceStress(depths=(1e-8, 2e-8)), friction),
        )
    ]
    assert alone[0] < counts[0] == counts[1] < counts[2] < counts[3]


def test_every_effect_and_every_choice_is_poisoned():
    """A new effect, or a new choice of one, needs its line in the table."""
    assert {type(effect) for effect in OWNED | SOLIDS | ROUGH} == set(SEPARATION_EFFECTS)
    solids = [effect for effect in SOLIDS if isinstance(effect, ck.AdhesiveContact)]
    assert {effect.model for effect in solids} == {"jkr", "dmt", "maugis-dugdale"}
    assert {effect.profile for effect in OWNED if isinstance(effect, ck.MeniscusForce)} == {
        "exact",
        "arc",
        "as-published",
    }
    assert {type(effect) for case in CASES for effect in case[0]} == set(SEPARATION_EFFECTS)
    assert {type(effect) for effect in CONTACT_OWNED} == set(CONTACT_EFFECTS)
    assert {type(effect) for case in CONTACT_CASES for effect in case[0]} == set(CONTACT_EFFECTS)
    rules = {effect.rule for effect in CONTACT_OWNED if isinstance(effect, ck.HardnessLimit)}
    assert rules == {"continuous", "literal", "material", "constant"}


def test_the_table_names_kernels_that_exist():
    patterns = set().union(VALIDITY_OF_BOTH, *MOTION.values(), *VALIDITY.values(), *EXTENT.values())
    for bodies in (*OWNED.values(), *SOLIDS.values(), *ROUGH.values()):
        patterns |= set().union(*bodies.values())
    patterns |= set().union(SOLVER, *CONTACT_OWNED.values(), *SHAPES.values(), *EDGES.values())
    assert [p for p in sorted(patterns) if not any(matches(name, {p}) for name in KERNELS)] == []


def test_the_scenes_of_the_devices_use_effects_that_are_poisoned_above():
    folder = Path(str(importlib.resources.files("contactkit.models")))
    used = set()
    for path in folder.glob("*/*.toml"):
        text = path.read_text(encoding="utf-8")
        used |= {kind for kind in ck.EFFECTS if f'"{kind.name}"' in text}
    assert used
    assert used <= {type(effect) for effect in (*OWNED, *SOLIDS, *CONTACT_OWNED)}
