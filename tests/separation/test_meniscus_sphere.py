"""The curve through the meniscus force on a sphere is the force, also where it grows or ends."""

from __future__ import annotations

import math
import warnings

import numpy as np
import pytest
from selection import quick

import contactkit as ck
from contactkit.as_published.printed import common as published
from contactkit.capillary.arc import sphere as arc_sphere
from contactkit.capillary.exact.bridge import bridge

pytestmark = pytest.mark.hard

TENSION, ANGLES, RADIUS, VOLUME = 0.02, (1.0, 0.2), 7e-3, 3e-12


def exact(gap, profile):
    kind = "sphere" if profile == "arc" else "parabola"
    state = arc_sphere.solve(np.array([gap]), VOLUME, *ANGLES, 0.0, 1.0 / RADIUS, profile=kind)
    if profile == "arc":
        return TENSION * float(state.force[0])
    return float(np.ravel(published.meniscus_sphere_3_12(state, TENSION, ANGLES[1]))[0])


@pytest.mark.parametrize("profile", ["arc", "as-published"])
@pytest.mark.parametrize("fraction", quick([1e-6, 0.1, 0.5, 0.9, 0.99, 0.9999], 0, 2, 5))
def test_the_curve_is_the_force_up_to_the_end(film_scene, profile, fraction):
    """As printed the force grows without bound as the neck closes; a plain spline rang there."""
    scene = film_scene(
        ck.MeniscusForce(profile=profile),
        lower=ck.Flat(),
        upper=ck.Sphere(radius=RADIUS),
        liquid={"surface_tension": TENSION},
        film={
            "volume": VOLUME,
            "contact_angle_lower": ANGLES[0],
            "contact_angle_upper": ANGLES[1],
        },
        initial_gap=1e-12,
        final_gap=1e-3,
    )
    law = ck.plan(scene).film.laws[ck.MeniscusForce]
    gap = fraction * law.end
    # The curve is asked for 1e-9 of the largest force; near its end the arc pulls with little,
    # and the printed force is divided by the fraction that is left.
    rel = 1e-8 + 1e-10 / (1.0 - fraction)
    assert law.force(gap, 0.0) == pytest.approx(exact(gap, profile), rel=rel, abs=1e-9 * 2e-3)


@pytest.mark.parametrize("profile", ["exact", "arc"])
def test_the_force_goes_on_beyond_the_final_gap(film_scene, profile):
    """A motion goes on after its release: the law is that of the bridge up to its end."""
    laws = []
    for final_gap in (2e-6, 1e-3):
        scene = film_scene(
            ck.MeniscusForce(profile=profile),
            lower=ck.Flat(),
            upper=ck.Sphere(radius=RADIUS),
            liquid={"surface_tension": TENSION},
            film={"volume": VOLUME},
            initial_gap=1e-6,
            final_gap=final_gap,
        )
        laws.append(ck.plan(scene).film.laws[ck.MeniscusForce])
    near, far = laws
    assert near.end == far.end > 1e-5
    for gap in (3e-6, 1e-5, 0.9 * far.end):
        assert near.force(gap, 0.0) == pytest.approx(far.force(gap, 0.0), rel=1e-7)


@pytest.mark.parametrize("lower", quick([180.0, 179.9, 90.0], 2))
def test_slopes_are_right_up_to_where_a_repelling_sphere_is_detached(film_scene, lower):
    """The force ends as no power there, and a single polynomial scattered long before."""
    angles = (math.radians(lower), math.pi)
    scene = film_scene(
        ck.MeniscusForce(),
        lower=ck.Flat(),
        upper=ck.Sphere(radius=1e-3),
        liquid={"surface_tension": TENSION},
        film={"volume": 1e-14, "contact_angle_lower": angles[0], "contact_angle_upper": angles[1]},
        initial_gap=1e-7,
        final_gap=1e-3,
    )
    law = ck.plan(scene, ck.Accuracy(time_rtol=1e-11)).film.laws[ck.MeniscusForce]
    left = np.geomspace(1e-3, 0.5, 15)
    gaps, step = law.end * (1.0 - left), 0.02 * left
    near = (gaps * np.exp(k * step) for k in (-3, -2, -1, 1, 2, 3))
    f = [np.array([law.force(gap, 0.0) for gap in some.tolist()]) for some in near]
    slopes = (45.0 * (f[3] - f[2]) - 9.0 * (f[4] - f[1]) + f[5] - f[0]) / (60.0 * step)
    solved = bridge(gaps, 1e-14, *angles, 0.0, 1e3)
    expected = TENSION * gaps * solved.stiffness
    size = TENSION * np.abs(solved.force) + np.abs(expected)
    assert np.max(np.abs(slopes - expected) / size) < 1e-8


