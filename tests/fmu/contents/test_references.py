"""Reference results inside an FMU: what is in them, and an FMU that is held against them."""

from __future__ import annotations

import hashlib
import zipfile
from itertools import pairwise

import attrs
import pytest
from native_scenes import HAS_CC, SCENES, scene

import contactkit as ck
from contactkit import cli
from contactkit.errors import DescriptionError, PlanError
from contactkit.fmu.contents.packing import write_archive
from contactkit.fmu.contents.reference_check import (
    check_references,
    deviations,
    read_references,
)
from contactkit.fmu.contents.references import FOLDER, reference_files
from contactkit.fmu.framework.toolchain import local
from contactkit.fmu.native.build import build_native
from contactkit.fmu.native.reference import add_reference, reference_run
from contactkit.reading.xml_elements import read_xml

pytestmark = pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning")

MANIFEST = f"{FOLDER}fmi-ls-manifest.xml"
NAME = "{http://fmi-standard.org/fmi-ls-manifest}fmi-ls-name"


def pulled(film, force=40.0, **loading):
    return attrs.evolve(film, loading=attrs.evolve(film.loading, force=force, **loading))


FLOODED = pulled(SCENES["flooded"])


@pytest.fixture(scope="module")
def run():
    return reference_run(FLOODED)


@pytest.fixture
def archive(run, tmp_path):
    """An archive with reference results and nothing else, of which files may be changed."""

    def write(**changes):
        files = reference_files(run)
        for name, change in changes.items():
            (path,) = (p for p in files if p.endswith(name.replace("__", ".").replace("_", "-")))
            files[path] = change(files[path].decode()).encode()
        return write_archive(files, tmp_path / "some.fmu")

    return write


def test_the_run_is_the_motion_of_the_scene(run):
    """It ends just after the release that `simulate` finds, with the momentum conserved."""
    released = ck.simulate(ck.plan(FLOODED)).state.release_time
    assert released < run.stop_time < 1.02 * released
    assert run.references["h"][-1] > FLOODED.loading.final_gap
    rows, loading = run.references, FLOODED.loading
    gaps = [h - loading.initial_gap for h in rows["h"]]
    springs = sum(loading.stiffness * 0.5 * (a + b) * run.step for a, b in pairwise(gaps))
    menisci = sum(0.5 * (a + b) * run.step for a, b in pairwise(rows["F_m"]))
    given = 40.0 * run.stop_time
    assert loading.mass * rows["v"][-1] == pytest.approx(
        given - rows["J"][-1] - springs - menisci, abs=2e-4 * given
    )


def test_a_pull_that_rises_is_given_as_straight_lines():
    run = reference_run(pulled(SCENES["flooded"], rise_time=2e-4))
    pulls, rates = run.stimuli["F_ext"], run.stimuli["dF_ext"]
    assert pulls[0] == 0.0
    for k in range(len(pulls) - 1):
        assert pulls[k] + rates[k] * run.step == pytest.approx(pulls[k + 1], rel=1e-9)


def test_a_film_alone_is_given_the_gap_at_the_end_of_each_step(run):
    film = reference_run(FLOODED, "stiction-force")
    assert film.stimuli["h"][:-1] == run.references["h"][1:]
    assert film.references["time"] == run.references["time"][1:]
    assert film.references["F"] == run.references["F"][1:]


def test_the_manifest_lists_every_file_with_its_checksum(run):
    files = reference_files(run)
    root = read_xml(files[MANIFEST], "manifest")
    assert root.tag == "fmiReferences"
    assert root.get(NAME) == "org.fmi-standard.fmi-ls-ref"
    listed = {node.get("source"): node for node in root.iterfind("Related")}
    there = {p.removeprefix(FOLDER) for p in files if p.startswith(FOLDER)} - {
        "fmi-ls-manifest.xml"
    }
    assert set(listed) == there
    for source, node in listed.items():
        assert node.get("checksum") == hashlib.sha3_256(files[FOLDER + source]).hexdigest()
    assert listed["pull.exp"].get("role") == "experiment/smoke-test"


def test_what_was_written_is_read_back(run, archive):
    (found,) = read_references(archive())
    assert found == attrs.evolve(run, stimuli=found.stimuli, references=found.references)
    for kind in ("stimuli", "references"):
        for name, column in getattr(run, kind).items():
            assert getattr(found, kind)[name] == column


def test_an_experiment_of_the_earlier_draft_is_read(archive):
    times = "startTime='0' stopTime='0.00125' stepSize='1.25e-5'"
    path = archive(
        pull__exp=lambda text: (
            "<Experiments>"
            f"<Experiment name='old' {times}><References source='pull-ref.csv'/></Experiment>"
            "</Experiments>"
        )
    )
    (found,) = read_references(path)
    assert (found.name, found.stop_time, found.step) == ("old", 1.25e-3, 1.25e-5)
    assert found.tolerance == 1e-3
    assert found.stimuli == {}


