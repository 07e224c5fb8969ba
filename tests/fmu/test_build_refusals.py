"""What cannot be built is refused with a cure, and leaves nothing behind."""

from __future__ import annotations

from pathlib import Path

import pytest
from native_scenes import DROP, HAS_CC, scene

pytest.importorskip("pythonfmu")
pytest.importorskip("fmpy")

import contactkit as ck
from contactkit.app.crosscheck import write_crosscheck
from contactkit.app.system import write_system
from contactkit.cli import main
from contactkit.fmu.contents.packing import write_archive
from contactkit.fmu.framework.instance import Instance
from contactkit.fmu.framework.toolchain import local
from contactkit.fmu.native.build import build_native
from contactkit.fmu.native.records import Rate
from contactkit.fmu.python.build import build
from contactkit.separation.motion.advance import advance
from contactkit.separation.motion.state import Pull, start
from contactkit.separation.plan import plan

needs_cc = pytest.mark.skipif(not HAS_CC, reason="there is no C compiler")


def test_a_file_that_cannot_be_written_is_named_and_no_part_of_it_stays(tmp_path):
    (tmp_path / "file").write_text("mine")
    with pytest.raises(ck.ContactkitError, match=r"x\.fmu cannot be written \("):
        write_archive({"a": b"b"}, tmp_path / "file" / "x.fmu")
    (tmp_path / "folder.fmu").mkdir()
    with pytest.raises(ck.ContactkitError, match=r"folder\.fmu cannot be written \("):
        write_archive({"a": b"b"}, tmp_path / "folder.fmu")
    with pytest.raises(ck.ContactkitError, match=r"release_A_in\.csv cannot be written \("):
        write_crosscheck(tmp_path / "file", names=["release_A"], fmus=False)
    assert sorted(path.name for path in tmp_path.rglob("*")) == ["file", "folder.fmu"]
    assert (tmp_path / "file").read_text() == "mine"


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["stiction-mass", "--model", "stiction-force"], "add --native, or build stiction-force"),
        (["stiction-force", "--native", "--model", "stiction-mass"], "has no mass"),
        (["valve-drive", "--native", "--model", "stiction-mass"], "valve-drive has no film"),
        (["contact-stop", "--native", "--model", "tip-contact"], "contact-stop has no"),
        (["fuel-injector", "--native", "--model", "tip-contact"], "no scene of a tip-contact"),
        (["micromirror", "--native", "--model", "contact-stop"], "no scene of a contact-stop"),
    ],
)
def test_options_that_contradict_each_other_build_nothing(words, said, tmp_path, capsys):
    assert main(["fmu", "build", *words, "--out", str(tmp_path / "x.fmu")]) == 2
    assert said in capsys.readouterr().err
    assert not list(tmp_path.iterdir())


def test_a_start_value_of_what_the_tables_hold_is_not_taken_for_a_slip_of_the_pen(tmp_path):
    with pytest.raises(ck.DescriptionError, match=r"theta1 must be left out.*change the scene"):
        build_native(scene(volume=DROP), tmp_path / "x.fmu", start={"theta1": 1.0})
    with pytest.raises(ck.DescriptionError, match="platforms must name at least one of linux"):
        build_native(scene(volume=DROP), tmp_path / "x.fmu", platforms=[])


def test_a_system_whose_values_contradict_each_other_is_not_written(tmp_path):
    with pytest.raises(ck.DescriptionError, match=r"h_rel must exceed h0 = 2\.4e-05 m"):
        write_system("fuel-injector", tmp_path / "x.ssp", start={"mass.h0": "24 um"})
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    ("name", "start", "said"),
    [
        ("stiction-mass", {"h_rel": "4 um"}, r"h_rel must exceed h0 = 5e-06 m"),
        ("stiction-mass", {"h0": "0.1 mm"}, r"h_rel must exceed h0 = 0\.0001 m"),
        ("stiction-mass", {"h_min": "6 um"}, r"h_min must not exceed h0"),
        ("stiction-mass", {"h_break": "5 um"}, r"h_break must be 0 or exceed h0"),
        ("stiction-force", {"h_break": "4 um"}, r"h_break must be 0 or exceed h0"),
    ],
)
def test_gaps_that_contradict_each_other_are_not_baked_in(name, start, said, tmp_path):
    with pytest.raises(ck.DescriptionError, match=said):
        build(name, tmp_path / "x.fmu", start=start)
    assert not list(tmp_path.iterdir())


def test_a_force_too_rough_for_a_table_is_named():
    from contactkit.fmu.native import film as native_film
    from contactkit.fmu.native.tables import tabulate
    from contactkit.separation.effects.meniscus import MeniscusForce

    class Rough:
        end, release, recontact, kinks = 1e-4, float("inf"), 0.0, ()
        known_to = float("inf")

    common = native_film._Common(
        ck.plan(scene(volume=DROP)), native_film.FreeLiquid(0.0, 0.0), 1e-8, tabulate
    )
    rough = lambda gap: 1.0 + 1e-3 * (hash(gap) % 1000)  # noqa: E731
    with pytest.raises(ck.ConvergenceError, match=r"MeniscusForce has no native form.*without"):
        native_film._law_table(common, MeniscusForce(), Rough(), Rate.AT_REST, rough)


@needs_cc
@pytest.mark.slow
@pytest.mark.parametrize("gamma", [0.0, 1e-6])
def test_without_surface_tension_no_bridge_ends_the_film(gamma, tmp_path):
    """As in the Python FMU; the tables know where the bridge of the scene ends."""
    made = scene(volume=DROP, stiffness=0.0)
    path = build_native(made, Path(tmp_path / "film.fmu"), platforms=[local()], compiler="cc")
    viscous = plan(scene(volume=DROP, stiffness=0.0, effects=(ck.ViscousForce(),)))
    state = advance(viscous, start(viscous)._replace(time=0.0), Pull(40.0), 0.02)
    with Instance(path) as host:
        host.start({"gamma": gamma}, 1.0)
        host.set(host.references("F_ext"), [40.0])
        host.step(0.0, 0.02)
        found = dict(zip(host.names, host.outputs(), strict=True))
    assert found["t_release"] == pytest.approx(state.release_time, rel=1e-6)
    assert found["n_break"] == (1 if gamma else 0)
    assert found["h"] == pytest.approx(state.gap, rel=1e-7 if gamma == 0.0 else 1e-4)


@pytest.mark.parametrize(
    ("start", "said"),
    [
        ({"t_on": 20e-3}, "t_on must not exceed T_period = 0.01 s"),
        ({"t_boost": "5 ms"}, "t_boost must not exceed t_on = 0.004 s"),
        ({"h_stop": "105 um"}, "h_stop must be less than g_air = 0.000105 m"),
    ],
)
def test_a_drive_whose_values_contradict_each_other_is_not_built(tmp_path, start, said):
    with pytest.raises(ck.DescriptionError, match=said):
        build("valve-drive", tmp_path, start=start)
    assert not any(tmp_path.iterdir())
