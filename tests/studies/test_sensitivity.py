"""Sensitivity of an answer to the assumptions of a scene: values, order, refusals, figure."""

import csv
import math

import numpy as np
import pytest
from attrs import evolve

import contactkit as ck
from contactkit.app.scenes import open_scene
from contactkit.models.head_disk import assumptions as head_disk
from contactkit.models.injector.assumptions import NAMES, RANGES, RANGES_SUSTAINED, sustaining
from contactkit.models.injector.delays import closing_lag, residual_gap, sticking_time
from contactkit.models.micromirror.assumptions import NAMES as MIRROR_NAMES
from contactkit.models.micromirror.assumptions import RANGES as MIRROR_RANGES
from contactkit.models.micromirror.release import humidity_limit, voltage_needed
from contactkit.studies.sensitivity import Influence

VISCOSITY, RADIUS = "interface.meniscus.liquid.viscosity", "interface.lower.surface.radius"
RADII = f"{RADIUS}, interface.upper.surface.radius"


@pytest.fixture(scope="module")
def film():
    """Flat faces drawn apart at a speed, flooded: F = 3 pi eta R^4 v/(2 h^3)."""
    oil = ck.Liquid(name="oil", viscosity=0.1, surface_tension=0.03, density=870.0)
    face = ck.Flat(radius=1e-3)
    return ck.SeparationScene(
        interface=ck.Interface(lower=face, upper=face, meniscus=ck.Meniscus(liquid=oil)),
        loading=ck.ImposedSpeed(speed=1e-3, initial_gap=5e-6, final_gap=25e-6),
        effects=(ck.ViscousForce(),),
    )


@pytest.fixture(scope="module")
def found(film):
    ranges = {
        "loading.speed": ck.Range("0.9 mm/s", "1.2 mm/s", "a motor"),
        VISCOSITY: (0.01, 0.4),
        RADII: ck.Range(("1 mm", "1 mm"), ("1.1 mm", "1.1 mm")),
        "loading.initial_gap": ck.Range("4 um", "5 um"),
    }
    return ck.sensitivity(film, ranges, "peak_force", n=3)


def test_answers_are_those_of_the_law(film, found):
    base = 3.0 * math.pi * 0.1 * 1e-3**4 * 1e-3 / (2.0 * 5e-6**3)
    assert found.base == pytest.approx(base, rel=1e-6)
    assert found.quantity_unit == found.unit("least") == "N"
    for path, values, factors in (
        ("loading.speed", (0.9e-3, 1.05e-3, 1.2e-3), (0.9, 1.05, 1.2)),
        (VISCOSITY, (0.01, math.sqrt(0.004), 0.4), (0.1, math.sqrt(0.4), 4.0)),  # by ratios
        (RADII, (1e-3, 1.1e-3), (1.0, 1.1**4)),
        ("loading.initial_gap", (4e-6, 4.5e-6, 5e-6), (1.25**3, (5.0 / 4.5) ** 3, 1.0)),
    ):
        one = found.influence(path)
        assert one.values == pytest.approx(values)
        assert np.array(one.results) / base == pytest.approx(factors, rel=1e-6)


def test_most_influential_comes_first(found):
    paths = [one.path for one in found.influences]
    assert paths == [VISCOSITY, "loading.initial_gap", RADII, "loading.speed"]
    assert found.influences[0].extent(found.base) == pytest.approx(
        (0.1 * found.base, 4 * found.base)
    )
    assert found.influence("loading.speed").reason == "a motor"


@pytest.mark.slow
def test_same_on_processes(film, found):
    again = ck.sensitivity(film, {"loading.speed": (0.9e-3, 1.2e-3)}, "peak_force", workers=2)
    assert again.influences[0].results == found.influence("loading.speed").results[::2]


def test_text_and_files(found, tmp_path):
    assert "10 mPa.s" in str(found)
    assert "<pre>" in found._repr_html_()
    with found.save_csv(tmp_path / "tornado").open(newline="") as file:
        rows = list(csv.reader(file))
    assert len(rows) == 1 + 1 + 3 * 3 + 2
    assert rows[2][:3] == [VISCOSITY, "0.01", "Pa.s"]
    frame = found.to_dataframe()
    assert frame["assumption"].tolist() == [one.path for one in found.influences]
    assert frame["greatest"][0] == pytest.approx(4.0 * found.base)


