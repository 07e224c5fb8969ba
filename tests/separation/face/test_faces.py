"""Films on faces that are no disc: scenes of planforms, holes, recesses, tilts and crowns."""

import math

import numpy as np
import pytest

import contactkit as ck

pytestmark = pytest.mark.filterwarnings("ignore::contactkit.ValidityWarning")

OIL = ck.Liquid(name="oil", viscosity=0.1)
PULL = ck.ImposedForce(initial_gap=5e-6, final_gap=25e-6, force=40.0, mass=0.02)
SLOW = ck.ImposedForce(initial_gap=5e-6, final_gap=25e-6, force=40.0)
R = 3.175e-3


def scene(face, loading=PULL, effects=(), other=None, **meniscus):
    film = ck.Meniscus(liquid=OIL, **meniscus)
    return ck.SeparationScene(
        interface=ck.Interface(lower=other or ck.Flat(), upper=face, meniscus=film),
        loading=loading,
        effects=(ck.ViscousForce(), *effects),
    )


def impulse(face, **more):
    return ck.simulate(ck.plan(scene(face, **more))).impulses["viscous_impulse"]


def shape_factor(face, gap=1e-5):
    """Force times h^3 over viscosity and speed [m4]."""
    return ck.plan(scene(face)).force(gap, 1e-3) * gap**3 / (0.1 * 1e-3)


def test_a_disc_is_the_same_by_its_radius_and_by_its_planform():
    plain = ck.simulate(ck.plan(scene(ck.Flat(radius=R))))
    planform = ck.simulate(ck.plan(scene(ck.Flat(planform=ck.Disc(radius=R)))))
    assert planform.state == plain.state
    assert np.array_equal(planform["film_status"], plain["film_status"])


# Torsional constants of Saint-Venant: series of Timoshenko and Goodier, 3 J of each.
@pytest.mark.parametrize(
    ("planform", "factor"),
    [
        (ck.Ring(radius=R, hole_radius=0.3 * R), 1.4330081133966175 * R**4),
        (ck.Rectangle(length=4e-3, width=4e-3), 0.42173 * 4e-3**4),
        (ck.Rectangle(length=8e-3, width=4e-3, angle=0.3), 0.68604 * 8e-3 * 4e-3**3),
        (ck.Ellipse(semi_axes=(R, R / 2)), 3 * math.pi * R**4 / 2**3 / 1.25),
        (ck.equilateral_triangle(4e-3), 0.0649519 * 4e-3**4),
    ],
)
def test_planforms_have_three_times_their_torsional_constant(planform, factor):
    assert shape_factor(ck.Flat(planform=planform)) == pytest.approx(factor, rel=1e-5)


def half_disc():
    """Half of a disc: the torsional constant of a semicircle is 0.2976 R^4 (Roark)."""
    return ck.Sector(radius=R, start=0.0, end=math.pi)


def test_a_face_without_a_closed_form_is_solved_to_its_tolerance():
    made = ck.plan(scene(ck.Flat(planform=half_disc())))
    assert shape_factor(ck.Flat(planform=half_disc())) == pytest.approx(3 * 0.2976 * R**4, rel=1e-3)
    number = {one.name: one for one in made.validity([(5e-6, 1e-3)])}[
        "error of the film on its grid"
    ]
    assert 0.0 < number.value < 1e-3
    assert "finite volumes" in str(made.cite())


def test_an_image_of_a_face_is_the_face():
    x = (np.arange(128) - 63.5) / 62 * R
    level = np.minimum(R - np.hypot(x, x[:, None]), x[:, None] + 0 * x)
    coverage = np.clip(0.5 + level * 62 / R, 0.0, 1.0)
    drawn = ck.Image(coverage=coverage, pixel_size=R / 62)
    assert drawn.area == pytest.approx(half_disc().area, rel=2e-3)
    assert shape_factor(ck.Flat(planform=drawn)) == pytest.approx(3 * 0.2976 * R**4, rel=5e-3)


