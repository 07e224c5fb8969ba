"""Every printed equation at gaps of zero, tiny and huge sizes, and at right and flat angles.

Each answers with a finite number, or says why it has none; so does the value beside it.
"""

import itertools
import math

import numpy as np
import pytest
from published_case import NM, ask
from scipy.integrate import quad
from selection import quick

import contactkit as ck
from contactkit.as_published.arguments import ARGUMENTS
from contactkit.lubrication.couette_sphere import sphere_drag, sphere_impulse

pytestmark = pytest.mark.hard

RIGHT = math.pi / 2

LENGTHS = [name for name, argument in ARGUMENTS.items() if argument.unit in ("m", "m3")]
SIZES = (0.0, 1e-300, 1e-90, 1e-15, 1.0, 1e90, 1e300)


def changes(number):
    """Extremes of one length, of the number of menisci, and of all contact angles."""
    names = ck.PUBLISHED[number].arguments
    for name in names:
        sizes = SIZES if name in LENGTHS else (1, 10**4, 10**100) if name == "number" else ()
        for size in sizes:
            yield {name: size}
    angles = [name for name in names if name.startswith("angle")]
    for values in itertools.product((0.0, RIGHT, math.pi), repeat=len(angles)):
        yield dict(zip(angles, values, strict=True))


def fault(number, changed):
    """What is wrong with an answer; empty for none."""
    try:
        found = ask(number, **changed)
    except (ck.DescriptionError, ck.InfeasibleError) as refusal:
        return "" if number in str(refusal) else f"a refusal without its number: {refusal}"
    endless = number == "zero neck" and found.value == math.inf
    if not (math.isfinite(found.value) or endless):
        return f"printed value {found.value}"
    if found.corrected is None:
        return "" if len(found.corrected_by) > 20 else f"no reason: {found.corrected_by!r}"
    if not math.isfinite(found.corrected):
        return f"corrected value {found.corrected}"
    # As in the tests of the values: right as printed to 2 %, or wrong with a reason.
    is_off = not endless and abs(found.value - found.corrected) > 0.02 * abs(found.corrected)
    return "no erratum" if (endless or is_off) and not found.erratum else ""


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize(
    "number",
    # The exact bridges of these are sought long where there is none.
    [
        pytest.param(n, marks=[pytest.mark.exhaustive] * (n in ("3.7", "3.12")))
        for n in ck.PUBLISHED
    ],
)
def test_extremes_have_a_finite_answer_or_a_reason(number):
    faults = {str(changed): fault(number, changed) for changed in changes(number)}
    assert {which: what for which, what in faults.items() if what} == {}


@pytest.mark.parametrize("number", ["3.56", "3.58", "3.59"])
def test_a_sphere_that_touches_slides_against_an_infinite_drag(number):
    found = ask(number, gap=0.0)
    assert math.isfinite(found.value)
    assert found.corrected is None
    assert "infinite" in found.corrected_by
    assert "give a gap above zero" in found.corrected_by


def test_the_drag_of_a_sphere_grows_with_each_decade_of_its_gap():
    """By 2 pi eta R v ln 10 for shear, without end: it stood still below 1e-85 m."""
    gaps = [10.0**-k for k in range(20, 301, 40)]
    drag = [float(sphere_drag(1e-4, gap, 2e-9, 0.0, lambda h: 1.0 / h)) for gap in gaps]
    assert np.diff(drag) == pytest.approx(2 * math.pi * 1e-4 * 40 * math.log(10), rel=1e-12)
    impulse = [float(sphere_impulse(1e-4, gap, 2e-9, 1.0)) for gap in gaps]
    x = math.sqrt(2e-4 * 2e-9)
    # At the apex the drag lasts while the other circle covers it: over x, in both directions.
    per_gap = 2.0 * math.pi * x * 1e-4 * 40 * math.log(10)
    assert np.diff(impulse) == pytest.approx(per_gap, rel=1e-9)
    corrected = [ask("3.56", gap=gap).corrected for gap in gaps]
    assert np.all(np.diff(corrected) > 0.0)


def test_a_sphere_that_touches_has_a_drag_where_the_lens_leaves_its_apex():
    radius, height, stress = 1e-4, 2e-9, 5e8
    x = math.sqrt(2.0 * radius * height)
    drag = sphere_drag(radius, 0.0, height, np.array([0.0, x, 1.5 * x]), lambda h: 1.0 / h)
    assert np.isinf(drag[:2]).all()

    def ring(u):  # of the lens, beyond its near edge at x/2, by the root of the distance to it
        r = 0.5 * x + u**2
        cosine = (r**2 + (1.5 * x) ** 2 - x**2) / (3.0 * x * r)
        return 2.0 * math.acos(min(cosine, 1.0)) * 2.0 * radius / r * 2.0 * u

    assert drag[2] == pytest.approx(quad(ring, 0.0, math.sqrt(0.5 * x))[0], rel=1e-8)
    # A stress with a bound: on all of the circle within which the film is thinner than 1/stress.
    bounded = sphere_drag(
        radius, 0.0, height, 0.0, lambda h: np.minimum(1.0 / h, stress), 1.0 / stress
    )
    flow = 2.0 * math.pi * radius * (1.0 + math.log(height * stress))
    assert float(bounded) == pytest.approx(flow, rel=1e-12)


def test_a_circle_is_not_wider_than_its_sphere():
    found = ask("3.55", gap=0.0, film_height=100 * NM)
    assert found.value == pytest.approx(math.sqrt(2.0) * 100 * NM)
    assert found.corrected == pytest.approx(100 * NM, rel=1e-12)
    assert "paraboloid" in found.erratum
    assert "equator" in ask("3.55", gap=0.0, film_height=101 * NM).corrected_by
    thin = ask("3.55", gap=0.0, film_height=0.01 * NM)
    assert thin.corrected == pytest.approx(thin.value, rel=1e-4)


@pytest.mark.parametrize("number", ["3.22", "3.23", "3.26", "3.27", "3.29b", "3.56", "3.14b"])
def test_a_film_wider_than_its_sphere_has_no_right_value(number):
    wide = {"film_height": 60 * NM}
    if "number" in ck.PUBLISHED[number].arguments:
        wide["number"] = 1
    assert "wider than the sphere of radius 1e-07 m" in ask(number, **wide).corrected_by


@pytest.mark.parametrize("number", quick(["3.14b", "3.29b", "3.58", "3.59"], 0, 2))
def test_overlapping_menisci_have_no_right_value(number):
    apart, overlapping = (ask(number, number=count) for count in (25**2, 26**2))  # R/(2 (s - D))
    assert apart.corrected is not None
    assert overlapping.corrected is None
    assert "overlap: keep n = sqrt(number) below R/(2 (s - D)) = 25" in overlapping.corrected_by
