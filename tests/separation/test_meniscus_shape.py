"""Shape of a meniscus in results, and a meniscus that is given by its contact radius."""

import math
import pickle

import loadings
import numpy as np
import pytest
from selection import quick

import contactkit as ck
from contactkit.capillary.exact.bridge import bridge
from contactkit.capillary.exact.stability import stability_limit
from contactkit.errors import DescriptionError, InfeasibleError, NotSimulatedError
from contactkit.separation.effects import meniscus as meniscus_module
from contactkit.separation.effects.base import RunCurves
from contactkit.separation.effects.meniscus_shape import shape_curves

pytestmark = pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning")

TENSION = 0.072
WATER = {"name": "water", "viscosity": 0.89e-3, "surface_tension": TENSION}
LOWER, UPPER = math.radians(40.0), math.radians(70.0)
NAMES = (
    "neck_radius",
    "contact_radius_lower",
    "contact_radius_upper",
    "liquid_pressure",
    "liquid_volume",
    "break_gap",
)
FLATS = {"lower": ck.Flat(), "upper": ck.Flat(), "initial_gap": 2e-9, "final_gap": 2e-7}
SPHERE = FLATS | {"upper": ck.Sphere(radius=1e-6)}


def run(film_scene, effect, bodies, amount, count=1, *others, **loading):
    film = {"contact_angle_lower": LOWER, "contact_angle_upper": UPPER, "count": count} | amount
    scene = film_scene(effect, *others, liquid=WATER, film=film, **(bodies | loading))
    return ck.simulate(ck.plan(scene, loadings.with_points(scene, 20)))


@pytest.mark.parametrize("count", [1, 9])
@pytest.mark.parametrize(
    ("bodies", "amount"),
    [
        (FLATS, {"volume": 6e-23}),
        (SPHERE, {"volume": 6e-23}),
        (SPHERE, {"pressure": -2e6}),
        (FLATS | {"lower": ck.Flat(radius=1e-7), "upper": ck.Flat(radius=1e-7)}, {}),
    ],
    ids=["flats", "sphere", "pressure", "flooded"],
)
def test_the_shape_balances_the_force_on_the_flat(film_scene, bodies, amount, count):
    """Pressure on the contact circle and surface tension around it, on the lower body."""
    result = run(film_scene, ck.MeniscusForce(), bodies, amount, count)
    radius, pressure = result["contact_radius_lower"][:-1], result["liquid_pressure"][:-1]
    tension = 2.0 * math.pi * radius * TENSION * math.sin(LOWER)
    force = count * (tension - math.pi * radius**2 * pressure)
    assert result["meniscus_force"][:-1] == pytest.approx(force, rel=1e-6)
    assert np.all(result["neck_radius"] <= result["contact_radius_lower"] * (1.0 + 1e-12))
    assert np.all(result["neck_radius"] <= result["contact_radius_upper"] * (1.0 + 1e-12))
    if "volume" in amount:
        assert result["liquid_volume"] == pytest.approx(6e-23, rel=1e-12)
    if "pressure" in amount:
        assert pressure == pytest.approx(-2e6, rel=1e-12)


@pytest.mark.parametrize("profile", ["arc", "as-published"])
@pytest.mark.parametrize("bodies", [FLATS, SPHERE], ids=["flats", "sphere"])
def test_arcs_have_nearly_the_shape_of_the_exact_bridge_early(film_scene, profile, bodies):
    """And the pressure that their equation has."""
    amount, early = {"volume": 6e-23}, {"final_gap": 3e-9}
    exact = run(film_scene, ck.MeniscusForce(), bodies, amount, **early)
    arc = run(film_scene, ck.MeniscusForce(profile=profile), bodies, amount, **early)
    for name in NAMES[:3]:
        assert arc[name] == pytest.approx(exact[name], rel=0.03)
    if profile == "as-published":
        lower = bodies is FLATS
        radius = arc["contact_radius_lower" if lower else "contact_radius_upper"]
        slope = LOWER if lower else UPPER + np.arctan(radius / 1e-6)
        force = 2.0 * math.pi * TENSION * radius * np.sin(slope)
        force -= math.pi * radius**2 * arc["liquid_pressure"]
        assert arc["meniscus_force"] == pytest.approx(force, rel=1e-6)


