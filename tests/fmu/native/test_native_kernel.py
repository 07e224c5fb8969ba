"""The C kernel against the Python model: forces, slopes, and the motion with its events."""

from __future__ import annotations

import math

import attrs
import numpy as np
import pytest
from master_cases import film_values
from native_scenes import (
    ANGLES,
    FORCES,
    HAS_CC,
    OIL,
    SCENES,
    SPHERE,
    bare_meniscus,
    probed,
    scene,
)
from selection import quick

pytest.importorskip("pythonfmu")
pytest.importorskip("fmpy")
if not HAS_CC:
    pytest.skip("there is no C compiler", allow_module_level=True)

from contactkit.capillary.exact.bridge import bridge
from contactkit.errors import ConvergenceError
from contactkit.fmu.framework.instance import Instance
from contactkit.fmu.framework.toolchain import local
from contactkit.fmu.native.build import build_native
from contactkit.fmu.native.film import FINE, moving, prepared_film
from contactkit.fmu.native.tables import tabulate
from contactkit.fmu.slaves.stiction_mass import PORTS, MeniscusLaw, scene_of
from contactkit.separation.effects.base import LimitKind
from contactkit.separation.motion.advance import advance
from contactkit.separation.motion.state import Pull, outputs, start
from contactkit.separation.plan import plan


@pytest.fixture(scope="module")
def tables():
    """Tables of the scenes, made once each."""
    made = {}

    def of(name):
        if name not in made:
            made[name] = prepared_film(moving(SCENES[name], None))
        return made[name]

    return of


def kernel_forces(probe, prepared, folder, gaps, speeds, tension=0.0, strength=0.0):
    """Fixed force, its slope, viscous force, its slopes, and the limit."""
    parameters = (OIL.viscosity, OIL.surface_tension, tension, strength)
    return probed(probe, prepared.tables, folder, zip(gaps, speeds, strict=True), parameters)


def slope(function, gap, fraction=4e-4):
    """Central difference of order 6, as a slope by the logarithm of the gap."""
    f = [function(gap * math.exp(k * fraction)) for k in (-3, -2, -1, 1, 2, 3)]
    return (45.0 * (f[3] - f[2]) - 9.0 * (f[4] - f[1]) + f[5] - f[0]) / (60.0 * fraction)


# A table of a solved face has kinks of its curvature, which the finer one of the FMU keeps to 1e-7.
SMOOTH = [name for name in SCENES if name != "tilted"]


@pytest.mark.parametrize("name", quick(SMOOTH, 0, 2, 4, 6, 8, 10, 12))
def test_forces_and_slopes_are_those_of_the_python_model(name, probe, tables, tmp_path):
    scene = moving(SCENES[name], None)
    film = plan(scene, FINE).film
    high = min(0.98 * film.end, 0.98 * film.release, 2.0 * scene.loading.final_gap)
    gaps = np.geomspace(1.1 * tables(name).lowest, high, 301).tolist()
    speeds = np.linspace(-1e-3, 1.0, 301).tolist()
    limits = {effect.name: effect for effect in scene.effects}
    tension = getattr(limits.get("tension-limit"), "tension", 0.0)
    strength = getattr(limits.get("shear-limit"), "strength", 0.0)
    fixed, fixed_slope, viscous, _, _, _ = kernel_forces(
        probe, tables(name), tmp_path, gaps, speeds, tension, strength
    )
    expected = np.array([film.static_force(gap) for gap in gaps])
    nothing = 1e-12 * np.max(np.abs(expected))  # the tail of a bell curve is not followed further
    of_speed = [film.viscous_force(gap, speed)[0] for gap, speed in zip(gaps, speeds, strict=True)]
    np.testing.assert_allclose(fixed, expected, rtol=1e-10, atol=nothing)
    np.testing.assert_allclose(viscous, of_speed, rtol=1e-10)
    smooth = [all(abs(gap / kink - 1.0) > 3e-3 for kink in film.kinks) for gap in gaps]
    differences = np.array([slope(film.static_force, gap) for gap in gaps])
    size = np.abs(expected) + np.abs(differences) + nothing
    assert np.max((np.abs(fixed_slope * gaps - differences) / size)[smooth]) < 1e-9
    _, _, viscous, by_gap, by_speed, _ = kernel_forces(probe, tables(name), tmp_path, gaps, speeds)
    resistance = np.array([film.damping(gap) for gap in gaps])
    np.testing.assert_allclose(by_speed, resistance, rtol=1e-10)
    differences = np.array([slope(film.damping, gap) for gap in gaps]) * speeds
    wrong = np.abs(by_gap * gaps - differences) - 1e-9 * np.abs(viscous)
    assert np.max(wrong[smooth]) <= 0.0


