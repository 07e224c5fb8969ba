"""Studies: the numbers of single solves, in order, kept as they come, whoever solves them."""

from __future__ import annotations

import contextlib
import csv
import itertools
import json
import math
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
from selection import quick

import contactkit as ck
from contactkit.contact import chain, prepared
from contactkit.studies import run as study_run
from contactkit.studies.study import StudyPoint, check_study

pytestmark = pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning")

ACCURACY = ck.Accuracy(grid=32, rtol=1e-9)
PRESSURES = [2e7, 4e7, 8e7, 1.6e8]
THICKNESS = "interface.lower.solid.layers.0.thickness"
FRICTION = "effects.friction-traction.coefficient"


def contact(*effects, pressure=1e7, **upper):
    steel = ck.Material(name="steel", young_modulus=210e9, poisson_ratio=0.3, hardness=7e9)
    dlc = ck.Material(name="DLC", young_modulus=280e9, poisson_ratio=0.25, hardness=24e9)
    rough = ck.GaussianRoughness(rms=1e-9, correlation_length=3e-7, cutoff=1.25e-7)
    return ck.ContactScene(
        interface=ck.Interface(
            lower=ck.Body(
                solid=ck.Stack(layers=(ck.Layer(material=dlc, thickness=2e-8),), substrate=steel)
            ),
            upper=ck.Body(**{"surface": rough} | upper),
        ),
        window=ck.Window(width=1e-6),
        loading=ck.Pressing(pressure=pressure),
        effects=(ck.LayeredHalfSpace(), *effects),
    )


def single(scene, accuracy=ACCURACY):
    return ck.solve(ck.plan(scene, accuracy))


def same(one, other, rtol=1e-6):
    """Whether two studies have the same points in the same order, to the tolerance of a solve."""
    for name in one.units:
        if name == "seconds" or name.startswith("n_") or name in ("residual", "energy"):
            continue
        assert list(one.column(name)) == pytest.approx(
            list(other.column(name)), rel=rtol, nan_ok=True
        ), name
    assert [p.status for p in one.points] == [p.status for p in other.points]
    return True


# What is solved -----------------------------------------------------------------------------


def test_each_point_is_the_contact_that_its_values_describe():
    study = ck.study(contact(), {"loading.pressure": PRESSURES}, ACCURACY)
    alone = [single(contact(pressure=p)) for p in PRESSURES]
    assert study.column("contact_area") == pytest.approx([r.contact_area for r in alone], rel=1e-9)
    assert study.column("max_pressure") == pytest.approx([r.max_pressure for r in alone], rel=1e-5)
    assert study.column("loading.pressure").tolist() == PRESSURES
    assert study.unit("loading.pressure") == "Pa"
    assert study.unit("contact_area") == "m2"
    assert all(isinstance(p, StudyPoint) and p.seconds > 0.0 for p in study.points)
    assert (study.column("n_operator_applications") > 0).all()
    assert study.points[0].n_operator_applications == study.column("n_operator_applications")[0]


def test_the_last_thing_varied_varies_fastest():
    study = ck.study(
        contact(ck.FrictionTraction(coefficient=0.1)),
        {THICKNESS: ["10 nm", 4e-8], FRICTION: [0.1, 0.2], "loading.pressure": ["10 MPa", 4e7]},
        ACCURACY,
    )
    wanted = list(itertools.product([1e-8, 4e-8], [0.1, 0.2], [1e7, 4e7]))
    assert [tuple(p.values.values()) for p in study.points] == wanted
    assert study.shape == (2, 2, 2)
    friction = study.column("friction_force").reshape(study.shape)
    assert friction == pytest.approx(np.array([[[0.1e-5, 0.4e-5], [0.2e-5, 0.8e-5]]] * 2), rel=1e-9)


def test_a_chain_prepares_its_interface_once(monkeypatch):
    made, solver = [], prepared.ContactSolver

    def counted(*arguments, **named):
        made.append(arguments)
        return solver(*arguments, **named)

    monkeypatch.setattr(prepared, "ContactSolver", counted)
    vary = {THICKNESS: [1e-8, 2e-8], "loading.pressure": PRESSURES}
    study = ck.study(contact(), vary, ACCURACY)
    assert len(made) == 2
    assert len(study.points) == 8