def test_a_film_full_to_the_rim_recedes_from_it(film_scene):
    face = ck.Flat(radius=1e-7)
    bodies = FLATS | {"lower": face, "upper": face, "final_gap": 2e-8}
    result = run(film_scene, ck.MeniscusForce(), bodies, {"volume": 4 * math.pi * 1e-14 * 2e-9})
    wide = np.maximum(result["contact_radius_lower"], result["contact_radius_upper"])
    pinned = wide > 1e-7 * (1.0 - 1e-6)
    assert 0 < pinned.sum() < len(pinned)
    assert np.all(np.diff(result["liquid_volume"][pinned]) > 0.0)
    assert result["liquid_volume"][~pinned] == pytest.approx(4 * math.pi * 1e-14 * 2e-9)


@pytest.mark.parametrize(
    "imposed", [{"speed": 1.0}, {"time": 1e-7}, {"force": 1e-4, "mass": 1e-12}]
)
def test_after_the_break_there_is_no_shape(film_scene, imposed):
    solids = ck.VanDerWaalsForce(hamaker_constant=1e-19)
    bodies = FLATS | {"lower": ck.Flat(radius=1e-6), "upper": ck.Flat(radius=1e-6)}
    result = run(film_scene, ck.MeniscusForce(), bodies, {"volume": 6e-23}, 1, solids, **imposed)
    limit = float(stability_limit(6e-23, LOWER, UPPER).gap)
    whole = ~np.isnan(result["neck_radius"])
    assert result.gap[-1] > limit
    assert np.all(result.gap[whole] <= limit * (1.0 + 1e-9))
    assert not whole[-1]
    for name in NAMES:
        assert np.array_equal(~np.isnan(result[name]), whole), name
    assert result["break_gap"][whole] == pytest.approx(limit, rel=1e-9)


def test_what_has_wetted_again_has_its_own_shape(film_scene):
    made = run(film_scene, ck.MeniscusForce(), FLATS, {"volume": 6e-23, "rewetting": 0.5}).plan
    gap = np.array([3e-9, 3e-9, 1e-7])
    whole, fraction = np.array([True, True, False]), np.array([1.0, 0.5, 1.0])
    found = shape_curves(
        ck.MeniscusForce, "exact", RunCurves(made, gap, 0.0 * gap, whole, fraction), is_disc=False
    )
    assert found["liquid_volume"][:2] == pytest.approx([6e-23, 3e-23])
    assert found["break_gap"][1] / found["break_gap"][0] == pytest.approx(0.5 ** (1 / 3))
    half = bridge(3e-9, 3e-23, LOWER, UPPER)
    assert found["neck_radius"][1] == pytest.approx(float(half.neck), rel=1e-9)
    assert np.isnan(found["neck_radius"][2])


def test_a_shape_is_computed_only_when_asked_for(film_scene, monkeypatch):
    calls = []

    def counted(*given, is_disc):
        calls.append(given)
        return shape_curves(*given, is_disc=is_disc)

    monkeypatch.setattr(meniscus_module, "shape_curves", counted)
    result = run(film_scene, ck.MeniscusForce(), FLATS, {"volume": 6e-23})
    assert set(NAMES) < set(result.columns)
    assert not calls
    assert result["neck_radius"] is result["neck_radius"]
    assert result["break_gap"].flags.writeable is False
    assert len(calls) == 1


def test_a_copy_computes_its_shape_when_asked_for(film_scene):
    result = run(film_scene, ck.MeniscusForce(), FLATS, {"volume": 6e-23})
    copied = pickle.loads(pickle.dumps(result))
    assert "neck_radius" not in copied.columns.computed
    for name in ("gap", *NAMES):
        assert np.array_equal(copied[name], result[name], equal_nan=True), name
        assert not copied[name].flags.writeable


def test_a_shape_comes_back_from_its_file(film_scene, tmp_path):
    result = run(film_scene, ck.MeniscusForce(), FLATS, {"volume": 6e-23})
    again = ck.load_result(result.save(tmp_path / "drop"))
    for name in NAMES:
        assert np.array_equal(again[name], result[name], equal_nan=True), name


def test_without_a_meniscus_force_there_is_no_shape(film_scene):
    result = run(film_scene, ck.ViscousForce(), FLATS, {"volume": 6e-23})
    with pytest.raises(NotSimulatedError, match=r"add MeniscusForce\("):
        result["neck_radius"]
    assert not set(NAMES) & set(result.columns)