def test_a_sensitivity_is_a_curve_over_its_assumptions(found, tmp_path):
    assert (found.axis, found.status) == ("assumption", "complete")
    assert found.message == "peak_force = 3.77 N"
    assert found.scalars() == {"base": (found.base, "N")}
    assert "Reynolds" in found.cite() or "Stefan" in found.cite()
    read = ck.read_curve(found.save(tmp_path / "tornado"))
    assert read["assumption"].tolist() == [one.path for one in found.influences]
    np.testing.assert_array_equal(read["greatest"], found["greatest"])
    tried = read.parts["influences"][VISCOSITY]
    assert (tried["values"], tried["unit"]) == (found.influences[0].values, "Pa.s")
    assert tried["results"] == found.influences[0].results
    assert read.sources == found.sources


def test_what_has_no_result_comes_first_and_says_why(film, tmp_path):
    def gap_over(scene):
        if scene.loading.initial_gap > 5e-6:
            raise ck.InfeasibleError("too far")
        return scene.loading.initial_gap

    ranges = {"loading.speed": (1e-4, 1e-2), "loading.initial_gap": (4e-6, 6e-6)}
    got = ck.sensitivity(film, ranges, gap_over, unit="m")
    first, last = got.influences
    assert (first.path, got.quantity, got.quantity_unit) == ("loading.initial_gap", "gap over", "m")
    assert first.has_gaps
    assert first.swing(got.base) == math.inf
    assert last.results == (5e-6, 5e-6)
    assert "too far" in str(got)
    assert (got.status, got.message) == (
        "incomplete",
        "gap over = 5 um; none somewhere in the range of loading.initial_gap",
    )
    read = ck.read_curve(got.save(tmp_path / "gaps"))
    assert math.isnan(read.parts["influences"]["loading.initial_gap"]["results"][1])


def test_assumptions_that_vary_together_may_be_a_tuple(film):
    ends = ((1e-4, 5e-6), (1e-2, 6e-6))
    ranges = {("loading.speed", "loading.initial_gap"): ends}
    got = ck.sensitivity(film, ranges, lambda scene: scene.loading.initial_gap, unit="m")
    assert got.influences[0].path == "loading.speed, loading.initial_gap"
    assert got.influences[0].results == (5e-6, 6e-6)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"ranges": {}}, "name at least one assumption"),
        ({"ranges": {"loading.speeed": (1.0, 2.0)}}, r"loading\.speed"),
        ({"ranges": {"loading.speed": 1.0}}, "a pair"),
        ({"ranges": {"loading.speed": (-1.0, 2.0)}}, "speed"),
        ({"n": 1}, "at least 2"),
        ({"quantity": "peak_farce"}, "peak_force"),
        ({"quantity": 3.0}, "or a function"),
        ({"unit": "N"}, "be left out"),
        ({"quantity": lambda scene: 1.0, "workers": 2}, "be left out"),
    ],
)
def test_refusals(film, change, message):
    given = {"ranges": {"loading.speed": (1e-4, 1e-3)}, "quantity": "peak_force"} | change
    with pytest.raises(ck.DescriptionError, match=message):
        ck.sensitivity(film, **given)


def test_figure_has_a_bar_for_each_end(film, found):
    ax = found.plot.tornado(names={VISCOSITY: "viscosity"})
    labels = [one.get_text() for one in ax.get_yticklabels()]
    assert labels == [
        "viscosity (100 mPa·s)",
        "initial gap (5 µm)",
        "radius (1 mm)",
        "speed (1 mm/s)",
    ]
    assert len(ax.patches) == 8
    assert ax.get_xlabel() == "peak_force [N]"


