"""Hard cases of a separation, row by row of the physics notes, from outside.

Tolerances: states of arcs 1e-12, printed formulas 1e-14, exact forces 1e-9 (1e-7 within 1 % of a
fold), limits 1e-8, viscous closed forms 1e-13.
"""

from __future__ import annotations

import json
import math
from pathlib import Path

import loadings
import numpy as np
import pytest
from attrs import evolve
from selection import quick

import contactkit as ck
from contactkit.capillary.arc import bridge as bridge_arc
from contactkit.capillary.exact.bridge import (
    KINDS,
    bridge,
    bridge_at_pressure,
    laterally_stable,
    margin,
)
from contactkit.capillary.exact.stability import LIMITS, stability_limit
from contactkit.lubrication import squeeze_film as squeeze
from contactkit.reference import elliptic_bridge

pytestmark = pytest.mark.hard

DATA = Path(__file__).parents[1] / "data"
CASES = json.loads((DATA / "separation.json").read_text(encoding="utf-8"))
MORE = json.loads((DATA / "bridges.json").read_text(encoding="utf-8"))
VISCOUS = {case["id"]: case for case in CASES["viscous_normal"]}
BRIDGES = {case["id"]: case for case in (*CASES["exact_bridge"], *MORE["exact_special"])}
LIMITED = {case["id"]: case for case in CASES["exact_limit"]}
DEG = math.pi / 180.0
WATER = ck.Liquid(name="water", surface_tension=0.072, viscosity=0.89e-3, density=997.0)


def approx(value, rel=1e-9):
    return pytest.approx(value, rel=rel, abs=0.0)


def angles(case):
    return case["theta1_deg"] * DEG, case["theta2_deg"] * DEG


def found(case):
    bend = case.get("kappa1", 0.0), case.get("kappa2", 0.0)
    return bridge(case["D"], case["V"], *angles(case), *bend)


def force(*given):
    return float(bridge(*given).force)


def printed_flat(radius, gap, *wetting):
    return ck.published(
        "3.11",
        radius=radius,
        gap=gap,
        surface_tension=1.0,
        angle_lower=wetting[0],
        angle_upper=wetting[1],
        pulled="lower",
    )


def water_scene(*effects, gap, volume, angle=60.0, other=None, count=1, upper=None, **imposed):
    film = ck.Meniscus(
        liquid=WATER,
        volume=volume,
        count=count,
        contact_angle_lower=angle * DEG,
        contact_angle_upper=(angle if other is None else other) * DEG,
    )
    motion = {"initial_gap": gap, "final_gap": 20.0 * gap or 1e-6} | (imposed or {"speed": 1e-9})
    return ck.SeparationScene(
        interface=ck.Interface(upper=upper or ck.Flat(), meniscus=film),
        loading=loadings.imposed(**motion),
        effects=effects or (ck.MeniscusForce(),),
    )


# Contact angles of exactly 0, 90 and 180 degrees --------------------------------------------


@pytest.mark.parametrize(
    "name",
    [
        "flat_0_0_D0.5",
        "flat_0_90_D0.4",
        "flat_180_180_D0.3",
        "cylinder_90_90_D0.2",
        "cylinder_90_90_D1.4",
    ],
)
def test_wetted_upright_and_repelled_exactly(name):
    case = BRIDGES[name] | ({"theta1_deg": 90, "theta2_deg": 90} if "cylinder" in name else {})
    assert float(found(case).force) == approx(case["F_over_gamma"])


@pytest.mark.parametrize("other", [60, 120, 179])
def test_a_body_that_repels_is_detached_and_leaves_the_cap(other):
    case = BRIDGES[f"detach_180_{other}"]
    limit = stability_limit(1.0, math.pi, other * DEG)
    assert float(limit.gap) == approx(case["D_limit"], 1e-8)
    assert LIMITS[int(limit.kind)] == "detachment"
    gaps = float(limit.gap) * np.array([0.5, 0.9, 0.99, 1.0 - 1e-6])
    pushed = bridge(gaps, 1.0, math.pi, other * DEG).force
    assert np.all(pushed < 0.0)  # repulsive to the end, and nothing at it
    assert np.all(np.diff(pushed) > 0.0)
    assert abs(pushed[-1]) < 1e-5


