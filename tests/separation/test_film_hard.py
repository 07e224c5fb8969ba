"""Films that are hard on numbers: very thin, very thick, very viscous, divided, touching."""

from __future__ import annotations

import math

import numpy as np
import pytest
from selection import quick

import contactkit as ck
from contactkit.lubrication import squeeze_film as squeeze

# Most of these films are outside the range of their models, and say so.
pytestmark = [
    pytest.mark.hard,
    pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning"),
]

ARC = ck.MeniscusForce()
PUBLISHED = ck.MeniscusForce(profile=ck.AsPublished(radius="disc"))
VISCOUS = ck.ViscousForce()
SIXTY = math.pi / 3.0


def approx(value, rel):
    return pytest.approx(value, rel=rel, abs=0.0)


def filled(gap, face=1e-3):
    """Volume of a film that just fills the faces."""
    return math.pi * face**2 * gap


def run(scene):
    result = ck.simulate(ck.plan(scene))
    for name, curve in result.columns.items():
        # A cylinder or a disc never breaks: its gap to break at is inf.
        assert np.isfinite(curve).all() or name == "break_gap", name
    assert all(math.isfinite(value) for value, _ in result.scalars().values())
    return result


@pytest.mark.parametrize("gap", [1e-8, 1e-4])
@pytest.mark.parametrize("viscosity", [1e-4, 1.0, 1e2])
@pytest.mark.parametrize("volume", ["flooded", "conserving"])
def test_the_force_follows_the_closed_form_in_every_film(film_scene, gap, viscosity, volume):
    """Ten decades of force, from 100 um of solvent to 10 nm of grease."""
    volume = filled(gap) if volume == "conserving" else None
    scene = film_scene(
        VISCOUS,
        liquid={"viscosity": viscosity},
        film={"volume": volume},
        initial_gap=gap,
        final_gap=50.0 * gap,
        speed=1e-3,
    )
    result = run(scene)
    radius = 1e-3 if volume is None else squeeze.disc_radius(volume, result.gap)
    force = squeeze.disc_force(radius, result.gap, 1e-3, viscosity)
    assert result["viscous_force"] == approx(force, 1e-13)
    impulse = (
        squeeze.disc_impulse_flooded(1e-3, gap, 50.0 * gap, viscosity)
        if volume is None
        else squeeze.disc_impulse_conserved(volume, gap, 50.0 * gap, viscosity)
    )
    assert result.of(ck.ViscousForce).impulse == approx(impulse, 1e-12)


@pytest.mark.parametrize("viscosity", [1e-4, 1e2])
@pytest.mark.parametrize("gap", [1e-8, 1e-4])
def test_a_limited_impulse_is_as_exact_for_a_small_film_as_for_a_large_one(
    film_scene, gap, viscosity
):
    """All lengths and the speed scaled: the impulse is too, as length squared times pressure."""

    def impulse(size):
        face = ck.Flat(radius=1e-3 * size)
        scene = film_scene(
            VISCOUS,
            ck.TensionLimit(strength=1e5, cavity="truncated"),
            lower=face,
            upper=face,
            liquid={"viscosity": viscosity},
            film={"volume": filled(gap) * size**3},
            initial_gap=gap * size,
            final_gap=50.0 * gap * size,
            speed=1e-3 * size,
        )
        return run(scene).of(ck.ViscousForce).impulse

    # The integral is asked for to 1e-10, of whatever size it is.
    assert impulse(1e-4) == approx(1e-8 * impulse(1.0), 1e-8)


@pytest.mark.slow
def test_a_limited_impulse_is_the_integral_of_its_curve(film_scene):
    film = {"volume": filled(1e-6)}
    scene = film_scene(
        VISCOUS,
        ck.TensionLimit(strength=1e4, cavity="truncated"),
        film=film,
        speed=1e-3,
        final_gap=5e-5,
    )
    result = ck.simulate(ck.plan(scene, ck.Accuracy(points=4001)))
    trapezium = np.trapezoid(result["viscous_force"], result.time)
    # 4000 panels over a factor of 50 in the gap: (1e-3)^2 of curvature.
    assert result.of(ck.ViscousForce).impulse == approx(trapezium, 1e-5)


@pytest.mark.parametrize("count", [1, 100_000])
@pytest.mark.parametrize("effect", [ARC, PUBLISHED], ids=["arc", "as-published"])
def test_a_hundred_thousand_menisci_share_one_volume(film_scene, count, effect):
    scene = film_scene(
        effect,
        VISCOUS,
        film={"volume": filled(1e-8), "count": count},
        initial_gap=1e-8,
        final_gap=1e-7,
    )
    result = run(scene)
    one = squeeze.disc_impulse_conserved(filled(1e-8), 1e-8, 1e-7, 0.1)
    assert result.of(ck.ViscousForce).impulse == approx(one / count, 1e-12)
    # A disc of 1 mm or 1e5 of 3 um, 10 nm high: the Laplace force is that of the wetted area, up
    # to the rim's part, h/r.
    laplace = 0.06 * filled(1e-8) / 1e-16
    assert result["meniscus_force"][0] == approx(laplace, 0.01)