def test_a_scene_is_planned_once(monkeypatch):
    """Though the bridge ends beyond its final gap, up to which the tables go on."""
    from contactkit.separation.effects import meniscus

    solved, final = [], 8e-6
    law = meniscus.exact_law
    monkeypatch.setattr(meniscus, "exact_law", lambda *given: solved.append(given) or law(*given))
    made = moving(
        attrs.evolve(SCENES["drop"], loading=attrs.evolve(SCENES["drop"].loading, final_gap=final)),
        None,
    )
    assert prepared_film(made).prepared.scene == made
    assert len(solved) == 1
    assert plan(made).film.end > final


@pytest.mark.parametrize(
    "degrees",
    [pytest.param(a, id=str(a), marks=[pytest.mark.slow] * (a[0] == 179.9)) for a in ANGLES],
)
def test_a_meniscus_is_the_bridge_solved_at_every_gap_up_to_its_end(degrees, probe, tmp_path):
    """Values and slopes, by a solver that knows no table; next to the end the gap has no digits."""
    scene = moving(bare_meniscus(*degrees), None)
    made, end = prepared_film(scene), plan(scene, FINE).film.end
    left = np.concatenate((np.geomspace(2e-5, 0.5, 60), 1.0 - np.geomspace(1e-3, 0.5, 30)))
    gaps = end * (1.0 - left)
    found = kernel_forces(probe, made, tmp_path, gaps.tolist(), [0.0] * gaps.size)
    state = bridge(gaps, 1e-12, *map(math.radians, degrees))
    force, slope = (OIL.surface_tension * value for value in (state.force, gaps * state.stiffness))
    size = np.abs(force) + np.abs(slope)
    assert np.max(np.abs(found[0] - force) / size) < 1e-10
    wrong = np.abs(found[1] * gaps - slope) / size
    assert np.max(wrong[left > 1e-3]) < 1e-9
    assert np.max(wrong) < 1e-7


@pytest.mark.parametrize("name", ["stieber", "shear", "sphere"])
def test_slopes_of_limited_forces_are_those_of_the_force(name, probe, tables, tmp_path):
    scene = moving(SCENES[name], None)
    film = plan(scene, FINE).film
    gap = 2.0 * scene.loading.initial_gap
    speeds = np.geomspace(1e-3, 1.0, 9)
    tension, strength = (
        (0.0, 1e5) if name == "shear" else (1e5 if name == "stieber" else 101325.0, 0.0)
    )
    found = kernel_forces(
        probe, tables(name), tmp_path, [gap] * 9, speeds.tolist(), tension, strength
    )
    assert found[5].max() == (LimitKind.SHEAR if name == "shear" else LimitKind.TENSION)
    for speed, by_gap, by_speed in zip(speeds.tolist(), found[3], found[4], strict=True):
        expected = slope(lambda h, v=speed: film.viscous_force(h, v)[0], gap) / gap
        assert by_gap == pytest.approx(expected, rel=1e-7)
        expected = slope(lambda v: film.viscous_force(gap, v)[0], speed) / speed
        assert by_speed == pytest.approx(expected, rel=1e-7, abs=1e-9 * found[2].max() / speed)