def test_a_tilted_pad_is_that_of_its_series():
    """A long strip under a wedge, p' = -12 eta v (x - x0)/h^3, x0 from p = 0 at both ends."""
    from scipy.integrate import quad

    width, length, slope, gap = 4e-3, 24e-3, 1e-3, 5e-6
    face = ck.Flat(planform=ck.Rectangle(length=length, width=width), tilt=(0.0, slope))

    def h(x):
        return gap + slope * (x + 0.5 * width)

    moments = [quad(lambda x, n=n: x**n / h(x) ** 3, -width / 2, width / 2)[0] for n in (0, 1, 2)]
    per_length = 12.0 * (moments[2] - moments[1] ** 2 / moments[0])
    found = ck.plan(scene(face)).force(gap, 1e-3) / (0.1 * 1e-3)
    # The ends of a strip of finite length take off about 0.63 widths of it.
    assert found / per_length == pytest.approx(length - 0.63 * width, rel=2e-2)


def test_a_crown_is_a_sphere_on_a_disc():
    crown = ck.plan(scene(ck.Flat(radius=R, crown_radius=1.0)))
    sphere = ck.plan(scene(ck.Sphere(radius=1.0), other=ck.Flat(radius=R)))
    for gap in (5e-6, 2e-5):
        assert crown.force(gap, 1e-3) == pytest.approx(sphere.force(gap, 1e-3), rel=1e-12)
    assert impulse(ck.Flat(radius=R, crown_radius=1.0)) == pytest.approx(
        impulse(ck.Sphere(radius=1.0), other=ck.Flat(radius=R)), rel=1e-9
    )


def test_a_hollow_face_counts_its_gap_from_the_rim():
    """Reynolds' equation once integrated is p' = -6 eta v r/h^3."""
    from scipy.integrate import quad

    def slope(r):
        return 6.0 * r / (5e-6 + (R**2 - r**2) / 4.0) ** 3

    force = quad(lambda r: math.pi * r**2 * slope(r), 0.0, R, epsabs=0.0, epsrel=1e-12)[0]
    plan = ck.plan(scene(ck.Flat(radius=R, crown_radius=-2.0)))
    assert plan.force(5e-6, 1e-3) == pytest.approx(0.1 * 1e-3 * force, rel=1e-9)


@pytest.mark.slow
def test_holes_and_recesses_by_closed_form_and_by_the_grid():
    """A little off its middle, there is no closed form, and nearly the same force."""
    for made in (
        lambda disc: {"holes": (ck.Vent(shape=disc),)},
        lambda disc: {"holes": (ck.SealedHole(shape=disc),)},
        lambda disc: {"recesses": (ck.Recess(shape=disc, depth=3e-5),)},
    ):
        middle, off = (
            shape_factor(ck.Flat(radius=R, **made(ck.Disc(radius=1.5e-3, centre=(x, 0.0)))))
            for x in (0.0, 1e-5)
        )
        assert middle < 0.96 * 1.5 * math.pi * R**4
        assert off == pytest.approx(middle, rel=4e-3)


def test_a_relief_is_nearer_by_its_height():
    """A map of one height; and a ramp, which is a tilt about the middle."""
    flat = ck.Rectangle(length=4e-3, width=3e-3)
    even = ck.Heights(heights=np.full((2, 2), 1e-6), pixel_size=1e-2)
    raised = ck.plan(scene(ck.Flat(planform=flat, relief=even))).force(5e-6, 1e-3)
    level = ck.plan(scene(ck.Flat(planform=flat))).force(4e-6, 1e-3)
    assert raised == pytest.approx(level, rel=2e-3)
    x = 1e-3 * (np.arange(5) - 2.0)
    ramp = ck.Heights(heights=-5e-4 * x * np.ones((2, 1)), pixel_size=1e-3)
    ramped = ck.plan(scene(ck.Flat(planform=flat, relief=ramp))).force(5e-6 + 1e-6, 1e-3)
    tilted = ck.plan(scene(ck.Flat(planform=flat, tilt=(5e-4, 0.0)))).force(5e-6, 1e-3)
    assert ramped == pytest.approx(tilted, rel=5e-3)


def test_a_massless_ring_is_released_sooner_as_its_damping_is_less():
    disc, ring = (
        ck.simulate(ck.plan(scene(face, SLOW))).state.release_time
        for face in (ck.Flat(radius=R), ck.Flat(planform=ck.Ring(radius=R, hole_radius=0.3 * R)))
    )
    assert ring / disc == pytest.approx(1.4330081133966175 / 4.71238898038469, rel=1e-6)