def test_a_chain_starts_from_its_neighbour(monkeypatch):
    """Not over a point without an answer, nor where the grid is another one."""
    starts = []

    def solve(plan, *, start):
        starts.append(start[0].mean_pressure if start else None)
        return ck.solve(plan, start=start)

    monkeypatch.setattr(chain, "solve_unwarned", solve)
    scene = contact(ck.HardnessLimit(rule="material"))
    ck.study(scene, {THICKNESS: [1e-8, 2e-8], "loading.pressure": [1e8, 3e10, 2e8]}, ACCURACY)
    assert starts == pytest.approx([None, 2e8] * 2)  # loads downwards
    starts.clear()
    ck.study(scene, {"accuracy.grid": [16, 32, (32, 32)]}, ck.Accuracy.draft)
    assert starts == pytest.approx([None, None, 1e7])


def test_materials_surfaces_and_settings_may_be_varied():
    steel = ck.Material(name="steel", young_modulus=210e9, poisson_ratio=0.3)
    study = ck.study(
        contact(),
        {
            "interface.lower.solid": ["ni-p", steel],
            "interface.upper.surface.seed": [1, 2],
            "accuracy.grid": [32, (16, 32)],
            "accuracy.rtol": [1e-6, 1e-8],
        },
    )
    assert study.column("interface.lower.solid")[[0, -1]].tolist() == [
        ck.load_material("ni-p"),
        steel,
    ]
    fractions = study.column("contact_fraction").reshape(study.shape)
    assert fractions[..., 0] == pytest.approx(fractions[..., 1], rel=1e-9)  # of both tolerances
    assert (fractions[:, 0] != fractions[:, 1]).all()  # of two surfaces
    assert "Ni-P" in study.table()
    assert "steel" in study.table("contact_area")


def test_values_that_belong_together_are_set_together():
    """A cut-off above the old roll-off is no mistake where the roll-off moves too."""
    rough = ck.SelfAffineRoughness(rms=1e-9, hurst=0.8, rolloff=2e-7, cutoff=1e-7)
    scene = contact(surface=rough)
    surface = "interface.upper.surface"
    vary = {f"{surface}.cutoff": [3e-7], f"{surface}.rolloff": [5e-7]}
    study = ck.study(scene, vary, ACCURACY, keep_maps=True)
    assert study.results[0].plan.scene.interface.upper.surface.rolloff == 5e-7


def test_paths_that_vary_together_may_be_a_tuple(film_scene):
    keys = ("loading.initial_gap", "loading.speed")
    rows = [(4e-6, 1e-8), ("5 um", "20 nm/s")]
    given = film_scene(ck.ViscousForce())
    study, of_text = (
        ck.study(given, {key: rows}, ck.Accuracy.draft) for key in (keys, ", ".join(keys))
    )
    assert study.paths == of_text.paths == (keys,)
    assert [tuple(p.values.values()) for p in study.points] == [(4e-6, 1e-8), (5e-6, 2e-8)]
    np.testing.assert_array_equal(study.column("peak_force"), of_text.column("peak_force"))
    assert ck.plan_study(given, {keys: rows}, ck.Accuracy.draft, trials=1).n_points == 2


def test_a_separation_may_be_studied_too(film_scene):
    viscous = ck.ViscousForce()
    study = ck.study(film_scene(viscous), {"loading.speed": ["10 nm/s", 2e-8]}, ck.Accuracy.draft)
    scenes = [film_scene(viscous, speed=v) for v in (1e-8, 2e-8)]
    alone = [ck.simulate(ck.plan(scene, ck.Accuracy.draft)) for scene in scenes]
    wanted = [r.scalars()["peak_force"][0] for r in alone]
    assert study.column("peak_force") == pytest.approx(wanted, rel=1e-12)
    assert wanted[0] != wanted[1]
    assert [p.status for p in study.points] == ["curve", "curve"]
    assert study.points[0].n_operator_applications == 0