@pytest.mark.parametrize("profile", ["arc", "as-published"])
@pytest.mark.parametrize(
    "angles",
    quick(
        [
            (one,)
            for one in [
                (0.0, 0.0),
                (0.0, SIXTY),
                (SIXTY, SIXTY),
                (90.0, 90.0),
                (120.0, 120.0),
                (180.0, 120.0),
                (60.0, 120.0),
                (15.0, 165.0),
                (165.0, 15.0),
                (180.0, 180.0),
            ]
        ],
        0,
        5,
        7,
        9,
    ),
)
@pytest.mark.parametrize("upper", [None, 2e-3], ids=["flats", "sphere"])
def test_every_pair_of_contact_angles_gives_a_finite_curve(film_scene, profile, angles, upper):
    """Angles of 0, 90, 180 degrees and pairs that add up to 180 need no replacement."""
    lower_angle, upper_angle = (a if a < 4.0 else math.radians(a) for a in angles)
    scene = film_scene(
        ck.MeniscusForce(profile=profile),
        VISCOUS,
        lower=ck.Flat(),
        upper=ck.Sphere(radius=upper) if upper else ck.Flat(),
        film={
            "volume": 1e-12,
            "contact_angle_lower": lower_angle,
            "contact_angle_upper": upper_angle,
        },
        initial_gap=1e-6,
        final_gap=2e-5,
    )
    result = run(scene)
    wetting = math.cos(lower_angle) + math.cos(upper_angle)
    if wetting > 0.1:
        assert result["meniscus_force"][0] > 0.0
    if wetting < -0.1:
        assert result["meniscus_force"][0] < 0.0


def test_ninety_degrees_on_both_flats_pull_with_their_rim_only(film_scene):
    """A cylinder: pi gamma r, exactly."""
    film = {"volume": 1e-12, "contact_angle_lower": 0.5 * math.pi}
    film["contact_angle_upper"] = 0.5 * math.pi
    result = run(film_scene(ARC, lower=ck.Flat(), upper=ck.Flat(), film=film))
    radius = squeeze.disc_radius(1e-12, result.gap)
    assert result["meniscus_force"] == approx(math.pi * 0.03 * radius, 1e-12)


@pytest.mark.parametrize("angles", [(0.0, math.pi), (math.pi, 0.0)])
@pytest.mark.parametrize("upper", [ck.Flat(), ck.Sphere(radius=1e-3)], ids=["flats", "sphere"])
def test_a_film_that_spreads_without_end_has_no_bridge(film_scene, angles, upper):
    film = {"volume": 1e-12, "contact_angle_lower": angles[0], "contact_angle_upper": angles[1]}
    with pytest.raises(ck.InfeasibleError, match=r"spreads|no bridge"):
        ck.plan(film_scene(ARC, lower=ck.Flat(), upper=upper, film=film))


@pytest.mark.parametrize("ratio", [1e3, 1e6])
def test_a_gap_may_open_a_millionfold(film_scene, ratio):
    scene = film_scene(
        PUBLISHED,
        VISCOUS,
        film={"volume": filled(1e-9)},
        initial_gap=1e-9,
        final_gap=ratio * 1e-9,
        speed=1e-3,
    )
    result = run(scene)
    expected = squeeze.disc_impulse_conserved(filled(1e-9), 1e-9, ratio * 1e-9, 0.1)
    assert result.of(ck.ViscousForce).impulse == approx(expected, 1e-12)
    assert result.gap[0] == 1e-9
    assert result.gap[-1] == ratio * 1e-9
    assert (np.diff(result.gap) > 0.0).all()


def test_a_picometre_under_a_sphere_keeps_its_digits(film_scene):
    """The hard case of the reference, through a scene: 1 pm under a film of 1 um."""
    sphere, gap, height = 5e-3, 1e-12, 1e-6
    volume = math.pi * sphere * (height - gap) * (height + gap)
    scene = film_scene(
        VISCOUS,
        lower=ck.Flat(),
        upper=ck.Sphere(radius=sphere),
        film={"volume": volume},
        initial_gap=gap,
        final_gap=1.0,
        time=1.0,
    )
    # Beyond a metre nothing is left but 1e-24; the scene holds R as 1/(1/R).
    assert run(scene).of(ck.ViscousForce).impulse == approx(5.857131086560162e-4, 1e-12)