def test_figure_only_names_what_moves_nothing(found):
    idle = Influence("film.idle", "m", 1.0, (0.5, 2.0), (found.base, 1.001 * found.base), ("", ""))
    lost = Influence("film.lost", "m", 1.0, (0.5, 2.0), (found.base, math.nan), ("", "no release"))
    more = evolve(found, influences=(*found.influences, idle, lost))
    ax = more.plot.tornado(missing="never released")
    labels = [one.get_text() for one in ax.get_yticklabels()]
    assert len(labels) == 5
    assert not any("idle" in one for one in labels)
    texts = [one.get_text() for one in ax.texts]
    assert "less than 2 % of this axis: idle" in texts
    assert "2 m: never released" in texts


@pytest.fixture(scope="module")
def injector():
    return open_scene("fuel-injector").scene


def test_ranges_of_the_injector_hold_its_values(injector):
    for scene, ranges in ((injector, RANGES), (sustaining(injector), RANGES_SUSTAINED)):
        assert set(ranges) <= set(NAMES)
        assert all(one.reason for one in ranges.values())
        got = ck.sensitivity(scene, ranges, lambda one: one.temperature, unit="K")
        for one in got.influences:
            if isinstance(one.base, float):
                assert one.values[0] <= one.base * (1 + 1e-9)
                assert one.base <= one.values[-1] * (1 + 1e-9)


def test_ranges_of_the_disk_hold_its_values():
    device = open_scene("head-disk")
    lean = head_disk.without_stresses(device.scene)
    assert set(head_disk.RANGES) == set(head_disk.NAMES)
    got = ck.sensitivity(lean, head_disk.RANGES, lambda one: one.loading.pressure, unit="Pa")
    for one in got.influences:
        if isinstance(one.base, float):
            assert one.values[0] <= one.base <= one.values[-1]
    assert lean.effects != device.scene.effects


@pytest.mark.slow
def test_the_oil_decides_how_long_the_spool_sticks(injector):
    strength, cavity = (f"effects.tension-limit.{n}" for n in ("strength", "cavity_pressure"))
    chosen = {path: RANGES[path] for path in (strength, cavity, "temperature", "loading.mass")}
    got = ck.sensitivity(injector, chosen, sticking_time, unit="s")
    assert [one.path for one in got.influences[:2]] == [strength, cavity]
    assert math.isnan(got.influences[0].results[1])  # 30 bar: never released
    assert got.base == pytest.approx(0.342e-3 - 0.319e-3, abs=1e-6)
    assert got.influence("temperature").swing(got.base) < 1e-6


@pytest.mark.exhaustive
def test_a_film_that_sustains_its_strength_closes_late(injector):
    late = sustaining(injector)
    assert closing_lag(injector) == pytest.approx(4e-6, abs=1e-6)
    assert closing_lag(late) == pytest.approx(1.36e-3, rel=0.01)
    assert residual_gap(late) == pytest.approx(7.88e-6, rel=0.01)


@pytest.mark.slow
def test_a_valve_that_never_opened_has_no_closing(injector):
    weak = evolve(injector.valve.spring, preload=50.0)
    stuck = evolve(injector, valve=evolve(injector.valve, spring=weak))
    assert math.isnan(closing_lag(stuck))


def test_devices_print_in_words(injector):
    text = str(injector)
    assert "coil  resistance 1 ohm, turns 40" in text
    assert "loading  ImposedForce: initial gap 5 um" in text
    mirror = open_scene("micromirror").scene
    assert "hamaker constant 1e-19 J" in str(mirror)
    assert "<li><b>hinge</b>" in mirror._repr_html_()


@pytest.mark.exhaustive
def test_the_tip_decides_whether_the_mirror_releases():
    mirror = open_scene("micromirror").scene
    assert humidity_limit(mirror) == pytest.approx(0.55, abs=0.01)
    assert voltage_needed(mirror) == pytest.approx(27.8, abs=0.1)
    radius = "interface.upper.surface.radius"
    chosen = {path: MIRROR_RANGES[path] for path in (radius, "loading.mass")}
    got = ck.sensitivity(mirror, chosen, voltage_needed, unit="V")
    assert [one.path for one in got.influences] == [radius, "loading.mass"]
    assert set(MIRROR_RANGES) <= set(MIRROR_NAMES)
