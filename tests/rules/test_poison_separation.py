"""Only the effects a separation calls for: every kernel they do not own raises, and it runs."""

from __future__ import annotations

import itertools

import loadings
import pytest
from poison import (
    by_kind,
    imported_by,
    kernels,
    label,
    pairwise,
    poison_all_but,
    product_of,
    survives,
    unknown,
    with_needed_fields,
)
from selection import quick

import contactkit as ck
from contactkit.kinds import SEPARATION_EFFECTS
from contactkit.separation import simulate as separation
from contactkit.separation.effects.as_published import mixed
from contactkit.separation.effects.base import CoupledEffect, SeparationForce

pytestmark = pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning")

FACE = ck.Flat(radius=1e-4)
LOWER = {"flats": FACE, "sphere": ck.Flat(radius=1e-3)}
BODIES = {"flats": FACE, "sphere": ck.Sphere(radius=1e-2)}
IMPOSED = ("speed", "time", "force")
OIL = ck.Liquid(name="oil", viscosity=0.1, surface_tension=0.03, density=900.0)

# What each effect may call, by the body above the flat. `*` stands for the rest of a name.
ARC_FLAT = {"capillary.arc.flat.*", "capillary.arc.shape.*"}
ARC_SPHERE = {
    "capillary.arc.sphere.*",
    "capillary.arc.contact_circles.*",
    "capillary.arc.shape.*",
}
EXACT_FLAT_END = {
    "capillary.flats.force_law.*",
    "capillary.flats.family.*",
    "capillary.exact.delaunay.*",
    "capillary.arc.shape.*",
}
EXACT_FLAT = EXACT_FLAT_END | {"capillary.flats.sampling.*"}
EXACT_SPHERE = {"capillary.exact.*", *ARC_SPHERE}
PRINTED = "as_published.printed.common.*"
SQUEEZE = {
    "flats": {"lubrication.squeeze_film.disc_*"},
    "sphere": {"lubrication.squeeze_film.sphere_*"},
}
TENSION = {
    "flats": {"lubrication.film_limits.disc_tension_*"},
    "sphere": {"lubrication.film_limits.sphere_tension_*"},
}
SHEAR = {
    "flats": {"lubrication.film_limits.disc_shear_*"},
    "sphere": {"lubrication.film_limits.sphere_shear_*"},
}
OWNED = {
    ck.MeniscusForce(): {"flats": EXACT_FLAT, "sphere": EXACT_SPHERE},
    ck.MeniscusForce(profile="arc"): {"flats": ARC_FLAT, "sphere": ARC_SPHERE},
    ck.MeniscusForce(profile="as-published"): {
        "flats": {PRINTED, *ARC_FLAT},
        "sphere": {PRINTED, *ARC_SPHERE},
    },
    ck.ViscousForce(): SQUEEZE,
    ck.ViscousForce(closure="flooded"): SQUEEZE,
    ck.ViscousForce(closure="as-published"): {  # the film is that of the printed arc
        "flats": {*SQUEEZE["flats"], *ARC_FLAT},
        "sphere": {*SQUEEZE["sphere"], *ARC_SPHERE},
    },
    ck.TensionLimit(strength=1e4, cavity="truncated"): TENSION,
    ck.TensionLimit(strength=1e4, cavity="reynolds"): {"flats": TENSION["flats"]},
    ck.ShearLimit(strength=1e3): SHEAR,
    ck.Rupture(): {"flats": EXACT_FLAT_END, "sphere": EXACT_SPHERE},
    ck.Rupture(gap="zero-neck"): {"flats": ARC_FLAT, "sphere": ARC_SPHERE},
    ck.Rupture(gap=5e-6): {"flats": set(), "sphere": set()},
}
# Forces of the solids stand beside those of the film: each is tried with a few of these.
BESIDE = [(), (ck.MeniscusForce(),), (ck.ViscousForce(), ck.Rupture(gap=5e-6))]
RUBBER = {"work_of_adhesion": 0.05, "reduced_modulus": 1e6, "strength": 1e4}
VAN_DER_WAALS = {body: {"adhesion.van_der_waals.*"} for body in BODIES}
CONTACT = {"adhesion.parameters.*", "adhesion.contact_models.*"}
SOLIDS = {
    ck.VanDerWaalsForce(hamaker_constant=1e-19): VAN_DER_WAALS,
    ck.VanDerWaalsForce(hamaker_constant=1e-19, closure="hamaker"): VAN_DER_WAALS,
    ck.AdhesiveContact(model="jkr", **RUBBER): {"sphere": {"adhesion.jkr.*", *CONTACT}},
    ck.AdhesiveContact(model="dmt", **RUBBER): {"sphere": {"adhesion.dmt.*", *CONTACT}},
    ck.AdhesiveContact(**RUBBER): {
        "sphere": {"adhesion.maugis_dugdale.*", "adhesion.dmt.*", *CONTACT}
    },
}
# Menisci at asperities stand alone, in a film of a height or in the air of a humidity.
SUMMITS = ck.AsperityPopulation(density=1e6, radius=1e-2, rms_height=1e-6)
THIN = {"capillary.asperities.*", "capillary.kelvin.*", "capillary.arc.shape.*"}
CONDENSED = {
    "capillary.asperity_bridges.*",
    "capillary.condensed.*",
    "capillary.exact.*",
    *THIN,
}
ROUGH = {
    ck.AsperityMenisci(asperities=SUMMITS, meniscus_height=5e-6, law=law, profile=profile): {
        "flats": kernels
    }
    for law in ("greenwood-williamson", "identical")
    for profile, kernels in (("thin-film", THIN), ("exact", CONDENSED))
}

