"""Only the effects a contact calls for: every kernel they do not own raises, and it is solved."""

from __future__ import annotations

import numpy as np
import pytest
import scipy.fft
from poison import by_kind, label, pairwise, poison_all_but, product_of, survives, unknown
from selection import quick

import contactkit as ck
from contactkit.contact.effects.base import ContactEffect
from contactkit.contact.solve import solve
from contactkit.kinds import CONTACT_EFFECTS, HARDNESS_RULES

pytestmark = pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning")

# Asked for twenty thousand times while the cases are chosen.
Adhesion, FrictionCoupling, FrictionTraction = (
    ck.Adhesion,
    ck.FrictionCoupling,
    ck.FrictionTraction,
)
HardnessLimit, PartialSlip, PlasticHistory = ck.HardnessLimit, ck.PartialSlip, ck.PlasticHistory
SubsurfaceStress = ck.SubsurfaceStress

# What each effect may call. `*` stands for the rest of a name.
LAYERS = {"elasticity.layered.*", "elasticity.layer_recursion.*", "elasticity.layer_stack.*"}
FIELDS = {
    "elasticity.stress.periodic.*",
    "elasticity.stress.isolated.*",
    "elasticity.stress.strips.*",
    *LAYERS,
}
SLIP = {
    "contact.slip.*",
    "elasticity.stress.tractions.traction_coupling",
    "elasticity.tangential.*",
    "elasticity.tangential_one_axis.*",
    "elasticity.love.*",
    "elasticity.point_load.*",
    "elasticity.influence.*",
    *FIELDS,
}
FILM = "capillary.film_islands.*"
TO_STICK = {"work_of_adhesion": 1e-3, "range": 2e-9}
EXPONENTIAL = ck.ExponentialAttraction(**TO_STICK)
DUGDALE = ck.DugdaleAttraction(**TO_STICK)
LENNARD_JONES = ck.LennardJonesAttraction(**TO_STICK)
OF_THE_MAP = {
    "adhesion.parameters.tabor_parameter",
    "roughness.statistics.rms_curvature",
    "roughness.statistics.rms_slope",
}
OWNED = {
    ck.HalfSpace(): set(),  # by the edges of the window, below
    ck.LayeredHalfSpace(): set(),
    ck.HardnessLimit(): {"elasticity.hardness_rules.effective_hardness"},
    ck.HardnessLimit(rule="literal"): {
        "elasticity.hardness_rules.effective_hardness_literal",
        "elasticity.hardness_rules.layer_on_substrate",
    },
    ck.HardnessLimit(rule="material"): set(),
    ck.HardnessLimit(rule=ck.ConstantHardness(hardness=1e9)): set(),
    ck.PlasticHistory(pressures=(2e6, 0.0), steps=2): {"elasticity.hardness_rules.*"},
    ck.Viscoelasticity(times=(1.0, 2.0), steps=1): {
        "elasticity.prony.*",
        "elasticity.creep_symbol.*",
    },
    ck.FrictionTraction(coefficient=0.2): set(),
    ck.FrictionCoupling(): {
        "contact.slip.coupling.coupling_of",
        "contact.slip.coupling.coupling_strength",
        "elasticity.stress.tractions.traction_coupling",
        *FIELDS,
    },
    ck.PartialSlip(coefficient=0.2, path=(ck.TangentialStep(ratio=0.5),)): SLIP,
    ck.PartialSlip(coefficient=0.2, path=(ck.TangentialStep(force=0.0),), components=2): SLIP,
    ck.SubsurfaceStress(depths=(0.0, 1e-8)): {
        "elasticity.stress.planes.component",
        "elasticity.stress.reading.*",
        "elasticity.stress.maxima.*",
        "elasticity.stress.measures.*",
        "elasticity.layered_fields.*",
        "elasticity.depths.*",
        *FIELDS,
    },
    ck.Adhesion(law=EXPONENTIAL): {"adhesion.attraction.exponential_*", *OF_THE_MAP},
    ck.Adhesion(law=DUGDALE): {"adhesion.attraction.dugdale_*", *OF_THE_MAP},
    ck.Adhesion(law=LENNARD_JONES): {"adhesion.attraction.lennard_jones_*", *OF_THE_MAP},
    ck.FilmMeniscus(film_thickness=1e-9): {FILM},
    ck.FilmMeniscus(film_thickness=1e-9, self_consistent=True): {FILM},
    ck.IslandBridges(film_thickness=1e-9): {
        FILM,
        "capillary.island_bridges.*",
        "capillary.exact.*",
        "capillary.arc.*",
    },
}

