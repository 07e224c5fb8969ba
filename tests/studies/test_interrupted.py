"""Studies that are interrupted in their first piece keep the points that were solved."""

from __future__ import annotations

import contextlib
import os
import queue
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import numpy as np
import pytest
from attrs import evolve
from selection import quick

import contactkit as ck
from contactkit.cli import main
from contactkit.studies import run as study_run
from contactkit.studies import stream
from contactkit.studies.run import Done, Piece, Task
from contactkit.studies.spread import _Client, _Spread
from contactkit.studies.store import StudyPoint

pytestmark = pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning")

QUICK = ck.Accuracy(points=5)
VARY = {"loading.time": [1e-3 + 1e-6 * i for i in range(40)]}

SCENE = """\
effects = [{ effect = "viscous-force" }]
accuracy = { points = 5 }
[interface]
lower = { shape = "flat", radius = "3 mm" }
upper = { shape = "flat" }
meniscus = { liquid = "water", volume = "0.1 mm3" }
[loading]
kind = "imposed-time"
initial_gap = "5 um"
final_gap = "50 um"
time = "1 ms"
[study]
"loading.time" = [TIMES]
"""


def film():
    face = ck.Flat(radius=1e-3)
    oil = ck.Liquid(name="oil", viscosity=0.1, surface_tension=0.03)
    return ck.SeparationScene(
        interface=ck.Interface(
            lower=face, upper=face, meniscus=ck.Meniscus(liquid=oil, volume=1e-11)
        ),
        loading=ck.ImposedTime(time=1e-3, initial_gap=4e-6, final_gap=1e-5),
        effects=(ck.ViscousForce(),),
    )


class Ended(BaseException):
    """What ends a study in its middle."""


def test_one_process_keeps_each_point_as_it_is_solved(tmp_path, monkeypatch):
    """The interruption comes in the middle of the first piece, not between pieces."""
    solved = study_run._solved

    def third(chain, piece, task):
        if task.place == 3:
            raise KeyboardInterrupt
        return solved(chain, piece, task)

    monkeypatch.setattr(study_run, "_solved", third)
    monkeypatch.setattr(stream, "_size", lambda *_: 40)
    with pytest.raises(KeyboardInterrupt):
        ck.stream_study(film(), VARY, tmp_path / "oil", QUICK)
    assert ck.StudyFile(tmp_path / "oil").n_done == 3
    monkeypatch.undo()
    whole = ck.stream_study(film(), VARY, tmp_path / "oil", QUICK)
    assert whole.n_done == 40
    wanted = ck.study(film(), VARY, QUICK).column("viscous_impulse")
    np.testing.assert_array_equal(whole.column("viscous_impulse"), wanted)


def test_a_worker_reports_each_point_and_returns_what_is_long(monkeypatch):
    import pickle

    reports, stop = queue.SimpleQueue(), threading.Event()
    monkeypatch.setattr(study_run, "_worker", {"reports": reports, "stop": stop})
    tasks = tuple(Task(i, {"loading.time": 1e-3 * (i + 1)}, "") for i in range(3))
    piece = Piece(film(), QUICK, tasks, None, False)
    assert study_run.run_in_worker(pickle.dumps(piece)) == []
    assert [reports.get().place for _ in tasks] == [0, 1, 2]
    with_maps = study_run.run_in_worker(pickle.dumps(evolve(piece, keeps_maps=True)))
    assert [reports.get().maps for _ in tasks] == [None] * 3
    assert all(one.maps for one in with_maps)
    monkeypatch.setattr(study_run, "_REPORT", 10)
    assert [one.place for one in study_run.run_in_worker(pickle.dumps(piece))] == [0, 1, 2]
    assert reports.empty()
    stop.set()
    assert len(study_run.run_in_worker(pickle.dumps(piece))) == 1


@pytest.mark.slow
def test_processes_report_points_before_their_piece_ends(tmp_path, monkeypatch):
    monkeypatch.setattr(stream, "_size", lambda *_: 20)
    seen = []

    def stop(fraction):
        seen.append(fraction)
        raise Ended

    with pytest.raises(Ended):
        ck.stream_study(film(), VARY, tmp_path / "oil", QUICK, workers=2, progress=stop)
    # The first point of a piece of twenty was taken alone; a worker ends after its current point.
    assert seen[0] == 1 / 40
    kept = ck.StudyFile(tmp_path / "oil").n_done
    assert 1 <= kept < 40
    assert ck.stream_study(film(), VARY, tmp_path / "oil", QUICK).n_done == 40