@pytest.mark.parametrize(("tension", "strength"), [(0.0, 3e3), (0.0, 1e5), (2e4, 1e4)])
@pytest.mark.parametrize("ratio", [1.2, 5.0, 60.0])
def test_slopes_under_a_sphere_are_differences_of_the_kernel_itself(
    tension, strength, ratio, probe, tables, tmp_path
):
    """With a limiting shear strength, which the scenes do not have under a sphere."""
    gap, fraction = ratio * SCENES["sphere"].loading.initial_gap, 1e-4
    places = (-2, -1, 1, 2)
    for speed in (-0.3, 1e-3, 0.3):
        gaps = [gap] + [gap * (1.0 + k * fraction) for k in places] + [gap] * 4
        speeds = [speed] * 5 + [speed * (1.0 + k * fraction) for k in places]
        found = kernel_forces(probe, tables("sphere"), tmp_path, gaps, speeds, tension, strength)
        if len(set(found[5])) > 1:
            continue  # the limit sets in within the difference
        weights = np.array([1.0, -8.0, 8.0, -1.0]) / (12.0 * fraction)
        size = abs(found[2][0])
        assert found[3][0] * gap == pytest.approx(weights @ found[2][1:5], abs=3e-7 * size)
        assert found[4][0] * speed == pytest.approx(weights @ found[2][5:], abs=3e-7 * size)


MOTIONS = {
    "flooded": ([40.0] * 50 + [-40.0] * 100, 1e-5, {"h_min": 1e-6}),
    "drop": ([40.0] * 26, 5e-4, {}),
    "unequal angles": ([40.0] * 60, 1e-5, {}),
    "repelled, many": ([40.0] * 30, 2e-4, {}),
    "sphere": ([1e-3] * 30 + [-1e-3] * 30, 1e-4, {"h_min": 5e-8}),
    "rewetting": (([40.0] * 60 + [-40.0] * 60) * 2, 2e-5, {}),
    "solids": ([40.0] * 20, 5e-2, {}),
    "stieber": ([40.0] * 40, 2e-5, {}),
    "shear": ([40.0] * 20, 2e-4, {}),
    "humid tip": ([1e-5] * 5, 1e-6, {}),
    "tip that sticks": ([2e-6] * 10, 1e-6, {}),
    "rough": ([0.1] * 10, 1e-5, {}),
    "ring": ([40.0] * 30, 1e-3, {}),
    "tilted": ([40.0] * 30, 1e-4, {}),
}


QUICK = ("rewetting", "sphere", "shear")


@pytest.mark.parametrize("name", quick(MOTIONS, *map([*MOTIONS].index, QUICK)))
def test_motion_is_that_of_the_python_model(name, tmp_path):
    """Rupture, release, rest, re-wetting and limits come at the same times."""
    pulls, step, given = MOTIONS[name]
    scene = SCENES[name]
    path = build_native(
        scene,
        tmp_path / "film.fmu",
        platforms=[local()],
        compiler="cc",
        start=given | {"rtol": 1e-8},
    )
    loading = attrs.evolve(scene.loading, rest_gap=given.get("h_min", scene.loading.rest_gap))
    prepared = plan(moving(attrs.evolve(scene, loading=loading), None), FINE)
    # The laws behind the tables are finer than those of the tolerance of the motion.
    accuracy = attrs.evolve(FINE, time_rtol=1e-8)
    prepared = attrs.evolve(prepared, prepared=attrs.evolve(prepared.prepared, accuracy=accuracy))
    state = start(prepared)
    with Instance(path) as host:
        host.start({}, 1.0)
        pull, time = host.references("F_ext"), 0.0
        for force in pulls:
            host.set(pull, [force])
            host.step(time, step)
            state = advance(prepared, state._replace(time=time), Pull(force), step)
            time += step
            found = dict(zip(host.names, host.outputs(), strict=True))
            forces = outputs(prepared, state, force)
            assert found["h"] == pytest.approx(state.gap, rel=1e-6)
            assert found["F"] == pytest.approx(forces.film, rel=1e-6, abs=1e-6 * abs(force))
            assert found["J"] == pytest.approx(state.impulses.get("viscous_impulse", 0.0), rel=1e-7)
            assert found["W"] == pytest.approx(state.dissipated_work, rel=1e-7)
            assert found["F_peak"] == pytest.approx(state.peak_force, rel=1e-6)
            assert found["t_release"] == pytest.approx(state.release_time, rel=1e-7)
            assert found["t_break"] == pytest.approx(state.break_time, rel=1e-7)
            assert found["n_break"] == state.n_breaks
            assert found["n_release"] == state.n_releases
            assert (found["state"], found["limit"]) == (forces.status, forces.limit)
    assert name in ("flooded", "shear") or state.n_breaks or state.n_releases


