"""Whatever contactkit hands out can be pickled and deep-copied, with the same numbers."""

from __future__ import annotations

import concurrent.futures
import copy
import functools
import inspect
import multiprocessing
import pickle
import tempfile
from pathlib import Path

import attrs
import numpy as np
import pytest
from selection import quick

import contactkit as ck
from contactkit.analyses.deforming.release import ReleaseCurve
from contactkit.analyses.deforming.stiction import StictionTable
from contactkit.contact.arrays.result import MapsResult
from contactkit.fmu.master.couple import Coupled
from contactkit.fmu.master.injector import CoSimulation
from contactkit.fmu.slaves.stiction_mass import StictionMass
from contactkit.frozen import FrozenDict
from contactkit.models.injector import monolithic
from contactkit.scene.plan import ScenePlan
from contactkit.scene.result import Result
from contactkit.scene.scenes import Scene
from contactkit.work_precision import Outcome, Setting, sweep

pytestmark = pytest.mark.filterwarnings("ignore::contactkit.ValidityWarning")

OIL = ck.Liquid(name="oil", viscosity=0.1, surface_tension=0.03, density=870.0)
SOFT = ck.Material(young_modulus=1e9, poisson_ratio=0.3, hardness=1e8)
FILM = ck.Interface(
    lower=ck.Flat(radius=1e-3),
    upper=ck.Flat(radius=1e-3),
    meniscus=ck.Meniscus(liquid=OIL, volume=1e-12),
)
OPENING = ck.ImposedSpeed(speed=1e-3, initial_gap=1e-6, final_gap=1e-5)
GRID = ck.Accuracy(grid=12)


def rough(*effects, **meniscus):
    """A layered wave in contact."""
    layer = ck.Layer(material=SOFT, thickness=1e-7)
    liquid = {"liquid": OIL, **meniscus}
    return ck.ContactScene(
        interface=ck.Interface(
            lower=ck.Body(solid=ck.Stack(layers=(layer,), substrate=SOFT)),
            upper=ck.Wave(amplitude=1e-9, wavelength=1e-6),
            meniscus=ck.Meniscus(**liquid),
        ),
        window=ck.Window(width=1e-6),
        loading=ck.Pressing(pressure=1e5),
        effects=(ck.LayeredHalfSpace(), *effects),
    )


def separation(*effects, loading=OPENING, interface=FILM):
    return ck.SeparationScene(interface=interface, loading=loading, effects=effects)


def film():
    return separation(ck.MeniscusForce(), ck.ViscousForce())


def pulled():
    loading = ck.ImposedForce(force=10.0, mass=0.01, initial_gap=1e-6, final_gap=2e-6)
    return separation(ck.MeniscusForce(), ck.ViscousForce(), loading=loading)


def sphere(*effects):
    liquid = ck.load_liquid("water")
    ball = ck.Interface(
        upper=ck.Sphere(radius=1e-6), meniscus=ck.Meniscus(liquid=liquid, relative_humidity=0.5)
    )
    opening = ck.ImposedSpeed(speed=1e-6, initial_gap=3e-10, final_gap=1e-8)
    return separation(*effects, loading=opening, interface=ball)


def sliding():
    loading = ck.Sliding(gap=1e-6, speed=1e-3)
    return ck.SlidingScene(interface=FILM, loading=loading, effects=(ck.CouetteForce(),))


def all_effects():
    effects = (
        ck.HardnessLimit(),
        ck.FrictionTraction(coefficient=0.2),
        ck.FrictionCoupling(),
        ck.SubsurfaceStress(depths=(0.0, 2e-8)),
        ck.IslandBridges(film_thickness=1e-9),
        ck.FilmMeniscus(film_thickness=2e-10),
    )
    return ck.solve(ck.plan(rough(*effects), GRID))


def adhesion():
    scene = sphere(ck.AdhesiveContact(model="jkr", reduced_modulus=1e9, work_of_adhesion=0.05))
    return ck.adhesion_curve(scene, [0.0, 1e-8])


def stick_slip():
    friction = {"static_coefficient": 0.3, "kinetic_coefficient": 0.2}
    block = ck.SpringSlider(load=1.0, **friction, stiffness=1e3, speed=1e-3, mass=1e-2)
    return ck.stick_slip(block, n_slips=2)


def pull_off():
    law = ck.ExponentialAttraction(work_of_adhesion=0.01, range=1e-8)
    return ck.pull_off_curve(ck.plan(rough(ck.Adhesion(law=law)), GRID), [-1e-8, 0.0])


