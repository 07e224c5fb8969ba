"""Adhesion of maps: laws of attraction, reference states of a rough map, spheres, limits."""

from __future__ import annotations

import json
import math
import warnings
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import quad
from selection import quick

import contactkit as ck
from contactkit.adhesion import attraction, maugis_dugdale, rough_limits
from contactkit.adhesion.parameters import scales
from contactkit.elasticity.layered import normal_symbol

pytestmark = pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning")

CASES = json.loads((Path(__file__).parents[2] / "data" / "adhesion.json").read_text("utf-8"))
MODULUS, WORK, RADIUS = 1e9, 0.05, 1e-6
SOLID = ck.Material(young_modulus=MODULUS, poisson_ratio=0.0)
UNITS = scales(RADIUS, WORK, MODULUS)
LAWS = (
    ck.ExponentialAttraction(work_of_adhesion=WORK, range=2e-9),
    ck.DugdaleAttraction(work_of_adhesion=WORK, range=2e-9),
    ck.DugdaleAttraction(work_of_adhesion=WORK, range=2e-9, end_width=2e-9),
    ck.LennardJonesAttraction(work_of_adhesion=WORK, range=2e-9),
)


def scene(surface, law, window, *effects, loading=None, solid=SOLID):
    return ck.ContactScene(
        interface=ck.Interface(lower=ck.Body(solid=solid), upper=ck.Body(surface=surface)),
        window=window,
        loading=loading or ck.Approach(approach=0.0),
        effects=(ck.LayeredHalfSpace(), ck.Adhesion(law=law), *effects),
    )


def wave_map(n):
    """Sum of given cosines: rms 2 nm."""
    x, y = np.meshgrid((np.arange(n) + 0.5) / n, (np.arange(n) + 0.5) / n)
    h, k = np.zeros((n, n)), 0
    for i in range(-6, 7):
        for j in range(7):
            q = math.hypot(i, j)
            if q < 2 or q > 6.5 or (j == 0 and i < 0):
                continue
            k += 1
            h += q**-1.8 * np.cos(2.0 * np.pi * (i * x + j * y) + 2.399963229728653 * k * k)
    return h * (2e-9 / h.std())


def rough(law, *effects, n=32, scale=1.5, periodic=True, **given):
    heights = scale * wave_map(n)
    surface = ck.Heights(heights=heights - heights.mean(), pixel_size=1e-6 / n)
    return ck.plan(scene(surface, law, ck.Window(periodic=periodic), *effects, **given))


def sphere(transition, n, width=5.0):
    """Sphere of a Maugis parameter, in a window of a width in units of Maugis."""
    stiffness = 4.0 / 3.0 * MODULUS
    stress = 0.5 * transition * (math.pi * WORK * stiffness**2 / RADIUS) ** (1.0 / 3.0)
    law = ck.DugdaleAttraction(work_of_adhesion=WORK, range=WORK / stress)
    window = ck.Window(width=width * UNITS.radius, periodic=False)
    return ck.plan(scene(ck.Paraboloid(radius=RADIUS), law, window), ck.Accuracy(grid=n))


@pytest.mark.parametrize("law", LAWS)
def test_a_law_does_the_work_of_adhesion_and_never_rises(law):
    made = law.on_grid(1e-19)
    gap = np.concatenate([np.linspace(0.0, 2e-8, 200_001), np.geomspace(2.00001e-8, 1e-4, 100_000)])
    tension, energy = made.tension(gap), made.energy(gap)
    assert energy[0] == pytest.approx(-WORK, rel=1e-12)
    assert np.trapezoid(tension, gap) == pytest.approx(WORK, rel=1e-6)
    assert np.all(np.diff(tension) <= 1e-9 * made.strength)
    assert tension[0] == pytest.approx(made.strength, rel=1e-12)
    # The energy is the integral of the tension.
    part = slice(0, 200_001)
    gained = np.trapezoid(tension[part], gap[part])
    assert energy[200_000] - energy[0] == pytest.approx(gained, rel=1e-8)
    falls = -np.diff(tension) / np.diff(gap)
    assert falls.max() == pytest.approx(made.steepest, rel=1e-4)


