"""Cavity of a disc of film with the memory of what was cavitated, against references."""

import math

import numpy as np
import pytest
from reynolds_cases import CASES

import contactkit as ck
from contactkit.lubrication.disc_cavity import film_ring, inflow, receding_edge
from contactkit.lubrication.film_limits import disc_tension_reynolds
from contactkit.lubrication.rupture_history import (
    cut,
    edge_of,
    grown,
    liquid_within,
    outermost,
    piece_along,
    piece_at,
    void_within,
)
from contactkit.separation.cavity.law import CavityLaw
from contactkit.separation.cavity.path import along_path
from contactkit.separation.cavity.stages import shown_cavity
from contactkit.separation.cavity.state import FULL, Cavity, Phase
from contactkit.separation.motion.advance import advance
from contactkit.separation.motion.state import Pull, outputs, start

pytestmark = pytest.mark.filterwarnings("ignore::contactkit.ValidityWarning")

PULLS = [name for name in CASES if name.startswith("pull_") and "_jfo_" in name]
FACE = 3.175e-3
AMBIENT = 1e5


def film(viscosity=0.1, volume=None, radius=FACE):
    liquid = ck.Liquid(name="oil", viscosity=viscosity)
    face = ck.Flat(radius=radius)
    meniscus = ck.Meniscus(liquid=liquid, volume=volume)
    return ck.Interface(lower=face, upper=face, meniscus=meniscus)


def limit(strength, drop):
    return ck.TensionLimit(
        strength=strength, cavity_pressure=AMBIENT - drop, ambient_pressure=AMBIENT
    )


def pulled(case, rtol=1e-8):
    given = case["inputs"]
    full = math.pi * given["radius"] ** 2 * given["initial_gap"]
    volume = None if given["rim"].startswith("flooded") else full
    cavitates = given.get("tension_to_nucleate") or given["tension"]
    scene = ck.SeparationScene(
        interface=film(given["viscosity"], volume, given["radius"]),
        loading=ck.ImposedForce(
            initial_gap=given["initial_gap"],
            final_gap=given["final_gap"],
            force=given["force"],
            mass=given["mass"],
        ),
        effects=(ck.ViscousForce(), limit(cavitates, given.get("tension_of_cavity") or cavitates)),
    )
    return ck.simulate(ck.plan(scene, ck.Accuracy(time_rtol=rtol)))


@pytest.mark.parametrize("name", PULLS)
def test_a_film_that_cavitates_is_released_on_time(name):
    case = CASES[name]
    values, state = case["values"], (result := pulled(case)).state
    assert state.release_time == pytest.approx(values["t_release"], rel=1e-6)
    assert state.release_speed == pytest.approx(values["v_release"], rel=1e-6)
    if "void_volume_end" in values:
        assert result["void_volume"][-1] == pytest.approx(values["void_volume_end"], rel=2e-6)
        assert result["viscous_force"][-1] == pytest.approx(values["F_end"], rel=2e-6)
        widest = result["cavity_radius"].max() / case["inputs"]["radius"]
        assert widest == pytest.approx(values["rc_max_over_R"], rel=2e-6)
    cavitated = result["limit"] == ck.LimitKind.TENSION
    assert result.time[cavitated][0] == pytest.approx(values["t_on"], rel=1e-6)


def test_a_looser_tolerance_costs_fewer_steps_and_stays_near():
    case = CASES["pull_free_jfo_1.0"]
    loose, tight = pulled(case, 1e-5), pulled(case, 1e-8)
    assert loose.work.n_steps < 0.5 * tight.work.n_steps
    assert loose.state.release_time == pytest.approx(tight.state.release_time, rel=1e-5)


def test_the_edge_of_an_opening_film_is_that_of_swift_and_stieber():
    for sigma in (1.0 + 1e-9, 1.01, 2.0, 30.0, 1e3, 1e6, 1e12):
        rho = receding_edge(sigma)
        assert 0.0 < rho < 1.0
        if sigma < 1e6:
            assert 1.0 - rho + rho * math.log(rho) == pytest.approx(1.0 / sigma, rel=1e-9)
        k, rim = 1e-15, 1e-5
        speed = sigma * 4.0 * k * 1e6 / rim
        newtonian = math.pi * rim * rim * speed / (8.0 * k)
        expected = disc_tension_reynolds(newtonian, math.pi * rim, 1e6)
        assert film_ring(rho, rim, k, 1e6, speed).force == pytest.approx(expected, rel=1e-9)
    for case in ("disc_expanding_3", "disc_expanding_1000"):
        given, values = CASES[case]["inputs"], CASES[case]["values"]
        k = given["gap"] ** 3 / (12.0 * given["viscosity"])
        rim, speed = given["radius"] ** 2, given["opening_speed"]
        rho = receding_edge(speed * rim / (4.0 * k * given["tension"]))
        assert math.sqrt(rho * rim) == pytest.approx(values["cavity_radius"], rel=1e-12)
        force = film_ring(rho, rim, k, given["tension"], speed).force
        assert force == pytest.approx(values["pull"], rel=1e-12)