def released():
    return monolithic.simulate(ck.plan(pulled()), lambda time: 10.0, 1e-4)


def outcome():
    return Outcome(1.0, {"steps": 3})


def signals():
    time = np.linspace(0.0, 1.0, 3)
    return time, {"h": time.copy(), "F": time.copy()}


def saved():
    with tempfile.TemporaryDirectory() as folder:
        return ck.read_curve(stick_slip().save(Path(folder) / "slips"))


def coupled():
    return Coupled(*signals(), 0.5, -1.0, ("a line",), 2, 0, 7, 0.1)


def cosimulation():
    ports = {port.name: port for port in StictionMass.ports if port.name in ("h", "F")}
    return CoSimulation(*signals(), ports, ("a line",), 2, 0.1)


def deforming():
    gel = ck.Body(
        surface=ck.Flat(radius=5e-4), solid=ck.Material(young_modulus=1e6, poisson_ratio=0.5)
    )
    oil = ck.Meniscus(liquid=ck.Liquid(name="oil", viscosity=0.1))
    return ck.SeparationScene(
        interface=ck.Interface(lower=gel, upper=ck.Sphere(radius=5e-3), meniscus=oil),
        loading=ck.ImposedSpeed(speed=1e-5, initial_gap=1e-6, final_gap=2e-6),
        effects=(ck.ElasticBodies(), ck.ViscousForce()),
    )


def readings():
    return ck.MeasuredCurve(
        over="gap",
        at=[2e-6, 3e-6, 4e-6, 8e-6],
        quantity="viscous_force",
        values=[4.0, 1.2, 0.5, 0.06],
    )


def fitted():
    sought = {"interface.meniscus.liquid.viscosity": (1e-3, 1e3)}
    scene = separation(ck.ViscousForce(), interface=ck.Interface(
        lower=ck.Flat(radius=1e-3), upper=ck.Flat(radius=1e-3), meniscus=ck.Meniscus(liquid=OIL)
    ))  # fmt: skip
    return through_pickle(ck.fit(scene, readings(), sought))  # without the search


MADE = {
    "works to cite": lambda: ck.cite(film()),
    "surface": lambda: ck.Heights(heights=[[0.0, 1e-9], [2e-9, 0.0]], pixel_size=1e-8),
    "separation plan": lambda: ck.plan(film()),
    "sliding plan": lambda: ck.plan(sliding()),
    # What is prepared is not pickled, nor the memory that only it can state.
    "contact plan": lambda: ck.plan(rough(), GRID).without_preparation(),
    "solved plan": lambda: ck.solve(ck.plan(rough(), GRID)).plan,
    "curve": lambda: ck.simulate(ck.plan(film())),
    "motion": lambda: ck.simulate(ck.plan(pulled())),
    "sphere": lambda: ck.simulate(ck.plan(sphere(ck.MeniscusForce()))),
    "deforming": lambda: ck.simulate(ck.plan(deforming())),
    "deforming plan": lambda: ck.plan(deforming()),
    "moduli": lambda: ck.modulus_curve(deforming(), [1.0]),
    "pull-off over speed": lambda: ck.pull_off_over_speed(deforming(), [1e-5]),
    "release": lambda: ReleaseCurve("force", *np.ones((4, 2))),
    "stiction": lambda: StictionTable(*np.ones((5, 2))),
    "slide": lambda: ck.simulate(ck.plan(sliding())),
    "contact with every effect": all_effects,
    "study": lambda: ck.study(rough(), {"loading.pressure": [1e5, 2e5]}, GRID, keep_maps=True),
    "sensitivity": lambda: ck.sensitivity(
        rough(), {"loading.pressure": (1e5, 2e5)}, "contact_area", GRID
    ),
    "gradient": lambda: ck.solve(ck.plan(rough(), GRID)).gradient("load", "loading.pressure"),
    "sobol": lambda: ck.sobol_indices(
        rough(), {"loading.pressure": (1e5, 2e5)}, "contact_area", GRID, n=2
    ),
    "measured curve": readings,
    "fit": fitted,
    "comparison of fits": lambda: ck.compare_fits(dict.fromkeys("ab", made("fit"))),
    "load curve": lambda: ck.load_curve(ck.plan(rough(), GRID), pressures=[1e5, 2e5]),
    "load-displacement curve": lambda: ck.load_displacement(rough(), points=4, accuracy=GRID),
    "humidity curve": lambda: ck.humidity_curve(sphere(ck.MeniscusForce()), [0.2, 0.5]),
    "adhesion curve": adhesion,
    "pull-off curve": pull_off,
    "stick-slip": stick_slip,
    "saved curve": saved,
    "division": lambda: ck.divide_meniscus(film(), [1, 2]),
    "critical meniscus": lambda: ck.critical_meniscus(film()),
    "printed equation": lambda: ck.PUBLISHED["3.19"],
    "monolithic run": released,
    "coupled run": coupled,
    "co-simulation": cosimulation,
    "work-precision": lambda: sweep([Setting("a", "b", outcome)], 1.0, quantity="x", floor=0.1),
    "scene": lambda: rough(ck.HardnessLimit()),
    "planform": lambda: ck.equilateral_triangle(1e-3),
    "frozen mapping": lambda: FrozenDict(a=FrozenDict(b=1)),
}