def test_results_are_kept_when_asked_for():
    study = ck.study(contact(), {"loading.pressure": PRESSURES[:2]}, ACCURACY, keep_maps=True)
    for point, result in zip(study.points, study.results, strict=True):
        assert result.load == pytest.approx(point.scalars["load"][0], rel=1e-12)
        assert result.pressure.shape == (32, 32)
    without = ck.study(contact(), {"loading.pressure": PRESSURES[:1]}, ACCURACY)
    with pytest.raises(ck.NotSimulatedError, match="keep_maps=True"):
        _ = without.results


# Points without an answer -------------------------------------------------------------------


def test_a_point_without_an_answer_stops_nothing():
    scene = contact(ck.HardnessLimit(rule="material"))
    study = ck.study(scene, {"loading.pressure": [1e7, 3e10, 4e7]}, ACCURACY, keep_maps=True)
    assert [p.status for p in study.points] == ["converged", "infeasible", "converged"]
    assert "reaches H*A" in study.points[1].message
    assert study.failed == (study.points[1],)
    assert study.results[1] is None
    area = study.column("contact_area")
    assert math.isnan(area[1])
    assert area[0] < area[2]
    assert set(study.points[1].scalars) == set(study.points[0].scalars)
    assert "point 1: load" in study.table()


def test_a_solve_that_gives_up_is_reported(film_scene):
    scene = film_scene(ck.ViscousForce(), force=1.0, mass=1e-3)
    study = ck.study(scene, {"accuracy.max_steps": [3, 100_000]}, ck.Accuracy.draft)
    assert [p.status for p in study.points] == ["not converged", "released"]
    assert "raise Accuracy.max_steps" in study.points[0].message
    assert math.isnan(study.column("release_time")[0])
    assert study.column("release_time")[1] > 0.0


def test_a_warning_of_a_model_is_given_once_and_noted(film_scene):
    scene = film_scene(ck.ViscousForce(), ck.MeniscusForce(), film={"volume": 3e-12})
    with pytest.warns(ck.ValidityWarning, match=r"2 of 2 points .*viscous over capillary") as seen:
        study = ck.study(scene, {"loading.speed": [1.0, 2.0]}, ck.Accuracy.draft)
    assert len(seen) == 1
    assert all("ValidityWarning" in p.notes[0] for p in study.points)


# Files --------------------------------------------------------------------------------------


def test_a_table_has_units_and_a_file_has_everything(tmp_path):
    study = ck.study(contact(), {"loading.pressure": PRESSURES[:2]}, ACCURACY)
    table = study.table("contact_fraction")
    assert table.splitlines()[0].split() == [
        "pressure",
        "[Pa]",
        "contact_fraction",
        "[-]",
        "status",
    ]
    rows = [line for line in table.splitlines()[1:] if line.endswith("converged")]
    assert len(rows) == 2
    # The numbers out of range, once for all points: waves, spots.
    assert [line.partition(" = ")[0] for line in table.splitlines()[3:]] == [
        f"point 0 and 1 more: ValidityWarning: {name}"
        for name in (
            "pixels per shortest wave",
            "pixels across a contact spot",
            "layer thickness over pixel",
        )
    ]
    with study.save_csv(tmp_path / "study").open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    assert float(rows[1]["contact_area [m2]"]) == pytest.approx(study.column("contact_area")[1])
    assert rows[0]["status"] == "converged"
    assert [path.name for path in tmp_path.iterdir()] == ["study.csv"]


def test_a_finished_point_is_not_solved_again(tmp_path):
    first = ck.study(contact(), {"loading.pressure": PRESSURES[:2]}, ACCURACY, store=tmp_path)
    fractions = []
    study = ck.study(
        contact(),
        {"loading.pressure": PRESSURES},
        ACCURACY,
        store=tmp_path,
        progress=fractions.append,
    )
    assert (first.n_solved, study.n_solved) == (2, 2)
    assert fractions == [0.5, 0.75, 1.0]
    assert study.column("energy")[:2].tolist() == first.column("energy").tolist()  # to the bit
    assert "2 points from the store" in study.table()
    again = ck.study(contact(), {"loading.pressure": PRESSURES}, ACCURACY, store=tmp_path)
    assert again.n_solved == 0
    assert same(again, study, rtol=0.0)