def test_a_flooded_meniscus_says_what_pulls(film_scene):
    face = ck.Flat(radius=1e-7)
    bodies = FLATS | {"lower": face, "upper": face}
    text = str(run(film_scene, ck.MeniscusForce(), bodies, {}).plan)
    assert "flooded: liquid follows to the rim" in text
    assert "in a flooded reservoir there is none" in text
    assert "flooded" not in str(run(film_scene, ck.MeniscusForce(), bodies, {"volume": 6e-23}).plan)


# --- A meniscus by its contact radius -------------------------------------------------------------

PAIRS = [(60, 60), (0, 60), (60, 0), (120, 120), (180, 120), (90, 90), (0, 0), (30, 100)]


@pytest.mark.parametrize("body", ["lower", "upper"])
@pytest.mark.parametrize("degrees", quick([(pair,) for pair in PAIRS], 1, 4), ids=str)
def test_the_radius_at_the_gap_is_the_one_given(degrees, body):
    lower, upper = map(math.radians, degrees)
    angles = {"contact_angle_lower": lower, "contact_angle_upper": upper}
    water = ck.Liquid(name="water", surface_tension=TENSION)
    for gap in (2e-9, 6e-9, 40e-9):
        film = ck.Meniscus.from_radius(
            liquid=water, radius=100e-9, at_gap=gap, body=body, count=4, **angles
        )
        found = bridge(gap, film.volume / 4, lower, upper)
        radius = found.radius_lower if body == "lower" else found.radius_upper
        assert float(radius) == pytest.approx(100e-9, rel=1e-11)


def test_an_opening_as_published_begins_at_the_radius_of_its_arc(film_scene):
    water = ck.Liquid(**WATER)
    film = ck.Meniscus.from_radius(
        liquid=water,
        radius=100e-9,
        at_gap=2e-9,
        profile="arc",
        contact_angle_lower=LOWER,
        contact_angle_upper=UPPER,
    )
    force = ck.MeniscusForce(profile="as-published")
    result = run(film_scene, force, FLATS, {"volume": film.volume})
    assert result["contact_radius_lower"][0] == pytest.approx(100e-9, rel=1e-12)


@pytest.mark.parametrize(
    ("given", "error", "message"),
    [
        ({"radius": 0.0}, DescriptionError, r"from_radius\(radius\) must be positive"),
        (
            {"at_gap": math.inf},
            DescriptionError,
            r"from_radius\(at_gap\) must be positive",
        ),
        ({"body": "both"}, DescriptionError, r"from_radius\(body\) must be 'lower' or 'upper'"),
        ({"profile": "disc"}, DescriptionError, r"from_radius\(profile\) must be 'exact' or 'arc'"),
        ({"at_gap": 1e-6}, InfeasibleError, "no bridge so narrow is stable; give a larger radius"),
        ({"at_gap": 1e-6, "profile": "arc"}, InfeasibleError, "its neck would be closed"),
        ({"contact_angle_upper": math.pi}, InfeasibleError, "0 and 180 deg"),
    ],
)
def test_a_radius_without_a_bridge_is_refused(given, error, message):
    water = ck.Liquid(name="water", surface_tension=TENSION)
    with pytest.raises(error, match=message):
        ck.Meniscus.from_radius(**({"liquid": water, "radius": 100e-9, "at_gap": 2e-9} | given))


def test_the_earlier_name_of_the_gap_means_the_same():
    water = ck.Liquid(name="water", surface_tension=TENSION)
    form = {"liquid": water, "radius": 100e-9}
    assert ck.Meniscus.from_radius(**form, gap=2e-9) == ck.Meniscus.from_radius(**form, at_gap=2e-9)
    given = {"liquid": water, "coverage": 0.5, "area": 1e-12}
    assert ck.Meniscus.from_coverage(**given, gap=2e-9).volume == pytest.approx(
        1e-21, rel=1e-12, abs=0.0
    )
    with pytest.raises(DescriptionError, match=r"\(at_gap\) must be given once .*gap is"):
        ck.Meniscus.from_radius(**form, gap=2e-9, at_gap=2e-9)
    with pytest.raises(DescriptionError, match=r"from_coverage\(at_gap\) must be given \[m\]"):
        ck.Meniscus.from_coverage(**given)
    with pytest.raises(TypeError, match=r"from_radius\(\) got .* 'profil'; did you mean 'profile'"):
        ck.Meniscus.from_radius(**form, at_gap=2e-9, profil="arc")