def test_lennard_jones_is_that_of_half_spaces_beyond_its_peak():
    z = np.array([1.3, 2.0, 5.0])
    peak = 3.0 ** (1 / 6)
    below = quad(lambda x: 8 / 3 * (x**-3 - x**-9), 1.0, peak)[0]  # work up to the peak, over w
    flat = below / (8 / 3 * (peak**-3 - peak**-9))  # the same work at the tension of the peak
    tension = attraction.lennard_jones_tension((z - peak + flat) * 1e-9, 0.05, 1e-9)
    assert tension == pytest.approx(8 * 0.05 / 3e-9 * (z**-3 - z**-9), rel=1e-7)


@pytest.mark.parametrize("name", quick(CASES["rough"], 0))
def test_a_rough_map_meets_the_states_of_a_gradient_flow(name):
    """Energies to 1e-6, pixels in contact exactly, on both branches."""
    case = CASES["rough"][name]
    work, reach = case["law"]["work"], case["law"]["range"]
    law = (
        ck.DugdaleAttraction(work_of_adhesion=work, range=reach, end_width=case["law"]["blur"])
        if "blur" in case["law"]
        else ck.ExponentialAttraction(work_of_adhesion=work, range=reach)
    )
    plan, last = rough(law), None
    rows = case["approach"] + case.get("separation", [])
    largest = max(abs(energy) for _, _, energy, _ in rows)
    highest = max(abs(pressure) for _, pressure, _, _ in rows)
    for level, pressure, energy, pixels in rows:
        approach = level + float(plan.heights.max())
        last = ck.solve(plan.with_loading(ck.Approach(approach=approach)), start=last)
        part = last.of(ck.Adhesion)
        assert part.energy / plan.grid.area == pytest.approx(energy, rel=1e-6, abs=1e-9 * largest)
        assert last.mean_pressure == pytest.approx(pressure, abs=1e-5 * highest)
        assert int(last.contact.sum()) == pixels


@pytest.fixture(scope="module")
def jkr_like():
    levels = np.linspace(-1.2, 0.0, 6) * UNITS.approach
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ck.ValidityWarning)
        return ck.pull_off_curve(sphere(2.0, 32, 4.0), levels, n_refinements=3)


def test_a_curve_is_drawn_with_its_jumps(jkr_like):
    plot = pytest.importorskip("contactkit.plot.adhesion")
    for draw in (plot.pull_off_curve, plot.contact_area):
        lines = draw(jkr_like).get_lines()
        dotted = [line for line in lines if line.get_linestyle() == ":"]
        assert len(dotted) == len(jkr_like.jumps) == 2
        labels = {line.get_label() for line in lines}
        assert {"approach", "separation"} <= labels


def test_a_sphere_pulls_off_as_maugis_and_dugdale_have_it(jkr_like):
    found = jkr_like
    limits = maugis_dugdale.limits(2.0)
    assert found.pull_off_force / UNITS.load == pytest.approx(-limits.pull_off.load, rel=0.03)
    assert found.jumps[0].branch == "approach"
    assert found.jumps[-1].branch == "separation"
    # The contact is lost at the largest gap of the closed form.
    release = found.jumps[-1].after / UNITS.approach
    assert release == pytest.approx(limits.release.approach, abs=0.04)
    assert found.is_closed
    lost = sum(jump.energy_lost for jump in found.jumps)
    assert lost == pytest.approx(found.loop_energy, rel=0.1)
    total = float(
        found.approaching.dissipated_energy.sum() + found.separating.dissipated_energy.sum()
    )
    assert total == pytest.approx(found.loop_energy, rel=1e-9)