@pytest.mark.slow
def test_a_meniscus_is_known_up_to_its_end(tmp_path):
    """Beyond the gap of its release a mass goes on, under a sphere up to a rupture."""
    found = []
    for final in (2.5e-7, 3e-5):
        given = SPHERE | {"final": final, "angles": (0.5, 0.7), "effects": FORCES}
        path = build_native(scene(**given), tmp_path / "x.fmu", platforms=[local()], compiler="cc")
        with Instance(path) as host:
            host.start({"k_s": 0.0}, 1.0)
            host.set(host.references("F_ext"), [1e-3])
            host.step(0.0, 5e-3)
            found.append(host.get(host.references("h", "F_m", "J_m")))
    assert found[0] == pytest.approx(found[1], rel=1e-7)
    assert 6e-7 < found[0][0] < 1e-3


def test_a_table_of_a_power_has_two_nodes():
    table = tabulate(lambda gap: 3.0 * gap**-5, (1e-8, 1e-6, 1e-4))
    assert [(piece.power, len(piece.x)) for piece in table.pieces] == [(5, 2), (5, 2)]


def test_a_fold_is_followed_to_its_end():
    """A force that ends with an infinite slope is smooth in the coordinate of the table."""
    table = tabulate(lambda gap: 1.0 + np.sqrt(1e-4 - gap), (1e-8, 1e-4), folds=(1e-4,), stays=True)
    piece = table.pieces[0]
    assert piece.x[0] == 0.0
    assert piece.y[0] == pytest.approx(1.0, abs=1e-11)


@pytest.mark.parametrize(
    ("function", "message"),
    [
        (lambda gap: abs(gap - 3e-5), r"too rough for a table: .*put edges where its slope jumps"),
        (lambda gap: float("nan"), r"no finite number somewhere .*; end the table before"),
    ],
)
def test_what_cannot_be_tabulated_names_a_cure(function, message):
    with pytest.raises(ConvergenceError, match=message):
        tabulate(function, (1e-8, 1e-4))


@pytest.mark.parametrize("name", ["A", "D"])
@pytest.mark.parametrize("steps", [1, 300])
def test_releases_come_at_the_reference_times(name, steps, release_cases, tmp_path):
    """Times of two other codes, whatever the number of communication steps."""
    case, values = release_cases[name]["case"], release_cases[name]["values"]
    film = {port.name: port.start for port in PORTS} | film_values(case)
    film |= {"meniscus_law": MeniscusLaw.PUBLISHED, "m": case["m"], "k_s": case["k_s"]}
    made = scene_of(film | {"h_rel": case["h_rel"]})
    path = build_native(made, tmp_path / "x.fmu", platforms=[local()], compiler="cc")
    length = 1.2 * values["t_rel"] / steps
    with Instance(path) as host:
        host.start({}, 10.0)
        host.set(host.references("F_ext"), [case["F0"]])
        for i in range(steps):
            host.step(i * length, length)
        found = host.get(host.references("t_release"))[0]
    assert found == pytest.approx(values["t_rel"], rel=5e-10)
