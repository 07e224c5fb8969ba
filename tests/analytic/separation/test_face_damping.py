"""Viscous force of faces that are no plain disc: a law made once, in scenes, files and FMUs."""

import math

import numpy as np
import pytest

import contactkit as ck
from contactkit.lubrication import reynolds

pytestmark = pytest.mark.filterwarnings("ignore::contactkit.ValidityWarning")

OIL = ck.Liquid(name="oil", viscosity=0.1)
PULL = ck.ImposedForce(initial_gap=5e-6, final_gap=25e-6, force=40.0, mass=0.02)
RADIUS = 3.175e-3


def scene(damping=None, loading=PULL, radius=None, effects=(), **meniscus):
    face = ck.Flat(radius=radius)
    film = ck.Meniscus(liquid=OIL, **meniscus)
    return ck.SeparationScene(
        interface=ck.Interface(lower=face, upper=face, meniscus=film),
        loading=loading,
        effects=(ck.ViscousForce(damping=damping), *effects),
    )


def test_the_law_of_a_disc_is_the_disc():
    plain = ck.simulate(ck.plan(scene(radius=RADIUS)))
    law = ck.simulate(ck.plan(scene(reynolds.disc_damping(RADIUS))))
    assert law.state.release_time == pytest.approx(plain.state.release_time, rel=1e-9)
    assert law.impulses["viscous_impulse"] == pytest.approx(
        plain.impulses["viscous_impulse"], rel=1e-9
    )
    assert np.array_equal(law["film_status"], plain["film_status"])


def test_a_vented_ring_is_released_sooner_as_its_damping_is_less():
    """Massless but for the start: time goes with the damping."""
    pull = ck.ImposedForce(initial_gap=5e-6, final_gap=25e-6, force=40.0)
    disc, ring = (
        ck.simulate(ck.plan(scene(law, pull))).state.release_time
        for law in (reynolds.disc_damping(RADIUS), reynolds.ring_damping(RADIUS, 0.3 * RADIUS))
    )
    assert ring / disc == pytest.approx(1.4330081133966175 / 4.71238898038469, rel=1e-6)


def test_any_face_by_the_solver():
    face = reynolds.rasterise(
        ck.Disc(radius=RADIUS) - ck.Disc(radius=5e-4, centre=(1.5e-3, 0.0)), 48
    )
    law = reynolds.face_damping(face)
    result = ck.simulate(ck.plan(scene(law)))
    whole = ck.simulate(ck.plan(scene(reynolds.disc_damping(RADIUS))))
    assert 0.2 < result.state.release_time / whole.state.release_time < 0.95


FILE = """
[interface.lower]
shape = "flat"
[interface.upper]
shape = "flat"
[interface.meniscus]
liquid = { name = "oil", viscosity = "100 mPa.s" }
[loading]
kind = "imposed-force"
initial_gap = "5 um"
final_gap = "25 um"
force = "40 N"
mass = "20 g"
[[effects]]
effect = "viscous-force"
damping = { face = "ring", radius = "3.175 mm", hole_radius = "1 mm" }
"""


def test_a_file_names_a_face_and_a_result_file_holds_its_law(tmp_path):
    path = tmp_path / "ring.toml"
    path.write_text(FILE, encoding="utf-8")
    made = ck.load_scene(path)
    law = made.effects[0].damping
    assert law == reynolds.ring_damping(RADIUS, 1e-3)
    result = ck.simulate(ck.plan(made))
    result.save(tmp_path / "ring.npz")
    again = ck.load_result(tmp_path / "ring.npz")
    assert again.plan.scene == made
    path.write_text(FILE.replace('"ring"', '"rign"'), encoding="utf-8")
    with pytest.raises(ck.DescriptionError, match="ring"):
        ck.load_scene(path)


@pytest.mark.parametrize(
    ("more", "part"),
    [
        ({"volume": 1e-10}, "a flooded film"),
        ({"radius": RADIUS}, "no radius of a Flat face"),
        ({"effects": (ck.TensionLimit(),)}, "no TensionLimit"),
        ({"count": 3}, "interface.meniscus.count = 1"),
    ],
)
def test_what_a_face_does_not_go_with_is_refused(more, part):
    with pytest.raises(ck.PlanError, match=part):
        ck.plan(scene(reynolds.disc_damping(RADIUS), **more))


def test_a_wrong_law_is_refused():
    with pytest.raises(ck.DescriptionError, match=r"ViscousForce\.damping"):
        ck.ViscousForce(damping=math.pi)