@pytest.mark.parametrize("transition", [0.2, 2.0])
def test_the_tabor_parameter_of_a_sphere_is_that_of_its_radius(transition):
    """Maugis' parameter is 2 (9/(16 pi))^(1/3) times that of Tabor, for a tension of work/range."""
    found = ck.solve(sphere(transition, 32)).of(ck.Adhesion).tabor_parameter
    assert 2.0 * (9.0 / (16.0 * math.pi)) ** (1 / 3) * found == pytest.approx(transition, rel=1e-6)


@pytest.mark.parametrize(
    "case",
    [
        pytest.param(
            case, marks=pytest.mark.slow if case["transition"] == 0.5 else pytest.mark.exhaustive
        )
        for case in CASES["maugis_dugdale"]
    ],
    ids=lambda case: str(case["transition"]),
)
def test_the_sphere_on_a_fine_grid(case):
    """Pull-off within 1 %, 2 % at a Maugis parameter of 5."""
    transition = case["transition"]
    width, low, high, count = {
        0.1: (9.0, -0.4, 0.2, 13),
        0.5: (6.0, -1.0, 0.1, 12),
    }.get(transition, (5.0, -1.1, 0.0, 12))
    plan = sphere(transition, 128, width)
    assert plan.scene.effect(ck.Adhesion).law.range == pytest.approx(case["range_m"], rel=1e-9)
    levels = np.linspace(low, high, count) * UNITS.approach
    found = ck.pull_off_curve(plan, levels)
    tolerance = 0.02 if transition >= 5.0 else 0.01
    assert found.pull_off_force / UNITS.load == pytest.approx(-case["pull_off"], rel=tolerance)


def test_a_load_is_carried_in_the_state_of_an_approach():
    plan = rough(LAWS[1], n=24, periodic=False)
    pressed = ck.solve(plan.with_loading(ck.Pressing(pressure=2e5)))
    assert pressed.mean_pressure == pytest.approx(2e5, rel=1e-8)
    again = ck.solve(plan.with_loading(ck.Approach(approach=pressed.approach)), start=pressed)
    assert again.load == pytest.approx(pressed.load, rel=1e-5)
    assert np.array_equal(again.contact, pressed.contact)
    # Every lower approach on that branch carries less.
    below = ck.solve(plan.with_loading(ck.Approach(approach=pressed.approach - 1e-10)))
    assert below.load < pressed.load


def test_a_sphere_is_pulled_up_to_the_force_of_maugis_and_dugdale():
    plan, limits = sphere(1.0, 48), maugis_dugdale.limits(1.0)
    limit = -limits.pull_off.load * UNITS.load
    for ratio in (0.3, 0.7):
        pulled = ck.solve(plan.with_loading(ck.Pressing(force=-ratio * limit)))
        exact = maugis_dugdale.at_load(-ratio * limit / UNITS.load, 1.0, limits).approach
        assert pulled.load == pytest.approx(-ratio * limit, rel=1e-9)
        assert pulled.approach / UNITS.approach == pytest.approx(exact, abs=0.02)
    with pytest.raises(ck.InfeasibleError, match="exceeds the pull-off force") as caught:
        ck.solve(plan.with_loading(ck.Pressing(force=-1.05 * limit)), start=pulled)
    named = float(str(caught.value).split("about ")[1].split()[0])
    assert named == pytest.approx(limit, rel=0.03)
    assert "from the state to start from" in str(caught.value)


STICKY = ck.ExponentialAttraction(work_of_adhesion=WORK, range=1e-9)