@pytest.mark.parametrize("gap", [0.1, 0.5, 0.9])
def test_180_against_120_by_legendre(gap):
    (other,) = elliptic_bridge.at_gaps([gap], math.pi, 120 * DEG)
    assert force(gap, 1.0, math.pi, 120 * DEG) == approx(other.force)
    assert force(gap, 1.0, 120 * DEG, math.pi) == approx(other.force)


def test_angles_a_millionth_of_a_degree_off_are_as_good():
    for low, up in ((0, 0), (90, 90), (180, 180), (0, 90), (180, 120)):
        off = 1e-6 if low < 180 else -1e-6
        exact = force(0.2, 1.0, low * DEG, up * DEG)
        assert force(0.2, 1.0, (low + off) * DEG, up * DEG) == approx(exact, 1e-6)


# 0 against 180 degrees ----------------------------------------------------------------------


def test_wetted_against_repelled_there_is_no_bridge():
    for one, two in ((0.0, math.pi), (math.pi, 0.0)):
        for bend in (0.0, 1.0):
            with pytest.raises(ck.InfeasibleError, match=r"0 and 180 deg.*spreads"):
                bridge(0.1, 1.0, one, two, 0.0, bend)
            with pytest.raises(ck.InfeasibleError, match=r"0 and 180 deg.*spreads"):
                stability_limit(1.0, one, two, 0.0, bend)
            with pytest.raises(ck.InfeasibleError, match="spreads"):
                margin(0.1, 1.0, one, two, 0.0, bend)
            with pytest.raises(ck.InfeasibleError, match="spreads"):
                bridge_arc.arc_bridge(0.1, 1.0, one, two, 0.0, bend)
            nothing = bridge([0.1, 0.2], 1.0, one, two, 0.0, bend, beyond="nan")
            assert np.isnan(nothing.force).all()
            assert nothing.kind.tolist() == [-1, -1]
        with pytest.raises(ck.InfeasibleError, match="spreads"):
            bridge_at_pressure(0.0, -100.0, one, two, 0.0, 1.0)


@pytest.mark.parametrize("upper", [None, ck.Sphere(radius=1e-3)])
@pytest.mark.parametrize(
    "effect", [ck.MeniscusForce(), ck.MeniscusForce(profile="arc"), ck.Rupture()], ids=repr
)
def test_wetted_against_repelled_a_scene_is_refused(effect, upper):
    effects = (effect,) if isinstance(effect, ck.MeniscusForce) else (ck.ViscousForce(), effect)
    scene = water_scene(*effects, gap=1e-6, volume=1e-15, angle=0.0, other=180.0, upper=upper)
    with pytest.raises(ck.InfeasibleError, match="spreads"):
        ck.plan(scene)


# Angles that add up to 180 degrees: the arc is straight --------------------------------------


@pytest.mark.parametrize(("one", "two"), [(60, 120), (15, 165), (90, 90), (120, 60)])
def test_the_arc_passes_through_a_straight_line(one, two):
    """A frustum of a cone: volume, and slope, by hand; the case file has 60/120 at D = 1."""
    gap = 0.3 if one == 15 else 1.0
    arc = bridge_arc.arc_bridge(gap, 1.0, one * DEG, two * DEG)
    low, high = float(arc.radius_lower), float(arc.radius_upper)
    assert math.pi * gap * (low * low + low * high + high * high) / 3.0 == approx(1.0, 1e-12)
    assert high - low == pytest.approx(-gap / math.tan(one * DEG), rel=1e-12, abs=1e-15)
    if (one, two) == (60, 120):
        case = next(c for c in CASES["arc_flat"] if c["id"] == "arc_flat_60_120_D1")
        assert low == approx(case["x1"], 1e-12)
        assert float(arc.force) == approx(case["F_consistent"], 1e-12)
    for off in (1e-13, 1e-9):  # and nothing happens beside it
        near = bridge_arc.arc_bridge(gap, 1.0, one * DEG + off, two * DEG)
        assert float(near.force) == approx(float(arc.force), 1e-7)


# Thin films ----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "value"),
    [("flat_60_60_x/h~100000", 9956439.74092966), ("flat_0_60_x/h~100000", 14934600.625138277)],
)
def test_a_hundred_thousand_times_as_wide_as_high(name, value):
    gap = (1.0 / (math.pi * 1e10)) ** (1.0 / 3.0)
    one, two = (float(part) * DEG for part in name.split("_")[1:3])
    if name in BRIDGES:
        case = BRIDGES[name]
        assert float(found(case).force) == approx(case["F_over_gamma"])
        assert case["F_over_gamma"] == approx(value, 1e-14)
        gap = case["D"]
    assert force(gap, 1.0, one, two) == approx(value)