def test_the_store_distinguishes_scenes_and_settings(tmp_path):
    vary = {"loading.pressure": PRESSURES[:1]}
    ck.study(contact(), vary, ACCURACY, store=tmp_path)
    finer = ck.study(contact(), vary, ck.Accuracy(grid=32, rtol=1e-8), store=tmp_path)
    other = ck.study(contact(ck.FrictionTraction(coefficient=0.1)), vary, ACCURACY, store=tmp_path)
    assert (finer.n_solved, other.n_solved) == (1, 1)
    assert ck.study(contact(), vary, ACCURACY, store=tmp_path).n_solved == 0


def test_the_store_sees_that_a_height_map_has_changed(tmp_path):
    rng = np.random.default_rng(1)
    path, store = tmp_path / "map.npy", tmp_path / "store"
    scene = contact(surface=ck.Measured(path=str(path), pixel_size=1e-6 / 16, unit="m"))
    np.save(path, 1e-9 * rng.standard_normal((16, 16)))
    vary, accuracy = {"loading.pressure": [1e8]}, ck.Accuracy(rtol=1e-6)
    assert ck.study(scene, vary, accuracy, store=store).n_solved == 1
    assert ck.study(scene, vary, accuracy, store=store).n_solved == 0
    np.save(path, 2e-9 * rng.standard_normal((16, 16)))
    assert ck.study(scene, vary, accuracy, store=store).n_solved == 1


def test_arrays_in_hand_are_distinguished_by_their_content(tmp_path):
    heights = 1e-9 * np.random.default_rng(2).standard_normal((16, 16))
    vary, accuracy = {"loading.pressure": [1e8]}, ck.Accuracy(rtol=1e-6)

    def solved(factor):
        surface = ck.Heights(heights=factor * heights, pixel_size=1e-6 / 16)
        return ck.study(contact(surface=surface), vary, accuracy, store=tmp_path).n_solved

    assert [solved(1.0), solved(1.0), solved(2.0)] == [1, 0, 1]


def test_maps_come_back_from_the_store(tmp_path):
    vary = {"loading.pressure": PRESSURES[:2]}
    ck.study(contact(), vary, ACCURACY, store=tmp_path)
    first = ck.study(contact(), vary, ACCURACY, store=tmp_path, keep_maps=True)
    assert first.n_solved == 2  # the run before kept none
    again = ck.study(contact(), vary, ACCURACY, store=tmp_path, keep_maps=True)
    assert again.n_solved == 0
    for one, other in zip(first.results, again.results, strict=True):
        assert (one.pressure == other.pressure).all()


@pytest.mark.parametrize("suffix", ["json", "npz"])
def test_a_damaged_file_is_solved_again_and_said_so(tmp_path, suffix):
    vary = {"loading.pressure": PRESSURES[:2]}
    whole = ck.study(contact(), vary, ACCURACY, store=tmp_path, keep_maps=True)
    damaged = next(tmp_path.glob(f"*.{suffix}"))
    damaged.write_bytes(damaged.read_bytes()[:-200])
    study = ck.study(contact(), vary, ACCURACY, store=tmp_path, keep_maps=True)
    assert study.n_solved == 1
    assert same(study, whole)
    (solved,) = [p for p in study.points if not p.is_from_store]
    assert "solved again" in solved.notes[-1]
    assert "solved again" in study.table()
    assert ck.study(contact(), vary, ACCURACY, store=tmp_path, keep_maps=True).n_solved == 0


def test_a_point_that_was_refused_is_tried_again(tmp_path):
    """Its cure may lie outside the scene, such as a file that was not there."""
    vary = {"interface.upper.surface.cutoff": [1e-8, 1.25e-7]}  # the first below two pixels
    study = ck.study(contact(), vary, ACCURACY, store=tmp_path)
    assert [p.status for p in study.points] == ["refused", "converged"]
    assert "be at least two pixels" in study.points[0].message
    assert ck.study(contact(), vary, ACCURACY, store=tmp_path).n_solved == 1


