"""Eq. (3.11) along an opening: a scene takes the contact circle of the arc, section 3.2.1.4.

The arc is solved again here from Eqs. (3.38) to (3.40): a circle of radius r1 through both contact
lines, its volume of revolution by quadrature, its contact circle by bisection.
"""

import math

import loadings
import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq

import contactkit as ck

pytestmark = [
    pytest.mark.slow,
    pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning"),
]

TENSION = 0.072
RADIUS, HEIGHT = 100e-9, 2e-9  # x_n0 and h0 of the source
PAIRS = [(60, 60), (0, 60), (60, 0), (180, 120), (120, 180), (120, 120), (90, 90), (60, 120)]


def offset(angles, height):
    """Distance of the arc from the lower contact circle, both over the gap."""
    lower, upper = angles
    closing = math.cos(lower) + math.cos(upper)
    if abs(closing) < 1e-12:  # a straight meridian
        return -height / math.tan(lower)
    radius = 1.0 / closing
    centre, level = radius * math.sin(lower), radius * math.cos(lower)
    side = math.copysign(1.0, radius)
    return centre - side * math.sqrt(max(radius**2 - (height - level) ** 2, 0.0))


def volume(angles, circle):
    """Volume of revolution over the gap cubed, from the lower contact circle over the gap."""

    def area(slope):  # heights along a sine, where a meridian may touch a flat
        height = 0.5 * (1.0 - math.cos(slope))
        return math.pi * (circle + offset(angles, height)) ** 2 * 0.5 * math.sin(slope)

    return quad(area, 0.0, math.pi, epsabs=0.0, epsrel=1e-12)[0]


def least_offset(angles):
    return min(offset(angles, height) for height in np.linspace(0.0, 1.0, 2001))


def circle(angles, liquid, gap):
    """Lower contact circle [m] of the arc of a volume [m3]: the one with an open neck."""
    wanted, closed = liquid / gap**3, -least_offset(angles)
    found = brentq(lambda x: volume(angles, x) / wanted - 1.0, closed, closed + 1e4, xtol=1e-14)
    return gap * found


def printed(angles, liquid, gap, pulled):
    """Eq. (3.11) with the contact circle of the pulled body."""
    x = circle(angles, liquid, gap)
    if pulled == "upper":
        x += gap * offset(angles, 1.0)
    angle = angles[0] if pulled == "lower" else angles[1]
    laplace = math.pi * x**2 * TENSION * (math.cos(angles[0]) + math.cos(angles[1])) / gap
    return laplace + 2.0 * math.pi * TENSION * x * math.sin(angle)


def run(angles, liquid, final_gap, *, face=math.inf, count=1, **choices):
    water = ck.Liquid(name="water", surface_tension=TENSION)
    film = ck.Meniscus(
        liquid=water,
        volume=liquid,
        count=count,
        contact_angle_lower=angles[0],
        contact_angle_upper=angles[1],
    )
    flat = ck.Flat() if math.isinf(face) else ck.Flat(radius=face)
    scene = ck.SeparationScene(
        interface=ck.Interface(lower=flat, upper=flat, meniscus=film),
        loading=loadings.imposed(initial_gap=HEIGHT, final_gap=final_gap, speed=1e-6),
        effects=(ck.MeniscusForce(profile=ck.AsPublished(**choices)),),
    )
    return ck.simulate(ck.plan(scene, ck.Accuracy(points=12)))


@pytest.mark.parametrize("pulled", ["lower", "upper"])
@pytest.mark.parametrize("degrees", PAIRS, ids=str)
def test_the_force_is_that_of_the_arc_up_to_the_break(degrees, pulled):
    angles = tuple(map(math.radians, degrees))
    liquid = HEIGHT**3 * volume(angles, RADIUS / HEIGHT)
    result = run(angles, liquid, 1e-6, pulled=pulled)
    closed = -least_offset(angles)
    least = volume(angles, closed)
    if least > 1e-9:  # at two right angles the neck of a cylinder never closes
        assert result.gap[-1] == pytest.approx((liquid / least) ** (1.0 / 3.0), rel=1e-6)
    size = TENSION * RADIUS
    for gap, force in zip(result.gap[:-1], result["meniscus_force"][:-1], strict=True):
        assert force == pytest.approx(
            printed(angles, liquid, gap, pulled), rel=1e-9, abs=1e-9 * size
        )


def test_a_disc_in_place_of_the_arc_is_far_off_late_in_an_opening():
    """60/60 at 55 nm; at 120/120 nothing is left where both contact circles close."""
    angles = (math.pi / 3,) * 2
    liquid = HEIGHT**3 * volume(angles, RADIUS / HEIGHT)
    arc, disc = (
        run(angles, liquid, 55e-9, radius=r)["meniscus_force"][-1] for r in ("arc", "disc")
    )
    assert disc / arc == pytest.approx(0.76, abs=0.005)
    angles = (2 * math.pi / 3,) * 2
    liquid = HEIGHT**3 * volume(angles, RADIUS / HEIGHT)
    whole = run(angles, liquid, 1e-6)
    assert abs(whole["meniscus_force"][-1]) < 1e-4 * np.abs(whole["meniscus_force"]).max()


def test_a_film_pinned_at_the_rim_keeps_its_circle_there():
    angles, face = (math.pi / 3,) * 2, 50e-9
    liquid = math.pi * face**2 * 4.0 * HEIGHT  # leaves the rim at about four times the gap
    result = run(angles, liquid, 3.0 * HEIGHT, face=face)
    for gap, force in zip(result.gap, result["meniscus_force"], strict=True):
        wetting = 2.0 * math.cos(angles[0])
        pinned = math.pi * face**2 * TENSION * wetting / gap
        pinned += 2.0 * math.pi * TENSION * face * math.sin(angles[0])
        assert force == pytest.approx(pinned, rel=1e-12)


def test_many_menisci_each_have_the_arc_of_their_part():
    angles, count = (math.pi / 3, 0.0), 9
    liquid = HEIGHT**3 * volume(angles, RADIUS / HEIGHT)
    result = run(angles, count * liquid, 20e-9, count=count)
    one = run(angles, liquid, 20e-9)
    assert result["meniscus_force"] == pytest.approx(count * one["meniscus_force"], rel=1e-12)
    (erratum,) = result.errata
    assert erratum.value == pytest.approx(result["meniscus_force"][0], rel=1e-12)