# Dynamic wetting takes a film that does not fill the faces, and mostly a meniscus at a speed.
WET = {"capillary.wetting.weight.*", "lubrication.dimensionless.bond_number", *EXACT_SPHERE}
COX = {
    "capillary.wetting.cox_voinov.*",
    "capillary.wetting.moving_bridge.*",
    *EXACT_SPHERE,
}
WETTING = {
    ck.LiquidWeight(): {"sphere": WET},
    ck.LiquidWeight(body="lower"): {"sphere": WET},
    ck.CoxVoinovAngle(): {"sphere": COX},
    ck.LandauLevichFilm(): {"sphere": {"capillary.wetting.landau_levich.*", *COX}},
    ck.TroutonForce(): {"sphere": set()},
    ck.DynamicRupture(): {"sphere": EXACT_SPHERE},
}
TABLE = OWNED | SOLIDS | ROUGH | WETTING
# A force without a line above may call what its module imports. It is tried alone where it fits.
OTHERS = {
    with_needed_fields(kind): dict.fromkeys(BODIES, imported_by(kind))
    for kind in SEPARATION_EFFECTS
    if issubclass(kind, SeparationForce) and kind not in {*map(type, TABLE)}
}

# What is not an effect's: how far the film reaches, the motion, and the ranges of validity.
EXTENT = {
    "flats": {"lubrication.squeeze_film.disc_radius"},
    "sphere": {"lubrication.squeeze_film.sphere_film_height"},
}
MOTION = {"speed": set(), "time": set(), "force": {"separation.integrator.*"}}
VALIDITY = {
    ck.ViscousForce: {
        "lubrication.dimensionless.reynolds_number",
        "lubrication.dimensionless.slenderness",
        "lubrication.dimensionless.inertia_fraction",
        "lubrication.dimensionless.rim_fraction",
    },
    ck.MeniscusForce: {"lubrication.dimensionless.bond_number"},
}
VALIDITY_OF_BOTH = {
    "lubrication.dimensionless.viscous_to_capillary",
    "lubrication.dimensionless.fingering_number",
}


def scene_of(effects, body, imposed):
    motion = {
        "speed": {"speed": 1e-3},
        "time": {"time": 1.0},
        "force": {"force": 1.0, "mass": 1e-3},
    }[imposed]
    volume = None if ROUGH.keys() & set(effects) else 6e-14
    film = ck.Meniscus(liquid=OIL, volume=volume, contact_angle_lower=0.3, contact_angle_upper=0.4)
    return ck.SeparationScene(
        interface=ck.Interface(lower=LOWER[body], upper=BODIES[body], meniscus=film),
        loading=loadings.imposed(initial_gap=1e-6, final_gap=1e-5, **motion),
        effects=effects,
    )


def run(effects, body, imposed):
    return separation.simulate(ck.plan(scene_of(effects, body, imposed), ck.Accuracy.draft))


def allowed(effects, body, imposed):
    kinds = {type(effect) for effect in effects}
    owned = TABLE | OTHERS
    names = set().union(EXTENT[body], *(owned[effect][body] for effect in effects))
    names |= set().union(*(VALIDITY.get(kind, set()) for kind in kinds))
    names |= VALIDITY_OF_BOTH if VALIDITY.keys() <= kinds else set()
    return names | MOTION[imposed]


def fits(effects, body, imposed):
    """Whether a scene can have these effects: a limit needs a film to limit, and its slope."""
    has = {type(effect) for effect in effects}
    limited = bool(has & {ck.TensionLimit, ck.ShearLimit})
    if not has & {ck.MeniscusForce, ck.ViscousForce}:
        return False
    if limited and (ck.ViscousForce not in has or imposed == "time"):
        return False
    # As published, and consistent.
    return all(body in OWNED[e] for e in effects) and not mixed(scene_of(effects, body, imposed))


def film_cases(body):
    """Effects of the film over one body: each alone as it is imposed, and each pair."""
    found = []
    for case in product_of({**by_kind(OWNED), "imposed": IMPOSED}):
        effects = tuple(e for name, e in case.items() if name != "imposed" and e is not None)
        if fits(effects, body, case["imposed"]):
            found.append((case, effects))
    alone = [(effects, body, case["imposed"]) for case, effects in found if len(effects) == 1]
    wanted = pairwise([case for case, _ in found])
    return alone + [(effects, body, c["imposed"]) for c, effects in found if c in wanted]