# Touching -----------------------------------------------------------------------------------


@pytest.mark.parametrize("imposed", [{"speed": 1e-6}, {"time": 1.0}])
def test_a_touching_sphere_asks_for_a_cut_off(film_scene, imposed):
    sphere = ck.Sphere(radius=1e-3)
    scene = film_scene(
        VISCOUS, lower=ck.Flat(), upper=sphere, film={"volume": 1e-15}, initial_gap=0.0, **imposed
    )
    with pytest.raises(
        ck.InfeasibleError, match=r"infinite.*ln\(1/gap\).*cut-off gap \[m\].*0\.2 to 0\.3 nm"
    ):
        ck.plan(scene)


def test_a_touching_sphere_has_a_meniscus(film_scene):
    """Without a viscous force the curve begins at contact: 2 pi R gamma (c1 + c2), nearly."""
    scene = film_scene(
        ARC,
        lower=ck.Flat(),
        upper=ck.Sphere(radius=1e-3),
        film={"volume": 1e-18},
        initial_gap=0.0,
        final_gap=1e-7,
    )
    result = run(scene)
    assert result.gap[0] == 0.0
    assert result["meniscus_force"][0] == approx(4.0 * math.pi * 1e-3 * 0.03, 0.02)
    assert (np.diff(result["meniscus_force"]) < 0.0).all()


@pytest.mark.parametrize("effects", [(ARC,), (VISCOUS,)], ids=["meniscus", "viscous"])
def test_touching_flats_are_a_contact_problem(film_scene, effects):
    scene = film_scene(*effects, film={"volume": 1e-12}, initial_gap=0.0)
    with pytest.raises(ck.InfeasibleError, match=r"0 m between flats.*contact problem.*roughness"):
        ck.plan(scene)


def test_a_pull_does_not_start_from_contact(film_scene):
    scene = film_scene(
        VISCOUS,
        lower=ck.Flat(),
        upper=ck.Sphere(radius=1e-3),
        film={"volume": 1e-15},
        initial_gap=0.0,
        force=1.0,
        mass=1.0,
    )
    with pytest.raises(ck.InfeasibleError, match=r"bodies that touch do not move.*\[m\]"):
        ck.plan(scene)


# Volumes and rims ---------------------------------------------------------------------------


def test_a_film_wider_than_its_faces_stays_at_their_rim(film_scene):
    """Until the gap takes up the volume the radius is the face's, then it draws in: no jump."""
    scene = film_scene(PUBLISHED, VISCOUS, film={"volume": filled(3e-6)}, speed=1e-3)
    made = ck.plan(scene)
    assert made.film.full_gap == approx(3e-6, 1e-15)
    for force in (made.film.static_force, lambda h: made.film.viscous_force(h, 1e-3)[0]):
        below, above = force(3e-6 * (1.0 - 1e-12)), force(3e-6 * (1.0 + 1e-12))
        assert below == approx(above, 1e-10)
    statuses = set(run(scene)["film_status"])
    assert statuses == {ck.FilmStatus.FULL, ck.FilmStatus.BRIDGE}


def test_a_film_wider_than_a_bounded_face_under_a_sphere_joins_without_a_jump(film_scene):
    scene = film_scene(
        VISCOUS,
        lower=ck.Flat(radius=1e-4),
        upper=ck.Sphere(radius=5e-3),
        film={"volume": 2e-13},
        speed=1e-3,
        final_gap=1e-4,
    )
    made = ck.plan(scene)
    full = made.film.full_gap
    assert 1e-6 < full < 1e-4
    law = made.film.laws[ck.ViscousForce]
    assert law.force(full * (1.0 - 1e-12), 1.0) == approx(
        law.force(full * (1.0 + 1e-12), 1.0), 1e-9
    )
    parts = law.impulse(1e-6, full) + law.impulse(full, 1e-4)
    assert law.impulse(1e-6, 1e-4) == approx(parts, 1e-13)


@pytest.mark.parametrize("volume", [1e-30, 1e-3])
def test_a_drop_or_a_bucket_between_faces_gives_finite_forces(film_scene, volume):
    """1e-30 m3 is a hundred atoms wide: only the arithmetic is asked here."""
    result = run(film_scene(PUBLISHED, VISCOUS, film={"volume": volume}))
    assert (result["viscous_force"] > 0.0).all()


def test_an_arc_asked_to_span_more_than_it_can_names_its_reach(film_scene):
    scene = film_scene(
        ARC, lower=ck.Flat(), upper=ck.Flat(), film={"volume": 1e-21}, initial_gap=1e-6
    )
    with pytest.raises(ck.InfeasibleError, match=r"no meniscus spans.*reaches .* m at most"):
        ck.plan(scene)