@pytest.mark.parametrize("rho", [1e-12, 0.3, 0.9, 0.969, 0.9701, 0.9999])
def test_force_and_inflow_have_the_slopes_they_give(rho):
    k, rim, drop, speed = 1e-15, 1e-5, 1e6, 1e-3
    one, two = (film_ring(rho, rim, k, drop, v).force for v in (speed, 2.0 * speed))
    slope = film_ring(rho, rim, k, drop, speed).by_speed
    assert two - one == pytest.approx(slope * speed, rel=1e-6, abs=1e-12 * abs(one))
    step = 1e-6 * min(rho, 1.0 - rho) * rim
    edge = rho * rim
    growth = [inflow(edge + x, rim, k, drop, speed).growth for x in (-step, step)]
    by_edge = inflow(edge, rim, k, drop, speed).by_edge
    assert (growth[1] - growth[0]) / (2.0 * step) == pytest.approx(by_edge, rel=1e-4)


def test_the_ring_is_the_same_on_both_sides_of_its_series():
    """By speed it changes by itself 98 times as much as the edge: 2e-10 here."""
    rho = [0.97 * (1.0 + x) for x in (-1e-12, 1e-12)]
    a, b = (film_ring(r, 1.0, 1.0, 1.0, 1.0) for r in rho)
    assert a.force == pytest.approx(b.force, rel=1e-11)
    assert a.by_speed == pytest.approx(b.by_speed, rel=5e-10)


def memory(n):
    """Edge that recedes ever more slowly while the gap opens."""
    cavitated = (piece_at(0.1, 1.0),)
    nodes = (0.0, (4.0 - 6**0.5) / 10.0, (4.0 + 6**0.5) / 10.0, 1.0)
    for i in range(n):
        t = [(i + x) / n for x in nodes]
        squares = [0.1 + 0.8 * s * (2.0 - s) for s in t]
        cavitated = grown(
            cavitated, piece_along(liquid_within(cavitated), squares, [1.0 + s for s in t])
        )
    return cavitated


def test_the_void_says_where_the_edge_is():
    cavitated = memory(20)
    # M of y = 0.1 + 0.8 s (2 - s), h = 1 + s: pi (0.1 + 1.6 int (1 - s)(1 + s) ds)
    assert liquid_within(cavitated) == pytest.approx(
        math.pi * (0.1 + 1.6 * (1.0 - 1.0 / 3.0)), rel=1e-13
    )
    for s in (0.0, 0.1, 0.5, 0.93, 1.0):
        square = 0.1 + 0.8 * s * (2.0 - s)
        for gap in (2.0, 2.0 + 1e-9, 3.0, 100.0):
            liquid = math.pi * (0.1 + 1.6 * (s - s**3 / 3.0))
            found = edge_of(cavitated, gap, math.pi * square * gap - liquid)
            assert found.square == pytest.approx(square, rel=1e-7)
    assert edge_of(cavitated, 3.0, 0.0).square == 0.0
    assert edge_of(cavitated, 3.0, 1e9).square == outermost(cavitated) == pytest.approx(0.9)


def test_what_is_forgotten_or_joined_loses_no_liquid():
    cavitated, many = memory(20), memory(500)
    assert len(many) <= 64
    assert liquid_within(many) == pytest.approx(liquid_within(cavitated), rel=1e-13)
    void = 0.4 * void_within(cavitated, 3.0)
    shorter = cut(cavitated, 3.0, void)
    assert void_within(shorter, 3.0) == pytest.approx(void, rel=1e-12)
    for gap, share in ((2.1, 0.5), (4.0, 0.9)):
        void = share * void_within(cavitated, gap)
        assert edge_of(many, gap, void).square == pytest.approx(
            edge_of(cavitated, gap, void).square, rel=1e-6
        )