@pytest.mark.parametrize(("periodic", "pull"), quick([(False, 3.5e6), (True, 4.5e6)], 0))
def test_a_pulled_map_is_on_the_branch_of_a_separation(periodic, pull):
    """One pull or four, from rest or from a load: the state before decides, not the steps."""
    plan = rough(STICKY, n=24, periodic=periodic)
    at_once = ck.solve(plan.with_loading(ck.Pressing(pressure=-pull)))
    steps = pull * np.array([0.0, -0.25, -0.5, -0.75, -1.0])
    last = ck.load_curve(plan, pressures=steps, keep_maps=True).results[-1]
    assert last.mean_pressure == pytest.approx(-pull, rel=1e-8)
    assert last.approach == pytest.approx(at_once.approach, rel=1e-4)
    assert np.array_equal(last.contact, at_once.contact)
    # From a load the same pull leaves at least as much contact.
    pressed = ck.load_curve(plan, pressures=[2e7, -pull])
    assert pressed.contact_area[-1] >= last.contact_area
    # Bodies that come together to the same approach have less.
    held = ck.solve(plan.with_loading(ck.Approach(approach=last.approach)), start=last)
    assert held.load == pytest.approx(last.load, rel=1e-4)
    entering = ck.solve(plan.with_loading(ck.Approach(approach=last.approach)))
    assert entering.contact_area < last.contact_area


@pytest.mark.slow
def test_a_chain_of_approaches_is_the_path_of_a_curve():
    plan = rough(STICKY, n=24)
    levels = np.linspace(-3e-9, 0.0, 5)
    path = ck.pull_off_curve(plan, levels, n_refinements=0)
    chain = ck.load_curve(plan, approaches=[*levels, *levels[-2::-1]])
    both = np.concatenate([path.approaching.load, path.separating.load[1:]])
    np.testing.assert_allclose(chain.load, both, rtol=1e-6)
    assert np.abs(chain.load - chain.load[::-1]).max() > 0.01 * np.abs(both).max()


def test_branches_of_an_isolated_map_do_not_depend_on_the_steps():
    """Seven levels or thirteen: the same loads to 1e-5 of the largest."""
    law = ck.ExponentialAttraction(work_of_adhesion=WORK, range=3e-9)
    plan = rough(law, n=24, periodic=False)
    few = np.linspace(-1.2e-8, 2e-9, 7)
    coarse = ck.pull_off_curve(plan, few, n_refinements=0)
    fine = ck.pull_off_curve(plan, np.linspace(-1.2e-8, 2e-9, 13), n_refinements=0)
    for one, other in (
        (coarse.approaching, fine.approaching),
        (coarse.separating, fine.separating),
    ):
        scale = np.abs(other.load).max()
        assert np.abs(one.load - other.load[::2]).max() <= 1e-5 * scale


@pytest.mark.exhaustive
def test_branches_of_a_periodic_map_do_not_depend_on_the_steps():
    """Five levels or nine: without the way by the middle of a step the separation is 15 % off."""
    law = ck.ExponentialAttraction(work_of_adhesion=WORK, range=0.7e-9)
    plan, levels = rough(law, n=24, scale=1.3), np.linspace(-4e-9, 0.0, 5)
    few, many = (ck.pull_off_curve(plan, np.linspace(-4e-9, 0.0, n)) for n in (5, 9))
    assert few.jumps
    for name in ("approaching", "separating"):
        one, other = (
            getattr(curve, name).load[
                [int(np.argmin(np.abs(getattr(curve, name).approach - at))) for at in levels]
            ]
            for curve in (few, many)
        )
        assert np.abs(one - other).max() <= 1e-3 * few.pull_off_force


def test_the_energy_of_a_state_is_a_minimum_along_its_branch():
    """On a smooth branch the load is the slope of the energy over the approach."""
    plan = rough(LAWS[0], n=24)
    step, at = 2e-12, 1e-9
    states = [ck.solve(plan.with_loading(ck.Approach(approach=at + i * step))) for i in (-1, 0, 1)]
    low, high = (state.of(ck.Adhesion).energy for state in (states[0], states[2]))
    assert (high - low) / (2.0 * step) == pytest.approx(states[1].load, rel=1e-3)


