"""Only the effects a scene calls for: every kernel they do not own raises, and the scene runs."""

from __future__ import annotations

import functools
import importlib
import importlib.resources
import itertools
import pkgutil
import sys

import numpy as np
import pytest
import scipy.fft

import contactkit as ck
import contactkit.kernels
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
    "arc_flat.contact_radius", "arc_flat.force", "arc_flat.rim_contact_radius", "arc_flat.volume",
    "arc_flat.zero_neck_gap", "arc_flat.zero_neck_gap_at_rim", "arc_shape.*",
    "quadrature.gauss_legendre", "roots.bracketed_root",
}  # fmt: skip
ARC_SPHERE = {
    "arc_sphere.solve", "arc_sphere.zero_neck_gap", "arc_newton.*", "arc_segment.*",
    "arc_shape.refuse_spreading", "arc_shape.whole_angle", "spline.*",
}  # fmt: skip
EXACT_FLAT_END = {
    "flat_law.*", "flat_family.*", "delaunay.*", "arc_shape.*", "quadrature.gauss_legendre",
    "roots.bracketed_root",
}  # fmt: skip
EXACT_FLAT = EXACT_FLAT_END | {"spline.*", "flat_members.*"}
EXACT_SPHERE = {
    "bridge_*", "drop.drop_left", "delaunay.*", "quadrature.gauss_legendre", "roots.*", *ARC_SPHERE,
}  # fmt: skip
OWNED = {
    ck.MeniscusForce(): {"flats": EXACT_FLAT, "sphere": EXACT_SPHERE},
    ck.MeniscusForce(profile="arc"): {"flats": ARC_FLAT, "sphere": ARC_SPHERE},
    ck.MeniscusForce(profile="as-published"): {
        "flats": {"published.meniscus_flat_3_11", "published.meniscus_divided_3_33",
                  "arc_shape.wetting"},
        "sphere": {"published.meniscus_sphere_3_12", *ARC_SPHERE},
    },
    ck.ViscousForce(): {
        "flats": {"squeeze.disc_force", "squeeze.disc_impulse_*"},
        "sphere": {"squeeze.sphere_force", "squeeze.sphere_impulse_*"},
    },
    ck.ViscousForce(closure="flooded"): {
        "flats": {"squeeze.disc_force", "squeeze.disc_impulse_flooded"},
        "sphere": {"squeeze.sphere_force", "squeeze.sphere_impulse_flooded"},
    },
    ck.ViscousForce(closure="as-published"): {
        "flats": {"squeeze.disc_force", "squeeze.disc_impulse_flooded"},
        "sphere": {"squeeze.sphere_force", "squeeze.sphere_impulse_*"},
    },
    ck.TensionLimit(tension=1e4): {
        "flats": {"film_limits.disc_tension_clipped"},
        "sphere": {"film_limits.sphere_tension_clipped"},
    },
    ck.TensionLimit(tension=1e4, cavity="reynolds"): {
        "flats": {"film_limits.disc_tension_reynolds", "roots.bracketed_root"},
    },
    ck.ShearLimit(strength=1e3): {
        "flats": {"film_limits.disc_shear_limited"},
        "sphere": {"film_limits.sphere_shear_limited", "roots.bracketed_root"},
    },
    ck.Rupture(): {"flats": EXACT_FLAT_END, "sphere": EXACT_SPHERE},
    ck.Rupture(criterion="zero-neck"): {
        "flats": {"arc_flat.zero_neck_gap", "arc_shape.*", "quadrature.gauss_legendre"},
        "sphere": ARC_SPHERE - {"arc_sphere.solve"},
    },
    ck.Rupture(gap=5e-6): {"flats": set(), "sphere": set()},
}  # fmt: skip
# Forces of the solids stand beside those of the film: each is tried with a few of these.
RUBBER = {"work_of_adhesion": 0.05, "reduced_modulus": 1e6, "strength": 1e4}
ADHESION = {"adhesion_scales.*"}
SOLIDS = {
    ck.VanDerWaalsForce(hamaker_constant=1e-19): {
        "flats": {"van_der_waals.pressure_between_flats"}, "sphere": {"van_der_waals.sphere_force"},
    },
    ck.VanDerWaalsForce(hamaker_constant=1e-19, closure="hamaker"): {
        "flats": {"van_der_waals.pressure_between_flats"},
        "sphere": {"van_der_waals.hamaker_sphere_force"},
    },
    ck.AdhesiveContact(model="jkr", **RUBBER): {"sphere": {"jkr.*", *ADHESION}},
    ck.AdhesiveContact(model="dmt", **RUBBER): {"sphere": {"dmt.*", *ADHESION}},
    ck.AdhesiveContact(**RUBBER): {
        "sphere": {"maugis_dugdale.*", "dmt.reach", "roots.bracketed_root", *ADHESION},
    },
}  # fmt: skip
# Menisci at asperities stand alone, in a film of a height or in the air of a humidity.
SUMMITS = ck.AsperityPopulation(density=1e6, radius=1e-2, rms_height=1e-6)
THIN = {"asperities.*", "kelvin.*", "arc_shape.wetting", "quadrature.gauss_legendre"}
CONDENSED = {
    "condensed.reach_at_pressure", "bridge_*", "delaunay.*", "roots.bracketed_root",
    "arc_shape.*", "asperities.normal_tail", *THIN,
}  # fmt: skip
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
EXTENT = {"flats": {"squeeze.disc_radius"}, "sphere": {"squeeze.sphere_film_height"}}
MOTION = {
    "speed": {"quadrature.gauss_legendre"},
    "time": set(),
    "force": {
        "stiff_step.*",
        "short_step.*",
        "smooth_*",
        "step_reading.*",
        "quadrature.gauss_legendre",
    },
}
VALIDITY = {
    ck.ViscousForce: {"validity.reynolds_number", "validity.slenderness"},
    ck.MeniscusForce: {"validity.bond_number"},
}
VALIDITY_OF_BOTH = {"validity.viscous_to_capillary", "validity.fingering_number"}


