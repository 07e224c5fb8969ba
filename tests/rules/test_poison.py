"""Only the effects a scene calls for: every kernel they do not own raises, and the scene runs."""

from __future__ import annotations

import functools
import importlib
import importlib.resources
import itertools
import pkgutil
import sys

import pytest

import contactkit as ck
import contactkit.kernels
from contactkit import separation

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
    "arc_shape.refuse_spreading",
}  # fmt: skip
OWNED = {
    ck.MeniscusForce(): {"flats": ARC_FLAT, "sphere": ARC_SPHERE},
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
    ck.Rupture(): {
        "flats": {"arc_flat.zero_neck_gap", "arc_shape.*", "quadrature.gauss_legendre"},
        "sphere": ARC_SPHERE - {"arc_sphere.solve"},
    },
    ck.Rupture(gap=5e-6): {"flats": set(), "sphere": set()},
}  # fmt: skip

# What is not an effect's: how far the film reaches, the motion, and the ranges of validity.
EXTENT = {"flats": {"squeeze.disc_radius"}, "sphere": {"squeeze.sphere_film_height"}}
MOTION = {
    "speed": {"quadrature.gauss_legendre"},
    "time": set(),
    "force": {"stiff_step.*", "step_reading.*", "quadrature.gauss_legendre"},
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
    for name in names:
        original = KERNELS[name]

        @functools.wraps(original)
        def raises(*_args, _name=name, **_kwargs):
            raise PoisonError(_name)

        for module in loaded:
            for attribute, value in list(vars(module).items()):
                if value is original:
                    monkeypatch.setattr(module, attribute, raises)


def run(effects, body, imposed):
    motion = {
        "speed": {"speed": 1e-3},
        "time": {"time": 1.0},
        "force": {"force": 1.0, "mass": 1e-3},
    }[imposed]
    film = ck.Meniscus(liquid=OIL, volume=6e-14, contact_angle_lower=0.3, contact_angle_upper=0.4)
    scene = ck.SeparationScene(
        interface=ck.Interface(lower=FACE, upper=BODIES[body], meniscus=film),
        opening=ck.Opening(initial_gap=1e-6, final_gap=1e-5, **motion),
        effects=effects,
    )
    return separation.simulate(ck.plan(scene))


def allowed(effects, body, imposed):
    kinds = {type(effect) for effect in effects}
    names = set().union(EXTENT[body], *(OWNED[effect][body] for effect in effects))
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
            if all(body in OWNED[e] for e in effects) and not (limited and imposed == "time"):
                yield effects, body, imposed


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
    ((ck.MeniscusForce(),), "flats", "speed", "arc_flat.force"),
    ((ck.MeniscusForce(),), "sphere", "speed", "arc_sphere.solve"),
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
    ((ck.ViscousForce(), ck.Rupture()), "flats", "time", "arc_flat.zero_neck_gap"),
    ((ck.ViscousForce(), ck.Rupture()), "sphere", "time", "arc_sphere.zero_neck_gap"),
    ((ck.ViscousForce(),), "flats", "force", "stiff_step.step"),
]  # fmt: skip


@pytest.mark.parametrize(("effects", "body", "imposed", "heart"), HEARTS, ids=label)
def test_the_poison_works_on_a_kernel_that_is_needed(monkeypatch, effects, body, imposed, heart):
    """The negative control: without its own kernel a scene does not run."""
    poison(monkeypatch, [heart])
    with pytest.raises(PoisonError, match=heart):
        run(effects, body, imposed)


def test_every_effect_and_every_choice_is_poisoned():
    """A new effect, or a new choice of one, needs its line in the table."""
    assert {type(effect) for effect in OWNED} == set(ck.EFFECTS)
    assert {effect.profile for effect in OWNED if isinstance(effect, ck.MeniscusForce)} == {
        "arc", "as-published",
    }  # fmt: skip
    assert {type(effect) for case in CASES for effect in case[0]} == set(ck.EFFECTS)


def test_the_table_names_kernels_that_exist():
    patterns = set().union(VALIDITY_OF_BOTH, *MOTION.values(), *VALIDITY.values(), *EXTENT.values())
    for bodies in OWNED.values():
        patterns |= set().union(*bodies.values())
    assert [p for p in sorted(patterns) if not any(matches(name, {p}) for name in KERNELS)] == []


def test_the_scenes_of_the_devices_use_effects_that_are_poisoned_above():
    folder = importlib.resources.files("contactkit.models")
    used = set()
    for path in folder.iterdir():
        if path.name.endswith(".toml"):
            text = path.read_text(encoding="utf-8")
            used |= {kind for kind in ck.EFFECTS if f'"{kind.name}"' in text}
    assert used
    assert used <= {type(effect) for effect in OWNED}