# Workers ------------------------------------------------------------------------------------


@pytest.mark.slow
def test_workers_change_nothing(tmp_path):
    """One chain in two pieces, with a point that has no answer; progress by points."""
    scene = contact(ck.HardnessLimit(rule="material"))
    vary, fractions = {"loading.pressure": [1e7, 2e7, 3e10, 4e7]}, []
    one = ck.study(scene, vary, ACCURACY)
    two = ck.study(
        scene, vary, ACCURACY, workers=2, progress=fractions.append, keep_maps=True, store=tmp_path
    )
    assert same(one, two)
    assert fractions == [0.25, 0.5, 0.75, 1.0]
    assert two.results[3].load == pytest.approx(4e-5)
    assert ck.study(scene, vary, ACCURACY, store=tmp_path, keep_maps=True).n_solved == 0


def test_workers_begin_with_one_thread_each(monkeypatch):
    monkeypatch.setenv("OMP_NUM_THREADS", "7")
    monkeypatch.delenv("MKL_NUM_THREADS", raising=False)
    with study_run.one_thread():
        assert os.environ["OMP_NUM_THREADS"] == os.environ["MKL_NUM_THREADS"] == "1"
    assert os.environ["OMP_NUM_THREADS"] == "7"
    assert "MKL_NUM_THREADS" not in os.environ


def test_chains_are_spread_and_cut():
    from contactkit.studies.paths import axes
    from contactkit.studies.study import _Run

    def lengths(slots, **vary):
        varied = axes(contact(), ACCURACY, {k.replace("_", "."): v for k, v in vary.items()})
        pieces = _Run(contact(), ACCURACY, varied, None, False, None).pieces(slots)
        places = [t.place for p in pieces for t in p.tasks]
        assert sorted(places) == list(range(len(places)))
        for piece in pieces:  # loads downwards
            assert [t.place for t in piece.tasks] == sorted(
                (t.place for t in piece.tasks), reverse=True
            )
        return [len(p.tasks) for p in pieces]

    many = {"window_width": [1e-6, 2e-6, 3e-6], "loading_pressure": PRESSURES}
    assert lengths(1, **many) == lengths(2, **many) == lengths(3, **many) == [4, 4, 4]
    assert lengths(5, **many) == [2] * 6
    assert lengths(3, loading_pressure=PRESSURES) == [1, 1, 2]
    assert lengths(9, loading_pressure=PRESSURES) == [1] * 4


# Interruption -------------------------------------------------------------------------------

SLOW = """
import os, signal, sys, time
sys.path[:0] = sys.argv[1].split(os.pathsep)
import test_studies
from contactkit.contact import prepared
from contactkit.studies import run as study_run

# A job in the background of a shell is started deaf to it.
signal.signal(signal.SIGINT, signal.default_int_handler)
put = study_run.put

def slowly(*arguments):
    point = put(*arguments)
    time.sleep(0.3)
    return point

study_run.put = slowly  # here and in the workers, which run this file too
if __name__ == "__main__":
    test_studies.whole(sys.argv[2], int(sys.argv[3]))
"""
MANY = {THICKNESS: [1e-8, 2e-8], "loading.pressure": [1e7 * 1.3**i for i in range(10)]}


def whole(store, workers=1):
    return ck.study(contact(), MANY, ACCURACY, store=store, workers=workers, keep_maps=True)