@pytest.mark.errors
@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"pull__exp": lambda t: t.replace("pull-ref.csv", "../../../x.csv")}, "path inside"),
        ({"pull__exp": lambda t: t.replace("pull-ref.csv", "http://a/x.csv")}, "path inside"),
        ({"pull__exp": lambda t: t.replace("pull-ref.csv", "none.csv")}, "have a member"),
        ({"pull__exp": lambda t: t.replace('stopTime="', 'stopTime="-')}, "0 < step <= stop"),
        ({"pull__exp": lambda t: t.replace('stepSize="', 'stepSize="x')}, "finite number"),
        (
            {"pull__exp": lambda t: t.replace("<Stimuli", '<Parameters source="a"/><Stimuli')},
            "no file of parameters",
        ),
        (
            {
                "pull__exp": lambda t: t.replace("<Experiment ", "<Other ").replace(
                    "</Experiment>", "</Other>"
                )
            },
            "have an experiment",
        ),
        ({"pull_ref__csv": lambda t: t.replace("\n", ",nan\n")}, "finite number"),
        ({"pull_ref__csv": lambda t: t + "1.0\n"}, "numbers in each row"),
        ({"pull_ref__csv": lambda t: t + t.splitlines()[1] + "\n"}, "times that rise"),
        ({"pull_ref__csv": lambda t: ""}, "row of names"),
        ({"pull_in__csv": lambda t: t.replace("dF_ext", "F_ext")}, "different names"),
    ],
)
def test_damaged_references_are_refused(archive, changes, said):
    with pytest.raises(DescriptionError, match=said):
        read_references(archive(**changes))


@pytest.mark.errors
def test_an_fmu_without_references_is_refused(tmp_path):
    path = write_archive({"modelDescription.xml": b"<a/>"}, tmp_path / "bare.fmu")
    with pytest.raises(DescriptionError, match="build it with --reference"):
        read_references(path)
    with pytest.raises(DescriptionError, match="file that is there"):
        read_references(tmp_path / "none.fmu")


@pytest.mark.errors
@pytest.mark.parametrize(
    ("film", "model", "said"),
    [
        (pulled(SCENES["flooded"], 0.0), "stiction-mass", "force above 0 N"),
        (
            attrs.evolve(
                FLOODED,
                loading=ck.ImposedSpeed(speed=1e-3, initial_gap=2e-5, final_gap=1e-4),
            ),
            "stiction-mass",
            "imposed-force",
        ),
        (
            pulled(scene(effects=(ck.ViscousForce(), ck.TensionLimit(strength=1e6)))),
            "stiction-force",
            "remembers its cavity",
        ),
    ],
)
def test_scenes_without_a_reference_are_refused(film, model, said):
    with pytest.raises(PlanError, match=said):
        reference_run(film, model)


def test_a_run_that_ended_early_or_gave_no_number_differs_without_bound(run):
    rows = run.references
    short = {name: column[:50] for name, column in rows.items()}
    assert all(one.error == float("inf") for one in deviations(run, short))
    odd = rows | {"h": [*rows["h"][:-1], float("nan")]}
    wrong = [one.variable for one in deviations(run, odd) if not one.is_fine]
    assert wrong == ["h"]


@pytest.mark.slow
@pytest.mark.skipif(not HAS_CC, reason="there is no C compiler, or no fmpy")
class TestNative:
    """A native FMU, built and run."""

    @pytest.mark.parametrize(
        ("film", "model", "fmi"),
        [
            (SCENES["drop"], "stiction-mass", 3),
            (SCENES["drop"], "stiction-force", 2),
            (
                scene(gap=2e-5, effects=(ck.ViscousForce(), ck.TensionLimit(strength=5e5))),
                "stiction-mass",
                2,
            ),
        ],
    )
    def test_it_gives_its_references(self, tmp_path, film, model, fmi):
        film = pulled(film)
        fmu = build_native(
            film, tmp_path / "a.fmu", model=model, fmi=fmi, platforms=[local()], compiler="cc"
        )
        add_reference(fmu, film, reference_run(film, model))
        found = check_references(fmu)
        assert {"F", "F_m", "F_v"} <= {one.variable for one in found}
        assert all(one.is_fine for one in found), found

    def test_other_physics_is_seen(self, tmp_path, run):
        """An oil that is 30 % thicker, or a mass 30 % larger: results differ, and so says it."""
        fmu = build_native(FLOODED, tmp_path / "a.fmu", platforms=[local()], compiler="cc")
        thick = attrs.evolve(
            FLOODED.meniscus, liquid=attrs.evolve(FLOODED.meniscus.liquid, viscosity=0.13)
        )
        thicker = attrs.evolve(FLOODED, interface=attrs.evolve(FLOODED.interface, meniscus=thick))
        with pytest.raises(DescriptionError, match="eta of the FMU"):
            add_reference(fmu, thicker, run)
        for other in (thicker, pulled(SCENES["flooded"], mass=0.026)):
            with zipfile.ZipFile(fmu) as packed:
                files = {n: packed.read(n) for n in packed.namelist() if not n.startswith(FOLDER)}
            write_archive(files | reference_files(reference_run(other)), fmu)
            wrong = {one.variable for one in check_references(fmu) if not one.is_fine}
            assert {"h", "v"} <= wrong
        assert cli.main(["fmu", "check", str(fmu)]) == 2

    def test_the_command_line(self, tmp_path, monkeypatch, capsys):
        monkeypatch.chdir(tmp_path)
        monkeypatch.setattr("contactkit.fmu.native.build.chosen_platforms", lambda _: [local()])
        ck.save_scene(FLOODED, "film.toml")
        build = ["fmu", "build", "film.toml", "--native", "--reference", "--out", "a.fmu"]
        assert cli.main(build) == 0
        assert cli.main(["fmu", "check", "a.fmu"]) == 0
        said = capsys.readouterr().out
        assert "pull: h differs by" in said
        assert "a.fmu: valid, as its reference results" in said
        assert cli.main(["fmu", "build", "stiction-mass", "--reference", "--out", "b.fmu"]) == 2
        assert cli.main(["fmu", "build", "micromirror", "--reference", "--out", "b.fmu"]) == 2
        assert "leave out --reference" in capsys.readouterr().err