def test_two_faces_meet_where_both_are():
    strip = ck.Flat(planform=ck.Rectangle(length=1.0, width=4e-3))
    other = ck.Flat(planform=ck.Rectangle(length=4e-3, width=1.0))
    both = ck.plan(scene(strip, other=other)).force(1e-5, 1e-3)
    square = ck.plan(scene(ck.Flat(planform=ck.Rectangle(length=4e-3, width=4e-3))))
    assert both == pytest.approx(square.force(1e-5, 1e-3), rel=1e-3)


FILE = """
[interface]
lower = { shape = "flat" }
[interface.upper]
shape = "flat"
planform = { shape = "ring", radius = "3.175 mm", hole_radius = "1 mm" }
tilt = ["0.1 mrad", "0 mrad"]
[[interface.upper.holes]]
kind = "vent"
shape = { shape = "disc", radius = "0.2 mm", centre = ["2 mm", "0 mm"] }
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
"""


def test_a_face_in_scene_and_result_files(tmp_path):
    path = tmp_path / "ring.toml"
    path.write_text(FILE, encoding="utf-8")
    made = ck.load_scene(path)
    upper = made.interface.upper.surface
    assert upper.planform == ck.Ring(radius=R, hole_radius=1e-3)
    assert upper.holes == (ck.Vent(shape=ck.Disc(radius=2e-4, centre=(2e-3, 0.0))),)
    assert upper.tilt == (1e-4, 0.0)
    ck.save_scene(made, tmp_path / "again.toml")
    assert ck.load_scene(tmp_path / "again.toml") == made
    result = ck.simulate(ck.plan(made, ck.Accuracy(film_rtol=1e-2)))
    result.save(tmp_path / "ring.npz")
    assert ck.load_result(tmp_path / "ring.npz").plan.scene == made
    path.write_text(FILE.replace('"ring"', '"rign"'), encoding="utf-8")
    with pytest.raises(ck.DescriptionError, match="ring"):
        ck.load_scene(path)


def test_the_law_of_a_face_in_earlier_files_is_now_its_planform(tmp_path):
    path = tmp_path / "old.toml"
    path.write_text(FILE + 'damping = { face = "ring" }\n', encoding="utf-8")
    with pytest.raises(ck.DescriptionError, match="planform of a body"):
        ck.load_scene(path)


@pytest.mark.parametrize(
    ("more", "part"),
    [
        ({"volume": 1e-10}, "a flooded film"),
        ({"effects": (ck.ShearLimit(strength=1e6),)}, "ShearLimit needs an even disc"),
        ({"effects": (ck.TensionLimit(cavity="truncated"),)}, "mass-conserving"),
        ({"count": 3}, "interface.meniscus.count = 1"),
    ],
)
def test_what_a_face_does_not_go_with_is_refused(more, part):
    with pytest.raises(ck.PlanError, match=part):
        ck.plan(scene(ck.Flat(planform=ck.Ring(radius=R, hole_radius=1e-3)), **more))


@pytest.mark.parametrize(
    ("given", "part"),
    [
        ({"radius": R, "planform": ck.Disc(radius=R)}, "stand alone"),
        ({"tilt": (1e-3, 0.0)}, "have a rim"),
        ({"radius": R, "tilt": 1e-3}, "a pair of slopes"),
        ({"radius": R, "crown_radius": 0.0}, "not be zero"),
        ({"radius": R, "holes": (ck.Disc(radius=1e-3),)}, "Vent or a SealedHole"),
        ({"radius": R, "recesses": (ck.Disc(radius=1e-3),)}, "hold a Recess"),
        ({"planform": R}, "planform"),
    ],
)
def test_a_face_that_makes_no_sense_is_refused(given, part):
    with pytest.raises(ck.DescriptionError, match=part):
        ck.Flat(**given)


def test_a_contact_has_no_planform():
    face = ck.Flat(planform=ck.Ring(radius=R, hole_radius=1e-3))
    steel = ck.Body(surface=ck.Sphere(radius=1e-2), solid=ck.load_material("bearing-steel"))
    contact = ck.ContactScene(
        interface=ck.Interface(lower=steel, upper=face),
        window=ck.Window(width=1e-3, periodic=False),
        loading=ck.Pressing(force=1.0),
        effects=(ck.HalfSpace(),),
    )
    with pytest.raises(ck.PlanError, match=r"interface\.upper\.surface\.planform has no effect"):
        ck.plan(contact)