def test_an_oscillating_disc_cavitates_and_reforms():
    case = CASES["oscillating_disc_0.005"]
    given, values = case["inputs"], case["values"]
    radius, pace = given["radius"], math.tau * given["frequency"]
    mean, amplitude = given["gap_mean"], given["gap_amplitude"]
    law = CavityLaw(1, radius**2, math.inf, given["viscosity"], 1e5, 1e5)

    def place(time):
        angle = pace * time
        return mean - amplitude * math.cos(angle), pace * amplitude * math.sin(angle)

    cavity, time, phases = FULL, 0.0, {}
    wanted = zip(values["t"], values["cavity_radius"], values["pull"], strict=True)
    for end, edge, force in wanted:
        for point in along_path(law, cavity, place, time, end, 1e-8):
            if point.cavity.phase is not cavity.phase:
                phases[point.cavity.phase] = point.time
            cavity = point.cavity
        time = end
        shown = shown_cavity(law, cavity, *place(end))
        assert shown.radius == pytest.approx(edge, rel=2e-8)
        assert shown.force == pytest.approx(force, rel=2e-7)
    assert phases[Phase.RECEDING] == pytest.approx(values["t_rupture"], rel=1e-8)
    assert phases[Phase.RETURNING] == pytest.approx(values["t_turn"], rel=1e-5)
    for point in along_path(law, cavity, place, time, 0.0199, 1e-8):
        if point.cavity.phase is Phase.FULL:
            break
    # the reference ends where the cavity has 0.005 R
    assert point.time == pytest.approx(values["t_nearly_full"], rel=5e-5)
    assert point.time > values["t_nearly_full"]


def refilling():
    case = CASES["disc_refill_0.1_0.9_1e+06"]
    given = case["inputs"]
    edge = given["cavity_radius"] ** 2
    cavitated = (piece_at(edge, given["gap_at_rupture"]),)
    void = void_within(cavitated, given["gap"])
    fraction = edge / given["radius"] ** 2
    return case, Cavity(Phase.RETURNING, void, fraction, cavitated, void)


def test_a_cavity_at_rest_refills_in_its_time():
    case, cavity = refilling()
    given, values = case["inputs"], case["values"]
    drop = given["tension"]
    law = CavityLaw(1, given["radius"] ** 2, math.inf, given["viscosity"], drop, drop)
    rest = (given["gap"], 0.0)
    assert shown_cavity(law, cavity, *rest).force == pytest.approx(
        values["pull_at_start"], rel=1e-12
    )
    time = 0.0
    for end, radius in zip(values["t_at_radius"], values["cavity_radius"], strict=True):
        *_, last = along_path(law, cavity, lambda t: rest, time, end, 1e-9)
        cavity, time = last.cavity, end
        assert shown_cavity(law, cavity, *rest).radius == pytest.approx(radius, rel=1e-9)
    for point in along_path(law, cavity, lambda t: rest, time, 1.0, 1e-9):
        if point.cavity.phase is Phase.FULL:
            break
    assert point.time == pytest.approx(values["t_full"], rel=1e-7)


def moving(rest_gap=0.0, strength=1e6, drop=1e6, **more):
    given = {"initial_gap": 5e-6, "final_gap": 25e-6, "force": 40.0, "mass": 0.02} | more
    scene = ck.SeparationScene(
        interface=film(),
        loading=ck.ImposedForce(rest_gap=rest_gap, **given),
        effects=(ck.ViscousForce(), limit(strength, drop)),
    )
    return ck.plan(scene)


def test_a_film_that_is_cavitated_at_the_start_has_its_cavity_there():
    plan = moving(initial_speed=0.1)
    begun = start(plan)
    assert begun.cavity.phase is Phase.RECEDING
    assert begun.n_inceptions == 1
    shown = outputs(plan, begun, 40.0)
    assert 0.9 * math.pi * FACE**2 * 1e6 < shown.viscous < math.pi * FACE**2 * 1e6
    assert shown.cavity_radius > 0.9 * FACE
    assert shown.void == 0.0


@pytest.mark.slow
def test_a_face_that_closes_meets_no_full_film_above_the_gap_of_rupture():
    plan = moving(rest_gap=5e-6, initial_gap=5e-6, final_gap=30e-6)
    open_ = advance(plan, start(plan), Pull(40.0), 2.9e-4)
    assert open_.gap > 24e-6
    void = outputs(plan, open_, 40.0).void
    assert void > 0.6 * math.pi * FACE**2 * open_.gap
    gaps, state = [], open_
    while state.cavity.phase is not Phase.FULL and state.time < 5e-3:
        state = advance(plan, state, Pull(-40.0), 4e-6)
        gaps.append(state.gap)
    # never more than the liquid that was left, and what has come in since
    assert 5e-6 < gaps[-1] < 12e-6
    # without its memory, the film stops the face far out
    assert min(gaps) < 0.5 * open_.gap


