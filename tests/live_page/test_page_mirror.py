"""The page of a micromirror: mirror and tips in WebAssembly beside their coupling in Python."""

from __future__ import annotations

import json
import math

import numpy as np
import pytest
from attrs import evolve
from wasm import Wasm, needs_runtime, unpacked

from contactkit.accuracy import Accuracy
from contactkit.errors import PlanError
from contactkit.live_page import mirror_page
from contactkit.live_page.page import page_data
from contactkit.models.library import bundled_device
from contactkit.models.micromirror.assumptions import RANGES
from contactkit.models.micromirror.coupling import couple
from contactkit.models.micromirror.release import landing, release
from contactkit.models.micromirror.tip_film import adhesion, tip_law
from contactkit.studies.paths import axes, changed, value_at

MIRROR = bundled_device("micromirror")
AWAY = 0.5 * MIRROR.mirror.tips.landing_tilt


@pytest.fixture(scope="module")
def data():
    """Data of the page without what moves through tables over a grid."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(mirror_page, "_family", lambda *given: "left out")
        return page_data(MIRROR)


class Mirror(Wasm):
    """The page of a micromirror, driven as ``template/mirror.js`` drives it."""

    def flight(self, data, voltage, set_values=()):
        """Time at which the tips are free [s], nan if they are not; rows."""
        numbers = unpacked(data["numbers"])[: data["count"]]
        tip = [(place, value) for model, place, value in set_values if model == "tip"]
        self.load(numbers, tip)
        self.fill("ck_mirror", numbers)
        self._call("ck_mirror_reset")
        assert all(self._call("ck_mirror_tip", *one) for one in tip)
        given = dict(enumerate(data["mirror"]))
        given |= {place: value for model, place, value in set_values if model == "mirror"}
        for place, value in given.items():
            self._call("ck_mirror_set", place, value)
        run = data["run"]
        if not self._call("ck_mirror_start", voltage, run["wait"], run["step"]):
            raise ValueError(self.said())
        rows, ended = [self._rows()], 0
        while ended == 0:
            ended = self._call("ck_mirror_run", AWAY)
            rows.append(self._rows())
        if ended < 0:
            raise ValueError(self.said())
        return (self._call("ck_mirror_held") if ended == 1 else math.nan), np.concatenate(rows)

    def _rows(self):
        count = self._call("ck_mirror_count")
        return self._numbers(self._call("ck_mirror_rows"), count * 9).reshape(-1, 9)


@pytest.fixture(scope="module")
def mirror():
    return Mirror()


def with_humidity(humidity):
    return evolve(MIRROR, study=evolve(MIRROR.study, humidity=humidity))


def data_of(scene):
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(mirror_page, "_family", lambda *given: "left out")
        return page_data(scene)


@pytest.mark.slow
@needs_runtime
@pytest.mark.parametrize("humidity", [0.3, 0.5, 0.6, 0.9])
def test_the_release_is_that_of_the_device(mirror, humidity):
    """By the springs up to 55 %, by a pulse up to 30.5 V, to the step of the coupling."""
    scene = with_humidity(humidity)
    law, made = tip_law(scene.tip, humidity), data_of(scene)
    free = set()
    for voltage in (0.0, 24.0, 28.0, 31.0):
        expected = release(scene, law, voltage or None)
        found, _ = mirror.flight(made, voltage)
        assert found == pytest.approx(expected, rel=1e-12, nan_ok=True), voltage
        free.add(math.isfinite(found))
    assert free == {True, False} or humidity == 0.3


@pytest.mark.slow
@needs_runtime
def test_the_motion_is_that_of_the_coupling_in_python(mirror, data):
    turned = MIRROR.first_flip(34.0)
    wave = turned.waveform
    motion = couple(
        turned,
        MIRROR.tips(tip_law(MIRROR.tip, MIRROR.study.humidity)),
        MIRROR.loading.stiffness,
        MIRROR.start,
        wave.reset_time + wave.release_time,
        MIRROR.study.communication_step,
        until=lambda time, tilt: tilt < AWAY,
    )
    _, rows = mirror.flight(data, 34.0)
    assert rows[:, 0] == pytest.approx(motion["time"], rel=1e-12)
    assert rows[:, 1] == pytest.approx(motion["tilt"], rel=1e-7)
    assert rows[:, 3] == pytest.approx(motion["gap_plus"], rel=1e-3, abs=1e-11)
    assert rows[0, 4] == pytest.approx(-landing(MIRROR).preload, rel=1e-6)
    assert np.array_equal(rows[:, 6] >= 3.0, motion["state_plus"] >= 3.0)


MOVED = [
    one
    for one in RANGES
    if one.startswith("mirror.") or one in ("loading.stiffness", "loading.mass")
]


@pytest.mark.slow
@needs_runtime
@pytest.mark.parametrize("path", MOVED)
def test_each_slider_is_the_field_of_its_scene(mirror, data, path):
    (axis,) = axes(MIRROR, Accuracy(), {path: [RANGES[path].low]})
    value = float(axis.values[0][0])
    scene = changed(MIRROR, None, {path: value}).scene
    (slider,) = (one for one in data["sliders"] if one["places"] == [path.split(".")])
    ((model, place, _),) = slider["targets"]
    law = tip_law(scene.tip, scene.study.humidity)
    before, rows = mirror.flight(data, 34.0)
    found, moved = mirror.flight(data, 34.0, [(model, place, value)])
    assert found == pytest.approx(release(scene, law, 34.0), rel=1e-9, nan_ok=True)
    assert moved[0, 1] == pytest.approx(scene.start.tilt, rel=1e-12)
    count = min(len(rows), len(moved))
    assert found != before or not np.allclose(moved[:count, 1], rows[:count, 1], rtol=1e-9)


@pytest.mark.slow
@needs_runtime
def test_a_pulse_that_reaches_the_electrode_is_refused(mirror, data):
    with pytest.raises(ValueError, match="the plate meets the electrode"):
        mirror.flight(data, 79.0)
    weak = [("mirror", mirror_page.PARAMETERS.index("waveform.bias_voltage"), -1.0)]
    with pytest.raises(ValueError, match="the bias does not hold the mirror down"):
        mirror.flight(data, 0.0, weak)


@pytest.mark.slow
def test_the_tables_hold_what_condenses(data):
    """Over a small grid: the force of a tip and the Kelvin radius at another humidity."""
    tip = mirror_page._tip(MIRROR)
    with pytest.MonkeyPatch.context() as patch:
        sliders = mirror_page._grid(MIRROR)[:1]
        patch.setattr(mirror_page, "_grid", lambda scene: sliders)
        family = mirror_page._family(tip, Accuracy.standard, None)
    assert bool(family.error < 0.01)  # a plain bool: pytest would print all tables
    there = with_humidity(0.7)
    found = family.at([0.7])
    assert math.exp(found[-1]) == pytest.approx(adhesion(there.tip, 0.7).kelvin_radius, rel=1e-6)
    whole = Mirror()
    made = {**data, "numbers": mirror_page.packed_numbers(found), "count": family.count}
    expected = release(there, tip_law(there.tip, 0.7), 34.0)
    assert whole.flight(made, 34.0)[0] == pytest.approx(expected, rel=1e-9)
    assert math.isnan(whole.flight(made, 28.0)[0])
    assert whole.flight(made, 30.2)[0] > 0.0


@pytest.mark.slow
def test_attraction_of_the_solids_is_proportional_to_its_constant():
    with pytest.MonkeyPatch.context() as patch:
        sliders = mirror_page._grid(MIRROR)[:1]
        patch.setattr(mirror_page, "_grid", lambda scene: sliders)
        made = page_data(MIRROR)
    scaled = unpacked(made["numbers"])[: made["count"]].copy()
    for first, count in made["hamaker"]["scene"]:
        scaled[first : first + count] *= 0.4
    path = "effects.van-der-waals-force.hamaker_constant"
    weaker = changed(MIRROR, None, {path: 0.4 * value_at(MIRROR, Accuracy(), path)}).scene
    tip = mirror_page._tip(weaker)
    assert scaled == pytest.approx(tip.numbers(weaker, tip.film.tables), rel=1e-9)
    assert len(made["hamaker"]["family"]) >= 1
    json.dumps(made, allow_nan=False)


def test_a_dry_mirror_is_refused():
    with pytest.raises(PlanError, match=r"study.humidity = 0.05: nothing condenses under a tip"):
        page_data(with_humidity(0.05))