def beside(wetting):
    """What an effect of dynamic wetting stands beside."""
    if isinstance(wetting, ck.TroutonForce):  # of the film alone
        return (ck.ViscousForce(),)
    # A line that recedes leaves a film where its angle is zero, or falls to that.
    angle = (ck.CoxVoinovAngle(),) if isinstance(wetting, ck.LandauLevichFilm) else ()
    return (ck.MeniscusForce(), ck.ViscousForce(), *angle)


def cases():
    for body in BODIES:
        yield from film_cases(body)
        solids = [solid for solid, bodies in SOLIDS.items() if body in bodies]
        factors = {"solid": solids, "film": BESIDE, "imposed": IMPOSED}
        for case in pairwise([*product_of(factors)]):
            yield (*case["film"], case["solid"]), body, case["imposed"]
    for case in product_of({"rough": ROUGH, "imposed": IMPOSED}):
        yield (case["rough"],), "flats", case["imposed"]
    for wetting in WETTING:
        yield (*beside(wetting), wetting), "sphere", "speed"
    for other, body in itertools.product(OTHERS, BODIES):
        if not other.lacks(scene_of((other,), body, "speed")):
            yield (other,), body, "speed"


CASES = list(dict.fromkeys(cases()))


# Each effect alone, and some of the pairs, before the others.
FIRST = (i for i, case in enumerate(CASES) if len(case[0]) == 1 or i % 3 == 0)


@pytest.mark.parametrize(("effects", "body", "imposed"), quick(CASES, *FIRST), ids=label)
def test_a_scene_runs_with_every_other_kernel_poisoned(monkeypatch, effects, body, imposed):
    poison_all_but(monkeypatch, allowed(effects, body, imposed))
    assert run(effects, body, imposed).status in ("curve", "released")


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
        "as_published.printed.common.meniscus_of_circle_3_12",
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
        (ck.ViscousForce(), ck.TensionLimit(strength=1e4, cavity="truncated")),
        "flats",
        "force",
        "lubrication.film_limits.disc_tension_truncated",
    ),
    (
        (ck.ViscousForce(), ck.TensionLimit(strength=1e4, cavity="reynolds")),
        "flats",
        "force",
        "lubrication.film_limits.disc_tension_reynolds",
    ),
    (
        (ck.ViscousForce(), ck.TensionLimit(strength=1e4, cavity="truncated")),
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
        (ck.ViscousForce(), ck.Rupture(gap="zero-neck")),
        "flats",
        "time",
        "capillary.arc.flat.zero_neck_gap",
    ),
    (
        (ck.ViscousForce(), ck.Rupture(gap="zero-neck")),
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
                "capillary.condensed.max_gap_on_sphere",
                "capillary.asperities.identical",
                "capillary.condensed.max_gap_on_sphere",
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
    *(
        ((*beside(wetting), wetting), "sphere", "speed", heart)
        for wetting, heart in (
            (ck.LiquidWeight(), "capillary.wetting.weight.upper_share"),
            (ck.LandauLevichFilm(), "capillary.wetting.landau_levich.film_fraction"),
            (ck.CoxVoinovAngle(), "capillary.wetting.cox_voinov.dynamic_angle"),
            (ck.DynamicRupture(), "capillary.exact.stability.stability_limit"),
        )
    ),
]


def test_without_its_own_kernel_no_scene_runs(monkeypatch):
    """The negative control."""
    immune = [
        f"{label(effects)} {body} {imposed}: {heart}"
        for effects, body, imposed, heart in HEARTS
        if survives(monkeypatch, heart, lambda c=(effects, body, imposed): run(*c))
    ]
    assert immune == []


def test_every_effect_and_every_choice_is_poisoned():
    """Limits and ends of the film, and choices of an effect, need their lines in the table.

    Effects that are coupled with the film have another engine, which no scene above asks for.
    """
    laws = {kind for kind in SEPARATION_EFFECTS if not issubclass(kind, CoupledEffect)}
    assert {type(effect) for effect in TABLE | OTHERS} == laws
    assert {effect for case in CASES for effect in case[0]} == {*TABLE, *OTHERS}
    solids = [effect for effect in SOLIDS if isinstance(effect, ck.AdhesiveContact)]
    assert {effect.model for effect in solids} == {"jkr", "dmt", "maugis-dugdale"}
    assert {effect.form for effect in OWNED if isinstance(effect, ck.MeniscusForce)} == {
        "exact",
        "arc",
        "as-published",
    }


def test_without_a_line_an_effect_owns_what_its_module_imports():
    assert imported_by(ck.AsperityMenisci) == {
        "capillary.arc.shape.*",
        "capillary.asperities.*",
        "capillary.asperity_bridges.*",
        "capillary.kelvin.*",
        "capillary.many_menisci.*",
    } & {f"{name.rpartition('.')[0]}.*" for name in kernels()}


def test_the_table_names_kernels_that_exist():
    patterns = set().union(VALIDITY_OF_BOTH, *MOTION.values(), *VALIDITY.values(), *EXTENT.values())
    for bodies in TABLE.values():
        patterns |= set().union(*bodies.values())
    assert unknown(patterns) == []