class PoisonError(Exception):
    """A kernel was called that no effect of the scene owns."""


def kernels():
    """Public functions of the kernels, by module and name."""
    found = {}
    for info in pkgutil.iter_modules(contactkit.kernels.__path__):
        module = importlib.import_module(f"contactkit.kernels.{info.name}")
        for name in getattr(module, "__all__", ()):
            value = getattr(module, name)
            is_own = getattr(value, "__module__", "") == module.__name__
            if callable(value) and not isinstance(value, type) and is_own:
                found[f"{info.name}.{name}"] = value
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
    ((ck.MeniscusForce(),), "flats", "speed", "flat_law.flat_law"),
    ((ck.MeniscusForce(),), "sphere", "speed", "bridge_exact.bridge"),
    ((ck.MeniscusForce(profile="arc"),), "flats", "speed", "arc_flat.force"),
    ((ck.MeniscusForce(profile="arc"),), "sphere", "speed", "arc_sphere.solve"),
    ((ck.MeniscusForce(profile="as-published"),), "flats", "time", "published.meniscus_flat_3_11"),
    ((ck.MeniscusForce(profile="as-published"),), "sphere", "speed",
     "published.meniscus_sphere_3_12"),
    ((ck.ViscousForce(),), "flats", "speed", "squeeze.disc_force"),
    ((ck.ViscousForce(),), "flats", "time", "squeeze.disc_impulse_conserved"),
    ((ck.ViscousForce(closure="flooded"),), "flats", "time", "squeeze.disc_impulse_flooded"),
    ((ck.ViscousForce(),), "sphere", "speed", "squeeze.sphere_force"),
    ((ck.ViscousForce(),), "sphere", "time", "squeeze.sphere_impulse_conserved"),
    ((ck.ViscousForce(closure="flooded"),), "sphere", "time", "squeeze.sphere_impulse_flooded"),
    ((ck.ViscousForce(), ck.TensionLimit(tension=1e4)), "flats", "force",
     "film_limits.disc_tension_clipped"),
    ((ck.ViscousForce(), ck.TensionLimit(tension=1e4, cavity="reynolds")), "flats", "force",
     "film_limits.disc_tension_reynolds"),
    ((ck.ViscousForce(), ck.TensionLimit(tension=1e4)), "sphere", "force",
     "film_limits.sphere_tension_clipped"),
    ((ck.ViscousForce(), ck.ShearLimit(strength=1e3)), "flats", "speed",
     "film_limits.disc_shear_limited"),
    ((ck.ViscousForce(), ck.ShearLimit(strength=1e3)), "sphere", "speed",
     "film_limits.sphere_shear_limited"),
    ((ck.ViscousForce(), ck.Rupture()), "flats", "time", "flat_law.flat_end"),
    ((ck.ViscousForce(), ck.Rupture()), "sphere", "time", "bridge_limit.stability_limit"),
    ((ck.ViscousForce(), ck.Rupture(criterion="zero-neck")), "flats", "time",
     "arc_flat.zero_neck_gap"),
    ((ck.ViscousForce(), ck.Rupture(criterion="zero-neck")), "sphere", "time",
     "arc_sphere.zero_neck_gap"),
    ((ck.ViscousForce(),), "flats", "force", "stiff_step.step"),
    *(((rough,), "flats", "speed", heart) for rough, heart in zip(
        ROUGH, ("asperities.greenwood_williamson", "condensed.reach_at_pressure",
                "asperities.identical", "condensed.reach_at_pressure"), strict=True)),
    *(((solid,), "sphere", "speed", heart) for solid, heart in zip(
        SOLIDS, ("van_der_waals.sphere_force", "van_der_waals.hamaker_sphere_force",
                 "jkr.radius_at_gap", "dmt.reach", "maugis_dugdale.at_gap"), strict=True)),
]  # fmt: skip


