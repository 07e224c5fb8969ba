"""The closures of liquid bridges from the command line: their errors, and what they cost."""

import csv
import math

import pytest

import contactkit as ck
from contactkit.app.scenes import open_scene
from contactkit.cli import main
from contactkit.models.liquid_bridges.closure_errors import flat_errors, sphere_errors

DEG = math.pi / 180.0
FEW = """\
device = "bridges"
gaps = 20
[[bridges]]
contact_angle_lower = "60 deg"
contact_angle_upper = "60 deg"
[[bridges]]
contact_angle_lower = "40 deg"
contact_angle_upper = "40 deg"
filling = 1e-3
"""


@pytest.fixture
def few(tmp_path):
    path = tmp_path / "few.toml"
    path.write_text(FEW)
    return path


# Largest errors in percent: consistent arc, Eq. (3.11) with the upper plate pulled, neck.
FLATS = [
    (60, 60, [(0.4, 8.5, 0.0), (2.0, 35, 0.1), (5.0, 73, 0.8), (6.5, 114, 5.7), (6.3, 132, 10.5)]),
    (0, 60, [(0.4, 2.2, 0.0), (1.9, 11, 0.1), (3.9, 27, 1.4), (3.9, 57, 10), (19, 91, 27)]),
]
SPHERES = [
    (1e-4, 0, [(0.6, 0.4, 5.8), (1.9, 1.9, 19), (6.0, 6.0, 102), (6.2, 6.2, 268), (18, 18, 419)]),
    (1e-2, 60, [(0.9, 3.4, 44), (1.4, 1.9, 64), (4.2, 4.1, 136), (5.0, 5.0, 198), (4.4, 4.4, 239)]),
]


@pytest.mark.parametrize(("lower", "upper", "expected"), FLATS)
def test_errors_between_flats(lower, upper, expected):
    for band, right in zip(flat_errors(lower * DEG, upper * DEG), expected, strict=True):
        found = [100.0 * e for e in band.errors.values()]
        assert found == pytest.approx(right, rel=0.06, abs=0.06)


@pytest.mark.parametrize(("volume", "angle", "expected"), SPHERES)
def test_errors_on_a_sphere(volume, angle, expected):
    bands = sphere_errors(angle * DEG, angle * DEG, volume)
    for band, right in zip(bands, expected, strict=True):
        found = [100.0 * e for e in band.errors.values()]
        assert found == pytest.approx(right, rel=0.06, abs=0.06)


@pytest.mark.slow
def test_cost_shows_all_closures_with_a_picture(few, tmp_path, capsys):
    out = tmp_path / "out"
    out.mkdir()
    assert main(["cost", str(few), "--out", str(out)]) == 0
    text = capsys.readouterr().out
    assert "of the force on every bridge: exact" in text
    assert "of the rupture distance on every bridge: exact" in text
    assert {path.name for path in out.iterdir()} == {"contactkit.json", "cost.png", "cost.csv"}
    with (out / "cost.csv").open(newline="") as file:
        _, *rows = csv.reader(file)
    assert len(rows) == 2 * (7 + 3)
    for quantity, closure, bridge, error, seconds in rows:
        assert float(seconds) > 0.0, bridge
        if closure == "exact":
            assert float(error) < 1e-10, (quantity, bridge)
        elif quantity == "rupture distance":
            assert float(error) > 1.0, (closure, bridge)
        else:
            assert 1e-3 < float(error) < 10.0, (closure, bridge)


def test_run_prints_the_bands(few, tmp_path, capsys):
    out = tmp_path / "out"
    out.mkdir()
    assert main(["run", str(few), "--out", str(out)]) == 0
    text = capsys.readouterr().out
    assert "flats, 60/60 deg: largest error [%]" in text
    assert "as published" in text
    assert {path.name for path in out.iterdir()} == {"contactkit.json", "errors.csv"}


def test_the_bridges_that_come_with_contactkit(capsys):
    device = open_scene("bridges")
    assert len(device.scene.bridges) == 6
    assert "reference: Legendre's integrals" in device.plan_text()
    with pytest.raises(ck.PlanError, match="have no FMU"):
        device.fmu_start()


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        (
            '"60 deg"\ncontact_angle_upper = "60',
            '"60 deg"\ncontact_angle_upper = "120',
            "must not add up to pi",
        ),
        ('lower = "60', 'lower = "80', "must be further from a right angle"),
        ("1e-3", "-1e-3", "filling must be positive"),
        ("gaps = 20", "gaps = 0", "gaps must be a whole number"),
    ],
)
def test_impossible_bridges_are_named(tmp_path, capsys, old, new, message):
    path = tmp_path / "wrong.toml"
    assert old in FEW
    path.write_text(FEW.replace(old, new))
    assert main(["plan", str(path)]) == 2
    assert message in capsys.readouterr().err