@pytest.mark.parametrize(
    ("workers", "how"), quick([(1, signal.SIGINT), (2, signal.SIGKILL)], long=[1])
)
def test_an_interrupted_study_goes_on_where_it_stopped(tmp_path, workers, how):
    script, store = tmp_path / "slow.py", tmp_path / "store"
    script.write_text(SLOW, encoding="utf-8")
    here = os.pathsep.join(map(str, Path(__file__).parents[:2]))
    running = subprocess.Popen(
        [sys.executable, str(script), here, str(store), str(workers)],
        stderr=subprocess.DEVNULL,
        start_new_session=True,
    )
    try:
        until(lambda: len(list(store.glob("[!.]*.json"))) >= 2 or running.poll() is not None)
        running.send_signal(how)
        running.wait(timeout=30)
    finally:
        ended(running)
    found = {path: path.stat().st_mtime_ns for path in store.glob("[!.]*.json")}
    assert 2 <= len(found) < 20
    for path in store.glob("[!.]*"):  # no half file
        if path.suffix == ".json":
            assert json.loads(path.read_text(encoding="utf-8"))["status"] == "converged"
        else:
            assert ck.load_result(path).status == "converged"
    study = whole(store)
    assert study.n_solved == 20 - len(found)
    assert {path: path.stat().st_mtime_ns for path in found} == found
    assert same(study, reference())


REFERENCE = []


def reference():
    """The same study in one go, made once."""
    if not REFERENCE:
        REFERENCE.append(ck.study(contact(), MANY, ACCURACY))
    return REFERENCE[0]


def until(true, seconds=60.0):
    end = time.monotonic() + seconds
    while not true():
        assert time.monotonic() < end
        time.sleep(0.02)


def ended(study):
    """See to it that nobody writes any more: what the workers of a killed study are at is lost."""
    with contextlib.suppress(ProcessLookupError):
        os.killpg(study.pid, signal.SIGKILL)


def test_an_interruption_reaches_the_caller(tmp_path):
    def stop(fraction):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        ck.study(
            contact(), {"loading.pressure": PRESSURES}, ACCURACY, store=tmp_path, progress=stop
        )
    assert (
        ck.study(contact(), {"loading.pressure": PRESSURES}, ACCURACY, store=tmp_path).n_solved
        == len(PRESSURES) - 1
    )


def test_a_point_is_written_whole_or_not_at_all(tmp_path, monkeypatch):
    def half(path, text, **_):
        path.write_bytes(text.encode()[:20])
        raise OSError("disk full")

    monkeypatch.setattr(Path, "write_text", half)
    vary = {"loading.pressure": PRESSURES[:1]}
    found = ck.study(contact(), vary, ACCURACY, store=tmp_path)
    assert list(tmp_path.iterdir()) == []
    # What was solved is not lost with its file.
    assert found.points[0].status == "converged"
    assert found.points[0].notes.count("not stored: disk full") == 1


def test_what_a_killed_run_left_half_written_is_swept_away(tmp_path):
    old, new = tmp_path / f".{'0' * 40}-12345678.json", tmp_path / f".{'1' * 40}-12345678.npz"
    for path in (old, new):
        path.write_text("half of")
    os.utime(old, (1.0, 1.0))
    ck.study(contact(), {"loading.pressure": PRESSURES[:1]}, ACCURACY, store=tmp_path)
    assert not old.exists()
    assert new.exists()


# Parameters that vary together, names and lines -----------------------------------------------

PAIR = "effects.friction-traction.coefficient, interface.upper.surface.seed"


def test_paths_that_vary_together_are_one_parameter():
    scene = contact(ck.FrictionTraction(coefficient=0.1))
    vary = {PAIR: [(0.1, 1), [0.2, 2], (0.3, 3)], "loading.pressure": PRESSURES[:2]}
    study = ck.study(scene, vary, ACCURACY)
    friction, seed = PAIR.split(", ")
    assert study.shape == (3, 2)
    assert study.paths == ((friction, seed), ("loading.pressure",))
    assert study.column(friction).tolist() == [0.1, 0.1, 0.2, 0.2, 0.3, 0.3]
    assert study.column(seed).tolist() == [1, 1, 2, 2, 3, 3]
    alone = single(contact(ck.FrictionTraction(coefficient=0.3), surface=rough(3), pressure=4e7))
    assert study.column("contact_area")[-1] == pytest.approx(alone.contact_area, rel=1e-6)


def rough(seed):
    return ck.GaussianRoughness(rms=1e-9, correlation_length=3e-7, cutoff=1.25e-7, seed=seed)