def test_from_a_hundred_to_a_million_times_as_wide_the_line_is_seen():
    """F = pi x^2 c/h + pi x sin + O(h): thin films by the expansion, to what is left out."""
    ratio = np.array([1e2, 1e3, 1e4, 1e5, 1e6])
    gap = (1.0 / (math.pi * ratio**2)) ** (1.0 / 3.0)
    state = bridge(gap, 1.0, 60 * DEG, 60 * DEG)
    leading = math.pi * state.neck**2 * 2.0 * math.cos(60 * DEG) / gap
    assert np.all(np.abs(state.force / leading - 1.0) < 2.0 / ratio)


def test_too_slim_there_is_no_bridge_yet_the_printed_force_is_a_number():
    """x/h below 1/pi at 90/90."""
    slim = 0.3
    gap = 1.0 / (math.pi * slim**2) ** (1.0 / 3.0)
    with pytest.raises(ck.InfeasibleError, match=r"no bridge beyond 1\.46\d* m: there it breaks"):
        bridge(gap, 1.0, math.pi / 2, math.pi / 2)
    limit = stability_limit(1.0, math.pi / 2, math.pi / 2)
    assert float(limit.radius_lower / limit.gap) == approx(1.0 / math.pi, 1e-12)
    printed = printed_flat(slim * gap, gap, 60 * DEG, 60 * DEG)
    assert printed.value == approx(math.pi * slim * gap * (slim + 2.0 * math.sin(60 * DEG)), 1e-14)
    assert printed.corrected is None
    assert "no bridge" in printed.corrected_by


# Catenoids -----------------------------------------------------------------------------------


@pytest.mark.parametrize("angle", [30, 60, 80, 89])  # it is beyond the fold at less
def test_no_pressure_at_all(angle):
    """h = 2 f arcosh(1/sin t), F = 2 pi f, by quadrature of the cosh for the volume."""
    f, t = 1.0, angle * DEG
    half = math.acosh(1.0 / math.sin(t))
    volume = math.pi * (half + 0.5 * math.sinh(2.0 * half))
    state = bridge(2.0 * half, volume, t, t)
    assert float(state.force) == approx(2.0 * math.pi * f)
    assert abs(float(state.pressure)) < 1e-9
    assert KINDS[int(state.kind)] == "catenoid"
    # the force goes smoothly through it
    gaps = 2.0 * half * (1.0 + np.array([-2e-4, -1e-4, 0.0, 1e-4, 2e-4]))
    line = bridge(gaps, volume, t, t).force
    assert np.max(np.abs(np.diff(line, 3))) < 1e-9


@pytest.mark.parametrize("name", ["catenoid_30", "catenoid_80"])
def test_catenoids_of_the_case_file(name):
    assert float(found(BRIDGES[name]).force) == approx(BRIDGES[name]["F_over_gamma"])


# Near rupture, and beyond --------------------------------------------------------------------


@pytest.mark.parametrize(
    ("one", "two", "gap", "bend", "rtol"),
    [(60, 60, 1.4, 0.0, 1e-9), (0, 0, 1.0, 0.0, 1e-7), (40, 40, 1.2, 0.1, 1e-9)],
)
def test_near_the_limit_by_legendre(one, two, gap, bend, rtol):
    """60/60 at 98.6 %, 0/0 at 99.7 % of its fold, a sphere (V/R^3 = 1e-3) at 97.6 %."""
    shape = (one * DEG, two * DEG)
    (other,) = elliptic_bridge.at_gaps([gap], *shape, bend)
    state = bridge(gap, 1.0, *shape, 0.0, bend)
    assert float(state.force) == approx(other.force, rtol)
    assert float(state.radius_lower) == approx(other.radius_lower, rtol)


PAIRS = [(0, 0), (0, 60), (60, 60), (60, 60.001), (90, 90), (120, 60), (150, 150), (180, 180)]