@functools.cache
def made(name):
    return MADE[name]()


def through_pickle(value):
    return pickle.loads(pickle.dumps(value))


def numbers(value):
    """All arrays and numbers that a value shows, by their names, for a comparison by bits."""
    if isinstance(value, np.ndarray):
        return value.shape, value.dtype.str, value.tobytes()
    if isinstance(value, Result):
        shown = {name: numbers(column) for name, column in value.columns.items()}
        return shown, repr(value.scalars()), value.status, value.cite()
    if isinstance(value, ScenePlan):
        return str(value), value.cite()
    if isinstance(value, dict):
        return {key: numbers(one) for key, one in value.items()}
    if isinstance(value, tuple | list):
        return [numbers(one) for one in value]
    if attrs.has(type(value)):
        names = [a.name for a in attrs.fields(type(value)) if a.init]
        return {name: numbers(getattr(value, name)) for name in names}
    return repr(value)


LONG = {"comparison of fits", "deforming", "fit", "pull-off over speed"}
QUICK = [i for i, name in enumerate(MADE) if name not in LONG]


@pytest.mark.parametrize("copied", [through_pickle, copy.deepcopy])
@pytest.mark.parametrize("name", quick(MADE, *QUICK))
def test_what_is_pickled_or_copied_holds_the_same_numbers(name, copied):
    value = made(name)
    again = copied(value)
    assert type(again) is type(value)
    assert numbers(again) == numbers(value)


def handed_out():
    """Classes of plans and results, and those that the functions at the top return."""
    found = {*_leaves(ScenePlan), *_leaves(Result), *_leaves(Scene)}
    for name in ck.__all__:
        function = getattr(ck, name)
        if inspect.isfunction(function):
            returned = inspect.signature(function).return_annotation
            module = inspect.getmodule(function)
            names = [part.strip() for part in str(returned).split("|")]
            found |= {getattr(module, one) for one in names if hasattr(module, one)}
    classes = (one for one in found if isinstance(one, type) and attrs.has(one))
    known = (one for one in classes if one.__module__.startswith("contactkit."))
    return {one for one in known if not one.__subclasses__()}


def _leaves(kind):
    below = [one for sub in kind.__subclasses__() for one in _leaves(sub)]
    return below or [kind]


def test_every_class_that_is_handed_out_is_tried():
    tried = {type(made(name)) for name in MADE}
    tried |= {type(made(name).scene) for name in MADE if isinstance(made(name), ScenePlan)}
    parts = {ck.Material, ck.Liquid}  # of the scenes above
    parts.add(MapsResult)  # arrays of any library, which pickles them or not
    assert {kind.__name__ for kind in handed_out() - tried - parts} == set()


def test_the_copy_of_a_result_is_frozen_as_the_result_was():
    again = through_pickle(made("contact with every effect"))
    with pytest.raises(ValueError, match="read-only"):
        again.pressure[0, 0] = 1.0
    with pytest.raises(TypeError, match="cannot be changed"):
        again.parts.clear()
    stress = made("contact with every effect").of(ck.SubsurfaceStress)
    assert numbers(again.of(ck.SubsurfaceStress)) == numbers(stress)


def test_a_plan_that_was_pickled_runs_to_the_same_numbers():
    for name, run in (("contact plan", ck.solve), ("separation plan", ck.simulate)):
        again = run(through_pickle(made(name)))
        assert numbers(again)[0] == numbers(run(MADE[name]()))[0]  # solving one prepares it


@pytest.mark.slow
def test_results_come_back_from_other_processes():
    context = multiprocessing.get_context("spawn")
    with concurrent.futures.ProcessPoolExecutor(1, context) as pool:
        back = list(pool.map(ck.simulate, [made("separation plan"), made("sliding plan")]))
    assert numbers(back[0]) == numbers(made("curve"))
    assert numbers(back[1]) == numbers(made("slide"))
