"""What a plan and a run evaluate, counted: nothing is computed twice, and nothing kept for ever."""

import gc

import attrs
import numpy as np
import pytest

import contactkit as ck
from contactkit.capillary import kelvin
from contactkit.lubrication.reynolds import face as film_face
from contactkit.roughness import height_maps
from contactkit.scene import rough_surfaces
from contactkit.separation import prescribed
from contactkit.separation.film import Film
from contactkit.separation.wetting import line

pytestmark = pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning")


@pytest.fixture
def counted(monkeypatch):
    """Function that lists the arguments of each call of a function or method from now on."""

    def count(owner, name):
        calls, of = [], getattr(owner, name)

        def called(*given, **more):
            calls.append(given)
            return of(*given, **more)

        monkeypatch.setattr(owner, name, called)
        return calls

    return count


def oil_film(loading, *effects):
    oil = ck.Liquid(name="oil", viscosity=0.1, surface_tension=0.03)
    face = ck.Flat(radius=1e-3)
    interface = ck.Interface(lower=face, upper=face, meniscus=ck.Meniscus(liquid=oil, volume=1e-11))
    return ck.SeparationScene(interface=interface, loading=loading, effects=effects)


PULLED = ck.ImposedForce(force=2.0, mass=1e-3, initial_gap=2e-6, final_gap=2e-5)
FORCES = (ck.MeniscusForce(), ck.ViscousForce())


@pytest.mark.parametrize("model", ["exact", "contact"])
def test_humidity_and_liquid_are_evaluated_once_in_a_plan(model, counted):
    vapour, liquid = counted(kelvin, "laplace_pressure"), counted(ck.Liquid, "at")
    film = ck.Meniscus(liquid=ck.load_liquid("water"), relative_humidity=0.5)
    interface = ck.Interface(lower=ck.Flat(), upper=ck.Sphere(radius=1e-6), meniscus=film)
    effects = (ck.MeniscusForce(profile="exact"), ck.ViscousForce())
    if model == "contact":
        effects = (
            ck.AdhesiveContact(work_of_adhesion="capillary", model="dmt", reduced_modulus=1e11),
            ck.ViscousForce(),
        )
    loading = ck.ImposedSpeed(speed=1e-6, initial_gap=1e-10, final_gap=1e-8)
    scene = ck.SeparationScene(interface=interface, loading=loading, effects=effects)
    made = ck.plan(scene)
    assert (len(vapour), len(liquid)) == (1, 1)
    assert made.prepared.liquid_pressure == pytest.approx(-93.6e6, rel=1e-2)


@pytest.mark.parametrize(
    "limits", [(), (ck.TensionLimit(strength=1e5),)], ids=["free", "cavitates"]
)
def test_no_force_along_a_motion_is_evaluated_twice_at_a_state(limits, counted):
    made = ck.plan(oil_film(PULLED, *FORCES, *limits))
    shown = counted(Film, "at")
    result = ck.simulate(made)
    n_states = result.work.n_steps + 1
    assert len(shown) <= n_states
    points = len(result["pull"])  # drawn when asked for: only what lies between the steps is new
    assert len(shown) < n_states + 3 * points
    places = [(gap, speed) for _, gap, speed, *_ in shown]
    assert len(set(places)) >= 0.98 * len(places)


def test_no_force_along_a_speed_is_evaluated_twice_at_a_gap(counted):
    loading = ck.ImposedSpeed(speed=1e-3, initial_gap=2e-6, final_gap=2e-5)
    rows = counted(prescribed, "_forces")
    result = ck.simulate(ck.plan(oil_film(loading, *FORCES)))
    assert len(rows) == result.work.n_evaluations


@pytest.mark.slow
def test_a_map_is_read_once_in_a_plan_and_goes_with_its_scene(counted, tmp_path):
    reads = counted(height_maps, "read_height_map")
    heights = 1e-7 * np.sin(np.linspace(0.0, 6.0, 32))[:, None] * np.ones((32, 32))
    np.savetxt(tmp_path / "map.txt", heights)
    surface = ck.Measured(path=str(tmp_path / "map.txt"), pixel_size=1e-6, unit="m")
    steel = ck.Material(young_modulus=210e9, poisson_ratio=0.3)
    upper = ck.Body(solid=steel, surface=surface)
    interface = ck.Interface(lower=ck.Body(solid=steel), upper=upper)
    scene = ck.ContactScene(
        interface=interface, loading=ck.Pressing(pressure=1e7), effects=(ck.HalfSpace(),)
    )
    result = ck.solve(ck.plan(scene))
    assert len(reads) == 1
    again = ck.plan(attrs.evolve(scene, loading=ck.Pressing(pressure=2e7)))
    ck.solve(again)
    assert len(reads) == 1
    assert len(rough_surfaces._FILES) == 1
    del surface, upper, interface, scene, result, again
    gc.collect()
    assert len(rough_surfaces._FILES) == 0


def test_the_rim_of_an_image_is_found_once_for_all_grids_of_a_plan(counted):
    found = counted(film_face, "distance_of_image")
    drawn = ck.Image(coverage=np.ones((16, 16)), pixel_size=1e-4)
    scene = ck.SeparationScene(
        interface=ck.Interface(
            upper=ck.Flat(planform=drawn, tilt=(1e-4, 0.0)),
            meniscus=ck.Meniscus(liquid=ck.Liquid(name="oil", viscosity=0.1)),
        ),
        loading=ck.ImposedForce(force=1.0, mass=1e-3, initial_gap=5e-6, final_gap=2e-5),
        effects=(ck.ViscousForce(),),
    )
    ck.plan(scene, ck.Accuracy(film_rtol=2e-2))
    assert len(found) == 1


def test_contact_lines_are_solved_once_for_plan_ranges_and_curves():
    oil = ck.Liquid(name="oil", viscosity=0.1, surface_tension=0.02)
    bodies = {"lower": ck.Flat(), "upper": ck.Sphere(radius=4e-3)}
    film = ck.Meniscus(liquid=oil, volume=1e-9, contact_angle_lower=0.7, contact_angle_upper=0.7)
    scene = ck.SeparationScene(
        interface=ck.Interface(**bodies, meniscus=film),
        loading=ck.ImposedSpeed(speed=1e-4, initial_gap=5e-5, final_gap=4e-4),
        effects=(ck.MeniscusForce(), ck.CoxVoinovAngle()),
    )
    before = line._curves.cache_info().misses
    found = ck.simulate(ck.plan(scene))
    assert found["dynamic_angle_lower"][0] < 0.7
    assert line._curves.cache_info().misses == before + 1