@pytest.mark.parametrize("bend", [0.0, 0.1])
@pytest.mark.parametrize("pair", quick([(pair,) for pair in PAIRS], 1, 3, 6), ids=str)
def test_beyond_the_limit_there_is_no_bridge_and_no_other_branch(pair, bend):
    shape = (pair[0] * DEG, pair[1] * DEG, 0.0, bend)
    limit = float(stability_limit(1.0, *shape).gap)
    inside = bridge(limit * np.array([0.5, 0.9, 0.999999]), 1.0, *shape)
    assert np.isfinite(inside.force).all()
    for over in (1e-7, 1e-3, 1.0, 1e6):
        with pytest.raises(ck.InfeasibleError, match=r"no bridge beyond .*: there it breaks"):
            bridge(limit * (1.0 + over), 1.0, *shape)
    mixed = bridge(limit * np.array([0.5, 1.001, 0.9]), 1.0, *shape, beyond="nan")
    assert np.isfinite(mixed.force).tolist() == [True, False, True]
    assert mixed.kind[1] == -1
    assert float(mixed.force[0]) == approx(float(inside.force[0]), 1e-12)


@pytest.mark.parametrize("case", CASES["exact_limit"], ids=lambda case: case["id"])
def test_limits_of_the_case_file(case):
    limit = stability_limit(case["V"], *angles(case), case["kappa1"], case["kappa2"])
    assert float(limit.gap) == approx(case["D_limit"], 1e-8)


def test_the_arc_goes_on_where_the_bridge_has_broken():
    case = next(c for c in CASES["arc_flat"] if c["id"] == "arc_flat_60_60_D2")
    arc = bridge_arc.arc_bridge(2.0, 1.0, 60 * DEG, 60 * DEG)
    assert float(arc.radius_lower) == approx(case["x1"], 1e-12)
    assert float(arc.neck) == approx(case["neck"], 1e-12)
    with pytest.raises(ck.InfeasibleError):
        bridge(2.0, 1.0, 60 * DEG, 60 * DEG)


@pytest.mark.parametrize("sphere", [None, ck.Sphere(radius=1e-6)])
def test_a_scene_ends_at_the_limit(sphere):
    scene = water_scene(gap=1e-8, volume=1e-21, upper=sphere)
    made = ck.plan(scene)
    bend = 0.0 if sphere is None else 1e6
    limit = float(stability_limit(1e-21, 60 * DEG, 60 * DEG, 0.0, bend).gap)
    assert made.film.end == approx(limit, 1e-8)
    wide = evolve(
        scene, loading=ck.ImposedSpeed(initial_gap=1.001 * limit, final_gap=1e-6, speed=1e-9)
    )
    with pytest.raises(ck.InfeasibleError, match=rf"this volume reaches {limit:.6g} m at most"):
        ck.plan(wide)


# Touching, and almost ------------------------------------------------------------------------


def test_a_touching_sphere_has_an_infinite_viscous_impulse():
    touching = {"gap": 0.0, "volume": 1e-21, "upper": ck.Sphere(radius=1e-6)}
    with pytest.raises(ck.InfeasibleError, match=r"initial_gap is 0 m.*ln\(1/gap\).*cut-off"):
        ck.plan(water_scene(ck.ViscousForce(), **touching))
    assert ck.plan(water_scene(**touching)).film.static_force(0.0) > 0.0
    given = {"sphere_radius": 1e-6, "separation_time": 1e-6, "viscosity": 1e-3}
    with pytest.raises(ck.InfeasibleError, match=r"Eq\. \(3\.26\)"):
        ck.published("3.26", gap_start=0.0, film_height=2e-9, gap_end=1e-8, **given)


def test_squeezed_to_a_picometre_and_to_a_billionth():
    """Closed forms that cancel completely without log1p; digits by hand with 30 of them."""
    hard = squeeze.sphere_impulse_conserved(5e-3, 1e-6, 1e-12, math.inf, 0.1)
    assert float(hard) == approx(VISCOUS["sphere_hard_D0=1e-09_H0=0.001"]["impulse_inf_Ns"], 1e-13)
    tiny = 1e-9 * (1.0 + 1e-9)
    off = (tiny - 1e-9) / 1e-9  # what of the ratio is left after rounding
    slim = squeeze.sphere_impulse_conserved(5e-3, tiny, 1e-9, math.inf, 0.1)
    # 6 pi eta R^2 ln[(1 + q)^2/(4 q)] with q = 1 + off
    assert float(slim) == approx(6.0 * math.pi * 0.1 * 25e-6 * 0.25 * off * off * (1.0 - off), 1e-8)
    assert float(slim) == approx(1.178e-23, 1e-3)