# What is not an effect's: the compliance by the edges of the window, the heights, the solver.
EDGES = {
    "periodic": LAYERS,
    "isolated": {
        "elasticity.influence.*",
        "elasticity.love.*",
        "elasticity.point_load.*",
        *LAYERS,
    },
    "along x": {
        "elasticity.one_axis.*",
        "elasticity.influence.*",
        "elasticity.love.*",
        "elasticity.point_load.*",
        *LAYERS,
    },
}
PERIODIC = {"periodic": True, "isolated": False, "along x": "x"}
SHAPES = {
    "heights": set(),
    "paraboloid": {"roughness.elementary.paraboloid"},
    "sphere": {"roughness.elementary.sphere"},
    "wave": {"roughness.elementary.wave"},
    "gaussian": {
        "roughness.random_surfaces.gaussian_exponential",
        "roughness.random_surfaces.add_up",
        "roughness.random_surfaces.waves",
    },
    "self-affine": {
        "roughness.random_surfaces.self_affine",
        "roughness.random_surfaces.add_up",
        "roughness.random_surfaces.waves",
    },
}
SOLVER = {"contact.solver.*"}
WATER = ck.Liquid(name="water", viscosity=1e-3, surface_tension=0.07)
HARD = ck.Material(young_modulus=3e9, poisson_ratio=0.2, hardness=1e8)
SOFT = ck.Material(young_modulus=1e9, poisson_ratio=0.3, hardness=5e7)
GEL = ck.ViscoelasticMaterial(young_modulus=1e9, fractions=0.5, times=1.0, poisson_ratio=0.3)
GLUED = ck.Stack(layers=(ck.Layer(material=HARD, thickness=5e-9),), substrate=GEL)
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


def press(effects, edges, shape="heights"):
    is_layered = any(isinstance(effect, ck.LayeredHalfSpace) for effect in effects)
    relaxes = any(isinstance(effect, ck.Viscoelasticity) for effect in effects)
    layered, bare = (GLUED, GEL) if relaxes else (LAYERED, SOFT)
    known = shape == "heights"
    scene = ck.ContactScene(
        interface=ck.Interface(
            lower=ck.Body(solid=layered if is_layered else bare),
            upper=ck.Body(surface=SURFACES[shape]),
            meniscus=ck.Meniscus(liquid=WATER),
        ),
        window=ck.Window(width=None if known else 4e-7, periodic=PERIODIC[edges]),
        loading=ck.Pressing(pressure=1e6),
        effects=effects,
    )
    return solve(ck.plan(scene, ck.Accuracy(grid=None if known else 16)))


def is_refused(effects):
    """Whether two laws of friction are listed, an attraction with a film, or creep with others."""
    kinds = {type(effect) for effect in effects if isinstance(effect, ContactEffect)}
    if ck.Viscoelasticity in kinds and not all(kind.takes_relaxation for kind in kinds):
        return True
    if PartialSlip in kinds and {FrictionTraction, SubsurfaceStress} & kinds:
        return True  # two laws of friction; a stress without the traction of the first
    return Adhesion in kinds and not all(kind.takes_tension for kind in kinds)


def cases():
    """Each effect alone on each solid and window, and each pair."""
    laws = [e for e in OWNED if isinstance(e, ck.HalfSpace | ck.LayeredHalfSpace)]
    others = by_kind(effect for effect in OWNED if effect not in laws)
    found = []
    for case in product_of({"law": laws, "edges": EDGES, **others}):
        kinds = {type(level) for level in case.values()}
        is_complete = FrictionTraction in kinds or FrictionCoupling not in kinds
        is_complete &= PlasticHistory not in kinds or HardnessLimit in kinds
        if is_complete and not is_refused(case.values()):
            found.append(case)
    wanted = pairwise(found)
    for case in found:
        chosen = tuple(case[name] for name in others if case[name] is not None)
        if len(chosen) <= 1 or case in wanted:
            yield (case["law"], *chosen), case["edges"]


CASES = list(cases())


def allowed(effects, edges, shape="heights"):
    owned = set().union(*(OWNED[effect] for effect in effects))
    return owned | SOLVER | EDGES[edges] | SHAPES[shape]


# Each effect alone, on a solid, and some of the pairs, before the others.
FIRST = (i for i, case in enumerate(CASES) if len(case[0]) <= 2 or i % 3 == 0)


@pytest.mark.parametrize(("effects", "edges"), quick(CASES, *FIRST), ids=label)
def test_a_contact_runs_with_every_other_kernel_poisoned(monkeypatch, effects, edges):
    poison_all_but(monkeypatch, allowed(effects, edges))
    assert press(effects, edges).status == "converged"


@pytest.mark.parametrize("shape", SHAPES)
def test_a_surface_calls_its_own_recipe_only(monkeypatch, shape):
    effects = (ck.LayeredHalfSpace(),)
    poison_all_but(monkeypatch, allowed(effects, "periodic", shape))
    assert press(effects, "periodic", shape).status == "converged"


