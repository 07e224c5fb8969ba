"""Studies in a file, their estimate, and points that fail or lose their workers."""

from __future__ import annotations

import concurrent.futures
import csv
import math
import os
import signal
import sqlite3
import tracemalloc
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest
from attrs import evolve

import contactkit as ck
from contactkit.studies import run as study_run
from contactkit.studies import stream

pytestmark = [
    pytest.mark.slow,
    pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning"),
]

OIL = ck.Liquid(name="oil", viscosity=0.1, surface_tension=0.03)
GAPS, TIMES = "loading.initial_gap", "loading.time"
VARY = {GAPS: ["2 um", "4 um", "8 um"], TIMES: [1e-3, 2e-3, 4e-3, 8e-3]}


def film(**loading):
    face = ck.Flat(radius=1e-3)
    given = {"time": 1e-3, "initial_gap": 4e-6, "final_gap": 1e-5} | loading
    return ck.SeparationScene(
        interface=ck.Interface(
            lower=face, upper=face, meniscus=ck.Meniscus(liquid=OIL, volume=1e-11)
        ),
        loading=ck.ImposedTime(**given),
        effects=(ck.MeniscusForce(profile="arc"), ck.ViscousForce()),
    )


def contact():
    steel = ck.Material(name="steel", young_modulus=210e9, poisson_ratio=0.3)
    rough = ck.GaussianRoughness(rms=1e-9, correlation_length=3e-7, cutoff=1.25e-7)
    return ck.ContactScene(
        interface=ck.Interface(lower=ck.Body(solid=steel), upper=ck.Body(surface=rough)),
        window=ck.Window(width=1e-6),
        loading=ck.Pressing(pressure=1e7),
        effects=(ck.HalfSpace(),),
    )


QUICK = ck.Accuracy(points=5)


# The file ---------------------------------------------------------------------------------------


def test_a_streamed_study_has_the_columns_of_a_study(tmp_path):
    fractions = []
    found = ck.stream_study(film(), VARY, tmp_path / "oil", QUICK, progress=fractions.append)
    wanted = ck.study(film(), VARY, QUICK)
    assert found.path == tmp_path / "oil.sqlite"
    assert (found.shape, found.paths) == (wanted.shape, wanted.paths)
    assert set(found.units) == set(wanted.units)
    for name in wanted.units:
        assert found.unit(name) == wanted.unit(name)
        if name != "seconds":
            np.testing.assert_array_equal(found.column(name), wanted.column(name), err_msg=name)
    assert list(found.column("status")) == list(wanted.column("status"))
    assert fractions[-1] == 1.0
    assert fractions == sorted(fractions)
    assert (found.status, found.message) == ("complete", "12 points over initial_gap, time")
    assert found.scalars().keys() - {"n_done"} == wanted.scalars().keys() - {"n_solved"}
    assert found.cite() == wanted.cite() != ""
    assert found.number_names == wanted.number_names
    assert found.telling() == wanted.telling()
    assert [line.label for line in found.lines(GAPS)] == [x.label for x in wanted.lines(GAPS)]
    saved, same = (
        ck.read_curve(one.save(tmp_path / n)) for n, one in ((".f", found), (".s", wanted))
    )
    assert (saved.units, saved.sources) == (same.units, same.sources)
    assert (saved.parts["paths"], saved.parts["shape"]) == (
        same.parts["paths"],
        same.parts["shape"],
    )
    np.testing.assert_array_equal(saved["viscous_impulse"], same["viscous_impulse"])
    assert found.plot.available == wanted.plot.available
    assert len(found.plot.number("viscous_impulse").lines) == 3


def test_sources_of_a_streamed_study_are_those_of_all_choices(tmp_path):
    vary = {"effects.meniscus-force.profile": ["arc", "exact"]}
    found = ck.stream_study(film(), vary, tmp_path / "oil", QUICK)
    assert found.cite() == ck.study(film(), vary, QUICK).cite()