# A trace, a sign, a ratio of a million --------------------------------------------------------


def test_a_trace_of_liquid():
    assert force(0.0, 1e-15, 40 * DEG, 40 * DEG, 0.0, 1.0) == approx(9.625869604487512)
    assert force(1e-5, 1e-8, 0.0, 0.0, 1.0, 1.0) == approx(5.486245554756386)
    arc = next(c for c in CASES["arc_sphere"] if c["id"] == "arc_sphere_sphere_40_40_V1e-09_D0")
    mine = bridge_arc.arc_bridge(0.0, 1e-9, 40 * DEG, 40 * DEG, 0.0, 1.0)
    assert float(mine.radius_upper) == approx(arc["x_n"], 1e-12)
    assert float(mine.force) == approx(arc["F_consistent"], 1e-12)


def test_a_force_that_changes_its_sign():
    assert force(0.5, 1.0, 120 * DEG, 120 * DEG) == approx(-1.597461766116158)
    assert force(1.0, 1.0, 120 * DEG, 120 * DEG) == approx(0.6845700937788354)
    assert force(0.15, 0.01, 120 * DEG, 120 * DEG, 0.0, 1.0) == approx(-0.0253993, 2e-6)
    for angle in (91, 100, 120, 150, 170, 179):  # a zone of a sphere, h = -2 a cos t
        t, half = angle * DEG, -math.cos(angle * DEG)
        volume = 2.0 * math.pi * (half - half**3 / 3.0)
        state = bridge(2.0 * half, volume, t, t)
        assert abs(float(state.force)) < 1e-9 * float(state.radius_lower)
        assert float(state.radius_lower / (2.0 * half)) == approx(-0.5 * math.tan(t), 1e-9)
        assert KINDS[int(state.kind)] == "sphere"


@pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning")
def test_a_sphere_is_repelled_by_angles_below_a_right_one():
    case = BRIDGES["sphere/flat_85_85_V0.1_D0"]
    state = found(case)
    assert float(state.force) == approx(case["F_over_gamma"])
    assert float(state.force) < 0.0
    assert not laterally_stable(state.force, 0.0, 1.0)
    scene = water_scene(gap=0.0, volume=1e-19, angle=85.0, upper=ck.Sphere(radius=1e-6))
    with pytest.warns(ck.ValidityWarning, match="expelled sideways: it is laterally unstable"):
        ck.simulate(ck.plan(scene))


def test_gaps_of_a_millionth_of_the_sphere():
    (other,) = elliptic_bridge.at_gaps([1e-4], 60 * DEG, 60 * DEG, 1e-2)
    assert force(1e-6, 1e-6, 60 * DEG, 60 * DEG, 0.0, 1.0) == approx(1e-2 * other.force)
    line = bridge(np.geomspace(1e-12, 1e-2, 21), 1e-6, 60 * DEG, 60 * DEG, 0.0, 1.0).force
    assert np.all(np.diff(line) < 0.0)
    assert line[0] == approx(force(0.0, 1e-6, 60 * DEG, 60 * DEG, 0.0, 1.0), 1e-7)


# A hundred thousand menisci -------------------------------------------------------------------


def test_a_hundred_thousand_menisci_of_six_nanometres_do_not_exist():
    crowd = {"volume": 6e-21, "gap": 6e-9, "count": 100_000}
    said = r"reaches 5\.56\d*e-09 m at most; .*at most 79611 me"
    with pytest.raises(ck.InfeasibleError, match=said):
        ck.plan(water_scene(**crowd))
    for n in (79611, 79612):
        scene = water_scene(**crowd | {"count": n})
        if n == 79611:
            assert ck.plan(scene).film.static_force(6e-9) > 0.0
        else:
            with pytest.raises(ck.InfeasibleError, match="at most 79611 menisci"):
                ck.plan(scene)
    printed = ck.published(
        "3.33",
        radius=math.sqrt(1e-12 / math.pi),
        gap=6e-9,
        surface_tension=0.072,
        angle_lower=60 * DEG,
        angle_upper=60 * DEG,
        number=100_000,
        pulled="lower",
    )
    assert printed.value > 0.0
    assert printed.corrected is None