HEARTS = [
    ((), "periodic", "elasticity.layered.normal_symbol"),
    ((), "isolated", "elasticity.influence.symbol"),
    ((), "along x", "elasticity.one_axis.symbol"),
    ((ck.HardnessLimit(),), "periodic", "elasticity.hardness_rules.effective_hardness"),
    (
        (ck.HardnessLimit(rule="literal"),),
        "periodic",
        "elasticity.hardness_rules.effective_hardness_literal",
    ),
    (
        (ck.FrictionTraction(coefficient=0.2), ck.FrictionCoupling()),
        "periodic",
        "elasticity.stress.tractions.traction_coupling",
    ),
    (
        (ck.PartialSlip(coefficient=0.2, path=(ck.TangentialStep(ratio=0.5),)),),
        "periodic",
        "elasticity.tangential.periodic_symbol",
    ),
    (
        (ck.PartialSlip(coefficient=0.2, path=(ck.TangentialStep(ratio=0.5),)),),
        "along x",
        "elasticity.tangential_one_axis.one_axis_symbol",
    ),
    (
        (ck.Viscoelasticity(times=1.0),),
        "periodic",
        "elasticity.creep_symbol.common_times",
    ),
    ((ck.SubsurfaceStress(),), "isolated", "elasticity.stress.maxima.plane_maxima"),
    ((ck.Adhesion(law=DUGDALE),), "isolated", "adhesion.attraction.dugdale_tension"),
    ((ck.FilmMeniscus(film_thickness=1e-9),), "periodic", "capillary.film_islands.meniscus_area"),
]


def test_without_its_own_kernel_no_contact_is_solved(monkeypatch):
    """The negative control."""
    layered = ck.LayeredHalfSpace()
    immune = [
        heart
        for effects, edges, heart in HEARTS
        if survives(monkeypatch, heart, lambda e=effects, p=edges: press((layered, *e), p))
    ]
    assert immune == []


def _counted(original, calls):
    def counted(*args, **kwargs):
        calls.append(original)
        return original(*args, **kwargs)

    return counted


def transforms(monkeypatch, effects, edges="periodic"):
    """Transforms of scipy that a contact takes; those by another library are never more."""
    made = []
    with monkeypatch.context() as patched:
        for name in ("rfft", "fft", "ifft", "irfft", "rfft2", "irfft2", "rfftn", "irfftn"):
            patched.setattr(scipy.fft, name, _counted(getattr(scipy.fft, name), made))
        result = press((ck.LayeredHalfSpace(), *effects), edges)
    return len(made), result.work.n_ffts


@pytest.mark.parametrize("edges", quick(["periodic", "isolated"], 0), ids=label)
def test_what_a_scene_does_not_call_for_is_not_transformed(monkeypatch, edges):
    friction, none = ck.FrictionTraction(coefficient=0.2), ck.FrictionTraction(coefficient=0.0)
    alone = transforms(monkeypatch, (), edges)
    assert transforms(monkeypatch, (friction,), edges) == alone
    weak = ck.FilmMeniscus(film_thickness=1e-15)  # a strong one has its balance estimated
    assert transforms(monkeypatch, (weak,), edges) == alone
    counts = [
        transforms(monkeypatch, effects, edges)[0]
        for effects in (
            (ck.SubsurfaceStress(depths=(1e-8,)),),
            (ck.SubsurfaceStress(depths=(1e-8,)), none),
            (ck.SubsurfaceStress(depths=(1e-8,)), friction),
            (ck.SubsurfaceStress(depths=(1e-8,), coefficients=(0.0, 0.1, 0.5)), friction),
            (ck.SubsurfaceStress(depths=(1e-8, 2e-8), coefficients=(0.0, 0.1, 0.5)), friction),
        )
    ]
    # The traction is a multiple of the pressure, and stress is linear in the coefficient.
    assert alone[0] < counts[0] == counts[1] == counts[2] < counts[3] < counts[4]
    assert counts[3] - counts[2] < counts[2] - alone[0]  # three more take those of one


def test_every_effect_and_every_choice_is_poisoned():
    """A new effect, or a new choice of one, needs its line in the table."""
    assert {type(effect) for effect in OWNED} == set(CONTACT_EFFECTS)
    assert {effect for case in CASES for effect in case[0]} == set(OWNED)
    rules = {type(effect.rule) for effect in OWNED if isinstance(effect, ck.HardnessLimit)}
    assert rules == set(HARDNESS_RULES)


def test_the_table_names_kernels_that_exist():
    assert unknown(set().union(SOLVER, *OWNED.values(), *SHAPES.values(), *EDGES.values())) == []