@pytest.mark.slow
def test_maps_arrive_with_their_piece():
    found = ck.study(film(), {"loading.time": [1e-3, 2e-3]}, QUICK, workers=2, keep_maps=True)
    alone = ck.study(film(), {"loading.time": [1e-3, 2e-3]}, QUICK, keep_maps=True)
    for one, same in zip(found.results, alone.results, strict=True):
        assert one["gap"].tolist() == same["gap"].tolist()


class Client:
    """A client that ends a piece after two points, as one does that takes long."""

    def __init__(self):
        self.pieces = []

    def submit(self, _, piece):
        import concurrent.futures
        import pickle

        tasks = pickle.loads(piece).tasks
        self.pieces.append(len(tasks))
        future = concurrent.futures.Future()
        point = StudyPoint({}, {}, "curve", "", 0.0)
        future.set_result([Done(task.place, point, None) for task in tasks[:2]])
        return future


def test_the_rest_of_a_long_piece_is_sent_to_a_client_again():
    client, taken = Client(), []
    piece = Piece(film(), QUICK, tuple(Task(i, {}, "") for i in range(5)), None, False)
    _Spread(_Client(client), 1, lambda done: taken.append(done.place)).run([piece])
    assert taken == [0, 1, 2, 3, 4]
    assert client.pieces == [5, 3, 1]


def test_a_client_ends_a_long_piece(monkeypatch):
    import pickle

    monkeypatch.setattr(study_run, "_LONG", 0.0)
    tasks = tuple(Task(i, {"loading.time": 1e-3 * (i + 1)}, "") for i in range(3))
    found = study_run.run_remotely(pickle.dumps(Piece(film(), QUICK, tasks, None, False)))
    assert [done.place for done in found] == [0]


# From the command line ------------------------------------------------------------------------


@pytest.mark.parametrize("kept", [None, "--store", "--stream"])
def test_an_interrupted_command_says_how_it_continues(tmp_path, monkeypatch, capsys, kept):
    path = tmp_path / "film.toml"
    path.write_text(SCENE.replace("TIMES", ", ".join(f"{1e-3 + 1e-5 * i}" for i in range(4))))
    place = tmp_path / ("kept.sqlite" if kept == "--stream" else "kept")
    more = [kept, str(place)] if kept else []
    solved = study_run._solved

    def second(chain, piece, task):
        if task.place == 2:
            os.kill(os.getpid(), signal.SIGTERM)
            time.sleep(10.0)
        return solved(chain, piece, task)

    before = signal.getsignal(signal.SIGTERM)
    monkeypatch.setattr(study_run, "_solved", second)
    assert main(["study", str(path), *more]) == 143
    assert signal.getsignal(signal.SIGTERM) is before
    said = capsys.readouterr().err
    assert "interrupted; no incomplete files are left" in said
    if kept is None:
        assert "nothing is kept: with --store DIR or --stream FILE.sqlite" in said
        return
    assert f"what is solved is kept in {place}: the same command continues" in said
    if kept == "--stream":
        assert ck.StudyFile(place).n_done == 2
    else:
        assert len(list(place.glob("*.json"))) == 2
    monkeypatch.undo()
    assert main(["study", str(path), *more]) == 0
    assert ck.StudyFile(place).n_done == 4 if kept == "--stream" else True


@pytest.mark.parametrize("how", quick([signal.SIGINT, signal.SIGTERM, signal.SIGKILL], long=[2]))
def test_a_streamed_study_over_processes_keeps_its_points(tmp_path, how):
    path, file = tmp_path / "film.toml", tmp_path / "film.sqlite"
    path.write_text(SCENE.replace("TIMES", ", ".join(f"{1e-3 + 1e-7 * i}" for i in range(4000))))
    command = [sys.executable, "-m", "contactkit.cli"]
    running = subprocess.Popen(
        [*command, "study", str(path), "--stream", str(file), "--workers", "2"],
        stderr=subprocess.DEVNULL,
        start_new_session=True,
        env=os.environ | {"PYTHONPATH": str(Path(ck.__file__).parents[1])},
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler),
    )
    try:
        end = time.monotonic() + 60.0
        while not (n_done(file) or running.poll() is not None):
            assert time.monotonic() < end
            time.sleep(0.05)
        before = n_done(file)
        running.send_signal(how)
        code = running.wait(timeout=30)
    finally:
        with contextlib.suppress(ProcessLookupError):
            os.killpg(running.pid, signal.SIGKILL)
    assert code == {signal.SIGINT: 130, signal.SIGTERM: 143, signal.SIGKILL: -signal.SIGKILL}[how]
    assert before <= n_done(file) < 4000
    assert n_done(file) >= 1


def n_done(file):
    """Points in a file that another process writes."""
    with contextlib.suppress(ck.ContactkitError):
        return ck.StudyFile(file).n_done if file.is_file() else 0
    return 0