def test_contacts_start_from_their_neighbours_and_agree(tmp_path):
    vary = {"interface.upper.surface.seed": [1, 2], "loading.pressure": [1e7, 2e7, 4e7]}
    accuracy = ck.Accuracy(grid=32, rtol=1e-9)
    wanted = ck.study(contact(), vary, accuracy)
    with pytest.warns(ck.ValidityWarning, match="6 of 6 points are outside the range of a model: "):
        found = ck.stream_study(contact(), vary, tmp_path / "steel", accuracy)
    np.testing.assert_allclose(found.column("load"), wanted.column("load"), rtol=1e-12)
    area = wanted.column("contact_area")
    np.testing.assert_allclose(found.column("contact_area"), area, rtol=1e-6)


@pytest.mark.parametrize("sized", [1, 3, 5, 100])
def test_points_are_cut_into_pieces_whatever_their_number(tmp_path, monkeypatch, sized):
    monkeypatch.setattr(stream, "_PIECE", sized)
    found = ck.stream_study(film(), VARY, tmp_path / "oil", QUICK)
    assert found.n_done == 12
    np.testing.assert_array_equal(found.column(TIMES), np.tile([1e-3, 2e-3, 4e-3, 8e-3], 3))


def test_an_interrupted_study_continues_and_another_one_is_refused(tmp_path, monkeypatch):
    monkeypatch.setattr(stream, "_PIECE", 4)

    def stop(fraction):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        ck.stream_study(film(), VARY, tmp_path / "oil", QUICK, progress=stop)
    part = ck.StudyFile(tmp_path / "oil")
    assert part.status == "incomplete"
    assert part.message.endswith(f"; {12 - part.n_done} not solved yet")
    assert 0 < part.n_done < part.n_points == 12
    assert np.isnan(part.column("viscous_impulse")).sum() == 12 - part.n_done
    seconds = part.column("seconds")
    whole = ck.stream_study(film(), VARY, tmp_path / "oil", QUICK)
    assert whole.n_done == 12
    kept = ~np.isnan(seconds)
    np.testing.assert_array_equal(whole.column("seconds")[kept], seconds[kept])  # not solved again
    for scene, vary in ((film(final_gap=2e-5), VARY), (film(), VARY | {TIMES: [1e-3]})):
        with pytest.raises(ck.DescriptionError, match="be a new file, or that of the same study"):
            ck.stream_study(scene, vary, tmp_path / "oil", QUICK)


def test_tables_of_other_programs(tmp_path):
    found = ck.stream_study(film(), VARY, tmp_path / "oil", QUICK)
    with found.save_csv(tmp_path / "oil").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == 12
    assert float(rows[5][f"{TIMES} [s]"]) == found.column(TIMES)[5]
    impulse = float(rows[5]["viscous_impulse [N.s]"])
    assert impulse == pytest.approx(found.column("viscous_impulse")[5], rel=1e-9)
    pytest.importorskip("xarray")
    data = found.to_xarray()
    assert data["viscous_impulse"].shape == (3, 4)
    assert data["viscous_impulse"].attrs["units"] == "N.s"
    assert len(found.to_dataframe()) == 12


def test_memory_does_not_grow_with_the_number_of_points():
    """Pieces are made when they are asked for: a million points are planned in a few megabytes."""
    from contactkit.studies.paths import axes
    from contactkit.studies.run import Piece

    vary = {GAPS: list(np.linspace(1e-6, 2e-6, 1000)), TIMES: list(np.linspace(1e-3, 2e-3, 1000))}
    varied = axes(film(), QUICK, vary)
    base = Piece(film(), QUICK, (), None, False)
    tracemalloc.start()
    pieces = stream._pieces(base, varied, 250, lambda place: place < 990_000)
    n = sum(len(piece.tasks) for piece in pieces)
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert n == 10_000
    assert peak < 2e6