def test_a_drop_with_nothing_to_span_is_refused(film_scene):
    with pytest.raises(ck.InfeasibleError, match=r"no .*(bridge|meniscus)"):
        ck.plan(
            film_scene(
                ck.MeniscusForce(),
                lower=ck.Flat(),
                upper=ck.Sphere(radius=1e-6),
                film={"volume": 1e-21},
                initial_gap=1e-5,
                final_gap=1e-4,
            )
        )


def unlike(film_scene, first, last, **imposed):
    """0/150 degrees under a sphere of 100 um, as printed: infinite at 0.8 um."""
    return film_scene(
        ck.MeniscusForce(profile="as-published"),
        lower=ck.Flat(),
        upper=ck.Sphere(radius=1e-4),
        liquid={"surface_tension": TENSION},
        film={
            "volume": 1e-15,
            "contact_angle_lower": 0.0,
            "contact_angle_upper": math.radians(150.0),
        },
        initial_gap=first,
        final_gap=last,
        **imposed,
    )


def test_the_printed_force_is_evaluated_on_both_sides_of_its_pole(film_scene):
    """Where x_c = r1 it is infinite; a curve through it rang, one through the circle does not."""
    plan = ck.plan(unlike(film_scene, 1e-7, 1e-4, speed=1e-3))
    law = plan.film.laws[ck.MeniscusForce]
    gaps = law.end * np.linspace(0.0, 0.999, 60)
    bodies = (0.0, math.radians(150.0), 0.0, 1e4)
    arc = arc_sphere.solve(gaps, 1e-15, *bodies, profile="parabola")
    right = published.meniscus_sphere_3_12(arc, TENSION, bodies[1])
    assert right.min() < 0.0 < right.max()
    assert max(right) > 5.0 * right[0]
    found = [law.force(gap, 0.0) for gap in gaps.tolist()]
    assert found == pytest.approx(right.tolist(), rel=1e-6)
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        result = ck.simulate(plan)
    (said,) = [str(one.message) for one in caught if "Eq. (3.12)" in str(one.message)]
    assert said.startswith("radius of the neck in Eq. (3.12) over that of the arc = -")
    assert result.of(ck.MeniscusForce).impulse is None  # it is infinite
    assert law.poles == pytest.approx([0.81e-6], rel=0.02)


def test_no_force_moves_a_sphere_through_the_pole(film_scene):
    with pytest.raises(ck.InfeasibleError, match=r"infinite at a gap of 8.*x_c = r1"):
        ck.plan(unlike(film_scene, 1e-7, 1e-4, force=1e-6, mass=1e-9))
    ck.plan(unlike(film_scene, 3e-6, 1e-4, force=1e-6, mass=1e-9))  # beyond it


ALL_ANGLES = [(a, b) for a in range(0, 181, 30) for b in range(0, 181, 30) if a + b > 0]


@pytest.mark.parametrize("degrees", quick([(pair,) for pair in ALL_ANGLES], 1, 6), ids=str)
def test_the_printed_force_has_a_value_at_all_angles(film_scene, degrees):
    """Or no arc: of 245 spheres of 1e-9 to 10 R^3 33 were refused as rough before, now none."""
    lower, upper = map(math.radians, degrees)
    for volume in (1e-24, 1e-22):
        film = {"volume": volume, "contact_angle_lower": lower, "contact_angle_upper": upper}
        scene = film_scene(
            ck.MeniscusForce(profile="as-published"),
            lower=ck.Flat(),
            upper=ck.Sphere(radius=1e-7),
            liquid={"surface_tension": TENSION},
            film=film,
            initial_gap=1e-10,
            final_gap=1e-6,
        )
        try:
            law = ck.plan(scene).film.laws[ck.MeniscusForce]
        except ck.InfeasibleError:
            # No printed arc at all, or none at gaps below those of others: too much liquid for it.
            gaps = np.geomspace(1e-11, 1e-6, 80)
            arc = arc_sphere.solve(gaps, volume, lower, upper, 0.0, 1e7, profile="parabola")
            (found,) = np.nonzero(np.isfinite(arc.radius_upper))
            assert not len(found) or len(found) < found[-1] + 1
            continue
        gaps = min(law.end, 1e-6) * np.array([0.01, 0.3, 0.9])
        arc = arc_sphere.solve(gaps, volume, lower, upper, 0.0, 1e7, profile="parabola")
        right = published.meniscus_sphere_3_12(arc, TENSION, upper)
        found = [law.force(gap, 0.0) for gap in gaps.tolist()]
        assert found == pytest.approx(right.tolist(), rel=1e-5, abs=1e-9 * TENSION * 1e-7)