def test_divided_time_and_whole_time_give_the_same():
    plan = moving()
    whole = advance(plan, start(plan), Pull(40.0), 2e-4)
    state = start(plan)
    for _ in range(37):
        state = advance(plan, state, Pull(40.0), 2e-4 / 37)
    assert state.gap == pytest.approx(whole.gap, rel=1e-7)
    assert state.cavity.void == pytest.approx(whole.cavity.void, rel=1e-6)


def test_liquid_of_a_given_volume_is_all_still_there():
    """The rim of the film follows from liquid and void: all of the liquid lies within it."""
    volume = math.pi * FACE**2 * 5e-6
    scene = ck.SeparationScene(
        interface=film(volume=volume),
        loading=ck.ImposedForce(initial_gap=5e-6, final_gap=25e-6, force=40.0, mass=0.02),
        effects=(ck.ViscousForce(), limit(1e6, 1e6)),
    )
    result = ck.simulate(ck.plan(scene, ck.Accuracy(time_rtol=1e-8)))
    state, law = result.state, result.plan.film.cavity
    rim, _ = law.rim(state.gap, state.cavity.void)
    edge = state.cavity.fraction * rim
    full = math.pi * (rim - edge) * state.gap
    cavitated = math.pi * edge * state.gap - state.cavity.void
    assert full + cavitated == pytest.approx(volume, rel=1e-12)
    kept = cut(state.cavity.history, state.gap, state.cavity.void)
    assert liquid_within(kept) == pytest.approx(cavitated, rel=1e-9)


def test_work_is_dissipated_or_stored_in_the_void():
    """At a given speed: force times travel is what the flow dissipates, and drop times void."""
    law = CavityLaw(1, FACE**2, math.inf, 0.1, 1e6, 1e6)
    place = lambda t: (5e-6 + 0.04 * t, 0.04)  # noqa: E731
    cavity, flow, done, last = FULL, 0.0, 0.0, 0.0
    for end in np.linspace(0.0, 5e-4, 301)[1:].tolist():
        *_, point = along_path(law, cavity, place, last, end, 1e-9)
        cavity = point.cavity
        shown = shown_cavity(law, cavity, *place(end))
        rim, edge = FACE**2, shown.radius**2
        k = law.conductance(place(end)[0])
        # int k |p'|^2 dA of k r p' = v r^2/2 + C
        log = math.log(rim / edge)
        c = 2.0 * (k * 1e6 - 0.01 * (rim - edge)) / log
        heat = (
            2.0
            * math.pi
            / k
            * (
                0.04**2 * (rim**2 - edge**2) / 16.0
                + 0.5 * 0.04 * c * (rim - edge)
                + 0.5 * c**2 * log
            )
        )
        flow += heat * (end - last)
        done += shown.force * 0.04 * (end - last)
        last = end
    assert done == pytest.approx(flow + 1e6 * cavity.void, rel=1e-2)


def test_an_imposed_speed_shows_its_cavity_and_only_a_film_that_cavitates_has_one():
    loading = ck.ImposedSpeed(initial_gap=5e-6, final_gap=25e-6, speed=0.04)
    scene = ck.SeparationScene(
        interface=film(), loading=loading, effects=(ck.ViscousForce(), limit(1e6, 1e6))
    )
    result = ck.simulate(ck.plan(scene))
    assert result["cavity_radius"][0] > 0.97 * FACE
    assert result["void_volume"][0] == 0.0
    assert np.all(np.diff(result["cavity_radius"]) <= 0.0)
    assert np.all(np.diff(result["void_volume"]) > 0.0)
    trapezium = np.trapezoid(result["viscous_force"], result.time)
    assert result.impulses["viscous_impulse"] == pytest.approx(trapezium, rel=1e-4)
    for effects in ((), (ck.TensionLimit(strength=1e6, cavity="truncated"),)):
        other = ck.SeparationScene(
            interface=film(), loading=loading, effects=(ck.ViscousForce(), *effects)
        )
        with pytest.raises(ck.NotSimulatedError):
            ck.simulate(ck.plan(other))["cavity_radius"]


@pytest.mark.slow
def test_a_vibration_pushes_the_faces_apart_on_the_mean():
    """Cavitated half of the cycle, full the other: rectified, and from cycle to cycle the same."""
    shaken = ck.Vibration(amplitude=2e-6, frequency=1e3)
    loading = ck.ImposedSpeed(initial_gap=10e-6, final_gap=10.005e-6, speed=1e-6, vibration=shaken)
    scene = ck.SeparationScene(
        interface=film(), loading=loading, effects=(ck.ViscousForce(), limit(1e5, 1e5))
    )
    result = ck.simulate(ck.plan(scene))
    assert result["mean_pull"][-1] < -1.0
    assert result["mean_pull"][-1] == pytest.approx(result["mean_pull"][-60], rel=2e-2)