def test_a_hardness_bounds_the_net_pressure():
    hardness = 2e7
    limit = ck.HardnessLimit(rule=ck.ConstantHardness(hardness=hardness))
    plan = rough(LAWS[0], limit, n=24)
    result = ck.solve(plan.with_loading(ck.Approach(approach=3e-9)))
    assert result.max_pressure == pytest.approx(hardness, rel=1e-9)
    assert result.plastic_area > 0.0
    assert result.pressure.min() < 0.0


def test_a_soft_layer_sticks_more():
    soft = ck.Material(young_modulus=0.2 * MODULUS, poisson_ratio=0.3)
    coated = ck.Stack(layers=(ck.Layer(material=soft, thickness=5e-8),), substrate=SOLID)
    at = ck.Approach(approach=1e-9)
    areas = [
        ck.solve(rough(LAWS[0], n=24, solid=solid).with_loading(at)).contact_area
        for solid in (SOLID, coated)
    ]
    assert areas[1] > areas[0]


@pytest.mark.parametrize("layers", [(), (5e-8,)])
def test_full_contact_costs_what_its_waves_cost(layers):
    heights = wave_map(24)
    pixel = (1e-6 / 24, 1e-6 / 24)
    moduli = [0.1 * MODULUS, MODULUS][-1 - len(layers) :]
    symbol = normal_symbol((24, 24), pixel, moduli, [0.0] * len(moduli), layers)
    found = rough_limits.full_contact_energy(heights, symbol)
    # The pressure that displaces the surface by the heights does that work.
    waves = np.fft.rfft2(heights)
    pressed = np.divide(waves, symbol, out=np.zeros_like(waves), where=symbol > 0.0)
    work = 0.5 * float((np.fft.irfft2(pressed, s=(24, 24)) * heights).mean())
    assert found == pytest.approx(work, rel=1e-12)
    spectrum = np.abs(np.fft.fft2(heights) / heights.size) ** 2
    q = 2.0 * np.pi * np.hypot(*np.meshgrid(*[np.fft.fftfreq(24, p) for p in pixel]))
    rigid_below = 0.25 * MODULUS * float((q * spectrum).sum())
    assert found < 0.5 * rigid_below if layers else found == pytest.approx(rigid_below, rel=1e-12)


def test_stickiness_falls_with_work_and_rises_with_slope():
    base = rough_limits.stickiness_number(0.1, 2e7, 0.05, 1e-9, 1e9)
    assert rough_limits.stickiness_number(0.1, 2e7, 0.1, 1e-9, 1e9) == pytest.approx(base / 2.0)
    # A rim of (slope diameter/4 range)^(2/3), with a diameter of 4 slope/laplacian.
    assert base == pytest.approx(0.1 * 1e-9 / (2.0 * 5e-11) * (0.01 / (2e7 * 1e-9)) ** (2 / 3))
    assert pytest.approx(1.0292, abs=1e-4) == rough_limits.STICKY_BELOW


def test_menisci_from_humid_air_pull_with_the_tension_of_the_liquid():
    """Range and tension by hand: the Kelvin radius, both angles, and w = gamma (cos + cos)."""
    water = ck.load_liquid("water")
    made = ck.DugdaleAttraction.from_humidity(
        liquid=water,
        relative_humidity=0.6,
        temperature=333.15,
        contact_angle_lower=0.5,
        contact_angle_upper=0.2,
    )
    state, wetting = water.at(333.15), np.cos(0.5) + np.cos(0.2)
    kelvin = -state.surface_tension * (0.0180153 / state.density)
    kelvin /= 8.31446 * 333.15 * np.log(0.6)
    assert made.work_of_adhesion == pytest.approx(state.surface_tension * wetting, rel=1e-12)
    assert made.range == pytest.approx(kelvin * wetting, rel=1e-4)
    with pytest.raises(ck.DescriptionError, match="add up to less than pi"):
        ck.DugdaleAttraction.from_humidity(
            liquid=water,
            relative_humidity=0.6,
            temperature=293.15,
            contact_angle_lower=2.0,
            contact_angle_upper=2.0,
        )