@pytest.mark.parametrize(
    ("vary", "message"),
    [
        ({PAIR: [0.1, 0.2]}, "must be a row of 2 values"),
        ({PAIR: [(0.1, 1, 2)]}, "must be a row of 2 values"),
        ({f"{FRICTION}, {FRICTION}": [(0.1, 0.2)]}, "be given once"),
        ({FRICTION: [0.1], PAIR: [(0.1, 2)]}, "be given once"),
        ({f"{FRICTION}, loading.presure": [(0.1, 1e6)]}, r"did you mean 'loading\.pressure'"),
        ({f"loading, {FRICTION}, loading.pressure": [(1, 2, 3)]}, "not lie inside 'loading'"),
    ],
)
def test_rows_that_do_not_fit_their_paths(vary, message):
    scene = contact(ck.FrictionTraction(coefficient=0.1))
    with pytest.raises(ck.DescriptionError, match=message):
        ck.study(scene, vary, ACCURACY)
    with pytest.raises(ck.DescriptionError, match=message):
        check_study(scene, vary, ACCURACY)


SOLIDS = "interface.lower.solid, interface.upper.solid"


def stacks():
    layers = tuple(
        ck.Layer(material=ck.load_material(name), thickness=d)
        for name, d in (("dlc", 5e-9), ("co-cr", 25e-9), ("ni-p", 10e-6))
    )
    named = ck.Stack(name="structure I", layers=layers[:1], substrate=ck.load_material("al-mg"))
    return named, ck.Stack(layers=layers, substrate=ck.load_material("al-mg"))


def test_columns_of_solids_are_short():
    named, plain = stacks()
    study = ck.study(contact(), {SOLIDS: [(named, "ni-p"), (plain, named)]}, ACCURACY)
    lines = study.table("contact_fraction").splitlines()
    assert lines[0].split()[:4] == ["lower.solid", "[-]", "upper.solid", "[-]"]
    assert "structure I" in lines[1]
    assert "Ni-P" in lines[1] or "nickel" in lines[1]
    assert max(map(len, lines[:3])) < 160
    assert plain.label.startswith("diamond-like carbon 5e-09 m / ")


def test_a_load_curve_is_a_line_for_each_combination(tmp_path):
    named, plain = stacks()
    vary = {
        "loading.pressure": PRESSURES[:3],
        "interface.lower.solid": [named, plain],
        "interface.upper.surface.seed": [1, 2],
    }
    study = ck.study(contact(), vary, ACCURACY)
    lines = study.lines("loading")
    assert [line.label for line in lines] == [
        f"{stack.label}, seed {seed}" for stack in (named, plain) for seed in (1, 2)
    ]
    for line in lines:
        assert line.columns["loading.pressure"].tolist() == PRESSURES[:3]
        assert (np.diff(line.columns["contact_area"]) > 0.0).all()
        assert len(set(line.columns["interface.upper.surface.seed"])) == 1
    assert len(study.lines()) == 6  # along the last one
    assert [len(line.columns["seconds"]) for line in study.lines("interface.lower")] == [2] * 6
    one = ck.study(contact(), {"loading.pressure": PRESSURES[:2]}, ACCURACY).lines()
    assert [line.label for line in one] == [""]


def test_every_line_is_drawn():
    plot = pytest.importorskip("contactkit.plot.study")
    drawing = pytest.importorskip("contactkit.plot.style")
    columns = {"mean_pressure": np.array([1e6, 2e6]), "max_pressure": np.array([1e9, 2e9])}
    curves = [(str(i), columns) for i in range(7)]
    figure, ax = drawing.figure()
    over = ("mean_pressure", "mean pressure [MPa]", 1e6)
    plot.study_curves(curves, [ax], [("max_pressure", "maximum pressure [GPa]", 1e9)], over)
    assert len(ax.lines) == 7
    assert len({(line.get_linestyle(), line.get_color()) for line in ax.lines}) == 7
    assert figure is ax.figure


def test_a_stack_keeps_its_name_in_a_file(tmp_path):
    named, _ = stacks()
    scene = contact(solid=named)
    again = ck.load_scene(ck.save_scene(scene, tmp_path / "scene.toml"))
    assert again == scene
    assert again.interface.upper.solid.name == "structure I"