@pytest.mark.parametrize(("effects", "body", "imposed", "heart"), HEARTS, ids=label)
def test_the_poison_works_on_a_kernel_that_is_needed(monkeypatch, effects, body, imposed, heart):
    """The negative control: without its own kernel a scene does not run."""
    poison(monkeypatch, [heart])
    with pytest.raises(PoisonError, match=heart):
        run(effects, body, imposed)


# Contacts -----------------------------------------------------------------------------------

FIELDS = {"stress_modes.*", "stress_images.*", "layered_step.*", "layer_stack.stack_of"}
CONTACT_OWNED = {
    ck.HalfSpace(): set(),  # by the edges of the window, below
    ck.LayeredHalfSpace(): set(),
    ck.HardnessLimit(): {"hardness.effective_hardness"},
    ck.HardnessLimit(rule="literal"): {
        "hardness.effective_hardness_literal", "hardness.layer_on_substrate",
    },
    ck.HardnessLimit(rule="material"): set(),
    ck.HardnessLimit(rule="constant", hardness=1e9): set(),
    ck.FrictionTraction(coefficient=0.2): set(),
    ck.FrictionCoupling(): {
        "stress_planes.normal_displacement_of_traction", "layered.compliance", *FIELDS,
    },
    ck.SubsurfaceStress(depths=(0.0, 1e-8)): {
        "stress_planes.planes", "layered_fields.*", "layer_planes.locate", "stress_maxima.*",
        "stress_measures.*", *FIELDS,
    },
    ck.FilmMeniscus(film_thickness=1e-9): {"film_islands.*"},
    ck.FilmMeniscus(film_thickness=1e-9, self_consistent=True): {"film_islands.*"},
    ck.IslandBridges(film_thickness=1e-9): {
        "film_islands.*", "island_bridges.*", "bridge_*", "delaunay.*", "roots.bracketed_root",
        "arc_*", "quadrature.gauss_legendre",
    },
}  # fmt: skip

# What is not an effect's: the compliance by the edges of the window, the heights, the solver.
EDGES = {
    True: {"layered.normal_symbol", "layered_step.*", "layer_stack.stack_of"},
    False: {"free_kernel.*", "love.*", "point_load.*", "layered.compliance", "layered_step.*",
            "layer_stack.stack_of"},
}  # fmt: skip
SHAPES = {
    "heights": set(),
    "paraboloid": {"height_shapes.paraboloid"},
    "sphere": {"height_shapes.sphere"},
    "wave": {"height_shapes.wave"},
    "gaussian": {"roughness.gaussian_exponential", "random_waves.*"},
    "self-affine": {"roughness.self_affine", "random_waves.*"},
}
SOLVER = {
    "active_set*", "convolve.*", "fft_backends.*", "grid_transfer.*", "kkt.*", "near_stencil.*",
    "press_problem.*",
}  # fmt: skip
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
    ((), True, "layered.normal_symbol"),
    ((), False, "free_kernel.symbol"),
    ((ck.HardnessLimit(),), True, "hardness.effective_hardness"),
    ((ck.HardnessLimit(rule="literal"),), True, "hardness.effective_hardness_literal"),
    ((ck.FrictionTraction(coefficient=0.2), ck.FrictionCoupling()), True,
     "stress_planes.normal_displacement_of_traction"),
    ((ck.SubsurfaceStress(),), False, "stress_planes.planes"),
    ((ck.FilmMeniscus(film_thickness=1e-9),), True, "film_islands.meniscus_area"),
]  # fmt: skip


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
        "exact", "arc", "as-published",
    }  # fmt: skip
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
    folder = importlib.resources.files("contactkit.models")
    used = set()
    for path in folder.iterdir():
        if path.name.endswith(".toml"):
            text = path.read_text(encoding="utf-8")
            used |= {kind for kind in ck.EFFECTS if f'"{kind.name}"' in text}
    assert used
    assert used <= {type(effect) for effect in (*OWNED, *SOLIDS, *CONTACT_OWNED)}