def test_a_hundred_thousand_menisci_of_two_nanometres():
    scene = water_scene(volume=2e-21, gap=2e-9, count=100_000)
    assert ck.plan(scene).film.static_force(2e-9) == approx(7.4007e-5, 1e-5)
    printed = ck.published(
        "3.33",
        radius=math.sqrt(1e-12 / math.pi),
        gap=2e-9,
        surface_tension=0.072,
        angle_lower=60 * DEG,
        angle_upper=60 * DEG,
        number=100_000,
        pulled="lower",
    )
    assert printed.value == approx(1.059e-4, 1e-3)
    one = evolve(
        scene, interface=evolve(scene.interface, meniscus=evolve(scene.interface.meniscus, count=1))
    )
    assert ck.divide_meniscus(one, [1]).max_stable_count == 716506


@pytest.mark.parametrize("case", CASES["division"], ids=lambda c: f"{c['h0_nm']}nm_{c['N']}")
def test_divisions_of_the_case_file(case):
    gap = case["h0_nm"] * 1e-9
    scene = water_scene(volume=1e-12 * gap, gap=gap, count=case["N"])
    made = ck.plan(scene)
    assert made.film.static_force(gap) == approx(case["F_m_total_exact_N"])
    assert made.film.end == approx(case["h_limit_exact_nm"] * 1e-9, 1e-8)


# Viscosities from that of water vapour to that of honey --------------------------------------


@pytest.mark.parametrize("upper", [None, ck.Sphere(radius=1e-3)])
def test_the_viscous_force_is_linear_over_a_million(upper):
    values = []
    for viscosity in (1e-4, 1e-3, 1.0, 1e2):
        scene = water_scene(ck.ViscousForce(), gap=1e-7, volume=1e-16, upper=upper)
        oil = evolve(WATER, viscosity=viscosity)
        film = evolve(scene.interface.meniscus, liquid=oil)
        made = ck.plan(evolve(scene, interface=evolve(scene.interface, meniscus=film)))
        law = made.film.laws[ck.ViscousForce]
        values.append((law.force(1e-7, 1e-3) / viscosity, law.impulse(1e-7, 1e-6) / viscosity))
    for value in values[1:]:
        assert value == pytest.approx(values[0], rel=1e-13)
    case = VISCOUS["flat_eta=0.01"]
    volume = math.pi * case["x0_m"] ** 2 * case["h0_m"]
    impulse = squeeze.disc_impulse_conserved(volume, case["h0_m"], case["hs_m"], case["eta_Pa_s"])
    assert float(impulse) == approx(case["impulse_conserving_Ns"], 1e-13)


# Equal angles, and a thousandth of a degree off -----------------------------------------------


def test_the_limit_has_a_cusp_at_equal_angles():
    off = np.array([1e-4, 1e-3, 1e-2, 1e-1])
    limit = stability_limit(1.0, 60 * DEG, (60 + off) * DEG).gap
    lost = float(stability_limit(1.0, 60 * DEG, 60 * DEG).gap) - limit
    powers = np.diff(np.log(lost)) / np.diff(np.log(off))
    assert powers == pytest.approx(2.0 / 3.0, abs=0.02)
    assert [
        f"{float(x):.4f}"
        for x in stability_limit(1.0, 60 * DEG, np.array([60.0, 60.1, 61.0, 65.0]) * DEG).gap
    ] == ["1.4205", "1.4095", "1.3709", "1.2813"]


def test_a_thousandth_of_a_degree_matters_at_a_right_angle():
    equal = float(stability_limit(1.0, 90 * DEG, 90 * DEG).gap)
    near = float(stability_limit(1.0, 90 * DEG, 90.001 * DEG).gap)
    assert equal == approx(math.pi ** (1.0 / 3.0), 1e-12)
    assert 1e-4 < 1.0 - near / equal < 1e-2
    assert force(0.5, 1.0, 90 * DEG, 90.001 * DEG) == approx(
        force(0.5, 1.0, 90 * DEG, 90 * DEG), 1e-4
    )


@pytest.mark.parametrize("case", CASES["limit_table_flat"], ids=str)
def test_the_table_of_limits_between_flats(case):
    limit = stability_limit(2.0, *angles(case))
    assert float(limit.gap) == approx(case["D_limit_over_L"] * 2.0 ** (1.0 / 3.0), 1e-8)