@pytest.mark.parametrize(
    ("text", "message"), [(None, "must exist"), ("no database", "must be a study")]
)
def test_what_is_no_file_of_a_study_is_refused(tmp_path, text, message):
    if text is not None:
        (tmp_path / "oil.sqlite").write_text(text)
    with pytest.raises(ck.DescriptionError, match=message):
        ck.StudyFile(tmp_path / "oil.sqlite")
    if text is not None:
        with pytest.raises(ck.DescriptionError, match="be the file of a study"):
            ck.stream_study(film(), VARY, tmp_path / "oil.sqlite", QUICK)
        assert (tmp_path / "oil.sqlite").read_text() == text


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ("UPDATE header SET value = '[{' WHERE key = 'axes'", "must hold JSON"),
        ("UPDATE header SET value = '[{}]' WHERE key = 'axes'", "its axes are no lists"),
        ("INSERT INTO points (place, status) VALUES (-1, 'refused')", "the place of no point"),
        ("UPDATE points SET viscous_impulse = 'much'", "'much' in the column"),
        ("CREATE VIEW all_of AS SELECT * FROM points", "no views, triggers"),
        ("DROP TABLE points", "it has no table points"),
        ("UPDATE header SET value = '[1]' WHERE key = 'sources'", "sources or counts are no list"),
    ],
)
def test_a_file_of_a_study_that_was_changed_is_refused(tmp_path, change, message):
    path = ck.stream_study(film(), VARY, tmp_path / "oil", QUICK).path
    base = sqlite3.connect(path)
    with base:
        base.execute(change)
    base.close()

    def read():
        found = ck.StudyFile(path)
        return list(found.failed()), found.column("viscous_impulse")

    with pytest.raises(ck.DescriptionError, match=message):
        read()


def test_a_column_that_is_not_there_and_values_that_are_wrong_are_refused(tmp_path):
    found = ck.stream_study(film(), VARY, tmp_path / "oil", QUICK)
    with pytest.raises(ck.DescriptionError, match="did you mean 'viscous_impulse'"):
        found.column("viscous_impuls")
    with pytest.raises(ck.DescriptionError, match="must be positive"):
        ck.stream_study(film(), {TIMES: [1.0, -1.0]}, tmp_path / "other", QUICK)
    with pytest.raises(ck.DescriptionError, match="retries must be a whole number of at least 0"):
        ck.stream_study(film(), VARY, tmp_path / "other", QUICK, retries=-1)
    assert not (tmp_path / "other.sqlite").exists()


# The estimate -----------------------------------------------------------------------------------


def test_a_plan_of_a_study_states_time_memory_and_disk(tmp_path):
    times = [1e-3 * (1.0 + 1e-4 * i) for i in range(500)]
    plan = ck.plan_study(film(), {GAPS: ["2 um", "4 um"], TIMES: times}, QUICK, trials=3, workers=4)
    assert (plan.n_points, plan.n_trials) == (1000, 3)
    assert 0.0 < plan.least_seconds <= plan.seconds <= plan.most_seconds
    assert plan.wall_seconds == pytest.approx(1000 * plan.seconds / 4)
    text = str(plan)
    assert text.startswith("study of 1000 points: loading.initial_gap (2) x loading.time (500)")
    assert "estimate from 3 points" in text
    found = ck.stream_study(film(), {GAPS: ["2 um", "4 um"], TIMES: times}, tmp_path / "oil", QUICK)
    assert os.path.getsize(found.path) == pytest.approx(plan.disk, rel=0.3)


# Failures ---------------------------------------------------------------------------------------


@pytest.fixture
def failing(monkeypatch):
    """Function that has points of a given time raise; the number of their solves so far."""
    simulate, count = study_run.run, {}

    def install(errors):
        def solve(plan):
            time = plan.scene.loading.time
            count[time] = count.get(time, 0) + 1
            if time in errors and count[time] <= errors[time][1]:
                raise errors[time][0]
            return simulate(plan)

        monkeypatch.setattr(study_run, "run", solve)
        monkeypatch.setattr(study_run.time, "sleep", lambda seconds: None)
        return count

    return install


def test_what_may_pass_is_tried_again_and_what_will_not_is_a_row(failing, tmp_path):
    count = failing(
        {
            1e-3: (OSError("disk full"), 2),
            2e-3: (ZeroDivisionError("a bug"), 99),
            4e-3: (MemoryError(), 99),
        }
    )
    study = ck.study(film(), {TIMES: VARY[TIMES]}, QUICK)
    assert count == {1e-3: 3, 2e-3: 1, 4e-3: 3, 8e-3: 1}
    assert [p.status for p in study.points] == ["curve", "failed", "failed", "curve"]
    assert study.points[1].message == "ZeroDivisionError: a bug"
    assert math.isnan(study.column("viscous_impulse")[2])
    assert "point 1: ZeroDivisionError: a bug" in study.table()


def test_failed_rows_stay_until_they_are_forgotten(failing, tmp_path):
    count = failing({2e-3: (ZeroDivisionError("a bug"), 1)})
    vary = {TIMES: VARY[TIMES]}
    found = ck.stream_study(film(), vary, tmp_path / "oil", QUICK)
    (row,) = found.failed()
    assert (row.place, row.values, row.status) == (1, {TIMES: 2e-3}, "failed")
    assert row.message == "ZeroDivisionError: a bug"
    ck.stream_study(film(), vary, tmp_path / "oil", QUICK)
    assert count[2e-3] == 1
    assert found.forget_failed() == 1
    again = ck.stream_study(film(), vary, tmp_path / "oil", QUICK)
    assert count[2e-3] == 2
    assert list(again.failed()) == []


class Losing:
    """A client that loses pieces with points of some times, as often as is stated."""

    def __init__(self, losses):
        self.losses, self.n_submitted = dict(losses), 0
        self.pool = ThreadPoolExecutor(1)

    def submit(self, function, piece):
        import pickle

        self.n_submitted += 1
        for task in pickle.loads(piece).tasks:
            time = task.values[TIMES]
            if self.losses.get(time, 0) > 0:
                self.losses[time] -= 1
                future = concurrent.futures.Future()
                future.set_exception(ConnectionError("worker lost"))
                return future
        return self.pool.submit(function, piece)


def test_points_of_a_lost_piece_are_submitted_again(tmp_path):
    client = Losing({2e-3: 2, 8e-3: 99})
    with client.pool:
        study = ck.study(film(), {TIMES: VARY[TIMES]}, QUICK, client=client)
    assert [p.status for p in study.points] == ["curve", "curve", "curve", "failed"]
    assert study.points[3].message.startswith("lost 3 times: its worker: ConnectionError")
    assert study.n_solved == 4


def test_a_study_whose_points_are_all_lost_ends(tmp_path):
    client = Losing(dict.fromkeys(VARY[TIMES], 99))
    with client.pool, pytest.raises(ck.ContactkitError, match=r"every point .* failed: lost"):
        ck.stream_study(film(), {TIMES: VARY[TIMES]}, tmp_path / "oil", QUICK, client=client)
    assert client.n_submitted <= 4 * 4


KILLING = """
import os, signal, sys
sys.path.insert(0, sys.argv[1])
import test_study_stream as tests
from contactkit.studies import run as study_run

simulate = study_run.run

def solve(plan):
    if plan.scene.loading.time == 2e-3:
        os.kill(os.getpid(), signal.SIGKILL)
    return simulate(plan)

study_run.run = solve  # here and in the workers, which run this file too
if __name__ == "__main__":
    import contactkit as ck
    vary = {tests.TIMES: tests.VARY[tests.TIMES]}
    found = ck.stream_study(tests.film(), vary, sys.argv[2], tests.QUICK, workers=2, retries=0)
    print(list(found.column("status")))
    print([(row.place, row.message) for row in found.failed()])
"""


@pytest.mark.slow
@pytest.mark.skipif(not hasattr(signal, "SIGKILL"), reason="processes are killed by a signal")
def test_a_point_that_kills_its_worker_costs_only_itself(tmp_path):
    import ast
    import subprocess
    import sys

    script = tmp_path / "killing.py"
    script.write_text(KILLING, encoding="utf-8")
    ran = subprocess.run(
        [sys.executable, str(script), str(Path(__file__).parent), str(tmp_path / "oil")],
        capture_output=True,
        text=True,
        check=True,
        timeout=200,
    )
    statuses, failed = map(ast.literal_eval, ran.stdout.replace("np.str_", "").splitlines())
    assert statuses == ["curve", "failed", "curve", "curve"]
    ((place, message),) = failed
    assert place == 1
    assert message.startswith("lost 1 times: a worker process")


# Bands ------------------------------------------------------------------------------------------


def test_bands_keep_the_definitions_of_their_scales(tmp_path):
    vary = {"interface.upper.surface.seed": [1, 2], "loading.pressure": [1e7, 2e7]}
    whole = ck.study(contact(), vary, ck.Accuracy(grid=32)).dimensionless()

    def written(study):
        return ck.read_curve(study.save(tmp_path / "bands")).parts

    assert written(whole.bands())["scales"] == written(whole)["scales"] != {}
    assert evolve(whole.bands()).scale_definitions == whole.scale_definitions
